// The page of a model before it runs: glyphs over the bodies, faults with their lines, and that it follows
// the file, within a second.

import assert from "node:assert/strict";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";
import { close, coloured, pageAt, text, until } from "./browser.mjs";
import { endAll, folder, view } from "./program.mjs";

after(async () => {
  await close();
  await endAll();
});

const MODEL = `
run = { end = "60 us" }
material.steel = { law = "elastic", density = 7800, young = "200 GPa", poisson = 0.3 }
part = [
    { name = "block", material = "steel", rectangle = { corner = [0, "20 mm"], size = [0.02, 0.01], elements = [40, 20] }, velocity = [0, "-5 m/s"] },
    { name = "plate", material = "steel", rectangle = { corner = [0, 0], size = [0.03, 0.0199], elements = [60, 20] } },
]
constraint = [{ on = "plate.bottom", fixed = ["x", "y"] }]
load = [{ on = "block.right", pressure = "1 MPa" }]
contact = [{ name = "hit", between = ["block.bottom", "plate.top"] }]
`;

/** Two blocks of so many cubes along x and y, and ten up. */
const cubes = (count, z) => `
run = { end = "0.1 ms" }
material.steel = { law = "elastic", density = 7800, young = "200 GPa", poisson = 0.3 }
part = [
    { name = "upper", material = "steel", box = { corner = [0, 0, ${z}], size = [0.1, 0.1, 0.02], elements = [${count}, ${count}, 10] }, velocity = [0, 0, -10] },
    { name = "lower", material = "steel", box = { corner = [0, 0, 0], size = [0.1, 0.1, 0.02], elements = [${count}, ${count}, 10] } },
]
constraint = [{ on = "lower.back", fixed = ["z"] }]
contact = [{ name = "all", bodies = "all" }]
`;

function written(name, model) {
  const own = join(folder, name);
  mkdirSync(own, { recursive: true });
  const file = join(own, "model.toml");
  writeFileSync(file, model);
  return { own, file };
}

/** Pixels of a colour in the picture. */
async function pixels(page, [r, g, b]) {
  return await page.evaluate(([r, g, b]) => {
    const canvas = document.querySelector(".pane canvas");
    if (canvas === null) return 0;
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    let count = 0;
    for (let i = 0; i < data.length; i += 4) if (data[i] === r && data[i + 1] === g && data[i + 2] === b) count += 1;
    return count;
  }, [r, g, b]);
}
const SUPPORT = [0, 105, 62];
const PRESSURE = [206, 60, 0];
const FAULT = [214, 20, 60];

test("a model is drawn with what acts on it, and each kind can be left out", async () => {
  const { own } = written("drawn", MODEL);
  const server = await view(own);
  const { page, done } = await pageAt(server.address, { ready: false });
  await until(async () => (await coloured(page)) > 800, "the bodies");
  await until(async () => (await pixels(page, SUPPORT)) > 200 && (await pixels(page, PRESSURE)) > 200, "glyphs");
  assert.equal(await page.getByRole("tab", { selected: true }).textContent(), "Model");
  assert.equal(await page.locator(".timeline").count(), 0);
  assert.deepEqual(await page.getByRole("tab").allTextContents(), ["Model", "View", "Probes", "Parts", "About"]);
  assert.match(await text(page, "table.model-parts"), /block.*800 quad4.*plate.*1\u202f200 quad4/s);
  await page.locator(".glyph-row", { hasText: "pressure" }).getByRole("checkbox").uncheck();
  await until(async () => (await pixels(page, PRESSURE)) === 0, "no pressure");
  assert.ok((await pixels(page, SUPPORT)) > 200);
  // What a glyph is stands where the pointer is.
  const box = await page.locator(".pane canvas").boundingBox();
  const at = await page.evaluate(([r, g, b]) => {
    const canvas = document.querySelector(".pane canvas");
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    for (let i = 0; i < data.length; i += 4) if (data[i] === r && data[i + 1] === g && data[i + 2] === b) return [(i / 4) % canvas.width, Math.floor(i / 4 / canvas.width)].map((v) => (v * canvas.clientWidth) / canvas.width);
    return null;
  }, SUPPORT);
  await page.mouse.move(box.x + at[0] + 2, box.y + at[1] + 2);
  await until(async () => /held: plate.bottom/.test(await text(page, ".glyph-tip")), "the name of what is there");
  assert.match(await text(page, ".glyph-tip"), /fixed = \["x", "y"\]/);
  await done(/Canvas2D/);
  await server.kill();
});

test("it follows the file: faults with their lines, a page of faults where nothing can be drawn, and the model again", async () => {
  const { own, file } = written("followed", MODEL);
  const server = await view(own);
  const { page, done } = await pageAt(server.address, { ready: false });
  await until(async () => (await pixels(page, SUPPORT)) > 200, "glyphs");
  const saved = async (model, what, test) => {
    const begin = Date.now();
    writeFileSync(file, model);
    // the page may be made again meanwhile
    await until(() => test().catch(() => false), what);
    return Date.now() - begin;
  };
  const faulty = await saved(MODEL.replace("plate.top", "plate.topp"), "the fault", async () => /model.toml:10:\d+/.test((await page.locator(".message.error").allTextContents()).join(" ")));
  await until(async () => (await pixels(page, FAULT)) > 40, "rings");
  assert.match(await page.getByRole("tab", { selected: true }).textContent(), /Model \(1\)/);
  const broken = await saved(`run = {${MODEL}`, "the page of faults", async () => (await page.locator(".fault-page h1").count()) === 1);
  const again = await saved(MODEL.replace("elements = [40, 20]", "elements = [20, 10]"), "the model", async () => /200 quad4/.test((await page.locator("table.model-parts").allTextContents()).join(" ")));
  console.log(`from the save to the page: a fault ${faulty} ms, a broken file ${broken} ms, a new mesh ${again} ms`);
  assert.ok(Math.max(faulty, broken, again) < 5000, `${faulty} ${broken} ${again}`);
  await done(/Canvas2D/);
  await server.kill();
});

/** When the picture is another one than now, by the clock. */
async function changed(page) {
  return await page.evaluate(() => new Promise((done) => {
    const seen = () => {
      const small = new OffscreenCanvas(160, 90).getContext("2d", { willReadFrequently: true });
      for (const canvas of document.querySelectorAll(".pane canvas")) small.drawImage(canvas, 0, 0, 160, 90);
      return small.getImageData(0, 0, 160, 90).data.reduce((sum, value, k) => (31 * sum + k * value) | 0, 0);
    };
    const first = seen();
    const look = () => (seen() === first ? setTimeout(look, 15) : done(Date.now()));
    look();
  }));
}

test("of many elements the new bodies are there before all was checked", async () => {
  const { own, file } = written("large", cubes(71, 0.0201));
  const server = await view(own);
  const { page, done } = await pageAt(server.address, { ready: false });
  await until(async () => /50\u202f410 hex8/.test((await page.locator("table.model-parts").allTextContents()).join(" ")), "the model", 60);
  const number = async () => (await (await fetch(`${server.address}api/runs/0`)).json()).frames[0].number;
  await until(async () => (await coloured(page)) > 800, "the bodies");
  const first = await number();
  const picture = changed(page);
  // The page has looked at its picture first.
  await page.evaluate(() => 0);
  const begin = Date.now();
  writeFileSync(file, cubes(71, 0.04));
  await until(async () => (await number()) > first, "new bodies", 60);
  const known = Date.now() - begin;
  const drawn = (await picture) - begin;
  await until(async () => (await (await fetch(`${server.address}api/model`)).json()).is_checked && (await number()) > first + 1, "all checked", 60);
  console.log(`100,820 elements: bodies ${known} ms after the save, in the picture ${drawn} ms, checked after ${Date.now() - begin} ms`);
  await done(/Canvas2D/);
  await server.kill();
});

test("nodes of a model are probed and measured before it runs", async () => {
  const { file } = written("measured", cubes(4, 0.03));
  const server = await view(file);
  const { page, done } = await pageAt(`${server.address}#tab=probes&measure=0:0:4`);
  await until(async () => (await page.locator(".measure tbody tr").count()) === 4, "the distance of two nodes");
  // four elements along 100 mm
  assert.match(await page.locator(".measure caption").textContent(), /^100 mm, change 0/);
  assert.equal(await page.locator(".measures .plot:visible").count(), 0, "nothing over time");
  await page.getByLabel("Node", { exact: true }).fill("3");
  await page.getByRole("button", { name: "Add" }).click();
  await until(async () => /node 3/.test(await page.locator(".probe-list").textContent()), "a probe");
  await done();
  await server.kill();
});
