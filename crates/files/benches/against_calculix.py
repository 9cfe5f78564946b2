"""Runs of CalculiX and of embate from the same deck, in turns: processor time, and where both say that the bar's end is.

    apt-get install calculix-ccx        # or any other way to get ccx, version 2.20 or so
    python crates/files/benches/against_calculix.py --embate target/release/embate [--ccx ccx] [--sizes 4 8] [--rounds 3]

A quarter of a bar of steel, 10 x 10 x 100 mm, of n x n x 10 n elements C3D8, hits a wall with its end: elastic at 10 m/s, and elastic-plastic at 100 m/s; 40 us, `*DYNAMIC, EXPLICIT`, NLGEOM. What holds it are
conditions on nodes: contact is not compared. embate reads the deck by `embate import`; it takes `hex8` (eight points, mean dilatation), and with the deck's own default a bulk viscosity, which CalculiX has not. Each
takes the step that it chooses by itself, so the times per element and step are the fairer figures. One thread each; no pictures, fields at the end alone.
"""

import argparse
import csv
import json
import os
import statistics
import subprocess
import tempfile
from pathlib import Path

LENGTH, SIDE, END = 0.1, 0.01, 4e-5


def deck(n: int, plastic: bool) -> str:
    """The deck, without what it prints."""
    along = 10 * n
    number = lambda i, j, k: 1 + i + (along + 1) * (j + (n + 1) * k)
    lines = ["*HEADING", "a bar on a wall, SI", "*NODE, NSET=ALL"]
    for k in range(n + 1):
        for j in range(n + 1):
            lines += [f"{number(i, j, k)}, {LENGTH * i / along:.9g}, {SIDE * j / n:.9g}, {SIDE * k / n:.9g}" for i in range(along + 1)]
    lines.append("*ELEMENT, TYPE=C3D8, ELSET=BAR")
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    cells = [(i, j, k) for k in range(n) for j in range(n) for i in range(along)]
    lines += [f"{index}, " + ", ".join(str(number(i + a, j + b, k + c)) for a, b, c in corners) for index, (i, j, k) in enumerate(cells, 1)]

    def nodes(name: str, members: list[int]) -> None:
        lines.append(f"*NSET, NSET={name}")
        lines.extend(", ".join(map(str, members[at : at + 12])) + "," for at in range(0, len(members), 12))

    nodes("FOOT", [number(0, j, k) for k in range(n + 1) for j in range(n + 1)])
    nodes("YSYM", [number(i, 0, k) for k in range(n + 1) for i in range(along + 1)])
    nodes("ZSYM", [number(i, j, 0) for j in range(n + 1) for i in range(along + 1)])
    nodes("TIP", [number(along, 0, 0)])
    lines += ["*MATERIAL, NAME=STEEL", "*ELASTIC", "2.1E11, 0.3", *(["*PLASTIC", "2.5E8, 0.", "1.25E9, 1."] if plastic else []), "*DENSITY", "7800."]
    lines += ["*SOLID SECTION, ELSET=BAR, MATERIAL=STEEL", "*INITIAL CONDITIONS, TYPE=VELOCITY", f"ALL, 1, {-100 if plastic else -10}."]
    lines += ["*STEP, NLGEOM, INC=1000000", "*DYNAMIC, EXPLICIT", f"1.E-7, {END:g}", "*BOUNDARY", "FOOT, 1, 1", "YSYM, 2, 2", "ZSYM, 3, 3"]
    return "\n".join(lines) + "\n"


def printing(every: int) -> str:
    return f"*NODE PRINT, NSET=TIP, FREQUENCY={every}\nU\n*END STEP\n"


def timed(command: list[str], folder: Path) -> float:
    """User processor time of a command, s."""
    before = os.times().children_user
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, env=os.environ | {"OMP_NUM_THREADS": "1"}, timeout=3600)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(command)} failed:\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}")
    return os.times().children_user - before


def path_of_the_tip(folder: Path) -> list[tuple[float, float]]:
    """Times and displacements along the bar, as CalculiX prints them."""
    lines = (folder / "bar.dat").read_text().splitlines()
    return [(float(line.split()[-1]), float(lines[at + 2].split()[1])) for at, line in enumerate(lines) if "displacements" in line]


def at(path: list[tuple[float, float]], time: float) -> float:
    """A path at a time, between two of its points in proportion."""
    for (begin, first), (end, last) in zip(path, path[1:]):
        if begin <= time <= end:
            return first + (last - first) * (time - begin) / (end - begin)
    return path[-1][1]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--embate", type=Path, required=True)
    parser.add_argument("--ccx", default="ccx")
    parser.add_argument("--sizes", type=int, nargs="+", default=[4, 8])
    parser.add_argument("--rounds", type=int, default=3)
    arguments = parser.parse_args()
    embate = str(arguments.embate.resolve())
    version = subprocess.run([arguments.ccx, "-v"], capture_output=True, text=True).stdout.split()
    print(f"CalculiX {version[-1]}, {subprocess.run([embate, '--version'], capture_output=True, text=True).stdout.strip()}; user CPU, median of {arguments.rounds}")
    print("| model | elements | steps CalculiX, embate | user CPU CalculiX, embate, s | ratio | µs per element and step | ratio | end of the bar at 10, 20, 30, 40 µs, mm: CalculiX; embate |\n|---|---|---|---|---|---|---|---|")
    for plastic in (False, True):
        for n in arguments.sizes:
            with tempfile.TemporaryDirectory() as name:
                folder = Path(name)
                (folder / "bar.inp").write_text(deck(n, plastic) + printing(1))
                timed([arguments.ccx, "bar"], folder)
                path = [(0.0, 0.0), *path_of_the_tip(folder)]
                (folder / "bar.inp").write_text(deck(n, plastic) + printing(1_000_000))
                timed([embate, "import", "bar.inp", "--out", "model"], folder)
                quiet = ["--threads", "1", "--quiet", "--force", "--set", "output.pictures=false", "--set", "output.fields=1", "--set", 'probe=[{ name = "tip", set = "TIP" }]']
                times: dict[str, list[float]] = {"ccx": [], "embate": []}
                for _ in range(arguments.rounds):
                    times["ccx"].append(timed([arguments.ccx, "bar"], folder))
                    times["embate"].append(timed([embate, "run", "model", "--out", "out", *quiet], folder))
                summary = json.loads((folder / "out" / "summary.json").read_text())
                with open(folder / "out" / "history.csv", newline="") as file:
                    rows = list(csv.DictReader(file))
                own = [(float(row["time"]), float(row["tip.x"]) - LENGTH) for row in rows]
                elements, steps = 10 * n**3, (len(path) - 1, summary["steps"])
                seconds = [statistics.median(times["ccx"]), statistics.median(times["embate"])]
                each = [1e6 * second / (elements * count) for second, count in zip(seconds, steps)]
                places = ["; ".join(" ".join(f"{1e3 * at(points, time):.4f}" for time in (1e-5, 2e-5, 3e-5, END)) for points in (path, own))]
                print(
                    f"| {'plastic, 100 m/s' if plastic else 'elastic, 10 m/s'} | {elements:,} | {steps[0]}, {steps[1]} | {seconds[0]:.2f}, {seconds[1]:.3f} | {seconds[0] / seconds[1]:.0f} "
                    f"| {each[0]:.2f}, {each[1]:.3f} | {each[0] / each[1]:.0f} | {places[0]} |",
                    flush=True,
                )


if __name__ == "__main__":
    main()
