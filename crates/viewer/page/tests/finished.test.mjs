// The page on a finished run: load, scrub, play, probe, quantity, link, keys, export, phone.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { close, coloured, frame, key, pageAt, text, time, title, until } from "./browser.mjs";
import { endAll, results, view } from "./program.mjs";

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

test("the page shows the bodies in colour, the legend with units, and the time", async () => {
  const { page, done } = await pageAt(server.address);
  await until(async () => (await coloured(page)) > 800, "bodies in the picture");
  assert.match(await page.title(), /tube-plate/);
  assert.match(await title(page), /plastic strain/);
  assert.match(await frame(page), /frame 1 of 101/);
  await done();
});

test("the scrubber moves the picture and the time", async () => {
  const { page, done } = await pageAt(server.address);
  await until(async () => (await coloured(page)) > 800, "bodies");
  const before = await page.locator(".pane canvas").screenshot();
  const box = await page.locator(".scrubber").boundingBox();
  await page.mouse.click(box.x + 0.8 * box.width, box.y + box.height / 2);
  assert.match(await time(page), /^(7|8)\.\d+ ms$/);
  await until(async () => !(await page.locator(".pane canvas").screenshot()).equals(before), "another picture");
  await key(page, "End");
  await until(async () => /frame 101 of 101/.test(await frame(page)), "the last frame");
  assert.equal(await time(page), "10.00 ms");
  await done();
});

test("playing goes through the frames to the end and stops there", async () => {
  const { page, done } = await pageAt(server.address + "#speed=4&t=0.008");
  let [going, most] = [0, 0];
  page.on("request", () => (most = Math.max(most, ++going)));
  page.on("requestfinished", () => going--);
  page.on("requestfailed", () => going--);
  await page.getByRole("button", { name: "Play" }).click();
  await page.getByRole("button", { name: "Pause" }).waitFor();
  await until(async () => /frame 101 of 101/.test(await frame(page)), "the end", 40);
  assert.ok(most <= 2, `${most} requests at a time`);
  await page.getByRole("button", { name: "Play" }).waitFor();
  await done();
});

test("a click on a node adds a probe with its value and its plot", async () => {
  const { page, done } = await pageAt(server.address + "#t=0.003&field=velocity");
  await until(async () => (await coloured(page)) > 800, "bodies");
  const at = await bodyPoint(page);
  await until(async () => {
    // it rests for a moment, again and again: a slow picture is not drawn for the readout alone
    await page.mouse.move(at.x + 0.5, at.y);
    await page.mouse.move(at.x, at.y);
    await page.waitForTimeout(400);
    return /^\S+ · node \d+ · element \d+ · [\d.]+ m\/s$/.test(await text(page, ".readout"));
  }, "the value under the mouse");
  await page.mouse.click(at.x, at.y);
  await page.locator(".probe-list li").waitFor();
  assert.match(await text(page, ".probe-list .name"), /node \d+/);
  await until(async () => /\d (m|mm|km)\/s/.test(await text(page, ".probe-list .value")), "its value");
  await page.locator(".tab-body .u-over").first().waitFor();
  await page.locator(".tab-body .plot-holder[aria-label*='Plot of velocity over time: node']").waitFor();
  // its value is that of the probe's history at this time
  const node = Number(/node (\d+)/.exec(await text(page, ".probe-list .name"))[1]);
  const probe = await fetch(`${server.address}api/runs/0/probe?scalar=velocity&node=${node}`).then((a) => a.json());
  const nearest = probe.times.reduce((best, t, i) => (Math.abs(t - 0.003) < Math.abs(probe.times[best] - 0.003) ? i : best), 0);
  assert.ok(Math.abs(parseFloat(await text(page, ".probe-list .value")) - probe.values[nearest]) < 0.002 * Math.abs(probe.values[nearest]) + 1e-3);
  // a click in the plot moves the time
  const plot = await page.locator(".tab-body .u-over").first().boundingBox();
  await page.mouse.click(plot.x + 0.9 * plot.width, plot.y + plot.height / 2);
  await until(async () => /^[89]\.\d+ ms/.test(await time(page)), "time of the click in the plot");
  await page.getByRole("button", { name: /Remove probe/ }).click();
  await until(async () => (await page.locator(".probe-list li").count()) === 0, "the probe is gone");
  await done();
});

test("a probe is added by a node's number; a number that is none is refused in words", async () => {
  const { page, done } = await pageAt(server.address + "#tab=probes&field=von_mises&t=0.002");
  await page.getByLabel("Node", { exact: true }).fill("99999");
  await page.getByRole("button", { name: "Add" }).click();
  assert.match(await text(page, ".tab-body .fault-text"), /no node 99999/);
  await page.getByLabel("Node", { exact: true }).fill("30");
  await page.getByRole("button", { name: "Add" }).click();
  await until(async () => /[GMk]Pa \(element \d+\)/.test(await text(page, ".probe-list .value")), "the element's stress");
  await done();
});

test("another quantity changes legend, unit and picture", async () => {
  const { page, done } = await pageAt(server.address + "#t=0.004");
  await until(async () => (await coloured(page)) > 800, "bodies");
  await page.getByLabel("Quantity shown").selectOption("von_mises");
  await until(async () => /^von Mises stress \/ [MG]Pa$/.test(await title(page)), "the legend of stress in MPa or GPa");
  await page.getByLabel("Quantity shown").selectOption("displacement");
  await until(async () => /displacement \/ mm/.test(await title(page)), "the legend of displacement in mm");
  await page.getByLabel("Quantity shown").selectOption("contact_status");
  await until(async () => /stick/.test(await page.locator(".legend-marks").textContent()), "names of states");
  await done();
});

test("own numbers of the range stand in legend and link; a range upside down is refused", async () => {
  const { page, done } = await pageAt(server.address + "#field=velocity&t=0.004");
  await until(async () => /velocity \/ m\/s/.test(await title(page)), "legend");
  await page.getByLabel("Upper end of the range").fill("60");
  await page.keyboard.press("Tab");
  await until(async () => (await page.locator(".legend-marks span").last().textContent()) === "60", "the legend ends at 60 m/s");
  assert.equal(await page.getByLabel("Range", { exact: true }).inputValue(), "own");
  await page.getByLabel("Lower end of the range").fill("900");
  await page.keyboard.press("Tab");
  await until(async () => /below/.test(await text(page, ".fault-text")), "the refusal");
  await until(() => /range=0,60(&|$)/.test(page.url()), "range in the link");
  await done();
});

test("a link restores field, time, probes, mesh lines, hidden parts, camera, tab and theme", async () => {
  const first = await pageAt(server.address);
  const { page } = first;
  await until(async () => (await coloured(page)) > 800, "bodies");
  await page.getByLabel("Quantity shown").selectOption("velocity.y");
  await key(page, "m");
  await page.locator(".pane canvas").focus();
  for (let i = 0; i < 3; i++) await key(page, "+");
  await key(page, "ArrowLeft");
  await key(page, "t");
  await page.getByRole("tab", { name: "Parts" }).click();
  await page.getByLabel("Show part plate").uncheck();
  await page.locator(".scrubber").focus();
  for (let i = 0; i < 7; i++) await key(page, "ArrowRight");
  await until(() => /t=/.test(page.url()) && /hidden=plate/.test(page.url()) && /camera=/.test(page.url()), "the address");
  await page.waitForTimeout(400);
  const url = page.url();
  const now = await time(page);
  const picture = await page.locator(".stage").screenshot();
  await first.done();

  const again = await pageAt(url);
  assert.equal(await time(again.page), now);
  await until(async () => /velocity y/.test(await title(again.page)), "the legend of velocity y");
  assert.equal(await again.page.getByLabel("Quantity shown").inputValue(), "velocity.y");
  assert.equal(await again.page.locator("html").getAttribute("data-theme"), "dark");
  assert.equal(await again.page.getByLabel("Show part plate").isChecked(), false);
  assert.equal(await again.page.getByRole("button", { name: "Mesh lines" }).getAttribute("aria-pressed"), "false");
  await until(async () => (await again.page.locator(".stage").screenshot()).equals(picture), "the same picture, pixel by pixel");
  assert.equal(again.page.url(), url);
  await again.done();
});

test("`--view` gives the view with which the page opens", async () => {
  const other = await view([run, "--view", "field=von_mises&t=0.005"]);
  const { page, done } = await pageAt(other.address);
  await until(async () => /[MG]Pa/.test(await title(page)), "legend of stress");
  assert.match(await time(page), /^5\.00/);
  await done();
  await other.kill();
});

test("everything works by keys alone", async () => {
  const { page, done } = await pageAt(server.address);
  await until(async () => (await coloured(page)) > 800, "bodies");
  await key(page, "ArrowRight");
  await until(async () => /frame 2 of/.test(await frame(page)), "the next frame");
  await key(page, "End");
  await until(async () => /frame 101 of/.test(await frame(page)), "the last");
  await key(page, "Home");
  await key(page, " ");
  await page.getByRole("button", { name: "Pause" }).waitFor();
  await key(page, " ");
  await page.getByRole("button", { name: "Play" }).waitFor();
  const before = await title(page);
  await key(page, "n");
  await until(async () => (await title(page)) !== before, "the next quantity");
  await key(page, "?");
  await page.getByRole("dialog").waitFor();
  await key(page, "Escape");
  assert.equal(await page.getByRole("dialog").count(), 0);
  await key(page, "p");
  await until(async () => (await page.evaluate(() => document.activeElement.id)) === "probe-node", "the field for a node's number");
  await page.keyboard.type("12");
  await key(page, "Enter");
  await page.locator(".probe-list li").waitFor();
  // Tab reaches each control once, and each shows its focus
  await page.evaluate(() => document.activeElement.blur());
  const seen = new Set();
  for (let i = 0; i < 80; i++) {
    await key(page, "Tab");
    const at = await page.evaluate(() => {
      const e = document.activeElement;
      if (e === document.body) return null;
      const style = getComputedStyle(e);
      return { name: e.getAttribute("aria-label") ?? e.textContent ?? e.id, tag: e.tagName, outline: style.outlineStyle !== "none" && parseFloat(style.outlineWidth) >= 2 };
    });
    if (at === null) continue;
    assert.ok(at.outline, `focus is not seen on ${JSON.stringify(at)}`);
    seen.add(`${at.tag} ${at.name}`);
  }
  for (const name of ["Export", "Copy link", "Help", "Fit", "Mesh lines", "Time", "Play", "Speed", "Loop"]) assert.ok([...seen].some((s) => s.endsWith(` ${name}`)), `Tab does not reach ${name}: ${[...seen].join(", ")}`);
  assert.ok([...seen].some((s) => s.startsWith("CANVAS")));
  await done();
});

test("controls have names, fields have labels, tabs their roles, in all panels", async () => {
  const { page, done } = await pageAt(server.address + "#t=0.001&probes=0:10:5");
  for (const tab of ["View", "Energy", "Contacts", "Probes", "Parts", "Messages", "About"]) {
    await page.getByRole("tab", { name: tab }).click();
    const bad = await page.evaluate(() => {
      const name = (e) => (e.getAttribute("aria-label") ?? [...(e.labels ?? [])].map((l) => l.textContent).join("")) || (e.tagName === "BUTTON" ? e.textContent : "");
      const ids = [...document.querySelectorAll("[id]")].map((e) => e.id);
      return [
        ...[...document.querySelectorAll("button, input, select, .pane canvas, progress")].filter((e) => name(e).trim() === "").map((e) => e.outerHTML),
        ...ids.filter((id, i) => ids.indexOf(id) !== i).map((id) => `two elements have the id ${id}`),
        ...[...document.querySelectorAll("[aria-controls],[aria-labelledby]")].filter((e) => !document.getElementById(e.getAttribute("aria-controls") ?? e.getAttribute("aria-labelledby"))).map((e) => `points nowhere: ${e.outerHTML.slice(0, 100)}`),
      ];
    });
    assert.deepEqual(bad, [], tab);
    await until(async () => (await page.getByRole("tab", { selected: true }).textContent()).startsWith(tab), `tab ${tab} is selected`);
  }
  assert.equal(await page.locator("main").count(), 1);
  assert.equal(await page.locator("h1").count(), 1);
  await done();
});

test("energies, contacts and parts are those of the history", async () => {
  const { page, done } = await pageAt(server.address + "#tab=energy");
  const lines = readFileSync(join(run, "history.csv"), "utf8").trim().split("\n").map((line) => line.split(","));
  const column = (name) => Number(lines.at(-1)[lines[0].indexOf(name)]);
  await key(page, "End");
  await page.locator(".plot-list").first().waitFor();
  const shown = async (name) => {
    const value = await page.locator(".tab-body .plot-list li", { hasText: name }).first().locator(".value").textContent();
    const [number, unit] = value.replace("−", "-").split(" ");
    return Number(number) * ({ k: 1e3, M: 1e6, m: 1e-3 }[unit.length > 3 ? unit[0] : ""] ?? 1);
  };
  const near = (a, b) => assert.ok(Math.abs(a - b) <= 2e-3 * Math.abs(b), `${a} and ${b}`);
  await until(async () => /^10\.00/.test(await time(page)) && (await shown("kinetic")) < 1e4, "values of the end");
  near(await shown("kinetic"), column("energy.kinetic"));
  near(await shown("elastic"), column("energy.internal") - column("energy.plastic"));
  near(await shown("total"), column("energy.total"));
  await page.getByRole("tab", { name: "Contacts" }).click();
  await page.getByLabel("Between").waitFor();
  assert.match(await page.getByLabel("Between").textContent(), /impact/);
  assert.match(await page.getByLabel("Between").textContent(), /wall/);
  await page.getByRole("tab", { name: "Parts" }).click();
  await until(async () => (await page.locator(".tab-body tbody tr").count()) === 2, "a row for each part");
  await until(async () => /J\/m/.test(await text(page, ".tab-body tbody tr td:last-child")), "energies of the parts");
  await done();
});

test("a picture, the values of a plot and a film can be saved, and have content", async () => {
  const { page, done } = await pageAt(server.address + "#tab=energy&t=0.004");
  await until(async () => (await coloured(page)) > 800, "bodies");
  const [png] = await Promise.all([page.waitForEvent("download"), key(page, "s")]);
  assert.match(png.suggestedFilename(), /^tube-plate.*\.png$/);
  const bytes = readFileSync(await png.path());
  const canvas = await page.locator(".pane canvas").boundingBox();
  assert.equal(bytes.readUInt32BE(16), 2 * Math.round(canvas.width), "twice the width");
  const colours = await page.evaluate(async (base64) => {
    const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${base64}`).catch(() => null))?.blob?.() ?? new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))]));
    const c = new OffscreenCanvas(image.width, image.height).getContext("2d");
    c.drawImage(image, 0, 0);
    const { data } = c.getImageData(0, 0, Math.floor(0.7 * image.width), image.height);
    const set = new Set();
    let bright = 0;
    for (let i = 0; i < data.length; i += 4) {
      set.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
      if (Math.max(data[i], data[i + 1], data[i + 2]) - Math.min(data[i], data[i + 1], data[i + 2]) > 40) bright++;
    }
    return { different: set.size, bright };
  }, bytes.toString("base64"));
  assert.ok(colours.bright > 5000 && colours.different > 50, JSON.stringify(colours));

  await page.getByRole("button", { name: "Export" }).click();
  const [csv] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Save values" }).click()]);
  const lines = readFileSync(await csv.path(), "utf8").trim().split("\n");
  assert.match(lines[0], /^time \[s\],kinetic \[J\/m\],elastic/);
  assert.ok(lines.length > 500);

  // every format that this browser records begins with its mark
  const formats = await page.getByLabel("Format").locator("option").evaluateAll((options) => options.map((option) => option.value)).catch(() => []);
  const marks = { mp4: (film) => film.toString("latin1", 4, 8) === "ftyp", webm: (film) => film.readUInt32BE(0) === 0x1a45dfa3 };
  await page.getByLabel("Length").selectOption("3");
  for (const format of formats.length > 0 ? formats : ["webm"]) {
    if (formats.length > 0) await page.getByLabel("Format").selectOption(format);
    const [saved] = await Promise.all([page.waitForEvent("download", { timeout: 90_000 }), page.getByRole("button", { name: "Record film" }).click()]);
    assert.equal(saved.suggestedFilename().split(".").at(-1), format);
    const film = readFileSync(await saved.path());
    assert.ok(marks[format](film), `the mark of ${format}`);
    assert.ok(film.length > 20_000, `${film.length} bytes`);
    await page.getByText("Film saved.").waitFor();
  }
  assert.equal(await page.getByText("Film saved.").count(), 1);
  await key(page, "Escape");
  assert.match(await time(page), /^4\.00/);
  await done(/CSP|Content Security Policy|data:image/);
});

test("on a phone everything is there and nothing lies beside the screen", async () => {
  const { page, done } = await pageAt(server.address + "#t=0.002", { width: 390, height: 844, touch: true });
  await until(async () => (await coloured(page)) > 500, "bodies");
  for (const tab of ["View", "Energy", "Contacts", "Probes", "Parts", "Messages", "About"]) {
    await page.getByRole("tab", { name: tab }).click();
    const wide = await page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.scrollHeight, document.querySelector(".tab-body").scrollWidth - document.querySelector(".tab-body").clientWidth]);
    assert.ok(wide[0] <= 390 && wide[1] <= 844 && wide[2] <= 0, `${tab}: ${wide}`);
  }
  const boxes = await page.evaluate(() => Object.fromEntries([".stage", ".timeline", ".panel"].map((s) => [s, document.querySelector(s).getBoundingClientRect().toJSON()])));
  assert.ok(boxes[".stage"].bottom <= boxes[".timeline"].top + 1 && boxes[".timeline"].bottom <= boxes[".panel"].top + 1, "the panel stands below the picture");
  assert.ok(boxes[".stage"].height > 200);
  await done();
});

/** A point of the picture on a body: a coloured one. */
async function bodyPoint(page) {
  const box = await page.locator(".pane canvas").boundingBox();
  const png = await page.locator(".pane canvas").screenshot();
  const at = await page.evaluate(async (base64) => {
    const image = await createImageBitmap(new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], { type: "image/png" }));
    const c = new OffscreenCanvas(image.width, image.height).getContext("2d");
    c.drawImage(image, 0, 0);
    const { data } = c.getImageData(0, 0, image.width, image.height);
    const vivid = (x, y) => {
      const i = 4 * (y * image.width + x);
      return Math.max(data[i], data[i + 1], data[i + 2]) - Math.min(data[i], data[i + 1], data[i + 2]) > 40;
    };
    for (let y = 100; y < image.height - 40; y++) {
      for (let x = 120; x < 0.7 * image.width; x++) if (vivid(x, y) && vivid(x + 2, y) && vivid(x - 2, y) && vivid(x, y + 2) && vivid(x, y - 2)) return { x, y };
    }
    return null;
  }, png.toString("base64"));
  assert.ok(at, "no body in the picture");
  return { x: box.x + at.x, y: box.y + at.y };
}
