"""A buoy decides as the same agent does in the engine, to the bit: from its reading, its inbox and the step."""

import math
import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from buoys import differences, reading_of, reports_of, tape_of
from scenarios import scenario
from shoal.buoy.buoy import Buoy
from shoal.core.errors import MessageError, ScenarioError, StrategyError
from shoal.core.messages import Reading, Report
from shoal.run.simulation import Simulation
from shoal.scenario.briefing import briefing
from shoal.strategies import CATALOGUE

ROOT = Path(__file__).resolve().parents[2]
SIGHTED = sorted(name for name, known in CATALOGUE.items() if known.builtin and not known.informed)
STEPS = 300
IDS = (0, 14, 15, 49)  # the first and the last of both fleets
SMOOTH = {
    "levy-walk",
    "random-walk",
    "a-cmommt",
    "sector-search",
    "six-nearest",
}  # where pow, log, sin, cos or atan2 enter


@pytest.mark.parametrize("name", SIGHTED)
def test_every_strategy_in_the_paper_s_run(name):
    chosen = scenario("oceans2020", {"strategy": name})
    steps = 1000 if name == "knn-pso" else STEPS
    assert differences(tape_of(chosen, steps), chosen, IDS) == []


USERS = ROOT / "examples/strategies/six_nearest.py"  # ranks and named sums


@pytest.fixture(scope="module")
def of_a_user():
    """A user's strategy and what the engine makes of it: compiled once, for half a minute."""
    chosen = scenario("oceans2020", {"strategy": {"file": str(USERS)}})
    return chosen, tape_of(chosen, 300)


def test_a_user_s_strategy(of_a_user):
    chosen, tape = of_a_user
    assert differences(tape, chosen, IDS) == []


RADIO = {"neighbors": 12, "range": 7.0, "loss": 0.2, "delay": 2}
TEAM = [
    {"name": "fast", "count": 15, "max_speed": 2.6, "strategy": "shared-sighting", "max_turn_rate": 200.0},
    {"name": "slow", "count": 35, "max_speed": 1.0, "strategy": "knn-pso", "max_acceleration": 4.0},
]
SENSORS = {"sensor_radius": 0.5, "detection_probability": 0.7, "false_alarm_probability": 0.05}


class TestRadio:
    """The inbox is what arrives; a buoy need not know why the rest did not."""

    @pytest.mark.parametrize(
        "network",
        [RADIO, {**RADIO, "adaptive": {"fewest": 3, "most": 18}}, {"neighbors": "all", "loss": 0.5}],
        ids=["range, loss and delay", "and a k that adapts", "all, half of it lost"],
    )
    def test_of_a_swarm_that_passes_sightings_on(self, network):
        chosen = scenario("oceans2020", {"strategy": "shared-sighting", "network": network})
        assert differences(tape_of(chosen, STEPS, run=2), chosen, IDS, run=2, radio=True) == []

    def test_of_two_strategies_with_limits_and_poor_sensors(self):
        chosen = scenario("oceans2020", {"fleets": [{**make, **SENSORS} for make in TEAM], "network": RADIO})
        assert differences(tape_of(chosen, STEPS), chosen, IDS, radio=True) == []

    def test_of_the_printed_speed_rule(self):
        chosen = scenario("oceans2020", {"motion.speed_rule": "divide", "network.delay": 1})
        assert differences(tape_of(chosen, 200), chosen, IDS) == []


PLAIN = """
import pathlib, pickle, sys, warnings
warnings.simplefilter("error")

class NoNumba:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in ("numba", "llvmlite"):
            raise ModuleNotFoundError(f"No module named {name!r}", name=name.split(".")[0])

sys.meta_path.insert(0, NoNumba())
sys.path.insert(0, sys.argv[1])
import shoal.scenario.load, shoal.buoy.buoy
from shoal.buoy.plain import PlainMinds
assert "numba" not in sys.modules
from buoys import Tape, differences
for table, tape, ids, radio, apart in pickle.loads(pathlib.Path(sys.argv[2]).read_bytes()):
    chosen = shoal.scenario.load.scenario_from(table)
    assert isinstance(shoal.buoy.buoy.Buoy(chosen, 0)._minds, PlainMinds)
    found = differences(Tape(*tape), chosen, ids, radio=radio, apart=apart)
    print(chosen.strategy.name, len(found), found[:3])
"""


def test_without_numba_every_strategy_in_plain_python(tmp_path, of_a_user):
    """To the bit, but for 1e-12 m/s where a function of the C library enters."""
    team = scenario("oceans2020", {"fleets": TEAM, "network": RADIO})
    played = [(each, tape_of(each, 300)) for each in (scenario("oceans2020", {"strategy": name}) for name in SIGHTED)]
    tasks = []
    for each, tape in [*played, (team, tape_of(team, 300)), of_a_user]:
        smooth = each is team or each.strategy.name in SMOOTH  # a turn takes a sine
        tasks.append((each.model_dump(mode="json"), tuple(tape), (0, 49), each is team, 1e-12 * smooth))
    (tmp_path / "tapes").write_bytes(pickle.dumps(tasks))
    done = subprocess.run(
        [sys.executable, "-c", PLAIN, ROOT / "tests", tmp_path / "tapes"], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert len(lines) == len(tasks)
    assert [line for line in lines if " 0 []" not in line] == []


@pytest.fixture(scope="module")
def chosen():
    return scenario("oceans2020")


@pytest.fixture(scope="module")
def tape(chosen):
    return tape_of(chosen, 3)


class TestInbox:
    """Any order, any number of times, of any age."""

    def decided(self, chosen, tape, change):
        buoy = Buoy(chosen, 20)
        inbox = reports_of(tape, 0, (), chosen.time_step)
        return buoy.decide(reading_of(tape, 0, 20), change(inbox), 0)

    def test_in_any_order_twice_with_old_ones_and_its_own(self, chosen, tape):
        straight = self.decided(chosen, tape, lambda inbox: inbox)
        assert straight[:2] == (tape.command_x[0, 20], tape.command_y[0, 20])
        assert self.decided(chosen, tape, lambda inbox: inbox[::-1]) == straight
        assert self.decided(chosen, tape, lambda inbox: inbox + inbox[:9]) == straight
        older = [Report(i, 0.0, 0.0, 0.0, 0.0, True, (), -1.0) for i in range(50)]
        assert self.decided(chosen, tape, lambda inbox: inbox + older) == straight
        assert self.decided(chosen, tape, lambda inbox: older + inbox) == straight
        near = sorted(range(50), key=lambda i: np.hypot(tape.x[0, i] - tape.x[0, 20], tape.y[0, i] - tape.y[0, 20]))
        assert self.decided(chosen, tape, lambda inbox: [inbox[i] for i in near[1:21]]) == straight

    def test_through_bytes_and_back(self, chosen, tape):
        straight = self.decided(chosen, tape, lambda inbox: inbox)
        assert self.decided(chosen, tape, lambda inbox: [Report.from_bytes(each.to_bytes()) for each in inbox]) == (
            straight
        )

    def test_that_is_empty(self, chosen, tape):
        decision = self.decided(chosen, tape, lambda inbox: [])
        assert np.hypot(decision.vx, decision.vy) <= 1.0
        assert decision.report == Buoy(chosen, 20).report(reading_of(tape, 0, 20), 0)

    def test_another_seed_or_run_is_another_chance(self):
        walk = scenario("oceans2020", {"strategy": "random-walk"})
        still = Reading(1.0, 2.0, 0.0, 0.0, False)
        wanted = {Buoy(walk, 3, seed=seed, run=run).decide(still, [], 5)[:2] for seed in (0, 1) for run in (0, 1)}
        assert len(wanted) == 4
        assert Buoy(walk, 3, seed=walk.seed).decide(still, [], 5) == Buoy(walk, 3).decide(still, [], 5)


class TestBriefing:
    """What an agent knows before it leaves is what the engine tells it."""

    def test_every_agent_of_two_fleets(self):
        chosen = scenario("oceans2020", {"fleets.0.sensor_radius": 0.5, "area.agent_margin": 1.0})
        world, swarm = (simulation := Simulation(chosen)).world, simulation.swarm
        for i in (0, 14, 15, 49):
            told = briefing(chosen, i)
            assert (told.agents, told.half_x, told.half_y) == (50, world.clamp_x, world.clamp_y)
            assert told.reach == swarm.sensor_radius[i] + world.target_radius
            assert (told.share_begin, told.share_end) == (swarm.share_end[i - 1] if i else 0.0, swarm.share_end[i])

    @pytest.mark.parametrize("id", [-1, 50, True, 1.5, "7"])
    def test_of_nobody(self, id):
        with pytest.raises(ScenarioError, match="name an agent by its number, 0 to 49"):
            briefing(scenario(), id)


class TestErrors:
    """One sentence."""

    @pytest.mark.parametrize("name", ["pursuit", "lattice-intercept"])
    def test_a_strategy_that_is_told_the_truth(self, name):
        with pytest.raises(StrategyError, match="no buoy can know"):
            Buoy(scenario("oceans2020", {"strategy": name}), 0)

    @pytest.mark.parametrize("field", ["x", "vy"])
    def test_a_reading_that_is_no_number(self, field):
        reading = Reading(0.0, 0.0, 0.0, 0.0, False)._replace(**{field: math.nan})
        with pytest.raises(MessageError, match="agent 0 holds a number that is not finite, in step 4"):
            Buoy(scenario(), 0).decide(reading, [], 4)

    def test_a_buoy_that_is_not_in_the_scenario(self):
        with pytest.raises(ScenarioError, match="is 50"):
            Buoy(scenario(), 50)
