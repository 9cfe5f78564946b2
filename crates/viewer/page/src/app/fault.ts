// The page that explains what is wrong when nothing can be shown: a folder that is no run, a server that
// refuses or is gone.

import type { FaultyRun } from "../types";
import { h, prose } from "./dom";
import { Gone, Refusal } from "./requests";

export function faultPage(title: string, parts: (HTMLElement | string)[], advice: string[]): HTMLElement {
  return h("main", { class: "fault-page" },
    h("div", { class: "brand", "aria-hidden": "true" }, "embate"),
    h("h1", {}, title), ...parts.map((part) => (typeof part === "string" ? h("p", {}, part) : part)),
    h("h2", {}, "What to do"), h("ul", {}, ...advice.map((text) => h("li", {}, text))),
    h("p", {}, h("button", { type: "button", class: "labelled primary", onclick: () => location.reload() }, "Try again")));
}

export function faultyRuns(runs: FaultyRun[]): HTMLElement {
  return faultPage(runs.length > 1 ? "These results can't be shown" : "This result can't be shown",
    runs.map((run) => h("section", { class: "message error" }, h("p", { class: "path" }, run.path), h("strong", {}, run.code), h("pre", {}, ...prose(run.fault)))),
    ["If the run still goes, wait for its first frame and try again.", "If files were changed or cut off, run the model again: embate run MODEL --force.", "A folder of results holds run.json, history.csv, fields.pvd and fields/; give that folder to embate view."]);
}

export function unreachable(fault: unknown): HTMLElement {
  if (fault instanceof Refusal) {
    const wrong = fault.status === 403 || fault.status === 404 || fault.status === 401;
    return faultPage(wrong ? "This address is not valid any more" : "The server refused", [`${fault.code ? `${fault.code}: ` : ""}${fault.message}`],
      wrong ? ["Each start of the viewer has an address of its own: open the one that the terminal shows.", "Start it again with embate view FOLDER."] : ["Look at the terminal in which the viewer runs.", "Start it again with embate view FOLDER."]);
  }
  const gone = fault instanceof Gone;
  return faultPage(gone ? "The server does not answer" : "The page could not be made", [gone ? "The viewer of embate has ended, or was not reached." : String((fault as Error).message ?? fault)],
    gone ? ["Start it again: embate view FOLDER, and open the address that it shows."] : ["Try again; if it stays so, report it with what stands above."]);
}
