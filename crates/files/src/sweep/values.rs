//! The values of a key that varies: `FROM:TO:COUNT`, `log:FROM:TO:COUNT`, a list `a, b, c`, or a column of a
//! table.
//!
//! Texts come from `plan.rs`; items go back to it, each a text as in a model file with the place that it came
//! from. Ends of a range keep the unit that they are written in, so what lies between them does too.

use super::Wrong;
use crate::model_file::{number_and_unit, quantity_in_si};
use std::ops::Range;

/// Most values of a range.
const COUNT_MAX: usize = 100_000;

/// A value of a key.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Item {
    /// As in a model file.
    pub(super) text: String,
    /// Where it, or its range, stands.
    pub(super) place: Range<usize>,
}

/// Reads what follows `PATH=`, which begins at byte `offset`; also gives whether the values are spaced by
/// factors.
pub(super) fn read(written: &str, offset: usize) -> Result<(Vec<Item>, bool), (Range<usize>, Wrong)> {
    let items: Vec<Item> = split(written, ',').into_iter().map(|range| item(written, range, offset)).collect();
    let whole = offset..offset + written.len();
    if items.iter().any(|item| item.text.is_empty()) {
        let help = "write FROM:TO:COUNT, log:FROM:TO:COUNT, or values with commas between them";
        return Err((whole, ("a value is empty".to_string(), help.to_string())));
    }
    if let [only] = items.as_slice() {
        let steps: Vec<&str> = split(&only.text, ':').into_iter().map(|range| only.text[range].trim()).collect();
        let (by_factors, steps) = if steps.first() == Some(&"log") { (true, &steps[1..]) } else { (false, &steps[..]) };
        if by_factors || steps.len() > 1 {
            let texts = spaced(steps, by_factors).map_err(|wrong| (only.place.clone(), wrong))?;
            return Ok((texts.into_iter().map(|text| Item { text, place: only.place.clone() }).collect(), by_factors));
        }
    }
    Ok((items, false))
}

fn item(text: &str, range: Range<usize>, offset: usize) -> Item {
    let written = &text[range.clone()];
    let start = offset + range.start + (written.len() - written.trim_start().len());
    let written = written.trim();
    Item { text: written.to_string(), place: start..start + written.len() }
}

/// Pieces between the separators that stand in no quotes and no brackets.
fn split(text: &str, separator: char) -> Vec<Range<usize>> {
    let (mut pieces, mut start, mut depth, mut quote) = (Vec::new(), 0, 0_i32, None);
    for (at, c) in text.char_indices() {
        match (quote, c) {
            (Some(open), c) if c == open => quote = None,
            (Some(_), _) => {}
            (None, '"' | '\'') => quote = Some(c),
            (None, '[' | '{') => depth += 1,
            (None, ']' | '}') => depth -= 1,
            (None, c) if c == separator && depth <= 0 => {
                pieces.push(start..at);
                start = at + c.len_utf8();
            }
            _ => {}
        }
    }
    pieces.push(start..text.len());
    pieces
}

/// The values of `FROM:TO:COUNT`.
fn spaced(steps: &[&str], by_factors: bool) -> Result<Vec<String>, Wrong> {
    let form = || "write FROM:TO:COUNT, such as 100MPa:500MPa:20, or log:FROM:TO:COUNT".to_string();
    let [from, to, count] = steps else {
        return Err((format!("a range has three parts, but here are {}", steps.len()), form()));
    };
    let count = match count.parse::<usize>() {
        Ok(count) if (2..=COUNT_MAX).contains(&count) => count,
        _ => return Err((format!("`{count}` is not a number of values from 2 to {COUNT_MAX}"), form())),
    };
    let bare = |text: &str| text.trim_matches(['"', '\'']).to_string();
    let (from, to) = (bare(from), bare(to));
    let ends = [&from, &to].map(|text| number_and_unit(text));
    let [Some((first, unit)), Some((last, unit_last))] = ends else {
        return Err((
            format!("`{from}` and `{to}` are not both numbers"),
            "a range goes from a number to a number; else list the values".to_string(),
        ));
    };
    let ([first, last], unit) = if unit == unit_last { ([first, last], unit.to_string()) } else { in_one_unit(&from, &to)? };
    if !(first.is_finite() && last.is_finite()) {
        return Err((format!("`{from}` or `{to}` is not finite"), form()));
    }
    if by_factors && !(first * last > 0.0) {
        return Err((
            format!("values spaced by factors can't go from {from} to {to}"),
            "give both ends the same sign, and none is 0".to_string(),
        ));
    }
    let end = (count - 1) as f64;
    let value = |k: usize| match k {
        0 => first,
        k if k == count - 1 => last,
        k if by_factors => clean(first * (last / first).powf(k as f64 / end)),
        k => clean((first * (end - k as f64) + last * k as f64) / end),
    };
    Ok((0..count).map(|k| if unit.is_empty() { value(k).to_string() } else { format!("{} {unit}", value(k)) }).collect())
}

/// Both ends in the SI unit of their dimension.
fn in_one_unit(from: &str, to: &str) -> Result<([f64; 2], String), Wrong> {
    match (quantity_in_si(from), quantity_in_si(to)) {
        (Some((first, dimension)), Some((last, other))) if dimension == other && !dimension.unit().is_empty() => {
            Ok(([first, last], dimension.unit()))
        }
        _ => Err((format!("`{from}` and `{to}` have different units"), "write both ends of a range in the same unit".to_string())),
    }
}

/// Fifteen digits: 0.3 and not 0.30000000000000004.
fn clean(value: f64) -> f64 {
    format!("{value:.14e}").parse().unwrap_or(value)
}

/// Fields of a table, line by line; empty lines are left out.
pub(super) fn table(text: &str) -> Vec<Vec<Item>> {
    let mut rows = Vec::new();
    let (mut row, mut field, mut start, mut quoted) = (Vec::new(), String::new(), 0, false);
    let mut characters = text.char_indices().peekable();
    let close = |row: &mut Vec<Item>, field: &mut String, start: usize, at: usize| {
        let place = item(text, start..at, 0).place;
        row.push(Item { text: std::mem::take(field).trim().to_string(), place });
    };
    while let Some((at, c)) = characters.next() {
        match c {
            '"' if quoted && characters.peek().is_some_and(|(_, next)| *next == '"') => {
                field.push('"');
                characters.next();
            }
            '"' => quoted = !quoted,
            ',' if !quoted => {
                close(&mut row, &mut field, start, at);
                start = at + 1;
            }
            '\n' if !quoted => {
                close(&mut row, &mut field, start, at);
                start = at + 1;
                rows.push(std::mem::take(&mut row));
            }
            c => field.push(c),
        }
    }
    close(&mut row, &mut field, start, text.len());
    rows.push(row);
    rows.retain(|row| !matches!(row.as_slice(), [only] if only.text.is_empty()));
    rows
}

/// A table's header `material.steel.yield [Pa]`: the path and the unit of bare numbers below it.
pub(super) fn path_and_unit(header: &str) -> (&str, &str) {
    match header.strip_suffix(']').and_then(|text| text.rsplit_once(" [")) {
        Some((path, unit)) => (path.trim(), unit.trim()),
        None => (header, ""),
    }
}

/// A field of a table; a bare number gets the unit of its column.
pub(super) fn with_unit(field: &Item, unit: &str) -> Item {
    let is_bare = matches!(number_and_unit(&field.text), Some((_, "")));
    if unit.is_empty() || !is_bare { field.clone() } else { Item { text: format!("{} {unit}", field.text), place: field.place.clone() } }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(written: &str) -> Vec<String> {
        read(written, 0).unwrap().0.into_iter().map(|item| item.text).collect()
    }

    #[test]
    fn a_range_has_both_ends_and_equal_steps_in_its_unit() {
        assert_eq!(texts("100MPa:500MPa:5"), ["100 MPa", "200 MPa", "300 MPa", "400 MPa", "500 MPa"]);
        assert_eq!(texts("0.1 : 0.5 : 5"), ["0.1", "0.2", "0.3", "0.4", "0.5"]);
        assert_eq!(texts("10:40:4"), ["10", "20", "30", "40"]);
        assert_eq!(texts("3:-3:3"), ["3", "0", "-3"]);
        assert_eq!(texts("100 MPa:0.3 GPa:3"), ["100000000 Pa", "200000000 Pa", "300000000 Pa"]);
    }

    #[test]
    fn a_range_by_factors_has_equal_ratios() {
        assert_eq!(texts("log:1mm:100mm:3"), ["1 mm", "10 mm", "100 mm"]);
        assert_eq!(texts("log:-1:-4:3"), ["-1", "-2", "-4"]);
    }

    #[test]
    fn lists_are_split_outside_of_quotes_and_brackets() {
        assert_eq!(texts("a, b,c"), ["a", "b", "c"]);
        assert_eq!(texts("[0, \"-50 m/s\"], [0, 1]"), ["[0, \"-50 m/s\"]", "[0, 1]"]);
        assert_eq!(texts("\"a,b\",{ x = 1, y = 2 }"), ["\"a,b\"", "{ x = 1, y = 2 }"]);
        assert_eq!(texts("5 mm"), ["5 mm"]);
        let (items, _) = read(" 5 mm, 6 mm", 10).unwrap();
        assert_eq!((items[0].place.clone(), items[1].place.clone()), (11..15, 17..21));
    }

    #[test]
    fn what_is_no_range_is_reported() {
        for (written, word) in [
            ("1:2", "three parts"),
            ("1:2:3:4", "three parts"),
            ("1:2:1", "number of values"),
            ("1:2:x", "number of values"),
            ("a:b:3", "not both numbers"),
            ("1 mm:2 s:3", "different units"),
            ("1:2 mm:3", "different units"),
            ("log:0:5:3", "same sign"),
            ("log:-1:5:3", "same sign"),
            ("log:1:5", "three parts"),
            ("1,,2", "empty"),
            ("", "empty"),
        ] {
            let (_, (message, help)) = read(written, 0).unwrap_err();
            assert!(message.contains(word) || help.contains(word), "{written}: {message} {help}");
        }
    }

    #[test]
    fn a_table_has_fields_with_places() {
        let rows = table("a,b [mm]\r\n1, 2\n\n\"[0, \"\"1 m\"\"]\",x\n");
        let texts: Vec<Vec<&str>> = rows.iter().map(|row| row.iter().map(|field| field.text.as_str()).collect()).collect();
        assert_eq!(texts, [vec!["a", "b [mm]"], vec!["1", "2"], vec!["[0, \"1 m\"]", "x"]]);
        assert_eq!(rows[1][1].place, 13..14);
        assert_eq!(path_and_unit("b [mm]"), ("b", "mm"));
        assert_eq!(path_and_unit("part.a.velocity[1]"), ("part.a.velocity[1]", ""));
        assert_eq!(with_unit(&rows[1][1], "mm").text, "2 mm");
        assert_eq!(with_unit(&rows[2][1], "mm").text, "x");
    }
}
