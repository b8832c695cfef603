"""A stage in memory: of one type, refused before it is written, and in place as long as somebody holds it."""

import numpy as np
import pytest

from scenarios import small
from shoal.compiler.late import compiles
from shoal.compiler.placed import Placed
from shoal.run.simulation import Simulation

pytestmark = pytest.mark.skipif(not compiles(), reason="without a compiler nothing is placed")


@pytest.fixture(scope="module")
def stage():
    return Simulation(small(5, 2))._placed.stage


def changed(stage, part, **fields):
    return stage._replace(**{part: getattr(stage, part)._replace(**fields)})


class TestTypes:
    @pytest.mark.parametrize(
        ("part", "fields", "words"),
        [
            ("world", {"half_x": 10}, "stage.world.half_x is int64, where all have float64"),
            ("world", {"time_step": np.float32(0.1)}, "stage.world.time_step is float32, where all have float64"),
            ("swarm", {"x": np.zeros(8, np.float32)}, r"stage.swarm.x is float32\[:\] in C order"),
            ("swarm", {"x": np.zeros((8, 1))}, r"stage.swarm.x is float64\[:, :\] in C order"),
            ("swarm", {"memory": np.zeros((1, 8)).T[::2]}, "stage.swarm.memory .* in A order, where"),
            ("run", {"seed": 1}, "stage.run.seed is int64, where all have uint64"),
        ],
    )
    def test_another_is_refused_by_name(self, stage, part, fields, words):
        with pytest.raises(TypeError, match=words):
            Placed(changed(stage, part, **fields))

    def test_an_array_that_cannot_be_written_is_refused(self, stage):
        fixed = stage.swarm.x.view()
        fixed.flags.writeable = False
        with pytest.raises(TypeError, match="read-only"):
            Placed(changed(stage, "swarm", x=fixed))

    def test_numpys_numbers_of_the_same_type_are_not(self, stage):
        Placed(changed(stage, "world", half_x=np.float64(10.0)))

    def test_any_number_of_agents_is_one_type(self):
        for agents in (2, 9, 64):
            Simulation(small(agents, 1)).advance(1)


class TestSimulation:
    def test_refuses_a_world_of_another_type_and_stays_as_it_is(self):
        simulation = Simulation(small(5, 2))
        before = simulation.swarm.x.copy()
        simulation.world = simulation.world._replace(half_x=10)
        with pytest.raises(TypeError, match=r"world\.half_x is int64"):
            simulation.advance(5)
        assert simulation.number == 0
        assert simulation.swarm.x.tolist() == before.tolist()

    def test_stays_in_place_from_call_to_call(self):
        simulation = Simulation(small(5, 2))
        simulation.look()  # from now on it has what frames need
        simulation.advance(3)
        placed = simulation._placed
        simulation.advance(3, every=1)
        simulation.advance(1)
        assert simulation._placed is placed

    def test_is_placed_anew_when_the_world_changes(self):
        simulation, other = Simulation(small(5, 2)), Simulation(small(5, 2))
        for each in (simulation, other):
            each.advance(2)
        simulation.world = simulation.world._replace(clamp_x=1.0)
        for each in (simulation, other):
            each.advance(20)
        assert np.abs(simulation.swarm.x[:5]).max() <= 1.0 < np.abs(other.swarm.x[:5]).max()
