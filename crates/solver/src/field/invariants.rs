//! Invariants and principal values of the mean stress; only where someone asks.

use super::{Cell, Components, Description, of_cells};
use crate::field::kind::Needs;
use crate::tensor::{self, Solid, SymmetricTensor};

/// Principal stresses, the largest first, with their projections.
fn principal(cell: &Cell<'_>) -> [(f64, Solid<f64>); 3] {
    let (values, projections) = Solid(cell.state.stress).principal();
    let mut pairs = [0, 1, 2].map(|k| (values[k], projections[k]));
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
    pairs
}

/// The unit vector n of n nᵀ, with its largest component positive.
fn direction(Solid([xx, yy, zz, xy, yz, zx]): Solid<f64>) -> [f64; 3] {
    let columns = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
    let largest = (0..3).fold(0, |best, d| if columns[d][d] > columns[best][best] { d } else { best });
    let size = columns[largest][largest].sqrt();
    if size > 0.0 { columns[largest].map(|component| component / size) } else { [0.0; 3] }
}

/// σ_m/σ_e; 0 without stress.
fn triaxiality(cell: &Cell<'_>) -> f64 {
    let stress = &cell.state.stress;
    let equivalent = tensor::von_mises(stress);
    if equivalent > 0.0 { (stress[0] + stress[1] + stress[2]) / (3.0 * equivalent) } else { 0.0 }
}

/// θ = ⅓ arccos(27 J₃/(2 σ_e³)) by the principal stresses: tan θ = √3 (σ₂ − σ₃)/(2σ₁ − σ₂ − σ₃).
fn lode_angle(cell: &Cell<'_>) -> f64 {
    let [a, b, c] = principal(cell).map(|(value, _)| value);
    (3f64.sqrt() * (b - c)).atan2(2.0 * a - b - c)
}

pub(super) fn fields() -> Vec<Description> {
    let field = |name, components, unit, doc, source| Description::new(name, components, unit, doc, source).needs(Needs::Asking);
    vec![
        field(
            "principal_stress",
            Components::Profile,
            "Pa",
            "principal values of the mean stress, the largest first",
            of_cells(|cell, values| values.iter_mut().zip(principal(cell)).for_each(|(own, (value, _))| *own = value)),
        ),
        field(
            "principal_direction",
            Components::Direction,
            "",
            "unit vector along the largest principal stress x y z, its largest component positive",
            of_cells(|cell, values| values.copy_from_slice(&direction(principal(cell)[0].1))),
        ),
        field(
            "triaxiality",
            Components::Scalar,
            "",
            "mean over equivalent stress: 1/3 in tension, -1/3 in compression, 0 in shear",
            of_cells(|cell, values| values[0] = triaxiality(cell)),
        ),
        field(
            "lode_angle",
            Components::Scalar,
            "rad",
            "Lode angle ⅓ arccos(27 J₃/(2 σ_e³)): 0 in tension, 30 deg in shear, 60 deg in compression",
            of_cells(|cell, values| values[0] = lode_angle(cell)),
        ),
    ]
}
