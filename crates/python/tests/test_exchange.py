"""A part goes over to another mesh in the run."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import STEEL, sections

import embate


def refined(state: Any, part: str = "block") -> embate.Mesh:
    """The quadrilaterals of a part now, each cut into four."""
    quads = state.cells["quad"][state.cell_part == part]
    points = [tuple(place) for place in state.position]
    middles: dict[tuple[int, ...], int] = {}

    def middle(*nodes: int) -> int:
        key = tuple(sorted(nodes))
        if key not in middles:
            middles[key] = len(points)
            points.append(tuple(np.mean([points[node] for node in nodes], axis=0)))
        return middles[key]

    cells = []
    for corners in quads.tolist():
        centre = middle(*corners)
        for k, corner in enumerate(corners):
            cells.append((corner, middle(corner, corners[(k + 1) % 4]), centre, middle(corners[k - 1], corner)))
    used, numbers = np.unique(cells, return_inverse=True)
    return embate.Mesh(np.array(points)[used], {"quad": numbers.reshape(-1, 4)})


def thrown() -> embate.Model:
    """A block of steel that spins as it flies."""
    part = {"name": "block", "material": "steel", "rectangle": {"corner": [0, 0], "size": ["20 mm", "10 mm"], "elements": [8, 4]}, "velocity": (30, -80), "spin": 4000}
    return embate.Model({"run": {"end": "40 us"}, "material": {"steel": STEEL}, "part": [part], "output": {"history": "1 us"}}, name="thrown")


def test_a_part_goes_on_with_finer_elements_and_nothing_is_lost() -> None:
    simulation = thrown().simulation().run(20e-6)
    before, rows = simulation.energy, len(simulation.history["time"])
    event = simulation.exchange("block", refined(simulation.state))
    assert event["elements"] == [32, 128] and event["part"] == "block" and simulation.summary["remeshings"] == [event]
    assert max(event["momentum_change"]) < 1e-12 and abs(event["volume_change"]) < 1e-12 and event["kinetic_lost"] >= 0
    after = simulation.energy
    assert after["kinetic"] <= before["kinetic"] * (1 + 1e-12)
    # The energy of the row lies between those of the two half steps around it.
    assert after["kinetic"] + event["kinetic_lost"] == pytest.approx(before["kinetic"], rel=1e-6)
    assert simulation.state.position.shape == (17 * 9, 2) and len(simulation.cells["quad"]) == 128
    # What was reported before stays, with nothing lost until then.
    assert len(simulation.history["time"]) == rows and (simulation.history["energy.remap"] == 0).all()
    simulation.run()
    assert simulation.is_over and simulation.energy["drift"] < 1e-3
    assert np.isfinite(simulation.history["energy.remap"]).all() and simulation.history["time"][-1] == pytest.approx(40e-6)


def test_it_has_the_same_bits_again_with_more_threads_and_from_a_saved_state(tmp_path: Path) -> None:
    def half(threads: int) -> embate.Simulation:
        simulation = thrown().simulation(threads=threads).run(20e-6)
        simulation.exchange("block", refined(simulation.state))
        return simulation

    one, two = half(1), half(2)
    later = embate.load(one.save(tmp_path / "saved"))
    assert one.run().hash() == two.run().hash() == later.run().hash()
    for name in one.history:
        np.testing.assert_array_equal(one.history[name], later.history[name], err_msg=name)


def test_results_begin_there_and_the_command_continues_them(tmp_path: Path, command: str) -> None:
    model = embate.Model(thrown().save(tmp_path / "model"))
    simulation = model.simulation().run(20e-6)
    simulation.exchange("block", refined(simulation.state))
    out = tmp_path / "results"
    simulation.run(30e-6, out=out)
    begun = json.loads((out / "run.json").read_text())["exchanged"]
    assert begun["part"] == "block" and begun["step"] > 0
    subprocess.run([command, "resume", str(out), "--quiet"], check=True)
    assert json.loads((out / "summary.json").read_text())["state_hash"] == simulation.run().hash()


@pytest.mark.parametrize(
    ("change", "error", "told"),
    [
        ({"part": "blok"}, embate.ModelError, "block"),
        ({"mesh": Path("nowhere.msh")}, embate.ModelError, "nowhere.msh"),
        ({"group": "none"}, embate.ModelError, "none"),
        ({"scale": 2.0}, embate.ModelError, "E0613"),
        ({"scale": -1}, ValueError, "scale"),
        ({"mesh": 7}, TypeError, "int"),
    ],
)
def test_what_can_not_be_is_told_and_changes_nothing(change: dict[str, Any], error: type, told: str) -> None:
    simulation = thrown().simulation().run(20e-6)
    before, columns = simulation.hash(), list(simulation.history)
    arguments = {"part": "block", "mesh": refined(simulation.state), **change}
    with pytest.raises(error, match=told):
        simulation.exchange(arguments.pop("part"), arguments.pop("mesh"), **arguments)
    assert simulation.hash() == before and list(simulation.history) == columns
    assert simulation.run().is_over


def test_a_callback_can_not_exchange_and_contacts_go_over() -> None:
    simulation = embate.Model(sections(), name="blocks").simulation()
    told: list[str] = []

    def change(it: embate.Simulation) -> None:
        try:
            it.exchange("upper", refined(it.state, "upper"))
        except embate.StateError as error:
            told.append(str(error))

    simulation.every(10, change)
    simulation.run(10e-6)
    assert told and "one thing at a time" in told[0]
    simulation.forget(change)
    event = simulation.exchange("upper", refined(simulation.state, "upper"))
    assert max(event["momentum_change"]) < 1e-12
    assert simulation.run().summary["contact"]["unverified"] == 0
