//! Slave nodes of a pass: what each stands for, and how stiff its spring is where it meets a target, in 2D
//! and 3D.

use super::law::penalty::factor;

/// A slave node.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Slave {
    /// Stiffness as its own side gives it, N/m (in 2D per metre of depth): of the automatic penalty κ times
    /// the area, half of it in a double pass.
    pub stiffness: f64,
    /// Area of surface that it stands for, m² (in 2D m, of an axisymmetric body m²): its own, half of that
    /// where both surfaces are slaves.
    pub area: f64,
    /// Stiffness α m / dt² by its mass and the first step, N/m (in 2D per metre of depth); zero: not known.
    pub of_mass: f64,
}

/// What a segment at a node has of the node's tributary length and of its stiffness, as fractions.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Face {
    /// Fraction of the length, of an axisymmetric body of the area.
    pub length: f64,
    /// Fraction of the stiffness.
    pub stiffness: f64,
}

impl Face {
    /// All of a node.
    pub const WHOLE: Self = Self { length: 1.0, stiffness: 1.0 };
}

/// What a pass knows of its nodes, and of the segments or facets that they meet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PassInput {
    /// Slave nodes in the order of their surface.
    pub slaves: Vec<Slave>,
    /// Stiffness of each slave by unit of pressure stiffness κ (Pa/m) of the target; empty where the
    /// stiffness is given.
    pub per_modulus: Vec<f64>,
    /// κ behind each facet of the target, Pa/m: the softest of its part.
    pub moduli: Vec<f64>,
    /// α m / (dt² A) of the lightest node of each facet of the target by the first step, Pa/m; empty: not
    /// known.
    pub of_mass: Vec<f64>,
    /// In 2D what the segments at each slave stand for, [that which ends there, that which begins there];
    /// empty: slaves count whole.
    pub faces: Vec<[Face; 2]>,
    /// By what factor springs stiffen if the slaves or the target are those of an obstacle.
    pub at_obstacle: Option<f64>,
    /// Local thickness of the bodies at each slave and behind each facet of the target at the start, m;
    /// empty: not known.
    pub thickness: [Vec<f64>; 2],
}

impl PassInput {
    /// Stiffness of a part of a slave at a facet: the softer of both sides decides.
    fn stiffness(&self, slave: usize, facet: u32, part: Face) -> f64 {
        let own = part.stiffness * self.slaves[slave].stiffness;
        self.per_modulus.get(slave).map_or(own, |per| own.min(part.length * per * self.moduli[facet as usize]))
    }

    /// The same of all of a slave.
    pub(super) fn stiffness_at(&self, slave: usize, facet: u32) -> f64 {
        self.stiffness(slave, facet, Face::WHOLE)
    }

    /// The same where some facets meet.
    pub(super) fn softest(&self, slave: usize, part: Face, facets: impl IntoIterator<Item = u32>) -> f64 {
        facets.into_iter().map(|facet| self.stiffness(slave, facet, part)).fold(f64::INFINITY, f64::min)
    }

    /// Stiffness by mass and step, of the lighter side.
    pub(super) fn of_mass(&self, slave: usize, facets: impl IntoIterator<Item = u32>) -> f64 {
        let Slave { of_mass, area, .. } = self.slaves[slave];
        let other = |facet: u32| self.of_mass.get(facet as usize).map_or(0.0, |other| other * area);
        facets.into_iter().map(other).fold(of_mass, f64::min)
    }

    /// By what factor a spring stiffens, between bodies by its stiffness and that by mass and step.
    pub(super) fn factor(&self, stiffness: f64, of_mass: f64) -> f64 {
        self.at_obstacle.unwrap_or_else(|| factor(stiffness, of_mass))
    }

    /// Thickness of the thinner body there, m; infinite: not known.
    pub(super) fn thickness(&self, slave: usize, facets: impl IntoIterator<Item = u32>) -> f64 {
        let at = |of: usize, at: usize| self.thickness[of].get(at).copied().unwrap_or(f64::INFINITY);
        facets.into_iter().map(|facet| at(1, facet as usize)).fold(at(0, slave), f64::min)
    }

    /// What counts of a slave, of which these segments stand for it: 1 that which ends there, 2 that which
    /// begins there.
    pub(super) fn part(&self, slave: usize, faces: u8) -> Face {
        match self.faces.get(slave) {
            Some(&[before, _]) if faces == 1 => before,
            Some(&[_, after]) if faces == 2 => after,
            _ => Face::WHOLE,
        }
    }
}
