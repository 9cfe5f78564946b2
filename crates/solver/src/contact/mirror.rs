//! Bodies against their own mirror image in a symmetry line, in 3D a plane: a fold that reaches it meets
//! its image there.
//!
//! Lines or planes, and nodes, come from the builder; springs go to the same solution as those of the contact
//! itself. By symmetry a node meets the image where it meets the line or plane, at half of the gap. Of the
//! two passes of the pair, node against image and image against node, half belongs to the model: with the
//! stiffness k of a pass its energy is 2 · ½ k (2g)² / 2 = ½ (4k) g².

use super::springs::{Answers, End, Slip, Spring, Springs};
use super::{Formulation, Origins, Scene};
use crate::archive::{Archive, ArchiveResult};
use crate::contact::springs::TangentSpace;
use crate::tensor::Dim;
use crate::vector::{dot, length, minus};
use std::any::Any;

/// A node that may reach the line or plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MirroredNode {
    /// The node.
    pub node: u32,
    /// Constant of its spring on the distance from there, N/m, in 2D per metre of depth.
    pub stiffness: f64,
    /// Surface that it stands for, m (in 3D m²).
    pub area: f64,
    /// Distance that it keeps from there, m: half of that from its image.
    pub distance: f64,
}

/// A symmetry line or plane with the nodes on its free side.
#[derive(Clone, Debug, PartialEq)]
pub struct Mirror<const D: usize> {
    /// A point of it, m.
    pub point: [f64; D],
    /// Unit normal that points to the model.
    pub normal: [f64; D],
    /// What may reach it.
    pub nodes: Vec<MirroredNode>,
    /// Nodes within this distance get a spring, m.
    pub reach: f64,
}

/// A contact of bodies with each other and themselves, and with their images.
pub struct Mirrored<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    contact: Box<dyn Formulation<D>>,
    mirrors: Vec<Mirror<D>>,
    /// Number of the terms of the springs to the images.
    terms: usize,
    /// How many of these there are in this step.
    found: usize,
}

impl<const D: usize> Mirrored<D>
where
    Dim<D>: TangentSpace<D>,
{
    /// From a contact; springs to the images follow the terms number `terms`, which act on half of the gap.
    #[must_use]
    pub fn new(contact: Box<dyn Formulation<D>>, mirrors: Vec<Mirror<D>>, terms: usize) -> Self {
        Self { contact, mirrors, terms, found: 0 }
    }
}

impl<const D: usize> Formulation<D> for Mirrored<D>
where
    Dim<D>: TangentSpace<D>,
{
    fn detect(&mut self, scene: &Scene<'_, D>, springs: &mut Springs<D>) {
        let begin = springs.list.len();
        for &Mirror { point, normal, ref nodes, reach } in &self.mirrors {
            for &MirroredNode { node, stiffness, area, distance } in nodes {
                let [from, to] = [scene.sweep.old, scene.sweep.new].map(|positions| positions[node as usize]);
                let gap = dot(minus(to, point), normal) - distance;
                let way = f64::sqrt(D as f64) * length(minus(to, from));
                // Well before it touches: a spring that closes unseen would give back what it never took.
                if gap <= reach + 4.0 * way {
                    springs.push(Spring { normal, gap, stiffness, area, ..Spring::default() }, Slip::default(), &[End::node(node, 1.0)]);
                }
            }
        }
        self.found = springs.list.len() - begin;
        springs.close_group(self.terms);
        self.contact.detect(scene, springs);
    }

    fn remember(&mut self, solved: Answers<'_, D>) {
        // Nothing is found, and nothing solved, while the contact does not act.
        self.contact.remember(solved.part(self.found, usize::MAX));
    }

    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        // How many springs to images there are counts within a step.
        let Self { contact, mirrors: _, terms: _, found: _ } = self;
        contact.persist(archive)
    }

    fn inherit(&mut self, old: Box<dyn Any>) {
        if let Ok(old) = old.downcast::<Self>() {
            self.contact.inherit(old.contact);
        }
    }

    fn carry(&mut self, old: &dyn Any, origins: &Origins<'_, D>) {
        if let Some(old) = old.downcast_ref::<Self>() {
            self.contact.carry(&*old.contact, origins);
        }
    }

    fn within(&self) -> Option<&dyn Formulation<D>> {
        Some(&*self.contact)
    }
}
