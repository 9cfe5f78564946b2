// The bodies as they were at the beginning: in 3D a translucent skin with its borders and creases, in 2D the
// outlines; bars as thin lines.

import { type RawShaderMaterial, Vector4 } from "three";
import type { Bars } from "./bars";
import { BAR_VERTEX, PLAIN_FRAGMENT, SKIN_VERTEX, WALL_FRAGMENT } from "./shaders";
import type { Skin } from "./skin";
import { Layer, makeMaterial, rgb, type Stage } from "./stage";

/** Thickness of bars, px. */
const BAR = 1.5;

export class Ghost {
  private readonly skinLayer: Layer;
  private readonly barLayer: Layer;
  private readonly facets = { value: null as unknown };
  private readonly bars = { value: null as unknown };
  private readonly paint = { value: new Vector4() };
  private readonly thickness = { value: BAR };
  private readonly own = { halfLine: { value: 0 }, halfOutline: { value: 1 }, cover: { value: 0 }, lineCover: { value: 0.85 }, ink: { value: rgb("#000000") }, solid: { value: rgb("#000000") } };
  private skinMaterial: RawShaderMaterial | null = null;
  private barMaterial: RawShaderMaterial | null = null;

  constructor(private readonly stage: Stage, private readonly skin: Skin, private readonly ofBars: Bars) {
    this.skinLayer = new Layer(stage, 41);
    this.barLayer = new Layer(stage, 42);
  }

  show(): void {
    this.hide();
    const { stage, own } = this;
    const isPlane = stage.isPlane;
    const pixel = stage.shared.pixel.value;
    const ink = rgb(stage.theme.ghost);
    own.ink.value = ink;
    own.solid.value = ink;
    own.halfOutline.value = 0.8 * pixel;
    own.cover.value = isPlane ? 0 : 0.1;
    this.paint.value.set(ink.x, ink.y, ink.z, 1);
    this.thickness.value = BAR * pixel;
    const late = { blends: true, late: true, writesDepth: false, depth: !isPlane };
    const skin = this.skin.whole;
    if (skin !== null) {
      this.facets.value = skin.corners;
      this.skinMaterial ??= makeMaterial({ vertex: SKIN_VERTEX, fragment: WALL_FRAGMENT, defines: ["INITIAL", ...(isPlane ? [] : ["SPACE"])], uniforms: { ...stage.shared, ...own, facets: this.facets }, ...late });
      this.skinLayer.show(skin.geometry, this.skinMaterial);
    }
    const bars = this.ofBars.whole;
    if (bars !== null) {
      this.bars.value = bars.ends;
      this.barMaterial ??= makeMaterial({ vertex: BAR_VERTEX, fragment: PLAIN_FRAGMENT, defines: ["INITIAL"], uniforms: { ...stage.shared, bars: this.bars, thickness: this.thickness, firstBar: { value: 0 }, paint: this.paint }, ...late });
      this.barLayer.show(bars.geometry, this.barMaterial);
    }
  }

  hide(): void {
    this.skinLayer.hide();
    this.barLayer.hide();
  }

  dispose(): void {
    this.skinMaterial?.dispose();
    this.barMaterial?.dispose();
  }
}
