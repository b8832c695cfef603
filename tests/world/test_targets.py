"""How targets move: not at all, along waypoints, along a recorded track."""

import math
from collections import namedtuple
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import replay
from scenarios import scenario
from shoal.core.agents import new_swarm
from shoal.run.simulation import Simulation
from shoal.tracks.track import position_at
from shoal.world.sea.sea import calm_sea
from shoal.world.targets.catalogue import NUMBERS, TARGET_FIELDS
from shoal.world.targets.contract import Tracks
from shoal.world.targets.dispatch import advance_target

NO_DRAW = np.uint64(0)
clock = namedtuple("clock", "time_step agents")  # all of the world that targets ask for
NOBODY = new_swarm([2], ())


def follow(track, time, others=()):
    """x, y, present of a target on a track at a time; `others` are the tracks stored before it."""
    stored = [*others, track]
    fixes = Tracks(*(np.concatenate([getattr(each, name) for each in stored]) for name in ("time", "x", "y")))
    target = np.zeros(1, TARGET_FIELDS)
    target["kind"] = NUMBERS["track"]
    target["first_fix"] = sum(each.time.size for each in others)
    target["fixes"], target["max_gap"] = track.time.size, track.max_gap
    advance_target(target[0], fixes, NOBODY, calm_sea(), clock(time, 2), 1, NO_DRAW)
    return float(target["x"][0]), float(target["y"][0]), bool(target["present"][0])


@st.composite
def tracks(draw):
    """Fixes at irregular times, and how long a silence may be."""
    intervals = draw(st.lists(st.one_of(st.floats(0.1, 50.0), st.sampled_from([1.0, 60.0])), min_size=1, max_size=20))
    rng = np.random.default_rng(draw(st.integers(0, 2**32)))
    time = np.concatenate([[0.0], np.cumsum(intervals)])
    x, y = np.round(rng.uniform(-1e4, 1e4, (2, time.size)), 3)
    return SimpleNamespace(time=time, x=x, y=y, max_gap=draw(st.sampled_from([1.0, 10.0, 60.0, 1e9])))


class TestTrack:
    """Between two fixes on the straight line; in long silences and outside the track not there."""

    def assert_agrees(self, track, time, others=()):
        x, y, present = follow(track, time, others)
        expected_x, expected_y, expected = position_at(track, time)
        assert present == expected
        if present:
            assert (x, y) == pytest.approx((float(expected_x), float(expected_y)), rel=1e-12, abs=1e-9)

    @given(track=tracks(), share=st.floats(-0.1, 1.1))
    @settings(max_examples=200)
    def test_is_where_position_at_says(self, track, share):
        self.assert_agrees(track, share * track.time[-1])

    @given(track=tracks(), data=st.data())
    @settings(max_examples=100)
    def test_is_there_at_every_fix_and_where_it_was_fixed(self, track, data):
        i = data.draw(st.integers(0, track.time.size - 1))
        assert follow(track, track.time[i]) == (track.x[i], track.y[i], True)
        self.assert_agrees(track, track.time[i])

    @given(track=tracks(), data=st.data())
    @settings(max_examples=100)
    def test_a_moment_before_and_after_a_fix(self, track, data):
        i = data.draw(st.integers(0, track.time.size - 1))
        for time in (np.nextafter(track.time[i], -np.inf), np.nextafter(track.time[i], np.inf)):
            self.assert_agrees(track, float(time))

    @given(first=tracks(), second=tracks(), share=st.floats(-0.1, 1.1))
    @settings(max_examples=50)
    def test_tracks_stored_behind_each_other_do_not_mix(self, first, second, share):
        self.assert_agrees(second, share * second.time[-1], others=[first])
        self.assert_agrees(first, share * first.time[-1])

    def test_by_hand(self):
        track = SimpleNamespace(
            time=np.array([0.0, 10.0, 110.0, 120.0]),
            x=np.array([0.0, 10.0, 20.0, 20.0]),
            y=np.array([0.0, 0.0, 0.0, 5.0]),
            max_gap=50.0,
        )
        assert follow(track, 2.5) == (2.5, 0.0, True)
        assert follow(track, 10.0) == (10.0, 0.0, True)
        assert follow(track, 60.0)[2] is False
        assert follow(track, 115.0) == (20.0, 2.5, True)
        assert follow(track, 120.1)[2] is False

    def test_absent_targets_stay_where_they_were_last(self):
        target = np.zeros(1, TARGET_FIELDS)
        target["kind"], target["fixes"], target["max_gap"] = NUMBERS["track"], 2, 100.0
        fixes = Tracks(np.array([0.0, 10.0]), np.array([0.0, 4.0]), np.array([0.0, 2.0]))
        for steps_done in range(1, 30):
            advance_target(target[0], fixes, NOBODY, calm_sea(), clock(1.0, 2), steps_done, NO_DRAW)
        assert (target["x"][0], target["y"][0], target["present"][0]) == (4.0, 2.0, 0)

    def test_in_a_run_the_frame_of_a_step_shows_the_track_at_its_time(self):
        simulation = Simulation(scenario("oceans2020", {"time_step": 0.5}))
        track = SimpleNamespace(time=np.array([0.0, 20.0]), x=np.array([-8.0, 8.0]), y=np.zeros(2), max_gap=100.0)
        simulation.tracks = Tracks(track.time, track.x, track.y)
        make = simulation._targets
        make["kind"], make["fixes"], make["max_gap"] = NUMBERS["track"], 2, track.max_gap
        with simulation.edit() as now:
            now.targets["x"], now.targets["y"] = -8.0, 0.0
        frames = simulation.advance(60, every=1)
        x, _, present = position_at(track, 0.5 * frames.step)
        assert frames.target_present[:, 0].tolist() == present.tolist()
        assert frames.target_x[present, 0] == pytest.approx(x[present])


class TestStill:
    """A target that stays where it is."""

    def test_stays(self):
        still = {"kind": "still", "radius": 1.0, "x": 3.0, "y": -4.0}
        simulation = Simulation(scenario("oceans2020", {"targets": [still]}))
        frames = simulation.advance(200, every=1)
        assert set(zip(frames.target_x[:, 0], frames.target_y[:, 0], strict=True)) == {(3.0, -4.0)}
        assert frames.target_present.all()


def path_of(changes=None, steps=3000, run=0):
    """Places, headings and waypoints of a waypoint target at the start of each step, (K, 2) each."""
    simulation = Simulation(scenario("oceans2020", changes), run)
    rows = []
    for _ in range(steps):
        rows.append(simulation.targets[0].copy())
        simulation.advance(1)
    table = np.array(rows)
    return (np.stack([table[f"{of}x"], table[f"{of}y"]], axis=1) for of in ("", "heading_", "waypoint_"))


class TestWaypoint:
    """Constant speed toward uniform waypoints, turning at most so far per step."""

    def test_every_step_is_as_long_as_the_speed_says(self):
        places, headings, _ = path_of({"targets.0.speed": 5.0})
        steps = np.diff(places, axis=0)
        assert np.hypot(*steps.T) == pytest.approx(0.5, rel=1e-12)
        assert np.hypot(*headings.T) == pytest.approx(1.0, rel=1e-12)
        np.testing.assert_allclose(steps, 0.5 * headings[1:], atol=1e-12)

    @pytest.mark.parametrize("max_turn", [3.0, 20.0, 100.0, 180.0])
    def test_never_turns_further_than_allowed(self, max_turn):
        _, headings, _ = path_of({"targets.0.max_turn": max_turn})
        one, other = headings[:-1], headings[1:]
        turns = np.abs(np.arctan2(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0], (one * other).sum(axis=1)))
        assert np.degrees(turns.max()) <= max_turn + 1e-9
        assert np.degrees(turns.max()) > 0.9 * max_turn

    def test_turns_the_shorter_way_and_then_runs_straight(self):
        """Every step but those with a large turn heads exactly for the waypoint."""
        places, headings, waypoints = path_of()
        bearing = waypoints[:-1] - places[:-1]
        bearing /= np.hypot(*bearing.T)[:, None]
        before, after = (headings[:-1] * bearing).sum(axis=1), (headings[1:] * bearing).sum(axis=1)
        straight = before >= math.cos(math.radians(20)) - 1e-12
        assert after[straight] == pytest.approx(1.0, abs=1e-12)
        assert (after >= before - 1e-12).all()

    def test_takes_a_new_waypoint_when_near(self):
        places, _, waypoints = path_of({"targets.0.waypoint_patience": 10**9})
        taken = (waypoints[1:] != waypoints[:-1]).any(axis=1)
        near = np.hypot(*(waypoints[:-1] - places[1:]).T) < 1.5
        assert (taken == near).all()
        assert taken.sum() > 10

    @pytest.mark.parametrize("patience", [1, 7, 50])
    def test_or_when_its_patience_ends(self, patience):
        _, _, waypoints = path_of({"targets.0.waypoint_patience": patience, "targets.0.waypoint_reach": 1e-9})
        taken = np.flatnonzero((waypoints[1:] != waypoints[:-1]).any(axis=1)) + 1
        assert taken[0] == patience
        assert set(np.diff(taken).tolist()) == {patience}

    def test_of_the_steps_own_draws(self):
        chosen = scenario("oceans2020", {"targets.0.waypoint_patience": 5})
        simulation = Simulation(chosen, run=3)
        for number in range(100):
            before = simulation.targets[0].copy()
            simulation.advance(1)
            after = simulation.targets[0]
            if before["waypoint_x"] != after["waypoint_x"]:
                expected = replay.new_waypoint(chosen, 3, number)
                assert (after["waypoint_x"], after["waypoint_y"]) == pytest.approx(tuple(expected), abs=1e-14)
        assert number == 99

    def test_waypoints_fill_their_box_evenly(self):
        _, _, waypoints = path_of({"targets.0.waypoint_patience": 1, "area.width": 30.0})
        for axis, half in ((0, 13.0), (1, 8.0)):
            counts, _ = np.histogram(waypoints[:, axis], bins=10, range=(-half, half))
            assert counts.sum() == 3000
            assert ((counts - 300) ** 2 / 300).sum() < 27.9  # 99.9 % of 9 degrees of freedom

    def test_at_rest_it_stays(self):
        places, _, _ = path_of({"targets.0.speed": 0.0}, steps=50)
        assert np.ptp(places, axis=0).tolist() == [0.0, 0.0]

    def test_does_not_look_at_the_swarm(self):
        one, _, _ = path_of({"network.neighbors": 1})
        other, _, _ = path_of({"network.neighbors": 49, "strategy.social": 0.1})
        assert one.tobytes() == other.tobytes()
