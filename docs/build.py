"""Builds the book into target/book/html and checks its links, words and lines: `build.py [--check]`; with --check without mdBook.

Words and lines are checked by docs/style.py, against docs/style.md.

The pages stay where they are in the repository: docs/SUMMARY.md is the order, each verification case and each example comes below the page that lists them. What the pages link to is staged beside
them in target/book/source, in the folders of the repository, so that one link serves on disk, where the code is hosted and in the book.
"""

import functools
import html
import html.parser
import os
import re
import shutil
import subprocess
import sys
import urllib.parse
from pathlib import Path

import style

ROOT = Path(__file__).resolve().parent.parent
BOOK = ROOT / "target" / "book"
SUMMARY = ROOT / "docs" / "SUMMARY.md"
# Pages that have the pages of a folder below them.
BELOW = {"docs/verification.md": "verification", "docs/gallery.md": "examples"}
MISSING_PROGRAM = "mdbook is not on the PATH; install it: cargo install mdbook --locked --version 0.5.4 --no-default-features --features search"
LINK = re.compile(r"(?<!\\)(!?)\[((?:[^\[\]`]|`[^`]*`|\[[^\]]*\])*)\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)")
# Formulas in running text: x^{n+1}, f^n, m_a, f_internal; set as they are in print.
FORMULAS = [
    (re.compile(r"\^\{([^{}]+)\}"), r"<sup>\1</sup>"),
    (re.compile(r"\^([−-]?(?:\d+(?:[./]\d+)?|[a-zTω½]))(?![\w])"), r"<sup>\1</sup>"),
    (re.compile(r"_\{([^{}]+)\}"), r"<sub>\1</sub>"),
    (re.compile(r"(?<!\w)([d∂Δδ]?[A-Za-zΑ-Ωα-ωµσ][̄̇̂]?)_([A-Za-z0-9]+)(?![A-Za-z0-9_(])"), r"\1<sub>\2</sub>"),
]
SET_IN_PRINT = ("docs/theory", "docs/paper", "docs/guides", "verification/")
ELSEWHERE = ("http://", "https://", "mailto:")


def prose(text: str) -> str:
    """A page without its fenced blocks: their places stay, so that lines keep their numbers."""
    lines, fence = [], None
    for line in text.splitlines():
        mark = re.match(r"^ {0,3}(`{3,}|~{3,})", line)
        if mark and fence is None:
            fence = mark[1]
            lines.append("")
        elif mark and line.strip().startswith(fence) and not line.strip().strip(fence[0]):
            fence = None
            lines.append("")
        else:
            lines.append("" if fence else line)
    return "\n".join(lines)


@functools.cache
def anchors(page: Path) -> set[str]:
    """The places in a page that can be linked to: its headings, as mdBook and hosts of code name them."""
    text = (ROOT / page).read_text(encoding="utf-8")
    found: set[str] = set()
    for heading in re.findall(r"^#{1,6}\s+(.*?)\s*#*\s*$", prose(text), re.MULTILINE):
        plain = LINK.sub(lambda link: link[2], heading)
        name = "".join(letter for letter in plain.lower().replace(" ", "-") if letter.isalnum() or letter in "-_")
        numbered, number = name, 0
        while numbered in found:
            number += 1
            numbered = f"{name}-{number}"
        found.add(numbered)
    return found | set(re.findall(r'<a (?:id|name)="([^"]+)"', text))


def summary() -> tuple[list[str], list[Path]]:
    """The lines of the book's summary, with the pages of the folders, and all pages in their order."""
    lines, pages = [], []
    for line in SUMMARY.read_text(encoding="utf-8").splitlines():
        link = LINK.search(line)
        if link is None:
            lines.append(line)
            continue
        page = (SUMMARY.parent / link[3]).resolve().relative_to(ROOT)
        lines.append(line.replace(f"({link[3]})", f"({page})"))
        pages.append(page)
        for below in sorted((ROOT / BELOW.get(str(page), "-")).glob("*/README.md")):
            title = re.search(r"^# (.*)$", below.read_text(encoding="utf-8"), re.MULTILINE)[1]
            lines.append(f"  - [{title}]({below.relative_to(ROOT)})")
            pages.append(below.relative_to(ROOT))
    return lines, pages


@functools.cache
def tracked() -> set[Path]:
    """Files under version control, or new and not ignored."""
    names = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    return {Path(name) for name in names.split("\0") if name and (ROOT / name).exists()}


def check(pages: list[Path]) -> tuple[list[str], set[Path]]:
    """What is wrong with the links of these pages, and the files they lead to."""
    files = tracked()
    folders = {parent for file in files for parent in file.parents}
    faults, targets = [], set()
    for page in pages:
        if not (ROOT / page).is_file():
            faults.append(f"docs/SUMMARY.md: there is no {page}")
            continue
        text = prose((ROOT / page).read_text(encoding="utf-8"))
        for link in LINK.finditer(re.sub(r"`[^`\n]*`", lambda code: "`" + "x" * (len(code[0]) - 2) + "`", text)):
            address = link[3]
            if address.startswith(ELSEWHERE):
                continue
            where = f"{page}:{text.count(chr(10), 0, link.start()) + 1}: {address}"
            name, _, anchor = urllib.parse.unquote(address).partition("#")
            target = Path(os.path.normpath(page.parent / name)) if name else page
            if target in folders:
                target = target / "README.md" if target / "README.md" in files else target
            if target not in files and target not in folders:
                faults.append(f"{where}: there is no such file under version control")
            elif anchor and target.suffix == ".md" and anchor not in anchors(target):
                faults.append(f"{where}: {target} has no heading #{anchor}")
            elif target.suffix == ".md" and target not in pages:
                faults.append(f"{where}: {target} is no page of the book")
            else:
                targets.add(target)
    return faults, targets


def stage(lines: list[str], pages: list[Path], targets: set[Path]) -> None:
    """Lays out the book's source: the pages, and the files they lead to."""
    shutil.rmtree(BOOK, ignore_errors=True)
    source = BOOK / "source"
    copied = set(pages) | {target for target in targets if (ROOT / target).is_file()}
    for folder in (target for target in targets if (ROOT / target).is_dir()):
        copied |= {file for file in tracked() if folder in file.parents}
    for file in copied:
        (source / file).parent.mkdir(parents=True, exist_ok=True)
        if file in pages:
            (source / file).write_text(staged(file, pages), encoding="utf-8")
        else:
            shutil.copyfile(ROOT / file, source / file)
    (source / "SUMMARY.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
    for name in ("book.toml", "book.css"):
        shutil.copyfile(ROOT / "docs" / name, BOOK / name)


def staged(page: Path, pages: list[Path]) -> str:
    """A page as the book has it: links to folders lead to their README, what is no page of the book is a file."""
    text = (ROOT / page).read_text(encoding="utf-8")
    outside = prose(text).splitlines()

    def address(link: re.Match[str]) -> str:
        name, mark, anchor = link[3].partition("#")
        if link[3].startswith(ELSEWHERE) or not name:
            return link[0]
        target = ROOT / page.parent / urllib.parse.unquote(name)
        if target.is_dir() and (target / "README.md").is_file():
            name = name.rstrip("/") + "/README.md"
        return link[0].replace(f"({link[3]}", f"({name}{mark}{anchor}")

    lines = [LINK.sub(address, line) if number < len(outside) and outside[number] else line for number, line in enumerate(text.splitlines())]
    if str(page).startswith(SET_IN_PRINT):
        lines = printed(lines, outside)
    return "\n".join(lines) + "\n"


def printed(lines: list[str], outside: list[str]) -> list[str]:
    """The lines of a page with its formulas as they are in print: those in the text, and those that stand alone, which are indented."""
    made, alone = [], False
    for number, line in enumerate(lines):
        formula = line.startswith("    ") and number < len(outside) and outside[number] != "" and (alone or not lines[number - 1].strip())
        if alone and not formula:
            made.append("</pre>" + ("" if line.strip() else "\n"))
        if formula:
            shown = in_print(html.escape(line.removeprefix("    "), quote=False))
            made.append(shown if alone else f'<pre class="formula">{shown}')
        elif number < len(outside) and outside[number]:
            made.append(in_print(line))
        else:
            made.append(line)
        alone = formula
    return made


def in_print(line: str) -> str:
    """A line whose formulas have raised and lowered signs; code and links stay."""
    parts = re.split(r"(`[^`]*`|\]\([^)]*\)|https?://\S+)", line)
    for index in range(0, len(parts), 2):
        for pattern, replacement in FORMULAS:
            parts[index] = pattern.sub(replacement, parts[index])
    return "".join(parts)


class Built(html.parser.HTMLParser):
    """The places and the links of a built page."""

    def __init__(self) -> None:
        super().__init__()
        self.ids: set[str] = set()
        self.links: list[str] = []

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        for name, value in attributes:
            if value and name in ("id", "name"):
                self.ids.add(value)
            elif value and name in ("href", "src"):
                self.links.append(value)


def check_built(folder: Path) -> list[str]:
    """Links of the built pages that lead nowhere."""
    built: dict[Path, Built] = {}
    for path in sorted(folder.rglob("*.html")):
        built[path] = Built()
        built[path].feed(path.read_text(encoding="utf-8"))
    faults = []
    for path, page in built.items():
        # The page for addresses that are not there stands in no folder; the one for printing holds all pages at once.
        if path.name in ("404.html", "print.html", "toc.html"):
            continue
        for link in page.links:
            if link.startswith(("http:", "https:", "data:", "mailto:", "javascript:")):
                continue
            name, _, anchor = urllib.parse.unquote(link).partition("#")
            target = Path(os.path.normpath(path.parent / name)) if name else path
            if not target.exists():
                faults.append(f"{path.relative_to(folder)}: {link}: no such file")
            elif anchor and target in built and anchor not in built[target].ids:
                faults.append(f"{path.relative_to(folder)}: {link}: no such place")
    return sorted(set(faults))


def main() -> None:
    lines, pages = summary()
    forgotten = {path.relative_to(ROOT) for path in (ROOT / "docs").rglob("*.md")} - set(pages) - {SUMMARY.relative_to(ROOT)}
    faults, targets = check(pages)
    faults += [f"{page}: no line of docs/SUMMARY.md leads to it" for page in sorted(forgotten)]
    faults += style.check(style.pages())
    if not faults and "--check" not in sys.argv[1:]:
        if shutil.which("mdbook") is None:
            sys.exit(f"error: {MISSING_PROGRAM}")
        stage(lines, pages, targets)
        subprocess.run(["mdbook", "build", str(BOOK)], check=True, env=os.environ | {"RUST_LOG": "warn"})
        faults = check_built(BOOK / "html")
    for fault in faults:
        print(f"error: {fault}", file=sys.stderr)
    print(f"{len(pages)} pages, {len(targets)} files they lead to; {len(faults)} faults")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
