"""What passes between the parts of a reproduction: rows of runs, claims, and pictures."""

from dataclasses import dataclass, field
from typing import Any, Literal

from shoal.experiments.rows import Row

Verdict = Literal["holds", "holds partly", "does not hold", "undecided"]


@dataclass(frozen=True)
class Claim:
    """One claim of a paper and what the numbers say of it.

    `measured` is a sentence with the numbers; `value`, `low`, `high` are the key number and its 95 % interval [unit].
    `figure` is the file name (without suffix) of the figure it is read from. `true`, `open`, `false` count its cases.
    """

    id: str
    statement: str
    measured: str
    value: float
    low: float
    high: float
    unit: str
    verdict: Verdict
    figure: str
    true: int = 0
    open: int = 0
    false: int = 0

    @property
    def cases(self) -> str:
        """How many of its cases are true, open and false, in words; empty if none was counted."""
        return f"{self.true} true, {self.open} open, {self.false} false" if self.true + self.open + self.false else ""


@dataclass
class Figure:
    """One figure: a file name without suffix, a caption that says what is seen, and the numbers plotted."""

    name: str
    title: str
    caption: str
    figure: Any  # matplotlib.figure.Figure
    data: list[Row] = field(default_factory=list)


@dataclass
class Reproduction:
    """All that a report needs.

    For oceans2020, `refit` and `refit_claims` are the rows and the claims under the other reading of the paper, in the
    order of `claims`; `sides` are the rows of other settings under each reading, labeled by `side`.
    `main` has columns fast, neighbors, target_speed and sensitivity also variant. For aamas2020, `main` has the columns
    preset (aamas2020, aamas2020-constant) and neighbors, `sensitivity` is empty, and tables["published"] has one row
    per cell compared: metric, neighbors, measured, low, high, published, residual, tolerance, verdict. For the later
    papers `groups` are the rows of each sweep, `main` those of one of them.
    """

    paper: str
    quick: bool
    steps: int
    seeds: int
    main: list[Row]
    sensitivity: list[Row]
    claims: list[Claim] = field(default_factory=list)
    refit: list[Row] = field(default_factory=list)
    refit_claims: list[Claim] = field(default_factory=list)
    sides: dict[str, list[Row]] = field(default_factory=dict)
    groups: dict[str, list[Row]] = field(default_factory=dict)
    figures: list[Figure] = field(default_factory=list)
    tables: dict[str, list[Row]] = field(default_factory=dict)  # printed in the report and written as CSV
    command: str = ""
    versions: dict[str, str] = field(default_factory=dict)
    seconds: float = 0.0
