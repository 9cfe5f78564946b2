// The real program for tests: runs of examples, servers on results and on running simulations. EMBATE names
// the program; otherwise it is the release build of this repository.

import { spawn, spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

export const root = resolve(dirname(fileURLToPath(import.meta.url)), "../../../..");
export const program = process.env.EMBATE ?? join(process.env.CARGO_TARGET_DIR ?? join(root, "target"), "release/embate");
if (!existsSync(program)) throw new Error(`there is no program ${program}: build it by cargo build --release, or name it by EMBATE`);
export const TOKEN = "0123456789abcdef0123456789abcdef";
export const folder = mkdtempSync(join(tmpdir(), "embate-page-"));
const servers = new Set();

export async function freePort() {
  return await new Promise((done) => {
    const server = createServer().listen(0, "127.0.0.1", () => {
      const { port } = server.address();
      server.close(() => done(port));
    });
  });
}

/** Runs an example to its end; its folder of results. */
export function results(example, name, ...more) {
  const out = join(folder, name);
  const ran = spawnSync(program, ["run", join(root, "examples", example), "--out", out, "--quiet", "--force", ...more], { encoding: "utf8" });
  if (ran.status !== 0) throw new Error(`embate run ${example} ended with ${ran.status}: ${ran.stderr}`);
  return out;
}

/** Starts the program and waits for its page. */
export async function serve(args, { port, token = TOKEN } = {}) {
  port ??= await freePort();
  const child = spawn(program, [...args, "--no-open", "--port", String(port), "--token", token], { stdio: ["ignore", "pipe", "pipe"] });
  servers.add(child);
  let said = "";
  const ended = new Promise((done) => child.on("exit", (code) => {
    servers.delete(child);
    done(code);
  }));
  child.stdout.on("data", (text) => (said += text));
  child.stderr.on("data", (text) => (said += text));
  const address = `http://127.0.0.1:${port}/${token}/`;
  const until = Date.now() + 30_000;
  for (;;) {
    const there = await fetch(`${address}api/runs`).then((a) => a.ok, () => false);
    if (there) break;
    if (child.exitCode !== null || Date.now() > until) throw new Error(`no server at ${address}: ${said}`);
    await new Promise((done) => setTimeout(done, 50));
  }
  return {
    address, port, token, child, ended, said: () => said,
    async kill(signal = "SIGKILL") {
      child.kill(signal);
      await ended;
    },
  };
}
export const view = (folders, options) => serve(["view", ...[folders].flat()], options);
export const watch = (example, name, more = [], options = {}) =>
  serve(["run", join(root, "examples", example), "--out", join(folder, name), "--quiet", "--force", "--watch", "--threads", "1", ...more], options);

export async function endAll() {
  for (const child of [...servers]) child.kill("SIGKILL");
  rmSync(folder, { recursive: true, force: true });
}
