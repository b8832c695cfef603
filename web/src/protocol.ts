// What the engine and the page say to each other: docs/reference/view-protocol.md, as types and a decoder.

export interface Fleet {
  name: string;
  count: number;
  max_speed: number; // [m/s]
  sensor_radius: number; // [m]
  strategy?: string;
}

export interface Target {
  kind: string;
  name: string | null; // of a recorded track
  radius: number; // [m]
  speed: number | null; // [m/s]
}

/** What a metric is called: the engine says it, as in tables and figures. */
export interface Series {
  name: string;
  label: string;
  unit: string;
  sentence: string;
  least: number | null; // bounds
  most: number | null;
  mean?: number | null; // of a whole record
}

export interface Metric extends Series {
  mean: number | null;
  low: number | null;
  high: number | null;
}

/** Where on Earth local meters are. */
export interface Earth {
  size: number; // [m]
  lon: number[]; // (15) coefficients of x^i y^j in units of `size`, by i and then j, i + j <= 4 [deg]
  lat: number[];
  error: number; // [m] at most
  lines: { words: string; meridian: boolean; x: number[]; y: number[] }[]; // [m]
}

export interface Currents {
  times: number[]; // (T) [s] since the start
  period: number | null; // [s] after which they come again
  fastest: number; // [m/s]
  apart: number; // [m] arrows
  places: number[]; // (P x 2) [m]
  values: number[]; // (T x P x 2) eastward and northward, % of the fastest
}

export interface Geography {
  land: number[][]; // rings x, y, x, y, ... [m]
  limits: number[][]; // of the search area
  cells: number[][]; // land that only a grid knows: x, y, width, height [m]
  earth: Earth | null;
  currents: Currents | null;
}

export interface Scene {
  epoch: number;
  name: string;
  time_step: number; // [s]
  steps: number;
  seed: number | string;
  unit: number; // [m]
  since: number;
  area: { width: number; height: number; half_x: number; half_y: number }; // [m]
  fleets: Fleet[];
  targets: Target[];
  neighbors: number | "all";
  k: string; // as it is, in words: "20", "5 (scouts), all (relays)", "10 to 25 (adaptive)"
  adapts: boolean;
  range: number | null; // [m]
  strategy: { name: string; params: Record<string, unknown>; summary: string };
  strategies: string; // of all fleets, in words
  conditions: string[]; // what disturbs the swarm, a sentence each
  events: [step: number, what: "lost" | "joined", agent: number][]; // as far as they are known, also those to come
  geography: Geography | null;
  ends: number | null; // step from which no target will be there any more
  has_repulsion: boolean;
  has_links: boolean;
  memory?: { name: string; unit: string }[]; // what agents remember besides a_R, in the order of frames
  delay?: number; // [steps] of reports
  series?: Series[];
  metrics?: Metric[];
  history?: { step: number[]; values: Record<string, (number | null)[]> };
  steered?: { step: number; words: string }[];
}

export interface Parameter {
  default: unknown;
  unit: string | null;
  description: string;
  type: string;
  choices: string[] | null;
}

export interface StrategyChoice {
  name: string;
  summary: string;
  parameters: Record<string, Parameter>;
}

export interface Hello {
  type: "hello";
  runs: number;
  recording: boolean;
  fleet?: boolean; // real buoys: they can be watched, not changed
  speeds: number[];
  strategies: StrategyChoice[];
}

export interface Status {
  type: "status";
  playing: boolean;
  speed: number | null; // times real time; null: as it goes
  step: number;
  first: number;
  last: number;
  at_end: boolean;
  busy: string | null;
  ended?: string | null; // the total, once all recorded tracks are over
  complete?: boolean; // the record that is written is as long as it was meant to be
  script?: number | null; // changes come from a log until this step
  changes?: number; // made so far
}

/** The course of a run before the page was opened. */
export interface Past {
  type: "history";
  run: number;
  step: number[];
  numbers?: (number | null)[][]; // at each step, in the order of the scene's series
  time_on_target: (number | null)[];
  recent: (number | null)[];
  xi: (number | null)[];
  xi_now: (number | null)[];
  engaged: (number | null)[];
}

export interface Failure {
  type: "error";
  message: string;
}

/** What metrics are at the step of the frame that comes next, in the order of the scene's series. */
export interface Measured {
  type: "numbers";
  run: number;
  step: number;
  values: (number | null)[];
}

/** A text to save, which this page asked for. */
export interface SavedText {
  type: "file";
  what: "scenario" | "changes";
  run: number;
  text: string;
}

export type Message = Hello | Past | Status | Failure | Measured | SavedText | { type: "scene"; run: number; scene: Scene };

export type Change = string | number | boolean;

export type Request =
  | { do: "play" }
  | { do: "pause" }
  | { do: "step"; steps: number }
  | { do: "speed"; value: number }
  | { do: "seek"; step: number }
  | { do: "restart"; seed?: number }
  | { do: "change"; run: number; changes: Record<string, Change> }
  | { do: "kill"; run: number; agent: number }
  | { do: "add"; run: number; fleet: number; x: number; y: number }
  | { do: "drag"; run: number; target: number; x: number; y: number }
  | { do: "export"; what: "scenario" | "changes"; run: number };

/** The state at the start of a step, as views into the bytes that came. */
export interface Frame {
  bytes: ArrayBuffer;
  run: number;
  epoch: number;
  step: number;
  timeOnTarget: number; // since the scene's `since`; NaN without a target
  timeOnTargetRecent: number; // over the last 1,000 steps
  xi: number; // since `since`
  xiNow: number;
  engaged: number; // agents
  phi: Float32Array; // (11) agents
  lean: boolean; // of very many agents: without vx, vy, repulsion and degree, which are empty then
  x: Float32Array; // (N) [m]
  y: Float32Array;
  vx: Float32Array; // (N) [m/s]
  vy: Float32Array;
  repulsion: Float32Array; // (N) a_R [m]
  memory: Float32Array[]; // of each field that the scene names, (N)
  targetX: Float32Array; // (T) [m]
  targetY: Float32Array;
  degree: Uint16Array; // (N) k
  flags: Uint8Array; // (N)
  present: Uint8Array; // (T)
  linkBytes: number; // W of each agent, 0 where links were not kept
  links: Uint8Array; // (N x W) bit j % 8 of byte j / 8 of an agent is set where it heard j in this step
}

export const PHI_BINS = 11;
const VERSION = 4;
const LEAN = 3; // the version without what can only be seen of few
const HEAD = 84; // bytes before the agents
const ON_TARGET = 1;
const ALIVE = 2;
const SILENT = 4;

export const isOnTarget = (frame: Frame, agent: number): boolean => (frame.flags[agent] & ON_TARGET) !== 0;
export const isAlive = (frame: Frame, agent: number): boolean => (frame.flags[agent] & ALIVE) !== 0;
export const isSilent = (frame: Frame, agent: number): boolean => (frame.flags[agent] & SILENT) !== 0;
export const isPresent = (frame: Frame, target: number): boolean => (frame.present[target] & 1) !== 0;

export class ProtocolError extends Error {}

/** Decode one frame; throws ProtocolError on anything else. */
export function decodeFrame(bytes: ArrayBuffer): Frame {
  const { agents, targets, linkBytes, fields, size, lean } = readSize(new DataView(bytes));
  const detailed = lean ? 0 : agents;
  if (bytes.byteLength !== size) {
    throw new ProtocolError(`a frame of ${agents} agents has ${size} bytes, not ${bytes.byteLength}`);
  }
  const view = new DataView(bytes);
  const sums = new Float32Array(bytes, 20, 16);
  let offset = HEAD;
  const floats = (count: number): Float32Array => {
    const array = new Float32Array(bytes, offset, count);
    offset += 4 * count;
    return array;
  };
  const frame = {
    bytes,
    run: view.getUint8(1),
    epoch: view.getUint16(2, true),
    step: view.getUint32(4, true),
    timeOnTarget: sums[0],
    timeOnTargetRecent: sums[1],
    xi: sums[2],
    xiNow: sums[3],
    engaged: sums[4],
    phi: sums.subarray(5, 16),
    lean,
    x: floats(agents),
    y: floats(agents),
    vx: floats(detailed),
    vy: floats(detailed),
    repulsion: floats(detailed),
    memory: Array.from({ length: fields }, () => floats(agents)),
    targetX: floats(targets),
    targetY: floats(targets),
  };
  return {
    ...frame,
    degree: new Uint16Array(bytes, offset, detailed),
    flags: new Uint8Array(bytes, (offset += 2 * detailed), agents),
    present: new Uint8Array(bytes, (offset += agents), targets),
    linkBytes,
    links: new Uint8Array(bytes, offset + targets, agents * linkBytes),
  };
}

/** Cut frames that lie one behind the other; throws ProtocolError where one is cut short. */
export function splitFrames(bytes: Uint8Array<ArrayBuffer>): ArrayBuffer[] {
  const frames: ArrayBuffer[] = [];
  for (let begin = 0; begin < bytes.length; ) {
    const { size } = readSize(new DataView(bytes.buffer, bytes.byteOffset + begin));
    if (begin + size > bytes.length) throw new ProtocolError(`frame ${frames.length} is cut short`);
    const start = bytes.byteOffset + begin;
    frames.push(bytes.buffer.slice(start, start + size)); // copies: their arrays must be aligned
    begin += size;
  }
  return frames;
}

/** Read a text message; throws ProtocolError on one of no known type. */
export function parseMessage(text: string): Message {
  let message: unknown;
  try {
    message = JSON.parse(text);
  } catch {
    throw new ProtocolError("the engine sent text that is no JSON");
  }
  const type = (message as { type?: unknown } | null)?.type;
  if (["hello", "history", "scene", "status", "error", "numbers", "file"].includes(type as string)) return message as Message;
  throw new ProtocolError(`the engine sent a message of unknown type ${String(type)}`);
}

function readSize(view: DataView): { agents: number; targets: number; linkBytes: number; fields: number; size: number; lean: boolean } {
  if (view.byteLength < HEAD) throw new ProtocolError(`a frame has at least ${HEAD} bytes, not ${view.byteLength}`);
  const version = view.getUint8(0);
  if (version !== VERSION && version !== LEAN) {
    throw new ProtocolError(`frames have format ${version}; this page reads formats ${VERSION} and ${LEAN}`);
  }
  const lean = version === LEAN;
  const agents = view.getUint32(8, true);
  const targets = view.getUint32(12, true);
  const linkBytes = view.getUint16(16, true);
  const fields = view.getUint16(18, true);
  const each = (lean ? 9 : 23) + 4 * fields + linkBytes; // bytes of an agent
  return { agents, targets, linkBytes, fields, size: HEAD + each * agents + 9 * targets, lean };
}
