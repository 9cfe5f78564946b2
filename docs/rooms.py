"""Draws the modules of the solver and the path of the data: `rooms.py [--check]`.

It reads crates/solver/src/lib.rs (the modules in their order, which is that of dependency), the first sentence of
each module's head, its lines of code and its imports, and the dependencies between crates. It writes
docs/images/rooms.svg and the table of modules in docs/architecture.md. With --check it writes nothing and reports
what differs from the code: numbers of lines only where they are off by more than a fifth and more than 50. Files
and folders that the lists below the table name must exist.
"""

import math
import re
import sys
from pathlib import Path
from typing import NamedTuple
from xml.sax.saxutils import escape

ROOT = Path(__file__).resolve().parent.parent
SOURCE = ROOT / "crates" / "solver" / "src"
PAGE = ROOT / "docs" / "architecture.md"
PICTURE = ROOT / "docs" / "images" / "rooms.svg"
BEGIN, END = "<!-- modules: docs/rooms.py writes this table -->\n", "<!-- end of modules -->\n"
AGAIN = "`python3 docs/rooms.py` writes it again"

# Layers: the first module of each, and its name. A layer ends where the next one begins.
LAYERS = {
    "archive": "State, messages, quantities",
    "tensor": "Tensors, lists, sums",
    "stress_state": "Model and mesh",
    "material": "Laws, elements, loads, rigid bodies",
    "block": "Blocks, contact, assembly",
    "step": "Step and builder",
    "failure_location": "Output",
    "input": "Model file: keys and checks",
    "body_columns": "Records and monitoring",
    "simulation": "Simulation and analysis",
}
# Crates, each with what it is.
CRATES = {
    "lanes": "vector lanes, threads",
    "remesh": "new meshes, transfer",
    "solver": "the method",
    "files": "formats",
    "viewer": "page in the browser",
    "cli": "the program",
    "python": "Python package",
}


class Stage(NamedTuple):
    """A form that the data take on their path."""

    title: str
    # Two lines; {names} are modules that work on the data.
    note: tuple[str, str]
    # What holds the data: a type of a module, or a folder of a crate.
    holders: tuple[str, ...]


PATH = (
    Stage("Model file", ("TOML, meshes;", "read by crate files"), ("files/model_file",)),
    Stage("Model", ("plain data in SI units;", "checked by {input}"), ("model::Model",)),
    Stage("Mesh", ("nodes, elements, surfaces;", "made by {build}"), ("mesh::Mesh",)),
    Stage(
        "Blocks, contacts",
        ("rigid bodies, constraints;", "made by {build}"),
        ("load::Constraints", "rigid::Bodies", "block::Block", "contact::Contact"),
    ),
    Stage("System", ("all of it, ready to step;", "made by {build}"), ("step::System",)),
    Stage("Step", ("computed by {step};", "repeated by {simulation}"), ()),
    Stage("Snapshot", ("fields and history rows;", "by {record} and {snapshot}"), ("field::LiveSnapshot", "output::Frame")),
    Stage("Result files", ("VTU, CSV, JSON, pictures;", "written by crate files"), ("files/results",)),
)


class Fault(Exception):
    """What is wrong with the code or with the tables above."""


class Module(NamedTuple):
    """A module of the solver."""

    name: str
    sentence: str
    lines: int
    imports: frozenset[str]


# What the code has.


def text_of(path: Path) -> str:
    """A source without its tests and comments."""
    text = path.read_text(encoding="utf-8")
    text = re.sub(r"#\[cfg\(test\)\]\nmod \w+ \{.*?^\}", "", text, flags=re.MULTILINE | re.DOTALL)
    text = re.sub(r"#\[cfg\(test\)\]\n *mod \w+;", "", text)
    return "\n".join(line.split("//")[0] for line in text.splitlines())


def imports(text: str) -> set[str]:
    """What a source imports by `crate::name` and `crate::{name, ...}`: read as in crates/solver/tests/all/rooms.rs."""
    found = set()
    for after in text.split("crate::")[1:]:
        if not after.startswith("{"):
            found.add(re.match(r"\w*", after)[0])
            continue
        depth, names = 0, ""
        for letter in after[1:]:
            depth += (letter == "{") - (letter == "}")
            if depth < 0:
                break
            if depth == 0:
                names += letter
        found |= {re.match(r"\w*", name.strip())[0] for name in names.split(",")}
    return found


def sources(name: str) -> list[Path]:
    """The sources of a module, its own file first, without those of tests."""
    own = next((path for path in (SOURCE / f"{name}.rs", SOURCE / name / "mod.rs") if path.is_file()), None)
    if own is None:
        raise Fault(f"crates/solver/src/lib.rs: the module {name} has no file")
    found = [own] + sorted(path for path in (SOURCE / name).rglob("*.rs") if path != own)
    tests = set()
    for path in found:
        below = path.parent if path.name == "mod.rs" else path.with_suffix("")
        for test in re.findall(r"#\[cfg\(test\)\]\n *mod (\w+);", path.read_text(encoding="utf-8")):
            tests |= {below / f"{test}.rs", below / test}

    def is_test(path: Path) -> bool:
        parts = path.relative_to(SOURCE).parts
        return path.name.endswith("tests.rs") or "tests" in parts or bool(tests & {path, *path.parents})

    return [path for path in found if not is_test(path)]


def sentence(path: Path) -> str:
    """The first sentence of the head of a source, in Markdown."""
    head = []
    for line in path.read_text(encoding="utf-8").splitlines():
        if not line.startswith("//! "):
            break
        head.append(line.removeprefix("//! ").strip())
    first = re.match(r"(.+?)\.(?:\s|$)", " ".join(head))
    if first is None:
        raise Fault(f"{path.relative_to(ROOT)}: its head, `//!`, has no sentence that says what it is")
    return re.sub(r"\[(`[^`]*`)\](\([^)]*\))?", r"\1", first[1]).replace("|", "\\|")


def modules() -> list[Module]:
    """The modules of the solver in the order of lib.rs."""
    names = re.findall(r"^(?:pub )?mod (\w+);$", (SOURCE / "lib.rs").read_text(encoding="utf-8"), re.MULTILINE)
    found = []
    for name in names:
        paths = sources(name)
        texts = [text_of(path) for path in paths]
        imported = set().union(*map(imports, texts)) & set(names) - {name}
        lines = sum(bool(line.strip()) for text in texts for line in text.splitlines())
        found.append(Module(name, sentence(paths[0]), rounded(lines), frozenset(imported)))
    return found


def rounded(number: int) -> int:
    """Two significant digits."""
    unit = 10 ** max(0, math.floor(math.log10(max(number, 1))) - 1)
    return (2 * number + unit) // (2 * unit) * unit


def layers(found: list[Module]) -> list[tuple[str, list[Module]]]:
    """The modules by layer."""
    names = [module.name for module in found]
    if unknown := [name for name in LAYERS if name not in names]:
        raise Fault(f"docs/rooms.py: LAYERS names {', '.join(unknown)}: crates/solver/src/lib.rs has no such module")
    starts = [names.index(name) for name in LAYERS]
    if starts != sorted(starts) or starts[0] != 0:
        raise Fault("docs/rooms.py: LAYERS must keep the order of crates/solver/src/lib.rs and begin with its first module")
    return [(title, found[start:end]) for title, start, end in zip(LAYERS.values(), starts, [*starts[1:], len(names)])]


def crates() -> dict[str, set[str]]:
    """The crates of the workspace, each with those that it uses."""
    workspace = (ROOT / "Cargo.toml").read_text(encoding="utf-8")
    folders = re.search(r"^members = \[(.*?)\]", workspace, re.MULTILINE | re.DOTALL)[1]
    names = re.findall(r'"crates/(\w+)"', folders)
    found = {}
    for name in names:
        text = (ROOT / "crates" / name / "Cargo.toml").read_text(encoding="utf-8")
        section = re.search(r"^\[dependencies\]\n(.*?)(?=^\[|\Z)", text, re.MULTILINE | re.DOTALL)
        found[name] = set(re.findall(r"^embate-(\w+)", section[1] if section else "", re.MULTILINE))
    if set(names) != set(CRATES):
        raise Fault(f"docs/rooms.py: CRATES must name {', '.join(names)}: the members of Cargo.toml")
    return found


def check_path(found: list[Module]) -> None:
    """Whether what the path names exists."""
    names = {module.name for module in found}
    for stage in PATH:
        for holder in stage.holders:
            name, _, item = holder.partition("::")
            if not item:
                if not (ROOT / "crates" / name.replace("/", "/src/")).is_dir():
                    raise Fault(f"docs/rooms.py: PATH names {holder}: there is no such folder")
            elif name not in names:
                raise Fault(f"docs/rooms.py: PATH names {holder}: crates/solver/src/lib.rs has no module {name}")
            elif not any(re.search(rf"\b(?:struct|trait|enum) {item}\b", text_of(path)) for path in sources(name)):
                raise Fault(f"docs/rooms.py: PATH names {holder}: {name} has no {item}")
        for name in re.findall(r"\{(\w+)\}", " ".join(stage.note)):
            if name not in names:
                raise Fault(f"docs/rooms.py: PATH names {{{name}}}: crates/solver/src/lib.rs has no such module")


# The table.


def table(found: list[Module]) -> str:
    """The modules as a table of docs/architecture.md."""
    rows = ["| module | what it is | lines of code |", "|---|---|---:|"]
    for number, (title, own) in enumerate(layers(found), 1):
        rows.append(f"| **{number}** | **{title}** | |")
        rows += [f"| `{module.name}` | {module.sentence} | {module.lines:,} |" for module in own]
    return "\n".join(rows) + "\n"


def parts_of_page() -> tuple[str, str, str]:
    """What stands before the table, the table, and what follows it."""
    text = PAGE.read_text(encoding="utf-8")
    head, begin, rest = text.partition(BEGIN)
    own, end, foot = rest.partition(END)
    if not (begin and end):
        raise Fault(f"docs/architecture.md: the table of modules must stand between {BEGIN.strip()} and {END.strip()}")
    return f"{head}{begin}\n", own.strip("\n") + "\n", f"\n{end}{foot}"


def missing(lists: str) -> list[str]:
    """Files and folders that the lists below the table name and that are not there.

    An item begins with a module, a crate or a folder; the names in it are searched there.
    """
    wrong: list[str] = []
    places: list[Path] = []
    for line in lists.partition("\n## ")[0].splitlines():
        if item := re.match(r"- `([\w/]+)`", line):
            name = item[1]
            places = [path for path in (SOURCE / name, ROOT / "crates" / name, ROOT / name) if path.is_dir()]
            if not places:
                wrong.append(f"docs/architecture.md: there is no module, crate or folder {name}")
            places += [path / "src" for path in places] + [ROOT]
        for name in re.findall(r"`([\w/]+(?:\.rs|\.py|/))`", line) if line.startswith(("- ", "  ")) else ():
            if not any((place / name).exists() for place in places):
                wrong.append(f"docs/architecture.md: {name} is not there: {line.strip()}")
    return wrong


# The picture. Colours: Okabe and Ito, which stay apart for the colour-blind and in grey.

BLUE, PATH_COLOUR, INK, GREY, PALE = "#0072b2", "#d55e00", "#1a1a1a", "#595959", "#f1f4f7"
CELLS = ("#dcebf6", "#b5d5ec", "#84bbe0")
OWN_CELL = "#e3e3e3"
WIDTH, MARGIN = 880, 14
ROW, HEADING = 19, 24
# Left edges: of modules, bars and the table of imports.
MODULE, BAR, IMPORTS = 276, 412, 576
MODULE_WIDE, BAR_WIDE, CELL = 128, 96, 29
STAGE_WIDE, STAGE_HIGH, STAGE_GAP = 178, 58, 12


class Drawing:
    """Lines of an SVG."""

    def __init__(self) -> None:
        self.lines: list[str] = []

    def add(self, name: str, text: str | None = None, **attributes: object) -> None:
        shown = "".join(f' {key.replace("_", "-")}="{value}"' for key, value in attributes.items())
        self.lines.append(f"<{name}{shown}/>" if text is None else f"<{name}{shown}>{text}</{name}>")

    def text(self, x: float, y: float, text: str, **attributes: object) -> None:
        self.add("text", escape(text), x=number(x), y=number(y), **attributes)

    def box(self, x: float, y: float, width: float, height: float, **attributes: object) -> None:
        self.add("rect", x=number(x), y=number(y), width=number(width), height=number(height), **attributes)

    def arrow(self, path: str, colour: str) -> None:
        head = "path" if colour == PATH_COLOUR else "arrow"
        self.add("path", d=path, fill="none", stroke=colour, stroke_width=1.5, marker_end=f"url(#{head})")

    def badge(self, x: float, y: float, text: object, is_full: bool) -> None:
        """The number of a stage: full where the data are, hollow where something works on them."""
        fill, ink = (PATH_COLOUR, "white") if is_full else ("white", PATH_COLOUR)
        self.add("circle", cx=number(x), cy=number(y), r=7.5, fill=fill, stroke=PATH_COLOUR, stroke_width=1.2)
        self.text(x, y + 3.8, str(text), font_size=10.5, font_weight="bold", fill=ink, text_anchor="middle")


def number(value: float) -> str:
    """A coordinate, the same on every machine."""
    return f"{value:.1f}".removesuffix(".0")


def curve(begin: tuple[float, float], end: tuple[float, float]) -> str:
    """A line from left to right that leaves and arrives horizontally."""
    middle = (begin[0] + end[0]) / 2
    points = [begin, (middle, begin[1]), (middle, end[1]), end]
    first, *others = (f"{number(x)},{number(y)}" for x, y in points)
    return f"M{first} C{' '.join(others)}"


def draw_crates(drawing: Drawing, top: float) -> float:
    """The crates from left to right, each left of those that it uses; returns where they end."""
    used = crates()

    def level(name: str) -> int:
        return 1 + max(map(level, used[name]), default=-1)

    def reaches(name: str) -> set[str]:
        return used[name].union(*map(reaches, used[name]))

    columns = [[name for name in used if level(name) == index] for index in range(max(map(level, used)) + 1)][::-1]
    wide, high, gap = 132, 38, 10
    pitch = (WIDTH - 2 * MARGIN - wide) / (len(columns) - 1)
    drawing.text(MARGIN, top + 12, "Crates", font_size=13, font_weight="bold")
    note = "An arrow points to a crate that is used. A crate that is also used through another one has no second arrow."
    drawing.text(MARGIN + 62, top + 12, note, font_size=11, fill=GREY)
    top += 24
    places = {}
    rows = max(map(len, columns))
    for column, names in enumerate(columns):
        for row, name in enumerate(names):
            places[name] = (MARGIN + column * pitch, top + (row + (rows - len(names)) / 2) * (high + gap))
    for name, (x, y) in places.items():
        drawing.box(x, y, wide, high, rx=4, fill=PALE, stroke=INK, stroke_width=2 if name == "solver" else 1)
        drawing.text(x + 10, y + 16, name, font_size=13, font_weight="bold")
        drawing.text(x + 10, y + 31, CRATES[name], font_size=11, fill=GREY)
        stages = [index for index, stage in enumerate(PATH, 1) if any(holder.startswith(f"{name}/") for holder in stage.holders)]
        for place, index in enumerate(reversed(stages)):
            drawing.badge(x + wide - 14 - 18 * place, y + 12, index, True)
        for other in sorted(used[name]):
            if other not in set().union(*(reaches(third) for third in used[name])):
                end = places[other]
                drawing.arrow(curve((x + wide, y + high / 2), (end[0] - 2, end[1] + high / 2)), INK)
    return top + rows * (high + gap)


def draw_modules(drawing: Drawing, found: list[Module], top: float) -> tuple[dict[str, float], float]:
    """The modules with their lines and imports; returns the height of the middle of each, and where they end."""
    by_layer = layers(found)
    layer_of = {module.name: index for index, (_, own) in enumerate(by_layer) for module in own}
    largest = max(module.lines for module in found)
    middles, y = {}, top
    for index, (title, own) in enumerate(by_layer):
        high = HEADING + ROW * len(own)
        drawing.box(MODULE - 8, y, WIDTH - MARGIN - MODULE + 8, high - 3, rx=3, fill=PALE)
        for x, text in ((MODULE, str(index + 1)), (MODULE + 23, title)):
            drawing.text(x, y + 16, text, font_size=12, font_weight="bold", fill=GREY)
        for row, module in enumerate(own):
            middle = y + HEADING + ROW * (row + 0.5) - 2
            middles[module.name] = middle
            drawing.box(MODULE, middle - 8, MODULE_WIDE, 16, rx=3, fill="white", stroke=INK, stroke_width=0.8)
            drawing.text(MODULE + 7, middle + 4.2, module.name, font_size=12)
            long = max(1, BAR_WIDE * module.lines / largest)
            drawing.box(BAR, middle - 5.5, long, 11, fill=BLUE)
            drawing.text(BAR + long + 5, middle + 4, f"{module.lines:,}", font_size=11)
            for column in range(len(by_layer)):
                names = [other for other in layer_of if other in module.imports and layer_of[other] == column]
                x = IMPORTS + column * CELL
                if names:
                    colour = OWN_CELL if column == index else CELLS[min(len(names), 5) // 2]
                    drawing.lines.append(f"<g><title>{module.name} imports {', '.join(names)}</title>")
                    drawing.box(x, middle - 8, CELL - 2, 16, fill=colour)
                    drawing.text(x + (CELL - 2) / 2, middle + 4, str(len(names)), font_size=11, text_anchor="middle")
                    drawing.lines.append("</g>")
                elif column <= index:
                    drawing.add("circle", cx=number(x + (CELL - 2) / 2), cy=number(middle), r=1.1, fill="#9a9a9a")
        y += high
    return middles, y


def draw_path(drawing: Drawing, middles: dict[str, float], top: float, bottom: float) -> None:
    """The stages of the path beside the modules that hold the data."""
    at: dict[str, list[tuple[int, bool]]] = {}
    wanted = []
    for index, stage in enumerate(PATH, 1):
        holders = [holder.split("::")[0] for holder in stage.holders if "::" in holder]
        workers = re.findall(r"\{(\w+)\}", " ".join(stage.note))
        for name in holders:
            at.setdefault(name, []).append((index, True))
        for name in workers:
            at.setdefault(name, []).append((index, False))
        heights = [middles[name] for name in holders]
        wanted.append(sum(heights) / len(heights) if heights else None)
    # Each stage is as near to its modules as the others permit: from above, then from below.
    pitch = STAGE_HIGH + STAGE_GAP
    places: list[float] = []
    for index, height in enumerate(wanted):
        least = places[-1] + pitch if places else top
        places.append(max(least, (height - STAGE_HIGH / 2) if height is not None else least))
    last = bottom - 3 - STAGE_HIGH
    for index in reversed(range(len(places))):
        places[index] = min(places[index], last)
        last = places[index] - pitch
    for name, stages in at.items():
        for place, (index, is_full) in enumerate(reversed(stages)):
            x = MODULE - 20 - 17 * place
            if is_full:
                begin, end = (MARGIN + STAGE_WIDE, places[index - 1] + STAGE_HIGH / 2), (x, middles[name])
                drawing.add("path", d=curve(begin, end), fill="none", stroke=PATH_COLOUR, stroke_width=1.3)
    for name, stages in at.items():
        for place, (index, is_full) in enumerate(reversed(stages)):
            drawing.badge(MODULE - 20 - 17 * place, middles[name], index, is_full)
    for index, (stage, y) in enumerate(zip(PATH, places), 1):
        is_outside = any("/" in holder for holder in stage.holders)
        fill = "white" if is_outside else "#fff3ea"
        drawing.box(MARGIN, y, STAGE_WIDE, STAGE_HIGH, rx=4, fill=fill, stroke=PATH_COLOUR, stroke_width=1.5)
        drawing.badge(MARGIN + 16, y + 15, index, True)
        drawing.text(MARGIN + 31, y + 19, stage.title, font_size=13, font_weight="bold")
        for line, note in enumerate(stage.note):
            drawing.text(MARGIN + 9, y + 36 + 14 * line, re.sub("[{}]", "", note), font_size=11, fill=GREY)
        if index < len(PATH):
            x = MARGIN + 16
            drawing.arrow(f"M{x},{number(y + STAGE_HIGH)} L{x},{number(places[index] - 2)}", PATH_COLOUR)


def picture(found: list[Module]) -> str:
    """The picture as SVG."""
    drawing = Drawing()
    top = draw_crates(drawing, 8) + 12
    total = rounded(sum(module.lines for module in found))
    drawing.text(MARGIN, top + 12, "Path of the data", font_size=13, font_weight="bold")
    drawing.text(MODULE, top + 12, "Solver: modules", font_size=13, font_weight="bold")
    drawing.text(BAR, top + 12, "Lines of code", font_size=13, font_weight="bold")
    drawing.text(IMPORTS, top + 12, "Imports from layer", font_size=13, font_weight="bold")
    drawing.text(MODULE, top + 28, "imports go upwards", font_size=11, fill=GREY)
    drawing.text(BAR, top + 28, f"without tests, in all {total:,}", font_size=11, fill=GREY)
    for column in range(len(LAYERS)):
        x = IMPORTS + column * CELL + (CELL - 2) / 2
        drawing.text(x, top + 28, str(column + 1), font_size=11, font_weight="bold", fill=GREY, text_anchor="middle")
    top += 36
    middles, bottom = draw_modules(drawing, found, top)
    draw_path(drawing, middles, top, bottom)
    y = bottom + 16
    drawing.badge(MARGIN + 8, y, "n", True)
    drawing.text(MARGIN + 21, y + 4, "holds the data of stage n", font_size=11)
    drawing.badge(MARGIN + 198, y, "n", False)
    drawing.text(MARGIN + 211, y + 4, "works on them", font_size=11)
    for x, colour, text in ((330, CELLS[1], "number of modules imported from a layer"), (636, OWN_CELL, "from its own layer")):
        drawing.box(x, y - 6, 22, 12, fill=colour)
        drawing.text(x + 28, y + 4, text, font_size=11)
    order = [module.name for module in found]
    upward = []
    for place, module in enumerate(found):
        upward += [f"{module.name} imports {name}" for name in order[place + 1 :] if name in module.imports]
    y += 22
    note = f"Against the order: {'; '.join(upward) or 'nothing'} (crates/solver/tests/all/rooms.rs)."
    drawing.text(MARGIN, y + 4, note, font_size=11, fill=GREY)
    height = math.ceil(y + 16)
    size = f'width="{WIDTH}" height="{height}"'
    view = f'{size} viewBox="0 0 {WIDTH} {height}" font-family="sans-serif" fill="{INK}"'
    arrow = '<marker id="{}" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="6" markerHeight="6" orient="auto">'
    arrow += '<path d="M0,0 L8,4 L0,8 z" fill="{}"/></marker>'
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" {view}>',
        "<!-- docs/rooms.py draws this from the code. -->",
        f"<defs>{arrow.format('arrow', INK)}{arrow.format('path', PATH_COLOUR)}</defs>",
        f'<rect {size} fill="white"/>',
        *drawing.lines,
        "</svg>",
    ]
    return "\n".join(lines) + "\n"


# Comparison with what is stored.


def as_stored(found: list[Module], stored: str) -> list[Module]:
    """The modules with the numbers of lines that the page has, where these are near enough."""
    rows = re.findall(r"^\| `(\w+)` \|.*\| ([\d,]+) \|$", stored, re.MULTILINE)
    has = {name: int(lines.replace(",", "")) for name, lines in rows}

    def lines(module: Module) -> int:
        shown = has.get(module.name, module.lines)
        return shown if abs(shown - module.lines) <= max(50, module.lines / 5) else module.lines

    return [module._replace(lines=lines(module)) for module in found]


def faults(found: list[Module], stored: str, lists: str) -> list[str]:
    """What differs from the code: in the table, in the lists below it, in the picture."""
    found = as_stored(found, stored)
    made, wrong = table(found), missing(lists)
    listed, names = re.findall(r"^\| `(\w+)` \|", stored, re.MULTILINE), [module.name for module in found]
    wrong += [f"docs/architecture.md: no line for the module {name}; {AGAIN}" for name in names if name not in listed]
    wrong += [f"docs/architecture.md: there is no module {name}; {AGAIN}" for name in listed if name not in names]
    if set(listed) == set(names) and stored != made:
        old = set(stored.splitlines())
        line = next((line for line in made.splitlines() if line not in old), "the order of its lines")
        wrong.append(f"docs/architecture.md: the table of modules is not what the code gives; {AGAIN}: {line}")
    if not PICTURE.is_file() or PICTURE.read_text(encoding="utf-8") != picture(found):
        wrong.append(f"docs/images/rooms.svg is not what the code gives (modules, imports, crates); {AGAIN}")
    return wrong


def main() -> None:
    if unknown := set(sys.argv[1:]) - {"--check"}:
        sys.exit(f"error: unknown argument {', '.join(sorted(unknown))}; usage: rooms.py [--check]")
    try:
        found = modules()
        check_path(found)
        head, stored, foot = parts_of_page()
        if "--check" not in sys.argv[1:]:
            stored = table(found)
            PAGE.write_text(head + stored + foot, encoding="utf-8")
            PICTURE.write_text(picture(found), encoding="utf-8")
        wrong = faults(found, stored, foot)
    except Fault as fault:
        sys.exit(f"error: {fault}")
    for fault in wrong:
        print(f"error: {fault}", file=sys.stderr)
    count = sum(len(module.imports) for module in found)
    print(f"{len(found)} modules in {len(LAYERS)} layers, {count} imports between modules; {len(wrong)} faults")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
