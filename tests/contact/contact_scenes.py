#!/usr/bin/env python3
"""Runs random scenes, or the models of a folder, and judges each by `interpenetration.py`.

    python tests/contact/contact_scenes.py --embate target/release/embate --first 1 --count 100 [--plane] [--family bars] [--processes 2]
    python tests/contact/contact_scenes.py --embate target/release/embate --torture FOLDER

Prints a table by family, and the silent ones with their seeds. Scenes come from `scenes.py`: the same seeds are the same scenes, if `--cells` is.
What is not deep and was not finished within the limit counts as `late`; a run without results as `refused` (of the model) or
`crashed`. Exit code 1 if a run is silent, refused or crashed.
"""

import argparse
import json
import multiprocessing
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

for variable in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(variable, "1")

import interpenetration  # noqa: E402  (numpy reads the number of threads when it is imported)
import scenes  # noqa: E402

VERDICTS = ["held", "told", "silent", "ended", "late", "refused", "crashed"]
BAD = {"silent", "refused", "crashed"}
# Frames of models that say themselves how many they want.
TORTURE_FRAMES = 40


def work(task):
    """Runs one model and judges it; a dictionary that tells all."""
    model, scratch, options = task
    family = None
    if not isinstance(model, pathlib.Path):
        family, number = model
        model = scenes.make(family, number, options.cells).write(scratch / "models")
    out = scratch / "results" / model.name
    command = [str(options.embate), "run", str(model), "--threads", "1", "--quiet", "--force", "--out", str(out)]
    command += ["--set", "output.pictures=false"] + (["--set", f"output.fields={TORTURE_FRAMES}"] if family is None else [])
    for change in options.set:
        command += ["--set", change]
    begin = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    is_late = False
    try:
        errors = process.communicate(timeout=options.limit)[1]
    except subprocess.TimeoutExpired:
        is_late = True
        process.send_signal(signal.SIGTERM)
        try:
            errors = process.communicate(timeout=20)[1]
        except subprocess.TimeoutExpired:
            process.kill()
            errors = process.communicate()[1]
    seconds = time.monotonic() - begin
    judgement = interpenetration.judge(out, options.fraction, model.name)
    verdict = judgement.verdict
    first_error = next((line for line in errors.splitlines() if line.strip()), "")[:200]
    if verdict == "unread":
        verdict = "late" if is_late else ("refused" if process.returncode == 2 else "crashed")
        judgement.notes.append(first_error)
    elif process.returncode not in (0, 1, 130, -signal.SIGTERM):
        verdict = "crashed"
        judgement.notes.append(f"exit code {process.returncode}: {first_error}")
    elif is_late and verdict in ("held", "ended"):
        verdict = "late"
    judgement.verdict = verdict
    if verdict not in BAD or not options.keep:
        shutil.rmtree(out, ignore_errors=True)
        if family is not None and not options.keep:
            shutil.rmtree(model, ignore_errors=True)
    error = json_of(out, "error") if verdict == "crashed" else None
    return {
        "name": model.name,
        "family": family or "models",
        "seconds": seconds,
        "line": judgement.line(),
        "error": error,
        **judgement.__dict__,
    }


def json_of(folder, key):
    try:
        return json.loads((folder / "summary.json").read_text(encoding="utf-8")).get(key)
    except (OSError, ValueError):
        return None


def table(results):
    """Markdown: families and how their runs ended; of the silent ones also those in which bodies have gone through each other, or almost."""
    families = sorted({result["family"] for result in results})
    ended = {result["verdict"] for result in results}
    columns = [verdict for verdict in VERDICTS if verdict in ended or verdict in VERDICTS[:4]]
    shown = columns + ["silent: > 0.5 or through"]
    lines = ["| family | scenes | " + " | ".join(shown) + " |", "|---" * (2 + len(shown)) + "|"]
    for family in families + (["**all**"] if len(families) > 1 else []):
        mine = [result for result in results if family in (result["family"], "**all**")]
        counts = [sum(result["verdict"] == verdict for result in mine) for verdict in columns]
        counts.append(
            sum(result["verdict"] == "silent" and (result["ratio"] > 0.5 or bool(result["changed"])) for result in mine)
        )
        lines.append(f"| {family} | {len(mine)} | " + " | ".join(map(str, counts)) + " |")
    return "\n".join(lines)


def model_table(results):
    """Markdown: a line for each model."""
    lines = ["| model | verdict | depth / thickness | unverified | penetration_max, m | found, m | drift | |", "|---" * 8 + "|"]
    for result in results:
        claims = result["claims"]
        numbers = [claims.get("unverified"), claims.get("penetration_max"), claims.get("true_depth"), claims.get("energy_drift")]
        texts = ["" if x is None else (str(x) if isinstance(x, int) else f"{x:.2g}") for x in numbers]
        notes = "; ".join([*result["changed"][:1], *result["said"][:2], *result["notes"][:3]])
        lines.append(
            f"| `{result['name']}` | {result['verdict']} | {result['ratio']:.2f} | " + " | ".join(texts) + f" | {notes} |"
        )
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--embate", required=True, type=pathlib.Path, help="the program")
    parser.add_argument("--first", type=int, default=1, help="seed of the first scene")
    parser.add_argument("--count", type=int, default=100, help="how many scenes")
    parser.add_argument("--plane", action="store_true", help="scenes of the plane")
    parser.add_argument("--family", help="scenes of one family only")
    parser.add_argument("--cells", type=int, default=scenes.CELLS, help="elements of a scene at most")
    parser.add_argument("--torture", type=pathlib.Path, help="run the models in this folder instead")
    parser.add_argument("--only", default="", help="with --torture: models whose names contain this")
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--limit", type=float, default=60.0, help="seconds for one run")
    parser.add_argument(
        "--fraction", type=float, default=interpenetration.FRACTION, help="depth over the local thickness that is too deep"
    )
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="handed on to the program")
    parser.add_argument(
        "--keep", type=pathlib.Path, help="keep models here, and the results of those that are silent, refused or crashed"
    )
    parser.add_argument("--table", type=pathlib.Path, help="write the tables to this file, too")
    parser.add_argument("--verbose", action="store_true", help="a line for each run as it ends")
    options = parser.parse_args()
    options.embate = options.embate.resolve()
    if options.torture:
        models = sorted(path.parent for path in options.torture.glob("*/model.toml") if options.only in path.parent.name)
    else:
        names = [options.family] if options.family else scenes.families(options.plane)
        models = [(names[number % len(names)], number) for number in range(options.first, options.first + options.count)]
    with tempfile.TemporaryDirectory() as scratch:
        scratch = options.keep or pathlib.Path(scratch)
        results = []
        with multiprocessing.get_context("spawn").Pool(options.processes) as pool:
            for result in pool.imap(work, [(model, scratch, options) for model in models]):
                results.append(result)
                if options.verbose or result["verdict"] in BAD:
                    print(f"{result['line']} [{result['seconds']:.1f} s]", flush=True)
    text = (model_table(results) + "\n\n" if options.torture else "") + table(results)
    bad = [result for result in results if result["verdict"] in BAD]
    if bad and not options.torture:
        text += "\n\n" + "\n".join(f"- {result['line']}" for result in bad)
    print(text)
    if options.table:
        options.table.write_text(text + "\n", encoding="utf-8")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
