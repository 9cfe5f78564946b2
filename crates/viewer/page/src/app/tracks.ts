// Where nodes and elements are over the frames of a run: for marks inside the bodies and for distances. Asked
// from the server once, and again while a run grows.

import type { Track, Vector } from "../types";
import type { App } from "./app";
import type { Session } from "./session";

export interface Place {
  run: number;
  of: "node" | "cell";
  number: number;
}

export class Tracks {
  private readonly known = new Map<string, { frames: number; track: Track | null }>();
  private readonly asked = new Set<string>();

  constructor(private readonly app: App) {}

  /** Null until it is there; asks for it. */
  of(session: Session, of: "node" | "cell", number: number): Track | null {
    const path = `api/runs/${session.index}/track?${of}=${number}`;
    const known = this.known.get(path);
    const frames = session.run.frames.length;
    if (!this.asked.has(path) && frames > 0 && known?.frames !== frames) {
      this.asked.add(path);
      this.app.requests.json<Track>(path).then(
        (track) => this.known.set(path, { frames, track }),
        (fault: Error) => {
          if (fault.name === "Refusal") this.known.set(path, { frames, track: known?.track ?? null });
        },
      ).finally(() => {
        this.asked.delete(path);
        this.app.events.emit("probe");
      });
    }
    return known?.track ?? null;
  }

  /** Where a node is in the frame on the screen, and at the beginning, m: from the frame, or from its track. */
  now(session: Session, node: number): { initial: Vector; now: Vector } | null {
    const frame = session.shown;
    const topology = frame ? session.topologies.get(frame.topology) : undefined;
    if (!frame || !topology) return null;
    const skin = skinNode(topology.nodeNumbers, node);
    if (skin >= 0) {
      const at = (places: Float32Array): Vector => [0, 1, 2].map((k) => places[3 * skin + k]! + topology.origin[k]!) as Vector;
      return { initial: at(topology.initial), now: at(frame.positions) };
    }
    return this.at(session, "node", node);
  }

  /** The same by the track alone, at the frame nearest to that on the screen. */
  at(session: Session, of: "node" | "cell", number: number): { initial: Vector; now: Vector } | null {
    const track = this.of(session, of, number);
    const time = session.shown?.time;
    if (track === null || time === undefined || track.times.length === 0) return null;
    let best = 0;
    track.times.forEach((t, i) => {
      if (Math.abs(t - time) < Math.abs(track.times[best]! - time)) best = i;
    });
    return { initial: track.initial, now: track.positions[best]! };
  }
}

/** The place of a node among those of the skin, whose numbers ascend; -1 if it is not there. */
export function skinNode(numbers: Uint32Array, node: number): number {
  let [low, high] = [0, numbers.length - 1];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (numbers[middle]! < node) low = middle + 1;
    else high = middle;
  }
  return numbers[low] === node ? low : -1;
}
