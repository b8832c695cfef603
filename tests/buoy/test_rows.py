"""Reports read and written many at once are those read and written one by one; the nearest are the nearest."""

import zlib

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from shoal.buoy.neighbors import link_nearest
from shoal.buoy.rows import read, report_of, row_of, table, write
from shoal.compiler.kernel import plain
from shoal.core.errors import MessageError
from shoal.core.messages import Report
from shoal.core.wire import told_class

FIELDS = ("sighting_x", "sighting_time")
NUMBERS = st.floats(allow_nan=False, allow_infinity=False)


def report(id, told=(), **changes):
    return Report(id, 1.5, -2.0, 0.25, 1e-3, id % 2 == 0, told_class(FIELDS[: len(told)])(*told), 12.5, **changes)


@given(st.lists(st.tuples(st.integers(0, 2**32 - 1), *[NUMBERS] * 7, st.booleans()), max_size=5))
def test_there_and_back(drawn):
    said = [
        Report(id, *motion, on, told_class(FIELDS)(*told), time)
        for id, *motion, time, a, b, on in drawn
        for told in [(a, b)]
    ]
    numbers, sound = read([each.to_bytes() for each in said], FIELDS)
    assert sound.all()
    assert [report_of(row, FIELDS) for row in numbers.tolist()] == said
    assert numbers.tobytes() == b"".join(map(row_of, said))  # -0.0 too
    assert write(numbers, FIELDS) == [each.to_bytes() for each in said]
    assert table([row_of(each) for each in said], FIELDS).shape == (len(said), 9)


@given(st.integers(0, 49), st.integers(0, 7), st.integers(0, 50))
def test_what_is_damaged_for_one_is_so_among_many(place, bit, length):
    flipped = bytearray(report(3).to_bytes())
    flipped[place] ^= 1 << bit
    messages = [
        report(1).to_bytes(),
        bytes(flipped),
        report(2).to_bytes()[:length],
        bytes(50),
        b"",
        report(4).to_bytes(),
    ]
    numbers, sound = read(messages, ())
    for data, its, is_sound in zip(messages, numbers, sound.tolist(), strict=True):
        assert is_sound == is_report(data)
        assert is_sound or not its.any()


def test_so_is_one_of_another_version_or_with_what_is_no_number():
    version, nan = (
        bytearray(report(1).to_bytes()[:-4]),
        report(1).to_bytes()[:-4].replace(np.float64(1.5).tobytes(), np.float64(np.nan).tobytes()),
    )
    version[0] = 2
    messages = [body + zlib.crc32(body).to_bytes(4, "little") for body in (bytes(version), nan)]
    assert not any(map(is_report, messages))
    assert not read(messages, ())[1].any()


def is_report(data):
    try:
        Report.from_bytes(data)
    except MessageError:
        return False
    return True


@given(st.integers(0, 12), st.integers(0, 2**32), st.booleans())
def test_the_nearest_that_reach_a_listener_ties_to_the_first(speakers, seed, limited):
    chance = np.random.default_rng(seed)
    numbers = chance.integers(0, 3, (speakers, 5)).astype(float)  # many are as near as others
    ids, readings, most = np.array([0, 5, 99]), chance.integers(0, 3, (3, 8)).astype(float), chance.integers(0, 6, 3)
    reaches = chance.random((3, speakers)) < 0.7 if limited else np.ones((0, 0), bool)
    near = np.full((3, min(int(most.max()), speakers), 2), -1)
    plain(link_nearest)(near, ids, readings, np.arange(speakers), numbers, most, reaches)
    for n, id in enumerate(ids.tolist()):
        square = ((numbers[:, :2] - readings[n, :2]) ** 2).sum(axis=1)
        others = [m for m in range(speakers) if m != id and (not limited or reaches[n, m])]
        ranked = sorted(others, key=lambda m: (square[m], m))[: most[n]]
        assert near[n][near[n, :, 0] >= 0].tolist() == [[m, ranked.index(m)] for m in sorted(ranked)]
        assert (near[n, len(ranked) :] == -1).all()
