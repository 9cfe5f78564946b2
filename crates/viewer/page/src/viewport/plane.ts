// The plane of a section as it is drawn over the bodies, and moved: its outline around the bodies, a handle
// in its middle, and an arrow to the side that is cut away. Dragging the handle moves the plane along its
// normal, dragging the arrow's tip tilts it.

import type { Vector } from "../types";
import { along, type Basis, cross, dot } from "./camera";
import type { Box } from "./extents";

/** What lies on the side of the normal is cut away: normal · x > offset (m), as bodies are shown. */
export interface SectionPlane {
  normal: Vector;
  offset: number;
}

/** Length of the arrow, px. */
const ARROW = 62;
/** So near is on a handle, px. */
const NEAR = 15;

export const unitOf = (v: Vector): Vector => {
  const length = Math.sqrt(dot(v, v));
  return length > 0 ? [v[0] / length, v[1] / length, v[2] / length] : [0, 0, 1];
};

/** The corners of a box that is `part` larger on each side. */
function cornersOf([low, high]: Box, part: number): Vector[] {
  const room = part * Math.max(...high.map((value, k) => value - low[k]!));
  return Array.from({ length: 8 }, (_, corner) => [0, 1, 2].map((k) => ((corner >> k) & 1 ? high[k]! + room : low[k]! - room)) as Vector);
}

/** Smallest and largest offset of planes with a normal that touch a box. */
export function offsets(normal: Vector, box: Box): [number, number] {
  const all = cornersOf(box, 0).map((corner) => dot(corner, normal));
  return [Math.min(...all), Math.max(...all)];
}

/** The polygon that a plane cuts out of a box, in order; empty where it does not meet it. */
export function outlineOf({ normal, offset }: SectionPlane, box: Box): Vector[] {
  const corners = cornersOf(box, 0.04);
  const points: Vector[] = [];
  for (let a = 0; a < 8; a++) {
    for (const bit of [1, 2, 4]) {
      if (a & bit) continue;
      const [from, to] = [corners[a]!, corners[a | bit]!];
      const [h, g] = [dot(from, normal) - offset, dot(to, normal) - offset];
      if (h < 0 === g < 0) continue;
      points.push(along(from, along(to, from, -1), h / (h - g)));
    }
  }
  if (points.length < 3) return [];
  const middle = middleOf(points);
  const u = unitOf(cross(normal, Math.abs(normal[2]) < 0.9 ? [0, 0, 1] : [0, 1, 0]));
  const v = cross(normal, u);
  const angle = (p: Vector): number => Math.atan2(dot(along(p, middle, -1), v), dot(along(p, middle, -1), u));
  return points.sort((p, q) => angle(p) - angle(q));
}

function middleOf(points: Vector[]): Vector {
  return points.reduce((sum, p) => along(sum, p, 1 / points.length), [0, 0, 0] as Vector);
}

/** Where the plane's things are on the canvas, px. */
export interface PlaneShown {
  outline: [number, number][];
  handle: [number, number];
  tip: [number, number];
}

export interface View {
  basis: Basis;
  /** Pixels per metre. */
  perMetre: number;
  project: (point: Vector) => [number, number];
}

export function planeShown(plane: SectionPlane, box: Box, view: View): PlaneShown {
  const outline = outlineOf(plane, box);
  const middle = outline.length > 0 ? middleOf(outline) : along(middleOf(cornersOf(box, 0)), plane.normal, plane.offset - dot(middleOf(cornersOf(box, 0)), plane.normal));
  const handle = view.project(middle);
  const [x, y] = [dot(plane.normal, view.basis.right), -dot(plane.normal, view.basis.up)];
  return { outline: outline.map(view.project), handle, tip: [handle[0] + ARROW * x, handle[1] + ARROW * y] };
}

type Grip = "move" | "tilt";

/** Moves a plane by its handles on a canvas. */
export class PlaneHandles {
  /** The plane was moved; `ended`: the pointer has let go. */
  onPlane: (plane: SectionPlane, ended: boolean) => void = () => {};
  private held: { id: number; grip: Grip; x: number; y: number; plane: SectionPlane } | null = null;
  private readonly stop = new AbortController();

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly shown: () => { plane: SectionPlane; box: Box; view: View } | null,
  ) {
    const listen = { signal: this.stop.signal, capture: true };
    canvas.addEventListener("pointerdown", (event) => this.down(event), listen);
    canvas.addEventListener("pointermove", (event) => this.move(event), listen);
    for (const kind of ["pointerup", "pointercancel"] as const) canvas.addEventListener(kind, (event) => this.up(event), listen);
  }

  get isHeld(): boolean {
    return this.held !== null;
  }

  private grip(event: PointerEvent): Grip | null {
    const now = this.shown();
    if (now === null) return null;
    const { handle, tip } = planeShown(now.plane, now.box, now.view);
    const box = this.canvas.getBoundingClientRect();
    const away = ([x, y]: [number, number]): number => Math.hypot(event.clientX - box.left - x, event.clientY - box.top - y);
    if (away(handle) <= NEAR) return "move";
    return away(tip) <= NEAR ? "tilt" : null;
  }

  private down(event: PointerEvent): void {
    const grip = event.button === 0 && event.isPrimary ? this.grip(event) : null;
    if (grip === null) return;
    event.stopImmediatePropagation();
    event.preventDefault();
    this.canvas.focus();
    this.canvas.setPointerCapture(event.pointerId);
    this.held = { id: event.pointerId, grip, x: event.clientX, y: event.clientY, plane: this.shown()!.plane };
  }

  private move(event: PointerEvent): void {
    const { held } = this;
    if (held === null) {
      if (event.buttons === 0) this.canvas.style.cursor = { move: "grab", tilt: "move", none: "" }[this.grip(event) ?? "none"];
      return;
    }
    if (event.pointerId !== held.id) return;
    event.stopImmediatePropagation();
    const now = this.shown();
    if (now === null) return;
    const [dx, dy] = [event.clientX - held.x, event.clientY - held.y];
    this.onPlane(held.grip === "move" ? moved(held.plane, dx, dy, now.view) : tilted(held.plane, dx, dy, now.box, now.view.basis), false);
  }

  private up(event: PointerEvent): void {
    if (this.held === null || event.pointerId !== this.held.id) return;
    event.stopImmediatePropagation();
    this.held = null;
    const now = this.shown();
    if (now !== null) this.onPlane(now.plane, true);
  }

  dispose(): void {
    this.stop.abort();
  }
}

/** Along the normal as it is seen; if it points to the camera, upwards. */
function moved(plane: SectionPlane, dx: number, dy: number, { basis, perMetre }: View): SectionPlane {
  const seen = [dot(plane.normal, basis.right), -dot(plane.normal, basis.up)] as const;
  const square = seen[0] ** 2 + seen[1] ** 2;
  const by = square > 0.02 ? (dx * seen[0] + dy * seen[1]) / square : -dy;
  return { normal: plane.normal, offset: plane.offset + by / perMetre };
}

/** Turned about its middle: as far as the tip of the arrow moves. */
function tilted(plane: SectionPlane, dx: number, dy: number, box: Box, basis: Basis): SectionPlane {
  const outline = outlineOf(plane, box);
  const middle = outline.length > 0 ? middleOf(outline) : middleOf(cornersOf(box, 0));
  const back = dot(plane.normal, basis.back);
  let [x, y] = [dot(plane.normal, basis.right) + dx / ARROW, dot(plane.normal, basis.up) - dy / ARROW];
  const length = Math.hypot(x, y);
  if (length > 1) [x, y] = [x / length, y / length];
  const depth = Math.sqrt(Math.max(0, 1 - x * x - y * y)) * (back < 0 ? -1 : 1);
  const normal = unitOf(along(along(along([0, 0, 0], basis.right, x), basis.up, y), basis.back, depth));
  return { normal, offset: dot(normal, middle) };
}
