// Who hears whom: the k nearest others of each agent, found with a grid.

/** Pairs that `nearestPairs` found: agents 2p and 2p + 1 are pair p. */
export type Pairs = Uint32Array;

interface Points {
  x: Float32Array; // (N) [m]
  y: Float32Array;
  degree: Uint16Array; // (N) k
}

/**
 * Pairs of agents, each once, of which at least one hears the other.
 *
 * Agent i hears the degree[i] nearest others within `range` [m]; ties go to the lower index. Agents that `there` denies
 * neither hear nor are heard.
 */
export function nearestPairs(points: Points, range: number | null, there: (agent: number) => boolean): Pairs {
  const { x, y, degree } = points;
  const present = Uint32Array.from(x.keys()).filter(there);
  const grid = new Grid(x, y, present);
  const heard = new Set<number>();
  const found = new Nearest();
  for (const agent of present) {
    const most = Math.min(degree[agent], present.length - 1);
    if (most < 1) continue;
    grid.nearest(agent, most, range ?? Infinity, found);
    for (let n = 0; n < found.size; n++) {
      const other = found.agents[n];
      heard.add(Math.min(agent, other) * x.length + Math.max(agent, other));
    }
  }
  const pairs = new Uint32Array(2 * heard.size);
  let end = 0;
  for (const pair of heard) {
    pairs[end++] = Math.floor(pair / x.length);
    pairs[end++] = pair % x.length;
  }
  return pairs;
}

/** The nearest so far, sorted by (distance, index). */
class Nearest {
  agents: number[] = [];
  distances: number[] = [];
  size = 0;

  add(agent: number, distance: number, most: number): void {
    let place = this.size;
    while (place > 0 && this.isAfter(place - 1, distance, agent)) place--;
    if (place >= most) return;
    if (this.size < most) this.size++;
    for (let n = this.size - 1; n > place; n--) {
      this.agents[n] = this.agents[n - 1];
      this.distances[n] = this.distances[n - 1];
    }
    this.agents[place] = agent;
    this.distances[place] = distance;
  }

  private isAfter(place: number, distance: number, agent: number): boolean {
    const there = this.distances[place];
    return there > distance || (there === distance && this.agents[place] > agent);
  }
}

/** Agents by square cells, about two in each. */
class Grid {
  private readonly cells: number[][];
  private readonly columns: number;
  private readonly rows: number;
  private readonly side: number;
  private readonly left: number;
  private readonly bottom: number;

  constructor(
    private readonly x: Float32Array,
    private readonly y: Float32Array,
    present: Uint32Array,
  ) {
    let [left, right, bottom, top] = [Infinity, -Infinity, Infinity, -Infinity];
    for (const agent of present) {
      left = Math.min(left, x[agent]);
      right = Math.max(right, x[agent]);
      bottom = Math.min(bottom, y[agent]);
      top = Math.max(top, y[agent]);
    }
    const wide = Math.max(right - left, 0);
    const high = Math.max(top - bottom, 0);
    const longer = Math.max(wide, high);
    this.side = Math.max(Math.sqrt((2 * wide * high) / Math.max(present.length, 1)), longer / 100) || 1;
    this.left = left;
    this.bottom = bottom;
    this.columns = present.length ? Math.floor(wide / this.side) + 1 : 0;
    this.rows = present.length ? Math.floor(high / this.side) + 1 : 0;
    this.cells = Array.from({ length: this.columns * this.rows }, () => []);
    for (const agent of present) this.cells[this.row(agent) * this.columns + this.column(agent)].push(agent);
  }

  /** Fill `found` with the `most` nearest others of an agent that are within `range` [m]. */
  nearest(agent: number, most: number, range: number, found: Nearest): void {
    found.size = 0;
    const column = this.column(agent);
    const row = this.row(agent);
    const rings = Math.max(column, this.columns - 1 - column, row, this.rows - 1 - row);
    for (let ring = 0; ring <= rings; ring++) {
      const beyond = Math.max(ring - 1, 0) * this.side; // nobody in this ring is nearer
      if (beyond > range || (found.size === most && beyond * beyond > found.distances[most - 1])) return;
      this.visitRing(agent, column, row, ring, most, range, found);
    }
  }

  private visitRing(
    agent: number, column: number, row: number, ring: number, most: number, range: number, found: Nearest,
  ): void {
    for (let r = Math.max(row - ring, 0); r <= Math.min(row + ring, this.rows - 1); r++) {
      const whole = Math.abs(r - row) === ring;
      for (let c = column - ring; c <= column + ring; c += whole || ring === 0 ? 1 : 2 * ring) {
        if (c < 0 || c >= this.columns) continue;
        for (const other of this.cells[r * this.columns + c]) {
          const dx = this.x[other] - this.x[agent];
          const dy = this.y[other] - this.y[agent];
          const distance = dx * dx + dy * dy;
          if (other !== agent && distance <= range * range) found.add(other, distance, most);
        }
      }
    }
  }

  private column(agent: number): number {
    return Math.floor((this.x[agent] - this.left) / this.side);
  }

  private row(agent: number): number {
    return Math.floor((this.y[agent] - this.bottom) / this.side);
  }
}
