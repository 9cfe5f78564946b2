//! Views of a .msh file: `$NodeData`, `$ElementData` and `$ElementNodeData`, the same in versions 2.2 and
//! 4.1.
//!
//! Texts (the name first), numbers and whole numbers (step, components, how many values) come first, each on
//! a line of its own, in every kind of file; then a value for each node, element, or node of an element.
//! Those of one component are kept, of several steps the first. Source: "MSH file format" of the Gmsh
//! reference manual.

use super::contents::Contents;
use super::reader::{Least, Reader};
use crate::gmsh::messages::DAMAGED;
use embate_solver::error::Fault;

/// Where the values of a view are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    Nodes,
    Elements,
    ElementNodes,
}

impl Place {
    /// Of a section of the file.
    pub(super) fn of(section: &str) -> Option<Self> {
        match section {
            "NodeData" => Some(Self::Nodes),
            "ElementData" => Some(Self::Elements),
            "ElementNodeData" => Some(Self::ElementNodes),
            _ => None,
        }
    }
}

/// A view: numbers of nodes or elements, as the file has them, each with its values.
#[derive(Clone, Debug)]
pub(super) struct View {
    pub(super) name: String,
    pub(super) place: Place,
    pub(super) values: Vec<(u64, Vec<f64>)>,
}

/// Most components of a view that are read.
const COMPONENTS_MOST: usize = 9;

/// Reads one of the sections.
pub(super) fn read(reader: &mut Reader, contents: &mut Contents, place: Place) -> Result<(), Fault> {
    let texts = reader.count_line("texts of a view", Least { numbers: 1, bytes: 2 })?;
    let mut name = String::new();
    for number in 0..texts {
        reader.skip_space();
        let text = String::from_utf8_lossy(reader.line()).trim_matches('"').to_string();
        if number == 0 {
            name = text;
        }
    }
    for _ in 0..reader.count_line("numbers of a view", Least { numbers: 1, bytes: 2 })? {
        reader.skip_space();
        reader.text::<f64>("a number of a view")?;
        reader.end_of_line()?;
    }
    let at = reader.at();
    let mut whole = Vec::new();
    for _ in 0..reader.count_line("whole numbers of a view", Least { numbers: 1, bytes: 2 })? {
        reader.skip_space();
        whole.push(reader.text::<usize>("a whole number of a view")?);
        reader.end_of_line()?;
    }
    let (Some(&components), Some(&count)) = (whole.get(1), whole.get(2)) else {
        let help = "they are the step, the components and how many values there are; export the view again";
        return Err(reader.fault(&DAMAGED, at, format!("a view has {} whole numbers, not three", whole.len()), help));
    };
    if components == 0 || components > COMPONENTS_MOST {
        let message = format!("a view has {components} components");
        return Err(reader.fault(&DAMAGED, at, message, "they are 1, 3 or 9: the file is damaged here"));
    }
    let least = Least { numbers: 1 + components, bytes: 4 + 8 * components };
    let count = reader.checked(count as u64, at, "values of a view", least)?;
    let mut values = Vec::with_capacity(count);
    for _ in 0..count {
        reader.start_of_record();
        let at = reader.at();
        let number = reader.natural("the number of a node or element of a view")?;
        let nodes = match place {
            Place::ElementNodes => {
                let nodes = reader.natural("the number of nodes of an element of a view")?;
                reader.checked(nodes, at, "nodes of an element of a view", Least { numbers: components, bytes: 8 * components })?
            }
            _ => 1,
        };
        let mut own = Vec::with_capacity(nodes);
        for _ in 0..nodes {
            for component in 0..components {
                let value = reader.double("a value of a view")?;
                own.extend((component == 0).then_some(value));
            }
        }
        reader.end_of_record()?;
        values.push((number, own));
    }
    if components == 1 && contents.views.iter().all(|view| view.name != name) {
        contents.views.push(View { name, place, values });
    }
    Ok(())
}
