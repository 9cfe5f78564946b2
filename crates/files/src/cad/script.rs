//! What Gmsh is to do, in its own language, and what it says of the volumes and faces that it found.

use super::Unit;

/// Names of the files in the folder of a run.
pub(super) const NAME: &str = "job.geo";
pub(super) const MESH: &str = "made.msh";
pub(super) const FOUND: &str = "found.txt";

/// The script: each volume and each face is a physical group with the number that it has in Gmsh. `size` is
/// in the unit of the mesh. Labels of a CAD file are printed, as they are, on a line of their own.
pub(super) fn text(geometry: &str, unit: Unit, size: f64, order: u8) -> String {
    format!(
        r#"SetFactory("OpenCASCADE");
Geometry.OCCTargetUnit = "{unit}";
shapes() = ShapeFromFile("{geometry}");
volumes() = Volume{{:}};
surfaces() = Surface{{:}};
Printf("surfaces %g", #surfaces()) >> "{FOUND}";
If (#volumes() > 0)
  For i In {{0:#volumes()-1}}
    faces() = Abs(Boundary{{ Volume{{volumes(i)}}; }});
    Physical Volume(Sprintf("v%g", volumes(i)), volumes(i)) = {{volumes(i)}};
    Printf("volume %g", volumes(i)) >> "{FOUND}";
    Printf(StrCat("label ", Volume{{volumes(i)}})) >> "{FOUND}";
    For j In {{0:#faces()-1}}
      Physical Surface(Sprintf("s%g", faces(j)), faces(j)) = {{faces(j)}};
      Printf("face %g", faces(j)) >> "{FOUND}";
      Printf(StrCat("label ", Surface{{faces(j)}})) >> "{FOUND}";
    EndFor
  EndFor
EndIf
Mesh.ElementOrder = {order};
Mesh.MeshSizeMax = {size:e};
Mesh.MshFileVersion = 4.1;
Mesh.Binary = 1;
"#,
        unit = unit.gmsh
    )
}

/// A volume, or a face of one.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Entity {
    /// Its number in Gmsh, which is that of its physical group.
    pub(super) tag: i64,
    /// Its label in the CAD file, the last part of it; empty: none.
    pub(super) label: String,
}

/// What Gmsh found in a CAD file.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Found {
    /// Number of surfaces; `None`: it did not come so far.
    pub(super) surfaces: Option<usize>,
    /// Volumes, each with its faces.
    pub(super) volumes: Vec<(Entity, Vec<Entity>)>,
}

impl Found {
    pub(super) fn read(bytes: &[u8]) -> Self {
        let mut found = Self::default();
        for line in String::from_utf8_lossy(bytes).lines() {
            let (word, rest) = line.split_once(' ').unwrap_or((line, ""));
            let entity = || rest.trim().parse().ok().map(|tag| Entity { tag, label: String::new() });
            match (word, found.volumes.last_mut()) {
                ("surfaces", _) => found.surfaces = rest.trim().parse().ok(),
                ("volume", _) => found.volumes.extend(entity().map(|volume| (volume, Vec::new()))),
                ("face", Some((_, faces))) => faces.extend(entity()),
                ("label", Some((volume, faces))) => {
                    // `Shapes/Assembly/1/Bracket`.
                    let own = rest.trim().rsplit('/').next().unwrap_or_default();
                    faces.last_mut().unwrap_or(volume).label = own.to_string();
                }
                _ => {}
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_gmsh_found_is_read_and_other_lines_are_left_out() {
        let said = "surfaces 3\nvolume 1\nlabel Shapes/Assembly/1/Bracket left\nface 7\nlabel \nface 8\nlabel Shapes/top\nnoise\nvolume 2\n\
                    label\nface 9\nlabel x";
        let found = Found::read(said.as_bytes());
        let entity = |tag, label: &str| Entity { tag, label: label.into() };
        assert_eq!(found.surfaces, Some(3));
        assert_eq!(found.volumes[0], (entity(1, "Bracket left"), vec![entity(7, ""), entity(8, "top")]));
        assert_eq!(found.volumes[1], (entity(2, ""), vec![entity(9, "x")]));
        assert_eq!(Found::read(b"face 3\nlabel x\nsurfaces many"), Found::default());
    }
}
