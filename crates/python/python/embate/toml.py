"""Values of Python as the text of a model file, which the reader of the command then reads: one set of checks and messages for both."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from os import PathLike
from typing import Any

import numpy as np

_BARE = re.compile(r"^[A-Za-z0-9_-]+$")


def key(name: str) -> str:
    """A key, in quotes where it needs them."""
    if not isinstance(name, str):
        raise TypeError(f"keys of a model are texts, not {type(name).__name__}: {name!r}")
    return name if _BARE.match(name) else text(name)


def text(value: str) -> str:
    """A text in quotes."""
    out = ['"']
    for char in value:
        if char in '"\\':
            out.append("\\" + char)
        elif char in "\n\r\t":
            out.append({"\n": "\\n", "\r": "\\r", "\t": "\\t"}[char])
        elif ord(char) < 0x20 or ord(char) == 0x7F:
            out.append(f"\\u{ord(char):04X}")
        else:
            out.append(char)
    out.append('"')
    return "".join(out)


def value(what: Any, path: str) -> str:
    """A value; ``path`` is the key's, for messages."""
    if isinstance(what, (bool, np.bool_)):
        return "true" if what else "false"
    if isinstance(what, str):
        return text(what)
    if isinstance(what, PathLike):
        return text(str(what))
    if isinstance(what, (int, np.integer)):
        return str(int(what))
    if isinstance(what, (float, np.floating)):
        return number(float(what), path)
    if isinstance(what, np.ndarray):
        if what.ndim == 0:
            return value(what.item(), path)
        return value(what.tolist(), path)
    if isinstance(what, Mapping):
        entries = (f"{key(name)} = {value(item, f'{path}.{name}')}" for name, item in what.items() if item is not None)
        return "{ " + ", ".join(entries) + " }"
    if isinstance(what, Iterable):
        return "[" + ", ".join(value(item, f"{path}[{k}]") for k, item in enumerate(what)) + "]"
    raise TypeError(f"{path}: a {type(what).__name__} is no value of a model; numbers, texts such as '3 mm', lists and dicts are")


def number(what: float, path: str) -> str:
    """A finite number, so that it reads back as it was."""
    if not math.isfinite(what):
        raise ValueError(f"{path} is {what}: values of a model are finite numbers")
    return repr(what)


def document(sections: Mapping[str, Any], forms: Mapping[str, str], path: str | None = None) -> str:
    """The text of a model: keys of the file itself first, then its sections. ``path``: where a section stands that is the only one."""
    tops, tables = [], []
    for name, content in sections.items():
        form = forms.get(name)
        if content is None:
            continue
        if form == "list" and isinstance(content, (list, tuple)) and all(isinstance(item, Mapping) for item in content):
            for k, item in enumerate(content):
                tables.append(_table(f"[[{name}]]", item, path or f"{name}[{k}]"))
        elif form == "named" and isinstance(content, Mapping) and all(isinstance(item, Mapping) for item in content.values()):
            for own, item in content.items():
                tables.append(_table(f"[{name}.{key(own)}]", item, f"{name}.{own}"))
        elif form == "table" and isinstance(content, Mapping):
            tables.append(_table(f"[{name}]", content, name))
        else:
            tops.append(f"{key(name)} = {value(content, name)}\n")
    return "\n".join(["".join(tops), *tables] if tops else tables)


def _table(header: str, content: Mapping[str, Any], path: str) -> str:
    lines = [header]
    lines += [f"{key(name)} = {value(item, f'{path}.{name}')}" for name, item in content.items() if item is not None]
    return "\n".join(lines) + "\n"
