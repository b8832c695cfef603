// Which lines a chart of a metric has: the mean so far, what it is right now, and in replays the batches of the record.

import { lastAt } from "./axis";
import { count } from "./format";
import type { History } from "./history";
import { TARGET_COLOR, type Theme } from "./palette";
import type { Line } from "./plot";
import type { Frame, Past, Scene, Series, Measured } from "./protocol";

/** What one run has to show. */
export interface RunNumbers {
  history: History;
  scene: Scene | null;
  frame: Frame | null;
  since: number; // step at which the means of the frame began
  marks: number[]; // steps at which the swarm was changed
  past: Past | null; // what went on before the page was opened, until the scene comes
  measured: Measured | null; // the metrics of the frame that comes next
}

/** What is told of a metric besides its mean. */
const MOMENTARY: Record<string, { series: string; words: string; whole: boolean }> = {
  time_on_target: { series: "recent", words: "last 1\u2009000", whole: false },
  xi: { series: "xi_now", words: "this step", whole: false },
  engaged: { series: "engaged_now", words: "now", whole: true },
};

/** The lines of a metric; the first of each run is the one to read. */
export function linesOf(metric: Series, runs: RunNumbers[], theme: Theme): Line[] {
  const two = runs.length > 1;
  const mains = runs
    .filter((run) => two || run.history.has(metric.name))
    .map(
      (run, n): Line => ({
        words: two ? "AB"[n] : since(run),
        ...upToShown(run, metric.name),
        width: 2,
        dash: n === 1 ? [5, 3] : [],
        color: runColor(n, runs.length, theme, metric.name === "time_on_target" ? TARGET_COLOR : theme.ink),
      }),
    );
  if (two) return mains;
  const [run] = runs;
  const lines = [...mains];
  const fine = { width: 1, dash: [], color: theme.muted };
  const moment = MOMENTARY[metric.name];
  const batches = run.scene?.history?.values[metric.name];
  if (moment && !(batches && metric.name !== "engaged")) {
    lines.push({ words: moment.words, whole: moment.whole, ...upToShown(run, moment.series), ...fine });
  }
  if (batches) lines.push({ words: "batches, whole run", ...centered(run.scene!, batches), ...fine, dash: [3, 2] });
  return lines;
}

export function runColor(run: number, runs: number, theme: Theme, alone: string): string {
  if (runs === 1) return alone;
  return run === 0 ? theme.ink : theme.secondRun;
}

function since({ since }: RunNumbers): string {
  return since > 0 ? `since step ${count(since)}` : "so far";
}

/** A series; of a record only until the frame shown, for what comes later has not been yet. */
function upToShown({ history, scene, frame }: RunNumbers, name: string): { x: number[]; y: number[] } {
  const y = history.of(name);
  if (!scene?.history || !frame) return { x: history.step, y };
  const length = lastAt(history.step, frame.step) + 1;
  return { x: history.step.slice(0, length), y: y.slice(0, length) };
}

/** Means of batches, each in the middle of its steps. */
function centered(scene: Scene, batches: (number | null)[]): { x: number[]; y: number[] } {
  const begins = scene.history!.step;
  const x = begins.map((step, n) => (step + (begins[n + 1] ?? scene.steps)) / 2);
  return { x, y: batches.map((value) => value ?? NaN) };
}
