//! Faults of contacts, and of what contacts and obstacles share: law, friction, times.

use super::{Check, motion};
use crate::contact::messages::{COMBINATION, FRICTION, JOINED_TWICE, NOTHING_GIVES_WAY, PRESSURES, SHARED_SURFACE};
use crate::contact::search;
use crate::mesh::messages::SHELLS;
use crate::model::messages::{LIST_LENGTH, OF_REVOLUTION, UNKNOWN_NAME};
use crate::model::reference::{Reference, Wanted};
use crate::model::{Contact, ContactLaw, Formulation, Friction, InitialPenetration, Interface, Part, Partners, Penalty};
use crate::quantity::{Dimension, Range};
use crate::vocabulary::excerpt;
use std::collections::BTreeMap;

/// What can't go together: whether it is there, the key, the reason, what to do.
type Contradiction = (bool, &'static str, &'static str, &'static str);

/// What to do about two contacts for the same surfaces.
const ONE_TOO_MANY: &str = "leave one of the two contacts out: their forces would add up";

impl Check<'_> {
    pub(super) fn contacts(&mut self) {
        let model = self.model;
        self.names("contact", model.contacts.iter().map(|contact| contact.name.as_str()));
        let searches: Vec<&str> = search::registry::<2>().iter().map(|kind| kind.name).collect();
        for (index, contact) in model.contacts.iter().enumerate() {
            let path = format!("contact[{index}]");
            match &contact.partners {
                Partners::Between(between) => self.surfaces(&path, between),
                Partners::Bodies(bodies) => self.bodies(&path, bodies),
            }
            self.interface(&path, &contact.interface);
            let parts: Vec<String> = match &contact.partners {
                // Sides by their parts; groups of mesh files may be of any.
                Partners::Between(between) => {
                    let parts: Vec<String> = between.iter().map(|name| name.split('.').next().unwrap_or_default().to_string()).collect();
                    let is_part = |name: &String| model.parts.iter().any(|part| part.name == *name);
                    if parts.iter().all(is_part) { parts } else { Vec::new() }
                }
                Partners::Bodies(bodies) => bodies.clone(),
            };
            self.pushes_no_shells(&path, &contact.interface, &parts);
            self.formulation(&path, contact);
            if let Some(strength) = contact.tied.filter(|strength| *strength != f64::INFINITY) {
                self.number(&format!("{path}.tie_strength"), strength);
            }
            if !contact.search.is_empty() {
                self.known(&format!("{path}.search"), "search", &contact.search, &searches);
            }
        }
        self.pairs_twice();
        self.bodies_twice();
    }

    /// Two surfaces: they must be there, differ, and one of them must be able to yield.
    fn surfaces(&mut self, path: &str, between: &[String; 2]) {
        let mut found = [None, None];
        for (side, name) in between.iter().enumerate() {
            found[side] = self.reference(&format!("{path}.between[{side}]"), name, Wanted::Surface);
        }
        let [Some(a), Some(b)] = found else { return };
        let whole = |one: Reference, other: Reference| match (one, other) {
            (Reference::Part(part), Reference::Side { part: of, .. }) => part == of,
            _ => false,
        };
        if a == b || whole(a, b) || whole(b, a) {
            let body = part_of(a).map_or("...", |part| self.model.parts[part].name.as_str());
            self.fault(
                &SHARED_SURFACE,
                format!("{path}.between"),
                format!("`{}` and `{}` share a surface", excerpt(&between[0]), excerpt(&between[1])),
                format!("name two different surfaces; for the contact of a body with itself use `bodies = [\"{}\"]`", excerpt(body)),
            );
        } else if let (Some(first), Some(second)) = (part_of(a), part_of(b))
            && [first, second].iter().all(|part| motion::is_driven(&self.model.parts[*part]))
        {
            self.nothing_gives_way(format!("{path}.between"));
        }
    }

    fn bodies(&mut self, path: &str, bodies: &[String]) {
        let path = format!("{path}.bodies");
        self.part_list(&path, bodies);
        self.with_surface(&path, bodies);
        if self.all_driven(bodies) {
            self.nothing_gives_way(path);
        }
    }

    /// Whether the parts of these names (none: all) are there and all move as they are reported.
    pub(super) fn all_driven(&self, names: &[String]) -> bool {
        let parts = &self.model.parts;
        let driven = |name: &String| parts.iter().find(|part| part.name == *name).is_some_and(motion::is_driven);
        if names.is_empty() { !parts.is_empty() && parts.iter().all(motion::is_driven) } else { names.iter().all(driven) }
    }

    pub(super) fn nothing_gives_way(&mut self, path: String) {
        self.fault(
            &NOTHING_GIVES_WAY,
            path,
            "nothing can deform: all bodies here are rigid and their motion is prescribed",
            "let one of them deform, or be free in x, y or rotation",
        );
    }

    /// What the formulation, a tie and the law allow.
    fn formulation(&mut self, path: &str, contact: &Contact) {
        if let Formulation::SinglePass { slave } = contact.formulation
            && slave > 1
        {
            self.fault(&UNKNOWN_NAME, format!("{path}.slave"), format!("the slave is surface {slave}, but there are only 0 and 1"), "");
        }
        if contact.formulation == Formulation::Pinball && self.model.is_axisymmetric() {
            let message = "pinballs are cylinders in 2D, which axisymmetric bodies do not have";
            self.fault(&OF_REVOLUTION, format!("{path}.formulation"), message, "take `double_pass`, `single_pass` or `segment`");
        }
        for (_, key, message, help) in contradictions(contact).into_iter().filter(|(holds, ..)| *holds) {
            self.fault(&COMBINATION, format!("{path}.{key}"), message, help);
        }
    }

    /// Pairs of surfaces that two contacts join at the same time.
    fn pairs_twice(&mut self) {
        let contacts = &self.model.contacts;
        let mut pairs: BTreeMap<[&str; 2], Vec<usize>> = BTreeMap::new();
        for (index, contact) in contacts.iter().enumerate() {
            let Partners::Between(between) = &contact.partners else { continue };
            let pair = sorted(between);
            let before = pairs.entry(pair).or_default();
            if let Some(first) = before.iter().find(|other| overlap(&contacts[**other], contact)) {
                let message = format!("`{}` and `{}` are already joined by contact[{first}]", excerpt(pair[0]), excerpt(pair[1]));
                self.fault(&JOINED_TWICE, format!("contact[{index}].between"), message, ONE_TOO_MANY);
            }
            before.push(index);
        }
    }

    /// Bodies that two contacts take at the same time, and pairs of surfaces that meet as bodies besides.
    fn bodies_twice(&mut self) {
        let contacts = &self.model.contacts;
        let mut of_part: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
        let (mut of_all, mut of_any) = (Vec::new(), Vec::new());
        for (index, contact) in contacts.iter().enumerate() {
            let Partners::Bodies(bodies) = &contact.partners else { continue };
            let earlier = |all: &[usize]| all.iter().copied().find(|other| overlap(&contacts[*other], contact));
            let shared = bodies.iter().find_map(|part| Some((part, earlier(of_part.get(part.as_str())?)?)));
            let path = format!("contact[{index}].bodies");
            if let Some(first) = earlier(if bodies.is_empty() { &of_any } else { &of_all }) {
                self.fault(&JOINED_TWICE, path, format!("contact[{first}] already joins the same bodies"), ONE_TOO_MANY);
            } else if let Some((part, first)) = shared {
                let message = format!("part `{}` already meets itself and others in contact[{first}]", excerpt(part));
                self.fault(&JOINED_TWICE, path, message, ONE_TOO_MANY);
            }
            of_any.push(index);
            of_all.extend(bodies.is_empty().then_some(index));
            for part in bodies {
                of_part.entry(part).or_default().push(index);
            }
        }
        for (index, contact) in contacts.iter().enumerate().filter(|(_, contact)| contact.tied.is_none()) {
            let Partners::Between(between) = &contact.partners else { continue };
            let Some([first, second]) = self.parts_between(between) else { continue };
            let both = |other: &&usize| match &contacts[**other].partners {
                Partners::Bodies(bodies) => bodies.is_empty() || bodies.iter().any(|name| name == second),
                Partners::Between(_) => false,
            };
            let mut among = of_part.get(first).into_iter().flatten().chain(&of_all).filter(both);
            if let Some(other) = among.find(|other| overlap(&contacts[**other], contact)) {
                let message =
                    format!("`{}` and `{}` already meet as bodies of contact[{other}]", excerpt(&between[0]), excerpt(&between[1]));
                self.fault(&JOINED_TWICE, format!("contact[{index}].between"), message, ONE_TOO_MANY);
            }
        }
    }

    /// Names of the parts that two surfaces belong to.
    fn parts_between(&self, between: &[String; 2]) -> Option<[&str; 2]> {
        let part = |name: &String| Some(self.model.parts[part_of(self.model.reference(name, Wanted::Surface).ok()?)?].name.as_str());
        Some([part(&between[0])?, part(&between[1])?])
    }

    /// What contacts and obstacles share.
    pub(super) fn interface(&mut self, path: &str, interface: &Interface) {
        match &interface.law {
            ContactLaw::Penalty(penalty) => self.penalty(path, *penalty),
            ContactLaw::PressureGap { gaps, pressures } => self.pressure_gap(path, gaps, pressures),
            ContactLaw::Multiplier if interface.damping > 0.0 => self.fault(
                &COMBINATION,
                format!("{path}.damping"),
                "a multiplier contact has no spring whose motion could be damped",
                "leave `damping` out, or take the law `penalty`",
            ),
            ContactLaw::Multiplier => {}
        }
        self.number(&format!("{path}.damping"), interface.damping);
        self.number(&format!("{path}.thickness"), interface.thickness);
        if let Some(friction) = interface.friction {
            self.friction(path, friction);
        }
        self.window(path, ["birth", "death"], interface.active);
    }

    /// Shells and beams among these parts (none: all) can't be pushed out.
    pub(super) fn pushes_no_shells(&mut self, path: &str, interface: &Interface, parts: &[String]) {
        let meets = |part: &&Part| part.has_rotations() && !part.has_no_surface() && (parts.is_empty() || parts.contains(&part.name));
        if interface.initial_penetration == InitialPenetration::PushOut
            && let Some(part) = self.model.parts.iter().find(meets)
        {
            let message = format!("nodes on the faces of `{}` go with its middle, and can't be pushed out one by one", excerpt(&part.name));
            self.fault(&SHELLS, format!("{path}.initial_penetration"), message, "move the parts apart, or let it be \"ignore\"");
        }
    }

    fn penalty(&mut self, path: &str, penalty: Penalty) {
        match penalty {
            Penalty::Automatic { scale, .. } => self.number(&format!("{path}.penalty_scale"), scale),
            Penalty::PerNode(value) => self.number(&format!("{path}.penalty"), value),
            Penalty::Pressure(value) => {
                self.within(&format!("{path}.penalty"), value, Dimension::PRESSURE_PER_LENGTH, Range::Positive);
            }
        }
    }

    fn pressure_gap(&mut self, path: &str, gaps: &[f64], pressures: &[f64]) {
        let (at_gaps, at_pressures) = (format!("{path}.gaps"), format!("{path}.pressures"));
        self.each(&at_gaps, gaps);
        self.each(&at_pressures, pressures);
        if gaps.len() < 2 {
            self.fault(
                &LIST_LENGTH,
                at_gaps.as_str(),
                format!("a table of pressures needs at least 2 gaps, but there are {}", gaps.len()),
                "",
            );
        }
        if gaps.len() != pressures.len() {
            let message = format!("there are {} gaps, but {} pressures", gaps.len(), pressures.len());
            self.fault(&LIST_LENGTH, at_pressures.as_str(), message, "give one pressure for each gap");
        }
        self.ascending(&at_gaps, "gaps", gaps, "m");
        if let Some(at) = pressures.windows(2).position(|pair| pair[1] > pair[0]) {
            let message = format!("the pressure rises with the gap, from {} Pa to {} Pa", pressures[at], pressures[at + 1]);
            self.fault(
                &PRESSURES,
                format!("{at_pressures}[{}]", at + 1),
                message,
                "give them from the deepest penetration to the widest gap",
            );
        } else if let Some(last) = pressures.last().filter(|last| **last > 0.0) {
            let message = format!("the pressure at the last gap is {last} Pa: surfaces would push each other over any distance");
            self.fault(&PRESSURES, format!("{at_pressures}[{}]", pressures.len() - 1), message, "let it end with 0");
        } else if !pressures.is_empty() && pressures.iter().all(|pressure| *pressure == 0.0) {
            self.fault(&PRESSURES, at_pressures, "all pressures are zero, so nothing keeps the surfaces apart", "give a pressure above 0");
        }
    }

    fn friction(&mut self, path: &str, friction: Friction) {
        self.number(&format!("{path}.friction"), friction.coefficient);
        self.within(&format!("{path}.friction_decay"), friction.decay, Dimension::SLOWNESS, Range::NotNegative);
        self.within(&format!("{path}.friction_viscosity"), friction.viscosity, Dimension::VISCOSITY_PER_LENGTH, Range::NotNegative);
        if friction.limit != f64::INFINITY {
            self.number(&format!("{path}.friction_limit"), friction.limit);
        }
        let Some(dynamic) = friction.dynamic else {
            if friction.decay > 0.0 {
                let help = "give `friction_dynamic`, or leave `friction_decay` out";
                self.fault(&FRICTION, format!("{path}.friction_decay"), "there is no dynamic friction that it could decay to", help);
            }
            return;
        };
        let path = format!("{path}.friction_dynamic");
        self.number(&path, dynamic);
        if dynamic > friction.coefficient {
            let message = format!("dynamic friction {dynamic} is more than the static one, {}", friction.coefficient);
            self.fault(
                &FRICTION,
                path,
                message,
                "a body that slides is held less than one that sticks: give at most the value of `friction`",
            );
        } else if friction.decay == 0.0 {
            self.fault(&FRICTION, path, "dynamic friction is never reached without a decay", "give `friction_decay`, such as \"0.1 s/m\"");
        }
    }
}

/// What the formulation, a tie and the law of a contact don't allow.
fn contradictions(contact: &Contact) -> [Contradiction; 6] {
    let interface = &contact.interface;
    let bodies = matches!(contact.partners, Partners::Bodies(_));
    let tied = contact.tied.is_some();
    let pinball = contact.formulation == Formulation::Pinball;
    let segment = contact.formulation == Formulation::Segment;
    let per_node = matches!(interface.law, ContactLaw::Penalty(Penalty::PerNode(_)));
    let pressure_gap = matches!(interface.law, ContactLaw::PressureGap { .. });
    [
        (
            bodies && matches!(contact.formulation, Formulation::SinglePass { .. }),
            "formulation",
            "a single pass contact needs a slave surface, but bodies that also meet themselves have none",
            "take `double_pass`, or name the two surfaces in `between`",
        ),
        (bodies && tied, "tied", "a tie joins two surfaces, but `bodies` names none", "name the two surfaces in `between`"),
        (
            per_node && (segment || pinball),
            "penalty",
            "segments and pinballs have no slave nodes that a stiffness per node could belong to",
            "give a pressure per depth (Pa/m), or leave it out",
        ),
        (
            pinball && tied,
            "formulation",
            "pinballs only push, so they can't hold surfaces together",
            "take `double_pass`, `single_pass` or `segment` for a tie",
        ),
        (
            tied && segment && interface.law == ContactLaw::Multiplier,
            "law",
            "segments or facets that are tied have more springs than their nodes can meet as conditions",
            "take `penalty`, or tie nodes by `double_pass` or `single_pass`",
        ),
        (tied && pressure_gap, "law", "a pressure can't hold surfaces together", "take `penalty` or `multiplier` for a tie"),
    ]
}

fn sorted(between: &[String; 2]) -> [&str; 2] {
    let mut pair = [between[0].as_str(), between[1].as_str()];
    pair.sort_unstable();
    pair
}

/// Whether two contacts act at the same time.
fn overlap(one: &Contact, other: &Contact) -> bool {
    let (one, other) = (one.interface.active, other.interface.active);
    one[0] < other[1] && other[0] < one[1]
}

/// The part that a surface belongs to, if the name says so.
fn part_of(reference: Reference) -> Option<usize> {
    match reference {
        Reference::Part(part) | Reference::Side { part, .. } => Some(part),
        Reference::Group { .. } => None,
    }
}
