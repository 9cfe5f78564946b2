//! Masses of parts: in total, and on their nodes.

use crate::archive::{Archive, ArchiveResult, Persist};

/// What parts weigh.
pub(crate) struct PartMasses {
    /// Mass of the elements of each part, kg/m (kg).
    pub(crate) whole: Vec<f64>,
    /// Mass of each part on nodes that weigh more than it gives them, kg/m (kg): other parts have them too,
    /// or there are point masses. Nodes ascend.
    shared: Vec<Vec<(u32, f64)>>,
}

impl Persist for PartMasses {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { whole, shared } = self;
        whole[..].persist(archive)?;
        shared.iter_mut().flatten().try_for_each(|(_, mass)| mass.persist(archive))
    }
}

impl PartMasses {
    /// From the mass of each part, kg/m (kg), and its masses on nodes that weigh more, nodes ascending.
    pub(crate) fn new(whole: Vec<f64>, shared: Vec<Vec<(u32, f64)>>) -> Self {
        Self { whole, shared }
    }

    /// Adds to the mass of the elements of a part on one of its nodes, kg/m (kg).
    pub(crate) fn add(&mut self, part: usize, node: u32, mass: f64) {
        self.whole[part] += mass;
        if let Ok(at) = self.shared[part].binary_search_by_key(&node, |&(node, _)| node) {
            self.shared[part][at].1 += mass;
        }
    }

    /// Mass of the elements of a part on one of its nodes, which weighs `mass` in all, kg/m (kg).
    pub(crate) fn of(&self, part: usize, node: u32, mass: f64) -> f64 {
        let shared = &self.shared[part];
        if shared.is_empty() {
            return mass;
        }
        shared.binary_search_by_key(&node, |&(node, _)| node).map_or(mass, |at| shared[at].1)
    }
}
