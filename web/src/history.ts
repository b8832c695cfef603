// The numbers of a run over time, thinned so that a long run stays light.

import type { Frame, Past, Scene } from "./protocol";

const MOST = 4000; // points; then every second one goes

export const SERIES = ["timeOnTarget", "timeOnTargetRecent", "xi", "xiNow", "engaged"] as const;
export type Series = (typeof SERIES)[number];

const NAMES = {
  timeOnTarget: "time_on_target",
  timeOnTargetRecent: "recent",
  xi: "xi",
  xiNow: "xi_now",
  engaged: "engaged",
} as const;

export class History {
  readonly step: number[] = [];
  readonly values: Record<Series, number[]> = { timeOnTarget: [], timeOnTargetRecent: [], xi: [], xiNow: [], engaged: [] };
  private every = 1; // least steps between two points

  add(frame: Frame): void {
    const last = this.step[this.step.length - 1] ?? -Infinity;
    if (frame.step < last + this.every) return;
    this.step.push(frame.step);
    for (const name of SERIES) this.values[name].push(frame[name]);
    if (this.step.length > MOST) this.thin();
  }

  /** Begin with what went on before the page was opened. */
  fill(past: Past): void {
    this.cut(-1);
    this.step.push(...past.step);
    for (const name of SERIES) this.values[name].push(...past[NAMES[name]].map((value) => value ?? NaN));
  }

  /** Forget what comes after a step. */
  cut(step: number): void {
    let length = this.step.length;
    while (length > 0 && this.step[length - 1] > step) length--;
    this.step.length = length;
    for (const name of SERIES) this.values[name].length = length;
    if (length === 0) this.every = 1;
  }

  private thin(): void {
    const keep = <T>(_: T, index: number): boolean => index % 2 === 0;
    this.every = Math.max(2 * this.every, Math.ceil((this.step[this.step.length - 1] - this.step[0]) / MOST));
    const step = this.step.filter(keep);
    this.step.splice(0, Infinity, ...step);
    for (const name of SERIES) this.values[name] = this.values[name].filter(keep);
  }
}

/** Points of a record's own history, over batches of its steps. */
export function recorded(scene: Scene | null, name: "time_on_target" | "xi"): { step: number[]; values: number[] } | null {
  const history = scene?.history;
  return history ? { step: history.step, values: history[name].map((value) => value ?? NaN) } : null;
}
