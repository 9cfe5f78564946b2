//! Which cell of a plane mesh a place is in.

use embate_remesh::plane::{Mesh, Point, corners, cross, minus};

/// Where the material at a place is: old nodes with their shares, which add up to one.
#[derive(Clone, Debug)]
pub(super) struct Located {
    pub(super) shares: Vec<(u32, f64)>,
    pub(super) is_on_outline: bool,
}

/// Cells by the squares of a grid that their boxes touch.
pub(super) struct Grid<'a> {
    mesh: Mesh<'a>,
    low: Point,
    square: f64,
    count: [usize; 2],
    cells: Vec<Vec<u32>>,
}

impl<'a> Grid<'a> {
    pub(super) fn new(mesh: Mesh<'a>) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for x in mesh.positions {
            for d in 0..2 {
                low[d] = low[d].min(x[d]);
                high[d] = high[d].max(x[d]);
            }
        }
        let area = (high[0] - low[0]) * (high[1] - low[1]);
        let square = (area / mesh.cells.len().max(1) as f64).sqrt().max(1e-6 * (high[0] - low[0]).max(high[1] - low[1]));
        let count = [0, 1].map(|d| ((high[d] - low[d]) / square) as usize + 1);
        let mut grid = Self { mesh, low, square, count, cells: vec![Vec::new(); count[0] * count[1]] };
        for (number, cell) in (0..).zip(mesh.cells) {
            let places = || corners(cell).iter().map(|&node| mesh.positions[node as usize]);
            let ends = [f64::min, f64::max].map(|of| [0, 1].map(|d| places().map(|x| x[d]).reduce(of).unwrap_or(low[d])));
            let [from, to] = ends.map(|end| grid.square_of(end));
            for i in from[0]..=to[0] {
                for j in from[1]..=to[1] {
                    grid.cells[i * count[1] + j].push(number);
                }
            }
        }
        grid
    }

    fn square_of(&self, x: Point) -> [usize; 2] {
        [0, 1].map(|d| (((x[d] - self.low[d]) / self.square).max(0.0) as usize).min(self.count[d] - 1))
    }

    /// The triangle that a place is in, or is nearest to be in.
    pub(super) fn locate(&self, x: Point) -> Option<Located> {
        let [i, j] = self.square_of(x);
        let best = |cells: &[u32]| {
            let mut best: Option<(f64, Vec<(u32, f64)>)> = None;
            for (least, shares) in cells.iter().flat_map(|&cell| self.triangles(cell, x)) {
                if best.as_ref().is_none_or(|(most, _)| least > *most) {
                    best = Some((least, shares));
                }
            }
            best
        };
        let near = best(&self.cells[i * self.count[1] + j]).filter(|(least, _)| *least > -1e-9);
        let all: Vec<u32> = if near.is_some() { Vec::new() } else { (0..self.mesh.cells.len() as u32).collect() };
        let (_, shares) = near.or_else(|| best(&all))?;
        Some(Located { shares, is_on_outline: false })
    }

    /// Shares of the corners of the triangles of a cell in a place, and the least of them.
    fn triangles(&self, cell: u32, x: Point) -> Vec<(f64, Vec<(u32, f64)>)> {
        let nodes = corners(&self.mesh.cells[cell as usize]);
        let place = |node: u32| self.mesh.positions[node as usize];
        let of = |pair: &[u32]| {
            let own = [nodes[0], pair[0], pair[1]];
            let [a, b, c] = own.map(place);
            let area = cross(minus(b, a), minus(c, a));
            let shares =
                [cross(minus(b, x), minus(c, x)) / area, cross(minus(c, x), minus(a, x)) / area, cross(minus(a, x), minus(b, x)) / area];
            let least = shares[0].min(shares[1]).min(shares[2]);
            (area > 0.0).then(|| (least, own.into_iter().zip(shares).collect()))
        };
        nodes[1..].windows(2).filter_map(of).collect()
    }
}
