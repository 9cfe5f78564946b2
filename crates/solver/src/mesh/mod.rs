//! Nodes, element groups, surfaces and sets: what the shapes and mesh files become before blocks are made from them.
//!
//! [`Mesh::new`] puts the bodies of a model side by side with one node numbering; names (`part`, `part.side`, groups of a mesh file) are
//! resolved to nodes and surfaces here and nowhere else.

pub mod shapes;
pub mod surface;
mod order;

use crate::error::Fault;
use crate::model::{ImportedMesh, Model, Shape};
use std::collections::BTreeMap;
use surface::Surface;

/// The elements of one part.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PartMesh {
    /// Name of the part.
    pub name: String,
    /// Nodes per element.
    pub nodes_per_element: usize,
    /// Node indices, `nodes_per_element` per element, counter-clockwise.
    pub connectivity: Vec<u32>,
    /// All nodes of the part in the order of its mesh.
    pub nodes: Vec<u32>,
    /// The user's number of each element: its place in the part as it was made or read.
    pub user_elements: Vec<u32>,
}

impl PartMesh {
    /// Number of elements.
    #[must_use]
    pub fn elements(&self) -> usize {
        self.connectivity.len() / self.nodes_per_element
    }

    fn cells(&self) -> impl Iterator<Item = &[u32]> {
        self.connectivity.chunks_exact(self.nodes_per_element)
    }
}

/// The bodies of a model in one node numbering.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh<const D: usize> {
    /// Initial node positions, m.
    pub positions: Vec<[f64; D]>,
    /// Parts in model order.
    pub parts: Vec<PartMesh>,
    /// The user's number of each node: its place in the parts as they were made or read.
    pub user_nodes: Vec<u32>,
    /// Named lines: `part.side` and one-dimensional groups, each with the body on the right.
    lines: BTreeMap<String, Vec<[u32; 2]>>,
    /// Named nodes: zero- and two-dimensional groups.
    points: BTreeMap<String, Vec<u32>>,
}

/// At most so many faults of one kind are told one by one.
const TOLD: usize = 20;

impl Mesh<2> {
    /// The mesh of a model whose references have been checked.
    ///
    /// # Errors
    /// All faults: elements of a wrong shape or turned inside out, lines that bound no element, nodes of nothing.
    pub fn new(model: &Model) -> Result<Self, Vec<Fault>> {
        let mut mesh = Self::default();
        let mut faults = Vec::new();
        let mut imported = vec![Vec::new(); model.meshes.len()];
        for (index, part) in model.parts.iter().enumerate() {
            match &part.shape {
                Shape::Group { mesh: file, group } => match model.meshes.get(*file) {
                    Some(source) => mesh.add_group(source, group, &part.name, &mut imported[*file], index, &mut faults),
                    None => faults.push(Fault::new(format!("part[{index}]"), "its mesh was not read", "")),
                },
                shape => mesh.add_shape(shape, &part.name),
            }
            mesh.check_elements(index, &mut faults);
        }
        for (source, numbers) in model.meshes.iter().zip(&imported) {
            mesh.add_named_groups(source, numbers, &mut faults);
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        mesh.reorder();
        Ok(mesh)
    }

    fn add_shape(&mut self, shape: &Shape, name: &str) {
        let Some(body) = shapes::body(shape) else { return };
        let first = self.positions.len() as u32;
        self.positions.extend(&body.positions);
        self.parts.push(PartMesh {
            name: name.to_string(),
            nodes_per_element: 4,
            connectivity: body.quads.iter().flatten().map(|node| node + first).collect(),
            nodes: (first..first + body.positions.len() as u32).collect(),
            user_elements: Vec::new(),
        });
        for (side, segments) in body.sides {
            self.lines.insert(format!("{name}.{side}"), segments.iter().map(|segment| segment.map(|node| node + first)).collect());
        }
    }

    /// Adds the quadrilaterals of a group; `numbers[file node]` becomes the mesh node (`u32::MAX`: not yet used).
    fn add_group(&mut self, source: &ImportedMesh, group: &str, name: &str, numbers: &mut Vec<u32>, part: usize, faults: &mut Vec<Fault>) {
        numbers.resize(source.positions.len(), u32::MAX);
        let mut result = PartMesh { name: name.to_string(), nodes_per_element: 4, ..PartMesh::default() };
        let path = format!("part[{part}]");
        let Some(group) = source.groups.iter().find(|g| g.name == group && g.dimension == 2) else {
            faults.push(Fault::new(
                path,
                format!("{} has no two-dimensional group \"{group}\"", source.source),
                "name a group of the mesh file",
            ));
            self.parts.push(result);
            return;
        };
        let wrong = group.cells.iter().filter(|cell| cell.len() != 4).count();
        if wrong > 0 {
            faults.push(Fault::new(
                path,
                format!("group \"{}\" of {} has {wrong} triangle(s); the element takes quadrilaterals", group.name, source.source),
                "recombine the surface into quadrilaterals in the mesh generator",
            ));
        }
        for cell in group.cells.iter().filter(|cell| cell.len() == 4) {
            for &node in cell {
                let number = &mut numbers[node as usize];
                if *number == u32::MAX {
                    *number = self.positions.len() as u32;
                    self.positions.push(source.positions[node as usize]);
                }
                result.connectivity.push(*number);
            }
        }
        result.nodes.clone_from(&result.connectivity);
        result.nodes.sort_unstable();
        result.nodes.dedup();
        self.parts.push(result);
    }

    fn add_named_groups(&mut self, source: &ImportedMesh, numbers: &[u32], faults: &mut Vec<Fault>) {
        let outside: Vec<[u32; 2]> = self.parts.iter().filter_map(|part| surface::exterior(part.cells()).ok()).flatten().collect();
        for group in &source.groups {
            let nodes = || group.cells.iter().flatten().map(|&node| numbers.get(node as usize).copied().unwrap_or(u32::MAX));
            if nodes().any(|node| node == u32::MAX) {
                continue; // a group of something that no part uses
            }
            if group.dimension == 1 {
                let lines: Vec<[u32; 2]> = nodes().collect::<Vec<_>>().chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect();
                match surface::oriented(&lines, &outside) {
                    Ok(lines) => drop(self.lines.insert(group.name.clone(), lines)),
                    // A line inside a body is no surface, but still a set of nodes.
                    Err(_) => drop(self.points.insert(group.name.clone(), sorted(nodes()))),
                }
            } else {
                self.points.insert(group.name.clone(), sorted(nodes()));
            }
        }
        if self.positions.len() > u32::MAX as usize - 1 {
            faults.push(Fault::new("", "the model has more than 4 billion nodes", "make it smaller"));
        }
    }

    /// Every corner of every quadrilateral must turn counter-clockwise: then the Jacobian is positive in the whole element.
    fn check_elements(&self, part: usize, faults: &mut Vec<Fault>) {
        let Some(mesh) = self.parts.get(part) else { return };
        let mut count = 0;
        for (element, cell) in mesh.cells().enumerate() {
            let x = |corner: usize| self.positions[cell[corner % cell.len()] as usize];
            let bad = (0..cell.len()).any(|c| {
                let (a, b, d) = (x(c), x(c + 1), x(c + cell.len() - 1));
                // NaN counts as bad
                !((b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0]) > 0.0)
            });
            if bad {
                count += 1;
                if count <= TOLD {
                    faults.push(Fault::new(
                        format!("part[{part}]"),
                        format!(
                            "element {element} of part \"{}\" at ({:.6e}, {:.6e}) is degenerate or not convex",
                            mesh.name,
                            x(0)[0],
                            x(0)[1]
                        ),
                        "mend the mesh there",
                    ));
                }
            }
        }
        if count > TOLD {
            faults.push(Fault::new(format!("part[{part}]"), format!("and {} more elements like these", count - TOLD), ""));
        }
        if mesh.connectivity.is_empty() && faults.is_empty() {
            faults.push(Fault::new(format!("part[{part}]"), format!("part \"{}\" has no elements", mesh.name), "give it some"));
        }
    }

    /// Elements that are degenerate or not convex, after nodes have been moved.
    #[must_use]
    pub fn faults_of_elements(&self) -> Vec<Fault> {
        let mut faults = Vec::new();
        (0..self.parts.len()).for_each(|part| self.check_elements(part, &mut faults));
        faults
    }

    /// Nodes of a part, a `part.side` or a group, ascending; `None` when there is no such name.
    #[must_use]
    pub fn nodes(&self, name: &str) -> Option<Vec<u32>> {
        if let Some(part) = self.parts.iter().find(|part| part.name == name) {
            return Some(sorted(part.nodes.iter().copied()));
        }
        if let Some(lines) = self.lines.get(name) {
            return Some(sorted(lines.iter().flatten().copied()));
        }
        self.points.get(name).cloned()
    }

    /// Body of each node, from 0: what is joined by elements, of whatever parts, is one body. Bodies are numbered by their lowest nodes.
    #[must_use]
    pub fn bodies(&self) -> Vec<u32> {
        let mut root: Vec<u32> = (0..self.positions.len() as u32).collect();
        fn top(root: &mut [u32], mut node: u32) -> u32 {
            while root[node as usize] != node {
                root[node as usize] = root[root[node as usize] as usize];
                node = root[node as usize];
            }
            node
        }
        for cell in self.parts.iter().flat_map(PartMesh::cells) {
            for pair in cell.windows(2) {
                let (a, b) = (top(&mut root, pair[0]), top(&mut root, pair[1]));
                root[a.max(b) as usize] = a.min(b);
            }
        }
        let mut count = 0;
        let mut numbers = vec![0; root.len()];
        for node in 0..root.len() as u32 {
            let first = top(&mut root, node);
            numbers[node as usize] = if first == node { count } else { numbers[first as usize] };
            count += u32::from(first == node);
        }
        numbers
    }

    /// Outside of some parts together (all when `parts` is empty): an edge between two of them is inside.
    ///
    /// # Errors
    /// A fault without path when elements overlap.
    pub fn outside(&self, parts: &[String]) -> Result<Surface, Fault> {
        Surface::outside(self.parts.iter().filter(|part| parts.is_empty() || parts.contains(&part.name)).flat_map(PartMesh::cells))
    }

    /// The same without the segments that `leave_out` names (those on a symmetry line, which are no outside of the whole body).
    ///
    /// # Errors
    /// As [`Mesh::outside`].
    pub fn outside_without(&self, parts: &[String], leave_out: impl Fn([u32; 2]) -> bool) -> Result<Surface, Fault> {
        let cells = || self.parts.iter().filter(|part| parts.is_empty() || parts.contains(&part.name)).flat_map(PartMesh::cells);
        let segments = surface::exterior(cells())?;
        Surface::new(segments.into_iter().filter(|&segment| !leave_out(segment)).collect(), cells())
    }

    /// Surface of a part (its whole outside), a `part.side` or a one-dimensional group, without the segments that `leave_out` names (those on
    /// a symmetry line, which are no outside of the whole body).
    ///
    /// # Errors
    /// A fault without path when there is no such surface.
    pub fn surface(&self, name: &str, leave_out: impl Fn([u32; 2]) -> bool) -> Result<Surface, Fault> {
        let cells = || self.parts.iter().flat_map(PartMesh::cells);
        let (segments, of) = if let Some(part) = self.parts.iter().find(|part| part.name == name) {
            (surface::exterior(part.cells())?, Some(part))
        } else if let Some(lines) = self.lines.get(name) {
            let owner = name.split_once('.').and_then(|(part, _)| self.parts.iter().find(|p| p.name == part));
            (lines.clone(), owner)
        } else {
            let help = "name a part, a side as part.side, or a one-dimensional group of a mesh file";
            return Err(Fault::new("", format!("there is no surface \"{name}\""), help));
        };
        let kept: Vec<[u32; 2]> = segments.into_iter().filter(|&segment| !leave_out(segment)).collect();
        match of {
            Some(part) => Surface::new(kept, part.cells()),
            None => Surface::new(kept, cells()),
        }
    }
}

fn sorted(nodes: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut nodes: Vec<u32> = nodes.collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}
