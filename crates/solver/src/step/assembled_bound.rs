//! The stable step by the largest frequency of the assembled mesh: ω_r by Lanczos' method in a form r of the
//! mesh, and a bound of how far it has risen since by the deformation of the elements.
//!
//! *In the form r.* Bounds by elements or nodes let each swell alone, which its neighbours keep it from. The
//! largest eigenvalue θ of Lanczos' method from a random start is at least (1 − ε) ω_r², but for one start in
//! 1/δ ([`crate::lanczos`]); ω_r is taken as √(θ/(1 − ε)), by 3 % more. Damping lags behind, K + (2/dt) D
//! counts ([`super::assembled_stiffness`]): 4M − dt² K − 2 dt D > 0 is stable for symmetric K and D, which
//! need no common modes (with the eigenvector y of the quadratic eigenproblem a + 2d < 4, a = dt² y·Ky/y·My,
//! d = dt y·Dy/y·My), and a step below the dt in it too.
//!
//! *Since then.* With F of an element from r to now, ∇u = G F⁻¹ with the gradient G by places in r, and
//! √(u·Ku) is a norm of the strains, so that with Minkowski's inequality
//!
//! ```text
//! ω ≤ ω_r + max_e s_e,   s_e = (√j − 1)₊ ω_e + √j ‖F⁻¹ − 1‖ ω_e √(max(3K, 2µ) / (K + 4µ/3)),
//! ```
//!
//! j = det F, with the bound ω_e of the element's own frequency in r. Slow elements may deform as they like.
//! The rotation of a whole body changes no frequency, and F is without it. The stiffness is that of the
//! elastic body which the law never exceeds. s is measured only when it could have come too close to what is
//! allowed: elements report how their nodes move around their mean, and |ds_e| ≤ ω_e (√(…) + ½ √D) ‖∇N‖
//! √(Σ|du_a|²).
//!
//! What is allowed, [`SLACK`] of ω_r, is in the step from the start: it stays the same until it is used up,
//! and then a new form is taken. Elements that fail take stiffness away and leave their mass, so that the
//! form holds without them; not where dilatations are averaged over nodes, whose weights change. Blocks of
//! these that may fail, and those without such a law, bound the step with their elements. Where that costs
//! more steps than it saves, there is a rest in which elements or nodes bound the step.
//!
//! Sources: Irons' theorem for K = Σ K_e in [`super::nodal_bound`]; the damping of non-commuting matrices and
//! the bound of the deformation are derived here; Flanagan and Belytschko, J. Appl. Mech. 51 (1984) 35-40 for
//! the element's own.

use super::assembled_stiffness::{AssembledStiffness, Damped};
use super::limits::HOLD;
use super::{Governor, System};
use crate::archive::{Archive, ArchiveResult, Persist, persist_each};
use crate::block::{Block, Report};
use crate::dimension::Dimension;
use crate::forest;
use crate::lanczos::{Tridiagonal, lanczos, products, ritz_vector};
use crate::reductions;
use crate::rotation::nearest_rotation;
use crate::rows::Rows;
use crate::tensor::Dim;
use crate::vector::{minus, plus, times};
use embate_lanes::Team;

/// ε: by so much of ω_r² may θ be too small: 3 % of the step.
const MARGIN: f64 = 1.0 - 0.97 * 0.97;
/// δ: probability with which it is still smaller.
const PROBABILITY: f64 = 1e-9;
/// Part of ω_r by which the deformation may raise it, and where the present step stays, at most.
const SLACK: f64 = 0.04;
const SLACK_MOST: f64 = 0.1;
/// Part of it that a new form is worth.
const USED: f64 = 0.75;
/// How much of the rate of s belongs to the deformation since r.
const RATE: f64 = 1.2;
/// Linear coefficient of the bulk viscosity in the form, over that of the model or the largest now, at least
/// the second.
const VISCOSITY: [f64; 2] = [1.5, 0.02];
/// Steps over those by elements or nodes from which on it is worth it.
const WORTH: f64 = 1.03;
/// Products after which it is looked at whether it can be, and those that find the node that moves most.
const LOOK: usize = 10;
/// Steps that a way of the elements in a product costs about.
const COST: f64 = 1.2;
/// Forms in a row that may cost more steps than they save, and the first rest after them, or where there is
/// nothing to gain; each later one is twice as long.
const PATIENCE: u32 = 3;
const REST: u32 = 500;

/// The stable step by the frequency of the assembled mesh.
#[derive(Clone, Debug, Default)]
pub(crate) struct AssembledBound<const D: usize> {
    /// Square of the stable step, s², and that of the form before; 0: none.
    squared: f64,
    squared_before: f64,
    /// Node that moves most in the fastest motion.
    node: u32,
    /// ω_r, 1/s, what of it the deformation may add, and a bound of what it has added.
    frequency: f64,
    slack: f64,
    used: f64,
    /// Linear coefficient of the bulk viscosity that is in ω_r.
    viscosity: f64,
    /// Part of the steps that it saves, how many steps it cost, and those done since r.
    gain: f64,
    cost: f64,
    served: u32,
    /// Forms so far, those in a row that cost more than they saved, steps of rest, and of the last one.
    forms: u32,
    vain: u32,
    rest: u32,
    last_rest: u32,
    /// r: positions, m, and squares of the elements' stable steps then, s², by block.
    form: Vec<[f64; D]>,
    steps: Vec<Vec<f64>>,
    /// Largest singular values of their nodal gradients then, 1/m.
    slopes: Vec<Vec<f64>>,
    /// Nodes of the bodies of elements that were connected at the start.
    bodies: Rows<u32>,
}

impl<const D: usize> Persist for AssembledBound<D> {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        #[rustfmt::skip]
        let Self {
            squared, squared_before, node, frequency, slack, used, viscosity, gain, cost, served, forms, vain, rest, last_rest,
            form, steps, slopes, bodies: _,
        } = self;
        persist_each!(archive; squared, squared_before, node, frequency, slack, used, viscosity, gain, cost);
        persist_each!(archive; served, forms, vain, rest, last_rest);
        archive.check((*node as usize) < archive.nodes, "a node that there is not")?;
        form[..].persist(archive)?;
        steps.iter_mut().chain(slopes).try_for_each(|list| list[..].persist(archive))
    }
}

impl<const D: usize> System<D>
where
    Dim<D>: Dimension<D>,
{
    /// Makes ready for the stable step by the assembled mesh.
    pub(crate) fn bound_by_assembled_mesh(&mut self) {
        let bound = AssembledBound::of(self);
        self.blocks.iter_mut().zip(&bound.steps).filter(|(_, steps)| !steps.is_empty()).for_each(|(block, _)| block.weigh_motion(&|_| 0.0));
        self.assembled_bound = Some(bound);
    }

    /// Square of the stable step by the assembled mesh, s², and who sets it; `None` where there is none.
    pub(super) fn squared_by_assembled_mesh(&mut self, elements: &Report) -> Option<(f64, Governor)> {
        let mut bound = self.assembled_bound.take()?;
        let squared = self.follow(&mut bound, elements.time_step_squared);
        let found = (squared > 0.0).then_some((squared, Governor::Assembled(bound.node)));
        self.assembled_bound = Some(bound);
        found
    }

    fn follow(&mut self, bound: &mut AssembledBound<D>, by_elements: f64) -> f64 {
        bound.used += reductions::max(self.reports.iter().map(|report| report.motion));
        let viscosity = reductions::max(self.blocks_in(bound).map(|block| self.reports[block].viscosity));
        if bound.squared > 0.0 {
            bound.served = bound.served.saturating_add(1);
            let is_damped_more = viscosity > bound.viscosity;
            let is_deformed = bound.used > bound.slack && {
                bound.used = self.raised(bound);
                // What is no number is too much.
                !(bound.used <= USED * bound.slack)
            };
            if is_damped_more || is_deformed {
                bound.end();
            }
        }
        if bound.squared == 0.0 && bound.rest > 0 {
            bound.rest -= 1;
        } else if bound.squared == 0.0 {
            self.take_form(bound, by_elements, viscosity);
        }
        if bound.squared > 0.0 { self.squared_of_all(bound, bound.squared) } else { 0.0 }
    }

    /// Part of ω_r by which the deformation since the form r may have raised the largest frequency.
    fn raised(&self, bound: &AssembledBound<D>) -> f64 {
        let positions = self.turned_back(bound);
        let mut most: f64 = 0.0;
        for block in self.blocks_in(bound) {
            let Some(elastic) = self.blocks[block].elastic() else { continue };
            let (steps, spread) = (&bound.steps[block], elastic.spread().sqrt());
            elastic.deformations(&bound.slopes[block], [&bound.form, &positions], &mut |element, [change, growth]| {
                let root = growth.sqrt();
                let raised = (f64::max(root - 1.0, 0.0) + root * change * spread) * 2.0 / steps[element].sqrt();
                most = if raised.is_nan() { f64::INFINITY } else { f64::max(most, raised) };
            });
        }
        most / bound.frequency
    }

    /// The positions with the mean rotation of every body since the form r undone, which changes no
    /// frequency.
    fn turned_back(&self, bound: &AssembledBound<D>) -> Vec<[f64; D]> {
        let mut positions = self.positions.clone();
        if self.of_revolution {
            return positions;
        }
        for nodes in (0..positions.len()).map(|body| bound.bodies.of(body)).filter(|nodes| !nodes.is_empty()) {
            let mean = |of: &[[f64; D]]| {
                let sum = nodes.iter().fold([0.0; D], |sum, &node| plus(sum, of[node as usize]));
                times(1.0 / nodes.len() as f64, sum)
            };
            let (before, now) = (mean(&bound.form), mean(&positions));
            let mut moments = [[0.0; D]; D];
            for &node in nodes {
                let (r, x) = (minus(bound.form[node as usize], before), minus(positions[node as usize], now));
                (0..D).for_each(|i| (0..D).for_each(|k| moments[i][k] += x[i] * r[k]));
            }
            let Some(rotation) = nearest_rotation(&moments) else { continue };
            for &node in nodes {
                let x = minus(positions[node as usize], now);
                positions[node as usize] = std::array::from_fn(|k| (0..D).map(|i| rotation[i][k] * x[i]).sum());
            }
        }
        positions
    }

    /// Blocks that are in it.
    fn blocks_in<'a>(&'a self, bound: &'a AssembledBound<D>) -> impl Iterator<Item = usize> {
        (0..bound.steps.len()).filter(|&block| !bound.steps[block].is_empty() && !self.is_gone(block))
    }

    /// Blocks of elements that are not, and are strained.
    fn blocks_beside<'a>(&'a self, bound: &'a AssembledBound<D>) -> impl Iterator<Item = usize> {
        let meshed = self.blocks.len() - usize::from(self.has_springs);
        (0..meshed).filter(|&block| !self.rigid[block] && bound.steps[block].is_empty() && !self.is_gone(block))
    }

    /// Square of the stable step of the elements that are not in it, s².
    fn squared_of_others(&self, bound: &AssembledBound<D>) -> f64 {
        reductions::min(self.blocks_beside(bound).map(|block| self.reports[block].time_step_squared))
    }

    /// Square of the stable step of all elements and springs together, s², from that of the elements that are
    /// in it: springs add to the stiffness of both.
    fn squared_of_all(&self, bound: &AssembledBound<D>, squared: f64) -> f64 {
        self.with_springs(f64::min(squared, self.squared_of_others(bound)))
    }

    /// Masses of the nodes for the elements that are in it, kg/m: all but what the other elements count with;
    /// of rigid bodies what those weigh.
    fn masses_in(&self, bound: &AssembledBound<D>) -> Vec<f64> {
        let is_of_body = |node: u32| self.bodies.of_node(node).is_some();
        let mut masses: Vec<f64> = (0..).zip(&self.mass).map(|(node, &mass)| if is_of_body(node) { 0.0 } else { mass }).collect();
        for block in self.blocks_in(bound) {
            self.blocks[block]
                .bound_stiffness(1.0, &mut |node, _, mass| masses[node as usize] += if is_of_body(node) { mass } else { 0.0 });
        }
        for block in self.blocks_beside(bound) {
            self.blocks[block]
                .bound_stiffness(1.0, &mut |node, _, mass| masses[node as usize] -= if is_of_body(node) { 0.0 } else { mass });
        }
        masses
    }

    /// Square of the stable step, s², from which on the form is worth what it costs, in steps: so much longer
    /// than by elements or nodes that it saves more until the end, and, where these allow the present step,
    /// so much longer than this that it grows at all.
    fn squared_needed(&self, rival: f64, cost: f64) -> f64 {
        let step = self.limits.safety * rival.sqrt();
        let grows = if self.step > 0 && step >= self.time_step_old { HOLD * self.time_step_old } else { 0.0 };
        if self.limits.largest <= step {
            return f64::INFINITY;
        }
        let left = (self.stage_end() - self.time) / step;
        let pays = if left > cost { left / (left - cost) } else { f64::INFINITY };
        (f64::max(WORTH.max(pays) * step, grows) / self.limits.safety).powi(2)
    }

    /// Takes the present form for r, where that is worth it; else there is a rest.
    fn take_form(&mut self, bound: &mut AssembledBound<D>, by_elements: f64, viscosity: f64) {
        let mut team = std::mem::replace(&mut self.team, Team::alone());
        let found = self.find(bound, by_elements, viscosity, &mut team);
        self.team = team;
        let Some(found) = found else { return bound.rest() };
        bound.forms += 1;
        bound.form.clone_from(&self.positions);
        for (index, slopes) in found.slopes {
            let block = &mut self.blocks[index];
            let spread = block.elastic().map_or(0.0, |elastic| elastic.spread().sqrt());
            let rate = RATE * (spread + 0.5 * (D as f64).sqrt()) * 2.0 / found.frequency;
            bound.steps[index].copy_from_slice(&block.time_steps_squared());
            let steps = &bound.steps[index];
            block.weigh_motion(&|element| rate * slopes[element] / steps[element].sqrt());
            bound.slopes[index] = slopes;
        }
        (bound.used, bound.served) = (0.0, 0);
        (bound.squared, bound.frequency, bound.slack) = (found.squared, found.frequency, found.slack);
        (bound.viscosity, bound.gain, bound.cost) = (found.viscosity, found.gain, found.cost);
        bound.node = found.node.unwrap_or(bound.node);
    }

    /// ω_r of the present form, with what follows from it; `None` where it is not worth it.
    fn find(&self, bound: &AssembledBound<D>, by_elements: f64, viscosity: f64, team: &mut Team) -> Option<Found> {
        let (by_nodes, _) = self.squared_by_nodes(&mut Vec::new());
        let rival = f64::max(by_elements, self.with_springs(by_nodes));
        let blocks: Vec<usize> = self.blocks_in(bound).collect();
        let damped = self.damped(&blocks, viscosity, rival.sqrt());
        let cost = COST * if damped.time.is_some() { 2.0 } else { 1.0 };
        let count = products(D * self.positions.len(), MARGIN, PROBABILITY);
        let needed = self.squared_needed(rival, cost * count as f64);
        if blocks.is_empty() || !needed.is_finite() || self.squared_of_all(bound, f64::INFINITY) <= needed {
            return None;
        }
        let slopes: Vec<(usize, Vec<f64>)> =
            blocks.iter().filter_map(|&block| Some((block, self.blocks[block].elastic()?.slopes(&self.positions)))).collect();
        let slope = reductions::max(slopes.iter().flat_map(|(_, slopes)| slopes).copied());
        let mut stiffness = AssembledStiffness::new(self, &blocks, &self.masses_in(bound), slope, damped)?;
        let start = stiffness.random(u64::from(bound.forms));
        let square_of = |found: &Tridiagonal, margin: f64| 4.0 * (1.0 - margin) / (found.largest() * (1.0 + SLACK) * (1.0 + SLACK));
        let goes_on = |found: &Tridiagonal| !found.products().is_multiple_of(LOOK) || square_of(found, 0.0) > needed;
        let found = lanczos(start.clone(), count, |q, product| stiffness.multiply(q, product, team), |_, _| (), goes_on);
        let squared = square_of(&found, MARGIN);
        // What is no number, or no stiffness at all, is no form.
        if !goes_on(&found) || !squared.is_finite() || self.squared_of_all(bound, squared) <= needed {
            return None;
        }
        let frequency = 2.0 / (squared.sqrt() * (1.0 + SLACK));
        let (squared, slack) = self.step_to_keep(frequency).unwrap_or((squared, SLACK));
        // The step that was there has its node already.
        let node = if squared == bound.squared_before {
            None
        } else {
            let motion = ritz_vector(start, &found, LOOK, |q, product| stiffness.multiply(q, product, team));
            stiffness.fastest(&motion)
        };
        let (gain, cost) = (1.0 - (rival / squared).sqrt(), cost * found.products() as f64);
        Some(Found { squared, frequency, slack, node, viscosity: damped.viscosity, gain, cost, slopes })
    }

    /// What damps the elements of those blocks, with the `step` that damping lags behind at least, s.
    fn damped(&self, blocks: &[usize], viscosity: f64, step: f64) -> Damped {
        let elastic = || blocks.iter().filter_map(|&block| self.blocks[block].elastic());
        let linear = elastic().filter_map(|elastic| elastic.viscosity()).map(|[linear, _]| linear);
        let [factor, least] = VISCOSITY;
        let time = if elastic().any(|elastic| elastic.viscosity().is_some()) {
            Some(0.5 * step)
        } else {
            elastic().any(|elastic| elastic.damps()).then_some(step)
        };
        Damped { viscosity: factor * reductions::max(linear.chain([least, viscosity])), time }
    }

    /// The first step by the assembled mesh, `safety` included, s, and who sets it, in words; `None` where it
    /// is not worth what it costs.
    pub(crate) fn step_by_assembled_mesh(&self) -> Option<(f64, String)> {
        let bound = AssembledBound::of(self);
        let found = self.find(&bound, self.joined_reports().time_step_squared, 0.0, &mut Team::alone())?;
        let squared = self.squared_of_all(&bound, found.squared);
        Some((self.limits.safety * squared.sqrt(), self.governor_name(Governor::Assembled(found.node?))))
    }

    /// The square of the stable step, s², and what of ω_r it allows the deformation to add, where the present
    /// step can stay, as it would be held anyway.
    fn step_to_keep(&self, frequency: f64) -> Option<(f64, f64)> {
        let held = self.time_step_old / self.limits.safety;
        let slack = 2.0 / (held * frequency) - 1.0;
        let stays = self.step > 0 && self.governor != Governor::Contact && (0.5 * SLACK..=SLACK_MOST).contains(&slack);
        stays.then_some((held * held, slack))
    }
}

/// The nodes of every body of cells that share nodes.
fn connected<'a>(nodes: usize, cells: impl Iterator<Item = &'a [u32]>) -> Rows<u32> {
    let (mut parents, mut has_cells): (Vec<u32>, _) = ((0..nodes as u32).collect(), vec![false; nodes]);
    for cell in cells {
        for &node in cell {
            has_cells[node as usize] = true;
            forest::join(&mut parents, cell[0], node);
        }
    }
    let of = |node: &u32| has_cells[*node as usize];
    let pairs: Vec<(u32, u32)> = (0..nodes as u32).filter(of).map(|node| (forest::root(&mut parents, node), node)).collect();
    Rows::new(nodes, pairs.into_iter())
}

/// A form and its frequency; fields as in [`AssembledBound`].
struct Found {
    squared: f64,
    frequency: f64,
    slack: f64,
    /// `None`: that of the form before.
    node: Option<u32>,
    viscosity: f64,
    gain: f64,
    cost: f64,
    /// Largest singular values of the elements' nodal gradients, 1/m, by block.
    slopes: Vec<(usize, Vec<f64>)>,
}

impl<const D: usize> AssembledBound<D> {
    /// Of the blocks of a system that are strained and have an elastic body which they are never stiffer
    /// than, also where elements fail.
    fn of(system: &System<D>) -> Self
    where
        Dim<D>: Dimension<D>,
    {
        let may_fail = |block| system.erosion.as_ref().is_some_and(|erosion| erosion.may_fail(block));
        let is_in = |index: usize, block: &dyn Block<D>| {
            !system.rigid[index] && block.elastic().is_some_and(|elastic| !(elastic.averages_at_nodes() && may_fail(index)))
        };
        let blocks = system.blocks.iter().enumerate();
        let steps: Vec<_> = blocks.map(|(k, own)| if is_in(k, own.as_ref()) { vec![0.0; own.elements()] } else { Vec::new() }).collect();
        let groups = system.mesh.groups.iter().zip(&steps).filter(|(_, steps)| !steps.is_empty());
        let bodies = connected(system.positions.len(), groups.flat_map(|(group, _)| group.cells()).map(|cell| cell.nodes));
        Self { form: system.positions.clone(), slopes: steps.clone(), steps, bodies, ..Self::default() }
    }

    /// Leaves the form r. Where too many cost more than they saved, there is a rest.
    fn end(&mut self) {
        let is_vain = f64::from(self.served) * self.gain < self.cost;
        self.vain = if is_vain { self.vain + 1 } else { 0 };
        (self.squared_before, self.squared) = (self.squared, 0.0);
        if !is_vain {
            self.last_rest = 0;
        } else if self.vain >= PATIENCE {
            self.rest();
        }
    }

    /// Rests, twice as long as the last time.
    fn rest(&mut self) {
        self.last_rest = self.last_rest.saturating_mul(2).max(REST);
        self.rest = self.last_rest;
    }
}
