// Keys of the page. Fields and dialogs keep theirs; the canvas takes the arrow keys to itself.

import type { App } from "./app";
import { moveSection, toggleSection } from "./panel_section";
import type { Picks } from "./picks";
import type { Stage } from "./stage";
import { DIRECTIONS } from "./toolbar";

export interface Actions {
  help: () => void;
  theme: () => void;
  screenshot: () => void;
  link: () => void;
}

export function listenToKeys(app: App, stage: Stage, picks: Picks, actions: Actions): void {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    const target = event.target as HTMLElement;
    if (document.querySelector("dialog[open]") || target.closest("input:not([type=range]):not([type=checkbox]), select, textarea")) return;
    const isSlider = target.closest("input[type=range]") !== null;
    const isButton = target.closest("button, a, input[type=checkbox], [role=tab]") !== null;
    if (handle(event, isButton, isSlider)) event.preventDefault();
  });

  const handle = (event: KeyboardEvent, isButton: boolean, isSlider: boolean): boolean => {
    const { key } = event;
    const canvas = stage.panes.some((pane) => pane.canvas === event.target);
    if (canvas && key.startsWith("Arrow")) {
      const [x, y] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[key] ?? [0, 0];
      if (app.run.dimension === 2 || event.shiftKey) stage.pan(0.06 * x!, 0.06 * y!);
      else stage.turn(0.12 * x!, -0.12 * y!);
      return true;
    }
    if (isSlider && (key.startsWith("Arrow") || key === "Home" || key === "End")) return false;
    const step = { ArrowLeft: -1, ArrowRight: 1, Home: -1e9, End: 1e9 }[key];
    if (step !== undefined) return app.player.step(event.shiftKey ? 10 * step : step), true;
    if (/^[1-7]$/.test(key)) return stage.look(DIRECTIONS[Number(key) - 1]![0]), true;
    switch (key) {
      case " ":
        if (isButton) return false;
        app.player.toggle();
        return true;
      case "+": case "=": return stage.zoom(1.25), true;
      case "-": case "−": return stage.zoom(0.8), true;
      case "f": return stage.fit(), true;
      case "m": return app.picture({ lines: !app.view.picture.lines }), true;
      case "a": return app.picture({ arrows: !app.view.picture.arrows }), true;
      case "u": return app.picture({ undeformed: !app.view.picture.undeformed }), true;
      case "i": return app.picture({ iso: !app.view.picture.iso }), true;
      case "v": return app.picture({ averaged: !app.view.picture.averaged }), true;
      case "c": return toggleSection(app, stage), true;
      case "[": return moveSection(app, -0.01), true;
      case "]": return moveSection(app, 0.01), true;
      case "{": return moveSection(app, -0.1), true;
      case "}": return moveSection(app, 0.1), true;
      case "d": return app.use(app.tool === "measure" ? "node" : "measure"), true;
      case "h": return stage.partAtPointer(false);
      case "o": return stage.partAtPointer(true);
      case "H": case "O": return picks.showAll(), true;
      case "Escape": {
        if (app.tool === "node") return false;
        app.use("node");
        return true;
      }
      case "n": case "N": {
        const keys = app.run.scalars.map((scalar) => scalar.key);
        const at = keys.indexOf(app.view.scalar ?? "");
        const next = keys[(at + (key === "N" ? -1 : 1) + keys.length) % keys.length];
        if (next !== undefined) app.change({ scalar: next });
        return true;
      }
      case "p": {
        app.change({ tab: "probes", panel: true });
        requestAnimationFrame(() => requestAnimationFrame(() => document.getElementById("probe-node")?.focus()));
        return true;
      }
      case "s": return actions.screenshot(), true;
      case "l": return actions.link(), true;
      case "t": return actions.theme(), true;
      case "?": return actions.help(), true;
      default: return false;
    }
  };
}
