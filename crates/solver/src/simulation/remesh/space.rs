//! Nodes of a part moved to better places, or a part on other elements, and its state on them: in 3D.

mod onto;

use super::carried::carried;
use super::fresh::{BETTER, Fresh};
use super::{Remeshes, Wish};
use crate::block::PointValues;
use crate::element::points_of;
use crate::load::constraint::{Constraints, NodeConstraint};
use crate::load::join::Joins;
use crate::mesh::cell::CellKind;
use crate::mesh::remeshed::RemeshedPart;
use crate::mesh::surface::{Corners, Facet};
use crate::mesh::{ElementGroup, Mesh};
use crate::model::Model;
use crate::step::System;
use crate::tensor::Dim;
use crate::vector::{plus, times};
use embate_remesh::space::relocate::{self, Marks, Relocated};
use embate_remesh::space::{self, Cell, Kind, Point, Rule};

impl Remeshes<3> for Dim<3> {
    fn quality(system: &System<3>, part: usize) -> f64 {
        // Those of other kinds are refused where the model is checked.
        Present::cells_of(&system.mesh, part, |node| node)
            .map_or(1.0, |cells| relocate::quality(space::Mesh { positions: &system.positions, cells: &cells }))
    }

    fn fresh(system: &System<3>, model: &Model, part: usize, wish: &Wish<'_>) -> Result<Fresh<3>, String> {
        if !wish.relocates {
            return Err("elements are made again in 2D only".into());
        }
        let present = Present::new(system, model, part)?;
        let moved = present.moved(system)?;
        if moved.quality <= wish.quality {
            return Err(format!(
                "the best mesh has a least scaled Jacobian of {:.3}, and not more than {:.3}",
                moved.quality, wish.quality
            ));
        }
        Fill { system, model, part, present: &present }.filled(moved)
    }

    fn onto(system: &System<3>, model: &Model, part: usize, new: &Mesh<3>) -> Result<Fresh<3>, String> {
        let present = Present::new(system, model, part)?;
        Fill { system, model, part, present: &present }.onto(new)
    }
}

/// A part as it is: nodes are numbered from 0 in it, in the order of the user's numbers, so that axes in
/// another order change nothing.
struct Present {
    /// Numbers of its nodes in the mesh.
    nodes: Vec<u32>,
    /// Of each node of the mesh its number here.
    locals: Vec<u32>,
    positions: Vec<Point>,
    /// Group by group.
    cells: Vec<Cell>,
    /// Of each cell, kg and m³.
    masses: Vec<f64>,
    volumes: Vec<f64>,
}

impl Present {
    fn new(system: &System<3>, model: &Model, part: usize) -> Result<Self, String> {
        let mesh = &system.mesh;
        let mut nodes = mesh.parts[part].nodes.clone();
        nodes.sort_unstable_by_key(|&node| mesh.user_nodes[node as usize]);
        let mut locals = vec![u32::MAX; mesh.positions.len()];
        (0..).zip(&nodes).for_each(|(local, &node)| locals[node as usize] = local);
        let cells = Self::cells_of(mesh, part, |node| locals[node as usize]).ok_or("its elements have nodes that can't be moved")?;
        let places = |of: &[Point]| -> Vec<Point> { nodes.iter().map(|&node| of[node as usize]).collect() };
        let positions = places(&system.positions);
        let volumes = |positions: &[Point]| space::volumes(space::Mesh { positions, cells: &cells }).map_err(|failure| failure.to_string());
        let masses = match mesh.remeshed.of(part) {
            Some(own) => own.masses.clone(),
            None => {
                let density = model.materials.get(&model.parts[part].material).and_then(|it| it.parameters.get("density"));
                let density = density.copied().ok_or("its material has no density")?;
                volumes(&places(&mesh.positions))?.into_iter().map(|volume| density * volume).collect()
            }
        };
        let volumes = volumes(&positions)?;
        Ok(Self { nodes, locals, positions, cells, masses, volumes })
    }

    /// The elements of a part, group by group; `None` if a kind among them is none whose nodes move.
    fn cells_of(mesh: &Mesh<3>, part: usize, number: impl Fn(u32) -> u32) -> Option<Vec<Cell>> {
        let mut cells = Vec::with_capacity(mesh.elements_of(part));
        for group in mesh.groups_of(part) {
            let kind = match group.kind {
                CellKind::Hexahedron => Kind::Hexahedron,
                CellKind::Wedge => Kind::Wedge,
                CellKind::Tetrahedron => Kind::Tetrahedron,
                CellKind::Tetrahedron10 => Kind::Tetrahedron10,
                _ => return None,
            };
            for cell in group.cells() {
                let nodes: Vec<u32> = cell.nodes.iter().map(|&node| number(node)).collect();
                cells.push(Cell::new(kind, &nodes)?);
            }
        }
        Some(cells)
    }

    fn mesh(&self) -> space::Mesh<'_> {
        space::Mesh { positions: &self.positions, cells: &self.cells }
    }

    /// A value for each node of the part from those of all nodes.
    fn of_nodes<T: Copy>(&self, all: &[T]) -> Vec<T> {
        self.nodes.iter().map(|&node| all[node as usize]).collect()
    }

    /// The mesh with its nodes in better places.
    fn moved(&self, system: &System<3>) -> Result<Relocated, String> {
        let names = system.mesh.names();
        let marks = |&node: &u32| -> Vec<u32> {
            let held = system.constraints.of(node as usize).map_or([false; 3], NodeConstraint::components);
            let components = (0..3).filter(|&k| held[k as usize]);
            components.chain(names.nodes[node as usize].iter().map(|name| name + 3)).collect()
        };
        let nodes: Vec<Vec<u32>> = self.nodes.iter().map(marks).collect();
        let faces = relocate::faces(self.mesh());
        let face = |local: &[u32; 4]| -> Vec<u32> {
            let own = &local[..if local[2] == local[3] { 3 } else { 4 }];
            // What all of its nodes are in, and the names of the piece.
            let of_all = nodes[own[0] as usize].iter().copied().filter(|mark| own.iter().all(|&node| nodes[node as usize].contains(mark)));
            let piece = Facet::<3>::of_cell(&own.iter().map(|&node| self.nodes[node as usize]).collect::<Vec<_>>());
            let named = piece.and_then(|piece| names.pieces.get(&piece.undirected())).into_iter().flatten().map(|name| name + 3);
            let mut marks: Vec<u32> = of_all.chain(named).collect();
            marks.sort_unstable();
            marks
        };
        let faces: Vec<Vec<u32>> = faces.iter().map(face).collect();
        let is_oblique = |&node: &u32| system.constraints.of(node as usize).is_some_and(NodeConstraint::is_oblique);
        let fixed: Vec<bool> = self.nodes.iter().map(is_oblique).collect();
        relocate::relocated(self.mesh(), &Marks { fixed: &fixed, nodes: &nodes, faces: &faces }, BETTER)
            .map_err(|failure| failure.to_string())
    }
}

/// What moved nodes, or new elements, are filled from.
struct Fill<'a> {
    system: &'a System<3>,
    model: &'a Model,
    part: usize,
    present: &'a Present,
}

impl Fill<'_> {
    /// The part with its nodes moved, and its state.
    fn filled(&self, moved: Relocated) -> Result<Fresh<3>, String> {
        let (system, present) = (self.system, self.present);
        let new = space::Mesh { positions: &moved.positions, cells: &present.cells };
        let is_outer = relocate::faces(present.mesh()).into_iter().flatten().fold(vec![false; present.nodes.len()], |mut outer, node| {
            outer[node as usize] = true;
            outer
        });
        let number = |&(local, share): &(u32, f64)| (present.nodes[local as usize], share);
        let shares = || moved.shares.iter().map(|own| own.iter().map(number).collect::<Vec<_>>());
        let between: Vec<Vec<(u32, f64)>> = shares().zip(&is_outer).map(|(own, outer)| if *outer { own } else { Vec::new() }).collect();
        let initial: Vec<Point> = shares().map(|own| mean(&own, &system.mesh.positions)).collect();
        let velocities: Vec<Point> = shares().map(|own| mean(&own, &system.velocities)).collect();
        let in_order = &system.mesh.parts[self.part].nodes;
        let places = |of: &[Point]| -> Vec<Point> { in_order.iter().map(|&node| of[present.locals[node as usize] as usize]).collect() };
        let own = system.mesh.remeshed.of(self.part);
        let elements_at_start = own.map_or_else(|| system.mesh.elements_of(self.part), |own| own.elements_at_start);
        let own = RemeshedPart { part: self.part, places: places(&moved.positions), elements_at_start, ..RemeshedPart::default() };
        let limits = [system.limits.step, system.limits.velocity];
        let (mut mesh, numbers) = system.mesh.with_moved(own, &places(&initial), &present.nodes, limits);
        let nodes = self.nodes(new, &self.held(&mesh, &present.nodes, &velocities)?)?;
        let own = mesh.remeshed.parts.last_mut().ok_or("none of its nodes were moved")?;
        own.masses.clone_from(&nodes.cell_mass);
        own.node_masses = in_order.iter().map(|&node| nodes.mass[present.locals[node as usize] as usize]).collect();
        let points = self.points(new, &mesh, &nodes.cell_mass)?;
        let volume: f64 = space::volumes(new).map_err(|failure| failure.to_string())?.iter().sum();
        Ok(Fresh {
            mesh,
            numbers,
            between,
            velocities: nodes.velocities,
            points,
            quality: moved.quality,
            correction: nodes.correction,
            volume_change: volume / present.volumes.iter().sum::<f64>() - 1.0,
            centre: self.centre(),
            exchange: None,
        })
    }

    fn centre(&self) -> Point {
        let masses = self.present.of_nodes(&self.system.mass);
        let sum = masses.iter().zip(&self.present.positions).fold([0.0; 3], |sum, (&mass, &place)| plus(sum, times(mass, place)));
        times(1.0 / masses.iter().sum::<f64>(), sum)
    }

    /// Prescribed components of the velocities of nodes of the new mesh; `velocities` are those of the
    /// material at their places.
    fn held(&self, mesh: &Mesh<3>, nodes: &[u32], velocities: &[Point]) -> Result<Vec<[Option<f64>; 3]>, String> {
        let constraints = Constraints::new(self.model, mesh, &self.system.curves, &Joins::default(), 0);
        let constraints = constraints.map_err(|faults| faults.first().map_or(String::new(), ToString::to_string))?;
        let of = |(&node, velocity): (&u32, &Point)| {
            let Some(own) = constraints.of(node as usize) else { return [None; 3] };
            // What an oblique direction prescribes, the node keeps with all of its velocity.
            let (is_oblique, held) = (own.is_oblique(), own.components());
            [0, 1, 2].map(|k| (is_oblique || held[k]).then_some(velocity[k]))
        };
        Ok(nodes.iter().zip(velocities).map(of).collect())
    }

    /// Masses and velocities.
    fn nodes(&self, new: space::Mesh<'_>, held: &[[Option<f64>; 3]]) -> Result<space::Nodes, String> {
        let (present, system) = (self.present, self.system);
        let old = space::OldNodes {
            mesh: present.mesh(),
            cell_mass: &present.masses,
            node_mass: &present.of_nodes(&system.mass),
            velocities: &present.of_nodes(&system.velocities),
            spare: 0.0,
        };
        space::nodes(&old, &space::NewNodes { mesh: new, held }).map_err(|failure| failure.to_string())
    }

    /// Stresses by volume, and what the law remembers by mass, of each group of the part's elements in the
    /// new mesh, `new`, which have these masses.
    fn points(&self, new: space::Mesh<'_>, mesh: &Mesh<3>, masses: &[f64]) -> Result<Vec<PointValues>, String> {
        let (system, present) = (self.system, self.present);
        let own = system.mesh.groups.iter().zip(&system.blocks).filter(|(group, _)| group.part == self.part);
        let olds: Option<Vec<PointValues>> = own.map(|(_, block)| block.point_values(&system.positions)).collect();
        let olds = olds.ok_or("its law can't continue with means")?;
        let first = olds.first().ok_or("it has no elements")?;
        let all = PointValues { values: olds.iter().flat_map(|own| own.values.iter().copied()).collect(), ..first.clone() };
        let (part, width) = (&self.model.parts[self.part], first.width);
        // Of each new group its elements, and the points of one.
        let group = |group: &ElementGroup| Some((group.elements(), points_of::<3>(part.element_in(3, group.kind)?.name)?));
        let groups: Option<Vec<(usize, usize)>> = mesh.groups_of(self.part).map(group).collect();
        let groups = groups.ok_or("the points of its elements are not known")?;
        let rule_of_old = rule(&present.cells, all.values.len() / width.max(1))?;
        let rule_of_new = rule(new.cells, groups.iter().map(|(count, points)| count * points).sum())?;
        let (old, target) = (space::Points { mesh: present.mesh(), rule: rule_of_old }, space::Points { mesh: new, rule: rule_of_new });
        let map = space::PointMap::new(&old, &target).map_err(|failure| failure.to_string())?;
        let densities: Vec<f64> = present.masses.iter().zip(&present.volumes).map(|(mass, volume)| mass / volume).collect();
        let values = carried(&all, &densities, |own| map.values(own))?;
        let (mut values, mut masses) = (&values[..], masses);
        let mut of_group = |(count, points): (usize, usize)| {
            let (own, rest) = values.split_at(count * points * width);
            let (mass, more) = masses.split_at(count);
            (values, masses) = (rest, more);
            PointValues { points, values: own.to_vec(), masses: mass.to_vec(), ..*first }
        };
        Ok(groups.into_iter().map(&mut of_group).collect())
    }
}

/// How many points each of some cells has, of so many in all.
fn rule(cells: &[Cell], points: usize) -> Result<Rule, String> {
    let fits = |rule: &Rule| cells.iter().map(|cell| space::Points::of(*rule, cell.kind())).sum::<usize>() == points;
    [Rule::Full, Rule::One].into_iter().find(fits).ok_or_else(|| "it has elements of one point beside others of several".into())
}

/// The mean of some values of nodes with their shares.
fn mean(shares: &[(u32, f64)], of: &[Point]) -> Point {
    shares.iter().fold([0.0; 3], |sum, &(node, share)| plus(sum, times(share, of[node as usize])))
}
