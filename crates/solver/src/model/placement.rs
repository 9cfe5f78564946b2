//! Where the body of a built-in shape goes: mirrored, turned, moved, copied. The mesh builder does it.

/// Where the body of a built-in shape goes: it is mirrored, then turned, then moved, then copied.
#[derive(Clone, Debug, PartialEq)]
pub struct Placement {
    /// A line, in 3D a plane, that it is mirrored on.
    pub mirror: Option<Mirror>,
    /// Angle by which it is turned, rad, counter-clockwise (in 3D by the right-hand rule about the axis).
    pub rotation: f64,
    /// Point about which it is turned, in 3D one of the axis, m.
    pub rotation_point: [f64; 3],
    /// Direction of the axis about which it is turned, of any length but zero; z in 2D.
    pub rotation_axis: [f64; 3],
    /// How far it is moved, m.
    pub translation: [f64; 3],
    /// How often it is there.
    pub copies: Option<Copies>,
}

/// The direction that turns in 2D are about.
pub(crate) const ALONG_Z: [f64; 3] = [0.0, 0.0, 1.0];

impl Default for Placement {
    fn default() -> Self {
        Self { mirror: None, rotation: 0.0, rotation_point: [0.0; 3], rotation_axis: ALONG_Z, translation: [0.0; 3], copies: None }
    }
}

/// A line, in 3D a plane, to mirror on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mirror {
    /// A point of it, m.
    pub point: [f64; 3],
    /// Its normal, of any length but zero.
    pub normal: [f64; 3],
}

/// Bodies of one part that follow each other: each is turned and then moved as often as there are others
/// before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Copies {
    /// How many bodies there are in all.
    pub count: usize,
    /// How far each is moved from the one before, m.
    pub translation: [f64; 3],
    /// Angle by which each is turned from the one before, rad, counter-clockwise (in 3D by the right-hand
    /// rule about the axis).
    pub angle: f64,
    /// Point about which they are turned, in 3D one of the axis, m.
    pub point: [f64; 3],
    /// Direction of the axis about which they are turned, of any length but zero; z in 2D.
    pub axis: [f64; 3],
}

impl Default for Copies {
    fn default() -> Self {
        Self { count: 0, translation: [0.0; 3], angle: 0.0, point: [0.0; 3], axis: ALONG_Z }
    }
}
