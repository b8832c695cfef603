"""Buoys by their numbers, in words."""

from collections.abc import Iterable


def buoys_of(ids: Iterable[int]) -> str:
    """Name buoys, runs of numbers as one: "buoy 7", "buoys 3-6, 9".

    Parameters
    ----------
    ids : their numbers, in any order
    """
    runs: list[list[int]] = []
    for id in sorted(set(ids)):
        if runs and runs[-1][-1] == id - 1:
            runs[-1].append(id)
        else:
            runs.append([id])
    named = ", ".join(str(run[0]) if len(run) == 1 else f"{run[0]}-{run[-1]}" for run in runs)
    return f"buoy{'' if runs and len(runs[0]) == len(runs) == 1 else 's'} {named}"
