// What there is to know of one agent at a frame, in words.

import { count, fixed, readable } from "./format";
import { fleetOf } from "./layers";
import { heardBy } from "./links";
import { between } from "./measure";
import { isAlive, isOnTarget, isSilent, type Frame, type Scene } from "./protocol";
import type { Tape } from "./tape";

const NAMED = 6; // neighbors told one by one

/** Rows of name and value. */
export function factsOf(scene: Scene, frame: Frame, agent: number, tape: Tape): [string, string][] {
  const fleet = scene.fleets[fleetOf(scene, agent)];
  const rows: [string, string][] = [["Strategy", fleet.strategy ?? scene.strategy.name]];
  if (!isAlive(frame, agent)) return [...rows, ["There", goneSince(scene, frame, agent, tape)]];
  if (!frame.lean) rows.push(["Speed", `${fixed(Math.hypot(frame.vx[agent], frame.vy[agent]), 2)} of ${readable(fleet.max_speed)} m/s`]);
  rows.push(["Reports", isSilent(frame, agent) ? "nothing is heard of it" : isOnTarget(frame, agent) ? "a target" : "no target"]);
  if (Number.isFinite(frame.repulsion[agent])) rows.push(["Spacing a_R", `${readable(frame.repulsion[agent])} m`]);
  scene.memory?.forEach(({ name, unit }, n) => {
    const value = frame.memory[n]?.[agent];
    if (value !== undefined) rows.push([name.replaceAll("_", " "), `${readable(value)}${unit && unit !== "1" ? ` ${unit}` : ""}`]);
  });
  if (!frame.lean) rows.push(...hearing(scene, frame, agent));
  return rows;
}

function hearing(scene: Scene, frame: Frame, agent: number): [string, string][] {
  if (!scene.has_links) return [["Hears", `k = ${frame.degree[agent]}; whom is not kept`]];
  const heard = heardBy(frame, agent).filter((_, n) => n % 2 === 1);
  const far = (other: number): number => between(at(frame, agent), at(frame, other)).distance;
  const near = [...heard].sort((a, b) => far(a) - far(b));
  const words = near
    .slice(0, NAMED)
    .map((other) => `no. ${other} (${readable(Number(far(other).toPrecision(3)))} m${!scene.delay && isOnTarget(frame, other) ? ", a target" : ""})`);
  const more = near.length > NAMED ? ` and ${near.length - NAMED} more` : "";
  const late = scene.delay ? `; their reports are ${scene.delay} steps old` : "";
  return [
    ["Hears", `${near.length} of k = ${frame.degree[agent]}`],
    ["Heard, nearest first", near.length ? `${words.join(", ")}${more}${late}` : "nobody"],
  ];
}

const at = ({ x, y }: Frame, agent: number): { x: number; y: number } => ({ x: x[agent], y: y[agent] });

/** Since when an agent is gone, as exactly as it is known. */
export function goneSince(scene: Pick<Scene, "events">, frame: Frame, agent: number, tape: Tape): string {
  const lost = scene.events.filter(([step, what, who]) => who === agent && what === "lost" && step <= frame.step).at(-1);
  if (lost) return `not since step ${count(lost[0])}`;
  if (scene.events.some(([step, what, who]) => who === agent && what === "joined" && step > frame.step)) return "not yet";
  let index = tape.indexOf(frame.step);
  while (index > 0 && !isAlive(tape.at(index - 1), agent)) index--;
  if (index <= 0) return "not any more";
  return `not since steps ${count(tape.at(index - 1).step)} to ${count(tape.at(index).step)}`;
}
