"""Checks comments in sources as pages are, for their width and words: `comments.py [--wrap] [FILE...]`; without
files, all.

Comments that fill their lines (Rust, TypeScript, JavaScript) are read as the text of a page, without code in them. With --wrap those
that are too wide are wrapped first; code, tables and drawings in them stay as they are.
"""

import re
import subprocess
import sys
from pathlib import Path

import style

SUFFIXES = (".rs", ".ts", ".mjs")
COMMENT = re.compile(r"^( *//[/!]?)(?: (.*)| *)$")


def runs(lines: list[str]) -> list[tuple[str | None, list[str]]]:
    """The lines of a source in runs: of comments with their prefix, and of anything else with none."""
    found: list[tuple[str | None, list[str]]] = []
    for line in lines:
        comment = COMMENT.match(line)
        prefix = comment[1] if comment else None
        if found and found[-1][0] == prefix:
            found[-1][1].append(line)
        else:
            found.append((prefix, [line]))
    return found


def wrap(text: str) -> str:
    """A source with its comments wrapped."""
    made: list[str] = []
    for prefix, lines in runs(text.split("\n")):
        if prefix is None or all(len(line) <= style.WIDTH for line in lines):
            made += lines
            continue
        width = style.WIDTH - len(prefix) - 1
        for kind, own in style.blocks([line[len(prefix) + 1 :] for line in lines]):
            if kind == "text" and any(len(line) > width for line in own):
                own = style.wrapped(own, width)
            made += [f"{prefix} {line}".rstrip() for line in own]
    return "\n".join(made)


def unused(name: str, text: str, words: dict[str, re.Pattern[str]]) -> list[str]:
    """Those of the words that comments of a source have, with file and line."""
    faults, first = [], 1
    for prefix, lines in runs(text.split("\n")):
        if prefix is not None:
            plain = style.CODE.sub("``", "\n".join(line[len(prefix) :] for line in lines))
            faults += [f"{name}:{first + line}: {fault}" for line, fault in style.uses(plain, words)]
        first += len(lines)
    return faults


def main(arguments: list[str]) -> int:
    names = [name for name in arguments if not name.startswith("--")]
    if not names:
        listed = subprocess.run(["git", "ls-files"], cwd=style.ROOT, check=True, stdout=subprocess.PIPE, text=True)
        names = [name for name in listed.stdout.splitlines() if name.endswith(SUFFIXES) and "/bundle/" not in name]
    faults = []
    words = style.unused_words(geometry=True)
    for name in names:
        path = style.ROOT / name
        text = path.read_text(encoding="utf-8")
        if "--wrap" in arguments:
            new = wrap(text)
            if new != text:
                path.write_text(new, encoding="utf-8")
            text = new
        for number, line in enumerate(text.split("\n"), 1):
            comment = COMMENT.match(line)
            # What can't be broken, such as an address, is as wide as it is.
            if comment and len(line) > style.WIDTH and " " in (comment[2] or "").strip():
                faults.append(f"{name}:{number}: wider than {style.WIDTH} columns; docs/comments.py --wrap {name}")
        faults += unused(name, text, words)
    for fault in faults:
        print(f"error: {fault}")
    print(f"{len(names)} sources; {len(faults)} faults of comments")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
