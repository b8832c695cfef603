"""Deliberate breaks of what a fleet runs on, each in a piece of one line, for tests/run/fleet/test_soak.py."""

from shoal.buoy import orderbook
from shoal.buoy.aboard import Aboard
from shoal.buoy.buoy import Buoy
from shoal.buoy.compiled import CompiledMinds
from shoal.buoy.hearing import Hearing
from shoal.buoy.inbox import Inbox
from shoal.buoy.orderbook import Orderbook
from shoal.buoy.said import Said
from shoal.core import messages
from shoal.run.fleet.log import Log
from shoal.run.fleet.ocean import Ocean
from shoal.run.fleet.paced import PacedSea
from shoal.run.fleet.vessel import Vessel

# Who is broken, in which piece of its source, what stands there instead, and words of the invariant that must see it.
MUTANTS = {
    "forged orders are obeyed": (
        orderbook,
        "opened",
        "hmac.compare_digest(seal, _seal(kind, text, key))",
        "seal",
        "obeys",
    ),
    "orders of another fleet are obeyed": (Orderbook, "take", "said.fleet != self._fleet", "False", "obeys"),
    "orders are obeyed again": (
        Orderbook,
        "take",
        "elif said.number <= self._last:",
        "elif False:",
        "obeys",
    ),
    "void orders are obeyed": (Orderbook, "take", "<= now <= said.until", "<= now", "obeys"),
    "orders from the future are obeyed": (Orderbook, "take", "said.number / 1e9 - AHEAD <=", "0.0 <=", "obeys"),
    "an order is obeyed by all": (Orderbook, "_ordered", "or id in order.agents", "or True", "obeys"),
    "an order is obeyed a step too soon": (Aboard, "attend", "tick.step + 1", "tick.step", "obeys"),
    "orders are not passed on": (Orderbook, "take", "passed_on(data, passed + 1), *own", "*own", "passed on"),
    "who holds drifts on": (Buoy, "_as_ordered", "return 0.0, 0.0", "return vx / 2, vy / 2", "who holds"),
    "the age rule is a step longer": (Inbox, "newest", "step - max_age)", "step - max_age - 1)", "too old"),
    "the age rule is a step shorter": (Inbox, "newest", "step - max_age)", "step - max_age + 1)", "k nearest"),
    "reports of the next step are heard": (Inbox, "newest", "step + 1)", "step + 2)", "from the future"),
    "the oldest report is heard": (Inbox, "newest", "found |= self.of(then)", "found = self.of(then) | found", "said"),
    "duplicates are new": (
        Inbox,
        "put",
        "elif id in (said :=",
        "elif None is (said :=",
        "counted",
    ),
    "a duplicate is not counted": (Inbox, "put", '"duplicate" if', '"" if', "counted"),
    "late reports are taken": (Inbox, "put", "elif step < max(0, now - self._kept):", "elif step < 0:", "counted"),
    "reports are late a step too soon": (Inbox, "put", "now - self._kept)", "now - self._kept + 1)", "counted"),
    "early reports are taken": (Inbox, "put", "now + AHEAD", "now + 1_000", "counted"),
    "strangers are taken": (Inbox, "put", "id >= self._agents or", "", "raises an error"),
    "times between steps are taken": (Inbox, "put", "abs(steps - round(steps)) > 1e-3", "False", "counted"),
    "times before the start are taken": (Inbox, "put", "not 0.0 <= steps", "not -1e9 <= steps", "counted"),
    "who is reordered is forgotten": (Inbox, "put", "max(step, last)", "step", "counted"),
    "an inbox keeps everything": (Inbox, "forget", "step < now - self._kept", "step < 0", "stays small"),
    "an inbox forgets too much": (Inbox, "forget", "step < now - self._kept", "step <= now - 1", "counted"),
    "damaged reports are read": (messages, "unpack", "!= zlib.crc32(body)", "is None", "counted"),
    "numbers that are none are read": (messages, "unpack", "_check_finite(read, numbers)", "pass", "counted"),
    "a buoy hears itself": (Said, "nearest", "square[ids[:, None] == speakers] = np.nan", "", "itself"),
    "one more than k is heard": (Said, "nearest", ", most))", ", [k + 1 for k in most]))", "at most k"),
    "one less than k is heard": (Said, "nearest", ", most))", ", [k - 1 for k in most]))", "k nearest"),
    "the farthest are heard": (Said, "nearest", "square.argsort(", "(-square).argsort(", "k nearest"),
    "the first by id are heard": (Said, "nearest", "square.argsort(", "(0.0 * square).argsort(", "k nearest"),
    "the nearest from west to east are heard": (Said, "nearest", "dx * dx + dy * dy", "dx * dx", "k nearest"),
    "whoever is out of reach is heard": (Said, "nearest", "if reaches is not None", "if False", "k nearest"),
    "x and y are mixed up": (Said, "__init__", "it.x, it.y,", "it.y, it.x,", "k nearest"),
    "velocities are mixed up": (Said, "__init__", "it.vx, it.vy,", "it.vy, it.vx,", "what was said"),
    "times are not told": (Said, "__init__", "it.time,", "0.0,", "what was said"),
    "everybody heard is on target": (Said, "__init__", "it.on_target)", "True)", "what was said"),
    "a buoy reports where it will be": (Buoy, "report", "float(x)", "float(x + vx)", "say what instruments"),
    "a buoy reports in halves": (Buoy, "report", "float(vy)", "float(vy / 2)", "say what instruments"),
    "a buoy is a step behind in its reports": (Buoy, "report", "time = step", "time = (step - 1)", "say when"),
    "a buoy decides a step behind": (
        Buoy,
        "decide_together",
        "near[rows], step)",
        "near[rows], step - 1)",
        "its own clock",
    ),
    "a buoy wants what is no number": (
        Buoy,
        "decide_together",
        "return wants",
        "return [[math.nan, 0.0] for _ in buoys]",
        "commands are decisions",
    ),
    "the dead are heard": (Aboard, "_arrived", "there[id]", "True", "k nearest"),
    "limited radios hear all": (Aboard, "_arrived", "if tick.hears is None", "if True", "k nearest"),
    "one buoy is silent": (Aboard, "speak", "in readings_of(tick):", "in readings_of(tick)[1:]:", "every buoy speaks"),
    "buoys speak between reports": (Aboard, "speak", "if tick.step % self._interval:", "if False:", "between reports"),
    "one buoy does not decide": (Aboard, "act", "dict(readings_of(tick))", "dict(readings_of(tick)[1:])", "an error"),
    "wants are those of others": (Aboard, "act", "tick, wants)", "tick, wants[::-1])", "commands are decisions"),
    "what is said now and then is heard always": (Aboard, "spoken", "arrived % self._interval", "0", "k nearest"),
    "what is delayed is heard at once": (Aboard, "spoken", "step - self._delay", "step", "from the future"),
    "the sea follows one process": (Ocean, "follow", "if answers:", "if answers := answers[:1]:", "decided last"),
    "bodies forget a command": (
        Ocean,
        "obey",
        "ids[sound], :2] = wants[sound]",
        "ids[sound][1:], :2] = wants[sound][1:]",
        "decided last",
    ),
    "top speeds are forgotten": (
        Ocean,
        "tick",
        "everybody = self",
        "self.simulation._swarm.max_speed[:] = 9.0; everybody = self",
        "faster",
    ),
    "walls are forgotten": (
        Ocean,
        "tick",
        "everybody = self",
        "self.simulation.world = self.simulation.world._replace(clamp_x=99.0, clamp_y=99.0); everybody = self",
        "arena",
    ),
    "instruments are those of others": (
        Ocean,
        "readings",
        "= swarm.fix_x[: self._agents],",
        "= swarm.fix_x[: self._agents][::-1],",
        "say what is so",
    ),
    "the killed stay": (Ocean, "lose", "now.swarm.leaves[lost] = self.number", "pass", "lost are gone"),
    "the silent go on": (PacedSea, "_stop_the_silent", "if fresh.size:", "if False:", "silen"),
    "the silent go on for a second more": (
        PacedSea,
        "_stop_the_silent",
        "> self._quiet)",
        "> 2 * self._quiet)",
        "silen",  # they stop, or the log has their silence: who holds lies still anyway
    ),
    "the silent are not noted": (PacedSea, "_stop_the_silent", "self._log.notes.append(", "str(", "every silence"),
    "the log skips steps": (
        Log,
        "keep",
        "self._frames.append",
        "self.steps % 9 and self._frames.append",
        "every frame",
    ),
    "the log has another place": (
        Log,
        "_as_buoys_have_it",
        "memory=memory)",
        "memory=memory, x=frame.x + 1e-12)",
        "every frame",
    ),
    "the log forgets who is lost": (Log, "lose", "self.lost +=", "_ =", "every loss"),
    "a restart keeps the inbox": (
        Vessel,
        "start",
        "self.aboard = Aboard(",
        "self.aboard = getattr(self, 'aboard', None) or Aboard(",
        "counted",
    ),
    "a restart forgets what was": (
        Buoy,
        "restore",
        "self._minds.recall(self._place, memory)",
        "pass",
        "goes on from what was",
    ),
    "the log remembers for others": (
        Log,
        "remember",
        "self._memory[ids] =",
        "self._memory[ids[::-1]] =",
        "every memory",
    ),
    "buoys say that everybody is on target": (Buoy, "report", "bool(on_target)", "True", "say what instruments"),
    "nobody is there for instruments": (
        Ocean,
        "tick",
        "alive = self.alive",
        "alive = self.alive & (self.number < 50)",
        "who is there",
    ),
    "the chance of another step is drawn": (
        CompiledMinds,
        "decide",
        "(self._key, step)",
        "(self._key, step + 1)",
        "strategy says",
    ),
    "minds forget": (CompiledMinds, "decide", "self._memory,", "self._memory.copy(),", "strategy does"),
    "minds hear one less": (CompiledMinds, "decide", "inbox, near,", "inbox, near[:, 1:].copy(),", "strategy says"),
    "minds do not know their speed": (
        CompiledMinds,
        "decide",
        "[rows, :8] = readings",
        "[rows, :8] = [(*each[:2], 0.0, *each[3:]) for each in readings]",
        "strategy says",
    ),
    "minds take themselves for another": (CompiledMinds, "__init__", "[me.id,", "[0,", "strategy says"),
    "minds remember for another": (CompiledMinds, "recall", "[place,", "[0,", "goes on from what was"),
}

# The same of a fleet that keeps and relays reports.
KEPT_MUTANTS = {
    "what is kept is too young": (Hearing, "held", "step - self._max_age)", "step - self._max_age + 1)", "k nearest"),
    "what did not reach is kept": (Hearing, "held", "if reached[id]", "", "k nearest"),
    "the oldest is gone by": (
        Hearing,
        "held",
        "found |= {id: report for id, report in inbox.of(then).items() if reached[id]}",
        "found = {id: report for id, report in inbox.of(then).items() if reached[id]} | found",
        "said",
    ),
    "nothing is kept": (Aboard, "act", "if self._keeps", "if False", "k nearest"),
    "radios reach all": (Aboard, "_kept", "if tick.hears is None", "if True", "k nearest"),
}
