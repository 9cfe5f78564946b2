//! What ties of surfaces bind in 3D: two facets, at the mean points of the parts of what they have in common.

use super::common::{Common, Facets, Frame};
use super::{Facing, PARTS, Segment};
use crate::contact::Scene;
use crate::contact::checked::Look;
use crate::contact::node_facet::groups::{bend, halves};
use crate::contact::projection::node_facet::unit;
use crate::contact::springs::{Answers, End, Slip, Spring, Springs, TangentSpace};
use crate::contact::tied::surfaces::{self, Bound, PairHold};
use crate::contact::tied::{Bindable, NEAR, PendingTies, Tie};
use crate::mesh::surface::Corners;
use crate::tensor::{Dim, cross, dot};
use crate::vector::minus;

type Vector = [f64; 3];
type Hold = PairHold<4>;

/// Half of each axis: of a spin that is the mean of two.
const HALVES: [Vector; 3] = [[0.5, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 0.5]];

impl Bindable<3> for Segment {
    type Hold = Hold;
    type Bound = Bound;
    const WORDS: [&'static str; 2] = ["facet", "its width"];

    fn bind(&self, pending: &mut PendingTies<3>, positions: &[Vector]) -> Vec<Tie<Hold>> {
        let lists = self.facets();
        let triangles: Vec<[u32; 3]> = lists[1].iter().flat_map(halves).collect();
        let width = |facet: &[u32; 4]| Frame::new(*facet, positions).area.sqrt();
        let widest = lists.iter().flat_map(|list| list.iter()).map(width).fold(0.0, f64::max);
        let reach = pending.thickness + 1.01 * NEAR * widest + bend(self.surface(1), positions);
        let pairs = surfaces::candidates(&mut *pending.search, positions, lists, (&triangles, 2), reach);
        let mut ties = Vec::new();
        pairs.into_iter().for_each(|pair| self.bind_pair(pair, pending.thickness, positions, &mut ties));
        ties
    }

    fn sides(&self, ties: &[Tie<Hold>]) -> [Vec<u32>; 2] {
        surfaces::sides(ties, self.facets())
    }

    fn bound(&self, ties: &[Tie<Hold>]) -> Bound {
        Bound::new(ties, self.facets().map(<[_]>::len))
    }

    fn is_there(&self, hold: &Hold, _: usize) -> bool {
        hold.is_within(self.facets().map(<[_]>::len))
    }

    fn again<'a>(&'a self, old: &'a Self) -> impl Fn(&Hold) -> Option<Hold> + 'a {
        surfaces::again(self.facets(), old.facets())
    }

    fn hold(&self, ties: &[Tie<Hold>], side: f32, positions: &[Vector], springs: &mut Springs<3>) {
        let Some(first) = ties.first() else { return };
        let frames = self.pairs.frames_at(first.hold.pair, positions);
        let normal = unit(minus(frames[1].normal, frames[0].normal));
        // Facets without area are reported with the elements; their ties do nothing.
        let is_flat = normal == [0.0; 3];
        let normal = if is_flat { [0.0, 0.0, 1.0] } else { normal };
        let tangents = Dim::<3>::tangents(normal, &[0.0; 3]);
        let (places, spins) = (frames.map(|frame| frame.corners), frames.map(|frame| frame.spins(HALVES)));
        for tie in ties {
            let apart = if is_flat { [0.0, 0.0, tie.gap] } else { tie.hold.apart(&places) };
            let by = [normal, tangents[0], tangents[1]].map(|along| cross(along, apart));
            let mut ends = [End::default(); 8];
            let mut count = 0;
            for (k, sign) in [(0, 1.0), (1, -1.0)] {
                let row = |by: Vector, i: usize| [0, 1, 2].map(|d| (0..3).map(|axis| by[axis] * spins[k][axis][i][d]).sum::<f64>());
                for (i, &node) in frames[k].nodes().iter().enumerate() {
                    let turn = [row(by[1], i), row(by[2], i)];
                    ends[count] = End { lean: row(by[0], i), turn, ..End::node(node, sign * tie.hold.shares[k][i]) };
                    count += 1;
                }
            }
            let gap = dot(normal, apart) - tie.gap;
            let slip = tangents.map(|t| dot(t, apart));
            springs.push(Spring { normal, gap, ..tie.spring(side) }, Slip::of(slip), &ends[..count]);
        }
    }

    fn detect_free(&mut self, bound: &Bound, scene: &Scene<'_, 3>, springs: &mut Springs<3>) {
        Self::detect_free(self, bound, scene, springs);
    }

    fn remember_free(&mut self, all: &Answers<'_, 3>, own: Answers<'_, 3>) {
        self.keep(&own);
        // What weighs forces has to see those of the ties.
        self.overlap_check.weigh(all);
    }

    fn take_over(&mut self, ties: &[Tie<Hold>], pressing: f64) -> f64 {
        let Some(first) = ties.first() else { return pressing };
        let (pair, lists) = (first.hold.pair, self.facets());
        let [a, b] = [0, 1].map(|k| lists[k][pair[k] as usize]);
        let area: f64 = ties.iter().map(|tie| tie.area).sum();
        let gap = ties.iter().map(|tie| tie.area * tie.gap).sum::<f64>() / area;
        let offset = gap - self.start.distance([a.corners(), b.corners()]);
        // Where they were apart at the start what presses has not met yet.
        if offset > 0.0 {
            return pressing;
        }
        let at = self.facing.partition_point(|facing| facing.pair < pair);
        self.facing.insert(at, Facing { pair, area, offsets: [offset; PARTS], stored: pressing, ..Facing::default() });
        0.0
    }
}

impl Segment {
    /// The facets of both surfaces.
    pub(super) fn facets(&self) -> [&[[u32; 4]]; 2] {
        [0, 1].map(|k| &self.surface(k).facets[..])
    }

    /// Adds the ties of a pair, if its common part is near.
    fn bind_pair(&self, pair: [u32; 2], thickness: f64, positions: &[Vector], ties: &mut Vec<Tie<Hold>>) {
        let frames = self.pairs.frames_at(pair, positions);
        let Some(common) = Common::new(&Facets::alone([&frames[0], &frames[1]]), false, 0.0, self.level) else { return };
        let areas = frames.map(|frame| frame.area);
        let mean = common.parts().iter().map(|part| part.area * part.gap).sum::<f64>() / common.area;
        if !(mean.abs() <= thickness + NEAR * areas[0].max(areas[1]).sqrt()) {
            return;
        }
        let pressure = self.pressure(pair);
        for part in common.parts() {
            let hold = Hold { pair, shares: part.shares, parts: areas.map(|area| part.area / area) };
            ties.push(Tie { hold, gap: part.gap, stiffness: pressure * part.area, area: part.area });
        }
    }
}
