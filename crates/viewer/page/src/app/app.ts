// The page's middle: runs, view, what happens, and which frame is on the screen. Parts of the page change the
// view through `change`, and listen to `events`.

import type { Run, Runs } from "../types";
import { Events } from "./events";
import { Live } from "./live";
import type { Model } from "./model";
import { Player } from "./player";
import { Gone, Refusal, type Requests } from "./requests";
import { FrameStore, Session } from "./session";
import { firstView, viewOf, viewText, type View } from "./view";
import { wishOf, type Wish } from "./wish";

/** A text for the user at the top of the picture; `alert` is read aloud at once. */
export interface Note {
  text: string;
  alert: boolean;
}

/** What a click in the picture does: a probe of the node or of the element there, or an end of a distance. */
export type Tool = "node" | "cell" | "measure";

export class App {
  readonly events = new Events();
  readonly store = new FrameStore();
  readonly sessions: Session[];
  readonly live: Live | null;
  readonly first: View;
  readonly player: Player;
  /** The model that is shown before it runs. */
  model: Model | null = null;
  view: View;
  note: Note | null = null;
  /** What a click in the picture does. */
  tool: Tool = "node";
  /** The first node of a distance, until the second is picked. */
  started: { run: number; node: number } | null = null;
  /** A plane is being dragged: nothing is read ahead. */
  isDragging = false;
  private addressTimer = 0;
  private pollTimer = 0;
  private polling = false;

  constructor(readonly served: Runs, readonly requests: Requests) {
    const good = served.runs.map((run, index) => ({ run, index })).filter((one): one is { run: Run; index: number } => !("fault" in one.run));
    this.sessions = good.map(({ run, index }) => new Session(index, run, requests, this.store, this.events));
    const runs = this.sessions.map((session) => session.run);
    this.first = { ...firstView(runs), ...(served.model ? { tab: "model" as const } : {}) };
    const text = location.hash.length > 1 ? location.hash : served.view;
    this.view = this.there(viewOf(text, this.first, runs[0]!));
    this.live = served.live && this.sessions[0] ? new Live(this.sessions[0], requests, this.events) : null;
    this.player = new Player(this);
  }

  start(): void {
    this.requests.onConnection = (connection) => {
      if (connection === "open") void this.poll(true);
      this.events.emit("connection");
    };
    window.addEventListener("hashchange", () => {
      if (location.hash.slice(1) === viewText(this.view, this.first)) return;
      this.view = { ...this.there(viewOf(location.hash, this.first, this.sessions[0]!.run)), playing: false };
      this.events.emit("view");
      this.events.emit("theme");
      this.player.update();
    });
    if (this.live) {
      this.live.onFrame = () => this.player.showLive();
      this.live.open();
    }
    for (const session of this.sessions) void session.loadHistory();
    this.player.update();
    this.schedule();
  }

  /** A view without probes and distances at nodes and elements that no run has. */
  private there(view: View): View {
    const run = (index: number) => this.sessions.find((session) => session.index === index)?.run;
    const isNode = (index: number, node: number): boolean => node < (run(index)?.nodes ?? 0);
    const isCell = (index: number, cell: number): boolean => cell < (run(index)?.elements ?? 0);
    const probes = view.probes.filter((p) => (p.of === "cell" || isNode(p.run, p.node)) && isCell(p.run, p.cell));
    return { ...view, probes, measures: view.measures.filter((m) => isNode(m.run, m.a) && isNode(m.run, m.b)) };
  }

  /** The run of a probe or a distance, by its number; the first where it is not shown. */
  sessionOf({ run }: { run: number }): Session {
    return this.sessions.find((session) => session.index === run) ?? this.sessions[0]!;
  }

  /** The first run is the one that gives names, units and first choices. */
  get run(): Run {
    return this.sessions[0]!.run;
  }
  get end(): number {
    return Math.max(...this.sessions.map((session) => session.end));
  }
  get isComparison(): boolean {
    return this.sessions.length > 1;
  }
  /** What frames of a run are to hold. */
  wish(session: Session): Wish {
    return wishOf(this.view, session.run);
  }
  /** Something may still come. */
  get isGoing(): boolean {
    return this.sessions.some((session) => !session.run.is_over) && !(this.live?.ended && !this.live.ended.stays);
  }

  change(part: Partial<View>): void {
    const theme = part.theme !== undefined && part.theme !== this.view.theme;
    this.view = { ...this.view, ...part };
    this.events.emit("view");
    if (theme) this.events.emit("theme");
    this.player.update();
    this.address();
  }
  picture(part: Partial<View["picture"]>): void {
    this.change({ picture: { ...this.view.picture, ...part } });
  }
  /** Moves the time by hand: leaves playing and following. */
  moveTo(time: number): void {
    this.change({ time: Math.min(Math.max(time, this.player.times()[0] ?? 0), this.player.times().at(-1) ?? time), playing: false, follow: false });
  }

  use(tool: Tool): void {
    this.tool = tool;
    this.started = null;
    this.events.emit("view");
  }

  say(text: string, alert = false): void {
    this.note = { text, alert };
    this.events.emit("message");
  }

  /** The view's text goes into the address, not more often than browsers like. */
  private address(): void {
    if (this.addressTimer !== 0) return;
    this.addressTimer = window.setTimeout(() => {
      this.addressTimer = 0;
      if (this.view.playing) return;
      const text = viewText(this.view, this.first);
      if (location.hash.slice(1) !== text) history.replaceState(null, "", text === "" ? location.pathname : `#${text}`);
    }, 250);
  }
  link(): string {
    const text = viewText(this.view, this.first);
    return `${location.origin}${location.pathname}${text === "" ? "" : `#${text}`}`;
  }

  // --- runs in progress ---

  private schedule(): void {
    window.clearTimeout(this.pollTimer);
    if (this.isGoing) this.pollTimer = window.setTimeout(() => void this.poll(false), 2000);
  }

  /** Asks what is new of runs in progress; after the server was gone of all. */
  async poll(all: boolean): Promise<void> {
    if (this.polling) return;
    this.polling = true;
    try {
      if (this.requests.connection !== "open") return;
      for (const session of this.sessions) {
        if (session.run.is_over && !all) continue;
        const run = await this.requests.json<Run | { fault: string }>(`api/runs/${session.index}`);
        if ("fault" in run) throw new Refusal("", run.fault, 200);
        if (run.path !== session.run.path || (run.frames.length < session.run.frames.length && session.run.is_over)) location.reload();
        session.run = run;
        void session.loadHistory();
      }
      this.events.emit("run");
      this.player.update();
    } catch (fault) {
      if (!(fault instanceof Gone)) this.say((fault as Error).message, true);
    } finally {
      this.polling = false;
      this.schedule();
    }
  }
}
