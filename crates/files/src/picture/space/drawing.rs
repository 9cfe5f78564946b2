//! Facets, their edges and bars, handed to the rasteriser: colours by field, light, thin lines that fade out
//! where the mesh is dense, firm lines at creases. A skin and its places in the picture come from `scene`;
//! nearest samples stay in [`Samples`].

use super::raster::{Corner, FINE, Paint, Samples};
use super::shade::{SMOOTH, dot, lights, normals};
use super::sides::NONE;
use super::skin::{Edge, Facet, Skin};

/// Colour of a facet.
#[derive(Clone, Copy, Debug)]
pub(super) enum Colour {
    Flat([f32; 3]),
    /// Places in the colour map at its corners.
    Levels([f32; 4]),
}

/// Thickness (pixels) and strength of lines.
#[derive(Clone, Copy, Debug)]
pub(super) struct Style {
    /// Of edges of elements.
    pub(super) edge: [f32; 2],
    /// Of creases, borders and where a body ends to the eye.
    pub(super) outline: [f32; 2],
}

/// A skin in the picture.
pub(super) struct Drawing<'a> {
    pub(super) skin: &'a Skin,
    /// Places of its nodes, samples: to the right, downwards, towards the viewer. Not a number where there is
    /// nothing.
    pub(super) points: &'a [[f32; 3]],
    /// For each node on which mirror planes it lies, a bit for each axis; empty: on none.
    pub(super) planes: &'a [u8],
    /// The axes as unit vectors of the picture: to the right, upwards, towards the viewer.
    pub(super) axes: [[f32; 3]; 3],
    /// Whether right-handed facets are outward in this image.
    pub(super) is_turned: bool,
}

/// What is known of each facet of a moment.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    normals: Vec<[f32; 3]>,
    /// Height of each facet, pixels; negative for those that are not drawn.
    heights: Vec<f32>,
}

/// Steepest facet for which a line on it is lifted in full.
const STEEP: f32 = 12.0;

impl Drawing<'_> {
    /// Draws facets, then lines.
    pub(super) fn draw(
        &self,
        samples: &mut Samples,
        room: &mut Scratch,
        map: &[[f32; 3]],
        style: Style,
        colour: impl Fn(usize, &Facet) -> Colour,
    ) {
        normals(self.skin, self.points, &mut room.normals);
        room.heights.clear();
        let halved = |corner: u32| {
            let bits = self.planes.get(corner as usize).copied().unwrap_or(0);
            [0, 1, 2].map(|axis| (bits >> axis & 1 == 1).then_some(self.axes[axis]))
        };
        for (index, facet) in self.skin.facets.iter().enumerate() {
            let height = if self.is_within(facet) { -1.0 } else { self.height(facet) };
            room.heights.push(height);
            if !(height >= 0.0) {
                continue;
            }
            let lights = lights(self.skin, &room.normals, index, &halved);
            let flat;
            let (map, levels) = match colour(index, facet) {
                Colour::Flat(colour) => {
                    flat = [colour];
                    (&flat[..], [0.0; 4])
                }
                Colour::Levels(levels) => (map, levels.map(|level| level + 0.5)),
            };
            let corner = |k: usize| Corner { place: self.points[facet.corners[k] as usize], light: lights[k], level: levels[k] };
            let line = style.edge[1] * rise(height, 2.5, 9.0);
            let line = if line > 0.02 { line } else { 0.0 };
            let half = 0.5 * style.edge[0] * FINE as f32;
            if facet.is_triangle() {
                samples.triangle([0, 1, 2].map(corner), &Paint { map, lines: [line; 3], half });
            } else {
                samples.triangle([0, 1, 2].map(corner), &Paint { map, lines: [line, line, 0.0], half });
                samples.triangle([0, 2, 3].map(corner), &Paint { map, lines: [0.0, line, line], half });
            }
        }
        for edge in &self.skin.edges {
            self.outline(samples, room, edge, style);
        }
    }

    /// Whether a facet lies on a mirror plane: within the body and its mirror image.
    fn is_within(&self, facet: &Facet) -> bool {
        let bits = |corner: &u32| self.planes.get(*corner as usize).copied().unwrap_or(0);
        facet.corners.iter().fold(u8::MAX, |all, corner| all & bits(corner)) != 0
    }

    /// Height of a facet in the picture, pixels: its area over its longest side.
    fn height(&self, facet: &Facet) -> f32 {
        let [a, b, c, d] = facet.corners.map(|corner| self.points[corner as usize]);
        let area = 0.5 * ((c[0] - a[0]) * (d[1] - b[1]) - (c[1] - a[1]) * (d[0] - b[0])).abs();
        let square = |a: [f32; 3], b: [f32; 3]| (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
        let longest = square(a, b).max(square(b, c)).max(square(c, d)).max(square(d, a)).sqrt();
        if longest > 0.0 { area / longest / FINE as f32 } else { area }
    }

    /// Draws an edge if it is a border, a crease, or the end of the body to the eye.
    fn outline(&self, samples: &mut Samples, room: &Scratch, edge: &Edge, style: Style) {
        let [a, b] = edge.facets;
        let b = if b == NONE { a } else { b };
        let (first, second) = (room.normals[a as usize], room.normals[b as usize]);
        let ends = edge.nodes.map(|node| self.points[node as usize]);
        let bits = |node: u32| self.planes.get(node as usize).copied().unwrap_or(0);
        if bits(edge.nodes[0]) & bits(edge.nodes[1]) != 0 {
            return; // the body continues in its mirror image
        }
        let sign = if self.is_turned { -1.0 } else { 1.0 };
        let (front, back) = (sign * first[2] > 0.0, sign * second[2] > 0.0);
        let is_crease = dot(first, second) < SMOOTH;
        if !(edge.is_border || (front || back) && (is_crease || front != back)) {
            return;
        }
        let slope = |n: [f32; 3]| (n[0] * n[0] + n[1] * n[1]).sqrt() / n[2].abs().max(1e-3);
        let facing = |n: [f32; 3], is_front: bool| if is_front || edge.is_border { slope(n) } else { 0.0 };
        let steep = facing(first, front).max(facing(second, back)).min(STEEP);
        let height = room.heights[a as usize].max(room.heights[b as usize]);
        let [thick, strength] = style.outline;
        let share = rise(height, 0.5, 6.0);
        let half = 0.5 * thick * FINE as f32;
        samples.line(ends, half, strength * (0.3 + 0.7 * share), (half + 1.0) * steep + 1.0);
    }
}

/// 0 below `from`, 1 above `to`.
fn rise(value: f32, from: f32, to: f32) -> f32 {
    ((value - from) / (to - from)).clamp(0.0, 1.0)
}
