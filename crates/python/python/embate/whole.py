"""Whole files or none: everything is written as NAME.part and renamed when it is complete, and nothing is written through a symbolic link."""

from __future__ import annotations

import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from .errors import FileError


@contextmanager
def written(path: Path) -> Iterator[BinaryIO]:
    """A file that takes the place of ``path`` when the block ends without an exception; what a program that was killed has left under the name of the .part file is removed, but no link."""
    part = path.with_name(path.name + ".part")
    try:
        if stat.S_ISREG(part.lstat().st_mode):
            part.unlink()
    except FileNotFoundError:
        pass
    try:
        # "x" makes a new file and follows no link.
        file = part.open("xb")
    except FileExistsError as error:
        raise FileError(f"can't write {path}: {part} is in the way and no plain file; remove it") from error
    try:
        with file:
            yield file
        part.replace(path)
    except BaseException:
        part.unlink(missing_ok=True)
        raise
