// A recorded run inside the page: plays, seeks and steps through the frames that the record kept.

import { decodeFrame, splitFrames, type Frame, type Request, type Scene } from "./protocol";
import type { Listener, Source } from "./source";
import { Tape } from "./tape";

const SPEEDS = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];
const SMOOTH = 12; // frames a second that the first speed should show

export class ReplaySource implements Source {
  readonly live = false;
  private readonly frames = new Tape();
  private readonly scene: Scene;
  private speed: number;
  private playing = false;
  private clock = 0; // [steps], runs between frames
  private shown = -1; // index of the frame shown
  private ticked = 0; // [ms]

  constructor(
    scene: string,
    frames: string,
    private readonly listener: Listener,
  ) {
    this.scene = JSON.parse(scene) as Scene;
    const bytes = Uint8Array.from(atob(frames.trim()), (letter) => letter.charCodeAt(0));
    for (const each of splitFrames(bytes)) this.frames.add(decodeFrame(each));
    this.speed = this.pickSpeed();
  }

  tape(): Tape {
    return this.frames;
  }

  connect(): void {
    this.listener.hello({ type: "hello", runs: 1, recording: false, speeds: SPEEDS, strategies: [] });
    this.listener.scene(0, this.scene);
    if (this.frames.length === 0) {
      this.listener.failure({ type: "error", message: "this record kept no frames\n  fix: record with --every" });
      return;
    }
    this.show(0);
    this.follow();
    addEventListener("hashchange", () => {
      this.follow();
    });
  }

  /** Show the step that the address names: run.html#step=700. */
  private follow(): void {
    const step = /^#step=(\d{1,15})$/.exec(location.hash)?.[1];
    if (step !== undefined) this.send({ do: "seek", step: Number(step) });
  }

  send(request: Request): void {
    switch (request.do) {
      case "play":
        if (this.shown === this.frames.length - 1) this.show(0);
        return this.play();
      case "pause":
        return this.pause();
      case "step":
        this.pause();
        return this.show(Math.min(this.shown + 1, this.frames.length - 1));
      case "speed":
        this.speed = request.value;
        return this.report();
      case "seek":
        this.pause();
        return this.show(Math.max(this.frames.indexOf(request.step), 0));
      case "restart":
        this.show(0);
        return this.report();
      default:
        this.listener.failure({ type: "error", message: "a record cannot be changed" });
    }
  }

  private play(): void {
    if (this.playing) return;
    this.playing = true;
    this.ticked = performance.now();
    this.report();
    requestAnimationFrame(this.tick);
  }

  private pause(): void {
    this.playing = false;
    this.clock = this.frame(this.shown).step;
    this.report();
  }

  private readonly tick = (now: number): void => {
    if (!this.playing) return;
    const seconds = Math.min(Math.max(now - this.ticked, 0) / 1000, 0.25); // a page in the background sleeps
    this.ticked = now;
    this.clock += (seconds * this.speed) / this.scene.time_step;
    const index = this.frames.indexOf(this.clock);
    if (index >= this.frames.length - 1) {
      this.playing = false;
      this.show(this.frames.length - 1);
      return;
    }
    if (index !== this.shown) this.show(index, this.clock);
    requestAnimationFrame(this.tick);
  };

  private show(index: number, clock = this.frame(index).step): void {
    this.shown = index;
    this.clock = clock;
    this.listener.frame(this.frame(index));
    this.report();
  }

  private frame(index: number): Frame {
    return this.frames.at(index);
  }

  private report(): void {
    const last = this.frame(this.frames.length - 1).step;
    const step = this.frame(this.shown).step;
    this.listener.status({
      type: "status",
      playing: this.playing,
      speed: this.speed,
      step,
      first: this.frame(0).step,
      last,
      at_end: step === last,
      busy: null,
    });
  }

  /** The first speed that shows the typical gap between frames smoothly. */
  private pickSpeed(): number {
    if (this.frames.length < 2) return 1;
    const gap = this.frame(1).step - this.frame(0).step;
    return SPEEDS.find((speed) => speed / (gap * this.scene.time_step) >= SMOOTH) ?? SPEEDS[SPEEDS.length - 1];
  }
}
