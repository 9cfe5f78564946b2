//! The queue between the run and its writer: bounded in memory, and nothing in it is ever dropped.
//!
//! The run puts jobs in, and waits where there is no room; the writer takes them out in their order and gives
//! back what it is done with, buffers and all.

use std::collections::VecDeque;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Jobs that are not done may use so many bytes together; a single job may be larger.
const BYTES_MAX: usize = 64 << 20;
/// So many jobs may be there that are not done: the one in work counts.
const JOBS_MAX: usize = 4;

/// A queue of jobs for one writer.
#[derive(Debug)]
pub(super) struct Queue<T> {
    state: Mutex<State<T>>,
    changed: Condvar,
}

#[derive(Debug)]
struct State<T> {
    waiting: VecDeque<(T, usize)>,
    /// Jobs that are not done, and their bytes; with the one in work.
    jobs: usize,
    bytes: usize,
    /// Jobs that are done and have buffers of use.
    done: Vec<T>,
    is_closed: bool,
}

impl<T> Queue<T> {
    pub(super) fn new() -> Self {
        let state = State { waiting: VecDeque::new(), jobs: 0, bytes: 0, done: Vec::new(), is_closed: false };
        Self { state: Mutex::new(state), changed: Condvar::new() }
    }

    fn state(&self) -> MutexGuard<'_, State<T>> {
        // A thread that panicked leaves nothing half done: each change is one assignment or one push.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn wait<'a>(&self, state: MutexGuard<'a, State<T>>) -> MutexGuard<'a, State<T>> {
        self.changed.wait(state).unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until a job of so many bytes has room; how long that took.
    pub(super) fn make_room(&self, bytes: usize) -> Duration {
        let begin = Instant::now();
        let mut state = self.state();
        while state.jobs > 0 && (state.jobs >= JOBS_MAX || state.bytes + bytes > BYTES_MAX) {
            state = self.wait(state);
        }
        begin.elapsed()
    }

    /// Puts in a job of so many bytes, once it has room; how long that took.
    pub(super) fn push(&self, job: T, bytes: usize) -> Duration {
        let waited = self.make_room(bytes);
        let mut state = self.state();
        state.jobs += 1;
        state.bytes += bytes;
        state.waiting.push_back((job, bytes));
        self.changed.notify_all();
        waited
    }

    /// A job that is done, for its buffers.
    pub(super) fn spare(&self) -> Option<T> {
        self.state().done.pop()
    }

    /// No more jobs will come.
    pub(super) fn close(&self) {
        self.state().is_closed = true;
        self.changed.notify_all();
    }

    /// Lets `work` do all jobs in their order until the queue is closed and empty; it says whether the job's
    /// buffers are of use.
    pub(super) fn serve(&self, mut work: impl FnMut(&mut T) -> bool) {
        loop {
            let mut state = self.state();
            let (mut job, bytes) = loop {
                if let Some(next) = state.waiting.pop_front() {
                    break next;
                }
                if state.is_closed {
                    return;
                }
                state = self.wait(state);
            };
            drop(state);
            let is_of_use = work(&mut job);
            let mut state = self.state();
            state.jobs -= 1;
            state.bytes -= bytes;
            state.done.extend(is_of_use.then_some(job));
            self.changed.notify_all();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    #[test]
    fn every_job_is_done_once_and_in_order() {
        let queue = Queue::new();
        let mut done = Vec::new();
        std::thread::scope(|scope| {
            let writer = scope.spawn(|| {
                let mut done = Vec::new();
                queue.serve(|job: &mut u32| {
                    done.push(*job);
                    false
                });
                done
            });
            for job in 0..1000 {
                queue.push(job, 1 << (job % 30));
            }
            queue.close();
            done = writer.join().unwrap();
        });
        assert!(done.iter().copied().eq(0..1000));
    }

    #[test]
    fn who_puts_in_waits_for_a_slow_writer_and_knows_how_long() {
        let queue = Queue::new();
        let served = AtomicUsize::new(0);
        std::thread::scope(|scope| {
            scope.spawn(|| {
                queue.serve(|_: &mut ()| {
                    std::thread::sleep(Duration::from_millis(5));
                    served.fetch_add(1, Ordering::SeqCst) == 3
                });
            });
            let mut waited = Duration::ZERO;
            for job in 0..12 {
                // However large: a job by itself is taken.
                waited += queue.push((), if job == 6 { 2 * BYTES_MAX } else { 1 });
                assert!(job + 1 - served.load(Ordering::SeqCst) <= JOBS_MAX + 1);
            }
            assert!(waited >= Duration::from_millis(20), "{waited:?}");
            queue.close();
        });
        assert_eq!(served.into_inner(), 12);
        assert!(queue.spare().is_some() && queue.spare().is_none());
    }
}
