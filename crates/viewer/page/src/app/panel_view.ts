// Tab "View": quantity, colours, range, deformation, and what else the picture shows.

import type { App } from "./app";
import { colourRange } from "./colours";
import { check, choice, fill, h, row, setText } from "./dom";
import { bind, bindCheck, group, numberInput } from "./form";
import { scaled, unitText } from "./format";
import { glyphGroup } from "./panel_glyphs";
import { sectionGroup } from "./panel_section";
import type { Stage } from "./stage";
import { MAPS, type RangeMode } from "./view";
import { isAveraged } from "./wish";
import type { MapName } from "../viewport/viewport";
import type { Scalar } from "../types";

/** The choice of the quantity: those with components in groups. */
export function fieldChoice(app: App): HTMLSelectElement {
  const select = h("select", { onchange: () => app.change({ scalar: select.value === "" ? null : select.value }) });
  const groups = new Map<string, Scalar[]>();
  for (const scalar of app.run.scalars) {
    const stem = scalar.key.split(".")[0]!;
    groups.set(stem, [...(groups.get(stem) ?? []), scalar]);
  }
  const option = (scalar: Scalar) => h("option", { value: scalar.key, title: scalar.doc }, scalar.label + (unitText(scalar.unit) === "" ? "" : ` / ${unitText(scalar.unit)}`));
  select.append(h("option", { value: "" }, "parts (no quantity)"));
  for (const [stem, scalars] of groups) {
    if (scalars.length === 1) select.append(option(scalars[0]!));
    else select.append(h("optgroup", { label: stem.replace(/_/g, " ") }, ...scalars.map(option)));
  }
  const update = () => {
    const value = app.view.scalar ?? "";
    if (select.value !== value) select.value = value;
  };
  app.events.on("view", update);
  update();
  return select;
}

export function viewPanel(app: App, stage: Stage): HTMLElement {
  const { run } = app;
  const field = fieldChoice(app);
  const doc = h("p", { class: "quiet" });
  const picture = () => app.view.picture;

  const map = choice(MAPS, picture().map, (value) => app.picture({ map: value as MapName }));
  bind(app, map, () => picture().map);
  const bands = choice([["0", "smooth"], ["5", "5"], ["8", "8"], ["10", "10"], ["12", "12"], ["16", "16"]], String(picture().bands), (value) => app.picture({ bands: Number(value) }));
  bind(app, bands, () => String(picture().bands));

  const mode = choice([["run", "whole run"], ["frame", "this frame"], ["own", "own numbers"]], app.view.range_mode, (value) => {
    const now = colourRange(app, app.sessions[0]!);
    app.change({ range_mode: value as RangeMode, picture: { ...picture(), range: value === "own" ? picture().range ?? now ?? [0, 1] : picture().range } });
  });
  bind(app, mode, () => app.view.range_mode);
  const by = () => scaled(Math.max(...(colourRange(app, app.sessions[0]!) ?? [0, 1]).map(Math.abs)), app.sessions[0]!.scalar(app.view.scalar)?.unit ?? "");
  let shown = by();
  const fault = h("p", { class: "fault-text", role: "status" });
  const [low, high] = [0, 1].map((end) => {
    const input = numberInput(0, (typed) => {
      const range = [...(picture().range ?? colourRange(app, app.sessions[0]!) ?? [0, 1])] as [number, number];
      range[end] = typed * shown.factor;
      const fine = range[0] < range[1];
      setText(fault, fine ? "" : "The lower end must be below the upper.");
      if (fine) app.change({ range_mode: "own", picture: { ...picture(), range } });
    }, { step: "any", class: "short", "aria-label": end === 0 ? "Lower end of the range" : "Upper end of the range" });
    return input;
  }) as [HTMLInputElement, HTMLInputElement];
  const unit = h("span", { class: "unit" });
  const ends = h("div", { class: "row" }, h("span", { class: "label" }, "From, to"), h("div", { class: "inline" }, low, high, unit));

  const scale = numberInput(picture().scale, (value) => app.picture({ scale: Math.max(0, value) }), { min: 0, step: "any", class: "short" });
  bind(app, scale, () => String(picture().scale));
  const scales = h("div", { class: "inline" }, scale, ...[0, 1, 10].map((value) => h("button", { type: "button", class: "small", onclick: () => app.picture({ scale: value }), "aria-label": `Deformation ${value} times` }, `${value}×`)));
  const averaged = bindCheck(app, check("Averaged at nodes", picture().averaged, (on) => app.picture({ averaged: on }), "Mean of the elements of a part around each node; otherwise each element has its own value"), () => picture().averaged);
  const iso = bindCheck(app, check("Lines of equal value", picture().iso, (on) => app.picture({ iso: on })), () => picture().iso);

  const mirrors = ["x", "y", "z"].slice(0, run.dimension).map((axis, i) => bindCheck(app, check(axis, picture().mirror[i]!, (on) => {
    const mirror = [...picture().mirror] as [boolean, boolean, boolean];
    mirror[i] = on;
    app.picture({ mirror });
  }, `Complete by the image across ${axis} = 0`), () => picture().mirror[i]!));

  const update = () => {
    const scalar = app.sessions[0]!.scalar(app.view.scalar);
    setText(doc, scalar ? `${scalar.doc.replace(/^./, (c) => c.toUpperCase())}${scalar.location === "node" ? " · on nodes" : isAveraged(app.view, run) ? " · on elements, averaged at the nodes of each part" : " · on elements"}` : "Bodies in the colours of their parts");
    const states = scalar === null || scalar.states.length > 0;
    for (const input of [mode, low, high, bands]) input.disabled = states;
    ends.hidden = states;
    averaged.hidden = scalar?.location !== "cell" || states;
    averaged.querySelector("input")!.disabled = picture().iso;
    iso.hidden = states;
    shown = by();
    setText(unit, shown.unit);
    const range = colourRange(app, app.sessions[0]!) ?? [0, 1];
    [low, high].forEach((input, i) => {
      const text = String(Number((range[i]! / shown.factor).toPrecision(5)));
      if (document.activeElement !== input && input.value !== text) input.value = text;
    });
  };
  app.events.on(["view", "shown", "range"], update);

  const element = h("div", {},
    group("Quantity", row("Shown", field), doc, row("Range", mode), ends, fault, row("Colours", map), row("Steps", bands), averaged, iso,
      app.isComparison && bindCheck(app, check("One range for both runs", app.view.common, (on) => app.change({ common: on })), () => app.view.common)),
    group("Bodies", row("Deformation", scales, "shown = initial + factor · displacement"),
      bindCheck(app, check("Mesh lines", picture().lines, (on) => app.picture({ lines: on })), () => picture().lines),
      bindCheck(app, check("Undeformed shape", picture().undeformed, (on) => app.picture({ undeformed: on }), "The bodies as they were at the beginning, as an outline"), () => picture().undeformed),
      bindCheck(app, check("Obstacles", picture().obstacles, (on) => app.picture({ obstacles: on })), () => picture().obstacles),
      h("div", { class: "row" }, h("span", { class: "label" }, "Mirror across"), h("div", { class: "inline", role: "group", "aria-label": "Mirror across" }, ...mirrors)),
      app.isComparison && bindCheck(app, check("One camera for both runs", app.view.linked, (on) => app.change({ linked: on })), () => app.view.linked)),
    run.dimension === 3 && sectionGroup(app, stage), glyphGroup(app));
  fill(doc);
  update();
  return element;
}
