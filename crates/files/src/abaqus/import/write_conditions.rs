//! Makes the sections of the model file that act on parts: contacts, obstacles, constraints, loads, and the
//! curves that they follow.

use super::Importer;
use super::condition::{Boundary, Load, Prescribed};
use super::contact::{Contact, Interaction};
use super::report::Outcome::Ignored;
use super::units::number;
use super::write::{Part, Writing, free, plain, quoted};
use crate::abaqus::deck::Surface;
use embate_solver::quantity::Dimension;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

const FORCE: Dimension = Dimension::FORCE;

impl Importer<'_> {
    /// The name of the curve that is an amplitude times a factor; `None` (and a note) if there is no such
    /// amplitude.
    fn curve(&mut self, at: usize, amplitude: &str, factor: f64, dimension: Dimension, w: &mut Writing) -> Option<String> {
        let Some(it) = self.amplitudes.get(amplitude) else {
            self.note(at, Ignored, &format!("there is no amplitude {amplitude} that is read, so what follows it does not act"));
            return None;
        };
        let units = &self.units;
        let times: Vec<String> = it.times.iter().map(|time| units.write(*time, Dimension::TIME)).collect();
        let values: Vec<String> = it.values.iter().map(|value| units.write(value * factor, dimension)).collect();
        let smooth = if it.smooth { "between = \"smooth_steps\"\n" } else { "" };
        let text = format!("time = [{}]\nvalue = [{}]\n{smooth}", times.join(", "), values.join(", "));
        if let Some((name, _)) = w.curves.iter().find(|(_, known)| **known == text) {
            return Some(name.clone());
        }
        let own = plain(&it.name);
        let own = if own.starts_with(|c: char| c.is_alphabetic()) { own } else { format!("curve-{own}") };
        let name = free(&own, &w.curves.keys().cloned().collect());
        w.curves.insert(name.clone(), text);
        Some(name)
    }

    /// The keys of an interaction.
    fn write_interaction(&mut self, name: Option<&str>, at: usize, w: &mut Writing) {
        let Some(name) = name else { return };
        let Some(it) = self.interactions.get(name).cloned() else {
            self.note(at, Ignored, &format!("there is no *SURFACE INTERACTION {name}; the contact acts without friction"));
            return;
        };
        let Interaction { friction, dynamic, limit, penalty, table } = it;
        let units = &self.units;
        if let Some(friction) = friction {
            let _ = writeln!(w.out, "friction = {}", number(friction));
        }
        if let Some([dynamic, decay]) = dynamic {
            let _ = writeln!(w.out, "friction_dynamic = {}\nfriction_decay = {}", number(dynamic), units.write(decay, Dimension::SLOWNESS));
        }
        if let Some(limit) = limit.filter(|_| friction.is_some()) {
            let _ = writeln!(w.out, "friction_limit = {}", units.write(limit, Dimension::PRESSURE));
        }
        if let Some(penalty) = penalty {
            // With the unit also in SI: a bare number is a stiffness per node.
            let text = units.write(penalty, Dimension::PRESSURE_PER_LENGTH);
            let _ = writeln!(w.out, "penalty = {}", if units.is_si() { format!("\"{text} Pa/m\"") } else { text });
        }
        if !table.is_empty() {
            let column = |place: usize, sign: f64, dimension| {
                let values = table.iter().rev().map(|row| units.write(if row[place] == 0.0 { 0.0 } else { sign * row[place] }, dimension));
                values.collect::<Vec<_>>().join(", ")
            };
            let (gaps, pressures) = (column(1, -1.0, Dimension::LENGTH), column(0, 1.0, Dimension::PRESSURE));
            let _ = writeln!(w.out, "law = \"pressure_gap\"\ngaps = [{gaps}]\npressures = [{pressures}]");
        }
    }

    fn rigid_surface(&self, name: &str) -> Option<&Vec<[f64; 2]>> {
        match self.deck.surfaces.get(name).and_then(|it| it.members.first()) {
            Some(Surface::Lines(points)) => Some(points),
            _ => None,
        }
    }

    pub(super) fn write_contacts(&mut self, w: &mut Writing) {
        if let Some((at, interaction)) = self.all.clone() {
            let _ = write!(w.out, "[[contact]]\nbodies = \"all\"\n{}", self.initial_penetration());
            self.write_interaction(interaction.as_deref(), at, w);
            w.out.push('\n');
        }
        for contact in self.contacts.clone() {
            if contact.surfaces.iter().any(|name| self.rigid_surface(name).is_some()) {
                continue; // an obstacle
            }
            let [Some(one), Some(other)] = contact.surfaces.clone().map(|name| self.names.surfaces.get(&name).cloned()) else { continue };
            let _ = writeln!(w.out, "[[contact]]\nbetween = [{}, {}]", quoted(&one), quoted(&other));
            if contact.tied {
                w.out.push_str("tied = true\n");
            } else {
                w.out.push_str(self.initial_penetration());
            }
            if contact.single {
                let _ = writeln!(w.out, "formulation = \"single_pass\"\nslave = {}", quoted(&one));
            }
            self.write_interaction(contact.interaction.as_deref(), contact.at, w);
            w.out.push('\n');
        }
    }

    /// Rigid surfaces that some contact names.
    pub(super) fn write_obstacles(&mut self, w: &mut Writing) {
        for rigid in self.rigid.clone() {
            let Some(surface) = rigid.surface else { continue };
            let points = self.rigid_surface(&surface).filter(|_| !self.is_3d()).cloned();
            let Some(points) = points else {
                self.note(rigid.at, Ignored, "its surface is not one of straight lines; nothing meets it");
                continue;
            };
            let contacts: Vec<Contact> = self.contacts.iter().filter(|contact| contact.surfaces.contains(&surface)).cloned().collect();
            let parts: Vec<String> = w
                .parts
                .iter()
                .filter(|part| contacts.iter().any(|contact| self.touches(part, contact)))
                .map(|part| quoted(&part.name))
                .collect();
            let interaction =
                contacts.first().map(|contact| contact.interaction.clone()).or(self.all.clone().map(|(_, interaction)| interaction));
            let Some(interaction) = interaction else {
                self.note(rigid.at, Ignored, "no contact names its surface; nothing meets it");
                continue;
            };
            let name = self.deck.surfaces.get(&surface).map_or(String::new(), |it| plain(&it.name));
            let units = self.units.clone();
            let length = |value: f64| units.write(value, Dimension::LENGTH);
            let point = |[x, y]: &[f64; 2]| format!("[{}, {}]", length(*x), length(*y));
            let points: Vec<String> = points.iter().map(point).collect();
            let _ = writeln!(w.out, "[[obstacle]]\nname = \"{name}\"\npolyline = {{ points = [{}] }}", points.join(", "));
            if self.all.is_none() {
                let _ = writeln!(w.out, "parts = [{}]", parts.join(", "));
            }
            let [x, y, _] = self.deck.nodes[rigid.reference as usize].position;
            let _ = writeln!(w.out, "reference = {}", point(&[x, y]));
            let motion = self.motion_of(rigid.reference, w);
            if [0, 1, 3].iter().any(|axis| motion[*axis].is_none()) {
                self.note(rigid.at, Ignored, "it is free in a direction, but a rigid surface has no mass in the import; it is fixed there");
            }
            let driven = ["x", "y", "z", "rotation"]
                .iter()
                .zip(&motion)
                .filter(|(axis, _)| **axis != "z")
                .filter_map(|(axis, it)| it.as_ref().filter(|it| *it != "0").map(|it| format!("{axis} = {it}")));
            let driven: Vec<String> = driven.collect();
            if !driven.is_empty() {
                let _ = writeln!(w.out, "motion = {{ {} }}", driven.join(", "));
            }
            w.out.push_str("initial_penetration = \"push_out\"\n");
            self.write_interaction(interaction.as_deref(), rigid.at, w);
            w.out.push('\n');
        }
    }

    /// Whether a surface of a contact lies on a part.
    fn touches(&self, part: &Part, contact: &Contact) -> bool {
        contact.surfaces.iter().any(|name| match self.deck.surfaces.get(name).and_then(|it| it.members.first()) {
            Some(Surface::Sides(sides)) => sides.iter().any(|(element, _)| part.elements.contains(element)),
            _ => false,
        })
    }

    /// What the boundary conditions of a reference node say, by x, y, z and rotation; `None`: free. The one
    /// rotation that a model names is that about z: with it those of solids about other axes are none.
    pub(super) fn motion_of(&mut self, reference: u32, w: &mut Writing) -> [Option<String>; 4] {
        let mut motion = [None, None, None, None];
        let mut turns: BTreeMap<usize, usize> = BTreeMap::new();
        for boundary in self.boundaries.clone().iter().filter(|boundary| boundary.nodes == [reference]) {
            let dimension = if boundary.axis > 2 { Dimension::RATE } else { Dimension::VELOCITY };
            if boundary.axis > 2 {
                turns.insert(boundary.axis, boundary.at);
            }
            if boundary.axis > 3 {
                if boundary.value != 0.0 {
                    self.note(boundary.at, Ignored, "a rigid body is turned about z alone; about this axis it is held");
                }
                continue;
            }
            let text = if boundary.value == 0.0 {
                Some("0".to_string())
            } else if boundary.prescribed == Prescribed::Velocity {
                self.driven(boundary, dimension, w)
            } else {
                self.note(boundary.at, Ignored, "a rigid body follows velocities only: TYPE=VELOCITY; it is fixed in this direction");
                None
            };
            motion[boundary.axis] = Some(text.unwrap_or("0".into()));
        }
        if self.is_3d()
            && let Some(&at) = turns.values().next()
        {
            if turns.len() < 3 {
                self.approximated(at, "rotations are held about all axes or about none: here about all");
            }
            motion[3].get_or_insert("0".into());
        }
        motion
    }

    /// A number, or the name of a curve.
    fn driven(&mut self, boundary: &Boundary, dimension: Dimension, w: &mut Writing) -> Option<String> {
        match &boundary.amplitude {
            Some(amplitude) => self.curve(boundary.at, amplitude, boundary.value, dimension, w).map(|name| quoted(&name)),
            None => Some(self.units.write(boundary.value, dimension)),
        }
    }

    pub(super) fn write_constraints(&mut self, w: &mut Writing) {
        let references: Vec<u32> = self.rigid.iter().map(|rigid| rigid.reference).collect();
        // The last word on a component of a set counts.
        let mut groups: Vec<String> = Vec::new();
        let mut last: BTreeMap<(String, usize), Boundary> = BTreeMap::new();
        for boundary in self.boundaries.clone() {
            if matches!(boundary.nodes.as_slice(), [node] if references.contains(node)) {
                continue;
            }
            let Some(group) = &boundary.group else {
                self.note(boundary.at, Ignored, "it holds nodes of no element and of no rigid body");
                continue;
            };
            if !groups.contains(group) {
                groups.push(group.clone());
            }
            // Nodes of solids don't rotate.
            let rotates = boundary.nodes.iter().any(|node| self.rotating[*node as usize]);
            if boundary.axis < self.dimension() || (boundary.axis > 2 && rotates) {
                last.insert((group.clone(), boundary.axis), boundary);
            }
        }
        for group in groups {
            let mut fixed = Vec::new();
            let mut moved: BTreeMap<&str, Vec<String>> = BTreeMap::new();
            for axis in 0..self.dimension() {
                let Some(boundary) = last.get(&(group.clone(), axis)).cloned() else { continue };
                let letter = ["x", "y", "z"][axis];
                if boundary.value == 0.0 {
                    fixed.push(format!("\"{letter}\""));
                } else if let Some((key, text)) = self.moved(&boundary, w) {
                    moved.entry(key).or_default().push(format!("{letter} = {text}"));
                }
            }
            let spins = self.spins(&group, &last, w);
            // Where no node rotates at all it is clamped.
            let axes = if self.is_3d() { 3 } else { 1 };
            if spins.len() == axes && spins.iter().all(|(_, text)| text == "0") {
                fixed.push("\"rotation\"".into());
            } else {
                moved.extend(
                    (!spins.is_empty()).then(|| ("spin", spins.iter().map(|(letter, text)| format!("{letter} = {text}")).collect())),
                );
            }
            if fixed.is_empty() && moved.is_empty() {
                continue;
            }
            let _ = writeln!(w.out, "[[constraint]]\non = {}", quoted(&group));
            if !fixed.is_empty() {
                let _ = writeln!(w.out, "fixed = [{}]", fixed.join(", "));
            }
            for (key, all) in moved {
                let _ = writeln!(w.out, "{key} = {{ {} }}", all.join(", "));
            }
            w.out.push('\n');
        }
    }

    /// The rotations of a group that are held or driven: axes and their angular velocities.
    fn spins(&mut self, group: &str, last: &BTreeMap<(String, usize), Boundary>, w: &mut Writing) -> Vec<(&'static str, String)> {
        let mut spins = Vec::new();
        for (letter, axis) in [("x", 4), ("y", 5), ("z", 3)] {
            let Some(boundary) = last.get(&(group.to_string(), axis)).cloned() else { continue };
            if boundary.value == 0.0 {
                spins.push((letter, "0".to_string()));
            } else if boundary.prescribed == Prescribed::Velocity {
                spins.extend(self.driven(&boundary, Dimension::RATE, w).map(|text| (letter, text)));
            } else {
                self.note(boundary.at, Ignored, "of rotations only velocities are prescribed (TYPE=VELOCITY); this one is free");
            }
        }
        spins
    }

    /// The key and value of a prescribed component.
    fn moved(&mut self, boundary: &Boundary, w: &mut Writing) -> Option<(&'static str, String)> {
        let (key, dimension) = match boundary.prescribed {
            Prescribed::Velocity => ("velocity", Dimension::VELOCITY),
            Prescribed::Acceleration => ("acceleration", Dimension::ACCELERATION),
            Prescribed::Displacement => ("displacement", Dimension::LENGTH),
        };
        if boundary.prescribed == Prescribed::Displacement {
            let starts_at_zero = match &boundary.amplitude {
                Some(name) => self.amplitudes.get(name).is_none_or(|it| it.values.first() == Some(&0.0)),
                None => false,
            };
            if !starts_at_zero {
                self.note(boundary.at, Ignored, "a displacement that jumps at the start; give it an amplitude that begins with 0");
                return None;
            }
        }
        self.driven(boundary, dimension, w).map(|text| (key, text))
    }

    pub(super) fn write_loads(&mut self, w: &mut Writing) {
        let round = w.parts.iter().any(|part| part.state == "axisymmetric");
        let depth = w.parts.first().map_or(1.0, |part| part.depth);
        let one_depth = w.parts.iter().all(|part| part.depth == depth);
        for load in self.loads.clone() {
            let (text, amplitude, at) = match load {
                Load::Gravity { at, elements, acceleration, amplitude } => {
                    let Some(parts) = self.parts_of(at, &elements, w) else { continue };
                    let acceleration = self.vector(acceleration, |value| self.units.write(value, Dimension::ACCELERATION));
                    (format!("gravity = {acceleration}\n{parts}"), amplitude, at)
                }
                Load::Force { at, group, force, amplitude } => {
                    if !round && !one_depth && !self.is_3d() {
                        self.note(at, Ignored, "a force on parts of different thicknesses has no counterpart per unit of depth");
                        continue;
                    }
                    let force = self.vector(force, |value| {
                        if self.is_3d() {
                            self.units.write(value, FORCE)
                        } else if round {
                            // In newtons, whatever the unit of the key: the force is that on the whole
                            // circumference.
                            self.units.write_si(value, FORCE)
                        } else {
                            self.units.write(value / depth, Dimension::FORCE_PER_LENGTH)
                        }
                    });
                    (format!("force = {force}\non = {}\n", quoted(&group)), amplitude, at)
                }
                Load::Moment { at, group, moment, amplitude } => {
                    let per_depth = if round || self.is_3d() { 1.0 } else { depth };
                    if per_depth != 1.0 && !one_depth {
                        self.note(at, Ignored, "a moment on parts of different thicknesses has no counterpart per unit of depth");
                        continue;
                    }
                    let moment = moment.map(|value| match (self.is_3d(), round) {
                        (true, _) => self.units.write(value, Dimension::MOMENT),
                        (_, true) => self.units.write_si(value, Dimension::MOMENT),
                        _ => self.units.write(value / per_depth, FORCE),
                    });
                    (format!("moment = [{}]\non = {}\n", moment.join(", "), quoted(&group)), amplitude, at)
                }
                Load::Pressure { at, group, pressure, amplitude } => {
                    (format!("pressure = {}\non = {}\n", self.units.write(pressure, Dimension::PRESSURE), quoted(&group)), amplitude, at)
                }
            };
            let curve = match amplitude {
                Some(name) => match self.curve(at, &name, 1.0, Dimension::NONE, w) {
                    Some(curve) => format!("curve = {}\n", quoted(&curve)),
                    None => continue,
                },
                None => String::new(),
            };
            let _ = writeln!(w.out, "[[load]]\n{text}{curve}");
        }
    }

    /// The key `parts` for elements (empty: all); `None` (and a note) if they are not whole parts.
    fn parts_of(&mut self, at: usize, elements: &BTreeSet<u32>, w: &Writing) -> Option<String> {
        if elements.is_empty() {
            return Some(String::new());
        }
        let mut names = Vec::new();
        for part in &w.parts {
            let inside = part.elements.iter().filter(|element| elements.contains(element)).count();
            if inside == part.elements.len() {
                names.push(quoted(&part.name));
            } else if inside > 0 {
                self.note(at, Ignored, &format!("gravity acts on whole parts, but its set is only some of {}", part.name));
                return None;
            }
        }
        Some(format!("parts = [{}]\n", names.join(", ")))
    }
}
