// The connection to a run that is watched while it goes: progress, notices, the newest frame, and the
// commands that the page may give. A frame is answered when it was drawn, so that a slow page gets fewer.
// Lost connections are tried again.

import { decodeFrame } from "../wire";
import type { LiveMessage, Progress, Warning } from "../types";
import type { Events } from "./events";
import type { Requests } from "./requests";
import type { Session } from "./session";
import type { Wish } from "./wish";

export class Live {
  progress: Progress | null = null;
  ended: Extract<LiveMessage, { kind: "ended" }> | null = null;
  notices: Warning[] = [];
  /** What the last command led to. */
  notice: { text: string; refused: boolean } | null = null;
  connected = false;
  private socket: WebSocket | null = null;
  private wanted = "";
  private tries = 0;
  /** Draws a frame; called with the newest one. */
  onFrame: () => Promise<void> = async () => {};

  constructor(readonly session: Session, readonly requests: Requests, readonly events: Events) {}

  open(): void {
    const address = new URL("api/live", document.baseURI);
    address.protocol = address.protocol === "https:" ? "wss:" : "ws:";
    const socket = new WebSocket(address);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    socket.onopen = () => {
      this.connected = true;
      this.tries = 0;
      if (this.wanted !== "") socket.send(this.wanted);
      this.events.emit("live");
    };
    socket.onmessage = (message: MessageEvent<ArrayBuffer | string>) => {
      if (typeof message.data === "string") this.onMessage(JSON.parse(message.data) as LiveMessage);
      else void this.take(message.data);
    };
    socket.onclose = () => {
      if (this.socket !== socket) return;
      this.connected = false;
      this.socket = null;
      this.events.emit("live");
      if (this.ended) return;
      void this.requests.ask();
      window.setTimeout(() => this.open(), Math.min(5000, 500 * 1.6 ** this.tries++));
    };
  }

  private onMessage(message: LiveMessage): void {
    if (message.kind === "progress") this.progress = message;
    else if (message.kind === "notices") {
      for (const notice of message.notices) {
        if (!this.notices.some((known) => known.code === notice.code && known.text === notice.text)) this.notices.push(notice);
      }
      this.events.emit("message");
    } else if (message.kind === "kept" || message.kind === "refused") {
      this.notice = { text: message.text, refused: message.kind === "refused" };
      this.events.emit("message");
    } else if (message.kind === "ended") {
      this.ended = message;
      if (!message.stays) this.requests.over();
      this.events.emit("message");
    }
    this.events.emit("live");
  }

  private async take(bytes: ArrayBuffer): Promise<void> {
    try {
      const frame = decodeFrame(bytes);
      await this.session.topology(frame.topology);
      this.session.live = frame;
      await this.onFrame();
    } catch (fault) {
      this.notice = { text: `A live frame could not be shown: ${(fault as Error).message}`, refused: true };
      this.events.emit("message");
    }
    this.send({ seen: true });
  }

  /** What frames shall hold. */
  want(wish: Wish): void {
    const text = JSON.stringify(wish);
    if (text === this.wanted) return;
    this.wanted = text;
    if (this.connected) this.socket?.send(text);
  }

  command(command: "pause" | "resume" | "stop" | "checkpoint"): void {
    this.notice = null;
    this.send({ command });
    this.events.emit("message");
  }

  private send(message: object): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }
}
