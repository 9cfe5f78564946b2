//! Contact springs, solved so that contact neither makes nor takes energy, whatever their stiffness and the step.
//!
//! Contacts and obstacles find where springs are; this file finds their forces, all together, because springs share nodes. With the gaps at half steps,
//! g^{n+½} = g^n + ½ dt^n ġ^{n+½} and g^{n−½} = g^n − ½ dt^{n−1} ġ^{n−½}, a force F does the work F (g^{n+½} − g^{n−½}) in the velocity update (exactly for
//! equal steps, else but for ¼ (dt^n − dt^{n−1}) F Δġ, which the slow growth of the step keeps small). So
//!
//! F = − [V(g^{n+½}) − V(g^{n−½})] / (g^{n+½} − g^{n−½})
//!
//! takes from the motion exactly what the spring's energy V stores and gives it back at release: Armero and Petőcz, Comput. Meth. Appl. Mech. Engng 158
//! (1998) 269-300, put into the explicit update. A plain explicit force −V'(g^n) does not: what a spring gives at release differs from
//! what it took at closing by up to ½ k v² dt²/4, and stiff springs pump or lose energy far below the linear stability limit.
//!
//! Stability: while a linear spring is closed, F = −k (g^{n−1} + 2 g^n + g^{n+1})/4, so it adds k to the stiffness and k dt²/4 to the mass:
//! (K + k) dt² ≤ 4 (M + k dt²/4) holds exactly if K dt² ≤ 4 M. The stable step of the elements alone is the stable step with contact.
//!
//! g^{n+½} depends on F itself and on the other springs at the same nodes. Springs that share none are in different `islands`; those of one are swept over in their fixed order
//! (`relax`: Gauss-Seidel, normal force and friction in turn) until no force changes, and where that is slow, Newton's step predicts the forces (`newton`, `skyline`). Pair forces
//! keep both momenta exactly at any time. `solve` leads through the step, `link` has what springs act on, `couple` what they do to each other, `book` the energies, `answers` what contacts are told. Laws of the normal force are in [`super::law`],
//! friction is in [`friction`].

pub mod friction;
mod answers;
mod book;
mod couple;
mod ends;
mod islands;
mod keep;
mod link;
mod newton;
mod relax;
mod skyline;
mod solve;

pub use answers::{Answer, Answers};

use super::law::Law;
use crate::rigid::Bodies;
use ends::Ends;
use friction::Friction;
use std::ops::Range;

/// A vector of the plane.
pub type Vector = [f64; 2];

/// A spring between two surfaces: it pushes along `normal` on the ends with positive shares and against it on the others. A cache line: there is one for every node that touches.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spring {
    /// Unit vector.
    pub normal: Vector,
    /// g^n, m.
    pub gap: f64,
    /// k, N/m per metre of depth, of laws that have one.
    pub stiffness: f64,
    /// Length of surface that it stands for, m.
    pub area: f64,
    /// 1 where the ends with positive shares belong to the first surface, −1 where to the second, 0 in a contact of bodies with themselves.
    pub side: f64,
    /// Friction: elastic slip at n − ½ (memory of the contact), m. Tie: slip at n, m.
    pub slip: f64,
    pub(super) first: u32,
    pub(super) count: u32,
}

impl Spring {
    /// Where its ends are among all.
    #[inline]
    fn ends(&self) -> Range<usize> {
        self.first as usize..(self.first + self.count) as usize
    }
}

/// What the solution found of a spring: what the books and the contacts need of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Solved {
    /// F, N/m.
    pub force: f64,
    /// T, N/m: friction along the tangent.
    pub friction: f64,
    /// Elastic slip at n + ½, m.
    pub slip_new: f64,
    /// Whether friction is at its limit, or there is none.
    pub slides: bool,
    /// Rates of the gap in v^{n−½} and v^{n+½}, m/s.
    pub rates: [f64; 2],
    /// The same of the slip along the tangent, m/s.
    pub slip_rates: [f64; 2],
}

/// Work that no normal spring stores, J/m: positive is taken from the motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lost {
    /// By friction, energy of the elastic slip included.
    pub friction: f64,
    /// By damping, and by impacts on multipliers.
    pub damping: f64,
    /// The same two impulses times the old rates instead of the mean ones.
    pub old: [f64; 2],
    /// Energy at n + ½ of springs that are no more at n + 1: ties that broke, contacts that end.
    pub freed: f64,
    /// Energy at n − ½ of springs that were closed and are no more at n: their node or segment has left the surface.
    pub let_go: f64,
}

impl std::ops::AddAssign for Lost {
    fn add_assign(&mut self, other: Self) {
        self.friction += other.friction;
        self.damping += other.damping;
        self.old[0] += other.old[0];
        self.old[1] += other.old[1];
        self.freed += other.freed;
        self.let_go += other.let_go;
    }
}

/// What a spring does to one node or rigid body: rows of the rates of gap and slip.
///
/// ġ = Σ (share n + lean)·v, ṡ = Σ (share t + turn)·v with t = (n₂, −n₁). On a rigid body v is its velocity at `point`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct End {
    /// Node, or number of nodes + rigid body.
    pub at: u32,
    /// Share in the gap.
    pub share: f64,
    /// What the gap's rate has beyond: of points that move along segments which are inclined to the tangent.
    pub lean: Vector,
    /// What makes the slip rate blind to rotation of both surfaces together, and friction keep the angular momentum.
    pub turn: Vector,
    /// Where the forces act on a rigid body without nodes, m.
    pub point: Vector,
    /// Cosine and sine of the rotation from the motion of the node that moves in its stead; `None`: no rotation.
    pub image: Option<Vector>,
}

impl End {
    /// A node with a share of the gap.
    #[must_use]
    pub fn node(node: u32, share: f64) -> Self {
        Self { at: node, share, ..Self::default() }
    }

    /// Force of a solved spring on this end, N/m.
    #[must_use]
    #[inline]
    pub fn force(&self, spring: &Spring, solved: &Solved) -> Vector {
        let (gap_row, slip_row) = (self.gap_row(spring.normal), self.slip_row(tangent(spring.normal)));
        [0, 1].map(|d| gap_row[d] * solved.force + slip_row[d] * solved.friction)
    }

    /// Row of the gap's rate.
    #[inline]
    fn gap_row(&self, normal: Vector) -> Vector {
        [0, 1].map(|d| self.share * normal[d] + self.lean[d])
    }

    /// Row of the slip's rate.
    #[inline]
    fn slip_row(&self, tangent: Vector) -> Vector {
        [0, 1].map(|d| self.share * tangent[d] + self.turn[d])
    }
}

/// Tangent of a spring: the normal turned clockwise, along the target segment.
#[must_use]
pub fn tangent(normal: Vector) -> Vector {
    [normal[1], -normal[0]]
}

/// What acts in the springs of a contact.
pub struct Terms {
    /// Law of the normal force.
    pub law: Box<dyn Law>,
    /// Along the surface.
    pub tangential: Tangential,
    /// Fraction of critical damping while closed.
    pub damping: f64,
}

/// What acts along the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tangential {
    /// Nothing.
    Free,
    /// Coulomb friction.
    Friction(Friction),
    /// A spring on the slip that never gives way; as stiff as that on the gap.
    Tied,
}

/// The springs of all contacts and obstacles in one step.
#[derive(Default)]
pub struct Springs {
    /// In the order in which contacts and obstacles found them.
    pub list: Vec<Spring>,
    ends: Ends,
    /// What acts in springs, by number.
    pub terms: Vec<Terms>,
    /// Terms of each spring.
    terms_of: Vec<u32>,
    /// dt^{n−1}, dt^n of the last solution, s.
    time_steps: [f64; 2],
    work: solve::Workspace,
    /// Most sweeps that a step took so far.
    pub sweeps_max: usize,
    /// Steps whose forces still changed after the last sweep that is allowed.
    pub unsolved: u64,
}

/// What the solution needs of the model.
pub struct Update<'a, M: Movers> {
    /// Steps before and after, s: v^{n+½} = v^{n−½} + ½ (dt^{n−1} + dt^n) F / m, x^{n+1} = x^n + dt^n v^{n+½}.
    pub time_steps: [f64; 2],
    /// x^n, m.
    pub positions: &'a [Vector],
    /// How nodes move and give way.
    pub nodes: &'a M,
    /// Rigid bodies.
    pub bodies: &'a Bodies,
}

/// Nodes as springs see them.
pub trait Movers {
    /// How many nodes there are.
    fn count(&self) -> usize;
    /// The node that moves in the stead of `node`, and the rotation from its motion to that of `node`, if any.
    fn leader(&self, node: u32) -> (u32, Option<Vector>);
    /// Motion of a node that leads itself.
    fn mover(&self, leader: usize) -> Mover;
    /// Whether forces move it at all.
    fn moves(&self, leader: usize) -> bool {
        self.mover(leader).mobility != [0.0; 3]
    }
}

/// A node without springs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mover {
    /// v^{n−½}, m/s.
    pub velocity_old: Vector,
    /// v^{n+½} without springs, prescribed motion included, m/s.
    pub velocity: Vector,
    /// Change of v^{n+½} per force: xx, xy, yy.
    pub mobility: [f64; 3],
}

/// A spring as laws of the normal force see it.
#[derive(Clone, Copy, Debug)]
pub struct Closing<'a> {
    /// The spring.
    pub spring: &'a Spring,
    /// g^{n−½}, m.
    pub old: f64,
    /// g^{n+½} without the force, m.
    pub free: f64,
    /// Change of g^{n+½} per force.
    pub compliance: f64,
}

/// Sums over the springs of a contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Totals {
    /// Force on the first surface, N/m.
    pub resultant: Vector,
    /// Sum of the normal forces, N/m: what is transmitted, also where the resultant vanishes.
    pub pressing: f64,
    /// Energy of the springs, J/m.
    pub energy: f64,
    /// Energy of the elastic slip, J/m.
    pub slip_energy: f64,
    /// Work in the velocity update, J/m.
    pub work: f64,
    /// What the update took.
    pub lost: Lost,
}

impl Springs {
    /// For `nodes` nodes and `bodies` rigid bodies; springs follow one of the `terms`.
    #[must_use]
    pub fn new(nodes: usize, bodies: usize, terms: Vec<Terms>) -> Self {
        Self { work: solve::Workspace::new(nodes + bodies), terms, ..Self::default() }
    }

    /// Forgets the springs of the last step.
    pub fn clear(&mut self) {
        self.list.clear();
        self.ends.clear();
        self.terms_of.clear();
    }

    /// Adds a spring with its ends.
    pub fn push(&mut self, spring: Spring, ends: &[End]) {
        let first = self.ends.len();
        ends.iter().for_each(|end| self.ends.push(end));
        self.list.push(Spring { first, count: ends.len() as u32, ..spring });
    }

    /// Ends the springs of a contact: what was pushed since the last group follows the terms number `terms`.
    pub fn close_group(&mut self, terms: usize) {
        self.terms_of.resize(self.list.len(), terms as u32);
    }

    /// The ends of a spring.
    pub fn ends(&self, spring: &Spring) -> impl Iterator<Item = End> {
        spring.ends().map(|k| self.ends.get(k))
    }

    /// What the last solution found of the springs `range`.
    #[must_use]
    pub fn answers(&self, range: Range<usize>) -> Answers<'_> {
        Answers { springs: self, range }
    }
}

#[cfg(test)]
mod tests;
