"""Executes notebooks: `notebooks.py [--write] FILE...`. With --write what they show is put into the files; without, they have to run to their ends."""

import sys
import time
from pathlib import Path

import nbformat
from nbclient import NotebookClient


def main() -> None:
    arguments = sys.argv[1:]
    writes = "--write" in arguments
    for name in (argument for argument in arguments if argument != "--write"):
        path, begin = Path(name).resolve(), time.monotonic()
        notebook = nbformat.read(path, as_version=4)
        NotebookClient(notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": path.parent}}).execute()
        if writes:
            for cell in notebook.cells:
                cell.metadata.pop("execution", None)
            notebook.metadata.pop("language_info", None)
            nbformat.write(notebook, path)
        print(f"{path.name}: {sum(cell.cell_type == 'code' for cell in notebook.cells)} cells, {time.monotonic() - begin:.1f} s", flush=True)


if __name__ == "__main__":
    main()
