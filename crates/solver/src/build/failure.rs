//! Criteria of failure of each group of elements.

use super::{Builder, Builds};
use crate::block::Block;
use crate::error::Fault;
use crate::failure::{self, Criterion};
use crate::material::messages::CRITERION;
use crate::tensor::Dim;

impl<const D: usize> Builder<'_, D>
where
    Dim<D>: Builds<D>,
{
    /// The criteria of each group of elements; none where the part is rigid. Notes faults where a law does
    /// not remember what a criterion needs.
    pub(super) fn criteria(&mut self, blocks: &[Box<dyn Block<D>>]) -> Vec<Vec<Criterion>> {
        let mut faults = Vec::new();
        let mut of_group = Vec::new();
        for (group, block) in self.mesh.groups.iter().zip(blocks) {
            let part = &self.model.parts[group.part];
            let mut criteria = Vec::new();
            let Some(material) = self.model.materials.get(&part.material).filter(|_| part.rigid.is_none()) else {
                of_group.push(criteria);
                continue;
            };
            for (name, &limit) in &material.failure {
                let Some(kind) = failure::by_name(name) else { continue };
                if kind.needs.is_some_and(|variable| !block.has(variable)) {
                    let message = format!("law `{}` has no {}", material.law, name.replace('_', " "));
                    let fault = Fault::new(
                        &CRITERION,
                        format!("material.{}.failure.{name}", part.material),
                        message,
                        "take another criterion, or a law that has it",
                    );
                    if !faults.contains(&fault) {
                        faults.push(fault);
                    }
                }
                criteria.push(Criterion { kind, limit });
            }
            of_group.push(criteria);
        }
        self.faults.extend(faults);
        of_group
    }
}
