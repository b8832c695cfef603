"""What a notebook and a terminal show of scenarios, records, trajectories and estimates: in short, as text."""

import re

import pytest

import shoal
from shoal.core.errors import UnknownNameError
from shoal.metrics.summary import METRICS
from shoal.record.statistics import Estimate, estimate
from shoal.record.words import mean_text

HOSTILE = "<img src=x onerror=alert(1)>"


@pytest.fixture(scope="module")
def scenario():
    return shoal.load("oceans2020", name=HOSTILE, steps=400, **{"fleets.0.name": HOSTILE})


@pytest.fixture(scope="module")
def record(scenario):
    return shoal.simulate(scenario, runs=2)


@pytest.fixture(params=["scenario", "record", "trajectory", "estimate"])
def shown(request, scenario, record):
    estimate = record.estimate("time_on_target")
    return {
        "scenario": scenario,
        "record": record,
        "trajectory": record.trajectories[0],
        "estimate": estimate,
    }[request.param]


def test_a_repr_is_one_line(shown):
    assert len(repr(shown)) < 300
    assert "\n" not in repr(shown)
    assert "\n" not in str(shown)


def test_html_is_well_formed_and_names_in_it_are_text(shown):
    page = shown._repr_html_()
    assert "<img" not in page
    for tag in ("div", "table", "tr", "td", "th", "pre", "b", "details", "summary"):
        assert len(re.findall(rf"<{tag}[ >]", page)) == page.count(f"</{tag}>")


def test_a_scenario_says_who_looks_for_what():
    assert repr(shoal.load("oceans2020", steps=400)).startswith(
        "<Scenario oceans2020: 15 BoB-1 (2.6 m/s) + 35 BoB-0 (1 m/s), k = 20, knn-pso; waypoint target at 3 m/s; "
        "400 steps of 0.1 s, seed 1, "
    )


def test_a_scenario_that_cannot_run_is_shown_too(scenario):
    forced = scenario.model_copy()
    vars(forced).update(fleets=None)
    assert repr(forced) == "<Scenario that cannot run>"
    assert "fleets" in forced._repr_html_()


def test_the_html_of_a_record_is_the_table_of_its_run(record):
    page = record._repr_html_()
    missing = [name for name in METRICS if f">{name}<" not in page]
    assert missing == [name for name, each in METRICS.items() if each.several_targets or each.asked]
    assert "fairness" in missing  # of one target it says nothing
    assert mean_text(record.estimate("xi")) in page


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (estimate([0.5, 0.75]), "Estimate(mean=0.625, ci95=(-0.9634, 2.213), runs=(0.5, 0.75))"),
        (estimate([0.5]), "Estimate(mean=0.5, ci95=None, runs=(0.5))"),
        (Estimate(0.5, (0.25, 0.75), (0.5,) * 20), "Estimate(mean=0.5, ci95=(0.25, 0.75), runs=<20 values>)"),
    ],
)
def test_an_estimate_is_rounded(value, text):
    assert repr(value)[:20] == text[:20]
    assert repr(value).endswith(text[text.index("runs=") :])


class TestNames:
    """A name that is not there is answered with those that are."""

    @pytest.mark.parametrize(
        ("wrong", "meant"),
        [("tot", "time_on_target"), ("time_on_targt", "time_on_target"), ("detection", "first_detection")],
    )
    def test_of_metrics(self, record, wrong, meant):
        with pytest.raises(UnknownNameError, match=rf"did you mean '{meant}'\? there are: time_on_target, ") as error:
            record.estimate(wrong)
        assert isinstance(error.value, KeyError)
        assert isinstance(error.value, shoal.ShoalError)

    def test_of_metrics_of_fleets(self, record):
        with pytest.raises(UnknownNameError, match="did you mean 'power'"):
            record.fleet_estimate("powr")

    def test_of_tables(self, record):
        with pytest.raises(UnknownNameError, match="did you mean 'frames'"):
            record.to_pandas("frame")

    def test_of_fields_of_a_trajectory(self, record):
        with pytest.raises(AttributeError, match=r"did you mean 'target_x'\? there are: step, x, y"):
            record.trajectories[0].targetx  # noqa: B018
        with pytest.raises(UnknownNameError, match="did you mean 'repulsion'"):
            record.trajectories[0].memory["repulsoin"]

    def test_of_parts_of_a_record(self, record):
        with pytest.raises(AttributeError, match="did you mean 'trajectories'"):
            record.trajectory  # noqa: B018
