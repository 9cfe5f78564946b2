"""Progress of runs and sweeps: tqdm's bar where that is installed, else a line of text."""

from __future__ import annotations

import sys
import time as clock
from typing import Any

#: Characters of the bar.
_WIDTH = 30


def bar(total: float, unit: str) -> Any:
    """What shows how far something is: ``to(done, text)``, ``close()``."""
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return Line(total, unit)
    return _Tqdm(tqdm, total, unit)


class _Tqdm:
    def __init__(self, tqdm: Any, total: float, unit: str) -> None:
        form = {"bar_format": "{l_bar}{bar}| {elapsed}<{remaining}{postfix}"} if unit == "%" else {}
        self._bar = tqdm(total=total, unit=unit, **form)

    def to(self, done: float, text: str = "") -> None:
        self._bar.n = done
        self._bar.set_postfix_str(text)

    def close(self) -> None:
        self._bar.close()


class Line:
    """A line on the standard error output: drawn again on a terminal; elsewhere one for each tenth."""

    def __init__(self, total: float, unit: str) -> None:
        self._total, self._unit, self._begin = total, unit, clock.monotonic()
        self._tenth, self._width, self._out = -1, 0, sys.stderr
        self._is_terminal = bool(getattr(self._out, "isatty", lambda: False)())

    def to(self, done: float, text: str = "") -> None:
        share = min(max(done / self._total, 0.0), 1.0) if self._total > 0 else 1.0
        passed = clock.monotonic() - self._begin
        left = f", {passed * (1 - share) / share:.0f} s left" if 0 < share < 1 else ""
        number = f"{100 * share:5.1f} %" if self._unit == "%" else f"{done:g}/{self._total:g} {self._unit}"
        line = f"{number} |{'#' * round(_WIDTH * share):{_WIDTH}}| {passed:.0f} s{left}{'; ' if text else ''}{text}"
        if self._is_terminal:
            self._out.write("\r" + line.ljust(self._width))
            self._width = len(line)
        elif int(10 * share) > self._tenth:
            self._tenth = int(10 * share)
            self._out.write(line + "\n")
        self._out.flush()

    def close(self) -> None:
        if self._is_terminal and self._width:
            self._out.write("\n")
            self._out.flush()
