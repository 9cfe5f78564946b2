//! Mass scaling: elements made heavier for a longer stable step, before masses go to the nodes.

use super::Builder;
use crate::block::{Block, Motion};
use crate::error::Fault;
use embate_lanes::{Level, Team};

impl Builder<'_> {
    /// Scales the mass of parts (`mass_scale`) and of elements below the wanted step. Returns the mass added to deformable parts and their true mass, kg/m; more than the limit is a fault.
    pub(super) fn scale_mass(&mut self, blocks: &mut [Box<dyn Block<2>>], level: Level) -> [f64; 2] {
        let masses = |block: &dyn Block<2>| (0..block.elements()).map(|element| block.mass(element)).sum::<f64>();
        let (mut before, mut after) = (0.0, 0.0);
        let mut wanted_adds = 0.0;
        let velocities = vec![[0.0; 2]; self.mesh.positions.len()];
        let motion = Motion { positions: &self.mesh.positions, velocities: &velocities, time_step: 0.0 };
        for (block, group) in blocks.iter_mut().zip(&self.mesh.groups) {
            let part = &self.model.parts[group.part];
            let own = masses(block.as_ref());
            if part.mass_scale != 1.0 {
                (0..block.elements()).for_each(|element| block.scale_mass(element, part.mass_scale));
            }
            if part.rigid.is_some() {
                continue;
            }
            if let Some(scaling) = self.model.run.mass_scaling {
                let scaled = masses(block.as_ref());
                let mut slots = vec![[0.0; 2]; block.slots().len()];
                block.advance(&motion, level, &mut slots, &mut Team::alone());
                let needed = (scaling.time_step / self.model.run.safety).powi(2);
                for element in 0..block.elements() {
                    let factor = needed / block.time_step_squared(element);
                    if factor > 1.0 {
                        block.scale_mass(element, factor);
                    }
                }
                wanted_adds += masses(block.as_ref()) - scaled;
            }
            before += own;
            after += masses(block.as_ref());
        }
        if let Some(scaling) = self.model.run.mass_scaling
            && wanted_adds > scaling.limit * before
        {
            let message = format!(
                "a step of {:.3e} s needs {wanted_adds:.4e} kg/m more mass, {:.3} % of what the deformable parts have; the limit is {:.3} %",
                scaling.time_step,
                100.0 * wanted_adds / before,
                100.0 * scaling.limit
            );
            self.faults.push(Fault::new(
                "run.mass_scaling.time_step",
                message,
                "take a smaller step, mend the smallest elements, or raise `limit`",
            ));
        }
        [after - before, before]
    }
}
