//! What becomes of results that are there when a model is run: they are replaced, continued, or kept.
//!
//! Results of other models, and those that took long, are never replaced without `--force`. Those of the same
//! model file are where the model was edited since. An unfinished run of the same model continues: its bits
//! are the same.

use crate::Failure;
use crate::cli_error::CliError;
use crate::numbers::with_unit;
use crate::recording::in_the_way;
use embate_files::checkpoint::{Identity, Origin};
use embate_files::model_file::{FILE_NAME, Loaded};
use embate_files::program;
use embate_files::results::messages::EXISTS;
use embate_files::results::{Earlier, Provenance, ResultFolder};
use std::path::{Path, PathBuf};

/// Results that took longer are not replaced without `--force`, s.
const LONG: f64 = 600.0;

/// What becomes of what is there.
#[derive(Debug, PartialEq)]
pub(crate) enum InPlace {
    /// Nothing is there, or all goes by `--force`.
    Nothing,
    /// Earlier results go; what they are.
    Replaced(&'static str),
    /// The run continues.
    Continued,
}

/// Refuses results of other models, before this one is read.
pub(crate) fn refuse_others(path: &Path, origin: &Origin, force: bool) -> Result<(), Failure> {
    match Earlier::read(path).map_err(in_the_way)? {
        Some(earlier) if !force => refuse_other(path, origin, &earlier),
        _ => Ok(()),
    }
}

fn refuse_other(path: &Path, origin: &Origin, earlier: &Earlier) -> Result<(), Failure> {
    match &earlier.ran {
        Some(ran) if is_same_file(&ran.origin().path, &origin.path) => Ok(()),
        Some(ran) if !ran.origin().path.as_os_str().is_empty() => {
            let what =
                format!("{} already holds results ({}) of another model, {}", path.display(), earlier.found, ran.origin().path.display());
            Err(refused(&format!("{what}; choose another folder with --out, or replace them with --force")))
        }
        _ => ResultFolder::refuse_existing(path).map_err(in_the_way),
    }
}

/// What is to be done with what is in a folder.
pub(crate) fn decide(path: &Path, origin: &Origin, loaded: &Loaded, force: bool) -> Result<InPlace, Failure> {
    let earlier = match Earlier::read(path).map_err(in_the_way)? {
        Some(earlier) if !force => earlier,
        _ => return Ok(InPlace::Nothing),
    };
    refuse_other(path, origin, &earlier)?;
    let Earlier { ran, end, has_checkpoint, seconds, .. } = &earlier;
    let is_edited = ran.as_ref().is_none_or(|ran| is_edited(ran, loaded));
    let at = path.display();
    let again = match end {
        _ if is_edited => None,
        Some(end) if end.status == "done" => Some("it is done".to_string()),
        Some(end) if end.status == "failed" && !end.is_for_want_of_room() => {
            Some(format!("it failed: {}", end.error.as_deref().unwrap_or("for no reason that is known")))
        }
        Some(end) if loaded.model.run.max_steps.is_some_and(|most| end.steps >= most) => {
            Some("it has done its `run.max_steps`".to_string())
        }
        _ => None,
    };
    if let Some(again) = again {
        let text = format!("{at} already holds results of this model, which is as it was: {again}; run it again with --force");
        return Err(refused(&text));
    }
    if !is_edited && *has_checkpoint {
        return Ok(InPlace::Continued);
    }
    if *seconds > LONG {
        let text = format!(
            "{at} already holds results of an earlier state of this model, which took {}; choose another folder with --out, or \
                replace them with --force",
            with_unit(*seconds, "s")
        );
        return Err(refused(&text));
    }
    Ok(InPlace::Replaced(if is_edited { "results of an earlier state of this model" } else { "results of an unfinished run" }))
}

fn refused(text: &str) -> Failure {
    Failure::Input(CliError::new(&EXISTS, text))
}

/// Whether a model, or the program, is another one than when it ran.
fn is_edited(ran: &Provenance, loaded: &Loaded) -> bool {
    ran.version != program::VERSION || ran.keys != Identity::of(&loaded.model)
}

/// Whether two paths lead to one model file.
fn is_same_file(a: &Path, b: &Path) -> bool {
    let file = |path: &Path| -> PathBuf {
        let file = if path.is_dir() { path.join(FILE_NAME) } else { path.to_path_buf() };
        file.canonicalize().unwrap_or(file)
    };
    file(a) == file(b)
}
