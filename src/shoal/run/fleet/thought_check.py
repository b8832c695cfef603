"""What must be true of decisions: of all buoys that decide in a step at once, whatever processes they are in."""

import math
from itertools import chain
from typing import Any

import numpy as np

from shoal.buoy.tether import Commands, Tick
from shoal.core.messages import Reading
from shoal.run.fleet.ear import Heard
from shoal.run.fleet.invariants import BrokenInvariantError, Floats, demand, demand_array, together
from shoal.run.fleet.vessel import Thought

_TIME, _ID, _ON_TARGET, _TOLD = 4, 5, 6, 7  # columns of CONTENT


def check_thoughts(
    thoughts: list[Thought], ticks: list[Tick], heard: list[Heard], neighbors: int, windows: list[Any], time_step: float
) -> Floats:
    """Every buoy decided on its own reading, and on exactly the reports of the k nearest of those it hears.

    Parameters
    ----------
    thoughts : of each process that decided, whose buoys are n in all; ticks, heard : on what it must have decided
    neighbors : k
    windows : for each process, the first and last step that can be heard
    time_step : [s]

    Returns
    -------
    (n, k + 1, 7 + T) what the neighbors of each must have said, in the order of ids; not numbers where it has no more

    Raises
    ------
    BrokenInvariantError : it decided on anything else
    """
    demand("a buoy goes by its own clock", [each.step for each in thoughts], [tick.step for tick in ticks])
    readings = together(ticks)
    ids = readings["id"]
    demand("every buoy decides", list(chain(*(each.ids for each in thoughts))), ids.tolist())
    measured = np.array([readings[name] for name in Reading._fields], float).T
    demand_array("a buoy believes its instruments", np.concatenate([each.readings for each in thoughts]), measured)
    wanted = _nearest(readings, heard, neighbors)
    found = _decided_on(thoughts, wanted.shape)
    if not np.array_equal(found, wanted, equal_nan=True):
        n = next(n for n, its in enumerate(found) if not np.array_equal(its, wanted[n], equal_nan=True))
        process = int(np.searchsorted(np.cumsum([len(each.ids) for each in thoughts]), n, side="right"))
        who = f"buoy {ids[n]} in step {ticks[process].step}"
        its, near = (rows[~np.isnan(rows[:, _ID])] for rows in (found[n], wanted[n]))
        _accuse(who, int(ids[n]), its, near, neighbors, windows[process], time_step)
    return wanted


def _nearest(readings: Any, heard: list[Heard], neighbors: int) -> Floats:
    """What the k nearest of each buoy said, of those that it hears, with room for one that it must not hear."""
    tables = np.concatenate([each.tables for each in heard])
    first = np.cumsum([0, *(len(each.tables) for each in heard[:-1])])
    table = np.concatenate([each.table + begin for each, begin in zip(heard, first, strict=True)])
    count, agents = len(readings), tables.shape[1] - 1
    dx = readings["x"][:, None] - tables[:, :agents, 0][table]
    dy = readings["y"][:, None] - tables[:, :agents, 1][table]
    square = dx * dx + dy * dy
    if heard[0].reached is not None:
        square[~np.concatenate([each.reached for each in heard])] = np.nan
    square[np.arange(count), readings["id"]] = np.nan
    nearest = square.argsort(axis=1, kind="stable")[:, : neighbors + 1]  # what is no number comes last
    nearest[np.arange(neighbors + 1) >= np.isfinite(square).sum(axis=1)[:, None]] = agents  # nobody
    nearest[:, neighbors] = agents
    nearest.sort(axis=1)
    said: Floats = tables[table[:, None], nearest]
    return said


def _decided_on(thoughts: list[Thought], shape: tuple[int, int, int]) -> Floats:
    """What the neighbors of each buoy said, as its mind was told it."""
    found, columns, begin = np.full(shape, np.nan), shape[2], 0
    for thought in thoughts:
        inbox, tells = thought.said.inbox, thought.said.tells
        content, count = np.empty((len(inbox.id) + 1, columns)), len(inbox.id)
        content[:count, :_ID], content[:count, _ID], content[:count, _ON_TARGET] = inbox[1], inbox[0], inbox[2]
        content[:count, _TOLD:] = tells[:count, : columns - _TOLD]
        content[count] = np.nan  # of row -1: nobody
        rows = thought.near[:, :, 0]
        found[begin : begin + len(rows), : rows.shape[1]] = content[rows]
        begin += len(rows)
    return found


def _accuse(who: str, id: int, found: Any, wanted: Any, k: int, window: tuple[int, int], time_step: float) -> None:
    """Say what is wrong with the reports that a buoy decided on."""
    ids, times = found[:, _ID].astype(int).tolist(), np.round(found[:, _TIME] / time_step).tolist()
    if id in ids:
        raise BrokenInvariantError("nobody hears itself", who)
    if len(found) > k:
        raise BrokenInvariantError("at most k are heard", f"{who} heard {len(found)}, k is {k}")
    if times and max(times) > window[1]:
        raise BrokenInvariantError("nothing is heard from the future", f"{who} heard step {max(times):g}")
    if times and min(times) < window[0]:
        raise BrokenInvariantError("nothing is heard that is too old", f"{who} heard step {min(times):g}")
    if ids != wanted[:, _ID].tolist():
        problem = f"{who} heard {ids}, not {wanted[:, _ID]}"[:400]
        raise BrokenInvariantError("the k nearest that can be heard are", problem)
    raise BrokenInvariantError("what is heard is what was said", f"{who} heard {found}, not {wanted}"[:400])


def check_commands(commands: list[Commands], thoughts: list[Thought], speeds: Floats, under: dict[int, str]) -> None:
    """What goes to the bodies is what was decided, or what a buoy wants under an order, and finite; so is the memory.

    Parameters
    ----------
    commands, thoughts : of each process that decided
    speeds : top speed of every agent [m/s]
    under : the order that an agent is under; who is not in it is under none

    Raises
    ------
    BrokenInvariantError : it is not
    """
    ids = np.concatenate([each.ids for each in commands])
    demand("commands are decisions", ids.tolist(), list(chain(*(each.ids for each in thoughts))))
    wants = np.concatenate([each.wants for each in commands])
    decided = np.concatenate([each.wants for each in thoughts])
    for n, id in enumerate(ids.tolist()):
        order = under.get(id, "resume")
        if order == "hold":
            demand("who holds wants nothing", wants[n].tolist(), [0.0, 0.0])
        if order == "recall":
            demand("nobody comes home faster than its make", math.hypot(*wants[n]) <= speeds[id] + 1e-9, True)
        if order != "resume":
            decided[n] = wants[n]
    demand_array("commands are decisions", wants, decided)
    memory, after = ([each.memory for each in commands], [each.after for each in thoughts])
    demand_array("commands have the memory", np.concatenate(memory), np.concatenate(after))
    if not np.isfinite(wants).all():
        raise BrokenInvariantError("every number is finite", f"wanted are {wants}"[:300])
