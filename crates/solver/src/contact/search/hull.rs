//! What a facet is held in while it moves, and what a node is held in: the filter that `boxes` and `grid`
//! share.
//!
//! A facet is held in a box that lies along it (in 3D: along the axes), a node's path in a ball around its
//! middle. Where surfaces lie layer on layer, a box along the axes around a slanted facet reaches through
//! several of them; one along the facet doesn't. The expressions are written once, for one facet and one
//! node, for eight facets and for eight nodes, so that all give the same pairs to the bit.

use super::Query;
use super::extent::{Extent, Margin, larger, smaller};
use embate_lanes::{BATCH, Batch, Lane};

/// The box of a facet, in its own directions: in 2D along the facet and along its normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hull<L, const D: usize> {
    /// Of length 1, up to rounding. Without meaning in 3D.
    normal: [L; D],
    /// Middle of the box in its own directions, m.
    middle: [L; D],
    /// Half its edges with all margins, m; minus infinity for a facet that is nowhere.
    half: [L; D],
}

/// What holds the path of a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Path<L, const D: usize> {
    /// Middle of the path, m.
    pub(super) middle: [L; D],
    /// Half its length or more, m; minus infinity for a node that is nowhere.
    pub(super) radius: L,
}

/// Lengths of which the square is far from overflow and underflow, m.
const LENGTHS: [f64; 2] = [1e-140, 1e140];
/// Coordinates of which sums and products are far from overflow, m.
const LARGEST: f64 = 1e300;
/// Room for the rounding of a few sums and products, over the size of what is added: each rounds by ε/2.
const ROUNDING: f64 = 32.0 * f64::EPSILON;
/// Ball of a path over what it takes in the directions of another box: √2, rounded up.
const TURNED: f64 = 1.414_22;

/// A point in the directions of a box.
#[inline(always)]
fn along<L: Lane, const D: usize>(normal: &[L; D], x: &[L; D]) -> [L; D] {
    let mut own = *x;
    if D == 2 {
        own[0] = normal[1] * x[0] - normal[0] * x[1];
        own[1] = normal[0] * x[0] + normal[1] * x[1];
    }
    own
}

/// The normal of a box along the axes.
#[inline(always)]
fn upright<L: Lane, const D: usize>() -> [L; D] {
    let mut normal = [L::splat(0.0); D];
    normal[D - 1] = L::splat(1.0);
    normal
}

/// Length 1; upright where the vector is too short or too long for that.
#[inline(always)]
fn normalized<L: Lane, const D: usize>(v: [L; D]) -> [L; D] {
    let mut square = L::splat(0.0);
    for x in v {
        square += x * x;
    }
    let length = square.sqrt();
    let extreme = L::either(length.less(L::splat(LENGTHS[0])), L::splat(LENGTHS[1]).less(length));
    let inverse = L::splat(1.0) / length;
    let mut unit = upright();
    for d in 0..D {
        unit[d] = L::select(extreme, unit[d], v[d] * inverse);
    }
    unit
}

impl<L: Lane, const D: usize> Hull<L, D> {
    /// Of a facet with these nodes; nowhere when a coordinate is not finite.
    ///
    /// Every point of the facet at every time is a convex combination of its old and new nodes, so a box that
    /// holds these holds it. It grows by the reach, and by what sums and products round.
    #[inline(always)]
    fn of_facet(old: &[[L; D]; D], new: &[[L; D]; D], margin: Margin) -> Self {
        let mut normal = [L::splat(0.0); D];
        if D == 2 {
            normal[0] = new[0][1] - new[1][1];
            normal[1] = new[1][0] - new[0][0];
        }
        let normal = normalized(normal);
        let (mut low, mut high) = ([L::splat(f64::INFINITY); D], [L::splat(f64::NEG_INFINITY); D]);
        let (mut finite, mut size) = (L::splat(0.0), [L::splat(0.0); D]);
        for nodes in [old, new] {
            for x in nodes {
                let own = along(&normal, x);
                for d in 0..D {
                    low[d] = own[d].min(low[d]);
                    high[d] = own[d].max(high[d]);
                    // Times zero: 0 for a finite number, NaN for any other.
                    finite += x[d] * L::splat(0.0);
                    size[d] = x[d].abs().max(size[d]);
                }
            }
        }
        let reach = margin.around(L::splat(0.0));
        let mut scale = reach;
        for x in size {
            scale += x;
        }
        let room = reach + scale * L::splat(ROUNDING) + L::splat(f64::MIN_POSITIVE);
        let (finite, bounded) = (finite.less(L::splat(1.0)), scale.less(L::splat(LARGEST)));
        let mut hull = Self { normal: upright(), middle: [L::splat(0.0); D], half: [L::splat(f64::MAX); D] };
        for d in 0..D {
            // One that is nowhere has no number that is not finite but its size, and adds nothing to a mean
            // normal.
            hull.normal[d] = L::select(finite, L::select(bounded, normal[d], hull.normal[d]), L::splat(0.0));
            let middle = L::select(bounded, L::splat(0.5) * (low[d] + high[d]), hull.middle[d]);
            hull.middle[d] = L::select(finite, middle, L::splat(0.0));
            let half = L::select(bounded, L::splat(0.5) * (high[d] - low[d]) + room, hull.half[d]);
            hull.half[d] = L::select(finite, half, L::splat(f64::NEG_INFINITY));
        }
        hull
    }

    /// Where a path misses it.
    #[inline(always)]
    fn misses(&self, path: &Path<L, D>) -> L::Mask {
        let own = along(&self.normal, &path.middle);
        let mut apart = (own[0] - self.middle[0]).abs() - self.half[0];
        for d in 1..D {
            apart = apart.max((own[d] - self.middle[d]).abs() - self.half[d]);
        }
        path.radius.less(apart)
    }

    /// The box that holds it, in the directions of another normal: least and largest coordinates. Empty for
    /// one that is nowhere.
    #[inline(always)]
    fn seen_along(&self, normal: &[L; D]) -> ([L; D], [L; D]) {
        let (mut middle, mut half) = (self.middle, self.half);
        if D == 2 {
            let cos = normal[0] * self.normal[0] + normal[1] * self.normal[1];
            let sin = normal[1] * self.normal[0] - normal[0] * self.normal[1];
            middle[0] = cos * self.middle[0] + sin * self.middle[1];
            middle[1] = cos * self.middle[1] - sin * self.middle[0];
            half[0] = cos.abs() * self.half[0] + sin.abs() * self.half[1];
            half[1] = cos.abs() * self.half[1] + sin.abs() * self.half[0];
        }
        let mut scale = L::splat(0.0);
        for d in 0..D {
            scale += self.middle[d].abs() + self.half[d];
        }
        let room = scale * L::splat(2.0 * ROUNDING);
        let nowhere = self.half[0].less(L::splat(0.0));
        let (mut low, mut high) = (middle, middle);
        for d in 0..D {
            low[d] = L::select(nowhere, L::splat(f64::INFINITY), middle[d] - half[d] - room);
            high[d] = L::select(nowhere, L::splat(f64::NEG_INFINITY), middle[d] + half[d] + room);
        }
        (low, high)
    }
}

impl<const D: usize> Hull<f64, D> {
    /// Of a facet of a query; `None` when a coordinate is not finite.
    pub(super) fn of(query: &Query<'_, D>, facet: &[u32; D], margin: Margin) -> Option<Self> {
        let hull = Self::of_facet(&facet.map(|n| query.positions_old[n as usize]), &facet.map(|n| query.positions_new[n as usize]), margin);
        (hull.half[0] >= 0.0).then_some(hull)
    }

    /// Whether it meets a path.
    pub(super) fn meets(&self, path: &Path<f64, D>) -> bool {
        !self.misses(path)
    }
}

impl<L: Lane, const D: usize> Path<L, D> {
    /// From one position to another; nowhere when a coordinate is not finite.
    #[inline(always)]
    fn between(old: &[L; D], new: &[L; D]) -> Self {
        let (zero, half) = (L::splat(0.0), L::splat(0.5));
        let mut path = Self { middle: [zero; D], radius: zero };
        let mut finite = zero;
        for d in 0..D {
            let (from, to) = (half * old[d], half * new[d]);
            path.middle[d] = from + to;
            path.radius += (to - from).abs();
            finite += (from + to) * zero;
        }
        // With room for what these sums and those in `misses` round.
        path.radius = path.radius * L::splat(1.0 + ROUNDING) + L::splat(f64::MIN_POSITIVE);
        let finite = finite.less(L::splat(1.0));
        path.radius = L::select(finite, path.radius, L::splat(f64::NEG_INFINITY));
        for middle in &mut path.middle {
            *middle = L::select(finite, *middle, zero);
        }
        path
    }

    /// What it takes in any directions; empty when it is nowhere.
    #[inline(always)]
    fn extent(&self) -> ([L; D], [L; D]) {
        let (mut low, mut high) = (self.middle, self.middle);
        for d in 0..D {
            let room = L::splat(TURNED) * self.radius + self.middle[d].abs() * L::splat(ROUNDING);
            low[d] = self.middle[d] - room;
            high[d] = self.middle[d] + room;
        }
        (low, high)
    }
}

impl<const D: usize> Path<f64, D> {
    /// Of a node of a query.
    pub(super) fn of(query: &Query<'_, D>, node: u32) -> Self {
        Self::between(&query.positions_old[node as usize], &query.positions_new[node as usize])
    }
}

/// Hulls of eight facets side by side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hulls<const D: usize>(Hull<Batch, D>);

/// Boxes of eight facets or nodes along the axes.
pub(super) struct Upright<const D: usize> {
    low: [Batch; D],
    high: [Batch; D],
}

impl<const D: usize> Upright<D> {
    const NONE: Self = Self { low: [Batch::splat(0.0); D], high: [Batch::splat(0.0); D] };

    #[inline(always)]
    fn set<L: Lane>(&mut self, at: usize, (low, high): ([L; D], [L; D])) {
        for d in 0..D {
            low[d].store(&mut self.low[d], at);
            high[d].store(&mut self.high[d], at);
        }
    }

    #[inline(always)]
    pub(super) fn at(&self, at: usize) -> Extent<D> {
        let mut extent = Extent::NONE;
        for d in 0..D {
            extent.low[d] = self.low[d].0[at];
            extent.high[d] = self.high[d].0[at];
        }
        extent
    }

    /// The box of all.
    #[inline(always)]
    pub(super) fn all(&self) -> Extent<D> {
        let mut extent = Extent::NONE;
        for d in 0..D {
            extent.low[d] = least(&self.low[d], 0, BATCH);
            extent.high[d] = most(&self.high[d], 0, BATCH);
        }
        extent
    }

    /// The sum of their longest edges; not finite unless all are there.
    #[inline(always)]
    pub(super) fn sizes<L: Lane>(&self) -> f64 {
        let mut sizes = Batch::splat(0.0);
        for at in (0..BATCH).step_by(L::WIDTH) {
            let mut size = L::load(&self.high[0], at) - L::load(&self.low[0], at);
            for d in 1..D {
                size = size.max(L::load(&self.high[d], at) - L::load(&self.low[d], at));
            }
            size.store(&mut sizes, at);
        }
        sum(&sizes)
    }
}

/// The sum of eight numbers.
#[inline(always)]
fn sum(all: &Batch) -> f64 {
    let x = &all.0;
    ((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7]))
}

impl<const D: usize> Hulls<D> {
    /// Eight without meaning.
    pub(super) const NONE: Self =
        Self(Hull { normal: [Batch::splat(0.0); D], middle: [Batch::splat(0.0); D], half: [Batch::splat(0.0); D] });

    /// Takes in eight facets: the positions of their nodes, old and new, NaN where there is no facet. Returns
    /// their boxes along the axes.
    #[inline(always)]
    pub(super) fn set<L: Lane>(&mut self, old: &[[Batch; D]; D], new: &[[Batch; D]; D], margin: Margin) -> Upright<D> {
        let mut boxes = Upright::NONE;
        let zero = [[L::splat(0.0); D]; D];
        for at in (0..BATCH).step_by(L::WIDTH) {
            let mut x = [zero, zero];
            for node in 0..D {
                for d in 0..D {
                    x[0][node][d] = L::load(&old[node][d], at);
                    x[1][node][d] = L::load(&new[node][d], at);
                }
            }
            let hull = Hull::of_facet(&x[0], &x[1], margin);
            boxes.set(at, hull.seen_along(&upright()));
            for d in 0..D {
                hull.normal[d].store(&mut self.0.normal[d], at);
                hull.middle[d].store(&mut self.0.middle[d], at);
                hull.half[d].store(&mut self.0.half[d], at);
            }
        }
        boxes
    }

    #[inline(always)]
    fn load<L: Lane>(&self, at: usize) -> Hull<L, D> {
        let none = [L::splat(0.0); D];
        let mut hull = Hull { normal: none, middle: none, half: none };
        for d in 0..D {
            hull.normal[d] = L::load(&self.0.normal[d], at);
            hull.middle[d] = L::load(&self.0.middle[d], at);
            hull.half[d] = L::load(&self.0.half[d], at);
        }
        hull
    }

    /// Which of them meet a path: bit i for the i-th.
    #[inline(always)]
    pub(super) fn meet<L: Lane>(&self, path: &Path<f64, D>) -> u32 {
        let mut all = Path { middle: [L::splat(0.0); D], radius: L::splat(path.radius) };
        for d in 0..D {
            all.middle[d] = L::splat(path.middle[d]);
        }
        let mut missed = 0;
        for at in (0..BATCH).step_by(L::WIDTH) {
            missed |= L::bits(self.load::<L>(at).misses(&all)) << at;
        }
        !missed & 0xff
    }

    /// The box, in the mean directions of the facets `begin..end` of the eight, that holds their boxes;
    /// `extent` holds them along the axes.
    #[inline(always)]
    pub(super) fn around<L: Lane>(&self, begin: usize, end: usize, extent: &Extent<D>) -> Hull<f64, D> {
        let everything = Hull { normal: upright(), middle: [0.0; D], half: [f64::MAX; D] };
        let mut scale = 0.0;
        for d in 0..D {
            scale += larger(extent.low[d].abs(), extent.high[d].abs());
        }
        if !(scale < LARGEST) {
            return everything;
        }
        let mut normal = [0.0; D];
        for d in 0..D {
            let all = &self.0.normal[d];
            normal[d] = if end - begin == BATCH { sum(all) } else { all.0[begin..end].iter().sum() };
        }
        let normal = normalized(normal);
        let mut turned = [L::splat(0.0); D];
        for d in 0..D {
            turned[d] = L::splat(normal[d]);
        }
        let (mut low, mut high) = ([Batch::splat(0.0); D], [Batch::splat(0.0); D]);
        for at in (0..BATCH).step_by(L::WIDTH) {
            let seen = self.load::<L>(at).seen_along(&turned);
            for d in 0..D {
                seen.0[d].store(&mut low[d], at);
                seen.1[d].store(&mut high[d], at);
            }
        }
        let mut hull = Hull { normal, ..everything };
        for d in 0..D {
            let (low, high) = (least(&low[d], begin, end), most(&high[d], begin, end));
            hull.middle[d] = 0.5 * (low + high);
            hull.half[d] = 0.5 * (high - low) + scale * ROUNDING;
        }
        hull
    }
}

/// The least of some of eight numbers.
#[inline(always)]
fn least(all: &Batch, begin: usize, end: usize) -> f64 {
    let x = &all.0;
    if end - begin == BATCH {
        let half = [smaller(x[0], x[4]), smaller(x[1], x[5]), smaller(x[2], x[6]), smaller(x[3], x[7])];
        return smaller(smaller(half[0], half[2]), smaller(half[1], half[3]));
    }
    let mut least = f64::INFINITY;
    for &x in &x[begin..end] {
        least = smaller(x, least);
    }
    least
}

/// The largest of some of eight numbers.
#[inline(always)]
fn most(all: &Batch, begin: usize, end: usize) -> f64 {
    let mut all = *all;
    for x in &mut all.0 {
        *x = -*x;
    }
    -least(&all, begin, end)
}

/// Paths of eight nodes side by side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Paths<const D: usize>(Path<Batch, D>);

impl<const D: usize> Paths<D> {
    /// Eight that are nowhere.
    pub(super) const NONE: Self = Self(Path { middle: [Batch::splat(0.0); D], radius: Batch::splat(f64::NEG_INFINITY) });

    /// From eight positions to eight others. NaN where there is no node.
    #[inline(always)]
    pub(super) fn between<L: Lane>(old: &[Batch; D], new: &[Batch; D]) -> (Self, Upright<D>) {
        let (mut paths, mut boxes) = (Self::NONE, Upright::NONE);
        let none = [L::splat(0.0); D];
        for at in (0..BATCH).step_by(L::WIDTH) {
            let (mut from, mut to) = (none, none);
            for d in 0..D {
                from[d] = L::load(&old[d], at);
                to[d] = L::load(&new[d], at);
            }
            let path = Path::between(&from, &to);
            for d in 0..D {
                path.middle[d].store(&mut paths.0.middle[d], at);
            }
            path.radius.store(&mut paths.0.radius, at);
            boxes.set(at, path.extent());
        }
        (paths, boxes)
    }

    #[inline(always)]
    pub(super) fn at(&self, at: usize) -> Path<f64, D> {
        let mut path = Path { middle: [0.0; D], radius: 0.0 };
        for d in 0..D {
            path.middle[d] = self.0.middle[d].0[at % BATCH];
        }
        path.radius = self.0.radius.0[at % BATCH];
        path
    }

    /// Which of them may meet a facet of a group: bit i for the i-th.
    ///
    /// A path that meets a facet's box lies, with its radius on every side in the facet's directions, in the
    /// group's: turned by any angle this takes up to √2 of it.
    #[inline(always)]
    pub(super) fn may_meet<L: Lane>(&self, group: &Hull<f64, D>) -> u32 {
        let none = [L::splat(0.0); D];
        let mut hull = Hull { normal: none, middle: none, half: none };
        for d in 0..D {
            hull.normal[d] = L::splat(group.normal[d]);
            hull.middle[d] = L::splat(group.middle[d]);
            hull.half[d] = L::splat(group.half[d]);
        }
        let mut missed = 0;
        for at in (0..BATCH).step_by(L::WIDTH) {
            let mut path = Path { middle: none, radius: L::load(&self.0.radius, at) * L::splat(TURNED) };
            for d in 0..D {
                path.middle[d] = L::load(&self.0.middle[d], at);
            }
            missed |= L::bits(hull.misses(&path)) << at;
        }
        !missed & 0xff
    }
}
