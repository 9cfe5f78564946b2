//! Messages of the program itself: its command line, and how commands end.

use embate_solver::message::{Example, Message};

pub(crate) static MESSAGES: &[&Message] = &[
    &USAGE,
    &NO_NAME,
    &NO_CODE,
    &NO_RESULTS,
    &NOTHING_IN_COMMON,
    &SOURCE_IN_THE_WAY,
    &RUNS_FAILED,
    &NO_CASE,
    &CHECKS_FAILED,
    &IGNORED,
    &NOT_AGAIN,
    &NO_PAGE,
];

pub(crate) static USAGE: Message = Message {
    code: "E0802",
    title: "a command line that can't be understood",
    example: Example::Command("run"),
    cause: "An argument is missing, unknown, or has a value that it can't have.",
    remedy: "`embate COMMAND --help` lists the arguments of a command.",
};

pub(crate) static NO_NAME: Message = Message {
    code: "E0803",
    title: "a path that names no folder",
    example: Example::Command("new .."),
    cause: "The new model is named after the last part of the path, and this one has none.",
    remedy: "Give a name, such as embate new my-model.",
};

pub(crate) static NO_CODE: Message = Message {
    code: "E0804",
    title: "no message has this code",
    example: Example::Command("explain E9999"),
    cause: "The code is misspelt, or of another version of the program.",
    remedy: "`embate explain` lists all codes.",
};

pub(crate) static NO_RESULTS: Message = Message {
    code: "E0811",
    title: "nothing that identifies a run",
    example: Example::Command("diff . ."),
    cause: "The folder is not one of results, or its run was killed before it left anything, or it kept no hashes \
        (`output.hash_steps = 0`) and has not ended.",
    remedy: "Give the folders that `embate run` wrote, the one with summary.json.",
};

pub(crate) static NOTHING_IN_COMMON: Message = Message {
    code: "E0812",
    title: "two runs that can't be compared",
    example: Example::Shell(
        "embate run model.toml --out coarse --quiet\nsed 's/\\[2, 2\\]/[3, 3]/; s/\\[2, 4\\]/[3, 6]/' model.toml > \
            fine.toml\nembate run fine.toml --out fine --quiet\nembate diff coarse fine\n",
    ),
    cause: "Nodes are held against each other by part and number; here no part of one run has its name and its elements in the other.",
    remedy: "Compare runs of one mesh; for others compare histories and fields.",
};

pub(crate) static NOT_AGAIN: Message = Message {
    code: "W0811",
    title: "runs that can't be gone over once more",
    example: Example::Shell(
        "embate run model.toml --out before --quiet\nsed -i 's/7800/7900/' model.toml\nembate run model.toml --out \
            after --quiet\nembate diff before after || true\n",
    ),
    cause: "The step and the node at which two runs diverge are found by going over both once more, and that needs \
        the models that ran; without them the report relies on the logs.",
    remedy: "Put the model back as it was, or name the one that ran with --model-a or --model-b.",
};

pub(crate) static SOURCE_IN_THE_WAY: Message = Message {
    code: "E0913",
    title: "an import that would write over its deck",
    example: Example::Shell(
        "mkdir decks\ncat > decks/mesh.inp <<END\n*NODE\n1, 0, 0\n2, 0.01, 0\n3, 0.01, 0.01\n4, 0, 0.01\n*ELEMENT, \
            TYPE=CPE4, ELSET=body\n1, 1, 2, 3, 4\n*SOLID SECTION, ELSET=body, MATERIAL=steel\n*MATERIAL, \
            NAME=steel\n*DENSITY\n7800\n*ELASTIC\n200e9, 0.3\n*STEP\n*DYNAMIC, EXPLICIT\n, 1e-4\n*END \
            STEP\nEND\nembate import decks/mesh.inp --out decks\n",
    ),
    cause: "The mesh of the model is written as mesh.inp into the folder of the model.",
    remedy: "Choose another folder with --out.",
};

pub(crate) static RUNS_FAILED: Message = Message {
    code: "E0906",
    title: "runs of a sweep failed",
    example: Example::Shell("embate sweep model.toml --vary run.step_limit=1ns,1us --out swept --quiet\n"),
    cause: "The rows of the table say for each run why it failed; the message has the first.",
    remedy: "Run the model with those values alone (embate run --set KEY=VALUE) and look at its last state.",
};

pub(crate) static NO_CASE: Message = Message {
    code: "E0923",
    title: "no such case of verification",
    example: Example::Command("verify --in ."),
    cause: "The folder holds no cases, or none of the wanted name or tier.",
    remedy: "Go to the folder of embate's source, or name the folder of the cases with --in; `embate verify --list` lists what is there.",
};

pub(crate) static CHECKS_FAILED: Message = Message {
    code: "E0924",
    title: "checks of verification fail",
    example: Example::Shell(
        "mkdir -p cases/hit\ncp model.toml cases/hit/model.toml\ncat > cases/hit/expected.toml <<END\ntitle = \"a \
            block hits a wall\"\ntier = \"every\"\n\n[[check]]\nname = \"kinetic energy at the start, \
            J/m\"\nquantity = { history = \"energy.kinetic\", at = \"0 s\" }\nexpect = 38\ntolerance = 1e-9\nreason \
            = \"half of 0.78 kg/m times the square of 10 m/s\"\nEND\nembate verify --in cases --quiet\n",
    ),
    cause: "A number of a run is farther from the known one than its tolerance.",
    remedy: "The lines above say by how much; --out keeps the runs to look at.",
};

pub(crate) static IGNORED: Message = Message {
    code: "W0910",
    title: "an imported model that is not the whole deck",
    example: Example::Deck(
        "*NODE\n1, 0, 0\n2, 0.01, 0\n3, 0.01, 0.01\n4, 0, 0.01\n*ELEMENT, TYPE=CPE4, ELSET=body\n1, 1, 2, 3, \
            4\n*SOLID SECTION, ELSET=body, MATERIAL=steel\n*MATERIAL, NAME=steel\n*DENSITY\n7800\n*ELASTIC\n200e9, \
            0.3\n*EXPANSION\n1.2e-5\n*STEP\n*DYNAMIC, EXPLICIT\n, 1e-4\n*END STEP\n",
    ),
    cause: "Something of the deck does not act in the model; import.txt says what.",
    remedy: "Read import.txt, and add to the model what is missing.",
};

pub(crate) static NO_PAGE: Message = Message {
    code: "E0821",
    title: "the page can't be shown",
    example: Example::Shell("embate run model.toml --out out --quiet\nembate view out --no-open --token short\n"),
    cause: "The port is taken by another program, the address is not one of this machine, or the token is too short.",
    remedy: "Leave out --port, --listen and --token: a free port of this machine and a token that cannot be guessed are taken.",
};
