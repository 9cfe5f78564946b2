//! The program Gmsh: it is started as it is, without a shell, and stopped where it takes too long.

use super::messages::{GMSH_FAILED, NO_GMSH};
use embate_solver::error::Fault;
use std::ffi::OsStr;
use std::fs::File;
use std::io;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// What it says goes into this file of its folder.
const LOG: &str = "log.txt";
/// How often it is looked whether it has ended.
const LOOK: Duration = Duration::from_millis(20);
/// So many lines of what it said are shown.
const LINES: usize = 5;

/// The program, and how long it may take.
pub(super) struct Gmsh<'a> {
    pub(super) program: &'a OsStr,
    pub(super) limit: Duration,
}

impl Gmsh<'_> {
    /// Runs it in a folder; what it said.
    pub(super) fn run(&self, folder: &Path, arguments: &[&str]) -> Result<String, Fault> {
        let shown = Path::new(self.program).display();
        let log = File::create(folder.join(LOG)).and_then(|log| Ok((log.try_clone()?, log)));
        let (out, err) = log
            .map_err(|error| Fault::new(&GMSH_FAILED, "", format!("can't write into {}: {error}", folder.display()), "make room there"))?;
        // It starts in another folder, where a path from here leads nowhere.
        let program = Path::new(self.program);
        let is_path = program.components().count() > 1;
        let program = if is_path { program.canonicalize().unwrap_or_else(|_| program.to_path_buf()) } else { program.to_path_buf() };
        let mut command = Command::new(program);
        command.args(arguments).current_dir(folder).stdin(Stdio::null()).stdout(out).stderr(err);
        let mut child = command.spawn().map_err(|error| {
            let what = match error.kind() {
                io::ErrorKind::NotFound => "there is no such program".to_string(),
                _ => error.to_string(),
            };
            let help = "install Gmsh (https://gmsh.info, the package `gmsh` of the system, or `pip install gmsh`), or name the program with --gmsh \
                        or in EMBATE_GMSH";
            Fault::new(&NO_GMSH, "", format!("Gmsh, which makes the mesh, can't be started as `{shown}`: {what}"), help)
        })?;
        let status = wait(&mut child, self.limit);
        let said_so_far = || std::fs::read(folder.join(LOG)).map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).unwrap_or_default();
        match status {
            Ok(Some(status)) if status.success() => Ok(said_so_far()),
            Ok(Some(status)) => {
                let text = said_so_far();
                let message = format!("`{shown}` failed ({status}){}", said(&text));
                Err(Fault::new(&GMSH_FAILED, "", message, remedy(&text)))
            }
            Ok(None) => {
                let message = format!("`{shown}` was stopped after {} s{}", self.limit.as_secs_f64(), said(&said_so_far()));
                Err(Fault::new(&GMSH_FAILED, "", message, "take a larger --size, or allow more time with --timeout"))
            }
            Err(error) => Err(Fault::new(&GMSH_FAILED, "", format!("`{shown}` can't be waited for: {error}"), "try again")),
        }
    }
}

/// Waits until a program ends; one that takes too long is ended, `None`.
fn wait(child: &mut Child, limit: Duration) -> io::Result<Option<ExitStatus>> {
    let begin = Instant::now();
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        if begin.elapsed() >= limit {
            // It may have ended in between.
            let _ = child.kill();
            child.wait()?;
            return Ok(None);
        }
        std::thread::sleep(LOOK);
    }
}

/// What to do, by what it said.
fn remedy(log: &str) -> &'static str {
    if log.contains("cannot open shared object file") {
        "Gmsh lacks a library of the system: install the one that it names (on Debian libglu1-mesa, libxcursor1, libxft2, libxinerama1, libgomp1)"
    } else if log.contains("ModuleNotFoundError") {
        "the script belongs to a Python without the package gmsh: `pip install gmsh` again, and activate its environment"
    } else {
        "read what Gmsh says; --size larger than the smallest faces, or a newer Gmsh, may help"
    }
}

/// The lines that say what went wrong, for the end of a message.
pub(super) fn said(log: &str) -> String {
    let lines: Vec<&str> = log.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    let errors: Vec<&str> = lines.iter().copied().filter(|line| line.contains("Error")).collect();
    let chosen = if errors.is_empty() { &lines[lines.len().saturating_sub(LINES)..] } else { &errors[..errors.len().min(LINES)] };
    let plain = |line: &&str| line.chars().filter(|c| !c.is_control()).take(300).collect::<String>();
    chosen.iter().map(plain).fold(String::new(), |text, line| format!("{text}\n  | {line}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_shown_before_other_lines_and_few_of_them() {
        assert_eq!(said(""), "");
        assert_eq!(said("one\n\n two \x1b[1m\n"), "\n  | one\n  | two [1m");
        assert_eq!(said("Info: a\nError   : b\nInfo: c"), "\n  | Error   : b");
        assert_eq!(said(&"line\n".repeat(50)).lines().count(), 1 + LINES);
    }
}
