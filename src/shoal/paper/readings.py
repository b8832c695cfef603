"""The readings of the OCEANS 2020 paper that its words allow, listed by a rule before any of them is scored.

The paper prints an inertia of 1, with which nothing ever stands still inside the area, though its Fig. 2 shows buoys
that do. It does not say how much of the square the buoys and the target may use, how the target wanders, whether all
buoys move at once, or whether r is one number for both axes; its predecessor moved a_R in other steps. The rule:

1. every combination of OMEGAS, BOXES and MOTIONS, the three choices that had moved peaks most in a first short search;
2. every other open choice (SWITCHES) made the other way, alone, at each of ANCHORS: the paper as printed, and half the
   inertia in the whole square.

A reading is a set of changes to the preset oceans2020. How they are scored is in statements.py.
"""

import itertools
import re
from dataclasses import dataclass, field

from shoal.experiments.design import Point

HALF = 10.0  # [m] of the square's side
OMEGAS = (1.0, 0.7, 0.5)  # as printed; in between; the predecessor's
BOXES = ((8.5, 8.0), (10.0, 9.0), (10.0, 9.5), (10.0, 10.0))  # [m] half sides open to buoys, to the target's waypoints
MOTIONS = ("waypoints", "walk")
PERSISTENCE = 10.0  # [s] of the walk: Shoal's default, not tuned
ANCHORS = ((1.0, (8.5, 8.0), "waypoints"), (0.5, (10.0, 9.0), "waypoints"))
SWITCHES: dict[str, Point] = {
    "a_R steps of the predecessor": {"strategy.delta": 0.02506628274631, "strategy.shrink": 2.0},
    "one buoy after the other": {"motion.update_order": "sequential"},
    "r per axis": {"strategy.social_draws": "per-axis"},
}


@dataclass(frozen=True)
class Reading:
    """One way to read the paper: its name, the changes to the preset, and how many choices differ from the printed."""

    name: str
    changes: Point = field(hash=False)
    departures: int

    @property
    def slug(self) -> str:
        """For a folder."""
        return re.sub("[^a-z0-9.]+", "-", self.name.lower())

    @property
    def sequential(self) -> bool:
        """Whether buoys move one after the other, which takes about five times as long."""
        return self.changes.get("motion.update_order") == "sequential"


def readings() -> list[Reading]:
    """Return all readings, the printed one first."""
    factorial = [_reading(*choice) for choice in itertools.product(OMEGAS, BOXES, MOTIONS)]
    return [*factorial, *(_reading(*anchor, switch) for anchor in ANCHORS for switch in SWITCHES)]


def printed() -> Reading:
    """The paper as printed, the preset oceans2020."""
    return _reading(*ANCHORS[0])


def _reading(omega: float, box: tuple[float, float], motion: str, switch: str = "") -> Reading:
    wall, waypoints = box
    margin = HALF - waypoints
    changes: Point = {"strategy.inertia": omega, "area.agent_margin": HALF - wall, **SWITCHES.get(switch, {})}
    if motion == "walk":
        walk = {"kind": "walk", "radius": 1.0, "speed": 3.0, "margin": margin, "persistence": PERSISTENCE}
        changes["targets"] = [walk]
    else:
        changes["targets.0.margin"] = margin
    name = f"omega {omega:g}, box {wall:g}/{waypoints:g}, {motion}" + (f", {switch}" if switch else "")
    choices = zip((omega, box, motion, switch), (*ANCHORS[0], ""), strict=True)
    return Reading(name, changes, sum(mine != its for mine, its in choices))
