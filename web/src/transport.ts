// The bar below the water: play, step, scrub, speed.

import { el, svg } from "./dom";
import { count, time } from "./format";
import type { Request, Status } from "./protocol";

const ICONS = {
  restart: "M5 4v8M14 4 7 8l7 4z",
  back: "M11 4 5 8l6 4z",
  play: "M5 3l9 5-9 5z",
  pause: "M5 3v10M11 3v10",
  forward: "M5 4l6 4-6 4z",
  newest: "M3 4l7 4-7 4zM12 4v8",
};

export class Transport {
  readonly root = el("footer", { class: "transport", "aria-label": "Time" });
  readonly scrub = el("input", { type: "range", min: 0, max: 0, value: 0, step: 1, "aria-label": "Step shown" });
  readonly speed = el("input", { type: "range", min: 0, max: 0, value: 0, step: 1, "aria-label": "Speed" });
  readonly restart = button("restart", "Restart from step 0 (R)");
  private readonly back = button("back", "One step back (←)");
  private readonly play = button("play", "Play (space)");
  private readonly forward = button("forward", "One step forward (→)");
  private readonly newest = button("newest", "To the newest step (End)");
  private readonly clock = el("output", { class: "clock" });
  private readonly times = el("output", { class: "times" });
  private readonly pace = el("label", { class: "speed", title: "Speed, times real time ([ and ])" }, el("span", {}, "Speed"), this.speed, this.times);
  private speeds: number[] = [];
  private status: Status | null = null;
  private timeStep = 0; // [s]
  private wanted: number | null = null; // step to seek in the next frame

  constructor(
    private readonly send: (request: Request) => void,
    private readonly shown: () => number, // the step on the water: the status comes after its frame
  ) {
    this.play.classList.add("main");
    this.root.append(
      el("div", { class: "buttons" }, this.restart, this.back, this.play, this.forward, this.newest),
      el("div", { class: "scrubbing" }, this.scrub, this.clock),
      this.pace,
    );
    this.restart.onclick = () => {
      this.send({ do: "restart" });
    };
    this.back.onclick = () => {
      this.stepBy(-1);
    };
    this.forward.onclick = () => {
      this.stepBy(1);
    };
    this.play.onclick = () => {
      this.toggle();
    };
    this.newest.onclick = () => {
      this.toNewest();
    };
    this.scrub.oninput = () => {
      this.seekSoon(Number(this.scrub.value));
    };
    this.speed.oninput = () => {
      this.send({ do: "speed", value: this.speeds[Number(this.speed.value)] });
    };
    this.times.textContent = "–";
  }

  offer(speeds: number[]): void {
    this.speeds = speeds;
    this.speed.max = String(speeds.length - 1);
    this.speed.hidden = this.restart.hidden = speeds.length === 0; // what runs by itself keeps its own time
    this.pace.classList.toggle("told", speeds.length === 0);
  }

  update(status: Status, timeStep: number): void {
    const { playing, first, last, step } = status;
    if (playing !== this.status?.playing) setIcon(this.play, playing ? "pause" : "play", playing ? "Pause (space)" : "Play (space)");
    this.status = status;
    this.timeStep = timeStep;
    this.scrub.min = String(first);
    this.scrub.max = String(last);
    if (this.wanted === null) this.scrub.value = String(step);
    this.scrub.style.setProperty("--done", `${last > first ? (100 * (step - first)) / (last - first) : 100}%`);
    this.newest.disabled = status.at_end;
    this.back.disabled = step <= first;
    const pace = status.speed ?? 1;
    const nearest = this.speeds.reduce((best, each, n) => (gap(each, pace) < gap(this.speeds[best], pace) ? n : best), 0);
    if (document.activeElement !== this.speed || !this.speed.matches(":active")) this.speed.value = String(nearest);
    this.times.textContent = status.speed === null ? "as it goes" : `${status.speed}×`;
    this.speed.setAttribute("aria-valuetext", `${status.speed} times real time`);
    this.tell(step);
  }

  toggle(): void {
    this.send({ do: this.status?.playing ? "pause" : "play" });
  }

  /** Steps back go to the last frame that is kept. */
  stepBy(steps: number): void {
    if (steps < 0) this.send({ do: "seek", step: Math.max(this.shown() + steps, this.status?.first ?? 0) });
    else this.send({ do: "step", steps });
  }

  toNewest(): void {
    if (this.status) this.send({ do: "seek", step: this.status.last });
  }

  toFirst(): void {
    if (this.status) this.send({ do: "seek", step: this.status.first });
  }

  changeSpeed(by: number): void {
    if (this.speeds.length === 0) return;
    const index = Math.min(Math.max(Number(this.speed.value) + by, 0), this.speeds.length - 1);
    this.speed.value = String(index);
    this.send({ do: "speed", value: this.speeds[index] });
  }

  /** At most one seek per frame, however fast the slider moves. */
  private seekSoon(step: number): void {
    const waiting = this.wanted !== null;
    this.wanted = step;
    this.tell(step);
    if (waiting) return;
    requestAnimationFrame(() => {
      this.send({ do: "seek", step: this.wanted! });
      this.wanted = null;
    });
  }

  private tell(step: number): void {
    const last = this.status?.last ?? step;
    this.clock.textContent = `${time(step * this.timeStep)} · step ${count(step)} of ${count(last)}`;
    this.scrub.setAttribute("aria-valuetext", `step ${step}, ${time(step * this.timeStep)}`);
  }
}

const gap = (a: number, b: number): number => Math.abs(Math.log(a / b));

function button(icon: keyof typeof ICONS, name: string): HTMLButtonElement {
  const made = el("button", { type: "button" });
  setIcon(made, icon, name);
  return made;
}

function setIcon(made: HTMLButtonElement, icon: keyof typeof ICONS, name: string): void {
  made.title = name;
  made.setAttribute("aria-label", name);
  made.replaceChildren(svg("svg", { viewBox: "0 0 16 16", class: "icon", "aria-hidden": "true" }, svg("path", { d: ICONS[icon] })));
}
