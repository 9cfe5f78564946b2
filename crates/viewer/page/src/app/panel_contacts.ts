// Tab "Contacts": the resultant of each contact and obstacle over time, and how deep it is penetrated.

import type { App } from "./app";
import { LINES } from "./colours";
import { choice, fill, h, row } from "./dom";
import { Plot } from "./plot";
import { column, largest, linesOf } from "./tables";

export function contactsPanel(app: App): { element: HTMLElement; update: () => void; plots: Plot[] } {
  const forces = new Plot(app, "Force");
  const depth = new Plot(app, "Penetration");
  const head = h("div");
  const element = h("div", {}, head, forces.element, depth.element);
  let chosen = "";
  let known = "";

  let stale = true;
  app.events.on("history", () => (stale = true));
  const update = () => {
    if (!stale) return;
    stale = false;
    const columns = [...new Set(app.sessions.flatMap((session) => session.names()))];
    const places = [...new Set(columns.map((name) => /^(contact|obstacle)\.force_x\[(.*)\]$/.exec(name)).filter((m) => m !== null).map((m) => `${m[1]}/${m[2]}`))];
    if (!places.includes(chosen)) {
      const size = (place: string) => Math.max(...["x", "y", "z"].flatMap((axis) => app.sessions.map((s) => largest(s.column(`${place.replace("/", `.force_${axis}[`)}]`)))));
      chosen = places.reduce((best, place) => (best === "" || size(place) > size(best) ? place : best), "");
    }
    if (known !== places.join("\n")) {
      known = places.join("\n");
      const select = choice(places.map((place) => [place, `${place.slice(place.indexOf("/") + 1)} (${place.split("/")[0]})`]), chosen, (value) => {
        chosen = value;
        stale = true;
        update();
      });
      fill(head, places.length > 0 ? row("Between", select) : h("p", { class: "quiet" }, app.run.contacts.length + app.run.obstacles.length === 0 ? "The model has neither contacts nor obstacles." : "The history has no forces of contacts yet."));
    }
    forces.element.hidden = depth.element.hidden = places.length === 0;
    if (chosen === "") return;
    const [kind, name] = [chosen.slice(0, chosen.indexOf("/")), chosen.slice(chosen.indexOf("/") + 1)];
    const unit = (stem: string) => app.sessions.map((s) => s.unit(`${kind}.${stem}[${name}]`)).find((u) => u !== "") ?? "";
    const axes = ["x", "y", "z"].slice(0, app.run.dimension);
    const words = kind === "contact" ? `Force of ${name}` : `Force of obstacle ${name}`;
    const force = linesOf(app, axes.map((axis, i) => ({ label: `force ${axis}`, unit: unit(`force_${axis}`), colour: LINES[i]!, of: column(`${kind}.force_${axis}[${name}]`) })));
    forces.set(words, force.times, force.lines);
    const deep = linesOf(app, [{ label: "deepest", unit: unit("penetration"), colour: LINES[4]!, of: column(`${kind}.penetration[${name}]`) }]);
    depth.set("Penetration", deep.times, deep.lines);
  };
  return { element, update, plots: [forces, depth] };
}
