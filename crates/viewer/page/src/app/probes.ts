// Probes: nodes whose value of the shown quantity is plotted. Set by a click in the picture or by number;
// their values over time come from the server, once for each quantity, and again while a run grows.

import type { Probe, Topology } from "../types";
import type { Pick } from "../viewport/viewport";
import type { App } from "./app";
import { PROBE_COLOURS } from "./colours";
import type { Session } from "./session";
import type { ProbePlace } from "./view";

export class Probes {
  private known = new Map<string, { frames: number; probe: Probe | null; fault: string }>();
  private asked = new Set<string>();

  constructor(private readonly app: App) {}

  add(session: Session, node: number, cell: number): void {
    const { probes } = this.app.view;
    const there = probes.findIndex((p) => p.run === session.index && p.node === node);
    const rest = probes.filter((_, i) => i !== there);
    if (there < 0 && rest.length >= PROBE_COLOURS.length) {
      this.app.say(`There are ${PROBE_COLOURS.length} probes already: remove one first.`);
      return;
    }
    if (there >= 0) this.app.change({ probes: probes.map((p, i) => (i === there ? { ...p, cell } : p)), tab: "probes", panel: true });
    else this.app.change({ probes: [...probes, { run: session.index, node, cell }], tab: "probes", panel: true });
  }
  pick(session: Session, pick: Pick): void {
    this.add(session, pick.node, pick.cell);
  }
  remove(place: ProbePlace): void {
    this.app.change({ probes: this.app.view.probes.filter((p) => p !== place) });
  }

  /** Adds a node by its number; says why not. */
  addNumber(session: Session, node: number): string {
    const topology = session.shown ? session.topologies.get(session.shown.topology) : undefined;
    if (!topology) return "There is no frame yet.";
    const skin = topology.nodeNumbers.indexOf(node);
    if (skin < 0) return session.run.dimension === 3 ? `Node ${node} is not on the skin of the bodies.` : `There is no node ${node}.`;
    this.add(session, node, cellAt(topology, skin));
    return "";
  }

  /** The value now, from the frame on the screen. */
  now(session: Session, place: ProbePlace): number | null {
    const frame = session.shown;
    const scalar = session.scalar(this.app.view.scalar);
    const topology = frame ? session.topologies.get(frame.topology) : undefined;
    if (!frame || !scalar || !topology || frame.scalar !== scalar.key) return null;
    let at: number;
    if (scalar.location === "node") at = topology.nodeNumbers.indexOf(place.node);
    else {
      at = topology.facetCells.indexOf(place.cell);
      if (at < 0 && topology.barCells.length > 0) {
        const bar = topology.barCells.indexOf(place.cell);
        at = bar < 0 ? -1 : topology.facetCells.length + bar;
      }
    }
    const value = at < 0 ? undefined : frame.values[at];
    return value === undefined || Number.isNaN(value) ? null : value;
  }

  /** Values over time; null until they are there. Asks for them. */
  over(session: Session, place: ProbePlace): Probe | null {
    const scalar = session.scalar(this.app.view.scalar);
    if (!scalar) return null;
    const query = scalar.location === "node" ? `node=${place.node}` : `cell=${place.cell}`;
    const path = `api/runs/${session.index}/probe?scalar=${encodeURIComponent(scalar.key)}&${query}`;
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
}

/** A cell at a skin node: that of its first facet or bar. */
function cellAt(topology: Topology, skin: number): number {
  const at = topology.facets.indexOf(skin);
  if (at >= 0) return topology.facetCells[at >> 2] ?? 0;
  const bar = topology.bars.indexOf(skin);
  return bar >= 0 ? topology.barCells[bar >> 1] ?? 0 : 0;
}
