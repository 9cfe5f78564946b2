//! Element kernels: million element-steps per second on one core, per element, law and instruction set,
//! beside the scalar lane in the same run.
//!
//! `cargo bench -p embate-solver --bench kernel [-- ELEMENT... LAW...]`: all, or some elements with some
//! laws. With `--features count` also the operations per element and step: additions, multiplications,
//! divisions, roots, and others (comparisons, selections, signs); rates mean nothing then.

use embate_solver::bench::{Level, Patch, kernel};
use embate_solver::block::Blocks;
use embate_solver::element::ELEMENTS_OF_SPACE;
use embate_solver::material::LAWS;
use embate_solver::tensor::Dim;

/// Time for each figure, s.
const SECONDS: f64 = 0.3;

/// Laws that every element is measured with; the others with `quad4` in cache.
const FEW: [&str; 3] = ["elastic", "j2", "neo_hookean"];

/// Prints the rates of an element with a law on every instruction set.
fn measure<const D: usize>(element: &str, law: &str, patch: &Patch<D>)
where
    Dim<D>: Blocks<D>,
{
    let mut line = format!("  {element:<28} {law:<19}");
    let mut scalar = 0.0;
    for level in Level::available() {
        let rate = 1e-6 * kernel(element, law, patch, level, SECONDS).expect("registered names");
        if level == Level::SCALAR {
            scalar = rate;
        }
        line += &format!("  {} {rate:6.1} ({:.2})", level.name(), rate / scalar);
    }
    #[cfg(feature = "count")]
    {
        let [additions, multiplications, divisions, roots, others] =
            embate_solver::bench::operations(element, law, patch).expect("registered names");
        line += &format!("  {additions:.0} + {multiplications:.0} * {divisions:.1} / {roots:.1} roots, {others:.0} others");
    }
    println!("{line}");
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let wanted = |element: &str, law: &str| words.is_empty() || words.contains(&element.to_string()) && words.contains(&law.to_string());
    println!("million element-steps per second, one core, best of several rounds (ratio to scalar)");
    for (elements, n) in [("in cache, 1,024 elements", 32), ("out of cache, 1,048,576 elements", 1024)] {
        println!("{elements}");
        let patch = Patch::new(n);
        for element in ["quad4", "quad4_full", "quad4_reduced", "quad4_reduced_viscous", "quad4_reduced_assumed_strain"] {
            for law in LAWS.iter().map(|kind| kind.name).filter(|law| n < 100 && element == "quad4" || FEW.contains(law)) {
                if wanted(element, law) {
                    measure(element, law, &patch);
                }
            }
        }
    }
    println!("in 3D, in cache: 1,000 hexahedra, 686 wedges, 750 tetrahedra of four or ten nodes");
    for kind in ELEMENTS_OF_SPACE {
        let in_cube = kind.cell.facts().division.len() / kind.cell.corners();
        let n = (1..).take_while(|n| n * n * n * in_cube <= 1000).last().unwrap_or(1);
        let patch = Patch::solid(kind.cell, n);
        for law in FEW {
            if wanted(kind.name, law) {
                measure(kind.name, law, &patch);
            }
        }
    }
}
