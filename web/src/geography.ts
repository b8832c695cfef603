// Where on Earth the water is: land, latitude and longitude, currents, a scale, north. The engine sends what is known of it.

import { fixed, short } from "./format";
import type { Brush } from "./layers";
import type { Theme } from "./palette";
import type { Earth, Geography, Scene } from "./protocol";

const SHORTEST_BAR = 0.14; // of the plot's width
const APART = { x: 74, y: 30 }; // [px] between the words of meridians, of parallels
const HEADS = 3.2; // [px] of arrows

/** Land in its shore, and where the search area ends. */
export function drawLand({ context, camera, theme }: Brush, { land, limits, cells }: Geography): void {
  const trace = (ring: number[]): void => {
    for (let n = 0; n + 1 < ring.length; n += 2) {
      if (n === 0) context.moveTo(camera.toX(ring[n]!), camera.toY(ring[n + 1]!));
      else context.lineTo(camera.toX(ring[n]!), camera.toY(ring[n + 1]!));
    }
    context.closePath();
  };
  context.fillStyle = theme.land;
  context.strokeStyle = theme.shore;
  context.lineJoin = "round";
  context.lineWidth = 1.2;
  context.beginPath();
  for (const [x, y, width, height] of cells as [number, number, number, number][]) {
    context.rect(camera.toX(x), camera.toY(y + height), width * camera.scale + 0.5, height * camera.scale + 0.5);
  }
  context.fill();
  context.beginPath();
  land.forEach(trace);
  context.fill("evenodd"); // holes are water
  context.stroke();
  context.beginPath();
  limits.forEach(trace);
  context.setLineDash([7, 4]);
  context.stroke();
  context.setLineDash([]);
}

/** Meridians and parallels, with their degrees at the edges of what is seen. */
export function drawGraticule({ context, camera, theme }: Brush, { lines }: Earth): void {
  const { plot } = camera;
  context.strokeStyle = theme.muted;
  context.fillStyle = theme.muted;
  context.lineWidth = 0.7;
  context.setLineDash([1, 4]);
  context.beginPath();
  for (const { x, y } of lines) {
    for (const [n, each] of x.entries()) {
      if (n === 0) context.moveTo(camera.toX(each), camera.toY(y[n]!));
      else context.lineTo(camera.toX(each), camera.toY(y[n]!));
    }
  }
  context.stroke();
  context.setLineDash([]);
  context.font = "10.5px system-ui, sans-serif";
  context.textBaseline = "bottom";
  const beside = plot.left + 30 + scaleBar((plot.width * SHORTEST_BAR) / camera.scale).meters * camera.scale;
  const written: { meridian: boolean; at: number }[] = [];
  for (const { words, meridian, x, y } of lines) {
    const along = x.map((each, n) => [camera.toX(each), camera.toY(y[n]!)] as const);
    const inside = along.filter(([px, py]) => px > plot.left + 4 && px < plot.left + plot.width - 4 && py > plot.top + 14 && py < plot.top + plot.height - 4);
    const ends = meridian
      ? inside.reduce((a, b) => (b[1] > a[1] ? b : a), inside[0] ?? [NaN, NaN])
      : inside.reduce((a, b) => (b[0] > a[0] ? b : a), inside[0] ?? [NaN, NaN]);
    if (Number.isNaN(ends[0])) continue;
    const at = meridian ? ends[0] : ends[1];
    if (meridian ? at < beside : at < plot.top + 48) continue; // there are the scale and north
    if (written.some((each) => each.meridian === meridian && Math.abs(each.at - at) < (meridian ? APART.x : APART.y))) continue;
    written.push({ meridian, at });
    context.textAlign = meridian ? "left" : "right";
    label(context, theme.water, words, ends[0] + (meridian ? 3 : -3), ends[1] - 2);
  }
}

/** The current at a time [s]: the longest arrow fills its square. */
export function drawCurrents({ context, camera, theme }: Brush, geography: Geography, time: number): void {
  const { currents } = geography;
  if (!currents) return;
  const { places, values, apart } = currents;
  const [row, next, share] = momentOf(currents.times, currents.period, time);
  const arrows = places.length / 2;
  context.strokeStyle = context.fillStyle = theme.current;
  context.lineWidth = 1.1;
  context.beginPath();
  for (let n = 0; n < arrows; n++) {
    const part = (axis: 0 | 1): number => {
      const at = (step: number): number => values[2 * (step * arrows + n) + axis]!;
      return ((1 - share) * at(row) + share * at(next)) / 100;
    };
    const [u, v] = [part(0), part(1)];
    const length = Math.hypot(u, v) * 0.8 * apart * camera.scale;
    if (length < 2) continue;
    const turn = Math.atan2(-v, u);
    const [dx, dy] = [(Math.cos(turn) * length) / 2, (Math.sin(turn) * length) / 2];
    const [x, y] = [camera.toX(places[2 * n]!), camera.toY(places[2 * n + 1]!)];
    context.moveTo(x - dx, y - dy);
    context.lineTo(x + dx, y + dy);
    for (const side of [2.6, -2.6]) {
      context.moveTo(x + dx, y + dy);
      context.lineTo(x + dx + HEADS * Math.cos(turn + side), y + dy + HEADS * Math.sin(turn + side));
    }
  }
  context.stroke();
}

/** The rows between which a time lies, and how far from the first: flows of a tide come again, others hold still at their ends. */
export function momentOf(times: number[], period: number | null, time: number): [row: number, next: number, share: number] {
  const at = period === null ? time : time - Math.floor(time / period) * period;
  let next = times.findIndex((each) => each > at);
  if (next === -1) next = times.length - 1;
  const row = Math.max(next - 1, 0);
  const span = times[next]! - times[row]!;
  return [row, next, span > 0 ? Math.min(Math.max((at - times[row]!) / span, 0), 1) : 0];
}

/** A bar of a round length, and north where the place on Earth is known. */
export function drawScale({ context, camera, theme }: Brush, scene: Scene): void {
  const { plot } = camera;
  const { meters, words } = scaleBar((plot.width * SHORTEST_BAR) / camera.scale);
  const length = meters * camera.scale;
  const left = Math.max(plot.left, camera.toX(-scene.area.width / 2)) + 10;
  const bottom = Math.min(plot.top + plot.height, camera.toY(-scene.area.height / 2)) - 9;
  context.font = "11px system-ui, sans-serif";
  context.lineWidth = 1.6;
  context.strokeStyle = theme.ink;
  context.beginPath();
  context.moveTo(left, bottom - 4);
  context.lineTo(left, bottom);
  context.lineTo(left + length, bottom);
  context.lineTo(left + length, bottom - 4);
  context.stroke();
  context.fillStyle = theme.ink;
  context.textAlign = "center";
  context.textBaseline = "bottom";
  label(context, theme.water, words, left + length / 2, bottom - 4);
  const right = Math.min(plot.left + plot.width, camera.toX(scene.area.width / 2)) - 14;
  const top = Math.max(plot.top, camera.toY(scene.area.height / 2)) + 9;
  if (scene.geography?.earth) drawNorth(context, theme, right, top);
}

/** The shortest round length that is no shorter, in words. */
export function scaleBar(least: number): { meters: number; words: string } {
  const power = 10 ** Math.floor(Math.log10(least));
  const meters = power * ([1, 2, 5, 10].find((digit) => digit * power >= 0.999 * least) ?? 10);
  return { meters, words: meters >= 1000 ? `${short(meters / 1000)} km` : `${short(meters)} m` };
}

/** Longitude and latitude [deg] of a place [m], by the polynomials of the engine. */
export function onEarth(earth: Earth, x: number, y: number): { lon: number; lat: number } {
  const [u, v] = [x / earth.size, y / earth.size];
  let [lon, lat, n] = [0, 0, 0];
  for (let i = 0; i <= 4; i++) {
    for (let j = 0; j <= 4 - i; j++, n++) {
      const power = u ** i * v ** j;
      lon += earth.lon[n]! * power;
      lat += earth.lat[n]! * power;
    }
  }
  return { lon: ((((lon + 180) % 360) + 360) % 360) - 180, lat };
}

/** 45°03.217′N: as navigators write it, to so many decimals of a minute. */
export function degrees(value: number, letters: "EW" | "NS", decimals: number): string {
  const minutes = Number((Math.abs(value) * 60).toFixed(decimals));
  const whole = Math.floor(minutes / 60);
  const rest = (minutes - 60 * whole).toFixed(decimals);
  return `${whole}°${rest.padStart(decimals ? decimals + 3 : 2, "0")}′${letters[value < 0 ? 1 : 0]}`;
}

/** A place in words, as finely as a pixel [m] tells: local meters, then where that is on Earth. */
export function placeWords(scene: Scene, x: number, y: number, pixel: number): string {
  const far = Math.max(scene.area.width, scene.area.height) > 2000;
  const digits = Math.max(0, Math.ceil(-Math.log10(far ? pixel / 1000 : pixel)));
  const meters = (value: number): string => fixed(far ? value / 1000 : value, digits);
  const local = `${meters(x)}, ${meters(y)} ${far ? "km" : "m"}`;
  const earth = scene.geography?.earth;
  if (!earth) return local;
  const { lon, lat } = onEarth(earth, x, y);
  const decimals = Math.min(Math.max(0, Math.ceil(-Math.log10(pixel / 1852))), 5);
  return `${degrees(lat, "NS", decimals)} ${degrees(lon, "EW", decimals)} · ${local}`;
}

function drawNorth(context: CanvasRenderingContext2D, theme: Theme, x: number, top: number): void {
  context.fillStyle = theme.ink;
  context.beginPath();
  context.moveTo(x, top);
  context.lineTo(x + 5, top + 13);
  context.lineTo(x, top + 9.5);
  context.lineTo(x - 5, top + 13);
  context.fill();
  context.font = "600 11px system-ui, sans-serif";
  context.textAlign = "center";
  context.textBaseline = "top";
  label(context, theme.water, "N", x, top + 15);
}

function label(context: CanvasRenderingContext2D, around: string, words: string, x: number, y: number): void {
  context.lineJoin = "round";
  context.lineWidth = 3;
  context.strokeStyle = around;
  context.strokeText(words, x, y);
  context.fillText(words, x, y);
}
