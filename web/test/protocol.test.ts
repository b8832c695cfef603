import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { decodeFrame, isAlive, isOnTarget, isPresent, parseMessage, ProtocolError, splitFrames } from "../src/protocol";
import { makeFrame } from "./bytes";

describe("A frame", () => {
  it("gives back what was written into it", () => {
    const measures = [0.5, 0.25, 0.75, 0.125, 3, ...Array.from({ length: 11 }, (_, bin) => bin)];
    const frame = decodeFrame(
      makeFrame({
        run: 1,
        epoch: 7,
        step: 70000,
        x: [1.5, -2.5, 4],
        y: [0.5, 1, 2],
        degree: [2, 1, 600],
        flags: [3, 2, 1],
        targets: [
          [8, -8, 1],
          [1, 2, 0],
        ],
        measures,
        links: [[6], [1], [0]],
        memory: [
          [5, 6, 7],
          [8, 9, 10],
        ],
      }),
    );
    assert.deepEqual([frame.run, frame.epoch, frame.step], [1, 7, 70000]);
    assert.deepEqual([frame.timeOnTarget, frame.timeOnTargetRecent, frame.xi, frame.xiNow, frame.engaged], measures.slice(0, 5));
    assert.deepEqual([...frame.phi], measures.slice(5));
    assert.deepEqual([...frame.x], [1.5, -2.5, 4]);
    assert.deepEqual([...frame.y], [0.5, 1, 2]);
    assert.deepEqual([...frame.vx, ...frame.vy, ...frame.repulsion], [0, 1, 2, 10, 11, 12, 20, 21, 22]);
    assert.deepEqual(
      frame.memory.map((field) => [...field]),
      [
        [5, 6, 7],
        [8, 9, 10],
      ],
    );
    assert.deepEqual([...frame.targetX, ...frame.targetY], [8, 1, -8, 2]);
    assert.deepEqual([...frame.degree], [2, 1, 600]);
    assert.deepEqual([frame.linkBytes, ...frame.links], [1, 6, 1, 0]);
  });

  it("tells who is on target, who is alive and which target is there", () => {
    const frame = decodeFrame(
      makeFrame({
        x: [0, 0, 0],
        flags: [3, 2, 1],
        targets: [
          [0, 0, 1],
          [0, 0, 0],
        ],
      }),
    );
    assert.deepEqual(
      [0, 1, 2].map((agent) => isOnTarget(frame, agent)),
      [true, false, true],
    );
    assert.deepEqual(
      [0, 1, 2].map((agent) => isAlive(frame, agent)),
      [true, true, false],
    );
    assert.deepEqual(
      [0, 1].map((target) => isPresent(frame, target)),
      [true, false],
    );
  });

  it("of very many agents is lean: where they are, and who reports a target", () => {
    const frame = decodeFrame(makeFrame({ version: 3, x: [1.5, 2], y: [3, 4], flags: [3, 2], targets: [[8, -8, 1]] }));
    assert.ok(frame.lean);
    assert.deepEqual([...frame.x, ...frame.y, ...frame.flags], [1.5, 2, 3, 4, 3, 2]);
    assert.deepEqual([frame.targetX[0], frame.targetY[0], frame.present[0]], [8, -8, 1]);
    assert.equal(frame.vx.length + frame.vy.length + frame.repulsion.length + frame.degree.length, 0);
  });

  it("of another format, or of the wrong length, is refused", () => {
    assert.throws(() => decodeFrame(makeFrame({ version: 1 })), ProtocolError);
    assert.throws(() => decodeFrame(makeFrame({}).slice(0, -1)), ProtocolError);
    assert.throws(() => decodeFrame(new ArrayBuffer(3)), ProtocolError);
  });
});

describe("Frames one behind the other", () => {
  it("are cut where each ends, wherever that is in memory", () => {
    const made = [makeFrame({ step: 0 }), makeFrame({ step: 5, x: [1, 2, 3], targets: [], links: [[6], [1], [0]] }), makeFrame({ step: 9 })];
    const joined = new Uint8Array(made.flatMap((each) => [...new Uint8Array(each)]));
    assert.deepEqual(
      splitFrames(joined).map((each) => decodeFrame(each).step),
      [0, 5, 9],
    );
  });

  it("that end too early are refused", () => {
    const bytes = new Uint8Array(makeFrame({}));
    assert.throws(() => splitFrames(bytes.slice(0, -2)), ProtocolError);
  });
});

describe("A text message", () => {
  it("of a known type is read", () => {
    assert.deepEqual(parseMessage('{"type": "error", "message": "no"}'), { type: "error", message: "no" });
  });

  it("of an unknown type, or none at all, is refused", () => {
    for (const text of ['{"type": "surprise"}', "null", "{", "7"]) assert.throws(() => parseMessage(text), ProtocolError);
  });
});
