// What stands over the bodies: marks of probes with their labels, the directions of the axes, a bar of known
// length.

import type { Basis } from "./camera";
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
  axes(paper, shown, height);
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
