"""Histories: tables over time, of a simulation or a result folder."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from . import _embate
from ._optional import needed


class History(Mapping[str, np.ndarray[Any, Any]]):
    """The history so far: columns as of ``history.csv``, each a read-only array of the values at the output times."""

    def __init__(self, columns: list[str], values: np.ndarray[Any, Any], units: Mapping[str, str] | None = None) -> None:
        self._columns = {name: k for k, name in enumerate(columns)}
        self._values = values
        #: Units of the columns, where they are known.
        self.units: dict[str, str] = dict(units or {})

    def __getitem__(self, name: str) -> np.ndarray[Any, Any]:
        if name not in self._columns:
            raise KeyError(f"{name!r}; there are {', '.join(self._columns)}")
        return self._values[:, self._columns[name]]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def channel(self, expression: str, *, filter: str | None = None, corner: float | None = None) -> np.ndarray[Any, Any]:
        """Values of a formula of the columns, such as ``"A.y - B.y"`` or ``"hic15(head.ax)"``: as ``[[channel]]`` of a model.

        ``filter``: a channel frequency class of SAE J211, ``"CFC 60"``, ``"CFC 180"``, ``"CFC 600"`` or ``"CFC 1000"``; ``corner``: the
        frequency (Hz) at which a Butterworth filter without phase damps by 3 dB.

        :raises ValueError: the formula can't be read, or the filter is unknown.
        """
        classes = {f"CFC {number}": float(number) for number in (60, 180, 600, 1000)}
        if filter is not None and filter not in classes:
            raise ValueError(f"there is no filter {filter!r}; there are {', '.join(classes)}")
        if filter is not None and corner is not None:
            raise ValueError("give a filter or a corner, not both")
        values = [self._values[:, k].tolist() for k in self._columns.values()]
        return np.array(_embate.channel(expression, list(self._columns), values, classes.get(filter or ""), corner))

    def to_numpy(self) -> np.ndarray[Any, Any]:
        """All values, shape (rows, columns)."""
        return self._values

    def to_pandas(self) -> Any:
        """A table with the time as its index (pandas)."""
        pandas = needed("pandas", "to_pandas")
        table = pandas.DataFrame(self._values, columns=list(self._columns))
        return table.set_index("time") if "time" in self._columns else table

    def to_xarray(self) -> Any:
        """A ``Dataset`` over time (xarray)."""
        xarray = needed("xarray", "to_xarray")
        columns = {name: ("time", self[name], {"units": self.units.get(name, "")}) for name in self if name != "time"}
        return xarray.Dataset(columns, {"time": ("time", self["time"], {"units": "s"})} if "time" in self else None)

    def __repr__(self) -> str:
        return f"<embate history: {len(self._values)} rows of {', '.join(self._columns)}>"

    def _repr_html_(self) -> str:
        from .display import history_html

        return history_html(self)
