//! The server: listens on this machine alone, on a thread of its own, until it is stopped.

use crate::access;
use crate::connections::{self, Patience};
use crate::live::Live;
use crate::model::ShownModel;
use crate::routes::{self, Shown};
use embate_files::results::ResultsError;
use embate_files::view::ResultView;
use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::path::PathBuf;
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Duration;
use thiserror::Error;
use tokio::net::TcpListener;
use tokio::runtime::Builder;
use tokio::sync::watch;

/// Where the page is to be found.
#[derive(Clone, Debug)]
pub struct Address {
    /// Address to listen on; of this machine alone unless the user wants it otherwise.
    pub host: IpAddr,
    /// Port; 0: a free one.
    pub port: u16,
    /// What must stand in the address; none: one is made that no one can guess.
    pub token: Option<String>,
}

impl Default for Address {
    fn default() -> Self {
        Self { host: Ipv4Addr::LOCALHOST.into(), port: 0, token: None }
    }
}

/// Why there is no server.
#[derive(Debug, Error)]
pub enum ViewerError {
    /// The address is taken, or not of this machine.
    #[error("can't listen on {address}: {source}; choose another port with --port, or leave it out for a free one")]
    Listen {
        /// Where.
        address: SocketAddr,
        /// What the system said.
        source: std::io::Error,
    },
    /// The token is too short, or can't stand in an address.
    #[error("the token must have 16 to 128 letters, digits, '-' or '_'; leave --token out for one that cannot be guessed")]
    Token,
    /// The system has no thread or no random numbers.
    #[error("can't start the server: {what}")]
    System {
        /// What was wanted, and what the system said.
        what: String,
    },
}

/// What a server shows.
#[derive(Debug)]
pub enum Content {
    /// Runs: folders, or why they can't be shown.
    Runs {
        /// One, or two beside each other.
        runs: Vec<(PathBuf, Result<ResultView, ResultsError>)>,
        /// What the first one reports while it continues.
        live: Option<Arc<Live>>,
    },
    /// A model before it runs.
    Model(Arc<ShownModel>),
}

/// A server that shows one run, two beside each other, or a model.
#[derive(Debug)]
pub struct Server {
    url: String,
    stop: watch::Sender<bool>,
    thread: Option<JoinHandle<()>>,
}

/// Sockets have so long to say their last words.
const GOODBYE: Duration = Duration::from_millis(1500);

impl Server {
    /// Starts to listen. `view`: what the page shows first, as it stands in a link.
    ///
    /// # Errors
    /// [`ViewerError`].
    pub fn start(content: Content, view: &str, address: &Address) -> Result<Self, ViewerError> {
        Self::start_with(Patience::default(), content, view, address)
    }

    pub(crate) fn start_with(patience: Patience, content: Content, view: &str, address: &Address) -> Result<Self, ViewerError> {
        let system = |what: &'static str| move |error: std::io::Error| ViewerError::System { what: format!("{what}: {error}") };
        let token = match &address.token {
            Some(token) if access::is_token(token) => token.clone(),
            Some(_) => return Err(ViewerError::Token),
            None => access::token().map_err(|error| ViewerError::System { what: format!("no random numbers: {error}") })?,
        };
        let wanted = SocketAddr::new(address.host, address.port);
        let listen = |source| ViewerError::Listen { address: wanted, source };
        let listener = std::net::TcpListener::bind(wanted).map_err(listen)?;
        listener.set_nonblocking(true).map_err(listen)?;
        let own = listener.local_addr().map_err(listen)?;
        let runtime = Builder::new_current_thread().enable_all().max_blocking_threads(3).build().map_err(system("no event loop"))?;
        let (stop, stopped) = watch::channel(false);
        let url = format!("http://{}/{token}/", own.to_string().replacen("0.0.0.0", "127.0.0.1", 1).replacen("[::]", "[::1]", 1));
        let watched = if let Content::Runs { live, .. } = &content { live.clone() } else { None };
        let shown = Arc::new(Shown::new(content, view.into(), (token, own.port()), patience, stopped.clone()));
        let serve = async move {
            let Ok(listener) = TcpListener::from_std(listener) else { return };
            let serving = connections::serve(listener, routes::router(shown), patience, stopped.clone());
            let mut stopped = stopped;
            let farewell = async {
                over(&mut stopped).await;
                // Sockets are tasks of their own, which no one waits for otherwise.
                let last = tokio::time::Instant::now() + GOODBYE;
                while watched.as_ref().is_some_and(|live| live.is_watched()) && tokio::time::Instant::now() < last {
                    tokio::time::sleep(Duration::from_millis(10)).await;
                }
            };
            // Requests that come meanwhile are answered; whether they were is not waited for.
            let serving = async {
                serving.await;
                std::future::pending::<()>().await;
            };
            tokio::select! {
                () = serving => {}
                () = farewell => {}
            }
        };
        let work = move || {
            runtime.block_on(serve);
            // A large file that is read just now keeps no one waiting.
            runtime.shutdown_background();
        };
        let thread = std::thread::Builder::new().name("viewer".into()).spawn(work).map_err(system("no thread"))?;
        Ok(Self { url, stop, thread: Some(thread) })
    }

    /// Address of the page, with its token.
    #[must_use]
    pub fn url(&self) -> &str {
        &self.url
    }

    /// Opens the page in the browser of the system; whether there is one.
    pub fn open(&self) -> bool {
        open::that_detached(&self.url).is_ok()
    }

    /// Stops, after the last words to the viewers.
    pub fn stop(mut self) {
        self.end();
    }

    fn end(&mut self) {
        let _ = self.stop.send(true);
        if let Some(thread) = self.thread.take() {
            // It catches its own panics: those of a request end that request.
            let _ = thread.join();
        }
    }
}

/// Until the server is to end.
pub(crate) async fn over(stopped: &mut watch::Receiver<bool>) {
    // Who can't be reported any more is over, too.
    let _ = stopped.wait_for(|stop| *stop).await.is_ok();
}

impl Drop for Server {
    fn drop(&mut self) {
        self.end();
    }
}
