//! Rows of a history for plots: all of a short one, every second, fourth ... of a long one, and the last.
//! Rows come from a run or a file; they go to pictures and pages.

/// Rows that are kept; a longer history is thinned evenly.
const ROWS: usize = 4096;

/// Rows that are thinned while they come.
#[derive(Debug)]
pub struct ThinnedRows {
    rows: Vec<Vec<f64>>,
    last: Option<Vec<f64>>,
    stride_exponent: u32,
    seen: u64,
    most: usize,
}

impl Default for ThinnedRows {
    fn default() -> Self {
        Self::of(ROWS)
    }
}

impl ThinnedRows {
    /// At most so many rows, and at least half as many of a long history.
    #[must_use]
    pub fn of(most: usize) -> Self {
        Self { rows: Vec::new(), last: None, stride_exponent: 0, seen: 0, most: most.max(2) }
    }

    /// The next row.
    pub fn add(&mut self, row: &[f64]) {
        if self.seen.trailing_zeros() >= self.stride_exponent {
            self.rows.push(row.to_vec());
            self.last = None;
        } else {
            self.last = Some(row.to_vec());
        }
        self.seen += 1;
        if self.rows.len() >= self.most {
            let mut index = 0;
            self.rows.retain(|_| {
                index += 1;
                index % 2 == 1
            });
            self.stride_exponent += 1;
        }
    }

    /// The rows so far.
    #[must_use]
    pub fn rows(&self) -> Vec<Vec<f64>> {
        self.rows.iter().chain(&self.last).cloned().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_history_is_thinned_evenly_for_the_plots() {
        let mut rows = ThinnedRows::default();
        for value in 0..10_000 {
            rows.add(&[f64::from(value)]);
        }
        let kept = rows.rows();
        assert!(kept.len() < ROWS && kept.len() > ROWS / 2 - 1);
        assert_eq!(kept[1][0] - kept[0][0], 4.0);
        assert!(kept[..kept.len() - 1].windows(2).all(|w| w[1][0] - w[0][0] == 4.0));
        assert_eq!(kept[kept.len() - 1], [9999.0]);
    }

    #[test]
    fn a_short_history_is_plotted_whole() {
        let mut rows = ThinnedRows::default();
        for value in 0..100 {
            rows.add(&[f64::from(value)]);
        }
        assert_eq!(rows.rows().len(), 100);
    }
}
