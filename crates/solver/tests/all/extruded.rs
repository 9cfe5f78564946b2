//! A body of hexahedra that is held in plane strain answers as the quadrilaterals that it was drawn out of:
//! every law, also with an equation of state, by both ways through the kernels.

use crate::patches::{Body, Patch, Spread, lists, material, parameters, patch, solids};
use embate_solver::block::BlockInput;
use embate_solver::element::ElementOptions;
use embate_solver::material::LAWS;
use embate_solver::model::Material;

/// Depth of the body, in two layers.
const DEPTH: f64 = 1.5;

/// The quadrilaterals drawn out along z in two layers of unequal depth.
fn extruded(plane: &Patch) -> Patch<3> {
    let count = plane.positions.len() as u32;
    let layers = [0.0, 0.6, DEPTH];
    let positions = layers.iter().flat_map(|&z| plane.positions.iter().map(move |&[x, y]| [x, y, z])).collect();
    let cell = |(layer, quad): (u32, &[u32])| -> Vec<u32> {
        let low = quad.iter().map(|node| node + layer * count);
        low.chain(quad.iter().map(|node| node + (layer + 1) * count)).collect()
    };
    let cells = (0..2).flat_map(|layer| plane.connectivity.chunks(4).map(move |quad| (layer, quad)));
    Patch { positions, connectivity: cells.flat_map(cell).collect(), inner: Vec::new() }
}

/// Every law by itself, and fluid and solid with an equation of state.
fn materials() -> Vec<Material> {
    let with_equation = ["null", "j2", "elastic"].map(|law| {
        let kind = LAWS.iter().find(|kind| kind.name == law).unwrap();
        let mut parameters = parameters(kind, 0.3);
        parameters.insert("bulk_modulus".into(), 900.0);
        Material { law: law.into(), eos: "linear".into(), parameters, lists: lists(kind), ..Material::default() }
    });
    solids().map(|law| material(law.name, 0.3)).chain(with_equation).collect()
}

#[test]
fn a_body_held_in_plane_strain_answers_as_its_section() {
    let plane = patch("quad4", 3, 0.25);
    let space = extruded(&plane);
    for [quad, hex] in [["quad4", "hex8"], ["quad4_reduced", "hex8_reduced"]] {
        for law in materials() {
            let options = ElementOptions { hourglass: Some(0.0) };
            let viscosity = if law.eos.is_empty() { None } else { Some([0.0, 0.0]) };
            let input = BlockInput { options, viscosity, ..BlockInput::new(quad, &law, &plane.connectivity, &plane.positions) };
            let mut section = Body::made(&input);
            let input = BlockInput { options, viscosity, ..BlockInput::new(hex, &law, &space.connectivity, &space.positions) };
            let mut body = Body::made(&input);
            let name = format!("{hex} {} {}", law.law, law.eos);
            let mut numbers = Spread::new(31);
            for _ in 0..10 {
                let moves: Vec<[f64; 2]> = plane.positions.iter().map(|_| numbers.vector(0.01)).collect();
                let to: Vec<[f64; 2]> =
                    section.positions.iter().zip(&moves).map(|(x, u)| [x[0] + u[0], x[1] + 0.01 * x[0] + u[1]]).collect();
                body.move_to(
                    &body.positions.iter().enumerate().map(|(k, x)| [to[k % to.len()][0], to[k % to.len()][1], x[2]]).collect::<Vec<_>>(),
                );
                section.move_to(&to);
            }
            let size = (0..9).flat_map(|k| section.block.state(k).stress).fold(0.0f64, |size, s| size.max(s.abs()));
            assert!(size > 0.0, "{name}");
            for k in 0..body.block.elements() {
                let (own, expected) = (body.block.state(k), section.block.state(k % 9));
                assert!((0..6).all(|c| (own.stress[c] - expected.stress[c]).abs() < 1e-10 * size), "{name} {k}: {own:?} {expected:?}");
                let energies = (own.energy_density, expected.energy_density);
                assert!((energies.0 - energies.1).abs() < 1e-9 * energies.1.abs().max(1e-6 * size), "{name} {k}: {energies:?}");
            }
            for (a, b) in [(body.report.stored, section.report.stored), (body.report.dissipated, section.report.dissipated)] {
                assert!((a - b * DEPTH).abs() < 1e-9 * (a.abs() + 1e-6 * size), "{name}: {a} for {}", b * DEPTH);
            }
            // All forces of a line along z together are that of the section times the depth.
            let (forces, expected) = (body.forces(), section.forces());
            let most = expected.iter().flatten().fold(0.0f64, |most, f| most.max(f.abs()));
            for (k, expected) in expected.iter().enumerate() {
                for d in 0..2 {
                    let sum: f64 = forces.iter().skip(k).step_by(plane.positions.len()).map(|f| f[d]).sum();
                    assert!((sum - expected[d] * DEPTH).abs() < 1e-10 * most, "{name} node {k}: {sum} for {}", expected[d] * DEPTH);
                }
            }
        }
    }
}
