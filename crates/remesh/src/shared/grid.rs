//! Boxes by the cells of a grid that they meet.

/// Lowest and highest coordinates.
pub(crate) type Bounds<const D: usize> = [[f64; D]; 2];

/// The box of some places.
pub(crate) fn bounds<const D: usize>(places: &[[f64; D]]) -> Bounds<D> {
    let mut found = [[f64::INFINITY; D], [f64::NEG_INFINITY; D]];
    for place in places {
        for k in 0..D {
            found[0][k] = found[0][k].min(place[k]);
            found[1][k] = found[1][k].max(place[k]);
        }
    }
    found
}

/// Boxes by the cells of a grid that they meet.
pub(crate) struct Grid<const D: usize> {
    low: [f64; D],
    /// Cells by metre.
    scale: [f64; D],
    counts: [usize; D],
    /// Of each cell the first of its items; one more at the end.
    starts: Vec<u32>,
    items: Vec<u32>,
    boxes: Vec<Bounds<D>>,
    /// The last mark with which a box was found.
    seen: Vec<u32>,
}

impl<const D: usize> Grid<D> {
    /// A grid of cells as large as the mean box, four times as many as boxes at most.
    pub(crate) fn new(boxes: Vec<Bounds<D>>) -> Self {
        let mut all: Bounds<D> = [[f64::INFINITY; D], [f64::NEG_INFINITY; D]];
        let mut sides = [0.0; D];
        for [low, high] in &boxes {
            for k in 0..D {
                all[0][k] = all[0][k].min(low[k]);
                all[1][k] = all[1][k].max(high[k]);
                sides[k] += high[k] - low[k];
            }
        }
        let mut counts = [1; D];
        let limit = 4 * boxes.len() + 1;
        for k in 0..D {
            let number = (all[1][k] - all[0][k]) * boxes.len() as f64 / sides[k];
            counts[k] = if number >= 1.0 { (number as usize).min(limit) } else { 1 };
        }
        while counts.iter().fold(1, |product: usize, &count| product.saturating_mul(count)) > limit {
            let k = (1..D).fold(0, |most, k| if counts[k] > counts[most] { k } else { most });
            counts[k] = (counts[k] / 2).max(1);
        }
        let scale = std::array::from_fn(|k| counts[k] as f64 / (all[1][k] - all[0][k]));
        let cells = counts.iter().product::<usize>();
        let seen = vec![u32::MAX; boxes.len()];
        let mut grid = Self { low: all[0], scale, counts, starts: vec![0; cells + 1], items: Vec::new(), boxes, seen };
        let mut starts = std::mem::take(&mut grid.starts);
        grid.boxes.iter().for_each(|of| grid.each(of, |cell| starts[cell + 1] += 1));
        for cell in 1..starts.len() {
            starts[cell] += starts[cell - 1];
        }
        let mut ends = starts.clone();
        let mut items = vec![0; starts.last().map_or(0, |&last| last as usize)];
        for (k, of) in grid.boxes.iter().enumerate() {
            grid.each(of, |cell| {
                items[ends[cell] as usize] = k as u32;
                ends[cell] += 1;
            });
        }
        (grid.starts, grid.items) = (starts, items);
        grid
    }

    /// The cells that a box meets.
    fn each(&self, of: &Bounds<D>, mut visit: impl FnMut(usize)) {
        // A conversion saturates: what lies below or above is in the first or the last one.
        let at = |x: &[f64; D]| -> [usize; D] {
            std::array::from_fn(|k| (((x[k] - self.low[k]) * self.scale[k]) as usize).min(self.counts[k] - 1))
        };
        let (first, last) = (at(&of[0]), at(&of[1]));
        let mut place = first;
        loop {
            visit((0..D).rev().fold(0, |cell, k| cell * self.counts[k] + place[k]));
            // The next one; the first coordinate changes most often.
            let Some(k) = (0..D).find(|&k| place[k] < last[k]) else { break };
            place[k] += 1;
            place[..k].copy_from_slice(&first[..k]);
        }
    }

    /// Sets `found` to the boxes that meet a box, ascending. Each call has a `mark` of its own.
    pub(crate) fn near(&mut self, of: &Bounds<D>, mark: u32, found: &mut Vec<u32>) {
        found.clear();
        let mut seen = std::mem::take(&mut self.seen);
        self.each(of, |cell| {
            for &item in &self.items[self.starts[cell] as usize..self.starts[cell + 1] as usize] {
                let k = item as usize;
                let [low, high] = &self.boxes[k];
                if seen[k] != mark && (0..D).all(|k| low[k] < of[1][k] && of[0][k] < high[k]) {
                    seen[k] = mark;
                    found.push(item);
                }
            }
        });
        self.seen = seen;
        found.sort_unstable();
    }
}
