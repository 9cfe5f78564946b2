// One plot over time (uPlot): lines or stacked areas, the present time as a vertical line, values at it in a
// list below. A click moves the time, dragging magnifies, a double click shows all again. "CSV" saves what is
// plotted.

import uPlot from "uplot";
import type { App } from "./app";
import { fill, fileName, h, save, setText } from "./dom";
import { digits, quantity, scaled, type Scaled } from "./format";
import { between } from "./session";
import { colour } from "./theme";

export interface Line {
  label: string;
  unit: string;
  colour: string;
  values: (number | null)[];
  dashed?: boolean;
  /** Area between this line and the one before (stacked); `own` are the values that the list shows. */
  area?: boolean;
  own?: (number | null)[];
}

const HEIGHT = 190;

/** The ends of the y axis: a little beyond the values, zero among them where areas are stacked. */
function bounds(low: number, high: number, stacked: boolean): [number, number] {
  if (!Number.isFinite(low) || !Number.isFinite(high) || low === null) return [0, 1];
  if (stacked) [low, high] = [Math.min(0, low), Math.max(0, high)];
  const span = high - low || Math.abs(high) || 1;
  return [low === 0 ? 0 : low - 0.04 * span, high === 0 && low !== 0 ? 0 : high + 0.06 * span];
}

export class Plot {
  readonly element: HTMLElement;
  private readonly holder = h("div", { class: "plot-holder" });
  private readonly list = h("ul", { class: "plot-list" });
  private readonly cursor = h("div", { class: "plot-cursor" });
  private readonly heading = h("h3");
  private readonly empty = h("p", { class: "quiet" });
  private plot: uPlot | null = null;
  private times: number[] = [];
  private lines: Line[] = [];
  private shape = "";
  private values: HTMLElement[] = [];
  private by: Scaled = { factor: 1, unit: "" };

  constructor(private readonly app: App, private name: string, private readonly nothing = "Nothing to plot yet.", hasList = true) {
    this.list.hidden = !hasList;
    const csv = h("button", { type: "button", class: "small", title: "Save the values of this plot", onclick: () => this.saveCsv() }, "CSV");
    this.element = h("section", { class: "plot" }, h("div", { class: "plot-head" }, this.heading, csv), this.holder, this.empty, this.list);
    new ResizeObserver(() => this.resize()).observe(this.holder);
    app.events.on(["view", "shown"], () => this.moveCursor());
    app.events.on("theme", () => this.rebuild());
  }

  /** Plots lines over times that all of them share. Lines of one plot have one unit. */
  set(name: string, times: number[], lines: Line[]): void {
    if (this.plot && name === this.name && times === this.times && lines.length === this.lines.length && lines.every((l, i) => l.values === this.lines[i]!.values && l.label === this.lines[i]!.label && l.colour === this.lines[i]!.colour)) return;
    this.name = name;
    this.times = times;
    this.lines = lines;
    const shape = JSON.stringify([name, ...lines.map((l) => [l.label, l.colour, l.dashed, l.area, l.unit])]);
    let largest = 0;
    for (const line of lines) for (const v of line.values) if (v !== null && Math.abs(v) > largest) largest = Math.abs(v);
    const by = scaled(largest, lines[0]?.unit ?? "");
    const fresh = shape !== this.shape || by.factor !== this.by.factor || this.plot === null;
    this.shape = shape;
    this.by = by;
    setText(this.heading, by.unit === "" ? name : `${name} / ${by.unit}`);
    const has = times.length > 1 && lines.length > 0;
    this.holder.hidden = !has;
    this.empty.hidden = has;
    setText(this.empty, has ? "" : this.nothing);
    if (!has) {
      this.plot?.destroy();
      this.plot = null;
      fill(this.list);
      return;
    }
    if (fresh) this.rebuild();
    else {
      this.plot?.setData([times, ...lines.map((l) => l.values)] as uPlot.AlignedData);
      this.moveCursor();
    }
  }

  private rebuild(): void {
    this.plot?.destroy();
    this.plot = null;
    if (this.times.length < 2 || this.lines.length === 0) return;
    const { lines, by } = this;
    const timeBy = scaled(this.times.at(-1) ?? 0, "s");
    const [ink, faint] = [colour("ink-soft"), colour("line-soft")];
    const axis = (label: string, factor: number, size: number): uPlot.Axis => ({
      stroke: ink, label, labelSize: label === "" ? 0 : 18, labelFont: "12px system-ui, sans-serif", font: "11px system-ui, sans-serif", size,
      grid: { stroke: faint, width: 1 }, ticks: { stroke: faint, width: 1, size: 4 },
      values: (_: uPlot, splits: number[]) => splits.map((v) => digits(Math.abs(v / factor) < 1e-9 ? 0 : v / factor, 5)),
    });
    const areas = lines.map((l, i) => (l.area ? i + 1 : 0)).filter((i) => i > 0);
    const options: uPlot.Options = {
      width: Math.max(120, this.holder.clientWidth || 320), height: HEIGHT,
      legend: { show: false },
      padding: [8, 14, 0, 0],
      scales: { x: { time: false }, y: { range: (_: uPlot, low: number, high: number) => bounds(low, high, areas.length > 0) } },
      axes: [axis(`time / ${timeBy.unit}`, timeBy.factor, 26), axis("", by.factor, 46)],
      cursor: { y: false, drag: { x: true, y: false, dist: 6 }, points: { show: false } },
      series: [{}, ...lines.map((l): uPlot.Series => ({
        label: l.label, stroke: l.colour, width: l.area ? 1 : 1.6, points: { show: false }, spanGaps: false,
        ...(l.dashed ? { dash: [6, 4] } : {}),
        ...(l.area && areas[0] === lines.indexOf(l) + 1 ? { fill: `${l.colour}b0` } : {}),
      }))],
      bands: areas.slice(1).map((at, i) => ({ series: [at, areas[i]!] as [number, number], fill: `${lines[at - 1]!.colour}b0` })),
      hooks: { setSize: [() => this.moveCursor()], setScale: [() => this.moveCursor()] },
    };
    fill(this.holder);
    const plot = new uPlot(options, [this.times, ...lines.map((l) => l.values)] as uPlot.AlignedData, this.holder);
    this.plot = plot;
    plot.over.append(this.cursor);
    let down = 0;
    plot.over.addEventListener("mousedown", (event) => (down = event.clientX));
    plot.over.addEventListener("click", (event) => {
      if (Math.abs(event.clientX - down) > 4) return;
      this.app.moveTo(this.nearestFrame(plot.posToVal(event.clientX - plot.over.getBoundingClientRect().left, "x")));
    });
    this.values = lines.map(() => h("span", { class: "value" }));
    fill(this.list, ...lines.map((l, i) => {
      const swatch = h("span", { class: l.dashed ? "swatch dashed" : l.area ? "swatch area" : "swatch" });
      swatch.style.setProperty("--colour", l.colour);
      return h("li", {}, swatch, h("span", { class: "name" }, l.label), this.values[i]!);
    }));
    this.holder.setAttribute("role", "img");
    this.holder.setAttribute("aria-label", `Plot of ${this.name} over time: ${lines.map((l) => l.label).join(", ")}. Values at the present time stand below.`);
    this.moveCursor();
  }

  private nearestFrame(time: number): number {
    const times = this.app.player.times();
    let best = times[0] ?? 0;
    for (const t of times) if (Math.abs(t - time) < Math.abs(best - time)) best = t;
    return best;
  }

  private moveCursor(): void {
    const plot = this.plot;
    if (!plot || !this.element.isConnected) return;
    const time = this.app.view.time;
    const { min, max } = plot.scales["x"]!;
    const inside = min !== undefined && max !== undefined && min !== null && max !== null && time >= min && time <= max;
    this.cursor.hidden = !inside;
    if (inside) this.cursor.style.transform = `translateX(${plot.valToPos(time, "x").toFixed(1)}px)`;
    // of a run in progress the newest frame is ahead of the history: its last row counts
    const known = this.app.isGoing ? Math.min(time, this.times.at(-1) ?? time) : time;
    this.lines.forEach((line, i) => {
      const value = this.values[i];
      if (value) setText(value, quantity(between(this.times, line.own ?? line.values, known), line.unit, 4));
    });
  }

  private resize(): void {
    const width = this.holder.clientWidth;
    if (this.plot && width > 0 && Math.abs(this.plot.width - width) > 1) this.plot.setSize({ width, height: HEIGHT });
  }

  /** The plot's numbers in base units, a column for each line. */
  csv(): string {
    const quote = (text: string) => (/[",\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text);
    const head = ["time [s]", ...this.lines.map((l) => (l.unit === "" || l.unit === "-" ? l.label : `${l.label} [${l.unit}]`))].map(quote).join(",");
    const rows = this.times.map((time, i) => [time, ...this.lines.map((l) => (l.own ?? l.values)[i] ?? "")].join(","));
    return [head, ...rows].join("\n") + "\n";
  }
  saveCsv(): void {
    if (this.lines.length > 0) save(`${fileName(`${this.app.run.name}-${this.name}`)}.csv`, new Blob([this.csv()], { type: "text/csv" }));
  }
}
