"""What a page may ask for, checked at the door: these requests and nothing else (docs/reference/view-protocol.md)."""

from typing import Annotated, Literal

from pydantic import Field, TypeAdapter, ValidationError

from shoal.core.errors import ShoalError
from shoal.run.changes import Add, Asked, Change, Drag, Kill, Restart

LONGEST = 4096  # bytes of a request
SLOWEST, FASTEST = 0.1, 1000.0  # times real time


class RequestError(ShoalError):
    """A message that is not a request."""


class Play(Asked):
    """Go on from the newest frame."""

    do: Literal["play"]


class Pause(Asked):
    """Stop time."""

    do: Literal["pause"]


class Step(Asked):
    """Advance by a number of steps; among older frames, one frame on or back."""

    do: Literal["step"]
    steps: int = Field(default=1, ge=-1000, le=1000)


class Speed(Asked):
    """So many times real time."""

    do: Literal["speed"]
    value: float = Field(ge=SLOWEST, le=FASTEST)


class Seek(Asked):
    """Show the kept frame at or before a step."""

    do: Literal["seek"]
    step: int = Field(ge=0, lt=2**62)


class Export(Asked):
    """Send the page a text to save: the scenario as it is set now, or the log of changes."""

    do: Literal["export"]
    what: Literal["scenario", "changes"]
    run: int = 0


Request = Play | Pause | Step | Speed | Seek | Restart | Change | Kill | Add | Drag | Export
_READER: TypeAdapter[Request] = TypeAdapter(Annotated[Request, Field(discriminator="do")])


def parse_request(text: str | bytes) -> Request:
    """Return the request that a message makes.

    Raises
    ------
    RequestError : it makes none
    """
    if len(text.encode(errors="replace") if isinstance(text, str) else text) > LONGEST:
        raise RequestError("request", f"is longer than {LONGEST} bytes", "send less at a time")
    try:
        return _READER.validate_json(text)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        where = ".".join(["request", *(str(part) for part in first["loc"])])
        raise RequestError(where, first["msg"], "see docs/reference/view-protocol.md") from None
