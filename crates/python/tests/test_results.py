"""Result folders: those of the command and of Python, finished, growing, failed, damaged."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from conftest import sections

import embate


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> tuple[embate.Simulation, Path]:
    """A simulation at its end and its results."""
    out = tmp_path_factory.mktemp("results") / "blocks"
    simulation = embate.Model(sections(), name="blocks").simulation().run(out=out)
    return simulation, out


def test_what_is_read_is_what_was_computed(written: tuple[embate.Simulation, Path]) -> None:
    simulation, out = written
    results = embate.results(out)
    assert results.status == "done" and results.name == "blocks" and results.parts == ["lower", "upper"]
    assert results.summary["state_hash"] == simulation.hash() and results.post_mortem is None
    history = results.history
    assert list(history) == list(simulation.history)
    for name in history:
        np.testing.assert_array_equal(history[name], simulation.history[name], err_msg=name)
    frames = results.frames
    # The first step at or after each time.
    late = frames.times - np.arange(5) * 10e-6
    assert (late >= 0).all() and (late < 3e-7).all()
    last, state = frames[-1], simulation.state
    assert last.time == simulation.time and len(last.fields) > 8
    np.testing.assert_array_equal(last.position, state.position)
    for name in last.fields:
        np.testing.assert_array_equal(last.field(name), state.field(name), err_msg=name)
    np.testing.assert_array_equal(last.cells["quad"], simulation.cells["quad"])
    np.testing.assert_array_equal(last.cell_part, simulation.cell_part)
    assert frames.field("stress").shape == (5, 55, 4) and frames.at(21e-6).number == 2 and len(frames[1:3]) == 2
    assert "von_mises" in dir(last) and "blocks, done" in repr(results) and "<table>" in results._repr_html_()
    with pytest.raises(AttributeError, match="it has displacement"):
        last.strees


def test_results_of_the_command_have_their_model_and_units(tmp_path: Path, command: str, model: embate.Model) -> None:
    file = model.save(tmp_path / "blocks")
    out = tmp_path / "out"
    subprocess.run([command, "run", str(file), "--set", "run.end=10 us", "--out", str(out), "--quiet"], check=True)
    results = embate.results(str(out))
    assert results.model.end == pytest.approx(10e-6)
    assert results.model.simulation().run().hash() == results.summary["state_hash"]
    units = results.history.units
    assert (units["time"], units["energy.kinetic"], units["top.vy"]) == ("s", "J/m", "m/s")
    assert results.provenance["keys"]["material.steel.parameters.density"] == "7800.0"


def test_tables_grids_and_data_sets(written: tuple[embate.Simulation, Path]) -> None:
    simulation, out = written
    results = embate.results(out)
    pandas = pytest.importorskip("pandas")
    nodes, cells = results.frames[-1].to_pandas(), results.frames[-1].to_pandas("cells")
    assert isinstance(nodes, pandas.DataFrame) and len(nodes) == 80 and len(cells) == 55
    np.testing.assert_array_equal(nodes["velocity_y"], simulation.state.velocity[:, 1])
    np.testing.assert_array_equal(cells[cells.part == "upper"].stress_xy, simulation.state.stress[30:, 3])
    assert results.to_pandas().index.name == "time"
    with pytest.raises(ValueError, match="location"):
        results.frames[-1].to_pandas("edges")
    xarray = pytest.importorskip("xarray")
    data = results.to_xarray(["stress", "von_mises", "velocity"])
    assert isinstance(data, xarray.Dataset) and dict(data.sizes) == {"time": 5, "node": 80, "axis": 2, "cell": 55, "pair": 4}
    np.testing.assert_array_equal(data.stress.sel(pair="yy").isel(time=-1), simulation.state.stress[:, 1])
    assert data.von_mises.attrs["units"] == "Pa" and data.stress.isel(cell=data.part == "upper").shape == (5, 25, 4)
    assert set(results.to_xarray().data_vars) == {"position", *results.frames[0].fields}
    assert results.history.to_xarray()["top.vy"].dims == ("time",)
    with pytest.raises(ValueError, match="strees"):
        results.to_xarray(["strees"])


def test_frames_are_drawn_and_become_grids(written: tuple[embate.Simulation, Path]) -> None:
    simulation, out = written
    frame = embate.results(out).frames[-1]
    plt = pytest.importorskip("matplotlib.pyplot")
    axes = frame.plot("von_mises")
    assert "blocks" in axes.get_title()
    plt.close(axes.figure)
    pytest.importorskip("pyvista")
    grid, own = frame.to_pyvista(), simulation.to_pyvista()
    np.testing.assert_array_equal(grid.points, own.points)
    np.testing.assert_array_equal(grid.cell_data["von_mises"], own.cell_data["von_mises"])
    assert embate.results(out).to_pyvista().n_cells == 55


def test_a_run_that_goes_on_is_read_as_far_as_it_is(tmp_path: Path, model: embate.Model) -> None:
    out = tmp_path / "out"
    seen: list[tuple[str, int, int]] = []

    def look(it: embate.Simulation) -> None:
        results = embate.results(out)
        history = results.history
        rows = len(history["time"]) if "time" in history else 0
        if rows:
            np.testing.assert_array_equal(history["top.vy"], it.history["top.vy"][:rows])
        for frame in results.frames:
            assert frame.position.shape == (80, 2)
        seen.append((results.status, rows, len(results.frames)))

    simulation = model.simulation()
    simulation.every(25, look)
    simulation.run(out=out)
    assert {status for status, _, _ in seen} == {"unfinished"} and seen == sorted(seen)
    assert embate.results(out).status == "done"


def test_a_run_that_was_killed_is_read_as_far_as_it_was(tmp_path: Path, model: embate.Model, command: str) -> None:
    file = model.save(tmp_path / "blocks")
    out = tmp_path / "out"
    process = subprocess.Popen([command, "run", str(file), "--set", "run.end=1 s", "--set", "output.fields=1 us", "--out", str(out), "--quiet"])
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline and not (out.is_dir() and len(embate_frames(out)) > 2):
        time.sleep(0.05)
    process.kill()
    process.wait()
    results = embate.results(out)
    assert results.status == "unfinished" and len(results.frames) > 2 and results.parts == ["lower", "upper"]
    assert results.frames[-1].von_mises.shape == (55,) and results.model.parts == ["lower", "upper"]
    assert "unfinished" in repr(results)


def embate_frames(out: Path) -> list[Path]:
    return sorted((out / "fields").glob("frame-*.vtu")) if (out / "fields").is_dir() else []


def test_what_is_damaged_or_missing_is_told(written: tuple[embate.Simulation, Path], tmp_path: Path) -> None:
    with pytest.raises(embate.FileError, match="is no folder") as caught:
        embate.results(tmp_path / "nothing")
    assert caught.value.code == "E0722"
    (tmp_path / "empty").mkdir()
    with pytest.raises(embate.FileError, match="holds no results"):
        embate.results(tmp_path / "empty")
    out = tmp_path / "copy"
    shutil.copytree(written[1], out)
    results = embate.results(out)
    frame = results.frames[2]
    whole = frame._file.read_bytes()
    for data in (whole[:300], whole[: len(whole) // 2], b"", whole[:-200] + bytes(200)):
        frame._file.write_bytes(data)
        try:
            again = embate.results(out).frames
            for each in again:
                assert each.position.shape == (80, 2) and each.stress.shape == (55, 4) and len(each.cells) == 1
        except embate.FileError as error:
            assert "frame-00002.vtu" in str(error)
    (out / "summary.json").write_text("{")
    with pytest.raises(embate.FileError, match="summary.json is damaged"):
        results.status
    if hasattr(os, "mkfifo"):
        (out / "run.json").unlink(missing_ok=True)
        os.mkfifo(out / "run.json")
        with pytest.raises(embate.FileError, match="no plain file"):
            results.provenance
        (out / "run.json").unlink()
    (out / "history.csv").write_text("time,a\n0,x\n")
    with pytest.raises(embate.FileError, match="line 2"):
        results.history


def test_a_model_in_memory_is_beside_its_results(tmp_path: Path, command: str) -> None:
    x, y = np.meshgrid(np.linspace(0.006, 0.014, 6), np.linspace(0.0062, 0.0142, 6))
    points = np.column_stack([x.ravel(), y.ravel()])
    corner = (np.arange(5)[:, None] * 6 + np.arange(5)).ravel()
    quads = np.column_stack([corner, corner + 1, corner + 7, corner + 6])
    given = sections()
    given["part"][1] = {"name": "upper", "material": "steel", "mesh": (points, quads), "velocity": (0, -80)}
    model = embate.Model(given, name="blocks", set={"run.end": "30 us"})
    out = tmp_path / "out"
    simulation = model.simulation().run(out=out)
    assert sorted(file.name for file in (out / "model-of-run").iterdir()) == ["blocks.toml", "mesh-1.msh"]
    results = embate.results(out)
    assert results.model.end == pytest.approx(30e-6) and results.model.simulation().run().hash() == simulation.hash()
    assert [part["name"] for part in results.provenance["parts"]] == ["lower", "upper"]

    def by_command(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
        return subprocess.run([command, *map(str, arguments)], capture_output=True, text=True, check=False)

    replayed = by_command("replay", out, "--from", "20 us", "--to", "22 us", "--output-every", "1 us", "--quiet")
    assert replayed.returncode == 0, replayed.stderr
    assert by_command("report", out).returncode == 0
    model.with_set({"part[1].velocity": (0, -81)}).simulation().run(out=tmp_path / "other")
    differs = by_command("diff", out, tmp_path / "other")
    assert differs.returncode == 1 and "part[1].velocity" in differs.stdout + differs.stderr, differs.stdout + differs.stderr
    assert "--model-" not in differs.stderr, differs.stderr
    # One that names files is not there, and who asks for it is told so.
    folder = embate.Model(given, name="blocks").save(tmp_path / "saved.toml").parent
    group = (folder / "saved.toml").read_text().split('group = "')[1].split('"')[0]
    given["part"][1]["mesh"] = {"file": "mesh-1.msh", "group": group}
    named = tmp_path / "named"
    embate.Model(given, name="blocks", folder=folder).simulation().run(out=named)
    assert not (named / "model-of-run").exists()
    with pytest.raises(embate.FileError, match="names files"):
        embate.results(named).model
    refused = by_command("replay", named, "--from", "20 us", "--to", "22 us", "--output-every", "1 us", "--quiet")
    assert refused.returncode == 2 and "names files" in refused.stderr, refused.stderr
    again = by_command("replay", named, "--from", "20 us", "--to", "22 us", "--output-every", "1 us", "--quiet", "--model", folder / "saved.toml")
    assert again.returncode == 0, again.stderr
    # A section that was given later is not of this simulation.
    later = embate.Model(sections(), name="blocks")
    simulation = later.simulation()
    later.probe(name="more", set="upper")
    simulation.run(out=tmp_path / "later")
    assert not (tmp_path / "later" / "model-of-run").exists()


def test_a_run_that_fails_has_its_post_mortem_and_says_where(tmp_path: Path, model: embate.Model) -> None:
    out = tmp_path / "out"
    failing = model.with_set({"run.energy_limit": 1e-9})
    with pytest.raises(embate.RunError) as caught:
        failing.simulation().run(out=out)
    error = caught.value
    page = out / "post-mortem" / "README.md"
    assert error.post_mortem == page and error.results == out and str(page) in str(error)
    assert "went once more" in page.read_text()
    results = embate.results(out)
    assert results.status == "failed" and results.post_mortem == page and results.summary["post_mortem"] == "post-mortem/README.md"
    assert len(results.frames) >= 1
    # The state of the failure can be looked at, and without a folder for results the page is made when it is asked for.
    other = failing.simulation()
    with pytest.raises(embate.RunError) as caught:
        other.run()
    assert caught.value.post_mortem is None and "post-mortem" not in str(caught.value)
    made = other.post_mortem(tmp_path / "asked")
    assert made.read_text() == page.read_text()
    with pytest.raises(embate.StateError, match="has not failed"):
        model.simulation().post_mortem(tmp_path / "none")
    # One that was changed on its way can't go there once more.
    steered = failing.simulation()
    steered.every(1, lambda it: it.set_force([0], (1.0, 0.0)))
    with pytest.raises(embate.RunError):
        steered.run(out=tmp_path / "steered")
    text = (tmp_path / "steered" / "post-mortem" / "README.md").read_text()
    assert "has changed it on the way" in text


def test_numpy_is_enough(tmp_path: Path) -> None:
    """A script without any package but numpy: a run with its progress, results, a sweep; and what says which package it needs."""
    script = tmp_path / "bare.py"
    script.write_text(
        "import sys\n"
        "for name in ('matplotlib', 'pandas', 'pyvista', 'scipy', 'tqdm', 'xarray'):\n"
        "    sys.modules[name] = None\n"
        "import embate\n"
        f"model = embate.Model({sections()!r})\n"
        "simulation = model.simulation().run(progress=True, out='out')\n"
        "assert embate.results('out').frames[-1].time == simulation.time\n"
        "embate.sweep(model, {'run.safety': [0.5, 0.9]}, until=2e-6, progress=True)\n"
        "for needs, call in [('pandas', simulation.history.to_pandas), ('xarray', embate.results('out').to_xarray), ('matplotlib', simulation.plot),\n"
        "                    ('pyvista', simulation.to_pyvista), ('scipy', lambda: embate.calibrate(model, {'top.y': 1.0}, {'run.safety': (0.1, 0.9)}))]:\n"
        "    try:\n"
        "        call()\n"
        "    except ImportError as error:\n"
        "        assert f'pip install {needs}' in str(error), error\n"
        "    else:\n"
        "        raise AssertionError(needs)\n"
        "model._repr_html_()\n"
    )
    done = subprocess.run([sys.executable, "-W", "error", str(script)], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "100.0 % |##############################|" in done.stderr and "2/2 run" in done.stderr


def test_channels_are_formulas_of_the_columns() -> None:
    simulation = embate.Model(sections()).simulation().run()
    history = simulation.history
    total = history.channel("energy.kinetic + energy.internal*2 - t")
    assert np.array_equal(total, history["energy.kinetic"] + history["energy.internal"] * 2 - history["time"])
    smooth = history.channel("energy.kinetic", corner=1.0)
    assert smooth.shape == total.shape
    with pytest.raises(ValueError, match="did you mean `energy.kinetic`"):
        history.channel("energy.kinetik")
    with pytest.raises(ValueError, match="CFC 1000"):
        history.channel("t", filter="CFC 61")
