// Colour maps: tables of 256 colours in sRGB, for the picture (as a texture) and for the page's legend (as
// CSS colours). Each is kept as 33 colours at equal distances, between them straight. Sources: viridis by S.
// van der Walt and N. Smith (CC0), turbo by A. Mikhailov (Apache 2.0), coolwarm after K. Moreland (2009);
// grey leaves out the ends, which would be lost on the paper.

export type MapName = "viridis" | "turbo" | "grey" | "coolwarm";
export const MAP_NAMES: readonly MapName[] = ["viridis", "turbo", "coolwarm", "grey"];

/** Number of colours in a table. */
export const LEVELS = 256;

/** Bodies without a value, in the light and in the dark. */
export const NO_VALUE = { light: "#b2b8c0", dark: "#6b727d" } as const;

/** Paper behind the picture. */
export const BACKGROUND = { light: "#ffffff", dark: "#14171c" } as const;

const STOPS: Record<MapName, string> = {
  viridis:
    "440154470d6048186a482374472d7b4536814240863f49893b528b375a8d33638d2f6a8e2c728e297a8e26818e23898e21908c1f988b1f9f8821a685" +
    "28ae8031b57b3ebc744cc26c5dc9636ece5882d34c96d83fabdc32c0df24d5e21aeae51afde725",
  turbo:
    "30123b392a734040a14456c7466be3467ff64293ff37a7fa29bbec1dcdd818dcc31ee8b031f2994cf97e6bfd648aff4da3fd3cb8f735cced34dee037" +
    "edd03af8c03afdae35fe982cfb8022f56817ec520fe04009d23105c02302ac1701950d017a0403",
  coolwarm:
    "3b4cc0445acc4d68d75775e16282ea6c8ef1779af782a5fb8db0fe98b9ffa3c2feaec9fcb8d0f9c2d5f4ccd9eed5dbe6dddddde5d8d1ecd3c5f1ccb9" +
    "f4c4adf7bba0f7b194f7a687f49a7bf18d6fec7f63e57058de604dd55042cb3e38c0282fb40426",
  grey: "2a2a2af0f0f0",
};

const TABLES = new Map<MapName, Uint8Array>();

/** Red, green, blue, 255 for each of the 256 colours, low to high. */
export function table(map: MapName): Uint8Array {
  const known = TABLES.get(map);
  if (known !== undefined) return known;
  const text = STOPS[map] ?? STOPS.viridis;
  const last = text.length / 6 - 1;
  const stop = (i: number, k: number): number => parseInt(text.slice(6 * i + 2 * k, 6 * i + 2 * k + 2), 16);
  const made = new Uint8Array(4 * LEVELS);
  for (let i = 0; i < LEVELS; i++) {
    const place = (i / (LEVELS - 1)) * last;
    const before = Math.min(Math.floor(place), last - 1);
    for (let k = 0; k < 3; k++) {
      const from = stop(before, k);
      made[4 * i + k] = Math.round(from + (place - before) * (stop(before + 1, k) - from));
    }
    made[4 * i + 3] = 255;
  }
  TABLES.set(map, made);
  return made;
}

/** Row of the table for `t` from 0 (low) to 1 (high); `bands` = 0: continuous, otherwise as many equal steps. */
export function row(t: number, bands: number): number {
  let place = Math.min(Math.max(t, 0), 1);
  if (bands === 1) place = 0.5;
  else if (bands > 1) place = Math.min(Math.floor(place * bands), bands - 1) / (bands - 1);
  return Math.floor(place * (LEVELS - 1) + 0.5);
}

/** Colour of `t` from 0 to 1, as CSS writes it. */
export function colourAt(map: MapName, t: number, bands = 0): string {
  const i = 4 * row(t, bands);
  const colours = table(map);
  return `rgb(${colours[i]!}, ${colours[i + 1]!}, ${colours[i + 2]!})`;
}

/** A CSS gradient of the whole map, low to high, for legends: `direction` as in `to right`. */
export function gradient(map: MapName, direction: string, bands = 0): string {
  const stops: string[] = [];
  if (bands > 0) {
    for (let i = 0; i < bands; i++) {
      const colour = colourAt(map, (i + 0.5) / bands, bands);
      stops.push(`${colour} ${(100 * i) / bands}%`, `${colour} ${(100 * (i + 1)) / bands}%`);
    }
  } else {
    for (let i = 0; i <= 32; i++) stops.push(`${colourAt(map, i / 32)} ${(100 * i) / 32}%`);
  }
  return `linear-gradient(${direction}, ${stops.join(", ")})`;
}

// Colour-blind-safe set of Okabe and Ito (2008), without its yellow, which is lost on white.
const DISTINCT = [0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7, 0xe69f00, 0x56b4e9, 0x6e6e78];

/** Colour of part `index` where no scalar is shown: softened, so that mesh lines stay visible on it. */
export function partColour(index: number): [number, number, number] {
  const lighter = [0.3, 0.62, 0.05][Math.floor(index / DISTINCT.length) % 3]!;
  const base = DISTINCT[index % DISTINCT.length]!;
  const soft = (c: number): number => Math.round(c + (255 - c) * lighter);
  return [soft((base >> 16) & 255), soft((base >> 8) & 255), soft(base & 255)];
}
