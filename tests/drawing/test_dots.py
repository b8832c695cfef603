"""Specification of dots: very many buoys are such, those that report a target marks among them."""

from dataclasses import replace

import numpy as np
import pytest

from shoal.drawing import arena_drawing
from shoal.drawing.dots import dot_side
from shoal.drawing.snapshot import draw_snapshot


@pytest.fixture
def dotted(axes, make_record, marks, monkeypatch):
    """dotted(alive, on_target): image and marks of 3 fast and 2 slow buoys, drawn as dots."""

    def draw(alive=(), on_target=()):
        monkeypatch.setattr(arena_drawing, "MARKED", 4)
        record = make_record(counts=(3, 2))
        flags = {"alive": np.ones((40, 5), bool), "on_target": np.zeros((40, 5), bool)}
        flags["alive"][:, list(alive)] = False
        flags["on_target"][:, list(on_target)] = True
        draw_snapshot(axes, replace(record, trajectories={0: replace(record.trajectories[0], **flags)}))
        image = next(each for each in axes.images if each.get_gid() == "dots").get_array()
        return np.asarray(image), [len(marks(axes, f"fleet-{fleet}")[0].get_offsets()) for fleet in (0, 1)]

    return draw


class TestDots:
    def test_each_buoy_is_a_dot_in_the_color_of_its_fleet(self, dotted):
        image, marked = dotted()
        height, width = image.shape[:2]
        row, columns = np.nonzero(image[..., 3])
        assert len(row) == 5 * 9
        assert set(row - height // 2) == {0, 1, 2}
        assert sorted(set(columns))[0] == int((0 / 20 + 0.5) * width)
        left, right = image[row[0], columns.min()], image[row[0], columns.max()]
        assert left[:3] == pytest.approx([0.0, 0.447, 0.698], abs=0.01)
        assert right[:3] == pytest.approx([0.337, 0.706, 0.914], abs=0.01)
        assert marked == [0, 0]

    def test_who_is_not_there_is_not_drawn(self, dotted):
        assert np.count_nonzero(dotted(alive=[0, 4])[0][..., 3]) == 3 * 9

    def test_who_reports_a_target_is_a_mark(self, dotted):
        assert dotted(on_target=[0, 1, 4])[1] == [2, 1]

    def test_dots_are_as_large_as_leaves_water(self):
        assert [dot_side(360_000, agents) for agents in (2_001, 30_000, 100_000, 1_000_000)] == [3, 2, 1, 1]
