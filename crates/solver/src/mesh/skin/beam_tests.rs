//! Faces of beams: closed surfaces, volumes of what the cross-section sweeps, mitres, and what belongs to a
//! joint.

use crate::angle::cos_sin;
use crate::mesh::shapes::SpaceTruss;
use crate::mesh::surface::{NONE, SpaceSurface};
use crate::mesh::{ElementGroup, Mesh, signed_volume};
use crate::model::{ImportedMesh, MeshGroup, Model, Part, Profile, Shape, ShellSection, Symmetry};
use crate::vector::{dot, length, minus, times};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

type Place = [f64; 3];

const RADIUS: f64 = 0.05;

fn some(shape: &str) -> Profile {
    Profile { shape: shape.into(), ..Profile::default() }
}
fn round() -> Profile {
    Profile { diameter: Some(2.0 * RADIUS), ..some("round") }
}
fn i() -> Profile {
    Profile { width: Some(0.06), height: Some(0.1), web: Some(0.01), flange: Some(0.02), ..some("i") }
}
fn flat() -> Profile {
    Profile { width: Some(0.1), height: Some(0.02), ..some("rectangle") }
}

/// Parts of beams along lines, each with its section.
fn model(parts: &[(Vec<Vec<Place>>, Profile)], elements: usize) -> Model {
    let part = |(k, (lines, profile)): (usize, &(Vec<Vec<Place>>, Profile))| Part {
        name: format!("part{k}"),
        shape: Shape::SpaceTruss(SpaceTruss { lines: lines.clone(), elements }),
        element: "beam2".into(),
        profile: Some(profile.clone()),
        ..Part::default()
    };
    Model { parts: parts.iter().enumerate().map(part).collect(), ..Model::default() }
}

fn mesh(lines: Vec<Vec<Place>>, profile: Profile, elements: usize) -> Mesh<3> {
    Mesh::new(&model(&[(lines, profile)], elements)).unwrap()
}

/// The outside, whose edges have two facets each, and the volume of the cells.
fn closed(mesh: &Mesh<3>) -> (SpaceSurface, f64) {
    let surface = mesh.outside_without(&[], |_| false).unwrap();
    assert!(surface.edges.iter().all(|edge| !edge.facets.contains(&NONE)));
    let cells = mesh.groups.iter().flat_map(ElementGroup::outer_cells);
    let volume = |(_, cell): (usize, crate::mesh::cell::Cell<'_>)| {
        let places: Vec<Place> = cell.nodes.iter().map(|&node| mesh.positions[node as usize]).collect();
        let own = signed_volume(cell.kind, &places);
        assert!(own > 0.0);
        own
    };
    (surface, cells.map(volume).sum())
}

/// Area of the polygon of a circle.
fn dozen() -> f64 {
    3.0 * RADIUS * RADIUS
}

#[test]
fn a_rod_is_the_prism_of_its_section() {
    for (profile, area, corners, pieces) in
        [(round(), dozen(), 12, 12), (i(), 0.06 * 0.1 - 0.05 * 0.06, 16, 7), (flat(), 0.002, 6, 2), (some("given"), 0.0, 0, 0)]
    {
        let is_round = profile.shape == "round";
        let mesh = mesh(vec![vec![[0.1, 0.2, 0.3], [0.5, -0.4, 1.3]]], profile, 5);
        let long = length([0.4, -0.6, 1.0]);
        if pieces == 0 {
            assert!(mesh.skins.is_empty() && mesh.outside_without(&[], |_| false).unwrap().facets.is_empty());
            assert_eq!(mesh.groups[0].shown_cells_of(2).next().map(|cell| cell.nodes.len()), Some(2));
            continue;
        }
        let (surface, volume) = closed(&mesh);
        assert!((volume - area * long).abs() < 1e-14, "{volume} {}", area * long);
        assert_eq!(surface.facets.len(), 5 * corners + 2 * pieces);
        assert_eq!(mesh.skins.len(), 6 * (corners + usize::from(is_round)));
        assert_eq!((mesh.parts[0].faces.len(), mesh.bodies().into_iter().max()), (mesh.skins.len(), Some(0)));
        // Of the middle is none on the surface.
        assert!(surface.nodes.iter().all(|&node| node as usize >= mesh.first_skin_node()));
        for skin in &mesh.skins {
            let along = times(1.0 / long, [0.4, -0.6, 1.0]);
            assert!(dot(skin.arm, along).abs() < 1e-15);
            let size = length(skin.arm);
            assert!(!is_round || (size - RADIUS).abs() < 1e-15 || size == 0.0);
        }
        // What its faces lead is its middle.
        assert_eq!(mesh.nodes("part0").map(|nodes| nodes.len()), Some(6));
    }
}

#[test]
fn one_beam_continues_another_whichever_way_their_elements_run() {
    // Bent by 60 and by 30 degrees, out of the plane, too: a mitre keeps the volume along the axis.
    let [c, s] = cos_sin(PI / 3.0);
    let points = [[0.0; 3], [1.0, 0.0, 0.0], [1.0 + c, s, 0.0], [1.0 + c, s + 0.3, 0.9]];
    for profile in [round(), i(), flat()] {
        let area = if profile.shape == "i" {
            0.06 * 0.1 - 0.05 * 0.06
        } else if profile.shape == "round" {
            dozen()
        } else {
            0.002
        };
        let lines = [vec![vec![points[0], points[1]], vec![points[2], points[1]]], vec![points[..3].to_vec()]];
        for lines in lines {
            let mesh = mesh(lines, profile.clone(), 3);
            let (surface, volume) = closed(&mesh);
            let corners = if profile.shape == "round" { 12 } else { mesh.skins.len() / 7 };
            let caps = 2 * mesh.groups[0].outer_cells_of(0).count();
            assert_eq!((mesh.skins.len() / 7, surface.facets.len()), (corners + usize::from(caps == 24), 6 * corners + caps));
            assert!((volume - 2.0 * area).abs() < 1e-14, "{}: {volume}", profile.shape);
        }
    }
    let (_, volume) = closed(&mesh(vec![points.to_vec()], round(), 3));
    let long = 2.0 + length(minus(points[3], points[2]));
    // Polygons that are turned against each other there are a little less.
    assert!(volume < dozen() * long * (1.0 + 1e-12) && volume > 0.98 * dozen() * long, "{volume} {}", dozen() * long);
}

#[test]
fn a_ring_has_no_ends() {
    for (profile, corners) in [(round(), 12), (flat(), 6)] {
        let at = |k: usize| {
            let [c, s] = cos_sin(TAU * (k % 20) as f64 / 20.0);
            [c, s, 0.0]
        };
        let mesh = mesh(vec![(0..=20).map(at).collect()], profile, 1);
        let (surface, _) = closed(&mesh);
        assert_eq!(surface.facets.len(), 20 * corners);
        assert_eq!(surface.nodes.len() + surface.facets.len(), surface.edges.len());
    }
}

#[test]
fn beams_that_meet_have_ends_of_their_own_that_do_not_touch() {
    let lines = vec![vec![[-1.0, 0.0, 0.0], [0.0; 3], [1.0, 0.0, 0.0]], vec![[0.0; 3], [0.1, 1.0, 0.0]], vec![[0.0; 3], [0.0, 0.5, 0.7]]];
    // Elements of a fifth of the diameter, and of five diameters.
    for elements in [50, 2] {
        let mesh = mesh(lines.clone(), round(), elements);
        let (surface, volume) = closed(&mesh);
        assert_eq!(surface.facets.len(), 4 * elements * 12 + 8 * 12);
        let long = 2.0 + length([0.1, 1.0, 0.0]) + length([0.0, 0.5, 0.7]);
        assert!((volume - dozen() * long).abs() < 1e-13);
        let surface = surface.with_kin(&mesh.kin);
        let first = mesh.first_skin_node();
        let owner = |node: u32| mesh.positions[mesh.skins[node as usize - first].owner as usize];
        let near = |node: u32| length(owner(node)) < 1e-9;
        let at_joint: Vec<u32> = surface.nodes.iter().copied().filter(|&node| near(node)).collect();
        assert_eq!(at_joint.len(), 4 * 13);
        assert!(at_joint.iter().all(|&node| surface.are_kin(&[node], &at_joint[..1])));
        // Whatever of one beam is inside another does not touch it.
        for &node in &surface.nodes {
            for &other in &surface.nodes {
                let [a, b] = [node, other].map(owner);
                let unlike = length(minus(a, b)) > 1e-9 && dot(a, b) < 0.99 * length(a) * length(b);
                let overlap = unlike && length(minus(mesh.positions[node as usize], mesh.positions[other as usize])) < 0.02;
                assert!(!overlap || surface.are_kin(&[node], &[other]), "{a:?} {b:?}");
                assert!(!unlike || length(a) < 0.3 || length(b) < 0.3 || !surface.are_kin(&[node], &[other]), "{a:?} {b:?}");
            }
        }
    }
}

#[test]
fn short_elements_at_a_sharp_bend_do_not_fold() {
    for elements in [1, 10, 40, 100] {
        let corner = vec![vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]]];
        let (surface, volume) = closed(&mesh(corner, flat(), elements));
        assert_eq!(surface.facets.len(), 2 * elements * 6 + 4);
        assert!((volume / 0.004 - 1.0).abs() < 1e-2, "{volume}");
    }
    // Beyond 120 degrees each has its own end.
    let hairpin = vec![vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.5, 0.0]]];
    assert_eq!(closed(&mesh(hairpin, flat(), 4)).0.facets.len(), 8 * 6 + 8);
}

#[test]
fn a_beam_ends_on_a_symmetry_plane() {
    for end in [[1.0, 0.0, 0.0], [1.0, 0.5, 0.2]] {
        let mut model = model(&[(vec![vec![[0.0; 3], end]], round())], 4);
        model.symmetries.push(Symmetry { normal: [1.0, 0.0, 0.0], point: [0.0; 3], parts: Vec::new(), name: String::new() });
        let mesh = Mesh::<3>::new(&model).unwrap();
        let at_plane = mesh.skins.iter().filter(|skin| mesh.positions[skin.owner as usize] == [0.0; 3]);
        assert_eq!(at_plane.clone().count(), 13);
        assert!(at_plane.into_iter().all(|skin| skin.arm[0].abs() < 1e-16));
        closed(&mesh);
    }
}

#[test]
fn beams_along_shells_have_no_faces_and_those_that_end_on_them_belong_to_the_place() {
    let positions: Vec<Place> =
        (0..9).map(|k| [f64::from(k % 3), f64::from(k / 3), 0.0]).chain([[1.0, 1.0, 1.0], [1.0, 1.0, 2.0]]).collect();
    let quads = [0, 1, 3, 4].map(|k| vec![k, k + 1, k + 4, k + 3]).to_vec();
    let group = |name: &str, dimension: u8, cells: Vec<Vec<u32>>| MeshGroup { name: name.into(), dimension, cells };
    let groups = vec![
        group("plate", 2, quads),
        group("stiffener", 1, vec![vec![0, 1], vec![1, 2]]),
        group("strut", 1, vec![vec![4, 9], vec![9, 10]]),
    ];
    let source = ImportedMesh { source: "test".into(), positions, groups, ..ImportedMesh::default() };
    let of = |name: &str| Part { name: name.into(), shape: Shape::Group { mesh: 0, group: name.into() }, ..Part::default() };
    let beam = |name: &str| Part { element: "beam2".into(), profile: Some(round()), ..of(name) };
    let section = Some(ShellSection { thickness: 0.02, ..ShellSection::default() });
    let plate = Part { element: "shell4".into(), section, ..of("plate") };
    let parts = vec![plate, beam("stiffener"), beam("strut")];
    let mesh = Mesh::<3>::new(&Model { parts, meshes: vec![Arc::new(source)], ..Model::default() }).unwrap();
    let cells = |part: usize| mesh.groups_of(part).map(|group| group.outer_cells().count()).sum::<usize>();
    assert_eq!((cells(0), cells(1), cells(2)), (4, 0, 24));
    assert_eq!(mesh.groups_of(1).map(|group| group.shown_cells_of(0).count()).sum::<usize>(), 1);
    let surface = mesh.outside_without(&[], |_| false).unwrap().with_kin(&mesh.kin);
    let first = mesh.first_skin_node();
    let at = |place: Place| surface.nodes.iter().copied().filter(|&node| mesh_place(&mesh, node, first) == place).collect::<Vec<_>>();
    let (foot, head, corner) = (at([1.0, 1.0, 0.0]), at([1.0, 1.0, 2.0]), at([0.0; 3]));
    assert_eq!((foot.len(), head.len(), corner.len()), (2 + 13, 13, 2));
    assert!(
        foot.iter()
            .all(|&node| surface.are_kin(&[node], &foot[..1]) && !surface.are_kin(&[node], &head) && !surface.are_kin(&[node], &corner))
    );
}

fn mesh_place(mesh: &Mesh<3>, node: u32, first: usize) -> Place {
    mesh.positions[mesh.skins[node as usize - first].owner as usize]
}
