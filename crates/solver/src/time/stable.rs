//! The stable step: element bound, and nodal bound with the stiffness of the contact springs.
//!
//! Element bound: dt_e = L_e / c_d from the blocks. Nodal bound (Gershgorin on M⁻¹K): dt ≤ 2 / √(max_i (k_i + d_i) / m_i), where k_i sums
//! (2 / dt_e)² m_corner over the corners at node i and d_i bounds the contact springs: a spring k g gᵀ between a slave node (g = 1) and its
//! target (g = −Φ) satisfies k g gᵀ ≤ k diag(|g_i| Σ|g_j|) = diag(2k, 2kΦ₁, 2kΦ₂). Theory, section 1.
//!
//! A spring that opens and closes can pump energy well below the linear bound: what it gives back at release differs from what it took
//! at closing by up to ½ k v² dt² / 4. So springs that are stiffer than the elements behind them are held to a smaller part of the bound.

use crate::mesh::surface::NONE;

/// Stiffness of the springs on each node that is in or near contact.
#[derive(Clone, Debug, Default)]
pub struct Springs {
    stiffness: Vec<f64>,
    touched: Vec<u32>,
}

/// A bound on the next step and who sets it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringBound {
    /// Step, s; infinite without springs.
    pub time_step: f64,
    /// Node that sets it.
    pub node: u32,
}

impl Springs {
    /// For `nodes` nodes.
    #[must_use]
    pub fn new(nodes: usize) -> Self {
        Self { stiffness: vec![0.0; nodes], touched: Vec::with_capacity(nodes.min(4096)) }
    }

    fn add(&mut self, node: u32, bound: f64) {
        let slot = &mut self.stiffness[node as usize];
        if *slot == 0.0 {
            self.touched.push(node);
        }
        *slot += bound;
    }

    /// A spring (N/m per metre of depth) between a slave node and the two nodes of its target segment.
    pub fn add_pair(&mut self, slave: u32, target: [u32; 2], weights: [f64; 2], stiffness: f64) {
        self.add(slave, 2.0 * stiffness);
        for (node, weight) in target.into_iter().zip(weights) {
            self.add(node, 2.0 * stiffness * weight);
        }
    }

    /// A spring between a node and something that does not move.
    pub fn add_wall(&mut self, node: u32, stiffness: f64) {
        self.add(node, stiffness);
    }

    /// Bound that all springs added so far set; forgets them. `safety` is that of the elements; `elements(node)` is k_i.
    pub fn take_bound(&mut self, safety: f64, mass: &[f64], elements: impl Fn(u32) -> f64) -> SpringBound {
        let mut bound = SpringBound { time_step: f64::INFINITY, node: NONE };
        for node in self.touched.drain(..) {
            let springs = std::mem::take(&mut self.stiffness[node as usize]);
            let behind = elements(node);
            let time_step = safety * share(springs / behind) * 2.0 / ((behind + springs) / mass[node as usize]).sqrt();
            if time_step < bound.time_step {
                bound = SpringBound { time_step, node };
            }
        }
        bound
    }
}

/// Part of the linear bound that keeps contact from pumping energy, by the ratio of spring to element stiffness (both as Gershgorin bounds).
///
/// Measured on a bar that hits a wall and on two bars (`tests/all/bars.rs`): the whole bound up to a ratio of 1, a third of it for stiff springs.
#[must_use]
pub fn share(ratio: f64) -> f64 {
    (1.0 / ratio).clamp(1.0 / 3.0, 1.0)
}
