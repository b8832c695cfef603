// The panel of numbers: each measure with its value now, its history, and the record's own table in replays.

import { drawLines, drawPhi, type Line } from "./chart";
import { el } from "./dom";
import { count, estimate, fixed } from "./format";
import { type History, recorded, type Series } from "./history";
import { TARGET_COLOR, type Theme } from "./palette";
import type { Frame, Metric, Scene } from "./protocol";

interface Measure {
  title: string;
  unit: string;
  value: Series; // the number written
  recent: Series | null; // the fine line behind it
  recentWords: string;
  record: "time_on_target" | "xi" | null;
  decimals: number;
  top: number | null; // of the axis; null: the highest value
  least: number; // of that
}

const MEASURES: Measure[] = [
  {
    title: "Time on target",
    unit: "share of steps",
    value: "timeOnTarget",
    recent: "timeOnTargetRecent",
    recentWords: "last 1\u2009000",
    record: "time_on_target",
    decimals: 3,
    top: 1,
    least: 1,
  },
  {
    title: "Velocity fluctuation Ξ",
    unit: "of mean top speed",
    value: "xi",
    recent: "xiNow",
    recentWords: "now",
    record: "xi",
    decimals: 3,
    top: null,
    least: 0.01,
  },
  {
    title: "Engaged",
    unit: "agents on target now",
    value: "engaged",
    recent: null,
    recentWords: "",
    record: null,
    decimals: 0,
    top: null,
    least: 1,
  },
];

/** What one run has to show. */
export interface RunNumbers {
  history: History;
  scene: Scene | null;
  frame: Frame | null;
  since: number; // step at which the means of the frame began
  marks: number[]; // steps at which the swarm was changed
}

interface Card {
  measure: Measure;
  value: HTMLElement;
  words: HTMLElement;
  canvas: HTMLCanvasElement;
}

export class Numbers {
  readonly root = el("section", { class: "numbers", "aria-label": "Numbers" });
  private readonly cards: Card[];
  private readonly phi = el("canvas", { class: "phi", role: "img", "aria-label": "Histogram of the heading-bearing correlation phi" });
  /** The record's own metrics, where there are any. */
  readonly table = el("section", { class: "card record", "aria-label": "Metrics of the record", hidden: true });

  constructor(private readonly letters: string[]) {
    this.cards = MEASURES.map((measure) => {
      const canvas = el("canvas", { role: "img", "aria-label": `${measure.title} over steps` });
      const card = { measure, canvas, value: el("div", { class: "value" }), words: el("p", { class: "words" }) };
      this.root.append(el("section", { class: "card" }, el("div", { class: "top" }, el("h3", {}, measure.title), card.value), card.words, canvas));
      return card;
    });
    this.root.append(
      el(
        "section",
        { class: "card" },
        el("div", { class: "top" }, el("h3", {}, "Heading to target φ")),
        el("p", { class: "words" }, "agents by cos(heading, bearing) now"),
        this.phi,
      ),
    );
  }

  describe(scene: Scene): void {
    this.table.hidden = !scene.metrics?.length;
    if (!scene.metrics?.length) return;
    this.table.replaceChildren(
      el("div", { class: "top" }, el("h3", {}, "Metrics of the record")),
      el(
        "table",
        { id: "metrics" },
        el("thead", {}, el("tr", {}, ...["metric", "mean", "95 % interval"].map((name) => el("th", { scope: "col" }, name)))),
        el("tbody", {}, ...scene.metrics.map(metricRow)),
      ),
      el("p", { class: "words" }, scene.strategy.summary),
    );
  }

  draw(theme: Theme, runs: RunNumbers[], last: number): void {
    const frames = runs.map((run) => run.frame);
    const first = Math.min(...runs.map((run) => run.history.step[0] ?? run.frame?.step ?? 0));
    const shown = Math.max(0, ...frames.map((frame) => frame?.step ?? 0));
    const marks = runs.flatMap((run) => run.marks);
    for (const { measure, value, words, canvas } of this.cards) {
      value.replaceChildren(
        ...runs.map((run, n) => {
          const text = fixed(run.frame ? run.frame[measure.value] : NaN, measure.decimals);
          return this.letters[n] ? el("span", {}, el("b", { class: `letter run-${n}` }, this.letters[n]), text) : el("span", {}, text);
        }),
      );
      words.textContent = this.caption(measure, runs);
      const lines = runs.flatMap((run, n) => linesOf(measure, run, n, runs.length, theme));
      drawLines(canvas, theme, lines, { first, last, top: measure.top, least: measure.least, marks, shown });
    }
    const bars = frames.flatMap((frame, n) => (frame ? [{ phi: frame.phi, color: runColor(n, runs.length, theme, theme.ink) }] : []));
    drawPhi(this.phi, theme, bars);
  }

  private caption(measure: Measure, runs: RunNumbers[]): string {
    const { frame, since } = runs[0];
    const unit = measure.recent && since > 0 ? `since step ${count(since)}` : measure.unit;
    if (!measure.recent || runs.length > 1) return unit;
    return `${unit} · ${measure.recentWords}: ${fixed(frame ? frame[measure.recent] : NaN, measure.decimals)}`;
  }
}

function linesOf(measure: Measure, run: RunNumbers, number: number, runs: number, theme: Theme): Line[] {
  const { step, values } = run.history;
  const color = runColor(number, runs, theme, measure.value === "timeOnTarget" ? TARGET_COLOR : theme.ink);
  const dash = number === 1 ? [5, 3] : [];
  const batches = measure.record ? recorded(run.scene, measure.record) : null;
  const lines: Line[] = [];
  if (batches) lines.push({ ...batches, color: theme.muted, width: 1 });
  else if (measure.recent && runs === 1) lines.push({ step, values: values[measure.recent], color: theme.muted, width: 1 });
  lines.push({ step, values: values[measure.value], color, width: measure.recent ? 2 : 1.2, dash });
  return lines;
}

function runColor(run: number, runs: number, theme: Theme, alone: string): string {
  if (runs === 1) return alone;
  return run === 0 ? theme.ink : theme.secondRun;
}

function metricRow({ name, label, unit, mean, low, high }: Metric): HTMLElement {
  const text = estimate(mean, low, high);
  return el(
    "tr",
    { "data-metric": name },
    el("th", { scope: "row" }, label, unit === "1" ? null : el("span", { class: "of" }, ` [${unit}]`)),
    el("td", { class: "mean" }, text.mean),
    el("td", { class: "interval" }, text.interval),
  );
}
