"""What the reference pages show can be run, and they leave nothing out."""

import re
import tomllib
from pathlib import Path

import pytest

from scenarios import changed
from shoal.metrics.summary import METRICS
from shoal.run.simulation import Simulation
from shoal.scenario.commands import Command
from shoal.scenario.disturbances import DISTURBANCES
from shoal.scenario.load import load, read_table, scenario_from
from shoal.scenario.network import AdaptiveDegree, Network
from shoal.scenario.presence import Join, Loss
from shoal.scenario.schema import Fleet
from shoal.scenario.targets import TARGETS

ROOT = Path(__file__).resolve().parents[1]
PAGES = ("targets", "disturbances")


def page(name):
    return (ROOT / f"docs/reference/{name}.md").read_text(encoding="utf-8")


def blocks(name):
    return re.findall(r"```toml\n(.*?)```", page(name), re.DOTALL)


EXAMPLES = [(name, number) for name in PAGES for number in range(len(blocks(name)))]


class TestExamples:
    """Every block of TOML is a part of a scenario; the rest is the paper's."""

    @pytest.mark.parametrize(("name", "number"), EXAMPLES)
    def test_runs(self, name, number):
        part = tomllib.loads(blocks(name)[number])
        chosen = scenario_from(changed(read_table("oceans2020"), part))
        simulation = Simulation(chosen)
        simulation.advance(20)
        assert simulation.tally.steps.sum() == 20

    def test_of_every_kind_of_target(self):
        shown = {target["kind"] for block in blocks("targets") for target in tomllib.loads(block)["targets"]}
        assert shown == TARGETS.keys() - {"track"}  # which needs a file

    def test_50_then_25_then_75(self):
        frames = Simulation(load(ROOT / "examples/robustness.toml")).advance(9000, every=1500)
        assert frames.alive.sum(axis=1).tolist() == [50, 50, 25, 25, 75, 75]


class TestCompleteness:
    """Nothing that a scenario can say is left out."""

    @pytest.mark.parametrize("model", [Network, AdaptiveDegree, Loss, Join, Command])
    def test_every_field_of_networks_and_failures(self, model):
        assert [name for name in model.model_fields if name not in page("disturbances")] == []

    def test_every_field_of_fleets_that_disturbs(self):
        others = ("name", "count", "max_speed", "mass", "start", "strategy", "windage")  # of the sea
        assert [name for name in Fleet.model_fields if name not in page("disturbances") and name not in others] == []

    @pytest.mark.parametrize("kind", sorted(TARGETS.keys() - {"track"}))
    def test_every_field_of_targets(self, kind):
        assert [name for name in TARGETS[kind].model_fields if name not in page("targets")] == []

    @pytest.mark.parametrize("kind", sorted(DISTURBANCES))
    def test_every_field_of_disturbances(self, kind):
        assert [name for name in DISTURBANCES[kind].model_fields if name not in page("disturbances")] == []

    def test_every_metric(self):
        assert [name for name in METRICS if f"`{name}`" not in page("metrics")] == []
