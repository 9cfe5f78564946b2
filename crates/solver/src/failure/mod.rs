//! Failure criteria of elements on their mean state, and the registry that everything else iterates over.
//!
//! A material lists limits (`failure`); after the law has answered, a block asks its criteria about each
//! batch of eight elements (`Seen`), and the step erodes what fails. The mean over the points decides, the
//! same value that files show. To add a criterion: one file, one line in [`CRITERIA`].

mod damage;
mod plastic_strain;
mod principal_stress;
mod time_step;

use crate::material::Variable;
use crate::quantity::Parameter;
use embate_lanes::{BATCH, Batch};

/// A criterion as the registry describes it.
#[derive(Clone, Copy, Debug)]
pub struct CriterionKind {
    /// Its key in the model file, and the limit.
    pub limit: Parameter,
    /// The history variable that the law must have for it.
    pub needs: Option<&'static Variable>,
    /// Which of eight elements fail at a limit.
    pub fails: fn(&dyn Seen, f64) -> [bool; BATCH],
}

/// Every criterion.
pub const CRITERIA: &[CriterionKind] = &[plastic_strain::KIND, principal_stress::KIND, damage::KIND, time_step::KIND];

/// A criterion with its limit.
#[derive(Clone, Copy, Debug)]
pub struct Criterion {
    /// Which.
    pub kind: &'static CriterionKind,
    /// Limit, SI.
    pub limit: f64,
}

/// What criteria see of eight elements: means over the points.
pub trait Seen {
    /// Cauchy stress xx yy zz xy yz zx, Pa; the last two are zero in 2D.
    fn stress(&self) -> [Batch; 6];
    /// A history variable; zero where the law has none such.
    fn variable(&self, variable: &Variable) -> Batch;
    /// Squares of the stable steps, s².
    fn time_step_squared(&self) -> Batch;
}

/// Lanes of eight elements that are `live` and fail, each with the number of the first criterion that it
/// misses.
pub(crate) fn failing(criteria: &[Criterion], seen: &dyn Seen, live: impl Fn(usize) -> bool) -> impl Iterator<Item = (usize, u32)> {
    let fails: Vec<[bool; BATCH]> = criteria.iter().map(|criterion| (criterion.kind.fails)(seen, criterion.limit)).collect();
    let first: [Option<usize>; BATCH] = std::array::from_fn(|lane| fails.iter().position(|fails| fails[lane]).filter(|_| live(lane)));
    first.into_iter().enumerate().filter_map(|(lane, first)| first.map(|first| (lane, first as u32)))
}

/// The criterion called `name`.
#[must_use]
pub fn by_name(name: &str) -> Option<&'static CriterionKind> {
    CRITERIA.iter().find(|kind| kind.limit.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::variable::{DAMAGE, PLASTIC_STRAIN};

    struct State {
        stress: [f64; 6],
        variables: &'static [(&'static Variable, f64)],
        time_step: f64,
    }

    impl Seen for State {
        fn stress(&self) -> [Batch; 6] {
            self.stress.map(Batch::splat)
        }
        fn variable(&self, variable: &Variable) -> Batch {
            Batch::splat(self.variables.iter().find(|(own, _)| *own == variable).map_or(0.0, |&(_, value)| value))
        }
        fn time_step_squared(&self) -> Batch {
            Batch::splat(self.time_step * self.time_step)
        }
    }

    #[test]
    fn each_criterion_fails_at_its_limit_and_not_before() {
        const VARIABLES: &[(&Variable, f64)] = &[(&PLASTIC_STRAIN, 0.2), (&DAMAGE, 0.9)];
        let state = State { stress: [3.0, 1.0, 0.5, 2.0, 0.0, 0.0], variables: VARIABLES, time_step: 1e-8 };
        let at = |name: &str, limit: f64| (by_name(name).unwrap().fails)(&state, limit)[0];
        assert!(at("plastic_strain", 0.2) && !at("plastic_strain", 0.21));
        // 2 + √(1 + 4)
        assert!(at("principal_stress", 4.236) && !at("principal_stress", 4.237));
        assert!(at("damage", 0.9) && !at("damage", 1.0));
        assert!(at("time_step", 1.1e-8) && !at("time_step", 0.9e-8));
    }

    #[test]
    fn stress_across_the_plane_counts_and_pressure_does_not() {
        let fails = |stress: [f64; 6]| {
            let state = State { stress, variables: &[], time_step: 1.0 };
            (by_name("principal_stress").unwrap().fails)(&state, 1.0)[0]
        };
        assert!(fails([0.0, 0.0, 1.5, 0.0, 0.0, 0.0]) && !fails([-9.0, -9.0, -9.0, 0.0, 0.0, 0.0]));
    }

    #[test]
    fn in_3d_every_shear_counts() {
        let largest = |stress: [f64; 6], limit: f64| {
            let state = State { stress, variables: &[], time_step: 1.0 };
            (by_name("principal_stress").unwrap().fails)(&state, limit)[0]
        };
        // The same tension of 3 along x, along y − z, and along x + y + z.
        for stress in [[3.0, 0.0, 0.0, 0.0, 0.0, 0.0], [0.0, 1.5, 1.5, 0.0, -1.5, 0.0], [1.0; 6]] {
            assert!(largest(stress, 3.0 - 1e-12) && !largest(stress, 3.0 + 1e-12), "{stress:?}");
        }
    }

    #[test]
    fn an_element_without_a_step_fails_for_its_step() {
        let state = State { stress: [0.0; 6], variables: &[], time_step: f64::NAN };
        assert!((by_name("time_step").unwrap().fails)(&state, 1e-9)[0]);
    }
}
