"""A report as bytes: nothing is lost on the way, and what is damaged is refused."""

import math
import struct
import zlib

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shoal.core.errors import MessageError
from shoal.core.messages import ENVELOPE_BYTES, REPORT_BYTES, Report
from shoal.core.wire import told_class, wire_bytes, wire_dtype
from shoal.metrics.contract import Facts

NUMBERS = st.floats(allow_nan=False, allow_infinity=False)
FIELDS = ("sighting_x", "sighting_time")


def reports(told=()):
    return st.builds(
        Report,
        st.integers(0, 2**32 - 1),
        *[NUMBERS] * 4,
        st.booleans(),
        st.tuples(*[NUMBERS] * len(told)).map(lambda values: told_class(told)(*values)),
        NUMBERS,
        st.none(),
    )


def a_report(**changes):
    return Report(7, 1.5, -2.0, 0.25, 1e-3, True, told_class(FIELDS)(3.0, 0.5), 12.5)._replace(**changes)


def problem_of(data, told=FIELDS):
    with pytest.raises(MessageError) as caught:
        Report.from_bytes(data, told)
    return caught.value.args[1]


class TestThereAndBack:
    """Every bit."""

    @given(report=reports(FIELDS))
    def test_with_fields_told(self, report):
        assert Report.from_bytes(report.to_bytes(), FIELDS) == report

    @given(report=reports())
    def test_with_none(self, report):
        back = Report.from_bytes(bytearray(report.to_bytes()))
        assert back == report
        assert struct.pack("<d", back.x) == struct.pack("<d", report.x)  # -0.0 too

    def test_of_a_log_in_one_go(self):
        log = b"".join(a_report(id=number, x=number / 3).to_bytes() for number in range(5))
        rows = np.frombuffer(log, wire_dtype(FIELDS))
        assert rows["id"].tolist() == list(range(5))
        assert rows["x"].tolist() == [number / 3 for number in range(5)]
        assert rows["told"]["sighting_time"].tolist() == [0.5] * 5
        assert (rows["on_target"] == 1).all()

    def test_the_rank_is_the_listener_s_and_stays_at_home(self):
        assert Report.from_bytes(a_report(rank=3).to_bytes(), FIELDS).rank is None


class TestSize:
    """The metric counts what reports say; sending one takes 13 bytes more."""

    def test_is_50_and_8_for_each_field_told(self):
        assert [wire_bytes(told) for told in range(3)] == [50, 58, 66]
        assert len(a_report().to_bytes()) == wire_dtype(FIELDS).itemsize == 66
        assert len(a_report(told=()).to_bytes()) == wire_dtype().itemsize == 50

    def test_is_what_the_metric_counts_and_the_envelope(self):
        assert wire_bytes(0) == REPORT_BYTES + ENVELOPE_BYTES
        assert Facts._field_defaults["report_bytes"] == REPORT_BYTES


class TestDamage:
    """One sentence."""

    @given(report=reports(FIELDS), bit=st.integers(0, 66 * 8 - 1))
    def test_of_any_single_bit_is_noticed(self, report, bit):
        data = bytearray(report.to_bytes())
        data[bit // 8] ^= 1 << bit % 8
        assert "damaged" in problem_of(bytes(data))

    @pytest.mark.parametrize("size", [0, 1, 49, 50, 65, 67])
    def test_too_few_or_too_many_bytes(self, size):
        data = (a_report().to_bytes() + b"x")[:size]
        assert problem_of(data) == f"has {size} bytes, but one with sighting_x, sighting_time has 66"

    def test_another_version(self):
        body = bytes([2]) + a_report().to_bytes()[1:-4]
        assert problem_of(body + struct.pack("<I", zlib.crc32(body))) == (
            "is of version 2 of the format, this is version 1"
        )

    def test_what_is_no_bytes(self):
        assert problem_of("text") == "is str, not bytes"

    @pytest.mark.parametrize("name", ["time", "x", "vy"])
    def test_numbers_that_are_not_finite_are_neither_sent_nor_read(self, name):
        with pytest.raises(MessageError, match="not finite"):
            a_report(**{name: math.nan}).to_bytes()
        data = a_report().to_bytes()
        body = data[:5] + struct.pack("<d", math.inf) + data[13:-4]
        assert "not finite" in problem_of(body + struct.pack("<I", zlib.crc32(body)))

    @pytest.mark.parametrize("number", [-1, 2**32])
    def test_an_id_that_does_not_fit(self, number):
        with pytest.raises(MessageError, match="32 bits"):
            a_report(id=number).to_bytes()
