//! The catalogue of messages of solver and formats, and the page `docs/messages.md` that is made from it.
//!
//! Entries stand beside the code that raises them ([`embate_solver::message`]); the program adds its own and
//! prints them (`embate explain`).

use crate::{abaqus, cad, checkpoint, gmsh, model_file, results, stl, sweep, verification};
use embate_solver::catalogue;
use embate_solver::message::{AREAS, BASE, Example, Message, SHOWN};
use std::fmt::Write;

/// All entries of the solver and of the formats, by code.
#[must_use]
pub fn all() -> Vec<&'static Message> {
    let scratch_pool = [
        model_file::messages::MESSAGES,
        gmsh::messages::MESSAGES,
        stl::messages::MESSAGES,
        abaqus::messages::MESSAGES,
        cad::messages::MESSAGES,
        results::messages::MESSAGES,
        checkpoint::messages::MESSAGES,
        sweep::messages::MESSAGES,
        verification::messages::MESSAGES,
    ];
    let mut all: Vec<&Message> = catalogue::all().into_iter().chain(scratch_pool.iter().copied().flatten().copied()).collect();
    all.sort_by_key(|message| message.code);
    all
}

/// The page of a catalogue.
#[must_use]
pub fn markdown(all: &[&Message]) -> String {
    let mut page = format!(
        "# Messages\n\n\
         Every error and warning has a code that stays the same from version to version. `embate explain CODE` prints an entry of this page, `embate explain` lists all codes.\n\
         A message says what is wrong, where, and what to do about this case; the entry says how such a thing comes about. Of each code at most {SHOWN} messages are shown, the rest is counted.\n\n\
         This page is made from the catalogue in the program (`EMBATE_BLESS=1 cargo test -p embate --test all messages`). Examples are run by tests, all but those in words. Those in TOML are lines that take the\n\
         place of those of this sound model, unless the entry says that they are a whole file; commands find it as `model.toml`:\n\n\
         ```toml\n{BASE}```\n"
    );
    for (digits, area) in AREAS {
        let of_area: Vec<&&Message> = all.iter().filter(|message| message.code.get(1..3) == Some(digits)).collect();
        if of_area.is_empty() {
            continue;
        }
        // A page that is written into a text can't fail.
        let _ = write!(page, "\n## {area}\n\n| code | what it is |\n|---|---|\n");
        for message in &of_area {
            let _ = writeln!(page, "| [{0}](#{1}) | {2} |", message.code, message.code.to_lowercase(), message.title);
        }
        for message in of_area {
            let _ = write!(page, "\n### {}\n\n{}\n", message.code, entry(message));
        }
    }
    page
}

/// One entry as text that is also Markdown, without its code.
#[must_use]
pub fn entry(message: &Message) -> String {
    let fenced = |head: &str, kind: &str, text: &str| format!("{head}\n\n```{kind}\n{text}```\n");
    let example = match message.example {
        Example::Model(text) => fenced("For example:", "toml", text),
        Example::File(text) => fenced("For example, a whole model file:", "toml", text),
        Example::Gmsh(text) => fenced("For example, a mesh file:", "text", text),
        Example::Deck(text) => fenced("For example, a deck:", "text", text),
        Example::Command(text) => fenced("For example:", "text", &format!("embate {text}\n")),
        Example::Shell(text) => fenced("For example, in a shell:", "sh", text),
        Example::Words(text) => format!("For example: {text}\n"),
    };
    format!("**{}.**\n{}\n\n{example}\nWhat to do: {}", upper(message.title), message.cause, message.remedy)
}

fn upper(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or(String::new(), |first| first.to_uppercase().chain(chars).collect())
}
