//! The film of a run: collects frames, then writes `animation.gif` with one camera for all of them, and
//! `final.png`, which shows the last frame alone and as large as it fits; the colour range is that of the
//! whole run in both. Frames come from the observer of a run; `scene` draws them, `animation` and the PNG
//! writer take the pictures.

mod settings;
mod show;
mod stage;
mod stored;

pub use settings::FilmSettings;

use super::animation::{Animation, Indices};
use super::body::Mesh;
use super::field::{Scalar, names};
use super::{PictureError, write_png, write_whole};
use crate::outline::LineReader;
use crate::picture::space::obstacle::Shape;
use crate::threads::{ScratchPool, Threads};
use embate_solver::archive::{Archive, ArchiveResult, Persist, Section};
use embate_solver::output::{Cells, Frame};
use show::Show;
use std::path::Path;
use std::sync::Arc;
pub(super) use stored::gone;
use stored::{Space, Stored, on_skin, persist_past};

/// Stored frames may use this much memory.
const BYTES_MAX: usize = 256 << 20;
/// More stored frames than this show nothing more.
const STORED_MAX: usize = 400;
/// Frames of the animation: more make the file large and, at the shortest delay that browsers respect, the
/// film long.
const SHOWN_MAX: usize = 160;
/// Width of the animation, pixels.
const ANIMATION_WIDTH: u32 = 640;
/// Frames that a thread draws before they are encoded and written.
const FRAMES_AT_ONCE: usize = 4;
/// Length of the film without the last frame, hundredths of a second.
const LENGTH: usize = 700;
/// How long the last frame stays, hundredths of a second.
const HOLD: u16 = 150;

/// The frames of a run, as far as a film needs them.
#[derive(Clone, Debug)]
pub struct Film {
    cells: Cells,
    settings: FilmSettings,
    /// Scalars that may be shown, the preferred first.
    scalars: Vec<Scalar>,
    /// Fields of the first frame, when the wanted one was not among them.
    missing: Option<String>,
    /// Added to stored positions, m: keeps `f32` exact enough far from the origin.
    origin: Option<[f64; 3]>,
    line_reader: LineReader,
    /// Of a film in 3D.
    space: Option<Space>,
    stored: Vec<Stored>,
    /// Every `stride`-th frame is kept; and the last.
    stride: usize,
    added: usize,
    bytes_max: usize,
}

/// Its section in a checkpoint.
const SECTION: &str = "film";

impl Persist for Film {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { cells: _, settings: _, bytes_max: _, space: _, scalars, missing, origin, line_reader, stored, stride, added } = self;
        // Another choice of colours makes another film.
        let own: Vec<String> = scalars.iter().map(Scalar::label).collect();
        let mut labels = own.clone();
        labels.persist(archive)?;
        archive.check(labels == own, "the film shows other fields")?;
        missing.persist(archive)?;
        origin.persist(archive)?;
        line_reader.far.persist(archive)?;
        stored.persist(archive)?;
        persist_past(stored, archive)?;
        stride.persist(archive)?;
        added.persist(archive)
    }
}

impl Film {
    /// An empty film of these cells.
    #[must_use]
    pub fn new(cells: Cells, settings: FilmSettings) -> Self {
        Self {
            cells,
            settings,
            scalars: Vec::new(),
            missing: None,
            origin: None,
            line_reader: LineReader::default(),
            space: None,
            stored: Vec::new(),
            stride: 1,
            added: 0,
            bytes_max: BYTES_MAX,
        }
    }

    /// What was kept of a film, with this `frame` as the present one; an empty film where that was another
    /// one.
    pub(crate) fn recalled(cells: Cells, settings: FilmSettings, kept: &[Section], frame: &Frame) -> Self {
        let mut film = Self::new(cells, settings);
        film.choose_scalars(frame);
        let mut archive = Archive::of(kept);
        let is_read = archive.section(SECTION).and_then(|()| film.persist(&mut archive)).is_ok() && archive.finish().is_ok();
        let sizes = [frame.nodes(), film.cells.len()];
        let are_there = |stored: &Stored| stored.past.is_some() || stored.gone.iter().all(|&cell| (cell as usize) < sizes[1]);
        if is_read && film.stored.iter().all(are_there) {
            film.enter_space(frame);
            film.put_skins_on();
            if film.is_sound(sizes) {
                return film;
            }
        }
        Self::new(film.cells, film.settings)
    }

    /// Frames that are added from here on are of these cells.
    pub(crate) fn set_cells(&mut self, cells: Cells) {
        let old = std::mem::replace(&mut self.cells, cells);
        let past = Arc::new(if self.is_in_3d() { Cells::default() } else { old });
        self.stored.iter_mut().filter(|stored| stored.past.is_none()).for_each(|stored| stored.past = Some(past.clone()));
    }

    /// All that it has so far.
    pub(crate) fn kept(&mut self) -> Vec<Section> {
        let mut archive = Archive::new();
        let written = archive.section(SECTION).and_then(|()| self.persist(&mut archive));
        written.and_then(|()| archive.finish()).unwrap_or_default()
    }

    /// Prepares for frames in 3D, if this is one.
    fn enter_space(&mut self, frame: &Frame) {
        let has_new_cells = self.stored.last().is_some_and(|last| last.past.is_some());
        if frame.dimension == 3 && (has_new_cells || self.space.is_none()) {
            let mut space = Space::new(&self.cells, frame);
            space.shapes = self.line_reader.all_surfaces(frame).iter().map(Shape::of).collect();
            self.space = Some(space);
        }
    }

    /// Gives stored frames in 3D the skins that they had.
    fn put_skins_on(&mut self) {
        let Some(space) = &mut self.space else { return };
        for stored in self.stored.iter_mut().filter(|stored| stored.past.is_none()) {
            stored.skin = Some(space.skin(&self.cells, &stored.gone));
        }
    }

    fn is_in_3d(&self) -> bool {
        self.space.is_some()
    }

    /// Whether all frames are of so many nodes and cells.
    fn is_sound(&self, [nodes, cells]: [usize; 2]) -> bool {
        let is_sound = |frame: &Stored| {
            let [numbers, nodes, cells] = match (&frame.skin, &frame.past) {
                (None, None) => [2 * nodes, nodes, cells],
                (None, Some(cells)) => {
                    let nodes = frame.places::<2>().len();
                    if cells.nodes.iter().any(|&node| node as usize >= nodes) {
                        return false;
                    }
                    [2 * nodes, nodes, cells.len()]
                }
                (Some(skin), _) => [3 * skin.nodes.len(), skin.nodes.len(), skin.facets.len() + skin.bars.len()],
            };
            let sizes = self.scalars.iter().map(|scalar| if scalar.at_nodes() { nodes } else { cells });
            frame.positions.len() == numbers && frame.values.iter().map(Vec::len).eq(sizes) && frame.number < self.added
        };
        self.stride > 0 && self.stored.iter().all(is_sound)
    }

    fn origin(&self) -> [f64; 3] {
        self.origin.unwrap_or_default()
    }

    /// Adds a frame. Keeps positions and the shown scalar in single precision; drops every second kept frame
    /// when they get too many.
    pub fn add(&mut self, frame: &Frame) {
        if self.added == 0 {
            self.choose_scalars(frame);
        }
        self.enter_space(frame);
        if self.origin.is_none() {
            self.origin = (0..frame.nodes()).map(|node| frame.place(node)).find(|p| p.iter().all(|v| v.is_finite()));
        }
        // The last frame is always kept until another follows.
        if self.stored.last().is_some_and(|last| last.number % self.stride != 0) {
            self.stored.pop();
        }
        let gone = gone(frame);
        let skin = self.space.as_mut().map(|space| space.skin(&self.cells, &gone));
        let values = self.scalars.iter().map(|scalar| match &skin {
            None => self.values(scalar, frame),
            Some(skin) => on_skin(skin, scalar.at_nodes(), &self.values(scalar, frame)),
        });
        let mut stored = Stored { number: self.added, time: frame.time, values: values.collect(), ..Stored::default() };
        let origin = self.origin();
        match &skin {
            None => {
                stored.positions = self.shown(frame, &gone).flat_map(|p| [(p[0] - origin[0]) as f32, (p[1] - origin[1]) as f32]).collect();
                stored.obstacles = self.line_reader.lines(frame);
            }
            Some(skin) => {
                let places = skin.nodes.iter().filter(|&&node| (node as usize) < frame.nodes()).map(|&node| frame.place(node as usize));
                stored.positions = places.flat_map(|p| [0, 1, 2].map(|k| (p[k] - origin[k]) as f32)).collect();
                stored.surfaces = self.line_reader.surfaces(frame).into_iter().map(|surface| surface.points).collect();
            }
        }
        self.stored.push(Stored { gone, skin, ..stored });
        self.added += 1;
        while self.stored.len() > 2 && (self.stored.len() > STORED_MAX || self.bytes() > self.bytes_max) {
            self.thin();
        }
    }

    /// Memory of the stored frames, and of the skins and cells that they share.
    fn bytes(&self) -> usize {
        let skin = |k: usize| self.stored[k].skin.as_ref();
        let is_own = |k: &usize| k.checked_sub(1).and_then(skin).zip(skin(*k)).is_none_or(|(a, b)| !Arc::ptr_eq(a, b));
        let skins: usize = (0..self.stored.len()).filter(is_own).filter_map(|k| Some(skin(k)?.bytes())).sum();
        let past = self.stored.iter().filter_map(|stored| stored.past.as_ref());
        let mut cells: Vec<_> = past.map(|cells| (Arc::as_ptr(cells), cells.bytes())).collect();
        cells.dedup();
        let cells: usize = cells.iter().map(|(_, bytes)| bytes).sum();
        skins + cells + self.stored.iter().map(Stored::bytes).sum::<usize>()
    }

    /// Values of a frame; not a number in elements of rigid parts.
    fn values(&self, scalar: &Scalar, frame: &Frame) -> Vec<f32> {
        let mut values = scalar.values(frame);
        if !scalar.at_nodes() && self.settings.rigid.contains(&true) {
            let is_rigid = |part: &u32| self.settings.rigid.get(*part as usize).is_some_and(|&rigid| rigid);
            for (value, _) in values.iter_mut().zip(&self.cells.parts).filter(|(_, part)| is_rigid(part)) {
                *value = f32::NAN;
            }
        }
        values
    }

    /// Positions of the nodes that have a cell; not a number for those whose cells are all `gone`, which fly
    /// anywhere.
    fn shown<'a>(&self, frame: &'a Frame, gone: &[u32]) -> impl Iterator<Item = [f64; 2]> + use<'a> {
        let mut has_cell = vec![gone.is_empty(); frame.positions::<2>().len()];
        if !gone.is_empty() {
            let there = (0..self.cells.len()).filter(|&cell| gone.binary_search(&(cell as u32)).is_err());
            for &node in there.flat_map(|cell| self.cells.cell(cell)) {
                has_cell[node as usize] = true;
            }
        }
        frame.positions::<2>().iter().zip(has_cell).map(|(p, has_cell)| if has_cell { *p } else { [f64::NAN; 2] })
    }

    fn choose_scalars(&mut self, frame: &Frame) {
        if self.settings.field.is_empty() {
            self.scalars = Scalar::defaults(frame);
        } else if let Some(scalar) = Scalar::named(frame, &self.settings.field) {
            self.scalars = vec![scalar];
        } else {
            self.missing = Some(names(&frame.fields));
        }
    }

    fn thin(&mut self) {
        self.stride *= 2;
        let (stride, last) = (self.stride, self.added - 1);
        self.stored.retain(|frame| frame.number % stride == 0 || frame.number == last);
    }

    /// Writes `animation.gif` (some seven seconds, repeated, the last frame held) and `final.png` (the last
    /// frame) into `folder`; `threads` draw several frames at once.
    ///
    /// # Errors
    /// [`PictureError::Empty`] without a frame, [`PictureError::Field`] if the wanted field is in no frame,
    /// [`PictureError::Io`] and [`PictureError::Encode`] if a file can't be written.
    pub fn finish(&self, folder: &Path, threads: &Threads) -> Result<(), PictureError> {
        let Some(last) = self.stored.last() else { return Err(PictureError::Empty) };
        if let Some(available) = &self.missing {
            return Err(PictureError::Field { name: self.settings.field.clone(), available: available.clone() });
        }
        let show = self.show();
        let mesh = if self.is_in_3d() { Mesh::default() } else { Mesh::new(&self.cells) };
        let notes = self.notes();
        let wide = self.settings.width.min(ANIMATION_WIDTH);
        let high = f64::from(self.settings.height) * f64::from(wide) / f64::from(self.settings.width.max(1));
        self.write_animation(folder, &mesh, &show, &notes, [wide, high.round() as u32], threads)?;
        let show = self.show_of(last, &show);
        let mut stage = self.stage(&show, &notes, [self.settings.width, self.settings.height]);
        let mut canvas = stage.still().clone();
        self.draw(self.stored.len() - 1, &mut stage, &mesh, &show, &notes, &mut canvas);
        write_png(&canvas, &folder.join("final.png"))
    }

    fn write_animation(
        &self,
        folder: &Path,
        mesh: &Mesh,
        show: &Show,
        notes: &[String],
        size: [u32; 2],
        threads: &Threads,
    ) -> Result<(), PictureError> {
        let mut stage = self.stage(show, notes, size);
        let chosen = evenly(self.stored.len(), SHOWN_MAX);
        let delay = (LENGTH / chosen.len().max(1)).clamp(3, 50) as u16;
        // The first frame decides how parts look.
        let mut canvas = stage.still().clone();
        let palette =
            self.palette(&chosen, &mut stage, &mut canvas, |index, stage, canvas| self.draw(index, stage, mesh, show, notes, canvas));
        let mut palette = palette;
        let still = palette.indices(stage.still(), None);
        let path = folder.join("animation.gif");
        let scratch_pool = ScratchPool::default();
        write_whole(&path, |out| {
            let mut animation = Animation::start(out, &canvas, &palette, &path)?;
            for chosen in chosen.chunks(FRAMES_AT_ONCE * threads.count()) {
                let room = || (stage.clone(), canvas.clone(), palette.clone());
                let pictures: Vec<Indices> = threads.map(chosen, &scratch_pool, room, |(stage, canvas, palette), &index| {
                    self.draw(index, stage, mesh, show, notes, canvas);
                    palette.indices(canvas, Some((stage.still(), &still)))
                });
                let delays: Vec<u16> = chosen.iter().map(|index| if index + 1 == self.stored.len() { HOLD } else { delay }).collect();
                animation.frames(pictures, &delays, threads)?;
            }
            Ok(())
        })
    }
}

/// At most `most` of the numbers `0..count`, evenly spaced, the last included.
fn evenly(count: usize, most: usize) -> Vec<usize> {
    if count <= most {
        return (0..count).collect();
    }
    (0..most).map(|k| (k * (count - 1) + (most - 1) / 2) / (most - 1)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::space::tests::block;
    use crate::picture::view::size;
    use embate_solver::output::{Field, Outline, fields_of};

    fn field_kind(name: &str) -> Option<&'static embate_solver::output::FieldKind> {
        fields_of(3).iter().find(|kind| kind.name == name)
    }

    fn frame(time: f64, x: f64) -> Frame {
        Frame { time, ..Frame::of(&[[x, 0.0], [x + 1.0, 0.0], [x, 1.0]]) }
    }

    #[test]
    fn a_long_film_is_thinned_and_keeps_first_and_last() {
        let mut film = Film::new(Cells::default(), FilmSettings::default());
        film.bytes_max = 24 * 10;
        for k in 0..1001 {
            film.add(&frame(k as f64, 0.0));
            assert!(film.stored.len() <= 10);
            assert_eq!(film.stored.last().unwrap().number, k);
        }
        let numbers: Vec<usize> = film.stored.iter().map(|f| f.number).collect();
        assert_eq!((numbers[0], *numbers.last().unwrap()), (0, 1000));
        let regular = &numbers[..numbers.len() - 1];
        assert!(regular.windows(2).all(|w| w[1] - w[0] == film.stride), "{numbers:?}");
        assert!(numbers.len() >= 5);
    }

    #[test]
    fn a_film_of_3d_keeps_the_skin_alone_and_continues_from_what_was_kept() {
        let size = [6, 5, 4];
        let cells = block(size);
        let count = cells.len();
        let frame = |k: usize| {
            let places: Vec<[f64; 3]> =
                (0..7 * 6 * 5).map(|node| [node % 7, node / 7 % 6, node / 42].map(|v| v as f64 + 0.1 * k as f64)).collect();
            let field = |name: &str, values: Vec<f64>| Field { kind: field_kind(name).unwrap(), values };
            let alive = (0..count).map(|cell| f64::from(u8::from(!(k > 1 && cell == 3)))).collect();
            let stress = (0..count).map(|cell| (cell + k) as f64).collect();
            let outlines =
                vec![Outline { name: "o".into(), points: vec![[0.0, 0.0, k as f64]; 4], facets: vec![[0, 1, 2, 3]], is_gone: false }];
            Frame { time: k as f64, fields: vec![field("von_mises", stress), field("alive", alive)], outlines, ..Frame::of(&places) }
        };
        let settings = || FilmSettings { field: "von_mises".into(), ..FilmSettings::default() };
        let mut film = Film::new(cells.clone(), settings());
        (0..3).for_each(|k| film.add(&frame(k)));
        let kept = film.kept();
        let mut other = Film::recalled(cells.clone(), settings(), &kept, &frame(2));
        film.add(&frame(3));
        other.add(&frame(3));
        let facets = |film: &Film| film.stored.iter().map(|frame| frame.skin.as_ref().unwrap().facets.clone()).collect::<Vec<_>>();
        assert_eq!((film.stored.len(), facets(&film)), (4, facets(&other)));
        let numbers =
            |film: &Film| film.stored.iter().map(|f| (f.positions.clone(), f.values.clone(), f.surfaces.clone())).collect::<Vec<_>>();
        assert_eq!(numbers(&film), numbers(&other));
        let (first, last) = (&film.stored[0], &film.stored[3]);
        assert_eq!(first.positions.len(), 3 * (7 * 6 * 5 - 5 * 4 * 3), "no node within");
        assert!(Arc::ptr_eq(first.skin.as_ref().unwrap(), film.stored[1].skin.as_ref().unwrap()), "one skin as long as no cell goes");
        let value = |frame: &Stored, facet: usize| (frame.values[0][facet], frame.skin.as_ref().unwrap().facets[facet].cell);
        assert!((0..first.values[0].len()).map(|k| value(first, k)).all(|(value, cell)| value == cell as f32));
        assert!((0..last.values[0].len()).map(|k| value(last, k)).all(|(value, cell)| value == cell as f32 + 3.0 && cell != 3));
        let empty = Film::recalled(block([2, 2, 2]), settings(), &kept, &frame(2));
        assert!(empty.stored.is_empty(), "that was another film");
    }

    /// A film whose cells are replaced twice, made in one go, and stopped and continued after each frame: the
    /// same pictures.
    fn continues_with_other_cells(cells: [Cells; 3], frames: [&Frame; 3]) {
        let settings = || FilmSettings { field: "von_mises".into(), width: 300, height: 200, ..FilmSettings::default() };
        let mut film = Film::new(cells[0].clone(), settings());
        let mut stopped = film.clone();
        for (k, (cells, frame)) in cells.iter().zip(frames).enumerate() {
            for film in [&mut film, &mut stopped].into_iter().filter(|_| k > 0) {
                film.set_cells(cells.clone());
            }
            for time in 0..2 {
                let frame = Frame { time: (2 * k + time) as f64, ..frame.clone() };
                film.add(&frame);
                stopped.add(&frame);
                let kept = stopped.kept();
                stopped = Film::recalled(cells.clone(), settings(), &kept, &frame);
                assert_eq!(stopped.stored.len(), 2 * k + time + 1, "nothing is lost");
            }
        }
        assert_eq!(film.bytes(), stopped.bytes(), "what frames share is there once");
        let folder = tempfile::tempdir().unwrap();
        let made = [(&film, "film"), (&stopped, "stopped")].map(|(film, name)| {
            let folder = folder.path().join(name);
            std::fs::create_dir(&folder).unwrap();
            film.finish(&folder, &Threads::new(1)).unwrap();
            ["animation.gif", "final.png"].map(|file| std::fs::read(folder.join(file)).unwrap())
        });
        assert!(made[0] == made[1] && made[0][0].len() > 1000);
        // Damage that no check sum finds.
        let mut kept = stopped.kept();
        for at in (0..kept[0].bytes.len()).step_by(13) {
            kept[0].bytes[at] ^= 0x10;
            let film = Film::recalled(cells[2].clone(), settings(), &kept, frames[2]);
            assert!(film.stored.len() <= 6);
            kept[0].bytes[at] ^= 0x10;
        }
    }

    fn of_values(cells: &Cells, frame: Frame) -> Frame {
        let values = (0..cells.len()).map(|cell| cell as f64).collect();
        Frame { fields: vec![Field { kind: field_kind("von_mises").unwrap(), values }], ..frame }
    }

    #[test]
    fn a_film_of_3d_whose_cells_are_replaced_continues_from_what_was_kept() {
        let sizes = [[2, 2, 2], [3, 3, 2], [4, 2, 5]];
        let cells = sizes.map(block);
        let frames = [0, 1, 2].map(|k| {
            let [nx, ny, nz] = sizes[k].map(|n| n + 1);
            let place = |node: u32| [f64::from(node % nx) / f64::from(nx - 1), f64::from(node / nx % ny), f64::from(node / (nx * ny))];
            of_values(&cells[k], Frame::of(&(0..nx * ny * nz).map(place).collect::<Vec<_>>()))
        });
        continues_with_other_cells(cells, frames.each_ref());
    }

    #[test]
    fn a_film_of_2d_whose_cells_are_replaced_continues_from_what_was_kept() {
        let sizes = [[2, 2], [3, 4], [6, 5]];
        let cells = sizes.map(|[nx, ny]: [u32; 2]| {
            let mut cells = Cells { offsets: vec![0], part_names: vec!["plate".into()], ..Cells::default() };
            for first in (0..ny).flat_map(|j| (0..nx).map(move |i| i + (nx + 1) * j)) {
                cells.nodes.extend([first, first + 1, first + nx + 2, first + nx + 1]);
                cells.offsets.push(cells.nodes.len() as u32);
                cells.kinds.push(embate_solver::output::CellKind::Quadrilateral);
                cells.parts.push(0);
            }
            cells
        });
        let frames = [0, 1, 2].map(|k| {
            let [nx, ny] = sizes[k].map(|n| n + 1);
            let place = |node: u32| [f64::from(node % nx) / f64::from(nx - 1), f64::from(node / nx) / f64::from(ny - 1)];
            of_values(&cells[k], Frame::of(&(0..nx * ny).map(place).collect::<Vec<_>>()))
        });
        continues_with_other_cells(cells, frames.each_ref());
    }

    #[test]
    fn shown_frames_are_spread_evenly() {
        assert_eq!(evenly(4, 10), [0, 1, 2, 3]);
        let shown = evenly(400, 160);
        assert_eq!((shown.len(), shown[0], shown[159]), (160, 0, 399));
        assert!(shown.windows(2).all(|w| (2..=3).contains(&(w[1] - w[0]))));
    }

    #[test]
    fn a_node_thrown_away_does_not_shrink_the_picture() {
        let mut film = Film::new(Cells::default(), FilmSettings::default());
        let positions: Vec<[f64; 2]> = (0..1000).map(|k| [f64::from(k % 100), f64::from(k / 100)]).collect();
        let mut frame = Frame::of(&positions);
        film.add(&frame);
        frame.coordinates[14..18].copy_from_slice(&[1e9, -1e9, f64::NAN, 0.0]);
        film.add(&frame);
        assert!(size(film.view([1.0; 2])) < 150.0, "{:?}", film.view([1.0; 2]));
    }

    #[test]
    fn the_last_frame_fills_its_own_picture() {
        let mut film = Film::new(Cells::default(), FilmSettings { mirror: [true, false, false], ..FilmSettings::default() });
        film.add(&frame(0.0, 9.0));
        film.add(&frame(1.0, 2.0));
        let show = film.show();
        let whole = show.view;
        assert_eq!(whole, [[-10.0, 0.0], [10.0, 1.0]]);
        assert_eq!(film.show_of(&film.stored[1], &show).view, [[-3.0, 0.0], [3.0, 1.0]]);
        film.add(&frame(2.0, f64::NAN));
        assert_eq!(film.show_of(&film.stored[2], &show).view, whole, "nothing to be seen: the whole view");
    }

    #[test]
    fn far_from_the_origin_positions_stay_exact() {
        let mut film = Film::new(Cells::default(), FilmSettings::default());
        film.add(&frame(0.0, 1e8));
        let view = film.view([1.0; 2]);
        assert_eq!((view[0][0], view[1][0]), (1e8, 1e8 + 1.0));
    }

    #[test]
    fn the_time_label_has_the_decimals_that_frames_need() {
        let mut film = Film::new(Cells::default(), FilmSettings::default());
        for k in 0..101 {
            film.add(&frame(1e-4 * f64::from(k), 0.0));
        }
        assert_eq!(film.notes()[31], "t = 3.10 ms");
        let mut film = Film::new(Cells::default(), FilmSettings::default());
        film.add(&frame(0.0, 0.0));
        assert_eq!(film.notes(), ["t = 0 s"]);
    }
}
