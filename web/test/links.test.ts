import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { heardBy, hears, linkedPairs } from "../src/links";
import { decodeFrame } from "../src/protocol";
import { makeFrame } from "./bytes";

// 0 hears 1 and 9, 1 hears 0, 9 hears 8
const rows = Array.from({ length: 10 }, () => [0, 0]);
rows[0] = [0b10, 0b10];
rows[1] = [0b1, 0];
rows[9] = [0, 0b1];
const frame = decodeFrame(makeFrame({ x: Array.from({ length: 10 }, (_, n) => n), links: rows }));

describe("Links", () => {
  it("are the bits that the engine sent", () => {
    assert.equal(hears(frame, 0, 9), true);
    assert.equal(hears(frame, 9, 0), false);
    assert.equal(hears(frame, 9, 8), true);
  });

  it("are drawn once, though both hear each other", () => {
    assert.deepEqual([...linkedPairs(frame)], [0, 1, 0, 9, 8, 9]);
  });

  it("of one agent go to those that it hears", () => {
    assert.deepEqual([...heardBy(frame, 0)], [0, 1, 0, 9]);
    assert.deepEqual([...heardBy(frame, 8)], []);
  });

  it("that were not kept are none", () => {
    assert.equal(linkedPairs(decodeFrame(makeFrame({ x: [0, 1, 2] }))).length, 0);
  });
});
