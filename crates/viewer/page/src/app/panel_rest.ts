// Tabs "Parts", "Messages" and "About".

import type { App } from "./app";
import { fill, h, prose, setText } from "./dom";
import { bytes, digits, duration, quantity, whole } from "./format";
import type { Picks } from "./picks";
import type { Warning } from "../types";

export interface Panel {
  element: HTMLElement;
  update: () => void;
}

/** A table of the parts: shown or hidden, elements, energies at the present time. */
export function partsPanel(app: App, picks: Picks): Panel {
  const all = h("button", { type: "button", class: "small", onclick: () => picks.showAll() }, "Show all");
  const tables = h("div");
  const element = h("div", {}, h("div", { class: "inline" }, all), tables);
  const cells: (() => void)[] = [];
  const build = () => {
    cells.length = 0;
    fill(tables, ...app.sessions.map((session, place) => {
      const mark = app.isComparison ? `${place === 0 ? "A" : "B"} · ${session.run.name}` : "";
      const rows = session.run.parts.map((part) => {
        const box = h("input", { type: "checkbox", "aria-label": `Show part ${part.name}`, onchange: () => {
          const hidden = app.view.picture.hidden.filter((name) => name !== part.name);
          app.picture({ hidden: box.checked ? hidden : [...hidden, part.name] });
        } });
        const [kinetic, internal] = [h("td", { class: "number" }), h("td", { class: "number" })];
        cells.push(() => {
          box.checked = !app.view.picture.hidden.includes(part.name);
          for (const [cell, name] of [[kinetic, "kinetic"], [internal, "internal"]] as const) {
            const column = `energy.${name}[${part.name}]`;
            setText(cell, quantity(session.at(column, app.view.time), session.unit(column) || session.run.energy_unit, 3));
          }
        });
        const only = h("button", { type: "button", class: "small", "aria-label": `Show only ${part.name}`, title: `Show only ${part.name}`, onclick: () => picks.isolate(part.name) }, "Only");
        return h("tr", {}, h("td", {}, h("div", { class: "inline" }, box, only)), h("th", { scope: "row" }, part.name, part.is_rigid && h("small", {}, " rigid")), h("td", { class: "number" }, whole(part.elements)), kinetic, internal);
      });
      return h("div", { class: "scroll" }, h("table", {}, h("caption", {}, mark || "Energies at the present time"),
        h("thead", {}, h("tr", {}, ...["Shown", "Part", "Elements", "Kinetic", "Internal"].map((text, i) => h("th", { scope: "col", class: i > 1 ? "number" : "" }, text)))), h("tbody", {}, ...rows)));
    }));
  };
  build();
  app.events.on("run", build);
  const update = () => {
    all.disabled = app.view.picture.hidden.length === 0;
    cells.forEach((cell) => cell());
  };
  return { element, update };
}

/** All warnings and notices of the runs, of a live one those that came so far. */
export function messagesOf(app: App): { error: string | null; list: Warning[] }[] {
  return app.sessions.map((session) => {
    const list = [...session.run.warnings];
    if (app.live?.session === session) {
      for (const notice of app.live.notices) if (!list.some((known) => known.code === notice.code && known.text === notice.text)) list.push(notice);
    }
    const error = session.run.error ?? (app.live?.session === session ? app.live.ended?.error ?? null : null);
    return { error, list };
  });
}

export function messagesPanel(app: App): Panel {
  const element = h("div", { "aria-live": "polite" });
  let shown = "";
  const update = () => {
    const all = messagesOf(app);
    const key = JSON.stringify([all, app.live?.notice]);
    if (key === shown) return;
    shown = key;
    fill(element, ...all.flatMap(({ error, list }, i) => [
      app.isComparison && h("h3", {}, `${i === 0 ? "A" : "B"} · ${app.sessions[i]!.run.name}`),
      error !== null && h("div", { class: "message error" }, h("strong", {}, "The run failed"), h("pre", {}, ...prose(error))),
      ...list.map((warning) => h("div", { class: "message" }, h("strong", {}, warning.code || "Warning"), h("p", {}, ...prose(warning.text)))),
      error === null && list.length === 0 && h("p", { class: "quiet" }, app.sessions[i]!.run.is_over ? "No warnings." : "No warnings so far."),
    ]), app.live?.notice && h("div", { class: "message note" }, h("strong", {}, app.live.notice.refused ? "Not done" : "Done"), h("p", {}, ...prose(app.live.notice.text))));
  };
  return { element, update };
}

/** What ran: model, command, version, figures of the summary. */
export function aboutPanel(app: App): Panel {
  const element = h("div");
  let shown = "";
  const update = () => {
    const key = JSON.stringify(app.sessions.map((session) => session.run));
    if (key === shown) return;
    shown = key;
    fill(element, ...app.sessions.map((session, place) => {
      const { run } = session;
      const summary = (run.summary ?? {}) as Record<string, unknown>;
      const number = (name: string) => (typeof summary[name] === "number" ? (summary[name] as number) : null);
      const text = (name: string) => (typeof summary[name] === "string" ? (summary[name] as string) : null);
      const table: [string, string | null][] = [
        ["Model", run.title && run.title !== run.name ? `${run.name}: ${run.title}` : run.name],
        ["Status", run.is_over ? text("status") ?? "no summary: it was cut off" : "in progress"],
        ["Kind", run.dimension === 3 ? "space" : run.axisymmetric ? "axisymmetric" : "plane"],
        ["Elements, nodes", `${whole(run.elements)}, ${whole(run.nodes)}`],
        ["Steps", number("steps") === null ? null : whole(number("steps")!)],
        ["Time reached", number("time_end") === null ? null : quantity(number("time_end"), "s")],
        ["Frames", `${run.frames.length}, ${bytes(run.size_on_disk)} on disk`],
        ["Wall time", number("wall_seconds") === null ? null : duration(number("wall_seconds")!)],
        ["Speed", number("element_steps_per_second") === null ? null : `${digits(number("element_steps_per_second")! / 1e6, 3)} million element steps per second`],
        ["Threads", number("threads") === null ? null : `${number("threads")}, ${text("simd") ?? ""}`],
        ["Smallest step", number("stable_time_step_min") === null ? null : quantity(number("stable_time_step_min"), "s")],
        ["governed by", text("stable_time_step_governor")],
        ["Energy drift", number("energy_drift") === null ? null : digits(number("energy_drift")!, 3)],
        ["Ledger residual", number("ledger_residual") === null ? null : digits(number("ledger_residual")!, 3)],
        ["Deepest penetration", number("penetration_max") === null ? null : quantity(number("penetration_max"), "m")],
        ["State hash", text("state_hash")],
        ["Version", text("version") === null ? null : `embate ${text("version")}`],
        ["Viewer", `embate ${app.served.version}`],
        ["Folder", run.path],
      ];
      const copy = h("button", { type: "button", class: "small", onclick: () => void copyText(app, run.command ?? "", "Command copied.") }, "Copy");
      return h("div", {}, app.isComparison && h("h3", {}, `${place === 0 ? "A" : "B"} · ${run.name}`),
        run.command !== null && h("div", { class: "command" }, h("code", {}, run.command), copy),
        h("dl", {}, ...table.filter(([, value]) => value !== null && value !== "").flatMap(([name, value]) => [h("dt", {}, name), h("dd", {}, value)])));
    }));
  };
  return { element, update };
}

/** Copies a text and says so. */
export async function copyText(app: App, text: string, said: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
    app.say(said);
  } catch {
    const area = h("textarea", { class: "hidden-text" });
    area.value = text;
    document.body.append(area);
    area.select();
    const done = document.execCommand("copy");
    area.remove();
    app.say(done ? said : text);
  }
}
