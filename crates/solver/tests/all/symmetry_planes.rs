//! Contact in 3D at symmetry planes: a slice between two of them does what the plane does.

use crate::bodies::{every_step, rough, to_end, value};
use crate::long::is_long;
use crate::patches::material;
use crate::self_contact::crushed_ring;
use embate_solver::model::{
    Contact, Extrude, Formulation, InitialPenetration, Interface, Model, Part, Penalty, Probe, ProbeAt, Rectangle, Ring, Run, Shape, Sweep,
    Symmetry,
};
use std::f64::consts::{FRAC_PI_2, PI};

const DEPTH: f64 = 0.3;

/// Half of a ring that falls on half of a strip: both end on x = 0, where they touch first.
fn ring_on_strip(interface: Interface) -> Model {
    let ring = Ring { centre: [0.0, 1.0], inner: 0.8, outer: 1.0, from: -FRAC_PI_2, to: FRAC_PI_2, elements: [1, 16], ..Ring::default() };
    let strip = Rectangle { corner: [0.0, -0.2], size: [1.5, 0.2], elements: [13, 2], ..Rectangle::default() };
    let part = |name: &str, shape: Shape, speed: f64| Part {
        name: name.into(),
        material: "m".into(),
        element: "quad4".into(),
        shape,
        velocity: [0.0, speed, 0.0],
        ..Part::default()
    };
    let probe = |name: &str, part: &str, point: [f64; 3]| Probe {
        name: name.into(),
        at: ProbeAt::Point { part: part.into(), point },
        ..Probe::default()
    };
    let mut contact = Contact::between("hit", "ring", "strip");
    contact.interface = interface;
    Model {
        name: "ring".into(),
        // Until something is deeper than a twentieth of the strip: from then on space has a net, which the
        // plane has not.
        run: Run { end: 0.055, time_step: Some(1e-3), ..Run::default() },
        materials: [("m".to_string(), material("j2", 0.3))].into(),
        parts: vec![part("ring", Shape::Ring(ring), -2.0), part("strip", Shape::Rectangle(strip), 1.0)],
        symmetries: vec![Symmetry { normal: [1.0, 0.0, 0.0], ..Symmetry::default() }],
        contacts: vec![contact],
        probes: vec![probe("A", "ring", [0.0; 3]), probe("B", "strip", [0.0; 3]), probe("T", "ring", [0.0, 2.0, 0.0])],
        ..Model::default()
    }
}

/// The same as a slice whose faces are symmetry planes.
fn extruded(model: Model, elements: usize) -> Model {
    extruded_by(DEPTH, model, elements)
}

fn extruded_by(depth: f64, mut model: Model, elements: usize) -> Model {
    for part in &mut model.parts {
        part.element = "hex8".into();
        part.sweep = Some(Sweep::Extrude(Extrude { from: 0.0, length: depth, elements, ..Extrude::default() }));
    }
    for z in [0.0, depth] {
        model.symmetries.push(Symmetry { point: [0.0, 0.0, z], normal: [0.0, 0.0, 1.0], ..Symmetry::default() });
    }
    model
}

#[test]
fn a_slice_of_an_impact_on_a_symmetry_plane_does_what_the_plane_does() {
    for interface in [Interface::default(), Penalty::Pressure(3e4).into(), rough(0.3)] {
        let plane = ring_on_strip(interface);
        let space = extruded(plane.clone(), 1);
        let (plane, space) = (every_step(&plane), every_step(&space));
        let mut touched = 0;
        for column in ["energy.kinetic", "energy.internal", "energy.plastic", "energy.contact", "energy.friction"] {
            let (flat, solid, whole) = (plane.column(column), space.column(column), plane.column("energy.kinetic")[0]);
            assert_eq!(flat.len(), solid.len());
            for (step, (flat, solid)) in flat.iter().zip(&solid).enumerate() {
                assert!((solid / DEPTH - flat).abs() < 1e-9 * whole, "{column} in step {step}: {solid} of {flat} per metre");
            }
        }
        let (flat, solid) = (plane.column("contact.force_y[hit]"), space.column("contact.force_y[hit]"));
        let most = flat.iter().fold(0.0f64, |most, force| most.max(force.abs()));
        for (step, (flat, solid)) in flat.iter().zip(&solid).enumerate() {
            touched += usize::from(*flat != 0.0);
            assert!((solid / DEPTH - flat).abs() < 1e-9 * most, "force in step {step}: {solid} of {flat} per metre");
        }
        assert!(touched > 10, "they meet: {touched}");
        for column in ["A.x", "A.y", "B.x", "B.y", "T.y"] {
            for (flat, solid) in plane.column(column).iter().zip(space.column(column)) {
                assert!((flat - solid).abs() < 1e-9, "{column}: {solid} of {flat}");
            }
        }
    }
}

#[test]
fn a_stiffness_for_each_node_belongs_to_the_model_as_far_as_the_node_does() {
    // In a slice of two layers the nodes in the middle carry a half, those on both faces a quarter of what a
    // node in 2D does.
    let plane = ring_on_strip(Penalty::PerNode(4e3).into());
    let mut space = extruded(plane.clone(), 2);
    space.contacts[0].interface = Penalty::PerNode(4e3 * DEPTH / 2.0).into();
    let (plane, space) = (to_end(&plane), to_end(&space));
    for column in ["energy.kinetic", "energy.internal"] {
        let (flat, solid) = (value(&plane, column), value(&space, column) / DEPTH);
        assert!((solid / flat - 1.0).abs() < 1e-9, "{column}: {solid} of {flat}");
    }
}

/// The upper half of a ring that a plate crushes, on a symmetry line; its steps are short enough for solids,
/// too.
fn half_of_crushed_ring() -> Model {
    let mut half = crushed_ring();
    half.parts.truncate(2);
    half.parts[0].shape =
        Shape::Ring(Ring { centre: [0.0, 0.0], inner: 0.046, outer: 0.05, from: 0.0, to: PI, elements: [2, 36], ..Ring::default() });
    half.probes.retain(|probe| probe.name == "top" || probe.name == "above");
    half.symmetries.push(Symmetry { normal: [0.0, 1.0, 0.0], ..Symmetry::default() });
    half.run.time_step = Some(1e-6);
    half
}

#[test]
fn a_slice_of_half_a_crushed_ring_meets_its_image_as_half_the_ring_of_2d_does() {
    let depth = 0.004;
    let half = half_of_crushed_ring();
    for &thickness in if is_long() { &[0.0, 1e-3][..] } else { &[1e-3] } {
        let mut plane = half.clone();
        // How flat an element is, is not the same in 2D and 3D: the same stiffness for both. The
        // plate begins nearer than the thickness.
        let law = Interface { thickness, initial_penetration: InitialPenetration::Ignore, ..Penalty::Pressure(5e12).into() };
        plane.contacts[0].interface = law;
        let space = extruded_by(depth, plane.clone(), 1);
        let [in_plane, in_3d] = [&plane, &space].map(|model| every_step(model).column("top.y").into_iter().fold(f64::INFINITY, f64::min));
        // The inside meets its image, and goes no deeper than the springs give. What the ring does before,
        // bent by the plate, differs from the first touch on by 1e-8 and grows: steps that are longer by
        // 1e-13 of themselves change either number by up to 2.3e-5, and their difference from -2.6e-5 to
        // 1.5e-5.
        assert!((in_plane - 0.5 * thickness).abs() < 2e-4 && (in_3d - in_plane).abs() < 6e-5, "{in_3d} of {in_plane}");
        let summary = to_end(&space).summary();
        assert!(summary.energy_drift < 0.01 && summary.ledger_residual < 1e-12 && summary.contact.unverified == 0, "{summary:?}");
    }
}

#[test]
fn balls_meet_their_images_in_a_symmetry_plane_too() {
    let mut model = extruded_by(0.004, half_of_crushed_ring(), 1);
    model.contacts[0].formulation = Formulation::Pinball;
    model.contacts[0].interface.initial_penetration = InitialPenetration::Ignore;
    let least = every_step(&model).column("top.y").into_iter().fold(f64::INFINITY, f64::min);
    // The ring is 4 mm thick and stops where its inside meets the plane; without images it goes through.
    assert!((-5e-4..1e-3).contains(&least), "{least}");
}
