//! Messages of cases with known answers.

use embate_solver::message::{Example, Message};

pub(crate) static MESSAGES: &[&Message] = &[&CASE, &UNJUDGED, &QUANTITY];

pub(super) static CASE: Message = Message {
    code: "E0920",
    title: "models of a case that don't fit",
    example: Example::Shell(
        "mkdir -p cases/hit\ncp model.toml cases/hit/model.toml\ncat > cases/hit/expected.toml <<END\ntitle = \"a \
            block hits a wall\"\ntier = \"every\"\n\n[[check]]\nname = \"kinetic energy at the start, J/m\"\nmodel = \"other\"\nquantity \
            = { history = \"energy.kinetic\", at = \"0 s\" }\nexpect = 39\ntolerance = 1e-9\nreason = \"half of 0.78 \
            kg/m times the square of 10 m/s\"\nEND\nembate verify --in cases --quiet\n",
    ),
    cause: "A variant or check names a model that is not there, or a model that no check looks at.",
    remedy: "Correct the names in expected.toml.",
};

pub(super) static UNJUDGED: Message = Message {
    code: "E0921",
    title: "a check that can't be evaluated",
    example: Example::Shell(
        "mkdir -p cases/hit\ncp model.toml cases/hit/model.toml\ncat > cases/hit/expected.toml <<END\ntitle = \"a \
            block hits a wall\"\ntier = \"every\"\n\n[[check]]\nname = \"kinetic energy at the start, \
            J/m\"\nquantity = { history = \"energy.kinetic\", at = \"0 s\" }\nexpect = 39\ntolerance = \
            1e-9\ntolerance_relative = 1e-3\nreason = \"half of 0.78 kg/m times the square of 10 m/s\"\nEND\nembate \
            verify --in cases --quiet\n",
    ),
    cause: "It has no tolerance or several, or asks for one number of what has many.",
    remedy: "Write the check as docs/verification.md says.",
};

pub(super) static QUANTITY: Message = Message {
    code: "E0922",
    title: "a quantity that a run does not have",
    example: Example::Shell(
        "mkdir -p cases/hit\ncp model.toml cases/hit/model.toml\ncat > cases/hit/expected.toml <<END\ntitle = \"a \
            block hits a wall\"\ntier = \"every\"\n\n[[check]]\nname = \"kinetic energy at the start, \
            J/m\"\nquantity = { history = \"energy.kinetc\", at = \"0 s\" }\nexpect = 39\ntolerance = 1e-9\nreason = \"half \
            of 0.78 kg/m times the square of 10 m/s\"\nEND\nembate verify --in cases --quiet\n",
    ),
    cause: "The history has no such column, the fields no such name, the summary no such key, or there is nothing in the box.",
    remedy: "Take one that is there; the message lists some.",
};
