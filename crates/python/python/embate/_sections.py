# Made by the program from its own descriptions; the test of `embate_files` that holds it makes it again. Don't edit.
"""The sections of the model file as methods of :class:`embate.Model`, and the types of their keys.

A key that is a word of Python has an underscore behind it here: ``yield_`` is the key ``yield``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import TYPE_CHECKING, Any, Literal, TypedDict, Union

import numpy as np

from ._method import section

if TYPE_CHECKING:
    import numpy.typing as npt
    from typing_extensions import Required, Self

    from .mesh import Mesh

#: A number in SI units, or a text with its unit: ``0.003``, ``"3 mm"``.
Quantity = Union[float, str, "np.floating[Any]", "np.integer[Any]"]
#: A whole number.
Integer = Union[int, "np.integer[Any]"]
#: ``True`` or ``False``.
Flag = Union[bool, np.bool_]
#: A text; of files a path too.
Text = Union[str, "PathLike[str]"]
#: Several quantities: a list, a tuple, an array.
Quantities = Union[Sequence[Quantity], "npt.NDArray[Any]"]
#: Several whole numbers.
Integers = Union[Sequence[Integer], "npt.NDArray[Any]"]
#: Several points.
Points = Union[Sequence[Quantities], "npt.NDArray[Any]"]
#: One name or several.
Names = Union[str, Sequence[str]]
#: Meshes of arrays: see :class:`embate.Mesh`.
ArrayMesh = Union["Mesh", "tuple[Any, Any]", "Mapping[str, Any]", Any]


#: Dynamic relaxation: a damping of mass that adapts itself to the slowest motion brings everything
#: to rest, and the run ends when it is. For quasi-static states; what happens on the way means
#: nothing.
Relaxation = TypedDict(
    "Relaxation",
    {
        #: Kinetic energy over internal energy at which the state counts as at rest; it must stay
        #: below for half a period of the slowest motion.
        "tolerance": "Quantity",
        #: Time from which rest ends the run, or the stage: when loads that grow are complete.
        "from": "Quantity",
    },
    total=False,
)


class MassScaling(TypedDict, total=False):
    """Raises the density of elements whose stable step is too small, so that all allow one step at the
    start. The added mass resists motion; what gravity pulls at stays the true mass. Later steps may
    be smaller, as elements change their shape; `in_run` adds mass then, too."""

    time_step: Required[Quantity]
    """Step that every element shall allow, `safety` included."""
    limit: Quantity
    """Largest mass that may be added, as a fraction of the mass of the deformable parts; more at the
    start is a fault."""
    in_run: Flag
    """Whether elements whose step falls below `time_step` in the run get mass then, until they would
    need more than `limit`; after that the step falls. The mass comes with the velocity of its node."""


class Failure(TypedDict, total=False):
    """Limits at which an element fails. What counts is the mean over its points, as in the result
    files, after every step; any one limit is enough. A failed element pulls no more, contact sees
    the surfaces behind it at once, and its mass stays on its nodes."""

    plastic_strain: Quantity
    """Equivalent plastic strain at which an element fails."""
    principal_stress: Quantity
    """Largest principal stress (tension) at which an element fails."""
    damage: Quantity
    """Damage of the law at which an element fails; 1 is fracture as the law's parameters mean it."""
    time_step: Quantity
    """Stable step (without `safety`) below which an element fails, also where it is inverted."""


class Layers(TypedDict, total=False):
    """A layer of a shell. Two Gauss points in each are exact while it is elastic, one is as good where
    there are many layers. Strains are linear through the whole thickness, so a soft core between
    stiff faces shears too little."""

    material: str
    """Name of a `[material.NAME]` section."""
    thickness: Required[Quantity]
    """Thickness at the start; it follows the strain."""
    angle: Quantity
    """Angle from the projection of x on the shell (of z where the shell is normal to x) to the x of
    the layer, from which the law counts its own `angle`; counter-clockwise seen from above, in 3D
    alone."""
    points: Integer
    """Points through the layer, 1 to 10 (`lobatto`: 3 to 10)."""


class Section(TypedDict, total=False):
    """The section of shells (`shell2`, in 3D `shell4` and `shell3`): thickness, and layers of points
    through it. Two Gauss points are exact while the material is elastic; odd numbers of them are a
    little weak in plastic hinges, even ones a little stiff."""

    thickness: Quantity
    """Thickness at the start; it follows the strain."""
    thickness_field: Text
    """Name of a view of the part's mesh file that gives the thickness at the start: by node, by
    element or by node of each element, in the unit of the file; `nodal_thickness` of an Abaqus
    deck."""
    layers: Sequence[Layers]
    """Layers of different materials or directions, from the lower face (in 2D the right one) to the
    upper one."""
    points: Integer
    """Points through the thickness, 1 to 10 (`lobatto`: 3 to 10); 1 is a membrane without bending."""
    rule: Literal["gauss", "lobatto"]
    """Where points are: `gauss` inside, `lobatto` with one on each face."""
    thickness_growth: Quantities
    """How much the thickness (with it that of each layer) grows along x, y and z, by length."""
    thickness_point: Quantities
    """Where the thickness is just `thickness`."""
    reference: Literal["middle", "lower", "upper"]
    """Which surface of the shell its nodes are: its middle, its lower (in 2D right) or its upper
    (left) face."""
    offset: Quantity
    """How far the middle is from the surface of the nodes, to the upper face; half of the thickness at
    most."""
    failed_points: Quantity
    """Part of its points that have to fail until an element fails."""
    fold_angle: Quantity
    """Elements that meet at a smaller angle are a smooth shell there; at a larger one there is a fold."""


class Profile(TypedDict, total=False):
    """The cross-section of beams (`beam2`). Its axes are x along the beam, z across it towards `up`
    (the height), and y (the width), such that z is x × y. Stress along the beam is found in fibres
    by the law, and integrates area and moments of inertia exactly; torsion and transverse shear are
    elastic. Others touch its outline, and it is shown by it; a `given` section has none."""

    shape: Required[Literal["round", "tube", "rectangle", "box", "i", "given"]]
    """`round` (with `diameter`), `tube` (`diameter`, `thickness`), `rectangle` (`width`, `height`),
    `box` (`width`, `height`, `thickness`), `i` (`width`, `height`, `web`, `flange`) or `given`
    (`area`, `inertia_y`, `inertia_z`, `torsion`)."""
    diameter: Quantity
    """Outer diameter."""
    width: Quantity
    """Outer size along y."""
    height: Quantity
    """Outer size along z."""
    thickness: Quantity
    """Thickness of the wall."""
    web: Quantity
    """Thickness of the web, along y."""
    flange: Quantity
    """Thickness of each flange, along z."""
    area: Quantity
    """Area."""
    inertia_y: Quantity
    """Second moment of area about y, ∫ z² dA: of bending in the plane of the height."""
    inertia_z: Quantity
    """Second moment of area about z, ∫ y² dA."""
    torsion: Quantity
    """Torsion constant J."""
    up: Quantities
    """Direction of the height as far as it is across the beam."""
    points: Integer
    """Fibres along each direction of a rectangle, along each wall of a box and an I (1 to 10); around
    a circle (4 to 64)."""
    corners: Integer
    """Corners of the polygon in the circle (4 to 64) by which a round or a tube touches others and is
    shown. Edges of more than 16 are too flat to meet those of others: then only nodes do."""
    failed_points: Quantity
    """Part of its fibres that have to fail until an element fails."""


class RadialVelocity(TypedDict, total=False):
    """Initial velocity away from a point, or in 3D from an axis, as of a ring or a shell that a charge
    drives apart; it is added to `velocity` and `spin`. With `speed` all nodes are equally fast (one
    at the centre rests), with `rate` they are the faster the farther off they are: v = (speed / r +
    rate) r. What a rigid part can't do."""

    speed: Quantity
    """Speed, the same everywhere; negative: towards the centre."""
    rate: Quantity
    """Speed per distance."""
    centre: Quantities
    """The point; in 3D one of the axis, where there is one."""
    axis: Quantities
    """Direction of the axis, in 3D; any length but zero."""


class PerX(TypedDict, total=False):
    """Growth of a stress along x."""

    xx: Quantity
    """Of `xx`."""
    yy: Quantity
    """Of `yy`."""
    zz: Quantity
    """Of `zz`."""
    xy: Quantity
    """Of `xy`."""


class PerY(TypedDict, total=False):
    """Growth of a stress along y."""

    xx: Quantity
    """Of `xx`."""
    yy: Quantity
    """Of `yy`."""
    zz: Quantity
    """Of `zz`."""
    xy: Quantity
    """Of `xy`."""


class StressInitial(TypedDict, total=False):
    """Cauchy stress at the start, tension positive: uniform, or linear in x and y. Its elastic energy
    is in the energy balance from the start. The law must be one in rate form that can hold it;
    nothing makes sure that it is in equilibrium. Of bars `xx` is the stress along the bar, and
    there is no other."""

    xx: Quantity
    """Normal stress along x (radial in an axisymmetric part)."""
    yy: Quantity
    """Normal stress along y (axial)."""
    zz: Quantity
    """Normal stress across the plane (around the axis); not in plane stress."""
    xy: Quantity
    """Shear stress."""
    per_x: PerX
    """How much the stress grows along x."""
    per_y: PerY
    """How much the stress grows along y."""
    point: Quantities
    """Where the stress is just `xx`, `yy`, `zz`, `xy`."""


class Motion(TypedDict, total=False):
    """Prescribed velocities by component: quantities, or names of curves."""

    x: Quantity
    y: Quantity
    z: Quantity
    rotation: Quantity


class Mirror(TypedDict, total=False):
    """The shape or mesh is mirrored on a line, in 3D on a plane. Its sides keep their names; what was
    above a shell, or on its left, still is."""

    normal: Required[Quantities]
    """Normal of the line or plane; any length but zero."""
    point: Quantities
    """A point of the line or plane."""


class Rotation(TypedDict, total=False):
    """The shape or mesh is turned about a point, in 3D about an axis."""

    angle: Required[Quantity]
    """Angle, counter-clockwise; about an axis by the right-hand rule."""
    point: Quantities
    """The point; in 3D one of the axis."""
    axis: Quantities
    """Direction of the axis, of a solid; any length but zero."""


#: The 2D shape becomes a solid: it is extruded along z. Quadrilaterals become hexahedra, triangles
#: become wedges. Its sides keep their names; the section at `from` is the side `back`, the other
#: end `front`. Lines become a shell of quadrilaterals (`shell4`), whose face `upper` is on the
#: right of who walks along them; its edges are sets of nodes with these names.
Extrude = TypedDict(
    "Extrude",
    {
        #: Length along z.
        "length": "Required[Quantity]",
        #: Elements along z.
        "elements": "Required[Integer]",
        #: z at which it begins.
        "from": "Quantity",
        #: Length of the last element over that of the first.
        "grading": "Quantity",
    },
    total=False,
)


class Revolve(TypedDict, total=False):
    """The 2D shape becomes a solid: it is revolved about a line of the x-y plane, towards z first.
    Where it has an edge on the line, quadrilaterals become wedges and triangles tetrahedra. Its
    sides keep their names; unless it is turned all around, the section as it is drawn is the side
    `back`, the other end `front`. Lines become a shell (`shell4`) as by `extrude`, of triangles
    where they end on the line."""

    angle: Quantity
    """Angle by which it is turned."""
    elements: Required[Integer]
    """Elements around; at least 3 all around."""
    axis: Quantities
    """Direction of the line; any length but zero."""
    point: Quantities
    """A point of the line; the shape lies on one side of it."""


class Copies(TypedDict, total=False):
    """The part consists of several bodies of one shape or mesh, each turned and moved from the one
    before. Sides and groups are those of all of them."""

    count: Required[Integer]
    """Number of bodies in all."""
    translation: Quantities
    """How far each is moved."""
    angle: Quantity
    """Angle by which each is turned, counter-clockwise."""
    point: Quantities
    """Point about which they are turned; in 3D one of the axis."""
    axis: Quantities
    """Direction of the axis about which they are turned, of solids; any length but zero."""


class Rectangle(TypedDict, total=False):
    """An axis-parallel rectangle; its sides are `left`, `right`, `bottom` and `top`."""

    corner: Required[Quantities]
    """Lower left corner."""
    size: Required[Quantities]
    """Width and height."""
    elements: Required[Integers]
    """Elements along x and along y."""
    grading: Quantities
    """Length of the last element over that of the first, in the directions of `elements`; they grow by
    equal factors."""


#: A ring, or a sector of one, counter-clockwise from `from` to `to`; its sides are `inner` and
#: `outer` and, for a sector, `start` and `end`.
Ring = TypedDict(
    "Ring",
    {
        #: Centre.
        "centre": "Required[Quantities]",
        #: Inner radius.
        "inner": "Required[Quantity]",
        #: Outer radius.
        "outer": "Required[Quantity]",
        #: Angle at which it begins, counter-clockwise from the x axis.
        "from": "Quantity",
        #: Angle at which it ends: more than `from`, by at most a full turn.
        "to": "Quantity",
        #: Elements through the wall and around.
        "elements": "Required[Integers]",
        #: Length of the last element over that of the first, in the directions of `elements`; they
        #: grow by equal factors.
        "grading": "Quantities",
    },
    total=False,
)


class Disk(TypedDict, total=False):
    """A full disk; its side is `outer`."""

    centre: Required[Quantities]
    """Centre."""
    radius: Required[Quantity]
    """Radius."""
    elements: Required[Integer]
    """Elements around a quarter of the circumference."""


class Trapezoid(TypedDict, total=False):
    """A trapezoid with horizontal bottom and top; its sides are `left`, `right`, `bottom` and `top`."""

    corner: Required[Quantities]
    """Lower left corner."""
    bottom: Required[Quantity]
    """Width at the bottom."""
    top: Required[Quantity]
    """Width at the top."""
    height: Required[Quantity]
    """Height."""
    shift: Quantity
    """How far the upper left corner lies to the right of the lower left one."""
    elements: Required[Integers]
    """Elements across and up."""
    grading: Quantities
    """Length of the last element over that of the first, in the directions of `elements`; they grow by
    equal factors."""


class Quadrilateral(TypedDict, total=False):
    """A quadrilateral with straight or curved edges, meshed by the map between them (Coons); its sides
    are `left`, `right`, `bottom` and `top`. An edge is straight unless points are given."""

    corners: Required[Points]
    """Four corners, counter-clockwise; `bottom` is between the first two."""
    elements: Required[Integers]
    """Elements along `bottom` and along `right`."""
    grading: Quantities
    """Length of the last element over that of the first, in the directions of `elements`; they grow by
    equal factors."""
    bottom: Points
    """Points that this edge runs through, from the first corner to the second."""
    right: Points
    """The same from the second corner to the third."""
    top: Points
    """The same from the third corner to the fourth."""
    left: Points
    """The same from the fourth corner to the first."""
    bottom_arc: Quantities
    """A point through which this edge is an arc of a circle."""
    right_arc: Quantities
    """The same for the right edge."""
    top_arc: Quantities
    """The same for the top edge."""
    left_arc: Quantities
    """The same for the left edge."""


class Polygon(TypedDict, total=False):
    """A polygon with straight edges, with or without holes, of triangles (`element_triangles`). Its
    sides are `outer`, the edges of the outline `edge1` (from the first point to the second),
    `edge2`, ..., and the holes `hole1`, `hole2`, ..."""

    outline: Required[Points]
    """Corners, in either direction; the last is joined to the first."""
    size: Required[Quantity]
    """Length of the elements' edges."""
    holes: Sequence[Points]
    """Corners of each hole."""
    near: Points
    """Points around which elements are smaller."""
    sizes: Quantities
    """Length of the elements' edges at each of these points."""
    growth: Quantity
    """Growth of that length by distance from them, up to `size`."""


class Path(TypedDict, total=False):
    """A strip along a path from point to point: a bent sheet, a pipe, a spring. Its sides are `left`
    and `right` of who walks along it and, unless it is closed, `start` and `end`."""

    points: Required[Points]
    """Points of the middle line."""
    width: Required[Quantity]
    """Width of the strip, half on either side of the line."""
    radius: Quantity
    """Radius of the middle line in its bends; 0: mitred corners."""
    closed: Flag
    """Whether the last point leads back to the first."""
    elements: Required[Integers]
    """Elements through the width and along the path; each straight part and each bend has at least
    one."""


class Truss(TypedDict, total=False):
    """Bars along straight pieces from point to point, for `element = "bar2"`. Points in one place are
    one node; lines that cross elsewhere do not meet. Its points can be named as `point0`, `point1`,
    ... in the order in which they are first given. `join` ties them to other parts."""

    lines: Required[Sequence[Points]]
    """Lines, each a list of points: `[[[0, 0], [1, 0], [1, 1]], [[0, 0], [1, 1]]]` is a triangle."""
    elements: Integer
    """Bars along each piece between two points: 1 for a truss, more for a cable, which has no
    stiffness in bending."""


class Line(TypedDict, total=False):
    """A line along a path from point to point, for `element = "shell2"` (or `bar2`), or with `extrude`
    or `revolve` for `shell4`. Unless it is closed, its ends can be named as `start` and `end`; the
    faces of a `shell2` are `left` and `right` of who walks along it."""

    points: Required[Points]
    """Points of the path."""
    radius: Quantity
    """Radius of its bends; 0: sharp."""
    closed: Flag
    """Whether the last point leads back to the first."""
    elements: Required[Integer]
    """Elements along it; each straight part and each bend has at least one."""


#: An arc, counter-clockwise from `from` to `to`, for `element = "shell2"` (or `bar2`), or with
#: `extrude` or `revolve` for `shell4`. Unless it is closed, its ends can be named as `start` and
#: `end`; the faces of a `shell2` are `left` (inside) and `right`.
Arc = TypedDict(
    "Arc",
    {
        #: Centre.
        "centre": "Required[Quantities]",
        #: Radius, to the middle of the shell.
        "radius": "Required[Quantity]",
        #: Angle at which it begins, counter-clockwise from the x axis.
        "from": "Quantity",
        #: Angle at which it ends: more than `from`, by at most a full turn.
        "to": "Quantity",
        #: Elements along it.
        "elements": "Required[Integer]",
        #: Length of the last element over that of the first; the lengths in between grow by a
        #: constant factor.
        "grading": "Quantity",
    },
    total=False,
)


class Box(TypedDict, total=False):
    """An axis-parallel box of hexahedra; its sides are `left` and `right` (along x), `bottom` and
    `top` (along y), `back` and `front` (along z). With `shell4` the shell of all six."""

    corner: Required[Quantities]
    """Corner with the lowest coordinates."""
    size: Required[Quantities]
    """Lengths along x, y and z."""
    elements: Required[Integers]
    """Elements along x, y and z."""
    grading: Quantities
    """Length of the last element over that of the first, along x, y and z; they grow by equal factors."""


class Cylinder(TypedDict, total=False):
    """A full cylinder of hexahedra, or one, two or three quarters of one; its sides are `outer`, of a
    part of one also `start` and `end`, and `bottom` and `top` where its axis begins and ends. With
    `shell4` the shell of its side `outer`, without lids."""

    centre: Required[Quantities]
    """Centre of the bottom."""
    radius: Required[Quantity]
    """Radius."""
    length: Required[Quantity]
    """Length along the axis."""
    elements: Required[Integers]
    """Elements around a quarter of the circumference (an even number for a part of a cylinder), and
    along the axis."""
    axis: Quantities
    """Direction from the bottom to the top; any length but zero."""
    angle: Quantity
    """90, 180, 270 or 360 degrees around the axis by the right-hand rule: from x where the axis is z,
    from y where it is x, from z where it is y."""
    grading: Quantity
    """Length of the last element along the axis over that of the first."""


#: A tube of hexahedra, or a sector of one; its sides are `inner` and `outer`, of a sector also
#: `start` and `end`, and `bottom` and `top` where its axis begins and ends.
Tube = TypedDict(
    "Tube",
    {
        #: Centre of the bottom.
        "centre": "Required[Quantities]",
        #: Inner radius.
        "inner": "Required[Quantity]",
        #: Outer radius.
        "outer": "Required[Quantity]",
        #: Length along the axis.
        "length": "Required[Quantity]",
        #: Elements through the wall, around and along the axis.
        "elements": "Required[Integers]",
        #: Direction from the bottom to the top; any length but zero.
        "axis": "Quantities",
        #: Angle at which it begins, around the axis by the right-hand rule: from x where the axis
        #: is z, from y where it is x, from z where it is y.
        "from": "Quantity",
        #: Angle at which it ends: more than `from`, by at most a full turn.
        "to": "Quantity",
    },
    total=False,
)


class Sphere(TypedDict, total=False):
    """A full sphere of hexahedra, or a part of one; its side is `outer`, where it is cut also `left`
    (across x), `bottom` (across y) and `back` (across z). With `shell4` the shell of its surface."""

    centre: Required[Quantities]
    """Centre."""
    radius: Required[Quantity]
    """Radius."""
    elements: Required[Integer]
    """Elements around a quarter of a great circle; an even number for a part of a sphere."""
    portion: Literal["whole", "half", "quarter", "eighth"]
    """How much of it: the half above the centre's x, the quarter above its x and y, the eighth above
    its x, y and z."""


class SpaceTruss(TypedDict, total=False):
    """Bars along straight pieces from point to point in 3D, for `element = "bar2"`, or beams, for
    `"beam2"`. Points in one place are one node (beams are rigidly connected there); lines that
    cross elsewhere do not meet. Its points can be named as `point0`, `point1`, ... in the order in
    which they are first given. `join` ties them to other parts."""

    lines: Required[Sequence[Points]]
    """Lines, each a list of points: `[[[0, 0, 0], [1, 0, 0], [0, 0, 1]], [[0, 1, 0], [0, 0, 1]]]` are
    three bars."""
    elements: Integer
    """Elements along each piece between two points: of bars 1 for a truss, more for a cable, which has
    no stiffness in bending; of beams 4 to 10."""


class PartMesh(TypedDict, total=False):
    """A group of a mesh file (Gmsh `.msh` 2.2 or 4.1, 3D if it has a group of volumes, or a part is
    made of its surfaces as a shell with `shell4`; Abaqus or CalculiX `.inp`; STL `.stl` for a shell
    of triangles, `shell3`), triangles, wedges and tetrahedra too. Its other groups can be named in
    contacts, constraints and probes, as `group` or `part.group`. Parts of one file that are
    mirrored, turned, moved and copied alike share its nodes; those of different places do not."""

    file: Required[Text]
    """Path of the file, from the model file's folder."""
    group: Required[Text]
    """Name of a physical group of surfaces (of solids of volumes, of bars, beams and of shells in 2D
    of lines), or of an element set; of an STL file `all`, and its open edges are the group `rim`."""
    scale: Quantity
    """Length of one unit of the file, such as `"1 mm"`: its unit, or a scale."""
    tolerance: Quantity
    """Distance within which corners of the triangles of an STL file are one node."""


class Plane(TypedDict, total=False):
    """A straight line (in 3D a plane) that bodies meet from the side of its normal."""

    point: Quantities
    """A point of the line; its middle where it has a length."""
    normal: Required[Quantities]
    """Normal that points to the free side; any length but zero."""
    length: Quantity
    """Length."""


class Circle(TypedDict, total=False):
    """A circle."""

    centre: Required[Quantities]
    """Centre."""
    radius: Required[Quantity]
    """Radius."""
    hollow: Flag
    """Whether the bodies are inside of it."""


class Polyline(TypedDict, total=False):
    """Straight lines from point to point, the obstacle on their right: counter-clockwise around
    bodies, clockwise around the obstacle."""

    points: Required[Points]
    """Points; the first once more at the end closes it."""


class ObstacleSphere(TypedDict, total=False):
    """In 3D: a sphere."""

    centre: Required[Quantities]
    """Centre."""
    radius: Required[Quantity]
    """Radius."""
    hollow: Flag
    """Whether the bodies are inside of it."""


class ObstacleCylinder(TypedDict, total=False):
    """In 3D: a cylinder without ends."""

    point: Quantities
    """A point of its axis."""
    axis: Required[Quantities]
    """Direction of the axis; any length but zero."""
    radius: Required[Quantity]
    """Radius."""
    hollow: Flag
    """Whether the bodies are inside of it."""


class Stl(TypedDict, total=False):
    """In 3D: the triangles of an STL file, text or binary. Corners that are equal to the last bit are
    one point. Bodies are on the side from which triangles are counter-clockwise, which is outside
    of a closed surface; the normals that the file gives don't count."""

    file: Required[Text]
    """Path of the file, from the model file's folder."""
    scale: Quantity
    """Length of one unit of the file; `"1 mm"` of most programs for construction."""
    rotation: Rotation
    """How it is turned."""
    translation: Quantities
    """How far it is moved after that."""
    hollow: Flag
    """Whether the bodies are on the other side: inside of a closed surface."""


class Components(TypedDict, total=False):
    """Prescribed values by component: quantities, or names of curves."""

    x: Quantity
    y: Quantity
    z: Quantity


class ConstraintRotation(TypedDict, total=False):
    """Rotation of nodes about a fixed point, on exact circles."""

    speed: Required[Quantity]
    """Angular velocity, counter-clockwise: a number or a curve."""
    centre: Quantities
    """The point; in 3D one of the axis."""
    axis: Quantities
    """Direction of the axis, in 3D."""


class Inflow(TypedDict, total=False):
    """Gas that flows into a cavity; its enthalpy comes with it."""

    rate: Required[Quantity]
    """Mass per time."""
    curve: str
    """Name of a curve of pure numbers by whose value the rate is multiplied."""
    temperature: Required[Quantity]
    """Temperature of what flows in: a number or the name of a curve. A cavity with the exponent 1
    takes it up at its own."""


class Vents(TypedDict, total=False):
    """An opening of a cavity: an isentropic orifice, choked where the pressure outside is low enough.
    Nothing flows in through it."""

    orifice: Required[Quantity]
    """Area of the opening, in 2D per metre of depth."""
    discharge: Quantity
    """Discharge coefficient, by which the area is multiplied."""
    opens_at: Quantity
    """Pressure of the gas, absolute, at which it opens, for good."""


class Sine(TypedDict, total=False):
    """offset + amplitude * sin(2 pi frequency t + phase)."""

    amplitude: Required[Quantity]
    """Height of the wave: a quantity, or a bare number in the SI unit of what uses the curve."""
    frequency: Required[Quantity]
    """Waves per time."""
    phase: Quantity
    """Angle at time zero."""
    offset: Quantity
    """Mean value, of the same dimension."""


class PictureView(TypedDict, total=False):
    """The rectangle that pictures show, mirror images included; in 3D in the plane of the picture,
    from the image of the origin."""

    corner: Required[Quantities]
    """Lower left corner."""
    size: Required[Quantities]
    """Width and height."""


#: How pictures look at a 3D model: from afar, so that parallel lines stay parallel, and with
#: everything in sight.
Camera = TypedDict(
    "Camera",
    {
        #: Direction from the model to the camera; any length but zero.
        "from": "Quantities",
        #: What is in the middle of the picture.
        "at": "Quantities",
        #: Direction that is upwards in the picture; not that of `from`.
        "up": "Quantities",
        #: How many times larger than so that everything is seen.
        "zoom": "Quantity",
    },
    total=False,
)


class Sections:
    """A method for each section of the model file; each returns the model."""

    @section
    def run(
        self,
        *,
        end: Quantity | None = None,
        safety: Quantity | None = None,
        stable_step: Literal["elements", "nodes", "assembled"] | None = None,
        energy_limit: Quantity | None = None,
        step_limit: Quantity | None = None,
        velocity_limit: Quantity | None = None,
        penetration_limit: Quantity | None = None,
        memory_limit: Quantity | None = None,
        time_step: Quantity | None = None,
        max_steps: Integer | None = None,
        checkpoint: Quantity | None = None,
        checkpoint_steps: Integer | None = None,
        bulk_viscosity: Quantities | None = None,
        relaxation: Relaxation | None = None,
        subcycling: Flag | None = None,
        mass_scaling: MassScaling | None = None,
    ) -> Self:
        """How long the simulation runs and what stops it.

        Parameters
        ----------
        end
            End time.
        safety
            Fraction of the stable time step that is used.
        stable_step
            What bounds the stable step: the element that alone would need the shortest, the node at
            which the stiffness of its elements together is the largest for its mass, or the largest
            frequency of the assembled mesh, which Lanczos' method finds, with what the deformation
            may have added since. By nodes the step is never shorter, and longer where bad elements
            lie among good ones; by the assembled mesh it is the longest.
        energy_limit
            Energy drift at which the run stops, as a fraction of the largest total energy.
        step_limit
            Time step below which the run stops.
        velocity_limit
            Speed of a node above which the run stops: faster than waves, no body moves in a sound
            model.
        penetration_limit
            Depth of a contact at which the run stops.
        memory_limit
            Memory that the model may need, such as `8 GB`: one that needs more is refused before it
            is meshed.
        time_step
            Largest time step. A model of rigid parts alone takes just this one, and without it the
            step that their elements would need if they were not rigid.
        max_steps
            Largest number of steps.
        checkpoint
            Wall time between two checkpoints, from which `embate resume` continues a run that was
            stopped; with it the last good state of a run that fails is kept as well. 0: none by the
            clock. Without it, and without `checkpoint_steps`, intervals are so long that
            checkpoints cost less than a hundredth of the run.
        checkpoint_steps
            Steps between two checkpoints; then there are none by the clock unless `checkpoint` is
            there, too.
        bulk_viscosity
            Linear and quadratic coefficient of the pressure that resists compression: `[0.06, 1.2]`
            spreads shocks over a few elements and keeps them from ringing.
        relaxation
            Damping that brings everything to rest, and an end of the run when it is.
        subcycling
            Evaluates elements that allow a longer step in every second, third, ... up to 60th step
            only, and those that need the shortest in all: for meshes in which sizes or materials
            differ much.
        mass_scaling
            Makes elements with a small stable step heavier, at the start and, if wanted, in the
            run.
        """
        raise NotImplementedError

    @section
    def stage(
        self,
        *,
        duration: Quantity,
        name: str | None = None,
        relaxation: Relaxation | None = None,
        release: Quantity | None = None,
    ) -> Self:
        """A part of the run; stages follow each other in the order of the file, and `run.end` is left
        out. Loads, constraints, contacts and obstacles that name `stages` act in these alone, and
        times of a curve that names a `stage` count from the beginning of that. A stage with
        `relaxation` is a static one: it ends when all is at rest. Initial velocities of parts and
        obstacles are those at the beginning of the first stage without it.

        Parameters
        ----------
        duration
            How long it lasts; with `relaxation` the longest that it may.
        name
            Unique name, by which others refer to it.
        relaxation
            Damping that brings everything to rest, and the end of the stage when it is; `from`
            counts from its beginning.
        release
            Time over which what held bodies in the stage before, and does so no more, lets go:
            reactions of constraints and forces of contacts and obstacles that end decrease smoothly
            to zero. Rest does not count until then.
        """
        raise NotImplementedError

    @section
    def material(
        self,
        name: str,
        *,
        from_: Text | None = None,
        law: Literal["elastic", "orthotropic_elastic", "j2", "j2_voce", "j2_swift", "j2_ludwik", "j2_table", "chaboche", "johnson_cook", "drucker_prager", "crushable_foam", "neo_hookean", "mooney_rivlin", "yeoh", "arruda_boyce", "ogden", "viscoelastic", "null"] | None = None,
        failure: Failure | None = None,
        eos: Literal["linear", "mie_gruneisen", "polynomial", "ideal_gas", "jwl"] | None = None,
        density: Quantity | None = None,
        young: Quantity | None = None,
        poisson: Quantity | None = None,
        young_1: Quantity | None = None,
        young_2: Quantity | None = None,
        young_3: Quantity | None = None,
        poisson_12: Quantity | None = None,
        poisson_23: Quantity | None = None,
        poisson_31: Quantity | None = None,
        shear_12: Quantity | None = None,
        shear_23: Quantity | None = None,
        shear_31: Quantity | None = None,
        angle: Quantity | None = None,
        yield_: Quantity | None = None,
        hardening: Quantity | None = None,
        rate_reference: Quantity | None = None,
        rate_exponent: Quantity | None = None,
        saturation: Quantity | None = None,
        saturation_rate: Quantity | None = None,
        strength: Quantity | None = None,
        strain_offset: Quantity | None = None,
        hardening_exponent: Quantity | None = None,
        plastic_strain: Quantities | None = None,
        stress: Quantities | None = None,
        isotropic_stress: Quantity | None = None,
        isotropic_rate: Quantity | None = None,
        backstress_modulus: Quantities | None = None,
        backstress_recall: Quantities | None = None,
        rate_coefficient: Quantity | None = None,
        softening_exponent: Quantity | None = None,
        temperature: Quantity | None = None,
        temperature_reference: Quantity | None = None,
        temperature_melt: Quantity | None = None,
        specific_heat: Quantity | None = None,
        taylor_quinney: Quantity | None = None,
        damage: Quantities | None = None,
        cohesion: Quantity | None = None,
        friction_angle: Quantity | None = None,
        dilation_angle: Quantity | None = None,
        plastic_poisson: Quantity | None = None,
        tension_cutoff: Quantity | None = None,
        c10: Quantity | None = None,
        c01: Quantity | None = None,
        bulk: Quantity | None = None,
        c20: Quantity | None = None,
        c30: Quantity | None = None,
        shear: Quantity | None = None,
        locking_stretch: Quantity | None = None,
        mu: Quantities | None = None,
        alpha: Quantities | None = None,
        shear_ratio: Quantities | None = None,
        relaxation_time: Quantities | None = None,
        viscosity: Quantity | None = None,
        bulk_modulus: Quantity | None = None,
        tension: Quantity | None = None,
        c0: Quantity | None = None,
        s1: Quantity | None = None,
        s2: Quantity | None = None,
        s3: Quantity | None = None,
        gamma0: Quantity | None = None,
        gamma_slope: Quantity | None = None,
        energy_initial: Quantity | None = None,
        coefficients: Quantities | None = None,
        coefficients_energy: Quantities | None = None,
        gamma: Quantity | None = None,
        pressure_initial: Quantity | None = None,
        pressure_a: Quantity | None = None,
        pressure_b: Quantity | None = None,
        r1: Quantity | None = None,
        r2: Quantity | None = None,
        omega: Quantity | None = None,
    ) -> Self:
        """A material: a law and its parameters, or a material of the library by `from`, of which any
        key can be given another value here. Parts refer to it by its name.

        Parameters
        ----------
        from_
            Name of a material of the library, as `embate list materials --library` shows them: the
            law and the keys are its own, but for those that are given here.
        law
            Name of the law.
        failure
            When elements of this material fail: they are taken out of the model.
        eos
            Equation of state: gives the pressure in place of the law, which keeps what is without
            volume. Not with hyperelastic laws, nor where flow changes the volume (`drucker_prager`,
            `crushable_foam`); `null` needs it.
        density
            mass per initial volume
        young
            Young's modulus
        poisson
            Poisson's ratio
        young_1
            Young's modulus along axis 1
        young_2
            Young's modulus along axis 2, in the plane
        young_3
            Young's modulus along axis 3, out of the plane
        poisson_12
            contraction along axis 2 under a pull along axis 1
        poisson_23
            contraction along axis 3 under a pull along axis 2
        poisson_31
            contraction along axis 1 under a pull along axis 3 (ν₃₁/E₃ = ν₁₃/E₁)
        shear_12
            shear modulus in the plane
        shear_23
            shear modulus out of the plane; 0: as shear_12
        shear_31
            shear modulus out of the plane; 0: as shear_12
        angle
            angle from x to axis 1, counter-clockwise
        yield_
            initial yield stress
        hardening
            plastic modulus dσ_y/dε_p (not the tangent modulus); negative: the flow stress falls,
            down to zero
        rate_reference
            rate of plastic strain that doubles the flow stress (Cowper and Symonds); 0: no
            dependence on the rate
        rate_exponent
            exponent of the rate, 1 or more; it enters as 1/P
        saturation
            flow stress at which hardening ends; below `yield` the material softens
        saturation_rate
            how fast: after a plastic strain of 1/b 63 % are done
        strength
            flow stress at a strain of one
        strain_offset
            strain at first yield: the yield stress is K ε_0^n
        hardening_exponent
            exponent
        plastic_strain
            equivalent plastic strains of the curve's points (logarithmic), ascending from 0
        stress
            true flow stresses of the points, as many as plastic strains; the last one holds from
            there on
        isotropic_stress
            what isotropic hardening adds to the yield stress in the end; negative: cyclic
            softening, more than `-yield`
        isotropic_rate
            how fast: after a plastic strain of 1/b 63 % are done
        backstress_modulus
            initial moduli of up to three backstresses
        backstress_recall
            how fast each fades: it saturates at C/γ; 0 is linear hardening; left out, all are 0
        rate_coefficient
            growth of the flow stress with the logarithm of the rate
        softening_exponent
            exponent of the temperature
        temperature
            initial temperature
        temperature_reference
            temperature up to which nothing softens: that of the tests behind A, B and n
        temperature_melt
            melting point: no shear strength from there on
        specific_heat
            heat per mass and temperature
        taylor_quinney
            share of the plastic work that heats
        damage
            five constants of the failure strain; none: no damage is counted
        cohesion
            shear strength without pressure
        friction_angle
            angle of internal friction, below 90 deg, fitted to compression
        dilation_angle
            angle of dilation, at most the angle of friction
        plastic_poisson
            sideways over lengthwise plastic strain in uniaxial compression
        tension_cutoff
            mean stress in tension at which it tears; 0: none
        c10
            coefficient of the first invariant
        c01
            coefficient of the second invariant
        bulk
            bulk modulus
        c20
            quadratic coefficient; above −√(3 C₁₀ C₃₀)
        c30
            cubic coefficient
        shear
            shear modulus at rest
        locking_stretch
            stretch at which the chains are straight
        mu
            moduli of up to three terms, each of its exponent's sign
        alpha
            their exponents, as many as moduli
        shear_ratio
            up to four parts of the shear modulus that relax; below 1 in sum
        relaxation_time
            time in which each part falls to 1/e
        viscosity
            shear stress per rate of shear (dynamic viscosity)
        bulk_modulus
            pressure per compression µ
        tension
            largest tension that the pressure reaches: 0 for a liquid that cavitates, the spall
            strength of a solid
        c0
            speed of weak shocks
        s1
            growth of the shock speed with the particle speed
        s2
            second coefficient, of (u_p/u_s) u_p
        s3
            third coefficient, of (u_p/u_s)² u_p
        gamma0
            Grüneisen parameter at the start
        gamma_slope
            its change times v with the compression: Γ = γ0 + a µ
        energy_initial
            energy at the start per initial volume, J/m^3
        coefficients
            C0, C1, C2, C3; those left out are 0
        coefficients_energy
            C4, C5, C6; those left out are 0
        gamma
            ratio of the specific heats
        pressure_initial
            pressure at the start; it or energy_initial
        pressure_a
            first pressure
        pressure_b
            second pressure
        r1
            decay of the first pressure with v
        r2
            decay of the second pressure with v
        omega
            Grüneisen parameter of the expanded gas
        """
        raise NotImplementedError

    @section
    def part(
        self,
        *,
        name: str,
        material: str,
        element: Literal["quad4", "quad4_full", "quad4_reduced", "quad4_reduced_viscous", "quad4_reduced_assumed_strain", "tri6", "bar2", "beam2", "shell2", "shell4", "shell4_full", "shell3", "hex8", "hex8_reduced", "hex8_reduced_viscous", "hex8_reduced_assumed_strain", "wedge6", "tet4", "tet4_anp", "tet10"] | None = None,
        element_triangles: Literal["tri3", "tri3_anp", "tri6"] | None = None,
        area: Quantity | None = None,
        section: Section | None = None,
        profile: Profile | None = None,
        hourglass: Quantity | None = None,
        stress_state: Literal["plane_strain", "plane_stress", "axisymmetric"] | None = None,
        velocity: Quantities | None = None,
        spin: Quantity | None = None,
        spin_axis: Quantities | None = None,
        spin_centre: Quantities | None = None,
        radial_velocity: RadialVelocity | None = None,
        stress_initial: StressInitial | None = None,
        temperature_initial: Quantity | None = None,
        rigid: Flag | Motion | None = None,
        mass_scale: Quantity | None = None,
        mirror: Mirror | None = None,
        rotation: Rotation | None = None,
        extrude: Extrude | None = None,
        revolve: Revolve | None = None,
        translation: Quantities | None = None,
        copies: Copies | None = None,
        rectangle: Rectangle | None = None,
        ring: Ring | None = None,
        disk: Disk | None = None,
        trapezoid: Trapezoid | None = None,
        quadrilateral: Quadrilateral | None = None,
        polygon: Polygon | None = None,
        path: Path | None = None,
        truss: Truss | None = None,
        line: Line | None = None,
        arc: Arc | None = None,
        box: Box | None = None,
        cylinder: Cylinder | None = None,
        tube: Tube | None = None,
        sphere: Sphere | None = None,
        space_truss: SpaceTruss | None = None,
        mesh: PartMesh | ArrayMesh | None = None,
        group: str | None = None,
    ) -> Self:
        """A body of one material, and how it moves at the start. A shape, or a mesh file, says where
        its elements come from.

        Parameters
        ----------
        name
            Unique name.
        material
            Name of a `[material.NAME]` section.
        element
            Kind of element: what quadrilaterals are; `bar2` for bars, `beam2` for beams in 3D,
            `shell2` for shells in 2D, `shell4` for those in 3D (`shell3` where they are of
            triangles only).
        element_triangles
            What triangles are, where the part has some; those of shells in 3D are `shell3`. With
            `tri6` a mesh of three-node triangles gets a node in the middle of each edge.
        area
            Cross-section of bars per metre of depth, such as `"1e-4 m"` for one square centimetre
            in each metre; between solids whole, `"1e-4 m^2"`.
        section
            Section of shells: thickness and layers.
        profile
            Cross-section of beams, and the fibres in it.
        hourglass
            Coefficient of the hourglass control of elements that have one.
        stress_state
            What the plane stands for. In an axisymmetric part x is the radius and y the axis;
            forces, masses and energies are those of the whole circumference.
        velocity
            Initial velocity.
        spin
            Initial angular velocity about the centre of mass, counter-clockwise; not of an
            axisymmetric part.
        spin_axis
            Direction of the axis of `spin`, in 3D, by the right-hand rule; any length but zero.
        spin_centre
            Point about which `spin` turns the part, in 3D one of the axis: with another one than
            the centre of mass that moves, too.
        radial_velocity
            Initial velocity away from a point or an axis; not of a rigid part.
        stress_initial
            Stress at the start.
        temperature_initial
            Temperature at the start, of laws that have one (`johnson_cook`).
        rigid
            Whether the part is rigid, free to move; or how it moves: `x` and `y` of its centre of
            mass, `rotation` about it. What is left out is free. An axisymmetric part moves along
            `y` only.
        mass_scale
            Factor on the mass of the part where mass resists motion: 100 makes steps ten times as
            long. What gravity pulls at stays the true mass.
        mirror
            A line, in 3D a plane, that the shape or mesh is mirrored on, before it is turned.
        rotation
            An angle by which the shape or mesh is turned, before it is moved.
        extrude
            Extrudes a 2D shape along z: the part becomes a solid, lines become a shell (`shell4`).
        revolve
            Revolves a 2D shape about a line: the part becomes a solid, lines become a shell
            (`shell4`).
        translation
            How far the shape or mesh is moved.
        copies
            More bodies of the same shape or mesh, in a row or around a point.
        rectangle
            An axis-parallel rectangle.
        ring
            A ring or a sector of one.
        disk
            A full disk.
        trapezoid
            A trapezoid with horizontal bottom and top.
        quadrilateral
            A quadrilateral with straight or curved edges.
        polygon
            A polygon, with or without holes, of triangles.
        path
            A strip of a given width along a path.
        truss
            Bars along lines: trusses, cables, nets; with `element = "bar2"`.
        line
            A line along a path: the middle of a shell, with `element = "shell2"`, and swept with
            `shell4`.
        arc
            An arc: the middle of a round shell, with `element = "shell2"`, and swept with `shell4`.
        box
            An axis-parallel box: a solid.
        cylinder
            A full cylinder, or quarters of one: a solid.
        tube
            A tube, or a sector of one: a solid.
        sphere
            A full sphere, or a half, quarter or eighth of one: a solid.
        space_truss
            Bars or beams along lines in 3D: trusses, frames, cables, nets; with `element = "bar2"`
            or `"beam2"`.
        mesh
            A group of a mesh file.
        group
            Which group of the arrays given as `mesh`; left out where there is but one.
        """
        raise NotImplementedError

    @section
    def contact(
        self,
        *,
        name: str | None = None,
        between: Names | None = None,
        bodies: Names | None = None,
        formulation: Literal["double_pass", "single_pass", "segment", "pinball"] | None = None,
        slave: str | None = None,
        tied: Flag | None = None,
        tie_strength: Quantity | None = None,
        pairs: Flag | None = None,
        search: Literal["grid", "boxes", "spheres", "nearest_node", "brute_force"] | None = None,
        law: Literal["penalty", "pressure_gap", "multiplier"] | None = None,
        penalty: Quantity | None = None,
        penalty_scale: Quantity | None = None,
        penalty_from: Literal["wave_modulus", "bulk_modulus", "time_step"] | None = None,
        gaps: Quantities | None = None,
        pressures: Quantities | None = None,
        damping: Quantity | None = None,
        friction: Quantity | None = None,
        friction_dynamic: Quantity | None = None,
        friction_decay: Quantity | None = None,
        friction_viscosity: Quantity | None = None,
        friction_limit: Quantity | None = None,
        initial_penetration: Literal["error", "ignore", "push_out"] | None = None,
        thickness: Quantity | None = None,
        birth: Quantity | None = None,
        death: Quantity | None = None,
        stages: Names | None = None,
    ) -> Self:
        """Bodies that can't go through each other: two surfaces, or several bodies, each of which
        meets each other and itself. A surface is a part (its whole outside), a side such as
        `plate.top`, or a group of lines (in 3D of surfaces) of a mesh file, which of shells is the
        face that it looks from: in 3D where its cells run counter-clockwise, in 2D the left of its
        lines.

        Parameters
        ----------
        name
            Unique name.
        between
            The two surfaces.
        bodies
            Parts that meet each other and themselves; `"all"` for all parts.
        formulation
            What is checked: the nodes of each surface against the segments of the other, only the
            nodes of `slave`, segments against segments, or disks in the elements. In 3D nodes meet
            facets, in a double pass also edges edges; segments are facets, and the elements have
            balls.
        slave
            The surface of `between` whose nodes are checked.
        tied
            Whether what touches at the start stays together: nodes of one surface on segments or
            facets of the other, with `segment` both surfaces over what they have in common.
        tie_strength
            Traction above which a tie breaks.
        pairs
            Whether the history has the forces of `bodies` by pair, as
            `contact.force_x[NAME:ONE-OTHER]`: of the second on the first.
        search
            How near pairs are found; changes no result.
        law
            What keeps the surfaces apart: a force proportional to the penetration, a pressure that
            depends on the gap, or whatever force it takes.
        penalty
            Stiffness per node and depth, or circumference (N/m/m, of solids N/m; also meant by a
            bare number), or pressure per penetration (Pa/m).
        penalty_scale
            Factor on the automatic penalty.
        penalty_from
            What the automatic penalty is made from: K + 4µ/3 or K over the height of the elements,
            or the mass over the square of the first stable step.
        gaps
            Gaps, ascending; below zero is penetration.
        pressures
            Pressures at the gaps, never rising, zero at the last.
        damping
            Viscous damping of closed contacts, as a fraction of the critical one. It also resists
            rolling: what comes in is slowed down, and what goes out is not pushed back as much.
        friction
            Coefficient µ_s of Coulomb friction, at rest.
        friction_dynamic
            Coefficient µ_d of fast sliding, at most µ_s.
        friction_decay
            Rate β from the one to the other coefficient.
        friction_viscosity
            Shear stress c per slip rate.
        friction_limit
            Largest shear stress τ.
        initial_penetration
            What is done with penetrations at the start: the model is refused, the gap counts as
            zero, or nodes are moved to the surface.
        thickness
            Distance that the surfaces keep.
        birth
            Time from which it acts.
        death
            Time until which it acts.
        stages
            Stages in which it acts, one after the other.
        """
        raise NotImplementedError

    @section
    def obstacle(
        self,
        *,
        name: str | None = None,
        parts: Names | None = None,
        plane: Plane | None = None,
        circle: Circle | None = None,
        polyline: Polyline | None = None,
        sphere: ObstacleSphere | None = None,
        cylinder: ObstacleCylinder | None = None,
        stl: Stl | None = None,
        motion: Motion | None = None,
        reference: Quantities | None = None,
        mass: Quantity | None = None,
        inertia: Quantity | None = None,
        velocity: Quantities | None = None,
        spin: Quantity | None = None,
        law: Literal["penalty", "pressure_gap", "multiplier"] | None = None,
        penalty: Quantity | None = None,
        penalty_scale: Quantity | None = None,
        penalty_from: Literal["wave_modulus", "bulk_modulus", "time_step"] | None = None,
        gaps: Quantities | None = None,
        pressures: Quantities | None = None,
        damping: Quantity | None = None,
        friction: Quantity | None = None,
        friction_dynamic: Quantity | None = None,
        friction_decay: Quantity | None = None,
        friction_viscosity: Quantity | None = None,
        friction_limit: Quantity | None = None,
        initial_penetration: Literal["error", "ignore", "push_out"] | None = None,
        thickness: Quantity | None = None,
        birth: Quantity | None = None,
        death: Quantity | None = None,
        stages: Names | None = None,
    ) -> Self:
        """A rigid body without elements that parts can't go through: fixed, moved, or free with a
        mass. Exactly one of `plane`, `circle` and `polyline`, in 3D of `plane`, `sphere`,
        `cylinder` and `stl`, is its shape.

        Parameters
        ----------
        name
            Unique name.
        parts
            Parts that it stops.
        plane
            A straight line.
        circle
            A circle.
        polyline
            Straight lines from point to point.
        sphere
            In 3D: a sphere.
        cylinder
            In 3D: a cylinder without ends.
        stl
            In 3D: the triangles of an STL file.
        motion
            How it moves: velocities `x` and `y` of its reference point, and `rotation` about it.
            What is left out is fixed. In an axisymmetric model only `y` can move.
        reference
            Reference point of rotation and moments.
        mass
            Mass per depth; of an axisymmetric model and among solids the whole mass, kg.
        inertia
            Moment of inertia about the reference point per depth; among solids the whole, kg m^2,
            the same about all axes.
        velocity
            Initial velocity where it is free.
        spin
            Initial angular velocity where it is free, counter-clockwise.
        law
            What keeps the surfaces apart: a force proportional to the penetration, a pressure that
            depends on the gap, or whatever force it takes.
        penalty
            Stiffness per node and depth, or circumference (N/m/m, of solids N/m; also meant by a
            bare number), or pressure per penetration (Pa/m).
        penalty_scale
            Factor on the automatic penalty.
        penalty_from
            What the automatic penalty is made from: K + 4µ/3 or K over the height of the elements,
            or the mass over the square of the first stable step.
        gaps
            Gaps, ascending; below zero is penetration.
        pressures
            Pressures at the gaps, never rising, zero at the last.
        damping
            Viscous damping of closed contacts, as a fraction of the critical one. It also resists
            rolling: what comes in is slowed down, and what goes out is not pushed back as much.
        friction
            Coefficient µ_s of Coulomb friction, at rest.
        friction_dynamic
            Coefficient µ_d of fast sliding, at most µ_s.
        friction_decay
            Rate β from the one to the other coefficient.
        friction_viscosity
            Shear stress c per slip rate.
        friction_limit
            Largest shear stress τ.
        initial_penetration
            What is done with penetrations at the start: the model is refused, the gap counts as
            zero, or nodes are moved to the surface.
        thickness
            Distance that the surfaces keep.
        birth
            Time from which it acts.
        death
            Time until which it acts.
        stages
            Stages in which it acts, one after the other.
        """
        raise NotImplementedError

    @section
    def remesh(
        self,
        *,
        part: str,
        size: Quantity | None = None,
        size_contact: Quantity | None = None,
        strain_change: Quantity | None = None,
        stress_error: Quantity | None = None,
        size_least: Quantity | None = None,
        quality: Quantity | None = None,
        time_step: Quantity | None = None,
        interval: Quantity | None = None,
        begin: Quantity | None = None,
        elements_most: Integer | None = None,
        loss_limit: Quantity | None = None,
    ) -> Self:
        """A part of a 2D model whose elements are made again as quadrilaterals inside its outline when
        their form has become poor, or their stable step short. Stress, plastic strain and
        velocities go over to the new elements: mass, momentum and angular momentum exactly, energy
        but for a loss that the history has as `energy.remap`. Where no better mesh is found the run
        continues with the old one, and a warning says so.

        Parameters
        ----------
        part
            Name of the part.
        size
            Edge length of the new elements.
        size_contact
            Edge length where the part presses on something, as at the edge of a tool: elements grow
            from there to those elsewhere. They are made again, too, where edges in contact are more
            than twice as long.
        strain_change
            Plastic strain that may change across an element, such as 0.2: edges are shorter where
            it changes more. Elements are made again, too, where they are more than twice as wide as
            that asks for.
        stress_error
            Error that the stress of an element may have over the mean stress of the part (its root
            mean square), such as 0.1, as estimated by Zienkiewicz and Zhu: edges are shorter where
            it is larger. Elements are made again, too, where they are more than twice as wide as
            that asks for. For slow loads: waves of stress have errors wherever they pass.
        size_least
            Shortest edge length that `strain_change` and `stress_error` ask for.
        quality
            Least scaled Jacobian of an element (1: a rectangle, 0: an angle of 180 degrees) below
            which elements are made again.
        time_step
            Stable step of the part, as a fraction of that after its elements were made, below which
            they are made again.
        interval
            Longest time between two times that elements are made.
        begin
            Time before which nothing is made again.
        elements_most
            Most elements: where `size` would give more, they are larger.
        loss_limit
            Energy that may be lost in all by making elements again, as a fraction of the largest
            total energy: beyond it the run ends.
        """
        raise NotImplementedError

    @section
    def relocate(
        self,
        *,
        part: str,
        quality: Quantity | None = None,
        time_step: Quantity | None = None,
        interval: Quantity | None = None,
        begin: Quantity | None = None,
        loss_limit: Quantity | None = None,
    ) -> Self:
        """A part whose nodes are moved to better places when the form of its elements has become poor,
        or their stable step short: those inside to where elements have the best form, those of the
        outline along it, between its corners and, in 3D, its edges. Elements stay what they are.
        Mass, momenta and stresses go over as with `[[remesh]]`, and what is lost is in
        `energy.remap`. It costs less form than new elements where these are not needed; where the
        part changes its shape altogether, only `[[remesh]]` helps: in 2D a part can have both.

        Parameters
        ----------
        part
            Name of the part.
        quality
            Least scaled Jacobian of an element (1: a rectangle or a cuboid, 0: an angle of 180
            degrees) below which nodes are moved.
        time_step
            Stable step of the part, as a fraction of that after its nodes were moved, below which
            they are moved again.
        interval
            Longest time between two times that nodes are moved.
        begin
            Time before which no node is moved.
        loss_limit
            Energy that may be lost in all by moving nodes, as a fraction of the largest total
            energy: beyond it the run ends.
        """
        raise NotImplementedError

    @section
    def flow(
        self,
        *,
        part: str,
        direction: Quantities | None = None,
        begin: Quantity | None = None,
        travel: Quantity | None = None,
        steady: Quantity | None = None,
        stop: Flag | None = None,
        loss_limit: Quantity | None = None,
    ) -> Self:
        """A part of a 2D model that stays in place while its material flows through it (a
        quasi-Eulerian domain), as in rolling and extrusion. Nodes move with the material and go
        back along the direction of the flow before they are an element away; across it they follow
        the surfaces. What goes out at one end is gone, and what comes in at the other is as it was
        there when the flow began. Mass, momenta and stresses go over as with `[[remesh]]`; the
        history has what is lost as `energy.remap`, and what went out less what came in as
        `energy.flow`. Probes stay with the mesh.

        Parameters
        ----------
        part
            Name of the part: a channel with one inlet, one outlet and a surface on either side.
        direction
            Direction of the flow, any length but zero; of axisymmetric parts along the axis.
        begin
            Time until which the part moves with its material. Nodes then stay where they are.
        travel
            Largest way of a node from its place over the width of an element along the flow, at
            which nodes go back: the rarer, the less is averaged.
        steady
            Largest change of the surfaces and of what the law remembers, such as plastic strain,
            while material passes a quarter of the part, at which its state counts as steady.
        stop
            Whether the run ends when the state is steady.
        loss_limit
            Energy that may be lost in all where nodes go back, as a fraction of the largest total
            energy: beyond it the run ends.
        """
        raise NotImplementedError

    @section
    def symmetry(
        self,
        *,
        normal: Quantities,
        name: str | None = None,
        point: Quantities | None = None,
        parts: Names | None = None,
    ) -> Self:
        """A line of symmetry: nodes that lie on it at the start stay on it.

        Parameters
        ----------
        normal
            Normal of the line; any length but zero.
        name
            Unique name, by which the history has its reaction.
        point
            A point of the line.
        parts
            Parts that it holds.
        """
        raise NotImplementedError

    @section
    def constraint(
        self,
        *,
        on: str,
        name: str | None = None,
        stages: Names | None = None,
        fixed: Literal["x", "y", "z", "rotation"] | Sequence[Literal["x", "y", "z", "rotation"]] | None = None,
        velocity: Components | None = None,
        displacement: Components | None = None,
        acceleration: Components | None = None,
        rotation: ConstraintRotation | None = None,
        spin: Components | None = None,
    ) -> Self:
        """Prescribed motion of a set of nodes: a part, a side such as `plate.left`, or a group of a
        mesh file.

        Parameters
        ----------
        on
            The set.
        name
            Unique name, by which the history has its reaction.
        stages
            Stages in which it acts, one after the other.
        fixed
            Components that don't move; `rotation`: nodes of shells and beams don't rotate either,
            so that they are clamped.
        velocity
            Prescribed velocity of components: a number or a curve, such as `{ x = "1 m/s", y =
            "ramp" }`.
        displacement
            Prescribed displacement of components from the initial position: curves that begin with
            0.
        acceleration
            Prescribed acceleration of components, from the initial velocity on.
        rotation
            Leads the nodes around a point; those of shells and beams rotate with it.
        spin
            Prescribed angular velocity of the nodes of shells and beams, such as `{ z = "2 rad/s"
            }`; in 2D about z.
        """
        raise NotImplementedError

    @section
    def join(
        self,
        *,
        between: Names,
        translation: Quantities | None = None,
        rotation: Quantity | None = None,
        centre: Quantities | None = None,
        axis: Quantities | None = None,
        tolerance: Quantity | None = None,
    ) -> Self:
        """Nodes of two sets that move as one: tied where the sets coincide, periodic where the second
        set is the image of the first by `translation` or `rotation`. Each node of the first set has
        its partner in the second one, and of images also the other way round. A tied contact joins
        meshes that differ.

        Parameters
        ----------
        between
            The two sets: each a part, a side such as `plate.left`, or a group of a mesh file.
        translation
            Leads from the first set to the second: both have the same velocity.
        rotation
            Leads from the first set to the second, counter-clockwise: the velocity of the second is
            that of the first, turned.
        centre
            Centre of the rotation; in 3D a point of its axis.
        axis
            Direction of the axis, in 3D.
        tolerance
            Distance within which nodes are partners.
        """
        raise NotImplementedError

    @section
    def weld(
        self,
        *,
        between: Names,
        at: Points,
        name: str | None = None,
        radius: Quantity | None = None,
        normal: Quantities | None = None,
        normal_strength: Quantity | None = None,
        shear_strength: Quantity | None = None,
        moment_strength: Quantity | None = None,
        exponents: Quantities | None = None,
        filter: Quantity | None = None,
    ) -> Self:
        """Spot welds, rivets and the like: points at which two sets of nodes are rigidly connected, so
        that forces and moments go from one to the other. A set takes part with its nodes near the
        point, of shells with those of their faces; they move as a rigid body in the mean. A weld
        fails for good when (N/N_f)^a + (Q/Q_f)^b + (M/M_f)^c reaches 1, with the tensile force N
        along the normal, the shear force Q and the moment M.

        Parameters
        ----------
        between
            The two sets: each a part, a side such as `plate.top`, or a group of a mesh file; the
            end of a beam as `beam.point1`.
        at
            The points, such as `[[0.1, 0.2, 0]]`; in 2D z is left out.
        name
            Unique name; of several points they are called `NAME_1`, `NAME_2`, ....
        radius
            Nodes of each set within this distance of the point take part.
        normal
            Direction of the normal force, from the first to the second set.
        normal_strength
            N_f: tensile force at which it fails; pressing does no harm.
        shear_strength
            Q_f: shear force at which it fails.
        moment_strength
            M_f: moment at which it fails, bending and torsion together.
        exponents
            a, b and c, such as `[1.5, 1.5, 2]`.
        filter
            Time of a low-pass filter of first order through which the forces go before they are
            compared; 0: they are compared as they are.
        """
        raise NotImplementedError

    @section
    def joint(
        self,
        *,
        between: Names,
        kind: Literal["spherical", "revolute", "cylindrical", "translational", "fixed"],
        at: Quantities,
        name: str | None = None,
        axis: Quantities | None = None,
        radius: Quantity | None = None,
    ) -> Self:
        """Joints between two sets of nodes, or of one with the ground: a point that both share, an
        axis about or along which they can move. They are constraints and not springs. A set takes
        part with its nodes near the point, of a rigid part any of them; they move as a rigid body
        in the mean.

        Parameters
        ----------
        between
            The two sets: each a part, a side such as `door.left`, or a group of a mesh file; one
            alone is joined to the ground.
        kind
            `spherical` and (in 2D the same) `revolute`, which turns about `axis`; `cylindrical`,
            which also slides along it; `translational`, which only slides; `fixed`: nothing.
        at
            The point.
        name
            Unique name.
        axis
            Direction of the axis; it goes with the first set.
        radius
            Nodes of each set within this distance of the point take part.
        """
        raise NotImplementedError

    @section
    def load(
        self,
        *,
        name: str | None = None,
        gravity: Quantities | None = None,
        centrifugal: Quantity | None = None,
        centre: Quantities | None = None,
        axis: Quantities | None = None,
        force: Quantities | None = None,
        moment: Quantities | None = None,
        pressure: Quantity | None = None,
        damping: Quantity | None = None,
        damping_stiffness: Quantity | None = None,
        on: str | None = None,
        parts: Names | None = None,
        curve: str | None = None,
        from_: Quantity | None = None,
        until: Quantity | None = None,
        stages: Names | None = None,
    ) -> Self:
        """What acts on parts, sets of nodes or surfaces from outside. With `curve` a load is
        multiplied by the curve's values, which must be pure numbers.

        Parameters
        ----------
        name
            Unique name, by which the history has its resultant.
        gravity
            Uniform acceleration of parts, such as `[0, "-9.81 m/s^2"]`; in an axisymmetric model
            along y.
        centrifugal
            Angular velocity of a frame in which the model is seen: its parts feel the acceleration
            centrifugal^2 * (x - centre), and no Coriolis force, so they should move slowly in it.
        centre
            The point about which the frame turns, in 3D one of its axis; an axisymmetric model
            turns about its axis.
        axis
            Direction of the axis of `centrifugal`, in 3D.
        force
            Force on a set in all, per metre of depth (of an axisymmetric model in N over the whole
            circumference, of solids in N): shared by length, of solids by area, over a side or a
            group on the outside, equally over other groups.
        moment
            Moment on a set of nodes of shells or beams in all, about x, y and z (in 2D `[0, 0, "5
            N"]`: N m per metre of depth), shared equally: its axes do not rotate with the nodes.
        pressure
            Pressure on a surface, always against its current normal and on its current length;
            negative pulls.
        damping
            Rate of a force -rate * mass * velocity on parts: what moves slowly comes to rest.
        damping_stiffness
            Time beta of a stress beta * C * strain rate in the elements of parts, with their
            elastic stiffness C: a mode of angular frequency omega is damped by beta * omega / 2 of
            the critical. It shortens the step from dt to sqrt(beta^2 + dt^2) - beta, and acts
            during the whole run.
        on
            Where it acts: a side such as `plate.top`, a group of a mesh file; of a pressure also a
            part, its whole outside.
        parts
            Parts that it acts on.
        curve
            Name of a curve by whose value it is multiplied (the angular velocity of `centrifugal`).
        from_
            Time at which the damping begins.
        until
            Time at which it ends.
        stages
            Stages in which it acts, one after the other.
        """
        raise NotImplementedError

    @section
    def cavity(
        self,
        *,
        name: str,
        on: Names,
        ambient: Quantity,
        pressure: Quantity | None = None,
        exponent: Quantity | None = None,
        temperature: Quantity | None = None,
        gas_constant: Quantity | None = None,
        inflow: Sequence[Inflow] | None = None,
        vents: Sequence[Vents] | None = None,
    ) -> Self:
        """Gas at one pressure in a closed surface: an airbag, a tyre, a can, a bellows. Its volume is
        that which the surface encloses now, its pressure p V^exponent = constant while nothing
        flows in or out, and the difference to the pressure outside acts on the surface. Rims of the
        surface must lie on planes of `[[symmetry]]`, or on the axis of an axisymmetric model.

        Parameters
        ----------
        name
            Unique name.
        on
            The surface, from the side of the gas: sides such as `tank.inner` or `bag.lower`, groups
            of a mesh file, or parts, their whole outsides.
        ambient
            Pressure outside, absolute: the gas acts with its pressure less this.
        pressure
            Pressure of the gas at the start, absolute.
        exponent
            Ratio of the specific heats, 1 or more: the gas is adiabatic. With 1 it keeps its
            temperature.
        temperature
            Temperature of the gas at the start.
        gas_constant
            Specific gas constant R, that of air left out: 8.314 J/mol/K over the molar mass.
        inflow
            Gas of the same kind that flows in, as from an inflator.
        vents
            Openings through which gas flows out, into the pressure outside.
        """
        raise NotImplementedError

    @section
    def non_reflecting(
        self,
        *,
        on: str,
    ) -> Self:
        """A surface that takes waves up as if the body continued behind it, by dashpots for plane
        waves across it: what meets it at an angle is reflected in part. It doesn't hold the body in
        place.

        Parameters
        ----------
        on
            A side such as `soil.bottom`, a line group of a mesh file, or a part, its whole outside.
        """
        raise NotImplementedError

    @section
    def spring(
        self,
        *,
        between: Names,
        stiffness: Quantity | None = None,
        elongation: Quantities | None = None,
        force: Quantities | None = None,
        damping: Quantity | None = None,
        length: Quantity | None = None,
        strength: Quantity | None = None,
    ) -> Self:
        """Springs and dampers between two sets of nodes: each node of the larger set with the nearest
        one of the other. Numbers are those of each, per metre of depth (of an axisymmetric model
        over the whole circumference; between solids whole ones, in N/m, N s/m and N). Their energy
        is counted with that of the elements.

        Parameters
        ----------
        between
            The two sets: each a part, a side such as `plate.left`, or a group of a mesh file.
        stiffness
            Force per elongation, such as `"1e6 N/m/m"`, between solids `"1e6 N/m"`.
        elongation
            Elongations, ascending.
        force
            Force at each elongation; constant before the first and after the last.
        damping
            Force per rate of elongation.
        length
            Length without force.
        strength
            Force of the spring, pulling or pushing, above which it breaks with its damper; its
            energy counts as dissipated.
        """
        raise NotImplementedError

    @section
    def point_mass(
        self,
        *,
        on: str,
        mass: Quantity,
    ) -> Self:
        """Mass without volume on nodes: it belongs to their part, falls with it, and makes rigid parts
        heavier.

        Parameters
        ----------
        on
            A part, a side such as `plate.top`, or a group of a mesh file.
        mass
            Mass in all per metre of depth (of an axisymmetric model over the whole circumference;
            of solids the whole, kg), shared equally by the nodes.
        """
        raise NotImplementedError

    @section
    def curve(
        self,
        name: str,
        *,
        time: Quantities | None = None,
        value: Quantities | None = None,
        between: Literal["lines", "smooth_steps"] | None = None,
        sine: Sine | None = None,
        expression: Text | None = None,
        stage: str | None = None,
    ) -> Self:
        """A function of time, named where something follows it: by points (`time` and `value`;
        constant before the first and after the last), a `sine`, or a formula (`expression`). The
        name begins with a letter.

        Parameters
        ----------
        time
            Times, ascending.
        value
            Values, as many: of one dimension, or bare numbers in the SI unit of what uses the
            curve.
        between
            What leads from point to point: straight lines, or steps without velocity and
            acceleration at their ends.
        sine
            A wave.
        expression
            A formula of the time `t` in s, such as `"2*sin(3*t) + exp(-t)"`, in the SI unit of what
            uses the curve: numbers, `+ - * / ^`, parentheses, `pi`, `sin`, `cos`, `exp`, `ln`,
            `sqrt`, `abs`, `min`, `max`, and `step(x)`, which is 0 for x < 0, else 1.
        stage
            Stage from whose beginning its times count; until then it has its value at zero.
        """
        raise NotImplementedError

    @section
    def probe(
        self,
        *,
        name: str,
        part: str | None = None,
        point: Quantities | None = None,
        kind: Literal["material", "place"] | None = None,
        node: Integer | None = None,
        element: Integer | None = None,
        set: str | None = None,
        fields: Literal["displacement", "velocity", "contact_force", "contact_pressure", "contact_shear", "contact_gap", "contact_slip", "contact_status", "friction_heat", "stress", "von_mises", "pressure", "principal_stress", "principal_direction", "triaxiality", "lode_angle", "strain_log", "strain_green", "velocity_gradient", "plastic_strain", "temperature", "damage", "alive", "membrane_force", "bending_moment", "transverse_force", "thickness", "stress_bottom", "stress_middle", "stress_top", "von_mises_bottom", "von_mises_middle", "von_mises_top", "plastic_strain_bottom", "plastic_strain_middle", "plastic_strain_top", "thinning", "director", "beam_force", "beam_moment", "density", "energy_density", "element_quality", "stable_step"] | Sequence[Literal["displacement", "velocity", "contact_force", "contact_pressure", "contact_shear", "contact_gap", "contact_slip", "contact_status", "friction_heat", "stress", "von_mises", "pressure", "principal_stress", "principal_direction", "triaxiality", "lode_angle", "strain_log", "strain_green", "velocity_gradient", "plastic_strain", "temperature", "damage", "alive", "membrane_force", "bending_moment", "transverse_force", "thickness", "stress_bottom", "stress_middle", "stress_top", "von_mises_bottom", "von_mises_middle", "von_mises_top", "plastic_strain_bottom", "plastic_strain_middle", "plastic_strain_top", "thinning", "director", "beam_force", "beam_moment", "density", "energy_density", "element_quality", "stable_step"]] | None = None,
        extreme: Literal["max", "min"] | None = None,
        place: Flag | None = None,
        position: Literal["element", "node"] | None = None,
    ) -> Self:
        """A place whose position, velocity and acceleration are written to the history as `NAME.x`,
        `NAME.vx`, `NAME.ax` and so on: the node of `part` nearest to `point`, node number `node` of
        `part`, or the mean over `set`, which has its `NAME.spin` too. With `fields` also values of
        fields, such as `NAME.von_mises`, `NAME.stress_xx`: those of elements as the mean over the
        elements at the node, or of `element` alone, or the `extreme` in a set.

        Parameters
        ----------
        name
            Unique name.
        part
            Part of `point`, `node` or `element`.
        point
            Initial position; the nearest node is taken, in a part whose elements are made again the
            material at the point.
        kind
            Whether the probe follows the material at the point, or watches this place: then the
            history has the velocity and the fields of what of the part is there, `NaN` where
            nothing is, and no position or acceleration.
        node
            Number of the node in its part, from 0.
        element
            Number of the element in its part, from 0: its fields alone.
        set
            A part, a side such as `plate.top`, or a group of a mesh file.
        fields
            Fields whose values are written, of whole tensors and vectors all components.
        extreme
            Whether the largest or the smallest value of each field in the set is written, of
            elements that are there.
        place
            Whether the history also has the place of each extreme, as `NAME.FIELD_at_x` and so on:
            of its node, or of the middle of its element.
        position
            What the values of fields of elements are of: elements, or nodes, each with the mean
            over the elements at it by their volumes.
        """
        raise NotImplementedError

    @section
    def cut(
        self,
        *,
        name: str,
        point: Quantities,
        normal: Quantities,
        radius: Quantity | None = None,
        parts: Names | None = None,
    ) -> Self:
        """A plane (in 2D a line) through deformable parts at the start, or with `radius` a disc (a
        piece of the line), which moves with the elements that it cuts: the history has the force
        and the moment that the side to which the normal points exerts on the other one, by elements
        and by springs, welds, joints and ties. Contacts and loads do not count.

        Parameters
        ----------
        name
            Unique name.
        point
            A point of the plane.
        normal
            Its normal; any length but zero. Tension is a force along it.
        radius
            Elements are cut only where the middle of what the plane cuts of them is so near
            `point`: one wall of a ring or a frame.
        parts
            Parts that it cuts, and whose connections count.
        """
        raise NotImplementedError

    @section
    def channel(
        self,
        *,
        name: str,
        expression: Text,
        filter: Literal["CFC 60", "CFC 180", "CFC 600", "CFC 1000"] | None = None,
        corner: Quantity | None = None,
    ) -> Self:
        """A formula of the history's columns, found after the run: `channels.csv` has its values,
        `summary.json` its largest, smallest and last one. Later channels may use earlier ones.

        Parameters
        ----------
        name
            Unique name.
        expression
            A formula, such as `"A.y - B.y"`: names of columns, `t`, numbers, `+ - * / ^`,
            parentheses, the functions of curves, and those of whole columns that
            [results](output.md#channels) lists, such as `cfc60(A.ax)`, `integral`, `hic15`.
        filter
            Channel frequency class of SAE J211 and ISO 6487 by which the values are filtered,
            without phase.
        corner
            Frequency at which a Butterworth filter of fourth order without phase damps the values
            by 3 dB.
        """
        raise NotImplementedError

    @section
    def output(
        self,
        *,
        fields: Quantity | None = None,
        history: Quantity | None = None,
        forces: Literal["mean", "sample"] | None = None,
        hash_steps: Integer | None = None,
        include: Literal["displacement", "velocity", "contact_force", "contact_pressure", "contact_shear", "contact_gap", "contact_slip", "contact_status", "friction_heat", "stress", "von_mises", "pressure", "principal_stress", "principal_direction", "triaxiality", "lode_angle", "strain_log", "strain_green", "velocity_gradient", "plastic_strain", "temperature", "damage", "alive", "membrane_force", "bending_moment", "transverse_force", "thickness", "stress_bottom", "stress_middle", "stress_top", "von_mises_bottom", "von_mises_middle", "von_mises_top", "plastic_strain_bottom", "plastic_strain_middle", "plastic_strain_top", "thinning", "director", "beam_force", "beam_moment", "density", "energy_density", "element_quality", "stable_step"] | Sequence[Literal["displacement", "velocity", "contact_force", "contact_pressure", "contact_shear", "contact_gap", "contact_slip", "contact_status", "friction_heat", "stress", "von_mises", "pressure", "principal_stress", "principal_direction", "triaxiality", "lode_angle", "strain_log", "strain_green", "velocity_gradient", "plastic_strain", "temperature", "damage", "alive", "membrane_force", "bending_moment", "transverse_force", "thickness", "stress_bottom", "stress_middle", "stress_top", "von_mises_bottom", "von_mises_middle", "von_mises_top", "plastic_strain_bottom", "plastic_strain_middle", "plastic_strain_top", "thinning", "director", "beam_force", "beam_moment", "density", "energy_density", "element_quality", "stable_step"]] | None = None,
        mirror: Literal["x", "y", "z"] | Sequence[Literal["x", "y", "z"]] | None = None,
        pictures: Flag | None = None,
        picture_field: Literal["displacement", "velocity", "contact_force", "contact_pressure", "contact_shear", "contact_gap", "contact_slip", "contact_status", "friction_heat", "stress", "von_mises", "pressure", "principal_stress", "principal_direction", "triaxiality", "lode_angle", "strain_log", "strain_green", "velocity_gradient", "plastic_strain", "temperature", "damage", "alive", "membrane_force", "bending_moment", "transverse_force", "thickness", "stress_bottom", "stress_middle", "stress_top", "von_mises_bottom", "von_mises_middle", "von_mises_top", "plastic_strain_bottom", "plastic_strain_middle", "plastic_strain_top", "thinning", "director", "beam_force", "beam_moment", "density", "energy_density", "element_quality", "stable_step"] | None = None,
        picture_view: PictureView | None = None,
        camera: Camera | None = None,
    ) -> Self:
        """What is written.

        Parameters
        ----------
        fields
            How often the fields are written: a count (of each stage), or an interval such as `"0.1
            ms"`; 0: not at all, and no pictures of bodies.
        history
            How often a row of the history is written: a count (of each stage) or an interval.
        forces
            What rows of the history have of forces, moments and accelerations: the mean over the
            interval since the row before, of which nothing is missed, or the value at the row's
            time.
        hash_steps
            Steps between two lines of `hashes.csv`, by which `embate diff` finds where two runs
            diverge; 0: none are written.
        include
            Fields to write.
        mirror
            Pictures also show the model mirrored at the line (in 3D the plane) x = 0 (`"x"`), y = 0
            (`"y"`), in 3D z = 0 (`"z"`), or several of them.
        pictures
            Whether pictures and the animation are made.
        picture_field
            Field that colours the pictures.
        picture_view
            What pictures and animation show; `embate check` draws the whole mesh all the same.
        camera
            From where pictures of a 3D model look at it.
        """
        raise NotImplementedError
