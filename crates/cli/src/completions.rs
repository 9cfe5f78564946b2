//! `embate completions`: what a shell needs to complete the command line.

use crate::{Failure, terminal};
use clap::Args;
use clap_complete::Shell;

/// For which shell.
#[derive(Args)]
pub(crate) struct Arguments {
    /// The shell
    shell: Shell,
}

pub(crate) fn completions(arguments: &Arguments, mut command: clap::Command) -> Result<(), Failure> {
    let mut text = Vec::new();
    clap_complete::generate(arguments.shell, &mut command, "embate", &mut text);
    terminal::print(&String::from_utf8_lossy(&text))
}
