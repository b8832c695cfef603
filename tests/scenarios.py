"""Scenarios for tests: a preset with some fields changed."""

from shoal.scenario.load import read_table, scenario_from


def scenario(preset="oceans2020", changes=None):
    """scenario("oceans2020", {"network.neighbors": 5, "targets.0.speed": "5 kn"})"""
    return scenario_from(changed(read_table(preset), changes or {}))


def small(agents, neighbors, changes=None, preset="oceans2020"):
    """A preset with one fleet of so many agents."""
    return scenario(preset, {"fleets": fleets((agents, 1.0)), "network.neighbors": neighbors, **(changes or {})})


def fleets(*makes):
    """fleets((15, 2.6), (35, 1.0)): two fleets, of 15 and 35 agents, with these top speeds [m/s]"""
    return [{"name": f"make {i}", "count": count, "max_speed": speed} for i, (count, speed) in enumerate(makes)]


def changed(table, changes):
    """The table with the fields at these dotted paths set, in place."""
    for path, value in changes.items():
        *parents, last = path.split(".")
        part = table
        for name in parents:
            part = part[int(name)] if isinstance(part, list) else part.setdefault(name, {})
        part[int(last) if isinstance(part, list) else last] = value
    return table
