use super::*;
use crate::contact::law::penalty::Penalty;

/// One node of mass one.
impl Movers for Mover {
    fn count(&self) -> usize {
        1
    }
    fn leader(&self, node: u32) -> (u32, Option<Vector>) {
        (node, None)
    }
    fn mover(&self, _: usize) -> Mover {
        *self
    }
}

/// A mass between two springs' walls: the energy must come back however stiff the walls and however long the step.
#[test]
fn a_bouncing_mass_keeps_its_energy_for_every_stiffness() {
    for k in [0.1, 1.0, 30.0, 1e4] {
        let dt = 1.0;
        let (mut x, mut v) = (10.3f64, [-0.37, 0.0]);
        let mut springs = Springs::new(1, 0);
        let (bodies, terms) = (Bodies::default(), [Terms { law: Box::new(Penalty), tangential: Tangential::Free, damping: 0.0 }]);
        for _ in 0..2000 {
            springs.clear();
            for (normal, gap) in [(1.0, x), (-1.0, 20.0 - x)] {
                springs.push(Spring { normal: [normal, 0.0], gap, stiffness: k, ..Spring::default() }, &[End::node(0, 1.0)]);
            }
            springs.close_group(0);
            let (old, free) = ([v], v);
            let positions = [[x, 0.0]];
            let update = Update {
                time_steps: [dt; 2],
                positions: &positions,
                nodes: &Mover { velocity_old: old[0], velocity: free, mobility: [dt, 0.0, dt] },
                bodies: &bodies,
            };
            springs.solve(&update, &terms);
            v[0] += dt * (springs.list[0].force - springs.list[1].force);
            x += dt * v[0];
            let energy = 0.5 * old[0][0] * v[0] + springs.list.iter().map(|s| s.energy).sum::<f64>();
            assert!((energy / (0.5 * 0.37 * 0.37) - 1.0).abs() < 1e-9, "stiffness {k}: {energy}");
        }
    }
}
