"""The global search against the broad phases of the PyPI package `ipctk`, in the plane: same geometry, same run.

    pip install ipctk numpy
    python crates/solver/benches/against_ipctk.py [--sizes 1000 10000 100000] [--rounds 5] [--slow]

Writes each geometry to a temporary folder, runs `cargo bench --bench against_ipctk` on it and every broad phase of ipctk in this process, in
turns, and prints two tables. All nodes are searched against all segments, on surfaces with themselves, for one step in which the
fastest node moves by a hundredth of the skin.

First table: one build, with new objects each time, for pairs within a quarter of the mean segment. ipctk inflates both boxes of a pair, so it
gets half of this. Only `Candidates.build` is timed, not the way of its result to Python. `fresh` and `kept` are embate: with a new object each
time, and with one for all. The last columns are the wall time over that of `fresh` with as many threads, least by least and median by median;
`cpu` is the time of all threads.

Second table: a run of a thousand steps. embate searches when a node has moved by half the skin and looks in between whether one has; ipctk
builds in each step, for what one step can bring together, by the method that was fastest in the first table (median of some of the steps).
embate has one thread.

Before that, at a thousand segments: both find every pair that brute force finds.
"""

import argparse
import os
import subprocess
import tempfile
import time
from math import pi

import ipctk
import numpy as np

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..")
STEPS = 1000
# Motion of the fastest node in a step, over the skin.
PARTS = (1e-3, 1e-2)


def waves(n):
    """Two long wavy chains face to face."""
    m = n // 2

    def chain(lift, shift):
        s = (np.arange(m + 1) + shift) * 0.9
        return np.stack([s, lift + 20 * np.sin(s / 30)], 1)

    i = np.arange(m)
    one = np.stack([i, i + 1], 1)
    return np.concatenate([chain(0, 0), chain(0.1, 0.37)]), np.concatenate([one, one + m + 1])


def rings(n):
    """Small rings at random places, listed in rows; many overlap."""
    around = 16
    count = n // around
    centres = np.random.default_rng(7).random((count, 2)) * count**0.5 * 8
    centres = centres[np.lexsort((centres[:, 0], np.floor(centres[:, 1] / 40)))]
    k = np.arange(around)
    circle = 2.5 * np.stack([np.cos(2 * pi * k / around), np.sin(2 * pi * k / around)], 1)
    first = np.arange(count)[:, None] * around
    segments = np.stack([(first + k).ravel(), (first + (k + 1) % around).ravel()], 1)
    return (centres[:, None, :] + circle).reshape(-1, 2), segments


def folded(n, wall):
    """The outline of a folded wall: one closed chain, a hundred segments from fold to fold, a fifth of a segment between the folds."""
    wide, gap = 100, 0.2
    x = np.arange(wide) + 0.5
    walls = max(2, n // (2 * (wide + 1)))

    def face(rows):
        points = []
        for k, r in enumerate(rows):
            row = np.stack([x, r // 2 * (wall + gap) + r % 2 * wall + 3 * np.sin(x / 12)], 1)[:: 1 if k % 2 == 0 else -1]
            # On the outside of a fold the chain goes round the wall beside it.
            if points and r - rows[k - 1] == 3:
                last, way = points[-1][-1], row[0] - points[-1][-1]
                out = [0.5 if k % 2 == 1 else -0.5, 0.0]
                points.append(np.stack([last + way / 3 + out, last + way * 2 / 3 + out]))
            points.append(row)
        return np.concatenate(points)

    there = face([2 * k + k % 2 for k in range(walls)])
    back = face([2 * k + 1 - k % 2 for k in range(walls)])
    points = np.concatenate([there, back[::-1]])
    i = np.arange(len(points))
    return points, np.stack([i, (i + 1) % len(points)], 1)


def accordion(n):
    """A folded wall as thick as a segment is long."""
    return folded(n, 1.0)


def pressed(n):
    """A folded wall as thin as its gaps: five layers within a segment's length, the most crowded of all."""
    return folded(n, 0.2)


CASES = (waves, rings, accordion, pressed)


def velocity(points):
    """A shear to and fro, nowhere faster than 1."""
    return np.stack([np.cos(points[:, 1] / 8), np.sin(points[:, 0] / 8)], 1) / 2**0.5


class Case:
    def __init__(self, make, n, folder):
        self.name = make.__name__
        old, segments = make(n)
        self.mean = np.linalg.norm(old[segments[:, 1]] - old[segments[:, 0]], axis=1).mean()
        self.reach = 0.25 * self.mean
        self.count = len(segments)
        self.velocity = velocity(old)
        self.old = old
        self.segments = segments
        old.astype("<f8").tofile(os.path.join(folder, "old.f64"))
        self.at(1, PARTS[-1]).astype("<f8").tofile(os.path.join(folder, "new.f64"))
        segments.astype("<u4").tofile(os.path.join(folder, "segments.u32"))
        self.folder = folder
        self.mesh = ipctk.CollisionMesh(np.asfortranarray(old), np.asfortranarray(segments.astype(np.int32)))

    def at(self, step, part):
        """Positions after so many steps of so large a part of the skin."""
        return np.asfortranarray(self.old + step * part * self.reach * self.velocity)

    def embate(self, *words):
        """Runs the benchmark; lists of numbers by name."""
        command = ["cargo", "bench", "-q", "-p", "embate-solver", "--bench", "against_ipctk", "--"]
        words = [self.folder, repr(float(self.reach)), *map(str, words)]
        lines = subprocess.run(command + words, cwd=ROOT, check=True, capture_output=True, text=True).stdout
        found = {}
        for name, number in (line.split() for line in lines.splitlines() if line):
            found.setdefault(name, []).append(float(number))
        return found

    def ipctk(self, method, threads, old, new, reach):
        """Wall and processor time of one build, ns, and its candidates."""
        ipctk.set_num_threads(threads)
        cpu, wall = time.process_time_ns(), time.perf_counter_ns()
        candidates = ipctk.Candidates()
        candidates.build(self.mesh, old, new, inflation_radius=0.5 * reach, broad_phase=getattr(ipctk, method)())
        return time.perf_counter_ns() - wall, time.process_time_ns() - cpu, candidates

    def distances_below(self, reach):
        """Pairs nearer than the reach at the beginning, middle or end of the step, by brute force."""
        near = set()
        new = self.at(1, PARTS[-1])
        for points in (self.old, 0.5 * (self.old + new), new):
            a, b = points[self.segments[:, 0]], points[self.segments[:, 1]]
            along = ((points[:, None] - a) * (b - a)).sum(2) / ((b - a) ** 2).sum(1)
            nearest = a + np.clip(along, 0, 1)[..., None] * (b - a)
            distance = np.linalg.norm(points[:, None] - nearest, axis=2)
            near |= {(int(v), int(e)) for v, e in np.argwhere(distance < reach) if v not in self.segments[e]}
        return near


def methods(size, slow):
    """Broad phases of ipctk; those whose cost grows with the square of the size only where they end."""
    names = [n for n in ("BruteForce", "HashGrid", "SpatialHash", "BVH", "LBVH", "SweepAndPrune") if hasattr(ipctk, n)]
    return [n for n in names if slow or size <= 1000 or n not in ("BruteForce", "SpatialHash")]


def check(case):
    """Both find what brute force finds."""
    true = case.distances_below(case.reach)
    case.embate("build", 1, 1)
    own = {tuple(p) for p in np.fromfile(os.path.join(case.folder, "pairs.u32"), "<u4").reshape(-1, 2).tolist()}
    assert true <= own, (case.name, len(true - own))
    numbers = [f"true {len(true)}", f"embate {len(own)}"]
    for method in methods(1000, True):
        candidates = case.ipctk(method, 1, case.at(0, 0), case.at(1, PARTS[-1]), case.reach)[2]
        found = {(c.vertex_id, c.edge_id) for c in candidates.ev_candidates}
        assert true <= found, (case.name, method, len(true - found))
        numbers.append(f"{method} {len(found)}")
    print(f"pairs, {case.name}, {case.count} segments: " + ", ".join(numbers), flush=True)


def first_build(case, rounds, threads, slow):
    """One row per contender: ns per segment."""
    wall, cpu = {}, {}
    old, new = case.at(0, 0), case.at(1, PARTS[-1])
    repetitions = max(3, min(30, 200_000 // case.count))
    for _ in range(rounds):
        for n in threads:
            for kind, times in case.embate("build", repetitions, n).items():
                wall.setdefault((kind, n), []).extend(t / case.count for t in times if kind != "pairs")
        for method in methods(case.count, slow):
            for n in threads:
                for _ in range(1 if method in ("SpatialHash", "BruteForce") else repetitions):
                    w, c, _ = case.ipctk(method, n, old, new, case.reach)
                    wall.setdefault((method, n), []).append(w / case.count)
                    cpu.setdefault((method, n), []).append(c / case.count)
    for (name, n), times in wall.items():
        if name == "pairs":
            continue
        row = f"{case.name:10} {case.count:8} {name:14} {n:7} {min(times):10.1f} {np.median(times):10.1f}"
        if (name, n) in cpu:
            own = wall["fresh", n]
            row += f" {np.median(cpu[name, n]):10.1f} {min(times) / min(own):9.1f} {np.median(times) / np.median(own):9.1f}"
        print(row, flush=True)
    return {n: min((m for m, k in cpu if k == n), key=lambda m: np.median(wall[m, n])) for n in threads}


def per_step(case, fastest):
    """Average cost of a step, ns per segment."""
    for part in PARTS:
        found = case.embate("run", STEPS, part)
        searching, looking, searches = (found[k][0] for k in ("searching", "looking", "searches"))
        own = (searching + looking) / STEPS / case.count
        row = f"{case.name:10} {case.count:8} {part:8.0e} {searches:9.0f} {looking / STEPS / case.count:8.2f} {own:8.2f}"
        for threads, method in fastest.items():
            reach = 2 * part * case.reach
            times = []
            for step in np.linspace(1, STEPS, 30).astype(int):
                times.append(case.ipctk(method, threads, case.at(step - 1, part), case.at(step, part), reach)[0] / case.count)
            row += f" {method:>14} {np.median(times):10.1f} {np.median(times) / own:9.0f}"
        print(row, flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", type=int, nargs="+", default=[1000, 10_000, 100_000])
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--slow", action="store_true", help="the slowest methods of ipctk at all sizes, too")
    arguments = parser.parse_args()
    threads = sorted({1, ipctk.get_num_threads()})
    print(f"ipctk {ipctk.__version__}, threads {threads}")
    with tempfile.TemporaryDirectory() as folder:
        for make in CASES:
            check(Case(make, 1000, folder))
        print("\none build, ns per segment")
        print(f"{'case':10} {'segments':>8} {'method':14} {'threads':>7} {'least':>10} {'median':>10} {'cpu':>10} {'/ embate':>9} {'by median':>9}")
        fastest = {}
        for n in arguments.sizes:
            for make in CASES:
                fastest[n, make] = first_build(Case(make, n, folder), arguments.rounds, threads, arguments.slow)
        print(f"\na step of {STEPS}, ns per segment")
        heads = "".join(f" {f'ipctk, {n} thr.':>14} {'median':>10} {'/ embate':>9}" for n in threads)
        print(f"{'case':10} {'segments':>8} {'part':>8} {'searches':>9} {'looking':>8} {'embate':>8}" + heads)
        for (n, make), methods in fastest.items():
            per_step(Case(make, n, folder), methods)


if __name__ == "__main__":
    main()
