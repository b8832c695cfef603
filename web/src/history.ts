// The numbers of a run over time, thinned so that a long run stays light.

import type { Frame, Past, Scene } from "./protocol";

const MOST = 4000; // points; then every second one goes

/** What frames say of themselves, by the names of the engine; other series are metrics. */
const GAUGES: Record<string, (frame: Frame) => number> = {
  time_on_target: (frame) => frame.timeOnTarget,
  recent: (frame) => frame.timeOnTargetRecent,
  xi: (frame) => frame.xi,
  xi_now: (frame) => frame.xiNow,
  engaged_now: (frame) => frame.engaged,
};

export class History {
  readonly step: number[] = [];
  private readonly values = new Map<string, number[]>();
  private told_: string[] = []; // of the metrics whose values come with frames
  private every = 1; // least steps between two points

  /** Learn which metrics there are: a scene may have others than the one before. */
  learn(scene: Scene): void {
    this.told_ = (scene.series ?? []).map(({ name }) => name);
  }

  /** The values of a series, as many as there are steps. */
  of(name: string): number[] {
    let known = this.values.get(name);
    if (!known) this.values.set(name, (known = []));
    while (known.length < this.step.length) known.push(NaN);
    return known;
  }

  names(): string[] {
    return [...this.values.keys()];
  }

  has(name: string): boolean {
    return this.values.has(name);
  }

  add(frame: Frame, numbers: (number | null)[] = []): void {
    const last = this.step[this.step.length - 1] ?? -Infinity;
    if (frame.step < last + this.every) return;
    const told = this.told(numbers);
    for (const name of [...Object.keys(GAUGES), ...told.keys()]) this.of(name).push(told.get(name) ?? GAUGES[name]?.(frame) ?? NaN);
    this.step.push(frame.step);
    if (this.step.length > MOST) this.thin();
  }

  /** Begin with what went on before the page was opened. */
  fill(past: Past): void {
    this.cut(-1);
    const old: Record<string, (number | null)[]> = {
      time_on_target: past.time_on_target,
      recent: past.recent,
      xi: past.xi,
      xi_now: past.xi_now,
      engaged_now: past.engaged,
    };
    past.numbers?.forEach((numbers, at) => {
      for (const [name, value] of this.told(numbers)) (old[name] ??= past.step.map(() => null))[at] = value;
    });
    for (const [name, values] of Object.entries(old)) this.of(name).push(...values.map((value) => value ?? NaN));
    this.step.push(...past.step);
  }

  /** Forget what comes after a step. */
  cut(step: number): void {
    let length = this.step.length;
    while (length > 0 && this.step[length - 1] > step) length--;
    for (const name of this.values.keys()) this.of(name).length = length;
    this.step.length = length;
    if (length === 0) this.every = 1;
  }

  /** Values in the order of the scene's series, by name. */
  private told(numbers: (number | null)[]): Map<string, number> {
    return new Map(numbers.map((value, n) => [this.told_[n] ?? "", value ?? NaN]));
  }

  private thin(): void {
    const keep = <T>(_: T, index: number): boolean => index % 2 === 0;
    this.every = Math.max(2 * this.every, Math.ceil((this.step[this.step.length - 1] - this.step[0]) / MOST));
    for (const name of this.values.keys()) this.values.set(name, this.of(name).filter(keep));
    this.step.splice(0, Infinity, ...this.step.filter(keep));
  }
}
