// What the page says of folders that are no results, of broken frames and failed runs, to strangers, and
// without WebGL.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { cpSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { close, coloured, frame, key, open, pageAt, text, until } from "./browser.mjs";
import { endAll, folder, program, results, root, TOKEN, view } from "./program.mjs";

let run;
let server;
before(async () => {
  run = results("tube-plate", "tube-plate");
  server = await view(run);
});
after(async () => {
  await close();
  await endAll();
});

test("a folder that is no result, and one with broken files, give a page that explains", async () => {
  const broken = join(folder, "broken");
  cpSync(run, broken, { recursive: true });
  rmSync(join(broken, "summary.json"));
  writeFileSync(join(broken, "run.json"), "{ this is no JSON");
  for (const name of readdirSync(join(broken, "fields"))) writeFileSync(join(broken, "fields", name), "<VTKFile");
  const other = await view(broken);
  const { page, done } = await pageAt(other.address, { ready: false });
  await page.locator(".fault-page h1").waitFor();
  assert.match(await text(page, ".fault-page"), /can't be shown/);
  assert.match(await text(page, ".fault-page"), /E\d{4}/);
  assert.ok((await text(page, ".fault-page pre")).length > 20);
  assert.match(await text(page, ".fault-page"), /What to do/);
  await done();
  await other.kill();
});

test("one broken frame is told, the others are shown", async () => {
  const broken = join(folder, "one-frame");
  cpSync(run, broken, { recursive: true });
  writeFileSync(join(broken, "fields/frame-00010.vtu"), "<VTKFile");
  const other = await view(broken);
  const { page, done } = await pageAt(`${other.address}#t=0.001`);
  await until(async () => (await page.locator(".banner:not([hidden])").count()) > 0, "a banner");
  assert.match(await text(page, ".banner:not([hidden])"), /Frame 10 can't be shown/);
  await key(page, "ArrowRight");
  await until(async () => (await coloured(page)) > 800, "the next frame");
  await done(/status of (4|5)\d\d/);
  await other.kill();
});

test("a failed run opens with what went wrong", async () => {
  const out = join(folder, "failed");
  spawnSync(program, ["run", join(root, "failures/inverted-element"), "--out", out, "--quiet", "--threads", "1"]);
  const other = await view(out);
  const { page, done } = await pageAt(other.address);
  await until(async () => /turned inside out/.test(await text(page, ".message.error")), "the error");
  assert.match(await text(page, ".message.error"), /E0601/);
  assert.match(await page.getByRole("tab", { selected: true }).textContent(), /Messages \(\d+\)/);
  await until(async () => (await coloured(page)) > 800, "the bodies");
  await done();
  await other.kill();
});

test("a wrong token is refused, by the server and in words by the page", async () => {
  const wrong = server.address.replace(TOKEN, "f".repeat(32));
  const answer = await fetch(`${wrong}api/runs`);
  assert.ok(answer.status >= 400 && answer.status < 500, String(answer.status));
  assert.ok(!(await answer.text()).includes("tube-plate"));
  const { page, done } = await pageAt(server.address);
  await page.route("**/api/runs", (route) => route.fulfill({ status: 403, contentType: "application/json", body: JSON.stringify({ code: "E1101", error: "wrong token" }) }));
  await page.reload();
  await page.locator(".fault-page h1").waitFor();
  assert.match(await text(page, ".fault-page h1"), /not valid any more/);
  await done(/403/);
});

test("another origin is refused", async () => {
  const answer = await fetch(`${server.address}api/runs`, { headers: { origin: "http://evil.example" } });
  assert.ok(answer.status >= 400 && answer.status < 500, String(answer.status));
  const page = await (await open()).newPage();
  await page.goto("data:text/html,<p>other</p>");
  const read = await page.evaluate((address) => fetch(address).then((a) => a.text(), () => "refused"), `${server.address}api/runs`);
  assert.ok(!read.includes("tube-plate"), read.slice(0, 200));
  await page.close();
});

test("without WebGL the page says so, and tables and plots work", async () => {
  const script = () => {
    const get = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
      return /webgl/.test(kind) ? null : get.call(this, kind, ...more);
    };
  };
  const { page, done } = await pageAt(server.address + "#tab=energy", { script });
  assert.match(await text(page, ".trouble"), /No picture/);
  assert.ok(await page.locator(".trouble").isVisible());
  await page.locator(".tab-body .u-over").first().waitFor();
  await key(page, "End");
  await until(async () => /101 of 101/.test(await frame(page)), "the end");
  await done(/WebGL/i);
});
