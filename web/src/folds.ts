// Panels that fold to their heading.

import { el } from "./dom";

const folded = new Set<string>(); // by heading: a panel that is made anew stays as it was

/** Let every panel in an element be folded; those that can be already are left alone. */
export function makeFoldable(root: HTMLElement): void {
  for (const card of root.querySelectorAll<HTMLElement>(".card")) {
    const heading = card.querySelector("h3");
    const name = heading?.textContent ?? "";
    if (!heading || heading.querySelector("button, select")) continue;
    const button = el("button", { type: "button", class: "fold" }, name);
    const show = (): void => {
      card.classList.toggle("folded", folded.has(name));
      button.setAttribute("aria-expanded", String(!folded.has(name)));
    };
    button.onclick = () => {
      if (!folded.delete(name)) folded.add(name);
      show();
    };
    heading.replaceChildren(button);
    show();
  }
}
