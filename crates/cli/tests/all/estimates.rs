//! What examples are held against where the theory is more than a line: crushed columns of foam, and the slab
//! theory of rolling. Values of the models stand here once more, so that a changed model does not change what
//! is expected of it; used by `examples.rs`.

/// Energy per area of a column of the pad of `examples/foam-pad` that is pressed by `depth`: H ∫ σ e^(−ε) dε
/// in logarithmic strains, J/m².
pub(crate) fn column_energy(depth: f64) -> f64 {
    const CURVE: [(f64, f64); 6] = [(0.0, 0.2e6), (0.2, 0.22e6), (0.6, 0.3e6), (1.0, 0.5e6), (1.4, 1.2e6), (1.8, 4e6)];
    let (young, height, steps) = (8e6, 40e-3, 4000);
    let end = -(1.0 - depth / height).ln();
    // Total strain at the points of the curve, the elastic part included.
    let mut points = vec![(0.0, 0.0)];
    points.extend(CURVE.map(|(plastic, stress)| (plastic + stress / young, stress)));
    let stress = |strain: f64| {
        let k = points.partition_point(|point| point.0 <= strain).clamp(1, points.len() - 1);
        let (a, b) = (points[k - 1], points[k]);
        a.1 + (strain - a.0) / (b.0 - a.0) * (b.1 - a.1)
    };
    let step = end / f64::from(steps);
    (0..steps).map(|k| (f64::from(k) + 0.5) * step).map(|strain| height * stress(strain) * (-strain).exp() * step).sum()
}

/// Depth at which what falls has spent its energy in what `energy` takes, m.
pub(crate) fn depth_of_rest(mass: f64, velocity: f64, energy: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 39e-3);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        let is_moving = energy(middle) < 0.5 * mass * velocity * velocity + mass * 9.81 * middle;
        (low, high) = if is_moving { (middle, high) } else { (low, middle) };
    }
    low
}

/// A strip rolled from `from` to `to`, m, without tension between rolls of radius `radius`, m, that don't
/// flatten, with the friction `mu`.
pub(crate) struct Pass {
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) radius: f64,
    pub(crate) mu: f64,
}

impl Pass {
    fn thickness(&self, angle: f64) -> f64 {
        self.to + 2.0 * self.radius * (1.0 - angle.cos())
    }

    /// Flow stress in plane strain of the metal of `examples/strip-rolling`, 2/√3 σ_y(2/√3 ln h₀/h), Pa.
    pub(crate) fn strength(&self, angle: f64) -> f64 {
        let factor = 2.0 / 3.0_f64.sqrt();
        factor * (100e6 + 150e6 * factor * (self.from / self.thickness(angle)).ln())
    }

    /// Roll pressure p at each of these angles by von Kármán's equation d(h q)/dφ = 2 R p (sin φ ± µ cos φ),
    /// p = q + S, q = 0 at the first.
    fn pressure(&self, angles: impl Iterator<Item = f64>, mu: f64) -> Vec<f64> {
        let pressure = |angle: f64, thrust: f64| thrust / self.thickness(angle) + self.strength(angle);
        let slope = |angle: f64, thrust: f64| 2.0 * self.radius * pressure(angle, thrust) * (angle.sin() + mu * angle.cos());
        let (mut last, mut thrust) = (None, 0.0);
        let mut next = |angle: f64| {
            if let Some(last) = last {
                let half = 0.5 * (angle - last);
                thrust += 2.0 * half * slope(last + half, thrust + half * slope(last, thrust));
            }
            last = Some(angle);
            pressure(angle, thrust)
        };
        angles.map(&mut next).collect()
    }

    /// Force and torque on each roll, N/m and N, and the forward slip.
    pub(crate) fn slab(&self) -> [f64; 3] {
        let (count, arc) = (4000, (1.0 - 0.5 * (self.from - self.to) / self.radius).acos());
        let at = |k: usize| arc * (k as f64 + 0.5) / count as f64;
        let exit = self.pressure((0..count).map(at), self.mu);
        let mut entry = self.pressure((0..count).rev().map(at), -self.mu);
        entry.reverse();
        let neutral = (0..count).find(|k| exit[*k] > entry[*k]).unwrap();
        let [mut force, mut torque] = [0.0; 2];
        for k in 0..count {
            let (load, friction) = (exit[k].min(entry[k]) * self.radius * arc / count as f64, if k < neutral { self.mu } else { -self.mu });
            force += load * (at(k).cos() - friction * at(k).sin());
            torque -= load * friction * self.radius;
        }
        [force, torque, self.thickness(at(neutral)) * at(neutral).cos() / self.to - 1.0]
    }
}
