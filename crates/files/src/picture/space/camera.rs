//! From places in 3D to places in a picture: the directions in which a camera looks, and the mirror images
//! of a model. Comes from `output.camera`; `film` and `mesh` choose with it how much is shown, `scene` turns
//! metres into pixels.

use crate::outline::{Extent, cross, dot, unit};
use embate_solver::model::Camera;

/// Unit vectors of a picture: to its right, upwards, and towards who looks at it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Directions {
    pub(super) right: [f64; 3],
    pub(super) up: [f64; 3],
    pub(super) towards: [f64; 3],
}

impl Directions {
    /// Those of a camera. Where its directions can't be reported (a zero vector, or upwards where it looks
    /// from), others take their place.
    pub(super) fn of(camera: &Camera) -> Self {
        let usual = Camera::default();
        let towards = unit(camera.from).or(unit(usual.from)).unwrap_or([0.0, 0.0, 1.0]);
        let ups = [camera.up, usual.up, [0.0, 1.0, 0.0]];
        let across = |up: &[f64; 3]| Some(cross(unit(*up)?, towards)).filter(|right| dot(*right, *right) > 1e-10).and_then(unit);
        let right = ups.iter().find_map(across).unwrap_or([1.0, 0.0, 0.0]);
        Self { right, up: cross(towards, right), towards }
    }

    /// Right, up and towards of a place, m, from the image of the origin.
    pub(super) fn seen(&self, place: [f64; 3]) -> [f64; 3] {
        [dot(self.right, place), dot(self.up, place), dot(self.towards, place)]
    }

    /// The same of a place in a mirror image.
    pub(super) fn mirrored(&self, sign: [f64; 3]) -> Self {
        let turned = |v: [f64; 3]| [0, 1, 2].map(|k| sign[k] * v[k]);
        Self { right: turned(self.right), up: turned(self.up), towards: turned(self.towards) }
    }
}

/// Signs of the coordinates in each image: the model itself, and its mirror images.
fn images(mirror: [bool; 3]) -> Vec<[f64; 3]> {
    let mut images = vec![[1.0; 3]];
    for axis in (0..3).filter(|&axis| mirror[axis]) {
        for index in 0..images.len() {
            let mut image: [f64; 3] = images[index];
            image[axis] = -1.0;
            images.push(image);
        }
    }
    images
}

/// How a picture looks at a model: its camera, and the images that it shows.
#[derive(Clone, Debug)]
pub(in crate::picture) struct Sight {
    pub(super) directions: Directions,
    pub(super) images: Vec<[f64; 3]>,
    camera: Camera,
}

impl Sight {
    /// A camera, and the axes at whose planes the model is mirrored.
    pub(in crate::picture) fn new(camera: &Camera, mirror: [bool; 3]) -> Self {
        Self { directions: Directions::of(camera), images: images(mirror), camera: *camera }
    }

    /// Box around places (m) in the picture, in all images: to the right and upwards.
    pub(in crate::picture) fn view(&self, places: impl Iterator<Item = [f64; 3]>) -> Extent<2> {
        let images: Vec<Directions> = self.images.iter().map(|sign| self.directions.mirrored(*sign)).collect();
        let mut view = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        for place in places.filter(|place| place.iter().all(|v| v.is_finite())) {
            for directions in &images {
                let [right, up, _] = directions.seen(place);
                view = [[view[0][0].min(right), view[0][1].min(up)], [view[1][0].max(right), view[1][1].max(up)]];
            }
        }
        view
    }

    /// What the camera shows where a picture of everything would show `view`: around the place that it looks
    /// at, and as much larger as was asked for.
    pub(in crate::picture) fn aimed(&self, view: Extent<2>) -> Extent<2> {
        let at = self.camera.at.map(|at| self.directions.seen(at));
        let zoom = if self.camera.zoom > 0.0 { self.camera.zoom } else { 1.0 };
        let middle = [0, 1].map(|k| at.map_or(0.5 * (view[0][k] + view[1][k]), |at| at[k]));
        let half = [0, 1].map(|k| 0.5 * (view[1][k] - view[0][k]) / zoom);
        [[middle[0] - half[0], middle[1] - half[1]], [middle[0] + half[0], middle[1] + half[1]]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_near(a: [f64; 3], b: [f64; 3]) -> bool {
        (0..3).all(|k| (a[k] - b[k]).abs() < 1e-12)
    }

    #[test]
    fn seen_from_the_front_x_is_to_the_right_and_z_upwards() {
        let front = Directions::of(&Camera { from: [0.0, -7.0, 0.0], ..Camera::default() });
        assert!(is_near(front.seen([1.0, 2.0, 3.0]), [1.0, 3.0, -2.0]));
        let above = Directions::of(&Camera { from: [0.0, 0.0, 2.0], up: [0.0, 3.0, 0.0], ..Camera::default() });
        assert!(is_near(above.seen([1.0, 2.0, 3.0]), [1.0, 2.0, 3.0]));
    }

    #[test]
    fn directions_are_right_handed_and_of_length_one_whatever_was_asked_for() {
        let nan = f64::NAN;
        for (from, up) in
            [([0.6, -1.0, 0.5], [0.0, 0.0, 1.0]), ([0.0, 0.0, 3.0], [0.0, 0.0, 1.0]), ([0.0; 3], [0.0; 3]), ([nan; 3], [1.0, nan, 0.0])]
        {
            let d = Directions::of(&Camera { from, up, ..Camera::default() });
            assert!(is_near(cross(d.right, d.up), d.towards), "{d:?}");
            assert!([d.right, d.up, d.towards].iter().all(|v| (dot(*v, *v) - 1.0).abs() < 1e-12), "{d:?}");
        }
    }

    #[test]
    fn the_usual_camera_sees_three_sides_of_a_box() {
        let towards = Directions::of(&Camera::default()).towards;
        assert!(towards[0] > 0.3 && towards[1] < -0.3 && towards[2] > 0.3, "{towards:?}");
    }

    #[test]
    fn a_picture_is_around_what_it_looks_at_and_as_much_larger_as_was_asked_for() {
        let front = Camera { from: [0.0, -1.0, 0.0], ..Camera::default() };
        let all = [[1.0, 5.0, 0.0], [3.0, -5.0, 1.0]];
        let sight = Sight::new(&front, [true, false, false]);
        let view = sight.view(all.into_iter().chain([[f64::NAN, 0.0, 9.0]]));
        assert_eq!(view, [[-3.0, 0.0], [3.0, 1.0]]);
        assert_eq!(sight.aimed(view), view);
        let near = Sight::new(&Camera { at: Some([2.0, 7.0, 1.0]), zoom: 2.0, ..front }, [false; 3]);
        assert_eq!(near.aimed(view), [[0.5, 0.75], [3.5, 1.25]]);
    }

    #[test]
    fn two_mirrors_make_four_images() {
        assert_eq!(images([true, false, true]), [[1.0, 1.0, 1.0], [-1.0, 1.0, 1.0], [1.0, 1.0, -1.0], [-1.0, 1.0, -1.0]]);
    }
}
