// What lies under the pointer, or nearest to it within some pixels: facets and bars are drawn once more, into
// a few pixels, with their numbers as colours.

import { type BufferGeometry, Group, Mesh, type OrthographicCamera, type RawShaderMaterial, Scene, UnsignedByteType, WebGLRenderTarget, type WebGLRenderer } from "three";
import type { Bars } from "./bars";
import type { Caps } from "./caps";
import type { Skin } from "./skin";
import type { Stage } from "./stage";

export interface Found {
  /** Facet, after the facets bar, after the bars triangle of a section. */
  row: number;
  /** Which mirror image. */
  image: number;
}

/** Pixels that are looked at on each side of the pointer: bodies may be thinner than a hand is steady. */
const NEAR = 6;
const SIDE = 2 * NEAR + 1;

/** Geometry and program that write numbers, and the images in which it is there. */
export type Pickable = [BufferGeometry, RawShaderMaterial, (readonly boolean[])?];

export class Picker {
  private readonly target = new WebGLRenderTarget(SIDE, SIDE, { type: UnsignedByteType, depthBuffer: true });
  private readonly scene = new Scene();
  private readonly group = new Group();
  private readonly image = { value: 0 };
  private readonly pixels = new Uint8Array(4 * SIDE * SIDE);

  constructor(
    private readonly renderer: WebGLRenderer,
    private readonly stage: Stage,
    private readonly skin: Skin,
    private readonly bars: Bars,
    private readonly caps: Caps,
  ) {
    this.scene.matrixAutoUpdate = false;
    this.group.matrixAutoUpdate = false;
    this.scene.add(this.group);
  }

  /** What a camera sees nearest to this pixel of a picture of this size; null: nothing is near. */
  at(camera: OrthographicCamera, x: number, y: number, width: number, height: number): Found | null {
    this.group.clear();
    const drawn = [this.skin.forPick(this.image), this.bars.forPick(this.image), ...this.caps.forPick(this.image)];
    const meshes = drawn.flatMap((one): [Mesh<BufferGeometry, RawShaderMaterial>, readonly boolean[] | undefined][] => {
      if (one === null) return [];
      const mesh = new Mesh(one[0], one[1]);
      mesh.frustumCulled = false;
      mesh.matrixAutoUpdate = false;
      mesh.renderOrder = this.group.children.length;
      this.group.add(mesh);
      return [[mesh, one[2]]];
    });
    const { renderer, stage } = this;
    const canvas = stage.shared.canvas.value;
    const [wide, high] = [canvas.x, canvas.y];
    camera.setViewOffset(width, height, Math.floor(x) - NEAR, Math.floor(y) - NEAR, SIDE, SIDE);
    canvas.set(SIDE, SIDE);
    renderer.setRenderTarget(this.target);
    renderer.clear();
    renderer.autoClear = false;
    for (let image = 0; image < stage.imageCount; image++) {
      this.image.value = image;
      for (const [mesh, images] of meshes) mesh.visible = images?.[image] !== false;
      this.group.matrix.copy(stage.images[image]!.matrix);
      this.group.matrixWorldNeedsUpdate = true;
      renderer.render(this.scene, camera);
    }
    renderer.readRenderTargetPixels(this.target, 0, 0, SIDE, SIDE, this.pixels);
    renderer.autoClear = true;
    renderer.setRenderTarget(null);
    canvas.set(wide, high);
    camera.clearViewOffset();
    return this.nearest();
  }

  /** The pixel with a number that is nearest to the middle. */
  private nearest(): Found | null {
    let best: Found | null = null;
    let least = Infinity;
    for (let i = 0; i < SIDE * SIDE; i++) {
      const [r, g, b, a] = this.pixels.subarray(4 * i, 4 * i + 4) as unknown as [number, number, number, number];
      const code = r + 256 * g + 65_536 * b;
      const away = ((i % SIDE) - NEAR) ** 2 + (Math.floor(i / SIDE) - NEAR) ** 2;
      if (a < 128 || code === 0 || away >= least) continue;
      least = away;
      best = { row: code - 1, image: a - 128 };
    }
    return best;
  }

  /** Waits until all is drawn, by reading a pixel of the picture. */
  finish(): void {
    const context = this.renderer.getContext();
    context.readPixels(0, 0, 1, 1, context.RGBA, context.UNSIGNED_BYTE, this.pixels);
  }

  dispose(): void {
    this.target.dispose();
  }
}
