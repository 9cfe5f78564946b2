"""The methods of sections: their signatures are the schema's, faults come with the call, and files are added to."""

from __future__ import annotations

import inspect
import json
import keyword
import subprocess
import sys
import typing
from pathlib import Path
from typing import Any

import pytest
from conftest import STEEL, sections

import embate
from embate import _embate, _sections

SCHEMA = json.loads(_embate.schema())
FORMS = {section["name"]: section["form"] for section in _embate.sections()}
#: Keys that Python alone has.
OWN = {"part": {"group"}}


def argument(key: str) -> str:
    return f"{key}_" if keyword.iskeyword(key) else key


def tables(section: str) -> list[dict[str, Any]]:
    """The tables that a section may be, in the schema."""
    found = SCHEMA["properties"][section]
    if FORMS[section] == "list":
        found = found["items"]
    if FORMS[section] == "named":
        found = found["additionalProperties"]
    return found["oneOf"] if "oneOf" in found else [found]


def inner(schema: dict[str, Any]) -> dict[str, Any] | None:
    """The table that a value of a key may be, or one of a list of such."""
    for one in [schema, *schema.get("anyOf", [])]:
        one = one.get("items", one) if one.get("type") == "array" else one
        if one.get("type") == "object":
            return one
    return None


def class_of(annotation: str) -> Any:
    """The type of a table among the words of an annotation."""
    words = [word for word in annotation.replace("|", " ").replace("[", " ").replace("]", " ").split() if word != "None"]
    found = [getattr(_sections, word) for word in words if typing.is_typeddict(getattr(_sections, word, None))]
    return found[0] if found else None


def compare(table: dict[str, Any], annotations: dict[str, str], where: str, own: frozenset[str] | set[str] = frozenset()) -> int:
    """Holds the keys of a table against those of a type, down to the last; counts them."""
    names = set(table["properties"])
    assert {argument(name) for name in names} | set(own) == set(annotations) or names == set(annotations), where
    count = len(names)
    for name, schema in table["properties"].items():
        annotation = annotations[name if name in annotations else argument(name)]
        within = inner(schema)
        of = class_of(annotation)
        assert (within is None) == (of is None), f"{where}.{name}: {annotation}"
        if within is not None:
            fields = {key: getattr(value, "__forward_arg__", value) for key, value in of.__annotations__.items()}
            count += compare(within, fields, f"{where}.{name}")
        words = schema.get("enum") or next((one["enum"] for one in schema.get("anyOf", []) if "enum" in one), None)
        # Names of the library are texts: a list of them all would hide what completes.
        if words and f"{where}.{name}" != "material.from":
            assert all(f'"{word}"' in annotation or f"'{word}'" in annotation for word in words), f"{where}.{name}: {annotation}"
    return count


def test_signatures_have_every_key_of_the_schema_and_no_other() -> None:
    assert set(FORMS) == set(SCHEMA["properties"]) - {"title"}
    count = 0
    for section in FORMS:
        arguments = dict(inspect.signature(getattr(embate.Model, section)).parameters)
        assert arguments.pop("self") and (FORMS[section] != "named" or arguments.pop("name").kind == inspect.Parameter.POSITIONAL_OR_KEYWORD)
        annotations = {name: parameter.annotation.removesuffix(" | None") for name, parameter in arguments.items()}
        variants = tables(section)
        merged = {"properties": {name: schema for table in variants for name, schema in table["properties"].items()}}
        if len(variants) > 1:
            # Each variant has one law; those of the library come after the others.
            laws = list(dict.fromkeys(table["properties"]["law"]["const"] for table in variants))
            assert annotations["law"] == f"Literal[{', '.join(map(repr, laws))}]"
            merged["properties"]["law"] = {"enum": laws}
        count += compare(merged, annotations, section, OWN.get(section, set()))
        required = {name for name, parameter in arguments.items() if parameter.default is inspect.Parameter.empty}
        everywhere = set.intersection(*(set(table["required"]) for table in variants))
        wanted = set() if FORMS[section] == "table" else {argument(name) for name in everywhere}
        if len(variants) == 1:
            assert required == wanted, section
        else:
            assert required <= wanted, section
    assert count > 400


def test_each_key_is_explained() -> None:
    for section in _embate.sections():
        text = " ".join((getattr(embate.Model, section["name"]).__doc__ or "").split())
        for key, doc in section["keys"]:
            assert f"{argument(key)} " in text and " ".join(doc.split()).replace("\\", "\\\\")[:60] in text.replace("\\", "\\\\"), f"{section['name']}.{key}"


def test_a_wrong_key_or_value_is_told_by_the_call_that_has_it() -> None:
    model = embate.Model(name="wrong").material("steel", **STEEL)
    part = {"name": "a", "material": "steel", "rectangle": {"corner": (0, 0), "size": (1, 1), "elements": (2, 2)}}
    model.part(**part)
    for call, path, told in [
        (lambda: model.part(**part, nmae=1), "part[1].nmae", "did you mean `name`"),
        (lambda: model.part(**{**part, "velocity": (0, "3 kg")}), "part[1].velocity[1]", "kg"),
        (lambda: model.part(name="b", material="steel"), "part[1]", "needs one of"),
        (lambda: model.material("rubber", law="elastic", density=1), "material.rubber.young", "no `young`"),
        (lambda: model.material("steel2", law="j3"), "material.steel2.law", "j3"),
        (lambda: model.run(safety=2), "run.safety", "must be"),
        (lambda: model.contact(between="a"), "contact[0].between", "2"),
        (lambda: embate.Model({"rnu": {"end": 1}}), "rnu", "did you mean `run`"),
        (lambda: embate.Model(run={"edn": 1}), "run.edn", "did you mean `end`"),
    ]:
        with pytest.raises(embate.ModelError) as caught:
            call()
        assert caught.value.place == path, caught.value
        assert told in str(caught.value)
    # Nothing of it has stayed.
    assert model.run(end="1 us").parts == ["a"]
    with pytest.raises(TypeError, match=r"part\[1\].rectangle.size"):
        model.part(name="b", material="steel", rectangle={"corner": (0, 0), "size": object(), "elements": (2, 2)})


def test_what_a_section_lacks_may_come_with_the_next_call() -> None:
    model = embate.Model(name="later").run(safety=0.5).run(end="1 us")
    assert model.to_toml() == "[run]\nsafety = 0.5\nend = \"1 us\"\n"


def test_words_of_python_have_an_underscore() -> None:
    keys = {"yield_": STEEL["yield"], **{key: value for key, value in STEEL.items() if key != "yield"}}
    assert "yield = 250000000.0" in embate.Model(name="a").material("steel", **keys).to_toml()
    assert "from = 0.1" in embate.Model(name="a").load(damping=3.0, from_=0.1).to_toml()


def test_what_can_be_gone_through_once_is_not_lost() -> None:
    model = embate.Model(name="once")
    model.constraint(on="a.left", fixed=(axis for axis in "xy"))
    assert 'fixed = ["x", "y"]' in model.to_toml()


def test_probes_and_more_are_added_to_the_model_of_a_file(tmp_path: Path, model: embate.Model) -> None:
    file = model.save(tmp_path / "blocks")
    added = embate.Model(file, set={"run.end": "30 us"})
    added.probe(name="below", set="lower").output(history="2 us").curve("pull", time=[0], value=[1])
    plain = embate.Model(file, set={"run.end": "30 us"})
    one, other = added.simulation().run(), plain.simulation().run()
    assert one.hash() == other.hash()
    assert "below.vy" in one.history and "below.vy" not in other.history
    assert len(one.history["time"]) == 16 and one.end == pytest.approx(30e-6)
    # What was added stays with a copy, a saved state and a file.
    assert "below.vy" in added.with_set({"run.end": "5 us"}).simulation().run().history
    saved = embate.load(one.save(tmp_path / "state"))
    assert saved.hash() == one.hash() and "below.vy" in saved.history
    again = embate.Model(embate.Model(file).probe(name="below", set="lower").save(tmp_path / "again"))
    assert "below.vy" in again.simulation().run(1e-6).history
    rows = embate.sweep(added, {"run.safety": [0.5, 0.9]}, workers=2, until=2e-6, measure=lambda it: {"vy": it.history["below.vy"][-1]})
    assert rows.column("error") == [None, None]


def test_a_copy_is_added_to_alone(model: embate.Model) -> None:
    copied = model.with_set({"run.end": "5 us"})
    copied.probe(name="more", set="lower")
    assert "more.y" in copied.simulation(threads=1).history and "more.y" not in model.simulation(threads=1).history


def test_faults_of_additions_are_told_with_their_places(tmp_path: Path, model: embate.Model) -> None:
    file = model.save(tmp_path / "blocks")
    with pytest.raises(embate.ModelError, match="nothing.*|`nowhere`") as caught:
        embate.Model(file).probe(name="below", set="nowhere").check()
    assert caught.value.place.startswith("probe[1]")
    with pytest.raises(embate.ModelError, match="the model has `material.steel` already"):
        embate.Model(file).material("steel", **STEEL).check()
    inline = tmp_path / "inline.toml"
    given = sections()
    del given["probe"]
    inline.write_text('probe = [{ name = "a", set = "lower" }]\n' + embate.Model(given).to_toml())
    added = embate.Model(inline).probe(name="end", set="upper")
    assert "end.y" in added.simulation(threads=1).history
    with pytest.raises(ValueError, match="double brackets"):
        added.save(tmp_path / "out")


def test_a_part_of_arrays_is_added_to_a_file(tmp_path: Path, model: embate.Model) -> None:
    from test_model import grid

    file = model.save(tmp_path / "blocks")
    points, quads = grid(2, 2, (0.01, 0.01))
    more = embate.Model(file).part(name="third", material="steel", mesh=(points + [0.1, 0], quads))
    assert more.parts == ["lower", "upper", "third"]
    assert len(more.simulation(threads=1).state.position) == 11 * 4 + 6 * 6 + 9


GOOD = """
import embate
import numpy as np

model = embate.Model(name="typed").run(end="1 us", safety=0.9)
model.material("steel", law="j2", density=7800, young="210 GPa", poisson=np.float32(0.3), yield_=250e6)
model.part(name="a", material="steel", rectangle={"corner": (0, 0), "size": ["1 mm", 2e-3], "elements": (4, 2)}, velocity=np.zeros(2))
model.part(name="b", material="steel", mesh=(np.zeros((4, 2)), np.zeros((1, 4), int)), group="all")
model.contact(bodies="all").obstacle(plane={"point": (0, 0), "normal": (0, 1)}, motion={"y": "press"})
model.load(damping=3.0, from_="1 us").output(history="1 us", include=["stress"])
found: dict[str, float] = embate.calibrate(model, {"a.y": 1.0}, {"run.safety": (0.1, 0.9)}).parameters
last = embate.results("folder").frames[-1].von_mises
"""
BAD = [
    ('model.part(nmae="a")', "nmae"),
    ('model.material("s", law="j3")', "law"),
    ('model.material("s", law="j2", yield_=[{}])', "yield_"),
    ('model.part(name="a", material="s", rectangle={"cornr": (0, 0)})', "rectangle"),
    ("model.run(end=None, safety=(1,))", "safety"),
    ('model.contact(between=3)', "between"),
]


def test_a_type_checker_takes_what_is_right_and_finds_what_is_wrong(tmp_path: Path) -> None:
    pytest.importorskip("mypy")
    good, bad = tmp_path / "good.py", tmp_path / "bad.py"
    good.write_text(GOOD)
    bad.write_text('import embate\nmodel = embate.Model(name="typed")\n' + "\n".join(line for line, _ in BAD) + "\n")
    options = ["--no-incremental", "--cache-dir", str(tmp_path / "cache"), "--ignore-missing-imports"]
    done = subprocess.run([sys.executable, "-m", "mypy", "--strict", *options, str(good)], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout
    done = subprocess.run([sys.executable, "-m", "mypy", *options, str(bad)], capture_output=True, text=True)
    for number, (line, word) in enumerate(BAD, 3):
        told = [text for text in done.stdout.splitlines() if text.startswith(f"{bad}:{number}:")]
        assert any(word in text for text in told), f"{line}: {done.stdout}"
