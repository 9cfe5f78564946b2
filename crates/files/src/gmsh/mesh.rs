//! From the contents of a .msh file to a mesh: groups and their names, dense node numbers, places of nodes.
//! `check.rs` looks at the cells.
//!
//! [`super::parse`] calls [`mesh`] once the whole file is read; what comes out goes into the model.

use super::Bodies;
use super::check::Check;
use super::contents::{Contents, FileCell, FileNode, GroupKey, Occurrence};
use super::faults::Faults;
use super::form;
use super::reader::Reader;
use super::views::{Place, View};
use crate::gmsh::messages::{ELEMENT_TYPE, NODE, PHYSICAL_GROUP};
use embate_solver::error::Fault;
use embate_solver::mesh::cell::{CellKind, MOST_NODES};
use embate_solver::model::{FieldValues, ImportedMesh, MeshField, MeshGroup};
use std::collections::BTreeMap;

/// Distance from the plane z = 0, as a fraction of the mesh's size, that still counts as on it.
const OFF_PLANE: f64 = 1e-9;
pub(super) const AGAIN: &str = "the file is damaged; export the mesh again";

/// The mesh that `contents` describes; positions are multiplied by `scale`.
pub(super) fn mesh(bodies: Bodies, contents: &Contents, reader: &Reader, scale: f64) -> Result<ImportedMesh, Vec<Fault>> {
    let source = reader.source();
    let mut faults = Faults::default();
    let groups = groups(contents, reader, &mut faults);
    let index = NodeIndex::new(&contents.nodes, reader, &mut faults);
    // In 3D, if there is a volume or surfaces are meant to be shells.
    let highest = groups.iter().map(|group| group.dimension).max().unwrap_or(2).max(2);
    let (dimension, least) = if bodies == Bodies::Sheets { (3, 2) } else { (highest, highest) };
    let has_quadrilaterals = groups.iter().flat_map(|group| &group.cells).any(|cell| cell.shape == CellKind::Quadrilateral);
    let takes_corners = dimension == 3 || has_quadrilaterals;
    let resolved: Vec<Vec<Cell>> = groups.iter().map(|group| resolve(group, takes_corners, &index, reader, &mut faults)).collect();
    if !faults.is_empty() {
        return Err(faults.into_list(source));
    }
    let mut used = vec![false; contents.nodes.len()];
    for cell in resolved.iter().flatten().filter(|cell| cell.file.kind.dimension >= least) {
        cell.nodes().iter().for_each(|&node| used[node as usize] = true);
    }
    let nodes = Nodes::new(contents, &used, [dimension, least], scale);
    nodes.check(reader, &mut faults);
    for (group, cells) in groups.iter().zip(&resolved) {
        let mut check = Check::new(&group.name, &nodes, reader, &mut faults);
        cells.iter().for_each(|cell| check.cell(cell));
        check.repeated(cells);
    }
    if !faults.is_empty() {
        return Err(faults.into_list(source));
    }
    let mut mesh = nodes.mesh(source, &groups, &resolved);
    mesh.notes = notes(&groups, &resolved);
    mesh.fields = contents.views.iter().map(|view| nodes.field(view, &index, &resolved, scale)).collect();
    Ok(mesh)
}

/// Bodies that are no longer of second order.
fn notes(groups: &[Group], resolved: &[Vec<Cell>]) -> Vec<String> {
    let bodies = groups.iter().map(|group| group.dimension).max().unwrap_or(0);
    let mut notes = Vec::new();
    for (group, cells) in groups.iter().zip(resolved).filter(|(group, _)| group.dimension == bodies) {
        let mut kinds: BTreeMap<i64, (usize, &Cell)> = BTreeMap::new();
        for cell in cells.iter().filter(|cell| cell.shape.nodes() < cell.file.kind.nodes) {
            kinds.entry(cell.file.kind.number).or_insert((0, cell)).0 += 1;
        }
        for (count, first) in kinds.into_values() {
            let (name, cell) = (&group.name, first.shape.facts());
            let what = format!("group {name:?} has {count} elements of the type {:?}", first.file.kind.name);
            notes.push(format!("{what}, which become {} of {} nodes", cell.plural, cell.nodes));
        }
    }
    notes
}

/// A physical group with the name that the model knows it by.
struct Group<'a> {
    name: String,
    dimension: u8,
    cells: Vec<&'a FileCell>,
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
        contents
            .groups
            .iter()
            .map(|(&key, cells)| Group { name: name_of(contents, key), dimension: key.0, cells: cells.iter().collect() })
            .collect()
    } else {
        // What bounds a volume is no body of its own.
        let dimension = contents.ungrouped.iter().map(|cell| cell.kind.dimension).max();
        let of = |dimension| contents.ungrouped.iter().filter(move |cell| cell.kind.dimension == dimension).collect();
        dimension.map(|dimension| Group { name: "all".into(), dimension, cells: of(dimension) }).into_iter().collect()
    };
    if faults.is_empty() && !groups.iter().any(|group| group.dimension >= 2) {
        let (message, help) = if grouped {
            let help = "in Gmsh, put the surfaces of each body into a physical group (Physical Surface(\"body\") = {...};) and mesh in two dimensions; \
                        of solids the volumes (Physical Volume), in three";
            ("no triangle or quadrilateral belongs to a physical group", help)
        } else {
            ("the file holds no triangles or quadrilaterals", "in Gmsh, mesh in two dimensions, solids in three, before saving")
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
    let help = if kind.is_pyramid() {
        "pyramids are not computed: mesh with hexahedra, prisms or tetrahedra, each from face to face, or take them \
            out of the physical group"
    } else {
        "elements of first and second order are read: mesh with Mesh.ElementOrder = 1 or 2, or take it out of the physical group"
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
pub(super) struct Cell<'a> {
    pub(super) file: &'a FileCell,
    /// The kind of cell that it is here.
    pub(super) shape: CellKind,
    nodes: [u32; MOST_NODES],
}

impl Cell<'_> {
    pub(super) fn nodes(&self) -> &[u32] {
        &self.nodes[..self.shape.nodes()]
    }
}

/// The cells of a group, triangles of six nodes with their corners alone: in 3D they are shells, or sides of
/// ten-node tetrahedra, and beside quadrilaterals their nodes between corners would hang free.
fn resolve<'a>(group: &Group<'a>, takes_corners: bool, index: &NodeIndex, reader: &Reader, faults: &mut Faults) -> Vec<Cell<'a>> {
    let mut cells = Vec::with_capacity(group.cells.len());
    for &file in &group.cells {
        let shape = match file.shape {
            CellKind::Triangle6 if takes_corners => CellKind::Triangle,
            shape => shape,
        };
        let mut cell = Cell { file, shape, nodes: [0; MOST_NODES] };
        for k in 0..shape.nodes() {
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
    // Version 2 files are in this order, version 4 files in that of the surfaces: both shall give the same
    // mesh.
    cells.sort_by_key(|cell| cell.file.kind.nodes);
    cells
}

pub(super) fn described(cell: &FileCell, group: &str) -> String {
    format!("element {} ({}) of group {group:?}", cell.tag, cell.kind.name)
}

/// The nodes in metres, which of them the bodies use, and how large the mesh is.
pub(super) struct Nodes<'a> {
    pub(super) file: &'a [FileNode],
    pub(super) used: &'a [bool],
    /// 2 or 3.
    pub(super) dimension: u8,
    /// Least dimension of bodies.
    pub(super) least: u8,
    /// x, y, z, m; z is that of the file in 2D too.
    positions: Vec<[f64; 3]>,
    /// Longer side of the box around the used nodes in x and y, m.
    size: f64,
}

impl<'a> Nodes<'a> {
    fn new(contents: &'a Contents, used: &'a [bool], [dimension, least]: [u8; 2], scale: f64) -> Self {
        let positions: Vec<_> = contents.nodes.iter().map(|node| node.position.map(|x| x * scale)).collect();
        let mut size = 0.0_f64;
        for axis in 0..2 {
            let values = || positions.iter().zip(used).filter(|(_, used)| **used).map(|(x, _)| x[axis]).filter(|x| x.is_finite());
            let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
            size = size.max(high - low);
        }
        Self { file: &contents.nodes, used, dimension, least, positions, size }
    }

    fn check(&self, reader: &Reader, faults: &mut Faults) {
        for ((node, x), _) in self.file.iter().zip(&self.positions).zip(self.used).filter(|(_, used)| **used) {
            if !x.iter().all(|x| x.is_finite()) {
                faults.add("nodes that are nowhere", || {
                    let message = format!("node {} is at ({:e}, {:e}, {:e}) m: not a place", node.tag, x[0], x[1], x[2]);
                    reader.fault(&NODE, node.at, message, "coordinates are finite numbers; check the file and its unit in the model")
                });
            } else if self.dimension == 2 && x[2].abs() > OFF_PLANE * self.size {
                faults.add("nodes off the plane z = 0", || {
                    let message = format!("node {} is at z = {:e} m, off the plane z = 0", node.tag, x[2]);
                    let help = "bodies lie in the plane of x and y: move the geometry there; of solids put the \
                        volumes into physical groups (Physical Volume); of shells take `element = \"shell4\"`";
                    reader.fault(&NODE, node.at, message, help)
                });
            }
        }
    }

    /// Where a node is, m; in 2D z is 0.
    pub(super) fn place(&self, node: u32) -> [f64; 3] {
        let [x, y, z] = self.positions[node as usize];
        [x, y, if self.dimension == 2 { 0.0 } else { z }]
    }

    /// The corners of a cell, m.
    pub(super) fn corners(&self, cell: &Cell) -> Vec<[f64; 3]> {
        cell.nodes().iter().map(|&node| self.place(node)).collect()
    }

    /// A view as a field of the mesh of the used nodes.
    fn field(&self, view: &View, index: &NodeIndex, cells: &[Vec<Cell>], scale: f64) -> MeshField {
        let values = if view.place == Place::Nodes {
            let mut all = vec![None; self.used.len()];
            for (tag, own) in &view.values {
                if let (Some(node), Some(value)) = (index.of(*tag), own.first()) {
                    all[node as usize] = Some(scale * value);
                }
            }
            FieldValues::Nodes(all.into_iter().zip(self.used).filter(|(_, used)| **used).map(|(value, _)| value).collect())
        } else {
            let of_elements: BTreeMap<u64, &[f64]> = view.values.iter().map(|(tag, own)| (*tag, &own[..])).collect();
            let of_cell = |cell: &Cell| {
                let count = cell.nodes().len();
                let mut own: Vec<f64> = match of_elements.get(&cell.file.tag) {
                    Some([value]) => vec![scale * value; count],
                    Some(values) if values.len() == count => values.iter().map(|value| scale * value).collect(),
                    _ => Vec::new(),
                };
                if own.len() == count && self.is_turned(cell) {
                    let mut order: Vec<u32> = (0..count as u32).collect();
                    cell.shape.reflect(&mut order);
                    own = order.iter().map(|&at| own[at as usize]).collect();
                }
                own
            };
            FieldValues::Corners(cells.iter().map(|cells| cells.iter().map(of_cell).collect()).collect())
        };
        MeshField { name: view.name.clone(), values }
    }

    /// Whether a cell of the file is turned round in the mesh.
    fn is_turned(&self, cell: &Cell) -> bool {
        cell.file.kind.dimension == self.dimension && form::is_turned(cell.shape, &self.corners(cell))
    }

    /// The mesh of the used nodes; nothing is wrong with it any more.
    fn mesh(&self, source: &str, groups: &[Group], cells: &[Vec<Cell>]) -> ImportedMesh {
        let mut dense = vec![0_u32; self.used.len()];
        let mut positions = Vec::new();
        for (next, (node, _)) in (0..).zip(self.used.iter().enumerate().filter(|(_, used)| **used)) {
            dense[node] = next;
            positions.push(self.place(node as u32));
        }
        let oriented = |cell: &Cell| {
            let mut nodes: Vec<u32> = cell.nodes().iter().map(|&node| dense[node as usize]).collect();
            if self.is_turned(cell) {
                cell.shape.reflect(&mut nodes);
            }
            nodes
        };
        let groups = groups.iter().zip(cells).map(|(group, cells)| MeshGroup {
            name: group.name.clone(),
            dimension: group.dimension,
            cells: cells.iter().map(oriented).collect(),
        });
        ImportedMesh { source: source.into(), groups: groups.collect(), positions, ..ImportedMesh::default() }
    }
}
