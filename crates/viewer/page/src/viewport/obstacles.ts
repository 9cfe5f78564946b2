// Rigid obstacles: in 2D a line with a hatched band on its solid side, in 3D translucent facets
// with their borders and creases. They may move, so their points come with every frame; their connectivity is
// looked at only when it is another.

import { type BufferGeometry, type RawShaderMaterial, type Texture } from "three";
import type { Frame, Obstacles as Shapes, Vector } from "../types";
import { markOutlines } from "./outline";
import { EDGE_FRAGMENT, EDGE_VERTEX, SKIN_VERTEX, WALL_FRAGMENT } from "./shaders";
import { Layer, makeMaterial, numbered, quads, rgb, type Stage, type Uniforms } from "./stage";
import { Table } from "./store";

/** Width of the hatched band and of the line, px. */
const BAND = 14;
const LINE = 2;

function isSame(a: Uint32Array, b: Uint32Array): boolean {
  if (a.length !== b.length) return false;
  for (let i = 0; i < a.length; i++) if (a[i] !== b[i]) return false;
  return true;
}

/** Obstacles without those that lie in a plane across which the model is mirrored: to the whole model they are none. */
export function besideMirrors(shapes: Shapes, mirror: readonly boolean[], origin: Vector): Shapes {
  const { points, lines, lineOf, facets, facetOf } = shapes;
  const largest = points.reduce((most, x) => Math.max(most, Math.abs(x)), 0);
  const isIn = (point: number, axis: number): boolean => Math.abs(points[3 * point + axis]! + origin[axis]!) <= 1e-5 * largest;
  const lies = (corners: Uint32Array): boolean => mirror.some((on, axis) => on && corners.every((corner) => isIn(corner, axis)));
  const kept = (all: Uint32Array, of: Uint32Array, width: number): [Uint32Array, Uint32Array] => {
    const rows = [...of.keys()].filter((row) => !lies(all.subarray(width * row, width * (row + 1))));
    if (rows.length === of.length) return [all, of];
    return [Uint32Array.from(rows.flatMap((row) => [...all.subarray(width * row, width * (row + 1))])), Uint32Array.from(rows, (row) => of[row]!)];
  };
  const [ownLines, ownLineOf] = kept(lines, lineOf, 2);
  const [ownFacets, ownFacetOf] = kept(facets, facetOf, 4);
  return { points, lines: ownLines, lineOf: ownLineOf, facets: ownFacets, facetOf: ownFacetOf };
}

export class Obstacles {
  private readonly layer: Layer;
  private readonly points = new Table("vector");
  private readonly cornerTable = new Table("corners");
  private geometry: BufferGeometry = numbered(null);
  private known = new Uint32Array(0);
  private material: RawShaderMaterial | null = null;
  private readonly uniforms: Uniforms & { positions: { value: Texture }; facets: { value: Texture }; edges: { value: Texture } };
  private readonly own = { bandWidth: { value: BAND }, lineWidth: { value: LINE }, halfLine: { value: 0 }, halfOutline: { value: 1 }, cover: { value: 0.18 }, lineCover: { value: 0.45 } };
  private readonly paints = { ink: { value: rgb("#000000") }, solid: { value: rgb("#000000") } };
  private shapes: Shapes | null = null;

  constructor(private readonly stage: Stage) {
    this.layer = new Layer(stage, stage.isPlane ? 0 : 40);
    this.uniforms = {
      ...stage.shared,
      ...this.own,
      ...this.paints,
      positions: { value: this.points.texture },
      facets: { value: this.cornerTable.texture },
      edges: { value: this.cornerTable.texture },
    };
  }

  setFrame(frame: Frame, mirror: readonly boolean[], origin: Vector): void {
    this.shapes = frame.obstacles === null ? null : besideMirrors(frame.obstacles, mirror, origin);
    if (this.shapes === null) return;
    const { points, lines, facets } = this.shapes;
    this.points.set(points);
    const connectivity = this.stage.isPlane ? lines : facets;
    if (!isSame(connectivity, this.known)) {
      this.known = connectivity.slice();
      this.connect(this.shapes);
    }
    this.uniforms.positions.value = this.points.texture;
  }

  private connect({ points, lines, facets, facetOf }: Shapes): void {
    let index: Uint32Array;
    if (this.stage.isPlane) {
      const count = lines.length / 2;
      const room = this.cornerTable.room(count);
      for (let i = 0; i < count; i++) room.set([lines[2 * i]!, lines[2 * i + 1]!, 0, 0], 4 * i);
      index = quads(count);
    } else {
      const count = facets.length / 4;
      markOutlines(facets, points.length / 3, (f) => facetOf[f]!, points, this.cornerTable.room(count) as Uint32Array);
      index = quads(count);
    }
    this.cornerTable.send();
    this.uniforms.facets.value = this.cornerTable.texture;
    this.uniforms.edges.value = this.cornerTable.texture;
    this.geometry.dispose();
    this.geometry = numbered(index);
  }

  show(): void {
    if (this.shapes === null || this.known.length === 0) return this.layer.hide();
    const isPlane = this.stage.isPlane;
    const pixel = this.stage.shared.pixel.value;
    this.own.bandWidth.value = BAND * pixel;
    this.own.lineWidth.value = LINE * pixel;
    this.own.halfOutline.value = 0.7 * pixel;
    this.paints.ink.value = rgb(this.stage.theme.obstacle);
    this.paints.solid.value = rgb(isPlane ? this.stage.theme.solid : this.stage.theme.wall);
    this.material ??= makeMaterial({
      vertex: isPlane ? EDGE_VERTEX : SKIN_VERTEX,
      fragment: isPlane ? EDGE_FRAGMENT : WALL_FRAGMENT,
      defines: isPlane ? [] : ["SPACE", "BARE"],
      uniforms: this.uniforms,
      depth: !isPlane,
      writesDepth: false,
      blends: true,
      late: !isPlane,
    });
    this.layer.show(this.geometry, this.material);
  }

  hide(): void {
    this.layer.hide();
  }

  /** Smallest and largest coordinates of the points, minus the topology's origin; null without any. */
  box(): [Vector, Vector] | null {
    const points = this.shapes?.points;
    if (points === undefined || points.length === 0) return null;
    const low: Vector = [Infinity, Infinity, Infinity];
    const high: Vector = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < points.length; i++) {
      const k = i % 3;
      const x = points[i]!;
      if (x < low[k]!) low[k] = x;
      if (x > high[k]!) high[k] = x;
    }
    return [low, high];
  }

  dispose(): void {
    this.points.dispose();
    this.cornerTable.dispose();
    this.geometry.dispose();
    this.material?.dispose();
  }
}
