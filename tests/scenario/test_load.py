"""A scenario file comes in whole, or is refused with one error that says file, line, field, reason and remedy."""

import math
import re
import tomllib
from datetime import datetime

import pytest

from scenarios import changed, fleets, scenario
from shoal.core.errors import ScenarioError, StrategyError
from shoal.scenario.load import load, preset_text, presets, read_table, scenario_from, to_toml
from shoal.scenario.schema import Scenario, json_schema

PAPERS = ["aamas2020", "aamas2020-constant", "alife2023", "density2023", "oceans2020", "oceans2020-refit"]
PRESETS = sorted([*PAPERS, "bay", "offshore"])


def needs_the_sea(name):
    """Skip where a preset names files that cannot be read here."""
    for library in ("pyproj", "netCDF4") if name == "offshore" else ():
        pytest.importorskip(library, reason="gridded currents need pip install '.[maritime]'")


def written(folder, text):
    path = folder / "my.toml"
    path.write_text(text, encoding="utf-8")
    return path


def edited(folder, old, new):
    """oceans2020 with one thing changed, and the number of the line that changed."""
    text = preset_text("oceans2020")
    assert old in text
    return written(folder, text.replace(old, new, 1)), text[: text.index(old)].count("\n") + 1


def refusal(source):
    """(where, problem, fix) of the one error."""
    with pytest.raises(ScenarioError) as caught:
        load(source)
    assert str(caught.value).count("fix:") == 1
    return caught.value.args


class TestPresets:
    """They come with Shoal and run as they are."""

    def test_are_these(self):
        assert presets() == PRESETS

    @pytest.mark.parametrize("name", PAPERS)
    def test_load_and_say_what_they_are(self, name):
        chosen = load(name)
        assert chosen.name == name
        assert chosen.agents == 50
        assert chosen.steps == 100_000
        assert chosen.description

    @pytest.mark.parametrize(("name", "hours"), [("bay", 2), ("offshore", 6)])
    def test_of_the_sea_can_be_exported_and_counted_in_money_and_power(self, name, hours):
        needs_the_sea(name)
        chosen = load(name)
        assert (chosen.name, chosen.steps * chosen.time_step) == (name, 3600 * hours)
        assert chosen.area.origin
        assert chosen.sea.start
        assert all(fleet.cost for fleet in chosen.fleets)
        assert chosen.fleets[0].battery

    def test_a_preset_that_names_files_can_be_saved_anywhere(self, tmp_path):
        needs_the_sea("offshore")
        assert load(written(tmp_path, preset_text("offshore"))) == load("offshore")

    def test_oceans2020_is_the_paper_as_printed(self):
        chosen = load("oceans2020")
        assert [(fleet.count, fleet.max_speed, fleet.mass) for fleet in chosen.fleets] == [
            (15, 2.6, 3.2),
            (35, 1.0, 7.4),
        ]
        assert (chosen.time_step, chosen.network.neighbors, chosen.unit) == (0.1, 20, 1.0)
        assert (chosen.motion.update_order, chosen.motion.speed_rule) == ("synchronous", "cap")
        params = chosen.strategy.params
        assert (params["inertia"], params["social"], params["repulsion_exponent"]) == (1.0, 0.5, 6.0)
        assert (params["repulsion_min"], params["repulsion_max"], params["delta"]) == (0.375, 1.5, 0.01)
        assert params["repulsion_start"] == pytest.approx(math.sqrt(math.pi * 2**2 / 50))
        target = chosen.targets[0]
        assert (target.radius, target.speed, target.max_turn) == (1.0, 3.0, 20.0)
        assert (target.waypoint_reach, target.waypoint_patience, target.margin) == (1.5, 200, 2.0)

    def test_aamas2020_steps_its_radius_by_a_tenth_and_two(self):
        params = load("aamas2020").strategy.params
        assert params["delta"] == pytest.approx(0.1 * math.sqrt(math.pi / 50))
        assert params["shrink"] == 2.0
        assert (params["inertia"], params["follow"]) == (0.5, "lowest-index")

    def test_a_file_of_the_same_text_is_the_same_scenario(self, tmp_path):
        path = written(tmp_path, preset_text("oceans2020"))
        assert load(path) == load(str(path)) == load("oceans2020")


class TestRoundTrip:
    """Scenario to TOML and back: equal, with the same hash."""

    @pytest.mark.parametrize("name", PRESETS)
    def test_of_presets(self, tmp_path, name):
        needs_the_sea(name)
        chosen = load(name)
        again = load(written(tmp_path, to_toml(chosen)))
        assert again == chosen
        assert again.hash == chosen.hash

    def test_of_everything_that_can_be_said(self, tmp_path):
        makes = fleets((3, 2.6), (4, 1.0))
        makes[0] |= {"mass": "3.2 kg", "sensor_radius": "10 ft", "start": "corner"}
        chosen = scenario(
            "oceans2020",
            {
                "name": 'quotes " and \\ and ü',
                "seed": 2**63,
                "area": {"width": "2 nmi", "height": "1 km", "agent_margin": 0.1, "origin": [-1.25, 50.75]},
                "fleets": makes,
                "network.neighbors": 6,
                "motion": {"update_order": "sequential", "speed_rule": "divide"},
                "strategy": {"name": "knn-pso", "social_draws": "per-axis", "repulsion_max": 1 / 3},
                "targets": [
                    {"kind": "still", "radius": 1e-300, "x": -0.1},
                    {"kind": "waypoint", "radius": 1, "speed": "5 kn", "waypoint_reach": 2, "max_turn": "1 rad"},
                    {"kind": "track", "radius": 3, "file": "/somewhere/track.csv", "id": "mmsi=1", "max_gap": "2 min"},
                ],
            },
        )
        again = load(written(tmp_path, to_toml(chosen)))
        assert again == chosen
        assert again.hash == chosen.hash

    def test_through_json_too(self):
        chosen = load("oceans2020")
        assert scenario_from(chosen.model_dump(mode="json")) == chosen


class TestHash:
    """Over everything that shapes a run, and nothing else."""

    @pytest.mark.parametrize("changes", [{"name": "x"}, {"description": "x"}, {"seed": 99}])
    def test_ignores_names_and_the_seed(self, changes):
        assert scenario("oceans2020", changes).hash == load("oceans2020").hash

    def test_ignores_how_a_number_was_written(self):
        assert scenario("oceans2020", {"area.width": "20 m", "fleets.0.mass": 3.20}).hash == load("oceans2020").hash

    def test_ignores_defaults_that_are_spelled_out(self):
        assert scenario("oceans2020", {"fleets.0.start": "uniform"}).hash == load("oceans2020").hash

    @pytest.mark.parametrize(
        ("path", "value"),
        [
            ("time_step", 0.2), ("steps", 5), ("area.width", 21.0), ("area.agent_margin", 1.0), ("fleets.0.count", 14),
            ("fleets.0.max_speed", 2.5), ("fleets.1.sensor_radius", 0.1), ("fleets.1.start", "center"),
            ("network.neighbors", 19), ("motion.update_order", "sequential"), ("motion.speed_rule", "divide"),
            ("strategy.inertia", 0.9), ("strategy.follow", "lowest-index"), ("strategy.delta", 0.011),
            ("targets.0.speed", 3.1), ("targets.0.waypoint_patience", 199), ("targets.0.max_turn", 21.0),
        ],
    )  # fmt: skip
    def test_sees_everything_else(self, path, value):
        assert scenario("oceans2020", {path: value}).hash != load("oceans2020").hash

    def test_is_16_hex_digits(self):
        assert re.fullmatch("[0-9a-f]{16}", load("oceans2020").hash)


class TestUnits:
    """Words at the door, SI inside."""

    def test_knots_and_miles(self):
        chosen = scenario("oceans2020", {"area.width": "2 nmi", "area.height": "1 km", "targets.0.speed": "5 kn"})
        assert (chosen.area.width, chosen.area.height) == (3704.0, 1000.0)
        assert chosen.targets[0].speed == pytest.approx(5 * 1852 / 3600)

    def test_of_the_strategys_own_lengths(self):
        assert scenario("oceans2020", {"strategy.repulsion_max": "10 ft"}).strategy.params["repulsion_max"] == 3.048

    def test_a_unit_of_another_kind_is_refused(self, tmp_path):
        path, line = edited(tmp_path, "max_speed = 2.6", 'max_speed = "2.6 m"')
        where, problem, fix = refusal(path)
        assert where == f"{path}:{line} fleets.0.max_speed"
        assert problem == "'2.6 m' is not a quantity in m/s"
        assert "kn" in fix


BAD = {  # what is written instead of what, the field, words of the problem and of the fix
    "unknown field": ("seed = 1", "sede = 1", "sede", "unknown field", "did you mean 'seed'"),
    "unknown table": ("[motion]", "[motoin]", "motoin", "unknown field", "did you mean 'motion'"),
    "unknown in area": ("agent_margin", "agent_margn", "area.agent_margn", "unknown", "did you mean 'agent_margin'"),
    "unknown in fleet": ("mass = 7.4", "mas = 7.4", "fleets.1.mas", "unknown field", "did you mean 'mass'"),
    "unknown in network": ("neighbors", "neighbours", "network.neighbours", "unknown", "did you mean 'neighbors'"),
    "unknown in motion": ("speed_rule", "speedrule", "motion.speedrule", "unknown", "did you mean 'speed_rule'"),
    "unknown in target": ("max_turn", "maxturn", "targets.0.maxturn", "unknown field", "did you mean 'max_turn'"),
    "unknown in strategy": ("inertia", "inerta", "strategy.inerta", "unknown field", "did you mean 'inertia'"),
    "unknown like nothing": ("inertia", "zzz", "strategy.zzz", "unknown field", "its fields: file, name, inertia"),
    "unknown strategy": ('"knn-pso"', '"knn-spo"', "strategy", "no strategy is called 'knn-spo'", "mean 'knn-pso'"),
    "strategy without name": ('name = "knn-pso"', "", "strategy", "a table with a name", "example"),
    "unknown target": ('"waypoint"', '"waypont"', "targets.0", "waypont", "waypoint"),
    "target without kind": ('kind = "waypoint"', "", "targets.0", "kind", ""),
    "text for a number": ("steps = 100000", 'steps = "many"', "steps", "'many': input should be a valid integer", ""),
    "a share of an agent": ("neighbors = 20", "neighbors = 2.5", "network.neighbors", "2.5: input should be", ""),
    "a list for a number": ("width = 20.0", "width = [1]", "area.width", "should be a valid number", "example"),
    "text for a parameter": ("inertia = 1.0", 'inertia = "x"', "strategy.inertia", "'x': input should be", ""),
    "unknown word": ('"synchronous"', '"sync"', "motion.update_order", "'synchronous' or 'sequential'", ""),
    "unknown choice": ('"scalar"', '"scalr"', "strategy.social_draws", "'scalar' or 'per-axis'", ""),
    "negative speed": (
        "max_speed = 2.6",
        "max_speed = -2.6",
        "fleets.0.max_speed",
        "-2.6: input should be greater",
        "",
    ),
    "second fleet": ("max_speed = 1.0", "max_speed = 0", "fleets.1.max_speed", "0: input should be greater than 0", ""),
    "NaN": ("max_speed = 2.6", "max_speed = nan", "fleets.0.max_speed", "nan: input should be a finite number", ""),
    "infinity": ("inertia = 1.0", "inertia = inf", "strategy.inertia", "inf: input should be a finite number", ""),
    "negative seed": ("seed = 1", "seed = -1", "seed", "-1: input should be greater than or equal to 0", ""),
    "endless seed": ("seed = 1", f"seed = {2**64}", "seed", "should be less than", ""),
    "nobody": ("count = 15", "count = 0", "fleets.0.count", "0: input should be greater than 0", ""),
    "no neighbors": ("neighbors = 20", "neighbors = 0", "network.neighbors", "0: input should be greater than 0", ""),
    "as many neighbors as agents": (
        "neighbors = 20",
        "neighbors = 50",
        "network.neighbors",
        "hear at most 49",
        "or add agents under fleets",
    ),
    "margins that meet": (
        "agent_margin = 1.5",
        "agent_margin = 10",
        "area.agent_margin",
        "no room",
        "lower it below 10 m",
    ),
    "target margins that meet": ("margin = 2.0", "margin = 10", "targets.0.margin", "waypoints no room", "lower it"),
    "two fleets of one name": ('"BoB-1"', '"BoB-0"', "", "not all different", "rename one"),
    "missing": ("steps = 100000\n", "\n", "steps", "required and missing", "add steps = ..."),
    "missing in table": ("width = 20.0\n", "\n", "area.width", "required and missing", "add width = ..."),
    "missing in target": ("radius = 1.0\n", "\n", "targets.0.radius", "required and missing", "add radius = ..."),
    "missing table": ("[network]\nneighbors = 20\n", "\n\n", "network", "required and missing", "add network = ..."),
    "one target as a table": ("[[targets]]", "[targets]", "targets", "should be a valid tuple", "example"),
}
NOWHERE = ("missing", "missing table", "two fleets of one name")  # no one line is to blame


class TestBadFields:
    """One error for whatever is wrong."""

    @pytest.mark.parametrize("name", BAD)
    def test_is_named_with_its_value_the_reason_and_the_nearest_name(self, tmp_path, name):
        old, new, field, problem, fix = BAD[name]
        path, _ = edited(tmp_path, old, new)
        said = refusal(path)
        assert re.fullmatch(re.escape(str(path)) + r"(:\d+)?" + (re.escape(f" {field}") if field else ""), said[0])
        assert problem in said[1]
        assert fix in said[2]

    @pytest.mark.parametrize("name", [name for name in BAD if name not in NOWHERE])
    def test_has_a_line(self, tmp_path, name):
        old, new, *_ = BAD[name]
        path, line = edited(tmp_path, old, new)
        where = refusal(path)[0]
        found = re.match(re.escape(str(path)) + r":(\d+)", where)
        assert found
        assert abs(int(found[1]) - line) <= (2 if "missing" in name else 1)  # what is missing: near its table's header

    def test_all_that_is_wrong_is_in_the_one_error(self, tmp_path):
        path, line = edited(tmp_path, "width = 20.0\nheight = 20.0", 'width = -20.0\nheight = "a"')
        where, problem, _ = refusal(path)
        assert where == f"{path}:{line} area.width"
        assert "-20.0: input should be greater than 0" in problem
        assert "also: area.height: 'a' is not a quantity in m" in problem

    @pytest.mark.parametrize(
        ("old", "new"),
        [("count = 15", "count = true"), ("count = 15", 'count = "15"'), ("width = 20.0", "width = true")],
    )
    def test_truth_and_quoted_numbers_are_no_numbers(self, tmp_path, old, new):
        path, line = edited(tmp_path, old, new)
        assert refusal(path)[0].startswith(f"{path}:{line}")

    def test_without_a_file_the_field_is_named_all_the_same(self):
        with pytest.raises(ScenarioError) as caught:
            scenario("oceans2020", {"network.neighbours": 3})
        assert caught.value.args[0] == "scenario network.neighbours"

    def test_a_scenario_cannot_be_changed(self):
        with pytest.raises(ValueError, match="does not change"):
            load("oceans2020").seed = 3

    @pytest.mark.parametrize("counts", [[1], [600_000, 500_000]])
    def test_a_swarm_has_2_to_a_million_agents(self, counts):
        with pytest.raises(ScenarioError, match="a swarm has 2 to 1,000,000"):
            scenario("oceans2020", {"fleets": fleets(*((count, 1.0) for count in counts)), "network.neighbors": 1})


class TestBadFiles:
    """Not a scenario at all."""

    def test_bad_toml_says_the_line(self, tmp_path):
        path, line = edited(tmp_path, "inertia = 1.0", "inertia = ")
        where, problem, _ = refusal(path)
        assert where == str(path)
        assert "is not valid TOML" in problem
        assert f"line {line}" in problem

    def test_a_key_set_twice_is_bad_toml(self, tmp_path):
        path, _ = edited(tmp_path, "seed = 1", "seed = 1\nseed = 2")
        assert "is not valid TOML" in refusal(path)[1]

    def test_an_empty_file_misses_everything_in_one_error(self, tmp_path):
        _, problem, _ = refusal(written(tmp_path, ""))
        assert all(name in problem for name in ("required", "steps", "area", "fleets", "strategy", "targets"))

    def test_a_missing_file_is_named_with_the_presets(self, tmp_path):
        where, problem, fix = refusal(tmp_path / "nowhere.toml")
        assert where == str(tmp_path / "nowhere.toml")
        assert problem == "no preset and no file of this name"
        assert all(name in fix for name in PRESETS)

    @pytest.mark.parametrize(("wrong", "right"), [("ocean2020", "oceans2020"), ("aamas-2020", "aamas2020")])
    def test_a_misspelt_preset_is_answered_with_the_nearest(self, wrong, right):
        assert f"did you mean {right!r}?" in refusal(wrong)[2]

    def test_a_folder_is_no_scenario(self, tmp_path):
        assert refusal(tmp_path)[0] == str(tmp_path)

    def test_bytes_that_are_no_text(self, tmp_path):
        (tmp_path / "my.toml").write_bytes(b"\xff\xfe\x00")
        assert refusal(tmp_path / "my.toml")[1] == "is not a text file"


class TestFiles:
    """A scenario names files relative to its own folder."""

    def test_a_track_is_sought_beside_the_scenario(self, tmp_path):
        table = read_table("oceans2020")
        table["targets"] = [{"kind": "track", "radius": 1.0, "file": "tracks/ship.csv"}]
        chosen = load(written(tmp_path, to_toml(scenario_from(table))))
        assert chosen.targets[0].file == str(tmp_path / "tracks" / "ship.csv")

    def test_where_a_track_lies_is_not_hashed_but_which_one_is(self):
        track = {"kind": "track", "radius": 1.0, "file": "/a/ship.csv", "digest": "x"}
        here, there, other = (
            scenario("oceans2020", {"targets": [{**track, **change}]}).hash
            for change in ({}, {"file": "/b/ship.csv"}, {"digest": "y"})
        )
        assert here == there
        assert here != other

    def test_a_strategy_file_that_is_not_there_is_named(self, tmp_path):
        path, _ = edited(tmp_path, 'name = "knn-pso"', 'file = "my_strategy.py"')
        with pytest.raises(StrategyError) as caught:
            load(path)
        assert caught.value.args[0] == str(tmp_path / "my_strategy.py")


KEYWORDS = {
    "$defs", "$ref", "additionalProperties", "anyOf", "const", "default", "description", "discriminator", "enum",
    "exclusiveMaximum", "exclusiveMinimum", "follows", "format", "items", "maxItems", "maximum", "minItems",
    "minLength", "minimum", "oneOf", "pattern", "prefixItems", "properties", "required", "title", "type", "unit",
}  # fmt: skip
TYPES = {"object": dict, "array": (list, tuple), "string": str, "null": type(None), "boolean": bool}


def accepts(schema, value, root):
    """Whether a JSON Schema, of these keywords, accepts a value; a date of TOML is a text in JSON."""
    if isinstance(value, datetime):
        value = value.isoformat()
    assert schema.keys() <= KEYWORDS, schema.keys()
    if "$ref" in schema:
        schema = root["$defs"][schema["$ref"].removeprefix("#/$defs/")]
    checks = [
        "type" not in schema or is_type(schema["type"], value),
        "const" not in schema or value == schema["const"],
        "enum" not in schema or value in schema["enum"],
        "anyOf" not in schema or any(accepts(each, value, root) for each in schema["anyOf"]),
        "oneOf" not in schema or sum(accepts(each, value, root) for each in schema["oneOf"]) == 1,
    ]
    if isinstance(value, (int, float)) and schema.get("type") in ("number", "integer"):
        checks += [
            value >= schema.get("minimum", -math.inf),
            value <= schema.get("maximum", math.inf),
            value > schema.get("exclusiveMinimum", -math.inf),
            value < schema.get("exclusiveMaximum", math.inf),
        ]
    if isinstance(value, str) and schema.get("type") == "string":
        checks += [len(value) >= schema.get("minLength", 0), re.search(schema.get("pattern", ""), value) is not None]
    if isinstance(value, dict) and "properties" in schema:
        known = schema["properties"]
        checks += [set(schema.get("required", ())) <= value.keys()]
        checks += [schema.get("additionalProperties", True) or value.keys() <= known.keys()]
        checks += [accepts(known[name], item, root) for name, item in value.items() if name in known]
    if isinstance(value, (list, tuple)) and schema.get("type") == "array":
        checks += [len(value) >= schema.get("minItems", 0)]
        checks += [accepts(schema["items"], item, root) for item in value if "items" in schema]
    return all(checks)


def is_type(name, value):
    if name in ("number", "integer"):
        return isinstance(value, int if name == "integer" else (int, float)) and not isinstance(value, bool)
    return isinstance(value, TYPES[name])


class TestJsonSchema:
    """For editors that complete and check scenario files."""

    def test_describes_every_field_of_a_scenario(self):
        schema = json_schema()
        assert schema["properties"].keys() == Scenario.model_fields.keys()
        assert set(schema["required"]) == {"time_step", "steps", "area", "fleets", "network", "strategy", "targets"}
        assert schema["additionalProperties"] is False

    @pytest.mark.parametrize("name", PRESETS)
    def test_accepts_the_presets(self, name):
        schema = json_schema()
        assert accepts(schema, tomllib.loads(preset_text(name)), schema)

    @pytest.mark.parametrize(
        ("path", "value"),
        [("area.width", "2 nmi"), ("targets.0.speed", "5 kn"), ("area.origin", [1.0, 2.0]), ("fleets.0.mass", 3)],
    )
    def test_accepts_what_a_scenario_may_say(self, path, value):
        schema = json_schema()
        assert accepts(schema, changed(read_table("oceans2020"), {path: value}), schema)

    @pytest.mark.parametrize(
        ("path", "value"),
        [
            ("sede", 1), ("seed", -1), ("steps", "many"), ("area.width", "2 kn"), ("fleets", []),
            ("fleets.0.start", "anywhere"), ("network.neighbors", 0),
            ("motion.update_order", "sync"), ("strategy.name", "knn-spo"), ("strategy.inerta", 1.0),
            ("strategy.follow", "anybody"), ("targets.0.kind", "waypont"),
            ("area.width", -1.0), ("fleets.0.max_speed", 0),
            ("targets.0.max_turn", 181.0),
        ],
    )  # fmt: skip
    def test_refuses_what_a_scenario_may_not_say(self, path, value):
        schema = json_schema()
        assert not accepts(schema, changed(read_table("oceans2020"), {path: value}), schema)

    @pytest.mark.parametrize("strategy", ["knn-pso", {"file": "my_strategy.py"}])
    def test_accepts_every_way_to_name_a_strategy(self, strategy):
        schema = json_schema()
        assert accepts(schema, changed(read_table("oceans2020"), {"strategy": strategy}), schema)
