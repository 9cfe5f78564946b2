// The range of the colours, their words in the legend, and the fixed colours of plots and probes.

import type { App } from "./app";
import type { Session } from "./session";

/** Colours of probes, in order; seen well on white and on the dark paper. */
export const PROBE_COLOURS = ["#d1495b", "#2a7fc9", "#c77800", "#2e8b57", "#8e5bd0", "#00878f", "#b8478f", "#7a7a00"];

/** Energies of the ledger, bottom to top: name of the column, words, colour. */
export const ENERGIES: [string, string, string][] = [
  ["energy.kinetic", "kinetic", "#3b7dd8"],
  ["elastic", "elastic", "#359659"],
  ["energy.plastic", "plastic", "#c27a12"],
  ["energy.hourglass", "hourglass", "#c2577b"],
  ["energy.bulk_viscosity", "bulk viscosity", "#8c6bd1"],
  ["energy.contact", "contact", "#138f99"],
  ["energy.friction", "friction", "#c94f3d"],
  ["energy.contact_damping", "contact damping", "#9a7b4f"],
  ["energy.damping", "damping", "#7f8c99"],
  ["energy.eroded", "eroded", "#8b892c"],
];

export const LINES = ["#2a7fc9", "#d1495b", "#2e8b57", "#c77800", "#8e5bd0", "#00878f", "#b8478f", "#7a7a00"];

export interface ColourRange {
  range: [number, number] | null;
  /** Of the whole run it is not known yet: this is what was seen so far. */
  provisional: boolean;
}

function join(a: [number, number] | null, b: [number, number] | null): [number, number] | null {
  return a && b ? [Math.min(a[0], b[0]), Math.max(a[1], b[1])] : a ?? b;
}

/** What the range over a whole run depends on besides the scalar: values inside count where they are seen. */
export function rangeKind(app: App, session: Session): string {
  const { averaged, section } = app.wish(session);
  return (section === null ? "" : "&inside=1") + (averaged ? "&averaged=1" : "");
}

/** The range of a session's colours under the present view; one for both where it is common. */
export function colourRange(app: App, session: Session): [number, number] | null {
  const { view } = app;
  const scalar = session.scalar(view.scalar);
  if (!scalar) return null;
  if (scalar.states.length > 0) return [-0.5, scalar.states.length - 0.5];
  if (view.range_mode === "own" && view.picture.range) return view.picture.range;
  const sessions = view.common ? app.sessions : [session];
  let range: [number, number] | null = null;
  for (const one of sessions) {
    const frame = one.shown?.scalar === scalar.key ? one.shown.range : null;
    range = join(range, view.range_mode === "frame" ? frame : one.range(scalar.key, rangeKind(app, one)) ?? frame);
  }
  if (!range) return null;
  let [low, high] = range;
  if (scalar.starts_at_zero && low > 0) low = 0;
  if (!(high > low)) {
    const size = Math.abs(low) || 1;
    [low, high] = scalar.starts_at_zero && low === 0 ? [0, size] : [low - 0.5 * size, low + 0.5 * size];
  }
  return [low, high];
}

/** Bands of the colours: those chosen, or one for each state. */
export function colourBands(app: App): number {
  const scalar = app.sessions[0]!.scalar(app.view.scalar);
  return scalar && scalar.states.length > 0 ? scalar.states.length : app.view.picture.bands;
}
