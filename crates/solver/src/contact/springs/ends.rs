//! Ends of springs as they are kept: all have a share, and what not all have lies apart: turns (only with
//! friction), and what few have. Springs are more than caches hold, so their size is their cost.

use super::{End, Slid, Solved, Spring};
use crate::contact::springs::TangentSpace;
use crate::rigid::Bodies;
use crate::tensor::Dim;

/// No more.
const NONE: u32 = u32::MAX;

/// The ends of all springs, one after the other. Those of a step replace those of the step before, so that it
/// is known whether they are the same.
#[derive(Default)]
pub(super) struct Ends<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    list: Replacing<PackedEnd>,
    /// Where the ends of each spring end.
    closed: Replacing<u32>,
    /// As far as any end has one.
    turns: Vec<<Dim<D> as TangentSpace<D>>::Tangents>,
    more: Vec<More<D>>,
}

/// Entries that replace those of the step before one by one.
struct Replacing<T> {
    /// Beyond the first `count` those of the step before.
    entries: Vec<T>,
    count: usize,
    /// Whether any is not as it was.
    differs: bool,
}

impl<T> Default for Replacing<T> {
    fn default() -> Self {
        Self { entries: Vec::new(), count: 0, differs: false }
    }
}

impl<T> Replacing<T> {
    /// Begins a step.
    fn clear(&mut self) {
        self.entries.truncate(self.count);
        (self.count, self.differs) = (0, false);
    }

    fn is_as_before(&self) -> bool {
        !self.differs && self.entries.len() == self.count
    }

    /// Adds an entry, of which is said whether it is the same as another one.
    #[inline]
    fn push(&mut self, entry: T, is_same: impl Fn(&T, &T) -> bool) {
        match self.entries.get_mut(self.count) {
            Some(before) => {
                self.differs |= !is_same(before, &entry);
                *before = entry;
            }
            None => {
                self.differs = true;
                self.entries.push(entry);
            }
        }
        self.count += 1;
    }
}

/// What every end has.
#[derive(Clone, Copy)]
struct PackedEnd {
    at: u32,
    /// Number of what it has beyond, or [`NONE`].
    more: u32,
    share: f64,
}

/// An end of a spring as it is kept: what few have is not copied for all.
#[derive(Clone, Copy)]
pub struct KeptEnd<'a, const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// Node, or number of nodes + rigid body.
    pub at: u32,
    /// Share in the gap.
    pub share: f64,
    turn: Option<&'a <Dim<D> as TangentSpace<D>>::Tangents>,
    more: Option<&'a More<D>>,
}

/// What few ends have.
#[derive(Clone, Copy, PartialEq)]
struct More<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    lean: [f64; D],
    point: [f64; D],
    image: Option<<Dim<D> as TangentSpace<D>>::ImageRotation>,
}

impl<const D: usize> Default for More<D>
where
    Dim<D>: TangentSpace<D>,
{
    fn default() -> Self {
        Self { lean: [0.0; D], point: [0.0; D], image: None }
    }
}

impl<const D: usize> Ends<D>
where
    Dim<D>: TangentSpace<D>,
{
    /// Begins a step.
    pub(super) fn clear(&mut self) {
        self.list.clear();
        self.closed.clear();
        self.turns.clear();
        self.more.clear();
    }

    pub(super) fn len(&self) -> usize {
        self.list.count
    }

    /// Whether springs have the same nodes and bodies at their ends as in the step before.
    pub(super) fn are_as_before(&self) -> bool {
        self.list.is_as_before() && self.closed.is_as_before()
    }

    /// Ends a spring: number of its first end, and how many it has.
    #[inline]
    pub(super) fn close(&mut self) -> [u32; 2] {
        let first = if self.closed.count == 0 { 0 } else { self.closed.entries[self.closed.count - 1] };
        let end = self.list.count as u32;
        self.closed.push(end, u32::eq);
        [first, end - first]
    }

    #[inline]
    fn add(&mut self, end: PackedEnd) {
        self.list.push(end, |before, now| before.at == now.at);
    }

    #[inline]
    pub(super) fn push(&mut self, end: &End<D>) {
        let End { at, share, lean, turn, point, image } = *end;
        let more = More { lean, point, image };
        let number = if more == More::default() { NONE } else { self.more.len() as u32 };
        if number != NONE {
            self.more.push(more);
        }
        if turn != Default::default() {
            self.turns.resize(self.list.count, Default::default());
            self.turns.push(turn);
        }
        self.add(PackedEnd { at, more: number, share });
    }

    /// Nodes with shares in the gap, and nothing else.
    #[inline]
    pub(super) fn extend(&mut self, shares: impl Iterator<Item = (u32, f64)>) {
        shares.for_each(|(at, share)| self.add(PackedEnd { at, more: NONE, share }));
    }

    #[inline]
    pub(super) fn get(&self, k: usize) -> KeptEnd<'_, D> {
        let PackedEnd { at, more, share } = self.list.entries[k];
        KeptEnd { at, share, turn: self.turns.get(k), more: self.more.get(more as usize) }
    }

    /// Share of an end in the gap; `None`: it has more than that and what is along the surface.
    #[inline]
    pub(super) fn share_alone(&self, k: usize) -> Option<f64> {
        let PackedEnd { more, share, .. } = self.list.entries[k];
        (more == NONE).then_some(share)
    }

    /// Node or rigid body of an end.
    #[inline]
    pub(super) fn at(&self, k: usize) -> u32 {
        self.list.entries[k].at
    }

    /// Lets the end act at a place, m.
    pub(super) fn set_point(&mut self, k: usize, point: [f64; D]) {
        self.more_of(k).point = point;
    }

    /// Lets another node move in the stead of the end's, turned so.
    pub(super) fn set_image(&mut self, k: usize, image: <Dim<D> as TangentSpace<D>>::ImageRotation) {
        self.more_of(k).image = Some(image);
    }

    fn more_of(&mut self, k: usize) -> &mut More<D> {
        let number = &mut self.list.entries[k].more;
        if *number == NONE {
            *number = self.more.len() as u32;
            self.more.push(More::default());
        }
        &mut self.more[*number as usize]
    }
}

impl<'a, const D: usize> KeptEnd<'a, D>
where
    Dim<D>: TangentSpace<D>,
{
    /// The same by itself.
    pub(super) fn whole(&self) -> End<D> {
        let Self { at, share, turn, .. } = *self;
        End { at, share, lean: self.lean(), turn: turn.copied().unwrap_or_default(), point: self.point(), image: self.image().copied() }
    }

    /// What the gap's rate has beyond the share.
    #[must_use]
    #[inline]
    pub fn lean(&self) -> [f64; D] {
        self.more.map_or([0.0; D], |more| more.lean)
    }

    /// Where the forces act on a rigid body without nodes, m.
    #[must_use]
    #[inline]
    pub fn point(&self) -> [f64; D] {
        self.more.map_or([0.0; D], |more| more.point)
    }

    /// Rotation from the motion of the node that moves instead of it.
    #[inline]
    pub(super) fn image(&self) -> Option<&'a <Dim<D> as TangentSpace<D>>::ImageRotation> {
        self.more?.image.as_ref()
    }

    /// Force of a solved spring on this end where there is no friction, N/m.
    #[inline]
    pub(super) fn push(&self, spring: &Spring<D>, solved: &Solved) -> [f64; D] {
        self.gap_row(spring.normal).map(|row| row * solved.force)
    }

    /// The same with friction along the spring's `tangents`.
    #[inline]
    pub(super) fn drag(
        &self,
        spring: &Spring<D>,
        tangents: &<Dim<D> as TangentSpace<D>>::Tangents,
        (solved, slid): (&Solved, &Slid<D>),
    ) -> [f64; D] {
        let (gap_row, slip_rows) = (self.gap_row(spring.normal), self.slip_rows(tangents));
        std::array::from_fn(|d| {
            let mut sum = gap_row[d] * solved.force;
            for a in 0..D - 1 {
                sum += slip_rows[a][d] * slid.friction[a];
            }
            sum
        })
    }

    /// Row of the gap's rate.
    #[inline]
    pub(super) fn gap_row(&self, normal: [f64; D]) -> [f64; D] {
        let lean = self.lean();
        std::array::from_fn(|d| self.share * normal[d] + lean[d])
    }

    /// What it adds to the gap's rate, m/s.
    pub(super) fn rate(&self, normal: [f64; D], velocities: &[[f64; D]], bodies: &Bodies<D>) -> f64 {
        let row = self.gap_row(normal);
        let at = self.at as usize;
        let velocity = velocities.get(at).copied().unwrap_or_else(|| {
            let body = bodies.state(at - velocities.len());
            body.velocity_at(self.point(), &body.velocity)
        });
        (0..D).map(|d| row[d] * velocity[d]).sum()
    }

    /// Rows of the slip's rates.
    #[inline]
    pub(super) fn slip_rows(&self, tangents: &<Dim<D> as TangentSpace<D>>::Tangents) -> <Dim<D> as TangentSpace<D>>::Tangents {
        let turn = self.turn.copied().unwrap_or_default();
        Dim::<D>::vectors(|a| std::array::from_fn(|d| self.share * tangents[a][d] + turn[a][d]))
    }
}
