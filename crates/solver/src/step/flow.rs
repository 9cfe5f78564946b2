//! A part that stays in place while its material flows through it: what is known of it on the way of a run.

use crate::archive::persist_all;

/// What came in and went out while nodes were away from their places.
#[derive(Clone, Debug)]
pub(crate) struct Exchange<const D: usize> {
    /// Mass that came in and that went out, kg/m (axisymmetric: kg).
    pub(crate) mass: [f64; 2],
    /// Their kinetic and elastic energies, J/m (J).
    pub(crate) kinetic: [f64; 2],
    /// See `kinetic`.
    pub(crate) elastic: [f64; 2],
    /// Momentum, and angular momentum about the centre of mass, that came in less what went out.
    pub(crate) momentum: [[f64; 3]; 2],
    /// Way of the material over the length of the part.
    pub(crate) way: f64,
    /// Places to which nodes go back, in the order of the nodes as they are now, m.
    pub(crate) places: Vec<[f64; D]>,
    /// What the state of each node is compared by: its place across the flow, m, and what the law remembers.
    pub(crate) fields: Vec<f64>,
}

/// A part with a flow through it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Flow {
    /// The part.
    pub part: String,
    /// How often its nodes went back to their places.
    pub events: u64,
    /// Way of the material over the length of the part.
    pub passages: f64,
    /// Mass that came in and that went out, kg/m (axisymmetric: kg).
    pub mass: [f64; 2],
    /// Energy, kinetic and elastic, that came in and that went out, J/m (J).
    pub energy: [f64; 2],
    /// Kinetic energy that was lost, J/m (J).
    pub kinetic_lost: f64,
    /// Elastic energy that was lost, J/m (J).
    pub elastic_lost: f64,
    /// Most that momentum (also about the centre of mass) changed by at once beyond what came in and went
    /// out, over Σ m|v| and Σ m|x − c||v|.
    pub momentum_change: [f64; 2],
    /// Largest correction of a node's mass, as a fraction of it.
    pub mass_correction: f64,
    /// Change of the state over the last quarter of a passage: the largest of those of its surfaces, as a
    /// fraction of its height, and of what the law remembers, as a fraction of its mean; `None`: not known
    /// yet.
    pub change: Option<f64>,
    /// When that first was less than the model asks for, s.
    pub steady: Option<f64>,
    pub(crate) places: Vec<f64>,
    /// What comes in.
    pub(crate) inflow: Vec<f64>,
    /// State at the last comparison, and after how many passages that was.
    mark: Vec<f64>,
    marked: f64,
    /// How often nodes could not go back since they last did.
    pub(crate) failures: u64,
}

persist_all!(Flow {
    part,
    events,
    passages,
    mass,
    energy,
    kinetic_lost,
    elastic_lost,
    momentum_change,
    mass_correction,
    change,
    steady,
    places,
    inflow,
    mark,
    marked,
    failures
});

/// Passages between two comparisons of the state.
const APART: f64 = 0.25;

impl Flow {
    pub(crate) fn new(part: &str) -> Self {
        Self { part: part.into(), ..Self::default() }
    }

    /// Notes that nodes have gone back, at a time (s); the flow is steady where the state changes by less
    /// than `steady`.
    pub(crate) fn note<const D: usize>(&mut self, exchange: Exchange<D>, steady: f64, time: f64) {
        self.events += 1;
        self.failures = 0;
        self.passages += exchange.way;
        for k in 0..2 {
            self.mass[k] += exchange.mass[k];
            self.energy[k] += exchange.kinetic[k] + exchange.elastic[k];
        }
        let nodes = exchange.places.len();
        self.places = exchange.places.into_flattened();
        if self.mark.is_empty() {
            self.mark = exchange.fields;
            self.marked = self.passages;
        } else if self.passages >= self.marked + APART {
            let change = change(&self.mark, &exchange.fields, nodes);
            self.change = Some(change);
            self.mark = exchange.fields;
            self.marked = self.passages;
            if change < steady {
                self.steady.get_or_insert(time);
            }
        }
    }
}

/// By how much a state has changed: of each field Σ|new − old|, of the first one over its range and the
/// number of nodes, of the others over Σ|new|; the largest.
fn change(old: &[f64], new: &[f64], nodes: usize) -> f64 {
    let width = new.len() / nodes.max(1);
    let mut largest: f64 = 0.0;
    for k in 0..width {
        let values = || new.iter().skip(k).step_by(width);
        let moved: f64 = values().zip(old.iter().skip(k).step_by(width)).map(|(new, old)| (new - old).abs()).sum();
        let scale = if k == 0 {
            let [low, high] = values().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &own| [low.min(own), high.max(own)]);
            nodes as f64 * (high - low)
        } else {
            values().map(|own| own.abs()).sum()
        };
        if scale > 0.0 {
            largest = largest.max(moved / scale);
        }
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_state_changes_by_the_largest_of_its_fields() {
        // Heights of three nodes from 0 to 2, and a memory of 1.
        let old = [0.0, 1.0, 1.0, 1.0, 2.0, 1.0];
        assert_eq!(change(&old, &old, 3), 0.0);
        assert_eq!(change(&old, &[0.0, 1.0, 1.0, 1.0, 2.0, 2.0], 3), 0.25);
        assert_eq!(change(&old, &[0.0, 1.0, 1.5, 1.0, 2.0, 1.0], 3), 0.5 / 6.0);
        // Nothing that is remembered is no change.
        assert_eq!(change(&[0.0, 0.0, 1.0, 0.0], &[0.0, 0.0, 1.0, 0.0], 2), 0.0);
    }

    #[test]
    fn a_flow_is_steady_after_a_quarter_of_a_passage_without_change() {
        let mut flow = Flow::new("strip");
        let exchange = |height: f64| Exchange::<2> {
            mass: [1.0, 0.9],
            kinetic: [0.0; 2],
            elastic: [0.0; 2],
            momentum: [[0.0; 3]; 2],
            way: 0.1,
            places: vec![[0.0; 2]; 2],
            fields: vec![0.0, height],
        };
        (0..3).for_each(|_| flow.note(exchange(1.0), 0.01, 1.0));
        assert!(flow.change.is_none() && flow.steady.is_none());
        flow.note(exchange(2.0), 0.01, 2.0);
        assert!((flow.change.unwrap() - 0.25).abs() < 1e-15 && flow.steady.is_none());
        (0..3).for_each(|_| flow.note(exchange(2.0), 0.01, 3.0));
        assert_eq!((flow.change, flow.steady), (Some(0.0), Some(3.0)));
        assert!((flow.passages - 0.7).abs() < 1e-15 && flow.events == 7 && (flow.mass[1] - 6.3).abs() < 1e-14);
    }
}
