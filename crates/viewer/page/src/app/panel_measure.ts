// Distances between two nodes: now, at the beginning, the change, by components, and over time. A part of the
// tab "Probes".

import type { Vector } from "../types";
import type { App } from "./app";
import { LINES } from "./colours";
import { choice, fill, h, iconButton, row, setText } from "./dom";
import { digits, quantity, scaled } from "./format";
import { icons } from "./icons";
import type { Picks } from "./picks";
import { Plot } from "./plot";
import type { Session } from "./session";
import { linesOf, type Wanted } from "./tables";
import type { Tracks } from "./tracks";
import type { Measure } from "./view";

const AXES = ["x", "y", "z"];
type Kind = "distance" | "x" | "y" | "z";

const length = (v: Vector): number => Math.hypot(...v);
const between = (a: Vector, b: Vector): Vector => [b[0] - a[0], b[1] - a[1], b[2] - a[2]];

/** The vector from the first node to the second, now and at the beginning, m; null until it is known. */
export function measured(tracks: Tracks, session: Session, { a, b }: Measure): { now: Vector; initial: Vector } | null {
  const [from, to] = [tracks.now(session, a), tracks.now(session, b)];
  return from && to ? { now: between(from.now, to.now), initial: between(from.initial, to.initial) } : null;
}

/** A change in words: +1.2 mm (+3.4 %). */
function changeText(now: number, initial: number): string {
  const change = now - initial;
  const sign = change > 0 ? "+" : "";
  return sign + quantity(change, "m") + (initial > 0 ? ` (${sign}${digits((100 * change) / initial, 3)} %)` : "");
}

export function measurePanel(app: App, picks: Picks): { element: HTMLElement; update: () => void; plots: Plot[] } {
  const { tracks } = picks.probes;
  const plot = new Plot(app, "Distance", "No values yet.");
  const list = h("ul", { class: "measure-list" });
  let kind: Kind = "distance";
  const choose = choice([["distance", "distance"], ...AXES.slice(0, app.run.dimension).map((axis): [string, string] => [axis, `component ${axis}`])], kind, (value) => {
    kind = value as Kind;
    update();
  });
  const head = row("Plotted", choose);
  const button = h("button", { type: "button", class: "small", onclick: () => app.use(app.tool === "measure" ? "node" : "measure") });
  const hint = h("p", { class: "quiet", role: "status" });
  const name = (measure: Measure) => `${measure.a} – ${measure.b}${app.isComparison ? (app.sessionOf(measure) === app.sessions[0] ? " (A)" : " (B)") : ""}`;
  let listed = "";
  let rows: HTMLElement[] = [];

  const update = () => {
    const { measures } = app.view;
    setText(button, app.tool === "measure" ? "Stop measuring" : "Measure a distance");
    button.setAttribute("aria-pressed", String(app.tool === "measure"));
    setText(hint, app.tool !== "measure" ? "" : app.started === null ? "Click the first node." : `From node ${app.started.node}: click the second node.`);
    const key = JSON.stringify(measures);
    if (key !== listed) {
      listed = key;
      rows = measures.map(() => h("table", { class: "measure" }));
      fill(list, ...measures.map((measure, i) => {
        const dot = h("span", { class: "dot" });
        dot.style.setProperty("--colour", LINES[i % LINES.length]!);
        return h("li", {}, h("div", { class: "measure-head" }, dot, h("span", { class: "name" }, `nodes ${name(measure)}`),
          iconButton(icons.close, `Remove distance ${measure.a} to ${measure.b}`, () => app.change({ measures: app.view.measures.filter((other) => other !== measure) }))), rows[i]!);
      }));
    }
    measures.forEach((measure, i) => {
      const found = measured(tracks, app.sessionOf(measure), measure);
      fillTable(rows[i]!, found, app.run.dimension);
    });
    head.hidden = plot.element.hidden = measures.length === 0 || app.model !== null;
    if (head.hidden) return;
    const wanted = measures.map((measure, i): Wanted => ({ label: name(measure), unit: "m", colour: LINES[i % LINES.length]!, of: () => over(tracks, app.sessionOf(measure), measure, kind) }));
    const { times, lines } = linesOf(app, wanted, [app.sessions[0]!]);
    plot.set(kind === "distance" ? "Distance" : `Distance along ${kind}`, times, lines);
  };
  return { element: h("section", { class: "measures" }, h("h3", {}, "Distances"), h("div", { class: "inline" }, button), hint, list, head, plot.element), update, plots: [plot] };
}

/** A distance or a component of it over all frames. */
function over(tracks: Tracks, session: Session, { a, b }: Measure, kind: Kind): { times: number[]; values: number[] } | null {
  const [from, to] = [tracks.of(session, "node", a), tracks.of(session, "node", b)];
  if (!from || !to) return null;
  const count = Math.min(from.positions.length, to.positions.length);
  const value = (i: number): number => {
    const vector = between(from.positions[i]!, to.positions[i]!);
    return kind === "distance" ? length(vector) : vector[AXES.indexOf(kind)]!;
  };
  return { times: from.times.slice(0, count), values: Array.from({ length: count }, (_, i) => value(i)) };
}

function fillTable(table: HTMLElement, found: { now: Vector; initial: Vector } | null, dimension: number): void {
  if (found === null) return fill(table, h("tbody", {}, h("tr", {}, h("td", {}, "not known at this time"))));
  const { now, initial } = found;
  const by = scaled(Math.max(length(now), length(initial)), "m");
  const cell = (value: number) => h("td", { class: "number" }, digits(value / by.factor, 5));
  const components = AXES.slice(0, dimension).map((axis, k) => h("tr", {}, h("th", { scope: "row" }, `Δ${axis}`), cell(now[k]!), cell(initial[k]!), cell(now[k]! - initial[k]!)));
  fill(table,
    h("caption", {}, `${quantity(length(now), "m", 5)}, change ${changeText(length(now), length(initial))}`),
    h("thead", {}, h("tr", {}, h("th", { scope: "col" }, by.unit), ...["now", "beginning", "change"].map((text) => h("th", { scope: "col", class: "number" }, text)))),
    h("tbody", {}, h("tr", {}, h("th", { scope: "row" }, "distance"), cell(length(now)), cell(length(initial)), cell(length(now) - length(initial))), ...components));
}
