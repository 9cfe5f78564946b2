//! The film of a run: collects frames, then writes `animation.gif` with one camera for all of them, and `final.png`, which shows the last frame
//! alone and as large as it fits; the colour range is that of the whole run in both.
//! Frames come from the observer of a run; `scene` draws them, `animation` and the PNG writer take the pictures.

use super::animation::{Animation, Indices, Palette};
use super::body::{Mesh, Values};
use super::field::{Scalar, names};
use super::raster::Canvas;
use super::scale::{decimals, number, unit};
use super::scene::{Key, Moment, Plan, Scene};
use super::view::{self, NOTHING, extent, joined, mirrored, size};
use super::{PictureError, write_png, write_whole};
use crate::outline::{Extent, Line, LineReader};
use crate::threads::{Rooms, Threads};
use embate_solver::archive::{Archive, Keep, Kept, Section};
use embate_solver::output::{Cells, Frame};
use std::path::Path;

/// What a film looks like.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmSettings {
    /// Title, at the upper left.
    pub title: String,
    /// Whether bodies are also shown mirrored at x = 0 and at y = 0 (symmetric models).
    pub mirror: [bool; 2],
    /// Lower and upper corner of what is shown, mirror images included, m; none: all bodies, and obstacles near them.
    pub view: Option<[[f64; 2]; 2]>,
    /// Whether forces are those of the whole circumference, and not per metre of depth.
    pub of_revolution: bool,
    /// Field shown as colour: a name (`von_mises`; vectors show their size) or a component (`stress.xy`); empty: plastic strain if there is
    /// any, else the equivalent stress.
    pub field: String,
    /// For each part whether it is rigid: nothing strains it, so fields of elements leave it grey. Parts beyond the list are not.
    pub rigid: Vec<bool>,
    /// Width of `final.png`, pixels; the animation is at most 640 wide.
    pub width: u32,
    /// Largest height of `final.png`, pixels; flat bodies get a lower picture.
    pub height: u32,
}

impl Default for FilmSettings {
    fn default() -> Self {
        Self {
            title: String::new(),
            mirror: [false; 2],
            view: None,
            of_revolution: false,
            field: String::new(),
            rigid: Vec::new(),
            width: 960,
            height: 720,
        }
    }
}

/// Stored frames may use this much memory.
const BYTES_MAX: usize = 256 << 20;
/// More stored frames than this show nothing more.
const STORED_MAX: usize = 400;
/// Frames of the animation: more make the file large and, at the shortest delay that browsers respect, the film long.
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
    origin: Option<[f64; 2]>,
    line_reader: LineReader,
    stored: Vec<Stored>,
    /// Every `stride`-th frame is kept; and the last.
    stride: usize,
    added: usize,
    bytes_max: usize,
}

#[derive(Clone, Debug, Default)]
struct Stored {
    number: usize,
    time: f64,
    positions: Vec<[f32; 2]>,
    /// Eroded cells, ascending.
    gone: Vec<u32>,
    obstacles: Vec<Line>,
    /// One list per scalar.
    values: Vec<Vec<f32>>,
}

impl Stored {
    fn bytes(&self) -> usize {
        8 * self.positions.len()
            + 16 * self.obstacles.iter().map(|line| line.points.len()).sum::<usize>()
            + 4 * self.values.iter().map(Vec::len).sum::<usize>()
    }
}

/// Its section in a checkpoint.
const SECTION: &str = "film";

impl Keep for Stored {
    fn keep(&mut self, archive: &mut Archive<'_>) -> Kept {
        let Self { number, time, positions, gone, obstacles, values } = self;
        number.keep(archive)?;
        time.keep(archive)?;
        positions.keep(archive)?;
        gone.keep(archive)?;
        let mut lines: Vec<(Vec<[f64; 2]>, bool)> =
            std::mem::take(obstacles).into_iter().map(|line| (line.points, line.is_endless)).collect();
        lines.keep(archive)?;
        *obstacles = lines.into_iter().map(|(points, is_endless)| Line { points, is_endless }).collect();
        values.keep(archive)
    }
}

impl Keep for Film {
    fn keep(&mut self, archive: &mut Archive<'_>) -> Kept {
        let Self { cells: _, settings: _, bytes_max: _, scalars, missing, origin, line_reader, stored, stride, added } = self;
        // Another choice of colours makes another film.
        let own: Vec<String> = scalars.iter().map(Scalar::label).collect();
        let mut labels = own.clone();
        labels.keep(archive)?;
        archive.check(labels == own, "the film shows other fields")?;
        missing.keep(archive)?;
        origin.keep(archive)?;
        line_reader.far.keep(archive)?;
        stored.keep(archive)?;
        stride.keep(archive)?;
        added.keep(archive)
    }
}

/// What was decided for the whole film.
struct Show {
    scalar: Option<usize>,
    range: [f64; 2],
    key: Key,
    view: Extent,
    /// Side of the mirror lines on which the model lies.
    sides: [f64; 2],
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
            stored: Vec::new(),
            stride: 1,
            added: 0,
            bytes_max: BYTES_MAX,
        }
    }

    /// What was kept of a film, with this `frame` as the present one; an empty film where that was another one.
    pub(crate) fn recalled(cells: Cells, settings: FilmSettings, kept: &[Section], frame: &Frame) -> Self {
        let mut film = Self::new(cells, settings);
        film.choose_scalars(frame);
        let mut archive = Archive::of(kept);
        let sizes = [frame.positions::<2>().len(), film.cells.len()];
        if archive.section(SECTION).and_then(|()| film.keep(&mut archive)).is_ok() && archive.finish().is_ok() && film.is_sound(sizes) {
            return film;
        }
        Self::new(film.cells, film.settings)
    }

    /// All that it has so far.
    pub(crate) fn kept(&mut self) -> Vec<Section> {
        let mut archive = Archive::new();
        let written = archive.section(SECTION).and_then(|()| self.keep(&mut archive));
        written.and_then(|()| archive.finish()).unwrap_or_default()
    }

    /// Whether all frames are of so many nodes and cells.
    fn is_sound(&self, [nodes, cells]: [usize; 2]) -> bool {
        let is_sound = |frame: &Stored| {
            let sizes = self.scalars.iter().map(|scalar| if scalar.at_nodes() { nodes } else { cells });
            frame.positions.len() == nodes
                && frame.gone.iter().all(|&cell| (cell as usize) < cells)
                && frame.values.iter().map(Vec::len).eq(sizes)
                && frame.number < self.added
        };
        self.stride > 0 && self.stored.iter().all(is_sound)
    }

    /// Adds a frame. Keeps positions and the shown scalar in single precision; drops every second kept frame when they get too many.
    pub fn add(&mut self, frame: &Frame) {
        if self.added == 0 {
            self.choose_scalars(frame);
        }
        let first = || frame.positions::<2>().iter().find(|p| p.iter().all(|v| v.is_finite())).copied();
        if self.origin.is_none() {
            self.origin = first();
        }
        let origin = self.origin.unwrap_or_default();
        // The last frame is always kept until another follows.
        if self.stored.last().is_some_and(|last| last.number % self.stride != 0) {
            self.stored.pop();
        }
        let gone = gone(frame);
        self.stored.push(Stored {
            number: self.added,
            time: frame.time,
            positions: self.shown(frame, &gone).map(|p| [(p[0] - origin[0]) as f32, (p[1] - origin[1]) as f32]).collect(),
            gone,
            obstacles: self.line_reader.lines(frame),
            values: self.scalars.iter().map(|scalar| self.values(scalar, frame)).collect(),
        });
        self.added += 1;
        while self.stored.len() > 2
            && (self.stored.len() > STORED_MAX || self.stored.iter().map(Stored::bytes).sum::<usize>() > self.bytes_max)
        {
            self.thin();
        }
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

    /// Positions of the nodes that have a cell; not a number for those whose cells are all `gone`, which fly anywhere.
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

    /// The cells of a frame, where some are gone.
    fn mesh_left(&self, frame: &Stored) -> Option<Mesh> {
        (!frame.gone.is_empty()).then(|| Mesh::without(&self.cells, &frame.gone))
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

    /// Writes `animation.gif` (some seven seconds, repeated, the last frame held) and `final.png` (the last frame) into `folder`; `threads` draw several frames at
    /// once.
    ///
    /// # Errors
    /// [`PictureError::Empty`] without a frame, [`PictureError::Field`] if the wanted field is in no frame, [`PictureError::Io`] and
    /// [`PictureError::Encode`] if a file can't be written.
    pub fn finish(&self, folder: &Path, threads: &Threads) -> Result<(), PictureError> {
        let Some(last) = self.stored.last() else { return Err(PictureError::Empty) };
        if let Some(available) = &self.missing {
            return Err(PictureError::Field { name: self.settings.field.clone(), available: available.clone() });
        }
        let show = self.show();
        let mesh = Mesh::new(&self.cells);
        let notes = self.notes();
        let wide = self.settings.width.min(ANIMATION_WIDTH);
        let high = f64::from(self.settings.height) * f64::from(wide) / f64::from(self.settings.width.max(1));
        self.write_animation(folder, &mesh, &show, &notes, [wide, high.round() as u32], threads)?;
        let show = Show { view: self.view_of(last, &show), ..show };
        let mut scene = self.scene(&show, &notes, [self.settings.width, self.settings.height]);
        let mut canvas = scene.still().clone();
        let mesh = self.mesh_left(last).unwrap_or(mesh);
        scene.draw(&mesh, &self.moment(last, &show, notes.last().map_or("", String::as_str)), &mut canvas);
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
        let mut scene = self.scene(show, notes, size);
        let chosen = evenly(self.stored.len(), SHOWN_MAX);
        let delay = (LENGTH / chosen.len().max(1)).clamp(3, 50) as u16;
        // The first frame decides how parts look.
        let mut canvas = scene.still().clone();
        self.draw(chosen[0], &mut scene, mesh, show, notes, &mut canvas);
        let mut palette = Palette::new(scene.looks());
        let still = palette.indices(scene.still(), None);
        let path = folder.join("animation.gif");
        let rooms = Rooms::default();
        write_whole(&path, |out| {
            let mut animation = Animation::start(out, &canvas, &palette, &path)?;
            for chosen in chosen.chunks(FRAMES_AT_ONCE * threads.count()) {
                let room = || (scene.clone(), canvas.clone(), palette.clone());
                let pictures: Vec<Indices> = threads.map(chosen, &rooms, room, |(scene, canvas, palette), &index| {
                    self.draw(index, scene, mesh, show, notes, canvas);
                    palette.indices(canvas, Some((scene.still(), &still)))
                });
                let delays: Vec<u16> = chosen.iter().map(|index| if index + 1 == self.stored.len() { HOLD } else { delay }).collect();
                animation.frames(pictures, &delays, threads)?;
            }
            Ok(())
        })
    }

    /// Draws a stored frame.
    fn draw(&self, index: usize, scene: &mut Scene, mesh: &Mesh, show: &Show, notes: &[String], canvas: &mut Canvas) {
        let frame = &self.stored[index];
        let left = self.mesh_left(frame);
        scene.draw(left.as_ref().unwrap_or(mesh), &self.moment(frame, show, &notes[index]), canvas);
    }

    fn scene(&self, show: &Show, notes: &[String], size: [u32; 2]) -> Scene {
        let longest = notes.iter().max_by_key(|note| note.chars().count()).map_or("", String::as_str);
        let (title, mirror) = (&self.settings.title, self.settings.mirror);
        Scene::new(&Plan { title, mirror, sides: show.sides, size, view: show.view, key: show.key.clone(), note: longest })
    }

    fn moment<'a>(&'a self, frame: &'a Stored, show: &Show, note: &'a str) -> Moment<'a> {
        let values = match show.scalar.map(|k| (self.scalars[k], &frame.values[k])) {
            None => Values::Plain,
            Some((scalar, values)) if scalar.at_nodes() => Values::Nodes(values, show.range),
            Some((_, values)) => Values::Cells(values, show.range),
        };
        Moment { positions: &frame.positions, origin: self.origin.unwrap_or_default(), obstacles: &frame.obstacles, values, note }
    }

    /// Field, colour range and view for all stored frames.
    fn show(&self) -> Show {
        let all = |k: usize| self.stored.iter().flat_map(move |frame| frame.values[k].iter().copied()).filter(|v| v.is_finite());
        // The first scalar that is not zero throughout; if all are, the last (equivalent stress before plastic strain).
        let scalar = (0..self.scalars.len()).find(|k| all(*k).any(|v| v != 0.0)).or(self.scalars.len().checked_sub(1));
        let sides = self.stored.first().map_or([1.0; 2], |first| view::sides(self.nodes(first)));
        let view = self.settings.view.unwrap_or_else(|| mirrored(self.view(sides), self.settings.mirror));
        let Some(chosen) = scalar else { return Show { scalar, range: [0.0, 1.0], key: Key::Empty, view, sides } };
        let kind = self.scalars[chosen];
        let states = kind.states();
        let (range, beyond) = match states.len().checked_sub(1) {
            Some(last) => ([0.0, last as f64], [false; 2]),
            None => colour_range(all(chosen), kind.starts_at_zero()),
        };
        let si = if self.settings.of_revolution && kind.kind.unit == "N/m" { "N" } else { kind.kind.unit };
        let key = Key::Bar { label: kind.label(), si, range, beyond, states };
        Show { scalar, range, key, view, sides }
    }

    /// Positions of a frame, m.
    fn nodes<'a>(&self, frame: &'a Stored) -> impl ExactSizeIterator<Item = [f64; 2]> + Clone + use<'a> {
        let origin = self.origin.unwrap_or_default();
        frame.positions.iter().map(move |p| [f64::from(p[0]) + origin[0], f64::from(p[1]) + origin[1]])
    }

    /// What is to be seen of the obstacles beside `bodies` in one frame.
    fn obstacles(&self, frame: &Stored, bodies: Extent, sides: [f64; 2]) -> Extent {
        view::obstacles(&frame.obstacles, self.nodes(frame), bodies, view::room(bodies, self.settings.mirror, sides))
    }

    /// Box of all finite positions and of the obstacles near them, m. If single nodes have been thrown far away (a run that failed), they don't count.
    fn view(&self, sides: [f64; 2]) -> Extent {
        let boxes: Vec<_> = self.stored.iter().map(|frame| extent(frame.positions.iter(), 0.0)).collect();
        let union = boxes.iter().copied().reduce(joined).unwrap_or(NOTHING);
        let mut view = union;
        if boxes.first().is_some_and(|first| size(union) > 4.0 * size(*first)) {
            let trimmed = self.stored.iter().map(|frame| extent(frame.positions.iter(), 0.005)).reduce(joined).unwrap_or(union);
            if size(union) > 3.0 * size(trimmed) {
                view = trimmed;
            }
        }
        let origin = self.origin.unwrap_or_default();
        let bodies = view.map(|corner| [corner[0] + origin[0], corner[1] + origin[1]]);
        self.stored.iter().map(|frame| self.obstacles(frame, bodies, sides)).fold(bodies, joined)
    }

    /// Box of the bodies in one frame and of the obstacles near them, m, within the film's view: a still picture needs no room for where they were. A view that was asked for stays.
    fn view_of(&self, frame: &Stored, show: &Show) -> Extent {
        if let Some(view) = self.settings.view {
            return view;
        }
        let whole = show.view;
        let origin = self.origin.unwrap_or_default();
        let own = extent(frame.positions.iter(), 0.0).map(|corner| [corner[0] + origin[0], corner[1] + origin[1]]);
        let own = joined(own, self.obstacles(frame, own, show.sides));
        let [low, high] = mirrored(own, self.settings.mirror);
        let kept = [[0, 1].map(|k| low[k].max(whole[0][k])), [0, 1].map(|k| high[k].min(whole[1][k]))];
        if (0..2).all(|k| kept[0][k] <= kept[1][k]) { kept } else { whole }
    }

    /// `t = 3.10 ms` for each stored frame, with the decimals that tell them apart.
    fn notes(&self) -> Vec<String> {
        let last = self.stored.iter().map(|frame| frame.time.abs()).filter(|t| t.is_finite()).fold(0.0, f64::max);
        let unit = unit("s", last);
        let interval = last * unit.factor / (self.stored.len().max(2) - 1) as f64;
        let digits = if interval > 0.0 { (1.0 - interval.log10().floor()).clamp(0.0, 4.0) as i32 } else { 0 };
        let step = 10f64.powi(-digits);
        debug_assert_eq!(decimals(step), digits as usize);
        self.stored.iter().map(|frame| format!("t = {} {}", number(frame.time * unit.factor, step), unit.name)).collect()
    }
}

/// Cells that were eroded, ascending.
fn gone(frame: &Frame) -> Vec<u32> {
    let Some(alive) = frame.fields.iter().find(|field| field.kind.name == "alive") else { return Vec::new() };
    (0..).zip(&alive.values).filter(|(_, alive)| **alive == 0.0).map(|(cell, _)| cell).collect()
}

/// Range of the colour map, and whether values lie below or above it. Single peaks far above everything else don't set the range.
fn colour_range(values: impl Iterator<Item = f32> + Clone, from_zero: bool) -> ([f64; 2], [bool; 2]) {
    const SAMPLES: usize = 400_000;
    let count = values.clone().count();
    let mut sorted: Vec<f32> = values.clone().step_by(count.div_ceil(SAMPLES).max(1)).collect();
    if sorted.is_empty() {
        return ([0.0, 1.0], [false; 2]);
    }
    sorted.sort_unstable_by(f32::total_cmp);
    let at = |share: f64| f64::from(sorted[((sorted.len() - 1) as f64 * share).round() as usize]);
    let (least, most) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(f64::from(v)), b.max(f64::from(v))));
    let (calm_low, calm_high) = (at(0.002), at(0.998));
    let spread = calm_high - if from_zero { 0.0 } else { calm_low };
    let mut low = if from_zero || (least >= 0.0 && least < 0.5 * most) { 0.0 } else { least };
    let mut high = most;
    if spread > 0.0 {
        if most > calm_high + 0.6 * spread {
            high = calm_high;
        }
        if low < 0.0 && least < calm_low - 0.6 * spread {
            low = calm_low;
        }
    }
    if high - low <= 1e-9 * high.abs().max(low.abs()) {
        // One value throughout: the range has it in the middle, or starts at zero.
        let half = if low == 0.0 { 1.0 } else { 0.5 * low.abs() };
        return if from_zero && low >= 0.0 { ([0.0, high.max(low) + half], [false; 2]) } else { ([low - half, low + half], [false; 2]) };
    }
    ([low, high], [least < low, most > high])
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
    fn shown_frames_are_spread_evenly() {
        assert_eq!(evenly(4, 10), [0, 1, 2, 3]);
        let shown = evenly(400, 160);
        assert_eq!((shown.len(), shown[0], shown[159]), (160, 0, 399));
        assert!(shown.windows(2).all(|w| (2..=3).contains(&(w[1] - w[0]))));
    }

    #[test]
    fn one_peak_does_not_set_the_colour_range() {
        let values = (0..1000).map(|k| k as f32 * 1e5).chain([1e12]);
        let (range, beyond) = colour_range(values, true);
        assert!(range[0] == 0.0 && (0.9e8..1.01e8).contains(&range[1]), "{range:?}");
        assert_eq!(beyond, [false, true]);
        assert_eq!(colour_range([0.1f32, 0.2, 0.3].into_iter(), true).1, [false, false]);
    }

    #[test]
    fn a_constant_or_empty_field_has_a_range() {
        for (values, zero) in [(vec![], true), (vec![0.0f32], true), (vec![5.0; 9], false), (vec![-5.0; 9], false), (vec![5.0; 9], true)] {
            let ([low, high], _) = colour_range(values.iter().copied(), zero);
            assert!(low < high, "{values:?}");
        }
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
        let mut film = Film::new(Cells::default(), FilmSettings { mirror: [true, false], ..FilmSettings::default() });
        film.add(&frame(0.0, 9.0));
        film.add(&frame(1.0, 2.0));
        let show = film.show();
        let whole = show.view;
        assert_eq!(whole, [[-10.0, 0.0], [10.0, 1.0]]);
        assert_eq!(film.view_of(&film.stored[1], &show), [[-3.0, 0.0], [3.0, 1.0]]);
        film.add(&frame(2.0, f64::NAN));
        assert_eq!(film.view_of(&film.stored[2], &show), whole, "nothing to be seen: the whole view");
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
