//! A material point: a law driven by strains, or by one strain under uniaxial stress, with its work and its
//! dissipation.

use crate::patches::DENSITY;
use embate_solver::material::{Kinematics, Law, Parameters};
use embate_solver::tensor::{Solid, SymmetricTensor};

const ONE: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

#[derive(Clone, Copy)]
pub(crate) struct Point<M: Law> {
    pub(crate) law: M,
    pub(crate) state: M::State<f64, Solid<f64>>,
    pub(crate) stress: [f64; 6],
    pub(crate) time_step: f64,
    /// Strain so far, xx yy zz xy yz zx.
    pub(crate) strain: [f64; 6],
    /// Σ ½ (σ_old + σ_new):Δε, as the block counts it.
    pub(crate) work: f64,
    pub(crate) dissipated: f64,
}

impl<M: Law> Point<M> {
    pub(crate) fn new(numbers: &[(&str, f64)], lists: &[(&str, &[f64])]) -> Self {
        let numbers = numbers.iter().chain(&[("density", DENSITY)]).map(|&(name, value)| (name.to_string(), value)).collect();
        let lists = lists.iter().map(|&(name, list)| (name.to_string(), list.to_vec())).collect();
        let parameters = Parameters::new(M::KIND.parameters, &numbers, &lists);
        assert!(M::faults(&parameters).is_empty(), "{:?}", M::faults(&parameters));
        let law = M::new(&parameters);
        Self { law, state: law.start::<f64, Solid<f64>>(), stress: [0.0; 6], strain: [0.0; 6], time_step: 1e-3, work: 0.0, dissipated: 0.0 }
    }

    /// ½ σ:C⁻¹:σ.
    pub(crate) fn elastic_energy(&self) -> f64 {
        let ([bulk, shear], stress) = (self.law.stiffness(), Solid(self.stress));
        let (mean, deviator) = (stress.trace() / 3.0, stress.deviator());
        mean * mean / (2.0 * bulk) + deviator.contract(deviator) / (4.0 * shear)
    }

    /// √(3/2 s:s).
    pub(crate) fn mises(&self) -> f64 {
        let deviator = Solid(self.stress).deviator();
        (1.5 * deviator.contract(deviator)).sqrt()
    }

    /// ⅓ tr σ.
    pub(crate) fn mean(&self) -> f64 {
        Solid(self.stress).trace() / 3.0
    }

    /// One step by Δε: xx yy zz xy yz zx.
    pub(crate) fn strain(&mut self, increment: [f64; 6]) {
        self.turn_and_strain(&ONE, increment);
    }

    /// One step in which the body turns by Q and is strained by Δε as seen at the end.
    pub(crate) fn turn_and_strain(&mut self, q: &[[f64; 3]; 3], increment: [f64; 6]) {
        let (strain, old) = (Solid(increment), Solid(self.stress).rotated(q));
        let kinematics = Kinematics {
            time_step: self.time_step,
            strain_increment: strain,
            rotation: *q,
            stress_rotated: old,
            left_cauchy_green: Solid::isotropic(1.0),
            volume_ratio: 1.0,
            viscous_heat: 0.0,
        };
        let response = self.law.update(&kinematics, &mut self.state);
        assert!(response.dissipated >= 0.0);
        self.work += 0.5 * (old.plus(response.stress)).contract(strain);
        self.dissipated += response.dissipated;
        self.stress = response.stress.0;
        self.strain = Solid(self.strain).plus(strain).0;
    }

    /// One step by Δε_xx with no stress across: the strain across is bisected.
    pub(crate) fn pull(&mut self, increment: f64) {
        let size = 3.0 * increment.abs() + self.stress[0].abs() * 1e-3 + 1e-6;
        let (mut low, mut high) = (-size, size);
        for _ in 0..100 {
            let across = 0.5 * (low + high);
            let mut trial = *self;
            trial.strain([increment, across, across, 0.0, 0.0, 0.0]);
            if trial.stress[1] > 0.0 { high = across } else { low = across }
        }
        let across = 0.5 * (low + high);
        self.strain([increment, across, across, 0.0, 0.0, 0.0]);
        assert!(self.stress[1].abs() < 1e-9 * (1.0 + self.stress[0].abs()), "{:?}", self.stress);
    }

    /// Steps of this size until the stress is reached, the last one as long as it takes.
    pub(crate) fn pull_to(&mut self, stress: f64, step: f64) {
        let way = step.signum();
        loop {
            let mut trial = *self;
            trial.pull(step);
            if way * (trial.stress[0] - stress) >= 0.0 {
                break;
            }
            *self = trial;
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let part = 0.5 * (low + high);
            let mut trial = *self;
            trial.pull(part * step);
            if way * (trial.stress[0] - stress) < 0.0 { low = part } else { high = part }
        }
        self.pull(low * step);
    }

    /// Steps of equal size.
    pub(crate) fn pull_by(&mut self, strain: f64, steps: u32) {
        for _ in 0..steps {
            self.pull(strain / f64::from(steps));
        }
    }
}
