// Export: the picture as PNG, the run as MP4 or WebM, the values of a plot as CSV. Pictures are put together
// on a plain canvas: title, time, each run's picture, legend.

import type { App } from "./app";
import { show } from "./dialogs";
import { choice, fileName, h, row, save, setText } from "./dom";
import { timeText } from "./format";
import { drawLegend, legendData } from "./legend";
import type { Pane } from "./pane";
import type { SidePanel } from "./panel";
import type { Stage } from "./stage";
import { colour } from "./theme";

const HEAD = 44;

/** Draws all that the picture shows on a canvas of `unit` pixels per CSS pixel. */
function compose(app: App, stage: Stage, canvas: HTMLCanvasElement, unit: number): void {
  const panes = stage.panes;
  const boxes = panes.map((pane) => pane.canvas.getBoundingClientRect());
  const [left, top] = [Math.min(...boxes.map((b) => b.left)), Math.min(...boxes.map((b) => b.top))];
  const [right, bottom] = [Math.max(...boxes.map((b) => b.right)), Math.max(...boxes.map((b) => b.bottom))];
  const even = (n: number) => 2 * Math.round(n / 2);
  const [width, height] = [even((right - left) * unit), even((bottom - top + HEAD) * unit)];
  if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
  const context = canvas.getContext("2d")!;
  const [paper, ink] = [colour("paper"), colour("ink")];
  context.fillStyle = paper;
  context.fillRect(0, 0, width, height);
  context.textBaseline = "middle";
  panes.forEach((pane, i) => {
    const box = boxes[i]!;
    const [x, y] = [(box.left - left) * unit, (box.top - top + HEAD) * unit];
    pane.viewport?.draw(true);
    if (pane.canvas.width > 0) context.drawImage(pane.canvas, x, y, box.width * unit, box.height * unit);
    context.fillStyle = ink;
    if (panes.length > 1) {
      context.font = `600 ${14 * unit}px system-ui, sans-serif`;
      context.fillText(`${i === 0 ? "A" : "B"} · ${pane.session.run.name}`, x + 12 * unit, y + 18 * unit);
    }
    legendInto(app, pane, context, x, y, box, unit, ink);
  });
  const { run } = app;
  context.fillStyle = ink;
  context.font = `600 ${16 * unit}px system-ui, sans-serif`;
  const title = app.isComparison ? app.sessions.map((s) => s.run.name).join(" · ") : run.name;
  context.fillText(title, 12 * unit, (HEAD / 2) * unit, width * 0.6);
  const time = `t = ${timeText(app.view.time, app.end)}`;
  context.font = `${15 * unit}px system-ui, sans-serif`;
  context.fillText(time, width - context.measureText(time).width - 12 * unit, (HEAD / 2) * unit);
}

function legendInto(app: App, pane: Pane, context: CanvasRenderingContext2D, x: number, y: number, box: DOMRect, unit: number, ink: string): void {
  const data = legendData(app, pane.session);
  if (!data) return;
  const place = pane.legend.element.getBoundingClientRect();
  if (place.width === 0) return;
  const height = Math.min(180, box.height * 0.5) * unit;
  drawLegend(context, data, x + Math.max(0, place.left - box.left + 8) * unit, y + Math.max(0, place.top - box.top + 6) * unit, height, unit, ink);
}

/** Canvases of the pictures with `factor` times their pixels while `action` continues. */
async function enlarged<T>(stage: Stage, factor: number, action: () => Promise<T>): Promise<T> {
  const viewports = stage.panes.map((pane) => pane.viewport as (Pane["viewport"] & { setPixels?: (factor: number) => void }) | null);
  for (const viewport of viewports) viewport?.setPixels?.(factor);
  try {
    return await action();
  } finally {
    for (const viewport of viewports) viewport?.setPixels?.(1);
    for (const viewport of viewports) viewport?.draw();
  }
}

export async function picture(app: App, stage: Stage): Promise<Blob> {
  const canvas = document.createElement("canvas");
  await enlarged(stage, 2, async () => compose(app, stage, canvas, 2));
  return await new Promise((done, fail) => canvas.toBlob((blob) => (blob ? done(blob) : fail(new Error("the browser made no picture"))), "image/png"));
}

export async function savePicture(app: App, stage: Stage): Promise<void> {
  try {
    save(`${fileName(`${app.run.name}-${app.view.scalar ?? "parts"}-${timeText(app.view.time, app.end)}`)}.png`, await picture(app, stage));
    app.say("Picture saved.");
  } catch (fault) {
    app.say(`No picture: ${(fault as Error).message}`, true);
  }
}

export interface FilmFormat {
  name: "MP4" | "WebM";
  ending: "mp4" | "webm";
  type: string;
}

/** What this browser can record: MP4 (H.264), which most programs show, and WebM. */
export function filmFormats(): FilmFormat[] {
  const first = (types: string[]) => types.find((type) => typeof MediaRecorder !== "undefined" && MediaRecorder.isTypeSupported(type));
  const mp4 = first(["video/mp4;codecs=avc1.640033", "video/mp4;codecs=avc1.640028", "video/mp4;codecs=avc1.42E01E"]);
  const webm = first(["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"]);
  return [...(mp4 ? [{ name: "MP4" as const, ending: "mp4" as const, type: mp4 }] : []), ...(webm ? [{ name: "WebM" as const, ending: "webm" as const, type: webm }] : [])];
}

/** Records the whole run, in so many seconds; `progress` hears how far it is; ends early when `left` says so. */
export async function film(app: App, stage: Stage, seconds: number, format: FilmFormat, progress: (part: number) => void, left: () => boolean): Promise<Blob> {
  const before = app.view;
  const canvas = document.createElement("canvas");
  compose(app, stage, canvas, 1);
  const stream = canvas.captureStream(30);
  const recorder = new MediaRecorder(stream, { mimeType: format.type, videoBitsPerSecond: 8_000_000 });
  const pieces: Blob[] = [];
  recorder.ondataavailable = (event) => pieces.push(event.data);
  const stopped = new Promise<void>((done) => (recorder.onstop = () => done()));
  let broken = "";
  recorder.onerror = (event) => (broken = (event as ErrorEvent).error?.message ?? "the browser's recorder failed");
  const times = app.player.times();
  const [first, last] = [times[0] ?? 0, times.at(-1) ?? 0];
  recorder.start(500);
  try {
    // a picture at a time, each as long on the screen as its part of the run; recording pauses while a frame
    // is read
    for (let i = 0; i < times.length && !left() && broken === ""; i++) {
      recorder.pause();
      app.change({ time: times[i]!, playing: false, follow: false });
      await arrived(app, left);
      recorder.resume();
      compose(app, stage, canvas, 1);
      const next = times[i + 1] ?? last;
      const share = last > first ? (next - times[i]!) / (last - first) : 1;
      const length = i === times.length - 1 ? 0.5 : Math.max(1 / 60, share * seconds);
      await new Promise((done) => setTimeout(done, 1000 * length));
      compose(app, stage, canvas, 1);
      progress((i + 1) / times.length);
    }
  } finally {
    if (recorder.state !== "inactive") {
      recorder.stop();
      await stopped;
    }
    for (const track of stream.getTracks()) track.stop();
    app.change({ time: before.time, follow: before.follow });
  }
  if (broken !== "") throw new Error(broken);
  return new Blob(pieces, { type: format.type.split(";")[0]! });
}

/** Waits until the frames of the view's time are on the screen. */
async function arrived(app: App, left: () => boolean): Promise<void> {
  const there = () => app.sessions.every((session) => {
    const frame = session.run.frames[session.nearest(app.view.time)];
    if (!frame) return true;
    const key = session.key(frame.number, app.wish(session));
    return session.faults.has(key) || session.shownKey === key;
  });
  while (!there() && !left()) await new Promise((done) => setTimeout(done, 15));
  await new Promise((done) => requestAnimationFrame(done));
}

function filmWords(formats: FilmFormat[]): string {
  if (formats.length === 0) return "This browser can't record films. A run writes animation.gif into its folder.";
  return `The whole run as it is seen now.${formats.some(({ name }) => name === "MP4") ? "" : " This browser records WebM only; MP4 needs one with an encoder for H.264."}`;
}

/** The dialog of all exports. */
export function exportDialog(app: App, stage: Stage, panel: SidePanel): void {
  const length = choice([["3", "3 s"], ["5", "5 s"], ["10", "10 s"], ["20", "20 s"], ["40", "40 s"]], "10", () => {});
  const formats = filmFormats();
  const format = choice(formats.map(({ ending, name }): [string, string] => [ending, name]), formats[0]?.ending ?? "", () => {});
  const bar = h("progress", { max: 1, value: 0, hidden: true, "aria-label": "Recording" });
  const said = h("p", { class: "quiet", role: "status" });
  let recording = false;
  let over = false;
  const png = h("button", { type: "button", class: "labelled", onclick: () => void savePicture(app, stage).then(() => setText(said, "Picture saved.")) }, "Save picture");
  const start = h("button", { type: "button", class: "labelled", disabled: formats.length === 0, onclick: () => void record() }, "Record film");
  const record = async () => {
    if (recording) {
      over = true;
      return;
    }
    recording = true;
    over = false;
    bar.hidden = false;
    start.textContent = "End here";
    setText(said, "Recording. Keep this page in front.");
    try {
      const chosen = formats.find(({ ending }) => ending === format.value)!;
      const blob = await film(app, stage, Number(length.value), chosen, (part) => (bar.value = part), () => over);
      save(`${fileName(`${app.run.name}-${app.view.scalar ?? "parts"}`)}.${chosen.ending}`, blob);
      setText(said, "Film saved.");
    } catch (fault) {
      setText(said, `No film: ${(fault as Error).message}.`);
    }
    recording = false;
    bar.hidden = true;
    start.textContent = "Record film";
  };
  const plots = panel.plots();
  const csv = h("button", { type: "button", class: "labelled", disabled: plots.length === 0, onclick: () => {
    for (const plot of plots) plot.saveCsv();
    setText(said, "Values saved.");
  } }, "Save values");
  const { closed } = show("Export", h("div", { class: "export" },
    h("div", {}, h("h3", {}, "Picture (PNG)"), h("p", { class: "quiet" }, "What is on the screen with legend and time, at twice its size."), png),
    h("div", {}, h("h3", {}, "Film"), h("p", { class: "quiet" }, filmWords(formats)), formats.length > 1 && row("Format", format), row("Length", length), start, bar),
    h("div", {}, h("h3", {}, "Values (CSV)"), h("p", { class: "quiet" }, plots.length > 0 ? "The plots that are open, in base units." : "Open a tab with a plot first: Energy, Contacts or Probes."), csv), said), [["", "Close"]]);
  void closed.then(() => (over = true));
}
