//! Names of the bodies and faces of a CAD file: groups of the mesh, which parts can have as their names too.

use super::script::Found;
use crate::abaqus::import::free;
use std::collections::BTreeSet;
use std::fmt::Write;

/// Longest name, so that a part can have it and a face adds its number.
const LONGEST: usize = 48;

/// A volume of a CAD file as groups of its mesh.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Body {
    /// Name of its group of volumes.
    pub(super) name: String,
    /// Names of the groups of its faces.
    pub(super) faces: Vec<String>,
    tag: i64,
    face_tags: Vec<i64>,
}

/// Bodies with names that no other one has: their labels, or the file's name; faces are `BODY-LABEL`, or
/// `BODY-face1` and so on.
pub(super) fn bodies(found: &Found, file: &str) -> Vec<Body> {
    let mut taken = BTreeSet::new();
    let mut bodies = Vec::new();
    for (volume, faces) in &found.volumes {
        let name = take(&plain([volume.label.as_str(), file, "body"]), &mut taken);
        let face = |(number, label): (usize, &str)| match label {
            "" => format!("{name}-face{}", number + 1),
            label => format!("{name}-{}", plain([label, "face"])),
        };
        let labels = faces.iter().map(|face| face.label.as_str()).enumerate();
        let own: Vec<String> = labels.map(|each| take(&face(each), &mut taken)).collect();
        bodies.push(Body { faces: own, tag: volume.tag, face_tags: faces.iter().map(|face| face.tag).collect(), name });
    }
    bodies
}

/// The first text of which something is left as letters, digits, `_` and `-`.
fn plain<const N: usize>(texts: [&str; N]) -> String {
    let of = |text: &str| {
        let all: String = text.chars().map(|c| if c.is_alphanumeric() || c == '-' { c } else { '_' }).collect();
        all.trim_matches('_').chars().take(LONGEST).collect::<String>()
    };
    texts.into_iter().map(of).find(|name| !name.is_empty()).unwrap_or_default()
}

/// The name, or the name with the first number that is free; it is taken then.
fn take(name: &str, taken: &mut BTreeSet<String>) -> String {
    let free = free(name, taken);
    taken.insert(free.clone());
    free
}

/// A mesh file of Gmsh with the names of bodies and faces in place of its own; `None`: it has no list of
/// names.
pub(super) fn named(bytes: &[u8], bodies: &[Body]) -> Option<Vec<u8>> {
    let at = |mark: &[u8], from: usize| bytes[from..].windows(mark.len()).position(|it| it == mark).map(|found| from + found);
    let begin = at(b"$PhysicalNames\n", 0)?;
    let end = at(b"$EndPhysicalNames", begin)?;
    let mut names = String::new();
    let mut count = 0;
    let mut seen = BTreeSet::new();
    let faces = bodies.iter().flat_map(|body| body.face_tags.iter().zip(&body.faces)).map(|(tag, name)| (2, tag, name));
    for (dimension, tag, name) in faces.chain(bodies.iter().map(|body| (3, &body.tag, &body.name))) {
        // A face between two volumes that touch is one.
        if seen.insert((dimension, tag)) {
            count += 1;
            // What is written into a text can't fail.
            let _ = writeln!(names, "{dimension} {tag} \"{name}\"");
        }
    }
    let list = format!("$PhysicalNames\n{count}\n{names}");
    Some([&bytes[..begin], list.as_bytes(), &bytes[end..]].concat())
}

#[cfg(test)]
mod tests {
    use super::super::script::Entity;
    use super::*;

    #[test]
    fn each_body_and_face_has_a_name_of_its_own_that_a_part_can_have() {
        let entity = |tag, label: &str| Entity { tag, label: label.into() };
        let volumes = ["Bolt M6 \"x\"", "Bolt M6  x", "", "  ", "Bolt_M6_x-face1"].iter().zip(1..);
        let faces = || vec![entity(7, ""), entity(8, "Kopf Fläche"), entity(9, "Kopf Fläche")];
        let found = Found { surfaces: Some(3), volumes: volumes.map(|(label, tag)| (entity(tag, label), faces())).collect() };
        let bodies = bodies(&found, "my part.v2");
        let names: Vec<&str> = bodies.iter().map(|body| body.name.as_str()).collect();
        assert_eq!(names, ["Bolt_M6__x", "Bolt_M6__x-2", "my_part_v2", "my_part_v2-2", "Bolt_M6_x-face1"]);
        assert_eq!(bodies[0].faces, ["Bolt_M6__x-face1", "Bolt_M6__x-Kopf_Fläche", "Bolt_M6__x-Kopf_Fläche-2"]);
        let all: BTreeSet<&String> = bodies.iter().flat_map(|body| body.faces.iter().chain([&body.name])).collect();
        assert_eq!(all.len(), 20);
        let long = Found { surfaces: None, volumes: vec![(entity(1, &"x".repeat(100)), vec![])] };
        assert!(embate_solver::input::name_is_plain(&super::bodies(&long, "")[0].name).is_ok());
    }

    #[test]
    fn names_take_the_place_of_those_of_gmsh_and_the_rest_of_the_file_stays() {
        let body = Body { name: "pin".into(), faces: vec!["pin-face1".into(), "pin-face2".into()], tag: 3, face_tags: vec![5, 5] };
        let file = b"$MeshFormat\n4.1 1 8\n\x01$EndMeshFormat\n$PhysicalNames\n2\n2 5 \"s5\"\n3 3 \"v3\"\n$EndPhysicalNames\n$Nodes\n\xff";
        let named = named(file, std::slice::from_ref(&body)).unwrap();
        let wanted =
            b"$MeshFormat\n4.1 1 8\n\x01$EndMeshFormat\n$PhysicalNames\n2\n2 5 \"pin-face1\"\n3 3 \"pin\"\n$EndPhysicalNames\n$Nodes\n\xff";
        assert_eq!(named, wanted);
        assert_eq!(super::named(b"$MeshFormat\n", &[body]), None);
    }
}
