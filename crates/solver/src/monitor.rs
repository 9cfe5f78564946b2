//! Monitoring of a run: energies of hourglass control and contact springs, elements of poor shape, strains
//! beyond the measured range, a collapsing time step, and contacts across cuts. Each is reported once for
//! each part, with time and position, and counted for the summary.
//!
//! [`Simulation::run`](crate::simulation::Simulation::run) looks between its steps, where the history is
//! written: energies are summed there already, and elements are looked at only every 256 steps or more.
//! Nothing here changes the run.

use crate::archive::{Archive, ArchiveResult, Persist, persist_all, persist_each};
use crate::dimension::Dimension;
use crate::error::Notice;
use crate::material::variable::PLASTIC_STRAIN;
use crate::material::{self, Parameters};
use crate::mesh::geometry::CellGeometry;
use crate::message::{Example, Message};
use crate::model::Model;
use crate::record::Pushing;
use crate::shortest::Shortest;
use crate::step::System;
use crate::tensor::Dim;
use crate::vector::place;
use std::collections::BTreeMap;

pub(crate) static MESSAGES: &[&Message] = &[&HOURGLASS, &SPRINGS, &NEEDLES, &BEYOND_TABLE, &SHORT_STEP, &PUSHES_ACROSS];

static HOURGLASS: Message = Message {
    code: "W0611",
    title: "much hourglass energy",
    example: Example::Model(
        "[run]\nend = \"100 us\"\n\n[[part]]\nname = \"strip\"\nmaterial = \"steel\"\nelement = \"quad4_reduced\"\nrectangle = { corner = [0, 0], size = [\"50 mm\", \"5 mm\"], elements = [10, 1] }\n\n\
         [[constraint]]\non = \"strip.left\"\nfixed = [\"x\", \"y\"]\n\n[[load]]\non = \"strip.right\"\nforce = [0, \"100 kN/m\"]\n\n\
         [[contact]]\nname = \"self\"\nbodies = \"all\"\n",
    ),
    cause: "Elements with one point have shapes that strain nothing. What holds them is no material: where its \
        energy is more than a tenth of the part's internal energy for more than a hundredth of the run, the part is \
        too stiff or too soft by about as much.",
    remedy: "Take `quad4`, more elements, or spread the load over more nodes; look at the part in the last state for a zigzag.",
};

static SPRINGS: Message = Message {
    code: "W0612",
    title: "much energy in contact springs",
    example: Example::Model(
        "[run]\nend = \"100 us\"\n\n[[contact]]\nname = \"hit\"\nbetween = [\"block.right\", \"wall.left\"]\npenalty_scale = 1e-4\n",
    ),
    cause: "More than a fifth of the largest total energy is stored in the springs of contacts for more than a \
        hundredth of the run: bodies go deep into each other, and the contact is softer than they are.",
    remedy: "Raise `penalty_scale` or `penalty`, or take the law `multiplier`.",
};

/// Presses a pad flat.
const SQUEEZED: &str = "[run]\nend = \"100 us\"\n\n[[part]]\nname = \"pad\"\nmaterial = \"steel\"\nrectangle = { corner = [0, 0], size = [\"10 mm\", \"10 mm\"], elements = [1, 1] }\n\n\
                        [[constraint]]\non = \"pad.right\"\nvelocity = { x = \"-96 m/s\", y = 0 }\n\n[[constraint]]\non = \"pad.left\"\nfixed = [\"x\", \"y\"]\n\n\
                        [[contact]]\nname = \"self\"\nbodies = \"all\"\n";

static NEEDLES: Message = Message {
    code: "W0613",
    title: "elements of poor shape",
    example: Example::Model(SQUEEZED),
    cause: "The smallest Jacobian determinant at a corner over the square of the longest side (1 for a square) fell \
        below 0.05, and to less than half of what it was: the element is squeezed, sheared or folded nearly flat, \
        and its stress and stable step are no longer good.",
    remedy: "Refine the mesh there or shape it so that it deforms into squares; let elements fail (`failure`) where \
        material really breaks.",
};

static BEYOND_TABLE: Message = Message {
    code: "W0614",
    title: "plastic strain beyond the end of its table",
    example: Example::Model(
        "[run]\nend = \"2 us\"\n\n[material.steel]\nlaw = \"j2_table\"\nplastic_strain = [0, 0.01]\nstress = [\"300 MPa\", \"350 MPa\"]\n\n\
         [[constraint]]\non = \"wall.right\"\nvelocity = { x = \"-1 km/s\" }\n",
    ),
    cause: "Beyond its last point a flow curve continues with its last stress, which was not measured.",
    remedy: "Continue the table, or take a law with a formula such as `j2_voce` that was fitted to it.",
};

static SHORT_STEP: Message = Message {
    code: "W0615",
    title: "a step that fell to a tenth",
    example: Example::Model(
        "[run]\nend = \"99.6 us\"\n\n[[part]]\nname = \"block\"\nmaterial = \"steel\"\nrectangle = { corner = [0, \
            0], size = [\"10 mm\", \"10 mm\"], elements = [1, 2] }\n\n[[constraint]]\non = \"block\"\nfixed = \"x\"\n\n[[constraint]]\non \
            = \"block.bottom\"\nfixed = \"y\"\n\n[[constraint]]\non = \"block.top\"\nvelocity = { y = \"-100 m/s\" \
            }\n\n[[contact]]\nname = \"self\"\nbodies = \"all\"\n",
    ),
    cause: "The step goes with the smallest element over the speed of sound in it: one was squeezed, or a material became stiff.",
    remedy: "Look at the element that the message names; let it fail (`failure = { time_step = ... }`), or refine less there.",
};

static PUSHES_ACROSS: Message = Message {
    code: "W0616",
    title: "a contact that pushes across the plane of a cut",
    example: Example::Model(
        "[run]\nend = \"10 us\"\n\n[[part]]\nname = \"left\"\nmaterial = \"steel\"\n\
         rectangle = { corner = [0, 0], size = [\"5 mm\", \"5 mm\"], elements = [2, 2] }\n\n\
         [[part]]\nname = \"right\"\nmaterial = \"steel\"\nvelocity = [\"-20 m/s\", 0]\n\
         rectangle = { corner = [\"5.01 mm\", \"1 mm\"], size = [\"5 mm\", \"5 mm\"], elements = [2, 2] }\n\n\
         [[cut]]\nname = \"section\"\npoint = [0, \"3 mm\"]\nnormal = [0, 1]\n\n[[contact]]\nname = \"hit\"\nbodies = \"all\"\n",
    ),
    cause: "Surfaces on both sides of the plane of a `[[cut]]` push each other. A contact opens and slides, so it is nothing that a cut \
        can go through: its force is no part of the cut's.",
    remedy: "Add the force of the contact, or cut where nothing touches; name the parts that are meant as `parts`.",
};

/// Hourglass energy over internal energy of a part, and energy of contact springs over the largest total
/// energy, from which on they are reported.
const HOURGLASS_MOST: f64 = 0.1;
const SPRINGS_MOST: f64 = 0.2;
/// For how long they must be there, as a fraction of the run: when bodies meet, springs may hold much of the
/// little energy that there is. A sixth is usual for a moment where the penalty is as stiff as coarse
/// elements.
const LASTS: f64 = 0.01;
/// Hourglass energy that is less than this of the largest total energy harms nothing.
const NOTHING: f64 = 1e-3;
/// Shape of an element below which it is reported, and the fraction of its shape at the start.
const SHAPE_LEAST: f64 = 0.05;
const SHAPE_LOST: f64 = 0.5;
/// Step over the first one.
const STEP_LEAST: f64 = 0.1;
/// Steps between two looks at all elements.
const PAUSE: u64 = 256;

/// Something that was seen: what was reported, and how it continued.
#[derive(Clone, Debug, Default)]
struct Seen {
    reported: String,
    most: f64,
}

persist_all!(Seen { reported, most });

/// Hourglass and internal energy of each part, J (in 2D J/m).
fn hourglass<const D: usize>(system: &System<D>) -> Vec<[f64; 2]>
where
    Dim<D>: Dimension<D>,
{
    let mut of_parts = vec![[0.0; 2]; system.mesh.parts.len()];
    for (group, report) in system.mesh.groups.iter().zip(&system.reports) {
        of_parts[group.part][0] += report.hourglass;
        of_parts[group.part][1] += report.stored + report.dissipated;
    }
    // Less than nothing is as wrong: forces that hold shapes back by the rate have then given more than they
    // took.
    of_parts.into_iter().map(|[hourglass, internal]| [hourglass.abs(), internal]).collect()
}

/// Number of a kind among [`MESSAGES`], and of a part (that of none: all).
type Matter = (usize, usize);

/// What has been seen of a run.
pub(crate) struct RunMonitor {
    seen: BTreeMap<Matter, Seen>,
    /// The shortest step at the first look, s.
    first_step: Option<f64>,
    /// Step of the last look at all elements.
    looked: Option<u64>,
    /// Plastic strain at which the table of each group ends.
    ends: Vec<Option<f64>>,
    /// Whether elements of each group fail: what becomes of those before is no news.
    fails: Vec<bool>,
    /// Since when energies have been too large, s.
    since: BTreeMap<Matter, f64>,
}

impl Persist for RunMonitor {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { seen, first_step, looked, since, ends: _, fails: _ } = self;
        persist_each!(archive; seen, first_step, looked, since);
        archive.check(seen.keys().chain(since.keys()).all(|&(kind, _)| kind < MESSAGES.len()), "a warning of no known kind")
    }
}

fn matter(kind: &Message, part: usize) -> Matter {
    (MESSAGES.iter().position(|other| other.code == kind.code).unwrap_or(MESSAGES.len()), part)
}

impl RunMonitor {
    pub(crate) fn new<const D: usize>(model: &Model, system: &System<D>) -> Self
    where
        Dim<D>: Dimension<D>,
    {
        let end = |part: usize| {
            let material = model.materials.get(&model.parts[part].material)?;
            let kind = material::LAWS.iter().find(|kind| kind.name == material.law)?;
            material::table_end(&material.law, &Parameters::new(kind.parameters, &material.parameters, &material.lists))
        };
        let fails = |part: usize| model.materials.get(&model.parts[part].material).is_some_and(|material| !material.failure.is_empty());
        let groups = || system.mesh.groups.iter().map(|group| group.part);
        Self {
            seen: BTreeMap::new(),
            first_step: None,
            looked: None,
            ends: groups().map(end).collect(),
            fails: groups().map(fails).collect(),
            since: BTreeMap::new(),
        }
    }

    /// Looks at a system and at what pushes across cuts, also at its elements if it is the last time; what is
    /// new.
    pub(crate) fn look<const D: usize>(&mut self, system: &System<D>, shortest: &Shortest, across: &[Pushing], is_last: bool) -> Vec<Notice>
    where
        Dim<D>: Dimension<D>,
    {
        let mut new = Vec::new();
        self.energies(system, &mut new);
        for Pushing { index, cut, contact } in across {
            let text = format!("contact \"{contact}\" pushes across the plane of cut \"{cut}\" at {:.6e} s", system.time);
            self.see(&PUSHES_ACROSS, *index, 1.0, text, &mut new);
        }
        let first = *self.first_step.get_or_insert(shortest.time_step);
        if shortest.time_step < STEP_LEAST * first {
            let Shortest { time_step, governor } = shortest;
            let text =
                format!("the step fell from {first:.3e} s to {time_step:.3e} s until {:.6e} s; it is governed by {governor}", system.time);
            self.see(&SHORT_STEP, usize::MAX, first / time_step, text, &mut new);
        }
        if is_last || self.looked.is_none_or(|looked| system.step >= looked + PAUSE) {
            self.looked = Some(system.step);
            self.elements(system, &mut new);
        }
        new
    }

    /// What was seen, with the most that became of it; of hourglass energy also what it is now.
    pub(crate) fn notices<const D: usize>(&self, system: &System<D>) -> impl Iterator<Item = Notice>
    where
        Dim<D>: Dimension<D>,
    {
        let now = hourglass(system);
        self.seen.iter().map(move |(&(number, part), Seen { reported, most })| {
            let kind = MESSAGES[number];
            let share = now.get(part).map(|[hourglass, internal]| hourglass / internal).filter(|share| share.is_finite());
            let most = if let (Some(share), true) = (share, kind == &HOURGLASS) {
                format!("; {:.1} % at most, {:.1} % in the end", 100.0 * most, 100.0 * share)
            } else if [&HOURGLASS, &SPRINGS].contains(&kind) {
                format!("; {:.1} % at most", 100.0 * most)
            } else if kind == &SHORT_STEP {
                format!("; it fell to 1/{most:.0}")
            } else if kind == &PUSHES_ACROSS {
                String::new()
            } else if *most == 1.0 {
                "; 1 element".to_string()
            } else {
                format!("; {most} elements at most")
            };
            Notice::new(kind, format!("{reported}{most}"))
        })
    }

    fn see(&mut self, kind: &'static Message, part: usize, size: f64, text: String, new: &mut Vec<Notice>) {
        let seen = self.seen.entry(matter(kind, part)).or_insert_with(|| {
            new.push(Notice::new(kind, &text));
            Seen { reported: text, most: size }
        });
        seen.most = seen.most.max(size);
    }

    fn energies<const D: usize>(&mut self, system: &System<D>, new: &mut Vec<Notice>)
    where
        Dim<D>: Dimension<D>,
    {
        let largest = system.ledger.largest;
        for (part, [hourglass, internal]) in hourglass(system).into_iter().enumerate() {
            let is_much = hourglass > HOURGLASS_MOST * internal && hourglass > NOTHING * largest;
            if self.lasts(&HOURGLASS, part, is_much, system) {
                let (name, share) = (&system.mesh.parts[part].name, hourglass / internal);
                let share_now = 100.0 * share;
                let text = format!("part \"{name}\": hourglass energy is {share_now:.1} % of its internal energy at {:.6e} s", system.time);
                self.see(&HOURGLASS, part, share, text, new);
            }
        }
        let share = system.ledger.stores.contact / largest;
        if self.lasts(&SPRINGS, usize::MAX, share > SPRINGS_MOST, system) {
            let energy = |contact: &&crate::contact::Contact<D>| contact.totals.energy;
            let worst = system.contacts.iter().max_by(|a, b| energy(a).total_cmp(&energy(b)));
            let name = worst.map_or(String::new(), |contact| format!(", most of it in {} \"{}\"", contact.kind.name(), contact.name));
            let share_now = 100.0 * share;
            let text = format!("springs of contacts hold {share_now:.1} % of the largest total energy at {:.6e} s{name}", system.time);
            self.see(&SPRINGS, usize::MAX, share, text, new);
        }
    }

    /// Whether something has been so at every look for long enough.
    fn lasts<const D: usize>(&mut self, kind: &Message, part: usize, is_so: bool, system: &System<D>) -> bool
    where
        Dim<D>: Dimension<D>,
    {
        if !is_so {
            self.since.remove(&matter(kind, part));
            return false;
        }
        let since = *self.since.entry(matter(kind, part)).or_insert(system.time);
        system.time - since >= LASTS * system.limits.end
    }

    /// Shapes and plastic strains of all elements that deform.
    fn elements<const D: usize>(&mut self, system: &System<D>, new: &mut Vec<Notice>)
    where
        Dim<D>: Dimension<D>,
    {
        let mut found: BTreeMap<(&'static str, usize), (&'static Message, usize, String)> = BTreeMap::new();
        // Of elements that were made again, as they were then.
        let begun = system.mesh.references();
        for (index, (group, block)) in system.mesh.groups.iter().zip(&system.blocks).enumerate() {
            if system.rigid[index] {
                continue;
            }
            let part = group.part;
            let mut note = |kind: &'static Message, element: usize, what: String| {
                let at = place(system.centre(group.nodes_of(element)));
                let (name, user) = (&system.mesh.parts[part].name, group.user_elements[element]);
                let text = || format!("element {user} of part \"{name}\" at {at} m has {what} at {:.6e} s", system.time);
                found.entry((kind.code, part)).or_insert_with(|| (kind, 0, text())).1 += 1;
            };
            let end = self.ends[index];
            for (element, cell) in group.cells().enumerate().filter(|(element, _)| group.is_alive(*element)) {
                let now = <Dim<D>>::shape_quality(cell, &system.positions);
                if !self.fails[index] && now < SHAPE_LEAST && now < SHAPE_LOST * <Dim<D>>::shape_quality(cell, &begun) {
                    note(&NEEDLES, element, format!("a shape of {now:.3}"));
                }
                if let Some(end) = end {
                    let strain = block.variable(&block.state(element), &PLASTIC_STRAIN).unwrap_or(0.0);
                    if strain > end {
                        note(&BEYOND_TABLE, element, format!("a plastic strain of {strain:.4}, and its table ends at {end:.4},"));
                    }
                }
            }
        }
        for ((_, part), (kind, count, text)) in found {
            self.see(kind, part, count as f64, text, new);
        }
    }
}
