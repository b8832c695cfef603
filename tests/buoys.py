"""Buoys beside the engine: what each of its agents measured and heard, and what it decided."""

import math
from typing import NamedTuple

import numpy as np

import replay
from shoal.buoy.buoy import Buoy
from shoal.core.messages import Reading, Report
from shoal.core.wire import told_class

LOSS = 1 << 33  # the stream of keys that losses draw from


class Tape(NamedTuple):
    """S steps of N agents: all (S, N), but told (S, N, T); commands are the velocities that they decided on."""

    x: np.ndarray
    y: np.ndarray
    vx: np.ndarray
    vy: np.ndarray
    on_target: np.ndarray
    told: np.ndarray
    k: np.ndarray
    command_x: np.ndarray
    command_y: np.ndarray


def tape_of(chosen, steps, run=0):
    """What the engine does."""
    from shoal.run.simulation import Simulation  # where there is no numba, tapes are played, not recorded

    simulation = Simulation(chosen, run)
    agents, rows = chosen.agents, []
    for _ in range(steps):
        k = simulation.swarm.neighbors[:agents].copy()
        frame = simulation.advance(1, every=1)
        told = np.array([frame.memory[name][0] for name in simulation.crew.told]).T.reshape(agents, -1)
        parts = [getattr(frame, name)[0].copy() for name in ("x", "y", "vx", "vy", "on_target")]
        commands = [command[:agents].copy() for command in (simulation.swarm.command_x, simulation.swarm.command_y)]
        rows.append((*parts, told, k, *commands))
    return Tape(*(np.array(part) for part in zip(*rows, strict=True)))


def reports_of(tape, step, told, time_step):
    """What all agents said in a step."""
    values = [getattr(tape, name)[step].tolist() for name in ("x", "y", "vx", "vy", "on_target")]
    said = [told_class(told)(*row) for row in tape.told[step].tolist()]
    return [Report(i, *row, said[i], step * time_step) for i, row in enumerate(zip(*values, strict=True))]


def reading_of(tape, step, i):
    """What agent i measured in a step."""
    return Reading(*(getattr(tape, name)[step, i].item() for name in ("x", "y", "vx", "vy", "on_target")))


def arrived(tape, step, i, reports, chosen, run=0):
    """Of reports, those that the engine's radio brings to agent i: in range, of the k nearest, not lost."""
    network = chosen.network
    x, y = tape.x[step, i], tape.y[step, i]
    square = {other.id: (x - other.x) ** 2 + (y - other.y) ** 2 for other in reports if other.id != i}
    in_range = [
        j for j in sorted(square, key=lambda j: (square[j], j)) if square[j] <= (network.range or math.inf) ** 2
    ]
    key = replay.split(replay.split(replay.split(chosen.seed, 0), run), step)
    lost = {j for j in square if replay.uniform(replay.split(key, LOSS + j), i) < network.loss}
    return [reports[j] for j in in_range[: tape.k[step, i]] if j not in lost]


def differences(tape, chosen, ids, *, run=0, radio=False, apart=0.0):
    """Steps and ids in which a buoy wants another velocity than the engine's agent, by more than `apart` [m/s].

    radio : whether the inbox is what the engine's radio brings, instead of all that is said
    """
    buoys = [Buoy(chosen, i, run=run) for i in ids]
    delay, found = chosen.network.delay, []
    for step in range(len(tape.x)):
        said = reports_of(tape, step - delay, buoys[0].told, chosen.time_step) if step >= delay else []
        for buoy in buoys:
            i = buoy.id
            inbox = arrived(tape, step, i, said, chosen, run) if radio else said
            decision = buoy.decide(reading_of(tape, step, i), inbox, step)
            wanted = tape.command_x[step, i], tape.command_y[step, i]
            if not max(abs(decision.vx - wanted[0]), abs(decision.vy - wanted[1])) <= apart:
                found.append((step, i))
            if delay == 0 and decision.report != said[i]:
                found.append((step, i, "report"))
    return found
