"""An even cover of the water, for strategies whose agents wait on stations, where there is a coast."""

from typing import TYPE_CHECKING, Any

import numpy as np

from shoal.scenario.schema import Scenario

if TYPE_CHECKING:
    from shoal.sea.raster import Raster

ROUNDS = 40
PLACES = 4000  # of water, at least, that the cover is worked out on
_GOLDEN = 0.6180339887498949


def stations(scenario: Scenario, shore: "Raster") -> Any:
    """Return a place for each agent, (N, 2) [m]: the middle of the water that is nearer to it than to all others.

    Lloyd's algorithm ("Least squares quantization in PCM", 1982), on some thousand places at sea, from a sequence that
    jumps by the golden ratio: so agents of a fleet, whose ids follow each other, are spread over all of the water.
    """
    from scipy.spatial import KDTree

    agents, area = scenario.agents, scenario.area
    water = _water(shore, area.width / 2 - area.agent_margin, area.height / 2 - area.agent_margin, agents)
    centers = water[(np.arange(agents) * _GOLDEN % 1.0 * len(water)).astype(np.int64)]
    for _ in range(ROUNDS):
        whose = KDTree(centers).query(water)[1]
        count = np.bincount(whose, minlength=agents)
        sums = np.stack([np.bincount(whose, each, agents) for each in water.T], axis=-1)
        centers = np.where(count[:, None] > 0, sums / np.maximum(count, 1)[:, None], centers)
    return water[KDTree(water).query(centers)[1]]  # where the middle lies on land, the water that is nearest


def _water(shore: "Raster", half_x: float, half_y: float, agents: int) -> Any:
    """Middles of equal squares that lie at sea, a cell off the shore where there are such, (P, 2) [m]."""
    side = np.sqrt(4.0 * half_x * half_y / max(PLACES, 20 * agents))
    x, y = (np.arange(-half + side / 2, half, side) for half in (half_x, half_y))
    places = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    rows, columns = shore.distance.shape
    i = np.clip(np.rint((places[:, 0] - shore.x0) / shore.cell).astype(int), 0, columns - 1)
    j = np.clip(np.rint((places[:, 1] - shore.y0) / shore.cell).astype(int), 0, rows - 1)
    free = shore.distance[j, i]
    return places[free > (shore.cell if (free > shore.cell).any() else 0.0)]
