import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { Camera } from "../src/camera";
import { dotSide, inView, MARKED, reporting } from "../src/dots";
import { decodeFrame } from "../src/protocol";
import { makeFrame } from "./bytes";

const sea = (): Camera => {
  const camera = new Camera();
  camera.fit({ width: 100, height: 100 }, { width: 500, height: 500 }, { left: 0, right: 0, top: 0, bottom: 0 });
  return camera;
};
const row = (agents: number): { x: Float32Array; y: Float32Array } => ({
  x: Float32Array.from({ length: agents }, (_, agent) => (100 * agent) / agents - 50),
  y: new Float32Array(agents),
});

describe("A swarm of very many", () => {
  it("gets markers while those in view are few", () => {
    assert.equal(inView(sea(), row(MARKED))!.length, MARKED);
    assert.equal(inView(sea(), row(MARKED + 1)), null);
  });

  it("gets markers when one comes nearer, of those in view alone", () => {
    const camera = sea();
    camera.zoomBy(12);
    const shown = [...inView(camera, row(10 * MARKED))!];
    assert.ok(shown.length > 0.7 * MARKED);
    assert.ok(shown.every((agent) => Math.abs(agent - 5 * MARKED) < MARKED));
    assert.deepEqual(
      shown,
      [...shown].sort((a, b) => a - b),
    );
  });

  it("has markers for those that report a target, if they are there", () => {
    assert.deepEqual([...reporting(decodeFrame(makeFrame({ x: [0, 0, 0, 0], flags: [2, 3, 1, 3] })))], [1, 3]);
  });

  it("has dots that leave most of the water free", () => {
    assert.deepEqual(
      [3000, 30_000, 1_000_000].map((agents) => dotSide(400_000, agents)),
      [3, 2, 1],
    );
  });
});
