//! Bodies in pixels: filled cells, element edges that fade out where the mesh is dense, outlines. Cells come
//! once from [`Cells`], points and values per frame from `film` or `mesh`; everything is drawn on a
//! [`Layer`].

use super::colour::{self, LEVELS, MAP, NO_VALUE};
use super::raster::{Layer, Shade};
use embate_solver::output::Cells;

/// The cells made ready for drawing.
#[derive(Clone, Debug, Default)]
pub(super) struct Mesh {
    cells: Vec<DrawnCell>,
    edges: Vec<Edge>,
    part_count: usize,
}

#[derive(Clone, Copy, Debug)]
struct DrawnCell {
    /// Nodes around it; the last is given again for those that are missing.
    nodes: [u32; 6],
    /// Number of them.
    corners: u8,
    part: u32,
    /// Index in the frame's cell fields.
    index: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Edge {
    nodes: [u32; 2],
    /// Between a part and whatever is not that part.
    outline: bool,
    /// One of the cells that it belongs to, as index in `cells`.
    cell: u32,
}

/// What the colours of the cells mean.
#[derive(Clone, Copy, Debug)]
pub(super) enum Values<'a> {
    /// One colour for all.
    Plain,
    /// Colour by part.
    Parts,
    /// Values per cell with the range of the map.
    Cells(&'a [f32], [f64; 2]),
    /// Values per node with the range of the map.
    Nodes(&'a [f32], [f64; 2]),
}

/// Lines of one part: strengths (0 to 1) and widths (pixels).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Look {
    pub(super) edge: f32,
    pub(super) edge_width: f32,
    pub(super) outline: f32,
    pub(super) outline_width: f32,
    /// Pixels by which each side of the part is drawn too far out: what is as thin as a hair would not show
    /// its colour.
    pub(super) swell: f32,
}

/// Thinnest drawn body, pixels at the usual font.
const THIN: f32 = 3.4;

impl Mesh {
    /// Takes what is sound: cells whose nodes are listed wrongly are left out.
    pub(super) fn new(cells: &Cells) -> Self {
        Self::without(cells, &[])
    }

    /// The same without some cells (ascending).
    pub(super) fn without(cells: &Cells, gone: &[u32]) -> Self {
        let mut mesh = Self { part_count: cells.part_names.len(), ..Self::default() };
        for (index, range) in cells.offsets.windows(2).enumerate().take(cells.kinds.len()) {
            if gone.binary_search(&(index as u32)).is_ok() {
                continue;
            }
            // Parts beyond any sensible number are a fault elsewhere; here they only must not cost memory.
            let part = cells.parts.get(index).copied().unwrap_or(0).min(cells.kinds.len() as u32);
            let (nodes, corners) = match cells.nodes.get(range[0] as usize..range[1] as usize) {
                Some(&[a, b]) => ([a, b, b, b, b, b], 2),
                Some(&[a, b, c]) => ([a, b, c, c, c, c], 3),
                Some(&[a, b, c, d]) => ([a, b, c, d, d, d], 4),
                Some(&[a, b, c, d, e, f]) => ([a, d, b, e, c, f], 6),
                _ => continue,
            };
            mesh.part_count = mesh.part_count.max(part as usize + 1);
            mesh.cells.push(DrawnCell { nodes, corners, part, index: index as u32 });
        }
        mesh.edges = edges(&mesh.cells);
        mesh
    }

    /// How each part is drawn at these places: thin bodies and small cells would drown in lines.
    pub(super) fn looks(&self, points: &[[f32; 2]], unit: f32) -> Vec<Look> {
        #[derive(Clone, Copy, Default)]
        struct Sums {
            outline: f32,
            area: f32,
            heights: f32,
            count: f32,
        }
        let mut sums = vec![Sums::default(); self.part_count];
        let length = |nodes: [u32; 2]| distance(points, nodes).filter(|l| l.is_finite()).unwrap_or(0.0);
        for edge in self.edges.iter().filter(|e| e.outline) {
            sums[self.cells[edge.cell as usize].part as usize].outline += length(edge.nodes);
        }
        for cell in &self.cells {
            let Some(corners) = corners(points, cell) else { continue };
            let [a, b, c, d, e, f] = corners;
            let area = quad_area(&[a, b, c, d]) + quad_area(&[a, d, e, f]);
            let longest = (0..6).map(|k| length([cell.nodes[k], cell.nodes[(k + 1) % 6]])).fold(0.0, f32::max);
            let sum = &mut sums[cell.part as usize];
            sum.area += area;
            sum.heights += if longest > 0.0 { area / longest } else { 0.0 };
            sum.count += 1.0;
        }
        let rise = |value: f32, from: f32, to: f32| ((value - from) / (to - from)).clamp(0.0, 1.0);
        let look = |sum: &Sums| {
            let height = if sum.count > 0.0 { sum.heights / sum.count } else { 0.0 };
            let thickness = if sum.outline > 0.0 { 2.0 * sum.area / sum.outline } else { 0.0 };
            Look {
                edge: 0.34 * rise(height, 2.5, 9.0),
                edge_width: 0.9 * unit,
                outline: 0.85 * rise(thickness, 1.5, 9.0),
                outline_width: (0.6 + 0.7 * rise(thickness, 1.5, 9.0)) * unit,
                swell: 0.5 * (THIN * unit - thickness).max(0.0),
            }
        };
        sums.iter().map(look).collect()
    }

    /// Draws all cells and lines; `points` are pixels within the layer, not finite where there is nothing to
    /// show. `planes`: x and y at which the body continues in its mirror image; there it has no outline.
    /// `looks`: one per part, as from [`Mesh::looks`].
    pub(super) fn draw(&self, layer: &mut Layer, points: &[[f32; 2]], planes: [Option<f32>; 2], values: Values<'_>, looks: &[Look]) {
        let map: Vec<[f32; 3]> = MAP.iter().map(|c| floats(*c)).collect();
        for cell in &self.cells {
            let Some(corners) = corners(points, cell) else { continue };
            let corners = &corners[..usize::from(cell.corners)];
            if corners.len() == 2 {
                continue; // its edge is all that there is of a bar
            }
            match node_levels(cell, values) {
                Some(levels) => smooth(layer, &map, corners, &levels),
                None => layer.fill(corners, Shade::Flat(cell_colour(cell, values, &map))),
            }
        }
        for edge in &self.edges {
            let cell = &self.cells[edge.cell as usize];
            let look = looks.get(cell.part as usize).copied().unwrap_or_default();
            if !edge.outline && look.edge < 0.02 {
                continue;
            }
            let (Some(a), Some(b)) = (points.get(edge.nodes[0] as usize), points.get(edge.nodes[1] as usize)) else { continue };
            let on = |axis: usize| planes[axis].is_some_and(|plane| (a[axis] - plane).abs() < 0.05 && (b[axis] - plane).abs() < 0.05);
            if !edge.outline || on(0) || on(1) {
                layer.line(*a, *b, look.edge_width, look.edge);
                continue;
            }
            if look.swell > 0.05 {
                layer.stroke(*a, *b, 2.0 * look.swell, Shade::Flat(cell_colour(cell, values, &map)));
            }
            layer.line(*a, *b, look.outline_width, look.outline);
        }
    }

    /// Number of cells that can be drawn.
    pub(super) fn len(&self) -> usize {
        self.cells.len()
    }
}

/// Levels at the corners, where values live at nodes. Some fields have values on the surface alone: a cell
/// with a side there shows them through to its other side, so that they can be seen; a cell without such a
/// side has no levels.
fn node_levels(cell: &DrawnCell, values: Values<'_>) -> Option<[f32; 6]> {
    let Values::Nodes(values, range) = values else { return None };
    let count = usize::from(cell.corners);
    let known = cell.nodes.map(|node| values.get(node as usize).and_then(|v| level(*v, range)));
    let has_side = (0..count).any(|k| known[k].is_some() && known[(k + 1) % count].is_some());
    let through = |k: usize| -> Option<f32> {
        let beside = [known[(k + 1) % count], known[(k + count - 1) % count]];
        match beside {
            [Some(a), Some(b)] => Some(0.5 * (a + b)),
            [a, b] => a.or(b),
        }
    };
    let mut levels = [0.0; 6];
    for (k, found) in levels[..count].iter_mut().enumerate() {
        *found = known[k].or_else(|| through(k)).filter(|_| has_side)?;
    }
    Some(levels)
}

/// One colour for the whole cell.
fn cell_colour(cell: &DrawnCell, values: Values<'_>, map: &[[f32; 3]]) -> [f32; 3] {
    let level = match values {
        Values::Parts => return floats(colour::part(cell.part as usize)),
        Values::Plain => None,
        Values::Cells(values, range) => values.get(cell.index as usize).and_then(|v| level(*v, range)),
        Values::Nodes(..) => node_levels(cell, values).map(|levels| levels.iter().sum::<f32>() / f32::from(cell.corners)),
    };
    level.map_or(floats(NO_VALUE), |level| map[(level + 0.5) as usize])
}

/// Every edge once. An edge of one cell, or between two parts, belongs to the outline.
fn edges(cells: &[DrawnCell]) -> Vec<Edge> {
    let mut sides: Vec<([u32; 2], u32)> = Vec::with_capacity(4 * cells.len());
    for (index, cell) in cells.iter().enumerate() {
        let corners = usize::from(cell.corners);
        for k in 0..if corners == 2 { 1 } else { corners } {
            let (a, b) = (cell.nodes[k], cell.nodes[(k + 1) % corners]);
            sides.push(([a.min(b), a.max(b)], index as u32));
        }
    }
    sides.sort_unstable();
    let part = |side: &([u32; 2], u32)| cells[side.1 as usize].part;
    let edge = |same: &[([u32; 2], u32)]| Edge {
        nodes: same[0].0,
        outline: same.len() == 1 || same.iter().any(|side| part(side) != part(&same[0])),
        cell: same[0].1,
    };
    sides.chunk_by(|a, b| a.0 == b.0).map(edge).collect()
}

fn corners(points: &[[f32; 2]], cell: &DrawnCell) -> Option<[[f32; 2]; 6]> {
    let mut corners = [[0.0; 2]; 6];
    for (corner, node) in corners.iter_mut().zip(cell.nodes) {
        *corner = *points.get(node as usize)?;
        if !(corner[0].is_finite() && corner[1].is_finite()) {
            return None;
        }
    }
    Some(corners)
}

fn distance(points: &[[f32; 2]], nodes: [u32; 2]) -> Option<f32> {
    let (a, b) = (points.get(nodes[0] as usize)?, points.get(nodes[1] as usize)?);
    Some((a[0] - b[0]).hypot(a[1] - b[1]))
}

fn quad_area(c: &[[f32; 2]; 4]) -> f32 {
    (0.5 * ((c[2][0] - c[0][0]) * (c[3][1] - c[1][1]) - (c[2][1] - c[0][1]) * (c[3][0] - c[1][0]))).abs()
}

pub(super) fn floats(colour: colour::Rgb) -> [f32; 3] {
    colour.map(f32::from)
}

/// Position in the map; none for NaN.
pub(super) fn level(value: f32, range: [f64; 2]) -> Option<f32> {
    let level = (f64::from(value) - range[0]) / (range[1] - range[0]) * (LEVELS - 1) as f64;
    (!level.is_nan()).then(|| level.clamp(0.0, (LEVELS - 1) as f64) as f32)
}

/// Fills a cell whose colour varies linearly from corner to corner: a triangle as it is, others as triangles
/// around their middle.
fn smooth(layer: &mut Layer, map: &[[f32; 3]], corners: &[[f32; 2]], levels: &[f32; 6]) {
    let count = corners.len();
    if count == 3 {
        return triangle(layer, map, [corners[0], corners[1], corners[2]], [levels[0], levels[1], levels[2]]);
    }
    let share = 1.0 / count as f32;
    let middle = [corners.iter().map(|p| p[0]).sum::<f32>() * share, corners.iter().map(|p| p[1]).sum::<f32>() * share];
    let level = levels[..count].iter().sum::<f32>() * share;
    for k in 0..count {
        let next = (k + 1) % count;
        triangle(layer, map, [corners[k], corners[next], middle], [levels[k], levels[next], level]);
    }
}

fn triangle(layer: &mut Layer, map: &[[f32; 3]], p: [[f32; 2]; 3], levels: [f32; 3]) {
    let (u, v) = ([p[1][0] - p[0][0], p[1][1] - p[0][1]], [p[2][0] - p[0][0], p[2][1] - p[0][1]]);
    let twice_area = u[0] * v[1] - u[1] * v[0];
    let (low, high) = (levels.iter().copied().fold(f32::MAX, f32::min), levels.iter().copied().fold(0.0, f32::max));
    if twice_area.abs() < 1e-3 || high - low < 0.5 {
        let mean = (levels[0] + levels[1] + levels[2]) / 3.0;
        return layer.fill(&p, Shade::Flat(map[(mean + 0.5) as usize]));
    }
    let (du, dv) = (levels[1] - levels[0], levels[2] - levels[0]);
    let along = [(du * v[1] - dv * u[1]) / twice_area, (dv * u[0] - du * v[0]) / twice_area];
    let at = levels[0] - along[0] * p[0][0] - along[1] * p[0][1];
    layer.fill(&p, Shade::Gradient { map, at: at + 0.5, along, low, high: high + 0.5 });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::raster::Canvas;
    use embate_solver::output::CellKind;

    fn two_quads(parts: [u32; 2]) -> Mesh {
        Mesh::new(&Cells {
            nodes: vec![0, 1, 4, 3, 1, 2, 5, 4],
            offsets: vec![0, 4, 8],
            kinds: vec![CellKind::Quadrilateral; 2],
            parts: parts.to_vec(),
            part_names: vec!["a".into(), "b".into()],
            revision: 0,
        })
    }

    #[test]
    fn the_edge_between_two_cells_is_inside_unless_parts_differ() {
        assert_eq!(two_quads([0, 0]).edges.iter().filter(|e| !e.outline).map(|e| e.nodes).collect::<Vec<_>>(), [[1, 4]]);
        assert!(two_quads([0, 1]).edges.iter().all(|e| e.outline));
    }

    #[test]
    fn cells_with_wrong_lists_are_left_out() {
        let cells = Cells { nodes: vec![0, 1, 2], offsets: vec![0, 3, 9, 2], kinds: vec![CellKind::Triangle; 3], ..Cells::default() };
        assert_eq!(Mesh::new(&cells).len(), 1);
        let mut layer = Layer::new(4, 4);
        let looks = [Look { edge: 1.0, edge_width: 1.0, outline: 1.0, outline_width: 1.0, swell: 1.0 }];
        Mesh::new(&cells).draw(&mut layer, &[[0.0, 0.0]], [None; 2], Values::Parts, &looks);
    }

    #[test]
    fn values_of_the_surface_are_seen_and_cells_inside_stay_plain() {
        let mesh = two_quads([0, 0]);
        let nan = f32::NAN;
        let levels = |values: [f32; 6]| {
            let values = Values::Nodes(&values, [0.0, 255.0]);
            [0, 1].map(|k| node_levels(&mesh.cells[k], values))
        };
        // Cells 0 1 4 3 and 1 2 5 4.
        assert_eq!(levels([10.0, 20.0, nan, nan, nan, nan]), [Some([10.0, 20.0, 20.0, 10.0, 0.0, 0.0]), None]);
        assert_eq!(levels([nan, 20.0, 30.0, nan, nan, 50.0]), [None, Some([20.0, 30.0, 50.0, 35.0, 0.0, 0.0])]);
        assert_eq!(levels([nan; 6]), [None, None]);
    }

    #[test]
    fn node_values_run_smoothly_through_a_cell() {
        let mesh = two_quads([0, 0]);
        let points = [[0.0, 0.0], [20.0, 0.0], [40.0, 0.0], [0.0, 10.0], [20.0, 10.0], [40.0, 10.0]];
        let values = [0.0, 0.5, 1.0, 0.0, 0.5, 1.0];
        let mut layer = Layer::new(40, 10);
        mesh.draw(&mut layer, &points, [None; 2], Values::Nodes(&values, [0.0, 1.0]), &[]);
        let mut canvas = Canvas::new(40, 10);
        layer.compose(&mut canvas, 0, 0);
        for x in [3usize, 12, 22, 36] {
            let wanted = MAP[((x as f64 + 0.5) / 40.0 * 255.0).round() as usize];
            for k in 0..3 {
                assert!(
                    canvas.pixels[5 * 40 + x][k].abs_diff(wanted[k]) < 6,
                    "x = {x}: {:?} against {wanted:?}",
                    canvas.pixels[5 * 40 + x]
                );
            }
        }
    }
}
