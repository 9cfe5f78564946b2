// Contact forces as arrows from their nodes. The length goes with the square root of the force; the largest
// force so far is an eighth of the picture's height. In 3D what lies behind bodies shines through faintly.

import { type BufferGeometry, GreaterDepth, type RawShaderMaterial, Vector4 } from "three";
import type { Frame } from "../types";
import { ARROW_VERTEX, PLAIN_FRAGMENT } from "./shaders";
import { Layer, makeMaterial, numbered, rgb, type Stage } from "./stage";
import { Table } from "./store";

export class Arrows {
  private readonly layers: Layer[];
  private readonly nodes = new Table("index");
  private readonly vectors = new Table("vector");
  private geometry: BufferGeometry = numbered(null);
  private readonly materials = new Map<string, RawShaderMaterial>();
  private readonly tables = { arrowNodes: { value: this.nodes.texture }, arrowVectors: { value: this.vectors.texture } };
  private readonly longest = { value: 1 };
  private readonly force = { value: 0 };
  private readonly halo = { value: 1 };
  private readonly none = { value: 0 };
  private readonly paints = { faint: { value: new Vector4() }, halo: { value: new Vector4() }, fill: { value: new Vector4() } };
  count = 0;

  constructor(private readonly stage: Stage) {
    this.layers = [50, 51, 52].map((order) => new Layer(stage, order));
  }

  /** The largest force so far, to which the lengths refer. */
  get largest(): number {
    return this.force.value;
  }

  setFrame(frame: Frame): void {
    this.count = frame.arrowNodes.length;
    this.nodes.set(frame.arrowNodes);
    this.vectors.set(frame.arrows);
    this.tables.arrowNodes.value = this.nodes.texture;
    this.tables.arrowVectors.value = this.vectors.texture;
    let square = this.force.value ** 2;
    const f = frame.arrows;
    for (let i = 0; i + 2 < f.length; i += 3) {
      const own = f[i]! ** 2 + f[i + 1]! ** 2 + f[i + 2]! ** 2;
      if (own > square && own < Infinity) square = own;
    }
    this.force.value = Math.sqrt(square);
    this.geometry.setDrawRange(0, 9 * this.count);
  }

  private material(kind: "faint" | "halo" | "fill"): RawShaderMaterial {
    const scaled = this.stage.shared.scale.value !== 1;
    const key = `${kind} ${scaled}`;
    let material = this.materials.get(key);
    if (material === undefined) {
      material = makeMaterial({
        vertex: ARROW_VERTEX,
        fragment: PLAIN_FRAGMENT,
        defines: scaled ? ["SCALED"] : [],
        uniforms: {
          ...this.stage.shared,
          ...this.tables,
          longest: this.longest,
          largest: this.force,
          halo: kind === "halo" ? this.halo : this.none,
          paint: this.paints[kind],
        },
        depth: !this.stage.isPlane,
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

  /** `longest` in metres. */
  show(longest: number): void {
    this.hide();
    if (this.count === 0 || !(this.force.value > 0)) return;
    this.longest.value = longest;
    this.halo.value = 1.1 * this.stage.shared.pixel.value;
    const arrow = rgb(this.stage.theme.arrow);
    const halo = rgb(this.stage.theme.halo);
    this.paints.faint.value.set(arrow.x, arrow.y, arrow.z, 0.28);
    this.paints.halo.value.set(halo.x, halo.y, halo.z, 1);
    this.paints.fill.value.set(arrow.x, arrow.y, arrow.z, 1);
    if (!this.stage.isPlane) this.layers[0]!.show(this.geometry, this.material("faint"));
    this.layers[1]!.show(this.geometry, this.material("halo"));
    this.layers[2]!.show(this.geometry, this.material("fill"));
  }

  dispose(): void {
    this.nodes.dispose();
    this.vectors.dispose();
    this.geometry.dispose();
    for (const material of this.materials.values()) material.dispose();
  }
}
