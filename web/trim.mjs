// uPlot without what the page has no use for: bars, bands, steps, splines, calendars, logarithms and ranges of its own. A fifth of it.
import { readFile } from "node:fs/promises";

const STUBS = {
  genTimeStuffs: "return [[], [], () => () => []];",
  fmtDate: 'return () => "";',
  timeAxisStamps: "return [];",
  timeAxisVals: "return () => [];",
  timeSeriesVal: 'return () => "";',
  rangeLog: "return [min, max];",
  rangeAsinh: "return [min, max];",
  logAxisSplits: "return [];",
  asinhAxisSplits: "return [];",
  log10AxisValsFilt: "return splits;",
  log2AxisValsFilt: "return splits;",
  _rangeNum: "return [_min, _max];",
  bandFillClipDirs: "return [0, 0];",
  clipBandLine: "return null;",
  snapLogY: "return [dataMin, dataMax];",
  snapAsinhY: "return [dataMin, dataMax];",
};
const LINES = ["(paths.stepped = stepped);", "(paths.bars    = bars);", "(paths.spline  = monotoneCubic);", "uPlot.tzDate  = tzDate;"];

/** Take parts out of uPlot; where one is not there any more, the build fails. */
export function trimmed(source) {
  let text = source;
  for (const line of LINES) text = replaced(text, line, "");
  for (const [name, body] of Object.entries(STUBS)) {
    const [, head] = new RegExp(`\n(function ${name}\\([^)]*\\) \\{)\n`).exec(text) ?? [];
    if (!head) throw new Error(`uPlot has no function ${name} any more: see web/trim.mjs`);
    const begin = text.indexOf(`\n${head}\n`);
    const end = text.indexOf("\n}\n", begin);
    text = `${text.slice(0, begin)}\n${head} ${body}${text.slice(end)}`;
  }
  return text;
}

function replaced(text, line, by) {
  if (!text.includes(line)) throw new Error(`uPlot has no line ${line} any more: see web/trim.mjs`);
  return text.replace(line, by);
}

export const trimUplot = {
  name: "trim-uplot",
  setup(build) {
    build.onLoad({ filter: /uPlot\.esm\.js$/ }, async ({ path }) => ({ contents: trimmed(await readFile(path, "utf8")), loader: "js" }));
  },
};
