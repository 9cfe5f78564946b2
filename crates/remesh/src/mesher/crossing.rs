//! Where closed polygons cross or touch themselves or each other.

use crate::plane::{Point, dot, minus};
use robust::{Coord, orient2d};

/// An edge: its polygon and its place in it.
pub(crate) type Edge = [usize; 2];

/// Pairs of edges that have a point in common which is not the end that they share, `most` pairs at most.
pub(crate) fn crossings(polygons: &[Vec<Point>], most: usize) -> Vec<[Edge; 2]> {
    let mut edges = Vec::new();
    for (p, polygon) in polygons.iter().enumerate() {
        let n = polygon.len();
        edges.extend((0..n).map(|k| ([p, k], [polygon[k], polygon[(k + 1) % n]])));
    }
    // By x, so that only edges that overlap there are compared.
    edges.sort_by(|one, other| low(&one.1, 0).total_cmp(&low(&other.1, 0)).then(one.0.cmp(&other.0)));
    let mut found = Vec::new();
    for (i, (one, a)) in edges.iter().enumerate() {
        for (other, b) in edges[i + 1..].iter().take_while(|(_, b)| low(b, 0) <= high(a, 0)) {
            let n = polygons[one[0]].len();
            let meet = if one[0] == other[0] && (one[1] + 1) % n == other[1] {
                folded(a, b)
            } else if one[0] == other[0] && (other[1] + 1) % n == one[1] {
                folded(b, a)
            } else {
                meet(a, b)
            };
            if meet {
                found.push([*one, *other]);
                if found.len() >= most {
                    return found;
                }
            }
        }
    }
    found
}

fn low([a, b]: &[Point; 2], d: usize) -> f64 {
    a[d].min(b[d])
}

fn high([a, b]: &[Point; 2], d: usize) -> f64 {
    a[d].max(b[d])
}

/// On which side of the line from `a` to `b` the point `c` lies, exactly: 1 on the left, 0 on it.
fn side(a: Point, b: Point, c: Point) -> i8 {
    let [a, b, c] = [a, b, c].map(|[x, y]| Coord { x, y });
    let twice = orient2d(a, b, c);
    i8::from(twice > 0.0) - i8::from(twice < 0.0)
}

/// Whether two edges have a point in common.
fn meet(one: &[Point; 2], other: &[Point; 2]) -> bool {
    let apart = |d: usize| low(one, d) > high(other, d) || low(other, d) > high(one, d);
    if apart(0) || apart(1) {
        return false;
    }
    let parted = |[a, b]: &[Point; 2], [c, d]: &[Point; 2]| side(*a, *b, *c) * side(*a, *b, *d) > 0;
    !parted(one, other) && !parted(other, one)
}

/// Whether an edge runs back over the one that it follows.
fn folded([a, b]: &[Point; 2], [_, c]: &[Point; 2]) -> bool {
    side(*a, *b, *c) == 0 && dot(minus(*b, *a), minus(*c, *b)) <= 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_that_cross_touch_or_fold_are_found_and_others_are_not() {
        let square = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let moved = |dx: f64| square.iter().map(|&[x, y]| [x + dx, y]).collect::<Vec<Point>>();
        assert!(crossings(&[square.clone(), moved(1.0 + 1e-15)], 9).is_empty());
        assert_eq!(crossings(&[square.clone(), moved(1.0)], 9).len(), 7);
        assert_eq!(crossings(&[vec![[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]], 9), [[[0, 0], [0, 2]]]);
        assert_eq!(crossings(&[vec![[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [1.0, 1.0]]], 9).len(), 2);
        assert_eq!(crossings(&[vec![[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 1.0]]], 9).len(), 0);
    }
}
