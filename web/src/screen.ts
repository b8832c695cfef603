// The whole screen, and paper.

import { byId } from "./dom";

/** Let the page have the whole screen, where the browser can. */
export function offerFullScreen(): void {
  const button = byId("full");
  button.hidden = !document.fullscreenEnabled;
  button.onclick = () => {
    switchFullScreen();
  };
  document.addEventListener("fullscreenchange", () => {
    button.setAttribute("aria-pressed", String(document.fullscreenElement !== null));
  });
}

export function switchFullScreen(): void {
  if (document.fullscreenElement) void document.exitFullscreen();
  else if (document.fullscreenEnabled) void document.documentElement.requestFullscreen();
}

/** Paper is white and of another width: draw for it, and for the screen again when it is printed. */
export function drawForPrint(draw: (printing: boolean) => void): void {
  addEventListener("beforeprint", () => draw(true));
  addEventListener("afterprint", () => draw(false));
}
