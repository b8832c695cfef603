"""A fleet under a seeded adversary: nothing that must be true is broken, and whoever breaks the runtime is caught."""

import inspect
import textwrap
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from functools import cache

import pytest
import soak as benchmark

from mutants import KEPT_MUTANTS, MUTANTS
from scenarios import small
from shoal.buoy.inbox import Inbox
from shoal.compiler.kernel import plain
from shoal.core.messages import Report
from shoal.run.fleet.adversary import Adversary
from shoal.run.fleet.soak import Outcome, Setting, soak

FLEET = small(16, 5)
KEEPING = small(
    16, 5, {"network.range": 6.0, "network.loss": 0.3, "network.max_age": 2, "network.hops": 2, "network.interval": 0.2}
)
STEPS = 250
SEEDS = (53, 51, 140)  # perfect radios, and ones that reach not far, late and now and then
AGAIN = 200  # a buoy whose clock is set back says a step again, otherwise, and is heard


def changed(function, old, new):
    """A function like this one, of which a piece of the source is another; of a kernel as plain Python."""
    function = plain(function)
    text = textwrap.dedent(inspect.getsource(function)).removeprefix("@entry_kernel\n")
    assert text.count(old) == 1, f"{old!r} is {text.count(old)} times in {function.__qualname__}"
    space = {}
    exec(text.replace(old, new), {**function.__globals__}, space)
    return space[function.__name__]


def soaked_with(monkeypatch, place, name, old, new, fleet=FLEET):
    """How the first seed ends in which this mutant breaks an invariant, or the last."""
    monkeypatch.setattr(place, name, changed(getattr(place, name), old, new))
    outcomes = (soak(seed, fleet, STEPS) for seed in (*SEEDS, AGAIN))
    return next((outcome for outcome in outcomes if outcome.broken), None)


@pytest.mark.parametrize("mutant", MUTANTS)
def test_mutants_are_caught(mutant, monkeypatch):
    *broken, word = MUTANTS[mutant]
    outcome = soaked_with(monkeypatch, *broken)
    assert outcome is not None
    assert word in outcome.broken


@pytest.mark.parametrize("mutant", KEPT_MUTANTS)
def test_mutants_of_what_is_kept_are_caught(mutant, monkeypatch):
    *broken, word = KEPT_MUTANTS[mutant]
    outcome = soaked_with(monkeypatch, *broken, fleet=KEEPING)
    assert outcome is not None
    assert word in outcome.broken


def test_who_keeps_and_relays_breaks_nothing():
    assert [soak(seed, KEEPING, STEPS).broken for seed in SEEDS] == [None] * len(SEEDS)


@cache
def unbroken(seed):
    """What comes of a seed where nobody broke anything."""
    return soak(seed, FLEET, STEPS)


class TestSeeds:
    """A seed decides every bit, and no invariant is broken."""

    def test_nothing_is_broken_whatever_happens(self):
        outcomes = [unbroken(seed) for seed in SEEDS]
        assert [each.broken for each in outcomes] == [None] * len(SEEDS)
        kinds = {event.split()[1] for each in outcomes for event in each.events}
        assert kinds == {"kill", "freeze", "restart", "clock", "mend"}
        assert all(each.steps == STEPS and each.decisions > 8 * STEPS for each in outcomes)

    def test_the_same_seed_is_the_same_to_the_bit(self):
        assert soak(SEEDS[1], FLEET, STEPS) == unbroken(SEEDS[1])
        assert unbroken(SEEDS[0]).sha256 != unbroken(SEEDS[1]).sha256

    def test_seeds_differ_in_their_rules(self):
        settings = [Setting.of(seed, FLEET, 10) for seed in range(80)]
        assert {each.max_age for each in settings} == {0, 1, 2, 3}
        assert {len(each.shares) for each in settings} == {3, 4, 5, 6, 7, 8}
        assert {each.scenario.network.delay for each in settings} == {0, 1, 2}
        assert {each.scenario.report_steps for each in settings} == {1, 2, 3}


def test_all_damage_is_seen():
    adversary = Adversary(1, 2, 16)
    inbox = Inbox(16, (), 0.1, 3)
    for step in range(300):
        report = Report(3, 1.0, 2.0, 3.0, 4.0, True, (), step * 0.1)
        inbox.put([adversary.damage(report.to_bytes())], step)
    assert inbox.counts == {"damaged": 300}


def test_noise_is_thought_of_as_it_must_be():
    adversary = Adversary(1, 2, 16)
    inbox, words = Inbox(16, (), 0.1, 3), Counter()
    for step in range(300):
        data, word = adversary.noise(step, 0.1, ())
        words[word] += 1
        inbox.put([data], step)
    assert inbox.counts == words


class TestCommandLine:
    """make soak."""

    @pytest.mark.parametrize(("broken", "code"), [(None, 0), ("nobody hears itself: buoy 3 in step 4", 1)])
    def test_a_seed_again(self, broken, code, monkeypatch, capsys):
        outcome = Outcome(17, 5, 250, 240, broken, "abc", ["3 kill 1 0"])
        monkeypatch.setattr(benchmark, "soak", lambda seed, steps: outcome)
        monkeypatch.setattr("sys.argv", ["soak.py", "--seed", "17", "--steps", "9"])
        with pytest.raises(SystemExit) as ended:
            benchmark.main()
        printed = capsys.readouterr().out
        assert ended.value.code == code
        assert "3 kill 1 0" in printed
        assert ("replay: python benchmarks/soak.py --seed 17 --steps 9" in printed) == bool(code)

    @pytest.mark.parametrize(("broken", "code"), [(None, 0), ("nobody hears itself: buoy 3 in step 4", 1)])
    def test_seed_after_seed_until_one_is_broken_which_is_replayed(self, broken, code, monkeypatch, capsys):
        def soaked(seed, steps):
            return Outcome(seed, 5, 250, 240, broken if seed == 8 else None, "abc", [])

        monkeypatch.setattr(benchmark, "soak", soaked)
        monkeypatch.setattr(benchmark, "pool", ThreadPoolExecutor)
        monkeypatch.setattr("sys.argv", ["soak.py", "--minutes", "0", "--processes", "2", "--first", "7"])
        with pytest.raises(SystemExit) as ended:
            benchmark.main()
        printed = capsys.readouterr().out
        assert ended.value.code == code
        assert ("no invariant broken by seeds 7 to 8" in printed) == (not code)
        assert ("seed 8: 5 steps" in printed and "replayed: the same to the bit" in printed) == bool(code)

    def test_a_process_that_is_killed_ends_it(self, monkeypatch, capsys):
        def killed(seed, steps):
            raise BrokenProcessPool

        monkeypatch.setattr(benchmark, "soak", killed)
        monkeypatch.setattr(benchmark, "pool", ThreadPoolExecutor)
        monkeypatch.setattr("sys.argv", ["soak.py", "--minutes", "0", "--first", "7"])
        with pytest.raises(SystemExit) as ended:
            benchmark.main()
        assert ended.value.code == 2
        assert "a process was killed after 0 seeds" in capsys.readouterr().out
