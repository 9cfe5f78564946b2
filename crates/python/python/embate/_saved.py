"""Models that were saved with a state: their text and meshes as they were."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from . import _embate
from .model import Model


class SavedModel(Model):
    """A model by its text."""

    def __init__(self, head: dict[str, Any], text: str, meshes: dict[str, bytes]) -> None:
        super().__init__(name=head["name"], folder=head["folder"], allow_outside=head["allow_outside"])
        self._saved = (text, meshes, list(head["set"]))

    def _text(self) -> tuple[str, dict[str, bytes]]:
        return self._saved[0], self._saved[1]

    def _overrides(self) -> list[str]:
        return self._saved[2] + super()._overrides()

    def _native(self) -> _embate.Model:
        if self._read is None:
            folder = self._folder if self._folder is not None and self._folder.is_dir() else Path(".")
            self._read = _embate.Model.from_text(self._name or "model", self._saved[0], folder, self._overrides(), self._allow_outside, self._saved[1])
        return self._read
