//! The energy balance: the ledger of the works of all forces, which is an identity, and the energy drift,
//! which compares stored energies with external work.
//!
//! Momentum update times mean velocity: Δ ½Σ m|v^{n+1/2}|² = Σ_k ½(dt^n + dt^{n-1}) f_k^n · v̄^n for every
//! kind k of force. The residual of this sum is round-off or a bug. The drift compares energies at the whole
//! step n: kinetic energy ½ Σ m v^{n-1/2}·v^{n+1/2}, stored, dissipated and contact spring energy and what
//! friction and damping took, less what came from outside by the trapezoidal rule in the displacement, Σ
//! f·½(x^{n+1} − x^{n-1}). For linear springs, dead loads and a constant step this is exactly constant, from
//! time zero on; there the velocity v^{-1/2} is the mirror image 2v⁰ − v^{1/2}. What friction, damping and
//! multipliers take is their work with its sign turned, by the same rule: the drift can't detect it, its sign
//! can.

use crate::archive::persist_all;
use crate::reductions;

persist_all!(Works { internal, contact, gravity, load, damping, constraint, drive, remap });
persist_all!(Lost { friction, damping, old, freed, lost_contact_energy });
persist_all!(Stores {
    kinetic,
    elastic,
    plastic,
    hourglass,
    bulk_viscosity,
    contact,
    friction,
    contact_damping,
    damping,
    eroded,
    remap,
    flow
});
persist_all!(Ledger { kinetic_start, total_start, works, external, halves, stores, largest, residual, drift });

/// Works of one step by kind of force, J/m; each is force times mean velocity times ½(dt + dt_old).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Works {
    /// Internal forces.
    pub internal: f64,
    /// Contacts and obstacles.
    pub contact: f64,
    /// Gravity and centrifugal force.
    pub gravity: f64,
    /// Forces and pressures on nodes.
    pub load: f64,
    /// Damping loads and boundaries that reflect nothing.
    pub damping: f64,
    /// Reactions of prescribed motion and symmetry.
    pub constraint: f64,
    /// What drives rigid bodies.
    pub drive: f64,
    /// What the velocities lost, or gained, when elements were made again: no force.
    pub remap: f64,
}

impl Works {
    /// Everything.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.internal + self.contact + self.gravity + self.load + self.damping + self.constraint + self.drive + self.remap
    }
    /// What comes from outside the model: it changes the sum of the stores.
    #[must_use]
    pub fn external(&self) -> f64 {
        self.gravity + self.load + self.constraint + self.drive
    }
    fn add(&mut self, other: &Self) {
        self.internal += other.internal;
        self.contact += other.contact;
        self.gravity += other.gravity;
        self.load += other.load;
        self.damping += other.damping;
        self.constraint += other.constraint;
        self.drive += other.drive;
        self.remap += other.remap;
    }
}

/// Work in contact that no normal spring stores, J/m: positive is taken from the motion.
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
    /// Energy at n − ½ of springs that were closed and are no more at n: their node or segment has left the
    /// surface.
    pub lost_contact_energy: f64,
}

impl Lost {
    /// All together: sums are exact until they are rounded once.
    pub fn total(parts: impl Iterator<Item = Self> + Clone) -> Self {
        let of = |value: fn(&Self) -> f64| reductions::sum(parts.clone().map(|lost| value(&lost)));
        Self {
            friction: of(|lost| lost.friction),
            damping: of(|lost| lost.damping),
            old: [of(|lost| lost.old[0]), of(|lost| lost.old[1])],
            freed: of(|lost| lost.freed),
            lost_contact_energy: of(|lost| lost.lost_contact_energy),
        }
    }
}

impl std::ops::AddAssign for Lost {
    fn add_assign(&mut self, other: Self) {
        self.friction += other.friction;
        self.damping += other.damping;
        self.old[0] += other.old[0];
        self.old[1] += other.old[1];
        self.freed += other.freed;
        self.lost_contact_energy += other.lost_contact_energy;
    }
}

/// Sums over the nodes of a chunk, or over the rigid bodies, in one velocity update.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sums {
    /// ½ Σ m|v^{n+1/2}|², J/m.
    pub kinetic_half: f64,
    /// ½ Σ m v^{n-1/2}·v^{n+1/2}, J/m.
    pub kinetic: f64,
    /// Works as in [`Works`], J/m.
    pub internal: f64,
    /// See `internal`.
    pub gravity: f64,
    /// See `internal`.
    pub load: f64,
    /// See `internal`.
    pub damping: f64,
    /// See `internal`.
    pub constraint: f64,
    /// See `internal`.
    pub drive: f64,
    /// Impulses from outside times v^{n-1/2}, J/m.
    pub external_old: f64,
    /// Impulses of damping loads and boundaries that reflect nothing times v^{n-1/2}, J/m.
    pub damping_old: f64,
    /// Largest |v^{n+1/2}|² of the free nodes among them, m²/s²: no sum.
    pub speed_squared: f64,
}

impl Sums {
    /// All together: sums are exact until they are rounded once.
    pub fn total<'a>(parts: impl Iterator<Item = &'a Self> + Clone) -> Self {
        let of = |value: fn(&Self) -> f64| reductions::sum(parts.clone().map(value));
        Self {
            kinetic_half: of(|sums| sums.kinetic_half),
            kinetic: of(|sums| sums.kinetic),
            internal: of(|sums| sums.internal),
            gravity: of(|sums| sums.gravity),
            load: of(|sums| sums.load),
            damping: of(|sums| sums.damping),
            constraint: of(|sums| sums.constraint),
            drive: of(|sums| sums.drive),
            external_old: of(|sums| sums.external_old),
            damping_old: of(|sums| sums.damping_old),
            speed_squared: reductions::max(parts.clone().map(|sums| sums.speed_squared)),
        }
    }
}

impl std::ops::AddAssign<&Self> for Sums {
    fn add_assign(&mut self, other: &Self) {
        self.kinetic_half += other.kinetic_half;
        self.kinetic += other.kinetic;
        self.internal += other.internal;
        self.gravity += other.gravity;
        self.load += other.load;
        self.damping += other.damping;
        self.constraint += other.constraint;
        self.drive += other.drive;
        self.external_old += other.external_old;
        self.damping_old += other.damping_old;
        self.speed_squared = self.speed_squared.max(other.speed_squared);
    }
}

/// Energies at a whole step, J/m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stores {
    /// ½ Σ m v^{n-1/2}·v^{n+1/2}.
    pub kinetic: f64,
    /// Stored elastic energy of the elements.
    pub elastic: f64,
    /// Dissipated by the material.
    pub plastic: f64,
    /// Stored and taken by hourglass control.
    pub hourglass: f64,
    /// Taken by the bulk viscosity.
    pub bulk_viscosity: f64,
    /// Springs of contacts and obstacles, elastic slip included.
    pub contact: f64,
    /// Lost by friction so far.
    pub friction: f64,
    /// Lost by damping in contacts, and by impacts on multipliers, so far.
    pub contact_damping: f64,
    /// Lost by damping loads, of the mass and of the stiffness, and into boundaries that reflect nothing so
    /// far.
    pub damping: f64,
    /// Elastic energy that eroded elements had, and that of contact springs on the surfaces that went with
    /// them.
    pub eroded: f64,
    /// Kinetic and elastic energy, and that of contact springs, that went when elements were made again.
    pub remap: f64,
    /// Kinetic and elastic energy of material that has left through the end of a flow, less that of what has
    /// come in.
    pub flow: f64,
}

impl Stores {
    /// Sum of all stores.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.kinetic
            + self.elastic
            + self.plastic
            + self.hourglass
            + self.bulk_viscosity
            + self.contact
            + self.friction
            + self.contact_damping
            + self.damping
            + self.eroded
            + self.remap
            + self.flow
    }
}

/// Part of the work of a single step that counts as an energy of the run: where a load meets what is at rest
/// there is no other one yet, and the rounding of its work is no drift.
const PART_OF_WORK: f64 = 1e-9;

/// The energy balance of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ledger {
    /// Kinetic energy at the start, J/m.
    kinetic_start: f64,
    /// Sum of the stores at the start less the work done until then, J/m.
    total_start: Option<f64>,
    /// Works from the start to the last half step, J/m.
    pub works: Works,
    /// External work until the last whole step, J/m.
    pub external: f64,
    /// External work, and what friction, contact damping and damping loads took, until the last half step,
    /// J/m.
    halves: [f64; 4],
    /// Stores at the last whole step.
    pub stores: Stores,
    /// Largest total energy so far, J/m; at least that of round-off.
    pub largest: f64,
    /// Largest residual of the identity so far, J/m.
    residual: f64,
    /// Largest drift so far, J/m.
    drift: f64,
}

/// What the momentum update of one step reports the ledger.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Entry {
    /// ½ Σ m|v^{n+1/2}|², J/m.
    pub kinetic_half: f64,
    /// Works of the update from v^{n-1/2} to v^{n+1/2}.
    pub works: Works,
    /// Impulses from outside times v^{n-1/2} instead of the mean velocity, J/m.
    pub external_old: f64,
    /// What friction and damping took in contacts.
    pub lost: Lost,
    /// Energy of the elastic slip of friction, at the whole step, J/m; part of what friction took, but not
    /// lost.
    pub slip_energy: f64,
    /// Impulses of damping loads times v^{n-1/2}, J/m.
    pub damping_old: f64,
    /// Part of the update that lies before the whole step: dt^{n-1} / (dt^{n-1} + dt^n); zero at time zero
    /// only.
    pub before: f64,
    /// Stores at the whole step n without what is lost but in elements (of damping what is taken there),
    /// kinetic energy as ½ Σ m v^{n-1/2}·v^{n+1/2}, at time zero as ½ Σ m v⁰·v^{1/2}.
    pub stores: Stores,
}

impl Ledger {
    /// A ledger that begins with `kinetic` energy, J/m. Drift and residual are fractions of the largest total
    /// energy, but at least of `round_off`, the energy that rounded positions alone can bring: a body at rest
    /// must not seem to gain energy.
    #[must_use]
    pub fn new(kinetic: f64, round_off: f64) -> Self {
        Self { kinetic_start: kinetic, largest: kinetic.max(round_off), ..Self::default() }
    }

    /// Adds a step.
    pub fn enter(&mut self, entry: &Entry) {
        // The impulse's part before the whole step went with v^{n-1/2}, the part after it with v^{n+1/2}.
        let lost = &entry.lost;
        let works = [entry.works.external(), lost.friction, lost.damping, -entry.works.damping];
        let olds = [entry.external_old, lost.old[0], lost.old[1], -entry.damping_old];
        // What was released on the way here is gone at n.
        self.halves[2] += lost.lost_contact_energy;
        let mut wholes = [0.0; 4];
        for (k, whole) in wholes.iter_mut().enumerate() {
            *whole = self.halves[k] + entry.before * olds[k];
            self.halves[k] = *whole + (1.0 - entry.before) * (2.0 * works[k] - olds[k]);
        }
        // What breaks now is still whole at n.
        self.halves[2] += lost.freed;
        self.external = wholes[0];
        self.works.add(&entry.works);
        self.stores = entry.stores;
        (self.stores.friction, self.stores.contact_damping, self.stores.damping) =
            (wholes[1] - entry.slip_energy, wholes[2], entry.stores.damping + wholes[3]);
        if entry.before > 0.0 {
            // Unequal steps: v^{n-1/2} and v^{n+1/2} lie at unequal distances from n; the shift is ½ (dt^n −
            // dt^{n-1})/(dt^n + dt^{n-1}) ΣW.
            self.stores.kinetic -= (0.5 - entry.before) * entry.works.total();
        } else {
            // Time zero: ½ Σ m (2v⁰ − v^{1/2})·v^{1/2}.
            self.stores.kinetic = 2.0 * entry.stores.kinetic - entry.kinetic_half;
        }
        self.largest = self.largest.max(self.stores.total().abs()).max(PART_OF_WORK * entry.works.total().abs());
        let start = *self.total_start.get_or_insert(self.stores.total() - self.external);
        // NaN must not hide behind max: it is caught before, by the kinetic energy.
        self.residual = self.residual.max((entry.kinetic_half - self.kinetic_start - self.works.total()).abs());
        self.drift = self.drift.max((self.stores.total() - self.external - start).abs());
    }

    /// Adds a change of velocities at the end of a step as external work, J/m: by what ½ Σ m|v^{n+1/2}|²
    /// changes, and by what the kinetic energy at the whole step does; `ahead` is what loads do more in the
    /// half step that follows, because they act on other velocities.
    pub(crate) fn throw(&mut self, half: f64, whole: f64, ahead: f64) {
        self.works.load += half;
        self.halves[0] += whole + ahead;
        self.external += whole;
        self.stores.kinetic += whole;
        self.largest = self.largest.max(self.stores.total().abs());
    }

    /// Adds kinetic energy that mass brings which is added before the update, as work from outside, J/m.
    pub(crate) fn bring(&mut self, kinetic: f64) {
        self.launch(kinetic, 0.0);
    }

    /// Adds a change of v^{n+½} between two steps as work from outside, J/m: by what ½ Σ m|v^{n+1/2}|²
    /// changes; `ahead` is what internal and contact forces do less in the half step that follows, because
    /// they act on other velocities.
    pub(crate) fn launch(&mut self, kinetic: f64, ahead: f64) {
        self.works.load += kinetic;
        self.halves[0] += kinetic + ahead;
    }

    /// Adds a change of v^{n+½} between two steps that no force made, J/m: by what ½ Σ m|v^{n+1/2}|² changes.
    /// The stores have it as `remap`.
    pub(crate) fn transfer(&mut self, kinetic: f64) {
        self.works.remap += kinetic;
    }

    /// Adds energy at n + ½ of springs of contacts that end between two steps, J/m.
    pub(crate) fn free(&mut self, stored: f64) {
        self.halves[2] += stored;
    }

    /// Largest |change of kinetic energy − sum of works| over the largest total energy.
    #[must_use]
    pub fn residual(&self) -> f64 {
        self.fraction(self.residual)
    }

    /// Largest |stores − external work − start| over the largest total energy.
    #[must_use]
    pub fn drift(&self) -> f64 {
        self.fraction(self.drift)
    }

    fn fraction(&self, value: f64) -> f64 {
        if self.largest > 0.0 { value / self.largest } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_springs_let_go_is_gone_in_the_step_that_misses_it() {
        let entry = |contact: f64, lost_contact_energy: f64| Entry {
            kinetic_half: 3.0,
            before: 0.5,
            stores: Stores { kinetic: 3.0, contact, ..Stores::default() },
            lost: Lost { lost_contact_energy, ..Lost::default() },
            ..Entry::default()
        };
        let mut ledger = Ledger::new(3.0, 0.0);
        for (contact, lost_contact_energy) in [(2.0, 0.0), (2.0, 0.0), (0.5, 1.5), (0.5, 0.0)] {
            ledger.enter(&entry(contact, lost_contact_energy));
            assert_eq!(ledger.stores.contact + ledger.stores.contact_damping, 2.0);
        }
        assert_eq!(ledger.drift(), 0.0);
    }
}
