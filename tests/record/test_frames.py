"""One reading of a fact: what frames, figures, replays and the live viewer show is what the engine knew."""

from dataclasses import replace

import numpy as np
import pytest

from frames import decode
from replay import split, step_key, uniform
from scenarios import fleets, scenario, small
from shoal.core.errors import RecordError
from shoal.core.links import MOST_LINKED, link_bytes, unpacked
from shoal.record.frames import engaged_by_frame, linked_pairs, moment_of, present_by_frame, who_hears_whom
from shoal.run.build import build_swarm
from shoal.run.facts import facts_of, roster_of
from shoal.run.simulate import simulate
from shoal.run.simulation import Simulation
from shoal.scenario.choices import degree_text, headline
from shoal.scenario.crew import crew_of
from shoal.viewer.live import LiveRun
from shoal.viewer.recorded import recorded_frames

STEPS = 40
NETWORKS = {
    "k nearest": {},
    "loss": {"network.loss": 0.5},
    "range": {"network.range": 4.0},
    "delay": {"network.delay": 3},
    "k adapts": {"network.adaptive": {"fewest": 3, "most": 30, "patience": 1.0}, "targets.0.radius": 4.0},
    "all": {"network.neighbors": "all"},
    "all, and loss": {"network.neighbors": "all", "network.loss": 0.2},
    "a strategy that hears all": {"strategy": "global-pso"},
    "k by fleet": {"fleets.0.neighbors": 3, "fleets.1.neighbors": "all"},
    "losses and joins": {
        "losses": [{"step": 10, "count": 20}],
        "joins": [{"step": 20, "count": 5, "fleet": "BoB-0"}],
    },
    "all of it": {
        "network.loss": 0.3,
        "network.range": 8.0,
        "network.delay": 2,
        "network.adaptive": {"fewest": 3, "most": 30, "patience": 1.0},
        "losses": [{"step": 10, "count": 20}],
    },
    "one after the other": {"motion.update_order": "sequential", "network.loss": 0.5},
}
LOSS = 2**33  # the stream of draws that losses come from


def heard_by_sorting(chosen, frames, at):
    """Whom agents hear at a frame, (N, N), worked out from positions and draws alone, one pair at a time."""
    network, step = chosen.network, int(frames.step[at])
    agents, then = frames.x.shape[1], at - network.delay
    heard = np.zeros((agents, agents), bool)
    if then < 0:
        return heard
    moves_on = chosen.motion.update_order == "sequential"
    for i in np.flatnonzero(frames.alive[at]):
        distances = []
        for j in np.flatnonzero(frames.alive[then]):
            said = at + 1 if moves_on and j < i else then  # who decides before i has moved already
            square = (frames.x[said, j] - frames.x[at, i]) ** 2 + (frames.y[said, j] - frames.y[at, i]) ** 2
            if j != i and square <= (network.range or np.inf) ** 2:
                distances.append((square, j))
        for _, j in sorted(distances)[: frames.neighbors[at, i]]:
            heard[i, j] = uniform(split(step_key(chosen, 0, step), LOSS + int(j)), int(i)) >= network.loss
    return heard


@pytest.fixture(scope="module", params=NETWORKS, ids=list(NETWORKS))
def networked(request):
    """(scenario, record with every frame)."""
    chosen = scenario("oceans2020", {**NETWORKS[request.param], "steps": STEPS})
    return chosen, simulate(chosen, every=1)


class TestLinks:
    """Links in every picture are those that were really used."""

    def test_of_frames_are_those_that_sorting_gives(self, networked):
        chosen, record = networked
        frames = record.trajectories[0]
        for at in range(0, STEPS - 1, 4):
            assert np.array_equal(who_hears_whom(frames, at), heard_by_sorting(chosen, frames, at)), at

    def test_of_the_table_of_messages_are_as_many(self, networked):
        chosen, record = networked
        if chosen.motion.update_order == "synchronous":
            heard = sum(who_hears_whom(record.trajectories[0], at).sum() for at in range(STEPS))
            assert heard == record.tallies[0].heard.sum()

    def test_of_a_look_are_those_of_the_coming_step(self, networked):
        chosen, record = networked
        kept = record.trajectories[0].arrays()
        simulation = Simulation(chosen)
        for at in (0, 13, 25):
            simulation.advance(at - simulation.number)
            for name, values in simulation.look().arrays().items():
                if name != "links" or chosen.motion.update_order == "synchronous":
                    assert np.array_equal(values[0], kept[name][at]), name

    def test_a_look_changes_nothing(self, networked):
        chosen, record = networked
        simulation = Simulation(chosen)
        while simulation.number < STEPS:
            simulation.look()
            simulation.advance(1)
        for name, total in record.tallies[0]._asdict().items():
            assert np.array_equal(getattr(simulation.tally, name), total), name

    def test_of_a_replay_and_of_the_live_viewer_are_the_same(self, networked):
        chosen, record = networked
        live = LiveRun(chosen.model_dump(mode="json"))
        frames = record.trajectories[0]
        shown = recorded_frames(record, 0, np.arange(0, STEPS, 13))
        for at, packed in zip(range(0, STEPS, 13), shown, strict=True):
            assert np.array_equal(decode(packed).hears, who_hears_whom(frames, at))
            live.advance(at - live.simulation.number)
            if chosen.motion.update_order == "synchronous":
                assert decode(live.frame()).hears == decode(packed).hears

    def test_of_a_snapshot_are_the_same(self, networked):
        pytest.importorskip("matplotlib", reason="matplotlib is not installed")
        from shoal.drawing.arena_drawing import Parts
        from shoal.drawing.snapshot import draw_snapshot
        from shoal.drawing.style import new_figure

        _, record = networked
        frames = record.trajectories[0]
        axes = new_figure(5.0, 5.0).add_axes((0.1, 0.1, 0.8, 0.8))
        draw_snapshot(axes, record, frame=25, parts=Parts(links=True))
        (drawn,) = axes.findobj(lambda artist: artist.get_gid() == "links")
        heard = who_hears_whom(frames, 25)
        places = np.stack([frames.x[25], frames.y[25]], axis=1)
        wanted = {tuple(places[[i, j]].ravel()) for i, j in np.argwhere(heard | heard.T) if i < j}
        assert {tuple(np.ravel(each)) for each in drawn.get_segments()} == wanted

    def test_pairs_are_there_once(self, networked):
        _, record = networked
        pairs = linked_pairs(record.trajectories[0], 30)
        assert (pairs[:, 0] < pairs[:, 1]).all()
        assert len(np.unique(pairs, axis=0)) == len(pairs)


class TestHowManyAreLinked:
    """Up to so many agents; beyond, one sentence."""

    @pytest.mark.parametrize(("agents", "bytes"), [(2, 1), (8, 1), (9, 2), (512, 64), (513, 0), (10_000, 0)])
    def test_bytes_of_an_agent(self, agents, bytes):
        assert link_bytes(agents) == bytes

    def test_a_swarm_of_the_most_has_links(self):
        frames = Simulation(small(MOST_LINKED, 5)).look()
        assert who_hears_whom(frames, 0).sum(axis=1).tolist() == [5] * MOST_LINKED

    def test_one_more_has_none_and_says_so(self):
        with pytest.raises(RecordError, match="keep no links: there are more than 512 agents"):
            who_hears_whom(Simulation(small(MOST_LINKED + 1, 5)).look(), 0)

    def test_bits_are_read_as_they_lie(self):
        bits = np.zeros((10, 2), np.uint8)
        bits[3] = 0b00000101, 0b10
        assert np.argwhere(unpacked(bits)).tolist() == [[3, 0], [3, 2], [3, 9]]


SENSORS = {
    "discs of the target": {},
    "sensors": {"fleets.0.sensor_radius": 1.0},
    "false alarms": {f"fleets.{fleet}.false_alarm_probability": 0.3 for fleet in (0, 1)},
    "imperfect detection": {f"fleets.{fleet}.detection_probability": 0.4 for fleet in (0, 1)},
    "both": {
        f"fleets.{fleet}.{chance}": 0.4
        for fleet in (0, 1)
        for chance in ("detection_probability", "false_alarm_probability")
    },
}


@pytest.fixture(scope="module", params=SENSORS, ids=list(SENSORS))
def record(request):
    """A run of 300 steps with every frame."""
    return simulate(scenario("oceans2020", {**SENSORS[request.param], "steps": 300}), every=1)


class TestEngaged:
    """False alarms are reported, but nobody is on a target for them; who does not notice a target is not, either."""

    def test_of_frames_is_the_metric(self, record):
        engaged, present = (read(record.trajectories[0]) for read in (engaged_by_frame, present_by_frame))
        assert engaged.sum() == record.tallies[0].engaged.sum()
        assert (engaged > 0).sum() == record.tallies[0].on_target.sum()
        assert present.sum() == record.tallies[0].present.sum()

    def test_of_a_replay_and_of_the_live_viewer_is_the_same(self, record):
        live = LiveRun(record.scenario.model_dump(mode="json"))
        for at in (0, 150, 299):
            (packed,) = recorded_frames(record, 0, np.array([at]))
            live.advance(at - live.simulation.number)
            assert (
                decode(packed).engaged == decode(live.frame()).engaged == engaged_by_frame(record.trajectories[0])[at]
            )

    def test_of_a_snapshots_title_is_the_same(self, record):
        from shoal.drawing.snapshot import state_text

        frames = record.trajectories[0]
        for at in range(0, 300, 7):
            alarms = int((frames.on_target[at] & ~frames.engaged[at]).sum())
            told = {0: "", 1: ", 1 false alarm"}.get(alarms, f", {alarms} false alarms")
            assert state_text(frames, at) == f"{engaged_by_frame(frames)[at]} on target{told}"


STILL = {"targets": [{"kind": "still", "radius": 2.0, "x": 3.0}]}


class TestMoment:
    """Xi and phi of a frame are those that the engine adds up."""

    def test_phi_after_one_step_is_the_tally_of_that_step(self):
        """Buoys at the wall too, whose wanted velocity is not the one they make; the target rests meanwhile."""
        simulation = Simulation(scenario("oceans2020", STILL))
        before = simulation.tally.histogram.sum(axis=0)
        for _ in range(60):
            simulation.advance(1)
            now = simulation.tally.histogram.sum(axis=0)
            assert np.array_equal(moment_of(simulation.look(), 0, facts_of(simulation.scenario)).phi, now - before)
            before = now

    def test_phi_of_frames_adds_up_to_the_histogram(self):
        chosen = scenario("oceans2020", {**STILL, "steps": 80})
        simulation = Simulation(chosen)
        frames, facts = simulation.advance(80, every=1), facts_of(chosen)
        total = (
            sum(moment_of(frames, at, facts).phi for at in range(1, 80)) + moment_of(simulation.look(), 0, facts).phi
        )
        assert np.array_equal(total, simulation.tally.histogram.sum(axis=0))

    def test_xi_of_one_step_is_the_metric(self):
        for at in (0, 5, 30):
            simulation = Simulation(scenario("oceans2020", {"losses": [{"step": 20, "count": 10}]}))
            simulation.advance(at)
            facts, before = facts_of(simulation.scenario), simulation.tally.fluctuation.sum()
            xi = moment_of(simulation.look(), 0, facts).xi
            alive = simulation.swarm.alive[:50] > 0
            top = simulation.roster.max_speed[alive].mean()
            simulation.advance(1)
            assert xi == pytest.approx((simulation.tally.fluctuation.sum() - before) / alive.sum() / top)

    def test_without_a_target_there_is_no_phi(self):
        dives = {"kind": "walk", "radius": 1.0, "speed": 1.0, "surface_time": 1e-9, "dive_time": 1e9}
        simulation = Simulation(scenario("oceans2020", {"targets": [dives]}))
        simulation.advance(3)
        moment = moment_of(simulation.look(), 0, facts_of(simulation.scenario))
        assert np.isnan(moment.phi).all()
        assert moment.xi > 0

    def test_of_a_replay_and_of_the_live_viewer_are_the_same(self):
        record = simulate(scenario("oceans2020", {"steps": 50}), every=1)
        live = LiveRun(record.scenario.model_dump(mode="json"))
        for at in (0, 1, 49):
            live.advance(at - live.simulation.number)
            played, shown = decode(recorded_frames(record, 0, np.array([at]))[0]), decode(live.frame())
            assert (played.phi, played.xi_now) == (shown.phi, shown.xi_now)


class TestRoster:
    """What each agent was given is written by the engine, once."""

    @pytest.mark.parametrize(
        ("changes", "words"),
        [
            ({}, "20"),
            ({"network.neighbors": 49}, "49"),
            ({"network.neighbors": "all"}, "all"),
            ({"strategy": "global-pso"}, "all"),
            ({"fleets.0.neighbors": "all"}, "all (BoB-1), 20 (BoB-0)"),
            ({"network.adaptive": {"fewest": 3, "most": 30}}, "3 to 30 (adaptive)"),
        ],
    )
    def test_k_is_printed_as_it_is(self, changes, words):
        record = simulate(scenario("oceans2020", {**changes, "steps": 3}))
        assert degree_text(record.scenario, record.roster.by_fleet("neighbors")) == words
        assert degree_text(record.scenario) == words
        assert f"k = {words}," in headline(record.scenario)

    def test_it_is_what_the_engine_works_with(self):
        changes = {"fleets": fleets((3, 2.0), (4, 1.0)), "network.neighbors": 2, "fleets.1.sensor_radius": 0.5}
        joins = [{"step": 5, "count": 2, "fleet": "make 0"}, {"step": 9, "count": 1, "fleet": "make 0"}]
        chosen = scenario("oceans2020", {**changes, "joins": joins, "fleets.1.strategy": "lattice"})
        crew = crew_of(chosen)
        roster = roster_of(build_swarm(chosen, crew), 10, crew)
        assert roster.fleet.tolist() == [0] * 6 + [1] * 4
        assert roster.max_speed.tolist() == [2.0] * 6 + [1.0] * 4
        assert roster.sensor_radius.tolist() == [0.0] * 6 + [0.5] * 4
        assert roster.neighbors.tolist() == [2] * 10
        assert roster.joins.tolist() == [0, 0, 0, 5, 5, 9, 0, 0, 0, 0]
        assert roster.strategy.tolist() == ["knn-pso"] * 6 + ["lattice"] * 4

    @pytest.mark.parametrize("changes", NETWORKS.values(), ids=list(NETWORKS))
    def test_of_an_older_record_it_is_derived_alike(self, changes):
        from shoal.record.older import roster_from

        simulation = Simulation(scenario("oceans2020", changes))
        derived = roster_from(simulation.scenario)
        for name, values in simulation.roster._asdict().items():
            assert np.array_equal(getattr(derived, name), values), name


def test_frames_without_links_say_so():
    record = simulate(scenario("oceans2020", {"steps": 3}), every=1)
    older = replace(record.trajectories[0], links=np.zeros((3, 50, 0), np.uint8))
    with pytest.raises(RecordError, match="keep no links: an older Shoal wrote them"):
        linked_pairs(older, 0)
