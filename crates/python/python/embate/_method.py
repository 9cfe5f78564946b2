"""What the methods of sections do: the arguments that their signatures promise are taken as keys of the model file."""

from __future__ import annotations

import functools
import keyword
from collections.abc import Callable, Iterator, Mapping
from typing import Any, TypeVar

from . import _embate

#: Name of a section -> ``list``, ``named`` or ``table``.
FORMS: dict[str, str] = {section["name"]: section["form"] for section in _embate.sections()}

F = TypeVar("F", bound=Callable[..., Any])


def section(function: F) -> F:
    """A method that has the signature of ``function`` for who reads it, and takes any keys: the model file's own check finds which are wrong, and which are meant."""
    name = function.__name__

    def listed(self: Any, **keys: Any) -> Any:
        return self._section(name, plain(keys))

    def named(self: Any, name: str, **keys: Any) -> Any:
        return self._section(function.__name__, plain(keys), name)

    return functools.wraps(function)(named if FORMS[name] == "named" else listed)  # type: ignore[return-value]


def plain(keys: Mapping[str, Any]) -> dict[str, Any]:
    """Arguments as keys: without the underscore behind words of Python; what can be gone through once only is a list."""
    return {
        key[:-1] if key.endswith("_") and keyword.iskeyword(key[:-1]) else key: list(value) if isinstance(value, Iterator) else value
        for key, value in keys.items()
    }
