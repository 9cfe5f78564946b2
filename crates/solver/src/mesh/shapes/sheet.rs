//! Sheets: the middle surfaces of shells in 3D, from shapes in the plane, lines that are swept, and the
//! skins of solids.
//!
//! A sheet is a body of quadrilaterals and triangles in 3D, of which nodes run counter-clockwise seen from
//! the side that its normal looks to. It has no sides: what bounds it or lies on it is a set of nodes. Faces
//! are made by `mesh/skin.rs`.

use super::{Body, Count, Part, UNMESHABLE};
use crate::error::Fault;
use crate::mesh::cell::CellKind;
use crate::mesh::sorted;
use crate::mesh::surface::Corners;

/// Most elements of a solid that is made for its skin alone.
const MOST: usize = 100_000_000;

/// The skin of a solid shape of which a shell can be made.
pub(crate) struct Skin {
    /// The sides of the solid that it consists of.
    pub(super) sides: &'static [&'static str],
    /// How large it will be.
    pub(super) count: Count,
}

impl Part {
    /// Whether its shape can be that of a shell in 3D: a surface, lines that are swept, or a solid with a
    /// skin; of a group of a mesh file only the file knows.
    #[must_use]
    pub(crate) fn makes_sheet(&self) -> bool {
        match (self.shape.solid(), self.shape.built_in()) {
            (Some((solid, _)), _) => solid.skin().is_some(),
            (_, Some((shape, _))) => (shape.cell_kind() == CellKind::Line) == self.sweep.is_some(),
            (None, None) => true,
        }
    }

    /// The middle surface of a shell in 3D, not yet placed; `None` for a group of a mesh file, and where
    /// [`Part::makes_sheet`] is false.
    pub(super) fn sheet(&self) -> Option<Result<Body<3>, Fault>> {
        if !self.makes_sheet() {
            return None;
        }
        if let Some((shape, key)) = self.shape.solid() {
            let skin = shape.skin()?;
            let count = shape.count();
            if count.elements > MOST || count.nodes > u32::MAX as usize {
                let message = "the solid whose skin this is would have too many elements";
                let path = format!("{key}.{}", shape.size_key());
                return Some(Err(Fault::new(&UNMESHABLE, path, message, "take fewer elements, or `line` or `arc` with `revolve`")));
            }
            return Some(shape.body().map(|body| body.skin(skin.sides)).map_err(|wrong| wrong.at(key)));
        }
        let (shape, key) = self.shape.built_in()?;
        let body = shape.body().map_err(|wrong| wrong.at(key));
        Some(match &self.sweep {
            Some(sweep) => body.and_then(|lines| sweep.sheet(&lines).map_err(|wrong| wrong.at(sweep.key()))),
            None => body.map(Body::sheet),
        })
    }
}

impl Body<2> {
    /// The same in the plane z = 0, its normal along z.
    fn sheet(self) -> Body<3> {
        let positions = self.positions.iter().map(|&[x, y]| [x, y, 0.0]).collect();
        let rims = self.sides.into_iter().map(|(name, segments)| (name, sorted(segments.into_iter().flatten())));
        Body { positions, elements: self.elements, sides: Vec::new(), points: rims.chain(self.points).collect() }
    }
}

impl Body<3> {
    /// The surface of which these sides of a solid consist; each side of the solid becomes the set of those
    /// of its nodes that are left.
    fn skin(&self, of: &[&str]) -> Self {
        let mut sheet = Self::default();
        for facet in self.sides.iter().filter(|(name, _)| of.contains(&name.as_str())).flat_map(|(_, facets)| facets) {
            let corners = facet.corners();
            let kind = if corners.len() == 3 { CellKind::Triangle } else { CellKind::Quadrilateral };
            sheet.add([kind.cell(corners)]);
        }
        let used = sorted(sheet.cells().flat_map(|cell| cell.nodes).copied());
        let left = |facets: &[[u32; 4]]| sorted(facets.iter().flatten().copied().filter(|node| used.binary_search(node).is_ok()));
        sheet.points = self.sides.iter().map(|(name, facets)| (name.clone(), left(facets))).collect();
        sheet.only_used(&self.positions);
        sheet
    }
}

#[cfg(test)]
mod tests {
    use super::super::*;
    use crate::mesh::dimension::corner_normals;
    use crate::mesh::geometry::CellGeometry;
    use crate::mesh::surface::Corners;
    use crate::mesh::{Mesh, dimension::Meshed};
    use crate::model::{ImportedMesh, MeshGroup, Model, Placement, ShellSection, SpaceTruss};
    use crate::tensor::cross as cross_in_space;
    use crate::vector::{dot, minus, plus, unit};
    use std::f64::consts::{FRAC_PI_2, PI, TAU};
    use std::sync::Arc;

    fn part(shape: impl Into<Shape>, sweep: Option<Sweep>) -> Part {
        let section = Some(ShellSection { thickness: 1e-3, ..ShellSection::default() });
        Part { name: "sheet".into(), shape: shape.into(), sweep, element: "shell4".into(), section, ..Part::default() }
    }

    fn extrude(length: f64, elements: usize) -> Option<Sweep> {
        Some(Sweep::Extrude(Extrude { length, elements, ..Extrude::default() }))
    }

    fn revolve(angle: f64, elements: usize) -> Option<Sweep> {
        Some(Sweep::Revolve(Revolve { angle, elements, ..Revolve::default() }))
    }

    fn sorted(mut names: Vec<String>) -> Vec<String> {
        names.sort_unstable();
        names
    }

    /// The sheet of a part, for which must hold what is promised of it.
    fn sheet(part: &Part) -> Body<3> {
        let what = format!("{:?} {:?}", part.shape, part.sweep);
        let body = part.solid_body().unwrap().unwrap_or_else(|fault| panic!("{what}: {fault}"));
        let at = |cell: Cell<'_>| cell.nodes.iter().map(|&node| body.positions[node as usize]).collect::<Vec<_>>();
        assert!(body.cells().all(|cell| cell.kind.dimension() == 2 && Dim::<3>::wrong_form(cell.kind, &at(cell)).is_none()), "{what}");
        assert!(body.sides.is_empty() && Some(body.cells().next().unwrap().kind) == part.cell_kind(), "{what}");
        let (count, made) = (part.count().unwrap(), [body.positions.len(), body.cells().count()]);
        assert!(!count.exact || [count.nodes, count.elements] == made, "{count:?} {made:?} {what}");
        let used = crate::mesh::sorted(body.cells().flat_map(|cell| cell.nodes).copied());
        assert_eq!(used.len(), body.positions.len(), "every node is used: {what}");
        let names: Vec<String> = body.points.iter().map(|it| it.0.clone()).chain(["upper".into(), "lower".into()]).collect();
        assert_eq!(sorted(names), sorted(part.sides()), "{what}");
        // Two neighbours run along their common edge in opposite directions.
        let edges: Vec<[u32; 2]> = body.cells().flat_map(Cell::edges).collect();
        let times = |edge: [u32; 2]| edges.iter().filter(|other| **other == edge).count();
        assert!(edges.iter().all(|&[a, b]| [times([a, b]), times([b, a])] != [2, 0]), "{what}");
        body
    }

    fn area(body: &Body<3>) -> f64 {
        body.cells().map(|cell| <Dim<3> as CellGeometry<3>>::size(cell, &body.positions)).sum()
    }

    /// Whether each normal looks along the direction that `out` gives at the middle of the element.
    fn looks(body: &Body<3>, out: impl Fn([f64; 3]) -> [f64; 3]) -> bool {
        body.cells().all(|cell| {
            let places = || cell.nodes.iter().map(|&node| body.positions[node as usize]);
            let centre = places().fold([0.0; 3], plus).map(|x| x / cell.nodes.len() as f64);
            let normal = corner_normals(cell.kind, places()).fold([0.0; 3], plus);
            dot(unit(normal).unwrap(), unit(out(centre)).unwrap()) > 0.9
        })
    }

    fn named(body: &Body<3>, name: &str) -> Vec<[f64; 3]> {
        let (_, nodes) = body.points.iter().find(|it| it.0 == name).unwrap_or_else(|| panic!("{name}"));
        nodes.iter().map(|&node| body.positions[node as usize]).collect()
    }

    fn all(body: &Body<3>, name: &str, holds: impl Fn([f64; 3]) -> bool) -> usize {
        let nodes = named(body, name);
        assert!(nodes.iter().all(|&x| holds(x)), "{name}: {nodes:?}");
        nodes.len()
    }

    /// Errors of the area with coarse and fine elements must fall with the square of their size.
    fn converges(errors: [f64; 2]) {
        let [coarse, fine] = errors.map(f64::abs);
        assert!(fine < 0.05 && (3.5..4.5).contains(&(coarse / fine)), "{errors:?}");
    }

    #[test]
    fn shapes_of_2d_are_sheets_in_their_plane() {
        for (shape, _) in [3, 7].iter().flat_map(|&n| Shape::examples(n)) {
            let plane = shape.built_in().unwrap().0.body().unwrap();
            if plane.cells().all(|cell| cell.kind != CellKind::Line) {
                let body = sheet(&part(shape, None));
                let moments = super::super::tests::moments(&plane);
                assert!((area(&body) / moments[0] - 1.0).abs() < 1e-12 && looks(&body, |_| [0.0, 0.0, 1.0]));
            }
        }
        let plate = Rectangle { size: [3.0, 2.0], elements: [3, 2], ..Rectangle::default() };
        let body = sheet(&part(plate.clone(), None));
        assert_eq!((all(&body, "left", |x| x[0] == 0.0), all(&body, "top", |x| x[1] == 2.0)), (3, 4));
        // It is placed as solids are: upright here, its normal against y.
        let placement = Placement { rotation: FRAC_PI_2, rotation_axis: [1.0, 0.0, 0.0], ..Placement::default() };
        let body = sheet(&Part { placement, ..part(plate, None) });
        assert!(looks(&body, |_| [0.0, -1.0, 0.0]) && all(&body, "top", |x| x[2] == 2.0) == 4);
    }

    #[test]
    fn lines_that_are_pulled_are_sheets_whose_normals_are_on_the_right() {
        let tube = |n| sheet(&part(CircularArc { radius: 2.0, elements: 4 * n, ..CircularArc::default() }, extrude(0.5, n)));
        let body = tube(6);
        assert!(looks(&body, |[x, y, _]| [x, y, 0.0]));
        assert_eq!((all(&body, "back", |x| x[2] == 0.0), all(&body, "front", |x| x[2] == 0.5)), (24, 24));
        converges([6, 12].map(|n| area(&tube(n)) / TAU - 1.0));
        let line = Line { points: vec![[0.0, 0.0], [2.0, 0.0]], radius: 0.0, closed: false, elements: 2 };
        let body = sheet(&part(line, extrude(3.0, 5)));
        assert!((area(&body) - 6.0).abs() < 1e-14 && looks(&body, |_| [0.0, -1.0, 0.0]));
        assert_eq!((all(&body, "start", |x| x[0] == 0.0), all(&body, "end", |x| x[0] == 2.0)), (6, 6));
        let lines = vec![vec![[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]], vec![[1.0, 0.0], [1.0, 1.0]]];
        let body = sheet(&part(Truss { lines, elements: 3 }, extrude(2.0, 2)));
        assert!((area(&body) - 6.0).abs() < 1e-14 && named(&body, "point1").len() == 3);
    }

    #[test]
    fn lines_that_are_turned_are_discs_cones_and_spheres() {
        let line = |points: [[f64; 2]; 2]| Line { points: points.to_vec(), radius: 0.0, closed: false, elements: 4 };
        // From the axis outwards: the right is below.
        let disc = |n| sheet(&part(line([[0.0, 1.0], [2.0, 1.0]]), revolve(TAU, n)));
        let body = disc(12);
        assert_eq!((body.all::<3>(CellKind::Triangle).len(), body.all::<4>(CellKind::Quadrilateral).len()), (12, 36));
        assert!(looks(&body, |_| [0.0, -1.0, 0.0]) && named(&body, "start") == [[0.0, 1.0, 0.0]] && named(&body, "end").len() == 12);
        converges([12, 24].map(|n| area(&disc(n)) / (4.0 * PI) - 1.0));
        // Towards the axis: the right is outside.
        let cone = |n| sheet(&part(line([[1.0, 0.0], [0.0, 2.0]]), revolve(FRAC_PI_2, n)));
        let body = cone(6);
        assert!(looks(&body, |[x, _, z]| [2.0 * x, x.hypot(z), 2.0 * z]));
        assert_eq!((all(&body, "back", |x| x[2] == 0.0), all(&body, "front", |x| x[0] == 0.0)), (5, 5));
        converges([6, 12].map(|n| area(&cone(n)) / (0.25 * PI * 5.0f64.sqrt()) - 1.0));
        let arc = |n: usize| CircularArc { from: -FRAC_PI_2, to: FRAC_PI_2, elements: 2 * n, ..CircularArc::default() };
        let sphere = |n: usize| sheet(&part(arc(n), revolve(TAU, 4 * n)));
        assert!(looks(&sphere(6), |x| x));
        converges([6, 12].map(|n| area(&sphere(n)) / (4.0 * PI) - 1.0));
        let wrong = part(line([[0.0, 0.0], [0.0, 1.0]]), revolve(TAU, 4)).solid_body().unwrap().unwrap_err();
        assert!(wrong.path == "revolve.axis" && wrong.message.contains("no extent"), "{wrong}");
        let points = vec![[0.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
        let wrong = part(Line { points, radius: 0.0, closed: false, elements: 2 }, revolve(TAU, 4)).solid_body().unwrap().unwrap_err();
        assert!(wrong.path == "revolve.axis" && wrong.message.contains("becomes no surface"), "{wrong}");
    }

    #[test]
    fn skins_of_solids_look_outwards_and_their_rims_have_names() {
        for n in [1, 2, 3, 4] {
            for (shape, _) in Shape::solid_examples(n) {
                let it = part(shape, None);
                if it.makes_sheet() {
                    sheet(&it);
                }
            }
        }
        let ball = |n| sheet(&part(Sphere { radius: 2.0, elements: n, ..Sphere::default() }, None));
        assert!(looks(&ball(4), |x| x) && named(&ball(4), "outer").len() == ball(4).positions.len());
        converges([4, 8].map(|n| area(&ball(n)) / (16.0 * PI) - 1.0));
        let body = sheet(&part(Sphere { elements: 6, portion: "eighth".into(), ..Sphere::default() }, None));
        assert_eq!((all(&body, "left", |x| x[0] == 0.0), all(&body, "back", |x| x[2] == 0.0)), (7, 7));
        let can = Cylinder { radius: 0.5, length: 3.0, elements: [4, 5], axis: [1.0, 0.0, 0.0], ..Cylinder::default() };
        let body = sheet(&part(can.clone(), None));
        assert!((area(&body) / (3.0 * PI) - 1.0).abs() < 0.01 && looks(&body, |[_, y, z]| [0.0, y, z]));
        assert_eq!((all(&body, "bottom", |x| x[0] == 0.0), all(&body, "top", |x| x[0] == 3.0)), (16, 16));
        let body = sheet(&part(Cylinder { angle: PI, ..can }, None));
        assert_eq!((named(&body, "start").len(), named(&body, "end").len(), named(&body, "bottom").len()), (6, 6, 9));
        let cuboid = Cuboid { size: [1.0, 2.0, 3.0], elements: [2, 3, 4], ..Cuboid::default() };
        let body = sheet(&part(cuboid, None));
        assert!((area(&body) - 22.0).abs() < 1e-13 && all(&body, "right", |x| x[0] == 1.0) == 20);
        let away = |x: [f64; 3]| minus(x, [0.5, 1.0, 1.5]);
        let near = |cell: Cell<'_>| {
            let x = |k: usize| body.positions[cell.nodes[k] as usize];
            dot(cross_in_space(minus(x(2), x(0)), minus(x(3), x(1))), away(x(0))) > 0.0
        };
        assert!(body.cells().all(near));
        let large = part(Sphere { elements: 2000, ..Sphere::default() }, None).solid_body().unwrap().unwrap_err();
        assert!(large.path == "sphere.elements" && large.message.contains("too many"), "{large}");
    }

    fn model(parts: Vec<Part>) -> Model {
        let mut model = Model { parts, ..Model::default() };
        model.run.end = 1e-3;
        let parameters = [("density", 7800.0), ("young", 2e11), ("poisson", 0.3)].map(|(key, value)| (key.to_string(), value)).into();
        model.materials.insert("steel".into(), crate::model::Material { law: "elastic".into(), parameters, ..Default::default() });
        model.parts.iter_mut().for_each(|part| part.material = "steel".into());
        model
    }

    fn faults(model: &Model) -> Vec<String> {
        model.check().iter().map(|fault| format!("{} {}: {}; {}", fault.kind.code, fault.path, fault.message, fault.help)).collect()
    }

    #[test]
    fn a_mesh_has_groups_of_surfaces_and_sets_of_nodes() {
        let plate = Rectangle { elements: [4, 3], ..Rectangle::default() };
        let triangles = Polygon { outline: vec![[5.0, 0.0], [6.0, 0.0], [5.0, 1.0]], size: 0.3, ..Polygon::default() };
        let parts = vec![part(plate, None), Part { name: "sail".into(), ..part(triangles, None) }];
        let model = model(parts);
        assert_eq!((faults(&model), model.dimension()), (Vec::new(), 3));
        let mesh = Mesh::<3>::new(&model).unwrap_or_else(|faults| panic!("{faults:#?}"));
        let kinds: Vec<CellKind> = mesh.groups.iter().map(|group| group.kind).collect();
        assert_eq!(kinds, [CellKind::Quadrilateral, CellKind::Triangle]);
        let names = kinds.iter().zip(&model.parts).map(|(&kind, part)| part.element_in(3, kind).unwrap().name);
        assert!(names.eq(["shell4", "shell3"]));
        assert_eq!((mesh.nodes("sheet.left").unwrap().len(), mesh.groups[0].elements()), (4, 12));
        let at = |cell: Cell<'_>| cell.nodes.iter().map(|&node| mesh.positions[node as usize]).collect::<Vec<_>>();
        let up = |cell: Cell<'_>| corner_normals(cell.kind, at(cell).into_iter()).all(|normal| normal[2] > 0.0);
        assert!(mesh.groups.iter().flat_map(|group| group.cells()).all(up), "numbering keeps the normals");
    }

    /// Two squares that meet at a right angle, one of two triangles; their common edge, a corner, and a line.
    fn folded() -> ImportedMesh {
        let group = |name: &str, dimension, cells| MeshGroup { name: name.into(), dimension, cells };
        ImportedMesh {
            source: "fold.msh".into(),
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1.0]],
            groups: vec![
                group("all", 2, vec![vec![0, 3, 2, 1], vec![1, 2, 5], vec![1, 5, 4]]),
                group("flat", 2, vec![vec![0, 3, 2, 1]]),
                group("edge", 1, vec![vec![1, 2]]),
                group("corner", 0, vec![vec![0]]),
            ],
            ..ImportedMesh::default()
        }
    }

    #[test]
    fn groups_of_surfaces_of_a_mesh_file_are_sheets_as_the_file_has_them() {
        let of = |group: &str| Part { shape: Shape::Group { mesh: 0, group: group.into() }, ..part(Rectangle::default(), None) };
        let model = |group: &str, file| Model { meshes: vec![Arc::new(file)], ..model(vec![of(group)]) };
        let sound = model("all", folded());
        assert_eq!((faults(&sound), sound.dimension(), sound.element_count(&sound.parts[0])), (Vec::new(), 3, 3));
        let mesh = Mesh::<3>::new(&sound).unwrap_or_else(|faults| panic!("{faults:#?}"));
        assert_eq!((mesh.first_skin_node(), mesh.groups.len(), mesh.bodies().into_iter().max()), (6, 2, Some(0)));
        assert_eq!(["edge", "corner", "flat"].map(|name| mesh.nodes(name).unwrap().len()), [2, 1, 4]);
        let normal = |group: usize| {
            let [a, b, c] = [0, 1, 2].map(|k| mesh.positions[mesh.groups[group].nodes_of(0)[k] as usize]);
            cross_in_space(minus(b, a), minus(c, a))
        };
        assert_eq!((normal(0), normal(1)), ([0.0, 0.0, -1.0], [1.0, 0.0, 0.0]));
        // In the plane z = 0 too.
        let mut flat = folded();
        flat.positions.iter_mut().for_each(|x| x[2] = 0.0);
        assert_eq!(model("flat", flat.clone()).dimension(), 3);
        assert_eq!(Mesh::<3>::new(&model("flat", flat.clone())).unwrap().first_skin_node(), 4);
        let bad = Mesh::<3>::new(&model("all", flat)).unwrap_err();
        assert!(bad.len() == 2 && bad.iter().all(|fault| fault.message.contains("is degenerate")), "{bad:?}");
        assert!(faults(&model("edge", folded())).iter().any(|fault| fault.contains("E0206") && fault.contains("not of surfaces")));
        // Lines are swept, and look to their right.
        let mut swept = of("edge");
        swept.sweep = extrude(2.0, 4);
        let swept = Model { meshes: vec![Arc::new(folded())], ..super::tests::model(vec![swept]) };
        assert_eq!((faults(&swept), swept.element_count(&swept.parts[0])), (Vec::new(), 4));
        let mesh = Mesh::<3>::new(&swept).unwrap_or_else(|faults| panic!("{faults:#?}"));
        assert_eq!((mesh.groups[0].elements(), mesh.nodes("sheet.front").map(|nodes| nodes.len())), (4, Some(2)));
        let [a, b, _, d] = [0, 1, 2, 3].map(|k| mesh.positions[mesh.groups[0].nodes_of(0)[k] as usize]);
        assert!(cross_in_space(minus(b, a), minus(d, a))[0] > 0.0);
    }

    #[test]
    fn groups_of_a_mesh_file_are_on_the_faces_that_they_look_from() {
        let group = |name: &str, cells| MeshGroup { name: name.into(), dimension: 2, cells };
        let mut file = folded();
        // The triangles look along x; the square, whose nodes here begin elsewhere, along -z.
        file.groups.push(group("above", vec![vec![2, 5, 1], vec![3, 2, 1, 0]]));
        file.groups.push(group("below", vec![vec![1, 2, 3, 0]]));
        file.groups.push(group("both", vec![vec![1, 2, 3, 0], vec![0, 3, 2, 1]]));
        file.groups.push(group("elsewhere", vec![vec![0, 1, 4]]));
        let all = Part { shape: Shape::Group { mesh: 0, group: "all".into() }, ..part(Rectangle::default(), None) };
        let mesh = Mesh::<3>::new(&Model { meshes: vec![Arc::new(file)], ..model(vec![all]) }).unwrap();
        let own = |facet: &[u32; 4]| facet.corners().iter().map(|&node| mesh.positions[node as usize]).collect::<Vec<_>>();
        let facets = |name: &str| mesh.surface(name, |_| false).unwrap_or_else(|fault| panic!("{name}: {fault}")).facets;
        // Half of the thickness from the middle, each towards where its corners are counter-clockwise.
        let looks = |facet: &[u32; 4]| {
            let x = own(facet);
            let normal = unit(cross_in_space(minus(x[1], x[0]), minus(x[2], x[0]))).unwrap();
            let side = if normal[0].abs() > 0.5 { normal[0] * (x[2][0] - 1.0) } else { normal[2] * x[2][2] };
            assert!((side - 0.5e-3).abs() < 1e-9, "{x:?} {normal:?}");
            normal.map(|n| n.round())
        };
        let mut above: Vec<[f64; 3]> = facets("above").iter().map(looks).collect();
        above.sort_by(|a, b| a[0].total_cmp(&b[0]));
        assert_eq!(above, [[0.0, 0.0, -1.0], [1.0, 0.0, 0.0]]);
        assert_eq!(facets("below").iter().map(looks).collect::<Vec<_>>(), [[0.0, 0.0, 1.0]]);
        assert_eq!((facets("both").len(), facets("all").len()), (2, 3));
        let upper = facets("sheet.upper");
        assert!(facets("all").iter().all(|facet| upper.contains(facet)));
        // What leads them are still the nodes of the middle; other groups are sets of nodes.
        assert_eq!(["below", "elsewhere"].map(|name| mesh.nodes(name).unwrap().len()), [4, 3]);
        assert!(mesh.nodes("below").unwrap().iter().all(|&node| (node as usize) < mesh.first_skin_node()));
        assert!(mesh.surface("elsewhere", |_| false).is_err());
    }

    #[test]
    fn groups_of_lines_are_on_the_left_of_shells_in_2d() {
        let group = |name: &str, cells| MeshGroup { name: name.into(), dimension: 1, cells };
        let file = ImportedMesh {
            source: "line.msh".into(),
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]],
            groups: vec![group("all", vec![vec![0, 1], vec![1, 2]]), group("up", vec![vec![0, 1]]), group("down", vec![vec![2, 1]])],
            ..ImportedMesh::default()
        };
        let shell =
            Part { shape: Shape::Group { mesh: 0, group: "all".into() }, element: "shell2".into(), ..part(Rectangle::default(), None) };
        let mesh = Mesh::<2>::new(&Model { meshes: vec![Arc::new(file)], ..model(vec![shell]) }).unwrap();
        let places = |name: &str| {
            let surface = mesh.surface(name, |_| false).unwrap_or_else(|fault| panic!("{name}: {fault}"));
            surface.segments.iter().map(|segment| segment.map(|node| mesh.positions[node as usize])).collect::<Vec<_>>()
        };
        let half = 0.5e-3;
        // Segments have the body on their right.
        assert_eq!((places("up"), places("down")), (vec![[[0.0, half], [1.0, half]]], vec![[[2.0, -half], [1.0, -half]]]));
        assert_eq!(places("all"), places("sheet.left"));
    }

    #[test]
    fn what_makes_no_sheet_is_told() {
        let told = |parts: Vec<Part>, words: &[&str]| {
            let faults = faults(&model(parts));
            assert!(faults.iter().any(|fault| words.iter().all(|word| fault.contains(word))), "{words:?}: {faults:?}");
        };
        let named = |name: &str, part: Part| Part { name: name.into(), ..part };
        let line = || Line { points: vec![[0.0, 0.0], [2.0, 0.0]], radius: 0.0, closed: false, elements: 2 };
        told(vec![part(Tube::default(), None)], &["E0213", "part[0].element", "two skins", "`cylinder`"]);
        let bars = SpaceTruss { lines: vec![vec![[0.0; 3], [1.0; 3]]], elements: 1 };
        told(vec![part(bars, None)], &["E0213", "part[0].element", "`cylinder`"]);
        told(vec![part(line(), None)], &["E0213", "not swept"]);
        told(vec![part(Rectangle::default(), extrude(1.0, 1))], &["E0213", "is a solid"]);
        told(vec![Part { section: None, ..part(Rectangle::default(), None) }], &["E0213", "part[0].section", "thickness"]);
        told(vec![Part { hourglass: Some(0.1), ..part(Rectangle::default(), None) }], &["E0213", "no hourglass control"]);
        let two = |element: &str| Part { element: element.into(), ..part(line(), None) };
        told(vec![Part { sweep: extrude(1.0, 1), ..two("shell2") }], &["E0213", "`shell2` is a line in 2D", "`shell4`"]);
        let plate = Part { element: "quad4".into(), section: None, ..named("plate", part(Rectangle::default(), None)) };
        told(vec![plate.clone(), part(Rectangle::default(), None)], &["E0212", "a shell in 3D", "is 2D"]);
        told(vec![part(Rectangle::default(), None), plate], &["E0212", "a shell in 3D", "is 2D"]);
        told(vec![part(Rectangle::default(), None), named("line", two("shell2"))], &["E0212", "`element = \"shell4\"`"]);
        let of_triangles = Part { element: "shell3".into(), ..part(Rectangle::default(), None) };
        told(vec![of_triangles], &["E0204", "quadrilaterals", "shell4"]);
        let solid = Part { element: "hex8".into(), ..part(Cuboid::default(), None) };
        told(vec![solid], &["E0213", "`element = \"shell4\"`"]);
    }
}
