//! Gas of cavities within a step: it follows the surfaces at x^n, counts in the stable step, and pushes on
//! the nodes. Nodes on faces of shells hand what pushes them on to the middle, as force and moment.

use super::{Governor, System};
use crate::dimension::Dimension;
use crate::error::Error;
use crate::load::cavity::Cavity;
use crate::rotation::Rotate;
use crate::tensor::Dim;
use crate::vector::{dot, length, minus, plus};

impl<const D: usize> System<D>
where
    Dim<D>: Dimension<D>,
{
    /// Lets the gas follow the surfaces at x^n.
    ///
    /// # Errors
    /// A volume that is gone.
    pub(super) fn advance_cavities(&mut self) -> Result<(), Error> {
        let times = [self.time - self.time_step_old, self.time];
        self.cavities.advance(&self.curves, times, &self.positions).map_err(|number| {
            let (name, volume) = self.cavities.iter().nth(number).map_or(("", 0.0), |cavity| (&cavity.name, cavity.values()[1]));
            Error::Squeezed { cavity: name.into(), volume, time: self.time, step: self.step }
        })
    }

    /// Adds what the gas pushes with to the forces of the coming update.
    pub(super) fn press_cavities(&mut self) {
        let Self { cavities, forces, positions, .. } = self;
        if !cavities.is_empty() {
            forces.add(cavities.forces(), positions.len());
        }
    }

    /// The square of the stable step, s², and who sets it, with the stiffness of the gas: ω² of both are
    /// added.
    pub(super) fn with_cavities(&self, (squared, governor): (f64, Governor)) -> (f64, Governor) {
        if self.cavities.is_empty() {
            return (squared, governor);
        }
        let (mut sum, mut most, mut stiffest) = (0.0, 0.0, 0);
        for (number, cavity) in self.cavities.iter().enumerate() {
            let frequency = self.frequency_squared(cavity);
            sum += frequency;
            if frequency > most {
                (most, stiffest) = (frequency, number as u32);
            }
        }
        let (of_gas, of_elements) = (0.25 * sum, 1.0 / squared);
        if of_gas == 0.0 {
            return (squared, governor);
        }
        (1.0 / (of_gas + of_elements), if of_gas > of_elements { Governor::Cavity(stiffest) } else { governor })
    }

    /// Bound of ω² of the gas of a cavity on the masses alone, 1/s². Of a node on the face of a shell, at the
    /// arm a, the displacement is u + θ × a of its middle: |u + θ × a|² ≤ 2 |u|² + 2 |a|² |θ|².
    fn frequency_squared(&self, cavity: &Cavity<D>) -> f64 {
        let (stiffness, net) = (cavity.stiffness(), cavity.net().abs());
        if stiffness == 0.0 {
            return 0.0;
        }
        let (mut rank_one, mut swaying) = (0.0, 0.0_f64);
        let mut add = |holder: &Holder<D>| {
            let mass = self.mass[holder.node as usize];
            if mass > 0.0 {
                rank_one += dot(holder.push, holder.push) / mass;
                swaying = swaying.max(holder.sway / mass);
            }
            let inertia = self.rotations.inertia.get(holder.place as usize).copied().unwrap_or(0.0);
            if inertia > 0.0 {
                rank_one += dot(holder.moment, holder.moment) / inertia;
                swaying = swaying.max(holder.turning / inertia);
            }
        };
        // Nodes on faces of one node of the middle follow each other.
        let mut last: Option<Holder<D>> = None;
        for (node, push, sway) in cavity.gradient() {
            let carrier = self.skins.carrier(node as usize);
            let holder = self.mesh.leader_of(node);
            let mut own = Holder { node: holder, place: u32::MAX, push, moment: [0.0; 3], sway, turning: 0.0 };
            if let Some((owner, place)) = carrier {
                let arm = minus(self.positions[node as usize], self.positions[owner as usize]);
                own.place = place as u32;
                own.moment = <Dim<D> as Rotate<D>>::moment_vector(arm, push);
                own.sway *= 2.0;
                own.turning = own.sway * dot(arm, arm) + length(push) * length(arm);
            }
            match &mut last {
                Some(before) if before.node == own.node && carrier.is_some() => {
                    before.push = plus(before.push, own.push);
                    before.moment = plus(before.moment, own.moment);
                    before.sway += own.sway;
                    before.turning += own.turning;
                }
                _ => {
                    last.iter().for_each(&mut add);
                    last = Some(own);
                }
            }
        }
        last.iter().for_each(&mut add);
        stiffness * rank_one + net * swaying
    }
}

/// A node that masses move, with what the gas does to it.
struct Holder<const D: usize> {
    node: u32,
    /// Where it is among the nodes that rotate; `u32::MAX`: it is none.
    place: u32,
    /// ∂V/∂x and ∂V/∂θ.
    push: [f64; D],
    moment: [f64; 3],
    /// Sums of s_f, and of the same for rotations.
    sway: f64,
    turning: f64,
}
