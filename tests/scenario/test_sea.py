"""What a scenario may say of its sea, and what is refused."""

from pathlib import Path

import numpy as np
import pytest

from shoal.core.errors import ScenarioError
from shoal.scenario.load import load, scenario_from, table_of, to_toml
from shoal.scenario.windage import CLASSES, leeway

FLOW = {"kind": "uniform", "x": 0.3}
SQUARE = [[[-3.0, -3.0], [3.0, -3.0], [3.0, 3.0], [-3.0, 3.0]]]


def with_sea(**sea):
    return load("oceans2020", sea=sea)


class TestTable:
    def test_quantities_have_units(self):
        sea = with_sea(currents={"kind": "tide", "major_x": "2 kn", "period": "6 h", "phase": "90 deg"}).sea
        assert sea.currents.major_x == pytest.approx(2 * 1852 / 3600)
        assert sea.currents.period == 21600.0

    def test_toml_says_it_again(self):
        scenario = load(
            "oceans2020",
            sea={"start": "2015-11-16T06:00:00+01:00", "currents": FLOW, "coast": SQUARE},
            **{"fleets.BoB-1.windage": "2 %", "targets.0.windage": "person-in-water"},
        )
        import tomllib

        again = scenario_from(tomllib.loads(to_toml(scenario)))
        assert again == scenario
        assert again.hash == scenario.hash
        assert scenario.sea.start.utcoffset().total_seconds() == 3600.0

    def test_nothing_said_changes_no_hash(self):
        assert load("oceans2020").hash == scenario_from({**table_of("oceans2020"), "sea": None}).hash

    def test_an_option_sets_a_field(self):
        scenario = load("oceans2020", **{"sea.start": "2015-11-16T06:00:00Z"})
        assert scenario.sea.start.hour == 6
        assert load(scenario, **{"sea.currents": FLOW}).sea.currents.x == 0.3

    def test_files_are_relative_to_the_scenario(self, tmp_path):
        from shoal.scenario.load import read_table

        (tmp_path / "here.toml").write_text('[sea]\ncurrents = "currents.nc"\ncoast = "../coast.geojson"\n')
        sea = read_table(tmp_path / "here.toml")["sea"]
        assert Path(sea["currents"]) == tmp_path / "currents.nc"
        assert Path(sea["coast"]).resolve() == tmp_path.parent / "coast.geojson"

    def test_where_files_lie_does_not_count(self):
        table = {
            **table_of("oceans2020"),
            "area": {"width": 2e4, "height": 2e4, "origin": (5.0, 60.0)},
            "sea": {"start": "2015-11-16T06:00:00Z", "currents": "a.nc", "digest": "0123"},
        }
        moved = {**table, "sea": {**table["sea"], "currents": "b.nc"}}
        other = {**table, "sea": {**table["sea"], "digest": "4567"}}
        hashes = [scenario_from(each).hash for each in (table, moved, other)]
        assert hashes[0] == hashes[1] != hashes[2]


REFUSED = [
    ({"start": "2015-11-16T06:00:00"}, "sea.start", "clock"),
    ({"start": "yesterday"}, "sea.start", "no time"),
    ({"start": 5}, "sea.start", "no time"),
    ({"currents": "a.nc"}, "sea", "start"),
    ({"start": "2015-11-16T06:00:00Z", "currents": "a.nc"}, "origin", "origin"),
    ({"coast": "a.geojson"}, "origin", "origin"),
    ({"currents": {"kind": "tied"}}, "sea.currents", "did you mean 'tide'"),
    ({"currents": {"x": 1.0}}, "sea.currents", "kind"),
    ({"currents": 7}, "sea.currents", "name a file"),
    ({"currents": {"kind": "tide", "amplitude": 1.0}}, "sea.currents.amplitude", "unknown field"),
    ({"currents": {"kind": "gyre", "speed": 1.0}}, "sea.currents.side", "missing"),
    ({"currents": {"kind": "gyre", "speed": 1.0, "side": 0.0}}, "sea.currents.side", "greater than 0"),
    ({"coast": [[[0.0, 0.0], [1.0, 1.0]]]}, "sea.coast", "3 corners"),
    ({"coast": []}, "sea.coast", "at least 1"),
    ({"coast": ""}, "sea.coast", "name one"),
    ({"curents": FLOW}, "sea.curents", "did you mean 'currents'"),
]


@pytest.mark.parametrize(("sea", "where", "says"), REFUSED, ids=[str(each[0])[:60] for each in REFUSED])
def test_is_refused(sea, where, says):
    with pytest.raises(ScenarioError) as error:
        with_sea(**sea)
    assert where in str(error.value)
    assert says in str(error.value)


class TestWindage:
    def test_a_share(self):
        assert leeway(0.03) == (0.03, 0.0, 1.0, 0.0)
        assert leeway(None) == (0.0, 0.0, 1.0, 0.0)

    def test_a_class(self):
        slope, offset, cosine, sine = leeway("person-in-water")
        assert (slope, offset) == (0.011, pytest.approx(0.036, abs=1e-3))
        assert np.degrees(np.arctan2(sine, cosine)) == pytest.approx(30.0)

    @pytest.mark.parametrize("wrong", ["persn-in-water", 1.5, -0.1, "3 kn", True])
    def test_anything_else_is_refused(self, wrong):
        with pytest.raises(ScenarioError, match="windage"):
            load("oceans2020", **{"fleets.BoB-1.windage": wrong})

    def test_the_page_says_every_class(self):
        page = (Path(__file__).resolve().parents[2] / "docs/reference/sea.md").read_text(encoding="utf-8")
        for name, (slope, offset, divergence) in CLASSES.items():
            row = next(line for line in page.splitlines() if line.startswith(f"| `{name}`"))
            numbers = [float(cell) for cell in row.split("|")[2:5]]
            assert numbers == pytest.approx([slope, offset * 3600 / 1852, divergence])
