//! What a picture must show: boxes around bodies, the obstacles near them, mirror images.
//! Positions and lines come from `film` and `mesh`; the box goes to `scene`, which adds some air.

use crate::outline::{Extent, Line};

pub(super) const NOTHING: Extent<2> = nothing();

/// The box of no points.
pub(super) const fn nothing<const D: usize>() -> Extent<D> {
    [[f64::INFINITY; D], [f64::NEG_INFINITY; D]]
}

/// Obstacles with ends are shown whole if they are at most so many times as large as the bodies.
const WHOLE: f64 = 2.0;
/// Obstacles count as far as this fraction of the bodies' size away on each side.
const ROOM: f64 = 0.5;
/// Of other obstacles the points below nodes are shown that are closer than this fraction of the bodies'
/// size.
const NEAR: f64 = 0.35;
/// Nodes times segments that are looked at in one frame.
const LOOKS_MAX: usize = 20_000;

/// The box around both.
pub(super) fn joined<const D: usize>(a: Extent<D>, b: Extent<D>) -> Extent<D> {
    [std::array::from_fn(|k| a[0][k].min(b[0][k])), std::array::from_fn(|k| a[1][k].max(b[1][k]))]
}

/// The longer side.
pub(super) fn size<const D: usize>(view: Extent<D>) -> f64 {
    (1..D).map(|k| view[1][k] - view[0][k]).fold(view[1][0] - view[0][0], f64::max)
}

/// Box of finite points without the share `trim` of them at each end of each axis.
pub(super) fn extent<'a, const D: usize>(points: impl Iterator<Item = &'a [f32; D]> + Clone, trim: f64) -> Extent<D> {
    let mut bounds = nothing();
    for axis in 0..D {
        let finite = points.clone().filter(|p| p.iter().all(|v| v.is_finite())).map(|p| f64::from(p[axis]));
        if trim == 0.0 {
            (bounds[0][axis], bounds[1][axis]) =
                finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        } else {
            let mut sorted: Vec<f64> = finite.collect();
            sorted.sort_unstable_by(f64::total_cmp);
            let cut = (trim * sorted.len() as f64).ceil() as usize;
            if let Some([low, .., high] | [low @ high]) = sorted.get(cut..sorted.len().saturating_sub(cut)) {
                (bounds[0][axis], bounds[1][axis]) = (*low, *high);
            }
        }
    }
    bounds
}

/// The box and its mirror images.
pub(super) fn mirrored<const D: usize>(mut view: Extent<D>, mirror: [bool; D]) -> Extent<D> {
    for axis in 0..D {
        if mirror[axis] {
            let far = view[0][axis].abs().max(view[1][axis].abs());
            (view[0][axis], view[1][axis]) = (-far, far);
        }
    }
    view
}

/// On which side of each mirror line the model lies (1 or −1), by the mean of its nodes.
pub(super) fn sides(nodes: impl Iterator<Item = [f64; 2]>) -> [f64; 2] {
    let sum = nodes.filter(|p| p[0].is_finite() && p[1].is_finite()).fold([0.0; 2], |sum, p| [sum[0] + p[0], sum[1] + p[1]]);
    sum.map(|s| if s < 0.0 { -1.0 } else { 1.0 })
}

/// Where obstacles may be shown beside `bodies`: not beyond the mirror lines, where the mirror image lies.
pub(super) fn room(bodies: Extent<2>, mirror: [bool; 2], sides: [f64; 2]) -> Extent<2> {
    let more = ROOM * size(bodies);
    let [mut low, mut high] = [bodies[0].map(|v| v - more), bodies[1].map(|v| v + more)];
    for axis in (0..2).filter(|k| mirror[*k]) {
        if sides[axis] > 0.0 { low[axis] = low[axis].max(0.0) } else { high[axis] = high[axis].min(0.0) }
    }
    [low, high]
}

/// What is to be seen of obstacles within `room` of `bodies`, with the nodes of one frame. A long line adds
/// no more than its points near the bodies.
pub(super) fn obstacles(
    lines: &[Line],
    nodes: impl ExactSizeIterator<Item = [f64; 2]> + Clone,
    bodies: Extent<2>,
    room: Extent<2>,
) -> Extent<2> {
    let large = size(bodies);
    let mut seen = NOTHING;
    for line in lines {
        let own = line.extent();
        if !line.is_endless && size(own) <= WHOLE * large {
            let kept = [[0, 1].map(|k| own[0][k].max(room[0][k])), [0, 1].map(|k| own[1][k].min(room[1][k]))];
            if (0..2).all(|k| kept[0][k] <= kept[1][k]) {
                seen = joined(seen, kept);
            }
            continue;
        }
        let stride = (nodes.len() * line.points.len()).div_ceil(LOOKS_MAX).max(1);
        let finite = nodes.clone().step_by(stride).filter(|p| p[0].is_finite() && p[1].is_finite());
        let feet = finite.filter_map(|x| line.nearest(x).filter(|foot| (foot[0] - x[0]).hypot(foot[1] - x[1]) < NEAR * large));
        for foot in feet {
            let foot = [0, 1].map(|k| foot[k].clamp(room[0][k].min(room[1][k]), room[1][k].max(room[0][k])));
            seen = joined(seen, [foot, foot]);
        }
    }
    seen
}

#[cfg(test)]
mod tests {
    use super::*;

    const BODIES: Extent<2> = [[0.0, 0.0], [2.0, 1.0]];

    fn seen(points: Vec<[f64; 2]>, is_endless: bool, mirror: [bool; 2]) -> Extent<2> {
        let nodes = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
        let line = Line { points, is_endless };
        obstacles(&[line], nodes.into_iter(), BODIES, room(BODIES, mirror, [1.0, 1.0]))
    }

    #[test]
    fn an_endless_floor_is_shown_when_a_body_is_near() {
        let floor = |y: f64| vec![[-1e6, y], [1e6, y]];
        let view = seen(floor(-0.25), true, [false; 2]);
        assert!((view[0][1] + 0.25).abs() < 1e-6 && view[0][0] >= -1e-6 && view[1][0] <= 2.0 + 1e-6, "{view:?}");
        assert_eq!(seen(floor(-0.75), true, [false; 2]), NOTHING);
    }

    #[test]
    fn an_obstacle_with_ends_is_shown_as_far_as_there_is_room() {
        assert_eq!(seen(vec![[2.5, 0.0], [2.8, 0.0], [2.8, 1.0]], false, [false; 2]), [[2.5, 0.0], [2.8, 1.0]]);
        assert_eq!(seen(vec![[2.5, 0.0], [5.0, 0.0]], false, [false; 2]), [[2.5, 0.0], [3.0, 0.0]]);
        assert_eq!(seen(vec![[7.0, 0.0], [8.0, 0.0]], false, [false; 2]), NOTHING);
        assert_eq!(seen(vec![[-0.5, 0.0], [0.5, 0.0]], false, [true, false]), [[0.0, 0.0], [0.5, 0.0]]);
    }

    #[test]
    fn mirroring_makes_the_view_symmetric() {
        assert_eq!(mirrored([[-1.0, 2.0], [3.0, 4.0]], [true, false]), [[-3.0, 2.0], [3.0, 4.0]]);
    }

    #[test]
    fn the_side_of_the_model_is_that_of_its_nodes() {
        assert_eq!(sides([[-1.0, 0.0], [0.1, f64::NAN], [0.5, 3.0]].into_iter()), [-1.0, 1.0]);
    }
}
