//! New elements inside the outline of a part, and the state of the part on them: in 2D.

use super::{Remeshes, Wish};
use crate::block::PointValues;
use crate::load::constraint::{Constraints, NodeConstraint};
use crate::load::join::Joins;
use crate::mesh::Mesh;
use crate::mesh::cell::CellKind;
use crate::mesh::remeshed::{NewPart, Renumbered};
use crate::model::Model;
use crate::step::System;
use crate::tensor::Dim;
use crate::vector::{plus, times};
use embate_remesh::mesher::{self, Meshed, Outline};
use embate_remesh::plane::{self, Cell, Measure, Point};
use embate_remesh::transfer;
use locate::Located;
use std::collections::BTreeMap;

mod locate;

/// A part with new elements, and its state on them.
pub struct Fresh<const D: usize>
where
    Dim<D>: super::Runs<D>,
{
    pub(super) mesh: Mesh<D>,
    pub(super) numbers: Renumbered,
    pub(super) between: Vec<Vec<(u32, f64)>>,
    pub(super) velocities: Vec<[f64; D]>,
    pub(super) points: PointValues,
    /// Least scaled Jacobian.
    pub(super) quality: f64,
    /// Largest correction of a mass.
    pub(super) correction: f64,
    pub(super) volume_change: f64,
    /// Centre of mass, m.
    pub(super) centre: [f64; D],
}

/// A part as it is: nodes are numbered from 0 in it.
struct Present {
    /// Numbers of its nodes in the mesh, ascending.
    nodes: Vec<u32>,
    positions: Vec<Point>,
    cells: Vec<Cell>,
    /// Mass of each cell.
    masses: Vec<f64>,
    measure: Measure,
}

impl Present {
    fn new(system: &System<2>, model: &Model, part: usize) -> Result<Self, String> {
        let mesh = &system.mesh;
        let mut nodes = mesh.parts[part].nodes.clone();
        nodes.sort_unstable();
        let local = |node: u32| nodes.binary_search(&node).map_or(0, |at| at as u32);
        let mut groups = mesh.groups_of(part);
        let (Some(group), None) = (groups.next(), groups.next()) else { return Err("it has elements of two kinds".into()) };
        if group.kind != CellKind::Quadrilateral {
            return Err("its elements are no quadrilaterals".into());
        }
        let cells: Vec<Cell> = group.cells().map(|cell| std::array::from_fn(|k| local(cell.nodes[k]))).collect();
        let positions = nodes.iter().map(|&node| system.positions[node as usize]).collect();
        let measure = if system.of_revolution { Measure::Revolution } else { Measure::Plane };
        let masses = match mesh.remeshed.of(part) {
            Some(own) => own.masses.clone(),
            None => {
                let density = model.materials.get(&model.parts[part].material).and_then(|it| it.parameters.get("density"));
                let density = density.copied().ok_or("its material has no density")?;
                let initial: Vec<Point> = nodes.iter().map(|&node| mesh.positions[node as usize]).collect();
                cells.iter().map(|cell| density * measure_of(&initial, cell, measure)).collect()
            }
        };
        Ok(Self { nodes, positions, cells, masses, measure })
    }

    fn mesh(&self) -> plane::Mesh<'_> {
        plane::Mesh { positions: &self.positions, cells: &self.cells }
    }

    /// Sum of the cells' areas or volumes.
    fn volume(&self) -> f64 {
        self.cells.iter().map(|cell| measure_of(&self.positions, cell, self.measure)).sum()
    }

    /// Closed chains of nodes, the body on the left.
    fn loops(&self) -> Result<Vec<Vec<u32>>, String> {
        let edges = |cell: &Cell| {
            let corners = plane::corners(cell).to_vec();
            (0..corners.len()).map(move |k| [corners[k], corners[(k + 1) % corners.len()]])
        };
        let mut next: BTreeMap<u32, u32> = BTreeMap::new();
        let all: std::collections::BTreeSet<[u32; 2]> = self.cells.iter().flat_map(edges).collect();
        for &[a, b] in all.iter().filter(|&&[a, b]| !all.contains(&[b, a])) {
            if next.insert(a, b).is_some() {
                return Err("its outline meets itself in a node".into());
            }
        }
        let mut loops = Vec::new();
        while let Some((&first, _)) = next.first_key_value() {
            let (mut chain, mut at) = (Vec::new(), first);
            while let Some(following) = next.remove(&at) {
                chain.push(at);
                at = following;
            }
            if at != first {
                return Err("its outline is not closed".into());
            }
            loops.push(chain);
        }
        Ok(loops)
    }
}

/// Area of a cell, m², or the volume of the axisymmetric body, m³.
fn measure_of(positions: &[Point], cell: &Cell, measure: Measure) -> f64 {
    let corners = plane::corners(cell);
    let from = positions[corners[0] as usize];
    let triangle = |pair: &[u32]| {
        let [a, b] = [positions[pair[0] as usize], positions[pair[1] as usize]];
        let area = 0.5 * plane::cross(plane::minus(a, from), plane::minus(b, from));
        match measure {
            Measure::Plane => area,
            Measure::Revolution => area * std::f64::consts::TAU * (from[0] + a[0] + b[0]) / 3.0,
        }
    };
    corners[1..].windows(2).map(triangle).sum()
}

/// Which components of the velocity of a node are prescribed, each by itself: not those of an oblique
/// direction.
fn held_components(constraint: Option<&NodeConstraint<2>>) -> [bool; 2] {
    let Some(own) = constraint else { return [false; 2] };
    let (zero, x, y) = (own.apply([0.0; 2]), own.apply([1.0, 0.0]), own.apply([0.0, 1.0]));
    [0, 1].map(|d| (x[d] - zero[d]).abs() < 1e-9 && (y[d] - zero[d]).abs() < 1e-9)
}

/// Edge length and the most cells.
fn size_of(present: &Present, wish: &Wish) -> (f64, usize) {
    let area: f64 = present.cells.iter().map(|cell| measure_of(&present.positions, cell, Measure::Plane)).sum();
    let [start, most] = wish.elements;
    let size = wish.size.unwrap_or_else(|| (area / start as f64).sqrt());
    // The mesher may need some more than the mean says.
    (size.max((area / (0.8 * most as f64)).sqrt()), most)
}

impl Remeshes<2> for Dim<2> {
    fn quality(system: &System<2>, part: usize) -> f64 {
        let of = |cell: crate::mesh::cell::Cell<'_>| -> f64 {
            let nodes: Cell = std::array::from_fn(|k| k.min(cell.nodes.len() - 1) as u32);
            let places = nodes.map(|k| system.positions[cell.nodes[k as usize] as usize]);
            mesher::quality(&places, &[nodes])
        };
        system.mesh.groups_of(part).flat_map(|group| group.cells()).map(of).fold(f64::INFINITY, f64::min)
    }

    fn fresh(system: &System<2>, model: &Model, part: usize, wish: &Wish) -> Result<Fresh<2>, String> {
        let present = Present::new(system, model, part)?;
        let loops = present.loops()?;
        let meshed = mesh_of(system, &present, &loops, wish)?;
        let quality = mesher::quality(&meshed.positions, &meshed.cells);
        if quality <= wish.quality {
            return Err(format!("the new mesh has a least scaled Jacobian of {quality:.3}, and not more than {:.3}", wish.quality));
        }
        let part = &Fill { system, model, part, present: &present, loops: &loops };
        part.filled(meshed, quality)
    }
}

/// New cells inside the outline.
fn mesh_of(system: &System<2>, present: &Present, loops: &[Vec<u32>], wish: &Wish) -> Result<Meshed, String> {
    let number = |&local: &u32| present.nodes[local as usize];
    let of_mesh: Vec<Vec<u32>> = loops.iter().map(|chain| chain.iter().map(number).collect()).collect();
    let fixed = |chain: &Vec<u32>| -> Vec<bool> {
        let named = system.mesh.ends_of_names(chain);
        let held = |k: usize| held_components(system.constraints.of(chain[k % chain.len()] as usize));
        let both = |k: usize| [0, 1].map(|d| held(k)[d] && held(k + 1)[d]);
        let n = chain.len();
        (0..n).map(|k| named[k] || both(k + n - 1) != both(k)).collect()
    };
    let outline = Outline {
        loops: loops.iter().map(|chain| chain.iter().map(|&node| present.positions[node as usize]).collect()).collect(),
        fixed: of_mesh.iter().map(fixed).collect(),
    };
    let (size, most) = size_of(present, wish);
    mesher::quadrilaterals(&outline, &|_| size, present.measure, most).map_err(|failure| failure.to_string())
}

/// What new cells are filled from.
struct Fill<'a> {
    system: &'a System<2>,
    model: &'a Model,
    part: usize,
    present: &'a Present,
    loops: &'a [Vec<u32>],
}

impl Fill<'_> {
    /// The part with new cells, and its state.
    fn filled(&self, meshed: Meshed, quality: f64) -> Result<Fresh<2>, String> {
        let (system, present) = (self.system, self.present);
        let places = self.places(&meshed)?;
        let outline = self.pieces(&meshed);
        let number = |&(local, share): &(u32, f64)| (present.nodes[local as usize], share);
        let between: Vec<Vec<(u32, f64)>> =
            places.iter().map(|it| if it.is_on_outline { it.shares.iter().map(number).collect() } else { Vec::new() }).collect();
        let initial = |it: &Located| {
            it.shares.iter().fold([0.0; 2], |sum, &(local, share)| {
                plus(sum, times(share, system.mesh.positions[present.nodes[local as usize] as usize]))
            })
        };
        let new = NewPart {
            part: self.part,
            kind: CellKind::Quadrilateral,
            connectivity: meshed.cells.iter().flatten().copied().collect(),
            places: meshed.positions.clone(),
            initial: places.iter().map(initial).collect(),
            origins: places.iter().map(|it| it.shares.iter().map(|entry| number(entry).0).collect()).collect(),
            outline,
        };
        let limits = [system.limits.step, system.limits.velocity];
        let (mut mesh, numbers) = system.mesh.with_new(&new, limits);
        // Cells as the mesh has them: in its order, each begun at the corner where it begins there.
        let mut locals = vec![0; mesh.positions.len()];
        numbers.of_new.iter().enumerate().for_each(|(local, &node)| locals[node as usize] = local as u32);
        let group = mesh.groups_of(self.part).next().ok_or("it has no elements")?;
        let cells: Vec<Cell> = group.cells().map(|cell| std::array::from_fn(|k| locals[cell.nodes[k] as usize])).collect();
        let held = self.held(&mesh, &numbers, &places)?;
        let new_mesh = plane::Mesh { positions: &meshed.positions, cells: &cells };
        let nodes = self.nodes(new_mesh, &held)?;
        let own = mesh.remeshed.parts.last_mut().ok_or("it was not made again")?;
        own.masses = nodes.corner_mass.iter().map(|corners| corners.iter().sum()).collect();
        let node_mass = |&node: &u32| nodes.mass[locals[node as usize] as usize];
        own.node_masses = mesh.parts[self.part].nodes.iter().map(node_mass).collect();
        let points = self.points(new_mesh)?;
        let volume: f64 = cells.iter().map(|cell| measure_of(&meshed.positions, cell, present.measure)).sum();
        Ok(Fresh {
            mesh,
            numbers,
            between,
            velocities: nodes.velocities,
            points,
            quality,
            correction: nodes.correction,
            volume_change: volume / present.volume() - 1.0,
            centre: self.centre(),
        })
    }

    fn velocities(&self) -> Vec<Point> {
        self.present.nodes.iter().map(|&node| self.system.velocities[node as usize]).collect()
    }

    fn node_masses(&self) -> Vec<f64> {
        self.present.nodes.iter().map(|&node| self.system.mass[node as usize]).collect()
    }

    fn centre(&self) -> Point {
        let masses = self.node_masses();
        let sum = masses.iter().zip(&self.present.positions).fold([0.0; 2], |sum, (&mass, &place)| plus(sum, times(mass, place)));
        times(1.0 / masses.iter().sum::<f64>(), sum)
    }

    /// Where the material of each new node is among the old nodes.
    fn places(&self, meshed: &Meshed) -> Result<Vec<Located>, String> {
        let mut places: Vec<Option<Located>> = vec![None; meshed.positions.len()];
        for (chain, old) in meshed.loops.iter().zip(self.loops) {
            for own in chain {
                let (at, share) = (own.segment as usize, own.fraction);
                let ends = [old[at % old.len()], old[(at + 1) % old.len()]];
                let shares = if share == 0.0 { vec![(ends[0], 1.0)] } else { vec![(ends[0], 1.0 - share), (ends[1], share)] };
                if let Some(place) = places.get_mut(own.node as usize) {
                    *place = Some(Located { shares, is_on_outline: true });
                }
            }
        }
        let grid = locate::Grid::new(self.present.mesh());
        let inner =
            |(place, &x): (Option<Located>, &Point)| place.or_else(|| grid.locate(x)).ok_or("a new node is outside of it".to_string());
        places.into_iter().zip(&meshed.positions).map(inner).collect()
    }

    /// Pieces of the new outline, each with the old one that it begins on.
    fn pieces(&self, meshed: &Meshed) -> Vec<([u32; 2], [u32; 2])> {
        let number = |local: u32| self.present.nodes[local as usize];
        let mut pieces = Vec::new();
        for (chain, old) in meshed.loops.iter().zip(self.loops) {
            for (k, own) in chain.iter().enumerate() {
                let at = own.segment as usize;
                let piece = [old[at % old.len()], old[(at + 1) % old.len()]].map(number);
                pieces.push(([own.node, chain[(k + 1) % chain.len()].node], piece));
            }
        }
        pieces
    }

    /// Prescribed components of the velocities.
    fn held(&self, mesh: &Mesh<2>, numbers: &Renumbered, places: &[Located]) -> Result<Vec<[Option<f64>; 2]>, String> {
        let (model, curves) = (self.model, &self.system.curves);
        let axis = <Dim<2> as crate::build::Builds<2>>::with_axis(model, mesh).map_err(|_| "its new nodes leave the axis".to_string())?;
        let constraints = Constraints::new(axis.as_ref().unwrap_or(model), mesh, curves, &Joins::default(), 0);
        let constraints = constraints.map_err(|faults| faults.first().map_or(String::new(), ToString::to_string))?;
        let of = |(&node, place): (&u32, &Located)| {
            let velocity = place.shares.iter().fold([0.0; 2], |sum, &(local, share)| {
                plus(sum, times(share, self.system.velocities[self.present.nodes[local as usize] as usize]))
            });
            let held = held_components(constraints.of(node as usize));
            [0, 1].map(|d| held[d].then_some(velocity[d]))
        };
        Ok(numbers.of_new.iter().zip(places).map(of).collect())
    }

    /// Masses and velocities.
    fn nodes(&self, new: plane::Mesh<'_>, held: &[[Option<f64>; 2]]) -> Result<transfer::Nodes, String> {
        let present = self.present;
        let supermesh = transfer::Supermesh::new(present.mesh(), new, present.measure).map_err(|failure| failure.to_string())?;
        let corner_mass: Vec<[f64; 4]> = present.masses.iter().map(|mass| [0.25 * mass; 4]).collect();
        let (node_mass, velocities) = (self.node_masses(), self.velocities());
        let old = transfer::OldNodes {
            mesh: present.mesh(),
            corner_mass: &corner_mass,
            node_mass: &node_mass,
            velocities: &velocities,
            spare: 0.0,
        };
        transfer::nodes(&supermesh, &old, &transfer::NewNodes { mesh: new, held }).map_err(|failure| failure.to_string())
    }

    /// Stresses by volume, and what the law remembers by mass.
    fn points(&self, new: plane::Mesh<'_>) -> Result<PointValues, String> {
        let (system, present) = (self.system, self.present);
        let index = system.mesh.groups.iter().position(|group| group.part == self.part).ok_or("it has no elements")?;
        let values = system.blocks[index].point_values().ok_or("its law can't continue with means")?;
        let PointValues { points, components, width, .. } = values;
        let old = transfer::Points { mesh: present.mesh(), points };
        let target = transfer::Points { mesh: new, points };
        let part = |from: usize, to: usize| -> Vec<f64> { values.values.chunks(width).flat_map(|own| own[from..to].to_vec()).collect() };
        let order = transfer::Order::Linear;
        let carried = |own: &[f64], count: usize, densities: Option<&[f64]>| -> Result<Vec<f64>, String> {
            if count == 0 {
                return Ok(Vec::new());
            }
            // What a law remembers, such as plastic strain, stays within what it is anywhere.
            let range = |k: usize| {
                own.iter().skip(k).step_by(count).fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &it| [low.min(it), high.max(it)])
            };
            let ranges: Vec<[f64; 2]> = (0..count).map(range).collect();
            let limits = densities.is_some().then_some(&ranges[..]);
            let values = transfer::Values { values: own, width: count, densities, order, limits };
            let mut carried = transfer::points(&old, &target, present.measure, &values).map_err(|failure| failure.to_string())?;
            if limits.is_some() {
                // To the last digit.
                carried.iter_mut().zip(ranges.iter().cycle()).for_each(|(value, &[low, high])| *value = value.max(low).min(high));
            }
            Ok(carried)
        };
        let densities: Vec<f64> = present
            .masses
            .iter()
            .zip(&present.cells)
            .map(|(mass, cell)| mass / measure_of(&present.positions, cell, present.measure))
            .collect();
        let stress = carried(&part(0, components), components, None)?;
        let state = carried(&part(components, width), width - components, Some(&densities))?;
        let count = new.cells.len() * points;
        let mut all = Vec::with_capacity(count * width);
        for point in 0..count {
            all.extend_from_slice(&stress[point * components..][..components]);
            all.extend_from_slice(&state[point * (width - components)..][..width - components]);
        }
        Ok(PointValues { points, components, width, values: all })
    }
}
