// Where water, numbers and controls lie: the arrangement in which the water is largest, for any screen and arena.

import { padded } from "./camera";
import { byId, el } from "./dom";
import type { Scene } from "./protocol";

export interface Size {
  width: number;
  height: number;
}

/**
 * beside: numbers and controls in two columns beside the water; column: in one. below: numbers under the water, controls
 * beside it. sheet: all under the water, which stays in sight. short: water over the whole height, everything else beside it.
 */
export type Layout = "beside" | "below" | "column" | "sheet" | "short";

export interface Plan {
  layout: Layout;
  side: number; // [px] width of what is beside the water, 0 for nothing
  stages: number; // [px] height of the water with its caption and axes, where something is under it
  stacked: boolean; // of two runs: one over the other
  map: Size; // [px] of one run's area
}

const HEAD = 47; // [px]
const BAR = 54;
const AXES: Size = { width: 66, height: 48 };
const CAPTION = 44; // what is shown now, and the legend
const GAP = 18;
const SLACK = 8;
const STRIP = 200; // numbers in a row
const LOW = 480; // a screen that is turned sideways
const FINGERS = 60; // [px] that bars for them are higher
const NARROW = 760;
const DESK = 1100;
const BETTER = 1.05; // what is less usual must give so much more water

/** The best arrangement for a window, `runs` arenas of an aspect (width over height), and panels that are shown or not. */
export function arrange(window: Size, aspect: number, runs: number, panels: boolean): Plan {
  const { width, height } = window;
  const under = height - HEAD - BAR;
  const plan = (layout: Layout, beside: number, room: Size, widest = 0): Plan => {
    const { map, stacked } = largest(room, aspect, runs, layout === "short" ? CAPTION / 2 : CAPTION);
    const columns = stacked ? 1 : runs;
    const spare = width - GAP - columns * (map.width + AXES.width);
    const side = widest > 0 ? Math.round(Math.min(Math.max(spare, beside), widest)) : beside;
    const rows = stacked ? runs : 1;
    return { layout, side, stacked, map, stages: Math.round(rows * (map.height + AXES.height + CAPTION + SLACK) + GAP) };
  };
  const beside = (least: number, layout: Layout, widest: number): Plan => plan(layout, least, { width: width - GAP - least, height: under - GAP }, widest);
  if (!panels) return plan("column", 0, { width: width - GAP, height: under - GAP });
  if (height < LOW && width >= 560) {
    return plan("short", 280, { width: width - GAP - 280, height: height - GAP }, Math.round(0.6 * width));
  }
  const least = Math.max(0.33 * height, 230) + FINGERS; // of what is under the water
  const sheet = plan("sheet", 0, { width: width - GAP, height: Math.max(under - GAP - least, 200) });
  if (width < NARROW) return sheet;
  const below = plan("below", 336, { width: width - GAP - 336, height: under - GAP - STRIP });
  const wide = width >= DESK ? beside(runs > 1 ? 580 : 548, "beside", 0.6 * width) : beside(320, "column", 440);
  const others = height > width ? [below, sheet] : [below];
  return others.reduce((best, each) => (area(each) > BETTER * area(best) ? each : best), wide);
}

/** The largest area of a run, side by side or one over the other. */
function largest(room: Size, aspect: number, runs: number, caption: number): { map: Size; stacked: boolean } {
  const fit = (width: number, height: number): Size => {
    const high = Math.max(Math.min(height - caption - AXES.height, (width - AXES.width) / aspect), 20);
    return { width: high * aspect, height: high };
  };
  const across = fit(room.width / runs, room.height);
  const down = fit(room.width, room.height / runs);
  const stacked = runs > 1 && down.height > across.height;
  return { map: stacked ? down : across, stacked };
}

const area = ({ map }: Plan): number => map.width * map.height;

/** Keeps the page arranged: the window, the arena, the number of runs, panels shown or not. */
export class Arrangement {
  /** Which half of the panels a small screen shows. */
  readonly tabs = el("div", { class: "segments tabs", role: "radiogroup", "aria-label": "Panels" });
  private aspect = 1;
  private runs = 1;
  private panels = true;

  constructor(private readonly onChange: () => void) {
    for (const [words, name] of [
      ["Controls", "controls"],
      ["Numbers", "numbers"],
    ] as const) {
      const input = el("input", { type: "radio", name: "tab", value: name });
      input.checked = name === "controls";
      input.onchange = () => {
        document.body.dataset.tab = name;
      };
      this.tabs.append(el("label", {}, input, el("span", {}, words)));
    }
    document.body.dataset.tab = "controls";
    byId("panels").onclick = () => {
      this.toggle();
    };
    new ResizeObserver(() => this.apply()).observe(document.documentElement);
  }

  /** Learn what is to be seen. */
  describe(scenes: Scene[], runs: number): void {
    const [scene] = scenes;
    if (scene) {
      const { width, height } = padded(scene.area);
      this.aspect = width / height;
    }
    this.runs = runs;
    this.apply();
  }

  /** Show the panels, or leave all room to the water. */
  toggle(): void {
    this.panels = !this.panels;
    byId("panels").setAttribute("aria-pressed", String(this.panels));
    this.apply();
  }

  private apply(): void {
    const plan = arrange({ width: innerWidth, height: innerHeight }, this.aspect, this.runs, this.panels);
    const { dataset, style } = document.body;
    dataset.layout = plan.layout;
    dataset.panels = this.panels ? "on" : "off";
    dataset.stacked = String(plan.stacked);
    style.setProperty("--side", `${plan.side}px`);
    style.setProperty("--stages", `${plan.stages}px`);
    this.onChange();
  }
}
