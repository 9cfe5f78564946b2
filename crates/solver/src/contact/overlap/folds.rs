//! Sheets that lie over themselves: what regions say is inside, against solid angles.

use super::tests::{block, look, one};
use super::*;
use crate::vector::{minus, plus, times};
use proptest::prelude::*;

/// A crease of a strip: where, how it runs across, over which way and by how much it bends, rad.
type Crease = [f64; 4];

/// Where a place (s along the strip, y across, z from its middle) is once the strip is bent at each crease.
fn bent([s, y, z]: Vector, creases: &[Crease]) -> Vector {
    let (mut x, mut height, mut turn, mut from) = (0.0, 0.0, 0.0f64, 0.0);
    for &[at, skew, way, angle] in creases {
        let begin = at + skew * y;
        let flat = s.min(begin) - from;
        (x, height) = (x + flat * turn.cos(), height + flat * turn.sin());
        let (done, radius) = ((s - begin).clamp(0.0, way), way / angle);
        let next = turn + done / radius;
        (x, height) = (x + radius * (next.sin() - turn.sin()), height + radius * (turn.cos() - next.cos()));
        turn = next;
        from = begin + way;
        if s <= from {
            return [x - z * turn.sin(), y, height + z * turn.cos()];
        }
    }
    [x + (s - from) * turn.cos() - z * turn.sin(), y, height + (s - from) * turn.sin() + z * turn.cos()]
}

/// How many times the surface goes around a place: the sum of the solid angles of its triangles.
fn winding(skin: &Skin, place: Vector) -> f64 {
    let angle = |triangle: u32| {
        let [a, b, c] = skin.corners(triangle).map(|corner| minus(corner, place));
        let (la, lb, lc) = (length(a), length(b), length(c));
        let below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
        2.0 * dot(a, crate::tensor::cross(b, c)).atan2(below)
    };
    (0..skin.triangles.len() as u32).map(angle).sum::<f64>() / (4.0 * std::f64::consts::PI)
}

/// How many regions are open, and how many vertices are inside, of a strip with creases; what is inside has
/// to be where solid angles say that another part of the strip is.
fn inside(creases: &[Crease]) -> Result<[usize; 2], TestCaseError> {
    let (mut nodes, mut cells) = (Vec::new(), Vec::new());
    let thickness = 0.1;
    block([0.0, 0.0, -0.5 * thickness], [4.0, 1.0, 0.5 * thickness], [40, 8, 1], false, &mut nodes, &mut cells);
    let flat = nodes.clone();
    nodes.iter_mut().for_each(|node| *node = bent(*node, creases));
    let mut check = one(&flat, &cells);
    look(&mut check, &nodes);
    // The sides of all parts lie in the same planes: there what is inside is a matter of rounding.
    let is_bent = |vertex: u32| {
        let [s, y, _] = flat[check.skin.nodes[vertex as usize] as usize];
        y == 0.0 || y == 1.0 || creases.iter().any(|&[at, skew, way, _]| (s - at - skew * y - 0.5 * way).abs() < 0.5 * way + 0.25)
    };
    let mut count = 0;
    for region in &check.regions {
        for &vertex in region.inside.iter().filter(|&&vertex| (vertex as usize) < check.skin.nodes.len() && !is_bent(vertex)) {
            let out = check.skin.at_vertex.of(vertex as usize).iter().fold([0.0; 3], |sum, &own| plus(sum, check.skin.double(own)));
            let place = plus(check.skin.x[vertex as usize], times(1e-5 * thickness / length(out), out));
            let found = winding(&check.skin, place);
            prop_assert!(found > 0.5, "vertex {vertex} at {place:?} of {} inside is not: {found}", region.inside.len());
            count += 1;
        }
    }
    Ok([check.regions.iter().filter(|region| region.is_open).count(), count])
}

#[test]
fn a_contour_that_is_open_in_one_crease_says_nothing_of_another_place() {
    // Sharp beyond what the inner face can follow, and once around so that the legs cross.
    let sharp = [1.0, 0.1, 0.03, 2.9];
    let [open, _] = inside(&[sharp]).unwrap();
    assert!(open > 0);
    let [open, count] = inside(&[sharp, [2.2, -0.05, 0.4, 4.2]]).unwrap();
    assert!(open > 0 && count > 0, "{open} {count}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn what_is_inside_lies_in_another_part_of_the_strip(
        first in [0.8..1.2, -0.3..0.3, 0.02..0.5, 2.0..4.5],
        second in [2.0..2.6, -0.3..0.3, 0.02..0.5, 2.0..4.5],
    ) {
        inside(&[first, second])?;
    }
}
