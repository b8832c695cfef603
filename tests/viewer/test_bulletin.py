"""A bulletin comes out of its bytes as it went in, and nothing else comes out of others."""

import random

import pytest

from bulletins import FRAMES, SCENE, bulletin
from shoal.core.errors import MessageError
from shoal.viewer.bulletin import Bulletin, bulletins
from shoal.viewer.frame import places_of


@pytest.mark.parametrize("others", [{}, {"frame": b"", "busy": "5 buoys start"}, {"origin": None, "speed": None}])
def test_it_comes_back(others):
    sent = bulletin(**others)
    back = Bulletin.from_bytes(sent.to_bytes())
    assert (back.origin, back.speed, back.busy, back.frame) == (sent.origin, sent.speed, sent.busy, sent.frame)
    assert back.scene["fleets"] == SCENE["fleets"]
    assert back.step == (0 if not sent.frame else FRAMES.step[0])


def test_it_says_where_everybody_is():
    places = Bulletin.from_bytes(bulletin(2).to_bytes()).places
    for name in ("x", "y", "vx", "vy", "target_x", "target_y"):
        assert getattr(places, name) == pytest.approx(getattr(FRAMES, name)[2:3], rel=1e-6)
    for name in ("step", "alive", "on_target", "target_present"):
        assert getattr(places, name).tolist() == getattr(FRAMES, name)[2:3].tolist()


class TestNoise:
    def test_one_that_is_cut_short_is_refused(self):
        whole = bulletin().to_bytes()
        frame = len(whole) - len(bulletin().frame)
        for size in (0, 1, 4, 5, 20, frame - 1, frame + 1, len(whole) - 1):
            with pytest.raises(MessageError, match="says what cannot be read"):
                Bulletin.from_bytes(whole[:size])

    def test_one_of_another_version_is_refused(self):
        with pytest.raises(MessageError, match="format 9"):
            Bulletin.from_bytes(b"\x09" + bulletin().to_bytes()[1:])

    def test_a_frame_of_another_scene_is_refused(self):
        other = {**SCENE, "targets": []}
        with pytest.raises(MessageError, match="not of its scene"):
            Bulletin.from_bytes(bulletin(scene=other).to_bytes())

    def test_bytes_of_chance_raise_nothing_else(self):
        chance, whole = random.Random(1), bulletin().to_bytes()
        for _ in range(300):
            damaged = bytearray(whole)
            for _ in range(chance.randrange(1, 5)):
                damaged[chance.randrange(len(whole))] = chance.randrange(256)
            for data in (bytes(damaged), chance.randbytes(chance.randrange(200))):
                try:
                    Bulletin.from_bytes(data)
                except MessageError:
                    continue

    def test_a_frame_that_claims_to_be_huge_is_refused(self):
        huge = bytearray(bulletin().frame)
        huge[8:12] = b"\xff" * 4  # agents
        with pytest.raises(MessageError, match="cannot be read"):
            places_of(bytes(huge))

    def test_a_watcher_goes_on_past_it(self):
        messages = [b"noise", None, bulletin().to_bytes()]

        class Lookout:
            over = property(lambda self: not messages)

            def next(self, timeout):
                return messages.pop(0)

        assert [each and each.step for each in bulletins(Lookout(), 0.0)] == [None, 0]
