import pytest

from shoal.core.errors import ScenarioError
from shoal.experiments.design import parse_vary
from shoal.experiments.variable import Variable, parse_variable


class TestRanges:
    """FROM:TO; continuous where an end has a decimal point."""

    def test_of_whole_numbers(self):
        assert parse_variable("neighbors=5:40") == Variable("neighbors", 5, 40)
        assert parse_variable("target-speed=1:6").field == "target_speed"

    @pytest.mark.parametrize("text", ["strategy.delta=0.5:2", "strategy.delta=0.5:2.0", "strategy.delta=1e-3:2"])
    def test_of_decimals(self, text):
        assert not parse_variable(text).whole

    def test_shares_lead_there_and_back(self):
        for variable in (Variable("a", 0.002, 0.05), Variable("b", -1.0, 1.0), Variable("c", 3, 9)):
            low, *_, high = (variable.spread(share) for share in (0.0, 0.5, 1 - 1e-12))
            assert (low, high) == pytest.approx((variable.low, variable.high))
            assert [variable.share(each) for each in (low, high)] == pytest.approx([0, 1])

    def test_a_wide_range_of_decimals_is_searched_by_its_logarithm(self):
        assert Variable("a", 0.01, 1.0).spread(0.5) == pytest.approx(0.1)
        assert Variable("a", 0.0, 1.0).spread(0.5) == pytest.approx(0.5)

    def test_values_have_four_digits_and_stay_inside(self):
        assert Variable("a", 0.0, 1.0).value(0.123456) == 0.1235
        assert Variable("a", 0.12344, 0.2).value(0.123441) == 0.12344

    @pytest.mark.parametrize(
        ("text", "told"),
        [
            ("neighbors=40:5", "is empty"),
            ("neighbors=5:5", "one value only"),
            ("neighbors", "is not a variation"),
            ("strategy.delta=1:inf", "has no end"),
            ("strategy=encircle", "nothing to choose"),
            ("neighbors=5,5", "nothing to choose"),
        ],
    )
    def test_that_leave_nothing_to_search_are_refused(self, text, told):
        with pytest.raises(ScenarioError, match=told):
            parse_variable(text)

    @pytest.mark.parametrize("text", ["strategy.delta=0.002:0.05", "target-speed=1:2.5"])
    def test_of_decimals_without_a_step_are_for_tune_and_not_for_a_sweep(self, text):
        with pytest.raises(ScenarioError, match=r"decimal ends and no step\n  fix: add a step, .*shoal tune"):
            parse_vary(text)
        assert parse_vary("strategy.delta=0.1:0.3:0.1")[1] == pytest.approx([0.1, 0.2, 0.3])


def test_values_one_by_one_are_choices():
    variable = parse_variable("strategy=encircle,knn-pso")
    assert [variable.value(place) for place in (0, 1)] == ["encircle", "knn-pso"]
    assert parse_variable("neighbors=5:20:5").choices == (5, 10, 15, 20)
