"""Hands the engine's scenarios, states and draws to the oracle, so that both make the same step.

The engine is SI; for the oracle, here, 1 unit is 1 m and v [m/step] = v [m/s] dt. Nothing of the engine's draws is
shared: the hash is written again, in Python's integers.
"""

import math

import numpy as np

import oracle

WORD = 2**64 - 1
START_STEP = 2**62 - 1
TARGET_STREAM = 2**32


def split(key, number):
    """Key `number` below `key`: output `number` of the generator SplitMix64 seeded with `key`."""
    word = (key + (number + 1) * 0x9E3779B97F4A7C15) & WORD
    word = ((word ^ (word >> 30)) * 0xBF58476D1CE4E5B9) & WORD
    word = ((word ^ (word >> 27)) * 0x94D049BB133111EB) & WORD
    return word ^ (word >> 31)


def uniform(key, purpose):
    """One draw from U[0, 1)."""
    return (split(key, purpose) >> 11) / 2**53


def step_key(scenario, run, number):
    """Key of all draws of a step."""
    return split(split(split(scenario.seed, 0), run), number)


def draws(scenario, run, number):
    """r of every agent in step `number`: (N,), or (N, 2) with a draw per axis."""
    keys = [split(step_key(scenario, run, number), i) for i in range(scenario.agents)]
    if scenario.strategy.params["social_draws"] == "per-axis":
        return np.array([[uniform(key, 0), uniform(key, 1)] for key in keys])
    return np.array([uniform(key, 0) for key in keys])


def new_waypoint(scenario, run, number):
    """Where the target goes next if it takes a new waypoint in step `number`."""
    key = split(step_key(scenario, run, number), TARGET_STREAM)
    return (2.0 * np.array([uniform(key, 0), uniform(key, 1)]) - 1.0) * target_box(scenario)


def target_box(scenario):
    """Half widths of the box of waypoints [m]."""
    return np.array([scenario.area.width, scenario.area.height]) / 2 - scenario.targets[0].margin


def model_of(scenario):
    """The oracle's model of a scenario with one waypoint target."""
    dt, params, target = scenario.time_step, scenario.strategy.params, scenario.targets[0]
    (sensor_radius,) = {fleet.sensor_radius for fleet in scenario.fleets}
    half_x, half_y = target_box(scenario)
    assert params["repulsion_step"] == 1.0
    return oracle.Model(
        max_speed=np.repeat([f.max_speed * dt for f in scenario.fleets], [f.count for f in scenario.fleets]),
        k=scenario.network.neighbors,
        omega=params["inertia"],
        c=params["social"],
        d=params["repulsion_exponent"],
        a_min=params["repulsion_min"],
        a_max=params["repulsion_max"],
        a_up=params["delta"],
        a_down=params["delta"] * params["shrink"],
        update=scenario.motion.update_order,
        follow=params["follow"],
        speed_rule=scenario.motion.speed_rule,
        clamp_x=scenario.area.width / 2 - scenario.area.agent_margin,
        clamp_y=scenario.area.height / 2 - scenario.area.agent_margin,
        rho=target.radius + sensor_radius,
        per_axis_r=params["social_draws"] == "per-axis",
        target_speed=target.speed * dt,
        target_half_x=half_x,
        target_half_y=half_y,
        turn_max=math.radians(target.max_turn),
        waypoint_reach=target.waypoint_reach,
        waypoint_patience=target.waypoint_patience,
    )


def state_of(simulation):
    """The oracle's view of a simulation."""
    n, swarm, target = simulation.scenario.agents, simulation.swarm, simulation.targets[0]
    return oracle.State(
        x=np.stack([swarm.x[:n], swarm.y[:n]], axis=1),
        v=np.stack([swarm.vx[:n], swarm.vy[:n]], axis=1) * simulation.scenario.time_step,
        a=np.array(simulation.memories.memory["repulsion"][:n]),
        target=np.array([target["x"], target["y"]]),
        heading=np.array([target["heading_x"], target["heading_y"]]),
        waypoint=np.array([target["waypoint_x"], target["waypoint_y"]]),
        steps_on_waypoint=int(target["waypoint_age"]),
    )


def put_state(simulation, state):
    """Overwrite a simulation's state with the oracle's."""
    n = simulation.scenario.agents
    with simulation.edit() as now:
        swarm, target = now.swarm, now.targets[0]
        swarm.x[:n], swarm.y[:n] = state.x.T
        swarm.vx[:n], swarm.vy[:n] = state.v.T / simulation.scenario.time_step
        swarm.memory[:n, simulation.memory_fields.index("repulsion")] = state.a
        target["x"], target["y"] = state.target
        target["heading_x"], target["heading_y"] = state.heading
        target["waypoint_x"], target["waypoint_y"] = state.waypoint
        target["waypoint_age"] = state.steps_on_waypoint


def oracle_step(simulation, model, state):
    """The oracle's next state and measures, with the chance that the engine's next step has."""
    which = simulation.scenario, simulation.run, simulation.number
    return oracle.step(model, state, draws(*which), new_waypoint(*which))
