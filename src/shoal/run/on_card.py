"""Many runs at once on a graphics card; what a card cannot do is refused in one sentence."""

import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

from shoal.core.agents import NEVER
from shoal.core.errors import DeviceError, ShoalError, UnknownNameError
from shoal.engine.stage import Frames
from shoal.metrics.catalogue import DECLARED
from shoal.record.trajectory import Trajectory
from shoal.run.simulation import Simulation, count_frames
from shoal.scenario.crew import crew_of
from shoal.scenario.schema import Scenario
from shoal.world.targets.catalogue import KINDS

DEVICES = ("cpu", "cuda")
AT_ONCE = 4096  # runs whose state is kept at a time
_SECONDS = 1.0  # that a launch should take: an interrupt is heard between two
_FIRST = 200  # steps of the first launch, by which the next are timed
_FRAMES = 1 << 28  # bytes of frames on the card at a time, of all runs


def check_device(device: str, scenarios: Iterable[Scenario]) -> str | None:
    """Return the name of the card if it is asked for; None for the processor.

    Raises
    ------
    UnknownNameError : there is no such device
    MissingExtraError, DeviceError : see `check_card`
    """
    if device not in DEVICES:
        raise UnknownNameError.of("device", device, DEVICES)
    return check_card(scenarios) if device == "cuda" else None


def check_card(scenarios: Iterable[Scenario]) -> str:
    """Return the name of the card, if there is one and it can run all of these.

    Raises
    ------
    MissingExtraError : numba-cuda is absent
    DeviceError : there is no card, or a scenario has what it cannot do
    """
    from shoal.engine.gpu.card import card_name

    name = card_name()
    for scenario in scenarios:
        if problem := why_not(scenario):
            raise DeviceError("--device cuda", f"does not do {problem}", "leave --device out")
    return name


def why_not(scenario: Scenario) -> str | None:
    """What of a scenario a card cannot do, in words; None if it can all of it."""
    from shoal.engine.gpu.batch import MOST_AGENTS

    packages = {each.package for each in (*DECLARED, *KINDS) if each.package is not None}
    reasons = {
        "the sequential order (motion.update_order)": scenario.motion.update_order == "sequential",
        "single precision (precision)": scenario.precision == "single",
        "disturbances": bool(scenario.disturbances),
        "currents, wind and land (sea)": scenario.sea is not None,
        f"more than {MOST_AGENTS} agents": scenario.agents > MOST_AGENTS,
        "orders on the way (commands)": bool(scenario.commands),
        "reports that are relayed or kept (network.hops, network.max_age)": scenario.network.collects,
        "strategies from a file": not crew_of(scenario).builtin,
        f"metrics and targets of installed packages ({', '.join(sorted(packages))})": bool(packages),
    }
    return next((words for words, is_so in reasons.items() if is_so), None)


def run_on_card(
    simulations: Sequence[Simulation],
    *,
    every: int | None = None,
    tail: int | None = None,
    recorded: Sequence[bool] = (),
    keep: Callable[[int, Trajectory], None] | None = None,
    count: Callable[[int], None] | None = None,
    fail: Callable[[int, ShoalError], None] | None = None,
) -> None:
    """Run simulations to the end of their scenarios, all that follow strategies of one kind at once.

    Parameters
    ----------
    simulations : at their beginning
    every, tail : of the simulations that are `recorded`, keep every n-th frame, and all from step `tail` on
    keep : is handed the index of a simulation and its next frames
    count : is told how many steps were done, of all simulations together, after each launch
    fail : is handed the index of a simulation whose numbers are no longer finite, and the error; default: raise it

    Raises
    ------
    DeviceError : something cannot be compiled for the card
    StrategyError, ScenarioError : a number is not finite
    """
    kinds: dict[Any, list[int]] = {}
    for index, simulation in enumerate(simulations):
        kinds.setdefault(_kind_of(simulation), []).append(index)
    for indices in kinds.values():
        together = [simulations[index] for index in indices]
        wanted = [bool(recorded) and recorded[index] for index in indices]
        for number, part in _launches(together, every or 1, NEVER if tail is None else tail, wanted, count):
            if isinstance(part, ShoalError):
                if fail is None:
                    raise part
                fail(indices[number], part)
            elif keep:
                keep(indices[number], part)


def _kind_of(simulation: Simulation) -> Any:
    """What runs of one launch have in common: code, and a length."""
    from shoal.engine.gpu.batch import facts

    crew = simulation.crew
    known = facts(simulation.world, simulation.radio)
    return _classes(crew.params), crew.memory, crew.told, known, simulation.scenario.steps


def _classes(params: Any) -> Any:
    """The class of parameters, and of those inside a team's."""
    return type(params), tuple(_classes(each) for each in params) if isinstance(params, tuple) else ()


def _launches(
    together: Sequence[Simulation],
    every: int,
    tail: int,
    recorded: Sequence[bool],
    count: Callable[[int], None] | None,
) -> Iterator[tuple[int, Trajectory | ShoalError]]:
    """Launch after launch; yields the frames of each, or what is wrong. Without frames all stays on the card."""
    from shoal.engine.gpu.batch import Batch, Work

    steps, chunk, number = together[0].scenario.steps, _FIRST, 0
    batch: Any = None
    while number < steps:
        last = min(number + chunk, steps)
        if any(recorded):
            last = _until_full(together[0], number, last, every, tail, sum(recorded))
            frames = count_frames(number, last, every, tail)
            works = [Work(*each.work(frames if wanted else 0)) for each, wanted in zip(together, recorded, strict=True)]
            batch = Batch(works)
        elif batch is None:
            batch = Batch([Work(*each.work()) for each in together])
        begun = time.perf_counter()
        batch.advance(number, last, every, tail)
        seconds = time.perf_counter() - begun
        chunk = _next_chunk(chunk, last - number, seconds)
        if any(recorded):
            yield from _settled(batch, together, last - number)
            yield from _frames_of(together, works, recorded)
        if count:
            count((last - number) * len(together))
        number = last
    if batch is not None and not any(recorded):
        yield from _settled(batch, together, number)


def _settled(batch: Any, together: Sequence[Simulation], steps: int) -> Iterator[tuple[int, ShoalError]]:
    """Bring back the state of runs that did so many steps, and what is wrong with it."""
    batch.fetch()
    for number, each in enumerate(together):
        try:
            each.worked(steps)
        except ShoalError as failure:
            yield number, failure


def _frames_of(
    together: Sequence[Simulation], works: Sequence[Any], recorded: Sequence[bool]
) -> Iterator[tuple[int, Trajectory]]:
    for number, (each, work) in enumerate(zip(together, works, strict=True)):
        frames: Frames = work.stage.frames
        if recorded[number] and frames.step.size:
            yield number, Trajectory.from_frames(frames, each.memory_fields)


def _next_chunk(chunk: int, done: int, seconds: float) -> int:
    """How many steps the next launch should have: the first one of all compiled, and says little."""
    return max(_FIRST, min(4 * chunk, int(done * _SECONDS / max(seconds, 1e-6))))


def _until_full(one: Simulation, number: int, last: int, every: int, tail: int, runs: int) -> int:
    """The step, after `number` and up to `last`, until which the frames of so many runs fit the card."""
    frame = sum(array.nbytes for array in one.work(1)[0].frames)
    while last > number + 1 and count_frames(number, last, every, tail) * frame * runs > _FRAMES:
        last = number + (last - number) // 2
    return last
