//! Faces of shells in 3D: of sheets that are smooth, folded, joined and cut by symmetry planes.

use crate::angle::cos_sin;
use crate::error::Fault;
use crate::mesh::cell::{Cell, CellKind};
use crate::mesh::surface::{Corners, NONE, SpaceSurface};
use crate::mesh::{ElementGroup, Mesh, PartMesh, signed_volume, tolerance};
use crate::model::{Model, Part, ShellSection, Symmetry};
use crate::rotation::{Square, applied};
use crate::tensor::{cross, product};
use crate::vector::{dot, length, minus, plus, times};
use std::f64::consts::{FRAC_PI_2, PI};

type Place = [f64; 3];
/// Elements by the places of their corners.
type Sheet = Vec<Vec<Place>>;

/// Thickness of all sheets, and half of it.
const THICKNESS: f64 = 0.1;
const HALF: f64 = 0.5 * THICKNESS;

/// Elements over a rectangle of so many, from the coordinates of its nodes.
fn sheet([n, m]: [usize; 2], at: impl Fn(f64, f64) -> Place) -> Sheet {
    let corner = |i: usize, j: usize| at(i as f64, j as f64);
    let element = |k: usize| {
        let (i, j) = (k % n, k / n);
        vec![corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)]
    };
    (0..n * m).map(element).collect()
}

/// The plate z = 0.
fn plate(size: [usize; 2]) -> Sheet {
    sheet(size, |x, y| [x, y, 0.0])
}

/// A wall that stands on the line x = 1 from y = 0, 1 on.
fn wall([n, m]: [usize; 2]) -> Sheet {
    sheet([n, m], |y, z| [1.0, y, z])
}

fn reversed(sheet: Sheet) -> Sheet {
    let turn = |mut element: Vec<Place>| {
        element.reverse();
        element
    };
    sheet.into_iter().map(turn).collect()
}

fn triangles(sheet: Sheet) -> Sheet {
    sheet.into_iter().flat_map(|e| [vec![e[0], e[1], e[2]], vec![e[0], e[2], e[3]]]).collect()
}

fn cylinder(elements: usize, radius: f64) -> Sheet {
    // The last column has the places of the first one, to the last bit.
    let angle = |i: f64| (i as usize % elements) as f64 * 2.0 * PI / elements as f64;
    sheet([elements, 3], |i, z| {
        let [c, s] = cos_sin(angle(i));
        [radius * c, radius * s, z]
    })
}

/// The six faces of a cube of side 2, which has its middle at the origin.
fn closed_box() -> Sheet {
    let mut all = Vec::new();
    for k in 0..3 {
        for side in [-1.0, 1.0] {
            let at = |i: f64, j: f64| {
                let mut x = [side; 3];
                (x[(k + 1) % 3], x[(k + 2) % 3]) = (i - 1.0, j - 1.0);
                x
            };
            // Some elements point outwards, some inwards.
            all.extend(sheet([2, 2], at));
        }
    }
    all
}

fn moebius(elements: usize) -> Sheet {
    sheet([elements, 2], |i, j| {
        let turn = i as usize / elements;
        let part = (i - (turn * elements) as f64) / elements as f64;
        let ([c, s], [c2, s2]) = (cos_sin(2.0 * PI * part), cos_sin(PI * part));
        let off = 0.4 * (j - 1.0) * if turn == 1 { -1.0 } else { 1.0 };
        let radius = 2.0 + off * c2;
        [radius * c, radius * s, off * s2]
    })
}

/// The mesh of sheets with its faces.
fn mesh(elements: &Sheet, symmetries: &[(Place, Place)]) -> Mesh<3> {
    let mesh = unchecked(elements, symmetries);
    check(&mesh);
    mesh
}

/// The same, whatever is wrong with it. Corners in one place have one node.
fn unchecked(elements: &Sheet, symmetries: &[(Place, Place)]) -> Mesh<3> {
    let symmetries = symmetries.iter().map(|&(point, normal)| Symmetry { normal, point, parts: Vec::new(), name: String::new() }).collect();
    let section = ShellSection { thickness: THICKNESS, fold_angle: PI / 6.0, ..ShellSection::default() };
    let part = Part { name: "part".into(), section: Some(section), ..Part::default() };
    let model = Model { parts: vec![part], symmetries, ..Model::default() };
    let mut positions: Vec<Place> = Vec::new();
    let mut node = |place: &Place| {
        let found = positions.iter().position(|x| length(minus(*x, *place)) < 1e-9);
        found.unwrap_or_else(|| {
            positions.push(*place);
            positions.len() - 1
        }) as u32
    };
    let cells: Vec<Vec<u32>> = elements.iter().map(|element| element.iter().map(&mut node).collect()).collect();
    let count = positions.len() as u32;
    let mut mesh = Mesh::<3> { positions, user_nodes: (0..count).collect(), ..Mesh::default() };
    mesh.add_elements(cells.iter().filter_map(|cell| Cell::of(2, cell)), |&node| node);
    mesh.parts.push(PartMesh { name: "part".into(), nodes: (0..count).collect(), faces: Vec::new() });
    mesh.add_skins_of_surfaces(&model, |_| true);
    mesh
}

/// What holds for all meshes with faces.
fn check(mesh: &Mesh<3>) {
    let nodes = mesh.parts[0].nodes.len() as u32;
    assert_eq!(mesh.first_skin_node(), nodes as usize);
    assert!(mesh.skins.is_sorted_by_key(|skin| skin.owner));
    assert_eq!(mesh.user_nodes, (0..mesh.positions.len() as u32).collect::<Vec<_>>());
    assert!(mesh.joints.is_sorted());
    for (skin, place) in mesh.skins.iter().zip(&mesh.positions[nodes as usize..]) {
        assert_eq!(plus(mesh.positions[skin.owner as usize], skin.arm), *place);
        assert!(length(skin.arm) <= 2.0 * HALF * (1.0 + 1e-12) && length(skin.arm) > 0.99 * HALF, "{:?}", skin.arm);
    }
    for (group, directions) in mesh.groups.iter().zip(&mesh.directions) {
        assert_eq!(directions.len(), group.connectivity.len());
        for (element, outer) in group.outer_cells() {
            let cell = group.cell(element);
            let (count, middle) = (cell.nodes.len(), |node: u32| mesh.leader_of(node));
            assert!(!outer.is_collapsed());
            assert!((0..2 * count).all(|k| middle(outer.nodes[k]) == cell.nodes[k % count] && outer.nodes[k] >= nodes));
            for corner in 0..count {
                let direction = directions[count * element + corner];
                assert!((length(direction) - 1.0).abs() < 1e-15);
                let arm = minus(mesh.positions[outer.nodes[count + corner] as usize], mesh.positions[cell.nodes[corner] as usize]);
                assert!(dot(arm, direction) > 0.08 * HALF);
            }
        }
    }
    assert_eq!(faults(mesh), []);
    let all: Vec<u32> = (nodes..mesh.positions.len() as u32).collect();
    assert_eq!(mesh.parts[0].faces, all);
    mesh.outside_without(&[], |_| false).unwrap();
    assert!(["part.upper", "part.lower"].iter().all(|name| mesh.surface(name, |_| false).is_ok()));
}

fn faults(mesh: &Mesh<3>) -> Vec<Fault> {
    let mut faults = Vec::new();
    mesh.check_thickness(&Model::default(), &mut faults);
    faults
}

fn outside(mesh: &Mesh<3>) -> SpaceSurface {
    mesh.outside_without(&[], |_| false).unwrap()
}

/// Number of edges at which a surface ends.
fn open_edges(surface: &SpaceSurface) -> usize {
    surface.edges.iter().filter(|edge| edge.facets.contains(&NONE)).count()
}

/// Kind of the first of its cells as bodies have them.
fn first_kind(group: &ElementGroup) -> CellKind {
    group.outer_cells().next().unwrap().1.kind
}

/// The outside of a mesh that closes: each edge has two facets. The volume is that within it.
fn closed(mesh: &Mesh<3>) -> (usize, f64) {
    let surface = outside(mesh);
    let mut edges: Vec<[u32; 2]> = Vec::new();
    for facet in &surface.facets {
        let nodes = facet.corners();
        edges.extend((0..nodes.len()).map(|k| [nodes[k], nodes[(k + 1) % nodes.len()]]));
    }
    edges.sort_unstable();
    assert!(edges.windows(2).all(|w| w[0] != w[1]));
    assert!(edges.iter().all(|&[a, b]| edges.binary_search(&[b, a]).is_ok()));
    assert_eq!(open_edges(&surface), 0);
    let cone = |facet: &[u32; 4]| {
        let [a, b, c, d] = facet.map(|node| mesh.positions[node as usize]);
        (dot(a, cross(b, c)) + dot(a, cross(c, d))) / 6.0
    };
    (surface.facets.len(), surface.facets.iter().map(cone).sum())
}

/// Arms of the nodes on the faces around a place.
fn arms(mesh: &Mesh<3>, place: Place) -> Vec<Place> {
    let is_there = |owner: u32| length(minus(mesh.positions[owner as usize], place)) < 1e-9;
    mesh.skins.iter().filter(|skin| is_there(skin.owner)).map(|skin| skin.arm).collect()
}

/// The same times `1/HALF`, rounded and sorted.
fn rounded_arms(mesh: &Mesh<3>, place: Place) -> Vec<[i32; 3]> {
    let mut all: Vec<[i32; 3]> = arms(mesh, place).into_iter().map(|arm| arm.map(|x| (x / HALF * 1000.0).round() as i32)).collect();
    all.sort_unstable();
    all
}

#[test]
fn a_plate_has_its_faces_at_half_of_the_thickness() {
    for elements in [plate([3, 2]), triangles(plate([3, 2])), [triangles(plate([3, 1])), sheet([3, 1], |x, y| [x, y + 1.0, 0.0])].concat()]
    {
        let count = elements.len();
        let triangular = elements.iter().filter(|element| element.len() == 3).count();
        let mesh = mesh(&elements, &[]);
        assert!(mesh.skins.iter().all(|skin| skin.arm == [0.0, 0.0, HALF] || skin.arm == [0.0, 0.0, -HALF]));
        assert!(mesh.directions.iter().flatten().all(|direction| *direction == [0.0, 0.0, 1.0]));
        let (facets, volume) = closed(&mesh);
        assert_eq!((facets, mesh.skins.len(), mesh.joints.len()), (2 * count + 10, 24, 0));
        assert!((volume - 6.0 * THICKNESS).abs() < 1e-14);
        let of = |group: &ElementGroup| {
            let kind = first_kind(group);
            let places = |cell: Cell<'_>| cell.nodes.iter().map(|&node| mesh.positions[node as usize]).collect::<Vec<_>>();
            group.outer_cells().map(|(_, cell)| signed_volume(kind, &places(cell))).sum::<f64>()
        };
        assert!((mesh.groups.iter().map(of).sum::<f64>() - 6.0 * THICKNESS).abs() < 1e-14);
        let kinds: Vec<CellKind> = mesh.groups.iter().map(first_kind).collect();
        assert_eq!(kinds.contains(&CellKind::Wedge), triangular > 0);
        for (name, z) in [("part.upper", HALF), ("part.lower", -HALF)] {
            let face = mesh.surface(name, |_| false).unwrap();
            assert_eq!((face.facets.len(), open_edges(&face)), (count, 10));
            assert!(face.nodes.iter().all(|&node| mesh.positions[node as usize][2] == z));
        }
    }
}

#[test]
fn neighbours_of_opposite_orientation_have_one_smooth_face() {
    let elements = [plate([1, 2]), reversed(sheet([1, 2], |x, y| [x + 1.0, y, 0.0])), sheet([1, 2], |x, y| [x + 2.0, y, 0.0])].concat();
    let mesh = mesh(&elements, &[]);
    let (facets, volume) = closed(&mesh);
    assert_eq!((facets, mesh.skins.len()), (12 + 10, 24));
    assert!((volume - 6.0 * THICKNESS).abs() < 1e-14);
    assert!(mesh.skins.iter().all(|skin| skin.arm == [0.0, 0.0, HALF] || skin.arm == [0.0, 0.0, -HALF]));
}

#[test]
fn a_cylinder_has_its_faces_at_half_of_the_thickness_from_its_nodes() {
    let mesh = mesh(&cylinder(24, 1.0), &[]);
    for skin in &mesh.skins {
        let [x, y, _] = mesh.positions[skin.owner as usize];
        let outward = dot(skin.arm, [x, y, 0.0]);
        assert!((outward.abs() - HALF).abs() < 1e-15 && (length(skin.arm) - HALF).abs() < 1e-15);
    }
    let (facets, volume) = closed(&mesh);
    assert_eq!(facets, 24 * (6 + 2));
    // Between two prisms of 24 sides.
    let area = |radius: f64| 12.0 * radius * radius * cos_sin(PI / 12.0)[1];
    assert!((volume - 3.0 * (area(1.0 + HALF) - area(1.0 - HALF))).abs() < 1e-13);
}

#[test]
fn folds_of_a_box_are_at_half_of_the_thickness_from_all_its_walls() {
    let mesh = mesh(&closed_box(), &[]);
    let corner: Vec<[i32; 3]> = vec![[-1000; 3], [1000; 3]];
    assert_eq!(rounded_arms(&mesh, [1.0; 3]), corner);
    assert_eq!(rounded_arms(&mesh, [-1.0, -1.0, -1.0]), corner);
    assert_eq!(rounded_arms(&mesh, [1.0, 0.0, 1.0]), [[-1000, 0, -1000], [1000, 0, 1000]]);
    let (facets, volume) = closed(&mesh);
    assert_eq!((facets, mesh.joints.len()), (48, 0));
    assert!((volume - (2.1f64.powi(3) - 1.9f64.powi(3))).abs() < 1e-13);
}

#[test]
fn where_three_shells_meet_each_sector_has_a_node_and_the_hole_is_hidden() {
    let mut mesh = mesh(&[plate([2, 2]), wall([2, 2])].concat(), &[]);
    let tee = [[-1000, 0, 1000], [0, 0, -1000], [1000, 0, 1000]];
    for y in [0.0, 1.0, 2.0] {
        assert_eq!(rounded_arms(&mesh, [1.0, y, 0.0]), tee);
    }
    // Both faces of 8 elements, rims.
    assert_eq!((mesh.joints.len(), outside(&mesh).facets.len()), (2, 16 + 8 + 6));
    // Without one element of the plate, its rims and what it hid are outside.
    mesh.groups[0].erode(0);
    let shown = outside(&mesh).facets.len();
    // Two faces and two rims are gone; a rim of the neighbour and two rims in the hole are there.
    assert_eq!(shown, 30 - 4 + 1 + 2);
    assert_eq!(mesh.whole_joints().len(), 1);
}

#[test]
fn a_wall_that_ends_on_a_plate_has_nodes_of_its_own_there() {
    for turn in [false, true] {
        let wall = if turn { reversed(wall([2, 1])) } else { wall([2, 1]) };
        let mesh = mesh(&[plate([2, 4]), wall].concat(), &[]);
        assert_eq!(rounded_arms(&mesh, [1.0, 1.0, 0.0]), [[-1000, 0, 1000], [0, 0, -1000], [1000, 0, 1000]]);
        let end = [[-1000, 0, 1000], [0, 0, -1000], [0, 0, 1000], [1000, 0, 1000]];
        assert_eq!(rounded_arms(&mesh, [1.0, 2.0, 0.0]), end);
        assert_eq!((mesh.joints.len(), outside(&mesh).facets.len()), (2, 20 + 12 + 4));
    }
    // One that continues beyond the line on which it stands: its elements stay together.
    let over = sheet([1, 1], |y, z| [1.0, y + 2.0, z + 0.5 * y * (1.0 - z)]);
    let mesh = mesh(&[plate([2, 4]), wall([2, 1]), over].concat(), &[]);
    assert_eq!(rounded_arms(&mesh, [1.0, 2.0, 0.0]).len(), 4);
    assert_eq!(outside(&mesh).facets.len(), 22 + 12 + 6);
}

#[test]
fn a_cross_has_four_faces() {
    let mesh = mesh(&[plate([2, 1]), sheet([1, 2], |y, z| [1.0, y, z - 1.0])].concat(), &[]);
    assert_eq!(rounded_arms(&mesh, [1.0, 0.0, 0.0]), [[-1000, 0, -1000], [-1000, 0, 1000], [1000, 0, -1000], [1000, 0, 1000]]);
    assert_eq!((mesh.joints.len(), outside(&mesh).facets.len()), (1, 8 + 4 + 8));
}

#[test]
fn a_strip_with_one_side_closes() {
    let mesh = mesh(&moebius(40), &[]);
    let (facets, volume) = closed(&mesh);
    assert_eq!((facets, mesh.joints.len(), mesh.skins.len()), (160 + 80, 0, 240));
    // Its length of 4 π by its width.
    assert!((volume / (4.0 * PI * 0.8 * THICKNESS) - 1.0).abs() < 0.02);
    let surface = outside(&mesh);
    assert_eq!(surface.nodes.len() + surface.facets.len(), surface.edges.len());
}

#[test]
fn sheets_that_touch_in_a_point_have_their_own_faces() {
    let leaning = sheet([1, 1], |x, y| [x + 1.0, 1.0, y]);
    let mesh = mesh(&[plate([1, 1]), leaning].concat(), &[]);
    assert_eq!(rounded_arms(&mesh, [1.0, 1.0, 0.0]), [[0, -1000, 0], [0, 0, -1000], [0, 0, 1000], [0, 1000, 0]]);
    assert_eq!(closed(&mesh).0, 12);
}

#[test]
fn shells_whose_faces_have_no_room_are_reported() {
    let twice = [plate([1, 1]), plate([1, 1])].concat();
    let hairpin = [plate([1, 1]), reversed(plate([1, 1]))].concat();
    let tight = cylinder(8, 0.9 * HALF);
    for elements in [twice, hairpin, tight] {
        let faults = faults(&unchecked(&elements, &[]));
        assert!(faults[0].message.contains("too thick"), "{faults:?}");
    }
}

#[test]
fn a_quarter_between_symmetry_planes_has_the_faces_of_the_whole() {
    // A dome: steep at its rim, so that the planes cut it at a slope.
    let dome = |shift: f64, n: usize| {
        sheet([n, n], move |i, j| {
            let (x, y) = (0.25 * i - shift, 0.25 * j - shift);
            [x, y, 0.4 - 0.3 * (x * x + y * y)]
        })
    };
    let (whole, quarter) = (mesh(&dome(1.0, 8), &[]), mesh(&dome(0.0, 4), &[([0.0; 3], [1.0, 0.0, 0.0]), ([0.0; 3], [0.0, -2.0, 0.0])]));
    for &place in &quarter.positions[..quarter.first_skin_node()] {
        let [own, other] = [&quarter, &whole].map(|mesh| arms(mesh, place));
        assert_eq!(own.len(), 2);
        assert!(own.iter().all(|arm| other.iter().any(|it| length(minus(*arm, *it)) < 1e-15)));
        for d in [0, 1] {
            assert!(place[d] != 0.0 || own.iter().all(|arm| arm[d] == 0.0));
        }
    }
    let near = tolerance(&quarter.positions);
    let on_plane = |facet: [u32; 4]| (0..2).any(|d| facet.iter().all(|&node| quarter.positions[node as usize][d].abs() < near));
    let surface = quarter.outside_without(&[], on_plane).unwrap();
    assert_eq!((surface.facets.len(), open_edges(&surface)), (32 + 8, 16 + 2));
}

#[test]
fn one_row_between_two_parallel_symmetry_planes_has_no_faces_between_its_elements() {
    let mesh = mesh(&plate([4, 1]), &[([0.0; 3], [0.0, 1.0, 0.0]), ([0.0, 1.0, 0.0], [0.0, 1.0, 0.0])]);
    assert_eq!(mesh.skins.len(), 20);
    // Above and below, two ends, and what is on the planes.
    assert_eq!(mesh.outside_without(&[], |_| false).unwrap().facets.len(), 8 + 2 + 8);
}

#[test]
fn rims_of_curved_sheets_have_the_normals_of_the_surface() {
    // Parts of a cylinder and of a sphere, whose rims are free.
    let part = |round: bool| {
        move |i: f64, j: f64| {
            let ([c, s], [up, along]) = (cos_sin(0.15 * i), if round { cos_sin(0.15 * j) } else { [1.0, 0.3 * j] });
            [up * c, up * s, along]
        }
    };
    // Meridians come together, and so the means inside lean as well; without extrapolation 0.075 at the rims.
    for (round, most) in [(false, 1e-12), (true, 1e-2)] {
        let mesh = mesh(&sheet([5, 5], part(round)), &[]);
        for (owner, arm) in mesh.skins.iter().map(|skin| (mesh.positions[skin.owner as usize], skin.arm)) {
            let normal = if round { owner } else { [owner[0], owner[1], 0.0] };
            let off = minus(arm, times(dot(arm, normal), normal));
            assert!(length(off) < most * HALF, "{round} {owner:?}: {off:?}");
        }
    }
}

#[test]
fn folds_on_symmetry_planes_are_those_of_the_whole() {
    let planes = |normals: &[usize]| -> Vec<(Place, Place)> {
        normals.iter().map(|&k| ([0.0; 3], std::array::from_fn(|d| if d == k { 1.0 } else { 0.0 }))).collect()
    };
    // One eighth of a box: two of its walls at each edge, one wall at each plane.
    let slab = |k: usize| {
        sheet([1, 1], move |i, j| {
            let mut x = [1.0; 3];
            (x[(k + 1) % 3], x[(k + 2) % 3]) = (i, j);
            x
        })
    };
    let eighth = mesh(&(0..3).flat_map(slab).collect(), &planes(&[0, 1, 2]));
    assert_eq!(rounded_arms(&eighth, [1.0; 3]), [[-1000; 3], [1000; 3]]);
    assert_eq!(arms(&eighth, [1.0, 0.0, 1.0]).iter().map(|arm| arm[1]).collect::<Vec<_>>(), [0.0; 2]);
    assert_eq!(rounded_arms(&eighth, [1.0, 0.0, 0.0]), [[-1000, 0, 0], [1000, 0, 0]]);
    // A roof of which one half is there: its ridge is in the plane.
    let roof = mesh(&sheet([1, 1], |x, y| [x, y, -x]), &planes(&[0]));
    assert_eq!(rounded_arms(&roof, [0.0; 3]), [[0, 0, -1414], [0, 0, 1414]]);
    assert!(arms(&roof, [0.0; 3]).iter().all(|arm| arm[0] == 0.0));
    // A plate whose middle is a plane of symmetry, and one half of a tee that stands on it.
    let flat = mesh(&plate([1, 1]), &planes(&[2]));
    assert_eq!(rounded_arms(&flat, [0.0; 3]), [[0, 0, -1000], [0, 0, 1000]]);
    let tee = mesh(&[plate([1, 1]), sheet([1, 1], |y, z| [0.0, y, z])].concat(), &planes(&[0]));
    assert_eq!(rounded_arms(&tee, [0.0; 3]), [[-1000, 0, 1000], [0, 0, -1000], [1000, 0, 1000]]);
    assert_eq!(tee.joints, [([0, 3], 2)]);
    // A diagonal wall in a corner between two planes is a quarter of a cross.
    let cross = mesh(&sheet([1, 1], |x, z| [x, x, z]), &planes(&[0, 1]));
    assert_eq!(rounded_arms(&cross, [0.0; 3]), [[0, 1414, 0], [1414, 0, 0]]);
    // A model that is whole has its own images on itself.
    let whole = mesh(&sheet([2, 1], |x, y| [x - 1.0, y, 0.0]), &planes(&[0]));
    assert_eq!(rounded_arms(&whole, [0.0; 3]), [[0, 0, -1000], [0, 0, 1000]]);
}

#[test]
fn faces_rotate_with_the_shell() {
    let mut random = crate::random::Random::new(7);
    let tee = [plate([2, 4]), wall([2, 1])].concat();
    let folded = sheet([4, 3], |x, y| if x < 2.0 { [x, y, 0.1 * y] } else { [2.0, y, x - 2.0 + 0.1 * y] });
    for elements in [plate([2, 2]), cylinder(9, 1.0), closed_box(), moebius(20), tee, triangles(folded)] {
        let before = mesh(&elements, &[]);
        for _ in 0..3 {
            let rotation = [0, 1, 2].map(|k| turn(k, random.below(1000) as f64)).into_iter().reduce(|a, b| product(&a, &b)).unwrap();
            let shift = [3.0, -2.0, 1.0];
            let moved = elements.iter().map(|element| element.iter().map(|&x| plus(shift, applied(&rotation, x))).collect()).collect();
            let after = mesh(&moved, &[]);
            assert_eq!(after.groups, before.groups);
            for (own, other) in after.skins.iter().zip(&before.skins) {
                assert_eq!(own.owner, other.owner);
                assert!(length(minus(own.arm, applied(&rotation, other.arm))) < 1e-12);
            }
        }
    }
}

/// Rotation about an axis.
fn turn(axis: usize, angle: f64) -> Square<3> {
    let [c, s] = cos_sin(angle);
    let mut matrix = [[0.0; 3]; 3];
    let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
    (matrix[axis][axis], matrix[a][a], matrix[b][b], matrix[a][b], matrix[b][a]) = (1.0, c, c, -s, s);
    matrix
}

#[test]
fn sharp_folds_have_their_faces_within_twice_the_half() {
    for degrees in [20.0f64, 40.0, 90.0, 120.0, 150.0, 160.0] {
        let [c, s] = cos_sin(degrees.to_radians());
        let fold = |x: f64, y: f64| if x <= 1.0 { [x - 1.0, y, 0.0] } else { [c, y, s] };
        let mesh = mesh(&sheet([2, 1], fold), &[]);
        let sine = cos_sin(0.5 * degrees.to_radians())[0];
        let wanted = if degrees < 30.0 { HALF } else { HALF * (1.0 / sine).min(2.0) };
        let along = cos_sin(FRAC_PI_2 + 0.5 * degrees.to_radians());
        for arm in arms(&mesh, [0.0; 3]) {
            let other = times(wanted * arm[2].signum(), [along[0], 0.0, along[1]]);
            assert!(length(minus(arm, other)) < 1e-15, "{degrees}: {arm:?} {other:?}");
        }
    }
}
