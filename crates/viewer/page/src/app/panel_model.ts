// Tab "Model": faults and warnings with their lines, what is drawn of the model, its parts and the time step.
// And the page of a model of which nothing can be drawn.

import { sample } from "../viewport/model_glyphs";
import { fill, h, prose } from "./dom";
import { faultPage } from "./fault";
import { digits, quantity, whole } from "./format";
import type { Model } from "./model";
import type { About, GlyphKind, PartRow, Remark } from "./model_types";
import type { Panel } from "./panel_rest";

const SAMPLE = 18;

function remark(one: Remark, kind: "error" | "warning"): HTMLElement {
  const place = one.line > 0 ? `${one.file}:${one.line}:${one.column}` : one.file;
  return h("div", { class: kind === "error" ? "message error" : "message" },
    h("strong", {}, one.code), h("p", { class: "path" }, place, one.path !== "" && ` · ${one.path}`),
    h("p", {}, ...prose(one.message)), one.consequence !== "" && h("p", {}, ...prose(one.consequence)),
    one.help !== "" && h("p", { class: "quiet" }, ...prose(one.help)));
}

/** Faults and warnings. */
function remarks(about: About): HTMLElement[] {
  const title = (count: number, what: string) => h("h3", {}, `${count} ${what}${count === 1 ? "" : "s"}`);
  return [
    ...(about.faults.length > 0 ? [title(about.faults.length, "fault"), ...about.faults.map((one) => remark(one, "error"))] : []),
    ...(about.warnings.length > 0 ? [title(about.warnings.length, "warning"), ...about.warnings.map((one) => remark(one, "warning"))] : []),
  ];
}

/** A row for each kind of glyph that the model has, with a box by which it is drawn or not. */
function legend(model: Model): HTMLElement | null {
  const { about } = model;
  const rows = about.kinds.map((kind) => ({ kind, own: about.glyphs.filter((glyph) => glyph.kind === kind.name) })).filter(({ own }) => own.length > 0);
  if (rows.length === 0) return null;
  return h("fieldset", {}, h("legend", {}, "Drawn"), ...rows.map(({ kind, own }) => {
    const box = h("input", { type: "checkbox", checked: !model.hidden.has(kind.name), onchange: () => model.show(kind.name, box.checked) });
    const names = own.map((glyph) => (glyph.name === "" ? glyph.path : glyph.name));
    return h("div", { class: "glyph-row" },
      h("label", { class: "check" }, box, picture(kind), h("span", {}, kind.label, own.length > 1 && ` (${own.length})`)),
      kind.name !== "fault" && kind.name !== "governor" && h("p", { class: "quiet", title: own.map((glyph) => glyph.text).join("\n") }, names.slice(0, 6).join(", "), names.length > 6 && `, and ${names.length - 6} more`));
  }));
}

function picture(kind: GlyphKind): HTMLCanvasElement {
  const sharp = Math.min(window.devicePixelRatio || 1, 2);
  const canvas = h("canvas", { width: SAMPLE * sharp, height: SAMPLE * sharp, class: "glyph-sample", "aria-hidden": "true" });
  const paper = canvas.getContext("2d");
  paper?.scale(sharp, sharp);
  if (paper) sample(paper, kind, SAMPLE);
  return canvas;
}

function table(about: About): HTMLElement | null {
  if (about.parts.length === 0) return null;
  const step = (part: PartRow) => (part.is_rigid ? "rigid" : quantity(part.stable_step, "s", 3));
  const size = (part: PartRow) => part.size.map((side) => digits(side * 1e3, 3)).join(" × ");
  const rows = about.parts.map((part) => h("tr", { title: `waves ${quantity(part.wave_speed, "m/s", 3)}, ${whole(part.nodes)} nodes` },
    h("th", { scope: "row" }, part.name), h("td", {}, ...part.kinds.map(([kind, count]) => h("div", {}, `${whole(count)} ${kind}`))),
    h("td", { class: "number" }, `${digits(part.mass, 3)} ${about.mass_unit}`), h("td", { class: "number size" }, size(part)),
    h("td", { class: part.governs ? "number governs" : "number" }, step(part))));
  const head = ["Part", "Elements", "Mass", "Size, mm", "Stable step"].map((text, i) => h("th", { scope: "col", class: i > 1 ? "number" : "" }, text));
  return h("div", { class: "scroll" }, h("table", { class: "model-parts" }, h("caption", {}, "Parts"), h("thead", {}, h("tr", {}, ...head)), h("tbody", {}, ...rows)));
}

function steps(about: About): HTMLElement | null {
  if (about.step === null) return null;
  const { first, governor, count } = about.step;
  return h("p", {}, `First time step ${quantity(first, "s", 3)}, governed by ${governor}: about ${whole(count)} steps to ${quantity(about.end, "s")}.`);
}

export function modelPanel(model: Model | null): Panel {
  const element = h("div", { "aria-live": "polite" });
  let shown: About | null = null;
  const update = () => {
    if (model === null || shown === model.about) return;
    shown = model.about;
    const { about } = model;
    const said = remarks(about);
    fill(element, ...said, said.length === 0 && h("p", { class: "quiet" }, about.is_checked ? "No faults, no warnings." : "Being checked …"), steps(about), legend(model), table(about),
      h("p", { class: "quiet" }, `Follows ${about.path}: save the file, and the page shows the new model.`));
  };
  return { element, update };
}

/** What stands there when nothing of a model can be drawn. */
export function faultyModel(about: About): HTMLElement {
  return faultPage("This model has faults", about.faults.map((one) => remark(one, "error")), ["Edit the file and save it: the page shows the model as soon as something of it can be drawn."]);
}
