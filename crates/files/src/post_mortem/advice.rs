//! What to change in the model after a failure: keys, with what this failure says about them.
//!
//! General causes and remedies are in the catalogue of messages; here is only what follows from the failure
//! location, its history, and what acts on it.

use super::Failed;
use super::page::shown;
use crate::model_file::Loaded;
use embate_solver::error::Error;
use embate_solver::input::sections;
use embate_solver::mesh::cell::CellKind;
use embate_solver::model::{ContactLaw, Drive, Formulation, Interface, Load, Model, Penalty};
use embate_solver::post_mortem::{Acting, FailureLocation, Moment, Trace};
use embate_solver::vocabulary::Need;

/// One change.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Advice {
    /// What to do and why.
    pub(super) what: String,
    /// Path of the key.
    pub(super) path: String,
}

impl Advice {
    pub(super) fn new(path: impl Into<String>, what: impl Into<String>) -> Self {
        Self { what: what.into(), path: path.into() }
    }
}

/// What is known of a failure.
pub(super) struct Case<'a> {
    pub(super) failed: &'a Failed<'a>,
    pub(super) trace: &'a Trace,
    pub(super) failure_location: FailureLocation,
    pub(super) acting: Vec<Acting>,
}

/// A contact that pressed on the failure location or the elements next to it.
pub(super) struct Pressing<'a> {
    pub(super) kind: &'static str,
    pub(super) name: &'a str,
    /// Its largest force in the steps that were seen, summed over the nodes, N/m.
    pub(super) force: f64,
    /// When that was.
    pub(super) step: u64,
    /// Whether it pressed to the end.
    pub(super) lasts: bool,
}

/// A shape that is still good.
const GOOD: f64 = 0.25;
/// A penalty so many times the automatic one is the cause of whatever is wrong with its contact.
const TOO_STIFF: f64 = 100.0;

impl<'a> Case<'a> {
    fn model(&self) -> &'a Model {
        self.failed.model
    }

    /// Place of the failure location's part in the model.
    pub(super) fn part(&self) -> Option<usize> {
        self.model().parts.iter().position(|part| part.name == self.failure_location.part())
    }

    /// The step that failed, and the last good one.
    pub(super) fn last(&self) -> Option<&'a Moment> {
        self.trace.moments.last()
    }

    pub(super) fn last_good(&self) -> Option<&'a Moment> {
        let failed = self.failed.simulation.steps();
        self.trace.moments.iter().rev().find(|moment| moment.step < failed)
    }

    /// Contacts and obstacles that pressed, the strongest first.
    pub(super) fn pressing(&self) -> Vec<Pressing<'a>> {
        let of = |(k, (kind, name)): (usize, &'a (&'static str, String))| {
            let forces = || {
                self.trace
                    .moments
                    .iter()
                    .filter_map(move |moment| Some((moment.step, *moment.pressing.get(k)?)))
                    .filter(|(_, force)| force.is_finite())
            };
            let (step, force) = forces().max_by(|(_, a), (_, b)| a.total_cmp(b)).filter(|(_, force)| *force > 0.0)?;
            let lasts = forces().next_back().is_some_and(|(_, last)| last > 0.0);
            Some(Pressing { kind, name, force, step, lasts })
        };
        let mut all: Vec<Pressing<'_>> = self.trace.contacts.iter().enumerate().filter_map(of).collect();
        all.sort_by(|a, b| b.force.total_cmp(&a.force));
        all
    }

    /// Path and interface of a contact or obstacle.
    pub(super) fn interface(&self, kind: &str, name: &str) -> Option<(String, &'a Interface)> {
        let model = self.model();
        if kind == "contact" {
            let at = model.contacts.iter().position(|it| it.name == name)?;
            Some((format!("contact[{at}]"), &model.contacts[at].interface))
        } else {
            let at = model.obstacles.iter().position(|it| it.name == name)?;
            Some((format!("obstacle[{at}]"), &model.obstacles[at].interface))
        }
    }

    /// The contact the cause, or that which presses most.
    fn contact(&self) -> Option<(String, String)> {
        match &self.failure_location {
            FailureLocation::Contact { kind, name, .. } => Some(((*kind).to_string(), name.clone())),
            _ => self.pressing().first().map(|it| (it.kind.to_string(), it.name.to_string())),
        }
    }

    /// What to change for this failure, what helps most first.
    pub(super) fn advice(&self) -> Vec<Advice> {
        let mut all = Vec::new();
        match self.failed.error {
            Error::Inverted { .. } => {
                self.too_fast_for_the_step(&mut all);
                self.squeezed(&mut all);
                self.driven(&mut all, "let it go less far (slower alone only puts it off): it moves or loads the failure location");
                self.soft(&mut all);
            }
            Error::Collapsed { limit, time_step, .. } => {
                self.squeezed(&mut all);
                self.stiffened(&mut all);
                self.driven(&mut all, "let it go slower or less far: it moves or loads the failure location");
                let what = format!(
                    "only if such steps are meant: allow less than {}; every step then costs as much as now",
                    shown(*time_step, "s")
                );
                all.push(Advice::new("run.step_limit", format!("{what} (the limit was {})", shown(*limit, "s"))));
            }
            Error::EnergyDrift { drift, .. } => self.unbalanced(&mut all, *drift),
            Error::NotFinite { .. } => {
                self.driven(&mut all, "look at its value and unit: it acts on the failure location");
                self.material(&mut all, "look at every value and unit: the law of the part that failed");
                self.thrown(&mut all);
            }
            Error::TooDeep { depth, .. } => self.pressed_in(&mut all, *depth),
            Error::Runaway { speed, .. } => {
                self.driven(&mut all, "look at its value and unit: it acts on the failure location");
                self.shot(&mut all);
                self.material(&mut all, "look at the density and its unit: what is too light is too fast");
                let what = format!("only if such speeds are meant: more than {}", shown(*speed, "m/s"));
                all.push(Advice::new("run.velocity_limit", what));
            }
            _ => {}
        }
        all
    }

    /// A contact that is too soft for what presses on it, or that began too late.
    fn pressed_in(&self, all: &mut Vec<Advice>, depth: f64) {
        if let Some((kind, name)) = self.contact()
            && let Some((path, interface)) = self.interface(&kind, &name)
        {
            if interface.active[0] > 0.0 {
                all.push(Advice::new(
                    format!("{path}.birth"),
                    "let it act before the bodies meet: what is inside when it begins stays inside",
                ));
            }
            match &interface.law {
                ContactLaw::Penalty(Penalty::Automatic { scale, .. }) if *scale < 1.0 => {
                    all.push(Advice::new(
                        format!("{path}.penalty_scale"),
                        "leave it out: 1 is as stiff as the elements behind, and this is far softer",
                    ));
                }
                ContactLaw::Penalty(Penalty::Automatic { scale, .. }) => {
                    all.push(Advice::new(format!("{path}.penalty_scale"), format!("try ten times as much, {}", 10.0 * scale)));
                }
                ContactLaw::Penalty(_) => {
                    all.push(Advice::new(
                        format!("{path}.penalty"),
                        "raise it, or leave it out: the automatic penalty is as stiff as the elements behind",
                    ));
                }
                ContactLaw::PressureGap { .. } => {
                    all.push(Advice::new(format!("{path}.pressures"), "let the pressure grow further or more steeply"))
                }
                ContactLaw::Multiplier => {}
            }
            if interface.law != ContactLaw::Multiplier {
                all.push(Advice::new(format!("{path}.law"), "or take `multiplier`, which lets nothing in"));
            }
        }
        self.driven(all, "look at its value and unit: it presses the bodies together");
        all.push(Advice::new("run.penetration_limit", format!("only if so much depth is meant: more than {}", shown(depth, "m"))));
    }

    /// A contact that may have shot the failure location away.
    fn shot(&self, all: &mut Vec<Advice>) {
        if let Some(it) = self.pressing().first()
            && let Some((path, interface)) = self.interface(it.kind, it.name)
        {
            self.softer(all, &path, interface, &format!("{} \"{}\" pressed there in step {}", it.kind, it.name, it.step));
        }
    }

    /// It went over from one step to the next.
    fn too_fast_for_the_step(&self, all: &mut Vec<Advice>) {
        if let (Some(good), Some(last)) = (self.last_good(), self.last())
            && good.vitals.shape > GOOD
            && last.vitals.shape <= 0.0
        {
            let what = format!(
                "try 0.5: the shape of the element fell from {:.2} to {:.2} in one step, which speaks of a step that \
                    is not stable, or of a load that comes at once",
                good.vitals.shape, last.vitals.shape
            );
            all.push(Advice::new("run.safety", what));
        }
    }

    /// Failure of what is squeezed or torn, and the mesh.
    fn squeezed(&self, all: &mut Vec<Advice>) {
        let Some(index) = self.part() else { return };
        let part = &self.model().parts[index];
        let vitals = self.last_good().or(self.last()).map(|moment| moment.vitals);
        let strain = vitals.map_or(f64::NAN, |it| it.strains[0].max(-it.strains[1]));
        if self.model().materials.get(&part.material).is_some_and(|material| material.failure.is_empty()) {
            let plastic = vitals.map_or(f64::NAN, |it| it.plastic_strain);
            if plastic > 0.3 {
                let what = format!(
                    "where the material would tear, let its elements fail before, say at half the plastic strain at the failure \
                        location, which was {plastic:.2}"
                );
                all.push(Advice::new(format!("material.{}.failure.plastic_strain", part.material), what));
            } else if let Error::Collapsed { limit, .. } = self.failed.error {
                let what = format!("let elements fail whose step falls this far, say at {}", shown(2.0 * limit, "s"));
                all.push(Advice::new(format!("material.{}.failure.time_step", part.material), what));
            }
        }
        // Smaller elements take the same strains, and sooner: at contacts they follow edges more closely.
        let what = if strain > 0.5 {
            format!(
                "shape the elements so that they are drawn or pressed into squares: this one had a strain of {strain:.2} before the \
                    failure. More of the same shape fail sooner, fewer later"
            )
        } else if matches!(self.failed.error, Error::Collapsed { .. }) {
            "take larger elements there: the stable step goes with their size".to_string()
        } else {
            "look at the elements there: one alone may carry what should be shared by several".to_string()
        };
        all.push(Advice::new(format!("part[{index}].{}", part.shape.size_path()), what));
        if part.element == "quad4_reduced" && self.trace.near.cells.first().is_some_and(|cell| cell.kind == CellKind::Quadrilateral) {
            let what = "try `quad4`: elements with one point fold into zigzags that nothing but hourglass control resists";
            all.push(Advice::new(format!("part[{index}].element"), what));
        }
    }

    /// The step fell though the element kept its size.
    fn stiffened(&self, all: &mut Vec<Advice>) {
        if let (Some(first), Some(last)) = (self.trace.moments.first(), self.last())
            && last.vitals.area_ratio > 0.5
            && last.vitals.shape > GOOD
        {
            let ratio = first.vitals.time_step / last.vitals.time_step;
            let what = if ratio > 1.5 {
                format!(
                    "look at how stiff it becomes: the element kept its shape (size {:.2} of that at the start) \
                        while its step fell to 1/{ratio:.1}",
                    last.vitals.area_ratio
                )
            } else {
                "look at stiffness and density with their units: the element has its shape, and its step was short from the start"
                    .to_string()
            };
            self.material(all, &what);
        }
    }

    fn soft(&self, all: &mut Vec<Advice>) {
        if let Some(good) = self.last_good().or(self.last())
            && let Some(wave) = self.part().and_then(|part| self.modulus(part))
            && good.vitals.strains[1] < -0.5
        {
            let what = format!(
                "look at stiffness and strength with their units: the largest stress there was {}, and the stiffest \
                    modulus of the law is {}",
                shown(good.vitals.von_mises, "Pa"),
                shown(wave, "Pa")
            );
            self.material(all, &what);
        }
    }

    /// The largest of the parameters of a part's law that are moduli.
    fn modulus(&self, part: usize) -> Option<f64> {
        let material = self.model().materials.get(&self.model().parts[part].material)?;
        ["young", "bulk", "shear", "young_1", "young_2"].iter().filter_map(|key| material.parameters.get(*key)).copied().reduce(f64::max)
    }

    fn material(&self, all: &mut Vec<Advice>, what: &str) {
        if let Some(part) = self.part() {
            let name = &self.model().parts[part].material;
            all.push(Advice::new(format!("material.{name}"), what));
        }
    }

    /// What holds, moves or loads the neighbourhood.
    fn driven(&self, all: &mut Vec<Advice>, what: &str) {
        for Acting { path, on } in &self.acting {
            all.push(Advice::new(self.driven_key(path), format!("{what} (on `{on}`)")));
            for curve in self.curves(path) {
                let keys = ["value", "expression", "sine"].map(|key| format!("curve.{curve}.{key}"));
                if let Some(path) = keys.into_iter().find(|path| self.failed.loaded.key(path).written.is_some()) {
                    all.push(Advice::new(path, "look at all of its values and their unit: it drives the former"));
                }
            }
        }
        for Pressing { kind, name, force, .. } in self.pressing().iter().take(2).filter(|it| it.kind == "obstacle") {
            // One that stands still does nothing of itself.
            if let Some(path) = self.interface(kind, name).map(|(path, _)| format!("{path}.motion"))
                && self.failed.loaded.key(&path).written.is_some()
            {
                let unit = if self.model().is_of_whole_bodies() { "N" } else { "N/m" };
                let what = format!("let it go slower or less far: {kind} \"{name}\" pressed there with up to {}", shown(*force, unit));
                all.push(Advice::new(path, what));
            }
        }
        self.thrown(all);
    }

    /// Names of the curves of a constraint or load.
    fn curves(&self, path: &str) -> Vec<String> {
        let of = |drive: &Drive| match drive {
            Drive::Curve(name) => Some(name.clone()),
            Drive::Constant(_) => None,
        };
        if let Some(it) = number(path, "constraint").and_then(|at| self.model().constraints.get(at)) {
            let drives = [&it.velocity, &it.displacement, &it.acceleration, &it.spin].into_iter().flatten().flatten();
            return drives.chain(it.rotation.iter().map(|rotation| &rotation.speed)).filter_map(of).collect();
        }
        match number(path, "load").and_then(|at| self.model().loads.get(at)) {
            Some(
                Load::Force { curve, .. }
                | Load::Moment { curve, .. }
                | Load::Pressure { curve, .. }
                | Load::Gravity { curve, .. }
                | Load::Centrifugal { curve, .. },
            ) => curve.iter().cloned().collect(),
            _ => Vec::new(),
        }
    }

    /// The key of a constraint or load that has the value.
    fn driven_key(&self, path: &str) -> String {
        let key = if let Some(it) = number(path, "constraint").and_then(|at| self.model().constraints.get(at)) {
            let is_moved = |components: &[Option<Drive>; 3]| components.iter().flatten().next().is_some();
            [
                ("velocity", is_moved(&it.velocity)),
                ("displacement", is_moved(&it.displacement)),
                ("acceleration", is_moved(&it.acceleration)),
                ("spin", is_moved(&it.spin)),
                ("rotation", it.rotation.is_some()),
            ]
            .into_iter()
            .find_map(|(key, is_there)| is_there.then_some(key))
        } else {
            number(path, "load").and_then(|at| self.model().loads.get(at)).and_then(|load| match load {
                Load::Force { .. } => Some("force"),
                Load::Moment { .. } => Some("moment"),
                Load::Pressure { .. } => Some("pressure"),
                Load::Gravity { .. } => Some("gravity"),
                Load::Centrifugal { .. } => Some("centrifugal"),
                Load::Damping { .. } | Load::StiffnessDamping { .. } => None,
            })
        };
        let whole = key.map_or(path.to_string(), |key| format!("{path}.{key}"));
        // `fixed = "x"` is a velocity of zero, and written otherwise.
        if self.failed.loaded.key(&whole).written.is_some() { whole } else { path.to_string() }
    }

    /// What was thrown at the start.
    fn thrown(&self, all: &mut Vec<Advice>) {
        if let Some(index) = self.part().filter(|&index| self.model().parts[index].velocity != [0.0; 3]) {
            all.push(Advice::new(format!("part[{index}].velocity"), "look at the speed at the start and its unit"));
        }
    }

    /// Energies that don't balance.
    fn unbalanced(&self, all: &mut Vec<Advice>, drift: f64) {
        let limit = || {
            let what = format!("only if the loss is understood and harmless: the drift was {:.2} % when the run ended", 100.0 * drift);
            Advice::new("run.energy_limit", what)
        };
        if let Some((kind, name)) = self.contact()
            && let Some((path, interface)) = self.interface(&kind, &name)
        {
            self.softer(all, &path, interface, &format!("{kind} \"{name}\" presses where the energy changed most"));
            // Where a spring is far stiffer than what it holds, neither a smaller step nor more elements nor
            // damping help.
            let is_too_stiff = matches!(&interface.law, ContactLaw::Penalty(Penalty::Automatic { scale, .. }) if *scale > TOO_STIFF);
            if interface.damping == 0.0 && !is_too_stiff {
                all.push(Advice::new(format!("{path}.damping"), "try 0.1: it takes the chatter of surfaces that open and close"));
            }
            let formulation = self.model().contacts.iter().find(|it| kind == "contact" && it.name == name).map(|it| it.formulation);
            let why = match formulation {
                Some(Formulation::Segment) if is_too_stiff => {
                    "or try `double_pass`, which bears such penalties: here pairs of segments begin and end with gaps of their own"
                }
                Some(Formulation::Segment) => {
                    "try `double_pass`: here pairs of segments begin and end with gaps of their own, each of which gives or takes energy"
                }
                Some(Formulation::Pinball) if !is_too_stiff => "try `double_pass`: pinballs are coarse where bodies slide",
                _ => "",
            };
            if !why.is_empty() {
                all.push(Advice::new(format!("{path}.formulation"), why));
            }
            if is_too_stiff {
                all.push(limit());
                return;
            }
        }
        all.push(Advice::new("run.safety", "try 0.5: if the step is the cause, the drift falls to a third or less"));
        if let Some(index) = self.part() {
            let part = &self.model().parts[index];
            let finer = "take more elements there: what is strained much in one step is not resolved";
            all.push(Advice::new(format!("part[{index}].{}", part.shape.size_path()), finer));
            if part.element == "quad4_reduced" {
                all.push(Advice::new(format!("part[{index}].element"), "try `quad4`: hourglass control has its own energies"));
            }
        }
        all.push(limit());
    }

    /// A softer penalty, by the key that the contact has it by.
    fn softer(&self, all: &mut Vec<Advice>, path: &str, interface: &Interface, why: &str) {
        match &interface.law {
            ContactLaw::Penalty(Penalty::Automatic { scale, .. }) => {
                let less = if *scale > TOO_STIFF {
                    "leave it out: 1 is as stiff as the elements behind".to_string()
                } else {
                    format!("try a tenth, {}", scale / 10.0)
                };
                all.push(Advice::new(format!("{path}.penalty_scale"), format!("{less}; {why}")));
            }
            ContactLaw::Penalty(_) => all.push(Advice::new(
                format!("{path}.penalty"),
                format!("try a tenth, or leave it out (the automatic penalty follows the elements): {why}"),
            )),
            ContactLaw::PressureGap { .. } => {
                all.push(Advice::new(format!("{path}.pressures"), format!("let the pressure grow less steeply: {why}")))
            }
            ContactLaw::Multiplier => {
                all.push(Advice::new(format!("{path}.law"), format!("try the law `penalty`, which keeps energy: {why}")))
            }
        }
    }
}

/// Place in its list of what a path such as `load[2]` names, if it is of this kind.
fn number(path: &str, kind: &str) -> Option<usize> {
    path.strip_prefix(kind)?.strip_prefix('[')?.strip_suffix(']')?.parse().ok()
}

/// What a key is now, and where it stands.
pub(super) fn key_now(loaded: &Loaded, path: &str) -> [String; 2] {
    let place = loaded.key(path);
    let default = sections::find(path).and_then(|key| match key.need {
        Need::Default(value) | Need::Optional(value) => Some(value.trim_matches('"').to_string()),
        Need::Value(value) => Some(value.to_string()),
        Need::Required => None,
    });
    let file = std::path::Path::new(&place.file).file_name().map_or(place.file.clone(), |name| name.to_string_lossy().into_owned());
    match (place.written, place.line) {
        (Some(written), 0) => [code(&written), format!("`{}`", place.file)],
        (Some(written), line) => [code(&written), format!("{file}, line {line}")],
        (None, line) => {
            let now = default.map_or("not there".to_string(), |value| format!("not there: {value}"));
            [now, if line == 0 { format!("add it to {file}") } else { format!("add it: {file}, below line {line}") }]
        }
    }
}

/// A value as it is written, on one line.
fn code(written: &str) -> String {
    let line = written.split_whitespace().collect::<Vec<_>>().join(" ").replace('`', "'");
    let short: String = line.chars().take(60).collect();
    if short.len() < line.len() { format!("`{short} ...`") } else { format!("`{short}`") }
}
