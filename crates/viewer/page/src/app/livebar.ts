// The bar of a run that is watched while it goes: how far it is, its step and what governs it, energy drift,
// time left, and its buttons. At the end: what happened. Above it the banner of lost connections, and what
// the page has to say.

import type { App } from "./app";
import { confirmStop } from "./dialogs";
import { fill, h, iconButton, prose, setText } from "./dom";
import { digits, duration, quantity, timeText, whole } from "./format";
import { icons } from "./icons";

export function liveBar(app: App): HTMLElement | null {
  const { live } = app;
  if (!live) return null;
  const bar = h("progress", { max: 1, value: 0, "aria-label": "Progress of the run" });
  const state = h("strong", { class: "live-state" });
  const figures = h("dl", { class: "live-figures" });
  const end = h("p", { class: "live-end", role: "status" });
  const said = h("p", { class: "live-said", role: "status" });
  const pause = h("button", { type: "button", class: "labelled", onclick: () => live.command(live.progress?.state === "paused" ? "resume" : "pause") });
  const keep = h("button", { type: "button", class: "labelled", title: "Writes a checkpoint from which embate resume continues", onclick: () => live.command("checkpoint") });
  keep.innerHTML = `${icons.keep}<span>Keep state</span>`;
  const stop = h("button", { type: "button", class: "labelled danger", onclick: () => void confirmStop().then((yes) => yes && live.command("stop")) });
  stop.innerHTML = `${icons.stop}<span>Stop</span>`;
  const buttons = h("div", { class: "buttons" }, pause, keep, stop);
  const element = h("section", { class: "live", "aria-label": "Run in progress" }, h("div", { class: "live-top" }, state, bar, buttons), figures, end, said);

  const cells = new Map<string, HTMLElement>();
  const figure = (name: string, text: string, title = "") => {
    let cell = cells.get(name);
    if (!cell) {
      cell = h("dd");
      cells.set(name, cell);
      figures.append(h("div", {}, h("dt", {}, name), cell));
    }
    setText(cell, text);
    if (cell.title !== title) cell.title = title;
    cell.parentElement!.hidden = text === "";
  };
  const update = () => {
    const { progress: p, ended } = live;
    const word = ended ? { done: "Done", stopped: "Stopped", failed: "Failed" }[ended.status] : !live.connected ? "Not connected" : p ? { running: "Running", paused: "Paused", stopping: "Stopping …" }[p.state] : "Starting …";
    setText(state, word);
    state.dataset["state"] = ended ? ended.status : p?.state ?? "starting";
    const off = !live.connected || ended !== null || p?.state === "stopping";
    for (const button of [pause, keep, stop]) button.disabled = off;
    buttons.hidden = ended !== null;
    const paused = p?.state === "paused";
    const label = paused ? "Resume" : "Pause";
    if (pause.textContent !== label) pause.innerHTML = `${paused ? icons.play : icons.pause}<span>${label}</span>`;
    if (p) {
      const total = p.end ?? app.end;
      bar.value = total > 0 ? Math.min(1, p.time / total) : 0;
      bar.setAttribute("aria-valuetext", `${Math.round(100 * bar.value)} percent`);
      figure("time", `${timeText(p.time, total)} of ${timeText(total, total)}`);
      figure("step", whole(p.step));
      figure("Δt", quantity(p.time_step, "s", 3), p.governor);
      figure("governed by", ended ? "" : p.governor);
      figure("energy drift", p.energy_drift === null ? "" : digits(p.energy_drift, 2));
      figure("wall time", duration(p.seconds));
      figure("left", p.left === null || ended || paused ? "" : duration(p.left));
      figure("frames left out here", p.dropped > 0 ? whole(p.dropped) : "", "The page was too slow for these frames; the run was not held up, and those on disk are complete.");
    }
    end.hidden = ended === null;
    if (ended) {
      const words = { done: "The run has reached its end.", stopped: "The run was stopped; its results until then are kept.", failed: "The run failed." }[ended.status];
      const after = ended.stays ? "" : " The server has ended with it; what was loaded stays here.";
      setText(end, `${words}${ended.error ? ` ${ended.error.split("\n")[0]}` : ""}${after}`);
    }
    said.hidden = live.notice === null;
    if (said.dataset["text"] !== (live.notice?.text ?? "")) {
      said.dataset["text"] = live.notice?.text ?? "";
      fill(said, ...prose(live.notice?.text ?? ""));
    }
    said.classList.toggle("refused", live.notice?.refused ?? false);
  };
  app.events.on(["live", "message", "run"], update);
  update();
  return element;
}

/** Lost connections, faults of one of two runs, and short texts. */
export function banners(app: App): HTMLElement {
  const connection = h("div", { class: "banner", role: "alert", hidden: true });
  const note = h("div", { class: "banner quiet-banner", role: "status", hidden: true });
  const faults = app.served.runs.filter((run) => "fault" in run).map((run) => h("div", { class: "banner", role: "alert" }, h("strong", {}, `${run.path} can't be shown. `), "fault" in run ? `${run.code}: ${run.fault}` : ""));
  let timer = 0;
  app.events.on("connection", () => {
    const { connection: now } = app.requests;
    connection.hidden = now === "open" || (now === "over" && app.live !== null);
    if (now === "gone") fill(connection, h("strong", {}, "The server does not answer. "), lastHeard(app), "The page tries again by itself. If the viewer was closed, start it again: ", h("code", {}, `embate view ${app.run.path}`), h("button", { type: "button", class: "small", onclick: () => void app.requests.ask() }, "Try now"));
    if (now === "over") fill(connection, "The server has ended.");
  });
  app.events.on("message", () => {
    if (!app.note) return;
    const { text, alert } = app.note;
    app.note = null;
    note.hidden = false;
    note.className = alert ? "banner" : "banner quiet-banner";
    fill(note, h("span", {}, text), iconButton(icons.close, "Close", () => (note.hidden = true)));
    window.clearTimeout(timer);
    if (!alert) timer = window.setTimeout(() => (note.hidden = true), 4000);
  });
  return h("div", { class: "banners" }, ...faults, connection, note);
}

/** How far a live run was when the connection was lost: at its end the server may have ended with it. */
function lastHeard(app: App): string {
  const progress = app.live?.progress;
  if (!progress || app.live?.ended) return "";
  const total = progress.end ?? app.end;
  return `The run was at ${timeText(progress.time, total)} of ${timeText(total, total)}${progress.time > 0.99 * total ? "; it may have ended, and the server with it" : ""}. `;
}
