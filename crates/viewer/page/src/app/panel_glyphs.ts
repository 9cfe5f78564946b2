// Arrows of contact forces, and glyphs of a field: vectors, principal values. A part of the tab "View".

import type { App } from "./app";
import { check, choice, h, row, setText } from "./dom";
import { bind, bindCheck, group } from "./form";
import { glyphFields } from "./wish";

export function glyphGroup(app: App): HTMLElement | null {
  const { run } = app;
  const picture = () => app.view.picture;
  const fields = glyphFields(run);
  if (!run.has_arrows && fields.length === 0) return null;
  const field = choice([["", "none"], ...fields.map(({ key, label }): [string, string] => [key, label])], picture().glyphs ?? "", (value) => app.picture({ glyphs: value === "" ? null : value }));
  bind(app, field, () => picture().glyphs ?? "");
  const count = choice([["12", "few"], ["24", "some"], ["48", "many"], ["0", "every node or element"]], String(picture().glyph_count), (value) => app.picture({ glyph_count: Number(value) }));
  bind(app, count, () => String(picture().glyph_count));
  const counts = row("Number", count);
  const hint = h("p", { class: "quiet" });
  const arrow = h("input", { type: "range", min: -1, max: 1, step: 0.05, value: Math.log10(picture().arrow_scale), oninput: () => app.picture({ arrow_scale: Number((10 ** Number(arrow.value)).toPrecision(3)) }) });
  bind(app, arrow, () => String(Math.log10(picture().arrow_scale)));
  const length = row("Length", arrow);
  const update = () => {
    const kind = fields.find(({ key }) => key === picture().glyphs)?.kind;
    counts.hidden = kind === undefined;
    length.hidden = kind === undefined && !picture().arrows;
    setText(hint, kind === "tensors" ? "Principal values: red arrows outwards in tension, blue arrows inwards in compression." : "");
    hint.hidden = hint.textContent === "";
  };
  app.events.on("view", update);
  update();
  return group("Arrows",
    run.has_arrows && bindCheck(app, check("Contact forces", picture().arrows, (on) => app.picture({ arrows: on })), () => picture().arrows),
    fields.length > 0 && row("Field", field), counts, hint, length);
}
