//! Decimal numbers as written, so that a unit's factor is applied before the only rounding.
//!
//! Texts come from `units.rs`; the scaled value goes back to it. A power of ten is added to the exponent of
//! the text, and the standard library rounds; other factors are exact in whole numbers of 128 bits.

/// A number as written: digits with at most one point, and the power of ten after them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Decimal<'a> {
    /// With its sign.
    mantissa: &'a str,
    power: i64,
}

/// Exponents beyond this are zero or infinity anyway.
const POWER_MAX: i64 = 1_000_000_000;
/// Decimals of a quotient: enough for the 17 digits of an `f64` behind the zeros of the smallest factor,
/// 10^-36.
const DECIMALS: usize = 60;

impl<'a> Decimal<'a> {
    /// Reads a number at the beginning of a text; also gives what follows it. `None` if no number begins
    /// there.
    pub(super) fn read(text: &'a str) -> Option<(Self, &'a str)> {
        let sign = usize::from(text.starts_with(['+', '-']));
        let mut has_point = false;
        let is_part = |c: char| c.is_ascii_digit() || (c == '.' && !std::mem::replace(&mut has_point, true));
        let (mantissa, rest) = text.split_at(sign + length_of(&text[sign..], is_part));
        if !mantissa.contains(|c: char| c.is_ascii_digit()) {
            return None;
        }
        let (power, rest) = power_of_ten(rest).unwrap_or((0, rest));
        Some((Self { mantissa, power }, rest))
    }

    /// The `f64` nearest to `self · numerator / denominator · 10^ten` (both up to 10^36). Where digits ·
    /// numerator is beyond 2^128 (never below 20 digits with a factor below 10^18), there are up to three
    /// roundings.
    pub(super) fn scaled(&self, numerator: u128, denominator: u128, ten: i32) -> f64 {
        let power = self.power.saturating_add(i64::from(ten));
        let of = |digits: &str, power: i64| format!("{digits}e{power}").parse().unwrap_or(f64::NAN);
        if numerator == denominator {
            return of(self.mantissa, power);
        }
        let digits = self.mantissa.trim_start_matches(['+', '-']);
        let (whole, decimals) = digits.split_once('.').unwrap_or((digits, ""));
        let decimals = decimals.trim_end_matches('0');
        let Some(product) = format!("{whole}{decimals}").parse().ok().and_then(|digits: u128| digits.checked_mul(numerator)) else {
            return of(self.mantissa, power) * (numerator as f64 / denominator as f64);
        };
        let value = of(&quotient(product, denominator), power.saturating_sub((decimals.len() + DECIMALS + 1) as i64));
        if self.mantissa.starts_with('-') { -value } else { value }
    }
}

/// Digits of `product / denominator · 10^(DECIMALS + 1)`; a last digit 1 stands for any remainder, so that
/// rounding sees it.
fn quotient(product: u128, denominator: u128) -> String {
    let mut digits = (product / denominator).to_string();
    let mut rest = product % denominator;
    for _ in 0..DECIMALS {
        rest *= 10;
        digits.push(char::from(b'0' + (rest / denominator) as u8));
        rest %= denominator;
    }
    digits.push(if rest > 0 { '1' } else { '0' });
    digits
}

/// Reads `e-3` at the beginning: the power and what follows it.
fn power_of_ten(text: &str) -> Option<(i64, &str)> {
    let text = text.strip_prefix(['e', 'E'])?;
    let sign = usize::from(text.starts_with(['+', '-']));
    let (power, rest) = text.split_at(sign + length_of(&text[sign..], |c| c.is_ascii_digit()));
    if power.len() == sign {
        return None;
    }
    let beyond = if power.starts_with('-') { -POWER_MAX } else { POWER_MAX };
    Some((power.parse().unwrap_or(beyond).clamp(-POWER_MAX, POWER_MAX), rest))
}

/// Length in bytes of the beginning whose characters are all such.
fn length_of(text: &str, mut is_such: impl FnMut(char) -> bool) -> usize {
    text.find(|c| !is_such(c)).unwrap_or(text.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::cmp::Ordering;

    #[test]
    fn quotients_are_rounded_once() {
        let of = |text: &str, up, down, ten| Decimal::read(text).map(|(number, _)| number.scaled(up, down, ten));
        assert_eq!(of("1", 1, 3, 0), Some(1.0 / 3.0));
        assert_eq!(of("-2", 1, 3, 0), Some(-2.0 / 3.0));
        assert_eq!(of("36", 1000, 3600, 0), Some(10.0));
        assert_eq!(of("0.1", 3, 1, 0), Some(0.3));
        assert_eq!(of("0", 7, 3, 5), Some(0.0));
        assert_eq!(of("1", 1, 10u128.pow(36) - 1, 36), Some(1.0));
        assert_eq!(of("1e999999999999999999999", 1, 1, 0), Some(f64::INFINITY));
        assert_eq!(of("1e999999999999999999999", 254, 1, -4), Some(f64::INFINITY));
        assert_eq!(of("1e-999999999999999999999", 1, 7, 0), Some(0.0));
        let long = "1.2345678901234567890123456789012345678901234567890";
        assert!((of(long, 254, 1, -2).unwrap_or(0.0) / (1.234_567_890_123_456_8 * 2.54) - 1.0).abs() < 5e-16);
    }

    #[test]
    fn a_number_ends_where_its_unit_begins() {
        let rest = |text: &'static str| Decimal::read(text).map(|(_, rest)| rest);
        assert_eq!(rest("1e3 m"), Some(" m"));
        assert_eq!(rest("1e"), Some("e"));
        assert_eq!(rest("1.5.2"), Some(".2"));
        assert_eq!(rest("-"), None);
        assert_eq!(rest("."), None);
        assert_eq!(rest("e3"), None);
        assert_eq!(rest(""), None);
    }

    /// The product of whole numbers, in base 2^32 from the lowest digit, without zeros at its end.
    fn product(factors: &[u128]) -> Vec<u32> {
        let mut all = vec![1];
        for factor in factors {
            let mut next = vec![0u32; all.len() + 4];
            for (i, digit) in all.iter().enumerate() {
                let mut carry = 0u64;
                for (k, part) in [0, 32, 64, 96].map(|shift| (factor >> shift) as u32).into_iter().enumerate() {
                    let sum = u64::from(next[i + k]) + u64::from(*digit) * u64::from(part) + carry;
                    (next[i + k], carry) = (sum as u32, sum >> 32);
                }
                next.iter_mut().skip(i + 4).for_each(|place| {
                    let sum = u64::from(*place) + carry;
                    (*place, carry) = (sum as u32, sum >> 32);
                });
            }
            next.truncate(next.iter().rposition(|digit| *digit > 0).map_or(0, |last| last + 1));
            all = next;
        }
        all
    }

    fn compare(a: &[u32], b: &[u32]) -> Ordering {
        a.len().cmp(&b.len()).then_with(|| a.iter().rev().cmp(b.iter().rev()))
    }

    /// Whether `value` (normal, positive) is the `f64` nearest to `digits · numerator / denominator ·
    /// 10^ten`, in exact arithmetic.
    fn is_nearest(value: f64, digits: u128, [numerator, denominator]: [u128; 2], ten: i32) -> bool {
        let (fraction, power) = (u128::from(value.to_bits()) & ((1 << 52) - 1) | 1 << 52, (value.to_bits() >> 52) as i32 - 1075);
        let powers = |base: u128, count: i32| std::iter::repeat_n(base, count.max(0) as usize);
        let exact: Vec<u128> = [2, digits, numerator].into_iter().chain(powers(10, ten)).chain(powers(2, -power)).collect();
        let exact = product(&exact);
        // Half way to the number below and to the one above.
        let half =
            |twice: u128| product(&[twice, denominator].into_iter().chain(powers(10, -ten)).chain(powers(2, power)).collect::<Vec<_>>());
        let (below, above) = (compare(&exact, &half(2 * fraction - 1)), compare(&exact, &half(2 * fraction + 1)));
        let is_even = fraction % 2 == 0;
        (below == Ordering::Greater || (is_even && below == Ordering::Equal))
            && (above == Ordering::Less || (is_even && above == Ordering::Equal))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]
        #[test]
        fn values_are_the_nearest_to_the_exact_ones(
            digits in prop_oneof![1..1000u64, 1..u64::MAX, (1u64 << 53..1 << 54)],
            point in 0..19usize,
            power in -30..30i32,
            ratio in prop::sample::select(vec![
                [1, 1], [254, 1], [60, 1], [1, 3600], [45_359_237, 1], [44_482_216_152_605, 254 * 254], [1, 254u128.pow(3)], [6, 1], [1 << 30, 60],
            ]),
        ) {
            let mut text = format!("{digits:020}");
            text.insert(text.len() - point, '.');
            let (number, rest) = Decimal::read(&text).unwrap();
            prop_assert_eq!(rest, "");
            let value = number.scaled(ratio[0], ratio[1], power);
            prop_assert!(is_nearest(value, u128::from(digits), ratio, power - point as i32), "{} {:?} {}: {}", text, ratio, power, value);
            let text = format!("-{text}e{power}");
            let negative = Decimal::read(&text).unwrap().0.scaled(ratio[0], ratio[1], 0);
            prop_assert_eq!(negative.to_bits(), (-value).to_bits());
        }
    }
}
