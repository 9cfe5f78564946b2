//! Amplitudes, prescribed motion, initial velocities and loads of a deck.

use super::Importer;
use super::report::Outcome::{Approximated, Ignored};
use crate::abaqus::deck::Surface;
use crate::abaqus::element_kind::{Family, LOWER};
use crate::abaqus::messages::SYNTAX;
use crate::abaqus::text::{Line, folded, shown};
use embate_solver::error::Fault;
use std::collections::BTreeSet;

/// An amplitude: a function of time.
#[derive(Clone, Debug, Default)]
pub(super) struct Amplitude {
    pub(super) name: String,
    pub(super) times: Vec<f64>,
    pub(super) values: Vec<f64>,
    pub(super) smooth: bool,
}

/// What a boundary condition prescribes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Prescribed {
    Displacement,
    Velocity,
    Acceleration,
}

/// One component of prescribed motion: 0 x, 1 y, 2 z, 3 rotation about z, 4 about x and 5 about y.
#[derive(Clone, Debug)]
pub(super) struct Boundary {
    pub(super) at: usize,
    /// Group of the mesh; `None`: nodes of no element.
    pub(super) group: Option<String>,
    pub(super) nodes: Vec<u32>,
    pub(super) axis: usize,
    pub(super) prescribed: Prescribed,
    pub(super) value: f64,
    /// In capitals.
    pub(super) amplitude: Option<String>,
}

/// A load.
#[derive(Clone, Debug)]
pub(super) enum Load {
    Gravity { at: usize, elements: BTreeSet<u32>, acceleration: [f64; 3], amplitude: Option<String> },
    Force { at: usize, group: String, force: [f64; 3], amplitude: Option<String> },
    Moment { at: usize, group: String, moment: [f64; 3], amplitude: Option<String> },
    Pressure { at: usize, group: String, pressure: f64, amplitude: Option<String> },
}

pub(super) fn amplitude(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    let block = importer.block(at);
    let name = block.parameter("NAME").unwrap_or_default().to_string();
    let smooth = block.is("DEFINITION", "SMOOTH STEP");
    if block.has("DEFINITION") && !smooth && !block.is("DEFINITION", "TABULAR") || block.is("VALUE", "ABSOLUTE") {
        importer.note(
            at,
            Ignored,
            "only TABULAR and SMOOTH STEP with relative values are read; what names this amplitude does not act either",
        );
        return Ok(());
    }
    let mut numbers = Vec::new();
    for &line in &block.data {
        for number in importer.numbers(line, "a time or value")? {
            numbers.extend(number);
        }
    }
    let (times, values): (Vec<f64>, Vec<f64>) = numbers.chunks_exact(2).map(|pair| (pair[0], pair[1])).unzip();
    if times.is_empty() || !numbers.len().is_multiple_of(2) || times.windows(2).any(|pair| pair[1] <= pair[0]) {
        let message = format!("amplitude {} is not a list of pairs with ascending times", shown(&name));
        return Err(importer.text.fault(&SYNTAX, block.line, message, "write time, value, time, value, ..."));
    }
    importer.amplitudes.insert(folded(&name), Amplitude { name, times, values, smooth });
    Ok(())
}

fn amplitude_of(importer: &Importer<'_>, at: usize) -> Option<String> {
    importer.block(at).parameter("AMPLITUDE").map(folded)
}

/// The components that a degree of freedom or a label stands for; `None`: not known.
fn axes(word: &str) -> Option<Vec<usize>> {
    Some(match word {
        "XSYMM" => vec![0, 3, 5],
        "YSYMM" => vec![1, 3, 4],
        "ZSYMM" => vec![2, 4, 5],
        "ENCASTRE" => vec![0, 1, 2, 3, 4, 5],
        "PINNED" => vec![0, 1, 2],
        _ => return None,
    })
}

pub(super) fn boundary(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    let block = importer.block(at);
    if block.is("OP", "NEW")
        && let Some(step) = importer.step_at
    {
        // It removes what holds before the step, not what other blocks of the step say.
        importer.boundaries.retain(|boundary| boundary.at > step);
    }
    let prescribed = match block.parameter("TYPE").map(folded).as_deref() {
        None | Some("DISPLACEMENT") => Prescribed::Displacement,
        Some("VELOCITY") => Prescribed::Velocity,
        Some("ACCELERATION") => Prescribed::Acceleration,
        Some(other) => {
            importer.note(at, Ignored, &format!("conditions of the type {other} have no counterpart"));
            return Ok(());
        }
    };
    for &line in &block.data {
        let fields = importer.text.fields(line);
        let field = |k: usize| fields.get(k).copied().unwrap_or_default();
        let (all, value) = match axes(&folded(field(1))) {
            Some(all) => (all, 0.0),
            None => {
                let first = importer.text.tag(line, field(1), "a degree of freedom")?;
                let last = if field(2).is_empty() { first } else { importer.text.tag(line, field(2), "a degree of freedom")? };
                let value = if field(3).is_empty() { 0.0 } else { importer.text.number(line, field(3), "a prescribed value")? };
                ((0..6).filter(|axis| (first..=last).contains(&[1, 2, 3, 6, 4, 5][*axis])).collect(), value)
            }
        };
        // Out of the plane nothing moves anyway.
        let all: Vec<usize> = all.into_iter().filter(|axis| importer.is_3d() || [0, 1, 3].contains(axis)).collect();
        for instance in importer.deck.instances_of(at) {
            let (group, nodes) = importer.node_group(line, instance, field(0))?;
            for &axis in &all {
                let amplitude = amplitude_of(importer, at);
                importer.boundaries.push(Boundary { at, group: group.clone(), nodes: nodes.clone(), axis, prescribed, value, amplitude });
            }
        }
    }
    Ok(())
}

pub(super) fn initial(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    let block = importer.block(at);
    if !block.is("TYPE", "VELOCITY") {
        importer.note(at, Ignored, "only TYPE=VELOCITY is read; the bodies begin without this");
        return Ok(());
    }
    for &line in &block.data {
        let fields = importer.text.fields(line);
        let field = |k: usize| fields.get(k).copied().unwrap_or_default();
        let axis = importer.text.tag(line, field(1), "a degree of freedom")?;
        let value = importer.text.number(line, field(2), "a velocity")?;
        if axis == 0 || axis as usize > importer.dimension() {
            importer.ignored(
                at,
                line,
                if importer.is_3d() { "an angular velocity" } else { "a velocity out of the plane, or an angular velocity" },
            );
            continue;
        }
        for instance in importer.deck.instances_of(at) {
            for node in importer.deck.nodes_named(importer.text, line, instance, field(0))? {
                importer.velocities.entry(node).or_default()[axis as usize - 1] = value;
            }
        }
    }
    importer.velocity_blocks.push(at);
    Ok(())
}

pub(super) fn nodal_force(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    for &line in &importer.block(at).data {
        let fields = importer.text.fields(line);
        let field = |k: usize| fields.get(k).copied().unwrap_or_default();
        let axis = importer.text.tag(line, field(1), "a degree of freedom")? as usize;
        let value = importer.text.number(line, field(2), "a force")?;
        let turns = if importer.is_3d() { 4..=6 } else { 6..=6 };
        for instance in importer.deck.instances_of(at) {
            let (group, nodes) = importer.node_group(line, instance, field(0))?;
            let rotating = nodes.iter().filter(|node| importer.rotating[**node as usize]).count();
            let amplitude = amplitude_of(importer, at);
            // The sum over the nodes along one axis.
            let along = |axis: usize, count: usize| [0, 1, 2].map(|k| if k == axis { value * count as f64 } else { 0.0 });
            match group {
                Some(group) if (1..=importer.dimension()).contains(&axis) => {
                    importer.loads.push(Load::Force { at, group, force: along(axis - 1, nodes.len()), amplitude });
                }
                Some(group) if turns.contains(&axis) && rotating > 0 => {
                    importer.loads.push(Load::Moment { at, group, moment: along(axis - 4, rotating), amplitude });
                }
                _ => importer.ignored(
                    at,
                    line,
                    "a moment on nodes that do not rotate, a force out of the plane, or one on nodes of no element",
                ),
            }
        }
    }
    Ok(())
}

pub(super) fn distributed(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    for &line in &importer.block(at).data {
        let fields = importer.text.fields(line);
        let field = |k: usize| fields.get(k).copied().unwrap_or_default();
        let label = folded(field(1));
        for instance in importer.deck.instances_of(at) {
            match label.as_str() {
                "GRAV" => gravity(importer, at, line, instance)?,
                // It acts along the normal: it presses on the face behind it.
                "P" => pressure(importer, at, line, (instance, "SNEG", "P"))?,
                _ if label.strip_prefix(['P', 'E']).is_some_and(|number| number.parse::<u8>().is_ok()) => {
                    pressure(importer, at, line, (instance, &label, &label))?;
                }
                _ => importer.ignored(at, line, &format!("a load {label} has no counterpart in the import and does not act")),
            }
        }
    }
    Ok(())
}

/// A pressure on a side of elements: the instance, the name of the side, and that of the load.
fn pressure(importer: &mut Importer<'_>, at: usize, line: Line, (instance, side, label): (usize, &str, &str)) -> Result<(), Fault> {
    let fields = importer.text.fields(line);
    let field = |k: usize| fields.get(k).copied().unwrap_or_default();
    let value = importer.text.number(line, field(2), "a pressure")?;
    let elements = importer.deck.elements_named(importer.text, line, instance, field(0))?;
    if elements.iter().any(|element| importer.deck.elements[*element as usize].kind.family == Family::Beam) {
        importer.ignored(at, line, "a load along beams does not act: give it as `force` on their nodes");
        return Ok(());
    }
    let mut on_edges = false;
    for &element in &elements {
        let face = importer.deck.face(importer.text, line, element, side)?;
        on_edges |= importer.is_3d() && importer.deck.elements[element as usize].kind.family.has_faces() && face > LOWER;
    }
    if on_edges {
        importer.ignored(at, line, "a pressure on edges of shells does not act: give it as `force` on their nodes");
        return Ok(());
    }
    if elements.is_empty() {
        importer.ignored(at, line, "a load on elements that are no bodies");
        return Ok(());
    }
    let full = importer.deck.full_shown(instance, field(0));
    let group =
        importer.add_set(&format!("{label}-{full}"), |group| format!("*SURFACE, TYPE=ELEMENT, NAME=\"{group}\"\n\"{full}\", {side}\n"));
    let amplitude = amplitude_of(importer, at);
    importer.loads.push(Load::Pressure { at, group, pressure: value, amplitude });
    Ok(())
}

fn gravity(importer: &mut Importer<'_>, at: usize, line: Line, instance: usize) -> Result<(), Fault> {
    let fields = importer.text.fields(line);
    let field = |k: usize| fields.get(k).copied().unwrap_or_default();
    let number = |k: usize| if field(k).is_empty() { Ok(0.0) } else { importer.text.number(line, field(k), "a number of gravity") };
    let (size, direction) = (number(2)?, [number(3)?, number(4)?, number(5)?]);
    if direction[2] != 0.0 && !importer.is_3d() {
        importer.ignored(at, line, "gravity out of the plane does not act");
        return Ok(());
    }
    let length = direction[0].hypot(direction[1]).hypot(direction[2]);
    if length == 0.0 {
        return Err(importer.text.fault(&SYNTAX, line, "gravity has no direction", "write set, GRAV, size, x, y, z"));
    }
    let elements = match field(0) {
        "" => BTreeSet::new(),
        name => importer.deck.elements_named(importer.text, line, instance, name)?.into_iter().collect(),
    };
    let acceleration = [0, 1, 2].map(|axis| if direction[axis] == 0.0 { 0.0 } else { size * (direction[axis] / length) });
    let amplitude = amplitude_of(importer, at);
    importer.loads.push(Load::Gravity { at, elements, acceleration, amplitude });
    Ok(())
}

pub(super) fn surface_load(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    for &line in &importer.block(at).data {
        let fields = importer.text.fields(line);
        let field = |k: usize| fields.get(k).copied().unwrap_or_default();
        let key = importer.surface(line, field(0))?;
        let is_surface = match importer.deck.surfaces.get(&key).and_then(|it| it.members.first()) {
            Some(Surface::Sides(sides)) => importer.is_surface(sides),
            _ => false,
        };
        let group = importer.names.surfaces.get(&key).filter(|_| is_surface).cloned();
        let (Some(group), "P") = (group, folded(field(1)).as_str()) else {
            importer.ignored(at, line, "only a pressure (P) on edges or faces of elements is read");
            continue;
        };
        let pressure = importer.text.number(line, field(2), "a pressure")?;
        let amplitude = amplitude_of(importer, at);
        importer.loads.push(Load::Pressure { at, group, pressure, amplitude });
    }
    if importer.block(at).data.is_empty() {
        importer.note(at, Approximated, "no data lines: nothing to apply");
    }
    Ok(())
}
