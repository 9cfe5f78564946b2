//! Nodes that slide along the lines of an outline, each between its two neighbours there.

use super::outline::Line;
use crate::plane::{Point, distance, minus};

/// Where the nodes of an outline are along its lines.
pub(crate) struct Rails<'a> {
    lines: &'a [Line],
    /// Places of the nodes of each line, ascending, one for each of its points. Where a line is closed and
    /// without a fixed point, the first may become negative.
    pub(crate) places: Vec<Vec<f64>>,
    /// Of each node of the mesh its line and its number there, if it slides.
    of: Vec<Option<[u32; 2]>>,
}

impl<'a> Rails<'a> {
    /// No node slides.
    pub(crate) fn none() -> Self {
        Self { lines: &[], places: Vec::new(), of: Vec::new() }
    }

    /// All nodes of lines but the ends of chains slide; they are at the lines' points. `loops` has the
    /// numbers of the nodes of each line by its segments, `nodes` is how many the mesh has.
    pub(crate) fn new(lines: &'a [Line], loops: &[Vec<u32>], nodes: usize) -> Self {
        let mut of = vec![None; nodes];
        for ((line, numbers), l) in lines.iter().zip(loops).zip(0_u32..) {
            for (&segment, k) in line.segments.iter().zip(0_u32..) {
                of[numbers[segment as usize] as usize] = Some([l, k]);
            }
            for chain in line.chains.iter().filter(|chain| !chain.is_closed) {
                of[numbers[line.segments[chain.points[0]] as usize] as usize] = None;
            }
        }
        let places = lines.iter().map(|line| line.arc[..line.points.len()].to_vec()).collect();
        Self { lines, places, of }
    }

    fn rail(&self, node: usize) -> Option<[usize; 2]> {
        self.of.get(node).copied().flatten().map(|rail| rail.map(|k| k as usize))
    }

    /// Whether a node slides.
    pub(crate) fn has(&self, node: usize) -> bool {
        self.rail(node).is_some()
    }

    /// The direction of its line where a node is that slides: at a point of the line the mean of both sides.
    pub(super) fn direction(&self, node: usize) -> Option<Point> {
        let [l, k] = self.rail(node)?;
        let line = &self.lines[l];
        let n = line.points.len();
        let (segment, fraction) = line.segment(self.places[l][k]);
        let unit = |k: usize| {
            let (a, b) = (line.points[k % n], line.points[(k + 1) % n]);
            minus(b, a).map(|x| x / distance(a, b))
        };
        let on = unit(segment);
        let back = if fraction == 0.0 { unit(segment + n - 1) } else { on };
        Some([0.5 * (back[0] + on[0]), 0.5 * (back[1] + on[1])])
    }

    /// Where a node comes to from `from` by a way, of which a node that slides goes the first component along
    /// its line; `None` where it has a second one, or would pass a neighbour.
    pub(super) fn near(&self, node: usize, from: Point, way: Point) -> Option<Point> {
        let Some([l, k]) = self.rail(node) else { return Some([from[0] + way[0], from[1] + way[1]]) };
        let (line, places) = (&self.lines[l], &self.places[l]);
        let n = places.len();
        let whole = line.arc[n];
        let before = if k == 0 { places[n - 1] - whole } else { places[k - 1] };
        let after = if k + 1 == n { places[0] + whole } else { places[k + 1] };
        let place = places[k] + way[0];
        (way[1] == 0.0 && before < place && place < after).then(|| line.at(place).0)
    }

    /// Moves the place of a node that slides.
    pub(super) fn slide(&mut self, node: usize, by: f64) {
        if let Some([l, k]) = self.rail(node) {
            self.places[l][k] += by;
        }
    }
}
