//! Eight boxes side by side, compared with one box at once.

use super::extent::Extent;
use embate_lanes::{BATCH, Batch, Lane};

/// Boxes of eight facets or nodes; [`Extent::NONE`] where there is none.
#[derive(Clone, Copy, Debug)]
pub(super) struct Eight<const D: usize> {
    low: [Batch; D],
    high: [Batch; D],
}

impl<const D: usize> Eight<D> {
    /// Eight empty boxes.
    pub(super) const NONE: Self = Self { low: [Batch::splat(f64::INFINITY); D], high: [Batch::splat(f64::NEG_INFINITY); D] };

    /// Writes one.
    #[inline(always)]
    pub(super) fn set(&mut self, at: usize, extent: &Extent<D>) {
        for d in 0..D {
            self.low[d].0[at % BATCH] = extent.low[d];
            self.high[d].0[at % BATCH] = extent.high[d];
        }
    }

    /// Which of them share a point with `other`: bit i for the i-th. No coordinate may be NaN. The same as
    /// [`Extent::meets`].
    #[inline(always)]
    pub(super) fn meet<L: Lane>(&self, other: &Extent<D>) -> u32 {
        let mut apart = 0;
        for at in (0..BATCH).step_by(L::WIDTH) {
            // Loops, not closures: these would not be compiled for the instruction set.
            for d in 0..D {
                let below = L::load(&self.high[d], at).less(L::splat(other.low[d]));
                let above = L::splat(other.high[d]).less(L::load(&self.low[d], at));
                apart |= L::bits(L::either(below, above)) << at;
            }
        }
        !apart & 0xff
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use embate_lanes::{Kernel, Level};

    struct Meet<'a>(&'a Eight<2>, &'a Extent<2>);
    impl Kernel for Meet<'_> {
        type Output = u32;
        #[inline(always)]
        fn run<L: Lane>(self) -> u32 {
            self.0.meet::<L>(self.1)
        }
    }

    #[test]
    fn eight_boxes_meet_a_box_as_each_does_alone_on_every_instruction_set() {
        let ends = [f64::NEG_INFINITY, -2.0, -0.0, 0.0, 1e-300, 1.0, 2.0, f64::INFINITY];
        let mut boxes = vec![Extent::<2>::NONE];
        for (i, &low) in ends.iter().enumerate() {
            for &high in &ends[i..] {
                boxes.extend([Extent { low: [low, 0.0], high: [high, 1.0] }, Extent { low: [0.5, low], high: [0.5, high] }]);
            }
        }
        for some in boxes.chunks(BATCH) {
            let mut eight = Eight::NONE;
            for (at, extent) in some.iter().enumerate() {
                eight.set(at, extent);
            }
            for other in &boxes {
                let expected = some.iter().enumerate().fold(0, |bits, (at, extent)| bits | u32::from(extent.meets(other)) << at);
                for level in Level::available() {
                    assert_eq!(level.run(Meet(&eight, other)), expected, "{} {other:?}", level.name());
                }
            }
        }
    }
}
