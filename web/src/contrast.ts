// How well a color is seen on another: WCAG 2.2, success criterion 1.4.11, asks for 3 to 1 of what has a meaning.

export const LEAST = 3;
const STEP = 0.02; // toward black or white

type Rgb = [number, number, number];

/** Contrast of two colors (#rrggbb), 1 to 21. */
export function contrast(one: string, other: string): number {
  const [low, high] = [luminance(rgb(one)), luminance(rgb(other))].sort((a, b) => a - b) as [number, number];
  return (high + 0.05) / (low + 0.05);
}

/** The color itself if it stands out from the water, or else the nearest darker or lighter one that does. */
export function standsOut(color: string, water: string, alpha = 1): string {
  const key = `${color} ${water} ${alpha}`;
  const known = found.get(key);
  if (known !== undefined) return known;
  const end = luminance(rgb(water)) > 0.18 ? "#000000" : "#ffffff";
  let best = color;
  for (let part = 0; part <= 1 && contrast(blend(best, water, alpha), water) < LEAST; part += STEP) best = blend(end, color, part);
  found.set(key, best);
  return best;
}

/** What is seen of a color that covers another by `alpha`. */
export function blend(color: string, under: string, alpha: number): string {
  const [top, bottom] = [rgb(color), rgb(under)];
  const mixed = top.map((value, n) => Math.round(bottom[n]! + alpha * (value - bottom[n]!)));
  return `#${mixed.map((value) => value.toString(16).padStart(2, "0")).join("")}`;
}

const found = new Map<string, string>();

function rgb(color: string): Rgb {
  return [1, 3, 5].map((at) => parseInt(color.slice(at, at + 2), 16)) as Rgb;
}

function luminance(color: Rgb): number {
  const [r, g, b] = color.map((value) => {
    const share = value / 255;
    return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
  }) as Rgb;
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}
