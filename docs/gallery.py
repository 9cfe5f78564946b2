"""Makes the gallery: `gallery.py --embate PROGRAM [--runs N] [EXAMPLE...]`; `gallery.py --text` runs nothing and takes the text of the READMEs anew, `gallery.py --check` tells what is missing or stale.

Each example (all, if none is named) is run in a folder of its own that is removed afterwards, N times for the least run time. Its section in docs/gallery.md is written again: title and first paragraph and
`## What to look at` of its README, some moments of its `animation.gif` side by side in docs/images/gallery/EXAMPLE.png, the film itself where it is small, and figures of its `summary.json`.
What stands before these sections, and sections of the page that are no example's, are kept. Python is enough, the command installs nothing.
"""

import argparse
import json
import os
import re
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "gallery.md"
IMAGES = ROOT / "docs" / "images"
EXAMPLES = sorted(path.parent.name for path in (ROOT / "examples").glob("*/model.toml"))
HASHES = ROOT / "crates" / "cli" / "tests" / "hashes.txt"
LOOK = "What to look at"
PICTURE_BYTES, FILM_BYTES, ALL_BYTES = 80_000, 300_000, 3_600_000
# Parts of the whole time that are shown.
MOMENTS = (0.0, 1 / 3, 2 / 3, 1.0)
MOMENTS_OF = {
    "billet": (0.0, 1.0),
    "circular-tube": (0.0, 0.3, 0.6, 1.0),
    "closed-die": (0.0, 1.0),
    "cup-extrusion": (0.0, 1.0),
    "pole-bumper": (0.0, 1.0),
    "crossing-pipes": (0.0, 1.0),
    "crossing-tubes": (0.0, 1.0),
    "cup-from-blank": (0.0, 1.0),
    "cutting": (0.4, 1.0),
    "deep-penetration": (0.2, 1.0),
    "squeezed-can": (0.0, 1.0),
    "ring-compression": (0.0, 1.0),
    "roll-over-frame": (0.35, 1.0),
    "rubber-block": (0.0, 0.4, 0.7, 1.0),
    "rubber-disk": (0.0, 0.1, 0.2, 1.0),
    "taylor-bar-fast": (0.25, 1.0),
    "thin-plates": (0.0, 0.33, 0.52, 1.0),
    "tube-plate": (0.0, 0.1, 0.25, 0.5, 0.75, 1.0),
    "two-bars": (1 / 6, 1 / 3, 1 / 2, 2 / 3),
}
# What is told of an example: see its README.
UNVERIFIED = {"bullet": 20, "box-section": 4000, "box-section-shells": 4000, "circular-tube": 600}
# The picture and the film of this one are those of README.md.
FIRST = "tube-plate"


class Fault(Exception):
    """What is wrong with an example or with the page."""


# What the page takes from a README.


def text_of(example: str) -> tuple[str, str, str]:
    """Title, first paragraph and what to look at, with links as docs/gallery.md needs them."""
    readme = (ROOT / "examples" / example / "README.md").read_text(encoding="utf-8")
    title = re.match(r"# (.+)\n", readme)
    paragraph = re.search(r"^(?![#!|`\s]).+(?:\n.+)*", readme, re.MULTILINE)
    look = re.search(rf"^## {LOOK}\n+(.+?)\s*(?=^#|\Z)", readme, re.MULTILINE | re.DOTALL)
    if not (title and paragraph and look):
        raise Fault(f"examples/{example}/README.md: needs a title, a paragraph that says what it is, and `## {LOOK}`")

    def moved(text: str) -> str:
        return re.sub(r"\]\((?!\w+:)([^)#]*)", lambda link: f"]({os.path.relpath(ROOT / 'examples' / example / link[1], ROOT / 'docs')}", text)

    return title[1], moved(paragraph[0]), moved(look[1])


def image(example: str, suffix: str) -> str:
    """Where the picture or the film of an example is, from docs."""
    return f"images/{example}{suffix}" if example == FIRST else f"images/gallery/{example}{suffix}"


def section(example: str, figures: str, film: bool) -> str:
    """The section of an example; `figures` is the line of its table."""
    title, paragraph, look = text_of(example)
    links = [f"[model.toml](../examples/{example}/model.toml)", f"[expected values and their sources](../examples/{example}/README.md)"]
    links += [f"[animation]({image(example, '.gif')})"] if film else []
    return f"""## {title}

![{title}: moments of the run]({image(example, ".png")})

{paragraph}

| elements | steps | run time | energy drift | state hash |
|---|---|---|---|---|
{figures}

**{LOOK}**

{look}

{", ".join(links)}

"""


def again(example: str, part: str) -> str:
    """A section with the text of the README as it is now and the figures that it has."""
    figures = re.search(r"^\|---.*\n(\|.*\|)$", part, re.MULTILINE)
    if figures is None:
        raise Fault(f"docs/gallery.md: {example} has no figures")
    return section(example, figures[1], f"({image(example, '.gif')})" in part)


def parts_of_page() -> tuple[str, dict[str, str], str]:
    """What stands before the sections of examples, these sections, and the other sections."""
    text = PAGE.read_text(encoding="utf-8") if PAGE.exists() else "# Gallery\n\n"
    head, *parts = re.split(r"^(?=## )", text, flags=re.MULTILINE)
    sections, foot = {}, ""
    for part in parts:
        example = re.search(r"^\[model\.toml\]\(\.\./examples/([^/]+)/model\.toml\)", part, re.MULTILINE)
        if example:
            sections[example[1]] = part
        else:
            foot += part
    return head, sections, foot


# Pictures: frames of a GIF, side by side in a PNG with the same palette.


def unpacked(data: bytes, bits: int) -> bytes:
    """What LZW has packed into a frame of a GIF (Welch 1984)."""
    clear, table, out = 1 << bits, [], bytearray()
    width, before, held, count = bits + 1, b"", 0, 0
    for byte in data:
        held |= byte << count
        count += 8
        while count >= width:
            code, held, count = held & ((1 << width) - 1), held >> width, count - width
            if code == clear:
                table, width, before = [bytes([k]) for k in range(clear)] + [b"", b""], bits + 1, b""
                continue
            if code == clear + 1:
                return bytes(out)
            entry = table[code] if code < len(table) else before + before[:1]
            out += entry
            if before and len(table) < 4096:
                table.append(before + entry[:1])
                width = max(width, min(12, len(table).bit_length()))
            before = entry
    return bytes(out)


def frames_of(gif: bytes) -> tuple[int, int, bytes, list[bytes]]:
    """Width, height, palette, and the pixels of each frame, of a GIF with one palette whose frames stay until they are drawn over."""
    width, height, flags = struct.unpack("<HHB", gif[6:11])
    at = 13 + 3 * (2 << (flags & 7))
    palette, canvas, frames, clear = gif[13:at], bytearray(width * height), [], -1

    def blocks(at: int) -> tuple[bytes, int]:
        """The data of the blocks from here on, and where they end."""
        data = b""
        while gif[at]:
            data, at = data + gif[at + 1 : at + 1 + gif[at]], at + 1 + gif[at]
        return data, at + 1

    while gif[at] != 0x3B:
        if gif[at] == 0x21:
            if gif[at + 1] == 0xF9:
                clear = gif[at + 6]
            at = blocks(at + 2)[1]
            continue
        left, top, wide, high = struct.unpack("<HHHH", gif[at + 1 : at + 9])
        data, end = blocks(at + 11)
        pixels, at = unpacked(data, gif[at + 10]), end
        for row in range(high):
            line, place = pixels[row * wide : (row + 1) * wide], (top + row) * width + left
            old = canvas[place : place + wide]
            canvas[place : place + wide] = bytes(map(lambda new, old: old if new == clear else new, line, old)) if clear in line else line
        frames.append(bytes(canvas))
    return width, height, palette, frames


def png(width: int, rows: list[bytes], palette: bytes) -> bytes:
    """A picture with a palette."""

    def chunk(name: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    head = struct.pack(">IIBBBBB", width, len(rows), 8, 3, 0, 0, 0)
    data = zlib.compress(b"".join(b"\0" + row for row in rows), 9)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"PLTE", palette) + chunk(b"IDAT", data) + chunk(b"IEND", b"")


def picture(gif: bytes, moments: tuple[float, ...]) -> bytes:
    """Moments of a film, two in a row."""
    width, height, palette, frames = frames_of(gif)
    shown = [frames[round(moment * (len(frames) - 1))] for moment in moments]
    rows = []
    for pair in zip(shown[::2], shown[1::2]):
        rows += [b"".join(one[row * width : (row + 1) * width] for one in pair) for row in range(height)]
    return png(2 * width, rows, palette)


# Runs.


def run(embate: Path, example: str, runs: int) -> tuple[dict, bytes]:
    """Figures of an example, with the least run time, and its film."""
    least = None
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(runs):
            command = [str(embate), "run", str(ROOT / "examples" / example), "--out", f"{folder}/{example}", "--force", "--quiet"]
            if (code := subprocess.run(command, stdin=subprocess.DEVNULL).returncode) != 0:
                raise Fault(f"examples/{example}: exit code {code}")
            summary = json.loads(Path(folder, example, "summary.json").read_text(encoding="utf-8"))
            least = min(least or summary, summary, key=lambda one: one["user_cpu_seconds"])
        return least, Path(folder, example, "animation.gif").read_bytes()


def make(embate: Path, example: str, runs: int) -> str:
    """Runs an example, writes its picture and returns its section."""
    summary, film = run(embate, example, runs)
    if summary["status"] != "done" or summary["contact"]["unverified"] > UNVERIFIED.get(example, 0):
        raise Fault(f"examples/{example}: {summary['status']}, {summary['contact']['unverified']} nodes or edges went in unseen")
    made, has_film = picture(film, MOMENTS_OF.get(example, MOMENTS)), len(film) <= FILM_BYTES or example == FIRST
    (IMAGES / "gallery").mkdir(exist_ok=True)
    (PAGE.parent / image(example, ".png")).write_bytes(made)
    if has_film:
        (PAGE.parent / image(example, ".gif")).write_bytes(film)
    seconds = summary["user_cpu_seconds"]
    taken = f"{seconds:.0f} s" if seconds >= 10 else f"{seconds:.1f} s"
    print(f"{example}: {seconds:.2f} s, picture {len(made)} bytes, film {len(film)} bytes", flush=True)
    figures = f"| {summary['elements']:,} | {summary['steps']:,} | {taken} | {summary['energy_drift']:.0e} | `{summary['state_hash']}` |"
    return section(example, figures.replace("e-0", "e-"), has_film)


def faults(sections: dict[str, str]) -> list[str]:
    """What is missing or stale."""
    found = [f"docs/gallery.md: {example} is no example" for example in sections if example not in EXAMPLES]
    hashes = dict(line.split() for line in HASHES.read_text(encoding="utf-8").splitlines() if line.strip())
    for example in EXAMPLES:
        part = sections.get(example)
        if part is None:
            found.append(f"docs/gallery.md: no section for examples/{example}; `docs/gallery.py --embate PROGRAM {example}` writes it")
            continue
        try:
            if part.strip() != again(example, part).strip():
                found.append(f"docs/gallery.md: {example} does not say what examples/{example}/README.md says; `docs/gallery.py --text` writes it again")
            if f"`{hashes.get('examples/' + example)}`" not in part:
                found.append(f"docs/gallery.md: {example} has other results now; `docs/gallery.py --embate PROGRAM {example}` writes it again")
            for name in re.findall(rf"\((images/[\w/-]*{example}\.\w+)\)", part):
                if not (PAGE.parent / name).is_file():
                    found.append(f"docs/{name} is missing")
        except Fault as fault:
            found.append(str(fault))
    pictures, page = list((IMAGES / "gallery").glob("*")), "".join(sections.values())
    for path in pictures:
        if f"(images/gallery/{path.name})" not in page:
            found.append(f"{path.relative_to(ROOT)}: nothing shows it")
        if path.suffix == ".png" and path.stat().st_size > PICTURE_BYTES:
            found.append(f"{path.relative_to(ROOT)}: larger than {PICTURE_BYTES} bytes")
    if sum(path.stat().st_size for path in pictures) > ALL_BYTES:
        found.append(f"docs/images/gallery: more than {ALL_BYTES} bytes")
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--embate", type=Path, help="the program")
    parser.add_argument("--runs", type=int, default=1, help="how often each example is run, for the least run time")
    parser.add_argument("--text", action="store_true", help="run nothing, take the text anew")
    parser.add_argument("--check", action="store_true", help="run nothing, write nothing")
    parser.add_argument("examples", nargs="*", metavar="EXAMPLE", help="all, if none is named")
    arguments = parser.parse_args()
    if unknown := set(arguments.examples) - set(EXAMPLES):
        parser.error(f"there is no example {', '.join(sorted(unknown))}")
    head, sections, foot = parts_of_page()
    if not (arguments.check or arguments.text or arguments.embate):
        parser.error("needs --embate PROGRAM, --text or --check")
    try:
        if arguments.text:
            sections = {example: again(example, part) for example, part in sections.items() if example in EXAMPLES}
        elif not arguments.check:
            for example in arguments.examples or EXAMPLES:
                sections[example] = make(arguments.embate.resolve(), example, arguments.runs)
    except Fault as fault:
        sys.exit(f"error: {fault}")
    if not arguments.check:
        PAGE.write_text(head + "".join(sections[example] for example in sorted(sections)) + foot, encoding="utf-8")
    wrong = faults(sections)
    for fault in wrong:
        print(f"error: {fault}", file=sys.stderr)
    print(f"{len(sections)} examples, {sum(path.stat().st_size for path in (IMAGES / 'gallery').glob('*')) // 1000} kB of pictures and films; {len(wrong)} faults")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
