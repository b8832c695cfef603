"""Where arrows of the current are drawn: the middles of squares off the shore."""

from typing import Any

import numpy as np

from shoal.scenario.schema import Area

ARROWS = 13  # along the longer side


def arrow_places(area: Area, land: Any, count: int = ARROWS) -> tuple[Any, float]:
    """Return the places (P, 2) [m], and how far apart they are [m].

    Parameters
    ----------
    area : the arena
    land : its raster of land, None on open water
    count : arrows along the longer side
    """
    apart = max(area.width, area.height) / count
    x, y = (_middles(side, apart) for side in (area.width, area.height))
    places = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    return (places if land is None else places[_at_sea(land, places)]), apart


def _middles(side: float, apart: float) -> Any:
    count = max(1, round(side / apart))
    return side * ((np.arange(count) + 0.5) / count - 0.5)


def _at_sea(raster: Any, places: Any) -> Any:
    """Which places (P, 2) are off the shore by a cell."""
    rows, columns = raster.distance.shape
    i = np.clip(np.rint((places[:, 0] - raster.x0) / raster.cell).astype(int), 0, columns - 1)
    j = np.clip(np.rint((places[:, 1] - raster.y0) / raster.cell).astype(int), 0, rows - 1)
    return raster.distance[j, i] > raster.cell
