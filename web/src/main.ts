// Start: with what the page holds (a replay) or with the engine that served it (live).

import { App } from "./app";
import { LiveSource } from "./live";
import { ReplaySource } from "./replay";

declare global {
  interface Window {
    shoal: App["api"];
  }
}

const app = new App();
const scene = document.getElementById("scene")?.textContent;
const frames = document.getElementById("frames")?.textContent;
const scheme = location.protocol === "https:" ? "wss" : "ws";
window.shoal = app.api;
app.start(scene && frames ? new ReplaySource(scene, frames, app) : new LiveSource(`${scheme}://${location.host}/live`, app));
