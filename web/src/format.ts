// Numbers in words: thousands apart, true minus signs, as many digits as an interval allows.

const THIN = "\u2009";
const MINUS = "\u2212";

/** 100 000, its thousands set apart. */
export function count(value: number): string {
  return Math.round(value)
    .toString()
    .replace(/\B(?=(\d{3})+$)/g, THIN)
    .replace("-", MINUS);
}

/** A number with so many decimals, or a dash where it is unknown. */
export function fixed(value: number | null, decimals: number): string {
  return value !== null && Number.isFinite(value) ? value.toFixed(decimals).replace("-", MINUS) : "–";
}

/** A number to about three digits. */
export function short(value: number): string {
  return Number.isFinite(value) ? Number(value.toPrecision(3)).toString().replace("-", MINUS) : "–";
}

/** A number on an axis, or under a cursor: as many digits as its size asks for. */
export function readable(value: number): string {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size >= 1000) return count(value);
  return Number(value.toPrecision(4)).toString().replace("-", MINUS);
}

/** A value beside its name, with as many decimals as its size asks for, so that it does not jump. */
export function steady(value: number): string {
  const size = Math.abs(value);
  return size >= 1000 ? count(value) : fixed(value, size >= 100 ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : 3);
}

/** A time in s, min or h. */
export function time(seconds: number): string {
  if (seconds >= 7200) return `${fixed(seconds / 3600, 2)} h`;
  if (seconds >= 120) return `${fixed(seconds / 60, 1)} min`;
  return `${fixed(seconds, 1)} s`;
}

/** A mean and its interval, told as src/shoal/record/words.py tells it: to two digits of the interval's half-width. */
export function estimate(mean: number | null, low: number | null, high: number | null): { mean: string; interval: string } {
  if (mean === null || !Number.isFinite(mean)) return { mean: "unknown", interval: "" };
  if (low === null || high === null || !Number.isFinite(high - low)) return { mean: told(mean, alone(mean)), interval: "" };
  const digits = high > low ? decimals((high - low) / 2) : alone(mean);
  return { mean: told(mean, digits), interval: `[${told(low, digits)}, ${told(high, digits)}]` };
}

/** A number with so many decimals, thousands apart; negative: of tens, hundreds. */
function told(value: number, digits: number): string {
  const size = 10 ** Math.max(-digits, 0);
  const rounded = digits < 0 ? Math.round(value / size) * size : value;
  const [whole = "", part] = fixed(rounded, Math.max(digits, 0)).split(".");
  return whole.replace(/\B(?=(\d{3})+$)/g, THIN) + (part === undefined ? "" : `.${part}`);
}

/** Of a number without an interval: a whole one has none, others three digits. */
function alone(mean: number): number {
  return Number.isInteger(mean) ? 0 : Math.max(decimals(Math.abs(mean) / 10), 0);
}

function decimals(half: number): number {
  return Math.min(1 - Math.floor(Math.log10(half)), 6);
}
