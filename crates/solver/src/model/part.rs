//! Parts of a [`super::Model`]: `[[part]]`.

use super::initial::{RADIAL_VELOCITY, STRESS_INITIAL};
use super::placement::{ALONG_Z, COPIES, MIRROR, ROTATION};
use super::{
    EXTRUDE, InitialStress, Motion, PROFILE, Placement, Profile, REVOLVE, RadialVelocity, SHAPES, SHELL_SECTION, Shape, ShellSection,
    Sweep, Values, section,
};
use crate::quantity::Dimension;
use crate::quantity::Range::{Finite, NotNegative, Positive};
use crate::stress_state::STRESS_STATES;
use crate::vector::{times, unit};
use crate::vocabulary::Kind::{Angle, Choice, Name, Quantity, Reference, Spatial, Table};
use crate::vocabulary::{Choices, Form, Kind, Rule, Section};

section! {
    /// `[[part]]`: a body of one material and one element kind for each kind of cell.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Part in PART = Section {
        name: "part",
        doc: "A body of one material, and how it moves at the start. A shape, or a mesh file, says where its elements come from.",
        form: Form::Repeated,
        required: true,
        groups: &[&SHAPES],
        rules: &[Rule::NotBoth("extrude", "revolve")],
        ..Section::EMPTY
    };
    name: String = Name, Required, "Unique name.";
    material: String = Reference, Required, "Name of a `[material.NAME]` section.";
    element: String = Choice(Choices::Elements), Default("\"quad4\""),
        "Kind of element: what quadrilaterals are; `bar2` for bars, `beam2` for beams in 3D, `shell2` for shells in 2D, \
            `shell4` for those in 3D (`shell3` where they are of triangles only).";
    element_triangles: String = Choice(Choices::Triangles), Optional("`tri3`, of six nodes `tri6`"),
        "What triangles are, where the part has some; those of shells in 3D are `shell3`. With `tri6` a mesh of three-node \
            triangles gets a node in the middle of each edge.",
        read |values| values.or("element_triangles", String::new());
    area: Option<f64> = Quantity(Dimension::LENGTH, Positive), Optional("only with bars"),
        "Cross-section of bars per metre of depth, such as `\"1e-4 m\"` for one square centimetre in each metre; \
            between solids whole, `\"1e-4 m^2\"`.";
    section: Option<ShellSection> = Table(&SHELL_SECTION), Optional("only with shells"), "Section of shells: thickness and layers.";
    profile: Option<Profile> = Table(&PROFILE), Optional("only with beams"), "Cross-section of beams, and the fibres in it.";
    hourglass: Option<f64> = Quantity(Dimension::NONE, NotNegative), Optional("that of the control's source"),
        "Coefficient of the hourglass control of elements that have one.";
    stress_state: String = Choice(Choices::StressStates), Default("\"plane_strain\""),
        "What the plane stands for. In an axisymmetric part x is the radius and y the axis; forces, masses and \
            energies are those of the whole circumference.";
    velocity: [f64; 3] = Spatial(Dimension::VELOCITY, Finite), Default("[0, 0]"), "Initial velocity.";
    spin: f64 = Angle(Dimension::RATE, Finite), Default("0"),
        "Initial angular velocity about the centre of mass, counter-clockwise; not of an axisymmetric part.";
    spin_axis: [f64; 3] = Spatial(Dimension::NONE, Finite), Default("[0, 0, 1]"),
        "Direction of the axis of `spin`, in 3D, by the right-hand rule; any length but zero.";
    spin_centre: Option<[f64; 3]> = Spatial(Dimension::LENGTH, Finite), Optional("the centre of mass"),
        "Point about which `spin` turns the part, in 3D one of the axis: with another one than the centre of mass that moves, too.";
    radial_velocity: Option<RadialVelocity> = Table(&RADIAL_VELOCITY), Optional("none"),
        "Initial velocity away from a point or an axis; not of a rigid part.";
    stress_initial: Option<InitialStress> = Table(&STRESS_INITIAL), Optional("none"), "Stress at the start.";
    temperature_initial: Option<f64> = Quantity(Dimension::TEMPERATURE, Positive), Optional("that of the material"),
        "Temperature at the start, of laws that have one (`johnson_cook`).";
    rigid: Option<Motion> = Kind::Rigid, Default("false"),
        "Whether the part is rigid, free to move; or how it moves: `x` and `y` of its centre of mass, `rotation` \
            about it. What is left out is free. An axisymmetric part moves along `y` only.";
    mass_scale: f64 = Quantity(Dimension::NONE, Positive), Default("1"),
        "Factor on the mass of the part where mass resists motion: 100 makes steps ten times as long. What \
            gravity pulls at stays the true mass.";
    "mirror" = Table(&MIRROR), Optional("not mirrored"),
        "A line, in 3D a plane, that the shape or mesh is mirrored on, before it is turned.";
    "rotation" = Table(&ROTATION), Optional("not turned"),
        "An angle by which the shape or mesh is turned, before it is moved.";
    "extrude" = Table(&EXTRUDE), Optional("the part stays as it is"),
        "Extrudes a 2D shape along z: the part becomes a solid, lines become a shell (`shell4`).";
    "revolve" = Table(&REVOLVE), Optional("the part stays as it is"),
        "Revolves a 2D shape about a line: the part becomes a solid, lines become a shell (`shell4`).";
    "translation" = Spatial(Dimension::LENGTH, Finite), Default("[0, 0]"), "How far the shape or mesh is moved.";
    "copies" = Table(&COPIES), Optional("one body"),
        "More bodies of the same shape or mesh, in a row or around a point.";
    /// Where its elements come from; of a group of a mesh file the reader of the file says which.
    shape: Shape, read shape;
    /// How a shape in 2D becomes a solid, or lines a shell in 3D; `None`: it stays as it is.
    sweep: Option<Sweep>, read |part| part.tables().into_iter().find_map(|(name, table)| Sweep::read(name, table));
    /// Where its body goes.
    placement: Placement, read Placement::read;
}

/// The built-in shape; without one a group of no mesh file.
fn shape(part: &dyn Values) -> Shape {
    let built_in = part.tables().into_iter().find_map(|(name, table)| Shape::read(name, table));
    built_in.unwrap_or(Shape::Group { mesh: usize::MAX, group: String::new() })
}

impl Part {
    /// Whether x is its radius.
    #[must_use]
    pub fn is_axisymmetric(&self) -> bool {
        STRESS_STATES.iter().any(|kind| kind.name == self.stress_state && kind.state.is_axisymmetric)
    }

    /// Its angular velocity at the start, 1/s.
    #[must_use]
    pub fn spin_vector(&self) -> [f64; 3] {
        // About z it is as given, to the last digit.
        if self.spin_axis == ALONG_Z { [0.0, 0.0, self.spin] } else { times(self.spin, unit(self.spin_axis).unwrap_or(ALONG_Z)) }
    }

    /// The names of its materials: that of its own, or those of the layers of its section one after the
    /// other.
    pub fn materials(&self) -> impl Iterator<Item = &str> {
        let layers = self.section.iter().flat_map(|section| section.layers.iter().map(|layer| section.material_of(layer, &self.material)));
        let is_layered = self.section.as_ref().is_some_and(|section| !section.layers.is_empty());
        layers.chain((!is_layered).then_some(self.material.as_str()))
    }

    /// 3 where it is swept, has a solid shape, is a shell in 3D or a group of beams, else 2; of other groups
    /// of mesh files its model knows ([`super::Model::dimension_of`]).
    #[must_use]
    pub fn dimension(&self) -> usize {
        let is_frame = self.is_of_beams() && matches!(self.shape, Shape::Group { .. });
        if self.sweep.is_some() || self.shape.solid().is_some() || self.is_of_sheets() || is_frame { 3 } else { 2 }
    }
}
