//! Decks of shells and beams: what becomes of them, and that their models are as stiff and as heavy as closed
//! forms say.

use embate_files::PathPolicy;
use embate_files::abaqus::import::{Imported, Units, import};
use embate_files::model_file::load_text;
use embate_solver::error::Fault;
use embate_solver::model::{Load, Model, Relaxation};
use embate_solver::simulation::{Options, Simulation};
use std::fmt::Write;
use std::fs;

const STEEL: &str = "*MATERIAL, NAME=STEEL\n*DENSITY\n7.85e-9\n*ELASTIC\n210000, 0.3\n";
/// Without lateral contraction, so that a strip is a beam.
const PLAIN: &str = "*MATERIAL, NAME=STEEL\n*DENSITY\n7.85e-9\n*ELASTIC\n210000, 0\n";
const E: f64 = 210_000.0;

fn made(deck: &str) -> Result<(Imported, Model), Vec<Fault>> {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("deck.inp"), deck).unwrap();
    let made = import(&folder.path().join("deck.inp"), &Units::parse("mm,t,s").unwrap(), PathPolicy::Folder)?;
    fs::write(folder.path().join("mesh.inp"), &made.mesh).unwrap();
    let model = load_text("m", &made.model, folder.path(), &[]).unwrap_or_else(|diagnostics| panic!("{diagnostics}\n{}", made.model));
    Ok((made, model))
}

fn imported(deck: &str) -> (Imported, Model) {
    made(deck).unwrap_or_else(|faults| panic!("{faults:#?}"))
}

/// All is used, but for what is approximated.
fn kept(deck: &str) -> (Imported, Model) {
    let it = imported(deck);
    assert!(it.0.report.text().contains("nothing was ignored"), "{}", it.0.report.text());
    it
}

/// A grid of n × m quadrilaterals, or twice as many triangles, on [0, a] × [0, b] at a height z, mm; nodes
/// from `first` on, column by column.
fn grid(set: &str, kind: &str, [n, m]: [usize; 2], [a, b, z]: [f64; 3], first: usize) -> String {
    let mut deck = format!("*NODE, NSET=N-{set}\n");
    let node = |i: usize, j: usize| first + i * (m + 1) + j;
    for i in 0..=n {
        for j in 0..=m {
            let _ = writeln!(deck, "{}, {:?}, {:?}, {z:?}", node(i, j), a * i as f64 / n as f64, b * j as f64 / m as f64);
        }
    }
    let _ = writeln!(deck, "*ELEMENT, TYPE={kind}, ELSET={set}");
    for (number, (i, j)) in (0..n).flat_map(|i| (0..m).map(move |j| (i, j))).enumerate() {
        let [p, q, r, s] = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
        let number = first + 2 * number;
        let _ = match kind.starts_with("S3") || kind == "M3D3" {
            true => writeln!(deck, "{number}, {p}, {q}, {r}\n{}, {p}, {r}, {s}", number + 1),
            false => writeln!(deck, "{number}, {p}, {q}, {r}, {s}"),
        };
    }
    for (name, at) in [("X0", 0), ("X1", n)] {
        let _ = writeln!(deck, "*NSET, NSET={name}-{set}, GENERATE\n{}, {}", node(at, 0), node(at, m));
    }
    for (name, at) in [("Y0", 0), ("Y1", m)] {
        let _ = writeln!(deck, "*NSET, NSET={name}-{set}, GENERATE\n{}, {}, {}", node(0, at), node(n, at), m + 1);
    }
    deck
}

fn step(more: &str) -> String {
    format!("*STEP\n*DYNAMIC, EXPLICIT\n, 1.\n{more}*END STEP\n")
}

/// Displacement at rest of the node at a place, mm.
fn at_rest<const D: usize>(model: &Model, place: [f64; D]) -> [f64; D]
where
    embate_solver::tensor::Dim<D>: embate_solver::dimension::Dimension<D>,
{
    let mut model = model.clone();
    model.run.relaxation = Some(Relaxation { tolerance: 1e-10, ..Relaxation::default() });
    let mut simulation = Simulation::new(&model, &Options::default()).unwrap_or_else(|error| panic!("{error:#?}"));
    let start = simulation.frame().positions::<D>().to_vec();
    let node = start.iter().position(|x| (0..D).all(|k| (x[k] - 1e-3 * place[k]).abs() < 1e-9)).unwrap();
    simulation.advance(model.run.end, u64::MAX).unwrap();
    assert!(simulation.time() < model.run.end, "not at rest");
    let now = simulation.frame().positions::<D>()[node];
    std::array::from_fn(|k| 1e3 * (now[k] - start[node][k]))
}

fn near(found: f64, expected: f64, part: f64) {
    assert!((found / expected - 1.0).abs() < part, "{found:e} instead of {expected:e}: {:+.4} %", 100.0 * (found / expected - 1.0));
}

/// Deflection of a cantilever under a force at its end: bending, and shear with 5/6 of the area.
fn cantilever(force: f64, length: f64, inertia: f64, area: f64, shear: f64) -> f64 {
    force * length.powi(3) / (3.0 * E * inertia) + force * length / (5.0 / 6.0 * area * shear)
}

#[test]
fn a_cantilever_of_shells_bends_as_a_beam() {
    for (kind, elements, tolerance) in [("S4R", [16, 2], 2e-3), ("S4", [16, 2], 2e-3), ("S3R", [16, 2], 1e-2)] {
        let deck = format!(
            "{}*SHELL SECTION, ELSET=SHEET, MATERIAL=STEEL\n1.5, 5\n{PLAIN}*BOUNDARY\nX0-SHEET, ENCASTRE\n{}",
            grid("SHEET", kind, elements, [100.0, 10.0, 0.0], 1),
            step("*CLOAD\nX1-SHEET, 3, 0.1\n")
        );
        let (made, model) = kept(&deck);
        assert_eq!(model.parts[0].element, if kind == "S3R" { "shell3" } else { "shell4" });
        assert!(made.model.contains("section = { thickness = \"1.5 mm\", points = 5 }"), "{}", made.model);
        assert!(made.model.contains("fixed = [\"x\", \"y\", \"z\", \"rotation\"]"), "{}", made.model);
        let expected = cantilever(0.3, 100.0, 10.0 * 1.5f64.powi(3) / 12.0, 15.0, 0.5 * E);
        near(at_rest(&model, [100.0, 10.0, 0.0])[2], expected, tolerance);
    }
}

#[test]
fn moments_on_edges_bend_shells_into_arcs() {
    // A moment M about y at the end lifts it by -M L² / 2 E I; and of axes alone rotations are held.
    let deck = format!(
        "{}*SHELL SECTION, ELSET=SHEET, MATERIAL=STEEL, SECTION INTEGRATION=GAUSS\n1.5, 3\n{PLAIN}\
         *BOUNDARY\nX0-SHEET, 1, 3\nX0-SHEET, 5, 6\n{}",
        grid("SHEET", "S4R", [8, 2], [100.0, 10.0, 0.0], 1),
        step("*CLOAD\nX1-SHEET, 5, -2.\n")
    );
    let (made, model) = kept(&deck);
    assert!(made.model.contains("spin = { y = 0, z = 0 }") && made.model.contains("moment = ["), "{}", made.model);
    assert!(matches!(&model.loads[..], [Load::Moment { moment: [0.0, m, 0.0], .. }] if (m + 6e-3).abs() < 1e-12), "{}", made.model);
    let expected = 6.0 * 100.0f64.powi(2) / (2.0 * E * 10.0 * 1.5f64.powi(3) / 12.0);
    near(at_rest(&model, [100.0, 0.0, 0.0])[2], expected, 2e-3);
}

#[test]
fn a_plate_under_pressure_bends_along_its_normal() {
    // A quarter of a square plate on simple supports: Navier's series. XSYMM and YSYMM hold rotations.
    let (a, t, p) = (100.0, 1.0, 1e-4);
    let quarter = |load: &str| {
        format!(
            "{}*SHELL SECTION, ELSET=PLATE, MATERIAL=STEEL\n{t:?}\n{STEEL}*BOUNDARY\nX0-PLATE, XSYMM\nY0-PLATE, YSYMM\n\
             X1-PLATE, 2, 4\nY1-PLATE, 3\nY1-PLATE, 1\nY1-PLATE, 5\n{}",
            grid("PLATE", "S4R", [10, 10], [0.5 * a, 0.5 * a, 0.0], 1),
            step(load)
        )
    };
    let stiffness = E * t * t * t / (12.0 * (1.0 - 0.09));
    let odd = |k: usize| (2 * k + 1) as f64;
    let term = |m: f64, n: f64, sign: f64| sign / (m * n * (m * m + n * n).powi(2));
    let sum: f64 = (0..40)
        .flat_map(|i| (0..40).map(move |j| (i, j)))
        .map(|(i, j)| term(odd(i), odd(j), if (i + j) % 2 == 0 { 1.0 } else { -1.0 }))
        .sum();
    let expected = 16.0 * p * a.powi(4) * sum / (std::f64::consts::PI.powi(6) * stiffness);
    // P is along the normal, which looks to +z; a pressure on the upper face is against it.
    let faces = "*SURFACE, NAME=UP\nPLATE, SPOS\n";
    for (load, sign) in [("*DLOAD\nPLATE, P, 1e-4\n".to_string(), 1.0), ("*DSLOAD\nUP, P, 1e-4\n".to_string(), -1.0)] {
        let (made, model) = kept(&quarter(&load).replace("*SHELL SECTION", &format!("{faces}*SHELL SECTION")));
        assert!(made.model.contains("pressure = "), "{}", made.model);
        near(at_rest(&model, [0.0, 0.0, 0.0])[2], sign * expected, 1e-2);
    }
}

/// A beam of ten elements along a direction, held at its first node.
fn beam(along: [f64; 3], kind: &str, section: &str, more: &str) -> String {
    let mut deck = String::from("*NODE\n");
    for k in 0..=10 {
        let [x, y, z] = along.map(|d| 10.0 * k as f64 * d);
        let _ = writeln!(deck, "{}, {x:?}, {y:?}, {z:?}", k + 1);
    }
    let _ = writeln!(deck, "*ELEMENT, TYPE={kind}, ELSET=BEAM");
    for k in 1..=10 {
        let _ = writeln!(deck, "{k}, {k}, {}", k + 1);
    }
    format!("{deck}{section}{PLAIN}*BOUNDARY\n1, 1, 6\n{}", step(more))
}

#[test]
fn a_cantilever_of_beams_bends_about_both_axes_of_its_section() {
    // n1 is y, so that n2 = x × y is z: a is along y, b along z.
    let rect = "*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION=RECT\n2., 5.\n0., 1., 0.\n";
    let along = [1.0, 0.0, 0.0];
    for (axis, inertia) in [(2, 5.0 * 2.0f64.powi(3) / 12.0), (3, 2.0 * 5.0f64.powi(3) / 12.0)] {
        let (_, model) = kept(&beam(along, "B31", rect, &format!("*CLOAD\n11, {axis}, 0.2\n")));
        assert_eq!(model.parts[0].element, "beam2");
        near(at_rest(&model, [100.0, 0.0, 0.0])[axis - 1], cantilever(0.2, 100.0, inertia, 10.0, 0.5 * E), 5e-3);
    }
    // Bending about n1 = y, by I11, and about n2 = z.
    let sections = [
        (
            "*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION=I\n5., 10., 6., 6., 1., 1., 0.5\n0., 1., 0.\n",
            "i",
            [(6.0 * 1000.0 - 5.5 * 512.0) / 12.0, (2.0 * 216.0 + 8.0 * 0.125) / 12.0],
        ),
        (
            "*BEAM GENERAL SECTION, ELSET=BEAM, SECTION=GENERAL, DENSITY=7.85e-9\n10., 30., 0., 7., 12.\n0., 1., 0.\n210000., 105000.\n",
            "given",
            [30.0, 7.0],
        ),
        (
            "*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION=BOX\n4., 8., 0.5, 0.5, 0.5, 0.5\n0., 1., 0.\n",
            "box",
            [(4.0 * 512.0 - 3.0 * 343.0) / 12.0, (8.0 * 64.0 - 7.0 * 27.0) / 12.0],
        ),
        ("*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION=PIPE\n3., 0.5\n", "tube", [std::f64::consts::PI * (81.0 - 39.0625) / 4.0; 2]),
        ("*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION=CIRC\n3.\n", "round", [std::f64::consts::PI * 81.0 / 4.0; 2]),
    ];
    for (section, shape, [i11, i22]) in sections {
        // A moment about y lifts the end along -z, one about z along y.
        for (dof, axis, inertia) in [(5, 2, -i11), (6, 1, i22)] {
            let (made, model) = imported(&beam(along, "B31", section, &format!("*CLOAD\n11, {dof}, 20.\n")));
            // A general section has a material of its own.
            let ignored = if shape == "given" { "no section has the material STEEL" } else { "nothing was ignored" };
            assert!(made.report.text().contains(ignored), "{}", made.report.text());
            assert_eq!(model.parts[0].profile.as_ref().unwrap().shape, shape, "{}", made.model);
            let found = at_rest(&model, [100.0, 0.0, 0.0])[axis];
            near(found, 20.0 * 1e4 / (2.0 * E * inertia), 2e-3);
        }
    }
    // Turned, with the default direction -z: a is along z.
    let rect = "*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION=RECT\n2., 5.\n";
    let (_, model) = kept(&beam([0.6, 0.8, 0.0], "B31", rect, "*CLOAD\n11, 3, 0.2\n"));
    near(at_rest(&model, [60.0, 80.0, 0.0])[2], cantilever(0.2, 100.0, 5.0 * 8.0 / 12.0, 10.0, 0.5 * E), 5e-3);
}

#[test]
fn an_i_with_elements_of_many_directions_is_given_by_its_integrals() {
    let section = "*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION=I\n5., 10., 6., 6., 1., 1., 0.5\n0., 0., 1.\n";
    let deck = beam([1.0, 0.0, 0.0], "B31", section, "").replace("\n7, 60.0, 0.0, 0.0", "\n7, 60.0, 3.0, 0.0");
    let (made, model) = kept(&deck);
    assert_eq!(model.parts[0].profile.as_ref().unwrap().shape, "given");
    assert!(made.report.text().contains("an I whose elements have different directions"), "{}", made.report.text());
}

#[test]
fn sheets_that_meet_exchange_their_velocities() {
    // Two equal sheets, 3 mm between their middles, 1 mm thick: the gap of 2 mm is closed after 1 ms.
    let contacts = ["*CONTACT PAIR\nUNDER, OVER\n", "*CONTACT\n*CONTACT INCLUSIONS, ALL EXTERIOR\n", "*CONTACT PAIR\nBOTH, OVER\n"];
    for contact in contacts {
        let deck = format!(
            "{}{}*SURFACE, NAME=UNDER\nA, SNEG\n*SURFACE, NAME=OVER\nB, SPOS\n*SURFACE, NAME=BOTH\nA\n\
             *SHELL SECTION, ELSET=A, MATERIAL=STEEL\n1.\n*SHELL SECTION, ELSET=B, MATERIAL=STEEL\n1.\n{STEEL}\
             *INITIAL CONDITIONS, TYPE=VELOCITY\nN-A, 3, -2000.\n{}",
            grid("A", "S4R", [3, 2], [30.0, 20.0, 3.0], 1),
            grid("B", "S4R", [3, 2], [30.0, 20.0, 0.0], 101),
            step(contact).replace(", 1.\n", ", 2e-3\n")
        );
        let (made, model) = kept(&deck);
        let mut simulation = Simulation::new(&model, &Options::default()).unwrap_or_else(|error| panic!("{error:#?}\n{}", made.model));
        let heights = |simulation: &Simulation| {
            let frame = simulation.frame();
            let all = frame.positions::<3>();
            [all[0][2], all[12][2]].map(|z| 1e3 * z)
        };
        simulation.advance(0.95e-3, u64::MAX).unwrap();
        let before = heights(&simulation);
        assert!((before[1]).abs() < 1e-9 && before[0] > 1.0, "{before:?} {contact}");
        simulation.advance(2e-3, u64::MAX).unwrap();
        // The first stays where they met, the second has flown on for a millisecond.
        let after = heights(&simulation);
        assert!((after[0] - 1.0).abs() < 0.05 && (after[1] + 2.0).abs() < 0.06, "{after:?} {contact}\n{}", made.model);
    }
}

#[test]
fn shells_of_revolution_and_beams_in_2d_are_lines() {
    // A tube under pressure from inside: the radius grows by p r² / E t. The normal of a line along y looks
    // to -x, so that P pushes inwards; SNEG is the outer face.
    let mut deck = String::from("*NODE\n");
    for k in 0..=8 {
        let _ = writeln!(deck, "{}, 50., {:?}", k + 1, 5.0 * k as f64);
    }
    deck.push_str("*ELEMENT, TYPE=SAX1, ELSET=TUBE\n");
    for k in 1..=8 {
        let _ = writeln!(deck, "{k}, {k}, {}", k + 1);
    }
    let section = "*SURFACE, NAME=INSIDE\nTUBE, SPOS\n*SHELL SECTION, ELSET=TUBE, MATERIAL=STEEL\n1.\n";
    for (load, sign) in [("*DSLOAD\nINSIDE, P, 0.01\n", 1.0), ("*DLOAD\nTUBE, P, 0.01\n", -1.0)] {
        let (made, model) = kept(&format!("{deck}{section}{PLAIN}*BOUNDARY\n1, 2\n{}", step(load)));
        assert_eq!((model.parts[0].element.as_str(), model.is_axisymmetric()), ("shell2", true), "{}", made.model);
        // The load acts on a face, half of the thickness from the middle.
        let face = 50.0 - 0.5 * sign;
        near(at_rest(&model, [50.0, 20.0])[0], sign * 0.01 * face * 50.0 / E, 2e-3);
    }
    // A beam of 3 mm depth and 2 mm height under a force and a moment.
    let section = "*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION=RECT\n3., 2.\n";
    let (made, model) = kept(&beam([1.0, 0.0, 0.0], "B21", section, "*CLOAD\n11, 2, 0.1\n11, 6, 5.\n"));
    assert!(made.model.contains("fixed = [\"x\", \"y\", \"rotation\"]"), "{}", made.model);
    assert!(made.report.text().contains("thickness 3: embate computes per unit of depth"), "{}", made.report.text());
    let inertia = 3.0 * 8.0 / 12.0;
    let expected = cantilever(0.1, 100.0, inertia, 6.0, 0.5 * E) + 5.0 * 1e4 / (2.0 * E * inertia);
    near(at_rest(&model, [100.0, 0.0])[1], expected, 3e-3);
    let faults = made_faults(&beam([1.0, 0.0, 0.0], "B21", "*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION=CIRC\n3.\n", ""));
    assert!(faults[0].message.contains("a beam in 2D is a shell in plane stress"), "{}", faults[0]);
}

fn made_faults(deck: &str) -> Vec<Fault> {
    made(deck).err().unwrap_or_default()
}

#[test]
fn solids_shells_and_beams_are_parts_of_one_model() {
    // A block on a sheet, tied to it, with a beam along one edge of the sheet.
    let block = "*NODE\n901, 0, 0, 0.5\n902, 30, 0, 0.5\n903, 30, 20, 0.5\n904, 0, 20, 0.5\n905, 0, 0, 9\n906, 30, 0, 9\n907, 30, 20, 9\n908, 0, 20, 9\n\
                 *ELEMENT, TYPE=C3D8R, ELSET=BLOCK\n901, 901, 902, 903, 904, 905, 906, 907, 908\n\
                 *ELEMENT, TYPE=B31, ELSET=RIB\n801, 1, 4\n802, 4, 7\n803, 7, 10\n*ELSET, ELSET=ALL\nSHEET, BLOCK, RIB\n\
                 *SURFACE, NAME=FOOT\nBLOCK, S1\n*SURFACE, NAME=TOP\nSHEET, SPOS\n*SURFACE, NAME=RIM\nSHEET, E1\n";
    let sections = "*SOLID SECTION, ELSET=BLOCK, MATERIAL=STEEL\n*SHELL SECTION, ELSET=SHEET, MATERIAL=STEEL\n1.\n\
                    *BEAM SECTION, ELSET=RIB, MATERIAL=STEEL, SECTION=CIRC\n1.\n";
    let deck = format!("{}{block}{sections}{STEEL}", grid("SHEET", "S4R", [3, 2], [30.0, 20.0, 0.0], 1));
    let (made, model) = kept(&format!("{deck}{}", step("*TIE, NAME=T\nFOOT, TOP\n*DLOAD\n, GRAV, 9810., 0, 0, -1\n")));
    let elements: Vec<&str> = ["BLOCK", "SHEET", "RIB"]
        .iter()
        .map(|name| model.parts.iter().find(|part| part.name == *name).map_or("none", |part| part.element.as_str()))
        .collect();
    assert_eq!(elements, ["hex8_reduced", "shell4", "beam2"], "{}", made.model);
    assert!(made.model.contains("bulk_viscosity") && made.model.contains("tied = true"), "{}", made.model);
    let mut simulation = Simulation::new(&model, &Options::default()).unwrap_or_else(|error| panic!("{error:#?}\n{}", made.model));
    // Everything falls together.
    simulation.advance(1e-3, u64::MAX).unwrap();
    let frame = simulation.frame();
    let start = Simulation::new(&model, &Options::default()).unwrap().frame().positions::<3>().to_vec();
    for (x, before) in frame.positions::<3>().iter().zip(&start) {
        let fallen = before[2] - x[2];
        assert!((fallen / (0.5 * 9.81e-6) - 1.0).abs() < 1e-2, "{fallen:e}");
    }
    // Edges of shells are no surface.
    let (made, _) = imported(&format!("{deck}{}", step("*TIE, NAME=T\nRIM, FOOT\n")));
    assert!(made.report.text().contains("surface RIM has no edges or faces of elements"), "{}", made.report.text());
}

#[test]
fn what_shells_and_beams_can_not_keep_is_reported_or_refused() {
    let sheet = grid("SHEET", "S4R", [2, 2], [20.0, 20.0, 0.0], 1);
    let with = |section: &str, more: &str| format!("{sheet}{section}{STEEL}{}", step(more));
    let section = "*SHELL SECTION, ELSET=SHEET, MATERIAL=STEEL\n1.\n";
    for (section, more, text) in [
        ("*SHELL SECTION, ELSET=SHEET, MATERIAL=STEEL, OFFSET=SPOS\n1.\n", "", "OFFSET=SPOS: nodes are in the middle"),
        (section, "*BOUNDARY, AMPLITUDE=A\nX0-SHEET, 5, 5, 0.1\n", "of rotations only velocities are prescribed"),
        (section, "*INITIAL CONDITIONS, TYPE=VELOCITY\nX0-SHEET, 6, 3.\n", "an angular velocity"),
        (section, "*DLOAD\nSHEET, E1, 3.\n", "a pressure on edges of shells does not act"),
        (section, "*SURFACE, NAME=RIM\nSHEET, E1\n*DSLOAD\nRIM, P, 3.\n", "only a pressure (P) on edges or faces of elements is read"),
        (section, "*NODAL THICKNESS\nX0-SHEET, 2.\n", "no section of shells takes the thickness of the nodes"),
    ] {
        let (made, _) = imported(&with(section, more));
        assert!(made.report.has_ignored() && made.report.text().contains(text), "{more}: {}", made.report.text());
    }
    let (made, _) = imported(&with("*SHELL SECTION, ELSET=SHEET, MATERIAL=STEEL\n1., 15\n", ""));
    assert!(
        made.report.text().contains("those of Gauss, 10 instead of 15") && made.model.contains("points = 10"),
        "{}",
        made.report.text()
    );
    // A membrane, and bulk viscosity, which would not act.
    let membrane = grid("SHEET", "M3D4R", [2, 2], [20.0, 20.0, 1.0], 1);
    let (made, _) =
        kept(&format!("{membrane}*MEMBRANE SECTION, ELSET=SHEET, MATERIAL=STEEL\n1.\n{STEEL}{}", step("*BULK VISCOSITY\n0.06, 1.2\n")));
    assert!(made.model.contains("points = 1 }") && !made.model.contains("bulk_viscosity"), "{}", made.model);
    assert!(made.report.text().contains("it does not act on shells and beams"), "{}", made.report.text());
    for (section, message) in [
        ("*SOLID SECTION, ELSET=SHEET, MATERIAL=STEEL\n", "set \"SHEET\" has elements S4R, which have no *SOLID SECTION"),
        ("*SHELL SECTION, ELSET=SHEET, MATERIAL=STEEL\n", "*SHELL SECTION lacks the thickness"),
        ("*SHELL SECTION, ELSET=SHEET, MATERIAL=STEEL\n-1.\n", "the thickness is -1"),
        ("*SHELL SECTION, ELSET=SHEET, MATERIAL=STEEL\n1., 2.5\n", "2.5 points through the thickness"),
        ("*SHELL SECTION, ELSET=SHEET, COMPOSITE\n1., 3, STEEL\n", "with layers or a stiffness of its own"),
    ] {
        let faults = made_faults(&with(section, ""));
        assert!(
            faults.first().is_some_and(|fault| fault.message.contains(message) && fault.path.contains("line")),
            "{message}: {faults:#?}"
        );
    }
    for (section, message) in [
        ("*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION=L\n1., 1., 0.1, 0.1\n", "a section L has no counterpart"),
        ("*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL\n1.\n", "a section  is missing"),
        ("*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION=BOX\n4., 8., 1., 0.5, 0.5, 0.5\n", "walls of different thickness"),
        ("*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION=I\n0., 10., 6., 6., 1., 1., 0.5\n", "whose line is not in its middle"),
        ("*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION=CIRC\n0.\n", "the radius is 0"),
        ("*BEAM GENERAL SECTION, ELSET=BEAM, DENSITY=1e-9\n10., 30., 5., 7., 12.\n", "a section GENERAL with I12"),
        ("*BEAM GENERAL SECTION, ELSET=BEAM\n10., 30., 0., 7., 12.\n", "*BEAM GENERAL SECTION lacks DENSITY"),
        ("*BEAM GENERAL SECTION, ELSET=BEAM, DENSITY=1e-9\n10., 30., 0., 7., 12.\n\n", "*BEAM GENERAL SECTION lacks E and G"),
    ] {
        let faults = made_faults(&beam([1.0, 0.0, 0.0], "B31", section, ""));
        assert!(faults.first().is_some_and(|fault| fault.message.contains(message)), "{message}: {faults:#?}");
    }
    let faults = made_faults(&beam([1.0, 0.0, 0.0], "B31", "", "").replace("\n10, 10, 11", "\n10, 10, 11, 1"));
    assert!(faults[0].help.contains("leave a third node out"), "{}", faults[0]);
    let (made, _) = imported(&beam(
        [1.0, 0.0, 0.0],
        "B31",
        "*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION=CIRC\n3.\n",
        "*DLOAD\nBEAM, PZ, 1.\nBEAM, P1, 1.\n",
    ));
    let report = made.report.text();
    assert!(report.contains("a load PZ has no counterpart") && report.contains("a load along beams does not act"), "{report}");
}

#[test]
fn every_side_of_a_shell_has_its_name() {
    let sheet = grid("SHEET", "S4R", [1, 1], [2.0, 3.0, 1.0], 1);
    for (face, message) in
        [("S7", "its faces are SPOS and SNEG, its edges E1 to E4"), ("E5", "E1 to E4"), ("P1", "E1 to E4"), ("E0", "E1 to E4")]
    {
        let deck = format!("{sheet}*SURFACE, NAME=S\nSHEET, {face}\n*SHELL SECTION, ELSET=SHEET, MATERIAL=STEEL\n1.\n{STEEL}{}", step(""));
        let faults = made_faults(&deck);
        assert!(faults[0].message.contains("an element S4R has no side") && faults[0].help.contains(message), "{}", faults[0]);
    }
    // CalculiX numbers them: S1 is SNEG, S2 SPOS, S3 the first edge.
    let same = |a: &str, b: &str| {
        let groups = [a, b].map(|face| {
            let deck =
                format!("{sheet}*SURFACE, NAME=S\nSHEET, {face}\n*SHELL SECTION, ELSET=SHEET, MATERIAL=STEEL\n1.\n{STEEL}{}", step(""));
            let model = kept(&deck).1;
            model.meshes[0].groups.iter().find(|group| group.name == "S").unwrap().clone()
        });
        assert_eq!(groups[0], groups[1], "{a} {b}");
        groups[0].cells[0].clone()
    };
    // Nodes 1 and 2 are at x = 0.
    assert_eq!(
        [same("S1", "SNEG"), same("S2", "SPOS"), same("S3", "E1"), same("S6", "E4")],
        [vec![1, 3, 2, 0], vec![0, 2, 3, 1], vec![0, 2], vec![1, 0]]
    );
}

#[test]
fn a_thickness_at_nodes_is_that_of_the_shells_there() {
    // mm: 2 at one end, 4 at the other, by node and by set.
    let nodal = "*NODAL THICKNESS\nX0-S, 2.0\nX1-S, 4.0\n";
    let section = "*SHELL SECTION, ELSET=S, MATERIAL=STEEL, NODAL THICKNESS\n99.0, 3\n";
    let deck = |section: &str, nodal: &str| grid("S", "S4R", [1, 2], [10.0, 6.0, 0.0], 1) + nodal + section + STEEL + &step("");
    let (made, model) = imported(&deck(section, nodal));
    assert!(made.model.contains("section = { thickness_field = \"nodal_thickness\", points = 3 }"), "{}", made.model);
    assert!(made.report.text().contains("NODAL THICKNESS"), "{}", made.report.text());
    let mass = Simulation::new(&model, &Options { threads: 1, simd: None }).unwrap().overview().parts[0].mass;
    assert!((mass / (7850.0 * 10e-3 * 6e-3 * 3e-3) - 1.0).abs() < 1e-12, "{mass}");
    let lacking = made_faults(&deck(section, ""));
    assert!(lacking.len() == 1 && lacking[0].message.contains("no *NODAL THICKNESS"), "{lacking:?}");
    let unknown = made_faults(&deck(section, "*NODAL THICKNESS\nX7-S, 2.0\n"));
    assert!(unknown.len() == 1 && unknown[0].message.contains("no node set \"X7-S\""), "{unknown:?}");
}

#[test]
fn parts_of_an_imported_deck_are_placed_with_their_thicknesses() {
    // 2 mm thick at x = 0 and 4 mm at 10 mm; mirrored on x = 10 mm and there twice, 100 mm apart along y. The
    // thick end stays at 10 mm, the thin one is at 20 mm.
    let section = "*NODAL THICKNESS\nX0-S, 2.0\nX1-S, 4.0\n*SHELL SECTION, ELSET=S, MATERIAL=STEEL, NODAL THICKNESS\n99.0, 3\n";
    let deck = grid("S", "S4R", [1, 2], [10.0, 6.0, 0.0], 1) + section + STEEL + &step("");
    let (made, plain) = imported(&deck);
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("mesh.inp"), &made.mesh).unwrap();
    let set = [
        "part[0].mirror={ normal = [1, 0, 0], point = [\"10 mm\", 0, 0] }",
        "part[0].copies={ count = 2, translation = [0, \"100 mm\", 0] }",
    ];
    let text = format!("{}\n[[probe]]\nname = \"thin\"\nset = \"{}.X0-S\"\n", made.model, plain.parts[0].name);
    let model = load_text("m", &text, folder.path(), &set.map(String::from)).unwrap_or_else(|diagnostics| panic!("{diagnostics}"));
    let simulation = Simulation::new(&model, &Options { threads: 1, simd: None }).unwrap_or_else(|error| panic!("{error}"));
    let mass = simulation.overview().parts[0].mass;
    assert!((mass / (2.0 * 7850.0 * 10e-3 * 6e-3 * 3e-3) - 1.0).abs() < 1e-12, "{mass}");
    let value = |column: &str| simulation.history_row()[simulation.history_columns().iter().position(|it| it == column).unwrap()];
    assert!((value("thin.x") - 20e-3).abs() < 1e-15 && (value("thin.y") - 53e-3).abs() < 1e-15, "{} {}", value("thin.x"), value("thin.y"));
    // The faces are half of the thickness from the middle: 1 mm at the thin end, 2 mm at the other, all
    // around.
    let places = simulation.coordinates();
    for x in places.as_chunks::<3>().0.iter().filter(|x| x[2].abs() > 1e-9) {
        let wanted = if x[0] > 15e-3 { 1e-3 } else { 2e-3 };
        assert!((x[2].abs() - wanted).abs() < 1e-4, "{x:?}");
    }
}
