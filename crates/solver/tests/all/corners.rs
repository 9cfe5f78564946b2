//! Energy at corners and edges: bodies that slide and tumble over them. Rigid ones store nothing themselves,
//! so that all that contact takes it must give back, to round-off.

use crate::bodies::*;
use crate::edge_edge::{Block, meet};
use embate_solver::model::{Contact, Disk, Interface, Model, Motion, Obstacle, ObstacleShape, Partners, Penalty, Polygon, Shape};

/// A room with corners of 45 to 135 degrees, convex and concave: 0.1 m wide, with a ridge on its floor and a
/// notch in its wall.
fn room(turned: f64, mirrored: bool) -> ObstacleShape {
    let corners = [
        [0.05, 0.05],
        [-0.05, 0.05],
        [-0.05, -0.05],
        [-0.02, -0.05],
        [0.0, -0.03],
        [0.02, -0.05],
        [0.05, -0.05],
        [0.05, -0.01],
        [0.04, 0.0],
        [0.05, 0.01],
        [0.05, 0.05],
    ];
    let (sin, cos) = turned.sin_cos();
    let mut points: Vec<_> =
        corners.map(|[x, y]| if mirrored { [-x, y] } else { [x, y] }).map(|[x, y]| [cos * x - sin * y, sin * x + cos * y]).to_vec();
    if mirrored {
        points.reverse();
    }
    ObstacleShape::Polyline { points }
}

/// Largest error of the total energy by the work of contact: the sum of all changes of what its springs
/// store.
fn error_by_work(model: &Model) -> (f64, f64) {
    let steps = every_step(model);
    let (total, stored) = (steps.column("energy.total"), steps.column("energy.contact"));
    let work: f64 = stored.windows(2).map(|two| (two[1] - two[0]).abs()).sum();
    (total.iter().map(|now| (now - total[0]).abs()).fold(0.0, f64::max) / work, work / total[0])
}

#[test]
fn rigid_bodies_keep_their_energy_over_corners_of_every_angle() {
    for (turned, mirrored) in [(0.0, false), (0.3, false), (0.0, true)] {
        let mut model = model(0.02);
        add(&mut model, "ball", Shape::Disk(Disk { centre: [-0.02, 0.03], radius: 0.01, elements: 3 }), [30.0, -17.0]);
        let outline = vec![[0.01, 0.0], [0.035, -0.01], [0.02, 0.0], [0.035, 0.012]];
        add(&mut model, "hook", Shape::Polygon(Polygon { outline, size: 0.004, ..Polygon::default() }), [-20.0, 5.0]);
        model.parts[0].spin = 500.0;
        model.parts.iter_mut().for_each(|part| part.rigid = Some(Motion::default()));
        model.contacts.push(Contact { partners: Partners::Bodies(Vec::new()), ..Contact::between("all", "", "") });
        model.obstacles.push(Obstacle::fixed("room", room(turned, mirrored)));
        let (error, work) = error_by_work(&model);
        assert!(work > 3.0, "they hit again and again: {work}");
        assert!(error < 1e-13, "{turned} {mirrored}: {error}");
    }
}

#[test]
fn a_soft_body_slides_over_corners_with_no_more_than_its_elements_lose() {
    // The same scene with hard and with soft springs: the elements' own error, of the same size in both, is
    // the bound.
    for scale in [1.0, 0.1] {
        let mut model = model(0.02);
        add(&mut model, "ball", Shape::Disk(Disk { centre: [-0.02, 0.03], radius: 0.01, elements: 3 }), [10.0, -17.0]);
        model.parts[0].spin = 300.0;
        model.obstacles.push(Obstacle { interface: Penalty::automatic(scale).into(), ..Obstacle::fixed("room", room(0.1, false)) });
        let (error, work) = error_by_work(&model);
        assert!(work > 0.5 && error < 1e-3, "{scale}: {error} {work}");
    }
}

#[test]
fn rigid_blocks_keep_their_energy_over_edges_in_3d() {
    let block = |angle: f64, middle, cells| {
        let (sin, cos) = angle.sin_cos();
        let axes = [[cos, sin, 0.0], [-0.8 * sin, 0.8 * cos, 0.6], [0.6 * sin, -0.6 * cos, 0.8]];
        Block { size: [0.02; 3], cells, axes, middle }
    };
    for angle in [0.3, 0.7, 1.1, 1.4] {
        let mut model = slender(6e-3, 1e9, 1e3);
        block(angle, [-0.02, 0.003, 0.002], [3; 3]).add_to(&mut model, "upper", [20.0, 1.0, -1.0]);
        block(2.0 * angle + 0.2, [0.02, 0.0, 0.0], [2; 3]).add_to(&mut model, "lower", [-10.0, 0.0, 0.5]);
        model.parts.iter_mut().for_each(|part| part.rigid = Some(Motion::default()));
        meet(&mut model, false, Interface::default());
        let (error, work) = error_by_work(&model);
        assert!(work > 0.1 && error < 1e-12, "{angle}: {error} {work}");
    }
}
