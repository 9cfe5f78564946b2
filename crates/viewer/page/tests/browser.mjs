// A headless Chromium for tests. CHROMIUM names it; otherwise /usr/bin/chromium. A page keeps what its
// console says, so that a test can demand that it says nothing.

import assert from "node:assert/strict";
import { basename, join } from "node:path";
import { chromium } from "playwright-core";

/** Seconds for what takes one or two, beside other tests some more. */
const PATIENCE = 40;

let browser = null;
export async function open() {
  browser ??= await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
  return browser;
}
export async function close() {
  await browser?.close();
  browser = null;
}

/** A page at an address, with a list of what went wrong in it. */
export async function pageAt(address, { width = 1280, height = 720, dark = false, touch = false, script = null, ready = true, permissions = [] } = {}) {
  const context = await (await open()).newContext({
    viewport: { width, height }, colorScheme: dark ? "dark" : "light", hasTouch: touch, acceptDownloads: true, reducedMotion: "reduce", permissions,
  });
  // BUNDLE: a folder whose files are tried in place of those in the program, while the page is written
  if (process.env.BUNDLE) {
    await context.route(/\/app\.(js|css)$/, (route) => route.fulfill({ path: join(process.env.BUNDLE, basename(new URL(route.request().url()).pathname)) }));
  }
  const page = await context.newPage();
  page.setDefaultTimeout(1000 * PATIENCE);
  const faults = [];
  page.on("console", (message) => {
    if (message.type() === "error" || message.type() === "warning") faults.push(message.text());
  });
  page.on("pageerror", (error) => faults.push(`${error.message}\n${error.stack}`));
  if (script) await page.addInitScript(script);
  await page.goto(address);
  if (ready) await page.waitForFunction(() => !document.querySelector(".timeline") || /frame|live/.test(document.querySelector(".frame-number")?.textContent ?? ""));
  return {
    page, faults, context,
    /** Closes it; what its console said must be nothing, but for what is expected. */
    async done(expected = /^$/) {
      await context.close();
      assert.deepEqual(faults.filter((fault) => !expected.test(fault)), [], "the console says something");
    },
  };
}

export async function until(test, what, seconds = PATIENCE) {
  const end = Date.now() + 1000 * seconds;
  for (;;) {
    const value = await test();
    if (value) return value;
    if (Date.now() > end) throw new Error(`waited ${seconds} s for: ${what}`);
    await new Promise((done) => setTimeout(done, 60));
  }
}

export const text = (page, selector) => page.locator(selector).first().textContent();
export const time = (page) => text(page, ".time");
export const frame = (page) => text(page, ".frame-number");
export const title = (page) => text(page, ".legend-title");
export const key = (page, name) => page.keyboard.press(name);

/** How many pixels of the picture differ from its corner: bodies are there. `box`: part of the canvas in the middle. */
export async function coloured(page, selector = ".pane canvas") {
  const png = await page.locator(selector).first().screenshot();
  return await page.evaluate(async (bytes) => {
    const image = await createImageBitmap(new Blob([new Uint8Array(bytes)], { type: "image/png" }));
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    const [x0, x1] = [Math.floor(0.15 * image.width), Math.floor(0.75 * image.width)];
    let count = 0;
    for (let y = 0; y < image.height; y++) {
      for (let x = x0; x < x1; x++) {
        const i = 4 * (y * image.width + x);
        const [r, g, b] = [data[i], data[i + 1], data[i + 2]];
        if (Math.max(r, g, b) - Math.min(r, g, b) > 40) count++;
      }
    }
    return count;
  }, [...png]);
}
