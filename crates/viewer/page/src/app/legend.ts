// The legend: the quantity, its unit, and the bar of colours with round numbers. As elements beside the
// picture, and drawn into exported pictures.

import { colourAt } from "../colormap";
import type { App } from "./app";
import { colourBands, colourRange } from "./colours";
import { h, setText } from "./dom";
import { digits, scaled, ticks } from "./format";
import type { Session } from "./session";
import { isAveraged } from "./wish";

export interface LegendTick {
  /** 0 at the low end, 1 at the high end. */
  at: number;
  text: string;
}
export interface LegendData {
  title: string;
  unit: string;
  ticks: LegendTick[];
  /** CSS colours from low to high. */
  colours: string[];
  smooth: boolean;
}

/** What the legend of a session says now; null without colours. */
export function legendData(app: App, session: Session): LegendData | null {
  const scalar = session.scalar(app.view.scalar);
  const range = colourRange(app, session);
  if (!scalar || !range) return null;
  const bands = colourBands(app);
  const count = bands > 0 ? bands : 64;
  const list: string[] = [];
  for (let i = 0; i < count; i++) {
    list.push(colourAt(app.view.picture.map, (i + 0.5) / count, bands));
  }
  const title = isAveraged(app.view, session.run) ? `${scalar.label}, averaged` : scalar.label;
  if (scalar.states.length > 0) {
    return { title, unit: "", colours: list, smooth: false, ticks: scalar.states.map((text, i) => ({ at: (i + 0.5) / scalar.states.length, text })) };
  }
  const [low, high] = range;
  const by = scaled(Math.max(Math.abs(low), Math.abs(high)), scalar.unit);
  const round = ticks(low, high, 5);
  const gap = 0.1 * (high - low);
  const marks = [low, ...round.filter((value) => value - low > gap && high - value > gap), high];
  return {
    title, unit: by.unit, colours: list, smooth: bands === 0,
    ticks: marks.map((value) => ({ at: (value - low) / (high - low), text: digits(value / by.factor, 3) })),
  };
}

export class Legend {
  readonly element: HTMLElement;
  private readonly title = h("div", { class: "legend-title" });
  private readonly bar = h("div", { class: "legend-bar", "aria-hidden": "true" });
  private readonly marks = h("div", { class: "legend-marks", "aria-hidden": "true" });
  private readonly words = h("p", { class: "hidden-text" });
  private key = "none";

  constructor(private readonly app: App, private readonly session: Session) {
    this.element = h("section", { class: "legend", "aria-label": "Legend" }, this.title, h("div", { class: "legend-body" }, this.bar, this.marks), this.words);
    app.events.on(["view", "shown", "range", "run"], () => this.update());
    this.update();
  }

  update(): void {
    // one legend stands for both runs where they have one range
    const twin = this.app.view.common && this.app.isComparison && this.session !== this.app.sessions[0];
    const data = twin ? null : legendData(this.app, this.session);
    const key = JSON.stringify(data);
    if (key === this.key) return;
    this.key = key;
    this.element.hidden = data === null;
    if (data === null) return;
    setText(this.title, data.unit === "" ? data.title : `${data.title} / ${data.unit}`);
    const count = data.colours.length;
    const stops = data.smooth
      ? data.colours.map((colour, i) => `${colour} ${((100 * i) / (count - 1)).toFixed(2)}%`)
      : data.colours.flatMap((colour, i) => [`${colour} ${((100 * i) / count).toFixed(2)}%`, `${colour} ${((100 * (i + 1)) / count).toFixed(2)}%`]);
    this.bar.style.setProperty("--stops", stops.join(","));
    this.marks.replaceChildren(...data.ticks.map((tick) => {
      const mark = h("span", {}, tick.text);
      mark.style.setProperty("--at", String(tick.at));
      return mark;
    }));
    const [first, last] = [data.ticks[0], data.ticks.at(-1)];
    setText(this.words, `Colours show ${data.title} from ${first?.text} to ${last?.text} ${data.unit}`);
  }
}

/** Draws a legend with its top left corner at x, y; `unit` = pixels per CSS pixel. Returns its width. */
export function drawLegend(context: CanvasRenderingContext2D, data: LegendData, x: number, y: number, height: number, unit: number, ink: string): number {
  context.save();
  context.fillStyle = ink;
  context.textBaseline = "alphabetic";
  context.font = `600 ${13 * unit}px system-ui, sans-serif`;
  const title = data.unit === "" ? data.title : `${data.title} / ${data.unit}`;
  context.fillText(title, x, y + 13 * unit);
  let widest = context.measureText(title).width;
  const [top, width] = [y + 26 * unit, 16 * unit];
  const count = data.colours.length;
  data.colours.forEach((colour, i) => {
    context.fillStyle = colour;
    const from = Math.round(top + height * (1 - (i + 1) / count));
    const to = Math.round(top + height * (1 - i / count));
    context.fillRect(x, from, width, to - from);
  });
  context.strokeStyle = ink;
  context.lineWidth = unit;
  context.font = `${12 * unit}px system-ui, sans-serif`;
  context.textBaseline = "middle";
  context.fillStyle = ink;
  for (const tick of data.ticks) {
    const at = top + height * (1 - tick.at);
    context.beginPath();
    context.moveTo(x + width, at);
    context.lineTo(x + width + 4 * unit, at);
    context.stroke();
    context.fillText(tick.text, x + width + 8 * unit, at);
    widest = Math.max(widest, width + 8 * unit + context.measureText(tick.text).width);
  }
  context.restore();
  return widest;
}
