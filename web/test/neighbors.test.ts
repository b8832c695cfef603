import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { nearestPairs } from "../src/neighbors";

const everybody = (): boolean => true;

function pairsOf(x: number[], y: number[], k: number, range: number | null = null, there = everybody as (agent: number) => boolean) {
  const degree = new Uint16Array(x.length).fill(k);
  const pairs = nearestPairs({ x: Float32Array.from(x), y: Float32Array.from(y), degree }, range, there);
  return Array.from({ length: pairs.length / 2 }, (_, p) => `${pairs[2 * p]}-${pairs[2 * p + 1]}`).sort();
}

/** The slow, plain way: sort everybody by (distance, index). */
function plainPairs(x: number[], y: number[], k: number): string[] {
  const found = new Set<string>();
  const [fx, fy] = [Float32Array.from(x), Float32Array.from(y)];
  x.forEach((_, i) => {
    const far = (j: number): number => (fx[j] - fx[i]) ** 2 + (fy[j] - fy[i]) ** 2;
    const others = x.map((_, j) => j).filter((j) => j !== i);
    others.sort((a, b) => far(a) - far(b) || a - b);
    for (const j of others.slice(0, k)) found.add(`${Math.min(i, j)}-${Math.max(i, j)}`);
  });
  return [...found].sort();
}

/** Numbers in [0, 1) that are the same every time. */
function chance(seed: number): () => number {
  return () => (seed = (seed * 16807) % 2147483647) / 2147483647;
}

describe("The k nearest others", () => {
  it("on a line are the ones beside", () => {
    assert.deepEqual(pairsOf([0, 1, 3, 6], [0, 0, 0, 0], 1), ["0-1", "1-2", "2-3"]);
  });

  it("are everybody when k is all", () => {
    assert.equal(pairsOf([0, 1, 3, 6, 7], [0, 2, 1, 0, 5], 4).length, 10);
  });

  it("are those that sorting all distances gives, in swarms, clusters and corners", () => {
    const draw = chance(7);
    for (const [agents, k, spread] of [[50, 20, 20], [200, 3, 20], [200, 30, 0.001], [30, 29, 5], [120, 7, 1000]]) {
      const x = Array.from({ length: agents }, () => (draw() < 0.3 ? 0 : draw() * spread));
      const y = Array.from({ length: agents }, () => (draw() < 0.3 ? 0 : draw() * spread));
      assert.deepEqual(pairsOf(x, y, k), plainPairs(x, y, k));
    }
  });

  it("go to the lower index when distances are equal", () => {
    assert.deepEqual(pairsOf([0, 1, -1], [0, 0, 0], 1), ["0-1", "0-2"]);
    assert.deepEqual(pairsOf([0, 0, 0], [0, 0, 0], 1), ["0-1", "0-2"]);
  });

  it("are not heard beyond the range", () => {
    assert.deepEqual(pairsOf([0, 1, 3, 6], [0, 0, 0, 0], 3, 2), ["0-1", "1-2"]);
  });

  it("are never agents that are gone", () => {
    assert.deepEqual(pairsOf([0, 1, 3], [0, 0, 0], 1, null, (agent) => agent !== 1), ["0-2"]);
  });

  it("of nobody are none", () => {
    assert.deepEqual(pairsOf([0, 1], [0, 0], 1, null, () => false), []);
  });
});
