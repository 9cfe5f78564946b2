#!/usr/bin/env python3
"""Tests of `interpenetration.py`, of `sheets.py` and of the scenes: overlaps made by hand, whose depths, volumes and area vectors are known.

Run by pytest, or as a program.
"""

import json
import math
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent))

import meshes
import numpy as np
import scenes
import sheets
from interpenetration import Body, Frame, Judge, Placed, bodies_of, in_obstacle, judge, overlap, self_overlap, volume
from obstacles import Obstacle
from overlap import distances, near_pairs, simplices, winding, within_elements
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkStaticCellLocator, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

KINDS = {3: 5, 4: 10, 6: 13, 8: 12}


def joined(*parts):
    """Points, cells (kind, number, nodes) and part numbers of several meshes."""
    points, cells, owners = [], [], []
    for number, mesh in enumerate(parts):
        first = sum(map(len, points))
        cells += [(KINDS[len(cell)], len(cells) + k, tuple(first + n for n in cell)) for k, cell in enumerate(mesh.cells)]
        owners += [number] * len(mesh.cells)
        points.append(mesh.points)
    return np.concatenate(points), cells, owners


def two(first, second, dimension=3):
    points, cells, owners = joined(first, second)
    bodies = bodies_of(points, cells, owners, ["a", "b"], dimension)
    return [Placed(body, points) for body in bodies]


def roofs(height):
    """Two square bars that cross, one ridge `height` below the other."""
    width = 0.2
    bar = meshes.box((1.0, width, width), (5, 1, 1)).moved(meshes.rotation((1, 0, 0), math.pi / 4))
    half = width / math.sqrt(2)
    return bar, bar.moved(meshes.rotation((0, 0, 1), math.pi / 2), (0, 0, 2 * half - height))


def close(value, expected, tolerance=1e-9):
    assert np.allclose(value, expected, rtol=tolerance, atol=tolerance), f"{value} instead of {expected}"


def test_boxes_of_each_kind_of_element_are_as_deep_as_they_were_put():
    for kind in ("hex", "tet", "wedge", "mixed"):
        for depth in (1e-6, 0.05, 0.15):
            large = meshes.box((1, 1, 1), (2, 2, 2), kind, scenes.Dice(1))
            small = meshes.box((1, 0.6, 0.6), (2, 1, 3), kind, scenes.Dice(2)).moved(by=(1 - depth, 0.0131, 0.0072))
            a, b = two(large, small)
            found = overlap(a, b)
            close(found.depth, depth)
            close(found.deepest_node, depth)
            close(found.area, (0.36, 0, 0))
            assert 0.5 - 1e-9 < found.tau < 0.6 + 1e-9, found.tau
            close(overlap(b, a).area, (-0.36, 0, 0))
            assert abs(volume(a, b, found) - 0.36 * depth) < 1e-6


def test_a_turned_and_moved_pair_is_as_deep():
    depth, spin = 0.1, meshes.rotation((1, 2, 3), 0.7)
    large = meshes.box((1, 1, 1), (2, 2, 2)).moved(spin, (1e3, -2e3, 5e2))
    small = meshes.box((1, 0.6, 0.6), (2, 1, 3)).moved(by=(1 - depth, 0, 0)).moved(spin, (1e3, -2e3, 5e2))
    found = overlap(*two(large, small))
    close(found.depth, depth)
    close(found.area, spin @ (0.36, 0, 0), 1e-8)


def test_ridges_that_cross_are_seen_though_no_node_is_inside():
    for height in (0.001, 0.02, 0.05):
        a, b = two(*roofs(height))
        found = overlap(a, b)
        # A sample is in the middle of the ridge's piece inside.
        close(found.depth, height / math.sqrt(2))
        close(found.area, (0, 0, 2 * height**2))
        close(found.deepest_node, 0)
        assert abs(volume(a, b, found, 20000) - 2 / 3 * height**3) < 0.05 * 2 / 3 * height**3


def test_bodies_that_are_apart_or_touch_do_not_overlap():
    box = meshes.box((1, 1, 1), (2, 2, 2))
    assert overlap(*two(box, box.moved(by=(1.001, 0.3, 0.2)))) is None
    assert overlap(*two(*roofs(-1e-6))) is None
    # Boxes around them meet, the bodies do not.
    assert overlap(*two(box, box.moved(meshes.rotation((0, 0, 1), math.pi / 4), (1.1, 1.1, 0)))) is None


def test_a_body_within_another_is_found_without_cuts():
    found = overlap(*two(meshes.box((1, 1, 1), (1, 1, 1)), meshes.box((0.2, 0.2, 0.2), (1, 1, 1)).moved(by=(0.1, 0, 0))))
    # The centre of its side that is in the middle of the large box.
    close(found.depth, 0.5)
    close(found.tau, 0.2)


def test_a_needle_through_a_sheet_is_deep_between_its_nodes():
    sheet = meshes.box((1, 1, 0.02), (5, 5, 1))
    needle = meshes.box((0.05, 0.05, 1.0), (1, 1, 1)).moved(by=(0.03, 0.03, 0.2))
    found = overlap(*two(sheet, needle))
    close(found.deepest_node, 0)
    close(found.tau, 0.02)
    # The sheet's skin in the middle of the needle; the needle's edges in the sheet are 0.01 deep.
    close(found.depth, 0.025)


def test_thickness_is_that_of_the_thin_direction():
    def body(mesh):
        points, cells, _ = joined(mesh)
        return Body(0, "a", cells, points, 3)

    sheet = body(meshes.box((1, 1, 0.02), (5, 5, 1)))
    close(sheet.tau, 0.02)
    close(body(meshes.box((1, 0.2, 0.2), (5, 2, 2))).tau, 0.2)
    # A regular tetrahedron has no side that faces another: twice the radius of the ball around its centre.
    corners = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]
    close(body(meshes.Mesh(corners, [(0, 1, 2, 3)])).tau, 2 / math.sqrt(3))
    # A plate with a thin flap.
    flap = body(meshes.grid((4, 2, 1), lambda u, v, w: (u, v, w * (0.4 if u <= 0.5 else 0.04))))
    vertices = flap.surface.place(joined(meshes.grid((4, 2, 1), lambda u, v, w: (u, v, w * (0.4 if u <= 0.5 else 0.04))))[0])
    assert flap.tau[vertices[:, 0] < 0.3].min() > 0.2
    assert flap.tau[(abs(vertices[:, 0] - 0.875) < 0.05) & (abs(vertices[:, 1] - 0.5) < 0.4)].max() < 0.05


def hook(gap, count=40):
    """A strip bent to a ring that does not quite close: its ends lie over each other, `gap` apart."""

    def place(u, v, w):
        angle = 2 * math.pi * 1.2 * w
        radius = 1.0 + (u - 0.5) * 0.2 + (0.2 + gap) * w / (1 / 1.2)
        return (radius * math.cos(angle), radius * math.sin(angle), 0.3 * v)

    return meshes.grid((1, 1, count), place)


def test_a_body_in_itself_is_found_and_neighbours_are_not():
    for mesh, least, most in (
        (hook(0.1), None, None),
        (hook(-0.05), 0.04, 0.056),
        (meshes.box((1, 0.2, 0.2), (8, 2, 2)), None, None),
    ):
        points, cells, _ = joined(mesh)
        found = self_overlap(Placed(Body(0, "a", cells, points, 3), points), points)
        if least is None:
            assert found is None, found
        else:
            assert least < found.depth < most, found.depth


def triangles(outline):
    """A fan of triangles around the mean of a convex outline."""
    points = [*outline, tuple(np.mean(outline, axis=0))]
    mesh = meshes.Mesh.__new__(meshes.Mesh)
    mesh.points = np.array([(x, y, 0.0) for x, y in points])
    mesh.cells = [(k, (k + 1) % len(outline), len(outline)) for k in range(len(outline))]
    return mesh


def test_the_plane_has_the_same_measures():
    square = triangles([(0, 0), (1, 0), (1, 1), (0, 1)])
    small = triangles([(0.9, 0.3), (1.5, 0.3), (1.5, 0.7), (0.9, 0.7)])
    a, b = two(square, small, 2)
    found = overlap(a, b)
    close(found.depth, 0.1)
    close(found.area, (0.4, 0, 0))
    assert abs(volume(a, b, found) - 0.04) < 1e-6
    assert overlap(*two(square, triangles([(1.1, 0.3), (1.5, 0.3), (1.5, 0.7)]), 2)) is None
    # A corner with no node of the other inside it.
    spike = triangles([(0.5, 0.95), (1.0, 1.6), (0.0, 1.6)])
    close(overlap(*two(square, spike, 2)).depth, 0.05)


def passing(count, back=False):
    """Frames of two crossed bars, one moved through the other, or there and back again."""
    first, second = roofs(-0.05)
    points, cells, owners = joined(first, second)
    moved = np.arange(len(points)) >= len(first.points)
    for k in range(count + 1):
        s = k / count
        shift = 0.11 * (1 - abs(2 * s - 1)) if back else 0.9 * s
        yield Frame(s, points - shift * np.outer(moved, (0, 0, 1))), cells, owners


def looked(frames, summary):
    frames = list(frames)
    first, cells, owners = frames[0]
    looks = Judge(first.points, cells, owners, ["a", "b"])
    for frame, _, _ in frames:
        looks.look(frame)
    return looks.verdict("bars", summary)


def test_verdicts():
    good = {"status": "done", "contact": {"unverified": 0}, "warnings": [], "penetration_max": 0.01}
    assert looked(passing(20, back=True), good).verdict == "held"
    assert looked(passing(20, back=True), good | {"status": "failed", "error": "E0601: a"}).verdict == "ended"
    through = looked(passing(20), good)
    assert through.verdict == "silent" and len(through.changed) == 2, through.line()
    assert looked(passing(20), good | {"contact": {"unverified": 3}}).verdict == "told"
    assert (
        looked(passing(20), good | {"warnings": ["W0406: 1 time(s) a node went into a body without being in contact"]}).verdict
        == "told"
    )
    assert looked(passing(20), good | {"warnings": ["W0611: hourglass energy"]}).verdict == "silent"
    # Through between two frames: the centre lines alone know.
    jump = looked(passing(1), good)
    assert jump.verdict == "silent" and jump.ratio == 0 and "centre lines" in jump.changed[0], jump.line()


def test_linked_rings_that_move_have_not_changed_sides():
    def path(t):
        return np.array([math.cos(2 * math.pi * t), math.sin(2 * math.pi * t), 0.0])

    ring = meshes.sweep(path, 0.2, (1, 1, 16), is_ring=True)
    other = ring.moved(meshes.rotation((1, 0, 0), math.pi / 2), (1.0, 0, 0))
    points, cells, owners = joined(ring, other)
    moved = np.arange(len(points)) >= len(ring.points)
    frames = [(Frame(k, points + 0.03 * k * np.outer(moved, (1, 0.2, 0))), cells, owners) for k in range(20)]
    result = looked(frames, {"status": "done"})
    assert result.verdict == "held" and result.ratio == 0, result.line()


def grid_of(points, cells):
    """vtk's grid of cells."""
    grid, at = vtkUnstructuredGrid(), vtkPoints()
    at.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    grid.SetPoints(at)
    for kind, _, nodes in cells:
        grid.InsertNextCell(kind, len(nodes), nodes)
    return grid


def write(folder, frames, summary):
    """A result folder as a run leaves it, as far as the judge reads it."""
    lines = []
    for number, (frame, cells, owners) in enumerate(frames):
        grid = grid_of(frame.points, cells)
        for data, name, values in (
            (grid.GetCellData(), "part", np.array(owners)),
            (grid.GetFieldData(), "TimeValue", np.array([frame.time])),
        ):
            array = numpy_to_vtk(values, deep=True)
            array.SetName(name)
            data.AddArray(array)
        writer = vtkXMLUnstructuredGridWriter()
        writer.SetFileName(str(folder / f"frame-{number}.vtu"))
        writer.SetInputData(grid)
        writer.Write()
        lines.append(f'<DataSet timestep="{frame.time}" part="0" file="frame-{number}.vtu"/>')
    (folder / "fields.pvd").write_text("<VTKFile><Collection>" + "".join(lines) + "</Collection></VTKFile>")
    (folder / "summary.json").write_text(json.dumps(summary))


def test_a_result_folder_is_read():
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        assert judge(folder).verdict == "unread"
        write(folder, passing(10), {"status": "done", "parts": ["a", "b"], "contact": {"unverified": 0}})
        result = judge(folder)
        assert result.verdict == "silent" and result.where == "a and b", result.line()


def test_pairs_of_boxes_are_those_of_all_with_all():
    random = np.random.Generator(np.random.PCG64(3))
    for sizes in (0.01, 0.3):
        low_a, low_b = random.random((300, 3)), random.random((200, 3))
        high_a, high_b = low_a + sizes * random.random((300, 3)) ** 4, low_b + sizes * random.random((200, 3))
        meets = ((low_a[:, None] <= high_b[None]) & (high_a[:, None] >= low_b[None])).all(-1)
        assert sorted(zip(*(x.tolist() for x in near_pairs(low_a, high_a, low_b, high_b)))) == sorted(
            zip(*(x.tolist() for x in np.nonzero(meets)))
        )


def test_distances_and_windings_agree_with_a_ball():
    ball = meshes.Mesh(meshes.pebble(1.0, 4).points, meshes.pebble(1.0, 4).cells)
    points, cells, _ = joined(ball)
    placed = Placed(Body(0, "a", cells, points, 3), points)
    places = np.random.Generator(np.random.PCG64(5)).normal(size=(50, 3))
    close(distances(places, placed.corners).min(1), placed.nearest(places)[0])
    inside = np.linalg.norm(places, axis=1) < 0.7
    close(winding(places[inside], placed.corners), 1.0)
    close(winding(places[np.linalg.norm(places, axis=1) > 1.9], placed.corners), 0.0)


def test_three_ways_to_tell_what_is_inside_agree():
    random = np.random.Generator(np.random.PCG64(7))
    for kind in ("hex", "tet", "wedge", "mixed"):
        mesh = meshes.pebble(1.0, 3, kind, scenes.Dice(4))
        mesh = meshes.Mesh(mesh.points + 0.05 * random.normal(size=mesh.points.shape), mesh.cells)
        points, cells, _ = joined(mesh)
        body = Body(0, "a", cells, points, 3)
        places = random.uniform(-1.2, 1.2, size=(400, 3))
        by_winding = winding(places, Placed(body, points).corners) > 0.5
        by_simplex = np.isin(np.arange(400), within_elements(places, simplices(body.cells, points)[0])[0])
        assert (by_winding == by_simplex).all(), kind
        locator = vtkStaticCellLocator()
        locator.SetDataSet(grid_of(points, cells))
        locator.BuildLocator()
        by_vtk = np.array([locator.FindCell(place) >= 0 for place in places.tolist()])
        # Faces of hexahedra are curved for vtk, and four triangles here.
        assert (by_winding != by_vtk).mean() < (0.0 if kind == "tet" else 0.02) + 1e-12, (kind, (by_winding != by_vtk).mean())


def faces(mesh):
    """The outside of a mesh of hexahedra as triangles, outward."""
    points, cells, _ = joined(mesh)
    body = Body(0, "a", cells, points, 3)
    return Placed(body, points).corners


def test_bodies_are_as_deep_in_obstacles_as_they_were_put():
    box = meshes.box((1, 1, 1), (2, 2, 2))
    points, cells, owners = joined(box)
    (body,) = bodies_of(points, cells, owners, ["a"], 3)
    placed = Placed(body, points)
    low = points.min(0)
    # A plane that cuts off 0.1, a block whose corner is inside by 0.2, a pin that comes in between the nodes, a room that is too small.
    x, y, z = low + [0, 0, 0.1]
    plane = Obstacle(np.array([[(x, y, z), (x + 9, y, z), (x, y + 9, z)]]))
    close(in_obstacle(placed, plane).depth, 0.1)
    block = Obstacle(faces(meshes.box((2, 2, 2), (1, 1, 1)).moved(by=low - 0.8)))
    found = in_obstacle(placed, block)
    assert block.is_closed and abs(found.depth - 0.2) < 1e-9, found.depth
    pin = Obstacle(faces(meshes.box((0.05, 0.05, 0.7), (1, 1, 1)).moved(by=(0.21, 0.22, low[2] - 0.2))))
    found = in_obstacle(placed, pin)
    assert abs(found.depth - 0.15) < 1e-9, (found.depth, found.place)
    room = Obstacle(faces(meshes.box((0.9, 2, 2), (1, 1, 1)))[:, ::-1])
    assert room.volume() < 0
    close(in_obstacle(placed, room).depth, 0.05)
    # A tube without ends is a cylinder without ends; hollow if its facets look inward.
    angles = np.linspace(0, 2 * math.pi, 721)
    ring = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1) * 0.3
    up = np.array([0, 0, 5.0])
    tube = [(a, b, b + up) for a, b in zip(ring, ring[1:])] + [(a, b + up, a + up) for a, b in zip(ring, ring[1:])]
    cylinder = Obstacle(np.array(tube) - up / 2)
    assert cylinder.axis is not None and not cylinder.is_hollow
    assert np.allclose(cylinder.depths(np.array([[0.1, 0, 40.0], [0.5, 0, 0]])), [0.2, -0.2], atol=1e-5)
    assert Obstacle(np.array(tube)[:, ::-1]).is_hollow
    # In the plane the solid is on the right of the line.
    line = Obstacle(np.array([[(0, 0, 0), (9.0, 0, 0)]]))
    close(line.depths(np.array([[5.0, -0.25, 0], [5.0, 0.25, 0]])), [0.25, -0.25])
    corners = np.array([(0, 0, 0), (0, 1, 0), (1, 1, 0), (1.0, 0, 0)])
    square = Obstacle(np.stack([corners, np.roll(corners, -1, axis=0)], axis=1))
    close(square.depths(np.array([[0.5, 0.9, 0], [1.5, 0.5, 0]])), [0.1, 0.0])
    around = Obstacle(np.stack([corners[::-1], np.roll(corners[::-1], -1, axis=0)], axis=1))
    close(around.depths(np.array([[0.5, 0.9, 0], [1.5, 0.5, 0]])), [0.0, 0.5])


def test_scenes_are_the_same_again_and_do_not_overlap_at_the_start():
    for plane in (False, True):
        for number in range(len(scenes.families(plane))):
            made = scenes.scene(number, plane)
            assert made.files() == scenes.scene(number, plane).files()
            parts = [part.mesh for part in made.parts if part.mesh is not None]
            if len(parts) > 1:
                points, cells, owners = joined(*parts)
                looks = Judge(points, cells, owners, [part.name for part in made.parts])
                looks.look(Frame(0.0, points))
                assert looks.deepest.ratio == 0, f"{made.name()}: {looks.where} {looks.deepest}"


def test_middles_of_sheets_that_cross_or_pass_are_seen():
    def sheet(place):
        """A grid of 4 x 4 elements as results have them: nodes of the lower face, then of the upper one."""
        grid = [(u, v) for u in np.linspace(-1, 1, 5) for v in np.linspace(-1, 1, 5)]
        points = np.array([place(u, v, side) for side in (-0.01, 0.01) for u, v in grid])
        rings = [(5 * i + j, 5 * i + j + 5, 5 * i + j + 6, 5 * i + j + 1) for i in range(4) for j in range(4)]
        return points, [ring + tuple(25 + k for k in ring) for ring in rings]

    flat, cells = sheet(lambda u, v, w: (u, v, w))
    found = sheets.Sheets(cells + [tuple(50 + k for k in cell) for cell in cells], [0] * 16 + [1] * 16)

    def places(other, by=(0, 0, 0)):
        return found.place(np.concatenate([flat, sheet(other)[0] + np.asarray(by)]))

    def upright(u, v, w):
        return (0.3 + w, 0.5 * u, 0.5 * v)

    def small(u, v, w):
        return (0.5 * u + 0.01, 0.5 * v + 0.02, w)

    assert found.crossed(*places(upright)) == {(0, 1)}
    assert found.crossed(*places(upright, (0, 0, 0.45))) == {(0, 1)}
    for by in ((0, 0, 0.55), (1, 0, 0), (0, 1.6, 0)):
        assert not found.crossed(*places(upright, by)), by
    above, below = (places(small, (0, 0, z)) for z in (0.1, -0.1))
    assert not found.crossed(*above) and not found.crossed(*below)
    assert found.passed(above, below) == {(0, 1)}
    assert not found.passed(above, places(small, (0, 0, 0.05)))
    beside = [places(small, (1.6, 0, z)) for z in (0.1, -0.1)]
    assert not found.passed(*beside)


def main():
    for name, test in sorted(globals().items()):
        if name.startswith("test_"):
            test()
            print(f"{name[5:].replace('_', ' ')}: good")
    return 0


if __name__ == "__main__":
    sys.exit(main())
