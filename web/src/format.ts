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

/** A mean and its interval, to two digits of the interval's half-width. */
export function estimate(mean: number | null, low: number | null, high: number | null): { mean: string; interval: string } {
  if (mean === null || !Number.isFinite(mean)) return { mean: "unknown", interval: "" };
  if (low === null || high === null || !Number.isFinite(high - low)) {
    return { mean: fixed(mean, decimals(Math.abs(mean) / 10)), interval: "" };
  }
  const digits = decimals((high - low) / 2);
  return { mean: fixed(mean, digits), interval: `[${fixed(low, digits)}, ${fixed(high, digits)}]` };
}

function decimals(half: number): number {
  return half > 0 && Number.isFinite(half) ? Math.min(Math.max(1 - Math.floor(Math.log10(half)), 0), 4) : 3;
}
