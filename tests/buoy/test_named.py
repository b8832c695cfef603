"""Buoys by their numbers, in words."""

import pytest

from shoal.buoy.named import buoys_of


@pytest.mark.parametrize(
    ("ids", "said"),
    [
        ([7], "buoy 7"),
        ([2, 4], "buoys 2, 4"),
        ([4, 3, 9, 5, 6, 6], "buoys 3-6, 9"),
        (range(25), "buoys 0-24"),
        ([1, 2, 9, 10], "buoys 1-2, 9-10"),
    ],
)
def test_one_is_a_buoy_and_runs_are_one_range(ids, said):
    assert buoys_of(ids) == said
