"""What the study of the readings runs: a short screen of all of them, then the finalists at the paper's length."""

from collections.abc import Sequence
from dataclasses import dataclass

from shoal.experiments.design import Design, Point, grid
from shoal.paper.plan import FULL_STEPS, MIXED, SHARE_NEIGHBORS, SPEEDS, START_PLACES, Group, distinct
from shoal.paper.readings import Reading

FINALISTS = 3  # the best of the screen, besides the printed reading
_NEIGHBORS = (10, 14, 17, 20, 23, 26, 30, 34, 40, 49)
_SHARES = (30, 50)


@dataclass(frozen=True)
class Trial:
    """Length of the runs, seeds, and where clusters are watched for [steps]."""

    name: str
    steps: int
    seeds: int
    neighbors: Sequence[int] = _NEIGHBORS

    def steps_of(self, reading: Reading) -> int:
        """Half of them in the screen of a reading that takes about five times as long."""
        return self.steps // 2 if reading.sequential and self.name == "screen" else self.steps


SCREEN, FINAL = Trial("screen", 10_000, 2), Trial("final", FULL_STEPS, 5)
SCREEN_QUICK, FINAL_QUICK = Trial("screen", 1_000, 2, (10, 20, 30, 40, 49)), Trial("final", 2_000, 2)


def groups_of(reading: Reading, trial: Trial) -> list[Group]:
    """The curves over k and a few shares of fast buoys, and other starts of the fast fleet; both target speeds."""
    main = [
        *grid({"target_speed": SPEEDS, "fast": [MIXED, 0], "neighbors": trial.neighbors}),
        *grid({"target_speed": SPEEDS, "fast": _SHARES, "neighbors": SHARE_NEIGHBORS}),
    ]
    placement = grid({"target_speed": SPEEDS, "fast": [MIXED], "neighbors": [20], "fleets.BoB-1.start": START_PLACES})
    changes: Point = {**reading.changes, "steps": trial.steps_of(reading)}
    return [
        Group(
            f"{trial.name}/{reading.slug}/{part}",
            Design("oceans2020", distinct(points), trial.seeds),
            changes,
            {"reading": reading.name},
        )
        for part, points in (("main", main), ("placement", placement))
    ]
