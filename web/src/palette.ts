// One palette for canvas and page, that of shoal's figures (src/shoal/drawing/style.py): Okabe and Ito, 2008.

import { contrast, LEAST, standsOut } from "./contrast";
import { svg } from "./dom";

export const FLEET_COLORS = ["#0072B2", "#56B4E9", "#009E73", "#CC79A7", "#F0E442", "#E69F00", "#000000"];
export const TARGET_COLOR = "#D55E00"; // for targets and time on them alone
const MARKERS = ["circle", "triangle", "square", "diamond", "wedge", "plus", "cross", "hexagon"] as const;

type Marker = (typeof MARKERS)[number];

/** What the page's style sheet says for the theme that is on. */
export interface Theme {
  dark: boolean;
  ink: string;
  muted: string;
  line: string;
  water: string;
  outside: string;
  rim: string; // around markers
  land: string;
  shore: string;
  current: string;
  secondRun: string;
}

export function readTheme(): Theme {
  const style = getComputedStyle(document.documentElement);
  const value = (name: string): string => style.getPropertyValue(`--${name}`).trim();
  return {
    dark: value("dark") === "1",
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
}

export const fleetColor = (fleet: number): string => FLEET_COLORS[fleet % FLEET_COLORS.length];
/** How much of the water the strongest of these marks covers; with more of them they are weaker. */
export const COVERS = { link: 0.8, trail: 0.85, disc: 0.8, gone: 0.85, track: 0.9 };

/** Color of a fleet's lines, so that they are seen on the water; `covers`: see COVERS. */
export const lineColor = (fleet: number, theme: Theme, covers = 1): string => standsOut(fleetColor(fleet), theme.water, covers);

/** Around a fleet's markers: the theme's rim, or a darker shade of the fleet's own color where that is what is seen. */
export function rimColor(fleet: number, theme: Theme): string {
  const seen = contrast(theme.rim, theme.water) >= LEAST || contrast(fleetColor(fleet), theme.water) >= LEAST;
  return seen ? theme.rim : lineColor(fleet, theme);
}

export const fleetMarker = (fleet: number): Marker => MARKERS[fleet % MARKERS.length];

type Point = readonly [number, number];

const ring = (corners: number, radius: number, turn: number): Point[] =>
  Array.from({ length: corners }, (_, n) => {
    const angle = turn + (2 * Math.PI * n) / corners;
    return [radius * Math.sin(angle), -radius * Math.cos(angle)];
  });

const plus = (turn: number): Point[] =>
  [
    [-1, -3],
    [1, -3],
    [1, -1],
    [3, -1],
    [3, 1],
    [1, 1],
    [1, 3],
    [-1, 3],
    [-1, 1],
    [-3, 1],
    [-3, -1],
    [-1, -1],
  ].map(([x, y]) => [0.4 * (x * Math.cos(turn) - y * Math.sin(turn)), 0.4 * (x * Math.sin(turn) + y * Math.cos(turn))]);

/** Corners of each marker about (0, 0), y down, sized to look as big as a disc of radius 1; a circle has none. */
const CORNERS: Record<Marker, Point[]> = {
  circle: [],
  triangle: ring(3, 1.4, 0),
  square: ring(4, 1.3, Math.PI / 4),
  diamond: ring(4, 1.35, 0),
  wedge: ring(3, 1.4, Math.PI),
  plus: plus(0),
  cross: plus(Math.PI / 4),
  hexagon: ring(6, 1.15, 0),
};

/** Add the outline of a marker to the path of a canvas. */
export function traceMarker(context: CanvasRenderingContext2D, marker: Marker, x: number, y: number, r: number): void {
  const corners = CORNERS[marker];
  if (corners.length === 0) {
    context.moveTo(x + r, y);
    context.arc(x, y, r, 0, 2 * Math.PI);
    return;
  }
  context.moveTo(x + r * corners[0][0], y + r * corners[0][1]);
  for (let n = 1; n < corners.length; n++) context.lineTo(x + r * corners[n][0], y + r * corners[n][1]);
  context.closePath();
}

/** The marker of a fleet as a picture for legends. */
export function fleetGlyph(fleet: number): SVGElement {
  const corners = CORNERS[fleetMarker(fleet)];
  const shape = corners.length === 0 ? svg("circle", { r: 5 }) : svg("polygon", { points: corners.map(([x, y]) => `${5 * x},${5 * y}`).join(" ") });
  return glyph("fleet", fleetColor(fleet), shape);
}

/** A picture for legends, drawn about (0, 0) within 8 units. */
export function glyph(kind: string, color: string, ...shapes: SVGElement[]): SVGElement {
  return svg("svg", { class: `glyph ${kind}`, viewBox: "-8 -8 16 16", "aria-hidden": "true", color }, ...shapes);
}
