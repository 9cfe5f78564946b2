"""Simulations: runs in pieces, arrays, history, results, saved states, threads."""

from __future__ import annotations

import csv
import json
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from conftest import STEEL, run, sections

import embate


def test_a_run_in_pieces_is_the_whole_run_to_the_last_bit(model: embate.Model) -> None:
    whole = model.simulation(threads=1).run()
    pieces = model.simulation(threads=2)
    pieces.step(7)
    pieces.run(11e-6).run(12.5e-6).step(3).run()
    assert pieces.is_over and pieces.hash() == whole.hash()
    assert pieces.steps == whole.steps
    for name in whole.history:
        np.testing.assert_array_equal(pieces.history[name], whole.history[name], err_msg=name)
    assert pieces.run().step().hash() == whole.hash()


def test_results_are_those_of_the_command(tmp_path: Path, model: embate.Model, command: str) -> None:
    out = run(command, model.save(tmp_path / "model"), tmp_path / "command")
    simulation = model.simulation()
    simulation.run(out=tmp_path / "python")
    summary = json.loads((out / "summary.json").read_text())
    assert simulation.hash() == summary["state_hash"]
    assert (tmp_path / "python" / "history.csv").read_bytes() == (out / "history.csv").read_bytes()
    rows = list(csv.reader((out / "history.csv").read_text().splitlines()))
    assert [name.split(" ")[0] for name in rows[0]] == list(simulation.history) or len(rows[0]) == len(simulation.history)
    np.testing.assert_array_equal(np.array(rows[1:], float), simulation.history._values)
    fields = {path.name: path.read_bytes() for path in (out / "fields").iterdir()} if (out / "fields").is_dir() else {}
    for name, data in fields.items():
        assert (tmp_path / "python" / "fields" / name).read_bytes() == data, name
    with pytest.raises(embate.FileError):
        model.simulation().run(out=tmp_path / "python")
    model.simulation().run(10e-6, out=tmp_path / "python", force=True)
    assert json.loads((tmp_path / "python" / "summary.json").read_text())["status"] == "stopped"


def test_arrays_are_read_only_copies_of_the_state(model: embate.Model) -> None:
    simulation = model.simulation()
    before = simulation.state.position
    assert before.shape == (11 * 4 + 6 * 6, 2) and not before.flags.writeable
    simulation.run(9e-6)
    after = simulation.state
    np.testing.assert_allclose(after.position - before, after.displacement, atol=1e-15)
    assert after.velocity.shape == before.shape
    assert after.stress.shape == (30 + 25, 4) and after.von_mises.shape == (55,)
    assert np.abs(after.contact_force).max() > 0
    np.testing.assert_allclose(after.contact_force.sum(axis=0), 0, atol=1e-6 * np.abs(after.contact_force).sum())
    with pytest.raises(ValueError):
        after.velocity[0] = 1.0
    with pytest.raises(AttributeError, match="von_mises"):
        after.strees
    assert set(simulation.cells) == {"quad"} and simulation.cells["quad"].shape == (55, 4)
    assert (simulation.cell_part == "lower").sum() == 30
    history = simulation.history
    assert "time" in history and len(history["time"]) == 10
    with pytest.raises(KeyError, match="there are"):
        history["nothing"]


def test_the_energy_is_kept(model: embate.Model) -> None:
    simulation = model.simulation()
    start = simulation.energy["total"]
    simulation.run()
    energy = simulation.energy
    assert abs(energy["total"] - start) < 0.01 * start
    for name in energy.keys() - {"drift"}:
        assert energy[name] == simulation.history[f"energy.{name}"][-1], name
    assert energy["drift"] < 0.01 and energy["plastic"] > 0


@pytest.mark.parametrize("kind", ["dict", "file"])
def test_a_saved_state_goes_on_with_the_same_bits(tmp_path: Path, model: embate.Model, kind: str) -> None:
    if kind == "file":
        model = embate.Model(model.save(tmp_path / "model"), set={"run.safety": 0.8})
    whole = model.simulation().run()
    half = model.simulation().run(17e-6)
    saved = half.save(tmp_path / "half.embate")
    half.close()
    again = embate.load(saved, threads=2)
    assert again.time == pytest.approx(17e-6, abs=1e-6)
    again.run()
    assert again.hash() == whole.hash()
    for name in whole.history:
        np.testing.assert_array_equal(again.history[name], whole.history[name], err_msg=name)
    path = again.checkpoint(tmp_path / "states")
    assert embate.load(path).hash() == whole.hash()
    assert path.name == f"{again.steps:012}.embate" and path.exists()
    (tmp_path / "damaged").write_bytes(saved.read_bytes()[:200])
    with pytest.raises(embate.FileError, match="damaged"):
        embate.load(tmp_path / "damaged")


def test_callbacks_are_called_after_their_steps(model: embate.Model) -> None:
    simulation, seen = model.simulation(), []
    by_three = simulation.every(3, lambda it: seen.append(it.steps))
    simulation.step(10)
    assert seen == [3, 6, 9]
    simulation.forget(by_three)
    simulation.run()
    assert seen == [3, 6, 9]

    def fails(_: embate.Simulation) -> None:
        raise LookupError("enough")

    other = model.simulation()
    other.every(5, fails)
    with pytest.raises(LookupError):
        other.run()
    assert other.steps == 5
    assert other.step().steps == 6


def test_progress_is_told(model: embate.Model, capsys: pytest.CaptureFixture[str]) -> None:
    told: list[float] = []
    model.simulation().run(progress=told.append)
    assert told[-1] == 1.0 and told == sorted(told)
    pytest.importorskip("tqdm")
    model.simulation().run(progress=True)
    assert "100" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "error", "told"),
    [
        (lambda s: s.run("soon"), TypeError, "until"),
        (lambda s: s.run(-1.0), ValueError, "until"),
        (lambda s: s.step(1.5), TypeError, "n is 1.5"),
        (lambda s: s.step(-1), ValueError, "n is -1"),
        (lambda s: s.every(0, print), ValueError, "n is 0"),
        (lambda s: s.every(1, "print"), TypeError, "function"),
        (lambda s: s.model.simulation(threads="many"), TypeError, "threads"),
        (lambda s: s.model.simulation(instruction_set="mmx"), embate.ModelError, "mmx"),
        (lambda s: s.plot("strees"), ValueError, "strees"),
        (lambda s: s.plot("stress", component="zx"), ValueError, "zx"),
    ],
)
def test_wrong_arguments_are_named(model: embate.Model, arguments, error: type, told: str) -> None:
    with pytest.raises(error, match=told):
        arguments(model.simulation())


def test_a_run_that_fails_can_be_looked_at(tmp_path: Path) -> None:
    given = sections(run={"end": "40 us", "energy_limit": 1e-9})
    simulation = embate.Model(given).simulation()
    with pytest.raises(embate.RunError, match="energy drift") as caught:
        simulation.run(out=tmp_path / "out")
    assert caught.value.code.startswith("E")
    assert np.isfinite(simulation.state.position).all() and simulation.steps > 0
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["status"] == "failed"
    with pytest.raises(embate.StateError, match="has failed"):
        simulation.step()


def test_the_interpreter_is_free_while_it_steps(model: embate.Model) -> None:
    simulation = model.with_set({"run.end": "2 ms"}).simulation(threads=1)
    thread = threading.Thread(target=simulation.run)
    thread.start()
    counted, begin = 0, time.monotonic()
    while thread.is_alive() and time.monotonic() - begin < 20:
        counted += 1
        time.sleep(0)
    thread.join()
    assert counted > 100


def test_pictures_are_drawn(tmp_path: Path, model: embate.Model) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    simulation = model.simulation().run(20e-6)
    for options in ({}, {"field": "von_mises"}, {"field": "velocity"}, {"field": "stress", "component": "yy"}):
        axes = simulation.plot(**options)
        axes.figure.savefig(tmp_path / "picture.png", dpi=60)
        plt.close(axes.figure)
    assert (tmp_path / "picture.png").stat().st_size > 5000


def test_solids_are_drawn_from_outside(tmp_path: Path) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    from embate.plotting import _faces

    cube = {"box": {"corner": [0, 0, 0], "size": [0.01, 0.01, 0.01], "elements": [4, 4, 4]}, "name": "cube", "material": "steel", "velocity": [1, 0, 0]}
    simulation = embate.Model(name="cube", run={"end": "1 us"}, material={"steel": STEEL}, part=[cube]).simulation()
    polygons, owners = _faces(simulation.cells, simulation.cell_index, np.ones(64, bool))
    assert [len(each) for each in polygons] == [6 * 16] and len(set(owners[0].tolist())) == 64 - 8
    for field in (None, "velocity"):
        axes = simulation.plot(field)
        axes.figure.savefig(tmp_path / "solid.png", dpi=60)
        plt.close(axes.figure)
    assert (tmp_path / "solid.png").stat().st_size > 5000


@pytest.mark.parametrize("size", [(0.2, 0.004), (0.01, 0.2), (0.1, 0.1), (0.006, 0.007, 0.03), (0.2, 0.2, 0.01), (0.3, 0.02, 0.02)])
def test_pictures_fit_their_bodies_and_labels_stand_apart(size: tuple[float, ...]) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    form = "rectangle" if len(size) == 2 else "box"
    parts = [
        {form: {"corner": [k * 1.1 * size[0]] + [0.0] * (len(size) - 1), "size": list(size), "elements": [2] * len(size)}, "name": f"body{k}", "material": "steel"}
        for k in range(2)
    ]
    simulation = embate.Model(name="sizes", run={"end": "1 us"}, material={"steel": STEEL}, part=parts).simulation()
    for field in (None, "von_mises"):
        axes = simulation.plot(field)
        figure = axes.figure
        figure.canvas.draw()
        whole, width, height = figure.bbox, *figure.get_size_inches()
        if len(size) == 2:
            # The bodies fill what the figure is for; what is beside and around them has a fixed size.
            box = axes.get_window_extent()
            assert width - box.width / figure.dpi < 2.7 and height - box.height / figure.dpi < 2.7, (size, field)
        for axis in [axes.xaxis, axes.yaxis] + ([axes.zaxis] if len(size) == 3 else []):
            labels = [label.get_window_extent() for label in axis.get_ticklabels() if label.get_text() and label.get_visible()]
            low, high = sorted(axis.get_view_interval())
            shown = [box for box, at in zip(labels, axis.get_ticklocs()) if low <= at <= high]
            assert not any(one.overlaps(other) for k, one in enumerate(shown) for other in shown[:k]), (size, field, axis.axis_name)
            name = axis.label.get_window_extent()
            assert whole.x0 <= name.x0 and whole.y0 <= name.y0 and name.x1 <= whole.x1 and name.y1 <= whole.y1, (size, field, axis.axis_name)
        plt.close(figure)


def test_tables_of_pandas(model: embate.Model) -> None:
    pytest.importorskip("pandas")
    history = model.simulation().run(10e-6).history
    table = history.to_pandas()
    assert table.index.name == "time" and len(table) == len(history["time"])
    assert "top.y" in table.columns
    assert "<table>" in history._repr_html_()
