// Contrast of the page's colours, computed from theme.css by the formula of WCAG 2: 4.5 for text, 3 for what
// is only seen.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

const css = readFileSync(new URL("../src/app/theme.css", import.meta.url), "utf8");
const colours = readFileSync(new URL("../src/app/colours.ts", import.meta.url), "utf8");

function theme(name) {
  const block = new RegExp(`data-theme="${name}"\\] \\{([^}]*)\\}`).exec(css)[1];
  return Object.fromEntries([...block.matchAll(/--([\w-]+): (#[0-9a-f]{6})/g)].map((m) => [m[1], m[2]]));
}
function luminance(hex) {
  const [r, g, b] = [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255).map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}
function contrast(a, b) {
  const [high, low] = [luminance(a), luminance(b)].sort((x, y) => y - x);
  return (high + 0.05) / (low + 0.05);
}
const TEXT = [
  ["ink", "paper"], ["ink", "panel"], ["ink", "raised"], ["ink", "accent-soft"], ["ink-soft", "paper"], ["ink-soft", "panel"], ["ink-soft", "raised"], ["accent", "panel"], ["accent", "accent-soft"],
  ["on-accent", "accent"], ["danger", "panel"], ["danger", "paper"], ["on-danger", "danger"], ["on-banner", "banner"], ["good", "panel"], ["paper", "ink"],
];
const SEEN = [["line", "panel"], ["line", "paper"], ["line", "raised"], ["focus", "panel"], ["focus", "paper"], ["accent", "line-soft"]];

for (const name of ["light", "dark"]) {
  test(`text has contrast 4.5 and controls 3 in the ${name} theme`, () => {
    const set = theme(name);
    for (const [pairs, least] of [[TEXT, 4.5], [SEEN, 3]]) {
      for (const [a, b] of pairs) assert.ok(contrast(set[a], set[b]) >= least, `${a} on ${b}: ${contrast(set[a], set[b]).toFixed(2)} < ${least}`);
    }
  });
  test(`lines of plots and marks of probes have contrast 3 in the ${name} theme`, () => {
    const { panel, paper } = theme(name);
    const hexes = [...new Set([...colours.matchAll(/#[0-9a-f]{6}/g)].map((m) => m[0]))];
    assert.ok(hexes.length > 10);
    for (const hex of hexes) for (const on of [panel, paper]) assert.ok(contrast(hex, on) >= 3, `${hex} on ${on}: ${contrast(hex, on).toFixed(2)}`);
  });
}

test("the formula itself: black on white is 21", () => assert.ok(Math.abs(contrast("#000000", "#ffffff") - 21) < 1e-9));
