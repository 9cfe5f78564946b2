//! What a machine can do at best: bytes from and to memory, multiplications and additions. Rates of kernels
//! and steps are held against these.

use super::rates::best_rate;
use embate_lanes::{BATCH, Batch, Kernel, Lane, Level};
use std::hint::black_box;

/// a = b + s c.
struct Triad<'a> {
    a: &'a mut [Batch],
    b: &'a [Batch],
    c: &'a [Batch],
}

impl Kernel for Triad<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        let s = L::splat(3.0);
        for ((a, b), c) in self.a.iter_mut().zip(self.b).zip(self.c) {
            for at in (0..BATCH).step_by(L::WIDTH) {
                (L::load(b, at) + s * L::load(c, at)).store(a, at);
            }
        }
    }
}

/// Memory bandwidth in bytes per second by the triad of the STREAM benchmark (J. D. McCalpin, 1995): two
/// arrays of so many bytes are read and one is written, which counts 24 bytes for each sum, on so many
/// threads.
#[must_use]
pub fn triad(level: Level, threads: usize, bytes: usize, seconds: f64) -> f64 {
    let batches = (bytes / size_of::<Batch>()).max(threads);
    let (mut a, b, c) = (vec![Batch::splat(0.0); batches], vec![Batch::splat(1.0); batches], vec![Batch::splat(2.0); batches]);
    let piece = batches.div_ceil(threads.max(1));
    best_rate(seconds, || {
        std::thread::scope(|scope| {
            let mut pieces = a.chunks_mut(piece).zip(b.chunks(piece)).zip(c.chunks(piece));
            let own = pieces.next();
            for ((a, b), c) in pieces {
                scope.spawn(move || level.run(Triad { a, b, c }));
            }
            if let Some(((a, b), c)) = own {
                level.run(Triad { a, b, c });
            }
        });
        black_box(&a);
        (3 * batches * size_of::<Batch>()) as f64
    })
}

/// Independent chains: more than what is under way at a time, and not more than there are registers.
const CHAINS: usize = 12;

/// x = x a + b, not fused, in independent chains.
struct MultiplyAdd {
    repeats: usize,
    a: f64,
    b: f64,
}

impl Kernel for MultiplyAdd {
    type Output = f64;

    #[inline(always)]
    fn run<L: Lane>(self) -> f64 {
        let (a, b) = (L::splat(self.a), L::splat(self.b));
        let mut x = [L::splat(self.b); CHAINS];
        for _ in 0..self.repeats {
            for value in &mut x {
                *value = *value * a + b;
            }
        }
        let mut sum = L::splat(0.0);
        for value in x {
            sum += value;
        }
        let mut batch = Batch::default();
        sum.store(&mut batch, 0);
        batch.0[0]
    }
}

/// Operations per second of one thread: multiplications and additions as the kernels have them, in equal
/// number and never fused.
#[must_use]
pub fn multiply_add(level: Level, seconds: f64) -> f64 {
    let width = level.run(Width);
    let repeats = 200_000;
    best_rate(seconds, || {
        black_box(level.run(MultiplyAdd { repeats, a: black_box(0.999), b: black_box(1e-3) }));
        (2 * CHAINS * width * repeats) as f64
    })
}

/// Values in a lane.
struct Width;

impl Kernel for Width {
    type Output = usize;

    #[inline(always)]
    fn run<L: Lane>(self) -> usize {
        L::WIDTH
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_loops_do_what_they_are_counted_for() {
        let (b, c) = (vec![Batch::splat(1.0); 5], vec![Batch::splat(2.0); 5]);
        for level in Level::available() {
            let mut a = vec![Batch::default(); 5];
            level.run(Triad { a: &mut a, b: &b, c: &c });
            assert!(a.iter().all(|batch| *batch == Batch::splat(7.0)));
            // One repeat from x = b: each chain is b a + b.
            let sum = level.run(MultiplyAdd { repeats: 1, a: 3.0, b: 2.0 });
            assert_eq!(sum, CHAINS as f64 * 8.0);
        }
    }

    #[test]
    fn ceilings_are_finite_rates() {
        assert!(triad(Level::best(), 2, 1 << 20, 0.02) > 1e8);
        let rates: Vec<f64> = Level::available().into_iter().map(|level| multiply_add(level, 0.02)).collect();
        assert!(rates.iter().all(|rate| rate.is_finite() && *rate > 1e6), "{rates:?}");
    }
}
