//! The report of a verification: every check with its reference, what was found and the verdict, and plots,
//! as one HTML file or as Markdown with pictures beside it.
//!
//! Outcomes come from `judge.rs`, what is drawn from `plot.rs`. The Markdown has no times and no dates: it
//! changes when results change.

use super::judge::{CaseOutcome, CheckOutcome};
use super::plot::{Mark, Plot};
use crate::picture::colour::{DISTINCT, Rgb};
use crate::picture::svg::{Abscissa, Curve, Group, Panel, Spacing, chart};
use crate::plain;
use crate::report::html;
use crate::results::{ResultsError, write_whole};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

/// In which form a report is written; the end of its file's name reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// `.html`: one file with everything in it.
    Html,
    /// `.md`: pictures lie in a folder beside it that has its name.
    Markdown,
}

impl Form {
    /// The form that a file's name asks for.
    #[must_use]
    pub fn of(file: &Path) -> Option<Self> {
        match file.extension()?.to_str()? {
            "html" => Some(Self::Html),
            "md" => Some(Self::Markdown),
            _ => None,
        }
    }
}

/// How the cases were run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct About {
    /// Program with its version.
    pub program: String,
    /// Instruction set and threads.
    pub machine: String,
    /// Wall time of each case, s.
    pub seconds: Vec<f64>,
}

const MEASURE: &str = "error, as a share of what is accepted";
const HEAD: [&str; 7] = ["check", "model", "expected", "found", "error", "verdict", "where the value and the tolerance come from"];
const REFERENCE: Rgb = [30, 30, 30];
const ACCEPTED: Rgb = [150, 150, 150];
/// Shares larger than this are drawn here.
const SHARE_MAX: f64 = 3.0;
const PANEL: f64 = 150.0;

/// Writes the report in the form that the file's name asks for; `cases` is the folder of the cases, to which
/// Markdown links.
///
/// # Errors
/// What the system says.
pub fn write(file: &Path, outcomes: &[CaseOutcome], about: &About, cases: &Path) -> Result<(), ResultsError> {
    let above = file.parent().unwrap_or(Path::new(""));
    if !above.as_os_str().is_empty() {
        fs::create_dir_all(above).map_err(ResultsError::file("make", above))?;
    }
    if Form::of(file) == Some(Form::Html) {
        return write_whole(file, page(outcomes, about).as_bytes());
    }
    let pictures = file.with_extension("");
    let folder = pictures.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    for outcome in outcomes {
        if let Some(svg) = drawing(outcome) {
            plain::folder(&pictures).map_err(ResultsError::file("make", &pictures))?;
            write_whole(&pictures.join(format!("{}.svg", outcome.case)), svg.as_bytes())?;
        }
    }
    write_whole(file, markdown(outcomes, about, &folder, &way(above, cases)).as_bytes())
}

/// The way from one folder to another, with slashes.
fn way(from: &Path, to: &Path) -> String {
    let whole = |path: &Path| {
        fs::canonicalize(if path.as_os_str().is_empty() { Path::new(".") } else { path }).unwrap_or_else(|_| PathBuf::from(path))
    };
    let (from, to) = (whole(from), whole(to));
    let common = from.components().zip(to.components()).take_while(|(one, other)| one == other).count();
    let up = from.components().skip(common).map(|_| "..".to_string());
    let down = to.components().skip(common).map(|part| part.as_os_str().to_string_lossy().into_owned());
    up.chain(down).collect::<Vec<_>>().join("/")
}

/// The report as the text of an HTML file.
#[must_use]
pub fn page(outcomes: &[CaseOutcome], about: &About) -> String {
    let mut body = format!(
        "<h1>Verification</h1>\n{}{}",
        html::paragraph(&summary(outcomes)),
        html::paragraph(&format!("{}; {}.", about.program, about.machine))
    );
    let mut rows = String::new();
    for (index, outcome) in outcomes.iter().enumerate() {
        let [case, title] = [&outcome.case, &outcome.title].map(|text| html::escape(text));
        let seconds = about.seconds.get(index).map_or(String::new(), |seconds| format!("{seconds:.1} s"));
        let class = if outcome.passed() { "good" } else { "bad" };
        let cells =
            [outcome.checks.len().to_string(), largest(outcome), seconds].map(|cell| format!("<td class=\"n\">{cell}</td>")).concat();
        let _ = writeln!(
            rows,
            "<tr><td><a href=\"#{case}\">{case}</a></td><td>{title}</td>{cells}<td class=\"{class}\">{}</td></tr>",
            verdict(outcome)
        );
    }
    let head = ["case", "what it is", "checks", "largest share", "time", "verdict"];
    let head: String = head
        .iter()
        .enumerate()
        .map(|(k, cell)| format!("<th scope=\"col\"{}>{cell}</th>", if (2..5).contains(&k) { " class=\"n\"" } else { "" }))
        .collect();
    let _ = writeln!(body, "<div class=\"scroll\"><table><thead><tr>{head}</tr></thead><tbody>\n{rows}</tbody></table></div>");
    let _ = write!(body, "{}", html::paragraph(&format!("The largest share is the largest {MEASURE}, of all checks of the case.")));
    for outcome in outcomes {
        let rows: Vec<Vec<String>> = outcome.checks.iter().map(row).collect();
        let plot =
            drawing(outcome).map_or(String::new(), |svg| html::plot(&svg, &format!("checks of {}", outcome.case), &caption(outcome)));
        let section =
            html::section(&format!("{}: {}", outcome.case, outcome.title), &format!("{plot}{}", html::table(&HEAD, &rows, usize::MAX)));
        body.push_str(&section.replacen("<section>", &format!("<section id=\"{}\">", html::escape(&outcome.case)), 1));
    }
    html::page("Verification", &body)
}

/// The report as Markdown; `pictures` is the folder of the pictures, `cases` that of the cases, both as seen
/// from the file.
#[must_use]
pub fn markdown(outcomes: &[CaseOutcome], about: &About, pictures: &str, cases: &str) -> String {
    let mut out = format!("# Verification: results\n\n{} Made by {} (`embate verify --report`).\n\n", summary(outcomes), about.program);
    let _ = writeln!(out, "| case | what it is | checks | largest share | verdict |\n|---|---|---|---|---|");
    for outcome in outcomes {
        let _ = writeln!(
            out,
            "| [{0}](#{0}) | {1} | {2} | {3} | {4} |",
            outcome.case,
            cell(&outcome.title),
            outcome.checks.len(),
            largest(outcome),
            verdict(outcome)
        );
    }
    let _ = writeln!(out, "\nThe largest share is the largest {MEASURE}, of all checks of the case.");
    for outcome in outcomes {
        let _ = writeln!(out, "\n## {}\n\n{}: [the case]({cases}/{}/README.md).", outcome.case, cell(&outcome.title), outcome.case);
        if !groups(outcome).is_empty() {
            let _ = writeln!(out, "\n![{}]({pictures}/{}.svg)", caption(outcome), outcome.case);
        }
        let _ = writeln!(out, "\n| {} |\n|{}", HEAD.join(" | "), "---|".repeat(HEAD.len()));
        for check in &outcome.checks {
            let cells: Vec<String> = row(check).iter().map(|text| cell(text)).collect();
            let _ = writeln!(out, "| {} |", cells.join(" | "));
        }
    }
    out
}

/// A text within a table of Markdown.
fn cell(text: &str) -> String {
    ["|", "*", "<", "`"].iter().fold(text.replace('\\', "\\\\"), |text, sign| text.replace(sign, &format!("\\{sign}")))
}

fn summary(outcomes: &[CaseOutcome]) -> String {
    let checks = || outcomes.iter().flat_map(|outcome| &outcome.checks);
    let failed: Vec<&str> = outcomes.iter().filter(|outcome| !outcome.passed()).map(|outcome| outcome.case.as_str()).collect();
    let count = checks().count();
    if failed.is_empty() {
        format!("All {count} checks of {} cases hold.", outcomes.len())
    } else {
        format!("{} of {count} checks fail, in {}.", checks().filter(|check| !check.passed).count(), failed.join(", "))
    }
}

fn verdict(outcome: &CaseOutcome) -> &'static str {
    if outcome.passed() { "holds" } else { "FAILS" }
}

/// The largest share of what is accepted.
fn largest(outcome: &CaseOutcome) -> String {
    let shares = outcome.checks.iter().filter_map(CheckOutcome::share);
    shares.reduce(f64::max).map_or("-".to_string(), |share| format!("{share:.2}"))
}

fn row(check: &CheckOutcome) -> Vec<String> {
    vec![
        check.check.clone(),
        check.model.clone(),
        check.expectation(),
        check.finding(),
        check.error(),
        check.verdict(),
        check.reason.clone(),
    ]
}

fn caption(outcome: &CaseOutcome) -> String {
    if outcome.plots.is_empty() {
        "Errors of the checks".to_string()
    } else {
        "Errors of the checks, and what was found over time beside what is expected (black)".to_string()
    }
}

/// Errors of all checks, and the columns that they look at with what is expected; `None` where there is
/// nothing to draw.
#[must_use]
pub fn drawing(outcome: &CaseOutcome) -> Option<String> {
    let groups = groups(outcome);
    (!groups.is_empty()).then(|| chart(&outcome.title, &groups))
}

fn groups(outcome: &CaseOutcome) -> Vec<Group> {
    let over_time = (!outcome.plots.is_empty()).then(|| Group::over_time(outcome.plots.iter().map(panel).collect()));
    errors(&outcome.checks).into_iter().chain(over_time).collect()
}

fn curve(name: &str, colour: Rgb, width: f64, points: Vec<[f64; 2]>) -> Curve {
    Curve { name: name.to_string(), colour, dashes: "", width, dots: width == 0.0, points }
}

/// A dot for each check.
fn errors(checks: &[CheckOutcome]) -> Option<Group> {
    let shares: Vec<(bool, [f64; 2])> = checks
        .iter()
        .enumerate()
        .filter_map(|(index, check)| Some((check.passed, [index as f64 + 1.0, check.share()?.min(SHARE_MAX)])))
        .collect();
    let [first, last] = [shares.first()?.1[0], shares.last()?.1[0]];
    let of = |passed: bool| shares.iter().filter(|(holds, _)| *holds == passed).map(|(_, point)| *point).collect::<Vec<_>>();
    let mut curves = vec![Curve { dashes: "6 4", ..curve("accepted", REFERENCE, 1.0, vec![[first - 0.5, 1.0], [last + 0.5, 1.0]]) }];
    curves.push(curve("", DISTINCT[0], 0.0, of(true)));
    curves.push(curve("", DISTINCT[1], 0.0, of(false)));
    curves.retain(|curve| !curve.points.is_empty());
    let without = checks.len() - shares.len();
    let remark = if without == 0 { String::new() } else { format!("without such a measure: {without}") };
    let abscissa = Abscissa { name: "number of the check in the table".into(), si: String::new(), spacing: Spacing::Even };
    Some(Group { abscissa, panels: vec![Panel { name: MEASURE.to_string(), si: "", from_zero: true, height: PANEL, curves, remark }] })
}

/// A column of the history in several models, and what is expected of it.
fn panel(plot: &Plot) -> Panel {
    let mut curves: Vec<Curve> =
        plot.curves.iter().zip(DISTINCT.iter()).map(|((model, points), colour)| curve(model, *colour, 1.5, points.clone())).collect();
    for mark in &plot.marks {
        curves.extend(drawn(mark));
    }
    Panel { name: plot.column.clone(), si: plot.si, from_zero: false, height: PANEL, curves, remark: String::new() }
}

/// An expected value: a black line, or a dot, and what is accepted on both sides in grey.
fn drawn(mark: &Mark) -> Vec<Curve> {
    let [begin, end] = mark.ends;
    if begin == end {
        let accepted = curve("", ACCEPTED, 3.0, vec![[begin[0], begin[1] - mark.tolerance], [begin[0], begin[1] + mark.tolerance]]);
        return vec![accepted, curve("", REFERENCE, 0.0, vec![begin])];
    }
    let shifted = |by: f64| mark.ends.map(|[time, value]| [time, value + by]).to_vec();
    let accepted = [-mark.tolerance, mark.tolerance]
        .into_iter()
        .filter(|by| *by != 0.0)
        .map(|by| Curve { dashes: "3 3", ..curve("", ACCEPTED, 1.0, shifted(by)) });
    accepted.chain([curve("", REFERENCE, 2.0, mark.ends.to_vec())]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outcome(passed: bool) -> CaseOutcome {
        let check = CheckOutcome {
            check: "force | <b>".into(),
            model: "model".into(),
            passed,
            found: Some(if passed { 1.005 } else { 1.2 }),
            expected: Some(1.0),
            tolerance: Some(0.01),
            deviation: Some(if passed { 0.005 } else { 0.2 }),
            relative: true,
            reason: "F = ρ c v".into(),
            ..CheckOutcome::default()
        };
        let mark = Mark { ends: [[0.2, 1.0], [0.8, 1.0]], tolerance: 0.01 };
        let plot = Plot {
            column: "contact.force_x[ends]".into(),
            si: "N/m",
            curves: vec![("model".into(), vec![[0.0, 0.0], [1.0, 1.0]])],
            marks: vec![mark],
        };
        CaseOutcome { case: "two-bars".into(), title: "Two bars".into(), checks: vec![check], plots: vec![plot] }
    }

    fn about() -> About {
        About { program: "embate 0.0.0".into(), machine: "scalar, 1 thread".into(), seconds: vec![1.26] }
    }

    #[test]
    fn a_page_has_every_figure_and_escapes_what_comes_from_files() {
        let text = page(&[outcome(true)], &about());
        for part in [
            "All 1 checks of 1 cases hold.",
            "embate 0.0.0",
            "1.3 s",
            "<a href=\"#two-bars\">",
            "force | &lt;b&gt;",
            "1 ± 1.00 %",
            "1.005",
            "0.50 %",
            "F = ρ c v",
            "0.50</td>",
            "<svg",
        ] {
            assert!(text.contains(part), "{part} is missing in\n{text}");
        }
        assert!(!text.contains("<b>"));
    }

    #[test]
    fn what_fails_is_said_at_the_top_and_in_its_row() {
        let text = page(&[outcome(true), outcome(false)], &about());
        assert!(text.contains("1 of 2 checks fail, in two-bars.") && text.contains("FAILS") && text.contains("20.00"), "{text}");
        assert!(markdown(&[outcome(false)], &about(), "p", "c").contains("| FAILS |"));
    }

    #[test]
    fn markdown_has_no_times_and_leads_to_the_case_and_its_picture() {
        let text = markdown(&[outcome(true)], &about(), "results", "../verification");
        assert!(text.contains("(../verification/two-bars/README.md)") && text.contains("(results/two-bars.svg)"), "{text}");
        assert!(text.contains("force \\| \\<b>") && !text.contains("1.3 s"), "{text}");
    }

    #[test]
    fn shares_say_how_near_the_border_is() {
        let limit = |found, at_least, at_most| CheckOutcome { found: Some(found), at_least, at_most, ..CheckOutcome::default() }.share();
        assert_eq!(outcome(true).checks[0].share(), Some(0.5));
        assert_eq!(limit(0.5, None, Some(2.0)), Some(0.25));
        assert_eq!(limit(-0.5, None, Some(2.0)), Some(0.0));
        assert_eq!(limit(4.0, Some(1.0), None), Some(0.25));
        assert_eq!(limit(0.0, Some(1.0), None), None);
        assert_eq!(limit(1.0, Some(0.5), Some(2.0)), None);
    }

    #[test]
    fn expected_values_and_curves_are_drawn() {
        let svg = drawing(&outcome(true)).unwrap();
        assert!(svg.contains("contact.force_x[ends] [N/m]") && svg.contains(&MEASURE.to_string()) && svg.contains("time [s]"), "{svg}");
        let silent = CaseOutcome { checks: vec![CheckOutcome::default()], plots: Vec::new(), ..outcome(true) };
        assert_eq!(drawing(&silent), None);
    }

    #[test]
    fn ways_lead_up_and_down() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        fs::create_dir_all(folder.join("docs/deep")).unwrap();
        fs::create_dir_all(folder.join("verification")).unwrap();
        assert_eq!(way(&folder.join("docs/deep"), &folder.join("verification")), "../../verification");
        assert_eq!(way(folder, &folder.join("verification")), "verification");
    }
}
