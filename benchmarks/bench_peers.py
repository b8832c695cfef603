"""The paper's step in other libraries, and in Shoal, in one run on one core of one machine.

    python benchmarks/bench_peers.py [--rounds N] [--seconds S] [--anchor limit.cpp]

Each peer is one file of benchmarks/peers, written as a good user of that library would, and runs as a process of its
own, in turn with the others; the fastest short stretch counts, in processor time. Time on target stands beside the
speed: a wrong model shows there. The libraries are installed into .peers/, which nothing else uses; what cannot be
installed is left out, with a sentence.
"""

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
import venv
from pathlib import Path
from typing import Any, NamedTuple

from bench_engine import REPOSITORY, compile_anchor, load, machine

ENVIRONMENT = REPOSITORY / ".peers"
PEERS = REPOSITORY / "benchmarks" / "peers"
TORCH = ("--index-url", "https://download.pytorch.org/whl/cpu")  # its other builds bring gigabytes for GPUs
PATIENCE = 900  # [s] for an installation, and for a turn
ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"), "1")
ONE_THREAD |= {"XLA_FLAGS": "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"}


class Peer(NamedTuple):
    """A library: the file that uses it, and what pip installs for it; nothing for Shoal, which is here already."""

    name: str
    file: str
    install: tuple[str, ...]


ALL = (
    Peer("Shoal", "shoal_peer.py", ()),
    Peer("Warp", "warp_peer.py", ("warp-lang", "numpy")),
    Peer("JAX", "jax_peer.py", ("jax", "numpy")),
    Peer("NumPy", "numpy_peer.py", ("numpy",)),
    Peer("PyTorch", "torch_peer.py", ("torch", "numpy", *TORCH)),
    Peer("Mesa", "mesa_peer.py", ("mesa", "numpy", "scipy")),
)


def main() -> None:
    """Install, measure in turn, print a table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--rounds", type=int, default=3, metavar="N", help="turns of each; the fastest counts")
    parser.add_argument("--seconds", type=float, default=3.0, metavar="S", help="of a turn")
    parser.add_argument("--anchor", type=Path, metavar="FILE", help="C++ of the same model, limit.cpp, to compile")
    asked = parser.parse_args()
    before = load()
    peers = [peer for peer in ALL if is_there(peer)]
    with tempfile.TemporaryDirectory() as folder:
        anchor, remark = compile_anchor(Path(folder), asked.anchor) if asked.anchor else (None, "")
        if remark:
            say(remark)
        found: dict[str, list[dict[str, Any]]] = {}
        for number in range(asked.rounds):
            for peer in peers:
                say(f"round {number + 1} of {asked.rounds}: {peer.name}")
                if turn := turn_of(peer, asked.seconds, number + 1):
                    found.setdefault(peer.name, []).append(turn)
            if anchor:
                found.setdefault("C++, limit.cpp", []).append(anchor_turn(anchor, asked.seconds))
    print_table(found)
    print(f"\n{machine()}; load before {before}, after {load()}")
    if others(before) > 0.5 or others(load()) > 1.5:
        say("others are at work on this machine: measure again when nobody is, or read nothing into the ratios")


def is_there(peer: Peer) -> bool:
    """Install what a peer needs, if it is not installed; say so where that cannot be done."""
    done = ENVIRONMENT / f"{peer.file}.installed"
    if not peer.install or done.exists():
        return True
    if not interpreter().exists():
        say("setting up .peers/")
        venv.create(ENVIRONMENT, with_pip=True)
    say(f"installing {peer.name}")
    command = [str(interpreter()), "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *peer.install]
    try:
        subprocess.run(command, check=True, capture_output=True, text=True, timeout=PATIENCE)
    except (subprocess.SubprocessError, OSError) as error:
        lines = (getattr(error, "stderr", None) or str(error)).strip().splitlines()
        say(f"{peer.name} is left out, for it cannot be installed: {lines[-1] if lines else 'pip does not say why'}")
        return False
    done.touch()
    return True


def interpreter() -> Path:
    """The environment's Python."""
    return ENVIRONMENT / ("Scripts/python.exe" if os.name == "nt" else "bin/python")


def turn_of(peer: Peer, seconds: float, seed: int) -> dict[str, Any] | None:
    """What a peer prints of one turn; None, with a sentence, where it fails."""
    python = interpreter() if peer.install else sys.executable
    command = [str(python), str(PEERS / peer.file), str(seconds), str(seed)]
    try:
        done = subprocess.run(
            command, check=True, capture_output=True, text=True, timeout=PATIENCE, env={**os.environ, **ONE_THREAD},
            preexec_fn=PINNED,
        )  # fmt: skip
    except subprocess.SubprocessError as error:
        lines = (getattr(error, "stderr", None) or str(error)).strip().splitlines()
        say(f"{peer.name} is left out of this round, for it fails: {lines[-1] if lines else error}")
        return None
    turn: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return turn


def anchor_turn(program: Path, seconds: float) -> dict[str, Any]:
    """The same of the anchor, which spends half of the time on single precision."""
    command = [str(program), "20", str(2 * seconds)]
    done = subprocess.run(command, check=True, capture_output=True, text=True, preexec_fn=PINNED)
    ns, on_target = re.search(r"f64 ([\d.]+) ns.*target ([\d.]+)", done.stdout).groups()  # type: ignore[union-attr]
    return {"ns": float(ns), "on_target": float(on_target), "replicates": 1, "precision": "f64", "version": ""}


def stay_on_one_core() -> None:
    """The last of those that this process may use: others are asked first."""
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})


PINNED = stay_on_one_core if hasattr(os, "sched_setaffinity") else None


def print_table(found: dict[str, list[dict[str, Any]]]) -> None:
    """In Markdown, the fastest first."""
    best = {name: min(turn["ns"] for turn in turns) for name, turns in found.items()}
    print("| | ns per agent-step | over Shoal | time on target | runs at once | |")
    print("| --- | --- | --- | --- | --- | --- |")
    for name in sorted(best, key=best.__getitem__):
        turns = found[name]
        on_target = sum(turn["on_target"] for turn in turns) / len(turns)
        ratio = f"{best[name] / best['Shoal']:.3g}" if "Shoal" in best else ""
        about = f"{turns[0]['version']} {turns[0]['precision']}".strip()
        print(f"| {name} | {best[name]:,.0f} | {ratio} | {on_target:.3f} | {turns[0]['replicates']} | {about} |")


def others(loads: str) -> float:
    """The load of the last minute; 0 where nobody knows."""
    return 0.0 if loads == "unknown" else float(loads.split()[0])


def say(words: str) -> None:
    """What goes on, beside the table."""
    print(words, file=sys.stderr, flush=True)


if __name__ == "__main__":
    main()
