// Tab "Probes": nodes that the user chose, with the shown quantity now and over time, and the probes of the
// model.

import type { App } from "./app";
import { LINES, PROBE_COLOURS } from "./colours";
import { choice, fill, h, iconButton, row, setText } from "./dom";
import { quantity } from "./format";
import { icons } from "./icons";
import { Plot } from "./plot";
import type { Probes } from "./probes";
import { column, largest, linesOf, type Wanted } from "./tables";

const MODEL_PROBE = /^(?!energy\.|contact\.|obstacle\.|rigid\.)(.+)\.(v?[xyz])$/;
const WORDS: Record<string, string> = { x: "position x", y: "position y", z: "position z", vx: "velocity x", vy: "velocity y", vz: "velocity z" };

export function probesPanel(app: App, probes: Probes): { element: HTMLElement; update: () => void; plots: Plot[] } {
  const plot = new Plot(app, "Values", "No values yet.", app.isComparison);
  const model = new Plot(app, "Probes of the model");
  const list = h("ul", { class: "probe-list" });
  const number = h("input", { type: "number", min: 0, step: 1, class: "short", id: "probe-node", placeholder: "number" });
  const said = h("p", { class: "fault-text", role: "status" });
  const which = app.isComparison ? choice(app.sessions.map((_, i) => [String(i), i === 0 ? "A" : "B"]), "0", () => {}) : null;
  which?.setAttribute("aria-label", "Run");
  const form = h("form", { class: "inline", onsubmit: (event: SubmitEvent) => {
    event.preventDefault();
    const session = app.sessions[Number(which?.value ?? 0)]!;
    const node = Number(number.value);
    const fault = number.value === "" || !Number.isInteger(node) || node < 0 ? "Type the number of a node." : probes.addNumber(session, node);
    setText(said, fault);
    if (fault === "") number.value = "";
  } }, h("label", { for: "probe-node" }, "Node"), number, which, h("button", { type: "submit", class: "small" }, "Add"));
  const hint = h("p", { class: "quiet" }, "Click a node in the picture, or type its number.");
  const modelHead = h("div");
  let kind = "";
  let known = "";
  let listed = "";
  let values: HTMLElement[] = [];

  const update = () => {
    const { view } = app;
    const scalar = app.sessions[0]!.scalar(view.scalar);
    const places = view.probes.map((place) => ({ place, session: app.sessions.find((s) => s.index === place.run) ?? app.sessions[0]! }));
    const key = JSON.stringify(view.probes);
    if (key !== listed) {
      listed = key;
      values = places.map(() => h("span", { class: "value" }));
      fill(list, ...places.map(({ place, session }, i) => {
        const dot = h("span", { class: "dot" });
        dot.style.setProperty("--colour", PROBE_COLOURS[i % PROBE_COLOURS.length]!);
        const name = `node ${place.node}${app.isComparison ? (session === app.sessions[0] ? " · A" : " · B") : ""}`;
        return h("li", {}, dot, h("span", { class: "name" }, name), values[i]!, iconButton(icons.close, `Remove probe at node ${place.node}`, () => probes.remove(place)));
      }));
    }
    places.forEach(({ place, session }, i) => {
      const cell = scalar?.location === "cell" ? ` (element ${place.cell})` : "";
      setText(values[i]!, scalar ? quantity(probes.now(session, place), scalar.unit) + cell : "");
    });
    hint.hidden = places.length >= 3;
    plot.element.hidden = places.length === 0 || !scalar;
    if (scalar && places.length > 0) {
      const wanted = places.map(({ place, session }, i): Wanted => ({
        label: `node ${place.node}${app.isComparison ? (session === app.sessions[0] ? " (A)" : " (B)") : ""}`, unit: scalar.unit, colour: PROBE_COLOURS[i % PROBE_COLOURS.length]!,
        of: () => probes.over(session, place),
      }));
      const { times, lines } = linesOf(app, wanted, [app.sessions[0]!]);
      places.forEach(({ session }, i) => {
        const line = lines.find((l) => l.label === wanted[i]!.label);
        if (line) line.dashed = session !== app.sessions[0];
      });
      plot.set(scalar.label, times, lines);
    }
    updateModel();
  };

  let stale = true;
  app.events.on("history", () => (stale = true));
  const updateModel = () => {
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
        updateModel();
      });
      fill(modelHead, ...(names.length > 0 ? [h("h3", {}, "Probes of the model"), row("Shown", select)] : []));
    }
    model.element.hidden = names.length === 0;
    if (names.length === 0) return;
    const unit = app.sessions.map((s) => s.unit(`${names[0]}.${kind}`)).find((u) => u !== "") ?? "";
    const { times, lines } = linesOf(app, names.map((name, i) => ({ label: name, unit, colour: LINES[i % LINES.length]!, of: column(`${name}.${kind}`) })));
    model.set(WORDS[kind] ?? kind, times, lines);
  };

  return { element: h("div", {}, form, said, hint, list, plot.element, modelHead, model.element), update, plots: [plot, model] };
}

/** The velocity with the largest values, to begin with. */
function liveliest(app: App, names: string[], kinds: string[]): string {
  const size = (kind: string) => Math.max(...app.sessions.flatMap((session) => names.map((name) => largest(session.column(`${name}.${kind}`)))));
  const fast = kinds.filter((kind) => kind.startsWith("v"));
  return (fast.length > 0 ? fast : kinds).reduce((best, kind) => (best === "" || size(kind) > 1.001 * size(best) ? kind : best), "");
}
