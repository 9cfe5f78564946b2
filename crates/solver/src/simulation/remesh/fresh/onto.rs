//! A mesh of the user's as what fills the outline of a part, in 2D.

use super::super::is_of_part;
use super::{Present, measure_of};
use crate::mesh::Mesh;
use crate::mesh::cell::CellKind;
use embate_remesh::mesher::{Meshed, OnOutline};
use embate_remesh::plane::{self, Cell, Measure, Point};

/// Parts of a segment that are less are none: the node is on its end.
const SLIGHT: f64 = 1e-4;

impl Present {
    /// The elements of a mesh that has them alone: each node of an outline with the nearest place on the old
    /// one, of which these are the loops.
    pub(super) fn meshed(&self, loops: &[Vec<u32>], new: &Mesh<2>) -> Result<Meshed, String> {
        let [group] = &new.groups[..] else { return Err("it has elements of two kinds".into()) };
        if group.kind != CellKind::Quadrilateral {
            return Err(format!("it has {}, and the state goes over to quadrilaterals", group.kind.facts().plural));
        }
        // Nodes in the user's order.
        let user = |node: u32| new.user_nodes[node as usize];
        let mut positions = vec![[0.0; 2]; new.positions.len()];
        (0..).zip(&new.positions).for_each(|(node, &place)| positions[user(node) as usize] = place);
        let cells: Vec<Cell> = group.cells().map(|cell| std::array::from_fn(|k| user(cell.nodes[k]))).collect();
        let unit = if self.measure == Measure::Plane { "m²" } else { "m³" };
        is_of_part(cells.iter().map(|cell| measure_of(&positions, cell, self.measure)).sum(), self.volume(), unit)?;
        let mut own = plane::loops(&cells)?;
        if own.len() != loops.len() {
            return Err(format!("its outline has {} closed lines, and that of the part {}", own.len(), loops.len()));
        }
        // In the order of the old ones.
        let mut on_outline = |old: &Vec<u32>| {
            let distance = |chain: &Vec<u32>| self.nearest(old, positions[chain[0] as usize]).map_or(f64::INFINITY, |(far, ..)| far);
            let at = (0..own.len()).min_by(|&a, &b| distance(&own[a]).total_cmp(&distance(&own[b])));
            let chain = own.swap_remove(at.ok_or("it has no outline")?);
            let on = |&node: &u32| {
                let (_, segment, fraction) = self.nearest(old, positions[node as usize])?;
                Some(OnOutline { node, segment: segment as u32, fraction })
            };
            chain.iter().map(on).collect::<Option<Vec<_>>>().ok_or("the part has no outline")
        };
        let loops = loops.iter().map(&mut on_outline).collect::<Result<Vec<_>, _>>()?;
        Ok(Meshed { positions, cells, loops })
    }

    /// The place on a closed chain that is nearest: its distance, m, its segment, and the fraction of that.
    fn nearest(&self, chain: &[u32], place: Point) -> Option<(f64, usize, f64)> {
        let x = |k: usize| self.positions[chain[k % chain.len()] as usize];
        let of = |k: usize| {
            let (from, to) = (x(k), x(k + 1));
            let along = plane::minus(to, from);
            let fraction = (plane::dot(plane::minus(place, from), along) / plane::dot(along, along)).clamp(0.0, 1.0);
            let distance = plane::distance(place, plane::on_line(from, to, fraction));
            match fraction {
                own if own < SLIGHT => (distance, k, 0.0),
                own if own > 1.0 - SLIGHT => (distance, (k + 1) % chain.len(), 0.0),
                own => (distance, k, own),
            }
        };
        (0..chain.len()).map(of).min_by(|a, b| a.0.total_cmp(&b.0))
    }
}
