//! Messages of STL files.

use embate_solver::message::{Example, Message};

pub(crate) static MESSAGES: &[&Message] = &[&STL, &SHEET];

pub(super) static SHEET: Message = Message {
    code: "E0241",
    title: "triangles of an STL file that are no surface of a shell",
    example: Example::Shell(
        "printf 'solid two\\n facet normal 0 0 1\\n outer loop\\n vertex 0 0 0\\n vertex 1 0 0\\n vertex 1 1 0\\n endloop\\n endfacet\\n facet normal 0 0 -1\\n \
            outer loop\\n vertex 0 0 0\\n vertex 0 1 0\\n vertex 1 1 0\\n endloop\\n endfacet\\nendsolid two\\n' > two.stl\n\
         embate check model.toml --set 'part=[{name=\"b\",material=\"steel\",element=\"shell3\",section={thickness=0.01},mesh={file=\"two.stl\",group=\"all\"}}]' \
            --set 'contact=[]'\n",
    ),
    cause: "Two triangles look to different sides of the surface, or lie on each other, or all are smaller than the tolerance.",
    remedy: "Make normals consistent and remove what is there twice, in the program that made the file; look at its unit (`scale`) and at `tolerance`.",
};

pub(super) static STL: Message = Message {
    code: "E0240",
    title: "a file that is no STL file, or a damaged one",
    example: Example::Shell(
        "printf 'solid one\\n facet normal 0 0 1\\n outer loop\\n vertex -1 -1 0\\n vertex 1 -1 0\\n' > cut.stl\n\
         embate check model.toml --set 'part=[{name=\"b\",material=\"steel\",box={corner=[0,0,0],size=[1,1,1],elements=[1,1,1]}}]' --set 'contact=[]' --set 'obstacle=[{stl={file=\"cut.stl\"}}]'\n",
    ),
    cause: "The file was cut, changed by a text tool, or is of another format; or its number of triangles, or a coordinate, is none.",
    remedy: "Export the surface again, as STL (text or binary).",
};
