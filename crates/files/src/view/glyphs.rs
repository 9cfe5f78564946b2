//! Glyphs of a frame: a vector of each node that is seen, or the principal values and directions of a tensor
//! of each facet that is seen; of sections one of each polygon.

use super::bodies::Topology;
use super::container::Container;
use super::section::Section;
use super::values::taken;
use embate_solver::output::{FieldKind, Location, Shown};
use embate_solver::tensor::{Solid, SymmetricTensor};

/// What glyphs a field can have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Glyphs {
    Vectors,
    Tensors,
}

/// None of scalars, and of vectors of cells.
fn glyphs_of(kind: &FieldKind) -> Option<Glyphs> {
    match (kind.location, kind.components) {
        (Location::Node, ["x", "y", ..]) => Some(Glyphs::Vectors),
        (Location::Cell, ["xx", "yy", "zz", "xy", ..]) => Some(Glyphs::Tensors),
        _ => None,
    }
}

/// Adds the glyphs of a field; a field that has none, or is not shown, adds nothing.
pub(super) fn add(container: &mut Container, topology: &Topology, shown: &dyn Shown, name: &str) {
    let kinds = shown.kinds();
    let Some(field) = kinds.iter().position(|kind| kind.name == name) else { return };
    let width = kinds[field].width();
    let take = |range, room: &mut Vec<f64>| shown.values(field, range, room);
    match glyphs_of(kinds[field]) {
        Some(Glyphs::Vectors) => {
            let vectors = taken(topology.nodes.iter().copied(), width, take);
            let three = |own: &[f64]| -> [f32; 3] { std::array::from_fn(|d| own.get(d).map_or(0.0, |x| *x as f32)) };
            container.floats("glyph_vectors", vectors.chunks_exact(width).flat_map(three).collect());
        }
        Some(Glyphs::Tensors) => {
            let tensors = taken(topology.facets.iter().map(|facet| facet.cell), width, take);
            let (values, axes): (Vec<_>, Vec<_>) = tensors.chunks_exact(width).map(principal).unzip();
            container.floats("glyph_values", values.into_flattened());
            container.floats("glyph_axes", axes.into_flattened().into_flattened());
        }
        None => {}
    }
}

/// Adds those of the polygons of sections, one section after the other: a vector in the middle of each, or
/// the tensor of its cell.
pub(super) fn add_to_sections(container: &mut Container, sections: &[Section], shown: &dyn Shown, name: &str) {
    let kinds = shown.kinds();
    let Some(field) = kinds.iter().position(|kind| kind.name == name) else { return };
    let Some(glyphs) = glyphs_of(kinds[field]) else { return };
    let width = kinds[field].width();
    let mut all = Vec::new();
    shown.values(field, 0..shown.numbers(field) / width, &mut all);
    let tuple = |place: u32| all.get(width * place as usize..width * (place as usize + 1));
    let polygons = sections.iter().flat_map(|section| &section.polygons);
    match glyphs {
        Glyphs::Vectors => {
            let component = |section: &Section, k: usize| {
                let at = |node: u32| tuple(node).map_or(f64::NAN, |own| own.get(k).copied().unwrap_or(0.0));
                let points = section.points.iter().map(|point| point.between(point.nodes.map(at)));
                section.with_middles(points.collect()).split_off(section.points.len())
            };
            let three = |section: &Section| {
                let [x, y, z] = [0, 1, 2].map(|k| component(section, k));
                x.into_iter().zip(y).zip(z).flat_map(|((x, y), z)| [x as f32, y as f32, z as f32]).collect::<Vec<f32>>()
            };
            container.floats("section_glyph_vectors", sections.iter().flat_map(three).collect());
        }
        Glyphs::Tensors => {
            let own = polygons.map(|polygon| principal(tuple(polygon.cell).unwrap_or(&[f64::NAN])));
            let (values, axes): (Vec<_>, Vec<_>) = own.unzip();
            container.floats("section_glyph_values", values.into_flattened());
            container.floats("section_glyph_axes", axes.into_flattened().into_flattened());
        }
    }
}

/// Principal values of a tensor xx yy zz xy (yz zx), the largest first, and unit vectors along their axes;
/// not a number where a component is not.
fn principal(tensor: &[f64]) -> ([f32; 3], [[f32; 3]; 3]) {
    let tensor: [f64; 6] = std::array::from_fn(|k| tensor.get(k).copied().unwrap_or(0.0));
    if tensor.iter().any(|component| !component.is_finite()) {
        return ([f32::NAN; 3], [[f32::NAN; 3]; 3]);
    }
    let (values, projections) = Solid(tensor).principal();
    let mut order = [0, 1, 2];
    order.sort_by(|&a, &b| values[b].total_cmp(&values[a]));
    (order.map(|k| values[k] as f32), order.map(|k| axis(projections[k])))
}

/// The unit vector n of n nᵀ.
fn axis(Solid([xx, yy, zz, xy, yz, zx]): Solid<f64>) -> [f32; 3] {
    let columns = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
    let largest = (0..3).fold(0, |best, d| if columns[d][d] > columns[best][best] { d } else { best });
    let size = columns[largest][largest].sqrt();
    columns[largest].map(|component| if size > 0.0 { (component / size) as f32 } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn principal_values_and_axes_put_the_tensor_together_again() {
        for tensor in [[3.0, -1.0, 2.0, 0.5, -0.25, 1.5], [1e9, 1e9, -2e9, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 4.0, 0.0, 0.0], [0.0; 6]] {
            let (values, axes) = principal(&tensor);
            assert!(values[0] >= values[1] && values[1] >= values[2]);
            for (place, (i, j)) in [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)].into_iter().enumerate() {
                let sum: f64 = (0..3).map(|k| f64::from(values[k]) * f64::from(axes[k][i]) * f64::from(axes[k][j])).sum();
                let size = tensor.iter().fold(0.0f64, |a, b| a.max(b.abs()));
                assert!((sum - tensor[place]).abs() <= 1e-6 * size, "{tensor:?}: {sum} at {i}{j}");
            }
        }
        let (values, axes) = principal(&[2.0, 4.0, 0.0, 1.0]);
        assert!((values[0] - (3.0 + 2f32.sqrt())).abs() < 1e-6 && axes[0][2] == 0.0, "of 2D too");
        assert!(principal(&[f64::NAN, 0.0, 0.0, 0.0]).0[0].is_nan());
    }
}
