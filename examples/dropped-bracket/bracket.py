"""Makes bracket.step and bracket.msh with Gmsh (pip install gmsh): python3 bracket.py

An angle of 60 x 60 x 40 mm, 8 mm thick, rounded inside with 8 mm, with a hole of 12 mm in each leg. The mesh has
tetrahedra of second order.
"""

import sys
from pathlib import Path

import gmsh

folder = Path(__file__).resolve().parent
size = float(sys.argv[1]) if len(sys.argv) > 1 else 10.0

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
gmsh.model.add("bracket")
occ = gmsh.model.occ
foot = occ.addBox(0, 0, 0, 60, 40, 8)
leg = occ.addBox(0, 0, 0, 8, 40, 60)
# What rounds the inner corner: a square without a quarter of a circle.
square = occ.addBox(8, 0, 8, 8, 40, 8)
quarter = occ.addCylinder(16, 0, 16, 0, 40, 0, 8)
(corner,), _ = occ.cut([(3, square)], [(3, quarter)])
(body,), _ = occ.fuse([(3, foot)], [(3, leg), corner])
holes = [(3, occ.addCylinder(40, 20, -1, 0, 0, 10, 6)), (3, occ.addCylinder(-1, 20, 40, 10, 0, 0, 6))]
(body,), _ = occ.cut([body], holes)
occ.synchronize()
gmsh.write(str(folder / "bracket.step"))

gmsh.model.addPhysicalGroup(3, [body[1]], name="bracket")
# Finer where it lands.
near = min((dim_tag for dim_tag in gmsh.model.getEntities(0)), key=lambda it: sum(x * x for x in gmsh.model.getValue(0, it[1], [])))
field = gmsh.model.mesh.field
field.add("Distance", 1)
field.setNumbers(1, "PointsList", [near[1]])
field.add("Threshold", 2)
for key, value in {"InField": 1, "DistMin": 4, "DistMax": 30, "SizeMin": 0.3 * size, "SizeMax": size}.items():
    field.setNumber(2, key, value)
field.setAsBackgroundMesh(2)
gmsh.option.setNumber("Mesh.MeshSizeMin", 0.3 * size)
gmsh.option.setNumber("Mesh.MeshSizeMax", size)
gmsh.option.setNumber("Mesh.MeshSizeFromCurvature", 7)
gmsh.option.setNumber("Mesh.ElementOrder", 2)
gmsh.option.setNumber("Mesh.SecondOrderLinear", 0)
gmsh.option.setNumber("Mesh.MshFileVersion", 4.1)
gmsh.option.setNumber("Mesh.Optimize", 1)
gmsh.option.setNumber("Mesh.HighOrderOptimize", 1)
gmsh.model.mesh.generate(3)
gmsh.write(str(folder / "bracket.msh"))
gmsh.finalize()
