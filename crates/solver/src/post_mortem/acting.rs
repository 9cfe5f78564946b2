//! What acts on the neighbourhood of a failure location: keys of the model that hold, move or load its nodes.
//! Contacts that press on them are in the trace.

use super::FailureEntity;
use crate::model::{Load, Model};
use crate::simulation::Runs;
use crate::simulation::run::Run;
use crate::tensor::Dim;

/// A table of the model that acts on the failure location or the elements next to it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Acting {
    /// Its path: `constraint[0]` for example.
    pub path: String,
    /// What it is called there: the set that it is on.
    pub on: String,
}

impl<const D: usize> Run<D>
where
    Dim<D>: Runs<D>,
{
    /// Constraints and loads of the model that act on the failure location or the elements next to it.
    pub(crate) fn acting(&self, model: &Model, failure_entity: &FailureEntity) -> Vec<Acting> {
        let near = self.system.near(failure_entity).next;
        let mesh = &self.system.mesh;
        let reaches = |on: &str| mesh.nodes(on).is_some_and(|nodes| nodes.iter().any(|node| near.binary_search(node).is_ok()));
        let constraints = model.constraints.iter().enumerate().map(|(k, it)| (format!("constraint[{k}]"), it.on.clone()));
        let loads = model.loads.iter().enumerate().filter_map(|(k, load)| match load {
            Load::Force { on, .. } | Load::Moment { on, .. } | Load::Pressure { on, .. } => Some((format!("load[{k}]"), on.clone())),
            Load::Gravity { parts, .. } | Load::Centrifugal { parts, .. } => {
                let on = parts
                    .iter()
                    .find(|part| reaches(part))
                    .or_else(|| model.parts.first().map(|part| &part.name).filter(|_| parts.is_empty()))?;
                Some((format!("load[{k}]"), on.clone()))
            }
            Load::Damping { .. } | Load::StiffnessDamping { .. } => None,
        });
        constraints.chain(loads).filter(|(_, on)| reaches(on)).map(|(path, on)| Acting { path, on }).collect()
    }
}
