"""The referee of the fast engine: the paper's model of shoal/reference.py, with its options, its target and its sums.

Kwa, Tokic, Yue, Bouffanais, "Heterogeneous Swarms for Maritime Dynamic Target Search and Tracking", OCEANS
2020 ("the paper"), and its homogeneous predecessor, Kwa, Leong Kit, Bouffanais, "Optimal Swarm Strategy for
Dynamic Target Search and Tracking", AAMAS 2020.

Of `shoal`, this file imports the reference alone, which imports nothing of ours: nothing here is shared with what it
judges. It keeps the symbols of the paper and works in arena units per step: side 20, so [-10, 10]^2; 1 unit = 1 m;
1 step = 0.1 s; 1 m/s = 0.1 unit per step. Chance is injected: the caller hands over the draws of a step, so that
another engine's draws can be replayed.
"""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from shoal.reference import Paper, Swarm, length

A_START = math.sqrt(math.pi * 2.0**2 / 50)  # 0.5013, a_R of every agent at the start, R = 2
ARENA_HALF = 10.0
PHI_CENTERS = np.linspace(-1.0, 1.0, 11)
SLOW, FAST = 0.10, 0.26  # top speeds of BoB-0 and BoB-1, 1.0 and 2.6 m/s


@dataclass(frozen=True, eq=False)
class Model(Paper):
    """Every switch of the model, and the target's walk. Speeds in units per step; defaults are those of the paper."""

    update: Literal["synchronous", "sequential"] = "synchronous"
    follow: Literal["nearest", "lowest-index"] = "nearest"
    speed_rule: Literal["cap", "divide"] = "cap"  # divide: the paper's v <- v / vmax, vmax in m/s
    per_axis_r: bool = False  # draw r for x and for y: r is (N, 2)
    target_speed: float = 0.3
    target_half_x: float = 8.0  # half widths of the box that waypoints are drawn in
    target_half_y: float = 8.0
    turn_max: float = math.radians(20)  # [rad per step]
    waypoint_reach: float = 1.5
    waypoint_patience: int = 200  # [steps]

    def __post_init__(self):
        object.__setattr__(self, "max_speed", np.array(self.max_speed, dtype=float))
        assert self.max_speed.ndim == 1
        assert 1 <= self.k <= self.n - 1
        assert self.update in ("synchronous", "sequential")
        assert self.follow in ("nearest", "lowest-index")
        assert self.speed_rule in ("cap", "divide")

    @property
    def n(self) -> int:
        """Number of agents."""
        return len(self.max_speed)

    def turns(self, agents):
        """All at once, or one by one, the later seeing the moved ones."""
        return super().turns(agents) if self.update == "synchronous" else np.arange(agents)[:, None]

    def neighborhood_best(self, f, near, i):
        """The nearest neighbor on target, or the one of the lowest index."""
        if self.follow == "nearest":
            return super().neighborhood_best(f, near, i)
        lowest = np.where(f[near], near, self.n).min(axis=1)
        return np.where(f[i], i, np.where(lowest < self.n, lowest, -1))

    def limited(self, v, max_speed):
        """Scaled down to the top speed, or divided by it in m/s."""
        return super().limited(v, max_speed) if self.speed_rule == "cap" else v / (10.0 * max_speed)[:, None]


@dataclass(eq=False)
class State:
    """All that changes from step to step."""

    x: np.ndarray  # (N, 2) positions
    v: np.ndarray  # (N, 2) velocities
    a: np.ndarray  # (N,) repulsion strengths, a_R
    target: np.ndarray  # (2,) position
    heading: np.ndarray  # (2,) unit vector, the target's
    waypoint: np.ndarray  # (2,) where the target is bound
    steps_on_waypoint: int = 0

    def copy(self) -> "State":
        """Return a state that shares no array with this one."""
        arrays = (self.x, self.v, self.a, self.target, self.heading, self.waypoint)
        return State(*(np.array(array, dtype=float) for array in arrays), self.steps_on_waypoint)


@dataclass(frozen=True, eq=False)
class Measures:
    """What one step shows."""

    f_any: bool  # somebody is on target, before the move
    on_target_count: int  # how many are
    on_target: np.ndarray  # (N,) bool, f_i = -1
    fluctuations: np.ndarray  # (N,) |v_i - mean v|, velocities at the start of the step
    phi: np.ndarray  # (N,) cosine between heading and bearing to the target
    phi_bin: np.ndarray  # (N,) int, index into PHI_CENTERS
    followed: np.ndarray  # (N,) int, whose position was Nbest: i itself if on target, -1 if nobody's
    neighbors: np.ndarray  # (N, k) int, sorted by (distance, index), as each agent saw them when it moved


@dataclass(frozen=True, eq=False)
class Averages:
    """What many steps show."""

    time_on_target: float  # share of steps with somebody on target
    xi: float  # Xi of the paper's Eq. 7, norms taken: xi_raw / mean top speed
    xi_raw: float  # mean over steps and agents of |v_i - mean v|
    response: float  # mean over steps of the sum over agents of |v_i - mean v|
    phi_histogram: np.ndarray  # (11,) mean agents per step and bin; sums to N
    state: State  # at the end


def step(model: Model, state: State, r: np.ndarray, new_waypoint: np.ndarray) -> tuple[State, Measures]:
    """Return the state one step later and what the step shows. `state` is left as it was.

    r : the step's draws from U(0, 1), (N,), or (N, 2) under `per_axis_r`
    new_waypoint : (2,), taken up only if the target needs one in this step
    """
    assert np.shape(r) == ((model.n, 2) if model.per_axis_r else (model.n,))
    swarm, seen = model.algorithm_2(Swarm(state.x, state.v, state.a), state.target, np.asarray(r))
    new = State(*swarm, state.target, state.heading, state.waypoint, state.steps_on_waypoint).copy()
    move_target(model, new, new_waypoint)
    return new, Measures(
        f_any=bool(seen.on_target.any()),
        on_target_count=int(seen.on_target.sum()),
        phi_bin=bin_of(seen.phi),
        **seen._asdict(),
    )


def move_target(model, state, new_waypoint):
    """Turn to the waypoint, the shorter way, at most turn_max; advance; perhaps renew the waypoint.

    Works on `state` in place. A waypoint exactly behind is turned to by the left; one exactly underneath
    calls for no turn.
    """
    (hx, hy), (wx, wy) = state.heading.tolist(), (state.waypoint - state.target).tolist()
    cross, dot = hx * wy - hy * wx, hx * wx + hy * wy
    if wx == 0.0 and wy == 0.0:
        angle = 0.0
    elif cross == 0.0 and dot < 0.0:
        angle = math.pi
    else:
        angle = math.atan2(cross, dot)
    turn = max(-model.turn_max, min(model.turn_max, angle))
    hx, hy = hx * math.cos(turn) - hy * math.sin(turn), hx * math.sin(turn) + hy * math.cos(turn)
    state.heading = np.array([hx, hy]) / math.hypot(hx, hy)  # rounding must not add up to another speed
    state.target = state.target + model.target_speed * state.heading

    state.steps_on_waypoint += 1
    remaining = math.hypot(*(state.waypoint - state.target))
    if remaining < model.waypoint_reach or state.steps_on_waypoint >= model.waypoint_patience:
        state.waypoint = np.array(new_waypoint, dtype=float)
        state.steps_on_waypoint = 0


def bin_of(phi):
    """Index of the bin, 0.2 wide around -1, -0.8, ..., 1; a value on an edge belongs to the upper bin."""
    return np.floor(5.0 * np.asarray(phi) + 5.5).astype(int)


def random_start(model: Model, rng: np.random.Generator) -> State:
    """Agents uniform in the arena, at rest; target and waypoint uniform in their box, heading for it."""
    target, waypoint = random_waypoint(model, rng), random_waypoint(model, rng)
    return State(
        x=rng.uniform(-ARENA_HALF, ARENA_HALF, (model.n, 2)),
        v=np.zeros((model.n, 2)),
        a=np.full(model.n, A_START),
        target=target,
        heading=(waypoint - target) / length(waypoint - target),
        waypoint=waypoint,
    )


def random_waypoint(model: Model, rng: np.random.Generator) -> np.ndarray:
    """Uniform in the target's box."""
    half = np.array([model.target_half_x, model.target_half_y])
    return rng.uniform(-half, half)


def run(model: Model, state: State, steps: int, rng: np.random.Generator) -> Averages:
    """Return the averages of `steps` steps from `state`, which is left as it was."""
    shape = (model.n, 2) if model.per_axis_r else (model.n,)
    found = 0
    response = 0.0
    histogram = np.zeros(len(PHI_CENTERS))
    for _ in range(steps):
        state, seen = step(model, state, rng.random(shape), random_waypoint(model, rng))
        found += seen.f_any
        response += seen.fluctuations.sum()
        histogram += np.bincount(seen.phi_bin, minlength=len(PHI_CENTERS))
    xi_raw = response / steps / model.n
    return Averages(
        time_on_target=found / steps,
        xi=model.xi(xi_raw),
        xi_raw=xi_raw,
        response=response / steps,
        phi_histogram=histogram / steps,
        state=state,
    )


def oceans2020(fast: int = 15, k: int = 20, target_speed: float = 0.3) -> Model:
    """The paper as printed: 50 agents, of which the first `fast` are BoB-1 and the others BoB-0."""
    return Model(max_speed=np.repeat([FAST, SLOW], [fast, 50 - fast]), k=k, target_speed=target_speed)


def aamas2020(k: int, target_speed: float = 0.2) -> Model:
    """The published homogeneous data: R + 0.1 up and R - 0.2 down, where a_R = sqrt(pi R^2 / 50)."""
    per_radius = math.sqrt(math.pi / 50)
    return Model(
        max_speed=np.full(50, SLOW),
        k=k,
        omega=0.5,
        a_up=0.1 * per_radius,
        a_down=0.2 * per_radius,
        update="sequential",
        follow="lowest-index",
        target_speed=target_speed,
    )


def aamas2020_constant(k: int, target_speed: float = 0.2) -> Model:
    """The published homogeneous data with a constant repulsion: a_R stays what it is at the start."""
    return Model(
        max_speed=np.full(50, SLOW),
        k=k,
        omega=0.5,
        a_up=0.0,
        a_down=0.0,
        update="sequential",
        follow="lowest-index",
        target_speed=target_speed,
    )
