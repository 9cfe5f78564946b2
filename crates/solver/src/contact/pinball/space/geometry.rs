//! Where the balls under a surface in 3D are, and how large.
//!
//! A facet over an element of the height h gets one ball at the mean of its nodes where the element is a
//! cube. Of a facet with four nodes and the edges L₁, L₂, s = min(h, L₁, L₂), there are n₁ × n₂ with
//! n = round(L/s) and R ≤ ½ s, each at its depth; of a triangle with the inner radius r there are m² with
//! m = round(2 √2 r/h) ≥ 1 and R ≤ ½ min(h, 2 √2 r/m): on equal equilateral triangles a ball of the same size
//! comes as near between six of them as between four of a square. The ball touches the facet from inside, and
//! sticks out of no other facet of the surface at the same nodes: at rims it is smaller.

use super::{Ball, Corners, Placed, Side, Vector, cross, dot, length, minus};
use crate::mesh::cell::Cell;

/// Halvings that find how deep a ball at a rim is.
const HALVINGS: usize = 20;
/// No facet has more balls in a row.
const MOST: f64 = 64.0;

impl Ball {
    /// With these corners of a facet and the nodes beyond them.
    fn set(&mut self, corners: &[u32], beyond: &[u32], weights: &[f64], down: f64) {
        (self.nodes, self.shares, self.count) = ([0; 8], [0.0; 8], 0);
        let above = corners.iter().zip(weights).map(|(&node, weight)| (node, weight * (1.0 - down)));
        let below = beyond.iter().zip(weights).map(|(&node, weight)| (node, weight * down));
        for (node, share) in above.chain(below) {
            self.add(node, share);
        }
    }
}

/// The balls under a surface, facet by facet.
pub(super) fn balls_under(side: &Side<'_, 3>, positions: &[Vector]) -> Vec<Ball> {
    let placed = Placed { surface: &side.surface.target, positions };
    let mut balls: Vec<Ball> = Vec::new();
    // Those of the same element, by its lowest node: only they may be one.
    let mut at_node: std::collections::BTreeMap<u32, Vec<usize>> = std::collections::BTreeMap::new();
    for facet in 0..placed.surface.facets.len() as u32 {
        let stiffness = side.stiffness[facet as usize];
        let Some(cell) = side.cells[facet as usize] else { continue };
        let Some(&lowest) = cell.nodes.iter().min() else { continue };
        let known = at_node.entry(lowest).or_default();
        for ball in balls_of_facet(&placed, facet, cell, stiffness) {
            match known.iter().copied().find(|&at| balls[at].is_as(&ball, positions)) {
                // The larger one stays; round-off is not to decide.
                Some(at) if balls[at].radius < (1.0 - 1e-5) * ball.radius => balls[at] = ball,
                Some(_) => {}
                None => {
                    known.push(balls.len());
                    balls.push(ball);
                }
            }
        }
    }
    balls
}

/// The node of an element at the other end of the edge that leaves a facet at its node `at`; of one with
/// nodes between its corners the corner that is opposite.
fn beyond(cell: Cell<'_>, facet: &[u32], at: u32) -> Option<u32> {
    if cell.nodes.len() > cell.kind.corners() {
        return cell.beyond(facet);
    }
    let mut ends = cell.edges().flat_map(|[a, b]| [[a, b], [b, a]]);
    ends.find(|&[here, there]| here == at && !facet.contains(&there)).map(|[_, there]| there)
}

/// The balls of one facet over the element `cell`.
fn balls_of_facet(placed: &Placed<'_>, facet: u32, cell: Cell<'_>, stiffness: f64) -> Vec<Ball> {
    let nodes = placed.surface.facets[facet as usize];
    let corners = nodes.corners();
    let below: Vec<u32> = corners.iter().filter_map(|&node| beyond(cell, corners, node)).collect();
    if below.len() != corners.len() {
        return Vec::new();
    }
    let x = |node: u32| placed.positions[node as usize];
    let normal = placed.facet_normal(facet);
    let height = corners.iter().zip(&below).map(|(&a, &b)| dot(normal, minus(x(a), x(b)))).sum::<f64>() / corners.len() as f64;
    let area = placed.area(facet);
    if !(height > 0.0 && area > 0.0) {
        return Vec::new();
    }
    let (places, size) = if corners.len() == 3 { of_triangle(corners, &x, height) } else { of_square(corners, &x, height) };
    let mut around: Vec<u32> =
        corners.iter().flat_map(|&node| placed.surface.facets_at(node)).copied().filter(|&other| other != facet).collect();
    around.sort_unstable();
    around.dedup();
    let whole = area / places.len() as f64;
    let ball = |weights: &Vec<f64>| {
        let mut ball = Ball { stiffness, area: whole, ..Ball::default() };
        // Distances of the centre from the facet and from those around it.
        let mut room = |down: f64| {
            ball.set(corners, &below, weights, down);
            let centre = ball.centre(placed.positions);
            let own = placed.distance(centre, facet).unwrap_or(0.0);
            let others = around.iter().filter_map(|&other| placed.distance(centre, other)).fold(f64::INFINITY, f64::min);
            [own, others]
        };
        let deepest = 0.5 * size / height;
        let fits = |[own, others]: [f64; 2]| own <= others * (1.0 + 1e-9);
        let mut room_there = room(deepest);
        if !fits(room_there) {
            let (mut low, mut high) = (0.0, deepest);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                if fits(room(middle)) { low = middle } else { high = middle }
            }
            room_there = room(low);
        }
        ball.radius = room_there[0].min(room_there[1]);
        ball
    };
    places.iter().map(ball).filter(|ball| ball.radius > 0.0).collect()
}

/// Shares of the corners where balls are over a facet of four nodes, and the most that their diameter may be,
/// m.
fn of_square(corners: &[u32], x: &impl Fn(u32) -> Vector, height: f64) -> (Vec<Vec<f64>>, f64) {
    let edge = |k: usize| length(minus(x(corners[(k + 1) % 4]), x(corners[k])));
    let sides = [0.5 * (edge(0) + edge(2)), 0.5 * (edge(1) + edge(3))];
    let least = height.min(sides[0]).min(sides[1]);
    // A little less, so that round-off does not give equal elements with L/s = 1.5 one ball here and two
    // there.
    let counts = sides.map(|side| (side / least - 1e-6).round().clamp(1.0, MOST));
    let size = height.min(sides[0] / counts[0]).min(sides[1] / counts[1]);
    let place = |k: usize| {
        let columns = counts[0] as usize;
        let (u, v) = (((k % columns) as f64 + 0.5) / counts[0], ((k / columns) as f64 + 0.5) / counts[1]);
        vec![(1.0 - u) * (1.0 - v), u * (1.0 - v), u * v, (1.0 - u) * v]
    };
    ((0..(counts[0] * counts[1]) as usize).map(place).collect(), size)
}

/// The same over a triangle.
fn of_triangle(corners: &[u32], x: &impl Fn(u32) -> Vector, height: f64) -> (Vec<Vec<f64>>, f64) {
    let [a, b, c] = [0, 1, 2].map(|k| x(corners[k]));
    let twice = length(cross(minus(b, a), minus(c, a)));
    let inner = twice / (length(minus(b, a)) + length(minus(c, b)) + length(minus(a, c)));
    let wide = 2.0 * std::f64::consts::SQRT_2 * inner;
    let count = (wide / height - 1e-6).round().clamp(1.0, MOST);
    let rows = count as usize;
    let mut places = Vec::with_capacity(rows * rows);
    for i in 0..rows {
        for j in 0..rows - i {
            let place = |third: f64| {
                let (v, w) = ((i as f64 + third) / count, (j as f64 + third) / count);
                vec![1.0 - v - w, v, w]
            };
            places.push(place(1.0 / 3.0));
            if i + j + 1 < rows {
                places.push(place(2.0 / 3.0));
            }
        }
    }
    (places, height.min(wide / count))
}
