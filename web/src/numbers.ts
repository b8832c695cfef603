// The panel of numbers: charts of whatever metrics the run gives, phi, and the record's own table in replays.

import { drawPhi } from "./chart";
import { timeUnit } from "./axis";
import { el } from "./dom";
import { count, estimate, readable, steady } from "./format";
import { linesOf, runColor, type RunNumbers } from "./lines";
import type { Theme } from "./palette";
import { Plot, valueAt, type Line } from "./plot";
import type { Metric, Scene, Series } from "./protocol";

export type { RunNumbers } from "./lines";

const CHARTS = 3;

interface Card {
  name: string; // of the metric
  select: HTMLSelectElement;
  value: HTMLElement;
  key: HTMLElement; // legend with values
  plot: Plot;
  lines: Line[];
}

export class Numbers {
  readonly root = el("section", { class: "numbers", "aria-label": "Numbers" });
  private readonly cards: Card[];
  private readonly phi = el("canvas", { class: "phi", role: "img", "aria-label": "Histogram of the heading-bearing correlation phi" });
  /** The record's own metrics, where there are any. */
  readonly table = el("section", { class: "card record", "aria-label": "Metrics of the record", hidden: true });
  /** What holds for all charts. */
  readonly tools = el("section", { class: "card", "aria-label": "Charts" });
  private readonly inTime = el("input", { type: "checkbox", role: "switch", id: "in-time" });
  private readonly difference = el("input", { type: "checkbox", role: "switch", id: "difference" });
  private readonly whole = el("button", { type: "button", hidden: true, title: "Double click a chart, or Escape on it" }, "Show whole run");
  private series: Series[] = [];
  private zoom: [number, number] | null = null; // as the axis counts
  private cursor: number | null = null;
  private again = (): void => undefined;

  constructor(letters: string[]) {
    const redraw = (): void => {
      this.again();
    };
    this.whole.onclick = () => {
      this.see(null);
    };
    this.inTime.onchange = () => {
      this.zoom = this.cursor = null;
      redraw();
    };
    this.difference.onchange = redraw;
    const switches = el("div", { class: "switches" }, choice(this.inTime, "Over time, not steps"));
    if (letters.length > 1) switches.append(choice(this.difference, "Difference B − A"));
    this.tools.append(
      el("div", { class: "top" }, el("h3", {}, "Charts"), this.whole),
      switches,
      el("p", { class: "words" }, "Point at a chart for its values. Drag along it to look closer."),
    );
    this.cards = Array.from({ length: CHARTS }, (_, n) => this.card(n));
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
    this.offer(scene.series ?? []);
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
    this.again = () => {
      this.draw(theme, runs, last);
    };
    const frames = runs.map((run) => run.frame);
    const first = Math.min(...runs.map((run) => run.history.step[0] ?? run.frame?.step ?? 0));
    const shown = Math.max(0, ...frames.map((frame) => frame?.step ?? 0));
    const timeStep = runs[0].scene?.time_step ?? 1;
    const unit = timeUnit(last * timeStep);
    const scale = this.inTime.checked ? timeStep / unit.seconds : 1;
    const toAxis = scaling(scale);
    const all: [number, number] = [first * scale, Math.max(last, first + 1) * scale];
    const scenes = runs.flatMap(({ scene }) => scene ?? []);
    const marks = [...runs.flatMap((run) => run.marks), ...scenes.flatMap(({ steered }) => (steered ?? []).map(({ step }) => step))];
    const ends = scenes.flatMap(({ ends }) => ends ?? []);
    this.whole.hidden = this.zoom === null;
    for (const card of this.cards) {
      const metric = this.series.find(({ name }) => name === card.name);
      if (!metric) continue;
      const minus = this.difference.checked && runs.length > 1;
      const lines = minus ? linesOf(metric, runs, theme).filter((_, n) => n < 2) : linesOf(metric, runs, theme);
      card.lines = (minus ? [differenceOf(lines, theme)] : lines).map((line) => ({ ...line, x: toAxis(line.x) }));
      card.plot.draw(theme, {
        lines: card.lines,
        x: this.zoom ?? all,
        least: metric.least,
        most: metric.most,
        difference: minus,
        marks: marks.map((step) => step * scale),
        ends: ends.map((step) => step * scale),
        shown: shown * scale,
        unit: this.inTime.checked ? unit.name : "",
        label: `${title(metric)} over ${this.inTime.checked ? `time [${unit.name}]` : "steps"}`,
      });
      this.tell(card, metric, runs, shown * scale, this.inTime.checked ? unit.name : "");
    }
    const bars = frames.flatMap((frame, n) => (frame ? [{ phi: frame.phi, color: runColor(n, runs.length, theme, theme.ink) }] : []));
    drawPhi(this.phi, theme, bars);
  }

  /** The last x of each line of a chart. */
  lasts(chart: number): Record<string, number> {
    return Object.fromEntries((this.cards[chart]?.lines ?? []).map(({ words, x }) => [words, x[x.length - 1]]));
  }

  private card(n: number): Card {
    const select = el("select", { class: "metric", "aria-label": `Metric of chart ${n + 1}` });
    const plot = new Plot({
      zoom: (range) => {
        this.see(range);
      },
      point: (x) => {
        if (x === this.cursor) return;
        this.cursor = x;
        requestAnimationFrame(() => {
          this.again();
        });
      },
    });
    const card: Card = { name: "", select, plot, lines: [], value: el("div", { class: "value" }), key: el("p", { class: "words key" }) };
    select.onchange = () => {
      card.name = select.value;
      this.again();
    };
    this.root.append(el("section", { class: "card" }, el("div", { class: "top one" }, el("h3", {}, select), card.value), card.key, plot.root));
    return card;
  }

  private offer(series: Series[]): void {
    if (series.map(({ name }) => name).join() === this.series.map(({ name }) => name).join()) return;
    this.series = series;
    this.cards.forEach((card, n) => {
      if (!series.some(({ name }) => name === card.name)) card.name = series[n]?.name ?? series[0]?.name ?? "";
      card.select.replaceChildren(...series.map((each) => el("option", { value: each.name, title: each.sentence }, title(each))));
      card.select.value = card.name;
    });
  }

  private see(range: [number, number] | null): void {
    this.zoom = range;
    this.again();
  }

  /** The value beside the name, and what the lines are, each with its value at the cursor or at what is shown. */
  private tell(card: Card, metric: Series, runs: RunNumbers[], shown: number, time: string): void {
    const at = this.cursor ?? shown;
    card.select.title = `${metric.sentence}${metric.unit === "1" ? "" : ` [${metric.unit}]`}`;
    const unit = metric.unit === "1" ? null : el("span", { class: "of" }, ` ${metric.unit}`);
    const whole = runs[0].scene?.history && card.lines.length === 1 ? (metric.mean ?? NaN) : null;
    const [main] = card.lines; // of two runs side by side, the key says both
    card.value.replaceChildren(
      ...(main && (runs.length === 1 || card.lines.length === 1)
        ? [el("span", {}, (main.whole ? readable : steady)(whole ?? valueAt(main, shown)), unit)]
        : []),
    );
    const peak = card.plot.axis.peak;
    const where = this.cursor === null ? "" : time ? `at ${readable(at)} ${time}` : `at step ${count(at)}`;
    card.key.replaceChildren(
      ...card.lines.map((line) =>
        el(
          "span",
          {},
          swatch(line),
          `${line.words} `,
          el("b", {}, (line.whole ? readable : steady)(valueAt(line, at)), card.lines.length > 1 && runs.length > 1 ? (unit?.cloneNode(true) ?? null) : null),
        ),
      ),
      where || (peak === null ? "" : `peak: ${readable(peak)}`),
    );
  }
}

/** The name of a metric as a title: time on target becomes Time on target. */
export function title({ label }: Series): string {
  return (label.charAt(0).toUpperCase() + label.slice(1)).replace(/\bXi\b/, "Ξ");
}

/** From steps to what the axis counts; of the same steps the same numbers. */
function scaling(scale: number): (steps: number[]) => number[] {
  const known = new Map<number[], number[]>();
  return (steps) => {
    if (scale === 1) return steps;
    const made = known.get(steps) ?? steps.map((step) => step * scale);
    known.set(steps, made);
    return made;
  };
}

function differenceOf([a, b]: Line[], theme: Theme): Line {
  return { ...a, words: "B − A", dash: [], color: theme.ink, y: a.x.map((step, n) => valueAt(b, step) - a.y[n]) };
}

function swatch({ color, width, dash }: Line): HTMLElement {
  const made = el("i", { "aria-hidden": true });
  made.style.borderTop = `${Math.max(width, 1.5)}px ${dash.length ? "dashed" : "solid"} ${color}`;
  return made;
}

function choice(input: HTMLInputElement, words: string): HTMLElement {
  return el("label", {}, input, el("span", {}, words));
}

function metricRow({ name, label, unit, sentence, mean, low, high }: Metric): HTMLElement {
  const text = estimate(mean, low, high);
  return el(
    "tr",
    { "data-metric": name, title: sentence },
    el("th", { scope: "row" }, label, unit === "1" ? null : el("span", { class: "of" }, ` [${unit}]`)),
    el("td", { class: "mean" }, text.mean),
    el("td", { class: "interval" }, text.interval),
  );
}
