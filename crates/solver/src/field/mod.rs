//! Output fields: each with the function of its values, and the registry that everything else iterates over.
//!
//! A field of nodes is a function of a system as it is shown ([`LiveSnapshot`]) and a node, one of cells a
//! function of the mean state of an element ([`Cell`]). History variables that laws and equations of state
//! declare are fields without a further entry. To add a field: one file, one line in `fields!`. Writers see a
//! field as the [`FieldKind`] of a dimension.

use crate::block::ElementState;
use crate::dimension::Dimension;
use crate::field::snapshot::LiveSnapshot;
use crate::material::Variable;
use crate::mesh::kinematics::Kinematics;
use crate::rotation::unit_matrix;
use crate::tensor::Dim;
use kind::{FieldKind, Location, Needs};

pub(crate) mod kind;
pub(crate) mod snapshot;

pub(crate) use erosion::ALIVE;
pub(crate) use stress::VON_MISES;

/// Writes the values of a field at a node of a system.
#[derive(Clone, Copy, Debug)]
pub struct OfNode<const D: usize>(pub(crate) fn(&LiveSnapshot<'_, D>, usize, &mut [f64]))
where
    Dim<D>: Dimension<D>;

/// The function of a field of nodes by dimension.
pub trait NodeFields<const D: usize>: Dimension<D> {
    /// That of the dimension, from those of 2D and 3D.
    fn of_node(plane: OfNode<2>, space: OfNode<3>) -> OfNode<D>
    where
        Dim<D>: Dimension<D>;
}

impl NodeFields<2> for Dim<2> {
    fn of_node(plane: OfNode<2>, _space: OfNode<3>) -> OfNode<2> {
        plane
    }
}

impl NodeFields<3> for Dim<3> {
    fn of_node(_plane: OfNode<2>, space: OfNode<3>) -> OfNode<3> {
        space
    }
}

/// An element as fields of cells see it.
pub(crate) struct Cell<'a> {
    /// Its mean state; of an eroded element that at failure.
    pub(crate) state: &'a ElementState,
    /// Whether it has not been eroded.
    pub(crate) is_alive: bool,
    /// Its group and its number in that.
    pub(crate) place: (usize, usize),
    /// What knows how it moves.
    pub(crate) within: &'a dyn Moving,
}

impl Cell<'_> {
    /// How it has deformed; undeformed where its nodes don't say.
    pub(crate) fn kinematics(&self) -> Kinematics {
        let at_rest = Kinematics { gradient: unit_matrix(), rate: [[0.0; 3]; 3] };
        self.within.kinematics(self.place, self.state).unwrap_or(at_rest)
    }
}

/// A system whose elements move.
pub(crate) trait Moving {
    /// How an element in a state has deformed.
    fn kinematics(&self, place: (usize, usize), state: &ElementState) -> Option<Kinematics>;
    /// See [`shape_quality`](crate::mesh::geometry::CellGeometry::shape_quality).
    fn quality(&self, place: (usize, usize)) -> f64;
    /// Longest stable step of an element, s; 0: it limits none.
    fn stable_step(&self, place: (usize, usize)) -> f64;
}

/// Gives the values of a field at a cell.
#[derive(Clone, Copy, Debug)]
pub(crate) enum OfCell {
    /// A function that writes them.
    Function(fn(&Cell<'_>, &mut [f64])),
    /// A history variable of the element's law, 0 where it has none such.
    History(&'static Variable),
}

impl OfCell {
    /// Writes the values at a cell, with the place of a history variable in the law of its block.
    pub(crate) fn write(self, cell: &Cell<'_>, index: Option<usize>, values: &mut [f64]) {
        match self {
            Self::Function(of_cell) => of_cell(cell, values),
            Self::History(_) => values[0] = index.map_or(0.0, |index| cell.state.variables[index]),
        }
    }

    /// The variable whose place in the law it needs.
    pub(crate) fn variable(self) -> Option<&'static Variable> {
        if let Self::History(variable) = self { Some(variable) } else { None }
    }
}

/// Where the values of a field come from.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Source {
    /// From nodes of a dimension, 2D and 3D.
    Nodes(OfNode<2>, OfNode<3>),
    /// From the states of elements.
    Cells(OfCell),
}

/// The source of a field of nodes: a function that is generic over the dimension.
macro_rules! of_nodes {
    ($function:ident) => {
        $crate::field::Source::Nodes($crate::field::OfNode($function::<2>), $crate::field::OfNode($function::<3>))
    };
}

/// The source of a field of cells.
pub(crate) const fn of_cells(function: fn(&Cell<'_>, &mut [f64])) -> Source {
    Source::Cells(OfCell::Function(function))
}

/// What the values of a node or cell are.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Components {
    /// A number.
    Scalar,
    /// A vector: x y (z).
    Vector,
    /// A stress: xx yy zz xy (yz zx).
    Stress,
    /// Of a section of a shell: 11 22 (12).
    Section,
    /// Across a section of a shell: a number (in 3D 1 2).
    Across,
    /// Three numbers: of a cross-section of a beam along it, y, z.
    Profile,
    /// A vector of 3D models and of what stands out of the plane: x y z.
    Direction,
    /// A gradient of a vector: xx xy yx yy (nine).
    Gradient,
}

impl Components {
    /// Their names in a dimension.
    const fn names(self, dimension: usize) -> &'static [&'static str] {
        match (self, dimension) {
            (Self::Scalar, _) | (Self::Across, ..=2) => &[],
            (Self::Across, _) => &["1", "2"],
            (Self::Direction, _) | (Self::Vector, 3) => &["x", "y", "z"],
            (Self::Gradient, 3) => &["xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"],
            (Self::Gradient, _) => &["xx", "xy", "yx", "yy"],
            (Self::Vector, _) => &["x", "y"],
            (Self::Profile, _) => &["1", "2", "3"],
            (Self::Section, 3) => &["11", "22", "12"],
            (Self::Section, _) => &["11", "22"],
            (Self::Stress, 3) => &["xx", "yy", "zz", "xy", "yz", "zx"],
            (Self::Stress, _) => &["xx", "yy", "zz", "xy"],
        }
    }
}

/// A field for all dimensions, as its file declares it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Description {
    /// Name in files.
    pub(crate) name: &'static str,
    components: Components,
    /// SI unit in 2D and in 3D.
    units: [&'static str; 2],
    needs: Needs,
    doc: &'static str,
    source: Source,
}

impl Description {
    /// A field that every model has: name, SI unit (empty for a pure number), one line of explanation.
    pub(crate) const fn new(name: &'static str, components: Components, unit: &'static str, doc: &'static str, source: Source) -> Self {
        Self { name, components, units: [unit; 2], needs: Needs::Nothing, doc, source }
    }

    /// The same for models that have something; others leave it out unless it is asked for.
    pub(crate) const fn needs(self, needs: Needs) -> Self {
        Self { needs, ..self }
    }

    /// The same with another unit in 3D.
    pub(crate) const fn in_3d(self, unit: &'static str) -> Self {
        Self { units: [self.units[0], unit], ..self }
    }

    /// The field of a history variable.
    pub(crate) fn of(variable: &'static Variable) -> Self {
        let &Variable { name, unit, doc } = variable;
        Self::new(name, Components::Scalar, unit, doc, Source::Cells(OfCell::History(variable))).needs(Needs::History(variable))
    }

    /// The field in a dimension.
    fn kind(&self, dimension: usize) -> FieldKind {
        let &Self { name, components, units, needs, doc, source } = self;
        let location = if matches!(source, Source::Nodes(..)) { Location::Node } else { Location::Cell };
        let unit = units[usize::from(dimension == 3)];
        FieldKind { name, location, components: components.names(dimension), unit, needs, doc, source }
    }
}

/// The registry: one line per file, whose function `fields` gives its fields.
macro_rules! fields {
    ($($file:ident;)*) => {
        $(mod $file;)*

        /// Every field, in the order in which frames have them.
        fn descriptions() -> Vec<Description> {
            [$($file::fields()),*].concat()
        }
    };
}

fields! {
    motion;
    contact;
    stress;
    invariants;
    strain;
    laws;
    erosion;
    shells;
    through;
    beams;
    equations_of_state;
    energy;
    mesh;
}

/// Every field, of models of a dimension.
pub(crate) fn kinds(dimension: usize) -> Vec<FieldKind> {
    descriptions().iter().map(|field| field.kind(dimension)).collect()
}
