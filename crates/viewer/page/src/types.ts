// Types of the contract between the server and the page: what `api/...` answers in JSON, what the heads of
// the binary containers hold, and what `wire.ts` makes of the containers. Data only; nothing here computes.

export type Vector = [number, number, number];

/** A scalar that can be shown as colours. */
export interface Scalar {
  key: string;
  label: string;
  doc: string;
  unit: string;
  location: "cell" | "node";
  starts_at_zero: boolean;
  /** Names of the values 0, 1, 2, …; empty for a measured quantity. */
  states: string[];
}

export interface Part {
  name: string;
  elements: number;
  is_rigid: boolean;
}

export interface Warning {
  code: string;
  text: string;
}

export interface FrameOnDisk {
  number: number;
  time: number;
}

/** A camera as a model file states it (space only). */
export interface ModelCamera {
  from: Vector;
  at: Vector | null;
  up: Vector | null;
  zoom: number;
}

export interface Run {
  name: string;
  title: string;
  path: string;
  command: string | null;
  dimension: 2 | 3;
  axisymmetric: boolean;
  end: number | null;
  energy_unit: string;
  nodes: number;
  elements: number;
  parts: Part[];
  frames: FrameOnDisk[];
  is_over: boolean;
  scalars: Scalar[];
  scalar: string | null;
  has_arrows: boolean;
  arrow_unit: string;
  mirror: [boolean, boolean, boolean];
  camera: ModelCamera | null;
  /** Box of the bodies at the first frame, m. */
  size: [Vector, Vector];
  obstacles: string[];
  contacts: string[];
  summary: Record<string, unknown> | null;
  warnings: Warning[];
  error: string | null;
  size_on_disk: number;
}

/** A folder that could not be read as a run. */
export interface FaultyRun {
  path: string;
  fault: string;
  code: string;
}

export interface Runs {
  version: string;
  view: string;
  live: boolean;
  /** A model before it runs is shown, as a run of one frame. */
  model: boolean;
  runs: (Run | FaultyRun)[];
}

export interface Column {
  name: string;
  unit: string;
}

export interface History {
  columns: Column[];
  values: (number | null)[][];
}

export interface Range {
  range: [number, number] | null;
  frames: number;
}

export interface Probe {
  times: number[];
  values: (number | null)[];
  unit: string;
  label: string;
}

/** Where a node, or the middle of an element, is in all frames, m. */
export interface Track {
  times: number[];
  initial: Vector;
  positions: Vector[];
}

export interface ServerError {
  code: string;
  error: string;
}

/** A coarser level of the skin: fewer facets over the same nodes. */
export interface Level {
  /** Four skin nodes per facet; a triangle repeats its last. */
  facets: Uint32Array;
  /** The facet of the whole skin whose value and part each facet shows. */
  sources: Uint32Array;
}

/** What does not change between frames: the skin's connectivity and the initial positions. */
export interface Topology {
  number: number;
  /** Positions are relative to this point, m. */
  origin: Vector;
  cells: number;
  /** Numbers of the skin's nodes as in the VTU files. */
  nodeNumbers: Uint32Array;
  /** x, y, z per skin node, minus the origin, m. */
  initial: Float32Array;
  facets: Uint32Array;
  facetParts: Uint32Array;
  facetCells: Uint32Array;
  bars: Uint32Array;
  barParts: Uint32Array;
  barCells: Uint32Array;
  /** Coarser levels 1, 2, …; empty for small skins. */
  levels: Level[];
}

/** Rigid obstacles at one instant. */
export interface Obstacles {
  /** x, y, z per point, minus the topology's origin, m. */
  points: Float32Array;
  /** In the plane: pairs of points, the solid on the right of the direction; and each line's obstacle. */
  lines: Uint32Array;
  lineOf: Uint32Array;
  /** In space: four points per facet, a triangle repeats its last; and each facet's obstacle. */
  facets: Uint32Array;
  facetOf: Uint32Array;
}

/** What one plane cuts: its triangles among those of all planes. */
export interface Cut {
  normal: Vector;
  /** m */
  offset: number;
  first: number;
  count: number;
}

/** Cut faces at one instant, in the places where bodies are shown. */
export interface Sections {
  /** One for each mirrored normal; the first cuts the model itself. */
  planes: Cut[];
  /** x, y, z per point, minus the topology's origin, m. */
  points: Float32Array;
  /** The node nearest to each point; 2³² − 1 in the middle of a polygon. */
  nodes: Uint32Array;
  /** Three points each: two corners of the polygon, its middle; cell and part of each. */
  facets: Uint32Array;
  cells: Uint32Array;
  parts: Uint32Array;
  /** Per point, or per triangle where values are those of cells. */
  values: Float32Array;
  /** Glyphs of polygons, in the order of their middles: as those of a frame. */
  glyphVectors: Float32Array;
  glyphValues: Float32Array;
  glyphAxes: Float32Array;
}

/** One instant. */
export interface Frame {
  /** −1 for a live frame between two output times. */
  number: number;
  topology: number;
  /** s */
  time: number;
  step: number | null;
  scalar: string | null;
  /** Where values are: at nodes, of cells, or at the corners of facets and then bars (averaged). */
  location: "node" | "cell" | "corner" | null;
  /** Smallest and largest finite value of this frame's skin and sections. */
  range: [number, number] | null;
  /** x, y, z per skin node, minus the topology's origin, m. */
  positions: Float32Array;
  /** Per skin node, or per facet and then per bar; NaN = no value; empty without a scalar. */
  values: Float32Array;
  /** Skin nodes with a contact force, and x, y, z of each force; empty if not asked for. */
  arrowNodes: Uint32Array;
  arrows: Float32Array;
  /** Per skin node a vector, or per facet three principal values and three unit vectors; empty if not asked for. */
  glyphVectors: Float32Array;
  glyphValues: Float32Array;
  glyphAxes: Float32Array;
  sections: Sections | null;
  obstacles: Obstacles | null;
}

export interface Progress {
  kind: "progress";
  state: "running" | "paused" | "stopping";
  step: number;
  time: number;
  end: number | null;
  time_step: number;
  governor: string;
  energy_drift: number | null;
  seconds: number;
  left: number | null;
  dropped: number;
}

export type LiveMessage =
  | Progress
  | { kind: "notices"; notices: Warning[] }
  | { kind: "kept"; text: string }
  | { kind: "refused"; text: string }
  | { kind: "ended"; status: "done" | "stopped" | "failed"; error: string | null; stays: boolean };
