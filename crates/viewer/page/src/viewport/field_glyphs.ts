// Glyphs of a field on the skin and on cut faces: arrows of vectors; principal values of tensors as arrows
// outwards for tension and inwards for compression. There are fewer glyphs than places: one of each box of a
// grid.

import type { Frame, Sections, Topology } from "../types";
import { Arrows } from "./arrows";
import type { Stage } from "./stage";

/** Side of boxes of which so many lie along the longest side of all places, m. */
function sideOf(places: Float32Array, boxes: number): { low: number[]; side: number } {
  const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  for (let i = 0; i < places.length; i++) {
    low[i % 3] = Math.min(low[i % 3]!, places[i]!);
    high[i % 3] = Math.max(high[i % 3]!, places[i]!);
  }
  return { low, side: Math.max(...high.map((value, k) => value - low[k]!)) / boxes };
}

/** Places of which no two are in the same box of a grid whose boxes have this side (m); 0 takes all. */
export function spread(places: Float32Array, side: number): Uint32Array {
  const count = places.length / 3;
  const { low } = sideOf(places, 1);
  if (!(side > 0)) return Uint32Array.from({ length: count }, (_, i) => i);
  const taken = new Map<number, [number, number]>();
  for (let i = 0; i < count; i++) {
    let [key, away] = [0, 0];
    for (let k = 0; k < 3; k++) {
      const at = (places[3 * i + k]! - low[k]!) / side;
      key = key * 4096 + Math.floor(at);
      away += (at - Math.floor(at) - 0.5) ** 2;
    }
    const before = taken.get(key);
    if (before === undefined || away < before[1]) taken.set(key, [i, away]);
  }
  return Uint32Array.from([...taken.values()].map(([i]) => i)).sort();
}

/** Vectors, or principal values and axes, by rows. */
interface Field {
  kind: "vectors" | "tensors";
  vectors: Float32Array;
  values: Float32Array;
  axes: Float32Array;
}

function fieldOf({ glyphVectors, glyphValues, glyphAxes }: Pick<Frame, "glyphVectors" | "glyphValues" | "glyphAxes">): Field | null {
  const kind = glyphVectors.length > 0 ? "vectors" : glyphValues.length > 0 ? "tensors" : null;
  return kind === null ? null : { kind, vectors: glyphVectors, values: glyphValues, axes: glyphAxes };
}

/** The sizes of the glyphs of some rows. */
function sizes({ kind, vectors, values }: Field, rows: Uint32Array): number[] {
  return Array.from(rows, (row) => (kind === "vectors" ? Math.hypot(vectors[3 * row]!, vectors[3 * row + 1]!, vectors[3 * row + 2]!) : Math.max(Math.abs(values[3 * row]!), Math.abs(values[3 * row + 2]!))));
}

/** The glyphs of one set of places. */
class Glyphs {
  private readonly vectors: Arrows;
  private readonly tension: Arrows;
  private readonly compression: Arrows;

  constructor(stage: Stage, isOnCut: boolean) {
    const style = { isLinear: true, hasPoints: true, isHidden: true, isWhole: isOnCut };
    this.vectors = new Arrows(stage, { colour: "text", order: 60, ...style });
    this.tension = new Arrows(stage, { colour: "arrow", order: 63, ...style });
    this.compression = new Arrows(stage, { colour: "pushed", order: 66, isInward: true, ...style });
  }

  private get all(): Arrows[] {
    return [this.vectors, this.tension, this.compression];
  }

  /** `places`: three coordinates of each of the rows. */
  set(field: Field, rows: Uint32Array, places: Float32Array, reference: number): void {
    const sets = field.kind === "vectors" ? [[this.vectors, 0] as const] : [[this.tension, 1] as const, [this.compression, -1] as const];
    for (const [arrows, sign] of sets) {
      const [from, vectors]: [number[], number[]] = [[], []];
      const put = (i: number, x: number, y: number, z: number) => {
        from.push(places[3 * i]!, places[3 * i + 1]!, places[3 * i + 2]!);
        vectors.push(x, y, z);
      };
      rows.forEach((row, i) => {
        if (sign === 0) {
          const [x, y, z] = [0, 1, 2].map((k) => field.vectors[3 * row + k]!) as [number, number, number];
          if (Number.isFinite(x + y + z)) put(i, x, y, z);
          return;
        }
        for (let axis = 0; axis < 3; axis++) {
          const size = sign * field.values[3 * row + axis]!;
          if (!(size > 0)) continue;
          const [x, y, z] = [0, 1, 2].map((k) => size * field.axes[9 * row + 3 * axis + k]!) as [number, number, number];
          put(i, x, y, z);
          put(i, -x, -y, -z);
        }
      });
      arrows.set(Float32Array.from(from), Float32Array.from(vectors), reference);
    }
  }

  hide(): void {
    for (const arrows of this.all) arrows.hide();
  }

  show(kind: Field["kind"], longest: number, images?: readonly boolean[]): void {
    this.hide();
    for (const arrows of kind === "vectors" ? [this.vectors] : [this.tension, this.compression]) arrows.show(longest, images);
  }

  dispose(): void {
    for (const arrows of this.all) arrows.dispose();
  }
}

export class FieldGlyphs {
  private readonly skin: Glyphs;
  private readonly cuts: Glyphs[] = [];
  private cutCount = 0;
  private chosen: { key: string; topology: Topology; rows: Uint32Array } | null = null;
  private name = "";
  private kind: Field["kind"] | null = null;
  /** The size that has the full length: the 95th percentile of the frame with the largest glyphs so far. */
  private reference = 0;
  /** Distance of neighbouring glyphs, m. */
  private distance = 0;

  constructor(private readonly stage: Stage) {
    this.skin = new Glyphs(stage, false);
  }

  /** Rows of the skin that get a glyph, nodes or facets: those of hidden parts do not. */
  private rows(topology: Topology, side: number, isTensor: boolean, hidden: readonly boolean[]): Uint32Array {
    const key = `${side} ${isTensor} ${String(hidden)}`;
    if (this.chosen?.topology === topology && this.chosen.key === key) return this.chosen.rows;
    const { facets, facetParts, bars, barParts, initial } = topology;
    let own: Uint32Array;
    let places: Float32Array;
    if (isTensor) {
      own = Uint32Array.from(facetParts.keys()).filter((f) => hidden[facetParts[f]!] !== true);
      places = middles(facets, own, initial, 1, initial);
    } else {
      const isSeen = new Uint8Array(initial.length / 3);
      facets.forEach((node, i) => (isSeen[node]! |= hidden[facetParts[i >> 2]!] === true ? 0 : 1));
      bars.forEach((node, i) => (isSeen[node]! |= hidden[barParts[i >> 1]!] === true ? 0 : 1));
      own = Uint32Array.from(isSeen.keys()).filter((node) => isSeen[node] === 1);
      places = rowsOf(initial, own);
    }
    const rows = spread(places, side).map((i) => own[i]!);
    this.chosen = { key, topology, rows };
    return rows;
  }

  private refer(found: number[]): void {
    const sorted = found.filter((size) => size > 0 && Number.isFinite(size)).sort((a, b) => a - b);
    this.reference = Math.max(this.reference, sorted[Math.floor(0.95 * (sorted.length - 1))] ?? 0);
  }

  /** Takes the glyphs of a frame; `boxes`: so many along the longest side, 0 takes all; `scale`: of the displacements. */
  setFrame(frame: Frame, topology: Topology, name: string | null, boxes: number, scale: number, hidden: readonly boolean[]): void {
    const field = name === null ? null : fieldOf(frame);
    this.kind = field?.kind ?? null;
    this.cutCount = 0;
    if (name !== this.name) [this.name, this.reference] = [name ?? "", 0];
    if (field === null) return;
    this.distance = sideOf(topology.initial, boxes > 0 ? boxes : 40).side;
    const side = boxes > 0 ? this.distance : 0;
    const rows = this.rows(topology, side, field.kind === "tensors", hidden);
    const places = field.kind === "tensors" ? middles(topology.facets, rows, frame.positions, scale, topology.initial) : scaled(rows, frame.positions, scale, topology.initial);
    this.refer(sizes(field, rows));
    const cut = frame.sections === null ? null : fieldOf(frame.sections);
    if (cut !== null) this.refer(sizes(cut, Uint32Array.from({ length: Math.max(cut.vectors.length, cut.values.length) / 3 }, (_, i) => i)));
    this.skin.set(field, rows, places, this.reference);
    if (frame.sections !== null && cut !== null) this.setSections(frame.sections, cut, side, hidden);
  }

  private setSections(sections: Sections, field: Field, side: number, hidden: readonly boolean[]): void {
    const { planes, facets, parts, points } = sections;
    let polygon = -1;
    planes.forEach(({ first, count }, plane) => {
      const [own, middle]: [number[], number[]] = [[], []];
      for (let f = first; f < first + count; f++) {
        // the triangles of a polygon follow each other; the third corner of each is its middle
        if (f > first && facets[3 * f + 2] === facets[3 * f - 1]) continue;
        polygon++;
        if (hidden[parts[f]!] === true) continue;
        own.push(polygon);
        middle.push(facets[3 * f + 2]!);
      }
      const kept = spread(rowsOf(points, Uint32Array.from(middle)), side);
      const rows = kept.map((i) => own[i]!);
      (this.cuts[plane] ??= new Glyphs(this.stage, true)).set(field, rows, rowsOf(points, kept.map((i) => middle[i]!)), this.reference);
    });
    this.cutCount = planes.length;
  }

  /** Glyphs of the reference size reach to their neighbours, times a factor; `images`: in which the glyphs of each plane are. */
  show(factor: number, images: readonly (readonly boolean[])[]): void {
    for (const glyphs of [this.skin, ...this.cuts]) glyphs.hide();
    if (this.kind === null) return;
    this.skin.show(this.kind, this.longest(factor));
    for (let plane = 0; plane < this.cutCount; plane++) this.cuts[plane]!.show(this.kind, this.longest(factor), images[plane]);
  }

  /** The size and the length (m) of a glyph of reference size; null without glyphs. */
  key(factor: number): { size: number; length: number; colour: "text" | "arrow" } | null {
    if (this.kind === null || !(this.reference > 0)) return null;
    return { size: this.reference, length: this.longest(factor), colour: this.kind === "tensors" ? "arrow" : "text" };
  }

  private longest(factor: number): number {
    return (this.kind === "tensors" ? 0.8 : 2) * this.distance * factor;
  }

  dispose(): void {
    for (const glyphs of [this.skin, ...this.cuts]) glyphs.dispose();
  }
}

function rowsOf(places: Float32Array, rows: Uint32Array): Float32Array {
  return Float32Array.from({ length: 3 * rows.length }, (_, i) => places[3 * rows[Math.floor(i / 3)]! + (i % 3)]!);
}

/** Nodes as shown, x, y, z of each. */
function scaled(wanted: Uint32Array, positions: Float32Array, scale: number, initial: Float32Array): Float32Array {
  return Float32Array.from({ length: 3 * wanted.length }, (_, i) => {
    const at = 3 * wanted[Math.floor(i / 3)]! + (i % 3);
    return initial[at]! + scale * (positions[at]! - initial[at]!);
  });
}

/** Middles of facets as shown, x, y, z of each. */
function middles(facets: Uint32Array, wanted: Uint32Array, positions: Float32Array, scale: number, initial: Float32Array): Float32Array {
  const places = new Float32Array(3 * wanted.length);
  wanted.forEach((facet, i) => {
    const count = facets[4 * facet + 2] === facets[4 * facet + 3] ? 3 : 4;
    for (let c = 0; c < count; c++) {
      const node = facets[4 * facet + c]!;
      for (let k = 0; k < 3; k++) {
        const first = initial[3 * node + k]!;
        places[3 * i + k]! += (first + scale * (positions[3 * node + k]! - first)) / count;
      }
    }
  });
  return places;
}
