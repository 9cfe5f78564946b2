//! Messages of the program itself: its command line, and how commands end.

use embate_solver::message::{Example, Message};

pub(crate) static MESSAGES: &[&Message] =
    &[&USAGE, &NO_NAME, &NO_CODE, &SOURCE_IN_THE_WAY, &RUNS_FAILED, &NO_CASE, &CHECKS_FAILED, &IGNORED];

pub(crate) static USAGE: Message = Message {
    code: "E0802",
    title: "a command line that can't be understood",
    example: Example::Command("run"),
    cause: "An argument is missing, unknown, or has a value that it can't have.",
    cure: "`embate COMMAND --help` tells the arguments of a command.",
};

pub(crate) static NO_NAME: Message = Message {
    code: "E0803",
    title: "a path that names no folder",
    example: Example::Command("new .."),
    cause: "The new model is named after the last part of the path, and this one has none.",
    cure: "Give a name, such as embate new my-model.",
};

pub(crate) static NO_CODE: Message = Message {
    code: "E0804",
    title: "no message has this code",
    example: Example::Command("explain E9999"),
    cause: "The code is misspelt, or of another version of the program.",
    cure: "`embate explain` lists all codes.",
};

pub(crate) static SOURCE_IN_THE_WAY: Message = Message {
    code: "E0913",
    title: "an import that would write over its deck",
    example: Example::Words("A deck called mesh.inp is imported into its own folder."),
    cause: "The mesh of the model is written as mesh.inp into the folder of the model.",
    cure: "Choose another folder with --out.",
};

pub(crate) static RUNS_FAILED: Message = Message {
    code: "E0906",
    title: "runs of a sweep failed",
    example: Example::Words("One of the values of a sweep makes a contact so stiff that the run ends by its energy drift."),
    cause: "The rows of the table say for each run why it failed; the message has the first.",
    cure: "Run the model with those values alone (embate run --set KEY=VALUE) and look at its last state.",
};

pub(crate) static NO_CASE: Message = Message {
    code: "E0923",
    title: "no such case of verification",
    example: Example::Command("verify --in ."),
    cause: "The folder holds no cases, or none of the wanted name or tier.",
    cure: "Go to the folder of embate's source, or name the folder of the cases with --in; `embate verify --list` tells what is there.",
};

pub(crate) static CHECKS_FAILED: Message = Message {
    code: "E0924",
    title: "checks of verification fail",
    example: Example::Words("A model of a case is changed, and its answer is no longer the known one."),
    cause: "A number of a run is farther from the known one than its tolerance.",
    cure: "The lines above say by how much; --out keeps the runs to look at.",
};

pub(crate) static IGNORED: Message = Message {
    code: "W0910",
    title: "an imported model that is not the whole deck",
    example: Example::Words("A deck has a keyword that the model can do without, such as an output request of a kind that is not there."),
    cause: "Something of the deck does not act in the model; import.txt says what.",
    cure: "Read import.txt, and add to the model what is missing.",
};
