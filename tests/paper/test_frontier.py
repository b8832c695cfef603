"""Statements that exclude each other: met under some reading each, under none together."""

from shoal.paper.frontier import frontier_table
from shoal.paper.results import Claim


def found(**verdicts):
    """Verdicts on statements, at both speeds; a tuple tells the number too."""
    told = {id_: (each if isinstance(each, tuple) else (each, 0.0)) for id_, each in verdicts.items()}
    return {
        (id_, "both"): Claim(id_, id_, f"it is {value}", value, value, value, "1", verdict, "")
        for id_, (verdict, value) in told.items()
    }


def test_a_pair_that_no_reading_meets_is_told_in_both_orders_with_the_nearest():
    readings = {
        "old": found(C2="holds", C4=("does not hold", -3.0)),
        "near": found(C2="holds", C4=("does not hold", -1.0)),
        "new": found(C2="does not hold", C4="holds"),
    }
    first, second = frontier_table(readings)
    assert (first["first"], first["second"], first["nearest"], first["second_there"]) == (
        "C2",
        "C4",
        "near",
        "it is -1.0",
    )
    assert (first["readings_first"], first["readings_second"]) == (2, 1)
    assert (second["first"], second["second"], second["nearest"]) == ("C4", "C2", "new")


def test_what_one_reading_meets_together_is_no_row():
    assert frontier_table({"old": found(C2="holds", C4="holds"), "new": found(C2="holds", C4="undecided")}) == []


def test_a_statement_that_holds_nowhere_is_told_with_where_it_comes_nearest():
    readings = {
        "old": found(C2="holds", C13=("does not hold", 0.9)),
        "new": found(C2="holds", C13=("holds partly", 0.5)),
    }
    (row,) = frontier_table(readings)
    assert (row["first"], row["second"], row["nearest"], row["verdict_there"]) == ("C13", "", "new", "holds partly")


def test_nearest_to_an_about_value_is_the_smallest_distance():
    readings = {
        "a": found(C2="holds", C3=("does not hold", 24.0)),
        "b": found(C2="holds", C3=("does not hold", 13.0)),
        "c": found(C2="undecided", C3="holds"),
    }
    assert frontier_table(readings)[0]["nearest"] == "b"


def test_of_nothing_there_is_no_frontier():
    assert frontier_table({}) == []
