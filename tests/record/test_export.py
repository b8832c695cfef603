"""Specification of exports: a labelled dataset that says its units, and files that other programs can read."""

import dataclasses
import json
import sys

import numpy as np
import pytest

import shoal
from scenarios import scenario
from shoal.core.errors import MissingExtraError, RecordError
from shoal.metrics.heading_bearing import CENTERS, fleet_stationary, phi_histogram
from shoal.metrics.summary import METRICS, evaluate
from shoal.metrics.velocity_fluctuation import fleet_fluctuation
from shoal.record.export import to_netcdf, to_xarray, to_zarr
from shoal.record.trajectory import Trajectory
from shoal.strategies import CATALOGUE
from shoal.tracks.read import read_track

xarray = pytest.importorskip("xarray")

ORIGIN = (-1.3, 50.8)  # (lon, lat) [deg], in the Solent
STEPS, EVERY, RUNS, AGENTS = 60, 3, 2, 50
FORMATS = ("netcdf", "zarr")


@pytest.fixture(scope="module")
def record():
    """Two recorded runs, nowhere on Earth."""
    return shoal.simulate(scenario(changes={"steps": STEPS}), runs=RUNS, every=EVERY)


@pytest.fixture(scope="module")
def at_sea():
    """The same runs with a place on Earth."""
    return shoal.simulate(scenario(changes={"steps": STEPS, "area.origin": list(ORIGIN)}), runs=RUNS, every=EVERY)


@pytest.fixture(scope="module")
def dataset(record):
    return to_xarray(record)


def without_trajectories(record):
    return dataclasses.replace(record, trajectories={})


def keeping(record, frames_of_run):
    """The record with some frames only: {run: slice of its frames}."""
    kept = {
        run: Trajectory.from_arrays({name: part[frames] for name, part in record.trajectories[run].arrays().items()})
        for run, frames in frames_of_run.items()
    }
    return dataclasses.replace(record, trajectories=kept)


def write(kind, record, path):
    {"netcdf": to_netcdf, "zarr": to_zarr}[kind](record, path)


def read(kind, path, **options):
    pytest.importorskip({"netcdf": "netCDF4", "zarr": "zarr"}[kind])
    opened = xarray.open_dataset(path, **options) if kind == "netcdf" else xarray.open_zarr(path, **options)
    with opened:
        return opened.load()


class TestMetrics:
    """Every number of the record, labelled."""

    def test_the_record_knows_the_way(self, record, dataset):
        assert record.to_xarray().identical(dataset)

    @pytest.mark.parametrize("name", METRICS)
    def test_a_metric_has_a_value_per_run_a_unit_and_a_sentence(self, record, dataset, name):
        assert dataset[name].dims == ("run",)
        np.testing.assert_array_equal(dataset[name].values, record.estimate(name).runs)
        assert dataset[name].attrs["units"]
        assert dataset[name].attrs["long_name"] == METRICS[name].sentence

    def test_numbers_of_agents_and_arena_units_are_pure_numbers_to_other_programs(self, dataset):
        assert dataset.engaged.attrs["units"] == dataset.response.attrs["units"] == "1"

    def test_phi_is_binned_by_run_fleet_and_center(self, record, dataset):
        assert dataset.phi_histogram.dims == ("run", "fleet", "phi_bin")
        assert dataset.phi_bin.values.tolist() == CENTERS.tolist()
        np.testing.assert_array_equal(dataset.phi_histogram, [phi_histogram(tally) for tally in record.tallies])
        np.testing.assert_allclose(dataset.phi_histogram.sum(("fleet", "phi_bin")), AGENTS)

    def test_fleets_have_names_counts_speeds_and_metrics(self, record, dataset):
        assert dataset.fleet.values.tolist() == ["BoB-1", "BoB-0"]
        assert dataset.fleet_count.values.tolist() == [15, 35]
        assert dataset.fleet_max_speed.values.tolist() == [2.6, 1.0]
        for name, formula in (("fleet_xi_raw", fleet_fluctuation), ("fleet_stationary", fleet_stationary)):
            expected = [formula(tally, record.facts) for tally in record.tallies]
            np.testing.assert_array_equal(dataset[name], expected)

    def test_the_fleets_fluctuations_weighted_by_count_are_the_swarms(self, dataset):
        whole = (dataset.fleet_xi_raw * dataset.fleet_count).sum("fleet") / dataset.fleet_count.sum()
        np.testing.assert_allclose(whole, dataset.xi_raw)

    def test_time_on_target_is_there_for_each_batch(self, record, dataset):
        assert dataset.time_on_target_batch.dims == ("run", "batch")
        expected = [evaluate("time_on_target", tally, record.facts)[1] for tally in record.tallies]
        np.testing.assert_array_equal(dataset.time_on_target_batch, expected)

    def test_a_record_without_trajectories_has_metrics_only(self, record, dataset):
        bare = to_xarray(without_trajectories(record))
        assert set(bare.dims) == {"run", "fleet", "phi_bin", "batch"}
        assert "featureType" not in bare.attrs
        for name, values in bare.variables.items():
            assert values.identical(dataset.variables[name])

    def test_no_metric_is_hidden_by_a_trajectory(self, dataset):
        assert [name for name in METRICS if dataset[name].dims != ("run",)] == []

    def test_every_number_has_a_unit(self, at_sea):
        labels = {"run", "batch", "crs", "on_target", "is_engaged", "target_is_present"}
        labels |= {f"{who}_{what}" for who in ("trajectory", "target") for what in ("run", "number")}
        dataset = to_xarray(at_sea)
        silent = {
            name for name, values in dataset.variables.items() if values.dtype.kind in "iuf" and name not in labels
        }
        assert [name for name in sorted(silent) if "units" not in dataset[name].attrs] == []


class TestProvenance:
    """The dataset says where it comes from."""

    def test_scenario_and_provenance_are_kept_in_full(self, record, dataset):
        assert json.loads(dataset.attrs["scenario"]) == record.scenario.model_dump(mode="json")
        assert json.loads(dataset.attrs["provenance"]) == record.provenance

    def test_title_source_and_conventions_are_plain_text(self, record, dataset):
        assert dataset.attrs["title"] == "oceans2020"
        assert record.provenance["versions"]["shoal"] in dataset.attrs["source"]
        assert dataset.attrs["history"].startswith(record.provenance["started"])
        assert dataset.attrs["scenario_hash"] == record.provenance["scenario_hash"]
        assert dataset.attrs["Conventions"] == "CF-1.11"


class TestTrajectories:
    """CF trajectories: one row per agent of a run."""

    def test_each_agent_of_each_recorded_run_is_a_trajectory(self, dataset):
        assert dataset.attrs["featureType"] == "trajectory"
        assert dataset.trajectory_id.attrs["cf_role"] == "trajectory_id"
        assert dataset.sizes["trajectory"] == RUNS * AGENTS
        assert len(set(dataset.trajectory_id.values)) == RUNS * AGENTS
        assert dataset.trajectory_id.values[57] == "run-1/agent-7"
        assert dataset.trajectory_run.values[57] == 1
        assert dataset.trajectory_number.values[57] == 7
        assert dataset.trajectory_fleet.values[[50, 64, 65, 99]].tolist() == ["BoB-1", "BoB-1", "BoB-0", "BoB-0"]

    @pytest.mark.parametrize("name", ["x", "y", "vx", "vy", "on_target"])
    def test_values_are_those_of_the_frames(self, record, dataset, name):
        assert dataset[name].dims == ("trajectory", "obs")
        for run, frames in record.trajectories.items():
            rows = dataset[name].values[dataset.trajectory_run == run]
            np.testing.assert_array_equal(rows.T, getattr(frames, name))

    @pytest.mark.parametrize(
        ("name", "part"), [("target_x", "target_x"), ("target_y", "target_y"), ("target_is_present", "target_present")]
    )
    def test_targets_have_a_dimension_of_their_own(self, record, dataset, name, part):
        assert dataset[name].dims == ("target", "obs")
        assert dataset.target_id.values.tolist() == ["run-0/target-0", "run-1/target-0"]
        for run, frames in record.trajectories.items():
            np.testing.assert_array_equal(dataset[name].values[run], getattr(frames, part)[:, 0])

    def test_time_is_that_of_the_step(self, dataset):
        assert dataset.time.dims == ("obs",)
        assert dataset.step.values.tolist() == list(range(0, STEPS, EVERY))
        np.testing.assert_allclose(dataset.time, 0.1 * dataset.step)
        assert dataset.time.attrs["units"].startswith("seconds since")

    def test_positions_are_projected_meters_and_velocities_meters_per_second(self, dataset):
        for axis in "xy":
            assert dataset[axis].attrs["standard_name"] == f"projection_{axis}_coordinate"
            assert dataset[axis].attrs["units"] == "m"
            assert dataset[f"v{axis}"].attrs["units"] == "m/s"

    def test_what_agents_remember_has_the_units_of_the_strategy(self, record, dataset):
        assert dataset.memory_repulsion.attrs["units"] == "m"
        np.testing.assert_array_equal(
            dataset.memory_repulsion.values[AGENTS:].T, record.trajectories[1].memory["repulsion"]
        )

    def test_memory_of_a_strategy_that_is_not_loaded_has_no_unit(self, record, monkeypatch, tmp_path):
        shoal.save_record(record, tmp_path / "record")
        monkeypatch.delitem(CATALOGUE, "knn-pso")
        assert "units" not in to_xarray(shoal.open_record(tmp_path / "record")).memory_repulsion.attrs

    def test_a_truth_is_a_flag_that_explains_itself(self, dataset):
        assert dataset.on_target.dtype == np.int8
        meanings = dict(
            zip(dataset.on_target.flag_values.tolist(), dataset.on_target.flag_meanings.split(), strict=True)
        )
        assert meanings == {-1: "not_recorded", 0: "off_target", 1: "on_target"}

    def test_only_recorded_runs_have_trajectories(self, record):
        dataset = to_xarray(keeping(record, {1: slice(None)}))
        assert dataset.sizes["run"] == RUNS
        assert set(dataset.trajectory_run.values) == {1}
        np.testing.assert_array_equal(dataset.x.T, record.trajectories[1].x)

    def test_runs_that_kept_other_steps_leave_gaps(self, record):
        dataset = to_xarray(keeping(record, {0: slice(0, 4), 1: slice(2, 6)}))
        assert dataset.step.values.tolist() == [0, 3, 6, 9, 12, 15]
        first = dataset.isel(trajectory=dataset.trajectory_run == 0)
        np.testing.assert_array_equal(first.x.T[:4], record.trajectories[0].x[:4])
        assert np.isnan(first.x.T[4:]).all()
        assert (first.on_target.T[4:] == -1).all()
        assert np.isnan(dataset.target_x.values[1, :2]).all()


class TestPlaceOnEarth:
    """With an origin, positions are longitudes and latitudes too."""

    def test_without_an_origin_there_are_none(self, dataset):
        assert not {"lon", "lat", "target_lon", "target_lat", "crs"} & set(dataset.variables)

    def test_the_projection_is_named(self, at_sea):
        dataset = to_xarray(at_sea)
        assert dataset.crs.attrs["grid_mapping_name"] == "azimuthal_equidistant"
        assert dataset.crs.attrs["longitude_of_projection_origin"] == ORIGIN[0]
        assert dataset.crs.attrs["latitude_of_projection_origin"] == ORIGIN[1]
        assert all(dataset[name].attrs["grid_mapping"] == "crs" for name in ("x", "vy", "target_x", "memory_repulsion"))

    def test_the_projection_written_down_is_the_one_used(self, at_sea):
        pyproj = pytest.importorskip("pyproj")
        dataset = to_xarray(at_sea)
        named = pyproj.CRS.from_cf({key: value for key, value in dataset.crs.attrs.items() if key != "long_name"})
        to_meters = pyproj.Transformer.from_crs(named.geodetic_crs, named, always_xy=True)
        x, y = to_meters.transform(dataset.lon.values, dataset.lat.values)
        np.testing.assert_allclose(x, dataset.x, atol=1e-6)
        np.testing.assert_allclose(y, dataset.y, atol=1e-6)

    def test_agents_and_targets_are_as_far_from_the_origin_on_earth_as_in_the_arena(self, at_sea):
        pyproj = pytest.importorskip("pyproj")
        dataset = to_xarray(at_sea)
        for prefix in ("", "target_"):
            lon, lat = dataset[f"{prefix}lon"].values, dataset[f"{prefix}lat"].values
            there = np.broadcast_to(ORIGIN[0], lon.shape), np.broadcast_to(ORIGIN[1], lon.shape)
            distance = pyproj.Geod(ellps="WGS84").inv(*there, lon, lat)[2]
            np.testing.assert_allclose(distance, np.hypot(dataset[f"{prefix}x"], dataset[f"{prefix}y"]), atol=1e-6)

    def test_frames_that_are_not_there_are_nowhere(self, at_sea):
        pytest.importorskip("pyproj")
        dataset = to_xarray(keeping(at_sea, {0: slice(0, 4), 1: slice(2, 6)}))
        np.testing.assert_array_equal(np.isnan(dataset.lon), np.isnan(dataset.x))
        assert not np.isinf(dataset.lat).any()

    def test_without_pyproj_the_meters_stay(self, at_sea, monkeypatch):
        monkeypatch.setitem(sys.modules, "pyproj", None)
        dataset = to_xarray(at_sea)
        assert "lon" not in dataset.variables
        assert "crs" in dataset.variables


@pytest.mark.parametrize("kind", FORMATS)
class TestFiles:
    """What is written is what was recorded, whole or not at all."""

    def test_everything_comes_back_as_it_was(self, kind, at_sea, tmp_path):
        write(kind, at_sea, tmp_path / "record")
        expected, back = to_xarray(at_sea), read(kind, tmp_path / "record", decode_times=False)
        assert set(back.variables) == set(expected.variables)
        for name, values in expected.variables.items():
            np.testing.assert_array_equal(back[name], values, err_msg=name)
            for key, value in values.attrs.items():
                np.testing.assert_array_equal(back[name].attrs[key], value, err_msg=f"{name}.{key}")
        assert set(back.coords) == set(expected.coords)
        assert back.attrs == expected.attrs

    def test_times_are_times_to_xarray(self, kind, record, tmp_path):
        write(kind, record, tmp_path / "record")
        time = read(kind, tmp_path / "record").time.values
        seconds = (time - time[0]) / np.timedelta64(1, "s")
        np.testing.assert_allclose(seconds, np.arange(0, STEPS, EVERY) * 0.1, atol=1e-6)

    def test_a_record_without_trajectories_can_be_written(self, kind, record, tmp_path):
        write(kind, without_trajectories(record), str(tmp_path / "record"))
        np.testing.assert_array_equal(read(kind, tmp_path / "record").xi, record.estimate("xi").runs)

    def test_a_saved_record_can_be_exported(self, kind, record, tmp_path):
        shoal.save_record(record, tmp_path / "saved")
        write(kind, shoal.open_record(tmp_path / "saved"), tmp_path / "record")
        np.testing.assert_array_equal(read(kind, tmp_path / "record").x.T[:, :AGENTS], record.trajectories[0].x)

    def test_only_the_named_file_is_left(self, kind, record, tmp_path):
        write(kind, record, tmp_path / "record")
        assert [entry.name for entry in tmp_path.iterdir()] == ["record"]

    def test_an_existing_path_is_refused_and_kept(self, kind, record, tmp_path):
        path = tmp_path / "record"
        path.write_text("mine")
        with pytest.raises(RecordError, match="exists already") as refusal:
            write(kind, record, path)
        assert refusal.value.args[0] == str(path)
        assert path.read_text() == "mine"
        assert list(tmp_path.iterdir()) == [path]

    def test_a_folder_that_does_not_exist_is_named(self, kind, record, tmp_path):
        if kind == "zarr":
            pytest.skip("folders on the way to a folder are made")
        with pytest.raises(RecordError, match="there is no folder"):
            write(kind, record, tmp_path / "nowhere" / "record")
        assert list(tmp_path.iterdir()) == []

    @pytest.mark.parametrize(
        ("error", "reason"),
        [
            (OSError(28, "No space left on device"), "cannot be written: No space left on device"),
            (RuntimeError("NetCDF: HDF error"), "cannot be written: NetCDF: HDF error"),
            (KeyboardInterrupt(), None),
        ],
    )
    def test_a_failure_half_way_leaves_nothing(self, kind, record, tmp_path, monkeypatch, error, reason):
        def half(dataset, path, **_):
            (path / "x").mkdir() if kind == "zarr" else path.touch()
            raise error

        monkeypatch.setattr(xarray.Dataset, f"to_{kind}", half)
        with pytest.raises(RecordError if reason else KeyboardInterrupt, match=reason):
            write(kind, record, tmp_path / "record")
        assert list(tmp_path.iterdir()) == []

    def test_a_partial_of_the_users_is_left_alone(self, kind, record, tmp_path):
        (tmp_path / "record.partial").write_text("years of work")
        write(kind, record, tmp_path / "record")
        assert (tmp_path / "record.partial").read_text() == "years of work"
        assert len(list(tmp_path.iterdir())) == 2


class TestTracks:
    """A trajectory that was written can be followed by a target."""

    def test_an_agent_of_a_run_is_a_track(self, at_sea, tmp_path):
        pytest.importorskip("netCDF4")
        pytest.importorskip("pyproj")
        to_netcdf(at_sea, tmp_path / "swarm.nc")
        track = read_track(tmp_path / "swarm.nc", track_id="trajectory_id=run-1/agent-7", origin=ORIGIN)
        frames = at_sea.trajectories[1]
        np.testing.assert_allclose(track.time, frames.step * 0.1, atol=1e-6)
        np.testing.assert_allclose(track.x, frames.x[:, 7], atol=1e-3)
        np.testing.assert_allclose(track.y, frames.y[:, 7], atol=1e-3)
        assert track.notes == ()

    def test_frames_that_a_run_did_not_keep_are_no_fixes(self, at_sea, tmp_path):
        pytest.importorskip("netCDF4")
        pytest.importorskip("pyproj")
        to_netcdf(keeping(at_sea, {0: slice(0, 4), 1: slice(2, 6)}), tmp_path / "swarm.nc")
        track = read_track(tmp_path / "swarm.nc", track_id="trajectory_id=run-1/agent-0", origin=ORIGIN)
        np.testing.assert_allclose(track.x, at_sea.trajectories[1].x[2:6, 0], atol=1e-3)


class TestMissingExtra:
    """An absent library is one sentence with its cure, and no file."""

    def test_labelled_arrays_need_xarray(self, record, monkeypatch):
        monkeypatch.setitem(sys.modules, "xarray", None)
        with pytest.raises(MissingExtraError, match=r"(?s)xarray.*pip install '\.\[xarray\]'"):
            record.to_xarray()

    @pytest.mark.parametrize(("kind", "library"), [("netcdf", "netCDF4"), ("zarr", "zarr"), ("zarr", "xarray")])
    def test_files_need_their_library(self, record, tmp_path, monkeypatch, kind, library):
        monkeypatch.setitem(sys.modules, library, None)
        with pytest.raises(MissingExtraError, match=library):
            write(kind, record, tmp_path / "record")
        assert list(tmp_path.iterdir()) == []
