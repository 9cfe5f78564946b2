"""Geometry of surfaces that may be inside each other, for `interpenetration.py`: cuts, winding numbers, distances.

Nothing of it is the solver's. A surface is a list of facets of corner numbers: triangles in space, segments in the plane (z = 0).
Places are arrays (N, 3), facets by their corners (F, 3, 3), in the plane (F, 2, 3).
"""

import math

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import mutable, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkStaticCellLocator

# Faces of elements by VTK type; their direction is made outward later, so any order around is good.
FACES = {
    12: [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)],
    13: [(0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)],
    10: [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)],
    24: [
        (0, 6, 4), (6, 2, 5), (4, 5, 1), (6, 5, 4),
        (0, 4, 7), (4, 1, 8), (7, 8, 3), (4, 8, 7),
        (1, 5, 8), (5, 2, 9), (8, 9, 3), (5, 9, 8),
        (2, 6, 9), (6, 0, 7), (9, 7, 3), (6, 7, 9),
    ],
    9: [(0, 1), (1, 2), (2, 3), (3, 0)],
    5: [(0, 1), (1, 2), (2, 0)],
}


def cross(a, b):
    """a x b, without numpy's ways around axes."""
    x, y, z = a[..., 0], a[..., 1], a[..., 2]
    u, v, w = b[..., 0], b[..., 1], b[..., 2]
    return np.stack([y * w - z * v, z * u - x * w, x * v - y * u], axis=-1)


def facet_normals(corners):
    """Normals times area (length) of facets, outward."""
    if corners.shape[1] == 2:
        along = corners[:, 1] - corners[:, 0]
        return np.stack([along[:, 1], -along[:, 0], np.zeros(len(along))], axis=1)
    return 0.5 * cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])


def units(vectors):
    """Vectors of length one; of zero vectors zero."""
    return vectors / (np.linalg.norm(vectors, axis=-1)[..., None] + 1e-300)


def winding(places, corners):
    """How often the facets wind around each place: 1 inside a closed surface, 0 outside (solid angles: van Oosterom and Strackee 1983)."""
    total = np.empty(len(places))
    step = max(1, 200_000 // max(1, len(corners)))
    corner = np.moveaxis(corners, 0, -1)
    for begin in range(0, len(places), step):
        to = corner[:, :, None, :] - places[begin : begin + step].T[None, :, :, None]
        if len(corner) == 2:
            (ax, ay, _), (bx, by, _) = to
            total[begin : begin + step] = np.arctan2(ax * by - ay * bx, ax * bx + ay * by).sum(axis=1) / (2 * math.pi)
            continue
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = to
        la, lb, lc = (
            np.sqrt(ax * ax + ay * ay + az * az),
            np.sqrt(bx * bx + by * by + bz * bz),
            np.sqrt(cx * cx + cy * cy + cz * cz),
        )
        det = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
        low = (
            la * lb * lc
            + (ax * bx + ay * by + az * bz) * lc
            + (bx * cx + by * cy + bz * cz) * la
            + (cx * ax + cy * ay + cz * az) * lb
        )
        total[begin : begin + step] = np.arctan2(det, low).sum(axis=1) / (2 * math.pi)
    return total


class Nearest:
    """The nearest place of a surface, by vtk's locator."""

    def __init__(self, vertices, facets):
        points = vtkPoints()
        self.kept = np.ascontiguousarray(vertices)
        points.SetData(numpy_to_vtk(self.kept))
        width = facets.shape[1]
        cells = vtkCellArray()
        offsets = np.arange(0, width * len(facets) + 1, width, dtype=np.int64)
        cells.SetData(
            numpy_to_vtkIdTypeArray(offsets, deep=True),
            numpy_to_vtkIdTypeArray(np.ascontiguousarray(facets, dtype=np.int64).ravel(), deep=True),
        )
        self.data = vtkPolyData()
        self.data.SetPoints(points)
        (self.data.SetLines if width == 2 else self.data.SetPolys)(cells)
        self.locator = vtkStaticCellLocator()
        self.locator.SetDataSet(self.data)
        self.locator.BuildLocator()

    def __call__(self, places):
        """Distance to the surface and the facet there, of each place."""
        distance, facet = np.empty(len(places)), np.empty(len(places), dtype=np.int64)
        found, cell, sub, square = [0.0] * 3, mutable(0), mutable(0), mutable(0.0)
        for i, place in enumerate(places.tolist()):
            self.locator.FindClosestPoint(place, found, cell, sub, square)
            distance[i], facet[i] = math.sqrt(float(square)), int(cell)
        return distance, facet


def near_pairs(low_a, high_a, low_b, high_b, block=48):
    """Pairs of boxes (i of a, j of b) that meet: blocks of neighbours of a against all of b, then one by one."""
    empty = np.empty(0, dtype=np.int64)
    if not len(low_a) or not len(low_b):
        return empty, empty
    few = np.flatnonzero(((low_b <= high_a.max(0)) & (high_b >= low_a.min(0))).all(1))
    own = np.flatnonzero(((low_a <= high_b.max(0)) & (high_a >= low_b.min(0))).all(1))
    if not len(few) or not len(own):
        return empty, empty
    middle = 0.5 * (low_a[own] + high_a[own])
    cells = np.floor(8 * (middle - middle.min(0)) / (np.ptp(middle, axis=0).max() + 1e-300)).astype(int)
    own = own[np.lexsort(cells.T)]
    found_i, found_j = [], []
    for begin in range(0, len(own), block):
        i = own[begin : begin + block]
        j = few[((low_b[few] <= high_a[i].max(0)) & (high_b[few] >= low_a[i].min(0))).all(1)]
        meets = np.ones((len(i), len(j)), dtype=bool)
        for d in range(3):
            meets &= (low_a[i, d, None] <= high_b[None, j, d]) & (high_a[i, d, None] >= low_b[None, j, d])
        at, other = np.nonzero(meets)
        found_i.append(i[at])
        found_j.append(j[other])
    return np.concatenate(found_i), np.concatenate(found_j)


def cuts(edges, corners, pairs=None):
    """Where edges (E, 2, 3) pierce facets: numbers of edge and facet, place along the edge."""
    if pairs is None:
        pairs = near_pairs(edges.min(1), edges.max(1), corners.min(1), corners.max(1))
    i, j = pairs
    p, d = edges[i, 0], edges[i, 1] - edges[i, 0]
    a = corners[j, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        if corners.shape[1] == 2:
            s = corners[j, 1] - a
            det = d[:, 0] * s[:, 1] - d[:, 1] * s[:, 0]
            w = a - p
            t = (w[:, 0] * s[:, 1] - w[:, 1] * s[:, 0]) / det
            u = (w[:, 0] * d[:, 1] - w[:, 1] * d[:, 0]) / det
            hit = (t >= 0) & (t <= 1) & (u >= 0) & (u <= 1)
        else:
            e1, e2 = corners[j, 1] - a, corners[j, 2] - a
            h = cross(d, e2)
            det = (e1 * h).sum(1)
            w = p - a
            u = (w * h).sum(1) / det
            q = cross(w, e1)
            v = (d * q).sum(1) / det
            t = (e2 * q).sum(1) / det
            hit = (t >= 0) & (t <= 1) & (u >= 0) & (v >= 0) & (u + v <= 1)
    return i[hit], j[hit], t[hit]


def distances(places, corners):
    """Distances of places (S, 3) from facets (T, D, 3), all with all."""
    best = np.full((len(places), len(corners)), np.inf)
    width = corners.shape[1]
    for k in range(width):
        a, b = corners[None, :, k], corners[None, :, (k + 1) % width]
        d, w = b - a, places[:, None] - a
        t = np.clip((w * d).sum(-1) / ((d * d).sum(-1) + 1e-300), 0.0, 1.0)
        best = np.minimum(best, np.linalg.norm(w - t[..., None] * d, axis=-1))
    if width == 3:
        n = units(facet_normals(corners))
        w = places[:, None] - corners[None, :, 0]
        h = (w * n[None]).sum(-1)
        foot = w - h[..., None] * n[None]
        within = np.ones(h.shape, dtype=bool)
        for k in range(3):
            side = cross(n, corners[:, (k + 1) % 3] - corners[:, k])
            within &= ((foot + corners[None, :, 0] - corners[None, :, k]) * side[None]).sum(-1) >= 0
        best = np.where(within, np.minimum(best, np.abs(h)), best)
    return best


def within_elements(places, corners):
    """Pairs (place, simplex) where the place is inside."""
    i, j = near_pairs(places, places, corners.min(1), corners.max(1))
    sides = np.swapaxes(corners[j, 1:] - corners[j, :1], 1, 2)
    if corners.shape[1] == 3:
        sides = np.concatenate([sides, np.broadcast_to(np.array([[[0.0], [0.0], [1.0]]]), (len(j), 3, 1))], axis=2)
    good = np.abs(np.linalg.det(sides)) > 0
    i, j, sides = i[good], j[good], sides[good]
    shares = np.linalg.solve(sides, (places[i] - corners[j, 0])[..., None])[..., 0][:, : corners.shape[1] - 1]
    inside = (shares >= 0).all(1) & (shares.sum(1) <= 1)
    return i[inside], j[inside]


def outside(cells, points):
    """Faces that only one of the cells {kind: (C, n) nodes} has, outward where the elements are not inverted at these points."""
    faces = []
    for kind, nodes in sorted(cells.items()):
        if not len(nodes):
            continue
        centre = points[nodes].mean(axis=1)
        local, flux = [], np.zeros(len(nodes))
        for face in FACES[kind]:
            of = nodes[:, list(face)]
            place, middle = points[of], points[of].mean(axis=1)
            if len(face) == 2:
                normal = facet_normals(place)
            else:
                ring = [(place[:, k], place[:, (k + 1) % len(face)]) for k in range(len(face))]
                normal = sum(0.5 * cross(a - middle, b - middle) for a, b in ring)
            flux += (normal * (middle - centre)).sum(1)
            local.append(of)
        faces += [np.where((flux >= 0)[:, None], of, of[:, ::-1]) for of in local]
    found = []
    for width in (2, 3, 4):
        mine = [face for face in faces if face.shape[1] == width]
        if not mine:
            continue
        mine = np.concatenate(mine)
        _, back, count = np.unique(np.sort(mine, axis=1), axis=0, return_inverse=True, return_counts=True)
        found.append(mine[count[back.reshape(-1)] == 1])
    return found


def simplices(cells, points):
    """The cells as simplices around their means: corners (M, D + 1, 3), and the nodes of the cell of each (M, 10; the last repeated)."""
    corners, owners = [], []
    for kind, nodes in sorted(cells.items()):
        centre = points[nodes].mean(axis=1)
        padded = np.concatenate([nodes, np.repeat(nodes[:, -1:], 10 - nodes.shape[1], axis=1)], axis=1)
        for face in FACES[kind]:
            place = points[nodes[:, list(face)]]
            if len(face) == 4:
                middle = place.mean(axis=1)
                parts = [np.stack([centre, middle, place[:, k], place[:, (k + 1) % 4]], axis=1) for k in range(4)]
            else:
                parts = [np.concatenate([centre[:, None], place], axis=1)]
            corners += parts
            owners += [padded] * len(parts)
    return np.concatenate(corners), np.concatenate(owners)


class Surface:
    """The outside of one body: facets of D corner numbers, with the means of quadrilaterals as more vertices.

    `faces` are arrays of node numbers, one for each number of corners, outward; nodes have numbers below `count`.
    """

    def __init__(self, faces, count, dimension):
        self.dimension, self.nodes_below, self.count = dimension, count, sum(map(len, faces))
        quads = [face for face in faces if dimension == 3 and face.shape[1] == 4]
        self.quads = np.concatenate(quads) if quads else np.empty((0, 4), dtype=np.int64)
        centres = count + np.arange(len(self.quads))
        around = [np.stack([self.quads[:, i], self.quads[:, (i + 1) % 4], centres], axis=1) for i in range(4)]
        facets = [face for face in faces if face.shape[1] == dimension] + (around if quads else [])
        facets = np.concatenate(facets) if facets else np.empty((0, dimension), dtype=np.int64)
        # Vertices of this body alone, numbered anew: first nodes, then centres.
        self.vertices, local = np.unique(facets, return_inverse=True)
        self.facets = local.reshape(facets.shape)
        self.nodes = self.vertices[self.vertices < count]
        if dimension == 3:
            pairs = np.sort(np.concatenate([self.facets[:, [0, 1]], self.facets[:, [1, 2]], self.facets[:, [2, 0]]]), axis=1)
            self.edges, back = np.unique(pairs, axis=0, return_inverse=True)
            back = back.reshape(-1)
            of = np.tile(np.arange(len(self.facets)), 3)
            order = np.argsort(back, kind="stable")
            first = np.searchsorted(back[order], np.arange(len(self.edges)))
            last = np.searchsorted(back[order], np.arange(len(self.edges)), side="right") - 1
            self.beside = np.stack([of[order[first]], of[order[last]]], axis=1)
        else:
            self.edges = self.facets
            self.beside = np.repeat(np.arange(len(self.facets))[:, None], 2, axis=1)
        # The nodes behind each vertex: itself, four times, or those of its quadrilateral.
        self.behind = np.repeat(self.vertices[:, None], 4, axis=1)
        self.behind[self.vertices >= count] = self.quads[self.vertices[self.vertices >= count] - count]

    def place(self, points):
        """Positions of the vertices, given those of the nodes."""
        whole = points if not len(self.quads) else np.concatenate([points, points[self.quads].mean(axis=1)])
        return whole[self.vertices]


class CentreLine:
    """The means of cross-sections of a body that is at least three times as long as wide."""

    def __init__(self, nodes, points, dimension):
        at = points[nodes]
        spread = at - at.mean(0)
        _, singular, axes = np.linalg.svd(spread, full_matrices=False)
        along = spread @ axes[0]
        across = np.abs(spread @ axes[1]).max()
        self.sections = []
        if dimension == 3 and (along.max() - along.min()) > 6.0 * across:
            count = max(6, min(24, int((along.max() - along.min()) / (2.0 * across))))
            number = np.clip(((along - along.min()) / (along.max() - along.min()) * count).astype(int), 0, count - 1)
            self.sections = [nodes[number == k] for k in range(count) if (number == k).any()]

    def place(self, points):
        return np.array([points[nodes].mean(0) for nodes in self.sections])


def crossings(one, two, direction):
    """Where two lines cross as seen along a direction: (place on one, place on two, distance of two above one)."""
    helper = np.eye(3)[np.argmin(np.abs(direction))]
    u = np.cross(direction, helper)
    u /= np.linalg.norm(u)
    frame = np.stack([u, np.cross(direction, u), direction])
    one, two = one @ frame.T, two @ frame.T
    flat = [np.concatenate([x[:, :2], np.zeros((len(x), 1))], axis=1) for x in (one, two)]
    first, second = (np.stack([x[:-1], x[1:]], axis=1) for x in flat)
    found = []
    for i, j, t in zip(*cuts(first, second)):
        p = flat[0][i] + t * (flat[0][i + 1] - flat[0][i])
        d = flat[1][j + 1] - flat[1][j]
        s = float(np.clip((p - flat[1][j]) @ d / (d @ d), 0, 1))
        height = two[j, 2] + s * (two[j + 1, 2] - two[j, 2]) - one[i, 2] - t * (one[i + 1, 2] - one[i, 2])
        found.append(((i + t) / len(first), (j + s) / len(second), float(height)))
    return found
