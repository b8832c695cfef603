"""Relays: who passes on what, how far a report comes, and what becomes of copies and damage."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hearsay import searched
from scenarios import small
from shoal.buoy.aboard import Aboard
from shoal.buoy.inbox import Inbox
from shoal.buoy.mesh import MemoryMesh
from shoal.buoy.relay import Relay, Relayed
from shoal.buoy.rows import row_of
from shoal.core.errors import MessageError
from shoal.core.messages import Report
from shoal.run.fleet.adversary import Adversary, Weather
from shoal.run.fleet.virtual_mesh import Parcel, VirtualMesh


def report(id, step=4, x=1.0):
    return Report(id, x, 2.0, 0.0, 0.0, False, (), step * 0.1)


def inbox():
    return Inbox(agents=20, told=(), time_step=0.1, kept=3)


def sender(data):
    """Who sent this: whose radio it was."""
    came = Relayed.of(data)
    return came.by if came.by >= 0 else Report.from_bytes(came.report).id


class TestFormat:
    """A relayed report says whose it is and when it was said, as its author did, and how far it came."""

    def test_it_keeps_author_step_and_hops(self):
        came = Relayed.of(Relayed(3, 12, report(7).to_bytes()).to_bytes())
        assert (came.hops, came.by, Report.from_bytes(came.report)) == (3, 12, report(7))

    def test_one_from_its_author_came_over_one_hop(self):
        assert Relayed.of(report(7).to_bytes()) == (1, -1, report(7).to_bytes())

    @given(place=st.integers(0, 59), bit=st.integers(0, 7), cut=st.booleans())
    def test_damage_is_seen(self, place, bit, cut):
        data = bytearray(Relayed(2, 12, report(7).to_bytes()).to_bytes())
        data[place] ^= 1 << bit
        broken = bytes(data[:place] if cut else data)
        with pytest.raises(MessageError):
            Report.from_bytes(Relayed.of(broken).report)

    @pytest.mark.parametrize("hops", [0, 1])
    def test_a_relay_is_the_second_hop_at_least(self, hops):
        with pytest.raises(MessageError, match="is the second"):
            Relayed.of(Relayed(hops, 0, report(1).to_bytes()).to_bytes())


class TestRelay:
    """Each report once, never one's own, and not beyond the limit."""

    def heard(self, relay, hops, id=7, step=4):
        data = report(id, step).to_bytes()
        relay.take([Relayed(hops, 1, data).to_bytes() if hops > 1 else data], inbox(), step)
        return [Relayed.of(each)[:2] for each in relay.waiting()]

    def test_what_is_no_report_is_counted_and_goes_no_further(self):
        relay, mine = Relay([3], 9), inbox()
        for data in (
            b"",
            b"noise",
            Relayed(2, 1, b"noise").to_bytes(),
            Relayed(2, 1, report(99).to_bytes()).to_bytes(),
        ):
            relay.take([data], mine, 4)
        assert mine.counts == {"damaged": 3, "strange": 1}
        assert relay.waiting() == []

    def test_passes_on_once(self):
        relay = Relay([5, 3], 9)
        assert self.heard(relay, 1) == [(2, 3)]
        assert self.heard(relay, 1) == []
        assert self.heard(relay, 4) == []
        assert self.heard(relay, 1, step=5) == [(2, 3)]

    def test_again_where_it_came_a_shorter_way(self):
        relay = Relay([3], 9)
        assert [self.heard(relay, hops) for hops in (4, 2, 2, 3, 1)] == [[(5, 3)], [(3, 3)], [], [], [(2, 3)]]

    def test_not_its_own_and_not_beyond_the_limit(self):
        relay = Relay([5, 3], 3)
        assert self.heard(relay, 1, id=5) == []
        assert self.heard(relay, 3) == []
        assert self.heard(relay, 2) == [(3, 3)]
        assert self.heard(Relay([3], 1), 1) == []

    def test_forgets(self):
        relay = Relay([3], 9)
        for step in range(100):
            assert self.heard(relay, 1, step=step)
            relay.forget(step - 2)
        assert len(relay._fewest) == 3


@given(agents=st.integers(3, 9), hops=st.integers(1, 5), share=st.sampled_from([0.15, 0.3]), seed=st.integers(0, 2**32))
@settings(max_examples=40, deadline=None)
def test_reports_reach_whom_a_search_reaches(agents, hops, share, seed):
    """On a mesh of which each hears but what some send, in whatever order it comes."""
    chance = np.random.default_rng(seed)
    direct = chance.random((agents, agents)) < share
    np.fill_diagonal(direct, False)
    meshes, sent = [], 0
    fleet = [(Relay([id], hops), inbox(), MemoryMesh(meshes)) for id in range(agents)]
    said = [(mesh, report(id).to_bytes()) for id, (_, _, mesh) in enumerate(fleet)]
    while said:
        for mesh, data in said:
            mesh.publish(data)
        sent += len(said)
        for id, (relay, mine, mesh) in enumerate(fleet):
            came = [data for data in mesh.take(0.0) if direct[sender(data), id]]
            relay.take([came[n] for n in chance.permutation(len(came))], mine, 4)
        said = [(mesh, data) for relay, _, mesh in fleet for data in relay.waiting()]
    reached = searched(direct.tolist(), hops)
    for i, (_, mine, _) in enumerate(fleet):
        heard = mine.of(4)
        assert heard.keys() - {i} == {j for j in range(agents) if reached[j][i]}
        assert heard == {id: row_of(report(id)) for id in heard}
        assert not mine.counts["strange"]
    assert sent <= agents + agents * (agents - 1) * (hops - 1)


@pytest.mark.parametrize(("hops", "reach"), [(1, 1), (3, 3), (7, 5)])
def test_in_a_storm_they_come_as_far_as_they_may_and_no_further(hops, reach):
    """Six processes in a row, on the mesh of a soak, which copies, damages and reorders."""
    chosen = small(6, 1, {"network.range": 1.0, "network.hops": hops})
    fleet = [Aboard(chosen, [id], relays=True) for id in range(6)]
    adversary = Adversary(5, 6, 6)
    adversary.weather = Weather(delay=0.3, copy=0.5, damage=0.2, noise=0.5, again=0.5)
    mesh, heard = VirtualMesh(6, adversary), np.zeros((6, 6), int)
    for now in range(40):
        said = [(id, report(id, now).to_bytes()) for id in range(6)]
        for turn in range(10):
            at = now + turn / 10
            if said:
                mesh.publish(at, [Parcel(data, None) for _, data in said], [id for id, _ in said])
            for id, aboard in enumerate(fleet):
                came = [parcel.data for parcel in mesh.take(id, at + 0.1)]
                aboard.hear([data for data in came if _sounds_near(data, id)], now)
            said = [(id, data) for id, aboard in enumerate(fleet) for data in aboard.relayed()]
    for id, aboard in enumerate(fleet):
        for step in range(40):
            for author, row in aboard.inbox.of(step).items():
                heard[id, author] += 1
                assert row == row_of(report(author, step))
    apart = abs(np.subtract.outer(np.arange(6), np.arange(6)))
    assert not heard[apart > reach].any()
    assert (heard[(apart > 0) & (apart <= reach)] > 0).all()
    assert all(aboard.inbox.counts["duplicate"] and aboard.inbox.counts["damaged"] for aboard in fleet)


def _sounds_near(data, id):
    """Whether it is of a neighbor in the row, or of nobody, such as noise."""
    try:
        return abs(sender(data) - id) == 1
    except MessageError:
        return True
