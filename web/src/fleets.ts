// Fleets by name: one that is emptied and filled again, or that both runs have, keeps its color and shape.

import type { Fleet, Scene } from "./protocol";

const seen: Fleet[] = [];

export function rememberFleets(scene: Scene): void {
  for (const fleet of scene.fleets) if (!seen.some((each) => each.name === fleet.name)) seen.push(fleet);
}

export function forgetFleets(): void {
  seen.length = 0;
}

/** Number of the color and shape of a fleet. */
export function styleOf(fleet: Fleet): number {
  return Math.max(
    seen.findIndex((each) => each.name === fleet.name),
    0,
  );
}

/** The fastest fleet so far. */
export function fastestFleet(): Fleet {
  return seen.reduce((best, each) => (each.max_speed > best.max_speed ? each : best));
}

/** How many fleets there have been. */
export function countFleets(): number {
  return seen.length;
}
