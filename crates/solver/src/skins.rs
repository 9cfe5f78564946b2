//! Nodes on the faces of shells in a step: they go with nodes of the middle, at arms that rotate with these,
//! and hand on what pushes them as force and moment.
//!
//! So contact forces, pressures and friction act where the faces are, momentum and angular momentum are kept
//! to round-off, and nothing that acts on surfaces knows of shells.

use crate::angle::cos_sin_of;
use crate::mesh::{Mesh, Meshed, SkinNode};
use crate::rotation::Rotate;
use crate::rotations::Rotations;
use crate::tensor::{Dim, Matrix};
use crate::vector::{minus, plus};
use embate_lanes::{BATCH, Batch, Kernel, Lane, Level};

/// The nodes on the faces of the shells of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Skins<const D: usize> {
    /// Number of the first of them; they follow each other.
    first: usize,
    nodes: Vec<SkinNode<D>>,
    are_all_led: bool,
    /// Where the owner of each is among the nodes that rotate; `u32::MAX`: a rigid body leads it.
    places: Vec<u32>,
    /// Nodes of the middle that lead some, in the order of these.
    owners: Vec<Owner>,
}

/// A node of the middle that leads nodes which follow each other.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Owner {
    node: u32,
    /// Where it is among the nodes that rotate.
    place: u32,
    /// The first of those that it leads, among all of them, and the one after the last.
    from: u32,
    to: u32,
}

impl<const D: usize> Skins<D>
where
    Dim<D>: Meshed<D> + Rotate<D> + RotatedArm<D>,
{
    /// Those of a mesh; `is_led` says which nodes of the middle a rigid body leads, and their faces with
    /// them.
    pub(crate) fn new(mesh: &Mesh<D>, rotations: &Rotations, is_led: impl Fn(u32) -> bool) -> Self {
        let first = mesh.first_skin_node();
        let place = |skin: &SkinNode<D>| match rotations.place(skin.owner) {
            Some(place) if !is_led(skin.owner) => place as u32,
            _ => u32::MAX,
        };
        let places: Vec<u32> = mesh.skins.iter().map(place).collect();
        let mut owners: Vec<Owner> = Vec::new();
        for (own, (skin, &place)) in (0..).zip(mesh.skins.iter().zip(&places)).filter(|(_, (_, place))| **place != u32::MAX) {
            match owners.last_mut().filter(|last| last.node == skin.owner && last.to == own) {
                Some(last) => last.to += 1,
                None => owners.push(Owner { node: skin.owner, place, from: own, to: own + 1 }),
            }
        }
        let are_all_led = places.iter().all(|&place| place != u32::MAX);
        Self { first, nodes: mesh.skins.clone(), are_all_led, places, owners }
    }

    /// Each node that a node of the middle leads, with that, and its place among those that rotate.
    fn led(&self) -> impl Iterator<Item = (usize, &SkinNode<D>, usize)> {
        let all = (self.first..).zip(&self.nodes).zip(&self.places);
        all.filter(|(_, place)| **place != u32::MAX).map(|((node, skin), place)| (node, skin, *place as usize))
    }

    /// Velocities that they have now, with spins of the places (rad/s).
    pub(crate) fn spin(&self, spins: &[[f64; 3]], positions: &[[f64; D]], velocities: &mut [[f64; D]]) {
        for (node, skin, place) in self.led() {
            let owner = skin.owner as usize;
            velocities[node] = plus(velocities[owner], Dim::<D>::spin_velocity(spins[place], minus(positions[node], positions[owner])));
        }
    }

    /// Velocities that lead them over the coming step (s) to where the middle will have them, and these next
    /// positions: what was off by rounding comes back. `rotations` are those after it, as
    /// [`Rotations::numbers_at`] gives them. Returns the largest square of a speed.
    pub(crate) fn lead(
        &self,
        rotations: &[[f64; 4]],
        time_step: f64,
        positions: &[[f64; D]],
        velocities: &mut [[f64; D]],
        next: &mut [[f64; D]],
        level: Level,
    ) -> f64 {
        level.run(Lead { skins: self, rotations, time_step, positions, velocities, next })
    }

    /// Hands the forces on them over: to the middle, and their moments to the place there.
    pub(crate) fn hand_on(
        &self,
        positions: &[[f64; D]],
        force: impl Fn(usize) -> [f64; D],
        mut push: impl FnMut(u32, [f64; D], u32),
        moments: &mut [[f64; 3]],
    ) {
        for (node, skin, place) in self.led() {
            let force = force(node);
            if force == [0.0; D] {
                continue;
            }
            push(skin.owner, force, node as u32);
            let arm = minus(positions[node], positions[skin.owner as usize]);
            moments[place] = plus(moments[place], Dim::<D>::moment_vector(arm, force));
        }
    }
}

impl<const D: usize> Skins<D> {
    /// Whether there is none.
    pub(crate) fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Whether these nodes are all on faces and led by the middle.
    #[inline]
    pub(crate) fn leads(&self, nodes: std::ops::Range<usize>) -> bool {
        self.are_all_led && nodes.start >= self.first && nodes.end <= self.first + self.nodes.len()
    }

    /// The node of the middle that a node goes with, and where that is among the nodes that rotate; `None`:
    /// it is none of a face, or a rigid body leads it.
    #[inline]
    pub(crate) fn carrier(&self, node: usize) -> Option<(u32, usize)> {
        let own = node.checked_sub(self.first)?;
        let place = *self.places.get(own)?;
        (place != u32::MAX).then(|| (self.nodes[own].owner, place as usize))
    }
}

/// [`Skins::lead`], eight owners at a time.
struct Lead<'a, const D: usize> {
    skins: &'a Skins<D>,
    rotations: &'a [[f64; 4]],
    time_step: f64,
    positions: &'a [[f64; D]],
    velocities: &'a mut [[f64; D]],
    next: &'a mut [[f64; D]],
}

impl<const D: usize> Kernel for Lead<'_, D>
where
    Dim<D>: RotatedArm<D>,
{
    type Output = f64;

    #[inline(always)]
    fn run<L: Lane>(self) -> f64 {
        let Self { skins, rotations, time_step, positions, velocities, next } = self;
        let (rate, mut fastest) = (1.0 / time_step, 0.0);
        for owners in skins.owners.chunks(BATCH) {
            let mut numbers = [[0.0; 4]; BATCH];
            for (lane, owner) in owners.iter().enumerate() {
                numbers[lane] = rotations[owner.place as usize];
            }
            let mut turns = [[Batch::default(); D]; D];
            for at in (0..BATCH).step_by(L::WIDTH) {
                let turn: Matrix<L, D> = Dim::<D>::turn(L::load_points(&numbers, at));
                for i in 0..D {
                    for k in 0..D {
                        turn[i][k].store(&mut turns[i][k], at);
                    }
                }
            }
            // One by one: to bring them side by side takes longer.
            for (lane, owner) in owners.iter().enumerate() {
                let (centre, of_centre) = (positions[owner.node as usize], velocities[owner.node as usize]);
                for own in owner.from as usize..owner.to as usize {
                    let (node, arm) = (skins.first + own, skins.nodes[own].arm);
                    let (x, mut v, mut there) = (positions[node], of_centre, positions[node]);
                    let mut square = 0.0;
                    for i in 0..D {
                        let mut turned = 0.0;
                        for k in 0..D {
                            turned += turns[i][k].0[lane] * arm[k];
                        }
                        v[i] += rate * (turned - (x[i] - centre[i]));
                        there[i] += time_step * v[i];
                        square += v[i] * v[i];
                    }
                    (velocities[node], next[node]) = (v, there);
                    fastest = if square > fastest { square } else { fastest };
                }
            }
        }
        fastest
    }
}

/// How arms rotate with nodes.
pub trait RotatedArm<const D: usize> {
    /// The matrix of a rotation: in 3D of a unit quaternion, in 2D of the first number, an angle.
    fn turn<L: Lane>(numbers: [L; 4]) -> Matrix<L, D>;
}

impl RotatedArm<2> for Dim<2> {
    #[inline(always)]
    fn turn<L: Lane>([angle, ..]: [L; 4]) -> Matrix<L, 2> {
        let [cos, sin] = cos_sin_of(angle);
        [[cos, -sin], [sin, cos]]
    }
}

impl RotatedArm<3> for Dim<3> {
    #[inline(always)]
    fn turn<L: Lane>([w, x, y, z]: [L; 4]) -> Matrix<L, 3> {
        let (one, two) = (L::splat(1.0), L::splat(2.0));
        [
            [one - two * (y * y + z * z), two * (x * y - w * z), two * (x * z + w * y)],
            [two * (x * y + w * z), one - two * (x * x + z * z), two * (y * z - w * x)],
            [two * (x * z - w * y), two * (y * z + w * x), one - two * (x * x + y * y)],
        ]
    }
}
