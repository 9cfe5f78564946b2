"""What a state of a simulation and a frame of a result folder have in common: fields by name, cells, tables and pictures."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _embate
from ._optional import needed

#: Nodes of the cells and their places in fields, by kind; part of each cell.
Layout = tuple[dict[str, np.ndarray[Any, Any]], dict[str, np.ndarray[Any, Any]], np.ndarray[Any, Any]]


class Cells:
    """The cells of a mesh; who inherits it says where they come from."""

    def _layout(self) -> Layout:
        """All three at once: the solver makes them anew each time."""
        raise NotImplementedError

    @property
    def cells(self) -> dict[str, np.ndarray[Any, Any]]:
        """Nodes of the cells by kind (``quad``, ``hexahedron`` …), in the order of :attr:`cell_index`."""
        return self._layout()[0]

    @property
    def cell_index(self) -> dict[str, np.ndarray[Any, Any]]:
        """Where the cells of each kind are in fields of cells."""
        return self._layout()[1]

    @property
    def cell_part(self) -> np.ndarray[Any, Any]:
        """Name of the part of each cell."""
        return self._layout()[2]


class Fields(Cells):
    """Fields as attributes, and what is made of them; who inherits it says where they come from."""

    @property
    def time(self) -> float:
        """s."""
        raise NotImplementedError

    @property
    def dimension(self) -> int:
        """2 in 2D, 3 in 3D."""
        raise NotImplementedError

    @property
    def _name(self) -> str:
        """Name of the model."""
        raise NotImplementedError

    def field(self, name: str) -> np.ndarray[Any, Any]:
        """A field by its name."""
        raise NotImplementedError

    @property
    def fields(self) -> dict[str, dict[str, Any]]:
        """What fields there are."""
        raise NotImplementedError

    @property
    def position(self) -> np.ndarray[Any, Any]:
        """Current positions of the nodes, m."""
        raise NotImplementedError

    def _alive(self) -> np.ndarray[Any, Any]:
        """Which cells were not eroded."""
        raise NotImplementedError

    def __getattr__(self, name: str) -> np.ndarray[Any, Any]:
        if name.startswith("_"):
            raise AttributeError(name)
        return self.field(name)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.fields]

    def to_pandas(self, location: str = "nodes") -> Any:
        """The fields at ``nodes`` or ``cells`` as a table of pandas, a column for each component; with the positions of nodes, and the parts of cells."""
        if location not in ("nodes", "cells"):
            raise ValueError(f"location is {location!r}; it is 'nodes' or 'cells'")
        pandas = needed("pandas", "to_pandas")
        axes = "xyz"
        columns: dict[str, Any] = {}
        if location == "nodes":
            columns = {axes[k]: values for k, values in enumerate(self.position.T)}
        else:
            columns["part"] = self.cell_part
        for name, about in self.fields.items():
            if about["location"] != location:
                continue
            values = self.field(name)
            if values.ndim == 1:
                columns[name] = values
            else:
                columns.update({f"{name}_{component}": values[:, k] for k, component in enumerate(about["components"])})
        count = len(next(iter(columns.values())))
        return pandas.DataFrame({name: values for name, values in columns.items() if len(values) == count})

    def to_pyvista(self) -> Any:
        """The bodies with all fields as an ``UnstructuredGrid`` (pyvista)."""
        from .plotting import to_pyvista

        return to_pyvista(self)

    def plot(self, field: str | None = None, ax: Any = None, **options: Any) -> Any:
        """Draws the bodies, coloured by a field (matplotlib); returns the axes. See :func:`embate.plotting.plot`."""
        from .plotting import plot

        return plot(self, field, ax, **options)


def fields_of(dimension: int) -> dict[str, dict[str, Any]]:
    """All fields that there are in 2D or 3D."""
    return {
        name: {"components": components, "unit": unit, "location": "nodes" if is_node else "cells", "doc": doc}
        for name, components, unit, is_node, doc in _embate.fields(dimension)
    }


def cells_of(nodes: bytes, offsets: bytes, kinds: list[str], parts: bytes, names: list[str]) -> Layout:
    """Cells by kind, from those in the order of the fields."""
    numbers, begins = np.frombuffer(nodes, np.uint32), np.frombuffer(offsets, np.uint32).astype(np.int64)
    of_kind = np.asarray(kinds)
    cells, index = {}, {}
    for kind in dict.fromkeys(kinds):
        which = np.flatnonzero(of_kind == kind)
        size = int(begins[which[0] + 1] - begins[which[0]])
        cells[kind] = numbers[begins[which][:, None] + np.arange(size)].astype(np.int64)
        index[kind] = which
    return cells, index, np.asarray(names)[np.frombuffer(parts, np.uint32)]
