"""Same scenario, seed and run: same bits, however the run is cut, saved, threaded or batched."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scenarios import fleets, scenario, small
from shoal.run.simulate import simulate
from shoal.run.simulation import Simulation

STEPS = 120
SIZES = {2: 1, 3: 2, 64: 20, 65: 64, 500: 7}  # agents: neighbors
ORDERS = ["synchronous", "sequential"]


def swarm_of(agents, order="synchronous", **changes):
    return small(agents, SIZES[agents], {"motion.update_order": order, "steps": STEPS, **changes})


def bits(simulation):
    """All that a run leaves behind, padding apart, as bytes."""
    n, state = simulation.scenario.agents, simulation.state()
    return {name: (part[:n] if name.startswith("swarm.") else part).tobytes() for name, part in state.items()}


def run_through(chosen, run=0, steps=STEPS):
    simulation = Simulation(chosen, run)
    simulation.advance(steps)
    return simulation


def same_arrays(one, other):
    return one.keys() == other.keys() and all(one[name].tobytes() == other[name].tobytes() for name in one)


class TestCutting:
    """A run is one run, however many calls it takes."""

    @pytest.mark.parametrize("order", ORDERS)
    @pytest.mark.parametrize("agents", SIZES)
    def test_one_call_or_one_per_step(self, agents, order):
        chosen = swarm_of(agents, order)
        stepped = Simulation(chosen)
        for _ in range(STEPS):
            stepped.advance(1)
        assert bits(stepped) == bits(run_through(chosen))

    @given(chunks=st.lists(st.integers(0, 40), max_size=12), order=st.sampled_from(ORDERS))
    @settings(max_examples=25)
    def test_chunks_of_any_size(self, chunks, order):
        chosen = swarm_of(65, order)
        cut = Simulation(chosen)
        for chunk in chunks:
            cut.advance(min(chunk, STEPS - cut.number))
        cut.advance(STEPS - cut.number)
        assert bits(cut) == bits(run_through(chosen))

    @given(every=st.integers(1, 50), tail=st.integers(0, STEPS + 10))
    @settings(max_examples=15)
    def test_frames_recorded_or_not(self, every, tail):
        watched = Simulation(swarm_of(64))
        watched.advance(STEPS, every=every, tail=tail)
        assert bits(watched) == bits(run_through(swarm_of(64)))

    @given(cuts=st.lists(st.integers(0, STEPS), max_size=6), every=st.integers(1, 50), tail=st.integers(0, STEPS + 10))
    @settings(max_examples=25)
    def test_the_frames_of_the_parts_are_the_frames_of_the_whole(self, cuts, every, tail):
        whole = Simulation(swarm_of(3)).advance(STEPS, every=every, tail=tail)
        cut = Simulation(swarm_of(3))
        parts = [cut.advance(end - cut.number, every=every, tail=tail) for end in [*sorted(cuts), STEPS]]
        joined = type(whole).join([part for part in parts if part])
        assert joined.step.tolist() == [t for t in range(STEPS) if t % every == 0 or t >= tail]
        assert same_arrays(joined.arrays(), whole.arrays())

    def test_a_frame_is_the_state_at_the_start_of_its_step(self):
        chosen = swarm_of(65)
        frames = Simulation(chosen).advance(STEPS, every=1)
        stepped = Simulation(chosen)
        for t in range(STEPS):
            swarm, target = stepped.swarm, stepped.targets[0]
            assert frames.x[t].tolist() == swarm.x[:65].tolist()
            assert frames.vy[t].tolist() == swarm.vy[:65].tolist()
            assert frames.memory["repulsion"][t].tolist() == stepped.memories.memory["repulsion"][:65].tolist()
            assert (frames.target_x[t, 0], frames.target_y[t, 0]) == (target["x"], target["y"])
            assert frames.on_target[t].tolist() == swarm.on_target[:65].tolist()
            stepped.advance(1)


class TestSaving:
    """A run saved and restored goes on as if nothing had been."""

    @given(saved=st.integers(0, STEPS), agents=st.sampled_from(list(SIZES)), order=st.sampled_from(ORDERS))
    @settings(max_examples=20)
    def test_at_any_step(self, tmp_path_factory, saved, agents, order):
        chosen, file = swarm_of(agents, order), tmp_path_factory.mktemp("saved") / "state.npz"
        run_through(chosen, steps=saved).save(file)
        resumed = Simulation(chosen)
        resumed.advance(7)  # what it did before is forgotten
        resumed.restore(file)
        assert resumed.number == saved
        resumed.advance(STEPS - saved)
        assert bits(resumed) == bits(run_through(chosen))


class TestThreadsAndBatches:
    """Who else runs, and where, changes nothing."""

    @pytest.mark.parametrize(("order", "steps"), [("synchronous", 20_000), ("sequential", 2_000)])
    def test_one_thread_or_two(self, order, steps):
        chosen = scenario("oceans2020", {"steps": steps, "motion.update_order": order})
        alone, together = (simulate(chosen, runs=4, jobs=jobs, every=100) for jobs in (1, 2))
        for one, other in zip(alone.tallies, together.tallies, strict=True):
            assert same_arrays(one._asdict(), other._asdict())
        for run in range(4):
            assert same_arrays(alone.trajectories[run].arrays(), together.trajectories[run].arrays())

    def test_run_3_alone_is_run_3_of_5(self):
        chosen = swarm_of(64)
        batch = simulate(chosen, runs=5, jobs=2)
        assert same_arrays(batch.tallies[3]._asdict(), run_through(chosen, run=3).tally._asdict())

    def test_more_runs_do_not_change_the_first(self):
        few, many = (simulate(swarm_of(3), runs=runs) for runs in (2, 5))
        assert few.estimate("xi").runs == many.estimate("xi").runs[:2]

    def test_two_simulations_side_by_side_do_not_meet(self):
        one, other = Simulation(swarm_of(64)), Simulation(swarm_of(64), run=1)
        for _ in range(STEPS):
            one.advance(1)
            other.advance(1)
        assert bits(one) == bits(run_through(swarm_of(64)))


class TestChance:
    """The seed and the run decide, and both matter."""

    @pytest.mark.parametrize("agents", SIZES)
    def test_the_same_again(self, agents):
        assert bits(run_through(swarm_of(agents))) == bits(run_through(swarm_of(agents)))

    def test_every_seed_and_run_is_another_world(self):
        states = [
            run_through(swarm_of(64, seed=seed), run=run).swarm.x[:64].tobytes()
            for seed in (0, 1, 2**63, 2**64 - 1)
            for run in range(3)
        ]
        assert len(set(states)) == 12

    def test_two_scenarios_with_one_seed_share_start_and_target(self):
        """Paired comparisons live on this: another k, the same chance."""
        one, other = Simulation(small(50, 5), run=2), Simulation(small(50, 45), run=2)
        assert one.swarm.x.tobytes() == other.swarm.x.tobytes()
        for simulation in (one, other):
            simulation.advance(500)
        for field in ("x", "y", "heading_x", "heading_y", "waypoint_x", "waypoint_y"):
            assert one.targets[field].tobytes() == other.targets[field].tobytes()
        assert one.swarm.x.tobytes() != other.swarm.x.tobytes()

    def test_name_and_description_decide_nothing(self):
        other = swarm_of(64, name="x", description="y")
        assert run_through(other).swarm.x.tobytes() == run_through(swarm_of(64)).swarm.x.tobytes()


def crowd(name, n):
    """Places where numbers could break."""
    at = np.arange(n)
    return {
        "all at the center": (np.zeros(n), np.zeros(n)),
        "all in one corner": (np.full(n, 8.5), np.full(n, -8.5)),
        "two heaps": (np.where(at % 2, 3.0, -3.0), np.zeros(n)),
        "a line of equal distances": ((at - n / 2) / n, np.zeros(n)),
        "hair's breadths apart": (1e-9 * at, np.zeros(n)),
        "atoms apart": (1e-13 * at, 1e-13 * at**2),
        "one alone": (np.where(at == 0, -8.0, 8.0), np.where(at == 0, -8.0, 8.0)),
    }[name]


class TestCrowds:
    """Agents at one place, in one corner or at equal distances: the numbers stay numbers."""

    @pytest.mark.parametrize("order", ORDERS)
    @pytest.mark.parametrize("agents", [2, 3, 64, 65])
    @pytest.mark.parametrize(
        "name",
        ["all at the center", "all in one corner", "two heaps", "a line of equal distances", "hair's breadths apart",
         "atoms apart", "one alone"],
    )  # fmt: skip
    def test_stay_finite_in_the_arena_and_below_their_top_speed(self, name, agents, order):
        simulation = Simulation(swarm_of(agents, order))
        swarm = simulation.swarm
        with simulation.edit() as now:
            now.swarm.x[:agents], now.swarm.y[:agents] = crowd(name, agents)
            now.targets["x"], now.targets["y"] = swarm.x[0], swarm.y[0]  # the target on top of them
        for _ in range(STEPS):
            simulation.advance(1)
            assert np.isfinite([swarm.x, swarm.y, swarm.vx, swarm.vy]).all()
            assert np.isfinite(simulation.memories.memory["repulsion"]).all()
            assert np.abs([swarm.x[:agents], swarm.y[:agents]]).max() <= 8.5
            assert np.hypot(swarm.vx[:agents], swarm.vy[:agents]).max() <= 1.0 + 1e-12
        assert np.isfinite(simulation.tally.fluctuation).all()
        assert simulation.tally.histogram.sum() == STEPS * agents

    @pytest.mark.parametrize(
        "exponent",
        [
            0.0,
            1.0,
            12.0,
            24.0,
            40.0,
        ],
    )
    def test_stay_finite_under_any_exponent(self, exponent):
        simulation = Simulation(swarm_of(64, **{"strategy.repulsion_exponent": exponent}))
        with simulation.edit() as now:
            now.swarm.x[:64], now.swarm.y[:64] = crowd("two heaps", 64)
        simulation.advance(STEPS)
        assert np.isfinite([simulation.swarm.x, simulation.swarm.y]).all()

    def test_a_crowd_repeats_itself_too(self):
        ends = []
        for chunk in (1, 30, STEPS):
            simulation = Simulation(swarm_of(65))
            with simulation.edit() as now:
                now.swarm.x[:65], now.swarm.y[:65] = crowd("two heaps", 65)
            while simulation.number < STEPS:
                simulation.advance(chunk)
            ends.append(bits(simulation))
        assert ends[0] == ends[1] == ends[2]


class TestTies:
    """Of two equally far the lower index is heard."""

    @staticmethod
    def pushes(x, y, neighbors):
        """What the nearest push, chosen by a plain sort: sum of r^-6 times the unit vector away."""
        n, total = len(x), np.zeros((len(x), 2))
        for i in range(n):
            squares = [(x[i] - x[j]) ** 2 + (y[i] - y[j]) ** 2 for j in range(n)]
            nearest = sorted((j for j in range(n) if j != i), key=lambda j: (squares[j], j))[:neighbors]
            for j in nearest:
                if squares[j] > 0.0:
                    total[i] += np.array([x[i] - x[j], y[i] - y[j]]) / squares[j] ** 3.5
        return total

    @pytest.mark.parametrize("neighbors", [1, 2, 3, 4, 5, 8, 12, 13, 20, 47, 63])
    @pytest.mark.parametrize("shape", ["grid", "ring", "heaps"])
    def test_in_a_regular_pattern(self, shape, neighbors):
        at = np.arange(64)
        x, y = {
            "grid": (at % 8 - 3.0, at // 8 - 4.0),
            "ring": (np.where(at % 2, 1.0, -1.0) * (1 + at // 8), np.where(at // 2 % 2, 1.0, -1.0) * (1 + at // 8)),
            "heaps": (2.0 * (at % 4), 2.0 * (at % 3)),
        }[shape]
        order = np.random.default_rng(7).permutation(64)
        x, y = x[order], y[order]
        chosen = scenario(
            "oceans2020",
            {
                "fleets": fleets((64, 1e9)),
                "network.neighbors": neighbors,
                "area": {"width": 1e12, "height": 1e12},
                "strategy.social": 0.0,
                "strategy.inertia": 0.0,
                "strategy.repulsion_start": 1.0,
                "strategy.delta": 0.0,
            },
        )
        simulation = Simulation(chosen)
        with simulation.edit() as now:
            now.swarm.x[:64], now.swarm.y[:64] = x, y
        simulation.advance(1)
        velocity = np.stack([simulation.swarm.vx[:64], simulation.swarm.vy[:64]], axis=1)
        np.testing.assert_allclose(velocity * chosen.time_step, self.pushes(x, y, neighbors), rtol=1e-12, atol=1e-13)
