// Lines of one or two runs over common times, for plots: times are merged, values are linear between rows.

import type { App } from "./app";
import type { Line } from "./plot";
import { between, type Session } from "./session";

export interface Wanted {
  label: string;
  unit: string;
  colour: string;
  /** The column of a session, or nothing if it has none. */
  of: (session: Session) => { times: number[]; values: (number | null)[] } | null;
  area?: boolean;
}

/** A column of the history. */
export function column(name: string): Wanted["of"] {
  return (session) => {
    const [times, values] = [session.column("time"), session.column(name)];
    return times && values ? { times: times as number[], values } : null;
  };
}

/** Merged times and lines: those of the first run whole, those of the second dashed. Of a comparison all are lines. */
export function linesOf(app: App, wanted: Wanted[], sessions: Session[] = app.sessions): { times: number[]; lines: Line[] } {
  const found = wanted.flatMap((one) => sessions.map((session) => ({ one, session, data: one.of(session) }))).filter((f) => f.data !== null && f.data.times.length > 0);
  const tables = [...new Set(found.map((f) => f.data!.times))];
  const times = merged(tables);
  const several = sessions.length > 1;
  const lines = found.map(({ one, session, data }): Line => {
    const values = data!.times === times ? data!.values : times.map((time) => between(data!.times, data!.values, time));
    const second = session !== app.sessions[0];
    const mark = several ? ` · ${second ? "B" : "A"}` : "";
    return { label: one.label + mark, unit: one.unit, colour: one.colour, values, dashed: several && second, area: one.area ?? false };
  });
  return { times, lines };
}

function merged(tables: number[][]): number[] {
  if (tables.length <= 1) return tables[0] ?? [];
  const all = tables.flat().sort((a, b) => a - b);
  return all.filter((time, i) => i === 0 || time > all[i - 1]!);
}

/** The largest size in a column, to leave out what is zero all the time. */
export function largest(values: (number | null)[] | null): number {
  let size = 0;
  for (const v of values ?? []) if (v !== null && Math.abs(v) > size) size = Math.abs(v);
  return size;
}
