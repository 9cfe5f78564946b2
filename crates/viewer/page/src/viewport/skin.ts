// The skin of the bodies (in 2D: all cells) in its levels of detail, coloured by values or parts. Each
// level has a table of its facets' corners and a list of vertex numbers without hidden parts. Also gives the
// program of the id pass.

import { type BufferGeometry, type RawShaderMaterial, type Texture } from "three";
import type { Frame, Topology } from "../types";
import type { Pickable } from "./picking";
import { markOutlines } from "./outline";
import { PICK_FRAGMENT, SKIN_FRAGMENT, SKIN_VERTEX } from "./shaders";
import { Layer, makeMaterial, numbered, type Stage, type Uniforms } from "./stage";
import { Table } from "./store";

/** What colours stand for. */
export type Colouring = "CELL" | "NODE" | "CORNER" | "PART";

/** More facets than this have neither outlines nor smooth shading: finding neighbours would take long. */
const MOST_OUTLINED = 1_500_000;

/** For each node the facets that have it, one node after the other, and where those of each begin. */
function facetsAround(facets: Uint32Array, nodes: number): { starts: Uint32Array; around: Uint32Array } {
  const starts = new Uint32Array(nodes + 1);
  const isCorner = (i: number): boolean => (i & 3) !== 3 || facets[i] !== facets[i - 1];
  for (let i = 0; i < facets.length; i++) if (isCorner(i)) starts[facets[i]! + 1]!++;
  for (let n = 0; n < nodes; n++) starts[n + 1]! += starts[n]!;
  const next = starts.slice();
  const around = new Uint32Array(starts[nodes]!);
  for (let i = 0; i < facets.length; i++) if (isCorner(i)) around[next[facets[i]!]!++] = i >> 2;
  return { starts, around };
}

/** Values of a frame; behind those of corners each node's own, for the coarser skin. */
export function valuesOf({ location, values }: Frame, { levels, facets, nodeNumbers }: Topology): Float32Array {
  if (location !== "corner" || levels.length === 0) return values;
  const all = new Float32Array(values.length + nodeNumbers.length);
  all.set(values);
  facets.forEach((node, corner) => (all[values.length + node] = values[corner]!));
  return all;
}

interface Level {
  corners: Table;
  sources: Table | null;
  facets: Uint32Array;
  sourceOf: Uint32Array | null;
  geometry: BufferGeometry;
  triangles: number;
  isOutlined: boolean;
  /** Facets around nodes, for smooth shading of the whole skin in 3D. */
  around: { starts: Table; around: Table } | null;
}

function aroundTables(facets: Uint32Array, nodes: number): NonNullable<Level["around"]> {
  const found = facetsAround(facets, nodes);
  const tables = { starts: new Table("index"), around: new Table("index") };
  tables.starts.set(found.starts);
  tables.around.set(found.around);
  return tables;
}

export class Skin {
  private readonly layer: Layer;
  private levels: Level[] = [];
  private readonly parts = new Table("index");
  private readonly materials = new Map<string, RawShaderMaterial>();
  private readonly halfLine: { value: number } = { value: 0.5 };
  private readonly halfOutline: { value: number } = { value: 1 };
  private topology: Topology | null = null;

  constructor(private readonly stage: Stage) {
    this.layer = new Layer(stage, 10);
  }

  get levelCount(): number {
    return this.levels.length;
  }
  triangles(level: number): number {
    return this.levels[level]?.triangles ?? 0;
  }

  setTopology(topology: Topology, hidden: readonly boolean[]): void {
    this.clear();
    this.topology = topology;
    this.parts.set(topology.facetParts);
    const all = [{ facets: topology.facets, sources: null as Uint32Array | null }, ...topology.levels];
    for (const { facets, sources } of all) {
      const count = facets.length / 4;
      const corners = new Table("corners");
      const room = corners.room(count) as Uint32Array;
      const isOutlined = count <= MOST_OUTLINED;
      if (isOutlined) {
        const partOf = sources === null ? (f: number): number => topology.facetParts[f]! : (f: number): number => topology.facetParts[sources[f]!]!;
        markOutlines(facets, topology.nodeNumbers.length, partOf, this.stage.isPlane ? null : topology.initial, room);
      } else room.set(facets);
      corners.send();
      let table: Table | null = null;
      if (sources !== null) {
        table = new Table("index");
        table.set(sources);
      }
      this.levels.push({ corners, sources: table, facets, sourceOf: sources, geometry: numbered(null), triangles: 0, isOutlined, around: null });
      if (isOutlined && !this.stage.isPlane) this.levels.at(-1)!.around = aroundTables(facets, topology.nodeNumbers.length);
    }
    this.setHidden(hidden);
  }

  /** Leaves out the facets of hidden parts. */
  setHidden(hidden: readonly boolean[]): void {
    const parts = this.topology?.facetParts;
    if (parts === undefined) return;
    const none = !hidden.some(Boolean);
    for (const level of this.levels) {
      const { facets, sourceOf } = level;
      const count = facets.length / 4;
      const index = new Uint32Array(6 * count);
      let end = 0;
      for (let f = 0; f < count; f++) {
        if (!none && hidden[parts[sourceOf === null ? f : sourceOf[f]!]!] === true) continue;
        const first = 4 * f;
        index[end++] = first;
        index[end++] = first + 1;
        index[end++] = first + 2;
        if (facets[first + 2] === facets[first + 3]) continue;
        index[end++] = first;
        index[end++] = first + 2;
        index[end++] = first + 3;
      }
      level.geometry.dispose();
      level.geometry = numbered(end === index.length ? index : index.slice(0, end));
      level.triangles = end / 3;
    }
  }

  private uniforms(level: Level): Uniforms {
    return {
      ...this.stage.shared,
      facets: { value: level.corners.texture },
      starts: { value: level.around?.starts.texture ?? null },
      around: { value: level.around?.around.texture ?? null },
      sources: { value: level.sources?.texture ?? null },
      parts: { value: this.parts.texture },
      halfLine: this.halfLine,
      halfOutline: this.halfOutline,
    };
  }

  private material(index: number, colouring: Colouring | "PICK", lines: boolean, iso: boolean, image?: { value: number }): RawShaderMaterial {
    const level = this.levels[index]!;
    const defines: string[] = [colouring];
    if (this.stage.isCut) defines.push("CLIP");
    if (iso && (colouring === "NODE" || colouring === "CORNER")) defines.push("ISO");
    if (this.stage.shared.scale.value !== 1) defines.push("SCALED");
    if (!this.stage.isPlane && colouring !== "PICK") defines.push("SPACE", ...(level.around !== null ? ["SMOOTH"] : []));
    if (level.sources !== null) defines.push("COARSE");
    if (lines) defines.push("LINES");
    if (level.isOutlined) defines.push("OUTLINE");
    const key = `${index} ${defines.join(" ")}`;
    let material = this.materials.get(key);
    if (material === undefined) {
      const uniforms = this.uniforms(level);
      if (image !== undefined) uniforms["image"] = image;
      material = makeMaterial({
        vertex: SKIN_VERTEX,
        fragment: colouring === "PICK" ? PICK_FRAGMENT : SKIN_FRAGMENT,
        defines,
        uniforms,
        depth: !this.stage.isPlane,
      });
      this.materials.set(key, material);
    }
    return material;
  }

  show(level: number, colouring: Colouring, lines: boolean, iso: boolean): void {
    const shown = this.levels[level];
    if (shown === undefined) return this.layer.hide();
    const pixel = this.stage.shared.pixel.value;
    this.halfLine.value = 0.5 * pixel;
    this.halfOutline.value = (this.stage.isPlane ? 1.1 : 0.8) * pixel;
    this.layer.show(shown.geometry, this.material(level, colouring, lines, iso));
  }

  /** The whole skin: its vertices, and the table of its corners. */
  get whole(): { geometry: BufferGeometry; corners: Texture } | null {
    const level = this.levels[0];
    return level === undefined || level.triangles === 0 ? null : { geometry: level.geometry, corners: level.corners.texture };
  }

  /** Geometry and program that write the numbers of facets instead of colours; of the whole skin. */
  forPick(image: { value: number }): Pickable | null {
    const whole = this.levels[0];
    return whole === undefined || whole.triangles === 0 ? null : [whole.geometry, this.material(0, "PICK", false, false, image)];
  }

  private clear(): void {
    for (const level of this.levels) {
      level.corners.dispose();
      level.sources?.dispose();
      level.around?.starts.dispose();
      level.around?.around.dispose();
      level.geometry.dispose();
    }
    this.levels = [];
    for (const material of this.materials.values()) material.dispose();
    this.materials.clear();
  }

  dispose(): void {
    this.clear();
    this.parts.dispose();
  }
}
