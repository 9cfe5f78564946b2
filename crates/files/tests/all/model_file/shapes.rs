//! Shapes and their placement in the model file: what is read, and what is refused with which words.

use super::{changed, faults, read};
use embate_solver::model::{Copies, Edge, Mirror, Placement, Shape};

const RECTANGLE: &str = "rectangle = { corner = [0, \"-3 mm\"], size = [\"600 mm\", \"3 mm\"], elements = [120, 3] }\n";

/// The sound model with another shape for its plate (sides `left` and `right` stay).
fn with(shape: &str) -> String {
    changed(RECTANGLE, &format!("{shape}\n"))
}

#[test]
fn every_key_of_a_shape_and_its_placement_arrives() {
    let shape = "rotation = { angle = \"90 deg\", point = [1, 0] }\nmirror = { normal = [0, 1] }\ntranslation = [\"1 mm\", 0]\n\
                 copies = { count = 3, angle = \"10 deg\", translation = [0, 2] }\n\
                 quadrilateral = { corners = [[0, 0], [1, 0], [1, 1], [0, 1]], elements = [4, 6], grading = [2, 0.5], \
                 bottom_arc = [0.5, -0.2], top = [[0.75, 1.1], [0.25, 1.1]] }";
    let model = read(&with(shape)).unwrap();
    let part = &model.parts[1];
    let Shape::Quadrilateral(it) = &part.shape else { panic!("{:?}", part.shape) };
    let edges = [Edge::Arc([0.5, -0.2]), Edge::Straight, Edge::Line(vec![[0.75, 1.1], [0.25, 1.1]]), Edge::Straight];
    assert_eq!((&it.edges, it.elements, it.grading, it.corners.len()), (&edges, [4, 6], [2.0, 0.5], 4));
    let expected = Placement {
        mirror: Some(Mirror { normal: [0.0, 1.0, 0.0], point: [0.0; 3] }),
        rotation: std::f64::consts::FRAC_PI_2,
        rotation_point: [1.0, 0.0, 0.0],
        rotation_axis: [0.0, 0.0, 1.0],
        translation: [1e-3, 0.0, 0.0],
        copies: Some(Copies { count: 3, translation: [0.0, 2.0, 0.0], angle: 10.0_f64.to_radians(), ..Copies::default() }),
    };
    assert_eq!(part.placement, expected);
    assert_eq!(part.count().unwrap().elements, 3 * 24);
    let path = "path = { points = [[0, 0], [1, 0], [1, 1]], width = \"10 mm\", radius = 0.1, elements = [2, 40] }";
    let path = read(&with(path)).unwrap().parts.remove(1).shape;
    assert!(matches!(&path, Shape::Path(it) if it.radius == 0.1 && !it.closed && it.points.len() == 3), "{path:?}");
    let trapezoid = "trapezoid = { corner = [0, 0], bottom = 2, top = 1, height = 1, shift = 0.25, elements = [2, 3] }";
    let trapezoid = read(&with(trapezoid)).unwrap().parts.remove(1).shape;
    assert!(matches!(&trapezoid, Shape::Trapezoid(it) if it.shift == Some(0.25)), "{trapezoid:?}");
}

#[test]
fn shapes_that_can_not_be_are_refused_with_the_place() {
    let polygon = |keys: &str| format!("polygon = {{ size = 0.1, {keys} }}");
    let quad = |keys: &str| format!("quadrilateral = {{ elements = [2, 2], {keys} }}");
    let path = |keys: &str| format!("path = {{ width = 0.2, elements = [2, 8], {keys} }}");
    let square = "outline = [[0, 0], [1, 0], [1, 1], [0, 1]]";
    let cases = [
        (polygon("outline = [[0, 0], [1, 1], [1, 0], [0, 1]]"), "polygon.outline", "meet at (5.000000e-1, 5.000000e-1) m"),
        (polygon("outline = [[0, 0], [1, 0], [1, 0], [0, 1]]"), "polygon.outline", "points 1 and 2 are the same"),
        (polygon("outline = [[0, 0], [1, 0], [0.5, 0], [0.5, 1]]"), "polygon.outline", "meet at"),
        (polygon(&format!("{square}, holes = [[[2, 2], [3, 2], [2, 3]]]")), "polygon.holes[0]", "is not inside the outline"),
        (polygon(&format!("{square}, holes = [[[0.5, 0.5], [2, 0.5], [0.5, 0.7]]]")), "polygon.holes[0]", "meet at (1.000000e0, "),
        (polygon(&format!("{square}, near = [[0, 0]], sizes = [0.1, 0.2]")), "polygon.sizes", "1 points in `near`, but 2 `sizes`"),
        (quad("corners = [[0, 0], [0, 1], [1, 1], [1, 0]]"), "quadrilateral.corners", "run clockwise"),
        (quad("corners = [[0, 0], [1, 1], [1, 0], [0, 1]]"), "quadrilateral.corners", "cross each other"),
        (quad("corners = [[0, 0], [1, 0], [0.2, 0.2], [0, 1]]"), "quadrilateral.corners", "points inwards"),
        (quad("corners = [[0, 0], [1, 0], [1, 1], [0, 1], [0, 2]]"), "quadrilateral.corners", "has 4 corners, not 5"),
        (quad("corners = [[0, 0], [1, 0], [1, 1], [0, 1]], left_arc = [0, 0.5]"), "quadrilateral.left_arc", "in line with the corners"),
        (quad("corners = [[0, 0], [1, 0], [1, 1], [0, 1]], top = [[1, 1]]"), "quadrilateral.top", "are the same"),
        (path("points = [[0, 0], [1, 0], [1, 0]]"), "path.points", "points 1 and 2 are the same"),
        (path("points = [[0, 0], [1, 0], [0, 0]]"), "path.points", "turns back at (1.000000e0, 0.000000e0) m"),
        (path("points = [[0, 0], [1, 0], [1, 1]], radius = 0.05"), "path.radius", "can't be bent with a radius of 0.05 m"),
        (path("points = [[0, 0], [1, 0]], closed = true"), "path.points", "at least 3 points"),
        ("ring = { centre = [0, 0], inner = 1, outer = 2, elements = [1, 9], grading = [1, 2] }".into(), "ring.grading", "closed ring"),
        (format!("copies = {{ count = 5, angle = \"90 deg\" }}\n{RECTANGLE}"), "copies.count", "bodies 1 and 5 of the copies lie on each"),
        (format!("copies = {{ count = 5 }}\n{RECTANGLE}"), "copies", "needs `translation` or `angle`"),
    ];
    for (shape, path, message) in cases {
        let found = faults(&with(&shape));
        let path = format!("part[1].{path}");
        assert!(found.iter().any(|fault| fault.path == path && fault.message.contains(message)), "{shape}: {found:#?}");
    }
}

/// A model of a box, and of a part of this shape.
fn solids(shape: &str) -> String {
    format!(
        "[run]\nend = \"1 ms\"\n[material.steel]\nlaw = \"elastic\"\nyoung = \"200 GPa\"\npoisson = 0.3\ndensity = \"7800 kg/m^3\"\n\
         [[part]]\nname = \"block\"\nmaterial = \"steel\"\nbox = {{ corner = [9, 9, 9], size = [1, 1, 1], elements = [1, 1, 1] }}\n\
         [[part]]\nname = \"body\"\nmaterial = \"steel\"\n{shape}\n[[contact]]\nbodies = \"all\"\n"
    )
}

#[test]
fn every_key_of_a_solid_arrives() {
    let shape = |text: &str| {
        let found = faults(&solids(text));
        // No element is named here: shapes are read and checked all the same.
        assert!(found.iter().all(|fault| fault.message.contains("element")), "{found:#?}");
    };
    shape("box = { corner = [0, 0, 1], size = [1, 2, 3], elements = [2, 3, 4], grading = [1, 2, 3] }");
    shape("cylinder = { centre = [0, 0, 0], axis = [0, 1, 0], radius = 1, length = 2, angle = \"90 deg\", elements = [4, 3] }");
    shape("tube = { centre = [0, 0, 0], inner = 1, outer = 2, length = 1, to = \"90 deg\", elements = [1, 4, 2] }");
    shape("sphere = { centre = [0, 0, 0], radius = 1, elements = 4, portion = \"eighth\" }");
    shape(&format!("{RECTANGLE}extrude = {{ length = 1, elements = 3, from = -1, grading = 2 }}"));
    shape("rectangle = { corner = [1, 0], size = [1, 1], elements = [2, 2] }\nrevolve = { angle = \"90 deg\", elements = 4 }");
}

#[test]
fn solids_that_can_not_be_are_refused_with_the_place() {
    let cylinder = |keys: &str| format!("cylinder = {{ centre = [0, 0, 0], radius = 1, length = 1, {keys} }}");
    let sphere = |keys: &str| format!("sphere = {{ centre = [0, 0, 0], radius = 1, {keys} }}");
    let tube = |keys: &str| format!("tube = {{ centre = [0, 0, 0], length = 1, elements = [1, 8, 1], {keys} }}");
    let cases = [
        (cylinder("elements = [3, 1], angle = \"90 deg\""), "cylinder.elements", "3 elements around a quarter"),
        (cylinder("elements = [2, 1], angle = \"80 deg\""), "cylinder.angle", "the angle is 80 deg"),
        (cylinder("elements = [2, 1], axis = [0, 0, 0]"), "cylinder.axis", "has no direction"),
        (sphere("elements = 3, portion = \"half\""), "sphere.elements", "3 elements around a quarter"),
        (sphere("elements = 2, portion = \"third\""), "sphere.portion", "can't be"),
        (tube("inner = 2, outer = 1"), "tube.inner", "not smaller than the outer radius"),
        ("box = { corner = [0, 0, 0], size = [1, 1, 0], elements = [1, 1, 1] }".into(), "box.size[2]", "must be greater than 0"),
        (format!("{RECTANGLE}revolve = {{ elements = 2 }}"), "revolve.elements", "2 elements can't go all around"),
        ("box = { corner = [0, 0, 0], size = [1, 1], elements = [1, 1, 1] }".into(), "box.size", "has two components, but the model is 3D"),
        (format!("{RECTANGLE}revolve = {{ elements = 2, angle = 1, axis = [0, 0] }}"), "revolve.axis", "has no direction"),
        (format!("{}\nextrude = {{ length = 1, elements = 1 }}", sphere("elements = 2")), "extrude", "is a solid as it is"),
        (RECTANGLE.to_string(), "rectangle", "2D, but part `"),
    ];
    for (shape, path, message) in cases {
        let found = faults(&solids(&shape));
        let path = format!("part[1].{path}");
        assert!(found.iter().any(|fault| fault.path == path && fault.message.contains(message)), "{shape}: {found:#?}");
    }
    // In 2D nothing leads out of it.
    let found = faults(&with(&format!("translation = [0, 0, 1]\nrotation = {{ angle = 1, axis = [0, 1, 0] }}\n{RECTANGLE}")));
    for path in ["part[1].translation", "part[1].rotation.axis"] {
        assert!(found.iter().any(|fault| fault.path == path && fault.message.contains("leads out of the plane")), "{found:#?}");
    }
}

#[test]
fn what_folds_over_or_needs_triangles_is_reported_when_it_is_meshed() {
    let folded = "quadrilateral = { corners = [[0, 0], [1, 0], [1, 1], [0, 1]], elements = [8, 8], bottom_arc = [0.5, 2] }";
    let tight = "path = { points = [[0, 0], [1, 0], [1, 0.1], [0, 0.1]], width = 0.5, elements = [2, 8] }";
    for shape in [folded, tight] {
        let model = read(&with(shape)).unwrap();
        let found = embate_solver::mesh::Mesh::<2>::new(&model).unwrap_err();
        assert!(found.iter().any(|fault| fault.message.contains("folds over at (")), "{found:?}");
        assert!(found.iter().all(|fault| fault.path.starts_with("part[1].")), "{found:?}");
    }
    let wrong = "polygon = { size = 0.1, outline = [[0, 0], [1, 0], [0, 1]] }\nelement_triangles = \"quad4\"";
    let found = faults(&with(wrong));
    assert!(found.iter().any(|fault| fault.path == "part[1].element_triangles"), "{found:#?}");
}
