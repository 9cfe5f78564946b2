// Tab "Energy": the ledger as stacked areas with lines for total and external work, and how well it closes.

import type { App } from "./app";
import { ENERGIES } from "./colours";
import { h, setText } from "./dom";
import { digits, quantity } from "./format";
import { Plot, type Line } from "./plot";
import { between, type Session } from "./session";
import { column, largest, linesOf, type Wanted } from "./tables";

/** Elastic energy: what is stored, without what was dissipated plastically. */
function elastic(session: Session): (number | null)[] | null {
  const [internal, plastic] = [session.column("energy.internal"), session.column("energy.plastic")];
  return internal && plastic ? internal.map((value, i) => (value === null || plastic[i] === null ? null : value - plastic[i]!)) : null;
}
function values(session: Session, name: string): (number | null)[] | null {
  return name === "elastic" ? elastic(session) : session.column(name);
}

export function energyPanel(app: App): { element: HTMLElement; update: () => void; plots: Plot[] } {
  const plot = new Plot(app, "Energy", "The run has no history yet.");
  const words = h("p", { class: "quiet" });
  const none = h("p", { class: "quiet" });

  let stale = true;
  app.events.on(["history", "run", "theme"], () => (stale = true));
  const update = () => {
    if (!stale) return;
    stale = false;
    const first = app.sessions.find((session) => session.column("time"));
    if (!first) return plot.set("Energy", [], []);
    const unit = first.unit("energy.kinetic") || first.run.energy_unit;
    const whole = Math.max(...app.sessions.map((s) => Math.max(...ENERGIES.map(([name]) => largest(values(s, name))))));
    const some = ENERGIES.filter(([name]) => app.sessions.some((s) => largest(values(s, name)) > 1e-9 * whole));
    const nothing = ENERGIES.filter((energy) => !some.includes(energy)).map(([, label]) => label);
    const times = first.column("time") as number[];
    const lines: Line[] = [];
    // stacked: each area's upper line is the sum of what lies below it
    const stack = (session: Session, over: number[], areas: boolean) => {
      let sum: (number | null)[] = over.map(() => 0);
      const own_times = session.column("time") as number[] | null;
      if (!own_times) return;
      for (const [name, label, colour] of some) {
        const column_values = values(session, name);
        if (!column_values) continue;
        const own = own_times === over ? column_values : over.map((time) => between(own_times, column_values, time));
        sum = sum.map((below, i) => (below === null || own[i] === null || own[i] === undefined ? null : below + own[i]!));
        lines.push({ label: label + (app.isComparison ? (areas ? " · A" : " · B") : ""), unit, colour, values: sum, own, area: areas, dashed: !areas });
      }
    };
    const merged = linesOf(app, [
      { label: "total", unit, colour: "var", of: column("energy.total") },
      { label: "external work", unit, colour: "var", of: column("energy.external") },
    ] satisfies Wanted[]);
    const over = app.isComparison ? merged.times : times;
    app.sessions.forEach((session, i) => stack(session, over, i === 0));
    for (const line of merged.lines) {
      if (line.label.startsWith("external") && largest(line.values) <= 1e-9 * whole) continue;
      const dark = document.documentElement.dataset["theme"] === "dark";
      lines.push({ ...line, colour: line.label.startsWith("total") ? (dark ? "#f2f4f7" : "#14181d") : dark ? "#ffb3c1" : "#8a1538" });
    }
    plot.set("Energy", over, lines);
    setText(none, nothing.length > 0 ? `Zero all the time: ${nothing.join(", ")}.` : "");
    setText(words, app.sessions.map((session, i) => (app.isComparison ? `${i === 0 ? "A" : "B"}: ` : "") + closure(session, unit)).join("\n"));
  };
  return { element: h("div", {}, plot.element, words, none), update, plots: [plot] };
}

/** How well the ledger closes: the change of the total, and what the run itself reports. */
function closure(session: Session, unit: string): string {
  const total = (session.column("energy.total") ?? []).filter((v): v is number => v !== null);
  if (total.length === 0) return "";
  const change = Math.max(...total) - Math.min(...total);
  const summary = session.run.summary as { energy_drift?: number; ledger_residual?: number } | null;
  const texts = [`The total moves by ${quantity(change, unit, 3)}`];
  if (typeof summary?.energy_drift === "number") texts.push(`energy drift ${digits(summary.energy_drift, 2)}`);
  if (typeof summary?.ledger_residual === "number") texts.push(`residual of the ledger ${digits(summary.ledger_residual, 2)}`);
  return `${texts.join(", ")}.`;
}
