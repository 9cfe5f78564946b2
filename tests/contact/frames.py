#!/usr/bin/env python3
"""Runs random scenes of space as they are and turned, and compares their energies.

    python tests/contact/frames.py --embate target/release/embate [--count 4] [--friction 0.3] [--bound 1e-9] [--families bars,beams]

A turned scene has other coordinates, and its nodes, facets and edges have other numbers. What contact decides may hang on neither: kinetic
and internal energies in history.csv agree to the bound, as a share of the largest kinetic energy. Exit code 1 if one does not.
"""

import argparse
import csv
import pathlib
import subprocess
import sys
import tempfile

import meshes
import scenes

FAMILIES = "bars,beams,shards,wires,chain"
CELLS = 150
COLUMNS = ("energy.kinetic", "energy.internal")


def energies(embate, model, out):
    """The energies of a run, row by row."""
    command = [str(embate), "run", str(model), "--threads", "1", "--quiet", "--force", "--out", str(out)]
    subprocess.run([*command, "--set", "output.fields=2"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=120)
    with open(out / "history.csv", encoding="utf-8") as file:
        return [[float(row[column]) for column in COLUMNS] for row in csv.DictReader(file)]


def difference(embate, family, seed, friction, folder):
    """The largest difference of energies between a scene and the same turned."""
    rows = []
    for name, turn in (("as it is", None), ("turned", meshes.rotation((1, 2, 3), 0.7))):
        scene = scenes.make(family, seed, CELLS)
        scene.friction, scene.family = friction, f"{family}-{name.replace(' ', '-')}"
        if turn is not None:
            scene.turned(turn)
        rows.append(energies(embate, scene.write(folder), folder / "results"))
    largest = max(kinetic for kinetic, _ in rows[0])
    off = max(abs(a - b) for one, other in zip(*rows) for a, b in zip(one, other))
    return float("inf") if len(rows[0]) != len(rows[1]) else off / largest


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--embate", required=True, type=pathlib.Path)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--count", type=int, default=4)
    parser.add_argument("--friction", type=float, default=0.3)
    parser.add_argument("--bound", type=float, default=1e-9)
    parser.add_argument("--families", default=FAMILIES)
    options = parser.parse_args()
    bad = 0
    for family in options.families.split(","):
        for seed in range(options.first, options.first + options.count):
            with tempfile.TemporaryDirectory() as folder:
                off = difference(options.embate.resolve(), family, seed, options.friction, pathlib.Path(folder))
            bad += not off < options.bound
            print(f"{family}-{seed}: {off:.1e}{'' if off < options.bound else ' hangs on the frame'}", flush=True)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
