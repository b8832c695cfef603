"""Specification of reading times as people write them."""

import numpy as np
import pytest

from shoal.core.errors import TrackError
from shoal.tracks.times import iso, unix_times

NOON = 1_710_072_000.0  # 2024-03-10T12:00:00Z


def read(*texts, **options):
    """Unix times and notes."""
    unix, notes = unix_times(texts, lambda i: f"x.csv:{i + 2}", **{"day_first": None, **options})
    return unix.tolist(), notes


class TestForms:
    """One moment in every form."""

    @pytest.mark.parametrize(
        "text",
        [
            "2024-03-10T12:00:00Z", "2024-03-10 12:00:00", "2024-03-10T12:00Z", "2024-03-10 12:00:00.000000000Z",
            "2024-03-10T14:00:00+02:00", "2024-03-10T14:00:00+0200", "2024-03-10 14:00:00 +0200", "20240310T120000Z",
            "2024-03-10 12:00:00 UTC", "2024-03-10 12:00:00 GMT", "2024-03-10 12:00:00 (UTC)", "2024-03-10 12:00:00UTC",
            "2024-03-10 12:00:00.000000000 +0000 UTC", "20240310_120000", "20240310 120000", "20240310120000",
            "2024/03/10 12:00:00", "2024/3/10 12:00", "2024.03.10 12:00:00", "10.03.2024 12:00:00", "10.3.2024 12:00",
            "10-Mar-2024 12:00:00", "10 March 2024 12:00:00", "10-Mar-24 12:00:00 PM", "Mar 10, 2024 12:00:00 PM",
            "Sun, 10 Mar 2024 12:00:00 GMT", "2024-03-10T12:00:00,000Z",
            "1710072000", "1710072000.0", "1.710072e9", "1710072000000", "1710072000000000", "1710072000000000000",
        ],
    )  # fmt: skip
    def test_it_is_read(self, text):
        assert read(text)[0] == [NOON]

    @pytest.mark.parametrize("text", ["2024-03-10T12:00:00.25Z", "2024-03-10 12:00:00,25", "10.03.2024 12:00:00.250"])
    def test_fractions_count(self, text):
        assert read(text)[0] == [NOON + 0.25]

    def test_the_day_has_two_halves(self):
        assert read("10-Mar-2024 12:30 AM", "10-Mar-2024 1:30 pm")[0] == [NOON - 11.5 * 3600, NOON + 1.5 * 3600]

    @pytest.mark.parametrize("text", ["", " ", "nan", "NaT", "null", "N/A", "-"])
    def test_nothing_is_missing(self, text):
        assert np.isnan(read("2024-03-10T12:00:00Z", text)[0]).tolist() == [False, True]

    @pytest.mark.parametrize(
        "text",
        ["noon", "2024-13-01T00:00:00Z", "1_710_072_000", "2024-03-10T25:00:00Z", "31.02.2024 00:00",
         "10-Foo-2024 12:00", "2024-03-10 13:00 PM", "\u0661710072000", "12:00:00", "inf"],
    )  # fmt: skip
    def test_what_is_no_time_is_named_with_its_line(self, text):
        with pytest.raises(TrackError) as caught:
            read("2024-03-10T12:00:00Z", text)
        assert caught.value.args[0] == "x.csv:3"
        assert "cannot be read" in caught.value.args[1]

    def test_a_number_beyond_the_year_9999_is_refused(self):
        with pytest.raises(TrackError, match="is not a Unix time in the years 1 to 9999"):
            read("1e300", "1e300")


class TestDayAndMonth:
    """10/03/2024 is in March or in October: all lines together tell."""

    def test_a_day_above_12_tells_for_all(self):
        for first, second in (("10/03/2024 12:00", "13/03/2024 12:00"), ("03/10/2024 12:00", "03/13/2024 12:00")):
            assert read(first, second)[0] == [NOON, NOON + 3 * 86_400]

    def test_the_order_that_lets_time_run_on_is_taken(self):
        unix, _ = read("11/03/2024 00:00", "12/03/2024 00:00", "01/04/2024 00:00")
        assert [iso(each)[:10] for each in unix] == ["2024-03-11", "2024-03-12", "2024-04-01"]

    def test_the_choice_is_noted(self):
        assert "Dates such as 13/03/2024 were read as day/month/year." in read("13/03/2024 12:00")[1]

    def test_where_nothing_tells_it_is_asked_for(self):
        with pytest.raises(TrackError, match="may be day/month or month/day") as caught:
            read("10/03/2024 12:00", "10/03/2024 12:01")
        assert "--set targets.0.day_first=true" in caught.value.args[2]

    @pytest.mark.parametrize(("day_first", "date"), [(True, "2024-03-10"), (False, "2024-10-03")])
    def test_it_can_be_said(self, day_first, date):
        assert iso(read("10/03/2024 12:00", day_first=day_first)[0][0])[:10] == date

    def test_what_is_said_must_fit(self):
        with pytest.raises(TrackError, match="cannot be read"):
            read("03/13/2024 12:00", day_first=True)

    def test_a_layout_that_is_known_tells(self):
        assert iso(read("10/03/2024 12:00", layout=True)[0][0])[:10] == "2024-03-10"

    def test_two_orders_in_one_file_are_refused(self):
        with pytest.raises(TrackError, match="another order of day and month"):
            read("13/03/2024 12:00", "03/14/2024 12:00")

    def test_the_same_number_twice_needs_no_question(self):
        assert iso(read("03/03/2024 12:00")[0][0])[:10] == "2024-03-03"
