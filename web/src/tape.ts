// Frames of one run that the page holds, in the order of their steps.

import type { Frame } from "./protocol";

export class Tape {
  private readonly frames: Frame[] = [];
  private bytes = 0;

  /** A tape that forgets its oldest frames beyond so many bytes. */
  constructor(private readonly room = Infinity) {}

  get length(): number {
    return this.frames.length;
  }

  at(index: number): Frame {
    return this.frames[index];
  }

  /** Add a frame that is newer than all others; an older one is known already. */
  add(frame: Frame): void {
    if (this.length > 0 && frame.step <= this.at(this.length - 1).step) return;
    this.frames.push(frame);
    this.bytes += frame.bytes.byteLength;
    let old = 0;
    while (this.bytes > this.room && old < this.frames.length - 1) this.bytes -= this.frames[old++].bytes.byteLength;
    this.frames.splice(0, old);
  }

  /** Forget the frames from a step on. */
  cut(step: number): void {
    while (this.frames.length > 0 && this.frames[this.frames.length - 1].step >= step) {
      this.bytes -= this.frames.pop()!.bytes.byteLength;
    }
  }

  /** Index of the last frame at or before a step; -1 if there is none. */
  indexOf(step: number): number {
    let [low, high] = [0, this.frames.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.frames[middle].step <= step) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  }

  /** Frames of the `steps` before a step and that of the step itself, oldest first. */
  recent(step: number, steps: number): Frame[] {
    return this.frames.slice(this.indexOf(step - steps - 1) + 1, this.indexOf(step) + 1);
  }
}
