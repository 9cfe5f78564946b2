// The panel beside the picture: its tabs, and that only the open one is brought up to date.

import type { App } from "./app";
import { fill, h, setText } from "./dom";
import { contactsPanel } from "./panel_contacts";
import { energyPanel } from "./panel_energy";
import { probesPanel } from "./panel_probes";
import { aboutPanel, messagesOf, messagesPanel, partsPanel } from "./panel_rest";
import { viewPanel } from "./panel_view";
import type { Plot } from "./plot";
import type { Picks } from "./picks";
import type { Stage } from "./stage";
import { TABS, type Tab } from "./view";

const WORDS: Record<Tab, string> = { view: "View", energy: "Energy", contacts: "Contacts", probes: "Probes", parts: "Parts", messages: "Messages", about: "About" };

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
      view: { element: view, update: () => {} },
      energy: energyPanel(app),
      contacts: contactsPanel(app),
      probes: probesPanel(app, picks),
      parts: partsPanel(app, picks),
      messages: messagesPanel(app),
      about: aboutPanel(app),
    };
    const list = h("div", { role: "tablist", "aria-label": "Panel", class: "tabs", onkeydown: (event: KeyboardEvent) => this.keys(event) });
    for (const tab of TABS) {
      const button = h("button", { type: "button", role: "tab", id: `tab-${tab}`, "aria-controls": "tab-body", onclick: () => app.change({ tab }) }, WORDS[tab]);
      this.tabs.set(tab, button);
      list.append(button);
    }
    this.element = h("aside", { class: "panel", "aria-label": "Panel" }, list, this.body);
    app.events.on(["view", "shown", "run", "history", "probe", "live", "message", "theme"], () => this.soon());
    this.update();
  }

  private keys(event: KeyboardEvent): void {
    const by = { ArrowLeft: -1, ArrowRight: 1, Home: -100, End: 100 }[event.key];
    if (by === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    const at = TABS.indexOf(this.app.view.tab);
    const to = Math.abs(by) === 1 ? (at + by + TABS.length) % TABS.length : by < 0 ? 0 : TABS.length - 1;
    this.app.change({ tab: TABS[to]! });
    this.tabs.get(TABS[to]!)!.focus();
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

  update(): void {
    const { view } = this.app;
    this.element.hidden = !view.panel;
    for (const [tab, button] of this.tabs) {
      button.setAttribute("aria-selected", String(tab === view.tab));
      button.tabIndex = tab === view.tab ? 0 : -1;
    }
    const messages = messagesOf(this.app);
    const count = messages.reduce((sum, m) => sum + m.list.length + (m.error !== null ? 1 : 0), 0);
    setText(this.tabs.get("messages")!, count > 0 ? `Messages (${count})` : "Messages");
    this.tabs.get("messages")!.classList.toggle("alarm", messages.some((m) => m.error !== null));
    if (!view.panel) return;
    const panel = this.panels[view.tab];
    if (this.open !== view.tab) {
      this.open = view.tab;
      this.body.setAttribute("aria-labelledby", `tab-${view.tab}`);
      fill(this.body, panel.element);
      this.body.scrollTop = 0;
    }
    panel.update();
  }
}
