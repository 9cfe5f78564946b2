"""Calibration: known values are found again, errors are honest, and what can't be is told."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from conftest import STEEL, sections

import embate

pytest.importorskip("scipy")


def tensile(**changes: Any) -> embate.Model:
    """A tensile test: a plate is pulled at both ends, and damped, so that stress is uniform."""
    steel = {**STEEL, **changes}
    model = embate.Model(name="tensile").run(end="60 us").material("steel", **steel).output(history="1 us")
    model.part(name="bar", material="steel", stress_state="plane_stress", rectangle={"corner": (0, 0), "size": ("10 mm", "5 mm"), "elements": (2, 1)})
    model.constraint(on="bar.left", velocity={"x": "pull"}).constraint(on="bar.right", velocity={"x": 5.0})
    model.curve("pull", time=[0], value=[-5.0])
    model.load(damping=3e5)
    return model.probe(name="end", set="bar.right").probe(name="start", set="bar.left")


def curve(model: embate.Model) -> tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
    """Energy of the bar over the way of its end: what a testing machine measures, integrated."""
    history = model.simulation(threads=1).run().history
    return history["end.x"][1:], history["energy.internal"][1:]


def test_known_values_are_found_again() -> None:
    true = {"material.steel.yield": 300e6, "material.steel.hardening": 2e9}
    measured = {("end.x", "energy.internal"): curve(tensile().with_set(true))}
    found = embate.calibrate(tensile(), measured, {"material.steel.yield": (100e6, 600e6), "material.steel.hardening": (0.2e9, 5e9)}, tolerance=1e-6)
    for path, value in true.items():
        assert found.parameters[path] == pytest.approx(value, rel=2e-3), found
    assert found.success and found.residual < 1e-4 < 0.02 < found.residual_start and not found.at_bounds
    assert found.model.simulation().run().hash() == tensile().with_set(found.parameters).simulation().run().hash()
    assert len(found.table) <= 40 and found.table.column("error") == len(found.table) * [None]
    name = ("end.x", "energy.internal")
    np.testing.assert_allclose(found.fitted[name][1], measured[name][1], rtol=1e-3, atol=1e-3 * measured[name][1].max())
    assert "material.steel.yield" in repr(found) and found.correlation.shape == (2, 2)


def test_the_answer_does_not_depend_on_the_workers() -> None:
    measured = {"energy.internal": (lambda history: (history["time"], history["energy.internal"]))(tensile(hardening=3e9).simulation().run().history)}
    bounds = {"material.steel.hardening": (0.5e9, 1e9, 8e9)}
    one, two = (embate.calibrate(tensile(), measured, bounds, workers=workers) for workers in (0, 2))
    assert one.parameters == two.parameters and one.table == two.table
    assert one.parameters["material.steel.hardening"] == pytest.approx(3e9, rel=1e-3)


def test_errors_are_those_of_noise() -> None:
    # The same measurement many times over with noise: the values scatter as the errors say.
    x, y = curve(tensile())
    rng = np.random.default_rng(7)
    found, errors = [], []
    for _ in range(12):
        noisy = y + 0.01 * y.max() * rng.standard_normal(len(y))
        one = embate.calibrate(tensile(), {("end.x", "energy.internal"): (x, noisy)}, {"material.steel.yield": (100e6, 250e6, 600e6)})
        found.append(one.parameters["material.steel.yield"])
        errors.append(one.errors["material.steel.yield"])
    scatter = float(np.std(found, ddof=1))
    # χ of 11 degrees of freedom: within these bounds in more than 99.9 % of all cases.
    assert 0.4 < scatter / float(np.mean(errors)) < 1.8, (scatter, errors)


def test_loading_and_unloading_are_told_apart() -> None:
    # Pulled and let back: the same places twice, with other energies.
    def cycle(**changes: Any) -> embate.Model:
        return tensile(**changes).with_set({"curve.pull.time": [0, 40e-6, 40.1e-6], "curve.pull.value": [-5.0, -5.0, 8.0]})

    history = cycle(**{"yield": 300e6}).simulation(threads=1).run().history
    x, y = history["end.x"][1:] - history["start.x"][1:], history["energy.internal"][1:]
    turn = int(np.argmax(x))
    assert 10 < turn < len(x) - 5
    measured = {("way", "work"): (x[::2], y[::2])}

    def measure(simulation: embate.Simulation) -> dict[Any, Any]:
        it = simulation.history
        return {("way", "work"): (it["end.x"] - it["start.x"], it["energy.internal"])}

    found = embate.calibrate(cycle(), measured, {"material.steel.yield": (100e6, 600e6)}, measure=measure, tolerance=1e-6)
    assert found.parameters["material.steel.yield"] == pytest.approx(300e6, rel=2e-3), found
    far = {("end.x", "energy.internal"): ([0.010001, 0.02], [1.0, 2.0])}
    with pytest.raises(embate.RunError, match="the run does not come to 2.000000e-2"):
        embate.calibrate(tensile(), far, {"material.steel.yield": (100e6, 600e6)})


def test_what_is_blind_or_at_a_bound_is_told() -> None:
    measured = {("end.x", "energy.internal"): curve(tensile())}
    with pytest.warns(embate.Warning, match="does not depend on run.energy_limit"):
        found = embate.calibrate(tensile(), measured, {"run.energy_limit": (0.4, 0.9), "material.steel.yield": (260e6, 600e6)})
    assert math.isinf(found.errors["run.energy_limit"]) and math.isfinite(found.errors["material.steel.yield"])
    assert "material.steel.yield" in found.at_bounds


def test_numbers_of_a_function_and_weights() -> None:
    model = embate.Model(sections(), name="blocks")

    def shape(simulation: embate.Simulation) -> dict[str, float]:
        return {"strain": float(simulation.state.plastic_strain.max()), "top": float(simulation.history["top.y"][-1])}

    true = shape(model.simulation().run())
    found = embate.calibrate(model, true, {"material.steel.yield": (150e6, 200e6, 500e6)}, measure=shape, weights={"strain": 4.0}, tolerance=1e-5)
    assert found.parameters["material.steel.yield"] == pytest.approx(250e6, rel=0.02) and found.residual < 1e-2
    with pytest.raises(ValueError, match="no curve to draw"):
        found.plot()


def test_runs_that_fail_are_bad_fits_and_the_first_has_to_go() -> None:
    measured = {("end.x", "energy.internal"): curve(tensile())}
    with pytest.raises(embate.RunError, match="with the first values the model fails"):
        embate.calibrate(tensile(), measured, {"run.energy_limit": (1e-12, 1.1e-12, 0.5)})


@pytest.mark.parametrize(
    ("arguments", "error", "told"),
    [
        ({"measured": {}}, TypeError, "measured is a dict"),
        ({"measured": {"end.x": ([0, 1], [0])}}, ValueError, "as many of both"),
        ({"measured": {"end.x": float("nan")}}, ValueError, "finite"),
        ({"measured": {"end.x": "far"}}, ValueError, "far"),
        ({"parameters": {}}, TypeError, "parameters is a dict"),
        ({"parameters": {"run.end": (2, 1)}}, ValueError, "in this order"),
        ({"parameters": {"run.end": ("1 ms", "2 ms")}}, TypeError, "SI units"),
        ({"parameters": {"run.ende": (1e-5, 2e-5)}}, embate.ModelError, "ende"),
        ({"weights": {"end.y": 1}}, ValueError, "end.y"),
        ({"step": 0}, ValueError, "step"),
        ({"measured": {"end.z": 1.0}}, KeyError, "there are time"),
        ({"measured": {"end.x": ([0, 1], [0, 1])}}, ValueError, "give it a later end"),
    ],
)
def test_wrong_arguments_are_named(arguments: dict[str, Any], error: type, told: str) -> None:
    given = {"measured": {"end.x": 0.01}, "parameters": {"material.steel.yield": (200e6, 300e6)}, **arguments}
    with pytest.raises(error, match=told):
        embate.calibrate(tensile(), **given)
