// Glyphs of a model before it runs, drawn over the picture: supports, arrows, dots, rings, lines and outlines
// of planes, each with a light rim by which it is seen on any ground. What is under the pointer is found by
// place.

import type { Vector } from "../types";
import type { Glyph, GlyphKind } from "../app/model_types";

/** Length of the longest arrow, size of a support, px. */
const ARROW = 54;
const SUPPORT = 12;
/** How much is left of what lies on the far side of a body. */
const FAR = 0.25;
/** How near the pointer must be to a symbol, px. */
const NEAR = 9;

/** How the picture sees the model. */
export interface Sight {
  /** Where a place is seen, px. */
  project: (place: Vector) => [number, number];
  /** A vector of length 1 as it is seen, px right and down for one. */
  along: (vector: Vector) => [number, number];
  /** How far a vector points at the viewer, −1 to 1 for one of length 1. */
  towards: (vector: Vector) => number;
  /** px of a metre. */
  scale: number;
}

interface Drawn {
  x: number;
  y: number;
  glyph: Glyph;
}

export class ModelGlyphs {
  private drawn: Drawn[] = [];

  /** Draws all glyphs whose kind is not hidden; the last kinds of the list lie below. */
  draw(paper: CanvasRenderingContext2D, kinds: GlyphKind[], glyphs: Glyph[], hidden: ReadonlySet<string>, sight: Sight): void {
    this.drawn = [];
    for (const kind of [...kinds].reverse()) {
      if (hidden.has(kind.name)) continue;
      for (const glyph of glyphs) if (glyph.kind === kind.name) this.glyph(paper, kind, glyph, sight);
    }
    paper.font = "600 12px system-ui, sans-serif";
    for (const { x, y, glyph } of this.drawn) {
      if (glyph.kind !== "probe") continue;
      paper.lineWidth = 3;
      paper.strokeStyle = "rgba(255, 255, 255, 0.85)";
      paper.strokeText(glyph.name, x + 11, y - 7);
      paper.fillStyle = "#10121c";
      paper.fillText(glyph.name, x + 11, y - 7);
    }
  }

  /** What is under a place of the canvas, px. */
  at(x: number, y: number): Glyph | null {
    let best: Drawn | null = null;
    for (const one of this.drawn) {
      const distance = Math.hypot(one.x - x, one.y - y);
      if (distance < NEAR && (best === null || distance < Math.hypot(best.x - x, best.y - y))) best = one;
    }
    return best?.glyph ?? null;
  }

  private glyph(paper: CanvasRenderingContext2D, kind: GlyphKind, glyph: Glyph, sight: Sight): void {
    const colour = `rgb(${kind.colour.join(", ")})`;
    const places = glyph.points.map((point) => sight.project(point));
    for (const [x, y] of places) this.drawn.push({ x, y, glyph });
    if (kind.symbol === "plane" || kind.symbol === "line") {
      const path = new Path2D();
      places.forEach(([x, y], index) => (index === 0 || (kind.symbol === "line" && index % 2 === 0) ? path.moveTo(x, y) : path.lineTo(x, y)));
      if (kind.symbol === "plane" && places.length > 2) {
        path.closePath();
        paper.fillStyle = `rgba(${kind.colour.join(", ")}, 0.08)`;
        paper.fill(path);
      }
      stroke(paper, path, kind.symbol === "line" ? 2.6 : 1.8, colour);
      if (kind.symbol === "line") for (const at of places) fill(paper, disk(at, 3), colour);
      return;
    }
    places.forEach((at, index) => {
      const vector = glyph.vectors[index] ?? [0, 0, 0];
      const [dx, dy] = sight.along(vector);
      // on the far side of the body: dots have its outward normal, loads push against it
      const facing = kind.symbol === "dot" ? sight.towards(vector) : kind.symbol === "push" ? -sight.towards(vector) : 0;
      paper.globalAlpha = facing < -0.05 ? FAR : 1;
      if (kind.symbol === "arrow") arrow(paper, at, [at[0] + ARROW * dx, at[1] + ARROW * dy], colour);
      else if (kind.symbol === "push") arrow(paper, [at[0] - 0.6 * ARROW * dx, at[1] - 0.6 * ARROW * dy], at, colour);
      else if (kind.symbol === "support") fill(paper, support(at, [dx, dy]), colour);
      else if (kind.symbol === "dot") fill(paper, disk(at, 2.3), colour);
      else stroke(paper, disk(at, Math.max(7.5, vector[0] * sight.scale)), 2.6, colour);
    });
    paper.globalAlpha = 1;
  }
}

/** The symbol of a kind, for a legend. */
export function sample(paper: CanvasRenderingContext2D, kind: GlyphKind, size: number): void {
  const middle = size / 2;
  const colour = `rgb(${kind.colour.join(", ")})`;
  paper.clearRect(0, 0, size, size);
  if (kind.symbol === "arrow" || kind.symbol === "push") arrow(paper, [1, middle], [size - 1, middle], colour);
  else if (kind.symbol === "support") fill(paper, support([middle, 3], [0, -1]), colour);
  else if (kind.symbol === "dot") fill(paper, disk([middle, middle], 3.2), colour);
  else if (kind.symbol === "ring") stroke(paper, disk([middle, middle], 0.3 * size), 2.4, colour);
  else {
    const path = new Path2D();
    path.moveTo(1, middle);
    path.lineTo(size - 1, middle);
    stroke(paper, path, 2.4, colour);
  }
}

function fill(paper: CanvasRenderingContext2D, path: Path2D, colour: string): void {
  paper.lineJoin = "round";
  paper.lineWidth = 2;
  paper.strokeStyle = "rgba(255, 255, 255, 0.9)";
  paper.stroke(path);
  paper.fillStyle = colour;
  paper.fill(path);
}

function stroke(paper: CanvasRenderingContext2D, path: Path2D, width: number, colour: string): void {
  paper.lineJoin = "round";
  paper.lineWidth = width + 1.8;
  paper.strokeStyle = "rgba(255, 255, 255, 0.85)";
  paper.stroke(path);
  paper.lineWidth = width;
  paper.strokeStyle = colour;
  paper.stroke(path);
}

function disk([x, y]: [number, number], radius: number): Path2D {
  const path = new Path2D();
  path.arc(x, y, radius, 0, 2 * Math.PI);
  return path;
}

/** A triangle whose tip is at the point and that stands against the direction; a square where there is none. */
function support([x, y]: [number, number], [dx, dy]: [number, number]): Path2D {
  const path = new Path2D();
  const length = Math.hypot(dx, dy);
  if (length < 0.2) {
    const half = 0.32 * SUPPORT;
    path.rect(x - half, y - half, 2 * half, 2 * half);
    return path;
  }
  const [u, v] = [dx / length, dy / length];
  const place = (back: number, across: number) => path.lineTo(x - back * u - across * v, y - back * v + across * u);
  path.moveTo(x, y);
  place(0.8 * SUPPORT, 0.45 * SUPPORT);
  place(0.8 * SUPPORT, -0.45 * SUPPORT);
  path.closePath();
  return path;
}

function arrow(paper: CanvasRenderingContext2D, from: [number, number], to: [number, number], colour: string): void {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const length = Math.hypot(dx, dy);
  if (!(length > 3)) {
    fill(paper, disk(from, 3), colour);
    return;
  }
  const [u, v] = [dx / length, dy / length];
  const head = Math.min(11, 0.7 * length);
  const path = new Path2D();
  const place = (along: number, across: number) => path.lineTo(from[0] + along * u - across * v, from[1] + along * v + across * u);
  for (const [along, across] of [[0, 1.15], [length - head, 1.15], [length - head, 0.42 * head], [length, 0], [length - head, -0.42 * head], [length - head, -1.15], [0, -1.15]] as const) place(along, across);
  path.closePath();
  fill(paper, path, colour);
}
