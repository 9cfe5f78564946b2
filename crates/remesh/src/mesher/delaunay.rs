//! Triangles between closed outlines: a constrained Delaunay triangulation, refined until sizes and angles
//! are good.
//!
//! Outlines come from the polygon. Triangulation and predicates are those of the crate `spade`, whose
//! insertions use nothing but the four operations (its own refinement takes logarithms of the platform and is
//! not used): the same mesh on every machine. Source: Ruppert, J. Algorithms 18 (1995) 548-585: split edges
//! that a vertex encroaches upon, then put vertices into the circumcentres of bad triangles, the worst first.
//! Edges that meet in less than 60 degrees do not encroach upon each other there (Miller, Pav & Walkington
//! 2003).

use crate::plane::{Point, cross, distance, dot, minus, on_line};
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};
use std::collections::{BTreeMap, BinaryHeap};

/// Circumradius by wanted edge length above which a triangle is too large; 0.577 is that of an equilateral
/// one.
const LARGE: f64 = 0.72;
/// Circumradius by shortest edge above which a triangle is too thin: smallest angle 25.8 degrees.
const THIN: f64 = 1.15;
/// Rounds of smoothing.
const ROUNDS: usize = 5;

/// What became of the outlines.
#[derive(Clone, Debug)]
pub struct Triangles {
    /// Places of the nodes, m.
    pub positions: Vec<Point>,
    /// Nodes of each triangle, counter-clockwise.
    pub triangles: Vec<[u32; 3]>,
    /// Nodes along each edge of each outline, in its direction, both ends included.
    pub edges: Vec<Vec<u32>>,
}

/// The triangles between `outlines`, of which each has the body on its left, with edges about as long as
/// `size` says. `None` when more than `limit` vertices would be needed.
#[must_use]
pub fn triangles(outlines: &[Vec<Point>], size: &dyn Fn(Point) -> f64, limit: usize) -> Option<Triangles> {
    let mut mesher = Mesher::new(outlines, size, limit, false)?;
    mesher.refine()?;
    Some(mesher.finish())
}

/// The same between outlines whose edges are about as long as they should be. Triangles between the edges of
/// a sharp corner stay as they are. With `held` no vertex is put on the outlines, which makes perhaps for
/// worse triangles.
pub(super) fn triangles_within(outlines: &[Vec<Point>], size: &dyn Fn(Point) -> f64, limit: usize, held: bool) -> Option<Triangles> {
    let mut mesher = Mesher::new(outlines, size, limit, held)?;
    mesher.edges_at = Some(mesher.meeting());
    mesher.refine()?;
    Some(mesher.finish())
}

/// Whether a point is inside, by the number of edges to its right.
#[must_use]
pub fn is_inside(outlines: &[Vec<Point>], x: Point) -> bool {
    let edges = outlines.iter().flat_map(|outline| (0..outline.len()).map(|k| [outline[k], outline[(k + 1) % outline.len()]]));
    let is_right = |[a, b]: &[Point; 2]| (a[1] > x[1]) != (b[1] > x[1]) && x[0] < a[0] + (x[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
    edges.filter(is_right).count() % 2 == 1
}

/// A piece of an outline's edge, the body on its left.
#[derive(Clone, Copy)]
struct Segment {
    ends: [u32; 2],
    edge: u32,
}

/// A triangle that may be bad: how bad it was, and its vertices.
type Candidate = (u64, [u32; 3]);

struct Mesher<'a> {
    outlines: &'a [Vec<Point>],
    size: &'a dyn Fn(Point) -> f64,
    limit: usize,
    /// Whether outlines must not be divided.
    held: bool,
    cdt: ConstrainedDelaunayTriangulation<Point2<f64>>,
    positions: Vec<Point>,
    /// Edge of each vertex on an outline; `None` inside and at corners.
    edge_of: Vec<Option<u32>>,
    /// For each edge its ends, and the edges that meet it in less than 60 degrees.
    corners: Vec<[u32; 2]>,
    acute: Vec<Vec<u32>>,
    /// For each corner the two edges there, if triangles between sharp edges are to stay.
    edges_at: Option<BTreeMap<u32, [u32; 2]>>,
    /// Pieces by their ends, the lower one first.
    segments: BTreeMap<[u32; 2], Segment>,
    /// Pieces by the cell of a grid that their middle is in.
    cells: BTreeMap<[i64; 2], Vec<Segment>>,
    cell: f64,
    queue: BinaryHeap<Candidate>,
}

impl<'a> Mesher<'a> {
    fn new(outlines: &'a [Vec<Point>], size: &'a dyn Fn(Point) -> f64, limit: usize, held: bool) -> Option<Self> {
        let mut mesher = Self {
            outlines,
            size,
            limit,
            held,
            cdt: ConstrainedDelaunayTriangulation::new(),
            positions: Vec::new(),
            edge_of: Vec::new(),
            corners: Vec::new(),
            acute: Vec::new(),
            edges_at: None,
            segments: BTreeMap::new(),
            cells: BTreeMap::new(),
            cell: 0.0,
            queue: BinaryHeap::new(),
        };
        let mut segments = Vec::new();
        for outline in outlines {
            let corners: Option<Vec<u32>> = outline.iter().map(|&x| mesher.insert(x, None, None)).collect();
            let (corners, n) = (corners?, outline.len());
            let first = mesher.corners.len() as u32;
            for k in 0..n {
                let [a, b] = [outline[k], outline[(k + 1) % n]];
                let edge = first + k as u32;
                let mut nodes = vec![corners[k]];
                for x in mesher.divided(a, b)? {
                    let last = nodes[nodes.len() - 1];
                    nodes.push(mesher.insert(x, Some(edge), Some(last))?);
                }
                nodes.push(corners[(k + 1) % n]);
                segments.extend(nodes.windows(2).map(|pair| Segment { ends: [pair[0], pair[1]], edge }));
                mesher.corners.push([corners[k], corners[(k + 1) % n]]);
                let is_acute = |k: usize| {
                    let x = |k: usize| outline[k % n];
                    let (back, on) = (minus(x(k + n - 1), x(k)), minus(x(k + 1), x(k)));
                    2.0 * dot(back, on) > (1.0 - 1e-9) * (dot(back, back) * dot(on, on)).sqrt()
                };
                let neighbours = [(is_acute(k), (k + n - 1) % n), (is_acute(k + 1), (k + 1) % n)];
                mesher.acute.push(neighbours.iter().filter(|(acute, _)| *acute).map(|&(_, k)| first + k as u32).collect());
            }
        }
        mesher.cell = segments.iter().map(|it| mesher.length(it.ends)).fold(0.0, f64::max);
        for segment in segments {
            mesher.add(segment)?;
        }
        Some(mesher)
    }

    /// Points that divide a line into pieces as long as the size says: equal parts of ∫ ds / h.
    fn divided(&self, a: Point, b: Point) -> Option<Vec<Point>> {
        const SAMPLES: usize = 512;
        if self.held {
            return Some(Vec::new());
        }
        let length = distance(a, b);
        let mut sums = vec![0.0];
        for k in 0..SAMPLES {
            let middle = on_line(a, b, (k as f64 + 0.5) / SAMPLES as f64);
            sums.push(sums[k] + length / SAMPLES as f64 / (self.size)(middle));
        }
        let count = sums[SAMPLES].round().max(1.0);
        if count > self.limit as f64 {
            return None;
        }
        let uniform = (sums[1] * SAMPLES as f64 - sums[SAMPLES]).abs() < 1e-9 * sums[SAMPLES];
        let at = |i: usize| {
            if uniform {
                return on_line(a, b, i as f64 / count);
            }
            let wanted = sums[SAMPLES] * i as f64 / count;
            let k = sums.partition_point(|&sum| sum <= wanted).clamp(1, SAMPLES);
            on_line(a, b, ((k - 1) as f64 + (wanted - sums[k - 1]) / (sums[k] - sums[k - 1])) / SAMPLES as f64)
        };
        Some((1..count as usize).map(at).collect())
    }

    /// Adds a vertex, looked for from `near` on; `None` at the limit, or where one is already.
    fn insert(&mut self, [x, y]: Point, edge: Option<u32>, near: Option<u32>) -> Option<u32> {
        let number = self.positions.len();
        let near = near.unwrap_or(0);
        let handle = match number {
            0 => self.cdt.insert(Point2::new(x, y)),
            _ => self.cdt.insert_with_hint(Point2::new(x, y), FixedVertexHandle::from_index(near as usize)),
        };
        let handle = handle.ok()?;
        if number >= self.limit || handle.index() != number {
            return None;
        }
        self.positions.push([x, y]);
        self.edge_of.push(edge);
        Some(number as u32)
    }

    fn length(&self, [a, b]: [u32; 2]) -> f64 {
        distance(self.positions[a as usize], self.positions[b as usize])
    }

    fn middle(&self, [a, b]: [u32; 2]) -> Point {
        on_line(self.positions[a as usize], self.positions[b as usize], 0.5)
    }

    fn cell_of(&self, x: Point) -> [i64; 2] {
        x.map(|x| (x / self.cell).floor() as i64)
    }

    /// Adds a piece of an outline; `None` where it can't be.
    fn add(&mut self, segment: Segment) -> Option<()> {
        let [a, b] = segment.ends;
        let [from, to] = segment.ends.map(|node| FixedVertexHandle::from_index(node as usize));
        if self.cdt.try_add_constraint(from, to).is_empty() {
            return None;
        }
        self.segments.insert([a.min(b), a.max(b)], segment);
        let cell = self.cell_of(self.middle(segment.ends));
        self.cells.entry(cell).or_default().push(segment);
        Some(())
    }

    fn refine(&mut self) -> Option<()> {
        if !self.held {
            let mut encroached: Vec<Segment> = self.segments.values().copied().collect();
            self.split_all(&mut encroached)?;
        }
        for k in 0..self.positions.len() {
            self.queue_around(k as u32);
        }
        while let Some((_, nodes)) = self.queue.pop() {
            if !self.is_there(nodes) || self.badness(nodes).is_none() {
                continue;
            }
            let centre = self.circumcentre(nodes);
            let mut near = self.encroached_by(centre);
            if near.is_empty() {
                if is_inside(self.outlines, centre) {
                    let vertex = self.insert(centre, None, Some(nodes[0]))?;
                    self.queue_around(vertex);
                }
                continue;
            }
            if self.held {
                continue;
            }
            for segment in &near {
                self.split(*segment)?;
            }
            self.split_all(&mut near)?;
            self.queue_triangle(nodes);
        }
        Some(())
    }

    /// Splits pieces while vertices are in their circles; `list` are those that may be so.
    fn split_all(&mut self, list: &mut Vec<Segment>) -> Option<()> {
        while let Some(segment) = list.pop() {
            if !self.is_alive(&segment) || !self.is_encroached(&segment) {
                continue;
            }
            list.extend(self.split(segment)?);
        }
        Some(())
    }

    fn is_alive(&self, segment: &Segment) -> bool {
        let [a, b] = segment.ends;
        self.segments.contains_key(&[a.min(b), a.max(b)])
    }

    /// Whether the vertex opposite a piece, on the body's side, is in its circle, or the piece is much too
    /// long.
    fn is_encroached(&self, segment: &Segment) -> bool {
        if self.length(segment.ends) > 1.6 * (self.size)(self.middle(segment.ends)) {
            return true;
        }
        let [from, to] = segment.ends.map(|node| FixedVertexHandle::from_index(node as usize));
        let opposite = self.cdt.get_edge_from_neighbors(from, to).and_then(|edge| edge.opposite_vertex());
        opposite.is_some_and(|vertex| {
            let node = vertex.fix().index();
            self.is_in_circle(segment, self.positions[node]) && !self.meets_acutely(segment.edge, node as u32)
        })
    }

    fn is_in_circle(&self, segment: &Segment, x: Point) -> bool {
        let [a, b] = segment.ends.map(|node| minus(self.positions[node as usize], x));
        dot(a, b) < -1e-12 * (dot(a, a) + dot(b, b))
    }

    /// Whether a vertex lies on an edge that meets `edge` in a sharp corner.
    fn meets_acutely(&self, edge: u32, node: u32) -> bool {
        let acute = &self.acute[edge as usize];
        match self.edge_of[node as usize] {
            Some(other) => acute.contains(&other),
            None => acute.iter().any(|&other| self.corners[other as usize].contains(&node)),
        }
    }

    /// Splits a piece in the middle; the pieces that may be encroached upon then.
    fn split(&mut self, segment: Segment) -> Option<Vec<Segment>> {
        let [a, b] = segment.ends;
        if self.segments.remove(&[a.min(b), a.max(b)]).is_none() {
            return Some(Vec::new());
        }
        let middle = self.middle(segment.ends);
        let cell = self.cell_of(middle);
        if let Some(list) = self.cells.get_mut(&cell) {
            list.retain(|other| other.ends != segment.ends);
        }
        let [from, to] = segment.ends.map(|node| FixedVertexHandle::from_index(node as usize));
        let edge = self.cdt.get_edge_from_neighbors(from, to)?.as_undirected().fix();
        self.cdt.remove_constraint_edge(edge);
        let vertex = self.insert(middle, Some(segment.edge), Some(a))?;
        let halves = [[a, vertex], [vertex, b]].map(|ends| Segment { ends, edge: segment.edge });
        for half in halves {
            self.add(half)?;
        }
        self.queue_around(vertex);
        let mut touched = halves.to_vec();
        for edge in self.cdt.vertex(FixedVertexHandle::from_index(vertex as usize)).out_edges() {
            let [a, b] = edge.next().vertices().map(|vertex| vertex.fix().index() as u32);
            touched.extend(self.segments.get(&[a.min(b), a.max(b)]));
        }
        Some(touched)
    }

    /// Pieces in whose circles a point is.
    fn encroached_by(&self, x: Point) -> Vec<Segment> {
        let [i, j] = self.cell_of(x);
        let mut found: Vec<Segment> = Vec::new();
        for cell in (-1..=1).flat_map(|di| (-1..=1).map(move |dj| [i.saturating_add(di), j.saturating_add(dj)])) {
            found.extend(self.cells.get(&cell).into_iter().flatten().filter(|segment| self.is_in_circle(segment, x)));
        }
        found.sort_unstable_by_key(|segment| segment.ends);
        found
    }

    fn is_there(&self, [a, b, c]: [u32; 3]) -> bool {
        let [from, to] = [a, b].map(|node| FixedVertexHandle::from_index(node as usize));
        let edge = self.cdt.get_edge_from_neighbors(from, to);
        edge.and_then(|edge| edge.opposite_vertex()).is_some_and(|vertex| vertex.fix().index() == c as usize)
    }

    fn queue_around(&mut self, node: u32) {
        let faces = self.cdt.vertex(FixedVertexHandle::from_index(node as usize)).out_edges().filter_map(|edge| {
            let face = edge.face().as_inner()?;
            Some(face.vertices().map(|vertex| vertex.fix().index() as u32))
        });
        for nodes in faces.collect::<Vec<_>>() {
            self.queue_triangle(nodes);
        }
    }

    fn queue_triangle(&mut self, nodes: [u32; 3]) {
        let [a, b, c] = nodes.map(|node| self.positions[node as usize]);
        let centre = [0, 1].map(|d| (a[d] + b[d] + c[d]) / 3.0);
        if let Some(badness) = self.badness(nodes).filter(|_| is_inside(self.outlines, centre)) {
            // Bits of positive numbers are ordered as the numbers are.
            self.queue.push((badness.to_bits(), nodes));
        }
    }

    /// How much too large or too thin a triangle is; `None`: it is good, or can't be fixed.
    fn badness(&self, nodes: [u32; 3]) -> Option<f64> {
        let edges = self.edge_of[nodes[0] as usize];
        if edges.is_some() && nodes.iter().all(|&node| self.edge_of[node as usize] == edges) {
            return None; // rounding of points on one line
        }
        let x = nodes.map(|node| self.positions[node as usize]);
        let lengths: [f64; 3] = std::array::from_fn(|k| distance(x[(k + 1) % 3], x[(k + 2) % 3]));
        let radius = lengths.iter().product::<f64>() / (2.0 * cross(minus(x[1], x[0]), minus(x[2], x[0])));
        let wanted = (self.size)([0, 1].map(|d| (x[0][d] + x[1][d] + x[2][d]) / 3.0));
        let large = radius / (LARGE * wanted);
        if large > 1.0 {
            return Some(1e3 * large);
        }
        let short = (0..3).reduce(|a, b| if lengths[b] < lengths[a] { b } else { a })?;
        let thin = radius / (THIN * lengths[short]);
        // The shortest edge between two sharp edges must stay.
        let [a, b] = [nodes[(short + 1) % 3], nodes[(short + 2) % 3]];
        let stays = [(a, b), (b, a)].iter().any(|&(on, other)| {
            self.edge_of[on as usize].is_some_and(|edge| !self.acute[edge as usize].is_empty() && self.meets_acutely(edge, other))
        });
        (thin > 1.0 && !stays && !self.is_between_sharp([a, b])).then_some(thin)
    }

    /// Whether two vertices, corners among them, are on two edges that meet in a sharp corner.
    fn is_between_sharp(&self, ends: [u32; 2]) -> bool {
        let Some(edges_at) = &self.edges_at else { return false };
        let [one, other] = ends.map(|node| match self.edge_of[node as usize] {
            Some(edge) => [edge; 2],
            None => edges_at.get(&node).copied().unwrap_or([u32::MAX; 2]),
        });
        one.iter().filter_map(|&edge| self.acute.get(edge as usize)).any(|acute| other.iter().any(|edge| acute.contains(edge)))
    }

    fn meeting(&self) -> BTreeMap<u32, [u32; 2]> {
        let mut meeting: BTreeMap<u32, [u32; 2]> = BTreeMap::new();
        for (edge, &[a, b]) in (0..).zip(&self.corners) {
            meeting.entry(a).or_insert([edge; 2])[0] = edge;
            meeting.entry(b).or_insert([edge; 2])[1] = edge;
        }
        meeting
    }

    fn circumcentre(&self, nodes: [u32; 3]) -> Point {
        let [a, b, c] = nodes.map(|node| self.positions[node as usize]);
        let (ab, ac) = (minus(b, a), minus(c, a));
        let twice = 2.0 * cross(ab, ac);
        [a[0] + (dot(ab, ab) * ac[1] - dot(ac, ac) * ab[1]) / twice, a[1] + (dot(ac, ac) * ab[0] - dot(ab, ab) * ac[0]) / twice]
    }

    fn finish(mut self) -> Triangles {
        let triangles = self.inside();
        self.smooth(&triangles);
        let mut edges: Vec<Vec<u32>> = self.corners.iter().map(|&[a, b]| vec![a, b]).collect();
        for (node, edge) in (0..).zip(&self.edge_of) {
            if let Some(edge) = edge {
                edges[*edge as usize].push(node);
            }
        }
        for (nodes, &[a, b]) in edges.iter_mut().zip(&self.corners) {
            let along = minus(self.positions[b as usize], self.positions[a as usize]);
            let place = |node: u32| dot(along, minus(self.positions[node as usize], self.positions[a as usize]));
            nodes.sort_by(|&one, &other| place(one).total_cmp(&place(other)));
        }
        Triangles { positions: self.positions, triangles, edges }
    }

    /// The triangles on the left of the outlines, in the order in which they are reached.
    fn inside(&self) -> Vec<[u32; 3]> {
        let mut seen = vec![false; self.cdt.num_all_faces()];
        let mut triangles = Vec::new();
        let mut stack = Vec::new();
        for segment in self.segments.values() {
            let [from, to] = segment.ends.map(|node| FixedVertexHandle::from_index(node as usize));
            stack.extend(self.cdt.get_edge_from_neighbors(from, to).map(|edge| edge.fix()));
            while let Some(edge) = stack.pop() {
                let edge = self.cdt.directed_edge(edge);
                let Some(face) = edge.face().as_inner() else { continue };
                if std::mem::replace(&mut seen[face.fix().index()], true) {
                    continue;
                }
                triangles.push(face.vertices().map(|vertex| vertex.fix().index() as u32));
                stack.extend(face.adjacent_edges().iter().filter(|edge| !edge.is_constraint_edge()).map(|edge| edge.rev().fix()));
            }
        }
        triangles
    }

    /// Moves vertices inside to the mean of their neighbours where that makes the worst triangle around them
    /// better.
    fn smooth(&mut self, triangles: &[[u32; 3]]) {
        let mut around: Vec<Vec<[u32; 2]>> = vec![Vec::new(); self.positions.len()];
        for &[a, b, c] in triangles {
            for [node, next, last] in [[a, b, c], [b, c, a], [c, a, b]] {
                around[node as usize].push([next, last]);
            }
        }
        let on_outline: Vec<bool> = {
            let mut on = vec![false; self.positions.len()];
            self.segments.values().flat_map(|segment| segment.ends).for_each(|node| on[node as usize] = true);
            on
        };
        for _ in 0..ROUNDS {
            for node in 0..self.positions.len() {
                if on_outline[node] || around[node].is_empty() {
                    continue;
                }
                let worst = |x: Point| {
                    let of = around[node].iter().map(|pair| form([x, self.positions[pair[0] as usize], self.positions[pair[1] as usize]]));
                    of.fold(f64::INFINITY, f64::min)
                };
                // Each neighbour is the next one of one triangle.
                let count = around[node].len() as f64;
                let mean = [0, 1].map(|d| around[node].iter().map(|pair| self.positions[pair[0] as usize][d]).sum::<f64>() / count);
                if worst(mean) > worst(self.positions[node]) {
                    self.positions[node] = mean;
                }
            }
        }
    }
}

/// Area over the sum of squared edges: the larger, the nearer to equilateral; negative for a triangle inside
/// out.
fn form([a, b, c]: [Point; 3]) -> f64 {
    let edges = [minus(b, a), minus(c, b), minus(a, c)];
    cross(edges[0], minus(c, a)) / edges.iter().map(|&edge| dot(edge, edge)).sum::<f64>()
}
