// The picture of one run: what the page sets (topology, frame, state) and asks (pick, figures).

import { OrthographicCamera, WebGLRenderer } from "three";
import type { MapName } from "../colormap";
import type { Frame, Run, Topology, Vector } from "../types";
import { arrowKeys, glyphKind } from "./arrow_keys";
import { Arrows, largestOf } from "./arrows";
import { Bars } from "./bars";
import { Caps } from "./caps";
import { type Camera, type Direction, dot, Rig } from "./camera";
import { Controls } from "./controls";
import { bodyBox, type Box, corners, joined, nearby } from "./extents";
import { FieldGlyphs } from "./field_glyphs";
import { Ghost } from "./ghost";
import { drawOverlay, type Shown } from "./overlay";
import { picked } from "./picked";
import { Picker } from "./picking";
import type { Sight } from "./model_glyphs";
import { Obstacles } from "./obstacles";
import { PlaneHandles, planeShown, type SectionPlane, type View as PlaneView } from "./plane";
import { type Colouring, Skin, valuesOf } from "./skin";
import { imageSigns, Stage } from "./stage";

export type { MapName } from "../colormap";
export type { Camera, Direction } from "./camera";
export type { SectionPlane } from "./plane";

/** What a link restores of the picture; plain JSON. */
export interface ViewState {
  /** null = fit to the bodies */
  camera: Camera | null;
  /** Of the displacements: shown = initial + scale · (current − initial). */
  scale: number;
  /** Mesh lines. */
  lines: boolean;
  /** Contact forces. */
  arrows: boolean;
  arrow_scale: number;
  /** Field whose vectors or principal values are drawn. */
  glyphs: string | null;
  /** Glyphs along the longest side; 0: at every place. */
  glyph_count: number;
  /** Bodies as they were at the beginning. */
  undeformed: boolean;
  /** Lines of equal value. */
  iso: boolean;
  /** Values of elements averaged at the nodes of each part. */
  averaged: boolean;
  section: SectionPlane | null;
  mirror: [boolean, boolean, boolean];
  obstacles: boolean;
  /** Names of parts not shown. */
  hidden: string[];
  map: MapName;
  /** Of the colours; null = as given by `setRange` (automatic). */
  range: [number, number] | null;
  /** Steps of colour; 0 = continuous. */
  bands: number;
}

/** What lies under the pointer: the nearest corner of the facet or bar there. `facet` counts facets and then bars. */
export interface Pick {
  node: number;
  cell: number;
  part: number;
  facet: number;
  position: Vector;
  value: number | null;
}

/** A place with a label: that of a skin node, or `at` (m, as shown) where it is known. */
export interface Mark {
  node: number;
  at?: Vector;
  colour: string;
  label: string;
}

/** A line between two places with a text in its middle. */
export interface Ruler {
  ends: [Mark, Mark];
  colour: string;
  label: string;
}

export interface Figures {
  triangles: number;
  level: number;
  milliseconds: number;
  frames_per_second: number;
}

/** The state of a new picture of a run. */
export function firstState(run: Run): ViewState {
  return {
    camera: null,
    scale: 1,
    lines: run.elements <= 20_000,
    arrows: false,
    arrow_scale: 1,
    glyphs: null,
    glyph_count: 24,
    undeformed: false,
    iso: false,
    averaged: false,
    section: null,
    mirror: [...run.mirror],
    obstacles: true,
    hidden: [],
    map: "viridis",
    range: null,
    bands: 0,
  };
}

/** A picture that takes longer than this (ms) is drawn coarser while it moves. */
const SLOW = 50;
/** What has not moved for so long (ms) is drawn whole. */
const REST = 250;
/** Skins with more triangles are waited for, to know how long they take. */
const TIMED = 20_000;

export class Viewport {
  /** Draws over the picture what the page wants there. */
  drawOver: ((paper: CanvasRenderingContext2D, sight: Sight) => void) | null = null;
  /** The user moved the camera (to link two viewports). */
  onCamera?: (camera: Camera) => void;
  /** The user moved the plane of the section; `ended`: and has let go. */
  onSection?: (plane: SectionPlane, ended: boolean) => void;
  readonly figures: Figures = { triangles: 0, level: 0, milliseconds: 0, frames_per_second: 0 };

  /** Bodies are drawn here; axes, marks and the scale are put over them on the canvas that is seen. */
  private readonly hidden = document.createElement("canvas");
  private readonly paper: CanvasRenderingContext2D;
  private readonly renderer: WebGLRenderer;
  private readonly camera = new OrthographicCamera();
  private readonly stage: Stage;
  private readonly skin: Skin;
  private readonly bars: Bars;
  private readonly caps: Caps;
  private readonly arrows: Arrows;
  private readonly glyphs: FieldGlyphs;
  private readonly ghost: Ghost;
  private readonly obstacles: Obstacles;
  private readonly picker: Picker;
  private readonly rig: Rig;
  private readonly handles: PlaneHandles;
  private readonly controls: Controls;
  private current: ViewState;
  private range: [number, number] | null = null;
  private topology: Topology | null = null;
  private frame: Frame | null = null;
  private places = new Map<number, number>();
  private marks: Mark[] = [];
  private rulers: Ruler[] = [];
  private force = 0;
  /** Around what is looked at, in the tables' coordinates. */
  private box: Box | null = null;
  private pixels = 1;
  private due = 0;
  private rest = 0;
  private drawn = 0;
  private moves = false;
  private cost = [0, 0];
  private isLost = false;
  private isBare = false;

  constructor(
    readonly canvas: HTMLCanvasElement,
    public run: Run,
    readonly options: { dark: boolean; quantity: (value: number, unit: string) => string },
  ) {
    const paper = canvas.getContext("2d", { alpha: false });
    if (paper === null) throw new Error("the canvas can't be drawn on");
    this.paper = paper;
    this.renderer = new WebGLRenderer({ canvas: this.hidden, antialias: true, alpha: true, powerPreference: "high-performance" });
    this.renderer.setPixelRatio(1);
    this.renderer.setClearColor(0x000000, 0);
    for (const kind of ["webglcontextlost", "webglcontextrestored"] as const) {
      this.hidden.addEventListener(kind, () => {
        this.isLost = kind === "webglcontextlost";
        canvas.dispatchEvent(new Event(kind, { cancelable: true }));
        if (!this.isLost) this.request();
      });
    }
    const isPlane = run.dimension !== 3;
    this.stage = new Stage(isPlane, run.parts.length);
    this.stage.setDark(options.dark);
    this.skin = new Skin(this.stage);
    this.bars = new Bars(this.stage);
    this.caps = new Caps(this.stage);
    this.arrows = new Arrows(this.stage, { colour: "arrow", order: 50 });
    this.glyphs = new FieldGlyphs(this.stage);
    this.ghost = new Ghost(this.stage, this.skin, this.bars);
    this.obstacles = new Obstacles(this.stage);
    this.picker = new Picker(this.renderer, this.stage, this.skin, this.bars, this.caps);
    this.rig = new Rig(isPlane, run.camera?.from ?? null, run.camera?.up ?? null);
    this.current = firstState(run);
    this.handles = new PlaneHandles(canvas, () => this.plane());
    this.handles.onPlane = (plane, ended) => this.onSection?.(plane, ended);
    this.controls = new Controls(canvas, this.rig, () => this.moved());
  }

  /** WebGL's context was lost, or there is none: the page says so. */
  get lost(): boolean {
    return this.isLost;
  }

  setTopology(topology: Topology): void {
    this.topology = topology;
    this.frame = null;
    const hidden = this.hiddenParts();
    this.skin.setTopology(topology, hidden);
    this.bars.setTopology(topology, hidden);
    this.stage.initials.set(topology.initial);
    this.places = new Map();
    topology.nodeNumbers.forEach((number, place) => this.places.set(number, place));
  }

  setFrame(frame: Frame): void {
    if (this.topology === null || frame.positions.length !== this.topology.initial.length) return;
    this.frame = frame;
    this.stage.positions.set(frame.positions);
    this.stage.shared.nodeRows.value = frame.values.length;
    this.stage.values.setValues(valuesOf(frame, this.topology));
    this.stage.refresh();
    this.force = largestOf(frame.arrows, this.force);
    this.arrows.set(frame.arrowNodes, frame.arrows, this.force);
    this.caps.setSections(frame.sections, (this.topology.facets.length >> 2) + (this.topology.bars.length >> 1), this.hiddenParts());
    this.setGlyphs();
    this.obstacles.setFrame(frame, this.current.mirror, this.topology.origin);
    this.follow();
    this.request(true);
  }

  private setGlyphs(): void {
    const { frame, topology, current } = this;
    if (frame !== null && topology !== null) this.glyphs.setFrame(frame, topology, current.glyphs, current.glyph_count, current.scale, this.hiddenParts());
  }

  setState(state: ViewState): void {
    const before = this.current;
    this.current = structuredClone(state);
    if (before.map !== state.map) this.stage.setMap(state.map);
    const isHidden = String(before.hidden) !== String(state.hidden);
    if (isHidden) {
      const hidden = this.hiddenParts();
      this.skin.setHidden(hidden);
      this.bars.setHidden(hidden);
      this.caps.setHidden(hidden);
    }
    if (isHidden || before.glyphs !== state.glyphs || before.glyph_count !== state.glyph_count || before.scale !== state.scale) this.setGlyphs();
    if (this.frame !== null && this.topology !== null) this.obstacles.setFrame(this.frame, state.mirror, this.topology.origin);
    if (state.camera !== null) this.rig.set(state.camera);
    else if (before.camera !== null) this.rig.isFree = true;
    this.follow();
    this.request();
  }

  state(): ViewState {
    return { ...structuredClone(this.current), camera: this.rig.isFree ? null : structuredClone(this.rig.camera) };
  }

  setRange(range: [number, number] | null): void {
    this.range = range;
    this.request();
  }

  setDark(dark: boolean): void {
    this.stage.setDark(dark);
    this.request();
  }

  /** Looks at all bodies; follows them until the camera is moved. */
  fit(): void {
    this.current.camera = null;
    this.rig.isFree = true;
    this.follow();
    this.request();
  }

  look(direction: Direction): void {
    this.rig.look(direction);
    this.rig.isFree = false;
    this.fitNow();
    // A chosen direction is kept: in links, and by a picture that is linked to this one.
    this.rig.isFree = false;
    this.moved();
  }

  /** Turns by radians about the vertical and the horizontal of the picture; in 2D nothing. */
  orbit(dx: number, dy: number): void {
    this.rig.orbit(dx, dy);
    this.moved();
  }

  /** Moves the picture by fractions of the canvas's height, right and up. */
  pan(dx: number, dy: number): void {
    this.rig.pan(dx, dy);
    this.moved();
  }

  /** Larger than 1: closer. */
  zoom(factor: number): void {
    this.rig.zoom(factor);
    this.moved();
  }

  /** What is seen at a place of the canvas, in px of CSS. */
  pick(x: number, y: number): Pick | null {
    const { topology, frame } = this;
    if (topology === null || frame === null || this.isLost) return null;
    this.prepare();
    const size = this.size();
    const found = this.picker.at(this.camera, x * size.unit, y * size.unit, size.width, size.height);
    this.request();
    if (found === null) return null;
    const sign = this.stage.signs[found.image] ?? [1, 1, 1];
    const away = (place: Vector): number => {
      const [u, v] = this.project(place.map((value, k) => value * sign[k]!) as Vector);
      return Math.hypot(u - x, v - y);
    };
    return picked(found, { topology, frame, colouring: this.colouring(), place: (node) => this.place(node), away });
  }

  /** Whether a node is on the skin. */
  hasNode(node: number): boolean {
    return this.places.has(node);
  }

  mark(nodes: Mark[], rulers: Ruler[]): void {
    this.marks = nodes;
    this.rulers = rulers;
    this.request();
  }

  /** The plane through the middle of the bodies that faces the camera. */
  facing(): SectionPlane {
    const { back } = this.rig.basis;
    const [low, high] = this.run.size;
    return { normal: [...back], offset: dot(back, [0, 1, 2].map((k) => 0.5 * (low[k]! + high[k]!)) as Vector) };
  }

  resize(): void {
    this.follow();
    this.request();
  }

  /** Pictures that are exported have more pixels. */
  setPixels(factor: number): void {
    this.pixels = factor;
  }

  dispose(): void {
    cancelAnimationFrame(this.due);
    clearTimeout(this.rest);
    this.controls.dispose();
    this.handles.dispose();
    for (const drawn of [this.skin, this.bars, this.caps, this.arrows, this.glyphs, this.ghost, this.obstacles, this.picker, this.stage]) drawn.dispose();
    this.renderer.dispose();
  }

  /** What is drawn over the picture has changed. */
  redraw(): void {
    this.request();
  }

  /** Draws at once, and whole; `bare`: without handles. */
  draw(bare = false): void {
    this.isBare = bare;
    this.paint(0);
    this.isBare = false;
  }

  /** Draws with the next picture of the screen; what moves may be drawn coarser. */
  private request(moves = false): void {
    this.moves ||= moves;
    if (this.due === 0) this.due = requestAnimationFrame(() => this.next());
  }

  private moved(): void {
    this.onCamera?.(structuredClone(this.rig.camera));
    this.request(true);
  }

  /** The next picture: of what moves a coarser one if the whole takes long, which follows when it rests. */
  private next(): void {
    this.due = 0;
    const level = this.moves && this.cost[0]! > SLOW && this.skin.levelCount > 1 ? 1 : 0;
    this.moves = false;
    this.paint(level);
    const now = performance.now();
    this.figures.frames_per_second = 1000 / Math.max(now - this.drawn, 1);
    this.drawn = now;
    clearTimeout(this.rest);
    if (level > 0) this.rest = window.setTimeout(() => this.request(), REST);
  }

  private hiddenParts(): boolean[] {
    const hidden = new Set(this.current.hidden);
    return this.run.parts.map((part) => hidden.has(part.name));
  }

  /** What colours stand for in this frame. */
  private colouring(): Colouring {
    const { frame, topology } = this;
    if (frame === null || topology === null || frame.scalar === null) return "PART";
    const [facets, bars] = [topology.facets.length / 4, topology.bars.length / 2];
    const [colouring, wanted] = (
      { node: ["NODE", topology.nodeNumbers.length], corner: ["CORNER", 4 * facets + 2 * bars], cell: ["CELL", facets + bars] } as const
    )[frame.location ?? "cell"];
    return frame.values.length !== wanted ? "PART" : colouring;
  }

  private size(): { width: number; height: number; unit: number } {
    const box = this.canvas.getBoundingClientRect();
    const unit = Math.min(window.devicePixelRatio || 1, 2) * this.pixels;
    return { width: Math.max(1, Math.round(box.width * unit)), height: Math.max(1, Math.round(box.height * unit)), unit };
  }

  /** A free camera sees where the bodies were at the beginning and where they are now: it steps back where they leave the picture, and a frame is seen the same however one comes to it. */
  private follow(): void {
    const { topology, frame } = this;
    if (topology === null || frame === null) return;
    const now = bodyBox(frame.positions, topology.initial, this.current.scale);
    if (now === null) return;
    const bodies = joined(this.first(), now);
    const obstacles = this.current.obstacles ? this.obstacles.box() : null;
    this.box = obstacles === null ? bodies : joined(bodies, nearby(obstacles, bodies));
    if (this.rig.isFree) this.fitNow();
  }

  /** Around the bodies at the run's first frame, as the server reports. */
  private first(): Box | null {
    const [low, high] = this.run.size;
    const origin = this.topology!.origin;
    const of = (corner: Vector): Vector => corner.map((x, k) => x - origin[k]!) as Vector;
    return [...low, ...high].every(Number.isFinite) ? [of(low), of(high)] : null;
  }

  private fitNow(): void {
    const { box, topology } = this;
    if (box === null || topology === null) return;
    const all = corners(box, imageSigns(this.current.mirror), topology.origin);
    const { width, height } = this.size();
    const camera = this.run.camera;
    const isFirst = this.rig.isFree && camera !== null && this.run.dimension === 3;
    this.rig.fit(
      ({ right, up, back }) => {
        const along = [right, up, back].map((axis) => all.map((corner) => dot(corner, axis)));
        return [along.map((values) => Math.min(...values)) as Vector, along.map((values) => Math.max(...values)) as Vector];
      },
      width / height,
      isFirst ? camera.zoom : 1,
      isFirst ? camera.at : null,
    );
  }

  /** A skin node's place as shown, in the model's coordinates, m. */
  private place(node: number): Vector {
    const { topology, frame } = this;
    return [0, 1, 2].map((k) => {
      const initial = topology!.initial[3 * node + k]!;
      return initial + this.current.scale * (frame!.positions[3 * node + k]! - initial) + topology!.origin[k]!;
    }) as Vector;
  }

  /** Where a point of the model is seen, px of CSS. */
  private project(point: Vector): [number, number] {
    const { right, up } = this.rig.basis;
    const { target, height } = this.rig.camera;
    const box = this.canvas.getBoundingClientRect();
    const unit = box.height / height;
    const from = point.map((value, k) => value - target[k]!) as Vector;
    return [0.5 * box.width + unit * dot(from, right), 0.5 * box.height - unit * dot(from, up)];
  }

  /** Sets what all programs read, and the camera. */
  private prepare(): void {
    const { shared } = this.stage;
    const { width, height, unit } = this.size();
    const { current, topology } = this;
    if (this.hidden.width !== width || this.hidden.height !== height) this.renderer.setSize(width, height, false);
    shared.canvas.value.set(width, height);
    shared.pixel.value = unit;
    shared.scale.value = current.scale;
    shared.bands.value = current.bands;
    const [low, high] = current.range ?? this.range ?? this.frame?.range ?? [0, 1];
    shared.range.value.set(low, high);
    const origin = topology?.origin ?? [0, 0, 0];
    const signs = this.stage.setImages(current.mirror, origin);
    if (this.box !== null) shared.onPlane.value = 1e-4 * Math.max(...[0, 1, 2].map((k) => this.box![1][k]! - this.box![0][k]!));
    const all = this.box === null ? [] : corners(this.box, signs, origin);
    const far = all.reduce((most, corner) => Math.max(most, Math.hypot(...corner.map((value, k) => value - this.rig.camera.target[k]!))), 0);
    // Walls may be larger than the bodies.
    this.rig.apply(this.camera, width / height, this.rig.camera.target, 4 * far);
    const plane = this.caps.plane;
    this.stage.isCut = plane !== null;
    if (plane === null) return;
    const { right, up, back } = this.rig.basis;
    const { elements } = this.camera.matrix;
    const eye = dot(plane.normal, [elements[12]!, elements[13]!, elements[14]!]);
    shared.clip.value.set(dot(plane.normal, right), dot(plane.normal, up), dot(plane.normal, back), plane.offset - eye);
  }

  /** The plane of the section and how it is seen; null without one. */
  private plane(): { plane: SectionPlane; box: Box; view: PlaneView } | null {
    const { section, mirror } = this.current;
    const { box, topology } = this;
    if (section === null || box === null || topology === null || this.run.dimension !== 3) return null;
    const all = corners(box, imageSigns(mirror), topology.origin);
    const end = (choose: (...values: number[]) => number): Vector => [0, 1, 2].map((k) => choose(...all.map((corner) => corner[k]!))) as Vector;
    const view = { basis: this.rig.basis, perMetre: this.canvas.getBoundingClientRect().height / this.rig.camera.height, project: (point: Vector) => this.project(point) };
    return { plane: section, box: [end(Math.min), end(Math.max)], view };
  }

  private paint(level: number): void {
    if (this.isLost) return;
    const begin = performance.now();
    const { width, height, unit } = this.size();
    this.prepare();
    const colouring = this.colouring();
    const { current } = this;
    const { shared } = this.stage;
    if (this.frame !== null) {
      shared.isoSteps.value = current.bands > 1 ? current.bands : 10;
      this.skin.show(level, colouring, current.lines, current.iso);
      this.bars.show(colouring);
      this.caps.show(colouring, current.lines, current.iso);
      if (current.undeformed) this.ghost.show();
      else this.ghost.hide();
      this.glyphs.show(current.arrow_scale, this.caps.images());
      if (current.arrows) this.arrows.show((this.rig.camera.height / 8) * current.arrow_scale);
      else this.arrows.hide();
      if (current.obstacles) this.obstacles.show();
      else this.obstacles.hide();
    }
    this.renderer.render(this.stage.scene, this.camera);
    const triangles = this.skin.triangles(level) * this.stage.imageCount;
    if (triangles > TIMED) this.picker.finish();
    if (this.canvas.width !== width || this.canvas.height !== height) [this.canvas.width, this.canvas.height] = [width, height];
    this.paper.fillStyle = this.stage.theme.paper;
    this.paper.fillRect(0, 0, width, height);
    this.paper.drawImage(this.hidden, 0, 0);
    drawOverlay(this.paper, this.shown(width, height, unit));
    this.drawGlyphs(unit);
    const took = performance.now() - begin;
    this.cost[level] = took;
    Object.assign(this.figures, { triangles, level, milliseconds: took });
  }

  /** Glyphs of a model before it runs lie over everything. */
  private drawGlyphs(unit: number): void {
    if (this.drawOver === null || this.frame === null) return;
    const { right, up, back } = this.rig.basis;
    this.paper.save();
    this.paper.scale(unit, unit);
    this.drawOver(this.paper, {
      project: (place) => this.project(place),
      along: (vector) => [dot(vector, right), -dot(vector, up)],
      towards: (vector) => dot(vector, back),
      scale: this.canvas.getBoundingClientRect().height / this.rig.camera.height,
    });
    this.paper.restore();
  }

  private shown(width: number, height: number, unit: number): Shown {
    const place = ({ node, at }: Mark): [number, number] | null => {
      const skin = this.places.get(node);
      const point = skin === undefined ? at : this.place(skin);
      return this.frame === null || point === undefined ? null : this.project(point);
    };
    const marks = this.marks.flatMap((mark) => {
      const at = place(mark);
      return at === null ? [] : [{ at, colour: mark.colour, label: mark.label }];
    });
    const rulers = this.rulers.flatMap(({ ends, colour, label }) => {
      const [a, b] = [place(ends[0]), place(ends[1])];
      return a === null || b === null ? [] : [{ ends: [a, b] as [[number, number], [number, number]], colour, label }];
    });
    const plane = this.plane();
    const section = plane === null || this.isBare ? null : { ...planeShown(plane.plane, plane.box, plane.view), isHeld: this.handles.isHeld };
    return { size: [width, height], unit, basis: this.rig.basis, isPlane: this.run.dimension !== 3, metres: this.rig.camera.height, marks, rulers, section, keys: this.keys(), theme: this.stage.theme };
  }

  /** What the lengths of arrows stand for. */
  private keys(): Shown["keys"] {
    const { current, frame, run, stage } = this;
    if (frame === null) return [];
    const box = this.canvas.getBoundingClientRect();
    const glyph = this.glyphs.key(current.arrow_scale);
    const kinds = glyphKind(run, current.glyphs, glyph, stage.theme[glyph?.colour ?? "text"]);
    const length = (this.rig.camera.height / 8) * current.arrow_scale;
    if (current.arrows && frame.arrows.length > 0 && this.force > 0) kinds.push({ name: "contact force", size: this.force, length, unit: run.arrow_unit, colour: stage.theme.arrow, isRoot: true });
    return arrowKeys(kinds, box.height / this.rig.camera.height, 0.35 * box.width, this.options.quantity);
  }
}
