//! Built-in shapes: rectangle, ring, disk. Parameters come from the model; bodies go to the mesh builder.

/// The mesh of one body: nodes, counter-clockwise quadrilaterals, and named sides.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Body {
    /// Node positions, m.
    pub positions: Vec<[f64; 2]>,
    /// Quadrilaterals, counter-clockwise.
    pub quads: Vec<[u32; 4]>,
    /// Named sides as segments with the body on their right.
    pub sides: Vec<(&'static str, Vec<[u32; 2]>)>,
}
