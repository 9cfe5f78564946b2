"""Sweeps: one row for each combination, the same with any number of workers."""

from __future__ import annotations

from typing import Any

import pytest
from conftest import STEEL
from test_model import grid

import embate


def peak(simulation: embate.Simulation) -> dict[str, Any]:
    return {"vy": float(simulation.history["top.vy"][-1]), "hash": simulation.hash()}


def test_rows_do_not_depend_on_the_workers(model: embate.Model) -> None:
    vary = {"part[1].velocity": [(0, -20), (0, -40)], "run.safety": [0.5, 0.9]}
    here = embate.sweep(model, vary, workers=0, measure=peak, until=15e-6)
    beside = embate.sweep(model, vary, workers=2, measure=peak, until=15e-6)
    assert here == beside and len(here) == 4
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
