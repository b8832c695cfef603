"""Waits on stations, believes what single bits say, and surrounds."""

import math

import numpy as np
import pytest

from scenarios import scenario
from shoal.run.simulation import Simulation
from shoal.strategies import CATALOGUE
from staging import DT, NOWHERE, memory_of, places, put, staged, wanted

FAR = (8.0, 8.0)


def memories(simulation, *fields):
    """(N, fields)"""
    memory = simulation.memories.memory[: simulation.scenario.agents]
    return np.stack([memory[field] for field in fields], axis=1)


def believing(place, estimate, velocity=(0.0, 0.0), *, target=NOWHERE, contact=0.0, was_on=0.0):
    """An agent at a place, in contact at a time, with an estimate; another one is far away."""
    simulation = staged("encircle", [place, FAR], targets=[target])
    memory = memory_of(simulation)
    memory["x"][0], memory["y"][0] = estimate
    memory["vx"][0], memory["vy"][0] = velocity
    memory["speed"][0] = math.hypot(*velocity) or 1.0
    memory["contact"][0], memory["was_on"][0] = contact, was_on
    memory["contact"][1] = -1e9
    return simulation


def corrected(*arguments, **options):
    simulation = believing(*arguments, **options)
    simulation.advance(1)
    return memories(simulation, "x", "y")[0]


class TestInformation:
    """The paper's, and nothing more."""

    def test_reports_carry_nothing_but_the_papers_message(self):
        assert CATALOGUE["encircle"].told == ()
        assert not CATALOGUE["encircle"].informed
        assert not CATALOGUE["encircle"].hears_all


class TestStations:
    """Where nobody is on target it is the motionless lattice."""

    def test_without_a_target_it_moves_as_the_lattice(self):
        nothing = {"targets": [{"kind": "still", "x": 1e6, "y": 0.0, "radius": 1.0}], "steps": 400}
        ours, lattice = (
            Simulation(scenario("oceans2020", {**nothing, "strategy": s})) for s in ("encircle", "lattice")
        )
        ours.advance(400)
        lattice.advance(400)
        assert places(ours) == pytest.approx(places(lattice), abs=1e-9)

    def test_after_patience_without_contact_agents_go_home(self):
        simulation = believing((0.0, 0.0), (0.0, 3.0), contact=-1.1)
        home = memories(simulation, "station_x", "station_y")[0]
        assert DT * wanted(simulation)[0] == pytest.approx(home, abs=1e-6)


class TestEstimate:
    """One bit moves it along the line to whoever sensed it, as little as makes it agree."""

    def test_seeing_the_target_draws_an_estimate_beyond_reach_to_the_rim(self):
        assert corrected((0.0, 0.0), (3.0, 4.0), target=(0.5, 0.0), was_on=1.0) == pytest.approx([0.6, 0.8])

    def test_seeing_the_target_leaves_one_within_reach(self):
        assert corrected((0.0, 0.0), (0.3, 0.4), target=(0.5, 0.0), was_on=1.0) == pytest.approx([0.3, 0.4])

    def test_a_target_that_just_came_on_is_on_the_rim(self):
        assert corrected((0.0, 0.0), (0.3, 0.4), target=(0.5, 0.0), was_on=0.0) == pytest.approx([0.6, 0.8])

    def test_not_seeing_it_pushes_an_estimate_within_reach_out(self):
        assert corrected((0.0, 0.0), (0.3, 0.4)) == pytest.approx([0.6, 0.8])

    def test_not_seeing_it_leaves_one_beyond(self):
        assert corrected((0.0, 0.0), (3.0, 4.0)) == pytest.approx([3.0, 4.0])

    def test_it_moves_on_by_its_velocity(self):
        assert corrected((0.0, 0.0), (3.0, 4.0), (5.0, -2.0)) == pytest.approx([3.5, 3.8])

    def test_it_stays_at_the_edge_of_the_area(self):
        simulation = believing((0.0, 0.0), (9.95, -9.95), (1.0, -1.0))
        simulation.advance(1)
        assert memories(simulation, "x", "y", "vx", "vy")[0] == pytest.approx([10.0, -10.0, 0.0, 0.0])

    def test_a_leader_on_target_draws_it_to_the_rim_around_the_leader(self):
        simulation = staged("encircle", [(-5.0, 0.0), (5.0, 0.0)], targets=[(5.0, 0.5)])
        memory = memory_of(simulation)
        memory["x"][0], memory["y"][0], memory["contact"][0] = 5.0, 3.0, 0.0
        simulation.advance(1)
        assert memories(simulation, "x", "y")[0] == pytest.approx([5.0, 1.0])

    def test_a_correction_turns_the_velocity_and_the_estimated_speed_stays_its_length(self):
        simulation = believing((0.0, 0.0), (3.0, 4.0), (1.0, 0.0), target=(0.5, 0.0), was_on=1.0)
        simulation.advance(1)
        vx, vy, speed = memories(simulation, "vx", "vy", "speed")[0]
        assert math.hypot(vx, vy) == pytest.approx(speed)
        x, y = 3.0 + DT * 1.0, 4.0
        change = np.array([x, y]) * (1.0 / math.hypot(x, y) - 1.0)
        assert math.atan2(vy, vx) == pytest.approx(math.atan2(change[1] / DT, 1.0 + change[0] / DT))

    def test_the_speed_is_learned_from_corrections_along_the_way(self):
        faster = believing((0.0, 0.0), (0.5, 0.0), (1.0, 0.0))  # it must have gone farther than thought
        faster.advance(1)
        slower = believing((0.0, 0.0), (-0.5, 0.0), (1.0, 0.0))  # it must have stayed behind
        slower.advance(1)
        assert memories(faster, "speed")[0, 0] > 1.0 > memories(slower, "speed")[0, 0]


class TestRing:
    """Around the estimate, each on the side of its station, as far as it can keep up."""

    def goal(self, station, estimate, *, speed=1.0, top=1.0):
        """Where an agent on its station wants to be, with a fresh estimate of this speed, alone."""
        simulation = staged(("encircle", {"lead": 0.0}), [station, FAR], top=top)
        memory = memory_of(simulation)
        memory["station_x"][0], memory["station_y"][0] = station
        memory["x"][0], memory["y"][0] = estimate
        memory["speed"][0], memory["contact"][0] = speed, 0.0
        put(simulation, [station, FAR])
        return wanted(simulation)[0]

    def test_agents_make_for_the_ring_on_their_stations_side(self):
        assert DT * self.goal((0.0, 0.0), (3.0, 4.0), speed=1e-3, top=1e9) == pytest.approx(
            np.array([3.0, 4.0]) * (1.0 - 0.95 / 5.0), abs=1e-6
        )

    def test_the_ring_is_ahead_by_a_share_of_the_time_to_get_there(self):
        """0.1 of 5 m at 1 m/s is 0.5 s, in which the estimate goes 1 m."""
        simulation = staged(("encircle", {"ring": 0.0, "chase": 1e9}), [(0.0, 0.0), FAR], top=1.0)
        memory = memory_of(simulation)
        memory["x"][0], memory["y"][0], memory["contact"][0] = 3.0 - DT * 1.6, 4.0 + DT * 1.2, 0.0
        memory["vx"][0], memory["vy"][0], memory["speed"][0] = 1.6, -1.2, 2.0
        assert wanted(simulation)[0] == pytest.approx(np.array([3.8, 3.4]) / math.hypot(3.8, 3.4))

    def test_neighbors_nearer_than_the_spacing_push(self):
        """By 0.3 ((2 m / 1 m)^2 - 1) of the way to the one, not to the other."""
        goals = []
        for push in (0.0, 0.3):
            simulation = staged(("encircle", {"push": push, "lead": 0.0}), [(0.0, 0.0), (1.0, 0.0), (0.0, -3.0)])
            memory = memory_of(simulation)
            memory["x"][0], memory["y"][0], memory["speed"][0], memory["contact"][0] = 3.0, 4.0, 1.0, 0.0
            goals.append(DT * wanted(simulation)[0])
        assert goals[1] - goals[0] == pytest.approx([-0.9, 0.0], abs=1e-5)

    @pytest.mark.parametrize(("distance", "goes"), [(4.4, True), (4.6, False)])
    def test_an_agent_half_as_fast_as_the_target_goes_half_as_far(self, distance, goes):
        velocity = self.goal((0.0, 0.0), (distance, 0.0), speed=2.0)
        assert velocity == pytest.approx([1.0, 0.0] if goes else [0.0, 0.0], abs=1e-9)

    def test_a_still_target_is_surrounded_and_never_lost(self):
        """Angles around the target: no half of the circle is empty."""
        still = {"kind": "still", "x": 1.0, "y": 1.0, "radius": 1.0}
        simulation = Simulation(scenario("oceans2020", {"strategy": "encircle", "targets": [still], "steps": 1200}))
        simulation.advance(400)
        frames = simulation.advance(400, every=1)
        assert frames.on_target.any(axis=1).all()
        x, y = places(simulation).T - np.array([[1.0], [1.0]])
        near = np.hypot(x, y) < 2.0
        angles = np.sort(np.arctan2(y[near], x[near]))
        gaps = np.diff(np.append(angles, angles[0] + 2.0 * math.pi))
        assert near.sum() >= 4
        assert gaps.max() < math.pi
