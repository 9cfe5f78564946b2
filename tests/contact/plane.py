"""Families of random scenes in the plane: built-in shapes of the model file."""

import math

from parts import Part, wave

ELEMENTS = ["quad4", "quad4", "quad4_reduced_assumed_strain"]


def numbers(values):
    return "[" + ", ".join(repr(float(x)) for x in values) + "]"


def points(values):
    return "[" + ", ".join(numbers(value) for value in values) + "]"


def turned(angle, at):
    return f", rotation = {{ angle = {float(angle)!r}, point = {numbers(at)} }}"


def rectangle(dice, at, size, counts, angle=0.0):
    corner = [at[d] - 0.5 * size[d] for d in (0, 1)]
    table = f"corner = {numbers(corner)}, size = {numbers(size)}, elements = {list(counts)}"
    shape = f'element = "{dice.choice(ELEMENTS)}", rectangle = {{ {table} }}'
    return shape + (turned(angle, at) if angle else ""), min(s / n for s, n in zip(size, counts))


def disk(dice, at, radius, count):
    return (
        f'element = "{dice.choice(ELEMENTS)}", disk = {{ centre = {numbers(at)}, radius = {radius!r}, elements = {count} }}',
        0.4 * radius / count,
    )


def polygon(outline, size):
    return f"polygon = {{ outline = {points(outline)}, size = {size!r} }}", 0.3 * size


def star(dice, at, radius, corners, least=0.4):
    """A star-shaped outline around a place."""
    angles = [2 * math.pi * (k + dice.uniform(0, 0.6)) / corners for k in range(corners)]
    radii = [radius * dice.uniform(least, 1.0) for _ in angles]
    return [(at[0] + r * math.cos(a), at[1] + r * math.sin(a)) for r, a in zip(radii, angles)]


def add(scene, name, material, shape, velocity=(0.0, 0.0), rigid=False):
    text, height = shape
    scene.parts.append(Part(name, material, None, tuple(velocity) + (0.0,), text, rigid, height))


def body(dice, at, radius):
    """Any body within a circle."""
    what = dice.choice(["rectangle", "disk", "polygon"])
    if what == "rectangle":
        n = dice.choice([1, 2, 3, 5])
        return rectangle(dice, at, (1.2 * radius, dice.uniform(0.5, 1.5) * radius), (n, n), dice.uniform(0, 3))
    if what == "disk":
        return disk(dice, at, radius, dice.choice([1, 2, 3]))
    return polygon(star(dice, at, radius, dice.choice([3, 4, 5, 7])), radius * dice.choice([0.5, 1.0]))


def boxes(scene, dice):
    """Two turned rectangles."""
    size, materials = 0.01, [dice.soft(), dice.soft()]
    scene.speed = dice.speed(*materials)
    n, m = dice.choice([1, 1, 2, 4, 8]), dice.choice([1, 2, 5, 9])
    add(scene, "a", materials[0], rectangle(dice, (0, 0), (size, size), (n, n), dice.choice([0.0, dice.uniform(0, 1.5)])))
    at = (dice.uniform(-0.8, 0.8) * size, 1.55 * size)
    add(
        scene,
        "b",
        materials[1],
        rectangle(dice, at, (size, size), (m, m), dice.choice([0.0, dice.uniform(0, 1.5)])),
        (0.0, -scene.speed),
    )
    scene.thickness, scene.travel = size, 3 * size


def shards2(scene, dice):
    """Polygons that fly at each other."""
    size, count = 0.01, dice.choice([3, 5, 8])
    materials = [dice.choice(["gel", "rubber", "soft"]) for _ in range(count)]
    scene.speed = dice.speed(*materials)
    for number, material in enumerate(materials):
        at = (2.2 * size * (number % 3), 2.2 * size * (number // 3))
        towards = [(2.2 * size - x) / (3 * size) + dice.uniform(-0.3, 0.3) for x in at]
        shape = polygon(star(dice, at, size, dice.choice([3, 4, 5, 6])), size * dice.choice([0.3, 0.6, 1.0]))
        add(scene, f"s{number}", material, shape, [scene.speed * x for x in towards])
    scene.thickness, scene.travel = 0.5 * size, 3.5 * size


def strip(scene, dice):
    """A strip of one element, or two, hit by anything."""
    thick = dice.order(0.0005, 0.004)
    count = dice.choice([4, 10, 40])
    material, own = dice.soft(), dice.choice(["steel", "hard", "rubber", "gel"])
    scene.speed = dice.speed(material, own)
    add(scene, "sheet", material, rectangle(dice, (0, -0.5 * thick), (0.06, thick), (count, dice.choice([1, 1, 2]))))
    radius = dice.uniform(0.001, 0.004)
    velocity = (dice.uniform(-0.5, 0.5) * scene.speed, -scene.speed)
    add(
        scene,
        "b",
        own,
        body(dice, (dice.uniform(-0.02, 0.02), 1.1 * radius), radius),
        velocity,
        own == "steel" and dice.random() < 0.6,
    )
    if dice.random() < 0.3:
        scene.more.append('constraint = [{ on = "sheet.left", fixed = ["x", "y"] }, { on = "sheet.right", fixed = ["x", "y"] }]')
    scene.thickness, scene.travel = thick, thick + 4 * radius


def rings(scene, dice):
    """Thin rings, one with a ball in it, that are thrown at each other."""
    radius, wall = 0.01, dice.uniform(0.0006, 0.002)
    material = dice.soft()
    scene.speed = dice.speed(material)
    for number in (0, 1):
        counts = [dice.choice([1, 2]), dice.choice([16, 24, 40])]
        centre = (2.3 * radius * number, dice.uniform(-0.5, 0.5) * radius)
        shape = f"ring = {{ centre = {numbers(centre)}, inner = {radius - wall!r}, outer = {radius!r}, elements = {counts} }}"
        velocity = ((1 - 2 * number) * 0.5 * scene.speed, 0.0)
        add(scene, f"r{number}", material, (shape, wall / 2), velocity)
        if dice.random() < 0.5:
            add(scene, f"b{number}", dice.soft(), disk(dice, centre, 0.5 * (radius - wall), 2), (0.0, -velocity[0]))
    scene.thickness, scene.travel = wall, 2 * radius


def spiral(scene, dice):
    """A spiral that is pressed together: self-contact."""
    width, turns = dice.uniform(0.001, 0.002), dice.uniform(1.5, 2.5)
    count = int(10 * turns)
    place = [(0.003 + 0.003 * turns * k / count, 2 * math.pi * turns * k / count) for k in range(count + 1)]
    outline = [(r * math.cos(a), r * math.sin(a)) for r, a in place]
    # Out along one side and back along the other.
    sides = [[(r + s * 0.5 * width, a) for r, a in place] for s in (1, -1)]
    ring = [(r * math.cos(a), r * math.sin(a)) for r, a in sides[0] + sides[1][::-1]]
    material = dice.choice(["rubber", "gel", "soft"])
    scene.speed = dice.order(0.1, 1.0) * wave(material)
    add(scene, "spiral", material, polygon(ring, width * dice.choice([1.0, 2.0])))
    low, high = min(y for _, y in outline) - width, max(y for _, y in outline) + width
    walls = [("floor", low, 1.0, ""), ("ram", high, -1.0, f", motion = {{ y = {-scene.speed!r} }}")]
    for name, y, normal, motion in walls:
        scene.obstacles.append(
            f'{{ name = "{name}", plane = {{ point = {numbers((0, y))}, normal = {numbers((0, normal))} }}{motion} }}'
        )
    scene.thickness, scene.travel = width, dice.uniform(0.4, 0.6) * (high - low)


def heap2(scene, dice):
    """Bodies that fall into a trough."""
    radius, columns, rows = 0.004, 3, dice.choice([2, 4])
    material = dice.choice(["gel", "rubber"])
    scene.speed = dice.order(0.1, 0.8) * wave(material)
    cell = 2.3 * radius
    for number in range(columns * rows):
        at = (cell * (number % columns + 0.5), cell * (number // columns + 0.5))
        velocity = (dice.uniform(-0.2, 0.2) * scene.speed, -scene.speed)
        add(scene, f"p{number}", material if dice.random() < 0.8 else "rubber", body(dice, at, radius), velocity)
    wide, high = cell * columns, 4 * cell * rows
    scene.obstacles.append(
        f'{{ name = "trough", polyline = {{ points = {points([(0, high), (0, 0), (wide, 0), (wide, high)])} }} }}'
    )
    scene.thickness, scene.travel = radius, 1.2 * cell * rows
    scene.gravity = dice.choice([0.0, scene.speed**2 / radius])


def combs(scene, dice):
    """Two combs that are pushed into each other."""
    tooth, count = 0.002, dice.choice([3, 5])
    material = dice.soft()
    scene.speed = dice.speed(material)
    pitch = tooth * dice.uniform(1.7, 2.6)

    def outline(y, up, shift):
        top = [(shift, y), (shift + pitch * count, y)]
        teeth = []
        for k in reversed(range(count)):
            x, narrow = shift + pitch * k, dice.uniform(0.3, 1.0) * tooth
            middle = x + 0.5 * tooth
            teeth += [
                (x + tooth, y + up * tooth),
                (middle + 0.5 * narrow, y + up * 4 * tooth),
                (middle - 0.5 * narrow, y + up * 4 * tooth),
            ]
            teeth.append((x, y + up * tooth))
        ring = top + [(shift + pitch * count, y + up * tooth)] + teeth[:-1] + [(shift, y + up * tooth)]
        return ring if up > 0 else ring[::-1]

    size = tooth * dice.choice([0.6, 1.0])
    add(scene, "a", material, polygon(outline(0.0, 1, 0.0), size))
    add(
        scene,
        "b",
        dice.choice([material, dice.soft()]),
        polygon(outline(8.3 * tooth, -1, dice.uniform(0, 1) * pitch), size),
        (0.0, -scene.speed),
    )
    scene.thickness, scene.travel = 0.5 * tooth, 8 * tooth


def ratio2(scene, dice):
    """Coarse on fine, up to 1:200."""
    finer = dice.order(10, 200)
    materials = [dice.soft(), dice.soft()]
    scene.speed = dice.speed(*materials)
    big = 0.01
    size = big / finer
    n = max(2, min(60, int(2 * finer)))
    fine = (n * size, dice.choice([1, 2, 4]) * size)
    add(scene, "fine", materials[0], rectangle(dice, (0, -0.5 * fine[1]), fine, (n, round(fine[1] / size)), 0.0))
    at = (dice.uniform(-0.5, 0.5) * fine[0], 0.72 * big)
    what = dice.choice(["disk", "box"])
    shape = (
        disk(dice, at, 0.7 * big, dice.choice([1, 2]))
        if what == "disk"
        else rectangle(dice, at, (big, big), (1, 1), dice.uniform(0, 1.5))
    )
    add(scene, "coarse", materials[1], shape, (0.0, -scene.speed))
    scene.thickness, scene.travel = fine[1], 0.3 * big + 3 * fine[1]


PLANE = {f.__name__: f for f in (boxes, shards2, strip, rings, spiral, heap2, combs, ratio2)}
