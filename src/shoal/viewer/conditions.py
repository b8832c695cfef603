"""What a scenario does to its swarm, in words: what is lost, late, dull or broken, and who is gone when."""

from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np
import numpy.typing as npt

from shoal.core.agents import NEVER
from shoal.scenario.presence import Loss
from shoal.scenario.schema import Fleet, Scenario

MOST = 400  # comings and goings that a page is told of

Event = tuple[int, str, int]  # step, "lost" or "joined", agent


def conditions_of(scenario: Scenario) -> list[str]:
    """Return one sentence, without its full stop, for everything that disturbs a swarm; none for what is off."""
    return [
        *_of_network(scenario),
        *(sentence for fleet in scenario.fleets for sentence in _of_fleet(fleet)),
        *(_of_loss(loss) for loss in scenario.losses),
        *(f"{each.count} of {each.fleet} join at step {each.step:,}" for each in scenario.joins),
        *(_of_disturbance(each) for each in scenario.disturbances),
        *(f"a command comes at step {each.step:,}" for each in scenario.commands),
    ]


def comings_and_goings(joins: npt.ArrayLike, leaves: npt.ArrayLike) -> list[Event]:
    """Return who joins after step 0 and who is lost, in the order of steps, the first `MOST`.

    Parameters
    ----------
    joins, leaves : (N,) steps, as the state of a swarm has them
    """
    first, last = np.asarray(joins), np.asarray(leaves)
    joined = [(int(first[agent]), "joined", int(agent)) for agent in np.flatnonzero(first > 0)]
    lost = [(int(last[agent]), "lost", int(agent)) for agent in np.flatnonzero(last < NEVER)]
    return sorted(joined + lost)[:MOST]


def kept_comings_and_goings(steps: npt.ArrayLike, alive: npt.ArrayLike) -> list[Event]:
    """Return the same from the frames that a record keeps: by which of their steps each was seen to be there or gone.

    Parameters
    ----------
    steps, alive : (K,) of the frames, (K, N) who is there
    """
    numbers, there = np.asarray(steps), np.asarray(alive, bool)
    frames, agents = np.nonzero(there[1:] != there[:-1])
    events = zip(frames.tolist(), agents.tolist(), strict=True)
    return sorted((int(numbers[at + 1]), "joined" if there[at + 1, i] else "lost", i) for at, i in events)[:MOST]


def _of_network(scenario: Scenario) -> Iterator[str]:
    network = scenario.network
    if network.adaptive:
        yield f"k adapts, from {network.adaptive.fewest} to {network.adaptive.most}"
    if network.range is not None:
        yield f"nobody is heard beyond {_length(network.range)}"
    if network.loss:
        yield f"{_percent(network.loss)} of the reports are lost"
    if network.delay:
        yield f"reports are {network.delay} steps late"
    if network.interval is not None:
        yield f"a report every {network.interval:g} s"
    if network.max_age:
        yield f"reports are kept for {network.max_age} steps"
    if network.hops > 1:
        yield f"reports are passed on over {network.hops} hops"
    if network.radio is not None:
        yield f"radio: {network.radio}"


def _of_fleet(fleet: Fleet) -> Iterator[str]:
    sees, imagines = _percent(fleet.detection_probability), _percent(fleet.false_alarm_probability)
    facts = _facts(
        (fleet.detection_probability < 1.0, f"notice a target in reach in {sees} of steps"),
        (fleet.false_alarm_probability > 0.0, f"report one that is not there in {imagines}"),
        (fleet.sensor == "inverse-cube", "see by Koopman's inverse-cube law"),
        (fleet.position_error > 0.0, f"know their place to {fleet.position_error:g} m"),
        (fleet.mean_lifetime is not None, f"last {fleet.mean_lifetime or 0.0:,.4g} s on average"),
        (fleet.battery is not None, "are lost when their battery is empty"),
        (fleet.max_acceleration is not None, f"accelerate by {fleet.max_acceleration or 0.0:g} m/s² at most"),
        (fleet.max_turn_rate is not None, f"turn by {fleet.max_turn_rate or 0.0:g}°/s at most"),
    )  # fmt: skip
    yield from (f"{fleet.name}: {fact}" for fact in facts)


def _facts(*facts: tuple[bool, str]) -> Iterable[str]:
    return (words for holds, words in facts if holds)


def _of_loss(loss: Loss) -> str:
    named = ", ".join(map(str, loss.agents[:8])) + (" …" if len(loss.agents) > 8 else "")
    who = f"no. {named}" if loss.agents else loss.count
    return f"{who}{f' of {loss.fleet}' if loss.fleet else ''} lost at step {loss.step:,}"


def _of_disturbance(each: Any) -> str:
    until = "" if each.until is None else f" to {each.until:,.4g} s"
    when = f" from {each.since:,.4g} s{until}" if each.since or until else ""
    return f"{each.kind}{f' of {each.fleet}' if each.fleet else ''}{when}"


def _length(meters: float) -> str:
    return f"{meters / 1000.0:.4g} km" if meters >= 2000.0 else f"{meters:,.4g} m"


def _percent(share: float) -> str:
    return f"{100.0 * share:.3g} %"
