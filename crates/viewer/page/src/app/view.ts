// The view: all that the user has chosen, and its text behind # in the address, by which a link restores it.
// Only what differs from the first view of the runs is in the text. Who changes the view calls `change`.

import type { Run } from "../types";
import { firstState, type Camera, type MapName, type SectionPlane, type ViewState } from "../viewport/viewport";
import { glyphFields, planeText } from "./wish";

export const TABS = ["model", "view", "energy", "contacts", "probes", "parts", "messages", "about"] as const;
export type Tab = (typeof TABS)[number];
export type Theme = "auto" | "light" | "dark";
/** Colours over the whole run, over the frame shown, or between own numbers (`picture.range`). */
export type RangeMode = "run" | "frame" | "own";

/** A place whose values are plotted: an element, or a node with a cell at it for quantities of cells (−1: none). */
export interface ProbePlace {
  run: number;
  of: "node" | "cell";
  node: number;
  cell: number;
}

/** Two nodes whose distance is measured. */
export interface Measure {
  run: number;
  a: number;
  b: number;
}

export const MOST_MEASURES = 4;

export interface View {
  scalar: string | null;
  /** s */
  time: number;
  playing: boolean;
  loop: boolean;
  /** 1 plays the whole run in ten seconds. */
  speed: number;
  /** Of a run in progress: shows what is newest. */
  follow: boolean;
  picture: ViewState;
  /** Of the second run, where cameras are not linked. */
  camera2: Camera | null;
  linked: boolean;
  /** One range of colours for both runs. */
  common: boolean;
  range_mode: RangeMode;
  probes: ProbePlace[];
  /** Quantities with plots of their own at the probes. */
  plots: string[];
  measures: Measure[];
  tab: Tab;
  panel: boolean;
  theme: Theme;
}

export const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];
export const MAPS: [MapName, string][] = [["viridis", "viridis"], ["turbo", "turbo"], ["coolwarm", "cool–warm"], ["grey", "grey"]];

export function firstView(runs: Run[]): View {
  const run = runs[0]!;
  return {
    scalar: run.scalar,
    time: run.frames[0]?.time ?? 0,
    playing: false,
    loop: false,
    speed: 1,
    follow: runs.some((r) => !r.is_over),
    picture: firstState(run),
    camera2: null,
    linked: true,
    common: true,
    range_mode: "run",
    probes: [],
    plots: [],
    measures: [],
    tab: runs.some((r) => r.error !== null) ? "messages" : "view",
    panel: true,
    theme: "auto",
  };
}

const short = (value: number): string => String(Number(value.toPrecision(7)));
const flag = (on: boolean): string => (on ? "1" : "0");

function cameraText(camera: Camera): string {
  return [...camera.position, ...camera.target, ...camera.up, camera.height].map(short).join("_");
}

/** The text of what differs from the first view. */
export function viewText(view: View, first: View): string {
  const parts: string[] = [];
  const put = (key: string, value: string) => parts.push(`${key}=${encodeURIComponent(value).replace(/%2C/g, ",").replace(/%3A/g, ":")}`);
  const [now, before] = [view.picture, first.picture];
  if (view.scalar !== first.scalar) put("field", view.scalar ?? "");
  if (view.follow) {
    if (!first.follow) put("follow", "1");
  } else if (view.time !== first.time || first.follow) put("t", String(Number(view.time.toPrecision(9))));
  if (view.loop) put("loop", "1");
  if (view.speed !== 1) put("speed", short(view.speed));
  if (now.camera !== null) put("camera", cameraText(now.camera));
  if (view.camera2 !== null && !view.linked) put("camera2", cameraText(view.camera2));
  if (!view.linked) put("linked", "0");
  if (!view.common) put("common", "0");
  if (now.scale !== before.scale) put("scale", short(now.scale));
  if (now.lines !== before.lines) put("lines", flag(now.lines));
  if (now.arrows !== before.arrows) put("arrows", flag(now.arrows));
  if (now.arrow_scale !== before.arrow_scale) put("arrow_scale", short(now.arrow_scale));
  if (now.mirror.join() !== before.mirror.join()) put("mirror", now.mirror.map(flag).join(""));
  if (now.obstacles !== before.obstacles) put("obstacles", flag(now.obstacles));
  if (now.glyphs !== before.glyphs) put("glyphs", now.glyphs ?? "");
  if (now.glyph_count !== before.glyph_count) put("glyph_count", short(now.glyph_count));
  if (now.undeformed) put("undeformed", "1");
  if (now.iso) put("iso", "1");
  if (now.averaged) put("averaged", "1");
  if (now.section !== null) put("section", planeText(now.section));
  if (now.hidden.length > 0) put("hidden", now.hidden.map(encodeURIComponent).join(","));
  if (now.map !== before.map) put("map", now.map);
  if (now.bands !== before.bands) put("bands", short(now.bands));
  if (view.range_mode === "frame") put("range", "frame");
  if (view.range_mode === "own" && now.range) put("range", now.range.map(short).join(","));
  if (view.probes.length > 0) put("probes", view.probes.map(probeText).join(","));
  if (view.plots.length > 0) put("plots", view.plots.join(","));
  if (view.measures.length > 0) put("measure", view.measures.map((m) => `${m.run}:${m.a}:${m.b}`).join(","));
  if (view.tab !== first.tab) put("tab", view.tab);
  if (!view.panel) put("panel", "0");
  if (view.theme !== "auto") put("theme", view.theme);
  return parts.join("&");
}

function numbers(text: string, separator: string, count: number): number[] | null {
  const list = text.split(separator).map(Number);
  return list.length === count && list.every(Number.isFinite) ? list : null;
}

/** Whole numbers from zero with colons between them. */
function counts(text: string, count: number): number[] | null {
  const list = numbers(text, ":", count);
  return list?.every((value) => Number.isInteger(value) && value >= 0) && !/(^|:)(:|$)/.test(text) ? list : null;
}

/** `run:node:cell`, `run:node` for a node inside, `run:eCELL` for an element. */
function probeText(place: ProbePlace): string {
  if (place.of === "cell") return `${place.run}:e${place.cell}`;
  return place.cell < 0 ? `${place.run}:${place.node}` : `${place.run}:${place.node}:${place.cell}`;
}
function probesOf(text: string): ProbePlace[] {
  const cell = counts(text.replace(":e", ":"), 2);
  if (cell && text.includes(":e")) return [{ run: cell[0]!, of: "cell", node: 0, cell: cell[1]! }];
  const [three, two] = [counts(text, 3), counts(text, 2)];
  if (three) return [{ run: three[0]!, of: "node", node: three[1]!, cell: three[2]! }];
  return two ? [{ run: two[0]!, of: "node", node: two[1]!, cell: -1 }] : [];
}

function cameraOf(text: string | undefined): Camera | null {
  const n = text === undefined ? null : numbers(text, "_", 10);
  if (n === null) return null;
  const at = (i: number): [number, number, number] => [n[i]!, n[i + 1]!, n[i + 2]!];
  return { position: at(0), target: at(3), up: at(6), height: n[9]! };
}

function sectionOf(text: string | undefined): SectionPlane | null {
  const n = text === undefined ? null : numbers(text, ",", 4);
  const length = n === null ? 0 : Math.hypot(n[0]!, n[1]!, n[2]!);
  return n !== null && length > 0 ? { normal: [n[0]! / length, n[1]! / length, n[2]! / length], offset: n[3]! } : null;
}

/** The view of a text; what it does not say, or says wrongly, is as in the first view. */
export function viewOf(text: string, first: View, run: Run): View {
  const said = new Map<string, string>();
  for (const pair of text.replace(/^#/, "").split("&")) {
    const at = pair.indexOf("=");
    if (at <= 0) continue;
    try {
      said.set(pair.slice(0, at), decodeURIComponent(pair.slice(at + 1)));
    } catch {
      // a broken escape: as if it were not there
    }
  }
  const view: View = { ...first, probes: [], plots: [], measures: [], picture: { ...first.picture, mirror: [...first.picture.mirror] } };
  const picture = view.picture;
  const on = (key: string, otherwise: boolean): boolean => (said.has(key) ? said.get(key) === "1" : otherwise);
  const number = (key: string, otherwise: number, low: number, high: number): number => {
    const value = Number(said.get(key) ?? NaN);
    return Number.isFinite(value) && value >= low && value <= high ? value : otherwise;
  };
  const field = said.get("field");
  if (field === "") view.scalar = null;
  else if (field !== undefined && run.scalars.some((s) => s.key === field)) view.scalar = field;
  if (said.has("t")) {
    view.time = number("t", first.time, -1e30, 1e30);
    view.follow = false;
  }
  view.follow = on("follow", view.follow);
  view.loop = on("loop", false);
  view.speed = number("speed", 1, 0.01, 100);
  picture.camera = cameraOf(said.get("camera"));
  view.camera2 = cameraOf(said.get("camera2"));
  view.linked = on("linked", true);
  view.common = on("common", true);
  picture.scale = number("scale", picture.scale, 0, 1e6);
  picture.lines = on("lines", picture.lines);
  picture.arrows = on("arrows", picture.arrows);
  picture.arrow_scale = number("arrow_scale", picture.arrow_scale, 0, 1e3);
  const mirror = said.get("mirror");
  if (mirror && /^[01]{3}$/.test(mirror)) picture.mirror = [mirror[0] === "1", mirror[1] === "1", mirror[2] === "1"];
  picture.obstacles = on("obstacles", picture.obstacles);
  const glyphs = said.get("glyphs");
  if (glyphFields(run).some(({ key }) => key === glyphs)) picture.glyphs = glyphs!;
  picture.glyph_count = number("glyph_count", picture.glyph_count, 0, 1000);
  picture.undeformed = on("undeformed", false);
  picture.iso = on("iso", false);
  picture.averaged = on("averaged", false);
  picture.section = run.dimension === 3 ? sectionOf(said.get("section")) : null;
  const hidden = said.get("hidden");
  if (hidden) picture.hidden = hidden.split(",").map((name) => decodeSafely(name)).filter((name) => run.parts.some((p) => p.name === name));
  const map = MAPS.find(([key]) => key === said.get("map"));
  if (map) picture.map = map[0];
  picture.bands = number("bands", picture.bands, 0, 64);
  const range = said.get("range");
  if (range === "frame") view.range_mode = "frame";
  else if (range) {
    const pair = numbers(range, ",", 2);
    if (pair && pair[0]! < pair[1]!) {
      view.range_mode = "own";
      picture.range = [pair[0]!, pair[1]!];
    }
  }
  view.probes = (said.get("probes") ?? "").split(",").flatMap(probesOf).slice(0, 8);
  view.plots = (said.get("plots") ?? "").split(",").filter((key) => run.scalars.some((scalar) => scalar.key === key)).slice(0, 8);
  for (const text of (said.get("measure") ?? "").split(",")) {
    const n = counts(text, 3);
    if (n && view.measures.length < MOST_MEASURES) view.measures.push({ run: n[0]!, a: n[1]!, b: n[2]! });
  }
  view.tab = TABS.find((tab) => tab === said.get("tab")) ?? first.tab;
  view.panel = on("panel", first.panel);
  const theme = said.get("theme");
  if (theme === "light" || theme === "dark") view.theme = theme;
  return view;
}

function decodeSafely(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}
