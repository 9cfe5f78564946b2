"""Models: from a file, a dict, or built step by step; the same names as in the model file."""

from __future__ import annotations

import copy
import html
import warnings
from collections.abc import Mapping
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _embate, toml
from .errors import Warning as EmbateWarning
from .mesh import Mesh, mesh_of
from .whole import written

if TYPE_CHECKING:
    from .simulation import Simulation

_SECTIONS: dict[str, dict[str, Any]] = {section["name"]: section for section in _embate.sections()}
_FORMS: dict[str, str] = {name: section["form"] for name, section in _SECTIONS.items()}


class Model:
    """A model of bodies, contacts, supports and loads.

    Parameters
    ----------
    source : path, dict or None
        A model file or its folder; a dict with the sections of a model file; None: an empty model, to be built by its methods.
    set : dict, optional
        Keys that get other values, by their paths: ``{"run.end": "5 ms", "part.tube.velocity": (0, -80)}``; as ``--set`` of the command.
    name : str, optional
        Name of a model that is not from a file.
    folder : path, optional
        Where files that the model names are looked for; of a file its own folder, else the working directory.
    allow_outside : bool
        Whether files that the model names may lie outside of its folder.
    **sections
        Sections, or keys of the file itself: ``Model(title="Impact", run={"end": "1 ms"})``.

    Every section of the model file is a method, with its keys as arguments: ``model.run(end="1 ms")``, ``model.material("steel", law="elastic", …)``, ``model.part(mesh=…, material="steel")``.
    Values are numbers in SI units, texts with units (``"3 mm"``), lists and dicts, as in ``docs/model-file.md``. A mesh may be that of a file (``mesh={"file": …, "group": …}``), numpy arrays
    (``mesh=(points, quads)``), a :class:`embate.Mesh`, or an object of meshio, gmsh or pyvista.

    Nothing is checked before :meth:`check` or :meth:`simulation` reads the whole; all faults are told at once then, by a :class:`embate.ModelError`.
    """

    def __init__(
        self,
        source: str | PathLike[str] | Mapping[str, Any] | None = None,
        *,
        set: Mapping[str, Any] | None = None,
        name: str | None = None,
        folder: str | PathLike[str] | None = None,
        allow_outside: bool = False,
        **sections: Any,
    ) -> None:
        self._path: Path | None = None
        self._sections: dict[str, Any] = {}
        self._meshes: dict[int, tuple[str, Mesh]] | None = None
        self._set: dict[str, Any] = dict(set or {})
        #: The same as texts, of a model that was saved with them; they come first.
        self._saved_set: list[str] = []
        self._name = name
        self._folder = Path(folder) if folder is not None else None
        self._allow_outside = bool(allow_outside)
        if isinstance(source, Mapping):
            # Lists and tables are the model's own, so that methods add to them; meshes and values stay those that were given.
            self._sections.update({k: list(v) if isinstance(v, list) else dict(v) if isinstance(v, Mapping) else v for k, v in source.items() if k != "name"})
            self._name = name or (str(source["name"]) if "name" in source else None)
        elif source is not None:
            self._path = Path(fspath(source))
            if sections or name is not None or folder is not None:
                raise TypeError("a model file has its name, folder and sections already; change keys by set={'run.end': '5 ms'}")
        for key, content in sections.items():
            self._add(key, content)
        self._read: _embate.Model | None = None

    def _add(self, section: str, content: Any) -> None:
        if self._path is not None:
            raise TypeError("this model is that of a file: change keys by set={'part.tube.velocity': (0, -80)}, or build a model from a dict")
        form = _FORMS.get(section)
        if form == "list" and isinstance(content, Mapping):
            content = [content]
        self._sections[section] = content
        self._read = None

    def _section(self, section: str, keys: dict[str, Any], name: str | None = None) -> Model:
        if self._path is not None:
            self._add(section, None)
        form = _FORMS[section]
        self._read = None
        if form == "list":
            self._sections.setdefault(section, [])
            self._sections[section].append(keys)
        elif form == "named":
            self._sections.setdefault(section, {})
            self._sections[section][str(name)] = keys
        else:
            self._sections.setdefault(section, {})
            self._sections[section].update(keys)
        return self

    def with_set(self, set: Mapping[str, Any]) -> Model:
        """A copy in which keys have other values, by their paths."""
        other = copy.copy(self)
        other._sections = dict(self._sections)
        other._set = {**self._set, **set}
        other._read = None
        return other

    def to_toml(self) -> str:
        """The text of the model file. Meshes of arrays are named in it by what :meth:`save` would call their files; changes by ``set`` are not in it."""
        return self._files()[0]

    def save(self, path: str | PathLike[str]) -> Path:
        """Writes the model file, with meshes of arrays as .msh files beside it; the command ``embate run`` computes it as it is here.

        Returns the path of the file; ``path`` may be a folder, for its ``model.toml``.
        """
        file = Path(fspath(path))
        if file.is_dir() or not file.suffix:
            file.mkdir(parents=True, exist_ok=True)
            file = file / "model.toml"
        text, meshes = self._files()
        if self._overrides():
            raise ValueError("save: keys changed by set are not written into files; give them as sections")
        for name, data in meshes.items():
            with written(file.parent / name) as mesh:
                mesh.write(data)
        with written(file) as out:
            out.write(text.encode())
        return file

    def _files(self) -> tuple[str, dict[str, bytes]]:
        """The text of the model file, and the meshes of arrays that it names."""
        if self._path is None:
            return self._text()
        file = self._path / "model.toml" if self._path.is_dir() else self._path
        return file.read_text(encoding="utf-8"), {}

    def _text(self) -> tuple[str, dict[str, bytes]]:
        """The same of a model that is not from a file."""
        meshes: dict[str, bytes] = {}
        known: dict[int, tuple[str, Mesh]] = {}
        sections = dict(self._sections)
        parts = sections.get("part")
        if isinstance(parts, (list, tuple)):
            sections["part"] = [_with_mesh(part, k, meshes, known) if isinstance(part, Mapping) else part for k, part in enumerate(parts)]
        self._meshes = known
        return toml.document(sections, _FORMS), meshes

    def _mesh_names(self) -> dict[int, tuple[str, Mesh]]:
        """File and arrays of each object that was given as a mesh."""
        if self._meshes is None:
            self._text()
        return self._meshes or {}

    def _overrides(self) -> list[str]:
        return self._saved_set + [f"{key}={toml.value(value, key)}" for key, value in self._set.items()]

    def _native(self) -> _embate.Model:
        if self._read is None:
            if self._path is not None:
                self._read = _embate.Model.from_file(self._path, self._overrides(), self._allow_outside)
            else:
                text, meshes = self._text()
                folder = self._folder if self._folder is not None else Path(".")
                self._read = _embate.Model.from_text(self._name or "model", text, folder, self._overrides(), self._allow_outside, meshes)
        return self._read

    def __getstate__(self) -> dict[str, Any]:
        """For other processes: meshes as arrays, since nobody can send gmsh's model."""
        state = {**self.__dict__, "_read": None, "_meshes": None}
        parts = self._sections.get("part")
        if isinstance(parts, list):
            known = {key: mesh for key, (_, mesh) in self._mesh_names().items()}
            parts = [{**part, "mesh": known.get(id(part["mesh"]), part["mesh"])} if isinstance(part, Mapping) and "mesh" in part else part for part in parts]
            state["_sections"] = {**self._sections, "part": parts}
        return state

    @property
    def name(self) -> str:
        """Name of the model."""
        return self._native().name

    @property
    def dimension(self) -> int:
        """2 in the plane, 3 in space."""
        return self._native().dimension

    @property
    def end(self) -> float:
        """End time, s."""
        return self._native().end

    @property
    def parts(self) -> list[str]:
        """Names of the parts."""
        return self._native().parts

    def check(self) -> list[dict[str, Any]]:
        """Reads the model: raises :class:`embate.ModelError` with all its faults, or returns its warnings (code, path, line, message, help)."""
        return self._native().warnings()

    def simulation(self, threads: int = 0, instruction_set: str | None = None) -> Simulation:
        """Makes the model ready to step.

        Parameters
        ----------
        threads : int
            How many; 0: one for each processor. Changes no bit of the results.
        instruction_set : str, optional
            ``scalar``, ``avx2`` or ``avx512``; None: the best that the machine has. Changes no bit either.

        Raises
        ------
        embate.ModelError
            With all faults of the model.
        """
        from .simulation import Simulation

        native = self._native()
        for told in native.warnings():
            place = f"{told['path']}: " if told["path"] else ""
            warnings.warn(f"{told['code']}: {place}{told['message']}", EmbateWarning, stacklevel=2)
        return Simulation(self, threads=threads, instruction_set=instruction_set)

    def plot(self, ax: Any = None, **options: Any) -> Any:
        """Draws the bodies at the start (matplotlib); see :meth:`embate.Simulation.plot`."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", EmbateWarning)
            with self.simulation(threads=1) as simulation:
                return simulation.plot(ax=ax, **options)

    if TYPE_CHECKING:
        # Made below, from the sections of the model file.
        def run(self, **keys: Any) -> Model: ...
        def part(self, **keys: Any) -> Model: ...
        def contact(self, **keys: Any) -> Model: ...
        def obstacle(self, **keys: Any) -> Model: ...
        def symmetry(self, **keys: Any) -> Model: ...
        def constraint(self, **keys: Any) -> Model: ...
        def join(self, **keys: Any) -> Model: ...
        def weld(self, **keys: Any) -> Model: ...
        def joint(self, **keys: Any) -> Model: ...
        def load(self, **keys: Any) -> Model: ...
        def cavity(self, **keys: Any) -> Model: ...
        def non_reflecting(self, **keys: Any) -> Model: ...
        def spring(self, **keys: Any) -> Model: ...
        def point_mass(self, **keys: Any) -> Model: ...
        def probe(self, **keys: Any) -> Model: ...
        def output(self, **keys: Any) -> Model: ...
        def material(self, name: str, /, **keys: Any) -> Model: ...
        def curve(self, name: str, /, **keys: Any) -> Model: ...

    def __repr__(self) -> str:
        if self._path is not None:
            return f"embate.Model({str(self._path)!r})"
        counts = ", ".join(f"{len(v)} {k}" if isinstance(v, (list, dict)) and _FORMS.get(k) != "table" else k for k, v in self._sections.items())
        return f"<embate.Model {self._name or 'model'!r}: {counts or 'empty'}>"

    def _repr_html_(self) -> str:
        from .display import model_html

        try:
            return model_html(self)
        except Exception as error:  # A notebook shows what is wrong instead of the picture.
            return f"<pre>{html.escape(str(error))}</pre>"


def _is_mesh(what: Any) -> bool:
    """Whether this is a mesh of arrays, however wrong."""
    return what is not None and not (isinstance(what, Mapping) and "points" not in what) and not isinstance(what, str)


def _with_mesh(part: Mapping[str, Any], index: int, meshes: dict[str, bytes], known: dict[int, tuple[str, Mesh]]) -> Mapping[str, Any]:
    """A part whose mesh of arrays is named as a file."""
    what = part.get("mesh")
    if not _is_mesh(what):
        return part
    path = f"part[{index}].mesh"
    try:
        mesh = known[id(what)][1] if id(what) in known else mesh_of(what)
    except (TypeError, ValueError) as error:
        raise type(error)(f"{path}: {error}") from None
    if mesh is None:
        raise TypeError(f"{path}: a {type(what).__name__} is no mesh; arrays (points, cells), a dict with points and cells, embate.Mesh, meshio, gmsh and pyvista are")
    if id(what) not in known:
        file = f"mesh-{len(meshes) + 1}.msh"
        meshes[file], known[id(what)] = mesh.bytes(), (file, mesh)
    keys = {"file": known[id(what)][0]}
    groups = [name for name, parts in mesh.groups.items() if any(len(which) for which in parts.values())]
    if "group" in part:
        keys["group"] = part["group"]
    elif len(groups) == 1:
        keys["group"] = groups[0]
    return {**{k: v for k, v in part.items() if k not in ("mesh", "group")}, "mesh": keys}


def _methods() -> None:
    """A method for each section of the model file."""

    def listed(section: str) -> Any:
        def method(self: Model, **keys: Any) -> Model:
            return self._section(section, keys)

        return method

    def named(section: str) -> Any:
        def method(self: Model, name: str, /, **keys: Any) -> Model:
            return self._section(section, keys, name)

        return method

    for name, section in _SECTIONS.items():
        method = named(name) if section["form"] == "named" else listed(name)
        method.__name__ = name
        method.__qualname__ = f"Model.{name}"
        method.__module__ = Model.__module__
        keys = "\n".join(f"{key} :\n    {doc}" for key, doc in section["keys"])
        method.__doc__ = f"{section['doc']}\n\nReturns the model.\n\nParameters\n----------\n{keys}\n"
        setattr(Model, name, method)


_methods()
