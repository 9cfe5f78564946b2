//! What a contact makes of its surfaces: the list of formulations, and what each is made from in 2D and 3D.
//!
//! The builder fills a [`Setup`] with plain numbers (contact knows nothing of elements); the formulation that
//! the model names makes itself from it. One formulation a file, one line in [`FORMULATIONS`].

use super::depths::Depths;
use super::initial::is_ignored;
use super::law::penalty::{penalty_of, share_of_mass, stiffness};
use super::law::{Law, Node};
use super::node_facet;
use super::outline::{Outline, Outlines};
use super::overlap::OverlapCheck;
use super::projection::node_segment::Target;
use super::search::Search;
use super::slaves::{Face, PassInput, Slave};
use super::springs::TangentSpace;
use super::tracker::Tracker;
use super::{Formulation, Tributary, node_segment, pinball, segment};
use crate::contact::messages::COMBINATION;
use crate::error::Fault;
use crate::mesh::cell::Cell;
use crate::mesh::surface::tributary::Depth;
use crate::mesh::surface::{Facet, Sided, SpaceSurface};
use crate::model::messages::NOT_IN_SPACE;
use crate::model::{self, Partners, Penalty, PenaltySource};
use crate::tensor::Dim;
use std::collections::BTreeSet;

/// Makes a formulation. Faults have paths relative to the contact.
pub type Make<const D: usize> = fn(Setup<'_, D>) -> Result<Box<dyn Formulation<D>>, Fault>;

/// A formulation as the registry describes it.
#[derive(Clone, Copy)]
pub struct FormulationKind {
    /// Name in the model file.
    pub name: &'static str,
    /// One line: what meets what.
    pub doc: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// Which nodes meet which surface.
    pub passes: fn(&model::Contact) -> Passes,
    /// What it is in contacts with `tied`; `None`: it can't hold surfaces together.
    pub tied: Option<&'static FormulationKind>,
    /// Whether in 2D what it knows goes over to surfaces of elements that were made again.
    pub is_carried: bool,
    /// Makes one in 2D; `None`: there is none.
    pub in_2d: Option<Make<2>>,
    /// Makes one in 3D; `None`: there is none.
    pub in_3d: Option<Make<3>>,
}

/// Every formulation.
pub const FORMULATIONS: &[FormulationKind] = &[node_segment::DOUBLE_PASS, node_segment::SINGLE_PASS, segment::KIND, pinball::KIND];

impl FormulationKind {
    /// Dimensions in which it exists.
    #[must_use]
    pub fn dimensions(&self) -> &'static [usize] {
        match (self.in_2d, self.in_3d) {
            (Some(_), Some(_)) => &[2, 3],
            (Some(_), None) => &[2],
            (None, Some(_)) => &[3],
            (None, None) => &[],
        }
    }

    /// The fault of a contact that names it in a dimension in which it does not exist; the path is relative
    /// to the contact.
    #[must_use]
    pub fn refusal(&self, dimension: usize) -> Option<Fault> {
        if self.dimensions().contains(&dimension) {
            return None;
        }
        let there = FORMULATIONS.iter().filter(|kind| kind.dimensions().contains(&dimension));
        let names: Vec<String> = there.map(|kind| format!("`{}`", kind.name)).collect();
        let (last, others) = names.split_last()?;
        let message = format!("in {dimension}D there is no formulation \"{}\"", self.name);
        let kind = if dimension == 3 { &NOT_IN_SPACE } else { &COMBINATION };
        Some(Fault::new(kind, "formulation", message, format!("take {} or {last}", others.join(", "))))
    }
}

/// The formulation of a contact.
#[must_use]
pub fn kind_of(contact: &model::Contact) -> Option<&'static FormulationKind> {
    let name = contact.formulation.name();
    let kind = FORMULATIONS.iter().find(|kind| kind.name == name)?;
    if contact.tied.is_some() { kind.tied } else { Some(kind) }
}

/// Passes of a contact: (slave, target).
pub type Passes = &'static [(usize, usize)];

/// Nodes of each surface against the other, or of one against itself.
#[must_use]
pub fn both_passes(contact: &model::Contact) -> Passes {
    if matches!(contact.partners, Partners::Bodies(_)) { &[(0, 0)] } else { &[(0, 1), (1, 0)] }
}

/// Nodes of the slave surface against the other; where none is named the first one is slave.
#[must_use]
pub fn one_pass(contact: &model::Contact) -> Passes {
    if matches!(contact.formulation, model::Formulation::SinglePass { slave } if slave > 0) { &[(1, 0)] } else { &[(0, 1)] }
}

/// What contact between surfaces is made of in a dimension.
pub trait Surfaces<const D: usize>: TangentSpace<D> {
    /// A surface that nodes are projected on.
    type Target: Sided<Facet = Self::Facet>;
    /// What looks at the bodies as they are.
    type OverlapCheck;
    /// What follows nodes of surfaces along others.
    type Tracker;
    /// Follows the nodes of `surfaces[slave]` along `surfaces[target]` in each pass (slave, target), which
    /// may be the same surface; `bodies` of each node of the model, `positions` the initial ones, m.
    fn tracker(
        surfaces: Vec<ContactSurface<D>>,
        passes: &[(usize, usize)],
        search: Box<dyn Search<D>>,
        bodies: &[u32],
        positions: &[[f64; D]],
    ) -> Self::Tracker
    where
        Dim<D>: Surfaces<D>;
    /// What makes a formulation; `None`: there is none in this dimension.
    fn maker(kind: &FormulationKind) -> Option<Make<D>>
    where
        Dim<D>: Surfaces<D>;
}

impl Surfaces<2> for Dim<2> {
    type Target = Target;
    type OverlapCheck = Depths;
    type Tracker = Tracker;
    fn tracker(
        surfaces: Vec<ContactSurface<2>>,
        passes: &[(usize, usize)],
        search: Box<dyn Search<2>>,
        bodies: &[u32],
        positions: &[[f64; 2]],
    ) -> Tracker {
        let (targets, lids): (Vec<_>, Vec<_>) = surfaces.into_iter().map(|surface| (surface.target, surface.lids)).unzip();
        Tracker::new(targets, passes, search, positions).with_bodies(bodies, &lids)
    }
    fn maker(kind: &FormulationKind) -> Option<Make<2>> {
        kind.in_2d
    }
}

impl Surfaces<3> for Dim<3> {
    type Target = SpaceSurface;
    type OverlapCheck = OverlapCheck;
    type Tracker = node_facet::tracker::Tracker;
    fn tracker(
        surfaces: Vec<ContactSurface<3>>,
        passes: &[(usize, usize)],
        search: Box<dyn Search<3>>,
        bodies: &[u32],
        positions: &[[f64; 3]],
    ) -> Self::Tracker {
        Self::Tracker::new(surfaces.into_iter().map(|surface| surface.target).collect(), passes, bodies, search, positions)
    }
    fn maker(kind: &FormulationKind) -> Option<Make<3>> {
        kind.in_3d
    }
}

/// A surface of a contact.
#[derive(Clone, Debug, Default)]
pub struct ContactSurface<const D: usize>
where
    Dim<D>: Surfaces<D>,
{
    /// The surface.
    pub target: <Dim<D> as Surfaces<D>>::Target,
    /// Segments or facets that were left out of it because they lie on a symmetry line or plane.
    pub lids: Vec<Facet<D>>,
}

impl From<SpaceSurface> for ContactSurface<3> {
    fn from(target: SpaceSurface) -> Self {
        Self { target, lids: Vec::new() }
    }
}

/// A surface, and what contact needs of the elements behind it.
#[derive(Clone, Debug, Default)]
pub struct Side<'a, const D: usize>
where
    Dim<D>: Surfaces<D>,
{
    /// The surface.
    pub surface: ContactSurface<D>,
    /// Pressure stiffness κ of the element behind each facet, Pa/m.
    pub stiffness: Vec<f64>,
    /// The same of the softest element of its part.
    pub softest: Vec<f64>,
    /// α m / (dt² A) of the lightest node of each facet, Pa/m.
    pub of_mass: Vec<f64>,
    /// What each node stands for.
    pub nodes: Vec<Tributary>,
    /// Part of each node that belongs to the model, and not to its images.
    pub shares: Vec<f64>,
    /// The element behind each facet; `None` where it is not known.
    pub cells: Vec<Option<Cell<'a>>>,
}

impl<const D: usize> Side<'_, D>
where
    Dim<D>: Surfaces<D>,
{
    /// Its nodes as slaves against another surface, in one of so many `passes` that carry the pressure
    /// together.
    #[must_use]
    pub fn against(&self, target: &Self, penalty: Penalty, passes: usize) -> PassInput {
        let share_of_mass = share_of_mass(penalty);
        let slave = |(&own, &share): (&Tributary, &f64)| Slave {
            stiffness: stiffness(penalty, Node { own, other: f64::INFINITY, share }, passes),
            area: own.area / passes as f64,
            of_mass: share_of_mass * own.of_mass * own.area / passes as f64,
        };
        let per_modulus = match penalty {
            Penalty::Automatic { scale, .. } => self.nodes.iter().map(|own| scale * own.area / passes as f64).collect(),
            Penalty::PerNode(_) | Penalty::Pressure(_) => Vec::new(),
        };
        PassInput {
            slaves: self.nodes.iter().zip(&self.shares).map(slave).collect(),
            per_modulus,
            moduli: target.softest.clone(),
            of_mass: target.of_mass.iter().map(|of_mass| share_of_mass * of_mass).collect(),
            ..PassInput::default()
        }
    }
}

impl Side<'_, 2> {
    /// Sees how deep nodes of these sides are against the local thickness; where `is_judging`, bodies are
    /// checked as they are.
    #[must_use]
    pub fn depths(sides: &[Self], outlines: &Outlines, bodies: &[u32], is_judging: bool) -> Depths {
        let surfaces = || sides.iter().map(|side| &side.surface.target.surface);
        let depths = Depths::new(surfaces().map(|surface| outlines.opposite(surface)).collect());
        if !is_judging {
            return depths;
        }
        let body = |segment: &[u32; 2]| bodies.get(segment[0] as usize).copied().unwrap_or(0);
        let sides: Vec<BTreeSet<u32>> = surfaces().map(|surface| surface.segments.iter().map(body).collect()).collect();
        let last = sides.len() - 1;
        let on = |outline: &Outline| u8::from(sides[0].contains(&outline.body)) + 2 * u8::from(sides[last].contains(&outline.body));
        depths.judging(outlines.bodies.iter().map(|outline| (outline.clone(), on(outline))).filter(|(_, on)| *on > 0).collect())
    }
}

/// What a formulation is made from.
pub struct Setup<'a, const D: usize>
where
    Dim<D>: Surfaces<D>,
{
    /// The contact as the model has it.
    pub contact: &'a model::Contact,
    /// Two surfaces, or one that meets itself.
    pub sides: Vec<Side<'a, D>>,
    /// Which nodes meet which of them.
    pub passes: Passes,
    /// Body of each node of the model.
    pub bodies: &'a [u32],
    /// Initial positions, m.
    pub positions: &'a [[f64; D]],
    /// What lengths are multiplied by.
    pub depth: Depth,
    /// Makes the law of the normal force.
    pub law: &'a dyn Fn() -> Box<dyn Law>,
    /// Number of the terms that its ties follow; of a contact that is not tied those of all its springs.
    pub tie_terms: usize,
    /// Makes a search of the kind that the contact names.
    pub search: &'a dyn Fn() -> Box<dyn Search<D>>,
    /// Looks at the bodies as they are.
    pub overlap_check: <Dim<D> as Surfaces<D>>::OverlapCheck,
    /// Whether it will take over from one that has acted already, because surfaces have changed.
    pub rebuild: bool,
}

impl<const D: usize> Setup<'_, D>
where
    Dim<D>: Surfaces<D>,
{
    /// As [`penalty_of`].
    #[must_use]
    pub fn penalty(&self) -> Penalty {
        penalty_of(&self.contact.interface)
    }

    /// As [`is_ignored`].
    #[must_use]
    pub fn ignores_start(&self) -> bool {
        is_ignored(&self.contact.interface)
    }

    /// The slaves of a pass, one of so many `passes` that carry the pressure together.
    #[must_use]
    pub fn input(&self, (slave, target): (usize, usize), passes: usize) -> PassInput {
        self.sides[slave].against(&self.sides[target], self.penalty(), passes)
    }

    /// Follows the nodes of the passes; takes the surfaces.
    #[must_use]
    pub fn tracker(&mut self) -> <Dim<D> as Surfaces<D>>::Tracker {
        let surfaces = self.sides.iter_mut().map(|side| std::mem::take(&mut side.surface)).collect();
        Dim::<D>::tracker(surfaces, self.passes, (self.search)(), self.bodies, self.positions)
    }
}

impl Setup<'_, 2> {
    /// What each of the segments at the nodes of a side has of the node's tributary length and of its
    /// stiffness: [that which ends there, that which begins there].
    #[must_use]
    pub fn faces(&self, side: usize) -> Vec<[Face; 2]> {
        let Side { surface: ContactSurface { target, .. }, stiffness, .. } = &self.sides[side];
        let surface = &target.surface;
        let mut faces = vec![[Face::default(); 2]; surface.nodes.len()];
        for (&segment, stiffness) in surface.segments.iter().zip(stiffness) {
            let shares = self.depth.shares(segment.map(|node| self.positions[node as usize]));
            for (end, (node, length)) in segment.iter().zip(shares).enumerate() {
                if let Ok(at) = surface.nodes.binary_search(node) {
                    faces[at][1 - end] = Face { length, stiffness: length * stiffness };
                }
            }
        }
        let penalty = self.penalty();
        for [before, after] in &mut faces {
            let (whole, stiff) = (before.length + after.length, before.stiffness + after.stiffness);
            for face in [before, after] {
                face.length /= whole;
                face.stiffness = match penalty {
                    Penalty::Pressure(_) => face.length,
                    Penalty::Automatic { source: PenaltySource::WaveModulus | PenaltySource::BulkModulus, .. } if stiff > 0.0 => {
                        face.stiffness / stiff
                    }
                    // What is given for a node, or made from its mass, is the node's on any face.
                    Penalty::PerNode(_) | Penalty::Automatic { .. } => 1.0,
                };
            }
        }
        faces
    }
}
