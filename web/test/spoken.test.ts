import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { decodeFrame, type Scene } from "../src/protocol";
import { spoken } from "../src/spoken";
import { makeFrame } from "./bytes";

const scene = {
  area: { width: 20, height: 20 },
  fleets: [
    { name: "fast", count: 1 },
    { name: "slow", count: 2 },
  ],
} as unknown as Scene;

describe("The water in words", () => {
  it("says who is there, who reports and where they and the target are", () => {
    const frame = decodeFrame(makeFrame({ x: [4, 6, 99], y: [0, 0, 99], flags: [3, 2, 0], targets: [[0, -8, 1]], measures: [0.5, 0, 0.25] }));
    assert.equal(
      spoken(scene, frame),
      "1 fast and 1 slow are there; 1 report a target. Their middle is 5 m east of the middle. The target is 8 m south of the middle. " +
        "Time on target 0.500, velocity fluctuation 0.250.",
    );
  });

  it("says that a target is not there, and what is in the middle", () => {
    const frame = decodeFrame(
      makeFrame({
        x: [0, 0, 0],
        targets: [
          [0, 0, 0],
          [0.1, 0.1, 1],
        ],
        measures: [NaN],
      }),
    );
    assert.match(spoken(scene, frame), /Target 1 is not there\. Target 2 is in the middle\.$/);
  });
});
