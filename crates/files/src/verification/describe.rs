//! Every key of `expected.toml`, described once: reading, messages and the tables of `docs/verification.md`
//! come from here.

use super::case::{TAKES, Take};
use crate::model_file::{Vocabulary, keys_table};
use embate_solver::quantity::{Dimension, Range};
use embate_solver::vocabulary::{Choices, Form, Group, Key, Kind, Need, Rule, Section};
use std::fmt::Write;

const fn key(name: &'static str, kind: Kind, need: Need, doc: &'static str) -> Key {
    Key { name, kind, need, example: "", doc }
}

use Kind::{Choice, Quantity, Reference, References, Spatial, Table, Text};
use Need::{Optional, Required};

const NUMBER: Kind = Quantity(Dimension::NONE, Range::Finite);

/// What `expected.toml` may hold.
pub(super) static EXPECTED: Vocabulary = Vocabulary { what: "case", top: &TOP, sections: &[&VARIANT, &CHECK] };

static TOP: Section = Section {
    name: "",
    doc: "Keys that stand above all sections.",
    form: Form::Single,
    keys: &[
        key("title", Text, Required, "What is verified."),
        key("tier", Choice(Choices::Words(&["every", "all"])), Required, "`every`: run by default; `all`: only with `--all` or by name."),
    ],
    ..Section::EMPTY
};

static VARIANT: Section = Section {
    name: "variant",
    doc: "A model file with some of its keys changed, under a name of its own.",
    form: Form::Named,
    keys: &[
        key("model", Reference, Optional("`model`"), "The model file, without `.toml`."),
        key("set", References(None), Required, "Changes, each written as after `--set`."),
    ],
    ..Section::EMPTY
};

static CHECK: Section = Section {
    name: "check",
    doc: "A quantity and the values that it may have.",
    form: Form::Repeated,
    required: true,
    keys: &[
        key("name", Text, Required, "What is compared, for the table."),
        key(
            "model",
            References(None),
            Optional("`model`"),
            "Model files without `.toml`, or variants; the check is made for each of them.",
        ),
        key("quantity", Table(&QUANTITY), Required, "What is compared."),
        key("over", Table(&OVER), Optional("nothing"), "The quantity is divided by this one."),
        key("minus", Table(&MINUS), Optional("nothing"), "This one is taken away from the quantity."),
        key("expect", NUMBER, Optional("`at_least`, `at_most`, or both"), "Expected value, in SI units."),
        key(
            "tolerance_relative",
            Quantity(Dimension::NONE, Range::Positive),
            Optional("`tolerance` or `converges`"),
            "Largest deviation as a fraction of the expected value; may be a text with %.",
        ),
        key("tolerance", Quantity(Dimension::NONE, Range::NotNegative), Optional("another key"), "Largest deviation, in SI units."),
        key("converges", Table(&CONVERGES), Optional("another key"), "The deviation is compared with that of a coarser model."),
        key("at_least", NUMBER, Optional("no lower limit"), "Smallest value that is accepted, in SI units."),
        key("at_most", NUMBER, Optional("no upper limit"), "Largest value that is accepted, in SI units."),
        key("reason", Text, Required, "One line: where the value comes from, and why this tolerance."),
    ],
    rules: &[
        Rule::NotBoth("over", "minus"),
        Rule::SomeOf(&["expect", "at_least", "at_most"]),
        Rule::NotBoth("expect", "at_least"),
        Rule::NotBoth("expect", "at_most"),
        Rule::Needs("tolerance_relative", "expect"),
        Rule::Needs("tolerance", "expect"),
        Rule::Needs("converges", "expect"),
    ],
    ..Section::EMPTY
};

static QUANTITY: Section = Section {
    name: "quantity",
    doc: "One number of a run: where it comes from, and what is made of many values.",
    groups: &[&NUMBERS],
    ..Section::EMPTY
};

static OVER: Section =
    Section { name: "over", doc: "A quantity, perhaps of another model.", keys: &[OTHER_MODEL], groups: &[&NUMBERS], ..Section::EMPTY };

static MINUS: Section =
    Section { name: "minus", doc: "A quantity, perhaps of another model.", keys: &[OTHER_MODEL], groups: &[&NUMBERS], ..Section::EMPTY };

const OTHER_MODEL: Key = key("model", Reference, Optional("that of the check"), "Model file or variant.");

static NUMBERS: Group = Group {
    title: "One number",
    doc: "Where a number of a run comes from, and what is made of many values.",
    keys: &[
        key("summary", Text, Optional("another source"), "A figure of summary.json; keys within keys are joined by dots."),
        key("history", Text, Optional("another source"), "A column of history.csv."),
        key("field", Text, Optional("another source"), "A field of a frame: `von_mises`, or with its component `stress.yy`."),
        key(
            "take",
            Choice(Choices::Listed(takes)),
            Optional("`at` or `nearest`"),
            "What is made of the many values of a column or a field.",
        ),
        key(
            "at",
            Quantity(Dimension::TIME, Range::NotNegative),
            Optional("for a field: the end"),
            "Time: of a history, between two rows on a straight line; of a field, that of an output.",
        ),
        key("from", Quantity(Dimension::TIME, Range::NotNegative), Optional("the start"), "Begin of what `take` sees of a history."),
        key("to", Quantity(Dimension::TIME, Range::NotNegative), Optional("the end"), "End of what `take` sees of a history."),
        key("level", NUMBER, Optional("for takes without a level"), "Level that a column rises above or falls below, in SI units."),
        key("part", Reference, Optional("all parts"), "Only nodes or elements of this part."),
        key("box", Table(&BOX), Optional("all"), "Only nodes, or elements with their centre, in this box at the start."),
        key(
            "nearest",
            Spatial(Dimension::LENGTH, Range::Finite),
            Optional("`take`"),
            "The node or element centre nearest to this point at the start.",
        ),
    ],
    rules: &[
        Rule::OneOf(&["summary", "history", "field"]),
        Rule::NotBoth("nearest", "take"),
        Rule::NotBoth("nearest", "box"),
        Rule::NotBoth("at", "from"),
        Rule::NotBoth("at", "to"),
    ],
};

static BOX: Section = Section {
    name: "box",
    doc: "An axis-parallel box; its border belongs to it.",
    keys: &[
        key("low", Spatial(Dimension::LENGTH, Range::Finite), Required, "Corner with the least coordinates; a third one left out is zero."),
        key("high", Spatial(Dimension::LENGTH, Range::Finite), Required, "Corner with the largest coordinates."),
    ],
    ..Section::EMPTY
};

static CONVERGES: Section = Section {
    name: "converges",
    doc: "How much smaller the deviation must be than that of a coarser model.",
    keys: &[
        key("model", Reference, Required, "The coarser model or variant."),
        key(
            "fraction",
            Quantity(Dimension::NONE, Range::Between(0.0, 1.0)),
            Required,
            "The deviation is at most this fraction of the coarser one's.",
        ),
    ],
    ..Section::EMPTY
};

fn takes() -> Vec<&'static str> {
    TAKES.iter().map(|take: &Take| take.name).collect()
}

/// The tables of keys for `docs/verification.md`.
#[must_use]
pub fn expected_markdown() -> String {
    let mut out = String::from("### Above all sections\n\n");
    keys_table(&mut out, TOP.keys, TOP.rules);
    for (header, section) in [("[variant.NAME]", &VARIANT), ("[[check]]", &CHECK)] {
        let _ = writeln!(out, "### `{header}`\n\n{}{}\n", section.doc, if section.required { " Required." } else { "" });
        keys_table(&mut out, section.keys, section.rules);
    }
    for (section, keys, rules) in
        [(&QUANTITY, NUMBERS.keys, NUMBERS.rules), (&BOX, BOX.keys, BOX.rules), (&CONVERGES, CONVERGES.keys, CONVERGES.rules)]
    {
        let _ = writeln!(out, "### `{} = {{ ... }}`\n\n{}\n", section.name, section.doc);
        keys_table(&mut out, keys, rules);
    }
    out.push_str("`over` and `minus` have the keys of `quantity`, and `model`: a model file or variant, left out: that of the check.\n\n");
    out.push_str("### `take`\n\n| `take` | of | meaning |\n|---|---|---|\n");
    for take in TAKES {
        let of = if take.of_history && take.of_field {
            "history, field"
        } else if take.of_history {
            "history"
        } else {
            "field"
        };
        let _ = writeln!(out, "| `{}` | {of} | {} |", take.name, take.doc);
    }
    out
}
