//! What the user should know of a sound model: laws that soften, elements that lock, elements that do not
//! hold a fluid.
//!
//! Only what is certain before a run: a warning that is wrong once is read no more. What needs the mesh is
//! reported by `build/idle.rs`.

use super::plausible;
use crate::contact::messages::OPEN;
use crate::element::{Element, Quad4, Quad4Full};
use crate::error::Warning;
use crate::load::messages::FALLING;
use crate::material::messages::{FLUID, LOCKING, SOFTENING};
use crate::material::{self, Law, Null, Parameters};
use crate::mesh::messages::{NOT_ON_SHELLS, REDUCED};
use crate::model::{Load, Material, Model, ObstacleShape, Part, Shape, TriangleSurface};
use crate::stress_state::PLANE_STRESS;
use crate::vector::{length, place};

/// From this Poisson's ratio on elements without averaged dilatation are too stiff for any use: K is fifty
/// times µ.
const LOCKS: f64 = 0.49;

impl Model {
    /// What the user should know of a model without faults ([`Model::check`]), as far as it can be reported
    /// without meshing; each thing once.
    #[must_use]
    pub fn warnings(&self) -> Vec<Warning> {
        let mut warnings = plausible::warnings(self);
        warnings.extend(plausible::speeds(self));
        warnings.extend(plausible::frictions(self));
        warnings.extend(self.falling());
        for (name, it) in &self.materials {
            warnings.extend(self.softening(name, it));
        }
        for (index, part) in self.parts.iter().enumerate().filter(|(_, part)| part.rigid.is_none()) {
            let Some(it) = self.materials.get(&part.material) else { continue };
            warnings.extend(self.locking(index, part, it));
            warnings.extend(self.fluid(index, part, it));
        }
        warnings.extend(self.not_on_shells());
        warnings.extend(self.reduced());
        for (index, obstacle) in self.obstacles.iter().enumerate() {
            if let ObstacleShape::Triangles(surface) = &obstacle.shape {
                warnings.extend(open(index, surface));
            }
        }
        warnings
    }

    /// Gravity alone on bodies at rest that nothing holds.
    fn falling(&self) -> Option<Warning> {
        // One that follows a curve is a field that is driven.
        let only_gravity = self.loads.iter().all(|load| matches!(load, Load::Gravity { curve: None, .. }));
        let is_held = !(self.constraints.is_empty() && self.obstacles.is_empty() && self.symmetries.is_empty() && self.springs.is_empty())
            || self.joints.iter().any(|joint| joint.between.len() == 1);
        let acts = |part: &Part| {
            let moves = part.velocity != [0.0; 3] || part.spin != 0.0 || part.radial_velocity.is_some();
            moves || part.rigid.is_some() || part.stress_initial.is_some() || part.temperature_initial.is_some()
        };
        let has_pressure = !self.cavities.is_empty() || self.materials.values().any(|it| !it.eos.is_empty());
        if is_held || !only_gravity || has_pressure || self.parts.iter().any(acts) {
            return None;
        }
        let Some((index, Load::Gravity { acceleration, .. })) = self.loads.iter().enumerate().next() else { return None };
        Some(Warning {
            kind: &FALLING,
            path: format!("load[{index}].gravity"),
            message: "gravity pulls, and nothing holds: there is no constraint, obstacle, symmetry or spring".into(),
            consequence: format!(
                "all bodies fall freely, by {:.3e} m until the end, and nothing is strained",
                0.5 * length(*acceleration) * self.run.end * self.run.end
            ),
            help: "hold them by a [[constraint]], or let them lie on an [[obstacle]]".into(),
        })
    }

    /// What became of cells of mesh files that are not computed as they are.
    fn reduced(&self) -> Vec<Warning> {
        let of_part = |(index, part): (usize, &Part)| {
            let Shape::Group { mesh, .. } = &part.shape else { return None };
            // Each file once.
            let is_first = self.parts[..index].iter().all(|other| !matches!(&other.shape, Shape::Group { mesh: own, .. } if own == mesh));
            let imported = self.meshes.get(*mesh).filter(|imported| is_first && !imported.notes.is_empty())?;
            Some(Warning {
                kind: &REDUCED,
                path: format!("part[{index}].mesh"),
                message: format!("{}: {}", imported.source, imported.notes.join("; ")),
                consequence: "nodes between corners are left out, and curved edges become straight".into(),
                help: "nothing is to be done if that is meant; else mesh with elements of first order, or with tetrahedra of ten nodes"
                    .into(),
            })
        };
        self.parts.iter().enumerate().filter_map(of_part).collect()
    }

    /// Settings of the run that do not act on shells and beams.
    fn not_on_shells(&self) -> Vec<Warning> {
        let deformable = || self.parts.iter().filter(|part| part.rigid.is_none());
        let Some(first) = deformable().find(|part| part.has_rotations()) else { return Vec::new() };
        let rest = if deformable().all(Part::has_rotations) { "it does nothing" } else { "it acts on the other parts alone" };
        let run = &self.run;
        let settings = [
            (run.subcycling, "subcycling", "are evaluated in every step"),
            (run.bulk_viscosity != [0.0; 2], "bulk_viscosity", "have none"),
            (run.mass_scaling.is_some_and(|scaling| scaling.in_run), "mass_scaling.in_run", "get no mass in the run"),
        ];
        let warning = |(_, key, what): (bool, &str, &str)| Warning {
            kind: &NOT_ON_SHELLS,
            path: format!("run.{key}"),
            message: format!("`{key}` does not act on shells and beams, such as part `{}`: they {what}", first.name),
            consequence: rest.into(),
            help: "leave it out, if it is not meant for other parts".into(),
        };
        settings.into_iter().filter(|setting| setting.0).map(warning).collect()
    }

    /// A material whose flow stress falls, if a part is made of it.
    fn softening(&self, name: &str, it: &Material) -> Option<Warning> {
        let softening = material::softening(&it.law, &parameters(it)?)?;
        self.parts.iter().find(|part| part.material == name && part.rigid.is_none())?;
        let gone = softening.gone_at.map_or(String::new(), |at| format!("; nothing is left of it at a plastic strain of {at:.4}"));
        Some(Warning { kind: &SOFTENING,
            path: format!("material.{name}.{}", softening.name),
            message: format!("the flow stress falls by up to {:.4e} Pa per plastic strain{gone}", -softening.slope),
            consequence: "the equations lose ellipticity where it falls: strain gathers in one row of elements, so that forces and energies after the peak depend on \
                          the size and direction of the elements"
                .into(),
            help: "fit the fall to the size of the elements, so that stress times plastic strain times that size is the energy of a crack; or let the flow stress stay \
                   at its peak and elements fail by `failure`"
                .into(),
        })
    }

    /// Nearly no change of volume in elements that need one in bending and shear.
    fn locking(&self, index: usize, part: &Part, it: &Material) -> Option<Warning> {
        let element = Quad4Full::KIND.name;
        if !self.has_elements(part, element) {
            return None;
        }
        // An equation of state has a bulk modulus of its own.
        if part.stress_state == PLANE_STRESS.name || !it.eos.is_empty() || material::bears_uniaxial_stress(&it.law) != Some(true) {
            return None;
        }
        let [bulk, shear] = material::stiffness(&it.law, &parameters(it)?)?;
        let poisson = (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear));
        (poisson > LOCKS).then(|| Warning {
            kind: &LOCKING,
            path: format!("part[{index}].material"),
            message: format!("Poisson's ratio of `{}` is {poisson:.4}, in elements `{element}`", part.material),
            consequence: "they lock: bending and shear of the part are several times too stiff, also with many elements".into(),
            help: "take `element = \"quad4\"`".into(),
        })
    }

    /// A fluid without viscosity in elements whose shape only shear stresses hold; a single row that flows
    /// along itself needs no such.
    fn fluid(&self, index: usize, part: &Part, it: &Material) -> Option<Warning> {
        let element = [Quad4::KIND.name, Quad4Full::KIND.name].into_iter().find(|name| self.has_elements(part, name))?;
        let is_row = matches!(&part.shape, Shape::Rectangle(rectangle) if rectangle.elements.contains(&1));
        let is_thin = it.law == Null::KIND.name && parameters(it)?.value("viscosity") == 0.0;
        (is_thin && !is_row).then(|| Warning { kind: &FLUID,
            path: format!("part[{index}].material"),
            message: format!("`{}` is a fluid without viscosity, in elements `{element}`", part.material),
            consequence: "its pressure is one for the whole element and holds none of the shapes that keep the volume: where it does not flow along the lines of the \
                          mesh, elements fold and end the run"
                .into(),
            help: "take `element = \"quad4_reduced\"`, whose hourglass control holds them, or give the fluid a `viscosity`".into(),
        })
    }

    /// Whether some elements of a part are of this kind.
    fn has_elements(&self, part: &Part, name: &str) -> bool {
        if part.is_of_sheets() {
            return false;
        }
        let is = |cell| part.element_in(2, cell).is_some_and(|kind| kind.name == name);
        match &part.shape {
            Shape::Group { mesh, group } => {
                let groups = self.meshes.get(*mesh).map_or(&[][..], |imported| &imported.groups);
                let own = groups.iter().find(|it| it.name == *group && it.dimension == self.cells_dimension(part));
                own.is_some_and(|it| it.elements().flatten().any(|cell| is(cell.kind)))
            }
            _ => part.cell_kind().is_some_and(is),
        }
    }
}

/// A surface with a rim.
fn open(index: usize, surface: &TriangleSurface) -> Option<Warning> {
    let (count, first) = surface.open_edges()?;
    let [a, b] = first.map(place);
    let edges = if count == 1 { "1 edge belongs".to_string() } else { format!("{count} edges belong") };
    Some(Warning {
        kind: &OPEN,
        path: format!("obstacle[{index}].stl.file"),
        message: format!("{}: {edges} to one triangle alone, the first from {a} to {b} m", surface.source),
        consequence: "bodies meet its triangles from the front; who passes beside its rim comes behind it unseen".into(),
        help: "nothing is to be done if it is meant as a sheet that bodies do not leave; else close it in the program that made it".into(),
    })
}

/// The parameters of a material; `None` when there is no such law.
pub(super) fn parameters(it: &Material) -> Option<Parameters<'_>> {
    let kind = material::LAWS.iter().find(|kind| kind.name == it.law)?;
    Some(Parameters::new(kind.parameters, &it.parameters, &it.lists))
}
