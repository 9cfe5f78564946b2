//! Lengths that look like those of another unit: of the whole model, of the mesh file of a part beside the
//! others, and of a probe far from its part.

use super::Builds;
use crate::error::{FAR_PROBE, Warning};
use crate::mesh::cell::Cell;
use crate::mesh::messages::SIZES;
use crate::mesh::{Mesh, extent};
use crate::model::{Model, ProbeAt, ProbeKind, Shape};
use crate::tensor::Dim;
use crate::vector::{first, length, minus, place};

/// Models beyond these are of a unit that is not meant, m: from viruses to mountains.
const MODELS: [f64; 2] = [1e-6, 1e4];
/// A mesh file whose elements are so many times larger, or smaller, than all others, and its bodies by the
/// second number at least, was written in another unit: mm beside m, or inches beside mm.
const APART: [f64; 2] = [300.0, 30.0];
/// Shells whose elements are so many times as long as they are thick are thinner than any foil.
const THIN: f64 = 2000.0;
/// Of a part so many elements are measured.
const MEASURED: usize = 1000;

/// What a part measures.
#[derive(Clone, Copy, Debug)]
struct Size {
    /// Longest side of the box around it, m.
    body: f64,
    /// Mean of the longest edges of its elements, m.
    element: f64,
}

/// A warning for the model as a whole, or for each part, and for each probe.
pub(super) fn warnings<const D: usize>(model: &Model, mesh: &Mesh<D>) -> Vec<Warning>
where
    Dim<D>: Builds<D>,
{
    let mut warnings = whole(model, mesh).map_or_else(|| beside_others(model, mesh), |warning| vec![warning]);
    warnings.extend(shells(model, mesh));
    warnings.extend(probes(model, mesh));
    warnings
}

/// Shells that are thinner than any foil beside their elements, or thicker than their part is long.
fn shells<const D: usize>(model: &Model, mesh: &Mesh<D>) -> Vec<Warning>
where
    Dim<D>: Builds<D>,
{
    let mut warnings = Vec::new();
    for (index, part) in model.parts.iter().enumerate() {
        let Some(section) = part.section.as_ref().filter(|section| section.thickness > 0.0 && section.thickness_field.is_empty()) else {
            continue;
        };
        let (Size { body, element }, thickness) = (size(mesh, index), section.thickness);
        let message = if element > THIN * thickness {
            format!("the shell is {thickness:.3e} m thick, and its elements are {:.0} times as long", element / thickness)
        } else if thickness > body {
            format!("the shell is {thickness:.3e} m thick, more than the part is long, {body:.3e} m")
        } else {
            continue;
        };
        warnings.push(Warning {
            kind: &SIZES,
            path: format!("part[{index}].section.thickness"),
            message,
            consequence: "its mass and stiffness are those of something else".into(),
            help: "write the thickness with its unit, such as `\"1 mm\"`: a number without one is in m".into(),
        });
    }
    warnings
}

fn whole<const D: usize>(model: &Model, mesh: &Mesh<D>) -> Option<Warning>
where
    Dim<D>: Builds<D>,
{
    let (size, [low, high]) = (extent(&mesh.positions), MODELS);
    if (low..=high).contains(&size) || size == 0.0 {
        return None;
    }
    let index = model.parts.iter().position(|part| matches!(part.shape, Shape::Group { .. })).unwrap_or(0);
    Some(Warning {
        kind: &SIZES,
        path: format!("part[{index}].{}", model.parts.get(index)?.shape.size_path()),
        message: format!("the model is {size:.3e} m {}", if size > high { "large" } else { "small" }),
        consequence: "loads, speeds and times that are right for the real thing do not fit it".into(),
        help: unit_of(model, index).into(),
    })
}

/// What to do about a length that is in another unit.
fn unit_of(model: &Model, part: usize) -> &'static str {
    match model.parts.get(part).map(|part| &part.shape) {
        Some(Shape::Group { .. }) => "give `scale` in `mesh` the unit of the file's lengths, such as `scale = \"1 mm\"`",
        _ => "write lengths with their unit, such as `\"10 mm\"`: a number without one is in m",
    }
}

/// Parts of a mesh file that are far larger, or smaller, than all parts that are not of it.
fn beside_others<const D: usize>(model: &Model, mesh: &Mesh<D>) -> Vec<Warning>
where
    Dim<D>: Builds<D>,
{
    let file = |index: usize| match model.parts[index].shape {
        Shape::Group { mesh, .. } => Some(mesh),
        _ => None,
    };
    let sizes: Vec<Size> = (0..mesh.parts.len()).map(|part| size(mesh, part)).collect();
    let mut warnings = Vec::new();
    for source in 0..model.meshes.len() {
        let (own, others): (Vec<usize>, Vec<usize>) = (0..sizes.len()).partition(|&part| file(part) == Some(source));
        if own.is_empty() || others.is_empty() {
            continue;
        }
        let range = |parts: &[usize], of: fn(&Size) -> f64| {
            let all = parts.iter().map(|&part| of(&sizes[part]));
            all.fold([f64::INFINITY, 0.0f64], |[low, high], it| [low.min(it), high.max(it)])
        };
        let both = [(|size| size.body) as fn(&Size) -> f64, |size| size.element].map(|of| [range(&own, of), range(&others, of)]);
        let [apart, least] = APART;
        let all = |is: &dyn Fn(f64, [[f64; 2]; 2]) -> bool| is(least, both[0]) && is(apart, both[1]);
        let is_larger = all(&|times, [own, others]| own[0] > times * others[1]);
        let is_smaller = all(&|times, [own, others]| times * own[1] < others[0]);
        if !(is_larger || is_smaller) {
            continue;
        }
        let [own_body, other_body] = both[0];
        let [here, there] = if is_larger { [own_body[0], other_body[1]] } else { [own_body[1], other_body[0]] };
        let (most, than) = if is_larger { ("at most", "larger") } else { ("at least", "smaller") };
        let times = if is_larger { here / there } else { there / here };
        warnings.push(Warning {
            kind: &SIZES,
            path: format!("part[{}].{}", own[0], model.parts[own[0]].shape.size_path()),
            message: format!(
                "the part is {here:.3e} m long, {times:.0} times {than} than all that is not of {}, {most} {there:.3e} m; its elements too",
                model.meshes[source].source
            ),
            consequence: "one of the two is in another unit than it was meant in".into(),
            help: unit_of(model, own[0]).into(),
        });
    }
    warnings
}

fn size<const D: usize>(mesh: &Mesh<D>, part: usize) -> Size
where
    Dim<D>: Builds<D>,
{
    let nodes: Vec<[f64; D]> = mesh.parts[part].nodes.iter().map(|&node| mesh.positions[node as usize]).collect();
    let edges: Vec<f64> = mesh.groups_of(part).flat_map(|group| group.cells()).take(MEASURED).map(|cell| longest(mesh, cell)).collect();
    Size { body: extent(&nodes), element: edges.iter().sum::<f64>() / edges.len().max(1) as f64 }
}

/// Longest edge of an element, m.
fn longest<const D: usize>(mesh: &Mesh<D>, cell: Cell<'_>) -> f64
where
    Dim<D>: Builds<D>,
{
    cell.edges().map(|ends| ends.map(|node| mesh.positions[node as usize])).map(|[a, b]| length(minus(a, b))).fold(0.0, f64::max)
}

/// Probes whose point is farther from the nearest node of their part than the elements there are large: they
/// watch a node that was not meant.
fn probes<const D: usize>(model: &Model, mesh: &Mesh<D>) -> Vec<Warning>
where
    Dim<D>: Builds<D>,
{
    let mut warnings = Vec::new();
    for (index, probe) in model.probes.iter().enumerate() {
        let ProbeAt::Point { part: name, point } = &probe.at else { continue };
        // What is not yet there may come.
        if probe.kind == ProbeKind::Place {
            continue;
        }
        let Some(part) = mesh.parts.iter().position(|part| part.name == *name) else { continue };
        let wanted: [f64; D] = first(*point);
        let distance = |node: u32| length(minus(mesh.positions[node as usize], wanted));
        let Some(node) = mesh.parts[part].with_faces().min_by(|a, b| distance(*a).total_cmp(&distance(*b))) else { continue };
        let leader = mesh.leader_of(node);
        let around = mesh.groups_of(part).flat_map(|group| group.cells()).filter(|cell| cell.nodes.contains(&leader));
        let edge = around.map(|cell| longest(mesh, cell)).fold(0.0, f64::max);
        let far = distance(node);
        if !(far > edge && edge > 0.0) {
            continue;
        }
        warnings.push(Warning {
            kind: &FAR_PROBE,
            path: format!("probe[{index}].point"),
            message: format!(
                "the nearest node of `{name}` is {far:.3e} m away, at {} m: {:.1} times the size of the elements there",
                place(mesh.positions[node as usize]),
                far / edge
            ),
            consequence: "the probe watches this node, which is not at its point".into(),
            help: "look at the unit and the coordinates of `point`, or name the part that is there".into(),
        });
    }
    warnings
}
