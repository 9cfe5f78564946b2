"""Models that were saved with a state: their text and meshes as they were."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from .model import Model


class SavedModel(Model):
    """A model by its text, or a model file with what was added to it. Where its folder is gone, files are looked for in the working directory."""

    def __init__(self, head: dict[str, Any], text: str, meshes: dict[str, bytes]) -> None:
        if head["path"] is not None:
            super().__init__(head["path"], allow_outside=head["allow_outside"])
        else:
            folder = head["folder"] if Path(head["folder"]).is_dir() else None
            super().__init__(name=head["name"], folder=folder, allow_outside=head["allow_outside"])
        self._saved = (text, meshes)

    def _text(self) -> tuple[str, dict[str, bytes]]:
        return self._saved

    def _section(self, section: str, keys: dict[str, Any], name: str | None = None) -> Model:
        raise TypeError("nothing can be added to the model of a saved simulation; with_set changes its keys")
