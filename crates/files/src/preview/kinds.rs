//! The kinds of glyphs: what each stands for, how it is drawn, and in which colour. One line a kind.

use crate::picture::colour::Rgb;
use serde::Serialize;

/// What is drawn at each point of a glyph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Symbol {
    /// An arrow along the vector, which begins at the point.
    Arrow,
    /// An arrow along the vector, which ends at the point.
    Push,
    /// A triangle that holds the point along the vector; a square where the vector is zero: it is held along
    /// all axes.
    Support,
    /// A dot.
    Dot,
    /// A circle around the point; where the vector is not zero, of that radius.
    Ring,
    /// Two points each: a line.
    Line,
    /// A corner of an outline: the corners of a plane, in order.
    Plane,
}

/// What a glyph stands for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GlyphKind {
    /// By which it is named.
    pub name: &'static str,
    /// Name for people.
    pub label: &'static str,
    /// How it is drawn.
    pub symbol: Symbol,
    /// Colour: red, green, blue.
    pub colour: [u8; 3],
}

const fn kind(name: &'static str, label: &'static str, symbol: Symbol, colour: Rgb) -> GlyphKind {
    GlyphKind { name, label, symbol, colour }
}

pub(super) static FAULT: GlyphKind = kind("fault", "fault", Symbol::Ring, [214, 20, 60]);
pub(super) static SUPPORT: GlyphKind = kind("support", "held", Symbol::Support, [0, 105, 62]);
pub(super) static MOTION: GlyphKind = kind("motion", "prescribed motion", Symbol::Arrow, [186, 0, 140]);
pub(super) static SYMMETRY: GlyphKind = kind("symmetry", "symmetry", Symbol::Plane, [0, 130, 140]);
pub(super) static VELOCITY: GlyphKind = kind("velocity", "initial velocity", Symbol::Arrow, [20, 80, 210]);
pub(super) static GRAVITY: GlyphKind = kind("gravity", "gravity", Symbol::Arrow, [150, 90, 0]);
pub(super) static FORCE: GlyphKind = kind("force", "force", Symbol::Push, [206, 60, 0]);
pub(super) static MOMENT: GlyphKind = kind("moment", "moment", Symbol::Arrow, [206, 60, 0]);
pub(super) static PRESSURE: GlyphKind = kind("pressure", "pressure", Symbol::Push, [206, 60, 0]);
pub(super) static CONTACT: GlyphKind = kind("contact", "contact", Symbol::Dot, [118, 60, 190]);
pub(super) static TIE: GlyphKind = kind("tie", "tied or joined", Symbol::Dot, [120, 72, 20]);
pub(super) static CONNECTION: GlyphKind = kind("connection", "weld, joint or spring", Symbol::Line, [60, 64, 72]);
pub(super) static MASS: GlyphKind = kind("mass", "point mass", Symbol::Dot, [60, 64, 72]);
pub(super) static CAVITY: GlyphKind = kind("cavity", "gas", Symbol::Dot, [60, 150, 220]);
pub(super) static BOUNDARY: GlyphKind = kind("boundary", "non-reflecting", Symbol::Dot, [0, 160, 110]);
pub(super) static PROBE: GlyphKind = kind("probe", "probe", Symbol::Ring, [16, 18, 28]);
pub(super) static CUT: GlyphKind = kind("cut", "cut", Symbol::Plane, [186, 0, 140]);
pub(super) static GOVERNOR: GlyphKind = kind("governor", "governs the time step", Symbol::Ring, [232, 150, 0]);

/// All kinds, in the order of legends.
pub static KINDS: [&GlyphKind; 18] = [
    &FAULT,
    &SUPPORT,
    &MOTION,
    &SYMMETRY,
    &VELOCITY,
    &GRAVITY,
    &FORCE,
    &MOMENT,
    &PRESSURE,
    &CONTACT,
    &TIE,
    &CONNECTION,
    &MASS,
    &CAVITY,
    &BOUNDARY,
    &PROBE,
    &CUT,
    &GOVERNOR,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_have_names_of_their_own() {
        let mut names: Vec<&str> = KINDS.iter().map(|kind| kind.name).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), KINDS.len());
    }
}
