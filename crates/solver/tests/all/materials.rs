//! What every registered law promises by itself, in plane strain and in 3D: rest, objectivity, energy,
//! dissipation, stiffness, equal bits.

use crate::patches::{Spread, YOUNG, eigenvalues, lists, options, parameters, solids};
use embate_lanes::{BATCH, Batch, Kernel, Lane, Level};
use embate_solver::material::{Family, Kinematics, Law, LawVisitor, Parameters, Response, State, with_law};
use embate_solver::tensor::{Plane, PlaneRotation, Solid, SymmetricTensor, product};

type Full = [[f64; 3]; 3];
const ONE: Full = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// A tensor that can be made from and shown as a full matrix.
trait Shown: SymmetricTensor<f64> {
    const IN_PLANE: bool;
    fn of(m: &Full) -> Self;
    fn full(&self) -> Full;
    fn rotation(q: &Full) -> Self::Rotation;
}

impl Shown for Plane<f64> {
    const IN_PLANE: bool = true;
    fn of(m: &Full) -> Self {
        Self([m[0][0], m[1][1], m[2][2], m[0][1]])
    }
    fn full(&self) -> Full {
        let [xx, yy, zz, xy] = self.0;
        [[xx, xy, 0.0], [xy, yy, 0.0], [0.0, 0.0, zz]]
    }
    fn rotation(q: &Full) -> PlaneRotation<f64> {
        PlaneRotation::new(q[0][0], q[1][0])
    }
}

impl Shown for Solid<f64> {
    const IN_PLANE: bool = false;
    fn of(m: &Full) -> Self {
        Self([m[0][0], m[1][1], m[2][2], m[0][1], m[1][2], m[2][0]])
    }
    fn full(&self) -> Full {
        let [xx, yy, zz, xy, yz, zx] = self.0;
        [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]]
    }
    fn rotation(q: &Full) -> Full {
        *q
    }
}

fn transposed(m: &Full) -> Full {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]))
}

fn determinant(m: &Full) -> f64 {
    let minor = |a: usize, b: usize| m[1][a] * m[2][b] - m[1][b] * m[2][a];
    m[0][0] * minor(1, 2) - m[0][1] * minor(0, 2) + m[0][2] * minor(0, 1)
}

/// A random tensor of this size without the components that the plane does not have.
fn random<T: Shown>(size: f64, numbers: &mut Spread) -> Full {
    let mut m: Full = std::array::from_fn(|_| std::array::from_fn(|_| numbers.between(-size, size)));
    if T::IN_PLANE {
        (m[0][2], m[1][2], m[2][0], m[2][1]) = (0.0, 0.0, 0.0, 0.0);
    }
    m
}

fn random_symmetric<T: Shown>(size: f64, numbers: &mut Spread) -> Full {
    T::of(&random::<T>(size, numbers)).full()
}

fn random_rotation<T: Shown>(numbers: &mut Spread) -> Full {
    let about = |axis: usize, angle: f64| {
        let (s, c) = angle.sin_cos();
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut q = ONE;
        (q[i][i], q[i][j], q[j][i], q[j][j]) = (c, -s, s, c);
        q
    };
    let z = about(2, numbers.between(-3.0, 3.0));
    if T::IN_PLANE { z } else { product(&product(&about(0, numbers.between(-3.0, 3.0)), &z), &about(1, numbers.between(-3.0, 3.0))) }
}

/// A random deformation gradient with positive determinant.
fn random_deformation<T: Shown>(size: f64, numbers: &mut Spread) -> Full {
    loop {
        let g = random::<T>(size, numbers);
        let f: Full = std::array::from_fn(|i| std::array::from_fn(|j| ONE[i][j] + g[i][j]));
        if determinant(&f) > 0.3 {
            return f;
        }
    }
}

fn virgin<M: Law, T: Shown>() -> M::State<f64, T> {
    law::<M>(0.3).start()
}

fn law<M: Law>(poisson: f64) -> M {
    let (values, lists) = (parameters(&M::KIND, poisson), lists(&M::KIND));
    M::new(&Parameters::new(M::KIND.parameters, &values, &lists))
}

/// The law with every set of options.
fn variants<M: Law>() -> Vec<M> {
    let make = |set: Vec<(&str, f64)>| {
        let (mut values, lists) = (parameters(&M::KIND, 0.3), lists(&M::KIND));
        values.extend(set.into_iter().map(|(name, value)| (name.to_string(), value)));
        let parameters = Parameters::new(M::KIND.parameters, &values, &lists);
        assert!(M::faults(&parameters).is_empty(), "{:?}", M::faults(&parameters));
        M::new(&parameters)
    };
    options(&M::KIND).into_iter().map(make).collect()
}

fn deformed<T: Shown>(f: &Full) -> Kinematics<f64, T> {
    let b = T::of(&product(f, &transposed(f)));
    let zero = T::isotropic(0.0);
    Kinematics {
        time_step: 1.0 / 64.0,
        viscous_heat: 0.0,
        strain_increment: zero,
        rotation: T::rotation(&ONE),
        stress_rotated: zero,
        left_cauchy_green: b,
        volume_ratio: determinant(f),
    }
}

fn strained<T: Shown>(stress: &Full, increment: &Full) -> Kinematics<f64, T> {
    Kinematics { strain_increment: T::of(increment), stress_rotated: T::of(stress), ..deformed(&ONE) }
}

fn difference(a: &Full, b: &Full) -> f64 {
    (0..9).map(|k| (a[k / 3][k % 3] - b[k / 3][k % 3]).abs()).fold(0.0, f64::max)
}

/// A test that calls `$check::<M, T>()` for every law and both tensors.
macro_rules! every_law {
    ($name:ident, $check:ident) => {
        #[test]
        fn $name() {
            struct Check;
            impl LawVisitor for Check {
                type Output = ();
                fn visit<M: Law>(self) {
                    $check::<M, Plane<f64>>();
                    $check::<M, Solid<f64>>();
                }
            }
            for kind in solids() {
                with_law(kind.name, Check).unwrap();
            }
        }
    };
}

fn rest<M: Law, T: Shown>() {
    let mut state = virgin::<M, T>();
    let response = law::<M>(0.3).update(&deformed::<T>(&ONE), &mut state);
    assert!(difference(&response.stress.full(), &[[0.0; 3]; 3]) < 1e-14 * YOUNG, "{}", M::KIND.name);
    assert!(response.stored.abs() < 1e-28 * YOUNG && response.dissipated == 0.0, "{}: {}", M::KIND.name, response.stored);
}
every_law!(there_is_no_stress_and_no_energy_at_rest, rest);

fn objectivity<M: Law, T: Shown>() {
    let laws = variants::<M>();
    let mut numbers = Spread::new(21);
    for law in laws.iter().cycle().take(200 * laws.len()) {
        let q = random_rotation::<T>(&mut numbers);
        let turned = |m: &Full| product(&product(&q, m), &transposed(&q));
        let (mut state, mut state_turned) = (virgin::<M, T>(), virgin::<M, T>());
        let f = random_deformation::<T>(0.5, &mut numbers);
        let (stress, increment) = (random_symmetric::<T>(0.01 * YOUNG, &mut numbers), random_symmetric::<T>(0.05, &mut numbers));
        let [(a, stored_a), (b, stored_b)] = match M::FAMILY {
            Family::Rate => [law.update(&strained::<T>(&stress, &increment), &mut state), {
                // What lies in a direction must have been turned before.
                law.update(&Kinematics { rotation: T::rotation(&q), ..deformed::<T>(&ONE) }, &mut state_turned);
                law.update(&strained::<T>(&turned(&stress), &turned(&increment)), &mut state_turned)
            }],
            Family::Hyperelastic => {
                [law.update(&deformed::<T>(&f), &mut state), law.update(&deformed::<T>(&product(&q, &f)), &mut state_turned)]
            }
        }
        .map(|response| (response.stress, response.stored + response.dissipated));
        assert!(difference(&turned(&a.full()), &b.full()) < 1e-11 * YOUNG, "{}", M::KIND.name);
        assert!((stored_a - stored_b).abs() < 1e-11 * YOUNG, "{}", M::KIND.name);
    }
}
every_law!(a_turned_input_gives_the_turned_stress_and_the_same_energy, objectivity);

fn stress_from_energy<M: Law, T: Shown>() {
    if M::FAMILY != Family::Hyperelastic {
        return;
    }
    let mut numbers = Spread::new(22);
    for round in 0..200 {
        let law = law::<M>([-0.5, 0.0, 0.3, 0.49][round % 4]);
        let f = random_deformation::<T>(0.6, &mut numbers);
        let energy = |f: &Full| law.update(&deformed::<T>(f), &mut virgin::<M, T>()).stored;
        assert!(energy(&f) > 0.0, "{}", M::KIND.name);
        // P = ∂W/∂F by Richardson's differences, σ = P Fᵀ / J.
        let mut p = [[0.0; 3]; 3];
        for (i, row) in p.iter_mut().enumerate() {
            for (j, value) in row.iter_mut().enumerate() {
                if T::IN_PLANE && (i == 2) != (j == 2) {
                    continue;
                }
                let slope = |h: f64| {
                    let (mut plus, mut minus) = (f, f);
                    plus[i][j] += h;
                    minus[i][j] -= h;
                    (energy(&plus) - energy(&minus)) / (2.0 * h)
                };
                *value = (4.0 * slope(1e-4) - slope(2e-4)) / 3.0;
            }
        }
        let expected = product(&p, &transposed(&f)).map(|row| row.map(|value| value / determinant(&f)));
        let stress = law.update(&deformed::<T>(&f), &mut virgin::<M, T>()).stress.full();
        assert!(difference(&stress, &expected) < 1e-7 * YOUNG, "{}: {stress:?} for {expected:?} at {f:?}", M::KIND.name);
    }
}
every_law!(the_stress_of_a_hyperelastic_law_is_the_slope_of_its_energy, stress_from_energy);

fn small_energies<M: Law, T: Shown>() {
    if M::FAMILY != Family::Hyperelastic {
        return;
    }
    let law = law::<M>(0.3);
    let mut numbers = Spread::new(23);
    for _ in 0..50 {
        // W = ½ K tr² + µ dev:dev for strains so small that differences of numbers near one would be all
        // noise.
        let strain = random_symmetric::<T>(1e-9, &mut numbers);
        let f: Full = std::array::from_fn(|i| std::array::from_fn(|j| ONE[i][j] + strain[i][j]));
        let e = T::of(&strain);
        let [bulk, shear] = law.stiffness();
        let expected = 0.5 * bulk * e.trace() * e.trace() + shear * e.deviator().contract(e.deviator());
        let stored = law.update(&deformed::<T>(&f), &mut virgin::<M, T>()).stored;
        assert!((stored / expected - 1.0).abs() < 1e-5, "{}: {stored} for {expected}", M::KIND.name);
    }
}
every_law!(the_energy_of_tiny_strains_does_not_drown_in_round_off, small_energies);

/// Waves along many directions need at most `modulus`, and some of them nearly as much; `stress` is linear in
/// the strain.
fn bounds_every_wave<T: Shown>(name: &str, modulus: f64, stress: impl Fn(&Full) -> Full) {
    let mut numbers = Spread::new(28);
    let mut largest = 0.0f64;
    for _ in 0..2000 {
        let n = direction::<T>(&mut numbers);
        let mut q = vec![vec![0.0; 3]; 3];
        for k in (0..3).filter(|&k| !T::IN_PLANE || k < 2) {
            let strain: Full = std::array::from_fn(|i| {
                std::array::from_fn(|j| 0.5 * (f64::from(u8::from(i == k)) * n[j] + f64::from(u8::from(j == k)) * n[i]))
            });
            let stress = stress(&strain);
            for i in 0..3 {
                q[i][k] = (0..3).map(|j| stress[i][j] * n[j]).sum();
            }
        }
        largest = largest.max(eigenvalues(q)[2] / modulus);
    }
    assert!(largest < 1.0 + 1e-12 && largest > 0.95, "{name}: the fastest wave needs {largest} of the reported modulus");
}

/// A random unit vector.
fn direction<T: Shown>(numbers: &mut Spread) -> [f64; 3] {
    let n = [numbers.between(-1.0, 1.0), numbers.between(-1.0, 1.0), if T::IN_PLANE { 0.0 } else { numbers.between(-1.0, 1.0) }];
    let length = n.iter().map(|v| v * v).sum::<f64>().sqrt();
    n.map(|v| v / length)
}

fn initial_stiffness<M: Law, T: Shown>() {
    for poisson in [-0.5, 0.0, 0.3, 0.49] {
        let law = law::<M>(poisson);
        let [bulk, shear] = law.stiffness();
        if M::KIND.parameters.iter().any(|parameter| parameter.name == "poisson") {
            let found = [bulk * 3.0 * (1.0 - 2.0 * poisson) / YOUNG, shear * 2.0 * (1.0 + poisson) / YOUNG];
            assert!(found.iter().all(|ratio| (ratio - 1.0).abs() < 1e-14), "{}: {found:?}", M::KIND.name);
        }
        let stress = |strain: &Full| {
            let f: Full = std::array::from_fn(|i| std::array::from_fn(|j| ONE[i][j] + strain[i][j]));
            let kinematics = match M::FAMILY {
                // At once: what relaxes has no time to.
                Family::Rate => Kinematics { time_step: 1e-12, ..strained::<T>(&[[0.0; 3]; 3], strain) },
                Family::Hyperelastic => deformed::<T>(&f),
            };
            law.update(&kinematics, &mut virgin::<M, T>()).stress.full()
        };
        const H: f64 = 1e-6;
        let response = law.update(&deformed::<T>(&ONE), &mut virgin::<M, T>());
        assert!((response.bulk / bulk - 1.0).abs() < 1e-14 && (response.shear / shear - 1.0).abs() < 1e-14, "{}", M::KIND.name);
        if !M::ISOTROPIC {
            bounds_every_wave::<T>(M::KIND.name, bulk + 4.0 / 3.0 * shear, |strain| {
                stress(&strain.map(|row| row.map(|e| H * e))).map(|row| row.map(|s| s / H))
            });
            continue;
        }
        let mut numbers = Spread::new(24);
        let strain = random_symmetric::<T>(H, &mut numbers);
        let negative = strain.map(|row| row.map(|value| -value));
        let (plus, minus) = (stress(&strain), stress(&negative));
        let slope: Full = std::array::from_fn(|i| std::array::from_fn(|j| 0.5 * (plus[i][j] - minus[i][j])));
        let e = T::of(&strain);
        let expected = T::isotropic(bulk * e.trace()).plus(e.deviator().times(2.0 * shear)).full();
        assert!(difference(&slope, &expected) < 1e-8 * H * bulk.max(shear), "{}: {slope:?} for {expected:?}", M::KIND.name);
    }
}
every_law!(the_stiffness_at_rest_is_the_slope_of_the_stress_and_the_reported_one, initial_stiffness);

/// Acoustic tensor: with F → (I + h a⊗n) F the traction on the unit face n (which this does not change) grows
/// by h Q a.
fn acoustic_tensor<M: Law, T: Shown>(law: &M, f: &Full, n: [f64; 3]) -> Full {
    const H: f64 = 1e-5;
    let traction = |k: usize, h: f64| {
        let shift: Full = std::array::from_fn(|i| std::array::from_fn(|j| ONE[i][j] + if i == k { h * n[j] } else { 0.0 }));
        let stress = law.update(&deformed::<T>(&product(&shift, f)), &mut virgin::<M, T>()).stress.full();
        std::array::from_fn::<f64, 3, _>(|i| (0..3).map(|j| stress[i][j] * n[j]).sum())
    };
    let mut q = [[0.0; 3]; 3];
    for k in (0..3).filter(|&k| !T::IN_PLANE || k < 2) {
        let (plus, minus) = (traction(k, H), traction(k, -H));
        for i in 0..3 {
            q[i][k] = (plus[i] - minus[i]) / (2.0 * H);
        }
    }
    q
}

fn sound_speed<M: Law, T: Shown>() {
    if M::FAMILY != Family::Hyperelastic {
        return;
    }
    let mut numbers = Spread::new(25);
    let mut largest = 0.0f64;
    for round in 0..1000 {
        let law = law::<M>([-0.5, 0.0, 0.3, 0.49][round % 4]);
        let f = random_deformation::<T>([1e-3, 0.3, 0.9, 3.0][round / 4 % 4], &mut numbers);
        let n = direction::<T>(&mut numbers);
        let q = acoustic_tensor::<M, T>(&law, &f, n);
        let symmetric = (0..3).map(|i| (0..3).map(|j| 0.5 * (q[i][j] + q[j][i])).collect()).collect();
        let response = law.update(&deformed::<T>(&f), &mut virgin::<M, T>());
        let modulus = response.bulk + 4.0 / 3.0 * response.shear;
        let ratio = eigenvalues(symmetric)[2] / modulus;
        largest = largest.max(ratio);
        assert!(ratio < 1.0 + 1e-6, "{}: ρc² is {ratio} of the reported modulus at {f:?}", M::KIND.name);
    }
    assert!(largest > 0.95, "{}: the reported modulus is never less than {} of the need", M::KIND.name, 1.0 / largest);
}
every_law!(no_wave_in_a_strained_hyperelastic_law_is_faster_than_it_reports, sound_speed);

fn dissipation<M: Law, T: Shown>() {
    for law in variants::<M>() {
        let mut numbers = Spread::new(26);
        let (mut state, mut stress, mut total) = (virgin::<M, T>(), [[0.0; 3]; 3], 0.0);
        for step in 0..5000 {
            let size = [1e-3, 1e-2, 1e-1][step % 3];
            let kinematics = match M::FAMILY {
                Family::Rate => strained::<T>(&stress, &random_symmetric::<T>(size, &mut numbers)),
                Family::Hyperelastic => deformed::<T>(&random_deformation::<T>(0.5, &mut numbers)),
            };
            let response: Response<f64, T> = law.update(&kinematics, &mut state);
            assert!(response.dissipated >= 0.0, "{}", M::KIND.name);
            assert!(response.stored >= 0.0 && response.bulk > 0.0 && response.shear > 0.0, "{}", M::KIND.name);
            (stress, total) = (response.stress.full(), total + response.dissipated);
        }
        assert_eq!(total > 0.0, M::DISSIPATES, "{} dissipates {total}", M::KIND.name);
    }
}
every_law!(dissipation_is_never_negative, dissipation);

/// Updates of a law in 3D for batches of kinematics; everything that comes out, as bits.
struct Updates<'a, M: Law>(&'a M, &'a [[Batch; 13]]);

impl<M: Law> Kernel for Updates<'_, M> {
    type Output = Vec<u64>;
    #[inline(always)]
    fn run<L: Lane>(self) -> Vec<u64> {
        let mut results = Vec::new();
        let mut values = vec![Batch::default(); <M::State<f64, Solid<f64>> as State<f64>>::COUNT];
        for lane in 0..BATCH {
            self.0.start::<f64, Solid<f64>>().store(&mut values, lane);
        }
        for input in self.1 {
            let mut out = [Batch::default(); 10];
            for at in (0..BATCH).step_by(L::WIDTH) {
                let (zero, one) = (L::splat(0.0), L::splat(1.0));
                let kinematics = Kinematics {
                    time_step: L::splat(1.0 / 64.0),
                    viscous_heat: zero,
                    strain_increment: <Solid<L> as SymmetricTensor<L>>::load(&input[..6], at),
                    stress_rotated: <Solid<L> as SymmetricTensor<L>>::load(&input[6..12], at),
                    left_cauchy_green: <Solid<L> as SymmetricTensor<L>>::load(&input[..6], at).plus(Solid::isotropic(one)),
                    rotation: [[one, zero, zero], [zero, one, zero], [zero, zero, one]],
                    volume_ratio: L::load(&input[12], at),
                };
                let mut state = <M::State<L, Solid<L>> as State<L>>::load(&values, at);
                let response = self.0.update(&kinematics, &mut state);
                state.store(&mut values, at);
                response.stress.store(&mut out, at);
                response.stored.store(&mut out[6], at);
                response.dissipated.store(&mut out[7], at);
                response.bulk.store(&mut out[8], at);
                response.shear.store(&mut out[9], at);
            }
            results.extend(out.iter().chain(&values).flat_map(|batch| batch.0).map(f64::to_bits));
        }
        results
    }
}

#[test]
fn every_instruction_set_gives_the_bits_of_the_scalar_one() {
    struct Check;
    impl LawVisitor for Check {
        type Output = ();
        fn visit<M: Law>(self) {
            let mut numbers = Spread::new(27);
            let mut batch = |low: f64, high: f64| Batch(std::array::from_fn(|_| numbers.between(low, high)));
            let inputs: Vec<[Batch; 13]> = (0..100)
                .map(|_| {
                    std::array::from_fn(|k| match k {
                        0..6 => batch(-0.05, 0.05),
                        6..12 => batch(-0.01 * YOUNG, 0.01 * YOUNG),
                        _ => batch(0.5, 2.0),
                    })
                })
                .collect();
            for law in variants::<M>() {
                let reference = Level::SCALAR.run(Updates(&law, &inputs));
                for level in Level::available() {
                    assert!(level.run(Updates(&law, &inputs)) == reference, "{} {}", M::KIND.name, level.name());
                }
            }
        }
    }
    for kind in solids() {
        with_law(kind.name, Check).unwrap();
    }
}
