// What the run is and what disturbs it: k as it is, what is lost or late, who is gone and since when.

import { el } from "./dom";
import { count, fixed, short } from "./format";
import { hears } from "./links";
import { isAlive, type Frame, type Scene } from "./protocol";

const NAMED = 40; // comings and goings in the list

export type Event = [step: number, what: "lost" | "joined", agent: number];

/** One run's state, as the panel tells it. */
export interface Told {
  letter: string;
  scene: Scene;
  frame: Frame | null;
}

export class Conditions {
  readonly root = el("section", { class: "card conditions", "aria-label": "This run" });
  private readonly list = el("ul", { class: "facts" });
  private readonly now = el("dl", { class: "now" });
  private readonly events = el("ul", { class: "facts events", "aria-label": "Who was lost and who joined" });
  private seen: (Uint8Array | null)[] = []; // of each run, who was there in the frame before
  private extra: Event[][] = []; // of each run, those that the scene did not know: batteries, orders
  private shown = "";

  constructor() {
    this.root.append(el("div", { class: "top" }, el("h3", {}, "This run")), this.list, this.now, this.events);
  }

  describe(runs: Told[]): void {
    const items = runs.flatMap(({ letter, scene }) => {
      const steered = (scene.steered ?? []).map(({ step, words }) => `step ${count(step)}: ${words}`);
      const words = [...phrases(scene), ...scene.conditions, ...steered];
      return [letter ? `${letter}: ${words.join(" · ")}` : words].flat();
    });
    this.list.replaceChildren(...items.map((words) => el("li", {}, words)));
    this.seen = runs.map(() => null);
    this.extra = runs.map(() => []);
  }

  /** Say what frames show: k now, reports that were heard, who is gone. */
  tell(runs: Told[]): void {
    const rows: [string, string][] = [];
    const events: string[] = [];
    runs.forEach(({ letter, scene, frame }, run) => {
      if (!frame) return;
      this.watch(run, scene, frame);
      const name = (words: string): string => (letter ? `${letter}: ${words}` : words);
      const alive = frame.flags.reduce((sum, _, agent) => sum + Number(isAlive(frame, agent)), 0);
      if (alive < frame.flags.length) rows.push([name("Buoys there"), `${count(alive)} of ${count(frame.flags.length)}`]);
      if (scene.adapts && !frame.lean) rows.push([name("k now, mean"), fixed(mean(frame), 1)]);
      const share = heardShare(frame);
      if (share !== null && (scene.conditions.length > 0 || share < 0.9995)) rows.push([name("Heard, of k asked for"), `${fixed(100 * share, 0)} %`]);
      events.push(...happened(scene, frame.step, this.extra[run] ?? []).map((words) => name(words)));
    });
    const text = JSON.stringify([rows, events]);
    if (text === this.shown) return;
    this.shown = text;
    this.now.replaceChildren(...rows.flatMap(([words, value]) => [el("dt", {}, words), el("dd", {}, value)]));
    this.events.replaceChildren(
      ...events
        .slice(-NAMED)
        .reverse()
        .map((words) => el("li", {}, words)),
    );
    this.events.hidden = events.length === 0;
  }

  private watch(run: number, scene: Scene, frame: Frame): void {
    const before = this.seen[run];
    this.seen[run] = frame.flags;
    if (before?.length !== frame.flags.length) return;
    frame.flags.forEach((flags, agent) => {
      if ((flags & 2) === ((before[agent] ?? 0) & 2)) return;
      const what = flags & 2 ? "joined" : "lost";
      const known = scene.events.some((event) => event[2] === agent && event[1] === what);
      const again = this.extra[run]?.some((event) => event[2] === agent && event[1] === what);
      if (!known && !again) this.extra[run]?.push([frame.step, what, agent]);
    });
  }
}

/** What a run is, in phrases. */
export function phrases(scene: Scene): string[] {
  const agents = scene.fleets.reduce((sum, fleet) => sum + fleet.count, 0);
  const speeds = scene.targets.map(({ name, kind, speed }) => name ?? (speed === null ? kind : `${short(speed)} m/s`));
  return [
    `${count(agents)} buoys`,
    `k = ${scene.k}`,
    scene.strategies,
    `${speeds.length > 1 ? `${speeds.length} targets` : "target"} ${[...new Set(speeds)].join(", ")}`,
    `seed ${scene.seed}`,
  ];
}

/** Comings and goings up to a step, in their order; agents of one step together. */
export function happened(scene: Pick<Scene, "events">, step: number, extra: Event[] = []): string[] {
  const groups = new Map<string, { step: number; by: boolean; what: string; agents: number[] }>();
  for (const [events, by] of [
    [scene.events, false],
    [extra, true],
  ] as const) {
    for (const [when, what, agent] of events) {
      if (when > step) continue;
      const key = `${when} ${what} ${by}`;
      const group = groups.get(key) ?? { step: when, by, what, agents: [] };
      group.agents.push(agent);
      groups.set(key, group);
    }
  }
  return [...groups.values()]
    .sort((a, b) => a.step - b.step)
    .map(
      ({ step: when, by, what, agents }) =>
        `${by ? "by step" : "step"} ${count(when)}: no. ${agents.slice(0, 12).join(", ")}${agents.length > 12 ? " …" : ""} ${what}`,
    );
}

/** The share of the reports that living agents asked for, k each, that they really heard; null where links are not told. */
export function heardShare(frame: Frame): number | null {
  if (frame.linkBytes === 0 || frame.lean) return null;
  let [heard, asked] = [0, 0];
  const there = frame.flags.reduce((sum, _, agent) => sum + Number(isAlive(frame, agent)), 0);
  for (let agent = 0; agent < frame.flags.length; agent++) {
    if (!isAlive(frame, agent)) continue;
    asked += Math.min(frame.degree[agent] ?? 0, there - 1);
    for (let other = 0; other < frame.flags.length; other++) heard += Number(hears(frame, agent, other));
  }
  return asked > 0 ? heard / asked : null;
}

function mean(frame: Frame): number {
  let [sum, living] = [0, 0];
  frame.degree.forEach((k, agent) => {
    if (!isAlive(frame, agent)) return;
    sum += k;
    living++;
  });
  return sum / living;
}
