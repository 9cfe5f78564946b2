//! Springs, dampers and point masses, as plain data.

/// `[[spring]]`: a spring, a damper or both between each pair of nodes of two sets; in 3D without the
/// metre of depth.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spring {
    /// The two sets: each node of the larger one has its pair in the nearest node of the other.
    pub between: [String; 2],
    /// Stiffness of each spring per metre of depth, N/m/m.
    pub stiffness: f64,
    /// Damping of each per metre of depth, Pa s.
    pub damping: f64,
    /// Instead of a stiffness, a curve: elongations (m) and forces (N/m).
    pub elongation: Vec<f64>,
    /// As many forces.
    pub force: Vec<f64>,
    /// Length without force, m; `None`: that at the start.
    pub length: Option<f64>,
    /// Force at which it breaks, N/m; `None`: never.
    pub strength: Option<f64>,
}

/// `[[point_mass]]`: mass without volume on nodes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointMass {
    /// A part, a side, or a group.
    pub on: String,
    /// Mass in all, shared equally by the nodes, kg/m.
    pub mass: f64,
}
