//! Where in a model in 3D something is: all bodies, shaded, with a mark; what veils the place is cut away.
//!
//! Cells and positions come from the simulation of a failed run; layout and legend are those of the 2D
//! picture picture.

use super::drawing::{Colour, Style};
use super::obstacle::Shape;
use super::outlook::{Outlook, Sights, Target};
use super::shot::Shot;
use super::skin::Skinner;
use crate::outline::LineReader;
use crate::picture::body::floats;
use crate::picture::colour;
use crate::picture::film::gone;
use crate::picture::place::Sheet;
use crate::picture::view::{extent, joined, nothing, size};
use embate_solver::model::Camera;
use embate_solver::output::{Cells, Frame};

const BODY: Style = Style { edge: [0.8, 0.3], outline: [1.0, 0.7] };

/// What is looked for.
pub(crate) struct Spot<'a> {
    /// Where it is, m.
    pub(crate) at: [f64; 3],
    /// Places of the nodes of its element, m; empty: it is a node.
    pub(crate) nodes: &'a [[f64; 3]],
    /// What it is called.
    pub(crate) mark: &'a str,
}

/// The picture as the text of an SVG file.
pub(crate) fn place(title: &str, cells: &Cells, frame: &Frame, spot: &Spot<'_>, camera: &Camera) -> String {
    let places = frame.positions::<3>();
    let lost = gone(frame);
    let own = own_cell(cells, places, spot);
    let target = own.map_or_else(|| Target::point(spot.at), |cell| Target::cell(cells, places, cell));
    let outlook = Outlook::best(&[(Sights { cells, places, obstacles: &[] }, target)], camera, &lost);
    let mut left_out = outlook.gone.clone();
    left_out.extend(&lost);
    left_out.sort_unstable();
    left_out.dedup();
    let node = |node: u32| places.get(node as usize).copied().unwrap_or([f64::NAN; 3]);
    let skin = Skinner::new(cells, &node).skin(cells, &left_out);
    let shown: Vec<[f64; 3]> = skin.nodes.iter().map(|&at| node(at)).collect();
    let seen = |x: [f64; 3]| {
        let [right, up, _] = outlook.directions.seen(x);
        [right, up]
    };
    // A few nodes that have flown away don't make all else small.
    let points: Vec<[f32; 2]> = shown.iter().map(|&x| seen(x).map(|v| v as f32)).collect();
    let (all, most) = (extent(points.iter(), 0.0), extent(points.iter(), 0.005));
    let bodies = if size(all) > 2.0 * size(most) { most } else { all };
    let at = seen(spot.at);
    let mut view = joined(bodies, [at, at]);
    if !(size(view) < 4.0 * size(bodies)) {
        view = bodies;
    }
    let mut sheet = Sheet::new(title, view);
    let (corner, [wide, high]) = sheet.plot();
    let mark = sheet.spot(at);
    let from = [0, 1].map(|k| mark[k] - corner[k]);
    let mut shot = Shot::new(outlook.directions, [wide, high], sheet.scale, spot.at, from);
    shot.bodies(&skin, &shown, BODY, |_, facet| Colour::Flat(floats(colour::part(facet.part as usize))));
    for bar in &skin.bars {
        shot.rod(bar.nodes.map(|at| shown[at as usize]), 1.3, colour::part(bar.part as usize));
    }
    let extents = shown.iter().filter(|x| x.iter().all(|v| v.is_finite())).fold(nothing(), |all, &x| joined(all, [x, x]));
    for surface in LineReader::default().surfaces(frame) {
        if let Some(solid) = Shape::of(&surface).solid(&surface.points, extents) {
            shot.obstacle(&solid);
        }
    }
    shot.write(&mut sheet.body, corner);
    shot.cross(&mut sheet.body, [corner[0] + 34.0, corner[1] + high - 34.0]);
    let note = match outlook.gone.len() {
        0 => String::new(),
        1 => "cut open: 1 element before it left out".into(),
        count => format!("cut open: {count} elements before it left out"),
    };
    sheet.finish(title, cells, mark, spot.mark, &note, colour::part)
}

/// The cell that has all these nodes at these places.
fn own_cell(cells: &Cells, places: &[[f64; 3]], spot: &Spot<'_>) -> Option<u32> {
    let is_there = |node: u32| places.get(node as usize).is_some_and(|x| spot.nodes.contains(x));
    let is_own = |&cell: &usize| cells.cell(cell).len() == spot.nodes.len() && cells.cell(cell).iter().all(|&node| is_there(node));
    if spot.nodes.is_empty() { None } else { (0..cells.len()).find(is_own).map(|cell| cell as u32) }
}
