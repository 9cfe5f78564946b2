//! Messages of cases with known answers.

use embate_solver::message::{Example, Message};

pub(crate) static MESSAGES: &[&Message] = &[&CASE, &UNJUDGED, &QUANTITY];

pub(super) static CASE: Message = Message {
    code: "E0920",
    title: "models of a case that don't fit",
    example: Example::Words("A check of expected.toml names a model that the case does not have."),
    cause: "A variant or check names a model that is not there, or a model that no check looks at.",
    cure: "Correct the names in expected.toml.",
};

pub(super) static UNJUDGED: Message = Message {
    code: "E0921",
    title: "a check that can't be judged",
    example: Example::Words("A check of expected.toml has two tolerances."),
    cause: "It has no tolerance or several, or asks for one number of what has many.",
    cure: "Write the check as docs/verification.md says.",
};

pub(super) static QUANTITY: Message = Message {
    code: "E0922",
    title: "a quantity that a run does not have",
    example: Example::Words("A check of expected.toml looks at a probe that the model does not have."),
    cause: "The history has no such column, the fields no such name, the summary no such key, or there is nothing in the box.",
    cure: "Take one that is there; the message lists some.",
};
