"""One name and one unit per metric."""

from shoal.metrics.summary import METRICS
from shoal.record.names import label_of, unit_text


def test_names_differ():
    assert len({each.words for each in METRICS.values()}) == len(METRICS)


def test_a_label_is_name_and_unit():
    assert [label_of(name) for name in ("time_on_target", "reacquisition", "power", "xi", "engaged", "response")] == [
        "time on target [share]", "reacquisition [s]", "power [m³/s³]", "velocity fluctuation Ξ", "engaged agents",
        "response [arena units/step]",
    ]  # fmt: skip


def test_a_share_is_told_as_one_and_lies_between_0_and_1():
    shares = [each for each in METRICS.values() if unit_text(each) == "share" and not each.asked]
    assert {"time_on_target", "stationary", "found"} <= {each.name for each in shares}
    assert {each.high for each in shares} <= {1.0, "reach"}
