// Dialogs: help with the keys, and the question before a run is stopped. Escape closes them; focus goes back
// by itself.

import { h } from "./dom";

/** Keys, where they count, and what they do. */
const KEYS: [string[], string, string][] = [
  [["space"], "", "play or pause"],
  [["←", "→"], "", "frame before or next; with Shift ten frames"],
  [["Home", "End"], "", "first or last frame"],
  [["+", "−"], "", "zoom"],
  [["f"], "", "fit"],
  [["1", "…", "7"], "", "look: three sides, +x, −x, +y, −y, +z, −z"],
  [["←", "→", "↑", "↓"], "on the picture", "turn it, with Shift move it; in the plane move it"],
  [["m"], "", "mesh lines"],
  [["a"], "", "arrows of contact forces"],
  [["u"], "", "undeformed shape"],
  [["i"], "", "lines of equal value"],
  [["v"], "", "values of elements averaged or as they are"],
  [["c"], "", "section on or off (3D)"],
  [["[", "]"], "", "move the section by 1 %; with Shift by 10 %"],
  [["h", "o"], "mouse on a part", "hide it, or show only it"],
  [["H"], "", "show all parts"],
  [["d"], "", "measure the distance of two nodes; Escape ends"],
  [["n", "N"], "", "next or previous quantity"],
  [["p"], "", "probes"],
  [["s"], "", "save picture (PNG)"],
  [["l"], "", "copy link"],
  [["t"], "", "dark or light"],
  [["?"], "", "this help"],
];

/** Shows a dialog until it is closed; the promise holds the value of the button that closed it. */
export function show(title: string, content: HTMLElement, buttons: [string, string][]): { dialog: HTMLDialogElement; closed: Promise<string> } {
  const form = h("form", { method: "dialog" }, h("h2", { id: "dialog-title" }, title), content,
    h("div", { class: "dialog-buttons" }, ...buttons.map(([value, label], i) => h("button", { value, class: value === "stop" ? "danger labelled" : i === buttons.length - 1 ? "primary labelled" : "labelled", autofocus: i === 0 }, label))));
  const dialog = h("dialog", { "aria-labelledby": "dialog-title" }, form);
  document.body.append(dialog);
  const closed = new Promise<string>((done) => {
    dialog.addEventListener("close", () => {
      dialog.remove();
      done(dialog.returnValue);
    });
  });
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close("");
  });
  dialog.showModal();
  return { dialog, closed };
}

export function help(): void {
  show("Keys", h("div", {},
    h("dl", { class: "keys" }, ...KEYS.flatMap(([keys, where, text]) => [h("dt", {}, ...keys.map((key) => (key === "…" ? "… " : h("kbd", {}, key))), where), h("dd", {}, text)])),
    h("p", { class: "quiet" }, "Mouse: drag to turn (in the plane to move), right button or Shift to move, wheel to zoom, click a node for its values, right click for more. In plots: click to go to a time, drag to magnify, double click for all. Touch: one finger turns, two move and zoom, a long touch opens the menu.")),
  [["", "Close"]]);
}

export async function confirmStop(): Promise<boolean> {
  const { closed } = show("Stop the run?", h("p", {}, "It ends after the present step. Its results until now are kept; from a kept state it can go on with embate resume."), [["", "Go on"], ["stop", "Stop the run"]]);
  return (await closed) === "stop";
}
