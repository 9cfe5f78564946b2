"""Families of random scenes in space."""

import math

import meshes
import numpy as np
from parts import Part, wave


def beyond(still, moving, direction, gap):
    """How far along `direction` a mesh must be moved so that a plane with a gap is between both."""
    direction = np.asarray(direction, dtype=float)
    return direction * (gap + (still.points @ direction).max() - (moving.points @ direction).min())


def throw(scene, dice, still, moving, aside=(0.0, 0.0, 0.0), material=None, own=None, rigid=None):
    """Two bodies: one is thrown at the other along -z, from just above it."""
    material, own = material or dice.soft(), own or dice.soft()
    scene.speed = dice.speed(material, own)
    shift = beyond(still, moving, (0, 0, 1), dice.uniform(0.05, 0.3) * scene.thickness) + np.asarray(aside)
    scene.parts += [
        Part("a", material, still),
        Part("b", own, moving.moved(by=shift), (0.0, 0.0, -scene.speed), rigid=bool(rigid)),
    ]
    return scene


def bar(dice, width, length, along=0):
    """A square bar, turned about its axis; 1 to 4 elements across."""
    across = dice.choice([1, 1, 2, 2, 3, 4])
    count = max(3, min(round(length / width * across * dice.choice([0.5, 1.0])), 24 if across < 3 else 12))
    mesh = meshes.box((length, width, width), (count, across, across), dice.kind(), dice)
    turn = dice.choice([0.0, math.pi / 4, math.pi / 4, dice.uniform(0, math.pi / 2)])
    mesh = mesh.moved(meshes.rotation((1, 0, 0), turn))
    return mesh if along == 0 else mesh.moved(meshes.rotation((0, 0, 1), along))


def bars(scene, dice):
    width = 0.0024
    other = width * dice.choice([1.0, 1.0, 0.5, 1.5])
    angle = dice.choice([math.pi / 2, math.pi / 2, dice.uniform(0.4, 2.7)])
    still, moving = bar(dice, width, 0.03 * dice.uniform(0.5, 1)), bar(dice, other, 0.03 * dice.uniform(0.5, 1), angle)
    scene.thickness, scene.travel = min(width, other), 1.6 * (width + other)
    aside = (dice.uniform(-0.004, 0.004), dice.uniform(-0.001, 0.001), 0.0)
    same = dice.soft()
    return throw(scene, dice, still, moving, aside, same, same if dice.random() < 0.7 else None)


def bars3(scene, dice):
    width = 0.0024
    still, moving = bar(dice, width, 0.02), bar(dice, width, 0.02, dice.uniform(0.6, 2.5))
    scene.thickness, scene.travel = width, 6.0 * width
    throw(scene, dice, still, moving)
    third = bar(dice, width, 0.02, dice.uniform(0.6, 2.5))
    shift = beyond(scene.parts[1].mesh, third, (0, 0, 1), 0.2 * width)
    scene.parts.append(
        Part("c", dice.choice([scene.parts[0].material, "rubber"]), third.moved(by=shift), (0.0, 0.0, -2.0 * scene.speed))
    )
    return scene


def beams(scene, dice):
    """Flat beams that meet flat, on edge, or with an end."""
    size = (0.02, dice.uniform(0.003, 0.006), dice.uniform(0.0008, 0.002))
    across, through = dice.choice([1, 2, 3]), dice.choice([1, 1, 2])
    still = meshes.box(size, (8 * across, across, through), dice.kind(), dice)
    moving = meshes.box(size, (6 * dice.choice([1, 2]), dice.choice([1, 2]), 1), dice.kind(), dice).moved(
        meshes.any_rotation(dice)
    )
    scene.thickness, scene.travel = size[2], 0.012
    return throw(scene, dice, still, moving, (dice.uniform(-0.005, 0.005), dice.uniform(-0.003, 0.003), 0.0))


def random_shard(dice, size, kind):
    while True:
        corners = [np.array([dice.gauss(0, 1) for _ in range(3)]) for _ in range(4)]
        corners = [size * corner / np.linalg.norm(corner) * dice.uniform(0.7, 1.0) for corner in corners]
        a, b, c = (corner - corners[0] for corner in corners[1:])
        if abs(a @ np.cross(b, c)) > 1.2 * size**3:
            return meshes.shard(corners, kind, finer=dice.random() < 0.5)


def shards(scene, dice):
    """Tetrahedra that fly at each other."""
    size, count = 0.004, dice.choice([2, 3, 4, 6, 8])
    kind, centre = dice.choice(["hex", "tet"]), np.array([0.5, 0.5, 0.5]) * 2.1 * size
    materials = [dice.choice(["gel", "gel", "rubber"]) for _ in range(count)]
    scene.speed = dice.speed(*materials)
    for number, material in enumerate(materials):
        at = 2.1 * size * np.array([number % 2, number // 2 % 2, number // 4], dtype=float)
        towards = (centre - at) / np.linalg.norm(centre) + np.array([dice.uniform(-0.3, 0.3) for _ in range(3)])
        mesh = random_shard(dice, size, kind).moved(meshes.any_rotation(dice), at)
        scene.parts.append(Part(f"s{number}", material, mesh, tuple((scene.speed * towards).tolist())))
    scene.thickness, scene.travel = 0.4 * size, 4.0 * size
    return scene


def sheet(scene, dice):
    """A sheet of one element (or two), held by its inertia, hit by a bar, a needle, a corner or a pebble."""
    thick = dice.order(0.0003, 0.002)
    count = dice.choice([4, 8, 12, 16])
    side = 0.02
    still = meshes.box((side, side, thick), (count, count, dice.choice([1, 1, 1, 2])), dice.kind(), dice)
    what = dice.choice(["bar", "needle", "corner", "pebble"])
    kind = dice.kind()
    if what == "bar":
        moving = bar(dice, 0.002, 0.012, dice.uniform(0, math.pi))
    elif what == "needle":
        moving = meshes.sweep(
            lambda t: np.array([0, 0, -0.006 * t]), 0.002, (2, 2, 6), kind, taper=dice.uniform(0.1, 0.5), dice=dice
        )
    elif what == "corner":
        n = dice.choice([1, 2, 3])
        moving = meshes.box((0.004,) * 3, (n, n, n), kind, dice).moved(meshes.any_rotation(dice))
    else:
        moving = meshes.pebble(0.002, dice.choice([2, 3, 4]), kind, dice).moved(meshes.any_rotation(dice))
    scene.thickness, scene.travel = thick, thick + 0.006
    aside = (dice.uniform(-0.004, 0.004), dice.uniform(-0.004, 0.004), 0.0)
    own = dice.choice(["steel", "hard", "rubber", "gel"])
    material = dice.soft()
    return throw(scene, dice, still, moving, aside, material, own, rigid=own == "steel" and dice.random() < 0.7)


def wire(dice, width, length, along):
    waves, height, phase = dice.uniform(0.5, 2), dice.uniform(0, 2) * width, dice.uniform(0, 6)

    def path(t):
        return np.array(
            [length * (t - 0.5), height * math.sin(2 * math.pi * waves * t + phase), height * math.cos(5 * waves * t)]
        )

    across = dice.choice([1, 1, 2])
    count = max(10, min(int(length / width * dice.uniform(0.7, 1.5) * across), 60))
    mesh = meshes.sweep(path, width, (across, across, count), dice.kind(), turn=dice.uniform(0, 1.5), dice=dice)
    return mesh.moved(meshes.rotation((0, 0, 1), along))


def wires(scene, dice):
    """Two to four thin wires one over the other, each faster than the one below."""
    width, count = 0.0012, dice.choice([2, 2, 3, 4])
    materials = [dice.soft() for _ in range(count)]
    scene.speed = dice.speed(*materials)
    last = None
    for number, material in enumerate(materials):
        mesh = wire(dice, width, 0.025, dice.uniform(0.5, 1.0) * number)
        if last is not None:
            mesh = mesh.moved(by=beyond(last, mesh, (0, 0, 1), 0.2 * width))
        scene.parts.append(Part(f"w{number}", material, mesh, (0.0, 0.0, -scene.speed * number)))
        last = mesh
    scene.thickness, scene.travel = width, 8 * width
    return scene


def coil(scene, dice):
    """A coil pressed together between two planes: its turns meet each other."""
    width, turns, radius = 0.0024, dice.uniform(1.5, 3.0), dice.uniform(0.004, 0.007)
    pitch = width * dice.uniform(1.6, 2.6)
    across = dice.choice([1, 1, 2])

    def path(t):
        angle = 2 * math.pi * turns * t
        return np.array([radius * math.cos(angle), radius * math.sin(angle), pitch * turns * t])

    count = int(turns * dice.choice([12, 16, 20]))
    mesh = meshes.sweep(
        path, width, (across, across, count), dice.kind(), turn=dice.choice([0, math.pi / 4, dice.random()]), dice=dice
    )
    material = dice.choice(["rubber", "gel", "soft"])
    low, high = mesh.points[:, 2].min(), mesh.points[:, 2].max()
    scene.speed = dice.order(0.05, 0.7) * wave(material)
    scene.parts.append(Part("coil", material, mesh))
    # Pressed to little more than what the wire itself takes.
    scene.thickness, scene.travel = width, (high - low) - dice.uniform(0.7, 1.1) * width * (turns + 1)
    scene.travel = max(scene.travel, 2 * width)
    scene.obstacles = planes([((0, 0, low - 1e-4), (0, 0, 1), 0.0), ((0, 0, high + 1e-4), (0, 0, -1), -scene.speed)])
    return scene


def planes(walls):
    texts = []
    for number, (point, normal, velocity) in enumerate(walls):
        motion = f", motion = {{ z = {float(velocity)!r} }}" if velocity else ""
        point, normal = (", ".join(repr(float(x)) for x in vector) for vector in (point, normal))
        texts.append(f'{{ name = "wall{number}", plane = {{ point = [{point}], normal = [{normal}] }}{motion} }}')
    return texts


def chain(scene, dice):
    """Rings linked with each other, pulled apart."""
    count, radius, width = dice.choice([2, 2, 3, 4]), 0.006, dice.uniform(0.0012, 0.0024)
    material = dice.soft()
    scene.speed = dice.speed(material)
    across, around = dice.choice([1, 1, 2]), dice.choice([12, 16, 24])
    step = 2 * radius - 1.5 * width - dice.uniform(0, 1) * width
    for number in range(count):
        turn = dice.uniform(0, 1.5)

        def path(t):
            return radius * np.array([math.cos(2 * math.pi * t), math.sin(2 * math.pi * t), 0.0])

        mesh = meshes.sweep(path, width, (across, across, around), dice.kind(), is_ring=True, turn=turn, dice=dice)
        mesh = mesh.moved(meshes.rotation((1, 0, 0), math.pi / 2 * (number % 2) + dice.uniform(-0.1, 0.1)), (step * number, 0, 0))
        velocity = scene.speed * (number / (count - 1) - 0.5)
        own = material if dice.random() < 0.7 else dice.soft()
        scene.parts.append(Part(f"r{number}", own, mesh, (velocity, dice.uniform(-0.1, 0.1) * scene.speed, 0.0)))
    scene.thickness, scene.travel = width, 6 * width * (count - 1)
    return scene


def wheel(dice, teeth, radius, length, kind):
    """A gear, its teeth waves of the outside."""
    per = dice.choice([4, 6])
    depth = 0.25 * radius

    def outer(angle, _):
        phase = angle * teeth / (2 * math.pi) % 1
        return radius + depth * (max(-1.0, min(1.0, 1.6 * math.cos(2 * math.pi * phase))))

    return meshes.annulus(lambda *_: 0.4 * radius, outer, length, (2, teeth * per, dice.choice([1, 2])), kind, dice)


def gears(scene, dice):
    """Two wheels with teeth, one thrown into the other."""
    radius, length = 0.005, dice.uniform(0.001, 0.003)
    first, second = (wheel(dice, dice.choice([6, 8, 10]), radius, length, dice.kind()) for _ in range(2))
    tilt = meshes.rotation((dice.gauss(0, 1), dice.gauss(0, 1), dice.gauss(0, 1)), dice.choice([0.0, 0.1, dice.uniform(0, 1.5)]))
    up = meshes.rotation((1, 0, 0), math.pi / 2)
    first = first.moved(meshes.rotation((0, 1, 0), dice.uniform(0, 1)) @ up)
    second = second.moved(tilt @ meshes.rotation((0, 1, 0), dice.uniform(0, 1)) @ up)
    scene.thickness, scene.travel = 0.0015, 0.008
    aside = (dice.uniform(-0.003, 0.003), dice.uniform(-0.001, 0.001), 0.0)
    return throw(scene, dice, first, second, aside)


def screws(scene, dice):
    """Hollow screws: ridges that wind around; crossed or side by side."""

    def screw():
        radius, turns, starts = 0.002, dice.uniform(1, 3), dice.choice([1, 2])

        def outer(angle, w):
            phase = (starts * angle / (2 * math.pi) - turns * w) % 1
            return radius * (1.0 + 0.25 * (4 * abs(phase - 0.5) - 1))

        return meshes.annulus(
            lambda *_: 0.45 * radius, outer, 0.012, (1, dice.choice([10, 12, 16]), dice.choice([10, 14])), dice.kind(), dice
        )

    flat = meshes.rotation((0, 1, 0), math.pi / 2)
    first, second = screw().moved(flat), screw().moved(
        meshes.rotation((0, 0, 1), dice.choice([0.0, math.pi / 2, dice.random()])) @ flat
    )
    scene.thickness, scene.travel = 0.0009, 0.007
    return throw(scene, dice, first, second, (dice.uniform(-0.002, 0.002), dice.uniform(-0.001, 0.001), 0.0))


def heap(scene, dice):
    """Pebbles, boxes and shards that fall into a box."""
    size, side, layers = 0.004, 2, dice.choice([2, 3])
    material = dice.choice(["gel", "rubber"])
    scene.speed = dice.order(0.1, 0.6) * wave(material)
    cell = 2.4 * size
    for number in range(side * side * layers):
        at = cell * np.array([number % side + 0.5, number // side % side + 0.5, number // side**2 + 0.5])
        at += [dice.uniform(-0.1, 0.1) * size for _ in range(3)]
        kind = dice.choice(["hex", "tet"])
        what = dice.choice(["pebble", "box", "shard"])
        if what == "pebble":
            mesh = meshes.pebble(size, 2, kind)
        elif what == "box":
            mesh = meshes.box((size * 1.2, size * 1.2, size), (2, 2, dice.choice([1, 2])), kind)
        else:
            mesh = random_shard(dice, size, kind)
        velocity = (dice.uniform(-0.2, 0.2) * scene.speed, dice.uniform(-0.2, 0.2) * scene.speed, -scene.speed)
        scene.parts.append(
            Part(f"p{number}", material if dice.random() < 0.8 else "rubber", mesh.moved(meshes.any_rotation(dice), at), velocity)
        )
    wide = cell * side
    walls = [
        ((0, 0, 0), (0, 0, 1)),
        ((0, 0, 0), (1, 0, 0)),
        ((wide, 0, 0), (-1, 0, 0)),
        ((0, 0, 0), (0, 1, 0)),
        ((0, wide, 0), (0, -1, 0)),
    ]
    scene.obstacles = planes([(point, normal, 0.0) for point, normal in walls])
    scene.thickness, scene.travel = 0.4 * size, 1.2 * cell * layers
    scene.gravity = dice.choice([0.0, scene.speed**2 / size])
    return scene


def tube(scene, dice):
    """A thin tube pressed along its axis or across it until it folds onto itself."""
    radius, length, wall = 0.006, dice.uniform(0.008, 0.016), dice.uniform(0.0005, 0.0012)
    around, along = dice.choice([12, 16, 20]), dice.choice([8, 12, 16])

    def bent(angle, w):
        return radius * (1 + 0.03 * math.sin(2 * math.pi * w * 2) * math.cos(2 * angle))

    counts = (dice.choice([1, 1, 2]), around, along)
    mesh = meshes.annulus(bent, lambda angle, w: bent(angle, w) + wall, length, counts, dice.kind(), dice)
    if dice.random() < 0.5:
        mesh = mesh.moved(meshes.rotation((1, 0, 0), math.pi / 2))
    material = dice.choice(["rubber", "soft", "gel"])
    low, high = mesh.points[:, 2].min(), mesh.points[:, 2].max()
    scene.speed = dice.order(0.1, 1.0) * wave(material)
    scene.parts.append(Part("tube", material, mesh))
    scene.thickness, scene.travel = wall, dice.uniform(0.6, 0.85) * (high - low)
    scene.obstacles = planes([((0, 0, low - 1e-4), (0, 0, 1), 0.0), ((0, 0, high + 1e-4), (0, 0, -1), -scene.speed)])
    return scene


def press(scene, dice):
    """A heavy thick body on a thin one that lies on a floor."""
    thick = dice.order(0.0005, 0.002)
    count = dice.choice([4, 6, 10])
    still = meshes.box((0.016, 0.016, thick), (count, count, 1), dice.kind(), dice)
    n = dice.choice([1, 2, 3])
    moving = meshes.box((0.006, 0.006, 0.006), (n, n, n), dice.kind(), dice)
    moving = moving.moved(
        meshes.rotation((0, 0, 1), dice.uniform(0, 1)) @ meshes.rotation((1, 0, 0), dice.choice([0.0, 0.0, 0.3, 0.7]))
    )
    scene.thickness, scene.travel = thick, 2.5 * thick
    throw(
        scene, dice, still, moving, (dice.uniform(-0.003, 0.003), 0.0, 0.0), dice.soft(), dice.choice(["steel", "hard", "rubber"])
    )
    scene.speed *= 0.5
    scene.parts[1].velocity = (0.0, 0.0, -scene.speed)
    scene.parts[1].rigid = dice.random() < 0.4
    scene.obstacles = planes([((0, 0, -0.5 * thick - 1e-5), (0, 0, 1), 0.0)])
    return scene


def ratio(scene, dice):
    """Small fine bodies against one coarse element, up to 1:200."""
    big = 0.02
    finer = dice.order(10, 200)
    size = big / finer
    n = dice.choice([1, 2, 3])
    still = meshes.box((big, big, big * dice.choice([0.1, 1.0])), (1, 1, 1), dice.kind(), dice).moved(
        meshes.rotation((1, 1, 0), dice.choice([0.0, 0.5]))
    )
    what = dice.choice(["box", "pebble", "bar"])
    if what == "box":
        moving = meshes.box((size * n, size * n, size * n), (n, n, n), dice.kind(), dice)
    elif what == "pebble":
        moving = meshes.pebble(0.5 * n * size, n, dice.kind(), dice)
    else:
        moving = meshes.box((size * 8, size, size), (8, 1, 1), dice.kind(), dice)
    moving = moving.moved(meshes.any_rotation(dice))
    scene.thickness, scene.travel = size, 8 * size * n
    top = still.points[:, 2].max()
    aside = np.array([dice.uniform(-0.3, 0.3) * big, dice.uniform(-0.3, 0.3) * big, 0.0])
    # Just above the surface there: from far above along -z would take too long where the top is slanted.
    throw(scene, dice, still, moving, aside)
    mesh = scene.parts[1].mesh
    foot = surface_below(still, mesh.points.mean(0))
    if foot is not None and top - foot > 0:
        scene.parts[1].mesh = mesh.moved(by=(0, 0, foot - top + 0.5 * 8 * size * (1 if foot < top - 1e-9 else 0)))
    scene.travel += 4 * size
    return scene


def surface_below(still, place):
    """Height of the top of a box of one element at a place: the highest of its faces' planes there."""
    best = None
    corners = still.points
    for face in ((0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5)):
        a, b, c = corners[face[0]], corners[face[1]], corners[face[3]]
        normal = np.cross(b - a, c - a)
        if abs(normal[2]) < 1e-9 * np.linalg.norm(normal):
            continue
        z = a[2] - ((place[:2] - a[:2]) @ normal[:2]) / normal[2]
        at = np.array([place[0], place[1], z])
        inside = np.linalg.lstsq(np.stack([b - a, c - a], axis=1), at - a, rcond=None)[0]
        if (inside >= 0).all() and (inside <= 1).all():
            best = z if best is None else max(best, z)
    return best


SPACE = {f.__name__: f for f in (bars, bars3, beams, shards, sheet, wires, coil, chain, gears, screws, heap, tube, press, ratio)}
