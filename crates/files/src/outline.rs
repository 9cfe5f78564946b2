//! Obstacles as lines: which are closed, on which side they are solid, which have no end, and the piece of an endless one that a file holds.
//! Outlines come with every [`Frame`]; lines go to the pictures and to `obstacles.pvd`.

use embate_solver::output::Frame;

/// A plane whose outline is longer than so many times the largest initial coordinate has no end.
const ENDLESS: f64 = 30.0;
/// Factor by which a line without end is drawn out: beyond every place where bodies may fly.
const DRAWN_OUT: f64 = 1e3;

/// Lower and upper corner.
pub(crate) type Extent = [[f64; 2]; 2];

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
    pub(crate) fn extent(&self) -> Extent {
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
    pub(crate) fn piece(&self, near: Extent) -> Vec<[f64; 2]> {
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
    /// Lines of a frame, in model order.
    pub(crate) fn lines(&mut self, frame: &Frame) -> Vec<Line> {
        let largest = || frame.positions::<2>().iter().flatten().filter(|x| x.is_finite()).fold(0.0f64, |size, x| size.max(x.abs()));
        let far = *self.far.get_or_insert_with(|| ENDLESS * largest());
        frame.outlines.iter().map(|outline| line(&outline.points, far)).collect()
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

#[cfg(test)]
mod tests {
    use super::*;
    use embate_solver::output::Outline;

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
}
