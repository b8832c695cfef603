"""Records made by hand, so that every mark in a figure can be counted."""

import numpy as np
import pytest

from shoal.metrics.contract import Facts
from shoal.metrics.heading_bearing import BINS
from shoal.metrics.tally import new_tally
from shoal.record.older import roster_from
from shoal.record.record import Record
from shoal.record.trajectory import Trajectory
from shoal.scenario.network import Network
from shoal.scenario.recorded import RecordedFleet, RecordedScenario, RecordedStrategy, RecordedTarget
from shoal.scenario.schema import Area

pytest.importorskip("matplotlib", reason="matplotlib is not installed")

STEPS, BATCHES = 40, 4


def tally(counts, *, on_target=0.5, present=1.0, batches=BATCHES):
    """Each fleet's agents in one bin: fleet 0 away, fleet 1 in the next bin, and so on."""
    length = STEPS / batches
    histogram = np.zeros((batches, len(counts), BINS), np.int64)
    for fleet, count in enumerate(counts):
        histogram[:, fleet, fleet] = count * length * present
    empty = new_tally(STEPS, batches, len(counts), sum(counts), 1)
    return empty._replace(
        steps=empty.batch_steps,
        present=empty.batch_steps * present,
        on_target=empty.batch_steps * present * on_target,
        engaged=empty.batch_steps * present * on_target * 2,
        fluctuation=np.ones((batches, len(counts))),
        histogram=histogram,
        agent_steps=np.outer(empty.batch_steps, counts),
    )


def trajectory(agents, targets=1, frames=STEPS):
    """Agents on a line, each a meter east of the one before; targets move north a meter per step."""
    shape = (frames, agents)
    x = np.broadcast_to(np.arange(agents, dtype=float) * 8 / agents, shape).copy()
    target_y = np.repeat(np.linspace(-5, 5, frames)[:, None], targets, axis=1)
    return Trajectory(
        step=np.arange(frames), x=x, y=np.zeros(shape), vx=np.zeros(shape), vy=np.zeros(shape),
        command_x=np.zeros(shape), command_y=np.zeros(shape),
        on_target=np.zeros(shape, bool), engaged=np.zeros(shape, bool), alive=np.ones(shape, bool),
        neighbors=np.ones(shape, np.int64), links=np.zeros((*shape, -(-agents // 8)), np.uint8),
        target_x=np.zeros((frames, targets)), target_y=target_y,
        target_present=np.ones((frames, targets), bool), memory={},
    )  # fmt: skip


def by_hand(**table):
    """A scenario as a record tells it, of fewer agents than can run, too."""
    return RecordedScenario.model_construct(
        losses=(), joins=(), description="", seed=7, motion=None,
        **table
        | {
            "area": Area(**table["area"]),
            "fleets": tuple(RecordedFleet(**fleet) for fleet in table["fleets"]),
            "network": Network(**table["network"]),
            "strategy": RecordedStrategy(table["strategy"]),
            "targets": tuple(RecordedTarget(**target) for target in table["targets"]),
        },
    )  # fmt: skip


@pytest.fixture
def make_record():
    """make_record(counts=(3, 2), runs=2, ...): fleets of 2, 1, 2/3 ... m/s"""

    def make(
        counts=(3, 2), runs=2, area=(20.0, 20.0, 1.5), targets=None, frames=STEPS, on_target=(0.2, 0.6), present=1.0
    ):
        targets = targets or [{"kind": "waypoint", "radius": 1.0, "speed": 3.0}]
        names = [f"make {fleet}" for fleet in range(len(counts))]
        speeds = [2.0 / (1 + fleet) for fleet in range(len(counts))]
        width, height, margin = area
        scenario = by_hand(
            name="by-hand",
            time_step=0.1,
            steps=STEPS,
            area={"width": width, "height": height, "agent_margin": margin},
            fleets=[
                {"name": name, "count": count, "max_speed": speed}
                for name, count, speed in zip(names, counts, speeds, strict=True)
            ],
            network={"neighbors": min(1, sum(counts) - 1) or "all"},
            strategy={"name": "knn-pso"},
            targets=targets,
        )
        return Record(
            scenario=scenario,
            roster=roster_from(scenario),
            facts=Facts(tuple(names), tuple(counts), tuple(speeds), max(width, height) / 20, 0.1),
            tallies=tuple(tally(counts, on_target=on_target[run % 2], present=present) for run in range(runs)),
            provenance={"seed": 7, "scenario_hash": "0123456789abcdef", "versions": {"shoal": "9.9.9"}},
            trajectories={0: trajectory(sum(counts), len(targets), frames)} if frames else {},
        )  # fmt: skip

    return make


@pytest.fixture
def axes():
    """Axes of 4 x 4 inches in our style, on a page of their own."""
    from shoal.drawing.style import new_figure, style

    with style():
        yield new_figure(5.0, 5.0).add_axes((0.1, 0.1, 0.8, 0.8))


def marks(axes, gid):
    """The artists of axes that carry a name and are seen."""
    return axes.findobj(lambda artist: artist.get_gid() == gid and artist.get_visible())


@pytest.fixture(name="marks")
def marks_fixture():
    return marks
