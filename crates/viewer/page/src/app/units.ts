// Units of files of measurements, to base units: products and quotients of units with prefixes, as in
// kN/mm^2.

export interface Unit {
  /** A number in this unit times the factor is in base units. */
  factor: number;
  /** Powers of mass, length, time. */
  dimension: [number, number, number];
}

const UNITS: Record<string, [number, Unit["dimension"]]> = {
  s: [1, [0, 0, 1]], min: [60, [0, 0, 1]], h: [3600, [0, 0, 1]], m: [1, [0, 1, 0]], in: [0.0254, [0, 1, 0]], ft: [0.3048, [0, 1, 0]],
  g: [1e-3, [1, 0, 0]], t: [1e3, [1, 0, 0]], N: [1, [1, 1, -2]], lbf: [4.4482216152605, [1, 1, -2]], kgf: [9.80665, [1, 1, -2]],
  Pa: [1, [1, -1, -2]], bar: [1e5, [1, -1, -2]], psi: [6894.757293168, [1, -1, -2]], J: [1, [1, 2, -2]], W: [1, [1, 2, -3]], Hz: [1, [0, 0, -1]],
  rad: [1, [0, 0, 0]], deg: [Math.PI / 180, [0, 0, 0]], "°": [Math.PI / 180, [0, 0, 0]], "%": [0.01, [0, 0, 0]], "1": [1, [0, 0, 0]], "-": [1, [0, 0, 0]],
};
const PREFIXES: Record<string, number> = { T: 1e12, G: 1e9, M: 1e6, k: 1e3, c: 1e-2, m: 1e-3, u: 1e-6, "µ": 1e-6, "μ": 1e-6, n: 1e-9, p: 1e-12 };
/** Units that take no prefix. */
const PLAIN = new Set(["min", "h", "in", "ft", "lbf", "kgf", "psi", "deg", "°", "%", "1", "-"]);
const RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹";

function single(text: string): [number, Unit["dimension"]] | null {
  const known = Object.hasOwn(UNITS, text) ? UNITS[text]! : null;
  if (known !== null) return known;
  const [prefix, rest] = [PREFIXES[text.charAt(0)], text.slice(1)];
  return prefix !== undefined && Object.hasOwn(UNITS, rest) && !PLAIN.has(rest) ? [prefix * UNITS[rest]![0], UNITS[rest]![1]] : null;
}

/** The unit of a text; null if it is not known. */
export function unitOf(text: string): Unit | null {
  const plain = text.trim().replace(/[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+/g, (power) => `^${[...power].map((c) => (c === "⁻" ? "-" : RAISED.indexOf(c))).join("")}`);
  if (plain === "") return { factor: 1, dimension: [0, 0, 0] };
  const unit: Unit = { factor: 1, dimension: [0, 0, 0] };
  let sign = 1;
  for (const piece of plain.split(/([/·*\s]+)/)) {
    if (/^[/·*\s]+$/.test(piece)) {
      sign = piece.includes("/") ? -1 : sign;
      continue;
    }
    const found = /^(.+?)(?:\^?(-?\d+))?$/.exec(piece);
    const own = found === null ? null : single(found[1]!) ?? single(piece);
    if (found === null || own === null) return null;
    const power = sign * (single(found[1]!) === null ? 1 : Number(found[2] ?? 1));
    unit.factor *= own[0] ** power;
    unit.dimension = unit.dimension.map((value, k) => value + power * own[1][k]!) as Unit["dimension"];
  }
  return unit;
}

export function isSameDimension(a: Unit, b: Unit): boolean {
  return a.dimension.every((value, k) => value === b.dimension[k]);
}
