import pytest

from shoal.core.errors import ScenarioError
from shoal.experiments.design import (
    Design,
    grid,
    is_design_file,
    latin_hypercube,
    parse_vary,
    read_design,
    together,
)


class TestVariations:
    def test_a_range_includes_its_end(self):
        assert parse_vary("neighbors=10:49:13") == ("neighbors", [10, 23, 36, 49])

    def test_a_range_of_decimals_does_not_lose_its_end_to_rounding(self):
        name, values = parse_vary("strategy.delta=0.1:0.3:0.1")
        assert name == "strategy.delta"
        assert values == pytest.approx([0.1, 0.2, 0.3])

    def test_a_list_keeps_numbers_and_words(self):
        assert parse_vary("motion.update_order=synchronous,sequential")[1] == ["synchronous", "sequential"]
        assert parse_vary("target-speed=3,5.5") == ("target_speed", [3, 5.5])

    @pytest.mark.parametrize("text", ["neighbors", "neighbors=", "=3", "neighbors=9:3", "neighbors=1:9:0"])
    def test_anything_else_is_refused(self, text):
        with pytest.raises(ScenarioError):
            parse_vary(text)


class TestPoints:
    def test_a_grid_has_every_combination_once(self):
        points = grid({"a": [1, 2], "b": [3, 4, 5]})
        assert len(points) == 6
        assert points[0] == {"a": 1, "b": 3}
        assert points[-1] == {"a": 2, "b": 5}

    def test_zip_takes_the_fields_together(self):
        assert together({"a": [1, 2], "b": [3, 4]}) == [{"a": 1, "b": 3}, {"a": 2, "b": 4}]

    def test_zip_refuses_unequal_lengths(self):
        with pytest.raises(ScenarioError, match="a 2, b 1"):
            together({"a": [1, 2], "b": [3]})

    def test_a_latin_hypercube_hits_every_stratum_of_every_field_once(self):
        points = latin_hypercube({"x": [0.0, 1.0], "k": [1, 10]}, samples=10, seed=3)
        assert sorted(int(point["x"] * 10) for point in points) == list(range(10))
        assert sorted(point["k"] for point in points) == list(range(1, 11))


class TestDesignFile:
    def test_grid_and_points_multiply(self, tmp_path):
        file = tmp_path / "design.toml"
        file.write_text(
            'scenario = "oceans2020"\nruns = 3\n[vary]\nneighbors = "10:12"\n'
            '[[points]]\nfast = 0\n[[points]]\nfast = 15\n"strategy.delta" = 0.02\n'
        )
        design = read_design(str(file))
        assert is_design_file(str(file))
        assert (design.runs, len(design.points)) == (3, 6)
        assert design.fields == ["fast", "neighbors", "strategy.delta"]

    def test_unknown_fields_are_refused(self, tmp_path):
        file = tmp_path / "design.toml"
        file.write_text('scenario = "oceans2020"\nrun = 3\n[vary]\nneighbors = [3]\n')
        with pytest.raises(ScenarioError, match="run: unknown field"):
            read_design(str(file))

    def test_a_preset_is_no_design(self):
        assert not is_design_file("oceans2020")

    def test_fields_come_in_order_of_first_use(self):
        assert Design("x", ({"b": 1}, {"a": 1, "b": 2}), 1).fields == ["b", "a"]
