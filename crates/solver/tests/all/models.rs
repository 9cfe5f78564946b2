//! Models and parts in a line, for the tests.

use embate_solver::model::{Material, Model, Part, Run, Shape};

/// An empty model that runs until `end`, s.
pub fn model(end: f64) -> Model {
    Model { name: "test".into(), run: Run { end, ..Run::default() }, ..Model::default() }
}

/// The law `elastic`.
pub fn elastic(young: f64, poisson: f64, density: f64) -> Material {
    let parameters = [("young", young), ("poisson", poisson), ("density", density)];
    Material { law: "elastic".into(), parameters: parameters.iter().map(|(name, value)| ((*name).to_string(), *value)).collect() }
}

/// A rectangle of `quad4`.
pub fn rectangle(name: &str, material: &str, corner: [f64; 2], size: [f64; 2], elements: [usize; 2], velocity: [f64; 2]) -> Part {
    Part {
        name: name.into(),
        material: material.into(),
        element: "quad4".into(),
        shape: Shape::Rectangle { corner, size, elements },
        velocity,
    }
}
