//! What the program says on standard error when something is wrong: each message with its code, at most 20 of
//! a kind.
//!
//! Kinds come from the catalogue; a failure of a command is made of these and of nothing else, so that none
//! is without a code.

use embate_files::model_file::Diagnostics;
use embate_solver::error::{Error, Fault, Notice};
use embate_solver::message::{Message, SHOWN};
use std::collections::BTreeMap;
use std::fmt;

/// The text of a failure or warning.
#[derive(Debug)]
pub(crate) struct CliError(String);

impl CliError {
    pub(crate) fn new(kind: &Message, text: impl fmt::Display) -> Self {
        Self(format!("{kind}: {text}"))
    }

    /// With a line of help.
    pub(crate) fn help(self, help: impl fmt::Display) -> Self {
        Self(format!("{}\n  help: {help}", self.0))
    }

    /// With a line after it.
    pub(crate) fn and(self, line: impl fmt::Display) -> Self {
        Self(format!("{}\n{line}", self.0.trim_end()))
    }

    /// With a line before it.
    pub(crate) fn under(self, line: impl fmt::Display) -> Self {
        Self(format!("{line}\n{}", self.0))
    }
}

impl fmt::Display for CliError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl From<&Diagnostics> for CliError {
    fn from(diagnostics: &Diagnostics) -> Self {
        Self(diagnostics.rendered.clone())
    }
}

impl From<&Notice> for CliError {
    fn from(notice: &Notice) -> Self {
        Self::new(notice.kind, &notice.text)
    }
}

/// One paragraph for each fault of a model.
impl From<&Error> for CliError {
    fn from(error: &Error) -> Self {
        match (error, error.kind()) {
            (_, Some(kind)) => Self::new(kind, error),
            (Error::Model(faults), _) => Self(paragraphs(faults)),
            (other, None) => Self(other.to_string()),
        }
    }
}

impl From<&[Fault]> for CliError {
    fn from(faults: &[Fault]) -> Self {
        Self(paragraphs(faults))
    }
}

fn paragraphs(faults: &[Fault]) -> String {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    let mut lines = Vec::new();
    for fault in faults {
        let count = counts.entry(fault.kind.code).or_default();
        *count += 1;
        if *count <= SHOWN {
            let place = if fault.path.is_empty() { String::new() } else { format!("{}: ", fault.path) };
            let cli_error = CliError::new(fault.kind, format!("{place}{}", fault.message));
            lines.push(if fault.help.is_empty() { cli_error.0 } else { cli_error.help(&fault.help).0 });
        }
    }
    let hidden = counts.into_iter().filter(|(_, count)| *count > SHOWN);
    lines.extend(hidden.map(|(code, count)| format!("and {} more of {code}", count - SHOWN)));
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use embate_solver::model::messages::{RANGE, UNKNOWN_NAME};

    #[test]
    fn every_fault_is_reported_with_its_code_and_help() {
        let faults = [Fault::new(&RANGE, "run.end", "is 0", "give a time"), Fault::new(&UNKNOWN_NAME, "", "no parts", "")];
        let reported = "error[E0110]: run.end: is 0\n  help: give a time\nerror[E0116]: no parts";
        assert_eq!(CliError::from(&Error::Model(faults.to_vec())).to_string(), reported);
    }

    #[test]
    fn of_each_code_twenty_are_shown_and_the_rest_is_counted() {
        let mut faults: Vec<Fault> = (0..57).map(|k| Fault::new(&RANGE, format!("part[{k}]"), "is 0", "")).collect();
        faults.push(Fault::new(&UNKNOWN_NAME, "", "no parts", ""));
        let reported = CliError::from(faults.as_slice()).to_string();
        assert_eq!(reported.matches("error[E0110]").count(), 20);
        assert!(reported.ends_with("error[E0116]: no parts\nand 37 more of E0110"), "{reported}");
    }
}
