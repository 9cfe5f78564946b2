//! Messages of sweeps.

use embate_solver::message::{Example, Message};

pub(crate) static MESSAGES: &[&Message] = &[&VALUES, &WANTED, &TABLE, &OTHER, &BUSY, &BOUNDS, &MEASURED, &FIRST_RUN];

pub(super) static VALUES: Message = Message {
    code: "E0901",
    title: "values of a sweep that can't be",
    example: Example::Command("sweep model.toml --vary material.steel.young=1GPa:2GPa --output last(block.vx)"),
    cause: "A key has no values, a range is not FROM:TO:COUNT, a column of the table is no key, or there are too many runs.",
    remedy: "Write them as the message shows: --vary key=1,2,3 or key=1:3:5.",
};

pub(super) static WANTED: Message = Message {
    code: "E0902",
    title: "an output of a sweep that is not there",
    example: Example::Command("sweep model.toml --vary material.steel.young=1GPa,2GPa --output last(nothing)"),
    cause: "The history has no such column, the summary no such figure, or the text is no output.",
    remedy: "Take a column of history.csv, such as last(energy.kinetic), or a key of summary.json.",
};

pub(super) static TABLE: Message = Message {
    code: "E0903",
    title: "a table of runs that can't be read",
    example: Example::Command("sweep model.toml --table nowhere.csv --output last(block.vx)"),
    cause: "There is no such file, or it may not be read.",
    remedy: "Check the path.",
};

pub(super) static OTHER: Message = Message {
    code: "E0904",
    title: "a folder with another sweep",
    example: Example::Shell(
        "embate sweep model.toml --vary contact.hit.friction=0.1,0.2 --out swept --quiet\nembate sweep model.toml \
            --vary contact.hit.friction=0.1,0.3 --out swept --quiet\n",
    ),
    cause: "A sweep continues where it was stopped, but this one has other runs.",
    remedy: "Choose another folder with --out, or start again with --force.",
};

pub(super) static BUSY: Message = Message {
    code: "E0905",
    title: "two sweeps in one folder",
    example: Example::Shell(
        "mkdir swept\ntouch swept/sweep.journal\nflock swept/sweep.journal embate sweep model.toml --vary \
            contact.hit.friction=0.1,0.2 --out swept --quiet\n",
    ),
    cause: "Another program writes into the folder.",
    remedy: "Wait for its end, or choose another folder with --out.",
};

pub(super) static BOUNDS: Message = Message {
    code: "E0907",
    title: "bounds of a fit that can't be",
    example: Example::Command("fit model.toml --vary material.steel.young=300GPa:100GPa --measured last(block.vx)=1"),
    cause: "A key has no bounds, they are not two or three numbers in ascending order, or a key has bounds twice.",
    remedy: "Write them as the message shows: --vary key=1:3, or key=1:2:3 with the first value between both.",
};

pub(super) static MEASURED: Message = Message {
    code: "E0908",
    title: "a measurement of a fit that can't be",
    example: Example::Command("fit model.toml --vary material.steel.young=100GPa:300GPa --measured block.vx=nowhere.csv"),
    cause: "There is no number and no table behind the name, or the table has not two columns of numbers.",
    remedy: "Give a number with its unit, or a CSV file with two numbers in each row: time, or the column that the curve is over, and value.",
};

pub(super) static FIRST_RUN: Message = Message {
    code: "E0909",
    title: "a fit whose first run fails",
    example: Example::Command("fit model.toml --vary run.energy_limit=1e-300:2e-300 --measured last(energy.kinetic)=1"),
    cause: "The search begins in the middle of the bounds, or at the first value between them, and there the model fails, or does not come to a place at which something was measured.",
    remedy: "Give a first value with which the model runs: --vary key=LOWEST:FIRST:HIGHEST. Let the run last until it has come to all places, or leave out those that it never comes to.",
};
