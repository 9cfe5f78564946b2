// Decodes the binary container of topologies and frames: "EMB1", the head's length, the head in JSON, then
// arrays in little-endian order. The arrays are views into the received buffer: nothing is copied. What does
// not fit (a wrong mark, an array outside the buffer, indices outside their table) is refused with a text for
// people.

import type { Cut, Frame, Level, Obstacles, Sections, Topology, Vector } from "./types";

/** The bytes are not what the contract says. */
export class WireError extends Error {
  override name = "WireError";
}

type Kind = "f32" | "u32" | "f64";
interface ArrayHead {
  type: Kind;
  offset: number;
  count: number;
}

export interface Container {
  head: Record<string, unknown>;
  f32(name: string): Float32Array;
  u32(name: string): Uint32Array;
  has(name: string): boolean;
}

/** Opens a container. Arrays that it does not have are read as empty ones. */
export function openContainer(buffer: ArrayBuffer): Container {
  const bytes = new DataView(buffer);
  if (buffer.byteLength < 8 || bytes.getUint32(0, false) !== 0x454d4231) {
    throw new WireError("the answer does not begin with EMB1: it is not a frame or topology of embate");
  }
  const length = bytes.getUint32(4, true);
  const start = 8 + length;
  if (start > buffer.byteLength) throw new WireError(`the head of ${length} bytes is longer than the answer of ${buffer.byteLength} bytes`);
  if (start % 8 !== 0) throw new WireError(`the head's length ${length} is not a multiple of 8`);
  let head: Record<string, unknown>;
  try {
    head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 8, length))) as Record<string, unknown>;
  } catch (fault) {
    throw new WireError(`the head is not JSON: ${String(fault)}`);
  }
  const arrays = (head["arrays"] ?? {}) as Record<string, ArrayHead | undefined>;

  const place = (name: string, kind: Kind): { at: number; count: number } | null => {
    const array = arrays[name];
    if (array === undefined) return null;
    if (array.type !== kind) throw new WireError(`array ${name} holds ${array.type}, ${kind} is wanted`);
    const size = kind === "f64" ? 8 : 4;
    const at = start + array.offset;
    if (!(array.offset >= 0 && array.count >= 0 && array.offset % 8 === 0 && at + size * array.count <= buffer.byteLength)) {
      throw new WireError(`array ${name} (${array.count} numbers at ${array.offset}) is not inside the answer of ${buffer.byteLength} bytes`);
    }
    return { at, count: array.count };
  };
  return {
    head,
    has: (name) => arrays[name] !== undefined,
    f32: (name) => {
      const found = place(name, "f32");
      return found === null ? new Float32Array(0) : new Float32Array(buffer, found.at, found.count);
    },
    u32: (name) => {
      const found = place(name, "u32");
      return found === null ? new Uint32Array(0) : new Uint32Array(buffer, found.at, found.count);
    },
  };
}

/** Refuses indices that do not point into a table of `limit` rows. */
function within(name: string, indices: Uint32Array, limit: number): void {
  let largest = -1;
  for (let i = 0; i < indices.length; i++) {
    const index = indices[i]!;
    if (index > largest) largest = index;
  }
  if (largest >= limit) throw new WireError(`array ${name} points to row ${largest} of ${limit}`);
}

function rows(name: string, array: { length: number }, width: number, wanted?: number): number {
  if (array.length % width !== 0) throw new WireError(`array ${name} has ${array.length} numbers, not a multiple of ${width}`);
  const count = array.length / width;
  if (wanted !== undefined && count !== wanted) throw new WireError(`array ${name} has ${count} rows, ${wanted} are wanted`);
  return count;
}

function vector(value: unknown): Vector {
  const list = Array.isArray(value) ? (value as unknown[]) : [];
  return [Number(list[0] ?? 0), Number(list[1] ?? 0), Number(list[2] ?? 0)];
}

function range(value: unknown): [number, number] | null {
  if (!Array.isArray(value)) return null;
  const [low, high] = value as unknown[];
  return typeof low === "number" && typeof high === "number" ? [low, high] : null;
}

/** What is drawn of one kind: nodes of each, its part and its cell. */
function drawn(container: Container, kind: "facet" | "bar", width: number, limit: number) {
  const nodes = container.u32(`${kind}s`);
  const count = rows(`${kind}s`, nodes, width);
  within(`${kind}s`, nodes, limit);
  const [parts, cells] = [container.u32(`${kind}_parts`), container.u32(`${kind}_cells`)];
  rows(`${kind}_parts`, parts, 1, count);
  rows(`${kind}_cells`, cells, 1, count);
  return { nodes, parts, cells };
}

/** A topology as `api/runs/R/topology/T` answers it. */
export function decodeTopology(buffer: ArrayBuffer): Topology {
  const container = openContainer(buffer);
  const nodeNumbers = container.u32("node_numbers");
  const initial = container.f32("initial");
  rows("initial", initial, 3, nodeNumbers.length);
  const facets = drawn(container, "facet", 4, nodeNumbers.length);
  const bars = drawn(container, "bar", 2, nodeNumbers.length);
  const levels: Level[] = [];
  for (let level = 1; container.has(`facets_${level}`); level++) {
    const coarse = container.u32(`facets_${level}`);
    const sources = container.u32(`sources_${level}`);
    rows(`sources_${level}`, sources, 1, rows(`facets_${level}`, coarse, 4));
    within(`facets_${level}`, coarse, nodeNumbers.length);
    within(`sources_${level}`, sources, facets.cells.length);
    levels.push({ facets: coarse, sources });
  }
  return {
    number: Number(container.head["topology"] ?? 0),
    origin: vector(container.head["origin"]),
    cells: Number(container.head["cells"] ?? 0),
    nodeNumbers,
    initial,
    facets: facets.nodes,
    facetParts: facets.parts,
    facetCells: facets.cells,
    bars: bars.nodes,
    barParts: bars.parts,
    barCells: bars.cells,
    levels,
  };
}

function decodeObstacles(container: Container): Obstacles | null {
  if (!container.has("obstacle_points")) return null;
  const points = container.f32("obstacle_points");
  const count = rows("obstacle_points", points, 3);
  const lines = container.u32("obstacle_lines");
  within("obstacle_lines", lines, count);
  const lineOf = container.u32("obstacle_line_of");
  rows("obstacle_line_of", lineOf, 1, rows("obstacle_lines", lines, 2));
  const facets = container.u32("obstacle_facets");
  within("obstacle_facets", facets, count);
  const facetOf = container.u32("obstacle_facet_of");
  rows("obstacle_facet_of", facetOf, 1, rows("obstacle_facets", facets, 4));
  return { points, lines, lineOf, facets, facetOf };
}

function decodeSections(container: Container): Sections | null {
  const heads = container.head["sections"];
  if (!Array.isArray(heads)) return null;
  const points = container.f32("section_points");
  const facets = container.u32("section_facets");
  const [cells, parts, values, nodes] = [container.u32("section_cells"), container.u32("section_parts"), container.f32("section_values"), container.u32("section_nodes")];
  const [pointCount, count] = [rows("section_points", points, 3), rows("section_facets", facets, 3)];
  within("section_facets", facets, pointCount);
  rows("section_nodes", nodes, 1, pointCount);
  rows("section_cells", cells, 1, count);
  rows("section_parts", parts, 1, count);
  let first = 0;
  const planes = (heads as Record<string, unknown>[]).map((head): Cut => {
    const cut = { normal: vector(head["normal"]), offset: Number(head["offset"] ?? 0), first, count: Number(head["facets"] ?? 0) };
    first += cut.count;
    return cut;
  });
  if (first !== count) throw new WireError(`the planes of the sections have ${first} triangles, array section_facets has ${count}`);
  const glyphs = { glyphVectors: container.f32("section_glyph_vectors"), glyphValues: container.f32("section_glyph_values"), glyphAxes: container.f32("section_glyph_axes") };
  return { planes, points, nodes, facets, cells, parts, values, ...glyphs };
}

/** A frame as `api/runs/R/frames/N` answers it or the live connection sends it. */
export function decodeFrame(buffer: ArrayBuffer): Frame {
  const container = openContainer(buffer);
  const head = container.head;
  const positions = container.f32("positions");
  const nodes = rows("positions", positions, 3);
  const arrowNodes = container.u32("arrow_nodes");
  within("arrow_nodes", arrowNodes, nodes);
  const arrows = container.f32("arrows");
  rows("arrows", arrows, 3, arrowNodes.length);
  const step = head["step"];
  const scalar = head["scalar"];
  const location = head["location"];
  return {
    number: Number(head["frame"] ?? -1),
    topology: Number(head["topology"] ?? 0),
    time: Number(head["time"] ?? 0),
    step: typeof step === "number" ? step : null,
    scalar: typeof scalar === "string" ? scalar : null,
    location: location === "node" || location === "cell" || location === "corner" ? location : null,
    range: range(head["range"]),
    positions,
    values: container.f32("values"),
    arrowNodes,
    arrows,
    glyphVectors: container.f32("glyph_vectors"),
    glyphValues: container.f32("glyph_values"),
    glyphAxes: container.f32("glyph_axes"),
    sections: decodeSections(container),
    obstacles: decodeObstacles(container),
  };
}
