"""Makes the mesh files of the tests and of examples/tube-plate-gmsh with the real Gmsh (PyPI package gmsh, 4.15).

    python make.py

Each mesh is written as .msh 2.2 and 4.1, text and binary; big-endian twins are made here byte by byte and read back with Gmsh.
Gmsh is an outside tool under its own licence; only its output stands here.
"""

import struct
from math import copysign, floor, pi
from pathlib import Path

import gmsh

HERE = Path(__file__).resolve().parent
EXAMPLE = HERE.parents[3] / "examples" / "tube-plate-gmsh"
FORMATS = {"v2-text": (2.2, 0), "v2-binary": (2.2, 1), "v4-text": (4.1, 0), "v4-binary": (4.1, 1)}


def write(path, kind, parametric=0):
    version, binary = FORMATS[kind]
    gmsh.option.setNumber("Mesh.MshFileVersion", version)
    gmsh.option.setNumber("Mesh.Binary", binary)
    gmsh.option.setNumber("Mesh.SaveParametric", parametric)
    gmsh.write(str(path))


def write_all(name, big_endian=False):
    for kind in FORMATS:
        path = HERE / f"{name}-{kind}.msh"
        write(path, kind)
        if big_endian and "binary" in kind:
            twin = HERE / f"{name}-{kind}-big.msh"
            twin.write_bytes(swapped(path.read_bytes()))
            check_twin(path, twin)


# ---- tube and plate ----------------------------------------------------------------------------------------------------------


def between(a, b, i, n):
    """Entry i of 0..=n equal steps from a to b, rounded as the built-in shapes do."""
    return a if i == 0 else b if i == n else (a * (n - i) + b * i) / n


def cos_sin(quarters):
    """Cosine and sine of a number of quarter turns, rounded as the built-in shapes do: exact on the axes."""
    whole = int(copysign(floor(abs(quarters) + 0.5), quarters))  # halves away from zero
    rest = quarters - whole
    r = 0.0 if abs(rest) < 1e-12 else rest * (pi / 2)
    r2 = r * r
    c = s = 1.0
    for k in range(17, 0, -2):
        c = 1.0 - r2 / (k * (k + 1)) * c
    for k in range(16, 1, -2):
        s = 1.0 - r2 / (k * (k + 1)) * s
    s *= r
    return [(c, s), (0.0 - s, c), (-c, 0.0 - s), (s, -c)][whole % 4]


def tube_and_plate():
    """The bodies of examples/tube-plate: half a tube of 1 x 40 quadrilaterals and a plate of 120 x 3."""
    gmsh.model.add("bodies")
    geo, inner, outer, centre = gmsh.model.geo, 0.094, 0.1, (0.0, 0.1)
    middle = geo.addPoint(*centre, 0)
    corners = {}
    for r in (inner, outer):
        for k in range(3):  # at -90, 0 and 90 degrees: Gmsh's arcs are shorter than half a turn
            corners[r, k] = geo.addPoint(r if k == 1 else 0, centre[1] + r * (k - 1), 0)
    arcs = {(r, k): geo.addCircleArc(corners[r, k], middle, corners[r, k + 1]) for r in (inner, outer) for k in range(2)}
    walls = [geo.addLine(corners[inner, k], corners[outer, k]) for k in range(3)]
    tube = []
    for k in range(2):
        loop = geo.addCurveLoop([walls[k], arcs[outer, k], -walls[k + 1], -arcs[inner, k]])
        tube.append(geo.addPlaneSurface([loop]))
        order = [corners[inner, k], corners[outer, k], corners[outer, k + 1], corners[inner, k + 1]]
        geo.mesh.setTransfiniteSurface(tube[-1], "Left", order)
    for arc in arcs.values():
        geo.mesh.setTransfiniteCurve(arc, 21)
    for wall in walls:
        geo.mesh.setTransfiniteCurve(wall, 2)
    box = [geo.addPoint(x, y, 0) for x, y in ((0, -0.003), (0.6, -0.003), (0.6, 0), (0, 0))]
    edges = [geo.addLine(box[k], box[(k + 1) % 4]) for k in range(4)]
    plate = geo.addPlaneSurface([geo.addCurveLoop(edges)])
    geo.mesh.setTransfiniteSurface(plate, "Left", box)
    for k, edge in enumerate(edges):
        geo.mesh.setTransfiniteCurve(edge, 121 if k % 2 == 0 else 4)
    for surface in [*tube, plate]:
        geo.mesh.setRecombine(2, surface)
    geo.synchronize()
    gmsh.model.addPhysicalGroup(2, tube, 1, "tube")
    gmsh.model.addPhysicalGroup(2, [plate], 2, "plate")
    gmsh.model.addPhysicalGroup(1, [arcs[outer, 0], arcs[outer, 1]], 3, "tube_outer")
    gmsh.model.addPhysicalGroup(1, [edges[2]], 4, "plate_top")
    gmsh.model.mesh.generate(2)

    # Gmsh places the nodes of arcs by numerical integration; put each where the built-in shape has it.
    moved = {"tube": 0.0, "plate": 0.0}
    for body, group in (("tube", 1), ("plate", 2)):
        tags, coordinates = gmsh.model.mesh.getNodesForPhysicalGroup(2, group)
        for n, tag in enumerate(tags):
            x, y = coordinates[3 * n : 3 * n + 2]
            if body == "tube":
                _, best = min(((x - p[0]) ** 2 + (y - p[1]) ** 2, p) for p in tube_nodes(inner, outer, centre))
            else:
                best = (between(0.0, 0.6, round(x / 0.005), 120), between(-0.003, 0.0, round((y + 0.003) / 0.001), 3))
            distance = ((x - best[0]) ** 2 + (y - best[1]) ** 2) ** 0.5
            assert distance < 1e-8, (body, tag, distance)
            moved[body] = max(moved[body], distance)
            gmsh.model.mesh.setNode(int(tag), [*best, 0], [])
    print("nodes moved by at most, in m:", {body: float(distance) for body, distance in moved.items()})
    write_all("bodies")
    # Binary, because Gmsh writes 16 digits in text, one too few to give every number back.
    (HERE / "bodies-v4-binary.msh").replace(EXAMPLE / "bodies.msh")


def tube_nodes(inner, outer, centre):
    for j in range(41):
        c, s = cos_sin(between(-1.0, 1.0, j, 40))
        for r in (inner, outer):
            yield (centre[0] + r * c, centre[1] + r * s)


# ---- a plate with a hole: triangles and quadrilaterals, groups of every dimension -------------------------------------------------


def plate_with_hole():
    """A strip of 2 x 2 quadrilaterals joined to a plate of triangles with a hole, in millimetres."""
    gmsh.model.add("plate")
    geo = gmsh.model.geo
    p = [geo.addPoint(x, y, 0, 15) for x, y in ((0, 0), (20, 0), (60, 0), (60, 40), (20, 40), (0, 40))]
    hole = [geo.addPoint(40 + x, 20 + y, 0, 10) for x, y in ((0, 0), (10, 0), (0, 10), (-10, 0), (0, -10))]
    bottom, right, top = geo.addLine(p[1], p[2]), geo.addLine(p[2], p[3]), geo.addLine(p[3], p[4])
    middle = geo.addLine(p[4], p[1])
    strip = [geo.addLine(p[0], p[1]), -middle, geo.addLine(p[4], p[5]), geo.addLine(p[5], p[0])]
    circle = [geo.addCircleArc(hole[1 + k], hole[0], hole[1 + (k + 1) % 4]) for k in range(4)]
    quads = geo.addPlaneSurface([geo.addCurveLoop(strip)])
    triangles = geo.addPlaneSurface([geo.addCurveLoop([bottom, right, top, middle]), geo.addCurveLoop(circle)])
    for curve in (*strip, bottom, right, top):
        geo.mesh.setTransfiniteCurve(abs(curve), 3)
    geo.mesh.setTransfiniteSurface(quads)
    geo.mesh.setRecombine(2, quads)
    geo.synchronize()
    gmsh.model.mesh.setPeriodic(1, [top], [bottom], [1, 0, 0, 0, 0, 1, 0, 40, 0, 0, 1, 0, 0, 0, 0, 1])
    gmsh.model.addPhysicalGroup(0, [p[0], p[5]], 1, "left corners")
    gmsh.model.addPhysicalGroup(1, circle, 2, "hole")
    gmsh.model.addPhysicalGroup(1, [right], 7)
    gmsh.model.addPhysicalGroup(2, [quads, triangles], 3, "plate")
    gmsh.model.addPhysicalGroup(2, [quads], 4, "strip")
    gmsh.model.mesh.generate(2)
    write_all("plate", big_endian=True)
    for kind in FORMATS:
        write(HERE / f"plate-parametric-{kind}.msh", kind, parametric=1)
    gmsh.model.mesh.setOrder(2)
    write(HERE / "plate-order-2.msh", "v4-text")
    gmsh.model.mesh.setOrder(1)
    gmsh.model.mesh.partition(2)
    for kind in FORMATS:
        write(HERE / f"plate-partitioned-{kind}.msh", kind)
    gmsh.model.mesh.unpartition()
    gmsh.model.removePhysicalGroups()
    for name in ("left corners", "hole", "plate", "strip"):
        gmsh.model.removePhysicalName(name)
    for kind in FORMATS:
        write(HERE / f"plate-without-groups-{kind}.msh", kind)


def cube():
    gmsh.model.add("cube")
    gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
    gmsh.model.occ.synchronize()
    gmsh.option.setNumber("Mesh.MeshSizeMin", 2)
    gmsh.model.addPhysicalGroup(3, [1], 1, "cube")
    gmsh.model.addPhysicalGroup(2, [1], 2, "face")
    gmsh.model.mesh.generate(3)
    write(HERE / "cube.msh", "v4-binary")


# ---- big-endian twins --------------------------------------------------------------------------------------------------------


class Swapper:
    """Walks through a little-endian file and writes it with the bytes of each number the other way round."""

    def __init__(self, data):
        self.data, self.at, self.out = data, 0, bytearray()

    def line(self):
        end = self.data.index(b"\n", self.at) + 1
        text, self.at = self.data[self.at : end], end
        self.out += text
        return text.decode().strip()

    def take(self, code, count=1):
        width = struct.calcsize(code)
        values = struct.unpack_from(f"<{count}{code}", self.data, self.at)
        self.at += width * count
        self.out += struct.pack(f">{count}{code}", *values)
        return values if count != 1 else values[0]


def swapped(data):
    s = Swapper(data)
    version = 2
    while s.at < len(data):
        section = s.line()
        if section == "$MeshFormat":
            version = int(s.line()[0])
            s.take("i")
        elif section == "$PhysicalNames":
            for _ in range(int(s.line())):
                s.line()
        elif section == "$Nodes":
            nodes_2(s) if version == 2 else nodes_4(s)
        elif section == "$Elements":
            elements_2(s) if version == 2 else elements_4(s)
        elif section == "$Entities":
            entities(s)
        elif section == "$Periodic":
            periodic_2(s) if version == 2 else periodic_4(s)
        else:
            assert section == "" or section.startswith("$End"), section
    return bytes(s.out)


def nodes_2(s):
    for _ in range(int(s.line())):
        s.take("i")
        s.take("d", 3)


def elements_2(s):
    left = int(s.line())
    while left:
        kind, run, tags = s.take("i", 3)
        s.take("i", run * (1 + tags + nodes_of(kind)))
        left -= run


def nodes_of(kind):
    return gmsh.model.mesh.getElementProperties(kind)[3]


def entities(s):
    for dimension, count in enumerate(s.take("Q", 4)):
        for _ in range(count):
            s.take("i")
            s.take("d", 6 if dimension else 3)
            for _ in range(2 if dimension else 1):
                s.take("i", s.take("Q"))


def nodes_4(s):
    blocks, _, _, _ = s.take("Q", 4)
    for _ in range(blocks):
        dimension, _, parametric = s.take("i", 3)
        count = s.take("Q")
        s.take("Q", count)
        s.take("d", count * (3 + dimension * parametric))


def elements_4(s):
    blocks, _, _, _ = s.take("Q", 4)
    for _ in range(blocks):
        _, _, kind = s.take("i", 3)
        s.take("Q", s.take("Q") * (1 + nodes_of(kind)))


def periodic_2(s):
    for _ in range(int(s.line())):
        s.line()  # dimension and tags
        affine = s.line()
        count = int(s.line()) if affine.startswith("Affine") else int(affine)
        for _ in range(count):
            s.line()


def periodic_4(s):
    for _ in range(s.take("Q")):
        s.take("i", 3)
        s.take("d", s.take("Q"))
        s.take("Q", 2 * s.take("Q"))


def check_twin(path, twin):
    """Gmsh reads the same from both files."""
    read = []
    current = gmsh.model.getCurrent()
    for file in (path, twin):
        gmsh.model.add("twin")
        gmsh.merge(str(file))
        tags, x, _ = gmsh.model.mesh.getNodes()
        kinds, elements, nodes = gmsh.model.mesh.getElements()
        read.append([list(tags), list(x), list(kinds), [list(e) for e in elements], [list(n) for n in nodes]])
        gmsh.model.remove()
        gmsh.model.setCurrent(current)
    assert read[0] == read[1] and len(read[0][0]) > 20, twin


gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
tube_and_plate()
plate_with_hole()
cube()
gmsh.finalize()
