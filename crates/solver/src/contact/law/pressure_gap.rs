//! Pressure as a function of the gap: a table, linear between its points. F = A p(g), energy A ∫ p dg from
//! the gap on.
//!
//! Below the deepest gap the pressure continues with the last slope. Positive gaps with a pressure are
//! allowed: a soft layer that is not modelled. Edges that cross press on half of what their four nodes stand
//! for, and nodes that come in while they hold press on nothing, so that nothing is counted twice.

use super::{ContactLawKind, Law, fixed_point};
use crate::contact::springs::{Closing, Patch};

/// Registry entry.
pub const KIND: ContactLawKind = ContactLawKind {
    name: "pressure_gap",
    doc: "a pressure that depends on the gap by a table (`gaps`, `pressures`), such as that of a soft layer",
    source: "energy of the table put into the update of Armero and Petocz (1998)",
    parameters: &[],
};

/// The law.
#[derive(Clone, Debug, PartialEq)]
pub struct PressureGap {
    /// (gap in m, pressure in Pa, ∫ p dg from the gap on in N/m), ascending by gap.
    points: Vec<[f64; 3]>,
}

impl PressureGap {
    /// From gaps (m, strictly ascending, at least two) and pressures (Pa, descending to zero at the last
    /// gap).
    #[must_use]
    pub fn new(gaps: &[f64], pressures: &[f64]) -> Self {
        let mut points: Vec<[f64; 3]> = gaps.iter().zip(pressures).map(|(&gap, &pressure)| [gap, pressure, 0.0]).collect();
        for i in (0..points.len().saturating_sub(1)).rev() {
            points[i][2] = points[i + 1][2] + 0.5 * (points[i][1] + points[i + 1][1]) * (points[i + 1][0] - points[i][0]);
        }
        Self { points }
    }

    /// Pressure (Pa), its integral from the gap on (N/m) and its slope −dp/dg (Pa/m).
    fn at(&self, gap: f64) -> [f64; 3] {
        // The first piece continues below the table; above it there is nothing.
        let next = self.points.partition_point(|point| point[0] <= gap).max(1);
        let Some(&[g1, p1, i1]) = self.points.get(next) else { return [0.0; 3] };
        let [g0, p0, _] = self.points[next - 1];
        let slope = (p0 - p1) / (g1 - g0);
        let pressure = p1 + slope * (g1 - gap);
        [pressure, i1 + 0.5 * (p1 + pressure) * (g1 - gap), slope]
    }
}

impl Law for PressureGap {
    fn force(&self, closing: &Closing<'_>, _: [f64; 2]) -> f64 {
        let Closing { spring, old, free, compliance } = *closing;
        if old >= self.reach() && free >= self.reach() {
            return 0.0;
        }
        fixed_point(|force| self.mean_force(spring, old, free + compliance * force))
    }
    fn stored(&self, spring: &Patch, gap: f64) -> f64 {
        spring.area * self.at(gap)[1]
    }
    fn stiffness(&self, spring: &Patch, gap: f64) -> f64 {
        spring.area * self.at(gap)[2]
    }
    fn mean_force(&self, spring: &Patch, old: f64, new: f64) -> f64 {
        let (low, high) = (old.min(new), old.max(new));
        if low == high {
            return spring.area * self.at(low)[0];
        }
        // Piece by piece, the mean of each by its share: no difference of energies.
        let (mut sum, mut from) = (0.0, low);
        let knots = self.points.iter().skip(1).map(|point| point[0]).filter(|&knot| low < knot && knot < high);
        for to in knots.chain([high]) {
            sum += 0.5 * (self.at(from)[0] + self.at(to)[0]) * ((to - from) / (high - low));
            from = to;
        }
        spring.area * sum
    }
    fn slip_stiffness(&self, spring: &Patch) -> f64 {
        let steepest = self.points.windows(2).map(|two| (two[0][1] - two[1][1]) / (two[1][0] - two[0][0])).fold(0.0, f64::max);
        spring.area * steepest
    }
    fn reach(&self) -> f64 {
        self.points.last().map_or(0.0, |point| point[0])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_energy_is_the_integral_of_the_pressure() {
        let law = PressureGap::new(&[-2.0, -1.0, 0.5], &[7.0, 2.0, 0.0]);
        assert_eq!(law.at(0.5), [0.0; 3]);
        assert_eq!(law.at(3.0), [0.0; 3]);
        assert_eq!(law.at(-1.0)[0], 2.0);
        assert!((law.at(-1.0)[1] - 1.5).abs() < 1e-15);
        assert!((law.at(-2.0)[1] - 6.0).abs() < 1e-15);
        // Beyond the table: the slope of 5 continues.
        assert!((law.at(-3.0)[0] - 12.0).abs() < 1e-14 && (law.at(-3.0)[1] - (6.0 + 9.5)).abs() < 1e-14);
        for gap in [-4.0, -1.7, -1.0, -0.2, 0.3] {
            let h = 1e-6;
            assert!(((law.at(gap - h)[1] - law.at(gap + h)[1]) / (2.0 * h) - law.at(gap)[0]).abs() < 1e-5);
        }
    }

    #[test]
    fn a_force_takes_and_gives_what_the_layer_stores() {
        let law = PressureGap::new(&[-2.0, -1.0, 0.5], &[7.0, 2.0, 0.0]);
        let spring = Patch { area: 1.5, ..Patch::default() };
        for compliance in [1e-6, 0.1, 3.0] {
            for old in [-3.0, -0.3, 0.0, 0.4, 5.0] {
                for free in [-7.0, -1.0, 0.0, 0.2, 3.0] {
                    let force = law.force(&Closing { spring: &spring, old, free, compliance }, [1.0; 2]);
                    let new = free + compliance * force;
                    let (work, change) = (force * (new - old), law.stored(&spring, old) - law.stored(&spring, new));
                    let scale = law.stored(&spring, old) + law.stored(&spring, new) + force * (free.abs() + old.abs());
                    assert!(force >= 0.0 && (work - change).abs() <= 1e-10 * scale, "{compliance} {old} {free}: {work} {change}");
                }
            }
        }
    }
}
