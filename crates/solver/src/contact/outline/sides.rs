//! Segments of bodies with how thick these are behind them, for what meets them one by one.

use super::{Outlines, Side};
use crate::contact::Vector;
use crate::contact::obstacle::behind::{See, Thick};
use crate::rows::Rows;

/// The segments of some bodies.
#[derive(Debug, Default)]
pub struct Sides {
    sides: Vec<Side>,
    /// Segments at each node.
    around: Rows<u32>,
    places: Vec<Vector>,
}

impl Sides {
    /// The segments of the bodies that count.
    #[must_use]
    pub fn new(outlines: &Outlines, counts: impl Fn(u32) -> bool, positions: &[Vector]) -> Self {
        let bodies = outlines.bodies.iter().filter(|outline| counts(outline.body));
        let sides: Vec<Side> = bodies.flat_map(|outline| &outline.sides).filter(|side| !side.is_mirror).copied().collect();
        let ends = sides.iter().zip(0..).flat_map(|(side, number)| side.segment.map(|node| (node, number)));
        let around = Rows::new(positions.len(), ends.collect::<Vec<_>>().into_iter());
        Self { sides, around, places: positions.to_vec() }
    }

    fn thickness(&self, side: &Side) -> f64 {
        side.opposite.now(side.segment, &self.places)
    }
}

impl Thick<2> for Sides {
    fn place(&mut self, positions: &[Vector]) {
        let count = self.places.len();
        self.places.copy_from_slice(&positions[..count]);
    }

    fn at(&self, node: u32) -> f64 {
        self.around.of(node as usize).iter().map(|&side| self.thickness(&self.sides[side as usize])).fold(f64::INFINITY, f64::min)
    }

    fn least(&self) -> f64 {
        self.sides.iter().map(|side| self.thickness(side)).fold(f64::INFINITY, f64::min)
    }

    fn facets(&self, see: See<'_, 2>) {
        for side in &self.sides {
            see(&side.segment.map(|node| self.places[node as usize]), self.thickness(side), side.segment[0]);
        }
    }
}
