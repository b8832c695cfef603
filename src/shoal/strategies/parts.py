"""Building blocks that several strategies share."""

import math
from typing import Any

from shoal.compiler.kernel import kernel, overload
from shoal.compiler.lanes import bits_of, number_of, precision_of


@kernel
def inverse_power(me, other, exponent):
    """One term of the paper's repulsion without a_R^d: r_ij^-d (x_i - x_j) / r_ij  [m^-d]. OCEANS 2020, Eq. 4.

    me : Own, other : Report, x, y [m]; exponent : d [-]. The softening keeps agents at the same place finite: they give
    no push, having no direction.
    """
    dx = me.x - other.x
    dy = me.y - other.y
    square = dx * dx + (dy * dy + _SOFTENING)
    if exponent == 6.0:
        push = inverse_seventh(square)
    else:
        push = bounded_power(square, -0.5 * (exponent + 1.0))
    return push * dx, push * dy


def inverse_seventh(square: Any) -> Any:
    """r^-7 of r^2 > 0, to 1e-15 of itself, at less than half the cost of a division and a square root.

    The guess of 1/r by halving the exponent in its bits is off by 3.5 %; a polynomial of how far 1/r^2 is off leaves
    1e-6, and one of what is left then corrects the seventh power at once. Only sums and products that every processor
    rounds alike: the bits are the same everywhere.
    """
    inverse = number_of(_GUESS - (bits_of(square) >> 1))
    off = 1.0 - square * (inverse * inverse)
    inverse = inverse + inverse * (
        off * (0.49999917 + off * (0.37605677 + off * 0.31369143))
    )  # least error, |off| < 0.07
    inverse_square = inverse * inverse
    off = 1.0 - square * inverse_square
    seventh = (inverse_square * inverse_square) * (inverse_square * inverse)
    return seventh + seventh * (off * (3.5 + off * 7.875))  # (1 - off)^(-7/2)


def bounded_power(square: Any, exponent: Any) -> Any:
    """A power of r^2 >= 0 [m^2], finite under any exponent: zero distance times it is zero."""
    return min(raised(square, exponent), _LARGEST_PUSH)


_double_seventh, _double_power = kernel(inverse_seventh), kernel(bounded_power)


@kernel
def _single_seventh(square):
    """The same in single precision, whose division and root are fast."""
    square = square + _SINGLE_SOFTENING
    return 1.0 / (square * square * square * math.sqrt(square))


@kernel
def _single_power(square, exponent):
    """The same in single precision, where the other softening is zero."""
    return min(raised(square + _SINGLE_SOFTENING, exponent), _LARGEST_SINGLE)


@overload(inverse_seventh, inline="always")
def _seventh(square):
    chosen = _single_seventh if precision_of(square) == "float32" else _double_seventh
    return lambda square: chosen(square)


@overload(bounded_power, inline="always")
def _bounded(square, exponent):
    chosen = _single_power if precision_of(square) == "float32" else _double_power
    return lambda square, exponent: chosen(square, exponent)


@kernel
def power(base, exponent):
    """base^exponent, the usual one without a call of pow."""
    if exponent == 6.0:
        cube = base * base * base
        return cube * cube
    return raised(base, exponent)


def raised(base: float, exponent: float) -> float:
    """base^exponent, infinite where it is too large, in plain Python too."""
    try:
        return float(base**exponent)
    except (OverflowError, ZeroDivisionError):
        return math.inf


@kernel
def _to_the_power(base, exponent):
    return base**exponent


@overload(raised, inline="always")
def _raised(base, exponent):
    return lambda base, exponent: _to_the_power(base, exponent)


@kernel
def adapted(repulsion, contact, low, high, grow, shrink):
    """a_R after Algorithm 1 of OCEANS 2020, to the letter: test, then step, so it can end a step outside its range.

    A step larger than a_R ends at 0: there is no shorter distance.

    repulsion, low, high : a_R and its range [m]; contact : whether the agent or a neighbor is on target; grow, shrink :
    the steps of a_R without and with contact [m]
    """
    if contact:
        return max(repulsion - shrink, 0.0) if repulsion > low else repulsion
    return repulsion + grow if repulsion < high else repulsion


@kernel
def turned_from_walls(me, heading):
    """The heading [rad], mirrored where it would lead out of the area that the agent is at the edge of."""
    if abs(me.x) >= me.briefing.half_x and me.x * math.cos(heading) > 0.0:
        heading = math.pi - heading
    if abs(me.y) >= me.briefing.half_y and me.y * math.sin(heading) > 0.0:
        heading = -heading
    return heading


@kernel
def toward(me, x, y):
    """Velocity that reaches (x, y) in this step; the engine limits it to the top speed [m/s]."""
    rate = 1.0 / me.time_step
    return rate * (x - me.x), rate * (y - me.y)


@kernel
def waypoint_reached(me, x, y):
    """Whether agent `me` can be at the waypoint (x, y) [m] within this step, or land keeps it from there."""
    dx = x - me.x
    dy = y - me.y
    step = me.max_speed * me.time_step
    return dx * dx + dy * dy <= step * step or me.aground


@kernel
def inside(me, x, y):
    """The point of the area, where agents may go, that is nearest to (x, y) [m]."""
    half_x = me.briefing.half_x
    half_y = me.briefing.half_y
    return min(max(x, -half_x), half_x), min(max(y, -half_y), half_y)


@kernel
def own_station(me, spread):
    """The agent's place in the most even cover of this share of the area's sides, or of the water on its chart [m]."""
    if me.briefing.charted:
        return me.briefing.station_x, me.briefing.station_y
    return station(me.id, me.briefing.agents, spread * me.briefing.half_x, spread * me.briefing.half_y)


@kernel
def station(i, agents, half_x, half_y):
    """Place of agent i in the most even cover of a box of +- half_x, half_y by rows [m].

    Rows differ by one agent at most. Agents go to every n-th place, so that a fleet, whose ids follow each other,
    is spread over the whole box.
    """
    place = (i * _stride(agents)) % agents
    rows = rows_of(agents, half_x, half_y)
    row = (place * rows) // agents
    while (agents * (row + 1)) // rows <= place:
        row += 1
    first = (agents * row) // rows
    count = (agents * (row + 1)) // rows - first
    x = half_x * ((2.0 * (place - first) + 1.0) / count - 1.0)
    y = half_y * ((2.0 * row + 1.0) / rows - 1.0)
    return x, y


@kernel
def rows_of(agents, half_x, half_y):
    """Number of rows of a box of +- half_x, half_y [m] that makes the agents' parts nearly square."""
    return max(1, min(agents, int(math.sqrt(agents * half_y / half_x) + 0.5)))


@kernel
def on_snake(me, share):
    """The point `share` (0 to 1) along the snake that the area is divided into, in the middle of its row [m].

    The area is cut into rows, and a snake runs through them, east in the first and back west in the next. An agent's
    part is a piece of the snake as long as its share of the summed top speeds: all parts are searched equally fast.
    """
    rows = rows_of(me.briefing.agents, me.briefing.half_x, me.briefing.half_y)
    row = min(int(share * rows), rows - 1)
    along = 2.0 * (share * rows - row) - 1.0
    x = me.briefing.half_x * (along if row % 2 == 0 else -along)
    return x, me.briefing.half_y * ((2.0 * row + 1.0) / rows - 1.0)


@kernel
def middle_of_part(me):
    """The middle of the agent's part of the snake [m]."""
    return on_snake(me, 0.5 * (me.briefing.share_begin + me.briefing.share_end))


@kernel
def size_of_part(me):
    """Area of the agent's part [m^2]."""
    return 4.0 * me.briefing.half_x * me.briefing.half_y * (me.briefing.share_end - me.briefing.share_begin)


@kernel
def _stride(agents):
    """A step near agents / golden ratio^2 that meets every place once: it has no divisor in common with agents."""
    stride = max(1, int(0.381966 * agents))
    while _common_divisor(stride, agents) != 1:
        stride += 1
    return stride


@kernel
def _common_divisor(a, b):
    while b != 0:
        a, b = b, a % b
    return a


_GUESS = 0x5FE6E90AB4188FA9  # the bits of 1/r are about this less half those of r^2
_LARGEST_PUSH = 1e100  # finite under any exponent, so that zero distance times it is zero
_LARGEST_SINGLE = 1e30
_SINGLE_SOFTENING = 1e-10  # [m^2]: a hundredth of a millimeter
_SOFTENING = 1e-60  # [m^2]: below the last digit of any distance that is not zero
