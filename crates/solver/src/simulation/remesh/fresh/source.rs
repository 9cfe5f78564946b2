//! What new cells get their state from: old cells, and what these, their nodes and their points have.

use super::super::carried::carried;
use super::{Present, measure_of};
use crate::block::PointValues;
use crate::step::System;
use crate::vector::{plus, times};
use embate_remesh::plane::{self, Cell, Measure, Point};
use embate_remesh::transfer;

/// Cells of a body with their state.
pub(super) struct Source {
    pub(super) positions: Vec<Point>,
    pub(super) cells: Vec<Cell>,
    /// Of each cell.
    pub(super) masses: Vec<f64>,
    pub(super) node_masses: Vec<f64>,
    pub(super) velocities: Vec<Point>,
    /// Of the points of the cells.
    pub(super) values: PointValues,
    pub(super) measure: Measure,
}

/// Values of new points.
pub(super) struct Filled {
    pub(super) values: PointValues,
    /// Volumes of old points and of new ones, m² (m³).
    pub(super) volumes: [Vec<f64>; 2],
}

impl Source {
    /// A part as it is.
    pub(super) fn new(system: &System<2>, part: usize, present: &Present) -> Result<Self, String> {
        let index = system.mesh.groups.iter().position(|group| group.part == part).ok_or("it has no elements")?;
        let values = system.blocks[index].point_values(&system.positions).ok_or("its law can't continue with means")?;
        let each = || present.nodes.iter().map(|&node| node as usize);
        Ok(Self {
            positions: present.positions.clone(),
            cells: present.cells.clone(),
            masses: present.masses.clone(),
            node_masses: each().map(|node| system.mass[node]).collect(),
            velocities: each().map(|node| system.velocities[node]).collect(),
            values,
            measure: present.measure,
        })
    }

    pub(super) fn mesh(&self) -> plane::Mesh<'_> {
        plane::Mesh { positions: &self.positions, cells: &self.cells }
    }

    /// Centre of the nodes' masses, m.
    pub(super) fn centre(&self) -> Point {
        let sum = self.node_masses.iter().zip(&self.positions).fold([0.0; 2], |sum, (&mass, &place)| plus(sum, times(mass, place)));
        times(1.0 / self.node_masses.iter().sum::<f64>(), sum)
    }

    /// Masses and velocities.
    pub(super) fn nodes(&self, new: plane::Mesh<'_>, held: &[[Option<f64>; 2]]) -> Result<transfer::Nodes, String> {
        let supermesh = transfer::Supermesh::new(self.mesh(), new, self.measure).map_err(|failure| failure.to_string())?;
        let corner_mass: Vec<[f64; 4]> = self.masses.iter().map(|mass| [0.25 * mass; 4]).collect();
        let old = transfer::OldNodes {
            mesh: self.mesh(),
            corner_mass: &corner_mass,
            node_mass: &self.node_masses,
            velocities: &self.velocities,
            spare: 0.0,
        };
        transfer::nodes(&supermesh, &old, &transfer::NewNodes { mesh: new, held }).map_err(|failure| failure.to_string())
    }

    /// Stresses by volume, and what the law remembers by mass.
    pub(super) fn points(&self, new: plane::Mesh<'_>, masses: Vec<f64>) -> Result<Filled, String> {
        let PointValues { points, components, width, is_strain, .. } = self.values;
        let old = transfer::Points { mesh: self.mesh(), points };
        let target = transfer::Points { mesh: new, points };
        let map = transfer::PointMap::new(&old, &target, self.measure).map_err(|failure| failure.to_string())?;
        let density = |(mass, cell): (&f64, &Cell)| mass / measure_of(&self.positions, cell, self.measure);
        let densities: Vec<f64> = self.masses.iter().zip(&self.cells).map(density).collect();
        let all = carried(&self.values, &densities, |own| map.values(own))?;
        let volumes = map.weights(None, transfer::Order::Linear).map_err(|failure| failure.to_string())?;
        Ok(Filled { values: PointValues { points, components, width, is_strain, masses, values: all }, volumes })
    }
}
