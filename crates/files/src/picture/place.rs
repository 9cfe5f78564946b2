//! Where in the model something is, as SVG: the outlines of all parts, the obstacles near them, and a mark.
//!
//! Cells and positions come from the simulation of a failed run; the text goes to a file of its post-mortem.

use super::colour::{BORDER, DISTINCT, Rgb, TEXT, TEXT_FAINT, WHITE, mix};
use super::neighbourhood::{CULPRIT, document, name, name_width, path};
use super::scale::{ticks, unit};
use super::svg::{hex, write_text};
use super::text::{self, Weight};
use super::view::{extent, joined, size};
use embate_solver::output::{Cells, Outline};
use std::collections::BTreeMap;
use std::fmt::Write;

const WIDTH: f64 = 760.0;
const HEIGHT_MOST: f64 = 620.0;
const AIR: f64 = 24.0;

/// The picture as the text of an SVG file.
pub(crate) fn place(title: &str, cells: &Cells, positions: &[[f64; 2]], outlines: &[Outline], at: [f64; 2], mark: &str) -> String {
    let points: Vec<[f32; 2]> = positions.iter().map(|x| x.map(|v| v as f32)).collect();
    // A few nodes that have flown away don't make all else small.
    let all = extent(points.iter(), 0.0);
    let most = extent(points.iter(), 0.005);
    let bodies = if size(all) > 2.0 * size(most) { most } else { all };
    let mut view = joined(bodies, [at, at]);
    if !(size(view) < 4.0 * size(bodies)) {
        view = bodies;
    }
    let mut sheet = Sheet::new(title, view);
    let spot = |x: [f64; 2]| sheet.spot(x);
    let mut body = String::new();
    for outline in outlines.iter().filter(|outline| !outline.is_gone) {
        let points: Vec<[f64; 2]> = outline.points.iter().map(|&[x, y, _]| spot([x, y])).collect();
        let _ = writeln!(body, "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"4\"/>", path(&points, false), hex(BORDER));
    }
    for (part, loops) in loops(cells) {
        let colour = DISTINCT[part % DISTINCT.len()];
        let is_there = |nodes: &&Vec<u32>| nodes.iter().all(|&node| positions[node as usize].iter().all(|v| v.is_finite()));
        let whole: String = loops
            .iter()
            .filter(is_there)
            .map(|nodes| path(&nodes.iter().map(|&node| spot(positions[node as usize])).collect::<Vec<_>>(), true))
            .collect();
        let _ = writeln!(
            body,
            "<path d=\"{whole}\" fill=\"{}\" fill-rule=\"evenodd\" stroke=\"{}\" stroke-width=\"1\"/>",
            hex(mix(WHITE, colour, 0.35)),
            hex(colour)
        );
    }
    let at = spot(at);
    sheet.body += &body;
    sheet.finish(title, cells, at, mark, "", |part| mix(WHITE, DISTINCT[part % DISTINCT.len()], 0.35))
}

/// A picture of a place: a plot with a title, a mark, a scale and the names of parts.
pub(super) struct Sheet {
    pub(super) body: String,
    /// Pixels for a metre.
    pub(super) scale: f64,
    /// Middle of what is shown, m, and its longer side.
    middle: [f64; 2],
    wide: f64,
    /// Height of the plot, pixels.
    high: f64,
}

/// Width of the plot, and where it begins, pixels.
const FRAME: f64 = WIDTH - 2.0 * AIR;
const TOP: f64 = 46.0;

impl Sheet {
    /// With a title and room for what lies between these corners, m.
    pub(super) fn new(title: &str, view: [[f64; 2]; 2]) -> Self {
        let wide = size(view).max(f64::MIN_POSITIVE);
        let middle = [0, 1].map(|k| 0.5 * (view[0][k] + view[1][k]));
        let half = [0, 1].map(|k| (0.5 * (view[1][k] - view[0][k])).max(0.12 * wide) + 0.06 * wide);
        let scale = (FRAME / (2.0 * half[0])).min((HEIGHT_MOST - 110.0) / (2.0 * half[1]));
        let (top, high) = (TOP, 2.0 * half[1] * scale);
        let mut body = String::new();
        let shown = text::fitted(title, 16.0, Weight::Bold, FRAME as f32);
        write_text(&mut body, &shown, [AIR, 27.0], "start", TEXT, " font-size=\"16\" font-weight=\"bold\"");
        let _ = writeln!(
            body,
            "<clipPath id=\"view\"><rect x=\"{AIR}\" y=\"{top}\" width=\"{FRAME}\" \
                height=\"{high:.1}\"/></clipPath>\n<g clip-path=\"url(#view)\">"
        );
        Self { body, scale, middle, wide, high }
    }

    /// Upper left corner and size of the plot, pixels.
    pub(super) fn plot(&self) -> ([f64; 2], [f64; 2]) {
        ([AIR, TOP], [FRAME, self.high])
    }

    /// Where a place (m) is in the picture; what is far away is held back.
    pub(super) fn spot(&self, x: [f64; 2]) -> [f64; 2] {
        let on = |k: usize, origin: f64, sign: f64| (origin + sign * self.scale * (x[k] - self.middle[k])).clamp(-9e4, 9e4);
        [on(0, 0.5 * WIDTH, 1.0), on(1, TOP + 0.5 * self.high, -1.0)]
    }

    /// Adds the mark at a point of the picture and what stands below the plot; `note`: what else is to be
    /// known; `colour`: that of a part.
    pub(super) fn finish(
        mut self,
        title: &str,
        cells: &Cells,
        [x, y]: [f64; 2],
        mark: &str,
        note: &str,
        colour: impl Fn(usize) -> Rgb,
    ) -> String {
        let (body, (left, frame), (top, high)) = (&mut self.body, (AIR, FRAME), (TOP, self.high));
        let red = hex(CULPRIT);
        let _ = writeln!(
            body,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"13\" fill=\"none\" stroke=\"{red}\" stroke-width=\"3\"/>\n<path \
                d=\"M{:.1} {y:.1}H{:.1}M{x:.1} {:.1}V{:.1}\" stroke=\"{red}\" stroke-width=\"1.5\"/>",
            x - 22.0,
            x + 22.0,
            y - 22.0,
            y + 22.0
        );
        body.push_str("</g>\n");
        let room = name_width(mark);
        let (tx, ty) = (
            (x + 18.0).clamp(left + 4.0, (left + frame - room - 4.0).max(left + 4.0)),
            (y - 38.0).clamp(top + 4.0, (top + high - 26.0).max(top + 4.0)),
        );
        name(body, mark, [tx, ty]);
        let _ = writeln!(
            body,
            "<rect x=\"{left}\" y=\"{top}\" width=\"{frame}\" height=\"{high:.1}\" fill=\"none\" stroke=\"{}\"/>",
            hex(BORDER)
        );
        let below = top + high + 28.0;
        scale_bar(body, [left, below], self.scale, self.wide);
        parts(body, cells, [left + 260.0, below], colour);
        let mut foot = below + 24.0;
        if !note.is_empty() {
            write_text(body, note, [left, foot + 16.0], "start", TEXT_FAINT, "");
            foot += 26.0;
        }
        document([WIDTH, foot], title, body)
    }
}

/// A bar of a round length.
fn scale_bar(out: &mut String, [x, y]: [f64; 2], scale: f64, wide: f64) {
    let length = ticks(0.0, 0.3 * wide, 3).values.into_iter().rfind(|v| *v > 0.0).unwrap_or(wide);
    let unit = unit("m", length);
    let _ = writeln!(
        out,
        "<path d=\"M{x:.1} {:.1}V{:.1}H{:.1}V{:.1}\" fill=\"none\" stroke=\"{}\"/>",
        y - 6.0,
        y,
        x + scale * length,
        y - 6.0,
        hex(TEXT)
    );
    let shown = format!("{:.4}", length * unit.factor);
    write_text(
        out,
        &format!("{} {}", shown.trim_end_matches('0').trim_end_matches('.'), unit.name),
        [x, y + 15.0],
        "start",
        TEXT_FAINT,
        "",
    );
}

fn parts(out: &mut String, cells: &Cells, [mut x, y]: [f64; 2], fill: impl Fn(usize) -> Rgb) {
    for (part, name) in cells.part_names.iter().enumerate() {
        let name = text::fitted(name, 13.0, Weight::Regular, 160.0);
        let need = 46.0 + f64::from(text::width(&name, 13.0, Weight::Regular));
        if x + need > WIDTH - AIR {
            break;
        }
        let colour = DISTINCT[part % DISTINCT.len()];
        let _ = writeln!(
            out,
            "<rect x=\"{x:.1}\" y=\"{:.1}\" width=\"20\" height=\"12\" fill=\"{}\" stroke=\"{}\"/>",
            y - 8.0,
            hex(fill(part)),
            hex(colour)
        );
        write_text(out, &name, [x + 26.0, y + 3.0], "start", TEXT, "");
        x += need;
    }
}

/// The outlines of each part as closed lines of nodes; a bar is one of two.
fn loops(cells: &Cells) -> BTreeMap<usize, Vec<Vec<u32>>> {
    let mut edges: BTreeMap<usize, Vec<[u32; 2]>> = BTreeMap::new();
    let mut all: BTreeMap<usize, Vec<Vec<u32>>> = BTreeMap::new();
    for index in 0..cells.len() {
        let (cell, part) = (cells.cell(index), cells.parts[index] as usize);
        if cell.len() == 2 {
            all.entry(part).or_default().push(cell.to_vec());
            continue;
        }
        edges.entry(part).or_default().extend((0..cell.len()).map(|k| [cell[k], cell[(k + 1) % cell.len()]]));
    }
    for (part, mut edges) in edges {
        edges.sort_unstable();
        let is_inner = |[a, b]: [u32; 2]| edges.binary_search(&[b, a]).is_ok();
        let outside: Vec<[u32; 2]> = edges.iter().copied().filter(|&edge| !is_inner(edge)).collect();
        let mut next: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        outside.iter().for_each(|&[a, b]| next.entry(a).or_default().push(b));
        while let Some((&first, _)) = next.iter().next() {
            let (mut line, mut here) = (vec![first], first);
            while let Some(ways) = next.get_mut(&here) {
                let Some(to) = ways.pop() else { break };
                if ways.is_empty() {
                    next.remove(&here);
                }
                here = to;
                if here == first {
                    break;
                }
                line.push(here);
            }
            all.entry(part).or_default().push(line);
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use embate_solver::output::CellKind;

    #[test]
    fn the_outline_of_a_ring_of_cells_is_two_closed_lines() {
        // Eight cells around a hole: nodes 4 by 4.
        let node = |i: u32, j: u32| 4 * j + i;
        let mut cells = Cells { offsets: vec![0], part_names: vec!["ring".into()], ..Cells::default() };
        for (i, j) in (0..3).flat_map(|j| (0..3).map(move |i| (i, j))).filter(|&cell| cell != (1, 1)) {
            cells.nodes.extend([node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)]);
            cells.offsets.push(cells.nodes.len() as u32);
            cells.kinds.push(CellKind::Quadrilateral);
            cells.parts.push(0);
        }
        let mut lengths: Vec<usize> = loops(&cells)[&0].iter().map(Vec::len).collect();
        lengths.sort_unstable();
        assert_eq!(lengths, [4, 12]);
    }
}
