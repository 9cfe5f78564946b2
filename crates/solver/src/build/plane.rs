//! What is built in 2D in a way of its own: the axis of an axisymmetric body, surfaces as chains of
//! segments, and the contacts between them.

use super::contacts::{kind_of, search_of};
use super::node_elements::Under;
use super::{Builder, law_of, source_of, terms_of, terms_of_ties};
use crate::contact::formulation::{Setup, Side};
use crate::contact::messages::ON_SYMMETRY;
use crate::contact::outline::Outlines;
use crate::contact::projection::node_segment::Target;
use crate::contact::{self, Formulation};
use crate::error::Fault;
use crate::mesh::Mesh;
use crate::mesh::messages::NEGATIVE_RADIUS;
use crate::mesh::surface::tributary::Depth;
use crate::mesh::surface::{NONE, Surface};
use crate::model::{self, Interface, Model, Partners, PenaltySource, Symmetry};
use crate::vector::{dot, minus};
use std::cell::RefCell;

/// An axisymmetric model with its axis as a symmetry line, if it touches that.
pub(crate) fn with_axis(model: &Model, mesh: &Mesh<2>) -> Result<Option<Model>, Vec<Fault>> {
    if !model.is_axisymmetric() {
        return Ok(None);
    }
    // Nodes nearer to the axis are on it.
    let near = crate::mesh::tolerance(&mesh.positions);
    if let Some([x, y]) = mesh.positions.iter().find(|x| x[0] < -near) {
        let message = format!("an axisymmetric part has a node at a negative radius, ({x:.6e}, {y:.6e}) m");
        return Err(vec![Fault::new(&NEGATIVE_RADIUS, "part", message, "x is the radius: move the part to the right of the axis x = 0")]);
    }
    let touches = mesh.positions.iter().any(|x| x[0] <= near);
    let axis = Symmetry { normal: [1.0, 0.0, 0.0], ..Symmetry::default() };
    let is_there = |symmetry: &Symmetry| symmetry.parts.is_empty() && symmetry.point[0] == 0.0 && symmetry.normal[1] == 0.0;
    if !touches || model.symmetries.iter().any(is_there) {
        return Ok(None);
    }
    let mut model = model.clone();
    model.symmetries.push(axis);
    Ok(Some(model))
}

impl Builder<'_, 2> {
    /// What is behind a surface, with the stiffness that an interface asks for.
    pub(crate) fn side(&self, Outlined { target, lids }: Outlined, interface: &Interface) -> Side<'_> {
        let (surface, positions, source) = (&target.surface, &self.mesh.positions, source_of(interface));
        let modulus = |under: Under| self.moduli[under.group][usize::from(source == PenaltySource::BulkModulus)] * under.flatness;
        let mut segments: Vec<f64> = surface.segments.iter().map(|&segment| self.under(segment).map_or(0.0, modulus)).collect();
        let mut nodes = contact::tributaries(surface, &segments, positions, Depth::of(self.model));
        for (&node, own) in surface.nodes.iter().zip(&mut nodes) {
            own.of_mass = self.of_mass(node, own.area);
        }
        if source == PenaltySource::TimeStep {
            nodes.iter_mut().for_each(|own| own.stiffness = own.of_mass);
            let of = |node: u32| surface.nodes.binary_search(&node).map_or(0.0, |at| nodes[at].stiffness);
            segments = surface.segments.iter().map(|&[a, b]| 0.5 * (of(a) + of(b))).collect();
        }
        let cell =
            |&segment: &[u32; 2]| self.under(segment).map_or(&[][..], |under| self.mesh.groups[under.group].cell(under.element).corners());
        let cells = surface.segments.iter().map(cell).collect();
        let parts = surface
            .segments
            .iter()
            .map(|&segment| self.under(segment).map_or(0, |under| self.mesh.groups[under.group].part as u32))
            .collect();
        Side { lids, segments, parts, nodes, cells, target }
    }

    /// Outlines of all bodies; nothing where nothing meets them.
    pub(crate) fn outlines(&self) -> Outlines {
        if self.model.contacts.is_empty() && self.model.obstacles.is_empty() {
            return Outlines::default();
        }
        // Elements that overlap are reported elsewhere.
        let outside = self.mesh.outside(&[]).map(|surface| surface.segments).unwrap_or_default();
        Outlines::new(&outside, |segment| self.constraints.is_mirror(segment), &self.body_of_node, &self.mesh.positions)
    }

    /// What makes the springs of a contact between bodies with these `outlines`, and the number of the terms
    /// that they follow.
    pub(crate) fn formulation(
        &mut self,
        contact: &model::Contact,
        outlines: &Outlines,
    ) -> Result<(Box<dyn Formulation<2>>, usize), Vec<Fault>> {
        let terms = self.add_terms(terms_of(&contact.interface));
        let tie_terms = if contact.tied.is_some() { self.add_terms(terms_of_ties(&contact.interface)) } else { terms };
        let sides: Vec<Side<'_>> = self.outlines_of(contact)?.into_iter().map(|outline| self.side(outline, &contact.interface)).collect();
        let mirrors = self.mirrors_of(contact, &sides[0].target.surface.nodes, &sides[0].nodes);
        let (search, kind) = (search_of::<2>(contact)?, kind_of(contact)?);
        let setup = Setup {
            contact,
            sides,
            bodies: &self.body_of_node,
            positions: &self.mesh.positions,
            depth: Depth::of(self.model),
            law: &|| law_of(&contact.interface),
            passes: (kind.passes)(contact),
            tie_terms,
            outlines,
            search: &|| (search.make)(),
            rebuild: self.rebuild,
        };
        let made = (kind.make)(setup).map_err(|fault| vec![fault])?;
        Ok((self.with_images(made, mirrors, contact), terms))
    }

    /// The surfaces of a contact: two, or one that meets itself. Faults have paths relative to the contact.
    pub(crate) fn outlines_of(&self, contact: &model::Contact) -> Result<Vec<Outlined>, Vec<Fault>> {
        match &contact.partners {
            Partners::Between(between) => {
                let sides = (0..).zip(between).map(|(side, name)| {
                    let outline = self.outlined(|leave_out| self.mesh.surface(name, leave_out), &format!("surface \"{name}\""));
                    outline.map_err(|fault| Fault { path: format!("between[{side}]"), ..fault })
                });
                let (good, faulty): (Vec<_>, Vec<_>) = sides.partition(Result::is_ok);
                if faulty.is_empty() {
                    Ok(good.into_iter().flatten().collect())
                } else {
                    Err(faulty.into_iter().filter_map(Result::err).collect())
                }
            }
            Partners::Bodies(parts) => {
                let outline = self.outlined(|leave_out| self.mesh.outside_without(parts, leave_out), "the outside of the bodies");
                outline.map(|outline| vec![outline]).map_err(|fault| vec![Fault { path: "bodies".into(), ..fault }])
            }
        }
    }

    /// A surface without the segments on symmetry lines, and the normals of the lines at the ends that this
    /// leaves open.
    pub(crate) fn outlined(
        &self,
        surface: impl Fn(&dyn Fn([u32; 2]) -> bool) -> Result<Surface<2>, Fault>,
        what: &str,
    ) -> Result<Outlined, Fault> {
        let lids = RefCell::new(Vec::new());
        let surface = surface(&|segment| {
            let is_lid = self.constraints.is_mirror(segment);
            if is_lid {
                lids.borrow_mut().push(segment);
            }
            is_lid
        })?;
        if surface.segments.is_empty() {
            return Err(Fault::new(&ON_SYMMETRY, "", format!("{what} lies on a symmetry line altogether"), "name another surface"));
        }
        Ok(Outlined { target: self.with_mirrors(surface), lids: lids.into_inner() })
    }

    /// A surface as a target that continues beyond symmetry lines.
    fn with_mirrors(&self, surface: Surface<2>) -> Target {
        let starts =
            surface.segments.iter().zip(&surface.previous).filter(|(_, previous)| **previous == NONE).map(|(segment, _)| segment[0]);
        let ends = surface.segments.iter().zip(&surface.next).filter(|(_, next)| **next == NONE).map(|(segment, _)| segment[1]);
        let open = starts.chain(ends);
        let mut mirrors: Vec<(u32, [f64; 2])> =
            open.filter_map(|node| Some((node, self.constraints.mirror_normals(node).next()?))).collect();
        mirrors.sort_by_key(|&(node, _)| node);
        Target { surface, mirrors }
    }
}

impl Builder<'_, 2> {
    /// Whether a point lies on a symmetry line of one of these parts (none: all) or beyond it, where the
    /// mirror images of the parts are.
    pub(crate) fn is_beyond_mirrors(&self, x: [f64; 2], parts: &[String]) -> bool {
        let tolerance = crate::mesh::tolerance(&self.mesh.positions);
        let concerns = |held: &[String]| held.is_empty() || parts.is_empty() || held.iter().any(|part| parts.contains(part));
        self.mirrors()
            .any(|(number, point, normal)| concerns(&self.model.symmetries[number].parts) && dot(minus(x, point), normal) <= tolerance)
    }
}

/// A surface of a contact.
pub(crate) struct Outlined {
    pub(super) target: Target,
    /// Segments that were left out because they lie on a symmetry line.
    pub(super) lids: Vec<[u32; 2]>,
}
