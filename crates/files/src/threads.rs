//! Threads that share the work on results in pieces: blocks of a field, pictures of a film.
//!
//! Each piece is made by one thread from its input alone and results keep the order of the pieces, so that files have the same bytes for any number
//! of threads. Pieces come from `vtu` and `picture`; how many threads there are says the run.

use rayon::prelude::*;
use std::sync::OnceLock;

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

    /// `work` on each piece, in the order of the pieces; `scratch` makes what a thread needs for its pieces again and again.
    pub(crate) fn map<T: Sync, S, R: Send>(
        &self,
        pieces: &[T],
        scratch: impl Fn() -> S + Sync + Send,
        work: impl Fn(&mut S, &T) -> R + Sync + Send,
    ) -> Vec<R> {
        // Where the system gives no threads, the caller does the work.
        let pool = || rayon::ThreadPoolBuilder::new().num_threads(self.count).build().ok();
        match if self.count > 1 && pieces.len() > 1 { self.pool.get_or_init(pool).as_ref() } else { None } {
            Some(pool) => pool.install(|| pieces.par_iter().with_max_len(1).map_init(scratch, work).collect()),
            None => {
                let mut scratch = scratch();
                pieces.iter().map(|piece| work(&mut scratch, piece)).collect()
            }
        }
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
            assert_eq!(Threads::new(count).map(&pieces, || (), |(), k| k * k), squares);
        }
    }
}
