// The section of a 3D model: by an axis, facing the camera, or any plane; where it is, and which side is cut
// away. A part of the tab "View".

import type { Vector } from "../types";
import { offsets, unitOf } from "../viewport/plane";
import type { SectionPlane } from "../viewport/viewport";
import type { App } from "./app";
import { choice, h, row, setText } from "./dom";
import { group, numberInput } from "./form";
import { scaled } from "./format";
import type { Stage } from "./stage";

const AXES: Record<string, Vector> = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };

/** Smallest and largest offset that the slider has: around the bodies at the beginning, and their mirror images. */
function reach(app: App, normal: Vector): [number, number] {
  const [low, high] = app.sessions.map((session) => session.run.size).reduce(([a, b], [c, d]): [Vector, Vector] => [a.map((x, k) => Math.min(x, c[k]!)) as Vector, b.map((x, k) => Math.max(x, d[k]!)) as Vector]);
  const { mirror } = app.view.picture;
  const side = (k: number): number => Math.max(Math.abs(low[k]!), Math.abs(high[k]!));
  const [from, to] = offsets(normal, [low.map((x, k) => (mirror[k] ? -side(k) : x)) as Vector, high.map((x, k) => (mirror[k] ? side(k) : x)) as Vector]);
  const room = 0.1 * (to - from) || 1;
  return [from - room, to + room];
}

/** The plane through the middle of the bodies. */
function through(app: App, normal: Vector): SectionPlane {
  const [low, high] = reach(app, normal);
  return { normal, offset: 0.5 * (low + high) };
}

/** Switches a section off, or on: across the axis along which the camera looks most, the side of the camera cut away. */
export function toggleSection(app: App, stage: Stage): void {
  if (app.run.dimension !== 3) return;
  const { section } = app.view.picture;
  if (section !== null) return app.picture({ section: null });
  const facing = stage.active?.viewport?.facing().normal ?? [1, 0, 0];
  const axis = facing.reduce((best, n, k) => (Math.abs(n) > Math.abs(facing[best]!) ? k : best), 0);
  app.picture({ section: through(app, [0, 1, 2].map((k) => (k === axis ? Math.sign(facing[axis]!) || 1 : 0)) as Vector) });
}

/** Moves the plane by a part of its way. */
export function moveSection(app: App, part: number): void {
  const { section } = app.view.picture;
  if (section === null) return;
  const [low, high] = reach(app, section.normal);
  app.picture({ section: { ...section, offset: section.offset + part * (high - low) } });
}

/** "x", "-y", "free"; "none" without a section. */
function nameOf(section: SectionPlane | null): string {
  if (section === null) return "none";
  const found = Object.entries(AXES).find(([, axis]) => Math.abs(axis.reduce((sum, a, k) => sum + a * section.normal[k]!, 0)) > 1 - 1e-9);
  return found?.[0] ?? "free";
}

type Change = (section: SectionPlane | null) => void;

/** Slider and number of the offset; keys on the slider move by parts of its way. */
function placeRows(app: App, change: Change): { rows: HTMLElement[]; update: (plane: SectionPlane) => void } {
  const now = () => app.view.picture.section;
  const slider = h("input", { type: "range", step: "any", "aria-label": "Place of the section", oninput: () => {
    const plane = now();
    app.isDragging = true;
    if (plane) change({ ...plane, offset: Number(slider.value) });
  }, onchange: () => {
    app.isDragging = false;
    app.player.update();
  } });
  slider.addEventListener("keydown", (event) => {
    const part = { ArrowLeft: -0.01, ArrowDown: -0.01, ArrowRight: 0.01, ArrowUp: 0.01, PageDown: -0.1, PageUp: 0.1 }[event.key];
    if (part === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    moveSection(app, part);
  });
  let by = { factor: 1, unit: "m" };
  const place = numberInput(0, (typed) => {
    const plane = now();
    if (plane) change({ ...plane, offset: typed * by.factor });
  }, { step: "any", class: "number-box", "aria-label": "Place of the section, number" });
  const unit = h("span", { class: "unit" });
  const update = (plane: SectionPlane) => {
    const [low, high] = reach(app, plane.normal);
    slider.min = String(low);
    slider.max = String(high);
    if (slider.value !== String(plane.offset)) slider.value = String(plane.offset);
    by = scaled(Math.max(Math.abs(low), Math.abs(high)), "m");
    setText(unit, by.unit);
    slider.setAttribute("aria-valuetext", `${Number((plane.offset / by.factor).toPrecision(4))} ${by.unit}`);
    setNumber(place, plane.offset / by.factor);
  };
  return { rows: [row("Place", slider), unlabelled(place, unit)], update };
}

function unlabelled(...controls: HTMLElement[]): HTMLElement {
  return h("div", { class: "row" }, h("span", { class: "label" }), h("div", { class: "inline" }, ...controls));
}

/** Shows a number unless it is being typed. */
function setNumber(input: HTMLInputElement, value: number): void {
  const text = String(Number(value.toPrecision(5)));
  if (document.activeElement !== input && input.value !== text) input.value = text;
}

export function sectionGroup(app: App, stage: Stage): HTMLElement {
  const now = () => app.view.picture.section;
  const change: Change = (section) => app.picture({ section });
  // any plane stays chosen where its normal is an axis
  let isFree = false;
  const kind = choice([["none", "none"], ["x", "across x"], ["y", "across y"], ["z", "across z"], ["free", "any plane"]], nameOf(now()), (value) => {
    isFree = value === "free";
    if (value === "none") change(null);
    else if (value === "free") change(now() ?? through(app, unitOf([1, 1, 1])));
    else change(through(app, AXES[value]!));
  });
  const facing = h("button", { type: "button", class: "small", onclick: () => {
    const plane = stage.active?.viewport?.facing();
    if (plane) change(plane);
  } }, "Face the camera");
  const flip = h("button", { type: "button", class: "small", onclick: () => {
    const plane = now();
    if (plane) change({ normal: plane.normal.map((n) => -n + 0) as Vector, offset: -plane.offset });
  } }, "Other side");
  const place = placeRows(app, change);
  const normal = [0, 1, 2].map((axis) => numberInput(0, (typed) => {
    const wanted = now()?.normal.map((n, k) => (k === axis ? typed : n)) as Vector | undefined;
    if (wanted && Math.hypot(...wanted) > 0) change(through(app, unitOf(wanted)));
  }, { step: "any", class: "short", "aria-label": `Normal of the section, ${"xyz"[axis]}` }));
  const normals = h("div", { class: "row" }, h("span", { class: "label" }, "Normal"), h("div", { class: "inline three" }, ...normal));
  const hint = h("p", { class: "quiet" }, "In the picture: drag the handle to move the plane, the tip of the arrow to tilt it. What lies beyond the arrow is cut away.");
  const rows = [...place.rows, normals, unlabelled(flip, facing), hint];
  const update = () => {
    const plane = now();
    for (const one of rows) one.hidden = plane === null;
    const name = plane !== null && isFree ? "free" : nameOf(plane);
    if (kind.value !== name) kind.value = name;
    if (plane === null) return;
    normals.hidden = name !== "free";
    place.update(plane);
    normal.forEach((input, k) => setNumber(input, plane.normal[k]!));
  };
  app.events.on(["view", "run"], update);
  update();
  return group("Section", row("Plane", kind), ...rows);
}
