//! A circle, with the bodies outside of it or, hollow, inside.
//!
//! Nodes are pushed along the radius. Where their way is too long for that, the radius at one of its ends
//! says nothing about what it meets between: then the straight way counts. The place at which it enters the
//! circle (exactly: the root of a quadratic) gives the normal along which the node is held, also when it has
//! gone through the circle or beyond its centre, until it is out again where it came in. The way of the step
//! to come counts ahead, so that the spring is there before it is needed. A hollow circle has its solid
//! outside: no depth is too deep.
//!
//! Nodes do not see a circle that comes in between them. [`RoundSegments`] does: the same circle against
//! segments, for circles smaller than these.

use super::{ContactHistory, Manner, Shape, State, Way};
use crate::archive::{Archive, ArchiveResult, Persist};
use crate::contact::Origins;
use crate::contact::Vector;
use crate::contact::depths::Depths;
use crate::contact::initial::kept;
use crate::contact::law::penalty::stiffening;
use crate::contact::node_segment::segment_ends;
use crate::contact::slaves::Slave;
use crate::contact::springs::{Answers, End, Slip, Spring, Springs};
use crate::contact::tracker::{Certificate, ContactPoint, SearchReport, Tracker};
use crate::contact::{Formulation, Scene};
use crate::vector::{dot, minus};
use std::any::Any;

/// The circle, in the frame of its body.
#[derive(Clone, Copy, Debug)]
pub struct Circle {
    /// Centre, m.
    pub middle: Vector,
    /// Radius at which nodes are pushed, m.
    pub radius: f64,
    /// Whether bodies are inside of it.
    pub hollow: bool,
}

/// Cosine of the angle up to which the radius at a node inside stands for the place where it came in.
const NEAR: f64 = 0.7;
/// Fraction of the radius up to which a way is short: then the radius at its end stands for all of it.
const SHORT: f64 = 0.5;

impl Circle {
    /// Share of the way p → p + m at which it goes through the circle from the free side; `None` where it
    /// does not, within this way.
    fn entry(&self, p: Vector, m: Vector) -> Option<f64> {
        let (a, b, c) = (dot(m, m), dot(p, m), dot(p, p) - self.radius * self.radius);
        let discriminant = b * b - a * c;
        if self.hollow != (c < 0.0) || discriminant < 0.0 || (!self.hollow && b >= 0.0) {
            return None;
        }
        // The first root from outside, the last from inside; neither form cancels.
        let root = discriminant.sqrt();
        let share = match (self.hollow, b > 0.0) {
            (false, _) => c / (root - b),
            (true, true) => -c / (root + b),
            (true, false) => (root - b) / a,
        };
        (share <= 1.0).then_some(share)
    }

    fn is_short(&self, m: Vector) -> bool {
        dot(m, m) <= SHORT * SHORT * self.radius * self.radius
    }

    /// Where the way p → p + m enters or, if it does not, comes nearest, as seen from the centre.
    fn facing(&self, p: Vector, m: Vector) -> Vector {
        let square = dot(m, m);
        let nearest = || if square > 0.0 { (-dot(p, m) / square).clamp(0.0, 1.0) } else { 0.0 };
        let share = self.entry(p, m).unwrap_or_else(nearest);
        unit([p[0] + share * m[0], p[1] + share * m[1]])
    }

    /// Normal along which a node that went from `from` to `to` is pushed.
    fn normal(&self, from: Vector, to: Vector, memory: &mut ContactHistory) -> Vector {
        let (moved, radius) = ([to[0] - from[0], to[1] - from[1]], unit(to));
        let inside = |x: Vector| dot(x, x) < self.radius * self.radius;
        let held = match memory.state {
            // By far the most nodes: far away and slow.
            State::Free if self.is_short(moved) && !inside(from) && !inside(to) => None,
            State::Held => Some(memory.normal),
            State::Ahead if memory.presses => Some(memory.normal),
            State::Unknown | State::Behind => None,
            // Where it came in: in this step, or before it.
            _ if inside(from) => Some(unit(from)),
            _ => self.entry(from, moved).map(|share| unit([from[0] + share * moved[0], from[1] + share * moved[1]])),
        };
        if let Some(normal) = held {
            let is_in = dot(normal, to) < self.radius || memory.presses;
            // A normal of its own is for what came far: else the radius, so that the force goes through the
            // centre and turns nothing.
            if is_in && !((inside(to) || self.is_short(moved)) && dot(normal, radius) > NEAR) {
                (memory.state, memory.normal) = (State::Held, normal);
                return normal;
            }
        }
        let facing = self.facing(to, moved);
        if inside(to) || self.is_short(moved) {
            memory.state = State::Free;
            return radius;
        }
        (memory.state, memory.normal) = (State::Ahead, facing);
        facing
    }
}

impl Shape for Circle {
    fn meet(&self, way: Way, memory: &mut ContactHistory) -> Option<(f64, Vector)> {
        let [from, to] = [way.from, way.to].map(|x| [x[0] - self.middle[0], x[1] - self.middle[1]]);
        if !self.hollow {
            let normal = self.normal(from, to, memory);
            return Some((dot(normal, to) - self.radius, normal));
        }
        let (moved, radius) = ([to[0] - from[0], to[1] - from[1]], unit(to));
        let out = if !self.is_short(moved) && self.entry(to, moved).is_some() { self.facing(to, moved) } else { radius };
        Some((self.radius - dot(out, to), [-out[0], -out[1]]))
    }

    fn deepest(&self, ends: &[Vector]) -> Option<(f64, Vector)> {
        let &[a, b] = ends else { return None };
        let along = minus(b, a);
        let square = dot(along, along);
        let share = if square > 0.0 { (dot(minus(self.middle, a), along) / square).clamp(0.0, 1.0) } else { 0.0 };
        let place = [a[0] + share * along[0], a[1] + share * along[1]];
        let away = minus(place, self.middle);
        (!self.hollow).then_some((self.radius - dot(away, away).sqrt(), place))
    }

    fn radius(&self) -> Option<f64> {
        (!self.hollow).then_some(self.radius)
    }
}

/// A circle against segments: it comes in between their nodes.
pub struct RoundSegments {
    /// One slave, the centre, against the bodies' outside: a touch for each body that is near.
    tracker: Tracker,
    slave: Slave,
    radius: f64,
    /// Largest gap at which the law pushes, m.
    reach: f64,
    /// Rigid body of the circle.
    body: usize,
    /// Whether gaps that are negative when it begins to act count as zero.
    ignores_start: bool,
    has_begun: bool,
    /// Knows how thick the bodies are; by what factor springs stiffen.
    depths: Depths,
    factor: f64,
    /// Whether it is small enough now to come in between nodes.
    acts: bool,
}

impl RoundSegments {
    /// For a circle of this radius (m) whose centre is the only slave of `tracker`; `depths` know how thick
    /// the bodies are.
    #[must_use]
    pub fn new(tracker: Tracker, slave: Slave, radius: f64, body: usize, manner: Manner, depths: Depths) -> Self {
        let Manner { reach, factor, ignores_start } = manner;
        Self { tracker, slave, radius, reach, body, ignores_start, has_begun: false, depths, factor, acts: true }
    }

    /// The same, acting or not: a circle that is large for the segments would have a spring where the surface
    /// happens to be nearest, which jumps along it.
    #[must_use]
    pub fn acting(self, acts: bool) -> Self {
        Self { acts, ..self }
    }

    /// The spring at a body that is near, its slip, and its ends.
    fn spring(&self, touch: &ContactPoint, positions: &[Vector]) -> (Spring<2>, Slip<2>, [End<2>; 3]) {
        let projection = touch.projection;
        let (normal, centre) = (projection.normal, positions[touch.node as usize]);
        // Where the circle touches.
        let point = [centre[0] - self.radius * normal[0], centre[1] - self.radius * normal[1]];
        let segment = self.tracker.target(touch.pass).surface.segments[projection.segment as usize];
        let gap = projection.gap - self.radius;
        // A node comes first: it stands for the place in messages.
        let [a, b] = segment_ends(segment, &projection, gap, positions);
        let ends = [a, b, End { at: (positions.len() + self.body) as u32, share: 1.0, point, ..End::default() }];
        let (Slave { stiffness, area, .. }, memory) = (self.slave, self.tracker.kept(touch));
        let (slip, gap) = (memory.slip, gap - memory.spring.offset);
        let stiffening = stiffening(self.depths.thickness(self.tracker.around(touch)), self.factor);
        (Spring { normal, gap, stiffness, area, stiffening, side: -1.0, ..Spring::default() }, Slip::of([slip]), ends)
    }
}

impl Formulation<2> for RoundSegments {
    fn detect(&mut self, scene: &Scene<'_, 2>, springs: &mut Springs<2>) {
        if !self.acts {
            return;
        }
        let count = self.tracker.track(scene.sweep, self.radius + self.reach).len();
        for index in 0..count {
            let touch = self.tracker.touches()[index];
            if self.ignores_start {
                let gap = touch.projection.gap - self.radius;
                let memory = self.tracker.kept_mut(&touch);
                memory.spring.offset = kept(self.has_begun, memory.spring.offset, gap);
            }
            let (spring, slip, ends) = self.spring(&touch, scene.sweep.new);
            springs.push(spring, slip, &ends);
        }
        self.has_begun = true;
    }

    fn remember(&mut self, solved: Answers<'_, 2>) {
        for (index, answer) in solved.enumerate() {
            let touch = self.tracker.touches()[index];
            self.tracker.kept_mut(&touch).slip = answer.slid().slip_new[0];
        }
    }

    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { slave: _, radius: _, reach: _, body: _, ignores_start: _, depths: _, factor: _, acts: _, tracker, has_begun } = self;
        tracker.persist(archive)?;
        has_begun.persist(archive)
    }

    fn inherit(&mut self, old: Box<dyn Any>) {
        if let Ok(old) = old.downcast::<Self>() {
            self.tracker.inherit(&old.tracker);
            self.has_begun = old.has_begun;
        }
    }

    fn carry(&mut self, old: &dyn Any, origins: &Origins<'_, 2>) {
        if let Some(old) = old.downcast_ref::<Self>() {
            self.tracker.carry(&old.tracker, origins);
            self.has_begun = old.has_begun;
        }
    }

    fn certificate(&self) -> Certificate {
        self.tracker.certificate()
    }

    fn search_report(&self) -> Option<SearchReport> {
        Some(self.tracker.search_report())
    }
}

/// Direction of a vector; x for one without.
fn unit(v: Vector) -> Vector {
    let length = dot(v, v).sqrt();
    if length > 0.0 { [v[0] / length, v[1] / length] } else { [1.0, 0.0] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_enters_a_circle_where_the_quadratic_says() {
        let circle = Circle { middle: [0.0; 2], radius: 1.0, hollow: false };
        assert_eq!(circle.entry([-3.0, 0.0], [10.0, 0.0]), Some(0.2));
        assert_eq!(circle.entry([-3.0, 0.0], [1.5, 0.0]), None);
        assert_eq!(circle.entry([-3.0, 0.0], [-10.0, 0.0]), None);
        assert_eq!(circle.entry([-3.0, 1.1], [10.0, 0.0]), None);
        let normal = circle.facing([-3.0, 0.8], [10.0, 0.0]);
        assert!((normal[0] + 0.6).abs() < 1e-15 && (normal[1] - 0.8).abs() < 1e-15);
        assert_eq!(circle.facing([-3.0, 1.1], [10.0, 0.0]), [0.0, 1.0]);
        let hollow = Circle { hollow: true, ..circle };
        assert_eq!(hollow.facing([-0.5, 0.0], [10.0, 0.0]), [1.0, 0.0]);
        assert_eq!(hollow.facing([0.5, 0.0], [-10.0, 0.0]), [-1.0, 0.0]);
        assert_eq!(hollow.entry([-0.5, 0.0], [0.1, 0.0]), None);
    }

    #[test]
    fn a_segment_is_deepest_where_it_is_nearest_to_the_middle() {
        let circle = Circle { middle: [1.0, 2.0], radius: 0.5, hollow: false };
        assert_eq!(circle.deepest(&[[0.0, 2.1], [3.0, 2.1]]), Some((0.5 - (2.1_f64 - 2.0), [1.0, 2.1])));
        assert_eq!(circle.deepest(&[[1.25, 2.0], [3.0, 2.0]]), Some((0.25, [1.25, 2.0])));
        assert_eq!(circle.deepest(&[[1.0, 2.0], [1.0, 2.0]]), Some((0.5, [1.0, 2.0])));
        assert_eq!(Circle { hollow: true, ..circle }.deepest(&[[0.0, 2.1], [3.0, 2.1]]), None);
    }

    #[test]
    fn a_node_that_goes_through_a_circle_within_a_step_is_held_on_the_side_where_it_came_in() {
        let circle = Circle { middle: [2.0, 0.0], radius: 0.1, hollow: false };
        let mut memory = ContactHistory { state: State::Free, ..ContactHistory::default() };
        let (gap, normal) = circle.meet(Way { from: [0.0, 0.0], to: [5.0, 0.0] }, &mut memory).unwrap();
        assert_eq!((gap, normal, memory.state), (-3.1, [-1.0, 0.0], State::Held));
        // On its way back it is still held, and free only where it came from.
        let (gap, _) = circle.meet(Way { from: [5.0, 0.0], to: [3.0, 0.01] }, &mut memory).unwrap();
        assert_eq!((gap, memory.state), (-1.1, State::Held));
        let (gap, _) = circle.meet(Way { from: [3.0, 0.01], to: [1.0, 0.02] }, &mut memory).unwrap();
        assert!(gap > 0.8 && memory.state != State::Held, "{gap}");
        // One that passes beside it is not.
        let (gap, _) = circle.meet(Way { from: [0.0, 0.11], to: [5.0, 0.11] }, &mut memory).unwrap();
        assert!(gap > 0.0);
    }
}
