// Where scenes and frames come from: a running engine (live.ts) or the page itself (replay.ts).

import type { Failure, Frame, Hello, Past, Request, SavedText, Scene, Status, Measured } from "./protocol";
import type { Tape } from "./tape";

export interface Listener {
  hello(hello: Hello): void;
  past(past: Past): void;
  scene(run: number, scene: Scene): void;
  frame(frame: Frame): void;
  measured(measured: Measured): void;
  file(file: SavedText): void;
  status(status: Status): void;
  failure(failure: Failure): void;
  /** The engine is gone, for the reason given; `connect` tries again. */
  lost(reason: string): void;
}

export interface Source {
  readonly live: boolean;
  /** Frames of a run that the page holds. */
  tape(run: number): Tape;
  connect(): void;
  send(request: Request): void;
}
