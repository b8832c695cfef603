// The page: what comes from the source goes to stages and panels, what people do goes back.

import { byId, el } from "./dom";
import { Conditions, phrases, type Told } from "./conditions";
import { count } from "./format";
import { forgetFleets, rememberFleets } from "./fleets";
import { makeFoldable } from "./folds";
import { History } from "./history";
import { Inspector } from "./inspector";
import { listen, type Key } from "./keyboard";
import { Arrangement } from "./layout";
import { Numbers, type RunNumbers } from "./numbers";
import { readTheme, type Theme } from "./palette";
import { showPlace } from "./place";
import { attachPointer, type PointerTool } from "./pointer";
import type { Failure, Frame, Hello, Measured, Past, Request, SavedText, Scene, Status } from "./protocol";
import { Roll } from "./roll";
import { Save } from "./save";
import { drawForPrint, offerFullScreen, switchFullScreen } from "./screen";
import type { Listener, Source } from "./source";
import { Stage } from "./stage";
import { SwarmControls, TOOLS } from "./swarm";
import { Switches } from "./switches";
import { Transport } from "./transport";

const NUMBERS_EVERY = 100; // [ms]: faster than this nobody reads
const PATIENCE = 700; // [ms] without an answer after which the engine is said to be busy
const COMPLETE = "The record is complete: the swarm cannot be changed any more.";
const PAST = "This is the past. Go to the newest step (End) to change the swarm.";

export class App implements Listener {
  private source!: Source;
  private hello_: Hello | null = null;
  private status_: Status | null = null;
  private stages: Stage[] = [];
  private runs: RunNumbers[] = [];
  private numbers!: Numbers;
  private inspector!: Inspector;
  private save!: Save;
  private swarm: SwarmControls | null = null;
  private roll: Roll | null = null; // of a fleet
  private readonly switches = new Switches(() => this.refresh());
  private readonly transport = new Transport(
    (request) => this.send(request),
    () => this.api.step(),
  );
  private readonly arrangement = new Arrangement(() => this.refresh());
  private readonly conditions = new Conditions();
  private letters: string[] = [];
  private theme: Theme = readTheme();
  private screenTheme: string | null = null; // while paper has its own
  private counted = 0; // [ms], when the numbers were last drawn
  private uncounted = true;
  private waiting = 0; // timer: the engine has not yet answered a change

  start(source: Source): void {
    this.source = source;
    byId("transport").replaceWith(this.transport.root);
    byId("retry").onclick = () => {
      this.retry();
    };
    byId("theme").onclick = () => {
      this.switchTheme();
    };
    byId("help-open").onclick = () => {
      this.help();
    };
    byId("help-close").onclick = () => {
      byId<HTMLDialogElement>("help").close();
    };
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.refresh());
    offerFullScreen();
    drawForPrint((printing) => this.print(printing));
    listen(this.keys());
    requestAnimationFrame(this.tick);
    source.connect();
  }

  // From the source.

  hello(hello: Hello): void {
    this.hello_ = hello;
    this.status_ = null;
    forgetFleets();
    byId("banner").hidden = true;
    document.body.dataset.runs = String(hello.runs);
    const letters = (this.letters = hello.runs > 1 ? ["A", "B"].slice(0, hello.runs) : [""]);
    this.stages = letters.map((letter, run) => new Stage(run, letter, (each) => this.source.tape(each)));
    this.runs = letters.map(() => ({ history: new History(), scene: null, frame: null, since: 0, marks: [], past: null, measured: null }));
    this.numbers = new Numbers(letters);
    this.inspector = new Inspector(
      this.stages,
      letters,
      (run) => this.source.tape(run),
      () => this.showTool(),
    );
    this.save = new Save({
      live: this.source.live && !hello.fleet,
      stages: this.stages,
      runs: this.runs,
      send: (request) => this.send(request),
      chosen: () => this.swarm?.runs[0] ?? 0,
      say: (words) => this.toast(words),
    });
    document.body.dataset.of = hello.fleet ? "fleet" : "swarm";
    this.roll = hello.fleet ? new Roll() : null;
    this.swarm =
      this.source.live && !hello.fleet
        ? new SwarmControls(
            hello,
            letters,
            (request) => this.send(request),
            () => this.showTool(),
          )
        : null;
    byId("stages").replaceChildren(...this.stages.map((stage) => stage.root));
    byId("side").replaceChildren(
      el("h2", { class: "unseen" }, "Numbers and controls"),
      this.arrangement.tabs,
      this.numbers.root,
      el(
        "div",
        { class: "controls" },
        (this.swarm ?? this.roll)?.root ?? this.numbers.table,
        this.switches.root,
        this.inspector.root,
        this.numbers.tools,
        this.save.root,
        this.conditions.root,
      ),
    );
    this.transport.offer(hello.speeds);
    this.transport.restart.disabled = hello.recording;
    const mode = byId("mode");
    mode.textContent = !this.source.live ? "replay" : hello.fleet ? "fleet" : hello.recording ? "recording" : "live";
    mode.dataset.mode = mode.textContent;
    for (const stage of this.stages) {
      showPlace(stage);
      attachPointer(stage, {
        tool: () => this.tool,
        pin: (run, agent) => this.inspector.take({ run, agent }),
        remove: (run, agent) => this.send({ do: "kill", run, agent }),
        add: (run, at) => this.send({ do: "add", run, fleet: this.swarm!.fleet, ...at }),
        drag: (run, target, at) => this.send({ do: "drag", run, target, ...at }),
        say: (words) => this.toast(words),
      });
    }
    this.lock();
    this.showTool();
  }

  past(past: Past): void {
    const run = this.runs[past.run];
    if (run) run.past = past; // until the scene says what it is of
  }

  measured(measured: Measured): void {
    const run = this.runs[measured.run];
    if (run) run.measured = measured;
  }

  file(file: SavedText): void {
    this.save.receive(file);
  }

  scene(run: number, scene: Scene): void {
    const numbers = this.runs[run];
    const before = this.stages[run]?.newest?.epoch;
    if (!numbers) return;
    rememberFleets(scene);
    if (!this.stages[run].learn(scene)) return;
    this.inspector.learn(run, scene);
    numbers.scene = scene;
    numbers.history.learn(scene);
    if (numbers.past) numbers.history.fill(numbers.past);
    numbers.past = null;
    if (scene.epoch !== before) {
      if (before !== undefined) numbers.history.cut(scene.since);
      numbers.marks = [...numbers.marks.filter((step) => step < scene.since), scene.since];
    }
    if (!this.source.live) {
      const tape = this.source.tape(run);
      for (let n = 0; n < tape.length; n++) numbers.history.add(tape.at(n));
    }
    this.swarm?.describe(run, scene);
    this.switches.describe(this.stages.flatMap((stage) => stage.newest ?? []));
    this.numbers.describe(scene);
    this.arrangement.describe([scene], this.stages.length);
    this.conditions.describe(this.told());
    makeFoldable(byId("side"));
    this.describe();
    this.refresh();
  }

  frame(frame: Frame): void {
    const run = this.runs[frame.run];
    if (!run) return;
    run.frame = frame;
    run.history.add(frame, run.measured?.step === frame.step ? run.measured.values : []);
    this.stages[frame.run].show(frame, this.status_?.playing ?? false);
    run.since = this.stages[frame.run].scene?.since ?? 0;
    this.uncounted = true;
  }

  status(status: Status): void {
    const { last } = this.status_ ?? status;
    if (status.last < last) for (const { history } of this.runs) history.cut(status.last);
    const before = this.status_;
    const locks = (["at_end", "playing", "script", "complete"] as const).some((name) => before?.[name] !== status[name]);
    this.status_ = status;
    this.transport.update(status, this.stages[0]?.newest?.time_step ?? 0);
    this.showBusy(status.busy ?? (status.at_end ? (status.ended ?? null) : null));
    if (locks) this.lock();
    this.save.count(status.changes ?? 0);
    this.uncounted = true;
  }

  failure({ message }: Failure): void {
    this.showBusy(null);
    this.toast(message);
    for (const [run, { scene }] of this.runs.entries()) if (scene) this.swarm?.describe(run, scene); // back to what is in force
  }

  lost(reason: string): void {
    this.status_ = this.status_ && { ...this.status_, playing: false };
    if (this.status_) this.transport.update(this.status_, this.stages[0]?.newest?.time_step ?? 0);
    byId("banner").hidden = false;
    byId("banner-words").textContent = `${reason} Is ${this.hello_?.fleet ? "the fleet" : "shoal watch"} still running?`;
    byId("mode").textContent = "not connected";
    byId("mode").dataset.mode = "lost";
    this.showBusy(null);
    this.lock();
  }

  /** For browser tests, and for anybody with a console. */
  readonly api = {
    step: (): number => this.stages[0]?.frame?.step ?? -1,
    links: (): number => this.stages[0]?.links ?? 0,
    agents: (): number => this.stages[0]?.livingAgents() ?? 0,
    frame: (): ArrayBuffer => this.stages[0]?.frame?.bytes.slice(0) ?? new ArrayBuffer(0),
    /** Where on the canvas a point of the arena [m] is drawn [px]. */
    place: (x: number, y: number): [number, number] => {
      const camera = this.stages[0]?.camera;
      return camera ? [camera.toX(x), camera.toY(y)] : [NaN, NaN];
    },
    /** The first step in the charts. */
    charted: (): number => this.runs[0]?.history.step[0] ?? -1,
    /** How many files were saved. */
    saved: (): number => this.save.files,
    /** What the ruler on the water says. */
    measured: (): string => this.stages[0]?.ruler.words ?? "",
    /** The last step of each line of a chart. */
    lines: (chart: number): Record<string, number> => this.numbers.lasts(chart),
    playing: (): boolean => this.status_?.playing ?? false,
    fps: (): number => this.stages[0]?.fps(performance.now()) ?? 0,
  };

  private readonly tick = (now: number): void => {
    for (const stage of this.stages) stage.draw(now, this.switches.look, this.theme);
    if (this.uncounted && this.numbers && now - this.counted >= NUMBERS_EVERY) {
      this.counted = now;
      this.uncounted = false;
      for (const stage of this.stages) stage.describe(this.status_?.playing ?? false);
      if (this.runs[0].frame) this.roll?.call(this.runs[0].frame);
      const newest = Math.max(...this.runs.map(({ frame }) => frame?.step ?? 0));
      this.conditions.tell(this.told());
      this.inspector.tell();
      this.numbers.draw(this.theme, this.runs, this.status_?.last ?? newest);
    }
    requestAnimationFrame(this.tick);
  };

  private send(request: Request): void {
    this.source.send(request);
    if (!["change", "restart", "kill", "add"].includes(request.do) || !this.source.live) return;
    clearTimeout(this.waiting);
    this.waiting = window.setTimeout(() => this.showBusy("the engine is busy …"), PATIENCE);
  }

  private showBusy(words: string | null): void {
    clearTimeout(this.waiting);
    byId("busy").hidden = words === null;
    byId("busy").textContent = words;
  }

  private retry(): void {
    byId("banner").hidden = true;
    byId("mode").textContent = "connecting";
    this.source.connect();
  }

  private lock(): void {
    if (!this.hello_ || !this.swarm) return;
    const { at_end, playing } = this.status_ ?? { at_end: true, playing: true };
    const { complete, script } = this.status_ ?? {};
    const busy = complete ? COMPLETE : script != null ? `Changes come from a log until step ${count(script)}; then the swarm is yours.` : null;
    this.swarm.lock(busy ?? (at_end || playing ? null : PAST), busy === null);
  }

  private told(): Told[] {
    return this.stages.flatMap(({ newest, frame }, run) => (newest ? [{ letter: this.letters[run] ?? "", scene: newest, frame }] : []));
  }

  /** Paper is light, and drawn on before it is printed. */
  private print(printing: boolean): void {
    const { dataset } = document.documentElement;
    if (printing) this.screenTheme = dataset.theme ?? null;
    if (printing) dataset.theme = "light";
    else if (this.screenTheme === null) delete dataset.theme;
    else dataset.theme = this.screenTheme;
    this.refresh();
    if (this.hello_) this.numbers.draw(this.theme, this.runs, this.status_?.last ?? 0);
    for (const stage of this.stages) {
      stage.lieOnPaper(printing);
      stage.draw(performance.now(), this.switches.look, this.theme);
    }
  }

  private get tool(): PointerTool {
    return this.inspector.measuring ? "measure" : (this.swarm?.tool ?? "look");
  }

  private showTool(): void {
    document.body.dataset.tool = this.tool;
    for (const stage of this.stages) stage.pick(null);
  }

  private describe(): void {
    const scenes = this.stages.flatMap((stage) => stage.newest ?? []);
    const [scene] = scenes;
    document.title = `${scene.name} – Shoal`;
    byId("name").textContent = scene.name;
    const each = scenes.map(phrases);
    const common = each[0].filter((phrase) => each.every((phrases) => phrases.includes(phrase)));
    const own = each.map((phrases, run) => `${"AB"[run]}: ${phrases.filter((phrase) => !common.includes(phrase)).join(", ")}`);
    const differ = each.length > 1 && each.some((phrases) => phrases.length > common.length);
    const steered = scene.steered?.length ?? 0;
    const begin = steered ? [`steered ${count(steered)} times; it began with`] : [];
    byId("about").textContent = [...begin, ...common, ...(differ ? own : [])].join(" · ");
  }

  private refresh(): void {
    this.theme = readTheme();
    this.uncounted = true;
    for (const stage of this.stages) stage.refresh();
  }

  private switchTheme(): void {
    document.documentElement.dataset.theme = this.theme.dark ? "light" : "dark";
    this.refresh();
  }

  private help(): void {
    const dialog = byId<HTMLDialogElement>("help");
    if (dialog.open) dialog.close();
    else dialog.showModal();
  }

  private toast(words: string): void {
    if ([...byId("toasts").children].some((each) => each.textContent === words)) return;
    const note = el("p", {}, words);
    byId("toasts").append(note);
    if (byId("toasts").childElementCount > 3) byId("toasts").firstElementChild!.remove();
    setTimeout(() => note.remove(), 4000 + 40 * words.length);
  }

  private zoom(factor: number): void {
    for (const stage of this.stages) stage.camera.zoomBy(factor);
    this.refresh();
  }

  private keys(): { title: string; keys: Key[] }[] {
    const key = (keys: string, words: string, act: () => void, shown?: string): Key => ({
      keys: keys.split(" ").map((name) => (name === "Space" ? " " : name)),
      words,
      act,
      ...(shown ? { shown } : {}),
    });
    const { transport, switches } = this;
    const live = [
      ...TOOLS.map((tool, n) => key(`${n + 1}`, `tool: ${["look", "move target", "remove buoy", "add buoy"][n]}`, () => this.swarm?.choose(tool))),
      key("k", "number of neighbors k", () => this.swarm?.focus("k")),
      key("t", "target speed", () => this.swarm?.focus("targetSpeed")),
      key("f", "fast buoys", () => this.swarm?.focus("fast")),
      key("g", "strategy", () => this.swarm?.focus("strategy")),
      key("n", "seed", () => this.swarm?.focus("seed")),
    ];
    return [
      {
        title: "Time",
        keys: [
          key("Space", "play, pause", () => transport.toggle(), "space"),
          key("ArrowLeft", "a step back", () => transport.stepBy(-1), "←"),
          key("ArrowRight", "a step forward", () => transport.stepBy(1), "→"),
          key("Home", "oldest step that is kept", () => transport.toFirst(), "Home"),
          key("End", "newest step", () => transport.toNewest(), "End"),
        ],
      },
      {
        title: "Pace",
        keys: [
          key("[", "slower", () => transport.changeSpeed(-1)),
          key("]", "faster", () => transport.changeSpeed(1)),
          key("r", "restart", () => {
            if (!transport.restart.hidden) transport.restart.click();
          }),
        ],
      },
      {
        title: "View",
        keys: [
          key("l", "links", () => switches.toggle("links")),
          key("h", "halos: spacing a_R", () => switches.toggle("halos")),
          key("s", "sensor discs", () => switches.toggle("sensors")),
          key("v", "headings", () => switches.toggle("headings")),
          key("p", "trails", () => switches.toggle("trails")),
          key("c", "currents", () => switches.toggle("currents")),
          key("o", "latitude and longitude", () => switches.toggle("graticule")),
          key("+ =", "nearer", () => this.zoom(1.25)),
          key("-", "farther", () => this.zoom(0.8)),
          key("0", "the whole area", () => this.zoom(0)),
          key("d", "dark, light", () => this.switchTheme()),
          key("b", "panels", () => this.arrangement.toggle()),
          key("i", "find a buoy", () => this.inspector.find()),
          key("e", "measure: how far, which way", () => this.inspector.measure(!this.inspector.measuring)),
          key("z", "full screen", () => switchFullScreen()),
          key("?", "this help", () => this.help()),
        ],
      },
      ...(this.source.live ? [{ title: "Swarm", keys: live }] : []),
      {
        title: "On the water",
        keys: [
          key("m", "go to the map, then:", () => this.stages[0]?.canvas.focus()),
          { keys: [], shown: "← ↑ → ↓", words: "move the crosshair (with Shift: farther)", act: () => undefined },
          { keys: [], shown: "Enter", words: "use the tool there", act: () => undefined },
        ],
      },
    ];
  }
}
