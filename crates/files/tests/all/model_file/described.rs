//! Every key that is described gets bad values: NaN, infinity, negative, zero, a wrong unit, a wrong type.
//! New keys are tested without a line here.

use super::{MORE, SOUND};
use embate_files::model_file::load_text;
use embate_solver::input::sections::SECTIONS;
use embate_solver::material;
use embate_solver::quantity::{Dimension, Range};
use embate_solver::vocabulary::{Form, Key, Kind, Need, Rule, Section};
use std::path::Path;

/// A sound model that uses every section, and a part of each shape that it lacks (polygons need an element
/// with three nodes).
fn all_sections() -> String {
    format!(
        r#"{SOUND}{MORE}
[[part]]
name = "wedge"
material = "steel"
trapezoid = {{ corner = [2, 0], bottom = "20 mm", top = "10 mm", height = "30 mm", elements = [2, 3] }}
[[part]]
name = "patch"
material = "steel"
quadrilateral = {{ corners = [[3, 0], [4, 0], [4, 1], [3, 1]], elements = [2, 2] }}
[[part]]
name = "strip"
material = "steel"
path = {{ points = [[5, 0], [6, 0]], width = "30 mm", elements = [1, 4] }}
"#
    )
}

/// What a bad value must be answered with: the path's end and a part of the message.
struct Bad {
    value: String,
    at: &'static str,
    says: &'static str,
}

/// A sound model with a part that is meshed again, and one that material flows through: much may not stand
/// beside them.
const MESHED_AGAIN: &str = r#"
[run]
end = "1 ms"
[material.steel]
law = "elastic"
density = "7800 kg/m^3"
young = "200 GPa"
poisson = 0.3
[[part]]
name = "block"
material = "steel"
rectangle = { corner = [0, 0], size = [1, 1], elements = [2, 2] }
[[remesh]]
part = "block"
[[relocate]]
part = "block"
[[part]]
name = "strip"
material = "steel"
rectangle = { corner = [2, 0], size = [1, 1], elements = [2, 2] }
[[flow]]
part = "strip"
direction = [1, 0]
"#;

/// The sound model; for keys of a stage one that has stages in the place of its end, for those of remeshing
/// one of its own.
fn sound_for(path: &str) -> String {
    let all = all_sections();
    if ["remesh", "relocate", "flow"].iter().any(|section| path.starts_with(section)) {
        return MESHED_AGAIN.into();
    }
    if !path.starts_with("stage") {
        return all;
    }
    let stages = "[[stage]]\nduration = \"1 ms\"\nrelaxation = {}\n[[stage]]\nduration = \"1 ms\"\n";
    format!("{}{stages}", all.replacen("end = \"1 ms\"\n", "", 1))
}

fn bad(value: impl Into<String>, at: &'static str, says: &'static str) -> Bad {
    Bad { value: value.into(), at, says }
}

/// Numbers outside a range.
fn outside(range: Range) -> Vec<(&'static str, &'static str)> {
    let mut all = vec![("nan", "is not a number"), ("inf", "is not finite"), ("-inf", "is not finite"), ("1e999", "is not finite")];
    all.extend(
        [("-1", -1.0), ("0", 0.0), ("1e300", 1e300)]
            .iter()
            .filter(|(_, value)| !range.contains(*value))
            .map(|(text, _)| (*text, "must be")),
    );
    all
}

fn scalar(range: Range) -> Vec<Bad> {
    let mut all: Vec<Bad> = outside(range).into_iter().map(|(value, says)| bad(value, "", says)).collect();
    all.extend([
        bad("\"5 K^3\"", "", "is in K^3"),
        bad("\"5 parsecs\"", "", "not a unit"),
        bad("\"\"", "", "must be"),
        bad("true", "", "must be"),
    ]);
    all.extend([bad("[]", "", "must be"), bad("{ a = 1 }", "", "must be"), bad("1979-05-27", "", "a date")]);
    all
}

fn whole(least: u64) -> Vec<Bad> {
    let mut all: Vec<Bad> =
        ["nan", "inf", "1.5", "\"3\"", "true", "[]"].iter().map(|value| bad(*value, "", "must be a whole number")).collect();
    all.extend([bad("-1", "", "must be at least"), bad("99999999999999999999999999999999999999999999", "", "too large")]);
    all.extend((least > 0).then(|| bad("0", "", "must be at least")));
    all
}

/// Bad values of a quantity that may follow a curve.
fn course(says: &'static str) -> Vec<Bad> {
    let mut all = scalar(Range::Finite);
    all.extend([
        bad("\"no curve\"", "", says),
        bad("\"rampp\"", "", "there is no curve `rampp`"),
        bad("\"free\"", "", "can't be \"free\" here"),
    ]);
    all
}

/// Bad values of a table of velocities or the like.
fn driven(axes: &[&'static str], says: &'static str) -> Vec<Bad> {
    let inside = |axis: &'static str| {
        scalar(Range::Finite).into_iter().map(move |it| Bad { value: format!("{{ {} = {} }}", &axis[1..], it.value), at: axis, ..it })
    };
    let mut all: Vec<Bad> = axes.iter().flat_map(|axis| inside(axis)).collect();
    all.extend([
        bad("{ x = \"no curve\" }", ".x", says),
        bad("{ x = \"rampp\" }", ".x", "there is no curve `rampp`"),
        bad("{ w = 1 }", ".w", "has no component"),
        bad("{}", "", "has no component"),
        bad("5", "", "must be"),
    ]);
    all
}

/// Bad values of a kind; empty for tables.
fn values(kind: Kind) -> Vec<Bad> {
    match kind {
        Kind::Quantity(_, range) | Kind::Angle(_, range) | Kind::Stiffness(_, range) | Kind::MassFlow(_, range) => scalar(range),
        Kind::Vector(_, range) => {
            let inside = |it: Bad| Bad { value: format!("[1.0, {}]", it.value), at: "[1]", ..it };
            let mut all: Vec<Bad> = scalar(range).into_iter().map(inside).collect();
            all.extend(["5", "[1]", "[1, 2, 3]", "\"1 m\"", "true"].map(|value| bad(value, "", "must be a list of 2 numbers")));
            all
        }
        Kind::Spatial(_, range) => {
            let inside = |it: Bad| Bad { value: format!("[1.0, {}, 0]", it.value), at: "[1]", ..it };
            let mut all: Vec<Bad> = scalar(range).into_iter().map(inside).collect();
            all.extend(
                ["5", "[1]", "[1, 2, 3, 4]", "\"1 m\"", "true"].map(|value| bad(value, "", "must be a list of 2 numbers (3 in 3D)")),
            );
            all
        }
        Kind::Quantities(_, range, least) => {
            let inside = |it: Bad| Bad { value: format!("[{}]", vec![it.value; least].join(", ")), at: "[0]", ..it };
            let mut all: Vec<Bad> = scalar(range).into_iter().map(inside).collect();
            all.extend(["5", "[]", "\"1 m\"", "true", "{}"].map(|value| bad(value, "", "must be a list of")));
            all
        }
        Kind::Values => vec![
            bad("[nan]", "[0]", "is not a number"),
            bad("[0, inf]", "[1]", "is not finite"),
            bad("[\"1e999 m\"]", "[0]", "is not finite"),
            bad("[\"1 m/s\", \"1 m\"]", "[1]", "is in m, but"),
            bad("[\"1 parsec\"]", "[0]", "not a unit"),
            bad("[true]", "[0]", "must be"),
            bad("[]", "", "must be"),
            bad("5", "", "must be"),
        ],
        Kind::Points(least) => {
            let inside = |it: Bad| Bad { value: format!("[{}]", vec![format!("[0, {}]", it.value); least].join(", ")), at: "[0][1]", ..it };
            let mut all: Vec<Bad> = scalar(Range::Finite).into_iter().map(inside).collect();
            all.extend(["5", "[]", "\"1 m\"", "{}"].map(|value| bad(value, "", "must be a list of at least")));
            all.extend((least > 1).then(|| bad("[[0, 0]]", "", "must be a list of at least")));
            let padded = format!("[[0, 0], 1{}]", ", [0, 0]".repeat(least.saturating_sub(2)));
            all.push(bad(padded, "[1]", "must be a list of 2 numbers"));
            all
        }
        Kind::Outlines(least) => {
            let inside = |it: Bad| Bad { value: format!("[{}]", it.value), at: if it.at.is_empty() { "[0]" } else { "[0][0][1]" }, ..it };
            let mut all: Vec<Bad> = values(Kind::Points(least)).into_iter().filter(|it| it.at != "[1]").map(inside).collect();
            all.extend(["5", "[]", "\"1 m\"", "{}"].map(|value| bad(value, "", "must be a list of")));
            all
        }
        Kind::SpatialPoints(least) => {
            let inside =
                |it: Bad| Bad { value: format!("[{}]", vec![format!("[0, 1, {}]", it.value); least].join(", ")), at: "[0][2]", ..it };
            let mut all: Vec<Bad> = scalar(Range::Finite).into_iter().map(inside).collect();
            all.extend(["5", "[]", "\"1 m\"", "{}"].map(|value| bad(value, "", "must be a list of at least")));
            all.extend((least > 1).then(|| bad("[[0, 0, 0]]", "", "must be a list of at least")));
            all
        }
        Kind::SpatialOutlines(least) => {
            let inside = |it: Bad| Bad { value: format!("[{}]", it.value), at: if it.at.is_empty() { "[0]" } else { "[0][0][2]" }, ..it };
            let mut all: Vec<Bad> = values(Kind::SpatialPoints(least)).into_iter().map(inside).collect();
            all.extend(["5", "[]", "\"1 m\"", "{}"].map(|value| bad(value, "", "must be a list of")));
            all
        }
        Kind::Components(Dimension::VELOCITY) => driven(&[".x", ".y"], "must be a velocity or the name of a curve"),
        Kind::Components(Dimension::ACCELERATION) => driven(&[".x", ".y"], "must be an acceleration or the name of a curve"),
        Kind::Components(_) => driven(&[".x", ".y"], "or the name of a curve"),
        Kind::Motion | Kind::Rigid => driven(&[".x", ".y", ".rotation"], "must be a velocity or the name of a curve"),
        Kind::Drive(_) => course("or the name of a curve"),
        Kind::Value => vec![
            bad("nan", "", "is not a number"),
            bad("-inf", "", "is not finite"),
            bad("\"1 parsec\"", "", "not a unit"),
            bad("[1]", "", "must be"),
            bad("true", "", "must be"),
        ],
        Kind::Integer(least) => whole(least),
        Kind::Integers(count, least) => {
            let inside = |it: Bad| Bad { value: format!("[1, {}{}]", it.value, ", 1".repeat(count - 2)), at: "[1]", ..it };
            let mut all: Vec<Bad> = whole(least).into_iter().map(inside).collect();
            let says = if count == 2 { "must be a list of 2 whole numbers" } else { "must be a list of 3 whole numbers" };
            all.extend(["5", "[1]", "[1, 2, 3, 4]", "\"12\""].map(|value| bad(value, "", says)));
            all
        }
        Kind::Cadence => ["nan", "inf", "-1", "-0.5", "\"0 s\"", "\"5 m\"", "\"5\"", "true", "[]"].map(|value| bad(value, "", "")).into(),
        Kind::Flag => ["1", "\"true\"", "nan", "[]"].map(|value| bad(value, "", "must be true or false")).into(),
        Kind::Text | Kind::Name | Kind::Reference => ["5", "nan", "true", "[]", "{}"].map(|value| bad(value, "", "must be")).into(),
        Kind::References(Some(_)) => {
            ["[]", "[\"tube\"]", "\"tube\"", "5", "true", "{}"].map(|value| bad(value, "", "must be a list of 2 names")).into()
        }
        Kind::References(None) => vec![bad("[]", "", "is empty"), bad("5", "", "must be"), bad("[5]", "[0]", "must be")],
        Kind::Choice(_) => vec![bad("\"nonsense\"", "", "can't be"), bad("5", "", "must be"), bad("[]", "", "must be")],
        Kind::Choices(_) => {
            vec![bad("\"nonsense\"", "", "can't be"), bad("[]", "", "is empty"), bad("[\"nonsense\"]", "[0]", "can't be")]
        }
        Kind::Tables(_) => ["5", "[]", "\"a\"", "{}"].map(|value| bad(value, "", "must be a list of tables")).into(),
        Kind::Table(_) => ["5", "[]", "\"a\"", "true"].map(|value| bad(value, "", "must be a table")).into(),
    }
}

/// Sets the key of the sound model to every bad value and looks for the fault at its path and place.
fn try_all(key: &Key, path: &str, before: &[String]) -> usize {
    let shown = (0..9).fold(path.to_string(), |path, index| path.replace(&format!(".{index}"), &format!("[{index}]")));
    let all = values(key.kind);
    for it in &all {
        let mut set = before.to_vec();
        set.push(format!("{path}={}", it.value));
        let faults = load_text("m", &sound_for(path), Path::new("."), &set).expect_err(&format!("{set:?}")).entries;
        let expected = format!("{shown}{}", it.at);
        let found = faults.iter().find(|fault| fault.path == expected && fault.message.contains(it.says));
        let found = found.unwrap_or_else(|| panic!("{set:?} gave no fault at {expected} that says {:?}: {faults:#?}", it.says));
        assert_eq!((found.file.as_str(), found.line), ("--set", 1), "{set:?}");
        let column = if it.at.is_empty() { path.len() + 2 } else { path.len() + 3 };
        assert!(found.column >= column, "{set:?} is marked at column {}", found.column);
    }
    all.len()
}

fn section_path(section: &Section) -> String {
    match section.form {
        Form::Repeated => format!("{}.0", section.name),
        Form::Named => format!("{}.{}", section.name, if section.name == "curve" { "ramp" } else { "steel" }),
        Form::Single | Form::Inline => section.name.to_string(),
    }
}

#[test]
fn every_key_refuses_every_bad_value_at_its_place() {
    let mut count = 0;
    for section in SECTIONS {
        for key in section.all_keys() {
            let path = section_path(section);
            count += try_all(key, &format!("{path}.{}", key.name), &[]);
            if let Kind::Table(inner) = key.kind {
                if matches!(section.form, Form::Named | Form::Single) {
                    for key in inner.all_keys() {
                        count += try_all(key, &format!("{path}.{}.{}", inner.name, key.name), &[]);
                    }
                    continue;
                }
                // Shapes are in the parts of the sound model in this order; those that are not take the place
                // of the first.
                let own = ["ring", "rectangle", "disk", "trapezoid", "quadrilateral", "path"];
                let own = own.iter().position(|name| *name == inner.name);
                let index = own.or(["plane", "circle", "polyline"].iter().position(|name| *name == inner.name)).unwrap_or(0);
                for key in inner.all_keys() {
                    count += try_all(key, &format!("{}.{index}.{}.{}", section.name, inner.name, key.name), &[]);
                }
            }
        }
    }
    assert!(count > 400, "only {count} cases");
}

#[test]
fn every_parameter_of_every_law_refuses_every_bad_value() {
    for law in material::registry() {
        for parameter in law.parameters {
            let (dimension, range) = (parameter.dimension, parameter.range);
            let kind = match (parameter.list, parameter.is_angle) {
                (1.., _) => Kind::Quantities(dimension, range, 1),
                (0, true) => Kind::Angle(dimension, range),
                (0, false) => Kind::Quantity(dimension, range),
            };
            let key = Key { name: parameter.name, kind, need: Need::Required, example: "", doc: "" };
            try_all(&key, &format!("material.steel.{}", parameter.name), &[format!("material.steel.law={}", law.name)]);
        }
    }
}

#[test]
fn every_required_key_is_missed() {
    for section in SECTIONS {
        for key in section.all_keys().filter(|key| key.need == Need::Required) {
            let first = format!("{} = ", key.name);
            let header = section.name;
            let text: String = {
                let mut within = false;
                sound_for(section.name)
                    .lines()
                    .filter(|line| {
                        if line.starts_with('[') {
                            within = line.trim_matches(['[', ']']).split('.').next() == Some(header);
                        }
                        !(within && line.starts_with(&first))
                    })
                    .map(|line| format!("{line}\n"))
                    .collect()
            };
            assert_ne!(text, sound_for(section.name), "{}.{} is not in the sound model", section.name, key.name);
            let faults = super::faults(&text);
            let found = faults.iter().find(|fault| fault.message.contains(&format!("has no `{}`", key.name)));
            let found = found.unwrap_or_else(|| panic!("{}.{}: {faults:#?}", section.name, key.name));
            assert!(found.line > 1 && found.help.starts_with("add `"), "{found:?}");
        }
    }
}

#[test]
fn every_default_is_sound() {
    for section in SECTIONS {
        for key in section.all_keys() {
            let needs_another = section.all_rules().any(|rule| matches!(rule, Rule::Needs(own, _) if *own == key.name));
            if let Need::Default(text) = key.need
                && !(section.name == "probe" && needs_another)
            {
                let set = format!("{}.{}={text}", section_path(section), key.name);
                if let Err(diagnostics) = load_text("m", &sound_for(section.name), Path::new("."), std::slice::from_ref(&set)) {
                    panic!("{set}: {diagnostics}");
                }
            }
        }
    }
}
