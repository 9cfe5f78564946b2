"""Files that the package writes: whole or not at all, and never through a link."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

import embate
from embate.whole import written

links = pytest.mark.skipif(os.name == "nt", reason="links need a privilege there")


def test_what_was_left_is_replaced_and_a_write_that_fails_leaves_what_was(tmp_path: Path) -> None:
    path = tmp_path / "a"
    (tmp_path / "a.part").write_text("left")
    with written(path) as file:
        file.write(b"new")
    with pytest.raises(ZeroDivisionError), written(path) as file:
        file.write(b"half")
        raise ZeroDivisionError
    assert [(own.name, own.read_text()) for own in tmp_path.iterdir()] == [("a", "new")]


@links
def test_no_link_is_written_through(tmp_path: Path, model: embate.Model) -> None:
    target = tmp_path / "target"
    target.write_text("mine")
    writers = {"model.toml": model.save, "state.embate": model.simulation().save}
    for name, write in writers.items():
        (tmp_path / name).symlink_to(target)
        write(tmp_path / name)
        assert not (tmp_path / name).is_symlink()
        part = tmp_path / f"{name}.part"
        part.symlink_to(target)
        with pytest.raises(embate.FileError, match="no plain file"):
            write(tmp_path / name)
        assert part.is_symlink()
    assert target.read_text() == "mine"


@links
def test_results_are_not_written_through_a_link(tmp_path: Path, model: embate.Model) -> None:
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "fields").symlink_to(elsewhere)
    with pytest.raises(embate.Error, match="symbolic link"):
        model.simulation().run(out=tmp_path / "out", force=True)
    assert not list(elsewhere.iterdir())
