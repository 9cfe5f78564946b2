//! What a .msh file holds, as it stands there: nodes by tag, elements by physical group, names of groups.
//!
//! `version2.rs` and `version4.rs` fill it, `mesh.rs` checks it and makes the mesh. Numbers are the file's
//! own; nothing is looked up yet.

use super::element_kind::ElementKind;
use super::reader::{Least, Reader};
use super::views::View;
use crate::gmsh::messages::{DAMAGED, ELEMENT_TYPE};
use embate_solver::error::Fault;
use embate_solver::mesh::cell::{CellKind, MOST_NODES};
use std::collections::BTreeMap;

/// A node as in the file.
#[derive(Clone, Copy, Debug)]
pub(super) struct FileNode {
    pub(super) tag: u64,
    /// x, y, z in the file's unit.
    pub(super) position: [f64; 3],
    /// Byte offset in the file.
    pub(super) at: usize,
}

/// An element as in the file, of a type that can become a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct FileCell {
    pub(super) kind: &'static ElementKind,
    /// The kind of cell that it becomes.
    pub(super) shape: CellKind,
    /// Number in the file.
    pub(super) tag: u64,
    /// Node tags; the first `shape.nodes()` count.
    pub(super) nodes: [u64; MOST_NODES],
    /// Byte offset in the file.
    pub(super) at: usize,
}

/// A physical group: dimension and tag (the sign, which turns elements round, left out).
pub(super) type GroupKey = (u8, u64);

/// How often an element type that embate doesn't compute occurs in a group, and first where.
#[derive(Clone, Copy, Debug)]
pub(super) struct Occurrence {
    pub(super) kind: &'static ElementKind,
    pub(super) count: usize,
    pub(super) first: usize,
}

/// What a .msh file holds.
#[derive(Debug, Default)]
pub(super) struct Contents {
    /// In the order of the file.
    pub(super) nodes: Vec<FileNode>,
    /// Names of physical groups.
    pub(super) names: BTreeMap<GroupKey, String>,
    /// Cells of each physical group, in the order of the file.
    pub(super) groups: BTreeMap<GroupKey, Vec<FileCell>>,
    /// Surfaces and volumes that belong to no group.
    pub(super) ungrouped: Vec<FileCell>,
    /// Views of one component.
    pub(super) views: Vec<View>,
    /// Element types that can't be computed, by group (`None`: no group) and number of the type.
    pub(super) foreign: BTreeMap<(Option<GroupKey>, i64), Occurrence>,
}

impl Contents {
    /// Adds an element to each of the physical `groups` of its dimension. `nodes` is needed for cells only.
    pub(super) fn add_element(&mut self, kind: &'static ElementKind, tag: u64, groups: &[u64], nodes: [u64; MOST_NODES], at: usize) {
        if let Some(shape) = kind.cell() {
            let cell = FileCell { kind, shape, tag, nodes, at };
            for &group in groups {
                self.groups.entry((kind.dimension, group)).or_default().push(cell);
            }
            if groups.is_empty() && kind.dimension >= 2 {
                self.ungrouped.push(cell);
            }
        } else if groups.is_empty() {
            self.add_foreign(None, kind, at);
        } else {
            for &group in groups {
                self.add_foreign(Some((kind.dimension, group)), kind, at);
            }
        }
    }

    fn add_foreign(&mut self, group: Option<GroupKey>, kind: &'static ElementKind, at: usize) {
        self.foreign.entry((group, kind.number)).or_insert(Occurrence { kind, count: 0, first: at }).count += 1;
    }

    /// Reads `$PhysicalNames`, which is text in every kind of file: `dimension tag "name"` on each line.
    pub(super) fn read_names(&mut self, reader: &mut Reader) -> Result<(), Fault> {
        let count = reader.count_line("physical names", Least { numbers: 3, bytes: 7 })?;
        for _ in 0..count {
            reader.skip_space();
            let at = reader.at();
            let dimension: u8 = reader.text("the dimension of a physical group (0 to 3)")?;
            let tag: i64 = reader.text("the tag of a physical group")?;
            let line = reader.line();
            let name = line.strip_prefix(b"\"").and_then(|name| name.strip_suffix(b"\"")).and_then(|name| std::str::from_utf8(name).ok());
            let (Some(name), 0..=3) = (name, dimension) else {
                let help = "a line here is, for example, 2 1 \"plate\": dimension 0 to 3, tag, name in quotes (UTF-8)";
                return Err(reader.fault(&DAMAGED, at, "this is not the name of a physical group", help));
            };
            // An empty name is no name.
            if !name.is_empty() && self.names.insert((dimension, tag.unsigned_abs()), name.to_string()).is_some() {
                let message = format!("physical group {tag} of dimension {dimension} has two names, the second is {name:?}");
                return Err(reader.fault(&DAMAGED, at, message, "remove one of them"));
            }
        }
        Ok(())
    }
}

/// The kind of an element that the file gives as `number`.
pub(super) fn element_kind(reader: &Reader, at: usize, number: i64) -> Result<&'static ElementKind, Fault> {
    ElementKind::numbered(number).ok_or_else(|| {
        let help = "known are those with a fixed number of nodes; mesh with triangles and quadrilaterals, or with \
            hexahedra, prisms and tetrahedra, or the file is damaged here";
        reader.fault(&ELEMENT_TYPE, at, format!("element type {number} is not known"), help)
    })
}

/// Reads the node tags of an element; those of the types that can become a cell are kept.
pub(super) fn element_nodes(kind: &ElementKind, mut tag: impl FnMut() -> Result<u64, Fault>) -> Result<[u64; MOST_NODES], Fault> {
    let mut nodes = [0; MOST_NODES];
    for k in 0..kind.nodes {
        let node = tag()?;
        if let Some(slot) = nodes.get_mut(kind.place(k)) {
            *slot = node;
        }
    }
    Ok(nodes)
}
