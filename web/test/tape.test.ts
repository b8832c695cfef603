import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { History } from "../src/history";
import { decodeFrame, type Frame } from "../src/protocol";
import { Tape } from "../src/tape";
import { makeFrame } from "./bytes";

const frameAt = (step: number, engaged = 0): Frame => decodeFrame(makeFrame({ step, measures: [0, 0, 0, 0, engaged] }));

function tapeOf(...steps: number[]): Tape {
  const tape = new Tape();
  for (const step of steps) tape.add(frameAt(step));
  return tape;
}

describe("A tape", () => {
  it("finds the frame at or before a step", () => {
    const tape = tapeOf(0, 10, 20);
    assert.deepEqual(
      [-1, 0, 9, 10, 99].map((step) => tape.indexOf(step)),
      [-1, 0, 0, 1, 2],
    );
  });

  it("gives the frames of the last steps, the shown one too", () => {
    const steps = tapeOf(0, 10, 20, 30)
      .recent(20, 10)
      .map((frame) => frame.step);
    assert.deepEqual(steps, [10, 20]);
  });

  it("keeps what it knows when an older frame is shown again", () => {
    const tape = tapeOf(0, 10, 20, 10);
    assert.equal(tape.length, 3);
  });

  it("forgets what was undone", () => {
    const tape = tapeOf(0, 10, 20);
    tape.cut(10);
    assert.deepEqual([tape.length, tape.at(0).step], [1, 0]);
  });

  it("forgets its oldest frames when its room is used up", () => {
    const size = makeFrame({}).byteLength;
    const tape = new Tape(3 * size);
    for (let step = 0; step < 9; step++) tape.add(frameAt(step));
    assert.deepEqual([tape.length, tape.at(0).step], [3, 6]);
  });
});

describe("A history", () => {
  it("stays light in a long run, from its first step to its newest", () => {
    const history = new History();
    for (let step = 0; step <= 50_000; step++) history.add(frameAt(step, step));
    assert.ok(history.step.length <= 4001);
    assert.equal(history.step[0], 0);
    assert.ok(history.step.at(-1)! > 49_900);
    assert.deepEqual(history.of("engaged_now"), history.step);
  });

  it("begins with what went on before the page was opened", () => {
    const history = new History();
    history.add(frameAt(3, 1));
    const none = [null, null];
    history.fill({ type: "history", run: 0, step: [0, 50], time_on_target: none, recent: none, xi: [null, 0.5], xi_now: none, engaged: [2, 4] });
    for (const step of [49, 50, 51]) history.add(frameAt(step, 5));
    assert.deepEqual(history.step, [0, 50, 51]);
    assert.deepEqual(history.of("engaged_now"), [2, 4, 5]);
    assert.deepEqual(history.of("xi"), [NaN, 0.5, 0]);
  });

  it("does not change when older frames are shown again", () => {
    const history = new History();
    for (const step of [0, 1, 2, 1, 0]) history.add(frameAt(step));
    assert.deepEqual(history.step, [0, 1, 2]);
  });
});
