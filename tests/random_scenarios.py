"""Random scenarios: valid ones over every field, and ones with a single thing wrong."""

import copy
import math
from typing import get_type_hints

from shoal.core.units import Choice, Range
from shoal.strategies import CATALOGUE

STRATEGIES = sorted(name for name, known in CATALOGUE.items() if known.builtin)
TEAMS = [["encircle", "knn-pso"], ["levy-walk", "global-pso", "lattice-intercept"]]
KINDS = ["still", "waypoint", "line", "walk", "levy", "evasive", "drift"]
STEPS = 50


def some(rng, low, high):
    """A number between two, uniform in its logarithm."""
    return float(math.exp(rng.uniform(math.log(low), math.log(high))))


def maybe(rng, table, chance=0.3, **fields):
    """Add each field with a chance; values are made only then."""
    for name, make in fields.items():
        if rng.random() < chance:
            table[name] = make()


def with_units(rng, value):
    """A speed, now and then in words."""
    return f"{value / 0.5144444444444445!r} kn" if rng.random() < 0.1 else value


def valid_table(rng, strategies):
    """A scenario that can run; its fleets follow these strategies."""
    width, height = some(rng, 1.0, 1e5), some(rng, 1.0, 1e5)
    side, slow = min(width, height), max(width, height)
    counts = [
        1 + int(some(rng, 1, 60 if rng.random() < 0.1 else 9)) for _ in range(max(rng.integers(1, 5), len(strategies)))
    ]
    names = [f"fleet {number}" for number in range(len(counts))]
    joins = [
        {"step": int(rng.integers(1, 60)), "count": int(rng.integers(1, 6)), "fleet": str(rng.choice(names))}
        for _ in range(rng.integers(1, 3) if rng.random() < 0.3 else 0)
    ]
    agents = sum(counts) + sum(join["count"] for join in joins)
    table = {
        "time_step": some(rng, 1e-2, 1e1),
        "steps": STEPS,
        "seed": int(rng.integers(0, 2**63)),
        "area": {"width": width, "height": height},
        "fleets": [_fleet(rng, name, count, agents, slow) for name, count in zip(names, counts, strict=True)],
        "network": _network(rng, agents, slow),
        "strategy": _strategy(rng, strategies[-1]),
        "targets": [_target(rng, side, slow) for _ in range(rng.integers(1, 5) if rng.random() < 0.4 else 1)],
    }
    for fleet, name in zip(table["fleets"], strategies[:-1], strict=False):
        fleet["strategy"] = _strategy(rng, name)
    maybe(rng, table["area"], agent_margin=lambda: float(rng.uniform(0, 0.49) * side))
    maybe(rng, table, motion=lambda: {
        "update_order": str(rng.choice(["synchronous", "sequential"])),
        "speed_rule": str(rng.choice(["cap", "divide"])),
    })  # fmt: skip
    maybe(rng, table, chance=0.15, disturbances=lambda: [_disturbance(rng, names) for _ in range(rng.integers(1, 4))])
    if joins:
        table["joins"] = joins
    left = agents
    for _ in range(rng.integers(1, 4) if rng.random() < 0.3 else 0):
        loss = {"step": int(rng.integers(1, 60)), "count": int(rng.integers(1, left + 1))}
        left -= loss["count"]
        if rng.random() < 0.5:
            at = int(rng.integers(len(names)))
            before = [each for each in table.get("losses", []) if each.get("fleet") == names[at]]
            loss |= {
                "fleet": names[at],
                "count": min(loss["count"], counts[at] - sum(each["count"] for each in before)),
            }
        if loss["count"] > 0:
            table.setdefault("losses", []).append(loss)
        if left == 0:
            break
    together = table.get("motion", {}).get("update_order") != "sequential" and not {"max_age", "hops"} & {
        *table["network"]
    }
    if strategies == ["knn-pso"] and together:  # what is compiled for it is compiled once
        maybe(rng, table, chance=0.5, precision=lambda: "single")
    return table


def _disturbance(rng, fleets):
    kind = str(rng.choice(["current", "blackout"]))
    table = {"kind": kind, "since": float(rng.choice([0.0, some(rng, 1e-2, 1e2)]))}
    maybe(rng, table, fleet=lambda: str(rng.choice(fleets)), until=lambda: table["since"] + some(rng, 1e-2, 1e2))
    if kind == "current":
        maybe(rng, table, chance=0.7, east=lambda: some(rng, 1e-3, 1e2), north=lambda: -some(rng, 1e-3, 1e2))
        maybe(rng, table, gust=lambda: some(rng, 1e-3, 1e1), gust_time=lambda: some(rng, 1e-2, 1e2))
    return table


def _fleet(rng, name, count, agents, slow):
    fleet = {"name": name, "count": count, "max_speed": with_units(rng, some(rng, 1e-2, 1e2))}
    maybe(
        rng,
        fleet,
        mass=lambda: some(rng, 0.1, 1e4),
        sensor_radius=lambda: some(rng, 1e-3, 1.0) * slow,
        start=lambda: str(rng.choice(["uniform", "center", "corner"])),
        neighbors=lambda: "all" if rng.random() < 0.2 else int(rng.integers(1, agents)),
        detection_probability=lambda: float(rng.random()),
        false_alarm_probability=lambda: float(rng.random()),
    )
    maybe(
        rng,
        fleet,
        chance=0.15,
        mean_lifetime=lambda: some(rng, 1e-3, 1e3),
        max_acceleration=lambda: some(rng, 1e-3, 1e3),
        max_turn_rate=lambda: some(rng, 1e-2, 1e4),
    )
    return fleet


def _network(rng, agents, slow):
    network = {"neighbors": "all" if rng.random() < 0.15 else int(rng.integers(1, agents))}
    maybe(
        rng,
        network,
        range=lambda: some(rng, 1e-3, 2.0) * slow,
        loss=lambda: float(rng.choice([rng.random(), 1.0], p=[0.9, 0.1])),
        delay=lambda: int(rng.integers(0, 70)),
    )
    if rng.random() < 0.2:
        fewest, most = sorted(int(k) for k in rng.integers(1, agents, 2))
        network["adaptive"] = {"fewest": fewest, "most": most, "patience": some(rng, 1e-2, 1e3)}
    return network


def _strategy(rng, name):
    if rng.random() < 0.2:
        return name
    params = CATALOGUE[name].params
    table = {"name": name}
    for field, hint in get_type_hints(params, include_extras=True).items():
        default = params._field_defaults[field]
        words = next((mark.words for mark in getattr(hint, "__metadata__", ()) if isinstance(mark, Choice)), None)
        if rng.random() < 0.3:
            most = next((mark.most for mark in getattr(hint, "__metadata__", ()) if isinstance(mark, Range)), math.inf)
            number = min(default * rng.uniform(0.5, 2.0), most)
            table[field] = str(rng.choice(words)) if words else type(default)(number)
    return table


def _target(rng, side, slow):
    kind = str(rng.choice(KINDS))
    target = {"kind": kind, "radius": float(rng.choice([0.0, some(rng, 1e-3, 1.0) * side]))}
    if kind == "still":
        maybe(rng, target, x=lambda: float(rng.uniform(-1, 1) * slow), y=lambda: float(rng.uniform(-1, 1) * slow))
        return target
    target["speed"] = with_units(rng, float(rng.choice([0.0, some(rng, 1e-2, 1e3)], p=[0.1, 0.9])))
    maybe(rng, target, margin=lambda: float(rng.uniform(0, 0.49) * side))
    if rng.random() < 0.2:
        target |= {"surface_time": some(rng, 1e-2, 1e3), "dive_time": some(rng, 1e-2, 1e3)}
    if kind == "waypoint":
        target["waypoint_reach"] = some(rng, 1e-3, 1.0) * side
        maybe(rng, target, waypoint_patience=lambda: int(rng.integers(1, 300)))
    if kind in ("waypoint", "evasive"):
        maybe(rng, target, max_turn=lambda: float(rng.uniform(1e-3, 180.0)))
    if kind in ("walk", "evasive", "drift"):
        maybe(rng, target, persistence=lambda: some(rng, 1e-3, 1e3))
    if kind == "levy":
        target["shortest"], target["longest"] = sorted(some(rng, 1e-3, 10.0) * side for _ in range(2))
        maybe(rng, target, exponent=lambda: float(rng.choice([1.0, rng.uniform(1, 5)])))
    if kind == "evasive":
        target |= {"sight": some(rng, 1e-3, 1.0) * side, "wall_sight": some(rng, 1e-3, 1.0) * side}
    if kind == "drift":
        target |= {"current_x": float(rng.normal() * 10), "current_y": float(rng.normal() * 10)}
    return target


def broken_table(rng, strategies):
    """What is wrong, in words, and a scenario that nothing else is wrong with."""
    table = copy.deepcopy(valid_table(rng, strategies))
    names = sorted(BREAKS)
    while True:
        name = names[int(rng.integers(len(names)))]
        told = BREAKS[name](rng, table)
        if told is not None:
            return f"{name}: {told}", table


def _leaves(table, path=()):
    """Every number, word and truth of a table, with its path."""
    for key, value in table.items() if isinstance(table, dict) else enumerate(table):
        if isinstance(value, (dict, list)):
            yield from _leaves(value, (*path, key))
        else:
            yield (*path, key), value


def _put(table, path, value):
    for key in path[:-1]:
        table = table[key]
    table[path[-1]] = value


def _pick(rng, options):
    options = list(options)
    return options[int(rng.integers(len(options)))] if options else None


def _replace(rng, table, wanted, values):
    """Put one of the values at a leaf that is wanted; returns the path."""
    path = _pick(rng, (path for path, value in _leaves(table) if wanted(path, value)))
    if path is None:
        return None
    value = _pick(rng, values)
    _put(table, path, value)
    return ".".join(map(str, path)) + f" = {value!r}"


def _is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _is_free(path):
    """Whether a field may be negative."""
    return path[-1] in ("x", "y", "current_x", "current_y") or "strategy" in path


def _wrong_type(rng, table):
    if rng.random() < 0.3:
        return _replace(
            rng,
            table,
            lambda path, value: isinstance(value, str) and value[-3:] != " kn" and path[-1] != "neighbors",
            [3, 1.5, True, [], {"a": 1}],
        )
    return _replace(rng, table, lambda path, value: _is_number(value), ["text", "", True, [], [1.0], {"a": 1}])


def _wrong_table(rng, table):
    name = _pick(rng, [name for name in ("area", "fleets", "network", "strategy", "targets") if name in table])
    table[name] = _pick(rng, [3, "nonsense", True, [3], ["a"], {"a": 1}, {}])
    return f"{name} = {table[name]!r}"


def _negative(rng, table):
    return _replace(
        rng, table, lambda path, value: _is_number(value) and not _is_free(path), [-1, -1.5, -1e-9, -(10**20)]
    )


def _zero(rng, table):
    positive = ("time_step", "steps", "width", "height", "count", "max_speed", "neighbors", "range", "patience", "step")
    return _replace(rng, table, lambda path, value: path[-1] in positive and _is_number(value), [0, 0.0, 1e-200])


def _not_finite(rng, table):
    return _replace(rng, table, lambda path, value: _is_number(value), [math.nan, math.inf, -math.inf])


def _huge(rng, table):
    free = ("detection_probability", "false_alarm_probability", "loss", "seed")

    def wanted(path, value):
        return _is_number(value) and "strategy" not in path and path[-1] not in free

    return _replace(rng, table, wanted, [1e13, -1e13, 1e300, 10**13, 10**30, 10**400, "1e20 km"])


def _unknown_field(rng, table):
    tables = [table, table["area"], table["network"], *table["fleets"], *table["targets"], *table.get("losses", [])]
    tables += [part for part in (table["strategy"], table.get("motion"), table["network"].get("adaptive")) if part]
    part = _pick(rng, [each for each in tables if isinstance(each, dict)])
    name = _pick(rng, ["", "nonsense", "speeed", "Width", "neighbours", "kin d", "äöü", "max_speed_"])
    part[name] = _pick(rng, [1, "a", [], {}])
    return name


def _missing(rng, table):
    needed = {"name", "count", "max_speed", "width", "height", "step", "kind", "radius", "speed", "waypoint_reach"}
    needed |= {"shortest", "longest", "sight", "wall_sight", "surface_time", "dive_time", "time_step", "steps"}
    paths = [path for path, _ in _leaves(table) if path[-1] in needed and "strategy" not in path[:-1]]
    paths += [("area",), ("fleets",), ("network",), ("strategy",), ("targets",), ("network", "neighbors")]
    path = _pick(rng, [each for each in paths if not (each[-1] == "speed" and _part(table, each)["kind"] == "drift")])
    del _part(table, path)[path[-1]]
    return ".".join(map(str, path))


def _part(table, path):
    for key in path[:-1]:
        table = table[key]
    return table


def _agents(table):
    return sum(each["count"] for each in [*table["fleets"], *table.get("joins", [])])


def _too_many_neighbors(rng, table):
    k = _agents(table) + int(rng.integers(0, 5))
    part = _pick(rng, [table["network"], *table["fleets"]])
    part["neighbors"] = k
    return k


def _adaptive(rng, table):
    n = _agents(table)
    table["network"]["adaptive"] = _pick(
        rng, [{"fewest": 2, "most": 1}, {"fewest": 1, "most": n}, {"patience": 0}, 3, []]
    )
    return table["network"]["adaptive"]


def _unknown_word(rng, table):
    """A word that is none of those there are."""
    words = ("start", "kind", "update_order", "speed_rule", "social_draws", "follow", "fleet")
    wanted = lambda path, value: path[-1] in words or path[-2:] == ("strategy", "name") or path == ("strategy",)  # noqa: E731
    return _replace(rng, table, wanted, ["nonsense", "", "uniforn", "knn_pso", "Waypoint", "fleet"])


def _bad_units(rng, table):
    wanted = lambda path, value: path[-1] in ("width", "max_speed", "speed", "time_step", "radius", "sensor_radius")  # noqa: E731
    return _replace(rng, table, wanted, ["5 parsecs", "5", "kn", "5 kg", "1e400 m", "nan m", "five m", "5 m m", "-5 m"])


def _wrong_numbers(rng, table):
    """Numbers that do not fit each other."""
    side = min(table["area"]["width"], table["area"]["height"])
    name = _pick(
        rng, ["margin", "nobody", "crowd", "losses", "join", "twins", "empty", "levy", "dive", "delay", "seed", "one"]
    )
    if name == "margin":
        table["area"]["agent_margin"] = side * float(rng.uniform(0.5, 5))
    elif name == "nobody":
        table["fleets"] = []
    elif name == "one":
        table["fleets"], table["network"] = [{"name": "a", "count": 1, "max_speed": 1.0}], {"neighbors": 1}
        table.pop("joins", None)
        table.pop("losses", None)
    elif name == "crowd":
        table["fleets"][0]["count"] = 1_000_001
    elif name == "losses":
        table["losses"] = [{"step": 1, "count": 1}, {"step": 5, "count": _agents(table)}]
    elif name == "join":
        table["joins"] = [{"step": 5, "count": 3}]
    elif name == "twins":
        table["fleets"].append(dict(table["fleets"][0]))
    elif name == "empty":
        table["targets"] = []
    elif name == "levy":
        table["targets"] = [{"kind": "levy", "radius": 1.0, "speed": 1.0, "shortest": 2.0, "longest": 1.0}]
    elif name == "dive":
        table["targets"] = [{"kind": "line", "radius": 1.0, "speed": 1.0, "dive_time": 2.0}]
    elif name == "delay":
        table["network"]["delay"] = _pick(rng, [1001, 0.5, -1])
    else:
        table["seed"] = _pick(rng, [2**64, -1, 0.5, "1"])
    return name


def _no_file(rng, table):
    if rng.random() < 0.5:
        table["strategy"] = {"file": _pick(rng, ["nowhere.py", "", ".", "none.txt"])}
    else:
        table["targets"] = [{"kind": "track", "file": _pick(rng, ["", 3]), "radius": 1.0}]
    return "no file"


BREAKS = {
    name.removeprefix("_"): function
    for name, function in list(globals().items())
    if name
    in (
        "_wrong_type", "_wrong_table", "_negative", "_zero", "_not_finite", "_huge", "_unknown_field", "_missing",
        "_too_many_neighbors", "_adaptive", "_unknown_word", "_bad_units", "_wrong_numbers", "_no_file",
    )
}  # fmt: skip
