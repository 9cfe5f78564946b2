"""Executes the code blocks of pages: `book.py --embate PROGRAM [--python PYTHON] [--list] [--short] [PAGE...]`; without pages, all of the book.

The blocks of a page are executed in their order, in a fresh folder that holds copies of `examples`, `verification`, `failures` and `docs`. What the first line of a block says:

    ```sh                       run by bash; has to succeed, or with `exit=N` to end with that code
    ```text output              what the shell block before it printed: its lines in this order; `…` is any text, a line `…` any lines
    ```toml                     a model, or a piece of one: only keys, units and values that there are
    ```toml file=ring/model.toml, ```python file=NAME and so on: written to that file
    ```python                   run by a Python that has the package `embate`; all blocks of a page are one program, a script
    ```python needs=scipy       the same, where that Python has this package too
    ```LANGUAGE not-run="why"   shown, not executed
    ```text, json, csv, bibtex  shown
"""

import argparse
import concurrent.futures
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
COPIED = ["examples", "verification", "failures", "docs"]
# Their blocks are held by tests of their own: `messages`, `adding`; and each example is run, with its figures, by `examples`.
ELSEWHERE = ["docs/messages.md", "docs/adding.md"]
# Pages whose blocks take more than some four seconds of processor time, or which `.ci/run` executes by themselves, with numpy alone:
# with `--short` only their models are checked.
LONG = [
    "README.md",
    "crates/python/README.md",
    "docs/diff.md",
    "docs/guides/contact.md",
    "docs/guides/ledger.md",
    "docs/guides/quasi-static.md",
    "docs/guides/remeshing.md",
    "docs/guides/restart.md",
    "docs/guides/speed.md",
    "docs/paper.md",
    "docs/python.md",
    "docs/restart.md",
    "docs/sweep.md",
]
SHOWN = {"text", "json", "csv", "bibtex", "html"}
# What a piece of a model may lack: whole sections, keys, and what its names mean.
INCOMPLETE = {"E0104", "E0107", "E0110", "E0116"}
SECONDS = 300


class Failed(Exception):
    """A block that does not do what its page says."""


@dataclass
class Block:
    line: int
    language: str
    words: list[str]
    text: str

    def value(self, key: str) -> str | None:
        """The value of `key=value` in the block's first line."""
        return next((word.partition("=")[2] for word in self.words if word.startswith(f"{key}=")), None)


def blocks(page: Path) -> list[Block]:
    """All fenced blocks of a page."""
    found, open_fence, info, begin, lines = [], None, "", 0, []
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        fence = re.match(r"^ {0,3}(`{3,}|~{3,})(.*)$", line)
        if open_fence is None and fence:
            open_fence, info, begin, lines = fence[1], fence[2].strip(), number, []
        elif open_fence is not None and fence and fence[1].startswith(open_fence) and not fence[2].strip():
            words = shlex.split(info)
            found.append(Block(begin, words[0] if words else "", words[1:], "\n".join(lines) + "\n"))
            open_fence = None
        elif open_fence is not None:
            lines.append(line)
    if open_fence is not None:
        raise Failed(f"{page}:{begin}: the block has no end")
    return found


class Page:
    """One page and the folder in which its blocks are executed."""

    def __init__(self, path: Path, folder: Path, embate: Path, python: Path | None, runs: bool):
        self.path, self.folder, self.embate, self.python, self.runs = path, folder, embate, python, runs
        self.printed: list[str] | None = None
        self.program = ""
        # Whether the last block of Python was left out, and its output with it.
        self.is_left_out = False
        self.counts = {"run": 0, "checked": 0, "shown": 0, "not run": 0}
        for name in COPIED:
            shutil.copytree(ROOT / name, folder / name)
        commands = folder / ".commands"
        commands.mkdir()
        (commands / "embate").symlink_to(embate)
        names = [str(commands), *([str(python.parent)] if python else []), os.environ["PATH"]]
        self.environment = os.environ | {"PATH": os.pathsep.join(names), "NO_COLOR": "1", "MPLBACKEND": "agg", "COLUMNS": "150"}

    def execute(self) -> None:
        """All blocks, in their order."""
        for block in blocks(self.path):
            try:
                self.counts[self.block(block)] += 1
            except Failed as failed:
                raise Failed(f"{self.path.relative_to(ROOT)}:{block.line}: {failed}") from None

    def block(self, block: Block) -> str:
        """Executes one block and says what was done with it."""
        if block.value("not-run") is not None:
            if not block.value("not-run"):
                raise Failed("`not-run` needs a reason")
            return "not run"
        if block.value("file") is not None:
            return self.write(block)
        match block.language:
            case "sh" | "python" | "text" if not self.runs and (block.language != "text" or "output" in block.words):
                return "not run"
            case "sh":
                return self.shell(block)
            case "toml":
                return self.model(block.text)
            case "python":
                return self.run_python(block)
            case "text" if "output" in block.words:
                return self.output(block.text)
            case language if language in SHOWN:
                return "shown"
            case "":
                raise Failed("the block names no language")
            case language:
                raise Failed(f"blocks of {language} are not known")

    def write(self, block: Block) -> str:
        path = self.folder / block.value("file")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(block.text, encoding="utf-8")
        if path.name == "model.toml":
            self.model(block.text, path)
        return "checked"

    def command(self, arguments: list[str]) -> subprocess.CompletedProcess[str]:
        try:
            return subprocess.run(
                arguments,
                cwd=self.folder,
                env=self.environment,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                text=True,
                errors="replace",
                timeout=SECONDS,
            )
        except subprocess.TimeoutExpired:
            raise Failed(f"it takes longer than {SECONDS} s") from None

    def shell(self, block: Block) -> str:
        done = self.command(["bash", "-euo", "pipefail", "-c", block.text])
        wanted = int(block.value("exit") or 0)
        if done.returncode != wanted:
            raise Failed(f"exit code {done.returncode} instead of {wanted}\n{done.stdout[-3000:]}")
        self.printed = done.stdout.splitlines()
        return "run"

    def model(self, text: str, path: Path | None = None) -> str:
        """A whole model has no faults; a piece of one has none but that it is a piece."""
        whole = path is not None or re.search(r"^\s*(run\.end|run\s*=|\[run\])", text, re.MULTILINE)
        if path is None:
            path = self.folder / ".piece" / "model.toml"
            path.parent.mkdir(exist_ok=True)
            path.write_text(text, encoding="utf-8")
        done = self.command([str(self.embate), "check", str(path), "--out", str(self.folder / ".piece" / "out")])
        faults = set(re.findall(r"^error\[(E\d+)\]", done.stdout, re.MULTILINE))
        if done.returncode not in (0, 2) or (done.returncode == 2 and not faults):
            raise Failed(f"exit code {done.returncode}\n{done.stdout[-3000:]}")
        if faults - (set() if whole else INCOMPLETE):
            raise Failed(f"the program does not take it\n{done.stdout[-3000:]}")
        return "checked"

    def run_python(self, block: Block) -> str:
        """Blocks of a page share their names: each is run after those before it."""
        if self.python is None:
            return "not run"
        needed = block.value("needs")
        if needed and self.command([str(self.python), "-c", f"import {needed}"]).returncode != 0:
            self.is_left_out = True
            return "not run"
        self.program += block.text
        script = self.folder / ".script" / "page.py"
        script.parent.mkdir(exist_ok=True)
        script.write_text(self.program, encoding="utf-8")
        done = self.command([str(self.python), "-W", "error", str(script)])
        if done.returncode != 0:
            raise Failed(f"exit code {done.returncode}\n{done.stdout[-3000:]}")
        self.printed = done.stdout.splitlines()
        return "run"

    def output(self, text: str) -> str:
        """Compares what a page shows with what was printed."""
        if self.is_left_out:
            self.is_left_out = False
            return "not run"
        if self.printed is None:
            raise Failed("no block was run before this output")
        at = 0
        for wanted in text.splitlines():
            if not wanted.strip():
                continue
            if wanted.strip() == "…":
                continue
            pattern = re.compile(".*".join(re.escape(part) for part in wanted.rstrip().split("…")))
            while at < len(self.printed) and not pattern.fullmatch(self.printed[at].rstrip()):
                at += 1
            if at == len(self.printed):
                shown = "\n".join(self.printed[-60:])
                raise Failed(f"the program does not print, or not after the line before it,\n  {wanted}\nbut\n{shown}")
            at += 1
        return "checked"


def pages() -> list[Path]:
    """All pages of the book with blocks, as they are under version control or in the folders of documents."""
    patterns = ["*.md", "docs/**/*.md", "verification/*/README.md", "failures/README.md", "crates/python/README.md"]
    found = {path for pattern in patterns for path in ROOT.glob(pattern)}
    return sorted(path for path in found if str(path.relative_to(ROOT)) not in ELSEWHERE and blocks(path))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--embate", type=Path, required=True)
    parser.add_argument("--python", type=Path, help="without it, blocks of Python are not run")
    parser.add_argument("--list", action="store_true", help="list what is not run, and why")
    parser.add_argument("--short", action="store_true", help="of pages that take long, only the models are checked")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("pages", nargs="*", type=Path)
    arguments = parser.parse_args()
    # Not resolved: the Python of an environment is a link out of it.
    embate, python = arguments.embate.resolve(), arguments.python and Path(os.path.abspath(arguments.python))
    chosen = [page.resolve() for page in arguments.pages] or pages()
    if arguments.list:
        for page in chosen:
            for block in blocks(page):
                if block.value("not-run") is not None:
                    print(f"{page.relative_to(ROOT)}:{block.line}: {block.language}: {block.value('not-run')}")
        return

    def executed(path: Path) -> tuple[Path, dict[str, int], float, str]:
        begin = time.monotonic()
        with tempfile.TemporaryDirectory(prefix="book-") as folder:
            runs = not (arguments.short and str(path.relative_to(ROOT)) in LONG)
            page = Page(path, Path(folder), embate, python, runs)
            try:
                page.execute()
                fault = ""
            except Failed as failed:
                fault = str(failed)
        return path, page.counts, time.monotonic() - begin, fault

    total, faults = {}, []
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for path, counts, seconds, fault in pool.map(executed, chosen):
            print(f"{path.relative_to(ROOT)}: {', '.join(f'{count} {what}' for what, count in counts.items() if count)}; {seconds:.1f} s", flush=True)
            total = {what: total.get(what, 0) + count for what, count in counts.items()}
            if fault:
                faults.append(fault)
                print(f"error: {fault}", flush=True)
    print(f"{len(chosen)} pages: {', '.join(f'{count} blocks {what}' for what, count in total.items())}; {len(faults)} failed")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
