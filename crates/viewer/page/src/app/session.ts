// One run in the page: what the server reported of it, its topologies, the frame on the screen, its history
// and ranges. Frames of all runs share one bounded store.

import { decodeFrame, decodeTopology } from "../wire";
import type { Frame, History, Range, Run, Scalar, Topology } from "../types";
import { Gone, Refusal, type Requests } from "./requests";
import { queryOf, type Wish } from "./wish";
import type { Events } from "./events";

const STORE_BYTES = 256 * 1024 * 1024;

function sizeOf(frame: Frame): number {
  return frame.positions.buffer.byteLength + 512;
}

/** Frames that were read, the least recently shown left out first when there are too many bytes. */
export class FrameStore {
  private frames = new Map<string, Frame>();
  bytes = 0;

  find(key: string): Frame | undefined {
    const frame = this.frames.get(key);
    if (frame) {
      this.frames.delete(key);
      this.frames.set(key, frame);
    }
    return frame;
  }
  has(key: string): boolean {
    return this.frames.has(key);
  }
  put(key: string, frame: Frame): void {
    const before = this.frames.get(key);
    if (before) this.bytes -= sizeOf(before);
    this.frames.delete(key);
    this.frames.set(key, frame);
    this.bytes += sizeOf(frame);
    for (const [oldest, old] of this.frames) {
      if (this.bytes <= STORE_BYTES || oldest === key) break;
      this.frames.delete(oldest);
      this.bytes -= sizeOf(old);
    }
  }
  clear(): void {
    this.frames.clear();
    this.bytes = 0;
  }
  /** How many frames of such a size fit, for what is read ahead. */
  room(frame: Frame | null): number {
    return frame ? Math.max(1, Math.floor(STORE_BYTES / (2 * sizeOf(frame)))) : 4;
  }
}

export class Session {
  topologies = new Map<number, Topology>();
  private asked = new Map<number, Promise<Topology>>();
  /** On the screen, and by which key it was asked for. */
  shown: Frame | null = null;
  shownKey = "";
  /** The newest of the live connection. */
  live: Frame | null = null;
  history: History | null = null;
  private columns = new Map<string, number>();
  private ranges = new Map<string, [number, number] | null>();
  private rangeAsked = new Map<string, number>();
  private historyAsked = false;
  /** Frames that could not be read, with what the server said. */
  faults = new Map<string, string>();

  constructor(readonly index: number, public run: Run, readonly requests: Requests, readonly store: FrameStore, readonly events: Events) {}

  scalar(key: string | null): Scalar | null {
    return this.run.scalars.find((scalar) => scalar.key === key) ?? null;
  }

  get end(): number {
    const last = this.run.frames.at(-1)?.time ?? 0;
    return this.run.is_over ? last : Math.max(this.run.end ?? last, last, this.live?.time ?? 0);
  }

  /** The place in the list of frames of what is nearest to a time. */
  nearest(time: number): number {
    const frames = this.run.frames;
    let [low, high] = [0, frames.length - 1];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (frames[middle]!.time < time) low = middle + 1;
      else high = middle;
    }
    if (low > 0 && time - frames[low - 1]!.time <= frames[low]!.time - time) low -= 1;
    return low;
  }

  key(number: number, wish: Wish): string {
    return `${this.index}/${number}/${queryOf(wish)}`;
  }

  /** Asks for a frame and its topology; both are in the stores when the promise is kept. */
  async load(number: number, wish: Wish, urgency: number): Promise<void> {
    const key = this.key(number, wish);
    try {
      const frame = await this.requests.get(`api/runs/${this.index}/frames/${number}?${queryOf(wish)}`, async (answer) => decodeFrame(await answer.arrayBuffer()), urgency, `frame ${key}`);
      await this.topology(frame.topology);
      this.store.put(key, frame);
    } catch (fault) {
      if (fault instanceof Gone) throw fault;
      this.faults.set(key, fault instanceof Refusal && fault.code ? `${fault.code}: ${fault.message}` : String((fault as Error).message));
      throw fault;
    }
  }

  topology(number: number): Promise<Topology> {
    const known = this.topologies.get(number);
    if (known) return Promise.resolve(known);
    let asked = this.asked.get(number);
    if (!asked) {
      asked = this.requests.get(`api/runs/${this.index}/topology/${number}`, async (answer) => decodeTopology(await answer.arrayBuffer()), 0).then(
        (topology) => {
          this.keep(number, topology);
          return topology;
        },
      );
      this.asked.set(number, asked);
      const over = () => void this.asked.delete(number);
      asked.then(over, over);
    }
    return asked;
  }

  /** Topologies of runs with erosion are many: the oldest goes, but for the one on the screen. */
  private keep(number: number, topology: Topology): void {
    this.topologies.set(number, topology);
    const size = (one: Topology) => one.initial.buffer.byteLength;
    let bytes = 0;
    for (const one of this.topologies.values()) bytes += size(one);
    for (const [oldest, one] of this.topologies) {
      if (bytes <= STORE_BYTES || oldest === number) break;
      if (oldest === this.shown?.topology) continue;
      this.topologies.delete(oldest);
      bytes -= size(one);
    }
  }

  // --- history ---

  async loadHistory(): Promise<void> {
    if (this.historyAsked) return;
    this.historyAsked = true;
    try {
      const history = await this.requests.json<History>(`api/runs/${this.index}/history?rows=2000`);
      this.history = history;
      this.columns = new Map(history.columns.map((column, i) => [column.name, i]));
      this.events.emit("history");
    } catch {
      // a run that has no history yet, or a server that is gone: asked again with the next round
    } finally {
      this.historyAsked = false;
    }
  }

  column(name: string): (number | null)[] | null {
    const at = this.columns.get(name);
    return at === undefined ? null : this.history?.values[at] ?? null;
  }
  unit(name: string): string {
    const at = this.columns.get(name);
    return at === undefined ? "" : this.history?.columns[at]?.unit ?? "";
  }
  names(): string[] {
    return this.history?.columns.map((column) => column.name) ?? [];
  }
  /** A column's value at a time, linear between rows. */
  at(name: string, time: number): number | null {
    const [times, values] = [this.column("time"), this.column(name)];
    return times && values ? between(times as number[], values, time) : null;
  }

  // --- range ---

  /** Smallest and largest value of a scalar over all frames, as far as known; asks for it where it is not. `kind`: what more an address says of it. */
  range(scalar: string | null, kind = ""): [number, number] | null {
    if (scalar === null || !this.scalar(scalar)) return null;
    const key = scalar + kind;
    const asked = this.rangeAsked.get(key);
    const count = this.run.frames.length;
    const stale = asked === undefined || (count !== asked && (this.run.is_over || count > asked * 1.25 + 10));
    if (stale && count > 0) {
      this.rangeAsked.set(key, count);
      this.requests
        .json<Range>(`api/runs/${this.index}/range?scalar=${encodeURIComponent(scalar)}${kind}`)
        .then((answer) => {
          if (answer.range) this.widen(key, answer.range);
          this.events.emit("range");
        })
        .catch((fault) => {
          if (fault instanceof Gone) this.rangeAsked.delete(key);
        });
    }
    return this.ranges.get(key) ?? null;
  }

  widen(key: string, range: [number, number]): boolean {
    const before = this.ranges.get(key);
    const after: [number, number] = before ? [Math.min(before[0], range[0]), Math.max(before[1], range[1])] : range;
    this.ranges.set(key, after);
    return before?.[0] !== after[0] || before[1] !== after[1];
  }
}

/** Linear between the rows of a table; outside its times nothing. */
export function between(times: ArrayLike<number>, values: ArrayLike<number | null>, time: number): number | null {
  const count = times.length;
  const slack = 1e-9 * Math.abs(times[count - 1] ?? 0);
  if (count === 0 || time < times[0]! - slack || time > times[count - 1]! + slack) return null;
  let [low, high] = [0, count - 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle]! <= time) low = middle;
    else high = middle;
  }
  const [a, b] = [values[low] ?? null, values[high] ?? null];
  if (a === null || b === null) return time - times[low]! <= times[high]! - time ? a : b;
  const span = times[high]! - times[low]!;
  const part = span > 0 ? Math.min(1, Math.max(0, (time - times[low]!) / span)) : 0;
  return a + (b - a) * part;
}
