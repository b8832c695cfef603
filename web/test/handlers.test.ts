import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { describe, it } from "node:test";

describe("Handlers", () => {
  it("return nothing: false cancels what the browser does with a key, and traps the keyboard in a field", () => {
    for (const file of readdirSync("src").filter((name) => name.endsWith(".ts"))) {
      const returning = readFileSync(`src/${file}`, "utf8").match(/\.on[a-z]+ = .*=> (?!\{).*/g);
      assert.deepEqual(returning, null, file);
    }
  });
});
