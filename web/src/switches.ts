// What is shown on the water: one switch each.

import { el } from "./dom";
import { count } from "./format";
import type { Scene } from "./protocol";
import type { Look } from "./stage";

const SWITCHES: { name: keyof Look; words: string; key: string }[] = [
  { name: "links", words: "Links: who hears whom", key: "L" },
  { name: "halos", words: "Spacing a_R (halo)", key: "H" },
  { name: "sensors", words: "Sensor discs", key: "S" },
  { name: "headings", words: "Headings", key: "V" },
  { name: "trails", words: "Trails", key: "P" },
  { name: "currents", words: "Currents", key: "C" },
  { name: "graticule", words: "Latitude and longitude", key: "O" },
];
const KEPT = 512; // agents whose links the engine keeps
const DETAILED = 10_000; // agents of whom frames say velocity and a_R
const MANY = 300; // agents from which links are a gray sheet unless asked for

export class Switches {
  readonly root = el("section", { class: "card show", "aria-label": "Show" });
  readonly look: Look = { links: true, halos: false, sensors: true, headings: true, trails: true, currents: true, graticule: true };
  private readonly inputs = new Map<keyof Look, HTMLInputElement>();
  private asked = false; // for links or none

  constructor(private readonly onChange: () => void) {
    const list = el("div", { class: "switches" });
    for (const { name, words, key } of SWITCHES) {
      const input = el("input", { type: "checkbox", role: "switch", id: `show-${name}` });
      input.checked = this.look[name];
      input.onchange = () => {
        this.set(name, input.checked);
      };
      this.inputs.set(name, input);
      list.append(el("label", { title: `${words} (${key})` }, input, el("span", {}, words), el("kbd", {}, key)));
    }
    this.root.append(el("div", { class: "top" }, el("h3", {}, "Show")), list);
  }

  /** Switch off what a scene has none of, and links of very many agents. */
  describe(scenes: Scene[]): void {
    const agents = Math.max(...scenes.map((scene) => scene.fleets.reduce((sum, fleet) => sum + fleet.count, 0)));
    if (!this.asked) this.apply("links", agents <= MANY);
    this.allow(
      "links",
      scenes.some((scene) => scene.has_links),
      agents > KEPT ? `kept of up to ${KEPT} buoys` : "this record keeps none",
    );
    const tooMany = agents > DETAILED ? `sent of up to ${count(DETAILED)} buoys` : null;
    this.allow("headings", !tooMany, tooMany ?? "");
    this.allow("halos", !tooMany && scenes.some((scene) => scene.has_repulsion), tooMany ?? "this strategy has no a_R");
    for (const [name, there] of [
      ["currents", scenes.some(({ geography }) => geography?.currents)],
      ["graticule", scenes.some(({ geography }) => geography?.earth)],
    ] as const) {
      this.inputs.get(name)!.disabled = !there;
      this.inputs.get(name)!.parentElement!.hidden = !there;
    }
    const sensing = scenes.some((scene) => scene.fleets.some((fleet) => fleet.sensor_radius > 0));
    this.allow("sensors", sensing, "sensor radius 0 m: buoys detect by touch");
  }

  toggle(name: keyof Look): void {
    if (!this.inputs.get(name)!.disabled) this.set(name, !this.look[name]);
  }

  private set(name: keyof Look, on: boolean): void {
    if (name === "links") this.asked = true;
    this.apply(name, on);
  }

  private apply(name: keyof Look, on: boolean): void {
    this.look[name] = on;
    this.inputs.get(name)!.checked = on;
    this.onChange();
  }

  private allow(name: keyof Look, possible: boolean, why: string): void {
    const input = this.inputs.get(name)!;
    input.disabled = !possible;
    input.checked = possible && this.look[name];
    const words = SWITCHES.find((each) => each.name === name)!.words;
    input.nextElementSibling!.textContent = possible ? words : `${words}: ${why}`;
  }
}
