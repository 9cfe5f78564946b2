//! Obstacles with all of the bodies inside at the start: their normal, most often, looks the wrong way.

use super::Builds;
use super::passing::solid;
use crate::mesh::surface::Sided;
use crate::mesh::{Mesh, tolerance};
use crate::model::{Obstacle, ObstacleShape, in_3d};
use crate::tensor::Dim;

/// What to do about an obstacle of which so many nodes are inside, if all that it stops is.
pub(crate) fn turned<const D: usize>(obstacle: &Obstacle, mesh: &Mesh<D>, inside: usize) -> Option<String>
where
    Dim<D>: Builds<D>,
{
    let is_met = |name: &String| obstacle.parts.is_empty() || obstacle.parts.contains(name);
    let mut parts = mesh.parts.iter().filter(|part| is_met(&part.name));
    let all = match solid(obstacle) {
        Some(solid) => {
            let least = -tolerance(&mesh.positions);
            parts.all(|part| part.nodes.iter().all(|&node| solid.distance(in_3d(mesh.positions[node as usize])).0 < least))
        }
        None => inside > 0 && mesh.outside(&obstacle.parts).is_ok_and(|outside| outside.nodes().len() <= inside),
    };
    all.then(|| match &obstacle.shape {
        ObstacleShape::Plane { normal, .. } => {
            let turned: Vec<String> = normal[..D].iter().map(|x| format!("{}", if *x == 0.0 { 0.0 } else { -x })).collect();
            format!("its normal looks away from them: turn it, `normal = [{}]`; or move the plane", turned.join(", "))
        }
        ObstacleShape::Circle { hollow, .. } | ObstacleShape::Sphere { hollow, .. } | ObstacleShape::Cylinder { hollow, .. } => {
            if *hollow {
                "bodies are inside of what is hollow: leave `hollow` out, or move it".to_string()
            } else {
                "if they are meant to be inside of it, give `hollow = true`; else move it".to_string()
            }
        }
        ObstacleShape::Polyline { .. } => {
            "bodies are on the left of the way from point to point: give the points in the other order".to_string()
        }
        ObstacleShape::Triangles(_) => "its triangles look away from them: let the program that made it turn all normals".to_string(),
    })
}
