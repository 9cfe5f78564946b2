//! The section of the model file about contacts.

use crate::model::INTERFACE;
use crate::quantity::Dimension;
use crate::quantity::Range::Positive;
use crate::vocabulary::Kind::{Choice, Flag, Name, Quantity, Reference, References};
use crate::vocabulary::Need::{Default, Optional};
use crate::vocabulary::{Choices, Form, Rule, Section, key};

pub(super) static CONTACT: Section = Section {
    name: "contact",
    doc: "Bodies that can't go through each other: two surfaces, or several bodies, each of which meets each other \
        and itself. A surface is a part (its whole outside), a side such as `plate.top`, or a group of lines (in 3D \
        of surfaces) of a mesh file.",
    form: Form::Repeated,
    keys: &[
        key("name", Name, Optional("the names of the surfaces or parts joined by `-`, or `all`"), "Unique name."),
        key("between", References(Some(2)), Optional("`bodies`"), "The two surfaces."),
        key("bodies", References(None), Optional("`between`"), "Parts that meet each other and themselves; `\"all\"` for all parts."),
        key(
            "formulation",
            Choice(Choices::Formulations),
            Default("\"double_pass\""),
            "What is checked: the nodes of each surface against the segments of the other, only the nodes of \
                `slave`, segments against segments, or disks in the elements. In 3D nodes meet facets, in a double \
                pass also edges edges, and the elements have balls; there are no segments.",
        ),
        key("slave", Reference, Optional("needed for, and only for, `single_pass`"), "The surface of `between` whose nodes are checked."),
        key("tied", Flag, Default("false"), "Whether what touches at the start stays together."),
        key("tie_strength", Quantity(Dimension::PRESSURE, Positive), Optional("it never breaks"), "Traction above which a tie breaks."),
        key("search", Choice(Choices::Searches), Optional("`grid`"), "How near pairs are found; changes no result."),
    ],
    groups: &[&INTERFACE],
    rules: &[Rule::OneOf(&["between", "bodies"]), Rule::Only { keys: &["tie_strength"], by: "tied", value: "true" }],
    ..Section::EMPTY
};
