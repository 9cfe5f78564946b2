// Cut faces of a section: triangles that come with the frame, one set for each plane, coloured as the skin
// is. Each plane belongs to the mirror images that it cuts. Colours are not shaded: they are those of the
// legend.

import { type BufferGeometry, type RawShaderMaterial } from "three";
import type { Sections, Vector } from "../types";
import { markOutlines } from "./outline";
import type { Pickable } from "./picking";
import { PICK_FRAGMENT, SKIN_FRAGMENT, SKIN_VERTEX } from "./shaders";
import type { Colouring } from "./skin";
import { Layer, makeMaterial, numbered, type Stage, type Uniforms } from "./stage";
import { Table } from "./store";

/** Four corners for each triangle, the last repeated. */
function fourCorners(facets: Uint32Array): Uint32Array {
  const count = facets.length / 3;
  const four = new Uint32Array(4 * count);
  for (let f = 0; f < count; f++) {
    four[4 * f] = facets[3 * f]!;
    four[4 * f + 1] = facets[3 * f + 1]!;
    four[4 * f + 2] = four[4 * f + 3] = facets[3 * f + 2]!;
  }
  return four;
}

const isSame = (a: Vector, b: Vector): boolean => a.every((value, k) => Math.abs(value - b[k]!) < 1e-6);

export class Caps {
  private readonly layers: Layer[] = [];
  private readonly points = new Table("vector");
  private readonly corners = new Table("corners");
  private readonly values = new Table("value");
  private readonly parts = new Table("index");
  private readonly halfLine = { value: 0.5 };
  private readonly halfOutline = { value: 1 };
  private readonly firstRow = { value: 0 };
  private readonly tables = {
    positions: { value: this.points.texture }, facets: { value: this.corners.texture }, values: { value: this.values.texture }, parts: { value: this.parts.texture }, sources: { value: null },
  };
  private readonly materials = new Map<string, RawShaderMaterial>();
  private geometries: BufferGeometry[] = [];
  private sections: Sections | null = null;

  constructor(private readonly stage: Stage) {}

  /** The normal and the offset of the plane that cuts the model itself; null without a section. */
  get plane(): { normal: Vector; offset: number } | null {
    return this.sections?.planes[0] ?? null;
  }

  setSections(sections: Sections | null, firstRow: number, hidden: readonly boolean[]): void {
    this.sections = sections;
    this.firstRow.value = firstRow;
    if (sections === null) return this.setHidden(hidden);
    const { points, facets, parts, values } = sections;
    this.points.set(points);
    this.values.setValues(values);
    this.parts.set(parts);
    markOutlines(fourCorners(facets), points.length / 3, (f) => parts[f]!, null, this.corners.room(facets.length / 3) as Uint32Array);
    this.corners.send();
    this.tables.positions.value = this.points.texture;
    this.tables.facets.value = this.corners.texture;
    this.tables.values.value = this.values.texture;
    this.tables.parts.value = this.parts.texture;
    this.setHidden(hidden);
  }

  /** Leaves out the triangles of hidden parts. */
  setHidden(hidden: readonly boolean[]): void {
    for (const geometry of this.geometries) geometry.dispose();
    const { planes, parts } = this.sections ?? { planes: [], parts: new Uint32Array(0) };
    this.geometries = planes.map(({ first, count }) => {
      const index: number[] = [];
      for (let f = first; f < first + count; f++) if (hidden[parts[f]!] !== true) index.push(4 * f, 4 * f + 1, 4 * f + 2);
      return numbered(Uint32Array.from(index));
    });
  }

  private material(colouring: Colouring | "PICK", lines: boolean, iso: boolean, image?: { value: number }): RawShaderMaterial {
    const own = colouring === "CORNER" ? "NODE" : colouring;
    const defines: string[] = [own, "FAN"];
    if (colouring !== "PICK") defines.push("OUTLINE", ...(lines ? ["LINES"] : []), ...(iso && own === "NODE" ? ["ISO"] : []));
    const key = defines.join(" ");
    let material = this.materials.get(key);
    if (material === undefined) {
      const uniforms: Uniforms = { ...this.stage.shared, ...this.tables, halfLine: this.halfLine, halfOutline: this.halfOutline, firstRow: this.firstRow };
      if (image !== undefined) uniforms["image"] = image;
      material = makeMaterial({ vertex: SKIN_VERTEX, fragment: colouring === "PICK" ? PICK_FRAGMENT : SKIN_FRAGMENT, defines, uniforms });
      this.materials.set(key, material);
    }
    return material;
  }

  /** In which images of the model each plane is: where its mirrored normal is that of the section. */
  images(): boolean[][] {
    const planes = this.sections?.planes ?? [];
    const normal = planes[0]?.normal;
    if (normal === undefined) return [];
    return planes.map((plane) => this.stage.signs.map((sign) => isSame(plane.normal, normal.map((n, k) => n * sign[k]!) as Vector)));
  }

  show(colouring: Colouring, lines: boolean, iso: boolean): void {
    const pixel = this.stage.shared.pixel.value;
    this.halfLine.value = 0.5 * pixel;
    this.halfOutline.value = 1.1 * pixel;
    for (const layer of this.layers) layer.hide();
    this.images().forEach((images, i) => {
      const layer = (this.layers[i] ??= new Layer(this.stage, 15));
      layer.show(this.geometries[i]!, this.material(colouring, lines, iso), images);
    });
  }

  forPick(image: { value: number }): Pickable[] {
    return this.images().map((images, i): Pickable => [this.geometries[i]!, this.material("PICK", false, false, image), images]);
  }

  dispose(): void {
    for (const table of [this.points, this.corners, this.values, this.parts]) table.dispose();
    for (const geometry of this.geometries) geometry.dispose();
    for (const material of this.materials.values()) material.dispose();
  }
}
