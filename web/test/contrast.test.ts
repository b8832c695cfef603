import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { describe, it } from "node:test";
import { blend, contrast, LEAST, standsOut } from "../src/contrast";
import { COVERS, FLEET_COLORS, fleetColor, lineColor, rimColor, TARGET_COLOR, type Theme } from "../src/palette";

/** The themes as the style sheet has them. */
const css = readFileSync("src/app.css", "utf8");
const themes: [string, Theme][] = [":root {", ':root[data-theme="dark"] {'].map((begin) => {
  const block = css.slice(css.indexOf(begin), css.indexOf("}", css.indexOf(begin)));
  const value = (name: string): string => new RegExp(`--${name}: (#[0-9a-f]{6});`).exec(block)![1]!;
  const theme = {
    dark: begin.includes("dark"),
    ink: value("ink"),
    muted: value("muted"),
    line: value("line"),
    water: value("water"),
    outside: value("card"),
    rim: value("rim"),
    land: value("land"),
    shore: value("shore"),
    current: value("current"),
    secondRun: value("second-run"),
  };
  return [begin, theme];
});
const fleets = FLEET_COLORS.map((_, fleet) => fleet);

describe("Contrast", () => {
  it("is 1 of a color with itself and 21 of black on white", () => {
    assert.equal(contrast("#777777", "#777777"), 1);
    assert.ok(Math.abs(contrast("#000000", "#ffffff") - 21) < 1e-9);
  });

  it("keeps a color that is seen, and changes one that is not by little", () => {
    assert.equal(standsOut("#000000", "#ffffff"), "#000000");
    assert.ok(contrast(standsOut("#F0E442", "#f4f8fc"), "#f4f8fc") < LEAST + 0.3);
  });
});

for (const [name, theme] of themes) {
  const seen = (color: string, covers = 1): number => contrast(blend(color, theme.water, covers), theme.water);
  describe(`Marks on the water, ${name}`, () => {
    it("of every fleet stand out: fill or rim, headings, trails, discs", () => {
      for (const fleet of fleets) {
        assert.ok(Math.max(seen(fleetColor(fleet)), seen(rimColor(fleet, theme))) >= LEAST, `marker ${fleet}`);
        assert.ok(seen(lineColor(fleet, theme)) >= LEAST, `heading ${fleet}`);
        assert.ok(seen(lineColor(fleet, theme, COVERS.trail), COVERS.trail) >= LEAST, `trail ${fleet}`);
        assert.ok(seen(lineColor(fleet, theme, COVERS.disc), COVERS.disc) >= LEAST, `disc ${fleet}`);
      }
    });

    it("that are no fleet's do, too", () => {
      const marks: [string, string, number][] = [
        ["target", TARGET_COLOR, 1],
        ["track", TARGET_COLOR, COVERS.track],
        ["link", theme.muted, COVERS.link],
        ["gone", theme.muted, COVERS.gone],
        ["outline", theme.ink, 1],
        ["edge", theme.muted, 1],
        ["shore", theme.shore, 1],
        ["current", theme.current, 1],
      ];
      for (const [mark, color, covers] of marks) assert.ok(seen(color, covers) >= LEAST, `${mark}: ${seen(color, covers)}`);
    });

    it("are words of 4.5 to 1", () => {
      for (const paper of [theme.outside, theme.water]) assert.ok(contrast(theme.muted, paper) >= 4.5);
    });
  });
}
