// The pictures side by side, with cameras linked or each its own.

import type { Camera, Direction, Viewport } from "../viewport/viewport";
import type { App } from "./app";
import { h } from "./dom";
import { Pane } from "./pane";
import type { Picks } from "./picks";

export class Stage {
  readonly element: HTMLElement;
  readonly panes: Pane[];

  constructor(private readonly app: App, private readonly picks: Picks) {
    this.panes = app.sessions.map((session) => new Pane(app, session, picks.probes.tracks));
    this.element = h("div", { class: app.isComparison ? "panes two" : "panes" }, ...this.panes.map((pane) => pane.element));
    for (const pane of this.panes) {
      pane.onCamera = () => this.moved(pane);
      pane.onPick = (pick) => picks.pick(pane.session, pick);
      pane.onMenu = (pick, x, y) => picks.menu(pane.session, pick, x, y);
    }
    app.player.onShow = (session, frame) => this.panes.find((pane) => pane.session === session)?.show(frame);
  }

  private moved(pane: Pane): void {
    const camera = pane.viewport?.state().camera ?? null;
    this.camera(camera, pane);
  }

  private camera(camera: Camera | null, pane: Pane): void {
    const { view } = this.app;
    if (view.linked || pane === this.panes[0]) this.app.change({ picture: { ...view.picture, camera }, ...(view.linked ? { camera2: camera } : {}) });
    else this.app.change({ camera2: camera });
  }

  /** The picture that keys and buttons move: the one in focus, else the first. */
  get active(): Pane | null {
    return this.panes.find((pane) => pane.canvas === document.activeElement) ?? this.panes[0] ?? null;
  }
  private move(action: (viewport: Viewport) => void): void {
    const panes = this.app.view.linked ? [this.active] : this.panes;
    for (const pane of panes) {
      if (!pane?.viewport) continue;
      action(pane.viewport);
      this.moved(pane);
    }
  }
  fit(): void {
    this.app.change({ picture: { ...this.app.view.picture, camera: null }, camera2: null });
    for (const pane of this.panes) pane.viewport?.fit();
  }
  look(direction: Direction): void {
    this.move((viewport) => viewport.look(direction));
  }
  zoom(factor: number): void {
    this.move((viewport) => viewport.zoom(factor));
  }
  turn(dx: number, dy: number): void {
    this.move((viewport) => viewport.orbit(dx, dy));
  }
  pan(dx: number, dy: number): void {
    this.move((viewport) => viewport.pan(dx, dy));
  }

  /** Hides the part under the mouse, or all others. */
  partAtPointer(isolates: boolean): boolean {
    for (const pane of this.panes) {
      const pick = pane.pointed;
      if (pick === null) continue;
      if (isolates) this.picks.isolate(pane.session.run.parts[pick.part]?.name);
      else this.picks.hide(pane.session, pick.part);
      return true;
    }
    return false;
  }
}
