//! Four-node tetrahedra and three-node triangles of constant strain that hold their volume one by one: in
//! plastic flow and in rubber there are more such conditions than motions that are left.

use super::Builds;
use crate::error::Warning;
use crate::material::messages::LOCKING;
use crate::material::{self, Parameters};
use crate::mesh::Mesh;
use crate::mesh::cell::CellKind;
use crate::model::{Material, Model};
use crate::stress_state::PLANE_STRESS;
use crate::tensor::Dim;

/// Elements that lock, and what to take.
const LOCK: [(&str, &str); 2] = [
    ("tet4", "take `element = \"tet10\"`, for which a coarser mesh of four or ten nodes does, or hexahedra"),
    ("tri3", "take `element_triangles = \"tri6\"`, for which a coarser mesh does, or quadrilaterals"),
];
/// From this ratio of K to µ on (a Poisson's ratio of 0.49) a body can't be deformed otherwise than by
/// keeping its volume.
const STRONG_VOLUME: f64 = 50.0;
/// A few such elements among others make no body stiff.
const FEW: f64 = 0.1;

/// A warning for each part that consists of them to more than a tenth, of a law that keeps the volume.
pub(super) fn warnings<const D: usize>(model: &Model, mesh: &Mesh<D>) -> Vec<Warning>
where
    Dim<D>: Builds<D>,
{
    let mut warnings = Vec::new();
    for (index, part) in model.parts.iter().enumerate().filter(|(_, part)| part.rigid.is_none()) {
        let Some(why) = model.materials.get(&part.material).filter(|_| part.stress_state != PLANE_STRESS.name).and_then(keeps_volume)
        else {
            continue;
        };
        let name = |kind: CellKind| part.element_in(D, kind).map_or("", |kind| kind.name);
        let all = mesh.elements_of(index);
        for (element, help) in LOCK {
            let of_group = mesh.groups_of(index).filter(|group| group.is_body(D) && name(group.kind) == element);
            let count: usize = of_group.map(|group| group.elements()).sum();
            if count as f64 > FEW * all as f64 {
                warnings.push(Warning {
                    kind: &LOCKING,
                    path: format!("part[{index}].material"),
                    message: format!("{why}, and {count} of {all} elements are `{element}`"),
                    consequence: "they lock: the part is several times too stiff, also with many elements".into(),
                    help: help.into(),
                });
            }
        }
    }
    warnings
}

/// Why a material keeps its volume while it deforms; `None`: it does not, or nobody can say.
fn keeps_volume(it: &Material) -> Option<String> {
    if material::bears_uniaxial_stress(&it.law) != Some(true) {
        return None;
    }
    let law = material::LAWS.iter().find(|law| law.name == it.law)?;
    if material::flows_at_constant_volume(law.name) == Some(true) {
        return Some(format!("`{}` flows plastically at constant volume", it.law));
    }
    let parameters = Parameters::new(law.parameters, &it.parameters, &it.lists);
    let [bulk, shear] = material::stiffness(&it.law, &parameters)?;
    (it.eos.is_empty() && bulk > STRONG_VOLUME * shear)
        .then(|| format!("the bulk modulus of `{}` is {:.0} times its shear modulus", it.law, bulk / shear))
}
