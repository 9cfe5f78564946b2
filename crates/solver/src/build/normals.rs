//! Rotations about the normals of smooth shells, for which there is no stiffness: moments that have a part
//! about them, and holds that leave them free. Also holds of rotations where nothing rotates.
//!
//! Normals are those of the mesh at the start.

use crate::error::Warning;
use crate::mesh::messages::{ABOUT_NORMAL, NOT_ON_SHELLS};
use crate::mesh::{Mesh, Meshed};
use crate::model::{Constraint, Drive, Load, Model, in_3d};
use crate::tensor::Dim;
use crate::vector::{dot, place, unit};
use std::collections::{BTreeMap, BTreeSet};

/// Part of a moment about a normal from which on it counts, and of a normal outside of the axes that are
/// held.
const MUCH: f64 = 1e-3;
/// Cosine from which on two directions at a node are one smooth shell.
const SAME: f64 = 1.0 - 1e-6;

/// How nodes rotate.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Turning {
    /// About this normal without stiffness: a node of a smooth shell in 3D.
    Freely([f64; 3]),
    /// About all axes against some: at folds, and at nodes of beams, and in 2D.
    Held,
}

/// A warning for each moment and each hold that is not what it seems.
pub(super) fn warnings<const D: usize>(model: &Model, mesh: &Mesh<D>) -> Vec<Warning>
where
    Dim<D>: Meshed<D>,
{
    let asks = model.constraints.iter().any(|it| it.spin.iter().any(Option::is_some));
    if !asks && !model.loads.iter().any(|load| matches!(load, Load::Moment { .. })) {
        return Vec::new();
    }
    let turning = turning(model, mesh);
    let of = |name: &str| -> Vec<(u32, Turning)> {
        let nodes = mesh.nodes(name).unwrap_or_default();
        nodes.into_iter().filter_map(|node| Some((node, *turning.get(&node)?))).collect()
    };
    let at = |node: u32| place(mesh.positions[node as usize]);
    let all_led = model.constraints.iter().filter(|it| holds_all(it)).filter_map(|it| mesh.nodes(&it.on));
    let led: BTreeSet<u32> = all_led.flatten().collect();
    let mut warnings = Vec::new();
    for (i, load) in model.loads.iter().enumerate() {
        let Load::Moment { on, moment, .. } = load else { continue };
        let size = dot(*moment, *moment).sqrt();
        let about = of(on).into_iter().find_map(|(node, turning)| match turning {
            Turning::Freely(normal) if dot(normal, *moment).abs() > MUCH * size && !led.contains(&node) => {
                Some((node, dot(normal, *moment)))
            }
            _ => None,
        });
        if let Some((node, part)) = about {
            warnings.push(Warning {
                kind: &ABOUT_NORMAL,
                path: format!("load[{i}].moment"),
                message: format!(
                    "{part:.4e} N m of it are about the normal of the shell at {} m, which has no stiffness against that",
                    at(node)
                ),
                consequence: "its nodes spin about their normals faster and faster, and take energy without moving anything".into(),
                help: "let forces in the plane of the shell take its place, or hold the rotation about the normal".into(),
            });
        }
    }
    for (i, constraint) in model.constraints.iter().enumerate() {
        warnings.extend(held(i, constraint, &of(&constraint.on), at));
    }
    warnings
}

/// Whether all rotations of its nodes are prescribed.
fn holds_all(constraint: &Constraint) -> bool {
    constraint.rotation.is_some() || constraint.spin.iter().all(Option::is_some)
}

/// What a constraint holds that is not there, or does not hold well.
fn held(i: usize, constraint: &Constraint, nodes: &[(u32, Turning)], at: impl Fn(u32) -> String) -> Option<Warning> {
    let spin = &constraint.spin;
    if spin.iter().all(Option::is_none) {
        return None;
    }
    if nodes.is_empty() {
        return Some(Warning {
            kind: &NOT_ON_SHELLS,
            path: format!("constraint[{i}].on"),
            message: format!("no node of `{}` is one of shells or beams, so that none has a rotation that could be held", constraint.on),
            consequence: "nodes of solids are held by their positions alone; what it says of rotations does nothing".into(),
            help: "leave `rotation` out, or name a set of shells or beams".into(),
        });
    }
    let rests = |drive: &Option<Drive>| *drive == Some(Drive::Constant(0.0));
    if holds_all(constraint) || !spin.iter().any(rests) {
        return None;
    }
    let (node, normal) = nodes.iter().find_map(|&(node, turning)| match turning {
        Turning::Freely(normal) => {
            let free: f64 = normal.iter().zip(spin).filter(|(_, drive)| drive.is_none()).map(|(n, _)| n * n).sum();
            (free.sqrt() > MUCH).then_some((node, normal))
        }
        Turning::Held => None,
    })?;
    let largest = (0..3).filter(|&k| spin[k].is_none()).max_by(|&a, &b| normal[a].abs().total_cmp(&normal[b].abs()))?;
    let axis = ["x", "y", "z"][largest];
    Some(Warning {
        kind: &ABOUT_NORMAL,
        path: format!("constraint[{i}].spin"),
        message: format!("the rotation about the normal of the shell stays free, at {} m for one", at(node)),
        consequence: "as soon as the normal leans towards an axis that is held, nodes slip about it, and the hold is lost".into(),
        help: format!("add `{axis} = 0`, or all axes"),
    })
}

/// How each node that rotates does so.
fn turning<const D: usize>(model: &Model, mesh: &Mesh<D>) -> BTreeMap<u32, Turning>
where
    Dim<D>: Meshed<D>,
{
    let mut turning: BTreeMap<u32, Turning> = BTreeMap::new();
    for (number, group) in mesh.groups.iter().enumerate().filter(|(_, group)| model.parts[group.part].has_rotations()) {
        let directions = mesh.directions.get(number).filter(|own| D == 3 && own.len() == group.connectivity.len());
        for (k, &node) in group.connectivity.iter().enumerate() {
            let own = directions.and_then(|own| unit(in_3d(own[k]))).map_or(Turning::Held, Turning::Freely);
            let joined = match (turning.get(&node), own) {
                (None, own) => own,
                (Some(Turning::Freely(a)), Turning::Freely(b)) if dot(*a, b).abs() > SAME => Turning::Freely(*a),
                _ => Turning::Held,
            };
            turning.insert(node, joined);
        }
    }
    // Nodes of joins go with others.
    for name in model.joins.iter().flat_map(|join| &join.between) {
        for node in mesh.nodes(name).unwrap_or_default() {
            turning.entry(node).and_modify(|it| *it = Turning::Held);
        }
    }
    turning
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shapes::{Rectangle, SpaceTruss};
    use crate::model::{Join, Part, Placement, Profile, ShellSection};

    fn sheet(angle: f64) -> Part {
        let rectangle = Rectangle { corner: [0.0; 2], size: [1.0; 2], elements: [2, 2], ..Rectangle::default() };
        Part {
            name: "sheet".into(),
            element: "shell4".into(),
            section: Some(ShellSection { thickness: 0.01, ..ShellSection::default() }),
            shape: rectangle.into(),
            placement: Placement { rotation: angle, rotation_axis: [0.0, 1.0, 0.0], ..Placement::default() },
            ..Part::default()
        }
    }

    fn codes(model: &Model) -> Vec<(String, &'static str)> {
        let mesh = Mesh::<3>::new(model).unwrap_or_else(|faults| panic!("{faults:#?}"));
        warnings(model, &mesh).into_iter().map(|warning| (warning.path, warning.kind.code)).collect()
    }

    fn with_moment(part: Part, moment: [f64; 3]) -> Model {
        Model { parts: vec![part], loads: vec![Load::Moment { on: "sheet.left".into(), moment, curve: None }], ..Model::default() }
    }

    #[test]
    fn a_moment_about_the_normal_is_reported_unless_something_holds_it() {
        let warned = |model: &Model| codes(model) == [("load[0].moment".to_string(), "W0203")];
        assert!(warned(&with_moment(sheet(0.0), [0.0, 1.0, 1e-2])));
        assert!(codes(&with_moment(sheet(0.0), [1.0, 1.0, 0.0])).is_empty());
        // Turned by a right angle about y the normal is along x.
        assert!(codes(&with_moment(sheet(std::f64::consts::FRAC_PI_2), [0.0, 1.0, 1.0])).is_empty());
        assert!(warned(&with_moment(sheet(std::f64::consts::FRAC_PI_2), [1.0, 0.0, 0.0])));
        let mut model = with_moment(sheet(0.0), [0.0, 0.0, 1.0]);
        model.constraints.push(Constraint { on: "sheet.left".into(), spin: [0; 3].map(|_| Some(0.0.into())), ..Constraint::default() });
        assert!(codes(&model).is_empty());
        // Beams hold what is joined with them.
        let mut model = with_moment(sheet(0.0), [0.0, 0.0, 1.0]);
        let lines = vec![vec![[0.0, 0.0, 0.0], [0.0, 1.0, 0.0]]];
        let profile = Some(Profile { shape: "round".into(), diameter: Some(0.01), ..Profile::default() });
        let shape = SpaceTruss { lines, elements: 2 }.into();
        model.parts.push(Part { name: "rib".into(), element: "beam2".into(), profile, shape, ..Part::default() });
        model.joins.push(Join { between: ["sheet.left".into(), "rib".into()], ..Join::default() });
        assert!(codes(&model).is_empty());
        assert!(codes(&Model { loads: vec![Load::Moment { on: "rib.point0".into(), moment: [1.0; 3], curve: None }], ..model }).is_empty());
    }

    #[test]
    fn a_hold_that_leaves_the_normal_free_is_reported() {
        let still = || Some(Drive::Constant(0.0));
        let held = |angle: f64, spin: [Option<Drive>; 3]| {
            let constraints = vec![Constraint { on: "sheet.left".into(), spin, ..Constraint::default() }];
            codes(&Model { parts: vec![sheet(angle)], constraints, ..Model::default() })
        };
        let warned = [("constraint[0].spin".to_string(), "W0203")];
        assert_eq!(held(0.0, [still(), None, None]), warned);
        assert_eq!(held(0.0, [still(), None, still()]), []);
        assert_eq!(held(0.0, [still(), still(), still()]), []);
        assert_eq!(held(0.0, [None, None, Some(Drive::Constant(1.0))]), []);
        assert_eq!(held(std::f64::consts::FRAC_PI_2, [still(), None, None]), []);
        assert_eq!(held(0.3, [None, still(), still()]), warned);
    }

    #[test]
    fn a_hold_of_rotations_of_solids_is_reported() {
        let part = Part { name: "sheet".into(), element: "quad4".into(), section: None, ..sheet(0.0) };
        let on = || "sheet.left".to_string();
        let constraints = vec![
            Constraint { on: on(), velocity: [Some(0.0.into()), None, None], ..Constraint::default() },
            Constraint { on: on(), spin: [None, None, Some(0.0.into())], ..Constraint::default() },
        ];
        let model = Model { parts: vec![Part { placement: Placement::default(), ..part }], constraints, ..Model::default() };
        let mesh = Mesh::<2>::new(&model).unwrap();
        let found: Vec<String> = warnings(&model, &mesh).into_iter().map(|warning| warning.path).collect();
        assert_eq!(found, ["constraint[1].on"]);
    }
}
