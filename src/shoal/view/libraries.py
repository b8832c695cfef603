"""What the viewer needs beside the core."""

from importlib.util import find_spec

from shoal.core.errors import MissingExtraError


def require_libraries() -> None:
    """Refuse to begin without them.

    Raises
    ------
    MissingExtraError : one is not installed
    """
    for name in ("starlette", "uvicorn", "websockets"):
        if find_spec(name) is None:
            raise MissingExtraError.of(name, "viewer", "watching a run in a browser")
