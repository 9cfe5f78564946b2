//! Every instruction set of this machine against the scalar reference, to the bit; `ln`, `exp`, `pow`, `cbrt`
//! against the platform's.

use crate::*;

/// Numbers; Miri is a thousand times slower, and looks at memory rather than at digits.
const COUNT: usize = if cfg!(miri) { 32 } else { 512 };

/// Numbers that provoke: zeros, signs, tiny, huge, and a deterministic spread.
fn numbers() -> Vec<f64> {
    let mut list =
        vec![0.0, -0.0, 1.0, -1.0, 0.5, 2.0, 1e-300, 1e300, -1e-17, 3.0, std::f64::consts::SQRT_2, f64::INFINITY, f64::NAN, 0.1, 7.0, 1e-3];
    let mut state = 1u64;
    while list.len() < COUNT {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let mantissa = (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5;
        list.push(mantissa * 10f64.powi(((state >> 3) % 40) as i32 - 20));
    }
    list
}

struct EveryOperation<'a>(&'a [Batch], &'a [Batch]);

impl Kernel for EveryOperation<'_> {
    type Output = Vec<u64>;
    #[inline(always)]
    fn run<L: Lane>(self) -> Vec<u64> {
        let mut results = Vec::new();
        for (a, b) in self.0.iter().zip(self.1) {
            let mut out = [Batch::default(); 15];
            let mut outside = 0;
            for at in (0..BATCH).step_by(L::WIDTH) {
                let (x, y) = (L::load(a, at), L::load(b, at));
                let positive = x.abs().max(L::splat(1e-300)).min(L::splat(1e300));
                let less = x.less(y);
                outside |= L::bits(L::either(less, L::splat(1.0).less(x))) << at;
                let all = [
                    x + y,
                    x - y,
                    x * y,
                    x / y,
                    -x,
                    positive.sqrt(),
                    x.abs(),
                    x.min(y),
                    x.max(y),
                    L::select(less, x, y),
                    math::ln(positive),
                    math::exp(y),
                    math::cbrt(positive),
                    math::pow(positive, y.abs()),
                    math::exp_above_tangent(y),
                ];
                for (value, slot) in all.into_iter().zip(&mut out) {
                    value.store(slot, at);
                }
            }
            results.push(u64::from(outside));
            // The sign and payload of a NaN are not defined by IEEE 754; everything else is.
            results.extend(out.iter().flat_map(|batch| batch.0).map(|v| if v.is_nan() { f64::NAN.to_bits() } else { v.to_bits() }));
        }
        results
    }
}

fn batches(list: &[f64]) -> Vec<Batch> {
    list.chunks_exact(BATCH).map(|chunk| Batch(chunk.try_into().unwrap())).collect()
}

#[test]
fn every_operation_gives_the_same_bits_on_every_level() {
    let a = numbers();
    let mut b = a.clone();
    b.rotate_left(5);
    let (a, b) = (batches(&a), batches(&b));
    let reference = Level::SCALAR.run(EveryOperation(&a, &b));
    for level in Level::available() {
        assert_eq!(reference, level.run(EveryOperation(&a, &b)), "{}", level.name());
    }
}

/// Gathers rows of points, adds them in a scatter of `N` rows at a time, and moves points without indices.
struct Walk<'a, const D: usize, const N: usize> {
    points: &'a [[[f64; D]; 2]],
    moving: &'a Moving<D>,
    indices: &'a Indices,
    rows: usize,
}

impl<const D: usize, const N: usize> Kernel for Walk<'_, D, N> {
    type Output = [Vec<f64>; 3];
    #[inline(always)]
    fn run<L: Lane>(self) -> [Vec<f64>; 3] {
        let (mut gathered, mut sums) = (Vec::new(), VectorSums::default());
        sums.clear(self.points.len());
        for row in (0..self.rows).step_by(N) {
            let mut out = [[[Batch::default(); D]; 2]; N];
            let mut ones = out;
            for at in (0..BATCH).step_by(L::WIDTH) {
                let mut values = [[L::splat(0.0); D]; N];
                let one = [
                    L::gather_one::<D, N, false>(self.moving, self.indices, row, at),
                    L::gather_one::<D, N, true>(self.moving, self.indices, row, at),
                ];
                for a in 0..N {
                    for k in 0..2 {
                        for d in 0..D {
                            one[k][a][d].store(&mut ones[a][k][d], at);
                        }
                    }
                    let both = L::gather(self.moving, self.indices, row + a, at);
                    values[a] = both[1];
                    for (component, slot) in both.as_flattened().iter().zip(out[a].as_flattened_mut()) {
                        component.store(slot, at);
                    }
                }
                L::scatter(&values, &mut sums, self.indices, row, at);
            }
            assert_eq!(out, ones, "one vector after the other is both at once");
            gathered.extend(out.as_flattened().as_flattened().iter().flat_map(|batch| batch.0));
        }
        let firsts: Vec<[f64; D]> = self.points.iter().map(|point| point[0]).collect();
        let mut moved = vec![[0.0; D]; firsts.len()];
        for first in (0..firsts.len() / BATCH * BATCH).step_by(L::WIDTH) {
            L::store_points(L::load_points(&firsts, first).map(|value| value + value), &mut moved, first);
        }
        let mut all = vec![[0.0; D]; sums.len()];
        sums.copy_to(&mut all);
        [gathered, all.as_flattened().to_vec(), moved.as_flattened().to_vec()]
    }
}

fn walks<const D: usize, const N: usize>() {
    let points: Vec<[[f64; D]; 2]> =
        (0..100).map(|i| std::array::from_fn(|k| std::array::from_fn(|d| 0.1 + (i * 10 + k * 3 + d) as f64))).collect();
    let rows: Vec<[u16; BATCH]> = (0..5 * N).map(|r| std::array::from_fn(|k| ((r * 37 + k * 11) % 23) as u16)).collect();
    let of = |row: &[u16; BATCH], k: usize, d: usize| row.map(|i| points[usize::from(i)][k][d]);
    let gathered: Vec<f64> = rows.iter().flat_map(|row| (0..2 * D).flat_map(move |c| of(row, c / D, c % D))).collect();
    let mut sums = vec![[0.0; D]; points.len()];
    for rows in rows.chunks(N) {
        for lane in 0..BATCH {
            for row in rows {
                let index = usize::from(row[lane]);
                (0..D).for_each(|d| sums[index][d] += points[index][1][d]);
            }
        }
    }
    let moved: Vec<f64> = points.iter().enumerate().flat_map(|(i, point)| point[0].map(|x| if i < 96 { x + x } else { 0.0 })).collect();
    let indices = Indices::new(rows);
    let mut moving = Moving::default();
    moving.resize(points.len());
    // From lists that hold them the other way round.
    let [first, second] = [0, 1].map(|k| points.iter().rev().map(|point| point[k]).collect::<Vec<_>>());
    let nodes: Vec<u32> = (0..points.len() as u32).rev().collect();
    moving.fill(&nodes, &first, &second);
    for level in Level::available() {
        let walk = Walk::<D, N> { points: &points, moving: &moving, indices: &indices, rows: 5 * N };
        assert_eq!([gathered.clone(), sums.as_flattened().to_vec(), moved.clone()], level.run(walk), "{}", level.name());
    }
}

#[test]
fn gathers_and_scatters_find_the_right_points_in_the_plane_and_in_space() {
    walks::<2, 4>();
    walks::<2, 3>();
    walks::<3, 4>();
    walks::<3, 8>();
    walks::<3, 10>();
}

/// Component by component what is loaded of points, and points of components.
struct Turned<'a, const D: usize> {
    points: &'a [[f64; D]],
    components: [&'a [Batch]; D],
}

impl<const D: usize> Kernel for Turned<'_, D> {
    type Output = [Vec<f64>; 2];
    #[inline(always)]
    fn run<L: Lane>(self) -> [Vec<f64>; 2] {
        let groups = self.points.len() / BATCH;
        let (mut loaded, mut stored) = (vec![[Batch::default(); D]; groups], vec![[0.0; D]; self.points.len()]);
        for first in (0..groups * BATCH).step_by(L::WIDTH) {
            let (group, at) = (first / BATCH, first % BATCH);
            let own: [L; D] = L::load_points(self.points, first);
            own.iter().zip(&mut loaded[group]).for_each(|(value, batch)| value.store(batch, at));
            L::store_points(std::array::from_fn(|d| L::load(&self.components[d][group], at)), &mut stored, first);
        }
        [loaded.as_flattened().iter().flat_map(|batch| batch.0).collect(), stored.as_flattened().to_vec()]
    }
}

fn turned<const D: usize>() {
    let points: Vec<[f64; D]> = (0..24).map(|i| std::array::from_fn(|d| (10 * i + d) as f64)).collect();
    let columns: [Vec<Batch>; D] =
        std::array::from_fn(|d| points.chunks(BATCH).map(|group| Batch(std::array::from_fn(|lane| group[lane][d]))).collect());
    let loaded: Vec<f64> = (0..3).flat_map(|group| columns.iter().flat_map(move |column| column[group].0)).collect();
    for level in Level::available() {
        let kernel = Turned { points: &points, components: std::array::from_fn(|d| &columns[d][..]) };
        assert_eq!([loaded.clone(), points.as_flattened().to_vec()], level.run(kernel), "{} {D}", level.name());
    }
}

#[test]
fn points_become_components_and_components_points() {
    turned::<1>();
    turned::<2>();
    turned::<3>();
    turned::<4>();
    turned::<5>();
}

/// Doubles what is in rooms by way of the lanes.
struct Double<'a> {
    rooms: &'a mut [Room],
    places: &'a Places,
}

impl Kernel for Double<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        for row in 0..self.places.len() {
            for at in (0..BATCH).step_by(L::WIDTH) {
                let mut values = L::gather_rooms(self.rooms, self.places, row, at);
                for (d, value) in values.iter_mut().enumerate() {
                    *value = L::splat(2.0) * *value + L::splat(d as f64);
                }
                L::store_rooms(values, self.rooms, self.places, row, at);
            }
        }
    }
}

#[test]
fn rooms_are_read_and_written_where_their_places_are() {
    let mut places = Places::default();
    places.resize(3);
    (0..24).for_each(|k| places.set(k / 8, k % 8, (k * 7 % 24 + 1) as u32));
    for level in Level::available() {
        let mut rooms: Vec<Room> = (0..30).map(|i| Room([0, 1, 2, 3].map(|d| f64::from(10 * i + d)))).collect();
        level.run(Double { rooms: &mut rooms, places: &places });
        for (i, room) in rooms.iter().enumerate() {
            let factor = if (1..25).contains(&i) { 2.0 } else { 1.0 };
            let expected = [0, 1, 2, 3].map(|d| factor * (10 * i + d) as f64 + (factor - 1.0) * d as f64);
            assert_eq!(room.0, expected, "{} {i}", level.name());
        }
        let refused = std::panic::catch_unwind(|| level.run(Double { rooms: &mut [Room::default(); 24], places: &places }));
        assert!(refused.is_err(), "{}", level.name());
    }
}

#[test]
fn a_gather_from_too_few_points_is_refused_on_every_level() {
    let indices = Indices::new(vec![[9; BATCH]; 2]);
    let mut moving = Moving::default();
    moving.resize(9);
    for level in Level::available() {
        let refused = std::panic::catch_unwind(|| {
            level.run(Walk::<2, 1> { points: &[[[0.0; 2]; 2]; 9], moving: &moving, indices: &indices, rows: 1 })
        });
        assert!(refused.is_err(), "{}", level.name());
    }
}

#[test]
#[cfg_attr(miri, ignore = "Miri gives the functions of the platform random last digits")]
fn transcendental_functions_are_accurate() {
    for i in 1..20_000 {
        let x = 0.001 * f64::from(i);
        assert!((math::ln(x) - x.ln()).abs() <= 4e-16 * x.ln().abs().max(1e-3) + 1e-18, "ln {x}");
        let y = x - 10.0;
        assert!((math::exp(y) / y.exp() - 1.0).abs() <= 5e-16, "exp {y}");
        // The reference cancels, all the more near zero.
        let tolerance = 1e-15 + 4e-16 / y.abs();
        assert!(y == 0.0 || (math::exp_above_tangent(y) / (y.exp_m1() - y) - 1.0).abs() <= tolerance, "e^x - 1 - x {y}");
        assert!((math::cbrt(x) / x.cbrt() - 1.0).abs() <= 5e-16, "cbrt {x}");
    }
    for exponent in -307..308 {
        let x = 1.7 * 10f64.powi(exponent);
        assert!((math::cbrt(x) / x.cbrt() - 1.0).abs() <= 5e-16, "cbrt {x}");
        assert!((math::ln(x) / x.ln() - 1.0).abs() <= 4e-16, "ln {x}");
    }
    for x in [-700.0f64, -300.0, -40.0, 40.0, 300.0, 700.0] {
        assert!((math::exp(x) / x.exp() - 1.0).abs() <= 5e-16, "exp {x}");
        assert!((math::exp_above_tangent(x) / (x.exp_m1() - x) - 1.0).abs() <= 1e-15, "e^x - 1 - x {x}");
    }
    assert_eq!(math::ln(1.0f64).to_bits(), 0.0f64.to_bits());
    assert_eq!(math::exp(0.0f64), 1.0);
    assert_eq!(math::cbrt(1.0f64), 1.0);
    assert_eq!((math::exp_above_tangent(0.0f64), math::exp_above_tangent(1e-30f64)), (0.0, 0.5 * (1e-30f64 * 1e-30)));
}

#[test]
#[cfg_attr(miri, ignore = "Miri gives the functions of the platform random last digits")]
fn powers_are_accurate_and_those_of_zero_are_zero() {
    for i in 0..4000 {
        let x = 10f64.powf(0.005 * f64::from(i) - 15.0);
        for y in [0.01, 0.2, 1.0 / 3.0, 1.0, 2.5, 8.0] {
            let expected = x.powf(y);
            let limit = 5e-16 * (1.0 + (y * x.ln()).abs());
            assert!((math::pow(x, y) / expected - 1.0).abs() <= limit, "{x} to the power of {y}");
        }
    }
    assert_eq!(math::pow(0.0f64, 0.2), 0.0);
    assert_eq!(math::pow(1.0f64, 0.2), 1.0);
}

#[test]
fn levels_are_found_by_name() {
    assert_eq!(Level::named("scalar"), Some(Level::SCALAR));
    assert_eq!(Level::named("abacus"), None);
    for level in Level::available() {
        assert_eq!(Level::named(level.name()), Some(level));
        assert!(Level::NAMES.contains(&level.name()));
    }
}
