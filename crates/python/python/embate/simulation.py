"""Simulations: stepped, looked at, saved, and changed between steps."""

from __future__ import annotations

import json
import math
import tempfile
import threading
import time as clock
import warnings
import zipfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from os import PathLike, fspath
from pathlib import Path
from typing import Any

import numpy as np

from . import _embate
from ._saved import SavedModel
from .control import node_numbers, vectors
from .errors import FileError, RunError, StateError
from .errors import Warning as EmbateWarning
from .fields import Cells, Fields, Layout, cells_of, fields_of
from .history import History
from .mesh import mesh_of
from .model import Model
from .progress import bar
from .whole import written

#: Seconds between two looks at Ctrl-C and the progress bar.
_PAUSE = 0.1
_ALL = 2**63 - 1
_FORMAT = 1


class State(Fields):
    """The state of a simulation now: arrays by name.

    Every array is a read-only copy of the state when it was asked for: the solver has its nodes in an order of its own and goes on writing. Nodes and cells are in the user's order, part by part.
    Fields are those of ``docs/output.md``, whether the model writes them or not.
    """

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation

    @property
    def state(self) -> State:
        """Itself."""
        return self

    @property
    def time(self) -> float:
        """Time of the simulation, s."""
        return self._simulation.time

    @property
    def dimension(self) -> int:
        """2 in 2D, 3 in 3D."""
        return self._simulation.dimension

    @property
    def _name(self) -> str:
        return self._simulation.model.name

    @property
    def position(self) -> np.ndarray[Any, Any]:
        """Current positions of the nodes, m, shape (nodes, dimension)."""
        native = self._simulation._native
        return np.frombuffer(native.positions(), np.float64).reshape(-1, native.dimension)

    def field(self, name: str) -> np.ndarray[Any, Any]:
        """A field by its name: shape (nodes or cells,) or (nodes or cells, components)."""
        if name not in self.fields:
            raise AttributeError(f"there is no field {name!r}; there are {', '.join(self.fields)}")
        data, width = self._simulation._native.field(name)
        values = np.frombuffer(data, np.float64)
        return values if width == 1 else values.reshape(-1, width)

    @property
    def fields(self) -> dict[str, dict[str, Any]]:
        """What fields there are: components, unit, ``nodes`` or ``cells``, what it is."""
        return fields_of(self._simulation._native.dimension)

    def _layout(self) -> Layout:
        return self._simulation._layout()

    def _alive(self) -> np.ndarray[Any, Any]:
        alive = self.field("alive")
        cells = len(self.cell_part)
        return np.ones(cells, bool) if len(alive) != cells else np.asarray(alive > 0.5)

    def __repr__(self) -> str:
        return f"<embate state at {self._simulation.time:.6g} s: position, {', '.join(self.fields)}>"


class Simulation(Cells):
    """A model that is stepped; made by :meth:`embate.Model.simulation`.

    The interpreter's lock is free while it steps: simulations in different threads go at full speed. One simulation does one thing at a time. As a context manager it is closed in the end.
    """

    def __init__(self, model: Model, threads: int = 0, instruction_set: str | None = None, *, _native: Any = None) -> None:
        self.model = model
        self._threads = _count(threads, "threads")
        self._instruction_set = instruction_set
        self._native = _native if _native is not None else _embate.Simulation(model._native(), self._threads, instruction_set)
        #: The model as it was then: what is added to it later is not of this simulation.
        self._made_of = model._read
        self._callbacks: list[tuple[int, Callable[[Simulation], Any]]] = []
        self._working = threading.Lock()
        #: Of a sweep: warnings are not shown, and it ends early where this says no.
        self._is_quiet = False
        self._goes_on: Callable[[], bool] = lambda: True

    def run(
        self,
        until: float | str | None = None,
        *,
        progress: bool | Callable[[float], Any] = False,
        out: str | PathLike[str] | None = None,
        force: bool = False,
    ) -> Simulation:
        """Steps to the end, or to the first step at or after a time.

        Parameters
        ----------
        until : float, optional
            Time, s.
        progress : bool or callable
            True: a bar (that of tqdm where it is installed, in notebooks as well); a callable gets the fraction that is done, ten times a second at most.
        out : path, optional
            Folder for the results of this run, as those of ``embate run``: fields, history, pictures, summary; of a run that fails with its post-mortem.
        force : bool
            Whether results that are there go.

        Ctrl-C stops between two steps with KeyboardInterrupt; the state is kept, and ``run`` goes on from it.

        Raises
        ------
        embate.RunError
            The run failed; the state of the failure can be looked at, and what it says names the results and the post-mortem that were written.
        """
        end = math.inf if until is None else _time(until, "until")
        failure: RunError | None = None
        with self._at_work():
            if out is not None:
                self._native.record(Path(fspath(out)), bool(force), self.model._given() if self.model._read is self._made_of else None)
            try:
                with _shown(progress, self) as show:
                    while not self.is_over and self.time < end and self._goes_on():
                        self._advance(end, _ALL)
                        show()
            except RunError as error:
                failure = error
                raise
            finally:
                if out is not None and not self.is_closed:
                    page = self._native.finish()
                    if failure is not None:
                        failure.results, failure.post_mortem = Path(fspath(out)), page
        return self

    def post_mortem(self, folder: str | PathLike[str]) -> Path:
        """Writes the post-mortem of a run that has failed into a folder: where it failed, its last steps, which keys to change. Returns the path of its page.

        A run with ``out=`` has its post-mortem beside its results already.
        """
        return self._native.post_mortem(Path(fspath(folder)))

    def step(self, n: int = 1) -> Simulation:
        """So many steps, fewer where the end is reached before."""
        count = _count(n, "n")
        with self._at_work():
            target = self.steps + count
            while not self.is_over and self.steps < target:
                self._advance(math.inf, target - self.steps)
        return self

    @contextmanager
    def _at_work(self) -> Iterator[None]:
        """One thread steps it, and no callback does."""
        # In a child of a fork, and of one that is closed, this tells what is wrong.
        self._native.clock()
        if not self._working.acquire(blocking=False):
            raise StateError("this simulation is being stepped already, by another thread or by the run that calls this function: it does one thing at a time")
        try:
            yield
        finally:
            self._working.release()

    def _advance(self, until: float, steps: int) -> None:
        now = self.steps
        due = min((every - now % every for every, _ in self._callbacks), default=steps)
        self._native.advance(until, min(steps, due), _PAUSE)
        for notice in self._native.notices():
            if self._is_quiet:
                continue
            warnings.warn(f"{notice['code']}: {notice['message']}", EmbateWarning, stacklevel=3)
        if self.steps != now:
            for every, function in list(self._callbacks):
                if self.steps % every == 0:
                    function(self)

    def every(self, n: int, function: Callable[[Simulation], Any]) -> Callable[[Simulation], Any]:
        """Calls a function with the simulation after every step whose number n divides. It may look at everything, and change velocities and forces
        (:meth:`set_velocity`, :meth:`set_force`); it can't step.

        Returns the function. :meth:`forget` ends it.
        """
        n = _count(n, "n")
        if n == 0:
            raise ValueError("n is 0: a callback is called every so many steps")
        if not callable(function):
            raise TypeError(f"function is a {type(function).__name__}, which can't be called")
        self._callbacks.append((n, function))
        return function

    def forget(self, function: Callable[[Simulation], Any]) -> None:
        """Calls a function no more."""
        self._callbacks = [(n, known) for n, known in self._callbacks if known is not function]

    def nodes(self, where: Any) -> np.ndarray[Any, Any]:
        """Numbers of the nodes of a part (``"disk"``), a side (``"disk.outer"``) or a group, ascending: ``state.position[simulation.nodes("disk")]``."""
        return node_numbers(self, where)

    def set_velocity(self, where: Any, velocity: Any) -> None:
        """Gives nodes other velocities at the present time, between two steps. What holds a node (a constraint, a symmetry) goes on to do so.

        The change of kinetic energy is booked as work from outside. Nodes of rigid parts and joined nodes are refused: give them forces.

        Parameters
        ----------
        where : str or array
            Name of a part, side or group; or numbers of nodes, or a mask with a value for each node.
        velocity : array
            m/s; shape (dimension,) for all of them, or (nodes, dimension).
        """
        nodes = node_numbers(self, where)
        values = vectors(velocity, len(nodes), self.dimension, "velocity", "m/s")
        self._native.set_velocities(nodes.tobytes(), values.tobytes())

    def set_force(self, where: Any, force: Any) -> None:
        """Lets forces act on nodes besides the loads of the model, from the next step on until others are given for these nodes. Their work is booked as that of loads; :meth:`save` keeps them.

        Parameters
        ----------
        where : str or array
            As for :meth:`set_velocity`.
        force : array or None
            N (in the plane N per metre of depth); shape (dimension,) for the force on all of them together, in equal shares, or (nodes, dimension). None ends the forces.
        """
        nodes = node_numbers(self, where)
        force = np.zeros(self.dimension) if force is None else force
        values = vectors(force, len(nodes), self.dimension, "force", "N", is_shared=True)
        self._native.set_forces(nodes.tobytes(), values.tobytes())

    def set_curve(self, name: str, value: float, until: float | None = None) -> None:
        """Drives a curve of the model, and with it the loads, prescribed motions and obstacles that follow it: it runs in a straight line to another value, which it has from ``until``
        on and keeps until it is set again.

        The change begins at the end of the coming step, ``time + dt``: the velocities of that step stand already. What follows the curve, and the works in the energy ledger, are as if the
        model had had this curve from the beginning.

        Parameters
        ----------
        name : str
            Name of the curve.
        value : float
            In the unit of what follows it, SI; of a load a factor.
        until : float, optional
            Time at which it is reached, s; left out: it jumps, and a displacement does so within one step.
        """
        try:
            number = float(value)
        except (TypeError, ValueError):
            raise TypeError(f"value is {value!r}; a number is wanted") from None
        self._native.set_curve(str(name), number, None if until is None else _time(until, "until"))

    def curve(self, name: str) -> float:
        """Value of a curve of the model from the end of the coming step on."""
        value = self._native.curve(str(name))
        if value is None:
            raise ValueError(f"name: the model has no curve {name!r}")
        return value

    def exchange(self, part: str, mesh: Any, *, group: str | None = None, scale: float = 1.0) -> dict[str, Any]:
        """Lets a part continue on another mesh of the body as it is now, as ``embate remesh`` does: velocities, stresses and what laws remember go over to it.

        Mass, momentum and angular momentum are kept; what is lost of the energy is in ``energy["remap"]``. Nodes and cells of the part are others afterwards, and rows of the history have the
        column ``energy.remap``.

        Parameters
        ----------
        part : str
            Name of the part.
        mesh
            A file of Gmsh (.msh) or a deck (.inp), or whatever ``mesh=`` of a part takes: its points are where the body is now.
        group : str, optional
            The group of cells, where the mesh has several and none has the name of the part.
        scale : float
            Length of one unit of the mesh, m.

        Returns
        -------
        dict
            What has changed: an entry of ``remeshings`` in :attr:`summary`.

        Raises
        ------
        embate.ModelError
            The part can't continue on this mesh (E0613), with the reason; the simulation stands where it stood.
        """
        scale = float(scale)
        if not 0 < scale < math.inf:
            raise ValueError(f"scale is {scale}; the length of a unit in metres is wanted")
        known = mesh_of(mesh)
        given = (Path(fspath(mesh)), None) if known is None else (Path("mesh"), known.bytes())
        with self._at_work():
            self._native.exchange(str(part), given, scale, group)
        event: dict[str, Any] = self.summary["remeshings"][-1]
        return event

    @property
    def time(self) -> float:
        """Time reached, s."""
        return self._native.clock()[0]

    @property
    def steps(self) -> int:
        """Steps done."""
        return self._native.clock()[1]

    @property
    def dt(self) -> float:
        """Step that leads to the next state, s."""
        return self._native.clock()[2]

    @property
    def end(self) -> float:
        """End time, s."""
        return self._native.clock()[3]

    @property
    def is_over(self) -> bool:
        """Whether the end is reached."""
        return self._native.clock()[5]

    @property
    def is_closed(self) -> bool:
        """Whether :meth:`close` was called."""
        return self._native.is_closed

    @property
    def dimension(self) -> int:
        """2 in the plane, 3 in space."""
        return self._native.dimension

    @property
    def state(self) -> State:
        """The state now, array by array."""
        return State(self)

    @property
    def energy(self) -> dict[str, float]:
        """Energies by the names of the history (J, in the plane J per metre of depth), ``total`` is less the work from outside (``external``), so that it stays; and ``drift``, a fraction of the largest total energy."""
        row = zip(self._native.columns(), self._native.row())
        energies = {name.removeprefix("energy."): value for name, value in row if name.startswith("energy.") and "[" not in name}
        return {**energies, "drift": self._native.clock()[4]}

    @property
    def history(self) -> History:
        """The history so far."""
        columns = self._native.columns()
        return History(columns, np.frombuffer(self._native.rows(), np.float64).reshape(-1, len(columns)))

    @property
    def summary(self) -> dict[str, Any]:
        """What ``summary.json`` would say now."""
        summary: dict[str, Any] = json.loads(self._native.summary())
        return summary

    def hash(self) -> str:
        """Hash of the state: the same as ``state_hash`` in ``summary.json`` of the command's run."""
        return self._native.hash()

    def _layout(self) -> Layout:
        return cells_of(*self._native.cells())

    def node_numbers(self, mesh: Any, part: str | None = None) -> np.ndarray[Any, Any]:
        """Where the points of a part's mesh are among the nodes of the state: ``state.position[numbers]`` are in the order of the points.

        Parameters
        ----------
        mesh
            What was given as ``mesh=`` of a part, the very object; -1 in the answer where no part has the point.
        part
            Name of the part whose nodes are wanted, where parts have the mesh in several places. Of one with ``copies`` the
            answer has the shape (bodies, points).

        Raises
        ------
        ValueError
            When no part has the mesh as it is, or parts have it in several places and none of them is named.
        """
        names = self.model._mesh_names()
        if id(mesh) not in names:
            raise ValueError("mesh is none of those that parts of this model were given; the very object is wanted, not an equal one")
        name, known = names[id(mesh)]
        places = [(parts, data) for source, parts, data in self._native.placed() if source == name and part in (None, *parts)]
        if not places:
            raise ValueError("no part has this mesh as it is" if part is None else f"part {part!r} does not have this mesh as it is")
        if len(places) > 1:
            raise ValueError(f"parts have this mesh in {len(places)} places: name one of them, part={places[0][0][0]!r} or part={places[1][0][0]!r}")
        data = places[0][1]
        numbers = np.full((len(data), len(known.points)), -1, np.int64)
        found = np.array([np.frombuffer(one, np.uint32) for one in data]).astype(np.int64)
        found[found == 2**32 - 1] = -1
        numbers[:, np.flatnonzero(known.used())] = found
        return numbers if len(data) > 1 else numbers[0]

    def save(self, path: str | PathLike[str]) -> Path:
        """Writes model, state and history into one file, from which :func:`embate.load` goes on with the same bits."""
        path = Path(fspath(path))
        model = self.model
        text, meshes = model._text()
        head = {
            "format": _FORMAT,
            "version": _embate.__version__,
            "path": str(model._path.absolute()) if model._path is not None else None,
            "name": model._name,
            "folder": str((model._folder or Path(".")).absolute()),
            "set": model._overrides(),
            "allow_outside": model._allow_outside,
        }
        with tempfile.TemporaryDirectory() as folder:
            state = Path(folder) / "state.embate"
            self._native.write_state(state)
            with written(path) as file, zipfile.ZipFile(file, "w", zipfile.ZIP_STORED) as archive:
                archive.writestr("head.json", json.dumps(head, indent=1))
                archive.writestr("model.toml", text)
                for name, data in meshes.items():
                    archive.writestr(f"mesh/{name}", data)
                archive.writestr("history.f64", self._native.rows())
                archive.write(state, "state.embate")
        return path

    def checkpoint(self, folder: str | PathLike[str]) -> Path:
        """Saves the state as ``STEP.embate`` in a folder, which is made."""
        folder = Path(fspath(folder))
        folder.mkdir(parents=True, exist_ok=True)
        return self.save(folder / f"{self.steps:012}.embate")

    def close(self) -> None:
        """Lets go of the memory. What is asked afterwards raises :class:`embate.StateError`."""
        self._native.close()

    def plot(self, field: str | None = None, ax: Any = None, **options: Any) -> Any:
        """Draws the bodies, coloured by a field (matplotlib); returns the axes. See :func:`embate.plotting.plot`."""
        return self.state.plot(field, ax, **options)

    def to_pyvista(self) -> Any:
        """The bodies with all fields as an ``UnstructuredGrid`` (pyvista)."""
        return self.state.to_pyvista()

    def __enter__(self) -> Simulation:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        if self.is_closed:
            return "<embate.Simulation, closed>"
        return f"<embate.Simulation of {self.model.name!r}: step {self.steps}, {self.time:.6g} of {self.end:.6g} s>"

    def _repr_html_(self) -> str:
        from .display import simulation_html

        return simulation_html(self)


def load(path: str | PathLike[str], *, threads: int = 0, instruction_set: str | None = None) -> Simulation:
    """A simulation that goes on from what :meth:`Simulation.save` wrote, with the same bits as if it had never been stopped."""
    path = Path(fspath(path))
    try:
        with zipfile.ZipFile(path) as archive, tempfile.TemporaryDirectory() as folder:
            head = json.loads(archive.read("head.json"))
            if head.get("format") != _FORMAT or head.get("version") != _embate.__version__:
                raise FileError(f"{path} was written by embate {head.get('version')}, this is {_embate.__version__}: run the model again, or use that version")
            meshes = {name[5:]: archive.read(name) for name in archive.namelist() if name.startswith("mesh/")}
            model = SavedModel(head, archive.read("model.toml").decode(), meshes)
            model._saved_set = head["set"]
            rows = np.frombuffer(archive.read("history.f64"), np.float64).tolist()
            state = Path(archive.extract("state.embate", folder))
            native = _embate.Simulation.resumed(model._native(), state, rows, _count(threads, "threads"), instruction_set)
    except (zipfile.BadZipFile, KeyError, json.JSONDecodeError, UnicodeDecodeError) as error:
        raise FileError(f"{path} is no file of a saved simulation, or it is damaged: {error}") from error
    return Simulation(model, threads, instruction_set, _native=native)


def _count(number: Any, name: str) -> int:
    try:
        count = number.__index__()
    except AttributeError:
        raise TypeError(f"{name} is {number!r}; a whole number is wanted") from None
    if count < 0:
        raise ValueError(f"{name} is {count}; it is not negative")
    return int(min(count, _ALL))


def _time(value: Any, name: str) -> float:
    try:
        seconds = float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{name} is {value!r}; a time in s is wanted") from None
    if math.isnan(seconds) or seconds < 0:
        raise ValueError(f"{name} is {seconds}; a time from the start on is wanted")
    return seconds


class _shown:
    """A progress bar, a function that is told, or nothing."""

    def __init__(self, progress: bool | Callable[[float], Any], simulation: Simulation) -> None:
        self._simulation, self._last = simulation, 0.0
        self._function: Callable[[float], Any] | None = None
        self._bar: Any = None
        if progress is True:
            self._bar = bar(100.0, "%")
        elif callable(progress):
            self._function = progress

    def __enter__(self) -> Callable[[], None]:
        return self._show

    def _show(self) -> None:
        simulation = self._simulation
        if self._bar is None and self._function is None:
            return
        now = clock.monotonic()
        if now - self._last < _PAUSE and not simulation.is_over:
            return
        self._last = now
        time, steps, dt, end, drift, _ = simulation._native.clock()
        done = min(1.0, time / end) if end > 0 else 1.0
        if self._function is not None:
            self._function(done)
        if self._bar is not None:
            self._bar.to(round(100 * done, 1), f"step {steps}, dt {dt:.2e} s, drift {100 * drift:.2g} %")

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.close()


__all__ = ["History", "Simulation", "State", "StateError", "load"]
