//! Parts on which nothing can ever act: a contact that was forgotten, most often.
//!
//! From the model and its mesh: what is joined by elements is one body, and a body is idle if none of its
//! nodes is named by anything that could bring a force or a motion to it, and nothing in it moves or is
//! strained at the start.

use super::Builds;
use crate::contact::messages::IDLE;
use crate::error::Warning;
use crate::mesh::Mesh;
use crate::model::{Constraint, Drive, Load, Model, Part, Partners};
use crate::tensor::Dim;

/// A warning for each such part.
pub(super) fn warnings<const D: usize>(model: &Model, mesh: &Mesh<D>, body_of_node: &[u32]) -> Vec<Warning>
where
    Dim<D>: Builds<D>,
{
    let mut acted = vec![false; body_of_node.iter().max().map_or(0, |last| *last as usize + 1)];
    let mut act_on = |nodes: &[u32]| nodes.iter().for_each(|&node| acted[body_of_node[node as usize] as usize] = true);
    for name in named(model) {
        act_on(&mesh.nodes(name).unwrap_or_default());
    }
    for (part, made) in model.parts.iter().zip(&mesh.parts) {
        if acts_by_itself(model, part) || for_all_or(model, &part.name) {
            act_on(&made.nodes);
        }
    }
    let idle = |nodes: &[u32]| nodes.iter().all(|&node| !acted[body_of_node[node as usize] as usize]);
    let warning = |(index, part): (usize, &Part)| Warning {
        kind: &IDLE,
        path: format!("part[{index}]"),
        message: format!(
            "nothing acts on part `{}`: no contact, obstacle, join, weld, joint, spring, load, cavity or motion has to do with it",
            part.name
        ),
        consequence: "it stays as it is, and other parts go through it".into(),
        help: "name it in a [[contact]], move it or load it, or leave it out".into(),
    };
    model.parts.iter().enumerate().filter(|(index, _)| idle(&mesh.parts[*index].nodes)).map(warning).collect()
}

/// Parts, sides and groups on which something acts.
fn named(model: &Model) -> impl Iterator<Item = &str> {
    let contacts = model.contacts.iter().flat_map(|contact| match &contact.partners {
        Partners::Between(sides) => &sides[..],
        Partners::Bodies(parts) => parts,
    });
    let pairs = model.joins.iter().map(|join| &join.between).chain(model.springs.iter().map(|spring| &spring.between)).flatten();
    let welded = model.welds.iter().flat_map(|weld| &weld.between).chain(model.joints.iter().flat_map(|joint| &joint.between));
    let driven = model.constraints.iter().filter(|constraint| drives(constraint)).map(|constraint| &constraint.on);
    let loaded = model.loads.iter().filter_map(|load| match load {
        Load::Force { on, .. } | Load::Moment { on, .. } | Load::Pressure { on, .. } => Some(on),
        _ => None,
    });
    let pressed = model.cavities.iter().flat_map(|cavity| &cavity.on);
    contacts.chain(pairs).chain(welded).chain(driven).chain(loaded).chain(pressed).map(String::as_str)
}

/// Whether it does more than hold.
fn drives(constraint: &Constraint) -> bool {
    let moves = |drive: &Drive| *drive != Drive::Constant(0.0);
    let Constraint { velocity, displacement, acceleration, spin, rotation, .. } = constraint;
    let components = [velocity, displacement, acceleration, spin];
    components.into_iter().flatten().flatten().chain(rotation.as_ref().map(|it| &it.speed)).any(moves)
}

/// Whether something that acts on lists of parts, or on all, acts on this one.
fn for_all_or(model: &Model, name: &str) -> bool {
    let has = |parts: &[String]| parts.is_empty() || parts.iter().any(|part| part == name);
    let contacts = model.contacts.iter().any(|contact| matches!(&contact.partners, Partners::Bodies(parts) if has(parts)));
    let obstacles = model.obstacles.iter().any(|obstacle| has(&obstacle.parts));
    let loads = model.loads.iter().any(|load| match load {
        Load::Gravity { parts, .. } | Load::Centrifugal { parts, .. } => has(parts),
        _ => false,
    });
    contacts || obstacles || loads
}

/// Whether a part moves from the start, or is strained, or may be: rigid bodies have a motion of their own,
/// equations of state an energy.
fn acts_by_itself(model: &Model, part: &Part) -> bool {
    let has_pressure = model.materials.get(&part.material).is_none_or(|it| !it.eos.is_empty());
    let moves = part.velocity != [0.0; 3] || part.spin != 0.0 || part.radial_velocity.is_some();
    moves || part.rigid.is_some() || part.stress_initial.is_some() || part.temperature_initial.is_some() || has_pressure
}
