//! What became of each keyword of a deck: used, approximated, ignored. Nothing is left out without a message.

use std::collections::BTreeMap;
use std::fmt::Write;

/// What became of a keyword or one of its parameters or lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Outcome {
    /// It does not act.
    Ignored,
    /// It acts, but not quite as in the deck.
    Approximated,
    /// It acts as in the deck.
    Used,
}

/// One line of the report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// What became of it.
    pub outcome: Outcome,
    /// Keyword without the star.
    pub keyword: String,
    /// File and line.
    pub place: String,
    /// What differs, or what follows; may be empty where it is used.
    pub text: String,
}

/// The report of an import.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// Opening lines: deck and units.
    pub(super) opening: String,
    /// In the order of the deck.
    pub entries: Vec<Entry>,
}

impl Report {
    /// Whether something does not act.
    #[must_use]
    pub fn has_ignored(&self) -> bool {
        self.entries.iter().any(|entry| entry.outcome == Outcome::Ignored)
    }

    /// The report as a text.
    #[must_use]
    pub fn text(&self) -> String {
        let mut out = self.opening.clone();
        for (outcome, title) in
            [(Outcome::Ignored, "ignored: does not act in the model"), (Outcome::Approximated, "approximated: acts, but differs")]
        {
            let entries: Vec<&Entry> = self.entries.iter().filter(|entry| entry.outcome == outcome).collect();
            if !entries.is_empty() {
                let _ = writeln!(out, "\n{title}");
            }
            for entry in entries {
                let _ = writeln!(out, "  *{} ({}): {}", entry.keyword, entry.place, entry.text);
            }
        }
        let mut used: BTreeMap<(&str, &str), Vec<&str>> = BTreeMap::new();
        for entry in self.entries.iter().filter(|entry| entry.outcome == Outcome::Used) {
            used.entry((&entry.keyword, &entry.text)).or_default().push(&entry.place);
        }
        if !used.is_empty() {
            out.push_str("\nused\n");
        }
        for ((keyword, text), places) in used {
            let more = if places.len() > 1 { format!(" and {} more", places.len() - 1) } else { String::new() };
            let text = if text.is_empty() { String::new() } else { format!(": {text}") };
            let _ = writeln!(out, "  *{keyword} ({}{more}){text}", places[0]);
        }
        if !self.has_ignored() {
            out.push_str("\nnothing was ignored\n");
        }
        out
    }
}
