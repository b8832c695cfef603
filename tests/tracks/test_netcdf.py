"""Specification of reading NetCDF."""

import numpy as np
import pytest

from shoal.tracks.read import read_track
from track_files import DEGREE, eastward, refusal

YEAR_ONE_TO_2020 = (737_424 + 2) * 86_400  # [s]; CF's year 1 is Julian, 2 days earlier


class TestNetcdf:
    """CF trajectories: one, a rectangle of them, or ragged."""

    @pytest.fixture
    def netcdf(self, tmp_path):
        netcdf4 = pytest.importorskip("netCDF4")
        path = tmp_path / "track.nc"

        def make(dimensions, **variables):
            """Each variable: (dimensions, values, attributes)."""
            with netcdf4.Dataset(path, "w") as dataset:
                for name, size in dimensions.items():
                    dataset.createDimension(name, size)
                for name, (over, values, attributes) in variables.items():
                    values = np.ma.asarray(values)
                    kind = str if values.dtype.kind == "U" else values.dtype
                    fill = attributes.pop("_FillValue", None)
                    variable = dataset.createVariable(name, kind, over, fill_value=fill)
                    variable.setncatts(attributes)
                    variable[...] = np.asarray(values, object) if kind is str else values
            return path

        return make

    UNITS = "seconds since 2020-01-01 00:00:00"

    def lat(self, over, values, **more):
        return over, np.ma.asarray(values, float), {"standard_name": "latitude", **more}

    def lon(self, over, values, **more):
        return over, np.ma.asarray(values, float), {"standard_name": "longitude", **more}

    def time(self, over, values, units=UNITS, **more):
        return over, np.ma.asarray(values), {"standard_name": "time", "units": units, **more}

    def single(self, netcdf, **changes):
        variables = {
            "lat": self.lat(["obs"], [0.0, 0.0, 0.0]),
            "lon": self.lon(["obs"], [0.0, 0.001, 0.002]),
            "time": self.time(["obs"], [0.0, 60.0, 120.0]),
        }
        return netcdf({"obs": 3}, **{**variables, **changes})

    def test_one_trajectory_is_read(self, netcdf):
        track = read_track(self.single(netcdf))
        assert track.time.tolist() == [0.0, 60.0, 120.0]
        assert track.start == "2020-01-01T00:00:00Z"
        assert track.x == pytest.approx([-0.001 * DEGREE, 0.0, 0.001 * DEGREE], rel=1e-3)
        assert track.notes == ()

    def test_the_same_path_in_csv_has_the_same_digest(self, netcdf, tmp_path):
        assert read_track(self.single(netcdf)).digest == read_track(eastward(tmp_path, [0.0, 0.001, 0.002])).digest

    def test_variables_are_found_by_standard_name_units_or_name(self, netcdf):
        path = netcdf(
            {"obs": 2},
            status=(["obs"], np.array([1, 2]), {}),
            a=(["obs"], np.array([1.0, 1.0]), {"units": "degrees_north"}),
            b=(["obs"], np.array([2.0, 2.0]), {"standard_name": "longitude"}),
            time=(["obs"], np.array([0, 60]), {"units": self.UNITS}),
        )
        assert read_track(path).origin == (2.0, 1.0)

    def test_the_name_decides_between_two_with_the_same_units(self, netcdf):
        north = {"units": "degrees_north"}
        path = self.single(
            netcdf,
            deploy_lat=([], np.array(7.0), dict(north)),
            lat=(["obs"], np.array([1.0, 1.0, 1.0]), dict(north)),
        )
        assert read_track(path).origin[1] == 1.0

    def test_a_missing_variable_is_named_with_those_there(self, netcdf):
        path = netcdf({"obs": 2}, foo=(["obs"], np.array([1.0, 1.0]), {}))
        _, problem, fix = refusal(path)
        assert "standard_name latitude" in problem
        assert "it has foo" in problem
        assert "standard_name = 'latitude'" in fix

    @pytest.mark.parametrize(
        ("units", "values"),
        [
            ("days since 2020-01-01", [0.0, 1 / 1440, 2 / 1440]),
            ("hours since 2020-01-01T02:00:00+02:00", [0.0, 1 / 60, 2 / 60]),
            ("minutes since 2019-12-31 23:00", [60, 61, 62]),
            ("milliseconds since 2020-01-01", [0, 60_000, 120_000]),
            ("nanoseconds since 2020-01-01 00:00:00.000000000", [0, 60 * 10**9, 120 * 10**9]),
            ("seconds since 0001-01-01", [YEAR_ONE_TO_2020 + i * 60 for i in range(3)]),
            ("s since 1970-01-01", [1577836800, 1577836860, 1577836920]),
        ],
    )
    def test_time_units_are_decoded(self, netcdf, units, values):
        track = read_track(self.single(netcdf, time=self.time(["obs"], values, units)))
        assert track.start == "2020-01-01T00:00:00Z"
        assert track.time.tolist() == [0.0, 60.0, 120.0]

    @pytest.mark.parametrize(
        ("units", "more", "words"),
        [
            ("seconds", {}, "not a time that was recorded"),
            ("fortnights since 2020-01-01", {}, "not a time that was recorded"),
            (UNITS, {"calendar": "noleap"}, "calendar 'noleap'"),
            ("seconds since yesterday", {}, "'yesterday' cannot be read"),
        ],
    )
    def test_a_time_that_cannot_be_decoded_is_refused(self, netcdf, units, more, words):
        time = self.time(["obs"], [0, 60, 120], units, **more)
        where, problem, _ = refusal(self.single(netcdf, time=time))
        assert where.endswith("track.nc time")
        assert words in problem

    def test_a_grid_is_refused_with_its_dimensions(self, netcdf):
        path = netcdf(
            {"lat": 2, "lon": 2, "time": 2},
            lat=self.lat(["lat"], [0, 1]),
            lon=self.lon(["lon"], [0, 1]),
            time=self.time(["time"], [0, 60]),
        )
        _, problem, _ = refusal(path)
        assert problem == "lat(lat), lon(lon), time(time) is not a trajectory; is it a grid?"

    def test_a_bad_value_is_named_with_its_index(self, netcdf):
        where, problem, _ = refusal(self.single(netcdf, lat=self.lat(["obs"], [0, 0, 95])))
        assert where.endswith("track.nc[2]")
        assert problem == "lat 95 is outside [-90, 90]"

    @pytest.mark.parametrize("nothing", [np.nan, -9999.0, 9.969209968386869e36])
    def test_nan_or_a_fill_value_that_the_file_does_not_declare_is_missing(self, netcdf, nothing):
        track = read_track(self.single(netcdf, lat=self.lat(["obs"], [0, nothing, 0])))
        assert track.time.tolist() == [0.0, 120.0]
        assert track.notes == ("Fixes dropped because the file marks them missing: 1.",)

    def test_attributes_that_the_library_does_not_use_raise_no_warning(self, netcdf):
        lat = self.lat(["obs"], [0, 0, 0], valid_min="south")
        assert len(read_track(self.single(netcdf, lat=lat)).time) == 3

    def test_a_time_beyond_the_year_9999_is_refused_with_its_index(self, netcdf):
        time = self.time(["obs"], [0.0, 60.0, 1e15])
        where, problem, _ = refusal(self.single(netcdf, time=time))
        assert where.endswith("track.nc[2]")
        assert "is not a Unix time in the years 1 to 9999" in problem

    def test_times_in_32_bits_are_refused_with_the_reason(self, netcdf):
        days = np.array([27000 + i / 1440 for i in range(3)], np.float32)
        path = self.single(netcdf, time=self.time(["obs"], days, "days since 1950-01-01"))
        assert "the times have lost digits" in refusal(path)[1]

    def test_masked_positions_are_dropped_and_noted(self, netcdf):
        lat = self.lat(["obs"], [0, -9, 0], _FillValue=-9.0)
        track = read_track(self.single(netcdf, lat=lat))
        assert track.time.tolist() == [0.0, 120.0]
        assert track.notes == ("Fixes dropped because the file marks them missing: 1.",)

    @pytest.mark.parametrize("all_three", [False, True])
    def test_a_file_of_missing_values_only_is_refused(self, netcdf, all_three):
        nothing = np.ma.masked_all(3)
        changes = {"lat": self.lat(["obs"], nothing)}
        if all_three:
            changes |= {"lon": self.lon(["obs"], nothing), "time": self.time(["obs"], nothing)}
        assert refusal(self.single(netcdf, **changes))[1] in (
            "every fix lacks its time or position",
            "holds no fixes",
        )

    def rectangle(self, netcdf, over=("trajectory", "obs"), **more):
        """Two trajectories of 3 and 2 fixes; masked values fill the second row."""
        fill = -999.0
        lat = np.array([[0.0, 0.0, 0.0], [1.0, 1.0, fill]])
        lon = np.array([[0.0, 0.001, 0.002], [5.0, 5.001, fill]])
        time = np.array([[0.0, 60.0, 120.0], [10.0, 70.0, fill]])
        if over[0] == "obs":
            lat, lon, time = lat.T, lon.T, time.T
        return netcdf(
            {"trajectory": 2, "obs": 3},
            lat=self.lat(over, lat, _FillValue=fill),
            lon=self.lon(over, lon, _FillValue=fill),
            time=self.time(over, time, _FillValue=fill),
            **more,
        )

    IDS = (["trajectory"], np.array(["north", "south"]), {"cf_role": "trajectory_id"})

    def test_a_rectangle_of_several_is_refused_with_an_example(self, netcdf):
        _, problem, fix = refusal(self.rectangle(netcdf))
        assert "holds 2 tracks, told apart by trajectory" in problem
        assert "--track-id trajectory=0 has the most fixes, 3" in fix

    def test_a_row_is_chosen_by_index_and_its_padding_is_no_loss(self, netcdf):
        track = read_track(self.rectangle(netcdf), track_id="trajectory=1")
        assert track.time.tolist() == [0.0, 60.0]
        assert track.origin == (5.0005, 1.0)
        assert track.notes == ()

    @pytest.mark.parametrize("track_id", ["trajectory=south", "trajectory=1", "buoy=south"])
    def test_a_row_is_chosen_by_identifier_index_or_its_variable(self, netcdf, track_id):
        track = read_track(self.rectangle(netcdf, buoy=self.IDS), track_id=track_id)
        assert track.origin == (5.0005, 1.0)

    def test_an_identifier_goes_before_an_index(self, netcdf):
        ids = (["trajectory"], np.array([1, 0]), {"cf_role": "trajectory_id"})
        track = read_track(self.rectangle(netcdf, trajectory=ids), track_id="trajectory=0")
        assert track.origin == (5.0005, 1.0)

    def test_identifiers_may_be_characters(self, netcdf):
        letters = np.array([list("north"), list("so\0\0\0")], dtype="S1")
        path = netcdf(
            {"trajectory": 2, "obs": 2, "letters": 5},
            lat=self.lat(["trajectory", "obs"], [[0, 0], [1, 1]]),
            lon=self.lon(["trajectory", "obs"], [[0, 0], [1, 1]]),
            time=self.time(["obs"], [0, 60]),
            buoy=(["trajectory", "letters"], letters, {"cf_role": "trajectory_id"}),
        )
        assert read_track(path, track_id="buoy=so").origin == (1.0, 1.0)

    def test_an_unknown_trajectory_is_answered_with_the_nearest(self, netcdf):
        path = self.rectangle(netcdf, buoy=self.IDS)
        assert "buoy=south" in refusal(path, track_id="buoy=sooth")[2]
        assert "2 there" in refusal(path, track_id="trajectory=2")[1]

    def test_an_unknown_column_is_answered_with_those_there(self, netcdf):
        path = self.rectangle(netcdf, buoy=self.IDS)
        assert "it has trajectory, buoy" in refusal(path, track_id="mmsi=2")[1]

    def test_a_transposed_rectangle_is_the_same(self, netcdf):
        path = self.rectangle(netcdf, over=("obs", "trajectory"), buoy=self.IDS)
        assert read_track(path, track_id="buoy=south").time.tolist() == [0.0, 60.0]

    @pytest.mark.parametrize("over", [("trajectory", "obs"), ("obs", "trajectory")])
    def test_a_time_shared_by_all_trajectories_is_repeated(self, netcdf, over):
        values = np.array([[0.0, 0.001, 0.002], [5.0, 5.001, 5.002]])
        values = values.T if over[0] == "obs" else values
        path = netcdf(
            {"trajectory": 2, "obs": 3},
            lat=self.lat(over, 0.0 * values),
            lon=self.lon(over, values),
            time=self.time(["obs"], [0, 60, 120]),
        )
        track = read_track(path, track_id="trajectory=1")
        assert track.time.tolist() == [0.0, 60.0, 120.0]
        assert track.origin == (5.001, 0.0)

    def ragged(self, netcdf, **more):
        return netcdf(
            {"trajectory": 2, "obs": 5},
            lat=self.lat(["obs"], [0, 0, 1, 1, 1]),
            lon=self.lon(["obs"], [0.0, 0.001, 5.0, 5.001, 5.002]),
            time=self.time(["obs"], [0, 60, 0, 60, 120]),
            **more,
        )

    SIZES = (["trajectory"], np.array([2, 3]), {"sample_dimension": "obs"})

    def test_contiguous_ragged_trajectories_are_chosen_by_index(self, netcdf):
        track = read_track(self.ragged(netcdf, size=self.SIZES), track_id="trajectory=1")
        assert track.time.tolist() == [0.0, 60.0, 120.0]

    def test_contiguous_ragged_trajectories_are_chosen_by_identifier(self, netcdf):
        path = self.ragged(netcdf, row_size=(*self.SIZES[:2], {}), ID=self.IDS)
        assert read_track(path, track_id="ID=north").time.tolist() == [0.0, 60.0]

    def test_ragged_sizes_that_do_not_add_up_are_refused(self, netcdf):
        sizes = (["trajectory"], np.array([2, 9]), {"sample_dimension": "obs"})
        assert "its sum is 11, but there are 5 fixes" in refusal(self.ragged(netcdf, n=sizes))[1]

    def test_indexed_ragged_trajectories_are_told_apart(self, netcdf):
        index = (["obs"], np.array([0, 0, 1, 1, 1]), {"instance_dimension": "trajectory"})
        path = self.ragged(netcdf, index=index, buoy=self.IDS)
        assert read_track(path, track_id="buoy=north").time.tolist() == [0.0, 60.0]
        assert "--track-id buoy=south" in refusal(path)[2]

    def test_a_ragged_index_beyond_the_trajectories_is_refused(self, netcdf):
        index = (["obs"], np.array([0, 0, 1, 1, 2]), {"instance_dimension": "trajectory"})
        assert "outside the 2 trajectories" in refusal(self.ragged(netcdf, index=index))[1]

    def test_an_identifier_beside_each_fix_tells_trajectories_apart(self, netcdf):
        ids = (["obs"], np.array([7, 7, 8, 8, 8]), {})
        path = self.ragged(netcdf, drifter_id=ids)
        assert read_track(path, track_id="drifter_id=7").time.tolist() == [0.0, 60.0]
        assert "--track-id drifter_id=8" in refusal(path)[2]

    def test_a_single_trajectory_may_carry_its_identifier(self, netcdf):
        ids = ([], np.array(8213480), {"cf_role": "trajectory_id"})
        path = self.single(netcdf, drifter=ids)
        assert len(read_track(path, track_id="drifter=8213480").time) == 3

    def test_what_xarray_writes_is_read(self, tmp_path):
        xarray = pytest.importorskip("xarray")
        pytest.importorskip("netCDF4")
        start = np.datetime64("2020-01-01T00:00:00.218", "ns")
        xarray.Dataset(
            {
                "lat": (("trajectory", "obs"), [[0.0, 0.0], [1.0, np.nan]]),
                "lon": (("trajectory", "obs"), [[0.0, 0.001], [1.0, np.nan]]),
            },
            coords={
                "time": ("obs", start + np.array([0, 60_000_000_000], "m8[ns]")),
                "drifter_id": ("trajectory", ["a", "b"]),
            },
        ).to_netcdf(tmp_path / "xarray.nc")
        track = read_track(tmp_path / "xarray.nc", track_id="drifter_id=a")
        assert track.start == "2020-01-01T00:00:00.218000Z"
        assert track.time.tolist() == [0.0, 60.0]
