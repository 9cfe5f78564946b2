// Which frame is on the screen: the nearest to the view's time of each run, or the newest of a live one.
// Reads frames ahead, plays, and hands what is ready to the panes.

import type { Frame } from "../types";
import type { App } from "./app";
import { rangeKind } from "./colours";
import { Gone } from "./requests";
import type { Session } from "./session";

const PLAY_SECONDS = 10;
const AHEAD = 12;

export class Player {
  /** Draws a frame in the pane of a session. */
  onShow: (session: Session, frame: Frame) => void = () => {};
  private loading = new Set<string>();
  private clock = 0;
  private last = 0;
  private ticking = false;

  constructor(private readonly app: App) {}

  /** Times at which the time bar stops: those of the run with most frames, and what the other has beyond its end. */
  times(): number[] {
    const sessions = [...this.app.sessions].sort((a, b) => b.run.frames.length - a.run.frames.length);
    const list = sessions[0]!.run.frames.map((frame) => frame.time);
    const end = list.at(-1) ?? 0;
    for (const frame of sessions[1]?.run.frames ?? []) if (frame.time > end * (1 + 1e-6) + 1e-30) list.push(frame.time);
    return list;
  }
  place(times = this.times()): number {
    const time = this.app.view.time;
    let best = 0;
    for (let i = 1; i < times.length; i++) if (Math.abs(times[i]! - time) < Math.abs(times[best]! - time)) best = i;
    return best;
  }
  step(by: number): void {
    const times = this.times();
    const to = times[Math.min(Math.max(this.place(times) + by, 0), times.length - 1)];
    if (to !== undefined) this.app.moveTo(to);
  }

  private follows(session: Session): boolean {
    return this.app.view.follow && this.app.live?.session === session && this.app.live.ended === null && session.live !== null;
  }

  /** Brings the screen up to the view: shows what is there, asks for what is not, reads ahead. */
  update(): void {
    const { view, live } = this.app;
    if (live) live.want(this.app.wish(live.session));
    if (view.follow && !view.playing) {
      const newest = this.times().at(-1);
      const shown = live && !live.ended ? null : newest;
      if (shown !== undefined && shown !== null && shown !== view.time) {
        this.app.view = { ...view, time: shown };
        this.app.events.emit("shown");
      }
    }
    const wanted: [Session, number, number][] = [];
    for (const session of this.app.sessions) {
      if (this.follows(session)) continue;
      const frames = session.run.frames;
      if (frames.length === 0) continue;
      const at = session.nearest(this.app.view.time);
      wanted.push([session, at, 0]);
      if (this.app.isDragging) continue;
      const room = Math.min(view.playing ? AHEAD : 2, session.store.room(session.shown));
      for (let i = 1; i <= room; i++) if (at + i < frames.length) wanted.push([session, at + i, 2]);
      if (!view.playing && at > 0) wanted.push([session, at - 1, 2]);
    }
    const keys = new Set(wanted.map(([session, at]) => `frame ${this.key(session, at)}`));
    this.app.requests.drop((key) => key.startsWith("frame ") && !keys.has(key));
    for (const [session, at, urgency] of wanted) {
      if (urgency === 0) this.show(session, at);
      this.ask(session, at, urgency);
    }
    if (view.playing) this.tick();
  }

  private key(session: Session, at: number): string {
    return session.key(session.run.frames[at]!.number, this.app.wish(session));
  }

  /** Shows the frame if it is there. */
  private show(session: Session, at: number): boolean {
    const frame = session.store.find(this.key(session, at));
    if (!frame || !session.topologies.has(frame.topology)) return false;
    if (session.shown !== frame) this.put(session, frame, this.key(session, at));
    return true;
  }

  private put(session: Session, frame: Frame, key: string): void {
    session.shown = frame;
    session.shownKey = key;
    if (frame.range && frame.scalar !== null) session.widen(frame.scalar + rangeKind(this.app, session), frame.range);
    this.onShow(session, frame);
    this.app.events.emit("shown");
  }

  private ask(session: Session, at: number, urgency: number): void {
    const key = this.key(session, at);
    if (this.loading.has(key) || session.faults.has(key)) return;
    const known = session.store.has(key) ? session.store.find(key) : undefined;
    if (known && session.topologies.has(known.topology)) return;
    this.loading.add(key);
    const number = session.run.frames[at]!.number;
    session
      .load(number, this.app.wish(session), urgency)
      .then(() => { this.loading.delete(key); return true; }, (fault) => {
        this.loading.delete(key);
        if (!(fault instanceof Gone)) this.app.say(`Frame ${number} can't be shown. ${(fault as Error).message}`, true);
        return false;
      })
      .then((arrived) => {
        if (arrived !== true) return;
        const now = session.run.frames[session.nearest(this.app.view.time)];
        if (now?.number === number && !this.follows(session)) this.show(session, session.nearest(this.app.view.time));
      });
  }

  /** The newest frame of the live run; resolved when it was drawn. */
  async showLive(): Promise<void> {
    const session = this.app.live!.session;
    const frame = session.live;
    if (!frame || !this.app.view.follow || this.app.live!.ended) return;
    this.app.view = { ...this.app.view, time: frame.time };
    this.put(session, frame, "live");
    if (document.visibilityState === "visible") await new Promise((done) => requestAnimationFrame(done));
  }

  // --- playing ---

  toggle(): void {
    const { view } = this.app;
    if (view.playing) return this.app.change({ playing: false });
    const times = this.times();
    const atEnd = this.place(times) >= times.length - 1;
    this.app.change({ playing: true, follow: false, time: atEnd ? times[0] ?? 0 : view.time });
  }

  /** Seconds of the run per second of the clock. */
  rate(): number {
    const times = this.times();
    return (((times.at(-1) ?? 0) - (times[0] ?? 0)) / PLAY_SECONDS) * this.app.view.speed;
  }

  private tick(): void {
    if (this.ticking) return;
    this.ticking = true;
    this.clock = this.app.view.time;
    this.last = performance.now();
    const step = (now: number) => {
      const { view } = this.app;
      if (!view.playing) {
        this.ticking = false;
        return;
      }
      const times = this.times();
      const end = times.at(-1) ?? 0;
      if (view.time > this.clock || view.time < this.clock - 0.2 * Math.max(end, 1e-300)) this.clock = view.time;
      const passed = Math.min(0.1, (now - this.last) / 1000);
      this.last = now;
      this.advance(times, this.clock + passed * this.rate());
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  /** Goes on to a time, as far as frames are there: playing waits for them, it leaves none out that it must show. */
  private advance(times: number[], to: number): void {
    const app = this.app;
    const here = this.place(times);
    let there = here;
    while (there + 1 < times.length && times[there + 1]! <= to) there += 1;
    if (there === here) {
      this.clock = to;
      const over = here >= times.length - 1;
      if (over && !app.isGoing) {
        if (app.view.loop) {
          this.clock = times[0] ?? 0;
          app.view = { ...app.view, time: this.clock };
          app.events.emit("shown");
          this.update();
        } else app.change({ playing: false });
      } else if (over) this.clock = times[here] ?? 0;
      return;
    }
    while (there > here && !this.ready(times[there]!)) there -= 1;
    if (there === here) {
      // the next is not here yet: the clock waits, unless it can't be read at all
      if (this.broken(times[here + 1]!)) there = here + 1;
      else {
        app.view = { ...app.view };
        this.update();
        return;
      }
    }
    this.clock = Math.min(to, times[there + 1] ?? to);
    app.view = { ...app.view, time: times[there]! };
    app.events.emit("shown");
    this.update();
  }

  private ready(time: number): boolean {
    return this.app.sessions.every((session) => {
      const frame = session.store.find(this.key(session, session.nearest(time)));
      return frame !== undefined && session.topologies.has(frame.topology);
    });
  }
  private broken(time: number): boolean {
    return this.app.sessions.some((session) => session.faults.has(this.key(session, session.nearest(time))));
  }
}
