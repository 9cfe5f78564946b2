//! Numbers for people: nice ticks, units with a sensible prefix, labels without noise.
//! Takes ranges from `film`, `mesh` and `plots`; goes to axes, colour bars and labels.

/// A unit in which values are shown: shown = value × `factor`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Unit {
    pub(crate) factor: f64,
    /// Name with prefix; empty for a plain number.
    pub(crate) name: String,
}

impl Unit {
    /// ` [mm]`, or nothing for a plain number.
    pub(crate) fn bracket(&self) -> String {
        if self.name.is_empty() { String::new() } else { format!(" [{}]", self.name) }
    }
}

const PREFIXES: [(i32, &str); 10] =
    [(-12, "p"), (-9, "n"), (-6, "µ"), (-3, "m"), (0, ""), (3, "k"), (6, "M"), (9, "G"), (12, "T"), (15, "P")];

/// The unit for SI values up to `magnitude`, as engineers write them: mm up to some metres, MPa for
/// everything between soft and hard, else the prefix that leaves one to three digits before the point.
pub(crate) fn unit(si: &str, magnitude: f64) -> Unit {
    let magnitude = magnitude.abs();
    if !(magnitude.is_finite() && magnitude > 0.0) {
        return Unit { factor: 1.0, name: pretty(si) };
    }
    let natural = (3.0 * ((magnitude * (1.0 + 1e-9)).log10() / 3.0).floor()) as i32;
    let exponent = match si {
        "m" if (1e-4..5.0).contains(&magnitude) => -3,
        "m" if (5.0..5e3).contains(&magnitude) => 0,
        "m" => natural.min(3),
        "Pa" if (1e5..1e10).contains(&magnitude) => 6,
        "m/s" if (0.05..1e5).contains(&magnitude) => 0,
        "s" => natural.min(0),
        "" if (1e-3..1e5).contains(&magnitude) => 0,
        _ => natural,
    };
    if si.is_empty() {
        let name = if exponent == 0 { String::new() } else { format!("10{}", superscript(exponent)) };
        return Unit { factor: 10f64.powi(-exponent), name };
    }
    let exponent = exponent.clamp(-12, 15);
    // `exponent` is a multiple of three within the table, so the search finds it; the empty prefix otherwise.
    let prefix = PREFIXES.iter().find(|(e, _)| *e == exponent).map_or("", |(_, p)| p);
    Unit { factor: 10f64.powi(-exponent), name: format!("{prefix}{}", pretty(si)) }
}

/// `J/m^3` as `J/m³`.
fn pretty(si: &str) -> String {
    si.replace("^2", "²").replace("^3", "³")
}

fn superscript(exponent: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digits = exponent.unsigned_abs().to_string();
    let sign = if exponent < 0 { "⁻" } else { "" };
    sign.chars().chain(digits.bytes().map(|b| DIGITS[usize::from(b - b'0')])).collect()
}

/// Ticks on a line: values `first · step`, `(first + 1) · step`, ...
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Ticks {
    pub(crate) values: Vec<f64>,
    pub(crate) step: f64,
}

impl Ticks {
    /// Label of a tick: as many decimals as the step needs, a true minus sign, powers of ten when it would
    /// get long.
    pub(crate) fn label(&self, value: f64) -> String {
        number(value, self.step)
    }
    /// Labels of all ticks.
    pub(crate) fn labels(&self) -> Vec<String> {
        self.values.iter().map(|v| self.label(*v)).collect()
    }
}

/// Round ticks (steps of 1, 2, 2.5 or 5 times a power of ten) within `low..=high`, at most `count` of them
/// (at least 2 are allowed for).
pub(crate) fn ticks(low: f64, high: f64, count: usize) -> Ticks {
    let span = high - low;
    if !((1e-200..1e200).contains(&span) && low.is_finite()) || span < 1e-13 * low.abs().max(high.abs()) {
        let value = if low.is_finite() { low } else { 0.0 };
        return Ticks { values: vec![value], step: 1.0 };
    }
    let count = count.max(2);
    let slack = 1e-9;
    let mut exponent = (span / count as f64).log10().floor() as i32 - 1;
    loop {
        for mantissa in [1.0, 2.0, 2.5, 5.0] {
            // Dividing by a power of ten is exact where multiplying by its inverse is not: 0.3 stays 0.3.
            let step = if exponent < 0 { mantissa / 10f64.powi(-exponent) } else { mantissa * 10f64.powi(exponent) };
            let (first, last) = ((low / step - slack).ceil(), (high / step + slack).floor());
            if last - first < count as f64 {
                let number = (last - first).max(-1.0) as i64;
                let values = (0..=number).map(|k| {
                    let index = first + k as f64;
                    let value = if exponent < 0 { index * mantissa / 10f64.powi(-exponent) } else { index * step };
                    if value == 0.0 { 0.0 } else { value }
                });
                return Ticks { values: values.collect(), step };
            }
        }
        exponent += 1;
    }
}

/// `value` with the decimals that `step` needs.
pub(crate) fn number(value: f64, step: f64) -> String {
    let plain = |text: String| text.replace('-', "−");
    let size = value.abs().max(step.abs());
    if value != 0.0 && !(1e-5..1e6).contains(&size) {
        let exponent = value.abs().log10().floor() as i32;
        let exponent = if exponent < -300 { -300 } else { exponent };
        let mantissa = value / 10f64.powi(exponent);
        let text = format!("{mantissa:.3}");
        return plain(format!("{}·10{}", text.trim_end_matches('0').trim_end_matches('.'), superscript(exponent)));
    }
    plain(format!("{value:.*}", decimals(step)))
}

/// Decimals that show multiples of `step` apart: 0.25 needs two.
pub(crate) fn decimals(step: f64) -> usize {
    let step = step.abs();
    if !(step.is_finite() && step > 0.0) {
        return 0;
    }
    (0..10)
        .find(|d| {
            let x = step * 10f64.powi(*d);
            (x - x.round()).abs() < 1e-6 * x.max(1e-3) && x > 0.5
        })
        .unwrap_or(10) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(ticks(0.0, 1.0, 6).values, [0.0, 0.2, 0.4, 0.6, 0.8, 1.0]);
        assert_eq!(ticks(-0.35, 0.35, 8).labels(), ["−0.3", "−0.2", "−0.1", "0.0", "0.1", "0.2", "0.3"]);
        assert_eq!(ticks(0.0, 412.0, 6).labels(), ["0", "100", "200", "300", "400"]);
        assert_eq!(ticks(0.0, 0.93, 4).labels(), ["0.00", "0.25", "0.50", "0.75"]);
    }

    #[test]
    fn any_range_gives_a_useful_number_of_ticks() {
        for low in [-3.7e9, -1.0, 0.0, 1e-12, 0.37, 5e20] {
            for span in [1e-9, 0.013, 0.77, 1.0, 999.0, 3.3e12] {
                let t = ticks(low, low + span, 6);
                if low + span > low && span > 1e-12 * f64::abs(low) {
                    assert!((3..=6).contains(&t.values.len()), "{low} + {span}: {t:?}");
                }
                assert!(!t.labels().is_empty());
            }
        }
    }

    #[test]
    fn degenerate_ranges_do_not_hang() {
        for (low, high) in
            [(0.0, 0.0), (1.0, -1.0), (f64::NAN, 1.0), (0.0, f64::INFINITY), (f64::NEG_INFINITY, 0.0), (-1e308, 1e308), (0.0, 5e-324)]
        {
            assert!(ticks(low, high, 6).values.len() <= 6, "{low} to {high}");
        }
    }

    #[test]
    fn units_get_the_prefix_that_engineers_use() {
        let name = |si, magnitude| unit(si, magnitude).name;
        assert_eq!(name("m", 0.6), "mm");
        assert_eq!(name("m", 12.0), "m");
        assert_eq!(name("Pa", 1.2e9), "MPa");
        assert_eq!(name("Pa", 3e11), "GPa");
        assert_eq!(name("s", 0.01), "ms");
        assert_eq!(name("s", 4e-4), "µs");
        assert_eq!(name("s", 40.0), "s");
        assert_eq!(name("J/m", 25_000.0), "kJ/m");
        assert_eq!(name("J/m^3", 2.5e6), "MJ/m³");
        assert_eq!(name("m/s", 50.0), "m/s");
        assert_eq!(name("", 0.21), "");
        assert_eq!(name("", 3e-5), "10⁻⁶");
        assert_eq!(name("J/m", 0.0), "J/m");
        assert_eq!(name("J/m", f64::NAN), "J/m");
        assert!((unit("m", 0.6).factor - 1e3).abs() < 1e-9);
    }

    #[test]
    fn long_numbers_are_written_with_powers_of_ten() {
        assert_eq!(number(2.5e9, 5e8), "2.5·10⁹");
        assert_eq!(number(-4e-7, 1e-7), "−4·10⁻⁷");
        assert_eq!(number(0.0, 5e8), "0");
        assert_eq!(number(0.5, 0.25), "0.50");
    }
}
