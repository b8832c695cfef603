// One run on one canvas: which moment is shown, and drawing it. Between two frames everything glides.

import { Camera } from "./camera";
import { Dots, inView, MARKED, reporting } from "./dots";
import { el } from "./dom";
import { count, fixed, time } from "./format";
import { drawCurrents, drawGraticule, drawLand, drawScale } from "./geography";
import * as layers from "./layers";
import { Legend } from "./legend";
import { heardBy, linkedPairs, type Pairs } from "./links";
import { Ruler } from "./measure";
import type { Theme } from "./palette";
import { SvgPaper } from "./svgpaper";
import { isAlive, isOnTarget, isPresent, isSilent, type Frame, type Scene } from "./protocol";
import { spoken } from "./spoken";
import type { Tape } from "./tape";

/** What is drawn besides agents and targets. */
export interface Look {
  links: boolean;
  halos: boolean;
  sensors: boolean;
  headings: boolean;
  trails: boolean;
  currents: boolean;
  graticule: boolean;
}

export interface Point {
  x: number; // [m]
  y: number;
}

const PAPER = { width: 690, height: 690 }; // [px]
const LONGEST_GLIDE = 250; // [ms]
const LONGEST_JUMP = 0.3; // of the area's longer side; what moves farther between two frames is not seen to glide
const REACH = 8 / 3; // arena units that the fastest agent covers in the length of a trail; targets' are three times it

export class Stage {
  readonly root: HTMLElement;
  readonly canvas: HTMLCanvasElement;
  readonly camera = new Camera();
  frame: Frame | null = null;
  scene: Scene | null = null; // of the frame shown
  newest: Scene | null = null;
  crosshair: Point | null = null;
  picked: number | null = null;
  readonly ruler = new Ruler();
  links = 0;
  dotted = false; // there are too many agents in view for markers
  drawn: number[] = []; // [ms], when the last frames were drawn

  private readonly context: CanvasRenderingContext2D;
  private readonly moment = el("p", { class: "moment" });
  private readonly words: HTMLElement;
  private readonly hint = el("p", { class: "hint", hidden: true });
  private readonly legend = new Legend();
  private readonly dots = new Dots();
  private readonly water: HTMLElement;
  private readonly scenes = new Map<number, Scene>();
  private readonly reduced = matchMedia("(prefers-reduced-motion: reduce)");
  private pinned: number | null = null;
  private following = false;
  private look: Look | null = null; // as it was drawn last
  private theme: Theme | null = null;
  private pairs: { frame: Frame; pairs: Pairs } | null = null;
  private stale = true;
  private size = { width: 0, height: 0 };
  private onPaper = false;
  // Gliding: everything moves from where it was drawn to where the frame has it.
  private began = 0; // [ms]
  private glide = 0; // [ms]
  private from: layers.Moment | null = null;
  private now: layers.Moment | null = null;

  constructor(
    readonly run: number,
    private readonly letter: string, // "A", "B", or "" for a single run
    private readonly tape: (run: number) => Tape,
  ) {
    this.canvas = el("canvas", { tabindex: 0, role: "application", "aria-label": "Map of the swarm", "aria-describedby": `words-${run}` });
    this.words = el("p", { class: "unseen", id: `words-${run}` });
    this.context = this.canvas.getContext("2d")!;
    const water = (this.water = el("div", { class: "water" }, this.canvas, this.hint, this.words));
    this.root = el(
      "section",
      { class: "stage", "aria-label": letter ? `Run ${letter}` : "Run" },
      el("div", { class: "caption" }, letter ? el("span", { class: `letter run-${run}` }, letter) : null, this.moment),
      this.legend.root,
      water,
    );
    new ResizeObserver(() => this.resize(water.clientWidth, water.clientHeight)).observe(water);
  }

  /** Learn a scene; returns whether it is the run's newest. */
  learn(scene: Scene): boolean {
    this.scenes.set(scene.epoch & 0xffff, scene);
    if (this.newest && scene.epoch < this.newest.epoch) return false;
    this.newest = scene;
    if (!this.frame) this.adopt(scene);
    return true;
  }

  show(frame: Frame, playing: boolean): void {
    const scene = this.scenes.get(frame.epoch) ?? this.newest;
    if (!scene) return;
    if (scene !== this.scene) this.adopt(scene);
    const arrived = performance.now();
    const few = frame.x.length <= MARKED;
    const glides = playing && few && !this.reduced.matches && this.isNear(this.frame, frame);
    this.from = glides ? this.now : null;
    const gap = Math.min(arrived - this.began, LONGEST_GLIDE);
    this.glide = glides ? (this.glide ? 0.8 * this.glide + 0.2 * gap : gap) : 0;
    this.began = arrived;
    this.frame = frame;
    this.now = this.momentAt(arrived);
    this.stale = true;
    if (this.picked !== null && !(this.picked < frame.x.length && isAlive(frame, this.picked))) this.pick(null);
    else if (this.picked !== null) this.pick(this.picked);
  }

  /** Say in words what is shown; a few times a second is as fast as anybody reads. */
  describe(playing: boolean): void {
    const { frame, scene } = this;
    if (!frame || !scene) return;
    const there = frame.present.some((_, target) => isPresent(frame, target));
    const state = there ? `${fixed(frame.engaged, 0)} on target` : "no target is there";
    const gone = frame.x.length - this.livingAgents();
    const missing = gone > 0 ? ` · ${count(frame.x.length - gone)} of ${count(frame.x.length)} there` : "";
    this.moment.textContent = `Step ${count(frame.step)} · ${time(frame.step * scene.time_step)} · ${state}${missing}`;
    const silent = frame.flags.reduce((sum, _, agent) => sum + Number(isAlive(frame, agent) && isSilent(frame, agent)), 0);
    this.legend.note(gone, silent, this.dotted);
    if (playing) return; // a label that changes all the time is read out all the time
    this.words.textContent = spoken(scene, frame);
    const words = `${count(frame.x.length - gone)} buoys, ${state}`;
    this.canvas.setAttribute("aria-label", `Map of the swarm${this.letter && `, run ${this.letter}`}: ${words}`);
  }

  refresh(): void {
    this.stale = true;
  }

  /** Draw if anything has changed. */
  draw(now: number, look: Look, theme: Theme): void {
    const gliding = this.from !== null;
    if (!this.stale && !gliding) return;
    this.stale = false;
    const { context, scene, frame } = this;
    const ratio = Math.min(devicePixelRatio || 1, 2);
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, this.size.width, this.size.height);
    if (!scene || !frame) return;
    const moment = (this.now = this.momentAt(performance.now()));
    this.drawn.push(now);
    if (this.drawn.length > 240) this.drawn.splice(0, 120);
    [this.look, this.theme] = [look, theme];
    if (this.following && this.pinned !== null) this.camera.lookAt(moment.x[this.pinned], moment.y[this.pinned]);
    this.paint(context, moment, look, theme);
  }

  /** What is on the canvas, as an SVG. */
  svg(): string {
    const { now, look, theme, size } = this;
    const paper = new SvgPaper(size.width, size.height, this.context);
    if (!now || !look || !theme) return paper.text;
    paper.fillStyle = theme.outside;
    paper.fillRect(0, 0, size.width, size.height);
    this.paint(paper.context, now, look, theme);
    return paper.text;
  }

  private paint(context: CanvasRenderingContext2D, moment: layers.Moment, look: Look, theme: Theme): void {
    const { camera } = this;
    const { scene, frame } = moment;
    const ratio = Math.min(devicePixelRatio || 1, 2);
    const brush = { context, camera, theme };
    const { plot } = camera;
    this.dotted = moment.dotted;
    const size = this.markerSize(this.dotted || frame.x.length <= MARKED ? frame.x.length : moment.shown.length);
    context.save();
    context.beginPath();
    context.rect(plot.left, plot.top, plot.width, plot.height);
    context.clip();
    layers.drawWater(brush, scene);
    const { geography } = scene;
    if (geography?.currents && look.currents) drawCurrents(brush, geography, frame.step * scene.time_step);
    if (geography) drawLand(brush, geography);
    layers.drawEdges(brush, scene);
    if (geography?.earth && look.graticule) drawGraticule(brush, geography.earth);
    if (look.sensors) layers.drawSensors(brush, moment);
    if (look.halos) layers.drawHalos(brush, moment);
    this.links = 0;
    if (look.links) {
      const pairs = this.findPairs(frame);
      this.links = pairs.length / 2;
      layers.drawLinks(brush, moment, pairs);
    }
    if (this.dotted) this.dots.draw(context, camera, ratio, scene, frame, theme);
    else if (look.trails) layers.drawTrails(brush, { ...moment, past: this.trail(moment.past) }, size);
    layers.drawTargets(brush, look.trails ? moment : { ...moment, past: [] });
    for (const agent of new Set([this.picked, this.pinned])) {
      if (agent !== null && agent < frame.x.length) layers.drawPicked(brush, moment, agent, heardBy(frame, agent), size);
    }
    if (look.headings) layers.drawHeadings(brush, moment, size);
    layers.drawAgents(brush, moment, size);
    this.ruler.draw(brush);
    if (this.crosshair) layers.drawCrosshair(brush, this.crosshair);
    drawScale(brush, scene);
    context.restore();
    layers.drawAxes(brush, scene, this.size.width < 480);
  }

  fps(now: number): number {
    return this.drawn.filter((each) => each > now - 1000).length;
  }

  livingAgents(): number {
    return this.frame ? this.frame.flags.reduce((sum, _, agent) => sum + Number(isAlive(this.frame!, agent)), 0) : 0;
  }

  /** The living agent nearest to a place on the canvas, within so many pixels. */
  agentAt(px: number, py: number, within: number): number | null {
    if (!this.frame || !this.now) return null;
    let [best, least] = [null as number | null, within];
    for (const agent of this.now.shown) {
      if (!isAlive(this.frame, agent)) continue;
      const distance = Math.hypot(this.camera.toX(this.now.x[agent]) - px, this.camera.toY(this.now.y[agent]) - py);
      if (distance <= least) [best, least] = [agent, distance];
    }
    return best;
  }

  /** The present target nearest to a point. */
  targetNear({ x, y }: Point): number | null {
    const frame = this.frame;
    if (!frame) return null;
    const far = (target: number): number => Math.hypot(frame.targetX[target] - x, frame.targetY[target] - y);
    const there = [...frame.targetX.keys()].filter((target) => isPresent(frame, target));
    return there.length ? there.reduce((best, each) => (far(each) < far(best) ? each : best)) : null;
  }

  /** Mark an agent for as long as it is pinned. */
  pin(agent: number | null): void {
    this.pinned = agent;
    this.stale = true;
  }

  /** Keep the pinned agent in the middle, so many times nearer than the whole area. */
  follow(on: boolean, nearer: number): void {
    if (on && !this.following && !this.camera.zoomed) this.camera.zoomBy(nearer);
    if (!on && this.following) this.camera.reset();
    this.following = on;
    this.stale = true;
  }

  pick(agent: number | null): void {
    this.picked = agent;
    this.stale = true;
    this.hint.hidden = agent === null;
    if (agent === null || !this.frame || !this.scene) return;
    const { frame, scene } = this;
    const parts = [
      `${scene.fleets[layers.fleetOf(scene, agent)].name} no. ${agent}`,
      ...(frame.lean
        ? []
        : [
            `${fixed(Math.hypot(frame.vx[agent], frame.vy[agent]), 2)} m/s`,
            scene.has_links ? `hears ${heardBy(frame, agent).length / 2} (k ${frame.degree[agent]})` : `k ${frame.degree[agent]}`,
          ]),
    ];
    if (Number.isFinite(frame.repulsion[agent])) parts.push(`a_R ${fixed(frame.repulsion[agent], 3)} m`);
    if (isOnTarget(frame, agent)) parts.push("reports a target");
    if (isSilent(frame, agent)) parts.push("says nothing");
    this.hint.textContent = parts.join(" · ");
  }

  private adopt(scene: Scene): void {
    this.scene = scene;
    this.legend.describe(scene);
    this.fit();
  }

  /** Take the width of a sheet of paper, or of the page again. */
  lieOnPaper(printing: boolean): void {
    this.onPaper = false;
    if (!printing) return this.resize(this.water.clientWidth, this.water.clientHeight);
    const area = this.scene?.area ?? { width: 1, height: 1 };
    const height = Math.min(Math.round((PAPER.width * area.height) / area.width) + 60, PAPER.height);
    this.water.style.setProperty("--paper-width", `${PAPER.width}px`);
    this.water.style.setProperty("--paper-height", `${height}px`);
    this.resize(PAPER.width, height);
    this.onPaper = true; // what the browser measures from now on is not the screen's
  }

  private resize(width: number, height: number): void {
    if (this.onPaper) return;
    const ratio = Math.min(devicePixelRatio || 1, 2);
    this.size = { width, height };
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    this.fit();
  }

  private fit(): void {
    const compact = this.size.width < 480;
    const margins = { left: compact ? 42 : 50, right: compact ? 8 : 12, top: 6, bottom: compact ? 36 : 40 };
    if (this.scene) this.camera.fit(this.scene.area, this.size, margins);
    this.stale = true;
  }

  private isNear(before: Frame | null, frame: Frame): boolean {
    if (!before || !this.scene || before.x.length !== frame.x.length || before.epoch !== frame.epoch) return false;
    const steps = frame.step - before.step;
    return steps >= 0 && steps <= this.stepsFor(LONGEST_JUMP * 20);
  }

  /** Steps in which the fastest agent covers so many arena units. */
  private stepsFor(units: number): number {
    const scene = this.scene!;
    const fastest = Math.max(...scene.fleets.map((fleet) => fleet.max_speed));
    return Math.max((units * scene.unit) / (fastest * scene.time_step), 1);
  }

  private momentAt(now: number): layers.Moment {
    const frame = this.frame!;
    const scene = this.scene!;
    const from = this.from;
    const part = this.glide > 0 ? Math.min((now - this.began) / this.glide, 1) : 1;
    const past = this.past(frame, 3 * REACH);
    if (!from || part === 1 || from.x.length !== frame.x.length) {
      this.from = null;
      const { x, y, targetX, targetY } = frame;
      return { scene, frame, x, y, targetX, targetY, past, ...this.shownOf(frame, frame) };
    }
    const mix = (a: Float32Array, b: Float32Array): Float32Array => b.map((value, n) => a[n] + part * (value - a[n]));
    const places = { x: mix(from.x, frame.x), y: mix(from.y, frame.y) };
    return {
      scene,
      frame,
      past,
      ...places,
      ...this.shownOf(frame, places),
      targetX: mix(from.targetX, frame.targetX),
      targetY: mix(from.targetY, frame.targetY),
    };
  }

  /** Which agents get a marker, and whether the others are dots. */
  private shownOf(frame: Frame, places: Pick<Frame, "x" | "y">): Pick<layers.Moment, "shown" | "dotted"> {
    const shown = frame.x.length <= MARKED ? Uint32Array.from(frame.x.keys()) : inView(this.camera, places);
    return { shown: shown ?? reporting(frame), dotted: shown === null };
  }

  /** Frames before the shown one that lie so close that lines between them are paths. */
  private past(frame: Frame, units: number): Frame[] {
    const near = this.tape(this.run).recent(frame.step - 1, this.stepsFor(units));
    let begin = near.length;
    const closest = this.stepsFor(LONGEST_JUMP * 20);
    for (let next = frame; begin > 0; next = near[--begin]) {
      const each = near[begin - 1];
      if (each.epoch !== frame.epoch || each.x.length !== frame.x.length || next.step - each.step > closest) break;
    }
    return near.slice(begin);
  }

  /** The part of the past that agents' trails show: a third of the targets'. */
  private trail(past: Frame[]): Frame[] {
    const first = this.frame!.step - this.stepsFor(REACH);
    return past.filter((each) => each.step >= first);
  }

  private findPairs(frame: Frame): Pairs {
    if (this.pairs?.frame !== frame) this.pairs = { frame, pairs: linkedPairs(frame) };
    return this.pairs.pairs;
  }

  private markerSize(agents: number): number {
    const { plot } = this.camera;
    return Math.min(Math.max(0.085 * Math.sqrt((plot.width * plot.height) / Math.max(agents, 1)), 2), 6.5);
  }
}
