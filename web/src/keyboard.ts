// Every control by key. One list makes both the keys and the help that names them.

import { byId, el } from "./dom";

export interface Key {
  keys: string[]; // as KeyboardEvent.key
  shown?: string;
  words: string;
  act: () => void;
}

/** Listen, and write the list into the help. Keys typed into a field are the field's. */
export function listen(groups: { title: string; keys: Key[] }[]): void {
  const acts = new Map<string, () => void>();
  for (const { keys } of groups) for (const key of keys) for (const name of key.keys) acts.set(name, key.act);
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || isTaken(event)) return;
    const act = acts.get(event.key.length === 1 ? event.key.toLowerCase() : event.key);
    if (!act) return;
    event.preventDefault();
    act();
  });
  byId("keys").replaceChildren(
    ...groups.map(({ title, keys }) =>
      el(
        "section",
        { "data-group": title },
        el("h3", {}, title),
        el("dl", {}, ...keys.flatMap(({ keys, shown, words }) => [el("dt", {}, el("kbd", {}, shown ?? keys[0].toUpperCase())), el("dd", {}, words)])),
      ),
    ),
  );
}

function isTaken({ key, target }: KeyboardEvent): boolean {
  if (!(target instanceof HTMLElement)) return false;
  if (key === "Escape" || key === "?") return target.matches("input[type=text], input[type=search]");
  if (document.querySelector("dialog[open]")) return true;
  if (target.matches("input[type=number], input[type=text], input[type=search], select, textarea")) return true;
  const arrows = key.startsWith("Arrow") || key === "Home" || key === "End" || key.startsWith("Page");
  if (target.matches("input[type=range], input[type=radio]")) return arrows || (key === " " && target.matches("[type=radio]"));
  return key === " " && target.matches("button, input[type=checkbox], summary");
}
