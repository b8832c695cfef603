// Where the pointer is: local meters, and longitude and latitude where they are known.

import { el } from "./dom";
import { placeWords } from "./geography";
import type { Stage } from "./stage";

/** Show beside a stage's caption where its mouse or its keyboard points. */
export function showPlace(stage: Stage): void {
  const place = el("output", { class: "place", "aria-label": "Place of the pointer" });
  const show = (x: number, y: number): void => {
    const { scene, camera } = stage;
    place.textContent = scene ? placeWords(scene, x, y, 1 / camera.scale) : "";
  };
  stage.root.querySelector(".caption")!.append(place);
  stage.canvas.addEventListener("pointermove", ({ offsetX, offsetY }) => show(stage.camera.fromX(offsetX), stage.camera.fromY(offsetY)));
  stage.canvas.addEventListener("pointerleave", () => {
    place.textContent = "";
  });
  stage.canvas.addEventListener("keydown", () => {
    // after the crosshair has moved
    requestAnimationFrame(() => {
      if (stage.crosshair) show(stage.crosshair.x, stage.crosshair.y);
    });
  });
}
