//! Messages of input decks, as meshes and as models to be imported.

use embate_solver::message::{Example, Message};

pub(crate) static MESSAGES: &[&Message] = &[&DECK, &SYNTAX, &UNKNOWN, &DECK_MESH, &UNITS, &NO_COUNTERPART, &INCOMPLETE];

pub(super) static DECK: Message = Message {
    code: "E0230",
    title: "a deck that can't be read",
    example: Example::Deck("*INCLUDE, INPUT=nowhere.inp\n"),
    cause: "There is no such file, it is no text, or files include each other in a circle.",
    remedy: "Check the paths of the deck and of its *INCLUDE lines.",
};

pub(super) static SYNTAX: Message = Message {
    code: "E0231",
    title: "a line of a deck that can't be understood",
    example: Example::Deck("*NODE\n1, 0, zero\n"),
    cause: "A number, name or parameter is missing or is something else.",
    remedy: "Fix the line that the message names.",
};

pub(super) static UNKNOWN: Message = Message {
    code: "E0232",
    title: "a name or number of a deck that nothing has, or two things have",
    example: Example::Deck("*NODE\n1, 0, 0\n2, 1, 0\n3, 0, 1\n*ELEMENT, TYPE=CPE3\n1, 1, 2, 4\n"),
    cause: "A line refers to a node, element, set, part or material that is not there, or one is defined a second time.",
    remedy: "Look for the name above the line; parts have their own numbers.",
};

pub(super) static DECK_MESH: Message = Message {
    code: "E0233",
    title: "a mesh of a deck that can't be computed",
    example: Example::Deck("*NODE\n1, 0, 0\n2, 1, 0\n3, 0, 1\n4, 1, 1\n*ELEMENT, TYPE=R3D4\n1, 1, 2, 4, 3\n"),
    cause: "Elements are of a type that can't be computed, such as shells of second order; 2D elements and solids are in one deck; \
        nodes lie off the plane, or instances are turned out of it.",
    remedy: "Write a plane mesh of elements such as CPE4R, CPE3, CPS4R, CAX4R or CPE6M, or solids such as C3D8R, C3D6, C3D10M or C3D4.",
};

pub(super) static UNITS: Message = Message {
    code: "E0910",
    title: "units that a deck can't be in",
    example: Example::Command("import deck.inp --out imported --units mm,kg"),
    cause: "Decks carry no units, so --units names those of length, mass and time.",
    remedy: "Name all three, such as --units mm,t,s.",
};

pub(super) static NO_COUNTERPART: Message = Message {
    code: "E0911",
    title: "something of a deck that has no counterpart",
    example: Example::Deck(
        "*NODE\n1, 0, 0\n2, 1, 0\n3, 0, 1\n*ELEMENT, TYPE=CPE3, ELSET=B\n1, 1, 2, 3\n*SOLID SECTION, ELSET=B, MATERIAL=M\n\
         *MATERIAL, NAME=M\n*DENSITY\n7.8e-9\n*ELASTIC, TYPE=LAMINA\n2e5, 1e5, 0.3, 5e4, 5e4, 5e4\n*STEP\n*DYNAMIC, EXPLICIT\n, 1e-3\n*END STEP\n",
    ),
    cause: "The model would be another one without it: an anisotropic material, a strain energy that is not there.",
    remedy: "Change it in the deck, or write the model file by hand.",
};

pub(super) static INCOMPLETE: Message = Message {
    code: "E0912",
    title: "a deck that is no whole model",
    example: Example::Deck("*NODE\n1, 0, 0\n2, 1, 0\n3, 0, 1\n*ELEMENT, TYPE=CPE3, ELSET=B\n1, 1, 2, 3\n"),
    cause: "A section, a density, a dynamic step or an end time is missing.",
    remedy: "Add what the message names, or use the deck as a mesh file of a model (`mesh = { file = \"deck.inp\" }`).",
};
