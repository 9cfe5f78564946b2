// One picture: the canvas of a run with its title, legend, probes and what is said when it can't be drawn.
// Keys on the canvas turn and move it; a click without a movement sets a probe.

import type { Frame, Topology, Vector } from "../types";
import { ModelGlyphs } from "../viewport/model_glyphs";
import { Viewport, type Mark, type Pick, type Ruler } from "../viewport/viewport";
import type { App } from "./app";
import { colourBands, colourRange, LINES, PROBE_COLOURS } from "./colours";
import { fill, h } from "./dom";
import { quantity } from "./format";
import { Legend } from "./legend";
import type { Model } from "./model";
import { measured } from "./panel_measure";
import type { Session } from "./session";
import { Readout } from "./readout";
import { isDark } from "./theme";
import type { Tracks } from "./tracks";

/** Pictures that take longer (ms) are not drawn only to say what is under the mouse. */
const SLOW = 250;

export class Pane {
  readonly element: HTMLElement;
  readonly canvas: HTMLCanvasElement;
  readonly legend: Legend;
  viewport: Viewport | null = null;
  /** The camera was moved by the user. */
  onCamera: () => void = () => {};
  onPick: (pick: Pick) => void = () => {};
  /** The menu is wanted at a place of the window. */
  onMenu: (pick: Pick | null, x: number, y: number) => void = () => {};
  private topology: Topology | null = null;
  private readonly trouble = h("div", { class: "trouble", role: "alert", hidden: true });
  private down: { x: number; y: number } | null = null;
  /** Of the mouse over the picture. */
  private pointer: { x: number; y: number } | null = null;

  constructor(private readonly app: App, readonly session: Session, private readonly tracks: Tracks) {
    const { run } = session;
    this.canvas = h("canvas", {
      tabindex: 0, role: "img",
      "aria-label": `Picture of ${run.name}. Arrow keys ${run.dimension === 3 ? "turn it, with Shift they move it" : "move it"}; plus and minus zoom; f fits it.`,
    });
    this.legend = new Legend(app, session);
    const title = app.isComparison ? h("h2", { class: "pane-title" }, `${session.index === app.sessions[0]!.index ? "A" : "B"} · ${run.name}`, h("small", { title: run.path }, run.path)) : null;
    this.element = h("section", { class: "pane", "aria-label": `Picture of ${run.name}` }, this.canvas, title, this.legend.element, new Readout(app, session, this.canvas, (x, y) => this.quick(x, y)).element, this.trouble);
    try {
      this.viewport = new Viewport(this.canvas, run, { dark: isDark(app.view.theme), quantity: (value, unit) => quantity(value, unit, 3) });
      if (this.viewport.lost) this.fail();
    } catch (fault) {
      this.viewport = null;
      this.fail(String((fault as Error).message ?? fault));
    }
    this.canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.fail();
    });
    this.canvas.addEventListener("webglcontextrestored", () => {
      this.trouble.hidden = true;
    });
    if (this.viewport) {
      this.viewport.setState(this.state());
      this.viewport.onCamera = () => this.onCamera();
      this.viewport.onSection = (section, ended) => {
        app.isDragging = !ended;
        app.picture({ section });
      };
      new ResizeObserver(() => this.viewport?.resize()).observe(this.canvas);
      this.listen();
      if (app.model !== null) this.follow(app.model, this.viewport);
    }
    app.events.on(["view", "shown", "range", "probe"], () => this.update());
    app.events.on("theme", () => this.viewport?.setDark(isDark(app.view.theme)));
  }

  /** Draws the glyphs of a model before it runs, and says what they are where the pointer is. */
  private follow(model: Model, viewport: Viewport): void {
    const glyphs = new ModelGlyphs();
    const tip = h("div", { class: "glyph-tip", hidden: true });
    this.element.append(tip);
    viewport.drawOver = (paper, sight) => glyphs.draw(paper, model.about.kinds, model.about.glyphs, model.hidden, sight);
    this.app.events.on("model", () => {
      viewport.run = this.session.run;
      viewport.redraw();
    });
    this.canvas.addEventListener("pointermove", (event) => {
      const box = this.canvas.getBoundingClientRect();
      const [x, y] = [event.clientX - box.left, event.clientY - box.top];
      const glyph = event.buttons === 0 ? glyphs.at(x, y) : null;
      tip.hidden = glyph === null;
      if (glyph === null) return;
      const label = model.about.kinds.find((kind) => kind.name === glyph.kind)?.label ?? glyph.kind;
      fill(tip, h("strong", {}, glyph.name === "" ? label : `${label}: ${glyph.name}`), h("p", {}, glyph.text));
      tip.style.left = `${Math.min(x + 14, box.width - 260)}px`;
      tip.style.top = `${y + 14}px`;
    });
    this.canvas.addEventListener("pointerleave", () => (tip.hidden = true));
  }

  private fail(detail = ""): void {
    this.trouble.hidden = false;
    this.trouble.replaceChildren(
      h("p", {}, h("strong", {}, "No picture: this browser offers no WebGL 2 here.")),
      h("p", {}, "Tables and plots beside it work. To see the bodies, switch on hardware acceleration in the browser's settings, or open the page in another browser; ParaView opens fields.pvd in the run's folder."),
      ...(detail === "" ? [] : [h("p", { class: "detail" }, detail)]),
    );
  }

  private listen(): void {
    this.canvas.addEventListener("pointerdown", (event) => {
      this.down = event.button === 0 && event.isPrimary ? { x: event.clientX, y: event.clientY } : null;
    });
    this.canvas.addEventListener("pointerup", (event) => {
      const down = this.down;
      this.down = null;
      if (!down || Math.hypot(event.clientX - down.x, event.clientY - down.y) > 4) return;
      const pick = this.at(event.clientX, event.clientY);
      if (pick) this.onPick(pick);
    });
    this.canvas.addEventListener("pointercancel", () => (this.down = null));
    this.canvas.addEventListener("pointermove", (event) => (this.pointer = { x: event.clientX, y: event.clientY }));
    this.canvas.addEventListener("pointerleave", () => (this.pointer = null));
    // a drag with the right button moves the picture: only one that stays where it is opens the menu
    let right: { x: number; y: number } | null = null;
    let pointer = "";
    this.canvas.addEventListener("pointerdown", (event) => {
      pointer = event.pointerType;
      right = event.button === 2 ? { x: event.clientX, y: event.clientY } : null;
    });
    const menu = (x: number, y: number) => this.onMenu(this.at(x, y), x, y);
    this.canvas.addEventListener("pointerup", (event) => {
      if (event.button === 2 && right !== null && Math.hypot(event.clientX - right.x, event.clientY - right.y) <= 4) menu(event.clientX, event.clientY);
    });
    this.canvas.addEventListener("contextmenu", (event) => {
      // of a mouse the menu comes when the button is let go, of a touch or of the key at once
      if (event.button === 2 && pointer === "mouse" && !event.ctrlKey) return;
      this.down = null;
      const box = this.canvas.getBoundingClientRect();
      menu(event.clientX || box.left + 0.5 * box.width, event.clientY || box.top + 0.5 * box.height);
    });
  }

  /** What is seen at a place of the window. */
  private at(x: number, y: number): Pick | null {
    const box = this.canvas.getBoundingClientRect();
    return this.viewport?.pick(x - box.left, y - box.top) ?? null;
  }

  /** The same where pictures take so little time that it may be asked for at any moment. */
  private quick(x: number, y: number): Pick | null {
    return (this.viewport?.figures.milliseconds ?? Infinity) < SLOW ? this.at(x, y) : null;
  }

  /** What is under the mouse. */
  get pointed(): Pick | null {
    return this.pointer === null ? null : this.at(this.pointer.x, this.pointer.y);
  }

  /** The state of this picture: that of the view, with the second run's own camera where it has one. */
  private state(): ReturnType<Viewport["state"]> {
    const { view } = this.app;
    const second = this.session !== this.app.sessions[0];
    const camera = second && !view.linked ? view.camera2 : view.picture.camera;
    return { ...view.picture, camera, range: view.range_mode === "own" && this.hasOwnRange() ? view.picture.range : null, bands: colourBands(this.app) };
  }
  private hasOwnRange(): boolean {
    return (this.session.scalar(this.app.view.scalar)?.states.length ?? 0) === 0;
  }

  private stateKey = "";
  private rangeKey = "";
  private markKey = "";
  update(): void {
    const viewport = this.viewport;
    if (!viewport) return;
    const state = this.state();
    const key = JSON.stringify(state);
    if (key !== this.stateKey) {
      this.stateKey = key;
      viewport.setState(state);
    }
    const range = colourRange(this.app, this.session);
    if (String(range) !== this.rangeKey) {
      this.rangeKey = String(range);
      viewport.setRange(range);
    }
    if (this.topology) {
      const [marks, rulers] = [this.marks(), this.rulers()];
      const marked = JSON.stringify([marks, rulers]);
      if (marked !== this.markKey) {
        this.markKey = marked;
        viewport.mark(marks, rulers);
      }
    }
    if (viewport.lost && this.trouble.hidden) this.fail();
  }

  /** Where a node, or the middle of an element, is drawn; nothing for nodes of the skin, which the viewport knows. */
  private place(of: "node" | "cell", number: number): Vector | undefined {
    if (of === "node" && this.viewport?.hasNode(number)) return undefined;
    const found = this.tracks.at(this.session, of, number);
    const { scale } = this.app.view.picture;
    return found === null ? undefined : (found.initial.map((x, k) => x + scale * (found.now[k]! - x)) as Vector);
  }
  private mark(of: "node" | "cell", number: number, colour: string, label: string): Mark {
    const at = this.place(of, number);
    return { node: of === "node" ? number : -1, colour, label, ...(at === undefined ? {} : { at }) };
  }

  private marks(): Mark[] {
    const { view, started } = this.app;
    const marks = view.probes.flatMap((probe, i) => {
      if (probe.run !== this.session.index) return [];
      const number = probe.of === "node" ? probe.node : probe.cell;
      return [this.mark(probe.of, number, PROBE_COLOURS[i % PROBE_COLOURS.length]!, probe.of === "node" ? String(number) : `element ${number}`)];
    });
    if (started?.run === this.session.index) marks.push(this.mark("node", started.node, LINES[view.measures.length % LINES.length]!, String(started.node)));
    return marks;
  }

  private rulers(): Ruler[] {
    return this.app.view.measures.flatMap((measure, i) => {
      if (measure.run !== this.session.index) return [];
      const colour = LINES[i % LINES.length]!;
      const found = measured(this.tracks, this.session, measure);
      const ends = [measure.a, measure.b].map((node) => this.mark("node", node, colour, "")) as [Mark, Mark];
      return [{ ends, colour, label: found === null ? "" : quantity(Math.hypot(...found.now), "m") }];
    });
  }

  show(frame: Frame): void {
    const topology = this.session.topologies.get(frame.topology);
    if (!topology || !this.viewport) return;
    if (topology !== this.topology) {
      this.topology = topology;
      this.viewport.setTopology(topology);
      this.markKey = "";
    }
    this.viewport.setFrame(frame);
    this.update();
  }
}
