//! Parts whose elements are to be made again or nodes moved, and which are bound to others by common nodes
//! or, in 3D, have elements whose nodes do not move.

use super::Builds;
use crate::error::Fault;
use crate::mesh::Mesh;
use crate::model::messages::NO_REMESHING;
use crate::model::{Model, Rule};
use crate::tensor::Dim;
use crate::vocabulary::excerpt;

/// Elements in 3D whose nodes move.
const MOVED: [&str; 6] = ["hex8", "hex8_reduced", "hex8_reduced_viscous", "hex8_reduced_assumed_strain", "wedge6", "tet4"];

/// What a part with elements of another kind is refused with, and what to do instead.
type Wrong = (String, &'static str);

/// A fault for each part with nodes of its own and of another part, or with other elements in 3D.
pub(super) fn faults<const D: usize>(model: &Model, mesh: &Mesh<D>) -> Vec<Fault>
where
    Dim<D>: Builds<D>,
{
    let mut faults = Vec::new();
    for Rule { path, of: rule, .. } in model.rules_of_remeshing() {
        let Some(own) = model.parts.iter().position(|part| part.name == rule.part) else { continue };
        faults.extend(shared(model, mesh, own, &format!("{path}.part")));
        let second = |kind: &str| (kind == "tet10").then(|| (of_kind(model, own, kind), ELEMENTS));
        let found = wrong_elements(model, mesh, (own, own)).or_else(|| kinds(model, mesh, (own, own)).into_iter().find_map(second));
        faults.extend(found.map(|(message, help)| Fault::new(&NO_REMESHING, format!("{path}.part"), message, help)));
    }
    faults
}

/// A fault for a part that has nodes in common with another one.
pub(crate) fn shared<const D: usize>(model: &Model, mesh: &Mesh<D>, own: usize, path: &str) -> Option<Fault>
where
    Dim<D>: Builds<D>,
{
    let mut is_own = vec![false; mesh.positions.len()];
    mesh.groups_of(own).flat_map(|group| &group.connectivity).for_each(|&node| is_own[node as usize] = true);
    let mut others = mesh.groups.iter().filter(|group| group.part != own);
    let other = others.find(|group| group.connectivity.iter().any(|&node| is_own[node as usize]))?;
    let [name, other] = [own, other.part].map(|part| excerpt(&model.parts[part].name));
    let message = format!("part `{name}` has nodes in common with part `{other}`");
    Some(Fault::new(&NO_REMESHING, path, message, "mesh the parts apart, and let them touch"))
}

/// Why a state can't go over to or from elements of a part in 3D; `index`: that of the part in the model and
/// in the mesh.
pub(crate) fn wrong_elements<const D: usize>(model: &Model, mesh: &Mesh<D>, index: (usize, usize)) -> Option<Wrong>
where
    Dim<D>: Builds<D>,
{
    if D != 3 {
        return None;
    }
    let kinds = kinds(model, mesh, index);
    let name = excerpt(&model.parts[index.0].name);
    match kinds.iter().find(|kind| !MOVED.contains(kind) && **kind != "tet10") {
        Some(kind) => Some((of_kind(model, index.0, kind), ELEMENTS)),
        None if kinds.contains(&"wedge6") && kinds.iter().any(|kind| kind.starts_with("hex8_")) => {
            Some((format!("part `{name}` has wedges of six points beside hexahedra of one"), ELEMENTS))
        }
        None => None,
    }
}

const ELEMENTS: &str = "take hexahedra (`hex8`, `hex8_reduced`), `hex8` with `wedge6`, or `tet4`";

fn of_kind(model: &Model, part: usize, kind: &str) -> String {
    format!("elements of part `{}` are `{kind}`", excerpt(&model.parts[part].name))
}

/// What the elements of a part are.
fn kinds<const D: usize>(model: &Model, mesh: &Mesh<D>, (own, at): (usize, usize)) -> Vec<&'static str>
where
    Dim<D>: Builds<D>,
{
    mesh.groups_of(at).filter_map(|group| model.parts[own].element_in(D, group.kind)).map(|kind| kind.name).collect()
}
