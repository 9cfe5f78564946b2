// One picture: the canvas of a run with its title, legend, probes and what is said when it can't be drawn.
// Keys on the canvas turn and move it; a click without a movement sets a probe.

import type { Frame, Topology } from "../types";
import { Viewport, type Pick } from "../viewport/viewport";
import type { App } from "./app";
import { colourBands, colourRange, PROBE_COLOURS } from "./colours";
import { h } from "./dom";
import { Legend } from "./legend";
import type { Session } from "./session";
import { isDark } from "./theme";

export class Pane {
  readonly element: HTMLElement;
  readonly canvas: HTMLCanvasElement;
  readonly legend: Legend;
  viewport: Viewport | null = null;
  /** The camera was moved by the user. */
  onCamera: () => void = () => {};
  onPick: (pick: Pick) => void = () => {};
  private topology: Topology | null = null;
  private readonly trouble = h("div", { class: "trouble", role: "alert", hidden: true });
  private down: { x: number; y: number } | null = null;

  constructor(private readonly app: App, readonly session: Session) {
    const { run } = session;
    this.canvas = h("canvas", {
      tabindex: 0, role: "img",
      "aria-label": `Picture of ${run.name}. Arrow keys ${run.dimension === 3 ? "turn it, with Shift they move it" : "move it"}; plus and minus zoom; f fits it.`,
    });
    this.legend = new Legend(app, session);
    const title = app.isComparison ? h("h2", { class: "pane-title" }, `${session.index === app.sessions[0]!.index ? "A" : "B"} · ${run.name}`, h("small", { title: run.path }, run.path)) : null;
    this.element = h("section", { class: "pane", "aria-label": `Picture of ${run.name}` }, this.canvas, title, this.legend.element, this.trouble);
    try {
      this.viewport = new Viewport(this.canvas, run, { dark: isDark(app.view.theme) });
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
      new ResizeObserver(() => this.viewport?.resize()).observe(this.canvas);
      this.listen();
    }
    app.events.on(["view", "shown", "range", "probe"], () => this.update());
    app.events.on("theme", () => this.viewport?.setDark(isDark(app.view.theme)));
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
      const box = this.canvas.getBoundingClientRect();
      const pick = this.viewport?.pick(event.clientX - box.left, event.clientY - box.top);
      if (pick) this.onPick(pick);
    });
    this.canvas.addEventListener("pointercancel", () => (this.down = null));
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
    const marks = this.app.view.probes
      .map((probe, i) => ({ probe, node: probe.node, colour: PROBE_COLOURS[i % PROBE_COLOURS.length]!, label: String(probe.node) }))
      .filter(({ probe }) => probe.run === this.session.index);
    const marked = JSON.stringify(marks);
    if (marked !== this.markKey && this.topology) {
      this.markKey = marked;
      viewport.mark(marks.map(({ node, colour, label }) => ({ node, colour, label })));
    }
    if (viewport.lost && this.trouble.hidden) this.fail();
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
