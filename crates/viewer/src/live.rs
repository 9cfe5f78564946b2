//! What is reported about a run while it continues, and what its viewers want of it: the state that the run
//! and the sockets share.
//!
//! The run's side ([`crate::tap`]) leaves progress, rows and the newest frame here and never waits for a
//! viewer; each socket takes what is new when it is ready. Frames that no one has taken are replaced, so a
//! slow viewer costs the run nothing.

use axum::body::Bytes;
use embate_files::results::{History, ThinnedRows};
use embate_files::view::{Bodies, FrameRequest, Series};
use embate_solver::output::{Cells, Shown};
use embate_solver::simulation::Progress;
use serde::Serialize;
use std::collections::BTreeMap;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use tokio::sync::watch;

/// What the viewers want of the run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Order {
    /// To continue.
    #[default]
    Running,
    /// To wait.
    Paused,
    /// To stop after its step.
    Stopping,
}

/// How far the run is.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Told {
    pub(crate) step: u64,
    pub(crate) time: f64,
    pub(crate) end: f64,
    pub(crate) time_step: f64,
    pub(crate) governor: String,
    pub(crate) energy_drift: f64,
}

/// Something that the user should know.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub(crate) struct Notice {
    pub(crate) code: &'static str,
    pub(crate) text: String,
}

/// How a run ended.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Ended {
    /// `done`, `stopped`, `failed`.
    pub status: String,
    /// The message of a failed run.
    pub error: Option<String>,
    /// Whether the server continues.
    pub stays: bool,
}

/// The newest frame for a wish, and which one it is.
pub(crate) type Newest = (u64, Bytes);

/// What the run and its viewers share.
#[derive(Debug, Default)]
pub(crate) struct Shared {
    pub(crate) order: Order,
    /// Whether the state is to be kept.
    pub(crate) keep: bool,
    pub(crate) reported: Told,
    pub(crate) notices: Vec<Notice>,
    /// What became of commands.
    pub(crate) kept: Vec<String>,
    pub(crate) ended: Option<Ended>,
    /// Frames until now.
    pub(crate) published: u64,
    /// Whether any viewer has seen one.
    pub(crate) is_seen: bool,
    pub(crate) frames: BTreeMap<FrameRequest, Newest>,
    /// Cells of the frames that come, where they are others than those of the bodies.
    cells: Option<Cells>,
    /// What each viewer wants.
    viewers: BTreeMap<u64, FrameRequest>,
    next_viewer: u64,
    rows: ThinnedRows,
    /// Wall time of the run so far does not count what it waited for viewers.
    paused: Duration,
    paused_since: Option<Instant>,
    /// Time of the run when it began: more than zero where it continues from a state.
    time_begin: Option<f64>,
}

/// A run that is watched while it continues.
#[derive(Debug)]
pub struct Live {
    bodies: Mutex<Arc<Bodies>>,
    columns: Vec<String>,
    of_whole_bodies: bool,
    begin: Instant,
    shared: Mutex<Shared>,
    /// Wakes a run that was paused.
    wake: Condvar,
    /// Counts changes; sockets wait for the next one.
    changes: watch::Sender<u64>,
}

/// Between two frames for one viewer at least.
pub(crate) const PAUSE: Duration = Duration::from_millis(60);

impl Live {
    /// A run with these bodies and columns of its history; `past`: the history of a run that continues from a
    /// state, and the time (s) of that.
    #[must_use]
    pub fn new(bodies: Arc<Bodies>, columns: Vec<String>, of_whole_bodies: bool, past: (Option<&History>, f64)) -> Arc<Self> {
        let mut shared = Shared::default();
        if let (Some(past), until) = past
            && past.columns == columns
        {
            let row = |row: usize| -> Vec<f64> { past.values.iter().map(|column| column[row]).collect() };
            (0..past.rows()).map(row).filter(|row| row.first().is_some_and(|time| *time <= until)).for_each(|row| shared.rows.add(&row));
        }
        let (changes, _) = watch::channel(0);
        Arc::new(Self {
            bodies: Mutex::new(bodies),
            columns,
            of_whole_bodies,
            begin: Instant::now(),
            shared: Mutex::new(shared),
            wake: Condvar::new(),
            changes,
        })
    }

    pub(crate) fn shared(&self) -> MutexGuard<'_, Shared> {
        self.shared.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Its bodies.
    pub(crate) fn bodies(&self) -> Arc<Bodies> {
        self.bodies.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// From here on frames are of these cells.
    pub(crate) fn set_cells(&self, cells: Cells) {
        self.shared().cells = Some(cells);
    }

    /// Changes what is shared, and reports the sockets and the run.
    pub(crate) fn change<T>(&self, change: impl FnOnce(&mut Shared) -> T) -> T {
        let result = change(&mut self.shared());
        self.changes.send_modify(|count| *count += 1);
        self.wake.notify_all();
        result
    }

    /// What reports of changes.
    pub(crate) fn changes(&self) -> watch::Receiver<u64> {
        self.changes.subscribe()
    }

    /// Waits for a change, not for long.
    pub(crate) fn wait(&self) {
        let shared = self.shared();
        drop(self.wake.wait_timeout(shared, Duration::from_millis(50)));
    }

    /// A viewer comes; its number.
    pub(crate) fn welcome(&self) -> u64 {
        self.change(|shared| {
            shared.next_viewer += 1;
            shared.viewers.insert(shared.next_viewer, FrameRequest::default());
            shared.next_viewer
        })
    }

    /// What a viewer wants to see; none: it has gone.
    pub(crate) fn frame_request(&self, viewer: u64, frame_request: Option<FrameRequest>) {
        self.change(|shared| {
            match frame_request {
                Some(frame_request) => shared.viewers.insert(viewer, frame_request),
                None => shared.viewers.remove(&viewer),
            };
            let Shared { viewers, frames, .. } = shared;
            frames.retain(|frame_request, _| viewers.values().any(|own| own == frame_request));
        });
    }

    /// Gives an order; whether it can be done.
    pub(crate) fn order(&self, order: Order) -> bool {
        self.change(|shared| {
            let is_open = shared.ended.is_none() && shared.order != Order::Stopping;
            if is_open {
                shared.order = order;
                let now = Instant::now();
                match (order, shared.paused_since) {
                    (Order::Paused, None) => shared.paused_since = Some(now),
                    (Order::Running | Order::Stopping, Some(since)) => {
                        shared.paused += now - since;
                        shared.paused_since = None;
                    }
                    _ => {}
                }
            }
            is_open
        })
    }

    /// Whether a viewer wants the run to stop.
    #[must_use]
    pub fn is_stopped(&self) -> bool {
        self.shared().order == Order::Stopping
    }

    /// Whether a viewer wants the state to be kept; asks once.
    pub fn takes_keep(&self) -> bool {
        std::mem::take(&mut self.shared().keep)
    }

    /// That the state was kept, and where.
    pub fn kept(&self, text: String) {
        self.change(|shared| shared.kept.push(text));
    }

    /// How far the run is.
    pub fn progress(&self, progress: &Progress<'_>) {
        let reported = Told {
            step: progress.step,
            time: progress.time,
            end: progress.end,
            time_step: progress.time_step,
            governor: progress.governor.into(),
            energy_drift: progress.energy_drift,
        };
        let notices = progress.notices.iter().map(|notice| Notice { code: notice.kind.code, text: notice.text.clone() });
        self.change(|shared| {
            shared.time_begin.get_or_insert(reported.time);
            shared.reported = reported;
            shared.notices.extend(notices);
        });
    }

    /// That the run is over.
    pub fn end(&self, ended: Ended) {
        self.change(|shared| shared.ended = Some(ended));
    }

    /// A row of the history.
    pub(crate) fn row(&self, row: &[f64]) {
        // Asked for every two seconds: no one needs to be reported.
        self.shared().rows.add(row);
    }

    /// The history so far, thinned.
    pub(crate) fn history(&self) -> Series {
        let rows = self.shared().rows.rows();
        let values =
            (0..self.columns.len()).map(|column| rows.iter().map(|row| row.get(column).copied().unwrap_or(f64::NAN)).collect()).collect();
        Series::of(&self.columns, values, self.of_whole_bodies)
    }

    /// Wall time without pauses, and what is left by the share that is done, s.
    pub(crate) fn seconds(&self) -> (f64, Option<f64>) {
        let shared = self.shared();
        let paused = shared.paused + shared.paused_since.map_or(Duration::ZERO, |since| since.elapsed());
        let seconds = self.begin.elapsed().saturating_sub(paused).as_secs_f64();
        let Told { time, end, .. } = shared.reported;
        let done = time - shared.time_begin.unwrap_or(0.0);
        (seconds, (done > 0.0 && end > time).then(|| seconds * (end - time) / done))
    }

    /// Whether a viewer waits for a frame that is not there: one that has come, or wants to see something
    /// else.
    pub(crate) fn lacks(&self) -> bool {
        let shared = self.shared();
        shared.viewers.values().any(|frame_request| !shared.frames.contains_key(frame_request))
    }

    /// Whether anybody has looked at all.
    #[must_use]
    pub fn was_watched(&self) -> bool {
        self.shared().next_viewer > 0
    }

    /// Shows the state at the end of a run that was over before any viewer had seen a frame of it: waits for
    /// the first viewer, and until it has seen one; at most for `patience`, and not once `gives_up` says so.
    pub fn show_last(&self, shown: &dyn Shown, patience: Duration, gives_up: impl Fn() -> bool) {
        let last = Instant::now() + patience;
        while !gives_up() && Instant::now() < last {
            let shared = self.shared();
            let (has_left, is_seen) = (shared.next_viewer > 0 && shared.viewers.is_empty(), shared.is_seen);
            drop(shared);
            if is_seen || has_left {
                return;
            }
            if self.lacks() {
                self.publish(shown);
            }
            self.wait();
        }
    }

    /// Whether anybody looks.
    pub(crate) fn is_watched(&self) -> bool {
        !self.shared().viewers.is_empty()
    }

    /// Leaves a frame of what is shown for every wish.
    pub(crate) fn publish(&self, shown: &dyn Shown) {
        let mut wishes: Vec<FrameRequest> = self.shared().viewers.values().cloned().collect();
        wishes.sort_unstable();
        wishes.dedup();
        if wishes.is_empty() {
            return;
        }
        let cells = self.shared().cells.take();
        let mut bodies = self.bodies();
        if let Some(cells) = cells {
            bodies = Arc::new(bodies.with_cells(cells, shown));
            *self.bodies.lock().unwrap_or_else(PoisonError::into_inner) = bodies.clone();
        }
        let topology = bodies.without(&embate_files::view::gone(shown));
        let outlines = embate_files::view::outlines(shown);
        let made: Vec<(FrameRequest, Bytes)> = wishes
            .into_iter()
            .map(|frame_request| {
                let container = embate_files::view::frame(&bodies, &topology, shown, &outlines, &frame_request);
                let bytes = container.with("frame", -1).with("step", shown.step()).bytes();
                (frame_request, Bytes::from(bytes))
            })
            .collect();
        self.change(|shared| {
            shared.published += 1;
            let number = shared.published;
            shared.frames.extend(made.into_iter().map(|(frame_request, bytes)| (frame_request, (number, bytes))));
        });
    }
}
