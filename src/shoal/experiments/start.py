"""Where a search starts: the value that a scenario gives a field now."""

from typing import Any

from shoal.scenario.schema import Scenario


def value_of(scenario: Scenario, field: str) -> Any:
    """Return the value of a shorthand or a path; None where the scenario says nothing, or of no one value."""
    table = scenario.model_dump(mode="json")
    if field == "agents":
        return scenario.agents
    if field == "fast":
        return max(table["fleets"], key=lambda fleet: fleet["max_speed"])["count"]
    if field == "target_speed":
        return next((each["speed"] for each in table["targets"] if "speed" in each), None)
    path = {"neighbors": "network.neighbors", "strategy": "strategy.name"}.get(field, field)
    node: Any = table
    for part in path.split("."):
        if isinstance(node, list):
            node = next((each for n, each in enumerate(node) if part in (str(n), each.get("name"))), None)
        else:
            node = node.get(part) if isinstance(node, dict) else None
    return node
