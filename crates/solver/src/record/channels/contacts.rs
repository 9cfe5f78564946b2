//! Contacts, obstacles, welds and joints: what they transmit.

use super::{AXES, Channel, Column, forces, means, moment, samples};
use crate::body_columns::BodyColumns;
use crate::contact::connection::Connected;
use crate::contact::{Contact, ContactKind};
use crate::dimension::Dimension;
use crate::model::{Model, Partners};
use crate::rigid::Body;
use crate::rotation::Rotate;
use crate::step::System;
use crate::tensor::Dim;
use crate::vector::{length, minus, plus};

/// Bodies up to which a contact of several has columns by pair, unless it is asked for.
const PAIRED: usize = 4;

/// The group.
pub(super) struct Contacts<const D: usize> {
    /// Of each contact that is a tie the point about which its moment is: the mean of the first surface's
    /// nodes at the start, m.
    points: Vec<Option<[f64; D]>>,
    /// Part of each node; of several the first. Empty where no contact has pairs.
    parts: Vec<u32>,
    /// Of each contact the pairs of parts that have columns.
    pairs: Vec<Vec<[u32; 2]>>,
}

impl<const D: usize> Contacts<D>
where
    Dim<D>: Dimension<D>,
{
    pub(super) fn new(model: &Model, system: &System<D>) -> Self {
        let pairs: Vec<Vec<[u32; 2]>> = system.contacts.iter().map(|contact| pairs(model, system, contact)).collect();
        let mut parts = Vec::new();
        if pairs.iter().any(|pairs| !pairs.is_empty()) {
            parts = vec![u32::MAX; system.mesh.positions.len()];
            for (index, part) in system.mesh.parts.iter().enumerate().rev() {
                part.with_faces().for_each(|node| parts[node as usize] = index as u32);
            }
        }
        Self { points: system.contacts.iter().map(|contact| tie_point(model, system, contact)).collect(), parts, pairs }
    }

    /// Adds the forces between pairs of parts: on the first of the second.
    fn pair_forces(&self, index: usize, system: &System<D>, row: &mut Vec<f64>) {
        let pairs = &self.pairs[index];
        if pairs.is_empty() {
            return;
        }
        let first = row.len();
        row.resize(first + D * pairs.len(), 0.0);
        let part = |node: u32| self.parts.get(node as usize).copied().unwrap_or(u32::MAX);
        system.contacts[index].each_end(&system.springs, |from, to, force| {
            let (from, to) = (part(from), part(to));
            let (pair, sign) = if to < from { ([to, from], -1.0) } else { ([from, to], 1.0) };
            if let Ok(place) = pairs.binary_search(&pair) {
                row[first + D * place..][..D].iter_mut().zip(force).for_each(|(sum, force)| *sum += sign * force);
            }
        });
    }
}

/// Pairs of a contact of several bodies, ascending.
fn pairs<const D: usize>(model: &Model, system: &System<D>, contact: &Contact<D>) -> Vec<[u32; 2]>
where
    Dim<D>: Dimension<D>,
{
    let own = model.contacts.iter().find(|own| contact.kind == ContactKind::Contact && own.name == contact.name);
    let Some((own, Partners::Bodies(named))) = own.map(|own| (own, &own.partners)) else { return Vec::new() };
    let parts = (0..).zip(&system.mesh.parts);
    let parts: Vec<u32> = parts.filter(|(_, part)| named.is_empty() || named.contains(&part.name)).map(|(index, _)| index).collect();
    if !own.pairs.unwrap_or(parts.len() <= PAIRED) {
        return Vec::new();
    }
    let later = |(place, &one): (usize, &u32)| parts[place + 1..].iter().map(move |&other| [one, other]).collect::<Vec<_>>();
    parts.iter().enumerate().flat_map(later).collect()
}

/// Where the moment of a contact that is a tie is about.
fn tie_point<const D: usize>(model: &Model, system: &System<D>, contact: &Contact<D>) -> Option<[f64; D]>
where
    Dim<D>: Dimension<D>,
{
    let own = model.contacts.iter().find(|own| contact.kind == ContactKind::Contact && own.name == contact.name)?;
    own.tied.as_ref()?;
    let Partners::Between([first, _]) = &own.partners else { return None };
    Some(system.mesh.mean_place(&system.mesh.nodes(first)?))
}

fn moves<const D: usize>(system: &System<D>, body: usize) -> Option<&Body<D>>
where
    Dim<D>: Dimension<D>,
{
    Some(system.bodies.state(body)).filter(|body| !body.is_fixed())
}

impl<const D: usize> Channel<D> for Contacts<D>
where
    Dim<D>: Dimension<D> + BodyColumns<D>,
{
    fn columns(&self, system: &System<D>) -> Vec<Column> {
        let mut columns = Vec::new();
        for ((contact, pairs), point) in system.contacts.iter().zip(&self.pairs).zip(&self.points) {
            let (kind, name) = (contact.kind.name(), &contact.name);
            let column = |value: &&str| format!("{kind}.{value}[{name}]");
            match contact.kind {
                ContactKind::Weld => columns.extend(samples(["normal_force", "shear_force", "moment", "intact"].iter().map(column))),
                ContactKind::Joint => {
                    columns.extend(means(forces::<D>().iter().chain(<Dim<D>>::MOMENT).map(column)));
                    columns.extend(samples([column(&"gap")]));
                }
                ContactKind::Contact | ContactKind::Obstacle(_) => {
                    columns.extend(means(forces::<D>().iter().map(column)));
                    columns.extend(samples(["energy", "penetration", "friction_work"].iter().map(column)));
                }
            }
            if let ContactKind::Obstacle(body) = contact.kind {
                columns.extend(means(<Dim<D>>::MOMENT.iter().map(column)));
                columns.extend(samples(moves(system, body).iter().flat_map(|_| <Dim<D>>::MOTION).map(column)));
            }
            if point.is_some() {
                columns.extend(means(<Dim<D>>::MOMENT.iter().map(column)));
            }
            for pair in pairs {
                let [one, other] = pair.map(|part| &system.mesh.parts[part as usize].name);
                columns.extend(means(AXES[..D].iter().map(|axis| format!("{kind}.force_{axis}[{name}:{one}-{other}]"))));
            }
        }
        columns
    }

    fn samples(&self, system: &System<D>, row: &mut Vec<f64>) {
        for contact in &system.contacts {
            let (totals, connected) = (&contact.totals, || contact.connected().unwrap_or_default());
            match contact.kind {
                ContactKind::Weld => {
                    let Connected { moment, normal, shear, intact, .. } = connected();
                    row.extend([normal, shear, length(moment), f64::from(u8::from(intact))]);
                }
                ContactKind::Joint => row.push(connected().gap),
                ContactKind::Contact | ContactKind::Obstacle(_) => {
                    row.extend([totals.energy + totals.slip_energy, contact.depth(), contact.friction_work]);
                }
            }
            if let ContactKind::Obstacle(body) = contact.kind {
                row.extend(moves(system, body).iter().flat_map(|body| <Dim<D>>::motion(body, system.before())));
            }
        }
    }

    fn rates(&self, system: &System<D>, row: &mut Vec<f64>) {
        for (index, contact) in system.contacts.iter().enumerate() {
            match contact.kind {
                ContactKind::Weld => {}
                ContactKind::Joint => {
                    let Connected { force, moment: about, .. } = contact.connected().unwrap_or_default();
                    row.extend(force[..D].iter().copied().chain(moment::<D>(about)));
                }
                ContactKind::Contact | ContactKind::Obstacle(_) => {
                    row.extend(contact.totals.resultant);
                    add_moment(system, contact, self.points[index], row);
                    self.pair_forces(index, system, row);
                }
            }
        }
    }
}

/// Adds the moment of an obstacle or a tie.
fn add_moment<const D: usize>(system: &System<D>, contact: &Contact<D>, tie: Option<[f64; D]>, row: &mut Vec<f64>)
where
    Dim<D>: Dimension<D> + BodyColumns<D>,
{
    if let ContactKind::Obstacle(body) = contact.kind {
        row.extend(<Dim<D>>::moments(&contact.moment(body, &system.bodies, &system.springs, &system.positions)));
    }
    if let Some(point) = tie {
        let mut sum = [0.0; 3];
        contact.each_on_first(&system.springs, |node, force| {
            let arm = system.positions.get(node as usize).map_or([0.0; D], |&x| minus(x, point));
            sum = plus(sum, <Dim<D>>::moment_vector(arm, force));
        });
        row.extend(moment::<D>(sum));
    }
}
