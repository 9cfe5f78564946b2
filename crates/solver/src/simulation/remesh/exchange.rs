//! A part of a run that stands still goes over to a mesh of the user's own.

use super::super::Runs;
use super::super::run::Run;
use super::{Cause, Remeshes};
use crate::build::remeshing;
use crate::error::{Error, Fault, NO_EXCHANGE};
use crate::mesh::Mesh;
use crate::model::messages::UNKNOWN_NAME;
use crate::model::{ImportedMesh, Model, Part, Placement, Shape};
use crate::output::Remeshing;
use crate::step::remap::Remap;
use crate::tensor::Dim;
use crate::vocabulary::{excerpt, suggestion};
use std::sync::Arc;

impl<const D: usize> Run<D>
where
    Dim<D>: Runs<D>,
{
    /// See [`super::super::Simulation::exchange`].
    pub(crate) fn exchange(&mut self, model: &Model, part: &str, mesh: ImportedMesh, group: Option<&str>) -> Result<Remeshing, Error> {
        let source = mesh.source.clone();
        let refused = |reason: String| {
            let message = format!("part `{}` can't continue on {}: {reason}", excerpt(part), excerpt(&source));
            Error::Model(vec![Fault::new(&NO_EXCHANGE, "", message, "mesh the part as it is now; `--outline` writes its outline")])
        };
        let known: Vec<&str> = model.parts.iter().map(|part| part.name.as_str()).collect();
        let Some(index) = known.iter().position(|name| *name == part) else {
            let message = format!("there is no part `{}`", excerpt(part));
            return Err(Error::Model(vec![Fault::new(&UNKNOWN_NAME, "", message, suggestion(part, &known))]));
        };
        let mut faults = model.check_exchange(index);
        faults.extend(remeshing::shared(model, &self.system.mesh, index, &format!("part[{index}]")));
        if !faults.is_empty() {
            return Err(Error::Model(faults));
        }
        let group = group_of(&mesh, D, part, group).map_err(refused)?;
        let new = mesh_of::<D>(model, index, mesh, group).map_err(Error::Model)?;
        let wrong = remeshing::wrong_elements(model, &new, (index, 0));
        if let Some((what, help)) = wrong {
            return Err(Error::Model(vec![Fault::new(&NO_EXCHANGE, "", format!("{what} in {}", excerpt(&source)), help)]));
        }
        let quality = <Dim<D>>::quality(&self.system, index);
        let fresh = <Dim<D>>::onto(&self.system, model, index, &new).map_err(refused)?;
        let is_first = self.system.remap.is_none();
        self.system.remap.get_or_insert_with(|| Box::new(Remap::new(model)));
        let made = self.made_again(model, index, fresh, Cause { reason: "mesh", quality, relocates: false })?;
        if made.is_err() && is_first {
            // The history has no column for it.
            self.system.remap = None;
        }
        let event = made.map_err(refused)?;
        if let Some(remap) = &mut self.system.remap {
            remap.events.push(event.clone());
        }
        Ok(event)
    }
}

/// The group of a mesh that holds the elements: the named one, the only one, or that of the part's name.
fn group_of(mesh: &ImportedMesh, dimension: usize, part: &str, named: Option<&str>) -> Result<String, String> {
    let groups: Vec<&str> =
        mesh.groups.iter().filter(|group| usize::from(group.dimension) == dimension).map(|group| group.name.as_str()).collect();
    let listed = || groups.iter().map(|name| format!("`{}`", excerpt(name))).collect::<Vec<_>>().join(", ");
    let found = match (named, &groups[..]) {
        (Some(named), groups) => groups.iter().find(|own| **own == named),
        (None, [only]) => Some(only),
        (None, groups) => groups.iter().find(|own| **own == part),
    };
    match (found, named) {
        (Some(found), _) => Ok((*found).to_string()),
        (None, _) if groups.is_empty() => Err(format!("it has no elements of {dimension} dimensions")),
        (None, Some(named)) => Err(format!("it has no group `{}` of {dimension} dimensions, but {}", excerpt(named), listed())),
        (None, None) => Err(format!("it has {} groups, {}, and none is named", groups.len(), listed())),
    }
}

/// The elements of a part as its model would have made them of the mesh, in a mesh of their own.
fn mesh_of<const D: usize>(model: &Model, part: usize, mesh: ImportedMesh, group: String) -> Result<Mesh<D>, Vec<Fault>>
where
    Dim<D>: Runs<D>,
{
    let shape = Shape::Group { mesh: 0, group };
    let own = Part { shape, sweep: None, placement: Placement::default(), ..model.parts[part].clone() };
    let alone = Model { parts: vec![own], meshes: vec![Arc::new(mesh)], materials: model.materials.clone(), ..Model::default() };
    Mesh::new(&alone)
}
