// The bar at the top (run, quantity, export, link, theme, help, panel) and the tools beside the picture (fit,
// directions, zoom, mesh lines, arrows).

import type { Direction } from "../viewport/viewport";
import type { App } from "./app";
import { h, iconButton } from "./dom";
import { icons } from "./icons";
import { toggleSection } from "./panel_section";
import { fieldChoice } from "./panel_view";
import { copyText } from "./panel_rest";
import { isDark } from "./theme";
import type { Stage } from "./stage";

export const DIRECTIONS: [Direction, string][] = [["iso", "Three sides"], ["x", "From +x"], ["-x", "From −x"], ["y", "From +y"], ["-y", "From −y"], ["z", "From +z"], ["-z", "From −z"]];

export function toolbar(app: App, actions: { export: () => void; help: () => void; theme: () => void }): HTMLElement {
  const field = fieldChoice(app);
  field.setAttribute("aria-label", "Quantity shown");
  const { run } = app;
  const name = app.isComparison ? app.sessions.map((session) => session.run.name).join(" · ") : run.name;
  const panel = iconButton(icons.panel, "Panel", () => app.change({ panel: !app.view.panel }));
  const theme = iconButton(icons.theme, "Dark or light", actions.theme);
  const update = () => {
    panel.setAttribute("aria-pressed", String(app.view.panel));
    theme.setAttribute("aria-pressed", String(isDark(app.view.theme)));
  };
  app.events.on(["view", "theme"], update);
  update();
  return h("header", { class: "toolbar" },
    h("div", { class: "brand", "aria-hidden": "true" }, "embate"),
    h("h1", { title: run.path }, name, h("small", {}, run.title && run.title !== name && !app.isComparison ? run.title : "")),
    field,
    h("div", { class: "buttons" }, iconButton(icons.export, "Export", actions.export), iconButton(icons.link, "Copy link", () => void copyText(app, app.link(), "Link to this view copied.")), theme, iconButton(icons.help, "Help", actions.help), panel));
}

export function pictureTools(app: App, stage: Stage): HTMLElement {
  const mesh = iconButton(icons.mesh, "Mesh lines", () => app.picture({ lines: !app.view.picture.lines }));
  const arrows = iconButton(icons.arrows, "Arrows of contact forces", () => app.picture({ arrows: !app.view.picture.arrows }));
  const measure = iconButton(icons.measure, "Measure a distance", () => app.use(app.tool === "measure" ? "node" : "measure"));
  const section = iconButton(icons.section, "Section", () => toggleSection(app, stage));
  const space = app.run.dimension === 3;
  const look = h("select", { "aria-label": "Look from", title: "Look from", class: "look", onchange: () => {
    stage.look(look.value as Direction);
    look.value = "";
  } }, h("option", { value: "" }, "From"), ...DIRECTIONS.map(([key, label]) => h("option", { value: key }, label)));
  const update = () => {
    mesh.setAttribute("aria-pressed", String(app.view.picture.lines));
    arrows.setAttribute("aria-pressed", String(app.view.picture.arrows));
    section.setAttribute("aria-pressed", String(app.view.picture.section !== null));
    measure.setAttribute("aria-pressed", String(app.tool === "measure"));
  };
  app.events.on("view", update);
  update();
  return h("div", { class: "tools", role: "group", "aria-label": "Picture" },
    iconButton(icons.fit, "Fit", () => stage.fit()), iconButton(icons.plus, "Zoom in", () => stage.zoom(1.25)), iconButton(icons.minus, "Zoom out", () => stage.zoom(0.8)),
    mesh, app.run.has_arrows && arrows, space && section, measure, space && look);
}
