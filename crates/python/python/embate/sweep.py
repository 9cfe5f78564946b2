"""Many runs of one model with other values, to a table."""

from __future__ import annotations

import itertools
import math
import os
import threading
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from ._optional import needed
from .errors import Error
from .model import Model
from .progress import bar
from .simulation import Simulation

#: Figures of the summary that a table has without being asked.
FIGURES = ("steps", "time_end", "stable_time_step_min", "energy_drift", "penetration_max", "state_hash")


def figures(simulation: Simulation) -> dict[str, Any]:
    """What a table has where no ``measure`` is given: figures of the summary, and largest and last value of each column of the history."""
    summary = simulation.summary
    found: dict[str, Any] = {name: summary[name] for name in FIGURES}
    for name, values in simulation.history.items():
        if name != "time" and len(values):
            found[f"{name}.max"], found[f"{name}.end"] = float(abs(values).max()), float(values[-1])
    return found


class Table(list[dict[str, Any]]):
    """Rows of a sweep, each a dict: the values that were varied, what was measured, and ``error``, None where the run went well."""

    def to_pandas(self) -> Any:
        """The same as a table of pandas."""
        return needed("pandas", "to_pandas").DataFrame(list(self))

    def column(self, name: str) -> list[Any]:
        """One value of each row."""
        return [row.get(name) for row in self]

    def _repr_html_(self) -> str:
        from .display import rows_html

        return rows_html(self)


def sweep(
    model: Model,
    vary: Mapping[str, Sequence[Any]],
    *,
    workers: int | None = None,
    measure: Callable[[Simulation], Mapping[str, Any]] | None = None,
    until: float | None = None,
    together: bool = False,
    progress: bool = False,
    processes: bool = False,
) -> Table:
    """Runs a model with every combination of values.

    Parameters
    ----------
    model : embate.Model
        The model.
    vary : dict
        Path of a key -> values: ``{"part[0].velocity": [(0, -20), (0, -40)], "material.steel.yield": [200e6, 300e6]}``.
    workers : int, optional
        Runs at a time, each with one thread; None: one for each processor; 0: one after the other, each with all threads. Results do not depend on it.
    measure : callable, optional
        Gets the simulation at its end, returns a dict.
    until : float, optional
        Time at which runs end, s.
    together : bool
        Whether the values go together, the first with the first, instead of all combinations.
    progress : bool
        Shows a bar.
    processes : bool
        Whether each worker is a process of its own, for a ``measure`` that computes long in Python. Then it is a function of a module or a notebook's cell, and a script has the call under
        ``if __name__ == "__main__":``. Threads need neither: the solver steps without the interpreter's lock.

    Returns
    -------
    Table
        A row for each run, in the order of the values, the last key fastest. A run that fails has its message in ``error``; the others go on.
    """
    if not isinstance(model, Model):
        raise TypeError(f"model is a {type(model).__name__}; an embate.Model is wanted")
    if not isinstance(vary, Mapping) or not vary:
        raise TypeError("vary is a dict of paths and their values, {'run.safety': [0.5, 0.9]} for example")
    values = []
    for path, given in vary.items():
        if isinstance(given, (str, bytes)) or not hasattr(given, "__iter__"):
            raise TypeError(f"vary[{path!r}] is {given!r}; a list of values is wanted")
        values.append(list(given))
    if together and len(set(map(len, values))) > 1:
        raise ValueError(f"vary: values that go together are equally many, here {', '.join(f'{len(v)} of {k}' for k, v in zip(vary, values))}")
    combinations = [dict(zip(vary, row)) for row in (zip(*values) if together else itertools.product(*values))]
    of = measure or figures
    model = model._for_threads()
    # A mistake in a path is told now, not after the first runs.
    if combinations:
        model.with_set(combinations[0]).check()
    rows: list[dict[str, Any] | None] = [None] * len(combinations)
    shown = bar(len(combinations), "run") if progress else None
    count = min(len(combinations), (os.cpu_count() or 1) if workers is None else workers)
    stop = threading.Event()
    done = 0

    def note() -> None:
        nonlocal done
        done += 1
        if shown is not None:
            shown.to(done)

    try:
        if count <= 1:
            for k, changes in enumerate(combinations):
                rows[k] = _run(model, changes, of, until, 0 if workers == 0 else 1)
                note()
        else:
            from concurrent.futures import as_completed

            with _pool(count, processes) as pool:
                own = () if processes else (stop,)
                futures = {pool.submit(_run, model, changes, of, until, 1, *own): k for k, changes in enumerate(combinations)}
                try:
                    for future in as_completed(futures):
                        rows[futures[future]] = future.result()
                        note()
                except BaseException:
                    # Ctrl-C, or a mistake in `measure`: what has begun ends with its next steps, the rest does not begin.
                    stop.set()
                    pool.shutdown(wait=False, cancel_futures=True)
                    raise
    finally:
        if shown is not None:
            shown.close()
    return Table(row for row in rows if row is not None)


def _pool(count: int, processes: bool) -> Any:
    if processes:
        from concurrent.futures import ProcessPoolExecutor
        from multiprocessing import get_context

        # Processes that are made anew: a fork would take the threads of this one for its own.
        return ProcessPoolExecutor(count, mp_context=get_context("spawn"))
    from concurrent.futures import ThreadPoolExecutor

    return ThreadPoolExecutor(count, thread_name_prefix="embate")


def _run(
    model: Model,
    changes: dict[str, Any],
    measure: Callable[[Simulation], Mapping[str, Any]],
    until: float | None,
    threads: int,
    stop: threading.Event | None = None,
) -> dict[str, Any]:
    row: dict[str, Any] = {**changes, "error": None}
    try:
        with Simulation(model.with_set(changes), threads=threads) as simulation:
            simulation._is_quiet = True
            if stop is not None:
                simulation._goes_on = lambda: not stop.is_set()
            simulation.run(until)
            if not simulation.is_over and simulation.time < (math.inf if until is None else until):
                return row
            row.update(measure(simulation))
    except Error as error:
        row["error"] = str(error)
    return row
