// What a found row stands for: the node, element and part there, and the value that is shown.

import type { Frame, Topology, Vector } from "../types";
import type { Found } from "./picking";
import type { Colouring } from "./skin";
import type { Pick } from "./viewport";

/** What is drawn, and how it is seen. */
export interface Seen {
  topology: Topology;
  frame: Frame;
  colouring: Colouring;
  /** A skin node's place as shown, m. */
  place: (node: number) => Vector;
  /** How far from the pointer a place of the model is seen, px. */
  away: (place: Vector) => number;
}

const finite = (value: number | undefined): number | null => (value !== undefined && Number.isFinite(value) ? value : null);

/** The number of the least of some values. */
function least(values: number[]): number {
  return values.indexOf(Math.min(...values));
}

export function picked(found: Found, seen: Seen): Pick | null {
  const { topology, frame, colouring } = seen;
  const [facets, bars] = [topology.facets.length / 4, topology.bars.length / 2];
  if (found.row >= facets + bars) return pickedSection(found.row - facets - bars, seen);
  const isBar = found.row >= facets;
  const bar = found.row - facets;
  const nodes = isBar ? [...topology.bars.subarray(2 * bar, 2 * bar + 2)] : [...topology.facets.subarray(4 * found.row, 4 * found.row + 4)];
  const best = least(nodes.map((node) => seen.away(seen.place(node))));
  const node = nodes[best]!;
  const row = { NODE: node, CORNER: isBar ? 4 * facets + 2 * bar + best : 4 * found.row + best, CELL: found.row, PART: -1 }[colouring];
  return {
    node: topology.nodeNumbers[node]!,
    cell: isBar ? topology.barCells[bar]! : topology.facetCells[found.row]!,
    part: isBar ? topology.barParts[bar]! : topology.facetParts[found.row]!,
    facet: found.row,
    position: [0, 1, 2].map((k) => frame.positions[3 * node + k]! + topology.origin[k]!) as Vector,
    value: finite(frame.values[row]),
  };
}

/** Of a section: the element that is cut, and the nearest node of the edges that are cut. */
function pickedSection(triangle: number, { topology, frame, away }: Seen): Pick | null {
  const { sections } = frame;
  if (!sections || triangle >= sections.cells.length) return null;
  // the middle of the polygon is no node
  const corners = [...sections.facets.subarray(3 * triangle, 3 * triangle + 2)];
  const places = corners.map((corner) => [0, 1, 2].map((k) => sections.points[3 * corner + k]! + topology.origin[k]!) as Vector);
  const best = least(places.map(away));
  return {
    node: sections.nodes[corners[best]!]!,
    cell: sections.cells[triangle]!,
    part: sections.parts[triangle]!,
    facet: -1,
    position: places[best]!,
    value: finite(sections.values[frame.location === "cell" ? triangle : corners[best]!]),
  };
}
