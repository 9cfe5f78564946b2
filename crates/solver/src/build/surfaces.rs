//! Surfaces of contacts, and the elements behind them: the same in 2D and 3D.

use super::node_elements::Under;
use super::{Builder, Builds, source_of};
use crate::contact;
use crate::contact::formulation::{ContactSurface, Side};
use crate::contact::messages::ON_SYMMETRY;
use crate::error::Fault;
use crate::mesh::surface::tributary::Depth;
use crate::mesh::surface::{Corners, Facet, Sided, Surface};
use crate::model::{self, Interface, Partners, PenaltySource};
use crate::tensor::Dim;
use std::cell::RefCell;

impl<const D: usize> Builder<'_, D>
where
    Dim<D>: Builds<D>,
{
    /// The surfaces of a contact: two, or one that meets itself. Faults have paths relative to the contact.
    pub(super) fn surfaces_of(&self, contact: &model::Contact) -> Result<Vec<ContactSurface<D>>, Vec<Fault>> {
        let made: Vec<_> = match &contact.partners {
            Partners::Between(between) => {
                let surface = |(side, name): (usize, &String)| {
                    let made = self.surface(|leave_out| self.mesh.surface(name, leave_out), &format!("surface \"{name}\""));
                    made.map_err(|fault| Fault { path: format!("between[{side}]"), ..fault })
                };
                (0..).zip(between).map(surface).collect()
            }
            Partners::Bodies(parts) => {
                let made = self.surface(|leave_out| self.mesh.outside_without(parts, leave_out), "the outside of the bodies");
                vec![made.map_err(|fault| Fault { path: "bodies".into(), ..fault })]
            }
        };
        let (good, faulty): (Vec<_>, Vec<_>) = made.into_iter().partition(Result::is_ok);
        if faulty.is_empty() { Ok(good.into_iter().flatten().collect()) } else { Err(faulty.into_iter().filter_map(Result::err).collect()) }
    }

    /// A surface without what lies on symmetry lines or planes.
    pub(super) fn surface(
        &self,
        surface: impl Fn(&dyn Fn(Facet<D>) -> bool) -> Result<Surface<D>, Fault>,
        what: &str,
    ) -> Result<ContactSurface<D>, Fault> {
        let lids = RefCell::new(Vec::new());
        let surface = surface(&|facet| {
            let is_lid = self.constraints.is_mirror(facet);
            if is_lid {
                lids.borrow_mut().push(facet);
            }
            is_lid
        })?;
        if surface.facets().is_empty() {
            let symmetry = if D == 2 { "line" } else { "plane" };
            let message = format!("{what} lies on a symmetry {symmetry} altogether");
            return Err(Fault::new(&ON_SYMMETRY, "", message, "name another surface"));
        }
        Ok(ContactSurface { target: <Dim<D>>::target(self, surface), lids: lids.into_inner() })
    }

    /// The elements behind a surface, with the stiffness that an interface asks for.
    pub(super) fn side(&self, surface: ContactSurface<D>, interface: &Interface) -> Side<'_, D> {
        let (target, source) = (&surface.target, source_of(interface));
        let under: Vec<Option<Under>> = target.facets().iter().map(|&facet| self.under(facet)).collect();
        let modulus = |under: &Under| self.moduli[under.group][usize::from(source == PenaltySource::BulkModulus)] * under.flatness;
        let mut stiffness: Vec<f64> = under.iter().map(|under| under.as_ref().map_or(0.0, modulus)).collect();
        let mut nodes = contact::tributaries(target, &stiffness, &self.mesh.positions, Depth::of(self.model));
        for (&node, own) in target.nodes().iter().zip(&mut nodes) {
            own.of_mass = self.of_mass(node, own.area);
        }
        let of_node = |node: &u32| target.nodes().binary_search(node).map_or(0.0, |at| nodes[at].of_mass);
        let least = |facet: &Facet<D>| facet.corners().iter().map(of_node).fold(f64::INFINITY, f64::min);
        let of_mass: Vec<f64> = target.facets().iter().map(least).collect();
        let is_by_step = source == PenaltySource::TimeStep;
        if is_by_step {
            let mean = |facet: &Facet<D>| 0.5 * facet.corners().iter().map(of_node).sum::<f64>();
            // In 2D the mean of both nodes, in 3D the least of all.
            stiffness = if D == 2 { target.facets().iter().map(mean).collect() } else { of_mass.clone() };
            nodes.iter_mut().for_each(|own| own.stiffness = own.of_mass);
        }
        let parts: Vec<usize> = under.iter().map(|under| under.as_ref().map_or(0, |under| self.mesh.groups[under.group].part)).collect();
        let softest = if D == 3 && is_by_step { stiffness.clone() } else { softest(&stiffness, &parts) };
        let shares = target.nodes().iter().map(|&node| <Dim<D>>::share(self, target, node)).collect();
        let cells = under.iter().map(|under| under.as_ref().and_then(|under| under.cell(&self.mesh))).collect();
        Side { stiffness, softest, of_mass, nodes, shares, cells, surface }
    }
}

/// Smallest κ of the facets of the same part, for each facet, Pa/m.
fn softest(stiffness: &[f64], parts: &[usize]) -> Vec<f64> {
    let mut softest = vec![f64::INFINITY; parts.iter().max().map_or(0, |part| part + 1)];
    for (&stiffness, &part) in stiffness.iter().zip(parts) {
        softest[part] = softest[part].min(stiffness);
    }
    parts.iter().map(|&part| softest[part]).collect()
}
