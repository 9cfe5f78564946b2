//! States that were changed behind their check sums: what the fuzz target `state` found.

use embate_files::model_file::load_text;
use embate_solver::archive::Section;
use embate_solver::simulation::{Options, Simulation};
use std::path::Path;

/// Two elements of two parts that meet and may fail.
const MEETING: &str = r#"
run.end = "1 ms"
material.steel = { law = "j2", density = 7800, young = "200 GPa", poisson = 0.3, yield = "100 MPa", hardening = "1 GPa", failure = { plastic_strain = 0.001 } }
part = [
    { name = "a", material = "steel", element = "quad4_reduced", rectangle = { corner = [0, 0], size = [0.01, 0.01], elements = [1, 1] }, velocity = [500, 0] },
    { name = "b", material = "steel", rectangle = { corner = [0.012, 0.001], size = [0.01, 0.01], elements = [1, 1] } },
]
contact = [{ name = "all", bodies = "all" }]
output.pictures = false
"#;

/// A lane that only fills a batch up was taken for an element that is there, failed with its neighbour, and
/// was looked up among the elements.
#[test]
fn lanes_without_an_element_are_never_alive() {
    let model = load_text("model.toml", MEETING, Path::new("."), &[]).unwrap_or_else(|reported| panic!("{}", reported.rendered));
    let options = Options { threads: 1, simd: None };
    let mut simulation = Simulation::new(&model, &options).unwrap();
    simulation.advance(f64::INFINITY, 1).unwrap();
    let sections = simulation.state().unwrap().sections;
    // An element is a one, and the seven lanes after it are zeros.
    let lanes: Vec<u8> = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0_f64].iter().flat_map(|live| live.to_le_bytes()).collect();
    let (mut tried, mut refused) = (0, 0);
    for (number, section) in sections.iter().enumerate() {
        for at in 0..section.bytes.len().saturating_sub(lanes.len()) {
            if section.bytes[at..].starts_with(&lanes) {
                for live in [1.0, 0.5, -1.0, f64::NAN] {
                    let mut damaged: Vec<Section> = sections.clone();
                    damaged[number].bytes[at + 16..at + 24].copy_from_slice(&f64::to_le_bytes(live));
                    tried += 1;
                    match Simulation::resumed(&model, &options, &damaged) {
                        Ok(mut simulation) => drop(simulation.advance(f64::INFINITY, 60)),
                        Err(error) => refused += usize::from(error.to_string().contains("neither there nor gone")),
                    }
                }
            }
        }
    }
    assert!(tried >= 8 && refused >= 8, "{refused} of {tried}: both parts have lanes that fill up");
}
