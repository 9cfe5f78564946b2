//! A straight line, infinite or of some length: the paper's rigid contact element.
//!
//! A line without end has its solid behind it: no depth is too deep. One with a length is a thin plate that
//! stops what comes through its front: where the straight way of a node, as seen from the plate, goes through
//! its plane, within its length or beside it, decides whether the node is held or has passed beside the
//! plate; and so it stays until the node is in front again. Nodes do not see its ends; its ends see segments,
//! as slave nodes.

use super::{ContactHistory, Shape, State, Way};
use crate::contact::Vector;

/// The line, in the frame of its body.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    /// A point of it, its middle where it has a length, m.
    pub middle: Vector,
    /// Unit normal that points to the free side.
    pub normal: Vector,
    /// Half of its length, m; infinite: no ends.
    pub half: f64,
    /// Distance that nodes keep from it, m.
    pub thickness: f64,
    /// Nodes that are deeper behind it at the start, m, are behind it and not in it; for a plane of some
    /// length.
    pub shallow: f64,
}

impl Plane {
    /// Its ends in the frame of the body, m, the solid on the right of the way from the first to the second;
    /// `None` of a line without end.
    #[must_use]
    pub fn ends(&self) -> Option<[Vector; 2]> {
        (self.half < f64::INFINITY).then(|| self.at([-self.half, self.half]))
    }

    /// Points of the line at these places along it, m.
    #[must_use]
    pub fn at(&self, places: [f64; 2]) -> [Vector; 2] {
        places.map(|place| [self.middle[0] + place * self.normal[1], self.middle[1] - place * self.normal[0]])
    }

    /// Gap, and the place along the line from its middle, m.
    fn place(&self, x: Vector) -> (f64, f64) {
        let (n, x) = (self.normal, [x[0] - self.middle[0], x[1] - self.middle[1]]);
        (x[0] * n[0] + x[1] * n[1] - self.thickness, x[0] * n[1] - x[1] * n[0])
    }

    /// Whether a node in front of it may meet it in the coming update: its way continues as it came.
    fn is_ahead(&self, (from_gap, from): (f64, f64), (gap, at): (f64, f64)) -> bool {
        let steps = if gap < from_gap { (gap / (from_gap - gap)).min(1.0) } else { 0.0 };
        (at + steps * (at - from)).abs() <= self.half
    }
}

impl Shape for Plane {
    fn meet(&self, way: Way, memory: &mut ContactHistory) -> Option<(f64, Vector)> {
        let (gap, at) = self.place(way.to);
        if self.half == f64::INFINITY {
            return Some((gap, self.normal));
        }
        let within = |at: f64| at.abs() <= self.half;
        let (from_gap, from) = self.place(way.from);
        if gap >= 0.0 && !(memory.presses && memory.state == State::Held && within(at)) {
            memory.state = State::Free;
            return self.is_ahead((from_gap, from), (gap, at)).then_some((gap, self.normal));
        }
        memory.state = match memory.state {
            State::Unknown if gap < -self.shallow => State::Behind,
            State::Unknown | State::Held => {
                if within(at) {
                    State::Held
                } else {
                    State::Behind
                }
            }
            // It went through in this step; one that was pressed already met it.
            State::Free | State::Ahead => {
                let share = if from_gap > gap { (from_gap / (from_gap - gap)).clamp(0.0, 1.0) } else { 1.0 };
                if within(from + share * (at - from)) || memory.presses { State::Held } else { State::Behind }
            }
            State::Behind => State::Behind,
        };
        (memory.state == State::Held).then_some((gap, self.normal))
    }
}
