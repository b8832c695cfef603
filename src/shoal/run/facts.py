"""What metrics need to know of a scenario."""

from shoal.core.messages import REPORT_BYTES
from shoal.metrics.contract import Facts
from shoal.scenario.crew import crew_of
from shoal.scenario.schema import Scenario


def facts_of(scenario: Scenario) -> Facts:
    """What metrics need to know of a scenario."""
    fleets = scenario.fleets
    return Facts(
        fleets=tuple(fleet.name for fleet in fleets),
        counts=tuple(scenario.counts),
        max_speeds=tuple(fleet.max_speed for fleet in fleets),
        unit=scenario.unit,
        time_step=scenario.time_step,
        area=scenario.area.width * scenario.area.height,
        report_bytes=REPORT_BYTES + 8 * len(crew_of(scenario).told),
    )
