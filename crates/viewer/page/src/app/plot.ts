// One plot over time (uPlot): lines or stacked areas, the present time as a vertical line, values at it in a
// list below. A click moves the time, dragging magnifies, a double click shows all again. "CSV" saves what is
// plotted; "Compare", or a file dropped here, adds measurements.

import uPlot from "uplot";
import type { App } from "./app";
import { LINES } from "./colours";
import { fill, fileName, h, iconButton, save, setText } from "./dom";
import { icons } from "./icons";
import { digits, quantity, scaled, type Scaled } from "./format";
import { type Measured, readMeasurements } from "./measurements";
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

/** Measurements are ink, further ones colours from the other end of those of lines. */
function measuredColour(index: number): string {
  return index === 0 ? colour("ink") : LINES.at(-(index % LINES.length))!;
}

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
  /** Measurements by the name of the plot to which they were added. */
  private readonly measured = new Map<string, Measured[]>();
  private readonly said = h("p", { class: "plot-said", role: "status", hidden: true });
  private readonly hasList: boolean;

  /** `remove`: a plot that the user added can be removed. */
  constructor(private readonly app: App, private name: string, private nothing = "Nothing to plot yet.", hasList = true, remove: (() => void) | null = null) {
    this.hasList = hasList;
    this.list.hidden = !hasList;
    const file = h("input", { type: "file", accept: ".csv,.txt,.tsv,text/csv,text/plain", hidden: true, "aria-label": "File of measurements", onchange: () => {
      if (file.files?.[0]) void this.compare(file.files[0]);
      file.value = "";
    } });
    const compare = h("button", { type: "button", class: "small", title: "Add measurements from a CSV file; a file can be dropped on the plot, too", onclick: () => file.click() }, "Compare");
    const csv = h("button", { type: "button", class: "small", title: "Save the values of this plot", onclick: () => this.saveCsv() }, "CSV");
    this.element = h("section", { class: "plot" }, h("div", { class: "plot-head" }, this.heading, h("div", { class: "plot-buttons" }, compare, file, csv, remove && iconButton(icons.close, "Remove plot", remove))), this.holder, this.empty, this.said, this.list);
    this.listenToFiles();
    new ResizeObserver(() => this.resize()).observe(this.holder);
    app.events.on(["view", "shown"], () => this.moveCursor());
    app.events.on("theme", () => this.rebuild());
  }

  /** What it says while there is nothing to plot. */
  says(nothing: string): void {
    if (this.nothing === nothing) return;
    this.nothing = nothing;
    if (this.empty.textContent !== "") setText(this.empty, nothing);
  }

  /** Plots lines over times that all of them share. Lines of one plot have one unit. */
  set(name: string, times: number[], lines: Line[]): void {
    if (this.plot && name === this.name && times === this.times && lines.length === this.lines.length && lines.every((l, i) => l.values === this.lines[i]!.values && l.label === this.lines[i]!.label && l.colour === this.lines[i]!.colour)) return;
    this.name = name;
    this.times = times;
    this.lines = lines;
    const shape = JSON.stringify([name, ...lines.map((l) => [l.label, l.colour, l.dashed, l.area, l.unit])]);
    let largest = 0;
    for (const line of [...lines, ...this.own]) for (const v of line.values) if (v !== null && Math.abs(v) > largest) largest = Math.abs(v);
    const by = scaled(largest, lines[0]?.unit ?? "");
    const fresh = shape !== this.shape || by.factor !== this.by.factor || this.plot === null;
    if (shape !== this.shape) setText(this.said, ""), (this.said.hidden = true);
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
      this.plot?.setData(this.data());
      this.moveCursor();
    }
  }

  /** Measurements of what is plotted now. */
  private get own(): Measured[] {
    return this.measured.get(this.name) ?? [];
  }

  /** What is drawn: all lines over the times of all of them. */
  private data(): uPlot.AlignedData {
    const { times, lines, own } = this;
    if (own.length === 0) return [times, ...lines.map((l) => l.values)] as uPlot.AlignedData;
    const all = [...new Set([...times, ...own.flatMap((m) => m.times)])].sort((a, b) => a - b);
    const at = new Map(all.map((time, i) => [time, i]));
    const measured = own.map((m) => {
      const values: (number | null | undefined)[] = new Array<undefined>(all.length).fill(undefined);
      m.times.forEach((time, i) => (values[at.get(time)!] = m.values[i]!));
      return values;
    });
    return [all, ...lines.map((l) => all.map((time) => between(times, l.values, time))), ...measured] as uPlot.AlignedData;
  }

  private listenToFiles(): void {
    const over = (event: DragEvent, on: boolean) => {
      if (!event.dataTransfer?.types.includes("Files")) return;
      event.preventDefault();
      this.element.classList.toggle("drop", on);
    };
    this.element.addEventListener("dragover", (event) => over(event, true));
    this.element.addEventListener("dragleave", (event) => over(event, false));
    this.element.addEventListener("drop", (event) => {
      over(event, false);
      const file = event.dataTransfer?.files[0];
      if (file) void this.compare(file);
    });
  }

  /** Adds the measurements of a file, or says why not. */
  private async compare(file: File): Promise<void> {
    let said: string;
    let isFault = false;
    try {
      if (this.plot === null) throw new Error("There is nothing to compare with yet.");
      const { columns, notes } = readMeasurements(file.name, await file.text(), this.lines[0]?.unit ?? "");
      this.measured.set(this.name, [...this.own.filter((m) => !columns.some((c) => c.label === m.label)), ...columns]);
      said = notes.join(" ");
      this.rebuild();
    } catch (fault) {
      [said, isFault] = [(fault as Error).message, true];
    }
    setText(this.said, said);
    this.said.hidden = said === "";
    this.said.classList.toggle("fault-text", isFault);
    this.said.classList.toggle("quiet", !isFault);
  }

  private rebuild(): void {
    this.plot?.destroy();
    this.plot = null;
    if (this.times.length < 2 || this.lines.length === 0) return;
    const { lines, by } = this;
    const timeBy = scaled(this.times.at(-1) ?? 0, "s");
    const [ink, faint] = [colour("ink-soft"), colour("line-soft")];
    // as wide as its longest number
    const wide: uPlot.Axis.Size = (plot, values, _axis, cycle) => {
      if (cycle > 1) return Math.max(30, plot.axes[1] && "_size" in plot.axes[1] ? Number(plot.axes[1]._size) : 46);
      plot.ctx.font = `${11 * devicePixelRatio}px system-ui, sans-serif`;
      const longest = (values ?? []).reduce((most, text) => Math.max(most, plot.ctx.measureText(text).width / devicePixelRatio), 0);
      return Math.max(30, Math.ceil(longest) + 12);
    };
    const axis = (label: string, factor: number, size: number | uPlot.Axis.Size): uPlot.Axis => ({
      stroke: ink, label, labelSize: label === "" ? 0 : 18, labelFont: "12px system-ui, sans-serif", font: "11px system-ui, sans-serif", size,
      grid: { stroke: faint, width: 1 }, ticks: { stroke: faint, width: 1, size: 4 },
      values: (_: uPlot, splits: number[]) => splits.map((v) => digits(Math.abs(v / factor) < 1e-9 ? 0 : v / factor, 5)),
    });
    const areas = lines.map((l, i) => (l.area ? i + 1 : 0)).filter((i) => i > 0);
    const options: uPlot.Options = {
      width: Math.max(120, this.holder.clientWidth || 320), height: HEIGHT,
      legend: { show: false },
      padding: [8, 18, 0, 0],
      pxAlign: 0,
      scales: { x: { time: false }, y: { range: (_: uPlot, low: number, high: number) => bounds(low, high, areas.length > 0) } },
      axes: [axis(`time / ${timeBy.unit}`, timeBy.factor, 26), axis("", by.factor, wide)],
      cursor: { y: false, drag: { x: true, y: false, dist: 6 }, points: { show: false } },
      series: [{}, ...lines.map((l): uPlot.Series => ({
        label: l.label, stroke: l.colour, width: l.area ? 1 : 1.6, points: { show: false }, spanGaps: false, pxAlign: 0,
        ...(l.dashed ? { dash: [6, 4] } : {}),
        ...(l.area && areas[0] === lines.indexOf(l) + 1 ? { fill: `${l.colour}b0` } : {}),
      })), ...this.own.map((m, i): uPlot.Series => ({ label: m.label, stroke: measuredColour(i), width: 1.2, dash: [2, 3], points: { show: m.times.length <= 200, size: 4 }, spanGaps: true, pxAlign: 0 }))],
      bands: areas.slice(1).map((at, i) => ({ series: [at, areas[i]!] as [number, number], fill: `${lines[at - 1]!.colour}b0` })),
      hooks: { setSize: [() => this.moveCursor()], setScale: [() => this.moveCursor()] },
    };
    fill(this.holder);
    const plot = new uPlot(options, this.data(), this.holder);
    this.plot = plot;
    plot.over.append(this.cursor);
    let down = 0;
    plot.over.addEventListener("mousedown", (event) => (down = event.clientX));
    plot.over.addEventListener("click", (event) => {
      if (Math.abs(event.clientX - down) > 4) return;
      this.app.moveTo(this.nearestFrame(plot.posToVal(event.clientX - plot.over.getBoundingClientRect().left, "x")));
    });
    this.values = [...lines, ...this.own].map(() => h("span", { class: "value" }));
    this.list.hidden = !this.hasList && this.own.length === 0;
    fill(this.list, ...lines.map((l, i) => {
      const swatch = h("span", { class: l.dashed ? "swatch dashed" : l.area ? "swatch area" : "swatch" });
      swatch.style.setProperty("--colour", l.colour);
      return h("li", {}, swatch, h("span", { class: "name" }, l.label), this.values[i]!);
    }), ...this.own.map((m, i) => {
      const swatch = h("span", { class: "swatch dashed" });
      swatch.style.setProperty("--colour", measuredColour(i));
      return h("li", {}, swatch, h("span", { class: "name", title: `measured: ${m.label}` }, `measured: ${m.label}`), this.values[lines.length + i]!,
        iconButton(icons.close, `Remove ${m.label}`, () => {
          this.measured.set(this.name, this.own.filter((other) => other !== m));
          this.rebuild();
        }));
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
    this.own.forEach((m, i) => {
      const value = this.values[this.lines.length + i];
      if (value) setText(value, quantity(between(m.times, m.values, time), this.lines[0]?.unit ?? "", 4));
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
