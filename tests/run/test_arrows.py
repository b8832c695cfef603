"""Where arrows of the current are drawn."""

import numpy as np

from shoal.run.arrows import arrow_places
from shoal.scenario.schema import Area
from shoal.sea.raster import Raster


def test_they_are_the_middles_of_squares():
    places, apart = arrow_places(Area(width=130.0, height=20.0), None)
    assert apart == 10.0
    assert sorted(set(places[:, 1])) == [-5.0, 5.0]
    assert places[:, 0].min() == -60.0
    assert len(places) == 26


def test_none_is_on_land():
    x = np.arange(-65.0, 66.0, 1.0)
    land = Raster(np.tile(x, (21, 1)).astype(np.float32), -65.0, -10.0, 1.0)  # west of 0
    places, _ = arrow_places(Area(width=130.0, height=20.0), land)
    assert places[:, 0].min() > 1.0
