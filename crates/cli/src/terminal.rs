//! Standard output and standard error: a reader that goes away is no fault, and a bug is reported as one.

use crate::cli_error::CliError;
use crate::{Failure, version};
use embate_files::results::messages::{BUG, REFUSED};
use std::io::{ErrorKind, Write};

/// Writes `text` to standard output. A closed pipe (`embate list | head`) is fine.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::Run(CliError::new(&REFUSED, format!("can't write to standard output: {error}"))))
        }
        _ => Ok(()),
    }
}

/// Writes `text` to standard error, where nothing can be done when it fails.
pub(crate) fn report_error(text: &str) {
    let end = if text.ends_with('\n') { "" } else { "\n" };
    let _ = write!(std::io::stderr().lock(), "{text}{end}");
}

/// From now on a panic becomes a message that says what to do with it.
pub(crate) fn announce_bugs() {
    std::panic::set_hook(Box::new(|panic| {
        let payload = panic.payload();
        let text = payload.downcast_ref::<&str>().copied().or_else(|| payload.downcast_ref::<String>().map(String::as_str));
        let place = panic.location().map(|l| format!(" at {}:{}", l.file(), l.line())).unwrap_or_default();
        let what = format!("this is a bug in embate {}: {}{place}", version::short(), text.unwrap_or("unknown"));
        report_error(&CliError::new(&BUG, what).help("please report it with this message, the command and the model file").to_string());
    }));
}
