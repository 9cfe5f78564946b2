//! How the page of a run is shown: its address, and who opens it. `view` shows results, `run` and `resume` a
//! run that continues.

use crate::cli_error::CliError;
use crate::interrupt::Interrupt;
use crate::messages::NO_PAGE;
use crate::view::wait;
use crate::{Failure, terminal};
use clap::Args;
use embate_files::results::{Appearance, History, Report, RunStatus};
use embate_files::view::{Bodies, ResultView};
use embate_solver::model::Model;
use embate_solver::simulation::Simulation;
use embate_viewer::{Address, Content, Ended, Live, Server};
use std::net::{IpAddr, Ipv4Addr};
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

/// Where the page is.
#[derive(Args)]
pub(crate) struct Page {
    /// Port of the page [default: a free one]
    #[arg(long, value_name = "PORT", default_value_t = 0, hide_default_value = true)]
    port: u16,
    /// What the address of the page must hold: 16 or more letters and digits [default: one that no one can
    /// guess]
    #[arg(long, value_name = "TEXT")]
    token: Option<String>,
    /// Address to listen on; others than this machine can ask if it is not 127.0.0.1
    #[arg(long, value_name = "ADDRESS", default_value_t = IpAddr::V4(Ipv4Addr::LOCALHOST))]
    listen: IpAddr,
    /// Only print the address, open no browser
    #[arg(long)]
    no_open: bool,
    /// What the page shows first: what stands behind # in a link of it
    #[arg(long, value_name = "VIEW", default_value = "", hide_default_value = true)]
    view: String,
}

impl Page {
    /// Starts the server, reports its address and opens it.
    pub(crate) fn show(&self, content: Content) -> Result<Server, Failure> {
        let address = Address { host: self.listen, port: self.port, token: self.token.clone() };
        let view = self.view.strip_prefix('#').unwrap_or(&self.view);
        let server = Server::start(content, view, &address).map_err(|error| Failure::Input(CliError::new(&NO_PAGE, error)))?;
        terminal::report_error(&format!("page: {}", server.url()));
        if !self.listen.is_loopback() {
            terminal::report_error("others on the network can open it, too, if they know this address: it is not encrypted");
        }
        if !self.no_open && !server.open() {
            terminal::report_error("no browser could be opened: open the address yourself");
        }
        Ok(server)
    }
}

/// A folder and what was found in it.
pub(crate) type ShownRun = (std::path::PathBuf, Result<ResultView, embate_files::results::ResultsError>);

/// How a run is watched.
#[derive(Args)]
pub(crate) struct Watching {
    /// Show the run in the browser while it continues, where it can be paused, stopped and kept
    #[arg(long)]
    pub(crate) watch: bool,
    /// With --watch: the page stays when the run has ended, until Ctrl-C
    #[arg(long, requires = "watch")]
    pub(crate) keep: bool,
    #[command(flatten)]
    page: Page,
}

/// A run that is watched.
pub(crate) struct Watched {
    pub(crate) live: Arc<Live>,
    server: Server,
    keep: bool,
}

impl Watching {
    /// Shows a run whose results go to `path`; none if no one wants to watch.
    pub(crate) fn begin(&self, model: &Model, simulation: &Simulation, path: &Path) -> Result<Option<Watched>, Failure> {
        if !self.watch {
            return Ok(None);
        }
        let frame = simulation.frame();
        let kinds = frame.fields.iter().map(|field| field.kind).collect();
        let bodies = Arc::new(Bodies::new(simulation.cells(), &frame));
        // Of a run that continues; one that can't be read is reported elsewhere.
        let past = History::read(path).ok().flatten().filter(|_| simulation.steps() > 0);
        let live = Live::new(bodies.clone(), simulation.history_columns(), model.is_of_whole_bodies(), (past.as_ref(), simulation.time()));
        let view = ResultView::begun(path, bodies, kinds, Appearance::of(model), frame.nodes());
        let server = self.page.show(Content::Runs { runs: vec![(path.to_path_buf(), Ok(view))], live: Some(live.clone()) })?;
        Ok(Some(Watched { live, server, keep: self.keep }))
    }
}

/// How long a page that no one has opened yet waits at the end of its run: longer than a browser takes to
/// start.
const OPENING: Duration = Duration::from_secs(30);

impl Watched {
    /// Shows the end of a run that was over before the page was opened.
    pub(crate) fn show_last(&self, simulation: &Simulation, interrupt: &Interrupt) {
        if self.keep || interrupt.is_pressed() || self.live.is_stopped() {
            return;
        }
        if !self.live.was_watched() {
            terminal::report_error("the run is over before its page was opened: the page waits for half a minute (Ctrl-C: no longer)");
        }
        self.live.show_last(&simulation.frame(), OPENING, || interrupt.is_pressed());
    }

    /// Reports the viewers how it ended.
    pub(crate) fn end(&self, report: &Report) {
        let status = match report.status {
            RunStatus::Done => "done",
            RunStatus::Failed => "failed",
            RunStatus::Stopped => "stopped",
        };
        self.live.end(Ended { status: status.into(), error: report.error.clone(), stays: self.keep });
    }

    /// Ends the page, where it is to stay by Ctrl-C.
    pub(crate) fn close(self, interrupt: &Interrupt) {
        if self.keep && !interrupt.is_pressed() {
            terminal::report_error("the page stays; Ctrl-C ends it");
            wait(interrupt);
        } else if !self.live.was_watched() {
            terminal::report_error(
                "the page had not been opened when the run ended: `embate view` shows its results, --keep lets the page stay",
            );
        }
        self.server.stop();
    }
}
