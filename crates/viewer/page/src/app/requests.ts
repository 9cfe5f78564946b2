// Requests to the server: never more than two at a time, the more urgent first. Reports when the server does
// not answer, and tries until it does. Frames, histories and everything else of the page come through here.

import type { ServerError } from "../types";

/** The server answered, but with a refusal. */
export class Refusal extends Error {
  override name = "Refusal";
  constructor(readonly code: string, text: string, readonly status: number) {
    super(text);
  }
}
/** The server did not answer at all. */
export class Gone extends Error {
  override name = "Gone";
}

export type Connection = "open" | "gone" | "over";
interface Waiting {
  key: string;
  urgency: number;
  start: () => void;
  cancel: () => void;
}

const AT_A_TIME = 2;

export class Requests {
  private waiting: Waiting[] = [];
  private going = 0;
  private tries = 0;
  private timer = 0;
  connection: Connection = "open";
  /** Called when the server is gone, and when it answers again. */
  onConnection: (connection: Connection) => void = () => {};

  /** Urgency: 0 is wanted now, 1 soon, 2 perhaps. `key` names what `drop` may leave out. */
  get<T>(path: string, read: (answer: Response) => Promise<T>, urgency = 1, key = path): Promise<T> {
    return new Promise<T>((done, fail) => {
      const start = () => {
        this.going += 1;
        this.fetch(path, read).then(done, fail).finally(() => {
          this.going -= 1;
          this.pump();
        });
      };
      this.waiting.push({ key, urgency, start, cancel: () => fail(new Gone("left out")) });
      this.waiting.sort((a, b) => a.urgency - b.urgency);
      this.pump();
    });
  }

  json<T>(path: string, urgency = 1): Promise<T> {
    return this.get(path, (answer) => answer.json() as Promise<T>, urgency);
  }

  /** Leaves out what has not begun and is not wanted any more. */
  drop(unwanted: (key: string) => boolean): void {
    const [out, stay] = [this.waiting.filter((w) => unwanted(w.key)), this.waiting.filter((w) => !unwanted(w.key))];
    this.waiting = stay;
    for (const one of out) one.cancel();
  }

  private pump(): void {
    while (this.going < AT_A_TIME) {
      const next = this.waiting.shift();
      if (!next) return;
      next.start();
    }
  }

  private async fetch<T>(path: string, read: (answer: Response) => Promise<T>): Promise<T> {
    let answer: Response;
    try {
      answer = await fetch(path, { cache: "default", credentials: "omit" });
    } catch {
      this.lost();
      throw new Gone("the server does not answer");
    }
    this.found();
    if (!answer.ok) throw await refusal(answer);
    try {
      return await read(answer);
    } catch (fault) {
      if (fault instanceof TypeError) {
        this.lost();
        throw new Gone("the connection broke");
      }
      throw fault;
    }
  }

  /** The server is known to have ended: nothing is tried any more. */
  over(): void {
    clearTimeout(this.timer);
    this.timer = 0;
    this.set("over");
  }

  lost(): void {
    if (this.connection === "over") return;
    this.set("gone");
    if (this.timer !== 0) return;
    const wait = Math.min(5000, 500 * 1.6 ** this.tries);
    this.tries += 1;
    this.timer = window.setTimeout(() => void this.ask(), wait);
  }

  /** Asks at once whether the server is there again. */
  async ask(): Promise<void> {
    clearTimeout(this.timer);
    this.timer = 0;
    try {
      await fetch("api/runs", { cache: "no-store", credentials: "omit" });
      this.found();
    } catch {
      this.lost();
    }
  }

  private found(): void {
    this.tries = 0;
    if (this.connection === "gone") this.set("open");
  }

  private set(connection: Connection): void {
    if (this.connection === connection) return;
    this.connection = connection;
    this.onConnection(connection);
  }
}

async function refusal(answer: Response): Promise<Refusal> {
  const text = await answer.text().catch(() => "");
  try {
    const refusal = JSON.parse(text) as ServerError;
    if (typeof refusal.error === "string") return new Refusal(refusal.code ?? "", refusal.error, answer.status);
  } catch {
    // not JSON: reported as it is
  }
  return new Refusal("", text.slice(0, 500) || `the server answered ${answer.status}`, answer.status);
}
