"""The few words of MAVLink that a buoy knows, and how it reads them among others and noise."""

import random

import pytest

pytest.importorskip("pymavlink", reason="pymavlink is not installed: pip install '.[mavlink]'")

from pymavlink.dialects.v20 import ardupilotmega as words

from shoal.buoy import mavlink
from shoal.buoy.mavlink import Answer, Fix, Heartbeat, Mavlink, Notice

BOAT = Heartbeat(1, 1, mavlink.BOAT, mavlink.ARDUPILOT, mavlink.GUIDED, True)


def said(message, system=1):
    return message.pack(words.MAVLink(None, system, 1))


def read(data):
    line = words.MAVLink(None)
    (message,) = line.parse_buffer(data)
    return message


HEARTBEAT = said(words.MAVLink_heartbeat_message(11, 3, 129, 15, 4, 3))
POSITION = said(words.MAVLink_global_position_int_message(61500, 604000001, -53000002, 0, 0, 123, -45, 0, 65535))


class TestNumbers:
    """Those of pymavlink, which makes them from MAVLink's definitions."""

    @pytest.mark.parametrize(
        ("ours", "name"),
        [
            ("ROVER", "MAV_TYPE_GROUND_ROVER"),
            ("BOAT", "MAV_TYPE_SURFACE_BOAT"),
            ("ARDUPILOT", "MAV_AUTOPILOT_ARDUPILOTMEGA"),
            ("NO_AUTOPILOT", "MAV_AUTOPILOT_INVALID"),
            ("ONBOARD_COMPUTER", "MAV_COMP_ID_ONBOARD_COMPUTER"),
            ("ONBOARD_CONTROLLER", "MAV_TYPE_ONBOARD_CONTROLLER"),
            ("LOCAL_NED", "MAV_FRAME_LOCAL_NED"),
            ("ARMED", "MAV_MODE_FLAG_SAFETY_ARMED"),
            ("CUSTOM_MODE", "MAV_MODE_FLAG_CUSTOM_MODE_ENABLED"),
            ("SET_MODE", "MAV_CMD_DO_SET_MODE"),
            ("ARM", "MAV_CMD_COMPONENT_ARM_DISARM"),
            ("SET_INTERVAL", "MAV_CMD_SET_MESSAGE_INTERVAL"),
            ("POSITION", "MAVLINK_MSG_ID_GLOBAL_POSITION_INT"),
            ("HOLD", "ROVER_MODE_HOLD"),
            ("GUIDED", "ROVER_MODE_GUIDED"),
        ],
    )
    def test_are_those_of_the_standard(self, ours, name):
        assert getattr(mavlink, ours) == getattr(words, name)

    def test_modes_have_their_names(self):
        assert {
            number: entry.name.removeprefix("ROVER_MODE_")
            for number, entry in words.enums["ROVER_MODE"].items()
            if not entry.name.endswith("END")
        } == mavlink.MODES


class TestHeard:
    def test_what_a_vehicle_says(self):
        line = Mavlink()
        assert line.heard(HEARTBEAT) == [BOAT]
        (fix,) = line.heard(POSITION)
        assert fix == pytest.approx(Fix(1, -5.3000002, 60.4000001, -0.45, 1.23, 61.5))
        assert line.heard(said(words.MAVLink_command_ack_message(400, 4))) == [Answer(1, 400, 4)]
        text = b"Arm: Bad AHRS"
        assert line.heard(said(words.MAVLink_statustext_message(3, text))) == [Notice(1, "Arm: Bad AHRS")]

    def test_who_does_not_know_where_it_is_says_nothing(self):
        nowhere = words.MAVLink_global_position_int_message(0, 0, 0, 0, 0, 0, 0, 0, 0)
        beyond = words.MAVLink_global_position_int_message(0, 910000000, 0, 0, 0, 0, 0, 0, 0)
        assert Mavlink().heard(said(nowhere)) == Mavlink().heard(said(beyond)) == []

    def test_messages_of_others_and_of_ardupilot_alone_are_passed_over(self):
        line = Mavlink()
        others = said(words.MAVLink_ekf_status_report_message(0, 0, 0, 0, 0, 0)) + said(
            words.MAVLink_ping_message(1, 2, 0, 0)
        )
        assert line.heard(others + HEARTBEAT) == [BOAT]

    def test_mavlink_1_is_read_too(self):
        first = words.MAVLink_heartbeat_message(11, 3, 129, 15, 4, 3).pack(
            words.MAVLink(None, 1, 1), force_mavlink1=True
        )
        assert first[0] == 0xFE
        assert Mavlink().heard(first) == [BOAT]

    def test_a_stream_may_come_in_any_pieces(self):
        line, data, found = Mavlink(whole=False), HEARTBEAT + b"noise" + POSITION + HEARTBEAT, []
        for at in range(len(data)):
            found += line.heard(data[at : at + 1])
        assert [type(each) for each in found] == [Heartbeat, Fix, Heartbeat]

    def test_a_datagram_cut_off_spoils_no_other(self):
        line = Mavlink()
        assert line.heard(b"\xfd\xff" + bytes(20)) == []  # a message of 255 bytes begins
        assert line.heard(HEARTBEAT) == [BOAT]

    def test_of_noise_nothing_is_understood_and_nothing_raises(self):
        chance = random.Random(7)
        for whole in (True, False):
            line = Mavlink(whole=whole)
            for _ in range(2000):
                assert (
                    line.heard(chance.choice((b"", b"\xfd", b"\xfe")) + chance.randbytes(chance.randrange(300))) == []
                )
            assert line.damaged > 1000


class TestSaid:
    def test_a_velocity_is_north_and_east_with_all_else_ignored(self):
        message = read(Mavlink().velocity(BOAT, 0.5, -1.5))
        assert (message.vx, message.vy, message.vz) == (-1.5, 0.5, 0.0)
        assert (message.target_system, message.target_component, message.coordinate_frame) == (1, 1, 1)
        assert message.type_mask == 0x0DC7

    @pytest.mark.parametrize("velocity", [(0.0, 0.0), (0.005, -0.005)])
    def test_next_to_none_is_a_standstill_without_a_turn(self, velocity):
        message = read(Mavlink().velocity(BOAT, *velocity))
        assert (message.vx, message.vy, message.yaw_rate, message.type_mask) == (0.0, 0.0, 0.0, 0x05C7)

    def test_the_buoy_is_a_controller_on_board_and_numbers_what_it_says(self):
        line = Mavlink(5)
        first, second = read(line.heartbeat()), read(line.heartbeat())
        assert (first.type, first.get_srcSystem(), first.get_srcComponent()) == (18, 5, 191)
        assert (first.get_seq(), second.get_seq()) == (0, 1)


def test_a_key_is_that_of_ground_stations():
    assert mavlink.key_of("abc").hex().startswith("ba7816bf8f01cfea")  # SHA-256, FIPS 180-4, B.1
