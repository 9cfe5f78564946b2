//! Sorts facets into a few classes of similar size, each of which gets a grid of its own cell size.
//!
//! Sizes are counted by their binary exponent. Every class costs each slave node one look; a facet that is much smaller than the
//! largest of its class is compared with slave nodes that are far from it. The classes are those with the least sum of both.

/// Cost of looking at one class, in comparisons of boxes.
const LOOK: f64 = 8.0;
/// Exponents below the largest that are told apart; what is smaller than 2^-60 of the largest is one bin.
const OCTAVES: usize = 60;
/// Binary exponents of `f64`, biased.
const EXPONENTS: usize = 2048;

/// A class of facets.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Class {
    /// How many.
    pub(super) count: u32,
    /// The largest size, m.
    pub(super) largest: f64,
}

/// Histogram of sizes and the classes made from it.
pub(super) struct Sizes {
    /// By exponent.
    bins: Vec<Class>,
    /// Class of each exponent.
    class_of: Vec<u8>,
    classes: Vec<Class>,
}

impl Default for Sizes {
    fn default() -> Self {
        Self { bins: vec![Class::default(); EXPONENTS], class_of: vec![0; EXPONENTS], classes: Vec::new() }
    }
}

impl Sizes {
    pub(super) fn clear(&mut self) {
        self.bins.fill(Class::default());
    }

    /// Counts a size (finite, not negative) and returns its exponent.
    #[inline]
    pub(super) fn add(&mut self, size: f64) -> u32 {
        let exponent = (size.to_bits() >> 52) as usize % EXPONENTS;
        let bin = &mut self.bins[exponent];
        bin.count += 1;
        bin.largest = if size > bin.largest { size } else { bin.largest };
        exponent as u32
    }

    /// Class of an exponent, after [`Sizes::classes`].
    #[inline]
    pub(super) fn class_of(&self, exponent: u32) -> usize {
        usize::from(self.class_of[exponent as usize])
    }

    /// Classes for all sizes counted, small ones first; in space of `dimension`, where a surface fills cells like a length to the power dimension − 1.
    pub(super) fn classes(&mut self, dimension: usize) -> &[Class] {
        self.classes.clear();
        let Some(top) = self.bins.iter().rposition(|b| b.count > 0) else { return &self.classes };
        // Bins in use, small ones first: exponents `bottom..=top`, the first with all below it.
        let bottom = top.saturating_sub(OCTAVES);
        let mut bins = [Class::default(); OCTAVES + 1];
        for (exponent, bin) in self.bins[..=top].iter().enumerate().filter(|(_, b)| b.count > 0) {
            let merged = &mut bins[exponent.saturating_sub(bottom)];
            merged.count += bin.count;
            merged.largest = merged.largest.max(bin.largest);
        }
        let n = top - bottom + 1;
        let all: f64 = bins[..n].iter().map(|b| f64::from(b.count)).sum();
        // least[j]: cost of the first j bins in the best classes; start[j]: where the last of these begins.
        let mut least = [f64::INFINITY; OCTAVES + 2];
        let mut start = [0; OCTAVES + 2];
        least[0] = 0.0;
        for j in 1..=n {
            if bins[j - 1].count == 0 {
                (least[j], start[j]) = (least[j - 1], start[j - 1]);
                continue;
            }
            let largest = bins[j - 1].largest;
            let mut comparisons = 0.0;
            for i in (0..j).rev().filter(|&i| bins[i].count > 0) {
                comparisons += f64::from(bins[i].count) / all * (2.0 * largest / bins[i].largest).powi(dimension as i32 - 1);
                let cost = least[i] + LOOK + comparisons;
                if cost < least[j] {
                    (least[j], start[j]) = (cost, i);
                }
            }
            if least[j].is_infinite() {
                // Points and anything else: 0/0 and x/0 above say nothing.
                (least[j], start[j]) = (least[j - 1] + LOOK, j - 1);
            }
        }
        let mut end = n;
        while end > 0 {
            let class = bins[start[end]..end]
                .iter()
                .fold(Class::default(), |all, b| Class { count: all.count + b.count, largest: all.largest.max(b.largest) });
            if class.count > 0 {
                self.classes.push(class);
                let number = self.classes.len() as u8 - 1;
                let from = if start[end] == 0 { 0 } else { bottom + start[end] };
                self.class_of[from..bottom + end].fill(number);
            }
            end = start[end];
        }
        &self.classes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn classes(sizes: &[f64]) -> Vec<(u32, f64)> {
        let mut all = Sizes::default();
        let exponents: Vec<_> = sizes.iter().map(|&s| all.add(s)).collect();
        let classes: Vec<_> = all.classes(2).to_vec();
        for (size, exponent) in sizes.iter().zip(exponents) {
            assert!(*size <= classes[all.class_of(exponent)].largest);
        }
        classes.iter().map(|c| (c.count, c.largest)).collect()
    }

    #[test]
    fn sizes_that_are_alike_make_one_class_on_either_side_of_a_power_of_two() {
        assert_eq!(classes(&[0.9, 1.1, 1.0, 1.9, 2.1]), [(5, 2.1)]);
    }

    #[test]
    fn very_uneven_sizes_make_several_classes() {
        let mut sizes = vec![1e-3; 1000];
        sizes.extend([1.0; 1000]);
        sizes.push(1e6);
        let mut found = classes(&sizes);
        found.sort_by(|a, b| a.1.total_cmp(&b.1));
        assert_eq!(found, [(1000, 1e-3), (1000, 1.0), (1, 1e6)]);
    }

    #[test]
    fn points_and_extremes_have_a_class() {
        assert_eq!(classes(&[]), []);
        assert_eq!(classes(&[0.0, 0.0]), [(2, 0.0)]);
        let total: u32 = classes(&[0.0, 5e-324, 1e-300, 1.0, 1e300, f64::MAX]).iter().map(|c| c.0).sum();
        assert_eq!(total, 6);
    }
}
