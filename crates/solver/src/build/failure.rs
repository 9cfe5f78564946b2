//! Criteria of failure of each group of elements.

use super::{Builder, Builds};
use crate::error::Fault;
use crate::failure::{self, Criterion};
use crate::material::messages::CRITERION;
use crate::material::points;
use crate::tensor::Dim;

impl<const D: usize> Builder<'_, D>
where
    Dim<D>: Builds<D>,
{
    /// The criteria of each group of elements; none where the part is rigid. Notes faults where a law does
    /// not remember what a criterion needs.
    pub(super) fn criteria(&mut self) -> Vec<Vec<Criterion>> {
        let mut faults = Vec::new();
        let mut of_group = Vec::new();
        for group in &self.mesh.groups {
            let part = &self.model.parts[group.part];
            let mut criteria = Vec::new();
            let names = part.materials().filter(|_| part.rigid.is_none());
            for (of, material) in names.filter_map(|name| Some((name, self.model.materials.get(name)?))) {
                for (name, &limit) in &material.failure {
                    let Some(kind) = failure::by_name(name) else { continue };
                    let lacks = |variable| points::plane(material).is_some_and(|law| law.place(variable).is_none());
                    if kind.needs.is_some_and(lacks) {
                        let message = format!("law `{}` has no {}", material.law, name.replace('_', " "));
                        let fault = Fault::new(
                            &CRITERION,
                            format!("material.{of}.failure.{name}"),
                            message,
                            "take another criterion, or a law that has it",
                        );
                        if !faults.contains(&fault) {
                            faults.push(fault);
                        }
                    }
                    criteria.push(Criterion { kind, limit });
                }
            }
            of_group.push(criteria);
        }
        self.faults.extend(faults);
        of_group
    }
}
