"""Which conclusions depend on a choice: those whose verdict another choice turns."""

import pytest

from paper_rows import KS, hill, made
from shoal.paper.clusters import Episode
from shoal.paper.sensitivity import Extra, conclusion_table, peak_table
from shoal.paper.statements import at_full_length

METRICS = ("time_on_target", "xi", "xi_raw", "stationary")
POINTS = [(fast, k, 3.0) for fast in (15, 0) for k in KS]


def variant(name, best, xi=25):
    metrics = {
        "time_on_target": lambda fast, k, speed: hill(best if fast else best + 5)(k),
        "xi": lambda fast, k, speed: hill(xi)(k),
        "xi_raw": lambda fast, k, speed: hill(xi)(k),
        "stationary": lambda fast, k, speed: 0.01 * speed,
    }
    return made(metrics, points=POINTS, variant=name)


def test_one_row_of_peaks_for_each_variant_and_swarm_with_the_truth_inside():
    table = peak_table([*variant("baseline", 18), *variant("omega", 22)])
    assert [(row["variant"], row["fast"]) for row in table] == [
        ("baseline", 15), ("baseline", 0), ("omega", 15), ("omega", 0)
    ]  # fmt: skip
    for row, truth in zip(table, (18, 23, 22, 27), strict=True):
        assert row["k_star_low"] <= truth <= row["k_star_high"]
        assert row["xi_peak_k_low"] <= 25 <= row["xi_peak_k_high"]
        assert row["time_on_target_low"] < row["time_on_target"] == pytest.approx(0.8, abs=0.003)
        assert not row["at_edge"]


def test_rows_without_variants_are_told_apart_by_swarm_and_speed():
    table = peak_table(made({"time_on_target": lambda *_: 0.5, "xi": lambda *_: 0.5}))
    assert [(row["target_speed"], row["fast"]) for row in table] == [(3.0, 15), (3.0, 0), (5.0, 15), (5.0, 0)]
    assert "variant" not in table[0]


def test_a_conclusion_that_turns_is_named():
    baseline, same, late = conclusion_table([*variant("baseline", 18), *variant("same", 18), *variant("late", 30)])
    assert (baseline["C3"], baseline["C6"], baseline["changed"]) == ("holds", "holds", "")
    assert same["changed"] == ""
    assert (late["C3"], late["C4"], late["C6"]) == ("does not hold", "holds", "does not hold")
    assert set(late["changed"].split()) >= {"C3", "C6"}


def test_a_variant_with_other_starts_and_clusters_is_judged_on_all_claims():
    rows = variant("baseline", 18)
    placement = [
        {**row, "fleets.BoB-1.start": start, "time_on_target": row["time_on_target"] + shift + 1e-4 * row["run"]}
        for row in rows
        if (row["fast"], row["neighbors"]) == (15, 20)
        for start, shift in (("corner", 0.0), ("center", 0.1))
    ]
    episodes = [Episode(0, 0, 50, True)] * 5
    (row,) = conclusion_table(rows, {"baseline": Extra(placement, episodes, 100_000)})
    assert list(row) == ["variant", *(f"C{n}" for n in range(1, 14)), "changed", "time_on_target"]
    assert (row["C11"], row["C12"]) == ("holds partly", "holds")


def test_short_runs_may_vary_more():
    rows = at_full_length(variant("baseline", 18), 9 * 100_000)  # three times the deviation
    long, short = (conclusion_table(rows, {"baseline": Extra([], [], steps)})[0] for steps in (100_000, 10_000))
    assert long["C13"] in ("does not hold", "holds partly")
    assert short["C13"] == "holds"


def test_what_is_undecided_has_not_turned():
    flat = made(dict.fromkeys(METRICS, lambda *_: 0.5), points=POINTS, variant="flat")
    row = conclusion_table([*variant("baseline", 18), *flat])[1]
    undecided = {id_ for id_, verdict in row.items() if verdict == "undecided"}
    assert undecided >= {"C3", "C5"}
    assert not undecided & set(row["changed"].split())


def test_without_variants_there_are_no_conclusions():
    assert conclusion_table([]) == []
    assert peak_table([]) == []
