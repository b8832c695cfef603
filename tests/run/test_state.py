"""What changes in a run is one value: saved, restored and carried over whole, read-only but through one door."""

import numpy as np
import pytest

from scenarios import scenario
from shoal.core.agents import Bodies, Makes
from shoal.core.errors import RecordError, StrategyError
from shoal.metrics.summary import METRICS
from shoal.record.saved_state import write_state
from shoal.run.carry_over import carry_over
from shoal.run.facts import facts_of
from shoal.run.simulation import Simulation
from shoal.run.state import arrays_of
from shoal.world.radio import Air, Network
from shoal.world.targets.catalogue import TARGET_FIELDS, TARGET_MAKE, TARGET_STATE

MOVES = {"radius": 1.0, "speed": 2.0}
EVERYTHING = {
    "steps": 400,
    "fleets": [
        {"name": "slow", "count": 12, "max_speed": 1.0, "mean_lifetime": 60.0, "detection_probability": 0.7},
        {"name": "fast", "count": 8, "max_speed": 2.6, "max_turn_rate": 60.0, "false_alarm_probability": 0.1},
    ],
    "network": {"neighbors": 6, "range": 9.0, "loss": 0.1, "delay": 3, "adaptive": {"fewest": 3, "most": 12}},
    "strategy": {"name": "memory-pso"},
    "losses": [{"step": 20, "count": 2}],
    "joins": [{"step": 30, "count": 2, "fleet": "fast"}],
    "targets": [
        {"kind": "waypoint", **MOVES, "waypoint_reach": 1.5, "surface_time": 9.0, "dive_time": 3.0},
        {"kind": "levy", **MOVES, "shortest": 0.5, "longest": 9.0},
        {"kind": "evasive", **MOVES, "sight": 3.0, "wall_sight": 1.0},
        {"kind": "drift", **MOVES, "current_x": 0.3},
    ],
    "disturbances": [
        {"kind": "current", "east": 0.2, "gust": 0.1, "gust_time": 1.0},
        {"kind": "blackout", "fleet": "slow", "since": 7.0, "until": 9.0},
    ],
}


@pytest.fixture(scope="module")
def chosen():
    return scenario(changes=EVERYTHING)


@pytest.fixture
def running(chosen):
    simulation = Simulation(chosen)
    simulation.advance(77)
    return simulation


def copies(value):
    return {name: np.array(array) for name, array in arrays_of(value)}


def same(one, other):
    return [name for name, values in one.items() if values.tobytes() != other[name].tobytes()] == []


class TestWhole:
    def test_what_is_chosen_does_not_change_in_a_run(self, chosen):
        simulation = Simulation(chosen)
        stage = simulation._placed.stage
        homes = {"air": "radio", "weather": "nature"}
        names = [name.split(".", 1) for name, _ in arrays_of(simulation.moment)]
        state = {f"{homes.get(part, part)}.{rest}" for part, rest in names}
        numbers = ("world", "run", "phases")  # and no arrays
        rest = stage._replace(**dict.fromkeys(numbers, np.zeros(0)), radio=only_arrays(stage.radio), sea=stage.tracks)
        kept = lambda: {  # noqa: E731
            name: np.array(array)
            for name, array in arrays_of(rest)
            if name not in state and not name.startswith(("scratch.", "frames."))
        }
        before = kept()
        simulation.advance(200)
        assert len(before) > 30
        assert same(before, kept())

    def test_every_field_is_state_or_chosen_and_none_is_both(self, running):
        for state, make, both in ((Bodies, Makes, running.swarm), (Air, Network, running.radio)):
            assert (*state._fields, *make._fields) == both._fields
            assert not set(state._fields) & set(make._fields)
        assert TARGET_FIELDS.names == (*TARGET_STATE.names, *TARGET_MAKE.names)

    def test_a_saved_state_has_all_of_it(self, running, chosen, tmp_path):
        running.save(tmp_path / "state.npz")
        other = Simulation(chosen)
        other.restore(tmp_path / "state.npz")
        assert same(copies(running.moment), copies(other.moment))
        for each in (running, other):
            each.advance(100)
        assert same(copies(running.moment), copies(other.moment))

    def test_all_of_it_but_the_sums_is_carried_over(self, running, chosen):
        """Into the same scenario; so a field that State gains is carried over, too, or fails here."""
        new = carry_over(running, chosen)
        n = chosen.agents
        for name, mine in arrays_of(new.moment._replace(tally=new.moment.air)):
            part, field = name.split(".")[:2]
            if part == "swarm":
                assert mine[:n].tobytes() == getattr(running.swarm, field)[:n].tobytes(), name
            elif part == "air":
                assert mine[:, :n].tobytes() == getattr(running.radio, field)[:, :n].tobytes(), name
            elif part == "targets":
                assert mine.tobytes() == running.targets[field].tobytes(), name
            elif part == "weather":
                theirs = dict(arrays_of(running.moment))[name]
                agents = slice(None) if field == "clock" else slice(n)
                assert mine[..., agents].tobytes() == theirs[..., agents].tobytes(), name

    def test_a_run_that_is_carried_over_goes_on_as_it_would_have(self, running, chosen):
        new = carry_over(running, chosen)
        for each in (running, new):
            each.advance(50)
        n = chosen.agents
        for name in ("x", "y", "vx", "vy", "on_target", "alive", "neighbors", "memory"):
            assert getattr(running.swarm, name)[:n].tobytes() == getattr(new.swarm, name)[:n].tobytes()


def only_arrays(radio):
    return type(radio)(*(value if isinstance(value, np.ndarray) else np.zeros(0) for value in radio))


class TestDoor:
    @pytest.mark.parametrize(
        "array",
        [
            lambda s: s.swarm.vx,
            lambda s: s.swarm.max_speed,
            lambda s: s.targets["x"],
            lambda s: s.tally.steps,
            lambda s: s.memories.memory["best_time"],
            lambda s: s.moment.air.x,
            lambda s: s.state()["swarm.x"],
        ],
    )
    def test_what_is_looked_at_cannot_be_written_to(self, running, array):
        with pytest.raises(ValueError, match="read-only"):
            array(running)[:] = 0.0

    def test_edits_count_from_the_next_step_on(self, running):
        other = Simulation(running.scenario)
        other.advance(77)
        with other.edit() as now:
            now.swarm.vx[:] = 0.0
        assert not other.swarm.vx.any()
        for each in (running, other):
            each.advance(1)
        assert (running.swarm.x != other.swarm.x).any()

    def test_after_an_edit_the_state_is_true(self):
        simulation = Simulation(scenario())
        with simulation.edit() as now:
            now.swarm.x[:2], now.swarm.y[:2] = simulation.targets["x"], simulation.targets["y"]
        assert simulation.swarm.on_target[:2].tolist() == [True, True]
        with simulation.edit() as now:
            now.targets["x"] = now.targets["y"] = 99.0
        assert not simulation.swarm.on_target.any()

    def test_a_number_that_is_not_finite_is_refused(self, running):
        with pytest.raises(StrategyError, match="not finite"), running.edit() as now:
            now.swarm.y[0] = np.inf


class TestLook:
    """Between two calls the state is what the coming step begins with."""

    def test_it_is_the_frame_that_the_coming_step_keeps(self, chosen):
        simulation = Simulation(chosen)
        for _ in range(60):
            seen, before = simulation.look(), copies(simulation.moment)
            assert same(before, copies(simulation.moment))
            kept = simulation.advance(1, every=1)
            assert same(seen.arrays(), kept.arrays())

    def test_an_agent_is_gone_at_the_step_at_which_it_is_lost(self):
        simulation = Simulation(scenario(changes={"losses": [{"step": 5, "count": 50}]}))
        simulation.advance(4)
        assert simulation.look().alive.all()
        simulation.advance(1)
        assert not simulation.look().alive.any()
        assert not simulation.swarm.vx[:50].any()

    def test_who_is_engaged_detects_a_target_and_does_not_imagine_one(self):
        alarms = {f"fleets.{number}.false_alarm_probability": 0.5 for number in range(2)}
        simulation = Simulation(scenario(changes=alarms))
        simulation.advance(300)
        swarm, target = simulation.swarm, simulation.targets[0]
        away = np.hypot(swarm.x - target["x"], swarm.y - target["y"])
        assert swarm.engaged[:50].tolist() == (away <= 1.0)[:50].tolist()
        assert swarm.on_target[:50].sum() > swarm.engaged[:50].sum()


class TestSumsOfOtherDays:
    """A sum that only the saved state has, or only this Shoal."""

    @pytest.fixture
    def file(self, running, tmp_path):
        """Saved by a Shoal that did not count the cubes of speeds, and counted fish."""
        arrays = {name: each for name, each in running.state().items() if name != "tally.cubes"}
        write_state(tmp_path / "state.npz", running._identity(), arrays | {"tally.fish": np.ones(3)})
        return tmp_path / "state.npz"

    def test_go_on_as_unknown_and_all_others_as_ever(self, chosen, running, file):
        resumed = Simulation(chosen)
        resumed.restore(file)
        resumed.advance(40)
        running.advance(40)
        facts = facts_of(chosen)
        assert np.isnan(METRICS["power"].formula(resumed.tally, facts))
        assert METRICS["speed"].formula(resumed.tally, facts) == METRICS["speed"].formula(running.tally, facts)
        assert resumed.notes == [
            "the saved state has no sum 'cubes', so that the metrics made of it are unknown",
            "the saved state has a sum 'fish', which no installed package knows: it is dropped",
        ]

    def test_nothing_else_may_be_missing_or_more(self, chosen, running, tmp_path):
        for arrays in (
            {name: each for name, each in running.state().items() if name != "swarm.x"},
            running.state() | {"fish": np.ones(3)},
        ):
            write_state(tmp_path / "other.npz", running._identity(), arrays)
            with pytest.raises(RecordError, match="is not a saved state"):
                Simulation(chosen).restore(tmp_path / "other.npz")
