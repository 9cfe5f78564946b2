//! Sets and surfaces of a deck, in the order of the file: *NSET, *ELSET, *SURFACE, and the
//! thicknesses at nodes.
//!
//! Part of [`Deck`]; what they name must stand above them. Members are indices into the deck's nodes and
//! elements.

use super::deck::{Deck, Scope, Set, Surface, extend};
use super::element_kind::{Family, LOWER, UPPER};
use super::text::{Block, Line, Text, folded, shown};
use crate::abaqus::messages::{SYNTAX, UNKNOWN};
use embate_solver::error::Fault;
use std::collections::BTreeMap;

const ABOVE: &str = "name a set that is defined above this line, or a number; outside of a part it is INSTANCE.SET";

impl Deck {
    pub(super) fn read_sets(&mut self, text: &Text) -> Result<(), Fault> {
        for (at, block) in text.blocks.iter().enumerate() {
            match block.keyword.as_str() {
                "NSET" | "ELSET" => {
                    let of_nodes = block.keyword == "NSET";
                    for (named_in, looked_in) in self.homes(text, at, block)? {
                        self.read_set(text, block, of_nodes, named_in, looked_in)?;
                    }
                }
                "NODAL THICKNESS" => {
                    for instance in self.instances_of(at) {
                        self.read_thicknesses(text, block, instance)?;
                    }
                }
                "SURFACE" => {
                    for instance in self.instances_of(at) {
                        self.read_surface(text, block, instance)?;
                    }
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Instances in which a set gets its name and in which its members are looked for.
    fn homes(&self, text: &Text, at: usize, block: &Block) -> Result<Vec<(usize, usize)>, Fault> {
        if let (Some(name), Scope::Root) = (block.parameter("INSTANCE"), &self.scopes[at]) {
            let found = self.instances.iter().position(|it| !it.name.is_empty() && folded(&it.name) == folded(name));
            let instance = found.ok_or_else(|| {
                text.fault(&UNKNOWN, block.line, format!("there is no instance {}", shown(name)), "name an *INSTANCE of the assembly")
            })?;
            return Ok(vec![(0, instance)]);
        }
        Ok(self.instances_of(at).into_iter().map(|instance| (instance, instance)).collect())
    }

    fn read_set(&mut self, text: &Text, block: &Block, of_nodes: bool, named_in: usize, looked_in: usize) -> Result<(), Fault> {
        let Some(name) = block.parameter(&block.keyword).filter(|name| !name.is_empty()) else {
            return Err(text.fault(&SYNTAX, block.line, format!("*{} has no name", block.keyword), format!("add {}=...", block.keyword)));
        };
        let mut members = Vec::new();
        if of_nodes && let Some(elements) = block.parameter("ELSET") {
            for element in self.elements_named(text, block.line, looked_in, elements)? {
                members.extend(self.elements[element as usize].nodes());
            }
        }
        for &line in &block.data {
            let fields = text.fields(line);
            if block.has("GENERATE") {
                let [first, last] = [0, 1].map(|at| fields.get(at).copied().unwrap_or_default());
                let first = text.tag(line, first, "the first number")?;
                let last = text.tag(line, last, "the last number")?;
                let step = fields.get(2).filter(|field| !field.is_empty()).map_or(Ok(1), |field| text.tag(line, field, "the step"))?;
                let instance = &self.instances[looked_in];
                let range = [first, last, step];
                members.extend(if of_nodes { instance.nodes_between(range) } else { instance.elements_between(range) });
                continue;
            }
            for field in fields.into_iter().filter(|field| !field.is_empty()) {
                members.extend(if of_nodes {
                    self.nodes_named(text, line, looked_in, field)?
                } else {
                    self.elements_named(text, line, looked_in, field)?
                });
            }
        }
        let name = self.full_shown(named_in, name);
        extend(if of_nodes { &mut self.node_sets } else { &mut self.element_sets }, &name, members);
        Ok(())
    }

    /// Reads *NODAL THICKNESS: nodes or node sets, each with the thickness there.
    fn read_thicknesses(&mut self, text: &Text, block: &Block, instance: usize) -> Result<(), Fault> {
        self.thicknesses.resize(self.nodes.len(), None);
        for &line in &block.data {
            let fields = text.fields(line);
            let thickness = text.number(line, fields.get(1).copied().unwrap_or_default(), "the thickness at a node")?;
            for node in self.nodes_named(text, line, instance, fields[0])? {
                self.thicknesses[node as usize] = Some(thickness);
            }
        }
        Ok(())
    }

    /// The nodes of a set, or the node of a number, as seen from an instance.
    pub(super) fn nodes_named(&self, text: &Text, line: Line, instance: usize, name: &str) -> Result<Vec<u32>, Fault> {
        if let Ok(tag) = name.parse::<u64>() {
            let node = self.instances[instance].node(tag);
            return node
                .map(|node| vec![node])
                .ok_or_else(|| text.fault(&UNKNOWN, line, format!("there is no node {tag}"), "look for the number in *NODE"));
        }
        for name in [self.full(instance, name), folded(name)] {
            if let Some(set) = self.node_sets.get(&name) {
                return Ok(set.members.clone());
            }
            if let Some(node) = self.numbered(&name).and_then(|(at, tag)| self.instances[at].node(tag)) {
                return Ok(vec![node]);
            }
        }
        Err(text.fault(&UNKNOWN, line, format!("there is no node set {}", shown(name)), ABOVE))
    }

    /// The elements of a set, or the element of a number; empty for masses, springs and the like.
    pub(super) fn elements_named(&self, text: &Text, line: Line, instance: usize, name: &str) -> Result<Vec<u32>, Fault> {
        if let Ok(tag) = name.parse::<u64>() {
            return match self.instances[instance].element(tag) {
                Some(element) => Ok(vec![element]),
                None if !self.beside.is_empty() => Ok(Vec::new()),
                None => Err(text.fault(&UNKNOWN, line, format!("there is no element {tag}"), "look for the number in *ELEMENT")),
            };
        }
        for name in [self.full(instance, name), folded(name)] {
            if let Some(set) = self.element_sets.get(&name) {
                return Ok(set.members.clone());
            }
            if self.beside.contains_key(&name) {
                return Ok(Vec::new());
            }
            if let Some(element) = self.numbered(&name).and_then(|(at, tag)| self.instances[at].element(tag)) {
                return Ok(vec![element]);
            }
        }
        Err(text.fault(&UNKNOWN, line, format!("there is no element set {}", shown(name)), ABOVE))
    }

    /// `INSTANCE.12`: the instance and the number.
    fn numbered(&self, name: &str) -> Option<(usize, u64)> {
        let (instance, tag) = name.rsplit_once('.')?;
        let at = self.instances.iter().skip(1).position(|it| folded(&it.name) == instance)?;
        Some((at + 1, tag.parse().ok()?))
    }

    fn read_surface(&mut self, text: &Text, block: &Block, instance: usize) -> Result<(), Fault> {
        let Some(name) = block.parameter("NAME").filter(|name| !name.is_empty()) else {
            return Err(text.fault(&SYNTAX, block.line, "*SURFACE has no name", "add NAME=..."));
        };
        let surface = match block.parameter("TYPE").map_or("ELEMENT".into(), folded).as_str() {
            _ if block.has("COMBINE") || block.has("CROP") => Surface::Other("made of other surfaces".into()),
            "ELEMENT" => self.sides(text, block, instance)?,
            "NODE" => {
                let mut nodes = Vec::new();
                for &line in &block.data {
                    nodes.extend(self.nodes_named(text, line, instance, text.fields(line)[0])?);
                }
                Surface::Nodes(nodes)
            }
            "SEGMENTS" => segments(text, block)?,
            other => Surface::Other(format!("of the type {other}")),
        };
        let name = self.full_shown(instance, name);
        match self.surfaces.entry(folded(&name)) {
            std::collections::btree_map::Entry::Occupied(_) => {
                Err(text.fault(&UNKNOWN, block.line, format!("a second surface {}", shown(&name)), "give it another name"))
            }
            std::collections::btree_map::Entry::Vacant(entry) => {
                entry.insert(Set { name, members: vec![surface] });
                Ok(())
            }
        }
    }

    /// Sides of elements: `set, S1` is one side of each, `set` alone those that belong to one element of the
    /// deck only, of shells in 3D both faces, `,` all of these.
    fn sides(&self, text: &Text, block: &Block, instance: usize) -> Result<Surface, Fault> {
        let mut sides = Vec::new();
        let mut counts = None;
        for &line in &block.data {
            let fields = text.fields(line);
            let face = fields.get(1).copied().unwrap_or_default();
            let elements = match fields[0] {
                "" => (0..self.elements.len() as u32).collect(),
                name => self.elements_named(text, line, instance, name)?,
            };
            for element in elements {
                if face.is_empty() {
                    let counts = counts.get_or_insert_with(|| self.side_counts());
                    let it = &self.elements[element as usize];
                    let is_free = |side: &usize| counts.get(&key(it.side(*side))) == Some(&1);
                    let count = if it.kind.family.has_faces() { 2 } else { it.kind.sides() };
                    let free = (0..count).filter(|side| it.kind.family.has_faces() || is_free(side));
                    sides.extend(free.map(|side| (element, side as u8)));
                } else {
                    sides.push((element, self.face(text, line, element, face)?));
                }
            }
        }
        sides.sort_unstable();
        sides.dedup();
        Ok(Surface::Sides(sides))
    }

    /// The side, from 0, that S1, P1, E1, SPOS and so on stand for; of shells in 3D S1 is SNEG, S2 is SPOS,
    /// and S3 the first edge, as CalculiX has it.
    pub(super) fn face(&self, text: &Text, line: Line, element: u32, face: &str) -> Result<u8, Fault> {
        let kind = self.elements[element as usize].kind;
        let word = folded(face);
        let numbered = |letters: &[char]| word.strip_prefix(letters).and_then(|number| number.parse::<u8>().ok());
        let has_faces = kind.family.has_faces();
        let found = match word.as_str() {
            "SPOS" if has_faces => Some(UPPER),
            "SNEG" if has_faces => Some(LOWER),
            _ if has_faces => match (numbered(&['S']), numbered(&['E'])) {
                (Some(1), _) => Some(LOWER),
                (Some(2), _) => Some(UPPER),
                (Some(number @ 3..), _) => Some(number - 1),
                (_, Some(number @ 1..=10)) => Some(number + 1),
                _ => None,
            },
            _ => numbered(if kind.has_named_edges() { &['E'] } else { &['S', 'P'] }).and_then(|number| number.checked_sub(1)),
        };
        found.filter(|side| *side < kind.sides() as u8).ok_or_else(|| {
            let (side, help) = match (kind.sides(), has_faces) {
                (0, _) => ("side", "beams have none".to_string()),
                (2, true) => ("face", "its faces are SPOS and SNEG".to_string()),
                (count, true) => ("side", format!("its faces are SPOS and SNEG, its edges E1 to E{}", count - 2)),
                (count, _) => {
                    let side = if kind.family == Family::Solid { "face" } else { "edge" };
                    let letter = if kind.has_named_edges() { 'E' } else { 'S' };
                    (side, format!("its {side}s are {letter}1 to {letter}{count}"))
                }
            };
            text.fault(&SYNTAX, line, format!("an element {} has no {side} {}", kind.name, shown(face)), help)
        })
    }

    /// How many elements have each side.
    fn side_counts(&self) -> BTreeMap<[u32; 4], u32> {
        let mut counts = BTreeMap::new();
        for element in self.elements.iter().filter(|element| !element.kind.family.has_faces()) {
            for side in 0..element.kind.sides() {
                *counts.entry(key(element.side(side))).or_insert(0) += 1;
            }
        }
        counts
    }
}

/// The nodes of a side in ascending order, filled up with the largest number.
fn key(nodes: impl Iterator<Item = u32>) -> [u32; 4] {
    let mut key = [u32::MAX; 4];
    key.iter_mut().zip(nodes).for_each(|(own, node)| *own = node);
    key.sort_unstable();
    key
}

/// Points of a rigid surface of straight lines.
fn segments(text: &Text, block: &Block) -> Result<Surface, Fault> {
    let mut points = Vec::new();
    for &line in &block.data {
        let fields = text.fields(line);
        let word = folded(fields[0]);
        if !matches!(word.as_str(), "START" | "LINE") {
            return Ok(Surface::Other(format!("with the segment {word}; only straight lines are read")));
        }
        let number = |at: usize| text.number(line, fields.get(at).copied().unwrap_or_default(), "a coordinate of a segment");
        points.push([number(1)?, number(2)?]);
    }
    if points.len() < 2 || block.has("FILLET RADIUS") {
        return Ok(Surface::Other("with rounded corners or without lines".into()));
    }
    Ok(Surface::Lines(points))
}
