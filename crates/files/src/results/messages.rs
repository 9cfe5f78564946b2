//! Messages of writing results and pictures.

use embate_solver::message::{Example, Message};

pub(crate) static MESSAGES: &[&Message] = &[
    &EXISTS,
    &NOT_A_FOLDER,
    &REFUSED,
    &LINK,
    &NO_FILE,
    &FRAME,
    &PICTURE,
    &DAMAGED_LOG,
    &NO_RUN,
    &UNREADABLE,
    &NOTHING_TO_SEE,
    &RENUMBERED,
    &BUG,
    &NO_PICTURES,
    &NO_POST_MORTEM,
    &NO_CHANNELS,
];

/// Something is in the way.
pub static EXISTS: Message = Message {
    code: "E0702",
    title: "something is in the way",
    example: Example::Shell("embate run model.toml --out out --quiet\nembate run model.toml --out out\n"),
    cause: "The folder or file holds something that would be lost.",
    remedy: "Choose another place with --out, or replace what is there with --force.",
};

pub(super) static NOT_A_FOLDER: Message = Message {
    code: "E0703",
    title: "a file where a folder must be",
    example: Example::Command("run model.toml --out model.toml"),
    cause: "Results are a folder, and the path leads to a file.",
    remedy: "Choose another place with --out.",
};

/// The system refused.
pub static REFUSED: Message = Message {
    code: "E0704",
    title: "the system refused to write or read a file",
    example: Example::Command("run model.toml --out model.toml/results"),
    cause: "The disk is full, the folder may not be written to, or a part of the path is a file; the system's own \
        words are in the message.",
    remedy: "Free some space, or choose another folder with --out.",
};

/// Nothing is written through it.
pub(crate) static LINK: Message = Message {
    code: "E0707",
    title: "a symbolic link where embate writes",
    example: Example::Shell("mkdir -p out elsewhere\nln -s ../elsewhere out/fields\nembate run model.toml --out out\n"),
    cause: "A file or folder that embate makes itself is a symbolic link, which embate never makes: what is written \
        there, or removed, would be somewhere else.",
    remedy: "Remove the link, or choose another folder. The folder that --out names may be a link itself.",
};

/// It is not opened.
pub(crate) static NO_FILE: Message = Message {
    code: "E0708",
    title: "a named pipe, socket or device in place of a file",
    example: Example::Shell("embate run model.toml --out out --quiet\nrm out/history.csv\nmkfifo out/history.csv\nembate report out\n"),
    cause: "A file of a folder of results is none: reading it could wait for ever, or never end.",
    remedy: "Remove it, and put the file back from a copy or run the model again.",
};

pub(super) static FRAME: Message = Message {
    code: "E0705",
    title: "a frame that can't be written",
    example: Example::Words("A program that writes VTU files itself gives a field with another number of values than the mesh has."),
    cause: "Values, cells and nodes of a frame do not fit each other.",
    remedy: "If embate itself wrote the frame, report it with the model file.",
};

pub(crate) static PICTURE: Message = Message {
    code: "E0706",
    title: "a picture that can't be made",
    example: Example::Words("A program that draws frames itself asks for a field that they don't have."),
    cause: "The field is not in the frames, a value is not finite, or the encoder refused.",
    remedy: "Take a field that is recorded (`output.include`), or leave pictures out (`pictures = false`).",
};

/// A log is not as the run left it.
pub(crate) static DAMAGED_LOG: Message = Message {
    code: "E0721",
    title: "a damaged record of a run",
    example: Example::Shell(
        "embate run model.toml --out one --quiet --set output.hash_steps=2\nembate run model.toml --out two --quiet \
            --set output.hash_steps=2\nsed -i '2s/1/2/' two/hashes.csv\nembate diff one two\n",
    ),
    cause: "A line of `hashes.csv` is not the one that its check sum was made of, or `run.json` can't be read: the \
        disk, a copy or another program changed the file.",
    remedy: "Put the file back from a copy, or run the model again. Without the file the end states are compared all the same.",
};

/// A field file is not as it was written.
pub(crate) static UNREADABLE: Message = Message {
    code: "E0731",
    title: "a field file that can't be read",
    example: Example::Words("`embate view results/ball` where `fields/frame-00003.vtu` was cut off by a copy that failed."),
    cause: "The file was damaged, cut off, or written by another program: only field files as embate writes them are read.",
    remedy: "Put the file back from a copy, or run the model again. All other frames can be looked at.",
};

/// Numbers of nodes and elements that change from frame to frame.
pub(crate) static RENUMBERED: Message = Message {
    code: "E0733",
    title: "nodes and elements that have other numbers in other frames",
    example: Example::Words("A click on a node in `embate view` of a run of a model with `[[remesh]]`, whose value over time is wanted."),
    cause: "Elements were made again in the run, so the node or element of a number is not the same one in all frames.",
    remedy: "Give the model a `[[probe]]` at a point: it follows the material there. Fields and sections can be looked at all the same.",
};

/// A folder without frames.
pub static NOTHING_TO_SEE: Message = Message {
    code: "E0732",
    title: "results without anything to look at",
    example: Example::Shell("mkdir empty\nembate view empty\n"),
    cause: "The folder is not one of results, or its run has not written its first frame, or wrote no fields.",
    remedy: "Give the folder that `embate run` wrote, the one with `fields.pvd`; run the model with `output.fields`.",
};

/// Nothing of a run is there.
pub(super) static NO_RUN: Message = Message {
    code: "E0722",
    title: "a folder without results to report on",
    example: Example::Command("report ."),
    cause: "The folder has none of `summary.json`, `run.json` and `history.csv`: it is not one of results, or its \
        run was killed before it left anything.",
    remedy: "Give the folder that `embate run` wrote, such as results/NAME.",
};

/// A bug.
pub static BUG: Message = Message {
    code: "E0799",
    title: "a bug in embate",
    example: Example::Words("It should never come."),
    cause: "The program came into a state that its authors held to be impossible.",
    remedy: "Please report it with the message, the command and the model file.",
};

/// Pictures are missing.
pub static NO_PICTURES: Message = Message {
    code: "W0701",
    title: "pictures are missing",
    example: Example::Shell("mkdir -p out/check.png\nembate check model.toml --out out\n"),
    cause: "A picture could not be made; all other results are there.",
    remedy: "Draw the fields with ParaView, or choose another `picture_field`.",
};

/// Channels are missing.
pub(super) static NO_CHANNELS: Message = Message {
    code: "W0704",
    title: "channels of a run are missing",
    example: Example::Words("The disk is full when a run ends, and there is no room for `channels.csv`."),
    cause: "The history could not be read again, or the file of the channels not be written; all other results are there.",
    remedy: "Free some space and run the model again, or find the channels from `history.csv`.",
};

/// The post-mortem is missing.
pub static NO_POST_MORTEM: Message = Message {
    code: "W0702",
    title: "the post-mortem of a failed run is missing",
    example: Example::Words("A run fails because the disk is full, and there is no room for the page either."),
    cause: "The page or one of its pictures could not be written; the failure itself is reported all the same.",
    remedy: "Free some space and run the model again; it fails in the same step.",
};
