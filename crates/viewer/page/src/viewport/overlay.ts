// What stands over the bodies: marks of probes with their labels, the directions of the axes, a bar of known
// length.

import type { ArrowKey } from "./arrow_keys";
import type { Basis } from "./camera";
import type { PlaneShown } from "./plane";
import type { Theme } from "./stage";

export interface Shown {
  /** Pixels. */
  size: [number, number];
  /** Pixels per px of CSS. */
  unit: number;
  basis: Basis;
  isPlane: boolean;
  /** What is seen vertically, m. */
  metres: number;
  /** Places in px of CSS. */
  marks: { at: [number, number]; colour: string; label: string }[];
  rulers: { ends: [[number, number], [number, number]]; colour: string; label: string }[];
  /** The plane of a section, and whether it is being moved. */
  section: (PlaneShown & { isHeld: boolean }) | null;
  /** Arrows with the size that they stand for. */
  keys: ArrowKey[];
  theme: Theme;
}

const FONT = "12px system-ui, sans-serif";
/** Distance of the axes and the bar from the picture's sides, px of CSS. */
const AIR = 18;

/** A length of one, two or five times a power of ten that is not longer than `most`. */
export function round(most: number): number {
  const power = 10 ** Math.floor(Math.log10(most));
  const step = [5, 2, 1].find((step) => step * power <= most) ?? 1;
  return step * power;
}

/** A length as engineers write it. */
export function lengthText(metres: number): string {
  const [factor, unit] = metres >= 1 ? [1, "m"] : metres >= 1e-3 ? [1e3, "mm"] : metres >= 1e-6 ? [1e6, "µm"] : [1e9, "nm"];
  return `${Number((metres * factor).toPrecision(3))} ${unit}`;
}

export function drawOverlay(paper: CanvasRenderingContext2D, shown: Shown): void {
  paper.save();
  paper.scale(shown.unit, shown.unit);
  const [width, height] = shown.size.map((pixels) => pixels / shown.unit) as [number, number];
  paper.font = FONT;
  paper.lineCap = "round";
  paper.lineJoin = "round";
  bar(paper, shown, width, height);
  shown.keys.forEach((key, i) => drawKey(paper, shown, key, width - AIR, height - AIR - 34 - 26 * i));
  axes(paper, shown, height);
  if (shown.section !== null) drawPlane(paper, shown, shown.section);
  for (const ruler of shown.rulers) drawRuler(paper, shown, ruler);
  for (const mark of shown.marks) drawMark(paper, shown, mark);
  paper.restore();
}

/** Text that is readable on anything. */
function write(paper: CanvasRenderingContext2D, shown: Shown, text: string, x: number, y: number, colour: string): void {
  paper.strokeStyle = shown.theme.halo;
  paper.lineWidth = 3;
  paper.strokeText(text, x, y);
  paper.fillStyle = colour;
  paper.fillText(text, x, y);
}

function bar(paper: CanvasRenderingContext2D, shown: Shown, width: number, height: number): void {
  const metre = height / shown.metres;
  const most = Math.min(0.22 * width, 160) / metre;
  if (!(most > 0 && Number.isFinite(most))) return;
  const length = round(most);
  const [x, y] = [width - AIR - length * metre, height - AIR];
  paper.strokeStyle = shown.theme.text;
  paper.lineWidth = 1.5;
  paper.beginPath();
  paper.moveTo(x, y - 5);
  paper.lineTo(x, y);
  paper.lineTo(width - AIR, y);
  paper.lineTo(width - AIR, y - 5);
  paper.stroke();
  paper.textAlign = "center";
  paper.textBaseline = "bottom";
  write(paper, shown, lengthText(length), x + 0.5 * length * metre, y - 5, shown.theme.text);
}

/** An arrow that ends at a place, with its size above it. */
function drawKey(paper: CanvasRenderingContext2D, shown: Shown, { length, label, colour }: ArrowKey, x: number, y: number): void {
  const head = Math.min(9, 0.45 * length);
  for (const [stroke, width] of [[shown.theme.halo, 4.5], [colour, 2.2]] as const) {
    paper.strokeStyle = stroke;
    paper.fillStyle = stroke;
    paper.lineWidth = width;
    paper.beginPath();
    paper.moveTo(x - length, y);
    paper.lineTo(x - head, y);
    paper.stroke();
    paper.beginPath();
    paper.moveTo(x, y);
    paper.lineTo(x - head, y - 0.42 * head);
    paper.lineTo(x - head, y + 0.42 * head);
    paper.closePath();
    paper.fill();
  }
  paper.textAlign = "right";
  paper.textBaseline = "bottom";
  write(paper, shown, label, x, y - 4, shown.theme.text);
}

function axes(paper: CanvasRenderingContext2D, shown: Shown, height: number): void {
  const { right, up, back } = shown.basis;
  const reach = 26;
  const [x, y] = [AIR + (shown.isPlane ? 4 : 22), height - AIR - (shown.isPlane ? 4 : 18)];
  const all = (shown.isPlane ? [0, 1] : [0, 1, 2]).sort((a, b) => back[a]! - back[b]!);
  paper.textAlign = "center";
  paper.textBaseline = "middle";
  for (const axis of all) {
    const [u, v] = [right[axis]!, -up[axis]!];
    paper.strokeStyle = shown.theme.text;
    paper.globalAlpha = back[axis]! < -0.5 ? 0.55 : 1;
    paper.lineWidth = 1.5;
    paper.beginPath();
    paper.moveTo(x, y);
    paper.lineTo(x + reach * u, y + reach * v);
    paper.stroke();
    if (Math.hypot(u, v) > 0.25) write(paper, shown, "xyz"[axis]!, x + (reach + 9) * u, y + (reach + 9) * v, shown.theme.text);
    paper.globalAlpha = 1;
  }
}

function drawMark(paper: CanvasRenderingContext2D, shown: Shown, { at: [x, y], colour, label }: Shown["marks"][number]): void {
  paper.beginPath();
  paper.arc(x, y, 5, 0, 2 * Math.PI);
  paper.fillStyle = colour;
  paper.fill();
  paper.strokeStyle = shown.theme.halo;
  paper.lineWidth = 1.5;
  paper.stroke();
  paper.textAlign = "left";
  paper.textBaseline = "bottom";
  write(paper, shown, label, x + 7, y - 4, shown.theme.text);
}

/** Keeps a label inside the picture. */
function inside(paper: CanvasRenderingContext2D, shown: Shown, text: string, x: number, y: number): [number, number] {
  const [width, height] = shown.size.map((pixels) => pixels / shown.unit) as [number, number];
  const half = 0.5 * paper.measureText(text).width + 4;
  return [Math.min(Math.max(x, half), width - half), Math.min(Math.max(y, 18), height - 8)];
}

function drawRuler(paper: CanvasRenderingContext2D, shown: Shown, { ends: [a, b], colour, label }: Shown["rulers"][number]): void {
  for (const [stroke, width] of [[shown.theme.halo, 4.5], [colour, 2]] as const) {
    paper.beginPath();
    paper.moveTo(...a);
    paper.lineTo(...b);
    paper.strokeStyle = stroke;
    paper.lineWidth = width;
    paper.stroke();
  }
  paper.textAlign = "center";
  paper.textBaseline = "bottom";
  const [x, y] = inside(paper, shown, label, 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]) - 5);
  paper.font = `600 ${FONT}`;
  write(paper, shown, label, x, y, shown.theme.text);
  paper.font = FONT;
}

function drawPlane(paper: CanvasRenderingContext2D, shown: Shown, { outline, handle, tip, isHeld }: NonNullable<Shown["section"]>): void {
  const { accent, halo } = shown.theme;
  paper.strokeStyle = accent;
  paper.lineWidth = isHeld ? 2 : 1.25;
  paper.globalAlpha = isHeld ? 1 : 0.75;
  paper.beginPath();
  outline.forEach((point, i) => (i === 0 ? paper.moveTo(...point) : paper.lineTo(...point)));
  paper.closePath();
  paper.stroke();
  paper.globalAlpha = 1;
  for (const [stroke, width] of [[halo, 5], [accent, 2.5]] as const) {
    paper.strokeStyle = stroke;
    paper.lineWidth = width;
    paper.beginPath();
    paper.moveTo(...handle);
    paper.lineTo(...tip);
    paper.stroke();
  }
  const angle = Math.atan2(tip[1] - handle[1], tip[0] - handle[0]);
  const isShort = Math.hypot(tip[0] - handle[0], tip[1] - handle[1]) < 16;
  for (const [point, radius] of [[tip, 5], [handle, 8]] as const) {
    paper.beginPath();
    if (point === tip && !isShort) {
      const corner = (turn: number, size: number): [number, number] => [tip[0] + size * Math.cos(angle + turn), tip[1] + size * Math.sin(angle + turn)];
      paper.moveTo(...corner(0, 9));
      paper.lineTo(...corner(2.3, 9));
      paper.lineTo(...corner(-2.3, 9));
      paper.closePath();
    } else paper.arc(...point, radius, 0, 2 * Math.PI);
    paper.fillStyle = accent;
    paper.fill();
    paper.strokeStyle = halo;
    paper.lineWidth = 2;
    paper.stroke();
  }
}
