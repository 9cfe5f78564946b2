//! Contact, ties and rigid bodies of a deck.

use super::Importer;
use super::report::Outcome::Ignored;
use crate::abaqus::deck::Surface;
use crate::abaqus::messages::{SYNTAX, UNKNOWN};
use crate::abaqus::text::{Line, folded, shown};
use embate_solver::error::Fault;
use std::collections::BTreeSet;

/// What happens where surfaces meet.
#[derive(Clone, Debug, Default)]
pub(super) struct Interaction {
    pub(super) friction: Option<f64>,
    /// Dynamic coefficient and rate of decay.
    pub(super) dynamic: Option<[f64; 2]>,
    pub(super) limit: Option<f64>,
    /// Pressure per penetration.
    pub(super) penalty: Option<f64>,
    /// Pressures and overclosures.
    pub(super) table: Vec<[f64; 2]>,
}

/// Contact between two surfaces.
#[derive(Clone, Debug)]
pub(super) struct Contact {
    pub(super) at: usize,
    /// Full names, in capitals.
    pub(super) surfaces: [String; 2],
    /// In capitals.
    pub(super) interaction: Option<String>,
    pub(super) tied: bool,
    /// Only the nodes of the first surface are checked.
    pub(super) single: bool,
}

/// A rigid body.
#[derive(Clone, Debug)]
pub(super) struct Rigid {
    pub(super) at: usize,
    pub(super) reference: u32,
    /// Elements, or a rigid surface (full name, in capitals).
    pub(super) elements: BTreeSet<u32>,
    pub(super) surface: Option<String>,
}

pub(super) fn interaction(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    let name = folded(importer.block(at).parameter("NAME").unwrap_or_default());
    importer.interactions.entry(name.clone()).or_default();
    importer.interaction = Some(name);
    if !importer.block(at).data.is_empty() {
        importer.approximated(at, "its data line (a depth out of the plane) is not read");
    }
    Ok(())
}

/// The interaction that a block belongs to.
fn current<'b>(importer: &'b mut Importer<'_>) -> Option<&'b mut Interaction> {
    let name = importer.interaction.clone()?;
    importer.interactions.get_mut(&name)
}

const NOWHERE: &str = "it stands below no *SURFACE INTERACTION and does not act";

pub(super) fn friction(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    let block = importer.block(at);
    let numbers = importer.first_numbers(at, "a coefficient of friction")?;
    let number = |place: usize| numbers.get(place).copied().flatten();
    let decays = block.has("EXPONENTIAL DECAY");
    let limit = match block.parameter("TAUMAX") {
        Some(limit) => Some(importer.text.number(block.line, limit, "TAUMAX")?),
        None => None,
    };
    let coefficient = importer.needed(at, &numbers, 0, "a coefficient")?;
    if block.data.len() > 1 || !decays && (1..4).any(|place| number(place).is_some()) {
        importer.approximated(at, "only the first coefficient is read: it depends neither on slip rate nor on pressure nor on temperature");
    }
    if block.has("SLIP TOLERANCE") {
        importer.approximated(at, "SLIP TOLERANCE: what sticks is held as stiffly as the contact, whatever it says");
    }
    let Some(current) = current(importer) else {
        importer.note(at, Ignored, NOWHERE);
        return Ok(());
    };
    if coefficient > 0.0 {
        current.friction = Some(coefficient);
        current.limit = limit;
        current.dynamic = decays.then(|| [number(1).unwrap_or(coefficient), number(2).unwrap_or(0.0)]).filter(|it| it[1] > 0.0);
    }
    Ok(())
}

pub(super) fn behaviour(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    let block = importer.block(at);
    let kind = block.parameter("PRESSURE-OVERCLOSURE").map_or("HARD".to_string(), folded);
    let mut table = Vec::new();
    let mut penalty = None;
    match kind.as_str() {
        "HARD" => {}
        "LINEAR" => {
            let numbers = importer.first_numbers(at, "a stiffness")?;
            penalty = Some(importer.needed(at, &numbers, 0, "a stiffness")?);
        }
        "TABULAR" => {
            for &line in &block.data {
                let numbers = importer.numbers(line, "a number of the table")?;
                table.push([importer.needed(at, &numbers, 0, "a pressure")?, importer.needed(at, &numbers, 1, "an overclosure")?]);
            }
        }
        other => {
            importer.note(at, Ignored, &format!("PRESSURE-OVERCLOSURE={other} has no counterpart; the automatic penalty acts instead"));
            return Ok(());
        }
    }
    match current(importer) {
        Some(current) => {
            current.penalty = penalty;
            current.table = table;
        }
        None => importer.note(at, Ignored, NOWHERE),
    }
    Ok(())
}

pub(super) fn pair(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    let block = importer.block(at);
    let interaction = block.parameter("INTERACTION").map(folded);
    let single = block.is("TYPE", "NODE TO SURFACE");
    for &line in &block.data {
        add(importer, at, line, interaction.clone(), false, single)?;
    }
    Ok(())
}

pub(super) fn tie(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    for &line in &importer.block(at).data {
        add(importer, at, line, None, true, false)?;
    }
    Ok(())
}

fn add(importer: &mut Importer<'_>, at: usize, line: Line, interaction: Option<String>, tied: bool, single: bool) -> Result<(), Fault> {
    let fields = importer.text.fields(line);
    let second = fields.get(1).copied().unwrap_or_default();
    if second.is_empty() || folded(second) == folded(fields[0]) {
        importer.ignored(at, line, "contact of one surface with itself does not act; `[[contact]]` with `bodies` would be its counterpart");
        return Ok(());
    }
    let surfaces = [importer.surface(line, fields[0])?, importer.surface(line, second)?];
    for surface in &surfaces {
        match importer.deck.surfaces.get(surface).and_then(|it| it.members.first()) {
            Some(Surface::Sides(sides)) if importer.is_surface(sides) => {}
            Some(Surface::Lines(_)) if !tied => {}
            Some(Surface::Other(what)) => {
                importer.ignored(at, line, &format!("surface {surface} is {what}; this contact does not act"));
                return Ok(());
            }
            _ => {
                importer.ignored(at, line, &format!("surface {surface} has no edges or faces of elements; this contact does not act"));
                return Ok(());
            }
        }
    }
    importer.contacts.push(Contact { at, surfaces, interaction, tied, single });
    Ok(())
}

pub(super) fn inclusions(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    let block = importer.block(at);
    if block.has("ALL EXTERIOR") {
        importer.all.get_or_insert((at, None));
        return Ok(());
    }
    for &line in &block.data {
        add(importer, at, line, None, false, false)?;
    }
    Ok(())
}

pub(super) fn property(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    for &line in &importer.block(at).data {
        let fields = importer.text.fields(line);
        let [first, second, name] = [0, 1, 2].map(|place| fields.get(place).copied().unwrap_or_default());
        match &mut importer.all {
            Some((_, all)) if first.is_empty() && second.is_empty() => *all = Some(folded(name)),
            _ => importer.ignored(at, line, "only a property of the contact of all bodies (two empty fields) is read"),
        }
    }
    Ok(())
}

pub(super) fn rigid_body(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    let block = importer.block(at);
    let Some(node) = block.parameter("REF NODE").filter(|node| !node.is_empty()) else {
        return Err(importer.text.fault(&SYNTAX, block.line, "*RIGID BODY has no reference node", "add REF NODE=..."));
    };
    for instance in importer.deck.instances_of(at) {
        let nodes = importer.deck.nodes_named(importer.text, block.line, instance, node)?;
        let &[reference] = nodes.as_slice() else {
            return Err(importer.text.fault(&UNKNOWN, block.line, format!("{} is not one node", shown(node)), "name a set of one node"));
        };
        let elements = match block.parameter("ELSET") {
            Some(set) => importer.deck.elements_named(importer.text, block.line, instance, set)?.into_iter().collect(),
            None => BTreeSet::new(),
        };
        let surface = match block.parameter("ANALYTICAL SURFACE") {
            Some(name) => {
                let full = importer.deck.full_shown(instance, name);
                Some(importer.surface(block.line, &full)?)
            }
            None => None,
        };
        if elements.is_empty() && surface.is_none() {
            importer.note(
                at,
                Ignored,
                if importer.is_3d() {
                    "a rigid body without elements of bodies: give its surface as an `[[obstacle]]`, with `stl` for example; it does not act"
                } else {
                    "a rigid body without plane elements: draw it as an `[[obstacle]]` with `polyline`; it does not act"
                },
            );
            continue;
        }
        importer.rigid.push(Rigid { at, reference, elements, surface });
    }
    Ok(())
}

/// Surfaces are read with the geometry; here it is only reported which nothing can be made of.
pub(super) fn surface(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    let name = importer.block(at).parameter("NAME").unwrap_or_default();
    for instance in importer.deck.instances_of(at) {
        let full = importer.deck.full(instance, name);
        if let Some(Surface::Other(what)) = importer.deck.surfaces.get(&full).and_then(|it| it.members.first()) {
            importer.note(at, Ignored, &format!("a surface {what}; nothing meets it"));
        }
    }
    Ok(())
}
