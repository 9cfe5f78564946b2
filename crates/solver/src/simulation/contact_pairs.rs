//! What `embate check` says of a contact of bodies of which some are tied or joined besides: nothing else in
//! the model shows that two conditions hold the same surfaces.

use super::Runs;
use crate::mesh::Mesh;
use crate::model::reference::{Reference, Wanted};
use crate::model::{Contact, Model, Part, Partners, Window};
use crate::tensor::Dim;
use std::collections::{BTreeMap, BTreeSet};

/// A line for each such contact.
pub(super) fn lines<const D: usize>(model: &Model, mesh: &Mesh<D>) -> Vec<String>
where
    Dim<D>: Runs<D>,
{
    let ties = model.contacts.iter().filter(|contact| contact.tied.is_some());
    let tied = ties.filter_map(|tie| if let Partners::Between(between) = &tie.partners { Some((between, tie)) } else { None });
    let mut tied_pairs: BTreeMap<[usize; 2], Vec<&Contact>> = BTreeMap::new();
    for (between, tie) in tied {
        for pair in pairs(model, mesh, between) {
            tied_pairs.entry(pair).or_default().push(tie);
        }
    }
    let joined: BTreeSet<[usize; 2]> = model.joins.iter().flat_map(|join| pairs(model, mesh, &join.between)).collect();
    model.contacts.iter().filter_map(|contact| line(model, contact, &tied_pairs, &joined)).collect()
}

fn line(model: &Model, contact: &Contact, tied: &BTreeMap<[usize; 2], Vec<&Contact>>, joined: &BTreeSet<[usize; 2]>) -> Option<String> {
    let Partners::Bodies(names) = &contact.partners else { return None };
    let is_in = |part: &Part| !part.has_no_surface() && (names.is_empty() || names.contains(&part.name));
    let parts: Vec<bool> = model.parts.iter().map(is_in).collect();
    let count = parts.iter().filter(|is_in| **is_in).count();
    let name = |[a, b]: [usize; 2]| format!("{} with {}", model.parts[a].name, model.parts[b].name);
    let meets = |pair: &[usize; 2]| pair.iter().all(|&part| parts[part]);
    let friction = if contact.interface.friction.is_some() { ", and its friction bears a part of the shear" } else { "" };
    let mut told: Vec<String> = tied
        .iter()
        .filter(|(pair, _)| meets(pair))
        .map(|(pair, ties)| {
            let names: Vec<&str> = ties.iter().map(|tie| tie.name.as_str()).collect();
            let is_always = |tie: &&Contact| Window::of(model, &tie.interface.stages, tie.interface.active).is_always();
            let effect = if ties.iter().all(is_always) {
                "what is tied is left out".into()
            } else {
                format!("not all the time, so where they are pressed together both push{friction}")
            };
            format!("{} is tied (by {}): {effect}", name(*pair), names.join(", "))
        })
        .collect();
    told.extend(joined.iter().filter(|pair| meets(pair)).map(|pair| format!("{} is joined: the joined faces are left out", name(*pair))));
    let pairs = match count * count.saturating_sub(1) / 2 {
        1 => "1 pair".to_string(),
        more => format!("{more} pairs"),
    };
    (!told.is_empty()).then(|| format!("{}: {pairs} of {count} parts; {}", contact.name, told.join("; ")))
}

/// Pairs of parts that two surfaces belong to, each in ascending order.
fn pairs<const D: usize>(model: &Model, mesh: &Mesh<D>, between: &[String; 2]) -> Vec<[usize; 2]>
where
    Dim<D>: Runs<D>,
{
    let [one, other] = between.each_ref().map(|name| parts_of(model, mesh, name));
    let all = one.iter().flat_map(|&a| other.iter().map(move |&b| [a.min(b), a.max(b)]));
    all.filter(|[a, b]| a != b).collect()
}

/// Parts that a surface belongs to: of a group those that have all of its nodes, or else some.
fn parts_of<const D: usize>(model: &Model, mesh: &Mesh<D>, name: &str) -> Vec<usize>
where
    Dim<D>: Runs<D>,
{
    match model.reference(name, Wanted::Surface) {
        Ok(Reference::Part(part) | Reference::Side { part, .. }) => return vec![part],
        Ok(Reference::Group { .. }) => {}
        Err(_) => return Vec::new(),
    }
    let nodes: BTreeSet<u32> = mesh.nodes(name).unwrap_or_default().into_iter().collect();
    let shared = |part: usize| mesh.parts[part].with_faces().filter(|node| nodes.contains(node)).count();
    let having: Vec<(usize, usize)> = (0..mesh.parts.len()).map(|part| (part, shared(part))).filter(|(_, count)| *count > 0).collect();
    let has_all = having.iter().any(|(_, count)| *count == nodes.len());
    having.into_iter().filter(|(_, count)| !has_all || *count == nodes.len()).map(|(part, _)| part).collect()
}
