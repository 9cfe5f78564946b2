// The value under the mouse, at the lower edge of a picture: shown when the mouse rests, gone when anything
// moves.

import type { Pick } from "../viewport/viewport";
import type { App } from "./app";
import { h, setText } from "./dom";
import { quantity } from "./format";
import type { Session } from "./session";

/** The mouse rests when it has not moved for so long, ms. */
const REST = 90;

export class Readout {
  readonly element = h("div", { class: "readout", "aria-hidden": "true", hidden: true });
  private timer = 0;

  constructor(app: App, session: Session, canvas: HTMLCanvasElement, at: (x: number, y: number) => Pick | null) {
    const hide = () => {
      window.clearTimeout(this.timer);
      this.element.hidden = true;
    };
    canvas.addEventListener("pointermove", (event) => {
      hide();
      if (event.pointerType !== "mouse" || event.buttons !== 0) return;
      this.timer = window.setTimeout(() => {
        const pick = at(event.clientX, event.clientY);
        if (pick === null) return;
        const scalar = session.scalar(app.view.scalar);
        const part = session.run.parts[pick.part]?.name ?? "";
        const value = scalar === null ? "" : ` · ${scalar.states[Math.round(pick.value ?? -1)] ?? quantity(pick.value, scalar.unit)}`;
        setText(this.element, `${part} · node ${pick.node} · element ${pick.cell}${value}`);
        this.element.hidden = false;
      }, REST);
    });
    for (const kind of ["pointerdown", "pointerleave", "wheel"] as const) canvas.addEventListener(kind, hide);
    app.events.on(["view", "shown"], hide);
  }
}
