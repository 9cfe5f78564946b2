// The panel beside the picture: its tabs, and that only the open one is brought up to date.

import type { App } from "./app";
import { fill, h, setText } from "./dom";
import { contactsPanel } from "./panel_contacts";
import { energyPanel } from "./panel_energy";
import { modelPanel } from "./panel_model";
import { probesPanel } from "./panel_probes";
import { aboutPanel, messagesOf, messagesPanel, partsPanel } from "./panel_rest";
import { viewPanel } from "./panel_view";
import type { Plot } from "./plot";
import type { Picks } from "./picks";
import type { Stage } from "./stage";
import { TABS, type Tab } from "./view";

const WORDS: Record<Tab, string> = { model: "Model", view: "View", energy: "Energy", contacts: "Contacts", probes: "Probes", parts: "Parts", messages: "Messages", about: "About" };

/** Tabs of a model before it runs: nothing has happened yet. */
const OF_MODEL: Tab[] = ["model", "view", "probes", "parts", "about"];

export class SidePanel {
  readonly element: HTMLElement;
  private readonly tabs = new Map<Tab, HTMLButtonElement>();
  private readonly panels: Record<Tab, { element: HTMLElement; update: () => void; plots?: Plot[] }>;
  private readonly body = h("div", { class: "tab-body", role: "tabpanel", id: "tab-body", tabindex: 0 });
  private open: Tab | null = null;
  private waiting = false;

  constructor(private readonly app: App, picks: Picks, stage: Stage) {
    const view = viewPanel(app, stage);
    this.panels = {
      model: modelPanel(app.model),
      view: { element: view, update: () => {} },
      energy: energyPanel(app),
      contacts: contactsPanel(app),
      probes: probesPanel(app, picks),
      parts: partsPanel(app, picks),
      messages: messagesPanel(app),
      about: aboutPanel(app),
    };
    const list = h("div", { role: "tablist", "aria-label": "Panel", class: "tabs", onkeydown: (event: KeyboardEvent) => this.keys(event) });
    for (const tab of this.names()) {
      const button = h("button", { type: "button", role: "tab", id: `tab-${tab}`, "aria-controls": "tab-body", onclick: () => app.change({ tab }) }, WORDS[tab]);
      this.tabs.set(tab, button);
      list.append(button);
    }
    this.element = h("aside", { class: "panel", "aria-label": "Panel" }, list, this.body);
    app.events.on(["view", "shown", "run", "history", "probe", "live", "message", "theme", "model"], () => this.soon());
    this.update();
  }

  private keys(event: KeyboardEvent): void {
    const by = { ArrowLeft: -1, ArrowRight: 1, Home: -100, End: 100 }[event.key];
    if (by === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    const names = this.names();
    const at = names.indexOf(this.app.view.tab);
    const to = Math.abs(by) === 1 ? (at + by + names.length) % names.length : by < 0 ? 0 : names.length - 1;
    this.app.change({ tab: names[to]! });
    this.tabs.get(names[to]!)!.focus();
  }

  /** The tabs that there are. */
  private names(): Tab[] {
    return this.app.model === null ? TABS.filter((tab) => tab !== "model") : OF_MODEL;
  }

  private soon(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.update();
    });
  }

  /** The plots on the screen, for saving their values. */
  plots(): Plot[] {
    return (this.open ? this.panels[this.open].plots ?? [] : []).filter((plot) => plot.element.offsetParent !== null);
  }

  /** How many messages there are, or faults of a model, in the name of their tab. */
  private count(): void {
    const { model } = this.app;
    const messages = messagesOf(this.app);
    const count = model === null ? messages.reduce((sum, m) => sum + m.list.length + (m.error !== null ? 1 : 0), 0) : model.about.faults.length;
    const tab = model === null ? "messages" : "model";
    const button = this.tabs.get(tab)!;
    setText(button, count > 0 ? `${WORDS[tab]} (${count})` : WORDS[tab]);
    button.classList.toggle("alarm", model === null ? messages.some((m) => m.error !== null) : count > 0);
  }

  update(): void {
    const { view } = this.app;
    this.element.hidden = !view.panel;
    for (const [tab, button] of this.tabs) {
      button.setAttribute("aria-selected", String(tab === view.tab));
      button.tabIndex = tab === view.tab ? 0 : -1;
    }
    this.count();
    if (!view.panel) return;
    const panel = this.panels[view.tab];
    if (!this.tabs.has(view.tab)) return this.app.change({ tab: this.names()[0]! });
    if (this.open !== view.tab) {
      this.open = view.tab;
      this.body.setAttribute("aria-labelledby", `tab-${view.tab}`);
      fill(this.body, panel.element);
      this.body.scrollTop = 0;
    }
    panel.update();
  }
}
