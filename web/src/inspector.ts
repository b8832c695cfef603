// Find a buoy, pin it, follow it, and measure: a panel that stays while the pointer is elsewhere.

import { factsOf } from "./agent";
import { el } from "./dom";
import { count } from "./format";
import { fleetOf } from "./layers";
import { isAlive, isOnTarget, type Scene } from "./protocol";
import type { Stage } from "./stage";
import type { Tape } from "./tape";

const MOST_FOUND = 5;
const NEAR = 4; // times nearer, to follow somebody

interface Pin {
  run: number;
  agent: number;
  fleet: string;
  place: number; // in the fleet
  agents: number; // in all
}

export class Inspector {
  readonly root = el("section", { class: "card inspect", "aria-label": "Buoys" });
  private readonly search = el("input", {
    type: "search",
    id: "find",
    placeholder: "number or fleet",
    "aria-label": "Find a buoy by number or fleet",
    autocomplete: "off",
  });
  private readonly found = el("ul", { class: "found", "aria-label": "Buoys found" });
  private readonly name = el("h4");
  private readonly facts = el("dl", { class: "facts-of" });
  private readonly follow = button("Follow");
  private readonly drop = button("Let go");
  private readonly ruler = button("Measure");
  private readonly hint = el("p", { class: "words" });
  private readonly pinned = el(
    "div",
    { class: "pinned", hidden: true },
    el("div", { class: "top" }, this.name, el("span", { class: "buttons" }, this.follow, this.drop)),
    this.facts,
  );
  private pin: Pin | null = null;
  private told = "";

  constructor(
    private readonly stages: Stage[],
    private readonly letters: string[],
    private readonly tape: (run: number) => Tape,
    private readonly changed: () => void,
  ) {
    for (const each of [this.follow, this.ruler]) each.setAttribute("aria-pressed", "false");
    this.root.append(
      el("div", { class: "top" }, el("h3", {}, "Buoys"), this.ruler),
      el("div", { class: "row" }, this.search),
      this.found,
      this.hint,
      this.pinned,
    );
    this.search.oninput = () => {
      this.list();
    };
    this.search.onkeydown = (event) => {
      if (event.key !== "Enter") return;
      event.preventDefault(); // it would press the button that gets the focus
      this.found.querySelector("button")?.click();
    };
    this.follow.onclick = () => {
      this.press(this.follow, this.follow.getAttribute("aria-pressed") !== "true");
    };
    this.drop.onclick = () => {
      this.take(null);
    };
    this.ruler.onclick = () => {
      this.measure(!this.measuring);
    };
    this.say();
  }

  get measuring(): boolean {
    return this.ruler.getAttribute("aria-pressed") === "true";
  }

  /** Put the keyboard into the search. */
  find(): void {
    this.search.focus();
    this.search.scrollIntoView({ block: "nearest" });
  }

  measure(on: boolean): void {
    this.ruler.setAttribute("aria-pressed", String(on));
    if (!on) for (const { ruler } of this.stages) ruler.clear();
    this.say();
    this.changed();
  }

  /** Pin an agent of a run; null: none. */
  take(at: { run: number; agent: number } | null): void {
    const scene = at && this.stages[at.run]?.scene;
    this.pin = at && scene ? pinOf(scene, at.run, at.agent) : null;
    if (!this.pin) this.press(this.follow, false);
    this.stages.forEach((stage, run) => {
      stage.pin(this.pin?.run === run ? this.pin.agent : null);
    });
    this.press(this.follow, this.pin !== null && this.follow.getAttribute("aria-pressed") === "true");
    this.pinned.hidden = this.pin === null;
    this.say();
    this.tell();
  }

  /** A scene has come: numbers may have moved on with an agent that was added. */
  learn(run: number, scene: Scene): void {
    if (this.pin?.run !== run) return;
    const agents = sum(scene);
    if (agents !== this.pin.agents) {
      const number = numberOf(scene, this.pin);
      this.take(number === null ? null : { run, agent: number });
    }
  }

  /** Say how the pinned one is in the frame shown. */
  tell(): void {
    const stage = this.pin && this.stages[this.pin.run];
    if (!this.pin || !stage?.frame || !stage.scene || this.pin.agent >= stage.frame.x.length) return;
    const { scene, frame } = stage;
    const { run, agent } = this.pin;
    const rows = factsOf(scene, frame, agent, this.tape(run));
    const text = JSON.stringify(rows);
    this.name.textContent = `${this.letters[run] ? `${this.letters[run]}: ` : ""}${scene.fleets[fleetOf(scene, agent)].name} no. ${agent}`;
    if (text === this.told) return;
    this.told = text;
    this.facts.replaceChildren(...rows.flatMap(([name, value]) => [el("dt", {}, name), el("dd", {}, value)]));
  }

  private press(follow: HTMLElement, on: boolean): void {
    follow.setAttribute("aria-pressed", String(on));
    this.stages.forEach((stage, run) => {
      stage.follow(on && this.pin?.run === run, NEAR);
    });
  }

  private say(): void {
    this.hint.hidden = this.pin !== null && !this.measuring;
    this.hint.textContent = this.measuring
      ? "Click two points on the water, or drag from one to the other."
      : "Click a buoy, or find it here: it stays in this panel.";
  }

  private list(): void {
    const wanted = this.search.value.trim().toLowerCase();
    const all = this.stages.flatMap(({ scene, frame }, run) =>
      scene && frame && wanted ? Array.from(frame.x.keys(), (agent) => ({ run, agent, fleet: scene.fleets[fleetOf(scene, agent)].name, frame })) : [],
    );
    const matching = all.filter(({ agent, fleet }) => String(agent).startsWith(wanted) || fleet.toLowerCase().includes(wanted));
    matching.sort((a, b) => Number(String(b.agent) === wanted) - Number(String(a.agent) === wanted));
    this.found.replaceChildren(
      ...matching.slice(0, MOST_FOUND).map(({ run, agent, fleet, frame }) => {
        const state = !isAlive(frame, agent) ? ", not there" : isOnTarget(frame, agent) ? ", reports a target" : "";
        const choose = button(`${this.letters[run] ? `${this.letters[run]} ` : ""}no. ${agent}, ${fleet}${state}`);
        choose.onclick = () => {
          this.search.value = "";
          this.list();
          this.take({ run, agent });
          this.follow.focus();
        };
        return el("li", {}, choose);
      }),
      ...(matching.length > MOST_FOUND ? [el("li", { class: "words" }, `and ${count(matching.length - MOST_FOUND)} more`)] : []),
      ...(wanted && matching.length === 0 ? [el("li", { class: "words" }, "no such buoy")] : []),
    );
  }
}

const sum = (scene: Scene): number => scene.fleets.reduce((all, { count }) => all + count, 0);

function pinOf(scene: Scene, run: number, agent: number): Pin {
  const fleet = fleetOf(scene, agent);
  const begin = scene.fleets.slice(0, fleet).reduce((all, { count }) => all + count, 0);
  return { run, agent, fleet: scene.fleets[fleet].name, place: agent - begin, agents: sum(scene) };
}

/** The number that an agent has in another scene; null if its fleet is smaller now. */
function numberOf(scene: Scene, { fleet, place }: Pin): number | null {
  let begin = 0;
  for (const each of scene.fleets) {
    if (each.name === fleet) return place < each.count ? begin + place : null;
    begin += each.count;
  }
  return null;
}

function button(words: string): HTMLButtonElement {
  return el("button", { type: "button" }, words);
}
