//! The sum of the forces of elements on the nodes: `cargo bench -p embate-solver --bench assembly [-- ELEMENTS_ALONG_A_SIDE...]`.
//!
//! As steps do it: each chunk of 512 elements adds the forces of its corners in lanes on its own nodes, and nodes add the slots of their chunks. Against it the corner-gather
//! oracle: the forces of all corners are stored, and each node gathers its corners. Forces are made on the spot from one number per element, as kernels have them in registers.
//! One thread, both in turns in the same run; their sums must agree.

use embate_lanes::{BATCH, Batch, Indices, Kernel, Lane, Level};
use embate_solver::assembly::Assembly;
use embate_solver::bench::spinning_block;
use embate_solver::block::NO_NODE;
use embate_solver::mesh::Mesh;
use std::time::Instant;

/// Corners of an element.
const N: usize = 4;
/// Batches of a chunk.
const CHUNK: usize = 64;
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
    places: &'a Indices,
    width: usize,
    slots: &'a mut [[f64; 2]],
}

impl Kernel for Scatter<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        for (chunk, pulls) in self.slots.chunks_exact_mut(self.width).enumerate() {
            pulls.fill([0.0; 2]);
            for batch in chunk * CHUNK..((chunk + 1) * CHUNK).min(self.numbers.len()) {
                for at in (0..BATCH).step_by(L::WIDTH) {
                    L::scatter(&corners::<L>(self.numbers, batch, at), pulls, self.places, batch * N, at);
                }
            }
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

/// Nodes of the chunks side by side, the number of them, and the places of the corners among them.
fn local(connectivity: &[u32]) -> (Vec<u32>, usize, Indices) {
    let of_chunk = |cells: &[u32]| {
        let mut nodes = cells.to_vec();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    };
    let chunks: Vec<Vec<u32>> = connectivity.chunks(CHUNK * BATCH * N).map(of_chunk).collect();
    let place = |row: usize, lane: usize| {
        let (batch, corner) = (row / N, row % N);
        let node = connectivity[(batch * BATCH + lane) * N + corner];
        chunks[batch / CHUNK].binary_search(&node).expect("a chunk has the nodes of its elements") as u16
    };
    let places = Indices::new((0..connectivity.len() / BATCH).map(|row| std::array::from_fn(|lane| place(row, lane))).collect());
    let width = places.bound();
    let filled = |nodes: &Vec<u32>| nodes.iter().copied().chain(std::iter::repeat(NO_NODE)).take(width).collect::<Vec<_>>();
    (chunks.iter().flat_map(filled).collect(), width, places)
}

/// The corners of each node, ascending: where they begin, and their places among all forces, batch and lane.
fn corners_of_nodes(connectivity: &[u32], nodes: usize) -> (Vec<usize>, Vec<[u32; 2]>) {
    let mut starts = vec![0; nodes + 1];
    connectivity.iter().for_each(|&node| starts[node as usize + 1] += 1);
    (0..nodes).for_each(|node| starts[node + 1] += starts[node]);
    let (mut next, mut places) = (starts.clone(), vec![[0; 2]; connectivity.len()]);
    for (corner, &node) in connectivity.iter().enumerate() {
        let (element, at) = (corner / N, &mut next[node as usize]);
        places[*at] = [(element / BATCH * N + corner % N) as u32 * 2, (element % BATCH) as u32];
        *at += 1;
    }
    (starts, places)
}

fn main() {
    let sizes: Vec<usize> = std::env::args().skip(1).filter_map(|word| word.parse().ok()).collect();
    println!("forces of elements on nodes, ns per element, best of {ROUNDS} rounds in turns");
    for n in if sizes.is_empty() { vec![32, 100, 1000] } else { sizes } {
        let n = n.next_multiple_of(4);
        let mesh = Mesh::new(&spinning_block("quad4", "elastic", n)).expect("the model is sound");
        let (connectivity, nodes) = (&mesh.groups[0].connectivity, mesh.positions.len());
        let batches = n * n / BATCH;
        let numbers: Vec<Batch> = (0..batches).map(|b| Batch(std::array::from_fn(|lane| ((b * BATCH + lane) as f64).sin()))).collect();
        let (slots_of, width, places) = local(connectivity);
        let assembly = Assembly::new(nodes, &[&slots_of]);
        let (starts, corner_places) = corners_of_nodes(connectivity, nodes);
        let (mut slots, mut all) = (vec![[0.0; 2]; slots_of.len()], vec![Batch::default(); batches * 2 * N]);
        let [mut sums, mut oracle] = [vec![[0.0; 2]; nodes], vec![[0.0; 2]; nodes]];
        for level in Level::available() {
            let mut best = [f64::INFINITY; 2];
            for _ in 0..ROUNDS {
                let begin = Instant::now();
                level.run(Scatter { numbers: &numbers, places: &places, width, slots: &mut slots });
                let (groups, rest) = sums.as_chunks_mut::<BATCH>();
                groups.iter_mut().enumerate().for_each(|(group, sums)| *sums = assembly.forces(group, &slots));
                let first = nodes - rest.len();
                rest.iter_mut().enumerate().for_each(|(k, sum)| *sum = assembly.force(first + k, &slots));
                best[0] = best[0].min(begin.elapsed().as_secs_f64());

                let begin = Instant::now();
                level.run(Store { numbers: &numbers, all: &mut all });
                for (node, sum) in oracle.iter_mut().enumerate() {
                    *sum = corner_places[starts[node]..starts[node + 1]].iter().fold([0.0; 2], |sum, &[batch, lane]| {
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
