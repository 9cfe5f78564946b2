//! Light on facets: normals in the picture, smooth where facets meet at a small angle, and how bright a
//! normal is. Points come from `scene` (to the right, downwards, towards the viewer, one measure); a light
//! per corner goes to `raster`.

use super::skin::Skin;

/// Cosine of the angle, 30°, from which on neighbours have an edge between them.
pub(super) const SMOOTH: f32 = 0.866;
/// Where light comes from, in the picture: from above, a little from the left, and from who looks at it.
/// Length one.
const LIGHT: [f32; 3] = [-0.25, 0.5, 0.829_156_2];
/// Brightness without light, and what light adds. The page of `embate view` has the same light and brightness
/// (`shaders.ts`).
const AMBIENT: f32 = 0.74;
const DIRECT: f32 = 0.28;

/// Unit normals of all facets: to the right, upwards, towards the viewer. Not a number where a corner is not,
/// or where there is no area.
pub(super) fn normals(skin: &Skin, points: &[[f32; 3]], normals: &mut Vec<[f32; 3]>) {
    normals.clear();
    normals.extend(skin.facets.iter().map(|facet| {
        let [a, b, c, d] = facet.corners.map(|corner| points[corner as usize]);
        let (u, v) = (minus(c, a), minus(d, b));
        let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        // Points are given downwards, normals upwards: turning one axis around turns the product around.
        unit([-n[0], n[1], -n[2]])
    }));
}

/// Brightness at the corners of a facet. `halved`: axes, as unit vectors of the picture, on whose mirror
/// planes a node lies; there the surface continues in its mirror image.
pub(super) fn lights(skin: &Skin, normals: &[[f32; 3]], facet: usize, halved: &dyn Fn(u32) -> [Option<[f32; 3]>; 3]) -> [f32; 4] {
    let own = normals[facet];
    // What is seen from behind, as through a hole, has light too.
    let side = if own[2] < 0.0 { -1.0 } else { 1.0 };
    skin.facets[facet].corners.map(|corner| {
        let mut sum = [0.0f32; 3];
        for &other in skin.around(corner) {
            let other = normals[other as usize];
            if dot(other, own) > SMOOTH {
                sum = [sum[0] + other[0], sum[1] + other[1], sum[2] + other[2]];
            }
        }
        for axis in halved(corner).into_iter().flatten() {
            // A surface that crosses the plane at nearly a right angle is smooth there.
            if dot(own, axis).abs() < 0.26 {
                let across = dot(sum, axis);
                sum = [0, 1, 2].map(|k| sum[k] - across * axis[k]);
            }
        }
        let normal = unit(sum);
        let lit = side * dot(if normal[0].is_nan() { own } else { normal }, LIGHT);
        // The comparison also takes what is not a number.
        AMBIENT + if lit > 0.0 { DIRECT * lit } else { 0.0 }
    })
}

pub(super) fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn minus(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn unit(v: [f32; 3]) -> [f32; 3] {
    let length = dot(v, v).sqrt();
    [v[0] / length, v[1] / length, v[2] / length]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two squares that meet at x = 1: the first flat before the viewer, the second turned away by this
    /// slope.
    fn lit(slope: f32) -> ([f32; 4], [f32; 4]) {
        let skin = Skin::of_obstacle(&[[0, 1, 4, 3], [1, 2, 5, 4]], 6);
        // Downwards is positive.
        let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, -slope], [0.0, -1.0, 0.0], [1.0, -1.0, 0.0], [2.0, -1.0, -slope]];
        let mut all = Vec::new();
        normals(&skin, &points, &mut all);
        assert!(all.iter().all(|n| n[2] > 0.0 && (dot(*n, *n) - 1.0).abs() < 1e-6), "{all:?}");
        let lights = |facet| lights(&skin, &all, facet, &|_| [None; 3]);
        (lights(0), lights(1))
    }

    #[test]
    fn facets_at_a_small_angle_share_their_light_and_others_do_not() {
        let (first, second) = lit(0.3);
        assert_eq!((first[1], first[2]), (second[0], second[3]));
        assert!(first[0] > first[1] && second[0] > second[1], "turned to the right, away from the light");
        let (first, second) = lit(1.5);
        assert_eq!(first[0], first[1]);
        assert!(first[1] > second[0] + 0.05);
    }

    #[test]
    fn the_light_is_not_brighter_than_the_colours_and_never_out() {
        for slope in [-5.0, -1.0, 0.0, 1.0, 100.0] {
            let (first, second) = lit(slope);
            assert!(first.iter().chain(&second).all(|l| (0.5..=1.02).contains(l)), "{slope}: {first:?} {second:?}");
        }
    }
}
