//! Energies and works of solved springs.
//!
//! Links come from [`super::solve`]; what is booked stays in the springs, from where [`super::Springs::collect`] sums it up.

use super::link::Link;
use super::{Lost, Spring, Springs, Tangential, Terms};
use rayon::prelude::*;

/// Springs that one task books.
const CHUNK: usize = 1024;

impl Springs {
    /// Takes forces from the links, with their energies and works.
    pub(super) fn book(&mut self, time_steps: [f64; 2], terms: &[Terms], parallel: bool) {
        let (links, rank, terms_of) = (&self.work.links, &self.work.rank, &self.terms_of);
        let book = |first: usize, springs: &mut [Spring]| {
            let begin = first * CHUNK;
            for ((spring, &rank), &number) in springs.iter_mut().zip(&rank[begin..]).zip(&terms_of[begin..]) {
                spring.book(&links[rank as usize], &terms[number as usize], time_steps);
            }
        };
        if parallel {
            self.list.par_chunks_mut(CHUNK).enumerate().for_each(|(first, springs)| book(first, springs));
        } else {
            self.list.chunks_mut(CHUNK).enumerate().for_each(|(first, springs)| book(first, springs));
        }
    }
}

impl Spring {
    fn book(&mut self, link: &Link, terms: &Terms, time_steps: [f64; 2]) {
        let [before, after] = time_steps;
        let mean_step = 0.5 * (before + after);
        (self.force, self.friction) = (link.force, link.friction);
        (self.slip_new, self.slides, self.slip_rate) = (link.slip_new, link.slides, link.rates[1]);
        let spring = *self;
        let gap_new = self.gap + 0.5 * after * link.rates[0];
        self.gap_new = gap_new;
        let (stored_old, stored_new) = (terms.law.stored(&spring, link.gap_old), terms.law.stored(&spring, gap_new));
        // Part of the force that the energy explains; the rest is damping, or a multiplier's.
        let elastic = match terms.law.is_elastic() {
            false => 0.0,
            true if terms.damping == 0.0 => self.force,
            true => terms.law.mean_force(&spring, link.gap_old, gap_new),
        };
        let bend = gap_new + link.gap_old - 2.0 * self.gap;
        self.energy = 0.5 * (stored_old + stored_new) + 0.5 * elastic * bend;
        self.stored = [stored_new, 0.0];
        self.stored_before = stored_old;
        let rate_mean = 0.5 * (link.rate_old + link.rates[0]);
        let slip_mean = 0.5 * (link.slip_rate_old + link.rates[1]);
        self.work = mean_step * (self.force * rate_mean + self.friction * slip_mean);
        let inelastic = self.force - elastic;
        self.lost = Lost { damping: -mean_step * inelastic * rate_mean, ..Lost::default() };
        self.lost.old[1] = -mean_step * inelastic * link.rate_old;
        match terms.tangential {
            Tangential::Free => self.slides = self.force != 0.0,
            Tangential::Friction(_) => {
                self.lost.friction = -mean_step * self.friction * slip_mean;
                self.lost.old[0] = -mean_step * self.friction * link.slip_rate_old;
                let stiffness = terms.law.slip_stiffness(&spring);
                if stiffness.is_finite() {
                    self.slip_energy = 0.25 * stiffness * (self.slip * self.slip + self.slip_new * self.slip_new);
                }
            }
            Tangential::Tied => {
                let stiffness = terms.law.slip_stiffness(&spring);
                if stiffness.is_finite() {
                    let (old, new) = (self.slip - 0.5 * before * link.slip_rate_old, self.slip + 0.5 * after * link.rates[1]);
                    self.stored[1] = 0.5 * stiffness * new * new;
                    self.stored_before += 0.5 * stiffness * old * old;
                    self.energy += 0.25 * stiffness * (old * old + new * new) + 0.5 * self.friction * (old + new - 2.0 * self.slip);
                } else {
                    self.lost.damping -= mean_step * self.friction * slip_mean;
                    self.lost.old[1] -= mean_step * self.friction * link.slip_rate_old;
                }
            }
        }
    }
}
