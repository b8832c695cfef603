"""The paper's step in NVIDIA Warp on a processor: a thread is a replicate, a kernel many steps of it."""

# ruff: noqa: RUF046, UP018 (int(0) is a number that a loop may change, 0 a constant)

import numpy as np
import warp as wp

import paper as p
from paper import SEED, C, K, N, measure, start

REPLICATES = 16
FAST = int(np.argmin(p.MAX_SPEED))  # agents before this one
SPEEDS = wp.constant(wp.vec2d(p.MAX_SPEED[0], p.MAX_SPEED[-1]))
Squares = wp.types.vector(length=N, dtype=wp.float64)
W = wp.float64


@wp.func
def within(squares: Squares, reach: W) -> int:
    """How many are no farther."""
    count = int(0)
    for j in range(N):
        count += wp.where(squares[j] <= reach, 1, 0)
    return count


@wp.func
def next_out(squares: Squares, reach: W) -> W:
    """The smallest square beyond."""
    least = wp.float64(1e30)
    for j in range(N):
        least = wp.where(squares[j] > reach, wp.min(least, squares[j]), least)
    return least


@wp.func
def next_in(squares: Squares, reach: W) -> W:
    """The largest square that is no farther."""
    most = wp.float64(0.0)
    for j in range(N):
        most = wp.where(squares[j] <= reach, wp.max(most, squares[j]), most)
    return most


@wp.func
def nearest(squares: Squares, before: W) -> W:
    """Within which the K nearest lie: most often as far as in the step before, or one agent more or less."""
    reach = wp.float64(before)
    count = within(squares, reach)
    while count < K:
        reach = next_out(squares, reach)
        count += 1
    while count > K:
        reach = next_in(squares, reach) * W(1.0 - 1e-15)
        count -= 1
    return reach


@wp.kernel
def advance(
    steps: int, seed: int, x: wp.array2d(dtype=wp.vec2d), v: wp.array2d(dtype=wp.vec2d), a: wp.array2d(dtype=W),
    reach: wp.array2d(dtype=W), targets: wp.array2d(dtype=wp.vec2d), since: wp.array(dtype=int),
    moved: wp.array2d(dtype=wp.vec2d), on: wp.array2d(dtype=int), found: wp.array(dtype=int),
):  # fmt: skip
    """Some steps of a replicate; `targets` are its target's place, waypoint and heading."""
    r = wp.tid()
    chance = wp.rand_init(seed, r)
    for _ in range(steps):
        target = targets[r, 0]
        anybody = int(0)
        for i in range(N):
            on[r, i] = wp.where(wp.length_sq(x[r, i] - target) <= W(p.RHO * p.RHO), 1, 0)
            anybody = wp.max(anybody, on[r, i])
        found[r] += anybody
        for i in range(N):
            here = x[r, i]
            squares = Squares()
            for j in range(N):
                squares[j] = wp.length_sq(here - x[r, j])
            squares[i] = W(1e29)
            reach[r, i] = nearest(squares, reach[r, i])
            best = int(i)
            least = wp.float64(1e30)
            push = wp.vec2d()
            for j in range(N):
                if squares[j] <= reach[r, i]:
                    s = squares[j]
                    push += (here - x[r, j]) / (s * s * s * wp.sqrt(s))  # r^-6 along a vector of length r
                    if on[r, j] == 1 and s < least:
                        best = j
                        least = s
            draw = W(wp.randf(chance))
            change = wp.where(a[r, i] < W(p.A_MAX), W(p.A_STEP), W(0.0))
            if on[r, i] == 1 or best != i:
                change = wp.where(a[r, i] > W(p.A_MIN), -W(p.A_STEP), W(0.0))
            a[r, i] += change
            wanted = W(p.OMEGA) * v[r, i] + wp.pow(a[r, i], W(6.0)) * push
            if on[r, i] == 0:
                wanted += W(C) * draw * (x[r, best] - here)
            fastest = wp.where(i < FAST, SPEEDS[0], SPEEDS[1])
            moved[r, i] = wanted * wp.min(W(1.0), fastest / wp.max(wp.length(wanted), W(1e-99)))
        for i in range(N):
            goal = x[r, i] + moved[r, i]
            stop = wp.vec2d(wp.clamp(goal[0], W(-p.WALL), W(p.WALL)), wp.clamp(goal[1], W(-p.WALL), W(p.WALL)))
            east = wp.where(stop[0] != goal[0], stop[0] - x[r, i][0], moved[r, i][0])
            north = wp.where(stop[1] != goal[1], stop[1] - x[r, i][1], moved[r, i][1])
            v[r, i] = wp.vec2d(east, north)
            x[r, i] = stop
        there, heading = targets[r, 1] - target, targets[r, 2]
        turn = wp.atan2(heading[0] * there[1] - heading[1] * there[0], wp.dot(heading, there))
        turn = wp.clamp(turn, W(-p.TURN), W(p.TURN))
        s, c = wp.sin(turn), wp.cos(turn)
        targets[r, 2] = wp.vec2d(c * heading[0] - s * heading[1], s * heading[0] + c * heading[1])
        targets[r, 0] = target + W(p.SPEED) * targets[r, 2]
        since[r] += 1
        if wp.length(targets[r, 1] - targets[r, 0]) < W(p.REACHED) or since[r] >= p.PATIENCE:
            since[r] = 0
            targets[r, 1] = W(p.MARGIN) * wp.vec2d(W(wp.randf(chance, -1.0, 1.0)), W(wp.randf(chance, -1.0, 1.0)))


if __name__ == "__main__":
    wp.config.quiet = True
    with wp.ScopedDevice("cpu"):
        shape = (REPLICATES, N)
        state = [
            wp.array(start(REPLICATES, np.random.default_rng(SEED)), dtype=wp.vec2d), wp.zeros(shape, dtype=wp.vec2d),
            wp.full(shape, p.A_START, dtype=W), wp.full(shape, 50.0, dtype=W),
            wp.array(np.tile([[0.0, 0.0], [3.0, 4.0], [1.0, 0.0]], (REPLICATES, 1, 1)), dtype=wp.vec2d),
            wp.zeros(REPLICATES, dtype=int), wp.zeros(shape, dtype=wp.vec2d), wp.zeros(shape, dtype=int),
        ]  # fmt: skip
        calls = iter(range(1_000_000 * SEED, 10**9))

        def run(steps: int) -> int:
            """Steps at which anybody was on target."""
            found = wp.zeros(REPLICATES, dtype=int)
            wp.launch(advance, dim=REPLICATES, inputs=[steps, next(calls), *state, found])
            return int(found.numpy().sum())

        measure(run, 150, REPLICATES, "f64", wp.__version__)
