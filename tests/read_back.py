#!/usr/bin/env python3
"""Reads result folders back with meshio and vtk (whichever are installed, at least one) and checks them.

    python tests/read_back.py [--every N] results/tube-plate [more folders]

For each folder: fields.pvd lists frames with ascending times; each frame (with --every: one of N, and the last) is read by every reader, has as many points and
cells as the first one and as summary.json says (others before elements were made again), only finite values (contact_gap may have none), z = 0 unless it has solids, points = initial points +
displacement, and the time of the collection; all readers agree; obstacles.pvd, where there is one, lists as many files at the same times, each with
finite points and lines (in space triangles and quadrilaterals) that know their obstacle; history.csv has `time` first, ascending, and only numbers. Exit code 0 when all is
well, 1 with one line per fault, 2 when nothing could be checked.
"""

import csv
import json
import pathlib
import sys
import xml.etree.ElementTree

import numpy

try:
    import meshio
except ImportError:
    meshio = None
try:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError:
    vtkXMLUnstructuredGridReader = None

VTK_TYPES = {"line": 3, "triangle": 5, "quad": 9, "tetra": 10, "hexahedron": 12, "wedge": 13, "triangle6": 22, "tetra10": 24}
SOLIDS = {VTK_TYPES[name] for name in ("tetra", "tetra10", "hexahedron", "wedge")}
# Components of stress in the plane and in space.
STRESSES = [["xx", "yy", "zz", "xy"], ["xx", "yy", "zz", "xy", "yz", "zx"]]
# Has no value where nothing is near.
MAY_BE_NAN = {"contact_gap"}


class Grid:
    """What a reader found: points, cells as (type, nodes), fields by name, time."""

    def __init__(self, points, cells, at_points, at_cells, time):
        self.points, self.cells, self.at_points, self.at_cells, self.time = points, cells, at_points, at_cells, time

    def is_of_space(self):
        return any(kind in SOLIDS for kind, _ in self.cells)


def by_meshio(path):
    mesh = meshio.read(path)
    # meshio turns wedges over on reading.
    order = {"wedge": (0, 2, 1, 3, 5, 4)}
    cells = [
        (VTK_TYPES[block.type], tuple(nodes[k] for k in order.get(block.type, range(len(nodes)))))
        for block in mesh.cells
        for nodes in block.data.tolist()
    ]
    at_cells = {name: numpy.concatenate(blocks) for name, blocks in mesh.cell_data.items()}
    return Grid(mesh.points, cells, mesh.point_data, at_cells, mesh.field_data.get("TimeValue"))


def by_vtk(path):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    if reader.GetErrorCode():
        raise ValueError(f"vtk error {reader.GetErrorCode()}")
    grid = reader.GetOutput()
    cells = []
    for index in range(grid.GetNumberOfCells()):
        nodes = grid.GetCell(index).GetPointIds()
        cells.append((grid.GetCellType(index), tuple(nodes.GetId(i) for i in range(nodes.GetNumberOfIds()))))

    def arrays(data):
        return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}

    stress = grid.GetCellData().GetArray("stress")
    is_of_space = any(kind in SOLIDS for kind, _ in cells)
    if stress is not None and [stress.GetComponentName(i) for i in range(stress.GetNumberOfComponents())] != STRESSES[is_of_space]:
        raise ValueError(f"the components of stress are not named {', '.join(STRESSES[is_of_space])}")
    time = arrays(grid.GetFieldData()).get("TimeValue")
    points = vtk_to_numpy(grid.GetPoints().GetData())
    return Grid(points, cells, arrays(grid.GetPointData()), arrays(grid.GetCellData()), time)


def readers():
    found = {}
    if meshio is not None:
        found["meshio"] = by_meshio
    if vtkXMLUnstructuredGridReader is not None:
        found["vtk"] = by_vtk
    return found


def frame_faults(grid, initial, time):
    """Faults of one frame; `initial` are the points minus the displacement of the first frame, or None."""
    if grid.time is not None and float(numpy.ravel(grid.time)[0]) != time:
        yield f"TimeValue is {grid.time}, the collection says {time}"
    for place, fields, count in (("points", grid.at_points, len(grid.points)), ("cells", grid.at_cells, len(grid.cells))):
        for name, values in fields.items():
            if len(values) != count:
                yield f"{name} has {len(values)} values on {count} {place}"
            if not (numpy.isfinite(values) | (numpy.isnan(values) & (name in MAY_BE_NAN))).all():
                yield f"{name} has values that are not finite"
    if not numpy.isfinite(grid.points).all():
        yield "points are not finite"
    if not grid.is_of_space() and (grid.points[:, 2] != 0).any():
        yield "points are not in the plane z = 0"
    if "part" not in grid.at_cells:
        yield "the cell field part is missing"
    for _, nodes in grid.cells:
        if max(nodes) >= len(grid.points) or len(set(nodes)) != len(nodes):
            yield f"cell with nodes {nodes} is broken"
            break
    if initial is not None and "displacement" in grid.at_points:
        difference = numpy.abs(initial + grid.at_points["displacement"] - grid.points).max(initial=0.0)
        size = numpy.abs(grid.points).max(initial=1e-300)
        if difference > 1e-12 * size:
            yield f"points differ from initial points + displacement by {difference}"


def disagreements(first, second):
    """Where two readers of one file differ."""
    if not numpy.array_equal(first.points, second.points):
        yield "readers disagree about the points"
    # meshio sorts cells by blocks of one type, in the order of the file.
    if first.cells != second.cells:
        yield "readers disagree about the cells"
    for one, other in ((first.at_points, second.at_points), (first.at_cells, second.at_cells)):
        if set(one) != set(other):
            yield f"readers disagree about the fields: {sorted(set(one) ^ set(other))}"
        for name in set(one) & set(other):
            if not numpy.array_equal(numpy.squeeze(one[name]), numpy.squeeze(other[name]), equal_nan=True):
                yield f"readers disagree about {name}"


def frames(folder, sets, every):
    """Name, time and grids (one of each reader) of one of so many files of a collection and of the last one, and what is wrong with one that can't be read."""
    for entry in [*sets[:-1:every], *sets[-1:]]:
        name, time, grids, fault = entry.get("file"), float(entry.get("timestep")), [], None
        try:
            grids = [read(folder / name) for read in readers().values()]
        except Exception as error:  # a reader's exceptions are many and undocumented
            fault = f"{name} can't be read: {error!r}"
        yield name, time, grids, fault


def obstacle_faults(folder, field_times, is_of_space, every):
    """Faults of obstacles.pvd and its files."""
    kinds = {VTK_TYPES[name] for name in (("triangle", "quad") if is_of_space else ("line",))}
    sets = xml.etree.ElementTree.parse(folder / "obstacles.pvd").getroot().findall("Collection/DataSet")
    times = [float(entry.get("timestep")) for entry in sets]
    if times != field_times:
        yield "obstacles.pvd and fields.pvd have different times"
    first = None
    for name, time, grids, fault in frames(folder, sets, every):
        if fault:
            yield fault
            continue
        grid = grids[0]
        if grid.time is not None and float(numpy.ravel(grid.time)[0]) != time:
            yield f"{name}: TimeValue is {grid.time}, the collection says {time}"
        if not numpy.isfinite(grid.points).all() or (not is_of_space and (grid.points[:, 2] != 0).any()):
            yield f"{name}: points are not finite or not in the plane z = 0"
        if not grid.cells or any(kind not in kinds for kind, _ in grid.cells):
            yield f"{name}: cells are not {'triangles and quadrilaterals' if is_of_space else 'lines'}"
        indices = list(numpy.ravel(grid.at_cells.get("obstacle", [])))
        if len(indices) != len(grid.cells) or sorted(indices) != indices:
            yield f"{name}: the cell field obstacle is missing or not in order"
        first = first or grid
        if first.cells != grid.cells:
            yield f"{name}: the cells are others than in the first frame"
        for other in grids[1:]:
            yield from (f"{name}: {fault}" for fault in disagreements(grid, other))


def history_faults(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    if not rows or rows[0][0] != "time":
        yield "history.csv does not begin with the column time"
        return
    if len(set(rows[0])) != len(rows[0]):
        yield "history.csv has a column name twice"
    try:
        values = numpy.array([[float(text) for text in row] for row in rows[1:]])
    except ValueError as error:
        yield f"history.csv: {error}"
        return
    if values.size == 0:
        yield "history.csv has no rows"
    elif not numpy.isfinite(values).all():
        yield "history.csv has values that are not finite"
    elif (numpy.diff(values[:, 0]) <= 0).any():
        yield "history.csv: time does not ascend"


def has_beams(folder):
    """Whether the model of a result folder has beams."""
    model = pathlib.Path(json.loads((folder / "run.json").read_text(encoding="utf-8"))["model"])
    model = model / "model.toml" if model.is_dir() else model
    return "beam2" in model.read_text(encoding="utf-8")


def faults(folder, every):
    """All faults of a result folder."""
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    yield from (f"{path.name} is left over" for path in folder.rglob("*.part"))
    if (folder / "history.csv").exists():
        yield from history_faults(folder / "history.csv")
    else:
        yield "history.csv is missing"
    sets = xml.etree.ElementTree.parse(folder / "fields.pvd").getroot().findall("Collection/DataSet")
    times = [float(entry.get("timestep")) for entry in sets]
    if not sets:
        yield "fields.pvd lists no frames"
    if any(later <= earlier for earlier, later in zip(times, times[1:])):
        yield "fields.pvd: time does not ascend"
    if summary["status"] == "done" and times and abs(times[-1] - summary["time_end"]) > 1e-9 * abs(summary["time_end"]):
        yield f"the last frame is at {times[-1]}, the run ended at {summary['time_end']}"
    initial = None
    is_of_space = False
    # Where elements were made again there are other cells from then on; a frame at that time shows the old ones.
    events = summary.get("remeshings", [])
    made = 0
    for name, time, grids, fault in frames(folder, sets, every):
        if fault:
            yield fault
            continue
        grid = grids[0]
        is_of_space = is_of_space or grid.is_of_space()
        # A beam is several cells, those of its cross-section.
        cells = len(grid.cells)
        later = [event["elements"] for event in events if event["time"] >= time]
        # Nodes of a flow may have other numbers in each frame.
        if made != len(events) - len(later) or summary.get("flows"):
            made, initial = len(events) - len(later), None
        elements = summary["elements"] - sum(after - before for before, after in later)
        are_all = cells == elements or cells > elements and has_beams(folder)
        if (not later and len(grid.points) != summary["nodes"]) or not are_all:
            yield f"{name} has {len(grid.points)} points and {len(grid.cells)} cells, the summary says otherwise"
            continue
        if initial is None and "displacement" in grid.at_points:
            initial = grid.points - grid.at_points["displacement"]
        yield from (f"{name}: {fault}" for fault in frame_faults(grid, initial, time))
        for other in grids[1:]:
            yield from (f"{name}: {fault}" for fault in disagreements(grid, other))
    if (folder / "obstacles.pvd").exists():
        yield from obstacle_faults(folder, times, is_of_space, every)


def main(arguments):
    every = 1
    if arguments[:1] == ["--every"]:
        every, arguments = int(arguments[1]), arguments[2:]
    if not arguments or not readers():
        print(__doc__ if not arguments else "neither meshio nor vtk is installed", file=sys.stderr)
        return 2
    is_good = True
    for folder in map(pathlib.Path, arguments):
        found = list(faults(folder, every))
        is_good = is_good and not found
        for fault in found:
            print(f"{folder}: {fault}", file=sys.stderr)
        if not found:
            print(f"{folder}: read back well by {' and '.join(readers())}")
    return 0 if is_good else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
