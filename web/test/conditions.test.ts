import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { happened, heardShare } from "../src/conditions";
import { decodeFrame } from "../src/protocol";
import { makeFrame } from "./bytes";

describe("Comings and goings", () => {
  const scene = {
    events: [
      [5, "lost", 3],
      [5, "lost", 4],
      [9, "joined", 7],
    ] as [number, "lost" | "joined", number][],
  };

  it("are told when they have happened, those of a step together", () => {
    assert.deepEqual(happened(scene, 4), []);
    assert.deepEqual(happened(scene, 9), ["step 5: no. 3, 4 lost", "step 9: no. 7 joined"]);
  });

  it("that were only seen say by when", () => {
    assert.deepEqual(happened({ events: [] }, 50, [[40, "lost", 1]]), ["by step 40: no. 1 lost"]);
  });
});

describe("What was heard of what was asked for", () => {
  it("is the share of links of the living", () => {
    // 0 asks for 2 and hears 1, 1 asks for 2 and hears both, 2 is gone
    const frame = decodeFrame(makeFrame({ x: [0, 1, 2, 3], degree: [2, 2, 2, 2], flags: [2, 2, 0, 2], links: [[0b10], [0b1001], [0], [0b11]] }));
    assert.equal(heardShare(frame), 5 / 6);
  });

  it("is unknown without links", () => {
    assert.equal(heardShare(decodeFrame(makeFrame({ x: [0, 1] }))), null);
  });
});
