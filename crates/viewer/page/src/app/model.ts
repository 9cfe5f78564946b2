// A model before it runs: what is said of it now, and what follows when its file changes. The server answers
// when there is a new state; the picture then takes the new frame, and where parts or dimension are others
// the page is made again, with the view that stands in its address.

import type { Run } from "../types";
import type { App } from "./app";
import type { About } from "./model_types";
import type { Requests } from "./requests";

/** Kinds of glyphs that are not drawn, kept while the tab is open. */
const STORE = "embate.glyphs.hidden";
/** Between two attempts where the server does not answer, ms. */
const PAUSE = 1000;

/** Asks until the model is in another state than `seen`. */
async function next(requests: Requests, seen: number): Promise<About> {
  for (;;) {
    try {
      const answer = await fetch(`api/model?since=${seen}`, { cache: "no-store", credentials: "omit" });
      if (answer.ok) {
        const about = (await answer.json()) as About;
        if (about.version !== seen) return about;
        continue;
      }
    } catch {
      requests.lost();
    }
    await new Promise((done) => window.setTimeout(done, PAUSE));
  }
}

/** Makes the page again when a model of which nothing can be drawn has changed. */
export async function reloadAfter(requests: Requests, about: About): Promise<void> {
  await next(requests, about.version);
  location.reload();
}

export class Model {
  readonly hidden: Set<string>;

  constructor(private readonly app: App, public about: About) {
    this.hidden = new Set((sessionStorage.getItem(STORE) ?? "").split(",").filter((name) => name !== ""));
    void this.follow();
  }

  /** Draws glyphs of a kind or not. */
  show(kind: string, shown: boolean): void {
    if (shown) this.hidden.delete(kind);
    else this.hidden.add(kind);
    sessionStorage.setItem(STORE, [...this.hidden].join(","));
    this.app.events.emit("model");
  }

  private async follow(): Promise<void> {
    for (;;) {
      const about = await next(this.app.requests, this.about.version);
      const session = this.app.sessions[0]!;
      const run = await this.app.requests.json<Run>("api/runs/0", 0);
      const names = (one: Run) => [one.dimension, ...one.parts.map((part) => part.name), ...one.obstacles, ...one.mirror].join("\n");
      if (!about.has_bodies || names(run) !== names(session.run)) {
        location.reload();
        return;
      }
      this.about = about;
      session.run = run;
      this.app.events.emit("run");
      this.app.player.update();
      this.app.events.emit("model");
    }
  }
}
