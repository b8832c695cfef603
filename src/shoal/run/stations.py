"""An even cover of the water, for strategies whose agents wait on stations, where there is a coast."""

from typing import Any

import numpy as np

from shoal.compiler.kernel import plain
from shoal.scenario.schema import Scenario
from shoal.world.sea.land import Land
from shoal.world.sea.land import clearance as _clearance

ROUNDS = 40
PLACES = 4000  # of water, at least, that the cover is worked out on
_GOLDEN = 0.6180339887498949
_clear: Any = plain(_clearance)  # one number takes longer to hand to compiled code than to work out


def stations(shore: Land, scenario: Scenario) -> Any:
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


def _water(shore: Land, half_x: float, half_y: float, agents: int) -> Any:
    """Middles of equal squares at sea, (P, 2) [m]."""
    side = np.sqrt(4.0 * half_x * half_y / max(PLACES, 20 * agents))
    x, y = (np.arange(-half + side / 2, half, side) for half in (half_x, half_y))
    places = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    free = np.array([_clear(shore, *place) for place in places])
    return places[free > 0.0]
