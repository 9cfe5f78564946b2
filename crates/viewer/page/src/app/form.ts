// Controls of the panel that follow the view.

import type { App } from "./app";
import { h } from "./dom";

export function numberInput(value: number, change: (value: number) => void, attributes: Record<string, string | number>): HTMLInputElement {
  const input = h("input", { type: "number", value, ...attributes, onchange: () => {
    const typed = Number(input.value);
    if (input.value !== "" && Number.isFinite(typed)) change(typed);
  } });
  return input;
}

export function bind(app: App, input: HTMLInputElement | HTMLSelectElement, value: () => string): void {
  app.events.on(["view", "shown", "range"], () => {
    if (document.activeElement !== input && input.value !== value()) input.value = value();
  });
}

export function bindCheck(app: App, label: HTMLLabelElement, on: () => boolean): HTMLLabelElement {
  const box = label.querySelector("input")!;
  app.events.on("view", () => {
    if (box.checked !== on()) box.checked = on();
  });
  return label;
}

export function group(name: string, ...rows: (HTMLElement | false | null)[]): HTMLElement {
  const set = h("fieldset", {}, h("legend", {}, name));
  for (const one of rows) if (one) set.append(one);
  return set;
}
