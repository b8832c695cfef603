// The water in words, for who cannot see it: who is where, as far as it can be said in a few sentences.

import { fleetOf } from "./layers";
import { count, fixed, short } from "./format";
import { isAlive, isOnTarget, isPresent, type Frame, type Scene } from "./protocol";

const SIDES = ["east", "northeast", "north", "northwest", "west", "southwest", "south", "southeast"];

/** What a frame shows. */
export function spoken(scene: Scene, frame: Frame): string {
  const fleets = scene.fleets.map((fleet) => ({ name: fleet.name, there: 0 }));
  let [x, y, there, reporting] = [0, 0, 0, 0];
  for (let agent = 0; agent < frame.x.length; agent++) {
    if (!isAlive(frame, agent)) continue;
    there++;
    x += frame.x[agent]!;
    y += frame.y[agent]!;
    reporting += Number(isOnTarget(frame, agent));
    fleets[fleetOf(scene, agent)]!.there++;
  }
  const sentences = [`${fleets.map((fleet) => `${count(fleet.there)} ${fleet.name}`).join(" and ")} are there; ${count(reporting)} report a target.`];
  if (there > 0) sentences.push(`Their middle is ${place(scene, x / there, y / there)}.`);
  frame.targetX.forEach((targetX, target) => {
    const name = frame.targetX.length > 1 ? `Target ${target + 1}` : "The target";
    sentences.push(isPresent(frame, target) ? `${name} is ${place(scene, targetX, frame.targetY[target]!)}.` : `${name} is not there.`);
  });
  if (Number.isFinite(frame.timeOnTarget)) sentences.push(`Time on target ${fixed(frame.timeOnTarget, 3)}, velocity fluctuation ${fixed(frame.xi, 3)}.`);
  return sentences.join(" ");
}

/** Where a place lies from the middle of the arena: in the middle, or so many meters to which side. */
function place({ area }: Scene, x: number, y: number): string {
  const far = Math.hypot(x, y);
  if (far < 0.05 * Math.min(area.width, area.height)) return "in the middle";
  const side = SIDES[Math.round((Math.atan2(y, x) / (2 * Math.PI)) * 8 + 8) % 8]!;
  return `${far >= 2000 ? `${short(far / 1000)} km` : `${short(far)} m`} ${side} of the middle`;
}
