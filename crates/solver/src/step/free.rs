//! The velocity update of nodes that nothing holds, eight at a time: forces, loads, gravity and damping; no
//! constraint, dashpot, group or rigid body.
//!
//! The same formulas as for any node in `nodes.rs`, in lanes. Groups of eight nodes in which one is not free
//! are left to it. Sums run lane by lane, so they do not depend on the instruction set.

use super::nodes::Nodes;
use crate::dimension::Dimension;
use crate::energy::Sums;
use crate::tensor::Dim;
use crate::vector::{dot, plus, times};
use embate_lanes::{BATCH, Batch, Kernel, Lane};
use std::ops::Range;

/// The groups of eight nodes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Groups {
    /// Whether all nodes of each full group are free.
    pub(crate) free: Vec<bool>,
    /// The others, ascending, the last one if it is not full, but for those on faces of shells.
    pub(crate) held: Vec<u32>,
}

impl Groups {
    /// Of so many nodes; groups on faces of shells alone move with the middles of these.
    pub(crate) fn new(nodes: usize, is_free: impl Fn(usize) -> bool, are_on_faces: impl Fn(Range<usize>) -> bool) -> Self {
        let free: Vec<bool> = (0..nodes / BATCH).map(|group| (group * BATCH..(group + 1) * BATCH).all(&is_free)).collect();
        let is_held = |&group: &usize| free.get(group) != Some(&true) && !are_on_faces(group * BATCH..((group + 1) * BATCH).min(nodes));
        let held = (0..nodes.div_ceil(BATCH)).filter(is_held).map(|group| group as u32).collect();
        Self { free, held }
    }

    /// Nodes of the groups that are not free, `count` nodes in all.
    pub(crate) fn held_nodes(&self, count: usize) -> impl Iterator<Item = usize> {
        self.held.iter().flat_map(move |&group| group as usize * BATCH..((group as usize + 1) * BATCH).min(count))
    }
}

/// Nodes from `first` on (a multiple of eight) with their new velocities, and with the positions x^{n+1} to
/// which these lead: they are written while everything is at hand.
pub(super) struct Free<'a, 'b, const D: usize>
where
    Dim<D>: Dimension<D>,
{
    pub(super) nodes: &'b Nodes<'a, D>,
    pub(super) first: usize,
    pub(super) velocities: &'b mut [[f64; D]],
    pub(super) positions_next: &'b mut [[f64; D]],
}

/// Sums of [`Sums`], one per lane position.
#[derive(Default)]
pub(super) struct LaneSums {
    kinetic_half: Batch,
    kinetic: Batch,
    internal: Batch,
    load: Batch,
    gravity: Batch,
    external_old: Batch,
    damping: Batch,
    damping_old: Batch,
    speed_squared: Batch,
}

impl LaneSums {
    pub(super) fn total(&self) -> Sums {
        let sum = |batch: &Batch| batch.0.iter().sum();
        Sums {
            kinetic_half: sum(&self.kinetic_half),
            kinetic: sum(&self.kinetic),
            internal: sum(&self.internal),
            load: sum(&self.load),
            gravity: sum(&self.gravity),
            external_old: sum(&self.external_old),
            damping: sum(&self.damping),
            damping_old: sum(&self.damping_old),
            speed_squared: self.speed_squared.0.into_iter().fold(0.0, f64::max),
            ..Sums::default()
        }
    }
}

/// `values[first..first + 8]`.
#[inline(always)]
pub(super) fn eight(values: &[f64], first: usize) -> Batch {
    values[first..].first_chunk().map_or(Batch::default(), |values| Batch(*values))
}

#[inline(always)]
fn add<L: Lane>(sum: &mut Batch, value: L, at: usize) {
    (L::load(sum, at) + value).store(sum, at);
}

impl<const D: usize> Kernel for Free<'_, '_, D>
where
    Dim<D>: Dimension<D>,
{
    type Output = Sums;

    #[inline(always)]
    fn run<L: Lane>(self) -> Sums {
        let Self { nodes, first, velocities, positions_next } = self;
        let mut sums = LaneSums::default();
        let dt = L::splat(nodes.time_step);
        let groups = velocities.as_chunks_mut::<BATCH>().0.iter_mut().zip(positions_next.as_chunks_mut::<BATCH>().0);
        for (group, (own, next)) in groups.enumerate() {
            let first = first + group * BATCH;
            if !nodes.free[first / BATCH] {
                continue;
            }
            let pulls = nodes.assembly.forces(first / BATCH, nodes.slots);
            for at in (0..BATCH).step_by(L::WIDTH) {
                let v = nodes.advance_free::<L>(first, at, L::load_points(&pulls, at), &mut sums);
                let x = L::load_points(nodes.positions, first + at);
                L::store_points(plus(x, times(dt, v)), next, at);
                L::store_points(v, own, at);
            }
        }
        sums.total()
    }
}

/// Free nodes from `first` on that nothing pulls at in this step: their velocities stay as they are.
pub(super) struct Coast<'a, 'b, const D: usize>
where
    Dim<D>: Dimension<D>,
{
    pub(super) nodes: &'b Nodes<'a, D>,
    pub(super) first: usize,
    pub(super) positions_next: &'b mut [[f64; D]],
}

impl<const D: usize> Kernel for Coast<'_, '_, D>
where
    Dim<D>: Dimension<D>,
{
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        let Self { nodes, first, positions_next } = self;
        let dt = L::splat(nodes.time_step);
        for (group, next) in positions_next.as_chunks_mut::<BATCH>().0.iter_mut().enumerate() {
            for at in (0..BATCH).step_by(L::WIDTH) {
                let node = first + group * BATCH + at;
                let (x, v) = (L::load_points(nodes.positions, node), L::load_points(nodes.velocities_old, node));
                L::store_points(plus(x, times(dt, v)), next, at);
            }
        }
    }
}

impl<const D: usize> Nodes<'_, D>
where
    Dim<D>: Dimension<D>,
{
    /// v^{n+½} of the nodes `first + at..` and their part in the ledger.
    #[inline(always)]
    fn advance_free<L: Lane>(&self, first: usize, at: usize, internal: [L; D], sums: &mut LaneSums) -> [L; D] {
        let node = first + at;
        let mut contact = None;
        if let Some(forces) = self.contact_forces {
            // Adding zeros is for their sign.
            let zero = [L::splat(0.0); D];
            contact = Some(if forces.has(first / BATCH) { L::load_points(forces.values(), node) } else { zero });
        }
        let pulled = Pulled {
            mass: L::load(&eight(self.mass, first), at),
            old: L::load_points(self.velocities_old, node),
            internal,
            contact,
            load: if self.loads.is_empty() { None } else { Some(L::load_points(self.loads, node)) },
            gravity: if self.gravity.is_empty() { None } else { Some(L::load_points(self.gravity, node)) },
            slowing: if self.damping.acts() { Some(L::load(&self.damping.factors(first), at)) } else { None },
        };
        pulled.advance(L::splat(self.dt), sums, at)
    }
}

/// What pulls on nodes that nothing holds: as [`super::nodes::Pull`], in lanes.
pub(super) struct Pulled<L, const D: usize> {
    pub(super) mass: L,
    pub(super) old: [L; D],
    pub(super) internal: [L; D],
    pub(super) contact: Option<[L; D]>,
    pub(super) load: Option<[L; D]>,
    pub(super) gravity: Option<[L; D]>,
    /// a of damping.
    pub(super) slowing: Option<L>,
}

impl<L: Lane, const D: usize> Pulled<L, D> {
    /// v^{n+½} after Δt, and its part in the ledger.
    #[inline(always)]
    pub(super) fn advance(self, dt: L, sums: &mut LaneSums, at: usize) -> [L; D] {
        let Self { mass, old, internal, contact, load, gravity, slowing } = self;
        let half = L::splat(0.5);
        let scale = dt / mass;
        let mut force = internal;
        if let Some(contact) = contact {
            force = plus(force, contact);
        }
        let mut v = plus(old, times(scale, force));
        if let Some(load) = load {
            v = plus(v, times(scale, load));
        }
        if let Some(g) = gravity {
            v = plus(v, times(dt, g));
        }
        if let Some(a) = slowing {
            let all = L::splat(1.0) + a;
            for d in 0..D {
                v[d] = (v[d] - a * old[d]) / all;
            }
        }
        let mean = times(half, plus(old, v));
        let square = dot(v, v);
        square.max(L::load(&sums.speed_squared, at)).store(&mut sums.speed_squared, at);
        add(&mut sums.kinetic_half, half * mass * square, at);
        add(&mut sums.kinetic, half * mass * dot(old, v), at);
        add(&mut sums.internal, dt * dot(internal, mean), at);
        if let Some(load) = load {
            add(&mut sums.load, dt * dot(load, mean), at);
            add(&mut sums.external_old, dt * dot(load, old), at);
        }
        if let Some(g) = gravity {
            add(&mut sums.gravity, dt * mass * dot(g, mean), at);
            add(&mut sums.external_old, dt * mass * dot(g, old), at);
        }
        if let Some(a) = slowing {
            let impulse = times(-(L::splat(2.0) * a * mass), mean);
            add(&mut sums.damping, dot(impulse, mean), at);
            add(&mut sums.damping_old, dot(impulse, old), at);
        }
        v
    }
}
