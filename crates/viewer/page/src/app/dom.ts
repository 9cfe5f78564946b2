// Making elements of the page: one small function instead of a framework. Used by all other files of the
// page.

type Value = string | number | boolean | null | undefined | ((event: never) => void);
export type Child = Node | string | null | undefined | false;

/** An element with attributes (`onclick: f` listens, true sets, false/null leaves out) and children. */
export function h<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Record<string, Value> = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name.slice(2), value as unknown as EventListener);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, String(value));
  }
  append(element, children);
  return element;
}

export function append(element: Element, children: Child[]): void {
  for (const child of children) if (child !== null && child !== undefined && child !== false) element.append(child);
}

/** Replaces what an element holds. */
export function fill(element: Element, ...children: Child[]): void {
  element.replaceChildren();
  append(element, children);
}

/** Sets the text if it differs, so that nothing is laid out, or read aloud, again. */
export function setText(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

/** A text in which `words in backticks` are set as code. */
export function prose(text: string): Node[] {
  return text.split("`").map((part, i, all) => (i % 2 === 1 && i < all.length - 1 ? h("code", {}, part) : document.createTextNode(part)));
}

let serial = 0;
export function freshId(stem: string): string {
  serial += 1;
  return `${stem}-${serial}`;
}

/** A labelled row of a form: the label stands before the control and belongs to it. */
export function row(label: string, control: HTMLElement, hint?: string): HTMLElement {
  const field = control.matches("input,select") ? control : control.querySelector<HTMLElement>("input,select") ?? control;
  field.id ||= freshId("field");
  return h("div", { class: "row" }, h("label", { for: field.id, title: hint }, label), control);
}

/** A checkbox in its label. */
export function check(label: string, checked: boolean, change: (on: boolean) => void, hint?: string): HTMLLabelElement {
  const box = h("input", { type: "checkbox", checked, onchange: () => change(box.checked) });
  return h("label", { class: "check", title: hint }, box, label);
}

/** A choice among few. */
export function choice(options: [string, string][], value: string, change: (value: string) => void): HTMLSelectElement {
  const select = h("select", { onchange: () => change(select.value) }, ...options.map(([key, label]) => h("option", { value: key, selected: key === value }, label)));
  return select;
}

/** A button with an icon; its label is its name and its tip. */
export function iconButton(icon: string, label: string, click: () => void, attributes: Record<string, Value> = {}): HTMLButtonElement {
  const button = h("button", { type: "button", class: "icon", "aria-label": label, title: label, onclick: click, ...attributes });
  button.innerHTML = icon;
  return button;
}

/** Hands a file to the user. */
export function save(name: string, blob: Blob): void {
  const address = URL.createObjectURL(blob);
  const link = h("a", { href: address, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
}

/** A text without what file names cannot have. */
export function fileName(text: string): string {
  return text.replace(/[^\w.-]+/g, "-").replace(/^-+|-+$/g, "") || "embate";
}
