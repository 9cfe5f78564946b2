//! What can be asked of the server: the page, and the runs that it shows. Nothing can be changed here; orders
//! to a run come by its socket alone.

use crate::connections::Patience;
use crate::live::Live;
use crate::model::ShownModel;
use crate::server::Content;
use crate::{access, bundle, socket};
use axum::Router;
use axum::body::{Body, to_bytes};
use axum::extract::ws::WebSocketUpgrade;
use axum::extract::{Path, Query, Request, State};
use axum::http::header::{ALLOW, CONTENT_TYPE};
use axum::http::{Response, StatusCode};
use axum::middleware::{self, Next};
use axum::response::IntoResponse;
use axum::routing::get;
use embate_files::results::ResultsError;
use embate_files::view::{Bodies, FrameRequest, ModelView, ProbePlace, RangeOf, ResultView, SectionRequest, Series};
use serde::Deserialize;
use serde_json::{Value, json};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use tokio::sync::watch;

/// Rows of a history, unless the page wants another number.
const ROWS: usize = 2000;

/// What the server shows.
pub(crate) struct Shown {
    runs: Vec<Mutex<Run>>,
    pub(crate) live: Option<Arc<Live>>,
    /// A model before it runs, instead of runs.
    model: Option<Arc<ShownModel>>,
    view: String,
    token: String,
    port: u16,
    pub(crate) patience: Patience,
    /// Becomes true when the server ends.
    pub(crate) stopped: watch::Receiver<bool>,
}

/// A folder, and what was found in it.
struct Run {
    path: PathBuf,
    found: Result<Arc<ResultView>, (String, &'static str)>,
}

impl Run {
    /// Looks again at a folder in which nothing was found: its run may have written its first frame.
    fn look(&mut self) -> Result<Arc<ResultView>, (String, &'static str)> {
        if self.found.is_err() {
            self.found = found(ResultView::open(&self.path));
        }
        self.found.clone()
    }
}

fn found(result: Result<ResultView, ResultsError>) -> Result<Arc<ResultView>, (String, &'static str)> {
    result.map(Arc::new).map_err(|error| (error.to_string(), error.kind().code))
}

impl Shown {
    pub(crate) fn new(
        content: Content,
        view: String,
        (token, port): (String, u16),
        patience: Patience,
        stopped: watch::Receiver<bool>,
    ) -> Self {
        let (runs, live, model) = match content {
            Content::Runs { runs, live } => (runs, live, None),
            Content::Model(model) => (Vec::new(), None, Some(model)),
        };
        let runs = runs.into_iter().map(|(path, result)| Mutex::new(Run { path, found: found(result) })).collect();
        Self { runs, live, model, view, token, port, patience, stopped }
    }

    /// A run by its number.
    fn run(&self, number: usize) -> Result<Arc<ResultView>, Refusal> {
        let run = self.runs.get(number).ok_or(Refusal::nothing("no run has this number"))?;
        let found = run.lock().unwrap_or_else(PoisonError::into_inner).look();
        found.map_err(|(text, code)| Refusal { status: StatusCode::NOT_FOUND, code, text })
    }

    /// The model that is shown as a run of this number.
    fn model(&self, number: usize) -> Option<Arc<ModelView>> {
        self.model.as_ref().filter(|_| number == 0).map(|model| model.current())
    }

    /// That of a run that is watched.
    fn live(&self, number: usize) -> Option<&Arc<Live>> {
        self.live.as_ref().filter(|_| number == 0)
    }

    fn description(&self, number: usize) -> Result<Value, Refusal> {
        if let Some(model) = self.model(number) {
            return serde_json::to_value(model.description()).map_err(|error| Refusal::nothing(&error.to_string()));
        }
        let mut description = self.run(number)?.description()?;
        if let Some(live) = self.live(number) {
            description.is_over = live.shared().ended.is_some();
        }
        serde_json::to_value(description).map_err(|error| Refusal::nothing(&error.to_string()))
    }

    fn all(&self) -> Value {
        if self.model.is_some() {
            let run = self.description(0).unwrap_or_default();
            return json!({ "version": env!("CARGO_PKG_VERSION"), "view": self.view, "live": false, "model": true, "runs": [run] });
        }
        let described = (0..self.runs.len()).map(|number| {
            let path = self.runs[number].lock().unwrap_or_else(PoisonError::into_inner).path.to_string_lossy().into_owned();
            self.description(number).unwrap_or_else(|refusal| json!({ "path": path, "fault": refusal.text, "code": refusal.code }))
        });
        let is_live = self.live.as_ref().is_some_and(|live| live.shared().ended.is_none());
        json!({ "version": env!("CARGO_PKG_VERSION"), "view": self.view, "live": is_live, "model": false, "runs": described.collect::<Vec<_>>() })
    }
}

/// Why something can't be had, for the page.
pub(crate) struct Refusal {
    status: StatusCode,
    code: &'static str,
    text: String,
}

impl Refusal {
    fn nothing(text: &str) -> Self {
        Self { status: StatusCode::NOT_FOUND, code: "", text: text.into() }
    }

    fn unclear(text: String) -> Self {
        Self { status: StatusCode::BAD_REQUEST, code: "", text }
    }

    pub(crate) fn forbidden(text: &str) -> Self {
        Self { status: StatusCode::FORBIDDEN, code: "", text: text.into() }
    }
}

impl From<ResultsError> for Refusal {
    fn from(error: ResultsError) -> Self {
        Self { status: StatusCode::UNPROCESSABLE_ENTITY, code: error.kind().code, text: error.to_string() }
    }
}

impl IntoResponse for Refusal {
    fn into_response(self) -> Response<Body> {
        bundle::answer(self.status, "application/json", json!({ "code": self.code, "error": self.text }).to_string())
    }
}

type Answer = Result<Response<Body>, Refusal>;

fn data(value: &Value) -> Answer {
    Ok(bundle::answer(StatusCode::OK, "application/json", value.to_string()))
}

fn bytes(bytes: Vec<u8>) -> Answer {
    Ok(bundle::answer(StatusCode::OK, "application/octet-stream", bytes))
}

/// Reads files beside the event loop.
async fn beside(work: impl FnOnce() -> Answer + Send + 'static) -> Answer {
    let panicked = |_| Refusal {
        status: StatusCode::INTERNAL_SERVER_ERROR,
        code: "E0799",
        text: "the server panicked; this is a bug in embate".into(),
    };
    tokio::task::spawn_blocking(work).await.map_err(panicked)?
}

/// All routes.
pub(crate) fn router(shown: Arc<Shown>) -> Router {
    let own =
        Router::new()
            .route("/", get(|| async { bundle::file("").ok_or(Refusal::nothing("there is no page")) }))
            .route(
                "/{file}",
                get(|Path((_, file)): Path<(String, String)>| async move {
                    bundle::file(&file).ok_or(Refusal::nothing("there is no such file"))
                }),
            )
            .route("/api/runs", get(runs))
            .route("/api/runs/{run}", get(run))
            .route("/api/runs/{run}/history", get(history))
            .route("/api/runs/{run}/range", get(range))
            .route("/api/runs/{run}/probe", get(probe))
            .route("/api/runs/{run}/track", get(track))
            .route("/api/runs/{run}/topology/{topology}", get(topology))
            .route("/api/runs/{run}/frames/{frame}", get(frame))
            .route("/api/model", get(model))
            .route("/api/live", get(live));
    Router::new()
        .route("/{token}/", get(|| async { bundle::file("").ok_or(Refusal::nothing("there is no page")) }))
        .nest("/{token}", own)
        .fallback(|| async { Refusal::nothing("there is nothing at this address; `api/runs` lists what is shown") })
        .layer(middleware::from_fn_with_state(shown.clone(), admit))
        .with_state(shown)
}

/// What is said to who does not know the token.
const WRONG: &str = "this address is not that of the program that runs now: open the one that it has printed";

/// Lets in who knows the token and comes from an own page.
async fn admit(State(shown): State<Arc<Shown>>, request: Request, next: Next) -> Response<Body> {
    let path = request.uri().path();
    let token = path.strip_prefix('/').and_then(|rest| rest.split('/').next()).unwrap_or_default();
    let is_socket = path.ends_with("/api/live");
    if !access::is_same(token, &shown.token) {
        return Refusal::forbidden(WRONG).into_response();
    }
    match access::refusal(request.headers(), shown.port, is_socket) {
        Some(text) => Refusal::forbidden(text).into_response(),
        // Without it the page's own addresses would be others.
        None if path == format!("/{token}") => Response::builder()
            .status(StatusCode::PERMANENT_REDIRECT)
            .header("location", format!("/{token}/"))
            .body(Body::empty())
            .expect("the token is plain ASCII"),
        None => as_json(next.run(request).await).await,
    }
}

/// Bytes of a reason that a library gives.
const REASON: usize = 4096;

/// An error that a library has reported in its own way, reported as all others are: a number that is none,
/// another method, a socket that is asked for without its headers.
async fn as_json(response: Response<Body>) -> Response<Body> {
    let (status, kind) = (response.status(), response.headers().get(CONTENT_TYPE));
    if !(status.is_client_error() || status.is_server_error()) || kind.is_some_and(|kind| kind == "application/json") {
        return response;
    }
    let allow = response.headers().get(ALLOW).cloned();
    let reason = to_bytes(response.into_body(), REASON).await.unwrap_or_default();
    let text = match (status, String::from_utf8_lossy(&reason).trim()) {
        (StatusCode::METHOD_NOT_ALLOWED, _) => "nothing is changed here: all addresses are asked with GET".into(),
        (_, "") => status.canonical_reason().unwrap_or("the request can't be answered").to_lowercase(),
        (_, reason) => reason.to_string(),
    };
    let mut reported = Refusal { status, code: "", text }.into_response();
    reported.headers_mut().extend(allow.map(|allow| (ALLOW, allow)));
    reported
}

async fn runs(State(shown): State<Arc<Shown>>) -> Answer {
    beside(move || data(&shown.all())).await
}

async fn run(State(shown): State<Arc<Shown>>, Path((_, run)): Path<(String, usize)>) -> Answer {
    beside(move || data(&shown.description(run)?)).await
}

/// What can be wished of an answer.
#[derive(Deserialize)]
struct Wanted {
    rows: Option<usize>,
    node: Option<usize>,
    cell: Option<usize>,
    inside: Option<u8>,
    scalar: Option<String>,
    averaged: Option<u8>,
    arrows: Option<u8>,
    glyphs: Option<String>,
    section: Option<String>,
    scale: Option<f64>,
    since: Option<usize>,
}

impl Wanted {
    fn place(&self) -> Result<ProbePlace, Refusal> {
        let place = self.node.map(ProbePlace::Node).or(self.cell.map(ProbePlace::Cell));
        place.ok_or(Refusal::nothing("this needs a node or a cell"))
    }
}

/// The request of a frame, of an address or of a message.
pub(crate) fn frame_request(
    scalar: Option<String>,
    [averaged, arrows]: [bool; 2],
    glyphs: Option<String>,
    section: Option<(&str, f64)>,
) -> Result<FrameRequest, String> {
    let section = section.map(|(planes, scale)| SectionRequest::read(planes, scale)).transpose()?;
    Ok(FrameRequest { scalar, averaged, arrows, glyphs, section })
}

/// What is known of a model before it runs, when that is something else than the page has seen.
async fn model(State(shown): State<Arc<Shown>>, Query(wanted): Query<Wanted>) -> Answer {
    let model = shown.model.as_ref().ok_or(Refusal::nothing("no model is shown here"))?;
    let found = match wanted.since {
        Some(seen) => model.after(seen, shown.stopped.clone()).await,
        None => model.current(),
    };
    data(found.about())
}

async fn history(State(shown): State<Arc<Shown>>, Path((_, run)): Path<(String, usize)>, Query(wanted): Query<Wanted>) -> Answer {
    beside(move || {
        let series = match (shown.live(run), shown.model(run)) {
            (Some(live), _) => live.history(),
            (None, Some(_)) => Series::default(),
            (None, None) => shown.run(run)?.history(wanted.rows.unwrap_or(ROWS).clamp(2, 100_000))?,
        };
        data(&json!(series))
    })
    .await
}

async fn range(State(shown): State<Arc<Shown>>, Path((_, run)): Path<(String, usize)>, Query(wanted): Query<Wanted>) -> Answer {
    beside(move || {
        let of = RangeOf { inside: wanted.inside == Some(1), averaged: wanted.averaged == Some(1) };
        let scalar = wanted.scalar.unwrap_or_default();
        let (range, frames) = match shown.model(run) {
            Some(model) => model.range(&scalar, of),
            None => shown.run(run)?.range(&scalar, of)?,
        };
        data(&json!({ "range": range, "frames": frames }))
    })
    .await
}

async fn probe(State(shown): State<Arc<Shown>>, Path((_, run)): Path<(String, usize)>, Query(wanted): Query<Wanted>) -> Answer {
    beside(move || {
        let (place, scalar) = (wanted.place()?, wanted.scalar.unwrap_or_default());
        let probed = match shown.model(run) {
            Some(model) => model.probe(&scalar, place),
            None => shown.run(run)?.probe(&scalar, place)?,
        };
        data(&json!(probed.ok_or(Refusal::nothing("there is no such node, cell or field"))?))
    })
    .await
}

async fn track(State(shown): State<Arc<Shown>>, Path((_, run)): Path<(String, usize)>, Query(wanted): Query<Wanted>) -> Answer {
    beside(move || {
        let track = match shown.model(run) {
            Some(model) => model.track(wanted.place()?),
            None => shown.run(run)?.track(wanted.place()?)?,
        };
        data(&json!(track.ok_or(Refusal::nothing("there is no such node or cell"))?))
    })
    .await
}

async fn topology(State(shown): State<Arc<Shown>>, Path((_, run, number)): Path<(String, usize, usize)>) -> Answer {
    beside(move || {
        let of = |bodies: Arc<Bodies>| bodies.numbered(number).map(|topology| (bodies, topology));
        // Frames of a run that continues may be of meshes that it has no more.
        let found = match (shown.live(run), shown.model(run)) {
            (Some(live), _) => of(live.bodies()).or_else(|| shown.run(run).ok()?.topology(number)),
            (None, Some(model)) => of(model.bodies().clone()),
            (None, None) => shown.run(run)?.topology(number),
        };
        let (bodies, topology) = found.ok_or(Refusal::nothing("no frame has named this topology"))?;
        bytes(bodies.container(&topology).bytes())
    })
    .await
}

async fn frame(
    State(shown): State<Arc<Shown>>,
    Path((_, run, number)): Path<(String, usize, usize)>,
    Query(wanted): Query<Wanted>,
) -> Answer {
    beside(move || {
        let Wanted { scalar, averaged, arrows, glyphs, section, scale, .. } = wanted;
        let section = section.as_deref().map(|planes| (planes, scale.unwrap_or(1.0)));
        let frame_request = frame_request(scalar, [averaged, arrows].map(|on| on == Some(1)), glyphs, section).map_err(Refusal::unclear)?;
        if let Some(model) = shown.model(run) {
            return bytes(model.frame(&frame_request).bytes());
        }
        let frame = shown.run(run)?.frame(number, &frame_request)?;
        bytes(frame.ok_or(Refusal::nothing("there is no frame of this number"))?.bytes())
    })
    .await
}

async fn live(State(shown): State<Arc<Shown>>, socket: WebSocketUpgrade) -> Answer {
    let live = shown.live.clone().ok_or(Refusal::nothing("no run is watched here"))?;
    let (patience, stopped) = (shown.patience, shown.stopped.clone());
    Ok(socket.max_message_size(1 << 16).on_upgrade(move |socket| socket::serve(socket, live, patience, stopped)))
}
