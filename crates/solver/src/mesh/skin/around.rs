//! What is around a node of the middle of shells in 3D: corners of elements, how they follow each other
//! around the edges there, which of their sides look into the same sector, and which of them are a
//! smooth shell.
//!
//! Beyond symmetry planes are the images of the elements: each corner is there once for each operation of
//! symmetry, the own ones first. A corner has two sides, the lower one with the even number.

use super::arm::{Piece, add, arm, stand_on, within};
use crate::forest::{join, root};
use crate::rotation::{Square, applied, unit_matrix};
use crate::tensor::{cross, product};
use crate::vector::{any_tangent, dot, minus, plus, times, unit};

/// Most operations of symmetry at a node: those of a cube.
const MOST: usize = 48;
/// Difference up to which operations are the same.
const SAME_OPERATION: f64 = 1e-6;
/// Cosine above which an image lies on an element, and difference of cosines up to which neither of two
/// neighbours continues an element better.
const SAME_PLACE: f64 = 1.0 - 1e-10;
const EQUAL: f64 = 1e-9;

/// An element of shells.
pub(super) struct Shell {
    pub(super) group: usize,
    pub(super) element: usize,
    /// Cosine of the angle from which it has folds.
    pub(super) fold: f64,
}

/// A corner of an element: number of the element, which corner, unit normal, angle and faces there.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Corner {
    pub(super) shell: u32,
    pub(super) corner: usize,
    pub(super) normal: [f64; 3],
    pub(super) angle: f64,
    /// How far its lower and its upper face are from the node, m.
    pub(super) faces: [f64; 2],
}

/// An element at an edge, which its corners run along or against, and its direction from there.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Wing {
    pub(super) edge: [u32; 2],
    pub(super) shell: u32,
    pub(super) is_along: bool,
    pub(super) inward: [f64; 3],
}

/// An edge at a node, and its unit direction; its elements; normals of the symmetry planes that both of its
/// nodes are on.
pub(super) struct Edge<'a> {
    pub(super) axis: [f64; 3],
    pub(super) wings: &'a [Wing],
    pub(super) planes: Vec<[f64; 3]>,
}

/// A corner at an edge, or its image: its number, whether it runs along the edge, where it is.
#[derive(Clone, Copy)]
struct Blade {
    place: u32,
    is_along: bool,
    direction: [f64; 2],
    angle: f64,
}

impl Blade {
    /// Number of its side that looks along the angle or against it. Elements have their inside on the left of
    /// their edges, seen from above.
    fn side(&self, is_ahead: bool) -> u32 {
        2 * self.place + u32::from(is_ahead == self.is_along)
    }
}

/// The faces around a node: arms of their nodes, and of each own corner its direction and which of the arms
/// its lower and its upper side have.
#[derive(Default)]
pub(super) struct Faces {
    pub(super) arms: Vec<[f64; 3]>,
    pub(super) corners: Vec<([f64; 3], [usize; 2])>,
}

/// A node of the middle.
pub(super) struct Hub<'a> {
    shells: &'a [Shell],
    own: &'a [Corner],
    planes: &'a [[f64; 3]],
    operations: Vec<Square<3>>,
    /// Sides that look into the same sector, pair by pair and as disjoint sets.
    pairs: Vec<[u32; 2]>,
    sectors: Vec<u32>,
    /// Sides that are one smooth face.
    smooth: Vec<u32>,
}

impl<'a> Hub<'a> {
    /// From the corners at a node and the normals of the symmetry planes that it is on.
    pub(super) fn new(shells: &'a [Shell], own: &'a [Corner], planes: &'a [[f64; 3]]) -> Self {
        let operations = operations(planes);
        let sides: Vec<u32> = (0..2 * (own.len() * operations.len()) as u32).collect();
        Self { shells, own, planes, operations, pairs: Vec::new(), sectors: sides.clone(), smooth: sides }
    }

    /// Joins what follows each other around an edge; the number of elements and images there.
    pub(super) fn add_edge(&mut self, edge: &Edge<'_>) -> usize {
        let fan = self.fan(edge);
        if fan.len() > 1 {
            (0..fan.len()).for_each(|k| self.join_sides(fan[k].side(true), fan[(k + 1) % fan.len()].side(false), false));
        }
        let best: Vec<Option<usize>> = (0..fan.len()).map(|k| self.continuation(&fan, k)).collect();
        for (k, other) in best.iter().enumerate().filter_map(|(k, other)| Some((k, (*other)?))) {
            if k < other && best[other] == Some(k) {
                self.join_faces(&fan[k], &fan[other]);
            }
        }
        fan.len()
    }

    /// Elements and images around an edge, by their angle. An image that lies on an element, or on another
    /// image, is the same.
    fn fan(&mut self, edge: &Edge<'_>) -> Vec<Blade> {
        let across = any_tangent(edge.axis);
        let frame = [across, cross(edge.axis, across)];
        let mut fan: Vec<Blade> = Vec::new();
        for operation in operations(&edge.planes) {
            let Some(number) = self.number_of(&operation) else { continue };
            for wing in edge.wings {
                let Some(own) = self.own.iter().position(|corner| corner.shell == wing.shell) else { continue };
                let inward = applied(&operation, wing.inward);
                let direction = unit(frame.map(|axis| dot(axis, inward))).unwrap_or_default();
                let (place, angle) = ((number * self.own.len() + own) as u32, crate::angle::angle_of(direction));
                let blade = Blade { place, is_along: wing.is_along != is_mirrored(&operation), direction, angle };
                let same = fan.iter().find(|other| number > 0 && dot(other.direction, direction) > SAME_PLACE);
                if let Some(same) = same {
                    [true, false].into_iter().for_each(|ahead| self.join_sides(same.side(ahead), blade.side(ahead), true));
                } else {
                    fan.push(blade);
                }
            }
        }
        fan.sort_by(|a, b| a.angle.total_cmp(&b.angle).then(a.place.cmp(&b.place)));
        fan
    }

    /// Which of a fan continues one of them as a smooth shell: that which does it best.
    fn continuation(&self, fan: &[Blade], of: usize) -> Option<usize> {
        let cosine = |other: usize| {
            let [a, b] = [of, other].map(|k| self.normal(fan[k].place));
            if fan[of].is_along == fan[other].is_along { -dot(a, b) } else { dot(a, b) }
        };
        let all = || (0..fan.len()).filter(|&other| other != of);
        let best = all().reduce(|best, other| if cosine(other) > cosine(best) { other } else { best })?;
        let fold = [of, best].map(|k| self.shell(fan[k].place).fold);
        let is_alone = all().all(|other| other == best || cosine(other) < cosine(best) - EQUAL);
        (is_alone && cosine(best) >= fold[0].max(fold[1])).then_some(best)
    }

    /// Joins two sides, and all their images.
    fn join_sides(&mut self, a: u32, b: u32, is_one_face: bool) {
        for operation in 0..self.operations.len() {
            let [Some(a), Some(b)] = [a, b].map(|side| self.image(operation, side)) else { continue };
            self.pairs.push([a, b]);
            join(&mut self.sectors, a, b);
            if is_one_face {
                join(&mut self.smooth, a, b);
            }
        }
    }

    /// Joins the faces of two elements that continue each other, and all their images.
    fn join_faces(&mut self, one: &Blade, other: &Blade) {
        for ahead in [true, false] {
            for operation in 0..self.operations.len() {
                let sides = [one.side(ahead), other.side(!ahead)].map(|side| self.image(operation, side));
                if let [Some(a), Some(b)] = sides {
                    join(&mut self.smooth, a, b);
                }
            }
        }
    }

    /// Number of an operation.
    fn number_of(&self, operation: &Square<3>) -> Option<usize> {
        self.operations.iter().position(|other| is_same(operation, other))
    }

    /// Number of the image of a side.
    fn image(&self, operation: usize, side: u32) -> Option<u32> {
        if operation == 0 {
            return Some(side);
        }
        let sides = 2 * self.own.len() as u32;
        let after = &self.operations[(side / sides) as usize];
        let number = self.number_of(&product(&self.operations[operation], after))? as u32;
        Some(number * sides + side % sides)
    }

    fn shell(&self, place: u32) -> &Shell {
        &self.shells[self.own[place as usize % self.own.len()].shell as usize]
    }

    fn normal(&self, place: u32) -> [f64; 3] {
        let own = self.own.len();
        applied(&self.operations[place as usize / own], self.own[place as usize % own].normal)
    }

    /// Takes out of a vector what leads out of those symmetry planes of which the images of `sides` are among
    /// them.
    fn on_planes(&self, vector: [f64; 3], sides: &[u32]) -> [f64; 3] {
        let is_own_image = |plane: &&[f64; 3]| {
            let mirror = self.number_of(&reflection(**plane));
            let image = |&side: &u32| mirror.and_then(|mirror| self.image(mirror, side));
            sides.iter().filter_map(image).any(|image| sides.contains(&image))
        };
        self.planes.iter().filter(is_own_image).fold(vector, |vector, &plane| within(vector, plane))
    }

    /// The smooth face that each side belongs to.
    fn pieces(&self, faces: &Sets) -> Vec<Piece> {
        let mut pieces: Vec<Piece> = Vec::with_capacity(faces.all.len());
        for side in 0..faces.all.len() as u32 {
            let all = faces.of(side);
            let is_known = all[0] < side && !all.contains(&(side ^ 1));
            pieces.push(if is_known { pieces[all[0] as usize] } else { self.piece(all, side) });
        }
        pieces
    }

    /// The smooth face of some sides as one of them sees it: the mean direction of its corners, weighted by
    /// their angles.
    fn piece(&self, sides: &[u32], side: u32) -> Piece {
        let outward = |side: u32| if side % 2 == 1 { self.normal(side / 2) } else { times(-1.0, self.normal(side / 2)) };
        let (mut sum, mut weight, mut excess) = ([0.0; 3], 0.0, 0.0);
        let to = |side: u32| self.own[side as usize / 2 % self.own.len()].faces[side as usize % 2];
        let first = to(side);
        for &one in sides {
            let angle = self.own[one as usize / 2 % self.own.len()].angle;
            sum = plus(sum, times(angle, outward(one)));
            weight += angle;
            excess += angle * (to(one) - first);
        }
        let to_face = if let [one] = sides { Some(outward(*one)) } else { unit(self.on_planes(sum, sides)) };
        let half = if weight > 0.0 { first + excess / weight } else { first };
        Piece { to_face: to_face.unwrap_or_else(|| outward(side)), half }
    }

    /// Puts the nodes of the faces around the node.
    pub(super) fn faces(mut self) -> Faces {
        let (sectors, smooth) = (Sets::new(&mut self.sectors), Sets::new(&mut self.smooth));
        let pieces = self.pieces(&smooth);
        let own = self.own.len();
        let mut made = Faces::default();
        let mut arms = vec![usize::MAX; 2 * own];
        for side in 0..arms.len() as u32 {
            if arms[side as usize] != usize::MAX {
                continue;
            }
            for (sides, ground) in self.nodes_of(sectors.of(side)) {
                let is_own = |&&side: &&u32| (side as usize) < 2 * own;
                if !sides.iter().any(|side| is_own(&side)) {
                    continue; // beyond a symmetry plane
                }
                sides.iter().filter(is_own).for_each(|&side| arms[side as usize] = made.arms.len());
                let mut all = Vec::new();
                sides.iter().for_each(|&side| add(&mut all, pieces[side as usize]));
                let mut below = Vec::new();
                ground.iter().for_each(|&side| add(&mut below, pieces[side as usize]));
                below.into_iter().for_each(|piece| stand_on(&mut all, piece));
                made.arms.push(self.on_planes(arm(&all), &sides));
            }
        }
        made.corners = (0..own).map(|corner| (pieces[2 * corner + 1].to_face, [arms[2 * corner], arms[2 * corner + 1]])).collect();
        made
    }

    /// The nodes into which a sector is divided, each with its sides and those that it stands on: one, but
    /// where an element has both of its sides in it, as the end of a wall's foot on a plate.
    fn nodes_of(&self, sector: &[u32]) -> Vec<(Vec<u32>, Vec<u32>)> {
        let has_both = |sides: &[u32], side: u32| sides.contains(&(side ^ 1));
        let (walls, ground): (Vec<u32>, Vec<u32>) = sector.iter().partition(|&&side| has_both(sector, side));
        if walls.is_empty() {
            return vec![(ground, Vec::new())];
        }
        let mut sets: Vec<u32> = (0..self.sectors.len() as u32).collect();
        for &[a, b] in self.pairs.iter().filter(|pair| pair.iter().all(|side| walls.contains(side))) {
            join(&mut sets, a, b);
        }
        let sets = Sets::new(&mut sets);
        let mut nodes = Vec::new();
        for &side in walls.iter().filter(|&&side| sets.of(side)[0] == side) {
            let sides = sets.of(side);
            if sides.iter().any(|&side| has_both(sides, side)) {
                nodes.extend(sides.iter().map(|&side| (vec![side], ground.clone())));
            } else {
                nodes.push((sides.to_vec(), ground.clone()));
            }
        }
        if !ground.is_empty() {
            nodes.insert(0, (ground, Vec::new()));
        }
        nodes
    }
}

/// Disjoint sets of sides: the sides by their sets, ascending, and where the set of each begins and ends.
struct Sets {
    all: Vec<u32>,
    ranges: Vec<[u32; 2]>,
}

impl Sets {
    fn new(parents: &mut [u32]) -> Self {
        let roots: Vec<u32> = (0..parents.len() as u32).map(|side| root(parents, side)).collect();
        let mut all: Vec<u32> = (0..roots.len() as u32).collect();
        all.sort_by_key(|&side| roots[side as usize]);
        let mut ranges = vec![[0; 2]; roots.len()];
        let mut begin = 0;
        for set in all.chunk_by(|&a, &b| roots[a as usize] == roots[b as usize]) {
            let end = begin + set.len() as u32;
            set.iter().for_each(|&side| ranges[side as usize] = [begin, end]);
            begin = end;
        }
        Self { all, ranges }
    }

    /// The set of a side.
    fn of(&self, side: u32) -> &[u32] {
        let [begin, end] = self.ranges[side as usize];
        &self.all[begin as usize..end as usize]
    }
}

/// The reflection in a plane with a unit normal.
fn reflection(normal: [f64; 3]) -> Square<3> {
    unit_matrix::<3>().map(|axis| minus(axis, times(2.0 * dot(axis, normal), normal)))
}

/// The operations that reflections in planes generate; the first one changes nothing.
fn operations(planes: &[[f64; 3]]) -> Vec<Square<3>> {
    let mut all = vec![unit_matrix()];
    let mut next = 0;
    while next < all.len() {
        for mirror in planes.iter().map(|&normal| reflection(normal)) {
            let made = product(&mirror, &all[next]);
            if all.len() < MOST && !all.iter().any(|other| is_same(other, &made)) {
                all.push(made);
            }
        }
        next += 1;
    }
    all
}

fn is_same(a: &Square<3>, b: &Square<3>) -> bool {
    a.as_flattened().iter().zip(b.as_flattened()).all(|(a, b)| (a - b).abs() < SAME_OPERATION)
}

/// Whether an operation turns right into left.
fn is_mirrored(&[a, b, c]: &Square<3>) -> bool {
    dot(a, cross(b, c)) < 0.0
}
