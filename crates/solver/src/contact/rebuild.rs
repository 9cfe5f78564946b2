//! Contacts made again when surfaces change, without knowing who makes them: [`ContactSource`].

use super::Contact;
use super::springs::TangentSpace;
use crate::load::constraint::Constraints;
use crate::mesh::{Mesh, Meshed};
use crate::rigid::Bodies;
use crate::tensor::Dim;

/// Parts of a system that contacts are made from, lent for as long as that takes.
pub(crate) struct ContactParts<'a, const D: usize>
where
    Dim<D>: Meshed<D> + TangentSpace<D>,
{
    pub(crate) mesh: &'a mut Mesh<D>,
    pub(crate) constraints: &'a mut Constraints<D>,
    pub(crate) mass: &'a mut Vec<f64>,
    pub(crate) bodies: &'a mut Bodies<D>,
}

/// What contacts are made from beyond the system: the builder keeps it for when surfaces change.
pub(crate) trait ContactSource<const D: usize>: Send + Sync
where
    Dim<D>: Meshed<D> + TangentSpace<D>,
{
    /// Gives every contact the surfaces that the mesh has now; one that has none any more ends.
    fn rebuild(&mut self, parts: ContactParts<'_, D>, contacts: &mut [Contact<D>]);
}
