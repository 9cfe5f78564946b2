//! Ends of springs as they are kept: all have a share, and what not all have lies apart: turns (only with
//! friction), and what few have. Springs are more than caches hold, so their size is their cost.

use super::End;
use crate::contact::springs::TangentSpace;
use crate::tensor::Dim;

/// No more.
const NONE: u32 = u32::MAX;

/// The ends of all springs, one after the other.
#[derive(Default)]
pub(super) struct Ends<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    list: Vec<PackedEnd>,
    /// As far as any end has one.
    turns: Vec<<Dim<D> as TangentSpace<D>>::Tangents>,
    more: Vec<More<D>>,
}

/// What every end has.
#[derive(Clone, Copy)]
struct PackedEnd {
    at: u32,
    /// Number of what it has beyond, or [`NONE`].
    more: u32,
    share: f64,
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
    pub(super) fn clear(&mut self) {
        self.list.clear();
        self.turns.clear();
        self.more.clear();
    }

    pub(super) fn len(&self) -> u32 {
        self.list.len() as u32
    }

    #[inline]
    pub(super) fn push(&mut self, end: &End<D>) {
        let End { at, share, lean, turn, point, image } = *end;
        let more = More { lean, point, image };
        let number = if more == More::default() { NONE } else { self.more.len() as u32 };
        if number != NONE {
            self.more.push(more);
        }
        self.turns.resize(self.list.len(), Default::default());
        self.turns.push(turn);
        self.list.push(PackedEnd { at, more: number, share });
    }

    /// Nodes with shares in the gap, and nothing else.
    #[inline]
    pub(super) fn extend(&mut self, shares: impl Iterator<Item = (u32, f64)>) {
        self.list.extend(shares.map(|(at, share)| PackedEnd { at, more: NONE, share }));
    }

    #[inline]
    pub(super) fn get(&self, k: usize) -> End<D> {
        let PackedEnd { at, more, share } = self.list[k];
        let turn = self.turns.get(k).copied().unwrap_or_default();
        let More { lean, point, image } = self.more.get(more as usize).copied().unwrap_or_default();
        End { at, share, lean, turn, point, image }
    }

    /// Node or rigid body of an end.
    #[inline]
    pub(super) fn at(&self, k: usize) -> u32 {
        self.list[k].at
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
        let number = &mut self.list[k].more;
        if *number == NONE {
            *number = self.more.len() as u32;
            self.more.push(More::default());
        }
        &mut self.more[*number as usize]
    }
}
