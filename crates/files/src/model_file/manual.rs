//! The reference of the model file, `docs/model-file.md`: the tables come from the descriptions of sections
//! and keys and from the registries.

use super::reader::{header, written};
use super::{units, value};
use embate_solver::input::sections::{SECTIONS, TOP};
use embate_solver::quantity::{Dimension, Range};
use embate_solver::vocabulary::{Key, Kind, More, Need, Rule, Section};
use embate_solver::{contact, element, material, output};
use std::fmt::Write;

const OPENING: &str = "# The model file

A model is a TOML file, usually `model.toml` in a folder of its own. It is strict: an unknown key is a fault, and all faults are reported at once, each
with its line and what to do. `embate new NAME` writes a model to begin with, `embate check MODEL` checks one without running it, and `embate schema` prints
a JSON schema with which editors complete keys.

This page is made from the program's own descriptions.

## Numbers and units

A number is in SI units (m, kg, s, K, radians). A text carries its own unit and is checked against what the key needs: `\"94 mm\"`, `\"7.85 g/cm^3\"`,
`\"-50 m/s\"`, `\"3.5e11 N/m/m\"`, `\"10 us\"`, `\"30 deg\"`. Units are multiplied by a space, `*` or `·`, divided by `/` (which divides by the one unit that follows
it), and raised with `^`. The value is rounded once: `\"94 mm\"` is exactly the number 0.094, and multiples of 90 deg are exact.

";

/// The text of `docs/model-file.md`.
#[must_use]
pub fn reference_markdown() -> String {
    let mut out = OPENING.to_string();
    let _ = writeln!(
        out,
        "Units: {}. Those with a star take prefixes, from `f` (1e-15) to `P` (1e15) where usual; micro is `u` or `µ`.\n",
        units::names()
    );
    out.push_str(
        "## Names\n\nParts, materials, contacts, obstacles and probes have names of letters, digits, `_` \
        and `-`. A contact, a constraint, a load, a join or a probe may name a part\n",
    );
    out.push_str(
        "(its whole outside, or all its nodes), a side of a built-in shape such as `plate.top`, or a group \
        of a mesh file, as `foot` or as `plate.foot`: the group where the part `plate` is. The short form will do \
        where parts have the mesh in one place. A part comes before a group of the same name, and a side `part.side` \
        before a group.\n\n",
    );
    out.push_str(
        "## Files\n\nPaths of files begin at the folder of the model file; between folders stands `/` on \
        every system. A file must lie in that folder or below. Where a path ends decides, after `..` and symbolic \
        links: a link that stays inside\n",
    );
    out.push_str(
        "is followed, one that leads out is refused, and so is an absolute path to somewhere else. The same \
        holds for what a deck includes. With `--allow-outside` every command that reads a model reads files from \
        anywhere.\n\n",
    );
    let _ = writeln!(out, "## Above all sections\n");
    table(&mut out, TOP.keys, TOP.rules);
    for section in SECTIONS {
        let _ = writeln!(out, "## `{}`\n\n{}{}\n", header(section), section.doc, if section.required { " Required." } else { "" });
        table(&mut out, section.keys, section.rules);
        for group in section.groups {
            let _ = writeln!(out, "And the keys of [{}](#{}).\n", group.title, group.title.to_lowercase().replace(' ', "-"));
        }
        tables_in(&mut out, section.keys);
        for more in section.more {
            let registry = match more.by {
                "eos" => material::eos::EQUATIONS.iter().map(|kind| (kind.name, kind.doc)).collect(),
                _ => material::registry().iter().map(|kind| (kind.name, kind.doc)).collect(),
            };
            further(&mut out, more, registry);
        }
        if section.name == "material" {
            out.push_str(LIBRARY);
        }
        groups_after(&mut out, section);
    }
    registries(&mut out);
    overrides(&mut out);
    while out.ends_with("\n\n") {
        out.pop();
    }
    out
}

/// The groups of keys whose last section this is.
fn groups_after(out: &mut String, section: &Section) {
    let has = |section: &Section, title: &str| section.groups.iter().any(|group| group.title == title);
    for group in section.groups {
        let last = SECTIONS.iter().rev().find(|other| has(other, group.title));
        if last.is_some_and(|last| last.name == section.name) {
            let _ = writeln!(out, "## {}\n\n{}\n", group.title, group.doc);
            table(out, group.keys, group.rules);
            tables_in(out, group.keys);
        }
    }
}

/// The tables that some of the keys stand for.
fn tables_in(out: &mut String, keys: &[Key]) {
    for key in keys {
        if let Some(inner) = key.kind.inner() {
            let _ = writeln!(out, "### `{}`\n\n{}\n", header(inner), inner.doc);
            table(out, inner.keys, inner.rules);
            tables_in(out, inner.keys);
        }
    }
}

/// A key: its name, what its value may be, what holds where it is left out, what it means.
pub(crate) fn row(key: &Key) -> [String; 4] {
    let left_out = match key.need {
        Need::Required => "required".to_string(),
        Need::Optional(text) => text.to_string(),
        Need::Default(text) => format!("`{text}`"),
        Need::Value(value) => format!("`{value}`"),
    };
    [key.name.to_string(), words(key), left_out, key.doc.to_string()]
}

/// A table of keys, and the rules between them.
pub(crate) fn table(out: &mut String, keys: &[Key], rules: &[Rule]) {
    out.push_str("| key | value | left out | meaning |\n|---|---|---|---|\n");
    for key in keys {
        let [name, value, left_out, doc] = row(key);
        let _ = writeln!(out, "| `{name}` | {value} | {left_out} | {doc} |");
    }
    out.push('\n');
    for rule in rules {
        let list = |names: &[&str], last: &str| {
            let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
            match quoted.split_last() {
                Some((end, rest)) if !rest.is_empty() => format!("{} {last} {end}", rest.join(", ")),
                _ => quoted.concat(),
            }
        };
        let _ = match rule {
            Rule::OneOf(names) => writeln!(out, "- Exactly one of {}.", list(names, "and")),
            Rule::SomeOf(names) if names.len() > 2 => writeln!(out, "- At least one of {}.", list(names, "and")),
            Rule::SomeOf(names) => writeln!(out, "- {}, or both.", list(names, "or")),
            Rule::NotBoth(one, other) => writeln!(out, "- Not `{one}` and `{other}` at once."),
            Rule::Needs(one, other) => writeln!(out, "- `{one}` needs `{other}`."),
            Rule::Only { keys, by, value } => writeln!(out, "- {} only with {}.", list(keys, "and"), written((by, value))),
            Rule::With { by, value, keys } => writeln!(out, "- {} needs {}.", written((by, value)), list(keys, "and")),
        };
    }
    if !rules.is_empty() {
        out.push('\n');
    }
}

/// Beside the keys of materials.
const LIBRARY: &str = "\
### Materials of the library

`from` takes law and keys of a [material of the library](materials.md), each with its source; keys that stand beside it take the place of those of the library:

```toml
[material.hull]
from = \"steel DP600\"
failure = { plastic_strain = 0.4 }

[material.die]
from = \"steel\"
young = \"206 GPa\"
```

Another `law` beside `from` is a fault. With another `eos`, the keys of the material's own equation of state are left out. `run.json` and the report have all values and
where they began.

";

/// What prescribes the motion of a rigid body.
const FAULTS_AND_WARNINGS: &str = "\
## Faults and warnings

A *fault* keeps a model from being run: all are reported at once, each with its code, its line, the reason and what to do; exit code 2. `embate explain CODE` says how such a fault comes about; [messages](messages.md)
has all codes. Of each code at most 20 are shown, the rest is counted. A *warning* keeps no model from being run: it is accepted, and
`embate check` (exit code 0) and `embate run` report what it is, what follows from it, and what to do, with line and excerpt. `run --quiet` reports warnings of the model, too,
since they are no part of the summary that it leaves out; `summary.json` lists them first in `warnings`. Only what is certain before the run is a warning:

| warning | where | what follows |
|---|---|---|
| the flow stress falls | a material with `hardening` below 0, `saturation` below `yield`, a falling table, or an `isotropic_stress` below 0 for which backstresses do not make up | strain gathers in one row of elements; results after the peak depend on their size |
| a Poisson's ratio above 0.49 in `tri3` or `quad4_full` | parts not in plane stress; rubbers by their bulk and shear modulus | the elements lock: several times too stiff |
| a fluid without viscosity in `quad4` or `quad4_full` | parts of law `null`, but for a `rectangle` of one row | nothing holds shapes that keep the volume: elements fold where the fluid does not flow along the mesh |
| nothing acts on a part | no contact, obstacle, join, spring, load, cavity or motion has to do with it, nor with what shares its nodes | it stays as it is, and others go through it |
| numbers of materials in another system of units | densities and moduli that no material has in SI, and that are usual ones in mm, t, s, in mm, kg, ms or another system | masses and stiffnesses are wrong by powers of ten: write the units |
| a number that no material has | a density below 0.01 or above 25,000 kg/m³; Young's modulus below 1 kPa or above 2 TPa, or so low that √(E/ρ) is below 20 m/s at more than 2500 kg/m³; √(E/ρ) above 20 km/s; a yield stress above a fifth or below 1e-7 of Young's modulus; where the density is a power of ten other than 1000, as of models without units or with heavy bodies, only √(E/ρ) | most often a number without its unit: the message says which was meant |
| a size in another unit | a model larger than 10 km or smaller than 1 µm; a part of a mesh file whose elements are 300 times, and itself 30 times, larger or smaller than all that is not of the file; a shell thinner than a 2000th of the length of its elements, or thicker than its part is long | the `scale` of the mesh is missing or wrong, or a thickness is without its unit |
| a run of less than 10 steps, or of more than 1e9 | `run.end` over the first stable step | nothing is to be seen, or it never ends: `end`, or lengths, are in another unit |
| a probe far from its point | its part has no node within the size of the elements there | it watches a node that was not meant |
| a speed that no body has | a velocity above 20 km/s in a model without an equation of state | no solid bears what it meets then: look at the unit |
| friction that looks like an angle | a coefficient of friction between 3 and 90 | it was written in degrees: its tangent is wanted |
| gravity on what nothing holds | gravity without a curve as the only load on bodies at rest, without a constraint, an obstacle, a symmetry, a spring or a joint with the ground | all fall freely, and nothing is strained |
| bodies that will go through each other | bodies on straight ways that are known (free flight, gravity, prescribed constant velocities) that meet within the run, or meet an obstacle whose `parts` lack them, without a contact, join or anything else that has to do with both | nothing keeps them apart |

";

const MOTION: &str = "`{ x, y, z, rotation }`: each a velocity, m/s (rad/s), the name of a curve, or `\"free\"`";

fn words(key: &Key) -> String {
    let of = |dimension: Dimension| match dimension {
        Dimension::NONE => "number".to_string(),
        _ => format!("{}, {}", units::quantity(dimension), dimension.unit()),
    };
    let within = |range: Range| match range {
        Range::Finite => String::new(),
        range => format!(", {range}"),
    };
    match key.kind {
        Kind::Quantity(dimension, range) => format!("{}{}", of(dimension), within(range)),
        Kind::Angle(Dimension::RATE, _) => "angular velocity, rad/s".to_string(),
        Kind::Angle(..) => "angle, rad".to_string(),
        Kind::Vector(dimension, range) => format!("`[x, y]`: {}{}", of(dimension), within(range)),
        Kind::Spatial(dimension, range) => format!("`[x, y]`, in 3D `[x, y, z]`: {}{}", of(dimension), within(range)),
        Kind::Quantities(dimension, range, least) => format!("list of {least} or more: {}{}", of(dimension), within(range)),
        Kind::Value => "number, or quantity of any dimension".to_string(),
        Kind::Values => "list of 1 or more: numbers, or quantities of one dimension".to_string(),
        Kind::Outlines(least) => format!("list of lists of {least} or more `[x, y]`: {}", of(Dimension::LENGTH)),
        Kind::Points(least) => format!("list of {least} or more `[x, y]`: {}", of(Dimension::LENGTH)),
        Kind::SpatialOutlines(least) => format!("list of lists of {least} or more `[x, y, z]`: {}", of(Dimension::LENGTH)),
        Kind::SpatialPoints(least) => format!("list of {least} or more `[x, y, z]`: {}", of(Dimension::LENGTH)),
        Kind::Drive(Dimension::RATE) => "angular velocity, rad/s, or the name of a curve".to_string(),
        Kind::Drive(dimension) => format!("{}, or the name of a curve", of(dimension)),
        Kind::Components(dimension) => {
            format!("`{{ x, y, z }}`: each a {}, or the name of a curve", of(dimension)).replace("a acc", "an acc")
        }
        Kind::Motion => MOTION.to_string(),
        Kind::Rigid => format!("true, false, or {MOTION}"),
        Kind::MassFlow(_, range) => format!("mass per time, kg/s, in 2D kg/s/m{}", within(range)),
        Kind::Integer(least) => format!("whole number from {least}"),
        Kind::Integers(count, least) => format!("{count} whole numbers from {least}"),
        Kind::Choice(known) if known.names().len() <= 4 => {
            known.names().iter().map(|name| format!("`\"{name}\"`")).collect::<Vec<_>>().join(" or ")
        }
        Kind::Choices(known) if known.names().len() <= 3 => {
            format!("{}, or a list of them", known.names().iter().map(|name| format!("`\"{name}\"`")).collect::<Vec<_>>().join(" or "))
        }
        Kind::Table(section) => format!("table, see `{}` below", section.name),
        Kind::Tables(section) => format!("list of tables, see `{}` below", section.name),
        other => value::words(other).trim_start_matches("a ").to_string(),
    }
}

/// The keys that come with each value of a deciding key.
fn further(out: &mut String, more: &More, registry: Vec<(&str, &str)>) {
    for (name, doc) in registry {
        let _ = writeln!(out, "### `{} = \"{name}\"`\n\n{doc}\n", more.by);
        let own: Vec<Key> = (more.keys)(name).unwrap_or_default();
        table(out, &own, &[]);
    }
}

fn registries(out: &mut String) {
    out.push_str("## Elements\n\n| `element` | meaning |\n|---|---|\n");
    for kind in element::registry() {
        let _ = writeln!(out, "| `{}` | {} |", kind.name, kind.doc);
    }
    out.push_str("\n## Searches\n\n| `search` | meaning |\n|---|---|\n");
    for kind in contact::search::registry::<2>() {
        let _ = writeln!(out, "| `{}` | {} |", kind.name, kind.doc);
    }
    out.push_str("\n## Fields\n\n| field | unit | meaning |\n|---|---|---|\n");
    for kind in output::FIELDS.iter() {
        let _ = writeln!(out, "| `{}` | {} | {} |", kind.name, kind.unit, kind.doc);
    }
    out.push('\n');
}

fn overrides(out: &mut String) {
    out.push_str(FAULTS_AND_WARNINGS);
    out.push_str("## Overrides on the command line\n\n");
    out.push_str(
        "`--set path.to.key=value` replaces a value or adds one, as often as needed. Things of which there \
        are several are named by number or by name:\n",
    );
    out.push_str(
        "`--set run.end=\"5 ms\"`, `--set part.tube.velocity='[0, \"-60 m/s\"]'`, `--set \
        part.0.ring.elements='[2, 80]'`, `--set material.steel.poisson=0.25`.\n",
    );
    out.push_str("The value is written as in the file; a text needs no quotes.\n");
}
