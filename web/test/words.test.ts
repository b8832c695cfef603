import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { Camera, ticks } from "../src/camera";
import { count, estimate, fixed, time } from "../src/format";

describe("Words", () => {
  it("set thousands apart and write true minus signs", () => {
    assert.equal(count(1234567), "1\u2009234\u2009567");
    assert.equal(fixed(-0.5, 1), "\u22120.5");
  });

  it("say that a number is unknown", () => {
    assert.equal(fixed(NaN, 3), "–");
    assert.equal(estimate(null, null, null).mean, "unknown");
  });

  it("show two digits of an interval's half-width", () => {
    assert.deepEqual(estimate(0.82987, 0.82397, 0.83577), { mean: "0.8299", interval: "[0.8240, 0.8358]" });
    assert.deepEqual(estimate(1394.2, 1365.3, 1423.6), { mean: "1\u2009394", interval: "[1\u2009365, 1\u2009424]" });
    assert.deepEqual(estimate(123456, 121000, 126000), { mean: "123\u2009500", interval: "[121\u2009000, 126\u2009000]" });
    assert.equal(estimate(200, null, null).mean, "200");
    assert.equal(estimate(0.81234, null, null).mean, "0.812");
  });

  it("choose the unit of a time", () => {
    assert.deepEqual([time(12.34), time(600), time(36000)], ["12.3 s", "10.0 min", "10.00 h"]);
  });
});

describe("Ticks", () => {
  it("are round numbers within the limits", () => {
    assert.deepEqual(ticks(-10, 10, 8), { values: [-10, -5, 0, 5, 10], decimals: 0 });
    assert.deepEqual(ticks(0, 1, 2.5), { values: [0, 0.5, 1], decimals: 1 });
  });

  it("of nothing are none", () => {
    assert.deepEqual(ticks(1, 1, 5).values, []);
  });
});

describe("The camera", () => {
  const camera = new Camera();
  camera.fit({ width: 20, height: 20 }, { width: 600, height: 600 }, { left: 50, right: 50, top: 50, bottom: 50 });

  it("goes from meters to pixels and back, north up", () => {
    assert.ok(Math.abs(camera.fromX(camera.toX(3.5)) - 3.5) < 1e-9);
    assert.ok(Math.abs(camera.fromY(camera.toY(-7)) + 7) < 1e-9);
    assert.ok(camera.toY(5) < camera.toY(-5));
  });

  it("keeps the place under the pointer when it comes nearer", () => {
    const before = camera.fromX(200);
    camera.zoomBy(2, 200, 300);
    assert.ok(Math.abs(camera.fromX(200) - before) < 1e-9);
    camera.reset();
    assert.equal(camera.zoomed, false);
    assert.ok(Math.abs(camera.toX(0) - 300) < 1);
  });

  it("never leaves the area", () => {
    camera.zoomBy(2);
    camera.pan(1e6, 0);
    assert.ok(camera.fromX(camera.plot.left) >= -11);
    camera.reset();
  });
});
