"""A run at sea: what carries and what stops, against answers that are known."""

import math
import random

import numpy as np
import pytest

from shoal.record.frames import who_hears_whom
from shoal.run.simulation import Simulation
from shoal.scenario.briefing import briefing
from shoal.scenario.load import load
from shoal.world.sea.land import clearance
from shoal.world.sea.sight import in_sight

DAY = 86400.0
ISLAND = [[200.0 * math.cos(a), 200.0 * math.sin(a)] for a in np.linspace(0.0, 2 * math.pi, 40, endpoint=False)]


def drifters(side, time_step, steps, **changes):
    """The paper's agents, without a will of their own."""
    area = {"width": side, "height": side}
    return load("oceans2020", time_step=time_step, steps=steps, strategy="adrift", area=area, **changes)


def ways(scenario, steps):
    """Where agents start, and where they are after so many steps, (N, 2) each."""
    run = Simulation(scenario)
    n = scenario.agents
    before = np.stack((run.swarm.x[:n], run.swarm.y[:n]), axis=-1)
    run.advance(steps)
    return before, np.stack((run.swarm.x[:n], run.swarm.y[:n]), axis=-1)


class TestDrift:
    def test_a_turn_of_solid_water_in_24_hours(self):
        scenario = drifters(10_000.0, 60.0, 1440, sea={"currents": {"kind": "rotation", "period": DAY}})
        before, after = ways(scenario, 1440)
        free = np.hypot(*before.T) < 4900.0
        assert free.sum() > 20
        assert np.hypot(*(after - before).T)[free].max() <= 0.2

    @pytest.mark.parametrize("steps", [(400, 800), (20, 40)], ids=["short", "long"])
    def test_the_order_of_convergence(self, steps):
        """Half the time-step, a quarter of the error, of steps up to 10 s and above."""
        errors = []
        for count in steps:
            period = 3600.0 if steps[0] == 400 else 7200.0
            scenario = drifters(4000.0, period / count, count, sea={"currents": {"kind": "rotation", "period": period}})
            before, after = ways(scenario, count)
            free = np.hypot(*before.T) < 1200.0
            errors.append(np.hypot(*(after - before).T)[free].max())
        assert math.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.15)

    def test_a_gyre_keeps_its_streamlines(self):
        side, speed = 20_000.0, 0.5
        sea = {"currents": {"kind": "gyre", "speed": speed, "side": side}}
        before, after = ways(drifters(side, 60.0, 2880, sea=sea), 2880)

        def psi(at):
            return np.sin(math.pi * (at[:, 0] / side + 0.5)) * np.sin(math.pi * (at[:, 1] / side + 0.5))

        assert np.abs(psi(after) - psi(before)).max() < 1e-4
        assert np.hypot(*(after - before).T).max() > 3000.0

    def test_water_in_a_moving_eddy_stays_in_it(self):
        sea = {"currents": {"kind": "eddy", "speed": 0.5, "radius": 3000.0, "x": -2e4, "speed_x": 0.4}}
        before, after = ways(drifters(1e5, 60.0, 1440, sea=sea), 1440)
        center = np.array([-2e4, 0.0]), np.array([-2e4 + 0.4 * DAY, 0.0])
        near = np.hypot(*(before - center[0]).T) < 25_000.0
        assert near.any()
        change = np.hypot(*(after - center[1]).T) - np.hypot(*(before - center[0]).T)
        assert np.abs(change[near]).max() < 1.0

    def test_own_velocity_is_through_the_water_and_drift_is_the_rest(self):
        sea = {"currents": {"kind": "uniform", "x": 0.3, "y": -0.1}}
        run = Simulation(load("oceans2020", sea=sea, **{"area.width": 2e4, "area.height": 2e4}))
        run.advance(5)
        x, y = run.swarm.x[:50].copy(), run.swarm.y[:50].copy()
        run.advance(1)
        dt = run.scenario.time_step
        assert (run.swarm.x[:50] - x) / dt == pytest.approx(run.swarm.vx[:50] + 0.3, abs=1e-8)
        assert (run.swarm.y[:50] - y) / dt == pytest.approx(run.swarm.vy[:50] - 0.1, abs=1e-8)
        assert run.swarm.drift_x[:50] == pytest.approx(np.full(50, 0.3))
        assert (np.hypot(run.swarm.vx[:50], run.swarm.vy[:50]) <= run.swarm.max_speed[:50] * (1 + 1e-12)).all()

    def test_the_wind_pushes_what_has_windage(self):
        sea = {"wind": {"kind": "uniform", "x": 10.0}}
        changes = {"fleets.BoB-1.windage": 0.02, "fleets.BoB-0.windage": "liferaft"}
        before, after = ways(drifters(1e5, 10.0, 10, sea=sea, **changes), 10)
        inside = np.abs(after).max(axis=1) < 4.9e4
        velocity = (after - before) / 100.0
        assert velocity[:15][inside[:15]] == pytest.approx(np.tile([0.2, 0.0], (inside[:15].sum(), 1)))
        rafts = velocity[15:][inside[15:]]
        assert np.hypot(*rafts.T) == pytest.approx(0.037 * 10 + 0.11 * 1852 / 3600)
        sides = np.degrees(np.arctan2(rafts[:, 1], rafts[:, 0]))
        assert np.abs(sides) == pytest.approx(24.0)
        assert 5 < (sides > 0).sum() < len(sides) - 5

    def test_a_current_carries_targets(self):
        sea = {"currents": {"kind": "uniform", "x": 1.0}}
        person = {"kind": "adrift", "x": 7.0, "spread": 3.0, "radius": 1.0}
        moored = {"kind": "still", "x": 7.0, "radius": 1.0}
        run = Simulation(drifters(1e4, 1.0, 100, sea=sea, targets=[person, moored]))
        x, y = run.targets["x"].copy(), run.targets["y"].copy()
        assert 0.0 < math.hypot(x[0] - 7.0, y[0]) <= 3.0
        run.advance(50)
        assert run.targets["x"] - x == pytest.approx([50.0, 0.0])
        assert run.targets["y"] - y == pytest.approx([0.0, 0.0])


class TestLand:
    SCENARIO = load(
        "oceans2020",
        time_step=5.0,
        steps=400,
        area={"width": 2000.0, "height": 2000.0},
        sea={"coast": [ISLAND, [[-1100.0, 700.0], [1100.0, 800.0], [1100.0, 1100.0], [-1100.0, 1100.0]]]},
        **{"targets.0.speed": 8.0, "targets.0.margin": 10.0, "targets.0.waypoint_reach": 50.0},
    )

    def test_nobody_is_ever_on_land(self):
        run = Simulation(load(self.SCENARIO, strategy="random-walk"))
        shore = run._sea.shore
        aground = 0
        for _ in range(100):
            run.advance(4)
            places = [*zip(run.swarm.x[:50], run.swarm.y[:50], strict=True)]
            places += [*zip(run.targets["x"], run.targets["y"], strict=True)]
            assert min(clearance(shore, *place) for place in places) >= 0.0
            aground += int(run.swarm.aground[:50].sum())
        assert aground > 0

    def test_links_do_not_cross_land_and_pieces_of_a_run_are_the_run(self):
        """What is kept of who sees whom must not show: a run cut into pieces, restored each time, is the same."""
        whole = Simulation(self.SCENARIO)
        frames = whole.advance(120, every=1)
        pieces = [Simulation(self.SCENARIO)]
        for steps in (1, 30, 9, 80):
            last = Simulation(self.SCENARIO)
            with last.edit() as now:
                for mine, theirs in zip(now.swarm, pieces[-1].moment.swarm, strict=True):
                    mine[...] = theirs
                now.targets[:] = pieces[-1].moment.targets
            last.number = pieces[-1].number
            last.advance(steps)
            pieces.append(last)
        assert (pieces[-1].swarm.x[:50] == whole.swarm.x[:50]).all()
        shown = random.Random(1).sample(range(120), 6)
        for at in shown:
            hears = who_hears_whom(frames, at)
            assert hears.sum() > 500
            for i, j in np.argwhere(hears)[::7]:
                assert in_sight(whole._sea.land, frames.x[at, i], frames.y[at, i], frames.x[at, j], frames.y[at, j])

    def test_stations_are_an_even_cover_of_the_water(self):
        run = Simulation(load(self.SCENARIO, strategy="lattice"))
        places = np.stack((run.swarm.station_x[:50], run.swarm.station_y[:50]), axis=-1)
        assert min(clearance(run._sea.shore, *place) for place in places) > 0.0
        apart = np.sort(np.hypot(*(places[:, None] - places[None]).transpose(2, 0, 1)), axis=1)[:, 1]
        assert apart.min() > 0.5 * apart.mean()
        told = briefing(run.scenario, 31)
        assert (told.charted, told.station_x, told.station_y) == (True, *places[31])  # a buoy of its own, too
        run.advance(400)
        left = np.hypot(run.swarm.x[:50] - places[:, 0], run.swarm.y[:50] - places[:, 1])
        assert np.median(left) < 1.0
