//! Cost of the global search per segment, from a thousand to a million segments:
//! `cargo bench -p embate-solver --bench search [NAME]`.
//!
//! Every case has so many segments and so many slave nodes. `waves`: two long wavy chains, one just above the
//! other, nodes of the one against segments of the other. `rings`: a field of small rings in random places,
//! listed in rows; all nodes against all segments. `mixed`: the same rings listed in random order.
//! `shuffled`: the same with all nodes and segments in random places of memory, the worst order there is. The
//! last two show what memory costs when the order of a list says nothing about places: once the data has
//! outgrown the caches, every look at a neighbour waits for memory, whatever the method. Small cases come in
//! several variants that take turns, because a processor learns the branches of a repeated search of a
//! thousand segments by heart, which no simulation's next search would profit from.

use embate_solver::bench::Random;
use embate_solver::contact::search::{Pair, Query, registry};
use std::hint::black_box;
use std::time::Instant;

/// Nodes and segments of one case.
struct Case {
    positions: Vec<[f64; 2]>,
    slaves: Vec<u32>,
    facets: Vec<[u32; 2]>,
}

/// Makes variant v of a case with n segments.
type Make = fn(usize, u64) -> Case;

fn waves(n: usize, variant: u64) -> Case {
    let phase = variant as f64 * 0.7;
    let chain = |lift: f64, shift: f64| {
        (0..=n).map(move |i| {
            let s = (i as f64 + shift) * 0.9;
            [s, lift + 20.0 * (s / 30.0 + phase).sin()]
        })
    };
    let positions: Vec<_> = chain(0.0, 0.0).chain(chain(0.1, 0.37)).collect();
    let (n, m) = (n as u32, n as u32 + 1);
    Case { positions, slaves: (m..m + n).collect(), facets: (0..n).map(|i| [i, i + 1]).collect() }
}

fn rings(n: usize, variant: u64) -> Case {
    ring_field(n, variant, true)
}

fn mixed(n: usize, variant: u64) -> Case {
    ring_field(n, variant, false)
}

fn ring_field(n: usize, variant: u64, in_rows: bool) -> Case {
    const AROUND: usize = 16;
    let count = n / AROUND;
    let mut random = Random::new(7 + variant);
    let side = (count as f64).sqrt() * 8.0;
    let mut case = Case { positions: vec![], slaves: vec![], facets: vec![] };
    let mut centres: Vec<_> = (0..count).map(|_| (random.unit() * side, random.unit() * side)).collect();
    if in_rows {
        let row = |y: f64| (y / 40.0).floor();
        centres.sort_by(|a, b| row(a.1).total_cmp(&row(b.1)).then(a.0.total_cmp(&b.0)));
    }
    for (ring, (x, y)) in centres.into_iter().enumerate() {
        for k in 0..AROUND {
            let (s, c) = (k as f64 * std::f64::consts::TAU / AROUND as f64).sin_cos();
            case.positions.push([x + 2.5 * c, y + 2.5 * s]);
            let at = |k: usize| (ring * AROUND + k % AROUND) as u32;
            case.slaves.push(at(k));
            case.facets.push([at(k), at(k + 1)]);
        }
    }
    case
}

fn shuffled(n: usize, variant: u64) -> Case {
    let mut case = rings(n, variant);
    let mut random = Random::new(11 + variant);
    let mut shuffle = |n: usize| {
        let mut order: Vec<usize> = (0..n).collect();
        for i in (1..n).rev() {
            order.swap(i, (random.bits() % (i as u64 + 1)) as usize);
        }
        order
    };
    let place = shuffle(case.positions.len());
    let old = case.positions.clone();
    for (i, &p) in place.iter().enumerate() {
        case.positions[p] = old[i];
    }
    case.facets = shuffle(case.facets.len()).into_iter().map(|f| case.facets[f].map(|n| place[n as usize] as u32)).collect();
    case
}

fn main() {
    // Cargo hands on `--bench`; a word is the name of a search.
    let name = std::env::args().skip(1).find(|a| !a.starts_with('-'));
    let searches = registry::<2>();
    let wanted = name.as_deref().unwrap_or(searches[0].name);
    let Some(kind) = searches.iter().find(|s| s.name == wanted) else {
        eprintln!("no search is called {wanted}; there are {:?}", searches.iter().map(|s| s.name).collect::<Vec<_>>());
        std::process::exit(2);
    };
    println!("{wanted}: nanoseconds per segment");
    println!("{:10} {:>10} {:>10} {:>10} {:>10} {:>10}", "case", "segments", "pairs", "first", "least", "median");
    let cases: [(&str, Make); 4] = [("waves", waves), ("rings", rings), ("mixed", mixed), ("shuffled", shuffled)];
    for (case_name, make) in cases {
        let mut costs = Vec::new();
        for n in [1_000, 10_000, 100_000, 1_000_000] {
            let variants: Vec<_> = (0..(16_000 / n).max(1) as u64)
                .map(|v| {
                    let case = make(n, v);
                    // Moves by a fiftieth of a segment in the step.
                    let moved: Vec<_> = case.positions.iter().map(|p| [p[0] + 0.02, p[1] - 0.015]).collect();
                    (case, moved)
                })
                .collect();
            let mut search = (kind.make)();
            let mut pairs: Vec<Pair> = Vec::new();
            let mut run = |i: usize| {
                let (case, moved) = &variants[i % variants.len()];
                let Case { positions, slaves, facets } = case;
                let query = Query { positions_old: positions, positions_new: moved, slaves, facets, reach: 0.5 };
                let start = Instant::now();
                search.pairs(black_box(&query), &mut pairs);
                black_box(&pairs);
                (start.elapsed().as_nanos() as f64 / facets.len() as f64, pairs.len())
            };
            let (first, count) = run(0);
            let mut all: Vec<f64> = (0..(5_000_000 / n).clamp(9, 500)).map(|i| run(i).0).collect();
            all.sort_by(f64::total_cmp);
            println!("{case_name:10} {n:10} {count:10} {first:10.1} {:10.1} {:10.1}", all[0], all[all.len() / 2]);
            costs.push(all[all.len() / 2]);
        }
        let (least, most) = costs.iter().fold((f64::MAX, 0.0_f64), |(l, m), &c| (l.min(c), m.max(c)));
        println!("{case_name:10} largest over smallest median {:.2}", most / least);
    }
}
