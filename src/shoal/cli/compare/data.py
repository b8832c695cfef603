"""Comparisons and leaderboards as JSON."""

import math
from typing import Any

from shoal.core.version import RESULTS_VERSION
from shoal.experiments.comparison import Comparison, Condition, Standing
from shoal.experiments.leaderboard import Leaderboard
from shoal.metrics.summary import METRICS

_BETTER = {1: "higher", -1: "lower", 0: None}


def comparison_data(comparison: Comparison, metric: str, direction: int, about: dict[str, Any]) -> dict[str, Any]:
    """What --json prints of a comparison; null where there is no number."""
    return {
        "metric": metric,
        "unit": METRICS[metric].unit,
        "better": _BETTER[direction],
        "baseline": comparison.baseline,
        "tests": comparison.tests,
        **about,
        "results_version": RESULTS_VERSION,
        "conditions": [{"condition": each.point, "strategies": _standings(each)} for each in comparison.conditions],
    }


def leaderboard_data(board: Leaderboard) -> dict[str, Any]:
    """What --json prints of a leaderboard."""
    suite = board.suite
    return {
        "suite": suite.name,
        "hash": board.hash,
        "scenario": suite.scenario,
        "runs": suite.runs,
        "steps": suite.steps,
        "seed": suite.seed,
        "results_version": RESULTS_VERSION,
        "baseline": board.score.baseline,
        "score": _standings(board.overall),
        "conditions": [
            {
                "name": condition.name,
                "says": condition.says,
                "metric": condition.metric,
                "out_of": condition.out_of,
                "changes": condition.changes,
                "scenario": condition.scenario or suite.scenario,
                "steps": condition.steps or suite.steps,
                "strategies": _standings(found),
            }
            for condition, found in zip(suite.conditions, board.shares.conditions, strict=True)
        ],
    }


def _standings(condition: Condition) -> list[dict[str, Any]]:
    return [_standing(each) for each in condition.standings]


def _standing(each: Standing) -> dict[str, Any]:
    known = each.difference
    return {
        "strategy": each.strategy,
        "informed": each.informed,
        "rank": each.rank,
        "mean": _finite(each.value.mean),
        "ci95": each.value.ci95,
        "runs": each.value.runs,
        "missing": each.missing,
        "verdict": each.verdict,
        "difference": known
        and {
            "mean": _finite(known.mean),
            "ci95": known.ci95,
            "p": known.p,
            "adjusted_p": each.adjusted_p,
            "pairs": known.pairs,
        },
    }


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
