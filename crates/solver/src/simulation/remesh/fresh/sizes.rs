//! How long edges of new elements are to be: as everywhere, where the part presses on something, and where
//! its plastic strain changes.

use super::super::Wish;
use super::{Present, measure_of};
use crate::material::variable::PLASTIC_STRAIN;
use crate::step::System;
use crate::vector::{minus, plus, times};
use embate_remesh::plane::{self, Measure, Point, corners};

/// Edges grow by this per length, away from where they are shorter.
const GROWTH: f64 = 0.25;
/// The shortest edges that plastic strain asks for, over the size elsewhere, where the model does not say.
const LEAST: f64 = 0.25;

/// A place where edges are to be shorter than elsewhere.
struct Fine {
    place: Point,
    /// Length that edges are to have there, and that they have, m.
    wanted: f64,
    present: f64,
}

/// How long edges are to be.
pub(super) struct Sizes {
    /// Elsewhere, m.
    size: f64,
    fine: Vec<Fine>,
    /// The most cells.
    pub(super) most: usize,
    /// The largest length of an edge over that which is wanted there, in contact and where strain changes.
    pub(super) coarseness: f64,
}

impl Sizes {
    pub(super) fn new(system: &System<2>, part: usize, present: &Present, wish: &Wish) -> Self {
        let areas = present.areas();
        let [start, most] = wish.elements;
        let size = wish.size.unwrap_or_else(|| (areas.iter().sum::<f64>() / start as f64).sqrt());
        let (mut fine, mut in_contact) = (Vec::new(), 0.0f64);
        if let Some(wanted) = wish.size_contact {
            // Whether or not as many elements may be made as this asks for.
            in_contact = present.pressing(system).fold(0.0, |most, (_, longest)| most.max(longest / wanted));
            let all = present.pressing(system).map(|(place, present)| Fine { place, wanted, present });
            fine.extend(all.filter(|own| own.wanted < size));
        }
        let of_contact = fine.len();
        if let Some(change) = wish.strain_change {
            let least = wish.size_least.unwrap_or(LEAST * size);
            let of =
                |((place, slope), area): ((Point, f64), &f64)| Fine { place, wanted: (change / slope).max(least), present: area.sqrt() };
            let strained = present.slopes(system, part).into_iter().zip(&areas).map(of);
            fine.extend(strained.filter(|own| own.wanted < size));
        }
        let mut sizes = Self { size, fine, most, coarseness: 0.0 };
        // The mesher may need some more than the mean says.
        let at = |cell: &plane::Cell| sizes.at(present.positions[cell[0] as usize]);
        let wanted: f64 = present.cells.iter().zip(&areas).map(|(cell, area)| area / (at(cell) * at(cell))).sum();
        let longer = (wanted / (0.8 * most as f64)).sqrt().max(1.0);
        sizes.size *= longer;
        sizes.fine.iter_mut().for_each(|own| own.wanted *= longer);
        let strained = sizes.fine[of_contact..].iter().map(|own| own.present / own.wanted);
        sizes.coarseness = strained.fold(in_contact, f64::max);
        sizes
    }

    /// Edge length at a place, m.
    pub(super) fn at(&self, place: Point) -> f64 {
        self.fine.iter().map(|own| own.wanted + GROWTH * plane::distance(own.place, place)).fold(self.size, f64::min)
    }
}

/// Whether a contact pushes a node.
fn presses(system: &System<2>, node: u32) -> bool {
    system.contact_forces.of(node as usize) != [0.0; 2]
}

impl Present {
    /// Places of the nodes that press on something, m, with the longest edge to another one, m.
    fn pressing(&self, system: &System<2>) -> impl Iterator<Item = (Point, f64)> {
        let presses: Vec<bool> = self.nodes.iter().map(|&node| presses(system, node)).collect();
        let mut longest = vec![0.0f64; self.nodes.len()];
        for cell in &self.cells {
            let nodes = corners(cell);
            for k in 0..nodes.len() {
                let [a, b] = [nodes[k] as usize, nodes[(k + 1) % nodes.len()] as usize];
                if presses[a] && presses[b] {
                    let length = plane::distance(self.positions[a], self.positions[b]);
                    (longest[a], longest[b]) = (longest[a].max(length), longest[b].max(length));
                }
            }
        }
        let all = self.positions.iter().copied().zip(longest).zip(presses);
        all.filter(|(_, presses)| *presses).map(|(of, _)| of).collect::<Vec<_>>().into_iter()
    }

    /// Areas of the cells, m².
    fn areas(&self) -> Vec<f64> {
        self.cells.iter().map(|cell| measure_of(&self.positions, cell, Measure::Plane)).collect()
    }

    /// Of each cell its centre, m, and how much plastic strain changes there, 1/m: |∮ ε n ds| / A of the line
    /// through its corners, where the strain is the mean of the cells around.
    fn slopes(&self, system: &System<2>, part: usize) -> Vec<(Point, f64)> {
        let mut strains = Vec::with_capacity(self.cells.len());
        for (_, block) in system.mesh.groups.iter().zip(&system.blocks).filter(|(group, _)| group.part == part) {
            let of = |element: usize| block.variable(&block.state(element), &PLASTIC_STRAIN).unwrap_or(0.0);
            strains.extend((0..block.elements()).map(of));
        }
        let (mut sums, mut areas) = (vec![0.0; self.nodes.len()], vec![0.0; self.nodes.len()]);
        let of_cells = self.areas();
        for ((cell, strain), area) in self.cells.iter().zip(&strains).zip(&of_cells) {
            for &node in corners(cell) {
                sums[node as usize] += area * strain;
                areas[node as usize] += area;
            }
        }
        let at = |node: u32| sums[node as usize] / areas[node as usize];
        let of = |(cell, area): (&plane::Cell, &f64)| {
            let nodes = corners(cell);
            let place = |k: usize| self.positions[nodes[k % nodes.len()] as usize];
            let centre = (0..nodes.len()).fold([0.0; 2], |sum, k| plus(sum, times(1.0 / nodes.len() as f64, place(k))));
            let slope = (0..nodes.len()).fold([0.0; 2], |sum, k| {
                let mean = 0.5 * (at(nodes[k]) + at(nodes[(k + 1) % nodes.len()]));
                let [x, y] = minus(place(k + 1), place(k));
                plus(sum, times(mean, [y, -x]))
            });
            (centre, plane::dot(slope, slope).sqrt() / area)
        };
        self.cells.iter().zip(&of_cells).map(of).collect()
    }
}
