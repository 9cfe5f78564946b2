//! The sum of the forces of elements on the nodes:
//! `cargo bench -p embate-solver --bench assembly [-- ELEMENTS_ALONG_A_SIDE...]`.
//!
//! As steps do it: each chunk of 512 elements adds the forces of its corners in lanes on its own nodes, and
//! nodes add the slots of their chunks. Against it the corner-gather oracle: the forces of all corners are
//! stored, and each node gathers its corners. Forces are made on the spot from one number per element, as
//! kernels have them in registers. One thread, both in turns in the same run; their sums must agree.

use embate_lanes::{BATCH, Batch, Kernel, Lane, Level, VectorSums};
use embate_solver::assembly::Assembly;
use embate_solver::bench::spinning_block;
use embate_solver::block::{CHUNK, LocalNodes};
use embate_solver::mesh::Mesh;
use embate_solver::rows::Rows;
use std::time::Instant;

/// Corners of an element.
const N: usize = 4;
/// Force of each corner by the element's number.
const SHARES: [[f64; 2]; N] = [[0.5, -1.5], [1.0, 0.75], [-0.25, 2.0], [-1.25, -1.25]];
/// Rounds of both.
const ROUNDS: usize = 60;

/// The forces of the corners of a part of a batch.
#[inline(always)]
fn corners<L: Lane>(numbers: &[Batch], batch: usize, at: usize) -> [[L; 2]; N] {
    let number = L::load(&numbers[batch], at);
    let mut forces = [[number; 2]; N];
    // Loops, because closures are not compiled for the instruction set.
    for corner in 0..N {
        for d in 0..2 {
            forces[corner][d] = number * L::splat(SHARES[corner][d]);
        }
    }
    forces
}

/// Chunks add the forces on their own nodes.
struct Scatter<'a> {
    numbers: &'a [Batch],
    nodes: &'a LocalNodes,
    slots: &'a mut [[f64; 2]],
}

impl Kernel for Scatter<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        let mut sums = VectorSums::default();
        for (chunk, pulls) in self.slots.chunks_exact_mut(self.nodes.width()).enumerate() {
            sums.clear(pulls.len());
            for batch in chunk * CHUNK..((chunk + 1) * CHUNK).min(self.numbers.len()) {
                for at in (0..BATCH).step_by(L::WIDTH) {
                    L::scatter(&corners::<L>(self.numbers, batch, at), &mut sums, &self.nodes.places, batch * N, at);
                }
            }
            sums.copy_to(pulls);
        }
    }
}

/// The forces of all corners are stored.
struct Store<'a> {
    numbers: &'a [Batch],
    all: &'a mut [Batch],
}

impl Kernel for Store<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        for (batch, own) in self.all.chunks_exact_mut(2 * N).enumerate() {
            for at in (0..BATCH).step_by(L::WIDTH) {
                for (force, own) in corners::<L>(self.numbers, batch, at).iter().zip(own.chunks_exact_mut(2)) {
                    force[0].store(&mut own[0], at);
                    force[1].store(&mut own[1], at);
                }
            }
        }
    }
}

fn main() {
    let sizes: Vec<usize> = std::env::args().skip(1).filter_map(|word| word.parse().ok()).collect();
    println!("forces of elements on nodes, ns per element, best of {ROUNDS} rounds in turns");
    for n in if sizes.is_empty() { vec![32, 100, 1000] } else { sizes } {
        let n = n.next_multiple_of(4);
        let mesh = Mesh::<2>::new(&spinning_block("quad4", "elastic", n)).expect("the model is sound");
        let (connectivity, nodes) = (&mesh.groups[0].connectivity, mesh.positions.len());
        let batches = n * n / BATCH;
        let numbers: Vec<Batch> = (0..batches).map(|b| Batch(std::array::from_fn(|lane| ((b * BATCH + lane) as f64).sin()))).collect();
        let local = LocalNodes::new(connectivity, N);
        let assembly = Assembly::new(nodes, &[local.slots()]);
        // Where the forces of the corners of each node lie: batch and lane.
        let place =
            |(corner, &node): (usize, &u32)| (node, [(corner / N / BATCH * N + corner % N) as u32 * 2, (corner / N % BATCH) as u32]);
        let corners = Rows::new(nodes, connectivity.iter().enumerate().map(place));
        let (mut slots, mut all) = (vec![[0.0; 2]; assembly.count], vec![Batch::default(); batches * 2 * N]);
        let [mut sums, mut oracle] = [vec![[0.0; 2]; nodes], vec![[0.0; 2]; nodes]];
        for level in Level::available() {
            let mut best = [f64::INFINITY; 2];
            for _ in 0..ROUNDS {
                let begin = Instant::now();
                level.run(Scatter { numbers: &numbers, nodes: &local, slots: &mut slots });
                let (groups, rest) = sums.as_chunks_mut::<BATCH>();
                groups.iter_mut().enumerate().for_each(|(group, sums)| *sums = assembly.forces(group, &slots));
                let first = nodes - rest.len();
                rest.iter_mut().enumerate().for_each(|(k, sum)| *sum = assembly.force(first + k, &slots));
                best[0] = best[0].min(begin.elapsed().as_secs_f64());

                let begin = Instant::now();
                level.run(Store { numbers: &numbers, all: &mut all });
                for (node, sum) in oracle.iter_mut().enumerate() {
                    *sum = corners.of(node).iter().fold([0.0; 2], |sum, &[batch, lane]| {
                        let force = |d: usize| all[batch as usize + d].0[lane as usize];
                        [sum[0] + force(0), sum[1] + force(1)]
                    });
                }
                best[1] = best[1].min(begin.elapsed().as_secs_f64());
            }
            let off = sums.iter().zip(&oracle).flat_map(|(a, b)| [(a[0] - b[0]).abs(), (a[1] - b[1]).abs()]).fold(0.0, f64::max);
            assert!(off < 1e-13, "the sums differ by {off:e}");
            let [own, gathered] = best.map(|seconds| 1e9 * seconds / (n * n) as f64);
            println!(
                "  {:>9} elements  {:<6}  {own:6.2}, corner-gather oracle {gathered:6.2}: ratio {:.2}",
                n * n,
                level.name(),
                gathered / own
            );
        }
    }
}
