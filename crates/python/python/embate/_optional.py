"""Packages that embate uses where they are asked for, and does not need."""

from __future__ import annotations

from importlib import import_module
from typing import Any


def needed(name: str, what: str) -> Any:
    """A package that has to be there for what was asked."""
    try:
        return import_module(name)
    except ImportError as error:
        if error.name is not None and error.name.partition(".")[0] != name.partition(".")[0]:
            raise
        package = name.partition(".")[0]
        raise ImportError(f"{what} needs {package}, which is not installed: pip install {package}", name=package) from None
