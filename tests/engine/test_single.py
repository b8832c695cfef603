"""Single precision: distances and influence are rounded, the rest of a run is not, and what it shows is the same."""

import numpy as np
import pytest

from shoal.core.errors import ScenarioError
from shoal.experiments.paired import paired_difference
from shoal.metrics.summary import METRICS
from shoal.run import build
from shoal.run.fleet.ocean import check_buoys_can
from shoal.run.on_card import why_not
from shoal.run.simulate import simulate
from shoal.run.simulation import Simulation
from shoal.scenario.crew import crew_of
from shoal.scenario.load import load

COMPARED = ("time_on_target", "xi", "stationary", "engaged", "clustering")
OPTIONS = {
    "as it is": {},
    "short, late and lost": {
        "network.range": 5.0, "network.loss": 0.2, "network.delay": 2, "losses": [{"step": 5, "count": 20}],
        "fleets.BoB-1.position_error": 0.5,
    },
    "piled up, and k adapts": {
        "fleets.BoB-0.start": "corner", "fleets.BoB-1.start": "corner", "fleets.BoB-0.false_alarm_probability": 0.05,
        "network.adaptive": {"fewest": 3, "most": 20, "patience": 2.0},
    },
    "disturbed": {"disturbances": [{"kind": "blackout", "since": 1.0, "until": 2.0}]},
}  # fmt: skip


def run(**changes):
    scenario = load("oceans2020", **{"steps": 40, "precision": "single"} | changes)
    simulation = Simulation(scenario)
    return simulation, simulation.advance(scenario.steps, every=1)


def heard_in(frames, frame, agents):
    bits = np.unpackbits(frames.links[frame], axis=1, count=agents, bitorder="little")
    return [np.flatnonzero(row).tolist() for row in bits]


def test_links_are_the_nearest_by_rounded_distances():
    """Ties too: agents that start in a corner are at few places."""
    _, frames = run(**{"fleets.BoB-0.start": "corner", "neighbors": 7})
    for frame in range(0, 40, 4):
        x, y = frames.x[frame].astype(np.float32), frames.y[frame].astype(np.float32)
        square = (x - x[:, None]) ** 2 + (y - y[:, None]) ** 2
        np.fill_diagonal(square, np.inf)
        nearest = np.sort(np.argsort(square, axis=1, kind="stable")[:, :7], axis=1).tolist()
        assert heard_in(frames, frame, 50) == nearest


@pytest.mark.parametrize("changes", OPTIONS.values(), ids=OPTIONS)
def test_lists_and_distances_give_the_same_bits(monkeypatch, changes):
    several = {"agents": 200, "density": "keep", **changes}
    monkeypatch.setattr(build, "FEWEST_LISTED", 10**9)
    pairs, frames = run(**several)
    monkeypatch.setattr(build, "FEWEST_LISTED", 2)
    lists, listed = run(**several)
    assert (pairs.world.listed == 0 < lists.world.listed) or "disturbances" in changes
    for name in ("x", "y", "vx", "vy", "command_x", "engaged", "neighbors", "links"):
        assert np.array_equal(getattr(frames, name), getattr(listed, name)), name
    for name, one, other in zip(pairs.tally._fields, pairs.tally, lists.tally, strict=True):
        assert np.array_equal(one, other), name
    assert np.array_equal(pairs.look().links, lists.look().links)


def test_it_is_a_choice_with_a_name_of_its_own():
    double, single = load("oceans2020"), load("oceans2020", precision="single")
    assert double.hash == load("oceans2020", precision="double").hash != single.hash
    assert len({run(precision=each)[0].swarm.x[:50].tobytes() for each in ("single", "double")}) == 2
    assert run()[1].x.tobytes() == run()[1].x.tobytes()


def test_a_step_differs_by_no_more_than_rounding():
    """From the same state: velocities wanted in the first step, before anything is chaos."""
    one, other = (run(precision=each, steps=2)[1] for each in ("single", "double"))
    assert np.array_equal(one.x[0], other.x[0])
    away = np.abs(one.command_x[1] - other.command_x[1])
    assert 0.0 < away.max() < 1e-4


@pytest.mark.parametrize(
    ("changes", "where"),
    [
        ({"motion.update_order": "sequential"}, "motion.update_order"),
        ({"network.hops": 3}, "network.hops"),
        ({"network.max_age": 5}, "network.max_age"),
    ],
)
def test_what_it_does_not_go_with(changes, where):
    with pytest.raises(ScenarioError, match=f"precision is single, but {where}"):
        load("oceans2020", precision="single", **changes)


def test_buoys_and_cards_are_exact():
    single = load("oceans2020", precision="single")
    assert "single precision" in why_not(single)
    with pytest.raises(ScenarioError, match="precision: is single"):
        check_buoys_can(single, crew_of(single))


def values(record, metric):
    return np.array([METRICS[metric].formula(tally, record.facts) for tally in record.tallies])


@pytest.mark.slow
@pytest.mark.parametrize("target_speed", [3.0, 5.0])
def test_the_papers_numbers_agree_within_intervals(target_speed):
    """Time on target, Xi, who stands still: of both swarms, at few, at the best and at many neighbors.

    Of thirty differences that are chance one or two lie outside their 95 % interval.
    """
    outside = []
    for fast in (0, 15):
        for neighbors in (10, 20, 40):
            changes = {"fast": fast, "neighbors": neighbors, "target_speed": target_speed, "steps": 10_000}
            one, other = (simulate("oceans2020", precision=each, runs=6, **changes) for each in ("single", "double"))
            for metric in COMPARED:
                ours, theirs = values(one, metric), values(other, metric)
                difference = paired_difference(ours, theirs)
                low, high = difference.ci95
                if not low <= 0.0 <= high:
                    outside.append((fast, neighbors, metric, difference))
                assert abs(difference.mean) < 0.03 * max(theirs.mean(), 0.1)
    assert len(outside) <= 4, outside
