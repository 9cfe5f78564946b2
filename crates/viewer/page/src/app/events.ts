// What happens in the page, by name: parts of the page listen to it and bring themselves up to date.

/** view: something of the view changed; shown: other frames are on the screen; run: runs' data are newer; history: histories are newer;
 * range: the colours' range is known; live: progress of a live run; message: a text for the user; connection; probe: values of probes arrived;
 * model: the file of a model before it runs has changed. */
export type Topic = "view" | "shown" | "run" | "history" | "range" | "live" | "message" | "connection" | "probe" | "theme" | "model";

export class Events {
  private listeners = new Map<Topic, (() => void)[]>();

  on(names: Topic | Topic[], listener: () => void): void {
    for (const name of Array.isArray(names) ? names : [names]) {
      const list = this.listeners.get(name) ?? [];
      list.push(listener);
      this.listeners.set(name, list);
    }
  }

  emit(name: Topic): void {
    for (const listener of this.listeners.get(name) ?? []) listener();
  }
}
