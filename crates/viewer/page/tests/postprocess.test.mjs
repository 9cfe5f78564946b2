// The page as a post-processor, on a finished 3D run: sections, parts, distances, probes of elements and of
// nodes inside, several plots, averaged values, lines of equal value, glyphs, measurements.

import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { close, coloured, key, pageAt, text, title, until } from "./browser.mjs";
import { endAll, folder, results, view } from "./program.mjs";

let run;
let server;
let nodes;
before(async () => {
  run = results("taylor-bar-3d", "taylor", "--set", 'run.end="20 us"', "--set", 'output.fields="4 us"', "--set", "output.pictures=false");
  server = await view(run);
  nodes = (await json("api/runs/0")).nodes;
});
after(async () => {
  await close();
  await endAll();
});

const json = async (path) => await (await fetch(server.address + path)).json();
const picture = (page) => page.locator(".pane canvas").screenshot();
const said = (page, key) => new URLSearchParams(new URL(page.url()).hash.slice(1)).get(key);
const differs = async (page, before, what) => await until(async () => !(await picture(page)).equals(before), what);

/** A frame's container: head and arrays. */
async function frameOf(query) {
  const bytes = await (await fetch(`${server.address}api/runs/0/frames/5?${query}`)).arrayBuffer();
  const length = new DataView(bytes).getUint32(4, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 8, length)));
  const array = (name) => {
    const { type, offset, count } = head.arrays[name];
    return new { f32: Float32Array, u32: Uint32Array }[type](bytes, 8 + length + offset, count);
  };
  return { head, array };
}

test("the server cuts cells: area of the section, averaged values, glyphs", async () => {
  const { head, array } = await frameOf("scalar=velocity&section=0,0,1,0.02&glyphs=velocity");
  const [points, facets] = [array("section_points"), array("section_facets")];
  let area = 0;
  for (let f = 0; f < facets.length; f += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => [...points.subarray(3 * facets[f + k], 3 * facets[f + k] + 3)]);
    area += 0.5 * Math.abs((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]));
  }
  // a quarter of a circle of 3.2 mm, by facets that are chords
  assert.ok(Math.abs(area / (0.25 * Math.PI * 3.2e-3 ** 2) - 1) < 0.03, `${area} m²`);
  assert.equal(head.sections.length, 1);
  assert.equal(head.location, "node");
  assert.equal(array("section_values").length, points.length / 3);
  assert.equal(array("glyph_vectors").length, array("positions").length);
  const middles = array("section_nodes").filter((node) => node === 0xffffffff).length;
  assert.ok(middles > 4 && array("section_glyph_vectors").length === 3 * middles, `${middles} polygons`);
  const averaged = await frameOf("scalar=von_mises&averaged=1&glyphs=stress");
  assert.equal(averaged.head.location, "corner");
  assert.equal(averaged.array("glyph_axes").length, 3 * averaged.array("glyph_values").length);
  const bad = await fetch(`${server.address}api/runs/0/frames/5?section=0,0,0,1`);
  assert.equal(bad.status, 400);
  assert.match((await bad.json()).error, /is no plane: give nx,ny,nz,offset/);
});

test("a section is switched on by a key, moved by keys, slider, number and handle, and stands in the link", async () => {
  const { page, done } = await pageAt(server.address + "#t=2e-5&field=velocity");
  await until(async () => (await coloured(page)) > 800, "bodies");
  const whole = await picture(page);
  await key(page, "c");
  await until(() => said(page, "section") !== null, "the section in the link");
  await differs(page, whole, "the body cut");
  const first = said(page, "section").split(",").map(Number);
  assert.deepEqual(first.slice(0, 3).map(Math.abs).sort(), [0, 0, 1], "across an axis");
  await key(page, "]");
  await until(() => Number(said(page, "section").split(",")[3]) > first[3], "moved by a key");
  await page.getByRole("spinbutton", { name: "Place of the section, number" }).fill("1");
  await key(page, "Enter");
  await until(() => said(page, "section").endsWith(",0.001"), "1 mm by number");
  await page.getByRole("button", { name: "Other side" }).click();
  await until(() => said(page, "section").endsWith(",-0.001"), "the other side");
  await page.getByLabel("Plane", { exact: true }).selectOption("z");
  await until(() => said(page, "section").startsWith("0,0,1,"), "across z");
  const before = Number(said(page, "section").split(",")[3]);
  // the handle stands in the middle of the plane's outline: it is found by the cursor that it gives
  const handle = await until(() => handleAt(page, "grab"), "the handle");
  await page.mouse.move(handle.x, handle.y);
  await page.mouse.down();
  await page.mouse.move(handle.x, handle.y - 40, { steps: 5 });
  await page.mouse.up();
  await until(() => Number(said(page, "section").split(",")[3]) > before + 1e-4, "moved along z by the handle");
  assert.equal(await page.locator(".probe-list li").count(), 0, "a drag of the handle is no click");
  const tip = await until(() => handleAt(page, "move"), "the tip of the arrow");
  await page.mouse.move(tip.x, tip.y);
  await page.mouse.down();
  await page.mouse.move(tip.x + 30, tip.y, { steps: 5 });
  await page.mouse.up();
  await until(() => Math.abs(Number(said(page, "section").split(",")[0])) > 0.1, "tilted");
  const normal = said(page, "section").split(",").slice(0, 3).map(Number);
  assert.ok(Math.abs(Math.hypot(...normal) - 1) < 1e-6, "a unit normal");
  assert.equal(await page.getByLabel("Plane", { exact: true }).inputValue(), "free");
  const cut = await picture(page);
  const url = page.url();
  await done();
  const again = await pageAt(url);
  await until(async () => (await picture(again.page)).equals(cut), "the same picture by the link");
  await again.page.locator(".pane canvas").focus();
  await key(again.page, "c");
  await until(() => said(again.page, "section") === null, "no section");
  await again.done();
});

/** Where the cursor says that the plane can be moved. */
async function handleAt(page, cursor) {
  return await page.locator(".pane canvas").evaluate((canvas, cursor) => {
    const box = canvas.getBoundingClientRect();
    for (let y = 60; y < box.height - 60; y += 6) {
      for (let x = 100; x < box.width - 100; x += 6) {
        canvas.dispatchEvent(new PointerEvent("pointermove", { clientX: box.left + x, clientY: box.top + y }));
        if (canvas.style.cursor === cursor) return { x: box.left + x, y: box.top + y };
      }
    }
    return null;
  }, cursor);
}

test("a click on a cut face probes what is inside", async () => {
  const { page, done } = await pageAt(server.address + "#t=2e-5&field=von_mises&section=0,0,1,0.015&camera=0.001_0.001_1_0.001_0.001_0_0_1_0_0.006");
  await until(async () => (await coloured(page)) > 800, "the section from above");
  const box = await page.locator(".pane canvas").boundingBox();
  await page.mouse.click(box.x + 0.5 * box.width, box.y + 0.5 * box.height);
  await page.locator(".probe-list li").waitFor();
  const node = Number(/node (\d+)/.exec(await text(page, ".probe-list .name"))[1]);
  const { initial } = await json(`api/runs/0/track?node=${node}`);
  assert.ok(initial[0] > 1e-4 && initial[1] > 1e-4 && Math.hypot(initial[0], initial[1]) < 3e-3, `node ${node} at ${initial} lies inside`);
  await until(async () => /MPa/.test(await text(page, ".probe-list .value")), "its value");
  await done();
});

test("parts are hidden and shown alone by the menu, by keys and in the list", async () => {
  const { page, done } = await pageAt(server.address + "#t=1e-5&field=velocity");
  await until(async () => (await coloured(page)) > 800, "bodies");
  const box = await page.locator(".pane canvas").boundingBox();
  const [x, y] = [box.x + 0.5 * box.width, box.y + 0.5 * box.height];
  await page.mouse.click(x, y, { button: "right" });
  const menu = page.getByRole("menu");
  await menu.waitFor();
  for (const name of [/Probe node \d+/, /Probe element \d+/, /Measure from node \d+/, /Hide rod/, /Show only rod/]) assert.equal(await menu.getByRole("menuitem", { name }).count(), 1, String(name));
  await key(page, "ArrowDown");
  await key(page, "Escape");
  assert.equal(await menu.count(), 0);
  await page.mouse.click(x, y, { button: "right" });
  await menu.getByRole("menuitem", { name: "Hide rod" }).click();
  await until(async () => (await coloured(page)) < 50, "nothing is left");
  await until(() => said(page, "hidden") === "rod", "in the link");
  await page.mouse.click(x, y, { button: "right" });
  await menu.getByRole("menuitem", { name: "Show all parts" }).click();
  await until(async () => (await coloured(page)) > 800, "all is there");
  await page.mouse.move(x, y + 1);
  await key(page, "h");
  await until(() => said(page, "hidden") === "rod", "hidden by the key");
  await key(page, "H");
  await until(() => said(page, "hidden") === null, "shown by the key");
  await page.getByRole("tab", { name: "Parts" }).click();
  await page.getByRole("button", { name: "Show only rod" }).click();
  assert.equal(await page.getByRole("button", { name: "Show all" }).isDisabled(), true, "there is only one part");
  await done();
});

test("a distance of two nodes shows its components now, at the beginning and their change, and over time", async () => {
  const [a, b] = [0, nodes - 1];
  const { page, done } = await pageAt(server.address + `#t=2e-5&tab=probes&measure=0:${a}:${b}`);
  const [from, to] = [await json(`api/runs/0/track?node=${a}`), await json(`api/runs/0/track?node=${b}`)];
  const length = (p, q) => Math.hypot(...p.map((value, k) => q[k] - value));
  const [now, initial] = [length(from.positions.at(-1), to.positions.at(-1)), length(from.initial, to.initial)];
  const cells = async (row) => await page.locator(".measure tbody tr").nth(row).locator("td").allTextContents();
  await until(async () => (await page.locator(".measure tbody tr").count()) === 4, "the table");
  const near = (text, value) => assert.ok(Math.abs(Number(text.replace("−", "-")) * 1e-3 - value) < 1e-6 + 1e-4 * Math.abs(value), `${text} mm and ${value} m`);
  const [nowText, initialText, changeText] = await cells(0);
  near(nowText, now);
  near(initialText, initial);
  near(changeText, now - initial);
  const z = await cells(3);
  near(z[0], to.positions.at(-1)[2] - from.positions.at(-1)[2]);
  await page.locator(".measures .u-over").waitFor();
  await page.getByLabel("Plotted").selectOption("z");
  await until(async () => /along z/.test(await text(page, ".measures .plot h3")), "the component is plotted");
  // two clicks measure, too
  await key(page, "d");
  await until(async () => /first node/.test(await page.locator(".measures").textContent()), "what to do");
  const box = await page.locator(".pane canvas").boundingBox();
  await page.mouse.click(box.x + 0.5 * box.width, box.y + 0.45 * box.height);
  await until(async () => /second node/.test(await page.locator(".measures").textContent()), "the first node");
  await page.mouse.click(box.x + 0.5 * box.width, box.y + 0.6 * box.height);
  await until(async () => (await page.locator(".measure-list li").count()) === 2, "a second distance");
  await key(page, "Escape");
  await page.getByRole("button", { name: /Remove distance/ }).first().click();
  await until(async () => (await page.locator(".measure-list li").count()) === 1, "one is left");
  await until(() => /^0:\d+:\d+$/.test(said(page, "measure") ?? ""), "in the link");
  await done();
});

test("elements and nodes inside are probed over time, in several plots", async () => {
  const { page, done } = await pageAt(server.address + "#t=2e-5&tab=probes&field=von_mises");
  await page.getByLabel("Probe of a node or an element").selectOption("cell");
  await page.getByLabel("Element", { exact: true }).fill("100");
  await page.getByRole("button", { name: "Add" }).click();
  const wanted = (await json("api/runs/0/probe?scalar=von_mises&cell=100")).values.at(-1);
  await until(async () => Math.abs(parseFloat(await text(page, ".probe-list .value")) * 1e6 - wanted) < 2e-3 * wanted, "the element's stress");
  await page.getByLabel("Another plot").selectOption("velocity");
  await until(async () => (await page.locator(".tab-body .plot .u-over").count()) >= 2, "two plots");
  await until(() => said(page, "plots") === "velocity" && said(page, "probes") === "0:e100", "both in the link");
  await page.getByLabel("Element", { exact: true }).fill("999999");
  await page.getByRole("button", { name: "Add" }).click();
  assert.match(await text(page, ".fault-text"), /no element 999999: the numbers are 0 to \d+/);
  await page.getByRole("button", { name: "Remove plot" }).click();
  await until(() => said(page, "plots") === null, "the plot is gone");
  await done();
});

test("averaged values, lines of equal value, the undeformed shape and glyphs change the picture and stand in the link", async () => {
  const { page, done } = await pageAt(server.address + "#t=2e-5&field=von_mises");
  await until(async () => (await coloured(page)) > 800, "bodies");
  await until(async () => /MPa/.test(await title(page)), "the legend");
  const step = async (action, name, value) => {
    const before = await picture(page);
    await action();
    await until(() => said(page, name) === value, `${name} in the link`);
    if (value !== null) await differs(page, before, `another picture by ${name}`);
  };
  await step(() => page.getByLabel("Averaged at nodes").check(), "averaged", "1");
  await step(() => page.getByLabel("Lines of equal value").check(), "iso", "1");
  await step(() => page.getByLabel("Undeformed shape").check(), "undeformed", "1");
  await step(() => page.getByLabel("Field", { exact: true }).selectOption("velocity"), "glyphs", "velocity");
  await step(() => page.getByLabel("Field", { exact: true }).selectOption("stress"), "glyphs", "stress");
  await page.getByText(/red arrows outwards in tension/).waitFor();
  const url = page.url();
  const last = await picture(page);
  await done();
  const again = await pageAt(url);
  await until(async () => (await picture(again.page)).equals(last), "the same picture by the link");
  for (const [letter, name] of [["u", "undeformed"], ["i", "iso"], ["v", "averaged"]]) {
    await again.page.locator(".pane canvas").focus();
    await key(again.page, letter);
    await until(() => said(again.page, name) === null, `${name} off by the key ${letter}`);
  }
  await again.done();
});

test("measurements are compared with a plot in their units; what does not fit is refused in words", async () => {
  const { page, done } = await pageAt(server.address + "#t=2e-5&tab=probes&field=velocity&probes=0:0:0");
  const plot = page.locator(".tab-body .plot").first();
  await plot.locator(".u-over").waitFor();
  const file = async (name, content) => {
    const path = join(folder, name);
    writeFileSync(path, content);
    await plot.locator("input[type=file]").setInputFiles(path);
  };
  await file("speeds.csv", "# a gauge\ntime [us];speed [mm/ms]\n0;0\n10;100,5\n20;12,25\n");
  await until(async () => (await plot.locator(".plot-list li", { hasText: "measured: speed" }).count()) === 1, "the measured line");
  await until(async () => /^12\.25 m\/s$/.test(await plot.locator(".plot-list li", { hasText: "measured: speed" }).locator(".value").textContent()), "its value at this time");
  await file("force.csv", "time [s],force [kN]\n0,1\n1,2\n");
  await until(async () => /force\.csv: no column fits this plot, whose unit is m\/s: "force" is in kN/.test(await text(page, ".plot-said")), "the refusal");
  await file("words.csv", "time [s],speed\nnever,1\nalways,2\n");
  await until(async () => /no two rows have a number as their time/.test(await text(page, ".plot-said")), "no numbers");
  // dropped on the plot
  const data = await page.evaluateHandle(() => {
    const transfer = new DataTransfer();
    transfer.items.add(new File(["t,v\n0,1\n1e-5,2\n2e-5,3\n"], "dropped.csv"));
    return transfer;
  });
  await plot.dispatchEvent("drop", { dataTransfer: data });
  await until(async () => (await plot.locator(".plot-list li", { hasText: "measured: v" }).count()) === 1, "the dropped file");
  assert.match(await text(page, ".plot-said"), /The time has no unit: taken as s/);
  await page.getByRole("button", { name: "Remove speed" }).click();
  assert.equal(await plot.locator(".plot-list li", { hasText: "measured:" }).count(), 1);
  await done();
});

test("units of measurements are products and quotients with prefixes", async () => {
  const { page, done } = await pageAt(server.address + "#t=2e-5&tab=probes&field=von_mises&probes=0:e0");
  const plot = page.locator(".tab-body .plot").first();
  await plot.locator(".u-over").waitFor();
  for (const [unit, number, shown] of [["N/mm^2", 250, "250 MPa"], ["kN/cm²", 12, "120 MPa"], ["psi", 1e4, "68.95 MPa"], ["kg/(m", 1, null], ["J/m^3", 3e8, "300 MPa"]]) {
    const path = join(folder, "units.csv");
    writeFileSync(path, `time [us],s [${unit}]\n0,${number}\n1000,${number}\n`);
    await plot.locator("input[type=file]").setInputFiles(path);
    if (shown === null) {
      await until(async () => /has the unit kg\/\(m, which is not known/.test(await text(page, ".plot-said")), "an unknown unit");
      continue;
    }
    await until(async () => (await plot.locator(".plot-list li", { hasText: "measured: s" }).locator(".value").textContent().catch(() => "")) === shown, `${number} ${unit} is ${shown}`);
  }
  await done();
});

test("a section goes with a comparison of two runs, with mirror images, and with magnified displacements", async () => {
  const two = await view([run, run]);
  const { page, done } = await pageAt(`${two.address}#t=2e-5&field=velocity&mirror=110&scale=3&section=1,0.5,0,0.001`);
  await until(async () => (await coloured(page)) > 400, "bodies");
  const requested = await page.evaluate(() => performance.getEntriesByType("resource").map((entry) => entry.name).filter((name) => name.includes("section=")));
  assert.ok(requested.some((name) => name.includes("/runs/0/")) && requested.some((name) => name.includes("/runs/1/")));
  // two mirror planes across which the normal changes: four planes
  assert.equal(decodeURIComponent(requested[0]).split(";").length, 4);
  assert.match(requested[0], /scale=3/);
  await done();
  await two.kill();
});
