"""A target and a disturbance from installed packages: the examples of the how-tos, in processes that have them."""

import json

import pytest

import shoal as here
from plugins import example, install, python, shoal

TARGET, DISTURBANCE = "shoal.targets", "shoal.disturbances"
STEPS = 400
ZIGZAG = {"kind": "zigzag", "radius": 1.0, "speed": 3.0, "period": 2.0, "angle": 90.0}
FOULING = {"kind": "fouling", "half_time": 10.0, "fleet": "BoB-1", "since": 5.0}
DOOM = """
import math
from dataclasses import dataclass
from typing import Annotated
import shoal
from shoal.core.units import Choice
from shoal.world.disturbances.contract import Disturbance

@dataclass(frozen=True, kw_only=True)
class Doom:
    \"""Whatever nature may do to an agent.\"""
    what: Annotated[int, Choice(("blind", "lose", "spoil", "spoil-targets"))] = 0

@shoal.kernel
def act(me, memory, options, around, draw):
    if options.what == 0:
        me.senses = 0.0
    elif options.what == 1:
        me.lost = 1
    elif options.what == 2:
        me.drift_x += math.nan

@shoal.kernel
def carry(target, options, around, draw):
    if options.what == 3:
        target.drift_y += math.nan

DISTURBANCE = Disturbance(name="doom", options=Doom, advance=act, carry=carry)
"""
LOOK = f"""
import json
import numpy as np
import shoal

PLAIN = shoal.load("oceans2020", steps={STEPS})
ZIGZAG, FOULING = {ZIGZAG}, {FOULING}
CHOSEN = PLAIN.with_(targets=[ZIGZAG], disturbances=[FOULING])

def run(scenario, *pieces):
    simulation = shoal.Simulation(scenario)
    kept = [simulation.advance(steps, every=1) for steps in pieces]
    return simulation, kept

def bits(simulation):
    return {{name: array.tobytes() for name, array in simulation.state().items()}}

whole, (frames,) = run(CHOSEN, {STEPS})
halves, _ = run(CHOSEN, 1, 150, {STEPS - 151})
first, _ = run(CHOSEN, 151)
first.save("half.npz")
again = shoal.Simulation(CHOSEN)
again.restore("half.npz")
again.advance({STEPS} - 151)
steps = np.diff(frames.target_x[:, 0] + 1j * frames.target_y[:, 0])
turns = np.degrees(np.angle(steps[1:] * steps[:-1].conj()))
mirrored = np.hypot(frames.target_x[1:-1, 0], frames.target_y[1:-1, 0]) > 9.0
top = np.hypot(whole.swarm.command_x, whole.swarm.command_y)[:50] / whole.swarm.max_speed[:50]
def doomed(what, **more):
    doom = {{"kind": "doom", "what": what, "since": 5.0, **more}}
    alarms = {{f"fleets.{{number}}.false_alarm_probability": 0.5 for number in range(2)}}
    simulation = shoal.Simulation(PLAIN.with_(disturbances=[doom], **alarms))
    try:
        return simulation.advance(100, every=1), simulation
    except shoal.ShoalError as error:
        return str(error), simulation

blind, lost = doomed("blind")[0], doomed("lose", fleet="BoB-1")
print(json.dumps({{
    "blind": [int(blind.on_target[:50].sum() > 0), int(blind.on_target[50:].sum())],
    "lost": [int(lost[0].alive[49].sum()), int(lost[0].alive[50].sum()), lost[1].swarm.leaves[:15].tolist()],
    "spoilt": [doomed("spoil")[0], doomed("spoil-targets")[0]],
    "state": sorted(whole.state()),
    "halves": bits(halves) == bits(whole),
    "restored": bits(again) == bits(whole),
    "speed": [float(np.abs(steps[~np.r_[mirrored, True]]).min()), float(np.abs(steps).max())],
    "turns": [float(each) for each in turns[~mirrored] if abs(each) > 1e-6],
    "top": [float(top[:15].max()), float(top[15:].max())],
    "hash": [CHOSEN.hash, CHOSEN.with_(targets=[ZIGZAG]).hash, CHOSEN.with_(**{{"targets.0.angle": 80}}).hash],
    "attributes": [CHOSEN.targets[0].angle, CHOSEN.targets[0].source, CHOSEN.disturbances[0].half_time],
    "reloaded": shoal.load(CHOSEN) == CHOSEN,
    "kinds": [name for name in ("zigzag", "fouling") if name in json.dumps(shoal.scenario.schema.json_schema())],
}}))
"""


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    folder = tmp_path_factory.mktemp("site")
    install(folder, "zigzag", example("own-target"), TARGET)
    install(folder, "fouling", example("own-disturbance"), DISTURBANCE)
    install(folder, "doom", DOOM, DISTURBANCE)
    table = here.load("oceans2020", steps=STEPS).model_dump(mode="json")
    text = here.to_toml(here.load(table)).partition("[[targets]]")[0]
    part = "\n".join(
        f"[[{name}]]\n" + "\n".join(f"{key} = {json.dumps(value)}" for key, value in entry.items())
        for name, entry in (("targets", ZIGZAG), ("disturbances", FOULING))
    )
    (folder / "mine.toml").write_text(text.replace("disturbances = []\n", "") + part + "\n", encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def seen(site):
    code, out, err = python(site, "-c", "import shoal.scenario.schema\n" + LOOK)
    assert code == 0, err
    return json.loads(out)


@pytest.fixture(scope="module")
def recorded(site):
    code, out, err = shoal(site, "run", "mine.toml", "--out", "run", "--json")
    assert code == 0, err
    return site / "run", json.loads(out)


class TestATarget:
    def test_moves_as_it_says(self, seen):
        assert seen["speed"][1] == pytest.approx(0.3)
        assert [abs(turn) for turn in seen["turns"]] == pytest.approx([90.0] * len(seen["turns"]), abs=1e-6)
        assert len(seen["turns"]) > 5

    def test_turns_to_one_side_and_the_other(self, seen):
        assert {turn > 0 for turn in seen["turns"]} == {True, False}

    def test_has_typed_attributes_and_the_hash_of_its_file(self, seen):
        angle, source, half_time = seen["attributes"]
        assert (angle, half_time) == (90.0, 10.0)
        assert len(source) == 16
        assert len(set(seen["hash"])) == 2
        assert seen["reloaded"]

    def test_is_in_the_schema(self, seen):
        assert seen["kinds"] == ["zigzag", "fouling"]


class TestADisturbance:
    def test_does_what_it_says_to_its_fleet_alone(self, seen):
        assert 0.07 < seen["top"][0] < 0.11  # 35 s, half of it every 10 s: 0.088
        assert seen["top"][1] == pytest.approx(1.0)

    def test_may_blind_agents_to_false_alarms_too(self, seen):
        assert seen["blind"] == [1, 0]

    def test_may_lose_them_for_good(self, seen):
        assert seen["lost"] == [50, 35, [50] * 15]

    def test_is_named_where_it_spoils_a_number(self, seen):
        for message in seen["spoilt"]:
            assert "disturbances: (doom) drift by no finite distance" in message


class TestTheirState:
    def test_is_saved_with_the_rest(self, seen):
        assert {"targets.since_turn", "targets.side", "weather.memory.weed"} <= set(seen["state"])

    def test_a_run_in_pieces_is_the_run(self, seen):
        assert seen["halves"]

    def test_a_restored_run_is_the_run(self, seen):
        assert seen["restored"]


class TestCommands:
    def test_it_runs_and_is_shown(self, site, recorded):
        folder, summary = recorded
        assert summary["steps"] == STEPS
        code, out, _ = shoal(site, "show", folder)
        assert code == 0
        assert "zigzag at 3 m/s" in out
        assert "fouling" in out

    def test_it_is_drawn_and_replayed(self, site, recorded):
        folder, _ = recorded
        assert shoal(site, "film", folder, "--step", "390", "--out", "still.png")[0] == 0
        assert shoal(site, "replay", folder, "--out", "run.html")[0] == 0
        assert '"kind":"zigzag"' in (site / "run.html").read_text(encoding="utf-8")

    def test_a_misspelt_kind_or_field_is_answered(self, site):
        text = (site / "mine.toml").read_text(encoding="utf-8")
        for wrong, right, said in (
            ('"zigzag"', '"zigzak"', "did you mean 'zigzag'"),
            ('"fouling"', '"foulin"', "did you mean 'fouling'"),
            ("period", "perod", "did you mean 'period'"),
            ("half_time = 10.0", "half_time = 0", "greater than 0"),
            ('fleet = "BoB-1"', 'fleet = "BoB-7"', "no fleet"),
        ):
            (site / "wrong.toml").write_text(text.replace(wrong, right), encoding="utf-8")
            code, _, err = shoal(site, "check", "wrong.toml")
            assert code == 2
            assert "wrong.toml:" in err
            assert said in err
            assert "Traceback" not in err

    def test_another_version_is_another_scenario(self, site, tmp_path):
        _, saved, _ = shoal(site, "scenario", "mine.toml")
        assert "source = " in saved
        (tmp_path / "saved.toml").write_text(saved, encoding="utf-8")
        install(tmp_path, "zigzag", example("own-target") + "# edited\n", TARGET)
        install(tmp_path, "fouling", example("own-disturbance"), DISTURBANCE)
        code, _, err = shoal(tmp_path, "check", "saved.toml")
        assert code == 2
        assert "source is another version than the one installed" in err


class TestWithoutThePackage:
    def test_its_record_opens_and_is_drawn(self, recorded, tmp_path):
        record = here.open_record(recorded[0])
        assert record.estimate("time_on_target").mean == pytest.approx(recorded[1]["time_on_target"]["mean"])
        assert shoal(tmp_path, "show", recorded[0])[0] == 0
        assert shoal(tmp_path, "replay", recorded[0], "--out", "run.html")[0] == 0

    def test_running_its_scenario_says_what_is_missing(self, site, tmp_path):
        code, _, err = shoal(tmp_path, "check", site / "mine.toml")
        assert code == 2
        assert "no target is of kind 'zigzag'" in err
        assert "Traceback" not in err


BROKEN = [
    ("import no_such_module\n", "zigzag", "ModuleNotFoundError"),
    ("TARGET = 3\n", "zigzag", "TARGET is not a Target"),
    (example("own-target"), "zagzig", "declares the target 'zigzag', but its entry point says 'zagzig'"),
    (example("own-target").replace("target, around, draw):", "target, draw):"), "zigzag", "advance takes 2"),
    (example("own-target").replace('"since_turn": float', '"x": float'), "zigzag", "'x' is a field that all have"),
    (example("own-target").replace('"since_turn": float', '"waypoint_age": float'), "zigzag", "something else"),
    (example("own-target").replace('"side": int', '"side": str'), "zigzag", "is of type"),
    (example("own-target").replace("float = 60.0", "").replace("] = 60.0", "] = 1 / 0"), "zigzag", "ZeroDivisionError"),
    (example("own-target").replace("math.radians(options.angle)", "1 / 0"), "zigzag", "ZeroDivisionError"),
]  # fmt: skip


class TestABrokenPackage:
    @pytest.mark.parametrize(("text", "name", "says"), BROKEN)
    def test_is_one_sentence_for_who_asks_for_it_and_nothing_for_others(self, tmp_path, text, name, says):
        install(tmp_path, "bad-sails", text, TARGET, name)
        assert shoal(tmp_path, "scenario", "oceans2020")[0] == 0  # a run of it would compile for a minute
        code, _, err = shoal(
            tmp_path,
            "run",
            "oceans2020",
            "--steps",
            "1",
            "--set",
            f'targets=[{{kind="{name}", radius=1.0, speed=1.0}}]',
        )
        assert code == 2
        assert "Traceback" not in err
        assert "package 'bad-sails'" in err
        assert says in err

    def test_whose_kernel_cannot_be_compiled_is_named(self, tmp_path, monkeypatch):
        monkeypatch.setenv("NUMBA_OPT", "1")  # what is compiled on the way there is never run
        text, right = example("own-disturbance"), "me.speed *="
        assert right in text
        fouling = ", ".join(f"{key} = {json.dumps(value)}" for key, value in FOULING.items())
        chosen = ["--set", f"disturbances=[{{{fouling}}}]"]  # compiled where a run has one
        install(tmp_path, "bad-sails", text.replace(right, "me.no_such_field *="), DISTURBANCE, "fouling")
        code, _, err = shoal(tmp_path, "run", "oceans2020", "--steps", "10", *chosen)
        assert code == 2, err
        assert "package 'bad-sails'" in err
        assert "cannot be compiled" in err
        assert "no_such_field" in err
        assert "Traceback" not in err
