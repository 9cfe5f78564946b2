//! Messages of reading files of described keys: the model file, and `expected.toml` of verification.

use embate_solver::message::{Example, Message};

pub(crate) static MESSAGES: &[&Message] =
    &[&FILE, &ENCODING, &SYNTAX, &MISSING_SECTION, &FORM, &UNKNOWN_KEY, &MISSING_KEY, &TYPE, &UNIT, &CHOICE, &OVERRIDE, &OUTSIDE];

pub(super) static FILE: Message = Message {
    code: "E0101",
    title: "a model file that can't be read",
    example: Example::Command("check nowhere.toml"),
    cause: "There is no such file, it may not be read, or it is far too large for a model.",
    remedy: "Check the path; a folder stands for the model.toml in it. Large meshes belong into mesh files.",
};

pub(super) static ENCODING: Message = Message {
    code: "E0102",
    title: "a file that is not UTF-8",
    example: Example::Shell("printf '# gr\\374n\\n' > old.toml\nembate check old.toml\n"),
    cause: "The bytes at the place shown are no text in UTF-8.",
    remedy: "Save the file with the encoding UTF-8.",
};

pub(super) static SYNTAX: Message = Message {
    code: "E0103",
    title: "a file that is not TOML",
    example: Example::File("[run]\nend = 10 ms\n"),
    cause: "A bracket or quote is missing, a text or a number with a unit stands without quotes, or a key or section is there twice.",
    remedy: "Fix the place that is shown; numbers with units stand in quotes, for example \"10 ms\".",
};

pub(super) static MISSING_SECTION: Message = Message {
    code: "E0104",
    title: "a section is missing",
    example: Example::File(
        "[material.steel]\nlaw = \"elastic\"\ndensity = 7800\nyoung = \"200 GPa\"\npoisson = 0.3\n\n\
         [[part]]\nname = \"block\"\nmaterial = \"steel\"\nrectangle = { corner = [0, 0], size = [\"10 mm\", \"10 mm\"], elements = [2, 2] }\n",
    ),
    cause: "A model needs `[run]`, a material and a part.",
    remedy: "Add the section; `embate new NAME` makes a model that has all of them.",
};

pub(super) static FORM: Message = Message {
    code: "E0105",
    title: "a section in the wrong brackets",
    example: Example::Model("[probe]\nname = \"p\"\nset = \"block\"\n"),
    cause: "What there may be several of stands in double brackets, what stands once in single ones, and materials \
        and curves have their names in the header.",
    remedy: "Write the header as the message shows it.",
};

pub(super) static UNKNOWN_KEY: Message = Message {
    code: "E0106",
    title: "a key that is not known here",
    example: Example::Model("[run]\nsafty = 0.8\n"),
    cause: "The key is misspelt, belongs into another section, or goes with another law or shape.",
    remedy: "Take the key that the message suggests; docs/model-file.md has all of them.",
};

pub(super) static MISSING_KEY: Message = Message {
    code: "E0107",
    title: "a key is missing",
    example: Example::Model("[[probe]]\nset = \"block\"\n"),
    cause: "The section can't do without the key, and there is no sensible default.",
    remedy: "Add it as the message shows.",
};

pub(super) static TYPE: Message = Message {
    code: "E0108",
    title: "a value of the wrong type",
    example: Example::Model("[run]\nmax_steps = \"many\"\n"),
    cause: "A text stands where a number must be, a number where a list must be, or the like.",
    remedy: "Write the value as the message shows it.",
};

pub(super) static UNIT: Message = Message {
    code: "E0109",
    title: "a unit that is missing, unknown or of another quantity",
    example: Example::Model("[run]\nend = \"10 mm\"\n"),
    cause: "A number in quotes needs a unit of the quantity of its key. Numbers without quotes are in SI units.",
    remedy: "Take a unit of that quantity; docs/model-file.md lists them.",
};

pub(super) static CHOICE: Message = Message {
    code: "E0111",
    title: "a value that is none of the choices",
    example: Example::Model("[material.steel]\nlaw = \"elastik\"\n"),
    cause: "The key takes one of some words.",
    remedy: "Take the one that the message suggests; `embate list` names laws, elements, searches and formulations.",
};

pub(super) static OVERRIDE: Message = Message {
    code: "E0114",
    title: "an override that can't be applied",
    example: Example::Command("check model.toml --set contact.7.friction=0.1"),
    cause: "The path of --set, or of a value of a sweep, leads to nothing in the model.",
    remedy: "Write the path as keys stand in the file: run.end, material.steel.young, part.block.velocity; things of \
        a list by name or number.",
};

pub(crate) static OUTSIDE: Message = Message {
    code: "E0124",
    title: "a file outside of the model's folder",
    example: Example::Model(
        "[[part]]\nname = \"block\"\nmaterial = \"steel\"\nmesh = { file = \"../block.msh\", group = \"block\" \
            }\n\n[[contact]]\nname = \"self\"\nbodies = \"all\"\n",
    ),
    cause: "A model, or a deck that it names, names a file that does not lie in its folder or below: by `..`, by an absolute path, or by a symbolic link. \
            A model from somebody else must not read your other files unasked.",
    remedy: "Put the file into the folder, or add --allow-outside to the command. Resume, replay and continued \
        sweeps need the option again: the permission is never stored in a file.",
};
