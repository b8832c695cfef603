"""Folders that nobody else could have written: numba unpickles what lies in its cache, and so runs it."""

import os
import stat
from pathlib import Path


def make_private(folder: Path) -> None:
    """Make a folder, and the parents it lacks, for this user alone.

    Raises
    ------
    OSError : it cannot be made, or somebody else could have written into it
    """
    for each in (*reversed(folder.parents), folder):
        if not os.path.lexists(each):
            each.mkdir(mode=0o700, exist_ok=True)
    if why := strangers(folder):
        raise PermissionError(why)


def strangers(folder: Path) -> str | None:
    """Say why somebody else could have written into a folder; None if nobody could.

    It has to be ours, private (0700) and no link, and nobody else may replace it or a folder on the way to it.
    """
    if not hasattr(os, "geteuid"):
        return None  # Windows: a user's own folders are the user's
    found = folder.lstat()
    if not stat.S_ISDIR(found.st_mode):
        return f"{folder} is a link or no folder"
    if found.st_uid != os.geteuid() or stat.S_IMODE(found.st_mode) & 0o077:
        return f"{folder} is not private (0700)"
    on_the_way = dict.fromkeys((*folder.absolute().parents, *folder.resolve().parents))
    return next((f"{each} can be written by others" for each in on_the_way if _is_open(each)), None)


def _is_open(parent: Path) -> bool:
    """Whether somebody else can replace what is in a folder: sticky ones such as /tmp keep each their own."""
    found = parent.stat()
    if found.st_uid not in (0, os.geteuid()):
        return True
    if found.st_mode & stat.S_ISVTX:
        return False
    return bool(found.st_mode & stat.S_IWOTH or (found.st_mode & stat.S_IWGRP and not _is_own_group(found.st_gid)))


def _is_own_group(group: int) -> bool:
    """Whether a group is the one that many systems give each user alone."""
    import grp
    import pwd

    try:
        known, user = grp.getgrgid(group), pwd.getpwuid(os.geteuid())
    except KeyError:
        return False
    return known.gr_name == user.pw_name and set(known.gr_mem) <= {user.pw_name}
