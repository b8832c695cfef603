// The range of an axis: all of it, but for a spike at the beginning, such as that of a rate after the first steps.

const SPIKE = 2.5; // times the highest value after the beginning
const FEWEST = 20; // values of a line before anything is called a spike
const BEGINNING = 0.1; // of the values
const ROOM = 0.08; // of the range, above

export interface AxisRange {
  low: number;
  high: number;
  peak: number | null; // the highest value, if it lies beyond the axis
}

/** The range for the values of lines of a metric with bounds (null: none); a difference may be negative. */
export function axisRange(lines: number[][], least: number | null, most: number | null, difference = false): AxisRange {
  if (!difference && least === 0 && most === 1) return { low: 0, high: 1, peak: null };
  const all = extent(lines);
  if (all.high === -Infinity) return { low: difference ? -1 : 0, high: 1, peak: null };
  const later = lines.every(({ length }) => length >= FEWEST) ? extent(lines.map((values) => values.slice(BEGINNING * values.length))) : all;
  const size = ({ low, high }: { low: number; high: number }): number => Math.max(high, -low);
  const spikes = size(later) > 0 && size(all) > SPIKE * size(later);
  const { low, high } = spikes ? later : all;
  const [bottom, top] = [Math.min(low, 0), Math.max(high, 0)];
  const room = ROOM * (top - bottom || 1);
  return { low: bottom < 0 ? bottom - room : 0, high: top + room, peak: spikes && all.high > top ? all.high : null };
}

function extent(lines: number[][]): { low: number; high: number } {
  let [low, high] = [Infinity, -Infinity];
  for (const values of lines) {
    for (const value of values) {
      if (value < low) low = value;
      if (value > high && value !== Infinity) high = value;
    }
  }
  return { low, high };
}

/** Units of time that a run's axis can be in, and how many seconds each has. */
export function timeUnit(seconds: number): { name: string; seconds: number } {
  if (seconds >= 7200) return { name: "h", seconds: 3600 };
  return seconds >= 300 ? { name: "min", seconds: 60 } : { name: "s", seconds: 1 };
}

/** Index of the last of rising numbers that is at or before another; -1 if there is none. */
export function lastAt(rising: ArrayLike<number>, at: number): number {
  let [low, high] = [0, rising.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (rising[middle] <= at) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}
