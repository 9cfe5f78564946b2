//! The mean rigid motion of a patch of nodes, and forces that do the same work on it.
//!
//! With equal weights w of the nodes, their mean c = Σ w x_a and their arms ρ_a = R (x_a − c)⁰, R is the
//! rotation that brings the arms of the start nearest to those of now: Σ w |x_a − c − ρ_a|² is least where
//! S = Σ w (x_a − c) ρ_aᵀ is symmetric. Its rate is
//!
//! ω = K⁻¹ Σ w ρ_a × v_a,   K = tr(S) 1 − S,
//!
//! so a force F at x and a moment M become the forces w (F + K⁻¹ ((x − c) × F + M) × ρ_a) on the nodes. These
//! have the resultant F and about any point the moment of F and M, because S is symmetric, whatever the nodes
//! do; and their work is that of F and M on the mean motion.

use crate::archive::{Archive, ArchiveResult, Persist};
use crate::model::in_3d;
use crate::rigid::space::Attitude;
use crate::rotation::{Square, applied, inverse};
use crate::tensor::cross;
use crate::vector::{dot, minus, plus, times};

/// A patch is flat enough to hold no moment about some axis where det K is below this part of (tr K / 3)³.
const FLAT: f64 = 1e-9;
/// Corrections of the rotation in a step, and that below which there is none, rad.
const CORRECTIONS: usize = 20;
const ROUND_OFF: f64 = 1e-15;
/// Where a rotation is far off, rad.
const FAR: f64 = 0.1;

/// A patch of nodes.
#[derive(Clone, Debug)]
pub(super) struct Patch {
    pub(super) nodes: Vec<u32>,
    /// From the mean at the start, m.
    arms: Vec<[f64; 3]>,
    /// The point that it leads, m.
    point: [f64; 3],
    /// R, and what follows from it and the places of the nodes: c, ρ, K⁻¹.
    pub(super) attitude: Attitude,
    centre: [f64; 3],
    arms_now: Vec<[f64; 3]>,
    inverse: Square<3>,
    is_flat: bool,
}

impl Persist for Patch {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        self.attitude.persist(archive)
    }
}

impl Patch {
    /// Of these nodes, leading a point (m); `None`: they can't hold a rigid body.
    pub(super) fn new<const D: usize>(nodes: Vec<u32>, positions: &[[f64; D]], point: [f64; 3]) -> Option<Self> {
        let first = in_3d(positions[*nodes.first()? as usize]);
        let place = |node: &u32| minus(in_3d(positions[*node as usize]), first);
        let mean = times(1.0 / nodes.len() as f64, nodes.iter().map(place).fold([0.0; 3], plus));
        let arms: Vec<[f64; 3]> = nodes.iter().map(|node| minus(place(node), mean)).collect();
        let mut patch = Self {
            point: minus(point, plus(first, mean)),
            arms_now: arms.clone(),
            arms,
            nodes,
            attitude: Attitude::default(),
            centre: [0.0; 3],
            inverse: [[0.0; 3]; 3],
            is_flat: false,
        };
        let size = patch.size();
        let moment = patch.moment(&patch.arms);
        patch.is_flat = D == 2;
        let holds = if D == 2 {
            size > 0.0
        } else {
            let (sum, determinant) = (moment[0][0] + moment[1][1] + moment[2][2], dot(moment[0], cross(moment[1], moment[2])));
            size > 0.0 && determinant > FLAT * (sum / 3.0).powi(3)
        };
        holds.then_some(patch)
    }

    /// Root of the mean square of its arms, m.
    pub(super) fn size(&self) -> f64 {
        (self.arms.iter().map(|arm| dot(*arm, *arm)).sum::<f64>() / self.arms.len() as f64).sqrt()
    }

    /// K, of nodes at these places from their mean.
    fn moment(&self, places: &[[f64; 3]]) -> Square<3> {
        let share = 1.0 / self.arms.len() as f64;
        let mut stretch = [[0.0; 3]; 3];
        for (place, arm) in places.iter().zip(&self.arms_now) {
            for (row, x) in stretch.iter_mut().zip(place) {
                row.iter_mut().zip(arm).for_each(|(sum, y)| *sum += share * x * y);
            }
        }
        let trace = stretch[0][0] + stretch[1][1] + stretch[2][2];
        std::array::from_fn(|i| {
            std::array::from_fn(|j| if i == j { trace - stretch[i][i] } else { -0.5 * (stretch[i][j] + stretch[j][i]) })
        })
    }

    /// Inverse of [`Patch::moment`], in 2D about z alone.
    fn yielding(&self, places: &[[f64; 3]]) -> Square<3> {
        let moment = self.moment(places);
        if !self.is_flat {
            return inverse(&moment);
        }
        let mut about_z = [[0.0; 3]; 3];
        about_z[2][2] = 1.0 / moment[2][2];
        about_z
    }

    /// Takes the places of the nodes.
    pub(super) fn follow<const D: usize>(&mut self, positions: &[[f64; D]]) {
        let share = 1.0 / self.nodes.len() as f64;
        let first = in_3d(positions[self.nodes[0] as usize]);
        let mut places: Vec<[f64; 3]> = self.nodes.iter().map(|&node| minus(in_3d(positions[node as usize]), first)).collect();
        let mean = times(share, places.iter().copied().fold([0.0; 3], plus));
        places.iter_mut().for_each(|place| *place = minus(*place, mean));
        self.centre = plus(first, mean);
        for _ in 0..CORRECTIONS {
            for (now, arm) in self.arms_now.iter_mut().zip(&self.arms) {
                *now = self.attitude.turned(*arm);
            }
            self.inverse = self.yielding(&places);
            let off = self.arms_now.iter().zip(&places).fold([0.0; 3], |sum, (arm, place)| plus(sum, times(share, cross(*arm, *place))));
            let mut turn = applied(&self.inverse, off);
            // Far away Newton's method may find another stationary rotation; with the moment of inertia of
            // the patch the way is sin θ of the angle θ that is left.
            if dot(turn, turn) > FAR * FAR {
                turn = applied(&self.yielding(&self.arms_now), off);
            }
            // Nothing that is not finite: what is wrong is reported with the nodes.
            if !(dot(turn, turn) > ROUND_OFF * ROUND_OFF) || !turn.iter().all(|angle| angle.is_finite()) {
                break;
            }
            self.attitude = Attitude::exponential(turn).after(&self.attitude);
        }
    }

    /// Where the point is, m.
    pub(super) fn point(&self) -> [f64; 3] {
        plus(self.centre, self.attitude.turned(self.point))
    }

    /// Forces on the nodes of a force at `x` (m) and a moment.
    pub(super) fn rows(&self, force: [f64; 3], x: [f64; 3], moment: [f64; 3]) -> impl Iterator<Item = (u32, [f64; 3])> {
        let share = 1.0 / self.nodes.len() as f64;
        let spin = applied(&self.inverse, plus(cross(minus(x, self.centre), force), moment));
        self.nodes.iter().zip(&self.arms_now).map(move |(&node, &arm)| (node, times(share, plus(force, cross(spin, arm)))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Eight nodes that are not in a plane, moved by a rotation and a displacement that is not rigid.
    fn moved(turn: [f64; 3], strain: f64) -> (Patch, Vec<[f64; 3]>) {
        let start: Vec<[f64; 3]> = (0..8).map(|k| [f64::from(k % 3) + 5.0, 0.7 * f64::from(k % 2), 0.1 * f64::from(k * k % 5)]).collect();
        let mut patch = Patch::new((0..8).collect(), &start, [6.0, 1.0, 2.0]).unwrap();
        let by = Attitude::exponential(turn);
        let now: Vec<[f64; 3]> = start
            .iter()
            .enumerate()
            .map(|(k, x)| plus(by.turned(*x), times(strain, [(k as f64).sin(), (2.0 * k as f64).cos(), (3.0 * k as f64).sin()])))
            .collect();
        patch.follow(&now);
        (patch, now)
    }

    #[test]
    fn a_rigid_motion_is_followed_to_the_last_digits() {
        for turn in [[0.01, 0.02, -0.01], [0.9, -0.3, 0.4], [-1.5, 1.2, 0.7], [2.9, 0.0, 0.3]] {
            let (patch, _) = moved(turn, 0.0);
            let (exact, point) = (Attitude::exponential(turn).matrix(), Attitude::exponential(turn).turned([6.0, 1.0, 2.0]));
            let found = patch.attitude.matrix();
            // Places are rounded at 7 m, arms across are a tenth of a metre.
            let off = exact.as_flattened().iter().zip(found.as_flattened()).fold(0.0f64, |off, (a, b)| off.max((a - b).abs()));
            assert!(off < 3e-14, "{turn:?}: {off:e}");
            assert!((0..3).all(|d| (point[d] - patch.point()[d]).abs() < 1e-13), "{point:?} {:?}", patch.point());
        }
    }

    #[test]
    fn the_forces_of_a_deformed_patch_have_the_resultant_and_the_moment() {
        let (patch, now) = moved([0.4, 0.2, -1.1], 0.2);
        let (force, x, moment) = ([1.0, -2.0, 0.5], [3.0, 0.1, -0.7], [0.3, 0.9, -1.7]);
        let rows: Vec<(u32, [f64; 3])> = patch.rows(force, x, moment).collect();
        let sum = rows.iter().fold([0.0; 3], |sum, row| plus(sum, row.1));
        let torque = rows.iter().fold([0.0; 3], |sum, row| plus(sum, cross(now[row.0 as usize], row.1)));
        let wanted = plus(cross(x, force), moment);
        assert!((0..3).all(|d| (sum[d] - force[d]).abs() < 1e-14 && (torque[d] - wanted[d]).abs() < 2e-14), "{torque:?} {wanted:?}");
    }

    #[test]
    fn the_forces_are_the_gradient_of_the_motion_of_the_point() {
        let (patch, now) = moved([0.4, 0.2, -1.1], 0.2);
        let (direction, h) = ([0.3, -0.5, 0.8], 1e-6);
        for (node, row) in patch.rows(direction, patch.point(), [0.0; 3]) {
            for d in 0..3 {
                let at = |by: f64| {
                    let (mut patch, mut now) = (patch.clone(), now.clone());
                    now[node as usize][d] += by;
                    patch.follow(&now);
                    dot(direction, patch.point())
                };
                let slope = (at(h) - at(-h)) / (2.0 * h);
                assert!((slope - row[d]).abs() < 1e-9, "{node} {d}: {slope} {row:?}");
            }
        }
    }

    #[test]
    fn nodes_on_a_line_hold_nothing_in_3d_and_two_do_in_2d() {
        let line: Vec<[f64; 3]> = (0..4).map(|k| [f64::from(k), 2.0 * f64::from(k), 1.0]).collect();
        assert!(Patch::new((0..4).collect(), &line, [0.0; 3]).is_none());
        assert!(Patch::new(vec![0, 1], &[[0.0, 0.0], [1.0, 0.0]], [0.0; 3]).is_some());
        assert!(Patch::new(vec![0], &[[0.0, 0.0]], [0.0; 3]).is_none());
    }
}
