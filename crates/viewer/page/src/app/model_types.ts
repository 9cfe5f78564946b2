// Types of what `api/model` answers: a model before it runs. Data only.

import type { Vector } from "../types";

/** How a glyph is drawn; see the program's list of kinds. */
export type GlyphSymbol = "arrow" | "push" | "support" | "dot" | "ring" | "line" | "plane";

export interface GlyphKind {
  name: string;
  label: string;
  symbol: GlyphSymbol;
  colour: Vector;
}

/** Something of the model that is drawn on its bodies. */
export interface Glyph {
  /** Name of its kind. */
  kind: string;
  name: string;
  /** Path of its section in the file: `constraint[0]`. */
  path: string;
  /** Its keys as they are written, or the message of a fault. */
  text: string;
  /** m */
  points: Vector[];
  /** Direction of each symbol; of a dot the outward normal of its surface, of a ring its radius (m) in x. */
  vectors: Vector[];
}

/** A fault or a warning with its place in the file. */
export interface Remark {
  code: string;
  title: string;
  file: string;
  /** From 1; 0: it belongs to no line. */
  line: number;
  column: number;
  path: string;
  message: string;
  consequence: string;
  help: string;
}

export interface PartRow {
  name: string;
  /** Kind of element and how many. */
  kinds: [string, number][];
  nodes: number;
  mass: number;
  /** Sides of its box, m. */
  size: number[];
  /** m/s */
  wave_speed: number;
  is_rigid: boolean;
  governs: boolean;
  /** s */
  stable_step: number | null;
}

/** A state of the model file. */
export interface About {
  version: number;
  path: string;
  /** Whether anything can be drawn. */
  has_bodies: boolean;
  /** Whether all faults were looked for: large models are shown before. */
  is_checked: boolean;
  faults: Remark[];
  warnings: Remark[];
  kinds: GlyphKind[];
  glyphs: Glyph[];
  parts: PartRow[];
  mass_unit: string;
  step: { first: number; governor: string; count: number } | null;
  /** s */
  end: number | null;
}
