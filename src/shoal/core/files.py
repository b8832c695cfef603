"""Files that are whole or not there: written beside their place, and moved there when complete."""

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from uuid import uuid4

from shoal.core.errors import RecordError


@contextmanager
def whole_file(path: str | Path) -> Iterator[Path]:
    """Yield a place to write to; what is there at the end becomes the file, replacing one of its name.

    Whatever ends it else, an interrupt too, leaves nothing, and what was there before is untouched.

    Raises
    ------
    RecordError : the operating system refuses
    """
    file = Path(path)
    partial = file.with_name(f".{file.name}.{uuid4().hex}.partial")
    try:
        yield partial
        partial.replace(file)
    except OSError as error:
        problem = f"cannot be written: {error.strerror or error}"
        raise RecordError(str(file), problem, "name a file in a folder that exists and you may write") from error
    finally:
        with suppress(OSError):
            partial.unlink(missing_ok=True)


def write_whole(path: str | Path, content: bytes) -> None:
    """Write a file that is either complete or not there.

    Raises
    ------
    RecordError : it cannot be written
    """
    with whole_file(path) as partial:
        partial.write_bytes(content)
