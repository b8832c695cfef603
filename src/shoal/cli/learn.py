"""shoal learn: weights of a strategy, by evolution; a strategy file that runs everywhere."""

import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from shoal.cli.numbers import Integer, MaybeInteger
from shoal.cli.output import write
from shoal.cli.progress import note
from shoal.cli.startup import load_compiler, tell_of_compiling

if TYPE_CHECKING:
    from shoal.learn.search import Generation
    from shoal.learn.train import Stopped

SECONDS_BETWEEN_LINES = 10.0


def learn(
    strategy: str = "linear",
    /,
    *,
    out: Path = Path("learned.py"),
    scenario: str = "oceans2020",
    budget: str = "3 min",
    steps: Integer = 5000,
    runs: Integer = 1,
    jobs: MaybeInteger = None,
    vary: Annotated[list[str] | None, Parameter(negative=(), consume_multiple=False)] = None,
    seed: MaybeInteger = None,
    assignments: Annotated[list[str] | None, Parameter(name="--set", negative=(), consume_multiple=False)] = None,
) -> None:
    """Learn the weights of a strategy by CMA-ES, for time on target; write a strategy file that runs everywhere.

    Parameters
    ----------
    strategy
        A strategy with weights in its parameters, by name or Python file; or the template linear: a linear policy that
        hears what the paper's buoys hear.
    out
        The strategy file to write, after every generation; its name is that of the strategy.
    scenario
        A preset's name or a TOML file, in which it learns.
    budget
        Processor time of the search, such as "3 min"; compiling and the last judgement are not in it.
    steps
        Time-steps of a run.
    runs
        Runs of each candidate.
    jobs
        Threads, one run each; default one per core.
    vary
        A weight to learn; may be repeated; default all parameters that are numbers with decimals.
    seed
        Seed of the search; what it found is judged by the next one.
    assignments
        Any field of the scenario by its path; may be repeated.
    """
    load_compiler()
    from shoal.cli.options import check_positive, edited_table
    from shoal.core.errors import ScenarioError
    from shoal.core.units import Unit
    from shoal.learn.train import Stopped, Terms, train
    from shoal.record.words import estimate_text

    check_positive(steps=steps, runs=runs, jobs=jobs)
    try:
        seconds = float(Unit("s").parse(budget))
    except ValueError as error:
        raise ScenarioError("--budget", str(error), 'write it as "3 min"') from None
    if not seconds > 0:
        raise ScenarioError("--budget", f"is {budget}", "give a time above 0")
    table = edited_table(scenario, {"seed": seed}, assignments or [], None, None)
    progress = _Progress()
    note(f"learning the weights of {strategy}, for {seconds:g} s of processor time; Ctrl-C keeps what is found")
    terms = Terms(seconds, steps, runs, jobs, tuple(vary or ()))
    try:
        learned = train(strategy, table, out, terms=terms, report=progress, compiling=tell_of_compiling)
    except Stopped as stopped:
        note(_what_is_kept(stopped, out, scenario))
        raise stopped.interrupt from None
    note(f"strategy: {out} (shoal run {scenario} --strategy {out})")
    result = f"time on target {estimate_text(learned.learned)} after {learned.generations} generations"
    what = "learned" if learned.is_better else "nothing better than the start was found; the start"
    before = f"{estimate_text(learned.start)} at the start; {len(learned.start.runs)} runs of a fresh seed"
    write(f"{what}: {result}, {before}\n")


def _what_is_kept(stopped: "Stopped", out: Path, scenario: str) -> str:
    """What the file holds after an interrupt, and how to judge it."""
    from shoal.learn.train import COMPARED

    best, place = stopped.kept, "" if scenario == "oceans2020" else f" --scenario {scenario}"
    judge = f"to judge it: shoal compare {out} knn-pso encircle --runs 20{place}"
    if best is None:
        what = f"holds what {stopped.generations} generations found, which was not compared with the start"
        return f"stopped: {out} {what}; {judge}"
    if not best.is_better:
        found = f"{stopped.generations} generations found nothing better than the start"
        return f"stopped: {found} ({best.start:.3f} of the time on target), which {out} holds"
    scores = f"{best.score:.3f} of the time on target, {best.start:.3f} at the start"
    own = f"in {COMPARED} runs by which the search chose it, so that is optimistic"
    return f"stopped after {stopped.generations} generations: {out}: {scores}, {own}; {judge}"


class _Progress:
    """Says how far it is, from time to time."""

    def __init__(self) -> None:
        self._best = 0.0
        self._last = time.monotonic()

    def __call__(self, generation: "Generation", share: float) -> None:
        """Say it."""
        self._best = max(self._best, generation.best)
        if time.monotonic() - self._last >= SECONDS_BETWEEN_LINES:
            self._last = time.monotonic()
            found = f"its candidates {generation.score:.3f} on target, the best so far {self._best:.3f}"
            note(f"{100 * min(share, 1.0):.0f} %: generation {generation.number}, {found}")
