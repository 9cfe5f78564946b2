//! Contract tests of all kinds of cells. What they check against are the places of a reference cell's nodes,
//! not the tables of each other.

use super::*;
use std::collections::{BTreeMap, BTreeSet};

type Vector = [f64; 3];

/// A kind that no element has yet, to show that the facts have room for it: a pyramid.
const PYRAMID: Facts = Facts {
    name: "pyramid",
    plural: "pyramids",
    dimension: 3,
    nodes: 5,
    corners: 5,
    edges: &[[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [1, 4], [2, 4], [3, 4]],
    faces: &[[0, 3, 2, 1], [0, 1, 4, 4], [1, 2, 4, 4], [2, 3, 4, 4], [3, 0, 4, 4]],
    facets: &[[0, 3, 2, 1], [0, 1, 4, 4], [1, 2, 4, 4], [2, 3, 4, 4], [3, 0, 4, 4]],
    neighbours: &[&[1, 3, 4], &[2, 0, 4], &[3, 1, 4], &[0, 2, 4], &[0, 3, 2, 1]],
    symmetries: [[0, 1, 2, 3, 4], [1, 2, 3, 0, 4], [2, 3, 0, 1, 4], [3, 0, 1, 2, 4]].as_flattened(),
    reflection: &[0, 3, 2, 1, 4],
    axes: &[[&[0, 3], &[1, 2]], [&[0, 1], &[2, 3]], [&[0, 1, 2, 3], &[4]]],
    reference: &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.5, 1.0]],
    size: 1.0 / 3.0,
    extruded: None,
    division: &[],
    vtk: 14,
    gmsh: 7,
};

/// The facts of every kind, and of those that could be.
fn all() -> impl Iterator<Item = &'static Facts> {
    CellKind::ALL.into_iter().map(CellKind::facts).chain([&PYRAMID])
}

fn at(facts: &Facts, k: u8) -> Vector {
    facts.reference[usize::from(k)]
}

fn minus(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|d| a[d] - b[d])
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: Vector, b: Vector) -> f64 {
    (0..3).map(|d| a[d] * b[d]).sum()
}

/// Corners of a face, each once.
fn corners(face: &[u8; 4]) -> &[u8] {
    if face[2] == face[3] { &face[..3] } else { face }
}

/// Mean of some nodes.
fn centre(facts: &Facts, nodes: impl Iterator<Item = u8> + Clone) -> Vector {
    let count = nodes.clone().count() as f64;
    nodes.fold([0.0; 3], |sum, k| std::array::from_fn(|d| sum[d] + at(facts, k)[d] / count))
}

/// Directed edges of a closed row of corners.
fn around(corners: &[u8]) -> impl Iterator<Item = [u8; 2]> + '_ {
    (0..corners.len()).map(|k| [corners[k], corners[(k + 1) % corners.len()]])
}

/// The same edges whatever their directions, and faces whatever the corner at which they begin.
fn bounds(facts: &Facts, name: impl Fn(u8) -> u8) -> (BTreeSet<[u8; 2]>, BTreeSet<Vec<u8>>) {
    let edge = |&[a, b]: &[u8; 2]| [name(a).min(name(b)), name(a).max(name(b))];
    let face = |face: &[u8; 4]| {
        let mut corners: Vec<u8> = corners(face).iter().map(|&k| name(k)).collect();
        let lowest = (0..corners.len()).min_by_key(|&k| corners[k]).unwrap();
        corners.rotate_left(lowest);
        corners
    };
    (facts.edges.iter().map(edge).collect(), facts.faces.iter().map(face).collect())
}

#[test]
fn kinds_stand_in_order_and_have_their_own_numbers() {
    assert!(CellKind::ALL.is_sorted_by_key(|kind| (kind.dimension(), kind.nodes())) && CellKind::ALL.is_sorted());
    let distinct = |key: fn(&Facts) -> i64| all().map(key).collect::<BTreeSet<_>>().len() == all().count();
    assert!(distinct(|facts| facts.vtk.into()) && distinct(|facts| facts.gmsh));
    assert!(
        distinct(|facts| (100 * facts.dimension + facts.nodes) as i64),
        "a mesh file distinguishes them by dimension and number of nodes"
    );
    assert_eq!(all().map(|facts| facts.name).collect::<BTreeSet<_>>().len(), all().count());
    for kind in CellKind::ALL {
        assert_eq!(CellKind::of(kind.dimension(), kind.nodes()), Some(kind));
        assert_eq!((CellKind::of_vtk(kind.facts().vtk), CellKind::of_gmsh(kind.facts().gmsh)), (Some(kind), Some(kind)));
    }
    assert_eq!((CellKind::of(3, 5), CellKind::of_vtk(14), CellKind::of_gmsh(7)), (None, None, None));
    assert_eq!(MOST_NODES, 10);
}

#[test]
fn numbers_of_corners_edges_and_faces_are_those_of_euler() {
    for facts in all() {
        assert!(facts.corners <= facts.nodes && facts.reference.len() == facts.nodes, "{}", facts.name);
        let count = facts.corners as i64 - facts.edges.len() as i64 + facts.faces.len() as i64;
        assert_eq!(count, if facts.dimension == 3 { 2 } else { 1 }, "{}", facts.name);
        let used: BTreeSet<u8> = facts.edges.iter().flatten().copied().collect();
        assert!(facts.dimension == 0 || used == (0..facts.corners as u8).collect(), "{}", facts.name);
    }
}

#[test]
fn the_boundary_is_closed_every_edge_of_a_volume_is_met_by_two_faces_once_in_each_direction() {
    for facts in all().filter(|facts| facts.dimension > 1) {
        let directed: Vec<[u8; 2]> = facts.faces.iter().flat_map(|face| around(corners(face))).collect();
        for &[a, b] in facts.edges {
            let times = |edge| directed.iter().filter(|other| **other == edge).count();
            // The edges of a surface run around it.
            assert_eq!([times([a, b]), times([b, a])], [1, usize::from(facts.dimension == 3)], "{} {a}-{b}", facts.name);
        }
        assert_eq!(directed.len(), facts.edges.len() * (facts.dimension - 1), "{}", facts.name);
    }
}

#[test]
fn the_size_is_that_of_the_divergence_theorem_and_faces_look_outwards() {
    for facts in all() {
        let triangles = |face: &'static [u8; 4]| {
            let [a, b, c, d] = face.map(|k| at(facts, k));
            [[a, b, c], [a, c, d]]
        };
        let all_nodes = centre(facts, 0..facts.corners as u8);
        let size = match facts.dimension {
            0 => 1.0,
            1 => dot(at(facts, 1), at(facts, 1)).sqrt(),
            // ∮ (x dy − y dx) / 2 along the sides.
            2 => facts.edges.iter().map(|edge| edge.map(|k| at(facts, k))).map(|[p, q]| 0.5 * cross(p, q)[2]).sum(),
            // ∮ x · n dA / 3 over the faces.
            _ => facts.faces.iter().flat_map(triangles).map(|[a, b, c]| dot(a, cross(b, c)) / 6.0).sum(),
        };
        assert!((size - facts.size).abs() < 1e-15, "{} {size}", facts.name);
        for [a, b, c] in facts.faces.iter().flat_map(triangles).filter(|[_, b, c]| b != c) {
            let normal = cross(minus(b, a), minus(c, a));
            assert!(if facts.dimension == 3 { dot(normal, minus(a, all_nodes)) > 0.0 } else { normal[2] > 0.0 }, "{}", facts.name);
        }
    }
}

#[test]
fn neighbours_are_the_other_ends_of_the_edges_in_right_handed_order() {
    for facts in all() {
        assert_eq!(facts.neighbours.len(), facts.corners);
        for (corner, neighbours) in (0..).zip(facts.neighbours) {
            let ends = facts.edges.iter().filter(|edge| edge.contains(&corner)).map(|[a, b]| if *a == corner { *b } else { *a });
            assert_eq!(ends.collect::<BTreeSet<u8>>(), neighbours.iter().copied().collect(), "{} {corner}", facts.name);
            let edge = |k: usize| minus(at(facts, neighbours[k % neighbours.len()]), at(facts, corner));
            let is_positive = |k: usize| dot(edge(k), cross(edge(k + 1), edge(k + 2))) > 0.0;
            match facts.dimension {
                2 => assert!(cross(edge(0), edge(1))[2] > 0.0, "{} {corner}", facts.name),
                3 => assert!((0..neighbours.len()).all(is_positive), "{} {corner}", facts.name),
                _ => {}
            }
        }
        // The unit vectors from the first corner, but to the apex of a pyramid.
        let units = facts.neighbours[0].iter().zip(0..).filter(|(k, d)| (0..3).all(|j| at(facts, **k)[j] == f64::from(u8::from(j == *d))));
        assert_eq!(units.count(), if facts.name == "pyramid" { 2 } else { facts.dimension });
    }
}

#[test]
fn symmetries_keep_edges_faces_and_orientation_and_are_all_that_do() {
    for facts in all().filter(|facts| facts.nodes == facts.corners) {
        let ways: BTreeSet<&[u8]> = facts.symmetries.chunks_exact(facts.nodes).collect();
        assert_eq!(ways.len() * facts.nodes, facts.symmetries.len());
        assert!(facts.symmetries[..facts.nodes].iter().copied().eq(0..facts.nodes as u8), "the first is the identity");
        let own = bounds(facts, |k| k);
        for way in &ways {
            assert_eq!(way.iter().copied().collect::<BTreeSet<u8>>().len(), facts.nodes);
            assert_eq!(bounds(facts, |k| way[usize::from(k)]), own, "{} {way:?}", facts.name);
        }
        // By trying all numberings: faces with their orientation are kept by no others.
        let mut found = 0;
        let mut all: Vec<Vec<u8>> = vec![Vec::new()];
        for _ in 0..facts.nodes {
            let further =
                |way: Vec<u8>| (0..facts.nodes as u8).filter(|k| !way.contains(k)).map(|k| [&way[..], &[k]].concat()).collect::<Vec<_>>();
            all = all.into_iter().flat_map(further).collect();
        }
        for way in all {
            found += usize::from(bounds(facts, |k| way[usize::from(k)]) == own);
        }
        assert_eq!(found, ways.len(), "{}", facts.name);
    }
}

#[test]
fn symmetries_of_nodes_between_corners_follow_the_corners() {
    // Each node in the middle of an edge stays in the middle of the same corners.
    for facts in all().filter(|facts| facts.nodes > facts.corners) {
        let between = |k: usize| facts.edges[k - facts.corners];
        for way in facts.symmetries.chunks_exact(facts.nodes).chain([facts.reflection]) {
            for k in facts.corners..facts.nodes {
                let moved = between(k).map(|corner| way[usize::from(corner)]).into_iter().collect::<BTreeSet<_>>();
                assert_eq!(moved, between(usize::from(way[k])).into_iter().collect(), "{way:?}");
            }
        }
        // Of its corners the same numberings as without those nodes.
        let of_corners = |facts: &'static Facts| facts.symmetries.chunks_exact(facts.nodes).map(|way| &way[..facts.corners]);
        let plain = if facts.dimension == 2 { &TRIANGLE } else { &TETRAHEDRON };
        assert!(of_corners(facts).eq(of_corners(plain)), "{}", facts.name);
    }
}

#[test]
fn nodes_between_corners_are_in_the_middles_of_edges_and_facets_cover_the_faces() {
    for facts in all() {
        for (middle, [a, b]) in (facts.corners as u8..facts.nodes as u8).zip(facts.edges) {
            let centre = centre(facts, [*a, *b].into_iter());
            assert_eq!(at(facts, middle), centre, "{}", facts.name);
        }
        let area = |facet: &[u8; 4]| {
            let [a, b, c, d] = facet.map(|k| at(facts, k));
            let halves = [cross(minus(b, a), minus(c, a)), cross(minus(c, a), minus(d, a))];
            std::array::from_fn::<f64, 3, _>(|k| 0.5 * (halves[0][k] + halves[1][k]))
        };
        let each = facts.facets.len() / facts.faces.len().max(1);
        assert_eq!(each * facts.faces.len(), facts.facets.len());
        for (face, facets) in facts.faces.iter().zip(facts.facets.chunks_exact(each.max(1))) {
            let sum = facets.iter().map(area).fold([0.0; 3], |sum, own| std::array::from_fn(|k| sum[k] + own[k]));
            assert!((0..3).all(|k| (sum[k] - area(face)[k]).abs() < 1e-15), "{}: {face:?}", facts.name);
            assert!(facets.iter().all(|facet| dot(area(facet), area(face)) > 0.0), "{}: {face:?}", facts.name);
        }
        let nodes: Vec<u32> = (0..facts.nodes as u32).collect();
        if let Some(kind) = CellKind::ALL.into_iter().find(|kind| kind.facts().name == facts.name && facts.nodes > 4) {
            let (cell, is_simplex) = (kind.cell(&nodes), facts.dimension == 3 && facts.corners == 4);
            assert_eq!(cell.pieces_of_edges().count(), facts.edges.len() + facts.nodes - facts.corners);
            for facet in cell.facets().filter(|_| is_simplex) {
                let [a, b, c, _] = facet.map(|node| at(facts, node as u8));
                let away = minus(at(facts, cell.beyond(&facet).unwrap() as u8), a);
                assert!((dot(cross(minus(b, a), minus(c, a)), away).abs() - 0.25).abs() < 1e-15, "as far as the corner opposite");
            }
        }
        // Between facets of a volume each edge lies twice, once in each direction.
        if facts.dimension == 3 {
            let mut directed: Vec<[u8; 2]> = facts.facets.iter().flat_map(|facet| around(corners(facet))).collect();
            let mut other: Vec<[u8; 2]> = directed.iter().map(|&[a, b]| [b, a]).collect();
            directed.sort_unstable();
            other.sort_unstable();
            assert!(directed == other && directed.windows(2).all(|pair| pair[0] != pair[1]), "{}", facts.name);
        }
    }
}

#[test]
fn a_reflection_is_its_own_inverse_turns_every_face_over_and_keeps_the_first_node() {
    for facts in all() {
        let reflected = |k: u8| facts.reflection[usize::from(k)];
        assert!((0..facts.nodes as u8).all(|k| reflected(reflected(k)) == k) && reflected(0) == 0, "{}", facts.name);
        let (edges, faces) = bounds(facts, reflected);
        let turned = |face: &Vec<u8>| {
            let mut face = face.clone();
            face[1..].reverse();
            face
        };
        assert_eq!((edges, faces.iter().map(turned).collect()), bounds(facts, |k| k), "{}", facts.name);
    }
}

#[test]
fn axes_are_the_unit_vectors_of_the_reference_cell() {
    for facts in all() {
        assert_eq!(facts.axes.len(), facts.dimension);
        for (d, [from, to]) in facts.axes.iter().enumerate() {
            let axis = minus(centre(facts, to.iter().copied()), centre(facts, from.iter().copied()));
            assert!((0..3).all(|k| (axis[k] - f64::from(u8::from(k == d))).abs() < 1e-15), "{} {axis:?}", facts.name);
        }
    }
}

#[test]
fn an_extruded_cell_has_the_size_of_its_section_and_is_not_turned_over() {
    for facts in CellKind::ALL.into_iter().map(CellKind::facts) {
        let Some(extruded) = facts.extruded.map(CellKind::facts) else { continue };
        assert_eq!((extruded.dimension, extruded.nodes), (facts.dimension + 1, 2 * facts.nodes));
        let ends = facts.reference.iter().map(|x| (x, 0.0)).chain(facts.reference.iter().map(|x| (x, 1.0)));
        let places = ends.map(|(x, height)| std::array::from_fn(|d| if d == facts.dimension { height } else { x[d] }));
        assert_eq!(places.collect::<Vec<Vector>>(), extruded.reference);
        assert_eq!(extruded.size, facts.size);
    }
}

#[test]
fn a_square_and_a_cube_are_divided_without_gap_or_overlap() {
    for facts in CellKind::ALL.into_iter().map(CellKind::facts).filter(|facts| !facts.division.is_empty()) {
        let whole = if facts.dimension == 2 { &QUADRILATERAL } else { &HEXAHEDRON };
        // Pieces inside meet in pairs, in opposite directions; what is left bounds the whole.
        let mut pieces: BTreeMap<BTreeSet<u8>, i32> = BTreeMap::new();
        let mut volume = 0.0;
        for cell in facts.division.chunks_exact(facts.corners) {
            let name = |k: u8| cell[usize::from(k)];
            let flux = |face: Vec<u8>| {
                let x: Vec<Vector> = face.iter().map(|&k| at(whole, k)).collect();
                if facts.dimension == 2 {
                    return 0.5 * cross(x[0], x[1])[2];
                }
                (1..x.len() - 1).map(|k| dot(x[0], cross(x[k], x[k + 1])) / 6.0).sum()
            };
            let sides: Vec<Vec<u8>> = if facts.dimension == 2 {
                facts.edges.iter().map(|edge| edge.iter().map(|&k| name(k)).collect()).collect()
            } else {
                facts.faces.iter().map(|face| corners(face).iter().map(|&k| name(k)).collect()).collect()
            };
            let own: f64 = sides.iter().cloned().map(flux).sum();
            assert!((own - whole.size * facts.corners as f64 / facts.division.len() as f64).abs() < 1e-15, "{}", facts.name);
            volume += own;
            sides.into_iter().for_each(|side| *pieces.entry(side.into_iter().collect()).or_default() += 1);
        }
        assert!((volume - whole.size).abs() < 1e-15, "{}", facts.name);
        for (piece, times) in pieces {
            let is_outside =
                (0..3).any(|d| [0.0, 1.0].iter().any(|end| facts.dimension > d && piece.iter().all(|&k| at(whole, k)[d] == *end)));
            assert_eq!(times, if is_outside { 1 } else { 2 }, "{} {piece:?}", facts.name);
        }
    }
}

#[test]
fn however_its_nodes_are_numbered_a_cell_becomes_the_same() {
    for kind in CellKind::ALL {
        let mixed: Vec<u32> = (0..kind.nodes() as u32).map(|k| (5 * k + 3) % 11).collect();
        let begun = |way: &[u8]| {
            let mut nodes: Vec<u32> = way.iter().map(|&k| mixed[usize::from(k)]).collect();
            kind.begin_with_lowest(&mut nodes);
            nodes
        };
        let all: BTreeSet<Vec<u32>> = kind.symmetries().map(begun).collect();
        assert_eq!(all.len(), 1, "{kind:?}");
        assert!(all.iter().all(|nodes| nodes[0] == *mixed[..kind.corners()].iter().min().unwrap()), "{kind:?}");
        let mut twice = mixed.clone();
        kind.reflect(&mut twice);
        kind.reflect(&mut twice);
        assert_eq!(twice, mixed);
    }
}

#[test]
fn a_shell_lies_beside_a_solid_with_as_many_nodes() {
    let nodes = [0, 1, 2, 3];
    let [shell, solid] = [CellKind::Quadrilateral, CellKind::Tetrahedron].map(|kind| kind.cell(&nodes));
    assert_eq!((shell.kind.nodes(), shell.facets().count()), (solid.kind.nodes(), 1));
    assert_eq!((solid.facets().count(), shell.edges().count(), solid.edges().count()), (4, 4, 6));
    assert!(shell != solid && !shell.is_collapsed() && CellKind::Triangle.cell(&[4, 2, 4]).is_collapsed());
}
