//! A pool of `rayon` with the threads of the run, for work on results in pieces: blocks of a field, pictures
//! of a film.
//!
//! Each piece is made by one thread from its input alone and results keep the order of the pieces, so that
//! files have the same bytes for any number of threads. Pieces come from `vtu`, `checkpoint` and `picture`;
//! how many threads there are is a setting of the run. Buffers are kept in `ScratchPool`: `map_init` of
//! `rayon` makes them again for every piece.

use rayon::prelude::*;
use std::sync::{Mutex, OnceLock, PoisonError};

/// A number of threads; they are started when they are first needed.
#[derive(Debug)]
pub struct Threads {
    count: usize,
    pool: OnceLock<Option<rayon::ThreadPool>>,
}

impl Threads {
    /// So many; 0 counts as 1.
    #[must_use]
    pub fn new(count: usize) -> Self {
        Self { count: count.max(1), pool: OnceLock::new() }
    }

    /// The thread of the caller alone.
    #[must_use]
    pub fn one() -> Self {
        Self::new(1)
    }

    /// How many.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// `work` on each piece, in the order of the pieces; each is done in one of the `scratch_pool`, which
    /// `make` makes where none is free.
    pub(crate) fn map<T: Sync, S: Send, R: Send>(
        &self,
        pieces: &[T],
        scratch_pool: &ScratchPool<S>,
        make: impl Fn() -> S + Sync + Send,
        work: impl Fn(&mut S, &T) -> R + Sync + Send,
    ) -> Vec<R> {
        // Where the system gives no threads, the caller does the work.
        let pool = || rayon::ThreadPoolBuilder::new().num_threads(self.count).build().ok();
        match if self.count > 1 && pieces.len() > 1 { self.pool.get_or_init(pool).as_ref() } else { None } {
            Some(pool) => pool.install(|| {
                let in_room = |piece| {
                    let mut room = scratch_pool.free().pop().unwrap_or_else(&make);
                    let result = work(&mut room, piece);
                    scratch_pool.free().push(room);
                    result
                };
                pieces.par_iter().with_max_len(1).map(in_room).collect()
            }),
            None => {
                let mut room = scratch_pool.free().pop().unwrap_or_else(make);
                let results = pieces.iter().map(|piece| work(&mut room, piece)).collect();
                scratch_pool.free().push(room);
                results
            }
        }
    }
}

/// What threads need for their pieces again and again: buffers, a canvas. As many as worked at the same time;
/// kept from one [`Threads::map`] to the next.
#[derive(Debug)]
pub(crate) struct ScratchPool<S>(Mutex<Vec<S>>);

impl<S> Default for ScratchPool<S> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<S> ScratchPool<S> {
    fn free(&self) -> std::sync::MutexGuard<'_, Vec<S>> {
        // A push or a pop leaves nothing half done.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_keep_the_order_of_the_pieces() {
        let pieces: Vec<u64> = (0..1000).collect();
        let squares: Vec<u64> = pieces.iter().map(|k| k * k).collect();
        for count in [0, 1, 2, 7] {
            assert_eq!(Threads::new(count).map(&pieces, &ScratchPool::default(), || (), |(), k| k * k), squares);
        }
    }

    #[test]
    fn rooms_are_made_for_threads_and_not_for_pieces() {
        let (scratch_pool, made) = (ScratchPool::default(), std::sync::atomic::AtomicUsize::new(0));
        let threads = Threads::new(3);
        for _ in 0..20 {
            threads.map(&[0; 50], &scratch_pool, || made.fetch_add(1, std::sync::atomic::Ordering::Relaxed), |_, _| ());
        }
        assert!((1..=3).contains(&made.into_inner()));
    }
}
