#!/usr/bin/env python3
"""Random scenes in which contact may fail: the same seed gives the same files.

    python tests/contact/scenes.py OUT --first 1 --count 20 [--family bars] [--plane]    writes OUT/FAMILY-SEED/model.toml and meshes
    python tests/contact/scenes.py --list

In space: crossed bars, beams, tetrahedra, sheets of one element, wires, coils, chains, gears, screws, heaps, folding tubes, meshes of
1:200; in the plane: boxes, shards, sheets, rings, spirals, heaps, combs, meshes of 1:200; by name alone `tools` and, in the plane, `tools2`:
bodies thrown at rigid obstacles of every shape. Speeds are between 0.1 and 2 times
sqrt(E / density) of the softest body, friction between 0 and 1, elements hexahedra, tetrahedra, wedges or mixed; scenes that nothing
holds are turned at random, every second time. A scene ends when bodies that nothing stops would have passed each other, and has so many
frames that they move by less than half of the least thickness from one to the next (12 to 60 frames).
"""

import argparse
import pathlib
import sys

import meshes
from parts import Dice, Scene
from plane import PLANE
from space import SPACE
from tools import TOOLS

# Elements of a scene at most.
CELLS = 2000


def make(family, seed, cells=CELLS):
    """The scene of a family and a seed, of so many elements at most."""
    for attempt in range(400):
        dice = Dice(f"{family} {seed} {attempt}")
        scene = Scene(family, seed, is_plane=family in PLANE or family == "tools2")
        {**PLANE, **SPACE, **TOOLS}[family](scene, dice)
        scene.friction = dice.choice([0.0, 0.0, 0.0, round(dice.uniform(0.05, 1.0), 3)])
        if not (scene.is_plane or scene.obstacles or scene.gravity) and dice.random() < 0.5:
            scene.turned(meshes.any_rotation(dice))
        if scene.cells() <= cells:
            return scene.softened()
    raise RuntimeError(f"no scene of {family} {seed} is small enough")


def families(plane=False):
    return list(PLANE if plane else SPACE)


def scene(number, plane=False, cells=CELLS):
    """Scene number `number` of all: families in turn."""
    names = families(plane)
    return make(names[number % len(names)], number, cells)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", nargs="?", type=pathlib.Path)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--family")
    parser.add_argument("--plane", action="store_true")
    parser.add_argument("--cells", type=int, default=CELLS, help="elements of a scene at most")
    parser.add_argument("--list", action="store_true")
    options = parser.parse_args()
    if options.list or options.out is None:
        print("in space:    ", ", ".join(SPACE))
        print("in the plane:", ", ".join(PLANE))
        print("with obstacles, by --family alone: tools, tools2 (in the plane)")
        return 0
    for number in range(options.first, options.first + options.count):
        made = make(options.family, number, options.cells) if options.family else scene(number, options.plane, options.cells)
        print(made.write(options.out))
    return 0


if __name__ == "__main__":
    sys.exit(main())
