//! Sections of .msh version 2.2: `$Nodes` (or `$ParametricNodes`) and `$Elements`, text and binary.
//!
//! Each element carries its own tags; the first is its physical group (0: none). An element of several groups
//! stands in the file once for each. In a binary file the counts are still text, nodes are `int, 3 double`,
//! and elements come in runs with a header of three ints (type, how many, tags each). Source: "MSH file
//! format version 2" of the Gmsh reference manual.

use super::contents::{Contents, FileNode, element_kind, element_nodes};
use super::reader::{Least, Reader};
use crate::gmsh::messages::DAMAGED;
use embate_solver::error::Fault;

/// Reads `$Nodes`; with `parametric`, `$ParametricNodes`: each node's entity and its parameters there follow
/// and are left out.
pub(super) fn read_nodes(reader: &mut Reader, contents: &mut Contents, parametric: bool) -> Result<(), Fault> {
    let least = if parametric { Least { numbers: 6, bytes: 36 } } else { Least { numbers: 4, bytes: 28 } };
    let count = reader.count_line("nodes", least)?;
    contents.nodes.reserve_exact(count);
    for _ in 0..count {
        reader.start_of_record();
        let at = reader.at();
        let tag = reader.natural("the number of a node")?;
        let position = [reader.double("x of a node")?, reader.double("y of a node")?, reader.double("z of a node")?];
        if parametric {
            let dimension = reader.int("the dimension of a node's entity")?;
            reader.int("the tag of a node's entity")?;
            for _ in 0..if matches!(dimension, 1 | 2) { dimension } else { 0 } {
                reader.double("a parameter of a node")?;
            }
        }
        reader.end_of_record()?;
        contents.nodes.push(FileNode { tag, position, at });
    }
    Ok(())
}

/// Reads `$Elements`.
pub(super) fn read_elements(reader: &mut Reader, contents: &mut Contents) -> Result<(), Fault> {
    let count = reader.count_line("elements", Least { numbers: 4, bytes: 8 })?;
    if reader.is_binary() {
        return read_runs(reader, contents, count);
    }
    for _ in 0..count {
        reader.start_of_record();
        let at = reader.at();
        let element = reader.natural("the number of an element")?;
        let number = reader.int("the type of an element")?;
        let kind = element_kind(reader, at, number)?;
        let tags = reader.natural("the number of tags of an element")?;
        let group = first_tag(reader, tags)?;
        let nodes = element_nodes(kind, || reader.natural("a node of an element"))?;
        reader.end_of_record()?;
        contents.add_element(kind, element, group.as_slice(), nodes, at);
    }
    Ok(())
}

fn read_runs(reader: &mut Reader, contents: &mut Contents, count: usize) -> Result<(), Fault> {
    let mut read = 0;
    while read < count {
        let start = reader.at();
        let number = reader.int("the type of a run of elements")?;
        let kind = element_kind(reader, start, number)?;
        let run = reader.natural("the number of elements of a run")?;
        let tags = reader.natural("the number of tags of the elements of a run")?;
        let numbers = usize::try_from(tags).unwrap_or(usize::MAX).saturating_add(1 + kind.nodes);
        let least = Least { numbers, bytes: numbers.saturating_mul(4) };
        let run = reader.checked(run, start, "elements of one type", least)?;
        if run == 0 || run > count - read {
            let message = format!("a run of {run} elements where {} are missing of the announced {count}", count - read);
            return Err(reader.fault(&DAMAGED, start, message, "the counts don't agree: the file is damaged; export the mesh again"));
        }
        for _ in 0..run {
            let at = reader.at();
            let element = reader.natural("the number of an element")?;
            let group = first_tag(reader, tags)?;
            let nodes = element_nodes(kind, || reader.natural("a node of an element"))?;
            contents.add_element(kind, element, group.as_slice(), nodes, at);
        }
        read += run;
    }
    Ok(())
}

/// Reads `tags` tags of an element; the first, if it isn't zero, is its physical group.
fn first_tag(reader: &mut Reader, tags: u64) -> Result<Option<u64>, Fault> {
    let mut group = None;
    for k in 0..tags {
        let tag = reader.int("a tag of an element")?;
        if k == 0 && tag != 0 {
            group = Some(tag.unsigned_abs());
        }
    }
    Ok(group)
}
