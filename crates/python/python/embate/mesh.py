"""Meshes of numpy arrays, meshio, gmsh and pyvista, as embate reads them: the bytes of a .msh file, so that they are checked as those of files are.

None of those packages is imported: an object is known by what it has.
"""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from . import _embate

#: Names of cells (meshio's) -> number of the type in .msh files, nodes, dimension.
KINDS: dict[str, tuple[int, int, int]] = {kind["name"]: (kind["gmsh"], kind["nodes"], kind["dimension"]) for kind in _embate.cells()}
#: Other names: VTK's and some that people use.
OTHER_NAMES = {
    "point": "vertex",
    "points": "vertex",
    "lines": "line",
    "triangles": "triangle",
    "quads": "quad",
    "quadrilateral": "quad",
    "tetrahedron": "tetra",
    "tets": "tetra",
    "hexahedra": "hexahedron",
    "hexa": "hexahedron",
    "hex": "hexahedron",
    "wedges": "wedge",
    "prism": "wedge",
}
#: Cells of second order of which the corners, the first nodes, are taken: names, and types of Gmsh.
REDUCED: dict[str | int, str] = {
    "line3": "line",
    "quad8": "quad",
    "quad9": "quad",
    "hexahedron20": "hexahedron",
    "hexahedron27": "hexahedron",
    "wedge15": "wedge",
    "wedge18": "wedge",
    8: "line",
    10: "quad",
    12: "hexahedron",
    13: "wedge",
    16: "quad",
    17: "hexahedron",
    18: "wedge",
}
#: Where a .msh file has the nodes of a cell otherwise than VTK and meshio: the last two of a ten-node tetrahedron are exchanged.
GMSH_ORDER = {"tetra10": [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]}
#: Types of VTK cells, pixels and voxels among them.
VTK: dict[int, str] = {kind["vtk"]: kind["name"] for kind in _embate.cells()} | {8: "quad", 11: "hexahedron"}
#: Pixels and voxels count their nodes row by row, not around.
ROWS = {8: [0, 1, 3, 2], 11: [0, 1, 3, 2, 4, 5, 7, 6]}


class Mesh:
    """Points and named groups of cells.

    Parameters
    ----------
    points : array, shape (n, 2) or (n, 3)
        Positions, in metres (or in the unit that ``scale`` of the part's mesh says).
    cells : dict of array
        Nodes of cells by their kind (``quad``, ``triangle``, ``triangle6``, ``hexahedron``, ``tetra``, ``tetra10``, ``wedge``, ``line``, ``vertex``), counted from 0 and in the order of VTK.
    groups : dict, optional
        Name -> {kind: indices of cells of that kind}. Without groups all cells of the highest dimension are the group ``all``.
    """

    def __init__(
        self,
        points: Any,
        cells: Mapping[str, Any],
        groups: Mapping[str, Mapping[str, Any]] | None = None,
    ) -> None:
        self.points = _points(points)
        self.cells: dict[str, np.ndarray[Any, Any]] = {}
        if not isinstance(cells, Mapping) or not cells:
            raise TypeError("cells: a dict of arrays by the kind of cell is wanted, {'quad': array of shape (n, 4)} for example")
        for name, nodes in cells.items():
            kind = _kind(name)
            self.cells[kind] = _nodes(nodes, kind, len(self.points))
        if groups is None:
            dimension = max(KINDS[kind][2] for kind in self.cells)
            groups = {"all": {kind: np.arange(len(nodes)) for kind, nodes in self.cells.items() if KINDS[kind][2] == dimension}}
        self.groups = {str(name): {_kind(kind): _indices(name, kind, which, self.cells) for kind, which in parts.items()} for name, parts in groups.items()}

    def used(self) -> np.ndarray[Any, Any]:
        """Which points belong to cells of the highest dimension of a group: the others are left out."""
        kinds = [(kind, which) for parts in self.groups.values() for kind, which in parts.items() if len(which)]
        highest = max((KINDS[kind][2] for kind, _ in kinds), default=0)
        used = np.zeros(len(self.points), bool)
        for kind, which in kinds:
            if KINDS[kind][2] == highest:
                used[self.cells[kind][which]] = True
        return used

    def bytes(self) -> bytes:
        """A .msh file of version 2.2, binary."""
        out = io.BytesIO()
        out.write(b"$MeshFormat\n2.2 1 8\n")
        out.write(np.array([1], "<i4").tobytes())
        out.write(b"\n$EndMeshFormat\n")
        groups = [(name, dimension, {k: i for k, i in parts.items() if KINDS[k][2] == dimension}) for name, parts in self.groups.items() for dimension in sorted({KINDS[k][2] for k in parts})]
        out.write(f"$PhysicalNames\n{len(groups)}\n".encode())
        for tag, (name, dimension, _) in enumerate(groups, 1):
            if '"' in name or "\n" in name:
                raise ValueError(f"groups: the name {name!r} can't hold quotes or line ends")
            out.write(f'{dimension} {tag} "{name}"\n'.encode())
        out.write(b"$EndPhysicalNames\n")
        nodes = np.empty(len(self.points), dtype=[("tag", "<i4"), ("x", "<f8", 3)])
        nodes["tag"] = np.arange(len(self.points))
        nodes["x"] = self.points
        out.write(f"$Nodes\n{len(nodes)}\n".encode())
        out.write(nodes.tobytes())
        out.write(b"\n$EndNodes\n")
        runs, count = [], 0
        for tag, (_, _, parts) in enumerate(groups, 1):
            for kind, which in parts.items():
                number, size, _ = KINDS[kind]
                rows = np.empty((len(which), 3 + size), "<i4")
                rows[:, 0] = which
                rows[:, 1:3] = tag
                rows[:, 3:] = self.cells[kind][which][:, GMSH_ORDER.get(kind, range(size))]
                if len(which):
                    runs.append(np.array([number, len(which), 2], "<i4").tobytes() + rows.tobytes())
                count += len(which)
        out.write(f"$Elements\n{count}\n".encode())
        out.write(b"".join(runs))
        out.write(b"\n$EndElements\n")
        return out.getvalue()


def mesh_of(what: Any) -> Mesh | None:
    """A mesh from what people have; None where it is none of these."""
    if isinstance(what, Mesh):
        return what
    if isinstance(what, tuple) and len(what) == 2 and not isinstance(what[0], (str, int, float)):
        points, cells = what
        return Mesh(points, cells if isinstance(cells, Mapping) else {_kind_of_array(cells): cells})
    if isinstance(what, Mapping):
        if "points" not in what:
            return None
        unknown = set(what) - {"points", "cells", "groups"}
        if unknown:
            raise TypeError(f"mesh: a mesh of arrays has points, cells and groups, not {', '.join(sorted(map(str, unknown)))}")
        return Mesh(what["points"], what.get("cells", {}), what.get("groups"))
    if hasattr(what, "celltypes") and hasattr(what, "points"):
        return _of_pyvista(what)
    if hasattr(what, "cells_dict") and hasattr(what, "points"):
        return _of_meshio(what)
    if hasattr(what, "regular_faces") and hasattr(what, "cast_to_unstructured_grid"):
        return _of_pyvista(what.cast_to_unstructured_grid())
    if hasattr(what, "model") and hasattr(getattr(what, "model"), "mesh"):
        return _of_gmsh(what.model)
    if hasattr(what, "mesh") and hasattr(what, "getPhysicalGroups"):
        return _of_gmsh(what)
    return None


def _points(points: Any) -> np.ndarray[Any, Any]:
    array = _numbers(points, "points")
    if array.ndim != 2 or array.shape[1] not in (2, 3):
        raise ValueError(f"points has the shape {array.shape}; (n, 2) or (n, 3) is wanted, one row for each node")
    if not np.isfinite(array).all():
        row = int(np.argwhere(~np.isfinite(array).all(axis=1))[0, 0])
        raise ValueError(f"points[{row}] is {array[row].tolist()}: coordinates are finite numbers")
    if array.shape[1] == 2:
        array = np.column_stack([array, np.zeros(len(array))])
    return array


def _numbers(values: Any, name: str) -> np.ndarray[Any, Any]:
    array = np.asarray(values)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name} has the dtype {array.dtype}; real numbers are wanted")
    return np.ascontiguousarray(array, dtype=np.float64)


def _kind(name: str) -> str:
    kind = OTHER_NAMES.get(str(name).lower(), str(name).lower())
    if kind not in KINDS:
        raise ValueError(f"cells: there is no kind {name!r}; known are {', '.join(KINDS)}")
    return kind


def _kind_of_array(cells: Any) -> str:
    shape = np.shape(cells)
    found = {2: "line", 3: "triangle", 4: "quad", 6: "wedge", 8: "hexahedron"}.get(shape[1] if len(shape) == 2 else 0)
    if found is None:
        raise ValueError(f"cells has the shape {shape}; (n, 4) is wanted for quads, (n, 3) for triangles, (n, 8) for hexahedra; name others, {{'tetra': array}}")
    return found


def _nodes(nodes: Any, kind: str, points: int) -> np.ndarray[Any, Any]:
    array, size, name = np.asarray(nodes), KINDS[kind][1], f"cells[{kind!r}]"
    if array.size == 0:
        return np.empty((0, size), np.int32)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name} has the dtype {array.dtype}; numbers of nodes are integers")
    if kind == "vertex" and array.ndim == 1:
        array = array[:, None]
    if array.ndim != 2 or array.shape[1] != size:
        raise ValueError(f"{name} has the shape {array.shape}; (n, {size}) is wanted, one row for each cell")
    if array.min() < 0 or array.max() >= points:
        wrong = int(np.argwhere(((array < 0) | (array >= points)).any(axis=1))[0, 0])
        raise ValueError(f"{name}[{wrong}] is {array[wrong].tolist()}: nodes are counted from 0 to {points - 1}")
    return array.astype(np.int32)


def _indices(group: str, kind: str, which: Any, cells: Mapping[str, np.ndarray[Any, Any]]) -> np.ndarray[Any, Any]:
    array, known, name = np.asarray(which), cells.get(_kind(kind)), f"groups[{group!r}][{kind!r}]"
    if known is None:
        raise ValueError(f"{name}: the mesh has no cells of this kind")
    if array.dtype == bool:
        if array.shape != (len(known),):
            raise ValueError(f"{name} has the shape {array.shape}; a mask has one value for each of {len(known)} cells")
        array = np.flatnonzero(array)
    if array.size and array.dtype.kind not in "iu":
        raise TypeError(f"{name} has the dtype {array.dtype}; indices of cells, or a mask, are wanted")
    array = array.reshape(-1).astype(np.int64)
    if array.size and (array.min() < 0 or array.max() >= len(known)):
        raise ValueError(f"{name} names cell {int(array.max())}; there are {len(known)}")
    return array


def _of_meshio(mesh: Any) -> Mesh:
    """Groups from ``gmsh:physical`` with ``field_data``, else from ``cell_sets``, else one of all."""
    cells: dict[str, list[np.ndarray[Any, Any]]] = {}
    starts: list[tuple[str, int, int]] = []
    for block in mesh.cells:
        kind = REDUCED.get(block.type, OTHER_NAMES.get(block.type, block.type))
        if kind not in KINDS:
            raise ValueError(f"mesh: cells of the kind {block.type!r} can't be computed; known are {', '.join(KINDS)}")
        before = sum(map(len, cells.get(kind, [])))
        cells.setdefault(kind, []).append(np.asarray(block.data)[:, : KINDS[kind][1]])
        starts.append((kind, before, len(block.data)))
    joined = {kind: np.concatenate(blocks) for kind, blocks in cells.items()}
    groups: dict[str, dict[str, Any]] = {}

    def add(name: str, kind: str, which: np.ndarray[Any, Any]) -> None:
        if len(which):
            known = groups.setdefault(name, {})
            known[kind] = np.concatenate([known[kind], which]) if kind in known else which

    physical = (getattr(mesh, "cell_data", None) or {}).get("gmsh:physical")
    if physical is not None:
        names = {(int(tag), int(dimension)): name for name, (tag, dimension) in (getattr(mesh, "field_data", None) or {}).items()}
        for (kind, begin, _), tags in zip(starts, physical):
            dimension = KINDS[kind][2]
            for tag in np.unique(tags):
                if tag:
                    name = names.get((int(tag), dimension), f"{['point', 'curve', 'surface', 'volume'][dimension]}-{int(tag)}")
                    add(name, kind, begin + np.flatnonzero(np.asarray(tags) == tag))
    else:
        for name, blocks in (getattr(mesh, "cell_sets", None) or {}).items():
            if name.startswith("gmsh:"):
                continue
            for (kind, begin, _), which in zip(starts, blocks):
                if which is not None:
                    add(name, kind, begin + np.asarray(which, dtype=np.int64))
    return Mesh(np.asarray(mesh.points), joined, groups or None)


def _of_pyvista(grid: Any) -> Mesh:
    """Groups from the cell array ``group`` (texts or numbers), if there is one."""
    offsets = grid.cell_offsets if hasattr(grid, "cell_offsets") else grid.offset
    types, offsets, connectivity = np.asarray(grid.celltypes), np.asarray(offsets), np.asarray(grid.cell_connectivity)
    found: dict[str, list[tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]]] = {}
    for number in np.unique(types).tolist():
        if number not in VTK:
            raise ValueError(f"mesh: VTK cells of type {number} can't be computed; known are {', '.join(KINDS)}")
        kind, which = VTK[number], np.flatnonzero(types == number)
        nodes = connectivity[offsets[which][:, None] + np.asarray(ROWS.get(number, range(KINDS[kind][1])))]
        found.setdefault(kind, []).append((nodes, which))
    cells = {kind: np.concatenate([nodes for nodes, _ in blocks]) for kind, blocks in found.items()}
    order = {kind: np.concatenate([which for _, which in blocks]) for kind, blocks in found.items()}
    groups = None
    names = grid.cell_data["group"] if "group" in grid.cell_data else None
    if names is not None:
        names = np.asarray(names)
        groups = {str(name): {kind: np.flatnonzero(names[which] == name) for kind, which in order.items() if (names[which] == name).any()} for name in np.unique(names)}
    return Mesh(np.asarray(grid.points), cells, groups)


def _of_gmsh(model: Any) -> Mesh:
    """Of the model that gmsh has now: its physical groups, or all cells of the highest dimension."""
    tags, places, _ = model.mesh.getNodes()
    tags = np.asarray(tags, dtype=np.int64)
    index = np.full(int(tags.max()) + 1 if len(tags) else 1, -1, dtype=np.int64)
    index[tags] = np.arange(len(tags))
    numbers = {number: kind for kind, (number, _, _) in KINDS.items()}
    cells: dict[str, list[np.ndarray[Any, Any]]] = {}
    groups: dict[str, dict[str, Any]] = {}

    def take(entities: Sequence[tuple[int, int]], name: str) -> None:
        for dimension, entity in entities:
            for number, _, nodes in zip(*model.mesh.getElements(dimension, entity)):
                kind = numbers.get(int(number), REDUCED.get(int(number)))
                if kind is None:
                    raise ValueError(f"mesh: elements of gmsh's type {int(number)} can't be computed; mesh with order 1 or 2 and without pyramids")
                size = int(model.mesh.getElementProperties(int(number))[3])
                rows = index[np.asarray(nodes, dtype=np.int64)].reshape(-1, size)[:, GMSH_ORDER.get(kind, range(KINDS[kind][1]))]
                begin = sum(map(len, cells.get(kind, [])))
                cells.setdefault(kind, []).append(rows)
                which, known = np.arange(begin, begin + len(rows)), groups.setdefault(name, {})
                known[kind] = np.concatenate([known[kind], which]) if kind in known else which

    physical = list(model.getPhysicalGroups())
    for dimension, tag in physical:
        name = model.getPhysicalName(dimension, tag) or f"{['point', 'curve', 'surface', 'volume'][dimension]}-{tag}"
        take([(dimension, int(entity)) for entity in model.getEntitiesForPhysicalGroup(dimension, tag)], name)
    if not physical:
        entities = list(model.getEntities())
        highest = max((dimension for dimension, _ in entities), default=0)
        take([(d, t) for d, t in entities if d == highest], "all")
    if not cells:
        raise ValueError("mesh: the model of gmsh has no elements; call gmsh.model.mesh.generate(2) first, 3 for solids")
    return Mesh(np.asarray(places).reshape(-1, 3), {kind: np.concatenate(blocks) for kind, blocks in cells.items()}, groups)
