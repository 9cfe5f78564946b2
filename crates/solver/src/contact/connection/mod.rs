//! Connections at a point: spot welds and joints.
//!
//! Each of the two sets of nodes (or the ground in place of the first) moves as a rigid body in the mean
//! (`patch`) and leads the point. Axes e_i go with the first. What is locked is d·e_i = 0 of the way d
//! between both points, and the rotation of one against the other about e_i: multipliers, solved with the
//! springs of contacts, hold them. Their forces act at the point of the second set on both, so that they are
//! opposite and collinear and both momenta are kept; with rates of the axes the rows are the gradients of
//! d·e_i, so that what is locked takes no work.

mod patch;
pub mod strength;

use super::springs::{Answers, End, Slip, Spring, Springs, TangentSpace};
use super::tied::Ties;
use super::{Formulation, Scene};
use crate::archive::{Archive, ArchiveResult, persist_each};
use crate::rigid::space::Attitude;
use crate::rotation::{Square, applied, transposed};
use crate::tensor::{Dim, cross, product};
use crate::vector::{dot, first, length, minus, plus, times};
use patch::Patch;
use std::any::Any;
use strength::Strength;

/// What a joint locks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Lock {
    /// The way along an axis.
    Along(usize),
    /// The rotation about an axis.
    About(usize),
}

/// What is locked of a kind of joint: ways along, and rotations about its axes, of which the first is its own
/// one; in 2D the third is normal to the plane. `None`: there is no such kind.
fn locks(kind: &str, dimension: usize) -> Option<Vec<Lock>> {
    let (along, about): (&[usize], &[usize]) = match (kind, dimension) {
        ("spherical" | "revolute", 2) => (&[0, 1], &[]),
        ("translational", 2) => (&[1], &[2]),
        ("fixed", 2) => (&[0, 1], &[2]),
        ("spherical", 3) => (&[0, 1, 2], &[]),
        ("revolute", 3) => (&[0, 1, 2], &[1, 2]),
        ("cylindrical", 3) => (&[1, 2], &[1, 2]),
        ("translational", 3) => (&[1, 2], &[0, 1, 2]),
        ("fixed", 3) => (&[0, 1, 2], &[0, 1, 2]),
        _ => return None,
    };
    Some(along.iter().map(|&axis| Lock::Along(axis)).chain(about.iter().map(|&axis| Lock::About(axis))).collect())
}

/// What a connection is made of.
pub struct Setup {
    /// Kind of joint.
    pub kind: String,
    /// Nodes of both sets; without any the first is the ground.
    pub nodes: [Vec<u32>; 2],
    /// The point, m.
    pub at: [f64; 3],
    /// Orthonormal axes, right-handed.
    pub axes: Square<3>,
    /// When it fails; `None`: never.
    pub strength: Option<Strength>,
}

/// Forces of a connection on its second set, N and N m (in 2D N/m and N), and its state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Connected {
    /// Force.
    pub force: [f64; 3],
    /// Moment about the point.
    pub moment: [f64; 3],
    /// Tensile force along the first axis.
    pub normal: f64,
    /// Force across that.
    pub shear: f64,
    /// Distance of the points of both sets, m.
    pub gap: f64,
    /// Whether it has not failed.
    pub intact: bool,
    /// Whether the ground stands in for the first set.
    pub grounded: bool,
}

/// A connection.
pub struct Connection {
    /// The ground has no patch.
    patches: [Option<Patch>; 2],
    ground: [f64; 3],
    axes: Square<3>,
    axes_now: Square<3>,
    locks: Vec<Lock>,
    /// Whether all rotations are locked, and not those of an axis alone.
    turns_as_one: bool,
    /// By what rotations are multiplied, so that their forces compare with the others, m.
    arm: f64,
    strength: Option<Strength>,
    /// Time of the last detection, and the step before, s.
    time: f64,
    step: f64,
    /// Along and about the axes, filtered.
    forces: [f64; 6],
    gap: f64,
    intact: bool,
}

impl Connection {
    /// Of nodes at these places, m. `Err`: the nodes of this side can't hold a rigid body.
    ///
    /// # Errors
    /// As said.
    pub fn new<const D: usize>(setup: Setup, positions: &[[f64; D]]) -> Result<Self, usize> {
        let Setup { kind, nodes: [one, other], at, axes, strength } = setup;
        let has_ground = one.is_empty();
        let one = Patch::new(one, positions, at);
        if one.is_none() && !has_ground {
            return Err(0);
        }
        let other = Patch::new(other, positions, at).ok_or(1_usize)?;
        let locks = locks(&kind, D).unwrap_or_default();
        let turns_as_one = locks.iter().filter(|lock| matches!(lock, Lock::About(_))).count() == if D == 2 { 1 } else { 3 };
        let arm = one.as_ref().map_or(other.size(), |one| 0.5 * (one.size() + other.size()));
        Ok(Self {
            patches: [one, Some(other)],
            ground: at,
            axes,
            axes_now: axes,
            locks,
            turns_as_one,
            arm,
            strength,
            time: 0.0,
            step: 0.0,
            forces: [0.0; 6],
            gap: 0.0,
            intact: true,
        })
    }

    /// Whether these nodes can hold a rigid body.
    #[must_use]
    pub fn holds<const D: usize>(nodes: Vec<u32>, positions: &[[f64; D]]) -> bool {
        Patch::new(nodes, positions, [0.0; 3]).is_some()
    }

    fn attitude(&self, side: usize) -> Attitude {
        self.patches[side].as_ref().map_or_else(Attitude::default, |patch| patch.attitude)
    }

    fn point(&self, side: usize) -> [f64; 3] {
        self.patches[side].as_ref().map_or(self.ground, Patch::point)
    }

    /// How far each rotation that is locked is off, rad, along the axes of the start.
    fn twist(&self) -> [f64; 3] {
        let [one, other] = [0, 1].map(|side| self.attitude(side).matrix());
        if self.turns_as_one {
            let q = product(&transposed(&one), &other);
            let off = [q[2][1] - q[1][2], q[0][2] - q[2][0], q[1][0] - q[0][1]];
            return applied(&self.axes, times(0.5, off));
        }
        let off = cross(applied(&one, self.axes[0]), applied(&other, self.axes[0]));
        applied(&self.axes_now, off)
    }

    fn push<const D: usize>(&self, lock: Lock, springs: &mut Springs<D>)
    where
        Dim<D>: TangentSpace<D>,
    {
        let [one, other] = [0, 1].map(|side| self.point(side));
        let (axis, force, moment, gap) = match lock {
            Lock::Along(axis) => {
                let direction = self.axes_now[axis];
                (direction, direction, [0.0; 3], dot(direction, minus(other, one)))
            }
            Lock::About(axis) => (self.axes_now[0], [0.0; 3], times(self.arm, self.axes_now[axis]), self.arm * self.twist()[axis]),
        };
        let mut ends: Vec<End<D>> = Vec::new();
        for (patch, sign) in self.patches.iter().zip([-1.0, 1.0]) {
            for (node, row) in patch.iter().flat_map(|patch| patch.rows(times(sign, force), other, times(sign, moment))) {
                ends.push(End { at: node, lean: first(row), ..End::default() });
            }
        }
        springs.push(Spring { normal: first(axis), gap, ..Spring::default() }, Slip::default(), &ends);
    }
}

impl<const D: usize> Formulation<D> for Connection
where
    Dim<D>: TangentSpace<D>,
{
    fn detect(&mut self, scene: &Scene<'_, D>, springs: &mut Springs<D>) {
        (self.step, self.time) = (scene.time - self.time, scene.time);
        if !self.intact {
            return;
        }
        self.patches.iter_mut().flatten().for_each(|patch| patch.follow(scene.sweep.new));
        let turn = self.attitude(0);
        self.axes_now = self.axes.map(|axis| turn.turned(axis));
        self.gap = length(minus(self.point(1), self.point(0)));
        // What is not finite is reported with the nodes.
        if self.gap.is_finite() {
            self.locks.iter().for_each(|&lock| self.push(lock, springs));
        }
    }

    fn remember(&mut self, solved: Answers<'_, D>) {
        if !self.intact {
            return;
        }
        let mut now = [0.0; 6];
        for (lock, answer) in self.locks.iter().zip(solved) {
            match lock {
                Lock::Along(axis) => now[*axis] += answer.solved.force,
                Lock::About(axis) => now[3 + axis] += self.arm * answer.solved.force,
            }
        }
        let share = self.strength.map_or(1.0, |strength| strength.share(self.step));
        for (kept, now) in self.forces.iter_mut().zip(now) {
            *kept += share * (now - *kept);
        }
        if self.strength.is_some_and(|strength| strength.fails(&self.forces)) {
            self.intact = false;
            self.forces = [0.0; 6];
        }
    }

    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { patches, ground: _, axes: _, axes_now, locks: _, turns_as_one: _, arm: _, strength: _, time, step, forces, gap, intact } =
            self;
        patches.iter_mut().flatten().try_for_each(|patch| crate::archive::Persist::persist(patch, archive))?;
        persist_each!(archive; axes_now, time, step, forces, gap, intact);
        Ok(())
    }

    // Its nodes stay what they are.
    fn inherit(&mut self, _: Box<dyn Any>) {}

    fn ties(&self) -> Option<Ties> {
        self.strength.map(|_| Ties { nodes: Vec::new(), held: usize::from(self.intact), broken: usize::from(!self.intact) })
    }

    fn lose(&mut self, has_elements: &dyn Fn(u32) -> bool) {
        if self.patches.iter().flatten().flat_map(|patch| &patch.nodes).any(|&node| !has_elements(node)) {
            (self.intact, self.forces) = (false, [0.0; 6]);
        }
    }

    fn connected(&self) -> Option<Connected> {
        let [f, m] = [0, 3].map(|at| {
            let component = |axis: usize| times(self.forces[at + axis], self.axes_now[axis]);
            plus(plus(component(0), component(1)), component(2))
        });
        let [normal, b, c, ..] = self.forces;
        let shear = (b * b + c * c).sqrt();
        let grounded = self.patches[0].is_none();
        Some(Connected { force: f, moment: m, normal: -normal, shear, gap: self.gap, intact: self.intact, grounded })
    }
}

/// Unit vectors at right angles to a first one and to each other; in 2D the third is normal to the plane.
#[must_use]
pub fn axes_of(axis: [f64; 3], dimension: usize) -> Square<3> {
    let second = if dimension == 2 { [-axis[1], axis[0], 0.0] } else { crate::vector::any_tangent(axis) };
    [axis, second, cross(axis, second)]
}
