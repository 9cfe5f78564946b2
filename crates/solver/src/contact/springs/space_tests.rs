use super::*;
use crate::contact::law::penalty::Penalty;
use crate::contact::law::tie::Tie;
use crate::contact_forces::ContactForces;
use crate::load::curve::Curves;
use crate::rigid::space::Turning;
use crate::rigid::{Acting, Body};
use crate::tensor::{cross, dot};
use proptest::prelude::*;

type Vector = [f64; 3];

/// Nodes that are free to move.
#[derive(Default)]
struct Cloud {
    mass: Vec<f64>,
    positions: Vec<Vector>,
    velocities: Vec<Vector>,
    springs: Vec<(Spring<3>, Slip<3>, Vec<End<3>>)>,
    dt: f64,
}

impl NodeResponses<3> for Cloud {
    fn count(&self) -> usize {
        self.mass.len()
    }
    fn leader(&self, node: u32) -> (u32, Option<[[f64; 3]; 3]>) {
        (node, None)
    }
    fn response(&self, node: usize) -> NodeResponse<3> {
        let (velocity, give) = (self.velocities[node], self.dt / self.mass[node]);
        NodeResponse { velocity_old: velocity, velocity, mobility: [give, 0.0, 0.0, give, 0.0, give] }
    }
}

fn terms(tangential: Tangential) -> Terms {
    Terms { law: Box::new(Penalty), tangential, damping: 0.0 }
}

fn coulomb(coefficient: f64) -> Tangential {
    Tangential::Friction(Friction { coefficient, dynamic: coefficient, decay: 0.0, viscosity: 0.0, limit: f64::INFINITY })
}

impl Cloud {
    fn solve(&self, terms: Terms, bodies: &Bodies<3>) -> Springs<3> {
        let mut springs = Springs::new(self.mass.len(), bodies.len(), vec![terms]);
        for (spring, slip, ends) in &self.springs {
            springs.push(*spring, *slip, ends);
        }
        springs.close_group(0);
        springs.solve(&Update { time_steps: [self.dt; 2], positions: &self.positions, nodes: self, bodies, level: Level::best() });
        springs
    }

    /// Velocities with the forces.
    fn pushed(&self, springs: &Springs<3>) -> Vec<Vector> {
        let mut velocities = self.velocities.clone();
        for answer in springs.answers(0..springs.list.len()) {
            for end in answer.ends() {
                let (force, node) = (answer.force_on(&end), end.at as usize);
                (0..3).for_each(|d| velocities[node][d] += self.dt * force[d] / self.mass[node]);
            }
        }
        velocities
    }

    /// What is wrong with the forces, as a fraction of the largest: what law and friction want where the
    /// others are.
    fn error(&self, springs: &Springs<3>) -> f64 {
        let (dt, terms, velocities) = (self.dt, &springs.terms[0], self.pushed(springs));
        let answers = springs.answers(0..springs.list.len());
        let largest = answers.clone().map(|answer| answer.solved.force).fold(0.0, f64::max);
        let error = |answer: Answer<'_, 3>| {
            let (Answer { spring, solved, .. }, slid) = (answer, answer.slid());
            let ends: Vec<_> = springs.ends(spring).collect();
            let rate = |along: Vector, v: &[Vector]| ends.iter().map(|end| end.share * dot(along, v[end.at as usize])).sum::<f64>();
            // Ends that are one node count together.
            let share = |node: u32| ends.iter().filter(|end| end.at == node).map(|end| end.share).sum::<f64>();
            let mut nodes: Vec<u32> = ends.iter().map(|end| end.at).collect();
            nodes.sort_unstable();
            nodes.dedup();
            let own: f64 = nodes.iter().map(|&node| share(node).powi(2) * dt / self.mass[node as usize]).sum();
            let compliance = 0.5 * dt * own;
            let old = spring.gap - 0.5 * dt * rate(spring.normal, &self.velocities);
            let free = spring.gap + 0.5 * dt * rate(spring.normal, &velocities) - compliance * solved.force;
            let wrong = (terms.law.force(&Closing { spring: &spring.patch(), old, free, compliance }, [dt; 2]) - solved.force).abs();
            let Tangential::Friction(law) = terms.tangential else { return wrong / largest };
            let tangents = answer.tangents();
            let stick = friction::FrictionInput::<3> {
                old: tangents.map(|t| rate(t, &self.velocities)),
                free: [0, 1].map(|a| rate(tangents[a], &velocities) - own * slid.friction[a]),
                compliance: [[own, 0.0], [0.0, own]],
                stiffness: terms.law.slip_stiffness(&spring.patch()),
                time_steps: [dt; 2],
            };
            let found = friction::cone::slide(&stick, answer.slip().slip, law.limit(solved.force, spring.area, 0.0));
            let off = (0..2).map(|a| (found.friction[a] - slid.friction[a]).abs()).fold(wrong, f64::max);
            off / largest
        };
        answers.map(error).fold(0.0, f64::max)
    }
}

#[test]
fn a_bouncing_mass_keeps_its_energy_for_every_stiffness_in_3d() {
    let normal = [0.48, 0.6, 0.64];
    for k in [0.1, 1.0, 30.0, 100.0, 1e4] {
        let (mut x, mut v) = (10.3f64, normal.map(|n| -0.37 * n));
        let bodies = Bodies::default();
        for _ in 0..2000 {
            let mut cloud =
                Cloud { mass: vec![1.0], positions: vec![normal.map(|n| n * x)], velocities: vec![v], dt: 1.0, ..Cloud::default() };
            for (sign, gap) in [(1.0, x), (-1.0, 20.0 - x)] {
                let spring = Spring { normal: normal.map(|n| sign * n), gap, stiffness: k, ..Spring::default() };
                cloud.springs.push((spring, Slip::default(), vec![End::node(0, 1.0)]));
            }
            let springs = cloud.solve(terms(Tangential::Free), &bodies);
            let new = cloud.pushed(&springs)[0];
            let energy = 0.5 * dot(v, new) + springs.answers(0..2).map(|answer| answer.books().energy).sum::<f64>();
            assert!((energy / (0.5 * 0.37 * 0.37) - 1.0).abs() < 1e-9, "stiffness {k}: {energy}");
            v = new;
            x += dot(v, normal);
        }
    }
}

/// A sheet of nodes that is pressed, and slides, on another one that is bumpy and finer: springs of both
/// passes to the corners of squares.
fn sheets(counts: [usize; 2], stiffness: f64) -> Cloud {
    let mut cloud = Cloud { dt: 0.01, ..Cloud::default() };
    let first = (counts[0] + 1).pow(2);
    let at = |side: usize, i: usize, j: usize| (first * side + i * (counts[side] + 1) + j) as u32;
    let height = |x: f64, y: f64| 0.01 * (9.0 * x).sin() * (7.0 * y).cos();
    for (side, count) in counts.into_iter().enumerate() {
        for (i, j) in (0..=count).flat_map(|i| (0..=count).map(move |j| (i, j))) {
            let (x, y) = (i as f64 / count as f64, j as f64 / count as f64);
            cloud.mass.push(1.0 / (count * count) as f64);
            cloud.positions.push([x, y, height(x, y) * side as f64 - 1e-3 * side as f64]);
            let side = side as f64;
            cloud.velocities.push([
                0.1 * (5.0 * y).cos(),
                0.2 * side - 0.05 * (3.0 * x).sin(),
                (0.5 - side) * (1.0 + 0.7 * (20.0 * x).sin()),
            ]);
        }
    }
    for side in 0..2 {
        let (slaves, targets) = (counts[side], counts[1 - side]);
        for (i, j) in (0..=slaves).flat_map(|i| (0..=slaves).map(move |j| (i, j))) {
            let place = |i: usize| {
                let along = i as f64 / slaves as f64 * targets as f64;
                let square = (along as usize).min(targets - 1);
                (square, along - square as f64)
            };
            let ((a, r), (b, s)) = (place(i), place(j));
            let corners = [at(1 - side, a, b), at(1 - side, a + 1, b), at(1 - side, a + 1, b + 1), at(1 - side, a, b + 1)];
            let weights = [(1.0 - r) * (1.0 - s), r * (1.0 - s), r * s, (1.0 - r) * s];
            let node = at(side, i, j);
            let below: f64 = corners.iter().zip(weights).map(|(&c, w)| w * cloud.positions[c as usize][2]).sum();
            let sign = 2.0 * side as f64 - 1.0;
            let mut ends = vec![End::node(node, 1.0)];
            ends.extend(corners.iter().zip(weights).map(|(&corner, weight)| End::node(corner, -weight)));
            let gap = sign * (cloud.positions[node as usize][2] - below);
            let spring = Spring { normal: [0.0, 0.0, sign], gap, stiffness, area: 1.0 / (slaves * slaves) as f64, ..Spring::default() };
            cloud.springs.push((spring, Slip::default(), ends));
        }
    }
    cloud
}

#[test]
fn springs_far_stiffer_than_the_nodes_between_them_are_solved_in_3d() {
    for counts in [[2, 3], [5, 7], [12, 17], [2, 13]] {
        let unit = 1e4 / (counts[0] * counts[0]) as f64;
        for scale in [0.1, 1.0, 1e2, 1e4, 1e6] {
            for tangential in [Tangential::Free, coulomb(0.3), coulomb(5.0)] {
                let cloud = sheets(counts, scale * unit);
                let springs = cloud.solve(terms(tangential), &Bodies::default());
                let (error, sweeps) = (cloud.error(&springs), springs.sweeps_max);
                assert!(
                    springs.unsolved == 0 && error < 1e-10 && sweeps <= 200,
                    "{counts:?} {scale:e} {tangential:?}: {error:e}, {sweeps} sweeps"
                );
                let after = cloud.pushed(&springs);
                for d in 0..3 {
                    let sum = |v: &[Vector]| v.iter().zip(&cloud.mass).map(|(v, m)| m * v[d]).sum::<f64>();
                    assert!((sum(&after) - sum(&cloud.velocities)).abs() < 1e-11, "momentum {d}");
                }
            }
        }
    }
}

/// Solution of a full system by elimination with pivots.
fn dense(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs())).unwrap();
        a.swap(k, pivot);
        b.swap(k, pivot);
        for i in k + 1..n {
            let factor = a[i][k] / a[k][k];
            for j in k..n {
                a[i][j] -= factor * a[k][j];
            }
            b[i] -= factor * b[k];
        }
    }
    for k in (0..n).rev() {
        b[k] = (b[k] - (k + 1..n).map(|j| a[k][j] * b[j]).sum::<f64>()) / a[k][k];
    }
    b
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]
    /// Ties are linear in all directions, so a full matrix gives their forces.
    #[test]
    fn ties_in_3d_have_the_forces_of_the_full_system(
        nodes in 2usize..8,
        seeds in prop::collection::vec((0u32..8, 0u32..8, 0u32..8, (0.0f64..6.3, -0.9f64..0.9), -1.0f64..1.0, 0.1f64..0.9), 1..9),
        exponent in -1i32..5,
    ) {
        let k = 10f64.powi(exponent);
        let mut cloud = Cloud { dt: 0.01, ..Cloud::default() };
        for node in 0..nodes {
            cloud.mass.push(1.0 + 0.3 * node as f64);
            cloud.positions.push([node as f64, 0.0, 0.0]);
            cloud.velocities.push([(3.0 * node as f64).sin(), (5.0 * node as f64).cos(), (2.0 * node as f64).sin()]);
        }
        for (s, a, b, (angle, z), gap, weight) in seeds {
            let ends = [(s, 1.0), (a, weight - 1.0), (b, -weight)].map(|(node, share)| End::node(node % nodes as u32, share));
            let flat = (1.0 - z * z).sqrt();
            let spring = Spring { normal: [flat * angle.cos(), flat * angle.sin(), z], gap, stiffness: k * 1e4, ..Spring::default() };
            cloud.springs.push((spring, Slip::of([0.3 * gap, 0.2 - gap]), ends.to_vec()));
        }
        let terms = Terms { law: Box::new(Tie { rigid: false, joins_ends: false }), tangential: Tangential::Tied, damping: 0.0 };
        let springs = cloud.solve(terms, &Bodies::default());
        let (dt, count) = (0.01, cloud.springs.len());
        let direction = |u: usize| {
            let normal = cloud.springs[u / 3].0.normal;
            let [first, second] = Dim::<3>::tangents(normal, &[0.0; 3]);
            [normal, first, second][u % 3]
        };
        let row = |u: usize, node: usize| {
            let share: f64 = cloud.springs[u / 3].2.iter().filter(|end| end.at as usize == node).map(|end| end.share).sum();
            direction(u).map(|n| share * n)
        };
        let entry = |u: usize, v: usize| (0..nodes).map(|node| 0.5 * dt * dt / cloud.mass[node] * dot(row(u, node), row(v, node))).sum::<f64>();
        // F = -k (g⁻ + g⁺) / 2, so 2 F / k + Σ A F = -(g⁻ + g⁺ without forces); equal steps: = -2 g^n.
        let matrix: Vec<Vec<f64>> = (0..3 * count).map(|u| (0..3 * count).map(|v| entry(u, v) + if u == v { 2.0 / (k * 1e4) } else { 0.0 }).collect()).collect();
        let right = (0..3 * count).map(|u| {
            let (spring, slip, _) = &cloud.springs[u / 3];
            -2.0 * [spring.gap, slip.slip[0], slip.slip[1]][u % 3]
        }).collect();
        let wanted = dense(matrix, right);
        let largest = wanted.iter().fold(0.0f64, |largest, force| largest.max(force.abs()));
        prop_assert_eq!(springs.unsolved, 0);
        for (i, answer) in springs.answers(0..count).enumerate() {
            let [first, second] = answer.slid().friction;
            let found = [answer.solved.force, first, second];
            let error = (0..3).map(|a| (found[a] - wanted[3 * i + a]).abs() / largest).fold(0.0, f64::max);
            // Both lose digits where a spring is much stiffer than its nodes.
            prop_assert!(error < 1e-11 * k.max(1.0), "{:?} {}", error, springs.sweeps_max);
        }
    }
}

/// A body that is dropped on a floor on one of its corners, with friction or without: points of it push on
/// plane springs.
#[test]
fn a_rigid_body_that_bounces_on_its_corners_keeps_its_energy_and_with_friction_loses_some() {
    let corners = [
        [0.5, 0.3, 0.4],
        [-0.5, 0.3, 0.4],
        [0.5, -0.3, 0.4],
        [0.5, 0.3, -0.4],
        [-0.5, -0.3, -0.4],
        [0.5, -0.3, -0.4],
        [-0.5, 0.3, -0.4],
        [-0.5, -0.3, 0.4],
    ];
    for (tangential, k) in
        [(Tangential::Free, 0.1), (Tangential::Free, 1e3), (Tangential::Free, 1e5), (coulomb(0.3), 1e3), (coulomb(10.0), 1e4)]
    {
        let turning = Turning::of_masses(corners.map(|corner| (0.25, corner)));
        let velocity = [0.3, 0.1, -1.0, 0.4, 1.0, -0.3];
        let body = Body { centre: [0.0, 0.0, 1.2], velocity, turning, mass: [2.0, 2.0, 2.0, 0.0, 0.0, 0.0], ..Body::default() };
        let mut bodies = Bodies::<3>::default();
        bodies.add(body);
        let (curves, dt) = (Curves::default(), 0.01);
        bodies.start(&curves, &[], &mut []);
        let cloud = Cloud { dt, ..Cloud::default() };
        let mut slips = [[0.0; 2]; 8];
        let (mut first, mut lost, mut pressed) = (None, 0.0, 0);
        for _ in 0..600 {
            bodies.set_free(&Acting {
                mean_step: dt,
                from: 0.0,
                to: dt,
                curves: &curves,
                positions: &[],
                loads: &[],
                internal: |_| [0.0; 3],
                moment: &|_| None,
            });
            let body = bodies.state(0);
            let mut springs = Springs::new(0, 1, vec![terms(tangential)]);
            for (corner, slip) in corners.iter().zip(slips) {
                let arm = body.to_global(*corner);
                let point = [0, 1, 2].map(|d| body.centre[d] + arm[d]);
                let spring = Spring { normal: [0.0, 0.0, 1.0], gap: point[2], stiffness: k, ..Spring::default() };
                springs.push(spring, Slip { slip, tangent: [1.0, 0.0, 0.0] }, &[End { at: 0, share: 1.0, point, ..End::default() }]);
                // A lid that it comes back from.
                let lid = Spring { normal: [0.0, 0.0, -1.0], gap: 3.0 - point[2], stiffness: k, ..Spring::default() };
                springs.push(lid, Slip::default(), &[End { at: 0, share: 1.0, point, ..End::default() }]);
            }
            springs.close_group(0);
            springs.solve(&Update { time_steps: [dt; 2], positions: &[], nodes: &cloud, bodies: &bodies, level: Level::best() });
            let mut stored = 0.0;
            for (number, answer) in springs.answers(0..16).enumerate() {
                let (books, force) = (answer.books(), answer.solved.force);
                stored += books.stored[0];
                lost += books.lost.friction;
                if number % 2 == 0 {
                    slips[number / 2] = answer.slid().slip_new;
                }
                pressed += usize::from(force > 0.0);
                for end in answer.ends() {
                    bodies.push_at(0, answer.force_on(&end), end.point());
                }
            }
            let sums = bodies.accelerate([dt; 2], &ContactForces::new(0), &[], &mut []);
            let now = sums.kinetic_half + stored + lost;
            let begin = *first.get_or_insert(now);
            // Between half steps corners go along arcs: of second order in the step.
            assert!((now / begin - 1.0).abs() < 0.02, "{k} {tangential:?}: {now} {begin}");
            bodies.advance(dt, &mut []);
        }
        assert!(pressed > 10, "it bounces");
        assert_eq!(lost > 0.0, tangential != Tangential::Free);
    }
}

#[test]
fn friction_and_normal_forces_of_a_spring_keep_the_angular_momentum_where_its_rows_are_blind_to_rotation() {
    // A node above a triangle: the slip's rows know how the triangle turns.
    let positions = vec![[0.3, 0.25, 0.05], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let (weights, gradients) = ([0.45, 0.3, 0.25], [[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]]);
    let (arm, normal): (f64, Vector) = (0.05, [0.0, 0.0, 1.0]);
    let mut ends = vec![End::node(0, 1.0)];
    let spring = Spring { normal, gap: -0.01, stiffness: 1e3, area: 1.0, ..Spring::default() };
    let slip = Slip { tangent: [0.6, 0.8, 0.0], ..Slip::default() };
    let tangents = Dim::<3>::tangents(normal, &slip.tangent);
    for k in 0..3 {
        let turn = tangents.map(|t| normal.map(|n| arm * (t[0] * gradients[k][0] + t[1] * gradients[k][1]) * n));
        ends.push(End { turn, ..End::node(k as u32 + 1, -weights[k]) });
    }
    let velocities = vec![[1.0, -0.5, -1.0], [0.0, 0.1, 0.2], [0.3, 0.0, 0.0], [0.0, -0.2, 0.1]];
    let cloud = Cloud { mass: vec![1.0, 2.0, 1.5, 0.7], positions, velocities, springs: vec![(spring, slip, ends)], dt: 0.01 };
    let springs = cloud.solve(terms(coulomb(0.4)), &Bodies::default());
    let answer = springs.answers(0..1).next().unwrap();
    assert!(answer.solved.force > 0.0 && answer.slid().slides && answer.slid().friction[0].abs() > 0.0);
    let after = cloud.pushed(&springs);
    let moment = |v: &[Vector]| {
        let of = |k: usize| cross(cloud.positions[k], v[k].map(|v| cloud.mass[k] * v));
        (0..4).map(of).fold([0.0; 3], |sum, m| [0, 1, 2].map(|d| sum[d] + m[d]))
    };
    let (before, now) = (moment(&cloud.velocities), moment(&after));
    assert!((0..3).all(|d| (before[d] - now[d]).abs() < 1e-15), "{before:?} {now:?}");
}

/// What touches only as long as another spring does not push yet has slid nowhere: else the order of the
/// springs would decide what it remembers.
#[test]
fn a_spring_that_is_open_in_the_end_remembers_no_slip_of_an_earlier_sweep() {
    let spring =
        |normal: Vector, gap: f64| (Spring { normal, gap, stiffness: 1e4, ..Spring::default() }, Slip::default(), vec![End::node(0, 1.0)]);
    let [grazes, presses] = [spring([0.6, 0.0, 0.8], 1e-3), spring([0.0, 0.0, 1.0], -0.02)];
    for springs in [[grazes.clone(), presses.clone()], [presses, grazes]] {
        let is_open = |spring: &Spring<3>| spring.gap > 0.0;
        let cloud =
            Cloud { mass: vec![1.0], positions: vec![[0.0; 3]], velocities: vec![[-0.2, 0.1, -1.0]], springs: springs.to_vec(), dt: 0.01 };
        let solved = cloud.solve(terms(coulomb(0.6)), &Bodies::default());
        for answer in solved.answers(0..2) {
            assert_eq!(is_open(answer.spring), answer.solved.force == 0.0);
            let slid = answer.slid();
            let remembers = slid.slip_new != [0.0; 2] || slid.slides;
            assert_eq!(remembers, !is_open(answer.spring), "{slid:?}");
        }
    }
}

/// A rigid body that lies on a bed of nodes: springs between each of these and the body, and, as nodes of the
/// body would have them, between the body and the middle of each four.
fn bed(count: usize, heaviness: f64, stiffness: f64) -> (Cloud, Bodies<3>, [f64; 4]) {
    let mut cloud = Cloud { dt: 0.01, ..Cloud::default() };
    let place = |i: usize| i as f64 / (count - 1) as f64 - 0.5;
    for (i, j) in (0..count).flat_map(|i| (0..count).map(move |j| (i, j))) {
        cloud.mass.push(1.0 / (count * count) as f64);
        cloud.positions.push([place(i), place(j), 0.0]);
        cloud.velocities.push([0.05 * (5.0 * place(j)).cos(), 0.1, 0.5 + 0.7 * (9.0 * place(i)).sin()]);
    }
    let corners = [[0.5, 0.4, 0.1], [-0.5, 0.4, 0.1], [0.5, -0.4, 0.1], [-0.5, -0.4, 0.1]];
    let all = corners.into_iter().flat_map(|[x, y, z]| [[x, y, z], [x, y, -z]]);
    let mass = heaviness / 8.0;
    let turning = Turning::of_masses(all.map(|corner| (mass, corner)));
    // About x, y and z.
    let inertia = [0.4f64.powi(2) + 0.01, 0.5f64.powi(2) + 0.01, 0.5f64.powi(2) + 0.4f64.powi(2)].map(|square| heaviness * square);
    let velocity = [0.3, -0.1, -1.0, 0.4, -0.2, 0.3];
    let body =
        Body { centre: [0.03, -0.02, 0.2], velocity, turning, mass: [heaviness, heaviness, heaviness, 0.0, 0.0, 0.0], ..Body::default() };
    let mut bodies = Bodies::<3>::default();
    bodies.add(body);
    let curves = Curves::default();
    bodies.start(&curves, &[], &mut []);
    #[rustfmt::skip]
    bodies.set_free(&Acting {
        mean_step: cloud.dt, from: 0.0, to: cloud.dt, curves: &curves, positions: &[], loads: &[], internal: |_| [0.0; 3], moment: &|_| None,
    });
    let mut push = |point: Vector, ends: Vec<End<3>>| {
        let gap = 2e-3 * (3.0 * point[0]).cos() * (4.0 * point[1]).sin() - 1e-3;
        let (tangent, area) = ([1.0, 0.0, 0.0], 1.0 / (count * count) as f64);
        let spring = Spring { normal: [0.0, 0.0, 1.0], gap, stiffness, area, ..Spring::default() };
        let own = End { at: (count * count) as u32, share: 1.0, point, ..End::default() };
        cloud.springs.push((spring, Slip { tangent, ..Slip::default() }, [vec![own], ends].concat()));
    };
    let at = |i: usize, j: usize| (i * count + j) as u32;
    for (i, j) in (0..count).flat_map(|i| (0..count).map(move |j| (i, j))) {
        push([place(i), place(j), 0.0], vec![End::node(at(i, j), -1.0)]);
        if i + 1 < count && j + 1 < count {
            let middle = |k: usize| 0.5 * (place(k) + place(k + 1));
            let corners = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            push([middle(i), middle(j), 0.0], corners.map(|corner| End::node(corner, -0.25)).to_vec());
        }
    }
    (cloud, bodies, [heaviness, inertia[0], inertia[1], inertia[2]])
}

#[test]
fn a_rigid_body_on_a_thousand_springs_moves_as_their_forces_want_it_however_light_it_is() {
    for heaviness in [1e-3, 0.1, 1.0, 100.0] {
        for (tangential, scale) in [(Tangential::Free, 0.3), (Tangential::Free, 10.0), (coulomb(0.3), 1.0), (coulomb(3.0), 1.0)] {
            let count = 24;
            let unit = 1e4 / (count * count) as f64;
            let (cloud, bodies, [mass, inertia @ ..]) = bed(count, heaviness, scale * unit);
            let springs = cloud.solve(terms(tangential), &bodies);
            let (dt, body, nodes) = (cloud.dt, bodies.state(0), count * count);
            let answers = || springs.answers(0..springs.list.len());
            // What all move with, from the forces alone.
            let (mut velocities, mut push, mut moment) = (cloud.velocities.clone(), [0.0; 3], [0.0; 3]);
            for answer in answers() {
                for end in answer.ends() {
                    let (force, node) = (answer.force_on(&end), end.at as usize);
                    if node < nodes {
                        (0..3).for_each(|d| velocities[node][d] += dt * force[d] / cloud.mass[node]);
                    } else {
                        let turn = cross([0, 1, 2].map(|d| end.point()[d] - body.centre[d]), force);
                        (0..3).for_each(|d| (push[d], moment[d]) = (push[d] + force[d], moment[d] + turn[d]));
                    }
                }
            }
            let moved = |velocity: &[f64; 6], forces: f64| {
                let linear = [0, 1, 2].map(|d| velocity[d] + forces * dt * push[d] / mass);
                (linear, [0, 1, 2].map(|d| velocity[3 + d] + forces * dt * moment[d] / inertia[d]))
            };
            let states = [(moved(&body.velocity_old, 0.0), &cloud.velocities), (moved(&body.velocity_free, 1.0), &velocities)];
            let rate = |answer: &Answer<'_, 3>, along: Vector, state: usize| {
                let ((linear, spin), nodes_move) = &states[state];
                let of = |end: KeptEnd<'_, 3>| {
                    let velocity = nodes_move.get(end.at as usize).copied().unwrap_or_else(|| {
                        let turn = cross(*spin, [0, 1, 2].map(|d| end.point()[d] - body.centre[d]));
                        [0, 1, 2].map(|d| linear[d] + turn[d])
                    });
                    end.share * dot(along, velocity)
                };
                answer.ends().map(of).sum::<f64>()
            };
            let largest = answers().map(|answer| answer.solved.force).fold(0.0, f64::max);
            let (mut worst, mut open, mut slides) = (0.0f64, 0, 0);
            for answer in answers() {
                let (Answer { spring, solved, .. }, slid) = (answer, answer.slid());
                let tangents = answer.tangents();
                // Any share of its own answer may be left out.
                let own: f64 = answer.ends().filter(|end| (end.at as usize) < nodes).map(|end| end.share.powi(2) * dt * nodes as f64).sum();
                let [old, new] = [0, 1].map(|state| rate(&answer, spring.normal, state));
                let closing = Closing {
                    spring: &spring.patch(),
                    old: spring.gap - 0.5 * dt * old,
                    free: spring.gap + 0.5 * dt * (new - own * solved.force),
                    compliance: 0.5 * dt * own,
                };
                worst = worst.max((Penalty.force(&closing, [dt; 2]) - solved.force).abs() / largest);
                open += usize::from(solved.force == 0.0);
                if let Tangential::Friction(law) = tangential {
                    let stick = friction::FrictionInput::<3> {
                        old: tangents.map(|t| rate(&answer, t, 0)),
                        free: [0, 1].map(|a| rate(&answer, tangents[a], 1) - own * slid.friction[a]),
                        compliance: [[own, 0.0], [0.0, own]],
                        stiffness: Penalty.slip_stiffness(&spring.patch()),
                        time_steps: [dt; 2],
                    };
                    let found = friction::cone::slide(&stick, answer.slip().slip, law.limit(solved.force, spring.area, 0.0));
                    worst = (0..2).map(|a| (found.friction[a] - slid.friction[a]).abs() / largest).fold(worst, f64::max);
                    slides += usize::from(slid.slides && solved.force > 0.0);
                }
            }
            let case =
                format!("mass {heaviness}, {tangential:?}, {scale}: {worst:e}, {} sweeps, {open} open, {slides} slide", springs.sweeps_max);
            assert!(springs.unsolved == 0 && worst < 1e-10 && largest > 0.0, "{case}");
            println!("{case}");
            assert!(springs.sweeps_max < 200, "{case}");
        }
    }
}
