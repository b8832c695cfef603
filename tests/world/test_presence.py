"""Agents that are lost, fail or join during a run."""

import numpy as np
import pytest

from scenarios import fleets, scenario, small
from shoal.core.errors import ScenarioError
from shoal.run.simulation import Simulation

ORDERS = ["synchronous", "sequential"]
WAVES = {
    "losses": [{"step": 100, "count": 25}],
    "joins": [{"step": 200, "count": 50, "fleet": "BoB-0"}],
    "steps": 300,
}


def there(simulation, steps):
    """Who is alive at the start of each step, (K, N)."""
    return simulation.advance(steps, every=1).alive


class TestCounts:
    """How many are there, step by step."""

    @pytest.mark.parametrize("order", ORDERS)
    def test_50_then_25_then_75(self, order):
        simulation = Simulation(scenario("oceans2020", {**WAVES, "motion.update_order": order}))
        alive = there(simulation, 300).sum(axis=1)
        assert alive.tolist() == [50] * 100 + [25] * 100 + [75] * 100
        assert simulation.tally.agent_steps.sum() == alive.sum()

    def test_of_one_fleet_only(self):
        changes = {"losses": [{"step": 3, "count": 10, "fleet": "BoB-1"}, {"step": 6, "count": 30, "fleet": "BoB-0"}]}
        alive = there(Simulation(scenario("oceans2020", changes)), 9)
        fast, slow = alive[:, :15].sum(axis=1), alive[:, 15:].sum(axis=1)
        assert fast.tolist() == [15] * 3 + [5] * 6
        assert slow.tolist() == [35] * 6 + [5] * 3

    def test_of_several_losses_at_one_step_add_up(self):
        changes = {
            "losses": [{"step": 2, "count": 5}, {"step": 2, "count": 6, "fleet": "BoB-1"}, {"step": 2, "count": 7}]
        }
        assert there(Simulation(scenario("oceans2020", changes)), 4).sum(axis=1).tolist() == [50, 50, 32, 32]

    def test_those_who_join_are_the_last_of_their_fleet(self):
        joins = [{"step": 4, "count": 2, "fleet": "make 0"}, {"step": 2, "count": 1, "fleet": "make 0"}]
        chosen = scenario("oceans2020", {"fleets": fleets((3, 1.0), (4, 1.0)), "joins": joins, "network.neighbors": 2})
        alive = there(Simulation(chosen), 6)
        joined = alive.argmax(axis=0)
        assert joined.tolist() == [0, 0, 0, 4, 4, 2, 0, 0, 0, 0]

    def test_who_joined_may_be_lost(self):
        changes = {
            "joins": [{"step": 1, "count": 5, "fleet": "a"}],
            "losses": [{"step": 3, "count": 7}],
            "network.neighbors": 2,
        }
        makes = [{"name": "a", "count": 2, "max_speed": 1.0}]
        simulation = Simulation(scenario("oceans2020", {**changes, "fleets": makes}))
        assert there(simulation, 5).sum(axis=1).tolist() == [2, 7, 7, 0, 0]

    def test_more_than_there_are_cannot_be_lost(self):
        with pytest.raises(ScenarioError, match="'BoB-1' has 15"):
            scenario("oceans2020", {"losses": [{"step": 2, "count": 16, "fleet": "BoB-1"}]})
        with pytest.raises(ScenarioError, match="51 agents are lost in all"):
            scenario("oceans2020", {"losses": [{"step": 2, "count": 50}, {"step": 3, "count": 1}]})

    def test_nobody_left_is_no_error(self):
        simulation = Simulation(scenario("oceans2020", {"losses": [{"step": 5, "count": 50}]}))
        simulation.advance(20)
        assert np.isfinite(simulation.tally.fluctuation).all()
        assert simulation.tally.agent_steps.sum() == 250


class TestChance:
    """Who is lost is a matter of the seed and the run."""

    def test_every_agent_is_as_likely_lost(self):
        chosen = small(10, 3, {"losses": [{"step": 1, "count": 4}]})
        lost = np.zeros(10)
        for run in range(400):
            lost += ~there(Simulation(chosen, run), 2)[1]
        assert lost.sum() == 1600
        assert ((lost - 160) ** 2 / (160 * 0.6)).sum() * 9 / 10 < 27.9  # 99.9 % of 9 degrees of freedom

    def test_the_same_run_loses_the_same(self):
        one, other = (there(Simulation(scenario("oceans2020", WAVES), 3), 150)[-1] for _ in range(2))
        assert one.tolist() == other.tolist()
        assert one.tolist() != there(Simulation(scenario("oceans2020", WAVES), 4), 150)[-1].tolist()


class TestLifetimes:
    """Failures at a constant rate: lifetimes are exponential."""

    def test_have_their_mean_and_their_distribution(self):
        chosen = small(2000, 3, {"fleets.0.mean_lifetime": 40.0})
        simulation = Simulation(chosen)
        lives = 0.1 * (simulation.swarm.leaves[:2000] - 0.5)  # an agent's last step is the one it fails in
        assert abs(lives.mean() - 40.0) < 5 * 40.0 / np.sqrt(2000)
        ordered = np.sort(lives)
        distance = np.abs(1 - np.exp(-ordered / 40.0) - np.arange(1, 2001) / 2000).max()
        assert distance < 1.95 / np.sqrt(2000) + 0.1 / 40  # Kolmogorov-Smirnov, 0.1 %, and a step

    def test_are_of_their_fleet(self):
        makes = fleets((100, 1.0), (100, 1.0))
        makes[0]["mean_lifetime"] = "1 s"
        alive = there(Simulation(scenario("oceans2020", {"fleets": makes})), 200)
        assert alive[:, 100:].all()
        assert alive[-1, :100].sum() < 5

    def test_begin_when_an_agent_joins(self):
        changes = {"fleets.0.mean_lifetime": 5.0, "joins": [{"step": 1000, "count": 300, "fleet": "make 0"}]}
        swarm = Simulation(small(10, 3, changes)).swarm
        lives = 0.1 * (swarm.leaves - swarm.joins)[10:310]
        assert lives.min() > 0
        assert abs(lives.mean() - 5.0) < 5 * 5.0 / np.sqrt(300)


class TestAbsent:
    """Who is not there neither senses nor speaks nor moves."""

    @pytest.fixture(params=ORDERS)
    def frames(self, request):
        changes = {**WAVES, "motion.update_order": request.param, "targets.0.radius": 3.0, "strategy": "encircle"}
        return Simulation(scenario("oceans2020", changes)).advance(300, every=1)

    def test_does_not_move(self, frames):
        """From step 1 on: who starts in the margin is put inside first of all."""
        still = ~frames.alive[1:-1]
        assert (np.diff(frames.x, axis=0)[1:][still] == 0).all()
        assert (np.diff(frames.y, axis=0)[1:][still] == 0).all()
        assert (frames.vx[2:][still] == 0).all()
        assert still.sum() > 1000

    def test_does_not_sense(self, frames):
        assert not frames.on_target[~frames.alive].any()
        assert frames.on_target.any()

    def test_does_not_think(self, frames):
        """Before it joins, an agent remembers what it was told ashore."""
        for name, values in frames.memory.items():
            assert (values[:200, 50:] == values[0, 50:]).all(), name
        assert (frames.memory["contact"][-1, 50:] > 0).any()

    @pytest.mark.parametrize("order", ORDERS)
    def test_does_not_speak_or_listen(self, order):
        """Nothing of the absent is heard: a swarm in which half were lost hears as one that was half from the start."""
        changes = {"losses": [{"step": 1, "count": 10, "fleet": "make 1"}], "motion.update_order": order}
        makes = {"fleets": fleets((10, 1.0), (10, 1.0)), "network.neighbors": 15}
        simulation = Simulation(scenario("oceans2020", {**makes, **changes}))
        simulation.advance(1)
        before = simulation.tally.heard.sum()
        simulation.advance(50)
        assert before == 20 * 15
        assert simulation.tally.heard.sum() - before == 50 * 10 * 9

    def test_is_as_if_it_had_never_been(self):
        """Those who join after the end change nothing but the numbers that all are told."""
        joins = {"joins": [{"step": 1000, "count": 7, "fleet": "make 0"}]}
        plain, other = Simulation(small(30, 5)), Simulation(small(30, 5, joins))
        plain.advance(300)
        other.advance(300)
        assert other.swarm.x[:30].tobytes() == plain.swarm.x[:30].tobytes()
        assert other.tally.heard.tolist() == plain.tally.heard.tolist()
        assert other.tally.fluctuation.tolist() == plain.tally.fluctuation.tolist()
        assert other.tally.clustering.tolist() == plain.tally.clustering.tolist()

    def test_last_words_still_arrive(self):
        """With a delay of d steps an agent is heard until d steps after it was lost."""
        changes = {"losses": [{"step": 50, "count": 1, "fleet": "make 1"}], "network.delay": 4}
        makes = {"fleets": fleets((1, 1.0), (1, 1.0)), "network.neighbors": 1}
        simulation = Simulation(scenario("oceans2020", {**makes, **changes}))
        heard = []
        for _ in range(60):
            before = simulation.tally.heard.sum()
            simulation.advance(1)
            heard.append(int(simulation.tally.heard.sum() - before))
        assert heard == [0] * 4 + [2] * 46 + [1] * 4 + [0] * 6


class TestJoining:
    """Where and when they should."""

    def test_start_where_their_fleet_starts_at_rest(self):
        changes = {"fleets.0.start": "corner", "joins": [{"step": 20, "count": 40, "fleet": "make 0"}]}
        frames = Simulation(small(10, 5, changes)).advance(30, every=1)
        assert frames.x[20, 10:].max() <= -0.8 * 8.5  # a tenth of the side of where they may go
        assert frames.y[20, 10:].max() <= -0.8 * 8.5
        assert (frames.vx[20, 10:] == 0).all()
        assert (frames.vx[21, 10:] != 0).any()

    def test_are_there_from_their_step_on(self):
        simulation = Simulation(small(10, 5, {"joins": [{"step": 7, "count": 3, "fleet": "make 0"}]}))
        assert simulation.swarm.alive[:13].tolist() == [1.0] * 10 + [0.0] * 3
        assert there(simulation, 12)[:, 10:].all(axis=1).argmax() == 7

    def test_cutting_a_run_into_calls_changes_nothing(self):
        one, other = (Simulation(scenario("oceans2020", WAVES)) for _ in range(2))
        one.advance(300)
        for _ in range(60):
            other.advance(5, every=1)
        assert one.swarm.x.tobytes() == other.swarm.x.tobytes()
        assert one.tally.covered.tolist() == other.tally.covered.tolist()
