"""What a page may ask for, checked at the door: these requests and nothing else (docs/reference/view-protocol.md)."""

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError

from shoal.core.errors import ShoalError

LONGEST = 4096  # bytes of a request
SLOWEST, FASTEST = 0.1, 1000.0  # times real time

Value = int | float | str | bool


class RequestError(ShoalError):
    """A message that is not a request."""


class _Request(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)


class Play(_Request):
    """Go on from the newest frame."""

    do: Literal["play"]


class Pause(_Request):
    """Stop time."""

    do: Literal["pause"]


class Step(_Request):
    """Advance by a number of steps; among older frames, one frame on or back."""

    do: Literal["step"]
    steps: int = Field(default=1, ge=-1000, le=1000)


class Speed(_Request):
    """So many times real time."""

    do: Literal["speed"]
    value: float = Field(ge=SLOWEST, le=FASTEST)


class Seek(_Request):
    """Show the kept frame at or before a step."""

    do: Literal["seek"]
    step: int = Field(ge=0, lt=2**62)


class Restart(_Request):
    """From step 0, with the current settings."""

    do: Literal["restart"]
    seed: int | None = Field(default=None, ge=0, lt=2**64)


class Change(_Request):
    """Change fields of the running swarm's scenario."""

    do: Literal["change"]
    run: int = 0
    changes: dict[str, Value] = Field(min_length=1)


class Kill(_Request):
    """An agent is gone."""

    do: Literal["kill"]
    run: int = 0
    agent: int


class Add(_Request):
    """An agent joins a fleet at x, y [m]."""

    do: Literal["add"]
    run: int = 0
    fleet: int = 0
    x: float
    y: float


class Drag(_Request):
    """A target is at x, y [m]."""

    do: Literal["drag"]
    run: int = 0
    target: int = 0
    x: float
    y: float


Request = Play | Pause | Step | Speed | Seek | Restart | Change | Kill | Add | Drag
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
