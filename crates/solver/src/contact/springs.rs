//! Contact springs, solved so that contact neither makes nor takes energy, whatever their stiffness and the step.
//!
//! Contacts and walls find where springs are; this file finds their forces, all together, because springs share nodes. With the gaps at half steps,
//! g^{n+½} = g^n + ½ dt^n ġ^{n+½} and g^{n−½} = g^n − ½ dt^{n−1} ġ^{n−½}, a force F does the work F (g^{n+½} − g^{n−½}) in the velocity update (exactly for
//! equal steps, else but for ¼ (dt^n − dt^{n−1}) F Δġ, which the slow growth of the step keeps small). So
//!
//! F = − [V(g^{n+½}) − V(g^{n−½})] / (g^{n+½} − g^{n−½}),  V(g) = ½ k g² for g < 0, else 0,
//!
//! takes from the motion exactly what the spring stores and gives it back at release: Armero and Petőcz, Comput. Meth. Appl. Mech. Engng 158
//! (1998) 269-300, put into the explicit update. A plain explicit force k g^n does not: what a spring gives at release differs from
//! what it took at closing by up to ½ k v² dt²/4, and stiff springs pump or lose energy far below the linear stability limit.
//!
//! Stability: while closed F = −k (g^{n−1} + 2 g^n + g^{n+1})/4, so a spring adds k to the stiffness and k dt²/4 to the mass:
//! (K + k) dt² ≤ 4 (M + k dt²/4) holds exactly if K dt² ≤ 4 M. The stable step of the elements alone is the stable step with contact.
//!
//! g^{n+½} depends on F itself and on the other springs at the same nodes: Gauss-Seidel over the springs, in their fixed order. The
//! matrix (2/k on the diagonal plus compliances) is symmetric and positive definite, so the sweeps converge; pair forces keep momentum exactly at any time.

use crate::load::constraint::Constraints;

/// A vector of the plane.
pub type Vector = [f64; 2];

/// A spring that pushes along `normal` on its first node and against it on the others.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spring {
    /// Slave node and the nodes of its target segment; of a wall only the first counts.
    pub nodes: [u32; 3],
    /// 1, −Φ₁, −Φ₂: share of each node in the gap's rate.
    pub shares: [f64; 3],
    /// Unit vector.
    pub normal: Vector,
    /// g^n, m.
    pub gap: f64,
    /// k, N/m per metre of depth.
    pub stiffness: f64,
    /// F, N/m.
    pub force: f64,
    /// Energy at the whole step n, J/m, in step with ½ Σ m v^{n-1/2}·v^{n+1/2}: ½ (V(g^{n−½}) + V(g^{n+½})) + ½ F (g^{n+½} + g^{n−½} − 2 g^n).
    pub energy: f64,
    /// Work of F in the velocity update, J/m.
    pub work: f64,
}

impl Spring {
    /// Number of nodes that move.
    fn count(&self) -> usize {
        if self.shares[1] == 0.0 && self.shares[2] == 0.0 { 1 } else { 3 }
    }
}

/// The springs of all contacts and walls in one step.
#[derive(Clone, Debug, Default)]
pub struct Springs {
    /// In the order in which contacts and walls found them.
    pub list: Vec<Spring>,
    /// Place of each node in `ends`; `u32::MAX`: not touched.
    place: Vec<u32>,
    ends: Vec<End>,
    links: Vec<Link>,
    /// Most sweeps that a step took so far.
    pub sweeps_max: usize,
    /// Steps whose forces still changed after the last sweep that is allowed.
    pub unsolved: u64,
}

/// A node that springs act on.
#[derive(Clone, Copy, Debug)]
struct End {
    node: u32,
    velocity: Vector,
}

/// What a spring needs in every sweep.
#[derive(Clone, Copy, Debug, Default)]
struct Link {
    /// Places of its nodes.
    ends: [u32; 3],
    /// Change of each node's velocity per force: ½ (dt^{n−1} + dt^n) / m times the share of the normal that is free to move.
    response: [Vector; 3],
    /// Change of g^{n+½} per force.
    compliance: f64,
    rate_old: f64,
    gap_old: f64,
}

/// What the solution needs of the model.
pub struct Update<'a, F: Fn(usize) -> Vector> {
    /// Steps before and after, s: v^{n+½} = v^{n−½} + ½ (dt^{n−1} + dt^n) F / m, x^{n+1} = x^n + dt^n v^{n+½}.
    pub time_steps: [f64; 2],
    /// Nodal masses, kg/m.
    pub mass: &'a [f64],
    /// v^{n−½}, m/s.
    pub velocities_old: &'a [Vector],
    /// Velocity v^{n+½} of a node without springs, prescribed motion included, m/s.
    pub velocity_free: F,
    /// Prescribed directions.
    pub constraints: &'a Constraints<2>,
}

/// Sweeps stop when no force changes by more than this fraction of the largest.
const TOLERANCE: f64 = 1e-12;
/// Sweeps after which the forces are taken as they are; far beyond what penalties of 100 times the elements' stiffness need.
const SWEEPS: usize = 500;

impl Springs {
    /// For `nodes` nodes.
    #[must_use]
    pub fn new(nodes: usize) -> Self {
        Self { place: vec![u32::MAX; nodes], ..Self::default() }
    }

    /// Finds the force, work and energy of every spring.
    pub fn solve<F: Fn(usize) -> Vector>(&mut self, update: &Update<'_, F>) {
        if self.list.is_empty() {
            return;
        }
        self.link(update);
        let [before, after] = update.time_steps;
        for sweep in 1..=SWEEPS {
            let (mut change, mut largest) = (0.0f64, 0.0f64);
            for (spring, link) in self.list.iter_mut().zip(&self.links) {
                let rate = rate(spring, |a| self.ends[link.ends[a] as usize].velocity);
                let gap_free = spring.gap + 0.5 * after * rate - link.compliance * spring.force;
                let force = force(spring.stiffness, link.gap_old, gap_free, link.compliance);
                let step = force - spring.force;
                spring.force = force;
                if step != 0.0 {
                    for a in 0..spring.count() {
                        let velocity = &mut self.ends[link.ends[a] as usize].velocity;
                        velocity[0] += link.response[a][0] * step;
                        velocity[1] += link.response[a][1] * step;
                    }
                }
                change = change.max(step.abs());
                largest = largest.max(force);
            }
            self.sweeps_max = self.sweeps_max.max(sweep);
            if change <= TOLERANCE * largest {
                break;
            }
            self.unsolved += u64::from(sweep == SWEEPS);
        }
        for (spring, link) in self.list.iter_mut().zip(&self.links) {
            let rate_new = rate(spring, |a| self.ends[link.ends[a] as usize].velocity);
            let gap_new = spring.gap + 0.5 * after * rate_new;
            let stored = |gap: f64| 0.5 * spring.stiffness * gap.min(0.0) * gap.min(0.0);
            let bend = gap_new + link.gap_old - 2.0 * spring.gap;
            spring.energy = 0.5 * (stored(link.gap_old) + stored(gap_new)) + 0.5 * spring.force * bend;
            spring.work = spring.force * 0.25 * (before + after) * (link.rate_old + rate_new);
        }
        for end in self.ends.drain(..) {
            self.place[end.node as usize] = u32::MAX;
        }
    }

    /// Gathers the nodes of the springs and what a force does to them.
    fn link<F: Fn(usize) -> Vector>(&mut self, update: &Update<'_, F>) {
        self.links.clear();
        let [before, after] = update.time_steps;
        for spring in &self.list {
            let mut link = Link::default();
            for a in 0..spring.count() {
                let node = spring.nodes[a];
                let place = &mut self.place[node as usize];
                if *place == u32::MAX {
                    *place = self.ends.len() as u32;
                    self.ends.push(End { node, velocity: (update.velocity_free)(node as usize) });
                }
                link.ends[a] = *place;
                let mut direction = spring.normal;
                if let Some(held) = update.constraints.of(node as usize) {
                    direction = held.free_part(direction);
                }
                let scale = spring.shares[a] * 0.5 * (before + after) / update.mass[node as usize];
                link.response[a] = [scale * direction[0], scale * direction[1]];
                let along = link.response[a][0] * spring.normal[0] + link.response[a][1] * spring.normal[1];
                link.compliance += 0.5 * after * spring.shares[a] * along;
            }
            link.rate_old = rate(spring, |a| update.velocities_old[spring.nodes[a] as usize]);
            link.gap_old = spring.gap - 0.5 * before * link.rate_old;
            self.links.push(link);
        }
    }
}

/// Rate of the gap, m/s, with node velocities `velocity(0..count)`.
fn rate(spring: &Spring, velocity: impl Fn(usize) -> Vector) -> f64 {
    let mut rate = 0.0;
    for a in 0..spring.count() {
        let v = velocity(a);
        rate += spring.shares[a] * (v[0] * spring.normal[0] + v[1] * spring.normal[1]);
    }
    rate
}

/// The force F ≥ 0 with F (g₊ − g₋) = V(g₋) − V(g₊) and g₊ = `free` + `compliance` F; `old` is g₋.
fn force(stiffness: f64, old: f64, free: f64, compliance: f64) -> f64 {
    let kc = stiffness * compliance;
    if old < 0.0 {
        // Closed all along: F = −½ k (g₊ + g₋).
        let closed = -stiffness * (free + old) / (2.0 + kc);
        if free + compliance * closed <= 0.0 {
            return closed.max(0.0);
        }
        // Release: c F² + (free − g₋) F = ½ k g₋², the positive root without cancellation.
        let b = free - old;
        let root = (b * b + 2.0 * kc * old * old).sqrt();
        return if b >= 0.0 { stiffness * old * old / (b + root) } else { (root - b) / (2.0 * compliance) };
    }
    if free >= 0.0 {
        return 0.0;
    }
    // Closing, with u = −g₊ > 0: (1 + ½ k c) u² − (p − g₋) u − p g₋ = 0 with p = −free.
    let (a, b) = (1.0 + 0.5 * kc, -free - old);
    let root = (b * b - 4.0 * a * free * old).sqrt();
    let u = if b >= 0.0 { (b + root) / (2.0 * a) } else { -2.0 * free * old / (root - b) };
    0.5 * stiffness * u * (u / (old + u))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_force_takes_and_gives_what_the_spring_stores() {
        let stored = |k: f64, g: f64| 0.5 * k * g.min(0.0).powi(2);
        for k in [0.01, 1.0, 100.0, 1e6] {
            for c in [1e-6, 0.1, 3.0] {
                for old in [-2.0, -0.3, 0.0, 1e-9, 0.4, 5.0] {
                    for free in [-7.0, -1.0, -1e-9, 0.0, 0.2, 3.0] {
                        let f = force(k, old, free, c);
                        let new = free + c * f;
                        assert!(f >= 0.0);
                        let (work, change) = (f * (new - old), stored(k, old) - stored(k, new));
                        // `new` is the difference of `free` and c f: their size sets the round-off.
                        let scale = stored(k, old) + stored(k, new) + f * (free.abs() + old.abs());
                        if f > 0.0 {
                            assert!((work - change).abs() <= 1e-12 * scale, "k {k} c {c} old {old} free {free}: {work} {change}");
                        } else {
                            assert!(new >= 0.0 && old >= 0.0 || free + old >= 0.0, "k {k} c {c} old {old} free {free}");
                        }
                    }
                }
            }
        }
    }

    /// A mass between two springs' walls: the energy must come back however stiff the walls and however long the step.
    #[test]
    fn a_bouncing_mass_keeps_its_energy_for_every_stiffness() {
        for k in [0.1, 1.0, 30.0, 1e4] {
            let (mass, dt) = ([1.0], 1.0);
            let constraints = Constraints::default();
            let (mut x, mut v) = (10.3f64, [-0.37, 0.0]);
            let mut springs = Springs::new(1);
            for _ in 0..2000 {
                springs.list.clear();
                let wall = |normal: f64, gap: f64| Spring {
                    shares: [1.0, 0.0, 0.0],
                    normal: [normal, 0.0],
                    gap,
                    stiffness: k,
                    ..Spring::default()
                };
                springs.list.extend([wall(1.0, x), wall(-1.0, 20.0 - x)]);
                let (old, free) = ([v], v);
                springs.solve(&Update {
                    time_steps: [dt; 2],
                    mass: &mass,
                    velocities_old: &old,
                    velocity_free: |_| free,
                    constraints: &constraints,
                });
                v[0] += dt * (springs.list[0].force - springs.list[1].force);
                x += dt * v[0];
                let energy = 0.5 * old[0][0] * v[0] + springs.list.iter().map(|s| s.energy).sum::<f64>();
                assert!((energy / (0.5 * 0.37 * 0.37) - 1.0).abs() < 1e-9, "stiffness {k}: {energy}");
            }
        }
    }
}
