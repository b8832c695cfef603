"""Orders that reach buoys: obeyed and passed on once, if authentic, new and in time; and answered."""

import pytest

from scenarios import small
from shoal.buoy.orderbook import Orderbook
from shoal.buoy.orderer import Orderer
from shoal.core.errors import FleetError, ScenarioError
from shoal.core.orders import Answer, Order, opened, sealed

KEY = b"k" * 32
START = 1_000.0
SCENARIO = small(6, 5)


class Crew:
    """Buoys that note what they are told."""

    def __init__(self, *ids):
        self.present = ids
        self.told = []

    def refusal(self, command, id):
        return "it will not" if id == 13 else None

    def order(self, command):
        self.told.append((command.step, command.words, command.agents))


def order(what="hold", at=START + 5.0, **changes):
    return Order("shoal/1", int(at * 1e9), at + 60.0, what)._replace(**changes)


def book(started=START):
    return Orderbook(SCENARIO, "shoal/1", KEY, started)


class Taking:
    """A book and its crew, by themselves."""

    def __init__(self, *ids):
        self.book, self.crew = book(), Crew(*ids)

    def __call__(self, data, now=START + 6.0, step=8):
        return self.book.take(data, self.crew, step, now)


@pytest.fixture
def take():
    return Taking(0, 1, 2)


class TestObeying:
    """Whoever is meant and there obeys, from the next step on, and says so."""

    def test_all(self, take):
        passed, answer = take(order().to_bytes(KEY))
        assert take.crew.told == [(8, "hold", (0, 1, 2))]
        assert opened(passed, KEY) == (order(), 1)
        assert opened(answer, KEY) == (Answer("shoal/1", order().number, 8, (0, 1, 2)), 1)

    def test_those_that_are_named(self, take):
        take(order(agents=(2, 5)).to_bytes(KEY))
        assert take.crew.told == [(8, "hold", (2,))]

    def test_who_is_not_named_passes_it_on(self, take):
        (passed,) = take(order(agents=(5,)).to_bytes(KEY))
        assert (opened(passed, KEY)[0].agents, take.crew.told) == ((5,), [])

    def test_who_cannot_says_why(self):
        take = Taking(12, 13)
        _, answer = take(order("set", set={"neighbors": 3}).to_bytes(KEY))
        assert take.crew.told == [(8, "set neighbors = 3", (12,))]
        assert opened(answer, KEY)[0].refused == {"it will not": (13,)}
        assert take.book.refused == ["set was refused by buoy 13: it will not"]

    def test_what_no_command_can_say_is_refused_by_all(self, take):
        _, answer = take(order("set", set={"neighbors": [3]}).to_bytes(KEY))
        assert list(opened(answer, KEY)[0].refused.values()) == [(0, 1, 2)]
        assert take.crew.told == []

    def test_who_asks_is_told_the_scenario(self, take):
        _, answer = take(order("ask").to_bytes(KEY))
        assert "[[fleets]]" in opened(answer, KEY)[0].scenario
        assert take.crew.told == []


class TestNotObeying:
    """Nobody obeys, answers or passes on anything else; it is counted."""

    @pytest.mark.parametrize(
        ("data", "word"),
        [
            (b"", "forged"),
            (b"O\0[]" + bytes(32), "forged"),
            (order().to_bytes(b"K" * 32), "forged"),
            (order().to_bytes(KEY)[:-1] + b"\0", "forged"),
            (sealed(b"O", ["hold"], KEY), "forged"),
            (order(fleet="shoal/2").to_bytes(KEY), "strange"),
            (order(at=START).to_bytes(KEY), "replayed"),  # from before the buoys started
            (order(until=START + 5.5).to_bytes(KEY), "void"),
            (order(at=START + 100.0).to_bytes(KEY), "void"),  # from the future
        ],
    )
    def test_what_is_not_authentic_new_and_in_time(self, take, data, word):
        assert take(data) == []
        assert take.crew.told == []
        assert +take.book.counts == {word: 1}

    def test_it_twice(self, take):
        take(order().to_bytes(KEY))
        assert take(order().to_bytes(KEY, passed=9)) == []
        assert len(take.crew.told) == 1
        assert take.book.counts["duplicate"] == 1

    def test_an_older_one_after_a_newer_one(self, take):
        take(order("resume").to_bytes(KEY))
        assert take(order(at=START + 4.9).to_bytes(KEY)) == []
        assert take.crew.told == [(8, "resume", (0, 1, 2))]
        assert take.book.counts["replayed"] == 1

    def test_an_old_one_after_a_restart(self, take):
        take(order().to_bytes(KEY))
        take.book = book(started=START + 5.5)
        assert take(order().to_bytes(KEY)) == []
        assert len(take.crew.told) == 1

    def test_what_was_refused_as_forged_does_not_use_up_a_number(self, take):
        take(order(at=START + 50.0).to_bytes(b"K" * 32))
        take(order().to_bytes(KEY))
        assert len(take.crew.told) == 1

    def test_changing_how_often_it_was_passed_on_breaks_nothing(self, take):
        assert len(take(order().to_bytes(KEY, passed=255))) == 2


class Mesh:
    """Nodes that hear those that they have a link to, in the order in which things are said."""

    def __init__(self, nodes, links, started=START):
        self.takers = {name: Taking(*ids) for name, ids in nodes.items()}
        self.links = links
        self.said = []
        self.heard = []
        self.now = START + 6.0

    def order(self, data):
        """A guest says something to the first node."""
        self.said = [(next(iter(self.takers)), data)]
        self.heard = []
        while self.said:
            node, data = self.said.pop(0)
            for each in self.takers[node](data, self.now):
                self.sent = getattr(self, "sent", 0) + 1
                self.said += [(other, each) for pair in self.links for other in self.others(pair, node)]
                if node == next(iter(self.takers)):
                    self.heard.append(each)

    @staticmethod
    def others(pair, node):
        return [other for other in pair if node in pair and other != node]

    def orders(self, timeout):
        self.now += timeout
        heard, self.heard = self.heard, []
        return heard

    def fleets(self):
        return {"shoal/1"}


LINE = {"a": (0, 1), "b": (2,), "c": (3, 4), "d": (5,)}


def orderer(mesh, key=KEY):
    return Orderer(mesh, "tcp/somewhere", key, 3.0, clock=lambda: mesh.now)


class TestRelaying:
    """Each node passes an order on that it sees first, and answers go back the way that it came."""

    @pytest.mark.parametrize(
        "links", [["ab", "bc", "cd"], ["ab", "bc", "cd", "da"], ["ab", "ac", "ad", "bc", "bd", "cd"]]
    )
    def test_all_obey_whatever_the_links(self, links):
        mesh = Mesh(LINE, links)
        answers = orderer(mesh).order("recall")
        assert (answers.obeyed, answers.refused, answers.silent) == (dict.fromkeys(range(6), 8), {}, [])
        assert [taker.crew.told for taker in mesh.takers.values()] == [
            [(8, "recall", (0, 1))],
            [(8, "recall", (2,))],
            [(8, "recall", (3, 4))],
            [(8, "recall", (5,))],
        ]

    def test_in_a_full_mesh_each_says_two_things_and_the_first_passes_answers_on(self):
        mesh = Mesh(LINE, ["ab", "ac", "ad", "bc", "bd", "cd"])
        giver, mesh.sent = orderer(mesh), 0
        giver.order("hold")
        assert mesh.sent == 4 + 4 + 3

    def test_who_cannot_be_reached_is_named(self):
        answers = orderer(Mesh(LINE, ["ab", "cd"])).order("hold", agents=(1, 3))
        assert (answers.obeyed, answers.silent) == ({1: 8}, [3])

    def test_one_order_after_the_other(self):
        mesh = Mesh(LINE, ["ab", "bc", "cd"])
        giver = orderer(mesh)
        for what in ("hold", "resume", "hold"):
            assert giver.order(what).silent == []
        assert [words for _, words, _ in mesh.takers["d"].crew.told] == ["hold", "resume", "hold"]


class TestOrderer:
    """What can be said before anything is sent is said then."""

    @pytest.mark.parametrize(
        ("changes", "words"),
        [
            ({"strategy.delta": -1}, "greater than or equal to 0"),
            ({"neighbors": 6}, "6 agents can hear at most 5"),
            ({"area.width": 3}, "cannot change on the way"),
        ],
    )
    def test_a_value_that_cannot_be(self, changes, words):
        mesh = Mesh(LINE, ["ab", "bc", "cd"])
        with pytest.raises(ScenarioError, match=words):
            orderer(mesh).order("set", changes)
        assert all(taker.book.counts["refused"] == 0 for taker in mesh.takers.values())

    def test_a_buoy_that_there_is_not(self):
        with pytest.raises(FleetError, match="buoys 0 to 5"):
            orderer(Mesh(LINE, ["ab"])).order("hold", agents=[6])

    def test_another_key(self):
        with pytest.raises(FleetError, match="no buoy of shoal/1 answered within 3 s"):
            orderer(Mesh(LINE, ["ab"]), b"K" * 32)

    def test_a_line_to_two_fleets(self):
        mesh = Mesh(LINE, ["ab"])
        mesh.fleets = lambda: {"shoal/1", "shoal/2"}
        with pytest.raises(FleetError, match="several fleets"):
            orderer(mesh)
