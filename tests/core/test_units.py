"""Units at the door: words become SI, numbers are SI already."""

import math
import re
from typing import Annotated

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import BaseModel, TypeAdapter, ValidationError

from shoal.core.units import (
    Degrees,
    DegreesPerSecond,
    Kilograms,
    Meters,
    MetersPerSecond,
    MetersPerSecondSquared,
    Seconds,
    Share,
    Unit,
)


def read(kind, value):
    return TypeAdapter(kind).validate_python(value)


class TestWords:
    """A number, a unit, any spaces."""

    @pytest.mark.parametrize(
        ("kind", "text", "value"),
        [
            (Meters, "5 m", 5.0),
            (Meters, "2 km", 2000.0),
            (Meters, "1 nmi", 1852.0),
            (Meters, "1 NM", 1852.0),
            (Meters, "10 ft", 3.048),
            (MetersPerSecond, "2.6 m/s", 2.6),
            (MetersPerSecond, "3600 kn", 1852.0),
            (MetersPerSecond, "5 kt", 5 * 1852 / 3600),
            (MetersPerSecond, "36 km/h", 10.0),
            (Seconds, "90 s", 90.0),
            (Seconds, "2 min", 120.0),
            (Seconds, "1.5 h", 5400.0),
            (Seconds, "1 d", 86400.0),
            (Kilograms, "7.4 kg", 7.4),
            (Kilograms, "2 t", 2000.0),
            (MetersPerSecond, "3600 knots", 1852.0),
            (MetersPerSecondSquared, "0.5 m/s^2", 0.5),
            (MetersPerSecondSquared, "0.5 m/s2", 0.5),
            (MetersPerSecondSquared, "3600 kn/s", 1852.0),
            (DegreesPerSecond, "15 deg/s", 15.0),
            (DegreesPerSecond, f"{math.pi} rad/s", 180.0),
            (DegreesPerSecond, "900 deg/min", 15.0),
            (Share, "10 %", 0.1),
            (Share, "10%", 0.1),
            (Degrees, "20 deg", 20.0),
            (Degrees, f"{math.pi} rad", 180.0),
        ],
    )
    def test_are_converted(self, kind, text, value):
        assert read(kind, text) == pytest.approx(value, rel=1e-15)

    @pytest.mark.parametrize("text", ["5kn", "5  kn", "5\tkn", "5.0 kn", "+5 kn", "5e0 kn", "0.5e1 kn"])
    def test_may_be_written_in_many_ways(self, text):
        assert read(MetersPerSecond, text) == pytest.approx(5 * 1852 / 3600)

    @pytest.mark.parametrize(
        "text",
        [
            *("kn", "", "5", "five kn", "5 m", "5 kn kn", "5 KN", "5 kn/h", "1.2.3 kn", "5 kn^2", "0x5 kn", "5 %"),
            *(" 5 kn", "5 kn ", "5 kn\n", "1_0 kn", "\u0665 kn", "5\u00a0kn"),
        ],
    )
    def test_that_are_no_speed_are_refused_with_the_units_there_are(self, text):
        with pytest.raises(ValidationError, match="m/s, kn, kt, km/h"):
            read(MetersPerSecond, text)

    @given(value=st.floats(-1e12, 1e12).filter(lambda value: value == 0 or abs(value) >= 1e-30))
    def test_in_si_are_numbers(self, value):
        assert read(Meters, f"{value!r} m") == read(Meters, value) == value

    def test_of_another_kind_are_named_by_what_is_wanted(self):
        for kind, text, wanted in (
            (MetersPerSecondSquared, "0.5 kn", "m/s^2, m/s2"),
            (DegreesPerSecond, "15 deg", "deg/s, rad/s"),
            (Share, "5 m", "is not a share; write a number, or one with a unit: %"),
        ):
            with pytest.raises(ValidationError, match=re.escape(wanted)):
                read(kind, text)

    def test_a_long_text_does_not_come_back_whole(self):
        with pytest.raises(ValidationError) as caught:
            read(Meters, "x" * 100_000)
        assert len(caught.value.errors()[0]["msg"]) < 400

    def test_keep_their_sign(self):
        assert read(Meters, "-3 km") == -3000.0


class TestNumbers:
    """Pass unchanged."""

    @pytest.mark.parametrize("value", [0, 1, 2.5, -3.0, 1e12, 1e-30])
    def test_are_taken_as_si(self, value):
        assert read(Meters, value) == value

    @pytest.mark.parametrize("value", [1.1e12, -1e300, 10**400, "1e10 km"])
    def test_too_large_to_be_squared_are_refused(self, value):
        with pytest.raises(ValidationError, match=r"beyond all quantities at sea; write 1e\+12 m at most"):
            read(Meters, value)

    @pytest.mark.parametrize("value", [1e-31, -5e-324, "1e-40 km"])
    def test_too_small_to_be_squared_are_nothing(self, value):
        assert read(Meters, value) == 0.0

    @pytest.mark.parametrize("value", [None, [1.0], {"m": 1}, object()])
    def test_nothing_else_is_a_quantity(self, value):
        with pytest.raises(ValidationError):
            read(Meters, value)


class TestSchema:
    """What JSON Schema says of a quantity."""

    def test_a_number_or_text_with_the_unit_beside(self):
        class Part(BaseModel):
            speed: Annotated[float, Unit("m/s")]

        field = Part.model_json_schema()["properties"]["speed"]
        assert [each["type"] for each in field["anyOf"]] == ["number", "string"]
        assert field["unit"] == "m/s"
