//! Axis-aligned bounding boxes: by them the overlap checks find what of the bodies is near what. They share
//! nothing with the boxes of the search.

/// A closed box, low and high corner, m.
pub(super) type Aabb<const D: usize> = [[f64; D]; 2];

/// How far beside a box a ray may pass and still meet it, as a share of the way: a flat box counts, whatever
/// rounds.
const BESIDE: f64 = 1e-9;

/// The box of nothing: no other one meets it.
pub(super) const fn nothing<const D: usize>() -> Aabb<D> {
    [[f64::INFINITY; D], [f64::NEG_INFINITY; D]]
}

/// The box of places.
pub(super) fn around<const D: usize>(places: impl IntoIterator<Item = [f64; D]>) -> Aabb<D> {
    places.into_iter().fold(nothing(), |found, x| joined(found, [x, x]))
}

/// The box of two boxes.
pub(super) fn joined<const D: usize>([low, high]: Aabb<D>, [bottom, top]: Aabb<D>) -> Aabb<D> {
    [std::array::from_fn(|d| low[d].min(bottom[d])), std::array::from_fn(|d| high[d].max(top[d]))]
}

/// A box with a margin on all sides, m.
pub(super) fn widened<const D: usize>([low, high]: &Aabb<D>, margin: f64) -> Aabb<D> {
    [low.map(|bound| bound - margin), high.map(|bound| bound + margin)]
}

/// Whether boxes have a point in common.
pub(super) fn do_meet<const D: usize>([low, high]: &Aabb<D>, [bottom, top]: &Aabb<D>) -> bool {
    (0..D).all(|d| low[d] <= top[d] && bottom[d] <= high[d])
}

/// The axis along which a box is longest, the first of equal ones.
pub(super) fn longest<const D: usize>([low, high]: &Aabb<D>) -> usize {
    let size = |d: usize| high[d] - low[d];
    (1..D).fold(0, |axis, d| if size(d) > size(axis) { d } else { axis })
}

/// Square of the distance of a place, m²; zero inside.
pub(super) fn square_away<const D: usize>([low, high]: &Aabb<D>, x: [f64; D]) -> f64 {
    (0..D).map(|d| (low[d] - x[d]).max(x[d] - high[d]).max(0.0)).fold(0.0, |sum, off| sum + off * off)
}

/// Whether a ray meets a box before it has gone `far` times its direction.
pub(super) fn meets_ray<const D: usize>([low, high]: &Aabb<D>, from: [f64; D], direction: [f64; D], far: f64) -> bool {
    let (mut begin, mut end) = (0.0, far);
    for d in 0..D {
        if direction[d] == 0.0 {
            if from[d] < low[d] || from[d] > high[d] {
                return false;
            }
            continue;
        }
        let [s, t] = [low[d], high[d]].map(|bound| (bound - from[d]) / direction[d]);
        (begin, end) = (s.min(t).max(begin), s.max(t).min(end));
    }
    begin <= end * (1.0 + BESIDE)
}
