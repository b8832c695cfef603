"""What may be asked of a swarm while it runs: the changes that a watcher makes and that a log of them holds."""

from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter

Value = int | float | str | bool


class Asked(BaseModel):
    """Something asked for, in strict words."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)


class Restart(Asked):
    """From step 0, with the current settings."""

    do: Literal["restart"]
    seed: int | None = Field(default=None, ge=0, lt=2**64)


class Change(Asked):
    """Change fields of the running swarm's scenario."""

    do: Literal["change"]
    run: int = 0
    changes: dict[str, Value] = Field(min_length=1)


class Kill(Asked):
    """An agent is gone."""

    do: Literal["kill"]
    run: int = 0
    agent: int


class Add(Asked):
    """An agent joins a fleet at x, y [m]."""

    do: Literal["add"]
    run: int = 0
    fleet: int = 0
    x: float
    y: float


class Drag(Asked):
    """A target is at x, y [m]."""

    do: Literal["drag"]
    run: int = 0
    target: int = 0
    x: float
    y: float


Steering = Restart | Change | Kill | Add | Drag
READER: TypeAdapter[Steering] = TypeAdapter(Annotated[Steering, Field(discriminator="do")])


def words_of(steering: Steering) -> str:
    """What a change does, in a few words, such as: neighbors = 5."""
    match steering:
        case Change(changes=changes):
            return ", ".join(f"{name} = {_short(value)}" for name, value in changes.items())
        case Kill(agent=agent):
            return f"buoy {agent} removed"
        case Add(x=x, y=y):
            return f"a buoy added at ({x:.4g}, {y:.4g}) m"
        case Drag(target=target, x=x, y=y):
            return f"target {target} put at ({x:.4g}, {y:.4g}) m"
        case Restart(seed=seed):
            return "restarted" + ("" if seed is None else f" with seed {seed}")


def _short(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
