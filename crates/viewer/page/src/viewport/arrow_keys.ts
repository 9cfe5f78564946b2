// What the lengths of arrows stand for: an arrow of known size for each kind that is drawn.

import type { Run } from "../types";

export interface ArrowKey {
  /** px of CSS */
  length: number;
  label: string;
  colour: string;
}

interface Kind {
  name: string;
  /** The size of an arrow of this length, m. */
  size: number;
  length: number;
  unit: string;
  colour: string;
  /** Lengths go with the square root of the size. */
  isRoot: boolean;
}

export function glyphKind(run: Run, field: string | null, glyph: { size: number; length: number } | null, colour: string): Kind[] {
  const scalar = run.scalars.find(({ key }) => key.split(".")[0] === field);
  return glyph === null || scalar === undefined ? [] : [{ ...glyph, name: scalar.label.replace(/ xx?$/, ""), unit: scalar.unit, colour, isRoot: false }];
}

/** Arrows of at most so many px; those that are longer are shown shorter, with the size for that length. */
export function arrowKeys(kinds: Kind[], perMetre: number, most: number, quantity: (value: number, unit: string) => string): ArrowKey[] {
  return kinds.map(({ name, size, length, unit, colour, isRoot }) => {
    const whole = length * perMetre;
    const part = Math.min(1, most / whole);
    return { length: whole * part, label: `${name} ${quantity(size * (isRoot ? part ** 2 : part), unit)}`, colour };
  });
}
