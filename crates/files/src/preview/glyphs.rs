//! The glyphs of a model, section by section, and those of its faults.

use super::even::even;
use super::kinds::{
    BOUNDARY, CAVITY, CONNECTION, CONTACT, CUT, FAULT, FORCE, GOVERNOR, GRAVITY, GlyphKind, MASS, MOMENT, MOTION, PRESSURE, PROBE, SUPPORT,
    SYMMETRY, TIE, VELOCITY,
};
use super::places::{Places, mean};
use crate::model_file::{Diagnostics, Loaded};
use crate::outline::{box_around, cross, dot, unit};
use embate_solver::model::{Constraint, Drive, Load, Model, Partners, ProbeAt};
use serde::{Serialize, Serializer};

/// Most symbols of one glyph: arrows and supports, and dots.
const FEW: usize = 60;
const MANY: usize = 160;
/// Most rings of one fault.
const SOME: usize = 12;
/// Sections whose keys are shown as the text of a glyph, without those that name it.
const NAMING: [&str; 2] = ["name", "on"];

/// Something of a model that is drawn on its bodies.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Glyph {
    /// What it stands for.
    #[serde(serialize_with = "named", rename = "kind")]
    pub kind: &'static GlyphKind,
    /// Its name in the model.
    pub name: String,
    /// Path of its section: `constraint[0]`.
    pub path: String,
    /// Its keys as they are written in the file, or the message of a fault.
    pub text: String,
    /// Where its symbols are, m.
    pub points: Vec<[f64; 3]>,
    /// Direction of each symbol: of the longest arrow of a kind 1 long; of a dot the outward normal of its
    /// surface; of a ring its radius, m, in x.
    pub vectors: Vec<[f64; 3]>,
}

fn named<S: Serializer>(kind: &&'static GlyphKind, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(kind.name)
}

/// What goes through the sections of a model.
struct Maker<'a> {
    model: &'a Model,
    places: &'a Places<'a>,
    /// Keys as they are written.
    written: Vec<(String, String)>,
    glyphs: Vec<Glyph>,
}

/// All glyphs of a model whose bodies are in `places`.
pub(super) fn of_model(model: &Model, loaded: &Loaded, places: &Places<'_>, velocities: Option<&[f64]>) -> Vec<Glyph> {
    let mut maker = Maker { model, places, written: loaded.written(), glyphs: Vec::new() };
    maker.constraints();
    maker.symmetries();
    maker.velocities(velocities);
    maker.loads();
    maker.contacts();
    maker.connections();
    maker.recorded();
    maker.glyphs
}

/// The element that sets the time step.
pub(super) fn governor(at: [f64; 3], text: &str) -> Glyph {
    Glyph { kind: &GOVERNOR, name: String::new(), path: "run".into(), text: text.into(), points: vec![at], vectors: vec![[0.0; 3]] }
}

/// Rings around what is faulty: places that a fault names, or else the symbols of the section or the part
/// that it is in.
pub(super) fn of_faults(faults: &Diagnostics, glyphs: &[Glyph], model: &Model, places: &Places<'_>) -> Vec<Glyph> {
    let ring = |path: &str, text: &str, points: Vec<[f64; 3]>, radius: f64| Glyph {
        kind: &FAULT,
        name: String::new(),
        path: path.into(),
        text: text.into(),
        vectors: vec![[radius, 0.0, 0.0]; points.len()],
        points,
    };
    let of = |fault: &crate::model_file::Diagnostic| {
        let text = format!("{}: {}", fault.kind.code, fault.message);
        if !fault.places.is_empty() {
            let points = even(&fault.places, SOME).into_iter().map(|index| fault.places[index]).collect();
            return Some(ring(&fault.path, &text, points, 0.0));
        }
        // Of a part all is meant, and not only how it moves.
        let is_in = |glyph: &&Glyph| {
            let rest = fault.path.strip_prefix(&glyph.path);
            !fault.path.starts_with("part[") && rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
        };
        if let Some(glyph) = glyphs.iter().find(is_in) {
            let points = even(&glyph.points, SOME).into_iter().map(|index| glyph.points[index]).collect();
            return Some(ring(&fault.path, &text, points, 0.0));
        }
        let number = fault.path.strip_prefix("part[")?.split(']').next()?.parse::<usize>().ok()?;
        let [low, high] = box_around(places.of_nodes(&model.parts.get(number)?.name).into_iter())?;
        let middle = [0, 1, 2].map(|d| 0.5 * (low[d] + high[d]));
        let radius = 0.5 * (0..3).map(|d| (high[d] - low[d]).powi(2)).sum::<f64>().sqrt();
        (radius > 0.0).then(|| ring(&fault.path, &text, vec![middle], 1.05 * radius))
    };
    faults.entries.iter().filter_map(of).collect()
}

impl Maker<'_> {
    /// Adds a glyph with some of these symbols, if there are any.
    fn add(&mut self, kind: &'static GlyphKind, name: &str, path: String, symbols: &[([f64; 3], [f64; 3])], most: usize) {
        let points: Vec<[f64; 3]> = symbols.iter().map(|(point, _)| *point).collect();
        let taken = even(&points, most);
        if taken.is_empty() {
            return;
        }
        let text = self.text(&path);
        let points = taken.iter().map(|&index| symbols[index].0).collect();
        let vectors = taken.iter().map(|&index| symbols[index].1).collect();
        self.glyphs.push(Glyph { kind, name: name.into(), path, text, points, vectors });
    }

    /// The same with all symbols, in their order.
    fn add_all(&mut self, kind: &'static GlyphKind, name: &str, path: String, points: Vec<[f64; 3]>) {
        if points.is_empty() || points.iter().flatten().any(|x| !x.is_finite()) {
            return;
        }
        let (text, vectors) = (self.text(&path), vec![[0.0; 3]; points.len()]);
        self.glyphs.push(Glyph { kind, name: name.into(), path, text, points, vectors });
    }

    /// The keys of a section as they are written.
    fn text(&self, path: &str) -> String {
        let of = |(key, value): &(String, String)| {
            let key = key.strip_prefix(path)?.strip_prefix('.')?;
            (!NAMING.contains(&key)).then(|| format!("{key} = {value}"))
        };
        self.written.iter().filter_map(of).collect::<Vec<_>>().join(", ")
    }

    fn constraints(&mut self) {
        for (index, constraint) in self.model.constraints.iter().enumerate() {
            let path = format!("constraint[{index}]");
            let points = self.places.of_nodes(&constraint.on);
            let axes = |is: &dyn Fn(usize) -> bool| (0..self.places.frame.dimension).filter(|&d| is(d)).collect::<Vec<_>>();
            let is_held = |d: usize| constraint.velocity[d] == Some(Drive::Constant(0.0));
            let held = axes(&is_held);
            let driven = axes(&|d| !is_held(d) && drives(constraint, d).is_some());
            // Held along all axes: one square instead of a triangle for each.
            let ways =
                if held.len() == self.places.frame.dimension { vec![[0.0; 3]] } else { held.iter().map(|&d| axis(d, 1.0)).collect() };
            let held: Vec<_> = ways.iter().filter(|_| !held.is_empty()).flat_map(|&way| points.iter().map(move |&x| (x, way))).collect();
            self.add(&SUPPORT, &constraint.name, path.clone(), &held, FEW);
            let mut moved: Vec<_> = driven
                .iter()
                .flat_map(|&d| {
                    let sign = match drives(constraint, d) {
                        Some(Drive::Constant(speed)) if *speed < 0.0 => -1.0,
                        _ => 1.0,
                    };
                    points.iter().map(move |&x| (x, axis(d, sign)))
                })
                .collect();
            if let Some(rotation) = &constraint.rotation {
                let sign = if matches!(rotation.speed, Drive::Constant(speed) if speed < 0.0) { -1.0 } else { 1.0 };
                let around = |&x: &[f64; 3]| {
                    let arm = [0, 1, 2].map(|d| x[d] - rotation.about.centre[d]);
                    Some((x, unit(cross(rotation.about.direction, arm))?.map(|v| sign * v)))
                };
                moved.extend(points.iter().filter_map(around));
            }
            self.add(&MOTION, &constraint.name, path, &moved, FEW / 2);
        }
    }

    fn symmetries(&mut self) {
        for (index, symmetry) in self.model.symmetries.iter().enumerate() {
            let corners = self.places.plane(symmetry.point, symmetry.normal);
            self.add_all(&SYMMETRY, &symmetry.name, format!("symmetry[{index}]"), corners);
        }
    }

    /// Arrows of the fastest nodes' lengths: `velocities` of all nodes, m/s.
    fn velocities(&mut self, velocities: Option<&[f64]>) {
        let (Some(velocities), dimension) = (velocities, self.places.frame.dimension) else { return };
        let of = |node: u32| {
            let own = velocities.get(dimension * node as usize..dimension * (node as usize + 1)).unwrap_or_default();
            let v: [f64; 3] = std::array::from_fn(|d| own.get(d).copied().unwrap_or(0.0));
            (self.places.place(node), v)
        };
        let size = |v: [f64; 3]| dot(v, v).sqrt();
        let parts: Vec<Vec<_>> = self.model.parts.iter().map(|part| self.places.nodes(&part.name).into_iter().map(of).collect()).collect();
        let most = parts.iter().flatten().map(|&(_, v): &([f64; 3], [f64; 3])| size(v)).fold(0.0, f64::max);
        if !(most > 0.0) {
            return;
        }
        for (index, (part, symbols)) in self.model.parts.iter().zip(&parts).enumerate() {
            let fast: Vec<_> = symbols.iter().filter(|(_, v)| size(*v) > 1e-3 * most).map(|&(x, v)| (x, v.map(|c| c / most))).collect();
            // Those that move as one need one arrow.
            let is_even = fast.len() == symbols.len() && fast.iter().all(|(_, v)| size([0, 1, 2].map(|d| v[d] - fast[0].1[d])) < 1e-6);
            let fast = match mean(fast.iter().map(|(x, _)| *x)) {
                Some(middle) if is_even => vec![(middle, fast[0].1)],
                _ => fast,
            };
            let count = self.glyphs.len();
            self.add(&VELOCITY, &part.name, format!("part[{index}]"), &fast, FEW / 2);
            let text = ["velocity", "spin", "radial_velocity"].map(|key| self.text_of(&format!("part[{index}].{key}")));
            if let Some(glyph) = self.glyphs.get_mut(count) {
                glyph.text = text.into_iter().flatten().collect::<Vec<_>>().join(", ");
            }
        }
    }

    /// A key as it is written, with its name.
    fn text_of(&self, path: &str) -> Option<String> {
        let key = path.rsplit('.').next()?;
        let own = |(at, value): &(String, String)| {
            let rest = at.strip_prefix(path)?;
            (rest.is_empty() || rest.starts_with('.')).then(|| format!("{key}{rest} = {value}"))
        };
        let found: Vec<String> = self.written.iter().filter_map(own).collect();
        (!found.is_empty()).then(|| found.join(", "))
    }

    /// Middles of parts; of all where none is named.
    fn middles(&self, parts: &[String]) -> Vec<[f64; 3]> {
        let of = |name: &String| mean(self.places.of_nodes(name).into_iter());
        let all = self.model.parts.iter().map(|part| &part.name).filter(|name| parts.is_empty() || parts.contains(name));
        all.filter_map(of).collect()
    }

    fn loads(&mut self) {
        for (index, load) in self.model.loads.iter().enumerate() {
            let path = format!("load[{index}]");
            match load {
                Load::Gravity { parts, acceleration, .. } => {
                    let Some(way) = unit(*acceleration) else { continue };
                    let symbols: Vec<_> = self.middles(parts).into_iter().map(|x| (x, way)).collect();
                    self.add(&GRAVITY, "gravity", path, &symbols, FEW / 2);
                }
                Load::Centrifugal { parts, about, .. } => {
                    let Some(along) = unit(about.direction) else { continue };
                    let outwards = |x: [f64; 3]| {
                        let arm = [0, 1, 2].map(|d| x[d] - about.centre[d]);
                        let on_axis = dot(arm, along);
                        Some((x, unit([0, 1, 2].map(|d| arm[d] - on_axis * along[d]))?))
                    };
                    let symbols: Vec<_> = self.middles(parts).into_iter().filter_map(outwards).collect();
                    self.add(&GRAVITY, "centrifugal", path, &symbols, FEW / 2);
                }
                Load::Force { on, force: vector, .. } | Load::Moment { on, moment: vector, .. } => {
                    let Some(way) = unit(*vector) else { continue };
                    let kind = if matches!(load, Load::Force { .. }) { &FORCE } else { &MOMENT };
                    let symbols: Vec<_> = self.places.of_nodes(on).into_iter().map(|x| (x, way)).collect();
                    self.add(kind, on, path, &symbols, FEW / 2);
                }
                Load::Pressure { on, pressure, .. } => {
                    let sign = if *pressure < 0.0 { 1.0 } else { -1.0 };
                    let symbols: Vec<_> = self.places.of_surface(on).into_iter().map(|(x, n)| (x, n.map(|c| sign * c))).collect();
                    self.add(&PRESSURE, on, path, &symbols, FEW);
                }
                Load::Damping { .. } | Load::StiffnessDamping { .. } => {}
            }
        }
    }

    /// Dots on these surfaces, with their outward normals.
    fn dots(&mut self, kind: &'static GlyphKind, name: &str, path: String, surfaces: &[String]) {
        let symbols: Vec<_> = surfaces.iter().flat_map(|surface| self.places.of_surface(surface)).collect();
        self.add(kind, name, path, &symbols, MANY);
    }

    fn contacts(&mut self) {
        let model = self.model;
        for (index, contact) in model.contacts.iter().enumerate() {
            let kind = if contact.tied.is_some() { &TIE } else { &CONTACT };
            let path = format!("contact[{index}]");
            match &contact.partners {
                Partners::Between(surfaces) => self.dots(kind, &contact.name, path, surfaces),
                Partners::Bodies(parts) if parts.is_empty() => self.add(kind, &contact.name, path, &self.places.of_outside(), MANY),
                Partners::Bodies(parts) => self.dots(kind, &contact.name, path, parts),
            }
        }
        for (index, join) in model.joins.iter().enumerate() {
            let nodes = join.between.iter().flat_map(|name| self.places.of_nodes(name));
            let symbols: Vec<_> = nodes.map(|x| (x, [0.0; 3])).collect();
            self.add(&TIE, "join", format!("join[{index}]"), &symbols, MANY);
        }
        for (index, cavity) in model.cavities.iter().enumerate() {
            self.dots(&CAVITY, &cavity.name, format!("cavity[{index}]"), &cavity.on);
        }
        for (index, boundary) in model.non_reflecting.iter().enumerate() {
            self.dots(&BOUNDARY, &boundary.on, format!("non_reflecting[{index}]"), std::slice::from_ref(&boundary.on));
        }
    }

    fn connections(&mut self) {
        let model = self.model;
        let middle = |maker: &Self, name: &String| mean(maker.places.of_nodes(name).into_iter());
        // A line from the middle of each set over the point, where there is one.
        for (index, weld) in model.welds.iter().enumerate() {
            let across = self.places.size() * 0.02;
            let ends = weld.at.iter().flat_map(|&x| [axis(0, across), axis(0, -across)].map(|by| [0, 1, 2].map(|d| x[d] + by[d])));
            self.add_all(&CONNECTION, &weld.name, format!("weld[{index}]"), ends.collect());
        }
        for (index, joint) in model.joints.iter().enumerate() {
            let half = 0.05 * self.places.size();
            let along = unit(joint.axis).unwrap_or([0.0, 0.0, 1.0]);
            let along = if self.places.frame.dimension < 3 { [1.0, 0.0, 0.0] } else { along };
            let ends = [half, -half].map(|by| [0, 1, 2].map(|d| joint.at[d] + by * along[d]));
            self.add_all(&CONNECTION, &joint.name, format!("joint[{index}]"), ends.to_vec());
        }
        for (index, spring) in model.springs.iter().enumerate() {
            let ends: Option<Vec<_>> = spring.between.iter().map(|name| middle(self, name)).collect();
            self.add_all(&CONNECTION, "spring", format!("spring[{index}]"), ends.unwrap_or_default());
        }
        for (index, mass) in model.point_masses.iter().enumerate() {
            let at = middle(self, &mass.on).into_iter().collect();
            self.add_all(&MASS, &mass.on, format!("point_mass[{index}]"), at);
        }
    }

    fn recorded(&mut self) {
        let model = self.model;
        for (index, probe) in model.probes.iter().enumerate() {
            let at = match &probe.at {
                ProbeAt::Point { point, .. } => Some(*point),
                ProbeAt::Node { part, node } => self.places.of_nodes(part).get(*node).copied(),
                ProbeAt::Element { part, element } => self.places.element(part, *element),
                ProbeAt::Set { set } => mean(self.places.of_nodes(set).into_iter()),
            };
            self.add_all(&PROBE, &probe.name, format!("probe[{index}]"), at.into_iter().collect());
        }
        for (index, cut) in model.cuts.iter().enumerate() {
            let corners = self.places.plane(cut.point, cut.normal);
            self.add_all(&CUT, &cut.name, format!("cut[{index}]"), corners);
        }
    }
}

/// What drives a component of a constraint.
fn drives(constraint: &Constraint, d: usize) -> Option<&Drive> {
    [&constraint.velocity, &constraint.displacement, &constraint.acceleration].into_iter().find_map(|drives| drives[d].as_ref())
}

fn axis(d: usize, size: f64) -> [f64; 3] {
    std::array::from_fn(|k| if k == d { size } else { 0.0 })
}
