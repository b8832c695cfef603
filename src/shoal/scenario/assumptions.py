"""What a scenario takes for granted, or asks of a radio that the law forbids: a sentence each."""

import math

from shoal.core.messages import ENVELOPE_BYTES, REPORT_BYTES
from shoal.core.text import plain
from shoal.scenario.battery import assumed_drag
from shoal.scenario.crew import crew_of
from shoal.scenario.radios import RADIOS
from shoal.scenario.schema import Scenario


def assumptions(scenario: Scenario) -> list[str]:
    """Sentences about an interval that was rounded, rules and radios that do not fit, and drag that is assumed."""
    return [*_interval(scenario), *_collected(scenario), *_duty(scenario), *_drag(scenario)]


def report_size(scenario: Scenario) -> int:
    """Bytes of a report without what sending takes besides."""
    return REPORT_BYTES + 8 * len(crew_of(scenario).told)


def airtime(scenario: Scenario) -> float:
    """How long a report is on the air [s]; 0 where no radio is named."""
    radio = scenario.network.radio
    return RADIOS[radio].time_on_air(report_size(scenario) + ENVELOPE_BYTES) if radio else 0.0


def _interval(scenario: Scenario) -> list[str]:
    asked, real = scenario.network.interval, scenario.report_interval
    if asked is None or abs(asked - real) <= 1e-6 * asked:
        return []
    return [f"network.interval is {asked:g} s, no whole number of steps: agents report every {real:g} s"]


def _collected(scenario: Scenario) -> list[str]:
    """What is kept or relayed in vain, or on top of what is counted."""
    network, interval, notes = scenario.network, scenario.report_steps, []
    if 0 < network.max_age < interval:
        steps = f"{network.max_age} step{'s' if network.max_age > 1 else ''}"
        notes.append(f"network.max_age is {steps}, but reports come every {interval}: no older one is gone by")
    limited = network.range or network.loss or scenario.disturbances or (scenario.sea and scenario.sea.coast)
    if network.hops > 1 and not limited:
        notes.append(f"network.hops is {network.hops}, but all hear each other directly: give network.range")
    elif network.hops > 1 and network.radio:
        notes.append(f"airtime and duty cycle of {network.radio} are of an agent's own reports, without what it relays")
    return notes


def _duty(scenario: Scenario) -> list[str]:
    name = scenario.network.radio
    if name is None:
        return []
    radio, time, interval = RADIOS[name], airtime(scenario), scenario.report_interval
    report = f"a report of {report_size(scenario) + ENVELOPE_BYTES} bytes takes {name} {_three_digits(1000 * time)} ms"
    if time > interval:
        return [f"{report}, longer than the {interval:g} s from one to the next: it cannot be sent"]
    if time / interval > radio.duty:
        lawful = math.ceil(100 * time / radio.duty) / 100
        return [
            f"{report}, {100 * time / interval:.3g} % of the time at one every {interval:g} s, but "
            f"{100 * radio.duty:g} % are allowed ({radio.law}): an interval of {lawful:g} s keeps to it"
        ]
    return []


def _three_digits(value: float) -> str:
    return f"{float(f'{value:.3g}'):,.0f}" if value >= 1000 else f"{value:.3g}"


def _drag(scenario: Scenario) -> list[str]:
    notes = []
    for fleet in scenario.fleets:
        battery = fleet.battery
        if battery and battery.drag is None and battery.curve is None and fleet.mass is not None:
            drag = assumed_drag(fleet.mass)
            notes.append(
                f"propulsion of fleet {plain(fleet.name)} is assumed to draw {drag:.3g} W/(m/s)^3, "
                f"{drag * fleet.max_speed**3:.3g} W at top speed, from its mass; "
                "fleets.battery.drag or .curve says better"
            )
    return notes
