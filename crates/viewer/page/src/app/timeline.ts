// The time bar: scrubber over the run's time, play, steps, loop, speed, and the time in words. While a run
// goes, the part that is not there yet is seen as empty, and "follow" holds on to the newest.

import type { App } from "./app";
import { choice, h, iconButton, setText } from "./dom";
import { icons } from "./icons";
import { quantity, timeText } from "./format";
import { SPEEDS } from "./view";

export class Timeline {
  readonly element: HTMLElement;
  private readonly slider = h("input", { type: "range", class: "scrubber", step: "any", "aria-label": "Time" });
  private readonly play: HTMLButtonElement;
  private readonly loop: HTMLButtonElement;
  private readonly follow: HTMLButtonElement;
  private readonly speed: HTMLSelectElement;
  private readonly text = h("output", { class: "time" });
  private readonly frame = h("span", { class: "frame-number" });

  constructor(private readonly app: App) {
    const { player } = app;
    this.play = iconButton(icons.play, "Play", () => player.toggle(), { class: "icon primary" });
    this.loop = iconButton(icons.loop, "Loop", () => app.change({ loop: !app.view.loop }), { "aria-pressed": "false" });
    this.follow = h("button", { type: "button", class: "follow", onclick: () => app.change({ follow: !app.view.follow, playing: false }), "aria-pressed": "false", title: "Show what is newest" }, "Follow");
    this.speed = choice(SPEEDS.map((speed) => [String(speed), `${speed}×`]), String(app.view.speed), (value) => app.change({ speed: Number(value) }));
    this.speed.setAttribute("aria-label", "Speed");
    this.slider.addEventListener("input", () => {
      const times = player.times();
      const value = Number(this.slider.value);
      let best = times[0] ?? 0;
      for (const time of times) if (Math.abs(time - value) < Math.abs(best - value)) best = time;
      app.moveTo(best);
    });
    this.slider.addEventListener("keydown", (event) => {
      const by = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -10, PageUp: 10, Home: -1e9, End: 1e9 }[event.key];
      if (by === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      event.stopPropagation();
      player.step(by);
    });
    this.element = h("section", { class: "timeline", "aria-label": "Time" },
      h("div", { class: "buttons" },
        iconButton(icons.first, "First frame", () => player.step(-1e9), { class: "icon wide-only" }),
        iconButton(icons.back, "Frame before", () => player.step(-1)),
        this.play,
        iconButton(icons.forward, "Next frame", () => player.step(1)),
        iconButton(icons.last, "Last frame", () => player.step(1e9), { class: "icon wide-only" })),
      this.slider, h("div", { class: "time-text" }, this.text, this.frame), h("div", { class: "buttons" }, this.loop, this.speed, this.follow));
    app.events.on(["view", "shown", "run", "live"], () => this.update());
    this.update();
  }

  update(): void {
    const { app } = this;
    const { view, player } = app;
    const times = player.times();
    const [first, there, end] = [times[0] ?? 0, times.at(-1) ?? 0, app.end];
    const max = end > first ? end : first + 1e-12;
    if (this.slider.min !== String(first)) this.slider.min = String(first);
    if (this.slider.max !== String(max)) this.slider.max = String(max);
    if (Number(this.slider.value) !== view.time) this.slider.value = String(view.time);
    const part = (time: number) => `${(100 * Math.min(1, Math.max(0, (time - first) / (max - first)))).toFixed(2)}%`;
    this.slider.style.setProperty("--here", part(view.time));
    this.slider.style.setProperty("--there", part(Math.max(there, app.sessions[0]?.live?.time ?? 0)));
    const time = timeText(view.time, max);
    const place = player.place(times);
    const live = view.follow && app.live !== null && !app.live.ended && app.live.session.live !== null;
    const frame = live ? "live" : times.length > 0 ? `frame ${place + 1} of ${times.length}` : "no frame yet";
    setText(this.text, time);
    setText(this.frame, frame);
    const spoken = `${time}, ${frame}`;
    if (this.slider.getAttribute("aria-valuetext") !== spoken) this.slider.setAttribute("aria-valuetext", spoken);
    const playing = view.playing ? "Pause" : "Play";
    if (this.play.getAttribute("aria-label") !== playing) {
      this.play.setAttribute("aria-label", playing);
      this.play.title = `${playing} (space)`;
      this.play.innerHTML = view.playing ? icons.pause : icons.play;
    }
    this.loop.setAttribute("aria-pressed", String(view.loop));
    this.follow.hidden = !app.isGoing;
    this.follow.setAttribute("aria-pressed", String(view.follow));
    if (this.speed.value !== String(view.speed)) this.speed.value = String(view.speed);
    this.speed.title = `1 s on the clock shows ${quantity(player.rate(), "s", 3)} of the run`;
  }
}
