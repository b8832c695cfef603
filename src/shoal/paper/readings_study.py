"""The study of the readings: screen all, run the finalists in full, and say which meets most of the paper."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from shoal.experiments.rows import Row
from shoal.paper.clusters import Episode, watch_clusters
from shoal.paper.frontier import frontier_table
from shoal.paper.plan import QUICK_STEPS, SPEEDS, Group, Plan
from shoal.paper.readings import Reading, printed, readings
from shoal.paper.readings_plan import FINAL, FINAL_QUICK, FINALISTS, SCREEN, SCREEN_QUICK, Trial, groups_of
from shoal.paper.results import Reproduction
from shoal.paper.running import Report, run_plan
from shoal.paper.sensitivity import peak_table
from shoal.paper.statements import Verdicts, holding, judge_statements, score, statements_of, verdict_on

STUDY = "oceans2020-readings"


@dataclass(frozen=True)
class Scored:
    """A reading as a trial judges it."""

    reading: Reading
    trial: Trial
    found: Verdicts
    rows: list[Row]

    @property
    def peaks(self) -> list[Row]:
        """Where its curves over k peak."""
        table = peak_table([{**row, "variant": self.reading.name} for row in self.rows])
        return [{"reading": row.pop("variant"), "trial": self.trial.name, **row} for row in table]

    @property
    def order(self) -> tuple[float, float, int]:
        """For the choice among finalists: most statements that hold, then the higher score, then fewer departures."""
        return (-holding(self.found), -score(self.found), self.reading.departures)


def run_study(
    out: Path, *, quick: bool = False, jobs: int | None = None, device: str = "cpu", report: Report | None = None
) -> Reproduction:
    """Run what is missing of the study under `out`, and return its tables.

    The finalists are the three readings of the highest score in the screen (ties: more statements that hold, then fewer
    departures from the printed one) and the printed one; chosen is the finalist under which most statements hold.
    """
    screen, final = (SCREEN_QUICK, FINAL_QUICK) if quick else (SCREEN, FINAL)
    screened = _run(readings(), screen, out, quick, jobs, report, device)
    finalists = _finalists(screened)
    finals = _run(finalists, final, out, quick, jobs, report, device)
    chosen = min(finals, key=lambda each: each.order)
    best = {each.reading.name: each for each in (*screened, *finals)}  # a finalist as its longer runs judge it
    return Reproduction(
        STUDY,
        quick,
        final.steps,
        final.seeds,
        [row for each in finals for row in each.rows],
        [],
        tables={
            "readings_scores": score_table(screened, finals, chosen.reading),
            "readings_peaks": [row for each in (*finals, *screened) for row in each.peaks],
            "readings": readings_table(list(best.values()), chosen.reading),
            "frontier": [
                {"among": among, **row}
                for among, of in (("finalists", finals), ("all", best.values()))
                for row in frontier_table({each.reading.name: each.found for each in of})
            ],
        },
    )


def readings_table(scored: Sequence[Scored], chosen: Reading) -> list[Row]:
    """One row per reading, statement and target speed (or "both"), with the key number and the verdict."""
    return [
        {
            "reading": each.reading.name,
            "statement": id_,
            "target_speed": at,
            "value": claim.value,
            "low": claim.low,
            "high": claim.high,
            "verdict": claim.verdict,
            "chosen": each.reading == chosen,
        }
        for each in scored
        for id_ in statements_of(each.found)
        for (statement, at), claim in each.found.items()
        if statement == id_
    ]


def score_table(screened: Sequence[Scored], finals: Sequence[Scored], chosen: Reading) -> list[Row]:
    """One row per reading and trial: length and seeds, the verdict on every statement, how many hold, the score."""
    finalists = {each.reading.name for each in finals}
    table: list[Row] = []
    for each in (*finals, *sorted(screened, key=lambda one: (-score(one.found), one.order))):
        verdicts = {id_: verdict_on(id_, each.found).verdict for id_ in statements_of(each.found)}
        table.append(
            {
                "reading": each.reading.name,
                "trial": each.trial.name,
                "steps": each.trial.steps_of(each.reading),
                "seeds": each.trial.seeds,
                **verdicts,
                "hold": holding(each.found),
                "do_not": list(verdicts.values()).count("does not hold"),
                "score": score(each.found),
                "printed": each.reading == printed(),
                "finalist": each.reading.name in finalists,
                "chosen": each.reading == chosen,
            }
        )
    return table


def _finalists(screened: Sequence[Scored]) -> list[Reading]:
    """The best of the screen, and the printed reading."""
    ranked = sorted(screened, key=lambda each: (-score(each.found), each.order))
    best = [each.reading for each in ranked[:FINALISTS]]
    return list(dict.fromkeys([*best, printed()]))


def _run(
    chosen: Sequence[Reading],
    trial: Trial,
    out: Path,
    quick: bool,
    jobs: int | None,
    report: Report | None,
    device: str,
) -> list[Scored]:
    """Run a trial for these readings, and judge each."""
    groups: list[Group] = [group for reading in chosen for group in groups_of(reading, trial)]
    rows = run_plan(Plan(STUDY, quick, trial.steps, trial.seeds, tuple(groups)), out, jobs, report, device)
    scored = []
    for reading in chosen:
        main, placement = (rows[f"{trial.name}/{reading.slug}/{part}"] for part in ("main", "placement"))
        steps = trial.steps_of(reading)
        found = judge_statements(main, placement, _episodes(reading, trial), steps)
        scored.append(Scored(reading, trial, found, main))
    return scored


def _episodes(reading: Reading, trial: Trial) -> dict[float, list[Episode]]:
    """Clusters of the fast buoys at each target speed; runs of up to 20,000 steps, as many as seeds."""
    steps = min(trial.steps_of(reading), QUICK_STEPS)
    return {speed: watch_clusters(steps, trial.seeds, (speed,), reading.changes) for speed in SPEEDS}
