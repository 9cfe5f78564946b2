//! Pictures of models in 3D: a bent bar of hexahedra, a ball of tetrahedra, two tubes that cross,
//! obstacles. Pixels are sampled where a body must be seen and where another hides it.
#![allow(clippy::unwrap_used)] // what tests call may stop a test like the tests themselves

use embate_files::picture::{Film, FilmSettings, mesh_png};
use embate_files::threads::Threads;
use embate_solver::model::Camera;
use embate_solver::output::{CellKind, Cells, Field, Frame, Outline, fields_of};
use std::f64::consts::PI;
use std::fs;
use std::path::{Path, PathBuf};

/// A fresh folder for one test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("picture-space").join(name);
    let _ = fs::remove_dir_all(&folder);
    folder
}

/// Bodies that are put together from mapped blocks.
#[derive(Clone, Default)]
struct Bodies {
    cells: Cells,
    places: Vec<[f64; 3]>,
}

impl Bodies {
    /// A block of `[nx, ny, nz]` cells, its nodes at `map` of coordinates from 0 to 1. Where the first and
    /// the last plane of `y` are to be the same, `closed`.
    fn block(mut self, name: &str, [nx, ny, nz]: [usize; 3], closed: bool, kind: CellKind, map: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        let part = self.cells.part_names.len() as u32;
        self.cells.part_names.push(name.into());
        if self.cells.offsets.is_empty() {
            self.cells.offsets.push(0);
        }
        let first = self.places.len();
        let rows = if closed { ny } else { ny + 1 };
        for k in 0..=nz {
            for j in 0..rows {
                self.places.extend((0..=nx).map(|i| map([i as f64 / nx as f64, j as f64 / ny as f64, k as f64 / nz as f64])));
            }
        }
        let node = |i: usize, j: usize, k: usize| (first + i + (nx + 1) * (j % rows + rows * k)) as u32;
        for (i, j, k) in (0..nz).flat_map(|k| (0..ny).flat_map(move |j| (0..nx).map(move |i| (i, j, k)))) {
            let layer = |k: usize| [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)];
            let corners = [layer(k), layer(k + 1)].concat();
            let pieces: Vec<Vec<usize>> = match kind {
                CellKind::Wedge => vec![vec![0, 1, 2, 4, 5, 6], vec![0, 2, 3, 4, 6, 7]],
                // Around the diagonal from 0 to 6.
                CellKind::Tetrahedron => [[1, 2], [2, 3], [3, 7], [7, 4], [4, 5], [5, 1]].map(|[a, b]| vec![0, a, b, 6]).into(),
                _ => vec![(0..8).collect()],
            };
            for piece in pieces {
                self.cells.nodes.extend(piece.iter().map(|corner| corners[*corner]));
                self.cells.offsets.push(self.cells.nodes.len() as u32);
                self.cells.kinds.push(kind);
                self.cells.parts.push(part);
            }
        }
        self
    }

    fn frame(&self) -> Frame {
        Frame::of(&self.places)
    }

    /// A frame with a field of cells that is this function of their middles.
    fn coloured(&self, field: &str, value: impl Fn([f64; 3]) -> f64) -> Frame {
        let middle = |cell: usize| {
            let nodes = self.cells.cell(cell);
            [0, 1, 2].map(|k| nodes.iter().map(|node| self.places[*node as usize][k]).sum::<f64>() / nodes.len() as f64)
        };
        let values = (0..self.cells.len()).map(|cell| value(middle(cell))).collect();
        Frame { fields: vec![Field { kind: kind(field), values }], ..self.frame() }
    }
}

fn kind(name: &str) -> &'static embate_solver::output::FieldKind {
    fields_of(3).iter().find(|kind| kind.name == name).unwrap()
}

/// A bar along x, bent upwards by `t` of a half circle.
fn bar(cells: [usize; 3], t: f64) -> Bodies {
    let map = move |[x, y, z]: [f64; 3]| {
        let (angle, z) = (t * PI * (x - 0.5), 0.1 * (z - 0.5));
        let radius = 0.6 / (t * PI);
        [(radius - z) * angle.sin(), 0.14 * (y - 0.5), radius - (radius - z) * angle.cos()]
    };
    Bodies::default().block("bar", cells, false, CellKind::Hexahedron, map)
}

/// A ball of tetrahedra: a cube, its layers blown up to spheres.
fn ball(cells: usize, radius: f64, centre: [f64; 3]) -> Bodies {
    let map = move |x: [f64; 3]| {
        let x = x.map(|v| 2.0 * v - 1.0);
        let most = x.iter().fold(0.0f64, |m, v| m.max(v.abs()));
        let length = x.iter().map(|v| v * v).sum::<f64>().sqrt().max(1e-12);
        [0, 1, 2].map(|k| centre[k] + radius * most * x[k] / length)
    };
    Bodies::default().block("ball", [cells; 3], false, CellKind::Tetrahedron, map)
}

/// Two tubes that cross; the upper one, along x, is pressed into the lower one by `t`.
fn tubes(t: f64, fine: usize) -> Bodies {
    let tube = move |centre: f64, along: usize, press: f64| {
        move |[r, a, l]: [f64; 3]| {
            let (radius, angle) = (0.045 + 0.005 * r, 2.0 * PI * a);
            let l = 0.4 * (l - 0.5);
            let flat = press * (-(l / 0.06).powi(2)).exp();
            let (u, w) = (radius * angle.cos() * (1.0 + 0.5 * flat), radius * angle.sin() * (1.0 - 0.6 * flat));
            let sag = 0.06 * flat * if centre > 0.0 { 0.6 } else { -0.6 };
            if along == 0 { [l, u, centre + w - sag] } else { [-u, l, centre + w - sag] }
        }
    };
    Bodies::default().block("upper", [2, 12 * fine, 24 * fine], true, CellKind::Hexahedron, tube(0.052, 0, t)).block(
        "lower",
        [2, 12 * fine, 24 * fine],
        true,
        CellKind::Hexahedron,
        tube(-0.052, 1, t),
    )
}

/// A ball of facets.
fn globe(radius: f64, centre: [f64; 3]) -> Outline {
    let (rings, slices) = (24, 48);
    let at = |ring: u32, slice: u32| {
        let (polar, angle) = (PI * f64::from(ring) / 24.0, 2.0 * PI * f64::from(slice) / 48.0);
        [polar.sin() * angle.cos(), polar.sin() * angle.sin(), polar.cos()]
    };
    let points = (0..=rings).flat_map(|ring| (0..slices).map(move |slice| at(ring, slice)));
    let points = points.map(|p| [0, 1, 2].map(|k| centre[k] + radius * p[k])).collect();
    let node = |ring: u32, slice: u32| ring * slices + slice % slices;
    let facets = (0..rings).flat_map(|r| (0..slices).map(move |s| [node(r, s), node(r + 1, s), node(r + 1, s + 1), node(r, s + 1)]));
    Outline { name: "globe".into(), points, facets: facets.collect(), is_gone: false }
}

/// A plane z = `height` without end.
fn floor(height: f64) -> Outline {
    let points = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| [1e4 * x, 1e4 * y, height]).into();
    Outline { name: "floor".into(), points, facets: vec![[0, 1, 2, 3]], is_gone: false }
}

fn settings(title: &str) -> FilmSettings {
    FilmSettings { title: title.into(), ..FilmSettings::default() }
}

fn write(cells: &Cells, settings: FilmSettings, frames: &[Frame], folder: &Path) {
    let mut film = Film::new(cells.clone(), settings);
    frames.iter().for_each(|frame| film.add(frame));
    film.finish(folder, &Threads::new(2)).unwrap();
}

struct Picture {
    width: usize,
    height: usize,
    pixels: Vec<u8>,
}

impl Picture {
    fn read(path: &Path) -> Self {
        let mut reader = png::Decoder::new(std::io::BufReader::new(fs::File::open(path).unwrap())).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        Self { width: info.width as usize, height: info.height as usize, pixels }
    }

    /// The last picture of an animation, frame laid over frame.
    fn last_of(path: &Path) -> Self {
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::RGBA);
        let mut decoder = options.read_info(fs::File::open(path).unwrap()).unwrap();
        let (width, height) = (usize::from(decoder.width()), usize::from(decoder.height()));
        let mut pixels = vec![0; 3 * width * height];
        while let Some(frame) = decoder.read_next_frame().unwrap() {
            let (left, top, wide) = (usize::from(frame.left), usize::from(frame.top), usize::from(frame.width));
            for (k, pixel) in frame.buffer.chunks_exact(4).enumerate().filter(|(_, pixel)| pixel[3] > 0) {
                let place = 3 * ((top + k / wide) * width + left + k % wide);
                pixels[place..place + 3].copy_from_slice(&pixel[..3]);
            }
        }
        Self { width, height, pixels }
    }

    fn at(&self, x: usize, y: usize) -> [u8; 3] {
        let k = 3 * (y * self.width + x);
        [self.pixels[k], self.pixels[k + 1], self.pixels[k + 2]]
    }

    /// How many pixels of the plot have a colour that is so.
    fn count(&self, is_so: impl Fn([u8; 3]) -> bool) -> usize {
        (80..self.height - 90).flat_map(|y| (30..840).map(move |x| (x, y))).filter(|&(x, y)| is_so(self.at(x, y))).count()
    }
}

/// How saturated a colour is: greys are 0.
fn saturation(colour: [u8; 3]) -> u8 {
    colour.iter().max().unwrap() - colour.iter().min().unwrap()
}

fn is_blue([r, g, b]: [u8; 3]) -> bool {
    b > r.saturating_add(40) && b > g
}

fn is_orange([r, g, b]: [u8; 3]) -> bool {
    r > b.saturating_add(40) && r > g
}

/// A cube of one hexahedron.
fn cube(bodies: Bodies, name: &str, corner: [f64; 3], size: f64) -> Bodies {
    bodies.block(name, [1; 3], false, CellKind::Hexahedron, move |x| [0, 1, 2].map(|k| corner[k] + size * x[k]))
}

fn from_the_front() -> Camera {
    Camera { from: [0.0, -1.0, 0.0], ..Camera::default() }
}

fn mesh_picture(bodies: &Bodies, settings: &FilmSettings, name: &str) -> Picture {
    let path = folder(name).join("mesh.png");
    mesh_png(&bodies.frame(), &bodies.cells, settings, &path).unwrap();
    Picture::read(&path)
}

#[test]
fn a_body_behind_another_is_not_seen() {
    // A small one, and a larger one that stands before it or behind it.
    for (y, hidden) in [(-3.0, true), (3.0, false)] {
        let bodies = cube(cube(Bodies::default(), "small", [-0.5, 0.0, 0.0], 1.0), "large", [-1.0, y, -0.5], 2.0);
        let picture = mesh_picture(&bodies, &FilmSettings { camera: from_the_front(), ..settings("Hidden") }, &format!("hidden-{hidden}"));
        assert_eq!(picture.count(is_blue) < 10, hidden);
        assert!(picture.count(is_orange) > 10_000);
        let behind = mesh_picture(
            &bodies,
            &FilmSettings { camera: Camera { from: [0.0, 1.0, 0.0], ..Camera::default() }, ..settings("Behind") },
            "behind",
        );
        assert_eq!(behind.count(is_blue) < 10, !hidden, "from behind it is the other way round");
    }
}

#[test]
fn three_sides_of_a_cube_are_seen_the_upper_one_the_brightest() {
    let picture = mesh_picture(&cube(Bodies::default(), "cube", [0.0; 3], 1.0), &settings("Cube"), "cube");
    // Columns of the picture where the middles of the sides are: from the left below, the front, the upper
    // and the right side.
    let body: Vec<(usize, usize)> =
        (80..picture.height - 90).flat_map(|y| (30..840).map(move |x| (x, y))).filter(|&(x, y)| is_blue(picture.at(x, y))).collect();
    let mut shades: Vec<([u8; 3], usize, [usize; 2])> = Vec::new();
    for (x, y) in body {
        let colour = picture.at(x, y);
        match shades.iter_mut().find(|(known, ..)| *known == colour) {
            Some((_, count, sums)) => (*count, *sums) = (*count + 1, [sums[0] + x, sums[1] + y]),
            None => shades.push((colour, 1, [x, y])),
        }
    }
    shades.retain(|(_, count, _)| *count > 2000);
    shades.sort_by_key(|(colour, ..)| std::cmp::Reverse(colour.map(u32::from).iter().sum::<u32>()));
    let middles: Vec<[usize; 2]> = shades.iter().map(|(_, count, sums)| sums.map(|sum| sum / count)).collect();
    let [top, front, right] = middles[..] else { panic!("{shades:?}") };
    assert!(top[1] < front[1] && top[1] < right[1] && front[0] < right[0], "{middles:?}");
}

#[test]
fn colours_of_cells_and_of_nodes_are_where_they_belong() {
    let bar = Bodies::default().block("bar", [20, 4, 4], false, CellKind::Hexahedron, |[x, y, z]| [x, 0.2 * y, 0.2 * z]);
    let of_cells = bar.coloured("von_mises", |x| 1e8 * x[0]);
    let velocity = bar.places.iter().flat_map(|x| [x[0], 0.0, 0.0]).collect();
    let of_nodes = Frame { fields: vec![Field { kind: kind("velocity"), values: velocity }], ..bar.frame() };
    for (name, frame) in [("cells", of_cells), ("nodes", of_nodes)] {
        for (side, camera) in [1.0, -1.0].map(|side| (side, Camera { from: [0.0, -side, 0.0], ..Camera::default() })) {
            let folder = folder(&format!("colours-{name}-{side}"));
            write(&bar.cells, FilmSettings { camera, ..settings("Colours") }, std::slice::from_ref(&frame), &folder);
            for picture in [Picture::read(&folder.join("final.png")), Picture::last_of(&folder.join("animation.gif"))] {
                let row = picture.height * 4 / 10;
                let coloured: Vec<usize> = (20..picture.width * 8 / 10).filter(|&x| saturation(picture.at(x, row)) > 40).collect();
                let (first, last) = (coloured[0], coloured[coloured.len() - 1]);
                let brightness = |share: usize| {
                    let [r, g, b] = picture.at(first + (last - first) * share / 100, row).map(u32::from);
                    2126 * r + 7152 * g + 722 * b
                };
                // Low values are dark; from behind the bar is seen the other way round.
                let along: Vec<u32> = [8, 28, 52, 72, 92].map(brightness).into();
                let rises = along.windows(2).all(|w| w[0] < w[1]);
                let falls = along.windows(2).all(|w| w[0] > w[1]);
                assert!(if side > 0.0 { rises } else { falls }, "{name} {side}: {along:?}");
            }
        }
    }
}

#[test]
fn the_bytes_are_the_same_twice_and_with_any_number_of_threads() {
    let frames: Vec<Frame> = (0..6)
        .map(|k| Frame { time: f64::from(k), ..tubes(0.2 * f64::from(k), 1).coloured("plastic_strain", |x| x[0].abs()) })
        .map(|frame| Frame { outlines: vec![floor(-0.11), globe(0.04, [0.0, 0.0, 0.2])], ..frame })
        .collect();
    let cells = tubes(0.0, 1).cells;
    let files = |threads: usize| {
        let folder = folder(&format!("bytes-{threads}"));
        let mut film = Film::new(cells.clone(), settings("Tubes"));
        frames.iter().for_each(|frame| film.add(frame));
        film.finish(&folder, &Threads::new(threads)).unwrap();
        ["final.png", "animation.gif"].map(|name| fs::read(folder.join(name)).unwrap())
    };
    let alone = files(1);
    assert!([1, 2, 3].into_iter().all(|threads| files(threads) == alone));
}

#[test]
fn what_was_eroded_lets_be_seen_what_is_behind_it() {
    // A plate before a block of another part; the middle of the plate goes.
    let plate = Bodies::default().block("plate", [9, 1, 9], false, CellKind::Hexahedron, |[x, y, z]| [x, 0.1 * y, z]);
    let bodies = cube(plate, "block", [0.2, 0.4, 0.2], 0.6);
    let colour = |gone: bool| {
        let alive = (0..bodies.cells.len()).map(|cell| f64::from(u8::from(!(gone && cell == 40)))).collect();
        let stress = (0..bodies.cells.len()).map(|cell| if cell == 81 { 1e8 } else { 0.0 }).collect();
        let fields = vec![Field { kind: kind("von_mises"), values: stress }, Field { kind: kind("alive"), values: alive }];
        let folder = folder(&format!("eroded-{gone}"));
        let field = "von_mises".to_string();
        write(
            &bodies.cells,
            FilmSettings { field, camera: from_the_front(), ..settings("Eroded") },
            &[Frame { fields, ..bodies.frame() }],
            &folder,
        );
        Picture::read(&folder.join("final.png"))
    };
    let yellow = |picture: &Picture| picture.count(|[r, g, b]| r > 150 && g > 150 && b < 120);
    assert_eq!(yellow(&colour(false)), 0);
    assert!(yellow(&colour(true)) > 1000);
}

#[test]
fn the_mirror_image_joins_the_model_and_the_cut_between_them_is_not_seen() {
    let half = Bodies::default().block("block", [4, 4, 4], false, CellKind::Wedge, |[x, y, z]| [0.5 * x, y, z]);
    let whole = Bodies::default().block("block", [8, 4, 4], false, CellKind::Wedge, |[x, y, z]| [x - 0.5, y, z]);
    let front = || FilmSettings { camera: from_the_front(), ..settings("Block") };
    let mirrored = mesh_picture(&half, &FilmSettings { mirror: [true, false, false], ..front() }, "half");
    let whole = mesh_picture(&whole, &front(), "whole");
    // Titles and numbers of elements differ; the front of the block does not, but for rounding.
    let differ = (90..mirrored.height - 90).flat_map(|y| (20..700).map(move |x| (x, y)));
    let differ = differ.filter(|&(x, y)| (0..3).any(|k| mirrored.at(x, y)[k].abs_diff(whole.at(x, y)[k]) > 12)).count();
    assert!(differ < 30, "{differ} pixels");
}

#[test]
fn a_floor_and_a_globe_are_grey_and_bodies_are_seen_through_what_is_before_them() {
    let ball = ball(6, 1.0, [0.0; 3]);
    let picture = |name: &str, outlines: Vec<Outline>| {
        let path = folder(name).join("mesh.png");
        mesh_png(&Frame { outlines, ..ball.frame() }, &ball.cells, &settings("Ball"), &path).unwrap();
        Picture::read(&path)
    };
    let grey = |picture: &Picture| picture.count(|colour| colour[0] > 100 && colour[0] < 235 && saturation(colour) < 14);
    let alone = grey(&picture("alone", vec![]));
    let on_floor = grey(&picture("floor", vec![floor(-1.05)]));
    let under_globe = grey(&picture("globe", vec![globe(0.5, [0.0, 0.0, 1.5])]));
    assert!(on_floor > alone + 20_000 && under_globe > alone + 10_000, "{alone}, {on_floor}, {under_globe}");
    // A globe between the ball and the camera: blue shines through.
    let veiled = picture("veiled", vec![globe(0.5, [0.9, -1.5, 0.75])]);
    let through = veiled.count(|colour| is_blue(colour) && colour[0] > 120);
    assert!(through > 5_000, "{through}");
}

#[test]
fn one_that_flies_away_does_not_shrink_the_picture_and_the_camera_may_come_near() {
    let bar = bar([40, 8, 6], 0.5);
    let coloured = |settings: FilmSettings, frames: &[Frame], name: &str| {
        let folder = folder(name);
        write(&bar.cells, settings, frames, &folder);
        Picture::read(&folder.join("final.png")).count(|colour| saturation(colour) > 30)
    };
    let frame = bar.coloured("von_mises", |x| 1e8 + x[0]);
    let mut thrown = frame.clone();
    thrown.coordinates[0..3].copy_from_slice(&[1e7, -1e7, 1e7]);
    let usual = coloured(settings("Bar"), std::slice::from_ref(&frame), "usual");
    assert!(coloured(settings("Bar"), &[frame.clone(), thrown], "thrown") > usual / 2);
    let near = FilmSettings { camera: Camera { zoom: 2.0, ..Camera::default() }, ..settings("Bar") };
    assert!(coloured(near, std::slice::from_ref(&frame), "near") > usual * 14 / 10);
}
