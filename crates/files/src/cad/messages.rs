//! Messages of meshes that Gmsh makes of CAD files.

use embate_solver::message::{Example, Message};

pub(crate) static MESSAGES: &[&Message] = &[&NO_GMSH, &GMSH_FAILED, &GEOMETRY];

pub(super) static NO_GMSH: Message = Message {
    code: "E0930",
    title: "Gmsh is not there",
    example: Example::Shell("echo solid > bracket.step\nembate mesh bracket.step --size '2 mm' --gmsh nowhere/gmsh\n"),
    cause: "`embate mesh` calls the program Gmsh, which makes the mesh; embate does not contain it.",
    remedy: "Install Gmsh (https://gmsh.info, the package `gmsh` of the system, or `pip install gmsh`), or name the program with \
        --gmsh or in the environment variable EMBATE_GMSH.",
};

pub(super) static GMSH_FAILED: Message = Message {
    code: "E0931",
    title: "Gmsh made no mesh",
    example: Example::Shell("echo solid > bracket.step\nembate mesh bracket.step --size '2 mm' --gmsh false\n"),
    cause: "The program ended with an error, took longer than --timeout, or wrote no mesh. The message has the last that it said.",
    remedy: "Read what Gmsh says. A larger --size needs less time; faces that are smaller than it, or damaged, are repaired in the CAD \
        program.",
};

pub(super) static GEOMETRY: Message = Message {
    code: "E0932",
    title: "a CAD file that can't be meshed",
    example: Example::Command("mesh model.toml --size 2mm"),
    cause: "There is no such file, it is no STEP, IGES or BREP file, it holds no volume, or the size of elements is no length.",
    remedy: "Export the body as a solid, as STEP for example.",
};
