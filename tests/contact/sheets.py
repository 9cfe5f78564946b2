#!/usr/bin/env python3
"""Runs random scenes of free sheets, and counts by brute force where the middles of two sheets cross.

    python tests/contact/sheets.py --embate target/release/embate [--first 1] [--count 100] [--processes 2] [--keep FOLDER]

Two to eight sheets (flat, bent, folded, closed to tubes or boxes; quadrilaterals or triangles), deformable with thicknesses of 1/4 to 1/30
of an element, or all rigid down to 1/300, fly at each other from all sides, rigid ones with up to 20 thicknesses per step, and meet with
faces, rims and corners. What is not crossed at the start must never be. In each frame all edges of the middle of one sheet are cut with
all triangles of that of another; who went through as a whole between two frames is seen by the side: a node that is over a sheet in
both, farther from its rim than it has moved against it, is on the same side in both.

Verdicts: `held`, no two sheets cross; `told`, two do, and the run says so (`contact.unverified`, a warning of penetration, or it failed);
`silent`, it does not; `ended`, none cross, and the run failed; `late`, not finished within the limit; `refused`, the model was. Exit code 1 if
a run is silent.
"""

import argparse
import json
import math
import multiprocessing
import os
import pathlib
import subprocess
import sys
import tempfile

for variable in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(variable, "1")

import meshes  # noqa: E402  (numpy reads the number of threads when it is imported)
import numpy as np  # noqa: E402
import vtu  # noqa: E402
from interpenetration import TOLD  # noqa: E402
from overlap import cuts, units  # noqa: E402
from parts import Dice  # noqa: E402

VERDICTS = ["held", "told", "silent", "ended", "late", "refused"]
SIZE = 0.02
# Steps that a scene may need, about.
STEPS = 400
FRAMES = 40
# Young's modulus over density, m²/s²: waves of 100 m/s.
YOUNG, DENSITY, POISSON = 1e7, 1000.0, 0.3


def listed(values):
    return "[" + ", ".join(repr(float(x)) for x in values) + "]"


def shape(dice):
    """The text of a sheet's shape about the origin, and the size of its elements."""
    kind = dice.choice(["flat", "flat", "flat", "bent", "folded", "tube", "box"])
    n, m = dice.randint(1, 3), dice.randint(1, 3)
    half = 0.5 * SIZE
    depth = SIZE * dice.uniform(0.3, 1.0)
    extruded = f"extrude = {{ length = {depth!r}, elements = {m}, from = {-0.5 * depth!r} }}"
    if kind == "flat":
        if dice.random() < 0.3:
            size = SIZE / n
            corners = [[half * x, half * y] for x, y in [(-1, -1), (1, -1), (1, 1), (-1, 1)]]
            outline = "[" + ", ".join(listed(corner) for corner in corners[: dice.choice([3, 4])]) + "]"
            return f'element = "shell3", polygon = {{ outline = {outline}, size = {size!r} }}', 0.5 * size
        text = f"rectangle = {{ corner = [{-half!r}, {-0.5 * depth!r}], size = [{SIZE!r}, {depth!r}], elements = [{n}, {m}] }}"
        return f'element = "shell4", {text}', min(SIZE / n, depth / m)
    if kind == "bent":
        angle = dice.uniform(30, 250)
        text = f'arc = {{ centre = [0, 0], radius = {half!r}, from = 0, to = "{angle!r} deg", elements = {2 * n} }}, {extruded}'
        return f'element = "shell4", {text}', min(half * math.radians(angle) / (2 * n), depth / m)
    if kind == "folded":
        points = [[-half, 0.0], [0.0, half * dice.uniform(-1, 1)], [half, 0.0]]
        text = f"line = {{ points = [{', '.join(map(listed, points))}], elements = {2 * n} }}, {extruded}"
        return f'element = "shell4", {text}', min(half / n, depth / m)
    if kind == "tube":
        count = 3 * n
        text = f"arc = {{ centre = [0, 0], radius = {0.6 * half!r}, elements = {count} }}, {extruded}"
        return f'element = "shell4", {text}', min(0.6 * half * 2 * math.pi / count, depth / m)
    side = 0.6 * SIZE
    text = f"box = {{ corner = {listed([-0.5 * side] * 3)}, size = {listed([side] * 3)}, elements = [{n}, {n}, {m}] }}"
    return f'element = "shell4", {text}', side / max(n, m)


def scene(seed):
    """The model file of a seed."""
    dice = Dice(f"sheets {seed}")
    count = dice.choice([2, 2, 2, 3, 4, 8])
    some = dice.choice([0.0, 0.3, 1.0])
    is_rigid = [dice.random() < some for _ in range(count)]
    shapes = [shape(dice) for _ in range(count)]
    height = min(size for _, size in shapes)
    thickness = height * dice.order(1 / 300 if all(is_rigid) else 1 / 30, 1 / 4)
    # Of a thin plate, as the stable step sees it.
    step = 0.6 * height / math.sqrt(YOUNG / (DENSITY * (1 - POISSON**2)))
    # Deformable ones slower than waves, so that elements are left of what meets, and as fast as the steps suffice.
    travel = 2.5 * SIZE
    fastest = 20 * thickness / step if all(is_rigid) else min(20 * thickness / step, 0.06 * math.sqrt(YOUNG / DENSITY))
    speed = max(fastest * dice.order(0.05, 1.0), travel / (STEPS * step))
    parts = []
    for number, (text, _) in enumerate(shapes):
        # From corners of a cube, or from beyond a plane.
        side = np.array([number % 2, number // 2 % 2, number // 4]) * 2.0 - 1.0 if count > 2 else np.array([0, 0, 2.0 * number - 1])
        at = (0.95 if count > 2 else 0.65) * SIZE * side
        axis = [dice.gauss(0, 1) for _ in range(3)]
        angle = dice.choice([0.0, 90.0, dice.uniform(0, 180), dice.uniform(0, 180)])
        axis = dice.choice([[1.0, 0.0, 0.0], axis])
        aside = [dice.uniform(-0.3, 0.3) * SIZE for _ in range(3)] if count == 2 else [0.0] * 3
        aside[2] = 0.0
        velocity = -speed * units(side[None])[0] + speed * np.array([dice.uniform(-0.2, 0.2) for _ in range(3)])
        parts.append(
            f'  {{ name = "s{number}", material = "sheet", {text}, section = {{ thickness = {thickness!r}, points = 2 }}, '
            f'rotation = {{ angle = "{angle!r} deg", axis = {listed(axis)} }}, translation = {listed(at + aside)}, '
            f"velocity = {listed(velocity)}, rigid = {str(is_rigid[number]).lower()} }},"
        )
    friction = f", friction = {dice.uniform(0.05, 1.0)!r}" if dice.random() < 0.25 else ""
    lines = [
        f"run.end = {travel / speed!r}",
        *([f"run.time_step = {step!r}"] if all(is_rigid) else []),
        f'material.sheet = {{ law = "elastic", density = {DENSITY}, young = {YOUNG}, poisson = {POISSON} }}',
        "part = [",
        *parts,
        "]",
        f'contact = [{{ bodies = "all"{friction} }}]',
        f"output.fields = {FRAMES}",
        "output.history = 50",
        "output.pictures = false",
        'output.include = ["displacement"]',
        "",
    ]
    return "\n".join(lines)


class Sheets:
    """The middles of the sheets of a scene, as triangles around the middle of each element."""

    def __init__(self, cells, owners):
        """Of cells with the nodes of the lower face, then those of the upper one."""
        triangles, of_triangle, middles, fans, rims = [], [], {}, [], {}

        def middle(a, b):
            return middles.setdefault((a, b), len(middles))

        for cell, owner in zip(cells, owners):
            half = len(cell) // 2
            ring = [middle(a, b) for a, b in zip(cell[:half], cell[half:])]
            for a, b in zip(ring, ring[1:] + ring[:1]):
                rims.setdefault((min(a, b), max(a, b)), []).append(owner)
                triangles.append((a, b, len(fans)))
                of_triangle.append(owner)
            fans.append(ring)
        self.pairs = np.array(list(middles))
        self.fans = fans
        self.triangles, self.of_triangle = np.array(triangles), np.array(of_triangle)
        self.edges, self.of_edge = np.array(list(rims)), np.array([owners[0] for owners in rims.values()])
        self.is_rim = np.array([len(owners) == 1 for owners in rims.values()])
        self.of_node = np.zeros(len(self.pairs), dtype=int)
        self.of_node[self.edges.ravel()] = np.repeat(self.of_edge, 2)

    def place(self, points):
        """Positions of the middle nodes, and of the corners of the triangles (N, 3, 3)."""
        nodes = 0.5 * (points[self.pairs[:, 0]] + points[self.pairs[:, 1]])
        centres = np.array([nodes[ring].mean(axis=0) for ring in self.fans])
        corners = np.stack([nodes[self.triangles[:, 0]], nodes[self.triangles[:, 1]], centres[self.triangles[:, 2]]], axis=1)
        return nodes, corners

    def crossed(self, nodes, corners):
        """Pairs of sheets whose middles cross."""
        edge, facet, _ = cuts(nodes[self.edges], corners)
        pairs = np.stack([self.of_edge[edge], self.of_triangle[facet]], axis=1)
        return {tuple(sorted(pair)) for pair in pairs[pairs[:, 0] != pairs[:, 1]].tolist()}

    def over(self, nodes, corners):
        """Height of each node over each triangle that it is over; NaN where it is not."""
        a, e1, e2 = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        normal = np.cross(e1, e2)
        square = (normal * normal).sum(1)
        w = nodes[:, None] - a[None]
        height = (w * normal).sum(2) / np.sqrt(square)
        u = (np.cross(w, e2[None]) * normal).sum(2) / square
        v = (np.cross(e1[None], w) * normal).sum(2) / square
        return np.where((u >= 0) & (v >= 0) & (u + v <= 1), height, np.nan)

    def passed(self, before, after):
        """Pairs of sheets of which a node is over a triangle in two frames, on one side, then on the other, away from rims."""
        (old, old_corners), (new, new_corners) = before, after
        heights = self.over(old, old_corners), self.over(new, new_corners)
        found = set()
        flips = np.argwhere((heights[0] * heights[1] < 0) & (self.of_node[:, None] != self.of_triangle[None]))
        for node, facet in flips.tolist():
            sheet = self.of_triangle[facet]
            way = np.abs((new[node] - old[node]) - (new_corners[facet] - old_corners[facet])).sum(1).max()
            turn = np.abs((new_corners[facet] - old_corners[facet]) - (new_corners[facet] - old_corners[facet]).mean(0)).sum(1).max()
            rims = new[self.edges[self.is_rim & (self.of_edge == sheet)]]
            reach = abs(heights[0][node, facet]) + abs(heights[1][node, facet])
            if reach > 2.0 * (way + turn) or (len(rims) and gap(new[node], rims) < 2.0 * way):
                continue
            found.add(tuple(sorted((int(self.of_node[node]), int(sheet)))))
        return found


def gap(place, segments):
    """Distance of a place from segments."""
    a, d = segments[:, 0], segments[:, 1] - segments[:, 0]
    t = np.clip(((place - a) * d).sum(1) / (d * d).sum(1), 0, 1)
    return np.linalg.norm(a + t[:, None] * d - place, axis=1).min()


def look(out):
    """What crosses in the results of a run: for each pair of sheets the first frame, and whether in one or between two."""
    found, sheets, before = {}, None, None
    for number, path in enumerate(vtu.collection(out / "fields.pvd")):
        grid, points, cells = vtu.read(path)
        if sheets is None:
            owners = vtu.array(grid.GetCellData(), "part").ravel().tolist()
            sheets = Sheets([nodes for _, nodes in cells], owners)
        after = sheets.place(points)
        for pair in sheets.crossed(*after):
            found.setdefault(pair, (number, "crossed"))
        if before is not None:
            for pair in sheets.passed(before, after):
                found.setdefault(pair, (number, "passed"))
        before = after
    return found


def work(task):
    """Runs one scene and judges it."""
    seed, folder, options = task
    model, out = folder / f"sheets-{seed}.toml", folder / f"results-{seed}"
    model.write_text(scene(seed), encoding="utf-8")
    command = [str(options.embate), "run", str(model), "--threads", "1", "--quiet", "--force", "--out", str(out)]
    try:
        run = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, timeout=options.limit)
    except subprocess.TimeoutExpired:
        return seed, "late", {}, ""
    if not (out / "summary.json").exists():
        return seed, "refused", {}, next((line for line in run.stderr.splitlines() if line.strip()), "")
    summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
    found = look(out)
    first = {pair: frame for pair, frame in found.items() if frame[0] == 0}
    assert not first, f"sheets-{seed}: crossed at the start: {first}"
    says = summary["contact"]["unverified"] or any(TOLD.search(str(warning)) for warning in summary.get("warnings", []))
    failed = run.returncode != 0
    verdict = ("told" if says or failed else "silent") if found else ("ended" if failed else "held")
    note = f"steps {summary.get('steps')}, unverified {summary['contact']['unverified']}, drift {summary.get('energy_drift')}"
    return seed, verdict, found, f"{note} {summary.get('error') or ''}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--embate", required=True, type=pathlib.Path)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--limit", type=float, default=60.0, help="seconds for one run")
    parser.add_argument("--keep", type=pathlib.Path, help="keep models and results here")
    parser.add_argument("--verbose", action="store_true", help="a line for each run")
    options = parser.parse_args()
    options.embate = options.embate.resolve()
    with tempfile.TemporaryDirectory() as scratch:
        folder = options.keep or pathlib.Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        tasks = [(seed, folder, options) for seed in range(options.first, options.first + options.count)]
        results = []
        with multiprocessing.get_context("spawn").Pool(options.processes) as pool:
            for seed, verdict, found, note in pool.imap(work, tasks):
                results.append((verdict, found))
                if options.verbose or found or verdict in ("silent", "refused"):
                    pairs = "; ".join(f"{a} and {b} {how} in frame {frame}" for (a, b), (frame, how) in found.items())
                    print(f"sheets-{seed}: {verdict}: {note}; {pairs}", flush=True)
    counts = {verdict: sum(one == verdict for one, _ in results) for verdict in VERDICTS}
    print(f"{len(results)} scenes: " + ", ".join(f"{verdict} {count}" for verdict, count in counts.items() if count))
    return 1 if counts["silent"] else 0


if __name__ == "__main__":
    sys.exit(main())
