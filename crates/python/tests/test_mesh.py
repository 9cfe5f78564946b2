"""Meshes of arrays and of other packages."""

from __future__ import annotations

import numpy as np
import pytest
from conftest import STEEL
from test_model import grid

import embate


def body(mesh: object, **keys: object) -> embate.Model:
    model = embate.Model(name="body").run(end="3 us").material("steel", **STEEL)
    return model.part(name="block", mesh=mesh, material="steel", velocity=(3.0, 0.0), **keys)


def test_arrays_in_all_their_forms_are_the_same_mesh() -> None:
    points, quads = grid(5, 3, (0.02, 0.01))
    read_only = points.copy()
    read_only.setflags(write=False)
    forms = [
        (read_only, quads),
        (points, quads),
        (points.tolist(), quads.tolist()),
        (np.asfortranarray(points), np.asfortranarray(quads.astype(np.uint16))),
        (np.column_stack([points, np.zeros(len(points))]), {"quad": quads[:, ::-1]}),
        {"points": points, "cells": {"quads": quads}},
        {"points": points, "cells": {"quad": quads}, "groups": {"all": {"quad": np.ones(len(quads), bool)}}},
        embate.Mesh(points, {"quad": quads}),
    ]
    simulations = [body(form).simulation(threads=1) for form in forms]
    for simulation, form in zip(simulations, forms):
        numbers = simulation.node_numbers(form)
        assert sorted(numbers) == list(range(24))
        np.testing.assert_array_equal(simulation.state.position[numbers], points)
    assert simulations[0].state.position.shape == (24, 2)
    with pytest.raises(ValueError, match="mesh is none"):
        simulations[0].node_numbers((points, quads))
    simulations[0].run()
    np.testing.assert_allclose(simulations[0].state.velocity, np.broadcast_to([3.0, 0.0], (24, 2)), atol=1e-6)


def test_groups_are_parts_and_sides() -> None:
    points, quads = grid(6, 2, (0.06, 0.02))
    left = points[quads].mean(axis=1)[:, 0] < 0.03
    bottom = np.column_stack([np.arange(6), np.arange(1, 7)])
    mesh = embate.Mesh(points, {"quad": quads, "line": bottom}, {"left": {"quad": left}, "right": {"quad": ~left}, "bottom": {"line": np.arange(6)}})
    model = embate.Model(name="two").run(end="2 us").material("steel", **STEEL)
    model.part(name="a", mesh=mesh, group="left", material="steel").part(name="b", mesh=mesh, group="right", material="steel")
    model.constraint(on="bottom", velocity={"x": 0, "y": 0})
    simulation = model.simulation()
    assert (simulation.cell_part == "a").sum() == left.sum()
    np.testing.assert_array_equal(simulation.state.position[simulation.node_numbers(mesh)], points)
    unused = embate.Mesh(np.vstack([[[9.0, 9.0]], points]), {"quad": quads + 1}, {"left": {"quad": left}, "right": {"quad": ~left}})
    only = embate.Model(name="one").run(end="2 us").material("steel", **STEEL).part(name="a", mesh=unused, group="left", material="steel").simulation()
    numbers = only.node_numbers(unused)
    np.testing.assert_array_equal(only.state.position[numbers[numbers >= 0]], unused.points[numbers >= 0, :2])
    assert numbers[0] == -1 and (numbers >= 0).sum() == 12
    model.part(name="c", mesh=mesh, group="middle", material="steel")
    with pytest.raises(embate.ModelError, match="middle"):
        model.check()


def test_solids_of_every_kind() -> None:
    cube = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], float) * 0.01
    wedges = np.array([[0, 1, 2, 4, 5, 6], [0, 2, 3, 4, 6, 7]])
    tets = np.array([[0, 1, 3, 4], [1, 2, 3, 6], [1, 3, 4, 6], [1, 4, 5, 6], [3, 4, 6, 7]])
    edges = [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]
    pairs = sorted({tuple(sorted((cell[a], cell[b]))) for cell in tets.tolist() for a, b in edges})
    ten = np.array([[*cell, *(8 + pairs.index(tuple(sorted((cell[a], cell[b])))) for a, b in edges)] for cell in tets.tolist()])
    middles = np.array([0.5 * (cube[a] + cube[b]) for a, b in pairs])
    both = [embate.Model(name="cube").run(end="1 us").material("steel", **STEEL).part(name="cube", mesh=mesh, material="steel").simulation() for mesh in ((cube, {"tetra": tets}), (np.vstack([cube, middles]), {"tetra10": ten}))]
    assert both[0].state.position.shape == both[1].state.position.shape == (8 + len(pairs), 3)
    for cells in ({"hexahedron": np.arange(8)[None]}, {"wedge": wedges}, {"tetra": tets}):
        model = embate.Model(name="cube").run(end="1 us").material("steel", **STEEL)
        simulation = model.part(name="cube", mesh=(cube, cells), material="steel", velocity=(0, 0, 2)).simulation()
        assert simulation.dimension == 3
        simulation.run()
        np.testing.assert_allclose(simulation.state.velocity[:, 2], 2.0, atol=1e-9)


@pytest.mark.parametrize(
    ("points", "cells", "error", "told"),
    [
        (np.zeros(4), np.zeros((1, 4), int), ValueError, "points has the shape"),
        (np.array([[0, np.nan]]), np.zeros((1, 4), int), ValueError, r"points\[0\]"),
        (np.array([["a", "b"]]), np.zeros((1, 4), int), TypeError, "points has the dtype"),
        (np.zeros((4, 2)), np.zeros((1, 5), int), ValueError, "cells has the shape"),
        (np.zeros((4, 2)), {"quad": np.zeros((1, 3), int)}, ValueError, r"cells\['quad'\] has the shape"),
        (np.zeros((4, 2)), {"quad": np.zeros((1, 4))}, TypeError, r"cells\['quad'\] has the dtype"),
        (np.zeros((4, 2)), {"quad": np.array([[0, 1, 2, 4]])}, ValueError, "counted from 0 to 3"),
        (np.zeros((4, 2)), {"octagon": np.zeros((1, 8), int)}, ValueError, "octagon"),
    ],
)
def test_wrong_arrays_are_named(points: np.ndarray, cells: object, error: type, told: str) -> None:
    with pytest.raises(error, match=told):
        body((points, cells)).check()


def test_a_cell_without_an_area_is_told() -> None:
    with pytest.raises(embate.ModelError, match="area"):
        body((np.array([[0, 0], [1, 0], [2, 0], [3, 0.0]]), np.array([[0, 1, 2, 3]]))).check()


def test_a_mesh_of_meshio() -> None:
    meshio = pytest.importorskip("meshio")
    points, quads = grid(4, 2, (0.02, 0.01))
    plain = meshio.Mesh(points, [("quad", quads)])
    assert body(plain).simulation().state.position.shape == (15, 2)
    sets = meshio.Mesh(points, [("quad", quads), ("line", np.array([[0, 1], [1, 2]]))], cell_sets={"metal": [np.arange(8), None], "foot": [None, np.arange(2)]})
    model = body(sets, group="metal").constraint(on="foot", velocity={"x": 0, "y": 0})
    assert len(model.simulation().cell_part) == 8
    physical = meshio.Mesh(points, [("quad", quads)], cell_data={"gmsh:physical": [np.full(8, 7)]}, field_data={"metal": np.array([7, 2])})
    assert len(body(physical).simulation().cell_part) == 8


def test_a_mesh_of_gmsh() -> None:
    gmsh = pytest.importorskip("gmsh")
    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        disk = gmsh.model.occ.addDisk(0, 0, 0, 0.01, 0.01)
        gmsh.model.occ.synchronize()
        gmsh.model.addPhysicalGroup(2, [disk], name="disk")
        gmsh.model.addPhysicalGroup(1, [tag for _, tag in gmsh.model.getBoundary([(2, disk)])], name="rim")
        gmsh.option.setNumber("Mesh.MeshSizeMax", 0.003)
        gmsh.model.mesh.generate(2)
        simulation = body(gmsh, group="disk").simulation()
    finally:
        gmsh.finalize()
    assert len(simulation.cell_part) > 20
    assert np.hypot(*simulation.state.position.T).max() == pytest.approx(0.01)


def test_a_grid_of_pyvista_by_what_it_has() -> None:
    points, quads = grid(4, 2, (0.02, 0.01))

    class Grid:
        """What pyvista's UnstructuredGrid has."""

        def __init__(self) -> None:
            self.points = np.column_stack([points, np.zeros(len(points))])
            self.celltypes = np.full(len(quads), 9, np.uint8)
            self.offset = 4 * np.arange(len(quads) + 1)
            self.cell_connectivity = quads.ravel()
            self.cell_data = {"group": np.array(["a"] * 4 + ["b"] * 4)}

    model = embate.Model(name="grid").run(end="1 us").material("steel", **STEEL)
    grid_ = Grid()
    model.part(name="a", mesh=grid_, group="a", material="steel").part(name="b", mesh=grid_, group="b", material="steel")
    assert len(model.simulation().cell_part) == 8


def test_grids_go_to_pyvista_and_come_back() -> None:
    pyvista = pytest.importorskip("pyvista")
    points, quads = grid(4, 2, (0.02, 0.01))
    flat = np.column_stack([points, np.zeros(len(points))])
    surface = pyvista.PolyData(flat, np.column_stack([np.full(len(quads), 4), quads]).ravel())
    simulation = body(surface).simulation().run()
    shown = simulation.to_pyvista()
    assert shown.n_cells == 8 and set(simulation.state.fields) & set(shown.cell_data.keys()) >= {"stress", "von_mises"}
    np.testing.assert_array_equal(shown.cell_data["von_mises"], simulation.state.von_mises)
    np.testing.assert_array_equal(np.asarray(shown.point_data["velocity"])[:, :2], simulation.state.velocity)
    np.testing.assert_array_equal(np.asarray(shown.points)[:, :2], simulation.state.position)
    np.testing.assert_array_equal(body(shown).simulation().cells["quad"], simulation.cells["quad"])
    cube = pyvista.ImageData(dimensions=(3, 3, 3), spacing=(0.01, 0.01, 0.01)).cast_to_unstructured_grid()
    assert cube.n_cells == 8
    solid = embate.Model(name="c").run(end="1 us").material("steel", **STEEL).part(name="c", mesh=cube, material="steel", velocity=(0, 0, 1)).simulation()
    assert solid.dimension == 3 and solid.cells["hexahedron"].shape == (8, 8)
    assert solid.to_pyvista().volume == pytest.approx(8e-6)


def test_a_mesh_in_several_places_has_numbers_for_each_part_and_body() -> None:
    points, quads = grid(4, 2, (0.02, 0.01))
    mesh = embate.Mesh(points, {"quad": quads})
    model = embate.Model(name="places").run(end="1 us").material("steel", **STEEL)
    model.part(name="one", mesh=mesh, material="steel").part(name="other", mesh=mesh, material="steel", translation=(0.1, 0))
    model.part(name="row", mesh=mesh, material="steel", mirror={"normal": (1, 0)}, copies={"count": 2, "translation": (0, 0.5)})
    simulation = model.simulation()
    position = simulation.state.position
    np.testing.assert_array_equal(position[simulation.node_numbers(mesh, part="one")], points)
    np.testing.assert_allclose(position[simulation.node_numbers(mesh, part="other")], points + [0.1, 0], atol=1e-15)
    numbers = simulation.node_numbers(mesh, "row")
    assert numbers.shape == (2, len(points))
    np.testing.assert_allclose(position[numbers], [points * [-1, 1], points * [-1, 1] + [0, 0.5]], atol=1e-15)
    with pytest.raises(ValueError, match="in 3 places: name one of them, part='one' or part='other'"):
        simulation.node_numbers(mesh)
    with pytest.raises(ValueError, match="part 'two' does not have this mesh"):
        simulation.node_numbers(mesh, part="two")
