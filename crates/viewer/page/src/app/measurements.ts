// A file of measurements (CSV) for a plot over time: its columns with their units, in base units; or what is
// wrong with it, where, and what to do.

import { isSameDimension, unitOf } from "./units";

export interface Measured {
  label: string;
  /** s, ascending. */
  times: number[];
  /** In the base unit of the plot. */
  values: number[];
}

export interface Measurements {
  columns: Measured[];
  /** What the user should know: columns without a unit, rows that were left out. */
  notes: string[];
}

/** The file can't be taken; the message says why. */
export class MeasurementFault extends Error {
  override name = "MeasurementFault";
}

const MOST_BYTES = 20e6;

/** `force [kN]`, `force (kN)`, `force / kN`: name and unit; without a unit null. */
function heading(text: string): { name: string; unit: string | null } {
  const found = /^(.*?)\s*(?:\[([^\]]*)\]|\(([^)]*)\)|\s\/\s(.*))\s*$/.exec(text.trim());
  return found === null ? { name: text.trim(), unit: null } : { name: found[1]!.trim(), unit: (found[2] ?? found[3] ?? found[4] ?? "").trim() };
}

/** Fields of a line; quotes may hold separators. */
function fields(line: string, separator: string): string[] {
  const list: string[] = [];
  let [own, isQuoted] = ["", false];
  for (const c of line) {
    if (c === '"') isQuoted = !isQuoted;
    else if (c === separator && !isQuoted) {
      list.push(own);
      own = "";
    } else own += c;
  }
  return [...list, own].map((text) => text.trim());
}

/** Reads a text for a plot whose values have a unit. */
export function readMeasurements(name: string, text: string, plotUnit: string): Measurements {
  const fault = (what: string) => new MeasurementFault(`${name}: ${what}`);
  if (text.length > MOST_BYTES) throw fault(`it has ${(text.length / 1e6).toFixed(0)} million characters; at most 20 million are read. Leave out rows.`);
  const lines = text.replace(/^\uFEFF/, "").split(/\r\n|\r|\n/).map((line, i) => ({ line, number: i + 1 })).filter(({ line }) => line.trim() !== "" && !line.trimStart().startsWith("#"));
  if (lines.length < 2) throw fault("it has fewer than two rows. It needs a row of names, time [s],force [kN] for example, and rows of numbers.");
  const first = lines[0]!.line;
  const separator = [";", "\t", ","].find((one) => first.includes(one));
  if (separator === undefined) throw fault("its first row has one column only. It needs a time and a value with , or ; or a tab between them.");
  const number = (field: string): number => (field === "" ? NaN : Number(separator === ";" ? field.replace(",", ".") : field));
  const names = fields(first, separator);
  const hasHead = names.some((field) => Number.isNaN(number(field)));
  const heads = names.map((field, i) => (hasHead ? heading(field) : { name: `column ${i + 1}`, unit: null }));
  const isTime = (i: number) => /^(time|t|zeit)$/i.test(heads[i]!.name) || (heads[i]!.unit !== null && heads[i]!.unit !== "" && unitOf(heads[i]!.unit)?.dimension.join() === "0,0,1");
  const timeAt = Math.max(0, heads.findIndex((_, i) => isTime(i)));
  const notes: string[] = [];
  const timeUnit = unitOf(heads[timeAt]!.unit ?? "s");
  if (timeUnit === null || timeUnit.dimension.join() !== "0,0,1") throw fault(`column "${heads[timeAt]!.name}" is its time, but has the unit ${heads[timeAt]!.unit}. Write s, ms or us.`);
  if (heads[timeAt]!.unit === null) notes.push("The time has no unit: taken as s.");

  const rows = lines.slice(hasHead ? 1 : 0).map(({ line, number: at }) => ({ at, values: fields(line, separator).map(number) }));
  const good = rows.filter(({ values }) => Number.isFinite(values[timeAt] ?? NaN));
  if (good.length < 2) throw fault(`no two rows have a number as their time${rows[0] ? `; line ${rows[0].at} reads "${lines.find((l) => l.number === rows[0]!.at)!.line.slice(0, 60)}"` : ""}. Use . as the decimal point, or ; between columns.`);
  if (good.length < rows.length) notes.push(`${rows.length - good.length} rows without a time were left out, the first in line ${rows.find((row) => !good.includes(row))!.at}.`);
  good.sort((a, b) => a.values[timeAt]! - b.values[timeAt]!);

  const base = unitOf(plotUnit);
  const refused: string[] = [];
  const columns = heads.flatMap(({ name: own, unit: written }, i): Measured[] => {
    if (i === timeAt) return [];
    const unit = written === null ? base : unitOf(written);
    if (unit === null) refused.push(`"${own}" has the unit ${written}, which is not known`);
    else if (base !== null && !isSameDimension(unit, base)) refused.push(`"${own}" is in ${written === "" ? "pure numbers" : written}`);
    else {
      if (written === null) notes.push(`"${own}" has no unit: taken as ${plotUnit || "a pure number"}.`);
      const kept = good.filter(({ values }) => Number.isFinite(values[i] ?? NaN));
      if (kept.length > 1) return [{ label: own || `column ${i + 1}`, times: kept.map(({ values }) => values[timeAt]! * timeUnit.factor), values: kept.map(({ values }) => values[i]! * (written === null ? 1 : unit.factor)) }];
      refused.push(`"${own}" has no numbers`);
    }
    return [];
  });
  if (columns.length === 0) throw fault(`no column fits this plot, whose unit is ${plotUnit || "a pure number"}: ${refused.join("; ") || "there is only the time"}. Write the unit behind the name, as in force [kN].`);
  if (refused.length > 0) notes.push(`Left out: ${refused.join("; ")}.`);
  return { columns, notes };
}
