//! What sound decks become.

use super::{FLAT, group, read};
use embate_files::abaqus;
use std::fs;
use std::path::Path;

#[test]
fn elements_sets_and_surfaces_become_groups() {
    let mesh = read(FLAT).unwrap();
    assert_eq!(mesh.positions.len(), 7, "the node of no element is left out");
    assert_eq!(mesh.positions[1], [1.0, 0.0, 0.0]);
    assert_eq!(group(&mesh, "Squares").cells, [vec![0, 1, 4, 3], vec![1, 2, 5, 4]]);
    assert_eq!(group(&mesh, "the triangle").cells, [vec![2, 6, 5]]);
    assert_eq!(group(&mesh, "both").cells, [vec![0, 1, 4, 3], vec![2, 6, 5]]);
    assert_eq!(group(&mesh, "everything").cells.len(), 3);
    assert_eq!(group(&mesh, "top").cells, [vec![4, 3], vec![5, 4]]);
    assert_eq!(group(&mesh, "outside").cells.len(), 7, "the free edges of all elements");
    assert_eq!((group(&mesh, "left").dimension, &group(&mesh, "left").cells), (0, &vec![vec![0], vec![3]]));
    assert_eq!(group(&mesh, "left-nodes").cells, [vec![0], vec![3]], "a node set whose name a surface has");
    assert_eq!(group(&mesh, "even").cells, [vec![1], vec![3], vec![5]]);
    assert_eq!(group(&mesh, "of squares").cells.len(), 6);
    assert_eq!(group(&mesh, "all nodes").cells.len(), 7);
    assert!(mesh.groups.iter().all(|group| group.name != "rigid"));
}

#[test]
fn clockwise_elements_are_turned_and_their_edges_keep_their_numbers() {
    let mesh = read("*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n*ELEMENT,TYPE=CPS4,ELSET=E\n1,1,4,3,2\n*SURFACE,NAME=S\nE,S1\n").unwrap();
    assert_eq!(group(&mesh, "E").cells, [vec![0, 1, 2, 3]]);
    assert_eq!(group(&mesh, "S").cells, [vec![0, 3]]);
}

#[test]
fn a_deck_without_element_sets_is_one_group() {
    let mesh = read("*NODE\n1,0,0\n2,1,0\n3,1,1\n*ELEMENT,TYPE=CAX3\n1,1,2,3\n").unwrap();
    assert_eq!(mesh.groups.iter().map(|group| group.name.as_str()).collect::<Vec<_>>(), ["all"]);
}

#[test]
fn instances_are_put_in_place_and_name_their_sets() {
    let deck = "*Part, name=Bar
*Node
 1, 0., 0.
 2, 1., 0.
 3, 1., 1.
 4, 0., 1.
*Element, type=CPE4
 1, 1, 2, 3, 4
*Elset, elset=Body
 1
*Surface, name=End
 Body, S2
*End Part
*Assembly, name=A
*Instance, name=One, part=BAR
*End Instance
*Instance, name=Two, part=bar
 3., 0., 0.
 3., 0., 0., 3., 0., 1., 90.
*End Instance
*Nset, nset=corner, instance=Two
 1
*Nset, nset=pair
 One.1, Two.2
*Surface, name=Ends
 one.body, S2
 Two.BODY, S4
*End Assembly
";
    let mesh = read(deck).unwrap();
    let plane = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [3.0, 0.0], [3.0, 1.0], [2.0, 1.0], [2.0, 0.0]];
    assert_eq!(mesh.positions, plane.map(|[x, y]| [x, y, 0.0]));
    assert_eq!(group(&mesh, "Two.Body").cells, [vec![4, 5, 6, 7]]);
    assert_eq!(group(&mesh, "One.End").cells, [vec![1, 2]]);
    assert_eq!(group(&mesh, "corner").cells, [vec![4]]);
    assert_eq!(group(&mesh, "pair").cells, [vec![0], vec![5]]);
    assert_eq!(group(&mesh, "Ends").cells, [vec![1, 2], vec![7, 4]]);
}

#[test]
fn included_files_are_read_from_the_folder_of_the_file_that_includes() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("inp-include");
    fs::create_dir_all(folder.join("inner")).unwrap();
    fs::write(folder.join("d.inp"), "*INCLUDE, INPUT=inner/nodes.inp\n*ELEMENT, TYPE=CPE3\n1, 1, 2, 3\n").unwrap();
    fs::write(folder.join("inner/nodes.inp"), "*NODE\n*Include, input=\"more nodes.inp\"\n3, 0, 1\n").unwrap();
    fs::write(folder.join("inner/more nodes.inp"), "1, 0, 0\n2, 1, 0\n").unwrap();
    assert_eq!(abaqus::read(&folder.join("d.inp"), 1e-3).unwrap().positions, [[0.0; 3], [1e-3, 0.0, 0.0], [0.0, 1e-3, 0.0]]);
    fs::write(folder.join("self.inp"), "*INCLUDE, INPUT=self.inp\n").unwrap();
    let faults = abaqus::read(&folder.join("self.inp"), 1.0).unwrap_err();
    assert!(faults[0].message.contains("more than 16 deep"), "{}", faults[0]);
}
