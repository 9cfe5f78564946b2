// Bars (truss elements) as lines of constant width that face the camera, coloured as the skin is.

import { type BufferGeometry, type RawShaderMaterial, type Texture } from "three";
import type { Topology } from "../types";
import type { Pickable } from "./picking";
import { BAR_FRAGMENT, BAR_VERTEX, PICK_FRAGMENT } from "./shaders";
import type { Colouring } from "./skin";
import { Layer, makeMaterial, numbered, quads, type Stage } from "./stage";
import { Table } from "./store";

/** px */
const THICKNESS = 5;

export class Bars {
  private readonly layer: Layer;
  private readonly ends = new Table("corners");
  private geometry: BufferGeometry = numbered(null);
  private readonly materials = new Map<string, RawShaderMaterial>();
  private readonly thickness = { value: THICKNESS };
  private readonly firstBar = { value: 0 };
  private readonly bars = { value: this.ends.texture };
  private topology: Topology | null = null;
  private count = 0;

  constructor(private readonly stage: Stage) {
    this.layer = new Layer(stage, 20);
  }

  setTopology(topology: Topology, hidden: readonly boolean[]): void {
    this.topology = topology;
    const count = topology.bars.length / 2;
    const room = this.ends.room(count);
    for (let i = 0; i < count; i++) room.set([topology.bars[2 * i]!, topology.bars[2 * i + 1]!, topology.barParts[i]!, 0], 4 * i);
    this.ends.send();
    this.bars.value = this.ends.texture;
    this.firstBar.value = topology.facets.length / 4;
    this.setHidden(hidden);
  }

  setHidden(hidden: readonly boolean[]): void {
    const topology = this.topology;
    if (topology === null) return;
    const shown = Uint32Array.from(topology.barParts.keys()).filter((i) => hidden[topology.barParts[i]!] !== true);
    this.count = shown.length;
    const corners = [0, 1, 2, 0, 2, 3];
    const index = hidden.some(Boolean) ? Uint32Array.from({ length: 6 * shown.length }, (_, k) => 4 * shown[Math.floor(k / 6)]! + corners[k % 6]!) : quads(shown.length);
    this.geometry.dispose();
    this.geometry = numbered(index);
  }

  private material(colouring: Colouring | "PICK", image?: { value: number }): RawShaderMaterial {
    const defines: string[] = [colouring];
    if (this.stage.isCut) defines.push("CLIP");
    if (this.stage.shared.scale.value !== 1) defines.push("SCALED");
    const key = defines.join(" ");
    let material = this.materials.get(key);
    if (material === undefined) {
      material = makeMaterial({
        vertex: BAR_VERTEX,
        fragment: colouring === "PICK" ? PICK_FRAGMENT : BAR_FRAGMENT,
        defines,
        uniforms: { ...this.stage.shared, bars: this.bars, thickness: this.thickness, firstBar: this.firstBar, ...(image === undefined ? {} : { image }) },
        depth: !this.stage.isPlane,
      });
      this.materials.set(key, material);
    }
    return material;
  }

  show(colouring: Colouring): void {
    if (this.count === 0) return this.layer.hide();
    this.thickness.value = THICKNESS * this.stage.shared.pixel.value;
    this.layer.show(this.geometry, this.material(colouring));
  }

  /** All bars: their vertices, and the table of their ends. */
  get whole(): { geometry: BufferGeometry; ends: Texture } | null {
    return this.count === 0 ? null : { geometry: this.geometry, ends: this.ends.texture };
  }

  forPick(image: { value: number }): Pickable | null {
    return this.count === 0 ? null : [this.geometry, this.material("PICK", image)];
  }

  dispose(): void {
    this.ends.dispose();
    this.geometry.dispose();
    for (const material of this.materials.values()) material.dispose();
  }
}
