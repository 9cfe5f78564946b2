//! The neighbourhood of a failure location in 3D at a few times: shaded elements with their numbers, what
//! veils the failure location cut away.
//!
//! Elements and times come from a trace, as in 2D, whose layout and legend this takes; `outlook`
//! chooses the direction, `shot` draws the bodies.

use super::camera::Directions;
use super::drawing::{Colour, Style};
use super::obstacle::Shape;
use super::outlook::{Outlook, Sights, Target};
use super::shot::Shot;
use super::sides::{corners, is_sound, sides_of};
use super::skin::{Skin, Skinner};
use crate::outline::{LineReader, Surface, cross, dot};
use crate::picture::body::floats;
use crate::picture::colour::{BORDER, DISTINCT, TEXT, TEXT_FAINT, WHITE};
use crate::picture::neighbourhood::{
    CULPRIT, FOUND, Label, Legend, NAME, Panel, air, arrow, common, fitted, laid_out, name, name_width, path, swatch, width_of,
    write_labels,
};
use crate::picture::svg::{hex, write_text};
use crate::picture::view::{joined, nothing};
use embate_solver::model::Camera;
use embate_solver::output::{Cells, Frame};
use embate_solver::post_mortem::{Moment, Neighbourhood};
use std::fmt::Write;

/// Facets have no lines but those of their parts.
const PLAIN: Style = Style { edge: [1.0, 0.0], outline: [1.0, 0.0] };
/// Half the thickness of lines of elements and of the failure location, pixels.
const LINE: f64 = 0.55;
const CULPRIT_LINE: f64 = 1.9;
/// Numbers and forces are shown where nothing is nearer by more than this, pixels.
const LIFT: f64 = 4.0;

/// The picture as the text of an SVG file; `mark` is what the failure location is called in it, `depth` the
/// unit of forces. `frame`: the model where it failed.
pub(crate) fn neighbourhood(
    title: &str,
    near: &Neighbourhood,
    panels: &[Panel<'_>],
    (mark, depth): (&str, &str),
    camera: &Camera,
    frame: &Frame,
) -> String {
    let scene = Scene::new(near, panels, camera, frame);
    let mut more = Vec::new();
    if !scene.outlook.gone.is_empty() {
        let count = scene.outlook.gone.len();
        let what = format!("cut open: {count} element{} before it left out", if count == 1 { "" } else { "s" });
        more.push((swatch(BORDER, WHITE, 1.0), what));
    }
    laid_out(
        title,
        panels.len(),
        scene.size,
        |out, k, corner| scene.panel(out, &panels[k], corner, k, mark),
        |out, corner, width| scene.legend.write(out, corner, width, (mark, depth), more),
    )
}

/// What all panels share.
struct Scene<'a> {
    near: &'a Neighbourhood,
    cells: Cells,
    skin: Skin,
    outlook: Outlook,
    /// Width and height of a panel, pixels; middle of what is shown, from the failure location, m; pixels for
    /// a metre.
    size: [f64; 2],
    middle: [f64; 2],
    scale: f64,
    legend: Legend<'a>,
    /// Obstacles of each panel.
    surfaces: Vec<Vec<Surface>>,
}

/// The elements as cells of their own nodes.
fn cells(near: &Neighbourhood) -> Cells {
    let mut cells = Cells { offsets: vec![0], part_names: near.part_names.clone(), ..Cells::default() };
    for cell in &near.cells {
        cells.nodes.extend(cell.nodes.iter().map(|&node| node as u32));
        cells.offsets.push(cells.nodes.len() as u32);
        cells.parts.push(cell.part as u32);
        cells.kinds.push(cell.kind);
    }
    cells
}

fn is_finite(x: [f64; 3]) -> bool {
    x.iter().all(|v| v.is_finite())
}

/// Triangles of obstacles.
fn triangles(surfaces: &[Surface]) -> Vec<[[f64; 3]; 3]> {
    let of = |surface: &Surface, corners: [u32; 3]| {
        let place = |corner: u32| surface.points.get(corner as usize).copied().unwrap_or([f64::NAN; 3]);
        corners.map(place)
    };
    let both = |surface: &Surface, [a, b, c, d]: [u32; 4]| [of(surface, [a, b, c]), of(surface, [a, c, d])];
    surfaces.iter().flat_map(|surface| surface.facets.iter().flat_map(move |&facet| both(surface, facet))).collect()
}

impl<'a> Scene<'a> {
    fn new(near: &'a Neighbourhood, panels: &[Panel<'_>], camera: &Camera, frame: &Frame) -> Self {
        let cells = cells(near);
        // What is far without end is reported by the whole model.
        let mut reader = LineReader::default();
        reader.surfaces(frame);
        let surfaces: Vec<Vec<Surface>> = panels
            .iter()
            .map(|panel| reader.surfaces(&Frame { outlines: panel.moment.outlines.clone(), ..Frame::of::<3>(&panel.moment.positions) }))
            .collect();
        let before: Vec<_> = surfaces.iter().map(|surfaces| triangles(surfaces)).collect();
        let looks: Vec<_> = panels
            .iter()
            .zip(&before)
            .map(|(panel, obstacles)| {
                let places = &panel.moment.positions[..];
                let target = match (near.node, near.element) {
                    (None, Some(element)) => Target::cell(&cells, places, element as u32),
                    _ => Target::point(centre(near, panel.moment)),
                };
                (Sights { cells: &cells, places, obstacles }, target)
            })
            .collect();
        let outlook = Outlook::best(&looks, camera, &[]);
        drop(looks);
        let first = panels.first().map(|panel| &panel.moment.positions[..]).unwrap_or_default();
        let place = |node: u32| first.get(node as usize).copied().unwrap_or([f64::NAN; 3]);
        let skin = Skinner::new(&cells, &place).skin(&cells, &outlook.gone);
        let reach = |panel: &Panel<'_>| {
            let centre = centre(near, panel.moment);
            let is_shown = |k: usize| near.cells[k].ring.is_some() && outlook.gone.binary_search(&(k as u32)).is_err();
            let nodes = (0..near.cells.len()).filter(|&k| is_shown(k)).flat_map(|k| &near.cells[k].nodes);
            let far = nodes.map(|&node| panel.moment.positions[node]).filter(|&x| is_finite(x));
            far.fold([[0.0; 2]; 2], |[low, high]: [[f64; 2]; 2], x| {
                let [right, up, _] = outlook.directions.seen([0, 1, 2].map(|k| x[k] - centre[k]));
                [[low[0].min(right), low[1].min(up)], [high[0].max(right), high[1].max(up)]]
            })
        };
        let view = common(&panels.iter().map(reach).collect::<Vec<_>>());
        let (size, middle, scale) = fitted(view, air(near), width_of(panels.len()));
        let legend = Legend::new(near, panels, |f| dot(*f, *f).sqrt());
        Self { near, cells, skin, outlook, size, middle, scale, legend, surfaces }
    }

    fn panel(&self, out: &mut String, panel: &Panel<'_>, corner: [f64; 2], number: usize, mark: &str) {
        let moment = panel.moment;
        let ([wide, high], [left, top]) = (self.size, corner);
        let at = [0.5 * wide - self.scale * self.middle[0], NAME + 0.5 * (high - NAME) + self.scale * self.middle[1]];
        let mut shot = Shot::new(self.outlook.directions, self.size, self.scale, centre(self.near, moment), at);
        self.draw(&mut shot, moment, &self.surfaces[number]);
        write_text(out, &panel.title, [left, top - 10.0], "start", TEXT, " font-weight=\"bold\"");
        write_text(out, &panel.remark, [left + wide, top - 10.0], "end", TEXT_FAINT, "");
        let _ = writeln!(out, "<clipPath id=\"c{number}\"><rect x=\"{left}\" y=\"{top}\" width=\"{wide}\" height=\"{high}\"/></clipPath>");
        let _ = writeln!(out, "<g clip-path=\"url(#c{number})\">");
        shot.write(out, corner);
        let spot = |x: [f64; 3]| {
            let [x, y] = shot.spot(x);
            [left + x, top + y]
        };
        self.labels(out, &shot, moment, &spot);
        self.forces(out, &shot, moment, &spot);
        self.mark(out, moment, corner, &spot, mark);
        shot.cross(out, [left + 34.0, top + high - 34.0]);
        out.push_str("</g>\n");
        let _ =
            writeln!(out, "<rect x=\"{left}\" y=\"{top}\" width=\"{wide}\" height=\"{high}\" fill=\"none\" stroke=\"{}\"/>", hex(BORDER));
    }

    /// Bodies with the lines of their parts, the failure location's last; obstacles.
    fn draw(&self, shot: &mut Shot, moment: &Moment, surfaces: &[Surface]) {
        let place = |node: u32| moment.positions[node as usize];
        let places: Vec<[f64; 3]> = self.skin.nodes.iter().map(|&node| place(node)).collect();
        let value = |cell: u32| moment.values.get(cell as usize).copied().unwrap_or(f64::NAN);
        let is_ring = |cell: u32| self.near.cells[cell as usize].ring.is_some();
        shot.bodies(&self.skin, &places, PLAIN, |_, facet| Colour::Flat(floats(self.legend.fill(value(facet.cell), is_ring(facet.cell)))));
        for edge in &self.skin.edges {
            let part = self.skin.facets[edge.facets[0] as usize].part as usize;
            shot.rod(edge.nodes.map(|node| places[node as usize]), LINE, DISTINCT[part % DISTINCT.len()]);
        }
        for bar in &self.skin.bars {
            shot.rod(bar.nodes.map(|node| places[node as usize]), 2.0 * LINE + 1.0, self.legend.fill(value(bar.cell), is_ring(bar.cell)));
        }
        for ends in self.failure_location_edges() {
            shot.rod(ends.map(place), CULPRIT_LINE, CULPRIT);
        }
        let bodies = moment.positions.iter().filter(|&&x| is_finite(x)).fold(nothing(), |all, &x| joined(all, [x, x]));
        for surface in surfaces {
            if let Some(solid) = Shape::of(surface).solid(&surface.points, bodies) {
                shot.obstacle(&solid);
            }
        }
    }

    /// Edges of the failure location's element.
    fn failure_location_edges(&self) -> Vec<[u32; 2]> {
        let Some(element) = self.near.element else { return Vec::new() };
        if !is_sound(&self.cells, element) {
            return Vec::new();
        }
        let mut edges: Vec<[u32; 2]> = match sides_of(self.cells.kinds[element]) {
            [] => vec![[self.cells.cell(element)[0], self.cells.cell(element)[1]]],
            sides => sides
                .iter()
                .map(|side| corners(&self.cells, element, side))
                .flat_map(|c| [0, 1, 2, 3].map(|k| [c[k].min(c[(k + 1) % 4]), c[k].max(c[(k + 1) % 4])]))
                .filter(|[a, b]| a != b)
                .collect(),
        };
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// The number of each element that hangs together with the failure location on that of its facets which
    /// is seen best.
    fn labels(&self, out: &mut String, shot: &Shot, moment: &Moment, spot: &impl Fn([f64; 3]) -> [f64; 2]) {
        let mut best: Vec<Option<(f64, usize)>> = vec![None; self.near.cells.len()];
        for (index, facet) in self.skin.facets.iter().enumerate() {
            let places = facet.corners.map(|corner| moment.positions[self.skin.nodes[corner as usize] as usize]);
            let count = facet.corners().len() as f64;
            let middle = [0, 1, 2].map(|k| facet.corners().iter().zip(&places).map(|(_, x)| x[k]).sum::<f64>() / count);
            let is_ring = self.near.cells[facet.cell as usize].ring.is_some();
            if !(is_ring && places.iter().all(|&x| is_finite(x)) && shot.is_seen(middle, LIFT)) {
                continue;
            }
            let size = area(&places, &self.outlook.directions);
            let own = &mut best[facet.cell as usize];
            if own.is_none_or(|(most, _)| size > most) {
                *own = Some((size, index));
            }
        }
        let label = |cell: usize| {
            let (_, index) = best[cell]?;
            let facet = &self.skin.facets[index];
            let points: Vec<[f64; 2]> =
                facet.corners().iter().map(|&corner| spot(moment.positions[self.skin.nodes[corner as usize] as usize])).collect();
            let fill = self.legend.fill(moment.values.get(cell).copied().unwrap_or(f64::NAN), self.near.cells[cell].ring.is_some());
            Label::of(&points, self.near.cells[cell].element.to_string(), fill, self.near.element == Some(cell))
        };
        write_labels(out, (0..self.near.cells.len()).filter_map(label));
    }

    /// Contact forces, as they are seen, on nodes that are.
    fn forces(&self, out: &mut String, shot: &Shot, moment: &Moment, spot: &impl Fn([f64; 3]) -> [f64; 2]) {
        let colour = hex(DISTINCT[3]);
        let most = self.legend.force;
        for node in &self.skin.nodes {
            let (x, force) = (moment.positions[*node as usize], moment.forces[*node as usize]);
            let size = dot(force, force).sqrt();
            if most <= 0.0 || !size.is_finite() || size < 0.02 * most || !is_finite(x) || !shot.is_seen(x, LIFT) {
                continue;
            }
            let [right, up, _] = self.outlook.directions.seen(force);
            let seen = right.hypot(up);
            // One that points at the viewer has no length to be seen.
            if seen > 0.1 * size {
                arrow(out, spot(x), [right / seen, -up / seen], (12.0 + 50.0 * size / most) * seen / size, &colour);
            }
        }
    }

    /// The failure location's name in a corner; a ring around its node, a line to what is small.
    fn mark(&self, out: &mut String, moment: &Moment, [left, top]: [f64; 2], spot: &impl Fn([f64; 3]) -> [f64; 2], mark: &str) {
        let colour = hex(CULPRIT);
        if let Some(x) = self.near.node.map(|node| moment.positions[node]).filter(|&x| is_finite(x)) {
            let [x, y] = spot(x);
            let _ = writeln!(out, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"7\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"3.5\"/>");
        }
        let corner = [left + 10.0, top + 10.0];
        if self.near.node.is_none() && self.least(moment, spot) < FOUND {
            let line = path(&[[corner[0] + 0.5 * name_width(mark), corner[1] + 22.0], spot(centre(self.near, moment))], false);
            let _ = writeln!(out, "<path d=\"{line}\" stroke=\"{colour}\" stroke-width=\"1.5\"/>");
        }
        name(out, mark, corner);
    }

    /// The smaller side of the box around the failure location's element, pixels.
    fn least(&self, moment: &Moment, spot: &impl Fn([f64; 3]) -> [f64; 2]) -> f64 {
        let nodes = self.near.element.map_or(&[][..], |element| &self.near.cells[element].nodes);
        let all: Vec<[f64; 2]> = nodes.iter().map(|&node| spot(moment.positions[node])).collect();
        let side =
            |k: usize| all.iter().map(|x| x[k]).fold(f64::NEG_INFINITY, f64::max) - all.iter().map(|x| x[k]).fold(f64::INFINITY, f64::min);
        side(0).min(side(1))
    }
}

/// Area of a facet as it is seen; none of what is seen from behind.
fn area([a, b, c, d]: &[[f64; 3]; 4], directions: &Directions) -> f64 {
    let minus = |a: &[f64; 3], b: &[f64; 3]| [0, 1, 2].map(|k| a[k] - b[k]);
    0.5 * dot(cross(minus(c, a), minus(d, b)), directions.towards).max(0.0)
}

/// Middle of a panel: the failure location's node, or the mean of its element's.
fn centre(near: &Neighbourhood, moment: &Moment) -> [f64; 3] {
    let of_node = near.node.map(|node| vec![node]);
    let nodes = of_node.or_else(|| near.element.map(|element| near.cells[element].nodes.clone())).unwrap_or_default();
    let mean = |places: Vec<[f64; 3]>| {
        let sum = places.iter().fold([0.0; 3], |sum, x| [0, 1, 2].map(|k| sum[k] + x[k]));
        sum.map(|v| v / places.len().max(1) as f64)
    };
    let own: Vec<[f64; 3]> = nodes.iter().map(|&node| moment.positions[node]).filter(|&x| is_finite(x)).collect();
    // Where the failure location is nowhere any more: the mean of what is left.
    if own.is_empty() { mean(moment.positions.iter().copied().filter(|&x| is_finite(x)).collect()) } else { mean(own) }
}
