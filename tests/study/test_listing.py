"""What there is, as lists that a notebook shows, and the check of a scenario."""

import pytest

import shoal
from shoal.core.errors import ScenarioError, UnknownNameError
from shoal.metrics.summary import METRICS
from shoal.strategies import CATALOGUE

LISTS = (shoal.list_metrics, shoal.list_strategies, shoal.list_presets)


def test_nothing_is_left_out():
    assert shoal.list_metrics().names == list(METRICS)
    assert shoal.list_strategies().names == sorted(CATALOGUE)
    assert shoal.list_presets().names == shoal.presets()


def test_metrics_say_unit_direction_and_what_they_are():
    power = shoal.list_metrics()["power"]
    assert (power.unit, power.direction) == ("m^3/s^3", "less is better")
    assert shoal.list_metrics()["time_on_target"].direction == "more is better"
    assert shoal.list_metrics()["xi"].direction == "neither"
    assert all(each.sentence and each.unit for each in shoal.list_metrics())


def test_strategies_say_their_parameters():
    known = shoal.list_strategies()["knn-pso"]
    assert known.parameters["delta"] == 0.01
    assert (known.knows_target, known.source) == (False, "Shoal")
    assert shoal.list_strategies()["pursuit"].knows_target


@pytest.mark.parametrize("listed", LISTS)
class TestLists:
    """Of every kind."""

    def test_by_number_by_name_and_in_a_loop(self, listed):
        found = listed()
        assert found[0] == found[found.names[0]] == next(iter(found))
        assert found.names[0] in found
        assert "no-such" not in found
        assert len(found[:2]) == 2

    def test_a_name_that_is_not_there(self, listed):
        with pytest.raises(UnknownNameError, match="there are: "):
            listed()["no-such"]

    def test_a_row_each(self, listed):
        found = listed()
        assert len(repr(found).splitlines()) == 1 + len(found)
        assert found._repr_html_().count("<tr>") == 1 + len(found)

    def test_as_a_table(self, listed):
        pytest.importorskip("pandas", reason="tables need pandas: pip install 'shoal[sweep]'")
        assert listed().to_pandas()["name"].tolist() == listed().names


def test_a_scenario_that_can_run_has_no_notes_to_make():
    assert shoal.check("oceans2020", neighbors=10) == []


def test_one_that_cannot_says_why():
    with pytest.raises(ScenarioError, match="at most 49"):
        shoal.check("oceans2020", neighbors=50)


def test_what_was_dropped_from_a_track_is_noted(tmp_path):
    rows = [f"2020-01-01T00:{minute:02}:00Z,{50 + minute / 1000},{minute / 1000}" for minute in range(20)]
    (tmp_path / "track.csv").write_text("\n".join(["time,lat,lon", *rows, rows[-1]]))
    assert any("repeating" in note for note in shoal.check("oceans2020", target_track=tmp_path / "track.csv"))
