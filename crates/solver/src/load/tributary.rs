//! How much of a surface belongs to a node: the one place where a length becomes an area.

/// Part of a segment that each of its two nodes stands for, per metre of depth: half the length, m.
#[must_use]
pub fn shares([a, b]: [[f64; 2]; 2]) -> [f64; 2] {
    let half = 0.5 * ((b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2)).sqrt();
    [half, half]
}
