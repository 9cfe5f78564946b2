// What is done with what was picked in a picture: probes, distances, parts that are hidden. Clicks do what
// the tool says; the menu of a right click, or of a long touch, offers all of it.

import type { Pick } from "../viewport/viewport";
import type { App } from "./app";
import { h } from "./dom";
import type { Probes } from "./probes";
import type { Session } from "./session";
import { MOST_MEASURES } from "./view";

export class Picks {
  constructor(private readonly app: App, readonly probes: Probes) {}

  /** A click. */
  pick(session: Session, pick: Pick): void {
    if (this.app.tool === "measure") this.measure(session, pick.node);
    else this.probe(session, pick, this.app.tool);
  }

  probe(session: Session, pick: Pick, of: "node" | "cell"): void {
    this.probes.add({ run: session.index, of, node: of === "node" ? pick.node : 0, cell: pick.cell });
  }

  /** One end of a distance; the second completes it. */
  measure(session: Session, node: number): void {
    const { app } = this;
    const first = app.started;
    if (first === null || first.run !== session.index || first.node === node) {
      app.started = { run: session.index, node };
      app.tool = "measure";
      app.events.emit("view");
      return;
    }
    app.started = null;
    this.addMeasure(session, first.node, node);
  }

  addMeasure(session: Session, a: number, b: number): void {
    const { measures } = this.app.view;
    const others = measures.filter((m) => m.run !== session.index || ![`${a} ${b}`, `${b} ${a}`].includes(`${m.a} ${m.b}`));
    if (others.length >= MOST_MEASURES) return this.app.say(`There are ${MOST_MEASURES} distances already: remove one first.`);
    this.app.change({ measures: [...others, { run: session.index, a, b }], tab: "probes", panel: true });
  }

  hide(session: Session, part: number): void {
    const name = session.run.parts[part]?.name;
    const { hidden } = this.app.view.picture;
    if (name !== undefined && !hidden.includes(name)) this.app.picture({ hidden: [...hidden, name] });
  }
  isolate(name: string | undefined): void {
    const names = new Set(this.app.sessions.flatMap((session) => session.run.parts.map((part) => part.name)));
    if (name !== undefined) this.app.picture({ hidden: [...names].filter((other) => other !== name) });
  }
  showAll(): void {
    if (this.app.view.picture.hidden.length > 0) this.app.picture({ hidden: [] });
  }

  /** The menu at a place of the window. */
  menu(session: Session, pick: Pick | null, x: number, y: number): void {
    const part = pick === null ? null : session.run.parts[pick.part]?.name ?? `part ${pick.part}`;
    const { hidden } = this.app.view.picture;
    const items: [string, () => void][] = [];
    if (pick !== null) {
      items.push([`Probe node ${pick.node}`, () => this.probe(session, pick, "node")], [`Probe element ${pick.cell}`, () => this.probe(session, pick, "cell")]);
      const { started } = this.app;
      const isSecond = started !== null && started.run === session.index && started.node !== pick.node;
      items.push([isSecond ? `Measure from node ${started.node} to node ${pick.node}` : `Measure from node ${pick.node}`, () => this.measure(session, pick.node)]);
      items.push([`Hide ${part}`, () => this.hide(session, pick.part)], [`Show only ${part}`, () => this.isolate(part!)]);
    }
    if (hidden.length > 0) items.push(["Show all parts", () => this.showAll()]);
    if (items.length > 0) openMenu(part, items, x, y);
  }
}

/** A menu with a heading; Escape, a click beside it and Tab close it. */
function openMenu(heading: string | null, items: [string, () => void][], x: number, y: number): void {
  document.querySelector(".menu")?.remove();
  const before = document.activeElement as HTMLElement | null;
  const stop = new AbortController();
  const close = () => {
    stop.abort();
    menu.remove();
    before?.focus();
  };
  const buttons = items.map(([label, action]) => h("button", { type: "button", role: "menuitem", tabindex: -1, onclick: () => {
    close();
    action();
  } }, label));
  const menu = h("div", { class: "menu", role: "menu", "aria-label": heading ?? "Picture", onkeydown: (event: KeyboardEvent) => {
    event.stopPropagation();
    const at = buttons.indexOf(document.activeElement as HTMLButtonElement);
    const to = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: -1 }[event.key];
    if (to !== undefined) buttons.at(to % buttons.length)!.focus();
    else if (event.key === "Escape" || event.key === "Tab") close();
    else return;
    event.preventDefault();
  } }, heading === null ? null : h("div", { class: "menu-title" }, heading), ...buttons);
  document.body.append(menu);
  const box = menu.getBoundingClientRect();
  menu.style.left = `${Math.max(4, Math.min(x, window.innerWidth - box.width - 4))}px`;
  menu.style.top = `${Math.max(4, Math.min(y, window.innerHeight - box.height - 4))}px`;
  buttons[0]!.focus();
  window.addEventListener("pointerdown", (event) => {
    if (!menu.contains(event.target as Node)) close();
  }, { signal: stop.signal, capture: true });
}
