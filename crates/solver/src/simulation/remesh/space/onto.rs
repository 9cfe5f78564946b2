//! A part on elements of the user's, in 3D.

use super::super::is_of_part;
use super::{Fill, Fresh, Present, mean};
use crate::mesh::remeshed::NewPart;
use crate::mesh::surface::{self, Corners, Facet};
use crate::mesh::{ElementGroup, Mesh};
use crate::vector::{plus, times};
use embate_remesh::space::{self, Cell, Outside, Point, Within, relocate};

/// Where the material of new nodes is among the old nodes, by their numbers in the mesh.
struct Placed {
    /// Shares of old nodes, which add up to one.
    shares: Vec<Vec<(u32, f64)>>,
    is_outer: Vec<bool>,
    /// Pieces of the new outline, each with the old one that it lies on.
    outline: Vec<(Facet<3>, Facet<3>)>,
}

impl Fill<'_> {
    /// The part on the elements of a mesh that has them alone, and its state.
    pub(super) fn onto(&self, new: &Mesh<3>) -> Result<Fresh<3>, String> {
        let (system, present) = (self.system, self.present);
        // Nodes in the user's order.
        let user = |node: u32| new.user_nodes[node as usize];
        let mut places = vec![[0.0; 3]; new.positions.len()];
        (0..).zip(&new.positions).for_each(|(node, &place)| places[user(node) as usize] = place);
        let cells = Present::cells_of(new, 0, user).ok_or(OTHERS)?;
        let volumes = space::volumes(space::Mesh { positions: &places, cells: &cells }).map_err(|failure| failure.to_string())?;
        let (volume, before): (f64, f64) = (volumes.iter().sum(), present.volumes.iter().sum());
        is_of_part(volume, before, "m³")?;
        let Placed { shares, is_outer, outline } = self.placed(new, &places, user)?;
        let new_part = NewPart {
            part: self.part,
            elements: new.groups.iter().map(|group| (group.kind, group.connectivity.iter().map(|&node| user(node)).collect())).collect(),
            initial: shares.iter().map(|own| mean(own, &system.mesh.positions)).collect(),
            origins: shares.iter().map(|own| own.iter().map(|(node, _)| *node).collect()).collect(),
            outline,
            places,
        };
        let (mut mesh, numbers) = system.mesh.with_new(&new_part, [system.limits.step, system.limits.velocity]);
        let mut locals = vec![0; mesh.positions.len()];
        (0..).zip(&numbers.of_new).for_each(|(local, &node)| locals[node as usize] = local);
        // In the order of the mesh.
        let cells: Vec<Cell> = Present::cells_of(&mesh, self.part, |node| locals[node as usize]).ok_or(OTHERS)?;
        let target = space::Mesh { positions: &new_part.places, cells: &cells };
        let velocities: Vec<Point> = shares.iter().map(|own| mean(own, &system.velocities)).collect();
        let nodes = self.nodes(target, &self.held(&mesh, &numbers.of_new, &velocities)?)?;
        let node_masses = mesh.parts[self.part].nodes.iter().map(|&node| nodes.mass[locals[node as usize] as usize]).collect();
        let own = mesh.remeshed.parts.last_mut().ok_or(OTHERS)?;
        (own.masses, own.node_masses) = (nodes.cell_mass.clone(), node_masses);
        let points = self.points(target, &mesh, &nodes.cell_mass)?;
        let quality = relocate::quality(target);
        Ok(Fresh {
            mesh,
            numbers,
            between: shares.into_iter().zip(is_outer).map(|(own, outer)| if outer { own } else { Vec::new() }).collect(),
            velocities: nodes.velocities,
            points,
            quality,
            correction: nodes.correction,
            volume_change: volume / before - 1.0,
            centre: self.centre(),
            exchange: None,
        })
    }

    /// Nodes of the outline are where its old pieces are nearest, the others in old elements.
    fn placed(&self, new: &Mesh<3>, places: &[Point], user: impl Fn(u32) -> u32) -> Result<Placed, String> {
        let (system, present) = (self.system, self.present);
        let old = exterior(system.mesh.groups_of(self.part))?;
        let own: Vec<Facet<3>> = exterior(new.groups.iter())?.into_iter().map(|facet| facet.renamed(&user)).collect();
        let mut outside = Outside::new(&system.positions, &old);
        let piece = |facet: Facet<3>| {
            let corners = facet.corners();
            let middle = corners.iter().fold([0.0; 3], |sum, &node| plus(sum, times(1.0 / corners.len() as f64, places[node as usize])));
            Some((facet, old[outside.nearest(middle)?.face]))
        };
        let outline: Vec<(Facet<3>, Facet<3>)> = own.into_iter().map(piece).collect::<Option<_>>().ok_or("the part has no outline")?;
        let mut is_outer = vec![false; places.len()];
        outline.iter().flat_map(|(facet, _)| facet.corners().to_vec()).for_each(|node| is_outer[node as usize] = true);
        let mut within = Within::new(present.mesh()).map_err(|failure| failure.to_string())?;
        let number = |(local, share): (u32, f64)| (present.nodes[local as usize], share);
        let of = |(&place, outer): (&Point, &bool)| {
            if *outer {
                outside.nearest(place).map(|nearest| nearest.shares)
            } else {
                within.shares(place).map(|shares| shares.into_iter().map(number).collect())
            }
        };
        let shares: Option<Vec<Vec<(u32, f64)>>> = places.iter().zip(&is_outer).map(of).collect();
        Ok(Placed { shares: shares.ok_or("the part has no elements")?, is_outer, outline })
    }
}

const OTHERS: &str = "it has elements that no state goes over to";

/// The outside of some elements.
fn exterior<'a>(groups: impl Iterator<Item = &'a ElementGroup>) -> Result<Vec<Facet<3>>, String> {
    let cells: Vec<_> = groups.flat_map(ElementGroup::cells).collect();
    surface::exterior::<3>(cells).map_err(|fault| fault.to_string())
}
