"""Reaches out for what roams, closes holes where it waits, and knows its body."""

import math

import numpy as np
import pytest

from scenarios import scenario
from shoal.run.simulation import Simulation
from shoal.strategies import CATALOGUE
from staging import DT, NOWHERE, memory_of, places, staged, wanted

FAR = (8.0, 8.0)
DEFAULTS = CATALOGUE["cordon"].params._field_defaults
SLUGGISH = {
    "targets": [{"kind": "still", "x": 1e6, "y": 0.0, "radius": 1.0}],
    "fleets.0.max_acceleration": 1.0,
    "fleets.1.max_acceleration": 1.0,
    "strategy": {"name": "cordon", "spread": 0.0},
    "steps": 400,
}


def cordon(where, target=NOWHERE, *, top=1.0, memory=None, **params):
    """Agents at these places whose bodies obey; the first of them remembers this."""
    simulation = staged(("cordon", params), where, targets=[target], top=top)
    kept = memory_of(simulation)
    kept["agility"][:] = 1e12
    for field, value in (memory or {}).items():
        kept[field][0] = value
    return simulation


def remembered(simulation, field):
    return float(memory_of(simulation)[field][0])


class TestInformation:
    """The paper's, and nothing more."""

    def test_reports_carry_nothing_but_the_papers_message(self):
        assert CATALOGUE["cordon"].told == ()
        assert not CATALOGUE["cordon"].informed
        assert not CATALOGUE["cordon"].hears_all


class TestWaiting:
    """A cover that keeps an inset inside where agents may go, its holes closed by pushes."""

    def test_not_pushed_apart_it_is_the_lattice_drawn_in(self):
        nothing = {"targets": [{"kind": "still", "x": 1e6, "y": 0.0, "radius": 1.0}], "steps": 400}
        spread = 1.0 - DEFAULTS["inset"] / 8.5
        ours, lattice = (
            Simulation(scenario("oceans2020", {**nothing, "strategy": chosen}))
            for chosen in ({"name": "cordon", "spread": 0.0}, {"name": "lattice", "spread": spread})
        )
        ours.advance(400)
        lattice.advance(400)
        assert places(ours) == pytest.approx(places(lattice), abs=1e-3)

    def test_neighbors_within_the_span_push(self):
        """By spread x top speed x ((span / r)^2 - 1) r / span."""
        simulation = cordon([(0.0, 0.0), (1.0, 0.0)], home=0.0, spread=0.02, span=3.0)
        assert wanted(simulation)[0] == pytest.approx([-0.02 * (9.0 - 1.0) / 3.0, 0.0], rel=1e-4)

    @pytest.mark.parametrize(("full", "shape"), [(0.9, "far"), (1.1, "near")])
    def test_where_the_reach_is_more_than_the_area_asks_for_it_waits_as_if_the_target_roamed(self, full, shape):
        """The reach is 1 m."""
        shapes = {"near": {"home": 0.1, "inset": 2.0}, "far": {"home_far": 0.3, "inset_far": 1.0}}
        others = {"spread": 0.0, "spread_far": 0.0, "home": 9.0, "home_far": 9.0}
        asked = {**others, **shapes[shape]}
        simulation = cordon([(0.0, 0.0), FAR], full=full, **asked)
        station = [remembered(simulation, f"station_{axis}") for axis in "xy"]
        share, inset = (0.1, 2.0) if shape == "near" else (0.3, 1.0)
        way = (1.0 - inset / 10.0) * np.array(station) * share / DEFAULTS["span"]
        assert wanted(simulation)[0] == pytest.approx(way, rel=1e-6)


class TestRoaming:
    """The share of recent contacts at the edge."""

    @pytest.mark.parametrize(("x", "roams"), [(9.8, True), (5.0, False)])
    def test_contacts_at_the_edge_count(self, x, roams):
        simulation = cordon([(x, 0.0), FAR], (x, 0.0), edge=0.5, survey=1.0, memory={"x": x, "contact": 0.0})
        simulation.advance(1)
        assert remembered(simulation, "roam") == pytest.approx(DT if roams else 0.0)

    def test_who_knows_that_the_target_roams_waits_farther_out(self):
        shape = {"inset": 5.0, "inset_far": 1.0, "roaming": 0.1, "home": 0.1, "home_far": 0.1, "spread_far": 0.0}
        near, far = (
            DT * wanted(cordon([(0.0, 0.0), FAR], spread=0.0, memory={"roam": roam}, **shape))[0] for roam in (0.0, 0.2)
        )
        assert np.hypot(*far) / np.hypot(*near) == pytest.approx((10.0 - 1.0) / (10.0 - 5.0))


class TestRing:
    """Those around the estimate push each other apart."""

    @pytest.mark.parametrize(("room", "gap"), [(4.0, 2.0), (2.0, 2.0), (0.5, 1.0)])
    def test_where_agents_have_little_room_they_keep_less_apart(self, room, gap):
        """Geometric mean of room and gap, by push x ((gap / r)^2 - 1) r; the agent is on its ring's place."""
        on_it = {"x": 0.0, "y": 0.0, "speed": 1e-3, "contact": 0.0, "station_x": -9.0}
        simulation = cordon(
            [(0.0, 0.0), (0.5, 0.0), FAR], memory=on_it, room=room, gap=2.0, push=0.01, ring=0.0, lead=0.0
        )
        assert wanted(simulation)[0] * DT == pytest.approx([-0.01 * ((gap / 0.5) ** 2 - 1.0) * 0.5, 0.0], rel=1e-3)


class TestPatience:
    """How long a contact is believed."""

    @pytest.mark.parametrize(("patience", "goes"), [(1.0, True), (0.4, False)])
    def test_what_is_no_longer_believed_is_left(self, patience, goes):
        """Half a second after the last contact, which was at (5, 0), west of which is its station."""
        believes = {"x": 5.0, "y": 0.0, "speed": 1e-3, "contact": -0.5, "station_x": -9.0}
        velocity = wanted(cordon([(0.0, 0.0), FAR], memory=believes, patience=patience, spread=0.0))[0]
        assert (velocity[0] > 0.0) == goes


class TestBody:
    """It finds out what acceleration it has, and slows down in time."""

    def test_it_knows_its_acceleration_after_some_steps(self):
        simulation = Simulation(scenario("oceans2020", SLUGGISH))
        simulation.advance(40)
        agility = simulation.memories.memory["agility"][:50]
        assert np.median(agility) == pytest.approx(1.0)
        assert agility.max() <= 1.0 + 1e-9

    def test_it_comes_to_rest_at_its_station(self):
        simulation = Simulation(scenario("oceans2020", SLUGGISH))
        simulation.advance(400)
        memory = simulation.memories.memory[:50]
        share = 1.0 - DEFAULTS["inset"] / 8.5
        home = share * np.stack([memory["station_x"], memory["station_y"]], axis=1)
        assert places(simulation) == pytest.approx(home, abs=0.02)
        assert np.hypot(simulation.swarm.vx[:50], simulation.swarm.vy[:50]).max() < 1.0 * DT  # a step's change

    def test_who_has_not_moved_yet_tries_its_top_speed(self):
        simulation = staged("cordon", [(0.0, 0.0), FAR], top=2.0)
        assert math.hypot(*wanted(simulation)[0]) == pytest.approx(2.0)
