//! Parts whose elements are made again in the run, `[[remesh]]`, whose nodes are moved to better places,
//! `[[relocate]]`, or that stay in place while material flows through them, `[[flow]]`.

use super::{Model, Part, section};
use crate::quantity::Dimension;
use crate::quantity::Range::{Finite, NotNegative, Positive, UpTo};
use crate::vocabulary::Kind::{Flag, Integer, Quantity, Reference, Spatial};
use crate::vocabulary::{Form, Section};

section! {
    /// `[[remesh]]`: when elements of a part are made again, and how large.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Remesh in REMESH = Section {
        name: "remesh",
        doc: "A part of a 2D model whose elements are made again as quadrilaterals inside its outline when their form has become poor, or \
            their stable step short. Stress, plastic strain and velocities go over to the new elements: mass, momentum and angular \
            momentum exactly, energy but for a loss that the history has as `energy.remap`. Where no better mesh is found the run \
            continues with the old one, and a warning says so.",
        form: Form::Repeated,
        ..Section::EMPTY
    };
    part: String = Reference, Required, "Name of the part.";
    size: Option<f64> = Quantity(Dimension::LENGTH, Positive), Optional("as many elements as at the start"),
        "Edge length of the new elements.";
    size_contact: Option<f64> = Quantity(Dimension::LENGTH, Positive), Optional("as elsewhere"),
        "Edge length where the part presses on something, as at the edge of a tool: elements grow from there to those elsewhere. They are \
            made again, too, where edges in contact are more than twice as long.";
    strain_change: Option<f64> = Quantity(Dimension::NONE, Positive), Optional("no such wish"),
        "Plastic strain that may change across an element, such as 0.2: edges are shorter where it changes more. Elements are made again, \
            too, where they are more than twice as wide as that asks for.";
    stress_error: Option<f64> = Quantity(Dimension::NONE, Positive), Optional("no such wish"),
        "Error that the stress of an element may have over the mean stress of the part (its root mean square), such as 0.1, as estimated \
            by Zienkiewicz and Zhu: edges are shorter where it is larger. Elements are made again, too, where they are more than twice as \
            wide as that asks for. For slow loads: waves of stress have errors wherever they pass.";
    size_least: Option<f64> = Quantity(Dimension::LENGTH, Positive), Optional("a quarter of `size`"),
        "Shortest edge length that `strain_change` and `stress_error` ask for.";
    quality: f64 = Quantity(Dimension::NONE, UpTo(0.0, 1.0)), Default("0.3"),
        "Least scaled Jacobian of an element (1: a rectangle, 0: an angle of 180 degrees) below which elements are made again.";
    time_step: f64 = Quantity(Dimension::NONE, UpTo(0.0, 1.0)), Default("0.3"),
        "Stable step of the part, as a fraction of that after its elements were made, below which they are made again.";
    interval: Option<f64> = Quantity(Dimension::TIME, Positive), Optional("only when it is needed"),
        "Longest time between two times that elements are made.";
    begin: f64 = Quantity(Dimension::TIME, NotNegative), Default("0"), "Time before which nothing is made again.";
    elements_most: Option<u64> = Integer(1), Optional("four times as many as at the start"),
        "Most elements: where `size` would give more, they are larger.";
    loss_limit: f64 = Quantity(Dimension::NONE, Positive), Default("0.05"),
        "Energy that may be lost in all by making elements again, as a fraction of the largest total energy: beyond it the run ends.";
}

section! {
    /// `[[relocate]]`: when nodes of a part are moved to better places.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Relocate in RELOCATE = Section {
        name: "relocate",
        doc: "A part whose nodes are moved to better places when the form of its elements has become poor, or their stable \
            step short: those inside to where elements have the best form, those of the outline along it, between its corners and, in 3D, \
            its edges. Elements \
            stay what they are. Mass, momenta and stresses go over as with `[[remesh]]`, and what is lost is in `energy.remap`. It costs less form \
            than new elements where these are not needed; where the part changes its shape altogether, only `[[remesh]]` helps: in 2D a part \
            can have both.",
        form: Form::Repeated,
        ..Section::EMPTY
    };
    part: String = Reference, Required, "Name of the part.";
    quality: f64 = Quantity(Dimension::NONE, UpTo(0.0, 1.0)), Default("0.5"),
        "Least scaled Jacobian of an element (1: a rectangle or a cuboid, 0: an angle of 180 degrees) below which nodes are moved.";
    time_step: f64 = Quantity(Dimension::NONE, UpTo(0.0, 1.0)), Default("0.5"),
        "Stable step of the part, as a fraction of that after its nodes were moved, below which they are moved again.";
    interval: Option<f64> = Quantity(Dimension::TIME, Positive), Optional("only when it is needed"),
        "Longest time between two times that nodes are moved.";
    begin: f64 = Quantity(Dimension::TIME, NotNegative), Default("0"), "Time before which no node is moved.";
    loss_limit: f64 = Quantity(Dimension::NONE, Positive), Default("0.05"),
        "Energy that may be lost in all by moving nodes, as a fraction of the largest total energy: beyond it the run ends.";
}

section! {
    /// `[[flow]]`: a part that stays in place along the direction in which its material flows.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Flow in FLOW = Section {
        name: "flow",
        doc: "A part of a 2D model that stays in place while its material flows through it (a quasi-Eulerian domain), as in rolling and \
            extrusion. Nodes move with the material and go back along the direction of the flow before they are an element away; across \
            it they follow the surfaces. What goes out at one end is gone, and what comes in at the other is as it was there when the flow began. \
            Mass, momenta and stresses go over as with `[[remesh]]`; the history has what is lost as `energy.remap`, and what went out \
            less what came in as `energy.flow`. Probes stay with the mesh.",
        form: Form::Repeated,
        ..Section::EMPTY
    };
    part: String = Reference, Required, "Name of the part: a channel with one inlet, one outlet and a surface on either side.";
    direction: Option<[f64; 3]> = Spatial(Dimension::NONE, Finite), Optional("that of the velocity of the part"),
        "Direction of the flow, any length but zero; of axisymmetric parts along the axis.";
    begin: f64 = Quantity(Dimension::TIME, NotNegative), Default("0"),
        "Time until which the part moves with its material. Nodes then stay where they are.";
    travel: f64 = Quantity(Dimension::NONE, UpTo(0.0, 1.0)), Default("1"),
        "Largest way of a node from its place over the width of an element along the flow, at which nodes go back: the rarer, the less \
            is averaged.";
    steady: f64 = Quantity(Dimension::NONE, Positive), Default("0.01"),
        "Largest change of the surfaces and of what the law remembers, such as plastic strain, while material passes a quarter of the \
            part, at which its state counts as steady.";
    stop: bool = Flag, Default("false"), "Whether the run ends when the state is steady.";
    loss_limit: f64 = Quantity(Dimension::NONE, Positive), Default("0.05"),
        "Energy that may be lost in all where nodes go back, as a fraction of the largest total energy: beyond it the run ends.";
}

impl Remesh {
    /// When elements or nodes of a part are looked after, and nothing else that may be left out.
    #[must_use]
    pub fn of_part(part: &str, [quality, time_step]: [f64; 2]) -> Self {
        Self {
            part: part.into(),
            size: None,
            size_contact: None,
            strain_change: None,
            stress_error: None,
            size_least: None,
            quality,
            time_step,
            interval: None,
            begin: 0.0,
            elements_most: None,
            loss_limit: 0.05,
        }
    }
}

impl Flow {
    /// Direction of the flow, of any length; zero where none is known.
    #[must_use]
    pub fn direction_of(&self, part: &Part) -> [f64; 3] {
        self.direction.unwrap_or(part.velocity)
    }
}

/// When and how elements of a part are exchanged.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Rule {
    /// Where it stands in the model: `remesh[0]`.
    pub(crate) path: String,
    /// Whether nodes are moved, instead of elements made again.
    pub(crate) relocates: bool,
    pub(crate) of: Remesh,
}

impl Model {
    /// Rules of `[[relocate]]`, then of `[[remesh]]`.
    pub(crate) fn rules_of_remeshing(&self) -> Vec<Rule> {
        let moved = self.relocations.iter().enumerate().map(|(index, own)| {
            let Relocate { part, quality, time_step, interval, begin, loss_limit } = own;
            let of =
                Remesh { interval: *interval, begin: *begin, loss_limit: *loss_limit, ..Remesh::of_part(part, [*quality, *time_step]) };
            Rule { path: format!("relocate[{index}]"), relocates: true, of }
        });
        let made = self.remeshes.iter().enumerate();
        moved.chain(made.map(|(index, own)| Rule { path: format!("remesh[{index}]"), relocates: false, of: own.clone() })).collect()
    }

    /// Whether elements of any part are exchanged in the run.
    pub(crate) fn is_remeshed(&self) -> bool {
        !(self.relocations.is_empty() && self.remeshes.is_empty() && self.flows.is_empty())
    }
}
