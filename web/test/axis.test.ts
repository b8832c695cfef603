import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { axisRange, lastAt, timeUnit } from "../src/axis";

const flat = (value: number, count = 100): number[] => Array.from({ length: count }, () => value);

describe("The range of an axis", () => {
  it("is the bounds of a share, whatever it is", () => {
    assert.deepEqual(axisRange([[0.2, 0.3]], 0, 1), { low: 0, high: 1, peak: null });
  });

  it("begins at 0 and holds every value", () => {
    const { low, high, peak } = axisRange([[3, NaN, 7], [5]], 0, null);
    assert.equal(low, 0);
    assert.ok(high > 7 && high < 8);
    assert.equal(peak, null);
  });

  it("leaves out a spike at the beginning, and says how high it is", () => {
    const { high, peak } = axisRange([[36_000, ...flat(300)]], 0, null);
    assert.ok(high > 300 && high < 400);
    assert.equal(peak, 36_000);
  });

  it("leaves out no peak that comes later", () => {
    const { high, peak } = axisRange([[...flat(1), 9, ...flat(1)]], 0, null);
    assert.ok(high > 9);
    assert.equal(peak, null);
  });

  it("of a difference has 0 in it, also of shares", () => {
    const { low, high } = axisRange([[-0.2, -0.1]], 0, 1, true);
    assert.ok(low < -0.2 && high > 0 && high < 0.1);
  });

  it("is there without a value", () => {
    assert.deepEqual(axisRange([[], [NaN]], 0, null), { low: 0, high: 1, peak: null });
  });
});

describe("Time on an axis", () => {
  it("is in the unit that a person would take", () => {
    assert.deepEqual(
      [60, 600, 10_000].map((seconds) => timeUnit(seconds).name),
      ["s", "min", "h"],
    );
  });
});

describe("The last at or before", () => {
  it("is found among rising numbers", () => {
    assert.deepEqual(
      [-1, 0, 5, 10, 99].map((at) => lastAt([0, 5, 10], at)),
      [-1, 0, 1, 2, 2],
    );
  });
});
