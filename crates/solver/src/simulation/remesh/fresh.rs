//! New elements inside the outline of a part, and the state of the part on them: in 2D.

use super::{Places, Remeshes, Wish};
use crate::block::PointValues;
use crate::contact::Standing;
use crate::load::constraint::{Constraints, NodeConstraint};
use crate::load::join::Joins;
use crate::mesh::Mesh;
use crate::mesh::cell::CellKind;
use crate::mesh::remeshed::{NewPart, Renumbered};
use crate::model::Model;
use crate::step::System;
use crate::step::flow::Exchange;
use crate::tensor::Dim;
use crate::vector::{plus, times};
use embate_remesh::mesher::{self, Meshed, Outline};
use embate_remesh::plane::{self, Cell, Measure, Point};
use embate_remesh::relocate;
use locate::Located;
use sizes::Sizes;
use source::Source;

mod flow;
mod locate;
mod onto;
mod sizes;
mod source;

/// A part with new elements, and its state on them.
pub struct Fresh<const D: usize>
where
    Dim<D>: super::Runs<D>,
{
    pub(super) mesh: Mesh<D>,
    pub(super) numbers: Renumbered,
    pub(super) between: Vec<Vec<(u32, f64)>>,
    pub(super) velocities: Vec<[f64; D]>,
    /// Of each group of its elements.
    pub(super) points: Vec<PointValues>,
    /// Least scaled Jacobian.
    pub(super) quality: f64,
    /// Largest correction of a mass.
    pub(super) correction: f64,
    pub(super) volume_change: f64,
    /// Centre of mass, m.
    pub(super) centre: [f64; D],
    /// What has come in and gone out, of a part that material flows through.
    pub(super) exchange: Option<Exchange<D>>,
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
        Ok(plane::loops(&self.cells)?)
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
    constraint.map_or([false; 2], NodeConstraint::components)
}

/// Moved nodes must give a least scaled Jacobian that is better by this factor.
pub(super) const BETTER: f64 = 1.02;
impl Remeshes<2> for Dim<2> {
    fn quality(system: &System<2>, part: usize) -> f64 {
        let of = |cell: crate::mesh::cell::Cell<'_>| -> f64 {
            let nodes: Cell = std::array::from_fn(|k| k.min(cell.nodes.len() - 1) as u32);
            let places = nodes.map(|k| system.positions[cell.nodes[k as usize] as usize]);
            mesher::quality(&places, &[nodes])
        };
        system.mesh.groups_of(part).flat_map(|group| group.cells()).map(of).fold(f64::INFINITY, f64::min)
    }

    fn coarseness(system: &System<2>, model: &Model, part: usize, wish: &Wish<'_>) -> f64 {
        if !Sizes::differ(wish.rule) {
            return 0.0;
        }
        // Of a part that can't be meshed nothing is too long.
        Present::new(system, model, part).map_or(0.0, |present| Sizes::new(system, part, &present, wish).coarseness)
    }

    fn fresh(system: &System<2>, model: &Model, part: usize, wish: &Wish<'_>) -> Result<Fresh<2>, String> {
        let present = Present::new(system, model, part)?;
        let loops = present.loops()?;
        let meshed = mesh_of(system, part, &present, &loops, wish)?;
        let quality = mesher::quality(&meshed.positions, &meshed.cells);
        if quality <= wish.quality {
            return Err(format!("the new mesh has a least scaled Jacobian of {quality:.3}, and not more than {:.3}", wish.quality));
        }
        let part = &Fill { system, model, part, present: &present, loops: &loops };
        part.filled(meshed, quality)
    }

    fn onto(system: &System<2>, model: &Model, part: usize, new: &Mesh<2>) -> Result<Fresh<2>, String> {
        let present = Present::new(system, model, part)?;
        let loops = present.loops()?;
        let meshed = present.meshed(&loops, new)?;
        let quality = mesher::quality(&meshed.positions, &meshed.cells);
        Fill { system, model, part, present: &present, loops: &loops }.filled(meshed, quality)
    }

    fn travel(system: &System<2>, model: &Model, window: &Places<2>) -> Result<f64, String> {
        flow::travel(system, model, window)
    }

    fn inflow(system: &System<2>, model: &Model, window: &Places<2>) -> Result<Vec<f64>, String> {
        flow::inflow(system, model, window)
    }

    fn returned(system: &System<2>, model: &Model, window: &Places<2>) -> Result<Fresh<2>, String> {
        flow::returned(system, model, window)
    }
}

/// New cells inside the outline.
fn mesh_of(system: &System<2>, part: usize, present: &Present, loops: &[Vec<u32>], wish: &Wish<'_>) -> Result<Meshed, String> {
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
    let now = Standing { positions: &system.positions, bodies: &system.bodies };
    // Where a new node has to be beside what the part presses on.
    let fitted = |spot: mesher::Spot| -> Option<Point> {
        let (chain, at) = (&of_mesh[spot.of_loop], spot.segment as usize);
        let ends = [chain[at % chain.len()], chain[(at + 1) % chain.len()]];
        let held = ends.map(|node| held_components(system.constraints.of(node as usize)));
        // Nodes of a side that is held stay on it.
        if (0..2).any(|d| held[0][d] && held[1][d]) {
            return None;
        }
        let between = [(ends[0], 1.0 - spot.fraction), (ends[1], spot.fraction)];
        let between = &between[..if spot.fraction == 0.0 { 1 } else { 2 }];
        system.contacts.iter().find_map(|contact| contact.fitted(between, spot.place, &now))
    };
    if wish.relocates {
        let body = relocate::Body { mesh: present.mesh(), loops, fixed: &outline.fixed };
        return relocate::relocated_outside(&body, present.measure, BETTER, &fitted).map_err(|failure| failure.to_string());
    }
    let sizes = Sizes::new(system, part, present, wish);
    let at = |place| sizes.at(place);
    mesher::quadrilaterals_outside(&outline, &at, present.measure, sizes.most, &fitted).map_err(|failure| failure.to_string())
}

/// The mesh with a part that was made again.
struct Renewed {
    mesh: Mesh<2>,
    numbers: Renumbered,
    /// Number of each node of the mesh in the new part.
    locals: Vec<u32>,
    /// Cells of the part as the mesh has them: in its order, each begun at the corner where it begins there.
    cells: Vec<Cell>,
}

impl Renewed {
    fn new(system: &System<2>, new: &NewPart<2>, limits: [f64; 2]) -> Result<Self, String> {
        let (mesh, numbers) = system.mesh.with_new(new, limits);
        let mut locals = vec![0; mesh.positions.len()];
        numbers.of_new.iter().enumerate().for_each(|(local, &node)| locals[node as usize] = local as u32);
        let group = mesh.groups_of(new.part).next().ok_or("it has no elements")?;
        let cells: Vec<Cell> = group.cells().map(|cell| std::array::from_fn(|k| locals[cell.nodes[k] as usize])).collect();
        Ok(Self { mesh, numbers, locals, cells })
    }

    /// Gives the part the masses of its cells and of its nodes, kg/m (kg).
    fn give(&mut self, part: usize, masses: &[f64], node_masses: &[f64]) -> Result<(), String> {
        let own = self.mesh.remeshed.parts.last_mut().ok_or("it was not made again")?;
        own.masses = masses.to_vec();
        own.node_masses = self.mesh.parts[part].nodes.iter().map(|&node| node_masses[self.locals[node as usize] as usize]).collect();
        Ok(())
    }
}

/// Mass of each cell, kg/m (kg), of those of its corners.
fn sums(corner_mass: &[[f64; 4]]) -> Vec<f64> {
    corner_mass.iter().map(|corners| corners.iter().sum()).collect()
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
            elements: vec![(CellKind::Quadrilateral, meshed.cells.iter().flatten().copied().collect())],
            places: meshed.positions.clone(),
            initial: places.iter().map(initial).collect(),
            origins: places.iter().map(|it| it.shares.iter().map(|entry| number(entry).0).collect()).collect(),
            outline,
        };
        let limits = [system.limits.step, system.limits.velocity];
        let mut renewed = Renewed::new(system, &new, limits)?;
        let held = self.held(&renewed, &places)?;
        let source = Source::new(system, self.part, present)?;
        let cells = renewed.cells.clone();
        let new_mesh = plane::Mesh { positions: &meshed.positions, cells: &cells };
        let nodes = source.nodes(new_mesh, &held)?;
        let masses = sums(&nodes.corner_mass);
        renewed.give(self.part, &masses, &nodes.mass)?;
        let points = source.points(new_mesh, masses)?.values;
        let volume: f64 = cells.iter().map(|cell| measure_of(&meshed.positions, cell, present.measure)).sum();
        Ok(Fresh {
            mesh: renewed.mesh,
            numbers: renewed.numbers,
            between,
            velocities: nodes.velocities,
            points: vec![points],
            quality,
            correction: nodes.correction,
            volume_change: volume / present.volume() - 1.0,
            centre: source.centre(),
            exchange: None,
        })
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
    fn held(&self, renewed: &Renewed, places: &[Located]) -> Result<Vec<[Option<f64>; 2]>, String> {
        let (model, curves, Renewed { mesh, numbers, .. }) = (self.model, &self.system.curves, renewed);
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
}
