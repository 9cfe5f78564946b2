//! Penetrations at the start in 2D: nodes behind segments.

use super::super::Sweep;
use super::super::projection::node_segment::Vector;
use super::super::tracker::{ContactPoint, Tracker};
use super::{Inside, Look, Opening, Penetrating, Penetration};
use crate::tensor::Dim;

impl Penetrating<2> for Dim<2> {
    type Touch = ContactPoint;

    fn deepest(_: &Tracker) -> f64 {
        0.0
    }

    fn inside(look: &mut Look<2>, positions: &[Vector], tolerance: f64) -> Vec<ContactPoint> {
        look.tracker.forget();
        let touches = look.tracker.track(Sweep::between(positions, positions), look.thickness + look.deepest);
        touches.iter().filter(|touch| !touch.own && touch.projection.gap - look.thickness < -tolerance).copied().collect()
    }

    fn penetration(touch: &ContactPoint, thickness: f64, positions: &[Vector]) -> Penetration<2> {
        Penetration { what: Inside::Node, place: positions[touch.node as usize], depth: thickness - touch.projection.gap }
    }

    fn opening(tracker: &Tracker, touch: &ContactPoint, positions: &[Vector]) -> Option<Opening<2>> {
        let target = tracker.target(touch.pass);
        let here = target.follow(positions[touch.node as usize], touch.projection.segment, positions)?;
        let ([a, b], [wa, wb]) = (target.surface.segments[here.segment as usize], here.weights);
        let ends = [(touch.node, 1.0), (a, -wa), (b, -wb), (0, 0.0), (0, 0.0)];
        Some(Opening { ends, count: 3, normal: here.normal, gap: here.gap })
    }
}
