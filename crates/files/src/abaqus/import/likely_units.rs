//! In which units a deck is, as its materials say it: decks say it nowhere.

use super::Importer;
use super::material::Material;
use super::units::number;
use embate_solver::material::unit_system::{SYSTEMS, UnitSystem};

impl Material {
    /// Density and Young's modulus, as the deck has them.
    fn numbers(&self) -> Option<[f64; 2]> {
        let of_rubber = |[c10, c01, bulk]: [f64; 3]| {
            let shear = 2.0 * (c10 + c01);
            9.0 * bulk * shear / (3.0 * bulk + shear)
        };
        Some([self.density?, self.elastic.map(|[young, _]| young).or(self.rubber.map(of_rubber))?])
    }
}

impl Importer<'_> {
    /// What the materials say of the units, a line; empty where they say nothing.
    pub(super) fn likely_units(&self) -> String {
        let all: Vec<[f64; 2]> = self.materials.iter().filter_map(Material::numbers).collect();
        let Some([density, modulus]) = all.first().copied() else { return String::new() };
        let Some(system) = UnitSystem::of(&all) else {
            let fits = SYSTEMS.iter().any(|system| self.units.are(system) && all.iter().all(|it| system.is_usual(*it)));
            let text = "its materials are usual ones in no system of units that is known here, or in several: look at densities and moduli";
            return if fits { String::new() } else { format!("  {text}\n") };
        };
        if self.units.are(system) {
            return String::new();
        }
        let [in_si, modulus_in_si] = system.in_si([density, modulus]);
        format!(
            "  but its materials are those of a deck in {}: a density of {} and a modulus of {} are {in_si:.0} kg/m^3 and {modulus_in_si:.3e} Pa \
             there;\n  if so, import it with --units \"{}\"\n",
            system.units.join(", "),
            number(density),
            number(modulus),
            system.words()
        )
    }
}
