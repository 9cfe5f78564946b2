//! Keys of what a part holds at the start: stress.

use crate::quantity::Dimension;
use crate::quantity::Range::Finite;
use crate::vocabulary::Kind::{Quantity, Table, Vector};
use crate::vocabulary::Need::{Default, Optional};
use crate::vocabulary::{Key, Section, key};

const fn component(name: &'static str, dimension: Dimension, doc: &'static str) -> Key {
    key(name, Quantity(dimension, Finite), Default("0"), doc)
}

pub(super) static STRESS_INITIAL: Section = Section {
    name: "stress_initial",
    doc: "Cauchy stress at the start, tension positive: uniform, or linear in x and y. Its elastic energy is in the \
        energy balance from the start. The law must be one in rate form that can hold it; nothing makes sure that it \
        is in equilibrium. Of bars `xx` is the stress along the bar, and there is no other.",
    keys: &[
        component("xx", Dimension::PRESSURE, "Normal stress along x (radial in an axisymmetric part)."),
        component("yy", Dimension::PRESSURE, "Normal stress along y (axial)."),
        component("zz", Dimension::PRESSURE, "Normal stress across the plane (around the axis); not in plane stress."),
        component("xy", Dimension::PRESSURE, "Shear stress."),
        key("per_x", Table(&PER_X), Optional("uniform along x"), "How much the stress grows along x."),
        key("per_y", Table(&PER_Y), Optional("uniform along y"), "How much the stress grows along y."),
        key("point", Vector(Dimension::LENGTH, Finite), Default("[0, 0]"), "Where the stress is just `xx`, `yy`, `zz`, `xy`."),
    ],
    ..Section::EMPTY
};

const SLOPES: [Key; 4] = [
    component("xx", Dimension::PRESSURE_PER_LENGTH, "Of `xx`."),
    component("yy", Dimension::PRESSURE_PER_LENGTH, "Of `yy`."),
    component("zz", Dimension::PRESSURE_PER_LENGTH, "Of `zz`."),
    component("xy", Dimension::PRESSURE_PER_LENGTH, "Of `xy`."),
];

static PER_X: Section = Section { name: "per_x", doc: "Growth of a stress along x.", keys: &SLOPES, ..Section::EMPTY };
static PER_Y: Section = Section { name: "per_y", doc: "Growth of a stress along y.", keys: &SLOPES, ..Section::EMPTY };
