// What all drawn things share: the scene with one group per mirror image, the numbers (uniforms) that all
// programs read, and layers: one geometry and material, drawn once per image. Built by `viewport`, used by
// `skin`, `bars`, `arrows`, `obstacles`.

import {
  BufferAttribute,
  BufferGeometry,
  CustomBlending,
  DataTexture,
  DoubleSide,
  GLSL3,
  Group,
  Matrix4,
  Mesh,
  NearestFilter,
  NoBlending,
  OneFactor,
  OneMinusSrcAlphaFactor,
  RawShaderMaterial,
  RGBAFormat,
  Scene,
  UnsignedByteType,
  Vector2,
  Vector3,
  Vector4,
} from "three";
import { BACKGROUND, LEVELS, type MapName, NO_VALUE, partColour, table } from "../colormap";
import type { Vector } from "../types";
import { Table } from "./store";

export interface Uniform<T = unknown> {
  value: T;
}
export type Uniforms = Record<string, Uniform>;

/** A CSS colour #rrggbb as three numbers up to 1. */
export function rgb(colour: string): Vector3 {
  const number = parseInt(colour.slice(1), 16);
  return new Vector3(((number >> 16) & 255) / 255, ((number >> 8) & 255) / 255, (number & 255) / 255);
}

function colourTexture(colours: Uint8Array<ArrayBuffer>): DataTexture {
  const texture = new DataTexture(colours, colours.length / 4, 1, RGBAFormat, UnsignedByteType);
  texture.minFilter = NearestFilter;
  texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  return texture;
}

/** Colours that depend on the theme. */
export const THEMES = {
  light: { paper: BACKGROUND.light, noValue: NO_VALUE.light, ink: "#10121c", obstacle: "#4a515c", solid: "#aab2bd", wall: "#7d8794", arrow: "#c4103c", pushed: "#0d5fc4", ghost: "#5b6470", halo: "#ffffff", text: "#22262e", accent: "#0b5fb0" },
  dark: { paper: BACKGROUND.dark, noValue: NO_VALUE.dark, ink: "#07080c", obstacle: "#c3cad4", solid: "#4b535f", wall: "#9aa4b2", arrow: "#ff5c7a", pushed: "#6cb2ff", ghost: "#b4bdc8", halo: "#0b0d10", text: "#e6e9ee", accent: "#7cbcff" },
} as const;
export type Theme = (typeof THEMES)["light"] | (typeof THEMES)["dark"];

export class Stage {
  readonly scene = new Scene();
  readonly images: Group[] = [];
  /** How many of the groups are drawn, and the signs of their axes. */
  imageCount = 1;
  signs: Vector[] = [[1, 1, 1]];
  readonly positions = new Table("vector");
  readonly initials = new Table("vector");
  readonly values = new Table("value");
  readonly shared = {
    positions: { value: this.positions.texture },
    initials: { value: this.initials.texture },
    values: { value: this.values.texture },
    scale: { value: 1 },
    colours: { value: colourTexture(new Uint8Array(4 * LEVELS)) },
    partColours: { value: colourTexture(new Uint8Array(4)) },
    range: { value: new Vector2(0, 1) },
    bands: { value: 0 },
    noValue: { value: rgb(NO_VALUE.light) },
    ink: { value: rgb(THEMES.light.ink) },
    canvas: { value: new Vector2(1, 1) },
    pixel: { value: 1 },
    /** Of a section, in the camera's coordinates: what lies beyond is not drawn where `CLIP` is defined. */
    clip: { value: new Vector4() },
    /** First row of the values of nodes behind those of corners. */
    nodeRows: { value: 0 },
    /** Added to the numbers of facets where they are written as colours. */
    firstRow: { value: 0 },
    isoSteps: { value: 10 },
    /** 1 for each axis across whose plane the model is mirrored; the tables' origin; what counts as on the plane, m. */
    halved: { value: new Vector3() },
    origin: { value: new Vector3() },
    onPlane: { value: 0 },
  };
  theme: Theme = THEMES.light;
  /** Whether bodies are cut by `shared.clip`. */
  isCut = false;

  constructor(
    readonly isPlane: boolean,
    parts: number,
  ) {
    this.scene.matrixAutoUpdate = false;
    for (let i = 0; i < 8; i++) {
      const group = new Group();
      group.matrixAutoUpdate = false;
      this.images.push(group);
      this.scene.add(group);
    }
    const colours = new Uint8Array(4 * Math.min(Math.max(parts, 1), 2048));
    for (let i = 0; i < colours.length / 4; i++) colours.set([...partColour(i), 255], 4 * i);
    this.shared.partColours.value = colourTexture(colours);
    this.setMap("viridis");
  }

  setMap(map: MapName): void {
    this.shared.colours.value.dispose();
    this.shared.colours.value = colourTexture(new Uint8Array(table(map)));
  }

  setDark(dark: boolean): void {
    this.theme = dark ? THEMES.dark : THEMES.light;
    this.shared.noValue.value = rgb(this.theme.noValue);
    this.shared.ink.value = rgb(this.theme.ink);
  }

  /** Textures may be others after their tables grew. */
  refresh(): void {
    this.shared.positions.value = this.positions.texture;
    this.shared.initials.value = this.initials.texture;
    this.shared.values.value = this.values.texture;
  }

  /** Places the images: the model itself and its reflections across the planes x = 0, y = 0, z = 0. */
  setImages(mirror: readonly boolean[], origin: Vector): Vector[] {
    const signs = imageSigns(mirror);
    this.imageCount = signs.length;
    this.signs = signs;
    this.shared.halved.value.set(...([0, 1, 2].map((k) => (mirror[k] === true ? 1 : 0)) as Vector));
    this.shared.origin.value.set(...origin);
    this.images.forEach((group, i) => {
      const sign = signs[i];
      group.visible = sign !== undefined;
      if (sign === undefined) return;
      group.matrix.copy(imageMatrix(sign, origin));
      group.matrixWorldNeedsUpdate = true;
    });
    return signs;
  }

  dispose(): void {
    for (const table of [this.positions, this.initials, this.values]) table.dispose();
    this.shared.colours.value.dispose();
    this.shared.partColours.value.dispose();
  }
}

/** Signs of x, y, z of the images: of the model itself first. */
export function imageSigns(mirror: readonly boolean[]): Vector[] {
  let signs: Vector[] = [[1, 1, 1]];
  for (let axis = 0; axis < 3; axis++) {
    if (mirror[axis] !== true) continue;
    signs = signs.concat(signs.map((sign) => sign.map((s, k) => (k === axis ? -s : s)) as Vector));
  }
  return signs;
}

/** From what stands in the tables (minus the origin) to the model's coordinates of an image. */
export function imageMatrix(sign: Vector, origin: Vector): Matrix4 {
  return new Matrix4().makeScale(...sign).setPosition(sign[0] * origin[0], sign[1] * origin[1], sign[2] * origin[2]);
}

export interface MaterialOptions {
  vertex: string;
  fragment: string;
  defines: readonly string[];
  uniforms: Uniforms;
  depth?: boolean;
  /** Blends with what is behind. */
  blends?: boolean;
  /** Is drawn after all opaque things. */
  late?: boolean;
  writesDepth?: boolean;
}

export function makeMaterial(options: MaterialOptions): RawShaderMaterial {
  const depth = options.depth ?? true;
  const material = new RawShaderMaterial({
    glslVersion: GLSL3,
    vertexShader: options.vertex,
    fragmentShader: options.fragment,
    defines: Object.fromEntries(options.defines.map((name) => [name, ""])),
    uniforms: options.uniforms,
    side: DoubleSide,
    depthTest: depth,
    depthWrite: depth && (options.writesDepth ?? true),
    blending: options.blends === true ? CustomBlending : NoBlending,
    // The picture is laid over the paper afterwards by its alpha, which must be the share of the paper that
    // is covered.
    blendSrcAlpha: OneFactor,
    blendDstAlpha: OneMinusSrcAlphaFactor,
    transparent: options.late === true,
  });
  return material;
}

/** A geometry without vertices of its own: only their numbers, 4 per facet, edge or bar. */
export function numbered(index: Uint32Array | null, count = 0): BufferGeometry {
  const geometry = new BufferGeometry();
  if (index !== null) geometry.setIndex(new BufferAttribute(index, 1));
  geometry.setDrawRange(0, index === null ? count : index.length);
  return geometry;
}

/** Numbers of two triangles for each of `count` quadrilaterals of four vertices. */
export function quads(count: number): Uint32Array {
  const index = new Uint32Array(6 * count);
  for (let i = 0; i < count; i++) index.set([4 * i, 4 * i + 1, 4 * i + 2, 4 * i, 4 * i + 2, 4 * i + 3], 6 * i);
  return index;
}

const NOTHING = new BufferGeometry();
NOTHING.setDrawRange(0, 0);

/** One geometry and material, once per image. */
export class Layer {
  private readonly meshes: Mesh[];

  constructor(
    private readonly stage: Stage,
    order: number,
  ) {
    this.meshes = stage.images.map((group) => {
      const mesh = new Mesh<BufferGeometry, RawShaderMaterial>(NOTHING);
      mesh.frustumCulled = false;
      mesh.matrixAutoUpdate = false;
      mesh.renderOrder = order;
      mesh.visible = false;
      group.add(mesh);
      return mesh;
    });
  }

  /** `images`: in which it is drawn; without them in all. */
  show(geometry: BufferGeometry, material: RawShaderMaterial, images?: readonly boolean[]): void {
    this.meshes.forEach((mesh, i) => {
      mesh.geometry = geometry;
      mesh.material = material;
      mesh.visible = i < this.stage.imageCount && images?.[i] !== false;
    });
  }

  hide(): void {
    for (const mesh of this.meshes) mesh.visible = false;
  }
}
