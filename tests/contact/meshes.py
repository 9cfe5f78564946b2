"""Meshes of random scenes: mapped grids of hexahedra, wedges and tetrahedra, cut tetrahedra, and Gmsh 2.2 files of them."""

import math

import numpy as np

# Gmsh's number of each kind of element, by its nodes.
GMSH = {4: 4, 6: 6, 8: 5}
KUHN = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]


class Mesh:
    """Points (N, 3) and cells, tuples of 4, 6 or 8 node numbers."""

    def __init__(self, points, cells):
        self.points, self.cells = np.asarray(points, dtype=float), [turned(np.asarray(points), cell) for cell in cells]

    def moved(self, rotation=None, by=(0.0, 0.0, 0.0)):
        points = self.points if rotation is None else self.points @ np.asarray(rotation).T
        return Mesh(points + np.asarray(by), self.cells)

    def shortest(self):
        """The least height that a stable step sees: six volumes over the largest faces, about."""
        return min(height(self.points[list(cell)]) for cell in self.cells)


def height(corners):
    """Volume over the largest area that edges at a corner make, at the worst corner."""
    if len(corners) == 4:
        a, b, c = corners[1:] - corners[0]
        areas = [np.linalg.norm(np.cross(p, q)) for p, q in ((a, b), (b, c), (c, a), (b - a, c - a))]
        return abs(np.dot(a, np.cross(b, c))) / max(areas)
    low, high = (corners[:4], corners[4:]) if len(corners) == 8 else (corners[:3], corners[3:])
    n = len(low)
    sides = [np.linalg.norm(low[k] - low[(k + 1) % n]) for k in range(n)] + [
        np.linalg.norm(high[k] - high[(k + 1) % n]) for k in range(n)
    ]
    sides += [np.linalg.norm(high[k] - low[k]) for k in range(n)]
    return min(sides) * (1.0 if n == 4 else 0.5)


def turned(points, cell):
    """The cell with its first face below the second."""
    at = [points[node].tolist() for node in cell]
    if len(cell) == 4:
        a, b, c = ([x - y for x, y in zip(corner, at[0])] for corner in at[1:])
        return tuple(cell) if dot(across(a, b), c) > 0 else (cell[0], cell[2], cell[1], cell[3])
    n = len(cell) // 2
    centre, middle = ([sum(corner[d] for corner in some) / len(some) for d in range(3)] for some in (at, at[:n]))
    arms = [[x - y for x, y in zip(corner, middle)] for corner in at[:n]]
    normal = [sum(turn) for turn in zip(*(across(arms[k], arms[(k + 1) % n]) for k in range(n)))]
    return tuple(cell) if dot(normal, [x - y for x, y in zip(centre, middle)]) > 0 else tuple(cell[n:]) + tuple(cell[:n])


def across(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def grid(counts, place, kind="hex", around=(), dice=None):
    """A grid of `counts` cells, its node at (u, v, w) in [0, 1]^3 at place(u, v, w); the axes in `around` are closed to rings.

    Kinds: hex, tet (six of each hexahedron), wedge (two of each), mixed (some columns along w are wedges; by `dice`).
    """
    nodes = [n if axis in around else n + 1 for axis, n in enumerate(counts)]
    points = [
        place(i / counts[0], j / counts[1], k / counts[2])
        for i in range(nodes[0])
        for j in range(nodes[1])
        for k in range(nodes[2])
    ]

    def at(i, j, k):
        return ((i % nodes[0]) * nodes[1] + j % nodes[1]) * nodes[2] + k % nodes[2]

    cells = []
    for i in range(counts[0]):
        for j in range(counts[1]):
            is_split = kind == "wedge" or (kind == "mixed" and dice.random() < 0.5)
            for k in range(counts[2]):
                corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
                hexahedron = [at(i + a, j + b, k + c) for a, b, c in corners]
                if kind == "tet":
                    cells += [tuple(hexahedron[n] for n in tet) for tet in KUHN]
                elif is_split:
                    cells += [tuple(hexahedron[n] for n in wedge) for wedge in ((0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7))]
                else:
                    cells.append(tuple(hexahedron))
    return Mesh(points, cells)


def box(size, counts, kind="hex", dice=None):
    """A box around the origin."""
    return grid(counts, lambda u, v, w: tuple((t - 0.5) * s for t, s in zip((u, v, w), size)), kind, dice=dice)


def sweep(path, width, counts, kind="hex", is_ring=False, turn=0.0, taper=1.0, dice=None):
    """A wire of square cross-section along path(t), t in [0, 1]; `counts` across, across and along; its end `taper` times as wide."""
    count = counts[2]
    centres = np.array([path(k / count) for k in range(count + 1)])
    tangents = np.gradient(centres, axis=0)
    if is_ring:
        tangents = np.array([path((k + 0.5) / count % 1) - path((k - 0.5) / count % 1) for k in range(count + 1)])
    normal = np.cross(tangents[0], np.eye(3)[np.argmin(np.abs(tangents[0]))])
    frames = []
    for tangent in tangents:
        tangent = tangent / np.linalg.norm(tangent)
        normal = normal - (normal @ tangent) * tangent
        normal = normal / np.linalg.norm(normal)
        frames.append((normal, np.cross(tangent, normal)))

    def place(u, v, w):
        k = round(w * count)
        x, y = (u - 0.5) * width, (v - 0.5) * width
        x, y = x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn)
        scale = 1.0 + (taper - 1.0) * w
        return centres[k] + scale * (x * frames[k][0] + y * frames[k][1])

    return grid(counts, place, kind, around=(2,) if is_ring else (), dice=dice)


def annulus(inner, outer, length, counts, kind="hex", dice=None):
    """A tube along z; radii are functions of (angle, place along); `counts` through the wall, around and along."""

    def place(u, v, w):
        angle = 2 * math.pi * v
        a, b = inner(angle, w), outer(angle, w)
        r = a + u * (b - a)
        return (r * math.cos(angle), r * math.sin(angle), (w - 0.5) * length)

    return grid(counts, place, kind, around=(1,), dice=dice)


def pebble(radius, count, kind="hex", dice=None):
    """A cube with round corners, almost a ball."""

    def place(u, v, w):
        p = 2 * np.array([u, v, w]) - 1
        largest, norm = np.abs(p).max(), np.linalg.norm(p)
        return radius * p * (0.45 + 0.55 * (largest / norm if norm > 0 else 1.0)) / 1.2

    return grid((count,) * 3, place, kind, dice=dice)


def shard(corners, kind="hex", finer=False):
    """A tetrahedron: of four hexahedra, or of one tetrahedron (each cut into eight smaller ones where `finer`)."""
    points, number = [], {}

    def node(place):
        key = tuple(round(x, 12) for x in place)
        if key not in number:
            number[key] = len(points)
            points.append(place)
        return number[key]

    tets = [[np.asarray(corner, dtype=float) for corner in corners]]
    if finer:
        tets = [small for tet in tets for small in eighths(tet)]
    cells = []
    for tet in tets:
        if kind == "tet":
            for small in eighths(tet):
                cells.append(tuple(node(p) for p in small))
            continue
        centre = sum(tet) / 4
        for k in range(4):
            a, b, c, d = (tet[(k + n) % 4] for n in range(4))
            around = [a, (a + b) / 2, (a + b + c) / 3, (a + c) / 2, (a + d) / 2, (a + b + d) / 3, centre, (a + c + d) / 3]
            cells.append(tuple(node(p) for p in around))
    return Mesh(points, cells)


def eighths(tet):
    """Eight tetrahedra of one, cut at the middles of its edges."""
    a, b, c, d = tet
    ab, ac, ad, bc, bd, cd = ((p + q) / 2 for p, q in ((a, b), (a, c), (a, d), (b, c), (b, d), (c, d)))
    ends = [(a, ab, ac, ad), (b, ab, bc, bd), (c, ac, bc, cd), (d, ad, bd, cd)]
    # The octahedron in the middle around the line from ab to cd.
    around = [ac, bc, bd, ad]
    return [list(t) for t in ends] + [[ab, cd, around[k], around[(k + 1) % 4]] for k in range(4)]


def rotation(axis, angle):
    """Rotation matrix about an axis by an angle (Rodrigues)."""
    x, y, z = np.asarray(axis, dtype=float) / np.linalg.norm(axis)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * (k @ k)


def any_rotation(dice):
    """A rotation about any axis by any angle."""
    axis = [dice.gauss(0, 1) for _ in range(3)]
    return rotation(axis, dice.uniform(0, 2 * math.pi))


def gmsh(meshes):
    """Text of a Gmsh 2.2 file with a group of volumes for each name."""
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(meshes))]
    lines += [f'3 {number} "{name}"' for number, name in enumerate(meshes, 1)]
    points = np.concatenate([mesh.points for mesh in meshes.values()])
    lines += ["$EndPhysicalNames", "$Nodes", str(len(points))]
    lines += [f"{number} {x!r} {y!r} {z!r}" for number, (x, y, z) in enumerate(points.tolist(), 1)]
    cells, first = [], 1
    for group, mesh in enumerate(meshes.values(), 1):
        cells += [(GMSH[len(cell)], group, [first + n for n in cell]) for cell in mesh.cells]
        first += len(mesh.points)
    lines += ["$EndNodes", "$Elements", str(len(cells))]
    lines += [
        f"{number} {kind} 2 {group} {group} " + " ".join(map(str, nodes)) for number, (kind, group, nodes) in enumerate(cells, 1)
    ]
    return "\n".join(lines) + "\n$EndElements\n"
