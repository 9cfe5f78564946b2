//! Curves of the material laws under uniaxial stress, for `docs/elements-and-laws.md`: of materials of the
//! library, or of values that show what the law does.

use crate::model_file::{library, load_text};
use crate::picture::colour::DISTINCT;
use crate::picture::svg::{Abscissa, Curve, Group, Panel, Spacing, chart};
use embate_solver::material::uniaxial_curve;
use embate_solver::model::Material;
use std::path::Path;

/// How a law is shown.
struct Shown {
    law: &'static str,
    /// What the figure says.
    title: &'static str,
    /// Name and keys of the materials; none: those of the library.
    materials: &'static [(&'static str, &'static str)],
    path: Way,
    /// Rates of strain, 1/s; several are named in the figure.
    rates: &'static [f64],
}

/// How a test goes.
#[derive(Clone, Copy)]
enum Way {
    /// To a logarithmic strain; true stress.
    To(f64),
    /// In compression by a part of the length; stress per initial area, positive.
    Crushed(f64),
    /// To a stretch; stress per initial area.
    Stretched(f64),
    /// To and fro so many times.
    Cycles(f64, usize),
}

const SLOW: &[f64] = &[1.0];
/// Points of a curve.
const POINTS: usize = 240;
/// Most curves of a figure.
const CURVES: usize = 6;

const SHOWN: &[Shown] = &[
    Shown { law: "j2", title: "j2: materials of the library", materials: &[], path: Way::To(0.1), rates: SLOW },
    Shown {
        law: "j2_voce",
        title: "j2_voce: yield 200 MPa, saturation 400 MPa",
        materials: &[
            (
                "rate 5",
                "density = 7850\nyoung = \"200 GPa\"\npoisson = 0.3\nyield = \"200 MPa\"\nsaturation = \"400 MPa\"\nsaturation_rate = 5",
            ),
            (
                "rate 15",
                "density = 7850\nyoung = \"200 GPa\"\npoisson = 0.3\nyield = \"200 MPa\"\nsaturation = \"400 MPa\"\nsaturation_rate = 15",
            ),
            (
                "rate 50",
                "density = 7850\nyoung = \"200 GPa\"\npoisson = 0.3\nyield = \"200 MPa\"\nsaturation = \"400 MPa\"\nsaturation_rate = 50",
            ),
        ],
        path: Way::To(0.3),
        rates: SLOW,
    },
    Shown { law: "j2_swift", title: "j2_swift: material of the library", materials: &[], path: Way::To(0.3), rates: SLOW },
    Shown {
        law: "j2_ludwik",
        title: "j2_ludwik: yield 200 MPa, strength 400 MPa",
        materials: &[
            (
                "n = 0.2",
                "density = 7850\nyoung = \"200 GPa\"\npoisson = 0.3\nyield = \"200 MPa\"\nstrength = \"400 MPa\"\nhardening_exponent = 0.2",
            ),
            (
                "n = 0.4",
                "density = 7850\nyoung = \"200 GPa\"\npoisson = 0.3\nyield = \"200 MPa\"\nstrength = \"400 MPa\"\nhardening_exponent = 0.4",
            ),
            (
                "n = 0.8",
                "density = 7850\nyoung = \"200 GPa\"\npoisson = 0.3\nyield = \"200 MPa\"\nstrength = \"400 MPa\"\nhardening_exponent = 0.8",
            ),
        ],
        path: Way::To(0.3),
        rates: SLOW,
    },
    Shown { law: "j2_table", title: "j2_table: structural steels of the library", materials: &[], path: Way::To(0.2), rates: SLOW },
    Shown {
        law: "chaboche",
        title: "chaboche: five cycles of 1 % strain, Q = 100 MPa, C = 40 GPa, γ = 300",
        materials: &[(
            "steel",
            "density = 7850\nyoung = \"200 GPa\"\npoisson = 0.3\nyield = \"200 MPa\"\nisotropic_stress = \"100 MPa\"\nisotropic_rate = 10\n\
             backstress_modulus = [\"40 GPa\"]\nbackstress_recall = [300]",
        )],
        path: Way::Cycles(0.01, 5),
        rates: SLOW,
    },
    Shown {
        law: "johnson_cook",
        title: "johnson_cook: materials of the library, adiabatic, at 1/s and 10000/s",
        materials: &[
            ("copper OFHC", "from = \"copper OFHC\""),
            ("aluminium 2024-T351", "from = \"aluminium 2024-T351\""),
            ("steel 4340", "from = \"steel 4340\""),
        ],
        path: Way::To(0.6),
        rates: &[1.0, 1e4],
    },
    Shown {
        law: "crushable_foam",
        title: "crushable_foam: foams of the library, crushed",
        materials: &[],
        path: Way::Crushed(0.82),
        rates: SLOW,
    },
    Shown {
        law: "neo_hookean",
        title: "neo_hookean: E = 3 MPa, stress per initial area",
        materials: &[
            ("ν = 0.49", "density = 1000\nyoung = \"3 MPa\"\npoisson = 0.49"),
            ("ν = 0.3", "density = 1000\nyoung = \"3 MPa\"\npoisson = 0.3"),
        ],
        path: Way::Stretched(4.0),
        rates: SLOW,
    },
    Shown {
        law: "mooney_rivlin",
        title: "mooney_rivlin: material of the library, stress per initial area",
        materials: &[],
        path: Way::Stretched(3.0),
        rates: SLOW,
    },
    Shown {
        law: "yeoh",
        title: "yeoh: c10 = 0.2 MPa, stress per initial area",
        materials: &[
            ("c30 = 0", "density = 1000\nc10 = \"0.2 MPa\"\nbulk = \"2 GPa\""),
            ("c30 = 50 Pa", "density = 1000\nc10 = \"0.2 MPa\"\nc30 = \"50 Pa\"\nbulk = \"2 GPa\""),
            ("c20 = -1.2 kPa, c30 = 50 Pa", "density = 1000\nc10 = \"0.2 MPa\"\nc20 = \"-1.2 kPa\"\nc30 = \"50 Pa\"\nbulk = \"2 GPa\""),
        ],
        path: Way::Stretched(7.0),
        rates: SLOW,
    },
    Shown {
        law: "arruda_boyce",
        title: "arruda_boyce: material of the library, stress per initial area",
        materials: &[],
        path: Way::Stretched(7.5),
        rates: SLOW,
    },
    Shown {
        law: "ogden",
        title: "ogden: material of the library, stress per initial area",
        materials: &[],
        path: Way::Stretched(7.5),
        rates: SLOW,
    },
    Shown {
        law: "viscoelastic",
        title: "viscoelastic: E = 3 GPa, half of it relaxes in 1 ms",
        materials: &[("polymer", "density = 1200\nyoung = \"3 GPa\"\npoisson = 0.35\nshear_ratio = [0.5]\nrelaxation_time = [\"1 ms\"]")],
        path: Way::To(0.02),
        rates: &[0.1, 10.0, 1e3],
    },
];

/// Whether there is a figure of a law.
pub(super) fn has_curve(law: &str) -> bool {
    SHOWN.iter().any(|shown| shown.law == law)
}

/// The figures of the laws, as texts of SVG files, by the names of the laws.
#[must_use]
pub fn law_curves() -> Vec<(&'static str, String)> {
    SHOWN.iter().map(|shown| (shown.law, figure(shown))).collect()
}

fn figure(shown: &Shown) -> String {
    let own = || shown.materials.iter().map(|(name, keys)| ((*name).to_string(), (*keys).to_string()));
    let of_library = library().iter().filter(|material| material.law == shown.law).take(CURVES);
    let of_library = of_library.map(|material| (material.name.clone(), format!("from = \"{}\"", material.name)));
    let materials: Vec<(String, String)> = if shown.materials.is_empty() { of_library.collect() } else { own().collect() };
    let mut curves = Vec::new();
    for (index, (name, keys)) in materials.iter().enumerate() {
        for (at, &rate) in shown.rates.iter().enumerate() {
            let name = if shown.rates.len() > 1 { format!("{name}, {rate}/s") } else { name.clone() };
            let place = if materials.len() > 1 { index } else { at };
            let dashes = if materials.len() > 1 && at > 0 { "6 4" } else { "" };
            let points = material(shown.law, keys).map(|material| points(&material, shown.path, rate)).unwrap_or_default();
            curves.push(Curve { name, colour: DISTINCT[place % DISTINCT.len()], dashes, width: 2.0, dots: false, points });
        }
    }
    let abscissa = match shown.path {
        Way::To(_) | Way::Cycles(..) => "logarithmic strain",
        Way::Crushed(_) => "compression over initial length",
        Way::Stretched(_) => "stretch",
    };
    let abscissa = Abscissa { name: abscissa.into(), si: String::new(), spacing: Spacing::Even };
    let panel = Panel { name: "stress".into(), si: "Pa", from_zero: true, height: 300.0, curves, remark: String::new() };
    chart(shown.title, &[Group { abscissa, panels: vec![panel] }])
}

/// A material from its keys.
fn material(law: &str, keys: &str) -> Option<Material> {
    let text = format!(
        "[run]\nend = \"1 us\"\n[material.shown]\nlaw = \"{law}\"\n{keys}\n[[part]]\nname = \"block\"\nmaterial = \"shown\"\n\
         rectangle = {{ corner = [0, 0], size = [1, 1], elements = [1, 1] }}\n"
    );
    load_text("shown", &text, Path::new("."), &[]).ok()?.materials.remove("shown")
}

/// Strain and stress as they are shown.
fn points(material: &Material, path: Way, rate: f64) -> Vec<[f64; 2]> {
    let part = |k: usize| k as f64 / POINTS as f64;
    let strains: Vec<f64> = match path {
        Way::To(end) => (0..=POINTS).map(|k| end * part(k)).collect(),
        Way::Crushed(end) => (0..=POINTS).map(|k| (1.0 - end * part(k)).ln()).collect(),
        Way::Stretched(end) => (0..=POINTS).map(|k| (1.0 + (end - 1.0) * part(k)).ln()).collect(),
        Way::Cycles(end, count) => {
            // Up, down and back, a quarter of a cycle each.
            let triangle = |t: f64| {
                if t < 0.25 {
                    4.0 * t
                } else if t < 0.75 {
                    2.0 - 4.0 * t
                } else {
                    4.0 * t - 4.0
                }
            };
            (0..=count * POINTS).map(|k| end * triangle(part(k).fract())).collect()
        }
    };
    let stresses = uniaxial_curve(material, &strains, rate).unwrap_or_default();
    let shown = |(&strain, [stress, area]): (&f64, [f64; 2])| match path {
        Way::To(_) | Way::Cycles(..) => [strain, stress],
        Way::Crushed(_) => [1.0 - strain.exp(), -stress * area],
        Way::Stretched(_) => [strain.exp(), stress * area],
    };
    strains.iter().zip(stresses).map(shown).collect()
}
