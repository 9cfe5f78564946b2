//! Numbers for people: three digits with a prefix, six digits, per cent, groups of thousands.

/// `value` with three significant digits, an SI prefix and `unit`: `125 ns`, `10 ms`, `1.5 m`.
#[must_use]
pub fn with_unit(value: f64, unit: &str) -> String {
    const PREFIXES: [(f64, &str); 7] = [(1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n")];
    let size = value.abs();
    if size == 0.0 || !(1e-9 * 0.9995..1e12).contains(&size) {
        return if size == 0.0 { format!("0 {unit}") } else { format!("{value:.2e} {unit}") };
    }
    // 0.9995: what rounds to 1000 of one prefix is 1 of the next.
    let (scale, prefix) = PREFIXES.into_iter().find(|(scale, _)| size >= 0.9995 * scale).unwrap_or((1e-9, "n"));
    format!("{} {prefix}{unit}", three_digits(value / scale))
}

/// Three significant digits of a number from 0.9995 to 1000, without zeros at the end.
fn three_digits(value: f64) -> String {
    let decimals = match value.abs() {
        size if size >= 99.95 => 0,
        size if size >= 9.995 => 1,
        _ => 2,
    };
    let text = format!("{value:.decimals$}");
    if decimals == 0 { text } else { text.trim_end_matches('0').trim_end_matches('.').to_string() }
}

/// A number with six significant digits: plain where it is short so, else with a power of ten.
#[must_use]
pub fn significant(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e6).contains(&size) {
        let text = format!("{value:.5e}");
        return match text.split_once('e') {
            Some((digits, power)) => format!("{}e{power}", digits.trim_end_matches('0').trim_end_matches('.')),
            None => text,
        };
    }
    let decimals = if size == 0.0 { 0 } else { (5 - size.log10().floor() as i32).clamp(0, 9) as usize };
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_string() } else { text }
}

/// A fraction as per cent with three significant digits.
#[must_use]
pub fn per_cent(fraction: f64) -> String {
    let value = 100.0 * fraction;
    match value.abs() {
        0.0 => "0 %".to_string(),
        size if (0.01..1000.0).contains(&size) => format!("{value:.2} %"),
        _ => format!("{value:.1e} %"),
    }
}

/// `80123` as `80,123`.
#[must_use]
pub fn grouped(value: u64) -> String {
    let digits = value.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_with_prefixes() {
        assert_eq!(with_unit(1.25e-7, "s"), "125 ns");
        assert_eq!(with_unit(0.01, "s"), "10 ms");
        assert_eq!(with_unit(0.999_99, "m"), "1 m");
        assert_eq!(with_unit(1.234e-5, "m"), "12.3 µm");
        assert_eq!(with_unit(-2500.0, "m"), "-2.5 km");
        assert_eq!(with_unit(0.0, "m"), "0 m");
        assert_eq!(with_unit(3e-14, "m"), "3.00e-14 m");
        assert_eq!(with_unit(f64::NAN, "m"), "NaN m");
    }

    #[test]
    fn figures_have_six_digits() {
        let shown = [0.0, 1.0, -2.5, 648.21, 123_456.0, 1.184_912_3e7, 1e-12, 0.001_5].map(significant);
        assert_eq!(shown, ["0", "1", "-2.5", "648.21", "123456", "1.18491e7", "1e-12", "0.0015"]);
        assert_eq!(significant(f64::NAN), "NaN");
    }

    #[test]
    fn fractions_become_per_cent() {
        assert_eq!(per_cent(0.0012), "0.12 %");
        assert_eq!(per_cent(1e-9), "1.0e-7 %");
        assert_eq!(per_cent(0.0), "0 %");
    }

    #[test]
    fn thousands_are_grouped() {
        assert_eq!([0, 999, 1000, 1_234_567].map(grouped), ["0", "999", "1,000", "1,234,567"]);
    }
}
