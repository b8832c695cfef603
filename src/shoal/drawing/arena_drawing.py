"""The arena and all in it, drawn once; `show` moves it to another frame."""

from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np

from shoal.drawing.agents import AgentMarks
from shoal.drawing.arena import PAD, draw_arena, draw_scale_bar, in_kilometers
from shoal.drawing.chart import current_arrows, draw_chart
from shoal.drawing.discs import Halos, SensorDiscs
from shoal.drawing.dots import MARKED, Dots
from shoal.drawing.links import Links
from shoal.drawing.targets import TargetMarks
from shoal.drawing.trails import AgentTrails, TargetTrail, draw_whole_path, target_points
from shoal.record.record import Record
from shoal.record.trajectory import Trajectory
from shoal.scenario.schema import Scenario

if TYPE_CHECKING:
    from matplotlib.axes import Axes

REACH = 8.0  # arena units that the fastest buoy covers in the default trail
_TRAILED = 1000  # more buoys than this draw no trails


class Parts(NamedTuple):
    """What is drawn besides buoys and targets."""

    links: bool = False  # a line to each buoy that is really heard
    trails: bool = True
    halos: bool = False  # discs of radius a_R
    sensors: bool = False  # circles as wide as sensors reach


class Actor(Protocol):
    """What moves from frame to frame."""

    artists: Any  # of matplotlib

    def show(self, frames: Trajectory, at: int) -> None:
        """Move to a frame."""


class ArenaDrawing:
    """The arena of one run in axes of its own.

    Parameters
    ----------
    trail : steps of the targets' trails (the buoys' are a third of it); default: what the fastest buoy needs for 8
        arena units, each a twentieth of the longer side
    stride : steps between two frames that a trail may join
    pad : room around the arena, as a share of the longer side

    Raises
    ------
    RecordError : a part that this run has nothing to show of
    """

    def __init__(
        self, axes: "Axes", record: Record, run: int, parts: Parts, trail: int | None = None, stride: int = 1,
        pad: float = PAD,
    ) -> None:  # fmt: skip
        self.frames = record.trajectories[run]
        targets = record.scenario.targets
        steps = trail_steps(record.scenario) if trail is None else trail
        draw_arena(axes, record.scenario.area, pad)
        draw_chart(axes, record.scenario)
        self.actors: list[Actor] = []
        if arrows := current_arrows(axes, record.scenario):
            self.actors.append(arrows)
        for number, target in enumerate(targets):
            if target.kind == "track":
                draw_whole_path(axes, self.frames, number, target.radius)
            elif parts.trails:
                self.actors.append(TargetTrail(axes, record, number, steps, stride))
            self.actors.append(TargetMarks(axes, record, number))
        if parts.trails and steps >= 3 and record.facts.agents <= _TRAILED:
            self.actors.append(AgentTrails(axes, record, steps // 3, stride))
        if parts.links:
            self.actors.append(Links(axes, self.frames))
        if parts.halos:
            self.actors.append(Halos(axes, record, run))
        if parts.sensors:
            self.actors.append(SensorDiscs(axes, record, run))
        dotted = record.facts.agents > MARKED
        if dotted:
            self.actors.append(Dots(axes, record))
        self.actors.append(AgentMarks(axes, record, reporting=dotted))
        self._tracks = [number for number, target in enumerate(targets) if target.kind == "track"]
        self._needs_scale = in_kilometers(record.scenario.area) or bool(self._tracks)
        self._axes, self._area = axes, record.scenario.area

    def show(self, at: int) -> None:
        """Move everything to a frame."""
        for actor in self.actors:
            actor.show(self.frames, at)

    def scale(self, always: bool = False) -> None:
        """Draw a scale bar where the axes are in km, or where a recorded track is; out of the track's way."""
        if self._needs_scale or always:
            paths = [target_points(self.frames, slice(None), number) for number in self._tracks]
            draw_scale_bar(self._axes, self._area, np.concatenate([np.empty((0, 2)), *paths]))

    @property
    def artists(self) -> list[Any]:
        """All that moves, from the lowest to the highest."""
        return sorted((each for actor in self.actors for each in actor.artists), key=lambda artist: artist.get_zorder())


def trail_steps(scenario: Scenario) -> int:
    """Steps of a target's trail if nobody says otherwise."""
    fastest = max(fleet.max_speed for fleet in scenario.fleets)
    return round(REACH * scenario.unit / (fastest * scenario.time_step))
