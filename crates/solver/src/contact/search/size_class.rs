//! Sorts facets into a few classes of similar size, each of which gets a grid of its own cell size.
//!
//! Sizes are counted by their binary exponent. Every class costs each slave node one look; a facet that is
//! much smaller than the largest of its class is compared with slave nodes that are far from it. The classes
//! are those with the least sum of both.

/// Cost of looking at one class, in comparisons of boxes.
const LOOK: f64 = 8.0;
/// Exponents below the largest that are distinguished; what is smaller than 2^-60 of the largest is one bin.
const OCTAVES: usize = 60;
/// Number of bins.
pub(super) const BINS: usize = OCTAVES + 1;

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
    /// Exponent of the largest.
    top: usize,
    /// Small ones first; the last is that of the largest.
    bins: [Class; BINS],
    /// Class of each bin.
    class_of: [u8; BINS],
    classes: Vec<Class>,
}

impl Default for Sizes {
    fn default() -> Self {
        Self { top: 0, bins: [Class::default(); BINS], class_of: [0; BINS], classes: Vec::new() }
    }
}

/// Binary exponent of a size, biased.
#[inline]
fn exponent(size: f64) -> usize {
    (size.abs().to_bits() >> 52) as usize
}

impl Sizes {
    /// Forgets all; sizes up to `largest` may come.
    pub(super) fn clear(&mut self, largest: f64) {
        self.top = exponent(largest);
        self.bins = [Class::default(); BINS];
    }

    /// Counts a size (finite, not negative) and returns its bin.
    #[inline]
    pub(super) fn add(&mut self, size: f64) -> usize {
        let number = OCTAVES - self.top.saturating_sub(exponent(size)).min(OCTAVES);
        let bin = &mut self.bins[number];
        bin.count += 1;
        bin.largest = if size > bin.largest { size } else { bin.largest };
        number
    }

    /// Class of a bin, after [`Sizes::classes`].
    #[inline]
    pub(super) fn class_of(&self, bin: usize) -> usize {
        usize::from(self.class_of[bin])
    }

    /// A class by number, after [`Sizes::classes`].
    pub(super) fn class(&self, number: usize) -> Class {
        self.classes[number]
    }

    /// Classes for all sizes counted, large ones first; in 3D of `dimension`, where a surface fills cells
    /// like a length to the power dimension − 1.
    pub(super) fn classes(&mut self, dimension: usize) -> &[Class] {
        self.classes.clear();
        let (n, bins) = (BINS, &self.bins);
        let all: f64 = bins.iter().map(|b| f64::from(b.count)).sum();
        // least[j]: cost of the first j bins in the best classes; start[j]: where the last of these begins.
        let mut least = [f64::INFINITY; BINS + 1];
        let mut start = [0; BINS + 1];
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
                self.class_of[start[end]..end].fill(number);
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
        all.clear(sizes.iter().copied().fold(0.0, f64::max));
        let bins: Vec<_> = sizes.iter().map(|&s| all.add(s)).collect();
        let classes: Vec<_> = all.classes(2).to_vec();
        for (size, bin) in sizes.iter().zip(bins) {
            assert!(*size <= classes[all.class_of(bin)].largest);
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
