import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { between, measured, Ruler } from "../src/measure";

const origin = { x: 0, y: 0 };

describe("Between two points", () => {
  it("bearings are those of a compass: north 0, east 90", () => {
    const bearings = [
      [0, 1],
      [1, 0],
      [0, -1],
      [-1, 0],
      [-1, 1],
    ].map(([x, y]) => between(origin, { x, y }).bearing);
    assert.deepEqual(bearings, [0, 90, 180, 270, 315]);
  });

  it("words are in m, and in km from 1 km on; 359.7° is 000°", () => {
    assert.equal(measured(origin, { x: 3, y: 4 }), "5 m · 037°");
    assert.equal(measured(origin, { x: -5, y: 1000 }), "1 km · 000°");
    assert.equal(measured(origin, { x: 1234.56, y: 0 }), "1.235 km · 090°");
  });
});

describe("A ruler", () => {
  it("takes two clicks, and follows the pointer between them", () => {
    const ruler = new Ruler();
    ruler.press(origin);
    ruler.release();
    ruler.move({ x: 1, y: 1 });
    assert.deepEqual(ruler.ends?.[1], { x: 1, y: 1 });
    ruler.press({ x: 2, y: 2 });
    ruler.release();
    ruler.move({ x: 9, y: 9 });
    assert.deepEqual(ruler.ends, [origin, { x: 2, y: 2 }]);
  });

  it("takes one drag", () => {
    const ruler = new Ruler();
    ruler.press(origin);
    ruler.move({ x: 2, y: 0 });
    ruler.release();
    ruler.move({ x: 9, y: 9 });
    assert.deepEqual(ruler.ends, [origin, { x: 2, y: 0 }]);
  });
});
