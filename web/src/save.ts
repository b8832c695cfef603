// Save what is seen: the water as a picture, the numbers as a table, and of a live run its scenario and its changes.

import { el } from "./dom";
import type { RunNumbers } from "./lines";
import type { Request, SavedText } from "./protocol";
import type { Stage } from "./stage";

const BETWEEN = 12; // [px] two waters side by side

interface Source {
  live: boolean; // there is an engine that can be asked
  stages: Stage[];
  runs: RunNumbers[];
  send(request: Request): void;
  chosen(): number; // the run that files are of
  say(words: string): void;
}

type Choice = [words: string, title: string, act: () => void];

export class Save {
  readonly root = el("section", { class: "card save", "aria-label": "Save" });
  files = 0; // saved so far
  private readonly changes = el("p", { class: "words" });

  constructor(private readonly source: Source) {
    const run: Choice[] = source.live
      ? [
          [
            "Scenario",
            "The settings as they are now: a file for shoal run",
            () => {
              source.send({ do: "export", what: "scenario", run: source.chosen() });
            },
          ],
          [
            "Changes",
            "The log of changes: shoal watch --replay-changes makes the run again",
            () => {
              source.send({ do: "export", what: "changes", run: 0 });
            },
          ],
        ]
      : [
          [
            "Link to this step",
            "Its address, to be sent to others",
            () => {
              void this.link();
            },
          ],
        ];
    const rows: [string, Choice[]][] = [
      [
        "Picture",
        [
          [
            "PNG",
            "The water as a picture",
            () => {
              this.png();
            },
          ],
          [
            "SVG",
            "The water as a drawing",
            () => {
              this.svg();
            },
          ],
        ],
      ],
      [
        "Numbers",
        [
          [
            "CSV",
            "Every metric over the steps",
            () => {
              this.csv();
            },
          ],
        ],
      ],
      ["Run", run],
    ];
    this.root.append(
      el("div", { class: "top" }, el("h3", {}, "Save")),
      ...rows.map(([name, choices]) =>
        el(
          "div",
          { class: "row", role: "group", "aria-label": `Save: ${name}` },
          el("span", {}, name),
          ...choices.map(([words, title, act]) => {
            const made = el("button", { type: "button", title }, words);
            made.onclick = act;
            return made;
          }),
        ),
      ),
      this.changes,
    );
  }

  /** Say how many changes there are to save. */
  count(changes: number): void {
    this.changes.textContent = changes === 1 ? "1 change so far" : changes ? `${changes} changes so far` : "";
  }

  /** A file that the engine has sent. */
  receive({ what, run, text }: SavedText): void {
    const step = this.source.stages[run]?.frame?.step ?? 0;
    const name = this.name(run);
    if (what === "scenario") this.offer(`${name}-step-${step}.toml`, new Blob([text], { type: "application/toml" }));
    else this.offer(`${name}-changes.jsonl`, new Blob([text], { type: "application/jsonl" }));
  }

  private offer(name: string, blob: Blob): void {
    download(name, blob);
    this.files++;
  }

  private get title(): string {
    const { frame } = this.source.stages[0];
    return `${this.name(0)}-step-${frame?.step ?? 0}`;
  }

  private name(run: number): string {
    const name = this.source.stages[run]?.scene?.name ?? "run";
    return name.replace(/[^\p{L}\p{N}_-]+/gu, "-").slice(0, 60) || "run";
  }

  private png(): void {
    const sheets = this.source.stages.map(({ canvas }) => canvas);
    const all = el("canvas");
    all.width = sheets.reduce((width, sheet) => width + sheet.width + BETWEEN, -BETWEEN);
    all.height = Math.max(...sheets.map(({ height }) => height));
    const context = all.getContext("2d")!;
    context.fillStyle = getComputedStyle(document.documentElement).getPropertyValue("--card");
    context.fillRect(0, 0, all.width, all.height);
    let left = 0;
    for (const sheet of sheets) {
      context.drawImage(sheet, left, 0);
      left += sheet.width + BETWEEN;
    }
    all.toBlob((blob) => {
      if (blob) this.offer(`${this.title}.png`, blob);
    });
  }

  private svg(): void {
    const { stages } = this.source;
    stages.forEach((stage, run) => {
      const text = stage.svg();
      const letter = stages.length > 1 ? `-${"AB"[run]}` : "";
      this.offer(`${this.title}${letter}.svg`, new Blob([text], { type: "image/svg+xml" }));
    });
  }

  private csv(): void {
    this.offer(`${this.title}.csv`, new Blob([table(this.source.runs)], { type: "text/csv" }));
  }

  private async link(): Promise<void> {
    const step = this.source.stages[0].frame?.step ?? 0;
    history.replaceState(null, "", `#step=${step}`);
    try {
      await navigator.clipboard.writeText(location.href);
      this.source.say("The link to this step is copied.");
    } catch {
      this.source.say("The link to this step is in the address bar.");
    }
  }
}

/** Numbers of runs as CSV: a row per run and step, a column for each series; no value where there is none. */
export function table(runs: RunNumbers[]): string {
  const names = [...new Set(runs.flatMap(({ history }) => history.names()))];
  const units = new Map(runs.flatMap(({ scene }) => (scene?.series ?? []).map(({ name, unit }) => [name, unit])));
  const head = names.map((name) => {
    const unit = units.get(name);
    return unit && unit !== "1" ? `${name} [${unit}]` : name;
  });
  const rows = runs.flatMap(({ history, scene }, run) =>
    history.step.map((step, at) => {
      const values = names.map((name) => history.of(name)[at]);
      return [
        run,
        step,
        Number((step * (scene?.time_step ?? 1)).toPrecision(12)),
        ...values.map((value) => (Number.isFinite(value) ? String(value) : "")),
      ].join(",");
    }),
  );
  return `${["run", "step", "time [s]", ...head].join(",")}\r\n${rows.join("\r\n")}\r\n`;
}

function download(name: string, blob: Blob): void {
  const address = URL.createObjectURL(blob);
  el("a", { href: address, download: name }).click();
  setTimeout(() => {
    URL.revokeObjectURL(address);
  }, 10_000);
}
