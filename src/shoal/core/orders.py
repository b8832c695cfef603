"""Orders to buoys and their answers as bytes, which prove that whoever wrote them has the key.

Its kind ("O" or "A", 1 byte); how often it was passed on (1), which whoever does so changes; what it says, as JSON in
UTF-8; and the HMAC-SHA-256 of the kind and the JSON (32).
"""

import hashlib
import hmac
import json
import math
from collections.abc import Mapping
from typing import Any, NamedTuple

from shoal.core.errors import MessageError

KEY_BYTES = 32  # at least
LARGEST = 2**20  # bytes of a message
FARTHEST = 255  # times that one is passed on
_SEAL = hashlib.sha256().digest_size


class Order(NamedTuple):
    """What a person tells buoys.

    fleet : the name of the mesh that it is for
    number : grows from order to order: the time at which it was given [ns since 1970]
    until : when it is void [s since 1970]
    what : "hold", "recall", "resume", "set"; or "ask", who is there
    set : fields and their new values
    agents : the numbers of those that it is for; empty for all
    """

    fleet: str
    number: int
    until: float
    what: str
    set: Mapping[str, Any] = {}
    agents: tuple[int, ...] = ()

    def to_bytes(self, key: bytes, passed: int = 0) -> bytes:
        """The order as it goes over the mesh, sealed with a key, `passed` on so often."""
        return sealed(b"O", [self.fleet, self.number, self.until, self.what, dict(self.set), self.agents], key, passed)


class Answer(NamedTuple):
    """What the buoys of one process say to an order: who obeys from which step on, and who does not and why.

    fleet, number : of the order; scenario : as TOML, to whoever asked for it
    """

    fleet: str
    number: int
    step: int
    obeyed: tuple[int, ...]
    refused: Mapping[str, tuple[int, ...]] = {}
    scenario: str = ""

    def to_bytes(self, key: bytes, passed: int = 0) -> bytes:
        """The answer as it goes over the mesh; see Order.to_bytes."""
        return sealed(b"A", list(self), key, passed)


WHATS = ("hold", "recall", "resume", "set", "ask")


def sealed(kind: bytes, content: Any, key: bytes, passed: int = 0) -> bytes:
    """Anything as bytes that prove who wrote it."""
    text = json.dumps(content, allow_nan=False, separators=(",", ":")).encode()
    return kind + bytes([min(passed, FARTHEST)]) + text + _seal(kind, text, key)


def passed_on(data: bytes, passed: int) -> bytes:
    """The same message, passed on so often, or more often than can be counted."""
    return data[:1] + bytes([min(passed, FARTHEST)]) + data[2:]


def opened(data: bytes, key: bytes) -> tuple[Order | Answer, int]:
    """What sealed bytes say, and how often they were passed on.

    Raises
    ------
    MessageError : damaged, forged, sealed with another key, or neither an order nor an answer
    """
    kind, text, seal = bytes(data[:1]), bytes(data[2:-_SEAL]), bytes(data[-_SEAL:])
    if not 2 + _SEAL < len(data) <= LARGEST or not hmac.compare_digest(seal, _seal(kind, text, key)):
        raise MessageError("order", "is not sealed with this key, or damaged", "drop it")
    try:
        parts = json.loads(text)
        return (_order(*parts) if kind == b"O" else _answer(*parts)), data[1]
    except (ValueError, TypeError, AttributeError, OverflowError, RecursionError) as error:
        problem = f"is neither an order nor an answer: {str(error)[:100]}"
        raise MessageError("order", problem, "give all the same version of Shoal") from error


def _order(fleet: Any, number: Any, until: Any, what: Any, set: Any, agents: Any) -> Order:
    known = what in WHATS and isinstance(set, dict) and (what == "set") == bool(set)
    if not (known and isinstance(fleet, str) and _is_whole(number) and isinstance(until, (int, float))):
        raise ValueError("it says what no order says")
    if isinstance(until, bool) or not math.isfinite(until):
        raise ValueError("it is void at no time")
    return Order(fleet, number, float(until), what, set, _ids(agents))


def _answer(fleet: Any, number: Any, step: Any, obeyed: Any, refused: Any, scenario: Any) -> Answer:
    if not (isinstance(fleet, str) and _is_whole(number) and _is_whole(step) and isinstance(scenario, str)):
        raise ValueError("it says what no answer says")
    return Answer(fleet, number, step, _ids(obeyed), {why: _ids(ids) for why, ids in refused.items()}, scenario)


def _ids(numbers: Any) -> tuple[int, ...]:
    if not (isinstance(numbers, list) and all(map(_is_whole, numbers))):
        raise ValueError("it names what are no agents")
    return tuple(numbers)


def _is_whole(number: Any) -> bool:
    return isinstance(number, int) and not isinstance(number, bool) and 0 <= number < 2**63


def _seal(kind: bytes, text: bytes, key: bytes) -> bytes:
    return hmac.new(key, b"shoal order 1\0" + kind + text, hashlib.sha256).digest()
