"""Buoys as marks: told apart by fleet, by speed, and by what they report; who is not there is not drawn."""

from typing import TYPE_CHECKING, Any

import numpy as np

from shoal.drawing.legend import marker_area, room_of
from shoal.drawing.style import INK, fleet_color, fleet_line, fleet_marker
from shoal.record.record import Record
from shoal.record.trajectory import Trajectory

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class AgentMarks:
    """One mark per buoy that is alive; it is bigger and has a dark rim where it reports a target, false alarms too.

    Parameters
    ----------
    reporting : only those that report a target
    """

    def __init__(self, axes: "Axes", record: Record, reporting: bool = False) -> None:
        self._reporting = reporting
        self._ends = np.cumsum(record.facts.counts)
        room = room_of(axes)
        self._areas = [room * marker_area(record, fleet) for fleet in range(len(self._ends))]
        self._rims = [_rim(fleet) for fleet in range(len(self._ends))]
        self.artists: list[Any] = [
            axes.scatter([], [], marker=fleet_marker(fleet), color=fleet_color(fleet), zorder=5, gid=f"fleet-{fleet}")
            for fleet in range(len(self._ends))
        ]

    def show(self, frames: Trajectory, at: int) -> None:
        """Move to a frame."""
        begin = 0
        for marks, area, end, rim in zip(self.artists, self._areas, self._ends, self._rims, strict=True):
            drawn = frames.alive[at, begin:end]
            if self._reporting:
                drawn = drawn & frames.on_target[at, begin:end]
            there = np.flatnonzero(drawn) + begin
            on_target = np.asarray(frames.on_target[at])[there]
            marks.set_offsets(np.stack([frames.x[at][there], frames.y[at][there]], axis=-1))
            marks.set_sizes(area * np.where(on_target, 1.35, 1.0))
            marks.set_linewidths(area**0.5 * np.where(on_target, 0.2, 0.08))
            marks.set_edgecolors([INK if on else rim for on in on_target])
            begin = end


def _rim(fleet: int) -> str:
    """White, or darker than a color that is pale on white."""
    return "white" if fleet_line(fleet) == fleet_color(fleet) else fleet_line(fleet)
