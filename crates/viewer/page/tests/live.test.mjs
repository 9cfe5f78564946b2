// The page on a run that is watched while it goes: to its end, pause, kept state, stop, lost and found
// servers.

import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";
import { close, coloured, frame, key, pageAt, text, time, until } from "./browser.mjs";
import { endAll, folder, freePort, results, view, watch } from "./program.mjs";

after(async () => {
  await close();
  await endAll();
});

test("a live run is seen going, and its end is told", async () => {
  const server = await watch("tube-plate", "to-its-end", ["--keep", "--set", "run.end=0.03"]);
  const { page, done } = await pageAt(server.address);
  await until(async () => /\d ms of 30\.0+ ms/.test(await text(page, ".live-figures")), "progress");
  assert.match(await text(page, ".live-figures"), /step.*Δt.*governed by.*energy drift.*wall time/s);
  await until(async () => (await coloured(page)) > 800, "bodies");
  await until(async () => /live/.test(await frame(page)) || /Done/.test(await text(page, ".live-state")), "a live frame");
  await until(async () => /Done/.test(await text(page, ".live-state")), "its end", 600);
  assert.match(await text(page, ".live-end"), /reached its end/);
  await until(async () => /frame 301 of 301|frame 101 of 101/.test(await frame(page)), "the last of the frames on disk");
  assert.match(await time(page), /^30\.0/);
  await page.getByRole("tab", { name: "About" }).click();
  await until(async () => /State hash/.test(await text(page, ".tab-body")), "the summary");
  await done();
  await server.kill();
});

test("a live run is cut and averaged as it goes", async () => {
  const server = await watch("taylor-bar-3d", "cut-live", ["--keep", "--set", "output.pictures=false", "--set", "run.end=1"]);
  const { page, done } = await pageAt(`${server.address}#field=von_mises&averaged=1`);
  const heads = [];
  const asked = [];
  page.on("websocket", (socket) => {
    socket.on("framesent", ({ payload }) => asked.push(String(payload)));
    socket.on("framereceived", ({ payload }) => {
      if (typeof payload !== "string") heads.push(JSON.parse(payload.toString("utf8", 8, 8 + payload.readUInt32LE(4))));
    });
  });
  await page.reload();
  await until(() => heads.some((head) => head.location === "corner" && head.sections === undefined), "averaged frames");
  await key(page, "c");
  await until(() => heads.some((head) => head.sections?.[0]?.facets > 0), "frames with a section");
  assert.ok(asked.some((text) => JSON.parse(text).section?.split(",").length === 4));
  await done();
  await server.kill();
});

test("pause holds the run, keep state writes one, resume goes on, stop asks once more and keeps the results", async () => {
  const server = await watch("tube-plate", "pause", ["--keep", "--set", "run.end=1"]);
  const { page, done } = await pageAt(server.address);
  await until(async () => /Running/.test(await text(page, ".live-state")), "running");
  await page.getByRole("button", { name: "Pause", exact: true }).click();
  await until(async () => /Paused/.test(await text(page, ".live-state")), "paused");
  const step = async () => Number(/step\D*([\d\u202f]+)/.exec(await text(page, ".live-figures"))[1].replace(/\u202f/g, ""));
  const held = await step();
  await page.waitForTimeout(700);
  assert.equal(await step(), held);
  await page.getByRole("button", { name: "Keep state" }).click();
  await until(async () => (await text(page, ".live-said")).length > 5 && (await page.locator(".live-said").isVisible()), "what was kept");
  await page.getByRole("button", { name: "Resume" }).click();
  await until(async () => (await step()) > held, "steps again");

  // moving the scrubber leaves the live state; "follow" goes back to it
  await until(async () => /live/.test(await frame(page)), "following");
  await key(page, "Home");
  await until(async () => /^frame 1 of/.test(await frame(page)), "the first frame");
  assert.equal(await page.getByRole("button", { name: "Follow" }).getAttribute("aria-pressed"), "false");
  await page.getByRole("button", { name: "Follow" }).click();
  await until(async () => /live/.test(await frame(page)), "live again");

  await page.getByRole("button", { name: "Stop", exact: true }).click();
  await page.getByRole("dialog").waitFor();
  await page.getByRole("button", { name: "Go on" }).click();
  await page.waitForTimeout(300);
  assert.match(await text(page, ".live-state"), /Running/);
  await page.getByRole("button", { name: "Stop", exact: true }).click();
  await page.getByRole("button", { name: "Stop the run" }).click();
  await until(async () => /Stopped/.test(await text(page, ".live-state")), "stopped");
  assert.match(await text(page, ".live-end"), /results until then are kept/);
  await done();
  await server.kill();
  const summary = JSON.parse(readFileSync(join(folder, "pause", "summary.json"), "utf8"));
  assert.equal(summary.status, "stopped");
  assert.ok(existsSync(join(folder, "pause", "checkpoint")));
});

test("a server that ends with its run leaves the page as it is, in words and without alarm", async () => {
  const server = await watch("tube-plate", "ends", ["--set", "run.end=0.01"]);
  const { page, done } = await pageAt(server.address);
  await until(async () => /Done/.test(await text(page, ".live-state")), "the end", 600);
  assert.equal(await server.ended, 0);
  assert.match(await text(page, ".live-end"), /The server has ended with it/);
  await page.waitForTimeout(2500);
  assert.equal(await page.locator(".banner[role=alert]:not([hidden])").count(), 0);
  assert.ok((await coloured(page)) > 800);
  await done(/ERR_CONNECTION|WebSocket/);
});

test("a run that is over before its page is opened waits for it and shows its end", async () => {
  const server = await watch("tube-plate", "short", ["--set", "run.end=1e-5"]);
  await until(() => /over before its page was opened/.test(server.said()), "the end of the run", 600);
  const { page, done } = await pageAt(server.address);
  await until(async () => /Done/.test(await text(page, ".live-state")), "the end", 600);
  assert.equal(await server.ended, 0);
  assert.ok((await coloured(page)) > 800);
  await done(/ERR_CONNECTION|WebSocket/);
});

test("the page says when the server was killed, and goes on when it was started again", async () => {
  const run = results("tube-plate", "finished");
  const port = await freePort();
  const first = await view(run, { port });
  const { page, done } = await pageAt(`${first.address}#t=0.001`);
  await until(async () => (await coloured(page)) > 800, "bodies");
  await first.kill();
  await key(page, "End");
  await until(async () => (await page.locator(".banner[role=alert]:not([hidden])").count()) > 0, "the banner");
  assert.match(await text(page, ".banner[role=alert]:not([hidden])"), /does not answer/);
  const again = await view(run, { port });
  await until(async () => (await page.locator(".banner[role=alert]:not([hidden])").count()) === 0, "the banner goes", 15);
  await until(async () => /frame 101 of 101/.test(await frame(page)), "where it was");
  const shown = await page.locator(".pane canvas").screenshot();
  const other = await pageAt(page.url());
  await until(async () => (await other.page.locator(".pane canvas").screenshot()).equals(shown), "the picture of the last frame");
  await other.done();
  await done(/ERR_CONNECTION|Failed to load/);
  await again.kill();
});

test("a live page reconnects when its run was started again at the same address", async () => {
  const port = await freePort();
  const first = await watch("tube-plate", "again", ["--keep", "--set", "run.end=1"], { port });
  const { page, done } = await pageAt(first.address);
  await until(async () => /Running/.test(await text(page, ".live-state")), "running");
  await first.kill();
  await until(async () => /Not connected/.test(await text(page, ".live-state")), "not connected");
  await until(async () => (await page.locator(".banner[role=alert]:not([hidden])").count()) > 0, "the banner");
  const second = await watch("tube-plate", "again", ["--keep", "--set", "run.end=1"], { port });
  await until(async () => /Running/.test(await text(page, ".live-state")), "running again", 20);
  await until(async () => (await page.locator(".banner[role=alert]:not([hidden])").count()) === 0, "no banner");
  const step = async () => Number(/step\D*([\d\u202f]+)/.exec(await text(page, ".live-figures"))[1].replace(/\u202f/g, ""));
  const now = await step();
  await until(async () => (await step()) !== now, "steps");
  await done(/ERR_CONNECTION|WebSocket|Failed to load/);
  await second.kill();
});

test("frames of a run in another process appear by themselves, and follow holds on to the newest", async () => {
  const { spawn } = await import("node:child_process");
  const { program, root } = await import("./program.mjs");
  const out = join(folder, "elsewhere");
  const child = spawn(program, ["run", join(root, "examples/tube-plate"), "--out", out, "--quiet", "--threads", "1", "--set", "run.end=0.1"], { stdio: "ignore" });
  await until(() => existsSync(join(out, "fields.pvd")), "frames", 30);
  const server = await view(out);
  const { page, done } = await pageAt(server.address);
  await until(async () => /frame \d+ of \d+/.test(await frame(page)), "frames");
  const count = async () => /frame (\d+) of (\d+)/.exec(await frame(page)).slice(1).map(Number);
  const [, before] = await count();
  await until(async () => (await count())[1] > before, "more frames");
  const [at, of] = await count();
  assert.equal(at, of, "the newest is shown");
  await key(page, "Home");
  await page.waitForTimeout(2500);
  assert.equal((await count())[0], 1);
  await done();
  child.kill("SIGKILL");
  await server.kill();
});
