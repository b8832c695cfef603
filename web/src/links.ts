// Who really heard whom in the step of a frame, as the engine says it: a row of bits for each agent.

import type { Frame } from "./protocol";

/** Pairs of agents: 2p and 2p + 1 are pair p. */
export type Pairs = Uint32Array;

type Heard = Pick<Frame, "x" | "links" | "linkBytes">;

/** Whether an agent hears another. */
export function hears({ links, linkBytes }: Heard, agent: number, other: number): boolean {
  return linkBytes > 0 && (links[agent * linkBytes + (other >> 3)] & (1 << (other & 7))) !== 0;
}

/** Pairs, each once, of which at least one hears the other. */
export function linkedPairs(frame: Heard): Pairs {
  const pairs: number[] = [];
  const agents = frame.linkBytes > 0 ? frame.x.length : 0;
  for (let agent = 0; agent < agents; agent++) {
    for (let other = agent + 1; other < agents; other++) {
      if (hears(frame, agent, other) || hears(frame, other, agent)) pairs.push(agent, other);
    }
  }
  return Uint32Array.from(pairs);
}

/** An agent with each that it hears. */
export function heardBy(frame: Heard, agent: number): Pairs {
  if (frame.linkBytes === 0) return new Uint32Array();
  const others = [...frame.x.keys()].filter((other) => hears(frame, agent, other));
  return Uint32Array.from(others.flatMap((other) => [agent, other]));
}
