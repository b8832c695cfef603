"""Whether a change of the code has moved a number: hashes of what 12 scenarios leave behind, all options among them.

    python benchmarks/bits.py --json FILE        write the hashes of the code that is imported
    python benchmarks/bits.py --against FILE     compare with them; exit code 1 if one differs or is missing

Hashed by name: the frames of a run (who was where, who was on target, what they remembered), its sums, and the state
that it ends in. Only names in the file are compared, so that the code may add arrays, and move them from one value to
another (HOMES): numbers count, not where they lie. The same processor and versions are needed; `pow` may differ else.
"""

import argparse
import hashlib
import json
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

import shoal

STEPS = 1500
PIECES = (1, 7, 700, STEPS - 708)  # a run is cut into calls, which moves nothing
EVERY, TAIL = 25, STEPS - 100  # frames
RUN = 3

AGENT_STATE = [
    "x",
    "y",
    "vx",
    "vy",
    "command_x",
    "command_y",
    "joins",
    "leaves",
    "neighbors",
    "contact",
    "told",
    "memory",
]
RADIO_STATE = ["x", "y", "vx", "vy", "on_target", "told"]
TARGET_STATE = [
    "present",
    "x",
    "y",
    "lost",
    "heading_x",
    "heading_y",
    "dive_phase",
    "waypoint_x",
    "waypoint_y",
    "waypoint_age",
    "leg",
]
# attributes of a Simulation, of which the first counts that has the name
HOMES = {"agent": ("swarm",), "radio": ("radio",), "target": ("targets",)}

PAPER = shoal.to_toml(shoal.load("oceans2020"))
WAYPOINT = "kind='waypoint', radius=1.0, speed=3.0, margin=2.0, waypoint_reach=1.5"
TARGETS = {  # one of every kind
    "still": "{kind='still', radius=1.0, x=3.0, y=-4.0}",
    "waypoint": f"{{{WAYPOINT}}}",
    "line": "{kind='line', radius=0.8, speed=2.0, surface_time=9.0, dive_time=3.0}",
    "walk": "{kind='walk', radius=0.8, speed=1.5, margin=1.0}",
    "levy": "{kind='levy', radius=0.7, speed=2.5, shortest=0.5, longest=20.0}",
    "evasive": "{kind='evasive', radius=1.0, speed=2.7, sight=3.0, wall_sight=1.0}",
    "drift": "{kind='drift', radius=1.0, speed=0.3, current_x=0.4, current_y=-0.2}",
    "track": "{kind='track', radius=1.0, file='track.csv', max_gap=25.0}",
}
SLOW, FAST = "{name='slow', count=30, max_speed=1.0", "{name='fast', count=15, max_speed=2.6"
KNN, MEMORY = "{name='knn-pso'}", "{name='memory-pso'}"
SHARED = "{name='shared-sighting', max_age=0.3}"  # said: left open it follows the reach, which is not 1 m everywhere


def composed(
    *targets: str,
    fleets: tuple[str, ...] = (SLOW + "}", FAST + "}"),
    network: str = "neighbors=20",
    strategy: str = KNN,
    more: str = "",
) -> str:
    """TOML of a scenario made of parts."""
    return f"""
time_step = 0.1
steps = {STEPS}
seed = 11
area = {{width=20.0, height=18.0, agent_margin=1.0, origin=[-1.1, 50.77]}}
fleets = [{", ".join(fleets)}]
network = {{{network}}}
strategy = {strategy}
targets = [{", ".join(targets or (TARGETS["waypoint"],))}]
{more}
"""


ORDER = "motion = {update_order='sequential'}"
RADIO = "neighbors=15, range='6 m', loss=0.1, delay=3, adaptive={fewest=5, most=25}"
SENSORS = ", sensor_radius=0.4, detection_probability=0.7, false_alarm_probability=0.02"
BODIES = ", max_acceleration=2.0, max_turn_rate=90.0"
CHANGES = """
losses = [{step=300, count=5}, {step=900, count=4, fleet='fast'}]
joins = [{step=200, count=3, fleet='slow'}, {step=700, count=4, fleet='fast'}]
"""
SCENARIOS = {
    "oceans2020": PAPER,
    "aamas2020": shoal.to_toml(shoal.load("aamas2020")),
    "aamas2020-constant": shoal.to_toml(shoal.load("aamas2020-constant")),
    "one after the other": composed(strategy=SHARED, network="neighbors=8, range='8 m', loss=0.05", more=ORDER),
    "speed divided": composed(more="motion = {speed_rule='divide'}"),
    "a strategy per fleet": composed(
        fleets=(SLOW + f", strategy={MEMORY}, start='corner'}}", FAST + f", neighbors=9, strategy={SHARED}}}"),
    ),
    "radio": composed(network=RADIO, strategy=SHARED),
    "all to all": composed(network='neighbors="all"'),
    "sensors": composed(
        TARGETS["waypoint"],
        TARGETS["still"],
        fleets=(SLOW + SENSORS + "}", FAST + ", sensor_radius=1.0}"),
    ),
    "losses, joins, lifetimes": composed(
        fleets=(SLOW + ", mean_lifetime=120.0}", FAST + ", start='arena'}"),
        more=CHANGES,
    ),
    "bodies": composed(
        fleets=(SLOW + BODIES + "}", FAST + ", max_turn_rate=45.0, start='center'}"),
        strategy="{name='levy-walk'}",
    ),
    "everything": composed(
        *TARGETS.values(),
        fleets=(
            SLOW + SENSORS + BODIES + f", mean_lifetime=300.0, strategy={MEMORY}}}",
            FAST + f", neighbors=30, strategy={SHARED}}}",
        ),
        network=RADIO,
        more=CHANGES,
    ),
}


def main() -> int:
    """Hash, write or compare."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--json", type=Path, help="write the hashes to this file")
    parser.add_argument("--against", type=Path, help="compare with the hashes in this file")
    chosen = parser.parse_args()
    hashes = {name: hashes_of(text) for name, text in SCENARIOS.items()}
    for name, parts in hashes.items():
        print(f"{digest(json.dumps(parts, sort_keys=True).encode())[:16]}  {len(parts):3} arrays  {name}")
    if chosen.json:
        chosen.json.write_text(json.dumps(hashes, indent=1))
    if not chosen.against:
        return 0
    moved = [
        f"{name}: {part}"
        for name, parts in json.loads(chosen.against.read_text()).items()
        for part, before in parts.items()
        if hashes.get(name, {}).get(part) != before
    ]
    print("\n".join(moved) or "no bit has moved")
    return 1 if moved else 0


def hashes_of(text: str) -> dict[str, str]:
    """Run a scenario, and hash what it leaves by name."""
    with tempfile.TemporaryDirectory() as folder:
        scenario = Path(folder, "scenario.toml")
        scenario.write_text(text)
        Path(folder, "track.csv").write_text(track())
        simulation = shoal.Simulation(shoal.load(scenario), RUN)
    arrays: dict[str, Any] = {}
    for piece, steps in enumerate(PIECES):
        frames = simulation.advance(steps, every=EVERY, tail=TAIL)
        for name, values in frames.arrays().items() if frames else ():
            arrays[f"frames {piece}.{name}"] = values
    for name in simulation.tally._fields:
        arrays[f"tally.{name}"] = getattr(simulation.tally, name)
    agents = simulation.scenario.agents
    for name in AGENT_STATE:
        arrays[f"agent.{name}"] = home_of(simulation, "agent", name)[:agents]
    for name in RADIO_STATE:
        arrays[f"radio.{name}"] = home_of(simulation, "radio", name)[:, :agents]
    for name in TARGET_STATE:
        arrays[f"target.{name}"] = home_of(simulation, "target", name)
    return {name: digest(np.ascontiguousarray(values).tobytes()) for name, values in arrays.items()}


def home_of(simulation: Any, what: str, name: str) -> Any:
    """An array of the state, wherever this version of the code keeps it."""
    for home in HOMES[what]:
        value = getattr(simulation, home, None)
        if hasattr(value, name):
            return getattr(value, name)
    raise KeyError(f"{what}.{name} has moved: say where to in HOMES")


def track() -> str:
    """A recorded track across the arena: a fix every 10 s, and silence for half a minute."""
    rows = [(10 * i, 50.77 + 4e-6 * (i % 7), -1.1 + 1.2e-5 * (i - 8)) for i in range(16) if i not in (6, 7, 8)]
    return "time,lat,lon,mmsi\n" + "".join(f"{t},{lat:.7f},{lon:.7f},1\n" for t, lat, lon in rows)


def digest(content: bytes) -> str:
    """SHA-256 in hex."""
    return hashlib.sha256(content).hexdigest()


if __name__ == "__main__":
    sys.exit(main())
