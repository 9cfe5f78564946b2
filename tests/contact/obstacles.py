"""Rigid obstacles in the results of runs, for `interpenetration.py`: how deep bodies are in them.

They are read from obstacles.pvd. What is flat is a half-space behind its outline, in the plane a half-plane on the right of its line, if
that is long beside the bodies; of many facets with their corners on a sphere the sphere counts;
what is closed has its solid inside, or hollow outside, as its facets are turned; a tube that is open at both ends is a cylinder without
ends. Other open lines and surfaces that are not flat are left out.
Nodes and places on edges of bodies are looked at, and corners of obstacles in bodies.
"""

import xml.etree.ElementTree

import numpy as np
import vtu
from overlap import Nearest, cross, units, winding

FLAT = 1e-9


class Obstacle:
    """One obstacle in one frame: facets as corners (F, 3, 3), in the plane (F, 2, 3)."""

    def __init__(self, corners):
        self.corners = corners
        points = corners.reshape(-1, 3)
        size = np.linalg.norm(np.ptp(points, axis=0))
        if corners.shape[1] == 2:
            along = corners[:, 1] - corners[:, 0]
            normals = units(np.stack([-along[:, 1], along[:, 0], np.zeros(len(along))], axis=1))
        else:
            normals = units(cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
        self.normal, self.point = normals[0], corners[0, 0]
        self.is_flat = bool((np.abs((points - self.point) @ self.normal) < FLAT * size).all())
        ends = {}
        for facet in corners:
            for a, b in zip(facet, np.roll(facet, -1, axis=0)) if len(facet) == 3 else [(facet[0], facet[1])]:
                a, b = tuple(np.round(a / size, 9)), tuple(np.round(b / size, 9))
                for key, sign in [((a, b), 1), ((b, a), -1)] if len(facet) == 3 else [(a, 1), (b, -1)]:
                    ends[key] = ends.get(key, 0) + sign
        self.is_closed = not self.is_flat and not any(ends.values())
        self.nearest = None
        self.axis = self.middle = None
        self.length = size
        arms = points - points.mean(0)
        sizes = np.linalg.norm(arms, axis=1)
        if self.is_closed and len(corners) > 500 and np.ptp(sizes) < 1e-3 * sizes.mean():
            self.middle, self.radius = points.mean(0), sizes.mean()
            self.is_hollow = self.volume() < 0
        if not (self.is_flat or self.is_closed) and corners.shape[1] == 3:
            self.find_axis(points, normals)

    def find_axis(self, points, normals):
        """Takes the axis and the radius of a cylinder, if it is one."""
        axis = np.linalg.svd(normals - normals.mean(0))[2][2] if len(normals) > 2 else np.zeros(3)
        if np.abs(normals @ axis).max() > 1e-4:
            return
        arms = points - points.mean(0)
        arms = arms - np.outer(arms @ axis, axis)
        sizes = np.linalg.norm(arms, axis=1)
        if np.ptp(sizes) < 0.01 * sizes.mean():
            self.axis, self.middle, self.radius = axis, points.mean(0), sizes.mean()
            self.is_hollow = bool((normals * arms.reshape(len(normals), 3, 3).mean(1)).sum() < 0)

    def depths(self, places):
        """How deep places are inside, m; of those outside not more than zero."""
        if self.is_flat and self.corners.shape[1] == 2 and self.length < 5 * np.linalg.norm(np.ptp(places, axis=0)):
            return np.zeros(len(places))  # a plate, beside whose ends bodies go
        if self.is_flat:
            return -(places - self.point) @ self.normal
        if self.middle is not None:
            arms = places - self.middle
            along = 0 if self.axis is None else np.outer(arms @ self.axis, self.axis)
            away = np.linalg.norm(arms - along, axis=1)
            return away - self.radius if self.is_hollow else self.radius - away
        if not self.is_closed:
            return np.zeros(len(places))
        # In the plane the solid is on the right: its outline runs clockwise.
        turns = -winding(places, self.corners) if self.corners.shape[1] == 2 else winding(places, self.corners)
        inside = np.abs(turns - (1.0 if self.volume() > 0 else 0.0)) < 0.5
        depth = np.zeros(len(places))
        if inside.any():
            if self.nearest is None:
                count = self.corners.shape[1]
                facets = np.arange(len(self.corners) * count).reshape(-1, count)
                self.nearest = Nearest(self.corners.reshape(-1, 3), facets)
            depth[inside] = self.nearest(places[inside])[0]
        return depth

    def volume(self):
        """Of the solid within its facets; negative of a hollow one."""
        if self.corners.shape[1] == 2:
            a, b = self.corners[:, 0], self.corners[:, 1]
            return -0.5 * (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum()
        return (self.corners[:, 0] * cross(self.corners[:, 1], self.corners[:, 2])).sum() / 6.0

    def box(self):
        """The box around it."""
        if self.middle is not None and (self.axis is not None or self.is_hollow):
            return np.full(3, -np.inf), np.full(3, np.inf)
        points = self.corners.reshape(-1, 3)
        return points.min(0), points.max(0)


def files(folder):
    """The files of obstacles of all frames."""
    try:
        return vtu.collection(folder / "obstacles.pvd")
    except (OSError, xml.etree.ElementTree.ParseError):
        return []


def read(path):
    """The obstacles of a file."""
    grid, points, cells = vtu.read(path)
    facets = {}
    for number, (kind, nodes) in zip(np.ravel(vtu.array(grid.GetCellData(), "obstacle")).tolist(), cells):
        mine = points[list(nodes)]
        if kind in (3, 4):
            pieces = [mine[k : k + 2] for k in range(len(mine) - 1)]
        else:
            pieces = [mine[[0, k, k + 1]] for k in range(1, len(mine) - 1)]
        facets.setdefault(number, []).extend(pieces)
    return [Obstacle(np.array(facets[number])) for number in sorted(facets)]
