// What frames are to hold under the present view, and how requests write it.

import type { Run, Vector } from "../types";
import { imageSigns } from "../viewport/stage";
import type { SectionPlane } from "../viewport/viewport";
import type { View } from "./view";

export interface Wish {
  scalar: string | null;
  averaged: boolean;
  arrows: boolean;
  glyphs: string | null;
  /** Planes as `nx,ny,nz,offset` with `;` between them: each mirror image may be cut by another one. */
  section: string | null;
  scale: number;
}

const short = (value: number): string => String(Number(value.toPrecision(9)));

/** A plane as requests and links write it. */
export function planeText({ normal, offset }: SectionPlane): string {
  return [...normal, offset].map(short).join(",");
}

/** The planes that cut the model itself so that it and its mirror images are cut by one plane. */
export function planesOf(plane: SectionPlane, mirror: readonly boolean[]): SectionPlane[] {
  const planes: SectionPlane[] = [];
  for (const sign of imageSigns(mirror)) {
    const normal = plane.normal.map((n, k) => n * sign[k]! + 0) as Vector;
    if (!planes.some((known) => known.normal.every((n, k) => n === normal[k]))) planes.push({ normal, offset: plane.offset });
  }
  return planes;
}

/** Fields of which glyphs can be drawn: vectors of nodes, symmetric tensors of elements. */
export function glyphFields(run: Run): { key: string; label: string; kind: "vectors" | "tensors" }[] {
  return run.scalars.flatMap(({ key, label, location }) => {
    const [field, component] = key.split(".");
    const kind = component === "x" && location === "node" ? ("vectors" as const) : component === "xx" && location === "cell" ? ("tensors" as const) : null;
    if (kind === null || field === "contact_force") return [];
    const name = label.replace(/ xx?$/, "");
    return [{ key: field!, kind, label: kind === "tensors" ? `principal values of ${name}` : name }];
  });
}

export function wishOf(view: View, run: Run): Wish {
  const { picture } = view;
  const scalar = run.scalars.find(({ key }) => key === view.scalar) ?? null;
  const planes = picture.section === null || run.dimension !== 3 ? [] : planesOf(picture.section, picture.mirror);
  return {
    scalar: scalar?.key ?? null,
    averaged: isAveraged(view, run),
    arrows: picture.arrows && run.has_arrows,
    glyphs: glyphFields(run).some(({ key }) => key === picture.glyphs) ? picture.glyphs : null,
    section: planes.length > 0 ? planes.map(planeText).join(";") : null,
    scale: planes.length > 0 ? picture.scale : 1,
  };
}

/** Whether values of elements are shown averaged: as wanted, and for lines of equal value. */
export function isAveraged(view: View, run: Run): boolean {
  const scalar = run.scalars.find(({ key }) => key === view.scalar);
  return scalar?.location === "cell" && scalar.states.length === 0 && (view.picture.averaged || view.picture.iso);
}

/** The part of an address behind `?`. */
export function queryOf(wish: Wish): string {
  const query = new URLSearchParams();
  if (wish.scalar !== null) query.set("scalar", wish.scalar);
  if (wish.averaged) query.set("averaged", "1");
  if (wish.arrows) query.set("arrows", "1");
  if (wish.glyphs !== null) query.set("glyphs", wish.glyphs);
  if (wish.section !== null) query.set("section", wish.section);
  if (wish.scale !== 1) query.set("scale", short(wish.scale));
  return String(query);
}
