//! What the points of a block hold at the start: stress and temperature.
//!
//! Values come from the part of the model; a stress is asked of the law before it is kept: strained by
//! nothing, the law must leave it as it is (a stress beyond the yield surface would be gone before the first
//! step). The elastic energy ½ σ:C⁻¹:σ of what is kept is in the ledger from the start.

use super::kernel::{ElementGeometry, Facts};
use super::store::ElementStore;
use super::strain::Tensor;
use crate::material::Family;
use crate::material::points::{PointLaw, Points, RESPONSE, Scratch};
use crate::material::variable::TEMPERATURE;
use crate::model::InitialStress;
use crate::tensor::{Dim, Space, SymmetricTensor, Turn};
use embate_lanes::{BATCH, Batch, Level};

/// How much a stress may change when the law sees it, over its largest component: round-off.
const HELD: f64 = 1e-9;

/// What points hold at the start.
#[derive(Clone, Copy, Debug, Default)]
pub struct Initial<'a> {
    /// Stress; `None`: none.
    pub stress: Option<&'a InitialStress>,
    /// Temperature, K; `None`: that of the material.
    pub temperature: Option<f64>,
}

/// What keeps a law from holding it.
#[derive(Clone, Debug, PartialEq)]
pub struct Wrong {
    /// The key of the part: `stress_initial` or `temperature_initial`.
    pub key: &'static str,
    /// The reason.
    pub message: String,
    /// What to do.
    pub help: &'static str,
}

impl Wrong {
    fn stress(message: String, help: &'static str) -> Self {
        Self { key: "stress_initial", message, help }
    }
}

/// Writes a temperature into the history of points.
pub(super) fn warm(law: &dyn PointLaw, history: &mut [Batch], temperature: f64) -> Result<(), Wrong> {
    let Some(index) = law.place(&TEMPERATURE) else {
        let message = "its law knows no temperature".to_string();
        return Err(Wrong { key: "temperature_initial", message, help: "leave it out, or take a law with a temperature: `johnson_cook`" });
    };
    history.chunks_exact_mut(law.state_width()).for_each(|point| point[index] = Batch::splat(temperature));
    Ok(())
}

/// Whether the law works on stresses at all.
pub(super) fn keeps_stress(law: &dyn PointLaw) -> Result<(), Wrong> {
    if law.family() == Family::Rate {
        return Ok(());
    }
    Err(Wrong::stress(
        "its law has its stress from the deformation, so it has none while there is no deformation".into(),
        "leave it out and deform the part in the first part of the run, or take a law in rate form such as `elastic` or `viscoelastic`",
    ))
}

/// Asks the law if it leaves a point's `stress` as it is: the lane and the stresses before and after, xx yy
/// zz xy (yz zx), where it does not. `rotation`: no rotation, as it is stored.
pub(super) fn released(law: &dyn PointLaw, stress: &[Batch], history: &[Batch], rotation: &[Batch]) -> Option<(usize, [[f64; 6]; 2])> {
    let mut after = stress.to_vec();
    law.respond(
        Level::SCALAR,
        Points {
            time_step: 0.0,
            strain: &vec![Batch::default(); stress.len()],
            rotation,
            volume_ratio: &[Batch::splat(1.0)],
            viscous_heat: &[Batch::default()],
            stress: &mut after,
            state: &mut history.to_vec(),
            response: &mut [Batch::default(); RESPONSE],
            scratch: &mut Scratch::default(),
        },
    );
    let of = |all: &[Batch], lane: usize| -> [f64; 6] { std::array::from_fn(|c| all.get(c).map_or(0.0, |batch| batch.0[lane])) };
    (0..BATCH).map(|lane| (lane, [of(stress, lane), of(&after, lane)])).find(|(_, [before, after])| {
        let size = before.iter().fold(0.0f64, |size, s| size.max(s.abs()));
        // NaN too.
        !before.iter().zip(after).all(|(s, t)| (s - t).abs() <= HELD * size)
    })
}

/// In words what [`released`] found at a place, m.
pub(super) fn cannot_hold([x, y]: [f64; 2], [before, after]: [[f64; 6]; 2]) -> Wrong {
    let words = |[xx, yy, zz, xy, ..]: [f64; 6]| format!("xx {xx:.4e}, yy {yy:.4e}, zz {zz:.4e}, xy {xy:.4e} Pa");
    Wrong::stress(
        format!("its law can't hold the stress at ({x:.4e}, {y:.4e}) m: of {} it leaves {} at once", words(before), words(after)),
        "keep it within the yield surface; with an equation of state its mean must be minus the pressure of the \
            equation at the start, in plane stress it has no zz",
    )
}

/// x and y of a place.
fn in_plane<const D: usize>(place: [f64; D]) -> [f64; 2] {
    [place[0], place[1]]
}

impl<const D: usize> ElementStore<D>
where
    Dim<D>: Space<D>,
{
    pub(super) fn take_over(&mut self, initial: &Initial<'_>, positions: &[[f64; D]]) -> Result<(), Wrong> {
        let width = self.law.state_width();
        if let Some(temperature) = initial.temperature {
            warm(self.law.as_ref(), &mut self.history, temperature)?;
        }
        let Some(stress) = initial.stress else { return Ok(()) };
        keeps_stress(self.law.as_ref())?;
        let Facts { points, components, turn, .. } = *self.facts();
        let (mut corners, mut geometries) = (Vec::new(), vec![ElementGeometry::default(); BATCH]);
        let mut rotation = vec![Batch::default(); turn];
        (0..BATCH).for_each(|lane| <<Tensor<D, f64> as SymmetricTensor<f64>>::Rotation as Turn<f64>>::none().store(&mut rotation, lane));
        for batch in 0..self.elements.len() {
            for (lane, geometry) in geometries.iter_mut().enumerate() {
                self.corners(batch, lane, positions, &mut corners);
                self.kernel.geometry(&corners, geometry);
            }
            for p in 0..points {
                let own = &mut self.stress[(batch * points + p) * components..][..components];
                for (lane, geometry) in geometries.iter().enumerate() {
                    let [xx, yy, zz, xy] = stress.at(in_plane(geometry.places[p]));
                    let all = [xx, yy, zz, xy, 0.0, 0.0];
                    Tensor::<D, f64>::from_components(all).store(own, lane);
                    self.elements[batch].stored.0[lane] += self.law.energy(all) * geometry.volumes[p];
                }
                let history = &self.history[(batch * points + p) * width..][..width];
                if let Some((lane, stresses)) = released(self.law.as_ref(), own, history, &rotation) {
                    return Err(cannot_hold(in_plane(geometries[lane].places[p]), stresses));
                }
            }
        }
        Ok(())
    }
}
