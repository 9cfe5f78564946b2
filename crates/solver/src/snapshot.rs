//! Snapshots: the system at an output time as writers read it ([`Shown`]), piece by piece, so that a large
//! model is not in memory twice, or as a whole in a [`Frame`].

use crate::field::NodeFields;
use crate::field::kind::{FieldKind, Location};
use crate::field::snapshot::LiveSnapshot;
use crate::output::{Field, Frame, Shown};
use crate::tensor::Dim;
use std::borrow::Cow;
use std::ops::Range;

impl<const D: usize> Shown for LiveSnapshot<'_, D>
where
    Dim<D>: NodeFields<D>,
{
    fn time(&self) -> f64 {
        self.system.time
    }

    fn step(&self) -> u64 {
        self.system.step
    }

    fn dimension(&self) -> usize {
        D
    }

    fn nodes(&self) -> usize {
        self.system.mesh.user_nodes.len()
    }

    fn kinds(&self) -> Vec<&'static FieldKind> {
        self.fields.to_vec()
    }

    fn numbers(&self, field: usize) -> usize {
        let kind = self.fields[field];
        kind.width() * if kind.location == Location::Node { self.nodes() } else { self.elements().len() }
    }

    fn coordinates(&self, nodes: Range<usize>, values: &mut Vec<f64>) {
        self.by_node(nodes, D, values, |node, own| own.copy_from_slice(&self.system.positions[node]));
    }

    fn values(&self, field: usize, places: Range<usize>, values: &mut Vec<f64>) {
        let kind = self.fields[field];
        if let Some(mut column) = self.begin(kind, places.clone(), values) {
            self.of_cells(places, std::slice::from_mut(&mut column));
        }
    }

    fn outlined(&self) -> Cow<'_, Frame> {
        let mut frame = Frame { time: self.system.time, step: self.system.step, dimension: D, ..Frame::default() };
        frame.outlines.extend(self.system.outlines.iter().map(|outline| outline.now(&self.system.bodies, self.system.time)));
        if !frame.outlines.is_empty() {
            self.coordinates(0..self.nodes(), &mut frame.coordinates);
        }
        Cow::Owned(frame)
    }

    fn fill(&self, frame: &mut Frame) {
        (frame.time, frame.step, frame.dimension) = (self.system.time, self.system.step, D);
        self.coordinates(0..self.nodes(), &mut frame.coordinates);
        let mut spare = std::mem::take(&mut frame.fields).into_iter().map(|field| field.values);
        frame.fields = self.fields.iter().map(|&kind| Field { kind, values: spare.next().unwrap_or_default() }).collect();
        let mut columns = Vec::new();
        for Field { kind, values } in &mut frame.fields {
            let places = if kind.location == Location::Node { self.nodes() } else { self.elements().len() };
            columns.extend(self.begin(kind, 0..places, values));
        }
        if !columns.is_empty() {
            self.of_cells(0..self.elements().len(), &mut columns);
        }
        frame.outlines.clear();
        frame.outlines.extend(self.system.outlines.iter().map(|outline| outline.now(&self.system.bodies, self.system.time)));
    }
}
