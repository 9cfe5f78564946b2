//! From the run to the writer: in turn, or on a thread of its own.
//!
//! With one thread the writer works when it is called, and the run waits. With more it has a thread: the run
//! puts its jobs into a bounded queue and continues. Errors come back with the next call, or at the end; a
//! panic of the writer is an error like others.

use super::ResultsError;
use super::queue::Queue;
use super::writer::{Closed, Job, Writer, bytes};
use embate_solver::output::{Frame, Shown};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// The writer's side: its files, the first thing that went wrong, and how long it worked.
struct Desk {
    writer: Writer,
    faults: Faults,
    worked: Duration,
}

/// The first fault that has not been reported yet; the two sides share it.
type Faults = Arc<Mutex<Option<ResultsError>>>;

impl Desk {
    fn write(&mut self, job: &Job, shown: Option<&dyn Shown>) {
        let begin = Instant::now();
        self.writer.worked = self.worked;
        if let Err(fault) = guarded(|| self.writer.write(job, shown)) {
            let mut first = self.faults.lock().unwrap_or_else(PoisonError::into_inner);
            first.get_or_insert(fault);
        }
        self.worked += begin.elapsed();
    }
}

/// The result of `work`; a panic is an error.
fn guarded<T>(work: impl FnOnce() -> Result<T, ResultsError>) -> Result<T, ResultsError> {
    // The files of a writer that panicked are at worst without their last piece.
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
        Err(ResultsError::Panic { message: text.unwrap_or("without a message").to_string() })
    })
}

/// Where the writer works.
enum Place {
    InTurn(Box<Desk>),
    Beside {
        queue: Arc<Queue<Job>>,
        thread: JoinHandle<Desk>,
    },
    /// After the end.
    Nowhere,
}

/// The run's side.
pub(super) struct WriterChannel {
    place: Place,
    faults: Faults,
    waited: Duration,
    /// Memory of the last frame.
    frame_bytes: usize,
    /// Buffers of the last frame, in turn.
    spare: Frame,
}

/// How writing ended.
pub(super) struct End {
    /// What was not reported yet and kept results from being written completely.
    pub(super) result: Result<(), ResultsError>,
    /// Why there are no pictures, if they are missing.
    pub(super) pictures_missing: Option<String>,
    /// Why states are missing that no one had asked for.
    pub(super) states_missing: Option<String>,
    /// Time that the writer was at work, with the pictures at the end.
    pub(super) worked: Duration,
    /// Time that the run waited for the writer, with the end.
    pub(super) waited: Duration,
}

impl WriterChannel {
    /// Gives the writer its place; `beside`: on a thread of its own, if the system gives one.
    pub(super) fn new(writer: Writer, beside: bool) -> Self {
        let faults = Faults::default();
        let desk = Arc::new(Mutex::new(Some(Desk { writer, faults: faults.clone(), worked: Duration::ZERO })));
        let of_run = |place| Self { place, faults, waited: Duration::ZERO, frame_bytes: 0, spare: Frame::default() };
        // Anyone who comes first takes it: the thread, or the run where there is no thread.
        let take = |desk: &Mutex<Option<Desk>>| desk.lock().unwrap_or_else(PoisonError::into_inner).take();
        if beside {
            let queue = Arc::new(Queue::new());
            let (jobs, taken) = (queue.clone(), desk.clone());
            let work = move || {
                let mut desk = take(&taken).expect("the run takes the desk only where there is no thread");
                jobs.serve(|job| {
                    desk.write(job, None);
                    job.frame.is_some()
                });
                desk
            };
            if let Ok(thread) = std::thread::Builder::new().name("writer".into()).spawn(work) {
                return of_run(Place::Beside { queue, thread });
            }
        }
        of_run(take(&desk).map_or(Place::Nowhere, |desk| Place::InTurn(Box::new(desk))))
    }

    /// Time that the run has waited for the writer.
    pub(super) fn waited(&self) -> Duration {
        self.waited
    }

    /// Buffers for the next frame, once there is room for it.
    pub(super) fn spare(&mut self) -> Frame {
        match &self.place {
            Place::Beside { queue, .. } => {
                self.waited += queue.make_room(self.frame_bytes);
                queue.spare().and_then(|job| job.frame).unwrap_or_default()
            }
            _ => std::mem::take(&mut self.spare),
        }
    }

    /// Hands over a job; waits for room, or until it is done.
    pub(super) fn give(&mut self, job: Job) {
        if let Some(frame) = &job.frame {
            self.frame_bytes = bytes(frame);
        }
        match &mut self.place {
            Place::Beside { queue, .. } => {
                let size = job.bytes();
                self.waited += queue.push(job, size);
            }
            Place::InTurn(desk) => {
                let begin = Instant::now();
                desk.write(&job, None);
                self.spare = job.frame.unwrap_or_default();
                self.waited += begin.elapsed();
            }
            Place::Nowhere => {}
        }
    }

    /// Hands over a job with what is shown, of which each piece is made when it is written; `false`: the
    /// writer works beside the run or needs all of it, and nothing was done.
    pub(super) fn show(&mut self, job: impl FnOnce() -> Job, shown: &dyn Shown) -> bool {
        let Place::InTurn(desk) = &mut self.place else { return false };
        if !desk.writer.takes_pieces() {
            return false;
        }
        let begin = Instant::now();
        desk.write(&job(), Some(shown));
        self.waited += begin.elapsed();
        true
    }

    /// What went wrong and was not reported yet.
    pub(super) fn fault(&self) -> Result<(), ResultsError> {
        self.faults.lock().unwrap_or_else(PoisonError::into_inner).take().map_or(Ok(()), Err)
    }

    /// Waits for all jobs, then completes the files.
    pub(super) fn end(&mut self) -> End {
        let begin = Instant::now();
        // Pictures need room of their own.
        self.spare = Frame::default();
        let mut end = End { result: Ok(()), pictures_missing: None, states_missing: None, worked: Duration::ZERO, waited: self.waited };
        if let Some(Desk { writer, worked, .. }) = self.desk() {
            let closing = Instant::now();
            end.result = self.fault();
            match guarded(|| Ok(writer.close())) {
                Ok(Closed { result, pictures_missing, states_missing }) => {
                    end.result = end.result.and(result);
                    (end.pictures_missing, end.states_missing) = (pictures_missing, states_missing);
                }
                Err(fault) => end.result = end.result.and(Err(fault)),
            }
            end.worked = worked + closing.elapsed();
        }
        end.waited += begin.elapsed();
        end
    }

    /// The writer's side back, after its last job.
    fn desk(&mut self) -> Option<Desk> {
        match std::mem::replace(&mut self.place, Place::Nowhere) {
            Place::InTurn(desk) => Some(*desk),
            Place::Beside { queue, thread } => {
                queue.close();
                // Its panics are caught where they happen.
                thread.join().ok()
            }
            Place::Nowhere => None,
        }
    }
}

impl Drop for WriterChannel {
    /// A run that was given up leaves no thread behind.
    fn drop(&mut self) {
        drop(self.desk());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_of_the_writer_is_an_error_that_says_what_happened() {
        let nothing: Vec<u8> = Vec::new();
        let error = guarded(|| Ok(nothing[3])).unwrap_err().to_string();
        assert!(error.contains("out of bounds") && error.contains("bug in embate"), "{error}");
    }
}
