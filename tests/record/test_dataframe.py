"""A record as tidy tables, and as a dataset that does not explode."""

import numpy as np
import pytest

import shoal
from shoal.core.errors import RecordError
from shoal.metrics.summary import METRICS

pytest.importorskip("pandas", reason="tables need pandas: pip install '.[sweep]'")


@pytest.fixture(scope="module")
def record():
    return shoal.simulate("oceans2020", steps=300, runs=2, every=3)


class TestTables:
    """One row per thing measured."""

    def test_metrics(self, record):
        table = record.to_pandas()
        assert list(table.columns) == ["run", "metric", "value", "unit"]
        assert len(table) == 2 * len(METRICS)
        means = table.groupby("metric")["value"].mean()
        for name in ("time_on_target", "xi", "power"):
            assert means[name] == pytest.approx(record.estimate(name).mean, rel=1e-12)
        assert dict(zip(table["metric"], table["unit"], strict=True)) == {
            name: each.unit for name, each in METRICS.items()
        }

    def test_fleets(self, record):
        table = record.to_pandas("fleets")
        means = table.groupby(["fleet", "metric"])["value"].mean()
        for metric in ("xi_raw", "stationary", "speed", "power"):
            for fleet, known in record.fleet_estimate(metric).items():
                assert means[fleet, metric] == pytest.approx(known.mean, rel=1e-12)

    def test_targets(self, record):
        table = record.to_pandas("targets").pivot(index=["run", "target"], columns="metric", values="value")
        (known,) = record.target_estimates()
        assert table["time_on_target"].tolist() == list(known["time_on_target"].runs)
        assert table["first_detection"].tolist() == list(known["first_detection"].runs)

    def test_frames(self, record):
        table, frames = record.to_pandas("frames"), record.trajectories[1]
        assert len(table) == 2 * 100 * 50
        of_run = table[table["run"] == 1]
        agent = of_run[of_run["agent"] == 20]
        np.testing.assert_array_equal(agent["step"], frames.step)
        np.testing.assert_array_equal(agent["x"], frames.x[:, 20])
        np.testing.assert_array_equal(agent["vy"], frames.vy[:, 20])
        np.testing.assert_array_equal(agent["on_target"], frames.on_target[:, 20])
        np.testing.assert_array_equal(agent["memory_repulsion"], frames.memory["repulsion"][:, 20])
        np.testing.assert_allclose(agent["time"], frames.step * 0.1, rtol=1e-15)
        assert set(of_run.groupby("fleet")["agent"].nunique().items()) == {("BoB-1", 15), ("BoB-0", 35)}

    def test_frames_of_targets(self, record):
        table = record.to_pandas("target_frames")
        np.testing.assert_array_equal(table[table["run"] == 0]["y"], record.trajectories[0].target_y[:, 0])
        assert table["present"].all()

    def test_of_a_record_without_frames(self, record):
        from dataclasses import replace

        assert replace(record, trajectories={}).to_pandas("frames").empty


class TestDataset:
    """to_xarray().to_dataframe() is not a product of all dimensions."""

    @pytest.fixture
    def dataset(self, record):
        pytest.importorskip("xarray", reason="datasets need xarray: pip install '.[xarray]'")
        return record.to_xarray()

    def test_the_whole_is_refused(self, dataset):
        with pytest.raises(RecordError, match=r"would have .* rows, one for every combination of .*\n.*to_pandas"):
            dataset.to_dataframe()

    def test_variables_that_belong_together_are_a_table(self, dataset, record):
        table = dataset[["x", "y"]].to_dataframe()
        assert len(table) == 2 * 50 * 100
        assert dataset[["xi"]].to_dataframe()["xi"].tolist() == list(record.estimate("xi").runs)

    def test_it_is_a_dataset_all_the_same(self, dataset, tmp_path):
        import xarray

        assert isinstance(dataset, xarray.Dataset)
        assert dataset.x.attrs["units"] == "m"
        assert isinstance(dataset.isel(run=0), xarray.Dataset)
