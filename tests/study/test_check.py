"""What looks like a mistake is said in plain words; what suits draws no word."""

import copy

import pytest

import shoal
from commands import shoal as command
from scenarios import fleets, scenario

POOL = {"repulsion_start": 0.5, "repulsion_min": 0.375, "repulsion_max": 1.5, "delta": 0.01, "repulsion_step": 1.0}
BAY = {
    "area.width": 3000.0,
    "area.height": 2000.0,
    "area.agent_margin": 0.0,
    "time_step": 1.0,
    "steps": 1500,
    "fleets": [{**each, "sensor_radius": 150.0} for each in fleets((10, 4.0), (20, 1.0))],
    "network": {"neighbors": 10, "range": 1000.0, "loss": 0.1},
    "targets": [{"kind": "walk", "radius": 5.0, "speed": 7.0, "persistence": 300.0}],
}
AT_A_WALL = {"strategy": "pursuit", "targets": [{"kind": "still", "radius": 5.0, "x": 1500.0, "y": 0.0}], "steps": 4000}

AT_SEA = {"bay": ["knn-pso follows the scenario", "44 % would collide"], "offshore": ["% of the area"]}


def notes(changes, **options):
    return shoal.check(bay(changes), **options)


def bay(changes):
    return scenario("oceans2020", copy.deepcopy(BAY | {"strategy": "lattice"} | changes))


class TestPresets:
    @pytest.mark.parametrize("name", [name for name in shoal.presets() if name not in (*AT_SEA, "density2023")])
    def test_they_suit(self, name):
        assert shoal.check(name) == []

    def test_one_lets_its_strategy_follow_the_density(self):
        (told,) = shoal.check("density2023")
        assert told.startswith("strategy knn-pso follows the scenario: repulsion_start = 0.501")

    @pytest.mark.parametrize("name", AT_SEA)
    def test_those_at_sea_say_what_follows_and_how_little_a_search_sees(self, name):
        for library in ("pyproj", "scipy", "netCDF4"):
            pytest.importorskip(library, reason="a sea needs pip install '.[maritime]'")
        told = shoal.check(name)
        assert all(words in said for words, said in zip(AT_SEA[name], told, strict=True))


class TestUnsuited:
    """Told from what a scenario says."""

    def test_a_bay_of_its_own_defaults_suits(self):
        assert notes({}) == []
        (told,) = notes({"strategy": "encircle"})
        assert told == (
            "strategy encircle follows the scenario: chase = 1,420, ring = 147, spacing = 310, patience = 101"
        )

    @pytest.mark.parametrize(
        ("changes", "words"),
        [
            ({"time_step": 100.0}, "goes 400 m in a time-step, farther than the 155 m"),
            ({"targets.0.speed": 400.0}, "it slips through unseen"),
            ({"network.range": 100.0}, "less than the 447 m between agents"),
            ({"fleets.0.sensor_radius": 0.0, "fleets.1.sensor_radius": 0.0}, "is a sensor_radius missing"),
            (
                {"strategy": {"name": "encircle", "ring": 0.95}},
                "ring is 0.95 m; what suits a reach of 155 m is about 147",
            ),
            ({"strategy": {"name": "encircle", "patience": 1.0}}, "patience is 1 s"),
            ({"strategy": {"name": "knn-pso", "repulsion_max": "9 km"}}, "repulsion_max is 9,000 m"),
            ({"fleets.1.strategy": {"name": "knn-pso", "delta": 1e-4}}, "delta is 0.0001 m"),
        ],
    )
    def test_what_is_odd_is_said(self, changes, words):
        assert sum(words in note for note in notes(changes)) == 1

    @pytest.mark.parametrize(
        ("network", "words"),
        [
            ({"radio": "lora-sf7", "interval": "10 s"}, ["take 0.293 of its time", "44 % would collide"]),
            ({"radio": "lora-sf9", "interval": "34 s"}, ["44 % would collide (pure ALOHA"]),
            ({"radio": "lora-sf7", "interval": "10 s", "loss": 0.5}, []),  # it counts on more
            ({"radio": "lora-sf7", "interval": "2 min", "loss": 0.0}, []),  # less than a tenth
            ({"radio": "wifi-mesh"}, []),  # it listens first
            ({"radio": "vdes", "interval": "1 s"}, ["take 1.6 of its time", "more than there is"]),
        ],
    )
    def test_a_channel_that_is_too_full_is_said(self, network, words):
        told = [each for each in notes({"network": BAY["network"] | network}, trials=False) if "channel_load" in each]
        assert len(told) == bool(words)
        assert all(word in told[0] for word in words)

    def test_what_is_zero_is_meant(self):
        assert not any("delta" in note for note in notes({"strategy": {"name": "knn-pso", **POOL, "delta": 0.0}}))

    def test_a_strategy_that_no_fleet_follows_is_not_judged(self):
        own = {"fleets.0.strategy": "lattice", "fleets.1.strategy": "lattice"}
        assert notes({"strategy": {"name": "knn-pso", **POOL}, **own}) == []


class TestTrials:
    """Told from short runs."""

    def test_agents_at_the_walls_are_seen(self):
        assert sum("were at a wall" in note for note in notes(AT_A_WALL, trials=True)) == 1

    def test_lengths_that_follow_leave_them_to_the_water(self):
        assert not any("were at a wall" in note for note in notes({"strategy": "knn-pso"}, trials=True))

    def test_a_time_step_that_matters_is_said(self):
        told = shoal.check("oceans2020", trials=True, time_step=0.4, steps=4000)
        assert sum("half the time_step moves the time on target by +0." in note for note in told) == 1

    def test_one_that_does_not_is_not(self):
        still = {"targets": [{"kind": "still", "radius": 5.0}], "fleets.0.sensor_radius": 600.0}
        assert not any("half the time_step" in note for note in notes(still, trials=True))

    def test_runs_too_short_or_too_large_to_tell_are_not_made(self):
        assert notes({"steps": 20}, trials=True) == notes({"steps": 20})

    def test_the_command_makes_them_unless_told(self, tmp_path, capsys):
        (tmp_path / "wall.toml").write_text(shoal.to_toml(bay(AT_A_WALL)))
        code, out, err = command(capsys, "check", tmp_path / "wall.toml", "--quick")
        assert (code, "fine" in out, "wall" in err) == (0, True, False)
        code, out, err = command(capsys, "check", tmp_path / "wall.toml")
        assert (code, "fine" in out, "were at a wall" in err) == (0, True, True)
