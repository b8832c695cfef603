"""shoal learn: weights of a strategy, by evolution; a strategy file that runs everywhere."""

import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from shoal.cli.numbers import Integer, MaybeInteger
from shoal.cli.output import write
from shoal.cli.progress import note
from shoal.cli.startup import load_compiler

if TYPE_CHECKING:
    from shoal.learn.search import Generation

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
    from shoal.learn.train import Terms, train
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
        learned = train(strategy, table, out, terms=terms, report=progress)
    except KeyboardInterrupt:
        if progress.generations:
            note(f"stopped: {out} holds what {progress.generations} generations found")
        raise
    note(f"strategy: {out} (shoal run {scenario} --strategy {out})")
    result = f"time on target {estimate_text(learned.learned)} after {learned.generations} generations"
    what = "learned" if learned.is_better else "nothing better than the start was found; the start"
    before = f"{estimate_text(learned.start)} at the start; {len(learned.start.runs)} runs of a fresh seed"
    write(f"{what}: {result}, {before}\n")


class _Progress:
    """Says how far it is, from time to time."""

    def __init__(self) -> None:
        self.generations = 0
        self._last = time.monotonic()

    def __call__(self, generation: "Generation", share: float) -> None:
        """Say it."""
        self.generations = generation.number
        if time.monotonic() - self._last >= SECONDS_BETWEEN_LINES:
            self._last = time.monotonic()
            found = f"its candidates {generation.score:.3f} on target, the best {generation.best:.3f}"
            note(f"{100 * min(share, 1.0):.0f} %: generation {generation.number}, {found}")
