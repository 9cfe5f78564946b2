//! The pictures of a film's frames, in 2D or 3D, and the colours of its animation.
//! What is shown was decided in `show`; `scene` and `space` draw.

use super::show::Show;
use super::{Film, evenly};
use crate::picture::animation::Palette;
use crate::picture::body::{Mesh, Values};
use crate::picture::raster::Canvas;
use crate::picture::scene::{self, Scene};
use crate::picture::sheet::Plan;
use crate::picture::space;

/// Frames whose colours an animation in 3D is given.
const SAMPLED: usize = 6;

/// Where frames are drawn.
#[derive(Clone, Debug)]
pub(super) enum Stage {
    Plane(Scene),
    Space(space::Scene),
}

impl Stage {
    /// The canvas to start each frame from.
    pub(super) fn still(&self) -> &Canvas {
        match self {
            Self::Plane(scene) => scene.still(),
            Self::Space(scene) => scene.still(),
        }
    }
}

impl Film {
    pub(super) fn stage(&self, show: &Show, notes: &[String], size: [u32; 2]) -> Stage {
        let longest = notes.iter().max_by_key(|note| note.chars().count()).map_or("", String::as_str);
        let (title, mirror) = (&self.settings.title, self.settings.mirror);
        let plan = Plan { title, mirror, sides: show.sides, size, view: show.view, key: show.key.clone(), note: longest };
        if self.is_in_3d() { Stage::Space(space::Scene::new(&plan, &self.sight())) } else { Stage::Plane(Scene::new(&plan)) }
    }

    /// Draws a stored frame.
    pub(super) fn draw(&self, index: usize, stage: &mut Stage, mesh: &Mesh, show: &Show, notes: &[String], canvas: &mut Canvas) {
        let (frame, note) = (&self.stored[index], notes[index].as_str());
        let values = match show.scalar.map(|k| (self.scalars[k], &frame.values[k])) {
            None => Values::Plain,
            Some((scalar, values)) if scalar.at_nodes() => Values::Nodes(values, show.range),
            Some((_, values)) => Values::Cells(values, show.range),
        };
        match (stage, &frame.skin) {
            (Stage::Plane(scene), _) => {
                // The cells of a frame, where some are gone or they are others.
                let is_own = frame.past.is_some() || !frame.gone.is_empty();
                let left = is_own.then(|| Mesh::without(frame.past.as_deref().unwrap_or(&self.cells), &frame.gone));
                let [x, y, _] = self.origin();
                let moment = scene::Moment { positions: frame.places(), origin: [x, y], obstacles: &frame.obstacles, values, note };
                scene.draw(left.as_ref().unwrap_or(mesh), &moment, canvas);
            }
            (Stage::Space(scene), Some(skin)) => {
                let obstacles = self.solids(frame, show.bodies);
                let moment = space::Moment { skin, positions: frame.places(), origin: self.origin(), obstacles: &obstacles, values, note };
                scene.draw(&moment, canvas);
            }
            (Stage::Space(scene), None) => canvas.clone_from(scene.still()),
        }
    }

    /// The colours of the animation of the frames that were `chosen`. The first of them is left on `canvas`.
    pub(super) fn palette(
        &self,
        chosen: &[usize],
        stage: &mut Stage,
        canvas: &mut Canvas,
        draw: impl Fn(usize, &mut Stage, &mut Canvas),
    ) -> Palette {
        draw(chosen[0], stage, canvas);
        if let Stage::Plane(scene) = stage {
            return Palette::new(scene.looks());
        }
        // Light makes more colours than the map has: those that are there.
        let mut pictures = vec![canvas.clone()];
        for k in evenly(chosen.len(), SAMPLED).into_iter().filter(|&k| k > 0) {
            let mut picture = canvas.clone();
            draw(chosen[k], stage, &mut picture);
            pictures.push(picture);
        }
        Palette::of(&pictures)
    }
}
