"""A frame as bytes: what is packed comes out of a decoder that knows only the protocol's page."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from frames import decode
from shoal.core.links import link_bytes
from shoal.record.trajectory import Trajectory
from shoal.viewer.frame import Gauges, frame_bytes, pack

GAUGES = Gauges(0.5, float("nan"), 0.25, 0.75, 7.0, np.arange(11.0))


def trajectory(agents, targets, seed=0):
    """A frame of chance, step 123,456."""
    chance = np.random.default_rng(seed)
    numbers = {name: chance.normal(size=(1, agents)) for name in ("x", "y", "vx", "vy", "command_x", "command_y")}
    truths = {name: chance.random((1, agents)) < 0.5 for name in ("on_target", "engaged", "alive")}
    return Trajectory(
        step=np.array([123_456]),
        **numbers,
        **truths,
        neighbors=chance.integers(1, 10_000, (1, agents)),
        links=chance.integers(0, 256, (1, agents, link_bytes(agents))).astype(np.uint8),
        target_x=chance.normal(size=(1, targets)),
        target_y=chance.normal(size=(1, targets)),
        target_present=chance.random((1, targets)) < 0.5,
        memory={"repulsion": chance.normal(size=(1, agents))},
    )


def packed(agents, targets, seed=0, epoch=3):
    what = trajectory(agents, targets, seed)
    return what, pack(what, 0, run=1, epoch=epoch, gauges=GAUGES)


class TestPack:
    @given(agents=st.integers(2, 70), targets=st.integers(1, 5), seed=st.integers(0, 99))
    def test_everything_comes_back(self, agents, targets, seed):
        what, data = packed(agents, targets, seed)
        frame = decode(data)
        assert frame.size == len(data) == 84 + (23 + -(-agents // 8)) * agents + 9 * targets
        assert (frame.run, frame.epoch, frame.step) == (1, 3, 123_456)
        for name in ("x", "y", "vx", "vy", "target_x", "target_y"):
            assert getattr(frame, name) == np.float32(getattr(what, name)[0]).tolist()
        assert frame.repulsion == np.float32(what.memory["repulsion"][0]).tolist()
        assert frame.degree == what.neighbors[0].tolist()
        assert frame.on_target == what.on_target[0].tolist()
        assert frame.alive == what.alive[0].tolist()
        assert frame.present == what.target_present[0].tolist()
        for i in range(agents):
            for j in range(agents):
                assert frame.hears[i][j] == bool(what.links[0, i, j // 8] & (1 << j % 8))

    def test_gauges_stand_in_the_order_of_the_protocol(self):
        frame = decode(packed(3, 1)[1])
        assert (frame.time_on_target, frame.xi, frame.xi_now, frame.engaged) == (0.5, 0.25, 0.75, 7.0)
        assert np.isnan(frame.recent)
        assert frame.phi == list(range(11))

    def test_epochs_are_counted_modulo_65536(self):
        assert decode(packed(2, 1, epoch=65_536 + 5)[1]).epoch == 5

    def test_a_strategy_without_repulsion_has_none(self):
        what = replace(trajectory(3, 1), memory={})
        assert np.isnan(decode(pack(what, 0, run=0, epoch=0, gauges=GAUGES)).repulsion).all()

    @pytest.mark.parametrize(("agents", "each"), [(50, 23 + 7), (512, 23 + 64), (513, 23), (10_000, 23)])
    def test_an_agent_costs_so_many_bytes(self, agents, each):
        assert len(packed(agents, 1)[1]) == 93 + each * agents

    def test_a_lean_one_says_where_they_are_and_who_reports_a_target(self):
        what = trajectory(600, 2)
        data = pack(what, 0, run=0, epoch=0, gauges=GAUGES, lean=True)
        frame = decode(data)
        assert len(data) == frame.size == frame_bytes(600, 2, 0, lean=True) == 84 + 9 * 600 + 9 * 2
        for name in ("x", "y", "target_x", "target_y"):
            assert getattr(frame, name) == np.float32(getattr(what, name)[0]).tolist()
        assert (frame.on_target, frame.alive) == (what.on_target[0].tolist(), what.alive[0].tolist())
        assert frame.vx == frame.repulsion == frame.degree == []


class TestTheSilent:
    def test_are_marked_and_nothing_else_is(self):
        what = trajectory(12, 1)
        frames = [decode(pack(what, 0, run=0, epoch=0, gauges=GAUGES, silent=silent)) for silent in ((), (3, 9))]
        assert [each.silent for each in frames] == [[False] * 12, [agent in (3, 9) for agent in range(12)]]
        assert frames[0].alive == frames[1].alive
        assert frames[0].hears == frames[1].hears
