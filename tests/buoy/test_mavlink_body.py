"""A body that speaks MAVLink, against a rover that does, in a time of the tests' own."""

import math
import random
from contextlib import suppress

import pytest

pytest.importorskip("pymavlink", reason="pymavlink is not installed: pip install '.[mavlink]'")
pytest.importorskip("pyproj", reason="pyproj is not installed: pip install '.[maritime]'")

from pymavlink.dialects.v20 import ardupilotmega as words

from scenes import FENCE, SILENCE
from shoal.buoy.errors import BodyError, UnreadyError
from shoal.buoy.fence import Fence


class TestBegin:
    """It waits for a rover or boat, its place, GUIDED and, if asked to, for it to be armed."""

    def test_says_which_vehicle_it_has(self, scene):
        here = scene(begun=False, system=7)
        assert here.body.begin(arm=True) == "surface boat of ardupilotmega, system 7"
        assert here.rover.mode == words.ROVER_MODE_GUIDED
        assert here.rover.armed

    def test_arms_only_who_is_asked_to(self, scene):
        here = scene(begun=False)
        here.body.begin()
        assert not here.rover.armed
        with pytest.raises(UnreadyError, match="is not armed"):
            here.body.go(1.0, 0.0)
        assert here.rover.setpoints == []

    def test_nobody_is_heard(self, scene):
        here = scene(begun=False)
        here.rover.mute = True
        with pytest.raises(BodyError, match="no vehicle is heard"):
            here.body.begin()
        assert here.hand.now == pytest.approx(130.0, abs=0.2)

    @pytest.mark.parametrize(
        ("kind", "autopilot", "said"),
        [
            (words.MAV_TYPE_QUADROTOR, words.MAV_AUTOPILOT_ARDUPILOTMEGA, "a quadrotor of ardupilotmega"),
            (words.MAV_TYPE_GROUND_ROVER, words.MAV_AUTOPILOT_PX4, "a ground rover of px4"),
        ],
    )
    def test_who_is_no_rover_of_ardupilot_is_not_steered(self, scene, kind, autopilot, said):
        here = scene(begun=False, kind=kind)
        here.rover.autopilot = autopilot
        with pytest.raises(BodyError, match=said):
            here.body.begin(arm=True)
        assert "COMMAND_LONG" not in here.rover.heard

    def test_ground_stations_on_the_line_are_nobody(self, scene):
        here = scene(begun=False)
        station = here.another(kind=words.MAV_TYPE_GCS, system=255)
        station.autopilot = words.MAV_AUTOPILOT_INVALID
        here.rover.mute = True
        here.hand.movers.append(station)
        with pytest.raises(BodyError, match="no vehicle is heard"):
            here.body.begin()
        here.rover.mute = False
        assert here.body.begin().endswith("system 1")

    def test_a_vehicle_without_a_place_is_not_armed(self, scene):
        here = scene(begun=False)
        here.rover.blind = True
        with pytest.raises(BodyError, match="does not say where it is"):
            here.body.begin(arm=True)
        assert not here.rover.armed

    def test_nor_one_that_is_far_away(self, scene):
        here = scene(begun=False, at=(0.0, 900.0))
        with pytest.raises(BodyError, match=r"is at 0, 900 m, 800 m outside the fence\n  fix: .*area.origin"):
            here.body.begin(arm=True)
        assert not here.rover.armed

    def test_what_the_vehicle_has_against_it_is_passed_on(self, scene):
        here = scene(begun=False)
        here.rover.prearm = "Compass not calibrated"
        with pytest.raises(BodyError, match="Arm: Compass not calibrated"):
            here.body.begin(arm=True)

    def test_outside_guided_the_rover_of_these_tests_refuses_to_be_armed(self, scene):
        here = scene(begun=False)
        here.body.begin()
        here.rover.mode = words.ROVER_MODE_MANUAL
        here.vehicle.ask_to_arm()
        here.hand.run(1.0)
        assert not here.rover.armed
        assert here.vehicle.answers[words.MAV_CMD_COMPONENT_ARM_DISARM] == words.MAV_RESULT_FAILED


class TestSteering:
    """It goes where it is told in the arena's frame, and says where it is there."""

    def test_goes_where_it_is_told(self, scene):
        here = scene()
        here.hand.run(20.0, lambda: here.body.go(1.0, -0.5))
        x, y = here.place
        lagged = 20.0 - 0.5  # the rover's lag
        assert (x, y) == pytest.approx((lagged, -0.5 * lagged), abs=0.2)
        seen = here.body.read()
        assert seen[:4] == pytest.approx((x, y, 1.0, -0.5), abs=0.25)

    def test_where_the_meridians_turn_it_goes_along_the_frame_all_the_same(self, scene):
        here = scene(at=(60e3, 0.0), fence=Fence(100e3, 100e3, 2.0))
        here.hand.run(60.0, lambda: here.body.go(0.0, 2.0))
        x, y = here.place
        assert abs(x - 60e3) < 0.05
        assert y == pytest.approx(2.0 * 59.5, abs=0.3)
        bearing = math.degrees(math.atan2(here.rover.east, here.rover.north))
        assert abs(bearing) > 0.9  # of true north: uncorrected, it would be 1.1 m off by now

    def test_nobody_makes_it_faster_than_its_fleet(self, scene):
        here = scene()
        here.hand.run(5.0, lambda: here.body.go(30.0, 40.0))
        assert here.speed == pytest.approx(2.0, abs=0.01)

    def test_set_points_come_at_least_twice_a_second_without_anybody_asking(self, scene):
        here = scene()
        here.body.go(1.0, 0.0)
        begun, before = here.hand.now, len(here.rover.setpoints)
        here.hand.run(1.0)
        assert here.hand.now - begun == pytest.approx(1.0)
        assert len(here.rover.setpoints) - before >= 4

    def test_only_velocities_count_and_a_standstill_turns_to_nowhere(self, scene):
        here = scene()
        here.body.go(1.0, 0.0)
        here.hand.run(0.3)
        here.body.stop()
        here.hand.run(0.3)
        masks = {math.hypot(each.vx, each.vy) > 0.0: each.type_mask for _, each in here.rover.setpoints}
        ignored = sum(
            getattr(words, f"POSITION_TARGET_TYPEMASK_{name}_IGNORE")
            for name in ["X", "Y", "Z", "AX", "AY", "AZ", "YAW"]
        )
        assert masks == {True: ignored + words.POSITION_TARGET_TYPEMASK_YAW_RATE_IGNORE, False: ignored}

    def test_its_heartbeat_goes_out_every_second(self, scene):
        here = scene()
        before = here.rover.heard.count("HEARTBEAT")
        here.hand.run(10.0)
        assert here.rover.heard.count("HEARTBEAT") - before == pytest.approx(10, abs=1)

    def test_the_detector_is_asked_where_it_is(self, scene):
        here = scene(detector=lambda x, y: x > 5.0)
        assert not here.body.read().on_target
        here.hand.run(10.0, lambda: here.body.go(1.0, 0.0))
        assert here.body.read().on_target

    def test_every_other_message_lost_it_gets_there(self, scene):
        here = scene(lost=0.5)

        def go():
            with suppress(UnreadyError):  # four heartbeats in a row are lost now and then
                here.body.go(1.0, 0.0)

        here.hand.run(40.0, go)
        x, y = here.place
        assert x > 30.0
        assert abs(y) < 1.0

    def test_a_velocity_that_is_none_stops_it(self, scene):
        here = scene()
        here.hand.run(3.0, lambda: here.body.go(1.0, 0.0))
        with pytest.raises(BodyError, match="is not finite"):
            here.body.go(math.nan, 0.0)
        here.hand.run(3.0)
        assert here.speed < 0.01


class TestWatchdog:
    """Who hears nothing, or does not know where it is, lies still."""

    def test_without_a_command_it_stops_before_the_autopilot_does(self, scene):
        here = scene()
        here.body.go(2.0, 0.0)
        here.hand.run(SILENCE + 2.0)
        assert here.rover.setpoint == (0.0, 0.0)
        assert here.speed < 0.1
        assert here.body.silences == 1

    def test_stopped_it_is_told_no_more_so_that_the_autopilot_keeps_its_place(self, scene):
        here = scene()
        here.hand.run(5.0)
        assert here.rover.setpoints == []
        here.hand.run(3.0, lambda: here.body.go(2.0, 0.0))
        here.body.stop()
        stopped = here.rover.time
        here.hand.run(6.0)
        times = [when - stopped for when, _ in here.rover.setpoints]
        assert 1.5 < times[-1] < 2.5
        assert here.rover.setpoint == (0.0, 0.0)

    def test_who_is_told_to_lie_still_is_told_so_on_and_on(self, scene):
        here = scene()
        here.hand.run(1.0, lambda: here.body.go(1.0, 0.0))
        before = len(here.rover.setpoints)
        here.hand.run(10.0, lambda: here.body.go(0.0, 0.0))
        assert len(here.rover.setpoints) - before >= 45

    def test_and_goes_on_with_the_next(self, scene):
        here = scene()
        here.hand.run(5.0)
        here.hand.run(5.0, lambda: here.body.go(2.0, 0.0))
        assert here.speed == pytest.approx(2.0, abs=0.01)

    def test_a_body_nobody_drives_is_stopped_by_the_autopilot(self, scene):
        here = scene()
        here.body.go(2.0, 0.0)
        here.hand.bodies.clear()
        here.hand.run(6.0)
        assert here.speed < 0.01

    def test_a_lost_vehicle_is_said_and_not_steered(self, scene):
        here = scene()
        here.body.go(1.0, 0.0)
        here.rover.mute = True
        here.hand.run(5.0)
        with pytest.raises(UnreadyError, match="was not heard for"):
            here.body.read()
        with pytest.raises(UnreadyError, match="was not heard for"):
            here.body.go(1.0, 0.0)
        here.hand.run(2.0)
        assert here.rover.setpoint == (0.0, 0.0)
        here.rover.mute = False
        here.hand.run(2.0)
        here.body.go(1.0, 0.0)
        assert here.body.read().on_target is False

    def test_without_a_position_there_is_no_reading_and_no_way(self, scene):
        here = scene()
        here.hand.run(3.0, lambda: here.body.go(1.0, 0.0))
        here.rover.blind = True
        here.hand.run(2.5)
        for _ in range(3):
            with pytest.raises(UnreadyError, match=r"said [23]\.\d s ago where it is"):
                here.body.go(1.0, 0.0)
            here.hand.run(0.3)
        assert here.rover.setpoint == (0.0, 0.0)
        here.rover.blind = False
        here.hand.run(0.5)
        here.hand.run(3.0, lambda: here.body.go(1.0, 0.0))
        assert here.speed == pytest.approx(1.0, abs=0.01)

    def test_a_rover_that_was_started_anew_is_asked_for_its_place_again(self, scene):
        here = scene()
        here.hand.run(20.0)
        here.rover.interval, here.rover.time, here.rover.beat_at, here.rover.fix_at = None, 0.0, 0.0, 0.0
        here.hand.run(4.0)
        assert here.body.read().x == pytest.approx(0.0, abs=0.1)


class TestPerson:
    """Whoever switches the mode has the vehicle."""

    def test_in_another_mode_nothing_is_sent_and_guided_is_not_asked_for(self, scene):
        here = scene()
        here.hand.run(1.0, lambda: here.body.go(1.0, 0.0))
        here.rover.mode = words.ROVER_MODE_MANUAL
        here.hand.run(1.5)
        sent = len(here.rover.setpoints)
        for _ in range(10):
            with pytest.raises(UnreadyError, match="is in mode MANUAL: a person"):
                here.body.go(1.0, 0.0)
            here.hand.run(1.0)
        assert len(here.rover.setpoints) == sent
        assert here.rover.mode == words.ROVER_MODE_MANUAL
        assert here.body.read().x > 0.0  # it is heard as before

    def test_given_back_it_goes_on(self, scene):
        here = scene()
        here.rover.mode = words.ROVER_MODE_HOLD
        here.hand.run(3.0)
        here.rover.mode = words.ROVER_MODE_GUIDED
        here.hand.run(1.5)
        here.hand.run(3.0, lambda: here.body.go(1.0, 0.0))
        assert here.speed == pytest.approx(1.0, abs=0.01)

    def test_at_the_end_it_holds(self, scene):
        here = scene()
        here.hand.run(1.0, lambda: here.body.go(1.0, 0.0))
        here.body.close()
        assert here.rover.mode == words.ROVER_MODE_HOLD
        here.body.close()  # twice is once

    def test_at_the_end_it_disarms_what_it_armed_and_nothing_else(self, scene):
        ours, theirs = scene(), scene(begun=False)
        theirs.rover.mode, theirs.rover.armed = words.ROVER_MODE_GUIDED, True
        theirs.body.begin(arm=True)
        for here in (ours, theirs):
            here.hand.run(1.0, lambda here=here: here.body.go(1.0, 0.0))
            here.body.close()
        assert (ours.rover.armed, theirs.rover.armed) == (False, True)
        assert ours.rover.mode == theirs.rover.mode == words.ROVER_MODE_HOLD

    def test_but_not_where_a_person_has_it(self, scene):
        here = scene()
        here.rover.mode = words.ROVER_MODE_MANUAL
        here.hand.run(2.0)
        here.body.close()
        assert here.rover.mode == words.ROVER_MODE_MANUAL


class TestFence:
    """Whatever it is told, it stays inside."""

    def test_a_strategy_gone_mad_does_not_take_it_out(self, scene):
        here = scene(at=(180.0, 80.0))
        chance, most = random.Random(3), [0.0, 0.0]

        def go():
            here.body.go(chance.choice((-1e9, 5.0, 1e9, 3e9)), chance.choice((-2.0, 7.0, 1e9)))
            most[:] = (max(far, abs(at)) for far, at in zip(most, here.place, strict=True))

        here.hand.run(100.0, go)
        assert 199.0 < most[0] <= 200.0
        assert 99.0 < most[1] <= 100.0

    @pytest.mark.parametrize("seed", range(4))
    def test_whatever_is_lost_goes_blind_or_changes_hands_it_stays_inside_and_slow(self, scene, seed):
        chance = random.Random(seed)
        here = scene(at=(190.0, -90.0), fence=FENCE, lost=0.2)
        rover, far, fastest = here.rover, [0.0, 0.0], [0.0]
        wanted = [(5.0, -5.0)]

        def go():
            if chance.random() < 0.03:
                rover.mute, rover.blind = chance.random() < 0.3, chance.random() < 0.3
                rover.mode = words.ROVER_MODE_MANUAL if chance.random() < 0.1 else words.ROVER_MODE_GUIDED
            if chance.random() < 0.05:
                wanted[0] = (chance.uniform(-3.0, 9.0), chance.uniform(-9.0, 3.0))
            if chance.random() < 0.9:
                with suppress(UnreadyError):
                    here.body.go(*wanted[0])
            far[:] = (max(most, abs(at)) for most, at in zip(far, here.place, strict=True))
            fastest[0] = max(fastest[0], here.speed)

        here.hand.run(120.0, go)
        assert far[0] <= 200.0
        assert far[1] <= 100.0
        assert max(far[0] - 200.0, far[1] - 100.0) > -3.0  # it did try
        assert 1.0 < fastest[0] <= 2.001

    def test_from_outside_it_comes_back(self, scene):
        here = scene(at=(203.0, -104.0))
        here.hand.run(6.0, lambda: here.body.go(2.0, -2.0))
        x, y = here.place
        assert abs(x) <= 200.0
        assert abs(y) <= 100.0

    def test_far_outside_it_is_left_to_people(self, scene):
        here = scene()
        here.rover.lon, here.rover.lat = here.frame.geographic(0.0, 5000.0)
        here.hand.run(1.0)
        with pytest.raises(UnreadyError, match="4900 m outside the fence"):
            here.body.read()
        with pytest.raises(UnreadyError, match="4900 m outside the fence"):
            here.body.go(0.0, -1.0)
        assert here.rover.setpoint == (0.0, 0.0)
