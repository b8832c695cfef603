"""Bulletins made by hand, of a fleet of five buoys on a chart: no engine runs."""

import numpy as np

from shoal.viewer.bulletin import Bulletin
from shoal.viewer.frame import Gauges, pack
from shoal.viewer.scene import scene_of
from voyages import ORIGIN, made_record

RECORD = made_record()
FRAMES = RECORD.trajectories[0]
GAUGES = Gauges(0.5, float("nan"), 0.25, 0.75, 7.0, np.arange(11.0))
SCENE = scene_of(RECORD.scenario, FRAMES.memory, has_links=False)


def bulletin(at=0, **others):
    """What is said at a frame of three, with some parts changed."""
    frame = pack(FRAMES, at, run=0, epoch=0, gauges=GAUGES)
    return Bulletin(SCENE, ORIGIN, 1.0, None, frame)._replace(**others)
