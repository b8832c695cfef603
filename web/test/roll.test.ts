// Who is lost or silent, by number.

import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { names } from "../src/roll";

describe("names of buoys", () => {
  it("say that there are none", () => {
    assert.equal(names([]), "none");
  });
  it("are ranges where numbers stand in a row", () => {
    assert.equal(names([0, 1, 2, 3, 12, 14, 15]), "no. 0–3, 12, 14–15");
    assert.equal(names([7]), "no. 7");
  });
  it("end somewhere", () => {
    assert.ok(names(Array.from({ length: 1000 }, (_, n) => 2 * n)).endsWith(", 46 …"));
  });
});
