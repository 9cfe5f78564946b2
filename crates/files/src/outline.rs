//! Obstacles as lines, in 3D as surfaces: which are closed, on which side they are solid, which have no
//! end, and the piece of an endless one that a file holds. Outlines come with every [`Frame`]; lines and
//! surfaces go to the pictures and to `obstacles.pvd`.

use embate_solver::output::{Frame, Outline};

/// A plane whose outline is longer than so many times the largest initial coordinate has no end.
const ENDLESS: f64 = 30.0;
/// Factor by which a line without end is drawn out: beyond every place where bodies may fly.
const DRAWN_OUT: f64 = 1e3;

/// Lower and upper corner.
pub(crate) type Extent<const D: usize> = [[f64; D]; 2];

/// The surface of an obstacle at one time, the solid on its right.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Line {
    /// From point to point, m; a closed line ends at its first point.
    pub(crate) points: Vec<[f64; 2]>,
    pub(crate) is_endless: bool,
}

impl Line {
    /// Whether it ends where it begins.
    pub(crate) fn is_closed(&self) -> bool {
        self.points.len() > 3 && self.points.first() == self.points.last()
    }

    /// Whether it goes around its solid: clockwise. A box that holds bodies is hollow.
    pub(crate) fn is_filled(&self) -> bool {
        self.is_closed() && twice_area(&self.points) < 0.0
    }

    /// The box around all points.
    pub(crate) fn extent(&self) -> Extent<2> {
        let mut bounds = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        for p in &self.points {
            bounds[0] = [bounds[0][0].min(p[0]), bounds[0][1].min(p[1])];
            bounds[1] = [bounds[1][0].max(p[0]), bounds[1][1].max(p[1])];
        }
        bounds
    }

    /// Its point nearest to `x`; none for a line without points.
    pub(crate) fn nearest(&self, x: [f64; 2]) -> Option<[f64; 2]> {
        let foot = |w: &[[f64; 2]]| {
            let along = [w[1][0] - w[0][0], w[1][1] - w[0][1]];
            let square = along[0] * along[0] + along[1] * along[1];
            let t = ((x[0] - w[0][0]) * along[0] + (x[1] - w[0][1]) * along[1]) / square.max(f64::MIN_POSITIVE);
            let t = t.clamp(0.0, 1.0);
            [w[0][0] + t * along[0], w[0][1] + t * along[1]]
        };
        let distance = |p: [f64; 2]| (p[0] - x[0]).hypot(p[1] - x[1]);
        self.points.windows(2).map(foot).reduce(|best, p| if distance(p) < distance(best) { p } else { best })
    }

    /// Its points; of a line without end the piece across `near`.
    pub(crate) fn piece(&self, near: Extent<2>) -> Vec<[f64; 2]> {
        let middle = [0, 1].map(|k| 0.5 * (near[0][k] + near[1][k]));
        let half = (near[1][0] - near[0][0]).hypot(near[1][1] - near[0][1]);
        match (self.is_endless && half.is_finite(), &self.points[..], self.nearest(middle)) {
            (true, [first, .., last], Some(foot)) => {
                let along = [last[0] - first[0], last[1] - first[1]];
                let scale = half / along[0].hypot(along[1]);
                [-scale, scale].map(|s| [foot[0] + s * along[0], foot[1] + s * along[1]]).into()
            }
            _ => self.points.clone(),
        }
    }
}

/// Twice the area within a closed line, positive if it runs counter-clockwise, m².
fn twice_area(points: &[[f64; 2]]) -> f64 {
    let origin = points.first().copied().unwrap_or_default();
    let side = |p: [f64; 2]| [p[0] - origin[0], p[1] - origin[1]];
    let cross = |w: &[[f64; 2]]| {
        let (a, b) = (side(w[0]), side(w[1]));
        a[0] * b[1] - a[1] * b[0]
    };
    points.windows(2).map(cross).sum()
}

/// Turns the outlines of the frames of one run into lines; learns from the first frame what is far.
#[derive(Clone, Debug, Default)]
pub(crate) struct LineReader {
    /// From where on a line counts as endless, m.
    pub(crate) far: Option<f64>,
}

impl LineReader {
    /// Lines of a frame in 2D, in model order; without points what is gone.
    pub(crate) fn lines(&mut self, frame: &Frame) -> Vec<Line> {
        let far = self.far(frame);
        frame.outlines.iter().map(|outline| line(if outline.is_gone { &[] } else { &outline.points }, far)).collect()
    }

    /// Surfaces of a frame in 3D, in model order; without points and facets what is gone.
    pub(crate) fn surfaces(&mut self, frame: &Frame) -> Vec<Surface> {
        let gone = Surface { points: Vec::new(), facets: Vec::new(), is_endless: false };
        let all = self.all_surfaces(frame).into_iter().zip(&frame.outlines);
        all.map(|(surface, outline)| if outline.is_gone { gone.clone() } else { surface }).collect()
    }

    /// Surfaces of a frame in 3D, in model order, also of what is gone.
    pub(crate) fn all_surfaces(&mut self, frame: &Frame) -> Vec<Surface> {
        let far = self.far(frame);
        frame.outlines.iter().map(|outline| Surface::of(outline, far)).collect()
    }

    fn far(&mut self, frame: &Frame) -> f64 {
        let largest = || frame.coordinates.iter().filter(|x| x.is_finite()).fold(0.0f64, |size, x| size.max(x.abs()));
        *self.far.get_or_insert_with(|| ENDLESS * largest())
    }
}

fn line(points: &[[f64; 3]], far: f64) -> Line {
    let points: Vec<[f64; 2]> = points.iter().map(|&[x, y, _]| [x, y]).collect();
    if let [a, b] = points[..] {
        let along = [b[0] - a[0], b[1] - a[1]];
        if far > 0.0 && along[0].hypot(along[1]) > far {
            let ahead = along.map(|v| 0.5 * DRAWN_OUT * v);
            let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
            let ends = [-1.0, 1.0].map(|sign| [middle[0] + sign * ahead[0], middle[1] + sign * ahead[1]]);
            return Line { points: ends.into(), is_endless: true };
        }
    }
    Line { points, is_endless: false }
}

/// The surface of an obstacle in 3D at one time, the solid behind its facets.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Surface {
    /// m.
    pub(crate) points: Vec<[f64; 3]>,
    /// Points of each facet; a triangle repeats its last one.
    pub(crate) facets: Vec<[u32; 4]>,
    pub(crate) is_endless: bool,
}

/// A plane: a point of it, its unit normal, and two unit vectors in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Plane {
    /// The point nearest to the origin, m.
    pub(crate) foot: [f64; 3],
    pub(crate) normal: [f64; 3],
    along: [[f64; 3]; 2],
}

/// By this fraction of the bodies' size the piece of a plane without end is larger than they are, on each
/// side.
const BESIDE: f64 = 0.12;

impl Surface {
    fn of(outline: &Outline, far: f64) -> Self {
        let extent = |k: usize| {
            let bounds = outline.points.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| [low.min(p[k]), high.max(p[k])]);
            bounds[1] - bounds[0]
        };
        // A plane is a facet or two.
        let is_endless = far > 0.0 && outline.facets.len() <= 2 && (0..3).any(|k| extent(k) > far);
        let surface = Self { points: outline.points.clone(), facets: outline.facets.clone(), is_endless };
        let is_plane = surface.plane().is_some();
        Self { is_endless: is_endless && is_plane, ..surface }
    }

    /// The plane of its first facet; none without one that has an area.
    pub(crate) fn plane(&self) -> Option<Plane> {
        let facet = self.facets.first()?;
        let [a, b, c] = [0, 1, 2].map(|k| self.points.get(facet[k] as usize).copied());
        let (a, b, c) = (a?, b?, c?);
        let minus = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
        let normal = unit(cross(minus(b, a), minus(c, a)))?;
        let foot = normal.map(|n| n * dot(normal, a));
        let least = (0..3).min_by(|&i, &j| normal[i].abs().total_cmp(&normal[j].abs()))?;
        let mut axis = [0.0; 3];
        axis[least] = 1.0;
        let share = dot(axis, normal);
        let first = unit([0, 1, 2].map(|k| axis[k] - share * normal[k]))?;
        Some(Plane { foot, normal, along: [first, cross(normal, first)] })
    }

    /// Itself; of a plane without end the piece beside the bodies in this box.
    pub(crate) fn piece(&self, near: Extent<3>) -> Self {
        match self.plane().filter(|_| self.is_endless && near.iter().flatten().all(|v| v.is_finite())) {
            None => self.clone(),
            Some(plane) => {
                let points = plane.rectangle(plane.sides(near)).to_vec();
                Self { points, facets: vec![[0, 1, 2, 3]], is_endless: true }
            }
        }
    }
}

impl Plane {
    /// The place in 3D of two coordinates in 2D.
    pub(crate) fn place(&self, [a, b]: [f64; 2]) -> [f64; 3] {
        [0, 1, 2].map(|k| self.foot[k] + a * self.along[0][k] + b * self.along[1][k])
    }

    /// Coordinates in the plane of the smallest rectangle above which a box lies, and some room beside it.
    pub(crate) fn sides(&self, near: Extent<3>) -> Extent<2> {
        let mut sides = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        for corner in 0..8_usize {
            let x = [0, 1, 2].map(|k| near[corner >> k & 1][k]);
            for (k, along) in self.along.iter().enumerate() {
                let at = dot(*along, x);
                (sides[0][k], sides[1][k]) = (sides[0][k].min(at), sides[1][k].max(at));
            }
        }
        let more = BESIDE * (0..3).map(|k| near[1][k] - near[0][k]).fold(0.0, f64::max);
        [sides[0].map(|v| v - more), sides[1].map(|v| v + more)]
    }

    /// Corners of a rectangle in 2D, outward by the right-hand rule, m.
    pub(crate) fn rectangle(&self, [low, high]: Extent<2>) -> [[f64; 3]; 4] {
        [[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]].map(|at| self.place(at))
    }
}

pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The vector with length one; none for one without a direction.
pub(crate) fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let largest = v.iter().fold(0.0f64, |size, c| size.max(c.abs()));
    if !(largest > 0.0 && v.iter().all(|c| c.is_finite())) {
        return None;
    }
    let scaled = v.map(|c| c / largest);
    let length = dot(scaled, scaled).sqrt();
    Some(scaled.map(|c| c / length))
}

/// The box around places, m: its lower and its upper corner; none of none.
pub(crate) fn box_around(places: impl Iterator<Item = [f64; 3]>) -> Option<[[f64; 3]; 2]> {
    let sound = places.filter(|place| place.iter().all(|x| x.is_finite()));
    sound.fold(None, |around, place| {
        let [low, high] = around.unwrap_or([place, place]);
        Some([[0, 1, 2].map(|k| low[k].min(place[k])), [0, 1, 2].map(|k| high[k].max(place[k]))])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(points: Vec<[f64; 2]>) -> Vec<Line> {
        let outlines = vec![Outline::line("o", points)];
        let frame = Frame { outlines, ..Frame::of(&[[-1.0, 0.0], [0.0, 2.0]]) };
        LineReader::default().lines(&frame)
    }

    #[test]
    fn a_plane_far_longer_than_the_model_has_no_end() {
        assert!(lines(vec![[-40.0, -1.0], [40.0, -1.0]])[0].is_endless);
        assert!(!lines(vec![[-4.0, -1.0], [4.0, -1.0]])[0].is_endless);
        assert!(!lines(vec![[-40.0, -1.0], [0.0, -2.0], [40.0, -1.0]])[0].is_endless);
    }

    #[test]
    fn the_piece_of_an_endless_line_lies_across_the_model() {
        let piece = lines(vec![[-40.0, -1.0], [40.0, -1.0]])[0].piece([[2.0, 0.0], [5.0, 4.0]]);
        let wanted = [[-1.5, -1.0], [8.5, -1.0]];
        assert!(piece.iter().zip(wanted).all(|(p, w)| (p[0] - w[0]).abs() < 1e-9 && (p[1] - w[1]).abs() < 1e-9), "{piece:?}");
        let finite = vec![[-4.0, -1.0], [4.0, -1.0]];
        assert_eq!(lines(finite.clone())[0].piece([[0.0; 2], [1.0; 2]]), finite);
    }

    #[test]
    fn a_clockwise_line_goes_around_its_solid() {
        let square = vec![[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];
        assert!(lines(square.clone())[0].is_filled());
        let hollow = lines(square.iter().rev().copied().collect());
        assert!(hollow[0].is_closed() && !hollow[0].is_filled());
        assert!(!lines(square[..4].to_vec())[0].is_closed());
    }

    fn surface(points: Vec<[f64; 3]>, facets: Vec<[u32; 4]>) -> Surface {
        let outlines = vec![Outline { name: "o".into(), points, facets, is_gone: false }];
        let frame = Frame { outlines, ..Frame::of(&[[-1.0, 0.0, 0.5], [0.0, 2.0, 1.0]]) };
        LineReader::default().surfaces(&frame).remove(0)
    }

    #[test]
    fn a_plane_of_3d_far_larger_than_the_model_has_no_end_and_a_piece_under_it() {
        // Slanted: z = x − 1.
        let square = |s: f64| vec![[-s, -s, -s - 1.0], [s, -s, s - 1.0], [s, s, s - 1.0], [-s, s, -s - 1.0]];
        let large = surface(square(50.0), vec![[0, 1, 2, 3]]);
        assert!(large.is_endless && !surface(square(5.0), vec![[0, 1, 2, 3]]).is_endless);
        assert!(surface(square(50.0), vec![[0, 1, 2, 2], [0, 2, 3, 3]]).is_endless);
        assert!(!surface(square(50.0), vec![[0, 0, 0, 0]]).is_endless);
        let piece = large.piece([[0.0; 3], [2.0; 3]]);
        assert_eq!(piece.facets, [[0, 1, 2, 3]]);
        assert!(piece.points.iter().all(|p| (p[2] - p[0] + 1.0).abs() < 1e-9 && p.iter().all(|v| v.abs() < 5.0)), "{piece:?}");
        let up = |s: &Surface| s.plane().unwrap().normal;
        assert!((0..3).all(|k| (up(&piece)[k] - up(&large)[k]).abs() < 1e-9), "its free side stays");
        let finite = surface(square(5.0), vec![[0, 1, 2, 3]]);
        assert_eq!(finite.piece([[0.0; 3], [2.0; 3]]), finite);
    }
}
