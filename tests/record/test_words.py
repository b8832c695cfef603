"""Numbers in words: as fine as their interval, in one style."""

import pytest

from shoal.record.statistics import Estimate
from shoal.record.words import difference_text, estimate_text, interval_text, mean_text, told

NAN = float("nan")


@pytest.mark.parametrize(
    ("mean", "low", "high", "text"),
    [
        (0.8234, 0.7291, 0.9184, "0.823 [0.729, 0.918]"),
        (0.83159, 0.82723, 0.83588, "0.8316 [0.8272, 0.8359]"),
        (1394.2, 1365.3, 1423.6, "1,394 [1,365, 1,424]"),
        (123456.0, 121000.0, 126000.0, "123,500 [121,000, 126,000]"),  # to hundreds: its interval tells no more
        (0.8, 0.01, 58.8, "1 [0, 59]"),
        (0.00001234, 0.00001, 0.00002, "0.000012 [0.000010, 0.000020]"),
        (-0.061, -0.077, -0.045, "−0.061 [−0.077, −0.045]"),
        (-0.001, -0.2, 0.2, "0.00 [−0.20, 0.20]"),  # no negative zero
        (0.5, 0.5, 0.5, "0.500 [0.500, 0.500]"),
        (0.81234, None, None, "0.812"),
        (12345.678, None, None, "12,346"),
        (200.0, None, None, "200"),
        (0.0, None, None, "0"),
        (NAN, None, None, "unknown"),
        (NAN, 0.1, 0.2, "unknown"),
        (0.5, NAN, NAN, "0.500"),
    ],
)
def test_digits_follow_the_interval(mean, low, high, text):
    assert told(mean, low, high) == text


def test_an_estimate_is_its_mean_and_its_interval():
    value = Estimate(1394.2, (1365.3, 1423.6), (1.0, 2.0))
    assert estimate_text(value) == f"{mean_text(value)} {interval_text(value)}" == "1,394 [1,365, 1,424]"
    assert estimate_text(value, "\u2009") == "1\u2009394 [1\u2009365, 1\u2009424]"


def test_no_interval_is_nothing():
    assert interval_text(Estimate(1.0, None, (1.0, 1.0))) == ""


@pytest.mark.parametrize(
    ("numbers", "text"),
    [
        ((0.139, 0.117, 0.161), "+0.139 [0.117, 0.161]"),
        ((-0.06, None, None), "−0.0600"),
        ((0.0, None, None), "0"),
        ((0.0001, -0.2, 0.2), "0.00 [−0.20, 0.20]"),
    ],
)
def test_a_difference_has_a_sign(numbers, text):
    assert difference_text(*numbers) == text
