//! Nodes on the faces of shells in a step: they go with nodes of the middle, at arms that rotate with these,
//! and hand on what pushes them as force and moment.
//!
//! So contact forces, pressures and friction act where the faces are, momentum and angular momentum are kept
//! to round-off, and nothing that acts on surfaces knows of shells.

use crate::angle::{cos_sin, cos_sin_of};
use crate::mesh::{Mesh, Meshed, SkinNode};
use crate::rotation::{Rotate, Square, applied, unit_matrix};
use crate::rotations::Rotations;
use crate::tensor::Dim;
use crate::vector::{minus, plus};

/// The nodes on the faces of the shells of a model.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Skins<const D: usize> {
    /// Number of the first of them; they follow each other.
    first: usize,
    nodes: Vec<SkinNode<D>>,
    /// Where the owner of each is among the nodes that rotate; `u32::MAX`: a rigid body leads it.
    places: Vec<u32>,
}

impl<const D: usize> Default for Skins<D> {
    fn default() -> Self {
        Self { first: 0, nodes: Vec::new(), places: Vec::new() }
    }
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
        let places = mesh.skins.iter().map(place).collect();
        Self { first, nodes: mesh.skins.clone(), places }
    }

    /// Each node that a node of the middle leads, with that, and its place among those that rotate.
    fn led(&self) -> impl Iterator<Item = (usize, &SkinNode<D>, usize)> {
        let all = (self.first..).zip(&self.nodes).zip(&self.places);
        all.filter(|(_, place)| **place != u32::MAX).map(|((node, skin), place)| (node, skin, *place as usize))
    }

    /// Puts all where the middle says.
    pub(crate) fn place(&self, rotations: &Rotations, positions: &mut [[f64; D]]) {
        // Nodes of one owner follow each other.
        let mut last = (usize::MAX, unit_matrix());
        for (node, skin, place) in self.led() {
            if place != last.0 {
                last = (place, Dim::<D>::turn(rotations, place));
            }
            positions[node] = plus(positions[skin.owner as usize], applied(&last.1, skin.arm));
        }
    }

    /// Velocities that lead them over a step (s) to where the middle will have them; without a step those
    /// that they have now.
    pub(crate) fn lead(&self, rotations: &Rotations, time_step: f64, positions: &[[f64; D]], velocities: &mut [[f64; D]]) {
        let mut last = (usize::MAX, unit_matrix());
        for (node, skin, place) in self.led() {
            if place != last.0 {
                last = (place, Dim::<D>::chord(rotations.spins[place], time_step));
            }
            let arm = minus(positions[node], positions[skin.owner as usize]);
            velocities[node] = plus(velocities[skin.owner as usize], applied(&last.1, arm));
        }
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

    /// The node of the middle that a node goes with, and where that is among the nodes that rotate; `None`:
    /// it is none of a face, or a rigid body leads it.
    #[inline]
    pub(crate) fn carrier(&self, node: usize) -> Option<(u32, usize)> {
        let own = node.checked_sub(self.first)?;
        let place = *self.places.get(own)?;
        (place != u32::MAX).then(|| (self.nodes[own].owner, place as usize))
    }
}

/// How arms rotate with nodes.
pub trait RotatedArm<const D: usize> {
    /// Rotation of the node at a place since the start, as a matrix.
    fn turn(rotations: &Rotations, place: usize) -> Square<D>;
    /// With the arm of now the velocity that leads it over a step (s) at a spin (rad/s): (exp(dt ω) − 1)/dt;
    /// without a step ω ×.
    fn chord(spin: [f64; 3], time_step: f64) -> Square<D>;
}

impl RotatedArm<2> for Dim<2> {
    fn turn(rotations: &Rotations, place: usize) -> Square<2> {
        let [cos, sin] = cos_sin_of(rotations.angles[place]);
        [[cos, -sin], [sin, cos]]
    }
    fn chord([_, _, spin]: [f64; 3], time_step: f64) -> Square<2> {
        if time_step == 0.0 {
            return [[0.0, -spin], [spin, 0.0]];
        }
        // cos θ − 1 = −2 sin²(θ/2), sin θ = 2 sin(θ/2) cos(θ/2).
        let [cos, sin] = cos_sin_of(0.5 * time_step * spin);
        let (along, across) = (-2.0 * sin * sin / time_step, 2.0 * sin * cos / time_step);
        [[along, -across], [across, along]]
    }
}

impl RotatedArm<3> for Dim<3> {
    fn turn(rotations: &Rotations, place: usize) -> Square<3> {
        rotations.attitudes[place].matrix()
    }
    fn chord([x, y, z]: [f64; 3], time_step: f64) -> Square<3> {
        let sweep = |f: f64| [[0.0, -f * z, f * y], [f * z, 0.0, -f * x], [-f * y, f * x, 0.0]];
        let size = (x * x + y * y + z * z).sqrt();
        if time_step == 0.0 || size == 0.0 {
            return sweep(1.0);
        }
        // sin θ (a ×) − (1 − cos θ) (1 − a aᵀ) with the axis a = ω/|ω|.
        let [cos, sin] = cos_sin(0.5 * time_step * size);
        let (across, along) = (2.0 * sin * cos / (time_step * size), 2.0 * sin * sin / (time_step * size * size));
        let mut chord = sweep(across);
        let spin = [x, y, z];
        for (i, row) in chord.iter_mut().enumerate() {
            for (j, value) in row.iter_mut().enumerate() {
                *value += along * spin[i] * spin[j];
            }
            row[i] -= along * size * size;
        }
        chord
    }
}
