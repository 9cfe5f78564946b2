//! What a deck says about geometry, with all instances in place: nodes, elements, sets and surfaces under
//! their full names.
//!
//! Blocks come from `text.rs`. Nodes and elements are read first, then sets and surfaces in the order of the
//! file (`sets.rs`). Inside of a part or an instance names are local: outside they are `INSTANCE.NAME`.
//! `mesh.rs` makes a mesh of it, the import looks names up in it.

use super::element_kind::{self, ElementKind, Family, Found};
use super::text::{Block, Line, Text, folded, shown};
use crate::abaqus::messages::{DECK_MESH, SYNTAX, UNKNOWN};
use crate::gmsh::Bodies;
use embate_solver::error::Fault;
use embate_solver::mesh::cell::MOST_NODES;
use std::collections::BTreeMap;

/// A node in its place, in the file's unit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) tag: u64,
    pub(super) position: [f64; 3],
    pub(super) line: Line,
}

/// An element of a body.
#[derive(Clone, Copy, Debug)]
pub(super) struct Element {
    pub(super) kind: &'static ElementKind,
    pub(super) tag: u64,
    /// Indices of nodes; as many count as its kind has.
    pub(super) nodes: [u32; MOST_NODES],
    pub(super) line: Line,
}

impl Element {
    pub(super) fn nodes(&self) -> &[u32] {
        &self.nodes[..self.kind.nodes()]
    }

    /// The nodes of a side from 0; see [`ElementKind::side`].
    pub(super) fn side(&self, side: usize) -> impl Iterator<Item = u32> {
        self.kind.side(side).map(|corner| self.nodes[corner])
    }

    /// 1 of lines, 2 of areas and shells, 3 of solids.
    pub(super) fn dimension(&self) -> u8 {
        self.kind.cell.dimension() as u8
    }
}

/// What a deck is read for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Purpose {
    /// A mesh, for bodies of a kind.
    Mesh(Bodies),
    /// A whole model, in 3D where it has solids, shells or beams.
    Model,
}

/// A named set.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Set<T> {
    /// As first written.
    pub(super) name: String,
    pub(super) members: Vec<T>,
}

/// Sets by their full names in capitals.
pub(super) type Sets<T> = BTreeMap<String, Set<T>>;

/// A surface.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Surface {
    /// Sides of elements (edges, of solids faces): element and side.
    Sides(Vec<(u32, u8)>),
    /// Nodes.
    Nodes(Vec<u32>),
    /// Straight lines of a rigid body, in the deck's unit.
    Lines(Vec<[f64; 2]>),
    /// One that embate has nothing for; what it is.
    Other(String),
}

/// Where a block stands.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) enum Scope {
    #[default]
    Root,
    /// In a part, by its name in capitals.
    Part(String),
    /// In an instance, by its name in capitals.
    Instance(String),
}

/// A rotation about an axis, by the right hand.
#[derive(Clone, Copy, Debug)]
enum Turn {
    /// About an axis along z through a point (m), by an angle (rad).
    Flat([f64; 2], f64),
    /// About an axis through a point, with its unit vector, by an angle (rad); where it is given.
    Out([f64; 3], [f64; 3], f64, Line),
}

/// A copy of a part in the assembly, or the deck outside of all parts.
#[derive(Clone, Debug, Default)]
pub(super) struct Instance {
    /// As written; empty for the deck outside of all parts.
    pub(super) name: String,
    /// Name of its part, in capitals.
    part: String,
    /// Displacement, and angle (rad) about a point, in this order.
    shift: [f64; 3],
    turn: Option<Turn>,
    /// Node and element numbers with their indices, sorted.
    nodes: Vec<(u64, u32)>,
    elements: Vec<(u64, u32)>,
}

impl Instance {
    pub(super) fn node(&self, tag: u64) -> Option<u32> {
        find(&self.nodes, tag)
    }

    pub(super) fn element(&self, tag: u64) -> Option<u32> {
        find(&self.elements, tag)
    }

    /// Indices of nodes from one number to another in steps.
    pub(super) fn nodes_between(&self, [first, last, step]: [u64; 3]) -> Vec<u32> {
        between(&self.nodes, [first, last, step])
    }

    pub(super) fn elements_between(&self, [first, last, step]: [u64; 3]) -> Vec<u32> {
        between(&self.elements, [first, last, step])
    }
}

fn find(sorted: &[(u64, u32)], tag: u64) -> Option<u32> {
    sorted.binary_search_by_key(&tag, |(tag, _)| *tag).ok().map(|place| sorted[place].1)
}

/// Goes through the numbers that are there, not through those that are announced.
fn between(sorted: &[(u64, u32)], [first, last, step]: [u64; 3]) -> Vec<u32> {
    let from = sorted.partition_point(|(tag, _)| *tag < first);
    let chosen = sorted[from..].iter().take_while(|(tag, _)| *tag <= last);
    chosen.filter(|(tag, _)| (tag - first).is_multiple_of(step.max(1))).map(|(_, index)| *index).collect()
}

/// The geometry of a deck.
#[derive(Debug, Default)]
pub(super) struct Deck {
    /// Whether its bodies are in 3D.
    pub(super) is_3d: bool,
    pub(super) nodes: Vec<Node>,
    pub(super) elements: Vec<Element>,
    /// The first is the deck outside of all parts.
    pub(super) instances: Vec<Instance>,
    pub(super) node_sets: Sets<u32>,
    pub(super) element_sets: Sets<u32>,
    pub(super) surfaces: BTreeMap<String, Set<Surface>>,
    /// Element numbers of masses, springs, rigid lines and the like, by instance and set: how many, and the
    /// first line.
    pub(super) beside: BTreeMap<String, (String, usize, Line)>,
    /// Of each node the thickness of shells there, in the deck's unit, where it is given; empty without any.
    pub(super) thicknesses: Vec<Option<f64>>,
    /// Where each block stands.
    pub(super) scopes: Vec<Scope>,
}

impl Deck {
    /// Reads the geometry of all blocks.
    pub(super) fn read(text: &Text, purpose: Purpose) -> Result<Self, Fault> {
        let mut deck = Self::default();
        deck.instances.push(Instance::default());
        deck.find_scopes(text)?;
        for instance in 0..deck.instances.len() {
            deck.read_nodes(text, instance)?;
        }
        deck.is_3d = deck.is_of_3d(text, purpose);
        if !deck.is_3d {
            deck.check_turns(text)?;
        }
        for instance in 0..deck.instances.len() {
            deck.read_elements(text, instance)?;
        }
        deck.read_sets(text)?;
        Ok(deck)
    }

    /// Whether the bodies of a deck are in 3D, by the types of its elements. Shells in a mesh are areas in
    /// 2D, unless it is meant for shells; membranes of a model where they lie in the plane.
    fn is_of_3d(&self, text: &Text, purpose: Purpose) -> bool {
        let types = text.blocks.iter().filter(|block| block.keyword == "ELEMENT" && !block.data.is_empty());
        let families: Vec<Family> = types
            .filter_map(|block| match element_kind::named(&folded(block.parameter("TYPE")?), true) {
                Found::Body(kind) => Some(kind.family),
                // Those of 2D.
                _ => None,
            })
            .collect();
        let has = |family: Family| families.contains(&family);
        match purpose {
            Purpose::Mesh(Bodies::Sheets) => true,
            Purpose::Mesh(Bodies::Highest) => has(Family::Solid),
            Purpose::Model => {
                let leaves_plane = self.nodes.iter().any(|node| node.position[2] != 0.0);
                has(Family::Solid) || has(Family::Shell) || has(Family::Beam) || (has(Family::Membrane) && leaves_plane)
            }
        }
    }

    /// Instances in 2D stay in the plane.
    fn check_turns(&self, text: &Text) -> Result<(), Fault> {
        for instance in &self.instances {
            if let Some(Turn::Out(_, _, _, line)) = instance.turn {
                let help = "bodies lie in the plane of x and y: an axis of rotation is parallel to z";
                return Err(text.fault(&DECK_MESH, line, format!("instance {} is turned out of the plane", shown(&instance.name)), help));
            }
        }
        Ok(())
    }

    /// The instances that a block is about.
    pub(super) fn instances_of(&self, block: usize) -> Vec<usize> {
        let all = 0..self.instances.len();
        match &self.scopes[block] {
            Scope::Root => vec![0],
            Scope::Part(name) => all.skip(1).filter(|at| self.instances[*at].part == *name).collect(),
            Scope::Instance(name) => all.skip(1).filter(|at| folded(&self.instances[*at].name) == *name).collect(),
        }
    }

    /// The full name, in capitals, of a name in an instance.
    pub(super) fn full(&self, instance: usize, name: &str) -> String {
        folded(&self.full_shown(instance, name))
    }

    pub(super) fn full_shown(&self, instance: usize, name: &str) -> String {
        let own = &self.instances[instance].name;
        if own.is_empty() { name.to_string() } else { format!("{own}.{name}") }
    }

    fn find_scopes(&mut self, text: &Text) -> Result<(), Fault> {
        let mut scope = Scope::Root;
        for block in &text.blocks {
            let named = || {
                block
                    .parameter("NAME")
                    .filter(|name| !name.is_empty())
                    .ok_or_else(|| text.fault(&SYNTAX, block.line, format!("*{} has no name", block.keyword), "add NAME=..."))
            };
            match block.keyword.as_str() {
                "PART" | "INSTANCE" if scope != Scope::Root => {
                    let message = format!("*{} inside of a part or instance", block.keyword);
                    return Err(text.fault(&SYNTAX, block.line, message, "end the one before with *END PART or *END INSTANCE"));
                }
                "PART" => scope = Scope::Part(folded(named()?)),
                "INSTANCE" => {
                    let instance = instance(text, block, named()?)?;
                    if self.instances.iter().any(|other| folded(&other.name) == folded(&instance.name)) {
                        return Err(text.fault(
                            &UNKNOWN,
                            block.line,
                            format!("a second instance {}", shown(&instance.name)),
                            "give it another name",
                        ));
                    }
                    scope = Scope::Instance(folded(&instance.name));
                    self.instances.push(instance);
                }
                _ => {}
            }
            self.scopes.push(scope.clone());
            if matches!(block.keyword.as_str(), "END PART" | "END INSTANCE") {
                scope = Scope::Root;
            }
            if matches!(block.keyword.as_str(), "NGEN" | "NFILL" | "ELGEN" | "NCOPY" | "ELCOPY" | "NMAP" | "SYSTEM" | "SUBMODEL") {
                let message = format!("*{} makes or moves nodes or elements, which is not read", block.keyword);
                return Err(text.fault(
                    &DECK_MESH,
                    block.line,
                    message,
                    "write the mesh with all its nodes and elements, as preprocessors do",
                ));
            }
        }
        let defined = |part: &str| self.scopes.iter().any(|scope| matches!(scope, Scope::Part(name) if name == part));
        for (block, scope) in text.blocks.iter().zip(&self.scopes) {
            if block.keyword == "INSTANCE" && matches!(scope, Scope::Instance(_)) {
                let part = block.parameter("PART").unwrap_or_default();
                if !defined(&folded(part)) {
                    return Err(text.fault(&UNKNOWN, block.line, format!("there is no part {}", shown(part)), "name a *PART of the deck"));
                }
            }
        }
        Ok(())
    }

    fn blocks_of<'a>(&'a self, text: &'a Text, instance: usize, keyword: &'a str) -> impl Iterator<Item = &'a Block> {
        text.blocks.iter().enumerate().filter(move |(_, block)| block.keyword == keyword).filter_map(move |(at, block)| {
            let mine = match &self.scopes[at] {
                Scope::Root => instance == 0,
                Scope::Part(name) => instance > 0 && self.instances[instance].part == *name,
                Scope::Instance(name) => instance > 0 && folded(&self.instances[instance].name) == *name,
            };
            mine.then_some(block)
        })
    }

    fn read_nodes(&mut self, text: &Text, instance: usize) -> Result<(), Fault> {
        let mut nodes: Vec<Node> = Vec::new();
        let mut sets: Vec<(String, Vec<u64>)> = Vec::new();
        for block in self.blocks_of(text, instance, "NODE") {
            if block.has("SYSTEM") && !block.is("SYSTEM", "R") {
                return Err(text.fault(
                    &DECK_MESH,
                    block.line,
                    "coordinates that are not rectangular",
                    "write x and y of each node, without SYSTEM",
                ));
            }
            let first = nodes.len();
            for &line in &block.data {
                let fields = text.fields(line);
                let tag = text.tag(line, fields[0], "the number of a node")?;
                let mut position = [0.0; 3];
                for (value, (field, what)) in
                    position.iter_mut().zip(fields.iter().skip(1).zip(["x of a node", "y of a node", "z of a node"]))
                {
                    *value = if field.is_empty() { 0.0 } else { text.number(line, field, what)? };
                }
                nodes.push(Node { tag, position: self.instances[instance].placed(position), line });
            }
            if let Some(set) = block.parameter("NSET") {
                sets.push((set.to_string(), nodes[first..].iter().map(|node| node.tag).collect()));
            }
        }
        if self.nodes.len() + nodes.len() > u32::MAX as usize - 1 {
            return Err(Fault::new(&DECK_MESH, text.shown_name(), "the mesh has more nodes than 32 bits can number", "use a coarser mesh"));
        }
        let first = self.nodes.len() as u32;
        let mut sorted: Vec<(u64, u32)> = (first..).zip(&nodes).map(|(index, node)| (node.tag, index)).collect();
        sorted.sort_unstable();
        if let Some(pair) = sorted.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            let line = nodes[(pair[1].1 - first) as usize].line;
            return Err(text.fault(&UNKNOWN, line, format!("a second node with the number {}", pair[0].0), "remove one of them"));
        }
        self.nodes.extend(nodes);
        self.instances[instance].nodes = sorted;
        for (name, tags) in sets {
            let members: Vec<u32> = tags.into_iter().filter_map(|tag| self.instances[instance].node(tag)).collect();
            let name = self.full_shown(instance, &name);
            extend(&mut self.node_sets, &name, members);
        }
        Ok(())
    }

    fn read_elements(&mut self, text: &Text, instance: usize) -> Result<(), Fault> {
        let mut elements: Vec<Element> = Vec::new();
        let mut sets: Vec<(String, std::ops::Range<usize>)> = Vec::new();
        let mut beside = Vec::new();
        for block in self.blocks_of(text, instance, "ELEMENT") {
            let Some(name) = block.parameter("TYPE").map(folded) else {
                return Err(text.fault(&SYNTAX, block.line, "*ELEMENT has no type", "add TYPE=..., CPE4R for example"));
            };
            let first = elements.len();
            match element_kind::named(&name, self.is_3d) {
                Found::Body(kind) => self.read_bodies(text, block, kind, instance, &mut elements)?,
                Found::Beside => {
                    beside.push((block.parameter("ELSET").unwrap_or_default().to_string(), name, block.data.len(), block.line))
                }
                Found::Refused(..) if block.data.is_empty() => {}
                Found::Refused(why, help) => return Err(text.fault(&DECK_MESH, block.line, format!("element type {name} {why}"), help)),
            }
            if let Some(set) = block.parameter("ELSET").filter(|_| elements.len() > first) {
                sets.push((set.to_string(), first..elements.len()));
            }
        }
        let first = self.elements.len() as u32;
        let mut sorted: Vec<(u64, u32)> = (first..).zip(&elements).map(|(index, element)| (element.tag, index)).collect();
        sorted.sort_unstable();
        if let Some(pair) = sorted.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            let line = elements[(pair[1].1 - first) as usize].line;
            return Err(text.fault(&UNKNOWN, line, format!("a second element with the number {}", pair[0].0), "remove one of them"));
        }
        self.elements.extend(elements);
        self.instances[instance].elements = sorted;
        for (name, range) in sets {
            let name = self.full_shown(instance, &name);
            extend(&mut self.element_sets, &name, range.map(|at| first + at as u32).collect());
        }
        for (set, kind, count, line) in beside {
            let name = self.full(instance, &set);
            self.beside.entry(name).or_insert((kind, 0, line)).1 += count;
        }
        Ok(())
    }

    fn read_bodies(
        &self,
        text: &Text,
        block: &Block,
        kind: &'static ElementKind,
        instance: usize,
        elements: &mut Vec<Element>,
    ) -> Result<(), Fault> {
        let mut lines = block.data.iter();
        while let Some(&line) = lines.next() {
            let mut fields = text.fields(line);
            let mut last = line;
            while fields.len() <= kind.nodes_in_deck && text.continues(last) {
                let Some(&next) = lines.next() else { break };
                fields.extend(text.fields(next));
                last = next;
            }
            let count = kind.nodes_in_deck;
            if fields.len() != count + 1 {
                let message = format!("an element {} of {} numbers; it has a number and {count} nodes", kind.name, fields.len());
                let help = match kind.family {
                    Family::Beam => "leave a third node out, and give the direction n1 in the second line of *BEAM SECTION",
                    _ => "look at the type of the elements, and at the line",
                };
                return Err(text.fault(&SYNTAX, line, message, help));
            }
            let tag = text.tag(line, fields[0], "the number of an element")?;
            let mut nodes = [0; MOST_NODES];
            for (k, field) in fields[1..=kind.nodes()].iter().enumerate() {
                let node = text.tag(line, field, "a node of an element")?;
                nodes[k] = self.instances[instance].node(node).ok_or_else(|| {
                    let message = format!("element {tag} needs node {node}, which is not there");
                    text.fault(&UNKNOWN, line, message, "each part has its own nodes; look for the number in *NODE")
                })?;
                if nodes[..k].contains(&nodes[k]) {
                    let help = "a triangle is an element of three nodes, CPE3 for example; a wedge is a C3D6, a tetrahedron a C3D4";
                    return Err(text.fault(&UNKNOWN, line, format!("element {tag} has node {node} twice"), help));
                }
            }
            elements.push(Element { kind, tag, nodes, line });
        }
        Ok(())
    }
}

/// Adds members to a set, each once and in the order of their first mention.
pub(super) fn extend<T: Copy + Ord>(sets: &mut Sets<T>, name: &str, members: Vec<T>) {
    let set = sets.entry(folded(name)).or_insert_with(|| Set { name: name.to_string(), members: Vec::new() });
    let mut known: std::collections::BTreeSet<T> = set.members.iter().copied().collect();
    set.members.extend(members.into_iter().filter(|member| known.insert(*member)));
}

impl Instance {
    fn placed(&self, position: [f64; 3]) -> [f64; 3] {
        // Zeros are not added: a position without a shift keeps its bits, the sign of zero included.
        let [mut x, mut y, mut z] = position;
        if self.shift != [0.0; 3] {
            (x, y, z) = (x + self.shift[0], y + self.shift[1], z + self.shift[2]);
        }
        match self.turn {
            None => [x, y, z],
            Some(Turn::Flat([cx, cy], angle)) => {
                let (sin, cos) = sin_cos(angle);
                let (dx, dy) = (x - cx, y - cy);
                [cx + cos * dx - sin * dy, cy + sin * dx + cos * dy, z]
            }
            Some(Turn::Out(point, n, angle, _)) => {
                // After Rodrigues.
                let (sin, cos) = sin_cos(angle);
                let d: [f64; 3] = std::array::from_fn(|k| [x, y, z][k] - point[k]);
                let along = (1.0 - cos) * (n[0] * d[0] + n[1] * d[1] + n[2] * d[2]);
                let across = [n[1] * d[2] - n[2] * d[1], n[2] * d[0] - n[0] * d[2], n[0] * d[1] - n[1] * d[0]];
                std::array::from_fn(|k| point[k] + (cos * d[k] + (sin * across[k] + along * n[k])))
            }
        }
    }
}

/// Sine and cosine; of quarter turns exact.
fn sin_cos(angle: f64) -> (f64, f64) {
    match (angle / std::f64::consts::FRAC_PI_2).rem_euclid(4.0) {
        0.0 => (0.0, 1.0),
        1.0 => (1.0, 0.0),
        2.0 => (0.0, -1.0),
        3.0 => (-1.0, 0.0),
        _ => angle.sin_cos(),
    }
}

/// Reads *INSTANCE: the first data line is a displacement, the second two points of an axis and an angle in
/// degrees.
fn instance(text: &Text, block: &Block, name: &str) -> Result<Instance, Fault> {
    let mut instance =
        Instance { name: name.to_string(), part: folded(block.parameter("PART").unwrap_or_default()), ..Instance::default() };
    let numbers = |line: Line, count: usize| -> Result<Vec<f64>, Fault> {
        let fields = text.fields(line);
        let number = |at: usize| match fields.get(at) {
            Some(field) if !field.is_empty() => text.number(line, field, "a number of the instance's place"),
            _ => Ok(0.0),
        };
        (0..count).map(number).collect()
    };
    if let Some(&line) = block.data.first() {
        let shift = numbers(line, 3)?;
        instance.shift = [shift[0], shift[1], shift[2]];
    }
    if let Some(&line) = block.data.get(1) {
        let it = numbers(line, 7)?;
        let axis = [it[3] - it[0], it[4] - it[1], it[5] - it[2]];
        let size = (axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]).sqrt();
        if it[6] != 0.0 && !(size > 0.0 && size.is_finite()) {
            let help = "give two points of the axis and an angle in degrees";
            return Err(text.fault(&DECK_MESH, line, format!("instance {} is turned about an axis without direction", shown(name)), help));
        }
        let radians = |degrees: f64| {
            if degrees % 90.0 == 0.0 { degrees / 90.0 * std::f64::consts::FRAC_PI_2 } else { degrees.to_radians() }
        };
        let is_flat = axis[0] == 0.0 && axis[1] == 0.0;
        instance.turn = (it[6] != 0.0).then(|| match is_flat {
            true => Turn::Flat([it[0], it[1]], radians(it[6] * axis[2].signum())),
            false => Turn::Out([it[0], it[1], it[2]], axis.map(|a| a / size), radians(it[6]), line),
        });
    }
    Ok(instance)
}
