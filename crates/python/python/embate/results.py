"""Result folders, of the command and of ``run(out=...)``: read while and after a run writes them."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import Any, overload

import numpy as np

from . import _embate
from ._optional import needed
from .errors import FileError
from .fields import Fields, cells_of, fields_of
from .history import History
from .model import Model

#: What a folder of results has at least one of.
_MARKS = ("summary.json", "run.json", "history.csv", "history.csv.part", "fields")


class Frame(Fields):
    """The fields at one output time, as a run has written them: arrays by name, as those of :attr:`embate.Simulation.state`.

    What is not in the file is not here: :attr:`fields` names what there is. Arrays are read when they are asked for.
    """

    def __init__(self, results: Results, number: int, time: float, file: Path) -> None:
        self._results, self._file = results, file
        #: Number of the frame, from 0.
        self.number = number
        self._time = time
        self._opened: Any = None

    @property
    def _native(self) -> Any:
        if self._opened is None:
            self._opened = _embate.Frame(self._file)
        return self._opened

    @property
    def _name(self) -> str:
        return self._results.name

    @property
    def state(self) -> Frame:
        """Itself: a frame is drawn as a simulation is."""
        return self

    @property
    def time(self) -> float:
        """Time of the frame, s."""
        return self._time

    @property
    def dimension(self) -> int:
        """2 in 2D, 3 in 3D."""
        return int(self._native.dimension)

    @property
    def fields(self) -> dict[str, dict[str, Any]]:
        """What fields the file has: components, unit, ``nodes`` or ``cells``, what it is."""
        all_fields = fields_of(self.dimension)
        return {name: all_fields[name] for name in self._native.fields()}

    @property
    def position(self) -> np.ndarray[Any, Any]:
        """Current positions of the nodes, m, shape (nodes, dimension)."""
        return np.frombuffer(self._native.positions(), np.float64).reshape(-1, self.dimension)

    def field(self, name: str) -> np.ndarray[Any, Any]:
        """A field by its name: shape (nodes or cells,) or (nodes or cells, components)."""
        if name not in self.fields:
            raise AttributeError(f"the frame has no field {name!r}; it has {', '.join(self.fields)}; output.include chooses what a run writes")
        data, width, _ = self._native.field(name)
        values = np.frombuffer(data, np.float64)
        return values if width == 1 else values.reshape(-1, width)

    def _layout(self) -> tuple[dict[str, np.ndarray[Any, Any]], dict[str, np.ndarray[Any, Any]], np.ndarray[Any, Any]]:
        nodes, offsets, kinds, parts = self._native.cells()
        numbers = np.frombuffer(parts, np.uint32)
        names = self._results.parts
        names = names + [f"part {k}" for k in range(len(names), int(numbers.max()) + 1 if len(numbers) else 0)]
        return cells_of(nodes, offsets, kinds, parts, names)

    def _alive(self) -> np.ndarray[Any, Any]:
        alive = np.ones(len(self.cell_part), bool)
        alive[np.frombuffer(self._native.gone(), np.uint32)] = False
        return alive

    def __repr__(self) -> str:
        return f"<embate frame {self.number} at {self.time:.6g} s: position, {', '.join(self.fields)}>"


class Frames(Sequence[Frame]):
    """The frames of a run in the order of their times."""

    def __init__(self, frames: list[Frame]) -> None:
        self._frames = frames

    @overload
    def __getitem__(self, index: int) -> Frame: ...
    @overload
    def __getitem__(self, index: slice) -> Frames: ...
    def __getitem__(self, index: int | slice) -> Frame | Frames:
        return Frames(self._frames[index]) if isinstance(index, slice) else self._frames[index]

    def __len__(self) -> int:
        return len(self._frames)

    def __iter__(self) -> Iterator[Frame]:
        return iter(self._frames)

    @property
    def times(self) -> np.ndarray[Any, Any]:
        """Times of the frames, s."""
        return np.array([frame.time for frame in self._frames])

    def at(self, time: float) -> Frame:
        """The frame whose time is nearest."""
        if not self._frames:
            raise IndexError("there are no frames")
        return self._frames[int(np.abs(self.times - float(time)).argmin())]

    def field(self, name: str) -> np.ndarray[Any, Any]:
        """A field at all times: shape (times, nodes or cells) or (times, nodes or cells, components)."""
        if not self._frames:
            return np.zeros(0)
        values = [frame.field(name) for frame in self._frames]
        _check_alike(values)
        return np.stack(values)

    def to_xarray(self, fields: Sequence[str] | None = None) -> Any:
        """Fields at all times as an ``xarray.Dataset`` over time, node and cell; ``fields``: some of them."""
        return _dataset(self, fields)

    def __repr__(self) -> str:
        if not self._frames:
            return "<embate frames: none>"
        return f"<embate frames: {len(self)} from {self._frames[0].time:.6g} to {self._frames[-1].time:.6g} s>"


def _check_alike(values: Sequence[np.ndarray[Any, Any]]) -> None:
    """Says where frames have other nodes or cells than the first: elements were made again."""
    if any(own.shape != values[0].shape for own in values):
        raise ValueError("frames have different nodes and cells, because elements were made again in the run ([[remesh]]): take them one by one, or some of them")


class Results:
    """A result folder; made by :func:`embate.results`.

    Everything is read when it is asked for, so of a run that continues as far as it is then.
    """

    def __init__(self, folder: str | PathLike[str]) -> None:
        self.folder = Path(fspath(folder))
        if not any((self.folder / name).exists() for name in _MARKS):
            what = "is no folder" if not self.folder.is_dir() else "holds no results of embate (no summary.json, run.json or history.csv)"
            text = f"{self.folder} {what}; give the folder that `embate run` or run(out=...) wrote"
            raise FileError(f"E0722: {text}", [{"code": "E0722", "path": "", "line": None, "message": text, "help": ""}])

    @property
    def summary(self) -> dict[str, Any]:
        """``summary.json``; empty while the run has not ended, or where it was killed."""
        return self._json("summary.json")

    @property
    def provenance(self) -> dict[str, Any]:
        """``run.json``: what was run, key by key (``keys``), and how it is shown; its ``model`` is empty of a model in memory that names files."""
        return self._json("run.json")

    @property
    def status(self) -> str:
        """``done``, ``stopped``, ``failed``; ``unfinished`` where the run goes on or was killed."""
        return str(self.summary.get("status", "unfinished"))

    @property
    def name(self) -> str:
        """Name of the model."""
        return str(self.summary.get("model") or _text_of_key(self.provenance, "name") or self.folder.absolute().name)

    @property
    def model(self) -> Model:
        """The model that was run, as its file is now, with the keys that were overridden.

        Raises
        ------
        embate.FileError
            The model was in memory, and names files.
        """
        provenance = self.provenance
        path = str(provenance.get("model") or "")
        if not path:
            raise FileError(f"{self.folder} doesn't say what file its model came from: it was in the memory of a program, and names files or was changed since")
        model = Model(path)
        model._saved_set = [str(text) for text in provenance.get("set", [])]
        return model

    @property
    def parts(self) -> list[str]:
        """Names of the parts."""
        names = self.summary.get("parts")
        if isinstance(names, list):
            return [str(name) for name in names]
        return [str(part[0]) for part in self.provenance.get("appearance", {}).get("parts", [])]

    @property
    def history(self) -> History:
        """The history, as far as it is written; with the units of its columns."""
        appearance = self.provenance.get("appearance", {})
        dimension = appearance.get("dimension", 0)
        found = _embate.history(self.folder, dimension == 3 or bool(appearance.get("axisymmetric")))
        if found is None:
            return History([], np.zeros((0, 0)))
        columns, units, data = found
        values = np.frombuffer(data, np.float64).reshape(-1, len(columns)) if columns else np.zeros((0, 0))
        # Whether energies are those of whole bodies is not known of a model in memory.
        return History(columns, values, dict(zip(columns, units)) if dimension else {})

    @property
    def frames(self) -> Frames:
        """The fields at all output times: ``results.frames[-1].von_mises``."""
        return Frames([Frame(self, number, time, Path(file)) for number, time, file in _embate.frames(self.folder)])

    @property
    def post_mortem(self) -> Path | None:
        """The page about the failure of a run that failed."""
        page = self.folder / "post-mortem" / "README.md"
        return page if page.exists() else None

    def to_pandas(self) -> Any:
        """The history as a table of pandas."""
        return self.history.to_pandas()

    def to_xarray(self, fields: Sequence[str] | None = None) -> Any:
        """Fields at all output times as an ``xarray.Dataset``."""
        return self.frames.to_xarray(fields)

    def to_pyvista(self, index: int = -1) -> Any:
        """A frame with all its fields as an ``UnstructuredGrid`` (pyvista); the last one unless another is asked for."""
        return self.frames[index].to_pyvista()

    def _json(self, name: str) -> dict[str, Any]:
        file = self.folder / name
        if file.exists() and not file.is_file():
            raise FileError(f"can't read {file}: it is no plain file")
        try:
            value = json.loads(file.read_text(encoding="utf-8"))
        except FileNotFoundError:
            return {}
        except (ValueError, UnicodeDecodeError) as error:
            raise FileError(f"{file} is damaged: {error}") from None
        if not isinstance(value, dict):
            raise FileError(f"{file} is damaged: it has no keys")
        return value

    def __repr__(self) -> str:
        frames, history = self.frames, self.history
        rows = len(history["time"]) if "time" in history else 0
        return f"<embate.results({str(self.folder)!r}): {self.name}, {self.status}, {rows} rows of {len(history)} columns, {len(frames)} frames>"

    def _repr_html_(self) -> str:
        from .display import results_html

        return results_html(self)


def results(folder: str | PathLike[str]) -> Results:
    """Opens a result folder, of ``embate run`` or ``run(out=...)``; also of a run that goes on, failed or was killed."""
    return Results(folder)


def _text_of_key(provenance: dict[str, Any], key: str) -> str:
    """A text among the keys of run.json, which are written as they are in Rust."""
    return str(provenance.get("keys", {}).get(key, "")).strip('"')


#: Names of the axes of components.
_AXES = {("x", "y"): "axis", ("x", "y", "z"): "axis", ("xx", "yy", "zz", "xy"): "pair", ("xx", "yy", "zz", "xy", "yz", "zx"): "pair", ("xx", "yy", "zz", "xy", "yz", "xz"): "pair"}


def _dataset(frames: Frames, fields: Sequence[str] | None) -> Any:
    xarray = needed("xarray", "to_xarray")
    if not len(frames):
        return xarray.Dataset()
    known = frames[0].fields
    chosen = list(known) if fields is None else list(fields)
    for name in chosen:
        if name not in known:
            raise ValueError(f"fields: there is no {name!r}; there are {', '.join(known)}")
    parts = frames[0].cell_part
    axis = ["x", "y", "z"][: frames[0].dimension]
    coordinates: dict[str, Any] = {"time": ("time", frames.times, {"units": "s"}), "axis": axis, "part": ("cell", parts)}
    positions = [frame.position for frame in frames]
    _check_alike(positions)
    values: dict[str, Any] = {"position": (("time", "node", "axis"), np.stack(positions), {"units": "m"})}
    for name in chosen:
        about = known[name]
        components = tuple(about["components"])
        place = "node" if about["location"] == "nodes" else "cell"
        array = frames.field(name)
        dimensions: tuple[str, ...] = ("time", place)
        if array.ndim == 3:
            own = _AXES.get(components, f"component_{name}")
            coordinates.setdefault(own, list(components))
            dimensions = ("time", place, own)
        values[name] = (dimensions, array, {"units": about["unit"], "long_name": about["doc"]})
    return xarray.Dataset(values, coordinates)
