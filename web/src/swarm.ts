// Controls that act on the running swarm: k, target speed, fleets, strategy, tools for the water, a fresh start.

import { el } from "./dom";
import { countFleets, fastestFleet } from "./fleets";
import { count, short } from "./format";
import type { Change, Hello, Parameter, Request, Scene } from "./protocol";
import { slider, type Slider } from "./slider";

export const TOOLS = ["look", "move", "remove", "add"] as const;
export type Tool = (typeof TOOLS)[number];

const TOOL_WORDS: Record<Tool, [string, string]> = {
  look: ["Look", "Hover or tap a buoy to see whom it hears; drag to pan when zoomed in."],
  move: ["Move target", "Drag a target to where it should be."],
  remove: ["Remove", "Click or tap a buoy: it is gone from this step on."],
  add: ["Add", "Click or tap empty water: a buoy joins there."],
};

/** The swarm's controls. `ask` sends a request for the chosen runs. */
export class SwarmControls {
  readonly root = el("section", { class: "card swarm", "aria-label": "Swarm" });
  tool: Tool = "look";
  fleet = 0;
  /** Numbers of the runs that changes are for. */
  runs: number[];

  private readonly fields = el("fieldset", { class: "changes" });
  private readonly again = el("fieldset", { class: "again" });
  private readonly why = el("p", { class: "why", hidden: true });
  private readonly k: Slider;
  private readonly targetSpeed: Slider;
  private readonly fast: Slider;
  private readonly strategy = el("select", { id: "strategy" });
  private readonly summary = el("p", { class: "words" });
  private readonly parameters = el("div", { class: "parameters" });
  private readonly joins = el("select", { "aria-label": "Fleet that a new buoy is of" });
  private readonly toolHint = el("p", { class: "words", "aria-live": "polite" });
  private readonly seed = el("input", { type: "number", id: "seed", min: 0, max: Number.MAX_SAFE_INTEGER, step: 1, inputmode: "numeric" });
  private readonly restart = el("button", { type: "button", class: "wide" }, "Restart");
  private scenes: (Scene | null)[];
  private speedLimit = 0; // [m/s] of the slider

  constructor(
    private readonly hello: Hello,
    letters: string[],
    private readonly send: (request: Request) => void,
    private readonly onTool: () => void,
  ) {
    this.runs = letters.map((_, run) => run);
    this.scenes = letters.map(() => null);
    this.k = slider("Neighbors heard, k", "k", (value) => this.change({ neighbors: value }));
    this.targetSpeed = slider("Target speed", "target-speed", (value) => this.change({ target_speed: value }));
    this.fast = slider("Fast buoys", "fast", (value) => this.change({ fast: value }));
    for (const each of hello.strategies) this.strategy.append(el("option", { value: each.name, title: each.summary }, each.name));
    this.strategy.onchange = () => {
      this.change({ strategy: this.strategy.value });
      this.summary.textContent = "loading …";
      this.parameters.replaceChildren();
    };
    this.joins.onchange = () => {
      this.fleet = Number(this.joins.value);
    };
    this.restart.onclick = () => {
      this.startAgain();
    };
    this.seed.onkeydown = (event) => {
      if (event.key === "Enter") this.startAgain();
    };
    this.fields.append(
      this.toolButtons(),
      this.k.root,
      this.targetSpeed.root,
      this.fast.root,
      el("label", { class: "row", for: "strategy" }, el("span", {}, "Strategy"), this.strategy),
      this.summary,
      el("details", {}, el("summary", {}, "Parameters of the strategy"), this.parameters),
    );
    this.again.append(el("div", { class: "row" }, el("label", { for: "seed" }, "Seed"), this.seed, this.restart));
    this.root.append(
      el("div", { class: "top" }, el("h3", {}, "Swarm"), letters.length > 1 ? this.runChoice(letters) : null),
      this.why,
      this.fields,
      this.again,
    );
    this.choose("look");
  }

  /** Show what a run is now. */
  describe(run: number, scene: Scene): void {
    this.scenes[run] = scene;
    if (run === this.runs[0]) this.show(scene);
  }

  /** Say in a sentence why the swarm cannot be changed now; null: it can. */
  lock(reason: string | null, restarts: boolean): void {
    this.fields.disabled = reason !== null;
    this.again.disabled = !restarts;
    this.why.hidden = reason === null;
    this.why.textContent = reason;
    if (reason !== null && this.tool !== "look") this.choose("look");
  }

  choose(tool: Tool): void {
    if (tool !== "look" && (this.fields.disabled || this.root.querySelector<HTMLInputElement>(`#tool-${tool}`)?.disabled)) return;
    this.tool = tool;
    for (const input of this.root.querySelectorAll<HTMLInputElement>("input[name=tool]")) input.checked = input.value === tool;
    this.toolHint.textContent = TOOL_WORDS[tool][1];
    this.joins.hidden = tool !== "add" || (this.scenes[this.runs[0]]?.fleets.length ?? 1) < 2;
    this.onTool();
  }

  /** Put the keyboard on a control. */
  focus(control: "k" | "targetSpeed" | "fast" | "strategy" | "seed"): void {
    const element = control === "strategy" || control === "seed" ? this[control] : this[control].input;
    element.focus();
    element.scrollIntoView({ block: "nearest" });
  }

  private show(scene: Scene): void {
    const agents = scene.fleets.reduce((sum, fleet) => sum + fleet.count, 0);
    const k = scene.neighbors === "all" ? agents - 1 : scene.neighbors;
    if (scene.adapts) this.k.refuse(scene.k);
    else
      this.k.show(k, { min: 1, max: Math.max(agents - 1, 1), step: 1 }, (value) =>
        value >= agents - 1 ? `all ${count(value)}` : `${count(value)} of ${count(agents - 1)}`,
      );
    this.showTargetSpeed(scene);
    this.showFast(scene, agents);
    this.showStrategy(scene);
    this.joins.replaceChildren(...scene.fleets.map((fleet, number) => el("option", { value: number }, fleet.name)));
    this.fleet = Math.min(this.fleet, scene.fleets.length - 1);
    this.joins.value = String(this.fleet);
    const recorded = scene.targets.every(({ kind }) => kind === "track");
    const move = this.root.querySelector<HTMLInputElement>("#tool-move")!;
    move.disabled = recorded; // recorded targets go where they went
    move.parentElement!.title = recorded ? "Recorded targets go where they went." : `${TOOL_WORDS.move[1]} (key 2)`;
    if (recorded && this.tool === "move") this.choose("look");
    if (document.activeElement !== this.seed) this.seed.value = String(scene.seed);
  }

  private showTargetSpeed(scene: Scene): void {
    const speeds = scene.targets.flatMap((target) => (target.speed === null ? [] : [target.speed]));
    if (speeds.length === 0) return this.targetSpeed.refuse("no target here has a speed of its own");
    const fastest = Math.max(...scene.fleets.map((fleet) => fleet.max_speed));
    const least = 4 * Math.max(fastest, 0.5 * speeds[0]);
    if (speeds[0] > this.speedLimit || !this.speedLimit) this.speedLimit = Number(Math.max(least, speeds[0]).toPrecision(1));
    const step = 10 ** (Math.floor(Math.log10(this.speedLimit / 2)) - 1);
    const all = speeds.length > 1 ? `, all ${speeds.length}` : "";
    const differ = new Set(speeds).size > 1;
    this.targetSpeed.show(speeds[0], { min: 0, max: this.speedLimit, step }, (value) =>
      value === speeds[0] && differ ? `${speeds.map(short).join(" and ")} m/s` : `${short(value)} m/s${all}`,
    );
  }

  private showFast(scene: Scene, agents: number): void {
    if (this.hello.recording) return this.fast.refuse("a record keeps its fleets");
    if (countFleets() !== 2) return this.fast.refuse("needs two fleets");
    const { name, max_speed } = fastestFleet();
    const fast = scene.fleets.find((fleet) => fleet.name === name)?.count ?? 0;
    this.fast.show(fast, { min: 0, max: agents, step: 1 }, (value) => `${count(value)} of ${count(agents)} (${Math.round((100 * value) / agents)} %)`);
    this.fast.input.title = `${name}, ${short(max_speed)} m/s`;
  }

  private showStrategy(scene: Scene): void {
    const { name, params, summary } = scene.strategy;
    const known = this.hello.strategies.find((each) => each.name === name);
    if (!known && ![...this.strategy.options].some((option) => option.value === name)) {
      this.strategy.append(el("option", { value: name }, name));
    }
    this.strategy.value = name;
    this.summary.textContent = summary;
    if (this.parameters.contains(document.activeElement)) return; // do not pull a field from under the keyboard
    const described = Object.entries(known?.parameters ?? {});
    this.parameters.replaceChildren(
      ...(described.length
        ? described.map(([field, about]) => this.parameter(field, about, params[field] ?? about.default))
        : [el("p", { class: "words" }, "This strategy has none.")]),
    );
  }

  private parameter(field: string, about: Parameter, value: unknown): HTMLElement {
    const id = `parameter-${field}`;
    const unit = about.unit && about.unit !== "1" ? about.unit : "";
    const change = (now: Change): void => this.change({ [`strategy.${field}`]: now });
    let input: HTMLInputElement | HTMLSelectElement;
    if (about.choices) {
      input = el("select", { id }, ...about.choices.map((choice) => el("option", { value: choice }, choice)));
      input.value = String(value);
      input.onchange = () => {
        change(input.value);
      };
    } else if (about.type.startsWith("bool")) {
      const box = (input = el("input", { id, type: "checkbox" }));
      box.checked = Boolean(value);
      box.onchange = () => {
        change(box.checked);
      };
    } else {
      const whole = about.type.startsWith("int");
      const number = (input = el("input", { id, type: "number", step: whole ? 1 : "any" }));
      number.value = String(typeof value === "number" ? Number(value.toPrecision(6)) : value);
      number.onchange = () => {
        if (number.value !== "") change(Number(number.value));
      };
    }
    return el(
      "label",
      { class: "row", for: id, title: about.description },
      el("span", {}, field.replaceAll("_", " ")),
      input,
      el("span", { class: "unit" }, unit),
    );
  }

  private toolButtons(): HTMLElement {
    const choices = TOOLS.map((tool, n) => {
      const input = el("input", { type: "radio", name: "tool", value: tool, id: `tool-${tool}` });
      input.onchange = () => {
        this.choose(tool);
      };
      return el("label", { title: `${TOOL_WORDS[tool][1]} (key ${n + 1})` }, input, el("span", {}, TOOL_WORDS[tool][0]));
    });
    return el(
      "div",
      { class: "tools" },
      el("div", { class: "segments", role: "radiogroup", "aria-label": "What a click on the water does" }, ...choices),
      this.joins,
      this.toolHint,
    );
  }

  private runChoice(letters: string[]): HTMLElement {
    const all = letters.map((_, run) => run);
    const choice = (words: string, runs: number[]): HTMLElement => {
      const input = el("input", { type: "radio", name: "runs", value: words });
      input.checked = runs.length === all.length;
      input.onchange = () => {
        this.runs = runs;
        const scene = this.scenes[runs[0]];
        if (scene) this.show(scene);
      };
      return el("label", {}, input, el("span", {}, words));
    };
    return el(
      "div",
      { class: "segments small", role: "radiogroup", "aria-label": "Which run to change" },
      ...letters.map((letter, run) => choice(letter, [run])),
      choice("both", all),
    );
  }

  private change(changes: Record<string, Change>): void {
    for (const run of this.runs) this.send({ do: "change", run, changes });
  }

  private startAgain(): void {
    const seed = this.seed.value.trim();
    const same = seed === "" || seed === String(this.scenes[this.runs[0]]?.seed);
    if (!same && !this.seed.reportValidity()) return;
    this.send(same ? { do: "restart" } : { do: "restart", seed: Number(seed) });
  }
}
