//! Decimal numbers kept as digits, so that a unit's factor is applied before the only rounding.
//!
//! Texts come from `units.rs`; the scaled value goes back to it.

/// `±digits · 10^exponent`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Decimal {
    negative: bool,
    /// Values 0 to 9, most significant first; not empty.
    digits: Vec<u8>,
    exponent: i64,
}

/// Exponents beyond this are zero or infinity anyway.
const EXPONENT_MAX: i64 = 1_000_000_000;
/// Digits that a quotient gets beyond those of the numerator: more than an `f64` can tell apart.
const QUOTIENT_DIGITS: usize = 40;

impl Decimal {
    /// Reads a number at the beginning of a text; also gives what follows it. `None` if no number begins there.
    pub(super) fn read(text: &str) -> Option<(Self, &str)> {
        let bytes = text.as_bytes();
        let mut at = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
        let negative = bytes.first() == Some(&b'-');
        let mut digits = Vec::new();
        let mut exponent: i64 = 0;
        let mut point = false;
        while let Some(byte) = bytes.get(at) {
            match byte {
                b'0'..=b'9' => {
                    digits.push(byte - b'0');
                    exponent -= i64::from(point);
                }
                b'.' if !point => point = true,
                _ => break,
            }
            at += 1;
        }
        if digits.is_empty() {
            return None;
        }
        if let Some((power, length)) = power_of_ten(&bytes[at..]) {
            exponent = exponent.saturating_add(power);
            at += length;
        }
        Some((Self { negative, digits, exponent }, &text[at..]))
    }

    /// The `f64` nearest to `self · numerator / denominator · 10^ten` (numerator and denominator up to 10^36).
    pub(super) fn scaled(&self, numerator: u128, denominator: u128, ten: i32) -> f64 {
        let mut exponent = self.exponent.saturating_add(i64::from(ten));
        let mut digits = if numerator == 1 { self.digits.clone() } else { times(&self.digits, numerator) };
        if denominator > 1 {
            let before = digits.len();
            digits = over(&digits, denominator);
            exponent = exponent.saturating_add(before as i64 - digits.len() as i64);
        }
        let mut text = String::with_capacity(digits.len() + 16);
        if self.negative {
            text.push('-');
        }
        text.extend(digits.iter().map(|digit| char::from(b'0' + digit)));
        text.push_str(&format!("e{exponent}"));
        text.parse().unwrap_or(f64::NAN)
    }
}

/// Reads `e-3` at the beginning: the power and its length in bytes.
fn power_of_ten(bytes: &[u8]) -> Option<(i64, usize)> {
    if !matches!(bytes.first(), Some(b'e' | b'E')) {
        return None;
    }
    let sign = usize::from(matches!(bytes.get(1), Some(b'+' | b'-')));
    let mut at = 1 + sign;
    let mut power: i64 = 0;
    while let Some(digit) = bytes.get(at).filter(|byte| byte.is_ascii_digit()) {
        power = (power * 10 + i64::from(digit - b'0')).min(EXPONENT_MAX);
        at += 1;
    }
    if at == 1 + sign {
        return None;
    }
    Some((if bytes.get(1) == Some(&b'-') { -power } else { power }, at))
}

/// Digits of `digits · factor` (factor up to 10^36).
fn times(digits: &[u8], factor: u128) -> Vec<u8> {
    let mut product = Vec::with_capacity(digits.len() + 40);
    let mut carry: u128 = 0;
    for digit in digits.iter().rev() {
        let sum = u128::from(*digit).saturating_mul(factor).saturating_add(carry);
        product.push((sum % 10) as u8);
        carry = sum / 10;
    }
    while carry > 0 {
        product.push((carry % 10) as u8);
        carry /= 10;
    }
    product.reverse();
    product
}

/// Digits of `digits / divisor`, continued behind the point; a last digit 1 stands for any remainder, so that rounding sees it.
fn over(digits: &[u8], divisor: u128) -> Vec<u8> {
    let mut quotient = Vec::with_capacity(digits.len() + QUOTIENT_DIGITS + 1);
    let mut remainder: u128 = 0;
    for digit in digits.iter().copied().chain(std::iter::repeat_n(0, QUOTIENT_DIGITS)) {
        remainder = remainder.saturating_mul(10).saturating_add(u128::from(digit));
        quotient.push((remainder / divisor) as u8);
        remainder %= divisor;
    }
    quotient.push(u8::from(remainder > 0));
    quotient
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotients_are_rounded_once() {
        let of = |text: &str, up, down, ten| Decimal::read(text).map(|(number, _)| number.scaled(up, down, ten));
        assert_eq!(of("1", 1, 3, 0), Some(1.0 / 3.0));
        assert_eq!(of("-2", 1, 3, 0), Some(-2.0 / 3.0));
        assert_eq!(of("36", 1000, 3600, 0), Some(10.0));
        assert_eq!(of("0.1", 3, 1, 0), Some(0.3));
        assert_eq!(of("0", 7, 3, 5), Some(0.0));
        assert_eq!(of("1e999999999999999999999", 1, 1, 0), Some(f64::INFINITY));
        assert_eq!(of("1e-999999999999999999999", 1, 7, 0), Some(0.0));
    }

    #[test]
    fn a_number_ends_where_its_unit_begins() {
        let rest = |text: &'static str| Decimal::read(text).map(|(_, rest)| rest);
        assert_eq!(rest("1e3 m"), Some(" m"));
        assert_eq!(rest("1e"), Some("e"));
        assert_eq!(rest("1.5.2"), Some(".2"));
        assert_eq!(rest("-"), None);
        assert_eq!(rest("e3"), None);
        assert_eq!(rest(""), None);
    }
}
