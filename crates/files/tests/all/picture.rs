//! Pictures of a made-up impact: half a ring presses into half a plate, mirrored at x = 0. Pixels are sampled
//! where bodies must be and where they must not; files are read back by other decoders' eyes (frame count,
//! sizes).
#![allow(clippy::unwrap_used)] // what tests call may stop a test like the tests themselves

use embate_files::picture::{Film, FilmSettings, PictureError, mesh_png, plots};
use embate_files::threads::Threads;
use embate_solver::output::{CellKind, Cells, Field, Frame, Outline, field_kind};
use std::f64::consts::PI;
use std::fs;
use std::path::{Path, PathBuf};

/// A fresh folder for one test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("picture").join(name);
    let _ = fs::remove_dir_all(&folder);
    folder
}

/// A grid of quadrilaterals appended to `cells`.
fn append_grid(cells: &mut Cells, part: u32, first: u32, columns: u32, rows: u32) {
    if cells.offsets.is_empty() {
        cells.offsets.push(0);
    }
    for column in 0..columns {
        for row in 0..rows {
            let node = |c: u32, r: u32| first + c * (rows + 1) + r;
            cells.nodes.extend([node(column, row), node(column + 1, row), node(column + 1, row + 1), node(column, row + 1)]);
            cells.offsets.push(cells.nodes.len() as u32);
            cells.kinds.push(CellKind::Quadrilateral);
            cells.parts.push(part);
        }
    }
}

const RING: (u32, u32) = (60, 4);
const PLATE: (u32, u32) = (110, 5);

fn cells() -> Cells {
    let mut cells = Cells { part_names: vec!["tube".into(), "plate".into()], ..Cells::default() };
    append_grid(&mut cells, 0, 0, RING.0, RING.1);
    append_grid(&mut cells, 1, (RING.0 + 1) * (RING.1 + 1), PLATE.0, PLATE.1);
    cells
}

/// The state at `t` from 0 to 1.
fn state(t: f64) -> Frame {
    let mut positions = Vec::new();
    let sink = 0.06 * t;
    let squeeze = 1.0 - 0.25 * t;
    for c in 0..=RING.0 {
        let angle = -0.5 * PI + PI * f64::from(c) / f64::from(RING.0);
        for r in 0..=RING.1 {
            let radius = 0.080 + 0.020 * f64::from(r) / f64::from(RING.1);
            let y = 0.100 + radius * angle.sin();
            positions.push([radius * angle.cos() * (1.0 + 0.15 * t), y * squeeze - sink]);
        }
    }
    // The plate's upper side: a dent, pushed down wherever the ring would stand in it.
    let ring_bottom = |x: f64| {
        let share = 1.0 - (x / (0.1 + 0.015 * t)).powi(2);
        if share > 0.05 { 0.1 * squeeze * (1.0 - share.sqrt()) - sink } else { f64::MAX }
    };
    let bend = |x: f64| (-sink * (-(x / 0.11).powi(2)).exp()).min(ring_bottom(x));
    for c in 0..=PLATE.0 {
        let x = 0.3 * f64::from(c) / f64::from(PLATE.0);
        positions.extend((0..=PLATE.1).map(|r| [x, bend(x) - 0.020 + 0.020 * f64::from(r) / f64::from(PLATE.1)]));
    }
    let cells = cells();
    let strain = (0..cells.len()).map(|k| {
        let nodes = cells.cell(k);
        let mean = |axis: usize| nodes.iter().map(|n| positions[*n as usize][axis]).sum::<f64>() / 4.0;
        let (x, y) = (mean(0), mean(1));
        t * 0.24 * (-((x / 0.07).powi(2) + ((y + sink) / 0.05).powi(2))).exp() * (0.8 + 0.2 * (60.0 * y).sin())
    });
    let fields = vec![
        Field { kind: field_kind("velocity").unwrap(), values: positions.iter().flat_map(|p| [50.0 * p[0], -50.0 * (1.0 - t)]).collect() },
        Field { kind: field_kind("von_mises").unwrap(), values: vec![2e8; cells.len()] },
        Field { kind: field_kind("plastic_strain").unwrap(), values: strain.collect() },
    ];
    Frame { time: 0.01 * t, fields, ..Frame::of(&positions) }
}

fn settings() -> FilmSettings {
    FilmSettings { title: "Tube against plate".into(), mirror: [true, false, false], ..FilmSettings::default() }
}

fn film(settings: FilmSettings, frames: usize) -> Film {
    let mut film = Film::new(cells(), settings);
    for k in 0..frames {
        film.add(&state(k as f64 / (frames.max(2) - 1) as f64));
    }
    film
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
        assert_eq!(info.color_type, png::ColorType::Rgb);
        Self { width: info.width as usize, height: info.height as usize, pixels }
    }
    fn at(&self, x: usize, y: usize) -> [u8; 3] {
        let k = 3 * (y * self.width + x);
        [self.pixels[k], self.pixels[k + 1], self.pixels[k + 2]]
    }
    fn is_coloured(&self, x: usize, y: usize) -> bool {
        let c = self.at(x, y);
        c.iter().max().unwrap() - c.iter().min().unwrap() > 30
    }
    /// Columns of row `y` left of the colour bar that show a body.
    fn body_columns(&self, y: usize) -> Vec<usize> {
        (0..self.width * 9 / 10).filter(|x| self.is_coloured(*x, y)).collect()
    }
}

#[test]
fn bodies_are_where_they_belong_and_the_background_is_white() {
    let folder = folder("scene");
    film(settings(), 21).finish(&folder, &Threads::one()).unwrap();
    let picture = Picture::read(&folder.join("final.png"));
    assert_eq!(picture.width, 960);
    assert!((300..=720).contains(&picture.height), "{}", picture.height);
    for (x, y) in [(2, 2), (957, picture.height - 3), (2, picture.height - 3)] {
        assert_eq!(picture.at(x, y), [255; 3]);
    }
    // Rows from top to bottom: background, then the ring's top as one piece, its two walls, at last the
    // plate's full width.
    let rows: Vec<Vec<usize>> = (60..picture.height - 60).map(|y| picture.body_columns(y)).collect();
    let body: Vec<&Vec<usize>> = rows.iter().filter(|columns| columns.len() > 40).collect();
    assert!(body.len() > 100, "{} rows show bodies", body.len());
    let widest = body.iter().map(|c| c.len()).max().unwrap();
    assert!(widest > 150, "{widest}");
    // Mirror images: each row's columns are symmetric about the same axis, within a pixel.
    let middle = |c: &[usize]| 0.5 * (c[0] + c[c.len() - 1]) as f64;
    let axis = middle(body[body.len() / 2]);
    for columns in &body {
        assert!((middle(columns) - axis).abs() <= 1.5, "{} against {axis}", middle(columns));
    }
    // Half way up the ring there is nothing between its walls.
    let hollow = body.iter().filter(|c| c.len() < 80 && c[c.len() - 1] - c[0] > 200).count();
    assert!(hollow > 30, "{hollow} rows show the ring's inside");
}

#[test]
fn a_view_that_is_asked_for_is_shown_and_nothing_beside_it() {
    let folder = folder("view");
    // Inside the plate, which fills all of it at the end; and a place without bodies.
    for (view, is_there) in [([[0.19, -0.018], [0.24, -0.008]], true), ([[5.0, 5.0], [5.1, 5.1]], false)] {
        film(FilmSettings { view: Some(view), ..settings() }, 3).finish(&folder, &Threads::one()).unwrap();
        let picture = Picture::read(&folder.join("final.png"));
        let widest = (60..picture.height - 60).map(|y| picture.body_columns(y).len()).max().unwrap();
        assert_eq!(widest > picture.width * 4 / 5, is_there, "{widest} of {} columns", picture.width);
        assert!(is_there || widest == 0, "{widest}");
    }
}

#[test]
fn the_animation_has_all_frames_and_a_reasonable_size() {
    let folder = folder("animation");
    film(settings(), 12).finish(&folder, &Threads::one()).unwrap();
    let bytes = fs::read(folder.join("animation.gif")).unwrap();
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(&bytes[..]).unwrap();
    assert_eq!((decoder.width(), decoder.repeat()), (640, gif::Repeat::Infinite));
    let mut delays = Vec::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        delays.push(frame.delay);
    }
    assert_eq!(delays.len(), 12);
    assert_eq!((delays[0], delays[11]), (50, 150));
    assert!(bytes.len() < 12 * 40_000, "{} bytes", bytes.len());
    assert!(fs::read_dir(&folder).unwrap().all(|file| !file.unwrap().file_name().to_string_lossy().ends_with(".part")));
}

#[test]
fn a_long_run_gives_a_film_of_bearable_length() {
    let folder = folder("long");
    film(FilmSettings { width: 300, height: 200, ..settings() }, 500).finish(&folder, &Threads::one()).unwrap();
    let mut decoder = gif::DecodeOptions::new().read_info(fs::File::open(folder.join("animation.gif")).unwrap()).unwrap();
    let (mut count, mut length) = (0, 0);
    while let Some(frame) = decoder.next_frame_info().unwrap() {
        count += 1;
        length += u32::from(frame.delay);
    }
    assert!((80..=200).contains(&count), "{count} frames");
    assert!((400..=950).contains(&length), "{length} hundredths of a second");
}

#[test]
fn an_unknown_field_is_named_with_those_that_would_do() {
    let error =
        film(FilmSettings { field: "temperature".into(), ..settings() }, 2).finish(&folder("unknown"), &Threads::one()).unwrap_err();
    assert!(matches!(error, PictureError::Field { .. }));
    let text = error.to_string();
    assert!(text.contains("temperature") && text.contains("velocity, von_mises, plastic_strain"), "{text}");
    assert!(matches!(Film::new(cells(), settings()).finish(&folder("none"), &Threads::one()), Err(PictureError::Empty)));
}

#[test]
fn vectors_and_components_can_be_shown() {
    for field in ["velocity", "velocity.y", "von_mises"] {
        let folder = folder(&format!("field-{field}"));
        film(FilmSettings { field: field.into(), width: 480, height: 360, ..settings() }, 3).finish(&folder, &Threads::one()).unwrap();
        assert_eq!(Picture::read(&folder.join("final.png")).width, 480);
    }
}

/// A line around a point, from the angle `start` on, by `turn` in `count` steps; closed.
fn arc(centre: [f64; 2], radius: f64, start: f64, turn: f64, count: u32) -> Vec<[f64; 2]> {
    let at = |k: u32| start + turn * f64::from(k % count) / f64::from(count);
    (0..=count).map(|k| [centre[0] + radius * at(k).cos(), centre[1] + radius * at(k).sin()]).collect()
}

/// Obstacles at `t` from 0 to 1: a floor without end, a slope beside it, a rolling solid, a box that holds
/// everything, an open channel, the rigid wall at x = 0.
fn outlines(t: f64) -> Vec<Outline> {
    let named = |name: &str, points: Vec<[f64; 2]>| Outline::line(name, points);
    let tight = vec![[0.20, 0.16], [0.23, 0.06], [0.24, 0.16], [0.27, 0.06], [0.31, 0.06], [0.31, 0.16]];
    vec![
        named("floor", vec![[-9.0, -0.1], [9.0, -0.1]]),
        named("slope", vec![[-9.0, 5.1], [9.0, -5.1]].into_iter().map(|p: [f64; 2]| [p[0] + 0.1, p[1] - 0.1]).collect()),
        named("roller", arc([0.25 - 0.1 * t, -0.06], 0.03, -2.0 * t, -2.0 * PI, 48)),
        named("box", vec![[-0.4, -0.2], [0.4, -0.2], [0.4, 0.35], [-0.4, 0.35], [-0.4, -0.2]]),
        named("channel", tight),
        named("ball", arc([0.0, 0.28], 0.04, 0.0, -2.0 * PI, 6)),
        named("wall", vec![[0.0, -9.0], [0.0, 9.0]]),
    ]
}

#[test]
fn obstacles_are_seen_on_their_solid_side_in_film_and_picture() {
    for (name, mirror) in [("whole", [false; 3]), ("mirrored", [true, false, false])] {
        let folder = folder(&format!("obstacles-{name}"));
        let mut film = Film::new(cells(), FilmSettings { mirror, ..settings() });
        for k in 0..=10 {
            let t = f64::from(k) / 10.0;
            film.add(&Frame { outlines: outlines(t), ..state(t) });
        }
        film.finish(&folder, &Threads::one()).unwrap();
        let picture = Picture::read(&folder.join("final.png"));
        let middle = picture.body_columns(picture.height / 2);
        assert!(!middle.is_empty(), "bodies are still seen");
        mesh_png(&Frame { outlines: outlines(0.0), ..state(0.0) }, &cells(), &settings(), &folder.join("mesh.png")).unwrap();
    }
}

#[test]
fn a_floor_under_the_bodies_is_a_line_from_border_to_border() {
    let folder = folder("floor");
    let mut film = Film::new(cells(), settings());
    let floor = Outline::line("floor", [[-1e4, -0.1], [1e4, -0.1]]);
    film.add(&Frame { outlines: vec![floor], ..state(0.0) });
    film.finish(&folder, &Threads::one()).unwrap();
    let picture = Picture::read(&folder.join("final.png"));
    let dark = |y: usize| (0..picture.width).filter(|x| picture.at(*x, y).iter().all(|c| *c < 80)).count();
    let line = (0..picture.height).rev().find(|y| dark(*y) > picture.width * 7 / 10).expect("a dark line across the plot");
    let body = (0..picture.height).rev().find(|y| picture.body_columns(*y).len() > 100).unwrap();
    assert!(line > body, "the floor at {line} lies below the bodies, which end at {body}");
    let grey = |y: usize| (0..picture.width).filter(|x| picture.at(*x, y).iter().all(|c| *c < 250)).count();
    assert!(grey(line + 5) > picture.width * 7 / 10, "its solid side");
    assert!(grey(line - 5) < picture.width / 10, "its free side");
}

#[test]
fn a_field_of_the_surface_is_seen_where_it_has_values() {
    for (field, value) in [("contact_gap", 1e-3), ("contact_status", 2.0), ("contact_pressure", 1e6)] {
        let folder = folder(&format!("field-{field}"));
        let mut frame = state(1.0);
        let upper = |k: usize| k < 305 && k % 5 == 4;
        let values =
            (0..frame.positions::<2>().len()).map(|k| if upper(k) { value * (1.0 + (k / 5) as f64 % 2.0) * 0.5 } else { f64::NAN });
        frame.fields.push(Field { kind: field_kind(field).unwrap(), values: values.collect() });
        let mut film = Film::new(cells(), FilmSettings { field: field.into(), ..settings() });
        film.add(&frame);
        film.finish(&folder, &Threads::one()).unwrap();
        let picture = Picture::read(&folder.join("final.png"));
        let coloured = (60..picture.height - 60).map(|y| picture.body_columns(y).len()).sum::<usize>();
        let plain = (0..picture.height).flat_map(|y| (0..picture.width).map(move |x| (x, y)));
        let plain = plain.filter(|(x, y)| picture.at(*x, *y) == [178, 184, 192]).count();
        assert!(coloured > 1000 && plain > 1000, "{field}: {coloured} pixels with a value, {plain} without");
    }
}

#[test]
fn rigid_parts_have_no_colour_of_elements_but_that_of_their_nodes() {
    let pixels = |name: &str, field: &str, rigid: Vec<bool>| {
        let folder = folder(name);
        film(FilmSettings { field: field.into(), rigid, ..settings() }, 3).finish(&folder, &Threads::one()).unwrap();
        let picture = Picture::read(&folder.join("final.png"));
        let all = (0..picture.height).flat_map(|y| (0..picture.width).map(move |x| (x, y)));
        all.filter(|(x, y)| picture.at(*x, *y) == [178, 184, 192]).count()
    };
    assert!(pixels("rigid-none", "plastic_strain", vec![]) < 100);
    let one = pixels("rigid-one", "plastic_strain", vec![false, true]);
    let both = pixels("rigid-both", "plastic_strain", vec![true, true]);
    assert!(one > 1000 && both > one + 1000, "{one} grey pixels with a rigid plate, {both} with a rigid tube too");
    assert!(pixels("rigid-velocity", "velocity", vec![true, true]) < 100, "what moves has a velocity");
}

#[test]
fn strange_frames_give_a_picture_and_no_panic() {
    let frame = |positions: Vec<[f64; 2]>| Frame { time: f64::NAN, ..Frame::of(&positions) };
    let full = state(0.5).positions::<2>().len();
    let one_wrong = |value: f64| {
        let mut frame = state(0.5);
        frame.coordinates[6..8].copy_from_slice(&[value, -value]);
        for field in &mut frame.fields {
            field.values[0] = value;
        }
        frame
    };
    let odd = |points: Vec<[f64; 2]>| Frame { outlines: vec![Outline::line("odd", points)], ..state(0.5) };
    let cases = [
        (
            "obstacles",
            vec![
                odd(vec![]),
                odd(vec![[0.1, 0.1]]),
                odd(vec![[0.1, 0.1]; 5]),
                odd(vec![[f64::NAN, 0.0], [1.0, 1.0]]),
                odd(vec![[-1e300, 0.0], [1e300, 1e300]]),
                odd(vec![[-1e9, 0.0], [1e9, 1.0], [0.0, -1e9], [-1e9, 0.0]]),
            ],
        ),
        ("empty", vec![frame(vec![])]),
        ("nan", vec![frame(vec![[f64::NAN; 2]; full])]),
        ("point", vec![frame(vec![[3.0, 4.0]; full])]),
        ("huge", vec![frame((0..full).map(|k| [1e300 * k as f64, -1e300]).collect())]),
        ("far", vec![frame((0..full).map(|k| [1e12 + k as f64, -1e12]).collect())]),
        ("short", vec![state(0.0), frame(vec![[0.0; 2]; 5]), state(1.0)]),
        ("wrong", vec![state(0.1), one_wrong(f64::NAN), one_wrong(f64::INFINITY), one_wrong(1e30), one_wrong(1e308)]),
    ];
    for (name, frames) in cases {
        for size in [[960, 720], [1, 1], [240, 5000]] {
            let folder = folder(&format!("strange-{name}"));
            let settings = FilmSettings { width: size[0], height: size[1], mirror: [true, true, false], ..settings() };
            let mut film = Film::new(cells(), settings.clone());
            frames.iter().for_each(|frame| film.add(frame));
            film.finish(&folder, &Threads::one()).unwrap_or_else(|e| panic!("{name}: {e}"));
            mesh_png(&frames[0], &cells(), &settings, &folder.join("mesh.png")).unwrap();
        }
    }
}

#[test]
fn the_mesh_picture_shows_every_part_in_its_colour() {
    let folder = folder("mesh");
    mesh_png(&state(0.0), &cells(), &FilmSettings { mirror: [false; 3], ..settings() }, &folder.join("mesh.png")).unwrap();
    let picture = Picture::read(&folder.join("mesh.png"));
    let count = |is: &dyn Fn([u8; 3]) -> bool| {
        (0..picture.height).flat_map(|y| (0..picture.width).map(move |x| (x, y))).filter(|(x, y)| is(picture.at(*x, *y))).count()
    };
    assert!(count(&|c| c[2] > c[0].saturating_add(50)) > 2000, "blue tube");
    assert!(count(&|c| c[0] > c[2].saturating_add(50)) > 2000, "orange plate");
}

/// A history with the columns of a run: two probes, one contact that acts late, one that never acts.
fn history(rows: usize) -> (Vec<String>, Vec<Vec<f64>>) {
    let names = "time energy.kinetic energy.internal energy.plastic energy.contact energy.external energy.total energy.kinetic[tube] A.x A.y A.vx B.x B.y \
                 T.x T.y contact.force_x[impact] contact.force_y[impact] contact.force_x[self] contact.force_y[self]";
    let row = |k: usize| {
        let t = 0.01 * k as f64 / (rows.max(2) - 1) as f64;
        let s = (t / 0.003).min(1.0);
        let kinetic = 61_000.0 * (1.0 - 0.72 * s * s * (3.0 - 2.0 * s)) + 900.0 * (2500.0 * t).sin() * s;
        let plastic = 38_000.0 * s * s * (3.0 - 2.0 * s);
        let contact = 350.0 * (900.0 * t).sin().abs() * (-t / 0.002).exp();
        let internal = 61_000.0 - kinetic - plastic - contact;
        let force =
            if (2e-4..4.2e-3).contains(&t) { 4.1e6 * (t * 800.0).sin().max(0.0) * (1.0 + 0.3 * (k as f64 * 1.7).sin()) } else { 0.0 };
        vec![
            t,
            kinetic,
            internal,
            plastic,
            contact,
            0.0,
            61_000.0 - 20.0 * s,
            30_000.0,
            0.0,
            -0.06 * s + 0.004 * (1500.0 * t).sin(),
            0.0,
            0.0,
            -0.061 * s,
            0.0,
            0.2 - 0.13 * s,
            0.02 * force,
            force,
            0.0,
            0.0,
        ]
    };
    (names.split_whitespace().map(String::from).collect(), (0..rows).map(row).collect())
}

#[test]
fn plots_show_every_energy_probe_and_contact_by_name() {
    let folder = folder("plots");
    let (columns, rows) = history(20_000);
    plots(&columns, &rows, "Tube <against> plate & \"wall\"", false, &folder).unwrap();
    let energy = fs::read_to_string(folder.join("energy.svg")).unwrap();
    for name in
        [">kinetic<", ">internal<", ">plastic<", ">total<", "zero throughout: external", "kJ/m", "time [ms]", "&lt;against&gt; plate &amp;"]
    {
        assert!(energy.contains(name), "{name}");
    }
    assert!(!energy.contains("[tube]"));
    let history = fs::read_to_string(folder.join("history.svg")).unwrap();
    for name in [">A<", ">B<", ">T<", ">impact<", "position y [mm]", "contact force y [MN/m]", "zero throughout: self"] {
        assert!(history.contains(name), "{name}");
    }
    assert!(energy.len() < 250_000 && history.len() < 250_000, "{} {}", energy.len(), history.len());
}

#[test]
fn plots_of_strange_histories_are_sound() {
    let (columns, rows) = history(50);
    let mut gaps = rows.clone();
    for row in &mut gaps[20..30] {
        row[1..].fill(f64::NAN);
    }
    gaps[5][2] = f64::INFINITY;
    gaps[6][2] = 1e308;
    gaps[7][2] = -1e308;
    gaps[40].truncate(3);
    let zeros = vec![vec![0.0; columns.len()]; 9];
    let nans = vec![vec![f64::NAN; columns.len()]; 9];
    let many: Vec<String> =
        std::iter::once("time".to_string()).chain((0..40).map(|k| format!("probe {k} with quite a long name.y"))).collect();
    let many_rows = (0..30).map(|t| (0..41).map(|k| f64::from(t * k) * 1e-3).collect()).collect();
    let cases = [
        ("gaps", columns.clone(), gaps),
        ("zeros", columns.clone(), zeros),
        ("nans", columns.clone(), nans),
        ("one", columns.clone(), rows[30..31].to_vec()),
        ("none", columns.clone(), vec![]),
        ("no columns", vec![], vec![vec![]; 4]),
        ("same time", columns, vec![rows[9].clone(); 3]),
        ("many", many, many_rows),
    ];
    for (name, columns, rows) in cases {
        let folder = folder(&format!("plots-strange-{}", name.replace(' ', "-")));
        plots(&columns, &rows, "", false, &folder).unwrap();
        for file in ["energy.svg", "history.svg"] {
            let text = fs::read_to_string(folder.join(file)).unwrap();
            assert!(!text.contains("NaN") && !text.contains("inf"), "{name}: {file}");
            assert!(text.starts_with("<?xml") && text.ends_with("</svg>\n"), "{name}: {file}");
            assert_eq!(text.matches("<text").count(), text.matches("</text>").count(), "{name}: {file}");
        }
    }
}
