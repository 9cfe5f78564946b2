//! The socket of one viewer of a running simulation: says what is new, newest first, and takes orders.
//!
//! A page that says nothing, not even that it is still there, is not waited for. A frame is sent when the
//! page has seen the one before; what came in between is dropped and counted. Anyone who is slow makes no one
//! wait.

use crate::connections::Patience;
use crate::live::{Live, Order, PAUSE};
use crate::routes::frame_request;
use crate::server;
use axum::body::Bytes;
use axum::extract::ws::{Message, WebSocket};
use embate_files::view::FrameRequest;
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
    FrameRequest(Wish),
}

/// What frames are to hold.
#[derive(Deserialize)]
struct Wish {
    scalar: Option<String>,
    arrows: bool,
    #[serde(default)]
    averaged: bool,
    glyphs: Option<String>,
    section: Option<String>,
    scale: Option<f64>,
}

/// What a viewer has been reported.
struct Viewer {
    live: Arc<Live>,
    number: u64,
    frame_request: FrameRequest,
    /// Number of the last frame, and whether the page has seen it.
    frame: u64,
    is_ready: bool,
    dropped: u64,
    notices: usize,
    kept: usize,
    is_over: bool,
    next_progress: Instant,
    next_frame: Instant,
    /// When anything came from it the last time, and when it is asked whether it is there.
    heard: Instant,
    next_ping: Instant,
}

impl Drop for Viewer {
    fn drop(&mut self) {
        self.live.frame_request(self.number, None);
    }
}

/// Serves a socket to its end.
pub(crate) async fn serve(mut socket: WebSocket, live: Arc<Live>, patience: Patience, mut stopped: watch::Receiver<bool>) {
    let mut changes = live.changes();
    let now = Instant::now();
    let number = live.welcome();
    let mut viewer = Viewer {
        live,
        number,
        frame_request: FrameRequest::default(),
        frame: 0,
        is_ready: true,
        dropped: 0,
        notices: 0,
        kept: 0,
        is_over: false,
        next_progress: now,
        next_frame: now,
        heard: now,
        next_ping: now + patience.ping,
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
        let now = Instant::now();
        if now - viewer.heard > patience.silence {
            return;
        }
        if viewer.next_ping <= now {
            viewer.next_ping = now + patience.ping;
            if socket.send(Message::Ping(Bytes::new())).await.is_err() {
                return;
            }
        }
        // What is held back until its time comes.
        let later = tokio::time::sleep(PROGRESS);
        tokio::select! {
            message = socket.recv() => {
                viewer.heard = Instant::now();
                let answer = match message {
                    Some(Ok(Message::Text(text))) => viewer.hear(&text),
                    Some(Ok(Message::Binary(_))) => Some(refused("orders are texts, not bytes")),
                    Some(Ok(Message::Close(_)) | Err(_)) | None => return,
                    Some(Ok(_)) => None,
                };
                if let Some(answer) = answer
                    && socket.send(Message::Text(answer.to_string().into())).await.is_err()
                {
                    return;
                }
            }
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

/// What can be said.
const KNOWN: &str = "this can't be understood: there are {\"seen\": true}, {\"scalar\": KEY or null, \"arrows\": \
    true or false} and {\"command\": \"pause\"} (resume, stop, checkpoint)";

/// That something can't be done.
fn refused(text: &str) -> Value {
    json!({ "kind": "refused", "text": text })
}

impl Viewer {
    /// What the page says; an answer where it can't be done.
    fn hear(&mut self, text: &str) -> Option<Value> {
        let refused = |text: &str| Some(refused(text));
        let said: Value = match serde_json::from_str(text) {
            Ok(said) => said,
            Err(error) => return refused(&format!("this is no JSON: {error}")),
        };
        match serde_json::from_value(said) {
            Ok(Said::Seen { seen }) => {
                self.is_ready |= seen;
                self.live.change(|shared| shared.is_seen |= seen);
            }
            Ok(Said::FrameRequest(Wish { scalar, arrows, averaged, glyphs, section, scale })) => {
                let section = section.as_deref().map(|planes| (planes, scale.unwrap_or(1.0)));
                match frame_request(scalar, [averaged, arrows], glyphs, section) {
                    Ok(wanted) => self.frame_request = wanted,
                    Err(text) => return refused(&text),
                }
                self.live.frame_request(self.number, Some(self.frame_request.clone()));
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
            Err(_) => return refused(KNOWN),
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
        if let Some((number, bytes)) = shared.frames.get(&self.frame_request)
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
            let mut reported = json!(shared.reported);
            let more = json!({ "kind": "progress", "state": shared.order, "seconds": seconds, "left": left, "dropped": self.dropped });
            if let (Value::Object(reported), Value::Object(more)) = (&mut reported, more) {
                reported.extend(more);
            }
            news.push(text(reported));
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::server::{Address, Content, Server};
    use embate_files::model_file;
    use embate_files::view::Bodies;
    use embate_solver::simulation::{Options, Simulation};
    use std::io::{Read, Write};
    use std::net::TcpStream;

    const MODEL: &str = r#"
run.end = "0.1 ms"
material.steel = { law = "elastic", density = 7800, young = "200 GPa", poisson = 0.3 }
part = [{ name = "block", material = "steel", rectangle = { corner = [0, 0], size = ["10 mm", "10 mm"], elements = [2, 2] }, velocity = [1, 0] }]
"#;
    const PATIENCE: Patience = Patience {
        head: Duration::from_secs(5),
        stall: Duration::from_secs(5),
        ping: Duration::from_millis(200),
        silence: Duration::from_millis(1000),
        most: 16,
    };
    const LONG: Duration = Duration::from_secs(20);

    /// A server of a run that does not continue, and an open socket of it.
    fn watched() -> (Server, Arc<Live>, TcpStream) {
        let model = model_file::load_text("flight", MODEL, ".".as_ref(), &[]).unwrap();
        let simulation = Simulation::new(&model, &Options::default()).unwrap();
        let bodies = Arc::new(Bodies::new(simulation.cells(), &simulation.frame()));
        let live = Live::new(bodies, simulation.history_columns(), false, (None, 0.0));
        let server =
            Server::start_with(PATIENCE, Content::Runs { runs: Vec::new(), live: Some(live.clone()) }, "", &Address::default()).unwrap();
        let (host, token) = server.url().trim_start_matches("http://").trim_end_matches('/').split_once('/').unwrap();
        let mut stream = TcpStream::connect(host).unwrap();
        stream.set_read_timeout(Some(LONG)).unwrap();
        write!(
            stream,
            "GET /{token}/api/live HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n\
             Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n"
        )
        .unwrap();
        let mut head = Vec::new();
        while !head.ends_with(b"\r\n\r\n") {
            let mut byte = [0];
            stream.read_exact(&mut byte).unwrap();
            head.push(byte[0]);
        }
        assert!(head.starts_with(b"HTTP/1.1 101"), "{}", String::from_utf8_lossy(&head));
        (server, live, stream)
    }

    /// A frame of a client: its mask is zero.
    fn say(stream: &mut TcpStream, code: u8, text: &[u8]) -> bool {
        let head = [0x80 | code, 0x80 | u8::try_from(text.len()).unwrap(), 0, 0, 0, 0];
        stream.write_all(&[&head, text].concat()).is_ok()
    }

    /// The next short frame of the server: its code and text; none at the end.
    fn hear(stream: &mut TcpStream) -> Option<(u8, Vec<u8>)> {
        let mut head = [0; 2];
        stream.read_exact(&mut head).ok()?;
        let length = match head[1] {
            126 => {
                let mut length = [0; 2];
                stream.read_exact(&mut length).ok()?;
                u16::from_be_bytes(length).into()
            }
            127 => {
                let mut length = [0; 8];
                stream.read_exact(&mut length).ok()?;
                u64::from_be_bytes(length) as usize
            }
            length => length.into(),
        };
        let mut text = vec![0; length];
        stream.read_exact(&mut text).ok()?;
        Some((head[0] & 15, text))
    }

    #[test]
    fn a_page_that_never_answers_is_given_up() {
        let (_server, live, mut stream) = watched();
        let begin = std::time::Instant::now();
        while hear(&mut stream).is_some() {
            assert!(begin.elapsed() < LONG, "it is waited for ever");
        }
        assert!(begin.elapsed() >= PATIENCE.silence, "{:?}", begin.elapsed());
        let end = std::time::Instant::now() + LONG;
        while live.is_watched() && std::time::Instant::now() < end {
            std::thread::sleep(Duration::from_millis(10));
        }
        assert!(!live.is_watched(), "the run takes no frames for it any more");
    }

    #[test]
    fn a_page_that_only_answers_pings_stays_and_what_it_says_wrong_is_reported_as_json() {
        let (_server, _live, mut stream) = watched();
        let (begin, mut refused) = (std::time::Instant::now(), Vec::new());
        for (code, text) in [(1, "{"), (1, "{\"smell\": 1}"), (1, "{\"command\": \"jump\"}"), (2, "x")] {
            assert!(say(&mut stream, code, text.as_bytes()));
        }
        while begin.elapsed() < PATIENCE.silence * 3 {
            let (code, text) = hear(&mut stream).expect("it is there as long as it answers");
            match code {
                9 => assert!(say(&mut stream, 10, &text)),
                1 => {
                    let reported: Value = serde_json::from_slice(&text).unwrap();
                    refused.extend(reported["text"].as_str().filter(|_| reported["kind"] == "refused").map(ToString::to_string));
                }
                _ => {}
            }
        }
        let starts = ["this is no JSON: ", "this can't be understood: ", "there is no such command", "orders are texts"];
        assert!(
            refused.len() == starts.len() && refused.iter().zip(starts).all(|(reported, start)| reported.starts_with(start)),
            "{refused:?}"
        );
    }
}
