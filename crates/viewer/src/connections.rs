//! Connections: how many there are at a time, and how long each may keep the server waiting.
//!
//! Who opens a connection and sends half a request, or takes no answer, or is gone without a word, holds a
//! socket and memory of the program, which may be running a simulation. Each such wait has an end
//! ([`Patience`]), and beyond [`Patience::most`] connections new ones wait until others are closed.

use crate::server::over;
use axum::Router;
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use std::future::Future;
use std::io::{self, ErrorKind, IoSlice};
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};
use std::time::Duration;
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{OwnedSemaphorePermit, Semaphore, watch};
use tokio::time::{Instant, Sleep, sleep};

/// How long is waited for others.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patience {
    /// For the head of a request to be complete, counted from the connection or from the answer before.
    pub(crate) head: Duration,
    /// For the other side to take anything of an answer that is sent to it.
    pub(crate) stall: Duration,
    /// Between two questions whether the page at a WebSocket is still there.
    pub(crate) ping: Duration,
    /// For any word from a page at a WebSocket.
    pub(crate) silence: Duration,
    /// Connections at a time.
    pub(crate) most: usize,
}

impl Default for Patience {
    fn default() -> Self {
        let [head, stall, ping, silence] = [10, 20, 5, 20].map(Duration::from_secs);
        Self { head, stall, ping, silence, most: 128 }
    }
}

/// After an error of accepting, as when the process has no more files: time for others to close theirs.
const BREATH: Duration = Duration::from_millis(50);

/// Accepts and answers until `stopped`. Errors of single connections end these alone.
pub(crate) async fn serve(listener: TcpListener, router: Router, patience: Patience, mut stopped: watch::Receiver<bool>) {
    let places = Arc::new(Semaphore::new(patience.most));
    let mut http = http1::Builder::new();
    http.timer(TokioTimer::new()).header_read_timeout(patience.head);
    loop {
        let next = async {
            let place = places.clone().acquire_owned().await.ok()?;
            Some((listener.accept().await, place))
        };
        let (accepted, place) = tokio::select! {
            next = next => match next {
                Some(next) => next,
                None => return,
            },
            () = over(&mut stopped) => return,
        };
        let Ok((stream, _)) = accepted else {
            sleep(BREATH).await;
            continue;
        };
        let stream =
            TokioIo::new(Patient { stream, stall: patience.stall, end: Box::pin(sleep(patience.stall)), is_stalled: false, _place: place });
        let connection = http.serve_connection(stream, TowerToHyperService::new(router.clone())).with_upgrades();
        tokio::spawn(async move {
            // Why it ended is of interest to no one: the other side knows, or has gone.
            let _ = connection.await;
        });
    }
}

/// A connection that fails when the other side takes nothing for too long. It has its place among those at a
/// time as long as it lives, also as a WebSocket.
struct Patient {
    stream: TcpStream,
    stall: Duration,
    /// When a write that is stalled fails.
    end: Pin<Box<Sleep>>,
    is_stalled: bool,
    _place: OwnedSemaphorePermit,
}

impl Patient {
    /// What came of a write; it fails when it has waited for too long.
    fn wait<T>(&mut self, context: &mut Context<'_>, written: Poll<io::Result<T>>) -> Poll<io::Result<T>> {
        if written.is_ready() {
            self.is_stalled = false;
            return written;
        }
        if !std::mem::replace(&mut self.is_stalled, true) {
            self.end.as_mut().reset(Instant::now() + self.stall);
        }
        self.end.as_mut().poll(context).map(|()| Err(ErrorKind::TimedOut.into()))
    }
}

impl AsyncRead for Patient {
    fn poll_read(mut self: Pin<&mut Self>, context: &mut Context<'_>, buffer: &mut ReadBuf<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_read(context, buffer)
    }
}

impl AsyncWrite for Patient {
    fn poll_write(mut self: Pin<&mut Self>, context: &mut Context<'_>, bytes: &[u8]) -> Poll<io::Result<usize>> {
        let written = Pin::new(&mut self.stream).poll_write(context, bytes);
        self.wait(context, written)
    }

    fn poll_write_vectored(mut self: Pin<&mut Self>, context: &mut Context<'_>, pieces: &[IoSlice<'_>]) -> Poll<io::Result<usize>> {
        let written = Pin::new(&mut self.stream).poll_write_vectored(context, pieces);
        self.wait(context, written)
    }

    fn is_write_vectored(&self) -> bool {
        self.stream.is_write_vectored()
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        let flushed = Pin::new(&mut self.stream).poll_flush(context);
        self.wait(context, flushed)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_shutdown(context)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use axum::routing::get;
    use std::io::{Read, Write};
    use std::net::{SocketAddr, TcpStream as Plain};

    const PATIENCE: Patience = Patience {
        head: Duration::from_millis(300),
        stall: Duration::from_millis(300),
        ping: Duration::from_millis(50),
        silence: Duration::from_millis(300),
        most: 4,
    };
    /// Nothing here may take longer than this.
    const LONG: Duration = Duration::from_secs(10);

    /// A server of a small and a very large answer; what stops it.
    fn served() -> (SocketAddr, watch::Sender<bool>) {
        let listener = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
        listener.set_nonblocking(true).unwrap();
        let address = listener.local_addr().unwrap();
        let (stop, stopped) = watch::channel(false);
        let router = Router::new().route("/", get(|| async { "here" })).route("/large", get(|| async { vec![b'a'; 64 << 20] }));
        std::thread::spawn(move || {
            let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().unwrap();
            runtime.block_on(async { serve(TcpListener::from_std(listener).unwrap(), router, PATIENCE, stopped).await });
        });
        (address, stop)
    }

    fn connected(address: SocketAddr, said: &[u8]) -> Plain {
        let mut stream = Plain::connect(address).unwrap();
        stream.set_read_timeout(Some(LONG)).unwrap();
        stream.write_all(said).unwrap();
        stream
    }

    /// All that comes until the connection is closed, and how long that took.
    fn rest(mut stream: Plain) -> (usize, Duration) {
        let (begin, mut bytes) = (Instant::now(), Vec::new());
        // It may also be cut off; a time-out is neither.
        if let Err(error) = stream.read_to_end(&mut bytes) {
            assert!(error.kind() == ErrorKind::ConnectionReset, "{error}");
        }
        (bytes.len(), begin.elapsed())
    }

    #[test]
    fn half_a_request_and_none_at_all_are_not_waited_for() {
        let (address, _stop) = served();
        for said in ["", "GET / HT", "GET / HTTP/1.1\r\nHost: x\r\n", "GET / HTTP/1.1\r\nHost: x\r\n\r\n"] {
            let (_, time) = rest(connected(address, said.as_bytes()));
            assert!(time >= PATIENCE.head / 2 && time < LONG, "{said:?}: closed after {time:?}");
        }
    }

    #[test]
    fn a_request_that_comes_byte_by_byte_is_cut_off() {
        let (address, _stop) = served();
        let (mut stream, begin) = (connected(address, b"GET / HTTP/1.1\r\nA: "), Instant::now());
        while stream.write_all(b"a").is_ok() && begin.elapsed() < LONG {
            std::thread::sleep(Duration::from_millis(20));
        }
        assert!(begin.elapsed() < LONG, "bytes are taken for ever");
    }

    #[test]
    fn an_answer_that_nobody_takes_is_given_up_and_one_that_is_taken_slowly_is_not() {
        let (address, _stop) = served();
        let request = b"GET /large HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n";
        let stalled = connected(address, request);
        std::thread::sleep(PATIENCE.stall * 4);
        assert!(rest(stalled).0 < 64 << 20, "the rest was not sent");
        let (mut slow, mut taken, mut buffer) = (connected(address, request), 0, vec![0; 8 << 20]);
        loop {
            match slow.read(&mut buffer).unwrap() {
                0 => break,
                more => taken += more,
            }
            std::thread::sleep(Duration::from_millis(20));
        }
        assert!(taken > 64 << 20, "{taken}");
    }

    #[test]
    fn connections_that_wait_for_nothing_keep_others_out_for_a_while_only() {
        let (address, _stop) = served();
        let idle: Vec<Plain> = (0..3 * PATIENCE.most).map(|_| connected(address, b"GET ")).collect();
        let (bytes, time) = rest(connected(address, b"GET / HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n"));
        assert!(bytes > 0 && time < LONG, "answered after {time:?}");
        drop(idle);
    }

    #[test]
    fn nobody_is_answered_once_it_is_stopped() {
        let (address, stop) = served();
        stop.send(true).unwrap();
        let end = Instant::now() + LONG;
        while Plain::connect(address).is_ok() && Instant::now() < end {
            std::thread::sleep(Duration::from_millis(10));
        }
        assert!(Instant::now() < end);
    }
}
