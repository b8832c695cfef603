"""In lockstep a fleet does what the simulator does, to the bit: frames, links, memories and sums."""

import numpy as np
import pytest

from fleets import differences
from scenarios import scenario
from shoal.core.errors import FleetError, ScenarioError, StrategyError
from shoal.core.links import unpacked
from shoal.record.files import open_record
from shoal.run.fleet.kills import kills_of
from shoal.run.fleet.run_fleet import Terms, run_fleet

MEMORY = Terms(mesh="memory")
TEAM = [
    {"name": "fast", "count": 15, "max_speed": 2.6, "strategy": "shared-sighting", "max_turn_rate": 200.0},
    {"name": "slow", "count": 35, "max_speed": 1.0, "strategy": "knn-pso", "max_acceleration": 4.0},
]
POOR = {"sensor_radius": 0.5, "detection_probability": 0.7, "false_alarm_probability": 0.05, "position_error": 0.2}
ORDERS = [
    {"step": 10, "order": "hold", "agents": [0, 3, 49]},
    {"step": 20, "set": {"neighbors": 5}, "agents": [7, 8, 9]},
    {"step": 20, "order": "recall"},
    {"step": 50, "order": "resume", "agents": [3, 7]},
    {"step": 60, "set": {"neighbors": 9}},
]
RADIO = {"neighbors": 12, "range": 7.0, "loss": 0.2, "delay": 2, "interval": 0.3}


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"strategy": "global-pso"},
        {"motion.speed_rule": "divide"},
        {"network": RADIO},
        {"network": {**RADIO, "adaptive": {"fewest": 3, "most": 18}}, "strategy": "shared-sighting"},
        {"fleets": [{**make, **POOR} for make in TEAM]},
        {"losses": [{"step": 20, "count": 5}], "joins": [{"step": 40, "count": 3, "fleet": "BoB-0"}]},
        {"disturbances": [{"kind": "current", "east": 0.5}, {"kind": "blackout", "since": 2.0, "until": 4.0}]},
        {"commands": ORDERS},
        {"commands": ORDERS, "network": RADIO, "fleets": [{**make, **POOR} for make in TEAM]},
        {"network": {**RADIO, "max_age": 1}},
        {"network": {"neighbors": 12, "range": 4.0, "loss": 0.3, "hops": 3}},
        {
            "network": {**RADIO, "max_age": 5, "hops": 2, "adaptive": {"fewest": 3, "most": 18}},
            "strategy": "shared-sighting",
            "losses": [{"step": 20, "count": 5}],
            "joins": [{"step": 40, "count": 3, "fleet": "BoB-0"}],
            "disturbances": [{"kind": "blackout", "since": 2.0, "until": 4.0}],
        },
        {"sea": {"coast": [[[-4.0, -4.0], [4.0, -4.0], [4.0, 4.0], [-4.0, 4.0]]]}},  # hides from radios of any range
    ],
    ids=[
        "as-it-is",
        "all-hear-all",
        "printed-speeds",
        "poor-radios",
        "adaptive-k",
        "team",
        "changes",
        "disturbed",
        "ordered",
        "ordered-team-with-poor-radios",
        "kept",
        "relayed",
        "kept-and-relayed-in-all-changes",
        "land",
    ],
)
def test_a_fleet_is_the_simulator(changes):
    assert differences(run_fleet(scenario("oceans2020", {"steps": 80, **changes}), MEMORY)) == []


class TestLosses:
    """Who is killed at a step is who the simulator loses at that step."""

    def test_kills_are_losses_that_name_agents(self):
        record = run_fleet(scenario("oceans2020", {"steps": 60}), Terms(mesh="memory", kill=("7@30", "3@30", "49@45")))
        assert [(each.step, each.agents) for each in record.scenario.losses] == [(30, (3, 7)), (45, (49,))]
        alive = record.trajectories[0].alive
        assert (alive[29].sum(), alive[30].sum(), alive[45].sum()) == (50, 48, 47)
        assert record.provenance["notes"] == ["lost at step 30: buoys 3, 7", "lost at step 45: buoy 49"]
        assert differences(record) == []

    def test_beside_those_that_the_scenario_loses_by_lot(self):
        planned = scenario("oceans2020", {"steps": 60, "losses": [{"step": 40, "count": 45}]})
        record = run_fleet(planned, Terms(mesh="memory", kill=tuple(f"{id}@30" for id in range(10))))
        assert len(record.scenario.losses) == 2
        assert differences(record) == []

    @pytest.mark.parametrize("max_age", [1, 5])
    def test_who_keeps_reports_goes_by_those_of_the_dead(self, max_age):
        planned = scenario("oceans2020", {"steps": 60, "joins": [{"step": 33, "count": 2, "fleet": "BoB-0"}]})
        terms = Terms(mesh="memory", kill=tuple(f"{id}@30" for id in range(10)), max_age=max_age)
        record = run_fleet(planned, terms)
        assert record.scenario.network.max_age == max_age
        heard = [unpacked(links)[:, :10].any() for links in record.trajectories[0].links]
        assert heard == [step < 30 + max_age for step in range(60)]
        assert differences(record) == []

    def test_one_that_would_have_joined_later_never_does(self):
        planned = scenario("oceans2020", {"steps": 60, "joins": [{"step": 40, "count": 2, "fleet": "BoB-0"}]})
        record = run_fleet(planned, Terms(mesh="memory", kill=("51@30",)))
        assert record.trajectories[0].alive[50].sum() == 51
        assert differences(record) == []


def test_an_interrupt_keeps_what_was_done(tmp_path):
    def interrupt(done, total):
        if done == 25:
            raise KeyboardInterrupt

    planned = scenario("oceans2020", {"steps": 60})
    run_fleet(planned, MEMORY, out=tmp_path / "kept", progress=interrupt)
    record = open_record(tmp_path / "kept")
    assert record.scenario.steps == 25
    assert "interrupted after 25 of 60 steps" in record.provenance["notes"]
    assert differences(record) == []


def test_an_interrupt_before_anything_was_done_keeps_nothing(tmp_path, monkeypatch):
    def interrupt(self, tick):
        raise KeyboardInterrupt

    monkeypatch.setattr("shoal.run.fleet.memory.InMemory.ask", interrupt)
    with pytest.raises(KeyboardInterrupt):
        run_fleet(scenario(), MEMORY, out=tmp_path / "kept")
    assert list(tmp_path.iterdir()) == []


class TestErrors:
    """One sentence, before anything starts."""

    @pytest.mark.parametrize(
        ("changes", "error", "words"),
        [
            ({"strategy": "pursuit"}, StrategyError, "no buoy can know"),
            ({"motion.update_order": "sequential"}, ScenarioError, "buoys decide at once"),
        ],
    )
    def test_what_buoys_cannot_do(self, changes, error, words):
        with pytest.raises(error, match=words):
            run_fleet(scenario("oceans2020", changes), MEMORY)

    @pytest.mark.parametrize(
        ("terms", "words"),
        [
            (Terms(mesh="radio"), "there are: zenoh, memory"),
            (Terms(mesh="memory", processes=2), "within one process"),
            (Terms(processes=51), "give 1 to 50"),
            (Terms(processes=0), "give 1 to 50"),
            (Terms(speed=0.0), "--speed: is 0"),
            (Terms(speed=float("nan")), "--speed: is nan"),
            (Terms(max_age=-1), "give 0 to 1000"),
        ],
    )
    def test_terms_that_cannot_be(self, terms, words):
        with pytest.raises(FleetError, match=words):
            run_fleet(scenario(), terms)

    @pytest.mark.parametrize("text", ["", "7", "7@", "@5", "50@5", "-1@5", "7@0", "7@1.5", "7@5@6", "seven@5", "7 @5"])
    def test_kills_that_cannot_be(self, text):
        with pytest.raises(FleetError, match="write BUOY@STEP"):
            kills_of([text], 50)

    def test_kills(self):
        assert kills_of(["7@500", "3@500", "0@1"], 50) == {500: [7, 3], 1: [0]}


def test_what_is_wanted_beyond_the_limits_is_not_done():
    from shoal.run.fleet.ocean import Ocean

    ocean = Ocean(scenario())
    wants = np.array([[1e9, 0.0], [np.nan, 0.0], [0.0, -np.inf]])
    ocean.obey(np.array([0, 1, 2], np.int32), wants)
    ocean.advance()
    speeds = np.hypot(ocean.simulation.swarm.vx, ocean.simulation.swarm.vy)[:3]
    assert speeds[0] <= 2.6 * (1 + 1e-12)
    assert speeds[1:].tolist() == [0.0, 0.0]
