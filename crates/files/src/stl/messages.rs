//! Messages of STL files.

use embate_solver::message::{Example, Message};

pub(crate) static MESSAGES: &[&Message] = &[&STL];

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
