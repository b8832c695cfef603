// Very many agents: those in view get markers while they are few; beyond, each is a dot in one picture.

import type { Camera } from "./camera";
import { styleOf } from "./fleets";
import { lineColor, type Theme } from "./palette";
import { isAlive, isOnTarget, type Frame, type Scene } from "./protocol";

export const MARKED = 2000; // agents in view that markers can be drawn for, many times a second
const EDGE = 12; // [px] around the view in which a marker may still be seen
const COVER = 0.75; // of what is under a dot is hidden by it, so that more are darker

type Places = Pick<Frame, "x" | "y">;

/** The agents in view, in rising order; null where they are too many for markers. */
export function inView(camera: Camera, { x, y }: Places): Uint32Array | null {
  const { plot } = camera;
  const [west, east] = [camera.fromX(plot.left - EDGE), camera.fromX(plot.left + plot.width + EDGE)];
  const [south, north] = [camera.fromY(plot.top + plot.height + EDGE), camera.fromY(plot.top - EDGE)];
  const found: number[] = [];
  for (let agent = 0; agent < x.length; agent++) {
    if (x[agent] < west || x[agent] > east || y[agent] < south || y[agent] > north) continue;
    if (found.push(agent) > MARKED) return null;
  }
  return Uint32Array.from(found);
}

/** Of too many agents, those that get a marker all the same: the ones that report a target. */
export function reporting(frame: Frame): Uint32Array {
  const found: number[] = [];
  for (let agent = 0; agent < frame.flags.length && found.length < MARKED; agent++) {
    if (isOnTarget(frame, agent) && isAlive(frame, agent)) found.push(agent);
  }
  return Uint32Array.from(found);
}

/** Draws a dot per agent. */
export class Dots {
  private readonly canvas = document.createElement("canvas");

  draw(context: CanvasRenderingContext2D, camera: Camera, ratio: number, scene: Scene, frame: Frame, theme: Theme): void {
    const { plot, scale } = camera;
    const [width, height] = [Math.round(plot.width * ratio), Math.round(plot.height * ratio)];
    this.canvas.width = width;
    this.canvas.height = height;
    const brush = this.canvas.getContext("2d")!;
    const image = brush.createImageData(width, height);
    const side = dotSide(width * height, frame.x.length);
    const [left, top] = [ratio * (camera.toX(0) - plot.left), ratio * (camera.toY(0) - plot.top)];
    let [fleet, end] = [-1, 0];
    let color = [0, 0, 0];
    const gone = rgb(theme.muted);
    for (let agent = 0; agent < frame.x.length; agent++) {
      while (agent >= end && fleet < scene.fleets.length - 1) {
        end += scene.fleets[++fleet].count;
        color = rgb(lineColor(styleOf(scene.fleets[fleet]), theme));
      }
      const column = Math.floor(left + ratio * scale * frame.x[agent]);
      const row = Math.floor(top - ratio * scale * frame.y[agent]);
      dot(image, column, row, side, isAlive(frame, agent) ? color : gone);
    }
    brush.putImageData(image, 0, 0);
    context.drawImage(this.canvas, plot.left, plot.top, plot.width, plot.height);
  }
}

/** Pixels of a dot's side: as large as leaves most of the water free, 3 at most. */
export function dotSide(pixels: number, agents: number): number {
  return Math.min(Math.max(Math.round(Math.sqrt((0.3 * pixels) / agents)), 1), 3);
}

function dot({ data, width, height }: ImageData, column: number, row: number, side: number, color: number[]): void {
  for (let y = Math.max(row, 0); y < Math.min(row + side, height); y++) {
    for (let x = Math.max(column, 0); x < Math.min(column + side, width); x++) {
      const at = 4 * (y * width + x);
      const cover = data[at + 3] === 0 ? 1 : COVER;
      for (let n = 0; n < 3; n++) data[at + n] += cover * (color[n] - data[at + n]);
      data[at + 3] += COVER * (255 - data[at + 3]);
    }
  }
}

function rgb(color: string): number[] {
  return [1, 3, 5].map((at) => parseInt(color.slice(at, at + 2), 16));
}
