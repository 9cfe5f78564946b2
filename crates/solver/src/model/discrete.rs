//! Springs, dampers and point masses, as plain data.

use super::section;
use crate::quantity::Dimension;
use crate::quantity::Range::{Finite, NotNegative, Positive};
use crate::vocabulary::Kind::{Quantities, Quantity, Reference, References};
use crate::vocabulary::{Form, Rule, Section};

section! {
    /// `[[spring]]`: a spring, a damper or both between each pair of nodes of two sets; in 3D without the
    /// metre of depth.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Spring in SPRING = Section {
        name: "spring",
        doc: "Springs and dampers between two sets of nodes: each node of the larger set with the nearest one of the \
            other. Numbers are those of each, per metre of depth (of an axisymmetric model over the whole circumference; \
            between solids whole ones, in N/m, N s/m and N). Their energy is counted with that of the elements.",
        form: Form::Repeated,
        rules: &[
            Rule::SomeOf(&["stiffness", "force", "damping"]),
            Rule::NotBoth("stiffness", "force"),
            Rule::Needs("force", "elongation"),
            Rule::Needs("elongation", "force"),
        ],
        ..Section::EMPTY
    };
    between: [String; 2] = References(Some(2)), Required,
        "The two sets: each a part, a side such as `plate.left`, or a group of a mesh file.";
    stiffness: f64 = Quantity(Dimension::PRESSURE, Positive), Optional("no spring, or `force`"),
        "Force per elongation, such as `\"1e6 N/m/m\"`, between solids `\"1e6 N/m\"`.",
        read |values| values.or("stiffness", 0.0);
    elongation: Vec<f64> = Quantities(Dimension::LENGTH, Finite, 2), Optional("with `force`"),
        "Elongations, ascending.";
    force: Vec<f64> = Quantities(Dimension::FORCE_PER_LENGTH, Finite, 2), Optional("`stiffness`"),
        "Force at each elongation; constant before the first and after the last.";
    damping: f64 = Quantity(Dimension::VISCOSITY, NotNegative), Default("0"), "Force per rate of elongation.";
    length: Option<f64> = Quantity(Dimension::LENGTH, NotNegative), Optional("that at the start"),
        "Length without force.";
    strength: Option<f64> = Quantity(Dimension::FORCE_PER_LENGTH, Positive), Optional("it never breaks"),
        "Force of the spring, pulling or pushing, above which it breaks with its damper; its energy counts as dissipated.";
}

section! {
    /// `[[point_mass]]`: mass without volume on nodes.
    #[derive(Clone, Debug, PartialEq)]
    pub struct PointMass in POINT_MASS = Section {
        name: "point_mass",
        doc: "Mass without volume on nodes: it belongs to their part, falls with it, and makes rigid parts heavier.",
        form: Form::Repeated,
        ..Section::EMPTY
    };
    on: String = Reference, Required, "A part, a side such as `plate.top`, or a group of a mesh file.";
    mass: f64 = Quantity(Dimension::MASS_PER_LENGTH, Positive), Required,
        "Mass in all per metre of depth (of an axisymmetric model over the whole circumference; of solids the \
            whole, kg), shared equally by the nodes.";
}
