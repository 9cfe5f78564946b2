"""Sweeps: one row for each combination, the same with any number of workers."""

from __future__ import annotations

import subprocess
import sys
import threading
import time
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import STEEL, sections
from test_model import grid

import embate


def peak(simulation: embate.Simulation) -> dict[str, Any]:
    return {"vy": float(simulation.history["top.vy"][-1]), "hash": simulation.hash()}


def test_rows_do_not_depend_on_the_workers(model: embate.Model) -> None:
    vary = {"part[1].velocity": [(0, -20), (0, -40)], "run.safety": [0.5, 0.9]}
    here = embate.sweep(model, vary, workers=0, measure=peak, until=15e-6)
    beside = embate.sweep(model, vary, workers=2, measure=lambda simulation: peak(simulation), until=15e-6)
    apart = embate.sweep(model, vary, workers=2, measure=peak, until=15e-6, processes=True)
    assert here == beside == apart and len(here) == 4
    assert [row["run.safety"] for row in here] == [0.5, 0.9, 0.5, 0.9]
    assert len(set(here.column("hash"))) == 4 and here.column("error") == [None] * 4
    assert "<table>" in here._repr_html_()


def test_a_model_that_has_run_and_has_a_mesh_of_arrays_can_be_swept_beside() -> None:
    points, quads = grid(4, 2, (0.02, 0.01))
    model = embate.Model(name="grid").run(end="2 us").material("steel", **STEEL)
    model.part(name="block", mesh=(points, quads), material="steel", velocity=(3, 0))
    model.simulation().run()
    rows = embate.sweep(model, {"run.safety": [0.4, 0.8]}, workers=2)
    assert rows.column("error") == [None, None] and rows[0]["steps"] > rows[1]["steps"]


def test_a_script_can_sweep_without_a_guard_and_is_not_run_again(tmp_path: Path) -> None:
    script = tmp_path / "script.py"
    script.write_text(
        "import embate\n"
        f"model = embate.Model({sections()!r})\n"
        "print('begun')\n"
        "print(embate.sweep(model, {'run.safety': [0.5, 0.9]}, workers=2, until=2e-6, progress=True).column('error'))\n"
    )
    done = subprocess.run([sys.executable, "-W", "error", str(script)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines() == ["begun", "[None, None]"]


def test_a_mistake_in_measure_ends_the_sweep_soon(model: embate.Model) -> None:
    def fails(_: embate.Simulation) -> dict[str, Any]:
        raise LookupError("no such thing")

    begin = time.monotonic()
    vary = {"run.safety": [0.9] + 50 * [0.001]}
    with pytest.raises(LookupError, match="no such thing"):
        embate.sweep(model, vary, workers=2, measure=fails, until=40e-6)
    # Each of the fifty would take more than the whole test may.
    assert time.monotonic() - begin < 60


def test_warnings_of_runs_beside_each_other_are_not_told_and_those_after_are(model: embate.Model) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        embate.sweep(model, {"run.safety": [0.5, 0.9]}, workers=2, until=2e-6)
    with pytest.warns(UserWarning, match="still told"):
        warnings.warn("still told", stacklevel=1)


def test_a_run_that_fails_leaves_the_others(model: embate.Model) -> None:
    rows = embate.sweep(model, {"run.energy_limit": [1e-9, 0.05]}, workers=0)
    assert "energy drift" in rows[0]["error"] and rows[1]["error"] is None
    assert rows[1]["state_hash"] == model.simulation().run().hash()


def test_values_that_go_together(model: embate.Model) -> None:
    rows = embate.sweep(model, {"run.safety": [0.5, 0.9], "run.end": ["5 us", "10 us"]}, workers=0, together=True)
    assert [(row["run.safety"], row["run.end"]) for row in rows] == [(0.5, "5 us"), (0.9, "10 us")]


@pytest.mark.parametrize(
    ("vary", "error", "told"),
    [({}, TypeError, "vary"), ({"run.end": "5 us"}, TypeError, "list of values"), ({"run.ende": [1]}, embate.ModelError, "ende")],
)
def test_wrong_values_are_told_before_anything_runs(model: embate.Model, vary: dict, error: type, told: str) -> None:
    with pytest.raises(error, match=told):
        embate.sweep(model, vary, workers=0)


def test_meshes_are_taken_from_their_objects_once_and_not_in_threads() -> None:
    points, quads = grid(4, 2, (0.02, 0.01))
    seen: list[int] = []

    class Grid:
        """As pyvista's grids are known: by what they have."""

        @property
        def points(self) -> Any:
            seen.append(threading.get_ident())
            return points

        celltypes = 9 * np.ones(len(quads), int)
        offset = 4 * np.arange(len(quads) + 1)
        cell_connectivity = quads.ravel()
        cell_data: dict[str, Any] = {}

    mesh = Grid()
    model = embate.Model(name="grid").run(end="1 us").material("steel", **STEEL)
    model.part(name="block", mesh=mesh, material="steel", velocity=(3, 0))
    seen.clear()
    rows = embate.sweep(model, {"run.safety": [0.4, 0.6, 0.8]}, workers=3, measure=lambda it: {"numbers": it.node_numbers(mesh).tolist()})
    assert rows.column("error") == 3 * [None] and rows[0]["numbers"] == rows[2]["numbers"] and len(rows[0]["numbers"]) == len(points)
    assert set(seen) == {threading.get_ident()}
