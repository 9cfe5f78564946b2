use super::*;
use crate::contact::law::multiplier::Multiplier;
use crate::contact::law::penalty::Penalty;
use crate::contact::law::tie::Tie;
use proptest::prelude::*;

/// A vector in 2D.
type Vector = [f64; 2];

/// One node of mass one.
impl NodeResponses<2> for NodeResponse<2> {
    fn count(&self) -> usize {
        1
    }
    fn leader(&self, node: u32) -> (u32, Option<Vector>) {
        (node, None)
    }
    fn response(&self, _: usize) -> NodeResponse<2> {
        *self
    }
}

/// A mass between two springs' walls: the energy must come back however stiff the walls and however long the
/// step.
#[test]
fn a_bouncing_mass_keeps_its_energy_for_every_stiffness() {
    for k in [0.1, 1.0, 30.0, 1e4] {
        let dt = 1.0;
        let (mut x, mut v) = (10.3f64, [-0.37, 0.0]);
        let (bodies, terms) = (Bodies::default(), vec![Terms { law: Box::new(Penalty), tangential: Tangential::Free, damping: 0.0 }]);
        let mut springs = Springs::new(1, 0, terms);
        for _ in 0..2000 {
            springs.clear();
            for (normal, gap) in [(1.0, x), (-1.0, 20.0 - x)] {
                springs.push(
                    Spring { normal: [normal, 0.0], gap, stiffness: k, ..Spring::default() },
                    Slip::default(),
                    &[End::node(0, 1.0)],
                );
            }
            springs.close_group(0);
            let (old, free) = ([v], v);
            let positions = [[x, 0.0]];
            let update = Update {
                time_steps: [dt; 2],
                positions: &positions,
                nodes: &NodeResponse { velocity_old: old[0], velocity: free, mobility: [dt, 0.0, dt] },
                bodies: &bodies,
                level: Level::best(),
            };
            springs.solve(&update);
            v[0] += dt * springs.answers(0..2).map(|answer| answer.spring.normal[0] * answer.solved.force).sum::<f64>();
            x += dt * v[0];
            let energy = 0.5 * old[0][0] * v[0] + springs.answers(0..2).map(|answer| answer.books().energy).sum::<f64>();
            assert!((energy / (0.5 * 0.37 * 0.37) - 1.0).abs() < 1e-9, "stiffness {k}: {energy}");
        }
    }
}

/// Two rows of nodes with unlike spacing, one above the other, and the springs of a double pass between them.
struct Rows {
    mass: Vec<f64>,
    positions: Vec<Vector>,
    velocities: Vec<Vector>,
    springs: Vec<(Spring<2>, Slip<2>, Vec<End<2>>)>,
}

/// `counts` segments below and above, `stiffness` of each spring.
fn rows(counts: [usize; 2], stiffness: f64) -> Rows {
    let mut rows = Rows { mass: vec![], positions: vec![], velocities: vec![], springs: vec![] };
    let at = |side: usize, i: usize| (counts[0] + 1) as u32 * side as u32 + i as u32;
    for (side, count) in counts.into_iter().enumerate() {
        for i in 0..=count {
            let x = i as f64 / count as f64;
            rows.mass.push(if i == 0 || i == count { 0.5 } else { 1.0 } / count as f64);
            rows.positions.push([x, 0.01 * (9.0 * x).sin() * side as f64 - 1e-3 * side as f64]);
            rows.velocities.push([0.1 * (5.0 * x).cos(), (0.5 - side as f64) * (1.0 + 0.7 * (20.0 * x).sin())]);
        }
    }
    for side in 0..2 {
        let (slaves, targets) = (counts[side], counts[1 - side]);
        for i in 0..=slaves {
            let along = i as f64 / slaves as f64 * targets as f64;
            let segment = (along as usize).min(targets - 1);
            let weight = along - segment as f64;
            let [s, a, b] = [at(side, i), at(1 - side, segment), at(1 - side, segment + 1)].map(|node| node as usize);
            let height = rows.positions[s][1] - (1.0 - weight) * rows.positions[a][1] - weight * rows.positions[b][1];
            let sign = 2.0 * side as f64 - 1.0;
            let ends = vec![End::node(s as u32, 1.0), End::node(a as u32, weight - 1.0), End::node(b as u32, -weight)];
            let spring = Spring { normal: [0.0, sign], gap: sign * height, stiffness, area: 1.0 / slaves as f64, ..Spring::default() };
            rows.springs.push((spring, Slip::default(), ends));
        }
    }
    rows
}

impl NodeResponses<2> for Rows {
    fn count(&self) -> usize {
        self.mass.len()
    }
    fn leader(&self, node: u32) -> (u32, Option<Vector>) {
        (node, None)
    }
    fn response(&self, node: usize) -> NodeResponse<2> {
        let (velocity, give) = (self.velocities[node], 0.01 / self.mass[node]);
        NodeResponse { velocity_old: velocity, velocity, mobility: [give, 0.0, give] }
    }
}

impl Rows {
    fn solve(&self, terms: Terms) -> Springs<2> {
        let mut springs = Springs::new(self.mass.len(), 0, vec![terms]);
        self.solve_again(&mut springs, Level::best());
        springs
    }

    fn solve_again(&self, springs: &mut Springs<2>, level: Level) {
        springs.clear();
        for (spring, slip, ends) in &self.springs {
            springs.push(*spring, *slip, ends);
        }
        springs.close_group(0);
        let update = Update { time_steps: [0.01; 2], positions: &self.positions, nodes: self, bodies: &Bodies::default(), level };
        springs.solve(&update);
    }

    /// What is wrong with the forces, as a fraction of the largest: what each law wants where the others are.
    fn error(&self, springs: &Springs<2>) -> f64 {
        let (dt, terms) = (0.01, &springs.terms[0]);
        let answers = springs.answers(0..springs.list.len());
        let mut velocities = self.velocities.clone();
        for answer in answers.clone() {
            for end in answer.ends() {
                let force = answer.force_on(&end);
                (0..2).for_each(|d| velocities[end.at as usize][d] += dt * force[d] / self.mass[end.at as usize]);
            }
        }
        let rate = |spring: &Spring<2>, v: &[Vector]| {
            springs
                .ends(spring)
                .map(|end| end.share * (v[end.at as usize][0] * spring.normal[0] + v[end.at as usize][1] * spring.normal[1]))
                .sum::<f64>()
        };
        let largest = answers.clone().map(|answer| answer.solved.force).fold(0.0, f64::max);
        let errors = answers.map(|Answer { spring, solved, .. }| {
            let compliance: f64 = springs.ends(spring).map(|end| 0.5 * dt * dt * end.share * end.share / self.mass[end.at as usize]).sum();
            let old = spring.gap - 0.5 * dt * rate(spring, &self.velocities);
            let free = spring.gap + 0.5 * dt * rate(spring, &velocities) - compliance * solved.force;
            (terms.law.force(&Closing { spring: &spring.patch(), old, free, compliance }, [dt; 2]) - solved.force).abs() / largest
        });
        errors.fold(0.0, f64::max)
    }
}

fn coulomb(coefficient: f64) -> Tangential {
    Tangential::Friction(Friction { coefficient, dynamic: coefficient, decay: 0.0, viscosity: 0.0, limit: f64::INFINITY })
}

#[test]
fn springs_far_stiffer_than_the_nodes_between_them_are_solved_in_few_sweeps() {
    // The last: so many springs at a node that they do not know each other one by one.
    for counts in [[4, 5], [8, 11], [60, 77], [300, 411], [3, 60]] {
        // m / dt² of a node.
        let unit = 1e4 / counts[0] as f64;
        for scale in [0.1, 1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e7] {
            for tangential in [Tangential::Free, coulomb(0.3), coulomb(5.0)] {
                let terms = Terms { law: Box::new(Penalty), tangential, damping: 0.0 };
                let rows = rows(counts, scale * unit);
                let springs = rows.solve(terms);
                let (error, sweeps) = (rows.error(&springs), springs.sweeps_max);
                assert!(
                    springs.unsolved == 0 && error < 1e-11 && sweeps <= 80,
                    "{counts:?} {scale:e} {tangential:?}: {error:e}, {sweeps} sweeps"
                );
            }
        }
    }
}

#[test]
fn more_constraints_than_nodes_to_move_are_solved() {
    for counts in [[4, 5], [8, 11], [60, 77], [3, 60]] {
        for tangential in [Tangential::Free, coulomb(0.3)] {
            let terms = Terms { law: Box::new(Multiplier), tangential, damping: 0.0 };
            let rows = rows(counts, 0.0);
            let springs = rows.solve(terms);
            let (error, sweeps) = (rows.error(&springs), springs.sweeps_max);
            assert!(springs.unsolved == 0 && error < 1e-11 && sweeps <= 80, "{counts:?} {tangential:?}: {error:e}, {sweeps} sweeps");
        }
    }
}

#[test]
fn islands_are_solved_to_the_same_bits_by_any_number_of_threads() {
    let mut all = Rows { mass: vec![], positions: vec![], velocities: vec![], springs: vec![] };
    for copy in 0..24 {
        let one = rows([20 + copy, 41], 1e3 * 4f64.powi(copy as i32 % 8));
        let first = all.mass.len() as u32;
        all.mass.extend(one.mass);
        all.positions.extend(one.positions);
        all.velocities.extend(one.velocities);
        let shift = |end: &End<2>| End { at: end.at + first, ..*end };
        all.springs.extend(one.springs.iter().map(|(spring, slip, ends)| (*spring, *slip, ends.iter().map(shift).collect())));
    }
    assert!(all.springs.len() > 1500);
    let solved = |threads: Option<usize>| {
        let solve = || {
            let springs = all.solve(Terms { law: Box::new(Penalty), tangential: coulomb(0.2), damping: 0.0 });
            springs.answers(0..springs.list.len()).map(|answer| (*answer.solved, answer.slid())).collect::<Vec<_>>()
        };
        match threads {
            None => solve(),
            Some(threads) => rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(solve),
        }
    };
    let alone = solved(None);
    assert!(alone.iter().filter(|(solved, _)| solved.force > 0.0).count() > 500);
    for threads in [1, 2, 8] {
        assert!(solved(Some(threads)) == alone, "{threads} threads");
    }
}

#[test]
fn every_instruction_set_and_any_number_of_threads_find_the_same_bits() {
    // Some islands together, one in clusters, and one that sweeps do not solve.
    for (counts, scale) in [([8, 11], 0.3), ([60, 77], 1.0), ([300, 411], 0.3), ([1500, 1999], 1.0), ([300, 411], 1e4)] {
        let rows = rows(counts, scale * 1e4 / counts[0] as f64);
        for tangential in [Tangential::Free, coulomb(0.3), Tangential::Tied] {
            let found = |level: Level, threads: usize| {
                let solve = || {
                    let mut springs = Springs::new(rows.mass.len(), 0, vec![Terms { law: Box::new(Penalty), tangential, damping: 0.0 }]);
                    rows.solve_again(&mut springs, level);
                    springs.answers(0..springs.list.len()).map(|answer| (*answer.solved, answer.slid())).collect::<Vec<_>>()
                };
                rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(solve)
            };
            let expected = found(Level::SCALAR, 1);
            assert!(expected.iter().any(|(solved, _)| solved.force > 0.0));
            for level in Level::available() {
                for threads in [1, 2, 5] {
                    assert!(found(level, threads) == expected, "{counts:?} {tangential:?}: {} on {threads} threads", level.name());
                }
            }
        }
    }
}

#[test]
fn what_is_kept_while_springs_have_the_same_ends_changes_nothing() {
    let scenes = [rows([60, 77], 300.0), rows([300, 411], 60.0), rows([300, 411], 20.0), rows([60, 77], 100.0), rows([61, 76], 100.0)];
    let nodes = scenes.iter().map(|rows| rows.mass.len()).max().unwrap();
    let terms = || vec![Terms { law: Box::new(Penalty), tangential: coulomb(0.3), damping: 0.0 }];
    let mut kept = Springs::new(nodes, 0, terms());
    // One after the other, some twice: with the ends of the step before, and with others.
    for scene in [0, 3, 3, 1, 2, 1, 0, 4, 4, 0] {
        scenes[scene].solve_again(&mut kept, Level::best());
        let mut new = Springs::new(nodes, 0, terms());
        scenes[scene].solve_again(&mut new, Level::best());
        let all =
            |springs: &Springs<2>| springs.answers(0..springs.list.len()).map(|answer| (*answer.solved, answer.slid())).collect::<Vec<_>>();
        assert!(all(&kept) == all(&new), "scene {scene}");
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
    /// Ties are linear in both directions, so a full matrix gives their forces.
    #[test]
    fn ties_have_the_forces_of_the_full_system(
        nodes in 2usize..8,
        seeds in prop::collection::vec((0u32..8, 0u32..8, 0u32..8, 0.0f64..6.3, -1.0f64..1.0, 0.1f64..0.9), 1..9),
        exponent in -1i32..5,
    ) {
        let k = 10f64.powi(exponent);
        let mut rows = Rows { mass: vec![], positions: vec![], velocities: vec![], springs: vec![] };
        for node in 0..nodes {
            rows.mass.push(1.0 + 0.3 * node as f64);
            rows.positions.push([node as f64, 0.0]);
            rows.velocities.push([(3.0 * node as f64).sin(), (5.0 * node as f64).cos()]);
        }
        for (s, a, b, angle, gap, weight) in seeds {
            let ends = [(s, 1.0), (a, weight - 1.0), (b, -weight)].map(|(node, share)| End::node(node % nodes as u32, share));
            let spring = Spring { normal: [angle.cos(), angle.sin()], gap, stiffness: k * 1e4, ..Spring::default() };
            rows.springs.push((spring, Slip::of([0.3 * gap]), ends.to_vec()));
        }
        let terms = Terms { law: Box::new(Tie { rigid: false, joins_ends: false }), tangential: Tangential::Tied, damping: 0.0 };
        let springs = rows.solve(terms);
        let (dt, count) = (0.01, rows.springs.len());
        let direction = |u: usize| if u < count { rows.springs[u].0.normal } else { tangent(rows.springs[u - count].0.normal) };
        let row = |u: usize, node: usize| {
            let share: f64 = rows.springs[u % count].2.iter().filter(|end| end.at as usize == node).map(|end| end.share).sum();
            direction(u).map(|n| share * n)
        };
        let product = |a: Vector, b: Vector| a[0] * b[0] + a[1] * b[1];
        let entry = |u: usize, v: usize| (0..nodes).map(|node| 0.5 * dt * dt / rows.mass[node] * product(row(u, node), row(v, node))).sum::<f64>();
        // F = -k (g⁻ + g⁺) / 2, so 2 F / k + Σ A F = -(g⁻ + g⁺ without forces); equal steps: = -2 g^n.
        let matrix: Vec<Vec<f64>> = (0..2 * count).map(|u| (0..2 * count).map(|v| entry(u, v) + if u == v { 2.0 / (k * 1e4) } else { 0.0 }).collect()).collect();
        let right = (0..2 * count).map(|u| -2.0 * if u < count { rows.springs[u].0.gap } else { rows.springs[u - count].1.slip[0] }).collect();
        let wanted = dense(matrix, right);
        let largest = wanted.iter().fold(0.0f64, |largest, force| largest.max(force.abs()));
        prop_assert_eq!(springs.unsolved, 0);
        for (i, answer) in springs.answers(0..count).enumerate() {
            let errors = [answer.solved.force - wanted[i], answer.slid().friction[0] - wanted[count + i]].map(|error| error.abs() / largest);
            // Both lose digits where a spring is much stiffer than its nodes.
            prop_assert!(errors[0].max(errors[1]) < 1e-11 * k.max(1.0), "{:?} {}", errors, springs.sweeps_max);
        }
    }
}
