"""Swarms side by side go as Simulation goes, to the bit, whatever is in the scenario."""

import numpy as np
import pytest

from scenarios import scenario, small
from shoal.core.errors import ScenarioError
from shoal.learn.episodes import Episodes
from shoal.learn.spec import Act, Observe
from shoal.run.simulation import Simulation
from shoal.scenario.crew import crew_of

STEPS = 40
POOR = {"sensor_radius": 0.5, "detection_probability": 0.7, "false_alarm_probability": 0.05, "position_error": 0.2}
FLEETS = [
    {"name": "fast", "count": 15, "max_speed": 2.6, "max_turn_rate": 200.0, **POOR},
    {"name": "slow", "count": 35, "max_speed": 1.0, "max_acceleration": 4.0, **POOR},
]
TWO = [
    {"kind": "still", "x": 3.0, "y": -2.0, "radius": 1.0},
    {"kind": "evasive", "radius": 1.0, "speed": 1.0, "margin": 2.0, "sight": 3.0, "wall_sight": 2.0},
]
RADIO = {"neighbors": 12, "range": 7.0, "loss": 0.2, "delay": 2, "interval": 0.3}
COAST = {"sea": {"coast": [[[-4.0, -4.0], [4.0, -4.0], [4.0, 4.0], [-4.0, 4.0]]]}}
CASES = {
    "as-it-is": {},
    "poor-radios": {"network": RADIO},
    "poor-makes-and-two-targets": {"fleets": FLEETS, "targets": TWO},
    "disturbed-and-lost": {
        "disturbances": [{"kind": "current", "east": 0.5}, {"kind": "blackout", "since": 1.0, "until": 2.0}],
        "losses": [{"step": 20, "count": 5}],
        "joins": [{"step": 10, "count": 3, "fleet": "BoB-0"}],
    },
    "kept-behind-land": {"network": {**RADIO, "max_age": 5, "hops": 2, "adaptive": {"fewest": 3, "most": 18}}, **COAST},
}
SLOW = ("kept-behind-land",)  # has kernels of its own to compile


def episodes(chosen, count=2, **specs):
    return Episodes(chosen, count, specs.get("observe", Observe()), specs.get("act", Act()), {"engaged": 1.0})


def replayed(chosen, run, actions):
    """The same by Simulation: puppets want what is asked for."""
    simulation = Simulation(chosen, run, crew=crew_of(chosen).puppets())
    top = simulation.swarm.max_speed[: chosen.agents, None]
    for action in actions:
        with simulation.edit() as now:
            now.swarm.memory[: chosen.agents] = top * action
        simulation.advance(1)
    return simulation


@pytest.mark.parametrize("name", [pytest.param(name, marks=pytest.mark.slow if name in SLOW else ()) for name in CASES])
def test_the_same_seed_and_actions_give_the_same_bits_as_a_simulation(name):
    chosen = scenario("oceans2020", {"steps": STEPS, **CASES[name]})
    env = episodes(chosen)
    rng = np.random.default_rng(1)
    env.reset(seed=chosen.seed)
    env.reset()  # runs 2 and 3: what is left of 0 and 1 is gone
    actions = rng.uniform(-1, 1, (STEPS - 5, *env.actions.shape)).astype(np.float32)
    for action in actions:
        env.step(action)
    for e in range(2):
        simulation = replayed(chosen, 2 + e, actions[:, e].astype(float))
        mine, its = env.swarms.swarm(e), simulation.swarm
        for field in ("x", "y", "vx", "vy", "on_target", "engaged", "alive", "fix_x", "neighbors", "leaves"):
            assert np.array_equal(getattr(mine, field)[:50], getattr(its, field)[:50]), field
        assert np.array_equal(env.swarms.targets(e).x, simulation.targets.x)
        assert np.array_equal(env.swarms.targets(e).y, simulation.targets.y)


def test_a_recorded_run_is_replayed():
    """But for the last bit of velocities at the limit, which are limited once more."""
    chosen = scenario("oceans2020", {"steps": STEPS})
    simulation = Simulation(chosen)
    env = episodes(chosen, 1, act=Act(scaled=False))
    env.reset()
    for _ in range(STEPS - 1):
        simulation.advance(1)
        wanted = np.stack([simulation.swarm.command_x[:50], simulation.swarm.command_y[:50]], axis=1)
        env.step(wanted[None])
        for field in ("x", "y", "vx", "vy", "on_target"):
            mine, its = getattr(env.swarms.swarm(0), field), getattr(simulation.swarm, field)
            assert np.allclose(mine[:50], its[:50], rtol=0, atol=1e-12), field


@pytest.mark.slow
def test_many_agents_whose_neighbors_are_in_lists_see_what_few_see():
    chosen = small(160, 7, {"steps": STEPS, "area.width": 40.0, "area.height": 40.0})
    env = episodes(chosen, 1)
    env.reset()
    assert env.swarms.template.world.listed
    rng = np.random.default_rng(2)
    for _ in range(10):
        env.step(rng.uniform(-1, 1, env.actions.shape))
    swarm = env.swarms.swarm(0)
    dx = swarm.x[:160, None] - swarm.x[None, :160]
    dy = swarm.y[:160, None] - swarm.y[None, :160]
    square = dx * dx + dy * dy
    np.fill_diagonal(square, np.inf)
    nearest = np.sqrt(np.sort(square, axis=1)[:, :7]) / 20.0
    reports = env.observations[0, :, 6:].reshape(160, 7, 6)
    assert np.hypot(reports[..., 1], reports[..., 2]) == pytest.approx(nearest, rel=1e-5)


@pytest.mark.parametrize(
    ("changes", "what"),
    [
        ({"motion.update_order": "sequential"}, "one after the other"),
        ({"commands": [{"step": 5, "order": "hold"}]}, "an environment has none"),
        ({"precision": "single"}, "double precision"),
    ],
)
def test_what_an_environment_cannot_do_is_refused(changes, what):
    with pytest.raises(ScenarioError, match=what):
        episodes(scenario("oceans2020", changes))
