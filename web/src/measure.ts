// A distance and a bearing between two points, picked on the water and drawn there.

import type { Brush } from "./layers";
import type { Point } from "./stage";

/** Distance [m] and compass bearing [deg] from one point to another: 0 is north, 90 is east. */
export function between(from: Point, to: Point): { distance: number; bearing: number } {
  const [east, north] = [to.x - from.x, to.y - from.y];
  return { distance: Math.hypot(east, north), bearing: ((Math.atan2(east, north) * 180) / Math.PI + 360) % 360 };
}

/** 1.24 km · 045° */
export function measured(from: Point, to: Point): string {
  const { distance, bearing } = between(from, to);
  const far = distance >= 1000 ? `${Number((distance / 1000).toPrecision(4))} km` : `${Number(distance.toPrecision(4))} m`;
  return `${far} · ${String(Math.round(bearing) % 360).padStart(3, "0")}°`;
}

/** Two points that are picked one after the other, or by a drag. */
export class Ruler {
  ends: [Point, Point] | null = null;
  private open = false; // the second end follows the pointer

  press(at: Point): void {
    if (this.open && this.ends) this.ends[1] = at;
    else this.ends = [at, at];
    this.open = !this.open;
  }

  move(at: Point): void {
    if (this.open && this.ends) this.ends[1] = at;
  }

  /** The pointer is let go: a drag ends there. */
  release(): void {
    if (this.ends && between(...this.ends).distance > 0) this.open = false;
  }

  clear(): void {
    this.ends = null;
    this.open = false;
  }

  get words(): string {
    return this.ends ? measured(...this.ends) : "";
  }

  draw({ context, camera, theme }: Brush): void {
    if (!this.ends) return;
    const [[ax, ay], [bx, by]] = this.ends.map(({ x, y }) => [camera.toX(x), camera.toY(y)]) as [[number, number], [number, number]];
    for (const [color, width] of [
      [theme.water, 5],
      [theme.ink, 1.6],
    ] as const) {
      context.strokeStyle = color;
      context.lineWidth = width;
      context.beginPath();
      context.moveTo(ax, ay);
      context.lineTo(bx, by);
      for (const [x, y] of [
        [ax, ay],
        [bx, by],
      ]) {
        context.moveTo(x + 4, y);
        context.arc(x, y, 4, 0, 2 * Math.PI);
      }
      context.stroke();
    }
    const { words } = this;
    context.font = "600 12px system-ui, sans-serif";
    context.textAlign = "center";
    context.textBaseline = "middle";
    const [x, y, width] = [(ax + bx) / 2, (ay + by) / 2 - 14, context.measureText(words).width + 12];
    context.fillStyle = theme.outside;
    context.fillRect(x - width / 2, y - 10, width, 20);
    context.fillStyle = theme.ink;
    context.fillText(words, x, y);
  }
}
