// Two runs side by side: linked time and cameras, one range of colours, both in the plots.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { close, coloured, key, pageAt, text, time, until } from "./browser.mjs";
import { endAll, results, view } from "./program.mjs";

let server;
before(async () => {
  server = await view([results("tube-plate", "one"), results("tube-plate", "two", "--set", "run.end=0.006")]);
});
after(async () => {
  await close();
  await endAll();
});

test("two runs stand side by side with one time, one camera and one range", async () => {
  const { page, done } = await pageAt(server.address + "#t=0.003&field=velocity");
  assert.equal(await page.locator(".pane canvas").count(), 2);
  await until(async () => (await coloured(page, ".pane:nth-child(1) canvas")) > 300 && (await coloured(page, ".pane:nth-child(2) canvas")) > 300, "both pictures");
  const marks = () => page.locator(".legend:not([hidden]) .legend-marks").allTextContents();
  await until(async () => (await marks()).length === 1, "one legend for both");
  await page.getByLabel("One range for both runs").uncheck();
  await until(async () => { const [a, b] = await marks(); return b !== undefined && a !== b; }, "each its own legend and range");
  // of runs that are the same until then the pictures are the same, also when one camera moves, but for the
  // width of a pixel; a camera that had not moved would show half as much
  await page.getByLabel("One range for both runs").check();
  await page.locator(".pane canvas").first().focus();
  for (let i = 0; i < 3; i++) await key(page, "+");
  await page.evaluate(() => document.activeElement.blur());
  await page.evaluate(() => document.querySelectorAll(".pane-title, .legend, .tools").forEach((e) => (e.style.visibility = "hidden")));
  await until(async () => {
    const [a, b] = await Promise.all([1, 2].map((i) => coloured(page, `.pane:nth-child(${i}) canvas`)));
    return a > 600 && Math.abs(a - b) < 0.05 * a;
  }, "both cameras moved");
  await done();
});

test("time goes on to the end of the longer run; the plots show both, the second dashed", async () => {
  const { page, done } = await pageAt(server.address + "#tab=energy");
  await key(page, "End");
  await until(async () => /^10\.0/.test(await time(page)), "the end of the longer run");
  await page.locator(".tab-body .plot-list").first().waitFor();
  await until(async () => {
    const names = await page.locator(".tab-body .plot-list .name").allTextContents();
    return names.includes("kinetic · A") && names.includes("kinetic · B");
  }, "energies of both runs");
  assert.ok((await page.locator(".tab-body .swatch.dashed").count()) >= 3);
  await page.getByRole("tab", { name: "Contacts" }).click();
  await until(async () => (await page.locator(".tab-body .plot-list .name").allTextContents()).includes("force y · B"), "forces of both");
  await done();
});

test("on a phone the two pictures are stacked", async () => {
  const { page, done } = await pageAt(server.address, { width: 390, height: 844, touch: true });
  const [a, b] = await Promise.all([0, 1].map((i) => page.locator(".pane").nth(i).boundingBox()));
  assert.ok(b.y >= a.y + a.height - 1 && Math.abs(a.width - b.width) < 1);
  assert.match(await text(page, ".pane-title"), /^A/);
  await done();
});

test("where one of two folders is no result, the other is shown and the fault is told", async () => {
  const other = await view([results("tube-plate", "good", "--set", "run.end=0.001"), "/nonexistent"]).catch((fault) => fault);
  if (other instanceof Error) {
    assert.match(other.message, /E\d{4}|nonexistent/); // refused by the program before there is a page
    return;
  }
  const { page, done } = await pageAt(other.address);
  assert.equal(await page.locator(".pane canvas").count(), 1);
  assert.match(await text(page, ".banner[role=alert]:not([hidden])"), /nonexistent can't be shown/);
  await done();
  await other.kill();
});
