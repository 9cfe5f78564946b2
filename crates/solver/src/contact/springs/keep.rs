//! The springs of the last step in a kept state: fields, histories and erosion ask for them after the step.
//!
//! They are kept as contacts found them, with what was found of each: how the solution has them in memory is
//! its own affair.

use super::{Answer, End, Slid, Slip, Solved, Spring, Springs, Totals};
use crate::archive::{Archive, ArchiveResult, Persist, persist_each};
use crate::contact::springs::TangentSpace;
use crate::tensor::Dim;

impl<const D: usize> Persist for Totals<D> {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { resultant, pressing, energy, slip_energy, work, lost } = self;
        persist_each!(archive; resultant, pressing, energy, slip_energy, work, lost);
        Ok(())
    }
}

impl<const D: usize> Persist for End<D>
where
    Dim<D>: TangentSpace<D>,
{
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { at, share, lean, turn, point, image } = self;
        persist_each!(archive; at, share, lean, turn, point, image);
        Ok(())
    }
}

/// A spring with its terms and ends, and what was found of it.
#[derive(Default)]
struct Whole<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    spring: Spring<D>,
    slip: Slip<D>,
    terms: u32,
    ends: Vec<End<D>>,
    solved: Solved,
    slid: Slid<D>,
}

impl<const D: usize> Persist for Whole<D>
where
    Dim<D>: TangentSpace<D>,
{
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self {
            spring: Spring { normal, gap, stiffness, area, stiffening, side, first: _, count: _ },
            slip: Slip { slip, tangent },
            terms,
            ends,
            solved: Solved { gap: gap_now, force, rates },
            slid: Slid { friction, slip_new, slides, rates: slip_rates },
        } = self;
        persist_each!(archive; normal, gap, stiffness, area, stiffening, side, slip, tangent, terms, ends);
        persist_each!(archive; gap_now, force, friction, slip_new, slides, rates, slip_rates);
        Ok(())
    }
}

impl<const D: usize> Persist for Springs<D>
where
    Dim<D>: TangentSpace<D>,
{
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        persist_each!(archive; &mut self.time_steps, &mut self.sweeps_max, &mut self.unsolved);
        let whole = |(answer, &terms): (Answer<'_, D>, &u32)| {
            let ends = self.ends(answer.spring).map(|end| end.whole()).collect();
            Whole { spring: *answer.spring, slip: answer.slip(), terms, ends, solved: *answer.solved, slid: answer.slid() }
        };
        // What is read replaces those of the start.
        let mut all: Vec<Whole<D>> = self.answers(0..self.list.len()).zip(&self.terms_of).map(whole).collect();
        all.persist(archive)?;
        if !archive.reads() {
            return Ok(());
        }
        self.clear();
        self.work.solved.clear();
        self.work.slid.clear();
        for Whole { spring, slip, terms, ends, solved, slid } in all {
            archive.check((terms as usize) < self.terms.len(), "a spring follows no law")?;
            archive.check(ends.iter().all(|end| (end.at as usize) < archive.places), "a spring ends nowhere")?;
            self.push(spring, slip, &ends);
            self.close_group(terms as usize);
            self.work.solved.push(solved);
            self.work.slid.push(slid);
        }
        if !self.has_tangential {
            self.work.slid.clear();
        }
        self.work.topology.number_in_order(self.list.len());
        Ok(())
    }
}
