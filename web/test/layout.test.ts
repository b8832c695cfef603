import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { arrange, type Size } from "../src/layout";

const at = (width: number, height: number): Size => ({ width, height });

describe("The arrangement", () => {
  it("gives a wide arena at least 60 % of the width of a small desk", () => {
    const { layout, map } = arrange(at(1280, 720), 4, 1, true);
    assert.equal(layout, "below");
    assert.ok(map.width >= 0.6 * 1280, `${map.width}`);
  });

  it("gives a square all the height that there is", () => {
    for (const screen of [at(1280, 720), at(1920, 1080)]) {
      const { layout, map, side } = arrange(screen, 1, 1, true);
      assert.equal(layout, "beside");
      assert.ok(map.height > screen.height - 240);
      assert.ok(screen.width - side - map.width < 0.1 * screen.width, "nothing is left empty");
    }
  });

  it("leaves it all to the water when panels are put away", () => {
    assert.ok(arrange(at(1280, 720), 4, 1, false).map.width > 0.9 * 1280);
  });

  it("keeps room for controls under the water of a phone, and beside it when it is turned", () => {
    const upright = arrange(at(390, 844), 1, 1, true);
    assert.equal(upright.layout, "sheet");
    assert.ok(upright.stages > 250 && upright.stages < 0.55 * 844);
    const turned = arrange(at(844, 390), 1, 1, true);
    assert.equal(turned.layout, "short");
    assert.ok(turned.side >= 280 && turned.map.height > 250);
  });

  it("puts two wide arenas one over the other, two squares side by side", () => {
    assert.equal(arrange(at(1280, 900), 5, 2, true).stacked, true);
    assert.equal(arrange(at(1280, 720), 1, 2, true).stacked, false);
  });

  it("is possible on any screen", () => {
    for (const [width, height] of [
      [320, 256],
      [200, 2000],
      [3000, 300],
      [1, 1],
    ] as const) {
      for (const aspect of [0.05, 1, 20]) {
        const { map, side } = arrange(at(width, height), aspect, 2, true);
        assert.ok(map.width > 0 && map.height > 0 && side >= 0);
      }
    }
  });
});
