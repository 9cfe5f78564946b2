//! Examples far from the origin: moved by a million times their size they do what they do at home, as far as
//! the digits of their coordinates allow.
//!
//! How far that is: at S = 10⁶ L places are kept to u = 2⁻⁵³ S, and each step rounds each coordinate once
//! more, independently of the others: after n steps they are off by about √n u. Strains, and with them forces
//! and energies, come from the way v dt that bodies of the speed v go in a step, and what contact presses
//! from the depth δ of its springs. So energies may be off by the fraction √n u / (v dt) and what contact
//! reports by √n u / δ besides, times a factor of four for what rounds in the sums of an element. An area
//! from products of coordinates would be off by u S / h², a million times u / h.

use embate_files::model_file;
use embate_solver::model::{Load, Model, ObstacleShape, ProbeAt};
use embate_solver::simulation::{Options, Simulation};
use std::path::Path;

type Vector = [f64; 3];

/// Moves a point.
fn moved(x: &mut Vector, by: Vector) {
    x.iter_mut().zip(by).for_each(|(x, by)| *x += by);
}

/// The model somewhere else.
fn shifted(model: &Model, by: Vector) -> Model {
    let mut model = model.clone();
    for part in &mut model.parts {
        moved(&mut part.placement.translation, by);
        if let Some(copies) = &mut part.placement.copies {
            moved(&mut copies.point, by);
        }
    }
    model.symmetries.iter_mut().for_each(|symmetry| moved(&mut symmetry.point, by));
    for obstacle in &mut model.obstacles {
        match &mut obstacle.shape {
            ObstacleShape::Plane { point, .. } | ObstacleShape::Cylinder { point, .. } => moved(point, by),
            ObstacleShape::Circle { centre, .. } | ObstacleShape::Sphere { centre, .. } => moved(centre, by),
            _ => panic!("not among the examples here"),
        }
        if let Some(reference) = &mut obstacle.reference {
            moved(reference, by);
        }
    }
    for probe in &mut model.probes {
        if let ProbeAt::Point { point, .. } = &mut probe.at {
            moved(point, by);
        }
    }
    assert!(
        model.constraints.is_empty() && model.loads.iter().all(|load| matches!(load, Load::Gravity { .. })),
        "not among the examples here"
    );
    model
}

/// A row for each step.
struct Course {
    columns: Vec<String>,
    rows: Vec<Vec<f64>>,
    positions: Vec<f64>,
    dimension: usize,
}

fn course(model: &Model, steps: u64) -> Course {
    let mut simulation = Simulation::new(model, &Options { threads: 1, ..Options::default() }).unwrap_or_else(|error| panic!("{error}"));
    let (columns, positions) = (simulation.history_columns(), simulation.coordinates());
    let mut rows = vec![simulation.history_row()];
    for _ in 0..steps {
        simulation.advance(f64::INFINITY, 1).unwrap_or_else(|error| panic!("{error}"));
        rows.push(simulation.history_row());
    }
    Course { columns, rows, positions, dimension: simulation.dimension() }
}

impl Course {
    /// Largest size of a column.
    fn largest(&self, column: usize) -> f64 {
        self.rows.iter().map(|row| row[column].abs()).filter(|value| value.is_finite()).fold(0.0, f64::max)
    }

    /// What a column of contact is measured against: the largest of its kind in all contacts, of all
    /// components of forces. Surfaces that just touch at home press or not by rounding elsewhere.
    fn scale(&self, column: usize) -> f64 {
        let kind = |name: &str| {
            let kind = name.split_once('.').map_or(name, |(_, kind)| kind.split(['[', '_']).next().unwrap_or(kind));
            // Where nothing slides, friction is compared with what the springs store.
            if ["contact", "friction"].contains(&kind) { "energy".to_string() } else { kind.to_string() }
        };
        let own = kind(&self.columns[column]);
        let same = |(k, name): (usize, &String)| (is_of_contact(name) && kind(name) == own).then(|| self.largest(k));
        self.columns.iter().enumerate().filter_map(same).fold(0.0, f64::max)
    }

    /// The same of all columns whose names begin so.
    fn largest_of(&self, names: &[&str]) -> f64 {
        let of = |(k, column): (usize, &String)| names.iter().any(|name| column.starts_with(name)).then(|| self.largest(k));
        self.columns.iter().enumerate().filter_map(of).fold(0.0, f64::max)
    }
}

/// Largest size of a model, m.
fn size(positions: &[f64], dimension: usize) -> f64 {
    let extent = |d: usize| {
        let along = || positions.iter().skip(d).step_by(dimension).copied();
        along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
    };
    (0..dimension).map(extent).fold(0.0, f64::max)
}

/// Whether a column of the history reports of contact.
fn is_of_contact(column: &str) -> bool {
    let names = ["force_", "energy[", "penetration[", "friction_work["];
    let of = |kind: &str| column.strip_prefix(kind).is_some_and(|rest| names.iter().any(|name| rest.starts_with(name)));
    of("contact.") || of("obstacle.") || column == "energy.contact" || column == "energy.friction"
}

/// Runs some steps of an example with bodies of a speed (m/s) at home and far away, and says what is off by
/// more than may be.
fn compare(name: &str, speed: f64, steps: u64) -> Vec<String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples").join(name).join("model.toml");
    let model = model_file::load(&path, &[]).unwrap_or_else(|faults| panic!("{name}: {faults}"));
    let home = course(&model, steps);
    let length = size(&home.positions, home.dimension);
    let by = 1e6 * length;
    let whole = [if model.is_axisymmetric() { 0.0 } else { by }, -0.7 * by, if home.dimension == 3 { 0.4 * by } else { 0.0 }];
    let far = course(&shifted(&model, whole), steps);
    assert_eq!((&home.columns, home.rows.len()), (&far.columns, far.rows.len()), "{name}");
    let walk = 4.0 * (steps as f64).sqrt() * by * 2f64.powi(-53);
    let step = home.rows.iter().map(|row| row[1]).filter(|step| *step > 0.0).fold(f64::INFINITY, f64::min);
    let depth = home.largest_of(&["contact.penetration", "obstacle.penetration"]);
    assert!(depth > 0.0 && home.largest_of(&["energy.contact"]) > 0.0, "{name}: there is no contact");
    let (energies, contacts) = (walk / (speed * step), walk / (speed * step) + walk / depth);
    let mut wrong = Vec::new();
    let mut most = [0.0f64; 2];
    for (k, column) in home.columns.iter().enumerate() {
        let is_contact = is_of_contact(column);
        // Forces between bodies lean to a side where a node lies over the edge of two facets: which of them
        // it meets is up to rounding there.
        if column.contains(':') {
            continue;
        }
        if !is_contact && !column.starts_with("energy.") {
            continue;
        }
        let (scale, bound) =
            if is_contact { (home.scale(k), contacts) } else { (home.largest_of(&["energy.total", "energy.kinetic"]), energies) };
        let off = home.rows.iter().zip(&far.rows).map(|(a, b)| if a[k].is_nan() { 0.0 } else { (a[k] - b[k]).abs() }).fold(0.0, f64::max);
        let off = if scale > 0.0 { off / scale } else { off };
        most[usize::from(is_contact)] = most[usize::from(is_contact)].max(off / bound);
        if !(off <= bound) {
            wrong.push(format!("{name}: {column} is off by {off:.2e} of {scale:.3e}, more than {bound:.2e}"));
        }
    }
    println!(
        "{name}: energies off by {:.2e} of {energies:.2e}, contact by {:.2e} of {contacts:.2e}",
        most[0] * energies,
        most[1] * contacts
    );
    wrong
}

#[test]
fn ten_examples_do_the_same_a_million_sizes_away() {
    let examples = [
        ("two-bars", 4.0, 150),
        ("thin-plates", 200.0, 150),
        ("taylor-bar", 227.0, 150),
        ("crushed-ring", 4.0, 150),
        ("buckling-column", 2.0, 300),
        ("bullet", 450.0, 150),
        ("tube-plate", 50.0, 150),
        ("ball-through-plate", 300.0, 40),
        ("crossing-tubes", 40.0, 60),
        ("tube-plate-3d", 50.0, 60),
    ];
    let wrong: Vec<String> = examples.into_iter().flat_map(|(name, speed, steps)| compare(name, speed, steps)).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
