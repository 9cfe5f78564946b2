// Mouse, pen and fingers on the canvas: left drag turns (in 2D it moves), right, middle or shift drag
// moves, the wheel brings closer at the pointer, two fingers move and bring closer. A drag is no click:
// clicks after one are swallowed, so that who listens to clicks on the canvas gets real ones only.

import type { Rig } from "./camera";

/** Further than this is a drag, in px. */
const STILL = 4;

export class Controls {
  private readonly fingers = new Map<number, { x: number; y: number }>();
  private travelled = 0;
  private wasDrag = false;
  private readonly stop = new AbortController();

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly rig: Rig,
    private readonly moved: () => void,
  ) {
    canvas.style.touchAction = "none";
    const signal = this.stop.signal;
    canvas.addEventListener("pointerdown", (event) => this.down(event), { signal });
    canvas.addEventListener("pointermove", (event) => this.move(event), { signal });
    for (const kind of ["pointerup", "pointercancel", "lostpointercapture"] as const) {
      canvas.addEventListener(kind, (event) => this.fingers.delete(event.pointerId), { signal });
    }
    canvas.addEventListener("wheel", (event) => this.wheel(event), { signal, passive: false });
    canvas.addEventListener("contextmenu", (event) => event.preventDefault(), { signal });
    canvas.addEventListener(
      "click",
      (event) => {
        if (this.wasDrag) event.stopImmediatePropagation();
      },
      { signal, capture: true },
    );
  }

  private down(event: PointerEvent): void {
    if (this.fingers.size === 0) {
      this.travelled = 0;
      this.wasDrag = false;
    }
    this.fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (this.fingers.size > 1) this.wasDrag = true;
    try {
      this.canvas.setPointerCapture(event.pointerId);
    } catch {
      // The pointer is gone already, or events are made by a script.
    }
    if (event.button === 1) event.preventDefault();
  }

  private move(event: PointerEvent): void {
    const before = this.fingers.get(event.pointerId);
    if (before === undefined) return;
    const box = this.canvas.getBoundingClientRect();
    const height = Math.max(box.height, 1);
    const [dx, dy] = [event.clientX - before.x, event.clientY - before.y];
    const now = { x: event.clientX, y: event.clientY };
    if (this.fingers.size === 1) {
      this.travelled += Math.abs(dx) + Math.abs(dy);
      if (!this.wasDrag && this.travelled <= STILL) return;
      this.wasDrag = true;
      this.fingers.set(event.pointerId, now);
      const pans = this.rig.isPlane || (event.buttons & 6) !== 0 || event.shiftKey || event.ctrlKey;
      if (pans) this.rig.pan(dx / height, -dy / height);
      else this.rig.orbit((dx / height) * Math.PI, (dy / height) * Math.PI);
    } else if (this.fingers.size === 2) {
      const other = [...this.fingers].find(([id]) => id !== event.pointerId)![1];
      const spread = (a: { x: number; y: number }): number => Math.max(Math.hypot(a.x - other.x, a.y - other.y), 10);
      const x = 0.5 * (now.x + other.x) - box.left - 0.5 * box.width;
      const y = 0.5 * (now.y + other.y) - box.top - 0.5 * box.height;
      this.fingers.set(event.pointerId, now);
      this.rig.pan((0.5 * dx) / height, (-0.5 * dy) / height);
      this.rig.zoom(spread(now) / spread(before), x / height, -y / height);
    } else {
      this.fingers.set(event.pointerId, now);
      return;
    }
    this.moved();
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const box = this.canvas.getBoundingClientRect();
    const step = event.deltaMode === 1 ? 24 : event.deltaMode === 2 ? 400 : 1;
    // Two fingers on a touch pad come as a wheel with the control key and small steps.
    const turn = Math.min(Math.max(event.deltaY * step * (event.ctrlKey ? 8 : 1), -400), 400);
    const height = Math.max(box.height, 1);
    const x = (event.clientX - box.left - 0.5 * box.width) / height;
    const y = (0.5 * box.height - (event.clientY - box.top)) / height;
    this.rig.zoom(Math.exp(-turn * 0.0016), x, y);
    this.moved();
  }

  dispose(): void {
    this.stop.abort();
  }
}
