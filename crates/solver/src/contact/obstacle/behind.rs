//! How deep bodies are in a rigid obstacle against their local thickness: nodes in each step, and what lies
//! between them where the obstacle is round and as small as their facets.
//!
//! A node is as deep as its spring says. A facet is as deep in a circle, ball or cylinder as its place
//! nearest to the middle, which is exact: that is looked at before the bodies may have gone an eighth of
//! their least thickness, after 16 steps at least, and in each step while the obstacle moves. What is deeper
//! counts as in 2D: than a fifth of the thickness in two steps, or 0.22 in one.

use super::super::Scene;
use super::super::findings::{BETWEEN_LOOKS, CAST, DEEPEST_IN_PLANE, Findings, MOST_STEPS, Overlap, SEEN, way_until_next};
use crate::archive::{Archive, ArchiveResult, persist_each};
use crate::contact::springs::TangentSpace;
use crate::mesh::surface::NONE;
use crate::model::in_3d;
use crate::rigid::Body;
use crate::tensor::Dim;
use crate::vector::{length, minus};

/// Takes a facet: its corners, m, local thickness there, m, and a node.
pub type See<'a, const D: usize> = &'a mut dyn FnMut(&[[f64; D]], f64, u32);

/// The bodies that an obstacle meets: their facets and how thick they are there.
pub trait Thick<const D: usize>: Send + Sync {
    /// Takes the places of their nodes, m.
    fn place(&mut self, positions: &[[f64; D]]);

    /// Least local thickness at a node in these places, m; infinite: not known.
    fn at(&self, node: u32) -> f64;

    /// Least local thickness of all, m.
    fn least(&self) -> f64;

    /// Shows all facets, in 3D as triangles.
    fn facets(&self, see: See<'_, D>);
}

/// Bodies of which nothing is known.
#[cfg(test)]
pub struct Unknown;

#[cfg(test)]
impl<const D: usize> Thick<D> for Unknown {
    fn place(&mut self, _: &[[f64; D]]) {}

    fn at(&self, _: u32) -> f64 {
        f64::INFINITY
    }

    fn least(&self) -> f64 {
        f64::INFINITY
    }

    fn facets(&self, _: See<'_, D>) {}
}

/// Depths against the local thickness.
pub struct Behind<const D: usize> {
    bodies: Box<dyn Thick<D>>,
    findings: Findings,
    /// Least thickness at the start, and that of the obstacle, m; infinite: it has no other side.
    least: f64,
    obstacle: f64,
    /// Half of the way that a deep node went in this step, as the obstacle sees it, m: both sides' ways are
    /// as long then.
    way: f64,
    was_deep: bool,
    is_placed: bool,
    /// What the obstacle has gone, m.
    gone: f64,
    /// Ways of both sides at which facets are looked at again, m, and steps since.
    next: f64,
    steps: u32,
}

/// Facets may stretch by this factor while they slide off a round obstacle.
const STRETCH: f64 = 4.0;

/// Into how many parts the longest edge of a facet has to be divided for what a chord cuts off a circle of
/// this radius (m) to be as deep as overlaps are that count for nothing where the bodies are so thick, m.
pub(super) fn divisions<const D: usize>(corners: &[[f64; D]], radius: f64, thickness: f64) -> f64 {
    let edge = |k: usize| length(minus(corners[(k + 1) % corners.len()], corners[k]));
    let longest = (0..corners.len()).map(edge).fold(0.0, f64::max);
    longest / (8.0 * radius * CAST * thickness).sqrt()
}

/// Whether something may be deep between the nodes of a facet that would have to be divided so many times.
pub(super) fn may_be_between(divisions: f64) -> bool {
    STRETCH * divisions > 1.0
}

impl<const D: usize> Behind<D>
where
    Dim<D>: TangentSpace<D>,
{
    /// For bodies in their initial places, and an obstacle of a thickness, m.
    #[must_use]
    pub fn new(bodies: Box<dyn Thick<D>>, obstacle: f64) -> Self {
        let least = bodies.least().min(obstacle);
        Self {
            bodies,
            findings: Findings::default(),
            least,
            obstacle,
            way: 0.0,
            was_deep: false,
            is_placed: false,
            gone: 0.0,
            next: f64::NEG_INFINITY,
            steps: 0,
        }
    }

    /// Whether facets may be deep in an obstacle of this radius (m) between their nodes.
    #[must_use]
    pub fn may_be_between(&self, radius: f64) -> bool {
        let mut may_be = false;
        self.bodies.facets(&mut |corners, _, _| may_be |= may_be_between(divisions(corners, radius, self.least)));
        may_be
    }

    /// What was found.
    #[must_use]
    pub fn findings(&self) -> &Findings {
        &self.findings
    }

    /// Least thickness at the start, m.
    #[must_use]
    pub fn least(&self) -> f64 {
        self.least
    }

    /// A new step begins.
    pub fn begin(&mut self) {
        self.findings.begin();
        (self.way, self.is_placed) = (0.0, false);
    }

    /// Takes a node that is so deep, m, where the body was `initial` thick at the start, m; it went so far in
    /// the step, m.
    pub fn see(&mut self, node: u32, depth: f64, initial: f64, way: f64, scene: &Scene<'_, D>) {
        if !(depth > SEEN * initial) {
            return;
        }
        self.place(scene);
        let place = in_3d(scene.sweep.new[node as usize]);
        self.way = self.way.max(0.5 * way);
        let thickness = self.bodies.at(node).min(self.obstacle);
        self.findings.see(Overlap { place, depth, thickness, nodes: [node, NONE], time: scene.time }, false);
    }

    /// Takes a node that went through the obstacle within the step, how deep it was there, m, and where.
    pub fn see_through(&mut self, node: u32, (depth, place): (f64, [f64; D]), scene: &Scene<'_, D>) {
        self.place(scene);
        let thickness = self.bodies.at(node).min(self.obstacle);
        let found = Overlap { place: in_3d(place), depth, thickness, nodes: [node, NONE], time: scene.time };
        if found.ratio() > DEEPEST_IN_PLANE {
            self.findings.see(found, false);
            self.findings.miss();
        }
    }

    /// Looks at the facets, if it is time: how deep and where each is deepest in the obstacle, in the frame
    /// of its `body`.
    pub fn see_facets(&mut self, body: &Body<D>, deepest: impl Fn(&[[f64; D]]) -> Option<(f64, [f64; D])>, scene: &Scene<'_, D>) {
        self.steps = self.steps.saturating_add(1);
        let shift = body.shift();
        self.gone += shift.unwrap_or(0.0);
        let ways = scene.sweep.travel + self.gone;
        if shift.is_some() && !self.was_deep && ways < self.next && self.steps < MOST_STEPS {
            return;
        }
        self.place(scene);
        let findings = &mut self.findings;
        self.bodies.facets(&mut |corners, thickness, node| {
            let mut local = [[0.0; D]; 3];
            local.iter_mut().zip(corners).for_each(|(local, &x)| *local = body.to_local(x));
            let thickness = thickness.min(self.obstacle);
            if let Some((depth, place)) = deepest(&local[..corners.len()])
                && depth > SEEN * thickness
            {
                let place = in_3d(body.place(place));
                findings.see(Overlap { place, depth, thickness, nodes: [node, NONE], time: scene.time }, false);
            }
        });
        let until = way_until_next(findings.now.ratio(), DEEPEST_IN_PLANE, BETWEEN_LOOKS, self.least);
        // Half of it for each side.
        self.next = if shift.is_some() { ways + 2.0 * until } else { f64::NEG_INFINITY };
        self.steps = 0;
    }

    /// The step has been seen: what is too deep counts.
    pub fn end(&mut self) {
        self.was_deep = self.findings.count(self.way, self.was_deep);
    }

    fn place(&mut self, scene: &Scene<'_, D>) {
        if !std::mem::replace(&mut self.is_placed, true) {
            self.bodies.place(scene.sweep.new);
        }
    }

    /// Keeps what was found.
    pub fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        persist_each!(archive; &mut self.findings, &mut self.was_deep, &mut self.gone, &mut self.next, &mut self.steps);
        Ok(())
    }

    /// Continues with what another one knew, whose surfaces were those before they changed.
    pub fn inherit(&mut self, old: &Self) {
        (self.findings, self.was_deep) = (old.findings, old.was_deep);
    }
}
