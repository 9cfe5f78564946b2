//! Contact springs, solved so that contact neither makes nor takes energy, whatever their stiffness and the
//! step.
//!
//! Contacts and obstacles find where springs are; this file finds their forces, all together, because springs
//! share nodes. With the gaps at half steps, g^{n+½} = g^n + ½ dt^n ġ^{n+½} and g^{n−½} = g^n − ½ dt^{n−1}
//! ġ^{n−½}, a force F does the work F (g^{n+½} − g^{n−½}) in the velocity update (exactly for equal steps,
//! else but for ¼ (dt^n − dt^{n−1}) F Δġ, which the slow growth of the step keeps small). So
//!
//! F = − [V(g^{n+½}) − V(g^{n−½})] / (g^{n+½} − g^{n−½})
//!
//! takes from the motion exactly what the spring's energy V stores and gives it back at release: Armero and
//! Petőcz, Comput. Meth. Appl. Mech. Engng 158 (1998) 269-300, put into the explicit update. A plain explicit
//! force −V'(g^n) does not: what a spring gives at release differs from what it took at closing by up to ½ k
//! v² dt²/4, and stiff springs pump or lose energy far below the linear stability limit.
//!
//! Stability: while a linear spring is closed, F = −k (g^{n−1} + 2 g^n + g^{n+1})/4, so it adds k to the
//! stiffness and k dt²/4 to the mass: (K + k) dt² ≤ 4 (M + k dt²/4) holds exactly if K dt² ≤ 4 M. The stable
//! step of the elements alone is the stable step with contact.
//!
//! The gap of a spring is that of the surfaces when it closes, and from then on the integral of its rate
//! ([`Springs::continues`]): a step begins at n − ½ where the one before ended, with the energy that is
//! stored there. On a plane both are the same number. On a curved surface the gap of the surfaces less ½ dt ġ
//! is elsewhere by the error of the trapezoidal rule, some dt² times the curvature times the square of the
//! sliding velocity; at a corner of the angle θ by up to θ times what a node slides in half a step; in a fold
//! by any depth. A spring that began there would gain or lose what it stores in between, at each corner, and
//! one that is no deeper than that any multiple of what it has. What lies between both gaps has either sign,
//! no preferred one, and is gone when the surfaces have parted.
//!
//! g^{n+½} depends on F itself and on the other springs at the same nodes. Springs that share none are in
//! different `islands`; those of one are swept over until no force changes (Gauss-Seidel, normal force and
//! friction in turn): eight at a time (`block`, `batches`, `sweep`), large islands cluster by cluster in the
//! order of their colours (`clusters`). Where that is slow, or rigid bodies or constraints are there, they
//! are swept over one by one (`relax`), and Newton's step predicts the forces (`newton`, `skyline`). Pair
//! forces keep both momenta exactly at any time. `solve` leads through the step, `topology` has what stays
//! while springs keep their ends, `link` what springs act on, `couple` what they do to each other, `book` the
//! energies, `answers` what contacts are reported. Laws of the normal force are in [`super::law`], friction
//! is in [`friction`].

pub mod friction;
mod answers;
mod batches;
mod block;
mod book;
mod clusters;
mod colours;
mod couple;
mod ends;
mod grips;
mod head;
mod islands;
mod keep;
mod link;
mod newton;
mod relax;
mod skyline;
mod solve;
mod sweep;
mod tangent_space;
mod topology;

pub use answers::{Answer, Answers};
pub use ends::KeptEnd;
pub use tangent_space::TangentSpace;

use super::law::{self, Law};
use crate::archive::persist_all;
use crate::energy::Lost;
use crate::rigid::Bodies;
use crate::rotation::Square;
use crate::tensor::Dim;
use embate_lanes::Level;
use ends::Ends;
use friction::Friction;
use std::ops::Range;

/// Both sides' ways together, and what shares beyond a facet's rim may add.
const BOTH: f64 = 2.2;

/// Gap of a spring that is left out, m.
const FAR: f64 = 1e12;

/// A value for each direction along a surface.
pub type Along<const D: usize> = <Dim<D> as TangentSpace<D>>::TangentVector<f64>;

/// A spring between two surfaces: it pushes along `normal` on the ends with positive shares and against it on
/// the others. At most a cache line: there is one for every node that touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spring<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// Unit vector.
    pub normal: [f64; D],
    /// Gap of the surfaces at n, m; of the spring that closes there g^n.
    pub gap: f64,
    /// k, N/m per metre of depth, of laws that have one.
    pub stiffness: f64,
    /// Length of surface that it stands for, m.
    pub area: f64,
    /// Where it stiffens, and how much.
    pub stiffening: Stiffening,
    /// 1 where the ends with positive shares belong to the first surface, −1 where to the second, 0 in a
    /// contact of bodies with themselves.
    pub side: f32,
    pub(super) first: u32,
    pub(super) count: u32,
}

impl<const D: usize> Default for Spring<D>
where
    Dim<D>: TangentSpace<D>,
{
    fn default() -> Self {
        let stiffening = Stiffening::default();
        Self { normal: [0.0; D], gap: 0.0, stiffness: 0.0, area: 0.0, stiffening, side: 0.0, first: 0, count: 0 }
    }
}

/// Where a spring is along the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slip<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// Friction: elastic slip at n − ½ (memory of the contact), m. Tie: slip at n, m.
    pub slip: Along<D>,
    /// In 3D the first of the tangents along which the slip is; zero: any.
    pub tangent: <Dim<D> as TangentSpace<D>>::FirstTangent,
}

impl<const D: usize> Default for Slip<D>
where
    Dim<D>: TangentSpace<D>,
{
    fn default() -> Self {
        let (slip, tangent) = Default::default();
        Self { slip, tangent }
    }
}

impl<const D: usize> Slip<D>
where
    Dim<D>: TangentSpace<D>,
{
    /// Along any tangents.
    #[must_use]
    pub fn of(slip: Along<D>) -> Self {
        Self { slip, ..Self::default() }
    }
}

/// Where a spring of a law with a stiffness stiffens: the depth beyond which it does, m, and how much stiffer
/// it is at twice that depth, each to two digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stiffening {
    // The upper halves of numbers of four bytes.
    depth: u16,
    factor: u16,
}

impl Default for Stiffening {
    /// Never.
    fn default() -> Self {
        Self::new(f64::INFINITY, 0.0)
    }
}

persist_all!(Stiffening { depth, factor });

impl Stiffening {
    /// Beyond a depth, m, by a factor.
    #[must_use]
    pub fn new(depth: f64, factor: f64) -> Self {
        let [depth, factor] = [depth, factor].map(|number| ((number as f32).to_bits() >> 16) as u16);
        Self { depth, factor }
    }

    /// Depth beyond which it stiffens, m; infinite: never.
    #[must_use]
    #[inline]
    pub fn depth(self) -> f64 {
        f64::from(f32::from_bits(u32::from(self.depth) << 16))
    }

    /// How much stiffer it is at twice that depth, as a fraction.
    #[must_use]
    #[inline]
    pub fn factor(self) -> f64 {
        f64::from(f32::from_bits(u32::from(self.factor) << 16))
    }
}

/// What a spring stands for, as laws of the normal force see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// g^n, m.
    pub gap: f64,
    /// k, N/m per metre of depth, of laws that have one.
    pub stiffness: f64,
    /// Area of surface, m (in 3D m²).
    pub area: f64,
    /// Depth beyond which it stiffens, m.
    pub limit: f64,
    /// How much stiffer it is at twice that depth, as a fraction.
    pub more: f64,
}

impl Default for Patch {
    fn default() -> Self {
        Self { gap: 0.0, stiffness: 0.0, area: 0.0, limit: f64::INFINITY, more: 0.0 }
    }
}

impl<const D: usize> Spring<D>
where
    Dim<D>: TangentSpace<D>,
{
    /// What laws see of it.
    #[must_use]
    #[inline]
    pub fn patch(&self) -> Patch {
        Patch { gap: self.gap, stiffness: self.stiffness, area: self.area, limit: self.stiffening.depth(), more: self.stiffening.factor() }
    }

    /// Where its ends are among all.
    #[inline]
    fn ends(&self) -> Range<usize> {
        self.first as usize..(self.first + self.count) as usize
    }
}

/// What the solution found of a spring across the surface: what the ledger and the contacts need of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Solved {
    /// g^n, m.
    pub gap: f64,
    /// F, N/m.
    pub force: f64,
    /// Rates of the gap in v^{n−½} and v^{n+½}, m/s.
    pub rates: [f64; 2],
}

/// The same along the surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Slid<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// T, N/m: friction along each tangent.
    pub friction: Along<D>,
    /// Elastic slip at n + ½, m.
    pub slip_new: Along<D>,
    /// Whether friction is at its limit, or there is none.
    pub slides: bool,
    /// Rates of the slip in v^{n−½} and v^{n+½}, m/s.
    pub rates: [Along<D>; 2],
}

/// What a spring does to one node or rigid body: rows of the rates of gap and slip.
///
/// ġ = Σ (share n + lean)·v, ṡ = Σ (share t + turn)·v with t = (n₂, −n₁). On a rigid body v is its velocity
/// at `point`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct End<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// Node, or number of nodes + rigid body.
    pub at: u32,
    /// Share in the gap.
    pub share: f64,
    /// What the gap's rate has beyond: of points that move along segments which are inclined to the tangent.
    pub lean: [f64; D],
    /// What makes the rate of each slip blind to rotation of both surfaces together, and friction keep the
    /// angular momentum.
    pub turn: <Dim<D> as TangentSpace<D>>::Tangents,
    /// Where the forces act on a rigid body without nodes, m.
    pub point: [f64; D],
    /// Rotation from the motion of the node that moves instead of it; `None`: no rotation.
    pub image: Option<<Dim<D> as TangentSpace<D>>::ImageRotation>,
}

impl<const D: usize> Default for End<D>
where
    Dim<D>: TangentSpace<D>,
{
    fn default() -> Self {
        Self { at: 0, share: 0.0, lean: [0.0; D], turn: Default::default(), point: [0.0; D], image: None }
    }
}

impl<const D: usize> End<D>
where
    Dim<D>: TangentSpace<D>,
{
    /// A node with a share of the gap.
    #[must_use]
    pub fn node(node: u32, share: f64) -> Self {
        Self { at: node, share, ..Self::default() }
    }
}

/// Tangent of a spring in 2D: the normal turned clockwise, along the target segment.
#[must_use]
pub fn tangent(normal: [f64; 2]) -> [f64; 2] {
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

impl Terms {
    /// Normal force, N/m, over an update with the steps dt^{n−1}, dt^n (s), of a spring whose gap changed at
    /// `rate_old` (m/s).
    #[inline]
    fn normal_force(&self, closing: &Closing<'_>, rate_old: f64, time_steps: [f64; 2]) -> f64 {
        if self.damping > 0.0 {
            law::damped(self.law.as_ref(), closing, self.damping, rate_old, time_steps)
        } else {
            self.law.force(closing, time_steps)
        }
    }
}

/// What acts along the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tangential {
    /// Nothing.
    Free,
    /// Coulomb friction.
    Friction(Friction),
    /// A spring on the slip that never yields; as stiff as that on the gap.
    Tied,
}

/// The springs of all contacts and obstacles in one step.
#[derive(Default)]
pub struct Springs<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// In the order in which contacts and obstacles found them.
    pub list: Vec<Spring<D>>,
    /// Where each is along the surface, as far as any is known to be anywhere.
    slips: Vec<Slip<D>>,
    ends: Ends<D>,
    /// Gap (m) and energy (J/m) of each spring at the end of the step before, as far as any continues; no
    /// number: it does not.
    ended: Vec<[f64; 2]>,
    /// What acts in springs, by number.
    pub terms: Vec<Terms>,
    /// Terms of each spring.
    terms_of: Vec<u32>,
    /// Whether anything acts along the surface in any.
    has_tangential: bool,
    /// dt^{n−1}, dt^n of the last solution, s.
    time_steps: [f64; 2],
    work: solve::Workspace<D>,
    /// Most sweeps that a step took so far.
    pub sweeps_max: usize,
    /// Steps whose forces still changed after the last sweep that is allowed.
    pub unsolved: u64,
}

/// What the solution needs of the model.
pub struct Update<'a, M: NodeResponses<D>, const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// Steps before and after, s: v^{n+½} = v^{n−½} + ½ (dt^{n−1} + dt^n) F / m, x^{n+1} = x^n + dt^n
    /// v^{n+½}.
    pub time_steps: [f64; 2],
    /// x^n, m.
    pub positions: &'a [[f64; D]],
    /// How nodes move and yield.
    pub nodes: &'a M,
    /// Rigid bodies.
    pub bodies: &'a Bodies<D>,
    /// Instructions with which springs are solved.
    pub level: Level,
}

/// Nodes as springs see them.
pub trait NodeResponses<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// How many nodes there are.
    fn count(&self) -> usize;
    /// The node that moves in the stead of `node`, and the rotation from its motion to that of `node`, if
    /// any.
    fn leader(&self, node: u32) -> (u32, Option<<Dim<D> as TangentSpace<D>>::ImageRotation>);
    /// Motion of a node that leads itself.
    fn response(&self, leader: usize) -> NodeResponse<D>;
    /// What carries a node of a shell's face: a number; `None`: it is none such.
    fn carrier(&self, _node: u32) -> Option<u32> {
        None
    }
    /// Where forces on such a node act, as its carrier feels them, m.
    fn carried_point(&self, _node: u32) -> [f64; D] {
        [0.0; D]
    }
    /// What carries nodes, by its number.
    fn carried(&self, _carrier: usize) -> Carrier<D> {
        Carrier::default()
    }
    /// Whether forces move it at all.
    fn moves(&self, leader: usize) -> bool {
        self.response(leader).mobility != Default::default()
    }
}

/// A node without springs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeResponse<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// v^{n−½}, m/s.
    pub velocity_old: [f64; D],
    /// v^{n+½} without springs, prescribed motion included, m/s.
    pub velocity: [f64; D],
    /// Change of v^{n+½} per force: xx, xy, yy; in 3D xx, xy, xz, yy, yz, zz.
    pub mobility: <Dim<D> as TangentSpace<D>>::Symmetric,
}

/// A node that rotates and carries nodes at arms, without springs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Carrier<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// Its translation.
    pub node: NodeResponse<D>,
    /// ω^{n−½}, and ω^{n+½} without springs, about x, y and z, rad/s.
    pub spins: [[f64; 3]; 2],
    /// Change of ω^{n+½} per moment.
    pub spin_mobility: Square<3>,
    /// Where it is, m.
    pub centre: [f64; D],
}

impl<const D: usize> Default for Carrier<D>
where
    Dim<D>: TangentSpace<D>,
{
    fn default() -> Self {
        let node = NodeResponse { velocity_old: [0.0; D], velocity: [0.0; D], mobility: Default::default() };
        Self { node, spins: [[0.0; 3]; 2], spin_mobility: [[0.0; 3]; 3], centre: [0.0; D] }
    }
}

/// A spring as laws of the normal force see it.
#[derive(Clone, Copy, Debug)]
pub struct Closing<'a> {
    /// The spring.
    pub spring: &'a Patch,
    /// g^{n−½}, m.
    pub old: f64,
    /// g^{n+½} without the force, m.
    pub free: f64,
    /// Change of g^{n+½} per force.
    pub compliance: f64,
}

/// Sums over the springs of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Totals<const D: usize> {
    /// Force on the first surface, N/m.
    pub resultant: [f64; D],
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

impl<const D: usize> Default for Totals<D> {
    fn default() -> Self {
        Self { resultant: [0.0; D], pressing: 0.0, energy: 0.0, slip_energy: 0.0, work: 0.0, lost: Lost::default() }
    }
}

impl<const D: usize> Springs<D>
where
    Dim<D>: TangentSpace<D>,
{
    /// For `nodes` nodes and `bodies` rigid bodies; springs follow one of the `terms`.
    #[must_use]
    pub fn new(nodes: usize, bodies: usize, terms: Vec<Terms>) -> Self {
        Self { work: solve::Workspace::new(nodes + bodies), terms, ..Self::default() }
    }

    /// Makes room for so many carriers of nodes besides.
    pub fn add_carriers(&mut self, carriers: usize) {
        self.work.add_places(carriers);
    }

    /// Forgets the springs of the last step.
    pub fn clear(&mut self) {
        self.list.clear();
        self.slips.clear();
        self.ends.clear();
        self.ended.clear();
        self.terms_of.clear();
        self.has_tangential = false;
    }

    /// Adds a spring with its ends.
    pub fn push(&mut self, spring: Spring<D>, slip: Slip<D>, ends: &[End<D>]) {
        self.push_with(spring, slip, ends.iter());
    }

    /// The same with the ends one by one.
    pub fn push_with<'a>(&mut self, spring: Spring<D>, slip: Slip<D>, ends: impl Iterator<Item = &'a End<D>>) {
        ends.for_each(|end| self.ends.push(end));
        if slip != Slip::default() {
            self.slips.resize(self.list.len(), Slip::default());
            self.slips.push(slip);
        }
        self.close(spring);
    }

    /// Adds a spring between nodes that have shares in its gap, and whose slip counts for nothing.
    #[inline]
    pub fn push_plain(&mut self, spring: Spring<D>, shares: impl Iterator<Item = (u32, f64)>) {
        self.ends.extend(shares);
        self.close(spring);
    }

    /// Adds the spring whose ends were pushed last.
    #[inline]
    fn close(&mut self, spring: Spring<D>) {
        let [first, count] = self.ends.close();
        self.list.push(Spring { first, count, ..spring });
    }

    /// Lets the spring that was pushed last begin where it ended in the step before, at the gap `half` (m)
    /// with the energy `stored` (J/m); if it was open there, without energy.
    #[inline]
    pub fn continues(&mut self, half: f64, stored: f64) {
        self.ended.resize(self.list.len() - 1, [f64::NAN; 2]);
        self.ended.push([half, stored]);
    }

    /// Ends the springs of a contact: what was pushed since the last group follows the terms number `terms`.
    pub fn close_group(&mut self, terms: usize) {
        let is_free = self.terms[terms].tangential == Tangential::Free;
        self.has_tangential |= self.terms_of.len() < self.list.len() && !is_free;
        self.terms_of.resize(self.list.len(), terms as u32);
    }

    /// Opens those springs of a contact that are `left_out`: as if what they are between were far apart.
    pub(super) fn open_where(&mut self, range: Range<usize>, left_out: impl Fn(&Self, &Spring<D>) -> bool) {
        for number in range {
            if left_out(self, &self.list[number]) {
                self.list[number].gap = FAR;
            }
        }
    }

    /// Where a spring is along the surface.
    #[inline]
    fn slip(&self, number: usize) -> Slip<D> {
        self.slips.get(number).copied().unwrap_or_default()
    }

    /// The ends of a spring.
    pub fn ends(&self, spring: &Spring<D>) -> impl Iterator<Item = KeptEnd<'_, D>> {
        spring.ends().map(|k| self.ends.get(k))
    }

    /// The longest step, s, in which nothing goes farther into a body than `ways` times the depth at which
    /// the spring there stiffens, with the velocities (m/s) that nodes and rigid bodies have; infinite if
    /// nothing can in a step in which none goes farther than `way`, m.
    #[must_use]
    pub fn step_of_approach(&self, ways: f64, way: f64, velocities: &[[f64; D]], bodies: &Bodies<D>) -> f64 {
        let may_be = |spring: &&Spring<D>| spring.gap > 0.0 && ways * spring.stiffening.depth() < BOTH * way;
        let of = |spring: &Spring<D>| {
            let limit = spring.stiffening.depth();
            let rate: f64 = spring.ends().map(|k| self.ends.get(k)).map(|end| end.rate(spring.normal, velocities, bodies)).sum();
            if rate < 0.0 { (ways * limit + spring.gap) / -rate } else { f64::INFINITY }
        };
        self.list.iter().filter(may_be).map(of).fold(f64::INFINITY, f64::min)
    }

    /// What the last solution found of the springs `range`.
    #[must_use]
    pub fn answers(&self, range: Range<usize>) -> Answers<'_, D> {
        Answers { springs: self, range }
    }
}

/// Σ over the directions along a surface, from the first one on.
#[inline(always)]
fn sum_along<const D: usize>(of: impl Fn(usize) -> f64) -> f64 {
    let mut sum = of(0);
    for a in 1..D - 1 {
        sum += of(a);
    }
    sum
}

#[cfg(test)]
mod tests;

#[cfg(test)]
mod space_tests;
