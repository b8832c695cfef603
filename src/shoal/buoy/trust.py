"""Whom buoys listen to: the key of orders, and the configuration of the mesh."""

import os
import re
import secrets
import stat
from pathlib import Path
from typing import NamedTuple

from shoal.core.errors import FleetError
from shoal.core.orders import KEY_BYTES

_LARGEST = 4096  # bytes of a file that holds a key


class Trust(NamedTuple):
    """Whom buoys listen to.

    command_key : file of the key that orders are sealed with; None: no order is obeyed
    mesh_config : file of zenoh's own configuration, with certificates; None: whoever reaches the mesh is heard
    """

    command_key: Path | None = None
    mesh_config: Path | None = None


NOBODY = Trust()  # no orders are obeyed, and the mesh is as it comes


def read_key(file: Path) -> bytes:
    """Return the key in a file: hexadecimal digits.

    Raises
    ------
    FleetError : it is absent, holds no key, or others may read it
    """
    try:
        with file.open("rb") as stream:
            mode, content = os.fstat(stream.fileno()).st_mode, stream.read(_LARGEST)
    except OSError as error:
        fix = "name the file that `shoal fleet --command-key FILE` made"
        raise FleetError(str(file), error.strerror or "cannot be read", fix) from None
    if os.name == "posix" and mode & (stat.S_IRWXG | stat.S_IRWXO):
        raise FleetError(str(file), "can be read or written by others, who could give orders", f"chmod 600 {file}")
    text = content.decode("ascii", "replace").strip()
    if not re.fullmatch(rf"([0-9a-fA-F]{{2}}){{{KEY_BYTES},512}}", text):
        problem = f"holds no key: {KEY_BYTES} bytes or more, in hexadecimal digits"
        raise FleetError(str(file), problem, "let `shoal fleet --command-key` make a new file")
    return bytes.fromhex(text)


def key_in(file: Path) -> bytes:
    """Return the key in a file, which is made if it is not there.

    Raises
    ------
    FleetError : see `read_key`; or it cannot be made
    """
    try:
        handle = os.open(file, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
    except FileExistsError:
        return read_key(file)
    except OSError as error:
        raise FleetError(str(file), error.strerror or "cannot be made", "name a file in a folder of yours") from None
    with os.fdopen(handle, "w", encoding="ascii") as stream:
        stream.write(secrets.token_hex(KEY_BYTES) + "\n")
    return read_key(file)
