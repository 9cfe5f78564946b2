//! Bodies against their own mirror image in a symmetry line: a fold that reaches the line meets its image there.
//!
//! Lines and nodes come from the builder; springs go to the same solution as those of the contact itself. By symmetry a node meets the image where it meets the line, at half of the
//! gap. Of the two passes of the pair, node against image and image against node, half belongs to the model: with the stiffness k of a pass its energy is 2 · ½ k (2g)² / 2 = ½ (4k) g².

use super::springs::{Answers, End, Spring, Springs};
use super::tied::Ties;
use super::tracker::{Certificate, SearchReport};
use super::{Formulation, Scene, Vector};
use crate::archive::{Archive, Kept};
use std::any::Any;

/// A node that may reach the line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MirroredNode {
    /// The node.
    pub node: u32,
    /// Constant of its spring on the distance from the line, N/m per metre of depth.
    pub stiffness: f64,
    /// Length of surface that it stands for, m.
    pub area: f64,
    /// Distance that it keeps from the line, m: half of that from its image.
    pub distance: f64,
}

/// A symmetry line with the nodes on its free side.
#[derive(Clone, Debug, PartialEq)]
pub struct MirrorLine {
    /// A point of it, m.
    pub point: Vector,
    /// Unit normal that points to the model.
    pub normal: Vector,
    /// What may reach it.
    pub nodes: Vec<MirroredNode>,
    /// Nodes within this distance get a spring, m.
    pub reach: f64,
}

/// A contact of bodies with each other and themselves, and with their images.
pub struct Mirrored {
    contact: Box<dyn Formulation>,
    lines: Vec<MirrorLine>,
    /// Number of the terms of the springs to the images.
    terms: usize,
    /// How many of these there are in this step.
    found: usize,
}

impl Mirrored {
    /// From a contact; springs to the images follow the terms number `terms`, which act on half of the gap.
    #[must_use]
    pub fn new(contact: Box<dyn Formulation>, lines: Vec<MirrorLine>, terms: usize) -> Self {
        Self { contact, lines, terms, found: 0 }
    }
}

impl Formulation for Mirrored {
    fn detect(&mut self, scene: &Scene<'_>, springs: &mut Springs) {
        let begin = springs.list.len();
        for &MirrorLine { point, normal, ref nodes, reach } in &self.lines {
            for &MirroredNode { node, stiffness, area, distance } in nodes {
                let [from, to] = [scene.sweep.old, scene.sweep.new].map(|positions| positions[node as usize]);
                let gap = (to[0] - point[0]) * normal[0] + (to[1] - point[1]) * normal[1] - distance;
                // Well before it touches: a spring that closes unseen would give back what it never took.
                if gap <= reach + 4.0 * ((to[0] - from[0]).abs() + (to[1] - from[1]).abs()) {
                    springs.push(Spring { normal, gap, stiffness, area, ..Spring::default() }, &[End::node(node, 1.0)]);
                }
            }
        }
        self.found = springs.list.len() - begin;
        springs.close_group(self.terms);
        self.contact.detect(scene, springs);
    }

    fn remember(&mut self, solved: Answers<'_>) {
        // Nothing is found, and nothing solved, while the contact does not act.
        self.contact.remember(solved.part(self.found, usize::MAX));
    }

    fn keep(&mut self, archive: &mut Archive<'_>) -> Kept {
        // How many springs to images there are counts within a step.
        let Self { contact, lines: _, terms: _, found: _ } = self;
        contact.keep(archive)
    }

    fn inherit(&mut self, old: Box<dyn Any>) {
        if let Ok(old) = old.downcast::<Self>() {
            self.contact.inherit(old.contact);
        }
    }

    fn freed(&self) -> f64 {
        self.contact.freed()
    }

    fn let_go(&self) -> f64 {
        self.contact.let_go()
    }

    fn ties(&self) -> Option<Ties> {
        self.contact.ties()
    }

    fn certificate(&self) -> Certificate {
        self.contact.certificate()
    }

    fn search_report(&self) -> Option<SearchReport> {
        self.contact.search_report()
    }
}
