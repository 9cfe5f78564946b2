//! Line charts as SVG: panels one above the other over one axis or several, names at the ends of the curves,
//! right of the plot. Panels come from `plots` and `sweep`; the text goes to a file. Any viewer's sans-serif
//! font will do: room is kept for the widest in use.

use super::colour::{self, BORDER, GRID, Rgb, TEXT, TEXT_FAINT};
use super::scale::{Ticks, Unit, number, ticks, unit};
use super::text::{self, Weight};
use std::fmt::Write;

/// How values lie on an axis.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Spacing {
    /// Equal differences have equal distances.
    Even,
    /// Equal factors have equal distances; all values are positive.
    Factors,
    /// The values are places in this list.
    Names(Vec<String>),
}

/// An axis below one or several panels.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Abscissa {
    pub(crate) name: String,
    pub(crate) si: String,
    pub(crate) spacing: Spacing,
}

/// Panels over one axis.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Group {
    pub(crate) abscissa: Abscissa,
    pub(crate) panels: Vec<Panel>,
}

impl Group {
    /// Panels over time.
    pub(crate) fn over_time(panels: Vec<Panel>) -> Self {
        Self { abscissa: Abscissa { name: "time".into(), si: "s".into(), spacing: Spacing::Even }, panels }
    }
}

/// One curve.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Curve {
    pub(crate) name: String,
    pub(crate) colour: Rgb,
    /// Dash pattern; empty: drawn through.
    pub(crate) dashes: &'static str,
    /// Zero: no line.
    pub(crate) width: f64,
    /// Whether each point has a dot.
    pub(crate) dots: bool,
    /// Time or input, and value, in SI; values that are not finite interrupt the curve.
    pub(crate) points: Vec<[f64; 2]>,
}

/// One plot with its own y axis.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Panel {
    pub(crate) name: String,
    pub(crate) si: &'static str,
    /// Whether the y axis includes zero.
    pub(crate) from_zero: bool,
    pub(crate) height: f64,
    pub(crate) curves: Vec<Curve>,
    /// Small print below the panel's name, for example what was left out.
    pub(crate) remark: String,
}

/// Points of a drawn curve, at most.
const POINTS_MAX: usize = 2000;
const WIDTH: f64 = 900.0;
const FONT: f64 = 13.0;
/// Distance of names at the ends of curves.
const LINE: f64 = 16.0;
pub(crate) const FAMILY: &str = "system-ui, 'Segoe UI', Roboto, Helvetica, Arial, sans-serif";

/// The chart as the text of an SVG file.
pub(crate) fn chart(title: &str, groups: &[Group]) -> String {
    let panels = || groups.iter().flat_map(|group| &group.panels);
    let label_width = panels().flat_map(|p| &p.curves).map(|c| measured(&c.name)).fold(0.0, f64::max).min(190.0);
    let frames: Vec<Vec<Frame>> = groups.iter().map(|group| group.panels.iter().map(Frame::new).collect()).collect();
    let left = (frames.iter().flatten().map(|f| f.labels_width).fold(0.0, f64::max) + 30.0).min(140.0);
    let right = WIDTH - label_width - 52.0;
    let mut top = 62.0;
    let mut body = String::new();
    for (group, frames) in groups.iter().zip(&frames) {
        let scale = Scale::new(group, [left, right]);
        for (panel, frame) in group.panels.iter().zip(frames) {
            let bottom = top + panel.height;
            for (x, _) in &scale.ticks {
                line(&mut body, [*x, top], [*x, bottom], GRID);
            }
            let plot = [left, top, right, bottom];
            frame.draw(&mut body, panel, plot);
            draw_curves(&mut body, panel, frame, plot, &|value| scale.x(value));
            top = bottom + 52.0;
        }
        let bottom = top - 52.0;
        scale.draw(&mut body, bottom);
        top = bottom + 92.0;
    }
    let bottom = top - 92.0;
    let mut head = String::new();
    let title_text = text::fitted(title, 16.0, Weight::Bold, WIDTH as f32 - 40.0);
    write_text(&mut head, &title_text, [16.0, 27.0], "start", TEXT, " font-size=\"16\" font-weight=\"bold\"");
    let height = bottom + 54.0;
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{height}\" \
         viewBox=\"0 0 {WIDTH} {height}\" font-family=\"{FAMILY}\" font-size=\"{FONT}\">\n<title>{}</title>\n\
         <rect width=\"{WIDTH}\" height=\"{height}\" fill=\"#ffffff\"/>\n{head}{body}</svg>\n",
        escape(title)
    )
}

/// The x axis of a group.
struct Scale {
    name: String,
    spacing: Spacing,
    /// Values at both ends; logarithms where factors count.
    ends: [f64; 2],
    /// Their places.
    places: [f64; 2],
    /// Places and labels.
    ticks: Vec<(f64, String)>,
}

impl Scale {
    fn new(group: &Group, places: [f64; 2]) -> Self {
        let Abscissa { name, si, spacing } = &group.abscissa;
        let values = || group.panels.iter().flat_map(|p| &p.curves).flat_map(|c| &c.points).map(|p| p[0]).filter(|t| t.is_finite());
        let ends = match spacing {
            Spacing::Even => range(values(), false),
            Spacing::Factors => range(values().map(f64::log10), false),
            Spacing::Names(names) => [-0.5, names.len() as f64 - 0.5],
        };
        // Points with dots stand inside, not on the border.
        let has_dots = *spacing != Spacing::Even || group.panels.iter().flat_map(|p| &p.curves).any(|c| c.dots);
        let air = if has_dots && !matches!(spacing, Spacing::Names(_)) { 0.02 * (ends[1] - ends[0]) } else { 0.0 };
        let ends = [ends[0] - air, ends[1] + air];
        // Of values that differ by orders of magnitude those in the middle choose the unit.
        let largest = if *spacing == Spacing::Factors { 10f64.powf(0.5 * (ends[0] + ends[1])) } else { ends[0].abs().max(ends[1].abs()) };
        let unit = if matches!(spacing, Spacing::Names(_)) { unit("", 0.0) } else { unit(si, largest) };
        let mut scale = Self { name: format!("{name}{}", unit.bracket()), spacing: spacing.clone(), ends, places, ticks: Vec::new() };
        let tick = |value: f64, label: String| (scale.x(value), label);
        scale.ticks = match spacing {
            Spacing::Even => {
                let even = ticks(ends[0] * unit.factor, ends[1] * unit.factor, 10);
                even.values.iter().zip(even.labels()).map(|(value, label)| tick(value / unit.factor, label)).collect()
            }
            Spacing::Factors => factors(ends.map(|end| end + unit.factor.log10()))
                .into_iter()
                .map(|value| tick(value / unit.factor, number(value, value)))
                .collect(),
            Spacing::Names(names) => {
                let room = (places[1] - places[0]) / names.len().max(1) as f64 - 6.0;
                let label = |name: &String| text::fitted(name, FONT as f32, Weight::Regular, room as f32);
                names.iter().enumerate().map(|(place, name)| tick(place as f64, label(name))).collect()
            }
        };
        scale
    }

    fn x(&self, value: f64) -> f64 {
        let value = if self.spacing == Spacing::Factors { value.log10() } else { value };
        self.places[0] + (self.places[1] - self.places[0]) * (value - self.ends[0]) / (self.ends[1] - self.ends[0])
    }

    fn draw(&self, out: &mut String, bottom: f64) {
        for (x, label) in &self.ticks {
            line(out, [*x, bottom], [*x, bottom + 5.0], BORDER);
            write_text(out, label, [*x, bottom + 20.0], "middle", TEXT, "");
        }
        write_text(out, &self.name, [0.5 * (self.places[0] + self.places[1]), bottom + 40.0], "middle", TEXT_FAINT, "");
    }
}

/// Round values between two powers of ten: 1, 2, 5 and so on, or every power, or every second ...
fn factors([low, high]: [f64; 2]) -> Vec<f64> {
    let decades = (low.floor() as i32..=high.ceil() as i32).collect::<Vec<_>>();
    let inside = |value: &f64| (low..=high).contains(&value.log10());
    let of = |mantissas: &[f64]| -> Vec<f64> {
        decades.iter().flat_map(|decade| mantissas.iter().map(move |mantissa| mantissa * 10f64.powi(*decade))).filter(inside).collect()
    };
    let [fine, coarse] = [of(&[1.0, 2.0, 5.0]), of(&[1.0])];
    if fine.len() < 3 {
        return of(&[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]);
    }
    if fine.len() <= 10 { fine } else { coarse.iter().copied().step_by(coarse.len().div_ceil(10).max(1)).collect() }
}

/// The y axis of a panel.
struct Frame {
    unit: Unit,
    low: f64,
    high: f64,
    ticks: Ticks,
    labels_width: f64,
}

impl Frame {
    fn new(panel: &Panel) -> Self {
        let values = || panel.curves.iter().flat_map(|c| &c.points).map(|p| p[1]).filter(|v| v.is_finite());
        let [mut low, mut high] = range(values(), panel.from_zero);
        let unit = unit(panel.si, low.abs().max(high.abs()));
        let air = 0.05 * (high - low);
        if !(panel.from_zero && low == 0.0) {
            low -= air;
        }
        high += air;
        let ticks = ticks(low * unit.factor, high * unit.factor, ((panel.height / 36.0) as usize).clamp(3, 9));
        let labels_width = ticks.labels().iter().map(|l| measured(l)).fold(0.0, f64::max);
        Self { unit, low, high, ticks, labels_width }
    }

    fn y(&self, value: f64, plot: [f64; 4]) -> f64 {
        plot[3] - (plot[3] - plot[1]) * ((value - self.low) / (self.high - self.low))
    }

    fn draw(&self, out: &mut String, panel: &Panel, plot: [f64; 4]) {
        let [left, top, right, bottom] = plot;
        for (value, label) in self.ticks.values.iter().zip(self.ticks.labels()) {
            let y = self.y(value / self.unit.factor, plot);
            line(out, [left, y], [right, y], if *value == 0.0 { BORDER } else { GRID });
            line(out, [left - 5.0, y], [left, y], BORDER);
            write_text(out, &label, [left - 9.0, y + 4.5], "end", TEXT, "");
        }
        let (width, height) = (right - left, bottom - top);
        let border = hex(BORDER);
        let _ = writeln!(
            out,
            "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"none\" stroke=\"{border}\"/>"
        );
        let name = format!("{}{}", panel.name, self.unit.bracket());
        write_text(out, &name, [left, top - 9.0], "start", TEXT, "");
        if !panel.remark.is_empty() {
            let room = right - left - measured(&name) - 30.0;
            let remark = text::fitted(&panel.remark, FONT as f32, Weight::Regular, room as f32);
            write_text(out, &remark, [right, top - 9.0], "end", TEXT_FAINT, " font-size=\"11.5\"");
        }
        if panel.curves.iter().all(|c| c.points.iter().all(|p| !p[1].is_finite())) {
            write_text(out, "no data", [0.5 * (left + right), 0.5 * (top + bottom)], "middle", TEXT_FAINT, "");
        }
    }
}

fn draw_curves(out: &mut String, panel: &Panel, frame: &Frame, plot: [f64; 4], x: &dyn Fn(f64) -> f64) {
    let mut ends = Vec::new();
    for curve in &panel.curves {
        let style = {
            let dashes = if curve.dashes.is_empty() { String::new() } else { format!(" stroke-dasharray=\"{}\"", curve.dashes) };
            format!("stroke=\"{}\" stroke-width=\"{}\"{dashes}", hex(curve.colour), curve.width)
        };
        let place = |p: &[f64; 2]| [x(p[0]), frame.y(p[1], plot)];
        let mut path = String::new();
        for piece in decimated(&curve.points, POINTS_MAX).split(|p| !(p[0].is_finite() && p[1].is_finite())) {
            for point in piece.iter().filter(|_| piece.len() == 1 || curve.dots) {
                let [x, y] = place(point);
                let _ = writeln!(out, "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"3\" fill=\"{}\"/>", hex(curve.colour));
            }
            if piece.len() > 1 && curve.width > 0.0 {
                for (k, point) in piece.iter().enumerate() {
                    let [x, y] = place(point);
                    let _ = write!(path, "{}{x:.2} {y:.2}", if k == 0 { "M" } else { "L" });
                }
            }
        }
        if !path.is_empty() {
            let _ = writeln!(out, "<path d=\"{path}\" fill=\"none\" {style} stroke-linejoin=\"round\" stroke-linecap=\"round\"/>");
        }
        let last = curve.points.iter().rev().find(|p| p[0].is_finite() && p[1].is_finite());
        if let Some(last) = last.filter(|_| !curve.name.is_empty()) {
            ends.push((frame.y(last[1], plot), curve, style));
        }
    }
    // Names stand where their curves end, moved apart where these are close; a short line leads from one to
    // the other.
    let wanted: Vec<f64> = ends.iter().map(|(y, ..)| *y).collect();
    for (y, (end, curve, style)) in apart(&wanted, LINE, plot[1] + 2.0, plot[3] - 2.0).into_iter().zip(&ends) {
        let right = plot[2];
        let (a, b, c) = (right + 4.0, right + 20.0, right + 32.0);
        let _ = writeln!(out, "<path d=\"M{a:.1} {end:.2}L{b:.1} {y:.2}H{c:.1}\" fill=\"none\" {style}/>");
        let name = text::fitted(&curve.name, FONT as f32, Weight::Regular, (WIDTH - right - 46.0) as f32);
        write_text(out, &name, [right + 37.0, y + 4.5], "start", TEXT, "");
    }
}

/// Places at least `distance` apart, close to the wanted ones and in their order, within `low..=high` if
/// there is room.
fn apart(wanted: &[f64], distance: f64, low: f64, high: f64) -> Vec<f64> {
    let mut order: Vec<usize> = (0..wanted.len()).collect();
    order.sort_by(|a, b| wanted[*a].total_cmp(&wanted[*b]));
    // Groups of touching names, each centred on the mean of its wishes.
    let mut groups: Vec<(f64, usize)> = Vec::new();
    for index in &order {
        let mut group = (wanted[*index], 1usize);
        while let Some(above) = groups.last() {
            let reach = 0.5 * distance * (above.1 + group.1) as f64;
            if group.0 - above.0 >= reach {
                break;
            }
            let count = above.1 + group.1;
            group = ((above.0 * above.1 as f64 + group.0 * group.1 as f64) / count as f64, count);
            groups.pop();
        }
        groups.push(group);
    }
    let mut places: Vec<f64> = groups
        .iter()
        .flat_map(|(centre, count)| (0..*count).map(move |k| centre + distance * (k as f64 - 0.5 * (*count as f64 - 1.0))))
        .collect();
    let mut limit = high;
    for place in places.iter_mut().rev() {
        *place = place.min(limit);
        limit = *place - distance;
    }
    let mut limit = low;
    for place in &mut places {
        *place = place.max(limit);
        limit = *place + distance;
    }
    let mut result = vec![0.0; wanted.len()];
    for (index, place) in order.iter().zip(places) {
        result[*index] = place;
    }
    result
}

/// At most `most` points that look the same: of each bucket the lowest and the highest in their order, first
/// and last always; gaps stay.
pub(crate) fn decimated(points: &[[f64; 2]], most: usize) -> Vec<[f64; 2]> {
    if points.len() <= most {
        return points.to_vec();
    }
    let inner = &points[1..points.len() - 1];
    let bucket = inner.len().div_ceil((most.max(8) - 2) / 3);
    let mut kept = vec![points[0]];
    for part in inner.chunks(bucket) {
        let finite = |k: &usize| part[*k][1].is_finite();
        let by_value = |a: &usize, b: &usize| part[*a][1].total_cmp(&part[*b][1]);
        let low = (0..part.len()).filter(finite).min_by(by_value);
        let high = (0..part.len()).filter(finite).max_by(by_value);
        let gap = (0..part.len()).find(|k| !finite(k));
        let mut picked: Vec<usize> = [low, high, gap].into_iter().flatten().collect();
        picked.sort_unstable();
        picked.dedup();
        kept.extend(picked.into_iter().map(|k| part[k]));
    }
    kept.push(points[points.len() - 1]);
    kept
}

/// Range of finite values with a size: `[0, 1]` for none, some room around a single value.
fn range(values: impl Iterator<Item = f64>, from_zero: bool) -> [f64; 2] {
    let start = if from_zero { (0.0, 0.0) } else { (f64::INFINITY, f64::NEG_INFINITY) };
    let (low, high) = values.map(|v| v.clamp(-1e150, 1e150)).fold(start, |(low, high), v| (low.min(v), high.max(v)));
    if low > high {
        return [0.0, 1.0];
    }
    if high - low > 1e-9 * high.abs().max(low.abs()) && high - low > 1e-150 {
        return [low, high];
    }
    let half = if low.abs() < 1e-140 { 1.0 } else { 0.5 * low.abs() };
    if (0.0..1e-140).contains(&low) { [0.0, 1.0] } else { [low - half, low + half] }
}

/// Width in the widest of usual fonts, pixels.
fn measured(line: &str) -> f64 {
    f64::from(text::width(line, FONT as f32, Weight::Regular))
}

pub(crate) fn hex(colour: Rgb) -> String {
    format!("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2])
}

fn line(out: &mut String, from: [f64; 2], to: [f64; 2], colour: colour::Rgb) {
    let [[x1, y1], [x2, y2]] = [from, to];
    let _ = writeln!(out, "<path d=\"M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}\" stroke=\"{}\"/>", hex(colour));
}

pub(crate) fn write_text(out: &mut String, text: &str, at: [f64; 2], anchor: &str, colour: Rgb, more: &str) {
    let [x, y] = at;
    let _ =
        writeln!(out, "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\" fill=\"{}\"{more}>{}</text>", hex(colour), escape(text));
}

/// Text as XML holds it; characters that XML 1.0 forbids become spaces.
pub(crate) fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            c if c.is_control() || matches!(c, '\u{FFFE}' | '\u{FFFF}') => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_escaped() {
        assert_eq!(escape("a<b> & \"c\"\u{1}'"), "a&lt;b&gt; &amp; &quot;c&quot; &#39;");
    }

    #[test]
    fn thinning_keeps_peaks_gaps_and_ends() {
        let mut points: Vec<[f64; 2]> = (0..100_000).map(|k| [k as f64, (k as f64 * 0.01).sin()]).collect();
        points[43_210][1] = 50.0;
        points[77_777][1] = -40.0;
        points[60_000][1] = f64::NAN;
        let thin = decimated(&points, 2000);
        assert!(thin.len() <= 2000, "{}", thin.len());
        assert!(thin.contains(&points[43_210]) && thin.contains(&points[77_777]));
        assert!(thin.iter().any(|p| p[0] == 60_000.0 && p[1].is_nan()));
        assert_eq!((thin[0], thin[thin.len() - 1]), (points[0], points[99_999]));
        assert!(thin.windows(2).all(|w| w[0][0] < w[1][0]));
    }

    #[test]
    fn names_stand_apart_and_in_order() {
        let wanted = [100.0, 103.0, 101.0, 10.0, 104.0, 200.0];
        let places = apart(&wanted, 16.0, 0.0, 210.0);
        for i in 0..wanted.len() {
            for j in 0..wanted.len() {
                if wanted[i] < wanted[j] {
                    assert!(places[j] - places[i] >= 16.0 - 1e-9, "{places:?}");
                }
            }
        }
        assert!((places[3] - 10.0).abs() < 1e-9 && (places[5] - 200.0).abs() < 1e-9);
        let crowded = apart(&[205.0, 206.0, 207.0], 16.0, 0.0, 210.0);
        assert_eq!(crowded, [178.0, 194.0, 210.0]);
    }

    #[test]
    fn ranges_without_size_get_one() {
        assert_eq!(range([].into_iter(), false), [0.0, 1.0]);
        assert_eq!(range([0.0, 0.0].into_iter(), true), [0.0, 1.0]);
        assert_eq!(range([4.0].into_iter(), false), [2.0, 6.0]);
        let [low, high] = range([1e308, -1e308].into_iter(), false);
        assert!((high - low).is_finite());
    }
}
