"""What the tests share: a small impact of the plane, and the command to compare with."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest

import embate

#: Folder of the project, for its examples.
ROOT = Path(os.environ.get("EMBATE_ROOT") or Path(__file__).resolve().parents[3])

STEEL = {"law": "j2", "density": 7800, "young": 210e9, "poisson": 0.3, "yield": 250e6, "hardening": 1e9}


def sections(**changes: Any) -> dict[str, Any]:
    """A block that hits another one."""
    model: dict[str, Any] = {
        "run": {"end": "40 us"},
        "material": {"steel": STEEL},
        "part": [
            {"name": "lower", "material": "steel", "rectangle": {"corner": ["0 mm", "0 mm"], "size": ["20 mm", "6 mm"], "elements": [10, 3]}},
            {
                "name": "upper",
                "material": "steel",
                "rectangle": {"corner": ["6 mm", "6.2 mm"], "size": ["8 mm", "8 mm"], "elements": [5, 5]},
                "velocity": (0, -80),
            },
        ],
        "contact": [{"between": ["lower", "upper"], "friction": 0.2}],
        "probe": [{"name": "top", "part": "upper", "point": ["10 mm", "14.2 mm"]}],
        "output": {"history": "1 us", "fields": "10 us"},
    }
    return {**model, **changes}


@pytest.fixture
def model() -> embate.Model:
    return embate.Model(sections(), name="blocks")


@pytest.fixture(scope="session")
def command() -> str:
    """The command `embate`, to compare with."""
    found = os.environ.get("EMBATE") or shutil.which("embate")
    if not found:
        pytest.skip("EMBATE does not name the command")
    return found


def run(command: str, model: Path, out: Path) -> Path:
    subprocess.run([command, "run", str(model), "--out", str(out), "--quiet"], check=True)
    return out
