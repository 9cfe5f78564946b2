//! Makes the model file of what an import has read: run, materials, parts, and the text itself. What acts on
//! parts is in `write_conditions.rs`.

use super::material::Material;
use super::report::Outcome::{Ignored, Used};
use super::section::Section;
use super::units::number;
use super::{Importer, MESH_NAME};
use crate::abaqus::deck::Element;
use crate::abaqus::element_kind::{ElementKind, Family};
use crate::abaqus::messages::{INCOMPLETE, NO_COUNTERPART, UNKNOWN};
use crate::abaqus::text::{folded, shown};
use embate_solver::error::Fault;
use embate_solver::mesh::cell::CellKind;
use embate_solver::quantity::Dimension;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// A part of the model: the elements of a section.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub(super) at: usize,
    pub(super) name: String,
    material: String,
    group: String,
    element: Option<&'static str>,
    pub(super) state: &'static str,
    /// By which what is per unit of depth is to be multiplied.
    pub(super) depth: f64,
    /// Keys of its section, each in a line.
    keys: String,
    pub(super) elements: BTreeSet<u32>,
    pub(super) nodes: BTreeSet<u32>,
}

/// What the model file is made of, besides what is read.
#[derive(Debug, Default)]
pub(super) struct Writing {
    pub(super) out: String,
    pub(super) parts: Vec<Part>,
    /// Curves by name, with their text.
    pub(super) curves: BTreeMap<String, String>,
    /// Names that are taken: groups of the mesh, parts.
    taken: BTreeSet<String>,
}

/// A text in quotes.
pub(crate) fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

/// A name of letters, digits, `_` and `-`.
pub(super) fn plain(name: &str) -> String {
    let plain: String = name.chars().map(|c| if c.is_ascii_alphanumeric() || matches!(c, '_' | '-') { c } else { '_' }).take(50).collect();
    if plain.is_empty() { "nameless".into() } else { plain }
}

/// The name, or the name with the first number from 2, that `taken` lacks.
pub(crate) fn free(name: &str, taken: &BTreeSet<String>) -> String {
    let numbered = (2..).map(|number| format!("{name}-{number}"));
    std::iter::once(name.to_string()).chain(numbered).find(|name| !taken.contains(name)).unwrap_or_default()
}

impl Importer<'_> {
    /// The text of the model file.
    pub(super) fn write(&mut self) -> Result<String, Fault> {
        let mut w = Writing { taken: self.group_names(), ..Writing::default() };
        let _ =
            writeln!(w.out, "# Made from {} by `embate import`; import.txt lists what became of each keyword.\n", self.text.shown_name());
        if !self.title.is_empty() {
            let _ = writeln!(w.out, "title = {}\n", quoted(&self.title));
        }
        self.write_run(&mut w)?;
        self.make_parts(&mut w)?;
        self.write_materials(&mut w)?;
        self.write_parts(&mut w)?;
        self.write_contacts(&mut w);
        self.write_obstacles(&mut w);
        self.write_constraints(&mut w);
        self.write_loads(&mut w);
        for (name, text) in &w.curves {
            let _ = writeln!(w.out, "[curve.{name}]\n{text}");
        }
        while w.out.ends_with("\n\n") {
            w.out.pop();
        }
        Ok(w.out)
    }

    fn group_names(&self) -> BTreeSet<String> {
        let others = [&self.names.surfaces, &self.names.nodes].into_iter().flat_map(|names| names.values());
        self.names.elements.values().chain(others).cloned().collect()
    }

    fn write_run(&mut self, w: &mut Writing) -> Result<(), Fault> {
        let Some(end) = self.end else {
            let help = "add *STEP, *DYNAMIC, EXPLICIT with a time, *END STEP; static steps have no counterpart";
            return Err(Fault::new(&INCOMPLETE, self.text.shown_name(), "the deck has no *DYNAMIC step, so no end of the run", help));
        };
        let _ = writeln!(w.out, "[run]\nend = {}", self.units.write(end, Dimension::TIME));
        let step = self.text.blocks.iter().position(|block| block.keyword == "DYNAMIC" && block.has("EXPLICIT"));
        let step = step.filter(|_| self.bulk_viscosity.is_none() && self.has_solids());
        if let Some(at) = step {
            self.bulk_viscosity = Some([0.06, 1.2]);
            self.note(at, Used, "`run.bulk_viscosity` is [0.06, 1.2], what Abaqus takes where a deck says nothing");
        }
        if let (Some(asked), Some(at), false) = (self.bulk_viscosity.filter(|it| *it != [0.0; 2]), self.step_at, self.has_solids()) {
            self.note(at, Used, &format!("bulk viscosity {asked:?} is left out: it does not act on shells and beams"));
        } else if let Some([linear, quadratic]) = self.bulk_viscosity
            && [linear, quadratic] != [0.0; 2]
        {
            let _ = writeln!(w.out, "bulk_viscosity = [{}, {}]", number(linear), number(quadratic));
        }
        w.out.push('\n');
        Ok(())
    }

    /// Whether some elements are neither shells nor beams.
    fn has_solids(&self) -> bool {
        self.deck.elements.iter().any(|element| matches!(element.kind.family, Family::Plane(_) | Family::Solid))
    }

    fn make_parts(&mut self, w: &mut Writing) -> Result<(), Fault> {
        if self.sections.is_empty() {
            let help = "add *SOLID SECTION, ELSET=..., MATERIAL=... for each body";
            return Err(Fault::new(&INCOMPLETE, self.text.shown_name(), "no element has a section, so the model has no parts", help));
        }
        let mut owned = vec![false; self.deck.elements.len()];
        for section in self.sections.clone() {
            let part = self.part(&section, w)?;
            for &element in &part.elements {
                if std::mem::replace(&mut owned[element as usize], true) {
                    let message = format!("element {} has two sections", self.deck.elements[element as usize].tag);
                    let help = "an element belongs to one section";
                    return Err(self.text.fault(&NO_COUNTERPART, self.block(section.at).line, message, help));
                }
            }
            w.parts.push(part);
        }
        let without = owned.iter().filter(|owned| !**owned).count();
        if without > 0 {
            let first = self.text.blocks.iter().position(|block| block.keyword == "ELEMENT").unwrap_or_default();
            self.note(first, Ignored, &format!("{without} elements have no section: they are no part of the model"));
        }
        if !self.is_3d() && w.parts.iter().any(|part| part.depth != w.parts[0].depth) {
            let at = w.parts[0].at;
            self.note(
                at,
                Ignored,
                "sections have different thicknesses: each part is computed per unit of depth, so \
                those of different thickness don't fit together",
            );
        }
        Ok(())
    }

    fn part(&mut self, section: &Section, w: &mut Writing) -> Result<Part, Fault> {
        let line = self.block(section.at).line;
        let Some(set) = self.deck.element_sets.get(&section.set) else {
            return Err(self.text.fault(
                &UNKNOWN,
                line,
                format!("there is no element set {}", shown(&section.set)),
                "name a set with elements",
            ));
        };
        let Some(material) = self.materials.iter().find(|it| folded(&it.name) == section.material).map(|it| it.name.clone()) else {
            let message = format!("there is no material {}", shown(&section.material));
            return Err(self.text.fault(&UNKNOWN, line, message, "name a *MATERIAL of the deck"));
        };
        let elements: BTreeSet<u32> = set.members.iter().copied().collect();
        let kinds: BTreeMap<&str, _> =
            elements.iter().map(|at| self.deck.elements[*at as usize].kind).map(|kind| (kind.name, kind)).collect();
        if let Some(kind) = kinds.values().find(|kind| !section.body.fits(kind.family)) {
            let message = format!("set {} has elements {}, which have no *{}", shown(&set.name), kind.name, self.block(section.at).keyword);
            let help = "give solids a *SOLID SECTION, shells a *SHELL SECTION, membranes a *MEMBRANE SECTION, beams a *BEAM SECTION";
            return Err(self.text.fault(&NO_COUNTERPART, line, message, help));
        }
        let dimension = elements.first().map_or(2, |at| self.deck.elements[*at as usize].dimension());
        let group = self.names.elements.get(&(section.set.clone(), dimension)).cloned().unwrap_or_default();
        let others: BTreeSet<String> = w.taken.iter().filter(|name| **name != group).cloned().collect();
        let name = free(&plain(&set.name), &others);
        w.taken.insert(name.clone());
        let states: BTreeSet<&str> = kinds.values().map(|kind| kind.state()).collect();
        if states.len() > 1 {
            let message =
                format!("set {} mixes elements of {}", shown(&set.name), states.iter().copied().collect::<Vec<_>>().join(" and "));
            return Err(self.text.fault(&NO_COUNTERPART, line, message, "give each stress state a section of its own"));
        }
        let nodes = elements.iter().flat_map(|at| self.deck.elements[*at as usize].nodes()).copied().collect();
        let members: Vec<Element> = elements.iter().map(|at| self.deck.elements[*at as usize]).collect();
        let keys = self.section_keys(section, &members)?;
        let part = Part {
            at: section.at,
            name,
            material,
            group,
            element: None,
            state: states
                .first()
                .copied()
                .and_then(|state| kinds.values().map(|kind| kind.state()).find(|it| *it == state))
                .unwrap_or("plane_strain"),
            depth: section.depth,
            keys,
            elements,
            nodes,
        };
        let element = self.element(&part, &kinds);
        Ok(Part { element, ..part })
    }

    /// The element of the quadrilaterals or hexahedra of a part, if it is not the usual one; what differs is
    /// noted. Triangles, wedges and tetrahedra are the usual ones.
    fn element(&mut self, part: &Part, kinds: &BTreeMap<&str, &'static ElementKind>) -> Option<&'static str> {
        if let Some(kind) = kinds.values().find(|kind| kind.family.has_faces() || kind.family == Family::Beam) {
            for kind in kinds.values().filter(|kind| !kind.differs.is_empty()) {
                self.approximated(
                    part.at,
                    &format!("part {}: {} are computed as {}: {}", part.name, kind.name, kind.element, kind.differs),
                );
            }
            let quadrilaterals = kinds.values().find(|kind| kind.cell == CellKind::Quadrilateral);
            return Some(quadrilaterals.map_or(kind.element, |kind| kind.element));
        }
        let (largest, usual, of) = if self.is_3d() { (CellKind::Hexahedron, "hex8", 3) } else { (CellKind::Quadrilateral, "quad4", 2) };
        let known = |name: &str| embate_solver::element::elements_of(of).iter().any(|kind| kind.name == name);
        let mut largest = kinds.values().filter(|kind| kind.cell == largest);
        let first = largest.next().copied();
        for other in largest {
            self.approximated(
                part.at,
                &format!("part {}: {} are computed as the others, {}", part.name, other.name, first.map_or("", |it| it.name)),
            );
        }
        for kind in kinds.values().filter(|kind| !kind.differs.is_empty() && known(kind.element)) {
            self.approximated(part.at, &format!("part {}: {}: {}", part.name, kind.name, kind.differs));
        }
        if let Some(kind) = first
            && !known(kind.element)
        {
            let text = format!(
                "part {}: {} are computed as {usual}, with full integration and mean dilatation: stiffer and without hourglass modes",
                part.name, kind.name
            );
            self.approximated(part.at, &text);
        }
        first.map(|kind| kind.element).filter(|name| known(name) && *name != usual)
    }

    fn write_materials(&mut self, w: &mut Writing) -> Result<(), Fault> {
        for material in self.materials.clone() {
            let at = self
                .text
                .blocks
                .iter()
                .position(|block| block.keyword == "MATERIAL" && block.parameter("NAME").map(folded) == Some(folded(&material.name)));
            let at = at.unwrap_or_default();
            if !w.parts.iter().any(|part| part.material == material.name) {
                self.note(at, Ignored, &format!("no section has the material {}; it is not in the model", material.name));
                continue;
            }
            let Some(density) = material.density else {
                let message = format!("material {} has no density", shown(&material.name));
                return Err(self.text.fault(
                    &INCOMPLETE,
                    self.block(at).line,
                    message,
                    "add *DENSITY: an explicit computation needs masses",
                ));
            };
            let law = self.law(at, &material)?;
            let density = self.units.write(density, Dimension::DENSITY);
            let _ = writeln!(w.out, "[material.{}]\ndensity = {density}\n{law}", plain(&material.name));
        }
        Ok(())
    }

    fn law(&mut self, at: usize, material: &Material) -> Result<String, Fault> {
        let units = self.units.clone();
        let pressure = |value: f64| units.write(value, Dimension::PRESSURE);
        if let Some([c10, c01, bulk]) = material.rubber {
            let shear = 2.0 * (c10 + c01);
            return Ok(if c01 == 0.0 {
                let young = 9.0 * bulk * shear / (3.0 * bulk + shear);
                let poisson = (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear));
                format!("law = \"neo_hookean\"\nyoung = {}\npoisson = {}\n", pressure(young), number(poisson))
            } else {
                format!("law = \"mooney_rivlin\"\nc10 = {}\nc01 = {}\nbulk = {}\n", pressure(c10), pressure(c01), pressure(bulk))
            });
        }
        let Some([young, poisson]) = material.elastic else {
            let message = format!("material {} has neither *ELASTIC nor *HYPERELASTIC", shown(&material.name));
            return Err(self.text.fault(&INCOMPLETE, self.block(at).line, message, "give it one of them"));
        };
        let elastic = format!("young = {}\npoisson = {}\n", pressure(young), number(poisson));
        Ok(match material.plastic.as_slice() {
            [] => format!("law = \"elastic\"\n{elastic}"),
            [[stress, _]] => format!("law = \"j2\"\n{elastic}yield = {}\n", pressure(*stress)),
            [[first, _], [second, strain]] if second >= first => {
                let text = format!(
                    "material {}: hardening continues with the same slope beyond the plastic strain {}",
                    material.name,
                    number(*strain)
                );
                self.approximated(at, &text);
                format!("law = \"j2\"\n{elastic}yield = {}\nhardening = {}\n", pressure(*first), pressure((second - first) / strain))
            }
            rows => {
                let strains: Vec<String> = rows.iter().map(|row| number(row[1])).collect();
                let stresses: Vec<String> = rows.iter().map(|row| pressure(row[0])).collect();
                format!("law = \"j2_table\"\n{elastic}plastic_strain = [{}]\nstress = [{}]\n", strains.join(", "), stresses.join(", "))
            }
        })
    }

    fn write_parts(&mut self, w: &mut Writing) -> Result<(), Fault> {
        let scale = if self.units.is_si() { String::new() } else { format!(", scale = {}", self.units.write(1.0, Dimension::LENGTH)) };
        for part in w.parts.clone() {
            let group = quoted(&part.group);
            let mesh = format!("{{ file = \"{MESH_NAME}\", group = {group}{scale} }}");
            let _ = writeln!(w.out, "[[part]]\nname = \"{}\"\nmaterial = \"{}\"\nmesh = {mesh}", part.name, plain(&part.material));
            if let Some(element) = part.element {
                let _ = writeln!(w.out, "element = \"{element}\"");
            }
            if !matches!(part.state, "" | "plane_strain") {
                let _ = writeln!(w.out, "stress_state = \"{}\"", part.state);
            }
            w.out.push_str(&part.keys);
            let rigid = self.rigid_of(&part, w);
            if let Some((_, text)) = &rigid {
                let _ = writeln!(w.out, "rigid = {text}");
            }
            if let Some(velocity) = self.velocity(&part, rigid.map(|(reference, _)| reference)) {
                let velocity = self.vector(velocity, |value| self.units.write(value, Dimension::VELOCITY));
                let _ = writeln!(w.out, "velocity = {velocity}");
            }
            w.out.push('\n');
        }
        Ok(())
    }

    /// The initial velocity of a part, if it is one and not zero.
    fn velocity(&mut self, part: &Part, reference: Option<u32>) -> Option<[f64; 3]> {
        if let Some(velocity) = reference.and_then(|node| self.velocities.get(&node)) {
            return Some(*velocity);
        }
        let at = *self.velocity_blocks.first()?;
        let mut all: Vec<[f64; 3]> = part.nodes.iter().map(|node| self.velocities.get(node).copied().unwrap_or_default()).collect();
        all.dedup();
        if let [velocity] = all.as_slice() {
            return (*velocity != [0.0; 3]).then_some(*velocity);
        }
        // Parts that share nodes with a moving one have a few moving nodes.
        let text = format!("part {}: its nodes don't begin with one velocity; it begins at rest (a spin is the key `spin`)", part.name);
        self.note(at, Ignored, &text);
        None
    }

    /// The reference node and the motion of a part that is rigid.
    fn rigid_of(&mut self, part: &Part, w: &mut Writing) -> Option<(u32, String)> {
        for rigid in self.rigid.clone() {
            let inside = part.elements.iter().filter(|element| rigid.elements.contains(element)).count();
            if inside == part.elements.len() {
                let motion = self.motion_of(rigid.reference, w);
                let fixed: Vec<String> = ["x", "y", "z", "rotation"]
                    .iter()
                    .zip(&motion)
                    .filter_map(|(axis, it)| it.as_ref().map(|it| format!("{axis} = {it}")))
                    .collect();
                if motion[3].as_deref() != Some("0") && motion[..3].iter().any(Option::is_some) {
                    self.approximated(rigid.at, "what is prescribed at the reference node holds for the centre of mass");
                }
                return Some((rigid.reference, if fixed.is_empty() { "true".into() } else { format!("{{ {} }}", fixed.join(", ")) }));
            }
            if inside > 0 {
                let text = format!("only some elements of part {} are rigid; the part deforms as a whole", part.name);
                self.note(rigid.at, Ignored, &text);
            }
        }
        None
    }
}
