//! Ends of faces: who is held beyond them, and who is not let in there.
//!
//! A face ends where its surface is cut off or continues around a sharp edge. Bodies that end flush are off
//! by round-off or by what the one is wider, so a face holds nodes a little beyond its end
//! ([`Target::beyond`]); a body that slides down beside another must not be caught there. What distinguishes
//! them is the slave's own surface: it has to go back over the face. The exact rules of crossing and level
//! know nothing of this.

use super::super::Sweep;
use super::super::length;
use super::super::projection::node_segment::{BAND, Projection, Seen, Target, Vector, fall_off};
use crate::archive::{Archive, ArchiveResult, Persist};
use crate::mesh::surface::{NONE, Surface};

/// Two segments face each other if the cosine of the angle between the one and the turned other is at least
/// this.
const FACING: f64 = 0.5;
/// Nearer than this fraction of the length to the end of a face, it is round-off on which side of the end a
/// node is.
const AT_END: f64 = 1e-6;

/// What a pass knows of ends, beyond the surfaces.
#[derive(Default)]
pub(super) struct Ends {
    /// Segments of the slaves' surface that end and begin at each slave node.
    pub(super) around: Vec<[u32; 2]>,
    /// Longest initial length of these, m.
    sizes: Vec<f64>,
    /// Initial length of each segment of the target, m; empty where nothing is held beyond ends.
    lengths: Vec<f64>,
    /// Segments of the target with a free end, or beside one, as of the last search.
    near: Vec<bool>,
}

/// Segments that end and begin at each node of a surface; [`NONE`] where there is none.
fn around(surface: &Surface<2>) -> Vec<[u32; 2]> {
    let mut around = vec![[NONE; 2]; surface.nodes.len()];
    for (segment, nodes) in (0..).zip(&surface.segments) {
        for (end, node) in nodes.iter().enumerate() {
            if let Ok(at) = surface.nodes.binary_search(node) {
                around[at][1 - end] = segment;
            }
        }
    }
    around
}

impl Persist for Ends {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { around: _, sizes: _, lengths, near } = self;
        near.persist(archive)?;
        archive.check(near.is_empty() || near.len() == lengths.len(), "ends of faces are not those of the surface")
    }
}

impl Ends {
    pub(super) fn new(slaves: &Target, target: &Target, positions: &[Vector]) -> Self {
        let around = around(&slaves.surface);
        let long = |segment: u32| slaves.surface.segments.get(segment as usize).map_or(0.0, |&segment| length(segment, positions));
        let sizes = around.iter().map(|&[a, b]| long(a).max(long(b))).collect();
        let lengths = target.surface.segments.iter().map(|&segment| length(segment, positions)).collect();
        Self { around, sizes, lengths, near: Vec::new() }
    }

    /// Finds the free ends again.
    pub(super) fn find(&mut self, target: &Target, positions: &[Vector]) {
        if self.lengths.is_empty() {
            return;
        }
        self.near.clear();
        self.near.resize(self.lengths.len(), false);
        let Surface::<2> { previous, next, .. } = &target.surface;
        let after = |segment: u32| next.get(segment as usize).copied().unwrap_or(NONE);
        for (segment, (&before, &follower)) in (0..).zip(previous.iter().zip(next)) {
            // An end between two segments is looked at once.
            let ends = target.is_free(segment, 1, positions) || (before == NONE && target.is_free(segment, 0, positions));
            if ends {
                for near in [before, segment, follower, after(follower)] {
                    if let Some(near) = self.near.get_mut(near as usize) {
                        *near = true;
                    }
                }
            }
        }
    }

    /// How far a face continues for a slave beyond a free end of `segment`, m; 0: not at all.
    pub(super) fn band(&self, slave: u32, segment: u32) -> f64 {
        self.lengths.get(segment as usize).map_or(0.0, |&length| BAND * length.min(self.sizes[slave as usize]))
    }

    /// Whether a node is over the end of a segment, or beyond it where the face still goes straight on.
    pub(super) fn is_over_end(&self, slave: u32, segment: u32, seen: &Seen) -> bool {
        (-AT_END * seen.length..=(0.5 * self.band(slave, segment)).max(AT_END * seen.length)).contains(&seen.beyond())
    }

    /// Slope with which a face falls off at a projection for a slave: 0 on the face and near its end.
    pub(super) fn slope(&self, slave: u32, projection: &Projection, target: &Target, positions: &[Vector]) -> f64 {
        let beyond = -projection.weights[0].min(projection.weights[1]);
        if beyond <= AT_END || self.lengths.is_empty() {
            return 0.0;
        }
        let length = length(target.surface.segments[projection.segment as usize], positions);
        fall_off(beyond * length, self.band(slave, projection.segment))[1]
    }

    /// Whether a segment is at a free end, or beside one.
    pub(super) fn is_near(&self, segment: u32) -> bool {
        self.near.get(segment as usize).copied().unwrap_or(false)
    }

    /// Whether the slave's own surface goes from it back over the face that ends at `end` (0 or 1) of
    /// `segment`.
    pub(super) fn overlaps(
        &self,
        slaves: &Surface<2>,
        target: &Target,
        (slave, segment, end): (u32, u32, usize),
        positions: &[Vector],
    ) -> bool {
        let node = slaves.nodes[slave as usize];
        let of = |[a, b]: [u32; 2]| {
            let [a, b] = [a, b].map(|node| positions[node as usize]);
            [b[0] - a[0], b[1] - a[1]]
        };
        let along = of(target.surface.segments[segment as usize]);
        self.around[slave as usize].iter().filter_map(|&own| slaves.segments.get(own as usize)).any(|&own| {
            let other = if own[0] == node { own[1] } else { own[0] };
            let Some(seen) = target.seen(positions[other as usize], segment, positions) else { return false };
            let goes_back = if end == 0 { seen.place > AT_END } else { seen.place < 1.0 - AT_END };
            goes_back && is_facing(of(own), along)
        })
    }

    /// Whether a node may be in contact through the face that `projection` is on, as far as the end of it is
    /// concerned: within round-off of the end only who goes back over it.
    pub(super) fn admit(&self, slaves: &Surface<2>, target: &Target, slave: u32, projection: &Projection, positions: &[Vector]) -> bool {
        let place = projection.weights[1];
        let end = usize::from(place > 0.5);
        let at_end = !(AT_END..=1.0 - AT_END).contains(&place);
        !at_end
            || self.lengths.is_empty()
            || !target.is_free(projection.segment, end, positions)
            || self.overlaps(slaves, target, (slave, projection.segment, end), positions)
    }

    /// Whether a node that is beyond a free end comes upon the face there: from the front, where the face
    /// goes straight on. (One that comes from the side would run into the slope, which is steep for a motion
    /// along the face; who is beside a body has nothing to do with its top.)
    pub(super) fn comes_over(
        target: &Target,
        beyond: &Projection,
        band: f64,
        [x_old, x]: [Vector; 2],
        hold: f64,
        sweep: Sweep<'_, 2>,
    ) -> bool {
        let (Some(old), Some(new)) = (target.seen(x_old, beyond.segment, sweep.old), target.seen(x, beyond.segment, sweep.new)) else {
            return false;
        };
        let straight = |beyond: f64| fall_off(beyond, band)[1] == 0.0;
        let time = if new.gap >= -hold { 1.0 } else { (old.gap / (old.gap - new.gap)).clamp(0.0, 1.0) };
        let in_front = new.gap >= -hold || old.gap >= -hold;
        in_front && straight(new.beyond()) && straight(old.beyond() + time * (new.beyond() - old.beyond()))
    }
}

/// Whether segments along `a` and `b` face each other, bodies on their right: within 60 degrees.
#[must_use]
pub fn is_facing(a: Vector, b: Vector) -> bool {
    let dot = |a: Vector, b: Vector| a[0] * b[0] + a[1] * b[1];
    -dot(a, b) >= FACING * (dot(a, a) * dot(b, b)).sqrt()
}
