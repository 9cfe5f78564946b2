//! A part that material flows through: its nodes back in place, and its state there.
//!
//! What has come in has the velocity of the nodes of the inlet, and the state that the elements there had
//! when the flow began, with what their mean stress has changed by since then, and the density to it. It is
//! not the state of each element there now: that would be the same material for ever, which keeps what waves
//! do to it.

use super::source::{Filled, Source};
use super::{Fill, Fresh, Located, NewPart, Places, Present, Renewed, measure_of, sums};
use crate::block::PointValues;
use crate::material::points::PointLaw;
use crate::mesh::cell::CellKind;
use crate::model::{Model, in_3d};
use crate::step::System;
use crate::step::flow::Exchange;
use crate::vector::{minus, plus, times};
use embate_remesh::flow::{Row, Window};
use embate_remesh::plane::{self, Point, cross, dot};
use embate_remesh::transfer;

/// The largest way of a node from its place over the width of an element.
pub(super) fn travel(system: &System<2>, model: &Model, window: &Places<2>) -> Result<f64, String> {
    let present = Present::new(system, model, window.part)?;
    Ok(window_of(&present, window)?.travel(&present.positions).most)
}

fn window_of<'a>(present: &'a Present, of: &'a Places<2>) -> Result<Window<'a>, String> {
    Window::new(plane::Mesh { positions: &of.places, cells: &present.cells }, of.direction).map_err(|failure| failure.to_string())
}

/// What the elements at the inlet have: of each its values at the corners of what will come in beside it, and
/// its density.
pub(super) fn inflow(system: &System<2>, model: &Model, of: &Places<2>) -> Result<Vec<f64>, String> {
    let present = Present::new(system, model, of.part)?;
    let window = window_of(&present, of)?;
    let source = Source::new(system, of.part, &present)?;
    Ok(window.inlet().iter().flat_map(|(cell, corners)| source.beside(*cell as usize, corners)).collect())
}

/// The part with its nodes, which are now elsewhere, back at their places.
pub(super) fn returned(system: &System<2>, model: &Model, of: &Places<2>) -> Result<Fresh<2>, String> {
    let (part, places) = (of.part, &of.places);
    let present = &Present::new(system, model, part)?;
    let window = window_of(present, of)?;
    let way = window.travel(&present.positions).mean;
    let back = window.returned(&present.positions).map_err(|failure| failure.to_string())?;
    let loops = present.loops()?;
    let mut renewed =
        Renewed::new(system, &new_part(system, part, present, &loops, &back.positions), [system.limits.step, system.limits.velocity])?;
    let count = present.nodes.len();
    let itself: Vec<Located> = (0..count as u32).map(|node| Located { shares: vec![(node, 1.0)], is_on_outline: false }).collect();
    let mut held = Fill { system, model, part, present, loops: &loops }.held(&renewed, &itself)?;
    held.extend(back.outflow.twins.iter().map(|&node| held[node as usize]).collect::<Vec<_>>());
    let mut source = Source::new(system, part, present)?;
    let centre = source.centre();
    let before = source.node_masses.clone();
    source.extend(&back.inflow, &of.inflow, law_of(system, part)?.stiffness()[0]);
    let positions: Vec<Point> = back.positions.iter().chain(&back.outflow.positions).copied().collect();
    let cells: Vec<plane::Cell> = renewed.cells.iter().chain(&back.outflow.cells).copied().collect();
    let new = plane::Mesh { positions: &positions, cells: &cells };
    let Carried { mut nodes, stay, leave, filled: Filled { mut values, volumes } } =
        Carried::new(&source, new, renewed.cells.len(), &held)?;
    let points = renewed.cells.len() * values.points;
    let elastic = [(&source.values, present.cells.len() * values.points, &volumes[0]), (&values, points, &volumes[1])]
        .map(|(of, from, volumes)| elastic(system, part, &of.values[from * of.width..], &volumes[from..]));
    let [arrived, left] = elastic;
    let elastic = [arrived?, left?];
    renewed.give(part, &values.masses[..renewed.cells.len()], &stay)?;
    values.values.truncate(points * values.width);
    values.masses.truncate(renewed.cells.len());
    let arrive: Vec<f64> = (0..source.positions.len()).map(|node| source.node_masses[node] - before.get(node).unwrap_or(&0.0)).collect();
    let [arrived, left] = [(&arrive, &source.positions, &source.velocities), (&leave, &positions, &nodes.velocities)]
        .map(|(masses, places, velocities)| Moving::of(masses, places, velocities, centre));
    nodes.velocities.truncate(count);
    let order = order(&renewed.numbers.of_new);
    let fields = fields(&renewed.cells, &values, window.across(&back.positions));
    let exchange = Exchange {
        mass: [arrived.mass, left.mass],
        kinetic: [arrived.kinetic, left.kinetic],
        elastic,
        momentum: [minus(arrived.linear, left.linear), minus(arrived.angular, left.angular)],
        way: way / window.length(),
        places: order.iter().map(|&local| places[local as usize]).collect(),
        fields: order.iter().flat_map(|&local| fields[local as usize].clone()).collect(),
    };
    let number = |&(local, share): &(u32, f64)| (present.nodes[local as usize], share);
    let volume = |of: plane::Mesh<'_>| -> f64 { of.cells.iter().map(|cell| measure_of(of.positions, cell, present.measure)).sum() };
    Ok(Fresh {
        quality: embate_remesh::mesher::quality(&back.positions, &renewed.cells),
        between: back.between.iter().map(|own| own.iter().map(number).collect()).collect(),
        velocities: nodes.velocities,
        points: vec![values],
        correction: nodes.correction,
        volume_change: volume(new) / volume(source.mesh()) - 1.0,
        centre,
        mesh: renewed.mesh,
        numbers: renewed.numbers,
        exchange: Some(exchange),
    })
}

/// The state on the new elements, and on those of what has gone out.
struct Carried {
    nodes: transfer::Nodes,
    /// Masses of nodes that stay, and that go.
    stay: Vec<f64>,
    leave: Vec<f64>,
    filled: Filled,
}

impl Carried {
    /// Of `new` the first `own` cells stay.
    fn new(source: &Source, new: plane::Mesh<'_>, own: usize, held: &[[Option<f64>; 2]]) -> Result<Self, String> {
        let nodes = source.nodes(new, held)?;
        let of_nodes = |corner_mass: &[[f64; 4]]| {
            let mut of_nodes = vec![0.0; new.positions.len()];
            for (cell, masses) in new.cells.iter().zip(corner_mass) {
                cell.iter().zip(masses).for_each(|(&node, mass)| of_nodes[node as usize] += mass);
            }
            of_nodes
        };
        let (all, own) = (of_nodes(&nodes.corner_mass), of_nodes(&nodes.corner_mass[..own]));
        let stay: Vec<f64> = nodes.mass.iter().zip(own.iter().zip(&all)).map(|(mass, (own, all))| mass * own / all).collect();
        let leave = nodes.mass.iter().zip(&stay).map(|(all, stay)| all - stay).collect();
        let filled = source.points(new, sums(&nodes.corner_mass))?;
        Ok(Self { nodes, stay, leave, filled })
    }
}

/// The part with the same elements and names; its nodes keep the initial positions that they have, so that
/// probes and sides stay with the mesh.
fn new_part(system: &System<2>, part: usize, present: &Present, loops: &[Vec<u32>], places: &[Point]) -> NewPart<2> {
    let own = |local: u32| present.nodes[local as usize];
    let pieces = |chain: &Vec<u32>| (0..chain.len()).map(|k| [chain[k], chain[(k + 1) % chain.len()]]).collect::<Vec<_>>();
    NewPart {
        part,
        elements: vec![(CellKind::Quadrilateral, present.cells.iter().flatten().copied().collect())],
        places: places.to_vec(),
        initial: present.nodes.iter().map(|&node| system.mesh.positions[node as usize]).collect(),
        origins: present.nodes.iter().map(|&node| vec![node]).collect(),
        outline: loops.iter().flat_map(pieces).map(|piece| (piece, piece.map(own))).collect(),
    }
}

impl Source {
    /// Values of a cell at these corners, one for each of its points, and its density.
    fn beside(&self, cell: usize, corners: &[u8; 4]) -> Vec<f64> {
        let (points, width) = (self.values.points, self.values.width);
        let at = |corner: &u8| &self.values.values[(cell * points + usize::from(*corner).min(points - 1)) * width..][..width];
        let density = self.masses[cell] / measure_of(&self.positions, &self.cells[cell], self.measure);
        corners[..points].iter().flat_map(at).copied().chain([density]).collect()
    }

    /// Adds what has come in; `inflow`: what was there as the flow began; `bulk`: the bulk modulus, Pa.
    fn extend(&mut self, row: &Row, inflow: &[f64], bulk: f64) {
        let PointValues { points, components, width, .. } = self.values;
        let now: Vec<f64> = row.beside.iter().flat_map(|(cell, corners)| self.beside(*cell as usize, corners)).collect();
        let each = points * width + 1;
        let mean = |all: &[f64], k: usize| {
            let of = |own: &[f64]| own[..each - 1].iter().skip(k).step_by(width).sum::<f64>() / points as f64;
            all.chunks(each).map(of).sum::<f64>() / row.cells.len() as f64
        };
        let changes: Vec<f64> = (0..components).map(|k| mean(&now, k) - mean(inflow, k)).collect();
        let pressed = 1.0 - (changes[0] + changes[1] + changes[2]) / (3.0 * bulk);
        self.positions.extend(&row.positions);
        self.node_masses.resize(self.positions.len(), 0.0);
        self.velocities.extend(row.twins.iter().map(|&node| self.velocities[node as usize]).collect::<Vec<_>>());
        for (cell, own) in row.cells.iter().zip(inflow.chunks(each)) {
            let mass = own[each - 1] * pressed * measure_of(&self.positions, cell, self.measure);
            cell.iter().for_each(|&node| self.node_masses[node as usize] += 0.25 * mass);
            self.masses.push(mass);
            for point in own[..each - 1].chunks(width) {
                self.values.values.extend(point.iter().enumerate().map(|(k, value)| value + changes.get(k).unwrap_or(&0.0)));
            }
        }
        self.cells.extend(&row.cells);
    }
}

fn law_of(system: &System<2>, part: usize) -> Result<&dyn PointLaw, String> {
    let index = system.mesh.groups.iter().position(|group| group.part == part).ok_or("it has no elements")?;
    Ok(system.blocks[index].law().ok_or("it has no law")?)
}

/// Elastic energy of points with these values and volumes, J/m (J).
fn elastic(system: &System<2>, part: usize, values: &[f64], volumes: &[f64]) -> Result<f64, String> {
    let law = law_of(system, part)?;
    let width = if volumes.is_empty() { 1 } else { values.len() / volumes.len() };
    let of = |(values, volume): (&[f64], &f64)| volume * law.energy([values[0], values[1], values[2], values[3], 0.0, 0.0]);
    Ok(values.chunks(width).zip(volumes).map(of).sum())
}

/// Masses that move.
struct Moving {
    mass: f64,
    kinetic: f64,
    linear: [f64; 3],
    /// About the centre of mass.
    angular: [f64; 3],
}

impl Moving {
    fn of(masses: &[f64], places: &[Point], velocities: &[Point], centre: Point) -> Self {
        let mut all = Self { mass: 0.0, kinetic: 0.0, linear: [0.0; 3], angular: [0.0; 3] };
        for ((&mass, &place), &velocity) in masses.iter().zip(places).zip(velocities) {
            all.mass += mass;
            all.kinetic += 0.5 * mass * dot(velocity, velocity);
            all.linear = plus(all.linear, times(mass, in_3d(velocity)));
            all.angular[2] += mass * cross(minus(place, centre), velocity);
        }
        all
    }
}

/// Nodes of a part in the order of the numbers that they have now.
fn order(numbers: &[u32]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..numbers.len() as u32).collect();
    order.sort_unstable_by_key(|&local| numbers[local as usize]);
    order
}

/// Of each node its place across the flow, m, and the means of what the law remembers around it.
fn fields(cells: &[plane::Cell], filled: &PointValues, across: Vec<f64>) -> Vec<Vec<f64>> {
    let PointValues { points, components, width, .. } = *filled;
    let state = width - components;
    let mut sums = vec![vec![0.0; state + 1]; across.len()];
    for ((cell, mass), values) in cells.iter().zip(&filled.masses).zip(filled.values.chunks(points * width)) {
        for &node in cell {
            let sum = &mut sums[node as usize];
            sum[0] += mass;
            for point in values.chunks(width) {
                (0..state).for_each(|k| sum[k + 1] += mass / points as f64 * point[components + k]);
            }
        }
    }
    for (sum, across) in sums.iter_mut().zip(across) {
        let mass = std::mem::replace(&mut sum[0], across);
        sum[1..].iter_mut().for_each(|own| *own /= mass);
    }
    sums
}
