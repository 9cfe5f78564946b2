// Which sides of facets are outlines: sides of one facet only, sides between two parts, and in 3D creases.
// The answer stands in the highest bit of each corner: that of corner k for the side from it to the next.
// Read by `shaders`.

const MARK = 0x80000000;

/** Cosine of the angle between two facets from which on their common side is a crease (30°). */
const CREASE = 0.866;

/** Unit normals of facets, by their diagonals; of triangles by two sides. */
function normals(facets: Uint32Array, points: Float32Array): Float32Array {
  const count = facets.length / 4;
  const out = new Float32Array(3 * count);
  for (let f = 0; f < count; f++) {
    const a = 3 * facets[4 * f]!;
    const b = 3 * facets[4 * f + 1]!;
    const c = 3 * facets[4 * f + 2]!;
    const d = 3 * facets[4 * f + 3]!;
    const [ux, uy, uz] = [points[c]! - points[a]!, points[c + 1]! - points[a + 1]!, points[c + 2]! - points[a + 2]!];
    const end = c === d ? a : d;
    const [vx, vy, vz] = [points[end]! - points[b]!, points[end + 1]! - points[b + 1]!, points[end + 2]! - points[b + 2]!];
    const [x, y, z] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    const size = Math.sqrt(x * x + y * y + z * z) || 1;
    out[3 * f] = x / size;
    out[3 * f + 1] = y / size;
    out[3 * f + 2] = z / size;
  }
  return out;
}

/**
 * Copies facets into `out` with their outlines marked. `partOf` gives a facet's part; `points` (space only) the places
 * by which creases are found.
 */
export function markOutlines(facets: Uint32Array, nodes: number, partOf: (facet: number) => number, points: Float32Array | null, out: Uint32Array): void {
  const sides = facets.length;
  const next = (side: number): number => {
    const first = side & ~3;
    const isTriangle = facets[first + 2] === facets[first + 3];
    const corner = side - first;
    return facets[first + (corner === (isTriangle ? 2 : 3) ? 0 : corner + 1)]!;
  };
  // Sides sorted by the smaller of their two nodes: those of one node stand together, and few are compared.
  const starts = new Uint32Array(nodes + 2);
  const smaller = (side: number): number => Math.min(facets[side]!, next(side));
  const isSide = (side: number): boolean => (side & 3) !== 3 || facets[side] !== facets[side - 1];
  for (let side = 0; side < sides; side++) if (isSide(side)) starts[smaller(side) + 2]!++;
  for (let n = 2; n < nodes + 2; n++) starts[n]! += starts[n - 1]!;
  const sorted = new Uint32Array(starts[nodes + 1]!);
  for (let side = 0; side < sides; side++) if (isSide(side)) sorted[starts[smaller(side) + 1]!++] = side;

  const normal = points === null ? null : normals(facets, points);
  const isBorder = (f: number, g: number): boolean => {
    if (partOf(f) !== partOf(g)) return true;
    if (normal === null) return false;
    return normal[3 * f]! * normal[3 * g]! + normal[3 * f + 1]! * normal[3 * g + 1]! + normal[3 * f + 2]! * normal[3 * g + 2]! < CREASE;
  };
  out.set(facets);
  const larger = (side: number): number => Math.max(facets[side]!, next(side));
  for (let n = 0; n < nodes; n++) {
    for (let i = starts[n]!; i < starts[n + 1]!; i++) {
      const side = sorted[i]!;
      const end = larger(side);
      let partners = 0;
      let border = false;
      for (let j = starts[n]!; j < starts[n + 1]!; j++) {
        if (j === i || larger(sorted[j]!) !== end) continue;
        partners++;
        border = isBorder(side >> 2, sorted[j]! >> 2);
      }
      if (partners !== 1 || border) out[side] = (out[side]! | MARK) >>> 0;
    }
  }
}
