//! What a run has to say of itself: its figures, what was checked in its contacts, and what the user should
//! know.

use super::run::Run;
use super::{ContactSearch, Runs};
use crate::contact::Contact;
use crate::contact::messages::{MISSED, NO_FORCE, TIES_BROKE, UNSOLVED};
use crate::contact::tracker::Certificate;
use crate::error::{ERODED, MASS_ADDED, Notice, OPENED, RELAXED, STEERED};
use crate::mesh::PartMesh;
use crate::output::{Eroded, Erosion, MassInRun, StageRun, Summary};
use crate::record::Momentum;
use crate::step::mass_scaling::MassScaling;
use crate::tensor::Dim;
use crate::vector::{dot, first, place};

/// What mass scaling has added in the run, and what that brought.
fn brought<const D: usize>(own: &MassScaling<D>) -> MassInRun {
    MassInRun { mass: own.added, momentum: dot(own.momentum, own.momentum).sqrt(), kinetic_energy: own.kinetic }
}

impl<const D: usize> Run<D>
where
    Dim<D>: Runs<D>,
{
    fn warnings(&self) -> Vec<Notice> {
        let mut warnings: Vec<Notice> = self.model_warnings.iter().map(Notice::from).chain(self.warnings.iter().cloned()).collect();
        warnings.extend(self.monitor.notices(&self.system));
        warnings.extend(self.remeshing_notices());
        let mut report = |kind, text: String| warnings.push(Notice::new(kind, text));
        for contact in &self.system.contacts {
            let Some(ties) = contact.ties() else { continue };
            let all = ties.held + ties.broken;
            if contact.kind.is_connection() {
                if ties.broken > 0 {
                    report(&TIES_BROKE, format!("{} \"{}\" failed", contact.kind.name(), contact.name));
                }
            } else if ties.broken > 0 {
                report(&TIES_BROKE, format!("contact \"{}\": {} of {all} ties broke", contact.name, ties.broken));
            } else if all == 0 {
                report(&TIES_BROKE, format!("contact \"{}\": its ties bound nothing", contact.name));
            }
        }
        if self.is_steered {
            report(
                &STEERED,
                "the program that drove the run changed velocities, forces or curves between its steps: the model alone doesn't repeat it"
                    .into(),
            );
        }
        if let Some(Erosion { elements, first: Eroded { part, element, at, time, criterion }, .. }) = self.erosion() {
            let all: Vec<String> = elements.iter().map(|(part, count)| format!("{count} of part \"{part}\"")).collect();
            report(
                &ERODED,
                format!(
                    "elements were eroded: {}; the first was element {element} of part \"{part}\" at {} m, at \
                        {time:.6e} s by `{criterion}`",
                    all.join(", "),
                    place::<D>(first(at))
                ),
            );
        }
        for (cavity, time) in self.system.cavities.iter().filter_map(|cavity| Some((cavity, cavity.opened()?))) {
            report(
                &OPENED,
                format!("the surface of cavity \"{}\" opened at {time:.6e} s: from then on its gas has the pressure outside", cavity.name),
            );
        }
        if let Some(relaxation) = self.system.relaxation.as_ref().filter(|_| self.system.stages.is_none()) {
            report(
                &RELAXED,
                match relaxation.rest {
                    Some(time) => format!(
                        "relaxation: at rest at {time:.6e} s, where the run ended; kinetic over internal energy {:.3e}",
                        relaxation.ratio
                    ),
                    None => format!("relaxation: not at rest; kinetic over internal energy {:.3e}", relaxation.ratio),
                },
            );
        }
        for StageRun { name, end, is_at_rest, ratio, .. } in self.system.stages_run() {
            let (Some(rests), Some(ratio)) = (is_at_rest, ratio) else { continue };
            let found = if rests { format!("at rest at {end:.6e} s") } else { format!("not at rest at {end:.6e} s") };
            report(&RELAXED, format!("stage \"{name}\": {found}; kinetic over internal energy {ratio:.3e}"));
        }
        let of_mass = self.system.mass_scaling.as_ref().map(|own| (brought(own), own));
        if let Some((brought, own)) = of_mass.filter(|(brought, own)| brought.mass > 0.0 || own.exhausted.is_some()) {
            let share = 100.0 * (self.system.mass_added[0] + brought.mass) / self.system.mass_added[1];
            let limit = own.exhausted.map_or(String::new(), |time| {
                format!("; at {time:.6e} s elements needed more than `limit` allows, and got none from then on")
            });
            report(
                &MASS_ADDED,
                format!(
                    "mass scaling added {:.6e} kg{per} in the run, with that at the start {share:.3} % of the mass of the deformable \
                        parts; it came with a momentum of {:.3e} {momentum} and a kinetic energy of {:.3e} J{per}{limit}",
                    brought.mass,
                    brought.momentum,
                    brought.kinetic_energy,
                    per = if D == 2 { "/m" } else { "" },
                    momentum = if D == 2 { "kg/s" } else { "kg m/s" },
                ),
            );
        }
        let unsolved = self.system.springs.unsolved;
        if unsolved > 0 {
            report(
                &UNSOLVED,
                format!("in {unsolved} step(s) the contact forces were not solved to the last digit: lower the contact penalties"),
            );
        }
        let unverified = self.certificate().unverified;
        if unverified > 0 {
            let (who, much) = if D == 3 { ("a node or an edge went into a body", "sixth") } else { ("a node was inside a body", "fifth") };
            let mut text = format!(
                "{unverified} time(s) {who} without being held apart, or bodies overlapped by more than a {much} of their thickness: \
                 a contact was missed or is too soft, or a body went through itself"
            );
            for contact in &self.system.contacts {
                text.extend(contact.overlaps().into_iter().flat_map(|found| self.system.overlaps_in_words(contact, found)));
            }
            report(&MISSED, text);
        }
        for contact in self.system.contacts.iter().filter(|contact| self.system.step > 0 && !contact.has_pressed) {
            report(&NO_FORCE, format!("{} \"{}\" transmitted nothing in the whole run", contact.kind.name(), contact.name));
        }
        warnings
    }

    /// What erosion has done so far.
    fn erosion(&self) -> Option<Erosion> {
        let system = &self.system;
        let erosion = system.erosion.as_ref()?;
        let first = erosion.first.clone()?;
        let of_part = |(part, &count): (&PartMesh, &usize)| (part.name.clone(), count);
        let elements = system.mesh.parts.iter().zip(&erosion.by_part).filter(|(_, count)| **count > 0).map(of_part).collect();
        Some(Erosion { elements, mass_loose: system.mass_loose(), first })
    }

    /// What was checked in all contacts so far.
    fn certificate(&self) -> Certificate {
        let mut sum = Certificate::default();
        for contact in &self.system.contacts {
            sum += contact.certificate();
        }
        sum
    }

    /// What the global search of each contact between surfaces did so far.
    pub(crate) fn searches(&self) -> Vec<ContactSearch> {
        let of = |contact: &Contact<D>| {
            let report = contact.search_report()?;
            let search = self.search_names.get(&contact.name).cloned().unwrap_or_default();
            Some(ContactSearch { contact: contact.name.clone(), search, report, pairs_swept: contact.certificate().pairs_swept })
        };
        self.system.contacts.iter().filter_map(of).collect()
    }

    /// Figures of the run so far (valid after a failure too).
    pub(crate) fn summary(&self) -> Summary {
        let system = &self.system;
        let mass_in_run = system.mass_scaling.as_ref().map(brought).filter(|brought| brought.mass > 0.0);
        // Added mass brings momentum.
        let momentum = self.momentum.as_ref().filter(|_| mass_in_run.is_none());
        Summary {
            dimension: D,
            elements: self.elements(),
            nodes: system.mesh.positions.len(),
            steps: system.step,
            time_end: system.time,
            end: system.limits.end,
            rest: self.system.rest(),
            stages: self.system.stages_run(),
            stable_time_step_min: self.shortest.time_step,
            stable_time_step_governor: self.shortest.governor.clone(),
            energy_drift: system.ledger.drift(),
            ledger_residual: system.ledger.residual(),
            momentum_drift_linear: momentum.map(Momentum::linear),
            momentum_drift_angular: momentum.and_then(Momentum::angular),
            penetration_max: system.penetration_max,
            contact: self.certificate(),
            remeshings: system.remap.as_ref().map_or(Vec::new(), |remap| remap.events.clone()),
            flows: system.remap.as_ref().map_or(Vec::new(), |remap| remap.flows.clone()),
            erosion: self.erosion(),
            forces: self.recorded.peaks(),
            mass_added: system.mass_added[0] + mass_in_run.map_or(0.0, |brought| brought.mass),
            mass_added_in_run: mass_in_run,
            element_evaluations: system.subcycling.as_ref().map(|own| own.evaluations),
            state_hash: crate::record::state_hash(system),
            threads: self.threads,
            simd: system.level.name().to_string(),
            warnings: self.warnings(),
        }
    }
}
