//! Messages of checkpoints, and of runs that continue with them.

use embate_solver::message::{Example, Message};

pub(crate) static MESSAGES: &[&Message] =
    &[&DAMAGED, &VERSION, &RESULTS_CHANGED, &IN_USE, &MODEL_CHANGED, &NO_CHECKPOINT, &OLDER, &LAST_GOOD, &NO_STATES];

pub(super) static DAMAGED: Message = Message {
    code: "E0711",
    title: "a damaged checkpoint",
    example: Example::Shell(
        "embate run model.toml --out out --quiet --set run.checkpoint_steps=4 --set run.max_steps=9\ntruncate -s \
            1000 out/checkpoint/*.embate\nembate resume out\n",
    ),
    cause: "A check sum of the file is not that of its bytes: the disk, a copy or another program changed it.",
    remedy: "Put the file back from a copy, or run the model again.",
};

pub(super) static VERSION: Message = Message {
    code: "E0712",
    title: "a checkpoint of another version",
    example: Example::Shell(
        "mkdir -p out/checkpoint\nprintf \
            'embate\\r\\n\\001\\000\\000\\000\\023\\000\\000\\000{\"version\":\"0.0.9\"}\\273\\112\\134\\321' > \
            out/checkpoint/000000000008.embate\nembate resume out\n",
    ),
    cause: "What a state holds changes from version to version, and a continued run must give the same bits.",
    remedy: "Continue with the version that the message names, or run the model again.",
};

/// Results are not as a checkpoint knows them.
pub(crate) static RESULTS_CHANGED: Message = Message {
    code: "E0713",
    title: "results that are not as the checkpoint knows them",
    example: Example::Shell(
        "embate run model.toml --out out --quiet --set run.checkpoint_steps=4 --set run.max_steps=9\nsed -i 2d \
            out/history.csv\nembate resume out\n",
    ),
    cause: "A continued run appends to its files, so that they become those of a run that was never stopped; that \
        can't be where they have changed.",
    remedy: "Put the file back as it was, or run the model again.",
};

/// Another run writes there.
pub(crate) static IN_USE: Message = Message {
    code: "E0714",
    title: "results that another run writes",
    example: Example::Shell(
        "embate run model.toml --out out --quiet --set run.checkpoint_steps=4 --set run.max_steps=9\nflock \
            out/run.lock embate resume out\n",
    ),
    cause: "Two runs that write into one folder, or to one file, would spoil it. The lock (`run.lock`) is the \
        system's and ends with the run, also with one that is killed.",
    remedy: "Wait for the other run, stop it first, or choose another folder with --out.",
};

/// The model is not the one that ran.
pub static MODEL_CHANGED: Message = Message {
    code: "E0715",
    title: "a model that is not the one that began the run",
    example: Example::Shell(
        "embate run model.toml --out out --quiet --set run.checkpoint_steps=4 --set run.max_steps=9\nsed -i \
            's/7800/7900/' model.toml\nembate resume out\n",
    ),
    cause: "A state is one of its model. End, limits, checkpoints and output may change; the message lists what else has.",
    remedy: "Undo the changes, or run the changed model from the start.",
};

/// Nothing to continue from.
pub static NO_CHECKPOINT: Message = Message {
    code: "E0716",
    title: "nothing to continue from",
    example: Example::Command("resume results"),
    cause: "The folder is not there, is none of results, or its run kept no checkpoint: it was shorter than five \
        seconds, or `run.checkpoint = 0` switches them off.",
    remedy: "Run the model; `embate replay` needs no checkpoint.",
};

/// An older checkpoint is used.
pub static OLDER: Message = Message {
    code: "W0711",
    title: "an older checkpoint instead of a damaged one",
    example: Example::Shell(
        "embate run model.toml --out out --quiet --set run.checkpoint_steps=4 --set run.max_steps=9\ntruncate -s \
            1000 out/checkpoint/000000000008.embate\nembate resume out --quiet\n",
    ),
    cause: "A check sum of the newest file is not that of its bytes; two are kept for this.",
    remedy: "Nothing is lost: the run does the steps between the two once more. Look after the disk.",
};

/// The state of a failed run could not be kept.
pub static LAST_GOOD: Message = Message {
    code: "W0712",
    title: "the last good step of a failed run could not be kept",
    example: Example::Words("A run fails because the disk is full, and its last good state does not fit on it either."),
    cause: "The run fails again before its last good step, or the state can't be written.",
    remedy: "Continue from the checkpoint before, or look at the last written state.",
};

/// A state that no one had asked for could not be written.
pub(crate) static NO_STATES: Message = Message {
    code: "W0713",
    title: "checkpoints could not be written",
    example: Example::Words("A long run keeps checkpoints without being asked, and the disk has no room for one."),
    cause: "The system refused to write one; its own words are in the message. The run continued without.",
    remedy: "Free some space, or switch them off with `run.checkpoint = 0`; with `run.checkpoint` set, a run ends there.",
};
