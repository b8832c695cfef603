"""Airtime: how much of the time agents transmit, with the radio that the scenario names."""

from shoal.metrics.contract import Facts, Measurement, Metric
from shoal.metrics.shares import mean_agents


def duty(facts: Facts) -> float:
    """Share of the time that an agent transmits; NaN where no radio is named."""
    return facts.airtime / facts.report_interval if facts.airtime > 0 else float("nan")


MEASUREMENT = Measurement(
    "airtime",
    metrics=(
        Metric(
            "airtime",
            "1",
            "share of the time that an agent transmits its reports; above 1 it cannot",
            lambda t, f: duty(f),
            better="lower",
            once=True,
            asked=True,
        ),
        Metric(
            "channel_load",
            "1",
            "share of the time that a channel is taken which all agents share: airtime times agents present",
            lambda t, f: duty(f) * mean_agents(t),
            better="lower",
            once=True,
            asked=True,
        ),
    ),
    order=8,
)
