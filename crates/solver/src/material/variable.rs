//! History variables that users see: each is data of the laws that declare it, and becomes an output field.
//!
//! A variable that several laws have, or that criteria and warnings refer to, is declared here; one of a
//! single law stands in its file.

/// A scalar of the history that is output, as the mean over the points of an element.
#[derive(Clone, Copy, Debug)]
pub struct Variable {
    /// Name of its field, which is its identity: variables of the same name are the same.
    pub name: &'static str,
    /// SI unit, `K` for example; empty for a pure number.
    pub unit: &'static str,
    /// One line: what it is.
    pub doc: &'static str,
}

impl PartialEq for Variable {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self, other) || self.name == other.name
    }
}

impl Eq for Variable {}

impl Variable {
    /// This variable at a place of a law's history.
    #[must_use]
    pub const fn at(&'static self, place: usize) -> History {
        History { variable: self, place }
    }
}

/// A variable with its place in the history of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct History {
    /// Which.
    pub variable: &'static Variable,
    /// Its place among the numbers of the history, from 0.
    pub place: usize,
}

/// Equivalent plastic strain.
pub static PLASTIC_STRAIN: Variable =
    Variable { name: "plastic_strain", unit: "", doc: "equivalent plastic strain, mean over the element's points" };

/// Temperature, K.
pub static TEMPERATURE: Variable =
    Variable { name: "temperature", unit: "K", doc: "temperature, mean over the element's points; 0 where the material has none" };

/// Damage, 0 to 1.
pub static DAMAGE: Variable = Variable { name: "damage", unit: "", doc: "damage, 1 at failure, mean over the element's points" };

/// Density, kg/m³, where an equation of state keeps it.
pub static DENSITY: Variable =
    Variable { name: "density", unit: "kg/m^3", doc: "density of materials with an equation of state, 0 for others" };

/// Largest number of variables in any of these lists.
pub(super) const fn most(lists: &[&[History]]) -> usize {
    let (mut most, mut index) = (0, 0);
    while index < lists.len() {
        if lists[index].len() > most {
            most = lists[index].len();
        }
        index += 1;
    }
    most
}

/// The variables of lists, each once, in the order in which they first occur.
pub(super) fn union(lists: &[&[History]]) -> Vec<&'static Variable> {
    let mut all: Vec<&'static Variable> = Vec::new();
    for History { variable, .. } in lists.iter().copied().flatten() {
        if !all.contains(variable) {
            all.push(variable);
        }
    }
    all
}
