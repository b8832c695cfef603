"""Which fleets look promising: those that add most to the front, by surrogates of what was tried so far.

Points of the Halton sequence, others in every call, are candidates. What was tried counts as the surrogate has it, too,
so that a lucky run does not hide what is better on average.
"""

from collections.abc import Sequence

import numpy as np

from shoal.experiments.design import Point
from shoal.experiments.fleet_trial import FleetSearch, FleetTrial
from shoal.experiments.front import front, gains
from shoal.experiments.surrogate import Floats, Surrogate, halton, surrogate

CANDIDATES = 1500
FEWEST = 6  # trials with a value, below which nothing is expected
MOST = 300  # trials that surrogates are made of, the newest


def promising(search: FleetSearch, tried: Sequence[FleetTrial], count: int, begin: int) -> list[Point]:
    """Return up to `count` points that were not tried and look best.

    Parameters
    ----------
    search, tried : what is designed, and its trials so far
    begin : a number of the call: others look at other candidates
    """
    known = [each for each in tried if each.known][-MOST:]
    if len(known) < FEWEST:
        return []
    less, more = _surrogates(search, known)
    taken = {_key(search, {**search.start, **each.point}) for each in tried}
    shares = halton(CANDIDATES, begin * CANDIDATES, len(search.searched))
    points = [
        {each.field: each.spread(share) for each, share in zip(search.searched, row, strict=True)} for row in shares
    ]
    points = [each for each in points if search.agents(each) > 1 and _key(search, each) not in taken]
    if not points:
        return []
    places = _places(search, points)
    costs, values = less(places), more(places)
    own = _places(search, [{**search.start, **each.point} for each in known])
    front_costs, front_values = list(less(own)), list(more(own))
    worst = max(float(costs.max()), max(front_costs))
    found: list[Point] = []
    for _ in range(min(count, len(points))):
        added = gains(costs, values, (front_costs, front_values), worst)
        at = int(np.argmax(added))
        if added[at] <= 0:
            break
        found.append(points[at])
        front_costs.append(costs[at])
        front_values.append(values[at])
    return found


def expected_front(search: FleetSearch, tried: Sequence[FleetTrial]) -> list[FleetTrial]:
    """Return those of the trials that are on the front by surrogates of all of them."""
    known = [each for each in tried if each.known][-MOST:]
    if len(known) < FEWEST:
        return []
    places = _places(search, [{**search.start, **each.point} for each in known])
    less, more = _surrogates(search, known)
    return [known[at] for at in front(less(places), more(places))]


def _surrogates(search: FleetSearch, known: Sequence[FleetTrial]) -> tuple[Surrogate, Surrogate]:
    places = _places(search, [{**search.start, **each.point} for each in known])
    means = np.array([each.means for each in known])
    return surrogate(places, means[:, 0]), surrogate(places, means[:, 1])


def _places(search: FleetSearch, points: Sequence[Point]) -> Floats:
    return np.array([[each.share(point.get(each.field)) for each in search.searched] for point in points])


def _key(search: FleetSearch, point: Point) -> tuple[object, ...]:
    return tuple(point.get(each.field) for each in search.searched)
