"""What can go wrong: every exception of the package, with the code and the text of the command's message.

``embate explain E0110`` on a command line, and ``docs/messages.md``, tell more of a code.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any


class Error(Exception):
    """Base of all.

    Attributes
    ----------
    faults : list of dict
        Every fault: ``code``, ``path`` of the key (``part[0].ring.inner``), ``line`` in the file or None, ``message`` and ``help``.
    code : str
        Code of the first fault, ``E0110`` for example; empty where there is none.
    """

    def __init__(self, text: str, faults: list[dict[str, Any]] | None = None) -> None:
        super().__init__(text)
        self.faults = list(faults or [])

    @property
    def code(self) -> str:
        """Code of the first fault."""
        return str(self.faults[0]["code"]) if self.faults else ""

    @property
    def message(self) -> str:
        """What is wrong first."""
        return str(self.faults[0]["message"]) if self.faults else str(self)

    @property
    def place(self) -> str:
        """Path of the key that is wrong first."""
        return str(self.faults[0]["path"]) if self.faults else ""

    @property
    def cure(self) -> str:
        """What to do about it."""
        return str(self.faults[0]["help"]) if self.faults else ""

    def __reduce__(self) -> tuple[Any, ...]:
        return (type(self), (str(self), self.faults))


class ModelError(Error, ValueError):
    """A model that can't be run: nothing was run."""


class RunError(Error, RuntimeError):
    """A run that failed: an element turned inside out, the energy drifted away. The state of the failure can be looked at.

    Attributes
    ----------
    results : Path or None
        Folder in which its results are, as far as it came.
    post_mortem : Path or None
        The page about the failure.
    """

    results: Path | None = None
    post_mortem: Path | None = None

    def __str__(self) -> str:
        lines = [str(self.args[0]) if self.args else ""]
        lines += [f"  post-mortem: {self.post_mortem}"] if self.post_mortem else []
        lines += [f"  results until then: {self.results}"] if self.results else []
        return "\n".join(lines)

    def __reduce__(self) -> tuple[Any, ...]:
        return (type(self), (self.args[0], self.faults), {"results": self.results, "post_mortem": self.post_mortem})


class StateError(Error, RuntimeError):
    """A simulation that is closed, at work in another thread, or of another process."""


class FileError(Error, OSError):
    """A file that can't be read or written."""

    def __str__(self) -> str:
        return str(self.args[0]) if self.args else ""


class InternalError(Error, RuntimeError):
    """embate itself has failed; please report it with the model."""


class Warning(UserWarning):  # noqa: A001 - embate.Warning, as numpy and others have theirs
    """What the user should know of a model or a run before trusting it."""
