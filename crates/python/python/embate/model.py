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
from ._method import FORMS, plain
from ._sections import Sections
from .errors import ModelError
from .errors import Warning as EmbateWarning
from .mesh import Mesh, mesh_of
from .whole import written

if TYPE_CHECKING:
    from .simulation import Simulation


class Model(Sections):
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
        Sections, or keys of the file itself: ``Model(title="Impact", run={"end": "1 ms"})``; of a model file what is added to it.

    Every section of the model file is a method, with its keys as arguments: ``model.run(end="1 ms")``, ``model.material("steel", law="elastic", …)``, ``model.part(mesh=…, material="steel")``;
    a key that is a word of Python with an underscore: ``yield_="250 MPa"``. To the model of a file they add: ``model.probe(name="tip", …)``.
    Values are numbers in SI units, texts with units (``"3 mm"``), lists and dicts, as in ``docs/model-file.md``. A mesh may be that of a file (``mesh={"file": …, "group": …}``), numpy arrays
    (``mesh=(points, quads)``), a :class:`embate.Mesh`, or an object of meshio, gmsh or pyvista.

    What is wrong with a section by itself (a key, a value, a unit) is an error where it is given, a :class:`embate.ModelError`; what is wrong with the whole when :meth:`check` or :meth:`simulation`
    reads it, all at once.
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
        #: Meshes that were taken from their objects already, by what is in several threads.
        self._taken: dict[int, Mesh] = {}
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
            if name is not None or folder is not None:
                raise TypeError("a model file has its name and folder already")
        for key, content in sections.items():
            self._sections[key] = [content] if FORMS.get(key) == "list" and isinstance(content, Mapping) else content
        self._read: _embate.Model | None = None
        if self._sections:
            _check(toml.document(self._named({}), FORMS), "the model")

    def _section(self, section: str, keys: dict[str, Any], name: str | None = None) -> Model:
        form, known = FORMS[section], self._sections.get(section)
        if known is not None and not isinstance(known, list if form == "list" else dict):
            raise TypeError(f"the model was given {section} as a {type(known).__name__}, to which nothing can be added")
        count = len(known or ())
        one = _with_mesh(keys, count, {}, {}) if section == "part" else keys
        piece: Any = [one] if form == "list" else {str(name): one} if form == "named" else one
        # By its place in the model, so that messages name it.
        path = f"{section}[{count}]" if form == "list" else f"{section}.{name}" if form == "named" else section
        _check(toml.document({section: piece}, FORMS, path), f"model.{section}(...)", section, count)
        self._read = None
        if form == "list":
            self._sections.setdefault(section, []).append(keys)
        elif form == "named":
            self._sections.setdefault(section, {})[str(name)] = keys
        else:
            self._sections.setdefault(section, {}).update(keys)
        return self

    def with_set(self, set: Mapping[str, Any]) -> Model:
        """A copy in which keys have other values, by their paths."""
        # Not as `copy` does it, which takes what is for other processes.
        other = object.__new__(type(self))
        other.__dict__.update(self.__dict__)
        other._sections = {key: copy.copy(content) if isinstance(content, (list, dict)) else content for key, content in self._sections.items()}
        other._set = {**self._set, **set}
        other._read, other._meshes = None, None
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
        text, meshes = self._text()
        if self._path is None:
            return text, meshes
        file = self._path / "model.toml" if self._path.is_dir() else self._path
        own = file.read_text(encoding="utf-8")
        if not text:
            return own, meshes
        whole = f"{own.rstrip()}\n\n{text}"
        try:
            _embate.Model.check_piece(file.name, whole, "", 0)
        except ModelError as error:
            if error.code == _SYNTAX:
                raise ValueError(
                    f"what was added can't stand behind the text of {file}: {error.message}; write sections of which there may be several with double brackets there, [[probe]], and change keys by set"
                ) from None
        return whole, meshes

    def _given(self) -> tuple[str, dict[str, bytes], list[str]] | None:
        """Of a model that is not that of a file its text, its meshes, and what is overridden; None of one that can't be written as files."""
        if self._path is not None and not self._sections:
            return None
        try:
            return *self._files(), self._overrides()
        except Exception:
            # Objects of meshes that are gone by now, a file that can't be read any more.
            return None

    def _named(self, known: dict[int, tuple[str, Mesh]]) -> dict[str, Any]:
        """The sections, with meshes of arrays by the names of their files; which are known then."""
        sections = dict(self._sections)
        parts = sections.get("part")
        if isinstance(parts, (list, tuple)):
            sections["part"] = [_with_mesh(part, k, known, self._taken) if isinstance(part, Mapping) else part for k, part in enumerate(parts)]
        return sections

    def _text(self) -> tuple[str, dict[str, bytes]]:
        """The text of the sections that were given, of a model file those that were added to it, and the meshes that it names."""
        known: dict[int, tuple[str, Mesh]] = {}
        text = toml.document(self._named(known), FORMS)
        self._meshes = known
        return text, {file: mesh.bytes() for file, mesh in known.values()}

    def _mesh_names(self) -> dict[int, tuple[str, Mesh]]:
        """File and arrays of each object that was given as a mesh."""
        if self._meshes is None:
            self._text()
        return self._meshes or {}

    def _for_threads(self) -> Model:
        """A copy that asks the objects of meshes (gmsh's model for one) no more: several threads can have models of it."""
        other = self.with_set({})
        other._taken = {key: mesh for key, (_, mesh) in self._mesh_names().items()}
        return other

    def _overrides(self) -> list[str]:
        return self._saved_set + [f"{key}={toml.value(value, key)}" for key, value in self._set.items()]

    def _native(self) -> _embate.Model:
        if self._read is None:
            text, meshes = self._text()
            if self._path is not None:
                self._read = _embate.Model.from_file(self._path, (text, meshes) if text else None, self._overrides(), self._allow_outside)
            else:
                folder = self._folder if self._folder is not None else Path(".")
                self._read = _embate.Model.from_text(self._name or "model", text, folder, self._overrides(), self._allow_outside, meshes)
        return self._read

    def __getstate__(self) -> dict[str, Any]:
        """For other processes: meshes as arrays, since nobody can send gmsh's model."""
        state = {**self.__dict__, "_read": None, "_meshes": None, "_taken": {}}
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

    def __repr__(self) -> str:
        counts = ", ".join(f"{len(v)} {k}" if isinstance(v, (list, dict)) and FORMS.get(k) != "table" else k for k, v in self._sections.items())
        if self._path is not None:
            return f"<embate.Model of {str(self._path)!r}, and {counts}>" if counts else f"embate.Model({str(self._path)!r})"
        return f"<embate.Model {self._name or 'model'!r}: {counts or 'empty'}>"

    def _repr_html_(self) -> str:
        from .display import model_html

        try:
            return model_html(self)
        except Exception as error:  # A notebook shows what is wrong instead of the picture.
            return f"<pre>{html.escape(str(error))}</pre>"


#: Code of a text that is no TOML.
_SYNTAX = "E0103"


def _check(text: str, name: str, section: str = "", first: int = 0) -> None:
    """Looks at sections by themselves."""
    _embate.Model.check_piece(name, text, section, first)


def _is_mesh(what: Any) -> bool:
    """Whether this is a mesh of arrays, however wrong."""
    return what is not None and not (isinstance(what, Mapping) and "points" not in what) and not isinstance(what, str)


def _with_mesh(part: Mapping[str, Any], index: int, known: dict[int, tuple[str, Mesh]], taken: Mapping[int, Mesh]) -> Mapping[str, Any]:
    """A part whose mesh of arrays is named as a file; which is among the known then."""
    what = part.get("mesh")
    if not _is_mesh(what):
        return part
    path = f"part[{index}].mesh"
    try:
        mesh = known[id(what)][1] if id(what) in known else taken.get(id(what)) or mesh_of(what)
    except (TypeError, ValueError) as error:
        raise type(error)(f"{path}: {error}") from None
    if mesh is None:
        raise TypeError(f"{path}: a {type(what).__name__} is no mesh; arrays (points, cells), a dict with points and cells, embate.Mesh, meshio, gmsh and pyvista are")
    known.setdefault(id(what), (f"mesh-{len(known) + 1}.msh", mesh))
    keys = {"file": known[id(what)][0]}
    groups = [name for name, parts in mesh.groups.items() if any(len(which) for which in parts.values())]
    if "group" in part:
        keys["group"] = part["group"]
    elif len(groups) == 1:
        keys["group"] = groups[0]
    return {**{k: v for k, v in part.items() if k not in ("mesh", "group")}, "mesh": keys}
