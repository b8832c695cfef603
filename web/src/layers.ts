// What the view is made of, from the water up: each layer is one function that draws on the canvas.

import { ticks, type Camera } from "./camera";
import { fastestFleet, styleOf } from "./fleets";
import { fixed } from "./format";
import type { Pairs } from "./links";
import { COVERS, fleetColor, fleetMarker, lineColor, rimColor, TARGET_COLOR, traceMarker, type Theme } from "./palette";
import { isAlive, isOnTarget, isPresent, isSilent, type Frame, type Scene } from "./protocol";

/** One moment to draw: a frame, with positions that may lie between it and the one before. */
export interface Moment {
  scene: Scene;
  frame: Frame;
  x: Float32Array; // (N) [m]
  y: Float32Array;
  targetX: Float32Array; // (T) [m]
  targetY: Float32Array;
  past: Frame[]; // close to each other, oldest first, the shown one left out
  shown: Uint32Array; // agents that get a marker, in rising order
  dotted: boolean; // the others are too many for that, and dots
}

export interface Brush {
  context: CanvasRenderingContext2D;
  camera: Camera;
  theme: Theme;
}

const KILOMETERS_FROM = 2000; // [m] longer side from which axes count in km
const MANY = 500; // agents from which discs are not filled and trails have fewer corners, for the sake of speed
const TURN = 2 * Math.PI;

export function drawWater({ context, camera, theme }: Brush, scene: Scene): void {
  const { plot } = camera;
  context.fillStyle = theme.outside;
  context.fillRect(plot.left, plot.top, plot.width, plot.height);
  const edge = box(camera, scene.area.width / 2, scene.area.height / 2);
  context.fillStyle = theme.water;
  context.fillRect(...edge);
}

/** The edges of the arena, and how far agents may go. */
export function drawEdges({ context, camera, theme }: Brush, scene: Scene): void {
  const { width, height, half_x, half_y } = scene.area;
  const edge = box(camera, width / 2, height / 2);
  context.strokeStyle = theme.muted;
  context.lineWidth = 1.2;
  context.strokeRect(...edge);
  if (half_x < width / 2 || half_y < height / 2) {
    context.lineWidth = 1;
    context.setLineDash([5, 4]);
    context.strokeRect(...box(camera, half_x, half_y));
    context.setLineDash([]);
  }
}

export function drawAxes({ context, camera, theme }: Brush, scene: Scene, compact: boolean): void {
  const { plot } = camera;
  const { width, height } = scene.area;
  const [scale, unit] = Math.max(width, height) > KILOMETERS_FROM ? [1000, "km"] : [1, "m"];
  const right = plot.left + plot.width;
  const bottom = plot.top + plot.height;
  context.fillStyle = theme.muted;
  context.strokeStyle = theme.muted;
  context.lineWidth = 1;
  context.font = `${compact ? 10.5 : 11.5}px system-ui, sans-serif`;
  context.beginPath();
  const [west, east] = visible(camera.fromX(plot.left), camera.fromX(right), width / 2);
  const [south, north] = visible(camera.fromY(bottom), camera.fromY(plot.top), height / 2);
  const span = Math.max(east - west, north - south) / scale;
  const most = compact ? 5 : 8;
  const about = (extent: number): number => Math.max((most * extent) / scale / span, 2.5); // at least two, or they are no scale
  const across = ticks(west / scale, east / scale, about(east - west));
  const up = ticks(south / scale, north / scale, about(north - south));
  context.textAlign = "center";
  context.textBaseline = "top";
  for (const value of across.values) {
    const x = Math.round(camera.toX(value * scale)) + 0.5;
    context.moveTo(x, bottom);
    context.lineTo(x, bottom + 4);
    context.fillText(fixed(value, across.decimals), x, bottom + 7);
  }
  context.textAlign = "right";
  context.textBaseline = "middle";
  for (const value of up.values) {
    const y = Math.round(camera.toY(value * scale)) + 0.5;
    context.moveTo(plot.left, y);
    context.lineTo(plot.left - 4, y);
    context.fillText(fixed(value, up.decimals), plot.left - 7, y);
  }
  context.stroke();
  context.textAlign = "center";
  context.textBaseline = "alphabetic";
  context.fillText(`east [${unit}]`, plot.left + plot.width / 2, bottom + (compact ? 31 : 34));
  context.save();
  context.translate(plot.left - (compact ? 30 : 36), plot.top + plot.height / 2);
  context.rotate(-Math.PI / 2);
  context.fillText(`north [${unit}]`, 0, 0);
  context.restore();
}

export function drawTargets(brush: Brush, { scene, frame, targetX, targetY, past }: Moment): void {
  const { context, camera } = brush;
  context.strokeStyle = context.fillStyle = TARGET_COLOR;
  for (let target = 0; target < targetX.length; target++) {
    if (!isPresent(frame, target)) continue;
    const x = camera.toX(targetX[target]);
    const y = camera.toY(targetY[target]);
    context.lineWidth = 2.2;
    const track = past.filter((each) => isPresent(each, target)).map((each) => [each.targetX[target], each.targetY[target]]);
    drawFading(brush, [...track, [targetX[target], targetY[target]]], COVERS.track);
    const radius = scene.targets[target]?.radius * camera.scale;
    context.globalAlpha = 0.22;
    disc(context, x, y, radius);
    context.fill();
    context.globalAlpha = 1;
    context.lineWidth = 1.6;
    disc(context, x, y, radius);
    context.stroke();
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(x - 5, y);
    context.lineTo(x + 5, y);
    context.moveTo(x, y - 5);
    context.lineTo(x, y + 5);
    context.stroke();
  }
  context.globalAlpha = 1;
}

export function drawLinks({ context, camera, theme }: Brush, { x, y }: Moment, pairs: Pairs): void {
  context.strokeStyle = theme.muted;
  context.globalAlpha = Math.min(Math.max(120 / pairs.length, 0.16), COVERS.link); // a mesh must not hide the swarm
  context.lineWidth = 0.8;
  context.beginPath();
  for (let p = 0; p < pairs.length; p += 2) {
    context.moveTo(camera.toX(x[pairs[p]]), camera.toY(y[pairs[p]]));
    context.lineTo(camera.toX(x[pairs[p + 1]]), camera.toY(y[pairs[p + 1]]));
  }
  context.stroke();
  context.globalAlpha = 1;
}

export function drawSensors(brush: Brush, moment: Moment): void {
  drawDiscs(brush, moment, (_, fleet) => moment.scene.fleets[fleet].sensor_radius, [3, 3]);
}

export function drawHalos(brush: Brush, moment: Moment): void {
  drawDiscs(brush, moment, (agent) => moment.frame.repulsion[agent], []);
}

export function drawTrails({ context, camera, theme }: Brush, { scene, frame, x, y, past, shown }: Moment, size: number): void {
  context.lineWidth = lineWidth(size);
  const stride = shown.length > MANY ? Math.max(Math.ceil(past.length / 3), 1) : 1;
  forEachFleet(scene, shown, (fleet, agents) => {
    context.strokeStyle = lineColor(styleOf(scene.fleets[fleet]), theme, COVERS.trail);
    for (let age = stride; age <= past.length; age += stride) {
      const old = past[past.length - age];
      const next = age === stride ? { x, y } : past[past.length - age + stride];
      context.globalAlpha = COVERS.trail * (1 - (age - 1) / past.length) ** 1.5 + 0.03;
      context.beginPath();
      for (const agent of agents) {
        if (!isAlive(frame, agent) || !isAlive(old, agent)) continue;
        context.moveTo(camera.toX(old.x[agent]), camera.toY(old.y[agent]));
        context.lineTo(camera.toX(next.x[agent]), camera.toY(next.y[agent]));
      }
      context.stroke();
    }
  });
  context.globalAlpha = 1;
}

export function drawHeadings({ context, camera, theme }: Brush, { scene, frame, x, y, shown }: Moment, size: number): void {
  if (frame.lean) return;
  context.lineWidth = lineWidth(size);
  forEachFleet(scene, shown, (fleet, agents) => {
    const reach = (2.6 * size) / scene.fleets[fleet].max_speed;
    context.strokeStyle = lineColor(styleOf(scene.fleets[fleet]), theme);
    context.beginPath();
    for (const agent of agents) {
      if (!isAlive(frame, agent)) continue;
      const speed = Math.hypot(frame.vx[agent], frame.vy[agent]);
      if (speed === 0) continue;
      const length = reach + size / speed; // from the marker's middle, past its rim
      const px = camera.toX(x[agent]);
      const py = camera.toY(y[agent]);
      context.moveTo(px, py);
      context.lineTo(px + frame.vx[agent] * length, py - frame.vy[agent] * length);
    }
    context.stroke();
  });
}

export function drawAgents({ context, camera, theme }: Brush, { scene, frame, x, y, shown }: Moment, size: number): void {
  forEachFleet(scene, shown, (fleet, agents) => {
    const radius = size * fleetSize(scene, fleet);
    const marker = fleetMarker(styleOf(scene.fleets[fleet]));
    context.fillStyle = fleetColor(styleOf(scene.fleets[fleet]));
    for (const onTarget of [false, true]) {
      context.beginPath();
      for (const agent of agents) {
        if (!isAlive(frame, agent) || isSilent(frame, agent) || isOnTarget(frame, agent) !== onTarget) continue;
        traceMarker(context, marker, camera.toX(x[agent]), camera.toY(y[agent]), radius * (onTarget ? 1.2 : 1));
      }
      context.fill();
      context.strokeStyle = onTarget ? theme.ink : rimColor(styleOf(scene.fleets[fleet]), theme);
      context.lineWidth = onTarget ? Math.max(1.4, size / 2.6) : Math.max(0.6, size / 6);
      context.lineJoin = "miter";
      context.stroke();
    }
    context.beginPath();
    for (const agent of agents) {
      if (!isAlive(frame, agent) || !isSilent(frame, agent)) continue;
      traceMarker(context, marker, camera.toX(x[agent]), camera.toY(y[agent]), radius);
    }
    context.fillStyle = theme.water;
    context.fill();
    context.strokeStyle = lineColor(styleOf(scene.fleets[fleet]), theme);
    context.lineWidth = Math.max(1.4, size / 4);
    context.stroke();
  });
  drawGone({ context, camera, theme }, { frame, x, y, shown }, Math.max(size * 0.7, 2.5));
}

type Places = Pick<Moment, "frame" | "x" | "y" | "shown">;

function drawGone({ context, camera, theme }: Brush, { frame, x, y, shown }: Places, r: number): void {
  context.strokeStyle = theme.muted;
  context.globalAlpha = COVERS.gone;
  context.lineWidth = 1.5;
  context.beginPath();
  for (const agent of shown) {
    if (isAlive(frame, agent)) continue;
    const px = camera.toX(x[agent]);
    const py = camera.toY(y[agent]);
    context.moveTo(px - r, py - r);
    context.lineTo(px + r, py + r);
    context.moveTo(px - r, py + r);
    context.lineTo(px + r, py - r);
  }
  context.stroke();
  context.globalAlpha = 1;
}

/** A ring around one agent, and lines to those that it hears. */
export function drawPicked({ context, camera, theme }: Brush, { x, y }: Moment, agent: number, heard: Pairs, size: number): void {
  context.strokeStyle = theme.ink;
  context.globalAlpha = COVERS.link;
  context.lineWidth = 1;
  context.beginPath();
  for (let p = 0; p < heard.length; p += 2) {
    context.moveTo(camera.toX(x[heard[p]]), camera.toY(y[heard[p]]));
    context.lineTo(camera.toX(x[heard[p + 1]]), camera.toY(y[heard[p + 1]]));
  }
  context.stroke();
  context.globalAlpha = 1;
  context.lineWidth = 2;
  disc(context, camera.toX(x[agent]), camera.toY(y[agent]), size + 5);
  context.stroke();
}

/** The keyboard's pointer, or where a target will be put. */
export function drawCrosshair({ context, camera, theme }: Brush, at: { x: number; y: number }): void {
  const px = camera.toX(at.x);
  const py = camera.toY(at.y);
  context.beginPath();
  for (const [dx, dy] of [
    [1, 0],
    [-1, 0],
    [0, 1],
    [0, -1],
  ]) {
    context.moveTo(px + 4 * dx, py + 4 * dy);
    context.lineTo(px + 14 * dx, py + 14 * dy);
  }
  for (const [color, width] of [
    [theme.water, 5],
    [theme.ink, 2],
  ] as const) {
    context.strokeStyle = color;
    context.lineWidth = width;
    context.stroke();
  }
}

/** How big the marker of a fleet is beside that of the fastest: like its square root of speed, within reason. */
export function fleetSize(scene: Scene, fleet: number): number {
  return Math.max(Math.sqrt(scene.fleets[fleet].max_speed / fastestFleet().max_speed), 0.72);
}

/** Fleet of an agent: agents are numbered in the order of the fleets. */
export function fleetOf(scene: Scene, agent: number): number {
  let end = 0;
  for (let fleet = 0; fleet < scene.fleets.length; fleet++) {
    end += scene.fleets[fleet].count;
    if (agent < end) return fleet;
  }
  return scene.fleets.length - 1;
}

/** Visit the shown agents of each fleet. */
function forEachFleet(scene: Scene, shown: Uint32Array, visit: (fleet: number, agents: Uint32Array) => void): void {
  let [begin, last] = [0, 0];
  scene.fleets.forEach((each, fleet) => {
    last += each.count;
    let end = begin;
    while (end < shown.length && (shown[end] < last || fleet === scene.fleets.length - 1)) end++;
    visit(fleet, shown.subarray(begin, end));
    begin = end;
  });
}

/** A disc around each living agent, of a radius [m]; overlapping ones do not add up. */
function drawDiscs(
  { context, camera, theme }: Brush,
  { scene, frame, x, y, shown }: Moment,
  radius: (agent: number, fleet: number) => number,
  dash: number[],
): void {
  forEachFleet(scene, shown, (fleet, agents) => {
    context.beginPath();
    for (const agent of agents) {
      const meters = radius(agent, fleet);
      if (!isAlive(frame, agent) || !(meters > 0)) continue;
      const r = meters * camera.scale;
      const px = camera.toX(x[agent]);
      const py = camera.toY(y[agent]);
      context.moveTo(px + r, py);
      context.arc(px, py, r, 0, TURN);
    }
    context.fillStyle = context.strokeStyle = lineColor(styleOf(scene.fleets[fleet]), theme, COVERS.disc);
    context.globalAlpha = theme.dark ? 0.16 : 0.1;
    if (shown.length <= MANY) context.fill();
    context.globalAlpha = shown.length <= MANY ? COVERS.disc : 0.4;
    context.lineWidth = 0.9;
    context.setLineDash(dash);
    context.stroke();
    context.setLineDash([]);
  });
  context.globalAlpha = 1;
}

function drawFading({ context, camera }: Brush, points: number[][], strongest: number): void {
  for (let n = 1; n < points.length; n++) {
    context.globalAlpha = strongest * (n / points.length) ** 1.3;
    context.beginPath();
    context.moveTo(camera.toX(points[n - 1][0]), camera.toY(points[n - 1][1]));
    context.lineTo(camera.toX(points[n][0]), camera.toY(points[n][1]));
    context.stroke();
  }
}

/** Lines up to 1 px wide are drawn several times faster than wider ones: very many agents get those. */
function lineWidth(size: number): number {
  return size < 3 ? 1 : Math.max(1.3, size / 3.5);
}

function disc(context: CanvasRenderingContext2D, x: number, y: number, radius: number): void {
  context.beginPath();
  context.arc(x, y, radius, 0, TURN);
}

function box(camera: Camera, halfX: number, halfY: number): [number, number, number, number] {
  const left = Math.round(camera.toX(-halfX)) + 0.5;
  const top = Math.round(camera.toY(halfY)) + 0.5;
  return [left, top, Math.round(2 * halfX * camera.scale), Math.round(2 * halfY * camera.scale)];
}

function visible(low: number, high: number, half: number): [number, number] {
  return [Math.max(low, -half), Math.min(high, half)];
}
