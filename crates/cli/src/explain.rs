//! `embate explain`: what a message is, how it comes about, and what to do.

use crate::cli_error::CliError;
use crate::messages::{MESSAGES, NO_CODE};
use crate::numbers::table;
use crate::{Failure, terminal};
use clap::Args;
use embate_files::messages;
use embate_solver::message::{AREAS, Message};
use embate_solver::vocabulary::nearest;

/// Which message.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Code of a message, such as E0110 [default: list all]
    code: Option<String>,
}

pub(crate) fn explain(arguments: &Arguments) -> Result<(), Failure> {
    let all = catalogue();
    let Some(code) = &arguments.code else { return terminal::print(&listed(&all)) };
    let wanted = code.trim().to_uppercase();
    if let Some(message) = all.iter().find(|message| message.code == wanted) {
        return terminal::print(&format!("{}\n\n{}\n", message.code, messages::entry(message)));
    }
    let near = nearest(&wanted, all.iter().map(|message| message.code));
    let help = near.map_or("`embate explain` lists all codes".to_string(), |near| format!("did you mean {near}?"));
    Err(Failure::Input(CliError::new(&NO_CODE, format!("there is no message `{code}`")).help(help)))
}

/// Every message that the program has, by code.
fn catalogue() -> Vec<&'static Message> {
    let mut all = messages::all();
    all.extend(MESSAGES);
    all.sort_by_key(|message| message.code);
    all
}

fn listed(all: &[&Message]) -> String {
    let mut text = String::new();
    for (digits, area) in AREAS {
        let rows = all.iter().filter(|message| message.code.get(1..3) == Some(digits));
        let rows: Vec<Vec<String>> = rows.map(|message| vec![message.code.to_string(), message.title.to_string()]).collect();
        text.push_str(&format!("{area}\n{}", table(&rows, "  ")));
    }
    text
}
