//! Columns of the history for rigid bodies, by dimension ([`BodyColumns`], on [`Dim`]).

use crate::rigid::{Body, RigidMotion};
use crate::tensor::Dim;

/// Columns of rigid bodies.
pub trait BodyColumns<const D: usize>: RigidMotion<D> {
    /// Columns of the moment on an obstacle.
    const MOMENT: &[&str];
    /// Their values.
    fn moments(moment: &Self::Spin) -> Vec<f64>;
    /// Columns of a rigid body that moves: its reference point, in 2D its angle, and their velocities.
    const MOTION: &[&str];
    /// Their values at the whole step; `before` is the part of the last update that lies before it.
    fn motion(body: &Body<D>, before: f64) -> Vec<f64>
    where
        Dim<D>: BodyColumns<D>;
}

impl BodyColumns<2> for Dim<2> {
    const MOMENT: &[&str] = &["moment"];
    fn moments(moment: &f64) -> Vec<f64> {
        vec![*moment]
    }
    const MOTION: &[&str] = &["x", "y", "angle", "vx", "vy", "spin"];
    fn motion(body: &Body<2>, before: f64) -> Vec<f64> {
        let velocity = (0..3).map(|k| body.velocity_old[k] + before * (body.velocity[k] - body.velocity_old[k]));
        [body.centre[0], body.centre[1], body.angle].into_iter().chain(velocity).collect()
    }
}

impl BodyColumns<3> for Dim<3> {
    const MOMENT: &[&str] = &["moment_x", "moment_y", "moment_z"];
    fn moments(moment: &[f64; 3]) -> Vec<f64> {
        moment.to_vec()
    }
    const MOTION: &[&str] = &["x", "y", "z", "vx", "vy", "vz", "spin_x", "spin_y", "spin_z"];
    fn motion(body: &Body<3>, before: f64) -> Vec<f64> {
        let velocity = (0..6).map(|k| body.velocity_old[k] + before * (body.velocity[k] - body.velocity_old[k]));
        body.centre.into_iter().chain(velocity).collect()
    }
}
