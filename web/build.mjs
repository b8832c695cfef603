// Bundle the page into the Python package, or (--tests) the tests into build/. Same sources, same bytes.
import { copyFileSync, mkdirSync, readdirSync } from "node:fs";
import { build } from "esbuild";
import { trimUplot } from "./trim.mjs";

const STATIC = "../src/shoal/viewer/static";
const BANNER = "/*! Shoal's viewer. Built from web/src by `npm run build` in web/; edit there, not here. */";

const WITH = "/*! With uPlot, Copyright (c) 2022 Leon Sorokin, MIT License: see THIRD_PARTY.md. */";

if (process.argv.includes("--tests")) {
  const tests = readdirSync("test").filter((name) => name.endsWith(".test.ts"));
  await build({
    entryPoints: tests.map((name) => `test/${name}`),
    bundle: true,
    platform: "node",
    format: "esm",
    outdir: "build",
    outExtension: { ".js": ".mjs" },
  });
} else {
  mkdirSync(STATIC, { recursive: true });
  await build({
    entryPoints: [
      { in: "src/main.ts", out: "app" },
      { in: "src/page.css", out: "app" },
    ],
    bundle: true,
    plugins: [trimUplot],
    minify: true,
    charset: "utf8",
    format: "iife",
    target: ["es2022"],
    banner: { js: `${BANNER}\n${WITH}`, css: BANNER },
    legalComments: "none",
    outdir: STATIC,
  });
  copyFileSync("src/index.html", `${STATIC}/index.html`);
}
