"""Orders and answers as bytes: there and back, and nothing that was changed on the way is believed."""

import hmac
import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from shoal.core.errors import MessageError
from shoal.core.orders import LARGEST, WHATS, Answer, Order, opened, passed_on, sealed

KEY, OTHER = b"k" * 32, b"K" * 32
ORDER = Order("shoal/1", 5, 60.5, "set", {"strategy.delta": 0.02, "neighbors": 10}, (3, 7))
WORDS = st.text(max_size=9)
WHOLE = st.integers(0, 2**63 - 1)
IDS = st.lists(WHOLE, max_size=3).map(tuple)
ORDERS = st.builds(
    Order,
    WORDS,
    WHOLE,
    st.floats(0, 1e12),
    st.sampled_from([each for each in WHATS if each != "set"]),
    st.just({}),
    IDS,
)
ANSWERS = st.builds(Answer, WORDS, WHOLE, WHOLE, IDS, st.dictionaries(WORDS, IDS, max_size=2), WORDS)


class TestThereAndBack:
    """What is said is what is read."""

    @given(said=ORDERS | ANSWERS | st.just(ORDER), passed=st.integers(0, 255))
    def test_of_orders_and_answers(self, said, passed):
        assert opened(said.to_bytes(KEY, passed), KEY) == (said, passed)

    def test_passing_on_leaves_what_is_said(self):
        data = passed_on(ORDER.to_bytes(KEY), 7)
        assert opened(data, KEY) == (ORDER, 7)
        assert opened(passed_on(data, 256), KEY) == (ORDER, 255)
        assert opened(ORDER.to_bytes(KEY, 256), KEY) == (ORDER, 255)


class TestForgery:
    """Nothing is believed that was not sealed with the key, whole."""

    @given(said=ORDERS | ANSWERS, place=st.integers(0, 10**6), bit=st.integers(0, 7))
    def test_any_single_bit_is_noticed(self, said, place, bit):
        data = bytearray(said.to_bytes(KEY))
        place %= len(data)
        data[place] ^= 1 << bit
        if place == 1:  # how often it was passed on, which says nothing
            assert opened(bytes(data), KEY)[0] == said
        else:
            with pytest.raises(MessageError):
                opened(bytes(data), KEY)

    @given(said=ORDERS, size=st.integers(0, 60), more=st.binary(min_size=1, max_size=3))
    def test_so_is_what_is_cut_off_or_added(self, said, size, more):
        data = said.to_bytes(KEY)
        for changed in (data[:size], data[:-1], data + more):
            with pytest.raises(MessageError):
                opened(changed, KEY)

    @given(data=st.binary(max_size=200))
    def test_so_is_noise(self, data):
        with pytest.raises(MessageError):
            opened(data, KEY)

    def test_another_key_opens_nothing(self):
        with pytest.raises(MessageError, match="not sealed with this key"):
            opened(ORDER.to_bytes(OTHER), KEY)

    def test_an_order_is_no_answer(self):
        with pytest.raises(MessageError):
            opened(b"A" + ORDER.to_bytes(KEY)[1:], KEY)

    def test_the_seal_is_hmac_sha_256_of_all_but_how_often_it_was_passed_on(self):
        data = ORDER.to_bytes(KEY, 3)
        text = json.dumps(["shoal/1", 5, 60.5, "set", dict(ORDER.set), [3, 7]], separators=(",", ":")).encode()
        assert data == b"O\3" + text + hmac.digest(KEY, b"shoal order 1\0O" + text, "sha256")


@pytest.mark.parametrize(
    "content",
    [
        None,
        5,
        [],
        {},
        ["shoal/1", 5, 60.5, "hold", {}],
        ["shoal/1", 5, 60.5, "sink", {}, []],
        ["shoal/1", 5, 60.5, ["hold"], {}, []],
        ["shoal/1", 5, 60.5, "hold", {"neighbors": 3}, []],
        ["shoal/1", 5, 60.5, "set", {}, []],
        ["shoal/1", -5, 60.5, "hold", {}, []],
        ["shoal/1", 2**63, 60.5, "hold", {}, []],
        ["shoal/1", True, 60.5, "hold", {}, []],
        ["shoal/1", 5, None, "hold", {}, []],
        ["shoal/1", 5, True, "hold", {}, []],
        [1, 5, 60.5, "hold", {}, []],
        ["shoal/1", 5, 60.5, "hold", {}, 3],
        ["shoal/1", 5, 60.5, "hold", {}, [-1]],
        ["shoal/1", 5, 60.5, "hold", {}, ["a"]],
        ["shoal/1", 5, 60.5, "hold", [], []],
        "[" * 5,
    ],
)
def test_what_has_the_key_and_says_nonsense_is_refused(content):
    with pytest.raises(MessageError, match="neither an order nor an answer"):
        opened(sealed(b"O", content, KEY), KEY)
    with pytest.raises(MessageError, match="neither an order nor an answer"):
        opened(sealed(b"A", content, KEY), KEY)


def test_time_is_a_number():
    text = b'["shoal/1",5,Infinity,"hold",{},[]]'
    data = b"O\0" + text + hmac.digest(KEY, b"shoal order 1\0O" + text, "sha256")
    with pytest.raises(MessageError, match="void at no time"):
        opened(data, KEY)


def test_a_message_has_a_size():
    with pytest.raises(MessageError):
        opened(sealed(b"A", "x" * LARGEST, KEY), KEY)
