//! Numbers for people, and columns that are aligned.

pub(crate) use embate_files::numbers::{grouped, per_cent, with_unit};

/// Rows as lines with aligned columns, each line after `indent`; the last column is not padded.
pub(crate) fn table(rows: &[Vec<String>], indent: &str) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut text = String::new();
    for row in rows {
        let line: Vec<String> = row.iter().zip(&widths).map(|(cell, &width)| format!("{cell:<width$}")).collect();
        text.push_str(format!("{indent}{}", line.join("  ")).trim_end());
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_aligned() {
        let rows = [vec!["a".to_string(), "b".to_string()], vec!["µµ".to_string(), "c".to_string()]];
        assert_eq!(table(&rows, " "), " a   b\n µµ  c\n");
    }
}
