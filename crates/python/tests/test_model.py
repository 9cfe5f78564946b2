"""Models: from files, dicts and keyword arguments; faults as the command tells them."""

from __future__ import annotations

import json
import pickle
import subprocess
from pathlib import Path

import numpy as np
import pytest
from conftest import ROOT, STEEL, run, sections

import embate
from embate import _embate


def test_a_file_a_dict_and_keyword_arguments_make_the_same_model(tmp_path: Path, model: embate.Model) -> None:
    built = embate.Model(name="blocks")
    given = sections()
    built.run(**given["run"]).material("steel", **STEEL)
    for part in given["part"]:
        built.part(**part)
    built.contact(**given["contact"][0]).probe(**given["probe"][0]).output(**given["output"])
    from_file = embate.Model(model.save(tmp_path / "blocks.toml"))
    hashes = {each.simulation(threads=1).run(20e-6).hash() for each in (model, built, from_file)}
    assert len(hashes) == 1
    assert built.to_toml() == model.to_toml()


def test_every_section_of_the_model_file_is_a_method_with_its_keys_told() -> None:
    for section in _embate.sections():
        method = getattr(embate.Model, section["name"])
        text = " ".join(method.__doc__.split())
        assert " ".join(section["doc"].split()) in text
        assert all(key in text for key, _ in section["keys"])


def test_what_is_written_reads_back_as_it_was() -> None:
    import tomllib

    from embate import toml

    numbers = [0.1, 1e-300, -0.0, 5, 2**62, 1 / 3]
    texts = ["plain", 'quote " and \\', "line\nend\ttab", "ünïcode", "\x01"]
    read = tomllib.loads("\n".join(f"k{i} = {toml.value(v, 'k')}" for i, v in enumerate([*numbers, *texts, True, np.float64(0.2), np.arange(3), {"a b": [1, 2.5]}])))
    assert list(read.values())[:11] == numbers + texts
    assert list(read.values())[11:] == [True, 0.2, [0, 1, 2], {"a b": [1, 2.5]}]


def test_faults_are_those_of_the_command(tmp_path: Path, command: str) -> None:
    wrong = sections(run={"end": -1, "saftey": 0.5})
    with pytest.raises(embate.ModelError) as caught:
        embate.Model(wrong, name="wrong").check()
    error = caught.value
    assert isinstance(error, ValueError) and isinstance(error, embate.Error)
    assert {fault["path"] for fault in error.faults} == {"run.end", "run.saftey"}
    assert error.code.startswith("E") and error.message and error.cure
    assert 'did you mean "safety"' in str(error) or "safety" in str(error)
    from embate import toml
    from embate._method import FORMS

    (tmp_path / "wrong.toml").write_text(toml.document(wrong, FORMS))
    told = subprocess.run([command, "check", str(tmp_path / "wrong.toml")], capture_output=True, text=True)
    assert told.returncode != 0
    for fault in error.faults:
        assert fault["code"] in told.stderr and fault["message"] in told.stderr
    again = pickle.loads(pickle.dumps(error))
    assert str(again) == str(error) and again.faults == error.faults


@pytest.mark.parametrize(
    ("changes", "error", "told"),
    [
        ({"run": {"end": float("nan")}}, ValueError, "run.end is nan"),
        ({"run": {"end": object()}}, TypeError, "run.end: a object"),
        ({"run": {3: 1}}, TypeError, "keys of a model are texts"),
        ({"part": [{"mesh": (np.zeros((3, 4)), np.zeros((1, 3), int)), "material": "steel"}]}, ValueError, "part[0].mesh: points has the shape (3, 4)"),
        ({"part": [{"mesh": 3, "material": "steel"}]}, TypeError, "part[0].mesh: a int is no mesh"),
    ],
)
def test_values_that_are_none_are_named(changes: dict, error: type, told: str) -> None:
    with pytest.raises(error, match=told.replace("[", r"\[").replace("]", r"\]").replace("(", r"\(").replace(")", r"\)")):
        embate.Model(sections(**changes)).check()


def test_keys_are_set_by_their_paths(tmp_path: Path, model: embate.Model, command: str) -> None:
    short = model.with_set({"run.end": "10 us", "part[1].velocity": (0, -40)})
    assert short.end == pytest.approx(10e-6) and model.end == pytest.approx(40e-6)
    file = model.save(tmp_path)
    out = tmp_path / "out"
    subprocess.run([command, "run", str(file), "--set", "run.end=10 us", "--set", "part[1].velocity=[0, -40]", "--out", str(out), "--quiet"], check=True)
    assert json.loads((out / "summary.json").read_text())["state_hash"] == short.simulation().run().hash()
    with pytest.raises(embate.ModelError, match="run.ende"):
        model.with_set({"run.ende": 1}).check()


def test_an_example_of_the_house_has_the_hash_of_the_command(tmp_path: Path, command: str) -> None:
    example = ROOT / "examples" / "tube-plate"
    model = embate.Model(example)
    out = tmp_path / "out"
    subprocess.run([command, "run", str(example), "--set", f"run.end={model.end / 20}", "--out", str(out), "--quiet"], check=True)
    summary = json.loads((out / "summary.json").read_text())
    simulation = model.with_set({"run.end": model.end / 20}).simulation()
    assert simulation.run().hash() == summary["state_hash"]
    assert simulation.summary["steps"] == summary["steps"]


def test_a_model_is_shown_with_a_picture_and_its_parts(model: embate.Model) -> None:
    page = model._repr_html_()
    assert "data:image/png;base64" in page and "upper" in page and "<table>" in page
    assert "<pre>" in embate.Model(name="empty")._repr_html_()
    assert "2 part" in repr(model)


def test_warnings_of_a_model_are_pythons(tmp_path: Path) -> None:
    given = sections()
    given["part"][0]["material"] = "steel"
    given["material"] = {"steel": {**STEEL, "density": 7.8}}
    model = embate.Model(given)
    told = model.check()
    if told:
        with pytest.warns(embate.Warning, match=told[0]["code"]):
            model.simulation()


def test_a_file_that_is_not_there_is_told(tmp_path: Path) -> None:
    with pytest.raises(embate.ModelError, match="there is no such file"):
        embate.Model(tmp_path / "nothing.toml").check()
    with pytest.raises(embate.ModelError, match="there is no such file"):
        embate.Model(tmp_path / "nothing.toml").run(end=1).check()


def test_the_command_computes_what_was_saved(tmp_path: Path, command: str) -> None:
    points, quads = grid(6, 3, (0.02, 0.01))
    model = embate.Model(name="grid").run(end="5 us").material("steel", **STEEL)
    model.part(name="block", mesh=(points, quads), material="steel", velocity=(3, 0))
    out = run(command, model.save(tmp_path / "saved"), tmp_path / "out")
    assert json.loads((out / "summary.json").read_text())["state_hash"] == model.simulation().run().hash()


def grid(nx: int, ny: int, size: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
    x, y = np.meshgrid(np.linspace(0, size[0], nx + 1), np.linspace(0, size[1], ny + 1))
    k = np.arange((nx + 1) * ny).reshape(ny, nx + 1)[:, :-1].ravel()
    return np.column_stack([x.ravel(), y.ravel()]), np.column_stack([k, k + 1, k + nx + 2, k + nx + 1])
