"""A frame as bytes: what is packed comes out of a decoder that knows only the protocol's page."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from frames import decode
from shoal.viewer.frame import Gauges, pack


def packed(agents, targets, seed=0, **changes):
    chance = np.random.default_rng(seed)
    what = {
        "run": 1,
        "epoch": 3,
        "step": 123_456,
        "gauges": Gauges(0.5, float("nan"), 0.25, 0.75, 7.0, np.arange(11.0)),
        "agents": {
            **{name: chance.normal(size=agents) for name in ("x", "y", "vx", "vy", "repulsion")},
            "degree": chance.integers(1, 10_000, agents),
            "on_target": chance.random(agents) < 0.5,
            "alive": chance.random(agents) < 0.5,
        },
        "targets": {
            "x": chance.normal(size=targets),
            "y": chance.normal(size=targets),
            "present": chance.random(targets) < 0.5,
        },
        **changes,
    }
    return what, pack(**what)


class TestPack:
    @given(agents=st.integers(2, 70), targets=st.integers(1, 5), seed=st.integers(0, 99))
    def test_everything_comes_back(self, agents, targets, seed):
        what, data = packed(agents, targets, seed)
        frame = decode(data)
        assert frame.size == len(data) == 84 + 23 * agents + 9 * targets
        assert (frame.run, frame.epoch, frame.step) == (1, 3, 123_456)
        for name in ("x", "y", "vx", "vy", "repulsion"):
            assert getattr(frame, name) == [float(np.float32(each)) for each in what["agents"][name]]
        assert frame.degree == list(what["agents"]["degree"])
        assert frame.on_target == list(what["agents"]["on_target"])
        assert frame.alive == list(what["agents"]["alive"])
        assert frame.target_x == [float(np.float32(each)) for each in what["targets"]["x"]]
        assert frame.present == list(what["targets"]["present"])

    def test_gauges_stand_in_the_order_of_the_protocol(self):
        frame = decode(packed(3, 1)[1])
        assert (frame.time_on_target, frame.xi, frame.xi_now, frame.engaged) == (0.5, 0.25, 0.75, 7.0)
        assert np.isnan(frame.recent)
        assert frame.phi == list(range(11))

    def test_epochs_are_counted_modulo_65536(self):
        assert decode(packed(2, 1, epoch=65_536 + 5)[1]).epoch == 5

    @pytest.mark.parametrize("agents", [50, 10_000])
    def test_an_agent_costs_23_bytes(self, agents):
        assert len(packed(agents, 1)[1]) == 93 + 23 * agents
