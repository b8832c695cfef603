"""Who detects a target."""

import numpy as np
import pytest

from coasting import coasting
from scenarios import fleets, scenario
from shoal.run.simulation import Simulation
from shoal.world.sensing import glimpsed

STAY = [(0.0, 0.0)] * 3
PLACES = [(0.0, 0.0), (9.0, 9.0), (9.0, -9.0)]


def within(share, number, expected):
    """Whether a share of so many draws is within 5 standard errors of what is expected."""
    return abs(share - expected) < 5 * np.sqrt(expected * (1 - expected) / number)


class TestRange:
    """Sensor radius of the agent's fleet, plus the target's own."""

    @pytest.mark.parametrize(("distance", "fast", "slow"), [(1.0, 1, 1), (1.4, 1, 1), (1.6, 1, 0), (3.1, 0, 0)])
    def test_is_that_of_the_fleet(self, distance, fast, slow):
        makes = fleets((1, 1.0), (1, 1.0))
        makes[0]["sensor_radius"], makes[1]["sensor_radius"] = 2.0, 0.5
        still = {"kind": "still", "radius": 1.0}
        changes = {"fleets": makes, "network.neighbors": 1, "targets": [still]}
        for agent, sees in enumerate((fast, slow)):
            simulation = Simulation(scenario("oceans2020", changes))
            with simulation.edit() as now:
                now.swarm.x[:2], now.swarm.y[:2] = 9.0, 9.0
            with simulation.edit() as now:
                now.swarm.x[agent], now.swarm.y[agent] = distance, 0.0
            simulation.advance(1)
            assert simulation.tally.engaged.sum() == sees

    def test_has_the_target_radius_in_it(self):
        simulation = coasting(PLACES, STAY, targets=[(4.0, 0.0), (4.0, 0.0)])
        simulation._targets["radius"] = 3.9, 4.0
        simulation.advance(1)
        assert simulation.tally.watched.sum(axis=0).tolist() == [0.0, 1.0]


class TestDetection:
    """A target within reach is noticed with the fleet's probability, in every step anew."""

    @pytest.mark.parametrize("chance", [0.1, 0.5, 0.9])
    def test_has_its_share(self, chance):
        simulation = coasting(PLACES, STAY, steps=5000, **{"fleets.0.detection_probability": chance})
        simulation.advance(5000)
        assert within(simulation.tally.engaged.sum() / 5000, 5000, chance)

    def test_of_several_agents_and_steps_is_independent(self):
        """Two agents on a target: it is seen with 1 - (1 - p)^2; and one step says nothing about the next."""
        places = [(0.0, 0.0), (0.5, 0.0), (9.0, 9.0)]
        simulation = coasting(places, STAY, steps=5000, **{"fleets.0.detection_probability": 0.4})
        frames = simulation.advance(5000, every=1)
        assert within(simulation.tally.on_target.sum() / 5000, 5000, 1 - 0.6**2)
        seen = frames.on_target[:, 0]
        assert within((seen[1:] & seen[:-1]).mean(), 4999, 0.16)

    def test_of_several_targets_is_independent(self):
        simulation = coasting(
            PLACES, STAY, targets=[(0.5, 0.0), (-0.5, 0.0)], steps=5000, **{"fleets.0.detection_probability": 0.4}
        )
        simulation.advance(5000)
        watched = simulation.tally.watched.sum(axis=0)
        assert all(within(each / 5000, 5000, 0.4) for each in watched)
        assert within(simulation.tally.on_target.sum() / 5000, 5000, 1 - 0.6**2)

    def test_of_0_is_blindness_and_of_1_the_paper(self):
        blind = coasting(PLACES, STAY, **{"fleets.0.detection_probability": 0.0})
        blind.advance(20)
        assert blind.tally.engaged.sum() == 0
        sure, plain = (
            Simulation(scenario("oceans2020", changes))
            for changes in ({"fleets.0.detection_probability": 1.0, "fleets.1.false_alarm_probability": 1e-18}, {})
        )
        sure.advance(300)
        plain.advance(300)
        assert sure.world.imperfect
        assert sure.swarm.x.tobytes() == plain.swarm.x.tobytes()

    def test_beyond_the_range_nothing_is_detected(self):
        simulation = coasting([(1.1, 0.0), *PLACES[1:]], STAY, **{"fleets.0.detection_probability": 0.9})
        simulation.advance(20)
        assert simulation.tally.engaged.sum() == 0


class TestFalseAlarms:
    """An agent reports a target that is not there: others believe it, the metrics do not."""

    def test_set_on_target_in_their_share(self):
        simulation = coasting([(9, 9), (9, -9), (-9, 9)], STAY, steps=4000, **{"fleets.0.false_alarm_probability": 0.2})
        frames = simulation.advance(4000, every=1)
        assert within(frames.on_target.mean(), 12000, 0.2)

    def test_count_as_nobodys_watch(self):
        simulation = coasting([(9, 9), (9, -9), (-9, 9)], STAY, **{"fleets.0.false_alarm_probability": 1.0})
        simulation.advance(20)
        tally = simulation.tally
        assert simulation.swarm.on_target[:3].all()
        assert (tally.engaged.sum(), tally.on_target.sum(), tally.watched.sum()) == (0, 0, 0)
        assert tally.undetected.sum() == 20

    def test_draw_the_others(self):
        """The paper's swarm gathers around a buoy that cries wolf."""
        makes = fleets((1, 1e-3), (20, 2.0))
        makes[0]["false_alarm_probability"] = 1.0
        changes = {"fleets": makes, "network.neighbors": "all", "targets.0.radius": 0.0}
        simulation = Simulation(scenario("oceans2020", changes))
        swarm = simulation.swarm
        before = np.hypot(swarm.x[1:21] - swarm.x[0], swarm.y[1:21] - swarm.y[0]).mean()
        simulation.advance(300)
        assert np.hypot(swarm.x[1:21] - swarm.x[0], swarm.y[1:21] - swarm.y[0]).mean() < before / 2

    def test_are_raised_while_the_target_is_down_too(self):
        simulation = coasting([(9, 9), (9, -9), (-9, 9)], STAY, **{"fleets.0.false_alarm_probability": 1.0})
        with simulation.edit() as now:
            now.targets["present"] = 0
        simulation.advance(5)
        assert simulation.swarm.on_target[:3].all()


class TestInverseCube:
    """Koopman's law: the rate of detection falls with the cube of the range."""

    RATE = np.log(2) * 1.5**3 / 2.0  # half of all targets at 1.5 m, in 2 s

    def test_the_chance_in_a_time_is_the_same_however_it_is_cut(self):
        whole = glimpsed(1.2, self.RATE, 1.0)
        for parts in (2, 10, 1000):
            assert 1 - (1 - glimpsed(1.2, self.RATE, 1.0 / parts)) ** parts == pytest.approx(whole, rel=1e-9)

    def test_is_a_half_at_the_radius_in_the_time(self):
        assert glimpsed(1.5, self.RATE, 2.0) == pytest.approx(0.5)
        assert glimpsed(3.0, self.RATE, 2.0) == pytest.approx(1 - 0.5 ** (1 / 8))
        assert glimpsed(0.0, self.RATE, 1e-9) == 1.0

    @pytest.mark.parametrize("across", [2.0, 5.0])
    def test_a_target_that_passes_is_found_with_the_chance_of_the_lateral_range_curve(self, across):
        """1 - exp(-2 m / (v x^2)), the product over the steps of a straight passage."""
        speed, step = 3.0, 0.01
        along = np.arange(-300.0, 300.0, speed * step)
        missed = np.prod([1 - glimpsed(np.hypot(across, each), self.RATE, step) for each in along])
        assert 1 - missed == pytest.approx(1 - np.exp(-2 * self.RATE / (speed * across**2)), rel=1e-3)

    def test_an_agent_that_stays_detects_at_its_rate(self):
        places = [(2.5, 0.0), (9.0, 9.0)]
        changes = {"fleets.0.sensor": "inverse-cube", "fleets.0.sensor_radius": 1.5, "fleets.0.sensor_time": 2.0}
        simulation = coasting(places, STAY[:2], steps=5000, **changes)
        frames = simulation.advance(5000, every=1)
        chance = -np.expm1(-self.RATE * 0.1 / 1.5**3)  # of the rim, a radius of 1 m nearer
        assert within(frames.on_target[:, 0].mean(), 5000, chance)
