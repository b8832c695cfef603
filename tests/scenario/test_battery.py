"""Batteries: what goes with what, and what is assumed."""

import tomllib

import pytest

from scenarios import scenario
from shoal.core.errors import ScenarioError
from shoal.scenario.assumptions import assumptions
from shoal.scenario.battery import assumed_drag
from shoal.scenario.load import load, scenario_from, to_toml


def with_battery(**fields):
    return scenario("oceans2020", {"fleets.0.battery": {"capacity": "100 Wh", **fields}})


class TestFields:
    """Units at the door, and one error for what cannot be."""

    def test_are_si_inside(self):
        battery = with_battery(hotel="5 W", curve=[[0, 0], ["2 kn", "30 W"], [3, "0.1 kW"]]).fleets[0].battery
        assert (battery.capacity, battery.hotel) == (360_000.0, 5.0)
        assert battery.curve[1] == pytest.approx((1.0289, 30.0), abs=1e-4)
        assert battery.curve[2] == (3.0, 100.0)

    def test_come_back_from_toml(self):
        chosen = with_battery(curve=[[0, 0], [3, 10]])
        assert scenario_from(tomllib.loads(to_toml(chosen))) == chosen

    @pytest.mark.parametrize(
        ("fields", "problem"),
        [
            ({"capacity": "100 W"}, "not a quantity in J"),
            ({"capacity": 0}, "greater than 0"),
            ({"hotel": -1}, "greater than or equal to 0"),
            ({"drag": 1.0, "curve": [[0, 0], [3, 1]]}, "curve is given and drag, too"),
            ({"curve": [[0.5, 1], [3, 1]]}, "not known below 0.5 m/s"),
            ({"curve": [[0, 1], [3, 1], [3, 2]]}, "not in order"),
            ({"curve": [[0, 1]]}, "at least 2"),
            ({"curve": [[0, 1], [1, 1]]}, "known up to 1 m/s, but max_speed is 2.6"),
            ({"curve": [[0, 1], [3, 1, 4]]}, ""),
            ({"capacty": 1.0}, "unknown field"),
        ],
    )
    def test_that_are_wrong_are_one_error(self, fields, problem):
        with pytest.raises(ScenarioError) as caught:
            with_battery(**fields)
        assert problem in str(caught.value)

    def test_without_mass_nothing_is_assumed(self):
        table = load("oceans2020").model_dump()
        del table["fleets"][0]["mass"]
        table["fleets"][0]["battery"] = {"capacity": 1.0}
        with pytest.raises(ScenarioError, match=r"give battery\.drag or mass"):
            scenario_from(table)
        table["fleets"][0]["battery"]["drag"] = 0.0
        assert scenario_from(table).fleets[0].battery.drag == 0.0


class TestAssumedDrag:
    """Of a blunt body that displaces its mass; said wherever it is used."""

    def test_of_a_cubic_meter_of_sea_water(self):
        assert assumed_drag(1025.0) == pytest.approx(1025.0 / 0.6)

    def test_grows_as_the_area(self):
        assert assumed_drag(8.0) == pytest.approx(4 * assumed_drag(1.0))

    def test_is_said(self):
        (sentence,) = assumptions(with_battery())
        assert "is assumed to draw" in sentence

    @pytest.mark.parametrize("fields", [{"drag": 3.0}, {"curve": [[0, 0], [3, 1]]}])
    def test_what_is_given_is_not(self, fields):
        assert assumptions(with_battery(**fields)) == []


def test_a_sensor_of_no_radius_cannot_be_inverse_cube():
    with pytest.raises(ScenarioError, match="say at what range the chance is 1/2"):
        scenario("oceans2020", {"fleets.0.sensor": "inverse-cube"})
