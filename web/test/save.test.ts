import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { goneSince } from "../src/agent";
import { History } from "../src/history";
import type { RunNumbers } from "../src/lines";
import { decodeFrame, type Scene } from "../src/protocol";
import { table } from "../src/save";
import { SvgPaper } from "../src/svgpaper";
import { Tape } from "../src/tape";
import { makeFrame } from "./bytes";

const SCENE = {
  time_step: 0.1,
  series: [
    { name: "speed", unit: "m/s" },
    { name: "coverage", unit: "1" },
  ],
} as unknown as Scene;

describe("The table of numbers", () => {
  it("has a row for each step, SI, and nothing where there is no value", () => {
    const history = new History();
    history.learn(SCENE);
    history.add(decodeFrame(makeFrame({ step: 3, measures: [0.5, 0.25, NaN, 1, 2] })), [1.5, null]);
    const [head, first, end] = table([{ history, scene: SCENE } as RunNumbers]).split("\r\n");
    assert.equal(head, "run,step,time [s],time_on_target,recent,xi,xi_now,engaged_now,speed [m/s],coverage");
    assert.equal(first, "0,3,0.3,0.5,0.25,,1,2,1.5,");
    assert.equal(end, "");
  });
});

describe("An SVG", () => {
  const paper = (): SvgPaper => new SvgPaper(100, 50, {} as CanvasRenderingContext2D);

  it("holds what was drawn, with the pen of the moment", () => {
    const sheet = paper();
    sheet.strokeStyle = "#123456";
    sheet.setLineDash([5, 4]);
    sheet.beginPath();
    sheet.moveTo(1, 2);
    sheet.lineTo(3.1459, 4);
    sheet.stroke();
    assert.match(sheet.text, /<path d="M1 2L3.15 4" fill="none" stroke="#123456" stroke-width="1" stroke-dasharray="5 4"\/>/);
  });

  it("ends what restore ends: style and clip", () => {
    const sheet = paper();
    sheet.save();
    sheet.fillStyle = "red";
    sheet.beginPath();
    sheet.rect(0, 0, 10, 10);
    sheet.clip();
    sheet.restore();
    sheet.fillRect(0, 0, 1, 1);
    assert.match(sheet.text, /<g clip-path="url\(#c0\)"><\/g><rect [^>]*fill="#000"\/><\/svg>/);
  });

  it("takes words as words", () => {
    const sheet = paper();
    sheet.fillText("</svg><script>&", 0, 0);
    assert.ok(sheet.text.includes("&lt;/svg&gt;&lt;script&gt;&amp;</text>"));
  });
});

describe("Since when a buoy is gone", () => {
  const frame = (step: number, flags: number): ReturnType<typeof decodeFrame> => decodeFrame(makeFrame({ step, flags: [flags, 2] }));

  it("is the step that the engine says", () => {
    assert.equal(goneSince({ events: [[20, "lost", 0]] }, frame(30, 0), 0, new Tape()), "not since step 20");
    assert.equal(goneSince({ events: [[40, "joined", 0]] }, frame(30, 0), 0, new Tape()), "not yet");
  });

  it("is between two frames where only they are known", () => {
    const tape = new Tape();
    for (const each of [frame(0, 2), frame(10, 2), frame(20, 0), frame(30, 0)]) tape.add(each);
    assert.equal(goneSince({ events: [] }, frame(30, 0), 0, tape), "not since steps 10 to 20");
  });
});
