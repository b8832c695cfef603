"""The hash of a scenario: what shapes a run, and nothing else."""

import pytest
from pydantic import Field

from scenarios import scenario
from shoal.scenario.network import Network
from shoal.scenario.schema import Scenario


class WiderNetwork(Network):
    """A network with a field of a later version."""

    hops: int = Field(default=1)


class LaterScenario(Scenario):
    """A scenario with fields of a later version, off by default."""

    network: WiderNetwork
    waves: float | None = None


def later(**changes):
    table = scenario().model_dump(mode="json")
    return LaterScenario.model_validate({**table, **changes})


class TestHash:
    def test_a_field_that_is_off_by_default_changes_none(self):
        assert later().hash == scenario().hash

    def test_a_field_that_is_on_changes_it(self):
        assert later(waves=0.5).hash != scenario().hash
        network = {**scenario().network.model_dump(mode="json"), "hops": 2}
        assert later(network=network).hash != scenario().hash

    @pytest.mark.parametrize(
        "changes",
        [
            {"motion.update_order": "synchronous"},
            {"network.loss": 0.0},
            {"fleets.0.sensor_radius": 0.0},
            {"strategy.inertia": 1.0},
        ],
    )
    def test_saying_a_default_changes_none(self, changes):
        assert scenario("oceans2020", changes).hash == scenario("oceans2020").hash

    @pytest.mark.parametrize("changes", [{"seed": 7}, {"name": "mine"}, {"description": "another"}])
    def test_neither_do_seed_and_names(self, changes):
        assert scenario("oceans2020", changes).hash == scenario("oceans2020").hash

    @pytest.mark.parametrize(
        "changes",
        [
            {"time_step": 0.2},
            {"steps": 99},
            {"strategy.inertia": 0.5},
            {"strategy": "lattice"},
            {"fleets.0.strategy": "lattice"},
            {"fleets.0.name": "another"},
            {"network.loss": 0.1},
            {"targets.0.speed": 4.0},
        ],
    )
    def test_what_shapes_a_run_does(self, changes):
        assert scenario("oceans2020", changes).hash != scenario("oceans2020").hash

    def test_targets_of_two_kinds_differ_though_their_fields_are_the_same(self):
        kinds = [{"kind": kind, "radius": 1.0, "speed": 1.0} for kind in ("line", "walk")]
        one, other = (scenario("oceans2020", {"targets": [kind]}) for kind in kinds)
        assert one.hash != other.hash
