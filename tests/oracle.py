"""The paper's model in slow, plain NumPy: the referee of the fast engine.

Kwa, Tokic, Yue, Bouffanais, "Heterogeneous Swarms for Maritime Dynamic Target Search and Tracking", OCEANS
2020 ("the paper"), and its homogeneous predecessor, Kwa, Leong Kit, Bouffanais, "Optimal Swarm Strategy for
Dynamic Target Search and Tracking", AAMAS 2020.

This file never imports `shoal`; nothing here is shared with what it judges. It keeps the symbols of the paper
and works in arena units per step: side 20, so [-10, 10]^2; 1 unit = 1 m; 1 step = 0.1 s; 1 m/s = 0.1 unit per
step. Chance is injected: the caller hands over the draws of a step, so that another engine's draws can be
replayed.

Three choices a reader may look for:

* Two squared distances are compared, exactly, never two square roots; a tie goes to the lower index.
* On the axis where the arena clamps an agent, and only there, v becomes the displacement really made. An
  agent that starts beyond the clamp is therefore pulled in at its first step, and its velocity may exceed its
  top speed.
* An agent follows itself (`followed[i] == i`) when it is on target, nobody (-1) when neither it nor a
  neighbor is.
"""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

A_START = math.sqrt(math.pi * 2.0**2 / 50)  # 0.5013, a_R of every agent at the start, R = 2
ARENA_HALF = 10.0
PHI_CENTERS = np.linspace(-1.0, 1.0, 11)
SLOW, FAST = 0.10, 0.26  # top speeds of BoB-0 and BoB-1, 1.0 and 2.6 m/s


@dataclass(frozen=True, eq=False)
class Model:
    """Every switch of the model. Speeds in units per step; defaults are those of the paper as printed."""

    max_speed: np.ndarray  # (N,), and with it N
    k: int  # neighbors each agent hears, at most N - 1
    omega: float = 1.0  # velocity inertial weight
    c: float = 0.5  # velocity social weight
    d: float = 6.0  # exponent of the repulsion
    a_min: float = 0.375
    a_max: float = 1.5
    a_up: float = 0.01
    a_down: float = 0.01
    update: Literal["synchronous", "sequential"] = "synchronous"
    follow: Literal["nearest", "lowest-index"] = "nearest"
    speed_rule: Literal["cap", "divide"] = "cap"  # divide: the paper's v <- v / vmax, vmax in m/s
    clamp_x: float = 8.5  # half widths of the box that agents stay in
    clamp_y: float = 8.5
    rho: float = 1.0  # radius within which an agent is on target
    per_axis_r: bool = False  # draw r for x and for y
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
    r = np.reshape(r, (model.n, -1))  # a column for each axis, or one for both
    new = state.copy()
    x, v, a = new.x, new.v, new.a  # changed in place below
    limited = np.empty_like(v)
    followed = np.empty(model.n, dtype=int)
    neighbors = np.empty((model.n, model.k), dtype=int)

    on_target = detects(model, x, state.target)  # for all, before anyone moves
    for who in turns(model):
        near = nearest_others(model, x, who)
        best = whom_to_follow(model, on_target, near, who)
        a[who] = adapted_repulsion(model, a[who], on_target[who] | on_target[near].any(axis=1))
        wanted = model.omega * v[who] + social_velocity(model, x, who, best, r[who])
        wanted = wanted + repulsion(model, x, who, near, a[who])
        limited[who] = limit_speed(model, wanted, model.max_speed[who])
        x[who], v[who] = move(model, x[who], limited[who])
        neighbors[who], followed[who] = near, best

    phi = cosine_to_target(model, x, limited, v, state.target)
    move_target(model, new, new_waypoint)
    return new, Measures(
        f_any=bool(on_target.any()),
        on_target_count=int(on_target.sum()),
        on_target=on_target,
        fluctuations=length(state.v - state.v.mean(axis=0)),
        phi=phi,
        phi_bin=bin_of(phi),
        followed=followed,
        neighbors=neighbors,
    )


def turns(model):
    """Who reads the swarm and moves together: all at once, or one by one, the later seeing the moved ones."""
    if model.update == "synchronous":
        return [slice(0, model.n)]
    return [slice(i, i + 1) for i in range(model.n)]


def detects(model, x, target):
    """Step 1: f_i = -1 if |x_i - target| <= rho."""
    return squared_length(x - target) <= model.rho**2


def nearest_others(model, x, who):
    """Step 2: the k nearest other agents; of two at the same distance the lower index first."""
    me = np.arange(model.n)[who]
    squared_distance = squared_length(x[who, None, :] - x[None, :, :])  # (who, N)
    squared_distance[np.arange(len(me)), me] = np.inf
    return np.argsort(squared_distance, axis=1, kind="stable")[:, : model.k]


def whom_to_follow(model, on_target, near, who):
    """Step 3: oneself if on target, else a neighbor on target, else nobody (-1)."""
    me = np.arange(model.n)[who]
    found = on_target[near]  # (who, k)
    if model.follow == "nearest":
        neighbor = near[np.arange(len(me)), found.argmax(axis=1)]  # argmax: the first that is true
    else:
        neighbor = np.where(found, near, model.n).min(axis=1)
    return np.where(on_target[me], me, np.where(found.any(axis=1), neighbor, -1))


def adapted_repulsion(model, a, tracking):
    """Step 4, Algorithm 1 to the letter: the test comes first, so a_R can end one delta outside its range."""
    lowered = np.where(a > model.a_min, a - model.a_down, a)
    raised = np.where(a < model.a_max, a + model.a_up, a)
    return np.where(tracking, lowered, raised)


def social_velocity(model, x, who, best, r):
    """Step 5, the pull of Eq. 2: c r (Nbest - x_i), where Nbest = x_i for those who follow nobody."""
    me = np.arange(model.n)[who]
    n_best = x[np.where(best == -1, me, best)]
    return model.c * r * (n_best - x[who])


def repulsion(model, x, who, near, a):
    """Step 5, the push of Eq. 4: sum over N_i of (a_R / r_ij)^d (x_i - x_j) / r_ij.

    A neighbor at the same place gives no push: it has no direction.
    """
    away = x[who, None, :] - x[near]  # (who, k, 2)
    distance = length(away)
    apart = distance > 0.0
    distance = np.where(apart, distance, 1.0)
    push = np.where(apart, (a[:, None] / distance) ** model.d, 0.0)
    return (push[..., None] * away / distance[..., None]).sum(axis=1)


def limit_speed(model, v, max_speed):
    """Step 6: scale down to the top speed, or divide by it in m/s."""
    if model.speed_rule == "divide":
        return v / (10.0 * max_speed)[:, None]
    speed = length(v)
    too_fast = speed > max_speed
    return np.where(too_fast[:, None], v * (max_speed / np.where(too_fast, speed, 1.0))[:, None], v)


def move(model, x, v):
    """Step 7: move and clamp; where the clamp acted, v is the displacement really made.

    Being put inside by the wall is no motion: who is outside counts from the wall on.
    """
    half = np.array([model.clamp_x, model.clamp_y])
    wanted = x + v
    reached = np.minimum(np.maximum(wanted, -half), half)
    begun = np.minimum(np.maximum(x, -half), half)
    return reached, np.where(reached != wanted, reached - begun, v)


def move_target(model, state, new_waypoint):
    """Step 8: turn to the waypoint, the shorter way, at most turn_max; advance; perhaps renew the waypoint.

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


def cosine_to_target(model, x, v, made, target):
    """phi_i: cosine of the angle between heading and bearing, 0 if stationary or at the target itself.

    x after the move, v after the speed rule but before the clamp, target before its own move. Stationary is
    whose displacement after the clamp, `made`, is shorter than 10 % of one's own top speed.
    """
    bearing = target - x
    speed, distance = length(v), length(bearing)
    counts = (length(made) >= 0.1 * model.max_speed) & (speed > 0.0) & (distance > 0.0)
    product = np.where(counts, speed * distance, 1.0)
    cosine = (v * bearing).sum(axis=1) / product
    return np.where(counts, np.minimum(np.maximum(cosine, -1.0), 1.0), 0.0)


def bin_of(phi):
    """Index of the bin, 0.2 wide around -1, -0.8, ..., 1; a value on an edge belongs to the upper bin."""
    return np.floor(5.0 * np.asarray(phi) + 5.5).astype(int)


def squared_length(vectors):
    """dx*dx + dy*dy along the last axis."""
    dx, dy = vectors[..., 0], vectors[..., 1]
    return dx * dx + dy * dy


def length(vectors):
    """Euclidean norm along the last axis."""
    return np.sqrt(squared_length(vectors))


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
        xi=xi_raw / model.max_speed.mean(),
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
