"""Random scenes with rigid obstacles of every shape, large, small and sharp beside the elements that meet them."""

import math

import meshes
import numpy as np
from overlap import units
from parts import Part
from plane import add, body, numbers, points, star


def stl(triangles):
    """The text of a file of triangles (N, 3, 3)."""
    lines = ["solid tool"]
    for triangle in triangles:
        lines += ["facet normal 0 0 0", "outer loop", *(f"vertex {' '.join(map(repr, map(float, x)))}" for x in triangle)]
        lines += ["endloop", "endfacet"]
    return "\n".join([*lines, "endsolid tool", ""])


def pyramid(dice):
    """A needle or a wedge, its tip up at the origin."""
    high, wide, count = dice.order(0.5, 8), dice.order(0.2, 2), dice.choice([3, 4, 7])
    angles = [2 * math.pi * k / count for k in range(count)]
    base = [np.array([wide * math.cos(a), wide * math.sin(a), -high]) for a in angles]
    tip, middle = np.zeros(3), np.array([0, 0, -high])
    return [(a, b, tip) for a, b in zip(base, base[1:] + base[:1])] + [(b, a, middle) for a, b in zip(base, base[1:] + base[:1])]


def ball(dice):
    """An octahedron whose triangles are cut in four so many times; its top at the origin."""
    signs = [(x, y, z) for x in (1, -1) for y in (1, -1) for z in (1, -1)]
    corners = np.eye(3)
    found = []
    for sign in signs:
        a, b, c = (corners[k] * sign[k] for k in range(3))
        found.append((a, b, c) if np.prod(sign) > 0 else (a, c, b))
    for _ in range(dice.choice([0, 1, 2])):
        found = [
            piece
            for a, b, c in found
            for ab, bc, ca in [units(np.array([a + b, b + c, c + a]))]
            for piece in [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        ]
    radius = dice.order(0.5, 4)
    return [[radius * (x - [0, 0, 1]) for x in triangle] for triangle in found]


def block(dice):
    """A box, turned about z or standing on an edge or a corner, its highest corner at the origin."""
    size = [dice.order(0.5, 6) for _ in range(3)]
    signs = [(-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1), (-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1)]
    corners = 0.5 * np.array(signs) * size
    turn = dice.choice([np.eye(3), meshes.rotation((0, 0, 1), dice.uniform(0, 1)), meshes.any_rotation(dice)])
    corners = corners @ turn.T
    corners -= corners[corners[:, 2].argmax()]
    quads = [(0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)]
    return [[corners[k] for k in half] for a, b, c, d in quads for half in ((a, b, c), (a, c, d))]


def tools(scene, dice):
    """A body thrown at an obstacle."""
    thick = dice.choice([1.0, 1.0, dice.order(0.05, 0.5)]) * 0.004
    wide = dice.choice([1, 2, 4]) * 0.004
    across = dice.choice([1, 2, 3, 5])
    deep = max(1, min(4, round(thick / wide * across)))
    mesh = meshes.box((wide, wide, thick), (across, across, deep), dice.kind(), dice)
    if dice.random() < 0.4:
        mesh = mesh.moved(meshes.any_rotation(dice))
    material = dice.soft()
    scene.speed = 0.5 * dice.speed(material)
    scene.thickness, scene.travel = thick, 2.0 * thick + 0.3 * wide
    size = thick if dice.random() < 0.5 else wide / across
    x, y = (dice.uniform(-0.3, 0.3) * wide for _ in range(2))
    start = 0.02 * thick
    what = dice.choice(["plane", "sphere", "sphere", "cylinder", "hollow", "stl", "stl", "stl"])
    low = mesh.points[:, 2].min()
    if what == "plane":
        tilt = np.array([dice.uniform(-0.5, 0.5), dice.uniform(-0.5, 0.5), 1.0])
        reach = (mesh.points @ tilt).min() / (tilt @ tilt)
        text = f"plane = {{ point = {numbers((reach - start) * tilt)}, normal = {numbers(tilt)} }}"
    elif what == "sphere":
        radius = size * dice.order(0.2, 10)
        text = f"sphere = {{ centre = {numbers((x, y, low - radius - start))}, radius = {radius!r} }}"
    elif what == "cylinder":
        radius, angle = size * dice.order(0.2, 10), dice.uniform(0, math.pi)
        axis = (math.cos(angle), math.sin(angle), 0.0)
        text = f"cylinder = {{ point = {numbers((x, y, low - radius - start))}, axis = {numbers(axis)}, radius = {radius!r} }}"
    elif what == "hollow":
        radius = 1.02 * np.linalg.norm(mesh.points, axis=1).max() * dice.order(1, 3)
        text = f"sphere = {{ centre = [0.0, 0.0, 0.0], radius = {float(radius)!r}, hollow = true }}"
        scene.travel += radius
    else:
        triangles = np.array(dice.choice([pyramid, ball, block])(dice)) * size + [x, y, low - start]
        scene.extra["tool.stl"] = stl(triangles)
        text = 'stl = { file = "tool.stl" }'
    scene.parts.append(Part("a", material, mesh, (0.0, 0.0, -scene.speed)))
    scene.obstacles.append(f'{{ name = "tool", {text} }}')
    scene.is_alone = True
    return scene


def tools2(scene, dice):
    """The same in the plane."""
    radius = 0.004
    shape = body(dice, (0.0, 0.0), radius)
    material = dice.soft()
    scene.speed = 0.5 * dice.speed(material)
    scene.thickness, scene.travel = 0.5 * radius, 2.0 * radius
    x, top = dice.uniform(-0.5, 0.5) * radius, -1.6 * radius
    what = dice.choice(["plane", "plate", "circle", "circle", "hollow", "polyline", "polyline"])
    if what == "plane":
        text = f"plane = {{ point = {numbers((0, top))}, normal = {numbers((dice.uniform(-0.3, 0.3), 1.0))} }}"
    elif what == "plate":
        text = f"plane = {{ point = {numbers((x, top))}, normal = [0.0, 1.0], length = {radius * dice.order(0.1, 3)!r} }}"
    elif what == "circle":
        round_ = radius * dice.order(0.05, 5)
        text = f"circle = {{ centre = {numbers((x, top - round_))}, radius = {round_!r} }}"
    elif what == "hollow":
        text = f"circle = {{ centre = [0.0, 0.0], radius = {1.8 * radius!r}, hollow = true }}"
    else:
        size = radius * dice.order(0.1, 2)
        corners = star(dice, (0.0, 0.0), size, dice.choice([3, 4, 5, 8]), 0.2)[::-1]
        highest = max(y for _, y in corners)
        corners = [(a + x, b - highest + top) for a, b in corners]
        text = f"polyline = {{ points = {points(corners + corners[:1])} }}"
    add(scene, "a", material, shape, (0.0, -scene.speed))
    scene.obstacles.append(f'{{ name = "tool", {text} }}')
    scene.is_alone = True


TOOLS = {"tools": tools, "tools2": tools2}
