// Numbers for people: SI prefixes (250 MPa, 3.2 mm), few digits, a real minus sign. Used by legend, plots,
// tables and time.

const PREFIXES: [number, string][] = [
  [1e12, "T"], [1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"], [1e-12, "p"],
];
/** Units that take a prefix: their first letters; "kg" and pure numbers do not. */
const TAKES_PREFIX = /^(Pa|m|s|J|N|W|Hz)([/·].*)?$/;

export interface Scaled {
  /** Shown number = value / factor. */
  factor: number;
  unit: string;
}

/** m^2 as m², "-" as nothing. */
export function unitText(unit: string): string {
  if (unit === "-" || unit === "1") return "";
  return unit.replace(/\^(-?\d+)/g, (_, digits: string) => [...digits].map((digit) => (digit === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(digit)] ?? digit)).join(""));
}

/** The prefix with which numbers up to `largest` read well. */
export function scaled(largest: number, unit: string): Scaled {
  const size = Math.abs(largest);
  const text = unitText(unit);
  if (!TAKES_PREFIX.test(unit) || !(size > 0) || !Number.isFinite(size)) return { factor: 1, unit: text };
  const largest_prefix = /^(m|s)([/·].*)?$/.test(unit) ? 1e3 : 1e12;
  for (const [factor, prefix] of PREFIXES) {
    if (factor > largest_prefix || (unit === "s" && factor > 1) || (unit === "m" && factor > 1 && size < 1e4)) continue;
    if (size >= factor * 0.9995) return { factor, unit: prefix + text };
  }
  return { factor: 1, unit: text };
}

/** A number with so many digits that count. */
export function digits(value: number, count = 4): string {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  let text: string;
  if (size >= 1e6 || size < 1e-3) {
    const [mantissa, exponent] = value.toExponential(count - 1).split("e") as [string, string];
    const short = mantissa.includes(".") ? mantissa.replace(/\.?0+$/, "") : mantissa;
    text = `${short}·10${[...String(Number(exponent))].map((c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)] ?? c)).join("")}`;
  } else {
    const decimals = Math.max(0, count - 1 - Math.floor(Math.log10(size)));
    text = value.toFixed(Math.min(decimals, 12));
    if (text.includes(".")) text = text.replace(/\.?0+$/, "");
  }
  return text.replace(/^-/, "−");
}

/** 2.5e8, "Pa" → "250 MPa". */
export function quantity(value: number | null | undefined, unit: string, count = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const by = scaled(value, unit);
  const number = digits(value / by.factor, count);
  return by.unit === "" ? number : `${number} ${by.unit}`;
}

/** A time with the prefix of the whole run, so that its width does not jump. */
export function timeText(time: number, whole: number): string {
  const by = scaled(whole > 0 ? whole : time, "s");
  const decimals = Math.max(0, 3 - Math.floor(Math.log10(Math.max(whole / by.factor, 1e-12)) + 1e-9));
  return `${(time / by.factor).toFixed(Math.min(decimals, 6)).replace(/^-/, "−")} ${by.unit}`;
}

/** Wall time: 3.2 s, 4 min 10 s, 2 h 5 min. */
export function duration(seconds: number): string {
  if (!Number.isFinite(seconds)) return "–";
  if (seconds < 10) return `${digits(seconds, 2)} s`;
  const whole = Math.round(seconds);
  if (whole < 60) return `${whole} s`;
  if (whole < 3600) return `${Math.floor(whole / 60)} min ${whole % 60} s`;
  return `${Math.floor(whole / 3600)} h ${Math.floor((whole % 3600) / 60)} min`;
}

export function bytes(count: number): string {
  return count >= 1e9 ? `${digits(count / 1e9, 3)} GB` : count >= 1e6 ? `${digits(count / 1e6, 3)} MB` : `${digits(count / 1e3, 3)} kB`;
}

/** 1234567 → "1 234 567" with thin spaces. */
export function whole(count: number): string {
  return String(Math.round(count)).replace(/\B(?=(\d{3})+$)/g, "\u202f");
}

/** Round numbers between two bounds, about so many. */
export function ticks(low: number, high: number, about: number): number[] {
  const span = high - low;
  if (!(span > 0) || !Number.isFinite(span)) return [low];
  const raw = span / about;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 2.5, 5, 10].map((m) => m * power).find((s) => s >= raw * 0.999) ?? power * 10;
  const list: number[] = [];
  for (let i = Math.ceil(low / step - 1e-6); i * step <= high + 1e-6 * span; i++) list.push(i * step);
  return list;
}
