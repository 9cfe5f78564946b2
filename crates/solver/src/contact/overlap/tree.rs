//! Boxes around facets in a binary tree: which facets may meet, and which triangle is nearest to a place.
//!
//! The tree is built once, by halves along the longest axis, a subtree for each body; boxes are taken again
//! for each look. It shares nothing with the searches of contact.

use super::skin::Skin;
use crate::contact::boxes::{Aabb, around, do_meet, joined, longest, meets_ray, nothing, square_away, widened};
use crate::contact::projection::node_facet::{Vector, square_to_triangle};
use crate::mesh::surface::NONE;

/// Facets of a leaf.
const LEAF: usize = 2;
/// Nodes that wait while one goes down the tree of a body: one more than it has levels, which halve what
/// numbers of 32 bits count.
const DEEPEST: usize = 40;
/// Squares of distances that differ by less than this fraction are equal.
const ROUNDED: f64 = 1e-9;
/// The side of what has both.
const MIXED: u32 = u32::MAX;

#[derive(Clone, Copy, Debug)]
struct Node {
    around: Aabb<3>,
    /// Children; of a leaf where its facets begin and end in the order, and `is_leaf`.
    first: u32,
    second: u32,
    is_leaf: bool,
    side: u32,
}

/// The tree.
#[derive(Debug, Default)]
pub(super) struct Tree {
    nodes: Vec<Node>,
    order: Vec<u32>,
    /// Root of each body.
    roots: Vec<u32>,
    root: u32,
    /// Box of each facet.
    pub(super) boxes: Vec<Aabb<3>>,
    /// By how much any place may have left the boxes since they were taken, m.
    pub(super) grown: f64,
}

impl Tree {
    /// Of the facets of a skin that has its places.
    pub(super) fn new(skin: &Skin) -> Self {
        let mut tree = Self { order: (0..skin.facets.len() as u32).collect(), ..Self::default() };
        let centres: Vec<Vector> = skin.facets.iter().map(|facet| centre(skin, facet.all())).collect();
        tree.order.sort_by_key(|&facet| skin.facets[facet as usize].body);
        let mut begin = 0;
        for body in 0..skin.bodies {
            let count = tree.order[begin..].iter().take_while(|&&facet| skin.facets[facet as usize].body == body).count();
            let root = tree.grow(skin, &centres, begin, begin + count);
            tree.roots.push(root);
            begin += count;
        }
        let mut tops: Vec<u32> = tree.roots.clone();
        let middles = |tree: &Self, root: u32| {
            let facets = tree.facets_below(root);
            let mut sum = [0.0; 3];
            for &facet in &facets {
                (0..3).for_each(|d| sum[d] += centres[facet as usize][d] / facets.len() as f64);
            }
            sum
        };
        let at: Vec<Vector> = tops.iter().map(|&root| middles(&tree, root)).collect();
        let mut numbers: Vec<usize> = (0..tops.len()).collect();
        tree.root = if tops.is_empty() { 0 } else { tree.join(&mut tops, &at, &mut numbers) };
        tree
    }

    fn facets_below(&self, node: u32) -> Vec<u32> {
        let Node { first, second, is_leaf, .. } = self.nodes[node as usize];
        if is_leaf {
            return self.order[first as usize..second as usize].to_vec();
        }
        let mut all = self.facets_below(first);
        all.extend(self.facets_below(second));
        all
    }

    /// Joins the roots `numbers` of bodies at their middles.
    fn join(&mut self, tops: &mut [u32], at: &[Vector], numbers: &mut [usize]) -> u32 {
        if let [only] = numbers {
            return tops[*only];
        }
        let axis = longest(&around(numbers.iter().map(|&number| at[number])));
        numbers.sort_by(|&a, &b| at[a][axis].total_cmp(&at[b][axis]));
        let half = numbers.len() / 2;
        let (low, high) = numbers.split_at_mut(half);
        let first = self.join(tops, at, low);
        let second = self.join(tops, at, high);
        let side = self.common_side(first, second);
        self.push(Node { around: nothing(), first, second, is_leaf: false, side })
    }

    fn common_side(&self, first: u32, second: u32) -> u32 {
        let [a, b] = [first, second].map(|node| self.nodes[node as usize].side);
        if a == b { a } else { MIXED }
    }

    fn push(&mut self, node: Node) -> u32 {
        self.nodes.push(node);
        self.nodes.len() as u32 - 1
    }

    /// The subtree of the facets `order[begin..end]`, all of one body.
    fn grow(&mut self, skin: &Skin, centres: &[Vector], begin: usize, end: usize) -> u32 {
        let facets = &mut self.order[begin..end];
        if facets.len() <= LEAF {
            let sides = facets.iter().map(|&facet| skin.facets[facet as usize].side);
            let side = sides.reduce(|a, b| if a == b { a } else { MIXED }).unwrap_or(MIXED);
            return self.push(Node { around: nothing(), first: begin as u32, second: end as u32, is_leaf: true, side });
        }
        let axis = longest(&around(facets.iter().map(|&facet| centres[facet as usize])));
        let half = facets.len() / 2;
        let key = |&facet: &u32| (centres[facet as usize][axis], facet);
        facets.sort_by(|a, b| {
            let ((x, a), (y, b)) = (key(a), key(b));
            x.total_cmp(&y).then(a.cmp(&b))
        });
        let first = self.grow(skin, centres, begin, begin + half);
        let second = self.grow(skin, centres, begin + half, end);
        let side = self.common_side(first, second);
        self.push(Node { around: nothing(), first, second, is_leaf: false, side })
    }

    /// Takes the boxes again. Children come before their parents.
    pub(super) fn refit(&mut self, skin: &Skin) {
        self.grown = 0.0;
        let Self { nodes, order, boxes, .. } = self;
        boxes.clear();
        boxes.extend(skin.facets.iter().map(|facet| skin.box_of(facet)));
        for number in 0..nodes.len() {
            let Node { first, second, is_leaf, .. } = nodes[number];
            nodes[number].around = if is_leaf {
                let facets = order[first as usize..second as usize].iter();
                facets.map(|&facet| boxes[facet as usize]).fold(nothing(), joined)
            } else {
                joined(nodes[first as usize].around, nodes[second as usize].around)
            };
        }
    }

    /// Facets whose boxes, as they were taken, are no farther apart than `margin` along any axis, m; each
    /// pair once.
    pub(super) fn pairs(&self, skin: &Skin, margin: f64, mut meet: impl FnMut(u32, u32)) {
        if self.nodes.is_empty() {
            return;
        }
        let mut stack = vec![(self.root, self.root)];
        while let Some((a, b)) = stack.pop() {
            let (p, q) = (&self.nodes[a as usize], &self.nodes[b as usize]);
            let is_one_side = !skin.meets_itself && p.side == q.side && p.side != MIXED;
            if is_one_side || !do_meet(&p.around, &widened(&q.around, margin)) {
                continue;
            }
            match (p.is_leaf, q.is_leaf) {
                (true, true) => {
                    for i in p.first..p.second {
                        for j in if a == b { i + 1 } else { q.first }..q.second {
                            let [i, j] = [i, j].map(|at| self.order[at as usize]);
                            if do_meet(&self.boxes[i as usize], &widened(&self.boxes[j as usize], margin)) {
                                meet(i, j);
                            }
                        }
                    }
                }
                (false, _) if a == b => stack.extend([(p.first, p.first), (p.second, p.second), (p.first, p.second)]),
                (false, true) => stack.extend([(p.first, b), (p.second, b)]),
                (true, false) => stack.extend([(a, q.first), (a, q.second)]),
                (false, false) => {
                    stack.extend([(p.first, q.first), (p.first, q.second), (p.second, q.first), (p.second, q.second)]);
                }
            }
        }
    }

    /// The triangle of a body that is nearest to a place, the first of equally near ones, and the square of
    /// the distance, if that is less than `square` (m²). A guess, the triangle that is nearest to another
    /// place nearby or [`NONE`], spares work and changes nothing.
    pub(super) fn nearest(
        &self,
        skin: &Skin,
        body: u32,
        x: Vector,
        (square, guess): (f64, u32),
        counts: impl Fn(u32) -> bool,
    ) -> Option<(f64, u32)> {
        let mut found = (square, NONE);
        if guess != NONE && skin.body(guess) == body && counts(guess) {
            let away = square_to_triangle(x, skin.corners(guess));
            if away < square {
                found = (away, guess);
            }
        }
        // Boxes round otherwise than triangles do.
        let away = |around: &Aabb<3>| square_away(&widened(around, self.grown), x) * (1.0 - ROUNDED);
        let (mut stack, mut count) = ([(0, 0.0); DEEPEST], 1);
        stack[0] = (self.roots[body as usize], 0.0);
        while count > 0 {
            count -= 1;
            let (number, least) = stack[count];
            if least > found.0 {
                continue;
            }
            let node = &self.nodes[number as usize];
            if node.is_leaf {
                for &facet in &self.order[node.first as usize..node.second as usize] {
                    if away(&self.boxes[facet as usize]) > found.0 {
                        continue;
                    }
                    for triangle in skin.facets[facet as usize].triangles().filter(|&triangle| counts(triangle)) {
                        let away = square_to_triangle(x, skin.corners(triangle));
                        if away < found.0 || (away == found.0 && triangle < found.1 && found.1 != NONE) {
                            found = (away, triangle);
                        }
                    }
                }
                continue;
            }
            let of = |child: u32| (child, away(&self.nodes[child as usize].around));
            let [a, b] = [node.first, node.second].map(of);
            // The nearer one first: it is on top.
            [stack[count], stack[count + 1]] = if a.1 < b.1 { [b, a] } else { [a, b] };
            count += 2;
        }
        (found.1 != NONE).then_some(found)
    }

    /// Triangles of a body whose leaves' boxes a ray meets.
    pub(super) fn along(&self, skin: &Skin, body: u32, from: Vector, direction: Vector, mut meet: impl FnMut(u32)) {
        let mut stack = vec![self.roots[body as usize]];
        while let Some(number) = stack.pop() {
            let node = &self.nodes[number as usize];
            if !meets_ray(&node.around, from, direction, f64::INFINITY) {
                continue;
            }
            if node.is_leaf {
                for &facet in &self.order[node.first as usize..node.second as usize] {
                    skin.facets[facet as usize].triangles().for_each(&mut meet);
                }
            } else {
                stack.extend([node.first, node.second]);
            }
        }
    }
}

/// Mean of vertices, m.
fn centre(skin: &Skin, vertices: &[u32]) -> Vector {
    let mut sum = [0.0; 3];
    for &vertex in vertices {
        (0..3).for_each(|d| sum[d] += skin.x[vertex as usize][d] / vertices.len() as f64);
    }
    sum
}
