"""Who hears whom where there is a range, a loss, a delay or a k that adapts."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scenarios import fleets, scenario
from shoal.core.agents import NEVER, new_swarm
from shoal.core.draws import split
from shoal.metrics.summary import evaluate
from shoal.run.facts import facts_of
from shoal.run.simulation import Simulation
from shoal.scenario.load import read_table, scenario_from
from shoal.world.neighbors import link_nearest, measure_distances, new_links, settle_ties
from shoal.world.radio import begin_degree, limit_links, lose_reports, new_radio, said, send, speaks, spoken

ORDERS = ["synchronous", "sequential"]


def radio_of(lanes, reach=np.inf, delay=0, loss=0.0, degree=None, interval=1):
    return new_radio(lanes, (), limited=True, reach=reach, delay=delay, loss=loss, degree=degree, interval=interval)


def swarm_at(x, y, neighbors):
    """A swarm of one fleet at these places; k of each."""
    swarm = new_swarm([len(x)], ())
    swarm.x[: len(x)], swarm.y[: len(x)], swarm.neighbors[: len(x)] = x, y, neighbors
    return swarm


def links_of(swarm, radio, number=10):
    """Who is linked in a step: (speaker, listener)."""
    n, lanes = int(swarm.fleet_end[-1]), swarm.x.size
    links = new_links(n, lanes)
    reports = said(radio, swarm, number)
    measure_distances(links, reports.x, reports.y, swarm.x, swarm.y, 0, n)
    limit_links(links, swarm, radio, 0, n, number, radio.range_square)
    link_nearest(links, n)
    links.heard[:] = (links.square <= links.reach).sum(axis=0)
    settle_ties(links, n)
    return (links.square <= links.reach)[:n, :n]


def brute(x, y, neighbors, reach, alive):
    """The k nearest of those there and in range, by sorting; ties to the lower index."""
    n = len(x)
    linked = np.zeros((n, n), bool)
    for i in np.flatnonzero(alive):
        square = (x[i] - x) ** 2 + (y[i] - y) ** 2
        near = [j for j in range(n) if j != i and alive[j] and square[j] <= reach**2]
        linked[sorted(near, key=lambda j: (square[j], j))[: neighbors[i]], i] = True
    return linked


@st.composite
def scattered(draw):
    """Places (on a grid, so that there are ties, or not), k of each agent, a range and who is there."""
    n = draw(st.integers(2, 40))
    rng = np.random.default_rng(draw(st.integers(0, 2**32)))
    x, y = rng.uniform(-5, 5, (2, n))
    if draw(st.booleans()):
        x, y = np.round(x), np.round(y)
    reach = draw(st.sampled_from([0.5, 1.0, 2.0, 5.0, np.inf]))
    return x, y, rng.integers(1, n, n), reach, rng.random(n) < draw(st.sampled_from([0.3, 0.9, 1.0]))


class TestRange:
    """The k nearest of those within range, or all of them if they are fewer."""

    @given(case=scattered())
    @settings(max_examples=200)
    def test_is_what_sorting_says(self, case):
        x, y, neighbors, reach, alive = case
        swarm, n = swarm_at(x, y, neighbors), len(x)
        swarm.alive[:n], swarm.leaves[:n] = alive, np.where(alive, NEVER, 0)
        assert (links_of(swarm, radio_of(swarm.x.size, reach)) == brute(x, y, neighbors, reach, alive)).all()

    def test_reaches_up_to_and_at_it(self):
        swarm = swarm_at([0.0, 3.0, 3.0 + 1e-9], np.zeros(3), 2)
        assert links_of(swarm, radio_of(8, reach=3.0))[:, 0].tolist() == [False, True, False]

    def test_works_between_two_agents(self):
        near, far = swarm_at([0.0, 1.0], [0.0, 0.0], 1), swarm_at([0.0, 9.0], [0.0, 0.0], 1)
        assert links_of(near, radio_of(8, reach=3.0)).sum() == 2
        assert links_of(far, radio_of(8, reach=3.0)).sum() == 0

    def test_leaves_the_k_nearest_where_it_is_wide(self):
        """A range larger than the arena changes no bit of a run."""
        one, other = (Simulation(scenario("oceans2020", changes)) for changes in ({}, {"network.range": 1e3}))
        one.advance(300)
        other.advance(300)
        assert one.swarm.x.tobytes() == other.swarm.x.tobytes()
        assert one.tally.heard.tolist() == other.tally.heard.tolist()


class TestAllToAll:
    """Everybody hears everybody, whatever the range leaves of them."""

    @pytest.mark.parametrize("order", ORDERS)
    def test_is_k_of_all_others(self, order):
        one, other = (
            Simulation(scenario("oceans2020", {"network.neighbors": k, "motion.update_order": order}))
            for k in ("all", 49)
        )
        one.advance(200)
        other.advance(200)
        assert one.swarm.x.tobytes() == other.swarm.x.tobytes()
        assert one.tally.heard.sum() == 200 * 50 * 49

    def test_k_may_differ_from_fleet_to_fleet(self):
        makes = fleets((3, 1.0), (4, 1.0), (5, 1.0))
        makes[0]["neighbors"], makes[1]["neighbors"] = 2, "all"
        simulation = Simulation(scenario("oceans2020", {"fleets": makes, "network.neighbors": 6}))
        simulation.advance(10)
        assert simulation.tally.heard.sum() == 10 * (3 * 2 + 4 * 11 + 5 * 6)


class TestLoss:
    """Every report of a step is lost by a chance of its own."""

    @given(seed=st.integers(0, 2**64 - 1), loss=st.sampled_from([0.05, 0.5, 0.9]))
    @settings(max_examples=10)
    def test_has_the_share_it_says(self, seed, loss):
        n, steps = 40, 20
        lost = 0
        for number in range(steps):
            links = new_links(n, n)
            links.square[:n] = 1.0
            lose_reports(links, radio_of(n, loss=loss), np.uint64(split(np.uint64(seed), number)), 0, n)
            lost += np.isinf(links.square[:n]).sum()
        pairs = n * n * steps
        assert abs(lost - loss * pairs) < 5 * np.sqrt(pairs * loss * (1 - loss))

    @pytest.mark.parametrize("order", ORDERS)
    @pytest.mark.parametrize("neighbors", [7, "all"])
    def test_in_a_run_the_reports_heard_are_as_many_fewer(self, order, neighbors):
        changes = {"network.loss": 0.3, "network.neighbors": neighbors, "motion.update_order": order}
        simulation = Simulation(scenario("oceans2020", changes))
        simulation.advance(100)
        said = 100 * 50 * (49 if neighbors == "all" else 7)
        assert abs(simulation.tally.heard.sum() - 0.7 * said) < 5 * np.sqrt(said * 0.3 * 0.7)

    def test_does_not_depend_on_who_listens_together(self):
        """The sequential order asks agent by agent; a pair loses the same reports."""
        n, key = 24, np.uint64(split(np.uint64(5), 3))
        whole = new_links(n, n)
        whole.square[:] = 1.0
        lose_reports(whole, radio_of(n, loss=0.4), key, 0, n)
        for first in range(n):
            one = new_links(n, 1)
            one.square[:] = 1.0
            lose_reports(one, radio_of(n, loss=0.4), key, first, n)
            assert (one.square[:n, 0] == whole.square[:n, first]).all()

    def test_of_everything_is_silence(self):
        simulation = Simulation(scenario("oceans2020", {"network.loss": 1.0}))
        simulation.advance(50)
        assert simulation.tally.heard.sum() == 0

    def test_of_speakers_and_the_draws_of_targets_are_independent(self):
        """A target's waypoint at a step says nothing about whose reports are lost in it."""
        lost, drawn = [], []
        chosen = scenario("oceans2020", {"network.loss": 0.5, "targets.0.waypoint_patience": 1})
        simulation = Simulation(chosen)
        links = simulation._scratch.links
        for _ in range(2000):
            simulation.advance(1)
            lost.append(np.isinf(links.square[0, 1]))
            drawn.append(simulation.targets[0].waypoint_y)
        assert abs(np.corrcoef(lost, drawn)[0, 1]) < 4 / np.sqrt(2000)


class TestDelay:
    """What is heard is as old as the delay says, and nothing is heard before."""

    def test_keeps_what_was_said(self):
        swarm, radio = swarm_at([0.0, 1.0], [0.0, 0.0], 1), radio_of(8, delay=3)
        for number in range(12):
            swarm.x[0] = 10.0 * number
            swarm.on_target[0] = number % 2 == 0
            send(radio, swarm, number)
            if number >= 3:
                heard = said(radio, swarm, number)
                assert heard.x[0] == 10.0 * (number - 3)
                assert heard.on_target[0] == ((number - 3) % 2 == 0)

    @pytest.mark.parametrize("order", ORDERS)
    @pytest.mark.parametrize("delay", [1, 5, 29])
    def test_nothing_is_heard_before_it_arrives(self, order, delay):
        simulation = Simulation(scenario("oceans2020", {"network.delay": delay, "motion.update_order": order}))
        simulation.advance(delay)
        assert simulation.tally.heard.sum() == 0
        simulation.advance(1)
        assert simulation.tally.heard.sum() == 50 * 20

    def test_a_leader_is_followed_to_where_it_was(self):
        """Two agents, social weight 1, no inertia: the second jumps to where the first was `delay` steps ago."""
        changes = {
            "fleets": fleets((2, 1e6)), "network.neighbors": 1, "network.delay": 4, "strategy.inertia": 0.0,
            "strategy.repulsion_step": 0.0, "strategy.social": 1.0, "area.width": 1000.0, "area.height": 1000.0,
            "targets": [{"kind": "still", "radius": 500.0, "x": -300.0}],
        }  # fmt: skip
        simulation = Simulation(scenario("oceans2020", changes))
        swarm = simulation.swarm
        track = []
        for number in range(20):
            with simulation.edit() as now:  # the first is on target and drawn along by hand
                now.swarm.x[:2], now.swarm.y[:2] = [-300.0 + number, 400.0], 0.0
            track.append(swarm.x[0])
            simulation.advance(1)
            if number >= 4:
                moved = (swarm.x[1] - 400.0) / (track[number - 4] - 400.0)
                assert 0.0 <= moved < 1.0  # r of the social term
                assert swarm.y[1] == 0.0
            else:
                assert swarm.x[1] == 400.0

    def test_what_is_told_of_memories_is_as_old(self):
        changes = {"network.delay": 6, "strategy": "shared-sighting", "targets.0.radius": 3.0}
        simulation = Simulation(scenario("oceans2020", changes))
        told = []
        for number in range(30):
            told.append(simulation.swarm.told.copy())
            simulation.advance(1)
            if number >= 6:
                arrived = simulation.radio.told[(number + 1) % 7]
                assert (arrived == told[number - 6]).all()
        assert (told[20] != told[14]).any()


class TestInterval:
    """Agents speak every so many steps; in between, what they said last is heard."""

    @pytest.mark.parametrize("delay", [0, 1, 3, 4, 9])
    def test_what_is_heard_is_the_last_that_arrived(self, delay):
        swarm, radio = swarm_at([0.0, 1.0], [0.0, 0.0], 1), radio_of(8, delay=delay, interval=4)
        for number in range(40):
            swarm.x[0] = 10.0 * number
            if speaks(radio, number):
                send(radio, swarm, number)
            if number >= delay:
                last = 4 * ((number - delay) // 4)
                assert spoken(radio, number) == last
                assert said(radio, swarm, number).x[0] == 10.0 * last

    def test_of_a_step_is_none(self):
        assert not any(speaks(radio_of(8), number) for number in range(5))
        assert [spoken(radio_of(8, delay=2), number) for number in (2, 3, 4)] == [0, 1, 2]

    def test_who_joins_is_heard_from_its_first_report_on_and_who_leaves_until_its_next_is_due(self):
        swarm, radio = swarm_at([0.0, 1.0, 2.0], [0.0] * 3, 2), radio_of(8, interval=4)
        swarm.joins[0], swarm.leaves[1] = 5, 6
        for number in range(12):
            if number % 4 == 0:
                send(radio, swarm, number)
            heard = links_of(swarm, radio, number)[:, 2]
            assert heard[:2].tolist() == [number >= 8, number < 8]

    def test_messages_follow_the_interval_and_not_the_step(self):
        for time_step in (0.1, 0.5):
            changes = {"network.interval": 2.0, "time_step": time_step}
            simulation = Simulation(scenario("oceans2020", changes))
            simulation.advance(round(10 / time_step))
            assert evaluate("messages", simulation.tally, facts_of(simulation.scenario))[0] == pytest.approx(20 / 2.0)

    def test_a_lost_report_is_missed_until_the_next(self):
        """One draw per report: for as long as a report stands, a link of two that stay is there or not."""
        changes = {"network.loss": 0.5, "network.interval": 1.0, "network.neighbors": "all", "strategy": "lattice"}
        links = Simulation(scenario("oceans2020", changes)).advance(40, every=1).links
        same = [(links[number] == links[number - 1]).all() for number in range(1, 40)]
        assert [number for number, alike in enumerate(same, 1) if not alike] == [10, 20, 30]

    @pytest.mark.parametrize("order", ORDERS)
    def test_a_look_is_what_the_step_will_hear(self, order):
        changes = {"network.interval": 0.5, "network.neighbors": 3, "motion.update_order": order}
        simulation = Simulation(scenario("oceans2020", changes))
        for _ in range(7):
            seen = simulation.look().links[0, 0]  # of the agent that decides first in both orders
            assert (simulation.advance(1, every=1).links[0, 0] == seen).all()


class TestTruth:
    """What a strategy reads is what was heard."""

    @pytest.mark.parametrize(
        "changes", [{"network.range": 4.0}, {"network.loss": 0.5, "network.neighbors": "all"}, {"network.neighbors": 3}]
    )
    @given(agent=st.integers(0, 49), steps=st.integers(1, 300))
    @settings(max_examples=10)
    def test_of_an_agent_that_is_not_heard_changes_nothing(self, changes, agent, steps):
        """An agent is put elsewhere: whoever hears it neither there nor here moves as it did, bit for bit."""
        one, other = (Simulation(scenario("oceans2020", changes)) for _ in range(2))
        heard = np.zeros(50, bool)
        for simulation, shift in ((one, 0.0), (other, 3.0)):
            simulation.advance(steps)
            with simulation.edit() as now:
                now.swarm.x[agent] -= np.copysign(shift, now.swarm.x[agent])
            simulation.advance(1)
            links = simulation._scratch.links
            heard |= (links.square <= links.reach)[agent, :50]
        moved = (one.swarm.x[:50] != other.swarm.x[:50]) | (one.swarm.y[:50] != other.swarm.y[:50])
        assert not moved[~heard & (np.arange(50) != agent)].any()
        assert not heard.all()

    def test_of_places_is_old_where_there_is_a_delay(self):
        """Agent 0 is put elsewhere: others learn of it `delay` steps later."""
        chosen = scenario("oceans2020", {"network.delay": 5, "network.neighbors": "all"})
        one, other = Simulation(chosen), Simulation(chosen)
        one.advance(100)
        other.advance(100)
        with other.edit() as now:
            now.swarm.x[0] += 0.25
        for step in range(6):
            one.advance(1)
            other.advance(1)
            same = (one.swarm.x[1:50] == other.swarm.x[1:50]).all()
            assert same == (step < 5)


ADAPTIVE = {"fewest": 4, "most": 30, "patience": 2.0}


class TestAdaptiveDegree:
    """k = fewest + (most - fewest) x share of recent time with somebody on target in hearing."""

    def test_follows_its_rule_step_by_step(self):
        changes = {"network.adaptive": ADAPTIVE, "targets.0.radius": 2.0}
        simulation = Simulation(scenario("oceans2020", changes))
        swarm, contact = simulation.swarm, np.full(50, 16 / 26)
        for _ in range(300):
            on_target = swarm.on_target[:50].copy()
            simulation.advance(1)
            links = simulation._scratch.links
            linked = (links.square <= links.reach)[:50, :50]
            hears = on_target | (linked & on_target[:, None]).any(axis=0)
            contact += 0.1 / 2.0 * (hears - contact)
            assert swarm.contact[:50] == pytest.approx(contact, abs=1e-12)
            assert (swarm.neighbors[:50] == np.floor(4 + 26 * swarm.contact[:50] + 0.5)).all()
        assert np.ptp(swarm.neighbors[:50]) > 0

    @pytest.mark.parametrize("order", ORDERS)
    @pytest.mark.parametrize(("radius", "k"), [(1e-9, 4), (100.0, 30)])
    def test_goes_to_fewest_without_contact_and_to_most_in_it(self, order, radius, k):
        changes = {"network.adaptive": ADAPTIVE, "targets.0.radius": radius, "motion.update_order": order}
        simulation = Simulation(scenario("oceans2020", changes))
        simulation.advance(300)
        assert set(simulation.swarm.neighbors[:50].tolist()) == {k}

    def test_a_faster_target_has_fewer_neighbors_listen(self):
        means = []
        for speed in (1.0, 3.0, 9.0):
            chosen = scenario("oceans2020", {"network.adaptive": ADAPTIVE, "targets.0.speed": speed, "steps": 4000})
            simulation = Simulation(chosen)
            simulation.advance(4000)
            means.append(simulation.tally.heard.sum())
        assert means == sorted(means, reverse=True)

    @pytest.mark.parametrize(("neighbors", "k"), [(10, 10), (2, 4), (40, 30), ("all", 30)])
    def test_starts_where_neighbors_says_as_far_as_it_may(self, neighbors, k):
        simulation = Simulation(scenario("oceans2020", {"network.adaptive": ADAPTIVE, "network.neighbors": neighbors}))
        assert set(simulation.swarm.neighbors[:50].tolist()) == {k}
        simulation.advance(1)
        assert np.abs(simulation.swarm.neighbors[:50] - k).max() <= 2

    def test_each_fleet_starts_at_its_own(self):
        changes = {"network.adaptive": ADAPTIVE, "fleets.0.neighbors": 8, "network.neighbors": 25}
        swarm = Simulation(scenario("oceans2020", changes)).swarm
        assert swarm.neighbors[:50].tolist() == [8] * 15 + [25] * 35

    def test_of_one_degree_stays(self):
        swarm, radio = swarm_at(np.arange(3.0), np.zeros(3), 2), radio_of(8, degree=(2, 2, 1.0))
        begin_degree(swarm, radio, 3)
        assert swarm.contact[:3].tolist() == [0.0] * 3
        assert swarm.neighbors[:3].tolist() == [2] * 3

    def test_is_not_for_strategies_that_hear_all(self):
        table = read_table("oceans2020") | {"strategy": "global-pso"}
        table["network"]["adaptive"] = dict(ADAPTIVE)
        simulation = Simulation(scenario_from(table))
        simulation.advance(50)
        assert simulation.tally.heard.sum() == 50 * 50 * 49

    def test_is_the_same_whether_the_graph_is_looked_at(self):
        """The graph is measured in every 500th step, in arrays that the rule must not read."""
        changes = {"network.adaptive": ADAPTIVE, "targets.0.radius": 1e-9, "network.neighbors": 4}
        simulation = Simulation(scenario("oceans2020", changes))
        simulation.advance(501)
        assert simulation.swarm.contact[:50].tolist() == [0.0] * 50
