// Boxes around what is shown, in the tables' coordinates (minus the topology's origin), by which a picture is
// fitted.

import type { Vector } from "../types";

export type Box = [Vector, Vector];

/** Around all nodes as shown; null where there is none that is somewhere. */
export function bodyBox(positions: Float32Array, initial: Float32Array, scale: number): Box | null {
  const low: Vector = [Infinity, Infinity, Infinity];
  const high: Vector = [-Infinity, -Infinity, -Infinity];
  for (let k = 0; k < 3; k++) {
    let [least, most] = [Infinity, -Infinity];
    for (let i = k; i < positions.length; i += 3) {
      const place = initial[i]! + scale * (positions[i]! - initial[i]!);
      if (place < least) least = place;
      if (place > most) most = place;
    }
    [low[k], high[k]] = [least, most];
  }
  return [...low, ...high].every(Number.isFinite) ? [low, high] : null;
}

export function joined(a: Box | null, b: Box): Box {
  if (a === null) return b;
  const of = (k: 0 | 1, choose: (x: number, y: number) => number): Vector => a[k].map((x, i) => choose(x, b[k][i]!)) as Vector;
  return [of(0, Math.min), of(1, Math.max)];
}

/** What of obstacles lies near the bodies: within a quarter of their size. */
export function nearby(obstacles: Box, bodies: Box): Box {
  const room = 0.25 * Math.max(...[0, 1, 2].map((k) => bodies[1][k]! - bodies[0][k]!));
  const held = (x: number, k: number): number => Math.min(Math.max(x, bodies[0][k]! - room), bodies[1][k]! + room);
  return [obstacles[0].map(held) as Vector, obstacles[1].map(held) as Vector];
}

/** Corners of a box and of its images, in the model's coordinates. */
export function corners(box: Box, signs: readonly Vector[], origin: Vector): Vector[] {
  const all: Vector[] = [];
  for (const sign of signs) {
    for (let corner = 0; corner < 8; corner++) {
      all.push([0, 1, 2].map((k) => sign[k]! * (box[(corner >> k) & 1]![k]! + origin[k]!)) as Vector);
    }
  }
  return all;
}
