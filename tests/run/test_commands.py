"""Commands in the simulator: obeyed from their step on, however a run is cut, saved, resumed or changed as it goes."""

import numpy as np
import pytest

from scenarios import scenario
from shoal.run.carry_over import carry_over
from shoal.run.simulation import Simulation
from shoal.scenario.commands import Command
from shoal.world.orders import ORDERS

COMMANDS = [
    {"step": 10, "order": "hold", "agents": [0, 20]},
    {"step": 20, "set": {"neighbors": 7, "strategy.delta": 0.5}},
    {"step": 30, "order": "recall"},
    {"step": 150, "order": "resume", "agents": [1]},
]
STEPS = 160


@pytest.fixture(scope="module")
def planned():
    return scenario("oceans2020", {"steps": STEPS, "commands": COMMANDS})


@pytest.fixture(scope="module")
def ended(planned):
    simulation = Simulation(planned)
    return simulation, simulation.advance(STEPS, every=1)


def sums(simulation):
    return {name: array for name, array in simulation.state().items() if name.startswith("tally.")}


def same(one, other):
    return all(np.array_equal(array, other[name], equal_nan=True) for name, array in one.items())


def test_who_holds_wants_nothing_from_that_step_on(ended):
    frames = ended[1]
    assert np.hypot(frames.command_x[10, [0, 20]], frames.command_y[10, [0, 20]]).all()
    assert not frames.command_x[11:31, [0, 20]].any()
    assert np.hypot(frames.command_x[11:31, 1], frames.command_y[11:31, 1]).all()


def test_who_holds_goes_on_sensing_and_being_heard(ended):
    links = np.unpackbits(ended[1].links[25], axis=-1, bitorder="little")[:, :50]
    assert links[:, 0].any()
    assert links[0].any()


def test_who_is_recalled_goes_straight_home_at_top_speed_and_stops_there(ended):
    simulation, frames = ended
    home = np.stack([frames.x[0], frames.y[0]])
    away = np.hypot(*(np.stack([frames.x, frames.y], axis=1) - home).transpose(1, 0, 2))
    top = simulation.roster.max_speed * 0.1
    still_far = (away[30:149] > top) & (away[31:150] > top)
    made = (away[30:149] - away[31:150])[still_far]
    assert still_far.sum() > 100
    assert np.allclose(made, np.broadcast_to(top, still_far.shape)[still_far])
    assert away[149].max() < 1e-9
    assert away[152, 1] > 0.01


def test_what_is_set_is_set_from_that_step_on(ended):
    simulation, frames = ended
    assert (frames.neighbors[19] == 20).all()
    assert (frames.neighbors[20] == 7).all()
    assert simulation.crew.params.delta == 0.5


def test_no_bit_depends_on_how_a_run_is_cut(planned, ended):
    simulation = Simulation(planned)
    for steps in (9, 1, 1, 18, 2, 100, STEPS - 131):
        simulation.advance(steps)
    assert same(simulation.state(), ended[0].state())


@pytest.mark.parametrize("step", [10, 25, 149])
def test_a_resumed_run_goes_on_under_its_orders(planned, ended, tmp_path, step):
    first = Simulation(planned)
    first.advance(step)
    first.save(tmp_path / "state.npz")
    second = Simulation(planned)
    second.advance(155)
    second.restore(tmp_path / "state.npz")
    second.advance(STEPS - step)
    assert same(second.state(), ended[0].state())


def test_what_is_carried_over_goes_on_under_its_orders(planned, ended):
    old = Simulation(planned)
    old.advance(40)
    new = carry_over(old, planned)
    assert (new.swarm.neighbors[:50] == 7).all()
    new.advance(STEPS - 40)
    assert np.array_equal(new.swarm.x, ended[0].swarm.x)
    assert (new.swarm.order[:50] == ORDERS.index("recall")).sum() == 49


def test_orders_from_outside_are_the_same_as_those_of_the_scenario(planned, ended):
    simulation = Simulation(planned.with_(commands=[]))
    simulation.advance(5)
    for command in planned.commands:
        simulation.order(command)
    simulation.advance(STEPS - 5)
    assert same({"x": simulation.swarm.x, **sums(simulation)}, {"x": ended[0].swarm.x, **sums(ended[0])})


def test_an_order_that_is_late_counts_from_now_on(planned):
    simulation = Simulation(planned.with_(commands=[]))
    simulation.advance(5)
    simulation.order(Command(step=3, order="hold"))
    simulation.advance(1)
    assert not simulation.swarm.command_x[:50].any()


def test_the_absent_obey_nothing():
    losses = [{"step": 5, "agents": [3]}]
    simulation = Simulation(scenario("oceans2020", {"losses": losses, "commands": [{"step": 8, "order": "recall"}]}))
    simulation.advance(5)
    before = simulation.swarm.x[3]
    simulation.advance(30)
    assert simulation.swarm.x[3] == before
