"""What comes in on a MAVLink line and is no word of the vehicle's: noise, others, late positions, wrong keys."""

import random

import pytest

pytest.importorskip("pymavlink", reason="pymavlink is not installed: pip install '.[mavlink]'")
pytest.importorskip("pyproj", reason="pyproj is not installed: pip install '.[maritime]'")

from pymavlink.dialects.v20 import ardupilotmega as words

from shoal.buoy.errors import BodyError, UnreadyError
from shoal.buoy.mavlink import key_of


class TestNoise:
    """What is no message of the vehicle's changes nothing."""

    def test_garbage_and_damaged_messages_are_counted(self, scene):
        here = scene()
        chance = random.Random(5)
        fix = words.MAVLink_global_position_int_message(0, 1, 1, 0, 0, 0, 0, 0, 0).pack(words.MAVLink(None, 1, 1))

        def shout():
            for _ in range(10):
                damaged = bytearray(fix)
                damaged[chance.randrange(10, len(fix))] ^= 1 << chance.randrange(8)
                for data in (chance.randbytes(chance.randrange(300)), b"\xfd" + chance.randbytes(40), damaged):
                    here.rover.socket.sendto(data, here.rover.to)
            here.body.go(1.0, 0.0)

        here.hand.run(30.0, shout)
        assert here.vehicle.damaged >= 6000
        assert here.place[0] == pytest.approx(29.5, abs=0.2)
        assert here.body.read().x == pytest.approx(29.5, abs=0.4)

    def test_another_vehicle_and_another_address_are_not_heeded(self, scene):
        here = scene()
        intruder, other = here.another((90.0, 0.0)), here.another((90.0, 0.0), system=9)
        for each in (intruder, other):
            each.interval, each.time = 0.2, here.rover.time + 5.0
            here.hand.movers.append(each)
        line = words.MAVLink(None, 9, 1)  # that shares the address of the vehicle, such as behind a router

        def go():
            far = words.MAVLink_global_position_int_message(10**6, 604100000, 53000000, 0, 0, 0, 0, 0, 0)
            here.rover.socket.sendto(far.pack(line), here.rover.to)
            here.body.go(1.0, 0.0)

        here.hand.run(5.0, go)
        assert here.body.read().x == pytest.approx(4.5, abs=0.4)
        assert intruder.setpoints == other.setpoints == []
        assert here.vehicle.ignored > 20

    def test_a_vehicle_whose_address_changed_is_found_again(self, scene):
        here = scene()
        moved = here.another((30.0, 0.0))
        moved.mode, moved.armed = here.rover.mode, True
        here.rover.mute = True
        here.hand.movers[:] = [moved]
        moved.time = here.rover.time
        here.hand.run(8.0)
        here.hand.run(3.0, lambda: here.body.go(1.0, 0.0))
        assert here.body.read().x == pytest.approx(32.5, abs=0.4)

    def test_positions_that_a_slow_line_brings_late_are_as_old_as_they_are(self, scene):
        here = scene()
        here.hand.run(5.0)
        here.rover.delay = 3.0
        here.hand.run(6.0)
        assert here.vehicle.silent(here.hand.now) < 2.0
        with pytest.raises(UnreadyError, match=r"said 3\.\d s ago where it is"):
            here.body.read()
        here.rover.delay, here.rover.queue = 0.0, []
        here.hand.run(1.0)
        assert here.body.read().x == pytest.approx(0.0, abs=0.1)

    def test_clocks_that_go_apart_make_no_position_old(self, scene):
        here = scene()
        for _ in range(300):  # the rover's loses 0.5 ms a second
            here.hand.run(1.0)
            here.rover.time -= 0.0005
        assert here.vehicle.age(here.hand.now) < 0.3

    def test_a_late_position_is_none(self, scene):
        here = scene()
        here.hand.run(5.0)
        ignored, place = here.vehicle.ignored, here.body.read()
        old = words.MAVLink_global_position_int_message(100, 0, 10**9, 0, 0, 0, 0, 0, 0)
        here.rover.say(old)
        here.body.tick()
        assert here.vehicle.ignored == ignored + 1
        assert here.body.read() == place


class TestKey:
    """Signed messages: who has no key is not heard."""

    def signs(self, rover, key):
        rover.line.signing.secret_key, rover.line.signing.sign_outgoing = key, True
        rover.line.signing.timestamp = 10**14  # later than today

    def test_with_one_key_both_hear_each_other(self, scene):
        here = scene(begun=False, key=key_of("sesame"))
        self.signs(here.rover, key_of("sesame"))
        here.body.begin(arm=True)
        here.hand.run(3.0, lambda: here.body.go(1.0, 0.0))
        assert here.speed == pytest.approx(1.0, abs=0.01)

    def test_without_or_with_another_nobody_is_heard(self, scene):
        for key in (None, key_of("salami")):
            here = scene(begun=False, key=key_of("sesame"))
            if key:
                self.signs(here.rover, key)
            with pytest.raises(BodyError, match="no vehicle is heard"):
                here.body.begin(arm=True)
