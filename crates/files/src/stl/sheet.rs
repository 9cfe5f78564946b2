//! A triangulated surface as the mesh of a shell: corners that are near each other are one node, and what is
//! no surface is a fault.
//!
//! Groups of the mesh are [`ALL`], its triangles, and [`RIM`], the edges that belong to one triangle alone.

use super::messages::SHEET;
use embate_solver::error::Fault;
use embate_solver::forest;
use embate_solver::model::{ImportedMesh, MeshGroup};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

/// The group of all triangles.
const ALL: &str = "all";
/// The group of open edges.
const RIM: &str = "rim";
/// Distance within which corners are one node, as a fraction of the extent of the surface, where nothing else
/// is asked for: single precision writes its coordinates to 6e-8.
const NEAR: f64 = 1e-6;
/// At most so many faults of one kind are reported one by one.
const REPORTED_MAX: usize = 20;

type Triangle = [u32; 3];

/// The mesh of triangles given by their corners, m; `tolerance` is the distance (m) within which corners are
/// one node. Triangles of which two corners are one node are left out: their neighbours meet there.
///
/// # Errors
/// Triangles that are there twice, and edges along which both of their triangles run in the same direction,
/// so that one looks to the other side.
pub(super) fn mesh(source: &str, corners: &[[[f64; 3]; 3]], tolerance: Option<f64>) -> Result<ImportedMesh, Vec<Fault>> {
    let places: Vec<[f64; 3]> = corners.iter().flatten().copied().collect();
    let (numbers, positions) = welded(&places, tolerance.unwrap_or(NEAR * extent(&places)));
    // With their numbers in the file, from 1.
    let all = (1..).zip(numbers.as_chunks::<3>().0.iter().copied());
    let triangles: Vec<(usize, Triangle)> = all.filter(|(_, [a, b, c])| a != b && b != c && c != a).collect();
    let mut faults = repeated(&triangles, &positions);
    if triangles.is_empty() {
        let message = "all triangles are points or lines: corners are nearer to each other than the tolerance";
        faults.push(Fault::new(&SHEET, "", message, "give the `scale` of the file, or a smaller `tolerance`"));
    }
    let rim = if faults.is_empty() { rim(&triangles, &positions, &mut faults) } else { Vec::new() };
    if !faults.is_empty() {
        return Err(faults);
    }
    let cells = triangles.iter().map(|(_, nodes)| nodes.to_vec()).collect();
    let mut groups = vec![MeshGroup { name: ALL.into(), dimension: 2, cells }];
    if !rim.is_empty() {
        groups.push(MeshGroup { name: RIM.into(), dimension: 1, cells: rim });
    }
    Ok(ImportedMesh { source: source.into(), positions, groups, ..ImportedMesh::default() })
}

/// Longest side of the box around places.
fn extent(places: &[[f64; 3]]) -> f64 {
    let along = |d: usize| {
        let ends = places.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x[d]), high.max(x[d])]);
        ends[1] - ends[0]
    };
    (0..3).map(along).fold(0.0, f64::max)
}

/// The node of each place, and where nodes are: the first place of each that is within the distance of
/// another one of it.
fn welded(places: &[[f64; 3]], distance: f64) -> (Vec<u32>, Vec<[f64; 3]>) {
    let side = if distance > 0.0 { distance } else { f64::MIN_POSITIVE };
    // Zero has one sign.
    let cell = |x: &[f64; 3]| if distance > 0.0 { x.map(|c| ((c / side).floor() + 0.0).to_bits()) } else { x.map(|c| (c + 0.0).to_bits()) };
    let mut cells: BTreeMap<[u64; 3], Vec<u32>> = BTreeMap::new();
    let mut leader: Vec<u32> = (0..places.len() as u32).collect();
    let is_near = |a: u32, b: u32| {
        let [a, b] = [a, b].map(|place| places[place as usize]);
        (0..3).map(|d| (a[d] - b[d]).powi(2)).sum::<f64>() <= distance * distance
    };
    for (place, x) in (0..).zip(places) {
        for offset in 0..if distance > 0.0 { 27 } else { 1 } {
            let beside: [f64; 3] = std::array::from_fn(|d| x[d] + side * f64::from(offset / [1, 3, 9][d] % 3 - 1));
            let key = if distance > 0.0 { cell(&beside) } else { cell(x) };
            for &other in cells.get(&key).into_iter().flatten() {
                if is_near(place, other) {
                    forest::join(&mut leader, place, other);
                }
            }
        }
        // One place of each kind is enough.
        let own = cells.entry(cell(x)).or_default();
        if own.iter().all(|&other| places[other as usize] != *x) {
            own.push(place);
        }
    }
    let (mut numbers, mut positions, mut number) = (Vec::with_capacity(places.len()), Vec::new(), vec![u32::MAX; places.len()]);
    for place in 0..places.len() as u32 {
        let first = forest::root(&mut leader, place) as usize;
        if number[first] == u32::MAX {
            number[first] = positions.len() as u32;
            positions.push(places[first].map(|c| c + 0.0));
        }
        numbers.push(number[first]);
    }
    (numbers, positions)
}

fn at(x: [f64; 3]) -> String {
    format!("({:.6e}, {:.6e}, {:.6e}) m", x[0], x[1], x[2])
}

/// At most so many of these faults, and how many more there are.
fn some(all: Vec<Fault>, what: &str) -> Vec<Fault> {
    let more = all.len().saturating_sub(REPORTED_MAX);
    let rest = (more > 0).then(|| Fault::new(&SHEET, "", format!("and {more} more {what}"), ""));
    all.into_iter().take(REPORTED_MAX).chain(rest).collect()
}

/// Triangles with the same nodes.
fn repeated(triangles: &[(usize, Triangle)], positions: &[[f64; 3]]) -> Vec<Fault> {
    let mut first: BTreeMap<Triangle, usize> = BTreeMap::new();
    let mut faults = Vec::new();
    for &(number, nodes) in triangles {
        let mut key = nodes;
        key.sort_unstable();
        match first.entry(key) {
            Entry::Vacant(entry) => {
                entry.insert(number);
            }
            Entry::Occupied(entry) => {
                let message = format!("triangle {number} lies on triangle {} at {}", entry.get(), at(positions[nodes[0] as usize]));
                let help = "remove one of them in the program that made the file; of a sheet it needs the middle, not both faces";
                faults.push(Fault::new(&SHEET, "", message, help));
            }
        }
    }
    some(faults, "triangles that lie on others")
}

/// Edges of one triangle alone; two triangles that run along an edge in the same direction are a fault, three
/// and more are a joint.
fn rim(triangles: &[(usize, Triangle)], positions: &[[f64; 3]], faults: &mut Vec<Fault>) -> Vec<Vec<u32>> {
    let mut edges: BTreeMap<[u32; 2], Vec<(usize, bool)>> = BTreeMap::new();
    for &(number, [a, b, c]) in triangles {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            edges.entry([from.min(to), from.max(to)]).or_default().push((number, from < to));
        }
    }
    let mut turned = Vec::new();
    for (edge, own) in &edges {
        if let [(one, along), (other, same)] = own[..]
            && along == same
        {
            let message =
                format!("triangles {one} and {other} look to different sides of the surface, at {}", at(positions[edge[0] as usize]));
            let help = "make the normals consistent in the program that made the file: each triangle counter-clockwise from one side";
            turned.push(Fault::new(&SHEET, "", message, help));
        }
    }
    faults.extend(some(turned, "pairs of triangles that look to different sides"));
    edges.iter().filter(|(_, own)| own.len() == 1).map(|(edge, _)| edge.to_vec()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of two triangles in the plane z = 0, and a third one on its edge x = 1.
    const SQUARE: [[[f64; 3]; 3]; 3] = [
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]],
        [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, -0.0]],
        [[1.0, 0.0, 0.0], [2.0, 0.0, 1.0], [1.0, 1.0, 0.0]],
    ];

    fn reported(corners: &[[[f64; 3]; 3]], tolerance: Option<f64>) -> Vec<String> {
        mesh("a.stl", corners, tolerance).unwrap_err().into_iter().map(|fault| format!("{} {}", fault.kind.code, fault.message)).collect()
    }

    #[test]
    fn corners_that_are_near_each_other_are_one_node() {
        let whole = mesh("a.stl", &SQUARE, None).unwrap();
        assert_eq!((whole.positions.len(), whole.groups[0].cells.len(), whole.groups[1].cells.len()), (5, 3, 5));
        assert_eq!((whole.groups[0].name.as_str(), whole.groups[1].name.as_str(), whole.groups[1].dimension), ("all", "rim", 1));
        assert_eq!(whole.groups[0].cells, [[0, 1, 2], [0, 2, 3], [1, 4, 2]]);
        // Off by less than a millionth of the extent, across a border of the cells that they are sought in.
        for off in [1e-6, -1e-6] {
            let mut near = SQUARE;
            near[2][0] = [1.0 + off, 0.0, off];
            assert_eq!(mesh("a.stl", &near, None).unwrap(), whole, "{off}");
            // The first place counts; with another tolerance there is a gap.
            let apart = mesh("a.stl", &near, Some(1e-8)).unwrap();
            assert_eq!((apart.positions.len(), apart.groups[1].cells.len()), (6, 7));
            assert_eq!(mesh("a.stl", &near, Some(0.0)).unwrap(), apart);
        }
    }

    #[test]
    fn triangles_that_collapse_are_left_out_and_a_closed_surface_has_no_rim() {
        // The third is as good as its edge.
        let mut thin = SQUARE;
        thin[2][1] = [1.0, 0.0, 1e-9];
        assert_eq!(mesh("a.stl", &thin, None).unwrap().groups[0].cells.len(), 2);
        assert!(reported(&SQUARE, Some(10.0))[0].starts_with("E0241 all triangles are points or lines"));
        let x = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let die = [[x[0], x[2], x[1]], [x[0], x[1], x[3]], [x[1], x[2], x[3]], [x[2], x[0], x[3]]];
        let closed = mesh("a.stl", &die, None).unwrap();
        assert_eq!((closed.positions.len(), closed.groups.len()), (4, 1));
    }

    #[test]
    fn triangles_that_look_to_different_sides_or_lie_on_each_other_are_reported() {
        let mut turned = SQUARE;
        turned[1].swap(1, 2);
        assert_eq!(
            reported(&turned, None),
            ["E0241 triangles 1 and 2 look to different sides of the surface, at (0.000000e0, 0.000000e0, 0.000000e0) m"]
        );
        let twice = [SQUARE[0], SQUARE[1], SQUARE[0]];
        assert_eq!(reported(&twice, None), ["E0241 triangle 3 lies on triangle 1 at (0.000000e0, 0.000000e0, 0.000000e0) m"]);
        let many: Vec<[[f64; 3]; 3]> = std::iter::repeat_n(SQUARE[0], 30).collect();
        assert_eq!(
            (reported(&many, None).len(), reported(&many, None).last().map(String::as_str)),
            (21, Some("E0241 and 9 more triangles that lie on others"))
        );
        // Three sheets at one edge are a joint, whatever their directions.
        let joint = [SQUARE[0], SQUARE[2], [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 3.0]]];
        assert!(mesh("a.stl", &joint, None).is_ok());
    }
}
