//! What is measured can be measured: kernels of every law and element, and whole steps.

use embate_solver::bench::{Level, Patch, kernel, spinning_block, spinning_cube, step};
use embate_solver::material::LAWS;
use embate_solver::simulation::Options;

#[test]
fn every_law_can_be_measured_in_a_kernel_and_the_usual_ones_in_a_whole_step() {
    let patch = Patch::new(4);
    for law in LAWS {
        let rate = kernel("quad4", law.name, &patch, Level::best(), 0.0).unwrap();
        assert!(rate.is_finite() && rate > 0.0, "{}", law.name);
    }
    for element in ["quad4", "quad4_reduced"] {
        for law in ["elastic", "j2", "neo_hookean"] {
            let rate = step(&spinning_block(element, law, 16), &Options::default(), 0.0).unwrap();
            assert!(rate.is_finite() && rate > 0.0, "{element} {law}");
        }
    }
}

#[test]
fn every_element_of_3d_can_be_measured_in_a_kernel_and_a_cube_in_whole_steps() {
    for kind in embate_solver::element::ELEMENTS_OF_SPACE {
        let patch = Patch::solid(kind.cell, 3);
        let rate = kernel(kind.name, "j2", &patch, Level::best(), 0.0).unwrap();
        assert!(rate.is_finite() && rate > 0.0, "{}", kind.name);
    }
    let rate = step(&spinning_cube("hex8_reduced", "j2", 4), &Options::default(), 0.0).unwrap();
    assert!(rate.is_finite() && rate > 0.0);
}

#[test]
fn what_is_not_there_is_reported() {
    assert!(kernel("quad5", "j2", &Patch::new(2), Level::SCALAR, 0.0).is_err());
    assert!(step(&spinning_block("quad4", "j3", 2), &Options::default(), 0.0).is_err());
}
