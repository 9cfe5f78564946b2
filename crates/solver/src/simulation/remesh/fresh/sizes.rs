//! How long edges of new elements are to be: as everywhere, where the part presses on something, where its
//! plastic strain changes, and where its stress has errors.
//!
//! The error of the stress is that of Zienkiewicz and Zhu (Int. J. Numer. Meth. Engng 24 (1987) 337-357), in
//! the norm of the stress itself: the stress σ* of a node is the mean of the elements around by their areas,
//! and the error of an element the quadratic mean of σ* − σ over it, of a stress that grows evenly a third of
//! that over its corners. It falls with the length of the edges, so edges of the wanted error e are e/e_now
//! times as long.

use super::super::Wish;
use super::{Present, measure_of};
use crate::block::{Block, ElementState};
use crate::material::variable::PLASTIC_STRAIN;
use crate::model::Remesh;
use crate::step::System;
use crate::vector::{minus, plus, times};
use embate_remesh::plane::{self, Measure, Point, corners};

/// Edges grow by this per length, away from where they are shorter.
const GROWTH: f64 = 0.25;
/// The shortest edges that plastic strain and errors ask for, over the size elsewhere, where the model does
/// not say.
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
    /// Whether edges are to be shorter somewhere.
    pub(super) fn differ(rule: &Remesh) -> bool {
        rule.size_contact.is_some() || rule.strain_change.is_some() || rule.stress_error.is_some()
    }

    pub(super) fn new(system: &System<2>, part: usize, present: &Present, wish: &Wish<'_>) -> Self {
        let (areas, rule) = (present.areas(), wish.rule);
        let [start, most] = wish.elements;
        let size = rule.size.unwrap_or_else(|| (areas.iter().sum::<f64>() / start as f64).sqrt());
        let (mut fine, mut in_contact) = (Vec::new(), 0.0f64);
        if let Some(wanted) = rule.size_contact {
            // Whether or not as many elements may be made as this asks for.
            in_contact = present.pressing(system).fold(0.0, |most, (_, longest)| most.max(longest / wanted));
            let all = present.pressing(system).map(|(place, present)| Fine { place, wanted, present });
            fine.extend(all.filter(|own| own.wanted < size));
        }
        let (of_contact, least) = (fine.len(), rule.size_least.unwrap_or(LEAST * size));
        let mut add = |all: Vec<(Point, f64)>| {
            let of = |((place, wanted), area): ((Point, f64), &f64)| Fine { place, wanted: wanted.max(least), present: area.sqrt() };
            fine.extend(all.into_iter().zip(&areas).map(of).filter(|own| own.wanted < size));
        };
        if let Some(change) = rule.strain_change {
            add(present.slopes(system, part, &areas).into_iter().map(|(place, slope)| (place, change / slope)).collect());
        }
        if let Some(error) = rule.stress_error {
            let of = |((place, own), area): ((Point, f64), &f64)| (place, area.sqrt() * error / own);
            add(present.errors(system, part, &areas).into_iter().zip(&areas).map(of).collect());
        }
        let mut sizes = Self { size, fine, most, coarseness: 0.0 };
        // The mesher may need some more than the mean says.
        let at = |cell: &plane::Cell| sizes.at(present.positions[cell[0] as usize]);
        let wanted: f64 = present.cells.iter().zip(&areas).map(|(cell, area)| area / (at(cell) * at(cell))).sum();
        let longer = (wanted / (0.8 * most as f64)).sqrt().max(1.0);
        sizes.size *= longer;
        sizes.fine.iter_mut().for_each(|own| own.wanted *= longer);
        let of_elements = sizes.fine[of_contact..].iter().map(|own| own.present / own.wanted);
        sizes.coarseness = of_elements.fold(in_contact, f64::max);
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

    /// Of each cell its centre, m.
    fn centres(&self) -> impl Iterator<Item = Point> {
        self.cells.iter().map(|cell| {
            let nodes = corners(cell);
            nodes.iter().fold([0.0; 2], |sum, &node| plus(sum, times(1.0 / nodes.len() as f64, self.positions[node as usize])))
        })
    }

    /// Of each node the mean over the cells around, by their areas, of what cells have.
    fn means<const N: usize>(&self, of_cells: &[[f64; N]], areas: &[f64]) -> Vec<[f64; N]> {
        let (mut sums, mut around) = (vec![[0.0; N]; self.nodes.len()], vec![0.0; self.nodes.len()]);
        for ((cell, own), area) in self.cells.iter().zip(of_cells).zip(areas) {
            for &node in corners(cell) {
                (0..N).for_each(|k| sums[node as usize][k] += area * own[k]);
                around[node as usize] += area;
            }
        }
        sums.into_iter().zip(around).map(|(sum, area)| sum.map(|own| own / area)).collect()
    }

    /// Of each cell its centre, m, and how much plastic strain changes there, 1/m: |∮ ε n ds| / A of the line
    /// through its corners, where the strain is the mean of the cells around.
    fn slopes(&self, system: &System<2>, part: usize, areas: &[f64]) -> Vec<(Point, f64)> {
        let at = self.means(&of_cells(system, part, |block, state| [block.variable(state, &PLASTIC_STRAIN).unwrap_or(0.0)]), areas);
        let of = |((cell, area), centre): ((&plane::Cell, &f64), Point)| {
            let nodes = corners(cell);
            let place = |k: usize| self.positions[nodes[k % nodes.len()] as usize];
            let strain = |k: usize| at[nodes[k % nodes.len()] as usize][0];
            let slope = (0..nodes.len()).fold([0.0; 2], |sum, k| {
                let [x, y] = minus(place(k + 1), place(k));
                plus(sum, times(0.5 * (strain(k) + strain(k + 1)), [y, -x]))
            });
            (centre, plane::dot(slope, slope).sqrt() / area)
        };
        self.cells.iter().zip(areas).zip(self.centres()).map(of).collect()
    }

    /// Of each cell its centre, m, and the estimated error of its stress, over the quadratic mean of the
    /// stress of the part: see the head of the file.
    fn errors(&self, system: &System<2>, part: usize, areas: &[f64]) -> Vec<(Point, f64)> {
        let stresses = of_cells(system, part, |_, state| [0, 1, 2, 3].map(|k| state.stress[k]));
        let at = self.means(&stresses, areas);
        let whole: f64 = areas.iter().zip(&stresses).map(|(area, stress)| area * square(stress)).sum();
        let size = (whole / areas.iter().sum::<f64>()).sqrt();
        let of = |((cell, stress), centre): ((&plane::Cell, &[f64; 4]), Point)| {
            let nodes = corners(cell);
            let off = |node: u32| square(&std::array::from_fn(|k| at[node as usize][k] - stress[k]));
            let error = (nodes.iter().map(|&node| off(node)).sum::<f64>() / (3.0 * nodes.len() as f64)).sqrt();
            (centre, if size > 0.0 { error / size } else { 0.0 })
        };
        self.cells.iter().zip(&stresses).zip(self.centres()).map(of).collect()
    }
}

/// Something of the mean state of each element of a part.
fn of_cells<const N: usize>(system: &System<2>, part: usize, of: impl Fn(&dyn Block<2>, &ElementState) -> [f64; N]) -> Vec<[f64; N]> {
    let own = system.mesh.groups.iter().zip(&system.blocks).filter(|(group, _)| group.part == part).map(|(_, block)| &**block);
    own.flat_map(|block| (0..block.elements()).map(move |element| (block, element)))
        .map(|(block, element)| of(block, &block.state(element)))
        .collect()
}

/// σ:σ of a stress xx yy zz xy.
fn square([xx, yy, zz, xy]: &[f64; 4]) -> f64 {
    xx * xx + yy * yy + zz * zz + 2.0 * (xy * xy)
}
