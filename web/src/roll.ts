// The roll of a fleet of real buoys: how many are there, who is not, and who is silent.

import { el } from "./dom";
import { count } from "./format";
import { isAlive, isSilent, type Frame } from "./protocol";

const NAMED = 24; // ranges, at most, in a list

export class Roll {
  readonly root = el("section", { class: "card roll", "aria-label": "Fleet" });
  private readonly there = el("dd");
  private readonly gone = el("dd");
  private readonly silent = el("dd");

  constructor() {
    const row = (name: string, value: HTMLElement, title: string): HTMLElement[] => [el("dt", { title }, name), value];
    this.root.append(
      el("div", { class: "top" }, el("h3", {}, "Fleet")),
      el("p", { class: "words" }, "These buoys decide by themselves. They can be watched here, not changed."),
      el(
        "dl",
        {},
        ...row("There", this.there, "buoys that are in the water"),
        ...row("Not there", this.gone, "lost, or not yet joined"),
        ...row("Silent", this.silent, "in the water, but nothing was heard of them for a second"),
      ),
    );
  }

  call(frame: Frame): void {
    const all = [...frame.flags.keys()];
    const gone = all.filter((agent) => !isAlive(frame, agent));
    this.there.textContent = `${count(all.length - gone.length)} of ${count(all.length)}`;
    this.gone.textContent = names(gone);
    this.silent.textContent = names(all.filter((agent) => isAlive(frame, agent) && isSilent(frame, agent)));
  }
}

/** Numbers of buoys in rising order, those in a row as a range: "no. 0–7, 12". */
export function names(agents: number[]): string {
  if (agents.length === 0) return "none";
  const rows: [number, number][] = [];
  for (const agent of agents) {
    const row = rows[rows.length - 1];
    if (row && agent === row[1] + 1) row[1] = agent;
    else rows.push([agent, agent]);
  }
  const shown = rows.slice(0, NAMED).map(([first, last]) => (first === last ? `${first}` : `${first}–${last}`));
  return `no. ${shown.join(", ")}${rows.length > NAMED ? " …" : ""}`;
}
