// From meters to pixels: the part of the area that is seen, and the ticks along it.

export interface Box {
  left: number;
  top: number;
  width: number;
  height: number;
}

interface Size {
  width: number;
  height: number;
}

const PAD = 0.025; // of the area's longer side, around it
const MOST_ZOOM = 60;

/** An area [m] with the little around it that is seen, too. */
export function padded({ width, height }: Size): Size {
  const pad = 2 * PAD * Math.max(width, height);
  return { width: width + pad, height: height + pad };
}

export class Camera {
  /** Where on the canvas the water is seen [px]. */
  plot: Box = { left: 0, top: 0, width: 1, height: 1 };
  scale = 1; // [px/m]
  private zoom = 1;
  private x = 0; // [m], in the middle of the plot
  private y = 0;
  private area: Size = { width: 1, height: 1 };

  /** Fit an area [m] into a canvas [px], inside margins for the axes. */
  fit(area: Size, canvas: Size, margins: { left: number; right: number; top: number; bottom: number }): void {
    const seen = padded(area);
    const room = {
      width: Math.max(canvas.width - margins.left - margins.right, 20),
      height: Math.max(canvas.height - margins.top - margins.bottom, 20),
    };
    const fitted = Math.min(room.width / seen.width, room.height / seen.height);
    const width = seen.width * fitted;
    const height = seen.height * fitted;
    this.plot = {
      left: Math.round(margins.left + (room.width - width) / 2),
      top: margins.top,
      width: Math.round(width),
      height: Math.round(height),
    };
    this.area = seen;
    this.scale = fitted * this.zoom;
    this.keepInside();
  }

  get zoomed(): boolean {
    return this.zoom > 1;
  }

  toX = (x: number): number => this.plot.left + this.plot.width / 2 + (x - this.x) * this.scale;
  toY = (y: number): number => this.plot.top + this.plot.height / 2 - (y - this.y) * this.scale;
  fromX = (px: number): number => this.x + (px - this.plot.left - this.plot.width / 2) / this.scale;
  fromY = (py: number): number => this.y - (py - this.plot.top - this.plot.height / 2) / this.scale;

  /** Come nearer by a factor; what is at (px, py) stays there. */
  zoomBy(factor: number, px = this.toX(this.x), py = this.toY(this.y)): void {
    const [x, y] = [this.fromX(px), this.fromY(py)];
    const zoom = Math.min(Math.max(this.zoom * factor, 1), MOST_ZOOM);
    this.scale *= zoom / this.zoom;
    this.zoom = zoom;
    this.x += x - this.fromX(px);
    this.y += y - this.fromY(py);
    this.keepInside();
  }

  pan(dx: number, dy: number): void {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
    this.keepInside();
  }

  /** Put a point [m] in the middle, as far as the area reaches. */
  lookAt(x: number, y: number): void {
    [this.x, this.y] = [x, y];
    this.keepInside();
  }

  reset(): void {
    this.zoomBy(0);
  }

  private keepInside(): void {
    const slackX = Math.max(this.area.width - this.plot.width / this.scale, 0) / 2;
    const slackY = Math.max(this.area.height - this.plot.height / this.scale, 0) / 2;
    this.x = Math.min(Math.max(this.x, -slackX), slackX);
    this.y = Math.min(Math.max(this.y, -slackY), slackY);
  }
}

/** Round numbers from `low` to `high`, about `most` of them, and how many decimals they need. */
export function ticks(low: number, high: number, most: number): { values: number[]; decimals: number } {
  const rough = (high - low) / Math.max(most, 1);
  if (!(rough > 0) || !Number.isFinite(rough)) return { values: [], decimals: 0 };
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * ([1, 2, 5].find((digit) => digit * power >= rough * 0.999) ?? 10);
  const values: number[] = [];
  for (let n = Math.ceil(low / step - 1e-9); n * step <= high + 1e-9 * step; n++) values.push(n * step + 0); // no minus zero
  return { values, decimals: Math.max(0, -Math.floor(Math.log10(step) + 1e-9)) };
}
