// Glyphs of a field on the skin: arrows of vectors at nodes; principal values of tensors at the middles of
// facets, as arrows outwards for tension and inwards for compression. There are fewer glyphs than places: one
// of each box of a grid.

import type { Frame, Topology } from "../types";
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

/** Places of which no two are in the same box of a grid: `boxes` along the longest side of all; 0 takes all. */
export function spread(places: Float32Array, boxes: number): Uint32Array {
  const count = places.length / 3;
  const { low, side } = sideOf(places, boxes);
  if (boxes <= 0 || !(side > 0)) return Uint32Array.from({ length: count }, (_, i) => i);
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

export class FieldGlyphs {
  private readonly vectors: Arrows;
  private readonly tension: Arrows;
  private readonly compression: Arrows;
  private chosen: { topology: Topology; boxes: number; kind: "node" | "facet"; hidden: string; rows: Uint32Array } | null = null;
  private field = "";
  /** The size that has the full length: the 95th percentile of the frame with the largest glyphs so far. */
  private reference = 0;
  private kind: "vectors" | "tensors" | null = null;
  /** Distance of neighbouring glyphs, m. */
  private distance = 0;

  constructor(stage: Stage) {
    this.vectors = new Arrows(stage, { colour: "text", order: 60, isLinear: true, isHidden: true });
    const axes = { isLinear: true, hasPoints: true, isHidden: true };
    this.tension = new Arrows(stage, { colour: "arrow", order: 63, ...axes });
    this.compression = new Arrows(stage, { colour: "pushed", order: 66, isInward: true, ...axes });
  }

  /** Rows that get a glyph: those of hidden parts do not. */
  private rows(topology: Topology, boxes: number, kind: "node" | "facet", hidden: readonly boolean[]): Uint32Array {
    const key = String(hidden);
    const known = this.chosen;
    if (known?.topology === topology && known.boxes === boxes && known.kind === kind && known.hidden === key) return known.rows;
    const { facets, facetParts, bars, barParts, initial } = topology;
    let own: Uint32Array;
    let places: Float32Array;
    if (kind === "facet") {
      own = Uint32Array.from(facetParts.keys()).filter((f) => hidden[facetParts[f]!] !== true);
      places = middles(facets, own, initial, 1, initial);
    } else {
      const isSeen = new Uint8Array(initial.length / 3);
      facets.forEach((node, i) => (isSeen[node]! |= hidden[facetParts[i >> 2]!] === true ? 0 : 1));
      bars.forEach((node, i) => (isSeen[node]! |= hidden[barParts[i >> 1]!] === true ? 0 : 1));
      own = Uint32Array.from(isSeen.keys()).filter((node) => isSeen[node] === 1);
      places = Float32Array.from({ length: 3 * own.length }, (_, i) => initial[3 * own[Math.floor(i / 3)]! + (i % 3)]!);
    }
    const rows = spread(places, boxes).map((i) => own[i]!);
    this.distance = sideOf(initial, boxes > 0 ? boxes : 40).side;
    this.chosen = { topology, boxes, kind, hidden: key, rows };
    return rows;
  }

  private refer(sizes: number[]): void {
    const sorted = sizes.filter((size) => size > 0 && Number.isFinite(size)).sort((a, b) => a - b);
    this.reference = Math.max(this.reference, sorted[Math.floor(0.95 * (sorted.length - 1))] ?? 0);
  }

  /** Takes the glyphs of a frame; `scale`: of the displacements, `boxes`: see `spread`. */
  setFrame(frame: Frame, topology: Topology, field: string | null, boxes: number, scale: number, hidden: readonly boolean[]): void {
    const { glyphVectors, glyphValues, glyphAxes } = frame;
    this.kind = field === null ? null : glyphVectors.length > 0 ? "vectors" : glyphValues.length > 0 ? "tensors" : null;
    if (field !== this.field) [this.field, this.reference] = [field ?? "", 0];
    if (this.kind === "vectors") {
      const nodes = this.rows(topology, boxes, "node", hidden).filter((node) => Number.isFinite(glyphVectors[3 * node]!));
      const vectors = Float32Array.from({ length: 3 * nodes.length }, (_, i) => glyphVectors[3 * nodes[Math.floor(i / 3)]! + (i % 3)]!);
      this.refer(Array.from(nodes, (_, i) => Math.hypot(vectors[3 * i]!, vectors[3 * i + 1]!, vectors[3 * i + 2]!)));
      this.vectors.set(nodes, vectors, this.reference);
    } else if (this.kind === "tensors") {
      const facets = this.rows(topology, boxes, "facet", hidden);
      this.refer(Array.from(facets, (facet) => Math.max(Math.abs(glyphValues[3 * facet]!), Math.abs(glyphValues[3 * facet + 2]!))));
      const places = middles(topology.facets, facets, frame.positions, scale, topology.initial);
      for (const [arrows, sign] of [[this.tension, 1], [this.compression, -1]] as const) {
        const [from, vectors]: [number[], number[]] = [[], []];
        facets.forEach((facet, i) => {
          for (let axis = 0; axis < 3; axis++) {
            const size = sign * glyphValues[3 * facet + axis]!;
            if (!(size > 0)) continue;
            for (const side of [size, -size]) {
              for (let k = 0; k < 3; k++) {
                from.push(places[3 * i + k]!);
                vectors.push(side * glyphAxes[9 * facet + 3 * axis + k]!);
              }
            }
          }
        });
        arrows.set(Float32Array.from(from), Float32Array.from(vectors), this.reference);
      }
    }
  }

  /** Glyphs of the reference size reach to their neighbours, times a factor. */
  show(factor: number): void {
    const all = { vectors: [this.vectors], tensors: [this.tension, this.compression] };
    for (const arrows of [this.vectors, this.tension, this.compression]) arrows.hide();
    if (this.kind === null) return;
    for (const arrows of all[this.kind]) arrows.show((this.kind === "tensors" ? 0.8 : 2) * this.distance * factor);
  }

  dispose(): void {
    for (const arrows of [this.vectors, this.tension, this.compression]) arrows.dispose();
  }
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
