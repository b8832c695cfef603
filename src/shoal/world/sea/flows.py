"""Flows with a formula, for places without data and for tests with known answers."""

import math

from shoal.compiler.kernel import kernel

FLOWS = ("uniform", "tide", "gyre", "eddy", "rotation")  # in the order of `flow`


@kernel
def flow(kind, numbers, x, y, time):
    """Velocity of a flow at a place [m] and time [s], along x and y [m/s]; kind : index into FLOWS."""
    if kind == 0:
        return numbers[0], numbers[1]
    if kind == 1:
        return tide(numbers, x, y, time)
    if kind == 2:
        return gyre(numbers, x, y)
    if kind == 3:
        return eddy(numbers, x, y, time)
    return -numbers[0] * (y - numbers[2]), numbers[0] * (x - numbers[1])


@kernel
def tide(numbers, x, y, time):
    """A tidal ellipse over a mean flow: mean + major axis cos(phase) + minor axis sin(phase).

    numbers : mean x, y, semi-major x, y, semi-minor x, y [m/s], angular frequency [1/s], phase at the start [rad]
    """
    phase = numbers[6] * time + numbers[7]
    along = math.cos(phase)
    across = math.sin(phase)
    return numbers[0] + numbers[2] * along + numbers[4] * across, numbers[1] + numbers[3] * along + numbers[5] * across


@kernel
def gyre(numbers, x, y):
    """A closed gyre in a box, psi = U L / pi sin(pi x / L) sin(pi y / L): fastest, U, at the middles of its sides.

    numbers : U [m/s], side L [m], center x, y [m]; counterclockwise where U > 0. Still outside of the box.
    """
    speed, side = numbers[0], numbers[1]
    a = (x - numbers[2]) / side + 0.5
    b = (y - numbers[3]) / side + 0.5
    if a < 0.0 or a > 1.0 or b < 0.0 or b > 1.0:
        return 0.0, 0.0
    u = speed * math.sin(math.pi * a) * math.cos(math.pi * b)
    v = -speed * math.cos(math.pi * a) * math.sin(math.pi * b)
    return u, v


@kernel
def eddy(numbers, x, y, time):
    """A Gaussian vortex that moves: speed U at its radius R, U (r / R) exp((1 - r^2 / R^2) / 2) around its center.

    numbers : U [m/s], R [m], center at the start x, y [m], its velocity x, y [m/s]; counterclockwise where U > 0
    """
    radius = numbers[1]
    dx = (x - numbers[2] - numbers[4] * time) / radius
    dy = (y - numbers[3] - numbers[5] * time) / radius
    speed = numbers[0] * math.exp(0.5 * (1.0 - dx * dx - dy * dy))
    return numbers[4] - speed * dy, numbers[5] + speed * dx
