// Arrows from points: contact forces, vectors of a field, principal values. In 3D what lies behind bodies
// shines through faintly. The length refers to the largest so far; that of forces goes with the square root.

import { type BufferGeometry, GreaterDepth, type RawShaderMaterial, Vector4 } from "three";
import { ARROW_VERTEX, PLAIN_FRAGMENT } from "./shaders";
import { Layer, makeMaterial, numbered, rgb, type Stage, type Theme } from "./stage";
import { Table } from "./store";

export interface Style {
  colour: keyof Theme;
  /** Before what is drawn later. */
  order: number;
  /** Lengths go with the size, not with its root. */
  isLinear?: boolean;
  /** The head is at the point, and the arrow comes from the direction of its vector. */
  isInward?: boolean;
  /** Points are given by `set` as they are shown, instead of nodes. */
  hasPoints?: boolean;
  /** What lies behind bodies is not seen. */
  isHidden?: boolean;
  /** Arrows are not cut by a section: they stand on its faces. */
  isWhole?: boolean;
}

type Kind = "faint" | "halo" | "fill";

/** The largest size among vectors x, y, z, and `least`. */
export function largestOf(vectors: Float32Array, least: number): number {
  let square = least ** 2;
  for (let i = 0; i + 2 < vectors.length; i += 3) {
    const own = vectors[i]! ** 2 + vectors[i + 1]! ** 2 + vectors[i + 2]! ** 2;
    if (own > square && own < Infinity) square = own;
  }
  return Math.sqrt(square);
}

export class Arrows {
  private readonly layers: Layer[];
  private readonly nodes = new Table("index");
  private readonly vectors = new Table("vector");
  private readonly points = new Table("vector");
  private geometry: BufferGeometry = numbered(null);
  private readonly materials = new Map<string, RawShaderMaterial>();
  private readonly tables = { arrowNodes: { value: this.nodes.texture }, arrowVectors: { value: this.vectors.texture } };
  private readonly ownPoints = { value: this.points.texture };
  private readonly longest = { value: 1 };
  private readonly largest = { value: 0 };
  private readonly halo = { value: 1 };
  private readonly none = { value: 0 };
  private readonly paints = { faint: { value: new Vector4() }, halo: { value: new Vector4() }, fill: { value: new Vector4() } };
  private count = 0;

  constructor(
    private readonly stage: Stage,
    private readonly style: Style,
  ) {
    this.layers = [0, 1, 2].map((k) => new Layer(stage, style.order + k));
  }

  /** Arrows from skin nodes, or from points if the style says so; `largest`: the size that has the full length. */
  set(from: Uint32Array | Float32Array, vectors: Float32Array, largest: number): void {
    this.count = vectors.length / 3;
    if (from instanceof Uint32Array) this.nodes.set(from);
    else {
      this.points.set(from);
      this.nodes.set(Uint32Array.from({ length: this.count }, (_, i) => i));
      this.ownPoints.value = this.points.texture;
    }
    this.vectors.set(vectors);
    this.tables.arrowNodes.value = this.nodes.texture;
    this.tables.arrowVectors.value = this.vectors.texture;
    this.largest.value = largest;
    this.geometry.setDrawRange(0, 9 * this.count);
  }

  private material(kind: Kind): RawShaderMaterial {
    const { style, stage } = this;
    const isScaled = stage.shared.scale.value !== 1 && style.hasPoints !== true;
    const defines = [isScaled && "SCALED", stage.isCut && style.isWhole !== true && "CLIP", style.isLinear && "LINEAR", style.isInward && "INWARD"].filter((name) => typeof name === "string");
    const key = `${kind} ${defines.join(" ")}`;
    let material = this.materials.get(key);
    if (material === undefined) {
      material = makeMaterial({
        vertex: ARROW_VERTEX,
        fragment: PLAIN_FRAGMENT,
        defines,
        uniforms: {
          ...stage.shared,
          ...this.tables,
          ...(style.hasPoints === true ? { positions: this.ownPoints } : {}),
          longest: this.longest,
          largest: this.largest,
          halo: kind === "halo" ? this.halo : this.none,
          paint: this.paints[kind],
        },
        depth: !stage.isPlane,
        writesDepth: kind !== "faint",
        blends: true,
        late: true,
      });
      if (kind === "faint") material.depthFunc = GreaterDepth;
      this.materials.set(key, material);
    }
    return material;
  }

  hide(): void {
    for (const layer of this.layers) layer.hide();
  }

  /** `longest` in metres; `images`: in which mirror images they are, without them in all. */
  show(longest: number, images?: readonly boolean[]): void {
    this.hide();
    if (this.count === 0 || !(this.largest.value > 0)) return;
    this.longest.value = longest;
    this.halo.value = 1.1 * this.stage.shared.pixel.value;
    const arrow = rgb(this.stage.theme[this.style.colour]);
    const halo = rgb(this.stage.theme.halo);
    this.paints.faint.value.set(arrow.x, arrow.y, arrow.z, 0.28);
    this.paints.halo.value.set(halo.x, halo.y, halo.z, 1);
    this.paints.fill.value.set(arrow.x, arrow.y, arrow.z, 1);
    if (!this.stage.isPlane && this.style.isHidden !== true) this.layers[0]!.show(this.geometry, this.material("faint"), images);
    this.layers[1]!.show(this.geometry, this.material("halo"), images);
    this.layers[2]!.show(this.geometry, this.material("fill"), images);
  }

  dispose(): void {
    for (const table of [this.nodes, this.vectors, this.points]) table.dispose();
    this.geometry.dispose();
    for (const material of this.materials.values()) material.dispose();
  }
}
