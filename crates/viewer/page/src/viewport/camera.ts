// The camera's mathematics: an orthographic camera that is fitted, turned about the model's vertical, moved
// and brought closer. Works in metres of the model; `viewport` hands the result to three and `controls` moves
// it.

import { Matrix4, type OrthographicCamera, Vector3 } from "three";
import type { Vector } from "../types";

/** Orthographic camera; `height` = metres seen vertically. In the plane it looks along −z. */
export interface Camera {
  position: Vector;
  target: Vector;
  up: Vector;
  height: number;
}

export type Direction = "x" | "-x" | "y" | "-y" | "z" | "-z" | "iso";

/** Directions of the picture in the model: to the right, up, and towards the camera. */
export interface Basis {
  right: Vector;
  up: Vector;
  back: Vector;
}

export const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vector, b: Vector): Vector => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
/** a + t · b */
export const along = (a: Vector, b: Vector, t: number): Vector => [a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]];
const size = (a: Vector): number => Math.sqrt(dot(a, a));
const unit = (a: Vector, otherwise: Vector): Vector => {
  const length = size(a);
  return length > 0 && Number.isFinite(length) ? [a[0] / length, a[1] / length, a[2] / length] : otherwise;
};

/** Turns `v` by `angle` about the unit vector `axis` (Rodrigues). */
function turned(v: Vector, axis: Vector, angle: number): Vector {
  const c = Math.cos(angle);
  const s = Math.sin(angle);
  const w = cross(axis, v);
  const k = dot(axis, v) * (1 - c);
  return [v[0] * c + w[0] * s + axis[0] * k, v[1] * c + w[1] * s + axis[1] * k, v[2] * c + w[2] * s + axis[2] * k];
}

export function basisOf(camera: Camera): Basis {
  const back = unit(along(camera.position, camera.target, -1), [0, 0, 1]);
  let right = cross(camera.up, back);
  if (size(right) < 1e-9 * size(camera.up) || size(right) === 0) right = cross(Math.abs(back[2]) < 0.9 ? [0, 0, 1] : [0, 1, 0], back);
  right = unit(right, [1, 0, 0]);
  return { right, up: cross(back, right), back };
}

/** Smallest and largest coordinates of what is shown along three directions. */
export type Extents = (basis: Basis) => [Vector, Vector];

/** Room around a fitted picture, as a factor. */
const MARGIN = 1.16;
/** A camera does not come closer to the vertical than this, so that "up" stays defined (radians). */
const POLE = 0.02;

export class Rig {
  camera: Camera;
  /** The camera follows what is shown until someone moves it. */
  isFree = true;
  private readonly first: Vector;
  private readonly vertical: Vector;

  constructor(
    readonly isPlane: boolean,
    from: Vector | null,
    up: Vector | null,
  ) {
    this.vertical = isPlane ? [0, 1, 0] : unit(up ?? [0, 0, 1], [0, 0, 1]);
    this.first = isPlane ? [0, 0, 1] : unit(from ?? [0.6, -1, 0.5], [0.51, -0.75, 0.43]);
    this.camera = { position: [...this.first], target: [0, 0, 0], up: [...this.vertical], height: 1 };
  }

  get basis(): Basis {
    return basisOf(this.camera);
  }

  /** Takes over a camera; nonsense in it (of a link by hand) is fixed. */
  set(camera: Camera): void {
    const finite = (v: Vector, otherwise: Vector): Vector => (Array.isArray(v) && v.length === 3 && v.every(Number.isFinite) ? [...v] : otherwise);
    const target = finite(camera.target, [0, 0, 0]);
    const height = Number.isFinite(camera.height) && camera.height > 0 ? camera.height : this.camera.height;
    const position = this.isPlane ? along(target, [0, 0, 1], height) : finite(camera.position, along(target, this.first, height));
    this.camera = { position, target, up: this.isPlane ? [0, 1, 0] : finite(camera.up, this.vertical), height };
    this.isFree = false;
  }

  private place(back: Vector, up: Vector): void {
    const { target, height } = this.camera;
    this.camera = { target, height, up, position: along(target, back, height) };
  }

  /** Looks at all that is shown, from where the camera stands. */
  fit(extents: Extents, aspect: number, zoom = 1, at: Vector | null = null): void {
    const basis = this.basis;
    const [low, high] = extents(basis);
    if (![...low, ...high].every(Number.isFinite)) return;
    const middle: Vector = [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.5 * (low[2] + high[2])];
    const largest = Math.max(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
    const height = Math.max((high[0] - low[0]) / aspect, high[1] - low[1], 1e-3 * largest, 1e-12) * MARGIN;
    const target = at ?? along(along(along([0, 0, 0], basis.right, middle[0]), basis.up, middle[1]), basis.back, middle[2]);
    this.camera = { ...this.camera, target, height: height / zoom };
    this.place(basis.back, this.camera.up);
    this.isFree = true;
  }

  look(direction: Direction): void {
    if (this.isPlane) return;
    if (direction === "iso") return this.place(this.first, [...this.vertical]);
    const axis = "xyz".indexOf(direction.at(-1)!);
    const back: Vector = [0, 0, 0];
    back[axis] = direction.startsWith("-") ? -1 : 1;
    const isAbove = Math.abs(dot(back, this.vertical)) > 0.999;
    const level: Vector = Math.abs(this.vertical[1]) < 0.9 ? [0, 1, 0] : [0, 0, -back[1]];
    this.place(back, isAbove ? level : [...this.vertical]);
  }

  /** Turns by radians: to the right about the model's vertical, and up. */
  orbit(dx: number, dy: number): void {
    if (this.isPlane) return;
    let { up, back, right } = this.basis;
    // Upside down the vertical turns the other way.
    const sense = dot(up, this.vertical) < 0 ? 1 : -1;
    [up, back, right] = [turned(up, this.vertical, sense * dx), turned(back, this.vertical, sense * dx), turned(right, this.vertical, sense * dx)];
    const angle = Math.acos(Math.min(Math.max(dot(back, this.vertical), -1), 1));
    const rises = dot(up, this.vertical) < 0 ? -1 : 1;
    const wanted = Math.min(Math.max(angle - rises * dy, Math.min(angle, POLE)), Math.max(angle, Math.PI - POLE));
    const turn = rises * (wanted - angle);
    this.place(unit(turned(back, right, turn), back), unit(turned(up, right, turn), up));
    this.isFree = false;
  }

  /** Moves the picture by fractions of its height, right and up. */
  pan(dx: number, dy: number): void {
    const { right, up, back } = this.basis;
    const { height } = this.camera;
    this.camera.target = along(along(this.camera.target, right, -dx * height), up, -dy * height);
    this.place(back, this.camera.up);
    this.isFree = false;
  }

  /** Closer by `factor`; the point at these fractions of the height from the middle (right, up) stays where it is. */
  zoom(factor: number, x = 0, y = 0): void {
    const height = this.camera.height / factor;
    if (!(height > 1e-12 && height < 1e12)) return;
    const { right, up, back } = this.basis;
    const moved = this.camera.height - height;
    this.camera.target = along(along(this.camera.target, right, x * moved), up, y * moved);
    this.camera.height = height;
    this.place(back, this.camera.up);
    this.isFree = false;
  }

  /** Sets three's camera so that a sphere (all that is shown) lies between its near and far planes. */
  apply(to: OrthographicCamera, aspect: number, middle: Vector, radius: number): void {
    const { right, up, back } = this.basis;
    const { target, height } = this.camera;
    const reach = radius * 1.02 + 1e-3 * height;
    const away = Math.abs(dot(along(middle, target, -1), back)) + reach;
    const eye = along(target, back, away);
    to.top = 0.5 * height;
    to.bottom = -to.top;
    to.right = to.top * aspect;
    to.left = -to.right;
    to.near = 0;
    to.far = 2 * away;
    to.matrixAutoUpdate = false;
    to.matrix.copy(new Matrix4().makeBasis(new Vector3(...right), new Vector3(...up), new Vector3(...back)).setPosition(...eye));
    to.matrixWorldNeedsUpdate = true;
    to.updateMatrixWorld(true);
    to.updateProjectionMatrix();
  }
}
