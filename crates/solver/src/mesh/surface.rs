//! The outside of bodies: element edges that occur once, oriented with the body on their right and linked to chains.

/// No neighbour.
pub const NONE: u32 = u32::MAX;

/// An oriented surface in the plane. Segment `[a, b]` runs a → b with the body on its right.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Node pairs.
    pub segments: Vec<[u32; 2]>,
    /// Segment that ends where each segment begins, or [`NONE`].
    pub previous: Vec<u32>,
    /// Segment that begins where each segment ends, or [`NONE`].
    pub next: Vec<u32>,
    /// All nodes, ascending, each once.
    pub nodes: Vec<u32>,
}
