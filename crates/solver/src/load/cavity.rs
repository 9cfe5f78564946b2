//! Gas at a uniform pressure in closed surfaces: airbags, tyres, cans, bellows.
//!
//! The volume V and its gradient ∂V/∂x come from the facets as they are (`cavity/surface.rs`), the pressure
//! from the state of the gas (`cavity/gas.rs`), at x^n; the force on the nodes is (p − p_a) ∂V/∂x, and so its
//! work over a motion is what the gas loses, to the order of the time step. It is one of the loads, external
//! work in the ledger.
//!
//! What the gas adds to the stiffness, −∂f/∂x = γ p/V ∂V/∂x ⊗ ∂V/∂x − (p − p_a) ∂²V/∂x², counts in the stable
//! step: by Cauchy and Schwarz, and as the second term is a sum over facets, each with a norm s_f |p − p_a|,
//!
//! ```text
//! ω² ≤ γ p/V Σ_i |∂V/∂x_i|²/m_i + |p − p_a| max_i Σ_{f∋i} s_f/m_i
//! ```
//!
//! is added to the bound of the elements, whose stiffness is added to this one.

mod gas;
mod surface;

use super::curve::Curves;
use crate::archive::{Archive, ArchiveResult, Persist};
use crate::error::Fault;
use crate::load::messages::{OPEN_CAVITY, WRONG_SIDE};
use crate::mesh::surface::tributary::{Depth, Tributary};
use crate::mesh::surface::{Facet, Sided};
use crate::mesh::{Mesh, Meshed};
use crate::model::messages::TWICE;
use crate::model::{self, Model};
use crate::tensor::Dim;
use crate::vector::{first, place, times, unit};
use gas::Gas;
use surface::{Closed, Open, Plane};

/// The gas of a closed surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Cavity<const D: usize>
where
    Dim<D>: Meshed<D>,
{
    /// Its name.
    pub name: String,
    surface: Closed<D>,
    gas: Gas,
    /// When its surface opened, s; `None`: it is closed.
    opened: Option<f64>,
}

impl<const D: usize> Persist for Cavity<D>
where
    Dim<D>: Meshed<D>,
{
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { name: _, surface: _, gas, opened } = self;
        gas.persist(archive)?;
        opened.persist(archive)
    }
}

/// Names of the values of a cavity in the history.
pub(crate) const VALUES: [&str; 6] = ["pressure", "volume", "mass", "temperature", "energy", "work"];

impl<const D: usize> Cavity<D>
where
    Dim<D>: Tributary<D>,
{
    /// Its [`VALUES`]: absolute pressure, Pa, volume, m³ (in 2D m³/m), mass, kg, temperature, K, internal
    /// energy, J, and the work that it has done on the surface, J.
    pub(crate) fn values(&self) -> [f64; VALUES.len()] {
        let gas = &self.gas;
        [gas.pressure, gas.volume, gas.mass, gas.temperature(), gas.energy(), gas.work]
    }

    /// When its surface opened, s.
    pub(crate) fn opened(&self) -> Option<f64> {
        self.opened
    }

    /// Pressure less that outside, Pa; 0 where the surface is open.
    pub(crate) fn net(&self) -> f64 {
        if self.opened.is_some() { 0.0 } else { self.gas.net() }
    }

    /// γ p/V, Pa/m³; 0 where the surface is open.
    pub(crate) fn stiffness(&self) -> f64 {
        if self.opened.is_some() { 0.0 } else { self.gas.stiffness() }
    }

    /// The nodes of its surface, ascending, with ∂V/∂x and the sum of s_f.
    pub(crate) fn gradient(&self) -> impl Iterator<Item = (u32, [f64; D], f64)> + '_ {
        self.surface.gradient()
    }
}

/// The cavities of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cavities<const D: usize>
where
    Dim<D>: Meshed<D>,
{
    list: Vec<Cavity<D>>,
}

impl<const D: usize> Persist for Cavities<D>
where
    Dim<D>: Meshed<D>,
{
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        self.list[..].persist(archive)
    }
}

impl<const D: usize> Cavities<D>
where
    Dim<D>: Tributary<D>,
{
    /// `is_mirror` says which segments lie on a symmetry line: they are no surface.
    ///
    /// # Errors
    /// Names of nothing, or of what is no surface; surfaces that are not closed, or seen from outside.
    pub fn new(model: &Model, mesh: &Mesh<D>, curves: &Curves, is_mirror: impl Fn(Facet<D>) -> bool) -> Result<Self, Vec<Fault>> {
        let (mut list, mut faults) = (Vec::new(), Vec::new());
        if model.cavities.is_empty() {
            return Ok(Self::default());
        }
        let plane = |symmetry: &model::Symmetry| {
            Some(Plane { point: first(symmetry.point), normal: unit(first(symmetry.normal))?, nodes: mesh.on_symmetry(symmetry) })
        };
        let planes: Vec<Plane<D>> = model.symmetries.iter().filter_map(plane).collect();
        for (i, cavity) in model.cavities.iter().enumerate() {
            let mut facets: Vec<Facet<D>> = Vec::new();
            let before = faults.len();
            for (k, on) in cavity.on.iter().enumerate() {
                match mesh.surface(on, &is_mirror) {
                    Ok(surface) => facets.extend(surface.facets()),
                    Err(fault) => faults.push(Fault { path: format!("cavity[{i}].on[{k}]"), ..fault }),
                }
            }
            let mut sorted = facets.clone();
            sorted.sort_unstable();
            if faults.len() == before && sorted.windows(2).any(|pair| pair[0] == pair[1]) {
                let message = format!("surfaces of cavity \"{}\" overlap: a piece of them is named twice", cavity.name);
                faults.push(Fault::new(&TWICE, format!("cavity[{i}].on"), message, "name each side or group once"));
            }
            if faults.len() > before {
                continue;
            }
            match Closed::new(facets, &mesh.positions, &planes, Depth::of(model)) {
                Ok((surface, volume)) => {
                    let gas = Gas::new(cavity, volume, curves);
                    list.push(Cavity { name: cavity.name.clone(), surface, gas, opened: None });
                }
                Err(open) => faults.push(fault(&cavity.name, i, open)),
            }
        }
        if faults.is_empty() { Ok(Self { list }) } else { Err(faults) }
    }

    /// Whether the model has none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// All of them.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &Cavity<D>> {
        self.list.iter()
    }

    /// Follows the surfaces to these positions, from one time to another, s.
    ///
    /// # Errors
    /// The number of one whose volume is gone.
    pub(crate) fn advance(&mut self, curves: &Curves, times: [f64; 2], positions: &[[f64; D]]) -> Result<(), usize> {
        for (number, cavity) in self.list.iter_mut().enumerate().filter(|(_, cavity)| cavity.opened.is_none()) {
            let volume = cavity.surface.measure(positions);
            // What is not a number is found where nodes are looked at.
            if volume <= 0.0 {
                cavity.gas.volume = volume;
                return Err(number);
            }
            cavity.gas.advance(curves, times, volume);
        }
        Ok(())
    }

    /// What they push with, node by node, N (in 2D N/m).
    pub(crate) fn forces(&self) -> impl Iterator<Item = (u32, [f64; D])> + '_ {
        self.list.iter().filter(|cavity| cavity.net() != 0.0).flat_map(|cavity| {
            let net = cavity.net();
            cavity.gradient().map(move |(node, gradient, _)| (node, times(net, gradient)))
        })
    }

    /// Opens those of which pieces are outside no more, at a time, s: their gas is gone.
    pub(crate) fn renew(&mut self, time: f64, is_outside: impl Fn(Facet<D>) -> bool) {
        for cavity in self.list.iter_mut().filter(|cavity| cavity.opened.is_none()) {
            if !cavity.surface.is_whole(&is_outside) {
                cavity.opened = Some(time);
            }
        }
    }
}

/// Why the surface of a cavity is none, and what to do.
fn fault<const D: usize>(name: &str, index: usize, open: Open<D>) -> Fault {
    let path = format!("cavity[{index}].on");
    let what = format!("the surface of cavity \"{name}\"");
    match open {
        Open::Rim(count, at) => Fault::new(
            &OPEN_CAVITY,
            path,
            format!("{what} is not closed: {count} piece(s) of its rim have nothing beside them, the first at {} m", place(at)),
            "name the sides that close it, meshed so that their nodes are at the same places, or let the rim lie on a plane of [[symmetry]]",
        ),
        Open::Towards(direction) => Fault::new(
            &OPEN_CAVITY,
            path,
            format!("{what} is not closed: it is open along {}", place(direction)),
            "name the sides that close it there, or add [[symmetry]] with the plane that does",
        ),
        Open::Planes => Fault::new(
            &OPEN_CAVITY,
            path,
            format!("{what} has rims on planes of symmetry that close no volume together"),
            "planes must meet in a point, or leave a direction along which all of them run; name the sides that close it instead",
        ),
        Open::Outside(volume) => Fault::new(
            &WRONG_SIDE,
            path,
            format!("{what} encloses {volume:e} m³, seen from the gas"),
            "name the sides of the bodies that look into the gas, and no others: of a shell the other side",
        ),
    }
}
