//! Element kernels: million element-steps per second on one core, per element, law and instruction set, beside the scalar lane in the same run.
//!
//! `cargo bench -p embate-solver --bench kernel [-- ELEMENT... LAW...]`: all, or some elements with some laws.

use embate_lanes::{Level, Team};
use embate_solver::block::{Block, BlockInput, Motion, make};
use embate_solver::material::LAWS;
use embate_solver::model::Material;
use std::time::Instant;

/// Laws that every element is measured with; the others with `quad4` in cache.
const FEW: [&str; 3] = ["elastic", "j2", "neo_hookean"];

/// Parameters of any law: steel that flows at once and hardens strongly; rubbers and orthotropic bodies of its stiffness.
const NUMBERS: &[(&str, f64)] = &[
    ("density", 7800.0),
    ("young", 2e11),
    ("poisson", 0.3),
    ("yield", 1e8),
    ("hardening", 5e10),
    ("saturation", 5e8),
    ("saturation_rate", 20.0),
    ("strength", 5e8),
    ("strain_offset", 0.002),
    ("hardening_exponent", 0.3),
    ("isotropic_stress", 1e8),
    ("rate_coefficient", 0.02),
    ("temperature_melt", 1800.0),
    ("specific_heat", 460.0),
    ("cohesion", 1e8),
    ("friction_angle", 0.5),
    ("dilation_angle", 0.1),
    ("bulk", 2e11),
    ("shear", 8e10),
    ("c10", 3e10),
    ("c20", 1e10),
    ("c30", 1e9),
    ("c01", 1e10),
    ("locking_stretch", 5.0),
    ("young_1", 2e11),
    ("young_2", 1e11),
    ("young_3", 1e11),
    ("poisson_12", 0.3),
    ("poisson_23", 0.3),
    ("poisson_31", 0.1),
    ("shear_12", 5e10),
    ("angle", 0.5),
];
const LISTS: &[(&str, &[f64])] = &[
    ("plastic_strain", &[0.0, 0.1, 0.2, 0.5]),
    ("stress", &[1e8, 2e8, 3e8, 4e8]),
    ("backstress_modulus", &[5e10, 1e10, 1e9]),
    ("backstress_recall", &[500.0, 50.0, 0.0]),
    ("mu", &[6e10, -1e10, 1e9]),
    ("alpha", &[2.0, -2.0, 5.0]),
    ("shear_ratio", &[0.2, 0.3]),
    ("relaxation_time", &[1e-3, 1e-6]),
];

/// A square of `n` × `n` elements in a swirling, stretching motion that yields.
fn patch(n: usize) -> (Vec<[f64; 2]>, Vec<[f64; 2]>, Vec<u32>) {
    let node = |i: usize, j: usize| (j * (n + 1) + i) as u32;
    let positions: Vec<[f64; 2]> = (0..(n + 1) * (n + 1)).map(|k| [(k % (n + 1)) as f64 * 1e-3, (k / (n + 1)) as f64 * 1e-3]).collect();
    let velocities = positions.iter().map(|[x, y]| [100.0 * y + 20.0 * x, -80.0 * x + 5.0 * y]).collect();
    let quads = (0..n * n).flat_map(|k| {
        let (i, j) = (k % n, k / n);
        [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)]
    });
    (positions, velocities, quads.collect())
}

fn rate(block: &mut dyn Block<2>, positions: &[[f64; 2]], velocities: &[[f64; 2]], level: Level) -> f64 {
    let mut slots = vec![[0.0; 2]; block.slots().len()];
    let motion = Motion { positions, velocities, time_step: 1e-7 };
    // Many short rounds: some of them are undisturbed by what else the machine does.
    let (mut best, began) = (f64::INFINITY, Instant::now());
    let repeats = (20_000 / block.elements()).max(1);
    while began.elapsed().as_secs_f64() < 0.4 {
        let start = Instant::now();
        for _ in 0..repeats {
            std::hint::black_box(block.advance(&motion, level, &mut slots, &mut Team::alone()));
        }
        best = best.min(start.elapsed().as_secs_f64() / (repeats * block.elements()) as f64);
    }
    1e-6 / best
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let wanted = |element: &str, law: &str| words.is_empty() || words.contains(&element.to_string()) && words.contains(&law.to_string());
    println!("million element-steps per second, one core, best of many (ratio to scalar)");
    for (elements, n) in [("in cache, 1,024 elements", 32), ("out of cache, 1,048,576 elements", 1024)] {
        println!("{elements}");
        let (positions, velocities, connectivity) = patch(n);
        for element in ["quad4", "quad4_full", "quad4_reduced", "quad4_reduced_viscous", "quad4_reduced_assumed_strain"] {
            for law in LAWS.iter().map(|kind| kind.name).filter(|law| n < 100 && element == "quad4" || FEW.contains(law)) {
                if !wanted(element, law) {
                    continue;
                }
                let parameters = NUMBERS.iter().map(|(name, value)| ((*name).to_string(), *value)).collect();
                let lists = LISTS.iter().map(|(name, list)| ((*name).to_string(), list.to_vec())).collect();
                let material = Material { law: law.into(), parameters, lists, ..Material::default() };
                let input = BlockInput::new(element, &material, &connectivity, &positions);
                let mut line = format!("  {element:<28} {law:<19}");
                let mut scalar = 0.0;
                for level in Level::available() {
                    let mut block = make(&input).expect("registered names");
                    let rate = rate(block.as_mut(), &positions, &velocities, level);
                    if level == Level::SCALAR {
                        scalar = rate;
                    }
                    line += &format!("  {} {rate:6.1} ({:.2})", level.name(), rate / scalar);
                }
                println!("{line}");
            }
        }
    }
}
