//! The keywords that the import knows, one line each: what becomes of it, the parameters it understands, and
//! who reads it.
//!
//! The table of `docs/import.md` is made from here. Keywords that are not here are ignored, and the report
//! says so.

use super::report::Outcome::{self, Approximated, Ignored, Used};
use super::{Importer, condition, contact, material, section, step};
use embate_solver::error::Fault;

/// Reads a block, given by its number.
pub(super) type Read = fn(&mut Importer<'_>, usize) -> Result<(), Fault>;

/// A keyword.
pub(super) struct Keyword {
    pub(super) name: &'static str,
    /// What becomes of it, if its reader says nothing else.
    pub(super) outcome: Outcome,
    /// Parameters that are understood; `*`: any.
    pub(super) parameters: &'static [&'static str],
    /// What it becomes, or what follows from its not acting.
    pub(super) doc: &'static str,
    pub(super) read: Read,
    /// Values of a data line that are read; 0: as many as there are.
    pub(super) values: usize,
}

impl Keyword {
    /// One of whose data lines so many values are read.
    const fn values(self, values: usize) -> Self {
        Self { values, ..self }
    }
}

const fn key(name: &'static str, outcome: Outcome, parameters: &'static [&'static str], doc: &'static str, read: Read) -> Keyword {
    Keyword { name, outcome, parameters, doc, read, values: 0 }
}

/// Needs nothing: the geometry is read before, or there is nothing to read.
fn done(_: &mut Importer<'_>, _: usize) -> Result<(), Fault> {
    Ok(())
}

const ANY: &[&str] = &["*"];
const PRINTS: &str = "what is written is `[output]`: all fields 100 times, the history 1000 times; add probes as needed";

#[rustfmt::skip]
pub(super) static KEYWORDS: &[Keyword] = &[
    key("AMPLITUDE", Used, &["NAME", "DEFINITION", "TIME", "VALUE"], "a curve: TABULAR by lines, SMOOTH STEP by smooth steps", condition::amplitude),
    key("ASSEMBLY", Used, &["NAME"], "the mesh", done),
    key("BEAM GENERAL SECTION", Used, &["ELSET", "MATERIAL", "SECTION", "DENSITY"], "`profile` of a part of beams, and their \
        elastic material", section::beam),
    key("BEAM SECTION", Used, &["ELSET", "MATERIAL", "SECTION"], "`profile` of a part of beams: CIRC, PIPE, RECT, BOX, I or \
        GENERAL; of beams in 2D the thickness of a shell, RECT alone", section::beam),
    key("BOUNDARY", Used, &["TYPE", "AMPLITUDE", "OP"], "`[[constraint]]`: fixed, or displacement, velocity, \
        acceleration by an amplitude; rotations of shells and beams are held, or driven by a velocity; of a reference \
        node the motion of its rigid body", condition::boundary).values(4),
    key("BULK VISCOSITY", Used, &[], "`run.bulk_viscosity`", step::bulk_viscosity).values(2),
    key("CLOAD", Used, &["AMPLITUDE", "OP"], "`[[load]]` with `force`, on rotations of shells and beams `moment`: \
        the sum over the set, per depth; in 3D the whole", condition::nodal_force).values(3),
    key("CONTACT", Used, &["OP"], "see *CONTACT INCLUSIONS", done),
    key("CONTACT FILE", Approximated, ANY, PRINTS, done),
    key("CONTACT INCLUSIONS", Used, &["ALL EXTERIOR"], "`[[contact]]` with `bodies = \"all\"`, or `between` for \
        pairs", contact::inclusions),
    key("CONTACT OUTPUT", Approximated, ANY, PRINTS, done),
    key("CONTACT PAIR", Approximated, &["INTERACTION", "MECHANICAL CONSTRAINT", "TYPE", "CPSET", "OP"], "`[[contact]]` \
        with `between`, by penalty in double pass (NODE TO SURFACE: single pass), whatever enforcement the deck asks \
        for; penetrations at the start are pushed out without stress, in 3D and of shells they count as zero", contact::pair),
    key("CONTACT PRINT", Approximated, ANY, PRINTS, done),
    key("CONTACT PROPERTY ASSIGNMENT", Used, &[], "friction and law of the contact of all bodies", contact::property),
    key("DENSITY", Used, &[], "`density`", material::density).values(1),
    key("DLOAD", Used, &["AMPLITUDE", "OP"], "`[[load]]`: P1 to P6 a `pressure` on these edges or faces, P on \
        shells along their normal, GRAV `gravity`", condition::distributed),
    key("DSLOAD", Used, &["AMPLITUDE", "OP"], "`[[load]]` with `pressure`, which follows its surface", condition::surface_load),
    key("DYNAMIC", Used, &["EXPLICIT", "DIRECT", "ELEMENT BY ELEMENT", "FIXED TIME INCREMENTATION"], "`run.end`; the time step follows from the elements", step::dynamic).values(4),
    key("EL FILE", Approximated, ANY, PRINTS, done),
    key("EL PRINT", Approximated, ANY, PRINTS, done),
    key("ELASTIC", Used, &["TYPE"], "`young` and `poisson` of an isotropic material", material::elastic).values(2),
    key("ELEMENT", Used, &["TYPE", "ELSET"], "the mesh; `element` and `stress_state` of parts", done),
    key("ELEMENT OUTPUT", Approximated, ANY, PRINTS, done),
    key("ELSET", Used, &["ELSET", "GENERATE", "INSTANCE", "INTERNAL", "UNSORTED"], "a group of the mesh", done),
    key("END ASSEMBLY", Used, &[], "the mesh", done),
    key("END INSTANCE", Used, &[], "the mesh", done),
    key("END PART", Used, &[], "the mesh", done),
    key("END STEP", Used, &[], "the end of the step", done),
    key("ENERGY OUTPUT", Approximated, ANY, PRINTS, done),
    key("EQUATION", Ignored, ANY, "refused: linear equations between nodes have no counterpart", step::refused),
    key("FILE OUTPUT", Approximated, ANY, PRINTS, done),
    key("FRICTION", Used, &["TAUMAX", "EXPONENTIAL DECAY", "SLIP TOLERANCE"], "`friction` of contacts, with \
        `friction_limit`, or `friction_dynamic` and `friction_decay`", contact::friction),
    key("HEADING", Used, &[], "`title`", step::heading),
    key("HYPERELASTIC", Approximated, &["NEO HOOKE", "MOONEY-RIVLIN"], "`neo_hookean` or `mooney_rivlin` with the \
        same moduli at rest; the energy of volume is K/4 (J^2 - 1 - 2 ln J) instead of K/2 (J - 1)^2", material::hyperelastic),
    key("INITIAL CONDITIONS", Used, &["TYPE"], "TYPE=VELOCITY: `velocity` of parts", condition::initial),
    key("INSTANCE", Used, &["NAME", "PART"], "the mesh, in its place", done),
    key("MATERIAL", Used, &["NAME"], "`[material.NAME]`", material::material),
    key("MEMBRANE SECTION", Used, &["ELSET", "MATERIAL"], "a part in plane stress; in 3D a shell of one point, without \
        bending", section::membrane),
    key("MPC", Ignored, ANY, "refused: constraints between nodes have no counterpart but ties", step::refused),
    key("NODAL THICKNESS", Used, &[], "`thickness_field` of sections of shells that take it: a thickness at each node", section::nodal_thickness),
    key("NODE", Used, &["NSET", "SYSTEM"], "the mesh", done),
    key("NODE FILE", Approximated, ANY, PRINTS, done),
    key("NODE OUTPUT", Approximated, ANY, PRINTS, done),
    key("NODE PRINT", Approximated, ANY, PRINTS, done),
    key("NSET", Used, &["NSET", "ELSET", "GENERATE", "INSTANCE", "INTERNAL", "UNSORTED"], "a group of the mesh", done),
    key("OUTPUT", Approximated, ANY, PRINTS, done),
    key("PART", Used, &["NAME"], "the mesh", done),
    key("PLASTIC", Used, &["HARDENING"], "law `j2` for one or two rows, `j2_table` for more", material::plastic).values(2),
    key("PREPRINT", Approximated, ANY, "what is printed is what `embate check` prints", done),
    key("RESTART", Approximated, ANY, PRINTS, done),
    key("RIGID BODY", Used, &["REF NODE", "ELSET", "ANALYTICAL SURFACE"], "`rigid` of parts; of an analytical \
        surface in 2D `[[obstacle]]` with `polyline`, its free side left of the way from START on", contact::rigid_body),
    key("SECTION CONTROLS", Approximated, ANY, "hourglass control and the like are those of the element; `hourglass` \
        of the part is its coefficient", done),
    key("SHELL GENERAL SECTION", Used, &["ELSET", "MATERIAL", "OFFSET", "POISSON", "NODAL THICKNESS"], "`section` of a part of shells, with two \
        points: exact while it is elastic", section::shell),
    key("SHELL SECTION", Used, &["ELSET", "MATERIAL", "OFFSET", "POISSON", "SECTION INTEGRATION", "CONTROLS", "NODAL THICKNESS"], "`section` of a \
        part of shells: thickness and points", section::shell),
    key("SOLID SECTION", Used, &["ELSET", "MATERIAL", "CONTROLS"], "`[[part]]`", section::solid).values(1),
    key("STEP", Used, &["NAME", "NLGEOM", "INC"], "the run", step::step),
    key("SURFACE", Used, &["NAME", "TYPE", "INTERNAL"], "a group of lines of the mesh, in 3D of faces, also SPOS and SNEG of shells", contact::surface),
    key("SURFACE BEHAVIOR", Used, &["PRESSURE-OVERCLOSURE"], "HARD: the automatic penalty; LINEAR: `penalty`; \
        TABULAR: `law = \"pressure_gap\"`", contact::behaviour),
    key("SURFACE INTERACTION", Used, &["NAME"], "keys of contacts that name it", contact::interaction),
    key("TIE", Approximated, &["NAME", "TYPE", "ADJUST", "POSITION TOLERANCE"], "`[[contact]]` with `tied`, by \
        penalty; only what touches at the start is tied", contact::tie),
    key("TRANSFORM", Ignored, ANY, "refused: conditions in turned axes have no counterpart", step::refused),
];

/// The keyword of this name.
pub(super) fn named(name: &str) -> Option<&'static Keyword> {
    KEYWORDS.iter().find(|keyword| keyword.name == name)
}

/// The table of keywords for the documentation.
#[must_use]
pub fn table_markdown() -> String {
    let mut out = String::from("| keyword | outcome | becomes |\n|---|---|---|\n");
    for keyword in KEYWORDS {
        let outcome = match keyword.outcome {
            Used => "used",
            Approximated => "approximated",
            Ignored => "refused",
        };
        out.push_str(&format!("| `*{}` | {outcome} | {} |\n", keyword.name, keyword.doc.strip_prefix("refused: ").unwrap_or(keyword.doc)));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keywords_are_in_the_order_of_the_alphabet_and_once() {
        assert!(KEYWORDS.windows(2).all(|pair| pair[0].name < pair[1].name));
    }
}
