// Tab "Probes": nodes and elements that the user chose, with values now and over time in one or several
// plots; distances; the probes of the model.

import type { Scalar } from "../types";
import type { App } from "./app";
import { LINES, PROBE_COLOURS } from "./colours";
import { choice, fill, h, iconButton, row, setText } from "./dom";
import { quantity } from "./format";
import { icons } from "./icons";
import { measurePanel } from "./panel_measure";
import type { Picks } from "./picks";
import { Plot } from "./plot";
import { isMean, type Probes, words } from "./probes";
import { column, largest, linesOf, type Wanted } from "./tables";
import type { ProbePlace } from "./view";

const MODEL_PROBE = /^(?!energy\.|contact\.|obstacle\.|rigid\.)(.+)\.(v?[xyz])$/;
const WORDS: Record<string, string> = { x: "position x", y: "position y", z: "position z", vx: "velocity x", vy: "velocity y", vz: "velocity z" };
const MOST_PLOTS = 8;

interface Part {
  element: HTMLElement;
  update: () => void;
  plots: Plot[];
}

export function probesPanel(app: App, picks: Picks): Part {
  const { probes } = picks;
  // of a model before it runs there is nothing over time
  const overTime = app.model === null;
  const parts = [probeForm(app, probes), probeList(app, probes), ...(overTime ? [probePlots(app, probes)] : []), measurePanel(app, picks), ...(overTime ? [modelProbes(app)] : [])];
  return {
    element: h("div", {}, ...parts.map((part) => part.element)),
    update: () => parts.forEach((part) => part.update()),
    get plots() {
      return parts.flatMap((part) => part.plots);
    },
  };
}

/** A node or an element by its number, and which of them a click takes. */
function probeForm(app: App, probes: Probes): Part {
  let of: ProbePlace["of"] = "node";
  const kind = choice([["node", "Node"], ["cell", "Element"]], of, (value) => {
    of = value as ProbePlace["of"];
    app.use(of);
  });
  kind.setAttribute("aria-label", "Probe of a node or an element");
  const label = h("label", { for: "probe-node", class: "hidden-text" }, "Node");
  const number = h("input", { type: "number", min: 0, step: 1, class: "number-box", id: "probe-node", placeholder: "number" });
  const said = h("p", { class: "fault-text", role: "status" });
  const which = app.isComparison ? choice(app.sessions.map((_, i) => [String(i), i === 0 ? "A" : "B"]), "0", () => {}) : null;
  which?.setAttribute("aria-label", "Run");
  const form = h("form", { class: "inline", onsubmit: (event: SubmitEvent) => {
    event.preventDefault();
    const session = app.sessions[Number(which?.value ?? 0)]!;
    const typed = Number(number.value);
    const fault = number.value === "" || !Number.isInteger(typed) || typed < 0 ? `Type the number of ${of === "node" ? "a node" : "an element"}.` : probes.addNumber(session, of, typed);
    setText(said, fault);
    if (fault === "") number.value = "";
  } }, kind, label, number, which, h("button", { type: "submit", class: "small" }, "Add"));
  const hint = h("p", { class: "quiet" });
  const update = () => {
    if (app.tool !== "measure") of = app.tool;
    kind.value = of;
    setText(label, of === "node" ? "Node" : "Element");
    setText(hint, `Click ${of === "node" ? "a node" : "an element"} in the picture, or type its number.`);
    hint.hidden = app.view.probes.length >= 3 || app.tool === "measure";
  };
  return { element: h("div", {}, form, said, hint), update, plots: [] };
}

function placed(app: App): { place: ProbePlace; session: App["sessions"][number]; colour: string }[] {
  return app.view.probes.map((place, i) => ({ place, session: app.sessionOf(place), colour: PROBE_COLOURS[i % PROBE_COLOURS.length]! }));
}

/** The probes with their values now. */
function probeList(app: App, probes: Probes): Part {
  const list = h("ul", { class: "probe-list" });
  let listed = "";
  let values: HTMLElement[] = [];
  const update = () => {
    const scalar = app.sessions[0]!.scalar(app.view.scalar);
    const places = placed(app);
    const key = JSON.stringify(app.view.probes);
    if (key !== listed) {
      listed = key;
      values = places.map(() => h("span", { class: "value" }));
      fill(list, ...places.map(({ place, colour }, i) => {
        const dot = h("span", { class: "dot" });
        dot.style.setProperty("--colour", colour);
        const name = `${words(place.of)} ${place.of === "node" ? place.node : place.cell}${app.isComparison ? (place.run === app.sessions[0]!.index ? " · A" : " · B") : ""}`;
        return h("li", {}, dot, h("span", { class: "name" }, name), values[i]!, iconButton(icons.close, `Remove probe at ${probes.name(place)}`, () => probes.remove(place)));
      }));
    }
    places.forEach(({ place, session }, i) => {
      const ofCell = scalar?.location === "cell" && place.of === "node" ? (isMean(app, place, scalar) ? " (mean of its elements)" : ` (element ${place.cell})`) : "";
      const ofNodes = scalar?.location === "node" && place.of === "cell" ? " (mean of its nodes)" : "";
      setText(values[i]!, scalar ? quantity(probes.now(session, place), scalar.unit) + ofCell + ofNodes : "");
    });
  };
  return { element: list, update, plots: [] };
}

/** Lines of all probes for a quantity. */
function plotProbes(app: App, probes: Probes, plot: Plot, scalar: Scalar): void {
  const places = placed(app);
  const wanted = places.map(({ place, session, colour }): Wanted => ({ label: probes.name(place), unit: scalar.unit, colour, of: () => probes.over(session, place, scalar) }));
  const { times, lines } = linesOf(app, wanted, [app.sessions[0]!]);
  for (const { place, session } of places) {
    const line = lines.find((one) => one.label === probes.name(place));
    if (line) line.dashed = session !== app.sessions[0];
  }
  plot.says(places.map(({ place, session }) => probes.fault(session, place, scalar)).find((fault) => fault !== "") ?? "No values yet.");
  plot.set(scalar.label, times, lines);
}

/** A plot of the quantity that is shown, and one of each further quantity that was added. */
function probePlots(app: App, probes: Probes): Part {
  const shown = new Plot(app, "Values", "No values yet.", app.isComparison);
  const added = addedPlots(app, probes);
  const update = () => {
    const scalar = app.sessions[0]!.scalar(app.view.scalar);
    const has = app.view.probes.length > 0 && scalar !== null;
    shown.element.hidden = !has;
    if (has) plotProbes(app, probes, shown, scalar);
    added.update();
  };
  return {
    element: h("div", {}, shown.element, added.element), update,
    get plots() {
      return [shown, ...added.plots];
    },
  };
}

/** Plots of further quantities, and the choice that adds one. */
function addedPlots(app: App, probes: Probes): Part {
  const known = new Map<string, Plot>();
  const holder = h("div");
  const more = h("select", { onchange: () => {
    if (more.value !== "") app.change({ plots: [...app.view.plots, more.value] });
    more.value = "";
  } });
  const add = row("Another plot", more);
  let offered = "";
  const offer = () => {
    const { scalar, plots } = app.view;
    const choices = app.run.scalars.filter(({ key }) => key !== scalar && !plots.includes(key));
    const key = choices.map((one) => one.key).join(" ");
    if (key !== offered) fill(more, h("option", { value: "" }, "choose a quantity"), ...choices.map((one) => h("option", { value: one.key }, one.label)));
    offered = key;
    add.hidden = app.view.probes.length === 0 || choices.length === 0 || plots.length >= MOST_PLOTS;
  };
  const update = () => {
    offer();
    const wanted = app.view.probes.length > 0 ? app.view.plots : [];
    for (const [key, plot] of known) {
      if (wanted.includes(key)) continue;
      plot.element.remove();
      known.delete(key);
    }
    for (const key of wanted) {
      const scalar = app.sessions[0]!.scalar(key);
      if (!scalar) continue;
      let plot = known.get(key);
      if (plot === undefined) {
        plot = new Plot(app, scalar.label, "No values yet.", app.isComparison, () => app.change({ plots: app.view.plots.filter((other) => other !== key) }));
        known.set(key, plot);
        holder.append(plot.element);
      }
      plotProbes(app, probes, plot, scalar);
    }
  };
  return {
    element: h("div", {}, holder, add), update,
    get plots() {
      return [...known.values()];
    },
  };
}

/** The probes of the model, from the history. */
function modelProbes(app: App): Part {
  const model = new Plot(app, "Probes of the model");
  const modelHead = h("div");
  let kind = "";
  let known = "";
  let stale = true;
  app.events.on("history", () => (stale = true));
  const update = () => {
    if (!stale) return;
    stale = false;
    const found = app.sessions.flatMap((s) => s.names()).map((name) => MODEL_PROBE.exec(name)).filter((m) => m !== null);
    const names = [...new Set(found.map((m) => m[1]!))];
    const kinds = [...new Set(found.map((m) => m[2]!))];
    if (!kinds.includes(kind)) kind = liveliest(app, names, kinds);
    const key = [...names, ...kinds].join("\n");
    if (key !== known) {
      known = key;
      const select = choice(kinds.map((k) => [k, WORDS[k] ?? k]), kind, (value) => {
        kind = value;
        stale = true;
        update();
      });
      fill(modelHead, ...(names.length > 0 ? [h("h3", {}, "Probes of the model"), row("Shown", select)] : []));
    }
    model.element.hidden = names.length === 0;
    if (names.length === 0) return;
    const unit = app.sessions.map((s) => s.unit(`${names[0]}.${kind}`)).find((u) => u !== "") ?? "";
    const { times, lines } = linesOf(app, names.map((name, i) => ({ label: name, unit, colour: LINES[i % LINES.length]!, of: column(`${name}.${kind}`) })));
    model.set(WORDS[kind] ?? kind, times, lines);
  };
  return { element: h("div", {}, modelHead, model.element), update, plots: [model] };
}

/** The velocity with the largest values, to begin with. */
function liveliest(app: App, names: string[], kinds: string[]): string {
  const size = (kind: string) => Math.max(...app.sessions.flatMap((session) => names.map((name) => largest(session.column(`${name}.${kind}`)))));
  const fast = kinds.filter((kind) => kind.startsWith("v"));
  return (fast.length > 0 ? fast : kinds).reduce((best, kind) => (best === "" || size(kind) > 1.001 * size(best) ? kind : best), "");
}
