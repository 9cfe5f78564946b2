//! Ends of springs as they are kept: most have a share and a turn, and what few have lies apart. Springs are more than caches hold, so their size is their cost.

use super::{End, Vector};

/// No more.
const NONE: u32 = u32::MAX;

/// The ends of all springs, one after the other.
#[derive(Default)]
pub(super) struct Ends {
    list: Vec<Kept>,
    more: Vec<More>,
}

/// What every end has.
#[derive(Clone, Copy)]
struct Kept {
    at: u32,
    /// Number of what it has beyond, or [`NONE`].
    more: u32,
    share: f64,
    turn: Vector,
}

/// What few ends have.
#[derive(Clone, Copy, Default, PartialEq)]
struct More {
    lean: Vector,
    point: Vector,
    image: Option<Vector>,
}

impl Ends {
    pub(super) fn clear(&mut self) {
        self.list.clear();
        self.more.clear();
    }

    pub(super) fn len(&self) -> u32 {
        self.list.len() as u32
    }

    #[inline]
    pub(super) fn push(&mut self, end: &End) {
        let End { at, share, lean, turn, point, image } = *end;
        let more = More { lean, point, image };
        let number = if more == More::default() { NONE } else { self.more.len() as u32 };
        if number != NONE {
            self.more.push(more);
        }
        self.list.push(Kept { at, more: number, share, turn });
    }

    #[inline]
    pub(super) fn get(&self, k: usize) -> End {
        let Kept { at, more, share, turn } = self.list[k];
        let More { lean, point, image } = self.more.get(more as usize).copied().unwrap_or_default();
        End { at, share, lean, turn, point, image }
    }

    /// Node or rigid body of an end.
    #[inline]
    pub(super) fn at(&self, k: usize) -> u32 {
        self.list[k].at
    }

    /// Lets the end act at a place, m.
    pub(super) fn set_point(&mut self, k: usize, point: Vector) {
        self.more_of(k).point = point;
    }

    /// Lets another node move in the stead of the end's, turned so.
    pub(super) fn set_image(&mut self, k: usize, image: Vector) {
        self.more_of(k).image = Some(image);
    }

    fn more_of(&mut self, k: usize) -> &mut More {
        let number = &mut self.list[k].more;
        if *number == NONE {
            *number = self.more.len() as u32;
            self.more.push(More::default());
        }
        &mut self.more[*number as usize]
    }
}
