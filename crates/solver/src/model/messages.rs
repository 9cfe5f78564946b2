//! Messages of what a model says, wherever it says it; `check/` raises them, and readers of files those that
//! are public.

use crate::message::{Example, Message};

pub(crate) static MESSAGES: &[&Message] = &[
    &RANGE,
    &NAME,
    &UNKNOWN_NAME,
    &TWICE,
    &CLASH,
    &LIST_LENGTH,
    &LIST_ORDER,
    &PERIOD,
    &NO_DIRECTION,
    &OF_REVOLUTION,
    &OUTPUT_TOO_MUCH,
    &NOTHING,
    &NOT_IN_SPACE,
    &THIRD,
    &FORMULA,
    &NO_REMESHING,
    &COARSE_CHANNEL,
];

/// A number is out of its range.
pub static RANGE: Message = Message {
    code: "E0110",
    title: "a number is out of its range",
    example: Example::Model("[run]\nsafety = 1.5\n"),
    cause: "The value is not one that the quantity can have: a negative density, Poisson's ratio of 0.5, a number that is not finite.",
    remedy: "Give a value within the range that the message names; look at the sign, the power of ten and the unit.",
};

/// A name can't be one.
pub static NAME: Message = Message {
    code: "E0115",
    title: "a name can't be one",
    example: Example::Model("[material.\"mild steel\"]\nlaw = \"elastic\"\ndensity = 7800\nyoung = \"200 GPa\"\npoisson = 0.3\n"),
    cause: "Names become columns of tables, file names, and the first half of `part.side`; so they are plain.",
    remedy: "Use letters, digits, `_` and `-`, at most 64 of them.",
};

/// Nothing has this name.
pub static UNKNOWN_NAME: Message = Message {
    code: "E0116",
    title: "nothing that could stand here has this name",
    example: Example::Model("[[contact]]\nname = \"hit\"\nbetween = [\"block.rigth\", \"wall.left\"]\n"),
    cause: "A key refers to a part, side, group, material, curve, law or field by a name that nothing has, that \
        several things have, or that belongs to a thing of another kind.",
    remedy: "Take the name that the message suggests, or look at `embate list` for those of laws, elements, searches and fields.",
};

/// A name that two things have.
pub static TWICE: Message = Message {
    code: "E0117",
    title: "the same name twice",
    example: Example::Model("[[contact]]\nname = \"hit\"\nbodies = [\"block\", \"block\"]\n"),
    cause: "Two things of one kind have one name, or a list names one thing twice.",
    remedy: "Give each thing its own name, and name each once.",
};

/// Keys that contradict each other.
pub static CLASH: Message = Message {
    code: "E0113",
    title: "keys that don't go together",
    example: Example::Model("[[contact]]\nname = \"hit\"\nbetween = [\"block.right\", \"wall.left\"]\nbodies = \"all\"\n"),
    cause: "Keys of one table contradict each other, or one of them needs another that is missing.",
    remedy: "Leave out one of those that contradict, or add the one that is missing; the message names them.",
};

/// A list has the wrong length.
pub static LIST_LENGTH: Message = Message {
    code: "E0112",
    title: "a list has the wrong length",
    example: Example::Model("[curve.push]\ntime = [0, \"1 ms\"]\nvalue = [0, \"1 m/s\", \"2 m/s\"]\n"),
    cause: "The list is empty, has too few or too many values, or not as many as the list that it belongs to.",
    remedy: "Give as many values as the message says.",
};

pub(crate) static LIST_ORDER: Message = Message {
    code: "E0118",
    title: "a list is not in order",
    example: Example::Model("[curve.push]\ntime = [0, \"2 ms\", \"1 ms\"]\nvalue = [0, \"1 m/s\", \"2 m/s\"]\n"),
    cause: "Times of a curve, gaps of a pressure or plastic strains of a table must ascend; two equal ones would \
        give one point two values.",
    remedy: "Give each once, in ascending order; for a jump, two times close to each other.",
};

pub(crate) static PERIOD: Message = Message {
    code: "E0119",
    title: "an end that is not after its beginning",
    example: Example::Model("[run]\nstep_limit = \"1 ms\"\n"),
    cause: "A time at which something ends is not after that at which it begins, or the least time step allowed is \
        as long as the whole run.",
    remedy: "Look at the units of the two times.",
};

pub(crate) static NO_DIRECTION: Message = Message {
    code: "E0120",
    title: "a direction is a zero vector",
    example: Example::Model("[[obstacle]]\nname = \"ground\"\nplane = { point = [0, \"-1 mm\"], normal = [0, 0] }\n"),
    cause: "A normal of [0, 0] points nowhere. A camera whose `up` is the direction from which it looks does not know what is up.",
    remedy: "Give a vector such as [0, 1]; its length does not matter.",
};

pub(crate) static OF_REVOLUTION: Message = Message {
    code: "E0121",
    title: "not in an axisymmetric body",
    example: Example::Model(
        "[[part]]\nname = \"block\"\nmaterial = \"steel\"\nstress_state = \"axisymmetric\"\nspin = \"10 rad/s\"\n\
         rectangle = { corner = [0, 0], size = [\"10 mm\", \"10 mm\"], elements = [2, 2] }\n\n\
         [[part]]\nname = \"wall\"\nmaterial = \"steel\"\nstress_state = \"axisymmetric\"\n\
         rectangle = { corner = [0, \"-20 mm\"], size = [\"10 mm\", \"10 mm\"], elements = [2, 2] }\n\n\
         [[contact]]\nname = \"hit\"\nbodies = \"all\"\n",
    ),
    cause: "An axisymmetric model is the same all around the axis x = 0: nothing can act across the axis or rotate \
        in the plane, and all parts must be axisymmetric.",
    remedy: "Let it act along the axis y, or compute a plane model.",
};

pub(crate) static OUTPUT_TOO_MUCH: Message = Message {
    code: "E0122",
    title: "more output than any disk holds",
    example: Example::Model("[output]\nfields = \"1 fs\"\n"),
    cause: "The interval is so short that there would be more than a million field files or a hundred million rows.",
    remedy: "Give a smaller count or a longer interval; look at its unit.",
};

pub(crate) static NOTHING: Message = Message {
    code: "E0123",
    title: "there must be at least one",
    example: Example::Words("A program that makes its models itself leaves out all parts; of a model file that is E0104."),
    cause: "A model without parts, a part without elements, or a count of 0.",
    remedy: "Give at least one.",
};

pub(crate) static NOT_IN_SPACE: Message = Message {
    code: "E0125",
    title: "3D models don't have this",
    example: Example::Model(
        "[[part]]\nname = \"solid\"\nmaterial = \"steel\"\nbox = { corner = [0, 0, 0], size = [1, 1, 1], elements = [1, 1, 1] }\n\n\
         [[contact]]\nname = \"hit\"\nbodies = \"all\"\n\n\
         [[obstacle]]\nname = \"ball\"\nparts = \"solid\"\ncircle = { centre = [0, -2, 0], radius = 1 }\n",
    ),
    cause: "A table or key belongs to 2D models; solids don't have it.",
    remedy: "Leave it out, or do what the message proposes.",
};

pub(crate) static THIRD: Message = Message {
    code: "E0126",
    title: "a third component in 2D",
    example: Example::Model("[[load]]\ngravity = [0, -9.81, 1]\n"),
    cause: "All parts are 2D, but a vector has a component along z, or something is held, moved or turned out of the plane.",
    remedy: "Leave it out, or make the parts solid: `extrude` them, or give them a 3D shape.",
};

pub(crate) static FORMULA: Message = Message {
    code: "E0127",
    title: "a formula of a channel that can't be read",
    example: Example::Model(
        "[run]\nend = \"1 us\"\n\n[[part]]\nname = \"bar\"\nmaterial = \"steel\"\nvelocity = [\"1 m/s\", 0]\n\
         rectangle = { corner = [0, 0], size = [\"10 mm\", \"2 mm\"], elements = [4, 1] }\n\n[[probe]]\nname = \"bar\"\nset = \"bar\"\n\n\
         [[channel]]\nname = \"c\"\nexpression = \"bar.q\"\n\n[[contact]]\nname = \"self\"\nbodies = \"all\"\n",
    ),
    cause: "The formula names a column that the history does not have, or a function that there is not, or is not written as one.",
    remedy: "Take names from the first line of `history.csv`; `docs/output.md` lists the columns and functions.",
};

pub(crate) static NO_REMESHING: Message = Message {
    code: "E0128",
    title: "elements that can't be made again",
    example: Example::Model("[[remesh]]\npart = \"block\"\n\n[[contact]]\nname = \"hit\"\nbodies = \"all\"\nformulation = \"segment\"\n"),
    cause: "`[[remesh]]`, `[[relocate]]` or `[[flow]]` names a part, or stands in a model, with something that does not go over to new \
        elements or moved nodes yet: the message says what.",
    remedy: "Do what the message proposes, or leave the section out.",
};

pub(crate) static COARSE_CHANNEL: Message = Message {
    code: "W0127",
    title: "a filter for which the rows of the history are too far apart",
    example: Example::Model(
        "[run]\nend = \"0.1 s\"\n\n[[part]]\nname = \"bar\"\nmaterial = \"steel\"\nvelocity = [\"1 m/s\", 0]\n\
         rectangle = { corner = [0, 0], size = [\"10 mm\", \"2 mm\"], elements = [4, 1] }\n\n[[probe]]\nname = \"bar\"\nset = \"bar\"\n\n\
         [[channel]]\nname = \"c\"\nexpression = \"bar.ax\"\nfilter = \"CFC 1000\"\n\n[output]\nhistory = 10\n\n\
         [[contact]]\nname = \"self\"\nbodies = \"all\"\n",
    ),
    cause: "A filter of a channel frequency class needs ten rows in the time 1/CFC, one with a corner six in its period (SAE J211).",
    remedy: "Write rows of the history more often, as the message proposes.",
};
