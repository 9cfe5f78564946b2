//! From the contents of a .msh file to a plane mesh: groups and their names, dense node numbers, and every check that needs more than one line.
//!
//! [`super::parse`] calls [`mesh`] once the whole file is read; what comes out goes into the model.

use super::contents::{Contents, FileCell, FileNode, GroupKey, Occurrence};
use super::faults::Faults;
use super::reader::Reader;
use crate::gmsh::messages::{CELL, ELEMENT_TYPE, NODE, PHYSICAL_GROUP};
use embate_solver::error::Fault;
use embate_solver::model::{ImportedMesh, MeshGroup};
use std::collections::BTreeMap;

/// Distance from the plane z = 0, as a fraction of the mesh's size, that still counts as on it.
const OFF_PLANE: f64 = 1e-9;
/// Area, as a fraction of the square of an element's longest diagonal or side, below which it counts as none.
const NO_AREA: f64 = 1e-12;
const AGAIN: &str = "the file is damaged; export the mesh again";

/// The mesh that `contents` describes; positions are multiplied by `scale`.
pub(super) fn mesh(contents: &Contents, reader: &Reader, scale: f64) -> Result<ImportedMesh, Vec<Fault>> {
    let source = reader.source();
    let mut faults = Faults::default();
    let groups = groups(contents, reader, &mut faults);
    let index = NodeIndex::new(&contents.nodes, reader, &mut faults);
    let resolved: Vec<Vec<Cell>> = groups.iter().map(|group| resolve(group, &index, reader, &mut faults)).collect();
    if !faults.is_empty() {
        return Err(faults.into_list(source));
    }
    let mut used = vec![false; contents.nodes.len()];
    for cell in resolved.iter().flatten().filter(|cell| cell.file.kind.dimension == 2) {
        cell.nodes().iter().for_each(|&node| used[node as usize] = true);
    }
    let nodes = Nodes::new(contents, &used, scale);
    nodes.check(reader, &mut faults);
    for (group, cells) in groups.iter().zip(&resolved) {
        let mut check = Check { group: &group.name, nodes: &nodes, reader, faults: &mut faults };
        cells.iter().for_each(|cell| check.cell(cell));
        check.repeated(cells);
    }
    if !faults.is_empty() {
        return Err(faults.into_list(source));
    }
    Ok(nodes.mesh(source, &groups, &resolved))
}

/// A physical group with the name that the model knows it by.
struct Group<'a> {
    name: String,
    dimension: u8,
    cells: &'a [FileCell],
}

fn name_of(contents: &Contents, key: GroupKey) -> String {
    contents.names.get(&key).cloned().unwrap_or_else(|| {
        let (dimension, tag) = key;
        format!("{}-{tag}", ["point", "curve", "surface", "volume"].get(usize::from(dimension)).unwrap_or(&"group"))
    })
}

/// The groups that have elements, by dimension and tag.
fn groups<'a>(contents: &'a Contents, reader: &Reader, faults: &mut Faults) -> Vec<Group<'a>> {
    let grouped = !contents.names.is_empty() || !contents.groups.is_empty() || contents.foreign.keys().any(|(group, _)| group.is_some());
    for ((group, _), occurrence) in &contents.foreign {
        match group {
            Some(key) => faults.add("element types that can't be computed", || foreign(reader, &name_of(contents, *key), occurrence)),
            None if !grouped && occurrence.kind.dimension >= 2 => {
                faults.add("element types that can't be computed", || foreign(reader, "all", occurrence));
            }
            None => {}
        }
    }
    let groups: Vec<_> = if grouped {
        contents.groups.iter().map(|(&key, cells)| Group { name: name_of(contents, key), dimension: key.0, cells }).collect()
    } else if contents.ungrouped.is_empty() {
        Vec::new()
    } else {
        vec![Group { name: "all".into(), dimension: 2, cells: &contents.ungrouped }]
    };
    if faults.is_empty() && !groups.iter().any(|group| group.dimension == 2) {
        let (message, help) = if grouped {
            let help = "in Gmsh, put the surfaces of each body into a physical group (Physical Surface(\"body\") = {...};) and mesh in two dimensions";
            ("no triangle or quadrilateral belongs to a physical group", help)
        } else {
            ("the file holds no triangles or quadrilaterals", "in Gmsh, mesh in two dimensions before saving")
        };
        faults.add("meshes without surfaces", || Fault::new(&PHYSICAL_GROUP, reader.source(), message, help));
    }
    let mut first: BTreeMap<&str, u8> = BTreeMap::new();
    for group in &groups {
        if let Some(other) = first.insert(&group.name, group.dimension) {
            let message = format!("two physical groups are named {:?}, of dimensions {other} and {}", group.name, group.dimension);
            faults.add("names of two groups", || Fault::new(&PHYSICAL_GROUP, reader.source(), message, "rename one of them in Gmsh"));
        }
    }
    groups
}

fn foreign(reader: &Reader, group: &str, occurrence: &Occurrence) -> Fault {
    let Occurrence { kind, count, first } = occurrence;
    let elements = if *count == 1 { "element" } else { "elements" };
    let message = format!("group {group:?} has {count} {elements} of the type {:?} (number {})", kind.name, kind.number);
    let help = if kind.dimension == 3 {
        "bodies are plane: mesh in two dimensions (gmsh -2), or take the volumes out of the physical group"
    } else {
        "only nodes at corners are computed: mesh with Mesh.ElementOrder = 1 (gmsh -order 1), or take it out of the physical group"
    };
    reader.fault(&ELEMENT_TYPE, *first, message, help)
}

/// Where the node with a tag stands in the file's order.
struct NodeIndex {
    /// By tag.
    sorted: Vec<(u64, u32)>,
}

impl NodeIndex {
    fn new(nodes: &[FileNode], reader: &Reader, faults: &mut Faults) -> Self {
        if u32::try_from(nodes.len()).is_err() {
            let message = format!("the mesh has {} nodes, more than 32 bits can number", nodes.len());
            faults.add("too many nodes", || Fault::new(&NODE, reader.source(), message, "use a coarser mesh"));
            return Self { sorted: Vec::new() };
        }
        let mut sorted: Vec<_> = (0..).zip(nodes).map(|(index, node)| (node.tag, index)).collect();
        sorted.sort_unstable();
        for pair in sorted.windows(2) {
            if pair[0].0 == pair[1].0 {
                faults.add("nodes whose tag is there twice", || {
                    let node = &nodes[pair[1].1 as usize];
                    reader.fault(&NODE, node.at, format!("a second node with the tag {}", node.tag), AGAIN)
                });
            }
        }
        Self { sorted }
    }

    fn of(&self, tag: u64) -> Option<u32> {
        // Tags are mostly contiguous: then the place follows from the first.
        let first = self.sorted.first()?.0;
        let guess = usize::try_from(tag.checked_sub(first)?).ok().and_then(|place| self.sorted.get(place));
        if let Some((_, index)) = guess.filter(|(found, _)| *found == tag) {
            return Some(*index);
        }
        let place = self.sorted.binary_search_by_key(&tag, |(tag, _)| *tag).ok()?;
        Some(self.sorted[place].1)
    }
}

/// A cell with node indices instead of tags.
struct Cell<'a> {
    file: &'a FileCell,
    nodes: [u32; 4],
}

impl Cell<'_> {
    fn nodes(&self) -> &[u32] {
        &self.nodes[..self.file.kind.nodes]
    }
}

fn resolve<'a>(group: &Group<'a>, index: &NodeIndex, reader: &Reader, faults: &mut Faults) -> Vec<Cell<'a>> {
    let mut cells = Vec::with_capacity(group.cells.len());
    for file in group.cells {
        let mut cell = Cell { file, nodes: [0; 4] };
        for k in 0..file.kind.nodes {
            match index.of(file.nodes[k]) {
                Some(node) => cell.nodes[k] = node,
                None => faults.add("references to missing nodes", || {
                    reader.fault(
                        &NODE,
                        file.at,
                        format!("{} needs node {}, which is not in the file", described(file, &group.name), file.nodes[k]),
                        AGAIN,
                    )
                }),
            }
        }
        cells.push(cell);
    }
    // Version 2 files are in this order, version 4 files in that of the surfaces: both shall give the same mesh.
    cells.sort_by_key(|cell| cell.file.kind.nodes);
    cells
}

fn described(cell: &FileCell, group: &str) -> String {
    format!("element {} ({}) of group {group:?}", cell.tag, cell.kind.name)
}

/// The nodes in metres, which of them the surfaces use, and how large the mesh is.
struct Nodes<'a> {
    file: &'a [FileNode],
    used: &'a [bool],
    /// x, y, z, m.
    positions: Vec<[f64; 3]>,
    /// Longer side of the box around the used nodes, m.
    size: f64,
}

impl<'a> Nodes<'a> {
    fn new(contents: &'a Contents, used: &'a [bool], scale: f64) -> Self {
        let positions: Vec<_> = contents.nodes.iter().map(|node| node.position.map(|x| x * scale)).collect();
        let mut size = 0.0_f64;
        for axis in 0..2 {
            let values = || positions.iter().zip(used).filter(|(_, used)| **used).map(|(x, _)| x[axis]).filter(|x| x.is_finite());
            let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
            size = size.max(high - low);
        }
        Self { file: &contents.nodes, used, positions, size }
    }

    fn check(&self, reader: &Reader, faults: &mut Faults) {
        for ((node, x), _) in self.file.iter().zip(&self.positions).zip(self.used).filter(|(_, used)| **used) {
            if !x.iter().all(|x| x.is_finite()) {
                faults.add("nodes that are nowhere", || {
                    let message = format!("node {} is at ({:e}, {:e}, {:e}) m: not a place", node.tag, x[0], x[1], x[2]);
                    reader.fault(&NODE, node.at, message, "coordinates are finite numbers; check the file and its unit in the model")
                });
            } else if x[2].abs() > OFF_PLANE * self.size {
                faults.add("nodes off the plane z = 0", || {
                    let message = format!("node {} is at z = {:e} m, off the plane z = 0", node.tag, x[2]);
                    let help = "bodies lie in the plane of x and y: move the geometry there, or look whether the mesh is three-dimensional";
                    reader.fault(&NODE, node.at, message, help)
                });
            }
        }
    }

    fn place(&self, node: u32) -> [f64; 2] {
        let [x, y, _] = self.positions[node as usize];
        [x, y]
    }

    /// The mesh of the used nodes; nothing is wrong with it any more.
    fn mesh(&self, source: &str, groups: &[Group], cells: &[Vec<Cell>]) -> ImportedMesh {
        let mut dense = vec![0_u32; self.used.len()];
        let mut positions = Vec::new();
        for (next, (node, _)) in (0..).zip(self.used.iter().enumerate().filter(|(_, used)| **used)) {
            dense[node] = next;
            let [x, y, _] = self.positions[node];
            positions.push([x, y, 0.0]);
        }
        let counter_clockwise = |cell: &Cell| {
            let mut nodes: Vec<u32> = cell.nodes().iter().map(|&node| dense[node as usize]).collect();
            if cell.file.kind.dimension == 2 && self.area(cell) < 0.0 {
                nodes[1..].reverse();
            }
            nodes
        };
        let groups = groups.iter().zip(cells).map(|(group, cells)| MeshGroup {
            name: group.name.clone(),
            dimension: group.dimension,
            cells: cells.iter().map(counter_clockwise).collect(),
        });
        ImportedMesh { source: source.into(), groups: groups.collect(), positions }
    }

    /// Area of a triangle or quadrilateral, m²; negative when its nodes run clockwise.
    fn area(&self, cell: &Cell) -> f64 {
        let x = |k: usize| self.place(cell.nodes[k]);
        // Half the product of the diagonals; of a triangle, two sides.
        if cell.file.kind.nodes == 4 { 0.5 * cross(x(0), x(2), x(1), x(3)) } else { 0.5 * cross(x(0), x(1), x(0), x(2)) }
    }
}

/// (b − a) × (d − c).
fn cross(a: [f64; 2], b: [f64; 2], c: [f64; 2], d: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (d[1] - c[1]) - (b[1] - a[1]) * (d[0] - c[0])
}

/// The checks of the cells of one group.
struct Check<'a> {
    group: &'a str,
    nodes: &'a Nodes<'a>,
    reader: &'a Reader<'a>,
    faults: &'a mut Faults,
}

impl Check<'_> {
    fn fault(&mut self, kind: &'static str, cell: &Cell, message: impl FnOnce() -> String, help: &str) {
        let (group, reader) = (self.group, self.reader);
        self.faults.add(kind, || reader.fault(&CELL, cell.file.at, format!("{} {}", described(cell.file, group), message()), help));
    }

    fn cell(&mut self, cell: &Cell) {
        let nodes = cell.nodes();
        let tag = |node: u32| self.nodes.file[node as usize].tag;
        if let Some(node) = (1..nodes.len()).find(|&k| nodes[..k].contains(&nodes[k])).map(|k| tag(nodes[k])) {
            return self.fault("elements with a node twice", cell, || format!("has node {node} twice"), AGAIN);
        }
        if cell.file.kind.dimension < 2
            && let Some(node) = nodes.iter().find(|node| !self.nodes.used[**node as usize]).map(|node| tag(*node))
        {
            let help = "put the surface that it bounds into a physical group too, or take it out of this group";
            let message = || format!("lies at node {node}, which no triangle or quadrilateral of a physical group has");
            return self.fault("points and lines away from every surface", cell, message, help);
        }
        let x: Vec<[f64; 2]> = nodes.iter().map(|&node| self.nodes.place(node)).collect();
        if !x.iter().flatten().all(|x| x.is_finite()) {
            return; // The node has its fault.
        }
        let square = |[a, b]: [[f64; 2]; 2]| (b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2);
        let longest = x.iter().enumerate().flat_map(|(k, a)| x[..k].iter().map(|b| square([*a, *b]))).fold(0.0, f64::max);
        match cell.file.kind.dimension {
            1 if longest == 0.0 => {
                let message = || "has no length: its nodes lie on one another".to_string();
                self.fault("lines without length", cell, message, "remove it, or merge the nodes and mesh again");
            }
            2 => {
                let area = self.nodes.area(cell);
                let n = x.len();
                let turns_left = (0..n).filter(|&k| cross(x[k], x[(k + 1) % n], x[(k + 1) % n], x[(k + 2) % n]) > 0.0).count();
                if n == 4 && turns_left == 2 {
                    let message = || "has sides that cross each other".to_string();
                    self.fault("elements with crossing sides", cell, message, "its nodes are not in order around it; mesh again");
                } else if area.abs() <= NO_AREA * longest {
                    let message = || format!("has no area ({area:e} m²)");
                    self.fault("elements without area", cell, message, "its nodes lie on a line or on one another; mesh again");
                }
            }
            _ => {}
        }
    }

    /// A cell that is there twice would have its mass and stiffness twice.
    fn repeated(&mut self, cells: &[Cell]) {
        let mut sorted: Vec<([u32; 4], usize)> = cells.iter().enumerate().map(|(place, cell)| (key(cell), place)).collect();
        sorted.sort_unstable();
        for pair in sorted.windows(2) {
            if pair[0].0 == pair[1].0 {
                let other = cells[pair[0].1].file.tag;
                self.fault("elements that are there twice", &cells[pair[1].1], || format!("has the nodes of element {other}"), AGAIN);
            }
        }
    }
}

/// The nodes of a cell in ascending order, filled up with the largest number.
fn key(cell: &Cell) -> [u32; 4] {
    let mut key = [u32::MAX; 4];
    key[..cell.file.kind.nodes].copy_from_slice(cell.nodes());
    key.sort_unstable();
    key
}
