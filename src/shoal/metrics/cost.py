"""Cost: what the swarm costs, where every fleet says what one of its agents does."""

from shoal.metrics.contract import Facts, Measurement, Metric


def cost(facts: Facts) -> float:
    """All agents that ever take part, in the currency of the scenario; NaN where a fleet says nothing."""
    if len(facts.costs) < len(facts.fleets):
        return float("nan")
    return float(sum(each * count for each, count in zip(facts.costs, facts.counts, strict=True)))


MEASUREMENT = Measurement(
    "cost",
    metrics=(
        Metric(
            "cost",
            "currency",
            "of all agents together, those that join later too",
            lambda t, f: cost(f),
            better="lower",
            once=True,
            asked=True,
        ),
    ),
    order=11,
)
