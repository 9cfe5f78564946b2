#!/usr/bin/env python3
"""Says whether bodies are inside each other in the results of runs, whatever the runs themselves say of it.

    python tests/contact/interpenetration.py results/bars [more folders] [--fraction 0.25] [--json]

It reads fields.pvd with vtk and uses nothing that the solver found: bodies are the connected pieces of the mesh, their surfaces
the faces that only one element has, quadrilaterals made of four triangles around their mean. In each frame

- all edges of the triangles of one body are cut with the triangles of the other (in the plane, segments with segments), both
  ways; what of an edge is inside is found by winding numbers. Bodies whose surfaces do not cut each other overlap only if one
  is all inside the other;
- the depth of 11 places on each piece inside, and of each node inside, is the distance to the other body's surface;
- the area vector of the overlap is N = 1/2 sum p x q over the contour that both surfaces have in common; where it turns round
  from one frame to the next, the bodies have changed sides there. The volume of the deepest overlap is found by sampling;
- edges of a body are cut with its own triangles that are more than two elements away;
- elongated bodies have centre lines (means of cross-sections): where two of them cross as seen along the line between them,
  neither may be half a thickness on the other side later. That sees a passage between two frames as well;
- nodes, in closed obstacles also places on edges, are looked at in the rigid obstacles (obstacles.py), and corners of these in bodies.

Local thickness tau of a facet: the way from its centre inward to where it leaves the undeformed body, if the surface there faces
the other way (n.n' < -0.5), at most twice the radius of the largest ball around the centre of an element or a face, or an inner
node. A place inside is judged by the lesser of the largest tau of the facets at its own edge and of those around the nearest
facet of the other body. No place within a body is deeper than half the body's thickness; the rims of a thin part of a thicker
body count as thick.

Verdicts: `held`, no place is deeper than `fraction` of tau; `told`, one is, or bodies have changed sides, and the run says so:
`contact.unverified` is not 0, a warning speaks of penetration, or the run failed; `silent`, it does not; `ended`, not deep, and
the run failed; `unread`, there are no results to judge. Exit code 1 if a run is `silent`.
"""

import argparse
import json
import math
import pathlib
import re
import sys
import xml.etree.ElementTree
from dataclasses import dataclass, field

import numpy as np

import obstacles as rigid
import vtu
from overlap import (
    FACES,
    CentreLine,
    Nearest,
    Surface,
    cross,
    crossings,
    cuts,
    distances,
    facet_normals,
    near_pairs,
    outside,
    simplices,
    units,
    winding,
    within_elements,
)

FRACTION = 0.25
# Places on each piece of an edge that is inside another body.
PLACES = 11
SOLIDS = {10, 12, 13, 24}
# A warning that speaks of bodies inside each other.
TOLD = re.compile(r"penetrat|unverified|inside (a|another|the) body|without being in contact|overlap|go(es)? through", re.I)


@dataclass
class Frame:
    time: float
    points: np.ndarray
    alive: np.ndarray | None = None
    gap: np.ndarray | None = None


class Body:
    """A connected piece of the mesh."""

    def __init__(self, part, name, cells, points, dimension):
        """`cells` are (kind, cell number, nodes)."""
        self.part, self.name, self.dimension = part, name, dimension
        self.numbers = {
            kind: np.array([cell[1] for cell in cells if cell[0] == kind]) for kind in sorted({cell[0] for cell in cells})
        }
        self.cells = {kind: np.array([cell[2] for cell in cells if cell[0] == kind]) for kind in self.numbers}
        self.nodes = np.unique(np.concatenate([nodes.ravel() for nodes in self.cells.values()]))
        self.skin(points, None)
        self.rings = None
        self.measure(points)

    def skin(self, points, alive):
        """The surface of the elements that are alive, outward in the first frame."""
        cells = {kind: nodes if alive is None else nodes[alive[self.numbers[kind]]] for kind, nodes in self.cells.items()}
        self.surface = Surface(outside(cells, points), len(points), self.dimension)

    def measure(self, points):
        """Local thickness at each vertex of the surface, and half the thickness of the whole."""
        surface, vertices = self.surface, self.surface.place(points)
        corners = vertices[surface.facets]
        inner = np.setdiff1d(self.nodes, surface.nodes)
        balls = [points[nodes].mean(axis=1) for nodes in self.cells.values()]
        balls += [points[nodes[:, list(face)]].mean(axis=1) for kind, nodes in self.cells.items() for face in FACES[kind]]
        balls = np.concatenate([*balls, points[inner]])
        self.radius = float(Nearest(vertices, surface.facets)(balls)[0].max())
        normals = units(facet_normals(corners))
        centres, size = corners.mean(1), np.linalg.norm(vertices.max(0) - vertices.min(0))
        tau = np.full(len(corners), 2.0 * self.radius)
        step = max(1, 2_000_000 // max(1, len(corners)))
        for begin in range(0, len(corners), step):
            part = slice(begin, begin + step)
            rays = np.stack([centres[part], centres[part] - 2.0 * size * normals[part]], axis=1)
            i, j = (k.ravel() for k in np.meshgrid(np.arange(len(rays)), np.arange(len(corners)), indexing="ij"))
            i, j, t = cuts(rays, corners, (i, j))
            length = 2.0 * size * t
            far = (j != i + begin) & (length > 1e-6 * self.radius)
            i, j, length = i[far], j[far], length[far]
            order = np.lexsort((length, i))
            first = np.unique(i[order], return_index=True)[1]
            i, j, length = i[order][first], j[order][first], length[order][first]
            opposite = (normals[i + begin] * normals[j]).sum(1) < -0.5
            tau[i[opposite] + begin] = np.minimum(tau[i[opposite] + begin], length[opposite])
        self.tau = np.zeros(len(vertices))
        np.maximum.at(self.tau, surface.facets.ravel(), np.repeat(tau, surface.facets.shape[1]))

    def around(self, nodes):
        """Mask of the nodes of elements within two rings of elements around nodes."""
        if self.rings is None:
            pairs = [
                nodes[:, [i, j]] for nodes in self.cells.values() for i in range(nodes.shape[1]) for j in range(nodes.shape[1])
            ]
            pairs = np.unique(np.concatenate(pairs), axis=0)
            self.rings = pairs[:, 1], np.searchsorted(pairs[:, 0], np.arange(self.nodes.max() + 2))
        to, starts = self.rings
        mask = np.zeros(self.nodes.max() + 1, dtype=bool)
        for _ in range(2):
            nodes = np.unique(np.concatenate([to[starts[n] : starts[n + 1]] for n in nodes]))
        mask[nodes] = True
        return mask

    def facet_tau(self):
        return self.tau[self.surface.facets].max(axis=1)


@dataclass
class Overlap:
    """How deep two bodies (or a body in itself) are in each other in one frame."""

    depth: float = 0.0
    tau: float = math.inf
    place: tuple = (0.0, 0.0, 0.0)
    area: np.ndarray = field(default_factory=lambda: np.zeros(3))
    nodes: list = field(default_factory=list)
    deepest_node: float = 0.0
    # The box around it.
    low: np.ndarray = field(default_factory=lambda: np.full(3, np.inf))
    high: np.ndarray = field(default_factory=lambda: np.full(3, -np.inf))

    @property
    def ratio(self):
        return self.depth / self.tau if self.depth > 0 else 0.0

    def deepen(self, places, depth, tau):
        """Keeps the deepest place by its share of the thickness."""
        worst = int(np.argmax(depth / tau))
        if depth[worst] / tau[worst] > self.ratio:
            self.depth, self.tau, self.place = float(depth[worst]), float(tau[worst]), tuple(places[worst].tolist())


class Placed:
    """A body in one frame."""

    def __init__(self, body, points):
        self.body = body
        self.vertices = body.surface.place(points)
        self.corners = self.vertices[body.surface.facets]
        self.low, self.high = self.vertices.min(0), self.vertices.max(0)
        self._nearest = None

    def nearest(self, places):
        if self._nearest is None:
            self._nearest = Nearest(self.vertices, self.body.surface.facets)
        return self._nearest(places)

    def edges(self):
        return self.vertices[self.body.surface.edges]


def pieces(placed, other, edge, at):
    """What of the edges of a body is inside another: edge and place along it of samples; and vertices inside."""
    surface = placed.body.surface
    box = ((placed.vertices >= other.low) & (placed.vertices <= other.high)).all(axis=1)
    inside = np.zeros(len(placed.vertices), dtype=bool)
    candidates = np.flatnonzero(box)
    if len(candidates):
        inside[candidates] = winding(placed.vertices[candidates], other.corners) > 0.5
    order = np.lexsort((at, edge))
    edge, at = edge[order], at[order]
    whole = np.setdiff1d(np.flatnonzero(inside[surface.edges].all(axis=1)), edge)
    begins, ends, of = [np.zeros(len(whole))], [np.ones(len(whole))], [whole]
    if len(edge):
        numbers = np.unique(edge)
        starts = np.concatenate([np.stack([numbers, np.zeros(len(numbers))], 1), np.stack([edge, at], 1)])
        stops = np.concatenate([np.stack([edge, at], 1), np.stack([numbers, np.ones(len(numbers))], 1)])
        starts, stops = (x[np.lexsort((x[:, 1], x[:, 0]))] for x in (starts, stops))
        number, begin, end = starts[:, 0].astype(int), starts[:, 1], stops[:, 1]
        line = placed.vertices[surface.edges[number]]
        middle = line[:, 0] + (0.5 * (begin + end))[:, None] * (line[:, 1] - line[:, 0])
        goes = (end > begin) & (winding(middle, other.corners) > 0.5)
        begins, ends, of = begins + [begin[goes]], ends + [end[goes]], of + [number[goes]]
    return inside, np.concatenate(of).astype(int), np.concatenate(begins), np.concatenate(ends)


def one_way(placed, other, edge, at, found):
    """Depths of a body's edges and nodes in another; the deepest, by its share of the thickness, goes to `found`."""
    surface = placed.body.surface
    inside, of, begin, end = pieces(placed, other, edge, at)
    if not len(of) and not inside.any():
        return
    share = (np.arange(PLACES) + 0.5) / PLACES
    line = placed.vertices[surface.edges[of]]
    ends = [line[:, 0] + x[:, None] * (line[:, 1] - line[:, 0]) for x in (begin, end)]
    corners = np.concatenate([*ends, placed.vertices[inside]])
    found.low, found.high = np.minimum(found.low, corners.min(0)), np.maximum(found.high, corners.max(0))
    t = (begin[:, None] + share * (end - begin)[:, None]).ravel()
    number = np.repeat(of, PLACES)
    line = placed.vertices[surface.edges[number]]
    places = line[:, 0] + t[:, None] * (line[:, 1] - line[:, 0])
    own = placed.body.tau[surface.edges[number]].max(axis=1) if len(number) else np.empty(0)
    within = np.flatnonzero(inside)
    places, own = np.concatenate([places, placed.vertices[within]]), np.concatenate([own, placed.body.tau[within]])
    depth, foot = other.nearest(places)
    tau = np.minimum(own, other.body.facet_tau()[foot])
    for number, distance in zip(within.tolist(), depth[len(depth) - len(within) :].tolist()):
        if surface.vertices[number] < surface.nodes_below:
            found.nodes.append((int(surface.vertices[number]), distance))
            found.deepest_node = max(found.deepest_node, distance)
    # An edge that passes just between two facets may have missed both: the deepest places are asked once more.
    order = np.argsort(-depth / tau, kind="stable")
    for begin in range(0, len(order), 16):
        some = order[begin : begin + 16]
        some = some[winding(places[some], other.corners) > 0.5]
        if len(some):
            found.deepen(places[some], depth[some], tau[some])
            break


def area_vector(first, second, cut_ab, cut_ba):
    """Integral of the outward normal over what of the first surface is inside the second, from the contour of both."""
    if first.body.dimension == 2:
        edge, facet, at = cut_ab
        inside, of, begin, end = pieces(first, second, edge, at)
        line = first.vertices[first.body.surface.edges[of]]
        return ((end - begin)[:, None] * facet_normals(line)).sum(0) if len(of) else np.zeros(3)
    keys, places = [], []
    for placed, (edge, facet, at), mine in ((first, cut_ab, True), (second, cut_ba, False)):
        line = placed.vertices[placed.body.surface.edges[edge]]
        place = line[:, 0] + at[:, None] * (line[:, 1] - line[:, 0])
        for side in (0, 1):
            beside = placed.body.surface.beside[edge, side]
            keys.append(np.stack([beside, facet] if mine else [facet, beside], axis=1))
            places.append(place)
    keys, places = np.concatenate(keys), np.concatenate(places)
    if not len(keys):
        return np.zeros(3)
    pairs, back, count = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
    order = np.argsort(back.reshape(-1), kind="stable")
    starts = np.cumsum(count) - count
    good = count >= 2
    ends = []
    for begin, many in zip(starts[good].tolist(), count[good].tolist()):
        # Two places, or where edges meet the same place twice: those farthest apart.
        mine = places[order[begin : begin + many]]
        first_end = mine[np.argmax(((mine - mine[0]) ** 2).sum(1))]
        ends.append((first_end, mine[np.argmax(((mine - first_end) ** 2).sum(1))]))
    p, q = np.moveaxis(np.array(ends).reshape(-1, 2, 3), 1, 0)
    na, nb = facet_normals(first.corners[pairs[good, 0]]), facet_normals(second.corners[pairs[good, 1]])
    turn = np.sign(((q - p) * cross(na, nb)).sum(1))[:, None]
    centre = places.mean(0)
    return 0.5 * (turn * cross(p - centre, q - centre)).sum(0)


def overlap(first, second):
    """The overlap of two placed bodies, or None."""
    if (first.high < second.low).any() or (second.high < first.low).any():
        return None
    one, two = first.edges(), second.edges()
    near_one = np.flatnonzero(((one.max(1) >= second.low) & (one.min(1) <= second.high)).all(1))
    near_two = np.flatnonzero(((two.max(1) >= first.low) & (two.min(1) <= first.high)).all(1))
    edge, facet, at = cuts(one[near_one], second.corners)
    cut_ab = (near_one[edge], facet, at)
    edge, facet, at = cuts(two[near_two], first.corners)
    cut_ba = (near_two[edge], facet, at)
    if not len(cut_ab[0]) and not len(cut_ba[0]):
        alone = [(a, b) for a, b in ((first, second), (second, first)) if (a.low >= b.low).all() and (a.high <= b.high).all()]
        if not any(winding(a.vertices[:1], b.corners)[0] > 0.5 for a, b in alone):
            return None
    found = Overlap()
    one_way(first, second, cut_ab[0], cut_ab[2], found)
    one_way(second, first, cut_ba[0], cut_ba[2], found)
    found.area = area_vector(first, second, cut_ab, cut_ba)
    return found


def in_obstacle(placed, obstacle):
    """The overlap of a placed body with a rigid obstacle, or None."""
    body, surface = placed.body, placed.body.surface
    found = Overlap()
    places, tau = placed.vertices, body.tau
    if not obstacle.is_flat:
        low, high = obstacle.box()
        if (placed.high < low).any() or (high < placed.low).any():
            return None
        share = (np.arange(PLACES) + 0.5) / PLACES
        line = placed.edges()
        near = ((line.max(1) >= low) & (line.min(1) <= high)).all(axis=1)
        line = line[near]
        on_edges = line[:, None, 0] + share[None, :, None] * (line[:, 1] - line[:, 0])[:, None]
        places = np.concatenate([places, on_edges.reshape(-1, 3)])
        tau = np.concatenate([tau, np.repeat(body.tau[surface.edges[near]].max(axis=1), PLACES)])
        near = ((places >= low) & (places <= high)).all(axis=1)
        places, tau = places[near], tau[near]
        corners = np.unique(obstacle.corners.reshape(-1, 3), axis=0)
        corners = corners[((corners >= placed.low) & (corners <= placed.high)).all(axis=1)]
        if len(corners) and obstacle.is_closed:
            corners = corners[winding(corners, placed.corners) > 0.5]
            if len(corners):
                depth, foot = placed.nearest(corners)
                found.deepen(corners, depth, body.facet_tau()[foot])
    depth = obstacle.depths(places)
    if (depth > 0).any():
        found.deepen(places[depth > 0], depth[depth > 0], tau[depth > 0])
    return found if found.depth > 0 else None


def self_overlap(placed, points, limit=600):
    """The overlap of a body with itself beyond two rings of elements, or None."""
    body, surface = placed.body, placed.body.surface
    edges, behind = placed.edges(), surface.behind
    of_facet = behind[surface.facets].reshape(len(surface.facets), -1)
    i, j = near_pairs(edges.min(1), edges.max(1), placed.corners.min(1), placed.corners.max(1))
    far = ~(behind[surface.edges[i]].reshape(len(i), -1)[:, :, None] == of_facet[j][:, None, :]).any((1, 2))
    edge, facet, _ = cuts(edges, placed.corners, (i[far], j[far]))
    rings = {number: body.around(np.unique(behind[surface.edges[number]])) for number in np.unique(edge).tolist()}
    far = np.array([not rings[a][of_facet[b]].any() for a, b in zip(edge.tolist(), facet.tolist())], dtype=bool)
    if not far.any():
        return None
    near = np.unique(np.concatenate([surface.edges[edge[far]].ravel(), surface.facets[facet[far]].ravel()]))
    around = np.flatnonzero(np.isin(surface.edges, near).any(axis=1))[:limit]
    share = (np.arange(PLACES) + 0.5) / PLACES
    line = placed.vertices[surface.edges[around]]
    places = line[:, None, 0] + share[None, :, None] * (line[:, 1] - line[:, 0])[:, None]
    corners, owners = simplices(body.cells, points)
    found, facet_tau = Overlap(), body.facet_tau()
    i, j = within_elements(places.reshape(-1, 3), corners)
    for k in np.unique(i // PLACES).tolist():
        number = around[k]
        ring = rings[number] if number in rings else body.around(np.unique(behind[surface.edges[number]]))
        mine = i // PLACES == k
        inside = np.unique(i[mine][~ring[owners[j[mine]]].any(axis=1)])
        if not len(inside):
            continue
        mine = places.reshape(-1, 3)[inside]
        low, high = mine.min(0) - 1.5 * body.radius, mine.max(0) + 1.5 * body.radius
        others = np.flatnonzero(
            ((placed.corners.max(1) >= low) & (placed.corners.min(1) <= high)).all(1) & ~ring[of_facet].any(axis=1)
        )
        if len(others):
            away = distances(mine, placed.corners[others])
            foot = away.argmin(1)
            depth = away[np.arange(len(mine)), foot]
            found.deepen(mine, depth, np.minimum(body.tau[surface.edges[number]].max(), facet_tau[others[foot]]))
    return found if found.depth > 0 else None


@dataclass
class Judgement:
    """What became of a run."""

    name: str
    verdict: str
    ratio: float = 0.0
    depth: float = 0.0
    where: str = ""
    time: float = 0.0
    volume: float = 0.0
    changed: list = field(default_factory=list)
    said: list = field(default_factory=list)
    notes: list = field(default_factory=list)
    claims: dict = field(default_factory=dict)

    def line(self):
        text = f"{self.verdict:7} {self.name}: {self.ratio:.2f} of the thickness"
        if self.depth > 0:
            text += f", {self.depth:.3g} m at {self.time:.3g} s, {self.where}"
        return "; ".join([text, *self.changed[:2], *(f"run says: {said}" for said in self.said[:2]), *self.notes])


def bodies_of(points, cells, parts, names, dimension):
    """Connected pieces of the cells (kind, cell number, nodes), in the order of their lowest cell."""
    parent = list(range(len(points)))

    def root(n):
        while parent[n] != n:
            parent[n] = parent[parent[n]]
            n = parent[n]
        return n

    for _, _, nodes in cells:
        for node in nodes[1:]:
            a, b = root(nodes[0]), root(node)
            parent[max(a, b)] = min(a, b)
    groups = {}
    for cell in cells:
        groups.setdefault(root(cell[2][0]), []).append(cell)
    bodies = []
    for group in sorted(groups.values(), key=lambda group: group[0][1]):
        part = int(parts[group[0][1]])
        bodies.append(Body(part, names[part] if part < len(names) else str(part), group, points, dimension))
    for part in sorted({body.part for body in bodies}):
        same = [body for body in bodies if body.part == part]
        for number, body in enumerate(same):
            body.name += f"#{number}" if len(same) > 1 else ""
    return bodies


def volume(first, second, found, count=2000):
    """Volume (area) of the overlap of two bodies, by sampling the box around it: its corners are cuts and vertices inside."""
    dimension = first.body.dimension
    low, size = found.low[:dimension], (found.high - found.low)[:dimension]
    places = np.zeros((count, 3))
    places[:, :dimension] = low + np.random.Generator(np.random.PCG64(1)).random((count, dimension)) * size
    inside = winding(places, first.corners) > 0.5
    inside[inside] = winding(places[inside], second.corners) > 0.5
    return float(inside.mean() * np.prod(size))


class Judge:
    """Looks at frames one after the other."""

    def __init__(self, first, cells, parts, names, fraction=FRACTION, pairs=None):
        kinds = {kind for kind, _, _ in cells}
        self.dimension = 3 if kinds & SOLIDS else 2
        solid = [cell for cell in cells if cell[0] in (SOLIDS if self.dimension == 3 else {5, 9})]
        self.initial, self.fraction = first, fraction
        self.bodies = bodies_of(first, solid, parts, names, self.dimension)
        self.lines = [CentreLine(body.nodes, first, self.dimension) for body in self.bodies]
        self.deepest, self.where, self.time, self.volume = Overlap(), "", 0.0, 0.0
        self.changed, self.notes, self.areas, self.orders = [], [], {}, {}
        self.seen, self.travel, self.last = {}, 0.0, None
        self.alive = None
        self.true_depth, self.unseen_gap = 0.0, 0

    def look(self, frame, obstacles=()):
        if frame.alive is not None and not frame.alive.all() and (self.alive is None or (self.alive != frame.alive).any()):
            for body in self.bodies:
                if not all(frame.alive[numbers].all() for numbers in body.numbers.values()):
                    body.skin(self.initial, frame.alive)
                    body.tau = np.full(len(body.surface.vertices), 2.0 * body.radius)
            self.alive = frame.alive
        placed = [Placed(body, frame.points) if body.surface.count else None for body in self.bodies]
        for i, one in enumerate(placed):
            if one is None:
                continue
            self.keep(self_overlap(one, frame.points), frame, one.body.name + " in itself", None)
            for number, obstacle in enumerate(obstacles):
                self.keep(in_obstacle(one, obstacle), frame, f"{one.body.name} in obstacle {number}", None)
            for j in range(i + 1, len(placed)):
                two = placed[j]
                if two is None:
                    continue
                found = overlap(one, two)
                where = f"{one.body.name} and {two.body.name}"
                self.keep(found, frame, where, (one, two))
                self.turned(i, j, found, frame, where)
                self.order(i, j, frame, where)
        self.step(frame)

    def keep(self, found, frame, where, pair):
        if found is None:
            return
        self.true_depth = max(self.true_depth, found.depth)
        if found.ratio > self.deepest.ratio:
            self.deepest, self.where, self.time = found, where, frame.time
            self.volume = volume(*pair, found) if pair and found.ratio > self.fraction else 0.0
        if frame.gap is not None:
            for node, depth in found.nodes:
                gap = frame.gap[node]
                if depth > 0.1 * found.tau and not gap < 0:
                    self.unseen_gap += 1

    def turned(self, i, j, found, frame, where):
        """Whether the area vector has turned round since the last frame."""
        if found is None:
            self.areas.pop((i, j), None)
            return
        before = self.areas.get((i, j))
        now = (found.area, found.ratio)
        if before is not None:
            sizes = np.linalg.norm(before[0]), np.linalg.norm(now[0])
            least = 0.02 * (2 * min(self.bodies[i].radius, self.bodies[j].radius)) ** (self.dimension - 1)
            turned = before[0] @ now[0] < -0.5 * sizes[0] * sizes[1]
            if turned and min(sizes) > least and max(before[1], now[1]) > self.fraction:
                self.change(f"the overlap of {where} turns round by {frame.time:.3g} s")
        self.areas[(i, j)] = now

    def order(self, i, j, frame, where):
        """Whether centre lines that cross have changed their order since the last frame."""
        if not self.lines[i].sections or not self.lines[j].sections:
            return
        one, two = self.lines[i].place(frame.points), self.lines[j].place(frame.points)
        state = self.orders.get((i, j))
        if state is None:
            away = one[:, None] - two[None]
            at = np.unravel_index(np.argmin((away**2).sum(-1)), away.shape[:2])
            # Along the common normal of the lines where they are nearest.
            tangents = [np.gradient(line, axis=0)[k] for line, k in ((one, at[0]), (two, at[1]))]
            direction = cross(*tangents)
            if np.linalg.norm(direction) < 0.2 * np.linalg.norm(tangents[0]) * np.linalg.norm(tangents[1]):
                direction = away[at]
            size = np.linalg.norm(direction)
            if size == 0:
                return
            state = [direction / size, None, 0.0]
            self.orders[(i, j)] = state
        now = crossings(one, two, state[0])
        before, state[1] = state[1], now
        # One crossing that goes on; else it is another one, and what was known of its sides is gone.
        goes_on = before is not None and len(before) == 1 and len(now) == 1
        if not goes_on or max(abs(now[0][k] - before[0][k]) for k in (0, 1)) >= 0.2:
            state[2] = 0.0
        if len(now) != 1:
            return
        s, t, height = now[0]
        # Soft bodies are squeezed until their centre lines meet: only what is half a thickness on the other side is through.
        if abs(height) >= min(self.bodies[i].radius, self.bodies[j].radius):
            if state[2] * height < 0 and 0.1 < s < 0.9 and 0.1 < t < 0.9:
                self.change(f"the centre lines of {where} change sides by {frame.time:.3g} s")
            state[2] = height

    def change(self, text):
        self.changed.append(text)

    def step(self, frame):
        """How far bodies move against each other between frames, as a share of the least thickness."""
        mean = [frame.points[body.nodes].mean(0) for body in self.bodies]
        if self.last is not None and len(mean) > 1:
            moved = np.array(mean) - np.array(self.last)
            least = min(2 * body.radius for body in self.bodies)
            self.travel = max(self.travel, float(np.linalg.norm(moved[:, None] - moved[None], axis=-1).max()) / least)
        self.last = mean

    def verdict(self, name, summary):
        """What the frames show, held against what the run says."""
        contact = summary.get("contact") or {}
        unverified, warnings = contact.get("unverified") or 0, summary.get("warnings") or []
        said = [f"{unverified} unverified"] if unverified else []
        said += [text.splitlines()[0][:100] for text in warnings if TOLD.search(text)]
        error = summary.get("error")
        failed = summary.get("status") == "failed"
        said += [str(error).splitlines()[0][:100]] if failed else []
        bad = self.deepest.ratio > self.fraction or self.changed
        result = Judgement(name, ("told" if said else "silent") if bad else ("ended" if failed else "held"))
        result.ratio, result.depth, result.where = self.deepest.ratio, self.deepest.depth, self.where
        result.time, result.volume, result.changed, result.said = self.time, self.volume, self.changed, said
        result.notes = list(self.notes)
        claimed = summary.get("penetration_max")
        result.claims = {"penetration_max": claimed, "true_depth": self.true_depth, "unverified": unverified}
        result.claims["energy_drift"] = summary.get("energy_drift")
        if claimed is not None and self.true_depth > 2 * claimed and self.deepest.ratio > 0.1:
            result.notes.append(f"penetration_max is {claimed:.3g} m, found {self.true_depth:.3g} m")
        if self.unseen_gap:
            result.notes.append(f"contact_gap is not negative at {self.unseen_gap} nodes inside")
        if (summary.get("energy_drift") or 0) > 0.01:
            result.notes.append(f"drift {summary['energy_drift']:.2g}")
        if self.travel > 0.5:
            result.notes.append(f"bodies move by {self.travel:.2g} of the least thickness between frames")
        return result


def read(path):
    """A frame of a result folder: the frame, and its cells (kind, number, nodes) and parts."""
    grid, points, found = vtu.read(path)
    cells = [(kind, number, nodes) for number, (kind, nodes) in enumerate(found)]
    alive, part = vtu.array(grid.GetCellData(), "alive"), vtu.array(grid.GetCellData(), "part")
    time = vtu.array(grid.GetFieldData(), "TimeValue")
    frame = Frame(float(np.ravel(time)[0]) if time is not None else 0.0, points)
    frame.alive, frame.gap = None if alive is None else alive > 0.5, vtu.array(grid.GetPointData(), "contact_gap")
    return frame, cells, part


def judge(folder, fraction=FRACTION, name=None):
    """The judgement of a result folder."""
    folder = pathlib.Path(folder)
    name = name or folder.name
    try:
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        frames = vtu.collection(folder / "fields.pvd")
        first, cells, parts = read(frames[0])
    except (OSError, ValueError, IndexError, xml.etree.ElementTree.ParseError) as error:
        return Judgement(name, "unread", notes=[repr(error)[:160]])
    looks = Judge(first.points, cells, parts, summary.get("parts", []), fraction)
    tools = rigid.files(folder)
    for number, path in enumerate(frames):
        frame = read(path)[0]
        if not np.isfinite(frame.points).all():
            looks.notes.append(f"a frame at {frame.time:.3g} s is not finite")
            break
        looks.look(frame, rigid.read(tools[number]) if number < len(tools) else ())
    return looks.verdict(name, summary)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=pathlib.Path)
    parser.add_argument("--fraction", type=float, default=FRACTION, help="depth over the local thickness that is too deep")
    parser.add_argument("--json", action="store_true", help="one JSON object per run")
    options = parser.parse_args()
    silent = 0
    for folder in options.folders:
        result = judge(folder, options.fraction)
        silent += result.verdict == "silent"
        print(json.dumps(result.__dict__) if options.json else result.line())
    return 1 if silent else 0


if __name__ == "__main__":
    sys.exit(main())
