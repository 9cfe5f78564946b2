//! Faults and warnings of a model file as a person reads them: file, line, column, excerpt, and what to do.
//!
//! They come from the parser, the reader, the builder and
//! [`Model::check`](embate_solver::model::Model::check); the texts go to a terminal.

use super::tree::{Node, Place};
use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet, normalize_untrusted_str};
use embate_solver::error::{Fault, Warning};
use embate_solver::message::{Message, SHOWN};
use embate_solver::model::Model;
use std::collections::{BTreeMap, BTreeSet};

/// Lines longer than this are not shown, only named.
const LINE_MAX: usize = 400;

/// All faults of a model file, or all warnings of one that is accepted, ready to show.
#[derive(Clone, Debug)]
pub struct Diagnostics {
    /// Text for a terminal without colours, with file, line, column and excerpt of each fault.
    pub rendered: String,
    /// Number of faults, or of warnings.
    pub count: usize,
    /// They in the order of the text.
    pub entries: Vec<Diagnostic>,
    lines: Vec<Option<Line>>,
    severity: Severity,
}

/// What they are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Severity {
    #[default]
    Fault,
    Warning,
}

/// One fault or warning with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// Its kind.
    pub kind: &'static Message,
    /// File as it was named, or `--set`.
    pub file: String,
    /// Line from 1; 0 when the fault belongs to no line.
    pub line: usize,
    /// Column in characters from 1; 0 when the fault belongs to no line.
    pub column: usize,
    /// Path of the key, such as `part[0].ring.inner`; empty for the whole file.
    pub path: String,
    /// What is wrong.
    pub message: String,
    /// What follows from it, where it is a warning; empty where it is a fault.
    pub consequence: String,
    /// What to do; may be empty.
    pub help: String,
    /// Where in the bodies it is, m, as far as that is known.
    pub places: Vec<[f64; 3]>,
}

/// The line that a fault shows, and the marked bytes in it; no text for a line that is too long to show.
#[derive(Clone, Debug)]
struct Line {
    text: Option<String>,
    start: usize,
    end: usize,
}

/// A text that places refer to.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    pub(crate) name: String,
    pub(crate) text: String,
}

/// A fault or warning on its way.
#[derive(Clone, Debug)]
struct Problem {
    kind: &'static Message,
    path: String,
    message: String,
    consequence: String,
    help: String,
    place: Option<Place>,
    places: Vec<[f64; 3]>,
}

/// Collects faults; knows which paths are faulty already, so that no fault is reported twice.
#[derive(Clone, Debug, Default)]
pub(crate) struct Faults {
    problems: Vec<Problem>,
    covered: BTreeSet<String>,
    severity: Severity,
}

impl Faults {
    /// A fault of the value at `path`; later faults at or under this path are its consequences.
    pub(crate) fn value(&mut self, kind: &'static Message, path: &str, place: Place, wrong: (String, String)) {
        self.cover(path);
        self.beside(kind, path, Some(place), wrong);
    }

    /// A fault that leaves the values at and under `path` meaningful.
    pub(crate) fn beside(&mut self, kind: &'static Message, path: &str, place: Option<Place>, (message, help): (String, String)) {
        self.problems.push(Problem { kind, path: path.to_string(), message, consequence: String::new(), help, place, places: Vec::new() });
    }

    /// A fault that was found in the model, or when a simulation was made of it.
    pub(crate) fn of_model(&mut self, fault: Fault) {
        let Fault { kind, path, message, help, places } = fault;
        self.problems.push(Problem { kind, path, message, consequence: String::new(), help, place: None, places });
    }

    /// Warnings of a model that has no faults.
    pub(crate) fn warnings(warnings: &[Warning]) -> Self {
        let of = |Warning { kind, path, message, consequence, help }: &Warning| Problem {
            kind,
            path: path.clone(),
            message: message.clone(),
            consequence: consequence.clone(),
            help: help.clone(),
            place: None,
            places: Vec::new(),
        };
        Self { problems: warnings.iter().map(of).collect(), severity: Severity::Warning, ..Self::default() }
    }

    /// Whatever is at or under this path is a placeholder.
    pub(crate) fn cover(&mut self, path: &str) {
        self.covered.insert(path.to_string());
    }

    /// Whether the path or something above it is known to be faulty.
    pub(crate) fn covers(&self, path: &str) -> bool {
        let above = path.char_indices().filter(|(_, c)| matches!(c, '.' | '[')).map(|(at, _)| &path[..at]);
        above.chain(std::iter::once(path)).any(|path| self.covered.contains(path))
    }

    /// Faults of the model's mesh, where there are others besides, and `found` of the model, that do not keep
    /// it from being meshed.
    pub(crate) fn of_mesh(&self, model: &Model, found: &[Fault]) -> Vec<Fault> {
        let is_of_parts = |path: &str| path.is_empty() || path.starts_with("part");
        if (self.is_empty() && found.is_empty()) || self.covered.iter().any(|path| is_of_parts(path)) {
            return Vec::new();
        }
        if self.problems.iter().any(|problem| is_of_parts(&problem.path)) { Vec::new() } else { model.check_mesh(found) }
    }

    /// Keeps those that others have too (their kind and path), and that `keeps` wants.
    pub(super) fn keep_shared(&mut self, others: &[Self], keeps: impl Fn(&Message, &str) -> bool) {
        let has = |faults: &Self, it: &Problem| faults.problems.iter().any(|other| (other.kind, &other.path) == (it.kind, &it.path));
        self.problems.retain(|it| keeps(it.kind, &it.path) && others.iter().all(|faults| has(faults, it)));
    }

    /// Counts the items of a list on from `first`: `part[0]` is `part[7]`.
    pub(super) fn renumber(&mut self, list: &str, first: usize) {
        let begin = format!("{list}[");
        for problem in &mut self.problems {
            let number = problem.path.strip_prefix(&begin).and_then(|rest| rest.split_once(']'));
            if let Some((number, rest)) = number.and_then(|(number, rest)| Some((number.parse::<usize>().ok()?, rest))) {
                problem.path = format!("{begin}{}]{rest}", number + first);
            }
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.problems.is_empty()
    }

    /// Whether there are no faults but of one kind.
    pub(crate) fn are_all(&self, kind: &Message) -> bool {
        self.problems.iter().all(|problem| problem.kind == kind)
    }

    /// Gives every fault its place in the text.
    pub(crate) fn into_diagnostics(self, sources: &[Source], root: Option<&Node>) -> Diagnostics {
        let mut problems = self.problems;
        for problem in &mut problems {
            if problem.place.is_none() && !problem.path.is_empty() {
                problem.place = root.map(|root| root.locate(&problem.path)).filter(|place| place.end > place.start);
            }
        }
        problems.sort_by_key(|problem| problem.place);
        let starts: Vec<Vec<usize>> = sources.iter().map(|source| line_starts(&source.text)).collect();
        let (mut entries, mut lines) = (Vec::new(), Vec::new());
        let mut cursor = Cursor::default();
        for problem in problems {
            let source = &sources[problem.place.map_or(0, |place| place.source.min(sources.len() - 1))];
            let found = problem.place.map(|place| cursor.line(&source.text, &starts[place.source.min(sources.len() - 1)], place));
            let (line, column) = found.as_ref().map_or((0, 0), |(line, column, _)| (*line, *column));
            lines.push(found.map(|(.., line)| line));
            entries.push(Diagnostic {
                kind: problem.kind,
                file: source.name.clone(),
                line,
                column,
                path: problem.path,
                message: problem.message,
                consequence: problem.consequence,
                help: problem.help,
                places: problem.places,
            });
        }
        let mut diagnostics = Diagnostics { rendered: String::new(), count: entries.len(), entries, lines, severity: self.severity };
        diagnostics.rendered = diagnostics.render(false);
        diagnostics
    }
}

/// Byte at which each line starts.
fn line_starts(text: &str) -> Vec<usize> {
    std::iter::once(0).chain(text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(at, _)| at + 1)).collect()
}

/// Where columns have been counted to: faults come in the order of the text, so long lines are counted once.
#[derive(Clone, Copy, Debug, Default)]
struct Cursor {
    source: usize,
    /// First byte of the line.
    first: usize,
    /// Byte counted to, and the characters before it in the line.
    byte: usize,
    characters: usize,
}

impl Cursor {
    /// Line and column from 1, and the line's text with the marked bytes.
    fn line(&mut self, text: &str, starts: &[usize], place: Place) -> (usize, usize, Line) {
        let floor = |mut at: usize| {
            at = at.min(text.len());
            while !text.is_char_boundary(at) {
                at -= 1;
            }
            at
        };
        let (start, end) = (floor(place.start), floor(place.end));
        let line = starts.partition_point(|first| *first <= start).max(1);
        let first = starts.get(line - 1).copied().unwrap_or(0);
        let last = starts.get(line).map_or(text.len(), |next| next - 1).max(first);
        let shown = text[first..last].trim_end_matches('\r');
        let start = (start - first).min(shown.len());
        let end = (end.saturating_sub(first)).min(shown.len()).max(start);
        if (self.source, self.first) != (place.source, first) || self.byte > start {
            *self = Self { source: place.source, first, byte: 0, characters: 0 };
        }
        self.characters += shown[self.byte..start].chars().count();
        self.byte = start;
        let text = (shown.len() <= LINE_MAX).then(|| shown.to_string());
        (line, self.characters + 1, Line { text, start, end })
    }
}

impl Diagnostics {
    /// None.
    #[must_use]
    pub(crate) fn none() -> Self {
        Faults::default().into_diagnostics(&[], None)
    }

    /// Faults without a text that they could point into.
    pub(crate) fn plain(kind: &'static Message, file: String, message: String, help: String) -> Self {
        let mut faults = Faults::default();
        faults.beside(kind, "", None, (message, help));
        faults.into_diagnostics(&[Source { name: file, text: String::new() }], None)
    }

    /// Faults of several variants of a model as one list: what is wrong in several is reported once, with the
    /// runs that have it; run 0: no run's fault. `of`: the number of runs.
    pub(crate) fn merged(found: Vec<(usize, Self)>, of: usize) -> Self {
        let mut all = Self { rendered: String::new(), count: 0, entries: Vec::new(), lines: Vec::new(), severity: Severity::Fault };
        let mut runs: Vec<Vec<usize>> = Vec::new();
        let mut known: BTreeMap<(String, usize, usize, String, String), usize> = BTreeMap::new();
        for (run, one) in found {
            for (entry, line) in one.entries.into_iter().zip(one.lines) {
                let identity = (entry.file.clone(), entry.line, entry.column, entry.path.clone(), entry.message.clone());
                let at = *known.entry(identity).or_insert_with(|| {
                    all.entries.push(entry);
                    all.lines.push(line);
                    runs.push(Vec::new());
                    runs.len() - 1
                });
                runs[at].push(run);
            }
        }
        for (entry, runs) in all.entries.iter_mut().zip(&runs) {
            if runs.len() < of && runs != &[0] {
                entry.message.push_str(&format!(" (in {})", named(runs)));
            }
        }
        all.count = all.entries.len();
        all.rendered = all.render(false);
        all
    }

    /// The text for a terminal, coloured if wanted: every fault or warning with its excerpt, at most 20 of
    /// one kind; empty where there is none.
    #[must_use]
    pub fn render(&self, color: bool) -> String {
        let renderer = if color { Renderer::styled() } else { Renderer::plain() }.term_width(160);
        let mut shown: BTreeMap<&str, usize> = BTreeMap::new();
        let mut text = String::new();
        for (entry, line) in self.entries.iter().zip(&self.lines) {
            let count = shown.entry(entry.kind.code).or_default();
            *count += 1;
            if *count <= SHOWN {
                text.push_str(&renderer.render(&[group(entry, line.as_ref(), self.severity)]));
                text.push_str("\n\n");
            }
        }
        for (code, count) in shown.into_iter().filter(|(_, count)| *count > SHOWN) {
            text.push_str(&format!("and {} more of {code}\n", count - SHOWN));
        }
        text.push_str(&match (self.severity, self.count) {
            (Severity::Fault, 1) => "1 fault: nothing was run\n".to_string(),
            (Severity::Fault, count) => format!("{count} faults: nothing was run\n"),
            (Severity::Warning, 0) => String::new(),
            (Severity::Warning, 1) => "1 warning: the model is accepted\n".to_string(),
            (Severity::Warning, count) => format!("{count} warnings: the model is accepted\n"),
        });
        text
    }
}

/// Some runs by their numbers; many: the first, and how many more.
fn named(runs: &[usize]) -> String {
    let shown: Vec<String> = runs.iter().take(4).map(ToString::to_string).collect();
    match (runs.len(), shown.join(", ")) {
        (1, shown) => format!("run {shown}"),
        (count, shown) if count > 4 => format!("runs {shown} and {} more", count - 4),
        (_, shown) => format!("runs {shown}"),
    }
}

fn group<'a>(entry: &'a Diagnostic, line: Option<&'a Line>, severity: Severity) -> Group<'a> {
    let level = match severity {
        Severity::Fault => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let title = level.primary_title(normalize_untrusted_str(&entry.message)).id(entry.kind.code);
    let group = match line.map(|line| (line, &line.text)) {
        Some((line, Some(text))) => {
            let mark = AnnotationKind::Primary.span(line.start..line.end);
            title.element(Snippet::source(text).line_start(entry.line).path(&entry.file).annotation(mark))
        }
        Some((_, None)) => title.element(Origin::path(&entry.file).line(entry.line).char_column(entry.column)),
        None => title.element(Origin::path(&entry.file)),
    };
    let group =
        if entry.consequence.is_empty() { group } else { group.element(Level::NOTE.message(normalize_untrusted_str(&entry.consequence))) };
    if entry.help.is_empty() { group } else { group.element(Level::HELP.message(normalize_untrusted_str(&entry.help))) }
}

impl std::fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.rendered)
    }
}

impl std::error::Error for Diagnostics {}
