import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { degrees, momentOf, onEarth, placeWords, scaleBar } from "../src/geography";
import type { Earth, Scene } from "../src/protocol";

/** A plain Earth: 1 unit of x is a degree east of 179.5 E, 1 of y a degree north of 60 N. */
const coefficients = (constant: number, x: number, y: number): number[] => Array.from({ length: 15 }, (_, n) => [constant, y, 0, 0, 0, x][n] ?? 0);
const earth: Earth = { size: 1000, lon: coefficients(179.5, 1, 0), lat: coefficients(60, 0, 1), error: 0, lines: [] };

describe("A place on Earth", () => {
  it("is what the polynomials say, and east of 180 it is west", () => {
    assert.deepEqual(onEarth(earth, 0, 500), { lon: 179.5, lat: 60.5 });
    assert.deepEqual(onEarth(earth, 1000, 0), { lon: -179.5, lat: 60 });
  });

  it("is written as navigators do", () => {
    assert.equal(degrees(-30.0125, "EW", 2), "30°00.75′W");
    assert.equal(degrees(59.99999, "NS", 1), "60°00.0′N");
    assert.equal(degrees(5.5, "EW", 0), "5°30′E");
  });

  it("has the digits that a pixel tells, and local meters", () => {
    const scene = { area: { width: 3000, height: 2000 }, geography: { earth } } as unknown as Scene;
    assert.equal(placeWords(scene, 500, -100, 4), "59°54.000′N 180°00.000′W · 0.500, −0.100 km");
    assert.equal(placeWords({ area: { width: 20, height: 20 }, geography: null } as unknown as Scene, 1.234, 5, 0.04), "1.23, 5.00 m");
  });
});

describe("A scale bar", () => {
  it("has a round length, a little longer than asked for", () => {
    assert.deepEqual(scaleBar(2.3), { meters: 5, words: "5 m" });
    assert.deepEqual(scaleBar(600), { meters: 1000, words: "1 km" });
  });
});

describe("A current", () => {
  it("lies between two times, and comes again with the tide", () => {
    assert.deepEqual(momentOf([0, 10, 20], 20, 45), [0, 1, 0.5]);
    assert.deepEqual(momentOf([0, 10, 20], null, 45), [1, 2, 1]);
    assert.deepEqual(momentOf([0], null, 7), [0, 0, 0]);
  });
});
