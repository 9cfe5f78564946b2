//! Minima, maxima and sums of a step over nodes, blocks, bodies and contacts, in one place. Minima, maxima
//! and [`sum`] do not depend on the order of their terms: a sum is exact until it is rounded once.
//! [`SumInOrder`] keeps the order in which nodes are stored.
//!
//! Loops over chunks themselves go through [`embate_lanes::Team::each`].

/// Bits of a digit of [`ExactSum`].
const BITS: u32 = 32;
/// Digits: from 2^−1074, the smallest number, to 2^1024, and two for carries.
const DIGITS: usize = 68;
/// Exponent of the smallest number.
const LEAST: i32 = -1074;
/// Additions after which carries are handed on: each adds less than 2^32 to a digit, which holds less than
/// 2^63.
const ADDITIONS: u32 = 1 << 30;

/// A sum of numbers without rounding: an integer of 68 digits, each of 32 bits in a signed number of 64, in
/// units of 2^−1074. Adding is splitting a mantissa over three digits; the order doesn't matter.
///
/// Source: R. M. Neal, Fast exact summation using small and large superaccumulators, arXiv:1505.05571 (2015).
#[derive(Clone, Debug)]
pub struct ExactSum {
    digits: [i64; DIGITS],
    /// Digits that are not zero lie in this range.
    used: [usize; 2],
    /// Additions since carries were handed on.
    additions: u32,
    /// Sum of what is not finite.
    not_finite: f64,
}

impl Default for ExactSum {
    fn default() -> Self {
        Self { digits: [0; DIGITS], used: [DIGITS, 0], additions: 0, not_finite: 0.0 }
    }
}

impl ExactSum {
    /// Adds a number.
    #[inline]
    pub fn add(&mut self, value: f64) {
        if value == 0.0 {
            return;
        }
        if !value.is_finite() {
            self.not_finite += value;
            return;
        }
        if self.additions == ADDITIONS {
            self.carry();
        }
        self.additions += 1;
        let bits = value.to_bits();
        let (exponent, fraction) = ((bits >> 52) as usize & 0x7ff, bits & ((1 << 52) - 1));
        // A subnormal number has the exponent of the smallest normal one and no leading one.
        let (shift, mantissa) = if exponent == 0 { (0, fraction) } else { (exponent - 1, fraction | 1 << 52) };
        let (first, shift) = (shift / BITS as usize, shift % BITS as usize);
        let wide = u128::from(mantissa) << shift;
        for (k, digit) in self.digits[first..first + 3].iter_mut().enumerate() {
            let part = (wide >> (BITS * k as u32)) as u32 as i64;
            *digit += if value < 0.0 { -part } else { part };
        }
        self.used = [self.used[0].min(first), self.used[1].max(first + 3)];
    }

    /// Adds what another one has.
    pub fn merge(&mut self, other: &Self) {
        self.carry();
        let mut other = other.clone();
        other.carry();
        self.digits.iter_mut().zip(&other.digits).for_each(|(digit, more)| *digit += more);
        self.used = [self.used[0].min(other.used[0]), self.used[1].max(other.used[1])];
        self.additions += 1;
        self.not_finite += other.not_finite;
    }

    /// Hands carries on, so that digits lie in 0..2^32; only the highest of those in use may be negative: it
    /// has the sign.
    fn carry(&mut self) {
        self.additions = 0;
        let [first, end] = self.used;
        let mut carry = 0;
        for digit in &mut self.digits[first.min(end)..end.min(DIGITS - 1)] {
            let all = *digit + carry;
            carry = all >> BITS;
            *digit = all & ((1 << BITS) - 1);
        }
        if carry != 0 {
            let top = end.min(DIGITS - 1);
            self.digits[top] += carry;
            self.used[1] = top + 1;
        }
    }

    /// The sum, rounded to the nearest number, to the even one of two. Not finite where something added was
    /// not.
    #[must_use]
    pub fn value(mut self) -> f64 {
        if self.not_finite != 0.0 {
            return self.not_finite;
        }
        self.carry();
        let [first, end] = self.used;
        let is_negative = end > 0 && self.digits[end - 1] < 0;
        if is_negative {
            self.digits[first..end].iter_mut().for_each(|digit| *digit = -*digit);
            self.carry();
        }
        let Some(top) = (self.used[0]..self.used[1]).rev().find(|&k| self.digits[k] != 0) else { return 0.0 };
        // The highest digits, and in the last bit whether there is anything below: far beyond what rounding
        // looks at.
        let lowest = top.saturating_sub(3);
        let mut head = (lowest..=top).rev().fold(0u128, |head, k| head << BITS | self.digits[k] as u128);
        if self.digits[first.min(lowest)..lowest].iter().any(|&digit| digit != 0) {
            head |= 1;
        }
        let exponent = BITS as i32 * lowest as i32 + LEAST;
        // In two steps, neither of which leaves the range of the powers; the first is exact, and so is the
        // second where the sum is below the normal numbers, since then nothing was rounded.
        let half = exponent / 2;
        let found = head as f64 * power(half) * power(exponent - half);
        if is_negative { -found } else { found }
    }
}

/// 2^exponent of a normal number.
fn power(exponent: i32) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}

/// The sum of numbers, rounded once: the same for every order.
#[must_use]
pub fn sum<Values>(values: Values) -> f64
where
    Values: IntoIterator<Item = f64>,
    Values::IntoIter: Clone,
{
    let mut values = values.into_iter();
    let Some(first) = values.next() else { return 0.0 };
    let Some(second) = values.next() else { return first };
    let Some(third) = values.next() else { return first + second };
    let all = [first, second, third].into_iter().chain(values);
    sum_of_similar(all.clone()).unwrap_or_else(|| {
        let mut sum = ExactSum::default();
        all.for_each(|value| sum.add(value));
        sum.value()
    })
}

/// The sum of numbers that are zero, or 2^-32 to 2^28 times as large as the first that is not: an integer of
/// 128 bits, rounded once. `None` where they are of other sizes, or too many. Most sums of a step are such.
fn sum_of_similar(values: impl Iterator<Item = f64>) -> Option<f64> {
    const BELOW: i32 = 32;
    const RANGE: i32 = 60;
    // Each is less than 2^(53 + 60): so many stay below 2^126.
    const MANY: usize = 1 << 13;
    let exponent = |value: f64| (value.to_bits() >> 52) as i32 & 0x7ff;
    let mut values = values.filter(|value| *value != 0.0).peekable();
    let Some(&first) = values.peek() else { return Some(0.0) };
    let lowest = exponent(first) - BELOW;
    // Neither the unit nor the sum is near the ends of the numbers.
    if !(64..=1900).contains(&lowest) {
        return None;
    }
    let mut sum = 0;
    for (count, value) in values.enumerate() {
        let shift = exponent(value) - lowest;
        if !(0..=RANGE).contains(&shift) || count == MANY {
            return None;
        }
        let mantissa = i128::from(value.to_bits() & ((1 << 52) - 1) | 1 << 52) << shift;
        sum += if value < 0.0 { -mantissa } else { mantissa };
    }
    Some(sum as f64 * power(lowest + LEAST - 1))
}

/// A sum in the order in which its terms come, rounded after each: what moves nodes and has always been added
/// so.
#[derive(Clone, Copy, Debug, Default)]
pub struct SumInOrder(f64);

impl SumInOrder {
    /// Adds a number.
    #[inline]
    pub fn add(&mut self, value: f64) {
        self.0 += value;
    }

    /// The sum.
    #[must_use]
    pub fn value(self) -> f64 {
        self.0
    }
}

/// The smallest of numbers; infinite where there is none. A number that is none counts for nothing.
#[must_use]
pub fn min(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(f64::INFINITY, f64::min)
}

/// The largest of numbers that are not negative; zero where there is none. A number that is none counts for
/// nothing.
#[must_use]
pub fn max(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn what_rounding_loses_is_kept() {
        assert_eq!(sum([1e300, 1.0, -1e300]), 1.0);
        assert_eq!(sum([1.0, 1e-30, -1.0]), 1e-30);
        assert_eq!(sum([f64::MAX, f64::MAX, -f64::MAX]), f64::MAX);
        assert_eq!(sum([f64::MAX, f64::MAX, 1.0]), f64::INFINITY);
        assert_eq!(sum([-f64::MAX, -f64::MAX, 1.0]), f64::NEG_INFINITY);
        assert_eq!(sum([5e-324, 5e-324, -1e-323]), 0.0);
        assert_eq!(sum([f64::MIN_POSITIVE, -5e-324, 0.0]), f64::MIN_POSITIVE - 5e-324);
        assert_eq!(sum([]), 0.0);
        assert!(sum([1.0, f64::NAN, 2.0]).is_nan() && sum([f64::INFINITY, f64::NEG_INFINITY, 1.0]).is_nan());
        assert_eq!(sum([f64::INFINITY, 1.0, 2.0]), f64::INFINITY);
    }

    #[test]
    fn ties_go_to_the_even_number_and_a_little_more_does_not() {
        // Half of the last place of one.
        let half = f64::EPSILON / 2.0;
        assert_eq!(sum([1.0, half, 0.0]), 1.0);
        assert_eq!(sum([1.0, half, 1e-300]), 1.0 + f64::EPSILON);
        assert_eq!(sum([1.0 + f64::EPSILON, half, 0.0]), 1.0 + 2.0 * f64::EPSILON);
        assert_eq!(sum([1.0 + f64::EPSILON, half, -1e-300]), 1.0 + f64::EPSILON);
        assert_eq!(sum([-1.0, -half, -1e-300]), -1.0 - f64::EPSILON);
    }

    /// Numbers of all sizes, and those that cancel.
    fn numbers() -> impl Strategy<Value = Vec<f64>> {
        let number = prop_oneof![any::<f64>().prop_filter("finite", |x| x.is_finite() && x.abs() < 1e300), -1e3..1e3, Just(5e-324)];
        proptest::collection::vec(number, 3..60)
    }

    /// The sum of integers in units of 2^-40, each less than 2^60: exact in 128 bits, rounded by the
    /// conversion.
    fn of_integers(values: &[i64]) -> f64 {
        values.iter().map(|&value| i128::from(value)).sum::<i128>() as f64 * 2f64.powi(-40)
    }

    proptest! {
        #[test]
        fn no_order_and_no_grouping_changes_a_bit(mut values in numbers(), cut in 0usize..60) {
            let wanted = sum(values.iter().copied());
            values.reverse();
            prop_assert_eq!(sum(values.iter().copied()), wanted);
            values.sort_by(f64::total_cmp);
            prop_assert_eq!(sum(values.iter().copied()), wanted);
            let mut parts = [ExactSum::default(), ExactSum::default()];
            for (k, &value) in values.iter().enumerate() {
                parts[usize::from(k < cut)].add(value);
            }
            let [mut all, other] = parts;
            all.merge(&other);
            prop_assert_eq!(all.clone().value(), wanted);
            // With all of it taken away again nothing is left.
            values.iter().for_each(|&value| all.add(-value));
            prop_assert_eq!(all.value(), 0.0);
        }

        #[test]
        fn sums_of_similar_numbers_are_those_of_all_digits(values in proptest::collection::vec(prop_oneof![-1e3..1e3, Just(0.0)], 3..60), power in -900..900) {
            let values: Vec<f64> = values.iter().map(|value| value * 2f64.powi(power)).collect();
            let mut wanted = ExactSum::default();
            values.iter().for_each(|&value| wanted.add(value));
            prop_assert_eq!(sum(values.iter().copied()), wanted.value());
        }

        #[test]
        fn sums_of_integers_are_those_of_128_bits(values in proptest::collection::vec(-(1i64 << 53)..1i64 << 53, 3..100)) {
            prop_assert_eq!(sum(values.iter().map(|&value| value as f64 * 2f64.powi(-40))), of_integers(&values));
        }
    }
}
