//! Forces on nodes: given forces on sets, and pressures on surfaces.
//!
//! force: F c(t) in all, shared over a surface by tributary length, over other sets equally pressure: −p c(t)
//! n per current length of each segment, n its current outward normal, half to each node: it follows the
//! surface
//!
//! with a factor c(t) of a curve. Works are external. A closed surface under pressure feels no resultant.

use super::curve::Curves;
use super::curve::factor::Factor;
use crate::archive::{Archive, ArchiveResult};
use crate::error::Fault;
use crate::mesh::geometry::CellGeometry;
use crate::mesh::surface::tributary::{self, Depth, Tributary};
use crate::mesh::surface::{Corners, Facet, Sided};
use crate::mesh::{Mesh, Meshed};
use crate::model::messages::UNKNOWN_NAME;
use crate::model::{Load, Model};
use crate::rotation::Rotate;
use crate::tensor::Dim;
use crate::vector::{first, minus, plus, times};

/// The forces on nodes of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Forces<const D: usize>
where
    Dim<D>: Meshed<D>,
{
    loads: Vec<Acting<D>>,
    /// Forces that somebody gave while the simulation stood between two steps: nodes, ascending, and their
    /// forces, N/m.
    pushes: Vec<(u32, [f64; D])>,
    /// Force on every node now, N/m; empty when the model has no such load.
    now: Vec<[f64; D]>,
    depth: Depth,
}

#[derive(Clone, Debug, PartialEq)]
struct Acting<const D: usize>
where
    Dim<D>: Meshed<D>,
{
    what: What<D>,
    factor: Factor,
    /// Place in the model.
    index: usize,
    /// Mean of the nodes at the start, m.
    point: [f64; D],
    /// What it sums up to now.
    resultant: Resultant<D>,
}

/// What a load sums up to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Resultant<const D: usize> {
    /// Force, N/m.
    pub(crate) force: [f64; D],
    /// Moment about the mean of the load's nodes at the start, N (N m); in 2D about z alone.
    pub(crate) moment: [f64; 3],
}

impl<const D: usize> Default for Resultant<D> {
    fn default() -> Self {
        Self { force: [0.0; D], moment: [0.0; 3] }
    }
}

impl<const D: usize> Resultant<D>
where
    Dim<D>: Rotate<D>,
{
    /// Adds a force at an arm, m.
    fn add(&mut self, arm: [f64; D], force: [f64; D]) {
        self.force = plus(self.force, force);
        self.moment = plus(self.moment, <Dim<D>>::moment_vector(arm, force));
    }
}

impl<const D: usize> What<D>
where
    Dim<D>: Meshed<D>,
{
    /// Its nodes, with repetitions.
    fn nodes(&self) -> Vec<u32> {
        match self {
            Self::Given(forces) => forces.iter().map(|&(node, _)| node).collect(),
            Self::Pressure(facets, _) => facets.iter().flat_map(Corners::corners).copied().collect(),
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
enum What<const D: usize>
where
    Dim<D>: Meshed<D>,
{
    /// Nodes and their forces, N/m.
    Given(Vec<(u32, [f64; D])>),
    /// Pieces of the outside, and the pressure, Pa.
    Pressure(Vec<Facet<D>>, f64),
}

impl<const D: usize> Forces<D>
where
    Dim<D>: CellGeometry<D> + Rotate<D>,
{
    /// `is_mirror` says which segments lie on a symmetry line: they are no surface.
    ///
    /// # Errors
    /// Names of nothing, or of what is no surface.
    pub fn new(model: &Model, mesh: &Mesh<D>, curves: &Curves, is_mirror: impl Fn(Facet<D>) -> bool) -> Result<Self, Vec<Fault>> {
        let (mut loads, mut faults, depth) = (Vec::new(), Vec::new(), Depth::of(model));
        for (i, load) in model.loads.iter().enumerate() {
            let what = match load {
                Load::Force { on, force, .. } => given(mesh, on, first(*force), depth, &is_mirror),
                Load::Pressure { on, pressure, .. } => {
                    mesh.surface(on, &is_mirror).map(|surface| What::Pressure(surface.facets().to_vec(), *pressure))
                }
                Load::Gravity { .. }
                | Load::Centrifugal { .. }
                | Load::Damping { .. }
                | Load::StiffnessDamping { .. }
                | Load::Moment { .. } => continue,
            };
            match what {
                Ok(what) => loads.push(Acting {
                    factor: curves.factor_on(i, load),
                    index: i,
                    point: mesh.mean_place(&what.nodes()),
                    resultant: Resultant::default(),
                    what,
                }),
                Err(fault) => faults.push(Fault { path: format!("load[{i}].on"), ..fault }),
            }
        }
        if faults.is_empty() { Ok(Self { loads, pushes: Vec::new(), now: Vec::new(), depth }) } else { Err(faults) }
    }

    /// Whether the model has no such load.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.loads.is_empty()
    }

    /// Takes their means between two times (s) at these positions (m).
    pub fn prepare(&mut self, curves: &Curves, update: [f64; 2], positions: &[[f64; D]]) {
        if self.loads.is_empty() && self.pushes.is_empty() {
            // The last push may have ended.
            self.now.clear();
            return;
        }
        self.now.clear();
        self.now.resize(positions.len(), [0.0; D]);
        for Acting { what, factor, point, resultant, .. } in &mut self.loads {
            let factor = curves.factor(*factor, update);
            *resultant = Resultant::default();
            let mut add = |node: u32, force: [f64; D], factor: f64| {
                let (sum, force) = (&mut self.now[node as usize], times(factor, force));
                *sum = plus(*sum, force);
                resultant.add(minus(positions[node as usize], *point), force);
            };
            match what {
                What::Given(forces) => forces.iter().for_each(|&(node, force)| add(node, force, factor)),
                What::Pressure(facets, pressure) => {
                    for facet in facets {
                        let presses = Dim::<D>::presses(self.depth, *facet, positions);
                        for (&node, &(inward, share)) in facet.corners().iter().zip(presses.as_ref()).filter(|(_, press)| press.1 > 0.0) {
                            add(node, inward, factor * *pressure * share);
                        }
                    }
                }
            }
        }
        for &(node, force) in &self.pushes {
            let sum = &mut self.now[node as usize];
            *sum = plus(*sum, force);
        }
    }

    /// Adds forces on some of all nodes, of which there are so many.
    pub(crate) fn add(&mut self, given: impl Iterator<Item = (u32, [f64; D])>, nodes: usize) {
        self.now.resize(nodes, [0.0; D]);
        for (node, force) in given {
            let sum = &mut self.now[node as usize];
            *sum = plus(*sum, force);
        }
    }

    /// Lets `by` hand those on some nodes on to others: it reads forces, and pushes. What is handed on is
    /// gone from where it was.
    pub(crate) fn hand_on(&mut self, by: impl FnOnce(&dyn Fn(usize) -> [f64; D], &mut dyn FnMut(u32, [f64; D], u32))) {
        if self.now.is_empty() {
            return;
        }
        let mut pushes = Vec::new();
        by(&|node| self.now[node], &mut |to, force, from| pushes.push((to, force, from)));
        for (to, force, from) in pushes {
            self.now[to as usize] = plus(self.now[to as usize], force);
            self.now[from as usize] = [0.0; D];
        }
    }

    /// Lets these forces (N/m) act on nodes from the next update on, until others are given for them; a force
    /// of zero ends that of its node.
    pub fn push(&mut self, given: impl IntoIterator<Item = (u32, [f64; D])>) {
        for (node, force) in given {
            match (self.pushes.binary_search_by_key(&node, |&(node, _)| node), force == [0.0; D]) {
                (Ok(at), false) => self.pushes[at].1 = force,
                (Ok(at), true) => drop(self.pushes.remove(at)),
                (Err(at), false) => self.pushes.insert(at, (node, force)),
                (Err(_), true) => {}
            }
        }
    }

    /// What was given so, in a kept state.
    pub(crate) fn persist_pushes(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        archive.on_nodes(&mut self.pushes)
    }

    /// Leaves nodes without elements alone, and surfaces that are outside no more.
    pub fn renew(&mut self, is_free: impl Fn(u32) -> bool, is_outside: impl Fn(Facet<D>) -> bool) {
        self.pushes.retain(|&(node, _)| !is_free(node));
        for load in &mut self.loads {
            match &mut load.what {
                What::Given(forces) => forces.retain(|&(node, _)| !is_free(node)),
                What::Pressure(facets, _) => facets.retain(|&facet| is_outside(facet)),
            }
        }
    }

    /// What each load sums up to now, with its place in the model.
    pub(crate) fn resultants(&self) -> impl Iterator<Item = (usize, Resultant<D>)> {
        self.loads.iter().map(|load| (load.index, load.resultant))
    }

    /// Force on every node now, N/m; empty when the model has no such load.
    #[must_use]
    pub fn now(&self) -> &[[f64; D]] {
        &self.now
    }
}

/// Shares a force over a set.
fn given<const D: usize>(
    mesh: &Mesh<D>,
    on: &str,
    force: [f64; D],
    depth: Depth,
    is_mirror: &impl Fn(Facet<D>) -> bool,
) -> Result<What<D>, Fault>
where
    Dim<D>: CellGeometry<D> + Rotate<D>,
{
    let nodes = mesh.nodes(on).filter(|nodes| !nodes.is_empty());
    let Some(nodes) = nodes else {
        return Err(Fault::new(
            &UNKNOWN_NAME,
            "",
            format!("there is nothing called \"{on}\""),
            "name a side as part.side, or a group of a mesh file",
        ));
    };
    let mut shares: Vec<(u32, f64)> = nodes.into_iter().map(|node| (node, 0.0)).collect();
    // A group of lines inside a body is no surface: its nodes are equal.
    match mesh.surface(on, is_mirror) {
        Ok(surface) if !surface.facets().is_empty() => {
            for &facet in surface.facets() {
                for (node, part) in tributary::shares(depth, facet, &mesh.positions) {
                    let node = mesh.leader_of(node);
                    if let Ok(at) = shares.binary_search_by_key(&node, |&(node, _)| node) {
                        shares[at].1 += part;
                    }
                }
            }
        }
        _ => shares.iter_mut().for_each(|(_, share)| *share = 1.0),
    }
    let sum: f64 = shares.iter().map(|(_, share)| share).sum();
    Ok(What::Given(shares.into_iter().map(|(node, share)| (node, force.map(|component| component * share / sum))).collect()))
}
