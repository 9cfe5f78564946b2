"""Checks pages against docs/style.md: `style.py [--wrap] [PAGE...]`; without pages, all handwritten ones.

It checks the width of lines and the words that docs/style.md lists as not used; without pages also those words
in the texts of the program, such as its messages. docs/build.py calls it with every build. With --wrap it first wraps the text of the pages, but no tables, code, formulas, headings and HTML.
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
STYLE = ROOT / "docs" / "style.md"
WIDTH = 110
# Pages that a program writes: their words are in its source.
GENERATED = {
    "docs/command-line.md",
    "docs/elements-and-laws.md",
    "docs/materials.md",
    "docs/messages.md",
    "docs/model-file.md",
    "docs/verification-results.md",
}
# Pages with tables that a program writes.
GENERATED_TABLES = {"docs/gallery.md", "docs/import.md", "docs/output.md"}
# The heading from which on a page is written by a program, and is neither wrapped nor checked.
GENERATED_FROM = {"docs/verification.md": "### Above all sections\n"}
FENCE = re.compile(r"^ *(`{3,}|~{3,})")
ITEM = re.compile(r"^( *)([-*+]|\d+\.) +")
# What must not be broken over two lines: code, and the address of a link with the word before it.
CODE = re.compile(r"`[^`\n]*`")
ADDRESS = re.compile(r"\]\([^)\s]*\)|https?://\S+")
# Lines that are not wrapped: tables, headings, HTML, quotations and pictures.
KEPT = ("|", "#", "<", ">", "![")
UNITS = "[kMGmµn]?(?:m|s|g|Pa|J|N|W|K|Hz)|%|mm|GB|MB|kB|MiB|GiB|KiB"
# Texts of a program: strings of Rust, but not what stands in a comment.
RUST = re.compile(r'//[^\n]*|b?r(#*)"(.*?)"\1|b?"((?:\\.|[^"\\])*)"|\'(?:\\.|[^\'\\])\'', re.DOTALL)
# In a text a plane may be one of the geometry.
GEOMETRY = {"of the plane", "in the plane"}
# Strings that are names in files.
NAMES = {"told"}
# A line that began with one of these would be a list, a heading, a quotation or a table.
OPENS_BLOCK = re.compile(r"([-*+>|]|#+|\d+[.)]|=+|-+)(?=[\s\0]|$)")


def pages() -> list[str]:
    """The pages that are written by hand, relative to the repository."""
    patterns = ["*.md", "docs/**/*.md"]
    patterns += [f"{folder}/README.md" for folder in ("crates/*", "examples/*", "verification/*")]
    patterns += ["failures/README.md", "fuzz/README.md"]
    found = {str(path.relative_to(ROOT)) for pattern in patterns for path in ROOT.glob(pattern)}
    return sorted(found - GENERATED)


def handwritten(name: str, text: str) -> tuple[str, str]:
    """The part of a page that is written by hand, and the rest."""
    head, mark, rest = text.partition(GENERATED_FROM.get(name, "\0"))
    return head, mark + rest


def blocks(lines: list[str]) -> list[tuple[str, list[str]]]:
    """The lines of a page in blocks: "text" may be wrapped; "kept" (tables, headings, ...) and "code" may not."""
    found: list[tuple[str, list[str]]] = []
    fence, in_list = None, False
    for line in lines:
        bare = line.strip()
        mark = FENCE.match(line)
        before = found[-1] if found else ("kept", [""])
        follows_text = before[0] == "text"
        if fence is not None or mark:
            found.append(("code", [line]))
            if fence is None and mark:
                fence = mark[1]
            elif fence is not None and bare.startswith(fence) and not bare.strip(fence[0]):
                fence = None
            continue
        indent = len(line) - len(line.lstrip())
        if not bare:
            found.append(("kept", [line]))
        elif indent >= 4 and not in_list and not follows_text:
            found.append(("code", [line]))
        elif bare.startswith(KEPT) or re.fullmatch(r"[-*_=]{3,}", bare):
            found.append(("kept", [line]))
            in_list = in_list and indent > 0
        elif ITEM.match(line):
            found.append(("text", [line]))
            in_list = True
        elif follows_text:
            before[1].append(line)
        else:
            found.append(("text", [line]))
            in_list = in_list and indent > 0
    return found


def words(text: str) -> list[str]:
    """The pieces of a text between which a line may end: not in code, before a unit, or at a sign of equality."""
    whole = CODE.sub(lambda code: code[0].replace(" ", "\0"), text)
    whole = re.sub(rf"(?<=\d) (?=(?:{UNITS})(?:[²³.,;:)/]|\s|$))", "\0", whole)
    whole = re.sub(r" ([=≈<≤>≥]) ", "\0\\1\0", whole)
    made: list[str] = []
    for word in whole.split():
        if made and OPENS_BLOCK.match(word):
            made[-1] += f" {word}"
        else:
            made.append(word)
    return [word.replace("\0", " ") for word in made]


def wrapped(lines: list[str], width: int = WIDTH) -> list[str]:
    """One paragraph or item of a list, wrapped."""
    first = ITEM.match(lines[0])
    indent = first[0] if first else " " * (len(lines[0]) - len(lines[0].lstrip()))
    rest = " " * len(indent)
    text = " ".join([lines[0][len(indent) :], *(line.strip() for line in lines[1:])])
    made, line = [], indent
    for word in words(text):
        empty = line.strip() == indent.strip() and line in (indent, rest)
        if not empty and len(line) + 1 + len(word) > width:
            made.append(line)
            line, empty = rest, True
        line += word if empty else f" {word}"
    return [*made, line]


def wrap(text: str) -> str:
    """A page with its text wrapped."""
    made: list[str] = []
    for kind, lines in blocks(text.splitlines()):
        made += wrapped(lines) if kind == "text" else lines
    return "\n".join(made) + "\n"


def unused_words(geometry: bool = False) -> dict[str, re.Pattern[str]]:
    """The words that docs/style.md says are not used: the first column of the table below that heading.

    With `geometry` planes of the geometry may be named.
    """
    text = STYLE.read_text(encoding="utf-8")
    table = re.search(r"^## Words not used\n(.*?)(?=^## |\Z)", text, re.MULTILINE | re.DOTALL)[1]
    cells = re.findall(r"^\| ([^|]+?) \|", table, re.MULTILINE)[1:]
    listed = [word.strip() for cell in cells for word in cell.split(",")]
    found = {}
    for word in (word for word in listed if not (geometry and word in GEOMETRY)):
        spaced = r"\s+".join(map(re.escape, word.split()))
        found[word] = re.compile(rf"(?<![\w-]){spaced}(?![\w-])", re.IGNORECASE)
    return found


def uses(plain: str, unused: dict[str, re.Pattern[str]]) -> list[tuple[int, str]]:
    """Where a text has words that are not used: its line from 0, and what is wrong."""
    hits = [(hit, word) for word, pattern in unused.items() for hit in pattern.finditer(plain)]
    return [(plain.count("\n", 0, hit.start()), f"\"{word}\" is not used here: docs/style.md") for hit, word in hits]


def check(names: list[str]) -> list[str]:
    """The deviations from docs/style.md, with page and line."""
    faults, unused = [], unused_words()
    for name in names:
        if name in GENERATED:
            continue
        text, _ = handwritten(name, (ROOT / name).read_text(encoding="utf-8"))
        if name == "CHANGELOG.md":
            # What was released stays as it was written.
            text = "\n## ".join(text.split("\n## ")[:2])
        shown = []
        for kind, lines in blocks(text.splitlines()):
            for line in lines:
                generated = line.startswith("|") and name in GENERATED_TABLES
                shown.append("" if kind == "code" or generated else line)
                if kind == "text" and len(ADDRESS.sub("", line)) > WIDTH:
                    faults.append(f"{name}:{len(shown)}: wider than {WIDTH} columns; docs/style.py --wrap {name}")
        if name == str(STYLE.relative_to(ROOT)):
            continue
        plain = ADDRESS.sub("", CODE.sub("``", "\n".join(shown)))
        faults += [f"{name}:{line + 1}: {fault}" for line, fault in uses(plain, unused)]
    return faults


def check_texts() -> list[str]:
    """The words that are not used, in the texts of the program, with file and line."""
    faults = []
    unused = unused_words(geometry=True)
    for path in sorted(ROOT.glob("crates/*/src/**/*.rs")):
        if path.name == "tests.rs" or "tests" in path.parts:
            continue
        source = path.read_text(encoding="utf-8").split("#[cfg(test)]\nmod tests {")[0]
        for found in RUST.finditer(source):
            text = CODE.sub("``", found[2] or found[3] or "")
            first = source.count("\n", 0, found.start()) + 1
            hits = uses(text, unused) if text not in NAMES else []
            faults += [f"{path.relative_to(ROOT)}:{first + line}: {fault}" for line, fault in hits]
    return faults


def main() -> None:
    arguments = [argument for argument in sys.argv[1:] if argument != "--wrap"]
    names = [str(Path(argument).resolve().relative_to(ROOT)) for argument in arguments] or pages()
    if "--wrap" in sys.argv[1:]:
        # The gallery's sections are written by docs/gallery.py.
        for path in (ROOT / name for name in names if name != "docs/gallery.md"):
            own, rest = handwritten(str(path.relative_to(ROOT)), path.read_text(encoding="utf-8"))
            path.write_text(wrap(own) + rest, encoding="utf-8")
    faults = check(names)
    if not arguments:
        faults += check_texts()
    for fault in faults:
        print(f"error: {fault}", file=sys.stderr)
    print(f"{len(names)} pages; {len(faults)} faults of style")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
