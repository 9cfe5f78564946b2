//! The picture of a mesh: bodies coloured by part, element edges, names of the parts; for looking at a model before it runs.
//! A frame comes from the simulation at time zero; the PNG goes next to the model's check.

use super::body::{Mesh, Values};
use super::film::FilmSettings;
use super::scene::{Key, Moment, Plan, Scene};
use super::view::{self, NOTHING, joined, mirrored};
use super::{PictureError, write_png};
use crate::outline::LineReader;
use embate_solver::output::{Cells, Frame};
use std::path::Path;

/// Writes the mesh at `frame` as a PNG, whole or not at all. Of `settings`, the field is not used.
///
/// # Errors
/// [`PictureError::Io`] and [`PictureError::Encode`] if the file can't be written.
pub fn mesh_png(frame: &Frame, cells: &Cells, settings: &FilmSettings, path: &Path) -> Result<(), PictureError> {
    let mesh = Mesh::new(cells);
    let finite = || frame.positions::<2>().iter().filter(|p| p.iter().all(|v| v.is_finite()));
    let origin = finite().next().copied().unwrap_or_default();
    let bodies = finite().fold(NOTHING, |view, p| joined(view, [*p, *p]));
    let obstacles = LineReader::default().lines(frame);
    let nodes = frame.positions::<2>().iter().copied();
    let sides = view::sides(nodes.clone());
    let seen = view::obstacles(&obstacles, nodes, bodies, view::room(bodies, settings.mirror, sides));
    let view = mirrored(joined(bodies, seen), settings.mirror);
    let count = |number: usize, what: &str| format!("{number} {what}{}", if number == 1 { "" } else { "s" });
    let note = format!("{}, {}", count(mesh.len(), "element"), count(frame.positions::<2>().len(), "node"));
    let size = [settings.width, settings.height];
    let key = Key::Parts(cells.part_names.clone());
    let mut scene = Scene::new(&Plan { title: &settings.title, mirror: settings.mirror, sides, size, view, key, note: &note });
    let positions: Vec<[f32; 2]> = frame.positions::<2>().iter().map(|p| [(p[0] - origin[0]) as f32, (p[1] - origin[1]) as f32]).collect();
    let mut canvas = scene.still().clone();
    scene.draw(&mesh, &Moment { positions: &positions, origin, obstacles: &obstacles, values: Values::Parts, note: &note }, &mut canvas);
    write_png(&canvas, path)
}
