//! A few elements at a few times, as SVG: the neighbourhood of the failure location of a failure, each
//! element with its number.
//!
//! Elements and times come from a [`Trace`]; every panel has the same scale and the failure location in its
//! middle. The text goes to a file of the post-mortem.

use super::colour::{BORDER, DISTINCT, MAP, NO_VALUE, Rgb, SOLID, TEXT, TEXT_FAINT, WHITE, mix};
use super::scale::{number, unit};
use super::svg::{FAMILY, escape, hex, write_text};
use super::text::{self, Weight};
use embate_solver::post_mortem::{Moment, NearCell, Neighbourhood};
use std::fmt::Write;

/// Colour of the failure location.
pub(crate) const CULPRIT: Rgb = [214, 20, 60];
/// Width of a panel where there are several, and of one alone, pixels; limits of its height over its width;
/// the air around it, and the room for the failure location's name in it.
pub(super) const WIDE: [f64; 2] = [500.0, 760.0];
pub(super) const HIGH: [f64; 2] = [0.3, 1.1];
pub(super) const AIR: f64 = 16.0;
pub(super) const NAME: f64 = 42.0;
/// A failure location that is narrower, pixels, gets a line to it.
pub(super) const FOUND: f64 = 22.0;
pub(super) const HEAD: f64 = 34.0;
/// Largest number of an element, pixels; a smaller one than the second is not legible.
const FONT: f64 = 12.0;
const FONT_LEAST: f64 = 7.0;

/// One panel: what stands above it, and the time that it shows.
pub(crate) struct Panel<'a> {
    pub(crate) title: String,
    pub(crate) remark: String,
    pub(crate) moment: &'a Moment,
}

/// The picture as the text of an SVG file; `mark` is what the failure location is called in it, `depth` the
/// unit of forces.
pub(crate) fn neighbourhood(title: &str, near: &Neighbourhood, panels: &[Panel<'_>], mark: &str, depth: &str) -> String {
    let scene = Scene::new(near, panels, width_of(panels.len()));
    laid_out(
        title,
        panels.len(),
        scene.size,
        |out, k, corner| scene.panel(out, &panels[k], corner, k, mark),
        |out, corner, width| scene.legend.write(out, corner, width, (mark, depth), Vec::new()),
    )
}

/// Width of each of so many panels, pixels.
pub(super) fn width_of(panels: usize) -> f64 {
    WIDE[usize::from(panels.clamp(1, 2) == 1)]
}

/// Panels of one size in two columns, with a title above and a legend below; both are reported where they
/// begin, and the legend how wide the picture is.
pub(super) fn laid_out(
    title: &str,
    panels: usize,
    [wide, high]: [f64; 2],
    mut panel: impl FnMut(&mut String, usize, [f64; 2]),
    legend: impl FnOnce(&mut String, [f64; 2], f64),
) -> String {
    let columns = panels.clamp(1, 2);
    let rows = panels.div_ceil(columns);
    let width = columns as f64 * (wide + AIR) + AIR;
    let top = 46.0;
    let height = top + rows as f64 * (high + HEAD) + 104.0;
    let mut body = String::new();
    for k in 0..panels {
        let corner = [AIR + (k % columns) as f64 * (wide + AIR), top + HEAD + (k / columns) as f64 * (high + HEAD)];
        panel(&mut body, k, corner);
    }
    legend(&mut body, [AIR, top + rows as f64 * (high + HEAD) + 22.0], width);
    let mut head = String::new();
    let shown = text::fitted(title, 16.0, Weight::Bold, (width - 2.0 * AIR) as f32);
    write_text(&mut head, &shown, [AIR, 27.0], "start", TEXT, " font-size=\"16\" font-weight=\"bold\"");
    document([width, height], title, &(head + &body))
}

/// A whole SVG file.
pub(super) fn document([width, height]: [f64; 2], title: &str, body: &str) -> String {
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" font-family=\"{FAMILY}\" font-size=\"13\">\n<title>{}</title>\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n{body}</svg>\n",
        escape(title)
    )
}

/// What all panels share.
struct Scene<'a> {
    near: &'a Neighbourhood,
    /// Width and height of a panel, pixels.
    size: [f64; 2],
    /// Middle of what is shown, from the failure location, m, and pixels for a metre.
    middle: [f64; 2],
    scale: f64,
    legend: Legend<'a>,
}

/// What colours and signs mean.
pub(super) struct Legend<'a> {
    pub(super) near: &'a Neighbourhood,
    /// Range of the field, and the largest force, N/m.
    range: [f64; 2],
    pub(super) force: f64,
}

impl<'a> Scene<'a> {
    fn new(near: &'a Neighbourhood, panels: &[Panel<'_>], wide: f64) -> Self {
        let moments = || panels.iter().map(|panel| panel.moment);
        let reach = |moment: &Moment| {
            let centre = centre(near, moment);
            let rings = near.cells.iter().filter(|cell| cell.ring.is_some());
            let far = rings.flat_map(|cell| &cell.nodes).map(|&node| seen(moment.positions[node])).filter(|x| is_finite(*x));
            far.fold([[0.0; 2]; 2], |[low, high]: [[f64; 2]; 2], x| {
                [[0, 1].map(|k| low[k].min(x[k] - centre[k])), [0, 1].map(|k| high[k].max(x[k] - centre[k]))]
            })
        };
        let view = common(&moments().map(reach).collect::<Vec<_>>());
        let (size, middle, scale) = fitted(view, air(near), wide);
        Self { near, size, middle, scale, legend: Legend::new(near, panels, |f| f[0].hypot(f[1])) }
    }

    fn panel(&self, out: &mut String, panel: &Panel<'_>, corner: [f64; 2], number: usize, mark: &str) {
        let moment = panel.moment;
        let centre = centre(self.near, moment);
        let ([wide, high], scale) = (self.size, self.scale);
        let origin = [corner[0] + 0.5 * wide, corner[1] + NAME + 0.5 * (high - NAME)];
        // Farther than any panel nothing is seen, and numbers stay short.
        let place = |x: [f64; 2]| {
            let at = |k: usize, sign: f64| (origin[k] + sign * scale * (x[k] - centre[k] - self.middle[k])).clamp(-9e4, 9e4);
            [at(0, 1.0), at(1, -1.0)]
        };
        let [left, top] = corner;
        write_text(out, &panel.title, [left, top - 10.0], "start", TEXT, " font-weight=\"bold\"");
        write_text(out, &panel.remark, [left + wide, top - 10.0], "end", TEXT_FAINT, "");
        let _ = writeln!(out, "<clipPath id=\"c{number}\"><rect x=\"{left}\" y=\"{top}\" width=\"{wide}\" height=\"{high}\"/></clipPath>");
        let _ = writeln!(out, "<g clip-path=\"url(#c{number})\">");
        for outline in moment.outlines.iter().filter(|outline| !outline.is_gone) {
            let far = |x: &[f64; 3]| [0, 1].map(|k| (x[k] - centre[k]).clamp(-4e4 / scale, 4e4 / scale) + centre[k]);
            let path = path(&outline.points.iter().map(|x| place(far(x))).collect::<Vec<_>>(), false);
            let _ = writeln!(out, "<path d=\"{path}\" fill=\"none\" stroke=\"{}\" stroke-width=\"5\"/>", hex(BORDER));
        }
        let mut labels = Vec::new();
        // The failure location's own last, so that its line lies above those of others.
        for (k, cell) in self.near.cells.iter().enumerate().rev() {
            let corners: Vec<[f64; 2]> = cell.kind.around().map(|k| seen(moment.positions[cell.nodes[k]])).collect();
            if !corners.iter().all(|x| is_finite(*x)) {
                continue;
            }
            let points: Vec<[f64; 2]> = corners.into_iter().map(place).collect();
            let is_failure_location = self.near.element == Some(k);
            let fill = self.legend.fill(moment.values.get(k).copied().unwrap_or(f64::NAN), cell.ring.is_some());
            let own = DISTINCT[cell.part % DISTINCT.len()];
            let (stroke, wide) = if is_failure_location { (CULPRIT, 3.5) } else { (own, 1.1) };
            let _ = writeln!(
                out,
                "<path d=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"{wide}\" stroke-linejoin=\"round\"/>",
                path(&points, true),
                hex(fill),
                hex(stroke)
            );
            labels.extend(Label::of(&points, cell.element.to_string(), fill, is_failure_location));
        }
        self.forces(out, moment, &place);
        write_labels(out, labels.into_iter().rev());
        self.mark(out, moment, corner, &place, mark);
        out.push_str("</g>\n");
        let _ =
            writeln!(out, "<rect x=\"{left}\" y=\"{top}\" width=\"{wide}\" height=\"{high}\" fill=\"none\" stroke=\"{}\"/>", hex(BORDER));
    }

    /// Contact forces as arrows that end at their nodes.
    fn forces(&self, out: &mut String, moment: &Moment, place: &impl Fn([f64; 2]) -> [f64; 2]) {
        let colour = hex(DISTINCT[3]);
        for (&x, &force) in moment.positions.iter().zip(&moment.forces) {
            let (x, force) = (seen(x), seen(force));
            let size = force[0].hypot(force[1]);
            if self.legend.force <= 0.0 || !size.is_finite() || size < 0.02 * self.legend.force || !is_finite(x) {
                continue;
            }
            let tip = place(x);
            let (length, along) = (12.0 + 50.0 * size / self.legend.force, [force[0] / size, -force[1] / size]);
            arrow(out, tip, along, length, &colour);
        }
    }

    /// The failure location's name in a corner, with a line to it.
    fn mark(&self, out: &mut String, moment: &Moment, [left, top]: [f64; 2], place: &impl Fn([f64; 2]) -> [f64; 2], mark: &str) {
        let at = place(centre(self.near, moment));
        let colour = hex(CULPRIT);
        if let Some(x) = self.near.node.map(|node| seen(moment.positions[node])).filter(|x| is_finite(*x)) {
            let [x, y] = place(x);
            let _ = writeln!(out, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"7\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"3.5\"/>");
        }
        let [x, y] = [left + 10.0, top + 10.0];
        let wide = name_width(mark);
        // What is large is seen without a line to it.
        if self.near.node.is_none() && self.least(moment) * self.scale < FOUND {
            let line = path(&[[x + 0.5 * wide, y + 22.0], at], false);
            let _ = writeln!(out, "<path d=\"{line}\" stroke=\"{colour}\" stroke-width=\"1.5\"/>");
        }
        name(out, mark, [x, y]);
    }

    /// The smaller side of the box around the failure location, m.
    fn least(&self, moment: &Moment) -> f64 {
        let nodes = self.near.element.map_or(&[][..], |element| &self.near.cells[element].nodes);
        let side = |k: usize| {
            let all = || nodes.iter().map(|&node| moment.positions[node][k]);
            all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min)
        };
        side(0).min(side(1))
    }
}

/// Lower and upper corner, from the failure location, of what all panels show, of those of each.
pub(super) fn common(reaches: &[[[f64; 2]; 2]]) -> [[f64; 2]; 2] {
    // Of what flies apart in the last steps the scale is that of the first ones.
    let first = reaches.first().copied().unwrap_or_default();
    let most = 1.5 * (0..2).map(|k| first[1][k] - first[0][k]).fold(0.0, f64::max);
    let grown = |[low, high]: [[f64; 2]; 2], own: &[[f64; 2]; 2]| {
        [[0, 1].map(|k| low[k].min(own[0][k].max(-most))), [0, 1].map(|k| high[k].max(own[1][k].min(most)))]
    };
    reaches.iter().fold(first, grown)
}

/// Room around the elements: what is opposite of the failure location is shown as well.
pub(super) fn air(near: &Neighbourhood) -> f64 {
    let is_own = |cell: &NearCell| near.cells.first().is_some_and(|first| first.part == cell.part);
    if near.cells.iter().all(is_own) { 1.08 } else { 1.3 }
}

/// Width and height of a panel, pixels, the middle of what it shows, and pixels for a metre.
pub(super) fn fitted(view: [[f64; 2]; 2], air: f64, wide: f64) -> ([f64; 2], [f64; 2], f64) {
    let span = [0, 1].map(|k| air * (view[1][k] - view[0][k])).map(|span| if span > 0.0 { span } else { 1.0 });
    let size = [wide, (wide * span[1] / span[0] + NAME).clamp(HIGH[0] * wide, HIGH[1] * wide)];
    (size, [0, 1].map(|k| 0.5 * (view[0][k] + view[1][k])), (size[0] / span[0]).min((size[1] - NAME) / span[1]))
}

impl<'a> Legend<'a> {
    /// Ranges of the values of all panels, and of the sizes of forces.
    pub(super) fn new(near: &'a Neighbourhood, panels: &[Panel<'_>], size: impl Fn(&[f64; 3]) -> f64) -> Self {
        let moments = || panels.iter().map(|panel| panel.moment);
        let values = || moments().flat_map(|moment| &moment.values).copied().filter(|value| value.is_finite());
        let (low, high) = values().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        let norms = moments().flat_map(|moment| &moment.forces).map(size).filter(|norm| norm.is_finite());
        Self {
            near,
            range: if low < high { [low, high] } else { [low.min(0.0), high.max(low.min(0.0) + 1.0)] },
            force: norms.fold(0.0, f64::max),
        }
    }

    /// Colour of a value; paler where the element does not hang together with the failure location.
    pub(super) fn fill(&self, value: f64, is_ring: bool) -> Rgb {
        if !value.is_finite() {
            return NO_VALUE;
        }
        let level = ((value - self.range[0]) / (self.range[1] - self.range[0])).clamp(0.0, 1.0);
        let colour = MAP[(level * (MAP.len() - 1) as f64).round() as usize];
        mix(WHITE, colour, if is_ring { 0.8 } else { 0.35 })
    }

    /// Writes it; `more`: further signs and what they mean.
    pub(super) fn write(
        &self,
        out: &mut String,
        [left, top]: [f64; 2],
        width: f64,
        (mark, depth): (&str, &str),
        more: Vec<(String, String)>,
    ) {
        let (name, si) = self.near.field;
        let [low, high] = self.range;
        let unit = unit(si, low.abs().max(high.abs()));
        let (steps, wide) = (48, 220.0);
        for k in 0..steps {
            let level = k as f64 / (steps - 1) as f64;
            let fill = self.fill(low + level * (high - low), true);
            let _ = writeln!(
                out,
                "<rect x=\"{:.2}\" y=\"{top}\" width=\"{:.2}\" height=\"14\" fill=\"{}\"/>",
                left + wide * k as f64 / steps as f64,
                wide / steps as f64 + 0.5,
                hex(fill)
            );
        }
        // Three digits of the larger end.
        let step = 10f64.powf((low.abs().max(high.abs()) * unit.factor).max(1e-300).log10().floor() - 2.0);
        let label = |value: f64| number((value * unit.factor / step).round() * step, step);
        write_text(out, &label(low), [left, top + 30.0], "start", TEXT, "");
        write_text(out, &label(high), [left + wide, top + 30.0], "end", TEXT, "");
        write_text(out, &format!("{name}{}", unit.bracket()), [left, top + 48.0], "start", TEXT_FAINT, "");
        // What the signs mean, one after the other.
        let mut items: Vec<(String, String)> = vec![(swatch(CULPRIT, WHITE, 3.5), mark.to_string())];
        let mut parts: Vec<usize> = self.near.cells.iter().map(|cell| cell.part).collect();
        parts.sort_unstable();
        parts.dedup();
        items.extend(parts.into_iter().map(|part| {
            let name = self.near.part_names.get(part).map_or("", String::as_str);
            (swatch(DISTINCT[part % DISTINCT.len()], WHITE, 2.0), format!("part \"{name}\""))
        }));
        if self.near.cells.iter().any(|cell| cell.ring.is_none()) {
            items.push((swatch(BORDER, SOLID, 1.0), "pale: near, but not within three rings".into()));
        }
        if self.force > 0.0 {
            let most = super::scale::unit(depth, self.force);
            let arrow = format!("<path d=\"M0 7H22M15 3L22 7L15 11\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>", hex(DISTINCT[3]));
            items.push((arrow, format!("contact force, up to {:.3} {}", self.force * most.factor, most.name)));
        }
        items.extend(more);
        let (mut x, mut y) = (left + wide + 40.0, top);
        for (sign, name) in items {
            let name = text::fitted(&name, 13.0, Weight::Regular, 420.0);
            let need = 34.0 + f64::from(text::width(&name, 13.0, Weight::Regular)) + 18.0;
            if x + need > width - AIR && x > left + wide + 40.0 {
                (x, y) = (left + wide + 40.0, y + 21.0);
            }
            let _ = writeln!(out, "<g transform=\"translate({x:.1} {y:.1})\">{sign}</g>");
            write_text(out, &name, [x + 30.0, y + 12.0], "start", TEXT, "");
            x += need;
        }
    }
}

/// Width of the failure location's name in its box, pixels.
pub(super) fn name_width(mark: &str) -> f64 {
    f64::from(text::width(mark, 13.0, Weight::Bold)) + 12.0
}

/// The failure location's name in a box with this upper left corner.
pub(super) fn name(out: &mut String, mark: &str, [x, y]: [f64; 2]) {
    let (wide, colour) = (name_width(mark), hex(CULPRIT));
    let _ = writeln!(
        out,
        "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{wide:.1}\" height=\"22\" rx=\"3\" fill=\"#ffffff\" \
            stroke=\"{colour}\" stroke-width=\"1.5\"/>"
    );
    write_text(out, mark, [x + 6.0, y + 15.5], "start", CULPRIT, " font-weight=\"bold\"");
}

/// An arrow of a contact force that ends at `tip`; `along` has length one.
pub(super) fn arrow(out: &mut String, tip: [f64; 2], along: [f64; 2], length: f64, colour: &str) {
    let tail = [0, 1].map(|k| tip[k] - length * along[k]);
    let side = [-along[1], along[0]];
    let barb = |sign: f64| [0, 1].map(|k| tip[k] - 8.0 * along[k] + sign * 4.0 * side[k]);
    let (a, b) = (barb(1.0), barb(-1.0));
    let _ = writeln!(
        out,
        "<path d=\"M{:.1} {:.1}L{:.1} {:.1}M{:.1} {:.1}L{:.1} {:.1}L{:.1} {:.1}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\"/>",
        tail[0], tail[1], tip[0], tip[1], a[0], a[1], tip[0], tip[1], b[0], b[1]
    );
}

/// The number of an element, as large as it fits.
pub(super) struct Label {
    text: String,
    at: [f64; 2],
    font: f64,
    width: f64,
    colour: Rgb,
    is_bold: bool,
}

impl Label {
    /// `None` where it would be too small to be read.
    pub(super) fn of(points: &[[f64; 2]], text: String, fill: Rgb, is_bold: bool) -> Option<Self> {
        let next = |k: usize| points[(k + 1) % points.len()];
        let cross = |k: usize| points[k][0] * next(k)[1] - next(k)[0] * points[k][1];
        let area = 0.5 * (0..points.len()).map(cross).sum::<f64>().abs();
        let longest = (0..points.len()).map(|k| (points[k][0] - next(k)[0]).hypot(points[k][1] - next(k)[1])).fold(1e-9, f64::max);
        let width = f64::from(text::width(&text, 1.0, Weight::Regular));
        // It must fit into the element's length, and its height into the element's.
        let font = FONT.min(0.95 * longest / width).min(if points.len() == 2 { FONT } else { 0.8 * area / longest });
        let dark = 0.3 * f64::from(fill[0]) + 0.6 * f64::from(fill[1]) + 0.1 * f64::from(fill[2]) < 125.0;
        let at = [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / points.len() as f64);
        let colour = if dark { WHITE } else { TEXT };
        (font >= FONT_LEAST).then_some(Self { text, at, font, width: width * font, colour, is_bold })
    }

    fn hides(&self, other: &Self) -> bool {
        let apart = [0, 1].map(|k| (self.at[k] - other.at[k]).abs());
        apart[0] < 0.5 * (self.width + other.width) && apart[1] < 0.5 * (self.font + other.font)
    }
}

/// Those that come first stay where bodies overlap: two numbers on each other are none.
pub(super) fn write_labels(out: &mut String, labels: impl Iterator<Item = Label>) {
    let mut written: Vec<Label> = Vec::new();
    for label in labels {
        if written.iter().any(|other| label.hides(other)) {
            continue;
        }
        let weight = if label.is_bold { " font-weight=\"bold\"" } else { "" };
        let more = format!(" font-size=\"{:.1}\"{weight}", label.font);
        write_text(out, &label.text, [label.at[0], label.at[1] + 0.36 * label.font], "middle", label.colour, &more);
        written.push(label);
    }
}

pub(super) fn swatch(stroke: Rgb, fill: Rgb, wide: f64) -> String {
    format!("<rect x=\"1\" y=\"1\" width=\"20\" height=\"12\" fill=\"{}\" stroke=\"{}\" stroke-width=\"{wide}\"/>", hex(fill), hex(stroke))
}

fn is_finite(x: [f64; 2]) -> bool {
    x.iter().all(|v| v.is_finite())
}

/// A vector of a model in 2D.
fn seen([x, y, _]: [f64; 3]) -> [f64; 2] {
    [x, y]
}

/// Middle of a panel: the failure location's node, or the mean of its element's.
fn centre(near: &Neighbourhood, moment: &Moment) -> [f64; 2] {
    let of_node = near.node.map(|node| vec![node]);
    let nodes = of_node.or_else(|| near.element.map(|element| near.cells[element].nodes.clone())).unwrap_or_default();
    let all = nodes.iter().map(|&node| seen(moment.positions[node])).filter(|x| is_finite(*x));
    let (count, sum) = all.fold((0.0, [0.0; 2]), |(count, sum), x| (count + 1.0, [sum[0] + x[0], sum[1] + x[1]]));
    if count > 0.0 {
        return sum.map(|v| v / count);
    }
    // Where the failure location is nowhere any more: the mean of what is left.
    let left: Vec<[f64; 2]> = moment.positions.iter().map(|&x| seen(x)).filter(|x| is_finite(*x)).collect();
    [0, 1].map(|k| left.iter().map(|x| x[k]).sum::<f64>() / left.len().max(1) as f64)
}

/// Points from one to the other.
pub(super) fn path(points: &[[f64; 2]], is_closed: bool) -> String {
    let mut path = String::new();
    for (k, [x, y]) in points.iter().enumerate() {
        let _ = write!(path, "{}{x:.1} {y:.1}", if k == 0 { "M" } else { "L" });
    }
    if is_closed {
        path.push('Z');
    }
    path
}
