//! The socket of one viewer of a running simulation: tells what is new, newest first, and takes orders.
//!
//! A frame is sent when the page has seen the one before; what came in between is dropped and counted. Whoever is slow makes nobody wait.

use crate::live::{Live, Order, PAUSE};
use crate::server;
use axum::extract::ws::{Message, WebSocket};
use embate_files::view::Wish;
use serde::Deserialize;
use serde_json::{Value, json};
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::watch;
use tokio::time::Instant;

/// Between two words about progress.
const PROGRESS: Duration = Duration::from_millis(150);

/// What a page says.
#[derive(Deserialize)]
#[serde(untagged)]
enum Said {
    Seen { seen: bool },
    Command { command: String },
    Wish { scalar: Option<String>, arrows: bool },
}

/// What a viewer has been told.
struct Viewer {
    live: Arc<Live>,
    number: u64,
    wish: Wish,
    /// Number of the last frame, and whether the page has seen it.
    frame: u64,
    is_ready: bool,
    dropped: u64,
    notices: usize,
    kept: usize,
    is_over: bool,
    next_progress: Instant,
    next_frame: Instant,
}

impl Drop for Viewer {
    fn drop(&mut self) {
        self.live.wish(self.number, None);
    }
}

/// Serves a socket to its end.
pub(crate) async fn serve(mut socket: WebSocket, live: Arc<Live>, mut stopped: watch::Receiver<bool>) {
    let mut changes = live.changes();
    let now = Instant::now();
    let number = live.welcome();
    let mut viewer = Viewer {
        live,
        number,
        wish: Wish::default(),
        frame: 0,
        is_ready: true,
        dropped: 0,
        notices: 0,
        kept: 0,
        is_over: false,
        next_progress: now,
        next_frame: now,
    };
    loop {
        changes.mark_unchanged();
        for message in viewer.news() {
            if socket.send(message).await.is_err() {
                return;
            }
        }
        if viewer.is_over {
            let _ = socket.send(Message::Close(None)).await;
            return;
        }
        // What is held back until its time comes.
        let later = tokio::time::sleep(PROGRESS);
        tokio::select! {
            message = socket.recv() => match message {
                Some(Ok(Message::Text(text))) => {
                    if let Some(answer) = viewer.hear(&text)
                        && socket.send(Message::Text(answer.to_string().into())).await.is_err()
                    {
                        return;
                    }
                }
                Some(Ok(Message::Close(_)) | Err(_)) | None => return,
                Some(Ok(_)) => {}
            },
            changed = changes.changed() => {
                if changed.is_err() {
                    return;
                }
                // Many changes are one.
                tokio::time::sleep(Duration::from_millis(5)).await;
            }
            () = later => {}
            () = server::over(&mut stopped) => {
                for message in viewer.news() {
                    let _ = socket.send(message).await;
                }
                let _ = socket.send(Message::Close(None)).await;
                return;
            }
        }
    }
}

impl Viewer {
    /// What the page says; an answer where it can't be done.
    fn hear(&mut self, text: &str) -> Option<Value> {
        let refused = |text: &str| Some(json!({ "kind": "refused", "text": text }));
        match serde_json::from_str(text) {
            Ok(Said::Seen { seen }) => self.is_ready |= seen,
            Ok(Said::Wish { scalar, arrows }) => {
                self.wish = Wish { scalar, arrows };
                self.live.wish(self.number, Some(self.wish.clone()));
                // What is on its way is of the wish before.
                self.frame = 0;
            }
            Ok(Said::Command { command }) => {
                let is_done = match command.as_str() {
                    "pause" => self.live.order(Order::Paused),
                    "resume" => self.live.order(Order::Running),
                    "stop" => self.live.order(Order::Stopping),
                    "checkpoint" => self.live.change(|shared| {
                        shared.keep = shared.ended.is_none();
                        shared.keep
                    }),
                    _ => return refused("there is no such command"),
                };
                self.next_progress = Instant::now();
                if !is_done {
                    return refused("the run is over, or about to stop");
                }
            }
            Err(_) => return refused("this can't be understood"),
        }
        None
    }

    /// What is new: notices, progress, the newest frame, the end.
    fn news(&mut self) -> Vec<Message> {
        let mut news = Vec::new();
        let text = |value: Value| Message::Text(value.to_string().into());
        let (seconds, left) = self.live.seconds();
        let shared = self.live.shared();
        let now = Instant::now();
        if self.notices < shared.notices.len() {
            news.push(text(json!({ "kind": "notices", "notices": shared.notices[self.notices..] })));
            self.notices = shared.notices.len();
        }
        for kept in &shared.kept[self.kept..] {
            news.push(text(json!({ "kind": "kept", "text": kept })));
        }
        self.kept = shared.kept.len();
        let ended = shared.ended.clone();
        if let Some((number, bytes)) = shared.frames.get(&self.wish)
            && *number > self.frame
            && (self.is_ready && self.next_frame <= now || ended.is_some())
        {
            if self.frame > 0 {
                self.dropped += number - self.frame - 1;
            }
            self.frame = *number;
            self.is_ready = false;
            self.next_frame = now + PAUSE;
            news.push(Message::Binary(bytes.clone()));
        }
        if self.next_progress <= now || ended.is_some() {
            self.next_progress = now + PROGRESS;
            let mut told = json!(shared.told);
            let more = json!({ "kind": "progress", "state": shared.order, "seconds": seconds, "left": left, "dropped": self.dropped });
            if let (Value::Object(told), Value::Object(more)) = (&mut told, more) {
                told.extend(more);
            }
            news.push(text(told));
        }
        if let Some(ended) = ended {
            let mut value = json!(ended);
            value["kind"] = "ended".into();
            news.push(text(value));
            self.is_over = true;
        }
        news
    }
}
