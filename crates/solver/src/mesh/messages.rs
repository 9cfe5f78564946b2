//! Messages of bodies: their shapes, elements and surfaces.

use crate::message::{Example, Message};

pub(crate) static MESSAGES: &[&Message] = &[
    &SHAPE,
    &UNMESHABLE,
    &TOO_MANY,
    &NO_ELEMENT,
    &SAME_PLACE,
    &GROUP,
    &BAD_ELEMENT,
    &NOT_A_SURFACE,
    &OVERLAP,
    &BARS,
    &SHELLS,
    &BEAMS,
    &NEGATIVE_RADIUS,
    &DIMENSION,
    &TINY_STEP,
    &NOT_ON_SHELLS,
    &ABOUT_NORMAL,
    &NOTHING_CUT,
    &CUT_LEAVES_OUT,
    &SIZES,
    &REDUCED,
];

pub(crate) static SHAPE: Message = Message {
    code: "E0201",
    title: "the dimensions of a shape contradict each other",
    example: Example::Model(
        "[[part]]\nname = \"ring\"\nmaterial = \"steel\"\nring = { centre = [0, 0], inner = \"50 mm\", outer = \"44 mm\", elements = [2, 16] }\n\n\
         [[contact]]\nname = \"self\"\nbodies = \"all\"\n",
    ),
    cause: "There is no body with these dimensions: an inner radius larger than the outer one, an outline that \
        crosses itself, two points in one place.",
    remedy: "Correct the key that the message names.",
};

pub(crate) static UNMESHABLE: Message = Message {
    code: "E0202",
    title: "a shape can't be meshed",
    example: Example::Model(
        "[[part]]\nname = \"hook\"\nmaterial = \"steel\"\n\
         path = { points = [[0, 0], [\"10 mm\", 0], [\"10 mm\", \"10 mm\"]], width = \"2 mm\", radius = \"30 mm\", elements = [2, 10] }\n\n\
         [[contact]]\nname = \"self\"\nbodies = \"all\"\n",
    ),
    cause: "The outline is sound, but elements fold over or become too many or too small in it.",
    remedy: "Move the points apart, take smaller radii, or mesh the body with Gmsh.",
};

pub(crate) static TOO_MANY: Message = Message {
    code: "E0203",
    title: "too many elements or nodes",
    example: Example::Model(
        "[[part]]\nname = \"block\"\nmaterial = \"steel\"\nrectangle = { corner = [0, 0], size = [\"1 mm\", \"1 \
            mm\"], elements = [20000, 20000] }\n",
    ),
    cause: "The model has more elements than the program takes.",
    remedy: "Take larger elements; fine ones only where something happens (`grading`).",
};

pub(crate) static NO_ELEMENT: Message = Message {
    code: "E0204",
    title: "an element that does not fit the mesh",
    example: Example::Model(
        "[[part]]\nname = \"block\"\nmaterial = \"steel\"\nelement = \"bar2\"\narea = \"1 mm\"\nrectangle = { corner \
            = [0, 0], size = [\"1 mm\", \"1 mm\"], elements = [2, 2] }\n",
    ),
    cause: "The mesh of the part has cells with another number of corners than its element has.",
    remedy: "Take an element with as many corners (`embate list elements`), or leave `element` out.",
};

pub(crate) static SAME_PLACE: Message = Message {
    code: "E0205",
    title: "copies of a body lie on each other",
    example: Example::Model(
        "[[part]]\nname = \"block\"\nmaterial = \"steel\"\nrectangle = { corner = [0, 0], size = [\"10 mm\", \"10 mm\"], elements = [2, 2] }\n\
         copies = { count = 3, angle = \"180 deg\" }\n\n[[contact]]\nname = \"self\"\nbodies = \"all\"\n",
    ),
    cause: "Without a translation, after a full turn a copy is where the first body is.",
    remedy: "Take fewer copies, another angle, or a translation.",
};

pub(crate) static GROUP: Message = Message {
    code: "E0206",
    title: "a group of a mesh file can't be a body",
    example: Example::Gmsh(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 1 \"block\"\n2 2 \"body\"\n$EndPhysicalNames\n$Nodes\n3\n1 \
            0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n$Elements\n2\n1 1 2 1 1 1 2\n2 2 2 2 1 1 2 3\n$EndElements\n",
    ),
    cause: "Parts are made of groups of surfaces, parts of bars of groups of lines.",
    remedy: "Name another group, or correct the physical groups in Gmsh and mesh again.",
};

pub(crate) static BAD_ELEMENT: Message = Message {
    code: "E0207",
    title: "an element that is inside out, without area or with a corner beyond 180 degrees",
    example: Example::Gmsh(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"block\"\n$EndPhysicalNames\n\
         $Nodes\n4\n1 0 0 0\n2 10 0 0\n3 2 2 0\n4 0 10 0\n$EndNodes\n$Elements\n1\n1 3 2 1 1 1 2 3 4\n$EndElements\n",
    ),
    cause: "Corners of an element do not turn counter-clockwise everywhere, so that its map has no positive volume at some point.",
    remedy: "Fix the mesh at the place that the message names: other corners, more elements, or triangles.",
};

pub(crate) static NOT_A_SURFACE: Message = Message {
    code: "E0208",
    title: "lines that are no surface of a body",
    example: Example::Words(
        "A program that makes its meshes itself calls a line inside of a body a surface, or names one twice; of a \
            mesh file such lines are a set of nodes.",
    ),
    cause: "Contact, pressure and boundaries act on the outside of bodies: lines that bound the elements of one part, each once.",
    remedy: "Name a side of a part, or a group of lines on its outside.",
};

pub(crate) static OVERLAP: Message = Message {
    code: "E0209",
    title: "elements that overlap",
    example: Example::Gmsh(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"block\"\n$EndPhysicalNames\n$Nodes\n5\n1 0 0 \
            0\n2 2 0 0\n3 1 1 0\n4 1 2 0\n5 1 -1 0\n$EndNodes\n$Elements\n3\n1 2 2 1 1 1 2 3\n2 2 2 1 1 1 2 4\n3 2 2 \
            1 1 2 1 5\n$EndElements\n",
    ),
    cause: "An edge in 2D, and a facet in 3D, belongs to two elements at most, which lie on its two sides.",
    remedy: "Remove elements that are there twice, and turn those that are clockwise or inside out.",
};

pub(crate) static BARS: Message = Message {
    code: "E0210",
    title: "what bars can't be",
    example: Example::Model(
        "[[part]]\nname = \"rod\"\nmaterial = \"steel\"\nelement = \"bar2\"\ntruss = { points = [[0, 0], [\"10 mm\", 0]], lines = [[0, 1]] }\n\n\
         [[contact]]\nname = \"self\"\nbodies = \"all\"\n",
    ),
    cause: "Bars have a cross-section, a stress along their line and no other, and no surface that something could touch.",
    remedy: "Give `area`, an isotropic solid as the law, and name other parts in contacts, obstacles and pressures.",
};

pub(crate) static SHELLS: Message = Message {
    code: "E0213",
    title: "what shells need, and what they can't be",
    example: Example::Model(
        "[[part]]\nname = \"sheet\"\nmaterial = \"steel\"\nelement = \"shell2\"\nline = { points = [[0, 0], [\"10 mm\", 0]], elements = 4 }\n\n\
         [[contact]]\nname = \"self\"\nbodies = \"all\"\n",
    ),
    cause: "Shells have a section with a thickness, and layers through it of a law that can bear a stress along them.",
    remedy: "Give `section`, a solid as the law, and leave out what the message names.",
};

pub(crate) static BEAMS: Message = Message {
    code: "E0214",
    title: "what beams need, and what they can't be",
    example: Example::Model(
        "[[part]]\nname = \"mast\"\nmaterial = \"steel\"\nelement = \"beam2\"\n\
         space_truss = { lines = [[[0, 0, 0], [0, 0, \"1 m\"]]], elements = 4 }\n",
    ),
    cause: "Beams are lines in 3D with a cross-section, of a law that is the same in all directions.",
    remedy: "Give `profile` with the sizes of its shape, an isotropic solid as the law, and leave out what the message names; in 2D take `shell2`.",
};

pub(crate) static NEGATIVE_RADIUS: Message = Message {
    code: "E0211",
    title: "an axisymmetric body left of the axis",
    example: Example::Model(
        "[[part]]\nname = \"block\"\nmaterial = \"steel\"\nstress_state = \"axisymmetric\"\nrectangle = { corner = [\"-1 mm\", 0], size = [\"10 mm\", \"10 mm\"], elements = [2, 2] }\n\n\
         [[contact]]\nname = \"self\"\nbodies = \"all\"\n",
    ),
    cause: "In an axisymmetric model x is the radius, which is never negative.",
    remedy: "Move the part to the right of the axis x = 0; only one half of the section is modelled.",
};

pub(crate) static DIMENSION: Message = Message {
    code: "E0212",
    title: "2D and 3D parts in one model",
    example: Example::Model(
        "[[part]]\nname = \"block\"\nmaterial = \"steel\"\nrectangle = { corner = [0, 0], size = [\"10 mm\", \"10 mm\"], elements = [2, 2] }\n\n\
         [[part]]\nname = \"wall\"\nmaterial = \"steel\"\nrectangle = { corner = [0, \"-20 mm\"], size = [\"10 mm\", \"10 mm\"], elements = [2, 2] }\n\
         extrude = { length = \"5 mm\", elements = 1 }\n\n[[contact]]\nname = \"hit\"\nbodies = \"all\"\n",
    ),
    cause: "A model is 2D, with forces per metre of depth, or 3D. A part is a solid if its shape is one (`box`, \
        `cylinder`, `tube`, `sphere`, a group of volumes of a mesh file), or by `extrude` or `revolve`.",
    remedy: "Make all parts solids, or none.",
};

pub(crate) static NOT_ON_SHELLS: Message = Message {
    code: "W0202",
    title: "a setting that does not act where it is asked for: on shells and beams, or on solids",
    example: Example::Model(
        "[run]\nend = \"1 us\"\nbulk_viscosity = [0.06, 1.2]\n\n[[part]]\nname = \"sheet\"\nmaterial = \"steel\"\nelement = \"shell2\"\n\
         section = { thickness = \"1 mm\" }\nvelocity = [\"1 m/s\", 0]\nline = { points = [[0, 0], [\"10 mm\", 0]], elements = 4 }\n\n\
         [[contact]]\nname = \"self\"\nbodies = \"all\"\n",
    ),
    cause: "Shells and beams have no bulk viscosity, are evaluated in every step with `subcycling` too, and get no mass in the run; \
        nodes of solids have no rotations that could be held.",
    remedy: "Nothing, where it is meant for other parts; else leave it out.",
};

pub(crate) static NOTHING_CUT: Message = Message {
    code: "E0215",
    title: "a cut that goes through no element whose forces are known",
    example: Example::Model(
        "[run]\nend = \"1 us\"\n\n[[part]]\nname = \"bar\"\nmaterial = \"steel\"\nvelocity = [\"1 m/s\", 0]\n\
         rectangle = { corner = [0, 0], size = [\"10 mm\", \"2 mm\"], elements = [4, 1] }\n\n[[cut]]\nname = \"middle\"\n\
         point = [\"50 mm\", 0]\nnormal = [1, 0]\n\n[[contact]]\nname = \"self\"\nbodies = \"all\"\n",
    ),
    cause: "The plane of a `[[cut]]` lies beside the parts, its `radius` ends before them, or these are rigid: there is no force in \
        elements to report.",
    remedy: "Move `point` into a deformable part, or give a larger `radius`; of rigid parts the forces of contacts and drives are in the history.",
};

pub(crate) static CUT_LEAVES_OUT: Message = Message {
    code: "W0205",
    title: "a cut that leaves out what carries force across its plane",
    example: Example::Model(
        "[run]\nend = \"2 us\"\n\n[[part]]\nname = \"sheet\"\nmaterial = \"steel\"\n\
         rectangle = { corner = [0, 0], size = [\"10 mm\", \"2 mm\"], elements = [5, 2] }\n\n\
         [[part]]\nname = \"die\"\nmaterial = \"steel\"\nrigid = true\nvelocity = [0, \"-20 m/s\"]\n\
         rectangle = { corner = [0, \"2.01 mm\"], size = [\"10 mm\", \"2 mm\"], elements = [5, 1] }\n\n\
         [[cut]]\nname = \"middle\"\npoint = [\"5 mm\", 0]\nnormal = [1, 0]\n\n[[contact]]\nname = \"hit\"\nbodies = \"all\"\n",
    ),
    cause: "A rigid part lies across the plane of a `[[cut]]` without `parts`, and forces in it are not known; or a spring, a joint, a \
        weld or a tie crosses the plane from one of its `parts` to a part that they do not name.",
    remedy: "Name in `parts` all parts that are meant, and no others; or end the cut with `radius`.",
};

pub(crate) static ABOUT_NORMAL: Message = Message {
    code: "W0203",
    title: "a moment about the normal of a shell, or a rotation about it that is left free",
    example: Example::Model(
        "[run]\nend = \"1 us\"\n\n[[part]]\nname = \"sheet\"\nmaterial = \"steel\"\nelement = \"shell4\"\n\
         section = { thickness = \"1 mm\" }\nrectangle = { corner = [0, 0], size = [\"10 mm\", \"10 mm\"], elements = [2, 2] }\n\n\
         [[load]]\nmoment = [0, 0, \"1 N m\"]\non = \"sheet.left\"\n\n[[contact]]\nname = \"self\"\nbodies = \"all\"\n",
    ),
    cause: "A smooth shell has no stiffness against the rotation of its nodes about its normal: a moment about it spins them faster and \
        faster, and a rotation that is held about one axis alone slips as soon as the normal leans towards that axis.",
    remedy: "Let forces in the plane take the place of the moment, or hold the rotation about the normal too.",
};

pub(crate) static TINY_STEP: Message = Message {
    code: "W0201",
    title: "an element with a far shorter stable step than the others of its part",
    example: Example::Model(
        "[run]\nend = \"1e-12 s\"\n\n[[part]]\nname = \"spike\"\nmaterial = \"steel\"\nvelocity = [\"10 m/s\", 0]\n\
         polygon = { outline = [[\"40 mm\", 0], [\"50 mm\", 0], [\"45 mm\", \"1 nm\"], [\"40 mm\", \"10 mm\"]], size = \"2 mm\" }\n\n\
         [[contact]]\nname = \"self\"\nbodies = \"all\"\n",
    ),
    cause: "All elements wait for the one with the shortest stable step, which goes with its smallest height: a \
        corner or a node just beside an edge makes a sliver. Reported from a factor of 1000 on.",
    remedy: "Fix the outline or the mesh at the place that the message names; or make such elements heavier with `run.mass_scaling`.",
};

pub(crate) static SIZES: Message = Message {
    code: "W0204",
    title: "a size that looks like one in another unit",
    example: Example::Model(
        "[run]\nend = \"200 s\"\n\n[[part]]\nname = \"block\"\nmaterial = \"steel\"\nvelocity = [1, 0]\n\
         rectangle = { corner = [0, 0], size = [20000, 10000], elements = [4, 2] }\n\n[[contact]]\nname = \"self\"\nbodies = \"all\"\n",
    ),
    cause: "The whole model is larger than 10 km or smaller than 1 µm; or the elements of a part of a mesh file are more than 300 times, \
        and the part is more than 30 times, larger or smaller than all that is not of the file; or a shell is thinner than a 2000th of the \
        length of its elements, or thicker than its part is long.",
    remedy: "Write lengths with their unit: a number without one is in m. Of a mesh file `scale` is the unit of its lengths, \
        such as `scale = \"1 mm\"`.",
};

pub(crate) static REDUCED: Message = Message {
    code: "W0206",
    title: "elements of second order are computed by their corners",
    example: Example::Gmsh(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"block\"\n$EndPhysicalNames\n$Nodes\n8\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0.5 0 0\n6 1 0.5 0\n7 0.5 1 0\n\
         8 0 0.5 0\n$EndNodes\n$Elements\n1\n1 16 2 1 1 1 2 3 4 5 6 7 8\n$EndElements\n",
    ),
    cause: "Of elements with nodes between their corners only the tetrahedron of ten nodes is computed; of others the corners are kept, and \
        their edges become straight.",
    remedy: "Nothing, if the mesh is fine enough for that; else mesh with elements of first order, or with tetrahedra of ten nodes.",
};
