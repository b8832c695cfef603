"""Chance is a pure function: of the seed, the run, the step, who asks, and what for."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import replay
from shoal.core.draws import START_STEP, TARGET_STREAM, mix, normal, split, uniform

WORDS = st.integers(0, 2**64 - 1)
SEED_1234567 = [  # first outputs of SplitMix64 with this seed, as published with its reference implementation
    6457827717110365317,
    3203168211198807973,
    9817491932198370423,
    4593380528125082431,
    16408922859458223821,
]


def key_of(word):
    return np.uint64(word)


def many(draw, count=20_000, key=7):
    """One draw below each of so many keys."""
    top = key_of(key)
    return np.array([draw(key_of(split(top, i)), 0) for i in range(count)])


class TestSplit:
    """The n-th output of SplitMix64 seeded with the key."""

    def test_published_outputs(self):
        assert [int(split(key_of(1234567), n)) for n in range(5)] == SEED_1234567

    @given(key=WORDS, number=st.integers(0, 2**62))
    def test_the_same_in_plain_integers(self, key, number):
        assert int(split(key_of(key), number)) == replay.split(key, number)

    def test_zero_is_as_good_a_key_as_any(self):
        assert int(split(key_of(0), 0)) == 0xE220A8397B1DCDAF

    def test_neighboring_keys_and_numbers_share_about_half_their_bits(self):
        for one, other in (((5, 3), (5, 4)), ((5, 3), (6, 3)), ((0, 0), (1, 0)), ((2**63, 0), (0, 0))):
            different = int(split(key_of(one[0]), one[1])) ^ int(split(key_of(other[0]), other[1]))
            assert 12 <= different.bit_count() <= 52

    def test_agents_targets_and_the_start_have_keys_of_their_own(self):
        numbers = [*range(1000), *(TARGET_STREAM + j for j in range(10)), START_STEP, 10**9]
        assert len({int(split(key_of(1), number)) for number in numbers}) == len(numbers)


class TestMix:
    """A scrambler that loses nothing."""

    @given(word=WORDS)
    def test_can_be_undone(self, word):
        mixed = int(mix(key_of(word)))
        mixed ^= mixed >> 31 ^ mixed >> 62
        mixed = mixed * pow(0x94D049BB133111EB, -1, 2**64) % 2**64
        mixed ^= mixed >> 27 ^ mixed >> 54
        mixed = mixed * pow(0xBF58476D1CE4E5B9, -1, 2**64) % 2**64
        assert mixed ^ mixed >> 30 ^ mixed >> 60 == word


class TestUniform:
    """U[0, 1)."""

    @given(key=WORDS, purpose=st.integers(0, 100))
    def test_the_same_in_plain_integers(self, key, purpose):
        draw = uniform(key_of(key), purpose)
        assert draw == replay.uniform(key, purpose)
        assert 0.0 <= draw < 1.0

    def test_fills_the_interval_evenly(self):
        draws = many(uniform)
        counts, _ = np.histogram(draws, bins=20, range=(0.0, 1.0))
        chi_square = ((counts - 1000) ** 2 / 1000).sum()
        assert chi_square < 43.8  # 99.9 % of 19 degrees of freedom
        assert draws.mean() == pytest.approx(0.5, abs=0.007)

    def test_each_purpose_is_another_draw(self):
        key = key_of(42)
        assert len({uniform(key, purpose) for purpose in range(100)}) == 100

    def test_purposes_are_not_correlated(self):
        keys = [key_of(split(key_of(1), i)) for i in range(5000)]
        one, other = (np.array([uniform(key, purpose) for key in keys]) for purpose in (0, 1))
        assert abs(np.corrcoef(one, other)[0, 1]) < 0.05

    def test_asking_twice_is_asking_once(self):
        assert uniform(key_of(9), 3) == uniform(key_of(9), 3)


class TestNormal:
    """N(0, 1) by Box-Muller."""

    def test_moments(self):
        draws = many(normal)
        assert draws.mean() == pytest.approx(0.0, abs=0.025)
        assert draws.var() == pytest.approx(1.0, abs=0.04)
        assert (draws**3).mean() == pytest.approx(0.0, abs=0.1)
        assert (draws**4).mean() == pytest.approx(3.0, abs=0.25)

    def test_tails(self):
        draws = many(normal)
        assert (np.abs(draws) > 1.959964).mean() == pytest.approx(0.05, abs=0.006)
        assert np.isfinite(draws).all()

    def test_is_made_of_two_uniforms_below_its_purpose(self):
        below = replay.split(5, 2)
        radius = math.sqrt(-2.0 * math.log(1.0 - replay.uniform(below, 0)))
        expected = radius * math.cos(2.0 * math.pi * replay.uniform(below, 1))
        assert normal(key_of(5), 2) == pytest.approx(expected, rel=1e-14)
