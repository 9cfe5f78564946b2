//! Sections of a deck: bodies and their material, shells with their thickness, beams with their
//! cross-section.
//!
//! Axes of beams are t from the first to the second node, n1 as the deck gives it as far as it is across,
//! and n2 = t × n1. A deck's 1 becomes the height of a cross-section (`up = n1`), whatever the direction of
//! its elements; an I stands along n2, so that its `up` is n2, where this is one for all of them.

use super::Importer;
use super::material::Material;
use super::report::Outcome::{Approximated, Ignored};
use super::units::{Units, number};
use crate::abaqus::deck::Element;
use crate::abaqus::element_kind::Family;
use crate::abaqus::mesh::NODAL_THICKNESS;
use crate::abaqus::messages::{INCOMPLETE, NO_COUNTERPART, SYNTAX, UNKNOWN};
use crate::abaqus::text::{Block, Line, folded, shown};
use embate_solver::error::Fault;
use embate_solver::quantity::Dimension;

/// Points that a shell may have through its thickness.
const MOST_POINTS: usize = 10;
/// Part of a length that counts as none.
const NEAR: f64 = 1e-6;

/// A section: elements and their material.
#[derive(Clone, Debug)]
pub(super) struct Section {
    /// Block of the deck.
    pub(super) at: usize,
    /// Full name of the element set, in capitals.
    pub(super) set: String,
    /// Name of the material, in capitals.
    pub(super) material: String,
    /// By which forces, masses and energies per unit of depth are to be multiplied.
    pub(super) depth: f64,
    pub(super) body: Body,
}

/// What a section is of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Body {
    Solid,
    /// Without a thickness: that of the nodes.
    Shell {
        thickness: Option<f64>,
        points: usize,
    },
    Membrane {
        thickness: f64,
    },
    Beam {
        shape: CrossSection,
        n1: [f64; 3],
    },
}

/// The cross-section of a beam; a is along n1, b along n2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum CrossSection {
    Round { radius: f64 },
    Tube { radius: f64, wall: f64 },
    Rectangle { a: f64, b: f64 },
    Box { a: f64, b: f64, wall: f64 },
    I { height: f64, width: f64, flange: f64, web: f64 },
    Given { area: f64, i11: f64, i22: f64, torsion: f64 },
}

impl Body {
    /// Whether elements of a family can have it.
    pub(super) fn fits(&self, family: Family) -> bool {
        match self {
            Self::Solid => matches!(family, Family::Plane(_) | Family::Solid),
            Self::Shell { .. } => matches!(family, Family::Shell | Family::Line("axisymmetric")),
            Self::Membrane { .. } => matches!(family, Family::Membrane | Family::Plane("plane_stress")),
            Self::Beam { .. } => matches!(family, Family::Beam | Family::Line("plane_stress")),
        }
    }
}

impl CrossSection {
    /// The key `profile`; `up` where it has a direction.
    fn text(&self, up: [f64; 3], units: &Units) -> String {
        let length = |value: f64| units.write(value, Dimension::LENGTH);
        let up = format!(", up = [{}]", up.map(number).join(", "));
        let own = match *self {
            Self::Round { radius } => return format!("{{ shape = \"round\", diameter = {} }}", length(2.0 * radius)),
            Self::Tube { radius, wall } => {
                return format!("{{ shape = \"tube\", diameter = {}, thickness = {} }}", length(2.0 * radius), length(wall));
            }
            Self::Rectangle { a, b } => format!("shape = \"rectangle\", width = {}, height = {}", length(b), length(a)),
            Self::Box { a, b, wall } => {
                format!("shape = \"box\", width = {}, height = {}, thickness = {}", length(b), length(a), length(wall))
            }
            Self::I { height, width, flange, web } => format!(
                "shape = \"i\", width = {}, height = {}, web = {}, flange = {}",
                length(width),
                length(height),
                length(web),
                length(flange)
            ),
            Self::Given { area, i11, i22, torsion } => {
                let moment = |value: f64| units.write(value, Dimension::AREA_MOMENT);
                let area = units.write(area, Dimension::AREA);
                // The height is along n1: ∫ z² dA is I22.
                let (y, z, torsion) = (moment(i22), moment(i11), moment(torsion));
                format!("shape = \"given\", area = {area}, inertia_y = {y}, inertia_z = {z}, torsion = {torsion}")
            }
        };
        format!("{{ {own}{up} }}")
    }

    /// An I as the integrals over it; its torsion is that of thin walls.
    fn integrals(height: f64, width: f64, flange: f64, web: f64) -> Self {
        let inner = height - 2.0 * flange;
        let area = 2.0 * width * flange + inner * web;
        let i11 = (width * height.powi(3) - (width - web) * inner.powi(3)) / 12.0;
        let i22 = (2.0 * flange * width.powi(3) + inner * web.powi(3)) / 12.0;
        let torsion = (2.0 * width * flange.powi(3) + (height - flange) * web.powi(3)) / 3.0;
        Self::Given { area, i11, i22, torsion }
    }
}

/// A parameter that must be there.
fn needed<'b>(importer: &Importer<'b>, at: usize, name: &str) -> Result<&'b str, Fault> {
    let block = importer.block(at);
    block
        .parameter(name)
        .filter(|value| !value.is_empty())
        .ok_or_else(|| importer.text.fault(&SYNTAX, block.line, format!("*{} has no {name}", block.keyword), format!("add {name}=...")))
}

/// Adds a section for each instance.
fn add(importer: &mut Importer<'_>, at: usize, material: &str, depth: f64, body: Body) -> Result<(), Fault> {
    let set = needed(importer, at, "ELSET")?;
    for instance in importer.deck.instances_of(at) {
        let full = importer.deck.full(instance, set);
        match importer.deck.element_sets.get(&full).map(|it| it.members.is_empty()) {
            Some(false) => importer.sections.push(Section { at, set: full, material: material.to_string(), depth, body }),
            _ if importer.deck.beside.contains_key(&full) => {
                importer.note(at, Ignored, "a section of elements that are no bodies");
            }
            _ => {
                let message = format!("there is no element set {}", shown(set));
                return Err(importer.text.fault(&UNKNOWN, importer.block(at).line, message, "name a set with elements"));
            }
        }
    }
    Ok(())
}

fn lines_left_out(importer: &mut Importer<'_>, at: usize, read: usize) {
    if let Some(&line) = importer.block(at).data.get(read) {
        importer.ignored(at, line, "further lines of a section are not read");
    }
}

/// The first number of a section, greater than 0; `None` where it is left out.
fn thickness(importer: &Importer<'_>, at: usize, numbers: &[Option<f64>]) -> Result<Option<f64>, Fault> {
    let thickness = numbers.first().copied().flatten();
    if let Some(value) = thickness.filter(|value| *value <= 0.0) {
        return Err(importer.text.fault(&SYNTAX, importer.block(at).line, format!("the thickness is {value}"), "it is greater than 0"));
    }
    Ok(thickness)
}

/// A thickness of what has one.
fn of_sheet(importer: &Importer<'_>, at: usize, numbers: &[Option<f64>]) -> Result<f64, Fault> {
    thickness(importer, at, numbers)?.ok_or_else(|| {
        let block = importer.block(at);
        let message = format!("*{} lacks the thickness", block.keyword);
        importer.text.fault(&INCOMPLETE, block.line, message, "give it in the first data line")
    })
}

pub(super) fn solid(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    let material = folded(needed(importer, at, "MATERIAL")?);
    let numbers = importer.first_numbers(at, "a thickness")?;
    let depth = thickness(importer, at, &numbers)?.unwrap_or(1.0);
    add(importer, at, &material, depth, Body::Solid)?;
    per_depth(importer, at, depth);
    lines_left_out(importer, at, 1);
    Ok(())
}

fn per_depth(importer: &mut Importer<'_>, at: usize, depth: f64) {
    if depth != 1.0 {
        let text = format!(
            "thickness {depth}: embate computes per unit of depth; forces, masses and energies of the results \
                are to be multiplied by it"
        );
        importer.approximated(at, &text);
    }
}

pub(super) fn membrane(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    let material = folded(needed(importer, at, "MATERIAL")?);
    let numbers = importer.first_numbers(at, "a thickness")?;
    if importer.is_3d() {
        let thickness = of_sheet(importer, at, &numbers)?;
        add(importer, at, &material, 1.0, Body::Membrane { thickness })?;
    } else {
        let depth = thickness(importer, at, &numbers)?.unwrap_or(1.0);
        add(importer, at, &material, depth, Body::Membrane { thickness: depth })?;
        per_depth(importer, at, depth);
    }
    lines_left_out(importer, at, 1);
    Ok(())
}

pub(super) fn shell(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    let block = importer.block(at);
    let is_general = block.keyword == "SHELL GENERAL SECTION";
    if block.has("COMPOSITE") || (is_general && !block.has("MATERIAL")) {
        let message = format!("*{} with layers or a stiffness of its own has no counterpart", block.keyword);
        let help = "give one thickness and one MATERIAL";
        return Err(importer.text.fault(&NO_COUNTERPART, block.line, message, help));
    }
    let material = folded(needed(importer, at, "MATERIAL")?);
    let numbers = importer.first_numbers(at, "a number of the section")?;
    let is_nodal = block.has("NODAL THICKNESS");
    if is_nodal && importer.deck.thicknesses.is_empty() {
        let message = format!("*{} takes the thickness of the nodes, but there is no *NODAL THICKNESS", block.keyword);
        return Err(importer.text.fault(&INCOMPLETE, block.line, message, "add *NODAL THICKNESS, or leave NODAL THICKNESS out"));
    }
    let thickness = if is_nodal { None } else { Some(of_sheet(importer, at, &numbers)?) };
    let is_gauss = block.is("SECTION INTEGRATION", "GAUSS");
    // As many as Abaqus takes where nothing is said; of a general section two are exact.
    let usual = if is_general {
        2.0
    } else if is_gauss {
        3.0
    } else {
        5.0
    };
    let asked = numbers.get(1).copied().flatten().filter(|_| !is_general).unwrap_or(usual);
    if asked < 1.0 || asked.fract() != 0.0 {
        let message = format!("{asked} points through the thickness");
        return Err(importer.text.fault(&SYNTAX, block.line, message, "give a whole number from 1 on"));
    }
    let points = (asked as usize).min(MOST_POINTS);
    if !is_general {
        let more = if points as f64 == asked { String::new() } else { format!(", {points} instead of {asked}") };
        if !is_gauss || !more.is_empty() {
            let text = format!(
                "points through the thickness are those of Gauss{more}: elastic shells are alike, plastic bending differs by a few per cent"
            );
            importer.approximated(at, &text);
        }
    }
    if let Some(offset) = block.parameter("OFFSET") {
        let is_none = importer.text.number(block.line, offset, "OFFSET").is_ok_and(|value| value == 0.0);
        if !is_none {
            let text = format!("OFFSET={offset}: nodes are in the middle of the thickness; move them by it in the mesh");
            importer.ignored(at, block.line, &text);
        }
    }
    if let Some(ratio) = block.parameter("POISSON") {
        importer.approximated(at, &format!("POISSON={ratio}: the thickness follows from the material, whose stress across it is zero"));
    }
    add(importer, at, &material, 1.0, Body::Shell { thickness, points })?;
    lines_left_out(importer, at, 1);
    Ok(())
}

/// *NODAL THICKNESS is read with the mesh; a section must take it.
pub(super) fn nodal_thickness(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    let takes = |block: &Block| block.keyword.starts_with("SHELL") && block.has("NODAL THICKNESS");
    if !importer.text.blocks.iter().any(takes) {
        importer.ignored(at, importer.block(at).line, "no section of shells takes the thickness of the nodes (NODAL THICKNESS)");
    }
    Ok(())
}

pub(super) fn beam(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    let block = importer.block(at);
    let is_general = block.keyword == "BEAM GENERAL SECTION";
    let shape = cross_section(importer, at)?;
    let n1 = match block.data.get(1) {
        Some(&line) => {
            let numbers = importer.numbers(line, "a component of n1")?;
            let n1: [f64; 3] = std::array::from_fn(|k| numbers.get(k).copied().flatten().unwrap_or(0.0));
            if n1 == [0.0; 3] { [0.0, 0.0, -1.0] } else { n1 }
        }
        None => [0.0, 0.0, -1.0],
    };
    let mut read = 2;
    let material = if block.has("MATERIAL") || !is_general {
        folded(needed(importer, at, "MATERIAL")?)
    } else {
        read = 3;
        own_material(importer, at)?
    };
    if !is_general && block.data.len() > 2 {
        read = 3;
        importer.approximated(at, "numbers of points: the fibres of a beam are embate's own (`profile.points`)");
    }
    // A beam in 2D is a shell in plane stress, as wide as the depth.
    let depth = match shape {
        CrossSection::Rectangle { a, .. } if !importer.is_3d() => a,
        _ => 1.0,
    };
    add(importer, at, &material, depth, Body::Beam { shape, n1 })?;
    if !importer.is_3d() {
        per_depth(importer, at, depth);
    }
    lines_left_out(importer, at, read);
    Ok(())
}

/// The material that *BEAM GENERAL SECTION gives itself: its name.
fn own_material(importer: &mut Importer<'_>, at: usize) -> Result<String, Fault> {
    let block = importer.block(at);
    let lacks = |what: &str| {
        let message = format!("*{} lacks {what}", block.keyword);
        importer.text.fault(&INCOMPLETE, block.line, message, "give DENSITY=..., and E and G in the third data line, or MATERIAL=...")
    };
    let density = block.parameter("DENSITY").ok_or_else(|| lacks("DENSITY"))?;
    let density = importer.text.number(block.line, density, "DENSITY")?;
    let line: Line = *block.data.get(2).ok_or_else(|| lacks("E and G"))?;
    let numbers = importer.numbers(line, "an elastic constant")?;
    let [young, shear] = [0, 1].map(|place| numbers.get(place).copied().flatten());
    let (young, shear) = young.zip(shear).ok_or_else(|| lacks("E and G"))?;
    let poisson = 0.5 * young / shear - 1.0;
    if !(young > 0.0 && poisson > -1.0 && poisson < 0.5) {
        let message = format!("E = {young} and G = {shear} mean a Poisson's ratio of {poisson}");
        return Err(importer.text.fault(&NO_COUNTERPART, line, message, "E is between 0 and 3 G"));
    }
    let name = format!("section-{}", block.line.number);
    importer.materials.push(Material {
        name: name.clone(),
        density: Some(density),
        elastic: Some([young, poisson]),
        ..Material::default()
    });
    Ok(folded(&name))
}

/// The cross-section that the first data line gives.
fn cross_section(importer: &Importer<'_>, at: usize) -> Result<CrossSection, Fault> {
    let block = importer.block(at);
    let usual = if block.keyword == "BEAM GENERAL SECTION" { "GENERAL" } else { "" };
    let kind = folded(block.parameter("SECTION").unwrap_or(usual));
    let numbers = importer.first_numbers(at, "a size of the cross-section")?;
    let none = |why: &str, help: &str| Err(importer.text.fault(&NO_COUNTERPART, block.line, format!("a section {kind} {why}"), help));
    let size = |place: usize, what: &str| {
        let value = importer.needed(at, &numbers, place, what)?;
        let fault = || importer.text.fault(&SYNTAX, block.line, format!("{what} is {value}"), "it is greater than 0");
        if value > 0.0 { Ok(value) } else { Err(fault()) }
    };
    let same = |a: f64, b: f64| (a - b).abs() <= NEAR * a.abs().max(b.abs());
    Ok(match kind.as_str() {
        "CIRC" => CrossSection::Round { radius: size(0, "the radius")? },
        "PIPE" => {
            let [radius, wall] = [size(0, "the radius")?, size(1, "the thickness of the wall")?];
            // A wall up to the middle leaves no hole.
            if wall >= radius { CrossSection::Round { radius } } else { CrossSection::Tube { radius, wall } }
        }
        "RECT" => CrossSection::Rectangle { a: size(0, "a")?, b: size(1, "b")? },
        "BOX" => {
            let [a, b] = [size(0, "a")?, size(1, "b")?];
            let walls = [size(2, "t1")?, size(3, "t2")?, size(4, "t3")?, size(5, "t4")?];
            if walls.iter().any(|wall| !same(*wall, walls[0])) {
                return none("with walls of different thickness has no counterpart", "give its integrals by SECTION=GENERAL");
            }
            CrossSection::Box { a, b, wall: walls[0] }
        }
        "I" => {
            let [l, height] = [importer.needed(at, &numbers, 0, "l")?, size(1, "h")?];
            let [low, high] = [size(2, "b1")?, size(3, "b2")?];
            let [t1, t2, web] = [size(4, "t1")?, size(5, "t2")?, size(6, "t3")?];
            if !same(low, high) || !same(t1, t2) || !same(2.0 * l, height) {
                let why = "with different flanges, or whose line is not in its middle, has no counterpart";
                return none(why, "give its integrals by SECTION=GENERAL");
            }
            CrossSection::I { height, width: low, flange: t1, web }
        }
        "GENERAL" => {
            let [area, i11] = [size(0, "the area")?, size(1, "I11")?];
            let (i12, i22) = (numbers.get(2).copied().flatten().unwrap_or(0.0), size(3, "I22")?);
            if i12.abs() > NEAR * i11.max(i22) {
                return none("with I12 has no counterpart", "give n1 along a principal axis, where I12 is 0");
            }
            CrossSection::Given { area, i11, i22, torsion: size(4, "J")? }
        }
        "" => return none("is missing", "add SECTION=CIRC, PIPE, RECT, BOX, I or GENERAL"),
        _ => return none("has no counterpart", "known are CIRC, PIPE, RECT, BOX, I and GENERAL"),
    })
}

/// Directions n2 = t × n1 of beams, as far as n1 is across; `None` where it is not.
fn second_directions(elements: impl Iterator<Item = [[f64; 3]; 2]>, n1: [f64; 3]) -> Vec<Option<[f64; 3]>> {
    let of = |[from, to]: [[f64; 3]; 2]| {
        let t: [f64; 3] = std::array::from_fn(|k| to[k] - from[k]);
        let n2 = [t[1] * n1[2] - t[2] * n1[1], t[2] * n1[0] - t[0] * n1[2], t[0] * n1[1] - t[1] * n1[0]];
        let length = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let size = length(n2);
        (size > NEAR * length(t) * length(n1)).then(|| n2.map(|x| x / size))
    };
    elements.map(of).collect()
}

impl Importer<'_> {
    /// The keys of a part that come from its section, each in a line; what differs is noted.
    pub(super) fn section_keys(&mut self, section: &Section, elements: &[Element]) -> Result<String, Fault> {
        let units = self.units.clone();
        let length = |value: f64| units.write(value, Dimension::LENGTH);
        Ok(match section.body {
            Body::Solid => String::new(),
            Body::Membrane { .. } if !self.is_3d() => String::new(),
            Body::Membrane { thickness } => format!("section = {{ thickness = {}, points = 1 }}\n", length(thickness)),
            Body::Shell { thickness: Some(thickness), points } => {
                format!("section = {{ thickness = {}, points = {points} }}\n", length(thickness))
            }
            Body::Shell { thickness: None, points } => {
                format!("section = {{ thickness_field = \"{NODAL_THICKNESS}\", points = {points} }}\n")
            }
            Body::Beam { shape, .. } if !self.is_3d() => {
                let CrossSection::Rectangle { b, .. } = shape else {
                    let message = "a beam in 2D is a shell in plane stress, whose section is a rectangle";
                    let help = "take SECTION=RECT, or B31 in 3D";
                    return Err(self.text.fault(&NO_COUNTERPART, self.block(section.at).line, message, help));
                };
                format!("section = {{ thickness = {} }}\n", length(b))
            }
            Body::Beam { shape, n1 } => {
                let (shape, up) = self.turned(section.at, shape, n1, elements);
                format!("profile = {}\n", shape.text(up, &units))
            }
        })
    }

    /// The cross-section, and what is up: n1, or of an I n2 if it is one for all of its elements.
    fn turned(&mut self, at: usize, shape: CrossSection, n1: [f64; 3], elements: &[Element]) -> (CrossSection, [f64; 3]) {
        let CrossSection::I { height, width, flange, web } = shape else { return (shape, n1) };
        let ends = |element: &Element| [0, 1].map(|k| self.deck.nodes[element.nodes()[k] as usize].position);
        let all = second_directions(elements.iter().map(ends), n1);
        let first = all.iter().flatten().next().copied().unwrap_or(n1);
        let dot = |v: [f64; 3]| (0..3).map(|k| v[k] * first[k]).sum::<f64>();
        if all.iter().flatten().all(|n2| dot(*n2).abs() > 1.0 - NEAR) {
            return (shape, first.map(|x| if x.abs() < 1e-15 { 0.0 } else { x }));
        }
        self.note(
            at,
            Approximated,
            "an I whose elements have different directions: its integrals are given instead, so that it is elastic as in \
             the deck, but yields by four fibres",
        );
        (CrossSection::integrals(height, width, flange, web), n1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_integrals_of_an_i_are_those_of_its_rectangles() {
        let (height, width, flange, web) = (0.2, 0.1, 0.008, 0.005);
        let CrossSection::Given { area, i11, i22, torsion } = CrossSection::integrals(height, width, flange, web) else {
            panic!("no integrals")
        };
        // Steiner's theorem for flanges and web, and a sum over strips for the area.
        let (arm, inner) = (0.5 * (height - flange), height - 2.0 * flange);
        let expected = 2.0 * (width * flange.powi(3) / 12.0 + width * flange * arm * arm) + web * inner.powi(3) / 12.0;
        assert!((i11 / expected - 1.0).abs() < 1e-12);
        assert!((area - (0.2 * 0.1 - 0.095 * 0.184)).abs() < 1e-15 && i22 > 0.0 && torsion > 0.0);
        // All web: a rectangle.
        let CrossSection::Given { area, i11, i22, .. } = CrossSection::integrals(height, web, flange, web) else { panic!("none") };
        assert!((area - height * web).abs() < 1e-15 && (i11 - web * height.powi(3) / 12.0).abs() < 1e-18);
        assert!((i22 - height * web.powi(3) / 12.0).abs() < 1e-18);
    }

    #[test]
    fn the_second_direction_is_across_both() {
        let found = second_directions([[[0.0; 3], [2.0, 0.0, 0.0]], [[0.0; 3], [0.0, 0.0, 1.0]]].into_iter(), [0.0, 0.0, -1.0]);
        assert_eq!(found, [Some([0.0, 1.0, 0.0]), None]);
    }
}
