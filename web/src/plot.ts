// Lines over time on uPlot: one cursor and one zoom for all charts, axes that fit, marks where something happened.

import uPlot from "uplot";
import { axisRange, lastAt, type AxisRange } from "./axis";
import { el } from "./dom";
import { readable } from "./format";
import type { Theme } from "./palette";

export interface Line {
  words: string;
  x: number[]; // rising
  y: number[]; // NaN: none
  color: string;
  width: number;
  dash: number[];
  whole?: boolean; // its values are whole numbers
}

export interface Drawing {
  lines: Line[];
  x: [number, number]; // what is seen
  least: number | null; // bounds of the values
  most: number | null;
  difference: boolean;
  marks: number[]; // where a dotted line is
  ends: number[]; // where a dashed one is
  shown: number | null; // where a full one is
  label: string;
  unit: string; // of x, "" of steps
}

export interface PlotEvents {
  /** Seen from here to there from now on; null: everything. */
  zoom(range: [number, number] | null): void;
  /** The cursor is at an x; null: nowhere. */
  point(x: number | null): void;
}

const FONT = "11px system-ui, sans-serif";
const HIDDEN = { left: 0, top: 0, width: 0, height: 0 };

export class Plot {
  readonly root = el("div", { class: "plot", tabindex: 0, role: "group" });
  axis: AxisRange = { low: 0, high: 1, peak: null };
  private chart: uPlot | null = null;
  private built = ""; // what the chart was built for
  private theme!: Theme;
  private drawing!: Drawing;

  constructor(private readonly events: PlotEvents) {
    this.root.addEventListener("keydown", (event) => {
      this.press(event);
    });
    this.root.addEventListener("blur", () => {
      this.point(null);
    });
    new ResizeObserver(() => {
      this.resize();
    }).observe(this.root);
  }

  draw(theme: Theme, drawing: Drawing): void {
    this.theme = theme;
    this.drawing = drawing;
    this.root.setAttribute("aria-label", `${drawing.label}. Left and right: values; + and -: zoom; Escape: all`);
    const {
      lines,
      x: [from, to],
      least,
      most,
    } = drawing;
    const seen = lines.map(({ x, y }) => y.slice(Math.max(lastAt(x, from), 0), lastAt(x, to) + 1));
    this.axis = axisRange(seen, least, most, drawing.difference);
    const form = JSON.stringify(lines.map(({ width, dash }) => [width, dash]));
    if (form !== this.built) this.build(form);
    this.chart?.setData(aligned(lines));
    this.chart?.ctx.canvas.setAttribute("aria-label", drawing.label);
  }

  private build(form: string): void {
    this.chart?.destroy();
    this.chart = null;
    const { clientWidth: width, clientHeight: height } = this.root;
    if (width < 40 || height < 30) return; // not laid out yet
    this.built = form;
    const axis = {
      font: FONT,
      stroke: () => this.theme.muted,
      ticks: { show: false },
      grid: { stroke: () => this.theme.line, width: 1 },
      values: (_: uPlot, splits: number[]) => splits.map(readable),
    };
    this.chart = new uPlot(
      {
        width,
        height,
        legend: { show: false },
        padding: [6, 6, 0, 0],
        scales: { x: { time: false, range: () => this.drawing.x }, y: { range: () => [this.axis.low, this.axis.high] } },
        axes: [
          { ...axis, size: 20, gap: 5, space: 64, grid: { show: false }, values: (_, splits) => splits.map((x, n) => this.word(x, n, splits.length)) },
          { ...axis, gap: 3, space: 20, size: (_, values) => 8 + 6.1 * Math.max(2, ...(values ?? []).map((each) => each.length)) },
        ],
        series: [
          {},
          ...this.drawing.lines.map(({ width, dash }, n) => ({
            stroke: () => this.drawing.lines[n]?.color ?? "",
            width,
            dash,
            points: { show: false },
          })),
        ],
        cursor: {
          sync: { key: "shoal", scales: ["x", null] },
          drag: { x: true, y: false, setScale: false },
          y: false,
          points: { size: 6 },
          bind: {
            dblclick: () => () => {
              this.events.zoom(null);
              return null;
            },
          },
        },
        hooks: {
          setSelect: [
            (chart) => {
              const { left, width } = chart.select;
              chart.setSelect(HIDDEN, false);
              if (width > 3) this.events.zoom([chart.posToVal(left, "x"), chart.posToVal(left + width, "x")]);
            },
          ],
          setCursor: [
            (chart) => {
              this.events.point(chart.cursor.idx == null ? null : chart.data[0][chart.cursor.idx]);
            },
          ],
          drawClear: [
            (chart) => {
              this.mark(chart);
            },
          ],
        },
      },
      aligned(this.drawing.lines),
      this.root,
    );
    this.chart.ctx.canvas.setAttribute("role", "img");
  }

  /** A label of the x axis: the first one names steps, the last one a unit. */
  private word(x: number, n: number, labels: number): string {
    const { unit } = this.drawing;
    if (unit) return n === labels - 1 ? `${readable(x)} ${unit}` : readable(x);
    return n === 0 ? `step ${readable(x)}` : readable(x);
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.root;
    if (!this.drawing || width < 40 || height < 30) return;
    if (this.chart) this.chart.setSize({ width, height });
    else this.draw(this.theme, this.drawing);
  }

  private mark(chart: uPlot): void {
    const {
      marks,
      ends,
      shown,
      x: [from, to],
    } = this.drawing;
    const {
      ctx,
      bbox: { top, height },
    } = chart;
    const line = (at: number, dash: number[], color: string): void => {
      if (at < from || at > to) return;
      const x = Math.round(chart.valToPos(at, "x", true)) + 0.5;
      ctx.strokeStyle = color;
      ctx.setLineDash(dash.map((each) => each * devicePixelRatio));
      ctx.beginPath();
      ctx.moveTo(x, top);
      ctx.lineTo(x, top + height);
      ctx.stroke();
    };
    ctx.save();
    ctx.lineWidth = devicePixelRatio;
    for (const at of marks) line(at, [1, 2], this.theme.muted);
    for (const at of ends) line(at, [6, 3], this.theme.muted);
    if (shown !== null && shown < to) line(shown, [], this.theme.ink);
    ctx.restore();
  }

  private press(event: KeyboardEvent): void {
    const { chart } = this;
    if (!chart || event.ctrlKey || event.metaKey || event.altKey) return;
    const steps = chart.data[0];
    const [from, to] = this.drawing.x;
    const at = chart.cursor.idx ?? lastAt(steps, to);
    const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    const center = steps[at] ?? to;
    const zoom = (factor: number): void => {
      this.events.zoom([center - (center - from) * factor, center + (to - center) * factor]);
    };
    if (by) this.point(Math.min(Math.max(at + by * (event.shiftKey ? 10 : 1), 0), steps.length - 1));
    else if (event.key === "+" || event.key === "=") zoom(0.5);
    else if (event.key === "-") zoom(2);
    else if (event.key === "Escape") this.events.zoom(null);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** Put the cursor on a point, or away. */
  private point(index: number | null): void {
    const { chart } = this;
    if (!chart) return;
    chart.setCursor(index === null ? { left: -10, top: -10 } : { left: chart.valToPos(chart.data[0][index], "x"), top: 1 });
    if (index !== null) this.events.point(chart.data[0][index]);
  }
}

/** What a line says at an x: the value of its last point there or before. */
export function valueAt({ x, y }: Line, at: number): number {
  const index = lastAt(x, at);
  return index < 0 ? NaN : y[index];
}

function aligned(lines: Line[]): uPlot.AlignedData {
  const gaps = (values: number[]): (number | null)[] => values.map((value) => (Number.isFinite(value) ? value : null));
  const [first] = lines;
  if (!first) return [[]];
  if (lines.every(({ x }) => x === first.x)) return [first.x, ...lines.map(({ y }) => gaps(y))] as uPlot.AlignedData;
  return uPlot.join(lines.map(({ x, y }) => [x, gaps(y)] as uPlot.AlignedData));
}
