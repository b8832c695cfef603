"""Discs around buoys, to scale: how far each pushes others away (a_R), and how far it senses."""

from typing import TYPE_CHECKING, Any

import numpy as np

from shoal.core.errors import RecordError
from shoal.drawing.style import GRAY, fleet_color
from shoal.record.record import Record
from shoal.record.trajectory import Trajectory

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_REPULSION = "repulsion"  # field of a strategy's memory [m]; a_R in the paper


class Halos:
    """A faint disc of radius a_R around each buoy, in the color of its fleet.

    Raises
    ------
    RecordError : the strategy remembers no a_R
    """

    def __init__(self, axes: "Axes", record: Record, run: int) -> None:
        if _REPULSION not in record.trajectories[run].memory:
            raise RecordError(
                "halos",
                f"show a_R, which strategy {record.scenario.strategy.name} has none of",
                "leave them out, or take a strategy with adaptive repulsion, such as knn-pso",
            )
        self._colors = np.array([fleet_color(fleet) for fleet in record.roster.fleet.tolist()])
        self._discs = _Discs(axes, "halos", alpha=0.09, linewidth=0.5)
        self.artists = [self._discs.collection]

    def show(self, frames: Trajectory, at: int) -> None:
        """Move to a frame."""
        self._discs.show(frames, at, np.asarray(frames.memory[_REPULSION][at]))
        self._discs.collection.set_facecolor(list(self._colors[np.asarray(frames.alive[at])]))


class SensorDiscs:
    """A dashed circle around each buoy, as wide as its sensor reaches: one that touches a target's disc detects it.

    Raises
    ------
    RecordError : no sensor reaches beyond its buoy
    """

    def __init__(self, axes: "Axes", record: Record, run: int) -> None:
        self._radii = record.roster.sensor_radius
        if not self._radii.any():
            raise RecordError(
                "sensor discs",
                "have radius 0 in this scenario: a buoy detects a target when it is inside of the target's disc",
                "leave them out, or set fleets.NAME.sensor_radius",
            )
        self._discs = _Discs(axes, "sensors", edgecolor=GRAY, linewidth=0.7, linestyle=(0, (3, 2)), alpha=0.7)
        self._discs.collection.set_facecolor("none")
        self.artists = [self._discs.collection]

    def show(self, frames: Trajectory, at: int) -> None:
        """Move to a frame."""
        self._discs.show(frames, at, self._radii)


class _Discs:
    """Circles with radii in the units of the axes, around the buoys present."""

    def __init__(self, axes: "Axes", gid: str, **look: Any) -> None:
        from matplotlib.collections import EllipseCollection

        self.collection = EllipseCollection(
            [], [], [], units="xy", offsets=np.empty((0, 2)), offset_transform=axes.transData, zorder=1.6, **look
        )
        self.collection.set_gid(gid)
        axes.add_collection(self.collection, autolim=False)

    def show(self, frames: Trajectory, at: int, radii: Any) -> None:
        there = np.asarray(frames.alive[at])
        self.collection.set_offsets(np.stack([frames.x[at], frames.y[at]], axis=-1)[there])
        self.collection.set_widths(2 * radii[there])
        self.collection.set_heights(2 * radii[there])
        self.collection.set_angles(np.zeros(int(there.sum())))
