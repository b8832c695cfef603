// What mouse, touch and keyboard do on the water.

import type { Point, Stage } from "./stage";
import type { Tool } from "./swarm";

export type PointerTool = Tool | "measure";

const REACH = { mouse: 16, touch: 28, pen: 20 }; // [px] around a buoy

export interface Actions {
  tool(): PointerTool;
  pin(run: number, agent: number): void;
  remove(run: number, agent: number): void;
  add(run: number, at: Point): void;
  drag(run: number, target: number, at: Point): void;
  say(words: string): void;
}

/** Let a stage be touched. */
export function attachPointer(stage: Stage, actions: Actions): void {
  const { canvas, camera } = stage;
  const pointers = new Map<number, { x: number; y: number }>();
  let dragged: number | null = null; // target
  let wanted: Point | null = null;

  const place = (event: MouseEvent): { x: number; y: number } => {
    const rectangle = canvas.getBoundingClientRect();
    return { x: event.clientX - rectangle.left, y: event.clientY - rectangle.top };
  };
  const water = (x: number, y: number): Point => clamp(stage, { x: camera.fromX(x), y: camera.fromY(y) });
  const reach = (event: PointerEvent): number => REACH[event.pointerType as keyof typeof REACH] ?? REACH.mouse;

  /** At most one drag per frame. */
  const dragSoon = (at: Point): void => {
    const waiting = wanted !== null;
    wanted = at;
    stage.crosshair = at;
    stage.refresh();
    if (waiting) return;
    requestAnimationFrame(() => {
      if (dragged !== null && wanted) actions.drag(stage.run, dragged, wanted);
      wanted = null;
    });
  };

  const use = (x: number, y: number, within: number): void => {
    const tool = actions.tool();
    const agent = stage.agentAt(x, y, within);
    if (tool === "measure") {
      stage.ruler.press(water(x, y));
      stage.refresh();
    } else if (tool === "look") {
      stage.pick(agent);
      if (agent !== null) actions.pin(stage.run, agent);
    } else if (tool === "add") actions.add(stage.run, water(x, y));
    else if (tool === "remove") {
      if (agent === null) actions.say("There is no buoy here: click nearer to one.");
      else actions.remove(stage.run, agent);
    } else {
      const target = stage.targetNear(water(x, y));
      if (target === null) actions.say("No target is there now.");
      else actions.drag(stage.run, target, water(x, y));
    }
  };

  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    if (document.activeElement instanceof HTMLElement) document.activeElement.blur(); // arrows are steps after a click
    canvas.setPointerCapture(event.pointerId);
    const at = place(event);
    pointers.set(event.pointerId, at);
    stage.crosshair = null;
    if (pointers.size > 1) return;
    if (actions.tool() !== "move") return use(at.x, at.y, reach(event));
    dragged = stage.targetNear(water(at.x, at.y));
    if (dragged === null) actions.say("No target is there now.");
    else dragSoon(water(at.x, at.y));
  });

  canvas.addEventListener("mousedown", (event) => event.preventDefault()); // the keyboard comes by Tab or M

  canvas.addEventListener("pointermove", (event) => {
    const at = place(event);
    const before = pointers.get(event.pointerId);
    if (actions.tool() === "measure") {
      stage.ruler.move(water(at.x, at.y));
      stage.refresh();
      return;
    }
    if (!before) {
      const tool = actions.tool();
      if (event.pointerType === "mouse") stage.pick(tool === "look" || tool === "remove" ? stage.agentAt(at.x, at.y, REACH.mouse) : null);
      return;
    }
    pointers.set(event.pointerId, at);
    if (pointers.size === 2) {
      const other = [...pointers].find(([id]) => id !== event.pointerId)![1];
      const spread = (point: { x: number; y: number }): number => Math.hypot(point.x - other.x, point.y - other.y);
      camera.zoomBy(spread(at) / Math.max(spread(before), 1), (at.x + other.x) / 2, (at.y + other.y) / 2);
    } else if (dragged !== null) dragSoon(water(at.x, at.y));
    else if (actions.tool() === "look") camera.pan(at.x - before.x, at.y - before.y);
    stage.refresh();
  });

  const release = (event: PointerEvent): void => {
    pointers.delete(event.pointerId);
    stage.ruler.release();
    if (dragged !== null && wanted) actions.drag(stage.run, dragged, wanted);
    if (dragged !== null) stage.crosshair = null;
    [dragged, wanted] = [null, null];
    stage.refresh();
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("pointerleave", (event) => event.pointerType === "mouse" && stage.pick(null));
  canvas.addEventListener("dblclick", () => {
    if (actions.tool() !== "look") return;
    camera.reset();
    stage.refresh();
  });
  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const at = place(event);
      camera.zoomBy(Math.exp(-event.deltaY / 400), at.x, at.y);
      stage.refresh();
    },
    { passive: false },
  );

  canvas.addEventListener("keydown", (event) => {
    const by = event.shiftKey ? 40 : 10; // [px]
    const moves: Record<string, [number, number]> = { ArrowLeft: [-by, 0], ArrowRight: [by, 0], ArrowUp: [0, -by], ArrowDown: [0, by] };
    const move = moves[event.key];
    const { plot } = camera;
    const at = stage.crosshair ?? water(plot.left + plot.width / 2, plot.top + plot.height / 2);
    const [x, y] = [camera.toX(at.x), camera.toY(at.y)];
    if (move) {
      stage.crosshair = stage.crosshair ? water(x + move[0], y + move[1]) : at;
      stage.ruler.move(stage.crosshair);
      if (actions.tool() === "look") stage.pick(stage.agentAt(camera.toX(stage.crosshair.x), camera.toY(stage.crosshair.y), REACH.touch));
    } else if (event.key === "Enter" && stage.crosshair) use(x, y, REACH.touch);
    else if (event.key === "Escape" && stage.crosshair) {
      stage.crosshair = null;
      stage.pick(null);
    } else return;
    event.preventDefault();
    event.stopPropagation();
    stage.refresh();
  });
  canvas.addEventListener("blur", () => {
    stage.crosshair = null;
    stage.refresh();
  });
}

function clamp(stage: Stage, { x, y }: Point): Point {
  const area = stage.scene?.area;
  if (!area) return { x, y };
  const within = (value: number, side: number): number => Math.min(Math.max(value, -side / 2), side / 2);
  return { x: within(x, area.width), y: within(y, area.height) };
}
