// The bars of phi, on a canvas.

import { ticks } from "./camera";
import { fixed, short } from "./format";
import type { Theme } from "./palette";

interface Plot {
  context: CanvasRenderingContext2D;
  left: number;
  right: number;
  top: number;
  bottom: number;
}

const FONT = "10.5px system-ui, sans-serif";

/** Bars of phi: how many agents head away from the target (-1), across or nowhere (0), toward it (+1). */
export function drawPhi(canvas: HTMLCanvasElement, theme: Theme, runs: { phi: Float32Array; color: string }[]): void {
  const plot = begin(canvas, 30, 30);
  const { context, left, right, top, bottom } = plot;
  const most = 1.08 * runs.reduce((high, { phi }) => Math.max(high, highest(phi)), 1);
  const toY = (value: number): number => bottom - (value / most) * (bottom - top);
  const toX = (phi: number): number => left + ((phi + 1) / 2) * (right - left);
  drawGrid(plot, theme, most, toY);
  runs.forEach(({ phi, color }, run) => {
    context.fillStyle = context.strokeStyle = color;
    for (let bin = 0; bin < phi.length; bin++) {
      const center = -1 + (2 * bin) / (phi.length - 1);
      const half = 1 / (phi.length - 1);
      const from = toX(Math.max(center - half, -1)) + 0.75; // the outer two are half as wide
      const width = toX(Math.min(center + half, 1)) - 0.75 - from;
      const height = bottom - toY(phi[bin]);
      if (!(height > 0)) continue;
      if (run === 0) {
        context.globalAlpha = runs.length > 1 ? 0.55 : 0.9;
        context.fillRect(from, bottom - height, width, height);
        context.globalAlpha = 1;
      } else {
        context.lineWidth = 2;
        context.strokeRect(from + 1, bottom - height + 1, width - 2, Math.max(height - 1, 0));
      }
    }
  });
  context.fillStyle = theme.muted;
  context.textBaseline = "top";
  for (const [phi, align, words] of [
    [-1, "left", "away"],
    [0, "center", right - left > 190 ? "still or across" : "still"],
    [1, "right", "toward"],
  ] as const) {
    context.textAlign = align;
    context.fillText(phi === 1 ? "+1" : fixed(phi, 0), toX(phi), bottom + 4);
    context.fillText(words, toX(phi), bottom + 16);
  }
}

function begin(canvas: HTMLCanvasElement, left: number, below: number): Plot {
  const ratio = Math.min(devicePixelRatio || 1, 2);
  const { clientWidth: width, clientHeight: height } = canvas;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const context = canvas.getContext("2d")!;
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  context.font = FONT;
  return { context, left, right: width - 4, top: 7, bottom: height - below };
}

function drawGrid({ context, left, right }: Plot, theme: Theme, most: number, toY: (value: number) => number): void {
  context.lineWidth = 1;
  context.strokeStyle = theme.line;
  context.fillStyle = theme.muted;
  context.textAlign = "right";
  context.textBaseline = "middle";
  context.beginPath();
  for (const value of ticks(0, most, 2.5).values) {
    const y = Math.round(toY(value)) + 0.5;
    context.moveTo(left, y);
    context.lineTo(right, y);
    context.fillText(value < 10_000 ? short(value) : `${short(value / 1000)}k`, left - 5, y);
  }
  context.stroke();
}

function highest(values: ArrayLike<number>): number {
  let high = -Infinity;
  for (let n = 0; n < values.length; n++) if (values[n] > high) high = values[n];
  return high;
}
