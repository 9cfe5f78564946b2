"""Pictures of bodies by matplotlib, and grids for pyvista."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import _embate
from ._optional import needed

if TYPE_CHECKING:
    from .fields import Fields

#: Faces of solids, outward.
FACES: dict[str, list[list[int]]] = {kind["name"]: kind["faces"] for kind in _embate.cells() if kind["dimension"] == 3}
#: Surfaces, which are polygons as they are.
POLYGONS: set[str] = {kind["name"] for kind in _embate.cells() if kind["dimension"] == 2}
#: Height of bodies over their width below which a legend of colours lies under them.
FLAT = 0.45
#: Units of lengths on axes, m; the data of the axes are in m.
LENGTHS = (("m", 1.0), ("mm", 1e-3), ("µm", 1e-6))
VTK: dict[str, int] = {kind["name"]: kind["vtk"] for kind in _embate.cells()}


def plot(
    state: Fields,
    field: str | None = None,
    ax: Any = None,
    *,
    component: str | int | None = None,
    edges: bool | None = None,
    cmap: str = "viridis",
    clim: tuple[float, float] | None = None,
    colorbar: bool = True,
) -> Any:
    """Draws the bodies of a state or a frame.

    Parameters
    ----------
    state : embate.State or a frame of results
    field : str, optional
        What colours them: ``von_mises``, ``plastic_strain``, ``velocity`` … (of vectors the size, unless a ``component`` is given); None: each part its colour.
    ax : matplotlib axes, optional
        Where to; of solids axes with ``projection="3d"``. None: a new figure.
    component : str or int, optional
        Which component of a field: ``"x"``, ``"xx"``.
    edges : bool, optional
        Whether the mesh is drawn; None: where it is coarse enough to be seen.
    cmap, clim, colorbar
        Colours, the range that they span, and whether a legend stands beside.

    Returns
    -------
    matplotlib axes
    """
    plt = needed("matplotlib.pyplot", "plot")
    from matplotlib.collections import LineCollection, PolyCollection

    cells, index, parts = state._layout()
    is_solid = state.dimension == 3
    points = state.position
    height = _height(points)
    is_flat, is_new = height < FLAT and not is_solid, ax is None
    if is_new and is_solid:
        _, ax = plt.subplots(subplot_kw={"projection": "3d"}, layout="constrained")
    elif is_new:
        _, ax = plt.subplots(figsize=_figure_size(height, field is not None and colorbar), layout="constrained")
    alive = state._alive()
    polygons, owners = _faces(cells, index, alive)
    at_cells, at_nodes, label = _values(state, field, component)
    names = list(dict.fromkeys(parts.tolist()))
    shown: list[np.ndarray[Any, Any]] = []
    for corners, owner in zip(polygons, owners):
        if at_cells is not None:
            shown.append(at_cells[owner])
        elif at_nodes is not None:
            shown.append(at_nodes[corners].mean(axis=1))
        else:
            shown.append(np.array([names.index(name) for name in parts[owner]], dtype=float))
    values = np.concatenate(shown) if shown else np.zeros(0)
    count = len(values)
    edges = count <= 4000 if edges is None else edges
    places: list[Any] = [place for corners in polygons for place in points[corners]]
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    finite = values[np.isfinite(values)]
    low, high = clim if clim is not None else (finite.min(), finite.max()) if len(finite) else (0.0, 1.0)
    colours = ScalarMappable(Normalize(low, high), cmap)
    faces = plt.get_cmap("tab10")(values.astype(int) % 10) if field is None else colours.to_rgba(values)
    line = (0.1, 0.1, 0.1, 0.6)
    if is_solid:
        from mpl_toolkits.mplot3d.art3d import Poly3DCollection

        # Without lines neighbours leave hairs of the background between them: each has its own colour's.
        solid = Poly3DCollection(places, facecolors=faces, edgecolors=line if edges else faces, linewidths=0.3, shade=True)
        ax.add_collection3d(solid)
    else:
        ax.add_collection(PolyCollection(places, facecolors=faces, edgecolors=line if edges else "face", linewidths=0.3 if edges else 0.0))
    if "line" in cells and not is_solid:
        ax.add_collection(LineCollection(list(points[cells["line"]]), colors="0.2"))
    _frame(ax, points, is_solid)
    if field is not None and colorbar:
        if is_flat and is_new:
            ax.figure.colorbar(colours, ax=ax, label=label, location="bottom", shrink=0.8, aspect=40)
        else:
            ax.figure.colorbar(colours, ax=ax, label=label, shrink=0.8, pad=0.14 if is_solid else 0.05)
    elif field is None and len(names) > 1:
        from matplotlib.patches import Patch

        tab = plt.get_cmap("tab10")
        # Beside the bodies where there is room for it.
        where: dict[str, Any] = {"loc": "upper left", "bbox_to_anchor": (1.02, 1.0), "borderaxespad": 0.0} if is_new else {"loc": "best"}
        ax.legend(handles=[Patch(color=tab(k % 10), label=name) for k, name in enumerate(names)], fontsize="small", **where)
    ax.set_title(f"{state._name}, t = {_seconds(state.time)}", fontsize="medium")
    return ax


def _faces(
    cells: dict[str, np.ndarray[Any, Any]], index: dict[str, np.ndarray[Any, Any]], alive: np.ndarray[Any, Any]
) -> tuple[list[np.ndarray[Any, Any]], list[np.ndarray[Any, Any]]]:
    """Corners of what is to be drawn and the cell of each: surfaces as they are, of solids what is outside."""
    polygons, owners = [], []
    outside: dict[int, list[tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]]] = {}
    for kind, nodes in cells.items():
        is_there = alive[index[kind]]
        nodes, own = nodes[is_there], index[kind][is_there]
        if kind in POLYGONS:
            polygons.append(nodes)
            owners.append(own)
        for face in FACES.get(kind, []):
            outside.setdefault(len(face), []).append((nodes[:, face], own))
    for found in outside.values():
        corners, own = np.concatenate([c for c, _ in found]), np.concatenate([o for _, o in found])
        _, first, count = np.unique(np.sort(corners, axis=1), axis=0, return_index=True, return_counts=True)
        alone = first[count == 1]
        polygons.append(corners[alone])
        owners.append(own[alone])
    return polygons, owners


def _values(
    state: Fields, field: str | None, component: str | int | None
) -> tuple[np.ndarray[Any, Any] | None, np.ndarray[Any, Any] | None, str]:
    """Values at cells, or at nodes, and what they are."""
    if field is None:
        return None, None, ""
    kind = state.fields.get(field)
    if kind is None:
        raise ValueError(f"field is {field!r}; there are {', '.join(state.fields)}")
    values = state.field(field)
    label = field.replace("_", " ")
    if values.ndim == 2:
        if component is None:
            values = np.sqrt((values**2).sum(axis=1))
        else:
            names = kind["components"]
            if component not in names and component not in range(len(names)):
                raise ValueError(f"component is {component!r}; {field} has {', '.join(names)}")
            k = names.index(component) if component in names else int(component)
            values, label = values[:, k], f"{label} {names[k]}"
    elif component is not None:
        raise ValueError(f"component is {component!r}; {field} is a number without components")
    unit = kind["unit"]
    size = np.nanmax(np.abs(values)) if np.isfinite(values).any() else 0.0
    if unit == "Pa" and size >= 1e6:
        values, unit = values / 1e6, "MPa"
    label = f"{label} ({unit})" if unit else label
    return (values, None, label) if kind["location"] == "cells" else (None, values, label)


def _box(points: np.ndarray[Any, Any]) -> tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
    """Lower and upper corner of what is shown, with a margin, m."""
    low, high = points.min(axis=0), points.max(axis=0)
    room = 0.05 * max((high - low).max(), 1e-12)
    return low - room, high + room


def _height(points: np.ndarray[Any, Any]) -> float:
    """Extent in y over that in x."""
    if not len(points):
        return 0.75
    low, high = _box(points)
    return float((high[1] - low[1]) / (high[0] - low[0]))


def _figure_size(height: float, has_bar: bool) -> tuple[float, float]:
    """Width and height of a new figure, inches, that bodies of this ratio of height to width fill."""
    widest, highest, beside, around = 5.0, 4.6, 2.0, 0.9
    wide = min(widest, max(highest / height, 1.5))
    high = min(max(wide * height, 0.6), highest)
    return wide + beside, high + around + (0.8 if height < FLAT and has_bar else 0.0)


def _frame(ax: Any, points: np.ndarray[Any, Any], is_solid: bool) -> None:
    if not len(points):
        return
    low, high = _box(points)
    longest = (high - low).max()
    unit, size = next(((unit, size) for unit, size in LENGTHS if longest > 2.0 * size), LENGTHS[-1])
    axes = [ax.xaxis, ax.yaxis] + ([ax.zaxis] if is_solid else [])
    for axis, name, length in zip(axes, "xyz", high - low):
        axis.set_major_formatter(lambda value, _: f"{value / size:.6g}".replace("-", "\N{MINUS SIGN}"))
        # Labels of short axes would lie over each other.
        axis.get_major_locator().set_params(nbins=max(1, round((5 if is_solid else 9) * length / longest)))
        axis.set_label_text(f"{name} ({unit})")
    ax.set_xlim(low[0], high[0])
    ax.set_ylim(low[1], high[1])
    if is_solid:
        ax.set_zlim(low[2], high[2])
        # Smaller than the figure: names of axes are not cut, below tall bodies neither.
        ax.set_box_aspect(high - low, zoom=0.78 if (high - low)[2] == longest else 0.88)
        # Distances of names are in units of the box's other sides; numbers of z are between its name and its axis.
        for k, axis in enumerate(axes):
            axis.labelpad = (8 if k == 2 else 4) * min(longest / np.delete(high - low, k).max(), 12.0)
    else:
        ax.set_aspect("equal")


def _seconds(time: float) -> str:
    for size, unit in ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs")):
        if time >= size:
            return f"{time / size:.4g} {unit}"
    return f"{time:.4g} s"


def to_pyvista(state: Fields) -> Any:
    """The bodies with all fields as an ``UnstructuredGrid``: cells in the order of fields, eroded ones left out."""
    pyvista = needed("pyvista", "to_pyvista")
    points = state.position
    if points.shape[1] == 2:
        points = np.column_stack([points, np.zeros(len(points))])
    cells, index, parts = state._layout()
    count = len(parts)
    rows: list[Any] = [None] * count
    kinds = np.empty(count, np.uint8)
    for kind, nodes in cells.items():
        for cell, own in zip(index[kind], nodes):
            rows[cell] = own
        kinds[index[kind]] = VTK[kind]
    flat = np.concatenate([np.concatenate([[len(row)], row]) for row in rows]) if rows else np.zeros(0, np.int64)
    grid = pyvista.UnstructuredGrid(flat.astype(np.int64), kinds, np.ascontiguousarray(points))
    for name, about in state.fields.items():
        values = np.array(state.field(name))
        if about["location"] == "nodes" and len(values) == len(points):
            grid.point_data[name] = np.column_stack([values, np.zeros(len(values))]) if values.ndim == 2 and values.shape[1] == 2 else values
        elif len(values) == count:
            grid.cell_data[name] = values
    grid.cell_data["part"] = parts
    alive = state._alive()
    return grid if alive.all() else grid.extract_cells(alive)
