//! The picture of a mesh: bodies coloured by part, element edges, names of the parts; for looking at a model
//! before it runs. A frame comes from the simulation at time zero; the PNG goes next to the model's check.

use super::body::{Mesh, Values};
use super::film::FilmSettings;
use super::raster::Canvas;
use super::scene::{self, Scene};
use super::sheet::{Key, Plan};
use super::space::obstacle::{Shape, Solid};
use super::space::{self, Sight, Skinner};
use super::view::{self, NOTHING, joined, mirrored, nothing};
use super::{PictureError, glyphs, write_png};
use crate::outline::{Extent, LineReader};
use crate::preview::{Glyph, Symbol};
use embate_solver::output::{Cells, Frame};
use std::path::Path;

/// Writes the mesh at `frame` as a PNG, whole or not at all. Of `settings`, the field is not used.
///
/// # Errors
/// [`PictureError::Io`] and [`PictureError::Encode`] if the file can't be written.
pub fn mesh_png(frame: &Frame, cells: &Cells, settings: &FilmSettings, path: &Path) -> Result<(), PictureError> {
    model_png((frame, cells, &[]), settings, path)
}

/// [`mesh_png`] with glyphs of what acts on the bodies, and of what is faulty.
///
/// # Errors
/// As [`mesh_png`].
pub fn model_png((frame, cells, glyphs): (&Frame, &Cells, &[Glyph]), settings: &FilmSettings, path: &Path) -> Result<(), PictureError> {
    let canvas = if frame.dimension == 3 { in_3d(frame, cells, glyphs, settings) } else { in_plane(frame, cells, glyphs, settings) };
    write_png(&canvas, path)
}

/// What stands in the picture besides the mesh.
fn plan<'a>(key: Key, settings: &'a FilmSettings, view: Extent<2>, sides: [f64; 2], note: &'a str) -> Plan<'a> {
    Plan { title: &settings.title, mirror: settings.mirror, sides, size: [settings.width, settings.height], view, key, note }
}

fn key(cells: &Cells, glyphs: &[Glyph]) -> Key {
    Key::Parts { names: cells.part_names.clone(), glyphs: glyphs::legend(glyphs) }
}

/// Box around what glyphs show of places beyond the bodies: probes, welds and faults, not planes, which are
/// as large as the bodies.
fn around(glyphs: &[Glyph]) -> impl Iterator<Item = [f64; 3]> {
    let symbols = |glyph: &Glyph| {
        let radius = |vector: &[f64; 3]| if glyph.kind.symbol == Symbol::Ring { vector[0] } else { 0.0 };
        let ends = glyph
            .points
            .iter()
            .zip(&glyph.vectors)
            .flat_map(|(point, vector)| [radius(vector), -radius(vector)].map(|by| point.map(|x| x + by)));
        ends.collect::<Vec<_>>()
    };
    glyphs.iter().filter(|glyph| glyph.kind.symbol != Symbol::Plane).flat_map(symbols)
}

/// How many elements and nodes there are.
fn note(elements: usize, frame: &Frame) -> String {
    let count = |number: usize, what: &str| format!("{number} {what}{}", if number == 1 { "" } else { "s" });
    format!("{}, {}", count(elements, "element"), count(frame.nodes(), "node"))
}

/// Finite positions.
fn finite<const D: usize>(frame: &Frame) -> impl Iterator<Item = &[f64; D]> {
    frame.positions::<D>().iter().filter(|p| p.iter().all(|v| v.is_finite()))
}

/// Positions from the first finite one, and that one.
fn from_origin<const D: usize>(places: impl Iterator<Item = [f64; D]>, frame: &Frame) -> (Vec<[f32; D]>, [f64; D]) {
    let origin = finite(frame).next().copied().unwrap_or([0.0; D]);
    (places.map(|p| std::array::from_fn(|k| (p[k] - origin[k]) as f32)).collect(), origin)
}

fn in_plane(frame: &Frame, cells: &Cells, glyphs: &[Glyph], settings: &FilmSettings) -> Canvas {
    let mesh = Mesh::new(cells);
    let bodies = finite::<2>(frame).fold(NOTHING, |view, p| joined(view, [*p, *p]));
    let bodies = around(glyphs).map(|[x, y, _]| [x, y]).fold(bodies, |view, p| joined(view, [p, p]));
    let obstacles = LineReader::default().lines(frame);
    let nodes = frame.positions::<2>().iter().copied();
    let mirror = [settings.mirror[0], settings.mirror[1]];
    let sides = view::sides(nodes.clone());
    let seen = view::obstacles(&obstacles, nodes.clone(), bodies, view::room(bodies, mirror, sides));
    let note = note(mesh.len(), frame);
    let mut scene = Scene::new(&plan(key(cells, glyphs), settings, mirrored(joined(bodies, seen), mirror), sides, &note));
    let (positions, origin) = from_origin(nodes, frame);
    let mut canvas = scene.still().clone();
    let moment = scene::Moment { positions: &positions, origin, obstacles: &obstacles, values: Values::Parts, note: &note };
    scene.draw(&mesh, &moment, &mut canvas);
    scene.draw_glyphs(glyphs, &mut canvas);
    canvas
}

fn in_3d(frame: &Frame, cells: &Cells, glyphs: &[Glyph], settings: &FilmSettings) -> Canvas {
    let places = frame.positions::<3>();
    let place = |node: u32| places.get(node as usize).copied().unwrap_or([f64::NAN; 3]);
    let skin = Skinner::new(cells, &place).skin(cells, &[]);
    let own = finite::<3>(frame).fold(nothing(), |view, p| joined(view, [*p, *p]));
    let bodies = mirrored(own, settings.mirror);
    let surfaces = LineReader::default().surfaces(frame);
    let obstacles: Vec<Solid> = surfaces.iter().filter_map(|surface| Shape::of(surface).solid(&surface.points, bodies)).collect();
    let sight = Sight::new(&settings.camera, settings.mirror);
    let (positions, origin) = from_origin(skin.nodes.iter().map(|&node| place(node)), frame);
    let seen = finite::<3>(frame).copied().chain(obstacles.iter().flat_map(|obstacle| obstacle.seen(bodies))).chain(around(glyphs));
    let view = sight.aimed(sight.view(seen));
    let note = note(cells.len(), frame);
    let mut scene = space::Scene::new(&plan(key(cells, glyphs), settings, view, [1.0; 2], &note), &sight);
    let mut canvas = scene.still().clone();
    let moment = space::Moment { skin: &skin, positions: &positions, origin, obstacles: &obstacles, values: Values::Parts, note: &note };
    scene.draw(&moment, &mut canvas);
    scene.draw_glyphs(glyphs, &mut canvas);
    canvas
}
