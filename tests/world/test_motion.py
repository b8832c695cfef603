"""Limits of speed, acceleration and turn rate."""

import math

import numpy as np
import pytest

from scenarios import scenario
from shoal.run.simulation import Simulation

OPEN = {
    "area.width": 1e3, "area.height": 1e3, "fleets.0.start": "center", "fleets.1.start": "center",  # far from walls
    "strategy.repulsion_max": 20.0, "targets": [{"kind": "still", "radius": 10.0}],
}  # fmt: skip


def velocities(changes, steps=200):
    """Velocity at the start of each step, (K, N) complex: east + i north."""
    frames = Simulation(scenario("oceans2020", {**OPEN, **changes})).advance(steps, every=1)
    return frames.vx + 1j * frames.vy


class TestAcceleration:
    """The velocity changes by max_acceleration x time step at most."""

    @pytest.mark.parametrize("order", ["synchronous", "sequential"])
    @pytest.mark.parametrize("most", [0.1, 1.0, 8.0])
    def test_holds_in_every_step(self, most, order):
        changes = {f"fleets.{f}.max_acceleration": most for f in (0, 1)} | {"motion.update_order": order}
        v = velocities(changes)
        assert np.abs(np.diff(v, axis=0)).max() == pytest.approx(0.1 * most, rel=1e-9)

    def test_is_of_the_fleet(self):
        change = np.abs(np.diff(velocities({"fleets.0.max_acceleration": 0.5}), axis=0))
        assert change[:, :15].max() <= 0.05 * (1 + 1e-9)
        assert change[:, 15:].max() > 0.5

    def test_from_rest_the_speed_grows_evenly(self):
        """A buoy that wants to go east for ever: v = a t up to its top speed."""
        changes = {
            "fleets": [{"name": "a", "count": 2, "max_speed": 2.0, "max_acceleration": 0.5}], "network.neighbors": 1,
            "strategy": "pursuit", "targets": [{"kind": "still", "radius": 1.0, "x": 400.0}],
        }  # fmt: skip
        simulation = Simulation(scenario("oceans2020", {**OPEN, **changes}))
        with simulation.edit() as now:
            now.swarm.y[:2] = 0.0
        frames = simulation.advance(60, every=1)
        assert frames.vx[:, 0] == pytest.approx(np.minimum(0.05 * np.arange(60), 2.0))


class TestTurnRate:
    """The heading turns by max_turn_rate x time step at most."""

    @pytest.mark.parametrize("order", ["synchronous", "sequential"])
    @pytest.mark.parametrize("most", [5.0, 90.0, 900.0])
    def test_holds_in_every_step(self, most, order):
        changes = {f"fleets.{f}.max_turn_rate": most for f in (0, 1)} | {"motion.update_order": order}
        v = velocities(changes)
        moving = (np.abs(v[:-1]) > 1e-9) & (np.abs(v[1:]) > 1e-9)
        turns = np.degrees(np.abs(np.angle(v[1:] * v[:-1].conj()))[moving])
        assert turns.max() <= 0.1 * most + 1e-6
        assert turns.max() > 0.09 * most

    def test_turns_the_shorter_way(self):
        """Heading east, wanting to go south-west: round by the south, at the rate."""
        changes = {
            "fleets": [{"name": "a", "count": 2, "max_speed": 1.0, "max_turn_rate": 60.0}], "network.neighbors": 1,
            "strategy": "pursuit", "targets": [{"kind": "still", "radius": 1.0, "x": -400.0, "y": -400.0}],
        }  # fmt: skip
        simulation = Simulation(scenario("oceans2020", {**OPEN, **changes}))
        with simulation.edit() as now:
            now.swarm.vx[:2], now.swarm.x[:2], now.swarm.y[:2] = 1.0, 0.0, 0.0
        frames = simulation.advance(30, every=1)
        headings = np.degrees(np.arctan2(frames.vy[:, 0], frames.vx[:, 0]))
        assert headings[:22] == pytest.approx(-6.0 * np.arange(22))
        assert headings[23:] == pytest.approx(-135.0, abs=0.5)

    def test_from_rest_any_heading_is_free(self):
        v = velocities({"fleets.0.max_turn_rate": 1e-3}, steps=2)
        assert np.ptp(np.angle(v[1, :15])) > math.pi / 2

    def test_and_acceleration_hold_together(self):
        v = velocities({"fleets.0.max_turn_rate": 20.0, "fleets.0.max_acceleration": 1.0})[:, :15]
        assert np.abs(np.diff(v, axis=0)).max() <= 0.1 * (1 + 1e-9)
        moving = (np.abs(v[:-1]) > 1e-9) & (np.abs(v[1:]) > 1e-9)
        assert np.degrees(np.abs(np.angle(v[1:] * v[:-1].conj()))[moving]).max() <= 2.0 + 1e-6


class TestOff:
    """No limit, no change."""

    @pytest.mark.parametrize("preset", ["oceans2020", "aamas2020"])
    def test_limits_that_never_bind_change_no_bit(self, preset):
        wide = {"fleets.0.max_acceleration": 1e12, "fleets.0.max_turn_rate": 1e9}
        one, other = (Simulation(scenario(preset, changes)) for changes in ({}, wide))
        one.advance(300)
        other.advance(300)
        assert (one.world.inertial, other.world.inertial) == (False, True)
        assert one.swarm.x.tobytes() == other.swarm.x.tobytes()

    def test_walls_stop_at_once(self):
        """At a wall the velocity is the displacement really made, whatever the acceleration."""
        changes = {f"fleets.{f}.max_acceleration": 0.1 for f in (0, 1)}
        frames = Simulation(scenario("oceans2020", changes)).advance(1000, every=1)
        assert np.abs(frames.x[1:]).max() <= 8.5 + 1e-12
        moved = np.diff(frames.x, axis=0)[1:] / 0.1
        assert moved == pytest.approx(frames.vx[2:], abs=1e-9)
