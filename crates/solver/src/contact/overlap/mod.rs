//! Where bodies overlap in 3D, how deep, and whether something pushes them apart there: an overlap check of
//! contact that shares no reasoning with the search, the trackers and the springs.
//!
//! It looks at the bodies as they are, not at pairs and their histories. `piercing` finds which edges pierce
//! which triangles by exact predicates, `regions` closes the contours and finds what lies inside, the area
//! vector N and the volume V; `thickness` gives the local thickness of the bodies. A region is *held* if
//!
//! 1. no sampled place in it (vertices, three places on each part of an edge that is inside) is deeper than a
//!    sixth of the local thickness τ, the lesser of both bodies';
//! 2. its area vector has not turned by more than a right angle against the one with which it began, turned
//!    with the bodies since; of what has no closed contour it says nothing;
//! 3. the forces of the springs at its nodes work against its volume, −Σ f·∂V/∂x > 0, or the volume falls, or
//!    it is shallower than τ/20.
//!
//! Else it counts as `unverified`. Depth is the distance to the other body's surface; once that exceeds 0.15
//! τ, to the side of entry: facets that look against the area vector of the region. The bodies are looked at
//! before anything can have gone farther than an eighth of the least thickness (both bodies' ways together,
//! by the travel ∑ dt max |v|). So nothing gets through a body between two looks, and on its way through it
//! is deeper than that at one of them. What is nearly too deep is looked at more often.
//!
//! A region that is deeper than τ/20 gets a spring on its volume (`volume_spring`): the volume spring under
//! the springs of nodes and edges.
//!
//! A place that is deeper than τ/20 and in no way inside by its winding number is not: where surfaces are
//! flush, rounding says which of them is inside.
//!
//! Not covered: overlaps between facets that share a node, and what lies between the samples. Where a contour
//! in one body does not close, as where it begins between facets that share a node, a node behind pierced
//! triangles and inside by its winding number is as deep as it is far from them, and from the other side of
//! the crease in which it lies.

mod lineage;
mod near;
mod volume_spring;
mod piercing;
mod predicates;
mod regions;
mod samples;
mod skin;
mod thickness;
mod tree;
mod winding;

pub use skin::Bodies;
pub use thickness::Walls;

use super::checked::Look;
use super::findings::{BETWEEN_LOOKS, CAST, DEEPEST, Findings, MOST_STEPS, Overlap, way_until_next};
use super::projection::node_facet::Vector;
use super::spin;
use super::springs::Answers;
use super::{Scene, Sweep};
use crate::archive::{Archive, ArchiveResult, persist_all, persist_each};
use crate::mesh::surface::NONE;
use crate::tensor::dot;
use crate::vector::length;
use near::Near;
use piercing::Piercing;
use regions::{Region, Work};
use skin::Skin;
use thickness::Thickness;
use tree::Tree;
use volume_spring::VolumeSpring;

/// A region whose area vector is less than this fraction of its area has no direction: a pin in a hole.
const DIRECTED: f64 = 0.3;
/// Shallower than this fraction of the thickness a region may be without a force.
const SHALLOW: f64 = CAST;

/// What is known of a region from look to look.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Known {
    /// Both bodies, ascending.
    bodies: [u32; 2],
    /// Area vector with which it began, turned with the bodies since, m²; zero: it has no direction.
    began: Vector,
    /// Area, the mean of both sides, now and when it was found the time before, m².
    size: f64,
    size_before: f64,
    /// V now and when it was found the time before, and how the volume spring saw it grow since then, m³.
    volume: f64,
    before: f64,
    since: f64,
    /// Depth against the thickness in the last look.
    ratio: f64,
    /// Local thickness at the deepest place then, m.
    thickness: f64,
    /// Depth when contact began to act, where that counts as none, m.
    offset: f64,
    /// Whether the forces do not hold it.
    is_loose: bool,
    /// Of the volume spring: its depth (negative: it is open), m, area over which it spreads, m² (zero: there
    /// is no volume spring), and local thickness when it was cast, m.
    depth: f64,
    area: f64,
    thick: f64,
    /// Gap (m) and energy (J) of the volume spring at n − ½; infinite: there was none.
    half: f64,
    stored: f64,
}

persist_all!(Known {
    bodies,
    began,
    size,
    size_before,
    volume,
    before,
    since,
    ratio,
    thickness,
    offset,
    is_loose,
    depth,
    area,
    thick,
    half,
    stored
});

/// The overlap check of one contact.
pub struct OverlapCheck {
    skin: Skin,
    tree: Tree,
    near: Near,
    thickness: Thickness,
    /// The least, and the largest of each body, at the start, m.
    least: f64,
    thickest: Vec<f64>,
    /// Whether the surface of each body is closed.
    is_closed: Vec<bool>,
    /// Pressure stiffness at each node of the skin, κ and that by its mass, Pa/m; zero where the contact has
    /// none.
    moduli: Vec<[f64; 2]>,
    /// Whether overlaps at the start count as none.
    ignores_start: bool,
    /// Whether regions get volume springs.
    casts: bool,
    work: Work,
    piercings: Vec<Piercing>,
    /// Regions of the last look, and what is known of them.
    regions: Vec<Region>,
    known: Vec<Known>,
    /// The volume springs of this step.
    volume_springs: Vec<VolumeSpring>,
    /// Triangles in the regions, and in which.
    owners: Vec<lineage::Owner>,
    /// Where the vertices were when regions were found the time before.
    places: Vec<Vector>,
    /// Travel at which it looks again, and at which the regions were found, m, and steps since the last look.
    next: f64,
    found_at: f64,
    steps: u32,
    /// Whether this step was looked at, so that its forces are to be weighed.
    has_looked: bool,
    findings: Findings,
    /// Nodes that were inside another body in the last look, and how deep, m.
    inside: Vec<(u32, f64)>,
    /// The triangle that was nearest to each vertex in the last look in which it was inside, or [`NONE`]. It
    /// spares work and changes nothing.
    feet: Vec<u32>,
}

impl OverlapCheck {
    /// For the bodies of a contact at their initial `positions`, m.
    #[must_use]
    pub fn new(bodies: &Bodies<'_>, positions: &[Vector], ignores_start: bool) -> Self {
        let mut skin = Skin::new(bodies);
        skin.place(positions);
        let mut tree = Tree::new(&skin);
        tree.refit(&skin);
        let thickness = Thickness::new(&skin, &tree);
        let (least, thickest) = (thickness.least(&skin), thickness.thickest(&skin));
        let moduli = vec![[0.0; 2]; skin.nodes.len()];
        let is_closed = skin.are_closed();
        Self {
            skin,
            tree,
            near: Near::default(),
            thickness,
            least,
            thickest,
            is_closed,
            moduli,
            ignores_start,
            casts: true,
            work: Work::default(),
            piercings: Vec::new(),
            regions: Vec::new(),
            known: Vec::new(),
            volume_springs: Vec::new(),
            owners: Vec::new(),
            places: Vec::new(),
            next: f64::NEG_INFINITY,
            found_at: f64::NEG_INFINITY,
            steps: 0,
            has_looked: false,
            findings: Findings::default(),
            inside: Vec::new(),
            feet: Vec::new(),
        }
    }

    /// The same without volume springs: it reports, and holds nothing.
    #[must_use]
    pub fn without_nets(self) -> Self {
        Self { casts: false, ..self }
    }

    /// The least local thickness at the start, m.
    #[must_use]
    pub fn thinnest(&self) -> f64 {
        self.least
    }

    /// Takes the pressure stiffness of a node, and that by its mass, Pa/m.
    pub fn set_modulus(&mut self, node: u32, modulus: f64, of_mass: f64) {
        if let Ok(vertex) = self.skin.nodes.binary_search(&node) {
            self.moduli[vertex] = [modulus, of_mass];
        }
    }

    /// Least thickness of the body at each node, in the order of `nodes` (ascending), m, at the places of the
    /// last look; infinite for nodes that are not on the surface.
    #[must_use]
    pub fn thickness_at(&self, nodes: &[u32]) -> Vec<f64> {
        let at = |node: &u32| {
            let Ok(vertex) = self.skin.nodes.binary_search(node) else { return f64::INFINITY };
            self.thickness.sharing(&self.skin, &[vertex as u32])
        };
        nodes.iter().map(at).collect()
    }

    /// Looks at the step, if it is time. In between, regions that have volume springs are found again where
    /// these can't continue with their nodes.
    pub fn look(&mut self, sweep: Sweep<'_, 3>, time: f64) {
        self.steps = self.steps.saturating_add(1);
        self.has_looked = !(sweep.travel < self.next && self.steps < MOST_STEPS);
        if !self.has_looked && self.follow(sweep) {
            return;
        }
        self.volume_springs.clear();
        std::mem::swap(&mut self.places, &mut self.skin.x);
        if !self.skin.place(sweep.new) {
            self.has_looked = false;
            return;
        }
        piercing::find(&self.skin, &mut self.tree, &mut self.near, sweep.travel, &mut self.piercings);
        self.regions = self.work.find(&self.skin, &mut self.piercings);
        self.inherit_known();
        if self.has_looked {
            self.see(time);
            // What has no closed contour gets no volume spring: to look sooner would help nothing.
            let closed = self.known.iter().zip(&self.regions).filter(|(_, region)| !region.is_open);
            let deepest = closed.map(|(known, _)| known.ratio).fold(0.0, f64::max);
            self.next = sweep.travel + way_until_next(deepest, DEEPEST, BETWEEN_LOOKS, self.least);
            self.steps = 0;
        }
        if self.casts {
            self.cast(sweep.travel - self.found_at);
        }
        self.found_at = sweep.travel;
        self.owners = lineage::owners(&self.regions);
    }

    /// Measures how deep the regions are.
    fn see(&mut self, time: f64) {
        let is_first = self.findings.looks == 0;
        self.findings.begin();
        self.inside.clear();
        let walls = if self.regions.is_empty() { Vec::new() } else { self.thickness.of_all(&self.skin) };
        self.feet.resize(self.skin.x.len(), NONE);
        for number in 0..self.regions.len() {
            let samples = self.samples(&self.regions[number], &walls);
            for sample in samples.iter().filter(|sample| sample.vertex != NONE) {
                self.feet[sample.vertex as usize] = sample.foot;
            }
            let node = |vertex: u32| self.skin.nodes.get(vertex as usize).copied();
            let nodes = samples.iter().filter_map(|sample| Some((node(sample.vertex)?, sample.overlap.depth)));
            let is_own = self.regions[number].is_own();
            self.inside.extend(nodes.filter(|_| !is_own));
            let mut deepest = Overlap { time, ..self.deepest(number, &samples) };
            let known = &mut self.known[number];
            if is_first && self.ignores_start {
                known.offset = deepest.depth;
            }
            deepest.depth = (deepest.depth - known.offset).max(0.0);
            (known.ratio, known.thickness) = (deepest.ratio(), deepest.thickness);
            self.findings.see(deepest, is_own);
            if known.ratio > 1.0 && !is_own && !self.regions[number].is_open {
                self.findings.through = Some(deepest);
            }
        }
    }

    /// What is known of the regions of the look before goes to those that continue from them.
    fn inherit_known(&mut self) {
        let before = std::mem::take(&mut self.known);
        let parents = lineage::parents(&self.owners, &before, &self.regions);
        // Volume of all children of each.
        let mut volumes = vec![0.0; before.len()];
        for (region, parents) in self.regions.iter().zip(&parents) {
            parents.iter().for_each(|&parent| volumes[parent as usize] += region.volume.abs());
        }
        let of = |(region, parents): (&Region, &Vec<u32>)| {
            let has_direction = !region.is_open && length(region.area) > DIRECTED * region.size;
            let direction = if has_direction { region.area } else { [0.0; 3] };
            let mut known = Known { bodies: region.bodies, began: direction, size: region.size, volume: region.volume, ..Known::default() };
            let size = |parent: u32| before[parent as usize].size;
            if let Some(largest) = parents.iter().copied().reduce(|a, b| if size(b) > size(a) { b } else { a }) {
                let mut parent = before[largest as usize];
                if region.is_own() && lineage::are_sides_swapped(&self.owners, largest, region) {
                    parent.began = parent.began.map(|c| -c);
                }
                known.offset = parent.offset;
                (known.ratio, known.thickness) = (parent.ratio, parent.thickness);
                // What slides around a corner turns its area vector by less than a right angle from look to
                // look; what goes through turns it over.
                let carried = spin::turned(parent.began, self.turn(region));
                if parent.began != [0.0; 3] && !(dot(carried, direction) > 0.0) {
                    known.began = carried;
                }
            }
            for &parent in parents {
                let (parent, whole) = (before[parent as usize], volumes[parent as usize]);
                let share = if whole > 0.0 { region.volume.abs() / whole } else { 1.0 };
                known.before += share * parent.volume;
                known.since += share * parent.since;
                known.size_before += share * parent.size;
                known.depth += share * parent.area * parent.depth;
                known.area += share * parent.area;
                if parent.area > 0.0 {
                    known.half += share * parent.area * parent.half;
                    known.stored += share * parent.stored;
                    known.thick = if known.thick > 0.0 { known.thick.min(parent.thick) } else { parent.thick };
                }
                known.is_loose |= parent.is_loose;
            }
            (known.depth, known.half) =
                if known.area > 0.0 { (known.depth / known.area, known.half / known.area) } else { (0.0, f64::INFINITY) };
            known
        };
        self.known = self.regions.iter().zip(&parents).map(of).collect();
    }

    /// How the triangles of a region turned since the last look.
    fn turn(&self, region: &Region) -> Vector {
        let groups = region.triangles.iter().map(|&(triangle, _)| &self.skin.triangles[triangle as usize][..]);
        spin::turn(groups, Sweep::between(&self.places, &self.skin.x))
    }

    /// How the forces of the springs on the nodes of each region work against its volume, −Σ f·∂V/∂x, N m².
    fn pushes(&self, solved: &Answers<'_, 3>) -> Vec<f64> {
        let mut rows: Vec<(u32, u32, Vector)> = Vec::new();
        for (number, region) in (0..).zip(&self.regions) {
            rows.extend(region.gradient.iter().map(|&(vertex, row)| (self.skin.nodes[vertex as usize], number, row)));
        }
        rows.sort_by_key(|row| (row.0, row.1));
        let mut sums = vec![0.0; self.regions.len()];
        for answer in solved.clone() {
            for end in answer.ends() {
                let begin = rows.partition_point(|row| row.0 < end.at);
                for &(_, number, row) in rows[begin..].iter().take_while(|row| row.0 == end.at) {
                    sums[number as usize] -= dot(answer.force_on(&end), row);
                }
            }
        }
        sums
    }
}

impl Look<3> for OverlapCheck {
    fn see_step(&mut self, scene: &Scene<'_, 3>) {
        self.look(scene.sweep, scene.time);
    }

    fn weigh(&mut self, solved: &Answers<'_, 3>) {
        if !std::mem::take(&mut self.has_looked) || self.regions.is_empty() {
            return;
        }
        let pushes = self.pushes(solved);
        for (number, push) in pushes.into_iter().enumerate() {
            let (region, known) = (&self.regions[number], &mut self.known[number]);
            // Of what has no closed contour N is a part only.
            let has_direction = !region.is_open && length(region.area) > DIRECTED * region.size && known.began != [0.0; 3];
            let is_turned = has_direction && dot(known.began, region.area) < 0.0;
            // What was found in this step gets its volume spring in the next.
            let was_loose = known.is_loose;
            known.is_loose = known.ratio > SHALLOW && known.volume >= known.before && !(push > 0.0) && !region.is_open;
            if known.ratio > DEEPEST || is_turned || (known.is_loose && was_loose) {
                self.findings.miss();
            }
        }
        if self.casts && self.known.iter().any(|known| known.is_loose) {
            self.next = f64::NEG_INFINITY;
        }
    }

    fn findings(&self) -> &Findings {
        &self.findings
    }

    fn inside(&self) -> &[(u32, f64)] {
        &self.inside
    }

    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { known, volume_springs, owners, next, found_at, steps, findings, inside, skin, .. } = self;
        persist_each!(archive; known, volume_springs, owners, next, found_at, steps, findings, inside, &mut skin.x[..]);
        let are_there = owners.is_sorted() && owners.iter().all(|owner| (owner.region as usize) < known.len());
        archive.check(are_there, "overlaps are known that are not there")?;
        let are_nodes =
            |volume_spring: &VolumeSpring| volume_spring.rows.iter().all(|(node, _)| self.skin.nodes.binary_search(node).is_ok());
        let are_nets = volume_springs.iter().all(|volume_spring| (volume_spring.region as usize) < known.len() && are_nodes(volume_spring));
        archive.check(are_nets, "nets are known of overlaps that are not there")
    }

    fn inherit(&mut self, old: &Self) {
        self.findings = old.findings;
    }
}

#[cfg(test)]
mod folds;
#[cfg(test)]
mod tests;
