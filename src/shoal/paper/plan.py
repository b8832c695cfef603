"""What a reproduction runs: one sweep per group of runs, in full or quick."""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from shoal.experiments.design import Design, Point, grid
from shoal.paper.later_plan import DENSITY, EVASIVE, density_groups, evasive_groups
from shoal.paper.side_plan import BASE, MEMORY, UNREPELLED, settings

PAPERS = ("oceans2020", "aamas2020", EVASIVE, DENSITY)
PRINTED, REFIT = "oceans2020", "oceans2020-refit"  # the paper to the letter; the reading that meets most of it
FULL_STEPS, QUICK_STEPS = 100_000, 20_000
SPEEDS = (3.0, 5.0)  # of the target [m/s]
AGENTS, MIXED = 50, 15  # buoys, and fast ones among them in the paper's mixed swarm
SHARE_NEIGHBORS = (10, 20, 30, 40)
START_PLACES = ("corner", "center")
SENSITIVITY, SENSITIVITY_PLACEMENT = "sensitivity", "sensitivity-placement"  # folders of the variants' groups

# Every k where the curves peak: between points a curve can bend unseen, and its peak's interval grows (peaks.py).
_NEIGHBORS = (*range(2, 14, 2), *range(14, 31), 32, 34, 36, 38, 40, 42, 44, 46, 48, 49)
_NEIGHBORS_QUICK = (2, 6, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30, 34, 40, 49)
_SENSITIVITY_NEIGHBORS = (10, 14, 17, 20, 23, 26, 30, 34, 40, 49)
_SENSITIVITY_NEIGHBORS_QUICK = (10, 15, 20, 25, 30, 35, 40, 49)
_SENSITIVITY_SHARES = (30, AGENTS)
_PUBLISHED_NEIGHBORS = tuple(range(10, 50, 3))

# What the paper leaves open (docs/paper-notes.md), each decided the other way.
VARIANTS: dict[str, Point] = {
    "baseline": {},
    "omega 0.5": {"strategy.inertia": 0.5},
    "delta 0.005": {"strategy.delta": 0.005},
    "delta 0.02": {"strategy.delta": 0.02},
    "shrink 2 delta": {"strategy.shrink": 2.0},
    "sequential update": {"motion.update_order": "sequential"},
    "follow lowest index": {"strategy.follow": "lowest-index"},
    "boundary 10": {"area.agent_margin": 0.0},
    "boundary 10, waypoints in 9": {"area.agent_margin": 0.0, "targets.0.margin": 1.0},
    "speed divided, 1/2 steps": {"motion.speed_rule": "divide"},  # buoys jam in corners: clear soon, and slow to run
    "r per axis": {"strategy.social_draws": "per-axis"},
    "start in a corner": {"fleets.BoB-0.start": "corner", "fleets.BoB-1.start": "corner"},
    "target walks": {"targets": [{"kind": "walk", "radius": 1.0, "speed": 3.0, "margin": 2.0, "persistence": 10.0}]},
}


@dataclass(frozen=True)
class Group:
    """One sweep and its store; `labels` are columns that all its rows get."""

    name: str
    design: Design
    changes: Point
    labels: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Plan:
    """All runs of a reproduction."""

    paper: str
    quick: bool
    steps: int
    seeds: int
    groups: tuple[Group, ...]


def make_plan(paper: str, *, quick: bool = False) -> Plan:
    """Return the plan of one of PAPERS.

    Raises
    ------
    KeyError : another paper
    """
    steps, seeds = (QUICK_STEPS, 2) if quick else (FULL_STEPS, 5)
    groups = _GROUPS[paper](quick, steps, seeds)
    return Plan(paper, quick, steps, seeds, tuple(groups))


def _oceans2020(quick: bool, steps: int, seeds: int) -> list[Group]:
    """Under both readings the curves over k and over the share of fast buoys, other starts of the fast fleet, and what
    the paper says besides; and every variant of the printed one.
    """
    fast = range(0, AGENTS + 1, 10) if quick else range(0, AGENTS + 1, 5)
    main = [
        *_curves(_NEIGHBORS_QUICK if quick else _NEIGHBORS, SPEEDS),
        *grid({"target_speed": SPEEDS, "fast": [*fast, MIXED], "neighbors": SHARE_NEIGHBORS}),
    ]
    groups = []
    for preset, prefix in ((PRINTED, ""), (REFIT, "refit/")):
        groups += [
            Group(f"{prefix}main", Design(preset, distinct(main), seeds), {"steps": steps}),
            Group(f"{prefix}placement", Design(preset, _placement(), seeds), {"steps": steps}),
            *_sides(preset, QUICK_STEPS // 4 if quick else QUICK_STEPS, seeds, prefix),
        ]
    neighbors = _SENSITIVITY_NEIGHBORS_QUICK if quick else _SENSITIVITY_NEIGHBORS
    return [*groups, *_variants(neighbors, steps // 4 if quick else 2 * steps // 5, min(seeds, 3))]


def _sides(preset: str, steps: int, seeds: int, prefix: str) -> list[Group]:
    """One group per setting, at both target speeds and k = 20; three of them at every k of the shares."""
    groups = []
    for name, changes in settings(preset).items():
        fast = [MIXED, 0] if name == BASE or name.startswith("start") else [MIXED]
        neighbors = SHARE_NEIGHBORS if name in (BASE, MEMORY, UNREPELLED) else (20,)
        vary: dict[str, Sequence[Any]] = {"target_speed": SPEEDS, "fast": fast, "neighbors": neighbors}
        labels: dict[str, Any] = {"side": name}
        if "agents" in changes:  # another number keeps the shares of the fleets
            labels["fast"] = vary.pop("fast")[0]
        design = Design(preset, distinct(grid(vary)), seeds)
        groups.append(Group(f"{prefix}side/{_slug(name)}", design, {"steps": steps, **changes}, labels))
    return groups


def _aamas2020(quick: bool, steps: int, seeds: int) -> list[Group]:
    """The predecessor's curves over k, with adaptive and with constant repulsion."""
    points = distinct(grid({"neighbors": _PUBLISHED_NEIGHBORS}))
    presets = ("aamas2020", "aamas2020-constant")
    return [Group(name, Design(name, points, seeds), {"steps": steps}, {"preset": name}) for name in presets]


def _later(paper: str, points: Mapping[str, Sequence[Point]], steps: int, seeds: int) -> list[Group]:
    """A sweep per group of a later paper."""
    return [Group(name, Design(paper, tuple(each), seeds), {"steps": steps}) for name, each in points.items()]


def _evasive(quick: bool, steps: int, seeds: int) -> list[Group]:
    return _later(EVASIVE, evasive_groups(quick), steps, seeds)


def _density(quick: bool, steps: int, seeds: int) -> list[Group]:
    return _later(DENSITY, density_groups(quick), steps, seeds)


_GROUPS: dict[str, Callable[[bool, int, int], list[Group]]] = {
    "oceans2020": _oceans2020,
    "aamas2020": _aamas2020,
    EVASIVE: _evasive,
    DENSITY: _density,
}


def _variants(neighbors: Sequence[int], steps: int, seeds: int) -> list[Group]:
    """Curves and other starts of each: its change is to the base scenario, before `fast` = 0 removes a fleet."""
    shares = grid({"target_speed": SPEEDS, "fast": _SENSITIVITY_SHARES, "neighbors": SHARE_NEIGHBORS})
    points = distinct([*_curves(neighbors, SPEEDS), *shares])
    return [
        Group(
            f"{kind}/{_slug(name)}",
            Design(PRINTED, chosen, seeds),
            {"steps": steps // 2 if "1/2 steps" in name else steps, **changes},
            {"variant": name},
        )
        for name, changes in VARIANTS.items()
        for kind, chosen in ((SENSITIVITY, points), (SENSITIVITY_PLACEMENT, _placement()))
    ]


def _placement() -> tuple[Point, ...]:
    """Other starts of the fast fleet."""
    return distinct(
        grid({"target_speed": SPEEDS, "fast": [MIXED], "neighbors": [20], "fleets.BoB-1.start": START_PLACES})
    )


def _curves(neighbors: Sequence[int], speeds: Sequence[float]) -> list[Point]:
    """The mixed and the all-slow swarm over k."""
    return grid({"target_speed": speeds, "fast": [MIXED, 0], "neighbors": neighbors})


def distinct(points: Sequence[Point]) -> tuple[Point, ...]:
    """Each point once, in order."""
    return tuple({tuple(point.items()): point for point in points}.values())


def _slug(name: str) -> str:
    """For a folder."""
    return re.sub("[^a-z0-9.]+", "-", name.lower())
