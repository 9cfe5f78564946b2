// Probes: nodes and elements whose values are plotted. Set by a click in the picture or by number; their
// values over time come from the server, once for each quantity, and again while a run grows.

import type { Probe, Scalar, Topology } from "../types";
import type { App } from "./app";
import { PROBE_COLOURS } from "./colours";
import type { Session } from "./session";
import { skinNode, type Tracks } from "./tracks";
import type { ProbePlace } from "./view";

export class Probes {
  private known = new Map<string, { frames: number; probe: Probe | null; fault: string }>();
  private asked = new Set<string>();

  constructor(private readonly app: App, readonly tracks: Tracks) {}

  add(place: ProbePlace): void {
    const { probes } = this.app.view;
    const there = probes.findIndex((p) => isSame(p, place));
    if (there < 0 && probes.length >= PROBE_COLOURS.length) {
      this.app.say(`There are ${PROBE_COLOURS.length} probes already: remove one first.`);
      return;
    }
    const all = there >= 0 ? probes.map((p, i) => (i === there ? place : p)) : [...probes, place];
    this.app.change({ probes: all, tab: "probes", panel: true });
  }
  remove(place: ProbePlace): void {
    this.app.change({ probes: this.app.view.probes.filter((p) => p !== place) });
  }

  /** Adds a node or an element by its number; says why not. */
  addNumber(session: Session, of: ProbePlace["of"], number: number): string {
    const topology = session.shown ? session.topologies.get(session.shown.topology) : undefined;
    if (!topology) return "There is no frame yet.";
    const count = of === "node" ? session.run.nodes : session.run.elements;
    if (number >= count) return `There is no ${words(of)} ${number}: the numbers are 0 to ${count - 1}.`;
    this.add(of === "node" ? { run: session.index, of, node: number, cell: cellAt(topology, number) } : { run: session.index, of, node: 0, cell: number });
    return "";
  }

  name(place: ProbePlace): string {
    const run = this.app.isComparison ? (place.run === this.app.sessions[0]!.index ? " (A)" : " (B)") : "";
    return `${words(place.of)} ${place.of === "node" ? place.node : place.cell}${run}`;
  }

  /** The value now, from the frame on the screen where that shows it, else from the values over time. */
  now(session: Session, place: ProbePlace): number | null {
    const scalar = session.scalar(this.app.view.scalar);
    const frame = session.shown;
    const topology = frame ? session.topologies.get(frame.topology) : undefined;
    if (!frame || !scalar || !topology) return null;
    if (frame.scalar === scalar.key) {
      const at = frame.location === "node" && place.of === "node" ? skinNode(topology.nodeNumbers, place.node) : frame.location === "cell" && !isMean(this.app, place, scalar) ? shownCell(topology, place.cell) : -1;
      const value = at < 0 ? undefined : frame.values[at];
      if (value !== undefined) return Number.isNaN(value) ? null : value;
    }
    const probe = this.over(session, place, scalar);
    const row = probe?.times.reduce((best, t, i) => (Math.abs(t - frame.time) < Math.abs(probe.times[best]! - frame.time) ? i : best), 0);
    return row === undefined ? null : probe!.values[row] ?? null;
  }

  /** Values over time; null until they are there. Asks for them. */
  over(session: Session, place: ProbePlace, scalar: Scalar | null): Probe | null {
    if (!scalar) return null;
    const path = this.path(session, place, scalar);
    const known = this.known.get(path);
    const frames = session.run.frames.length;
    if (!this.asked.has(path) && (known === undefined || known.frames !== frames)) {
      this.asked.add(path);
      this.app.requests.json<Probe>(path).then(
        (probe) => this.known.set(path, { frames, probe, fault: "" }),
        (fault: Error) => {
          if (fault.name === "Refusal") this.known.set(path, { frames, probe: known?.probe ?? null, fault: fault.message });
        },
      ).finally(() => {
        this.asked.delete(path);
        this.app.events.emit("probe");
      });
    }
    return known?.probe ?? null;
  }

  /** Why there are no values over time; empty where there are, or will be. */
  fault(session: Session, place: ProbePlace, scalar: Scalar): string {
    return this.known.get(this.path(session, place, scalar))?.fault ?? "";
  }

  private path(session: Session, place: ProbePlace, scalar: Scalar): string {
    const query = place.of === "node" && (scalar.location === "node" || isMean(this.app, place, scalar)) ? `node=${place.node}` : `cell=${place.cell}`;
    return `api/runs/${session.index}/probe?scalar=${encodeURIComponent(scalar.key)}&${query}`;
  }
}

export const words = (of: ProbePlace["of"]): string => (of === "node" ? "node" : "element");

function isSame(a: ProbePlace, b: ProbePlace): boolean {
  return a.run === b.run && a.of === b.of && (a.of === "node" ? a.node === b.node : a.cell === b.cell);
}

/** The row of a cell among facets and then bars; -1 if it is not seen. */
function shownCell(topology: Topology, cell: number): number {
  const at = topology.facetCells.indexOf(cell);
  if (at >= 0 || topology.barCells.length === 0) return at;
  const bar = topology.barCells.indexOf(cell);
  return bar < 0 ? -1 : topology.facetCells.length + bar;
}

/** Whether a probe at a node shows the mean of the elements around it for a quantity of elements. */
export function isMean(app: App, place: ProbePlace, scalar: Scalar): boolean {
  const { averaged, iso } = app.view.picture;
  return place.of === "node" && scalar.location === "cell" && (place.cell < 0 || averaged || iso);
}

/** A cell at a node: that of its first facet or bar; −1 for a node inside. */
function cellAt(topology: Topology, node: number): number {
  const skin = skinNode(topology.nodeNumbers, node);
  const at = skin < 0 ? -1 : topology.facets.indexOf(skin);
  if (at >= 0) return topology.facetCells[at >> 2] ?? -1;
  const bar = skin < 0 ? -1 : topology.bars.indexOf(skin);
  return bar >= 0 ? topology.barCells[bar >> 1] ?? -1 : -1;
}
