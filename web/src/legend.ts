// What the signs on the water mean.

import { el, svg } from "./dom";
import { styleOf } from "./fleets";
import { count, short } from "./format";
import { fleetGlyph, glyph, TARGET_COLOR } from "./palette";
import type { Scene } from "./protocol";

export class Legend {
  readonly root = el("ul", { class: "legend", "aria-label": "Legend" });
  private readonly gone = el("li", { hidden: true });
  private readonly goneText = document.createTextNode("");
  private readonly silent = el("li", { hidden: true });
  private readonly silentText = document.createTextNode("");
  private readonly dots = el("li", { hidden: true }, "a dot per buoy: zoom in for more");

  describe(scene: Scene): void {
    this.root.replaceChildren();
    for (const fleet of scene.fleets) {
      this.add(fleetGlyph(styleOf(fleet)), `${count(fleet.count)} ${fleet.name}, ${short(fleet.max_speed)} m/s`);
    }
    this.add(glyph("rimmed", "currentColor", svg("circle", { r: 5 })), "reports a target");
    for (const words of targetKinds(scene)) {
      const disc = svg("circle", { r: 6, "fill-opacity": 0.22, fill: "currentColor", stroke: "currentColor" });
      this.add(glyph("target", TARGET_COLOR, disc, svg("path", { d: "M-3 0H3M0-3V3", stroke: "currentColor" })), words);
    }
    const fastest = scene.geography?.currents?.fastest;
    if (fastest !== undefined) this.add(glyph("current", "currentColor", svg("path", { d: "M-7 0H6M2-4L6 0L2 4" })), `current, up to ${short(fastest)} m/s`);
    this.gone.replaceChildren(glyph("gone", "currentColor", svg("path", { d: "M-4-4L4 4M-4 4L4-4" })), this.goneText);
    this.silent.replaceChildren(glyph("hollow", "currentColor", svg("circle", { r: 4.5 })), this.silentText);
    this.root.append(this.gone, this.silent, this.dots);
  }

  /** Agents that are gone, or have not joined yet; those that are there and say nothing; whether all are dots. */
  note(gone: number, silent: number, dotted: boolean): void {
    this.dots.hidden = !dotted;
    this.gone.hidden = gone === 0;
    this.goneText.data = `${count(gone)} not there`;
    this.silent.hidden = silent === 0;
    this.silentText.data = `${count(silent)} silent`;
  }

  private add(picture: SVGElement, words: string): void {
    this.root.append(el("li", {}, picture, words));
  }
}

/** Each kind of target once, in words. */
function targetKinds(scene: Scene): string[] {
  const kinds = scene.targets.map(({ name, kind, speed, radius }) => `${name ?? (speed === null ? kind : `${short(speed)} m/s`)}, ρ ${short(radius)} m`);
  return [...new Set(kinds)].map((words) => {
    const alike = kinds.filter((each) => each === words).length;
    return `${alike > 1 ? `${alike} targets` : "target"}, ${words}`;
  });
}
