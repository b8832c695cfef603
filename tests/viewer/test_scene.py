"""The scene: what the page is told once."""

import json

import pytest

from scenarios import scenario
from shoal.strategies import CATALOGUE
from shoal.viewer.scene import as_json, describe, scene_of


def scene(changes=None, memory=("repulsion",)):
    chosen = scenario(changes=changes)
    return scene_of(chosen, memory, has_links=True, epoch=2, since=40)


class TestSceneOf:
    def test_it_says_what_the_protocol_says(self):
        told = json.loads(as_json(scene()))
        assert (told["epoch"], told["since"], told["name"], told["seed"]) == (2, 40, "oceans2020", 1)
        assert told["area"] == {"width": 20, "height": 20, "half_x": 8.5, "half_y": 8.5}
        assert [(fleet["name"], fleet["count"]) for fleet in told["fleets"]] == [("BoB-1", 15), ("BoB-0", 35)]
        assert told["targets"] == [{"kind": "waypoint", "name": None, "radius": 1.0, "speed": 3.0}]
        assert (told["neighbors"], told["range"], told["unit"], told["time_step"]) == (20, None, 1.0, 0.1)
        assert told["strategy"]["name"] == "knn-pso"
        assert told["strategy"]["params"]["delta"] == 0.01
        assert "name" not in told["strategy"]["params"]

    def test_a_target_at_rest_has_no_speed(self):
        assert scene({"targets": [{"kind": "still", "radius": 2.0}]})["targets"][0]["speed"] is None

    def test_everybody_may_be_heard(self):
        assert scene({"network.neighbors": "all"})["neighbors"] == "all"

    def test_those_who_join_later_are_counted(self):
        told = scene({"joins": [{"step": 5, "count": 3, "fleet": "BoB-0"}]})
        assert [fleet["count"] for fleet in told["fleets"]] == [15, 38]

    def test_spacing_is_there_for_strategies_that_remember_it(self):
        assert scene()["has_repulsion"]
        assert not scene(memory=("heading",))["has_repulsion"]

    def test_a_seed_that_javascript_cannot_hold_is_text(self):
        assert scene({"seed": 2**64 - 1})["seed"] == str(2**64 - 1)


class TestDescribe:
    @pytest.mark.parametrize("name", sorted(CATALOGUE))
    def test_every_strategy_has_its_parameters_with_defaults(self, name):
        told = describe(CATALOGUE[name])
        assert told["summary"]
        assert set(told["parameters"]) == set(CATALOGUE[name].params._fields)
        for field in told["parameters"].values():
            assert field["type"] in ("number", "integer", "string", "boolean")
            assert field["choices"] is None or field["default"] in field["choices"]


class TestAsJson:
    def test_a_number_that_does_not_exist_is_null(self):
        assert json.loads(as_json({"a": [float("nan"), float("inf"), 1.0]})) == {"a": [None, None, 1.0]}

    def test_no_text_ends_a_script_element(self):
        hostile = "</script><script>alert(1)</script><!--"
        told = as_json({"name": hostile})
        assert "<" not in told
        assert json.loads(told)["name"] == hostile
