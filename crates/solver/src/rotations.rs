//! Nodes with rotational degrees of freedom, as elements see them: a sparse list beside the positions.
//!
//! Every such node has an attitude, its rotation since the start, and a spin; its moment of inertia is the
//! same about all axes, so that the spin changes by I⁻¹ times the moment and no gyroscopic term appears.
//! Blocks that have rotations read this list and leave moments in slots of their own; the update is in
//! `step/rotations.rs`. The list is empty in models without such blocks.

use crate::rigid::space::Attitude;
use std::collections::BTreeSet;

/// The nodes that rotate, and how far and fast.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rotations {
    /// The nodes, ascending.
    pub nodes: Vec<u32>,
    /// Of 2D models: rotation of each node since the start, rad, counter-clockwise. Empty in 3D.
    pub angles: Vec<f64>,
    /// Of 3D models: rotation of each node since the start. Empty in 2D.
    pub attitudes: Vec<Attitude>,
    /// Spins ω of the step that led to these rotations, rad/s, about x, y and z; in 2D the third alone.
    pub spins: Vec<[f64; 3]>,
}

impl Rotations {
    /// No node rotates.
    pub const NONE: &'static Self = &Self { nodes: Vec::new(), angles: Vec::new(), attitudes: Vec::new(), spins: Vec::new() };

    /// Nodes of a model of `dimension` (in any order, any number of times) at rest in their first place.
    #[must_use]
    pub fn at_rest(nodes: impl IntoIterator<Item = u32>, dimension: usize) -> Self {
        let nodes: Vec<u32> = BTreeSet::from_iter(nodes).into_iter().collect();
        let count = nodes.len();
        let (angles, attitudes) = if dimension == 2 { (count, 0) } else { (0, count) };
        Self { nodes, angles: vec![0.0; angles], attitudes: vec![Attitude::default(); attitudes], spins: vec![[0.0; 3]; count] }
    }

    /// Where a node is in the lists; `None`: it has no rotation.
    #[must_use]
    pub fn place(&self, node: u32) -> Option<usize> {
        self.nodes.binary_search(&node).ok()
    }

    /// Spin of a node, rad/s; zero where it has no rotation.
    #[must_use]
    pub fn spin(&self, node: u32) -> [f64; 3] {
        self.place(node).map_or([0.0; 3], |place| self.spins[place])
    }

    /// Whether no node rotates.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// What kernels take for the rotation at a place: in 3D its unit quaternion, in 2D its angle alone; no
    /// rotation where there is no such place.
    #[inline(always)]
    pub(crate) fn numbers_at<const D: usize>(&self, place: usize) -> [f64; 4] {
        if D == 2 {
            return [self.angles.get(place).copied().unwrap_or(0.0), 0.0, 0.0, 0.0];
        }
        self.attitudes.get(place).map_or([1.0, 0.0, 0.0, 0.0], |attitude| attitude.0)
    }

    /// Numbers that say how a node is turned and how it spins, for hashes; none where it has no rotation.
    pub(crate) fn numbers(&self, node: u32) -> impl Iterator<Item = f64> + use<> {
        let place = self.place(node);
        let angle = place.and_then(|place| self.angles.get(place).copied());
        let attitude = place.and_then(|place| self.attitudes.get(place).copied());
        let spin = place.map(|place| self.spins[place]);
        angle.into_iter().chain(attitude.into_iter().flat_map(|attitude| attitude.0)).chain(spin.into_iter().flatten())
    }
}
