//! Messages of mesh files, of Gmsh and of decks.

use embate_solver::message::{Example, Message};

pub(crate) static MESSAGES: &[&Message] = &[&MESH_FILE, &FORMAT, &DAMAGED, &ELEMENT_TYPE, &PHYSICAL_GROUP, &NODE, &CELL];

pub(crate) static MESH_FILE: Message = Message {
    code: "E0220",
    title: "a mesh file that can't be read",
    example: Example::Model(
        "[[part]]\nname = \"block\"\nmaterial = \"steel\"\nmesh = { file = \"nowhere.msh\", group = \"block\" \
            }\n\n[[contact]]\nname = \"self\"\nbodies = \"all\"\n",
    ),
    cause: "There is no such file, it may not be read, or the `scale` of its unit is no length.",
    remedy: "Paths begin at the folder of the model file.",
};

pub(super) static FORMAT: Message = Message {
    code: "E0221",
    title: "a file that is no mesh of Gmsh 2.2 or 4.1",
    example: Example::Gmsh("$MeshFormat\n3.1 0 8\n$EndMeshFormat\n"),
    cause: "It is another file, or of a version of the format that is not read.",
    remedy: "Save it again with Gmsh: gmsh OLD.msh -save -format msh41 -o NEW.msh",
};

pub(super) static DAMAGED: Message = Message {
    code: "E0222",
    title: "a mesh file that is damaged",
    example: Example::Gmsh("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0\n"),
    cause: "The file was cut, changed by hand or by a text tool, or its counts don't agree.",
    remedy: "Export the mesh again.",
};

pub(super) static ELEMENT_TYPE: Message = Message {
    code: "E0223",
    title: "elements of a type that can't be computed",
    example: Example::Gmsh(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"block\"\n$EndPhysicalNames\n\
         $Nodes\n5\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n$EndNodes\n$Elements\n1\n1 7 2 1 1 1 2 3 4 5\n$EndElements\n",
    ),
    cause: "A physical group holds pyramids or elements beyond the second order.",
    remedy: "Mesh with Mesh.ElementOrder = 1 or 2, and with hexahedra, prisms or tetrahedra instead of pyramids, or take them out of the group.",
};

pub(super) static PHYSICAL_GROUP: Message = Message {
    code: "E0224",
    title: "physical groups that make no bodies",
    example: Example::Gmsh(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n1 1 \"block\"\n$EndPhysicalNames\n\
         $Nodes\n2\n1 0 0 0\n2 1 0 0\n$EndNodes\n$Elements\n1\n1 1 2 1 1 1 2\n$EndElements\n",
    ),
    cause: "No group has volumes, triangles or quadrilaterals, or two groups have one name.",
    remedy: "Put the surfaces of each plane body, the volumes of each solid, into a physical group of its own name.",
};

pub(crate) static NODE: Message = Message {
    code: "E0225",
    title: "a node that is missing, there twice, or not in the plane",
    example: Example::Gmsh(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"block\"\n$EndPhysicalNames\n\
         $Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 1\n$EndNodes\n$Elements\n1\n1 2 2 1 1 1 2 3\n$EndElements\n",
    ),
    cause: "The file was put together by hand, the geometry of 2D bodies does not lie in z = 0, or the volumes of \
        solids are in no group.",
    remedy: "Move 2D bodies into the plane of x and y, give the elements of solids a group, and export the mesh again.",
};

pub(crate) static CELL: Message = Message {
    code: "E0226",
    title: "an element without area or volume, with crossing sides, or there twice",
    example: Example::Gmsh(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"block\"\n$EndPhysicalNames\n\
         $Nodes\n3\n1 0 0 0\n2 1 0 0\n3 2 0 0\n$EndNodes\n$Elements\n1\n1 2 2 1 1 1 2 3\n$EndElements\n",
    ),
    cause: "Its nodes lie on a line, of a solid in a plane, on one another, or not in order around it.",
    remedy: "Mesh again, or merge nodes that are there twice.",
};
