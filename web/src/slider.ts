// A slider with a name, a value with its unit, and a pause before it acts: a drag is one change, not fifty.

import { el } from "./dom";

const PATIENCE = 120; // [ms]

export interface Slider {
  root: HTMLElement;
  input: HTMLInputElement;
  /** Show a value that is in force; `say` puts it in words. */
  show(value: number, range: { min: number; max: number; step: number }, say: (value: number) => string): void;
  /** Say why there is nothing to slide. */
  refuse(reason: string): void;
}

export function slider(name: string, id: string, act: (value: number) => void): Slider {
  const input = el("input", { type: "range", id });
  const output = el("output", { for: id });
  let say = String as (value: number) => string;
  let waiting = 0;
  const tell = (value = Number(input.value)): void => {
    const words = say(value);
    output.textContent = words;
    input.setAttribute("aria-valuetext", words);
  };
  input.oninput = () => {
    tell();
    clearTimeout(waiting);
    waiting = window.setTimeout(() => {
      waiting = 0;
      act(Number(input.value));
    }, PATIENCE);
  };
  return {
    root: el("div", { class: "slider" }, el("label", { for: id }, name), output, input),
    input,
    show(value, { min, max, step }, words) {
      say = words;
      input.disabled = false;
      input.min = String(min);
      input.max = String(max);
      input.step = String(step);
      if (waiting) return;
      input.value = String(value);
      tell(value); // the truth, wherever the thumb can stand
    },
    refuse(reason) {
      input.disabled = true;
      output.textContent = reason;
    },
  };
}
