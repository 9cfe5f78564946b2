//! Where things of a model are: nodes and surfaces by their names, with outward normals.

use crate::outline::{box_around, cross, unit};
use crate::picture::space::Skinner;
use embate_solver::output::{Cells, Frame};
use embate_solver::simulation::Simulation;
use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};

/// A segment or facet of the outside of the bodies.
struct Facet {
    corners: Vec<u32>,
    middle: [f64; 3],
    /// Outward unit normal.
    normal: [f64; 3],
}

/// The bodies of a model.
pub(super) struct Places<'a> {
    simulation: &'a Simulation,
    pub(super) cells: &'a Cells,
    pub(super) frame: &'a Frame,
    /// Found when a surface is first asked for: of large meshes that takes long.
    facets: OnceCell<Vec<Facet>>,
    /// Lower and upper corner of all bodies, m.
    pub(super) bounds: [[f64; 3]; 2],
}

impl<'a> Places<'a> {
    pub(super) fn new(simulation: &'a Simulation, cells: &'a Cells, frame: &'a Frame) -> Self {
        let bounds = box_around((0..frame.nodes()).map(|node| frame.place(node))).unwrap_or_default();
        Self { simulation, cells, frame, facets: OnceCell::new(), bounds }
    }

    fn facets(&self) -> &[Facet] {
        let find = || if self.frame.dimension == 3 { facets_in_3d(self.cells, self.frame) } else { segments(self.cells, self.frame) };
        self.facets.get_or_init(find)
    }

    /// Diagonal of the bodies' box, m.
    pub(super) fn size(&self) -> f64 {
        let [low, high] = self.bounds;
        (0..3).map(|d| (high[d] - low[d]).powi(2)).sum::<f64>().sqrt()
    }

    /// Nodes of a part, a side or a group; none where there is no such name.
    pub(super) fn nodes(&self, name: &str) -> Vec<u32> {
        self.simulation.nodes_of(name).unwrap_or_default()
    }

    pub(super) fn place(&self, node: u32) -> [f64; 3] {
        if (node as usize) < self.frame.nodes() { self.frame.place(node as usize) } else { [f64::NAN; 3] }
    }

    /// Places of the nodes of a part, a side or a group, m.
    pub(super) fn of_nodes(&self, name: &str) -> Vec<[f64; 3]> {
        self.nodes(name).into_iter().map(|node| self.place(node)).collect()
    }

    /// Middle (m) and outward normal of each segment or facet of a surface; of what has none its nodes,
    /// without normals.
    pub(super) fn of_surface(&self, name: &str) -> Vec<([f64; 3], [f64; 3])> {
        let nodes: BTreeSet<u32> = self.nodes(name).into_iter().collect();
        let own = self.facets().iter().filter(|facet| facet.corners.iter().all(|corner| nodes.contains(corner)));
        let facets: Vec<_> = own.map(|facet| (facet.middle, facet.normal)).collect();
        if facets.is_empty() { nodes.into_iter().map(|node| (self.place(node), [0.0; 3])).collect() } else { facets }
    }

    /// The same of the outside of all bodies.
    pub(super) fn of_outside(&self) -> Vec<([f64; 3], [f64; 3])> {
        self.facets().iter().map(|facet| (facet.middle, facet.normal)).collect()
    }

    /// Middle of an element, by its number in its part, m.
    pub(super) fn element(&self, part: &str, number: usize) -> Option<[f64; 3]> {
        let part = self.cells.part_names.iter().position(|name| name == part)? as u32;
        let cell = (0..self.cells.len()).filter(|&cell| self.cells.parts[cell] == part).nth(number)?;
        mean(self.cells.cell(cell).iter().map(|&node| self.place(node)))
    }

    /// The piece of a plane (in 2D of a line) that is as large as the bodies, as an outline.
    pub(super) fn plane(&self, point: [f64; 3], normal: [f64; 3]) -> Vec<[f64; 3]> {
        let Some(n) = unit(normal) else { return Vec::new() };
        let middle = [0, 1, 2].map(|d| 0.5 * (self.bounds[0][d] + self.bounds[1][d]));
        let height = (0..3).map(|d| (middle[d] - point[d]) * n[d]).sum::<f64>();
        let foot = [0, 1, 2].map(|d| middle[d] - height * n[d]);
        let along = |t: [f64; 3]| 0.55 * (0..3).map(|d| (self.bounds[1][d] - self.bounds[0][d]) * t[d].abs()).sum::<f64>();
        if self.frame.dimension < 3 {
            let t = [-n[1], n[0], 0.0];
            let half = along(t);
            return [-half, half].map(|by| [0, 1, 2].map(|d| foot[d] + by * t[d])).to_vec();
        }
        let axis = (0..3).min_by(|&a, &b| n[a].abs().total_cmp(&n[b].abs())).unwrap_or(0);
        let mut other = [0.0; 3];
        other[axis] = 1.0;
        let Some(t) = unit(cross(n, other)) else { return Vec::new() };
        let u = cross(n, t);
        let [a, b] = [along(t), along(u)];
        [[-a, -b], [a, -b], [a, b], [-a, b]].map(|[v, w]| [0, 1, 2].map(|d| foot[d] + v * t[d] + w * u[d])).to_vec()
    }
}

/// Mean of places; none of none.
pub(super) fn mean(places: impl Iterator<Item = [f64; 3]>) -> Option<[f64; 3]> {
    let (mut sum, mut count) = ([0.0; 3], 0.0);
    for place in places.filter(|place| place.iter().all(|x| x.is_finite())) {
        sum = [0, 1, 2].map(|d| sum[d] + place[d]);
        count += 1.0;
    }
    (count > 0.0).then(|| sum.map(|x| x / count))
}

fn facets_in_3d(cells: &Cells, frame: &Frame) -> Vec<Facet> {
    let place = |node: u32| if (node as usize) < frame.nodes() { frame.place(node as usize) } else { [f64::NAN; 3] };
    let (facets, _) = Skinner::new(cells, &place).seen(cells, &[]);
    let of = |facet: crate::picture::space::Facet| {
        let [a, b, c, d] = facet.corners.map(place);
        let minus = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|k| a[k] - b[k]);
        let mut corners = facet.corners.to_vec();
        corners.dedup();
        let normal = unit(cross(minus(c, a), minus(d, b))).or_else(|| unit(cross(minus(b, a), minus(c, a))))?;
        Some(Facet { middle: mean(corners.iter().map(|&node| place(node)))?, corners, normal })
    };
    facets.into_iter().filter_map(of).collect()
}

/// Edges that belong to one cell alone: cells run counter-clockwise, so their outside is on the right.
fn segments(cells: &Cells, frame: &Frame) -> Vec<Facet> {
    let mut edges: BTreeMap<[u32; 2], Option<[u32; 2]>> = BTreeMap::new();
    for cell in 0..cells.len() {
        let kind = cells.kinds[cell];
        if kind.dimension() != 2 {
            continue;
        }
        for [a, b] in kind.cell(cells.cell(cell)).pieces_of_edges() {
            edges.entry([a.min(b), a.max(b)]).and_modify(|edge| *edge = None).or_insert(Some([a, b]));
        }
    }
    let of = |[a, b]: [u32; 2]| {
        let [from, to] = [a, b].map(|node| frame.place(node as usize));
        let normal = unit([to[1] - from[1], from[0] - to[0], 0.0])?;
        Some(Facet { corners: vec![a, b], middle: [0, 1, 2].map(|d| 0.5 * (from[d] + to[d])), normal })
    };
    edges.into_values().flatten().filter_map(of).collect()
}
