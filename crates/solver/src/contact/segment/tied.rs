//! What ties of surfaces bind in 2D: two segments, at the integration points of their common part.

use super::common::{Common, half_angle, normal};
use super::{Facing, Segment, space};
use crate::contact::formulation::{FormulationKind, both_passes};
use crate::contact::springs::{End, Slip, Spring, Springs, tangent};
use crate::contact::tied::surfaces::{self, Bound, PairHold};
use crate::contact::tied::{Bindable, NEAR, PendingTies, Tie, Tied};
use crate::contact::{Scene, Vector, length};
use crate::vector::dot;

/// What segments and facets have that are tied.
pub(super) const SURFACES: FormulationKind = FormulationKind {
    name: "tied",
    doc: "segments or facets bound over their common part until the traction exceeds a strength, then ordinary contact",
    source: "weights as in Puso (2004), held by two-way springs on gap and slip",
    passes: both_passes,
    tied: None,
    is_carried: false,
    in_2d: Some(|setup| {
        let (pending, at_start) = PendingTies::of(&setup);
        Ok(Box::new(Tied::new(pending, Segment::of(setup), at_start)?))
    }),
    in_3d: Some(|setup| {
        let (pending, at_start) = PendingTies::of(&setup);
        Ok(Box::new(Tied::new(pending, space::Segment::of(setup), at_start)?))
    }),
};

type Hold = PairHold<2>;

impl Bindable<2> for Segment {
    type Hold = Hold;
    type Bound = Bound;
    const WORDS: [&'static str; 2] = ["segment", "its length"];

    fn bind(&self, pending: &mut PendingTies<2>, positions: &[Vector]) -> Vec<Tie<Hold>> {
        let lists = self.segments();
        let longest = lists.iter().flat_map(|list| list.iter()).map(|&segment| length(segment, positions)).fold(0.0, f64::max);
        let reach = pending.thickness + 1.01 * NEAR * longest;
        let pairs = surfaces::candidates(&mut *pending.search, positions, lists, (lists[1], 1), reach);
        let mut ties = Vec::new();
        pairs.into_iter().for_each(|pair| self.bind_pair(pair, pending.thickness, positions, &mut ties));
        ties
    }

    fn sides(&self, ties: &[Tie<Hold>]) -> [Vec<u32>; 2] {
        surfaces::sides(ties, self.segments())
    }

    fn bound(&self, ties: &[Tie<Hold>]) -> Bound {
        Bound::new(ties, self.counts())
    }

    fn is_there(&self, hold: &Hold, _: usize) -> bool {
        hold.is_within(self.counts())
    }

    fn again<'a>(&'a self, old: &'a Self) -> impl Fn(&Hold) -> Option<Hold> + 'a {
        surfaces::again(self.segments(), old.segments())
    }

    fn hold(&self, ties: &[Tie<Hold>], side: f32, positions: &[Vector], springs: &mut Springs<2>) {
        for tie in ties {
            let nodes = self.nodes(tie.hold.pair);
            let places = nodes.map(|nodes| nodes.map(|node| positions[node as usize]));
            // Segments without length are reported with the elements; the tie does nothing.
            let known = normal(places);
            let (normal, apart) = known.map_or(([0.0, 1.0], [0.0, tie.gap]), |normal| (normal, tie.hold.apart(&places)));
            let (gap, slip) = (dot(normal, apart), dot(tangent(normal), apart));
            let end = |k: usize, i: usize| {
                let share = if k == 0 { tie.hold.shares[k][i] } else { -tie.hold.shares[k][i] };
                let half = if known.is_some() { half_angle(places[k], i) } else { [0.0; 2] };
                End { lean: half.map(|half| -slip * half), turn: [half.map(|half| gap * half)], ..End::node(nodes[k][i], share) }
            };
            let spring = Spring { normal, gap: gap - tie.gap, ..tie.spring(side) };
            springs.push(spring, Slip::of([slip]), &[end(0, 0), end(0, 1), end(1, 0), end(1, 1)]);
        }
    }

    fn detect_free(&mut self, bound: &Bound, scene: &Scene<'_, 2>, springs: &mut Springs<2>) {
        Self::detect_free(self, bound, scene, springs);
    }

    fn take_over(&mut self, ties: &[Tie<Hold>], pressing: f64) -> f64 {
        let Some(first) = ties.first() else { return pressing };
        let (pair, nodes) = (first.hold.pair, self.nodes(first.hold.pair));
        let offset = ties.iter().map(|tie| tie.gap).sum::<f64>() / ties.len() as f64 - self.start.distance([&nodes[0], &nodes[1]]);
        // Where they were apart at the start what presses has not met yet.
        if offset > 0.0 {
            return pressing;
        }
        let at = self.facing.partition_point(|facing| facing.pair < pair);
        self.facing.insert(at, Facing { pair, offsets: [offset; 2], stored: pressing, ..Facing::default() });
        0.0
    }
}

impl Segment {
    /// The segments of both surfaces.
    pub(super) fn segments(&self) -> [&[[u32; 2]]; 2] {
        self.surfaces().map(|surface| &self.tracker.targets()[surface].surface.segments[..])
    }

    fn counts(&self) -> [usize; 2] {
        self.segments().map(<[_]>::len)
    }

    /// Adds the ties of a pair, if its common part is near.
    fn bind_pair(&self, pair: [u32; 2], thickness: f64, positions: &[Vector], ties: &mut Vec<Tie<Hold>>) {
        let nodes = self.nodes(pair);
        let Some(common) = Common::new(nodes, positions) else { return };
        let lengths = nodes.map(|nodes| length(nodes, positions));
        let mean: f64 = self.rule.iter().map(|&[place, weight]| weight * common.point(place).0).sum();
        if !(mean.abs() <= thickness + NEAR * lengths[0].max(lengths[1])) {
            return;
        }
        let pressure = self.pressure(pair);
        for &[place, weight] in self.rule {
            let (gap, [a, b, c, d]) = common.point(place);
            let shares = [[a.share, b.share], [-c.share, -d.share]];
            let parts = lengths.map(|length| weight * common.length / length);
            let area = weight * common.area * self.depth.at(common.middle(place).map(|x| x.max(0.0)));
            ties.push(Tie { hold: Hold { pair, shares, parts }, gap, stiffness: pressure * area, area });
        }
    }
}
