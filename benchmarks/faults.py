"""What a free-running fleet makes of faults: `benchmarks/faults.sh`, which keeps what this prints.

    python benchmarks/faults.py sea          # a fleet in the stand-in sea: killed, frozen, a clock off, garbage
    python benchmarks/faults.py vehicles     # four buoys on vehicles: network cut, packets dropped (needs root)

Prints what was done and what came of it, a line each; exits with 1 if anything is not as it must be.
"""

import ctypes
import os
import random
import shutil
import signal
import subprocess
import sys
import time
from contextlib import ExitStack, contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))

GARBAGE = 100_000
BUOYS, PROCESSES, SECONDS = 20, 5, 60
NET = "10.77.0"
failures = []


def check(words, so):
    """Say whether something is so, and remember if it is not."""
    print(f"{'ok  ' if so else 'NOT '} {words}", flush=True)
    if not so:
        failures.append(words)


def sea():
    """Twenty buoys in five processes, 10 Hz: one killed, one frozen for 5 s, one whose clock jumps 2 s, and garbage."""
    from scenarios import small
    from shoal.run.fleet.processes import Processes
    from shoal.run.fleet.run_fleet import Terms, run_fleet

    each = BUOYS // PROCESSES
    os.environ["SHOAL_CLOCK_OFF"] = f"{3 * each}:2@25"
    crowds, enter = [], Processes.__enter__
    Processes.__enter__ = lambda self: (crowds.append(self), enter(self))[1]
    acts = {
        50: lambda pids: os.kill(pids[0], signal.SIGKILL),
        100: lambda pids: os.kill(pids[1], signal.SIGSTOP),
        150: lambda pids: os.kill(pids[1], signal.SIGCONT),
        200: lambda pids: subprocess.Popen(
            [sys.executable, __file__, "garbage", crowds[0]._welcome["fleet"], *crowds[0]._places]
        ),
    }

    def progress(done, total):
        if done in acts:
            acts.pop(done)(list(crowds[0].pids.values()))

    scenario = small(BUOYS, 10, {"steps": 10 * SECONDS})
    print(
        f"== {BUOYS} buoys in {PROCESSES} processes, 10 Hz, {SECONDS} s: one killed at 5 s, one frozen from 10 to 15 s,"
    )
    print(f"   a clock 2 s off from 25 s after its start, {GARBAGE:,} random messages by a stranger from 20 s on")
    record = run_fleet(scenario, Terms(processes=PROCESSES, plain=True), progress=progress)
    notes = record.provenance["notes"]
    print("\n".join(f"   {note}" for note in notes))
    gone = [id for loss in record.scenario.losses for id in loss.agents]
    check("the killed ones are lost, and nobody else", gone == list(range(each)))
    silent = [note for note in notes if "was silent from" in note and not note.endswith("on")]
    frozen = [f"buoy {id} " for id in range(each, 2 * each)]
    check("the frozen ones were silent, and rejoined", all(any(f in note for note in silent) for f in frozen))
    others = [note for note in silent if not any(f in note for f in frozen)]
    check(f"nobody else was silent, whatever the garbage: {len(others)} times", not others)
    check("nobody is silent at the end", not any(note.endswith(" on") for note in notes))
    counted = int(next(n for n in notes if "damaged" in n).split(" damaged")[0].split()[-1].replace(",", ""))
    check(
        f"the garbage is counted: {counted:,} by {PROCESSES - 1} processes", counted >= 0.9 * GARBAGE * (PROCESSES - 1)
    )
    set_by = next(float(note.split("set by ")[1].split()[0]) for note in notes if "set by " in note)
    check("the clock that was off was set, within half a step", abs(set_by - 2000.0) < 50.0)


def garbage(fleet, *places):
    """A stranger who talks nonsense on the mesh of a fleet."""
    from shoal.buoy.zenoh_mesh import ZenohMesh

    chance = random.Random(1)
    mesh = ZenohMesh(fleet, "stranger", connect=places)
    while mesh.alive() < 5:
        time.sleep(0.05)
    for number in range(GARBAGE):
        mesh.publish(chance.randbytes(chance.randrange(120)))
        if number % 1000 == 0:
            time.sleep(0.05)
    time.sleep(2.0)
    mesh.close()


@contextmanager
def network(name):
    """This thread in a network of its own; sockets that it opens stay there."""
    libc, home = ctypes.CDLL(None, use_errno=True), os.open("/proc/thread-self/ns/net", os.O_RDONLY)
    there = os.open(f"/run/netns/{name}", os.O_RDONLY)
    try:
        if libc.setns(there, 0x40000000):
            raise OSError(ctypes.get_errno(), "setns")
        yield
    finally:
        libc.setns(home, 0x40000000)
        os.close(there)
        os.close(home)


def ip(*words):
    """Run `ip`, from iproute2."""
    subprocess.run(["ip", *words], check=True, stdout=subprocess.DEVNULL)


def networks(count, stack):
    """Make so many networks, tied together by a bridge; they are removed when the stack ends."""
    ip("link", "add", "shoal-br", "type", "bridge")
    stack.callback(ip, "link", "del", "shoal-br")
    ip("link", "set", "shoal-br", "up")
    names = [f"shoal-{number}" for number in range(count)]
    for number, name in enumerate(names):
        ip("netns", "add", name)
        stack.callback(ip, "netns", "del", name)
        ip("link", "add", f"shoal-v{number}", "type", "veth", "peer", "name", "sea", "netns", name)
        ip("link", "set", f"shoal-v{number}", "master", "shoal-br", "up")
        ip("-n", name, "addr", "add", f"{NET}.{number + 1}/24", "dev", "sea")
        ip("-n", name, "link", "set", "sea", "up")
        ip("-n", name, "link", "set", "lo", "up")
    return names


def drop(name, share):
    """Let a network lose this share of the packets that come in from the others [%]; 0: none."""
    rules = "flush ruleset\n"
    if share:
        rules += (
            "table inet shoal {\n chain lossy {\n  type filter hook input priority 0\n"
            f'  iifname "sea" numgen random mod 100 < {share} drop\n }}\n}}\n'
        )
    subprocess.run(["ip", "netns", "exec", name, "nft", "-f", "-"], input=rules.encode(), check=True)


def used(pids):
    """The most memory that one of some processes had, and its processor time."""
    memory = processor = 0.0
    for pid in pids:
        status = Path(f"/proc/{pid}/status").read_text()
        memory = max(memory, int(status.split("VmHWM:")[1].split()[0]) / 1024)
        processor = max(processor, sum(map(int, Path(f"/proc/{pid}/stat").read_text().split()[13:15])) / 100)
    return f"{memory:.0f} MiB, {processor:.1f} s of processor"


def vehicles():
    """Four buoys on vehicles, in a network each: one is cut off for 10 s; then 20 % of all packets are dropped."""
    from scenarios import fleets, scenario
    from vehicles import ORIGIN, Buoys, Sea, wait_until

    count, step = 4, 0.2
    area = {"width": 400.0, "height": 400.0, "agent_margin": 10.0, "origin": list(ORIGIN)}
    chosen = {"fleets": fleets((count, 2.0)), "network.neighbors": 3, "area": area, "time_step": step, "steps": 50_000}
    with ExitStack() as stack:
        try:
            names = networks(count, stack)
        except (OSError, subprocess.CalledProcessError) as error:
            print(f"== not done: networks cannot be made here ({error}); root can")
            return
        folder = Path(stack.enter_context(TemporaryDirectory()))
        places = [(-60.0, 0.0), (60.0, 0.0), (0.0, 60.0), (0.0, -60.0)]
        afloat = Sea(places, [14550] * count, [network(name) for name in names])
        stack.callback(afloat.close)
        meshes = [f"{NET}.{number + 1}:7447" for number in range(count)]
        before = {number: ["ip", "netns", "exec", name] for number, name in enumerate(names)}
        buoys = Buoys(folder, scenario("oceans2020", chosen), ["127.0.0.1:14550"] * count, meshes, before=before)
        stack.callback(buoys.close)

        def heard(id, last=10):
            rows = [int(row["heard"] or 0) for row in buoys.rows(id)[-last:]]
            return sum(rows) / max(1, len(rows))

        def all_hear():
            return all(heard(id, last=3) == count - 1 for id in range(count))

        print(f"== {count} buoys on vehicles (rovers that speak MAVLink), a network each, steps of {step} s")
        for id in range(count):
            buoys.start(id)
        buoys.wait_for("step 0 of", seconds=120.0)
        wait_until(all_hear)
        print("   all hear all; the network of buoy 3 is cut for 10 s")
        ip("link", "set", "shoal-v3", "down")
        cut = time.monotonic()
        time.sleep(10.0)
        rows = buoys.rows(3)
        check("the one that is cut off stopped", rows[-1]["note"] == "stopped: nobody is heard")
        check(
            f"the rest go on, and hear {heard(0):.2f} others", heard(0) == count - 2 and not buoys.rows(0)[-1]["note"]
        )
        ip("link", "set", "shoal-v3", "up")
        healed = time.monotonic()
        print(f"   healed after {healed - cut:.1f} s")
        wait_until(all_hear, seconds=90.0)
        print(f"   all hear all {time.monotonic() - healed:.1f} s later")
        check("it rejoined", buoys.rows(3)[-1]["note"] == "")
        if shutil.which("nft") is None:
            print("   not done: 20 % of packets dropped (nft, of the package nftables, is not here)")
        else:
            for name in names:
                drop(name, 20)
            before = [len(buoys.rows(id)) for id in range(count)]
            time.sleep(30.0)
            steps = [len(buoys.rows(id)) - rows for id, rows in enumerate(before)]
            share = [heard(id, last=120) / (count - 1) for id in range(count)]
            said = ", ".join(f"{each:.1%}" for each in share)
            print(f"   20 % of packets dropped for 30 s: of the others' reports {said} in time")
            check(f"all go on deciding: {', '.join(map(str, steps))} of 150 steps", min(steps) >= 135)
            check("most is heard", min(share) > 0.5)
            for name in names:
                drop(name, 0)
            wait_until(all_hear, seconds=60.0)
            check("then all hear all again", True)
        print(
            f"   {used([process.pid for process in buoys.processes.values()])} in the largest process, start included"
        )
        for id in range(count):
            code = buoys.interrupt(id)
            print(f"   {buoys.said(id).splitlines()[-2].removeprefix('shoal: ').partition('; log')[0]}")
            check(f"buoy {id} ended by Ctrl-C, disarmed", code == 130 and not afloat.rovers[id].armed)


if __name__ == "__main__":
    what, *rest = sys.argv[1:] or ["sea"]
    {"sea": sea, "vehicles": vehicles, "garbage": garbage}[what](*rest)
    sys.exit(bool(failures))
