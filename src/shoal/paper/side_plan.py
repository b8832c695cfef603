"""Runs for what the paper says beside its figures: other strategies, losses, numbers, targets, starts.

Each setting changes the preset in one way; all are short (20,000 steps) and share their chance with the unchanged one.
"""

from shoal.experiments.design import Point
from shoal.scenario.load import read_table

BASE, MEMORY, UNREPELLED = "as it is", "memory", "no repulsion"
CONSTANT = (0.375, 0.5013256549262001, 0.75, 1.5)  # a_R [m]: the smallest, the predecessor's, between, the largest
EXPONENTS = (4.0, 8.0)  # d, a third to either side
SWEEPS = ("parallel-track", "expanding-square", "sector-search")
MOVEMENTS = ("line", "walk", "levy")
STARTS = ("corner", "center")
TENTH, HALF = "5 of 50 lost", "25 of 50 lost"
FEW, MANY = "25 buoys", "100 buoys"


def constant_name(strength: float) -> str:
    """Of the setting with this a_R."""
    return f"constant a_R {strength:.3g}"


def exponent_name(exponent: float) -> str:
    """Of the setting with this d."""
    return f"d {exponent:g}"


def constant(strength: float) -> Point:
    """Changes that give all agents the same a_R for ever."""
    return {
        "strategy.repulsion_start": strength,
        "strategy.repulsion_min": strength,
        "strategy.repulsion_max": strength,
        "strategy.delta": 0.0,
    }


def settings(preset: str) -> dict[str, Point]:
    """Every setting's changes to a preset, by its name."""
    table = read_table(preset)
    half, tenth = ([{"step": 1, "count": count}] for count in (25, 5))
    target = table["targets"][0]
    found: dict[str, Point] = {
        BASE: {},
        MEMORY: {"strategy": "memory-pso", "strategy.inertia": table["strategy"]["inertia"]},
        UNREPELLED: {"strategy.repulsion_step": 0.0},
        TENTH: {"losses": tenth},
        HALF: {"losses": half},
        FEW: {"agents": 25},
        MANY: {"agents": 100},
    }
    found |= {constant_name(each): constant(each) for each in CONSTANT}
    found |= {exponent_name(each): {"strategy.repulsion_exponent": each} for each in EXPONENTS}
    for sweep in SWEEPS:
        found |= {sweep: {"strategy": sweep}, f"{sweep}, {HALF}": {"strategy": sweep, "losses": half}}
        found |= {f"{sweep}, {FEW}": {"strategy": sweep, "agents": 25}}
    for kind in MOVEMENTS:
        legs = {"shortest": 1.0, "longest": table["area"]["width"]} if kind == "levy" else {}
        moving = {"kind": kind, **{name: target[name] for name in ("radius", "speed", "margin")}, **legs}
        found[f"target: {kind}"] = {"targets": [moving]}
    for start in STARTS:
        found[f"start: {start}"] = {"fleets.BoB-0.start": start, "fleets.BoB-1.start": start}
    return found
