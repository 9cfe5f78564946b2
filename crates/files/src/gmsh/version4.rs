//! Sections of .msh version 4.1: `$Entities`, `$PartitionedEntities`, `$Nodes` and `$Elements`, text and
//! binary.
//!
//! Nodes and elements stand in blocks, one for each entity of the geometry; an entity's physical groups are
//! those of its elements. Both kinds of file hold the same sequence of `int`, `size_t` and `double`. Source:
//! "MSH file format" of the Gmsh reference manual.

use super::contents::{Contents, FileNode, element_kind, element_nodes};
use super::reader::{Least, Reader};
use crate::gmsh::messages::DAMAGED;
use embate_solver::error::Fault;
use std::collections::BTreeMap;

/// Physical groups of each entity, by dimension and tag.
pub(super) type Entities = BTreeMap<(i64, i64), Vec<u64>>;

/// Reads `$Entities` or, with `partitioned`, `$PartitionedEntities`, whose entities have a parent and
/// partitions besides.
pub(super) fn read_entities(reader: &mut Reader, entities: &mut Entities, partitioned: bool) -> Result<(), Fault> {
    let size = reader.size_bytes();
    reader.start_of_record();
    if partitioned {
        reader.size("the number of partitions")?;
        reader.end_of_record()?;
        reader.start_of_record();
        let ghosts = reader.count("ghost entities", Least { numbers: 2, bytes: 8 })?;
        reader.end_of_record()?;
        for _ in 0..ghosts {
            reader.start_of_record();
            reader.int("the tag of a ghost entity")?;
            reader.int("the partition of a ghost entity")?;
            reader.end_of_record()?;
        }
        reader.start_of_record();
    }
    let point = Least { numbers: 5, bytes: 28 + size };
    let other = Least { numbers: 9, bytes: 52 + 2 * size };
    let mut counts = [0; 4];
    for (count, (what, least)) in counts.iter_mut().zip([("points", point), ("curves", other), ("surfaces", other), ("volumes", other)]) {
        *count = reader.count(what, least)?;
    }
    reader.end_of_record()?;
    for (dimension, count) in (0..).zip(counts) {
        for _ in 0..count {
            reader.start_of_record();
            let (tag, groups) = read_entity(reader, dimension, partitioned)?;
            reader.end_of_record()?;
            entities.insert((dimension, tag), groups);
        }
    }
    Ok(())
}

/// Reads one entity: its tag and its physical groups, ascending.
fn read_entity(reader: &mut Reader, dimension: i64, partitioned: bool) -> Result<(i64, Vec<u64>), Fault> {
    let int = Least { numbers: 1, bytes: 4 };
    let tag = reader.int("the tag of an entity")?;
    if partitioned {
        reader.int("the dimension of an entity's parent")?;
        reader.int("the tag of an entity's parent")?;
        for _ in 0..reader.count("partitions of an entity", int)? {
            reader.int("a partition of an entity")?;
        }
    }
    for _ in 0..if dimension == 0 { 3 } else { 6 } {
        reader.double("a coordinate of an entity")?;
    }
    let count = reader.count("physical groups of an entity", int)?;
    let mut groups = Vec::with_capacity(count);
    for _ in 0..count {
        groups.push(reader.int("a physical group of an entity")?.unsigned_abs());
    }
    groups.sort_unstable();
    groups.dedup();
    if dimension > 0 {
        for _ in 0..reader.count("bounding entities", int)? {
            reader.int("a bounding entity")?;
        }
    }
    Ok((tag, groups))
}

/// Reads `$Nodes`.
pub(super) fn read_nodes(reader: &mut Reader, contents: &mut Contents) -> Result<(), Fault> {
    let node = Least { numbers: 4, bytes: 24 + reader.size_bytes() };
    let blocks = section_header(reader, "nodes", node)?;
    contents.nodes.reserve_exact(blocks.items);
    for _ in 0..blocks.blocks {
        reader.start_of_record();
        let at = reader.at();
        let dimension = reader.int("the dimension of a block's entity")?;
        reader.int("the tag of a block's entity")?;
        let parametric = reader.int("whether a block's nodes are parametric (0 or 1)")?;
        let count = reader.count("nodes of a block", node)?;
        reader.end_of_record()?;
        if !(0..=3).contains(&dimension) || !(0..=1).contains(&parametric) {
            let message = format!("a block of nodes of dimension {dimension}, parametric {parametric}");
            return Err(reader.fault(&DAMAGED, at, message, "the dimension is 0 to 3, parametric 0 or 1: the file is damaged here"));
        }
        let first = contents.nodes.len();
        for _ in 0..count {
            reader.start_of_record();
            let at = reader.at();
            let tag = reader.size("the tag of a node")?;
            reader.end_of_record()?;
            contents.nodes.push(FileNode { tag, position: [0.0; 3], at });
        }
        for node in &mut contents.nodes[first..] {
            reader.start_of_record();
            // In a text file the line with the coordinates says more than that with the tag.
            node.at = reader.at();
            node.position = [reader.double("x of a node")?, reader.double("y of a node")?, reader.double("z of a node")?];
            for _ in 0..dimension * parametric {
                reader.double("a parameter of a node")?;
            }
            reader.end_of_record()?;
        }
    }
    blocks.check(reader, "nodes", contents.nodes.len())
}

/// Reads `$Elements`; `entities` is `None` when the file has no `$Entities`.
pub(super) fn read_elements(reader: &mut Reader, contents: &mut Contents, entities: Option<&Entities>) -> Result<(), Fault> {
    let size = reader.size_bytes();
    let blocks = section_header(reader, "elements", Least { numbers: 2, bytes: 2 * size })?;
    let mut read = 0;
    for _ in 0..blocks.blocks {
        reader.start_of_record();
        let start = reader.at();
        let dimension = reader.int("the dimension of a block's entity")?;
        let entity = reader.int("the tag of a block's entity")?;
        let number = reader.int("the type of a block's elements")?;
        let kind = element_kind(reader, start, number)?;
        let count = reader.count("elements of a block", Least { numbers: 1 + kind.nodes, bytes: (1 + kind.nodes) * size })?;
        reader.end_of_record()?;
        if i64::from(kind.dimension) != dimension {
            let message = format!("elements of type {} ({}) in an entity of dimension {dimension}", kind.number, kind.name);
            return Err(reader.fault(&DAMAGED, start, message, "the file is damaged here; export the mesh again"));
        }
        let groups = match entities {
            None => &[][..],
            Some(entities) => entities.get(&(dimension, entity)).ok_or_else(|| {
                let message = format!("entity {entity} of dimension {dimension} is not in $Entities");
                reader.fault(&DAMAGED, start, message, "the physical group of its elements is not known; export the mesh again")
            })?,
        };
        for _ in 0..count {
            reader.start_of_record();
            let at = reader.at();
            let tag = reader.size("the tag of an element")?;
            let nodes = element_nodes(kind, || reader.size("a node of an element"))?;
            reader.end_of_record()?;
            contents.add_element(kind, tag, groups, nodes, at);
        }
        read += count;
    }
    blocks.check(reader, "elements", read)
}

/// First line of `$Nodes` and `$Elements`.
struct Blocks {
    blocks: usize,
    items: usize,
    at: usize,
}

fn section_header(reader: &mut Reader, what: &str, least: Least) -> Result<Blocks, Fault> {
    reader.start_of_record();
    let at = reader.at();
    let blocks = reader.count("blocks", Least { numbers: 4, bytes: 12 + reader.size_bytes() })?;
    let items = reader.count(what, least)?;
    reader.size("the smallest tag")?;
    reader.size("the largest tag")?;
    reader.end_of_record()?;
    Ok(Blocks { blocks, items, at })
}

impl Blocks {
    fn check(&self, reader: &Reader, what: &str, read: usize) -> Result<(), Fault> {
        if read == self.items {
            return Ok(());
        }
        let message = format!("the file announces {} {what}, but its blocks hold {read}", self.items);
        Err(reader.fault(&DAMAGED, self.at, message, "the counts don't agree: the file is damaged; export the mesh again"))
    }
}
